"""CLTP's wrong predictions: contacts of each class with pictures, and the paper's cases.

Collected while encoders are evaluated, stored beside the results, shown by the report. The paper's
cases (section 5.2) are shapes that overlap, triangle and peak, sphere and ellipsoid; and large
planes, whose deepest point may be anywhere. Our label of a plane's position is the centre of the
pressed area.
"""

from __future__ import annotations

import base64
import io
from collections.abc import Sequence
from dataclasses import dataclass, fields
from pathlib import Path
from typing import ClassVar

from PIL import Image
from torch import Tensor

from cltp.data.dataset import ContactDataset
from cltp.errors import TouchError
from cltp.evaluation.features import EncodedContacts
from cltp.tactile.picture import picture
from cltp.tactile.sensors import sensor_named
from cltp.tactile.states import CLASSES
from tacgrasp.pretraining.report.store import Measurement, Result, load

EXAMPLES_PER_CLASS = 3
EXAMPLES_PER_CASE = 6
FAILURE_SPLITS = ("contact", "object", "physics")
"""Evaluation splits of the paper's tables, whose failures are stored."""
CONFUSED_SHAPES = (("triangle", "peak"), ("sphere", "ellipsoid"))
"""Pairs of shapes that the paper says are confused."""

_WIDTH_PX = 112
_WEBP_QUALITY = 78


@dataclass(frozen=True, slots=True, kw_only=True)
class Failure:
    """One contact with a wrong class.

    Attributes:
        index: Number of the contact in its split.
        object: Name of the pressed object.
        truth, predicted: Names of the classes.
        predicted_score, true_score: Scores of either class: cosines, or probabilities.
        image: WebP in base64: the clean gel, shaded, as the sensor sees it.
    """

    index: int
    object: str
    truth: str
    predicted: str
    predicted_score: float
    true_score: float
    image: str


@dataclass(frozen=True, slots=True, kw_only=True)
class FailureCount:
    """Failures among the contacts of a class, or of one of the paper's cases.

    Attributes:
        dimension: The dimension that was predicted.
        name: Name of the class or case.
        contacts: Number of contacts.
        wrong: Number of them that were predicted wrongly, in a case as its name says.
        examples: Those with the highest score of the wrong class, one of each press.
    """

    dimension: str
    name: str
    contacts: int
    wrong: int
    examples: list[Failure]

    @property
    def percent(self) -> float | None:
        """Percent predicted wrongly; None without contacts."""
        return 100 * self.wrong / self.contacts if self.contacts else None


@dataclass(frozen=True, slots=True, kw_only=True)
class Failures(Measurement):
    """The failures behind a result.

    Attributes:
        measure: What scores are, ``cosine`` or ``probability``.
        classes: Counts by dimension and class.
        cases: Counts of the paper's cases.
    """

    format: ClassVar[str] = "tacgrasp-failures"
    folder: ClassVar[str] = "failures"

    measure: str
    classes: list[FailureCount]
    cases: list[FailureCount]


def collect_failures(
    result: Result,
    data: ContactDataset,
    encoded: EncodedContacts,
    scores: Sequence[Tensor],
    measure: str,
) -> Failures:
    """Find the failures behind a result.

    Args:
        result: The result that they belong to.
        data: The split of the data.
        encoded: Its contacts.
        scores: Scores of each class by dimension, shape (N, classes).
        measure: What scores are, ``cosine`` or ``probability``.

    Raises:
        TouchError: The data are damaged.
    """
    finder = _Finder(data, encoded, scores)
    classes = [
        finder.count(dimension, name, finder.labels(dimension) == number, EXAMPLES_PER_CLASS)
        for dimension, names in CLASSES.items()
        for number, name in enumerate(names)
    ]
    pairs = (pair for names in CONFUSED_SHAPES for pair in (names, names[::-1]))
    cases = [finder.count_confused(truth, predicted) for truth, predicted in pairs]
    shapes = finder.labels("shape")
    is_plane = shapes == CLASSES["shape"].index("plane")
    others = (shapes >= 0) & ~is_plane
    cases.append(finder.count("position", "position of planes", is_plane, EXAMPLES_PER_CASE))
    cases.append(finder.count("position", "position of all others", others, 0))
    key = {field.name: getattr(result, field.name) for field in fields(Measurement)}
    return Failures(**key, measure=measure, classes=classes, cases=cases)


