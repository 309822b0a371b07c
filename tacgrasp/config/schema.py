"""The configuration of a run.

An unknown field, a wrong type or a number outside its range is refused. The ranges are narrow
enough that metres in place of millimetres fall outside.
Not here: where the values come from (``tacgrasp.config.layers``).
"""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any, Literal

from pydantic import Field, model_validator

from policies.goal import Goal
from policies.teacher import LESSON_MOVE_STEP_MM
from primitives.contract import DEFAULT_AREA, DEFAULT_DEPTH_MM, Band
from primitives.limits import Limits
from tacgrasp.base.settings import Interval, Number, SettingsBase, Vector
from tacgrasp.config.hardware import ArmSettings, HardwareConfig, with_workspace
from tacgrasp.drivers.ur.settings import check_box

GOAL_BANDS = ("force_n", "depth_mm", "area_share", "x_mm", "y_mm")

EndAction = Literal["hold", "release"]


NARROWEST_BAND = 1.1
"""Smallest end of a force band over its beginning. Our choice: the felt force varies by some
percent from frame to frame (``policies.force_terms.LEAST_TOLERANCE``)."""


class GoalConfig(SettingsBase):
    """Bands of a good grasp, each [low, high]; the contract of an episode is made from them.

    Attributes:
        force_n: Normal force, estimated from the contact [N].
        limit_n: Felt force that is never exceeded [N]; none: 1.25 times the top of ``force_n``.
        needs: Kind of object whose felt size and stiffness place the target of each step within
            ``force_n``: strawberry or fruit; none: all of ``force_n`` is the target.
        depth_mm: Largest indentation of the gel [mm].
        area_share: Fraction of the pad's sensing area in contact, 0 to 1.
        x_mm: Position of the contact along the pad's x [mm].
        y_mm: Position of the contact along the pad's y [mm].
    """

    force_n: Interval
    limit_n: Number | None = Field(default=None, gt=0, le=200)
    needs: Literal["strawberry", "fruit"] | None = None
    depth_mm: Interval = (DEFAULT_DEPTH_MM.low, DEFAULT_DEPTH_MM.high)
    area_share: Interval = (DEFAULT_AREA.low, DEFAULT_AREA.high)
    x_mm: Interval = (-4.0, 4.0)
    y_mm: Interval = (-3.0, 3.0)

    @model_validator(mode="after")
    def _check_bands(self) -> GoalConfig:
        for name in GOAL_BANDS:
            low, high = getattr(self, name)
            if low > high:
                raise ValueError(f"{name} must be [low, high], got [{low}, {high}]")
        if not self.force_n[0] > 0:
            raise ValueError(f"force_n must begin above 0 N, got {list(self.force_n)}")
        if self.force_n[1] < NARROWEST_BAND * self.force_n[0]:
            raise ValueError(
                f"force_n {list(self.force_n)} is narrower than a grip can be held; its end must "
                f"be at least {NARROWEST_BAND:g} times its beginning"
            )
        end, least_n = ("foot", self.force_n[0]) if self.needs else ("top", self.force_n[1])
        if self.limit_n is not None and self.limit_n < least_n:
            raise ValueError(
                f"limit_n {self.limit_n:g} N is below the {end} of force_n, {least_n:g} N"
            )
        if not 0 <= self.area_share[0] <= self.area_share[1] <= 1:
            raise ValueError(f"area_share must lie in 0 to 1, got {list(self.area_share)}")
        return self

    def goal(self) -> Goal:
        """The same bands as the policies' ``Goal``."""
        bands = {
            name: Band(low=low, high=high)
            for name in GOAL_BANDS
            for low, high in [getattr(self, name)]
        }
        return Goal(area_fraction=bands.pop("area_share"), **bands)


class PrimitivesConfig(SettingsBase):
    """Sizes of the seven primitives.

    Attributes:
        clear_mm: Opening of the gripper before a move, so that the object is not dragged [mm].
        move_step_mm: Length of one move [mm].
    """

    clear_mm: Number = Field(default=2.0, ge=0.2, le=50)
    move_step_mm: Number = Field(default=LESSON_MOVE_STEP_MM, ge=0.1, le=20)


