"""The model that a run is configured by; where its values come from is in ``config_layers``.

Nothing is guessed: an unknown field, a wrong type or a number outside the range that its unit
allows is refused (metres where millimetres are meant fall outside that range).
"""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any, Literal

from pydantic import Field, model_validator

from policies.goal import Band, Goal
from primitives.limits import Limits
from tacgrasp.base.settings import Interval, Number, SettingsBase, Vector
from tacgrasp.config.hardware import HardwareConfig, with_box
from tacgrasp.drivers.ur.settings import UrSettings

AtTheEnd = Literal["hold", "release"]


class GoalConfig(SettingsBase):
    """What a good grasp is; each band is [low, high].

    Attributes:
        force_n: Normal force that the touch suggests [N].
        depth_mm: Largest indentation of the gel [mm].
        area_share: Share of the pad's field in contact, 0 to 1.
        x_mm: Position of the contact along the pad's x [mm].
        y_mm: Position of the contact along the pad's y [mm].
    """

    force_n: Interval
    depth_mm: Interval
    area_share: Interval
    x_mm: Interval
    y_mm: Interval

    @model_validator(mode="after")
    def _bands_are_ordered(self) -> GoalConfig:
        for name in type(self).model_fields:
            low, high = getattr(self, name)
            if low > high:
                raise ValueError(f"{name} must be [low, high], got [{low}, {high}]")
        if not 0 <= self.area_share[0] <= self.area_share[1] <= 1:
            raise ValueError(f"area_share must lie in 0 to 1, got {list(self.area_share)}")
        return self

    def goal(self) -> Goal:
        """The same bands as the policies know them."""

        def band(interval: tuple[float, float]) -> Band:
            return Band(low=interval[0], high=interval[1])

        return Goal(
            force_n=band(self.force_n),
            depth_mm=band(self.depth_mm),
            area_fraction=band(self.area_share),
            x_mm=band(self.x_mm),
            y_mm=band(self.y_mm),
        )


class PrimitivesConfig(SettingsBase):
    """Sizes of the seven primitives.

    Attributes:
        clear_mm: How far the gripper opens before a move, so that nothing is carried along [mm].
        move_step_mm: Length of one move [mm].
    """

    clear_mm: Number = Field(default=2.0, ge=0.2, le=50)
    move_step_mm: Number = Field(default=3.0, ge=0.1, le=20)


class LoopConfig(SettingsBase):
    """Bounds of the loop; each has its named end.

    Attributes:
        max_steps: Actions carried out before the end ``max_steps``.
        timeout_s: Time before the end ``timeout`` [s]; includes simulated motion.
        max_asks: Times in a row that a text may name no action, or two, before ``no_action``.
        max_faults: Times in a row that touch or policy may fail before ``fault``.
        wait_s: Pause before reading and asking again [s].
    """

    max_steps: int = Field(default=25, ge=1, le=1000, strict=True)
    timeout_s: Number = Field(default=180.0, ge=1, le=3600)
    max_asks: int = Field(default=3, ge=1, le=20, strict=True)
    max_faults: int = Field(default=3, ge=1, le=20, strict=True)
    wait_s: Number = Field(default=0.1, ge=0, le=10)


