"""Questions whether terms compare so: above, below, between, within so much of each other.

    Are we within 0.2 N of the limit?           abs(force_n - limit_n) <= 0.2
    Are x and y both above zero?                x_mm > 0 and y_mm > 0
    Does at least one hold: over 8 N, or deeper than 1 mm?

Not here: suppositions (``tacgrasp.lessons.dialogue.calculations.suppositions``).
"""

from __future__ import annotations

import re
from dataclasses import replace

from tacgrasp.lessons.dialogue.calculations.asked import AskedWords, usual
from tacgrasp.lessons.dialogue.calculations.phrases import EXCEEDS, MOVES, REACHES
from tacgrasp.lessons.dialogue.calculations.quantity_names import THING, UNIT, is_band
from tacgrasp.lessons.dialogue.calculations.terms import Term, alike, is_near
from tacgrasp.lessons.dialogue.conditions import ABOUT
from tacgrasp.lessons.dialogue.meaning import Calculated

_VERB = r"(?:is|are|was|were|does|do|did|would|will|has|have|can|could)"
_ADVERB = (
    r"(?:still|already|now|currently|really|also|then|even|actually|presently|both|yet|at present|"
    r"right now|at the moment|any|clearly|surely|perhaps|have|has|had|been)"
)
_BE = (
    r"(?:(?:be|being|is|are|am|was|were|lie|lies|lying|sit|sits|sitting|land|landing|stay|stays|staying|"
    r"stand|stands|come out|end up|ending up|comes? to|amounts? to|come|coming|remain|remains|"
    r"remaining|get|getting|go|"
    r"going|fall|falls|falling|drop|dropping|keep|keeping|"
    rf"got|{MOVES})(?: (?:back|at|up|down|in))?|at)"
)
_COMPARED = tuple(
    (sign, re.compile(rf"(?P<a>.+?)(?: {_ADVERB})*(?: {_BE})?(?: {_ADVERB})* (?:{said}) (?P<b>.+)"))
    for sign, said in (
        (
            ">=",
            rf"{REACHES}|at least(?: as \w+ as)?|no less than|not less than|"
            r"not below|not "
            r"under|no smaller than|(?:at|on) or (?:above|over|beyond|past)",
        ),
        (
            "<=",
            r"fits? (?:inside|within|into|in)|at most|no more than|not more than|not above|"
            r"not over|no larger than|(?:at|on) or (?:below|under|beneath)",
        ),
        (
            ">",
            r"(?:more|greater|larger|higher|bigger|heavier|deeper|stronger|further|firmer|tighter|"
            rf"harder|farther)(?: in size)? than|above|over|beyond|past|in excess of|{EXCEEDS}",
        ),
        (
            "<",
            r"(?:less|smaller|lower|lighter|shallower|weaker|nearer|fewer|gentler|softer|feebler|"
            r"looser) than|below|under|"
            r"short of|falls? short of|beneath|undercuts?|(?:fail(?:ed|s)? to|not|does not) reach",
        ),
    )
)
_NEARER = re.compile(
    rf"(?P<a>.+?)(?: {_ADVERB})*(?: {_BE})? (?:closer|nearer)(?: to)? (?P<b>.+) than "
    rf"(?P<to>to |it is to )?(?P<c>.+)"
)
_PUSHED = re.compile(
    r"(?:we|you|i|it|the gripper)(?: are| is)? (?:(?:push|press|squeez|gripp?)(?:ing|es|e|"
    r"ed)?(?: on it)? (?:harder|more)|(?:us|spend|tak)(?:ing|es?|en|ed)(?: up)? more) than|"
    r"(?:we|you|i|it|the gripper)(?: are| is)? (?:us|spend|tak)(?:ing|es?|en)(?: up)? over"
)
_OUTWEIGHS = re.compile(r"\boutweighs? (?=(?:the |this |that )?(?:object|thing|item|berry|part)\b)")
_WEIGHS = re.compile(
    rf"^(?:(?:it|(?:the|this|that|our) {THING}) (?:weigh|pull|pull down)(?: (?:with|surely|"
    rf"really))* |"
    rf"gravity (?:pull|tug|act) (?:down )?(?:on|at) (?:it|(?:the|this|that|our) {THING}) with )"
    r"(?:a force )?(?:of )?(?=(?:more|less|above|below|over|under|at least|at most|between)\b)"
)
_AMOUNT = r"(?:(?P<more>more than|over)|(?P<fewer>less than|under)|at least)"
_SIDES = (
    r"(?:(?P<up>exceeds?|clears?|above|over|beyond|(?:greater|larger|higher|more|heavier|"
    r"deeper) than)|"
    r"(?:below|under|beneath|shy of|short of|(?:less|smaller|lower|lighter) than))"
)
_BY = re.compile(
    rf"(?P<a>.+?)(?: {_ADVERB})*(?: {_BE})? {_SIDES} (?P<b>.+) by (?:{_AMOUNT} )?(?P<c>#\d+ \w+)"
)
_SO_MUCH = re.compile(
    rf"(?P<a>.+?)(?: {_ADVERB})*(?: {_BE})? (?:{_AMOUNT} )?(?P<c>#\d+ \w+) {_SIDES} (?P<b>.+)"
)
_KEPT_BY = re.compile(
    r"(?:a |the )?(?:force )?(?:limit|ceiling|cap|maximum) of (?P<b>#\d+ \w+)(?: (?:have|has|been|"
    r"be|is))* "
    r"(?:(?P<kept>respected|kept|observed|obeyed|met)|exceeded|violated|broken|passed|crossed|"
    r"overstepped)(?: by (?:the )?(?:present |current )?(?:force|grip|squeeze))?"
)
_LIMIT = re.compile(
    rf"(?:the )?(?:force )?(?:limit|ceiling)(?: {_ADVERB})*(?: be)?(?: {_ADVERB})* "
    rf"(?:(?P<kept>respected|kept|observed|"
    r"obeyed|met|okay|safe)|exceeded|violated|broken|passed|crossed|overstepped)"
)
_SIDE_OF = re.compile(
    rf"(?:it|the object|the contact)(?: {_ADVERB})*(?: be)? "
    rf"(?:to the )?(?P<side>left|right|above|below)(?: of)? "
    r"(?:the )?(?:\w+ )?(?:middle|center(?: line)?|midline|line)"
)
_WITHIN = re.compile(
    rf"(?P<a>.+?)(?: {_ADVERB})*(?: {_BE})? (?:with)?in (?:plus minus |plus or minus )?(?P<c>#.+?) "
    r"(?:of|from|around) (?P<b>.+)"
)
_BEING = (
    rf"(?:{_BE}|cover(?:ing)?|weigh(?:ing)?|measure|occupy|"
    r"(?:press|push|squeez|gripp)ing(?: with| at)?)"
)
_OFF_CENTER = re.compile(
    rf"(?:it|the (?:contact|object|touch|patch))(?P<being>(?: {_ADVERB})*(?: {_BE})?(?: not)?"
    rf"(?: (?:about|around|roughly|approximately|exactly|just))?) (?P<by>#\d+ (?:{UNIT})) "
    r"(?:(?:off|from|away from|out of|off of|off from) (?:the )?(?:center|middle)|"
    r"(?:(?:off )?(?:to )?(?:the )?(?P<side>left|right|up|down|above|below))"
    r"(?: (?:of|from)? ?(?:the )?(?:center|middle))?)(?: of the pad)?"
)
_OFFSETS = {
    None: "distance from the center", "left": "minus x", "right": "x", "up": "y", "above": "y",
    "down": "minus y", "below": "minus y",
}  # fmt: skip
"""'It is about 5 mm off center', '4 mm left of it'."""

