"""``tacgrasp bench robustness``: each nuisance of a sensor at each level, all others nominal.

Heads and captions read contacts, policies grasp; beside each figure stands its limit: what an
observer with exact heights reads (``cltp.evaluation.exact_observer``), or how often the oracle's
grasp is verified under the same condition. Seeds are paired: every condition has the same contacts,
bodies and draws.
"""

from __future__ import annotations

import tempfile
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from itertools import islice
from pathlib import Path
from typing import TypeVar

import numpy as np
import torch
from numpy.typing import NDArray
from rich.console import Console

from cltp.data.dataset import ContactDataset
from cltp.errors import TouchError
from cltp.evaluation.scores import Predictions
from cltp.tactile.point_layout import EVEN
from cltp.tactile.states import CLASSES, NUMBERS
from tacgrasp.base.errors import UsageError
from tacgrasp.benchmarks.loop.contestants import SWEEP, swept_forces_n
from tacgrasp.benchmarks.pool import each_result
from tacgrasp.benchmarks.results_file import weights_sum
from tacgrasp.benchmarks.robustness import readers
from tacgrasp.benchmarks.robustness.conditions import NOMINAL, NUISANCES, Condition
from tacgrasp.benchmarks.robustness.contacts import ContactSource, layout_of
from tacgrasp.benchmarks.robustness.episodes import run_episode_under
from tacgrasp.benchmarks.robustness.report import draw, print_tables
from tacgrasp.benchmarks.robustness.store import (
    CONSTANT,
    CONTACT_SUBJECTS,
    FIXED_FORCE,
    ORACLE,
    POLICY_SUBJECTS,
    VERIFIED,
    CellResult,
    Store,
    job_name,
)
from tacgrasp.benchmarks.settings import RobustnessSettings, names_in
from tacgrasp.config.layers import load
from tacgrasp.config.schema import RunConfig
from tacgrasp.policy_factory import default_weights

BLOCK = 10
"""Contacts that one process reads at a time."""

QUICK_CONTACTS, QUICK_EPISODES = 40, 4

T = TypeVar("T")

_Job = tuple[str, Condition]
"""A nuisance and the condition of one of its levels."""


def run(settings: RobustnessSettings) -> None:
    """Measure what is missing, print the tables and write the figures after every condition.

    Raises:
        UsageError: An unknown subject or nuisance, or a file with other figures.
        TouchError: Weights or data can't be used.
    """
    subjects = _names(settings.subjects, (*CONTACT_SUBJECTS, *POLICY_SUBJECTS, FIXED_FORCE))
    nuisances = _names(settings.nuisances or ",".join(NUISANCES), tuple(NUISANCES))
    weights = settings.weights or default_weights()
    num_contacts = QUICK_CONTACTS if settings.quick else settings.contacts
    episodes = QUICK_EPISODES if settings.quick else settings.episodes
    about = {
        "weights": weights_sum(weights),
        "data": None if settings.data is None else ContactDataset(settings.data).checksum()[:16],
        "contacts": num_contacts,
        "episodes": episodes,
        "first_seed": settings.first_seed,
        "task": settings.task,
    }
    config = load(settings.task)[0].model_copy(update={"weights": weights})
    store = Store(path=settings.json, about=about)
    store.read(resume=settings.resume)
    console = Console(highlight=False)
    console = console if console.is_terminal else Console(width=160, highlight=False)
    jobs = [(name, condition) for name in nuisances for condition in NUISANCES[name].values()]
    bench = _Bench(store=store, console=console, workers=settings.workers)
    with tempfile.TemporaryDirectory() as folder:
        on_contacts = [name for name in CONTACT_SUBJECTS if name in subjects]
        source = ContactSource(
            data=settings.data,
            pressed=Path(folder),
            count=num_contacts,
            weights=weights,
            layout=layout_of(weights) if on_contacts else EVEN,
        )
        for subject in on_contacts:
            _read_contacts(bench, source, subject, jobs)
    seeds = range(settings.first_seed, settings.first_seed + episodes)
    policies = [name for name in POLICY_SUBJECTS if name in subjects]
    for subject in [ORACLE, *policies] if policies else []:
        _run_episodes(bench, config, subject, jobs, seeds)
    if FIXED_FORCE in subjects:
        _sweep_fixed_force(bench, config, seeds)
    print_tables(console, store)
    if settings.plot is not None:
        draw(store, settings.plot)


@dataclass(frozen=True, slots=True, kw_only=True)
class _Bench:
    """Runs what has no result yet."""

    store: Store
    console: Console
    workers: int | None

    def missing(self, subject: str, jobs: list[_Job]) -> list[_Job]:
        """The jobs of a subject without a result; each result once."""
        named: dict[str, _Job] = {}
        for job in jobs:
            named.setdefault(job_name(subject, *job), job)
        return [job for name, job in named.items() if name not in self.store.results]

    def each(self, function: Callable[[int], T], count: int) -> Iterator[T]:
        """Results of a function for each number below ``count``, from all processes."""
        if count:
            yield from each_result(
                self.console, "cells", function, range(count), workers=self.workers
            )

    def add(self, subject: str, job: _Job, result: CellResult, left: int) -> None:
        """Keep a result, and say how long ``left`` more of its kind take."""
        self.store.add(job_name(subject, *job), result)
        nuisance, condition = job
        level = next(k for k, each in NUISANCES[nuisance].items() if each == condition)
        values = ", ".join(f"{name} {value:.1f}" for name, value in result.values.items())
        self.console.print(
            f"{subject}, {nuisance} {level:g}: {values} (n {result.n}, {result.seconds:.2f} s "
            f"each; {left} more cells take {left * result.n * result.seconds / 60:.0f} min)"
        )


