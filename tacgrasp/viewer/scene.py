"""A step as rerun shows it: the gel on the arm in metres, pictures, forces and what was said.

Entities:

    base/tcp/gel            the arm's pose with its axes, and the gel on it [m]
    base/tcp/gel/surface    the deformed surface, in the colours of its depth
    base/tcp/gel/contact    where the contact is, and how deep
    touch/heights           the heights with their colour scale
    touch/camera            the camera's frame; without a camera the gel as one would see it
    force/...               felt with its interval, the goal band, the limit, the command [N]
    text                    D_t and what was done

Not here: where the stream goes (``tacgrasp.viewer.server``), episodes as MCAP, which rerun opens
by itself (``tacgrasp.episodes.view_messages``).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from cltp.sensing.frames import frame_of_jpeg
from cltp.tactile.cells import pictured_heights
from cltp.tactile.cloud import FloatArray, TactileCloud, grid_axes_mm
from cltp.tactile.measure import contact_state
from cltp.tactile.picture import DEPTH_PALETTE, depth_levels, picture
from primitives.contract import Contract
from primitives.devices import GripperState, Pose
from primitives.execution import PadAxes
from tacgrasp.console import action_text
from tacgrasp.episodes.height_image import height_image
from tacgrasp.episodes.record import EpisodeEnd, StepRecord, end_label
from tacgrasp.episodes.view_messages import numbers, quaternion, tcp_from_gel

if TYPE_CHECKING:
    import rerun as rr

APPLICATION = "tacgrasp"
GEL = "base/tcp/gel"
FORCES = {  # name, colour and width of each line
    "felt": ("felt_n", (200, 85, 61), 3.0),
    "felt_low": ("felt_low_n", (226, 160, 140), 1.0),
    "felt_high": ("felt_high_n", (226, 160, 140), 1.0),
    "goal_low": ("goal_low_n", (47, 125, 79), 1.5),
    "goal_high": ("goal_high_n", (47, 125, 79), 1.5),
    "limit": ("limit_n", (179, 38, 30), 2.0),
    "commanded": ("commanded_n", (31, 111, 139), 1.0),
}
"""Lines of the force plot: number of ``tacgrasp.episodes.view_messages``, colour, width."""

CAMERA_PX = 240
"""Width of the picture of a gel without a camera."""


class RerunScene:
    """Logs steps to a rerun stream.

    Args:
        stream: The stream, with a sink.
        contract: Contract of the episode; None for a sensor that is only watched.
        pad: The pad's axes in the TCP frame; None leaves the gel in a frame of its own.
    """

    def __init__(
        self, stream: rr.RecordingStream, contract: Contract | None, pad: PadAxes | None
    ) -> None:
        import rerun

        self._rr: Any = rerun
        self._stream, self._contract, self._pad = stream, contract, pad
        self._started_s: float | None = None
        self._log_styles()

    def step(self, record: StepRecord) -> None:
        """Log one step."""
        self._contract = record.contract or self._contract
        self._at(record.stamp.monotonic_s, record.index)
        self._arm(record.tcp_pose, record.gripper)
        self._touch(record.cloud, record.in_contact, record.camera_jpeg)
        known = numbers(record, self._contract)
        for name, (number, _, _) in FORCES.items():
            if number in known:
                self._stream.log(f"force/{name}", self._rr.Scalars(known[number]))
        parts = [action_text(record), record.decision.text if record.decision else "", record.note]
        level = "WARN" if record.note else "INFO"
        text = " | ".join(filter(None, parts))
        self._stream.log("text", self._rr.TextLog(text, level=level))

    def end(self, end: EpisodeEnd) -> None:
        """Log how the episode ended."""
        self._at(end.stamp.monotonic_s, None)
        label = end_label(end.reason, end.truth)
        level = "INFO" if label == "success" else "WARN"
        self._stream.log("text", self._rr.TextLog(f"end: {label} - {end.message}", level=level))

    def reading(
        self,
        at_s: float,
        number: int,
        cloud: TactileCloud,
        arm: tuple[Pose, GripperState] | None,
        jpeg: bytes | None,
    ) -> None:
        """Log a reading of a sensor, and of the arm where there is one, outside an episode."""
        self._at(at_s, number)
        if arm is not None:
            self._arm(*arm)
        self._touch(cloud, None, jpeg)
        state = contact_state(cloud)
        force_n = state.force_n if state.in_contact else 0.0
        self._stream.log("force/felt", self._rr.Scalars(force_n))

    def _at(self, monotonic_s: float, step: int | None) -> None:
        if self._started_s is None:
            self._started_s = monotonic_s
        self._stream.set_time("time", duration=monotonic_s - self._started_s)
        if step is not None:
            self._stream.set_time("step", sequence=step)

    def _arm(self, pose: Pose, gripper: GripperState) -> None:
        rr = self._rr
        self._transform("base/tcp", pose.position_m, quaternion(pose.rotvec_rad))
        if self._pad is not None:
            self._transform(GEL, *tcp_from_gel(self._pad, gripper.width_m))
        self._stream.log("force/opening_mm", rr.Scalars(1000 * gripper.width_m))

    def _transform(self, entity: str, position_m: FloatArray, turn: FloatArray) -> None:
        rr = self._rr
        rotation = rr.Quaternion(xyzw=turn)
        self._stream.log(entity, rr.Transform3D(translation=position_m, quaternion=rotation))

    def _touch(self, cloud: TactileCloud, in_contact: bool | None, jpeg: bytes | None) -> None:
        rr, cells_mm = self._rr, pictured_heights(cloud)
        vertices_m, triangles = surface(cells_mm, cloud)
        colours = DEPTH_PALETTE[depth_levels(cells_mm.ravel())]
        mesh = rr.Mesh3D(
            vertex_positions=vertices_m, triangle_indices=triangles, vertex_colors=colours
        )
        self._stream.log(f"{GEL}/surface", mesh)
        self._contact(cloud, in_contact)
        self._stream.log("touch/heights", rr.Image(DEPTH_PALETTE[height_image(cloud)]))
        if jpeg is not None:
            frame = frame_of_jpeg(jpeg)
        else:
            frame = picture(cells_mm, cloud.sensor, CAMERA_PX)  # as a camera would see it
        self._stream.log("touch/camera", rr.Image(frame))

    def _contact(self, cloud: TactileCloud, in_contact: bool | None) -> None:
        rr, state = self._rr, contact_state(cloud, in_contact=in_contact)
        if not state.in_contact:
            self._stream.log(f"{GEL}/contact", rr.Clear(recursive=False))
            return
        place_m = np.array([[state.x_mm, state.y_mm, state.depth_mm]]) / 1000
        label = f"{state.depth_mm:.2f} mm"
        points = rr.Points3D(place_m, radii=0.0004, colors=(255, 255, 255), labels=[label])
        self._stream.log(f"{GEL}/contact", points)

    def _log_styles(self) -> None:
        rr, stream = self._rr, self._stream
        stream.log("base", rr.ViewCoordinates.RIGHT_HAND_Z_UP, static=True)
        for entity, length_m in (("base/axes", 0.05), ("base/tcp/axes", 0.02)):
            colours = [(200, 60, 50), (60, 150, 70), (60, 90, 200)]  # x, y, z
            axes = rr.Arrows3D(vectors=length_m * np.eye(3), colors=colours, radii=0.0008)
            stream.log(entity, axes, static=True)
        for name, (_, colour, width) in FORCES.items():
            lines = rr.SeriesLines(names=name.replace("_", " "), colors=colour, widths=width)
            stream.log(f"force/{name}", lines, static=True)
        stream.send_blueprint(blueprint())


def surface(cells_mm: FloatArray, cloud: TactileCloud) -> tuple[FloatArray, NDArray[np.int64]]:
    """Vertices [m] and triangles of the deformed surface, gel frame; row 0 of the cells is +y."""
    rows, columns = cells_mm.shape
    x, y = np.meshgrid(*grid_axes_mm(cloud.sensor, rows, columns))
    vertices_m = np.stack([x, y, cells_mm], axis=-1).reshape(-1, 3) / 1000
    index = np.arange(rows * columns).reshape(rows, columns)
    corner, right = index[:-1, :-1].ravel(), index[:-1, 1:].ravel()
    below, across = index[1:, :-1].ravel(), index[1:, 1:].ravel()
    triangles = np.concatenate(
        [np.stack([corner, below, right], axis=1), np.stack([right, below, across], axis=1)]
    )
    return vertices_m, triangles


def blueprint() -> Any:
    """What is shown where: the gel and the arm, the pictures, the forces and the text."""
    from rerun import blueprint as rrb

    forces = [f"force/{name}" for name in FORCES]
    return rrb.Blueprint(
        rrb.Horizontal(
            rrb.Vertical(
                rrb.Spatial3DView(name="gel [m]", origin=GEL),
                rrb.Spatial3DView(name="arm and gel [m]", origin="base"),
            ),
            rrb.Vertical(
                rrb.Spatial2DView(name="heights", origin="touch/heights"),
                rrb.Spatial2DView(
                    name="camera (computed where there is none)", origin="touch/camera"
                ),
            ),
            rrb.Vertical(
                rrb.TimeSeriesView(name="force [N]", origin="force", contents=forces),
                rrb.TextLogView(name="said and done", origin="text"),
            ),
            column_shares=[2, 1.3, 2],
        ),
        collapse_panels=True,
    )
