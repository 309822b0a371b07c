"""``tacgrasp data inspect|stats|verify|gallery|sheet``: look into data sets of contacts."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import tyro

from tacgrasp.base.errors import UsageError
from tacgrasp.cli.data_import import import_touches
from tacgrasp.cli.flags import parse, writable

SHOWN_PROBLEMS = 50


@dataclass(frozen=True)
class Inspect:
    """Show one contact: labels, numbers, captions, questions; with --out also its picture.

    Attributes:
        folder: Data set.
        contact: Its number, from 0.
        out: PNG to write.
    """

    folder: tyro.conf.Positional[Path]
    contact: int = 0
    out: Path | None = None


def inspect(argv: Sequence[str]) -> int:
    """Show one contact: image, heights, numbers, captions and prompts."""
    flags = parse(Inspect, argv, prog="tacgrasp data inspect")
    from cltp.data.dataset import ContactDataset
    from tacgrasp.console import console
    from tacgrasp.datasets.contact_sheet import contact_card
    from tacgrasp.datasets.inspect import lines_of

    if flags.out is not None and flags.out.suffix.lower() != ".png":
        raise UsageError(f"--out expects a file ending in .png, got {flags.out}")
    data = ContactDataset(flags.folder, partial=True)
    if not 0 <= flags.contact < len(data):
        raise UsageError(
            f"--contact expects 0 to {len(data) - 1} for {flags.folder}, got {flags.contact}"
        )
    to = console()
    for line in lines_of(data, flags.contact):
        to.print(line)
    if flags.out is not None:
        _saved(lambda path: contact_card(data, flags.contact).save(path), flags.out)
        to.print(f"written   {flags.out}")
    return 0


@dataclass(frozen=True)
class Stats:
    """Count classes, splits and objects, and show how the numbers are spread.

    Attributes:
        folder: Data set.
        json: File for the same figures.
    """

    folder: tyro.conf.Positional[Path]
    json: Path | None = None


def stats(argv: Sequence[str]) -> int:
    """Count classes, splits, objects; quantiles of numbers, doubtful share, checksum."""
    flags = parse(Stats, argv, prog="tacgrasp data stats")
    from tacgrasp.console import console
    from tacgrasp.datasets.stats import as_json, show
    from tacgrasp.datasets.stats import stats as count

    found = count(flags.folder)
    path = writable(flags.json)
    show(found, console())
    if path is not None:
        path.write_text(json.dumps(as_json(found), indent=2) + "\n", encoding="utf-8")
    return 0


@dataclass(frozen=True)
class Verify:
    """Check every byte, label, cloud and text of a data set; exits with 1 if anything is wrong.

    Attributes:
        folder: Data set.
    """

    folder: tyro.conf.Positional[Path]


def verify(argv: Sequence[str]) -> int:
    """Check every byte, label, cloud, text and split; exits with 1 if anything is wrong."""
    flags = parse(Verify, argv, prog="tacgrasp data verify")
    from cltp.data.dataset import ContactDataset
    from cltp.errors import TouchError
    from tacgrasp.console import console
    from tacgrasp.datasets.verify import bar, problems

    to, wrong = console(), 0
    if not (flags.folder / "dataset.json").is_file():
        ContactDataset(flags.folder, partial=True)  # says that it is none
    checked = 0
    try:
        with bar() as progress:
            task = progress.add_task(
                "contacts", total=len(ContactDataset(flags.folder, partial=True))
            )
            for checked, problem in problems(flags.folder):
                progress.update(task, completed=checked)
                if problem is not None:
                    wrong += 1
                    if wrong <= SHOWN_PROBLEMS:
                        to.print(str(problem))
    except TouchError as error:
        to.print(str(error))
        wrong += 1
    if wrong > SHOWN_PROBLEMS:
        to.print(f"... and {wrong - SHOWN_PROBLEMS} more")
    verdict = "nothing wrong" if not wrong else f"{wrong} problem{'s' if wrong > 1 else ''}"
    to.print(f"{flags.folder}: {checked:,} contacts checked, {verdict}")
    return 1 if wrong else 0


@dataclass(frozen=True)
class Gallery:
    """Write contacts as one HTML page that needs nothing else: pictures, captions, class counts.

    Attributes:
        folder: Data set.
        out: HTML file.
        contacts: How many are drawn; all if there are fewer.
        seed: Draws them.
    """

    folder: tyro.conf.Positional[Path]
    out: Path = Path("gallery.html")
    contacts: int = 200
    seed: int = 0


def gallery(argv: Sequence[str]) -> int:
    """Write drawn contacts with pictures, captions and class counts as one HTML page."""
    flags = parse(Gallery, argv, prog="tacgrasp data gallery")
    from cltp.data.dataset import ContactDataset
    from tacgrasp.console import console
    from tacgrasp.datasets.contact_sheet import drawn
    from tacgrasp.datasets.gallery import write_gallery

    _check_draw(flags.contacts, flags.seed)
    data = ContactDataset(flags.folder, partial=True)
    indices = drawn(len(data), flags.contacts, flags.seed)
    _saved(lambda path: write_gallery(flags.folder, indices, path, seed=flags.seed), flags.out)
    size = flags.out.stat().st_size / 1e6
    console().print(f"written   {flags.out}: {len(indices)} contacts, {size:.1f} MB")
    return 0


@dataclass(frozen=True)
class Sheet:
    """Write contacts with their captions as pages in PNG, to be read one by one.

    Attributes:
        folder: Data set.
        out: Folder for sheet-01.png and on.
        contacts: How many are drawn; all if there are fewer.
        seed: Draws them; the same as of ``data gallery``.
    """

    folder: tyro.conf.Positional[Path]
    out: Path = Path("sheets")
    contacts: int = 50
    seed: int = 0


def sheet(argv: Sequence[str]) -> int:
    """Write drawn contacts with their captions as pages in PNG."""
    flags = parse(Sheet, argv, prog="tacgrasp data sheet")
    from cltp.data.dataset import ContactDataset
    from tacgrasp.console import console
    from tacgrasp.datasets.contact_sheet import drawn, write_pages

    _check_draw(flags.contacts, flags.seed)
    data = ContactDataset(flags.folder, partial=True)
    indices = [int(index) for index in drawn(len(data), flags.contacts, flags.seed)]
    try:
        written = write_pages(data, indices, flags.out)
    except OSError as error:
        raise UsageError(f"--out {flags.out} can't be written: {error.strerror}") from None
    console().print(f"written   {len(written)} pages in {flags.out}")
    return 0


def _check_draw(contacts: int, seed: int) -> None:
    if contacts < 1 or seed < 0:
        raise UsageError(
            f"expected at least 1 contact and a seed from 0, got {contacts} contacts, seed {seed}"
        )


def _saved(write: Callable[[Path], object], path: Path) -> None:
    """Write beside and rename, so that a file is whole or not there."""
    beside = path.with_name(f".{path.stem}.part{path.suffix}")
    try:
        write(beside)
        beside.replace(path)
    except OSError as error:
        raise UsageError(f"--out {path} can't be written: {error.strerror or error}") from None
    finally:
        beside.unlink(missing_ok=True)


TOOLS: dict[str, Callable[[Sequence[str]], int]] = {
    "inspect": inspect,
    "stats": stats,
    "verify": verify,
    "gallery": gallery,
    "sheet": sheet,
    "import": import_touches,
}
"""Sub-commands of ``tacgrasp data``, registered in ``tacgrasp.cli.data``."""
