"""Follow-ups written anew, with the words of the question before them, so that they stand alone.

    What if I add 0.2 N?             And 0.9 N?          What if I add 0.9 N?
    What if I add 0.9 N?             Is that too much?   If I add 0.9 N, is the force too much?
    If I double it, are we over?     And if I halve it?  If I halve it, are we over?
    Does it touch the left edge?     And the right?      Does it touch the right edge?
    What is the limit?               Are we over it?     Are we over the limit?
    How far is it from the middle?   From the left edge? How far is it from the left edge?

Each is a proposal: whether it means anything is for the reader of questions to say.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from cltp.tactile.states import CLASSES
from policies.instructions.quantities.numerals import in_digits
from tacgrasp.lessons.dialogue.meaning import (
    Amount,
    Calculated,
    Check,
    Meaning,
    Several,
    Which,
    names_of,
    truth_of,
)
from tacgrasp.lessons.dialogue.quantities import UNITS
from tacgrasp.lessons.turns.leads import without_lead

_LEAD = (
    r"(?:(?:and|n|but|or|so|ok|okay|well|then|now|no|sorry|what about|how about|i meant?|"
    r"make (?:it|that))[, ]+)*"
)
_END = (
    r"(?:[, ]+(?:then|instead|please|pls|now|more|extra|too|as well|at least|sorry|next|first|"
    r"right))*[?.! ]*"
)

_UNIT_WORDS = {
    "N": r"N|newtons?",
    "mN": r"mN|millinewtons?",
    "g": r"g|grams?|gr",
    "kg": r"kg|kilos?|kilograms?",
    "oz": r"oz|ounces?",
    "lb": r"lbs?|pounds?",
    "%": r"%|percent|per cent",
    "mm": r"mm|millimet(?:re|er)s?",
    "µm": r"µm|um|microns?|micromet(?:re|er)s?",
    "cm": r"cm|centimet(?:re|er)s?",
    "mm²": r"mm²|mm2|square millimet(?:re|er)s?",
    "kPa": r"kPa|kilopascals?",
    "thou": r"thou",
    "in": r"inch|inches",
    "cN": r"cN|centinewtons?",
    "lbf": r"lbf|pounds?[ -]force",
    "kgf": r"kgf",
    "cm²": r"cm²|cm2|square centimet(?:re|er)s?",
}
_NUMBER = rf"(?P<number>\d+(?:[.,]\d+)?)(?:\s*(?P<unit>{'|'.join(_UNIT_WORDS.values())})(?!\w))?"
_STATED = re.compile(rf"(?<![\w.,]){_NUMBER}(?!\w|\.\d)", re.I)
_ANOTHER_NUMBER = re.compile(
    rf"{_LEAD}(?:if (?:i|we|you) )?(?:(?:add|added|by|with|for|at|to|of|over|above|below|under|"
    rf"(?:(?:more|less|deeper|higher|lower) )?than|it's|it is|it were|it weighs|only|a|an|about|"
    rf"one|full|whole|even)\s+)*{_NUMBER}"
    rf"(?: (?:added|on top|off|one|1|object|part|piece|thing))?{_END}",
    re.I,
)

_SUPPOSED = (
    re.compile(r"(?:what|how about) (?P<if>if .+?)[?.! ]*", re.I),
    re.compile(
        r"(?P<if>(?:if|suppose|supposing|assuming) [^,?.]+(?:\.\d+[^,?.]*)*)[,?.] ?(?P<asked>.+)",
        re.I,
    ),
    re.compile(r"(?P<asked>.+?),? (?P<if>if .+?)[?.! ]*", re.I),
)
"""A question with a supposition, before or behind what is asked."""

_ANOTHER_IF = re.compile(rf"{_LEAD}(?P<if>if [^,]+?)[?.! ]*", re.I)
_CHANGED = re.compile(r"\b(?:halved|doubled|tripled|raised|increased|lowered|reduced)\b", re.I)
"""What names the supposed force itself."""

_UNDER_IT = re.compile(r"\b(?:it|that|this|then|still|would)\b", re.I)
_THEN = re.compile(r",? ?\bthen\b", re.I)
_SUBJECT = re.compile(r"\b(?P<verb>is|are|would|will|does|do) (?:it|that|this)\b", re.I)

_SIDES = ("left", "right", "top", "bottom", "upper", "lower", "fingertip", "palm")
_SIDE = re.compile(rf"\b(?:{'|'.join(_SIDES)})\b", re.I)
_OPPOSITE = {
    "left": "right", "right": "left", "top": "bottom", "bottom": "top", "upper": "lower",
    "lower": "upper", "fingertip": "palm", "palm": "fingertip",
}  # fmt: skip
_EDGE = r"(?: one| edge| side| rim| border| end| third| half| row| column)"
_ANOTHER_SIDE = re.compile(
    rf"{_LEAD}(?:(?:the )?same(?: \w+)? (?:for|at|to|from) )?(?:(?:up|down) )?"
    rf"(?:top,? )?(?:on |at |to |from |off |over |of |towards? )?(?:the )?"
    rf"(?P<side>{'|'.join(_SIDES)}){_EDGE}?"
    rf"(?: too| as well)?{_END}",
    re.I,
)
_OTHER_SIDE = re.compile(
    rf"{_LEAD}(?:on |at |to |from )?(?:the )?(?:other|opposite)(?:{_EDGE})?{_END}",
    re.I,
)
_HOW_MANY_SIDES = re.compile(
    rf"{_LEAD}(?:over |on |at |across )?(?:how many|(?:the )?(?:total )?number of)"
    rf"(?: of the)?(?: (?:four|4|cut))?(?: of)? (?:sides|edges|rims|borders)(?: is (?:it|that))?"
    rf"(?:[, ]+(?:altogether|in all|in total|overall))?{_END}",
    re.I,
)

_ALONG = {
    "horizontally": "vertically", "sideways": "vertically", "left-right": "up-down",
    "horizontal": "vertical", "x": "y", "width": "height", "wide": "high",
}  # fmt: skip
_ACROSS = {**_ALONG, **{other: word for word, other in _ALONG.items()}, "vertically": "sideways"}
_ANOTHER_AXIS = re.compile(
    rf"{_LEAD}(?:how (?=wide|high))?(?:in |the |its |along )*(?P<axis>{'|'.join(_ACROSS)})"
    rf"(?: direction)?{_END}",
    re.I,
)

_BAND_WORDS = {
    r"(?:where does it |where's the |the |its |it )*(?:end|ends|stop|stops|(?:upper|high|"
    r"higher)(?: end| one)?|top)":
        "What is the upper end of the band?",
    r"(?:where does it |where's the |the |its |it )*(?:start|starts|begin|begins|low(?:er)?(?: "
    r"end| one)?|"
    r"bottom)": "What is the lower end of the band?",
    r"(?:how (?:wide|broad) (?:is it|does that make it)|(?:the |its )?(?:width|breadth|span))":
        "What is the width of the band?",
    r"(?:(?:where|what) is )?(?:the |its )?(?:middle|midpoint|cent(?:er|re)|mean)(?: of (?:it|"
    r"them|both|"
    r"the two))?":
        "What is the middle of the band?",
}  # fmt: skip
_BAND_WORD = {
    re.compile(rf"{_LEAD}(?:{words}){_END}", re.I): text for words, text in _BAND_WORDS.items()
}
"""Follow-ups about the band, once one of its ends was asked for."""

_NAMED = re.compile(
    rf"{_LEAD}(?:wait[, ]+)?(?:not (?:the |in )?\w+, )?"
    rf"(?:(?:the )?same (?:for|with) |add |tell me |give me |as for |how is |what is )*"
    rf"(?:the |its |your )*(?P<name>shape|form|texture|surface|depth|force|position|place|"
    rf"area|size|mass|limit|band)(?: of it)?(?: too| as well| at least)?"
    rf"(?: i (?:meant|mean|wanted|want))?"
    rf"(?P<unit>,? in [^\s?.!,]+)?{_END}",
    re.I,
)
_CALLS = {"form": "shape", "surface": "texture", "place": "position", "size": "contact area",
          "area": "contact area"}  # fmt: skip

_WHICH_EDGE = re.compile(
    r"(?:and |but )?(?:(?:on |at )?(?:which|what) (?:edge|side|rim|border)s?(?: is it(?: on)?)?|"
    r"where)(?: exactly| then)?[?.! ]*",
    re.I,
)
_BY_HOW_MUCH_TO = re.compile(
    r"(?:and |but )?(?:by )?how (?:much|far|many newtons)(?: is it| is left| is missing| more)? "
    r"(?:to|until|till|from) (?P<rest>the (?:upper|lower|middle|top|bottom)\b.+?)[?.! ]*",
    re.I,
)
_HOW_FAR = re.compile(
    r"(?:and |but |ok )?(?:by )?how (?:far|many (?:mm|millimet(?:re|er)s))"
    r"(?: (?:do|must|should|would) (?:i|we|you|it)(?: have to| need to)?(?: move)?"
    r"(?: it| that way)?)?[?.! ]*",
    re.I,
)

_PREPOSITION = (
    r"from|to|in|into|above|below|over|under|beyond|between|within|at least|at most|more than|"
    r"less than|on|at|near"
)
_GOES_ON = re.compile(
    rf"(?P<lead>(?:and|but|or|what about|how about)[, ]+)?(?P<rest>(?P<word>{_PREPOSITION})\b.+)",
    re.I,
)
_MOST_WORDS = 4
"""Longest follow-up that begins with a preposition and no 'and' [words]. Our choice."""

_OBJECT = re.compile(
    r"\b(?P<before>over|for|above|below|under|in|within|inside|outside|to|of|near|past|beyond|than|"
    r"exceed(?:ing|ed)?|reach(?:ing|ed)?|break(?:ing)?|pass(?:ed|ing)?|at|from) "
    r"(?P<pronoun>it\b(?! \w+s\b)|(?:that|this)\b(?! \w))",
    re.I,
)
_CALLED = {
    "limit": "the limit",
    "band_low": "the lower end of the band",
    "band_high": "the upper end of the band",
    "band_middle": "the middle of the band",
    "mass": "the mass",
    "needed": "the force that is needed",
}
"""Quantities that a pronoun may stand for behind a preposition, as questions call them."""

_COMPARED_WITH = {"limit_n": "the limit", "mass_g": "the mass"}
"""The same of what a comparison was made with."""


def rewritten(question: str, before: str, meant: Meaning | None, noun: str) -> Iterator[str]:
    """What a follow-up may be in full.

    Args:
        question: The follow-up.
        before: The question before it, as it stands alone.
        meant: What that means; None where that is not known.
        noun: What a pronoun may stand for; '' for nothing.
    """
    question = question.strip()
    for text in (
        _claimed(question, before),
        _stated(question),
        _of_that_quantity(question, meant),
        _ENOUGH.sub(r"\g<verb> the grip strong enough", question),
        _still_under(question, noun),
        _figure_of(question, meant),
        _which_then(question, meant),
        _about_the_pad(question, meant),
        *_about_place(question, before, meant),
        _with_another_side(question, before),
        *_about_the_band(question, meant),
        _needed(question, before, meant),
        _with_another_number(question, before),
        *_with_another_supposition(question, before),
        _under_supposition(question, before),
        _with_another_axis(question, before),
        _of_named_class(question, meant),
        _of_a_mass(question, before, meant),
        _named_alone(question),
        _moved_otherwise(question, before),
        with_noun(question, noun),
        _HOW_FAR_FROM.sub("how far is the force from ", with_noun(question, noun)),
        _completed(question, before),
    ):
        if text and text != question:
            yield text


def _about_place(question: str, before: str, meant: Meaning | None) -> Iterator[str]:
    """A short question about edges, ways and bounds, by what was asked before."""
    side = _ANOTHER_SIDE.fullmatch(question)
    condition = truth_of(meant) if isinstance(meant, Check | Calculated | Which) else ""
    is_cut = bool(re.search(r"\bcut", condition))
    if side and is_cut:
        yield f"Is it cut on the {_PAD_SIDES.get(side['side'].lower(), side['side'])} side?"
    if is_cut and _OTHER_SIDE.fullmatch(question):
        told = next((side for side in _OPPOSITE if condition.endswith(f"cut_{side}")), "")
        if told:
            yield f"Is it cut on the {_OPPOSITE[told]} side?"
    if is_cut and _WHICH_EDGE.fullmatch(question):
        yield "Which edge cuts it?"
    if is_cut and _HOW_MANY_SIDES.fullmatch(question):
        yield "How many sides of the pad cut it?"
    if found := _BY_HOW_MUCH_TO.fullmatch(question):
        yield f"How far is the force from {found['rest']}?"
    is_way = isinstance(meant, Which) and meant.name in ("action", "position")
    if is_way and _HOW_FAR.fullmatch(question):
        yield "How far is it from the middle of the pad?"


_PAD_SIDES = {"palm": "top", "upper": "top", "fingertip": "bottom", "lower": "bottom"}
"""Sides of the pad by other names."""


def _claimed(question: str, before: str) -> str:
    """'Am I right?' behind a guess, as a question of what was guessed."""
    claim = _GUESS.fullmatch(before.strip())
    if claim is None or _AM_I_RIGHT.fullmatch(question) is None:
        return ""
    return f"Is it {claim['what']}?"


_GUESS = re.compile(
    r"(?:(?:so|well|hm+|ok)[, ]+)*(?:my (?:guess|bet|money) is(?: on)?|"
    r"i(?:['’]d)? (?:would )?(?:guess|think|say|bet|believe|suppose|reckon)(?: that)?|"
    r"(?:it|this|that) (?:feels|looks) like)"
    r"(?: (?:it|that|this)(?:['’]s| is))? (?P<what>[^?.!]+?)[.! ]*",
    re.I,
)
_AM_I_RIGHT = re.compile(
    r"(?:and[, ]+)?(?:am i|was i|is (?:that|it|this)) (?:right|correct|true|so)[?.! ]*|"
    r"(?:right|correct|true)[?.! ]*|(?:do|would) you agree[?.! ]*",
    re.I,
)


_WHICH_THEN = re.compile(
    r"(?:(?:and|so|but|then|ok|no)[, ]+)*(?:what (?:would|do|will) you (?:call|name) it|"
    r"how would you (?:describe|call|class|name) it|(?:what|which(?: one)?|how) is it|"
    r"what(?: else)?|what sort|which(?: one)?)(?: then| instead| really| exactly)*"
    r"(?P<word>[, ]+in (?:one|a|a single) word)?[?.! ]*",
    re.I,
)


_STATED_SO = re.compile(
    r"(?:so |then |and )*(?:that|this|it)(?:['’]s| is| means it(?:['’]s| is)) (?P<what>.+?)[?.! ]*",
    re.I,
)
_THAT_QUANTITY = re.compile(r"\b(?:that|this) (?P<what>force|depth|area|mass|limit|grip)\b", re.I)
_STILL_UNDER = re.compile(
    r"(?:and )?(?P<if>(?:if|with|assume|suppose) [^,?]*?(?:\.\d+[^,?]*?)?)[,.:] "
    r"(?:is (?:it|that) |are we )?(?:still )?(?P<side>over|under|above|below)"
    r"(?: (?:it|that))?(?: then| still)?[?.! ]*",
    re.I,
)
_FIGURE = re.compile(
    r"(?:what(?:['’]s| is) (?:the |its )?(?:(?:real|actual|exact|true|precise) )?(?:figure|"
    r"number|value|"
    r"reading)|how (?:much|deep|strong|big) is it|(?:the )?exact (?:figure|number|value))"
    r"(?: then| really| exactly| in fact)*[?.! ]*",
    re.I,
)


_ENOUGH = re.compile(
    r"(?P<verb>\b(?:is|would)\b) (?:it|that|this) (?:be )?(?:strong |firm )?enough(?= to (?:hold|"
    r"lift|carry))",
    re.I,
)


def _stated(question: str) -> str:
    """'So that's in the middle row?' as a question."""
    found = _STATED_SO.fullmatch(question)
    return f"Is it {found['what']}?" if found and question.rstrip().endswith("?") else ""


