"""Clauses that state something without a number: touched, clipped, in its band, a cone, rough.

    the contact isn't clipped by the border     not (cut)
    grip neither under nor over the range       band_low_n <= force_n <= band_high_n
    either a ring or a torus                    shape == 'ring'
    nothing on the pad                          not (contact)

Not here: comparisons with a number (``tacgrasp.lessons.dialogue.clauses.comparing``).
"""

from __future__ import annotations

import re
from collections.abc import Mapping

from tacgrasp.lessons.dialogue.clauses.class_names import NAMED
from tacgrasp.lessons.dialogue.clauses.vocabulary import NEGATIONS, all_known
from tacgrasp.lessons.dialogue.clauses.word_sets import words_of
from tacgrasp.lessons.dialogue.conditions import IN_BAND, check_of

_PAD = "pad gel sensor skin rubber surface face sensing area membrane frame view"


_SUBJECTS = words_of("contact patch imprint print footprint touch outline dent whole complete")
_FORCES = words_of(
    "force grip squeeze grasp pressure hold press pressing push pinch clamp clamping squeezing "
    "gripping holding strength felt normal contact applied measured reading touch"
)
_CUTS = (
    r"cut(?:s|ting)?|clip(?:s|ped|ping)?|crop(?:s|ped|ping)?|chop(?:s|ped|ping)?|trim(?:s|med|"
    r"ming)?|slic(?:es?|ed|ing)|truncat(?:es?|ed|ing)|lop(?:s|ped)?|sever(?:s|ed)?|shav(?:es?|ed)|"
    r"curtail(?:s|ed)?"
)
_RUNS = (
    r"(?:runs?|running|spills?|spilling|h[au]ngs?|hanging|sticks?|sticking|pok(?:es?|ing)|extends?|"
    r"extending|reach(?:es|ing)?|goes|going|slides?|falls?|drops?|overlaps?|overhangs?|laps?|"
    r"protrudes?|protruding|flows?) (?:(?:off|over|past|beyond|out|outside|across) )?(?:of )?"
)
_EDGE = r"(?:edges?|rims?|borders?|boundary|boundaries|margins?|brink|perimeter)"
_CUT = re.compile(
    rf"\b(?:{_CUTS})\b|\b{_RUNS}(?:any |one |the |its |your |our |a )*(?:\w+ ){{0,2}}(?:{_EDGE}|"
    r"pad|"
    rf"sensor|gel|sensing area)\b|\b(?:off|over) the {_EDGE}\b"
)
_CUT_KNOWN = _SUBJECTS | words_of(
    f"{_PAD} edge edges rim rims border borders boundary boundaries margin margins brink perimeter "
    "off over past beyond outside across either side sides bit bits hand left right top bottom "
    "upper lower palm fingertip tip leftmost rightmost anything something entire anywhere somewhere"
)
_SIDES: Mapping[str, str] = {
    "left": r"\bleft(?:most)?\b", "right": r"\bright(?:most)?\b(?! now)",
    "top": r"\b(?:top|upper|palm)\b", "bottom": r"\b(?:bottom|lower|fingertip|tip)\b",
}  # fmt: skip
_WHOLE = re.compile(
    r"\b(?:whole|entire(?:ly|ty)?|complete(?:ly)?|fully|full|wholly|totally|"
    r"all of it)\b(?=.*\b(?:on|inside|within|in)\b (?:the |its |your |our |this )?(?:\w+ )?(?:pad|"
    r"gel|sensor|frame|view|area)\b)|\b(?:uncut|unclipped|uncropped|intact)\b|\b(?:contact|patch|"
    r"print|imprint|outline|footprint|it|object|thing) (?:is )?(?:whole|complete|entire)$"
)
_TOUCHES = re.compile(
    r"\b(?:touch(?:es|ed|ing)?|contact|present|there|against|detect(?:ed)?|sens(?:ed?|ing)|feel|"
    r"on the (?:pad|gel|sensor|skin|finger)|in (?:the |my |our |your )?(?:grip|grasp|gripper|"
    r"hands?|fingers?)|between (?:the |your |our )?(?:fingers|jaws)|in contact|held|caught|"
    r"got hold)\b"
)
_THINGS = re.compile(
    r"\b(?:something|anything|nothing|thing|object|contact|touch(?:ed|ing|es)?|part|piece|item|"
    r"somebody)\b"
)
_TOUCH_KNOWN = words_of(
    f"{_PAD} something anything nothing contact touches touched touching present detected sensed "
    "sense feel feels felt sensing against made hold held holding grip grasp caught between press "
    "presses pressing pressed physical"
)
_NOTHING = re.compile(r"\b(?:nothing|no|not|empty|free|never|without)\b")
_BAND_NOUN = r"(?:bands?|range|window|corridor|bracket|target|goal|zone|bounds|limits)"
_BAND_KNOWN = _FORCES | words_of(
    "band range window corridor bracket target goal zone wanted desired agreed requested required "
    "specified set permitted allowed intended asked want wants falls fall land lands landed inside "
    "within under over above below beneath beyond outside short past neither nor either both ends "
    "honour honours honoured honor honors honored respect respects respected comply complies with "
    "conform conforms adhere adheres prescribed "
    "bounds limits that too low high much little weak strong loose tight soft firm hard light"
)
_WITHIN = re.compile(
    rf"\b(?:in|within|inside|honou?r(?:s|ed|ing)?|respect(?:s|ed|ing)?|compl(?:y|ies|ying) with|"
    rf"conform(?:s|ing)? to|adher(?:e|es|ing) to)\b(?: \w+){{0,4}} {_BAND_NOUN}\b|\bon target\b"
)
_OUTSIDE = re.compile(rf"\b(?:outside|out of|off)\b(?: \w+){{0,4}} {_BAND_NOUN}\b")
_UNDER = r"(?:under|below|beneath|short of|too (?:low|little|weak|loose|soft|light))"
_OVER = r"(?:over|above|beyond|past|too (?:high|much|strong|tight|firm|hard))"
_BELOW = re.compile(rf"\b{_UNDER}\b")
_ABOVE = re.compile(rf"\b{_OVER}\b")
_NEITHER = re.compile(
    rf"\b(?:neither|not) (?:{_UNDER} (?:nor|or) {_OVER}|{_OVER} (?:nor|or) {_UNDER})\b"
)
_HAS_BAND = re.compile(rf"\b{_BAND_NOUN}\b")
_LIMIT = re.compile(
    r"\b(?:limit|ceiling|cap|max|maximum|never exceed (?:value|force|limit)|(?:permitted|allowed|"
    r"permissible) (?:maximum|max|force))\b"
)
_LIMIT_KNOWN = _FORCES | words_of(
    "limit ceiling cap max maximum never exceed value exceed exceeds exceeded exceeding above over "
    "under below beneath past beyond within inside violated broken broke breaks break breached "
    "passed crossed respected kept observed permitted allowed permissible hard safety set agreed "
    "overstepped hit hits gone higher lower more less than hitting reached reach reaches reaching"
)
_OVER_LIMIT = re.compile(
    r"\b(?:exceed(?:s|ed|ing)?|above|over|past|beyond|violated|broken?|breaks?|breached|passed|"
    r"crossed|overstepped|(?:higher|more) than)\b(?! (?:value|limit|force))"
)
_UNDER_LIMIT = re.compile(
    r"\b(?:under|below|beneath|within|inside|respected|kept|observed|(?:lower|less) than)\b"
)
_AT_LIMIT = re.compile(r"\b(?:hit|hits|hitting|reach(?:ed|es|ing)?)\b")
_HOLDS = re.compile(
    r"\b(?:hold|holds|held|carry|carries|lift|lifts|keep|keeps|enough|slip|slips|slipping|drop|"
    r"drops|support|bear)\b"
)
_GIVEN = re.compile(
    r"\b(?:weight|mass|heavy|weighs|given mass|stated mass|slip|slips|slipping|drop)\b"
)
_HOLD_KNOWN = _FORCES | words_of(
    "hold holds held carry carries lift lifts enough slip slips slipping drop drops support bear "
    "sure surely certain certainly guaranteed definitely safe safely secure securely stated given "
    "told weight mass weighs heavy own without risk of reliably strong firm"
)
_SLIPS = re.compile(r"\b(?:slip|slips|slipping|drop|drops)\b")
_HALVES: Mapping[str, str] = {
    "x_mm < 0": r"\bleft\b", "x_mm > 0": r"\bright\b",
    "y_mm > 0": r"\b(?:top|upper|palm|above)\b", "y_mm < 0": r"\b(?:bottom|lower|fingertip|tip|"
        r"below)\b",
}  # fmt: skip
_HALF = re.compile(
    r"\b(?:half|side|of (?:the |its |your )?(?:middle|center|midline|center line))\b|\b(?:on|"
    r"to) the (?:left|right)\b"
)
_HALF_KNOWN = _SUBJECTS | words_of(
    f"{_PAD} half side center middle midline line left right top bottom upper lower palm "
    "fingertip tip above below located placed situated hand more"
)


