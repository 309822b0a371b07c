"""Text to sentences, segments and words: what the extraction of actions and verdicts reads.

A sentence is a flat row of plain words with separators among them; a segment is what lies between
two separators. Punctuation, case, hyphens, underscores, contractions and Unicode look-alikes are
settled here, so that the grammar above sees one spelling of each thing. Not here: what any of it
means (``policies.extraction.mentions``, ``policies.extraction.verdict``).
"""

from __future__ import annotations

import re
import unicodedata
from dataclasses import dataclass

from primitives import Primitive


def word_set(text: str) -> frozenset[str]:
    """A vocabulary, written as the words of a text."""
    return frozenset(text.split())


IDENTIFIERS: dict[str, Primitive] = {p.value: p for p in Primitive}
NONE_TOKEN = "<none>"
UNKNOWN = "<unk>"
"""Stands for a word that can't be read; a sentence with one declares nothing."""

SEPARATORS = word_set(
    ", : and or nor but so so_that then because since while as although though however therefore "
    "thus hence whereas yet which if unless until till once when whenever before after"
)
NEGATORS = word_set(
    "not never no none neither nor nothing nobody noone nowhere without hardly scarcely barely "
    "rarely seldom non un except"
)

_JOINED = (
    ("not just yet", "not yet"),
    *((f"not {w}", "both") for w in ("only", "just", "merely", "simply")),
    *((f"no {w}", "surely") for w in ("doubt", "question")),
    *((p, "surely") for p in ("without doubt", "without a doubt", "without any doubt")),
    *((p, "surely") for p in ("beyond doubt", "beyond any doubt")),
    *((p, "not") for p in ("no longer", "not any longer", "far from", "anything but")),
    *((p, "not") for p in ("everything but", "nowhere near", "by no means", "in no way")),
    *((p, "not") for p in ("short of", "under no circumstances", "on no account", "no one")),
    *((p, "almost") for p in ("all but", "close to", "next to", "on the verge of", "near to")),
    *((p, "if") for p in ("as if", "as though", "only if", "even if", "in case", "given that")),
    *((p, "if") for p in ("as long as", "so long as", "provided that", "on condition")),
    *((p, "instead_of") for p in ("instead of", "rather than", "in place of", "in lieu of")),
    *((p, "not") for p in ("except for", "other than")),
    ("as soon as", "once"),
    ("so called", "allegedly"),
    ("or so it seems", "maybe"),
    ("or so it appears", "maybe"),
    ("so as to", "to"),
    ("so that", "so_that"),
    ("once more", "again"),
    ("right hand side", "right"),
    ("left hand side", "left"),
)
_PHRASES = re.compile(
    r"(?<![^ ])(?:"
    + "|".join(re.escape(p) for p, _ in sorted(_JOINED, key=lambda x: -len(x[0])))
    + r")(?![^ ])"
)
_PHRASE_WORD = dict(_JOINED)

_BARE = "isnt arent wasnt werent dont doesnt didnt cant couldnt wont wouldnt shouldnt mustnt hasnt "
_BARE += "havent hadnt neednt aint shant mightnt"
_STEM = {"ca": "can", "wo": "will", "sha": "shall", "ai": "is"}
_TAILS = {"'ll": "will", "'d": "would", "'re": "are", "'ve": "have", "'m": "am"}
_IS_OWNERS = word_set("it that there here this what everything he she")

_CONTROL = re.compile(r"</?\|?(?:s|eos|bos|pad|sep|cls|im_start|im_end|endoftext|end|begin)\|?>")
_SPECIAL = re.compile(r"<[^<>\s]{1,40}>")
_TOKEN = re.compile(
    r"<[a-z_]+>|\d+(?:[.,]\d+)*(?![a-z\d])|[a-z\d]+(?:_[a-z\d]+)*(?:'[a-z]+)*|[^\s\w]|_"
)
_MARKS = {
    **dict.fromkeys("([)]{}—―…→⇒,|•", ","),
    **dict.fromkeys("/", "or"),
    **dict.fromkeys("&+", "and"),
    **dict.fromkeys(":=", ":"),
    **dict.fromkeys("≠¬✗✘❌🚫", "not"),
    **dict.fromkeys("≈~", "almost"),
    **dict.fromkeys(".;!。；！", "."),
    **dict.fromkeys("?？¿", "?"),
}


@dataclass(frozen=True, slots=True, kw_only=True)
class Segment:
    """A stretch of words between two separators.

    Attributes:
        lead: The separator before it, '' for the first.
        start, end: Half-open range of its words in the sentence.
    """

    lead: str
    start: int
    end: int


@dataclass(frozen=True, slots=True, kw_only=True)
class Sentence:
    """One sentence.

    Attributes:
        words: Lower-case words and separators.
        segments: In order; separators belong to none.
        question: It ends with a question mark.
    """

    words: tuple[str, ...]
    segments: tuple[Segment, ...]
    question: bool

    def segment_index(self, word: int) -> int:
        """Index of the segment that holds word number ``word``."""
        return next(i for i, s in enumerate(self.segments) if s.start <= word < s.end)

    def of(self, segment: int) -> tuple[str, ...]:
        """Words of one segment."""
        s = self.segments[segment]
        return self.words[s.start : s.end]


