"""Questions for a sum of terms, or for how far they are apart.

    How much is missing until it reaches 1 N?   1 - force_n
    How much may I add before I leave the band? band_high_n - force_n
    Subtract the mass from 50 g.                50 - mass_g
    How far is it from x = 1 mm, y = 2 mm?      hypot(x_mm - 1, y_mm - 2)

Not here: shares and ratios (``tacgrasp.lessons.dialogue.calculations.shares``).
"""

from __future__ import annotations

import re

from tacgrasp.lessons.dialogue.calculations.asked import AskedWords, usual
from tacgrasp.lessons.dialogue.calculations.phrases import ABOVE, BELOW, IS
from tacgrasp.lessons.dialogue.calculations.quantity_names import is_band
from tacgrasp.lessons.dialogue.calculations.terms import Term
from tacgrasp.lessons.dialogue.conditions import OUTSIDE_BAND

_APART = r"(?:away|apart|off)? ?from|off|differs? from|deviates? from"
_GET = (
    r"(?:(?: and)?(?: then)? (?:how much|what)(?: .+)?|"
    r",? (?:and )?(?:give|tell|show|state|say|report|let (?:me|us)|hand)(?: .+)?)?"
)
_MISSING = re.compile(
    r"how much(?: more| further)?(?: (?:is|are|do we|does it|would it|would|will))?(?: "
    r"still)?(?: be)? "
    r"(?:missing|lacking|left|needed|lack|to go|remain(?:s|ing)?) "
    r"(?:until|till|to|before|up to|for|from) (?:(?P<a>.+?) "
    r"(?:reaches|reach|gets? to|hits?|is at|touches|arrives at|measures?d?|was|were at) "
    r")?(?:reach(?:ing)? )?(?P<b>.+)"
)
_FURTHER = re.compile(
    r"(?:by )?how (?:much|far)(?: (?:more|further|deeper|harder|extra|additional|force|grip|"
    r"squeeze|"
    r"of [a-z]+))* "
    r"(?:(?:i|we|you|it) )?(?:would|must|does|do|can|could|may|should|will|has|have|need) "
    r"(?:(?!than)(?!without)[a-z]+ )+?(?:to (?:reach|get to|make(?: it)?|arrive at|hit|be at|"
    r"come to|get up to|"
    r"come up to|touch)|(?:before|until|till) (?:it|i|we|you|(?:the|my|our) (?:\w+ )?\w+) "
    r"(?:reach(?:es)?|hits?|(?:is|are|was|were) at|gets? to|(?:comes?|gets?) up to|measures?|"
    r"touch(?:es)?|"
    r"bottoms? out at)) (?P<b>.+)"
)
_UNTIL = re.compile(
    r"how much(?: (?:more|further|deeper|extra|grip|force|squeeze|is there|do we have|have we|"
    r"left|to go))*(?: (?:can|could|may|might) (?:we|you|i|it) \w+)? (?:until|till|to|before|"
    r"up to) "
    r"(?:(?:we|you|it|i|the \w+) (?:reach|hit|are(?: at)?|is(?: at)?|get to|reaches|reached|hits|"
    r"measures?d?|was|touch|am at|go (?:over|past|beyond)|exceed|"
    r"gets? (?:up |down )?to|comes? (?:up )?to|touches|come to|"
    r"bump into|run into) )?(?P<b>.+?)"
    r"(?: (?:deep |down )?(?:in|into) (?:the|this|that) \w+)?"
)
_SLACK = re.compile(
    r"(?:what|how much)(?: is the)? (?:slack|room|margin|leeway|headroom|distance|reserve|"
    r"space)(?: (?:have we|do we have|is there|is|do you have|remains?|stays?|remaining))?"
    r"(?: (?:left|got|still))* (?:before|to|until|up to|below|under|till) (?P<b>.+)"
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
        rf"(?:by )?how (?:much|far) (?:(?P<below>{BELOW})|(?P<above>{ABOVE}))(?P<a>) "
        rf"(?P<b>(?!(?:.* )?{IS}\b).+)",
        rf"how (?:close|near) {IS} (?P<a>.+?)(?: be| get)? (?P<apart>to) (?P<b>.+)",
        rf"how (?:close|near)(?P<apart> to)? (?P<b>.+) {IS} (?P<a>.+?)(?: be| get| come)?",
        r"how (?:much|far)(?: (?:lies?|is there|are there|is|remains?|room is there))? "
        r"(?P<apart>between) (?P<a>.+) and (?P<b>.+)",
        r"what (?:is|would) (?:the )?(?P<apart>distance|gap|difference)(?P<a>) (?:to|from) "
        r"(?P<b>.+?)(?: be)?",
        r"(?:what is|how (?:large|big|wide|great) is) (?:the )?(?P<apart>difference|gap|distance|"
        r"spread)(?: there)? between (?P<a>.+) and (?P<b>.+)",
        rf"(?:the )?amount by which (?P<a>.+?) (?:{IS} )?(?:(?P<below>{BELOW})|(?P<above>{ABOVE}|"
        r"overshoot|exceed|surpass)) (?P<b>.+)",
        r"(?:(?:what|how (?:large|big|much|great)) is )?(?:the )?(?P<above>excess|surplus|"
        r"overshoot|"
        r"overrun|overage)(?P<a>) (?:over|above|beyond|past|of|on|from) (?P<b>.+)",
        r"(?:(?:what|how (?:large|big|much|great)) is )?(?:the )?(?P<below>shortfall|deficit|lack|"
        r"shortage)(?P<a>) (?:to|below|from|against|under|of|on|relative to) (?P<b>.+)",
        r"(?:(?:what|how (?:large|big|much|great|wide|far)) is )?(?:the )?(?P<apart>gap|distance|"
        r"difference|step|jump|climb|way|margin|room) from (?P<a>.+?) (?:up |down )?to (?P<b>.+)",
        r"(?:(?:what|how (?:large|big|much|great|wide|far)) is )?(?:the )?(?P<apart>gap|distance|"
        r"difference|spread) between (?P<a>.+) and (?P<b>.+)",
        rf"compared (?:with|to) (?P<b>.+?) (?:by )?how (?:much|far) (?:(?P<below>lower|less|"
        rf"smaller|"
        rf"weaker)|(?P<above>higher|more|larger|greater|stronger)|off|away) {IS} (?P<a>.+)",
        r"(?:the )?(?P<below>headroom|room|margin|leeway|reserve)(?P<a>)(?: left)? (?:to|up to|"
        r"until|under|below|beneath|"
        r"before) (?P<b>.+)",
        r"(?:(?:what|how (?:large|big|much|great)) is )?(?:the )?(?P<apart>deviation|departure|"
        r"error)"
        r"(?: of (?P<a>.+?))? (?:from|to|against) (?P<b>.+)",
        rf"(?P<b>.+?) (?:by )?how (?:much|far) (?:(?P<below>{BELOW})|(?P<above>{ABOVE})) "
        rf"(?:it|that|this) {IS} (?P<a>.+)",
    )
)
_FROM_TO = re.compile(r"\bfrom .+ to\b")
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
_BEYOND = re.compile(
    r"(?P<a>.+?) (?:left(?: over)?|to spare|in reserve) (?:beyond|above|after|over|"
    r"besides) (?P<b>.+)"
)
_ADDED = tuple(
    re.compile(pattern)
    for pattern in (
        rf"add(?: up)? (?P<b>.+?) (?:to|and) (?P<a>.+?)(?: together| up)?{_GET}",
        r"(?:(?:what is|give me|the) )*sum of (?P<b>.+) and (?P<a>.+)",
        r"(?:what|how much) (?:do|would) (?:you|we|i) (?:get|have) (?:if|when) (?:you|we|i) "
        r"add (?P<b>.+) (?:to|and) (?P<a>.+)",
    )
)
_INTO_BAND = re.compile(
    r"(?:how much|what is the (?:smallest|least)).*\b(?:change|correct(?:ion)?|"
    r"adjust(?:ment)?)\b.* (?:in|inside|within|into|to) (?:the |our )?(?P<band>.+?)(?: if .*)?"
)
_LEAVING = re.compile(
    r"how (?:much|far)(?: (?:more|further|less|harder|looser|tighter|extra|force|grip|squeeze))* "
    r"(?:can|could|may|might|would) (?:i|we|you|it|the \w+) (?:still )?(?:be )?(?:(?P<less>lose|"
    r"loosen(?:ed)?|lower(?:ed)?|ease|relax(?:ed)?|reduced?|cut|drop|fall|sink|slacken|release|"
    r"give|"
    r"take|let)|add|squeeze|increased?|raised?|rise|grow|tighten(?:ed)?|press|grip|push|go|put|"
    r"gain)"
    r"(?: (?:off|up|on|back|away|harder|more|less|further|down|out|the (?:force|grip|squeeze)|"
    r"force|at (?:the )?(?:very )?most))* "
    r"(?:before|until|till|without) (?:(?:i|we|you|it|the (?:force|grip)) )?(?:am |are |is |"
    r"being )?"
    r"(?:leav(?:e|es|ing)|exceed(?:s|ing)?|overshoot(?:s|ing)?|outside(?: of)?|beyond|"
    r"(?:drop|fall|slip|get|go|rise|com|be)(?:s|ping|ing|ting|e|es)? (?:out of|out|above|below|"
    r"under|"
    r"over|beyond|outside|past)) (?:the |our )?(?P<band>.+)"
)
_POINT = re.compile(
    r"(?:what is |how (?:much|far) is )?(?:the )?(?:distance (?:between|from|of) )?(?:the "
    r")?(?:contact|it) (?:and|to|from|away from) (?:the )?(?:(?:point|spot|place) )?(?:at )?x "
    r"(?P<x>#.+?) (?:and )?y (?P<y>#.+)"
)