def _of_that_quantity(question: str, meant: Meaning | None) -> str:
    """A question of 'that force', where the force was asked for."""
    found = _THAT_QUANTITY.search(question)
    name = {"grip": "force"}.get(found["what"].lower(), found["what"].lower()) if found else ""
    if not found or not isinstance(meant, Amount) or meant.quantity != name:
        return ""
    return f"{question[: found.start()]}the {name}{question[found.end() :]}"


def _still_under(question: str, noun: str) -> str:
    """'If I add 0.3 N, still under?' with what it may be under."""
    found = _STILL_UNDER.fullmatch(question)
    if found is None:
        return ""
    return f"{found['if']}, is the force {found['side']} {noun}?" if noun else ""


def _figure_of(question: str, meant: Meaning | None) -> str:
    """The number behind a yes or a no: 'what is the real figure?'."""
    if _FIGURE.fullmatch(question) is None or not isinstance(meant, Check | Calculated):
        return ""
    names = names_of(meant)
    figures = {"depth_mm": "depth", "depth": "depth", "force_n": "force", "area_percent": "area",
               "area": "area", "area_mm2": "area"}  # fmt: skip
    felt = list(dict.fromkeys(figures[name] for name in names if name in figures))
    return f"What is the {felt[0]} as a number?" if len(felt) == 1 else ""


