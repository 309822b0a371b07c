"""A question without what does not change what it asks: address, thanks, tags.

    Hang on, isn't something pressing on it?        is something pressing on it?
    We haven't gone past 1 mm, have we?             have we gone past 1 mm?
    There's nothing on the pad, is there?           is there anything on the pad?
    Could I trouble you for the depth?              give me the depth?
    Is the force above 0.5 pounds?                  is the force above 226.8 grams?
    depth < 300 µm?                                 depth less than 300 µm?

Before a tag, and in the verb that begins a question, a denial expects 'yes': it is taken out with
the tag. 'Is it not deep?' and 'It is not deep, right?' stay, which ask whether it is not.

Not here: wordings (``tacgrasp.lessons.dialogue.families``), spelling (``plain_words``).
"""

from __future__ import annotations

import re

from policies.instructions.quantities.numerals import in_digits
from tacgrasp.lessons.dialogue.multiplied_numbers import with_products
from tacgrasp.lessons.dialogue.turned_comparisons import turned

AUXILIARY = (
    r"(?:is|are|was|were|has|have|had|do|does|did|can|could|will|would|should|must|may|might|am|"
    r"shall)"
)
"""Verbs that may begin a question for yes or no, as a pattern."""

_SHORTENED = (
    r"(?:is|are|was|were|has|have|had|do|does|did|could|would|should|must|might|ca|wo|ai)n['’]?t"
)
_VERBS_OF = {"ca": "can", "wo": "will", "ai": "is"}
_DENIED = re.compile(rf"\b(?:{_SHORTENED}|{AUXILIARY} ?not)\b", re.I)
_DENIED_FIRST = re.compile(rf"{_SHORTENED}\b", re.I)
_TAG = re.compile(
    rf"\s*[,;–—-]\s*(?:or )?\b(?:{AUXILIARY}|(?P<denied>{_SHORTENED})) "
    r"(?:it|we|they|there|this|that|these|those|one|i|"
    r"(?<!can )(?<!could )(?<!will )(?<!would )you)(?P<not> not)?\s*[?.!]*$",
    re.I,
)
_NEGATIVES = {"nothing": "anything", "nobody": "anybody", "none": "any", "no": "any"}
_NEGATIVE = re.compile(rf"\b(?:{'|'.join(_NEGATIVES)})\b", re.I)
_CONTRACTED = (
    (re.compile(r"\b(it|that|there|this|here)['’]s\b", re.I), r"\1 is"),
    (re.compile(r"\b(we|they|you)['’]re\b", re.I), r"\1 are"),
    (re.compile(r"\b(i|we|they|you)['’]ve\b", re.I), r"\1 have"),
    (re.compile(r"\bi['’]m\b", re.I), "I am"),
    (re.compile(r"\b(i|we|they|you|it|that|this|there)['’]ll\b", re.I), r"\1 will"),
    (re.compile(r"\b(we|they|you|it|that|this|there)['’]d\b", re.I), r"\1 would"),
)
_STATED = re.compile(
    rf"(?P<subject>(?:[\w'’-]+ ){{1,7}}?)(?P<verb>{AUXILIARY}) (?P<rest>.+)", re.I | re.S
)
_OPENS = re.compile(rf"(?:{AUXILIARY}|what|how|which|where|why|who|when)\b", re.I)
_ADDRESS = re.compile(
    r"(?:(?:ok(?:ay)?|so|well|right then|now then|hang on|hold on|wait|hey(?: \w+)?|hi(?: \w+)?|"
    r"hello(?: \w+)?|robot|um+|uh+|er+m?|sorry|excuse me|please|quick question|tell me|listen|look|"
    r"unless i(?:['’]m| am) (?:very much )?(?:mistaken|wrong)|if i(?:['’]m| am) not (?:mistaken|"
    r"wrong)|"
    r"actually|by the way|good (?:morning|afternoon|evening)|just checking|just curious|"
    r"one more thing|one more question|(?:i|we) (?:would like|want|need|wish) to "
    r"(?:confirm|check|verify|ask|be sure|make sure|know)|but|oh|yo|buddy|mate|my friend|"
    r"dear \w+|(?:mister|mr) \w+|\w+(?: \w+)? (?:asks|wants to know|would like to know))"
    r"\s*[,:;!.…–—-]+\s+)+",
    re.I,
)
_THANKS = re.compile(
    r"[\s,.]+(?:please|quick|quickly|pls|plz|thanks|thank you|thx|mate|buddy|robot|"
    r"(?:mister|mr|dear) \w+|sir|my friend|"
    r"(?:young|old|good|dear|clever|my) (?:man|lady|fellow|boy|girl|chap|lad|machine|robot|sir)|"
    r"boss|doc|chief|pal|dude|bro|man|captain|"
    r"if you (?:please|would|do not mind|don['’]t mind))\s*[?.!]*$",
    re.I,
)


