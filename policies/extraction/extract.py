"""Reads an action and a verdict out of what a policy said (paper, appendix B, Algorithm 1).

As printed, the algorithm looks for its descriptors as substrings: 'Stable' is inside 'unstable',
and 'not secure' contains 'secure'. Here whole words count, inside clauses, with negation. Our
choices, where the paper is silent:

* Success is declared by 'stable', 'appropriate', 'secure' or 'reliable', said of the present touch.
  'Stability' or 'securely held' are not these words and declare nothing.
* A negated, future, past, conditional, wished, questioned or merely compared success is none. A
  text that also denies it ('stable but not secure', 'it is unstable') declares nothing.
* A negated, conditional, past or questioned action is none; so is what the contact does by itself.
* Two different actions, or ``<none>`` beside one, are ambiguous: no action and no success either,
  since a Decision with success and no action ends the loop.

* A text of more than ``MAX_CHARACTERS`` is not read at all.

In doubt it reads nothing: the loop then holds still and asks again. Not here: the grammar
(``policies.extraction.clauses``, ``mentions``, ``requests``, ``verdict``).
"""

from __future__ import annotations

from dataclasses import dataclass

from policies.extraction.clauses import NONE_TOKEN, Sentence, sentences
from policies.extraction.mentions import Mention, mentions
from policies.extraction.requests import Status, status
from policies.extraction.verdict import Verdict, verdict
from primitives import Primitive

MAX_CHARACTERS = 2000
"""A longer text is no decision: a model that did not stop. Our choice; D_t has about 300."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Extraction:
    """What a text asks for and declares.

    Attributes:
        action: The one primitive asked for; None when there is none, or more than one.
        success: The text declares the grasp good; never together with ``ambiguous``.
        reason: How this was read, for people.
        ambiguous: The text asks for different things.
    """

    action: Primitive | None
    success: bool
    reason: str
    ambiguous: bool


def extract(text: str) -> Extraction:
    """Read action and verdict from any text. Never raises on a str.

    Source: paper, Algorithm 1, lines 'extract action' and 'if any keyword'; mended as the module
    says.
    """
    if len(text) > MAX_CHARACTERS:
        reason = f"{len(text)} characters are no decision; at most {MAX_CHARACTERS} are read"
        return Extraction(action=None, success=False, reason=reason, ambiguous=False)
    asked: set[Primitive] = set()
    later: set[Primitive] = set()
    denied: set[Primitive] = set()
    notes: list[str] = []
    parsed = sentences(text)
    requests: list[tuple[Sentence, int]] = []
    for sentence in parsed:
        found = mentions(sentence)
        first = len(sentence.words)
        for number, mention in enumerate(found):
            state = status(sentence, mention, found[:number])
            if state is Status.ASKED:
                asked.add(mention.primitive)
                first = min(first, mention.start)
            elif state is Status.LATER:
                later.add(mention.primitive)
            else:
                if state is Status.NEGATED:
                    denied.add(mention.primitive)
                notes.append(f"'{_words(sentence, mention)}' is {state}")
        requests.append((sentence, first))
    explicit_none = any(NONE_TOKEN in s.words for s in parsed)
    if not asked:
        notes += [f"{p} comes {Status.LATER}" for p in sorted(later)]
    named = asked | (later if asked else set())
    if len(named) > 1 or (named and explicit_none):
        both = [*sorted(named), *([NONE_TOKEN] if explicit_none else [])]
        return Extraction(
            action=None, success=False, reason=f"ambiguous: {' and '.join(both)}", ambiguous=True
        )
    if named & denied:
        reason = f"ambiguous: {next(iter(named))} is asked for and denied"
        return Extraction(action=None, success=False, reason=reason, ambiguous=True)
    action = next(iter(named), None)
    said = verdict(requests)
    return Extraction(
        action=action,
        success=said.success,
        reason=_reason(action, said, explicit_none, notes),
        ambiguous=False,
    )


def _words(sentence: Sentence, mention: Mention) -> str:
    return " ".join(sentence.words[mention.start : mention.end])


def _reason(action: Primitive | None, said: Verdict, explicit_none: bool, notes: list[str]) -> str:
    if action is not None:
        head = f"asks for {action}"
    else:
        head = f"says {NONE_TOKEN}" if explicit_none else "asks for no action"
    return "; ".join([head, said.reason, *notes])
