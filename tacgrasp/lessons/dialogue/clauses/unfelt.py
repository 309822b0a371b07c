"""Questions about people's things that touch can't know, and requests that are not about the thing.

    Does the skin seem feverish to you?             unknown temperature.
    Has this loaf got rye in it?                    unknown inside.
    Is that my bracket or Marta's?                  unknown owner.
    Write a Python function.                        other.

A question that has a word of touch is none of these.

Not here: wordings that a grammar composes (``tacgrasp.lessons.dialogue.families.unfelt``).
"""

from __future__ import annotations

import re
from collections.abc import Mapping

from tacgrasp.lessons.dialogue.clauses.class_names import is_class_named

_TOUCH = re.compile(
    r"# (?:n|g|mm|percent|mn|kg|um|newtons?|grams?|milli\w+|micro\w+|kilos?)\b|\b(?:force|newtons?|"
    r"squeez\w+|press\w*|push\w*|depth|deep\w*|dent\w*|contact\w*|area|pad|gel|edges?|borders?|"
    r"rims?|shape\w*|form|texture\w*|band|limit|slip\w*|left|top|bottom|upper|lower|mm|micro\w+|"
    r"milli\w+|percent|grams?|g|kg|kilos?|center\w*|middle|indent\w*|patch|footprint|offset|"
    r"rough\w*|smooth\w*|ridged|bumpy|woven|x|y|tight\w*|loose\w*|sensor|fingertip|palm|weigh\w*|"
    r"mass|heav\w+|touch\w*|covered|coverage|lift\w*|carry|drop\w*|safe(?:ly)?|crush\w*|bruis\w+|"
    r"harder|softer|grip\w*|hold\w*|held|how (?:hard|firm\w*|strong\w*))\b"
)
_GRIPPED = re.compile(
    r" (?:(?:that )?(?:you|we) (?:are |have )?(?:gripping|holding|touching|feeling|pressing|"
    r"squeezing|got|hold|grip|have)(?: there|"
    r" here)?)\b"
)
_THING = re.compile(
    r"\b(?:it|this|that|these|those|he|she|they|him|her|his|its|them)\b|\b(?:my|our|your) \w+|"
    r"^(?:(?:is|are|was|were|does|do|did|has|have|had|will|would|could|might|can) |"
    r"(?:how (?:much|fresh|hot|cold|warm)|whose) (?:is|are|was|does|did|"
    r"do you (?:reckon|think|guess)) )(?:the|little) |"
    r"\bthe (?:little |poor |old )?(?:thing|object|guy|item|fellow|one|chap|bugger|lot)\b"
)
_TWO_KINDS = re.compile(
    r"(?:(?:is|are) (?:it|this|that|these|"
    r"those) )?(?:an? )?[a-z]{3,} (?P<kind>[a-z]{3,}) or (?:an? )?[a-z]{3,} (?P=kind)\b"
)
"""'tulip bulb or daffodil bulb'."""

