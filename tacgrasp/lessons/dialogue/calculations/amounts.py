"""Questions for a calculated number: shares, distances, sums.

    What percentage of 2 mm is the depth?       100 * depth_mm / 2
    How much is missing until it reaches 1 N?   1 - force_n
    Subtract the mass from 50 g.                50 - mass_g

Not here: suppositions (``tacgrasp.lessons.dialogue.calculations.suppositions``).
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import replace

from tacgrasp.lessons.dialogue.calculations.asked import AskedWords, usual, usual_unit
from tacgrasp.lessons.dialogue.calculations.quantity_names import is_band
from tacgrasp.lessons.dialogue.calculations.terms import (
    PLAIN,
    UNSAID,
    Term,
    alike,
    in_mm2,
    in_newtons,
)
from tacgrasp.lessons.dialogue.meaning import Calculated
from tacgrasp.lessons.dialogue.quantities import GRAVITY_N_PER_G, UNITS

_BELOW = (
    r"short of|below|under|beneath|shy of|(?:less|smaller|lower) than|falls? short of|"
    r"(?:lies?|falls?|stays?|remains?) (?:below|under|short of)|undershoots?|lacks? to|lacking to"
)
_ABOVE = (
    r"above|over|beyond|past|in excess of|exceeds?|surpass(?:es)?|overshoots?|"
    r"(?:more|greater|larger|higher|deeper) than|(?:lies?|goes|rises) (?:above|over|beyond)"
)
_APART = r"(?:away|apart|off)? ?from|off|differs? from|deviates? from"
_IS = r"(?:is|are|am|was|would|does|do|did|will|has|have|lies|lie|stands?)"
_GET = (
    r"(?:(?: and)?(?: then)? (?:how much|what)(?: .+)?|,? (?:and )?(?:give|tell|show|state|"
    r"say)(?: .+)?)?"
)
_TAIL = (
    r"(?: (?:amount|come|correspond|add up|be equal|equal) to| makes?(?: up)?| takes? up| "
    r"represents?|"
    r" at| uses?(?: up)?| be| equals?| account for| cover)?"
)
_PARTS = r"(?:percent|percentage|share|fraction|part|proportion)"
_USED = r"(?:taken up|used|used up|filled|consumed|reached|covered|exhausted)"
_FREE = (
    r"(?:unused|left|left over|free|available|remaining|in reserve|not used|spare|to spare|unspent|"
    r"still there|untapped)"
)

_SHARES = tuple(
    re.compile(pattern)
    for pattern in (
        rf"(?:what|how many|how much|which) {_PARTS} of (?P<b>.+) {_IS} (?P<a>.+?){_TAIL}",
        rf"(?P<a>.+) (?:is|are|makes|amounts? to|represents?|equals?|comes? to|corresponds? to) "
        rf"(?:what|how many|which) {_PARTS} of (?P<b>.+)",
        rf"how much of (?P<b>.+) (?:is|are) {_USED} by (?P<a>.+)",
        r"how much of (?P<b>.+) (?:does|do) (?P<a>.+) (?:take up|use(?: up)?|fill|make up)",
        rf"(?:what is |how much is )?(?P<a>.+) (?:as|in|expressed as) (?:an? )?{_PARTS} of "
        rf"(?P<b>.+)",
        r"(?:what is |how much is )?(?P<a>.+) relative to (?P<b>.+)",
        rf"what (?:does|do|would) (?P<a>.+) (?:come|amount) to (?:as|in) (?:an? )?{_PARTS} "
        rf"of (?P<b>.+)",
    )
)
_RATIOS = tuple(
    re.compile(pattern)
    for pattern in (
        r"how many times(?: \w+)? (?:is|are) (?P<a>.+) (?:than|as|of) (?P<b>.+)",
        r"how many times (?:does|do) (?P<b>.+) (?:fit|go) (?:in|into) (?P<a>.+)",
        r"(?:(?:what|how much) (?:do|would) (?:you|we|i) (?:get|have) (?:if|when) (?:you|we|"
        r"i) )?divide "
        r"(?P<a>.+) by (?P<b>.+)",
        r"(?:what is )?(?P<a>.+) divided by (?P<b>.+)",
        r"(?:what is |the )*ratio (?:of|between) (?P<a>.+) (?:to|and) (?P<b>.+)",
        r"how many times (?P<b>the .+?) (?:is|are) (?P<a>.+)",
        r"by (?:what|which) (?:factor|number) (?:would|must|should|do|could|can) (?:i|we|"
        r"you) (?:have to )?"
        r"(?:multiply|scale|raise) (?P<b>.+) to (?:land (?:exactly )?on|get(?: to)?|reach|be "
        r"at|obtain) (?P<a>.+)",
    )
)
_EXCEEDED = re.compile(
    rf"by (?:what|how many|how much|which) {_PARTS} (?:is|are|does|do) (?P<a>.+?) "
    rf"(?:(?P<below>{_BELOW})|(?P<above>{_ABOVE})) (?P<b>.+)"
)
_MULTIPLIED = re.compile(r"multiply (?P<a>.+) by (?P<b>#\d+)")
_UNUSED = re.compile(
    rf"(?:what|how many|how much|which)(?: {_PARTS})? of (?P<b>.+?)(?: is| are| do we(?: still)? "
    rf"have| have we)?"
    rf"(?: still)?(?: remains?| stays?| is)? {_FREE}"
)
_MISSING = re.compile(
    r"how much(?: more| further)?(?: (?:is|are|do we|does it|would it))?(?: still)? "
    r"(?:missing|lacking|left|needed|lack|to go|remain(?:s|ing)?) "
    r"(?:until|till|to|before|up to|for|from) (?:(?P<a>.+?) (?:reaches|reach|gets? to|hits?|is at|"
    r"touches|arrives at|measures?d?|was|were at) )?(?:reach(?:ing)? )?(?P<b>.+)"
)
_FURTHER = re.compile(
    r"how (?:much|far)(?: (?:more|further|deeper|harder|force|of [a-z]+))* (?:(?:i|we|you|it) "
    r")?(?:would|must|does|do|can|"
    r"could|may|should|will|has|have|need) .+? to (?:reach|get to|arrive at|hit|be at|come "
    r"to|get up to) (?P<b>.+)"
)
_UNTIL = re.compile(
    r"how much(?: (?:more|further|deeper|is there|do we have|have we))*(?: (?:can|could|may|might) "
    r"(?:we|you|i|it) \w+)? "
    r"(?:until|till|to|before|up to) (?:(?:we|you|it|i|the \w+) (?:reach|hit|are at|get to|reaches|"
    r"reached|hits|measures?d?|was) )?(?P<b>.+)"
)
_SLACK = re.compile(
    r"(?:what|how much) (?:slack|room|margin|leeway|headroom|distance|space)"
    r"(?: (?:have we|do we have|is there|is|do you have))?(?: (?:left|got|still))* "
    r"(?:before|to|until|up to|below|under|till) (?P<b>.+)"
)
_SEPARATED = re.compile(
    r"how much (?:separates?|divides?|lies? between|would separate|is between) (?P<a>.+?) "
    r"(?:from|and) (?P<b>.+)"
)
_INTO_BAND = re.compile(
    r"(?:how much|what is the (?:smallest|least)).*\b(?:change|correct(?:ion)?|adjust(?:ment)?)\b.*"
    r" (?:in|inside|within|into|to) (?:the |our )?(?P<band>.+?)(?: if .*)?"
)
_THICK = re.compile(
    r"(?:if|suppose|assuming|say|given) (?:the|this|our) (?:gel|pad|skin) (?:is|were|was) "
    r"(?P<b>#\d+ \w+) thick (?:what|how many|"
    rf"which) {_PARTS} of (?:it|that|the (?:thickness|gel))\b.*"
)
_COVERED = re.compile(r"how much of (?:the )?pad is (?:touched|covered|pressed|in contact)")
_AT = re.compile(
    r"at how much (?:would|will|do|should) (?:we|i|it|you) (?:stand|be)(?: at)? (?P<a>.+)"
)
_APARTS = tuple(
    re.compile(pattern)
    for pattern in (
        rf"(?:by )?how (?:much|far) (?:{_IS} )?(?P<a>.+?) (?:(?:lie|be|stay|sit|stand) )?"
        rf"(?:(?P<below>{_BELOW})|(?P<above>{_ABOVE})|(?P<apart>{_APART})) (?P<b>.+)",
        rf"(?:by )?how (?:much|far) (?:(?P<below>{_BELOW})|(?P<above>{_ABOVE})|"
        rf"(?P<apart>{_APART})) "
        rf"(?P<b>.+) {_IS} (?P<a>.+?)(?: (?:lie|be|sit|stand|lying))?",
        r"how (?:much|far)(?: (?:lies?|is there|are there|is|remains?|room is there))? "
        r"(?P<apart>between) (?P<a>.+) and (?P<b>.+)",
        r"what (?:is|would) (?:the )?(?P<apart>distance|gap|difference)(?P<a>) (?:to|from) "
        r"(?P<b>.+?)(?: be)?",
        r"(?:what is|how (?:large|big|wide|great) is) (?:the )?(?P<apart>difference|gap|distance|"
        r"spread)(?: there)? between (?P<a>.+) and (?P<b>.+)",
    )
)
_TAKEN = tuple(
    re.compile(pattern)
    for pattern in (
        rf"(?:subtract|deduct|take(?: away)?|remove) (?P<b>.+?) from (?P<a>.+?){_GET}",
        r"how much (?:is|are|would be|remains?) (?:left|left over|remaining|there)? ?(?:if|"
        r"when|after) "
        r"(?:you |we |i )?(?P<b>.+) (?:is|are) (?:subtracted|taken(?: away)?|deducted|removed) "
        r"from (?P<a>.+)",
        r"(?:what|how much) (?:do|would) (?:you|we|i) (?:get|have) (?:if|when) (?:you|we|i) "
        r"(?:subtract|deduct|take) (?P<b>.+) from (?P<a>.+)",
        rf"(?:take|start with|begin with)? ?(?P<a>.+?)(?: and)?(?: then)? (?:subtract|deduct|"
        rf"take away|"
        rf"take off) (?P<b>.+?){_GET}",
    )
)
_ADDED = tuple(
    re.compile(pattern)
    for pattern in (
        rf"add (?P<b>.+?) (?:to|and) (?P<a>.+?){_GET}",
        r"(?:what|how much) (?:do|would) (?:you|we|i) (?:get|have) (?:if|when) (?:you|we|i) "
        r"add (?P<b>.+) (?:to|and) (?P<a>.+)",
    )
)
_WEIGHS = re.compile(
    r"(?:how much|what) (?:does|do|would|will) (?:(?:the|that|this) )?[a-z]+ weigh"
)
_MASS_OF = re.compile(
    r"(?:what|which|how much|how large a) (?:mass|weight)(?: would| does)? (?:weighs?|be|"
    r"is)(?: (?:exactly|just))? "
    r"(?:as much as|the same as|equal to) (?P<a>.+?)(?: here on earth| on earth| take g .*)?"
)
_POINT = re.compile(
    r"(?:what is |how (?:much|far) is )?(?:the )?(?:distance (?:between|from|of) )?(?:the "
    r")?(?:contact|it) "
    r"(?:and|to|from|away from) (?:the )?(?:(?:point|spot|place) )?(?:at )?x (?P<x>#.+?) "
    r"(?:and )?y (?P<y>#.+)"
)
_ALONE = re.compile(
    r"(?:(?:what|how (?:much|large|big|great)|(?:what|which) (?:force|depth|mass|area)) "
    r"(?:is|are|would be|makes?) )?(?P<a>.+?)"
    r"(?: (?:(?:what|how much) is (?:it|that|the .+)|(?:comes?|amounts?) to (?:what|how "
    r"much)|(?:is|makes|"
    r"equals) "
    r"(?:what|how much)|under earth gravity.*|given the (?:stated |told )?mass))*"
)
_COUNT = re.compile(
    r"(?:(?:if|given) .+ )?(?:what|how much)(?: (?:mass|weight))? (?:would|do|does|will) "
    r"(?P<n>#\d+) (?:of (?:them|these|"
    r"those|it)|such \w+|(?:of )?(?:these |the )?(?:objects|things|pieces|items|berries))"
    r"(?: (?:have|weigh|together|be|come to|amount to))+"
)


def calculated_amount(asked: AskedWords) -> Calculated | None:
    """The number that a question asks to calculate; None where it asks for none."""
    readers: tuple[Callable[[AskedWords], Term | None], ...] = (
        _unused, _share, _ratio, _missing, _apart, _taken,
        _counted, _weight, _from_point, _worked_out, _alone,
    )  # fmt: skip
    for reader in readers:
        if (term := reader(asked)) and (amount := amount_of(term, asked)):
            return amount
    return None


def amount_of(term: Term, asked: AskedWords) -> Calculated | None:
    """A term as the answer; None where it can't be given in the unit that is asked for."""
    if not term.has_quantity or term.dimension == UNSAID:
        return None
    expression = term.expression
    if asked.is_unsigned:
        expression = f"abs({expression})"
    if asked.has_floor:
        expression = f"max(0, {expression})"
    unit = asked.unit or usual_unit(term.dimension)
    if term.dimension == PLAIN:
        return Calculated(truth=expression, unit="")
    if "/" in term.dimension:
        return Calculated(truth=expression, unit=term.dimension)
    if UNITS[unit].dimension == "force" and term.dimension == "mass":
        return Calculated(truth=in_newtons(term).expression, unit=unit)
    if UNITS[unit].dimension == "area" and "area_percent" in expression and term.is_sum is False:
        return Calculated(truth=in_mm2(term).expression, unit=unit)
    if UNITS[unit].dimension != term.dimension:
        return None
    return Calculated(truth=expression, unit=unit)


