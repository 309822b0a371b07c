"""Questions about offsets from the middle: the larger one, one without its sign, the way back.

    More off sideways or lengthwise?                    calculate 'sideways' if abs(x_mm) > ...
    Left-right offset, ignore the sign.                 amount offset_x mm.
    To get back to the middle, left or right?           calculate 'left' if x_mm > 0 else 'right'.

Not here: the side on which it lies (``tacgrasp.lessons.dialogue.rules.halves``).
"""

from __future__ import annotations

import re

from tacgrasp.lessons.dialogue.plainer import AUXILIARY
from tacgrasp.lessons.dialogue.rules.halves import FILLERS, PAIR, own_words, quoted, with_verbs

_SIDEWAYS = (
    r"(?:sideways|side to side|left right|left to right|left and right|laterally|lateral|"
    r"horizontal(?:ly)?|cross ?wise|cross ?ways|breadth ?(?:wise|ways)|across(?: the (?:finger|"
    r"pad))?|widthwise|width ?ways|"
    r"(?:in |along |the )?x(?: axis| direction| offset)?)"
)
_LENGTHWISE = (
    r"(?:length ?wise|length ?ways|up and down|up or down|up down|vertical(?:ly)?|"
    r"longitudinal(?:ly)?|"
    r"palm to (?:finger)?tip|(?:finger)?tip to palm|palm (?:finger)?tip|along(?: the finger| its "
    r"length)?|"
    r"(?:in |along |the )?y(?: axis| direction| offset)?)"
)
_AXES = re.compile(
    rf"(?P<before>.*?)\b(?:(?P<x>{_SIDEWAYS})|(?P<y>{_LENGTHWISE}))(?: along the finger| one| "
    r"offset| miss| error| shift| deviation| displacement| distance)? or "
    rf"(?:more |rather |is it |mostly |mainly |largely |chiefly |further |off |out |the |in )*"
    rf"(?(x)(?P<y2>{_LENGTHWISE})|(?P<x2>{_SIDEWAYS}))"
    rf"(?: along the finger| across the finger| one| offset| direction)?(?P<after>(?: .*)?)"
)
_IS_OFFSET = re.compile(
    r"\b(?:off|offset|offsets|shift|shifted|displaced|displacement|miss|missed|missing|out|"
    r"deviation|error|"
    r"eccentricity|misaligned|misplaced|away|greater|larger|bigger|worse)\b"
)
_AXIS_FILLERS = frozenset(
    """
    is are was does do did it she he this that the a an thing object contact touch patch part one we
    i more most mostly mainly
    further farther greater larger bigger worse worst larger of off offset offsets shift shifted
    displaced displacement miss missed missing
    out deviation error eccentricity misaligned misplaced away largely chiefly from middle
    center centre two both
    which what way ways direction axis tell can not whether if in size
    magnitude part say would you now by lie lies sit sits at pad piece so then right well
    s you me please look ok error shift deviation displacement distance
    """.split()  # noqa: SIM905
)
_BACK = re.compile(
    r"(?=.*\b(?:back|return|re ?cent(?:er|re|red|ered)|(?:to|onto|into|in|at) the (?:very "
    r")?(?:middle|"
    r"center)|"
    r"centered|middle)\b)"
    r".*\b(?:it|contact|object|touch|thing|patch|piece|part|item|imprint|she)\b.*"
    r"\b(?:move|moved|go|shift|shifted|slide|slid|travel|nudged?|pushed?|shoved?|brought|budge|"
    r"head|shifting|moving|sliding|pushing|nudging|"
    r"come|slip|drift|be moved)\b"
)
_BACK_FILLERS = frozenset(
    """
    to get bring have for had it's back move moved go shift shifted slide slid travel nudge nudged
    push pushed shove shoved brought budge head come slip drift need needs needed must should
    towards
    toward return order into onto again centered recenter recentre recentred recentered
    line lined dead directly end up shifting moving sliding pushing nudging
    want way direction got gotta very exact is be there from if were
    """.split()  # noqa: SIM905
)
_TO_SIDE = re.compile(
    r"\b(?:(?:to|towards?) (?:the )?)?(?:(?P<left>left(?:wards?)?)|(?P<right>right(?:wards?)?)|"
    r"(?P<top>up(?:wards?)?|palm(?:wards?)?)|(?P<bottom>down(?:wards?)?|(?:finger)?tip(?:wards?)?))"
    r"(?: (?:hand )?side)?\b"
)
_OTHER_SIDE = {"left": "right", "right": "left", "top": "bottom", "bottom": "top"}
_ASKS_YES = re.compile(rf"{AUXILIARY}\b")
_NO_MOVER = re.compile(r"\b(?:i|we|gripper|hand|robot|finger|fingers|arm|you)\b(?! say)")
_UNSIGNED = re.compile(
    r"\b(?:(?:ignor|disregard|drop|forget|neglect|omit|leav)(?:e|es|ed|ing|ting|ping|ped)?(?: "
    r"out)? "
    r"(?:the |its |any |all )?(?:signs?|direction|plus or minus)|"
    r"(?:the )?sign (?:dropped|ignored|aside|left out|omitted|removed|does not matter|irrelevant)|"
    r"(?:no|without|unsigned|absolute|magnitude|abs)(?: (?:a |the )?(?:signs?|value))?|"
    r"(?:in )?(?:absolute (?:terms|value)|magnitude|size)(?: only)?|regardless of (?:the )?(?:sign|"
    r"side|"
    r"direction)|"
    r"never mind (?:the sign|which (?:way|side))|whichever (?:way|side)|either way)\b"
)
_SIDE_SHIFT = re.compile(rf"\b(?P<x>{_SIDEWAYS}|sideways|lateral)\b|\b(?P<y>{_LENGTHWISE})\b")
_LINED_UP = re.compile(
    r"\b(?:line|lined|lining|bring|center|align|aligned|get|put|move|shift)\b.*\b(?:middle|center|"
    r"centered)\b"
)
_HOW_FAR = re.compile(
    r"\b(?:how (?:many|much|far|big|large)|offset|shift|distance|displacement|deviation|"
    r"eccentricity|"
    r"what|travel|miss)\b"
)
_LENGTH_UNIT = re.compile(
    r"\b(?:mm|millimetres?|um|micrometres?|microns?|cm|centimetres?|length|distance|far|offset)\b"
)
_FROM_LINE = re.compile(
    r"\b(horizontal|vertical) (?:mid ?line|cent(?:er|re) ?line|center|middle line|middle|line|axis|"
    r"median)(?: line)?\b"
)
"""The distance from the horizontal midline is y."""