_ASKING = re.compile(
    r"(?:(?:hey|hi|so|and|but|now|please|ok|okay|well|robot|oh|listen|tell me|say|do you know|"
    r"any idea|can you tell|could you tell me|i wonder|wondering) )*(?:is|are|was|were|does|do|did|"
    r"has|have|had|will|would|could|might|can|should|how|what|which|who|whose|where|when|any|got|"
    r"if|whether|think)\b"
)
_WARM = (
    r"feverish|fever|temperature|warm\w*|hot\w*|cold\w*|chill\w*|cool\w*|lukewarm|frozen|freezing|"
    r"defrost\w*|thaw\w*|heated|degrees|icy|tepid|burning|boil\w*|baked through|overheat\w*"
)
_UNKNOWN: Mapping[str, str] = {
    "owner": (
        r"\bwhose\b|\b(?:belongs?|belonging|owns?|owner|owned|borrow\w*|lent|stolen)\b|\b(?:is|was|"
        r"are) (?:it|this|that|these|those|the \w+) (?:\w+ )?(?:mine|yours|hers|ours|theirs)\b|"
        r"\b(?:my|your|his|her|our|their|[a-z]+'s) (?:\w+ ){1,4}or (?:[a-z]+'s|mine|yours|his|hers|"
        r"theirs|ours|(?:my|your|her|his) \w+'s?)\b|\bwho (?:left|lost|forgot|bought|brought|"
        r"dropped off)\b"
    ),
    "age": (
        r"\bhow (?:old|long ago|many (?:years?|months?|weeks?|days?|hours?|winters|summers))\b|"
        r"\b(?:born|birthday|expir\w+|best before|use by|sell by|shelf life|vintage|antique|"
        r"years? old|months? old|(?:what|which) (?:year|decade|century|era)|second hand|brand new|"
        r"manufactured in|dates? (?:from|back)|when (?:does|did|was|were|will|is) (?:it|this|that|"
        r"these|those|he|she|they|my|our|the) (?!.*\b(?:too|enough)\b)|how new|(?:its|the) age)\b"
    ),
    "price": (
        r"\b(?:cost|costs|costing|price[ds]?|pricey|pay|paid|dollars?|euros?|bucks|quid|cents|"
        r"charge[ds]?|expensive|cheap\w*|invoice[ds]?|bargain|discount\w*|resale|worth (?:a|any|"
        r"much|it|anything|more|the)|how much (?:is|are|was|were) (?:it|this|that|these|"
        r"the \w+)(?: worth)?$|set (?:me|us|you) back|going rate|sell for|sold for|"
        r"how much money)\b"
    ),
    "freshness": (
        r"\b(?:fresh\w*|stale|ripe\w*|unripe|overripe|rott\w+|mould\w*|moldy|spoil\w*|(?:has|"
        r"have) (?:it|this|that|these|they|the \w+) gone (?:off|bad)|going (?:off|bad)|"
        r"past its (?:best|prime)|still good to eat|wilted|curdled|rancid)\b"
    ),
    "temperature": rf"\b(?:{_WARM})\b",
    "inside": (
        r"\b(?:what|anything|something|anybody) (?:is |else is )?(?:in|inside|hidden in|"
        r"hiding in)(?: (?:it|this|that|there|here|the \w+|of (?:it|this|that)))?\b|"
        r"\b(?:contain\w*|filling|filled|stuff(?:ed|ing)|ingredients?|gluten|nuts?|peanuts?|"
        r"lactose|pips?|stone inside|seeds?|yolks?|made with|full or empty|empty or full|"
        r"hollow inside|batteries)\b|\b(?:got|have|has|having|with|any|is there|"
        r"are there) (?:\w+ ){1,3}in (?:it|this|that|there|them|these|the \w+)$|\b(?:vegan|"
        r"vegetarian|kosher|halal|organic|alcohol\w*)\b"
    ),
    "color": (
        r"\b(?:colou?r\w*|shade|hue|(?:is|are|look|looks|be) (?:\w+ ){1,3}(?:red|blue|green|yellow|"
        r"orange|purple|pink|brown|black|white|gray|golden|silver)|painted|shiny|glossy|"
        r"transparent|see through|translucent|dyed|faded)\b"
    ),
    "smell": r"\b(?:smell\w*|stink\w*|odou?rs?|scent\w*|perfume\w*|whiff|reek\w*|pong\w*|nose)\b",
    "taste": (
        r"\b(?:tast\w+|delicious|sweet\w*|sour|salty|bitter|spicy|edible|flavou?r\w*|yummy|juicy|"
        r"good to eat|seasoned)\b"
    ),
    "sound": r"\b(?:noisy?|noises?|loud\w*|rattl\w+|squeak\w*|humming|beep\w*|you hear|creak\w*|"
             r"(?:what|which|a|any) sound)\b",
    "maker": (
        r"\bwho(?: was it that)? (?:made|makes|manufactur\w+|built|designed|baked|machined|printed|"
        r"sew\w*|sewed|knitted|grew|painted|carved|assembled|welded|packed)\b|\b(?:manufacturer|"
        r"handmade|home made|hand made|mass produced|maker|brewed by|by which (?:firm|company))\b"
    ),
    "origin": (
        r"\bwhere (?:did|does|do|was|were|is|are) .*\b(?:come from|bought|made|grown|from|buy|get|"
        r"find|found|picked|originat\w+|sourced|harvested|caught)\b|\b(?:which|what) (?:country|"
        r"shop|store|farm|supplier|vendor|orchard|region|factory|warehouse|shelf|tree)\b|"
        r"\b(?:imported|homegrown|home grown|locally|(?:made|grown|produced) in)\b"
    ),
    "material": (
        r"\b(?:made (?:of|from|out of)|plastic|steel|wood|wooden|metal|metallic|aluminium|aluminum|"
        r"alloy|cotton|leather|silk|wool\w*|linen|polyester|glass|ceramic|porcelain|brass|bronze|"
        r"copper|rubber or|titanium|paper or|real (?:gold|silver|fur)|genuine|counterfeit|fake|"
        r"gold|concrete|nylon|which (?:fabric|material|metal|timber))\b"
    ),
    "danger": (
        r"\b(?:poison\w*|toxic|dangerous|explosive\w*|radioactive|infect\w+|contagious|allerg\w+|"
        r"venomous|bite me|harmful|hazardous|flammable|hygienic|sterile|germs|bacteria)\b"
    ),
    "print": (
        r"\b(?:written|printed|label\w*|barcode|engrav\w+|logo|inscri\w+|stamped|serial|qr code|"
        r"caption|what does it say|expiry date)\b"
    ),
    "past": (
        r"\b(?:which [a-z]+ (?:put|placed|left|dropped|brought|gave|picked|packed) (?:it|this|that|"
        r"the)|"
        r"who|which of (?:my|our|your|the|these|those|them) ?\w*|(?:did|has|have|was it|"
        r"does) (?:my|your|his|her|our|the|some|any)? ?(?:sister|brother|mother|mum|mom|dad|father|"
        r"wife|husband|boss|kids?|child(?:ren)?|son|daughter|neighbou?rs?|customer|colleagues?|"
        r"aunt|uncle|grandma|grandpa|granny|friend|team|somebody|someone|anybody|anyone|dog|cat|"
        r"baby|landlord|teacher|students?|doctor|nurse|supplier)) (?!.*\b(?:weather|"
        r"president)\b)\w+"
    ),
    "electricity": r"\b(?:magnetic|charged|plugged|electri\w+|conduct\w+|voltage|switched on|"
                   r"powered|wifi|bluetooth)\b",
    "name": (
        r"\b(?:(?:which|what) (?:brand|model|make|species|breed|variety|sort of (?:fruit|animal|"
        r"tool|fish|bird|plant|cheese|bread)|kind of (?:fruit|animal|tool|fish|bird|plant|cheese|"
        r"bread|apple|dog|cat)|type of (?:fruit|animal|tool|fish|bird|plant|cheese|bread)|batch|"
        r"lot)|brand|part number|model number|(?:its|his|her|the) name|called)\b"
    ),
    "trait": (
        r"\b(?:pulse|breath\w*|vaccinated|bak(?:ed|ing)|cooked|boiled|roasted|fried|raw|"
        r"(?:been|being|get|got) fired|heart ?beat|alive|dead|asleep|sick|ill|unwell|in pain|"
        r"hurting|scared|afraid|"
        r"happy|hungry|pregnant|ticklish|(?:boy or (?:a )?girl|male or female|he or (?:a )?she|"
        r"girl or (?:a )?boy)|tired|healthy|fragile|delicate|brittle|breakable|defective|broken|"
        r"out of order|work(?:s|ing)? (?:properly|"
        r"still)|still works?|waterproof|dishwasher|washable|clean|dirty|dusty|wet|damp|soaked|"
        r"sticky|greasy|beautiful|pretty|ugly|cute|popular)\b"
    ),
}  # fmt: skip
_ASKS = (
    r"(?:(?:please|kindly|hey|robot|now|ok|okay|just|so|be (?:so good|so kind|an angel|"
    r"a dear) (?:as to|and)|be good enough to|do me a favou?r and|(?:could|can|would|will) (?:you|"
    r"i)(?: (?:please|kindly|maybe|perhaps|ask you to))?|i (?:want|need|would like) you to|"
    r"i would be grateful if you would|help me(?: to)?|go|go and|go ahead and|let us|"
    r"any chance you could|mind) )*"
)
_REQUESTS = re.compile(
    _ASKS
    + r"(?:write|writing|compose|draft|translate|sing|recite|book|order|phone|call (?:me|my|a|"
    r"an)|text|email|play|set (?:a|an|the|my) (?:timer|alarm|reminder)|remind|schedule|recommend|"
    r"google|look up|buy|download|solve|prove|paint|code|program|debug|refactor|conjugate|spell|"
    r"rhyme|dance|cook|bake|invent|tell (?:me|us) (?:a|another|the) (?:joke|story|tale|riddle|"
    r"fairy tale)|summari[sz]e|proofread|turn (?:on|off|up|down) the|switch (?:on|off) the|"
    r"make (?:me )?(?:a|some|us) (?:coffee|tea|sandwich|pizza|website|app|playlist)) \w+.*"
)
_TOPICS = re.compile(
    r"\b(?:python|javascript|java|sql|html|css|algorithm|linked list|regex|spreadsheet|excel|"
    r"weather|forecast|rain(?:ing|y)?|sunny|snow(?:ing)?|president|prime minister|"
    r"capital (?:city )?of|world cup|football|soccer|tennis|cricket|basketball|league|championship|"
    r"olympics|match last|movies?|films?|netflix|lyrics|jokes?|poems?|haiku|limerick|sonnet|recipe|"
    r"stock market|shares? price|bitcoin|news|election|politic\w+|history of|planets?|galaxy|"
    r"horoscope|zodiac|flights?|hotels?|restaurants?|pizza|holidays?|vacation|homework|essay|"
    r"docker|password|pythagor\w+|shakespeare|einstein|dinosaurs?|meaning of life|square root|"
    r"prime numbers?|exchange rate|tax return|mortgage|wikipedia|traffic|what should i (?:cook|"
    r"wear|eat|watch|read|buy|give)|bus|train to|what day is|what time is it|who won|who wrote|"
    r"who discovered|who painted the)\b"
)


