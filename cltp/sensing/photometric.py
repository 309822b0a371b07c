"""Frames to heights: colours become gradients, gradients become a surface. Loads no torch.

Three coloured lamps light the gel from its sides, so the colour at a pixel depends on the tilt of
the gel there, in a way that varies over the sensing area. A small network, calibrated on presses of
a ball, gives for each pixel a matrix M of 2 × 3, and

    (dz/dx, dz/dy) = M(colour change, position) · colour change,

so that the gradient is exactly zero where the colour did not change (our choice: a plain network
has to learn that, and drifts by its error). The surface is the least-squares integral of the
gradients.

The light grows as the gel is pushed towards the lamps, so that a deep press looks steeper than a
shallow one. Colours are divided by that growth before the network reads them, at the depths that
every fourth pixel gives without it.

Source: R. J. Woodham, Photometric method for determining surface orientation (1980); a network per
pixel as customary for GelSight sensors; the form above and the integration are ours.

Not here: training the network (``cltp.train.photometric``), its file
(``cltp.sensing.calibration``).
"""

from __future__ import annotations

from dataclasses import dataclass, field, fields, replace

import numpy as np
from numpy.typing import NDArray
from scipy import fft

from cltp.errors import TouchError
from cltp.sensing.frames import Frame, check_frame
from cltp.tactile.sensors import SensorSpec

FloatArray = NDArray[np.float32]

COLOUR_SCALE = 50.0
"""Grey levels of change that are 1 for the network. Fixed: part of a calibration's version."""

STALE_LEVELS = 20.0
"""Median change of a frame against its background above which the background is stale. Our choice:
it is 2 levels on the frames of ball presses that we have; a failed lamp gives 30."""

_DEPTH_STRIDE = 4  # pixels between those that tell the depths by which colours are divided
_BLOCK = 400  # pixels at a time: small enough that BLAS does not start threads, which only wait


@dataclass(frozen=True, slots=True, kw_only=True)
class GradientNet:
    """The network: 3 colours and 2 coordinates -> H -> H -> 6, rectified.

    Attributes:
        w1: (5, H). Rows: red, green, blue change in ``COLOUR_SCALE``; x and y in [-1, 1].
        b1: (H,).
        w2: (H, H).
        b2: (H,).
        w3: (H, 6). Columns: the rows of M, dz/dx first.
        b3: (6,).
        brightening: (1,). Growth of the light with the depth of the gel [1 / mm].

    Raises:
        TouchError: Shapes don't fit each other, a value is not finite, or light that grows by less
            than nothing or more than twofold.
    """

    w1: FloatArray
    b1: FloatArray
    w2: FloatArray
    b2: FloatArray
    w3: FloatArray
    b3: FloatArray
    brightening: FloatArray = field(default_factory=lambda: np.zeros(1, dtype=np.float32))

    def __post_init__(self) -> None:
        hidden = self.b1.size
        shapes = ((5, hidden), (hidden,), (hidden, hidden), (hidden,), (hidden, 6), (6,), (1,))
        for each, shape in zip(fields(self), shapes, strict=True):
            # in C order: safetensors writes the memory of a transposed array unchanged
            value = np.array(getattr(self, each.name), dtype=np.float32, order="C")
            if hidden == 0 or value.shape != shape or not np.isfinite(value).all():
                raise TouchError(
                    f"calibration: {each.name} must be finite, of shape {shape}, "
                    f"got {value.shape}; calibrate anew"
                )
            value.setflags(write=False)
            object.__setattr__(self, each.name, value)
        if not 0 <= self.brightening[0] <= 1:
            raise TouchError(
                f"calibration: brightening must be 0 to 1 / mm, got {self.brightening[0]:g}; "
                "calibrate anew"
            )


def position_inputs(sensor: SensorSpec) -> FloatArray:
    """Position of each pixel, (rows × columns, 2): x to the right, y to the bottom, in [-1, 1]."""
    x = (np.arange(sensor.columns) + 0.5) / sensor.columns * 2 - 1
    y = (np.arange(sensor.rows) + 0.5) / sensor.rows * 2 - 1
    return np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2).astype(np.float32)


