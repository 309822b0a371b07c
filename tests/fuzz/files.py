"""Files and texts that come from elsewhere: clouds, episodes, YAML, and what a policy said."""

from __future__ import annotations

import datetime
import io
import json
import tempfile
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from pathlib import Path
from random import Random
from typing import Any

import numpy as np
import yaml
from mcap.writer import CompressionType, Writer
from PIL import Image
from rich.console import Console

from cltp.errors import TouchError
from cltp.sensing.frames import FRAME_SUFFIXES, read_frame
from cltp.sensing.touch_files import read_cloud
from cltp.tactile.sensors import SENSORS
from policies.extraction import extract
from primitives.errors import RobotError
from tacgrasp.base.errors import UsageError
from tacgrasp.config.layers import load_with_limits
from tacgrasp.console import StepPrinter, truth_text
from tacgrasp.drivers.dynamixel.calibration import GripperCalibration, load_calibration
from tacgrasp.episodes import EpisodeError, read_episode
from tacgrasp.episodes.codec import to_json
from tacgrasp.episodes.listing import info, table
from tacgrasp.episodes.record import (
    FORMAT,
    JSON_MESSAGES,
    METADATA_NAME,
    ActionMessage,
    DecisionMessage,
    StepState,
    Topic,
)
from tacgrasp.episodes.recover import recover
from tacgrasp.episodes.touch_message import encode_cloud
from tacgrasp.playback.replay import config_of
from tests.fakes.episode_samples import end, header, step_record
from tests.fuzz.mutate import mutated
from tests.fuzz.target import FuzzTarget
from tests.paths import ROOT

MINI = SENSORS["gelsight_mini"]


@cache
def _folder() -> Path:
    """A folder in memory, where there is one, that ends with this process."""
    memory = Path("/dev/shm")
    _folder.kept = tempfile.TemporaryDirectory(dir=memory if memory.is_dir() else None)  # type: ignore[attr-defined]
    return Path(_folder.kept.name)  # type: ignore[attr-defined]


def _file(name: str, content: bytes) -> Path:
    path = _folder() / name
    path.write_bytes(content)
    return path


def _saved(save: Callable[[io.BytesIO], object]) -> bytes:
    file = io.BytesIO()
    save(file)
    return file.getvalue()


# -- clouds: the first byte names the format ------------------------------------------------------

_SUFFIXES = (".ply", ".pcd", ".xyz", ".npy", ".npz", ".png", ".jpg")
_CLOUD_WORDS = (
    b"ply\n",
    b"format ascii 1.0\n",
    b"format binary_big_endian 1.0\n",
    b"element vertex ",
    b"element face 9\n",
    b"property float x\n",
    b"property list uchar int x\n",
    b"property\n",
    b"end_header\n",
    b"FIELDS x y z\n",
    b"SIZE 1 2 4 8\n",
    b"TYPE F I U\n",
    b"COUNT 300000000 1 1\n",
    b"POINTS 999999\n",
    b"DATA ascii\n",
    b"DATA binary_compressed\n",
    b"DATA binary\n",
    b"'<f8'",
    b"'|O'",
    b"'<U9999999'",
    b"(1200000000,)",
    b"True",
    b"'fortran_order'",
    b"PK\x01\x02",
    b"PK\x03\x04",
    b"PK\x05\x06",
    b"IDAT",
    b"nan ",
    b"\xff\xfe",
)