def _which_then(question: str, meant: Meaning | None) -> str:
    """The word for what was asked about with a yes or no: 'what would you call it?'."""
    shown = meant.shows if isinstance(meant, Check) else ()
    names = {"shape": "shape", "texture": "texture", "depth_word": "depth", "area_word": "area",
             "position": "position"}  # fmt: skip
    name = names.get(shown[0], "") if len(shown) == 1 else ""
    if isinstance(meant, Calculated) and meant.unit is None:
        told = names_of(meant)
        name = told[0] if len(told) == 1 and told[0] in ("shape", "texture", "position") else ""
    if not name or _WHICH_THEN.fullmatch(question) is None:
        return ""
    if name in ("depth", "area"):
        return f"What is the {name} in one word?"
    return f"What is the {name}?"


_OF_PAD = re.compile(r"\b(?:its|the|(?P<bare>total|whole|full))(?P<size> (?:(?:whole|total|full|"
                     r"entire) )?(?:width|height|area|size)| area)\b", re.I)  # fmt: skip


_WHOLE_AREA = re.compile(
    r"what area (?:does|do) (?:that|they|these|it) make|the whole pad is(?= how)|what (?:is|"
    r"does) (?:that|it)"
    r"(?: make)? (?:as an area|in area)",
    re.I,
)