_ABOUT = re.compile(
    rf"(?P<a>.+?)(?: {_ADVERB})*(?: {_BEING})?(?P<not> not)?(?: {_ADVERB})* "
    r"(?:(?:about|around|roughly|approximately|circa|ca|nearly|almost|"
    r"(?:close to|near|some|something like)(?= #)) (?P<b>.+?)(?: (?:of|on) (?:the )?pad)?|"
    r"(?P<c>#\d+ .+?) (?:or so|give or take|or thereabouts))"
)
_EQUAL = re.compile(
    rf"(?P<a>.+?)(?: {_ADVERB})*(?: {_BEING})?(?P<not> not)?(?: {_ADVERB})*"
    r"(?: (?:exactly|precisely|just|equal to|the same as|set to|set at|at))? "
    rf"(?P<b>#\d+ (?:{UNIT}))(?: (?:of|on) (?:the )?pad)?"
)
_EXACT = re.compile(r"(?:mass_g|limit_n|band_low_n|band_high_n)")
_LEAST_APART = 0.01
"""Distance from a number, as a fraction of it, up to which what is told is that number."""

_WIDER = re.compile(r"^(?:(?:the|our) )?(?:force )?band(?: be)? (wider|narrower) than")
_WIDTHS = {"wider": "more", "narrower": "less"}
_PLUS_MINUS = re.compile(
    rf"^(?P<a>.+?) (?P<b>#\d+ (?:{UNIT})) (?:plus (?:or )?minus|give or take) (?P<c>#\d+ percent)$"
)
_BETWEEN = re.compile(
    rf"(?P<a>.+?)(?: {_ADVERB})*(?: {_BE})? (?:somewhere )?between (?P<b>.+) and (?P<c>.+)"
)
_IN_BAND = re.compile(
    rf"(?P<a>.+?)(?: {_ADVERB})*(?: {_BE})?(?: {_ADVERB})* (?:(?P<out>outside(?: of)?|out of|"
    rf"leav\w+)|"
    r"within|inside|into|in) (?:(?:the |our |this |my |your )?(?:\w+ ){0,2}(?:band|range|window|"
    r"goal|"
    r"target|zone)|what (?:was|is|were|we|has been) (?:agreed|asked for|wanted|settled)(?: on|"
    r" upon)?)"
)
_ANY = re.compile(
    r"(?:either one|either(?= (?:of (?:these|them|the two)|holds?)\b)|at least one|"
    r"one of (?:them|these|the two)|any)(?: of (?:these|them|the two))?(?: (?:is|are|holds?|true|"
    r"satisfied|met|the case|"
    r"fulfilled|of the following))*"
)
_ASKS_ANY = re.compile(rf"^(?:{_VERB} )?{_ANY.pattern} | {_ANY.pattern}$")
_ONE_OF = re.compile(
    rf"(?:{_VERB} )?(?:at least one|any|either|one) of "
    rf"(?=.+? and .+? (?:{_VERB} )?(?:more|less|above|over|below|under|"
    r"greater|larger|smaller|exceed))"
)
_NOT_YET = re.compile(r"((?:has|have|is|are) (?:(?!#).)+? )yet to (?:get |go |come |rise |climb )?")
_JOINT = re.compile(r" (and|or) ")
_BARE = re.compile(
    r"(?:pressed|pushed|squeezed|held|gripped|touched) with "
    r"(?=(?:more|less|at least|at most|over|under)\b)|"
    r"(?=(?:more|less|greater|deeper|shallower|heavier|lighter|stronger) than )|"
    r"(?=(?:over|above|under|below|beyond|past) #\d)"
)
_NEITHER = re.compile(
    r"(?:it (?:true|correct|right|the case|so) that )?(?:(?P<s>.+?) (?:is )?)?neither (?P<a>.+) "
    r"nor (?P<b>.+)"
)
_USED_UP = re.compile(
    r"(?:it )?(?P<sign>more|less) than (?P<b>.+?) (?:(?:is|are|has|have|been|being|already|now) )*"
    r"(?:used|taken|spent|exhausted)(?: up)?"
)
_NEITHER_PASSED = re.compile(
    r"neither (.+) nor (.+?) (?:exceeded|surpassed|passed|crossed|broken|violated|overstepped)"
    r"(?: by (?:the )?(?:\w+ )?(?:force|grip|squeeze))?"
)
_RESERVE = re.compile(
    r"(?:we|you|i|there|it) (?:(?:still|have|got|is) )*(?:(?P<more>more|over)|"
    r"(?P<less>less|under)) than (?P<b>.+?) (?:in reserve|left|unused|to spare|in hand|headroom|"
    r"free|remaining)(?: (?:before|to|until|below|under) (?:the )?limit)?"
)


