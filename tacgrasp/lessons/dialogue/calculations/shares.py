"""Questions for a share or a ratio of two terms.

    What percentage of 2 mm is the depth?       100 * depth_mm / 2
    How much of the limit is unused?            100 - 100 * force_n / limit_n
    Ratio of force to depth, in N/mm?           force_n / depth_mm

Not here: sums and differences (``tacgrasp.lessons.dialogue.calculations.differences``).
"""

from __future__ import annotations

import re
from dataclasses import replace

from tacgrasp.lessons.dialogue.calculations.asked import AskedWords, usual_unit
from tacgrasp.lessons.dialogue.calculations.checks import shared_noun
from tacgrasp.lessons.dialogue.calculations.phrases import ABOVE, BELOW, IS, PARTS
from tacgrasp.lessons.dialogue.calculations.quantity_names import UNIT, unit_of
from tacgrasp.lessons.dialogue.calculations.terms import PLAIN, Term
from tacgrasp.lessons.dialogue.quantities import UNITS

_TAIL = (
    r"(?: (?:amount|come|correspond|add up|be equal|equal) to| makes?(?: up)?| takes?(?: up)?|"
    r" represents?|(?: be)? at| uses?(?: up)?| be| equals?| account for| cover|"
    r"(?: be)? (?:reached|used(?: up)?|attained|got(?: up)? to|come to|gone through|covered))?"
)
_USED = r"(?:taken up|used|used up|filled|consumed|reached|covered|exhausted)"
_FREE = (
    r"(?:unused|left|left over|free|available|remaining|in reserve|not used|spare|to spare|unspent|"
    r"still there|untapped)"
)

