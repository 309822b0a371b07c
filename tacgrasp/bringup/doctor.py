"""Checks of a rig's file and of all its devices, for ``tacgrasp doctor``. Nothing moves."""

from __future__ import annotations

import datetime
import tempfile
from collections.abc import Callable, Collection, Mapping, Sequence
from importlib import metadata
from pathlib import Path

from cltp.errors import TouchError
from primitives.devices import Pose
from primitives.errors import LimitError, RobotError
from primitives.execution import PadAxes
from primitives.limits import check_workspace
from tacgrasp.base.errors import UsageError
from tacgrasp.base.plugins import GROUPS, Plugin, load_plugin, plugins
from tacgrasp.bringup.soak import soak_findings
from tacgrasp.config.hardware import OWN_KINDS, HardwareConfig
from tacgrasp.config.layers import names, task_refusal
from tacgrasp.config.schema import RunConfig
from tacgrasp.drivers.check import Finding, finding
from tacgrasp.drivers.force_scale import good_finding
from tacgrasp.drivers.plugin import BASES, driver_refusal
from tacgrasp.policy_factory import POLICIES, policy_refusal
from tacgrasp.rig.factory import check_slip_calibration, object_names, object_refusal
from tacgrasp.rig.hardware import device_findings, start_pose

LIBRARIES = {
    "arm": ("ur-rtde", "1.6"),
    "gripper": ("dynamixel-sdk", "4."),
    "sensor": ("pyserial", "3."),
}
"""Library of each device, and the start of the versions that its driver was tested with."""


def rig_findings(config: RunConfig, *, soak_s: float = 0.0) -> Sequence[Finding]:
    """Check the rig of a configuration: its file, the libraries, then every device.

    Args:
        config: The configuration.
        soak_s: Time for which the devices are then read side by side [s]; 0 for not at all.

    Raises:
        RobotError: The emulators of an emulated rig did not start.
    """
    findings = [*plugin_findings(), *_file_findings(config)]
    if config.hardware is None:
        detail = "simulated: there is nothing to connect" + (", or to soak" if soak_s else "")
        return [*findings, finding("rig", "devices", True, detail), _drawn_force(config)]
    findings += _library_findings()
    if config.devices == "hardware":
        gripper = config.gripper
        devices = device_findings(config.hardware, gripper.first_force_n, gripper.max_force_n)
        return [*findings, *devices, *_soak(config, config.hardware, soak_s)]
    return [*findings, *_emulated_findings(config, config.hardware, soak_s)]


def plugin_findings() -> list[Finding]:
    """Every installed plugin; one that is broken is named."""
    checks = {group: driver_refusal(group) for group in BASES} | {
        "policies": policy_refusal,
        "tasks": task_refusal,
        "objects": object_refusal,
    }
    findings = []
    for group in GROUPS:
        for plugin in plugins(group).values():
            problem = _plugin_problem(plugin, checks[group])
            detail = problem or f"{plugin.name}, of {plugin.package}"
            advice = f"ask the makers of {plugin.package}, or uninstall it; runs go on without it"
            findings.append(finding("plugin", group, not problem, detail, advice))
    return findings


def _plugin_problem(plugin: Plugin, check: Callable[[object], str]) -> str:
    """Why a plugin, or another one of its name, is left out; empty for none."""
    if plugin.name in _OWN[plugin.group]():
        return f"{plugin.title} is left out: {plugin.name} is a name of tacgrasp's own"
    if plugin.others:
        return f"{plugin.title} is taken, and that of {', '.join(plugin.others)} left out"
    try:
        load_plugin(plugin.group, plugin.name, check)
    except UsageError as error:
        return str(error)
    return ""


_OWN: Mapping[str, Callable[[], Collection[str]]] = {
    "arms": lambda: OWN_KINDS["arm"],
    "grippers": lambda: OWN_KINDS["gripper"],
    "sensors": lambda: OWN_KINDS["sensor"],
    "policies": lambda: POLICIES,
    "tasks": lambda: names("task"),
    "objects": lambda: object_names(),
}
"""Names of tacgrasp's own in each group of plugins."""


