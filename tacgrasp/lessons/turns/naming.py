"""Follow-ups that name what they are about, or leave only that out, written anew.

    What shape is it?               And the texture?        What is the texture?
    Is the surface ridged?          What is it then?        What is the texture?
    My guess is a sphere.           Am I right?             Is it a sphere?
    Is it deep?                     What is the figure?     What is the depth as a number?

Not here: the number before (``tacgrasp.lessons.turns.references``).
"""

from __future__ import annotations

import re

from cltp.tactile.states import CLASSES
from tacgrasp.lessons.dialogue.meaning import (
    Amount,
    Calculated,
    Check,
    Meaning,
    Which,
    names_of,
    truth_of,
)
from tacgrasp.lessons.turns.leads import END, LEAD, uncapital, without_lead

_NAMED = re.compile(
    rf"{LEAD}(?:wait[, ]+)?(?:not (?:the |in )?\w+, )?"
    rf"(?:(?:the )?same (?:for|with) |add |tell me |give me |as for |how is |what is )*"
    rf"(?:the |its |your )*(?P<name>shape|form|texture|surface|depth|force|position|place|"
    rf"area|size|mass|limit|band)(?: of it)?(?: too| as well| at least)?"
    rf"(?: i (?:meant|mean|wanted|want))?"
    rf"(?P<unit>,? in [^\s?.!,]+)?{END}",
    re.I,
)
_CALLS = {"form": "shape", "surface": "texture", "place": "position", "size": "contact area",
          "area": "contact area"}  # fmt: skip
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
    r"what(?: else)?|what sort|which(?: one)?|name it(?: for me)?|which part(?: of (?:the pad|"
    r"it))? is it (?:on|in|at)|which (?:shape|texture|part|place) then)"
    r"(?: then| instead| really| exactly| please)*"
    r"(?P<word>[, ]+in (?:one|a|a single) word)?[?.! ]*",
    re.I,
)
_STATED_SO = re.compile(
    r"(?:so |then |and )*(?:that|this|it)(?:['’]s| is| means it(?:['’]s| is)) (?P<what>.+?)[?.! ]*",
    re.I,
)
_THAT_QUANTITY = re.compile(r"\b(?:that|this) (?P<what>force|depth|area|mass|limit|grip)\b", re.I)
_FIGURE = re.compile(
    r"(?:what(?:['’]s| is) (?:the |its )?(?:(?:real|actual|exact|true|precise) )?(?:figure|number|"
    r"value|reading)|how (?:much|deep|strong|big) is it|(?:the )?exact (?:figure|number|"
    r"value)|(?:more )?(?:exactly|precisely)|(?:as|in) (?:a )?(?:numbers?|figures?))"
    r"(?: then| really| exactly| in fact| please)*[?.! ]*",
    re.I,
)
_FIGURES_OF = {
    "position": "What are x and y in mm?",
    "depth": "What is the depth as a number?",
    "area": "What is the area as a number?",
}
"""Questions for the numbers behind a word."""

_ENOUGH = re.compile(
    r"(?P<verb>\b(?:is|would)\b) (?:it|that|this) (?:be )?(?:strong |firm )?enough"
    r"(?= to (?:surely |safely )?(?:hold|lift|carry))",
    re.I,
)


def claimed(question: str, before: str) -> str:
    """'Am I right?' behind a guess, as a question of what was guessed."""
    claim = _GUESS.fullmatch(before.strip())
    if claim is None or _AM_I_RIGHT.fullmatch(question) is None:
        return ""
    return f"Is it {claim['what']}?"


def stated(question: str) -> str:
    """'So that's in the middle row?' as a question."""
    found = _STATED_SO.fullmatch(question)
    return f"Is it {found['what']}?" if found and question.rstrip().endswith("?") else ""


def of_that_quantity(question: str, meant: Meaning | None) -> str:
    """A question of 'that force', where the force was asked for."""
    found = _THAT_QUANTITY.search(question)
    name = {"grip": "force"}.get(found["what"].lower(), found["what"].lower()) if found else ""
    if not found or not isinstance(meant, Amount) or meant.quantity != name:
        return ""
    return f"{question[: found.start()]}the {name}{question[found.end() :]}"


def figure_of(question: str, meant: Meaning | None) -> str:
    """The number behind a yes or a no: 'what is the real figure?'."""
    is_asked = _FIGURE.fullmatch(without_lead(question)) or _FIGURE.fullmatch(question)
    if is_asked and isinstance(meant, Which):
        return _FIGURES_OF.get(meant.name, "")
    if not is_asked or not isinstance(meant, Check | Calculated):
        return ""
    names = names_of(meant)
    figures = {"depth_mm": "depth", "depth": "depth", "force_n": "force", "area_percent": "area",
               "area": "area", "area_mm2": "area"}  # fmt: skip
    felt = list(dict.fromkeys(figures[name] for name in names if name in figures))
    return f"What is the {felt[0]} as a number?" if len(felt) == 1 else ""