def sentences(text: str) -> tuple[Sentence, ...]:
    """Split any text into sentences; never raises on a str.

    A line break is no full stop: 'not⏎stable' stays one sentence. A sentence that breaks off at a
    negation goes on into the next one, for the same reason.
    """
    found: list[Sentence] = []
    words: list[str] = []
    for word in [*_plain_words(text), "."]:
        if word not in (".", "?"):
            words.append(word)
        elif word == "." and words and words[-1] in NEGATORS:
            words.append(",")
        elif words:
            found.append(_sentence(words, question=word == "?"))
            words = []
        elif word == "?" and found:  # '?' after another stop: '!?'
            found[-1] = _sentence(list(found[-1].words), question=True)
    if words:
        found.append(_sentence(words, question=False))
    return tuple(s for s in found if s.segments)


def _sentence(words: list[str], *, question: bool) -> Sentence:
    segments: list[Segment] = []
    lead, start = "", 0
    for index, word in enumerate([*words, ","]):
        if word not in SEPARATORS or _adverb(words, index):
            continue
        if index > start:
            segments.append(Segment(lead=lead, start=start, end=index))
            lead = word
        elif not (word == "," and lead):  # ', but': the word says more than the comma
            lead = word if lead in ("", ",", ":", "and", "so") else lead
        start = index + 1
    return Sentence(words=tuple(words), segments=tuple(segments), question=question)


def _adverb(words: list[str], index: int) -> bool:
    """'it was stable before, ...': a conjunction with nothing after it is none."""
    ends = index + 1 >= len(words) or words[index + 1] in (",", "and", "but")
    return ends and words[index : index + 1] in (["before"], ["after"], ["once"])


def _plain_words(text: str) -> list[str]:
    """Words, separators, '.' and '?' of a text, in one spelling each."""
    words: list[str] = []
    for token in _TOKEN.findall(_normal(text)):
        words.extend(_expanded(token))
    joined = _PHRASES.sub(lambda m: _PHRASE_WORD[m.group(0)], " ".join(words))
    return joined.split()


def _normal(text: str) -> str:
    """Lower case, ASCII where it can be, invisible characters gone, hyphens and lines settled."""
    text = re.sub(r"≠|!=", " ¬ ", text)  # before decomposition makes '=' of it
    text = unicodedata.normalize("NFKD", text.replace("…", ",").replace("\\", "").replace("µ", "u"))
    text = "".join(c for c in text if unicodedata.category(c) not in ("Cf", "Mn", "Cs"))
    text = text.casefold()
    text = re.sub(r"[‘’ʼ′`´＇‛]", "'", text)
    text = re.sub(r"[‐‑‒–−⁃]", "-", text)
    text = re.sub(
        r"\b(is|are|was|were|do|does|did|could|would|should|has|have)n t\b", r"\1n't", text
    )
    text = re.sub(r"\be\.\s?g\.|\bi\.\s?e\.", " ", text)
    text = re.sub(r"(?<=[a-z])-\s*[\r\n]+\s*(?=[a-z])", "-", text)  # a word broken over lines
    text = re.sub(r"[-=]+>|--+|(?<!\S)-+(?!\S)|\.\.+", " , ", text)
    text = re.sub(r"[\r\n\v\f\x1c-\x1e\x85\u2028\u2029]+", " , ", text)
    text = re.sub(
        r"\b(re|un|in)-(?=grasp|grip|set|start|stable|secure|reliable|appropriate)", r"\1", text
    )
    text = _CONTROL.sub(" . ", text)
    text = _SPECIAL.sub(lambda m: m.group(0) if _known(m.group(0)) else f" {UNKNOWN} ", text)
    text = re.sub(r"[^\W\d_]*[^\W\d_a-z][^\W\d_]*", f" {UNKNOWN} ", text)  # foreign letters
    return re.sub(r"(?<![a-z\d])_+|_+(?![a-z\d])", " ", text)


def _known(token: str) -> bool:
    return token in (NONE_TOKEN, UNKNOWN) or token[1:-1] in IDENTIFIERS


def _expanded(token: str) -> list[str]:
    """The words that one token stands for."""
    if token.startswith("<") and len(token) > 1:
        return [token if token in (NONE_TOKEN, UNKNOWN) else token[1:-1]]
    if token in IDENTIFIERS:
        return [token]
    if "_" in token:
        return [w for part in token.split("_") for w in _expanded(part)]
    if not token[0].isalnum():
        return [_MARKS[token]] if token in _MARKS else []
    if token == "cannot":
        return ["can", "not"]
    if token in _BARE.split():
        return [_STEM.get(token[:-2], token[:-2]), "not"]
    if token.endswith("n't"):
        return [_STEM.get(token[:-3], token[:-3]), "not"]
    for tail, word in _TAILS.items():
        if token.endswith(tail):
            return [token[: -len(tail)], word]
    if token.endswith("'s"):
        owner = token[:-2]
        return (
            [owner, "is"] if owner in _IS_OWNERS else ([owner, "us"] if owner == "let" else [owner])
        )
    return [token.replace("'", "")]