_OF_ANOTHER = re.compile(
    r"(?:(?:hey|so|and|now|please|robot|say|tell me) )*(?:"
    r"(?P<inside>how (?:much|many) (?:sugar|calories|vitamins?|protein|cholesterol|caffeine|salt|"
    r"fat|"
    r"acid\w*|water)\b.*|what is the (?:ph|(?:sugar|salt|fat|water) content)\b.*)|"
    r"(?P<friction>(?!.*#).*\b(?:(?:coefficient|angle|degree|amount) of (?:\w+ )?friction|friction "
    r"(?:coefficient|value|factor|angle|number))\b.*|how slippery .*|(?:what|how (?:much|high|"
    r"large|"
    r"big|strong))(?: is)?(?: the)? (?:\w+ )?friction\b.*)|"
    r"(?P<sight>what (?:does|do|is) .*\b(?:beyond|outside|past) the (?:edges?|borders?|rim|pad|"
    r"gel)\b.*)|"
    r"(?P<size>(?:(?:what is the |the )?(?:total|overall|full|whole|entire) (?:length|size|height|"
    r"width)|how (?:long|wide|tall|far|big|many \w+ (?:does|is|do)|much (?:of|does))).*"
    r"\b(?:stick\w*|pok\w+|protrud\w*|hang\w*|extend\w*|jut\w*) (?:out|beyond|past|over|off|"
    r"from)\b.*)|"
    r"(?P<electricity>(?:is|has|does|will|how (?:full|low)) [^#]*?\bbatter(?:y|ies)(?: \w+){0,3}? "
    r"(?:low|full|empty|flat|charged?|dead|left|life|level|holding|last|percent|got)\b.*)|"
    r"(?P<trait>(?:is|what is|how (?:high|low) is) [^#]*?\b(?:blood pressure|heart rate|"
    r"pulse rate)\b.*|(?:so )?(?:is|was|has|are|were|will|would|does|can|could|might|did) "
    r"(?:it|this|that|they|the \w+|my \w+) (?!.*\b(?:limit|cap|maximum|ceiling|band)\b)"
    r"(?:(?:been|got|get|be|have|already|badly|now|a bit) )*(?:bruise[ds]?|damaged?|break|broken|"
    r"crushed|squashed|crack(?:ed)?|tear|torn|hurt|burst|rupture[ds]?|survive)\b.*)|"
    r"(?P<price>(?:what|how much) [^#]*?\bper kilo(?:gram)? .*\b(?:market|town|shop|store)\b.*|"
    r"(?:what is|how high is) the (?:market price|salary|wage)\b.*))"
)
"""What has a number, but none of touch: 'how much sugar has it got per 100 g?'."""


