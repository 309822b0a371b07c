"""``tacgrasp eval zero-shot | probe | retrieval | report``: encoders compared with the paper's.

Not here: whole rows of its tables (``tacgrasp.cli.eval_row``).
"""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

from tacgrasp.base.errors import UsageError
from tacgrasp.base.folders import check_folder
from tacgrasp.base.result_file import check_ending
from tacgrasp.cli.eval_ablate import main as ablate
from tacgrasp.cli.eval_captions import main as captions
from tacgrasp.cli.eval_instructions import main as instructions
from tacgrasp.cli.eval_intervals import main as intervals
from tacgrasp.cli.eval_own import main as own
from tacgrasp.cli.eval_questions import main as questions
from tacgrasp.cli.eval_row import RESULTS_DIR
from tacgrasp.cli.eval_row import main as row
from tacgrasp.cli.flags import contacts_in, parse, writable

if TYPE_CHECKING:
    from tacgrasp.pretraining.checkpoints import TrainedMethod
    from tacgrasp.pretraining.evaluation_run import EvaluationRun
    from tacgrasp.pretraining.real_touches import RealTouches
    from tacgrasp.pretraining.report.store import Result

METHODS_DIR = Path("runs/methods")
PAGES_DIR = Path("runs/report")


@dataclass(frozen=True)
class EvaluationFlags:
    """Flags of every evaluation of encoders.

    Attributes:
        weights: Folder of all methods (tacgrasp train), with clip in it; by default runs/methods,
            for zero-shot of real touches the shipped weights.
        data: Folder of the contacts that the methods were trained on.
        results: Folder of results.
        methods: Names of methods, separated by commas; all that were trained when empty.
        splits: Names of evaluation splits, separated by commas: contact, object, physics, ...; all
            that the data has contacts for when empty.
        limit: Largest number of contacts of each evaluation split; all when not given.
        seed: Random seed of the sensor noise and of the probes.
        json: JSON file for the figures.
        threads: Number of threads of torch; by default one for each core.
    """

    weights: Path | None = None
    data: Path = Path("runs/tcl3d")
    results: Path = Path("runs/results")
    methods: str = ""
    splits: str = ""
    limit: int | None = None
    seed: int = 0
    json: Path | None = None
    threads: int | None = None


@dataclass(frozen=True)
class RealTouchFlags(EvaluationFlags):
    """Flags of an evaluation on real touches.

    Attributes:
        real: Folder of real frames, height maps or clouds.
        labels: CSV file with the columns file, shape, texture, depth, position, area; cells are
            empty where unknown.
        sensor: Name of the sensor that recorded the touches.
        background: Frame of the untouched unit; background.png in the folder when not given.
        out: CSV file for the predictions, a row for each touch.
    """

    real: Path | None = None
    labels: Path | None = None
    sensor: str = "gelsight_mini"
    background: Path | None = None
    out: Path = Path("predictions.csv")


@dataclass(frozen=True)
class ZeroShotFlags(RealTouchFlags):
    """Classify contacts by the nearest prompt (table 1), of a data set or of real touches.

    Attributes:
        ensemble: Use several prompts a class for real touches, instead of the paper's one.
    """

    ensemble: bool = False


@dataclass(frozen=True)
class ProbeFlags(RealTouchFlags):
    """Train MLPs on frozen encoders and measure them (table 2, appendix A), and CLTP's numbers.

    With --real they are measured on real touches.

    Attributes:
        seeds: Number of random seeds, counted from --seed.
        views: How often each training contact is encoded, with other noise each time.
        checkpoint: Directory of a CLIP or CLIP vision model in transformers' format, evaluated as
            --methods tvl or unitouch.
    """

    seeds: int = 1
    views: int = 2
    checkpoint: Path | None = None


@dataclass(frozen=True)
class RetrievalFlags(EvaluationFlags):
    """Find contacts by text and texts by contact; without either, measure all against all.

    Attributes:
        text: Text whose nearest contacts are shown.
        contact: Number of the contact whose nearest texts are shown.
        count: Number of matches to show.
        page: HTML file for the matches, with pictures.
    """

    text: str | None = None
    contact: int | None = None
    count: int = 5
    page: Path | None = None


