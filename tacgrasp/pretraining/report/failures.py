"""Contacts that CLTP names wrongly: of each class some with their pictures, and the paper's cases.

Collected while encoders are tried, stored beside the results, shown by the report. The paper's own
(section 5.2): shapes that overlap, triangle and peak, sphere and ellipsoid; and large planes, whose
deepest point may be anywhere. Our label of a plane's position is the centre of what is pressed.
"""

from __future__ import annotations

import base64
import io
import json
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path

import torch
from PIL import Image
from torch import Tensor

from cltp.atomic_write import write_atomically
from cltp.data.dataset import ContactDataset
from cltp.errors import TouchError
from cltp.evaluation.features import Observed
from cltp.tactile.picture import picture
from cltp.tactile.sensors import sensor_named
from cltp.tactile.states import CLASSES
from tacgrasp.base.errors import UsageError
from tacgrasp.pretraining.report.store import Result

FORMAT, VERSION = "tacgrasp-failures", 1
FOLDER = "failures"
KEPT = 3
"""Pictures of each class."""
KEPT_OF_CASE = 6
TRIALS = ("contact", "object", "physics")
"""Of which failures are kept: those of the paper's tables."""
NAMED = (("triangle", "peak"), ("sphere", "ellipsoid"))
"""Shapes that the paper says are taken for each other."""

_WIDTH_PX = 112
_WEBP_QUALITY = 78


@dataclass(frozen=True, slots=True, kw_only=True)
class Failure:
    """One contact named wrongly.

    Attributes:
        index: Of the contact in its split.
        object: What was pressed.
        truth, said: Classes.
        said_sure, true_sure: How sure of either: a cosine, or a probability.
        image: WebP, base64: the clean gel, shaded, as the sensor sees it.
    """

    index: int
    object: str
    truth: str
    said: str
    said_sure: float
    true_sure: float
    image: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Failed:
    """Contacts of a class, or of a case that the paper names.

    Attributes:
        slot: Dimension that was named.
        name: Of the class or case.
        contacts: How many there are.
        wrong: How many of them were named wrongly, in a case as it says.
        examples: Those of which the encoder was surest, one of each press.
    """

    slot: str
    name: str
    contacts: int
    wrong: int
    examples: list[Failure]

    @property
    def percent(self) -> float | None:
        """Share named wrongly; None without contacts."""
        return 100 * self.wrong / self.contacts if self.contacts else None


@dataclass(frozen=True, slots=True, kw_only=True)
class Failures:
    """What a method named wrongly in one trial.

    Attributes:
        table, method, variant, trial, seed, data: As of the ``Result`` beside it.
        measure: What sureness is, ``cosine`` or ``probability``.
        classes: By dimension and class.
        cases: The paper's.
    """

    table: str
    method: str
    variant: str
    trial: str
    seed: int
    data: str
    measure: str
    classes: list[Failed]
    cases: list[Failed]


def collect(
    result: Result, data: ContactDataset, seen: Observed, sure: Sequence[Tensor], measure: str
) -> Failures:
    """Find the failures behind a result.

    Args:
        result: Whose they are.
        data: The split that was tried.
        seen: Its contacts.
        sure: For each dimension, how sure of each class, shape (N, classes).
        measure: What that is.

    Raises:
        TouchError: The data are damaged.
    """
    finder = _Finder(data, seen, sure)
    classes = [
        finder.failed(slot, name, finder.truth(slot) == number, KEPT)
        for slot, names in CLASSES.items()
        for number, name in enumerate(names)
    ]
    cases = []
    for one, other in (pair for names in NAMED for pair in (names, names[::-1])):
        cases.append(finder.taken_for(one, other))
    plane = finder.truth("shape") == CLASSES["shape"].index("plane")
    rest = (finder.truth("shape") >= 0) & ~plane
    cases.append(finder.failed("position", "place of planes", plane, KEPT_OF_CASE))
    cases.append(finder.failed("position", "place of everything else", rest, 0))
    return Failures(
        table=result.table,
        method=result.method,
        variant=result.variant,
        trial=result.trial,
        seed=result.seed,
        data=result.data,
        measure=measure,
        classes=classes,
        cases=cases,
    )


