"""Families about what touch can't know of a thing: what other senses tell, its name and price.

Not here: its past and its circumstances (``backgrounds``), what has nothing to do with the contact
(``off_topic``).
"""

from __future__ import annotations

from collections.abc import Callable

from tacgrasp.lessons.dialogue.meaning import Meaning, Unknowable
from tacgrasp.lessons.dialogue.patterns.family import Bindings, Numbers, QuestionFamily, length_of
from tacgrasp.lessons.dialogue.subjects import SUBJECTS


def _unknown(subject: str) -> Callable[[Bindings, Numbers], Meaning]:
    return lambda bindings, _: Unknowable(subject=subject, length=length_of(bindings))


def unfelt(
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
    unfelt(
        "color",
        "(what|which) (color|shade|hue) (is|has|does) {thing} [have]|is {thing} {*colours} or "
        "{*colours}|how (bright|dark|pale|colorful|shiny|see-through|transparent) is {thing}|"
        "what color do you (see|think it is)|(what|which) color did they paint {thing}|"
        "(does|is) {thing} (shine|shining|glow|glowing|reflect light)|color [of {thing}]|"
        "can you see (through {thing}|the color)|in (what|which) color is {thing} [painted]|"
        "which colors does {thing} have|how many colors does {thing} have|{*colours} or {*colours}|"
        "is there (any|some) {*colours} on {thing}|what is the main color of {thing}|"
        "can you (tell|guess|name) the color|what color (would you say|do you think) {thing} is",
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
    unfelt(
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
    unfelt(
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
        "what is the word for {thing}|is {thing} the (right|same) one|which one is {thing}|"
        "is {thing} (a fruit|a vegetable|a tool|a toy|an animal|food) or (a vegetable|a fruit|a toy|"
        "a plant|a tool|something else)",
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
    unfelt(
        "price",
        "(how much|what) (does|did|would|will) {thing} cost [me|us]|how (expensive|cheap|valuable|"
        "costly|pricey|rare) is {thing}|what is {thing} worth|how many {*money} (is {thing} worth|"
        "does {thing} cost|for {thing})|(can|could|should) (I|we) (sell|afford|buy) {thing}|"
        "how much (did|do|would) (I|you|we|they) (pay|get|want|ask) for {thing}|"
        "how much is {thing} [worth|in {*money}]|what (would|could|does|might) {thing} (sell|go|be sold) for|"
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
    unfelt(
        "smell",
        "does {thing} (whiff|reek|smell) [of (anything|something|{*objects}|{*dishes})]|"
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
    unfelt(
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
    unfelt(
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
    unfelt(
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
    unfelt(
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
    unfelt(
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
)