_HEADROOM = re.compile(
    r"(?:what|how (?:much|large|big|many))(?: (?:is|of an?|the))* (?:headroom|room|margin|leeway|"
    r"reserve|slack|buffer)"
    r"(?: (?:would|will|do|is|are|we|i|there|be|still|then|remain|remains|left|have|get|over|"
    r"(?:to|below|before|under|until|beneath) (?:it|the (?:force )?limit)))*"
)


_FROM_HERE = re.compile(
    r"from (?:here|us|the force|it|now|what we have) (?:up |down )?to (?P<b>.+?) (?:it is|is it|is|"
    r"are|there is|there are) how (?:much|far)|how (?:much|far) (?:is it )?from (?:here|us|now) "
    r"(?:up |down )?to (?P<c>.+)"
)
_LOWERED = re.compile(
    r"how (?:much|far) (?:must|should|would|do|does|could|will|has|have|need|needs)"
    r"(?: (?:i|we|you|it|the \w+))?(?: (?:have|need|needs|be|to|back|ease|come|go|taken|take|let|"
    r"shed|lose|lost|off|down|up|loosen|loosened|slacken|removed|cut|drop|dropped|reduced|"
    r"force|grip))* (?:to|until|before) (?:(?:we|it|i|you) )?(?:be |is |are )?"
    r"(?:(?:come|comes|get|gets|go|drop|drops|fall|falls|return) )?(?:back )?down (?:to|"
    r"at) (?P<b>.+)"
)


