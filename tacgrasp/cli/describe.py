"""``tacgrasp describe FILE``: a touch in words and numbers, measured and as the model says it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import tyro

from tacgrasp.base.errors import UsageError
from tacgrasp.cli.flags import parse


@dataclass(frozen=True)
class Describe:
    """Say what a cloud (.ply .pcd .xyz .npy .npz) or a height map (.npy .npz), in mm, is.

    Or a frame of the sensor's camera (.png .jpg .bmp), with its background.

    Attributes:
        file: The file.
        sensor: Whose field it is.
        background: For a frame: another of the same unit with nothing touching it.
        calibration: For a frame: of its unit; without it the one that comes along.
        instruction: What the model's advice is for; without it that of the strawberry.
        weights: Folder of weights; without it TACGRASP_WEIGHTS, else those that come along.
    """

    file: tyro.conf.Positional[Path]
    sensor: str = "gelsight_mini"
    background: Path | None = None
    calibration: Path | None = None
    instruction: str | None = None
    weights: Path | None = None


def main(argv: Sequence[str]) -> int:
    """Describe one file."""
    flags = parse(Describe, argv, prog="tacgrasp describe")
    from cltp.sensing.touch_files import read_cloud
    from cltp.tactile.sensors import sensor_named
    from policies import PolicyError
    from tacgrasp.config.layers import load
    from tacgrasp.console import make_console
    from tacgrasp.playback.describe import describe, said
    from tacgrasp.policy_factory import default_weights, load_llm, shipped_weights

    to = make_console()
    touch = read_cloud(
        flags.file,
        sensor_named(flags.sensor),
        background=flags.background,
        calibration=flags.calibration,
    )
    for line in describe(touch):
        to.print(line)
    weights = flags.weights or default_weights()
    if weights == shipped_weights() and not weights.is_dir():
        to.print(
            f"model     none: no weights in {weights}; train them with `tacgrasp train all` and "
            "name their folder with --weights"
        )
        return 0
    instruction = flags.instruction
    if instruction is None:
        instruction = load("strawberry")[0].instruction
    model = load_llm(weights)
    try:
        model.check(instruction)
    except PolicyError as error:
        raise UsageError(f"--instruction: {error}") from None
    for line in said(touch, model, instruction):
        to.print(line)
    return 0