class _Finder:
    def __init__(
        self, data: ContactDataset, encoded: EncodedContacts, scores: Sequence[Tensor]
    ) -> None:
        self._data, self._encoded = data, encoded
        self._scores = dict(zip(CLASSES, scores, strict=True))

    def labels(self, dimension: str) -> Tensor:
        """Classes (N,) of a dimension; -1 without a label."""
        return self._encoded.classes[:, list(CLASSES).index(dimension)]

    def count(self, dimension: str, name: str, among: Tensor, examples: int) -> FailureCount:
        """Wrong predictions of a dimension among some contacts, a mask of shape (N,)."""
        among = among & (self.labels(dimension) >= 0)
        wrong = among & (self._scores[dimension].argmax(dim=1) != self.labels(dimension))
        return self._counted(dimension, name, among, wrong, examples)

    def count_confused(self, truth: str, predicted: str) -> FailureCount:
        """Contacts of one shape that are predicted to be of another."""
        names = CLASSES["shape"]
        among = self.labels("shape") == names.index(truth)
        wrong = among & (self._scores["shape"].argmax(dim=1) == names.index(predicted))
        return self._counted("shape", f"{truth} as {predicted}", among, wrong, EXAMPLES_PER_CASE)

    def _counted(
        self, dimension: str, name: str, among: Tensor, wrong: Tensor, examples: int
    ) -> FailureCount:
        rows = wrong.nonzero()[:, 0]
        scores = self._scores[dimension][rows].amax(dim=1)
        first: dict[int, int] = {}  # a press is a series of contacts that look alike
        for row in rows[scores.argsort(descending=True, stable=True)].tolist():
            first.setdefault(int(self._data.column("series")[int(self._encoded.index[row])]), row)
        return FailureCount(
            dimension=dimension,
            name=name,
            contacts=int(among.sum()),
            wrong=int(wrong.sum()),
            examples=[self._failure(dimension, row) for row in list(first.values())[:examples]],
        )

    def _failure(self, dimension: str, row: int) -> Failure:
        names, index = CLASSES[dimension], int(self._encoded.index[row])
        truth, scores = int(self.labels(dimension)[row]), self._scores[dimension][row]
        predicted = int(scores.argmax())
        return Failure(
            index=index,
            object=str(self._data.column("object")[index]),
            truth=names[truth],
            predicted=names[predicted],
            predicted_score=round(float(scores[predicted]), 4),
            true_score=round(float(scores[truth]), 4),
            image=small_picture(self._data, index),
        )


def small_picture(data: ContactDataset, index: int, width_px: int = _WIDTH_PX) -> str:
    """A contact's shaded surface as WebP in base64."""
    sensor = sensor_named(data.column("sensor")[index])
    pixels = picture(data.height_mm(index), sensor, width_px)
    buffer = io.BytesIO()
    Image.fromarray(pixels).save(buffer, format="WEBP", quality=_WEBP_QUALITY, method=4)
    return base64.b64encode(buffer.getvalue()).decode()


def load_failures(folder: Path, data: str) -> list[Failures]:
    """Failures beside the results in a folder, of the first seed of each result; may be none.

    Args:
        folder: Folder of the results.
        data: Checksum of the data that the results are of.

    Raises:
        TouchError: A file is damaged, of another version, or of other data.
    """
    first: dict[tuple[str, ...], Failures] = {}
    for path in sorted((folder / Failures.folder).glob("*.json")):
        failures = load(Failures, path)
        if failures.data != data:
            raise TouchError(
                f"failures in {path} are of other data than the results; measure again"
            )
        key = (failures.table, failures.method, failures.variant, failures.split)
        if key not in first or failures.seed < first[key].seed:
            first[key] = failures
    return sorted(
        first.values(), key=lambda f: (f.table != "zero_shot", FAILURE_SPLITS.index(f.split))
    )
