"""Contents of an episode: its header, its steps and its end, and where each part lies in the file.

An episode is one MCAP file (https://mcap.dev). Every step is one chunk, so that it is either whole
or absent. Channels, all with log and publish time = wall clock [ns] and sequence = number of the
record within the episode:

    /episode      EpisodeHeader                 first message
    /touch/cloud  foxglove.PointCloud           the cloud that was read; x, y, z float32 [m],
                                                frame 'gel', and steps to float32 [mm], exactly
    /touch/shear  ShearMessage                  the shear field of the same frames, if the sensor
                                                measures any
    /decision     DecisionMessage               the policy's decision, if it was asked for one
    /action       ActionMessage                 the action as requested, sent and reached, if any
    /state        StepState                     clocks, phase and robot of every record, and each
                                                command to a device since the record before
    /end          EpisodeEnd                    reason, declared and verified success, truth

All but the clouds are JSON with a JSON Schema made from the dataclasses below. Channels for viewers
stand beside them (``tacgrasp.episodes.view_messages``). A metadata record
``tacgrasp_episode`` names format, task, policy and sensor for tools that list files.

Not here: reading and writing (``tacgrasp.episodes.reader``, ``.writer``).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from enum import StrEnum
from typing import Any

from cltp.sensing.taxel_packets import MAX_TAXELS
from cltp.tactile.cloud import Stamp, TactileCloud
from cltp.tactile.force_scale import UNCALIBRATED, ForceScale
from cltp.tactile.sensors import SensorSpec
from cltp.tactile.shear.field import ShearField
from policies.policy import Decision
from policies.reflex_trace import ReflexTrace
from primitives.contract import Band, Contract
from primitives.devices import GripperState, Pose
from primitives.execution import Executed, PadAxes
from primitives.sense import Interval
from tacgrasp.episodes.command_log import Command
from tacgrasp.episodes.touch_message import ShearMessage

FORMAT = "tacgrasp-episode/2"
FORMATS = ("tacgrasp-episode/1", FORMAT)
"""Formats that are read; format 1 has float32 millimetres and no channels for viewers."""

METADATA_NAME = "tacgrasp_episode"
METADATA_RECOVERED = "tacgrasp_recovered"

TruthFacts = Mapping[str, bool | int | float | str | None]
"""Facts that only a simulator knows (slipped, bruised, held, ...), by name, units in the names."""


def end_label(reason: str, truth: TruthFacts | None) -> str:
    """Reason of an end for people: what was bruised or lost is not called a success.

    A success is declared and verified by touch, which feels no bruise; a simulator knows.
    """
    if reason != "success" or truth is None:
        return reason
    found = harms(truth)
    if not {"dropped", "slipped"} & set(found) and not truth.get("held", True):
        found.insert(0, "not held")
    return f"verified by touch, but {' and '.join(found)}" if found else reason


def harms(truth: TruthFacts) -> list[str]:
    """What went wrong with a body: dropped, slipped, bruised.

    One that slid and is still held counts as held: tasks that lift off slowly let it slide.
    """
    slipped = truth.get("slipped") and not truth.get("held", False)
    bruised = truth.get("bruised") or truth.get("bruised_at_start")
    facts = {"dropped": truth.get("dropped"), "slipped": slipped, "bruised": bruised}
    return [name for name, is_so in facts.items() if is_so]


class Topic(StrEnum):
    """MCAP channels of an episode."""

    EPISODE = "/episode"
    CLOUD = "/touch/cloud"
    SHEAR = "/touch/shear"
    DECISION = "/decision"
    ACTION = "/action"
    STATE = "/state"
    END = "/end"


class StepPhase(StrEnum):
    """Part of an episode that a record belongs to."""

    LOOP = "tick"  # a step of Algorithm 1; the stored name is that of format 1
    VERIFY_BEFORE = "verify_before"  # just before the lift that checks a declared success
    VERIFY_AFTER = "verify_after"  # after lift and hold


NO_END = "the run was killed or crashed, or its file is damaged"
"""Why an episode can have no end, for people."""

PHASE_LABELS = {
    StepPhase.VERIFY_BEFORE: "before the lift",
    StepPhase.VERIFY_AFTER: "after the lift",
}


@dataclass(frozen=True, slots=True, kw_only=True)
class EpisodeHeader:
    """Facts known before the first observation.

    Attributes:
        task: Name of the task.
        instruction: The person's instruction, as given to the policy.
        policy: Name of the policy.
        seed: Random seed of the simulated world; None on a real rig.
        sensor: Constants of the sensor that the clouds come from.
        config_yaml: The whole run configuration as YAML, after all overrides.
        versions: Versions of the software, by name (tacgrasp, python, numpy, ...).
        rig: Name of the rig, 'sim' when simulated.
        dry_run: True when nothing was sent to the devices.
        contract: Contract of the episode; None in episodes of older versions.
        stamp: Start of the episode.
        pad: The pad's axes in the TCP frame; None in episodes of older versions.
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
    contract: Contract | None = None
    pad: PadAxes | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Need:
    """What an object needs, as it was felt in a step: the target of that step.

    Attributes:
        force_n: Part of the contract's force band [N].
        felt: Size and stiffness in words ('34 mm wide, 0.18 MPa').
    """

    force_n: Band
    felt: str


