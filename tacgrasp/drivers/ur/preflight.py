"""Checks of a UR controller before any command, without the library.

``controller_findings`` runs all checks, for ``tacgrasp doctor``; ``preflight`` refuses with the
first failed one. Bounded: a silent, garbled or refusing controller is reported within two seconds.
"""

from __future__ import annotations

import logging
import re
import socket
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import closing
from functools import partial

import numpy as np

from primitives.devices import Pose
from primitives.errors import RobotError
from tacgrasp.drivers.check import Finding, finding
from tacgrasp.drivers.ur.dashboard import SCRIPT_PORT, Dashboard, Rtde
from tacgrasp.drivers.ur.settings import UrSettings

log = logging.getLogger(__name__)

MIN_GAPS = 100
"""Fewest gaps between data for a check of their 99 % quantile."""

MIN_VERSION = (5, 6)
"""First PolyScope 5 whose dashboard reports remote control."""

MIN_VERSION_X = (10, 11)
"""First PolyScope X that runs the library's script; older ones accept it and never run it."""

SAFETY_BITS = {
    2: "protective stop",
    3: "recovery mode",
    4: "safeguard stop",
    5: "system emergency stop",
    6: "robot emergency stop",
    7: "emergency stop",
    8: "safety violation",
    9: "safety fault",
    10: "stopped by a safety function",
}
"""Bits of safety_status_bits in which nothing may move. Source: RTDE guide."""

WATCHED = (
    "timestamp", "robot_mode", "safety_mode", "safety_status_bits", "runtime_state",
    "target_speed_fraction", "actual_TCP_pose", "actual_TCP_force", "payload", "payload_cog",
    "tcp_offset",
)  # fmt: skip
REQUIRED = frozenset(WATCHED) - {"payload", "payload_cog", "tcp_offset"}


def safety_text(bits: int) -> str:
    """Meaning of safety_status_bits that stop the arm; empty for none."""
    return ", ".join(text for bit, text in SAFETY_BITS.items() if bits >> bit & 1)


def preflight(settings: UrSettings) -> None:
    """Refuse a controller that is not ready, before the library is loaded.

    Raises:
        RobotError: The first failed check and its remedy.
    """
    for result in controller_findings(settings, seconds=0.08):
        log.debug("%s: %s", result.name, result.detail)
        if not result.ok:
            raise RobotError(
                f"the UR arm at {settings.host} is not ready: {result.name}: {result.detail}. "
                f"{result.advice}"
            )


def check(
    settings: UrSettings, way_problem: Callable[[Pose], str] | None = None
) -> Sequence[Finding]:
    """Check the arm for ``tacgrasp doctor``; takes about a second, moves and sets nothing.

    Args:
        settings: The arm's section of the rig's file.
        way_problem: Why the arm may not go to its start by itself from a pose, empty where it may;
            None is not checked.
    """
    return controller_findings(settings, seconds=1.0, way_problem=way_problem)


def controller_findings(
    settings: UrSettings, *, seconds: float, way_problem: Callable[[Pose], str] | None = None
) -> list[Finding]:
    """Run the checks in order; ends early if the remaining ones can't be run.

    Args:
        settings: The arm's section of the rig's file.
        seconds: Time of listening to the data stream [s].
        way_problem: As for ``check``.
    """
    findings: list[Finding] = []
    try:
        with closing(Dashboard(settings.host)) as dashboard:
            findings += [*_on_dashboard(dashboard)]
    except RobotError as error:
        findings.append(_finding("dashboard", False, str(error), "Nothing was moved."))
    if any(not result.ok for result in findings):
        return findings
    try:
        with closing(Rtde(settings.host)) as rtde:
            findings += [*_on_rtde(rtde, settings, seconds, way_problem)]
    except RobotError as error:
        findings.append(_finding("RTDE", False, str(error), "Nothing was moved."))
    return [*findings, _script_port(settings.host)]


_finding = partial(finding, "arm")


_DASHBOARD_CHECKS = (
    ("remote control", "is in remote control", ("true",),
     "Switch the pendant to Remote Control (top right; enable it in the settings first)."),
    ("robot mode", "robotmode", ("robotmode: running",),
     "Power the arm on and release its brakes at the pendant."),
    ("safety", "safetystatus", ("safetystatus: normal", "safetystatus: reduced"),
     "Find out why it stopped, clear the reason and release the stop at the pendant."),
)  # fmt: skip
"""Name, question to the dashboard, expected answers in lower case, and advice of each check."""


def _on_dashboard(dashboard: Dashboard) -> Iterator[Finding]:
    start_s = time.monotonic()
    answer = dashboard.ask("PolyscopeVersion")
    duration_ms = 1e3 * (time.monotonic() - start_s)
    yield _finding("dashboard", True, f"answers within {duration_ms:.1f} ms")
    version = _version(answer)
    yield version
    if not version.ok:
        return
    for name, question, expected, advice in _DASHBOARD_CHECKS:
        answer = dashboard.ask(question)
        yield _finding(name, answer.lower() in expected, answer, advice)
    yield _no_program(dashboard)