class VerifyConfig(SettingsBase):
    """How a declared success is checked, by touch alone.

    Attributes:
        lift_mm: Height of the lift [mm].
        acceleration_m_s2: Acceleration of the lift [m/s²].
        shake_acceleration_m_s2: Acceleration of the shake [m/s²].
        speed_m_s: Speed of lift and shake [m/s].
        shake_mm: Length of one sideways move along the pad's x [mm]; 0 for none.
        shakes: How many there and back.
        hold_s: Time that the grasp is then held [s].
        max_shift_mm: How far the contact may have moved on the pad [mm].
        min_area_ratio: Smallest share of the area that must be left.
        min_depth_ratio: Smallest share of the depth that must be left.
    """

    lift_mm: Number = Field(default=40.0, ge=5, le=300)
    acceleration_m_s2: Number = Field(default=2.5, gt=0, le=10)
    shake_acceleration_m_s2: Number = Field(default=10.0, gt=0, le=10)
    speed_m_s: Number = Field(default=0.4, gt=0, le=0.5)
    shake_mm: Number = Field(default=25.0, ge=0, le=50)
    shakes: int = Field(default=4, ge=0, le=10, strict=True)
    hold_s: Number = Field(default=2.0, ge=0, le=60)
    max_shift_mm: Number = Field(default=1.0, gt=0, le=10)
    min_area_ratio: Number = Field(default=0.6, ge=0, le=1)
    min_depth_ratio: Number = Field(default=0.6, ge=0, le=1)


class ArmConfig(SettingsBase):
    """Limits of the arm that every command is held to.

    Attributes:
        workspace_low_m: Corner of the box that the TCP stays in [m, base frame].
        workspace_high_m: Its opposite corner [m, base frame].
        max_step_mm: Longest single move of a primitive [mm].
        max_travel_mm: Total travel of an episode's primitives before the end ``limit`` [mm].
        max_speed_m_s: Speed of the primitives' moves, and the most of any move [m/s].
    """

    workspace_low_m: Vector
    workspace_high_m: Vector
    max_step_mm: Number = Field(default=5.0, ge=0.1, le=50)
    max_travel_mm: Number = Field(default=120.0, ge=1, le=2000)
    max_speed_m_s: Number = Field(default=0.4, gt=0, le=0.5)

    @model_validator(mode="after")
    def _box_is_not_empty(self) -> ArmConfig:
        low, high = self.workspace_low_m, self.workspace_high_m
        if any(a >= b for a, b in zip(low, high, strict=True)):
            raise ValueError(
                f"workspace_low_m {list(low)} must be below workspace_high_m {list(high)} "
                "in x, y and z"
            )
        return self


class GripperConfig(SettingsBase):
    """Limits of the gripper.

    Attributes:
        min_force_n: Smallest force that it is asked for [N].
        max_force_n: Largest [N].
        first_force_n: Force of the first grasp [N]; none: the simulated world draws it.
    """

    min_force_n: Number = Field(default=0.1, gt=0, le=100)
    max_force_n: Number = Field(default=12.0, gt=0, le=200)
    first_force_n: Number | None = Field(default=None, gt=0, le=200)

    @model_validator(mode="after")
    def _range_is_ordered(self) -> GripperConfig:
        if self.min_force_n > self.max_force_n:
            raise ValueError(
                f"min_force_n {self.min_force_n} is above max_force_n {self.max_force_n} [N]"
            )
        first_n = self.first_force_n
        if first_n is not None and not self.min_force_n <= first_n <= self.max_force_n:
            raise ValueError(
                f"first_force_n {first_n:g} must lie in min_force_n {self.min_force_n:g} to "
                f"max_force_n {self.max_force_n:g} [N]"
            )
        return self


class PadConfig(SettingsBase):
    """How the pad sits on the TCP: perpendicular unit vectors in the TCP's frame.

    Attributes:
        x_axis: Direction of the pad's +x ('right').
        y_axis: Direction of the pad's +y ('top', towards the palm).
    """

    x_axis: Vector
    y_axis: Vector

    @model_validator(mode="after")
    def _axes_are_a_frame(self) -> PadConfig:
        x, y = self.x_axis, self.y_axis
        for name, axis in (("x_axis", x), ("y_axis", y)):
            if abs(math.hypot(*axis) - 1) > 1e-6:
                raise ValueError(f"{name} must be a unit vector, got {list(axis)}")
        if abs(sum(a * b for a, b in zip(x, y, strict=True))) > 1e-6:
            raise ValueError(f"x_axis {list(x)} and y_axis {list(y)} must be perpendicular")
        return self


