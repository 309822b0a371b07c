"""``tacgrasp describe FILE``: a contact in words and numbers, measured and by the model."""

from __future__ import annotations

import json
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from tacgrasp.cli.contact_flags import ContactFlags
from tacgrasp.cli.flags import parse


@dataclass(frozen=True)
class DescribeFlags(ContactFlags):
    """Describe the contact in a cloud (.ply .pcd .xyz .npy .npz) or height map (.npy .npz).

    In mm, positive into the gel, with the untouched gel at 0.

    A frame of the sensor's camera (.png .jpg .bmp) needs its background too. Of an episode (.mcap)
    it is the contact of one step, under that step's contract.

    Attributes:
        instruction: Instruction that the model advises on; by default the episode's, else the
            strawberry's.
        weights: Folder of weights; by default TACGRASP_WEIGHTS, else the shipped weights.
        json: Print one JSON object instead: state, numbers with their intervals, contact, flags.
    """

    instruction: str | None = None
    weights: Path | None = None
    json: bool = False


def main(argv: Sequence[str]) -> int:
    """Describe one file."""
    flags = parse(DescribeFlags, argv, prog="tacgrasp describe")
    from cltp.sensing.touch_files import path_in_errors
    from cltp.tactile.contact.raised_pad import is_raised
    from tacgrasp.console import make_console, working
    from tacgrasp.playback.describe import (
        describe,
        describe_by_model,
        describe_in_numbers,
        make_reader,
        touches,
    )
    from tacgrasp.policy_factory import default_weights, load_llm, shipped_weights

    console = make_console()
    contact = flags.read()
    cloud, contract, in_contact = contact.cloud, contact.contract, contact.in_contact
    with path_in_errors(flags.file):
        touched = touches(cloud, in_contact)
    if flags.json:
        reader = make_reader(flags.weights or default_weights())
        numbers = describe_in_numbers(cloud, reader, in_contact)
        sys.stdout.write(json.dumps(numbers, indent=2) + "\n")
        return 0
    if contact.about:
        console.print(f"step      {contact.about}")
    for line in describe(cloud, in_contact):
        console.print(line)
    if is_raised(cloud) or not touched:
        return 0
    weights = flags.weights or default_weights()
    if weights == shipped_weights() and not weights.is_dir():
        console.print(
            f"model     none: no weights in {weights}; train them with `tacgrasp train all` and "
            "name their folder with --weights"
        )
        return 0
    if contract is None or flags.instruction is not None:
        contract = flags.contract_in_words(contact, flags.instruction)
    with working("loading the language model"):
        model = load_llm(weights)
    for line in describe_by_model(cloud, model, contract, in_contact):
        console.print(line)
    return 0