_SHARES = tuple(
    re.compile(pattern)
    for pattern in (
        rf"(?:what|how many|how much|which) {PARTS} of (?P<b>.+) {IS} (?P<a>.+?){_TAIL}",
        rf"(?P<a>.+) (?:is|are|makes|amounts? to|represents?|equals?|comes? to|corresponds? to) "
        rf"(?:what|how many|which) {PARTS} of (?P<b>.+)",
        rf"how much of (?P<b>.+) (?:is|are) {_USED} by (?P<a>.+)",
        r"how much of (?P<b>.+) (?:does|do) (?P<a>.+) (?:take up|use(?: up)?|fill|make up)",
        rf"(?:what is |how much is )?(?P<a>.+) (?:as|in|expressed as) (?:an? )?{PARTS} of "
        rf"(?P<b>.+)",
        r"(?:what is |how much is )?(?P<a>.+) relative to (?P<b>.+)",
        rf"(?:taking|with|if|counting|calling|setting|say|let) (?P<b>.+?) (?:as|is|to be|at|be|"
        rf"counts "
        rf"as) (?P<n>#\d+) percent (?:what|which|how many) {PARTS} {IS} (?P<a>.+?)(?: at)?",
        rf"what (?:does|do|would) (?P<a>.+) (?:come|amount) to (?:as|in) (?:an? )?{PARTS} "
        rf"of (?P<b>.+)",
    )
)
_RATIOS = tuple(
    re.compile(pattern)
    for pattern in (
        r"how many times(?: \w+)? (?:is|are) (?P<a>.+) (?:than|as|of) (?P<b>.+)",
        r"how many times(?: over)? (?:does|do|could|can|would|will|might) (?P<b>.+) (?:fit|go) "
        r"(?:in|into|inside) (?P<a>.+)",
        r"how many times(?: over)? (?:is|are) (?P<b>.+?) (?:covered|contained|exceeded|matched|"
        r"outweighed|met|carried|borne) (?:by|in) (?P<a>.+)",
        r"how many times over (?:does|do|would) (?P<a>.+?) (?:hold|carry|cover|exceed|bear) "
        r"(?P<b>.+)",
        r"(?:(?:what|how much) (?:do|would) (?:you|we|i) (?:get|have) (?:if|when) (?:you|we|i) "
        r")?divide "
        r"(?P<a>.+) by (?P<b>.+)",
        r"(?:what is |the )*(?:(?:safety |load )?(?:factor|ratio|quotient) (?:(?:is|equals|of|"
        r"as) )?)?"
        r"(?P<a>.+) divided by (?P<b>.+?)(?: (?:so |and )?(?:that |it )?(?:what |is |makes |gives |"
        r"do |"
        r"does |you |get |equals )*(?:what|makes|get|is|gives)| (?:what|which) (?:ratio|quotient|"
        r"factor|number)\b.*)?",
        r"(?:what is |the )*ratio (?:of|between) (?P<a>.+) (?:to|and) (?P<b>.+)",
        r"(?:what is |the )*(?P<a>[a-z]+(?: force)?) to (?P<b>[a-z]+(?: force)?) ratio"
        r"(?: (?:for|of|with) (?:the )?(?:lifted |held )?(?:mass|object|load|part|payload))?",
        r"(?:[a-z]+ ){0,3}?(?:as |is )?(?P<a>force|depth|area) (?:over|divided by) (?P<b>(?:the )?"
        r"(?:indentation |contact )?(?:depth|area|force))",
        r"(?P<a>.+?) (?:is|are) how many times (?:as \w+ as |the size of )?(?P<b>.+)",
        r"how many times (?P<b>the .+?) (?:is|are) (?P<a>.+)",
        r"how many times (?P<b>(?:its|the|their) .+?) (?:is|are|am|do|does) (?P<a>(?:we|you|i|it|"
        r"the (?:gripper|robot|hand)) (?:squeez\w+|press\w*|gripp?\w*|hold\w*|pinch\w*))"
        r"(?: (?:it|on|this|the object))* with",
        r"(?:by (?:what|which) factor|how many times|how many fold) (?:(?:would|must|should|does|"
        r"do|"
        r"could|can|will|has|have|may|might) )?(?P<b>.+?) (?:(?:have|need|has|needs) to |to )?"
        r"(?:be )?(?:grow|rise|increase|go up|climb|change|swell|shrink|fall|drop|multiplied|"
        r"scaled|"
        r"raised|stepped up|turned up)(?: by)? (?:to (?:arrive(?: exactly)? at|"
        r"reach|hit|get (?:up |right )?to|be(?: exactly)? at|meet|equal|touch|come to|"
        r"land (?:exactly )?on)|"
        r"before (?:it )?(?:reach(?:es|ing)?|hit(?:s|ting)?|(?:gets|getting) to)) (?P<a>.+)",
        rf"by (?:what|which) factor (?:is|are|am) (?P<b>.+?) (?:{BELOW}) (?P<a>.+)",
        rf"by (?:what|which) factor (?:is|are|am|does|do) (?P<a>.+?) (?:{ABOVE}) (?P<b>.+)",
        r"by (?:what|which) (?:factor|number) (?:would|must|should|do|could|can) (?:i|we|you) "
        r"(?:have to )?(?:multiply|scale|raise) (?P<b>.+) to "
        r"(?:land (?:exactly )?on|get(?: to)?|reach|be "
        r"at|obtain) (?P<a>.+)",
    )
)
_EXCEEDED = re.compile(
    rf"by (?:what|how many|how much|which) {PARTS} (?:is|are|does|do) (?P<a>.+?) "
    rf"(?:(?P<below>{BELOW})|(?P<above>{ABOVE})) (?P<b>.+)"
)
_MULTIPLIED = re.compile(r"multiply (?P<a>.+) by (?P<b>#\d+)")
_UNUSED = re.compile(
    rf"(?:what|how many|how much|which)(?: {PARTS})? of "
    rf"(?P<b>.+?)(?: is| are| do we(?: still)? have| have we)?(?: still)?(?: remains?| stays?|"
    rf" is)? {_FREE}"
)
_THICK = re.compile(
    r"(?:(?:if|suppose|assuming|say|given) )?(?:the|this|our) (?:gel|pad|skin|rubber|elastomer|"
    r"cushion) (?:is|were|was) (?P<b>#\d+ \w+) thick(?: on this one| here)? (?:what|how many|"
    rf"which) {PARTS} of (?:it|that|this|the (?:thickness|gel))\b.*"
)
_NAMED = re.compile(r"\bstiffness\b|\bcompliance\b(?= (?:of|in|as|from|here|now)\b|$)")
_STIFFNESS = re.compile(
    r"(?:(?:give|tell|state|what|is|are|me|how|many|the|that|it|work|find|now|please|does|come|"
    r"to) )*"
    r"(?:n|newtons?) per (?:mm|millimet(?:re|er)s?) of (?:indentation|depth|dent|penetration|"
    r"travel)"
    r"(?: (?:do|does|is|are|we|you|it|there|work|that|ratio|out|figure|from|what|sense|feel|get|"
    r"have|now|here|by|going|please|at|present))*"
)
_FOR_EACH = re.compile(
    rf"\b(?:per|for (?:each|every|one|an?)|(?:with|to) (?:each|every)) (?:single )?({UNIT})\b"
)
_MANY = re.compile(rf"\bhow many ({UNIT})\b")
_OF_OTHERS = re.compile(
    r"\b(?:limit|band|mass|weight|area|square|x|y|offset|middle|center|load|holds?|lift\w*|"
    r"surely)\b"
)
_OF_PARTS = re.compile(
    r"(?:out )?of (?:every|each) (?P<n>#\d+) (?:parts?|cells?|points?|squares?|bits?) of (?:the )?"
    r"(?:sensing (?:surface|area)|pad|sensor|gel)(?: roughly| about| approximately)? how many "
    r"(?:are |is |of them are |do )?(?:being |you )?(?:covered|touched|pressed|in contact|feel)"
    r"(?: (?:right now|now|at present))?"
)
_COVERED = re.compile(r"how much of (?:the )?pad is (?:touched|covered|pressed|in contact)")


