"""Cheap contacts for tests of learning: bodies pressed into a blurred surface. No mechanics."""

from collections.abc import Mapping
from pathlib import Path

import numpy as np
from scipy.ndimage import gaussian_filter

from cltp.data.contact import Contact, Split
from cltp.data.dataset_writer import DatasetWriter
from cltp.tactile.sensors import SENSORS
from cltp.tactile.states import (
    ContactState,
    Shape,
    Side,
    Texture,
    area_word,
    depth_word,
    position_word,
)

MINI = SENSORS["gelsight_mini"]
ROWS, COLUMNS = 76, 102
Y, X = np.meshgrid(
    (0.5 - (np.arange(ROWS) + 0.5) / ROWS) * MINI.height_mm,
    ((np.arange(COLUMNS) + 0.5) / COLUMNS - 0.5) * MINI.width_mm,
    indexing="ij",
)
SHAPES = (
    Shape.SPHERE,
    Shape.ELLIPSOID,
    Shape.CUBOID,
    Shape.DISC,
    Shape.TRIANGLE,
    Shape.PEAK,
    Shape.CYLINDER,
    Shape.RING,
    Shape.LINE,
    Shape.CROSS,
    Shape.STRIPES,
    Shape.DOTS,
)


def _body(shape: Shape, u: np.ndarray, v: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """How far the body's surface lies behind its foremost point [mm]."""
    size = rng.uniform(2.0, 5.0)
    r = np.hypot(u, v)
    wall = 8.0
    match shape:
        case Shape.SPHERE:
            return r**2 / (2 * rng.uniform(4, 20))
        case Shape.ELLIPSOID:
            ratio = rng.uniform(1.6, 4)
            return (u**2 / ratio + v**2) / (2 * rng.uniform(3, 10))
        case Shape.CUBOID:
            return np.where((abs(u) < size) & (abs(v) < size * rng.uniform(0.5, 1)), 0.0, wall)
        case Shape.DISC:
            return np.where(r < size, 0.0, wall)
        case Shape.TRIANGLE:
            inside = (v > -size / 2) & (v < size - np.sqrt(3) * abs(u))
            return np.where(inside, 0.0, wall)
        case Shape.PEAK:
            return r / np.tan(rng.uniform(0.5, 1.0))
        case Shape.CYLINDER:
            return v**2 / (2 * rng.uniform(2, 8)) + 0.0 * u
        case Shape.RING:
            return (r - size) ** 2 / (2 * rng.uniform(0.4, 1.0))
        case Shape.LINE:
            return np.where((abs(v) < 0.6) & (abs(u) < 2 * size), 0.0, wall)
        case Shape.CROSS:
            bar = np.minimum(abs(u), abs(v)) < 0.7
            return np.where(bar & (np.maximum(abs(u), abs(v)) < size), 0.0, wall)
        case Shape.STRIPES:
            return np.where(abs((v / 3 + 0.5) % 1 - 0.5) < 0.17, 0.0, wall)
        case _:
            cell = (u + 1.75) % 3.5 - 1.75, (v + 1.75) % 3.5 - 1.75
            return (cell[0] ** 2 + cell[1] ** 2) / 2.0


def _relief(texture: Texture, u: np.ndarray, v: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    period = rng.uniform(1.2, 1.5)
    match texture:
        case Texture.SMOOTH:
            return np.zeros_like(u)
        case Texture.ROUGH:
            return 0.3 * gaussian_filter(rng.standard_normal(u.shape), 1.5)
        case Texture.RIDGED:
            return 0.07 * np.sin(2 * np.pi * u / period)
        case Texture.BUMPY:
            return 0.07 * np.sin(np.pi * u / period) * np.sin(np.pi * v / period)
        case _:
            return 0.05 * (np.sin(2 * np.pi * u / period) + np.sin(2 * np.pi * v / period))


def fake_contact(
    seed: int, *, split: Split = Split.TRAIN, texture: Texture | None = None
) -> Contact:
    """A contact drawn from ``seed``."""
    rng = np.random.default_rng(seed)
    shape = SHAPES[rng.integers(len(SHAPES))]
    texture = texture or list(Texture)[rng.integers(len(Texture))]
    angle = rng.uniform(0, 2 * np.pi)
    x0 = rng.uniform(-0.55, 0.55) * MINI.width_mm
    y0 = rng.uniform(-0.55, 0.55) * MINI.height_mm
    u = (X - x0) * np.cos(angle) + (Y - y0) * np.sin(angle)
    v = -(X - x0) * np.sin(angle) + (Y - y0) * np.cos(angle)
    behind = _body(shape, u, v, rng) - _relief(texture, u, v, rng)
    depth = float(np.exp(rng.uniform(np.log(0.1), np.log(1.2))))
    pressed = np.clip(depth - (behind - behind.min()), 0, None)
    blurred = np.maximum(pressed, gaussian_filter(pressed, 3.0))
    heights = gaussian_filter(blurred, 0.6) - 0.25 * gaussian_filter(pressed, 12.0)
    touching = pressed > 0
    share = float(touching.mean())
    deepest = np.unravel_index(int(np.argmax(heights)), heights.shape)
    x_mm, y_mm = float(X[deepest]), float(Y[deepest])
    peak = max(float(heights.max()), 1e-3)
    edges = {
        Side.TOP: touching[0],
        Side.BOTTOM: touching[-1],
        Side.LEFT: touching[:, 0],
        Side.RIGHT: touching[:, -1],
    }
    state = ContactState(
        depth_mm=peak,
        x_mm=x_mm,
        y_mm=y_mm,
        area_fraction=share,
        force_n=float(pressed.sum() * 0.04 * 0.15),
        depth=depth_word(peak),
        position=position_word(x_mm, y_mm, MINI),
        area=area_word(share),
        cut=frozenset(side for side, line in edges.items() if line.any()),
        shape=shape,
        texture=texture,
    )
    return Contact(
        height_mm=heights.astype(np.float32),
        sensor=MINI,
        state=state,
        object=f"fake-{shape.value}",
        series=seed,
        split=split,
        seed=seed,
    )


def write_contacts(folder: Path, seeds: Mapping[Split, range]) -> Path:
    """A data set of fake contacts, by the splits that they belong to."""
    with DatasetWriter(folder) as writer:
        for split, numbers in seeds.items():
            for seed in numbers:
                writer.add(fake_contact(seed, split=split))
    return folder