_AFFORDED = re.compile(
    r"(?:i|we|you|it)(?: (?:still|can|safely))* (?:afford|add|take|use|get|have|bear|stand|put on) "
    r"(?:another |an extra )?(?P<b>#\d+ \w+)(?: (?:more|extra|further|of (?:force|grip)|on top))* "
    r"(?:before|until) (?:(?:i|we|it) (?:hit|reach|hits|reaches) |hitting |reaching )?(?:the )?"
    r"(?:force )?(?:limit|cap|ceiling)(?: (?:trips|bites|is (?:hit|reached|met)|kicks in))?"
)
_PILED = re.compile(
    r"(?P<b>#\d+ \w+)(?: (?:more|extra))*(?: (?:be|get|of (?:force|grip)))* (?:piled|put|added|"
    r"heaped|"
    r"stacked|loaded|laid)(?: on)?(?: (?:on )?(?:top|it|to it|to this))? "
    r"(?:without|before|and (?:we |it )?(?:still )?(?:not|never)) (?:going|getting|go|exceeding|"
    r"passing|"
    r"crossing|breaking|hitting|exceed|pass|overstepping)(?: (?:past|over|above|beyond|through))? "
    r"(?:the )?(?:force )?(?:limit|cap|ceiling)"
)
_SPARE = re.compile(
    rf"before (?P<b>.+?) (?:is|are) there (?:still )?{_AMOUNT} (?P<c>#\d+ \w+)"
    r"(?: (?:left|to spare|spare|in hand|of room|to go))*"
)
_ROOM = re.compile(
    r"(?:there|we|i|you|it)(?: (?:still|be|is|have|has|got|any|enough|left))* "
    r"(?:room|space|headroom|slack|margin|leeway)(?: left)? for (?:another |an extra )?"
    r"(?P<b>#\d+ \w+)(?: (?:more|extra|further|of (?:force|grip)|on top))*"
    r"(?: (?:before|below|under|to|until|up to|beneath) (?:we (?:hit|reach) )?(?:the )?(?:limit|"
    r"cap|ceiling))?"
)