def _about_the_pad(question: str, meant: Meaning | None) -> str:
    """A question about the pad's size, where that was asked for before."""
    names = names_of(meant) if isinstance(meant, Calculated) else ()
    if not names or not set(names) <= {"pad_width_mm", "pad_height_mm"}:
        return ""
    words = without_lead(question)
    if _WHOLE_AREA.match(words):
        return _WHOLE_AREA.sub("the pad's total area", words)
    if re.fullmatch(r"(?:height|width|area)[?.! ]*", words, re.I):
        return f"the pad's {'total ' if words.lower().startswith('area') else ''}{words}"
    if re.fullmatch(r"how (?:high|wide|tall|broad)[?.! ]*", words, re.I):
        return f"{words.rstrip('?.! ')} is the pad?"
    return _OF_PAD.sub(
        lambda each: f"the pad's{' total' if each['bare'] else ''}{each['size']}", words, count=1
    )


def _about_the_band(question: str, meant: Meaning | None) -> Iterator[str]:
    """A short question about the band that was asked for before."""
    if meant is None or "band_" not in truth_of(meant):
        return
    parts = meant.parts if isinstance(meant, Several) else (meant,)
    if all(isinstance(each, Amount) and each.quantity.startswith("band_") for each in parts):
        yield from (text for words, text in _BAND_WORD.items() if words.fullmatch(question))
    own = _OWN_END.sub(
        lambda end: f"the {_PLAIN_END.get(end['which'].lower(), end['which'])} end of the band",
        without_lead(question),
    )
    own = re.sub(r"\bof (?:it|them)\b", "of the band", own)
    yield own
    yield _HOW_FAR_FROM.sub("how far is the force from ", own)
    yield _ARE_WE.sub("Is the force", own)
    if _IN.search(question):
        yield _IN.sub("in the band", without_lead(question))


