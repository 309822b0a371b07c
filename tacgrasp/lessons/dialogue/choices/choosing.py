"""What a question means that names the alternatives of its answer.

    Is the dent deeper or shallower than 0.6 mm?    'deeper' if depth_mm > 0.6 else 'shallower'
    Too weak, too strong or ok for the band?
    In which half of 0 to the limit is the force, lower or upper?

Not here: where a word is to be said as the question says it
(``tacgrasp.lessons.dialogue.choices.own_words``).
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence

from tacgrasp.lessons.dialogue.calculations.asked import AskedWords, asked_words
from tacgrasp.lessons.dialogue.calculations.terms import Term, alike
from tacgrasp.lessons.dialogue.choices import scales
from tacgrasp.lessons.dialogue.choices.bins import binned
from tacgrasp.lessons.dialogue.choices.conditions import (
    band_part,
    choice_of,
    compared_to,
    with_cues,
)
from tacgrasp.lessons.dialogue.choices.named import named_or_none
from tacgrasp.lessons.dialogue.choices.ranges import nearer_of, range_half
from tacgrasp.lessons.dialogue.choices.rest import RestOfQuestion, rest_of
from tacgrasp.lessons.dialogue.choices.scales import Offer, WordScale
from tacgrasp.lessons.dialogue.choices.spelling import is_one_way, spelled
from tacgrasp.lessons.dialogue.conditions import IN_BAND
from tacgrasp.lessons.dialogue.expression import Expression
from tacgrasp.lessons.dialogue.meaning import Calculated

_MOVED = re.compile(
    r"\b(?:mov|push|shift|slid|nudg|shov|bring|get|brought|steer)\w*"
    r"(?: (?:the )?(?:it|object|contact|thing|part|berry|this|that|patch))\b|"
    r"\b(?:it|object|contact|thing|part|patch|this|that) (?:\w+ ){0,3}?"
    r"(?:mov|shift|slid|travel|go|goes|push|nudg|shov|brought|steer)"
)
_BODY = re.compile(
    r"\b(?:gripper|hand|robot|fingers?|pad|arm|i|we|you) (?:\w+ ){0,2}?(?:move|go)\b"
)

_COMPARATIVES = frozenset(
    {"more", "less", "harder", "softer", "tighter", "looser", "firmer", "gentler", "lighter", ""}
)
_ADVISED = re.compile(
    r"(?=.*\b(?:squeez|press|grip|push|pinch|clamp|hold)(?:e|ing)?\b)"
    r"(?=.*\b(?:should|shall|must|need|have to|to (?:get|be|reach|bring|come|stay)|do (?:i|we))\b)"
    r"(?!.*\bthan\b)"
)

_AXIS_CUES = frozenset({"offset", "larger", "smaller", "middle", "place", "area", "near", "x", "y"})
_PLACE_CUES = frozenset(
    {"place", "middle", "half", "end", "near", "move", "offset", "larger", "force", "area"}
)
_JUDGED = re.compile(r"\b(?:too|weak|strong|tight|loose)\b")
_OF_FORCE = re.compile(r"\b(?:weak|strong|tight|loose|grip|force|hard)\b")

Reader = Callable[[AskedWords, Offer, RestOfQuestion], str | None]

_NO_CHOICE = re.compile(
    r"\bwithin \S+ ?(?:%|percent|per cent)|\bwithin #\d+ \S+ of\b|"
    r"\b(?:bigger|larger|greater|smaller|more|less) than .*"
    r"\b(?:up or down|left or right|sideways or)\b"
)
"""'Within 10 % of the limit or past it', 'bigger than the offset up or down'."""


def chosen(question: str) -> Calculated | None:
    """What a question means that names alternatives; None where it says something else too."""
    asked = asked_words(spelled(question))
    if truth := _quadrant(asked) or binned(question, asked):
        return chosen_by(truth, question)
    if truth := named_or_none(asked):
        return chosen_by(truth, question)
    if " or " not in f" {asked.words} " or is_one_way(asked.words):
        return None
    if _NO_CHOICE.search(asked.words):
        return None
    if truth := nearer_of(asked):
        return chosen_by(truth, question)
    for scale, reader in _READERS:
        offer = scale.offered(asked.words)
        rest = rest_of(asked, offer.rest) if offer else None
        if offer and rest and (truth := reader(asked, offer, rest)):
            return chosen_by(truth, question)
    return None


_QUADRANTS: Sequence[Mapping[str, str]] = (
    {"ne": "ne", "nw": "nw", "sw": "sw", "se": "se"},
    {"ne": "first", "nw": "second", "sw": "third", "se": "fourth"},
    {"ne": "northeast", "nw": "northwest", "sw": "southwest", "se": "southeast"},
)
_OF_QUADRANT = re.compile(
    r"\b(?:not|if|than|force|depth|area|why|how|band|limit|#\d+|shape|texture)\b"
)


def _quadrant(asked: AskedWords) -> str | None:
    """The quadrant of the pad that the contact is in, by names for all four of them."""
    words = set(asked.words.split())
    names = next((each for each in _QUADRANTS if words.issuperset(each.values())), None)
    if names is None or _OF_QUADRANT.search(asked.words):
        return None
    if names["ne"] == "first" and "quadrant" not in words:
        return None
    right, left = (
        f"('{names[f'n{side}']}' if y_mm > 0 else '{names[f's{side}']}')" for side in "ew"
    )
    return f"{right} if x_mm > 0 else {left}"


def chosen_by(truth: str, question: str) -> Calculated | None:
    """A choice between words as the question writes them; None where nothing is felt of it."""
    for word in Expression(truth).choices:
        if re.search(r"\d", word) or len(word) == 1:
            continue
        said = r"[\s-]+".join(map(re.escape, word.split())).replace("center", "cent(?:er|re)")
        written = re.search(rf"(?<!\w){said}(?!\w)", question, re.I) or re.search(
            said, question, re.I
        )
        if written and "'" not in written[0]:
            is_code = written[0].isupper() and len(written[0]) > 1  # 'NE', 'WARN'
            said = written[0] if is_code else " ".join(written[0].lower().split())
            truth = truth.replace(f"'{word}'", f"'{said}'")
    return Calculated(truth=truth, unit=None) if Expression(truth).names else None


def _compared(asked: AskedWords, offer: Offer, rest: RestOfQuestion) -> str | None:
    """More or less than a term; a share of the pad may be half of it without a number."""
    values = set(offer.said)
    if len(values) != 2 or values not in ({"more", "less"}, {"least", "less"}, {"more", "most"}):
        return None
    if {"near", "band", "move"} & rest.cues:
        return None
    pair = compared_to(asked, offer, rest)
    if pair is None:
        return None
    pair = _as_ordered(asked, pair)
    sign = ">=" if "least" in values else ">"
    more, less = (
        offer.said.get("least") or offer.said.get("more"),
        offer.said.get("most") or offer.said.get("less"),
    )
    return choice_of((more, f"{pair[0].expression} {sign} {pair[1].factor}"), (less, ""))


_ORDERED = re.compile(
    r"(?:is|are|was|were) (?P<a>.+?) (?:more|less|greater|smaller|larger|bigger|higher|lower|"
    r"stronger|weaker|deeper|shallower|above|below|over|under) or (?:.+? )?"
    r"(?:than|above|below|over|under) (?P<b>.+)"
)


def _as_ordered(asked: AskedWords, pair: tuple[Term, Term]) -> tuple[Term, Term]:
    """What is compared with what, where the question names what is felt last.

    'Is the limit more or less than the force?'
    """
    if (found := _ORDERED.fullmatch(asked.words)) is None:
        return pair
    first, last = asked.term(found["a"]), asked.term(found["b"])
    if first is None or last is None or last.expression != pair[0].expression:
        return pair
    return alike(first, last) or pair


def _step(asked: AskedWords, offer: Offer, rest: RestOfQuestion) -> str | None:
    """What to do with the force, to come to a number, under the limit or into the band."""
    said = offer.said
    if not rest.has_only("band", "force", "move", "depth", "middle", "place", "holds", "area"):
        return None
    if _COMPARATIVES.issuperset({said.get("more", ""), said.get("less", "")}) and (
        not _ADVISED.search(asked.words)
    ):
        return None
    if not rest.terms:
        if rest.cues - {"band", "force", "move", "middle"}:
            return None
        middle = "middle" in rest.cues
        if middle and "band" not in rest.cues:
            return None
        if middle and set(said) == {"more", "less"}:
            low = "force_n < (band_low_n + band_high_n) / 2"
            return choice_of((said["more"], low), (said["less"], ""))
        if middle:
            return None
        return band_part(said.get("more"), said.get("keep"), said.get("less"))
    if {"middle", "band"} & rest.cues or "area" in rest.cues:
        return None
    target = [term for term in rest.terms if not _is_felt(term)]
    felt = [term for term in rest.terms if _is_felt(term)]
    if len(target) != 1 or len(felt) > 1 or target[0].dimension not in ("force", "length"):
        return None
    pair = with_cues(asked, felt[0] if felt else None, target[0], rest)
    if pair is None or pair[0].expression not in ("force_n", "depth_mm"):
        return None
    below = f"{pair[0].expression} < {pair[1].factor}"
    if "more" in said and "keep" not in said:
        return choice_of((said["more"], below), (said["less"], ""))
    if "keep" in said and "less" in said and "more" not in said:
        above = f"{pair[0].expression} > {pair[1].factor}"
        return choice_of((said["less"], above), (said["keep"], ""))
    if "keep" in said and "more" in said and "less" not in said:
        return choice_of((said["more"], below), (said["keep"], ""))
    return None


def _is_felt(term: Term) -> bool:
    return term.expression in ("force_n", "depth_mm")


def _touch(asked: AskedWords, offer: Offer, rest: RestOfQuestion) -> str | None:
    if rest.terms or not rest.has_only("place", "area", "holds", "force", "near"):
        return None
    if "holds" in rest.cues and re.search(r"\b(?:safe|sure)", offer.rest):
        return None
    return choice_of((offer.said["touched"], "contact"), (offer.said["free"], ""))


def _covered(asked: AskedWords, offer: Offer, rest: RestOfQuestion) -> str | None:
    """The larger part of the pad."""
    said = offer.said
    if rest.terms or not rest.has_only("area", "place", "larger", "half"):
        return None
    if said.keys() == {"covered", "free"} and "larger" not in rest.cues:
        return None
    if said.keys() == {"covered", "free"}:
        said = {"more": said["covered"], "less": said["free"]}
    return choice_of((said["more"], "area_percent > 50"), (said["less"], ""))


def _side(asked: AskedWords, offer: Offer, rest: RestOfQuestion) -> str | None:
    """Left or right of the middle, or the way back to it."""
    if any(term.expression != "x_mm" for term in rest.terms):
        return None
    if not rest.cues <= _PLACE_CUES | {"x"}:
        return None
    is_back = _is_back(asked.words, rest)
    if is_back is None:
        return None
    sign = ">" if is_back else "<"
    return choice_of((offer.said["left"], f"x_mm {sign} 0"), (offer.said["right"], ""))


def _height(asked: AskedWords, offer: Offer, rest: RestOfQuestion) -> str | None:
    """The upper or the lower half of the pad, or the way back to its middle."""
    if any(term.expression != "y_mm" for term in rest.terms):
        return None
    if not rest.cues <= _PLACE_CUES | {"y"}:
        return None
    is_named = re.search(r"palm|tip|proximal|distal", " ".join(offer.said.values()))
    if not is_named and not {"place", "middle", "half"} & rest.cues:
        return None
    is_back = _is_back(asked.words, rest)
    if is_back is None:
        return None
    sign = "<" if is_back else ">"
    return choice_of((offer.said["palm"], f"y_mm {sign} 0"), (offer.said["fingertip"], ""))


def _is_back(words: str, rest: RestOfQuestion) -> bool | None:
    """Whether it is asked where the object must go to be in the middle; None where unclear."""
    is_moved = _MOVED.search(words) is not None
    if re.search(r"\bthan\b", words):
        return None
    if not is_moved:
        return None if "move" in rest.cues else False
    return True if "middle" in rest.cues and not _BODY.search(words) else None


def _axis(asked: AskedWords, offer: Offer, rest: RestOfQuestion) -> str | None:
    """The larger or the smaller of both offsets."""
    if rest.terms or "move" in rest.cues:
        return None
    if not rest.cues <= _AXIS_CUES:
        return None
    is_less = "smaller" in rest.cues or "near" in rest.cues
    if (is_less and "larger" in rest.cues) or not rest.cues - {"place", "area", "x", "y"}:
        return None
    sign = "<" if is_less else ">"
    return choice_of(
        (offer.said["horizontal"], f"abs(x_mm) {sign} abs(y_mm)"), (offer.said["vertical"], "")
    )


def _band(asked: AskedWords, offer: Offer, rest: RestOfQuestion) -> str | None:
    said = offer.said
    if any(term.expression != "force_n" for term in rest.terms):
        return None
    if not rest.has_only("band", "force", "holds", "place"):
        return None
    if "band" not in rest.cues:
        words = " ".join(said.values())
        is_of_force = bool(rest.terms) or "force" in rest.cues or _OF_FORCE.search(asked.words)
        if not is_of_force or not _JUDGED.search(words):
            return None
    return band_part(said.get("below"), said.get("within"), said.get("above"))


def _in_band(asked: AskedWords, offer: Offer, rest: RestOfQuestion) -> str | None:
    if any(term.expression != "force_n" for term in rest.terms):
        return None
    if "band" not in rest.cues and "target" not in offer.said["within"]:
        return None
    if not rest.has_only("band", "force", "place"):
        return None
    return choice_of((offer.said["within"], IN_BAND), (offer.said["outside"], ""))


def _limit(asked: AskedWords, offer: Offer, rest: RestOfQuestion) -> str | None:
    names = {term.expression for term in rest.terms}
    if "limit_n" not in names or names - {"limit_n", "force_n"}:
        return None
    if not rest.has_only("force", "place"):
        return None
    return choice_of((offer.said["over"], "force_n > limit_n"), (offer.said["under"], ""))


def _cut(asked: AskedWords, offer: Offer, rest: RestOfQuestion) -> str | None:
    if rest.terms or not rest.has_only("place", "end", "area"):
        return None
    return choice_of((offer.said["cut"], "wholeness == 'cut'"), (offer.said["whole"], ""))


def _center(asked: AskedWords, offer: Offer, rest: RestOfQuestion) -> str | None:
    if rest.terms or not rest.has_only("place", "area", "offset"):
        return None
    return choice_of((offer.said["centered"], "position == 'centered'"), (offer.said["off"], ""))


def _sign(asked: AskedWords, offer: Offer, rest: RestOfQuestion) -> str | None:
    """Whether one coordinate is positive."""
    names = [term.expression for term in rest.terms]
    if len(names) != 1 or names[0] not in ("x_mm", "y_mm") or not rest.has_only("x", "y", "place"):
        return None
    return choice_of((offer.said["positive"], f"{names[0]} > 0"), (offer.said["negative"], ""))


def _slip(asked: AskedWords, offer: Offer, rest: RestOfQuestion) -> str | None:
    """Whether the grip surely holds a named mass, or the given one."""
    loads = [term for term in rest.terms if term.expression != "force_n"]
    if len(loads) > 1 or not rest.has_only("holds", "mass", "force", "place"):
        return None
    if loads and (loads[0].dimension != "mass" or loads[0].expression == "holds_g"):
        return None
    load = loads[0].expression if loads else "mass_g"
    return choice_of((offer.said["stays"], f"holds_g >= {load}"), (offer.said["slips"], ""))


def _half(asked: AskedWords, offer: Offer, rest: RestOfQuestion) -> str | None:
    return range_half(asked, offer.said["low"], offer.said["high"], rest)


_READERS: Sequence[tuple[WordScale, Reader]] = (
    (scales.STEP, _step),
    (scales.MAJORITY, _covered),
    (scales.COVERED, _covered),
    (scales.TOUCH, _touch),
    (scales.SLIP, _slip),
    (scales.SIGN, _sign),
    (scales.CENTER, _center),
    (scales.CUT, _cut),
    (scales.LIMIT, _limit),
    (scales.BAND, _band),
    (scales.IN_BAND, _in_band),
    (scales.ENDS, _half),
    (scales.COMPARED, _compared),
    (scales.AXIS, _axis),
    (scales.SIDE_X, _side),
    (scales.SIDE_Y, _height),
)
