"""The shear field of a step comes back from the file bit for bit; a step without one has none."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from cltp.errors import TouchError
from cltp.sensing.taxel_packets import MAX_TAXELS
from cltp.tactile.cloud import Stamp
from cltp.tactile.shear.field import ShearField
from tacgrasp.episodes import EpisodeWriter, read_episode
from tacgrasp.episodes.codec import to_json
from tacgrasp.episodes.record import MAX_JSON_BYTES, MAX_SHEAR_BYTES
from tacgrasp.episodes.touch_message import ShearMessage
from tests.fakes.episode_samples import SENSOR, end, header, step_record

NOW = Stamp(monotonic_s=12.125, wall_s=1.7e9)


def field(*, with_forces: bool) -> ShearField:
    rng = np.random.default_rng(0)
    return ShearField(
        positions_mm=rng.uniform(-5, 5, (63, 2)).astype(np.float32),
        displacement_mm=rng.normal(0, 0.1, (63, 3)).astype(np.float32),
        force_n=rng.normal(0, 0.01, (63, 3)).astype(np.float32) if with_forces else None,
        sensor=SENSOR,
        stamp=NOW,
    )


def test_a_field_with_and_one_without_forces_come_back_bit_for_bit(tmp_path: Path) -> None:
    fields = [field(with_forces=True), None, field(with_forces=False)]
    with EpisodeWriter(tmp_path / "e.mcap", header()) as writer:
        for index, each in enumerate(fields):
            writer.write_step(replace(step_record(index), shear=each))
        writer.finish(end())
    first, second, third = (step.shear for step in read_episode(tmp_path / "e.mcap").steps)
    assert second is None
    assert first is not None and third is not None
    for read, wanted in ((first, fields[0]), (third, fields[2])):
        assert wanted is not None
        assert read.positions_mm.tobytes() == wanted.positions_mm.tobytes()
        assert read.displacement_mm.tobytes() == wanted.displacement_mm.tobytes()
        assert (read.stamp, read.sensor) == (NOW, SENSOR)
    assert first.force_n is not None and fields[0] is not None and fields[0].force_n is not None
    assert first.force_n.tobytes() == fields[0].force_n.tobytes()
    assert third.force_n is None


def test_a_field_of_many_taxels_is_read_again(tmp_path: Path) -> None:
    rng = np.random.default_rng(0)
    many = ShearField(
        positions_mm=rng.uniform(-5, 5, (15_000, 2)).astype(np.float32),
        displacement_mm=rng.normal(0, 1e-5, (15_000, 3)).astype(np.float32),
        force_n=rng.normal(0, 1e-5, (15_000, 3)).astype(np.float32),
        sensor=SENSOR,
        stamp=NOW,
    )
    with EpisodeWriter(tmp_path / "e.mcap", header()) as writer:
        writer.write_step(replace(step_record(0), shear=many))
        writer.finish(end())
    read = read_episode(tmp_path / "e.mcap").steps[0].shear
    assert read is not None
    assert read.displacement_mm.tobytes() == many.displacement_mm.tobytes()
    text = json.dumps(to_json(ShearMessage.of(many, index=0, stamp=NOW)))
    assert MAX_JSON_BYTES < len(text) < MAX_SHEAR_BYTES * len(many.positions_mm) / MAX_TAXELS + 2e6


def test_numbers_that_are_no_points_are_refused() -> None:
    message = ShearMessage.of(field(with_forces=False), index=0, stamp=NOW)
    with pytest.raises(ValueError, match="reshape"):
        replace(message, positions_mm=message.positions_mm[:-1]).field(SENSOR)
    with pytest.raises(TouchError, match="as many as"):
        replace(message, displacement_mm=message.displacement_mm[:-3]).field(SENSOR)