_UNSURE = frozenset(
    {
        "edge",
        "line",
        "corner",
        "hole",
        "plane",
        "cross",
        "dots",
        "tiny",
        "very large",
        "small",
        "medium",
        "large",
    }
)
"""Classes whose bare names mean something else too."""


def stated(words: str, *, known: frozenset[str] = frozenset()) -> str:
    """The condition that a clause states without a number; '' of any other clause.

    Args:
        words: The clause in plain words.
        known: Further words that change nothing.
    """
    if "#" in words:
        return ""
    told = words.split()
    for reader in (_cut, _band, _limit, _named, _held, _half, _touched):
        if condition := reader(words, told, known):
            return condition
    return ""


def _flipped(condition: str, told: list[str]) -> str:
    """A condition, denied where the clause denies it once; '' where it does twice."""
    negations = [word for word in told if word in NEGATIONS]
    if len(negations) > 1:
        return ""
    return f"not ({condition})" if negations else condition


def _cut(words: str, told: list[str], known: frozenset[str]) -> str:
    cuts = {word for word in told if re.fullmatch(_CUTS, word)}
    runs = set(re.findall(r"[a-z]+", " ".join(re.findall(_RUNS, words))))
    fits = all_known(told, _CUT_KNOWN | cuts | runs | known | NEGATIONS)
    if _CUT.search(words) and fits and "how" not in told:
        sides = [side for side, pattern in _SIDES.items() if re.search(pattern, words)]
        condition = " or ".join(f"cut_{side}" for side in sides) or "cut"
        return _flipped(f"({condition})" if len(sides) > 1 else condition, told)
    fits = all_known(
        told, _CUT_KNOWN | known | NEGATIONS | words_of("entire entirely complete completely "
                                                        "fully full "
                                                   "wholly totally inside within uncut unclipped "
                                                   "uncropped intact entirety"),
    )  # fmt: skip
    return _flipped("not cut", told) if _WHOLE.search(words) and fits else ""