class _Finder:
    def __init__(self, data: ContactDataset, seen: Observed, sure: Sequence[Tensor]) -> None:
        self._data, self._seen = data, seen
        self._sure = dict(zip(CLASSES, sure, strict=True))

    def truth(self, slot: str) -> Tensor:
        """Classes (N,) of a dimension; -1 where nobody named one."""
        return self._seen.classes[:, list(CLASSES).index(slot)]

    def failed(self, slot: str, name: str, among: Tensor, keep: int) -> Failed:
        """Contacts among some, shape (N,), that are named wrongly in a dimension."""
        among = among & (self.truth(slot) >= 0)
        wrong = among & (self._sure[slot].argmax(dim=1) != self.truth(slot))
        return self._of(slot, name, among, wrong, keep)

    def taken_for(self, one: str, other: str) -> Failed:
        """Contacts of one shape that are said to be of another."""
        names = CLASSES["shape"]
        among = self.truth("shape") == names.index(one)
        wrong = among & (self._sure["shape"].argmax(dim=1) == names.index(other))
        return self._of("shape", f"{one} as {other}", among, wrong, KEPT_OF_CASE)

    def _of(self, slot: str, name: str, among: Tensor, wrong: Tensor, keep: int) -> Failed:
        rows = wrong.nonzero()[:, 0]
        sure = self._sure[slot][rows].amax(dim=1) if len(rows) else torch.zeros(0)
        ranked = rows[sure.argsort(descending=True, stable=True)]
        return Failed(
            slot=slot,
            name=name,
            contacts=int(among.sum()),
            wrong=int(wrong.sum()),
            examples=[self._failure(slot, row) for row in self._different(ranked.tolist(), keep)],
        )

    def _different(self, rows: Sequence[int], keep: int) -> list[int]:
        """The first rows, one of each press: a press is a series of contacts that look alike."""
        first: dict[int, int] = {}
        for row in rows:
            first.setdefault(int(self._data.column("series")[int(self._seen.index[row])]), row)
        return list(first.values())[:keep]

    def _failure(self, slot: str, row: int) -> Failure:
        names, index = CLASSES[slot], int(self._seen.index[row])
        truth, sure = int(self.truth(slot)[row]), self._sure[slot][row]
        said = int(sure.argmax())
        return Failure(
            index=index,
            object=str(self._data.column("object")[index]),
            truth=names[truth],
            said=names[said],
            said_sure=round(float(sure[said]), 4),
            true_sure=round(float(sure[truth]), 4),
            image=small_picture(self._data, index),
        )


def small_picture(data: ContactDataset, index: int, width_px: int = _WIDTH_PX) -> str:
    """A contact's shaded surface as WebP in base64."""
    sensor = sensor_named(data.column("sensor")[index])
    pixels = picture(data.height_mm(index), sensor, width_px)
    buffer = io.BytesIO()
    Image.fromarray(pixels).save(buffer, format="WEBP", quality=_WEBP_QUALITY, method=4)
    return base64.b64encode(buffer.getvalue()).decode()


def save_failures(folder: Path, result: Result, found: Failures) -> Path:
    """Write failures, beside and then in their place; their file is named as the result's.

    Raises:
        UsageError: They can't be written.
    """
    path = folder / FOLDER / result.file
    content = {"format": FORMAT, "version": VERSION, **asdict(found)}
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        write_atomically(path, json.dumps(content) + "\n")
    except OSError as error:
        raise UsageError(f"failures can't be written to {path}: {error.strerror}") from None
    return path


def load_failures(folder: Path, data: str) -> list[Failures]:
    """Failures beside the results in a folder, those of the first seed of each; none is no error.

    Args:
        folder: Of the results.
        data: Checksum of the data that the results are of.

    Raises:
        TouchError: A file is damaged, of another version, or of other data.
    """
    first: dict[tuple[str, ...], Failures] = {}
    for path in sorted((folder / FOLDER).glob("*.json")):
        found = _read(path)
        if found.data != data:
            raise TouchError(
                f"failures in {path} are of other data than the results; measure again"
            )
        key = (found.table, found.method, found.variant, found.trial)
        if key not in first or found.seed < first[key].seed:
            first[key] = found
    return sorted(first.values(), key=lambda f: (f.table != "zero_shot", TRIALS.index(f.trial)))


def _read(path: Path) -> Failures:
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
        if (content.pop("format"), content.pop("version")) != (FORMAT, VERSION):
            raise TouchError(f"{path} holds no failures of this version; measure again")
        for part in ("classes", "cases"):
            content[part] = [
                Failed(**{**each, "examples": [Failure(**one) for one in each["examples"]]})
                for each in content[part]
            ]
        return Failures(**content)
    except (OSError, ValueError, KeyError, TypeError, AttributeError) as error:
        raise TouchError(f"failures in {path} are damaged; measure again: {error}") from error
