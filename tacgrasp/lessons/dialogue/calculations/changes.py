"""A quantity after a change that a clause tells: 'the force rose by 20 %'.

    you pushed 0.2 N harder                     force_n + 0.2
    the limit were halved                       0.5 * limit_n
    it slid 2 mm to the left                    x_mm - 2

Not here: what is asked then (``tacgrasp.lessons.dialogue.calculations.suppositions``).
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import replace

from tacgrasp.lessons.dialogue.calculations.asked import AskedWords, usual
from tacgrasp.lessons.dialogue.calculations.quantity_names import THING
from tacgrasp.lessons.dialogue.calculations.terms import Term, alike
from tacgrasp.lessons.dialogue.quantities import UNITS

_WAS = r"(?:(?:was|were|is|got|gets|had been|has been|be) )?"
_WHO = (
    r"(?:(?:you|we|i|somebody|someone|they|the (?:gripper|fingers|robot|hand|jaws|operator|user|"
    r"arm|machine|controller))(?: were to)?)"
)
_PUSHED = r"(?:push|press|squeez|gripp?|pinch|clamp|held|holding|tighten)(?:ed|e|es|s|ing)?"
_UP = (
    rf"{_WAS}(?:grew|grows?|grown|rose|rises?|risen|increased?|increases|(?:go|goes|went|gone|come|"
    r"comes|came|move|moved|crept|creep|turned|stepped|bumped|ramped|pushed|cranked|dialled) up|"
    r"climbed|climbs?|gained|gains?|raised|jumps?|jumped)"
)
_DOWN = (
    rf"{_WAS}(?:dropped|drops?|fell|falls?|fallen|decreased?|decreases|(?:go|goes|went|gone|come|"
    r"comes|came|turned|stepped|dialled|backed|eased|ramped) (?:down|off)|shrank|"
    rf"shrinks?|lost|sank|sinks?|slackened|"
    r"declined|lowered|reduced|cut)"
)
_RAISED = (
    r"(?:rais(?:e|ed|ing)|increas(?:e|ed|ing)|lift(?:ed|ing)?|(?:turn|crank|dial|step|ramp|bump|"
    r"push|"
    r"put)(?:ed|ped|ing|ping|led)? up|boost(?:ed|ing)?|up|upped|upping)"
)
_LOWERED = (
    r"(?:lower(?:ed|ing)?|reduc(?:e|ed|ing)|decreas(?:e|ed|ing)|cut(?:ting)?(?: down)?|"
    r"(?:turn|dial|step|ramp|take|bring|back|ease)(?:ed|d|ped|ing|ping|led)? (?:down|off)|"
    r"drop(?:ped|ping)?|trim(?:med|ming)?|slacken(?:ed|ing)?|loosen(?:ed|ing)?)"
)
_LARGE = r"(?:large|big|high|deep|much|great|strong|heavy|hard|tight|firm|far)"
_TURN = (
    r"(?:turn|crank|dial|step|ramp|bump|push|put|bring|take|nudge|bring|ease|back|wind|scale|"
    r"drive)(?:ed|ped|ing|ping|led|d|s)?|brought|took|wound"
)
_TIMES: Mapping[str, str] = {
    "0.5": r"halve[ds]?|halving|cut in half|cut by half|divided by two|half as|dropped to half",
    "0.25": r"quartered|quartering|cut to a quarter|divided by four",
    "2": r"double[ds]?|doubling|multiplied by two|grew to (?:double|twice)(?: the size)?|twice as",
    "3": r"triple[ds]?|tripling|trebled?|trebling|multiplied by three|(?:three times|thrice) as",
    "4": r"quadruple[ds]?|quadrupling|(?:four times) as",
}
_SHARES: Mapping[str, float] = {
    "half": 50, "a half": 50, "one half": 50, "a third": 33.3333, "one third": 33.3333,
    "a quarter": 25, "one quarter": 25, "a fifth": 20, "one fifth": 20, "a tenth": 10,
    "one tenth": 10, "two thirds": 66.6667, "three quarters": 75, "half of it": 50,
    "half its value": 50, "half of what it is": 50,
}  # fmt: skip
"""Shares of a quantity itself [%]."""

_TIMES_MORE: Mapping[str, str] = {
    "0.5": r"half", "2": r"twice|double|two times", "3": r"thrice|triple|three times",
    "4": r"four times|quadruple",
}  # fmt: skip
_WITH = r"(?:(?:with|at|using|by|given|on|for|having|applying) )?"
_GRIP = r"(?:force|grip|squeeze|pressure|clamp|clamping|indentation|depth)"
_GRAMS = r"g|grams?|kg|kilos?|kilograms?"
_MORE_OF = re.compile(
    rf"{_WITH}(?:(?:an?|another|an? (?:extra|additional|further)|yet another|an) )?(?:extra )?"
    rf"(?P<b>#\d+ \w+)(?: of)?(?: (?:(?P<up>more|extra|additional|further|on top|added|higher|"
    rf"harder|"
    rf"stronger|firmer|tighter)|(?P<down>less|fewer|lower|softer|lighter|weaker|looser|taken off|"
    rf"off)))+"
    rf"(?: (?:of )?(?:(?:the|my|our) )?(?P<a>{_GRIP}))?(?: on (?:it|this|that|top|board|the \w+))?"
)
_ANOTHER = re.compile(
    rf"{_WITH}(?:another|(?:an? )?(?:extra|additional|further)) (?P<b>#\d+ \w+)(?: (?:of )?"
    rf"(?:(?:the|my|our) )?(?P<a>{_GRIP}))?(?: on top(?: of .+)?| on (?:it|this|that|the \w+))?|"
    rf"plus (?:another )?(?P<plus>#\d+ (?:{_GRAMS}))(?: (?:more|extra|on (?:it|top)))*"
)
_SAID_TIMES = r"half|twice|double|two times|thrice|triple|three times|four times|quadruple"
_AT_TIMES = re.compile(
    rf"{_WITH}(?P<n>{_SAID_TIMES}) "
    rf"(?:as (?:much|hard|firm|strong)|(?:the|our|my|this|that) (?:(?:present|current|same) )?"
    rf"(?P<a>{_GRIP}))(?: .{{0,12}}now)?"
)
_CHANGES = tuple(
    (sign, re.compile(pattern))
    for sign, pattern in (
        (
            "+",
            rf"(?P<a>.+?) {_UP}(?: by(?: another)?)? (?P<b>#.+|(?<=by )(?:a|one|half).+|"
            rf"(?<=by )half)",
        ),
        ("-", rf"(?P<a>.+?) {_DOWN}(?: by)? (?P<b>#.+|(?<=by )(?:a|one|half).+|(?<=by )half)"),
        ("=", rf"(?P<a>.+?) (?:{_UP}|{_DOWN}|{_WAS}(?:set|changed)) to (?P<b>.+)"),
        ("=", r"(?P<a>.+?) (?:was|were|is)(?: only| just)? (?P<b>#\d+ \w+|twice .+|half .+)"),
        ("=", r"(?:an? |the |our )?(?P<a>limit|ceiling|cap) of (?P<b>#\d+ \w+)"),
        ("+", rf"{_WHO} (?:{_TURN}) (?P<a>.+?) up(?: by)? (?P<b>.+)"),
        ("-", rf"{_WHO} (?:{_TURN}) (?P<a>.+?) (?:down|back|off)(?: by)? (?P<b>.+)"),
        ("+", rf"{_WHO} {_RAISED} (?P<a>.+?) by (?P<b>.+)"),
        ("-", rf"{_WHO} {_LOWERED} (?P<a>.+?) by (?P<b>.+)"),
        (
            "=",
            rf"{_WHO} (?:set|brought|bring|take|took|{_RAISED}|{_LOWERED}) (?P<a>.+?) to (?P<b>.+)",
        ),
        (
            "+",
            r"(?P<a>.+?) (?:was|were|is|gets?|got|becomes?|grows?|grew) (?P<b>#.+?) (?:more|"
            r"higher|greater|larger|deeper|heavier)",
        ),
        ("-", r"(?P<a>.+?) (?:was|were|is) (?P<b>#.+?) (?:less|lower|smaller|shallower|lighter)"),
        ("+", r"(?P<a>.+?) (?:gained|gains|put on|puts on) (?P<b>#.+)"),
        ("-", r"(?P<a>.+?) (?:lost|loses|shed|sheds|gave up) (?P<b>#.+)"),
        (
            "+",
            rf"{_WHO} (?:add(?:ed)?|put|gave) (?:another |an extra )?(?P<b>.+?) (?:to|onto|on) "
            r"(?P<a>.+)",
        ),
        ("+", r"(?:adding|putting) (?:another )?(?P<b>#.+?)(?: more)? to (?P<a>.+)"),
        ("+", rf"(?P<b>(?:#\d+|one|an?) \w+) {_WAS}(?:added|put) (?:on)?to(?:p of)? (?P<a>.+)"),
        (
            "-",
            rf"{_WHO} (?:took|take|taking|removed?|shave|knock|subtract) (?P<b>.+?) "
            r"(?:off(?: of)?|away from|from) (?P<a>.+)",
        ),
        (
            "-",
            rf"{_WHO} (?:{_LOWERED}|take|took|knock|shave|pull|let|lift)(?:ed|d)? "
            r"(?P<b>#\d+ \w+|a \w+|half) (?:off|from) (?P<a>.+)",
        ),
    )
)
_EXACTLY = re.compile(
    r"\b(?:exactly|precisely|just|merely|only|about|around|simply|a mere|say) (?=#)"
)
_TO_TIMES = re.compile(
    rf"(?P<a>.+?) (?:{_UP}|{_DOWN}) to (?P<n>#\d+) times "
    rf"(?:the )?(?:\w+ )?(?:size|value|amount|depth|self)"
)
_PRESSED = re.compile(
    rf"(?:{_WHO}|it|the (?:gel|pad|skin|dent|object|contact|indentation)) (?:were |was |is |got )?"
    rf"(?:{_PUSHED}|put on|add|go|went)(?: in)?"
    r"(?: with)? (?P<b>#.+?) (?:(?P<more>harder|more|firmer|stronger|deeper|extra)|"
    r"(?P<less>softer|less|lighter|gentler|shallower))"
)
_OFF = re.compile(
    rf"(?:{_WHO} )?(?:take|took|taking|knock|knocked|shave|shaved|trim|trimmed|let|pull|pulled|"
    r"lift|lifted|drop|dropped) (?P<b>#\d+ \w+)(?: of (?:force|grip|squeeze))? (?:off|away)(?: it)?"
)
_GRIPPED_TIMES = re.compile(
    rf"(?:{_WHO}|it|the \w+) (?:were |was |is )?{_PUSHED}(?: (?:it|on it|in|with))* "
    rf"(?P<n>{_SAID_TIMES})"
    rf"(?: (?:as )?(?:hard|firm|firmly|strong|strongly|tight|tightly|much|deep|deeply|far)|"
    rf" (?:the|that|this|our) {_GRIP})?"
)
_EASED = re.compile(
    rf"(?:{_WHO} )?(?:(?:backing|easing) off|releasing|letting go of|let go of|released?|gave up|"
    rf"(?:back|ease|let|slacken|ramp|wind|come|take|knock|shave)(?:e?d)?(?: it)? (?:off|up|back|"
    rf"down)|"
    rf"ease(?:d)?|t(?:ake|ook) (?:off|away)|drop(?:ped)?|loosen(?:ed)?|slacken(?:ed)?|relax(?:ed)?|"
    rf"reduced?|lower(?:ed)?|cut|lost|lose)(?: it| off| the (?:force|grip|squeeze))?"
    r"(?: by)? (?P<b>#.+?|(?:a|one) (?:half|third|quarter|fifth|tenth)|half|.+ of the .+)"
    r"(?: off| of (?:force|grip|squeeze))?"
)
_ADDED = re.compile(
    rf"(?:{_WHO} )?(?:(?:add(?:s|ed|ing)?|put|putting|apply|applied|applying|pile|piled|tack|"
    r"tacked|throw|threw|stack|stacked|gain|gained|give it|gave it|increase(?:d)?|raise(?:d)?|"
    r"tighten(?:ed)?|"
    r"squeeze(?:d)?|press(?:ed)?|(?:go|goes|went|come|step|turn)(?:ed)? up|climb(?:ed)?|rise)"
    r"(?: (?:it|on|in|up|by|with|another|an?|extra|a further|the (?:force|grip|squeeze)))*) "
    r"(?P<b>#\d+ \w+)(?: of (?:force|grip|squeeze))?(?: (?:more|extra|on top|on|to it|to (?:that|"
    r"this)|harder))*"
)
_ON_TOP = re.compile(
    r"(?:another )?(?P<b>#\d+ \w+)(?: more)? (?:came|comes|were put|was put|were added|"
    r"was added)(?: on top)?"
)
_GONE = re.compile(
    r"(?P<share>.+) of (?P<a>.+?) (?:vanished|vanishes|was lost|were lost|disappeared|went away|"
    r"were gone|was gone|is lost|fell away)"
)
_CHANGE_OF = re.compile(
    r"(?:an? )?(?P<b>#\d+ \w+) (?:(?P<up>increase|rise|gain|growth)|decrease|drop|fall|reduction|"
    r"cut)(?: (?:of|in)(?: the)? (?P<a>.+))?"
)
_SANK = re.compile(
    r"(?:it|we|the \w+) (?:sank|sinks?|went|goes|go|moved?|dug|digs|dented|is pressed|was pressed|"
    r"were pressed)(?: (?:in|down|deeper|further))*(?: (?:by|another|an? (?:extra|further)))* "
    r"(?P<b>#\d+ \w+)(?: (?:further|deeper|more|in|down))*"
)
_WEIGHED = re.compile(
    r"(?:it|the \w+) (?:weigh(?:s|ed)?|were|was|is|had|has|got|gets?|becomes?|became)(?: to be)? "
    r"(?P<b>#\d+ \w+) "
    r"(?:(?P<up>more|heavier|extra)|(?:less|lighter))"
    r"(?: than (?:(?:you|we|i) (?:were|was|are|am) told|told|now|it is(?: now)?|stated|given|"
    r"(?:you|we|i) think))?"
)
_HELD = rf"(?:it|this|that|they|(?:(?:the|this|that|my|our) )?(?:told |held )?{THING})"
_TIMES_AS = rf"(?P<n>{_SAID_TIMES}|(?:an? )?#\d+ (?:times|x|fold))"
_ITS_WEIGHT = (
    r"(?:of )?(?:(?:the|its|that|this|our|your|as much) )?(?:(?:given|told|stated|present|current|"
    r"original) )?(?:mass|weight|load)"
)
_HEAVIER = re.compile(
    rf"(?:{_HELD} (?:were|was|is|weigh(?:s|ed)?|had|has|got|gets?|became|becomes?|be|turned out)"
    rf"(?: to (?:be|weigh))?|(?:the |its )?(?:mass|weight|load)(?: of {_HELD})? (?:was|were|is)|"
    rf"(?:with|at|for|under|holding|carrying|lifting))? ?"
    rf"(?:{_TIMES_AS} (?:(?:as|so) (?:heavy|much|massive|large|big)|heavier|more massive|"
    rf"(?P<light>lighter)|that|what .+|{_ITS_WEIGHT})|"
    rf"(?:an? )?(?P<p>#\d+ percent) (?:(?P<more>heavier|more massive|"
    rf"(?:more|extra) (?:mass|weight|load))|lighter|"
    rf"less (?:massive|mass|weight|load)|(?P<of>of (?:that|it|{_ITS_WEIGHT})))"
    rf")(?: (?:as|than) .+|(?: that)? (?:i|we|you) .+| (?:stated|told|given|agreed|now)|"
    rf" {THING})?"
)
"""'The part were twice as heavy', 'at double the mass', '50 % heavier'."""

_SEVERAL = re.compile(
    r"(?:(?:(?:i|we|you|it) )?(?:hold(?:ing)?|held|lift(?:ing|ed)?|carr(?:y|ied|ying)|had|have|"
    r"gripped)|there (?:were|was|are|is)) (?P<n>#\d+) (?:of (?:these|them|those)|(?:such|"
    r"identical|equal) [a-z]{3,}s)(?: at once| together)?"
)
"""'Holding two of these', 'there were three such parts'."""
_SECOND = re.compile(
    rf"(?:an?|#1|one|another|one more|the same)? ?(?:second|further|other|identical|equal|more|"
    rf"such)?"
    rf"(?: (?:identical|equal|similar|equally heavy|such|more))* ?(?:one|{THING}|copy|twin)"
    r"(?: (?:just |exactly )?like (?:this|it)(?: one)?)? (?:(?:were|was|is|got|came|hung|stuck) )?"
    r"(?:stuck|glued|added|put|placed|hung|attached|tied|fixed|taped|joined|on)"
    r"(?: (?:to|onto|on|with|under|beneath|below)(?: top of)? (?:it|this|that|the \w+)(?: one)?)?"
)
"""'A second identical one hung on it'."""

_STUCK = re.compile(
    r"(?:(?:another|an extra|some) )?(?P<b>#\d+ \w+)(?: (?:of )?[a-z]+)? (?:were|was|is|are|got|"
    r"came) "
    r"(?:stuck|glued|added|put|placed|hung|attached|tied|fixed|taped|poured|filled)"
    r"(?: (?:to|onto|on|into|in)(?: top of)? (?:it|this|that|the \w+))?"
    r"(?: (?:on top of|besides|beside|over and above) .+)?"
)
_FROM_HERE = re.compile(
    r" from (?:here|where (?:it|we) (?:is|are)(?: now)?|(?:the|its) (?:present|current) "
    r"(?:value|level|reading|state))$"
)
_LET = re.compile(rf"^{_WHO} (?:let|have|had|made|make) (?=(?:it|the \w+) (?!#))")
_PRODUCT = re.compile(rf"{_WHO} (?P<verb>multiply|divide)(?:ied|d)? (?P<a>.+?) by (?P<n>#\d+)")
_ON_END = re.compile(r" (?:more|extra|further|on top|again)$")
_MOVED = re.compile(
    r"(?:it|the (?:object|contact|thing))(?: (?:was|were|is|had|has|been))* "
    r"(?:shifted|moved|slid|pushed|moves|slides|shifts)(?: by)? (?P<b>#\d+ \w+) "
    r"(?:to the )?(?P<side>left|right|up|down)(?:wards?)?"
)
_LOADED = re.compile(
    rf"{_WHO} (?:add(?:ed)?|put|stuck|stick|glued?|attach(?:ed)?|placed?|hung|hang|pour(?:ed)?(?: "
    r"in)?|load(?:ed)?(?: on)?|stack(?:ed)?|piled?|taped?|tied?|tie|clip(?:ped)?|fix(?:ed)?|"
    r"set|laid|lay|drop(?:ped)?|fill(?:ed)? in) "
    rf"(?:(?:another|an?|some|extra|additional|further) )*(?P<b>#\d+ (?:{_GRAMS}))"
    r"(?: (?:more|extra)| of \w+| (?!of\b|more\b)\w+)*? ?(?:(?:to|onto|on|in|into|on top of) "
    r"(?:(?:the|its|this|that) )?\w+|on top)?"
)
_SHARED = re.compile(
    r"(?P<n>#\d+) (?:jaws|fingers|pads|grippers|people|robots|of them|parts)(?: \w+)? "
    r"(?:share|carry|split|divide)d? (?P<a>.+?)(?: (?:equally|evenly|between them|alike))*"
)


def changed(asked: AskedWords, change: str) -> Term | None:
    """A quantity after a change that a clause tells; None where it tells none.

    Args:
        asked: The question, whose numbers and pronouns the clause has.
        change: The clause in plain words.
    """
    change = _FROM_HERE.sub("", _LET.sub("", _EXACTLY.sub("", change)))
    for reader in (_heavier, _topped, _gripped, _moved, _multiplied, _altered):
        if term := reader(asked, change):
            return term
    return None


def _heavier(asked: AskedWords, change: str) -> Term | None:
    """The told mass many times over, or with so much on it."""
    if (found := _STUCK.fullmatch(change)) and (load := asked.term(found["b"])):
        return _by(usual("mass"), "+", load) if load.dimension == "mass" else None
    if (many := _SEVERAL.fullmatch(change)) and (count := asked.term(many["n"])):
        return replace(usual("mass"), expression=f"{count.expression} * mass_g", words="")
    times = _HEAVIER.fullmatch(change)
    if times is None and (_SECOND.fullmatch(change) is None or "#" in change):
        return None
    mass, said = usual("mass"), times["n"] if times else "twice"
    if times and times["p"]:
        part = asked.term(times["p"])
        if part and times["of"]:
            return replace(mass, expression=f"{part.expression} / 100 * mass_g", words="")
        return part and _by(mass, "+" if times["more"] else "-", part)
    factor = next((n for n, named in _TIMES_MORE.items() if re.fullmatch(named, said)), "")
    if not factor and (count := asked.term(re.sub(r"^an? | \w+$", "", said))):
        factor = count.expression
    is_less = times is not None and times["light"] is not None
    made = f"mass_g / {factor}" if is_less else f"{factor} * mass_g"
    return replace(mass, expression=made, words="") if factor else None


def _topped(asked: AskedWords, change: str) -> Term | None:
    """A force or depth with so much on top of it or less, or a multiple of one."""
    if found := _AT_TIMES.fullmatch(change) or _GRIPPED_TIMES.fullmatch(change):
        named = found.groupdict().get("a")
        is_deep = re.search(r" (?:deep|deeply|far)$", change) is not None
        term = asked.term(named) if named else usual("length" if is_deep else "force")
        factor = next(n for n, said in _TIMES_MORE.items() if re.fullmatch(said, found["n"]))
        return term and replace(term, expression=f"{factor} * {term.factor}", words="")
    for pattern in (_MORE_OF, _ANOTHER):
        if (found := pattern.fullmatch(change)) is None:
            continue
        named = found.groupdict()
        by = asked.term(found["b"] or named["plus"])
        dimension = "force" if by and by.unit == "%" else by.dimension if by else ""
        if by is None or dimension not in ("force", "length", "mass"):
            return None
        term = asked.term(found["a"]) if found["a"] else usual(dimension)
        is_less = named.get("down") is not None
        if term is None or (term.dimension != dimension and by.unit != "%"):
            return None
        return _by(term, "-" if is_less else "+", by)
    return None


def _gripped(asked: AskedWords, change: str) -> Term | None:
    """Force or depth after a firmer or softer grip, and a mass with something put on."""
    for pattern in (_PRESSED, _OFF, _EASED, _ON_TOP, _ADDED):
        if (found := pattern.fullmatch(change)) is None:
            continue
        by = _share_of_itself(found["b"]) or asked.term(found["b"])
        if by is not None and by.unit == "%":
            is_less = pattern in (_OFF, _EASED) or bool(found.groupdict().get("less"))
            return _by(usual("force"), "-" if is_less else "+", by)
        if by is None or by.dimension not in ("force", "length", "mass"):
            return None
        is_less = pattern in (_OFF, _EASED) or bool(found.groupdict().get("less"))
        felt = usual("force" if pattern is _PRESSED and by.dimension == "mass" else by.dimension)
        return _by(felt, "-" if is_less else "+", by)
    found = _LOADED.fullmatch(change)
    load = asked.term(found["b"]) if found else None
    return _by(usual("mass"), "+", load) if load and load.dimension == "mass" else None


def _moved(asked: AskedWords, change: str) -> Term | None:
    """The place of an object that slid."""
    found = _MOVED.fullmatch(change)
    by = asked.term(found["b"]) if found else None
    if found is None or by is None or by.dimension != "length":
        return None
    name = "x" if found["side"] in ("left", "right") else "y"
    place = Term(expression=f"{name}_mm", dimension="length", words=name)
    return _by(place, "+" if found["side"] in ("right", "up") else "-", by)


def _multiplied(asked: AskedWords, change: str) -> Term | None:
    """A multiple of a quantity, or what each of some has of it."""
    for pattern, sign in ((_SHARED, "/"), (_TO_TIMES, "*")):
        found = pattern.fullmatch(change)
        whole, count = (asked.term(found[name]) for name in "an") if found else (None, None)
        if whole is not None and count is not None:
            expression = f"{whole.divisor} {sign} {count.expression}"
            return replace(whole, expression=expression, words="" if sign == "/" else whole.words)
    if found := _PRODUCT.fullmatch(change):
        whole, count = _subject(asked, found["a"], "half"), asked.term(found["n"])
        if whole is not None and count is not None:
            sign = "*" if found["verb"] == "multiply" else "/"
            return replace(whole, expression=f"{whole.divisor} {sign} {count.expression}")
    for factor, said in _TIMES.items():
        found = re.fullmatch(
            rf"(?:{_WHO} (?:ordered|had|made) )?(?P<a>.+?) {_WAS}(?:{said})(?: {_LARGE})?", change
        ) or re.fullmatch(rf"{_WHO} (?:{said}) (?P<a>.+)", change)
        if found is None:
            continue
        term = asked.term(found["a"])
        if term is None and found["a"].removeprefix("the ") in ("load", "payload"):
            term = usual("mass")
        if term is None and found["a"] in ("it", "that", "this"):
            is_deep = UNITS[asked.unit].dimension == "length" if asked.unit in UNITS else False
            is_deep = (
                is_deep or re.search(r"\b(?:deep|depth|indentation)\b", asked.words) is not None
            )
            is_heavy = change.endswith(" heavy")
            term = usual("mass" if is_heavy else "length" if is_deep else "force")
        if term:
            return replace(term, expression=f"{factor} * {term.factor}", words=found["a"])
    return None


def _altered(asked: AskedWords, change: str) -> Term | None:
    """A quantity that is so much more or less, or becomes another one."""
    if found := _GONE.fullmatch(change):
        term, part = asked.term(found["a"]), asked.term(f"{found['share']} of {found['a']}")
        return _by(term, "-", part) if term and part else None
    if found := _CHANGE_OF.fullmatch(change):
        by = asked.term(found["b"])
        if by is None or (not found["a"] and by.dimension not in ("force", "length", "fraction")):
            return None
        felt = usual("force" if by.unit == "%" else by.dimension)
        term = asked.term(found["a"]) if found["a"] else felt
        return _by(term, "+" if found["up"] else "-", by) if term else None
    for pattern, dimension in ((_SANK, "length"), (_WEIGHED, "mass")):
        if (found := pattern.fullmatch(change)) is None:
            continue
        by = asked.term(found["b"])
        if by is not None and by.dimension == dimension:
            is_more = pattern is _SANK or found["up"] is not None
            return _by(usual(dimension), "+" if is_more else "-", by)
    for sign, pattern in _CHANGES:
        found = pattern.fullmatch(change)
        term = _subject(asked, found["a"], found["b"]) if found else None
        if found is None or term is None or not term.has_quantity:
            continue
        by = _share_of_itself(found["b"]) or asked.term(_ON_END.sub("", found["b"]))
        if sign == "=" and found["b"] in _SHARES:
            factor = f"{_SHARES[found['b']]:g}"
            return replace(term, expression=f"{factor} / 100 * {term.factor}")
        if by and (made := _by(term, sign, by)):
            return made
    return None


def _subject(asked: AskedWords, words: str, by: str) -> Term | None:
    """What is changed: a term, or for a pronoun the felt quantity beside the change."""
    if term := asked.term(words):
        return term
    change = _share_of_itself(by) or asked.term(_ON_END.sub("", by))
    if change is not None and change.unit == "%":
        change = usual("force")
    return asked.term(words, beside=change) if change is not None else None


def _share_of_itself(words: str) -> Term | None:
    """A change by a third or a half, as percent; None of another one."""
    if (share := _SHARES.get(words)) is None:
        return None
    return Term(expression=f"{share:g}", dimension="fraction", words=words, unit="%")


def _by(term: Term, sign: str, by: Term) -> Term | None:
    """A term that is so much more or less, or becomes another; a percentage is one of itself."""
    if sign == "=":
        pair = alike(term, by)
        return replace(pair[1], words=term.words) if pair else None
    if by.unit == "%" and not by.words.endswith(("point", "points")):
        expression = f"(1 {sign} {by.factor} / 100) * {term.factor}"
        return replace(term, expression=expression, is_sum=False)
    pair = alike(term, by)
    if pair is None or pair[0].dimension != term.dimension:
        return None
    return replace(term, expression=f"{term.expression} {sign} {pair[1].factor}", is_sum=True)
