"""``tacgrasp eval zero-shot | probe | retrieval | report``: encoders beside the paper's."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from tacgrasp.cli.flags import parse, writable
from tacgrasp.errors import UsageError

if TYPE_CHECKING:
    from tacgrasp.results import Result
    from tacgrasp.trying import Place


@dataclass(frozen=True)
class Common:
    """Where things lie.

    Attributes:
        weights: Folder of all methods (tacgrasp train), with clip in it.
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

    weights: Path = Path("runs/methods")
    data: Path = Path("runs/tcl3d")
    results: Path = Path("runs/results")
    methods: str = ""
    trials: str = ""
    limit: int | None = None
    seed: int = 0
    json: Path | None = None
    threads: int | None = None


@dataclass(frozen=True)
class ZeroShot(Common):
    """Name contacts by the nearest prompt (table 1), of a data set or of real touches.

    Attributes:
        real: Folder of real frames, height maps or clouds.
        labels: CSV with the columns file, shape, texture, depth, position, area; empty where
            unknown.
        sensor: That made them.
        background: Frame of the unit untouched; background.png in the folder when not given.
        out: CSV with one row a prediction.
        ensemble: Several prompts a class for real touches, instead of the paper's one.
    """

    real: Path | None = None
    labels: Path | None = None
    sensor: str = "gelsight_mini"
    background: Path | None = None
    out: Path = Path("predictions.csv")
    ensemble: bool = False


@dataclass(frozen=True)
class Probe(Common):
    """Train MLPs on frozen encoders and measure them (table 2, appendix A), and CLTP's numbers.

    Attributes:
        seeds: So many, counted from --seed.
        views: How often each training contact is seen.
    """

    seeds: int = 1
    views: int = 2


@dataclass(frozen=True)
class Retrieval(Common):
    """Find contacts by text and texts by contact; without either, measure all against all.

    Attributes:
        text: Show the contacts most similar to it.
        contact: Show the texts most similar to the contact of this number.
        count: How many to show.
    """

    text: str | None = None
    contact: int | None = None
    count: int = 5


@dataclass(frozen=True)
class Report:
    """Write one HTML and one Markdown page from stored results; trains and measures nothing.

    Attributes:
        results: Folder of results.
        out: Folder for the pages; that of the results when not given.
        json: File for the figures.
    """

    results: Path = Path("runs/results")
    out: Path | None = None
    json: Path | None = None


def zero_shot(argv: Sequence[str]) -> None:
    """Name contacts by the nearest prompt (table 1); --real DIR --labels CSV for real touches."""
    flags = parse(ZeroShot, argv, prog="tacgrasp eval zero-shot")
    json_path = _checked(flags)
    if (flags.real is None) != (flags.labels is None):
        raise UsageError("--real and --labels belong together: a folder, and what is in it")
    from tacgrasp import trying

    place = _place(flags, "zero-shot", argv)
    if flags.real is not None and flags.labels is not None:
        found = [_real(flags, place, flags.real, flags.labels)]
    else:
        found = trying.zero_shot(place, _names(flags.methods))
    _show(found, json_path)


def probe(argv: Sequence[str]) -> None:
    """MLPs on frozen encoders (table 2, appendix A), and CLTP's numbers with their intervals."""
    flags = parse(Probe, argv, prog="tacgrasp eval probe")
    json_path = _checked(flags)
    if min(flags.seeds, flags.views) < 1:
        raise UsageError("--seeds and --views must be at least 1")
    import dataclasses

    from tacgrasp import trying

    found: list[Result] = []
    for number in range(flags.seeds):
        seeded = dataclasses.replace(flags, seed=flags.seed + number)
        place = _place(seeded, "probe", argv)
        found += trying.probe(place, _names(flags.methods), views=flags.views)
    _show(found, json_path)


def retrieval(argv: Sequence[str]) -> None:
    """Contacts by text (--text), texts by contact (--contact N), or all against all."""
    flags = parse(Retrieval, argv, prog="tacgrasp eval retrieval")
    json_path = _checked(flags)
    from rich.console import Console

    from tacgrasp import trying

    place = _place(flags, "retrieval", argv)
    if flags.text is None and flags.contact is None:
        _show(trying.retrieval(place, _names(flags.methods)), json_path)
        return
    method = flags.methods or "cltp"
    to = Console(soft_wrap=True)
    for found in trying.find(
        place, text=flags.text, contact=flags.contact, count=flags.count, method=method
    ):
        near = "     " if found.cosine != found.cosine else f"{found.cosine:.3f}"
        to.print(f"{near}  {found.what}", markup=False, highlight=False)