class LoopConfig(SettingsBase):
    """Bounds of the loop; each has its named end.

    Attributes:
        max_steps: Number of executed actions before the end ``max_steps``.
        timeout_s: Time before the end ``timeout`` [s]; includes simulated motion.
        max_asks: Number of decisions in a row that move nothing before ``no_action``.
        max_faults: Number of failures in a row of sensor or policy before ``fault``.
        wait_s: Pause before reading and asking again [s].
    """

    max_steps: int = Field(default=25, ge=1, le=1000, strict=True)
    timeout_s: Number = Field(default=180.0, ge=1, le=3600)
    max_asks: int = Field(default=3, ge=1, le=20, strict=True)
    max_faults: int = Field(default=3, ge=1, le=20, strict=True)
    wait_s: Number = Field(default=0.1, ge=0, le=10)


class VerifyConfig(SettingsBase):
    """Verification of a declared success by lifting and touch.

    Attributes:
        lift_mm: Height of the lift [mm].
        lift_off_mm: Height of the slow rise before, in which the reflex finds the force that just
            holds the object [mm]; 0 for none. Without a reflex there is none.
        lift_off_speed_m_s: Its speed [m/s].
        acceleration_m_s2: Acceleration of the lift [m/s²].
        shake_acceleration_m_s2: Acceleration of the shake [m/s²].
        speed_m_s: Speed of lift and shake [m/s].
        shake_mm: Length of one sideways move along the pad's x [mm]; 0 for none.
        shakes: Number of sideways moves, each there and back.
        hold_s: Time of holding after the shake [s]; at most 10, since the gel's drift is not
            followed meanwhile: after 30 s it is felt as a force and as a slip.
        set_down: Whether the object is then set down where it stood.
        max_shift_mm: Largest allowed shift of the contact on the pad [mm].
        min_area_ratio: Smallest allowed fraction of the contact area after the lift, 0 to 1.
        min_depth_ratio: Smallest allowed fraction of the indentation after the lift, 0 to 1.
    """

    lift_mm: Number = Field(default=40.0, ge=5, le=300)
    lift_off_mm: Number = Field(default=0.0, ge=0, le=10)
    lift_off_speed_m_s: Number = Field(default=0.004, gt=0, le=0.05)
    acceleration_m_s2: Number = Field(default=2.5, gt=0, le=10)
    shake_acceleration_m_s2: Number = Field(default=10.0, gt=0, le=10)
    speed_m_s: Number = Field(default=0.4, gt=0, le=0.5)
    shake_mm: Number = Field(default=25.0, ge=0, le=50)
    shakes: int = Field(default=4, ge=0, le=10, strict=True)
    hold_s: Number = Field(default=2.0, ge=0, le=10)
    set_down: bool = False
    max_shift_mm: Number = Field(default=1.0, gt=0, le=10)
    min_area_ratio: Number = Field(default=0.6, ge=0, le=1)
    min_depth_ratio: Number = Field(default=0.6, ge=0, le=1)

    @model_validator(mode="after")
    def _check_lift_off(self) -> VerifyConfig:
        if self.lift_off_mm > self.lift_mm:
            raise ValueError(
                f"lift_off_mm {self.lift_off_mm:g} is above lift_mm {self.lift_mm:g} [mm]; the "
                "slow rise is the lift's first part"
            )
        return self


class ArmConfig(SettingsBase):
    """Limits of every command to the arm.

    Attributes:
        workspace_low_m: Lower corner of the box of allowed TCP positions [m, base frame].
        workspace_high_m: Upper corner of that box [m, base frame].
        max_step_mm: Longest single move of a primitive [mm].
        max_travel_mm: Total travel of an episode's primitives before the end ``limit`` [mm].
        max_speed_m_s: Speed of the primitives' moves, and upper limit for all moves [m/s].
    """

    workspace_low_m: Vector
    workspace_high_m: Vector
    max_step_mm: Number = Field(default=5.0, ge=0.1, le=50)
    max_travel_mm: Number = Field(default=120.0, ge=1, le=2000)
    max_speed_m_s: Number = Field(default=0.4, gt=0, le=0.5)

    @model_validator(mode="after")
    def _check_workspace(self) -> ArmConfig:
        check_box(self.workspace_low_m, self.workspace_high_m)
        return self