@dataclass(frozen=True)
class ReportFlags:
    """Write one HTML and one Markdown page from stored results; trains and measures nothing.

    Attributes:
        results: Folder of rows, or of single results; docs/results when not given.
        weights: Folder of all methods, whose training curves are shown too.
        out: Folder for the pages; that of the results, or runs/report of docs/results, when not
            given.
        json: JSON file for the figures.
    """

    results: Path | None = None
    weights: Path | None = None
    out: Path | None = None
    json: Path | None = None


def zero_shot(argv: Sequence[str]) -> None:
    """Classify by the nearest prompt (table 1); --real DIR --labels CSV for real touches."""
    flags = parse(ZeroShotFlags, argv, prog="tacgrasp eval zero-shot")
    json_path = _checked(flags)
    from cltp.evaluation.zero_shot import PROMPTINGS
    from tacgrasp.pretraining import evaluate
    from tacgrasp.pretraining.geometric_baseline import geometric_baseline

    run, real = _evaluation_run(flags, "zero-shot", argv), _real_touches(flags)
    promptings = PROMPTINGS if real is None else PROMPTINGS[flags.ensemble :][:1]
    methods = _names(flags.methods)
    results = evaluate.zero_shot(
        run, methods, real=real, promptings=promptings, predictions=flags.out
    )
    table = evaluate.TABLES[promptings[0]]
    splits = run.evaluation_splits() if real is None else [real]
    results += geometric_baseline(run, table, splits, results[0].data if real else None)
    _print(results, json_path, flags)


def probe(argv: Sequence[str]) -> None:
    """MLPs on frozen encoders (table 2, appendix A), and CLTP's numbers with their intervals."""
    flags = parse(ProbeFlags, argv, prog="tacgrasp eval probe")
    json_path = _checked(flags)
    if min(flags.seeds, flags.views) < 1:
        raise UsageError("--seeds and --views must be at least 1")
    from tacgrasp.pretraining import evaluate
    from tacgrasp.pretraining.geometric_baseline import geometric_baseline, heights_alone

    real = _real_touches(flags)
    results: list[Result] = []
    for number in range(flags.seeds):
        run = _evaluation_run(replace(flags, seed=flags.seed + number), "probe", argv)
        results += evaluate.probe(
            run, _names(flags.methods), views=flags.views, real=real, predictions=flags.out
        )
        splits = run.evaluation_splits() if real is None else [real]
        results += geometric_baseline(run, "probe", splits)
        results += [] if real else heights_alone(run, flags.views)
    _print(results, json_path, flags)


def retrieval(argv: Sequence[str]) -> None:
    """Contacts by text (--text), texts by contact (--contact N), or all against all."""
    flags = parse(RetrievalFlags, argv, prog="tacgrasp eval retrieval")
    json_path = _checked(flags)
    from tacgrasp.console import make_table_console
    from tacgrasp.pretraining import evaluate
    from tacgrasp.pretraining.report.print_results import print_results
    from tacgrasp.pretraining.retrieval_demo import find_matches, print_matches, write_page

    run = _evaluation_run(flags, "retrieval", argv)
    methods = _names(flags.methods)
    if flags.text is None and flags.contact is None:
        print_results(evaluate.retrieval(run, methods), json_path)
        return
    method = methods[0] if methods else "cltp"
    matches = find_matches(
        run, text=flags.text, contact=flags.contact, count=flags.count, method=method
    )
    console = make_table_console()
    print_matches(matches, console)
    if flags.page is not None:
        write_page(flags.data, matches, flags.page)
        console.print(str(flags.page), markup=False, highlight=False, soft_wrap=True)


def report(argv: Sequence[str]) -> None:
    """One HTML and one Markdown page of all tables beside the paper's, from the rows' files."""
    flags = parse(ReportFlags, argv, prog="tacgrasp eval report")
    json_path = writable(flags.json)
    from rich.console import Console

    from tacgrasp.console import working
    from tacgrasp.pretraining.report.print_results import write_figures
    from tacgrasp.pretraining.report.report import report
    from tacgrasp.pretraining.report.row_file import load_rows
    from tacgrasp.pretraining.report.row_status import row_figures
    from tacgrasp.pretraining.report.store import load_results

    folder, out = flags.results or RESULTS_DIR, flags.out or flags.results or PAGES_DIR
    check_folder(out, "--out")
    if flags.weights is not None and not flags.weights.is_dir():
        raise UsageError(f"--weights {flags.weights} is no folder; name that of all methods")
    with working("drawing the pages"):
        pages = report(folder, out, weights=flags.weights)
    for page in pages:
        Console(soft_wrap=True).print(str(page), markup=False, highlight=False)
    rows = load_rows(folder)
    results = [*(result for row in rows for result in row.results()), *load_results(folder)]
    write_figures(results, json_path, row_figures(rows))