def _band(words: str, told: list[str], known: frozenset[str]) -> str:
    if not all_known(told, _BAND_KNOWN | known | NEGATIONS, may_name=False):
        return ""
    if _NEITHER.search(words) and (_HAS_BAND.search(words) or "too" in told):
        return IN_BAND
    if not _HAS_BAND.search(words) or ("limits" in told and "in" not in told):
        return ""
    if _OUTSIDE.search(words):
        return _flipped(f"not ({IN_BAND})", told)
    if _WITHIN.search(words):
        return _flipped(IN_BAND, told)
    below, above = (_BELOW.search(words), _ABOVE.search(words))
    if bool(below) == bool(above):
        return ""
    return _flipped("force_n < band_low_n" if below else "force_n > band_high_n", told)


def _limit(words: str, told: list[str], known: frozenset[str]) -> str:
    if not _LIMIT.search(words) or not all_known(told, _LIMIT_KNOWN | known | NEGATIONS):
        return ""
    plain = re.sub(r"\bnever exceed (?=value|force|limit)", "", words)
    over, under = _OVER_LIMIT.search(plain), _UNDER_LIMIT.search(plain)
    if not over and not under and _AT_LIMIT.search(plain):
        return _flipped("force_n >= limit_n", plain.split())
    if bool(over) == bool(under) or re.search(r"\bhalf\b", plain) or _AT_LIMIT.search(plain):
        return ""
    return _flipped("force_n > limit_n" if over else "force_n <= limit_n", plain.split())


def _named(words: str, told: list[str], known: frozenset[str]) -> str:
    """A shape, a texture, or a word of depth, area and place."""
    for names in NAMED:
        found, rest = [], words
        for pattern, name in names.words:
            rest, num = pattern.subn(" ", rest)
            found += [name] * bool(num)
        if not found or not all_known(
            rest.split(), names.known | known | NEGATIONS, may_name=False
        ):
            continue
        if len(found) > 1 and not re.search(r"\b(?:or|nor)\b", rest):
            continue
        if not names.may_be_bare and not rest.split() and _UNSURE & set(found):
            continue
        found = list(dict.fromkeys(found))
        condition = " or ".join(f"{names.dimension} == '{name}'" for name in found)
        rest = re.sub(r"\bneither\b(.*)\bnor\b", r"not\1or", rest)
        return _flipped(f"({condition})" if len(found) > 1 else condition, rest.split())
    return ""


def _held(words: str, told: list[str], known: frozenset[str]) -> str:
    if not (_HOLDS.search(words) and _GIVEN.search(words)):
        return ""
    if not all_known(told, _HOLD_KNOWN | known | NEGATIONS, may_name=False):
        return ""
    fate = "slips" if _SLIPS.search(words) else "stays"
    return _flipped(check_of(f"{fate} given").condition, told)


def _half(words: str, told: list[str], known: frozenset[str]) -> str:
    named = [condition for condition, pattern in _HALVES.items() if re.search(pattern, words)]
    if len(named) != 1 or not _HALF.search(words):
        return ""
    if not all_known(told, _HALF_KNOWN | known | NEGATIONS, may_name=False):
        return ""
    return _flipped(named[0], told)


def _touched(words: str, told: list[str], known: frozenset[str]) -> str:
    if not (_TOUCHES.search(words) and _THINGS.search(words)):
        return ""
    if not all_known(told, _TOUCH_KNOWN | known | NEGATIONS):
        return ""
    return _flipped("contact", told)