def missing(asked: AskedWords) -> Term | None:
    """What is missing until a term is reached."""
    if asked.subject is not None and _HEADROOM.fullmatch(asked.words):
        pair = asked.pair("we", "the limit")
        return _difference(pair[1], pair[0]) if pair else None
    if (found := _LOWERED.fullmatch(asked.words)) and (pair := asked.pair(None, found["b"])):
        return _difference(*pair)
    if (found := _FROM_HERE.fullmatch(asked.words)) and (
        pair := asked.pair(None, found["b"] or found["c"])
    ):
        return _difference(pair[1], pair[0])
    for pattern in (_MISSING, _FURTHER, _SLACK, _UNTIL):
        found = pattern.fullmatch(asked.in_its_unit(asked.words))
        named = found.groupdict().get("a") if found else None
        if found and (pair := asked.pair(named, found["b"])):
            return _difference(pair[1], pair[0])
    return None


def before_leaving(asked: AskedWords) -> Term | None:
    """What may be added, or taken off, before the force leaves the band."""
    found = _LEAVING.fullmatch(asked.words)
    if found is None or not is_band(found["band"]):
        return None
    room = "force_n - band_low_n" if found["less"] else "band_high_n - force_n"
    return Term(expression=room, dimension="force", words="", is_sum=True)