_POLITE_VERB = re.compile(
    r"(?:would|could|can|will) you (?:please )?(?:be so kind as to|be kind enough to) |"
    r"(?:is it|would it be) (?:fair|right|correct|safe) to (?:write|say|note|state) that ",
    re.I,
)
_SIGNS = (
    (
        re.compile(
            r"(?P<low>\d+(?:[.,]\d+)?(?: ?[a-zµ%²]+)?) ?(?:<=?|≤) ?(?P<what>(?:the )?[a-zδ]+) ?"
            r"(?:<=?|≤) ?(?=\d)(?P<high>[\d.,]+)",
            re.I,
        ),
        r"\g<what> between \g<low> and \g<high>",
    ),
    (
        re.compile(
            r"(?P<high>\d+(?:[.,]\d+)?(?: ?[a-zµ%²]+)?) ?(?:>=?|≥) ?(?P<what>(?:the )?[a-zδ]+) ?"
            r"(?:>=?|≥) ?(?=\d)(?P<low>[\d.,]+(?: ?(?:m?n|mm|[µu]m|g|%)\b)?)",
            re.I,
        ),
        r"\g<what> between \g<low> and \g<high>",
    ),
    (re.compile(r"\|\s*([xy])\s*\|", re.I), r"abs \1"),
    (re.compile(r"(?:(?<=^)|(?<=\s))[-−]\s?(?=[xy]\b)", re.I), "minus "),
    (re.compile(r"\b(limit|ceiling) ?[-−] ?(?=(?:the )?force\b)", re.I), r"\1 minus "),
    (re.compile(r" ?(?:!=|≠) ?"), " is not "),
    (re.compile(r"(?<=\d) ?[x×] (?=(?:the|its|my|our|that) )"), " times "),
    (re.compile(r"(?<![\w.]) ?\((?:F|δ|d) ?/ ?(?:A|F|δ)\)"), ""),
    (re.compile(r"\b[Ff]_?(?:lim(?:it)?|max)\b"), "the limit"),
    (re.compile(r"\bp_?mean\b"), "mean pressure"),
    (re.compile(r"\bF ?/ ?(?=δ)"), "the force divided by "),
    (re.compile(r"δ ?/ ?(?=F\b)"), "the depth divided by "),
    (re.compile(r"(?<![\w°])(?<![\d°] )(?<!degrees )F(?![\w'’-])"), "the force"),
    (re.compile(r"(?<![\w°])δ(?!\w)"), "the depth"),
    (re.compile(r"(?<=abs [xy])\s*\+\s*(?=abs [xy])", re.I), " plus "),
    (re.compile(r" ?(?:>=|≥) ?"), " at least "),
    (re.compile(r" ?(?:<=|≤) ?"), " at most "),
    (re.compile(r" ?&+ ?"), " and "),
    (re.compile(r" ?> ?"), " more than "),
    (re.compile(r" ?< ?"), " less than "),
    (re.compile(r" ?[~≈∼] ?(?=[\d.])"), " about "),
)
_BAND_S_ENDS = re.compile(r"\b(?:the|its|our) (?:force )?band['’]s (?:two |both )?ends\b", re.I)
_CLEFT = re.compile(
    r"(?:is|would) it (?P<offered>[^?,]+ or [^?,]+?) (?:that|which) "
    r"(?P<who>(?:we|it|you)|the \w+) (?P<verb>are|is|lies?|sits?) (?P<rest>[^?,]+)",
    re.I,
)
"""'Is it the low or the high end that we are closer to?' asks whether we are closer to ..."""