def _pair(
    asked: AskedWords, a: str | None, b: str, *, is_above: bool | None = None
) -> tuple[Term, Term] | None:
    """Two terms in one dimension; without the first it is the usual one beside the second.

    Above or below the band is above or below its end.
    """
    second = asked.term(b) if is_above is None else asked.bound(b, is_above=is_above)
    if second is None:
        return None
    if not a:
        first = asked.subject or (usual(second.dimension) if usual_unit(second.dimension) else None)
    else:
        first = asked.term(a, beside=second)
    return alike(first, second) if first else None


def _share(asked: AskedWords) -> Term | None:
    for pattern in _SHARES:
        found = pattern.fullmatch(asked.words)
        if found and (pair := _pair(asked, found["a"], found["b"])):
            a, b = pair
            if asked.is_ratio:
                return Term(expression=f"{a.factor} / {b.divisor}", dimension=PLAIN, words="")
            return Term(
                expression=f"100 * {a.factor} / {b.divisor}", dimension="fraction", words=""
            )
    return None


def _ratio(asked: AskedWords) -> Term | None:
    """How many times a term another one is, by how many percent it exceeds it, and a product."""
    for pattern in _RATIOS:
        found = pattern.fullmatch(asked.words)
        if found and (pair := _pair(asked, found["a"], found["b"])):
            return Term(
                expression=f"{pair[0].factor} / {pair[1].divisor}", dimension=PLAIN, words=""
            )
        if found and (per := _per(asked.term(found["a"]), asked.term(found["b"]))):
            return per
    if found := _EXCEEDED.fullmatch(asked.words):
        pair = _pair(asked, found["a"], found["b"], is_above=bool(found["above"]))
        if pair is not None:
            more, less = pair if found["above"] else pair[::-1]
            share = f"100 * ({more.expression} - {less.factor}) / {pair[1].divisor}"
            return Term(expression=share, dimension="fraction", words="")
    if found := _MULTIPLIED.fullmatch(asked.words):
        term, times = asked.term(found["a"]), asked.term(found["b"])
        if term is not None and times is not None:
            return replace(term, expression=f"{times.expression} * {term.factor}")
    return None


