"""Questions drawn from the grammar: with their queries for training, about a contact for tests.

Balanced over the kinds of answers, over the families of a kind, and between yes and no: thresholds
are drawn around the values of the contact, and words are its own or others, half and half.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from cltp.tactile.states import ContactState
from cltp.texts.exchange_packing import Exchange
from primitives.contract import Contract
from tacgrasp.lessons.dialogue.answers import answer
from tacgrasp.lessons.dialogue.families.catalogue import FAMILIES
from tacgrasp.lessons.dialogue.meaning import (
    Amount,
    AnswerKind,
    Check,
    Length,
    Meaning,
    Several,
    Which,
    kind_of,
    names_of,
    truth_of,
)
from tacgrasp.lessons.dialogue.patterns.family import QuestionFamily
from tacgrasp.lessons.dialogue.patterns.pattern import draw
from tacgrasp.lessons.dialogue.plain_words import CONTRACTIONS, MISSPELLINGS
from tacgrasp.lessons.dialogue.query import LostNumberError, asked_text, query_of
from tacgrasp.lessons.dialogue.scene import HOLDING_N_PER_G, AskedScene, band_contract
from tacgrasp.lessons.dialogue.scoring.question_file import QuestionRow, question_row
from tacgrasp.lessons.dialogue.whole_wordings import drawn_whole
from tacgrasp.lessons.slips import slipped

KIND_WEIGHTS: Mapping[AnswerKind, float] = {
    AnswerKind.NUMBER: 0.20,
    AnswerKind.YES_NO: 0.36,
    AnswerKind.CHOICE: 0.12,
    AnswerKind.TEXT: 0.12,
    AnswerKind.UNKNOWABLE: 0.10,
    AnswerKind.OFF_TOPIC: 0.10,
}
"""How often each kind of answer is asked for. Our choice."""

TOGETHER, A_THIRD = 0.15, 0.25
"""Fraction of learned questions that are several ones of any families, and the fraction of these
that are three. Our choice: people join what they like, and the families of several things join
what stands in their tables alone."""

JOINERS = (" and ", ", and ", "? ", "? And ", ", also ", "; ", ", then ", " plus ", ". ", ", ")

WHOLE = 0.45
"""Fraction of learned questions that are whole wordings. Our choice."""

TRIES = 20
"""Wordings that are drawn for a yes, or a no, before the last one is taken as it is."""

SPOILED = 0.12
"""Fraction of questions with contractions left out, or common misspellings."""


@dataclass(frozen=True, slots=True, kw_only=True)
class DrawnQuestion:
    """A question with its meaning.

    Attributes:
        family: Its family.
        text: Its wording.
        meaning: Its meaning.
        before: The question before it, where it is a follow-up; ''.
    """

    family: str
    text: str
    meaning: Meaning
    before: str = ""

    @property
    def row(self) -> QuestionRow:
        """The question as a row of a file."""
        columns = {
            "family": self.family,
            "question": self.text,
            "kind": kind_of(self.meaning).value,
            "truth": truth_of(self.meaning),
            "tolerance": "",
            "before": self.before,
        }
        return question_row(columns)


@lru_cache(maxsize=1)
def families_by_kind() -> Mapping[AnswerKind, tuple[QuestionFamily, ...]]:
    """Families by the kind of their answers."""
    rng = np.random.default_rng(0)
    kinds = [kind_of(_wording(family, AskedScene(), rng, {})[1]) for family in FAMILIES]
    return {
        kind: tuple(f for f, own in zip(FAMILIES, kinds, strict=True) if own is kind)
        for kind in AnswerKind
    }


def draw_question(
    scene: AskedScene, rng: np.random.Generator, family: QuestionFamily | None = None
) -> DrawnQuestion:
    """Draw a question about a scene.

    Args:
        scene: What it is asked about; numbers and words of the question are drawn around it.
        rng: Draws.
        family: Its family; None draws one.
    """
    family = family or _drawn_family(rng)
    wants_yes = bool(rng.random() < 0.5)
    values = scene.values()
    for _ in range(TRIES):
        text, meaning = _wording(family, scene, rng, family.steer(scene, wants_yes, rng))
        if not isinstance(meaning, Check) or any(values[n] is None for n in names_of(meaning)):
            break
        if answer(meaning, scene).value == wants_yes:
            break
    before = family.before[int(rng.integers(len(family.before)))] if family.before else ""
    return DrawnQuestion(
        family=family.name,
        text=spelled(text, rng),
        meaning=meaning,
        before=before,
    )


def _wording(
    family: QuestionFamily, scene: AskedScene, rng: np.random.Generator, given: Mapping[str, str]
) -> tuple[str, Meaning]:
    drawn = draw(family.node, rng, given)
    numbers = dict(family.choose(scene, drawn.bindings, rng)) if drawn.numbers else {}
    for name in drawn.numbers:
        numbers.setdefault(name, str(int(rng.integers(2, 100))))
    named = {name: float(numbers[name]) for name in drawn.numbers}
    return _sentence(drawn.text(numbers)), family.build(drawn.bindings, named)


def _sentence(text: str) -> str:
    """A wording with a capital, and with a sign at its end."""
    if text[-1:] not in "?.":
        text += "." if _REQUEST.match(text) else "?"
    return re.sub(r"(?:^|(?<=[.?!] ))[a-z]", lambda match: match[0].upper(), text)


def spelled(text: str, rng: np.random.Generator) -> str:
    """A wording as people type it: perhaps small, without its last sign, or misspelled.

    Its plain words stay the same.
    """
    if rng.random() < 0.25:
        text = text.lower().replace("µm", "um")
    if rng.random() < 0.2:
        text = text.rstrip("?. ")
    if rng.random() < SPOILED:
        lowered = text.lower()
        right, wrong = _SPELLINGS[int(rng.integers(len(_SPELLINGS)))]
        if f" {right} " in f" {lowered} ":
            text = f" {lowered} ".replace(f" {right} ", f" {wrong} ", 1).strip()
    return text


_REQUEST = re.compile(
    r"(?:(?:please|hey,|ok,|now,|so,|and|then) )?(?:give|tell|report|show|state|log|estimate|check|"
    r"describe|say|let|i (?:need|want|would|am|wonder)|write|remind|convert|choose)\b",
    re.I,
)
_SPELLINGS = [
    (right, wrong) for table in (MISSPELLINGS, CONTRACTIONS) for wrong, right in table.items()
]


def draw_scene(state: ContactState, rng: np.random.Generator) -> AskedScene:
    """A contact with a contract near its force, or none, and a mass near what it holds, or none."""
    force_n = _felt_or_usual(state)
    contract = draw_contract(state, rng) if rng.random() < 0.85 else None
    mass_g = None
    if rng.random() < 0.75:
        mass_g = float(
            max(2, round(force_n / HOLDING_N_PER_G * float(np.exp(rng.uniform(-0.8, 0.8)))))
        )
    return AskedScene(state=state, contract=contract, mass_g=mass_g)


def draw_contract(state: ContactState, rng: np.random.Generator) -> Contract:
    """A contract near the force of a contact, so that its band decides what is right."""
    middle = _felt_or_usual(state) * np.exp(rng.uniform(-0.7, 0.7))
    middle = float(np.clip(middle, 0.2, 12.0))
    ratio = float(rng.uniform(1.1, 1.5))
    low, high = round(middle / ratio, 2), round(middle * ratio, 2)
    return band_contract(low, high, round(high * float(rng.uniform(1.1, 1.4)), 2))


def _felt_or_usual(state: ContactState) -> float:
    """Force of a contact, 1 N without one [N]."""
    return state.force_n if state.in_contact and state.force_n > 0 else 1.0


def query_exchange(rng: np.random.Generator) -> Exchange:
    """A question about no contact in plain words, and its query, to be learned.

    Some words are left out, misspelled or exchanged: the question stays the same. A question whose
    number is read otherwise ('this one and three tenths' is 1.3) is drawn anew.
    """
    if rng.random() < WHOLE:
        return whole_exchange(rng)
    return composed_exchange(rng)


def whole_exchange(rng: np.random.Generator) -> Exchange:
    """A question that was written whole, and its query, to be learned."""
    words, query = drawn_whole(rng)
    return Exchange(prompt=slipped(words, rng), reply=query)


def composed_exchange(rng: np.random.Generator) -> Exchange:
    """A question that patterns compose, and its query, to be learned."""
    while True:
        try:
            return _query_exchange(rng)
        except LostNumberError:
            continue


def _query_exchange(rng: np.random.Generator) -> Exchange:
    if rng.random() < TOGETHER:
        text, meaning = _asked_together(rng)
        before = ""
    else:
        family = _drawn_family(rng)
        text, meaning = _any_wording(family, rng)
        before = family.before[int(rng.integers(len(family.before)))] if family.before else ""
    asked = asked_text(text, before)
    return Exchange(prompt=slipped(asked.words, rng), reply=query_of(meaning, asked.numbers))


def _drawn_family(rng: np.random.Generator) -> QuestionFamily:
    kinds = list(KIND_WEIGHTS)
    kind = kinds[int(rng.choice(len(kinds), p=list(KIND_WEIGHTS.values())))]
    families = families_by_kind()[kind]
    return families[int(rng.integers(len(families)))]


def _any_wording(family: QuestionFamily, rng: np.random.Generator) -> tuple[str, Meaning]:
    """A wording about no scene in particular."""
    scene = AskedScene()
    return _wording(family, scene, rng, family.steer(scene, True, rng))


def _asked_together(rng: np.random.Generator) -> tuple[str, Meaning]:
    """Questions of two or three families, one after another in any way."""
    texts: list[str] = []
    parts: list[Amount | Check | Which] = []
    wanted = 2 + int(rng.random() < A_THIRD)
    while len(parts) < wanted:
        family = _drawn_family(rng)
        if family.before:
            continue
        text, meaning = _any_wording(family, rng)
        if not isinstance(meaning, Amount | Check | Which) or meaning.length is not Length.FREE:
            continue
        if meaning not in parts:
            parts.append(meaning)
            texts.append(text.rstrip("?. "))
    joiner = JOINERS[int(rng.integers(len(JOINERS)))]
    first = "First, " if rng.random() < 0.1 else ""
    return first + joiner.join(texts), Several(parts=tuple(parts))


def drawn_rows(
    scenes: Sequence[AskedScene], num: int, seed: int
) -> list[tuple[QuestionRow, AskedScene]]:
    """Questions of the grammar with the scenes that they were drawn for."""
    rng = np.random.default_rng(seed)
    chosen = [scenes[int(rng.integers(len(scenes)))] for _ in range(num)]
    return [(draw_question(scene, rng).row, scene) for scene in chosen]