@cache
def _clouds() -> tuple[tuple[int, bytes], ...]:
    y, x = np.mgrid[-7:7:9j, -9:9:9j]
    points = np.stack([x, y, 0.5 * np.exp(-(x**2 + y**2) / 8)], axis=-1).reshape(-1, 3)
    rows = "".join(f"{a:.3f} {b:.3f} {c:.3f}\n" for a, b, c in points).encode()
    floats = points.astype("<f4").tobytes()
    ply = "ply\nformat {} 1.0\nelement vertex 81\n{}end_header\n"
    names = "".join(f"property float {axis}\n" for axis in "xyz")
    pcd = "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nPOINTS 81\nDATA {}\n"
    heights = np.zeros((24, 32), dtype=np.float32)
    image = Image.new("RGB", (320, 240), (90, 120, 60))
    contents = (
        (".ply", ply.format("ascii", names).encode() + rows),
        (".ply", ply.format("binary_little_endian", names).encode() + floats),
        (".pcd", pcd.format("ascii").encode() + rows),
        (".pcd", pcd.format("binary").encode() + floats),
        (".xyz", rows),
        (".npy", _saved(lambda file: np.save(file, points))),
        (".npy", _saved(lambda file: np.save(file, heights))),
        (".npz", _saved(lambda file: np.savez(file, points_mm=points, other=heights))),
        (".npz", _saved(lambda file: np.savez_compressed(file, height_mm=heights))),
        (".png", _saved(lambda file: image.save(file, "png"))),
        (".png", _saved(lambda file: image.convert("P").save(file, "png"))),
        (".jpg", _saved(lambda file: image.save(file, "jpeg"))),
    )
    return tuple((_SUFFIXES.index(suffix), content) for suffix, content in contents)


def _cloud_case(rng: Random) -> bytes:
    kind, content = rng.choice(_clouds())
    if rng.random() < 0.02:
        kind = rng.randrange(len(_SUFFIXES))
    return bytes([kind]) + mutated(rng, content, _CLOUD_WORDS)


def _read_cloud(data: bytes) -> None:
    suffix = _SUFFIXES[data[0] % len(_SUFFIXES)]
    path = _file(f"touch{suffix}", data[1:])
    if suffix in FRAME_SUFFIXES:
        read_frame(path, MINI)
    else:
        read_cloud(path, MINI)


# -- episodes: bytes of whole files, and messages in sound files ----------------------------------

Messages = list[tuple[int, Topic, bytes]]
"""Sequence number, channel and bytes of each message."""


@cache
def _messages() -> Messages:
    def packed(value: object) -> bytes:
        return json.dumps(to_json(value)).encode()

    config = load_with_limits("strawberry")[0].model_dump(mode="json")
    first = replace(header(), config_yaml=yaml.safe_dump(config, sort_keys=False))
    messages = [(0, Topic.EPISODE, packed(first))]
    for index in range(2):
        step = step_record(index)
        common: dict[str, Any] = {"index": index, "stamp": step.stamp}
        state = StepState(
            **step.shared(),
            cloud_stamp=step.cloud.stamp,
            tick_ms=step.step_ms,
            force_scale=step.cloud.force_scale,
        )
        decision = DecisionMessage(**common, decision=step.decision)
        messages += [
            (index + 1, Topic.CLOUD, encode_cloud(step.cloud, step.stamp)),
            (index + 1, Topic.DECISION, packed(decision)),
            (index + 1, Topic.ACTION, packed(ActionMessage(**common, executed=step.executed))),
            (index + 1, Topic.STATE, packed(state)),
        ]
    return [*messages, (3, Topic.END, packed(end()))]


def _mcap(
    messages: Messages,
    compression: CompressionType = CompressionType.NONE,
    *,
    checked: bool = False,
    finished: bool = True,
) -> bytes:
    file = io.BytesIO()
    writer = Writer(file, chunk_size=1 << 20, compression=compression, enable_crcs=checked)
    writer.start(profile="", library="fuzz")
    writer.add_metadata(METADATA_NAME, {"format": FORMAT})
    channels = {}
    for topic in Topic:
        name = JSON_MESSAGES[topic][0] if topic in JSON_MESSAGES else "cloud"
        schema = writer.register_schema(name, "json", b"{}")
        channels[topic] = writer.register_channel(topic, "json", schema)
    last = 0
    for sequence, topic, data in messages:
        if sequence != last:
            writer.flush()
        last = sequence
        writer.add_message(channels[topic], 1, data, 1, sequence)
    if finished:
        writer.finish()
    else:
        writer.flush()
    return file.getvalue()