_MIDDLES = re.compile(
    r"\bbetween (?:the )?(?:[\w']+ ){1,3}?(?:middle|center|centroid) and (?:the )?"
    r"(?:(?:[\w']+ ){0,3}?(?:middle|center)(?: of the (?:pad|gel|sensor))?)"
)
_NO_OFFSET = re.compile(
    r"\b(?:#|band|force|limit|depth|deep|area|mass|newtons?|more than|less than|over|under|if|"
    r"bigger|larger|or|minus|plus|negative|positive|edge|rim|border|wide|width|between|and how)\b"
)


_SIDE = (
    r"(?:the )?(?P<{0}>left|right|up(?:wards?)?|palm(?:wards?)?|down(?:wards?)?|"
    r"(?:finger)?tip(?:wards?)?)"
)
_SIGNED = re.compile(
    rf"\b(?:(?:taking |counting |with |where |if )?{_SIDE.format('counted')}(?: side)? (?:(?:as|is|"
    r"being|counts? as|counted as|taken as) )?(?:positive|plus)|(?:positive|plus) (?:to|towards?|"
    rf"for|is|being|means|meaning) {_SIDE.format('positive')}|"
    r"(?:with|including|keep|keeping) (?:the |its )?signs?|"
    r"signs? (?:included|kept|and all)|signed)\b"
)
_COUNTED_TO = (("left", "leftward"), ("right", "x"), ("up", "y"), ("palm", "y"))
_MUST_MOVE = re.compile(
    r"\b(?:(?:be|get) (?:moved|shifted|pushed|nudged|corrected)|"
    r"(?:must|should|to) (?:move|shift|push|nudge))\b"
)
_OPPOSITE = {"leftward": "x", "x": "leftward", "y": "tipward", "tipward": "y"}
_COORDINATE = re.compile(
    r"(?:(?:what|how much|how large|how big|give me|state|tell me|report|is|are|the|its|lateral|"
    r"sideways|horizontal|vertical|lengthwise|offset|coordinate|position|value|contact|of) )*"
    r"(?P<axis>x|y)(?: (?:is|the|its|of|contact|touch|offset|coordinate|position|value|component|"
    r"reading|direction|now))* in (?:mm|millimetres?|um|micrometres?|microns?|cm|centimetres?)"
)
"""'y in cm', 'lateral offset x, in microns'."""