class GripperConfig(SettingsBase):
    """Limits of the gripper.

    Attributes:
        min_force_n: Smallest commanded force [N].
        max_force_n: Largest commanded force [N].
        first_force_n: Largest commanded force of an approach until something is felt [N]: 0.5 N
            times the largest factor by which it may exceed the true force. None: 1 N in a
            simulated world, whose factor is up to 2; real devices need a value.
        max_force_gain: Largest ratio of true to commanded force. Until something is felt, no
            command times this may pass the contract's limit. The simulated gripper's is up to 2.
    """

    min_force_n: Number = Field(default=0.1, gt=0, le=100)
    max_force_n: Number = Field(default=12.0, gt=0, le=200)
    first_force_n: Number | None = Field(default=None, gt=0, le=200)
    max_force_gain: Number = Field(default=2.0, ge=1, le=10)

    @model_validator(mode="after")
    def _check_range(self) -> GripperConfig:
        if self.min_force_n > self.max_force_n:
            raise ValueError(
                f"min_force_n {self.min_force_n} is above max_force_n {self.max_force_n} [N]"
            )
        first_n = self.first_force_n
        if first_n is not None and not self.min_force_n <= first_n <= self.max_force_n:
            raise ValueError(
                f"first_force_n {first_n:g} must lie in min_force_n {self.min_force_n:g} to "
                f"max_force_n {self.max_force_n:g} [N]; it is the largest commanded force until "
                "something is felt"
            )
        return self


class PadConfig(SettingsBase):
    """Orientation of the pad on the TCP: perpendicular unit vectors in the TCP's frame.

    Attributes:
        x_axis: Direction of the pad's +x ('right').
        y_axis: Direction of the pad's +y ('top', towards the palm).
    """

    x_axis: Vector
    y_axis: Vector

    @model_validator(mode="after")
    def _check_axes(self) -> PadConfig:
        x, y = self.x_axis, self.y_axis
        for name, axis in (("x_axis", x), ("y_axis", y)):
            if abs(math.hypot(*axis) - 1) > 1e-6:
                raise ValueError(f"{name} must be a unit vector, got {list(axis)}")
        if abs(sum(a * b for a, b in zip(x, y, strict=True))) > 1e-6:
            raise ValueError(f"x_axis {list(x)} and y_axis {list(y)} must be perpendicular")
        return self


class LlmConfig(SettingsBase):
    """The language model of the policy llm.

    Attributes:
        dir: Folder of weights that tacgrasp train llm wrote; the same as weights.
    """

    dir: Path | None = None