def share(asked: AskedWords) -> Term | None:
    """A term as a share of another one."""
    for pattern in _SHARES:
        found = pattern.fullmatch(asked.words)
        whole = asked.term(found["n"]) if found and "n" in found.groupdict() else None
        if whole and whole.expression != "100":
            continue
        if found and (pair := asked.pair(found["a"], found["b"])):
            a, b = pair
            if asked.is_ratio:
                return Term(expression=f"{a.factor} / {b.divisor}", dimension=PLAIN, words="")
            return Term(
                expression=f"100 * {a.factor} / {b.divisor}", dimension="fraction", words=""
            )
    return None


def ratio(asked: AskedWords) -> Term | None:
    """How many times a term another one is, by how many percent it exceeds it, and a product."""
    for pattern in _RATIOS:
        found = pattern.fullmatch(asked.words)
        named = shared_noun(asked, found["a"], found["b"]) if found else None
        if named and (pair := asked.pair(*named)):
            return Term(
                expression=f"{pair[0].factor} / {pair[1].divisor}", dimension=PLAIN, words=""
            )
        if found and (per := _per(asked.term(found["a"]), asked.term(found["b"]), asked.unit)):
            return per
    if found := _EXCEEDED.fullmatch(asked.words):
        pair = asked.pair(found["a"], found["b"], is_above=bool(found["above"]))
        if pair is not None:
            more, less = pair if found["above"] else pair[::-1]
            share = f"100 * ({more.expression} - {less.factor}) / {pair[1].divisor}"
            return Term(expression=share, dimension="fraction", words="")
    if found := _MULTIPLIED.fullmatch(asked.words):
        term, times = asked.term(found["a"]), asked.term(found["b"])
        if term is not None and times is not None:
            return replace(term, expression=f"{times.expression} * {term.factor}")
    return None


def unused(asked: AskedWords) -> Term | None:
    """What is left of a limit, as a share of it or as a force."""
    found = _UNUSED.fullmatch(asked.words)
    whole = asked.term(found["b"]) if found else None
    if whole is None or whole.dimension != "force":
        return None
    if asked.unit not in ("", "%"):
        return Term(
            expression=f"{whole.expression} - force_n", dimension="force", words="", is_sum=True
        )
    share = f"100 - 100 * force_n / {whole.divisor}"
    return Term(expression=share, dimension="fraction", words="", is_sum=True)


def stiffness(asked: AskedWords) -> Term | None:
    """The force over the depth, or the depth over the force."""
    words, unit = asked.words, asked.unit
    if asked.numbers:
        return None
    if _STIFFNESS.fullmatch(words):
        return Term(expression="force_n / depth_mm", dimension="N/mm", words="")
    if each := _FOR_EACH.search(words):
        one = unit.partition("/")[0] or next(
            (unit_of(found[1]) for found in _MANY.finditer(words)), ""
        )
        unit = f"{one}/{unit_of(each[1])}"
    elif not unit and (named := _NAMED.search(words)):
        unit = "N/mm" if named[0] == "stiffness" else "mm/N"
    dimensions = [UNITS[part].dimension for part in unit.split("/") if part in UNITS]
    expression = {
        "force/length": "force_n / depth_mm",
        "length/force": "depth_mm / force_n",
    }.get("/".join(dimensions))
    if expression is None or _OF_OTHERS.search(words):
        return None
    return Term(expression=expression, dimension=unit, words="")


def whole_share(asked: AskedWords) -> Term | None:
    """The touched part of the pad as a plain number, and the depth over a gel's named thickness."""
    parts = _OF_PARTS.fullmatch(asked.words)
    if parts and (count := asked.term(parts["n"])):
        if count.expression == "100":
            return Term(expression="area_percent", dimension="fraction", words="")
        expression = f"{count.expression} * area_percent / 100"
        return Term(expression=expression, dimension=PLAIN, words="")
    if asked.is_ratio and _COVERED.fullmatch(asked.words):
        return Term(expression="area_percent / 100", dimension=PLAIN, words="")
    found = _THICK.fullmatch(asked.words)
    thick = asked.term(found["b"]) if found else None
    if re.search(r"\bstrain\b", asked.words):
        thick = asked.only_value()
    if thick is None or thick.dimension != "length":
        return None
    share = f"100 * depth_mm / {thick.divisor}"
    return Term(expression=share, dimension="fraction", words="")


def _per(a: Term | None, b: Term | None, unit: str) -> Term | None:
    """A quantity over one of another dimension, in a quotient of units: that named, or N/mm."""
    if a is None or b is None or a.dimension == b.dimension:
        return None
    units = unit.split("/") if "/" in unit else [usual_unit(term.dimension) for term in (a, b)]
    if not (a.has_quantity and b.has_quantity) or not all(each in UNITS for each in units):
        return None
    if [UNITS[each].dimension for each in units] != [a.dimension, b.dimension]:
        return None
    return Term(expression=f"{a.factor} / {b.divisor}", dimension="/".join(units), words="")
