"""The flags that ``describe`` and ``ask`` name a contact by, and its contract in words.

Not here: reading the contact (``tacgrasp.playback.contact_file``).
"""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import tyro

from tacgrasp.cli.incomplete import warn_of_gaps

if TYPE_CHECKING:
    from primitives.contract import Contract
    from tacgrasp.playback.contact_file import ContactFile


@dataclass(frozen=True)
class ContactFlags:
    """One contact out of a file.

    Attributes:
        file: Cloud, height map, a frame of the sensor's camera (.png .jpg .bmp), or an episode.
        step: Number of the step of an episode; by default the last one.
        sensor: Name of the sensor that the file is from.
        background: For a frame: a frame of the same sensor unit with an untouched gel.
        calibration: For a frame: calibration of its sensor unit; by default the shipped one.
    """

    file: tyro.conf.Positional[Path]
    step: int | None = None
    sensor: str = "gelsight_mini"
    background: Path | None = None
    calibration: Path | None = None

    def read(self) -> ContactFile:
        """Read the contact; errors as for ``tacgrasp.playback.contact_file.read_contact``.

        What an episode lacks is told on standard error: its last step may be missing.
        """
        from tacgrasp.playback.contact_file import read_contact

        contact = read_contact(
            self.file,
            self.sensor,
            background=self.background,
            calibration=self.calibration,
            step=self.step,
        )
        if contact.episode is not None:
            warn_of_gaps(contact.episode, self.file)
        return contact

    def contract_in_words(
        self, contact: ContactFile, instruction: str | None, task: str | None = None
    ) -> Contract:
        """Contract of an instruction for a task, or for the run that a contact was recorded in.

        Args:
            contact: The contact.
            instruction: The instruction; None takes the task's own.
            task: Name or path; None takes an instruction for the episode's run, where there is
                one, and the usual task otherwise.

        Raises:
            UsageError: No such task, or the instruction is refused.
            EpisodeError: The episode's configuration is of another version.
        """
        from tacgrasp.base.errors import UsageError
        from tacgrasp.config.layers import load
        from tacgrasp.config.terms import worded_contract
        from tacgrasp.playback.replay import config_of

        if task is None and instruction is not None and contact.episode is not None:
            config, sources = config_of(contact.episode, self.file), None
        else:
            config, sources = load(task, None, os.environ)
        contract = worded_contract(instruction or config.instruction, config, sources)
        if contract.refused:
            raise UsageError(f"the instruction is refused: {contract.refused}")
        return contract
