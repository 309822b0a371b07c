"""``tacgrasp eval intervals``: errors of the heads' numbers, how often intervals and words hold.

On contacts that nothing was learned from: of seen objects, of unseen objects and gels, of a second
simulator, on pads of other proportions, and felt by the 12 × 12 points of ``taxels``. Every unit
has a force calibration with a drawn residual. Depth and force have trivial rivals beside them: the
median of all contacts for each, with the interval that holds nine tenths of them.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import torch
from numpy.typing import NDArray

from cltp.checkpoints.tac3d_llm import load_encoder
from cltp.data.contact import Split
from cltp.data.dataset import ContactDataset
from cltp.data.sampler import CLEAN, NOISY, Augmentation, Sampler
from cltp.encoder.encoder import TactileEncoder
from cltp.encoder.heads import IGNORED, StateHeads, targets
from cltp.encoder.readings import HeadReadings, readings_of
from cltp.errors import TouchError
from cltp.tactile.noise_levels import NoiseLevels
from cltp.tactile.sensor_noise import CALIBRATED_PART
from cltp.tactile.sensors import SensorSpec, sensor_named
from cltp.tactile.states import CLASSES, NUMBERS, ContactState
from cltp.train.stage import ProgressReport, silent
from sim.grasp.force_calibration import drawn_force_calibration
from sim.independent.contacts import make_contact

FIRST_SEED = 1_500_000
"""First seed of the second simulator's contacts; those of ``bench other-sim`` are others."""

_MINI = sensor_named("gelsight_mini")
OTHER_PADS: Mapping[str, SensorSpec] = {
    "pad 24.0 x 14.4 mm": replace(_MINI, columns=300, rows=180, mm_per_px=0.08),
    "pad 14.4 x 19.2 mm": replace(_MINI, columns=180, rows=240, mm_per_px=0.08),
    "pad 12.0 x 12.0 mm": replace(_MINI, columns=150, rows=150, mm_per_px=0.08),
}
"""Pads with a Mini's noise that no training has, wide, tall and small."""

LIGHT_N = 1.0
"""Force below which errors of force are told in newtons."""

CALIBRATED = Augmentation(
    noise_level=NoiseLevels(drift=CALIBRATED_PART, tilt=0.5, scale=1 / 3),
    uncalibrated=0.0,
    mirror=False,
)
"""Noise of one unit that is read by its own calibration, where ``NOISY`` is that of units at large:
drift and tilt as measured (``cltp.tactile.sensor_noise``), depth scale ±5 % (``tacgrasp bench
balls`` finds 1.5 % on the unit that was measured)."""

TAXELS = sensor_named("taxels")

BATCH = 64

SCALES = {"scale_x": "x_mm", "scale_y": "y_mm", "scale_area": "area_fraction"}

DEPTH, FORCE = NUMBERS.index("depth_mm"), NUMBERS.index("force_n")


@dataclass(frozen=True, slots=True, kw_only=True)
class Group:
    """Contacts of one kind.

    Attributes:
        name: Name in tables.
        readings: What the heads read, in newtons by each unit's calibration.
        truth: Shape (N, 5), ``NUMBERS``.
        classes: Shape (N, 5), numbers of the true words; ``IGNORED`` where there is none.
    """

    name: str
    readings: HeadReadings
    truth: NDArray[np.float64]
    classes: NDArray[np.int64]


def evaluate_intervals(
    weights: Path, data: Path, *, num: int = 1000, seed: int = 0, report: ProgressReport = silent
) -> dict[str, Any]:
    """Figures of every group, for JSON.

    Args:
        weights: Folder of weights.
        data: Data set of contacts with the splits of the set ``full``.
        num: Most contacts of each group.
        seed: Random seed of choice, noise and units.
        report: Receives the progress.

    Returns:
        ``groups.<name>``: ``n``, medians ``depth_mm, place_mm, area_percent, force_percent,
        light_force_n``, ``scale_x, scale_y, scale_area`` (what is read over what is true, by least
        squares), ``inside.<number>`` and ``width.<number>`` (median over that of the seen objects),
        ``words.<dimension>.{right, confidence}`` (% right, and mean of the probability of the word
        that is said), all of contacts that touch; ``trivial`` the numbers of the rival.

    Raises:
        TouchError: Weights or data can't be used.
    """
    encoder, heads = load_encoder(weights / "encoder")
    reader = _Reader(encoder.eval(), heads.eval(), seed)
    groups = {}
    widths: NDArray[np.float64] | None = None
    for number, group in enumerate(_groups(reader, data, num, seed)):
        if widths is None:
            widths = _widths(group)
        groups[group.name] = _figures(group, widths)
        report("groups", number + 1, number + 1, {})
    return {"weights": str(weights), "data": str(data), "seed": seed, "groups": groups}


