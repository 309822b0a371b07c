"""What an encoder and its heads read of one cloud: words, numbers with intervals, and warnings.

The loop, ``tacgrasp describe`` and the language model's readings are this one reading. Not here:
the direct measurement without weights (``cltp.tactile.measure``).
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from enum import StrEnum
from typing import NamedTuple

import numpy as np
import torch
from numpy.typing import NDArray
from scipy.spatial import cKDTree
from torch import Tensor

from cltp.encoder.encoder import TactileEncoder
from cltp.encoder.heads import StateHeads, outside
from cltp.encoder.readings import WITHOUT_INTERVALS, HeadReadings, readings_of
from cltp.encoder.tokenizers import UNIT_CELL_MM
from cltp.errors import TouchError
from cltp.tactile.cells import LEAST_FILLED, height_grid
from cltp.tactile.cloud import TactileCloud
from cltp.tactile.contact.partial_pad import is_partial
from cltp.tactile.contact.raised_pad import is_raised
from cltp.tactile.encoder_input import encoder_input
from cltp.tactile.force_scale import POSSIBLE_RATIO
from cltp.tactile.measure import contact_state
from cltp.tactile.noise_levels import WIDE
from cltp.tactile.point_layout import GRID
from cltp.tactile.quantiles import quantile
from cltp.tactile.sensor_noise import MINI_SPREAD, SPREADS
from cltp.tactile.sensors import SensorSpec
from cltp.tactile.states import (
    CLASSES,
    NO_CONTACT_STATE,
    NUMBERS,
    Area,
    ContactState,
    Depth,
    Position,
    Shape,
    Side,
    Texture,
    number_limits,
)

NOISE_ALLOWANCE = 8.0
"""Part, over the root of the number of points, by which the fine noise that is seen may exceed that
of training, for the error of its estimate: a quarter of 1024 points. Source: 20 seeds of noise on a
ball; from 0.06 mm per point on, area and place leave their intervals, and all are flagged."""


class Flag(StrEnum):
    """Why a reading is not to be acted on."""

    NOISE = "noise"  # the cloud has more fine noise than any that was learned from
    UNSURE = "unsure"  # depth or place is too uncertain to tell anything
    RANGE = "range"  # a number lies beyond what a gel can show, or the depth beyond any learned
    CONTRADICTION = "contradiction"  # the depth that is measured directly is another one
    FORCE = "force"  # the force is impossible for the one that is commanded
    PAD = "pad"  # the pad has another size or proportions than any that was learned from
    RAISED = "raised"  # the whole pad is raised: pressed all over, or without its zero
    PARTIAL = "partial"  # part of the pad is not measured: no points there, dead or bad ones


UNSURE_MM: Mapping[str, float] = {"depth_mm": 0.6, "x_mm": 10.0, "y_mm": 10.0}
"""Width of an interval that tells nothing: two words for depths, half of the pad."""

LEARNED_DEPTH_MM = 1.3
"""Depth of the deepest presses of training, but for few by force (``sim.full.requests``): what is
read of deeper ones stays at about this depth. ``StateHeads.contradiction`` is too wide to show it,
since among all contacts one in a thousand is read 11 intervals too low."""

LEARNED_SIDE_MM = 4.3
"""Shortest side of a pad that training has: 0.45 of that of a DIGIT (``cltp.data.windows``)."""

LEARNED_EDGE = 1.75
"""Longest edge of a cell that training has, over the usual one: that of a pad of 35 × 26 mm
(``cltp.data.sampler``, GelStereo)."""

LEARNED_PROPORTIONS = (0.6, 3.0)
"""Range of width over height of the pads that training has (``cltp.data.windows``)."""


class Number(NamedTuple):
    """A number with its interval, which holds the truth in nine cases of ten.

    Attributes:
        value: Best estimate.
        low, high: Ends of the interval.
    """

    value: float
    low: float
    high: float


@dataclass(frozen=True, slots=True, kw_only=True)
class TouchReading:
    """What is read of a cloud.

    Attributes:
        state: The most probable words, and the numbers.
        numbers: ``NUMBERS`` with their intervals; forces in newtons of the unit.
        confidence: Probability of each word of the state, by dimension.
        contact: Probability that anything touches.
        flags: Why it is not to be acted on; empty where it may be.
    """

    state: ContactState
    numbers: Mapping[str, Number]
    confidence: Mapping[str, float]
    contact: float
    flags: tuple[Flag, ...]


class TouchReader:
    """Reads clouds.

    Args:
        encoder: E_T.
        heads: Its heads, with intervals.

    Raises:
        TouchError: The heads have no intervals.
    """

    def __init__(self, encoder: TactileEncoder, heads: StateHeads) -> None:
        if not heads.has_intervals:
            raise TouchError(WITHOUT_INTERVALS)
        self._encoder, self._heads = encoder.eval(), heads.eval()

    @torch.inference_mode()
    def read(self, cloud: TactileCloud) -> TouchReading:
        """Read one cloud."""
        layout = self._encoder.config.variant.layout
        points = torch.from_numpy(encoder_input(cloud, layout))[None]
        output = self._heads.read(self._encoder(points).pooled, points)
        scale = cloud.force_scale
        read = readings_of(output, scale.factor, scale.spread)
        return reading_of(read, cloud, self._heads.contradiction)


def reading_of(
    read: HeadReadings,
    cloud: TactileCloud,
    contradiction: Tensor | None = None,
    *,
    commanded_force_n: float | None = None,
) -> TouchReading:
    """The reading of one cloud.

    Args:
        read: What the heads read of it, a batch of one.
        cloud: The cloud.
        contradiction: ``StateHeads.contradiction``; None leaves the depth unchecked.
        commanded_force_n: Force that the gripper was told to grip with [N]; None where none is
            known.
    """
    contact = float(read.touching[0])
    chances = {name: x[0] for name, x in zip(CLASSES, read.words, strict=True)}
    numbers = _numbers(read)
    state = most_probable_state(read, cloud.sensor)
    flags = list(_flags(numbers, cloud))
    measured_mm = contact_state(cloud, in_contact=True).depth_mm if state.in_contact else 0.0
    if Flag.RANGE not in flags and measured_mm > max(LEARNED_DEPTH_MM, numbers["depth_mm"].high):
        flags.append(Flag.RANGE)
    if state.in_contact and contradiction is not None:
        low, high = contradiction.tolist()
        measured = torch.tensor(measured_mm)
        depth = (torch.tensor(end) for end in numbers["depth_mm"])
        if not low <= float(outside(measured, *depth)) <= high:
            flags.append(Flag.CONTRADICTION)
    if state.in_contact and _is_impossible(numbers["force_n"], state, commanded_force_n):
        flags.append(Flag.FORCE)
    return TouchReading(
        state=state,
        numbers=_agreeing(numbers, state),
        confidence={name: float(chance.max()) for name, chance in chances.items()},
        contact=contact,
        flags=tuple(flags),
    )


def numbers_of(read: HeadReadings, state: ContactState) -> dict[str, Number]:
    """The numbers of a state, with the intervals that heads read of the contact, a batch of one.

    An interval reaches as far as its number. Where nothing touches, all are as they are read.
    """
    return _agreeing(_numbers(read), state)


def _agreeing(numbers: Mapping[str, Number], state: ContactState) -> dict[str, Number]:
    """Numbers as they are read, with the values of a state."""
    if not state.in_contact:
        return dict(numbers)
    return {
        name: Number(value, min(value, low), max(value, high))
        for name, (_, low, high) in numbers.items()
        for value in (float(getattr(state, name)),)
    }


def _numbers(read: HeadReadings) -> dict[str, Number]:
    """The numbers of a contact as they are read, a batch of one."""
    ends = torch.cat([read.values, read.low, read.high]).T.tolist()
    return {name: Number(*each) for name, each in zip(NUMBERS, ends, strict=True)}


def most_probable_state(read: HeadReadings, sensor: SensorSpec | None) -> ContactState:
    """The most probable words, and numbers that agree with them, of a contact, a batch of one."""
    if float(read.touching[0]) < 0.5:
        return NO_CONTACT_STATE
    words = {
        name: names[int(chances[0].argmax())]
        for (name, names), chances in zip(CLASSES.items(), read.words, strict=True)
    }
    return state_in_words(read, words, sensor)


def state_in_words(
    read: HeadReadings, words: Mapping[str, str], sensor: SensorSpec | None
) -> ContactState:
    """A contact in words, with the numbers and cut sides that the heads read, a batch of one.

    A word and its number are read apart, and one in 25 contradicts the other: a depth is called
    moderate, and is 0.61 mm. The words are right as often or more often, so that the number becomes
    the nearest one that the word stands for.

    Args:
        read: What the heads read.
        words: A word for each dimension of ``CLASSES``.
        sensor: The sensor; places are as they are read where it is None.
    """
    numbers = dict(zip(NUMBERS, read.values[0].tolist(), strict=True))
    for name, (least, most) in number_limits(words, sensor).items():
        numbers[name] = min(max(numbers[name], least), most)
    return ContactState(
        **numbers,
        depth=Depth(words["depth"]),
        position=Position(words["position"]),
        area=Area(words["area"]),
        shape=Shape(words["shape"]),
        texture=Texture(words["texture"]),
        cut=frozenset(side for side, x in zip(Side, read.cut[0].tolist(), strict=True) if x > 0.5),
    )


def _flags(numbers: Mapping[str, Number], cloud: TactileCloud) -> Iterator[Flag]:
    """What a cloud and the numbers of it say by themselves."""
    if not _is_learned_pad(cloud.sensor):
        yield Flag.PAD
    if is_raised(cloud):
        yield Flag.RAISED
    if is_partial(cloud):
        yield Flag.PARTIAL
    if fine_noise_mm(cloud) > most_noise_mm(cloud):
        yield Flag.NOISE
    if not all(math.isfinite(value) for number in numbers.values() for value in number) or (
        numbers["depth_mm"].value > cloud.sensor.gel_mm
    ):
        yield Flag.RANGE
    elif any(numbers[name].high - numbers[name].low > most for name, most in UNSURE_MM.items()):
        yield Flag.UNSURE


def _is_learned_pad(sensor: SensorSpec) -> bool:
    """Whether weights learn from pads of such a size and such proportions."""
    _, columns = GRID.cells_on(sensor.width_mm, sensor.height_mm)
    edge = sensor.width_mm / columns / UNIT_CELL_MM
    low, high = LEARNED_PROPORTIONS
    return (
        min(sensor.width_mm, sensor.height_mm) >= LEARNED_SIDE_MM
        and edge <= LEARNED_EDGE
        and low <= sensor.width_mm / sensor.height_mm <= high
    )


def _is_impossible(force: Number, state: ContactState, commanded_n: float | None) -> bool:
    """Whether all of a force's interval lies beyond what a command can come to.

    A contact that the pad's edge cuts may show any part of the force.
    """
    if not commanded_n:
        return False
    is_below = not state.cut and force.high < commanded_n / POSSIBLE_RATIO
    return force.low > POSSIBLE_RATIO * commanded_n or is_below


def most_noise_mm(cloud: TactileCloud) -> float:
    """Fine noise above which a cloud is noisier than any of its sensor learned from [mm]."""
    fine_mm = SPREADS.get(cloud.sensor.name, MINI_SPREAD).fine_mm
    return WIDE.factor[1] * fine_mm * (1 + NOISE_ALLOWANCE / math.sqrt(len(cloud.points_mm)))


def fine_noise_mm(cloud: TactileCloud) -> float:
    """Fine noise of a cloud [mm]: of its points, or of cells of ``GRID`` where these hold more.

    Heights are compared with the smooth surface through those around, and the lower quartile is
    taken, which neither a contact nor its texture on most of the pad changes much.
    """
    rows, columns = GRID.cells_on(cloud.sensor.width_mm, cloud.sensor.height_mm)
    if cloud.grid is not None and cloud.grid[0] <= rows and cloud.grid[1] <= columns:
        heights = cloud.points_mm[:, 2].reshape(cloud.grid)
    elif cloud.grid is None and len(cloud.points_mm) < LEAST_FILLED * rows * columns:
        return _spread_mm(_residuals_mm(cloud))
    else:
        heights = height_grid(cloud, GRID)
    across = heights[:, :-2] - 2 * heights[:, 1:-1] + heights[:, 2:]
    down = heights[:-2] - 2 * heights[1:-1] + heights[2:]
    both = across[:-2] - 2 * across[1:-1] + across[2:]
    six = math.sqrt(6)  # of independent heights; ridges along either axis are smooth along it
    return min(_spread_mm(across / six), _spread_mm(down / six), _spread_mm(both / 6))


def _residuals_mm(cloud: TactileCloud) -> NDArray[np.float64]:
    """Heights of loose points less the quadric through those around, as if of the noise alone."""
    points = cloud.points_mm.astype(np.float64)
    some = points[:: max(1, len(points) // _MOST_FITTED)]
    _, nearest = cKDTree(points[:, :2]).query(some[:, :2], k=_FITTED_POINTS + 1)
    around = points[nearest[:, 1:]] - some[:, None]
    x, y, z = np.moveaxis(around, -1, 0)
    weights = np.linalg.pinv(np.stack([np.ones_like(x), x, y, x * x, x * y, y * y], -1))[:, 0]
    return np.asarray((weights * z).sum(axis=1) / np.sqrt(1 + (weights**2).sum(axis=1)))


_MOST_FITTED, _FITTED_POINTS = 512, 14


def _spread_mm(noise_mm: NDArray[np.floating]) -> float:
    """Standard deviation of normal noise, by the lower quartile of its absolute values [mm]."""
    return quantile(np.abs(noise_mm), 0.25) / 0.3186