def calculated_check(asked: AskedWords) -> Calculated | None:
    """What a question asks whether it is so; None where it asks for no such thing."""
    words, is_any = asked.words, False
    if (found := _SPARE.fullmatch(words)) and (pair := asked.pair(found["b"], found["c"])):
        sign = "<" if found["fewer"] else ">" if found["more"] else ">="
        return Calculated(
            truth=f"{pair[0].expression} - force_n {sign} {pair[1].factor}", unit=None
        )
    if not_yet := _NOT_YET.match(words):
        rest = f"{not_yet[1]}{words[not_yet.end() :]}"
        reached = calculated_check(replace(asked, words=rest))
        return reached and replace(reached, truth=f"not ({reached.truth})")
    if one_of := _ONE_OF.match(words):
        is_any, words = True, words[one_of.end() :].replace(" and ", " or ")
    elif _ASKS_ANY.search(words):
        is_any, words = True, _ASKS_ANY.sub("", words)
    elif begin := re.match(rf"(?:{_VERB}|am|do|may|might|should) (?=.)", words):
        words = words[begin.end() :]
    elif not words.startswith("neither "):
        return None
    words = asked.in_its_unit(words)
    words = re.sub(r"^(it|we|they) both ", r"\1 ", words.strip())
    words = _NEITHER_PASSED.sub(r"neither force exceeds \1 nor force exceeds \2", words)
    if found := _NEITHER.fullmatch(words):
        last = re.sub(r"(?<=\w) it$", f" {found['a'].partition(' ')[2]}", found["b"])
        said = [f"{found['s'] or ''} {each}".strip() for each in (found["a"], last)]
        parts = [condition_of(asked, each) or condition_of(asked, f"it {each}") for each in said]
        told = [f"not ({part})" for part in parts if part]
        return Calculated(truth=" and ".join(told), unit=None) if len(told) == 2 else None
    condition = _condition(asked, words, joint=" or " if is_any else "")
    return None if condition is None else Calculated(truth=condition, unit=None)


