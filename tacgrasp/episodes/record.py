"""What an episode holds: its header, its ticks and its end, and where each part lies in the file.

An episode is one MCAP file (https://mcap.dev). Every tick is one chunk, so that it is either whole
or absent. Channels, all with log and publish time = wall clock [ns] and sequence = number of the
record within the episode:

    /episode      EpisodeHeader                 first message
    /touch/cloud  foxglove.PointCloud           what was felt; x, y, z float32 [mm], frame 'gel'
    /decision     DecisionMessage               what the policy said, when it was asked
    /action       ActionMessage                 what was asked, sent and reached, when it acted
    /state        TickState                     clocks, phase and robot of every record, and each
                                                command to a device since the one before
    /end          EpisodeEnd                    why it ended, what was declared, verified and true

All but the clouds are JSON with a JSON Schema made from the dataclasses below. A metadata record
``tacgrasp_episode`` names format, task, policy and sensor for tools that list files.

Not here: reading and writing (``tacgrasp.episodes.reader``, ``.writer``).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum

from cltp.tactile.cloud import Stamp, TactileCloud
from cltp.tactile.sensors import SensorSpec
from policies.policy import Decision
from primitives.devices import GripperState, Pose
from primitives.execution import Executed
from tacgrasp.episodes.command_log import Command

FORMAT = "tacgrasp-episode/1"
METADATA_NAME = "tacgrasp_episode"

TOPIC_EPISODE = "/episode"
TOPIC_CLOUD = "/touch/cloud"
TOPIC_DECISION = "/decision"
TOPIC_ACTION = "/action"
TOPIC_STATE = "/state"
TOPIC_END = "/end"

Truth = Mapping[str, bool | int | float | str | None]
"""Facts that only a simulator knows (slipped, bruised, held, ...), by name, units in the names."""


class Phase(StrEnum):
    """Which part of an episode a record belongs to."""

    TICK = "tick"  # the closed loop of Algorithm 1
    VERIFY_BEFORE = "verify_before"  # the touch just before the lift that checks a declared success
    VERIFY_AFTER = "verify_after"  # the touch after lift and hold


@dataclass(frozen=True, slots=True, kw_only=True)
class EpisodeHeader:
    """What is known before the first touch.

    Attributes:
        task: Name of the task.
        instruction: What the person asked for, as given to the policy.
        policy: Name of the policy.
        seed: Seed of the simulated world; None on a real rig.
        sensor: Constants of the sensor that the clouds come from.
        config_yaml: The whole run configuration as YAML, after all overrides.
        versions: Versions of what ran, by name (tacgrasp, python, numpy, ...).
        rig: Name of the rig, 'sim' when simulated.
        dry_run: True when nothing was sent to the devices.
        stamp: When the episode began.
    """

    task: str
    instruction: str
    policy: str
    seed: int | None
    sensor: SensorSpec
    config_yaml: str
    versions: Mapping[str, str]
    stamp: Stamp
    rig: str = "sim"
    dry_run: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class TickRecord:
    """One turn of the loop: what was felt, said, asked, sent and reached.

    Attributes:
        index: Number of the turn, from 0.
        phase: Part of the episode.
        cloud: What was felt; its sensor is the header's.
        decision: What the policy said; None when it was not asked (verification) or could not say.
        executed: What was done; None when nothing was.
        tcp_pose: The TCP when the cloud was read.
        gripper: The gripper when the cloud was read.
        stamp: When the turn began.
        tick_ms: How long it took, up to the writing of this record [ms].
        note: For people: what went wrong in this turn and was survived; empty otherwise.
        commands: What the devices were given since the record before, oldest first; rigs of real
            or emulated devices only.
    """

    index: int
    phase: Phase
    cloud: TactileCloud
    decision: Decision | None
    executed: Executed | None
    tcp_pose: Pose
    gripper: GripperState
    stamp: Stamp
    tick_ms: float
    note: str = ""
    commands: tuple[Command, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class EpisodeEnd:
    """How an episode ended.

    Attributes:
        reason: Named end: success, unverified, max_steps, timeout, no_action, limit, contact_lost,
            fault or operator.
        declared_success: The policy declared success.
        verified_success: The lift and the touch after it confirmed; None when it was not tried.
        message: For people.
        stamp: When it ended.
        truth: What the simulator knows, never shown to the policy; None on a real rig.
        commands: What the devices were given since the last tick, oldest first.
    """

    reason: str
    declared_success: bool
    verified_success: bool | None
    message: str
    stamp: Stamp
    truth: Truth | None = None
    commands: tuple[Command, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class DecisionMessage:
    """A decision as it lies in the file.

    Attributes:
        index: Number of the turn.
        stamp: When the turn began, on both clocks [s].
        decision: What the policy said.
    """

    index: int
    stamp: Stamp
    decision: Decision


@dataclass(frozen=True, slots=True, kw_only=True)
class ActionMessage:
    """An executed action as it lies in the file.

    Attributes:
        index: Number of the turn.
        stamp: When the turn began, on both clocks [s].
        executed: What was asked, sent and reached.
    """

    index: int
    stamp: Stamp
    executed: Executed


@dataclass(frozen=True, slots=True, kw_only=True)
class TickState:
    """The rest of a tick as it lies in the file.

    Attributes:
        index: Number of the turn, from 0.
        phase: Part of the episode.
        stamp: When the turn began, on both clocks [s].
        cloud_stamp: When the cloud was captured [s]; the exact value (the cloud's own message
            rounds to ns), None when the cloud had no clock.
        tick_ms: How long the turn took [ms].
        tcp_pose: The TCP when the cloud was read, base frame [m, rad].
        gripper: The gripper when the cloud was read.
        note: What went wrong and was survived; empty otherwise.
        commands: What the devices were given since the record before, oldest first.
    """

    index: int
    phase: Phase
    stamp: Stamp
    cloud_stamp: Stamp | None
    tick_ms: float
    tcp_pose: Pose
    gripper: GripperState
    note: str = ""
    commands: tuple[Command, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class Episode:
    """A recorded episode.

    Attributes:
        header: What was known at its start.
        ticks: Its records in order, verification included.
        end: How it ended; None when the run was killed before it could say.
        complete: True when the file was closed properly, so that any MCAP reader opens it.
        problem: What is wrong with an incomplete file, for people; empty otherwise.
    """

    header: EpisodeHeader
    ticks: tuple[TickRecord, ...]
    end: EpisodeEnd | None
    complete: bool
    problem: str = field(default="")