_COORDINATE = re.compile(
    r"(?<=\bis )[xy](?= from (?:the |its )?(?:left|right|top|bottom|upper|lower) "
    r"(?:border|edge|rim|side)\b)",
    re.I,
)
_POLITE = re.compile(
    r"(?:(?:could|can|may|might) (?:i|we) (?:trouble|bother|ask) you (?:for|to (?:tell|give) me)|"
    r"i (?:would|['’]d) be (?:most |very )?(?:grateful|obliged|glad|thankful) (?:for|to have))\s+",
    re.I,
)
_PURPOSE = re.compile(
    r",? (?:just the (?:figure|number),? )?so (?:that )?(?:i|we) (?:may|can|could) .*$", re.I
)
_RIGHT = re.compile(
    r"[,;–—-] (?:is|am) (?:it|that|this|i) (?:correct|right|true|so)(?=\s*[?.!]*$)", re.I
)
_CHOICE_TAG = re.compile(
    r"(?<=\w), (?:no|yes|right|correct|(?:what )?(?:would|do) you (?:say|think|reckon|guess))"
    r"(?=[?.! ]*$)",
    re.I,
)
_ADDED = re.compile(
    r",? (?:rounded )?(?:to|with) (?:\w+|\d) (?:decimals?|decimal places|digits|"
    r"significant (?:figures|digits))|"
    r"\bboth (?=\w+ and (?!\w+ (?:in|is|are)\b))|"
    r"\beither (?!(?:of (?:these|them|the two)|holds?)\b)(?=.* or )|\ball (?=in \w+\W*$)|"
    r"\bnumerically |"
    r",? both (?:taken|measured|expressed|counted)? ?in newtons(?=\W*$)|"
    r"\beven (?=(?:bigger|larger|deeper|more|larger|smaller|less)\b)",
    re.I,
)
_SUPERIOR, _INFERIOR = (re.compile(rf"\b{word} to\b", re.I) for word in ("superior", "inferior"))
_AS_REFERENCE = re.compile(
    r"(?:taking|using|with) (?P<mark>[^,?]+?) as (?:my|the|our|a|your) (?:reference|yardstick|"
    r"dividing line|threshold|benchmark|baseline|mark|cut-?off|line)(?: (?:point|value|mark))?,? "
    r"(?P<asks>[^,?]+\b(?:above or below|below or above|over or under|under or over|more than|"
    r"less than|above|below|over|under|deeper than|beyond|past)) (?:it|that|this)\b(?P<rest>.*)",
    re.I,
)
"""'Taking 0.4 mm as the dividing line, is it above that?'"""

_MEANING = re.compile(
    r"\b[a-z-]+,? (?:meaning|which means|by which i mean) "
    r"(?=(?:under|over|less|more|below|above|at least|at most|between|within)\b)",
    re.I,
)
"""'Shallow, meaning under half a millimetre', which is what is meant."""