class RunConfig(SettingsBase):
    """Everything that a run is configured by.

    Attributes:
        task: Name of a task, or the path of its YAML file.
        rig: Name of a rig, or the path of its YAML file.
        devices: What the rig is made of: sim (simulated), emulated (real drivers on emulators that
            the run starts) or hardware; its file has to say it.
        hardware: The drivers of emulated and real devices; in the rig's file only.
        policy: Who decides: rules, llm, fixed_force or random.
        weights: Folder of the language model's weights; none: those that come with the program.
        instruction: What a person asks for, in words; the task's own when not given.
        object: What the simulator puts between the fingers.
        object_mesh: A mesh [mm] to grasp instead (simulation only).
        object_mass_g: Mass of that mesh [g]; none: from its volume.
        seed: Of everything drawn at random.
        sensor: Which tactile sensor it is; of a rig with drivers the same as theirs.
        on_success: What the gripper does after a verified grasp.
        on_failure: What it does after any other end.
        dry_run: Feel and decide once, send nothing.
        record: Folder that the episode is written to.
    """

    task: str = "strawberry"
    rig: str = "sim"
    devices: Literal["sim", "emulated", "hardware"]
    hardware: HardwareConfig | None = None
    policy: str = "llm"
    weights: Path | None = None
    instruction: str = Field(min_length=1)
    object: str = Field(min_length=1)
    object_mesh: Path | None = None
    object_mass_g: Number | None = Field(default=None, gt=0, le=5000)
    seed: int = Field(default=0, ge=0, lt=2**63)
    sensor: str = "gelsight_mini"
    goal: GoalConfig
    primitives: PrimitivesConfig = PrimitivesConfig()
    loop: LoopConfig = LoopConfig()
    verify: VerifyConfig = VerifyConfig()
    arm: ArmConfig
    gripper: GripperConfig = GripperConfig()
    pad: PadConfig
    on_success: AtTheEnd = "hold"
    on_failure: AtTheEnd = "release"
    dry_run: bool = False
    record: Path = Path("episodes")

    def limits(self) -> Limits:
        """The bounds of everything that is sent in a run."""
        return Limits(
            max_step_mm=self.arm.max_step_mm,
            workspace_low_m=self.arm.workspace_low_m,
            workspace_high_m=self.arm.workspace_high_m,
            max_travel_mm=self.arm.max_travel_mm,
            min_force_n=self.gripper.min_force_n,
            max_force_n=self.gripper.max_force_n,
            max_speed_m_s=self.arm.max_speed_m_s,
        )

    @model_validator(mode="before")
    @classmethod
    def _driver_keeps_to_the_box(cls, data: Any) -> Any:
        """The arm's driver, which knows no task, is held to the rig's box too."""
        return with_box(data) if isinstance(data, dict) else data

    @model_validator(mode="after")
    def _parts_fit(self) -> RunConfig:
        if (self.devices == "sim") != (self.hardware is None):
            raise ValueError(
                f"devices: {self.devices} {'takes no' if self.hardware else 'needs a'} section "
                "hardware"
            )
        if self.devices == "hardware" and self.gripper.first_force_n is None:
            raise ValueError("devices: hardware needs gripper.first_force_n; nothing draws it")
        if self.verify.speed_m_s > self.arm.max_speed_m_s:
            raise ValueError(
                f"verify.speed_m_s {self.verify.speed_m_s} is above arm.max_speed_m_s "
                f"{self.arm.max_speed_m_s}"
            )
        if self.hardware is not None:
            self._check_driver(self.hardware.arm)
            if self.sensor != self.hardware.felt_by:
                raise ValueError(
                    f"sensor {self.sensor} is not what hardware.sensor is: {self.hardware.felt_by}"
                )
        return self

    def _check_driver(self, arm: UrSettings) -> None:
        """What a task asks of the arm in the lift must be allowed by its driver: known at once."""
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
