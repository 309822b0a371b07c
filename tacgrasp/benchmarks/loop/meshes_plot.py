"""Pictures of meshes and of where the fingers close on them."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from cltp.errors import TouchError
from cltp.tactile.cloud import FloatArray
from sim.grasp.antipodal import GraspPlace
from sim.grasp.mesh_bodies import PAD_MM
from sim.objects.meshes import checked_mesh, ray_scene
from tacgrasp.benchmarks.plot_file import write_png

_COLUMNS = 4  # meshes in a row, two views each
_RAYS = 160  # across a view
_FINGER_MM = 5.0  # drawn thickness
_SIDE, _TOP = (2, 1), (0, 2)  # axes of the pad: x along it, y up, z from finger to finger
_UPRIGHT = np.array([[1.0, 0, 0], [0, 0, 1], [0, -1, 0]])


def write_plot(path: Path, meshes: Sequence[tuple[Path, GraspPlace | None, str]]) -> None:
    """Draw each mesh's section through the grasp, with the fingers, from the side and from above.

    Args:
        path: PNG to write.
        meshes: File, grasp and caption of each; those without a grasp show their silhouettes.

    Raises:
        UsageError: The file can't be written.
    """
    rows = math.ceil(len(meshes) / _COLUMNS)
    figure = Figure(figsize=(5.2 * _COLUMNS, 3.1 * rows), layout="constrained")
    cells = figure.subplots(rows, 2 * _COLUMNS, squeeze=False).ravel()
    for axes in cells:
        axes.set_axis_off()
    for i, (mesh, place, caption) in enumerate(meshes):
        _draw(cells[2 * i], cells[2 * i + 1], mesh, place)
        words = "\n".join(textwrap.wrap(caption, 44)[:6])
        cells[2 * i].set_title(f"{mesh.stem}\n{words}", fontsize=8, loc="left")
    write_png(path, figure)


def _draw(side: Axes, top: Axes, path: Path, place: GraspPlace | None) -> None:
    try:
        vertices, faces = checked_mesh(path)
    except TouchError:
        return  # its caption says why
    turn = _UPRIGHT if place is None else place.body_from_mesh
    if place is None:
        centre = (vertices.min(axis=0) + vertices.max(axis=0)) / 2
    else:
        centre = np.array(place.centre_mm)
    points = (vertices - centre) @ turn.T
    scene, tensor = ray_scene(points, faces)
    for axes, across, name in ((side, _SIDE, "side"), (top, _TOP, "from above")):
        _draw_view(axes, across, points, scene, tensor, section=place is not None)
        axes.set_xlabel(name)
    if place is not None:
        half, (pad_x, pad_y) = place.width_mm / 2, PAD_MM
        for near in (half, -half - _FINGER_MM):
            colour = "tab:blue" if near > 0 else "tab:orange"  # the camera's is blue
            side.add_patch(Rectangle((near, -pad_y / 2), _FINGER_MM, pad_y, color=colour))
            top.add_patch(Rectangle((-pad_x / 2, near), pad_x, _FINGER_MM, color=colour))


def _draw_view(
    axes: Axes,
    across: tuple[int, int],
    points: FloatArray,
    scene: Any,
    tensor: Any,
    *,
    section: bool,
) -> None:
    """Silhouette in light grey; the section through the grasp in dark grey."""
    low, high = points.min(axis=0), points.max(axis=0)
    margin = 0.05 * float((high - low).max()) + 8.0
    low, high = low - margin, high + margin
    horizontal, vertical = across
    along = 3 - horizontal - vertical
    u = np.linspace(low[horizontal], high[horizontal], _RAYS)
    v = np.linspace(low[vertical], high[vertical], _RAYS)
    grid = np.zeros((_RAYS, _RAYS, 3))
    grid[..., horizontal], grid[..., vertical] = np.meshgrid(u, v)
    rays = np.concatenate([grid, np.zeros_like(grid)], axis=-1)
    rays[..., along], rays[..., 3 + along] = low[along] - 1.0, 1.0
    hits = scene.cast_rays(tensor(rays.astype(np.float32)))["t_hit"].numpy()
    shade = np.where(np.isfinite(hits), 0.25, 0.0)
    if section:
        inside = scene.compute_occupancy(tensor(grid.astype(np.float32))).numpy() > 0
        shade[inside] = 0.6
    extent = (low[horizontal], high[horizontal], low[vertical], high[vertical])
    axes.imshow(shade, origin="lower", extent=extent, cmap="Greys", vmin=0, vmax=1)
    axes.set_aspect("equal")
