"""``tacgrasp ask FILE "question"``: the language model answers a question about a contact."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import tyro

from tacgrasp.base.errors import UsageError
from tacgrasp.cli.flags import parse


@dataclass(frozen=True)
class AskFlags:
    """Answer a question about a cloud (.ply .pcd .xyz .npy .npz) or height map (.npy .npz).

    In mm, positive into the gel, with the untouched gel at 0.

    Attributes:
        file: Cloud or height map.
        question: Question in plain English, for example "How deep is it pressed?".
        sensor: Name of the sensor that the file is from.
        weights: Folder of weights; by default TACGRASP_WEIGHTS, else the shipped weights.
    """

    file: tyro.conf.Positional[Path]
    question: tyro.conf.Positional[str]
    sensor: str = "gelsight_mini"
    weights: Path | None = None


def main(argv: Sequence[str]) -> int:
    """Answer one question."""
    flags = parse(AskFlags, argv, prog="tacgrasp ask")
    from cltp.sensing.touch_files import read_cloud
    from cltp.tactile.sensors import sensor_named
    from policies import PolicyError
    from tacgrasp.console import make_console, working
    from tacgrasp.playback.describe import is_touched
    from tacgrasp.policy_factory import load_llm

    cloud = read_cloud(flags.file, sensor_named(flags.sensor))
    with working("loading the language model"):
        policy = load_llm(flags.weights)
    try:
        policy.check(flags.question)
    except PolicyError as error:
        raise UsageError(str(error)) from None
    answer = policy.ask(cloud, flags.question) if is_touched(cloud) else "Nothing touches the gel."
    make_console().print(answer)
    return 0
