"""The limit of a condition: what an observer with exact heights makes of them under its errors.

The observer sees the whole height map, so that fine noise averages out and missing points are no
loss; it knows where the contact is and its rim. It believes the heights: drift, tilt and depth
scale change its depth, its footprint and the centre of its load. A reader that learned how the gel
at rest goes on under a contact can do better. Shape and texture have no such limit.
"""

from __future__ import annotations

import dataclasses

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import binary_dilation

from cltp.tactile.cloud import grid_axes_mm
from cltp.tactile.sensor_noise import NoiseUnit
from cltp.tactile.sensors import SensorSpec
from cltp.tactile.states import ContactState, area_word, depth_word, position_word

NEAR_MM = 2.0
"""Distance from the true footprint within which the observer looks for it. Our choice."""


def observed_state(
    height_mm: NDArray[np.float32],
    state: ContactState,
    sensor: SensorSpec,
    unit: NoiseUnit,
    rng: np.random.Generator,
) -> ContactState:
    """The state of a contact as the observer reads it.

    Args:
        height_mm: Clean heights (H, W) of the sensing area [mm].
        state: Its true state.
        sensor: The sensor.
        unit: Errors of the unit.
        rng: In the state in which a sampler's generator is once the unit is drawn, so that both
            get the same drift.
    """
    clean = np.asarray(height_mm, dtype=np.float64)
    seen = dataclasses.replace(unit, fine_mm=0.0).apply(height_mm, sensor, rng)
    distorted = seen + float(np.median(clean))  # the observer knows the gel at rest
    count = max(1, round(state.area_fraction * clean.size))
    rim_mm = float(np.partition(clean.ravel(), -count)[-count])
    touching = clean >= rim_mm
    steps = max(1, round(NEAR_MM / sensor.width_mm * clean.shape[1]))
    near = binary_dilation(touching, iterations=steps)
    true_load = np.where(touching, clean - rim_mm + 1e-9, 0.0)
    load = np.where(near, np.clip(distorted - rim_mm, 0.0, None), 0.0)
    peak = np.unravel_index(int(np.argmax(clean)), clean.shape)
    depth_mm = max(0.0, state.depth_mm + float(distorted[peak] - clean[peak]))
    if load.sum() == 0:
        return dataclasses.replace(
            state, depth_mm=depth_mm, depth=depth_word(depth_mm), area_fraction=0.0, force_n=0.0
        )
    (x_mm, y_mm), (true_x_mm, true_y_mm) = (_centre(each, sensor) for each in (load, true_load))
    x_mm, y_mm = state.x_mm + x_mm - true_x_mm, state.y_mm + y_mm - true_y_mm
    fraction = state.area_fraction * float((load > 0).sum() / touching.sum())
    return dataclasses.replace(
        state,
        depth_mm=depth_mm,
        depth=depth_word(depth_mm),
        x_mm=x_mm,
        y_mm=y_mm,
        position=position_word(x_mm, y_mm, sensor),
        area_fraction=fraction,
        area=area_word(fraction),
        force_n=state.force_n * float(load.sum() / true_load.sum()),
    )


def _centre(load: NDArray[np.float64], sensor: SensorSpec) -> tuple[float, float]:
    """Centre of a load (H, W) [mm]."""
    x, y = grid_axes_mm(sensor, *load.shape)
    total = load.sum()
    return float(load.sum(axis=0) @ x / total), float(load.sum(axis=1) @ y / total)