class RunConfig(SettingsBase):
    """Configuration of a run.

    Attributes:
        task: Name of a task, or the path of its YAML file.
        rig: Name of a rig, or the path of its YAML file.
        devices: Kind of devices, set by the rig's file: sim (simulated), emulated (real drivers on
            emulators that the run starts) or hardware.
        hardware: Drivers of emulated and real devices; in the rig's file only.
        policy: Policy that decides: rules, llm, random, remote, or a plugin's.
        policy_url: Address of the server that a remote policy asks (ws://host:port).
        policy_timeout_s: Longest wait for an answer of that server [s].
        policy_key_file: File with the key that the server asks for.
        weights: Folder of the language model's weights; none: the shipped weights.
        llm: The same by another name: llm.dir.
        instruction: Instruction to the policy in plain English; by default the task's.
        object: Object between the fingers (simulated and emulated rigs only).
        object_mesh: Mesh file [mm, +z up] to grasp instead (simulated and emulated rigs only).
        object_mass_g: Mass of that mesh [g]; none: computed from its volume.
        object_young_mpa: Young's modulus of that mesh [MPa]; none: that of the object.
        object_bruise_n: Force that bruises that mesh [N]; none: that of the object.
        seed: Random seed of the object, its pose, the gripper, the sensor and the random policy.
        sensor: Name of the tactile sensor; on a rig with drivers that of its driver.
        on_success: Gripper action after a verified grasp: hold or release.
        on_failure: Gripper action after any other end: hold or release; what may hang in the air is
            held.
        dry_run: Read and decide once, and send nothing to the devices.
        reflex: Whether a reflex corrects the force between decisions, where the sensor feels shear.
        slip_calibration: File of the sensor's slip calibration; none: the threshold of all units.
        record: Folder for the recorded episode.
    """

    task: str = "strawberry"
    rig: str = "sim"
    devices: Literal["sim", "emulated", "hardware"]
    hardware: HardwareConfig | None = None
    policy: str = "llm"
    policy_url: str | None = None
    policy_timeout_s: Number = Field(default=2.0, ge=0.05, le=60)
    policy_key_file: Path | None = None
    weights: Path | None = None
    llm: LlmConfig = LlmConfig()
    instruction: str = Field(min_length=1)
    object: str = Field(min_length=1)
    object_mesh: Path | None = None
    object_mass_g: Number | None = Field(default=None, ge=0.1, le=5000)
    object_young_mpa: Number | None = Field(default=None, ge=0.005, le=5e5)
    object_bruise_n: Number | None = Field(default=None, ge=0.05, le=2000)
    seed: int = Field(default=0, ge=0, lt=2**63)
    sensor: str = "gelsight_mini"
    goal: GoalConfig
    primitives: PrimitivesConfig = PrimitivesConfig()
    loop: LoopConfig = LoopConfig()
    verify: VerifyConfig = VerifyConfig()
    arm: ArmConfig
    gripper: GripperConfig = GripperConfig()
    pad: PadConfig
    on_success: EndAction = "hold"
    on_failure: EndAction = "release"
    dry_run: bool = False
    reflex: bool = True
    slip_calibration: Path | None = None
    record: Path = Path("episodes")

    @property
    def sensor_unit(self) -> str:
        """Name of the sensor's unit in its calibrations."""
        return "simulated" if self.hardware is None else self.hardware.sensor.unit

    @property
    def weights_folder(self) -> Path | None:
        """Folder of the language model's weights, by either name; None for the usual ones."""
        return self.weights or self.llm.dir

    def limits(self) -> Limits:
        """Limits of every command of a run."""
        gripper = self.gripper
        return Limits(
            **dict(self.arm), min_force_n=gripper.min_force_n, max_force_n=gripper.max_force_n
        )

    @model_validator(mode="before")
    @classmethod
    def _share_workspace(cls, data: Any) -> Any:
        """The arm's driver, which knows no task, keeps to the rig's workspace too."""
        return with_workspace(data) if isinstance(data, dict) else data

    @model_validator(mode="after")
    def _check_parts(self) -> RunConfig:
        if (self.devices == "sim") != (self.hardware is None):
            raise ValueError(
                f"devices: {self.devices} {'takes no' if self.hardware else 'needs a'} section "
                "hardware"
            )
        if self.devices == "hardware" and self.gripper.first_force_n is None:
            raise ValueError(
                "devices: hardware needs gripper.first_force_n, the largest commanded force until "
                "something is felt [N]"
            )
        if None not in (self.weights, self.llm.dir) and self.weights != self.llm.dir:
            raise ValueError(
                f"weights {self.weights} and llm.dir {self.llm.dir} both name the language model's "
                "folder; give one"
            )
        for name in ("object_mass_g", "object_young_mpa", "object_bruise_n"):
            if self.object_mesh is None and getattr(self, name) is not None:
                raise ValueError(f"{name} is that of a mesh; give object_mesh too, or leave it out")
        if self.verify.speed_m_s > self.arm.max_speed_m_s:
            raise ValueError(
                f"verify.speed_m_s {self.verify.speed_m_s} is above arm.max_speed_m_s "
                f"{self.arm.max_speed_m_s}"
            )
        if self.hardware is not None:
            self._check_driver(self.hardware.arm)
            name = self.hardware.sensor.sensor_name
            is_free = self.devices == "emulated" and not self.hardware.names_sensor
            if self.sensor != name and not is_free:
                raise ValueError(f"sensor {self.sensor} is not what hardware.sensor is: {name}")
        return self

    def _check_driver(self, arm: ArmSettings) -> None:
        """Refuse a task whose lift needs more than the arm's driver allows."""
        lift, shake = self.verify.acceleration_m_s2, self.verify.shake_acceleration_m_s2
        for name, value, bound in (
            ("arm.max_speed_m_s", self.arm.max_speed_m_s, "max_speed_m_s"),
            ("verify.acceleration_m_s2", lift, "max_acceleration_m_s2"),
            ("verify.shake_acceleration_m_s2", shake, "max_acceleration_m_s2"),
        ):
            if value > getattr(arm, bound):
                raise ValueError(
                    f"{name} {value:g} is above hardware.arm.{bound} {getattr(arm, bound):g}"
                )