def _read_contacts(bench: _Bench, source: ContactSource, subject: str, jobs: list[_Job]) -> None:
    """Read the contacts of every condition that has no result yet."""
    missing = bench.missing(subject, jobs)
    source.press(missing)
    blocks = range(0, source.count, BLOCK)
    results = bench.each(
        partial(_read_block, source, subject, missing, len(blocks)), len(missing) * len(blocks)
    )
    for number, (nuisance, condition) in enumerate(missing, start=1):
        began = time.monotonic()
        parts = list(islice(results, len(blocks)))
        sampled = source.sampled(nuisance, condition)
        states = sampled.batch.states
        if not states:
            raise TouchError(
                f"no contact of {source.data} can be read under {nuisance}: a contact turns only "
                "where the gel at the pad's border is at rest; take a larger data set"
            )
        predictions = Predictions(
            torch.from_numpy(np.concatenate([classes for classes, _ in parts])),
            np.concatenate([numbers for _, numbers in parts]),
        )
        result = CellResult(
            n=len(states),
            seconds=(time.monotonic() - began) / len(states),
            values=readers.percent_right(predictions, states),
            limits=readers.limits(sampled),
        )
        bench.add(subject, (nuisance, condition), result, len(missing) - number)
        if condition in (NOMINAL, Condition(turn_deg=0)):
            constant = CellResult(
                n=len(states), seconds=0.0, values=readers.constant_answer(states)
            )
            bench.store.add(job_name(CONSTANT, nuisance, condition), constant)


def _read_block(
    source: ContactSource, subject: str, jobs: list[_Job], num_blocks: int, number: int
) -> tuple[NDArray[np.int64], NDArray[np.floating]]:
    """Classes and numbers that a subject reads in one block of contacts under one condition."""
    nuisance, condition = jobs[number // num_blocks]
    first = number % num_blocks * BLOCK
    sampled = source.sampled(nuisance, condition, slice(first, first + BLOCK))
    if not sampled.batch.states:  # there are fewer, or none of these can be turned
        return np.zeros((0, len(CLASSES)), np.int64), np.zeros((0, len(NUMBERS)))
    predictions = readers.read(readers.READERS[subject](source.weights), sampled)
    return predictions.classes.numpy(), predictions.numbers


def _run_episodes(
    bench: _Bench, config: RunConfig, subject: str, jobs: list[_Job], seeds: range
) -> None:
    """Run the episodes of every condition that has no result yet."""
    missing = bench.missing(subject, jobs)
    conditions = [condition.in_the_loop for _, condition in missing]
    results = bench.each(
        partial(_verified, config, conditions, subject, seeds), len(missing) * len(seeds)
    )
    for number, (nuisance, condition) in enumerate(missing, start=1):
        began = time.monotonic()
        verified = list(islice(results, len(seeds)))
        result = CellResult(
            n=len(seeds),
            seconds=(time.monotonic() - began) / len(seeds),
            values={VERIFIED: 100 * sum(verified) / len(seeds)},
            verified="".join("01"[each] for each in verified),
        )
        bench.add(subject, (nuisance, condition), result, len(missing) - number)


def _verified(
    config: RunConfig, conditions: list[Condition], policy: str, seeds: range, number: int
) -> bool:
    condition, seed = conditions[number // len(seeds)], seeds[number % len(seeds)]
    return run_episode_under(config, condition, policy, None, seed).verified


def _sweep_fixed_force(bench: _Bench, config: RunConfig, seeds: range) -> None:
    """The best of ``swept_forces_n`` under nominal conditions."""
    if not bench.missing(FIXED_FORCE, [("order", NOMINAL)]):
        return
    began, count = time.monotonic(), SWEEP
    results = bench.each(partial(_verified_by_force, config, seeds), count * len(seeds))
    rates = [list(islice(results, len(seeds))) for _ in range(count)]
    best = max(rates, key=sum)
    result = CellResult(
        n=len(seeds),
        seconds=(time.monotonic() - began) / len(seeds) / count,
        values={VERIFIED: 100 * sum(best) / len(seeds)},
        verified="".join("01"[each] for each in best),
    )
    bench.add(FIXED_FORCE, ("order", NOMINAL), result, 0)


def _verified_by_force(config: RunConfig, seeds: range, number: int) -> bool:
    force_n, seed = swept_forces_n(config)[number // len(seeds)], seeds[number % len(seeds)]
    return run_episode_under(config, NOMINAL, FIXED_FORCE, force_n, seed).verified


def _names(text: str, known: tuple[str, ...]) -> list[str]:
    """Names in a list that is separated by commas.

    Raises:
        UsageError: One is unknown.
    """
    names = names_in(text)
    if unknown := [name for name in names if name not in known]:
        raise UsageError(f"unknown {', '.join(unknown)}; known: {', '.join(known)}")
    return names