def _version(answer: str) -> Finding:
    numbers = re.search(r"(\d+)\.(\d+)", answer)
    if numbers is None:
        return _finding("version", False, f"no version in {answer[:60]!r}", "Check the address.")
    version = (int(numbers[1]), int(numbers[2]))
    supported = MIN_VERSION <= version < (6, 0) or MIN_VERSION_X <= version < (11, 0)
    advice = (
        "Needed: PolyScope {}.{} or newer of 5, or {}.{} or newer of 10 (X): update the "
        "controller.".format(*MIN_VERSION, *MIN_VERSION_X)
    )
    return _finding("version", supported, f"PolyScope {version[0]}.{version[1]}", advice)


def _no_program(dashboard: Dashboard) -> Finding:
    """Wait until a program of ours that was just abandoned has ended by its watchdog."""
    advice = "Another program runs on the arm: stop it at the pendant, or end the other client."
    start_s = time.monotonic()
    while "true" in (answer := dashboard.ask("running").lower()):
        if time.monotonic() - start_s > 0.3:
            return _finding("program", False, answer, advice)
        time.sleep(0.05)
    return _finding("program", True, "none runs")


def _on_rtde(
    rtde: Rtde,
    settings: UrSettings,
    seconds: float,
    way_problem: Callable[[Pose], str] | None,
) -> Iterator[Finding]:
    yield _finding("RTDE", True, "controller {}.{}".format(*rtde.version()))
    in_use = rtde.inputs_in_use()
    detail = f"{len(in_use)} in use, {in_use[0]} first" if in_use else "free"
    advice = "Another client, EtherNet/IP, PROFINET or a MODBUS unit has them: end or disable it."
    yield _finding("registers", not in_use, detail, advice)
    missing = rtde.subscribe(WATCHED, settings.supervision_hz)
    if names := ", ".join(sorted(REQUIRED & set(missing))):
        yield _finding("variables", False, f"missing: {names}", "Update the controller.")
        return
    if missing:
        rtde.subscribe([n for n in WATCHED if n not in missing], settings.supervision_hz)
    rtde.start()
    sample = rtde.sample()
    first_stamp, arrivals = sample["timestamp"][0], [time.monotonic()]
    while arrivals[-1] - arrivals[0] < seconds:
        sample = rtde.sample()
        arrivals.append(time.monotonic())
    if sample["timestamp"][0] <= first_stamp:
        yield _finding("data", False, "its time stands still", "Restart the controller.")
    else:
        yield _stream(arrivals, settings)
    yield from _state(sample, settings)
    if way_problem is not None and _is_tcp_set(sample, settings):
        yield _way(sample, way_problem)


def _stream(arrivals: list[float], settings: UrSettings) -> Finding:
    gaps_ms = 1e3 * np.diff(arrivals)
    p50, p99, worst = (float(np.percentile(gaps_ms, p)) for p in (50, 99, 100))
    detail = (
        f"every {p50:.1f} ms (p50), {p99:.1f} ms (p99), {worst:.1f} ms (max) at "
        f"{settings.supervision_hz:g} Hz"
    )
    # This process has ordinary priority: few gaps may hold a stray pause and are not checked.
    even = len(gaps_ms) < MIN_GAPS or p99 < settings.stale_ms
    advice = (
        f"Gaps must stay below {settings.stale_ms:g} ms: use a direct cable and a machine that is "
        "not busy."
    )
    return _finding("data", even, detail, advice)


def _state(sample: dict[str, tuple[float, ...]], settings: UrSettings) -> Iterator[Finding]:
    stop = safety_text(int(sample["safety_status_bits"][0]))
    yield _finding("safety bits", not stop, stop or "normal", "Release the stop at the pendant.")
    fraction, least = sample["target_speed_fraction"][0], settings.min_speed_fraction
    advice = f"Move the pendant's speed slider to at least {least:.0%}."
    yield _finding("speed slider", fraction >= least, f"{fraction:.0%}", advice)
    x, y, z = sample["actual_TCP_pose"][:3]
    position = f"at ({x:.3f}, {y:.3f}, {z:.3f}) m"
    detail = f"as set, {position}"
    if not _is_tcp_set(sample, settings):
        detail = f"another one is set now, {position}; {_tcp(settings)} set when connected"
    yield _finding("TCP", True, detail)
    if "payload" in sample:
        kg = sample["payload"][0]
        setting = "as set" if abs(kg - settings.payload_kg) < 1e-3 else "set when connected"
        yield _finding("payload", True, f"{kg:.3g} kg; {settings.payload_kg:g} kg {setting}")


def _is_tcp_set(sample: dict[str, tuple[float, ...]], settings: UrSettings) -> bool:
    return np.allclose(sample.get("tcp_offset", np.nan), _tcp(settings), atol=1e-5)


def _tcp(settings: UrSettings) -> list[float]:
    return [*settings.tcp_offset_m, *settings.tcp_offset_rad]


def _way(sample: dict[str, tuple[float, ...]], way_problem: Callable[[Pose], str]) -> Finding:
    """Whether the arm may go to its start from where it stands."""
    pose = np.array(sample["actual_TCP_pose"])
    problem = way_problem(Pose(position_m=pose[:3], rotvec_rad=pose[3:]))
    detail = problem.partition(";")[0] or "short enough to go by itself"
    return _finding("way to start", not problem, detail, f"a run is refused: {problem}")


def _script_port(host: str) -> Finding:
    try:
        socket.create_connection((host, SCRIPT_PORT), timeout=0.4).close()
    except OSError as error:
        detail = f"{host}:{SCRIPT_PORT}: {error}"
        return _finding("script port", False, detail, "Allow it in the firewall.")
    return _finding("script port", True, "open")