_OWN_END = re.compile(
    r"\b(?:the|its|that|this) (?P<which>upper|lower|top|bottom|high|low)(?: (?:end|edge|bound|"
    r"limit|one)\b"
    r"(?: of (?:it|that|this)\b)?(?! of)|(?= or )|(?=[?.! ]*$))",
    re.I,
)
_HOW_FAR_FROM = re.compile(
    r"^(?:(?:and|so|ok)[, ]+)*how (?:far|much|many newtons)(?: (?:are we|is that|is it|am i))?"
    r"(?: away)? (?:from|off|to) ",
    re.I,
)
_PLAIN_END = {"high": "upper", "low": "lower", "top": "upper", "bottom": "lower"}
_ARE_WE = re.compile(r"^(?:am i|are we)\b", re.I)
_IN = re.compile(r"(?<=\w )(?:in|inside|within)(?: (?:it|that|there))?(?=[?.! ]*$)", re.I)
"""'Am I in?', after a band."""


_NEEDED = re.compile(
    r"(?=.*\b(?:force|grip|squeeze|newtons?|hard|strong|strongly|(?:the )?(?:least|minimum)"
    r"(?: that)? (?:i|we|you|it))\b)"
    r"(?!.*\b(?:gravity|pull|pulls|weigh|weighs|push|apply|applying|pressing|is it|is that|are "
    r"we|have|"
    r"limit|heaviest|grams?|still|more|less|now)\b)"
    r"(?=.*\b(?:needs?|needed|requires?|required|minimum|min|least|enough|takes?|surely|sure|"
    r"safely|do|holds?)\b)"
    r"(?:(?:and|so|but|then)[, ]+)*(?:(?:with )?how (?:much|many|strong|hard)|what|which|"
    r"(?:the )?(?:minimum|least|needed|required|grip|force))\b.*",
    re.I,
)


