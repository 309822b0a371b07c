"""``tacgrasp view EPISODE | --rig R | --sensor R``: see it in rerun's viewer; nothing moves."""

from __future__ import annotations

import math
import os
from collections.abc import Sequence
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import tyro

from tacgrasp.base.errors import UsageError
from tacgrasp.cli.flags import parse

if TYPE_CHECKING:
    import rerun as rr

    from tacgrasp.config.schema import RunConfig
    from tacgrasp.viewer.server import Viewer


@dataclass(frozen=True)
class ViewFlags:
    """See an episode, or a rig or its sensor live, in rerun's viewer; nothing moves.

    A window opens; without a display, or with --web, the address of a page for a browser on this
    computer is printed.

    Attributes:
        episode: The .mcap file of an episode.
        rig: Name of a rig, or path of its YAML file: sensor, arm and gripper, live.
        sensor: The same for the sensor alone; arm and gripper are left alone.
        seed: Random seed of a simulated rig.
        seconds: Time of a live view [s]; until Ctrl-C when not given.
        web: Show a page for a browser in place of a window.
    """

    episode: tyro.conf.Positional[Path | None] = None
    rig: str | None = None
    sensor: str | None = None
    seed: int = 0
    seconds: float = math.inf
    web: bool = False

    def __post_init__(self) -> None:
        given = [each for each in (self.episode, self.rig, self.sensor) if each is not None]
        if len(given) != 1:
            raise UsageError(
                f"name one thing to see: EPISODE, --rig R or --sensor R; got {len(given)}; "
                "`tacgrasp episodes ls` lists the episodes"
            )
        if not self.seconds > 0:
            raise UsageError(f"--seconds must be above 0, got {self.seconds:g}")


def main(argv: Sequence[str]) -> int:
    """Open the viewer and show it."""
    flags = parse(ViewFlags, argv, prog="tacgrasp view")
    from tacgrasp.console import make_console, working
    from tacgrasp.viewer.server import Viewer, has_display, require_rerun

    require_rerun()
    if flags.episode is not None and not flags.episode.is_file():
        raise UsageError(
            f"{flags.episode} does not exist; `tacgrasp episodes ls` lists those that do"
        )
    console = make_console()
    with working("starting the viewer"):
        viewer = Viewer(web=flags.web or not has_display())
    try:
        if viewer.page:
            console.print(f"open {viewer.page} in a browser on this computer; Ctrl-C ends")
        num_shown = _show(flags, viewer)
        console.print(f"{num_shown} {'steps' if flags.episode else 'readings'} shown")
        if flags.episode is not None:
            viewer.wait()
    finally:
        viewer.close()
    return 0


def _show(flags: ViewFlags, viewer: Viewer) -> int:
    from tacgrasp.cli.incomplete import read_and_warn
    from tacgrasp.config.layers import load
    from tacgrasp.viewer.show import show_episode

    if flags.episode is not None:
        stream = viewer.stream(flags.episode.stem)
        num_steps = show_episode(read_and_warn(flags.episode), stream)
        stream.flush()
        return num_steps

    config, _ = load(None, flags.rig or flags.sensor, os.environ)
    hardware = None if config.hardware is None else config.hardware.without_start_pose()
    config = config.model_copy(update={"seed": flags.seed, "hardware": hardware, "dry_run": True})
    return _show_live(config, viewer.stream("live"), flags)


def _show_live(config: RunConfig, stream: rr.RecordingStream, flags: ViewFlags) -> int:
    from tacgrasp.console import working
    from tacgrasp.rig.factory import make_rig
    from tacgrasp.rig.hardware import connect_sensor
    from tacgrasp.viewer.show import show_rig, show_sensor

    with ExitStack() as stack:
        if flags.sensor is not None and config.devices == "hardware" and config.hardware:
            sensor = connect_sensor(config.hardware.sensor)
            stack.callback(sensor.disconnect)
            return show_sensor(sensor, stream, flags.seconds)
        with working("connecting the rig"):
            rig = make_rig(config)
        stack.callback(rig.disconnect)
        if flags.sensor is not None:
            return show_sensor(rig.sensor, stream, flags.seconds)
        return show_rig(rig, config, stream, flags.seconds)