_THOU = re.compile(r"\bthousandths? of an inch\b", re.I)
_PER_SECOND = r"(?: ?(?:m ?/ ?s(?:²|\^?2)|N ?/ ?kg|met(?:re|er)s per second squared))"
_GRAVITY = (
    r"(?:(?:the )?(?:g|gravity) ?(?:=|:|as|at|of|is|being|taken as|set (?:to|at)|equals?(?: to)?) ?"
    rf"9[.,]8\d*{_PER_SECOND}?|9[.,]8\d*{_PER_SECOND})"
)
_UNIT_NAME = (
    r"(?:psi|m?bar|atm|[khm]?pa|(?:kilo|mega)?pascals?|mmhg|torr|n/[cm]m²|[mkc]?n|"
    r"(?:milli)?newtons?|"
    r"kgf|lbf|ozf|dyn(?:es?)?|kiloponds?|(?:pounds?|ounces?|lbs?|oz|grams?|kilograms?|kilos?|k?g)"
    r"(?:[- ](?:of )?force)?|inch(?:es)?|in|thou|mils?|[mcµn]m|milli?met(?:re|er)s?|microns?|"
    r"centimet(?:re|er)s?|ml|µl)"
)
_CONVERSION = (
    rf"(?:1|an?|one) {_UNIT_NAME} ?(?:=|≈|is|being|equals|makes) (?:about |roughly )?"
    rf"\d*[.,]?\d+ {_UNIT_NAME}"
)
_CONSTANT = re.compile(
    rf" ?\((?:(?:with|at|using|taking) )?(?:{_GRAVITY}|{_CONVERSION})\)|"
    rf",? ?\b(?:with|at|using|use|taking|take|for|assuming|given|and) {_GRAVITY}(?:[,;:]|\b)|"
    rf"(?:(?<=[.?!] )|^){_CONVERSION}[,;.] ?",
    re.I,
)
"""'(g = 9.81 m/s²)', 'One psi being 6.895 kPa,': what a question says of units is known."""

_SQUARED = re.compile(
    r"\b(?:(?P<mm>mm|millimet(?:re|er)s?)|cm|centimet(?:re|er)s?)"
    r"(?:(?P<two> ?squared| ?\^ ?2|2)|3| ?cubed| ?\^ ?3)(?!\w)|"
    r"\bcubic (?:(?P<cubic>mm|millimet(?:re|er)s?)|cm|centimet(?:re|er)s?)\b",
    re.I,
)
_NUMERO = re.compile(r"\b(serial|phone|part|item|order|batch|lot|model) no\.", re.I)
"""'Serial no. of the part'."""

_WHICH_ONE = re.compile(r"\bwhich one(?:['’]s| is) ", re.I)
_CONVERT = re.compile(
    r"^(?:please )?(?:convert|express|translate|turn) (?P<what>(?:the |its |our )?[a-z ]+?) "
    r"(?:to|into|in|as) (?:(?:an? |the |its )?(?:(?P<made>weight|force)|load|value|figure) in )?"
    r"(?P<unit>[cmk]?n|[cmµ]?m|(?:milli|centi|kilo)?newtons?|microns?|"
    r"inch(?:es)?|(?:milli|centi|micro)met(?:re|er)s?|k?g|(?:kilo)?grams?|ounces?|pounds?|"
    r"percent)(?=[?.! ]*$)",
    re.I,
)
_ITS_TOPIC = re.compile(
    r"^(?:(?:and|so|now|as for|what about) )*(?:the |its |our )?(?P<topic>(?:contact |grip |felt )?"
    r"(?:force|depth|area|shape|texture|surface|position|indentation))[,.:;–—-]+ "
    rf"(?P<verb>{AUXILIARY}) (?:it|that|this)(?= )",
    re.I,
)
"""'The force, is it inside the band?' asks about one thing."""

_HAPPENS = re.compile(
    r"^(?:you )?(?:would(?:n['’]t)?|do(?:n['’]t)?|might) (?:you )?(?:not )?(?:by (?:any )?chance )?"
    r"happen to (?:be )?(?:holding|hold|have|touching|touch|feeling|feel|gripping|grip) "
    r"(?=an? |any|something )",
    re.I,
)
"""'You wouldn't happen to be holding something round?', which asks whether it is."""