def _needed(question: str, before: str, meant: Meaning | None) -> str:
    """What force the mass needs that was asked about before."""
    truth = "" if meant is None else truth_of(meant)
    is_of_mass = any(name in truth for name in ("mass_g", "gram_n", "holds_g"))
    is_fate = isinstance(meant, Check) and bool(meant.needed_n)
    if not (is_of_mass or is_fate) or _NEEDED.match(question) is None:
        return ""
    masses = [f for f in _STATED.finditer(before) if dimension_of(f["unit"]) == "mass"]
    named = f"{masses[-1]['number']} {masses[-1]['unit']}" if masses else "its mass"
    return f"How much force is needed for {named}?"


def _with_another_axis(question: str, before: str) -> str:
    """The question before, along the other axis of the pad."""
    asked = _ANOTHER_AXIS.fullmatch(question)
    if asked is None:
        return ""
    across = _ACROSS[asked["axis"].lower()]
    same = [word for word, other in _ACROSS.items() if other == asked["axis"].lower()]
    for word in dict.fromkeys((across, *same)):
        text, count = re.subn(rf"\b{word}\b", asked["axis"].lower(), before, count=1, flags=re.I)
        if count:
            return text
    return ""


def _of_named_class(question: str, meant: Meaning | None) -> str:
    """A follow-up that names a class of the depth or the area that was asked about."""
    shown = meant.shows if isinstance(meant, Check) else ()
    dimension = {"depth_word": "depth", "area_word": "area"}.get(shown[0] if shown else "", "")
    words = without_lead(question).rstrip("?.! ")
    words = re.sub(r"^(?:how|what) about (?:an? )?", "", words, flags=re.I)
    is_named = any(re.search(rf"\b{word}\b", words, re.I) for word in CLASSES.get(dimension, ()))
    return f"Is the {dimension} {_uncapital(words)}?" if is_named else ""


