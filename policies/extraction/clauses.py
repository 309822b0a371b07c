"""Splits any text into sentences and clauses of plain lower-case words.

Punctuation, case, markup, contractions and Unicode look-alikes are settled here, so that
``policies.extraction.patterns`` sees one spelling of each word. What can't be spelled that way
stays in the clause as an unknown word, and no pattern matches it.
"""

from __future__ import annotations

import re
import unicodedata
from dataclasses import dataclass
from functools import lru_cache

from primitives import Primitive

IDENTIFIERS: dict[str, Primitive] = {p.value: p for p in Primitive}
NONE_TOKEN = "<none>"
PURPOSE = "<purpose>"
"""Lead of a clause that says what an action is for: 'until …', 'so that …', 'to make …'."""

INSTEAD = "instead_of"
"""Lead of a clause that is not to be done: 'instead of …', 'rather than …'."""

LEADS = ("", ",", ":", "then", "so", "and", "but", "or", INSTEAD, PURPOSE)
"""Separators of clauses; of several in a row ('; and until') the last one in this list counts."""

NEGATIONS = ("not", "no", "never", "neither", "nor", "nobody", "without", "hardly", "non", "un")

_SPELLINGS = (
    (r"[‘’ʼ′´]", "'"),
    (r"[‐‑‒−]", "-"),
    (r"</?\|?(?:s|eos|bos|pad|end|im_end|im_start|endoftext)\|?>", " . "),
    (rf"<({'|'.join(IDENTIFIERS)})>", r" \1 "),
    (r"[-=]+>|--+|(?<!\S)-+(?!\S)|\.\.+|[\n\r\v\f\x1c-\x1e\x85\u2028\u2029]+", " , "),
    (r"\b(re|un|in|non)-(?=[a-z])", r"\1"),
    (r"(?<=[a-z])-(?=[a-z])|[+-](?=\d)", " "),
    (r"[*`#\\]|\(\)", " "),
)
_CONTRACTIONS = (
    (r"\bcannot\b", "can not"),
    (r"\b(do|does|did|is|are|was|were|has|have|must|need|should|could|would)n'?\s?t\b", r"\1 not"),
    (r"\b(it|that|this|there)'s\b", r"\1 is"),
    (r"\blet's\b", "let us"),
)
_PHRASES = (
    (r"\b(?:instead of|rather than)\b", INSTEAD),
    (r"\b(?:so that|in order to|until)\b", PURPOSE),
    (r"\bto (?=(?:achieve|bring|cent(?:er|re)|get|make|reach)\b)|^for (?=an? )", f"{PURPOSE} "),
    (r"\bright (?=now|away)", "right_"),  # no direction
    (r"\b(?:open|release(?: it)?|let go|go back to the start) and (?:grasp|try) again\b", "reset"),
)
_TOKEN = re.compile(rf"{NONE_TOKEN}|[a-z]+(?:_[a-z]+)*|\d+(?:[.,]\d+)*|\S")
_MARKS = {
    **dict.fromkeys(".;!。；！", "."),
    **dict.fromkeys("?？", "?"),
    **dict.fromkeys(",()[]{}—―–|•", ","),
    "/": "or",
    "&": "and",
}


@dataclass(frozen=True, slots=True, kw_only=True)
class Clause:
    """Words between two separators.

    Attributes:
        lead: The separator before the words, one of ``LEADS``; '' for the first clause.
        text: Lower-case words with one space between them; '' after a separator at the end.
    """

    lead: str
    text: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Sentence:
    """One sentence.

    Attributes:
        clauses: In order; never empty.
        text: All its words and separators.
        question: It ends with a question mark.
    """

    clauses: tuple[Clause, ...]
    text: str
    question: bool


def split_sentences(text: str) -> tuple[Sentence, ...]:
    """Split any text; never raises on a str.

    A line break is no full stop ('not⏎stable' is one sentence), and a sentence that breaks off at a
    negation goes on into the next ('Not. Stable.').
    """
    sentences: list[Sentence] = []
    words: list[str] = []
    for word in [*_words(text), ".", "."]:
        if word not in (".", "?"):
            words.append(word)
        elif word == "." and words and words[-1] in NEGATIONS:
            words.append(",")
        elif words:
            sentences.append(_sentence(" ".join(words), question=word == "?"))
            words = []
        elif word == "?" and sentences:  # '!?'
            sentences[-1] = _sentence(sentences[-1].text, question=True)
    return tuple(sentence for sentence in sentences if sentence.clauses)


@lru_cache(maxsize=256)
def _sentence(text: str, *, question: bool) -> Sentence:
    for pattern, replacement in _PHRASES:
        text = re.sub(pattern, replacement, text)
    clauses: list[Clause] = []
    lead, words = "", list[str]()
    for word in text.split():
        if word not in LEADS:
            words.append(word)
        elif words:
            clauses.append(Clause(lead=lead, text=" ".join(words)))
            lead, words = word, []
        else:
            lead = max(lead, word, key=LEADS.index)
    if words or lead not in ("", ",", ":"):
        clauses.append(Clause(lead=lead, text=" ".join(words)))
    return Sentence(clauses=tuple(clauses), text=text, question=question)


def _words(text: str) -> list[str]:
    """Words and separators of a text, in one spelling each."""
    if not text.isascii():
        text = unicodedata.normalize("NFKD", text)
        text = "".join(c for c in text if unicodedata.category(c) not in ("Cf", "Mn", "Cs"))
    text = text.casefold()
    for pattern, replacement in _SPELLINGS:
        text = re.sub(pattern, replacement, text)
    text = re.sub(r"[a-z_]+", lambda m: IDENTIFIERS.get(m[0], m[0].replace("_", " ")), text)
    for pattern, replacement in _CONTRACTIONS:
        text = re.sub(pattern, replacement, text)
    return [_MARKS.get(token, token) for token in _TOKEN.findall(text)]