_QUOTED = r"['\"“‘](?P<{}>[a-z]+(?:[ -][a-z]+)?)['\"”’]"
_WORD_FITS = re.compile(
    rf"{AUXILIARY}(?:n['’]t)? {_QUOTED.format('a')} (?:be )?(?:the|an?|your) (?:right |correct |"
    rf"fitting |proper )?"
    r"(?:word|term|label|adjective|description)\b[^?]*\??|"
    rf"{AUXILIARY}(?:n['’]t)? (?:the |that |this )?(?:word|term|label|adjective|description) "
    rf"{_QUOTED.format('b')} [^?]*\??|"
    rf".*\b(?:earns?|deserves?|merits?|gets?|fits?|matches|warrants?) (?:the )?(?:word|term|label|"
    rf"grade|name|"
    rf"description) {_QUOTED.format('d')}[^?]*\??|"
    rf"{_QUOTED.format('c')}\W+(?:{AUXILIARY}) (?:that|this|it) (?:(?:the|a|your) )?(?:right |"
    rf"correct )?"
    r"(?:word|term|label|adjective|description)\b[^?]*\??",
    re.I,
)
"""'Is "centered" the word for where it is?', which asks whether it is centered."""

_TERSE = re.compile(
    rf"\d+(?:[.,]\d+)? ?{_UNIT_NAME} (?:(?:over|above|past|beyond|under|below|beneath|within|"
    r"inside|in|outside(?: of)?|out of|(?P<exceeds>exceeds?)) (?:the |our |my )?"
    r"(?:force |target |safe )?"
    r"(?:limit|max(?:imum)?|cap|ceiling|band|range|window|zone|goal|target)|"
    r"too (?:much|little|high|low|strong|weak)|allowed|permitted)[?.! ]*",
    re.I,
)
"""'1500 mN over limit?', which asks whether it is."""

_AND_STAY = re.compile(
    r"^(?P<asks>how (?:much|far|many)\b[^,;?]*?),? (?:and|while|but|yet) (?:still )?(?:be|being|"
    r"stay|"
    r"staying|remain|remaining|keep|keeping)(?: still)? (?:in|inside|within|below|under|"
    r"beneath) (?=(?:the |our |my )?(?:\w+ )?(?:(?P<band>band|range|window)|limit|cap|ceiling)\b)",
    re.I,
)
"""'How much can I add and still be in the band?', which asks how much before leaving it."""

_MAXIMUM = re.compile(r"\b(?:(?:the|our|my) )?max(?:imum)?\b", re.I)

_NUMBER = r"(?<![\d.,])(\d+(?:\.\d+)?)"
_FOREIGN = (
    (r"(?:grams?[ -](?:of )?force|gf)\b", 9.80665e-3, "newtons"),
    (r"(?:lbf|(?:pounds?|lbs?)[ -](?:of )?force)\b", 4.4482216, "newtons"),
    (r"(?:ozf|(?:ounces?|oz)[ -](?:of )?force)\b", 0.27801385, "newtons"),
    (r"(?:pounds?|lbs?)\b", 453.59237, "grams"),
    (r"(?:ounces?|oz)\b", 28.349523, "grams"),
    (r"(?:kgf|kp|kilograms?[ -](?:of )?force|kiloponds?)\b", 9.80665, "newtons"),
    (r"(?:kn|kilonewtons?)\b", 1000, "newtons"),
    (r"(?:[µu]n|micronewtons?)\b", 1e-6, "newtons"),
    (r"(?:dyn|dynes?)\b", 1e-5, "newtons"),
    (
        r"(?:cm²|cm2|cm\^2|(?:square|sq\.?) ?(?:cm|centimet(?:re|er)s?))",
        100,
        "mm²",
    ),
    (r"(?:inch(?:es)?|in(?=\.?$| deep| (?:of|from|off|to)\b))", 25.4, "mm"),
    (r"(?:thou|mils?)\b", 0.0254, "mm"),
    (r"(?:m|met(?:re|er)s?)\b(?![²^/])", 1000, "mm"),
    (r"(?:nm|nanomet(?:re|er)s?)\b", 1e-6, "mm"),
)
_IN_FOREIGN_UNITS = tuple(
    (re.compile(rf"(?:{_NUMBER}\s*-?|\b(?:an?|one)[ -]){unit}", re.I), size, known)
    for unit, size, known in _FOREIGN
)
"""Numbers in units that no query has: the unit's size, and the unit that has it."""