def apart(asked: AskedWords) -> Term | None:
    """How far a term is below, above or away from another one."""
    for pattern in (*_APARTS, _SEPARATED):
        if (found := pattern.fullmatch(asked.words)) is None:
            continue
        sides = found.groupdict()
        is_above = bool(sides.get("above")) if sides.get("above") or sides.get("below") else None
        if (pair := asked.pair(found["a"], found["b"], is_above=is_above)) is None:
            continue
        a, b = pair
        if sides.get("below"):
            return _difference(b, a)
        if sides.get("above"):
            return _difference(a, b)
        if asked.is_signed:
            is_back = _FROM_TO.search(asked.words) is not None
            return _difference(b, a) if is_back else _difference(a, b)
        apart = f"abs({a.expression} - {b.factor})"
        return Term(expression=apart, dimension=a.dimension, words="")
    return None


_ERROR = re.compile(
    r"\b(?:(?P<absolute>absolute) (?:error|deviation|difference)|error|deviation|"
    r"over (?:\w+ )*?(?:or|and) (?:\w+ )*?under)\b"
)
_OF_PLACE_OR_BAND = re.compile(r"\b(?:limit|band|x|y|offset|middle|center|border|edge)\b")


def error(asked: AskedWords) -> Term | None:
    """The difference of a felt quantity from a named value, or that as a percentage of it.

    'The scale says 2.5 N. What is your relative error against it in %?'
    """
    found, wanted = _ERROR.search(asked.words), asked.only_value()
    if found is None or wanted is None or wanted.dimension not in ("force", "length"):
        return None
    if _OF_PLACE_OR_BAND.search(asked.words):
        return None
    felt, by = usual(wanted.dimension).expression, wanted.factor
    if asked.unit == "%":
        share = f"100 * ({felt} - {by}) / {wanted.divisor}"
        return Term(expression=share, dimension="fraction", words="")
    if not found["absolute"]:
        return None
    return Term(expression=f"abs({felt} - {by})", dimension=wanted.dimension, words="")


_RIGHT_IS_PLUS = re.compile(
    r"\b(?:plus|positive) (?:for|is|to|means|meaning) (?:the )?(?:right|up)\b|"
    r"\b(?:right|up) (?:being|as|is|counts as|means) (?:plus|positive)\b"
)
_TO_PLACE = re.compile(r"\b(?:middle|center|midline|midpoint)\b")
_SIDEWAYS = re.compile(r"\b(?:sideways|horizontally|right|left|across)\b")
_UPWARD = re.compile(r"\b(?:height|high|up|above|over|vertically|upward|upwards)\b")


def signed_offset(asked: AskedWords) -> Term | None:
    """The coordinate, where a signed distance from the middle is asked for in plain words."""
    words = asked.words
    is_told = _RIGHT_IS_PLUS.search(words) is not None
    if not (asked.is_signed or is_told) or asked.numbers or not _TO_PLACE.search(words):
        return None
    if re.search(r"\b(?:band|force|limit|border|edge|corner|depth|area)\b", words):
        return None
    is_x, is_y = _SIDEWAYS.search(words) is not None, _UPWARD.search(words) is not None
    if is_x == is_y:
        return None
    return Term(expression="x_mm" if is_x else "y_mm", dimension="length", words="")


def taken(asked: AskedWords) -> Term | None:
    """One term taken from another one, or added to it."""
    for patterns, sign in (((*_TAKEN, _BEYOND), "-"), (_ADDED, "+")):
        for pattern in patterns:
            found = pattern.fullmatch(asked.words)
            if found and (pair := asked.pair(found["a"], found["b"])):
                a, b = pair
                expression = f"{a.expression} {sign} {b.factor}"
                if sign == "+" and asked.is_unsigned:
                    expression = f"abs({a.expression}) + abs({b.expression})"
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
    return Term(expression=OUTSIDE_BAND, dimension="force", words="")


def _difference(a: Term, b: Term) -> Term:
    expression = f"{a.expression} - {b.factor}"
    return Term(expression=expression, dimension=a.dimension, words="", is_sum=True)