@dataclass(frozen=True, slots=True)
class _Reader:
    encoder: TactileEncoder
    heads: StateHeads
    seed: int

    def sampler(self, data: ContactDataset, noise: Augmentation) -> Sampler:
        return Sampler(data, noise, seed=self.seed, layout=self.encoder.config.variant.layout)

    @torch.inference_mode()
    def read(self, points: NDArray[np.float32], sensor_name: str) -> HeadReadings:
        """Readings of clouds (B, N, 3), each of a unit of its own."""
        scales = [
            drawn_force_calibration(sensor_name, self.seed + place).scale
            for place in range(len(points))
        ]
        clouds = torch.from_numpy(points)
        output = self.heads.read(self.encoder(clouds).pooled, clouds)
        factors, spreads = (
            torch.tensor([getattr(scale, part) for scale in scales])
            for part in ("factor", "spread")
        )
        return readings_of(output, factors, spreads)


def _groups(reader: _Reader, folder: Path, num: int, seed: int) -> Iterator[Group]:
    """The groups, seen objects first."""
    splits = (
        ("seen objects", Split.TEST, NOISY),
        ("seen objects, calibrated unit", Split.TEST, CALIBRATED),
        ("seen objects, no noise", Split.TEST, CLEAN),
        ("unseen objects", Split.OBJECT, NOISY),
        ("unseen gels", Split.PHYSICS, NOISY),
    )
    for name, split, noise in splits:
        data = ContactDataset(folder, split=split)
        if not len(data):
            raise TouchError(
                f"{folder} has no contacts of the split {split.value!r}; generate them: tacgrasp "
                "data generate --set full"
            )
        chosen = np.random.default_rng([seed, 83]).permutation(len(data))[:num]
        yield _group(name, reader, data, np.sort(chosen), noise)
        if split is Split.PHYSICS:
            thickness = data.column("gel_thickness_mm")[chosen]
            for mm in np.unique(thickness):
                own = np.sort(chosen[thickness == mm])
                yield _group(f"gel of {mm:.1f} mm", reader, data, own, noise)
    sampler = reader.sampler(ContactDataset(folder), NOISY)
    minis = _of_minis(ContactDataset(folder, split=Split.TEST), num // 2, seed)
    yield _felt("seen objects, 12 x 12 taxels", reader, sampler, minis, TAXELS)
    seeds = range(FIRST_SEED, FIRST_SEED + num // 4)
    for name, sensor in {"second simulator": _MINI, **OTHER_PADS}.items():
        contacts = [make_contact(s, sensor) for s in seeds]
        made = [(each.height_mm, replace(each.state, force_n=np.nan)) for each in contacts]
        yield _felt(name, reader, sampler, made, sensor)


Felt = tuple[NDArray[np.float32], ContactState]
"""Heights [mm] of a contact, and its state; a force of NaN where it is that of another gel."""


def _of_minis(data: ContactDataset, num: int, seed: int) -> list[Felt]:
    """Contacts of a data set on pads of a Mini."""
    own = np.flatnonzero(data.column("sensor") == _MINI.name)
    chosen = np.sort(np.random.default_rng([seed, 85]).permutation(own)[:num])
    return [(data.height_mm(int(i)), data.nominal_state(int(i))) for i in chosen]


def _group(
    name: str, reader: _Reader, data: ContactDataset, chosen: NDArray[Any], noise: Augmentation
) -> Group:
    """The chosen contacts of a data set."""
    sampler = reader.sampler(data, noise)
    parts, states = [], []
    for step, first in enumerate(range(0, len(chosen), BATCH)):
        batch = sampler.batch(chosen[first : first + BATCH], step)
        parts.append(reader.read(batch.points, "gelsight_mini"))
        states += batch.states
    return _grouped(name, parts, states)


def _felt(
    name: str, reader: _Reader, sampler: Sampler, contacts: Sequence[Felt], sensor: SensorSpec
) -> Group:
    """Contacts as a sensor feels them, with its noise."""
    rng = np.random.default_rng([reader.seed, 84])
    points = np.stack([sampler.cloud(height_mm, sensor, rng) for height_mm, _ in contacts])
    parts = [
        reader.read(points[first : first + BATCH], "gelsight_mini")
        for first in range(0, len(points), BATCH)
    ]
    return _grouped(name, parts, [state for _, state in contacts])


def _grouped(name: str, parts: Sequence[HeadReadings], states: Sequence[ContactState]) -> Group:
    return Group(
        name=name,
        readings=_joined(parts),
        truth=np.array([[getattr(state, n) for n in NUMBERS] for state in states]),
        classes=targets(states).classes.numpy(),
    )


def _joined(parts: Sequence[HeadReadings]) -> HeadReadings:
    words = tuple(torch.cat(each) for each in zip(*(part.words for part in parts), strict=True))
    others = (torch.cat(each) for each in zip(*(part[1:] for part in parts), strict=True))
    return HeadReadings(words, *others)


def _widths(group: Group) -> NDArray[np.float64]:
    """Median width of each number's interval, shape (5,), of contacts that touch."""
    touched = group.truth[:, DEPTH] > 0
    width = (group.readings.high - group.readings.low).numpy()[touched]
    return np.asarray(np.median(width, axis=0), dtype=np.float64)


def _figures(group: Group, seen_widths: NDArray[np.float64]) -> dict[str, Any]:
    touched = group.truth[:, DEPTH] > 0
    truth = group.truth[touched]
    low, high = (ends.numpy()[touched] for ends in (group.readings.low, group.readings.high))
    errors = np.abs(group.readings.values.numpy()[touched] - truth)
    inside = np.where(np.isfinite(truth), (low <= truth) & (truth <= high), np.nan)
    least, most = np.quantile(truth, [0.05, 0.95], axis=0)
    rivals = np.abs(np.median(truth, axis=0) - truth)
    scales = (group.readings.values.numpy()[touched] * truth).sum(0) / (truth**2).sum(0)
    return {
        "n": int(touched.sum()),
        **_medians(errors, truth),
        **{key: float(scales[NUMBERS.index(name)]) for key, name in SCALES.items()},
        "inside": _named(100 * inside.mean(axis=0)),
        "width": _named(_widths(group) / seen_widths),
        "words": dict(zip(CLASSES, _words(group, touched), strict=True)),
        "trivial": {**_medians(rivals, truth), "width": _named((most - least) / seen_widths)},
    }


def _words(group: Group, touched: NDArray[np.bool_]) -> Iterator[dict[str, float | None]]:
    """How many words of each dimension are right, and how sure they are said [%]."""
    for chances, true in zip(group.readings.words, group.classes.T, strict=True):
        kept = touched & (true != IGNORED)
        most, said = (each.numpy()[kept] for each in chances.max(dim=1))
        parts = {"right": said == true[kept], "confidence": most}
        yield {
            name: 100 * float(part.mean()) if kept.any() else None for name, part in parts.items()
        }


def _medians(errors: NDArray[np.float64], truth: NDArray[np.float64]) -> dict[str, float | None]:
    """Median errors: depth, place, area and force over their truth, small forces in newtons."""
    x, y = (NUMBERS.index(name) for name in ("x_mm", "y_mm"))
    area = NUMBERS.index("area_fraction")
    light = truth[:, FORCE] < LIGHT_N
    return {
        "depth_mm": _median(errors[:, DEPTH]),
        "place_mm": _median(np.hypot(errors[:, x], errors[:, y])),
        "area_percent": _median(100 * errors[:, area] / truth[:, area]),
        "force_percent": _median(100 * errors[:, FORCE] / truth[:, FORCE]),
        "light_force_n": _median(errors[light, FORCE]),
    }


def _median(values: NDArray[np.float64]) -> float | None:
    return float(np.median(values)) if len(values) and np.isfinite(values).all() else None


def _named(values: NDArray[np.float64]) -> dict[str, float | None]:
    return {n: float(v) if np.isfinite(v) else None for n, v in zip(NUMBERS, values, strict=True)}
