"""``tacgrasp ask FILE "question"``: what the language model says about the touch in a file."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import tyro

from tacgrasp.base.errors import UsageError
from tacgrasp.cli.flags import parse


@dataclass(frozen=True)
class Ask:
    """Ask about a cloud (.ply .pcd .xyz .npy .npz) or a height map (.npy .npz), in mm.

    Attributes:
        file: The file.
        question: In plain English, for example "How deep is it pressed?".
        sensor: Whose field it is.
        weights: Folder of weights; without it TACGRASP_WEIGHTS, else those that come along.
    """

    file: tyro.conf.Positional[Path]
    question: tyro.conf.Positional[str]
    sensor: str = "gelsight_mini"
    weights: Path | None = None


def main(argv: Sequence[str]) -> int:
    """Answer one question."""
    flags = parse(Ask, argv, prog="tacgrasp ask")
    from cltp.sensing.touch_files import read_cloud
    from cltp.tactile.sensors import sensor_named
    from policies import PolicyError
    from tacgrasp.console import make_console
    from tacgrasp.policy_factory import load_llm

    touch = read_cloud(flags.file, sensor_named(flags.sensor))
    policy = load_llm(flags.weights)
    try:
        policy.check(flags.question)
    except PolicyError as error:
        raise UsageError(str(error)) from None
    make_console().print(policy.ask(touch, flags.question))
    return 0
