"""Families about what touch can't know of a thing.

Not here: what has nothing to do with the contact (``off_topic``).
"""

from __future__ import annotations

from collections.abc import Callable

from tacgrasp.lessons.dialogue.families.family import Bindings, Numbers, QuestionFamily, length_of
from tacgrasp.lessons.dialogue.meaning import Meaning, Unknowable
from tacgrasp.lessons.dialogue.query import SUBJECTS


def _unknown(subject: str) -> Callable[[Bindings, Numbers], Meaning]:
    return lambda bindings, _: Unknowable(subject=subject, length=length_of(bindings))


def _unfelt(
    name: str, direct: str, indirect: str, noun: str, trait: str, act: str, acts: str
) -> QuestionFamily:
    """Questions about something that touch can't know.

    Args:
        name: Name in ``SUBJECTS``.
        direct: Questions, without their question mark.
        indirect: Questions with the word order after 'tell me'.
        noun: What is asked for, without its article.
        trait: What comes after 'it is'.
        act: What comes after 'does it'.
        acts: The same after 'it'.
    """
    return QuestionFamily(
        name=name,
        pattern=(
            f"{{lead}} [[{{first_length}}]] ( ( {direct} ) | ( {direct} ) | {{ask}} ( {indirect} ) "
            f"| ({{want}} the|{{want}} the|for {{body}} : the|the|the exact|the|) ({noun}) of {{body}} "
            f"| ({{want}}|what about|how about|and|do you know|can you feel|) its ({noun}) "
            f"| (can|could|do|would|did) you (feel|sense|tell|guess|know|detect|measure|find|notice) "
            f"(its|the) ({noun}) [of {{body}}] "
            f"| {{body}} (:|,) [its] ({noun}) "
            f"| {{ask}} what (its ({noun})|the ({noun}) of {{body}}) is "
            f"| (is|was|isn't|is) {{thing}} ({trait}) [[, {{verdict}}]] "
            f"| {{whether}} {{thing}} is [not] ({trait}) [[, {{verdict}}]] "
            f"| {{believe}} {{thing}} is [not] ({trait}) [{{tag}}] "
            f"| {{thing}} is [not] ({trait}) {{tag}} "
            f"| (could|might|can|would) {{thing}} be ({trait}) "
            f"| (does|doesn't|did) {{thing}} ({act}) [[, {{verdict}}]] "
            f"| {{whether}} {{thing}} ({acts}) | {{believe}} {{thing}} ({acts}) [{{tag}}] "
            f") {{tail}} [, {{length}}]"
        ),
        build=_unknown(SUBJECTS[name]),
    )