@cache
def _episodes() -> tuple[bytes, ...]:
    messages = _messages()
    return (
        _mcap(messages),
        _mcap(messages, CompressionType.LZ4),
        _mcap(messages, CompressionType.ZSTD),
        _mcap(messages, CompressionType.LZ4, checked=True),
        _mcap(messages, finished=False),
    )


def _mcap_case(rng: Random) -> bytes:
    whole = rng.choice(_episodes())
    return mutated(rng, whole, (b"\x06", b"\x02\xff\xff\xff\xff", b"lz4", b"zstd", whole[8:60]))


def _read_mcap(data: bytes) -> None:
    path = _file("episode.mcap", data)
    if len(data) % 4:
        _show(path)
        return
    copy = _folder() / "recovered.mcap"
    copy.unlink(missing_ok=True)
    recover(path, copy)
    if copy.exists():
        _show(copy)


def _show(path: Path) -> None:
    """Everything that the commands do with an episode before a policy or a robot comes in."""
    episode = read_episode(path)
    console = Console(file=io.StringIO(), width=160)
    console.print(info(path))
    console.print(table([path]))
    print_step = StepPrinter(console)
    for step in episode.steps:
        print_step(step)
    if episode.end is not None and episode.end.truth is not None:
        truth_text(episode.end.truth)
    config_of(episode, path)


_ODD_VALUES: tuple[Any, ...] = (
    None,
    True,
    0,
    -1,
    10**18,
    10**400,
    0.0,
    -1e308,
    5e-324,
    "",
    "x" * 3000,
    "\x1b[31mred\x1b[0m",
    "\ud800",
    "[bold]",
    [],
    [[[[]]]],
    {},
    {"a": 1},
    [1, 2, 3],
    ["a", None, {}],
    float("nan"),
    float("inf"),
)


def _message_case(rng: Random) -> bytes:
    messages = list(_messages())
    for _ in range(rng.choice((1, 1, 2, 4))):
        place = rng.randrange(len(messages))
        sequence, topic, data = messages[place]
        if topic is Topic.CLOUD or rng.random() < 0.3:
            data = mutated(rng, data)
        else:
            data = _odd_json(rng, data)
        messages[place] = (sequence, topic, data)
    if rng.random() < 0.1:
        del messages[rng.randrange(len(messages))]
    return _mcap(messages)


def _odd_json(rng: Random, data: bytes) -> bytes:
    """The same JSON with one of its values replaced, removed, moved in, or added."""
    try:
        root = json.loads(data)
    except ValueError:
        return data
    places: list[tuple[Any, Any]] = []
    waiting = [root]
    while waiting:
        node = waiting.pop()
        if isinstance(node, (dict, list)):
            keys = list(node) if isinstance(node, dict) else list(range(len(node)))
            places += [(node, key) for key in keys]
            waiting += [node[key] for key in keys]
    if not places:
        return data
    node, key = rng.choice(places)
    kind = rng.randrange(6)
    if kind == 0:
        del node[key]
    elif kind == 1 and isinstance(node, dict):
        node["unknown"] = rng.choice(_ODD_VALUES)
    elif kind == 2:
        other, at = rng.choice(places)
        node[key] = json.loads(json.dumps(other[at])) if at in other else None
    else:
        node[key] = rng.choice(_ODD_VALUES)
    return json.dumps(root).encode()


# -- YAML: the first byte says what the file is ---------------------------------------------------

_YAML_WORDS = (
    b"arm:\n",
    b"hardware:\n",
    b"  kind: ur\n",
    b"  - ",
    b"&a ",
    b"*a",
    b"<<: ",
    b"!!int ",
    b"? ",
    b": ",
    b"2026-02-30",
    b"0x" + b"f" * 60,
    b"9" * 5000,
    b".nan",
    b"[" * 60,
    b"{a: " * 30,
    b"'",
    b'"\\x1b[31m',
    b"|\n",
    b"---\n",
    b"\t",
    "½".encode(),
    b"null",
    b"[1, 2, 3]",
)