def _per(a: Term | None, b: Term | None) -> Term | None:
    """A quantity over one of another dimension, in units such as N/mm."""
    units = [usual_unit(term.dimension) for term in (a, b) if term and term.has_quantity]
    if a is None or b is None or len(units) < 2 or not all(units) or a.dimension == b.dimension:
        return None
    return Term(expression=f"{a.factor} / {b.divisor}", dimension="/".join(units), words="")


def _unused(asked: AskedWords) -> Term | None:
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


def _missing(asked: AskedWords) -> Term | None:
    for pattern in (_MISSING, _FURTHER, _SLACK, _UNTIL):
        found = pattern.fullmatch(asked.words)
        named = found.groupdict().get("a") if found else None
        if found and (pair := _pair(asked, named, found["b"])):
            return _difference(pair[1], pair[0])
    return None


def _apart(asked: AskedWords) -> Term | None:
    for pattern in (*_APARTS, _SEPARATED):
        if (found := pattern.fullmatch(asked.words)) is None:
            continue
        sides = found.groupdict()
        is_above = bool(sides["above"]) if sides.get("above") or sides.get("below") else None
        if (pair := _pair(asked, found["a"], found["b"], is_above=is_above)) is None:
            continue
        a, b = pair
        if sides.get("below"):
            return _difference(b, a)
        if sides.get("above"):
            return _difference(a, b)
        if asked.is_signed:
            return _difference(a, b)
        apart = f"abs({a.expression} - {b.factor})"
        return Term(expression=apart, dimension=a.dimension, words="")
    return None