def offset_query(words: str) -> str:
    """The query of a question about offsets, in plain words; '' of any other question."""
    words = with_verbs(words)
    if coordinate := _COORDINATE.fullmatch(words):
        return f"amount {coordinate['axis']} mm."
    return _way_back(words) or _axis(words) or _signed(words) or _offset(words)


def _signed(words: str) -> str:
    """The offset along one axis with its sign, counted to the side that is named as positive."""
    found = _SIGNED.search(words)
    if found is None or not _HOW_FAR.search(words) or not _LENGTH_UNIT.search(words):
        return ""
    rest = f"{words[: found.start()]} {words[found.end() :]}"
    if _NO_OFFSET.search(rest) or _UNSIGNED.search(rest):
        return ""
    side = found["counted"] or found["positive"]
    axes = {"x" if shift["x"] else "y" for shift in _SIDE_SHIFT.finditer(rest)}
    if side:
        counted = (name for begin, name in _COUNTED_TO if side.startswith(begin))
        axes = {next(counted, "tipward")}
    if len(axes) != 1:
        return ""
    counted_to = axes.pop()
    # what is moved back to the middle goes the other way
    return f"amount {_OPPOSITE[counted_to] if _MUST_MOVE.search(rest) else counted_to} mm."


def _way_back(words: str) -> str:
    """Which way the contact is from the middle, the other way round."""
    pairs = {axis: pattern.search(words) for axis, pattern in PAIR.items()}
    if _BACK.match(words) is None or _NO_MOVER.search(words) or all(pairs.values()):
        return ""
    if not any(pairs.values()):
        return _must_go(words)
    for axis, found in pairs.items():
        if found is None:
            continue
        rest = f"{words[: found.start()]} {words[found.end() :]}".split()
        if not all(word in FILLERS | _BACK_FILLERS for word in rest) or "not" in rest:
            return ""
        up, down = own_words(found)
        return (
            f"calculate {quoted(down)} if {axis}_mm > 0 else {quoted(up)}."
            if axis == "y"
            else (f"calculate {quoted(up)} if {axis}_mm > 0 else {quoted(down)}.")
        )
    return ""


def _must_go(words: str) -> str:
    """Whether it must go to a named side to be in the middle: 'must it move left to get back'."""
    found = list(_TO_SIDE.finditer(words))
    if len(found) != 1 or _ASKS_YES.match(words) is None:
        return ""
    rest = f"{words[: found[0].start()]} {words[found[0].end() :]}".split()
    if not all(word in FILLERS | _BACK_FILLERS for word in rest) or "not" in rest:
        return ""
    side = next(name for name, said in found[0].groupdict().items() if said)
    return f"check {_OTHER_SIDE[side]}."


def _axis(words: str) -> str:
    """Which of the two offsets is larger, in the question's own words."""
    found = _AXES.fullmatch(words)
    if found is None or not _IS_OFFSET.search(words):
        return ""
    rest = f"{found['before']} {found['after']}".split()
    if not all(word in _AXIS_FILLERS for word in rest):
        return ""
    wide, long = found["x"] or found["x2"], found["y"] or found["y2"]
    article = re.compile(r"^(?:in |along |the )(?=[xy]\b)")
    wide, long = (article.sub("", each) for each in (wide, long))
    return f"calculate {wide!r} if abs(x_mm) > abs(y_mm) else {long!r}."


def _offset(words: str) -> str:
    """The offset along one axis without its sign."""
    words = _MIDDLES.sub("from the middle", words)
    if not _HOW_FAR.search(words) or not _LENGTH_UNIT.search(words) or _NO_OFFSET.search(words):
        return ""
    unsigned = _UNSIGNED.search(words)
    if not unsigned and not (
        _LINED_UP.search(words) and re.search(r"\b(?:shift|travel|mov|correct|adjust|nudg)", words)
    ):
        return ""
    told = _FROM_LINE.sub(lambda match: "y" if match[1] == "horizontal" else "x", words)
    told = re.sub(
        r"\b(?:ignoring|disregarding|leaving out) (?:left and right|left right|x)\b", "", told
    )
    axes = {"x" if found["x"] else "y" for found in _SIDE_SHIFT.finditer(told)}
    if len(axes) != 1:
        return ""
    return f"amount offset_{axes.pop()} mm."