@dataclass(frozen=True, slots=True, kw_only=True)
class StepFields:
    """Fields that a step's record shares with its message on ``/state``.

    Attributes:
        index: Number of the step, from 0.
        phase: Part of the episode.
        stamp: Start of the step, on both clocks [s].
        tcp_pose: Pose of the TCP when the cloud was read, base frame [m, rad].
        gripper: State of the gripper when the cloud was read.
        note: Failures of this step that the loop survived, for people; empty otherwise.
        commands: Commands to the devices since the record before, oldest first; only on rigs of
            real or emulated devices.
        in_contact: Whether something touched the gel, by test; None where none was possible.
        felt_force_n: Force that the contact suggested [N]; None without contact or test.
        contract: Contract from this step on, where what is felt has changed it; None: as before.
        need: What the object needs, as felt; None where the contract's own band was the target.
        reflex: What the reflex saw and did since the step before; None where it did not run.
    """

    index: int
    phase: StepPhase
    stamp: Stamp
    tcp_pose: Pose
    gripper: GripperState
    note: str = ""
    commands: tuple[Command, ...] = ()
    in_contact: bool | None = None
    felt_force_n: Interval | None = None
    contract: Contract | None = None
    need: Need | None = None
    reflex: ReflexTrace | None = None

    def shared(self) -> dict[str, Any]:
        """The fields above by name, whatever else this dataclass holds."""
        return {field.name: getattr(self, field.name) for field in fields(StepFields)}

    def under(self, contract: Contract) -> Contract:
        """The episode's contract with the target of this step as its band."""
        return contract if self.need is None else replace(contract, force_n=self.need.force_n)


@dataclass(frozen=True, slots=True, kw_only=True)
class StepRecord(StepFields):
    """One step of the loop: observation, decision and executed action.

    Attributes:
        cloud: The cloud that was read; its sensor is the header's.
        decision: The policy's decision; None when it was not asked (verification).
        executed: The executed action; None when nothing was executed.
        step_ms: Duration of the step up to the writing of this record [ms].
        camera_jpeg: The camera's frame behind the cloud, as a JPEG file; None without a camera.
        shear: The shear field of the same frames; None where the sensor gives none.
    """

    cloud: TactileCloud
    decision: Decision | None
    executed: Executed | None
    step_ms: float
    camera_jpeg: bytes | None = None
    shear: ShearField | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class StepState(StepFields):
    """A step as it lies in the file, without cloud, decision and action.

    Attributes:
        cloud_stamp: Capture time of the cloud [s]; the exact value (the cloud's own message
            rounds to ns), None when the cloud had no clock.
        tick_ms: Duration of the step [ms].
        force_scale: The cloud's; uncalibrated in episodes of older versions.
    """

    cloud_stamp: Stamp | None
    tick_ms: float
    force_scale: ForceScale = UNCALIBRATED


@dataclass(frozen=True, slots=True, kw_only=True)
class _StepMessage:
    """A message of a step.

    Attributes:
        index: Number of the step.
        stamp: Start of the step, on both clocks [s].
    """

    index: int
    stamp: Stamp


@dataclass(frozen=True, slots=True, kw_only=True)
class DecisionMessage(_StepMessage):
    """A decision as it lies in the file.

    Attributes:
        decision: The policy's decision.
    """

    decision: Decision


@dataclass(frozen=True, slots=True, kw_only=True)
class ActionMessage(_StepMessage):
    """An executed action as it lies in the file.

    Attributes:
        executed: The action as requested, sent and reached.
    """

    executed: Executed


@dataclass(frozen=True, slots=True, kw_only=True)
class EpisodeEnd:
    """End of an episode.

    Attributes:
        reason: Named end: success, unverified, max_steps, timeout, no_action, limit, contact_lost,
            dry_run, fault or operator.
        declared_success: The policy declared success.
        verified_success: The lift confirmed it; None when no lift was tried.
        message: Explanation for people.
        stamp: Time of the end.
        truth: Facts from the simulator, never shown to the policy; None on a real rig.
        commands: Commands to the devices since the last step, oldest first.
    """

    reason: str
    declared_success: bool
    verified_success: bool | None
    message: str
    stamp: Stamp
    truth: TruthFacts | None = None
    commands: tuple[Command, ...] = ()


JSON_MESSAGES: Mapping[Topic, tuple[str, type]] = {
    Topic.EPISODE: ("EpisodeHeader", EpisodeHeader),
    Topic.SHEAR: ("ShearMessage", ShearMessage),
    Topic.DECISION: ("DecisionMessage", DecisionMessage),
    Topic.ACTION: ("ActionMessage", ActionMessage),
    Topic.STATE: ("TickState", StepState),
    Topic.END: ("EpisodeEnd", EpisodeEnd),
}
"""Name of the stored schema (that of format 1) and type of each JSON channel's messages."""

MAX_JSON_BYTES = 2_000_000
"""Longest message in JSON; those of a step with a thousand commands have 300 kB. Our choice."""

_NUMBER_BYTES = 25  # of a float32 as the longest text of a double, with comma and blank
MAX_SHEAR_BYTES = MAX_JSON_BYTES + 8 * MAX_TAXELS * _NUMBER_BYTES
"""Longest message of a shear field, whose points have eight numbers each."""


def most_json_bytes(topic: Topic) -> int:
    """Longest message of a JSON channel that is written and read [bytes]."""
    return MAX_SHEAR_BYTES if topic is Topic.SHEAR else MAX_JSON_BYTES


@dataclass(frozen=True, slots=True, kw_only=True)
class Episode:
    """A recorded episode.

    Attributes:
        header: Facts known at its start.
        steps: Its records in order, verification included.
        end: How it ended; None when the run was killed before its end.
        complete: True when the file was closed properly and no record was lost, before a recovery
            either.
        problem: Damage of an incomplete file, for people; empty otherwise.
        finished: True when the file was closed properly, so that any MCAP reader opens it.
        missing: Steps that were written and are lost, for people; empty when none is known.
    """

    header: EpisodeHeader
    steps: tuple[StepRecord, ...]
    end: EpisodeEnd | None
    complete: bool
    problem: str = ""
    finished: bool = True
    missing: str = ""
