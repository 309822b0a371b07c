"""``tacgrasp bench other-sim``: what weights read in contacts of another simulator.

Zero-shot, by the nearest prompt, and by the state heads; on clean heights and under the noise of
``sim.independent.noise``, which no training draws. Beside them: the most frequent class.
"""

from __future__ import annotations

import tempfile
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import torch
from numpy.typing import NDArray
from torch import Tensor
from transformers.utils.logging import disable_progress_bar

from cltp.atomic_write import replacing
from cltp.checkpoints.frozen import frozen
from cltp.checkpoints.tac3d_llm import load_clip, load_encoder
from cltp.data.dataset import ContactDataset
from cltp.data.sampler import CLEAN, Batch, Sampler
from cltp.evaluation.features import encode_batches
from cltp.evaluation.probes import predict_with_heads
from cltp.evaluation.scores import best_classes
from cltp.evaluation.zero_shot import ClassPrompts
from cltp.processor import torch_threads
from cltp.tactile.point_layout import PointLayout
from cltp.tactile.sensors import sensor_named
from cltp.tactile.states import CLASSES
from cltp.train.text_targets import class_numbers
from sim.independent.noise import disturbed
from tacgrasp.base.errors import UsageError
from tacgrasp.benchmarks.figures import number_table, write_figures
from tacgrasp.benchmarks.loop.strawberry import wilson
from tacgrasp.benchmarks.settings import OtherSimSettings
from tacgrasp.benchmarks.transfer.foreign_contacts import from_folder, generated
from tacgrasp.console import make_table_console
from tacgrasp.datasets.contact_sheet import pages
from tacgrasp.policy_factory import default_weights

CONDITIONS = ("clean", "noisy")
QUICK_CONTACTS = 95
SHEET_CONTACTS, SHEET_COLUMNS = 60, 6
SHALLOW_MM = 0.15
SMALL_PART = 1 / 3
"""Part of the contacts, those of least area, that counts as small."""

MOST_OBJECTS = 80
"""Objects up to which each has figures of its own."""

_BATCH = 64
_SHAPE = list(CLASSES).index("shape")


@dataclass(frozen=True, slots=True, kw_only=True)
class Labels:
    """Labels of the contacts.

    Attributes:
        classes: Shape (N, 5), in the order of ``CLASSES``; -1 without a given label.
        groups: Masks (N,) of groups of contacts by name.
    """

    classes: Tensor
    groups: Mapping[str, NDArray[np.bool_]]


@torch_threads()
def run(settings: OtherSimSettings) -> None:
    """Read the contacts, print a table, write the figures and the sheet.

    Raises:
        UsageError: The folder can't be used.
        TouchError: Weights or data can't be used.
    """
    disable_progress_bar()  # of reading weights, over in milliseconds
    weights = settings.weights or default_weights()
    count = QUICK_CONTACTS if settings.quick else settings.contacts
    console = make_table_console()
    with tempfile.TemporaryDirectory() as work:
        if settings.data is None:
            seeds = range(settings.first_seed, settings.first_seed + count)
            data = generated(seeds, settings.sensor, Path(work))
        else:
            data = from_folder(settings.data, settings.sensor, Path(work))
        rows = np.sort(np.random.default_rng(settings.first_seed).permutation(len(data))[:count])
        labels = labels_of(data, rows)
        figures: dict[str, Any] = {
            "weights": str(weights),
            "data": None if settings.data is None else str(settings.data),
            "first_seed": settings.first_seed,
            "contacts": len(rows),
            "constant": constant_answer(labels.classes),
        }
        for condition in CONDITIONS:
            noise = settings.first_seed if condition == "noisy" else None
            answers = read(weights, data, rows, noise_seed=noise)
            figures[condition] = {name: scores(one, labels) for name, one in answers.items()}
        if settings.sheet is not None:
            _write_sheet(data, settings.sheet)
    _print(console, figures)
    write_figures(settings.json, figures)


def read(
    weights: Path, data: ContactDataset, rows: NDArray[np.int64], *, noise_seed: int | None
) -> dict[str, Tensor]:
    """Classes (N, 5) that each method reads; without a ``noise_seed`` from clean heights.

    Raises:
        TouchError: The weights can't be used.
    """
    encoder, heads = load_encoder(weights / "encoder")
    encoder.eval(), heads.eval()
    reader = frozen(encoder)
    batches = _batches(data, rows, reader.layout, noise_seed)
    encoded = encode_batches(reader, batches)
    prompts = ClassPrompts(load_clip(weights / "clip"))
    return {
        "zero_shot": best_classes(prompts.cosines(encoded.feature)),
        "heads": predict_with_heads(heads, encoded, batches).classes,
    }


def _batches(
    data: ContactDataset, rows: NDArray[np.int64], layout: PointLayout, noise_seed: int | None
) -> list[Batch]:
    sampler = Sampler(data, CLEAN, layout=layout)
    batches = []
    for first in range(0, len(rows), _BATCH):
        part = rows[first : first + _BATCH]
        points, heights, sensors = [], [], []
        for index in part.tolist():
            sensor = sensor_named(data.column("sensor")[index])
            height_mm = data.height_mm(index)
            rng = np.random.default_rng([noise_seed or 0, index])
            seen = height_mm if noise_seed is None else disturbed(height_mm, sensor, rng)[0]
            points.append(sampler.cloud(seen, sensor, rng))
            heights.append(height_mm)
            sensors.append(sensor)
        none = np.zeros((len(part), 2), dtype=np.bool_)
        batch = Batch(
            index=part,
            points=np.stack(points),
            height_mm=heights,
            sensors=sensors,
            states=[data.nominal_state(index) for index in part.tolist()],
            mirror=none,
            moved=none[:, 0],
            layout=layout,
        )
        batches.append(batch)
    return batches