def in_words(question: str) -> str:
    """A question with words for its signs, which plain words lack: 'x > 1' is not 'x 1'."""
    for sign, words in _SIGNS:
        question = sign.sub(words, question)
    return question


def about_its_topic(question: str) -> str:
    """A question about what it names first: 'the force, is it ...' becomes 'is the force ...'."""
    return _ITS_TOPIC.sub(r"\g<verb> the \g<topic>", question)


def is_denied_first(question: str) -> bool:
    """Whether a question begins with a denied verb, which expects 'yes': 'isn't it deep?'."""
    return _DENIED_FIRST.match(question) is not None


_HOWS = re.compile(
    r"\b(?P<how>(?:how (?:far|deep|big|large|hard|wide|high)|where))['’]s "
    r"(?=the |it |this |that |my )",
    re.I,
)
_HOW_FAR_AWAY = re.compile(r"(?<=\bhow far) away(?= (?:is|are|was|am)\b.*\bfrom\b)", re.I)
_UNIT_BEHIND = re.compile(
    r"\?\s+(?:(?:give it |answer )?in )?(?P<unit>newtons?|N|mN|millinewtons?|mm|millimet(?:re|"
    r"er)s?|"
    r"microns?|µm|grams?|percent|cm|centimet(?:re|er)s?)(?:,? please)?[.?! ]*$"
)
"""'What force lies in the middle of the band? Newtons.'"""


_ALSO_IN = re.compile(
    r"(?P<asked>[^?]+)\?\s+(?:and|also|and also),? in (?P<unit>[a-zµ]+²?)"
    r"(?:,? (?:please|too))?[.?! ]*",
    re.I,
)
"""'How deep is it? And in inches?', in one line."""


_THOUSANDS = re.compile(
    r"(?<![\d.,])[1-9]\d{0,2}(?:(?:,\d{3})+|(?:['’ \u00a0\u202f]\d{3})+)(?![\d,])(?=(?:\.\d+)? ?"
    r"(?:g|gr|grams?|mg|kg|mn|millinewtons?|n|newtons?|[µu]n|[µu]m|microns?|micromet\w+|mm²|mm2)\b)",
    re.I,
)
"""'1,200 g', '3 500 mN'; '1,200 mm' is a decimal comma."""


_SECOND_BOUND = re.compile(
    rf"(?P<first>\d ?(?P<unit>[mc]m(?:²|2)|{_UNIT_NAME}|%|per ?cent)(?:,? (?:and|but|or)|,)"
    r"(?: (?:also|still|yet|is|it is|is it|not))* (?:more|less|greater|smaller|fewer|higher|lower|"
    r"deeper|shallower|larger|bigger|heavier|lighter|stronger|weaker|over|above|under|below|beyond|"
    r"exceeding|at least|at most|no more|no less|up to)(?: than)? (?:about )?\d+(?:\.\d+)?)"
    r"(?=\s*(?:$|[?!;]|\.(?!\d)|,? (?:right|or not|yes|is it|isn't it)\b))",
    re.I,
)
"""'Less than 500 microns and more than 300'."""


def with_plain_numbers(text: str) -> str:
    """A text whose numbers have nothing between their thousands, and a second bound its unit.

    '1200 g' for '1,200 g', 'below 500 µm and above 300 µm' for 'below 500 µm and above 300'.
    """
    text = _THOUSANDS.sub(lambda number: re.sub(r"\D", "", number[0]), text)
    return _SECOND_BOUND.sub(r"\g<first> \g<unit>", text)