FAMILIES: tuple[QuestionFamily, ...] = (
    _unfelt(
        "color",
        "(what|which) (color|shade|hue) (is|has|does) {thing} [have]|is {thing} {*colours} or "
        "{*colours}|how (bright|dark|pale|colorful|shiny|see-through|transparent) is {thing}|"
        "what color do you (see|think it is)|(what|which) color did they paint {thing}|"
        "(does|is) {thing} (shine|shining|glow|glowing|reflect light)|color [of {thing}]|"
        "can you see (through {thing}|the color)|in (what|which) color is {thing} [painted]|"
        "which colors does {thing} have|how many colors does {thing} have|{*colours} or {*colours}|"
        "is there (any|some) {*colours} on {thing}|what is the main color of {thing}|"
        "can you (tell|guess|name) the color",
        "(what|which) color {thing} (is|has)|how (bright|dark|shiny|transparent) {thing} is|"
        "if {thing} is {*colours} or {*colours}|the color of {thing}",
        "color|shade|tint|hue|paint|color scheme|rgb value|hex color|brightness|transparency|"
        "coloring|main color|gloss",
        "[rather|more|dark|light|mostly|bright|pale|really|all] {*colours}|{*colours}|{*patterns}|"
        "painted [{*colours}]|{*colours} or {*colours}|{*colours} and {*colours}|colored|colorful|"
        "transparent|see-through|translucent|opaque|shiny|glossy|the same color as {body}|"
        "a {*colours} one|{*colours} inside",
        "look {*colours}|have a {*colours} (skin|stripe|spot|label|side)|change color|shine|glow",
        "looks {*colours}|has a {*colours} (skin|stripe|spot|label)|shines|changes color",
    ),
    _unfelt(
        "temperature",
        "how (hot|cold|warm|cool) (is|does|was) {thing} [feel]|is {thing} {*warmth} or {*warmth}|"
        "what temperature (is|has|does) {thing} [have]|how many degrees [celsius|fahrenheit|kelvin] "
        "(is {thing}|does {thing} have)|is {thing} (warmer|colder|hotter|cooler) than {body}|"
        "was {thing} (heated|cooled|frozen|cooked|in the fridge|in the oven|in the sun) [before]|"
        "what does the thermometer say|will {thing} (burn me|melt|freeze|cool down)|"
        "(can|do) you feel (heat|warmth|any heat|the cold)|(hot|warm) or cold|temperature [of {thing}]|"
        "(would|could) I burn (my fingers|my hand|myself) on {thing}|what is its heat capacity|"
        "is {thing} hot enough to (drink|burn me|cook with)|does {thing} need cooling|"
        "(at|to) what temperature does {thing} (melt|boil|freeze|burn)|is {thing} above (zero|{#n} "
        "degrees)|has {thing} (warmed up|cooled down)",
        "how (hot|cold|warm|cool) {thing} is|what temperature {thing} (has|is)|"
        "whether {thing} is {*warmth}|if {thing} is hot or cold|the temperature of {thing}",
        "temperature|heat|warmth|coldness|temperature in (celsius|degrees|fahrenheit|kelvin)|"
        "melting point|boiling point|surface temperature|thermal conductivity|heat capacity",
        "[rather|very|still|too|quite|a bit|already] {*warmth}|{*warmth}|{*warmth} to the touch|"
        "at room temperature|on fire|burning|"
        "about to melt|(warmer|colder|hotter|cooler) than (before|the room|my hand|usual|yesterday)|"
        "heated|hot or cold|warmed up|cooled down|straight from the (oven|fridge|freezer)",
        "feel [rather|very|a bit] {*warmth}|get hot|give off heat|melt|conduct heat|burn",
        "feels [rather|very|a bit] {*warmth}|gets hot|gives off heat|is getting (warmer|colder)",
    ),
    _unfelt(
        "name",
        "what is {thing} called|what do (you|people|we) call {thing}|how do (you|people) call {thing}|"
        "what (object|fruit|tool|product|item|animal|vegetable) (is {thing}|are we holding|do I hold|"
        "did you pick up|is that)|(which|what) (model|version|brand|make|type|species|variety) is "
        "{thing}|what am I (holding|touching|gripping)|what are we (holding|gripping|picking up)|"
        "what have (we|you) (got|picked up|grabbed) [here]|what is (this|that|it) [thing]|"
        "(can|could|do) you (identify|recognise|name|classify) {thing}|is {thing} [a|an] {*objects} or "
        "[a|an] {*objects}|guess what {thing} is|which {*objects} is {thing}|what kind of {*objects} "
        "is {thing}|does {thing} have a name|name {thing}|what is in your (hand|gripper)|"
        "what did (we|you) (grab|catch|find)|(a|an) {*objects} or (a|an) {*objects}|"
        "what is the word for {thing}|is {thing} the (right|same) one|which one is {thing}",
        "what {thing} is called|what (object|item|product|fruit|tool) {thing} is|what we are holding|"
        "what {thing} is|the name of {thing}|which (model|brand|type|make) {thing} is|"
        "what I am holding",
        "name|brand|model|type|serial number|product number|part number|designation|identity|"
        "product name|model number|id|article number|official name|species|trade name|version",
        "(a|an) {*objects}|[a|an] {*qualities} {*objects}|some kind of {*objects}|"
        "(a|an) {*animals}|called [a|an] {*objects}|(a|an) {*objects} or (a|an) {*objects}|"
        "the same {*objects} as (before|yesterday)|my {*objects}|a famous brand|the newest model|"
        "really (a|an) {*objects}|a real {*objects}|a kind of {*objects}",
        "have a (name|number|nickname)|go by another name|count as (a|an) {*objects}",
        "has a (name|nickname|model number)|counts as (a|an) {*objects}",
    ),
    _unfelt(
        "price",
        "(how much|what) (does|did|would|will) {thing} cost [me|us]|how (expensive|cheap|valuable|"
        "costly|pricey|rare) is {thing}|what is {thing} worth|how many {*money} (is {thing} worth|"
        "does {thing} cost|for {thing})|(can|could|should) (I|we) (sell|afford|buy) {thing}|"
        "how much (did|do|would) (I|you|we|they) (pay|get|want|ask) for {thing}|"
        "how much is {thing} [worth|in {*money}]|what would {thing} (sell|go) for|"
        "does {thing} cost (more|less) than (ten|five|twenty|a hundred|{#n}) {*money}|"
        "is {thing} worth (it|the money|buying|{#n} {*money}|more than {#n} {*money})|"
        "how much money is {thing}|price [of {thing}]|who would pay {#n} {*money} for {thing}|"
        "what is the price tag|is there a discount on {thing}|how much tax is on {thing}",
        "(how much|what) {thing} costs|what {thing} is worth|how (expensive|valuable|cheap) {thing} "
        "is|how much I paid for {thing}|how many {*money} {thing} costs|the price of {thing}",
        "price|cost|value|market value|sales price|price tag|worth|resale value|price in {*money}|"
        "retail price|tax|discount|value in {*money}|list price",
        "[very|too|rather|really|quite] (expensive|cheap|costly|valuable|pricey)|a bargain|"
        "worth (a lot|a fortune|nothing|{#n} {*money}|the money)|on sale|for sale|for free|"
        "more expensive than {body}|cheaper than {body}|overpriced|a rip off|affordable|priceless",
        "cost [more|less] than {#n} {*money}|cost (a lot|much|a fortune|too much)|sell well",
        "costs (a lot|too much|{#n} {*money}|a fortune)|sells for {#n} {*money}",
    ),
    _unfelt(
        "smell",
        "(how|what) does {thing} smell [like|of]|what is {thing} smelling of|"
        "(can|do|could) you smell (it|{thing}|something|anything|smoke|gas)|what is that smell|"
        "(good|bad) smell|smell [of {thing}]|how strong does {thing} smell|what do you smell|"
        "is there (a|any) (smell|odour|scent|stink) [from {thing}]|which (perfume|scent) is on {thing}|"
        "is the smell of {thing} (nice|bad|strong|pleasant)|how (fragrant|smelly) is {thing}|"
        "what does your nose say|do you have a nose",
        "(how|what) {thing} smells [like|of]|how strong {thing} smells|the smell of {thing}|"
        "whether there is a smell",
        "smell|odour|aroma|scent|perfume|fragrance|stink|odor|bouquet",
        "{*smells}|[very|rather|too] {*smells}|perfumed|stinking|smelling (good|bad|of {*objects})",
        "smell [of] ({*smells}|{*objects})|smell (good|bad|nice|funny|strange|fresh|awful|off|burnt|"
        "like {*objects}|like {*dishes}|of anything)|stink|have a (smell|scent)|"
        "smell (strongly|strange)",
        "smells {*smells}|smells (of|like) {*objects}|smells (good|bad|nice|funny|off|burnt)|stinks",
    ),
    _unfelt(
        "taste",
        "(how|what) (does|would) {thing} taste [like]|how (sweet|salty|sour|tasty|spicy|bitter) is "
        "{thing}|{*tastes} or {*tastes}|is {thing} {*tastes} or {*tastes}|would {thing} taste "
        "(good|bad|of {*objects})|taste [of {thing}]|(would|will) I like the taste [of {thing}]|"
        "what (flavour|flavor|taste) (is|has|does) {thing} [have]|is {thing} (good|nice) to eat|"
        "do you want (to taste|a bite of) {thing}|did you taste {thing}|can you taste {thing}|"
        "how much (sugar|salt) is in {thing}|which spices are in {thing}|goes {thing} with {*dishes}|"
        "how many calories (are in|has|does) {thing} [have]",
        "(how|what) {thing} tastes [like]|how (sweet|salty|sour|tasty|spicy) {thing} is|"
        "what flavour {thing} has|the taste of {thing}",
        "taste|flavour|flavor|sweetness|sugar content|calories|saltiness|acidity|aftertaste|"
        "nutritional value",
        "[too|very|rather|quite] {*tastes}|tasty|delicious|yummy|good to eat|seasoned|"
        "sweeter than {body}|{*tastes} or {*tastes}|sugar free",
        "taste {*tastes}|taste (good|bad|nice|of {*objects}|like {*objects}|like {*dishes}|funny|awful)|"
        "contain (sugar|salt|calories)|have a {*tastes} taste",
        "tastes {*tastes}|tastes (good|bad|nice|awful|of {*objects}|like {*objects})",
    ),
    _unfelt(
        "sound",
        "(how|what) does {thing} sound [like]|how (loud|quiet|noisy) is {thing}|"
        "what do you hear [from {thing}]|(can|do|could|did) you hear {thing}|sound [of {thing}]|"
        "what (noise|sound|note|tone) (does|did) {thing} make|is {thing} making (a|any) (noise|sound)|"
        "which song does {thing} play|(loud|noisy) or quiet|how many decibels does {thing} make|"
        "is there (music|a noise|a sound) (in|from) {thing}|what key is {thing} in|"
        "does it make a noise when (shaken|you shake it|you knock on it|it falls)|"
        "what does {thing} sound like when I (knock on|shake|drop|hit) it",
        "(how|what) {thing} sounds [like]|how loud {thing} is|what sound {thing} makes|"
        "the sound of {thing}",
        "sound|noise|tone|pitch|loudness|volume in decibels|decibel level|melody|ring",
        "{*sounds}|[very|too|rather] {*sounds}|[too|very] loud|in tune|out of tune|playing music|"
        "making (a|any) (noise|sound)|audible",
        "(ring|hum|rattle|squeak|click|buzz|tick|beep|hiss|crackle|whistle)|sound (hollow|good|"
        "metallic|broken|nice|like {*objects})|make (a noise|a sound|music|noise)|play music",
        "sounds (hollow|good|metallic|broken|like {*objects})|makes a (noise|sound)|rattles|rings|ticks",
    ),
    _unfelt(
        "origin",
        "where (does|did) {thing} (come from|originate|grow)|where was {thing} (made|grown|bought|"
        "produced|found|picked|manufactured|harvested|built|caught|mined)|from where is {thing}|"
        "where is {thing} from|where did (you|we|they|I) (get|buy|find|pick up) {thing} [from]|"
        "(which|what) (country|town|farm|shop|store|region) (is {thing} from|does {thing} come from)|"
        "(in|from) which (country|factory|shop) was {thing} (made|bought)|origin [of {thing}]|"
        "how did {thing} get here|where can I (buy|get|find) (another|more) of these|"
        "was {thing} (imported|shipped|flown in|made abroad|made locally|made here)|"
        "how far did {thing} travel|which tree did {thing} grow on|made in {*countries}",
        "where {thing} (comes from|was made|was bought|was grown|is from|was found)|"
        "which (country|shop|farm) {thing} comes from|the origin of {thing}",
        "origin|country of origin|provenance|source|birthplace|place of manufacture|shop|"
        "country|home country",
        "from ({*countries}|{*cities}|the {*places})|from (abroad|here|china|around here|the region)|"
        "made in ({*countries}|{*cities})|grown in {*countries}|imported [from {*countries}]|"
        "local|{*languages}|bought in the {*places}|produced in {*countries}|home grown",
        "come from ({*countries}|{*cities}|the {*places}|far away|abroad)|grow in {*countries}",
        "comes from ({*countries}|{*cities}|the {*places}|far away)|was made in {*countries}",
    ),
    _unfelt(
        "inside",
        "what is (in|inside|within) {thing}|is there (anything|something|a {*objects}|a hole|water|"
        "liquid|air|a stone|a worm|a seed|a battery) (inside|in) {thing}|what does {thing} contain|"
        "what is (under the skin|in the middle|at the core) of {thing}|how does {thing} work|"
        "how full is {thing}|how many ({*objects}|seeds|parts|layers) are (in|inside) {thing}|"
        "how much (water|liquid|air) is (in|inside) {thing}|what is hidden (in|inside) {thing}|"
        "full or empty|hollow or solid|is {thing} full or empty|is {thing} hollow or solid|"
        "does {thing} (contain|have|hold) [a|an|any] ({*objects}|water|liquid|filling|nuts|core) "
        "[inside]|how thick is the (wall|shell|skin|peel) of {thing}|what is {thing} filled with|"
        "what would I find (in|inside) {thing}|can you feel what is inside|what are the contents|"
        "what is its inner structure|which parts are inside {thing}|who is inside {thing}",
        "what is (in|inside|within) {thing}|what {thing} contains|whether {thing} is (hollow|empty|"
        "full)|how {thing} works|what {thing} is filled with|how full {thing} is",
        "inside|content|contents|filling|core|interior|inner structure|inner parts|"
        "wall thickness|inner workings|fill level|water content|weight distribution inside",
        "(hollow|full|filled|solid|empty) [inside|all the way through|on the inside]|"
        "half (full|empty)|filled with ({*objects}|water|air|liquid|{*dishes})|rotten inside|"
        "full of ({*objects}|water|air|holes)|juicy inside|packed with {*objects}",
        "contain ({*objects}|water|liquid|air|anything|seeds|nuts|a surprise)|have (a core|a stone|"
        "seeds|a filling|something inside|an engine)|hold water",
        "contains ({*objects}|water|liquid|air|something|seeds)|has (a core|something inside|seeds)",
    ),
    _unfelt(
        "sight",
        "what does {thing} look like [from (behind|above|the other side|afar)]|"
        "how does {thing} look|is {thing} (pretty|beautiful|ugly) or (pretty|beautiful|ugly)|"
        "(do|can|could) you see ({thing}|me|us|anything|it)|what do you see|show me (a picture|"
        "a photo|an image) of {thing}|what is on the (other|far|back) side of {thing}|"
        "how (pretty|beautiful|ugly|nice|elegant|fashionable) is {thing}|(can|could) I see {thing}|"
        "take a (picture|photo) of {thing}|what does the camera (see|show)|does {thing} look (good|"
        "nice|like me)|do you like the look of {thing}|is the back of {thing} (flat|damaged|clean)|"
        "is there (dirt|dust|a stain|a mark|a scratch) on the (other|far|back) side [of {thing}]|"
        "what is {thing} like on the (other|far|back) side|how does {thing} look in the (dark|light)",
        "what {thing} looks like|how {thing} looks|what you see|how (pretty|beautiful|ugly) {thing} is|"
        "what is on the other side of {thing}",
        "look|looks|appearance|back|other side|back side|far side|beauty|style|design|photo|picture|"
        "reflection|shadow",
        "[very|rather|really] (pretty|beautiful|ugly|nice to look at|good looking|handsome|cute|"
        "elegant|stylish|photogenic)|visible|in the picture|in the shade|prettier than {body}|"
        "stained|clean on the other side|damaged at the back",
        "look (good|nice|ugly|old|pretty|strange|funny|dirty|clean|expensive|like {*objects})|"
        "cast a shadow",
        "looks (good|nice|ugly|pretty|strange|dirty|like {*objects})|has a nice look",
    ),
    _unfelt(
        "material",
        "what (is|was) {thing} made (of|from|out of)|(what|which) (material|stuff|substance|metal|"
        "wood|plastic|fabric|alloy) is {thing} [made of]|is {thing} {*materials} or {*materials}|"
        "what are the ingredients of {thing}|{*materials} or {*materials}|material [of {thing}]|"
        "what is the (chemical composition|recipe|chemical formula|density) of {thing}|"
        "of what [material] is {thing} [made]|what does {thing} consist of|"
        "how much {*materials} is in {thing}|which (ingredients|chemicals) are in {thing}|"
        "is there [any] ({*materials}|gluten|nickel|lead|dna) in {thing}|how (pure|dense) is {thing}|"
        "what are its chemical properties",
        "what {thing} is made (of|from|out of)|(what|which) (material|metal|wood) {thing} is [made of]|"
        "what {thing} consists of|the material of {thing}",
        "material|composition|chemical composition|ingredients|recipe|chemistry|substance|alloy|"
        "density|chemical formula|ph value|fabric|purity|molecular structure|atomic structure",
        "(made|built) (of|from|out of) {*materials}|{*materials}|real {*materials}|pure {*materials}|"
        "{*materials} or {*materials}|(a|an) {*materials} {*objects}|artificial|coated with "
        "{*materials}|plated with {*materials}|biodegradable|recyclable|organic matter",
        "consist of {*materials}|contain ({*materials}|gluten|nickel)|rust|have a {*materials} coating",
        "consists of {*materials}|contains {*materials}|has a {*materials} core",
    ),
    _unfelt(
        "age",
        "how (old|new|young|ancient) is {thing}|when was {thing} (made|bought|produced|harvested|born|"
        "built|manufactured|picked|invented|delivered|opened)|is {thing} (old|new) or (new|old)|"
        "what year is {thing} from|how long has {thing} (been|lain) (here|there|in the "
        "{*places})|in (what|which) (year|century|month) was {thing} made|(old|new) or (new|old)|"
        "from which (year|century|decade) is {thing}|how many (years|days|weeks|months) old is {thing}|"
        "age [of {thing}]|is {thing} older than (me|you|{body}|{#n} years)|since when do we have {thing}|"
        "when did (we|you|they) (get|buy|make) {thing}",
        "how (old|new) {thing} is|when {thing} was (made|bought|produced|built|harvested)|"
        "the age of {thing}",
        "age|production date|year of manufacture|date of birth|birthday|date of purchase|"
        "manufacturing date|year|lifetime|age in years",
        "[very|rather|quite|really|too] (old|new|ancient|young|modern)|(an|a) (antique|new one|"
        "old one)|brand new|second hand|{#n} years old|older than (me|{body}|{#n} years)|"
        "newer than {body}|from (last year|last week|yesterday|the last century)",
        "look (old|new)|date from (last year|the middle ages|last century)",
        "dates from (last year|the last century)|was made (last year|yesterday|{#n} years ago)",
    ),
    _unfelt(
        "owner",
        "(who|which {*jobs}) (owns|bought|sold|brought|lost|left|ordered) {thing}|"
        "whose {*objects} is (this|that|it)|whose is (it|this|that|{thing})|to whom does {thing} belong|"
        "who does {thing} belong to|is {thing} (mine|yours|ours|his|hers) or (mine|yours|his|hers)|"
        "who is the owner|did (my {*people_words}|you|the {*jobs}) (buy|bring|lose|order) {thing}|"
        "who (gave|sent) (you|us|me) {thing}|for whom is {thing}|who gets {thing}|"
        "is {thing} from my {*people_words}|owner [of {thing}]|can I keep {thing}|who will use {thing}",
        "(who|which {*jobs}) owns {thing}|whose {thing} is|who {thing} belongs to|"
        "who the owner of {thing} is|who bought {thing}",
        "owner|previous owner|buyer|seller|owner's name|customer|rightful owner",
        "(mine|yours|ours|his|hers|theirs)|a gift [for my {*people_words}]|"
        "owned by (my {*people_words}|the {*jobs}|you)|stolen|lost|sold|for my {*people_words}|"
        "the property of (my {*people_words}|the {*jobs})",
        "belong to (me|you|us|him|her|somebody|my {*people_words}|the {*jobs})",
        "belongs to (me|you|us|somebody|my {*people_words}|the {*jobs})",
    ),
    _unfelt(
        "maker",
        "who (made|makes|designed|built|invented|produced|manufactured|sells|baked|grew|painted) "
        "{thing}|(which|what) {*makers} (made|sells|makes|built|produces) {thing}|"
        "by (whom|which {*makers}) was {thing} (made|designed|built|produced)|maker [of {thing}]|"
        "who is the (maker|manufacturer|designer|producer|inventor) of {thing}|"
        "did (you|a machine|a {*jobs}) make {thing}|how was {thing} (made|produced|manufactured)|"
        "what machine (made|cut|printed) {thing}|which batch is {thing} from|"
        "was {thing} (3d printed|made by hand|made by machine|machined|cast|milled)",
        "who (made|makes|designed|built|sells|produced) {thing}|(which|what) {*makers} made {thing}|"
        "how {thing} was made",
        "maker|manufacturer|producer|designer|inventor|supplier|batch number|production method|"
        "vendor|brand owner|lot number",
        "from a (famous|known|good|cheap) {*makers}|made by (hand|machine|a {*jobs}|a robot|a known "
        "{*makers})|designed by a {*jobs}|handmade|mass produced|produced by a {*makers}|"
        "a designer piece|printed in three dimensions",
        "come from a (famous|known|good|small|big) {*makers}",
        "comes from a (famous|known|good|small|big) {*makers}|was made by (a {*jobs}|hand)",
    ),
    _unfelt(
        "purpose",
        "what is {thing} ([made] for|good for|used for|used as|supposed to do|meant for)|"
        "what (can|do|could) (I|you|we|people) (use {thing} for|do with a thing like this)|"
        "what does {thing} do|which machine does {thing} (belong in|fit)|who (uses|needs) {thing}|"
        "where does {thing} belong|what is the (purpose|use|point) of {thing}|purpose [of {thing}]|"
        "(does|will|would) {thing} (fit|work) (in|with) (my|the|a) {*objects}|how do I use {thing}|"
        "is {thing} (useful|needed) for {*activities} [{*objects}]|can I use {thing} for {*activities}|"
        "what am I to use {thing} for|is {thing} still in use|how often is {thing} used|"
        "does {thing} still work|is {thing} (working|functional)|what do people do with {thing}",
        "what {thing} is [made|used|good] for|what {thing} does|how {thing} is used|who uses {thing}|"
        "whether {thing} (still works|works)",
        "purpose|use|function|manual|instructions|warranty|application|job|role|user manual",
        "(made|used|meant|good) for {*activities} [{*objects}]|useful [for {*activities}]|needed|"
        "working|functional|out of order|still in use|part of (a|the) {*objects}|"
        "for {*activities} {*objects}",
        "work|still work|have (a|any) use|belong to a {*objects}|fit (a|my|the) {*objects}|"
        "serve a purpose|come with a manual",
        "works|has a use|fits (my|the) {*objects}|belongs to a {*objects}|helps with {*activities}",
    ),
    _unfelt(
        "freshness",
        "how (fresh|ripe|stale|rotten) is {thing}|when does {thing} (expire|go bad|go off)|"
        "is {thing} still (good|fresh|edible|fine to eat)|what is the (expiry|best before|sell by) date|"
        "has {thing} (gone bad|gone off|expired|spoiled)|how long will {thing} (keep|last|stay fresh)|"
        "fresh or (stale|rotten|frozen)|ripe or (unripe|overripe|green)|how long does {thing} keep|"
        "is {thing} (ripe|green) or (unripe|ripe)|will {thing} be (good|ripe) tomorrow|"
        "was {thing} (picked|baked|caught) today|(can|could|should) (I|we|you|one|children) [still] "
        "(eat|drink|bite|swallow) {thing}|has {thing} been in the fridge|when must {thing} be eaten",
        "how (fresh|ripe) {thing} is|when {thing} (expires|goes bad)|how long {thing} (keeps|lasts)|"
        "whether I can [still] eat {thing}|if {thing} has gone off",
        "freshness|expiry date|expiration date|best before date|ripeness|shelf life|sell by date|"
        "use by date|degree of ripeness",
        "[still|very|really|not yet|too|nearly] (fresh|ripe|edible|unripe|overripe|stale|rotten|"
        "mouldy|spoiled)|past its date|expired|gone bad|gone off|out of date|ripe enough to eat|"
        "ready to eat|fit to eat|organic|vegan|raw|cooked|home made|gluten free",
        "expire (today|soon|tomorrow|this week)|keep [long]|need (a fridge|cooling)|go off soon",
        "expires (today|soon|this week)|keeps [long]|has gone (bad|off)|goes off soon",
    ),
    _unfelt(
        "danger",
        "is {thing} {*states} or {*states}|how (dangerous|poisonous|toxic|harmful|healthy|clean|safe) "
        "is {thing} [to eat|for children|for me|for us]|(can|could|will|would) {thing} (hurt|harm|"
        "poison|kill|infect|explode|bite|cut) (me|us|you|someone|my {*people_words})|"
        "will {thing} (explode|catch fire|bite)|is it (safe|dangerous|healthy) to (eat|drink|touch|"
        "inhale|swallow|burn|wash) {thing}|are there (germs|bacteria|viruses|allergens) on {thing}|"
        "do I need gloves [for {thing}]|who is allergic to {thing}|am I allergic to {thing}|"
        "is {thing} good for (me|you|my health|children)|is {thing} [a] danger to (us|children|health)|"
        "can I give {thing} to (a child|my {*people_words}|a {*animals}|my dog)",
        "how (dangerous|poisonous|toxic|healthy|clean) {thing} is|whether {thing} is {*states}|"
        "if {thing} is (safe to eat|poisonous|toxic|healthy)",
        "danger|toxicity|health risk|hazard class|safety rating|hygiene|risk|germ count|"
        "nutritional benefit",
        "{*states}|[very|really|rather] (dangerous|harmful|poisonous|toxic|healthy|explosive|"
        "unhealthy|clean)|safe (for children|to eat|to drink|for pets)|bad for (me|you|health)|"
        "a (bomb|weapon|poison|danger|hazard)|good for you|full of germs|going to explode|inflammable",
        "contain (poison|germs|bacteria|alcohol|explosives)|cause (allergies|cancer|harm)|"
        "carry (a disease|germs)|bite|sting",
        "contains (poison|germs|alcohol|explosives)|causes (allergies|harm)|explodes|bites",
    ),
    _unfelt(
        "electricity",
        "how (magnetic|electric|radioactive|conductive) is {thing}|is {thing} ({*electrics}) or "
        "({*electrics})|how (much|many) (charge|power|current|volts|watts|amperes|voltage) (is on|is in|"
        "has|does|are on) {thing} [have|use|need]|what voltage (has|is|does) {thing} [have|need]|"
        "is (there|any) (current|power|voltage|electricity) (in|on) {thing}|is the battery (full|empty|"
        "dead|low)|(can|does) {thing} (conduct|store) (electricity|current|heat|power)|"
        "is {thing} (on|off) or (off|on)|will a magnet stick to {thing}|will {thing} shock me|"
        "is {thing} (plugged in|switched on|switched off|turned on|turned off)|how do I charge {thing}|"
        "how much radiation does {thing} give off|how long does the battery last",
        "how (magnetic|radioactive|conductive) {thing} is|how much (charge|power) {thing} has|"
        "what voltage {thing} has|whether {thing} is {*electrics}",
        "voltage|current|charge|battery level|magnetism|magnetic field|resistance in ohms|"
        "electrical resistance|conductivity|power consumption|radioactivity|radiation|capacity|"
        "wattage|polarity|frequency|battery life",
        "{*electrics}|[still|really|a bit] {*electrics}|plugged in|(switched|turned) (on|off)|"
        "on or off|under (power|voltage)|out of power|connected to (the network|power|the internet)",
        "conduct (electricity|current)|need (batteries|power|electricity|a charger)|have (bluetooth|"
        "wifi|a battery|a charge|power)|run on (batteries|solar power)|attract (iron|magnets)",
        "conducts electricity|needs (batteries|power)|has (bluetooth|a battery|power)|"
        "runs on batteries|attracts iron",
    ),
    _unfelt(
        "size",
        "how (long|tall|wide|high|big|large|thick) is {thing} (as a whole|altogether|in full|from end "
        "to end|in reality|all in all|as a whole object)|what is the (full|total|whole|overall|real) "
        "(size|length|height|width|volume) of {thing}|(how much|what) volume does {thing} have|"
        "(does|will|would) {thing} fit (in|into|through) (my pocket|the {*objects}|a {*objects}|"
        "the door|the box)|how many litres (does {thing} hold|fit in {thing})|"
        "how much of {thing} is (outside|beyond) your (view|touch|reach)|how big is the whole "
        "{*objects}|how long is the whole {*objects}|what is the diameter of the whole {*objects}|"
        "what size of (shoe|dress|shirt|hat) is {thing}|how far does {thing} stick out",
        "how (long|tall|wide|big|thick) {thing} is (as a whole|altogether|in full|from end to end)|"
        "what the (full|total|overall) (size|length|volume) of {thing} is",
        "full size|overall size|total length|overall length|whole length|total height|full height|"
        "overall width|total volume|full diameter|outer dimensions|overall dimensions|volume in litres",
        "(longer|taller|bigger|wider|shorter|smaller) than (a|an|my|the) {*objects}|life size|"
        "(bigger|longer) than (me|you|a {*animals})|as (tall|big|long) as a ({*animals}|{*objects})|"
        "too big for (my pocket|the {*objects}|the door)|full size|half a metre long",
        "fit (in|into) (my pocket|the {*objects}|the {*places})|have the size of a {*animals}",
        "fits into (my pocket|the {*objects})|has the size of a {*animals}",
    ),
    _unfelt(
        "surroundings",
        "what (is|stands|lies|hangs) (behind|beside|next to|near|around|above|under|in front of) "
        "{thing}|who is (in the {*places}|near {thing}|behind {thing}|behind you|watching us|there)|"
        "is the light on [in the {*places}]|how many ({*objects}|people|{*jobs}) are (in|on) the "
        "{*places}|where in the {*places} is {thing}|is (someone|anyone|anybody|a {*jobs}|my "
        "{*people_words}) (in the {*places}|near {thing}|in the room|there|watching)|"
        "are we alone [in the {*places}]|in which (room|building) (are we|is {thing})|"
        "how far is {thing} from the ({*places}|wall|door|{*objects})|is there (a|an|another) "
        "{*objects} (behind|next to|near|on|under) (it|{body}|the {*objects})|is it (dark|bright) in "
        "the {*places}|what else is (on|in) the {*places}|is the {*places} (open|closed|empty|busy)|"
        "how many {*objects} are (left|in the box|in stock)|where did I (put|leave) (my|the) {*objects}|"
        "where is (my|the other) {*objects}|which {*objects} is next to {thing}|are there other "
        "{*objects} [nearby]",
        "what is (behind|beside|next to|near|around|under) {thing}|who is in the {*places}|"
        "where in the {*places} {thing} is|how many {*objects} are (in|on) the {*places}|"
        "whether (someone|a {*jobs}) is in the {*places}",
        "surroundings|neighbourhood|environment|background|lighting|distance to the {*places}|"
        "place in the {*places}|room number|storage place",
        "(in|near|close to|far from) the {*places}|(behind|next to|beside|under) (the|a|another) "
        "{*objects}|on the {*places}|surrounded by {*objects}|alone in the {*places}|"
        "inside a building|outdoors|indoors|in the dark",
        "stand (in|near) the {*places}|lie next to (a|the) {*objects}|hang on the wall",
        "stands (in|near) the {*places}|lies next to (a|the) {*objects}|hangs on the wall",
    ),
    _unfelt(
        "print",
        "what is (written|printed|drawn|shown|engraved|painted|stamped) (on|onto) {thing}|"
        "what does (it|the label|the sticker|the tag|the inscription|the text|the print) (on {thing}|) "
        "(say|read|mean)|is there (a|an|any) (label|logo|text|barcode|picture|number|date|sticker|"
        "signature|warning|drawing) on {thing}|(can|could) you read (the label|the text|the barcode|"
        "what is written|it to me|what it says) [on {thing}]|which (logo|number|word|letter|language) "
        "is on {thing}|read the (label|text|barcode|inscription|print) [on {thing}]|"
        "what (logo|picture|text|number) does {thing} (have|carry|show)|scan the barcode [of {thing}]|"
        "in (what|which) language is the (label|text) [on {thing}]|is something (written|printed) on "
        "{thing}|which (page|chapter) is open|what stands on the label [of {thing}]",
        "what is (written|printed|drawn|engraved) on {thing}|what the label [on {thing}] says|"
        "what {thing} says|which (logo|number) is on {thing}",
        "label|inscription|print|logo|barcode|text|lettering|qr code|sticker|tag|engraving|"
        "warning label|title|handwriting|signature",
        "(labelled|printed|engraved|signed|marked|stamped|autographed) [with a (logo|name|number|"
        "date)]|written in {*languages}|printed in {*colours}|blank|written on",
        "have (a|an|any) (label|logo|text|barcode|inscription|sticker|picture|title|author)|"
        "(say|show|carry) (my|a) name|bear a signature",
        "has a (label|logo|barcode|inscription|sticker)|says something|carries a (logo|name)",
    ),
    _unfelt(
        "past",
        "who (touched|held|used|washed|cleaned|broke|dropped|saw) {thing} (before [us|me]|last|first|"
        "yesterday|this morning)|what happened to {thing} (before|yesterday|last week|last night|)|"
        "(was|has) {thing} (been|ever been|already been) (used|repaired|washed|dropped|opened|broken|"
        "cleaned|sold|tested|touched) [before]|where was {thing} (yesterday|before|last week|kept)|"
        "how many (people|times) (touched|have touched|used|have used) {thing}|"
        "what is the (story|history) of {thing}|has {thing} a (history|past)|who put {thing} "
        "(here|there|in the {*places})|when was {thing} last (used|washed|cleaned|checked|touched)|"
        "did (anyone|someone|my {*people_words}|the {*jobs}) (use|touch|drop|wash|repair) {thing}|"
        "how often was {thing} (used|washed|dropped)|what will happen to {thing} (later|tomorrow|next "
        "week)|who will (get|take|buy|use) {thing} (later|tomorrow)|are there fingerprints on {thing}",
        "who (touched|held|used|washed|dropped) {thing} (before|last|yesterday)|"
        "what happened to {thing} (before|yesterday)|where {thing} was (before|yesterday)|"
        "the story of {thing}",
        "history|past|story|future|fate|previous use|repair history|number of previous users|"
        "maintenance record|fingerprints",
        "used before|(washed|cleaned|repaired|dropped|tested|opened) (before|yesterday|recently|"
        "this morning)|used by (someone|my {*people_words}|a {*jobs})|touched by (a {*jobs}|others)|"
        "in the {*places} yesterday|dropped by someone|famous|here yesterday",
        "have a (story|history|past)|remember (me|us)|survive a fall from a roof",
        "has a (story|history|past)|was (used|dropped|washed|repaired) (before|yesterday)",
    ),
    _unfelt(
        "law",
        "is (it|this) (legal|allowed|forbidden|illegal) to (own|sell|carry|export|buy|eat|copy) {thing}|"
        "(may|can) (I|we) (legally|lawfully) (own|sell|carry|import|export|copy) {thing}|"
        "is {thing} (legal|illegal|banned|allowed) in {*countries}|do I need a (licence|license|permit) "
        "for {thing}|which (law|rule|norm|standard) (applies|is there) (to|for) {thing}|"
        "is there a patent on {thing}|who has the (patent|rights) (on|to) {thing}|"
        "(may|can) I take {thing} (on a plane|abroad|through customs|to {*countries})|"
        "which certificate does {thing} have|does the law allow {thing}|"
        "is {thing} (insured|under warranty|under guarantee)|can I return {thing}",
        "whether {thing} is (legal|illegal|allowed|banned)|which law applies to {thing}|"
        "if I need a licence for {thing}",
        "legal status|patent|licence|license|certificate|copyright|warranty period|customs duty|"
        "permit|trademark",
        "(legal|illegal|banned|allowed|forbidden|patented|licensed|certified|protected|restricted) "
        "[in {*countries}]|under warranty|protected by law|insured|subject to tax|a fake|genuine|"
        "an original|against the law|counterfeit",
        "need a (licence|license|permit|certificate)|have a (patent|certificate|warranty)|"
        "break the law|meet the standard",
        "needs a (licence|permit|certificate)|has a (patent|certificate|warranty)|breaks the law",
    ),
)