def labels_of(data: ContactDataset, rows: NDArray[np.int64]) -> Labels:
    """Given labels, and groups by shape, by object where there are few, by size, depth and cut.

    Raises:
        UsageError: No contact has a label.
    """
    classes = class_numbers([data.state(index) for index in rows.tolist()])
    measured = data.column("measured")[rows]
    for number, name in enumerate(CLASSES):
        not_given = [name in (fields or "").split() for fields in measured]
        classes[torch.tensor(not_given), number] = -1
    if not (classes >= 0).any():
        raise UsageError("no contact has a label; name shape, texture, depth, position or area")
    area, depth_mm = data.column("area_share")[rows], data.column("depth_mm")[rows]
    cut = data.column("cut")[rows].astype(str) != ""
    smallest = np.zeros(len(rows), dtype=np.bool_)
    smallest[np.argsort(area, kind="stable")[: round(SMALL_PART * len(rows))]] = True
    groups = {"smallest third": smallest, "below 0.15 mm": depth_mm < SHALLOW_MM, "cut": cut}
    shape = data.column("shape")[rows].astype(str)
    groups |= {f"shape {name}": shape == name for name in CLASSES["shape"]}
    objects = data.column("object")[rows].astype(str)
    variant = np.array([name.rsplit(", ", 1)[0] for name in objects])
    if len(names := np.unique(variant)) <= MOST_OBJECTS:
        groups |= {f"object {name}": variant == name for name in names.tolist()}
    groups = {name: mask for name, mask in groups.items() if mask.any()}
    return Labels(classes=classes, groups=groups)


def scores(answers: Tensor, labels: Labels) -> dict[str, Any]:
    """Percent right of each dimension, with numbers and 95 % intervals, by class and by group.

    Returns:
        A figure for each dimension, None without labels; ``n`` and ``interval`` by dimension;
        ``by_class`` by dimension and class; ``shape_by_group``; and ``shape_read_as``, the three
        wrong shapes that are read most often in each group.
    """
    right = (answers == labels.classes).numpy()
    figures: dict[str, Any] = {"n": {}, "interval": {}, "by_class": {}}
    for number, (name, words) in enumerate(CLASSES.items()):
        codes = labels.classes[:, number].numpy()
        count = _counted(right[:, number], codes >= 0)
        figures[name] = count["right"] if count["n"] else None
        figures["n"][name] = count["n"]
        limits = wilson(int(right[codes >= 0, number].sum()), count["n"])
        figures["interval"][name] = [100 * limit for limit in limits]
        by_class = {word: _counted(right[:, number], codes == i) for i, word in enumerate(words)}
        figures["by_class"][name] = {w: figure for w, figure in by_class.items() if figure["n"]}
    shapes, labelled = CLASSES["shape"], (labels.classes[:, _SHAPE] >= 0).numpy()
    figures["shape_by_group"], figures["shape_read_as"] = {}, {}
    for group, mask in labels.groups.items():
        chosen = mask & labelled
        if chosen.any():
            figures["shape_by_group"][group] = _counted(right[:, _SHAPE], chosen)
            wrong = answers[torch.from_numpy(chosen & ~right[:, _SHAPE]), _SHAPE].tolist()
            counts = Counter(shapes[code] for code in wrong)
            figures["shape_read_as"][group] = dict(counts.most_common(3))
    return figures


def _counted(right: NDArray[np.bool_], mask: NDArray[np.bool_]) -> dict[str, Any]:
    """Percent right among some contacts, and their number."""
    n = int(mask.sum())
    return {"right": 100 * float(right[mask].mean()) if n else None, "n": n}


def constant_answer(classes: Tensor) -> dict[str, float | None]:
    """Percent right of the most frequent class of each dimension."""
    figures: dict[str, float | None] = {}
    for number, name in enumerate(CLASSES):
        given = classes[classes[:, number] >= 0, number]
        figures[name] = 100 * int(given.bincount().max()) / len(given) if len(given) else None
    return figures


def _write_sheet(data: ContactDataset, path: Path) -> None:
    indices = list(range(min(len(data), SHEET_CONTACTS)))
    with replacing(path) as part:
        next(pages(data, indices, SHEET_CONTACTS, SHEET_COLUMNS)).save(part, format="PNG")


def _print(console: Any, figures: Mapping[str, Any]) -> None:
    table = number_table(f"{figures['contacts']} contacts, % right", ["", *CLASSES])
    rows = {"constant": figures["constant"]}
    for condition in CONDITIONS:
        rows |= {f"{condition}, {method}": each for method, each in figures[condition].items()}
    for title, row in rows.items():
        table.add_row(title, *("-" if row[n] is None else f"{row[n]:.1f}" for n in CLASSES))
    console.print(table)
    groups = number_table("shape, % right", ["", "n", *(r for r in rows if r != "constant")])
    for group, first in figures["clean"]["heads"]["shape_by_group"].items():
        values = (rows[r]["shape_by_group"][group]["right"] for r in rows if r != "constant")
        groups.add_row(group, str(first["n"]), *(f"{value:.0f}" for value in values))
    console.print(groups)