def plainer(question: str) -> str:
    """A question without address, thanks and tag, and without the denial that expects 'yes'."""
    question = _HOW_FAR_AWAY.sub("", _HOWS.sub(r"\g<how> is ", question))
    question = _ALSO_IN.sub(r"\g<asked>? \g<asked> in \g<unit>?", question)
    question = _UNIT_BEHIND.sub(lambda unit: f" in {unit['unit']}?", question)
    text = _THOU.sub("thou", " ".join(_CONSTANT.sub("", question).split()))
    text = _SQUARED.sub(
        lambda each: (
            f"{'mm' if each['mm'] or each['cubic'] else 'cm'}{'²' if each['two'] else '³'}"
        ),
        text,
    )
    text = _INFERIOR.sub("below", _SUPERIOR.sub("above", _MEANING.sub("", text)))
    text = _BAND_S_ENDS.sub("both ends of the band", _COORDINATE.sub("it", text))
    text = _CLEFT.sub(r"\g<verb> \g<who> \g<rest> \g<offered>", text)
    text = _WHICH_ONE.sub("which is ", text)
    text = _CONVERT.sub(
        lambda each: f"give me {each['made'] or each['what']} in {each['unit']}", text
    )
    text = _NUMERO.sub(r"\1 number", metric(text))
    if opening := _ADDRESS.match(text):
        text = text[opening.end() :]
    text = _ADDED.sub("", _POLITE_VERB.sub("", text, count=1))
    text = _HAPPENS.sub("is it ", text)
    if fits := _WORD_FITS.fullmatch(text):
        text = f"is it {fits['a'] or fits['b'] or fits['c'] or fits['d']}?"
    text = _AS_REFERENCE.sub(r"\g<asks> \g<mark>\g<rest>", text)
    if (right := _RIGHT.search(text)) and not _DENIED.search(text) and not _NEGATIVE.search(text):
        text = f"{text[: right.start()]}, is it?"
    text = _PURPOSE.sub("", _POLITE.sub("give me ", _THANKS.sub("", text), count=1))
    if terse := _TERSE.fullmatch(text):
        text = _MAXIMUM.sub("the limit", f"{'does' if terse['exceeds'] else 'is'} {text}")
    text = _AND_STAY.sub(
        lambda stay: f"{stay['asks']} before {'leaving' if stay['band'] else 'we reach'} ", text
    )
    if tag := _TAG.search(text):
        text = _asked(text, tag)
    if " or " in text:
        text = _CHOICE_TAG.sub("", text)
    if denied := _DENIED_FIRST.match(text):
        text = f"{_affirmed(denied[0])}{text[denied.end() :]}"
    return turned(text) or question


def metric(text: str) -> str:
    """A text with words for signs, and numbers in units that queries have."""
    text = with_products(in_words(text))
    digits = in_digits(text.lower())
    known = digits
    for pattern, size, unit in _IN_FOREIGN_UNITS:
        known = pattern.sub(lambda match: f"{_plain(float(match[1] or 1) * size)} {unit}", known)  # noqa: B023
    return text if known == digits else known


def _plain(number: float) -> str:
    """Four digits of a number, without an exponent."""
    return f"{float(f'{number:.4g}'):.10f}".rstrip("0").rstrip(".")


def _asked(text: str, tag: re.Match[str]) -> str:
    """What a statement with a tag asks; the text itself where its verb is not found."""
    stated = text[: tag.start()]
    if _OPENS.match(stated):
        return text
    for pattern, whole in _CONTRACTED:
        stated = pattern.sub(whole, stated)
    if not (tag["denied"] or tag["not"]):
        if denied := _DENIED.search(stated):
            stated = f"{stated[: denied.start()]}{_affirmed(denied[0])}{stated[denied.end() :]}"
        else:
            stated = _NEGATIVE.sub(lambda match: _NEGATIVES[match[0].lower()], stated, count=1)
    if (found := _STATED.fullmatch(stated)) is None:
        return text
    return f"{found['verb']} {found['subject'].strip()} {found['rest']}?"


def _affirmed(denied: str) -> str:
    """A denied verb without its denial: 'can't', 'can not' and 'cannot' become 'can'."""
    verb = re.sub(r"(?: ?not|n['’]?t)$", "", denied.lower())
    return _VERBS_OF.get(verb, verb)