def _difference(a: Term, b: Term) -> Term:
    expression = f"{a.expression} - {b.factor}"
    return Term(expression=expression, dimension=a.dimension, words="", is_sum=True)


def _taken(asked: AskedWords) -> Term | None:
    for patterns, sign in ((_TAKEN, "-"), (_ADDED, "+")):
        for pattern in patterns:
            found = pattern.fullmatch(asked.words)
            if found and (pair := _pair(asked, found["a"], found["b"])):
                a, b = pair
                expression = f"{a.expression} {sign} {b.factor}"
                return Term(expression=expression, dimension=a.dimension, words="", is_sum=True)
    return None


def _weight(asked: AskedWords) -> Term | None:
    """The object's weight in newtons, and the mass that weighs as much as a force."""
    if _WEIGHS.fullmatch(asked.words) and asked.unit in ("N", "mN"):
        return Term(expression="mass_g", dimension="mass", words="", is_weight=True)
    found = _MASS_OF.fullmatch(asked.words)
    force = asked.term(found["a"], beside=usual("force")) if found else None
    if force is None or force.dimension != "force":
        return None
    return Term(expression=f"{force.factor} / {GRAVITY_N_PER_G:g}", dimension="mass", words="")


def _worked_out(asked: AskedWords) -> Term | None:
    """Shares of pad and gel, the least change into the band, and a share that is stood at."""
    if asked.is_ratio and _COVERED.fullmatch(asked.words):
        return Term(expression="area_percent / 100", dimension=PLAIN, words="")
    found = _THICK.fullmatch(asked.words)
    thick = asked.term(found["b"]) if found else None
    if thick is not None and thick.dimension == "length":
        share = f"100 * depth_mm / {thick.divisor}"
        return Term(expression=share, dimension="fraction", words="")
    if (found := _INTO_BAND.fullmatch(asked.words)) and is_band(found["band"]):
        change = "max(0, band_low_n - force_n, force_n - band_high_n)"
        return Term(expression=change, dimension="force", words="")
    return asked.term(found["a"]) if (found := _AT.fullmatch(asked.words)) else None


def _from_point(asked: AskedWords) -> Term | None:
    found = _POINT.fullmatch(asked.words)
    pairs = [_pair(asked, name, found[name]) if found else None for name in "xy"]
    sides = [f"{pair[0].expression} - {pair[1].factor}" for pair in pairs if pair]
    if len(sides) < 2:
        return None
    return Term(expression=f"hypot({', '.join(sides)})", dimension="length", words="")


def _counted(asked: AskedWords) -> Term | None:
    found = _COUNT.fullmatch(asked.words)
    count = asked.term(found["n"]) if found else None
    if count is None:
        return None
    return Term(expression=f"{count.expression} * mass_g", dimension="mass", words="")


def _alone(asked: AskedWords) -> Term | None:
    """A term that is itself what is asked for, where it is more than a quantity."""
    found = _ALONE.fullmatch(asked.words)
    term = asked.term(found["a"]) if found else None
    if term is None:
        return None
    is_simple = re.fullmatch(r"\w+", term.expression) is not None
    in_force = term.is_weight and asked.unit in ("N", "mN")
    return term if in_force or not is_simple else None