def condition_of(asked: AskedWords, words: str) -> str | None:
    """The condition that a clause without its verb states; None where it states none."""
    if found := _RESERVE.fullmatch(words):
        left = Term(expression="limit_n - force_n", dimension="force", words="", is_sum=True)
        rest = asked.term(found["b"])
        pair = alike(left, rest) if rest else None
        sign = ">" if found["more"] else "<"
        return f"{pair[0].expression} {sign} {pair[1].factor}" if pair else None
    found = next(filter(None, (each.fullmatch(words) for each in (_ROOM, _AFFORDED, _PILED))), None)
    if found and (pair := asked.pair("the limit", found["b"])):
        return f"{pair[0].expression} - force_n >= {pair[1].factor}"
    if found := _SIDE_OF.fullmatch(words):
        name = "y_mm" if found["side"] in ("above", "below") else "x_mm"
        place = asked.subject or Term(expression=name, dimension="length", words="it")
        if place.dimension == "length" and name in place.expression:
            return f"{place.expression} {'<' if found['side'] in ('left', 'below') else '>'} 0"
    found = _KEPT_BY.fullmatch(words)
    if found and (bound := asked.term(found["b"])) and bound.dimension == "force":
        return f"force_n {'<=' if found['kept'] else '>'} {bound.factor}"
    if found := _LIMIT.fullmatch(words):
        pair = asked.pair("we", "the limit")
        return (
            f"{pair[0].expression} {'<=' if found['kept'] else '>'} {pair[1].factor}"
            if pair
            else None
        )
    for pattern in (_BY, _SO_MUCH):
        if (found := pattern.fullmatch(words)) and (told := _apart(asked, found)):
            return told
    if found := _USED_UP.fullmatch(words):
        words = f"force {found['sign']} than {found['b']}"
    words = _PUSHED.sub("force more than", words)
    words = _OUTWEIGHS.sub("exceed the weight of ", words)
    words = _WEIGHS.sub("weight ", words)
    words = _WIDER.sub(lambda band: f"width of the band {_WIDTHS[band[1]]} than", words)
    words = _PLUS_MINUS.sub(r"\g<a> within \g<c> of \g<b>", words)
    if found := _NEARER.fullmatch(words):
        pairs = [
            _pair(asked, found["a"], each) for each in shared_noun(asked, found["b"], found["c"])
        ]
        apart = [f"abs({pair[0].expression} - {pair[1].factor})" for pair in pairs if pair]
        if not found["to"] and pairs[0] and not pairs[0][1].has_quantity:
            others = _pair(asked, found["c"], found["b"])  # 'y nearer to zero than x'
            if others and others[0].has_quantity:
                apart[1:] = [f"abs({others[0].expression} - {others[1].factor})"]
        return " < ".join(apart) if len(apart) == 2 else None
    if found := _WITHIN.fullmatch(words):
        pair = _pair(asked, found["a"], found["b"])
        tolerance = asked.term(found["c"])
        if pair and tolerance and tolerance.unit == "%" and pair[0].dimension != "fraction":
            away = f"{tolerance.factor} / 100 * {pair[1].factor}"
            return f"abs({pair[0].expression} - {pair[1].factor}) <= {away}"
        if pair and tolerance and alike(pair[0], tolerance):
            near = alike(pair[0], tolerance)
            assert near is not None
            return f"abs({pair[0].expression} - {pair[1].factor}) <= {near[1].factor}"
    if told := _near(asked, words):
        return told
    if found := _BETWEEN.fullmatch(words):
        unit = re.match(rf"#\d+( (?:{UNIT}))\b", found["c"])
        least = (
            f"{found['b']}{unit[1]}" if unit and re.fullmatch(r"#\d+", found["b"]) else found["b"]
        )
        low, high = (_pair(asked, found["a"], end) for end in (least, found["c"]))
        if low and high:
            a, b, c = low[0].factor, low[1].factor, high[1].factor
            return f"min({b}, {c}) <= {a} <= max({b}, {c})"
    if found := _IN_BAND.fullmatch(words):
        force = asked.term(found["a"], beside=usual("force"))
        if force and force.dimension == "force":
            inside = f"band_low_n <= {force.factor} <= band_high_n"
            return f"not ({inside})" if found["out"] else inside
    return _comparison(asked, words)


def _near(asked: AskedWords, words: str) -> str | None:
    """Whether a term is another one, or about that."""
    if off := _OFF_CENTER.fullmatch(words):
        words = f"{_OFFSETS[off['side']]}{off['being']} {off['by']}"
    if found := _ABOUT.fullmatch(words):
        pair = _pair(asked, found["a"], found["b"] or found["c"])
    elif found := _EQUAL.fullmatch(words):
        pair = _pair(asked, found["a"], found["b"])
    if found is None or pair is None:
        return None
    is_told = found.re is _EQUAL and _EXACT.fullmatch(pair[0].expression)
    share = _LEAST_APART if is_told else ABOUT
    return is_near(pair[0].expression, pair[1], denied=bool(found["not"]), share=share)