_ANOTHER_THING = re.compile(
    rf"{_LEAD}(?:for |with |of )?(?:an?|the|one|my|our) (?:[a-z'-]+ ){{0,3}}?[a-z'-]+,? "
    rf"(?:(?:of|with|at|that weighs|weighing) )?(?:about )?{_NUMBER}"
    rf"(?:,? would (?:that(?: one)?|it) (?:hold|slip|stay|work))?{_END}",
    re.I,
)
"""'And an ostrich egg, 1400 g?'"""


_MOVED = re.compile(
    r"\d+(?:\.\d+)? ?(?:mm|millimet(?:re|er)s?) (?:(?:to the )?(?:left|right)|up|down|upwards?|"
    r"downwards?)",
    re.I,
)


def _moved_otherwise(question: str, before: str) -> str:
    """The question before, of another shift: 'and 3 mm to the left instead?'."""
    other = re.fullmatch(rf"{_LEAD}(?:by )?(?P<shift>{_MOVED.pattern}){_END}", question, re.I)
    found = _MOVED.search(before)
    if other is None or found is None:
        return ""
    return f"{before[: found.start()]}{other['shift']}{before[found.end() :]}"


def _of_a_mass(question: str, before: str, meant: Meaning | None) -> str:
    """The question before, of another mass than the one that was told."""
    asked = _ANOTHER_NUMBER.fullmatch(in_digits(question)) or _ANOTHER_THING.fullmatch(question)
    if asked is None or dimension_of(asked["unit"]) != "mass" or meant is None:
        return ""
    truth = truth_of(meant)
    is_of_mass = "mass_g" in truth and not _STATED.search(before)
    return f"{before.rstrip('?.! ')} for {asked['number']} {asked['unit']}?" if is_of_mass else ""


def _named_alone(question: str) -> str:
    """A follow-up that is but the name of something felt or agreed."""
    if (asked := _NAMED.fullmatch(question)) is None:
        return ""
    name = asked["name"].lower()
    return f"What is the {_CALLS.get(name, name)}{(asked['unit'] or '').lstrip(',')}?"


def _with_another_number(question: str, before: str) -> str:
    """The question before with the number of a follow-up, in its unit where that has none."""
    asked = _ANOTHER_NUMBER.fullmatch(in_digits(question))
    if asked is None:
        return ""
    dimension = dimension_of(asked["unit"])
    for found in reversed(list(_STATED.finditer(before))):
        if asked["unit"] is None:
            return before[: found.start("number")] + asked["number"] + before[found.end("number") :]
        if dimension_of(found["unit"]) == dimension:
            number = f"{asked['number']} {asked['unit']}"
            return before[: found.start()] + number + before[found.end() :]
    return ""


def dimension_of(unit: str | None) -> str:
    """What a unit as it is written measures; '' of none."""
    if not unit:
        return ""
    return UNITS[symbol].dimension if (symbol := unit_symbol(unit)) else ""


