"""Questions for a sum of terms, or for how far they are apart.

    How much is missing until it reaches 1 N?   1 - force_n
    Subtract the mass from 50 g.                50 - mass_g
    How far is it from x = 1 mm, y = 2 mm?      hypot(x_mm - 1, y_mm - 2)

Not here: shares and ratios (``tacgrasp.lessons.dialogue.calculations.shares``).
"""

from __future__ import annotations

import re

from tacgrasp.lessons.dialogue.calculations.asked import AskedWords
from tacgrasp.lessons.dialogue.calculations.phrases import ABOVE, BELOW, IS
from tacgrasp.lessons.dialogue.calculations.quantity_names import is_band
from tacgrasp.lessons.dialogue.calculations.terms import Term

_APART = r"(?:away|apart|off)? ?from|off|differs? from|deviates? from"
_GET = (
    r"(?:(?: and)?(?: then)? (?:how much|what)(?: .+)?|"
    r",? (?:and )?(?:give|tell|show|state|say)(?: .+)?)?"
)
_MISSING = re.compile(
    r"how much(?: more| further)?(?: (?:is|are|do we|does it|would it))?(?: still)? "
    r"(?:missing|lacking|left|needed|lack|to go|remain(?:s|ing)?) "
    r"(?:until|till|to|before|up to|for|from) (?:(?P<a>.+?) "
    r"(?:reaches|reach|gets? to|hits?|is at|touches|arrives at|measures?d?|was|were at) "
    r")?(?:reach(?:ing)? )?(?P<b>.+)"
)
_FURTHER = re.compile(
    r"how (?:much|far)(?: (?:more|further|deeper|harder|force|of [a-z]+))* "
    r"(?:(?:i|we|you|it) )?(?:would|must|does|do|can|could|may|should|will|has|have|need) .+? to "
    r"(?:reach|get to|arrive at|hit|be at|come to|get up to) (?P<b>.+)"
)
_UNTIL = re.compile(
    r"how much(?: (?:more|further|deeper|is there|do we have|have we))*(?: (?:can|could|may|might) "
    r"(?:we|you|i|it) \w+)? (?:until|till|to|before|up to) "
    r"(?:(?:we|you|it|i|the \w+) (?:reach|hit|are at|get to|reaches|reached|hits|measures?d?|was) "
    r")?(?P<b>.+)"
)
_SLACK = re.compile(
    r"(?:what|how much) (?:slack|room|margin|leeway|headroom|distance|"
    r"space)(?: (?:have we|do we have|is there|is|do you have))?(?: (?:left|got|still))* "
    r"(?:before|to|until|up to|below|under|till) (?P<b>.+)"
)
_SEPARATED = re.compile(
    r"how much (?:separates?|divides?|lies? between|would separate|is between) (?P<a>.+?) "
    r"(?:from|and) (?P<b>.+)"
)
_APARTS = tuple(
    re.compile(pattern)
    for pattern in (
        rf"(?:by )?how (?:much|far) (?:{IS} )?(?P<a>.+?) (?:(?:lie|be|stay|sit|stand) )?"
        rf"(?:(?P<below>{BELOW})|(?P<above>{ABOVE})|(?P<apart>{_APART})) (?P<b>.+)",
        rf"(?:by )?how (?:much|far) (?:(?P<below>{BELOW})|(?P<above>{ABOVE})|(?P<apart>{_APART})) "
        rf"(?P<b>.+) {IS} (?P<a>.+?)(?: (?:lie|be|sit|stand|lying))?",
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
        r"how much (?:is|are|would be|remains?) (?:left|left over|remaining|there)? "
        r"?(?:if|when|after) (?:you |we |i )?(?P<b>.+) (?:is|are) "
        r"(?:subtracted|taken(?: away)?|deducted|removed) "
        r"from (?P<a>.+)",
        r"(?:what|how much) (?:do|would) (?:you|we|i) (?:get|have) (?:if|when) (?:you|we|i) "
        r"(?:subtract|deduct|take) (?P<b>.+) from (?P<a>.+)",
        rf"(?:take|start with|begin with)? ?(?P<a>.+?)(?: and)?(?: then)? "
        rf"(?:subtract|deduct|take away|"
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
_INTO_BAND = re.compile(
    r"(?:how much|what is the (?:smallest|least)).*\b(?:change|correct(?:ion)?|"
    r"adjust(?:ment)?)\b.* (?:in|inside|within|into|to) (?:the |our )?(?P<band>.+?)(?: if .*)?"
)
_POINT = re.compile(
    r"(?:what is |how (?:much|far) is )?(?:the )?(?:distance (?:between|from|of) )?(?:the "
    r")?(?:contact|it) (?:and|to|from|away from) (?:the )?(?:(?:point|spot|place) )?(?:at )?x "
    r"(?P<x>#.+?) (?:and )?y (?P<y>#.+)"
)


def missing(asked: AskedWords) -> Term | None:
    """What is missing until a term is reached."""
    for pattern in (_MISSING, _FURTHER, _SLACK, _UNTIL):
        found = pattern.fullmatch(asked.words)
        named = found.groupdict().get("a") if found else None
        if found and (pair := asked.pair(named, found["b"])):
            return _difference(pair[1], pair[0])
    return None


def apart(asked: AskedWords) -> Term | None:
    """How far a term is below, above or away from another one."""
    for pattern in (*_APARTS, _SEPARATED):
        if (found := pattern.fullmatch(asked.words)) is None:
            continue
        sides = found.groupdict()
        is_above = bool(sides["above"]) if sides.get("above") or sides.get("below") else None
        if (pair := asked.pair(found["a"], found["b"], is_above=is_above)) is None:
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


def taken(asked: AskedWords) -> Term | None:
    """One term taken from another one, or added to it."""
    for patterns, sign in ((_TAKEN, "-"), (_ADDED, "+")):
        for pattern in patterns:
            found = pattern.fullmatch(asked.words)
            if found and (pair := asked.pair(found["a"], found["b"])):
                a, b = pair
                expression = f"{a.expression} {sign} {b.factor}"
                return Term(expression=expression, dimension=a.dimension, words="", is_sum=True)
    return None


def from_point(asked: AskedWords) -> Term | None:
    """The distance of the contact from a named point of the pad."""
    found = _POINT.fullmatch(asked.words)
    pairs = [asked.pair(name, found[name]) if found else None for name in "xy"]
    sides = [f"{pair[0].expression} - {pair[1].factor}" for pair in pairs if pair]
    if len(sides) < 2:
        return None
    return Term(expression=f"hypot({', '.join(sides)})", dimension="length", words="")


def into_band(asked: AskedWords) -> Term | None:
    """The least change of force that leads into the band."""
    found = _INTO_BAND.fullmatch(asked.words)
    if found is None or not is_band(found["band"]):
        return None
    change = "max(0, band_low_n - force_n, force_n - band_high_n)"
    return Term(expression=change, dimension="force", words="")


def _difference(a: Term, b: Term) -> Term:
    expression = f"{a.expression} - {b.factor}"
    return Term(expression=expression, dimension=a.dimension, words="", is_sum=True)