COMMANDS: dict[str, Callable[[Sequence[str]], None]] = {
    "ablate": ablate,
    "captions": captions,
    "instructions": instructions,
    "intervals": intervals,
    "own": own,
    "questions": questions,
    "zero-shot": zero_shot,
    "probe": probe,
    "retrieval": retrieval,
    "row": row,
    "report": report,
}


def _checked(flags: EvaluationFlags) -> Path | None:
    if flags.limit is not None and flags.limit < 1:
        raise UsageError(f"--limit must be at least 1, got {flags.limit}")
    if flags.threads is not None and flags.threads < 1:
        raise UsageError(f"--threads must be at least 1, got {flags.threads}")
    if not isinstance(flags, RealTouchFlags) or flags.real is None:
        contacts_in(flags.data, command="tacgrasp data generate")
    if isinstance(flags, RealTouchFlags):
        _check_predictions(flags)
    if isinstance(flags, RetrievalFlags) and flags.page is not None:
        check_ending(flags.page, ".html")
    return writable(flags.json)


def _check_predictions(flags: RealTouchFlags) -> None:
    """Check where predictions go, which replace earlier ones and nothing else."""
    from cltp.tactile.states import CLASSES

    check_ending(flags.out, ".csv")
    if flags.real is None or not flags.out.is_file() or not flags.out.stat().st_size:
        return
    with flags.out.open(encoding="utf-8", errors="replace") as file:
        header = file.readline().rstrip().split(",")
    columns = ["file", *CLASSES]
    if header[: len(columns)] != columns or not any("_" in name for name in header):
        raise UsageError(
            f"--out {flags.out} exists and holds no predictions, so it is not replaced; name "
            "another file"
        )


def _print(results: Sequence[Result], json_path: Path | None, flags: RealTouchFlags) -> None:
    from tacgrasp.pretraining.report.print_results import print_real_results, print_results

    print_results(results, json_path)
    if flags.real is not None:
        print_real_results(results, flags.out)


def _names(text: str) -> list[str]:
    return [name.strip().replace("-", "_") for name in text.split(",") if name.strip()]


def _evaluation_run(flags: EvaluationFlags, command: str, argv: Sequence[str]) -> EvaluationRun:
    import torch
    from transformers.utils.logging import disable_progress_bar

    from cltp.train.progress import Bar
    from tacgrasp.policy_factory import default_weights
    from tacgrasp.pretraining.evaluation_run import EvaluationRun

    takes_shipped = isinstance(flags, ZeroShotFlags) and flags.real is not None
    disable_progress_bar()  # of reading weights, over in milliseconds
    torch.set_num_threads(flags.threads or os.cpu_count() or 1)
    return EvaluationRun(
        weights=flags.weights or (default_weights() if takes_shipped else METHODS_DIR),
        data=flags.data,
        results=flags.results,
        splits=tuple(_names(flags.splits)),
        limit=flags.limit,
        encoders=_given_encoders(flags),
        seed=flags.seed,
        command=" ".join(["tacgrasp eval", command, *argv]),
        report=Bar(line_s=10.0),
    )


def _given_encoders(flags: EvaluationFlags) -> dict[str, TrainedMethod] | None:
    """The encoder of --checkpoint; None where none is named."""
    if not isinstance(flags, ProbeFlags) or flags.checkpoint is None:
        return None
    from tacgrasp.pretraining.checkpoints import external_checkpoint

    names = _names(flags.methods)
    if len(names) != 1:
        raise UsageError("--checkpoint needs one method: --methods tvl or unitouch")
    return {names[0]: external_checkpoint(names[0], flags.checkpoint)}


def _real_touches(flags: RealTouchFlags) -> RealTouches | None:
    """The real touches; None where the contacts of the data set are evaluated."""
    if flags.real is None and flags.labels is None:
        return None
    from cltp.tactile.sensors import sensor_named
    from tacgrasp.pretraining.real_touches import read_touches

    if flags.real is None or flags.labels is None:
        raise UsageError("--real and --labels belong together: a folder, and what is in it")
    return read_touches(flags.real, flags.labels, sensor_named(flags.sensor), flags.background)
