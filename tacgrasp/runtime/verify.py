"""Verify a declared success by touch alone: lift, shake, hold, and compare the contact.

Source: our choice; the paper stops at the declaration. The lift's acceleration is the benchmark's.
The simulator's truth is recorded as well, but never used here.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from cltp.tactile.measure import contact_state
from cltp.tactile.shift import contact_shift
from primitives.contract import Contract
from primitives.devices import Pose
from primitives.execution import rotate
from primitives.limits import check_workspace
from tacgrasp.config.schema import PadConfig, RunConfig, VerifyConfig
from tacgrasp.episodes.record import StepPhase
from tacgrasp.rig.protocols import Rig
from tacgrasp.runtime.lift_off import lift_off, shifted
from tacgrasp.runtime.outcome import EndOfEpisode, EndReason, Verification
from tacgrasp.runtime.steps import Readings, Steps

SURELY = 2.0
"""Standard deviations by which a shift must exceed its limit, as 2.3 % of unmoved ones would at the
limit itself."""

CLOSED = 0.5
"""Opening of the fingers over that before the lift, below which they hold nothing any more. Our
choice: both gels pressed flat and a fruit gripped at its tip leave more."""

UP = np.array([0.0, 0.0, 1.0])
"""Direction against gravity, base frame."""


def verify_by_lifting(
    rig: Rig, steps: Steps, config: RunConfig, contract: Contract
) -> Verification:
    """Lift, shake and hold the object, and compare the contact; on failure lower it again.

    Raises:
        LimitError: Lift or shake would leave the workspace; nothing has moved then.
        RobotError: The arm failed or refused.
        TouchError: The gel can't be read.
        EpisodeError: An observation can't be recorded.
    """
    settings = config.verify
    start = rig.arm.pose()
    lifted = shifted(start, UP * settings.lift_mm / 1000)
    side_m = level_axis(start, config.pad) * settings.shake_mm / 1000
    sideways = shifted(lifted, side_m)
    for pose in (lifted, sideways):
        check_workspace(pose, config.limits())
    resting = before = steps.observe(StepPhase.VERIFY_BEFORE)
    shake = [sideways, lifted] * settings.shakes if settings.shake_mm > 0 else []
    floor_n = 0.0
    if settings.lift_off_mm > 0 and before.felt_force_n is not None:
        hangs = lift_off(rig, steps, settings, contract, before, side_m)
        problem = hangs.problem
        if not problem:
            before, floor_n = steps.observe(StepPhase.VERIFY_BEFORE), hangs.floor_n  # as it hangs
            problem = lost(resting, before)
        if problem:
            _set_down(rig, steps, start, settings)
            return Verification(passed=False, message=problem, lifted=False)
    with steps.keeping(contract, before, floor_n=floor_n):
        steps.may_hang = True
        _move(rig, lifted, settings, settings.acceleration_m_s2)
        for pose in shake:
            _move(rig, pose, settings, settings.shake_acceleration_m_s2)
        rig.clock.sleep(settings.hold_s)
    after = steps.observe(StepPhase.VERIFY_AFTER)
    problem = lost(resting, after)
    if problem:
        verification = Verification(passed=False, message=problem)
    else:
        verification = compare(before, after, settings, slip_mm=contract.slip_mm)
    if settings.set_down and verification.passed:
        with steps.keeping(contract, after, floor_n=floor_n):
            _set_down(rig, steps, start, settings)
    if not verification.passed:
        # an object that is still held must not fall when it is released
        _set_down(rig, steps, start, settings)
    return verification


def level_axis(pose: Pose, pad: PadConfig) -> NDArray[np.float64]:
    """Horizontal part of that axis of the pad which is nearest to it at a pose, base frame; unit.

    The rest would lead down into what the object stood on.
    """
    axes = [rotate(pose.rotvec_rad, np.array(axis)) for axis in (pad.x_axis, pad.y_axis)]
    nearest = min(axes, key=lambda axis: abs(float(axis @ UP)))
    level: NDArray[np.float64] = nearest - (nearest @ UP) * UP
    return level / np.linalg.norm(level)


def accelerations(verify: VerifyConfig) -> list[tuple[float, float]]:
    """Accelerations of a held body in the verification, (sideways, upwards) [m/s²]."""
    shake = verify.shake_acceleration_m_s2 if verify.shakes else 0.0
    return [(0.0, verify.acceleration_m_s2), (shake, 0.0), (-shake, 0.0)]


def lost(resting: Readings, now: Readings) -> str:
    """Why nothing can be held any more, by the fingers' opening.

    The felt force is not asked: strong drift of a light contact can hide it.

    Args:
        resting: Readings before the object was lifted.
        now: Readings after it.

    Returns:
        The reason; '' where something may be held.
    """
    was_m, width_m = resting.gripper.width_m, now.gripper.width_m
    if width_m < CLOSED * was_m:
        return (
            f"the object is gone: the fingers were {1000 * was_m:.1f} mm open before the lift, and "
            f"are {1000 * width_m:.1f} mm"
        )
    return ""


def compare(
    before: Readings, after: Readings, settings: VerifyConfig, *, slip_mm: float
) -> Verification:
    """Compare the contact before and after the lift with slip limit [mm] and thresholds.

    The limit is for what surely moved: ``SURELY`` standard deviations of the reading lie above it.
    """
    states = [contact_state(each.cloud, in_contact=each.in_contact) for each in (before, after)]
    if not states[0].in_contact:
        return Verification(passed=False, message="nothing was felt before the lift")
    if not states[1].in_contact:
        return Verification(passed=False, message="nothing is felt any more after the lift")
    shift = contact_shift(before.cloud, after.cloud)
    moved = f"moved {shift.length_mm:.1f} mm"
    problems = []
    if not shift.length_mm - SURELY * shift.spread_mm <= slip_mm:  # not finite is a problem too
        problems.append(f"the contact {moved} (at most {slip_mm:g})")
    if not shift.scale >= settings.min_depth_ratio:
        least = settings.min_depth_ratio
        problems.append(f"{shift.scale:.0%} of its depth is left (at least {least:.0%})")
    area_ratio = states[1].area_fraction / states[0].area_fraction
    if not area_ratio >= settings.min_area_ratio:
        least = settings.min_area_ratio
        problems.append(f"{area_ratio:.0%} of its area is left (at least {least:.0%})")
    summary = f"held through the lift: {moved}, {shift.scale:.0%} of the depth left"
    return Verification(
        passed=not problems,
        message="; ".join(problems) or summary,
        shift_mm=shift.length_mm,
        area_ratio=area_ratio,
        depth_ratio=shift.scale,
    )


def not_lifted(rig: Rig, steps: Steps, config: RunConfig, contract: Contract) -> Verification:
    """Verification of a dry run: nothing may move, so the episode ends.

    Raises:
        EndOfEpisode: ``dry_run``, always.
    """
    raise EndOfEpisode(EndReason.DRY_RUN, "success was declared, nothing was lifted")


def _set_down(rig: Rig, steps: Steps, start: Pose, settings: VerifyConfig) -> None:
    """Lower the object to where it stood."""
    _move(rig, start, settings, settings.acceleration_m_s2)
    steps.may_hang = False


def _move(rig: Rig, pose: Pose, settings: VerifyConfig, acceleration_m_s2: float) -> None:
    rig.arm.move_to(pose, speed_m_s=settings.speed_m_s, acceleration_m_s2=acceleration_m_s2)
