"""The rating of a caption by a rule, 1 to 5: 1 + 4 × the fraction of what it says that is right.

The paper has captions rated by GPT-4 against a reference (appendix C). This rule needs no model and
gives the same number every time. It counts the five words and every number that is said. A number
is right within 10 % of the truth or, where that is more, 0.05 mm of depth, 0.5 mm of place, 0.1 N
of force.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass

from cltp.errors import TouchError
from cltp.tactile.states import CLASSES, NUMBERS, ContactState
from cltp.texts.captions import NO_CONTACT, Slots, parse_caption, slots_of
from policies.llm.text import tolerance_of
from tacgrasp.lessons.captions import NUMBER, numbers_by_name, ranges_by_name

LOWEST, HIGHEST = 1.0, 5.0

_TAIL = re.compile(
    rf"[\s,.]*(?:(?:[xy] )?{NUMBER}(?:-{NUMBER})?(?: (?:mm|N|%))?[\s,.]*)*(?:cut[\w\s]*\.?)?\s*"
)
"""What may stand behind the sentence of words."""


@dataclass(frozen=True, slots=True, kw_only=True)
class CaptionRating:
    """How right a caption is.

    Attributes:
        rating: 1 to 5.
        words: Whether each of the five words is right, where the contact has one; empty for a text
            that is no caption.
        numbers: Whether each number that is said is right; likewise.
        ranges: Whether each interval that is said in the place of a number holds the truth; it
            counts neither for nor against the caption.
    """

    rating: float
    words: Mapping[str, bool]
    numbers: Mapping[str, bool]
    ranges: Mapping[str, bool]

    @property
    def is_malformed(self) -> bool:
        """Whether the text is no caption."""
        return not self.words and not self.numbers


MALFORMED = CaptionRating(rating=LOWEST, words={}, numbers={}, ranges={})


def rate_caption(text: str, truth: ContactState) -> CaptionRating:
    """Rate a caption, 1 for a text that is none.

    Args:
        text: A sentence in the paper's template; numbers may follow it, as the model says them.
        truth: The contact.
    """
    sentence, numbers_text = _parts(text)
    try:
        said = parse_caption(sentence)
    except TouchError:
        return MALFORMED
    if not _TAIL.fullmatch(numbers_text):
        return MALFORMED
    words = _right_words(said, truth)
    true = {name: float(getattr(truth, name)) if truth.in_contact else 0.0 for name in NUMBERS}
    numbers = {
        name: _is_near(name, value, true[name])
        for name, value in numbers_by_name(numbers_text).items()
    }
    ranges = {
        name: low <= true[name] <= high
        for name, (low, high) in ranges_by_name(numbers_text).items()
    }
    right = [*words.values(), *numbers.values()]
    fraction = sum(right) / len(right)
    rating = LOWEST + (HIGHEST - LOWEST) * fraction
    return CaptionRating(rating=rating, words=words, numbers=numbers, ranges=ranges)


def words_of(text: str) -> str:
    """A caption without its numbers."""
    return f"{_parts(text)[0]}."


def _parts(text: str) -> tuple[str, str]:
    """The sentence of words, and what stands behind it."""
    for end in ("contact area", NO_CONTACT.rstrip(".")):
        at = text.lower().find(end)
        if at >= 0:
            return text[: at + len(end)], text[at + len(end) :].removeprefix(".")
    return text, ""


def _right_words(said: Slots, truth: ContactState) -> dict[str, bool]:
    true = slots_of(truth)
    if not truth.in_contact:  # right is to say none
        return {name: getattr(said, name) is None for name in CLASSES}
    return {
        name: getattr(said, name) == getattr(true, name)
        for name in CLASSES
        if getattr(true, name) is not None
    }


def _is_near(name: str, value: float, truth: float) -> bool:
    return abs(value - truth) <= tolerance_of(name, truth) + 1e-9
