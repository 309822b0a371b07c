"""Refuses questions that no answer about touch can fit: none at all, too long, not in English.

A plain English question with rare words is not refused: that it is not about touch, or that touch
can't know it, is the model's own answer.
"""

from __future__ import annotations

import re

from cltp.texts.tokenizer import Words
from policies.errors import PolicyError

MAX_WORDS = 120
"""Longest question [words]. The model would read only the end of a longer one."""

MIN_KNOWN_FRACTION = 0.5
"""Smallest fraction of a question's words that the tokenizer must have as whole words, where no
word of ``ENGLISH`` is in it. Our choice: other languages have below 0.3."""

_ENGLISH = (
    "what whats who whom whose when where why which how hows the this that these those does did "
    "doesn isn aren are you your with would could should there they about tell give and"
)
ENGLISH = frozenset(_ENGLISH.split())
"""Words that tell an English question, whatever else it asks for; in the languages that our tests
hold against it they are rare."""

_SHORT_WORDS = frozenset(
    "a i an as at be by do go in is it me my no of on or so to up us we ok "  # noqa: SIM905
    "n mn cn g kg mm cm µm lb oz x y z f fn fx fy fz".split(" ")
)

_QUANTITIES = frozenset(
    ("torque", "torques", "friction", "stiffness", "shear", "temperature", "pressure", "kpa")
)
"""What somebody may ask for in one word, whether touch knows it or not."""


def check_question(text: str, words: Words | None) -> None:
    """Refuse a question that the model can't read.

    Args:
        text: The question as a person wrote it.
        words: Tokenizer of the model; None for a stock checkpoint, which may know any language.

    Raises:
        PolicyError: The question has no words, too many, or is not in English.
    """
    text_words = [word.lower() for word in re.findall(r"[^\W\d_]+", text)]
    if not text_words:
        raise PolicyError(f"a question in words is needed, got {text[:40]!r}")
    if len(text_words) > MAX_WORDS:
        raise PolicyError(
            f"the question has {len(text_words)} words, at most {MAX_WORDS} are read; shorten it"
        )
    if words is None or not ENGLISH.isdisjoint(text_words):
        return
    num_known = sum(_is_known(word, words) for word in text_words)
    if num_known < MIN_KNOWN_FRACTION * len(text_words):
        raise PolicyError(
            f"only {num_known} of {len(text_words)} words of {text[:60]!r} are known; ask in "
            "plain English, for example 'How deep is the contact?'"
        )


def _is_known(word: str, words: Words) -> bool:
    if len(word) <= 2:
        return word in _SHORT_WORDS  # pieces of longer words are tokens too
    return word in _QUANTITIES or words.has_token(word) or words.has_token(word.capitalize())
