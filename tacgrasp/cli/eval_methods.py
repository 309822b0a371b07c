"""``tacgrasp eval zero-shot | probe | retrieval | report``: encoders beside the paper's."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from tacgrasp.base.errors import UsageError
from tacgrasp.cli.flags import parse, writable

if TYPE_CHECKING:
    from tacgrasp.pretraining.evaluate_real import RealSet
    from tacgrasp.pretraining.evaluation_run import EvaluationRun
    from tacgrasp.pretraining.report.store import Result

METHODS_DIR = Path("runs/methods")


@dataclass(frozen=True)
class CommonFlags:
    """Where things lie.

    Attributes:
        weights: Folder of all methods (tacgrasp train), with clip in it; runs/methods when not
            given, but for zero-shot of real touches the weights that come along.
        data: Folder of contacts that they were trained on.
        results: Folder of results.
        methods: Names, separated by commas; all that were trained when empty.
        trials: Names, separated by commas: contact, object, physics, ...; all of the data when
            empty.
        limit: Contacts of each trial; all when not given.
        seed: Of noise and probes.
        json: File for the figures.
        threads: Of torch; by default one for each core.
    """

    weights: Path | None = None
    data: Path = Path("runs/tcl3d")
    results: Path = Path("runs/results")
    methods: str = ""
    trials: str = ""
    limit: int | None = None
    seed: int = 0
    json: Path | None = None
    threads: int | None = None


@dataclass(frozen=True)
class RealFlags(CommonFlags):
    """Where real touches lie.

    Attributes:
        real: Folder of real frames, height maps or clouds.
        labels: CSV with the columns file, shape, texture, depth, position, area; empty where
            unknown.
        sensor: That made them.
        background: Frame of the unit untouched; background.png in the folder when not given.
        out: CSV with one row a prediction.
    """

    real: Path | None = None
    labels: Path | None = None
    sensor: str = "gelsight_mini"
    background: Path | None = None
    out: Path = Path("predictions.csv")


@dataclass(frozen=True)
class ZeroShotFlags(RealFlags):
    """Name contacts by the nearest prompt (table 1), of a data set or of real touches.

    Attributes:
        ensemble: Several prompts a class for real touches, instead of the paper's one.
    """

    ensemble: bool = False


@dataclass(frozen=True)
class ProbeFlags(RealFlags):
    """Train MLPs on frozen encoders and measure them (table 2, appendix A), and CLTP's numbers.

    With --real they are tried on real touches.

    Attributes:
        seeds: So many, counted from --seed.
        views: How often each training contact is seen.
        checkpoint: Directory of a CLIP or CLIP vision model in transformers' format, tried as
            --methods tvl or unitouch.
    """

    seeds: int = 1
    views: int = 2
    checkpoint: Path | None = None


@dataclass(frozen=True)
class RetrievalFlags(CommonFlags):
    """Find contacts by text and texts by contact; without either, measure all against all.

    Attributes:
        text: Show the contacts most similar to it.
        contact: Show the texts most similar to the contact of this number.
        count: How many to show.
        page: HTML file for what was found, with pictures.
    """

    text: str | None = None
    contact: int | None = None
    count: int = 5
    page: Path | None = None


@dataclass(frozen=True)
class ReportFlags:
    """Write one HTML and one Markdown page from stored results; trains and measures nothing.

    Attributes:
        results: Folder of results.
        weights: Folder of all methods, whose curves are shown too.
        out: Folder for the pages; that of the results when not given.
        json: File for the figures.
    """

    results: Path = Path("runs/results")
    weights: Path | None = None
    out: Path | None = None
    json: Path | None = None


def zero_shot(argv: Sequence[str]) -> None:
    """Name contacts by the nearest prompt (table 1); --real DIR --labels CSV for real touches."""
    flags = parse(ZeroShotFlags, argv, prog="tacgrasp eval zero-shot")
    json_path = _checked(flags)
    from tacgrasp.pretraining import evaluate as trying
    from tacgrasp.pretraining.report.print_results import show

    place = _place(flags, "zero-shot", argv)
    if flags.real is None and flags.labels is None:
        show(trying.zero_shot(place, _names(flags.methods)), json_path)
        return
    from tacgrasp.pretraining.evaluate_real import zero_shot_real
    from tacgrasp.pretraining.report.print_results import show_real

    prompting = "ensemble" if flags.ensemble else "single"
    found = zero_shot_real(place, _names(flags.methods), _real_set(flags), prompting=prompting)
    show(found, json_path)
    show_real(found, flags.out)


def probe(argv: Sequence[str]) -> None:
    """MLPs on frozen encoders (table 2, appendix A), and CLTP's numbers with their intervals."""
    flags = parse(ProbeFlags, argv, prog="tacgrasp eval probe")
    json_path = _checked(flags)
    if min(flags.seeds, flags.views) < 1:
        raise UsageError("--seeds and --views must be at least 1")
    import dataclasses

    from tacgrasp.pretraining import evaluate as trying
    from tacgrasp.pretraining.evaluate_real import probe_real
    from tacgrasp.pretraining.report.print_results import show, show_real

    real = _real_set(flags) if flags.real is not None or flags.labels is not None else None
    found: list[Result] = []
    for number in range(flags.seeds):
        seeded = dataclasses.replace(flags, seed=flags.seed + number)
        place = _place(seeded, "probe", argv)
        if real is None:
            found += trying.probe(place, _names(flags.methods), views=flags.views)
        else:
            found += probe_real(place, _names(flags.methods), real, views=flags.views)
    show(found, json_path)
    if real is not None:
        show_real(found, flags.out)