def report(argv: Sequence[str]) -> None:
    """One HTML and one Markdown page of all tables beside the paper's, from stored results."""
    flags = parse(Report, argv, prog="tacgrasp eval report")
    json_path = writable(flags.json)
    from tacgrasp import pretraining_report
    from tacgrasp.results import load

    pages = pretraining_report.report(flags.results, flags.out or flags.results)
    from rich.console import Console

    for page in pages:
        Console(soft_wrap=True).print(str(page), markup=False, highlight=False)
    _write(load(flags.results), json_path)


COMMANDS: dict[str, Callable[[Sequence[str]], None]] = {
    "zero-shot": zero_shot,
    "probe": probe,
    "retrieval": retrieval,
    "report": report,
}


def _checked(flags: Common) -> Path | None:
    if (flags.limit is not None and flags.limit < 1) or flags.seed < 0:
        raise UsageError("--limit must be at least 1, --seed at least 0")
    if flags.threads is not None and flags.threads < 1:
        raise UsageError(f"--threads must be at least 1, got {flags.threads}")
    return writable(flags.json)


def _names(given: str) -> list[str]:
    return [name.strip().replace("-", "_") for name in given.split(",") if name.strip()]


def _place(flags: Common, command: str, argv: Sequence[str]) -> Place:
    import os

    import torch
    from transformers.utils.logging import disable_progress_bar

    from cltp.train.progress import Bar
    from tacgrasp.trying import Place

    disable_progress_bar()  # of reading weights, over in milliseconds
    torch.set_num_threads(flags.threads or os.cpu_count() or 1)
    return Place(
        weights=flags.weights,
        data=flags.data,
        results=flags.results,
        trials=tuple(_names(flags.trials)),
        limit=flags.limit,
        seed=flags.seed,
        command=" ".join(["tacgrasp eval", command, *argv]),
        report=Bar(line_s=10.0),
    )


def _real(flags: ZeroShot, place: Place, folder: Path, labels: Path) -> Result:
    from cltp.frozen import load_frozen
    from cltp.sensors import sensor_named
    from cltp.weights import load_clip
    from tacgrasp import real_touches
    from tacgrasp.pretraining import trained
    from tacgrasp.results import Result, percent, save

    rows = real_touches.read_labels(folder, labels)
    method = (_names(flags.methods) or ["cltp"])[0]
    how = trained(method, flags.weights, place.checksum)
    background = flags.background or folder / real_touches.BACKGROUND
    found = real_touches.predict(
        load_frozen(how.folder / "encoder"),
        load_clip(flags.weights / "clip"),
        rows,
        sensor_named(flags.sensor),
        background=background if background.exists() else None,
        prompting="ensemble" if flags.ensemble else "single",
    )
    real_touches.write_predictions(flags.out, found)
    result = Result(
        table="zero_shot_ensemble" if flags.ensemble else "zero_shot",
        method=method,
        variant=how.variant,
        trial="real",
        seed=flags.seed,
        data=place.checksum,
        budget=how.budget,
        command=place.command,
        contacts=len(rows),
        values=percent(found.judged.right),
        confusion={slot: counts.tolist() for slot, counts in found.judged.confusion.items()},
    )
    save(flags.results, result)
    return result


def _show(found: Sequence[Result], json_path: Path | None) -> None:
    from rich.console import Console
    from rich.table import Table

    from tacgrasp.results import METHODS, grouped, mean

    to = Console()
    to = to if to.is_terminal else Console(width=160)
    by_table: dict[tuple[str, str], list[tuple[str, list[Result]]]] = {}
    for (table, method, variant, trial), rows in grouped(found).items():
        name = METHODS[method] + (f" ({variant})" if method != "ceiling" else "")
        by_table.setdefault((table, trial), []).append((name, rows))
    for (table, trial), lines in by_table.items():
        count = lines[0][1][0].contacts
        shown = Table(title=f"{table.replace('_', ' ')}, {trial}: {count} contacts")
        shown.add_column("", justify="left")
        columns = list(lines[0][1][0].values)
        for column in columns:
            shown.add_column(column.replace("_", " "), justify="right")
        for name, rows in lines:
            values = (mean([row.values.get(column) for row in rows]) for column in columns)
            shown.add_row(name, *("-" if v is None else f"{v:.3g}" for v in values))
        to.print(shown)
    _write(found, json_path)


def _write(found: Sequence[Result], json_path: Path | None) -> None:
    if json_path is None:
        return
    import json

    from tacgrasp.results import nested

    json_path.write_text(json.dumps(nested(found), indent=1) + "\n", encoding="utf-8")