def colour_change(frame: Frame, background: Frame) -> FloatArray:
    """Change of colour against the untouched gel, (rows × columns, 3), in ``COLOUR_SCALE``."""
    change = frame.astype(np.float32) - background.astype(np.float32)
    return change.reshape(-1, 3) * np.float32(1 / COLOUR_SCALE)


def without_brightening(change: FloatArray, depth_mm: FloatArray, brightening: float) -> FloatArray:
    """Changes of colour (N, 3) at depths (N,) [mm], as they would be at the height of the gel.

    ``brightening`` is the growth of the light [1 / mm]; what is raised is left as it is.
    """
    return change / (1 + np.float32(brightening) * np.maximum(depth_mm, 0))[:, None]


class Photometer:
    """Turns the frames of one unit into heights.

    Args:
        net: Network of the unit's calibration.
        background: Frame of the untouched gel, (rows, columns, 3) uint8.
        sensor: The model of the unit.

    Raises:
        TouchError: The background is not a frame of this sensor.
    """

    def __init__(self, net: GradientNet, background: Frame, sensor: SensorSpec) -> None:
        self.sensor = sensor
        self._net = net
        self._background = check_frame(background, sensor, "the background")
        self._position_terms = position_inputs(sensor) @ net.w1[3:] + net.b1  # of every frame

    def with_background(self, background: Frame) -> Photometer:
        """The photometer of the same unit against another frame of its untouched gel.

        Raises:
            TouchError: The background is not a frame of this sensor.
        """
        return Photometer(self._net, background, self.sensor)

    def coarser(self, factor: int, background: Frame) -> Photometer:
        """The photometer of the same unit for frames of fewer, larger pixels.

        Args:
            factor: Edge of a large pixel, in those of the sensor.
            background: Frame of the untouched gel in large pixels.

        Raises:
            TouchError: The background has not this many pixels.
        """
        sensor = replace(
            self.sensor,
            columns=self.sensor.columns // factor,
            rows=self.sensor.rows // factor,
            mm_per_px=self.sensor.mm_per_px * factor,
        )
        return Photometer(self._net, background, sensor)

    def check_background(self, frame: Frame) -> FloatArray:
        """Check that a frame belongs to the background.

        Returns:
            Its change of colour, (rows × columns, 3), in ``COLOUR_SCALE``.

        Raises:
            TouchError: Not a frame of this sensor, or half of it differs from the background.
        """
        frame = check_frame(frame, self.sensor)
        change = colour_change(frame, self._background)
        median = COLOUR_SCALE * float(np.median(np.abs(change[::7])))
        if median > STALE_LEVELS:
            raise TouchError(
                f"half of the frame differs from the background by more than {median:.0f} levels "
                f"(expected below {STALE_LEVELS:.0f}): the background is another unit's, out of "
                "date, or the light has changed; take a new one with nothing touching the gel"
            )
        return change

    def gradients(self, frame: Frame) -> tuple[FloatArray, FloatArray]:
        """Slope of the gel in every pixel.

        Returns:
            dz/dx and dz/d(down), each (rows, columns), mm per mm: x to the right, down along the
            rows (towards -y).

        Raises:
            TouchError: Not a frame of this sensor, or the background doesn't belong to it.
        """
        change = self.check_background(frame)
        if (brightening := float(self._net.brightening[0])) > 0:
            change = without_brightening(change, self._depths(change), brightening)
        slopes = self._slopes(change, self._position_terms)
        shape = (self.sensor.rows, self.sensor.columns)
        return slopes[:, 0].reshape(shape), slopes[:, 1].reshape(shape)

    def _slopes(self, change: FloatArray, position_terms: FloatArray) -> FloatArray:
        """Slopes of pixels by their changes of colour (N, 3): (N, 2)."""
        net, slopes = self._net, np.empty((len(change), 2), dtype=np.float32)
        for start in range(0, len(change), _BLOCK):
            part = slice(start, start + _BLOCK)
            colours = change[part]
            hidden = colours @ net.w1[:3]
            hidden += position_terms[part]
            np.maximum(hidden, 0, out=hidden)
            hidden = hidden @ net.w2
            hidden += net.b2
            np.maximum(hidden, 0, out=hidden)
            matrix = hidden @ net.w3
            matrix += net.b3
            slopes[part, 0] = np.einsum("ij,ij->i", matrix[:, :3], colours)
            slopes[part, 1] = np.einsum("ij,ij->i", matrix[:, 3:], colours)
        return slopes

    def _depths(self, change: FloatArray) -> FloatArray:
        """Depth of the gel at each pixel, by colours as they are: (rows × columns,) [mm]."""
        shape, step = (self.sensor.rows, self.sensor.columns), _DEPTH_STRIDE
        middles = np.ix_(
            *(np.minimum(np.arange(0, size, step) + step // 2, size - 1) for size in shape)
        )
        some = [each.reshape(*shape, -1)[middles] for each in (change, self._position_terms)]
        coarse = some[0].shape[:2]
        slopes = self._slopes(*(each.reshape(-1, each.shape[-1]) for each in some))
        height = integrate(
            slopes[:, 0].reshape(coarse), slopes[:, 1].reshape(coarse), step * self.sensor.mm_per_px
        )
        height -= np.median(height)
        return height.repeat(step, 0).repeat(step, 1)[: shape[0], : shape[1]].ravel()

    def heights(self, frame: Frame) -> FloatArray:
        """Surface of the gel, (rows, columns), float32 [mm]: positive into the gel, median zero.

        The zero is the frame's median: a frame alone does not show a gel that is sunk all over.

        Raises:
            TouchError: As ``gradients``.
        """
        height = integrate(*self.gradients(frame), self.sensor.mm_per_px)
        return height - np.median(height)


def integrate(slope_x: FloatArray, slope_down: FloatArray, mm_per_px: float) -> FloatArray:
    """The surface whose slopes are nearest to these in the root mean square; its mean is zero.

    The difference between neighbouring pixels is the mean of their two slopes. Minimising the
    squared misfit of all differences gives a Poisson equation whose natural boundary conditions
    carry the slopes across (Neumann, not zero), so a contact cut by the border isn't bent flat
    there; the type-II cosine transform diagonalises it exactly. Slopes are (H, W), mm per mm; the
    result is (H, W) [mm], with their dtype.
    """
    across = 0.5 * mm_per_px * (slope_x[:, 1:] + slope_x[:, :-1])
    down = 0.5 * mm_per_px * (slope_down[1:] + slope_down[:-1])
    return integrate_differences(across, down)


def integrate_differences(across: FloatArray, down: FloatArray) -> FloatArray:
    """The surface (H, W) [mm] with these differences, by least squares; its mean is zero.

    ``across`` (H, W - 1) is each pixel's right neighbour minus itself, ``down`` (H - 1, W) its
    lower neighbour minus itself [mm].
    """
    rows, columns = across.shape[0], down.shape[1]
    divergence = np.zeros((rows, columns), dtype=across.dtype)
    divergence[:, :-1] += across
    divergence[:, 1:] -= across
    divergence[:-1] += down
    divergence[1:] -= down
    waves = fft.dctn(divergence, type=2, overwrite_x=True)
    eigen_x = 2 * np.cos(np.pi * np.arange(columns) / columns) - 2
    eigen_y = 2 * np.cos(np.pi * np.arange(rows) / rows) - 2
    eigen = eigen_y[:, None] + eigen_x[None, :]
    eigen[0, 0] = 1
    waves[0, 0] = 0  # the mean, which differences do not determine
    waves /= eigen.astype(waves.dtype)
    return fft.idctn(waves, type=2, overwrite_x=True)