def retrieval(argv: Sequence[str]) -> None:
    """Contacts by text (--text), texts by contact (--contact N), or all against all."""
    flags = parse(RetrievalFlags, argv, prog="tacgrasp eval retrieval")
    json_path = _checked(flags)
    from rich.console import Console

    from tacgrasp.pretraining import evaluate as trying
    from tacgrasp.pretraining.report.print_results import show

    place = _place(flags, "retrieval", argv)
    if flags.text is None and flags.contact is None:
        show(trying.retrieval(place, _names(flags.methods)), json_path)
        return
    from tacgrasp.pretraining import retrieval_demo as retrieving

    answer = retrieving.find(
        place,
        text=flags.text,
        contact=flags.contact,
        count=flags.count,
        method=(_names(flags.methods) or ["cltp"])[0],
    )
    to = Console()
    retrieving.show_answer(answer, to if to.is_terminal else Console(width=160))
    if flags.page is not None:
        retrieving.write_page(flags.data, [answer], flags.page)
        to.print(str(flags.page), markup=False, highlight=False, soft_wrap=True)


def report(argv: Sequence[str]) -> None:
    """One HTML and one Markdown page of all tables beside the paper's, from stored results."""
    flags = parse(ReportFlags, argv, prog="tacgrasp eval report")
    json_path = writable(flags.json)
    from tacgrasp.pretraining.report import report as pretraining_report
    from tacgrasp.pretraining.report.print_results import write_figures
    from tacgrasp.pretraining.report.store import load

    pages = pretraining_report.report(
        flags.results, flags.out or flags.results, weights=flags.weights
    )
    from rich.console import Console

    for page in pages:
        Console(soft_wrap=True).print(str(page), markup=False, highlight=False)
    write_figures(load(flags.results), json_path)


COMMANDS: dict[str, Callable[[Sequence[str]], None]] = {
    "zero-shot": zero_shot,
    "probe": probe,
    "retrieval": retrieval,
    "report": report,
}


def _checked(flags: CommonFlags) -> Path | None:
    if (flags.limit is not None and flags.limit < 1) or flags.seed < 0:
        raise UsageError("--limit must be at least 1, --seed at least 0")
    if flags.threads is not None and flags.threads < 1:
        raise UsageError(f"--threads must be at least 1, got {flags.threads}")
    return writable(flags.json)


def _names(given: str) -> list[str]:
    return [name.strip().replace("-", "_") for name in given.split(",") if name.strip()]


def _place(flags: CommonFlags, command: str, argv: Sequence[str]) -> EvaluationRun:
    import os

    import torch
    from transformers.utils.logging import disable_progress_bar

    from cltp.train.progress import Bar
    from tacgrasp.policy_factory import default_weights
    from tacgrasp.pretraining.evaluation_run import EvaluationRun

    come_along = isinstance(flags, ZeroShotFlags) and flags.real is not None
    usual = default_weights() if come_along else METHODS_DIR
    disable_progress_bar()  # of reading weights, over in milliseconds
    torch.set_num_threads(flags.threads or os.cpu_count() or 1)
    return EvaluationRun(
        weights=flags.weights or usual,
        data=flags.data,
        results=flags.results,
        trials=tuple(_names(flags.trials)),
        limit=flags.limit,
        checkpoint=flags.checkpoint if isinstance(flags, ProbeFlags) else None,
        seed=flags.seed,
        command=" ".join(["tacgrasp eval", command, *argv]),
        report=Bar(line_s=10.0),
    )


def _real_set(flags: RealFlags) -> RealSet:
    from cltp.tactile.sensors import sensor_named
    from tacgrasp.pretraining.evaluate_real import RealSet
    from tacgrasp.pretraining.real_touches import BACKGROUND, read_labels

    if flags.real is None or flags.labels is None:
        raise UsageError("--real and --labels belong together: a folder, and what is in it")
    background = flags.background or flags.real / BACKGROUND
    return RealSet(
        rows=read_labels(flags.real, flags.labels),
        sensor=sensor_named(flags.sensor),
        background=background if flags.background or background.exists() else None,
        predictions=flags.out,
    )