@cache
def _yamls() -> tuple[tuple[int, bytes], ...]:
    calibration = GripperCalibration(
        unit="left",
        model="XM430-W350",
        ids=(1,),
        adapter="",
        date=datetime.date(2026, 1, 31),
        newtons_per_ma=0.02,
        friction_ma=20.0,
        residual_n=0.05,
        max_force_n=8.0,
        num_readings=9,
    ).model_dump(mode="json")
    text = "".join(f"{name}: {json.dumps(value)}\n" for name, value in calibration.items())
    folder = ROOT / "tacgrasp"
    return (
        *((0, path.read_bytes()) for path in sorted((folder / "tasks").glob("*.yaml"))),
        *((1, path.read_bytes()) for path in sorted((folder / "rigs").glob("*.yaml"))),
        (1, (ROOT / "docs/example_rig.yaml").read_bytes()),
        (2, text.replace('"2026-01-31"', "2026-01-31").encode()),
        (3, b"{max_step_mm: 4, workspace_low_m: [-0.3, -0.3, 0.0]}"),
    )


def _yaml_case(rng: Random) -> bytes:
    kind, content = rng.choice(_yamls())
    return bytes([kind]) + mutated(rng, content, _YAML_WORDS)


def _read_yaml(data: bytes) -> None:
    kind, path = data[0] % 4, _file("given.yaml", data[1:])
    if kind == 0:
        load_with_limits(task=str(path))
    elif kind == 1:
        load_with_limits(rig=str(path))
    elif kind == 2:
        load_calibration(path)
    else:
        text = data[1:].decode("utf-8", errors="surrogateescape")
        load_with_limits(environment={"TACGRASP_ARM": text, "TACGRASP_INSTRUCTION": text})


# -- what a policy said ---------------------------------------------------------------------------


@cache
def _sentences() -> tuple[bytes, ...]:
    from tests.policies.extraction.adversarial import ADVERSARIAL

    plain = (
        "The contact is at the bottom-center, deep 0.70 mm. I will move down. Action: <move_down>",
        "That is firm enough: the grasp is stable. No further action is needed.",
        "Increase the force; the object slips to the left.",
    )
    return tuple(text.encode() for text in (*plain, *ADVERSARIAL))


_SPOKEN = tuple(
    f" {word}".encode()
    for word in (
        *[
            "not",
            "stable",
            "move",
            "up",
            "down",
            "left",
            "right",
            "increase",
            "decrease",
            "the",
            "force",
            "reset",
            "none",
            "and",
        ],
        *("<move_up>", "but,", "if", "unless", "n't", "I'd", "1.5", "½", "\u200b", "\x1b[31m"),
        *".!?;:()-\"'“”\x00",
    )
)


def _extraction_case(rng: Random) -> bytes:
    text = b" ".join(rng.choice(_sentences()) for _ in range(rng.choice((1, 1, 2, 5))))
    return mutated(rng, text, _SPOKEN)


def _read_text(data: bytes) -> None:
    extract(data.decode("utf-8", errors="surrogateescape"))


TARGETS: tuple[FuzzTarget, ...] = (
    FuzzTarget(name="clouds", make_case=_cloud_case, read=_read_cloud, documented=(TouchError,)),
    FuzzTarget(name="mcap", make_case=_mcap_case, read=_read_mcap, documented=(EpisodeError,)),
    FuzzTarget(
        name="mcap-messages", make_case=_message_case, read=_read_mcap, documented=(EpisodeError,)
    ),
    FuzzTarget(
        name="yaml", make_case=_yaml_case, read=_read_yaml, documented=(UsageError, RobotError)
    ),
    FuzzTarget(name="extraction", make_case=_extraction_case, read=_read_text, documented=()),
)
