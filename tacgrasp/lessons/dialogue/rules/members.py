"""Questions whether the shape, the texture, the depth or the area is one of some named classes.

    Is the shape one of edge, corner or line?           shape in ['edge', 'corner', 'line']
    Has it been classified as a sphere or a cylinder?   shape in ['sphere', 'cylinder']
    Anything bumpy or rough about it?                   texture in ['bumpy', 'rough']

Not here: alternatives, whose answer is one of them (``tacgrasp.lessons.dialogue.choices``).
"""

from __future__ import annotations

import re

from cltp.tactile.states import CLASSES
from tacgrasp.lessons.dialogue.meaning import Calculated
from tacgrasp.lessons.dialogue.plainer import AUXILIARY

_ONE_OF = re.compile(
    r"\b(?:one|either|some) (?:of|from|among) (?:these|those|the|them|this)?\b|\bone of\b|"
    r"\bamong\b|\b(?:classified|categori[sz]ed|labelled|labeled|recogni[sz]ed|registered) as\b|"
    r"\b(?:belong|belongs|fall|falls|count|counts|qualif\w+) (?:to|into|in|as|among)\b|"
    r"\banything\b|\bfile\b.*\bunder\b|\b(?:do|can) (?:you|we) (?:feel|sense|detect|have)\b|"
    r"\bwould (?:you|one) (?:class|call|describe|rate)\b|\bdescribed (?:by|as)\b|"
    r"\beither of the words\b|\brather than anything else\b|\bas opposed to anything else\b"
)
_CHOOSES = re.compile(
    r"\b(?:which|what|pick|choose|name|say|tell|neither|none|something else|other|not|if|than)\b"
)
_ASKS_YES = re.compile(
    rf"(?:(?:and|so|please) )?(?:{AUXILIARY}|anything|confirm|verify|check|true or false)\b"
)
_NUMBER = re.compile(r"\d")
_VERDICT = re.compile(
    r"^yes or no\b|\b(?:yes or no|either one|true or false)$|"
    r"^(?:(?:and|so|then|now) )*(?:could|might|can) (?:it|this|that|(?:the|what) [a-z ]+?)"
    r"(?: (?:possibly|maybe|perhaps|well|conceivably))? be\b"
)
"""What wants yes or no of classes that 'or' joins, which are a choice without it."""


def verdict_of(question: str) -> Calculated | None:
    """The same of 'is it an edge or a corner, yes or no?' and 'could it be an edge or a corner?'.

    None of any other question.
    """
    words = _bare(question)
    if _VERDICT.search(words) is None:
        return None
    bare = re.sub(r"^yes or no | (?:yes or no|either one|true or false)$", "", words)
    return member_of(f"is it one of {bare}") if _ASKS_YES.match(bare) else None


def member_of(question: str) -> Calculated | None:
    """Whether what is felt is one of the named classes; None of any other question."""
    words = _bare(question)
    if not _ASKS_YES.match(words) or not _ONE_OF.search(words):
        return None
    is_joined = " or " in words or "either of" in words
    if _CHOOSES.search(words) or _NUMBER.search(words) or not is_joined:
        return None
    for name in ("shape", "texture"):
        named = [each for each in CLASSES[name] if re.search(rf"\b{each}s?\b", words)]
        if len(named) >= 2:
            others = [n for n in ("shape", "texture") if n != name]
            if any(re.search(rf"\b{each}\b", words) for n in others for each in CLASSES[n]):
                return None
            return Calculated(truth=f"{name} in [{', '.join(map(repr, named))}]", unit=None)
    return None


def _bare(question: str) -> str:
    """The words and numbers of a question."""
    return " ".join(re.findall(r"[a-z]+(?:-[a-z]+)?|\d+", question.lower()))