def _drawn_force(config: RunConfig) -> Finding:
    """The calibration that the simulated sensor carries."""
    from sim.grasp.force_calibration import drawn_force_calibration

    return good_finding(drawn_force_calibration(config.sensor, config.seed), datetime.date.today())


def _soak(config: RunConfig, hardware: HardwareConfig, seconds: float) -> list[Finding]:
    return soak_findings(hardware, config, seconds) if seconds > 0 else []


def _file_findings(config: RunConfig) -> list[Finding]:
    low, high = config.arm.workspace_low_m, config.arm.workspace_high_m
    box = " × ".join(f"{1000 * (b - a):.0f}" for a, b in zip(low, high, strict=True))
    limits = (
        f"{box} mm, steps of {config.arm.max_step_mm:g} mm, {config.arm.max_speed_m_s:g} m/s, "
        f"{config.gripper.min_force_n:g} to {config.gripper.max_force_n:g} N"
    )
    axes = PadAxes(x_tcp=config.pad.x_axis, y_tcp=config.pad.y_axis)
    directions = f"x {_listed(axes.x_tcp)}, y {_listed(axes.y_tcp)} in the TCP's frame"
    found = [finding("rig", "limits", True, limits), finding("rig", "pad axes", True, directions)]
    if config.reflex and config.slip_calibration is not None:
        found.append(_slip_finding(config, config.slip_calibration))
    start = None if config.hardware is None else start_pose(config.hardware.start)
    return found if start is None else [*found, _start_finding(start, config)]


def _slip_finding(config: RunConfig, path: Path) -> Finding:
    """Whether a run may use the slip calibration of the rig's file."""
    try:
        check_slip_calibration(config)
    except TouchError as error:
        advice = "make or name the right one: tacgrasp calibrate slip; or name none"
        return finding("rig", "slip calibration", False, str(error), advice)
    return finding("rig", "slip calibration", True, str(path))


def _start_finding(pose: Pose, config: RunConfig) -> Finding:
    """Whether a run may go to the start pose of the rig's file."""
    detail = f"{_listed(pose.position_m.tolist())} m"
    try:
        check_workspace(pose, config.limits())
    except LimitError as error:
        advice = "set hardware.start.position_m, in metres, within arm.workspace_low_m and _high_m"
        detail = f"{detail}: {str(error).partition(';')[0]}"
        return finding("rig", "start pose", False, detail, advice)
    return finding("rig", "start pose", True, detail)


def _library_findings() -> list[Finding]:
    findings = []
    for device, (package, tested) in LIBRARIES.items():
        try:
            version = metadata.version(package)
        except metadata.PackageNotFoundError:
            version = ""
        detail = f"{package} {version or 'not installed'}"
        advice = f"the driver was tested with {package} {tested}x: install that (make setup)"
        findings.append(finding(device, "library", version.startswith(tested), detail, advice))
    return findings


def _emulated_findings(config: RunConfig, hardware: HardwareConfig, soak_s: float) -> list[Finding]:
    from sim.emulators.process.spawn import EmulatorProcess
    from tacgrasp.rig.emulated import settings_for

    try:
        with (
            EmulatorProcess("rig", "--seed", str(config.seed)) as emulators,
            tempfile.TemporaryDirectory(prefix="tacgrasp-") as folder,
        ):
            ready = ", ".join(f"{name} {value}" for name, value in emulators.ready.items())
            settings = settings_for(config, hardware, emulators, Path(folder))
            first_force_n = config.gripper.first_force_n
            if first_force_n is None:
                first_force_n = float(str(emulators.ready["first_force_n"]))
            devices = device_findings(settings, first_force_n, config.gripper.max_force_n)
            devices += _soak(config, settings, soak_s)
            return [finding("rig", "emulators", True, ready), *devices]
    except RobotError as error:
        advice = "see the message; python -m sim.emulators rig shows all of it"
        return [finding("rig", "emulators", False, str(error), advice)]


def _listed(axis: Sequence[float]) -> str:
    return f"({', '.join(f'{value:g}' for value in axis)})"