_WHAT_LIKE = re.compile(
    rf"{LEAD}(?:the |its |your )?(?P<name>shape|form|texture|surface|depth|force|position|place|"
    rf"area),? "
    r"(?:what(?:['’]s| is) (?:that|it)(?: like)?|how (?:is|does) (?:that|it)(?: feel)?|"
    r"(?:that |which )?(?:we|you|i) (?:have|feel|apply|press with)(?: on it)?)[?.! ]*",
    re.I,
)
_IN_A_WORD = re.compile(
    r"(?:(?:in |as )?(?:one|a|a single|the) word(?: for (?:that|it|this))?|"
    r"(?:is|would) (?:that|it|this) (?:be )?(?:a lot|much|little|a little|big|high|low|normal|"
    r"large|small)(?: or (?:not|little|small|low))?)[?.! ]*",
    re.I,
)
_IN_PLACE = re.compile(r"(?:in|on|at) the [^?]+\?", re.I)


def enough_to_hold(question: str) -> str:
    """'Is it enough to hold the jar?' as a question of the grip."""
    core = without_lead(question)
    return _ENOUGH.sub(r"\g<verb> the grip strong enough", core) if _ENOUGH.search(core) else ""


def what_like(question: str) -> str:
    """'And its surface, what's that like?' as a question for it."""
    found = _WHAT_LIKE.fullmatch(question)
    if found is None:
        return ""
    name = found["name"].lower()
    return f"What is the {_CALLS.get(name, name)}?"


def in_a_word(question: str, meant: Meaning | None) -> str:
    """'One word for that?' and 'Is that a lot?' behind a depth or an area."""
    is_word = _IN_A_WORD.fullmatch(without_lead(question)) is not None
    name = meant.quantity if isinstance(meant, Amount) else ""
    return f"What is the {name} in one word?" if is_word and name in ("depth", "area") else ""


_FREE = re.compile(
    rf"{LEAD}(?:what(?:['’]s| is) )?"
    r"(?:how (?:much|many \S+)(?: of (?:it|the pad))? (?:is|are|stays?|remains?|lies?) )?"
    r"(?:the )?(?:uncovered|not covered|free|bare|untouched|empty|not touched|unoccupied|rest)"
    rf"(?: (?:part|area|one))?{END}",
    re.I,
)


def free_part(question: str, meant: Meaning | None) -> str:
    """'And uncovered?' behind an area, in its unit."""
    if not isinstance(meant, Amount) or meant.quantity not in ("area", "free_area"):
        return ""
    if _FREE.fullmatch(question) is None:
        return ""
    unit = {"%": "percent"}.get(meant.unit, meant.unit)
    return f"How much of the pad stays free in {unit}?"


def in_that_place(question: str, meant: Meaning | None) -> str:
    """'In the right third?', where the place was asked for before."""
    core = without_lead(question)
    names = set() if meant is None or not truth_of(meant) else set(names_of(meant))
    is_place = names and names <= {"position", "x_mm", "y_mm", "pad_width_mm", "pad_height_mm"}
    return f"Is it {uncapital(core)}" if is_place and _IN_PLACE.fullmatch(core) else ""


def which_then(question: str, meant: Meaning | None) -> str:
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


def of_named_class(question: str, meant: Meaning | None) -> str:
    """A follow-up that names a class of the depth or the area that was asked about."""
    shown = meant.shows if isinstance(meant, Check) else ()
    if isinstance(meant, Which) and meant.name in ("depth", "area"):
        shown = (f"{meant.name}_word",)
    dimension = {"depth_word": "depth", "area_word": "area"}.get(shown[0] if shown else "", "")
    words = without_lead(question).rstrip("?.! ")
    words = re.sub(r",? in other words$|['\"“”]", "", words)
    words = re.sub(r"^(?:how|what) about (?:an? )?", "", words, flags=re.I)
    is_named = any(re.search(rf"\b{word}\b", words, re.I) for word in CLASSES.get(dimension, ()))
    return f"Is the {dimension} {uncapital(words)}?" if is_named else ""


def named_alone(question: str, before: str) -> str:
    """A follow-up that is but the name of something felt or agreed, in a word if that was one."""
    if (asked := _NAMED.fullmatch(question)) is None:
        return ""
    name = asked["name"].lower()
    is_same = re.search(r"\bsame\b", question, re.I) is not None
    if is_same and re.search(r"\bin (?:one|a|a single) word[?.! ]*$", before):
        return f"What is the {name} in one word?"
    return f"What is the {_CALLS.get(name, name)}{(asked['unit'] or '').lstrip(',')}?"
