"""``tacgrasp data inspect|stats|verify|gallery|sheet``: look into data sets of contacts."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import tyro

from cltp.atomic_write import replacing
from tacgrasp.base.errors import UsageError
from tacgrasp.cli.flags import writable

SHOWN_PROBLEMS = 50


@dataclass(frozen=True)
class InspectFlags:
    """Show one contact: labels, numbers, captions, questions; with --out also its picture.

    Attributes:
        folder: Folder of the data set.
        contact: Number of the contact, from 0.
        out: PNG file to write its picture to.
    """

    folder: tyro.conf.Positional[Path]
    contact: int = 0
    out: Path | None = None


def inspect(flags: InspectFlags) -> None:
    """Run ``data inspect``."""
    from cltp.data.dataset import ContactDataset
    from tacgrasp.console import make_console
    from tacgrasp.datasets.contact_sheet import contact_card
    from tacgrasp.datasets.inspect import lines_of

    if flags.out is not None and flags.out.suffix.lower() != ".png":
        raise UsageError(f"--out expects a file ending in .png, got {flags.out}")
    data = ContactDataset(flags.folder, partial=True)
    if not 0 <= flags.contact < len(data):
        raise UsageError(
            f"--contact expects 0 to {len(data) - 1} for {flags.folder}, got {flags.contact}"
        )
    out = make_console()
    for line in lines_of(data, flags.contact):
        out.print(line)
    if flags.out is not None:
        _save(lambda path: contact_card(data, flags.contact).save(path), flags.out)
        out.print(f"written   {flags.out}")


@dataclass(frozen=True)
class StatsFlags:
    """Count classes, splits and objects; print quantiles of the numbers and the checksum.

    Attributes:
        folder: Folder of the data set.
        json: File to write the figures to.
    """

    folder: tyro.conf.Positional[Path]
    json: Path | None = None


def stats(flags: StatsFlags) -> None:
    """Run ``data stats``."""
    from tacgrasp.console import make_console
    from tacgrasp.datasets.stats import as_json, show
    from tacgrasp.datasets.stats import stats as count

    figures = count(flags.folder)
    path = writable(flags.json)
    show(figures, make_console())
    if path is not None:
        path.write_text(json.dumps(as_json(figures), indent=2) + "\n", encoding="utf-8")


@dataclass(frozen=True)
class VerifyFlags:
    """Check every byte, label, cloud and text of a data set; exit code 1 if anything is wrong.

    Attributes:
        folder: Folder of the data set.
    """

    folder: tyro.conf.Positional[Path]


def verify(flags: VerifyFlags) -> int:
    """Run ``data verify``."""
    from cltp.data.dataset import ContactDataset
    from cltp.errors import TouchError
    from tacgrasp.console import make_console
    from tacgrasp.datasets.verify import bar, problems

    out, num_wrong = make_console(), 0
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
                    num_wrong += 1
                    if num_wrong <= SHOWN_PROBLEMS:
                        out.print(str(problem))
    except TouchError as error:
        out.print(str(error))
        num_wrong += 1
    if num_wrong > SHOWN_PROBLEMS:
        out.print(f"... and {num_wrong - SHOWN_PROBLEMS} more")
    verdict = (
        "nothing wrong" if not num_wrong else f"{num_wrong} problem{'s' if num_wrong > 1 else ''}"
    )
    out.print(f"{flags.folder}: {checked:,} contacts checked, {verdict}")
    return 1 if num_wrong else 0


@dataclass(frozen=True)
class GalleryFlags:
    """Write contacts into one self-contained HTML page: pictures, captions, class counts.

    Attributes:
        folder: Folder of the data set.
        out: HTML file to write.
        contacts: Number of contacts to draw at random; all if the set has fewer.
        seed: Random seed of the drawing.
    """

    folder: tyro.conf.Positional[Path]
    out: Path = Path("gallery.html")
    contacts: int = 200
    seed: int = 0


def gallery(flags: GalleryFlags) -> None:
    """Run ``data gallery``."""
    from cltp.data.dataset import ContactDataset
    from tacgrasp.console import make_console
    from tacgrasp.datasets.contact_sheet import draw_contacts
    from tacgrasp.datasets.gallery import write_gallery

    _check_draw(flags.contacts, flags.seed)
    data = ContactDataset(flags.folder, partial=True)
    indices = draw_contacts(len(data), flags.contacts, flags.seed)
    _save(lambda path: write_gallery(flags.folder, indices, path, seed=flags.seed), flags.out)
    size = flags.out.stat().st_size / 1e6
    make_console().print(f"written   {flags.out}: {len(indices)} contacts, {size:.1f} MB")


@dataclass(frozen=True)
class SheetFlags:
    """Write contacts with their captions as PNG pages, to be read one by one.

    Attributes:
        folder: Folder of the data set.
        out: Folder to write sheet-01.png, sheet-02.png, ... to.
        contacts: Number of contacts to draw at random; all if the set has fewer.
        seed: Random seed of the drawing; data gallery draws the same contacts from it.
    """

    folder: tyro.conf.Positional[Path]
    out: Path = Path("sheets")
    contacts: int = 50
    seed: int = 0


def sheet(flags: SheetFlags) -> None:
    """Run ``data sheet``."""
    from cltp.data.dataset import ContactDataset
    from tacgrasp.console import make_console
    from tacgrasp.datasets.contact_sheet import draw_contacts, write_pages

    _check_draw(flags.contacts, flags.seed)
    data = ContactDataset(flags.folder, partial=True)
    indices = [int(index) for index in draw_contacts(len(data), flags.contacts, flags.seed)]
    try:
        written = write_pages(data, indices, flags.out)
    except OSError as error:
        raise UsageError(f"--out {flags.out} can't be written: {error.strerror}") from None
    make_console().print(f"written   {len(written)} pages in {flags.out}")


def _check_draw(contacts: int, seed: int) -> None:
    if contacts < 1 or seed < 0:
        raise UsageError(
            f"expected at least 1 contact and a seed from 0, got {contacts} contacts, seed {seed}"
        )


def _save(write: Callable[[Path], object], path: Path) -> None:
    try:
        with replacing(path, suffix=f".part{path.suffix}") as part:
            write(part)
    except OSError as error:
        raise UsageError(f"--out {path} can't be written: {error.strerror or error}") from None
