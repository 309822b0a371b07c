"""Families about the background of a thing, which touch can't know: material, age, owner, use, law.

Not here: what other senses tell (``unanswerable``).
"""

from __future__ import annotations

from tacgrasp.lessons.dialogue.families.unfelt.traits import unfelt
from tacgrasp.lessons.dialogue.patterns.family import QuestionFamily

FAMILIES: tuple[QuestionFamily, ...] = (
    unfelt(
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
    unfelt(
        "age",
        "how (many|few) (days|hours|weeks|months|years) ago was {thing} (picked|made|harvested|bought|caught|baked|"
        "delivered|built|produced)|how long ago was {thing} (picked|made|harvested|bought|baked)|how many (days|hours|"
        "weeks) (has|have) passed since {thing} was (picked|made|harvested|bought)|"
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
    unfelt(
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
    unfelt(
        "maker",
        "who (made|makes|designed|built|produced|manufactured|sells|baked|grew|painted) "
        "{thing}|(which|what) {*makers} (made|sells|makes|built|produces) {thing}|"
        "by (whom|which {*makers}) was {thing} (made|designed|built|produced)|maker [of {thing}]|"
        "who is the (maker|manufacturer|designer|producer|inventor) of {thing}|"
        "did (you|a machine|a {*jobs}) make {thing}|how was {thing} (made|produced|manufactured)|"
        "(which|what) (company|brand|firm|factory) (made|manufactured|makes|built|is behind) {thing}|"
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
    unfelt(
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
    unfelt(
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
    unfelt(
        "danger",
        "(will|would|could|can) (I|we|you|someone|my {*people_words}) (get|become|be|fall) (sick|ill|poisoned|hurt) "
        "[if (I|we|you|they) (eat|touch|lick|drink|bite) {thing}|from (eating|touching) {thing}]|"
        "(does|will|would) {thing} make (me|us|you|people) (sick|ill)|"
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
    unfelt(
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
    unfelt(
        "size",
        "how (long|tall|wide|high|big|large|thick) is {thing} (as a whole|altogether|in full|from end "
        "to end|in reality|all in all|as a whole object)|what is the (full|total|whole|overall|real) "
        "(size|length|height|width|volume) of {thing}|(how much|what) volume does {thing} have|"
        "(does|will|would) {thing} fit (in|into|through) (my pocket|the {*objects}|a {*objects}|"
        "the door|the box)|how (tall|big|long|wide) is the whole (thing|object|part)|"
        "how many litres (does {thing} hold|fit in {thing})|"
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
    unfelt(
        "surroundings",
        "how many (more|other) {*objects} (are|lie|wait|are waiting|stand) (in|on|under|behind|beside) (the|that|this) "
        "(crate|box|basket|tray|belt|bin|{*places}) [behind it|behind {thing}|next to it]|how many (more|others) (are there|"
        "are left|are waiting|are still to come|are to come)|how full is the (crate|box|basket|tray|bin)|"
        "what (is|stands|lies|hangs) (behind|beside|next to|near|around|above|under|in front of) "
        "{thing}|who is (in the {*places}|near {thing}|behind {thing}|behind you|watching us|there)|"
        "is the light on [in the {*places}]|how many ({*objects}|people|{*jobs}) are (in|on) the "
        "{*places}|where in the {*places} is {thing}|is (someone|anyone|anybody|a {*jobs}|my "
        "{*people_words}) (in the {*places}|near {thing}|in the room|there|watching)|"
        "are we alone [in the {*places}]|is there (anyone|anybody|someone|somebody|a person) "
        "[else] (here|there|around|nearby|in the room|in the {*places})|in which (room|building) (are we|is {thing})|"
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
    unfelt(
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
    unfelt(
        "past",
        "who (touched|held|used|had|washed|cleaned|broke|dropped|saw) {thing} (before [us|me]|last|first|"
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
    unfelt(
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