def _apart(asked: AskedWords, found: re.Match[str]) -> str | None:
    """How much one term is above or below another one, against a number or a percentage."""
    pair = _pair(asked, found["a"], found["b"], is_above=bool(found["up"]))
    by = asked.term(found["c"])
    if pair is None or by is None:
        return None
    more, less = pair if found["up"] else pair[::-1]
    sign = "<" if found["fewer"] else ">" if found["more"] else ">="
    if by.unit == "%":
        return f"{more.expression} - {less.factor} {sign} {by.factor} / 100 * {pair[1].factor}"
    near = alike(less, by)
    return f"{more.expression} - {less.factor} {sign} {near[1].factor}" if near else None


def _comparison(asked: AskedWords, words: str) -> str | None:
    for sign, pattern in _COMPARED:
        found = pattern.fullmatch(words)
        if found is None:
            continue
        if pair := _pair(asked, found["a"], found["b"], is_above=">" in sign):
            return f"{pair[0].expression} {sign} {pair[1].factor}"
        if is_band(found["a"]) and (
            pair := _pair(asked, found["b"], found["a"], is_above="<" in sign)
        ):
            return f"{pair[1].factor} {sign} {pair[0].factor}"
        if both := _both(asked, found["a"], found["b"], sign):
            return both
    return None


def _both(asked: AskedWords, subjects: str, words: str, sign: str) -> str | None:
    """'x and y both above zero': each of the subjects."""
    parts = re.split(r" (and|or) ", subjects.removeprefix("both ").removeprefix("either "))
    if len(parts) != 3:
        return None
    pairs = [_pair(asked, part, words) for part in (parts[0], parts[2])]
    told = [f"{pair[0].expression} {sign} {pair[1].factor}" for pair in pairs if pair]
    return f" {parts[1]} ".join(told) if len(told) == 2 else None


def shared_noun(asked: AskedWords, first: str, second: str) -> tuple[str, str]:
    """Two noun phrases of which one lacks its noun: 'the upper end of the band, the lower one'."""
    if asked.term(second) is None and (of := re.fullmatch(r"((?:the )?\w+'s) \w+", first)):
        other = re.sub(r"^(?:the|its) ", "", second)
        if asked.term(f"{of[1]} {other}"):
            return first, f"{of[1]} {other}"
    if asked.term(second) is None and (one := re.fullmatch(r"(?:the )?(\w+)(?: one)?", second)):
        return first, re.sub(r"^(?:the )?\w+", one[1], first)
    noun = re.fullmatch(r"(?:the )?\w+ (.+)", second)
    if noun and asked.term(first) is None and asked.term(f"{first} {noun[1]}"):
        return f"{first} {noun[1]}", second
    if asked.term(first) is None and (end := re.search(r" (?:of|in) .+$", second)):
        return f"{first}{end[0]}", second
    if asked.term(second) is None and (end := re.search(r" (?:of|in) .+$", first)):
        return first, f"{second}{end[0]}"
    return first, second


def _condition(asked: AskedWords, words: str, *, joint: str) -> str | None:
    """The condition of a clause, or of several that 'and' or 'or' joins."""
    words = words.removeprefix("both ")
    if _BARE.match(words):
        words = f"it {_BARE.sub('', words, count=1)}"
    if whole := condition_of(asked, words):
        return whole
    for found in _JOINT.finditer(words):
        first = condition_of(asked, words[: found.start()])
        rest = re.sub(rf"^(?:{_VERB} )", "", words[found.end() :])
        if _BARE.match(rest):
            rest = f"{_subject_of(words[: found.start()])} {_BARE.sub('', rest, count=1)}"
        second = _condition(asked, rest, joint=joint) if first else None
        if first and second:
            return f"({first}){joint or found[0]}({second})"
    return None


def _subject_of(words: str) -> str:
    """What a condition is about; 'it' where it names nothing."""
    told = (pattern.fullmatch(words) for _, pattern in _COMPARED)
    return next((found["a"] for found in told if found), "it")


def _pair(asked: AskedWords, a: str, b: str, *, is_above: bool = True) -> tuple[Term, Term] | None:
    """Two terms in one dimension, at least one of which is more than a number."""
    pair = asked.pair(a, b, is_above=is_above)
    if pair is None or not any(term.has_quantity for term in pair):
        return None
    if not asked.is_unsigned:
        return pair
    return _unsigned(pair[0]), _unsigned(pair[1])


def _unsigned(term: Term) -> Term:
    if not term.has_quantity:
        return term
    return replace(term, expression=f"abs({term.expression})", is_sum=False)
