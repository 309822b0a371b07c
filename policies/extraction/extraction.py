"""Reads an action and a verdict out of what a policy said (paper, appendix B, Algorithm 1).

As printed, the algorithm looks for its descriptors as substrings: 'Stable' is inside 'unstable',
and 'not secure' contains 'secure'. Here a text is read sentence by sentence, and a sentence only if
``policies.extraction.patterns`` knows every clause in it. So conditions, hopes, reports and the
past need no rules of their own: they are not known and say nothing. Neither does a question.

A sentence that says nothing is passed over where it has to do with neither actions nor descriptors
('The pad ends inside it.'). Otherwise, or where it may take back what stands before it, nothing is
read in the whole text. The loop then holds still and asks the policy again.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field

from policies.extraction.clauses import (
    IDENTIFIERS,
    NONE_TOKEN,
    PURPOSE,
    Clause,
    Sentence,
    split_sentences,
)
from policies.extraction.patterns import (
    MENTIONS_ACTION,
    MENTIONS_VERDICT,
    NAMES_GRASP,
    Kind,
    Reading,
    denies_verdict,
    read,
)
from primitives import Primitive
from primitives.primitive import PAD_DIRECTION

MAX_CHARACTERS = 2000
"""A longer text is no decision: a model that did not stop. Our choice; D_t has about 300."""

_DECLARATIONS = (Kind.DECLARES, Kind.ADDS)
_PLAIN_LEADS = {"", ",", ":", "and", "but", "so"}
_TAKES_BACK = re.compile(
    r"\b(?:wrong|false|untrue|incorrect|mistake|ignore|disregard|cancel|forget|suppose|assume|imagine"
    r"|pretend|hypothetically|example|kidding|joking|joke|lie|sorry|wait|actually|meant|doubt|unclear"
    r"|unsure|maybe|perhaps)\b"
)
_CONTRADICTS = re.compile(r"(?:no(?! step)|not|never|but|however|that (?:is|was) not)\b")
"""How a sentence begins that takes back the one before it; 'no step fits' is a reason in D_t."""


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
    ambiguous: bool = False


def extract(text: str) -> Extraction:
    """Read action and verdict from any text. Never raises on a str.

    Source: paper, Algorithm 1, lines 'extract action' and 'if any keyword'; corrected as the
    module says.
    """
    if len(text) > MAX_CHARACTERS:
        reason = f"{len(text)} characters are no decision; at most {MAX_CHARACTERS} are read"
        return Extraction(action=None, success=False, reason=reason)
    statements = _Statements()
    for sentence in split_sentences(text):
        statements.add(sentence)
    return statements.extraction()


@dataclass(slots=True)
class _Statements:
    """What the sentences so far ask for and declare, and what speaks against it."""

    asked: set[Primitive] = field(default_factory=set)
    forbidden: set[Primitive] = field(default_factory=set)
    unread: set[Primitive] = field(default_factory=set)  # tokens in sentences that say nothing
    has_none: bool = False
    declared: str = ""
    denied: str = ""
    action_doubt: str = ""
    success_doubt: str = ""
    notes: list[str] = field(default_factory=list)

    def add(self, sentence: Sentence) -> None:
        words = sentence.text.split()
        self.has_none |= NONE_TOKEN in words
        readings = [(clause.text or clause.lead, read(clause)) for clause in sentence.clauses]
        unknown = [text for text, reading in readings if reading.kind is Kind.UNKNOWN]
        if not (sentence.question or unknown):
            self._take(sentence)
            return
        text = sentence.text
        note = f"'{text}' is a question" if sentence.question else f"'{unknown[0]}' is not read"
        self.forbidden.update(*(r.actions for _, r in readings if r.kind is Kind.FORBIDS))
        self.unread.update(IDENTIFIERS[word] for word in words if word in IDENTIFIERS)
        if denies_verdict(text):
            self.denied = f"'{text}' denies it"
        doubtful = MENTIONS_ACTION.search(text) or _TAKES_BACK.search(text)
        if doubtful or ((self.asked or self.declared) and _CONTRADICTS.match(text)):
            self.action_doubt = self.success_doubt = note
        if self.declared or MENTIONS_VERDICT.search(text):
            self.success_doubt = note

    def _take(self, sentence: Sentence) -> None:
        leads = {clause.lead for clause in sentence.clauses}
        asks = declares = False
        has_subject = True  # whether a descriptor alone is said of the grasp
        for clause, reading in _settled(sentence):
            kind = reading.kind
            if declares and clause.lead == "but":
                self.success_doubt = f"'but {clause.text}' takes it back"
            if kind is Kind.ASKS:
                self.asked |= reading.actions
                asks = True
                if "or" in leads or clause.lead == PURPOSE:
                    self.action_doubt = f"'{sentence.text}' is not clear"
            elif kind is Kind.FORBIDS:
                self.forbidden |= reading.actions
                self.notes.append(f"'{clause.text}' is forbidden")
            elif kind is Kind.DENIES:
                self.denied = f"'{clause.text}' denies it"
            elif kind in _DECLARATIONS:
                is_aim = asks or clause.lead == "so" or not leads <= _PLAIN_LEADS
                if is_aim or (kind is Kind.ADDS and not has_subject):
                    self.notes.append(f"'{clause.text}' is not said of the grasp now")
                else:
                    self.declared, declares = clause.text, True
            has_subject = kind in _DECLARATIONS and declares
            has_subject |= kind is Kind.DESCRIBES and bool(NAMES_GRASP.match(f"{clause.text} "))

    def extraction(self) -> Extraction:
        named = sorted(self.asked | self.unread)
        if len(named) > 1 or (named and self.has_none):
            both = " and ".join([*named, *([NONE_TOKEN] if self.has_none else [])])
            return _ambiguous(both)
        if contradiction := self.asked & self.forbidden:
            return _ambiguous(f"{min(contradiction)} is asked for and forbidden")
        action = None if self.action_doubt else next(iter(self.asked), None)
        success = bool(self.declared) and not (self.denied or self.success_doubt)
        head = f"says {NONE_TOKEN}" if self.has_none else "asks for no action"
        if action is not None:
            head = f"asks for {action}"
        verdict = f"declares success: '{self.declared}'" if success else "declares no success"
        if self.denied:
            verdict = f"no success: {self.denied}"
        doubts = dict.fromkeys((self.action_doubt, self.success_doubt))
        reason = "; ".join([head, verdict, *filter(None, doubts), *self.notes])
        return Extraction(action=action, success=success, reason=reason)


def _settled(sentence: Sentence) -> Iterator[tuple[Clause, Reading]]:
    """Clauses of a sentence, after what carries over from one to the next.

    'Do not move up, down or left' forbids three moves; 'do not move up and squeeze harder' forbids
    both; what stands in a purpose is neither declared nor denied.
    """
    leads = {clause.lead for clause in sentence.clauses}
    before = move = Kind.DESCRIBES
    for clause in sentence.clauses:
        reading = read(clause)
        kind = move if reading.kind is Kind.TURNS else reading.kind
        if clause.lead == PURPOSE and not reading.actions:
            kind = Kind.DESCRIBES
        elif (
            kind is Kind.ASKS and before is Kind.FORBIDS and ("or" in leads or clause.lead == "and")
        ):
            kind = Kind.FORBIDS
        if kind in (Kind.ASKS, Kind.FORBIDS):
            before = kind
            move = kind if reading.actions <= PAD_DIRECTION.keys() else Kind.DESCRIBES
        yield clause, Reading(kind=kind, actions=reading.actions)


def _ambiguous(reason: str) -> Extraction:
    return Extraction(action=None, success=False, reason=f"ambiguous: {reason}", ambiguous=True)
