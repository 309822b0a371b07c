"""``tacgrasp data inspect|stats|verify|gallery|sheet``: look into data sets of contacts."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import tyro

from cltp.atomic_write import replacing
from tacgrasp.base.counted import counted
from tacgrasp.base.errors import UsageError
from tacgrasp.base.result_file import check_ending, write_result
from tacgrasp.cli.flags import writable

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from cltp.data.dataset import ContactDataset

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

    if flags.out is not None:
        check_ending(flags.out, ".png")
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

    path = writable(flags.json)
    figures = count(flags.folder)
    show(figures, make_console())
    if path is not None:
        write_result(path, as_json(figures))


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
    from tacgrasp.console import count_progress, make_console
    from tacgrasp.datasets.verify import problems

    out, num_wrong = make_console(), 0
    if not (flags.folder / "dataset.json").is_file():
        ContactDataset(flags.folder, partial=True)  # says that it is none
    checked = 0
    try:
        with count_progress() as progress:
            total = len(ContactDataset(flags.folder, partial=True))
            task = progress.add_task("contacts", total=total)
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
    verdict = f"{num_wrong} problem{'s' if num_wrong > 1 else ''}" if num_wrong else "nothing wrong"
    out.print(f"{flags.folder}: {counted(checked, 'contact')} checked, {verdict}")
    return 1 if num_wrong else 0


@dataclass(frozen=True, kw_only=True)
class DrawFlags:
    """Flags of a command that draws contacts at random.

    Attributes:
        folder: Folder of the data set.
        contacts: Number of contacts to draw at random; all if the set has fewer.
        seed: Random seed of the drawing; data gallery and data sheet draw the same contacts from
            it.
    """

    folder: tyro.conf.Positional[Path]
    contacts: int = 200
    seed: int = 0

    def draw(self) -> tuple[ContactDataset, NDArray[np.int64]]:
        """The data set, and the indices of the drawn contacts."""
        from cltp.data.dataset import ContactDataset
        from tacgrasp.datasets.contact_sheet import draw_contacts

        if self.contacts < 1:
            raise UsageError(f"--contacts must be at least 1, got {self.contacts}")
        data = ContactDataset(self.folder, partial=True)
        return data, draw_contacts(len(data), self.contacts, self.seed)


@dataclass(frozen=True, kw_only=True)
class GalleryFlags(DrawFlags):
    """Write contacts into one self-contained HTML page: pictures, captions, class counts.

    Attributes:
        out: HTML file to write.
    """

    out: Path = Path("gallery.html")


def gallery(flags: GalleryFlags) -> None:
    """Run ``data gallery``."""
    from tacgrasp.console import make_console
    from tacgrasp.datasets.gallery import write_gallery

    check_ending(flags.out, ".html")
    _, indices = flags.draw()
    _save(lambda path: write_gallery(flags.folder, indices, path, seed=flags.seed), flags.out)
    size = flags.out.stat().st_size / 1e6
    make_console().print(
        f"written   {flags.out}: {counted(len(indices), 'contact')}, {size:.1f} MB"
    )


@dataclass(frozen=True, kw_only=True)
class SheetFlags(DrawFlags):
    """Write contacts with their captions as PNG pages, to be read one by one.

    Attributes:
        out: Folder to write sheet-01.png, sheet-02.png, ... to.
    """

    out: Path = Path("sheets")
    contacts: int = 50


def sheet(flags: SheetFlags) -> None:
    """Run ``data sheet``."""
    from tacgrasp.console import make_console
    from tacgrasp.datasets.contact_sheet import write_pages

    data, indices = flags.draw()
    try:
        written = write_pages(data, indices.tolist(), flags.out)
    except OSError as error:
        raise UsageError(f"--out {flags.out} can't be written: {error.strerror}") from None
    make_console().print(f"written   {len(written)} pages in {flags.out}")


def _save(write: Callable[[Path], object], path: Path) -> None:
    try:
        with replacing(path, suffix=f".part{path.suffix}") as part:
            write(part)
    except OSError as error:
        raise UsageError(f"--out {path} can't be written: {error.strerror or error}") from None