def unit_symbol(written: str) -> str:
    """The unit of a word, as queries write it; '' of none that follow-ups know."""
    # 'mn' is no unit: a unit's own letters count first
    for flags in (re.NOFLAG, re.I):
        for symbol, words in _UNIT_WORDS.items():
            if re.fullmatch(words, written, flags):
                return symbol
    return ""


def supposed_in(text: str) -> tuple[str, str] | None:
    """The supposition of a question and what is asked under it; None without one."""
    for pattern in _SUPPOSED:
        if found := pattern.fullmatch(text.strip()):
            return found["if"], found.groupdict().get("asked") or ""
    return None


def _with_another_supposition(question: str, before: str) -> Iterator[str]:
    """What was asked before, under another supposition."""
    found, supposed = _ANOTHER_IF.fullmatch(question), supposed_in(before)
    if found is None:
        return
    asked = supposed[1] if supposed else before
    if asked:
        yield f"{_capital(found['if'])}, {_uncapital(asked)}"
        yield f"{_capital(_with_force(found['if']))}, {_uncapital(asked)}"
    yield f"What {found['if']}?"


def _under_supposition(question: str, before: str) -> str:
    """A follow-up about what was supposed before."""
    supposed = supposed_in(before)
    if _CHANGED.search(question):
        return ""
    if supposed is None or _ANOTHER_IF.match(question) or not _UNDER_IT.search(question):
        return ""
    asked = re.sub(rf"^{_LEAD}", "", _THEN.sub("", question), flags=re.I)
    return f"{_capital(supposed[0])}, {_uncapital(about_the_force(asked))}"


def about_the_force(question: str) -> str:
    """A question about 'it' as one about the force."""
    return _SUBJECT.sub(r"\g<verb> the force", question)


def _with_force(clause: str) -> str:
    return re.sub(r"\b(?:it|that)\b", "the force", clause, flags=re.I)


def _with_another_side(question: str, before: str) -> str:
    """The question before, about another side."""
    asked, other = _ANOTHER_SIDE.fullmatch(question), _OTHER_SIDE.fullmatch(question)
    places = list(_SIDE.finditer(before))
    if (asked is None and other is None) or len(places) != 1:
        return ""
    side = asked["side"].lower() if asked else _OPPOSITE[places[0][0].lower()]
    return f"{before[: places[0].start()]}{side}{before[places[0].end() :]}"


def noun_of(meant: Meaning) -> str:
    """What a pronoun may stand for after something was asked: 'the limit'; '' for nothing."""
    if isinstance(meant, Several) and all(isinstance(part, Amount) for part in meant.parts):
        names = {part.quantity for part in meant.parts if isinstance(part, Amount)}
        return "the band" if names == {"band_low", "band_high"} else ""
    if isinstance(meant, Amount) and meant.quantity in _CALLED:
        return _CALLED[meant.quantity]
    if not isinstance(meant, Amount | Check | Calculated):
        return ""
    names = {name for name in names_of(meant) if name in _COMPARED_WITH}
    return _COMPARED_WITH[names.pop()] if len(names) == 1 else ""


def with_noun(question: str, noun: str) -> str:
    """A question with a noun in place of the pronoun behind a preposition; '' of others."""
    if not noun or _OBJECT.search(question) is None:
        return ""
    return _OBJECT.sub(lambda found: f"{found['before']} {noun}", question)


def _completed(question: str, before: str) -> str:
    """A follow-up that begins with a preposition, behind the words before it; '' of others."""
    found = _GOES_ON.match(question)
    if found is None or (not found["lead"] and len(question.split()) > _MOST_WORDS):
        return ""
    places = list(re.finditer(rf"\b{found['word']}\b", before, re.I))
    return f"{before[: places[-1].start()]}{found['rest']}" if places else ""


def _capital(text: str) -> str:
    return f"{text[:1].upper()}{text[1:]}"


def _uncapital(text: str) -> str:
    return text if text[:2] in ("I ", "I'") else f"{text[:1].lower()}{text[1:]}"
