"""How much of some questions the grammar contains: whole wordings, and runs of four words.

Decided exactly on the automata of the families (``tacgrasp.lessons.dialogue.patterns``), which
accept every wording that the grammar produces: what they reject, it can't produce. The wordings
that were written whole count as the grammar's. Both sides are compared in plain words, so capitals,
punctuation, contractions and spelling make no difference.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from tacgrasp.lessons.dialogue.families.catalogue import FAMILIES
from tacgrasp.lessons.dialogue.plain_words import plain_words
from tacgrasp.lessons.dialogue.whole_wordings import whole_wordings

RUN = 4
"""Length of a run [words]."""

WHOLE = "whole wordings"
"""Name of the wordings that were written whole, among those of the families."""


@dataclass(frozen=True, slots=True, kw_only=True)
class WordingCoverage:
    """One question against the grammar.

    Attributes:
        question: The question.
        produced_by: Names of the families that can produce it.
        runs: Its runs of ``RUN`` words; of a shorter question the whole of it.
        known: Those of them that occur in the grammar.
    """

    question: str
    produced_by: tuple[str, ...]
    runs: tuple[tuple[str, ...], ...]
    known: tuple[tuple[str, ...], ...]

    @property
    def fraction(self) -> float:
        """Fraction of its runs that occur in the grammar."""
        return len(self.known) / len(self.runs)


def coverage(questions: Sequence[str]) -> list[WordingCoverage]:
    """Compare questions with the grammar."""
    known: dict[tuple[str, ...], bool] = {}
    whole = {tuple(words.split()) for each in whole_wordings() for words, _ in each.variants()}
    whole_runs = {run for words in whole for run in _runs(words)}
    results = []
    for question in questions:
        words = plain_words(question)
        runs = _runs(words)
        for run in runs:
            if run not in known:
                known[run] = run in whole_runs or any(
                    family.automaton.has_run(run) for family in FAMILIES
                )
        results.append(
            WordingCoverage(
                question=question,
                produced_by=tuple(f.name for f in FAMILIES if f.automaton.accepts(words))
                + (WHOLE,) * (words in whole),
                runs=runs,
                known=tuple(run for run in runs if known[run]),
            )
        )
    return results


def _runs(words: tuple[str, ...]) -> tuple[tuple[str, ...], ...]:
    return tuple(words[at : at + RUN] for at in range(max(1, len(words) - RUN + 1)))