_TRAIT_ALONE = re.compile(
    r"(?:(?:and|but|so) )*(?:what|which|the|what about the|how about the) (?P<what>colou?r|smell|"
    r"taste|temperature|price|brand|material|owner|age|sound|maker|origin)(?: please)?"
)
"""'And what colour?'"""


def names_touch(words: str) -> bool:
    """Whether words name something of touch: a quantity, the pad, the grip."""
    return _TOUCH.search(words) is not None


def is_off_topic(words: str) -> bool:
    """Whether words are about the world beside the gripper: weather, sports, a request."""
    return bool(_TOPICS.search(words) or _REQUESTS.fullmatch(words))


def unfelt_query(words: str) -> str:
    """The query of a question in plain words that touch can't answer; '' of any other question."""
    words = _GRIPPED.sub("", words)
    if other := _OF_ANOTHER.fullmatch(words):
        return f"unknown {next(name for name, said in other.groupdict().items() if said)}."
    if _TOUCH.search(words):
        return ""
    if is_off_topic(words):
        return "other."
    if "#" in words or " and " in words or is_class_named(words):
        return ""
    if _TWO_KINDS.match(words):
        return "unknown name."
    if trait := _TRAIT_ALONE.fullmatch(words):
        words = f"what is its {trait['what']}"
    if not _THING.search(words) or not _ASKING.match(words):
        return ""
    for subject, pattern in _UNKNOWN.items():
        if re.search(pattern, words):
            return f"unknown {subject}."
    return ""
