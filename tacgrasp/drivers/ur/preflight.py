"""Checks of a UR controller before any command, without the library.

``controller_findings`` runs all checks, for ``tacgrasp doctor``; ``preflight`` refuses with the
first failed one. Bounded: a silent, garbled or refusing controller is reported within two seconds.
"""

from __future__ import annotations

import logging
import re
import socket
import time
from collections.abc import Callable, Sequence
from contextlib import closing
from functools import partial

import numpy as np

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


def check(settings: UrSettings) -> Sequence[Finding]:
    """Check the arm for ``tacgrasp doctor``; takes about a second, moves and sets nothing."""
    return controller_findings(settings, seconds=1.0)


def controller_findings(
    settings: UrSettings, *, seconds: float, clock: Callable[[], float] = time.monotonic
) -> list[Finding]:
    """Run the checks in order; ends early if the remaining ones can't be run.

    Args:
        settings: The arm's section of the rig's file.
        seconds: Time of listening to the data stream [s].
        clock: Monotonic clock [s].
    """
    findings: list[Finding] = []
    try:
        with closing(Dashboard(settings.host)) as dashboard:
            findings += _on_dashboard(dashboard, clock)
    except RobotError as error:
        findings.append(_finding("dashboard", False, str(error), "Nothing was moved."))
    if any(not result.ok for result in findings):
        return findings
    try:
        with closing(Rtde(settings.host)) as rtde:
            findings += _on_rtde(rtde, settings, seconds, clock)
    except RobotError as error:
        findings.append(_finding("RTDE", False, str(error), "Nothing was moved."))
    findings.append(_script_port(settings.host))
    return findings


_finding = partial(finding, "arm")


def _on_dashboard(dashboard: Dashboard, clock: Callable[[], float]) -> list[Finding]:
    start_s = clock()
    version = dashboard.ask("PolyscopeVersion")
    duration_ms = 1e3 * (clock() - start_s)
    findings = [
        _finding("dashboard", True, f"answers within {duration_ms:.1f} ms"),
        _version(version),
    ]
    if not findings[-1].ok:
        return findings
    remote = dashboard.ask("is in remote control")
    findings.append(_finding(
        "remote control", remote.lower() == "true", remote,
        "Switch the pendant to Remote Control (top right; enable it in the settings first).",
    ))  # fmt: skip
    mode = dashboard.ask("robotmode")
    findings.append(_finding(
        "robot mode", mode.lower() == "robotmode: running", mode,
        "Power the arm on and release its brakes at the pendant.",
    ))  # fmt: skip
    safety = dashboard.ask("safetystatus")
    findings.append(_finding(
        "safety", safety.lower() in ("safetystatus: normal", "safetystatus: reduced"), safety,
        "Find out why it stopped, clear the reason and release the stop at the pendant.",
    ))  # fmt: skip
    findings.append(_no_program(dashboard, clock))
    return findings


def _version(answer: str) -> Finding:
    numbers = re.search(r"(\d+)\.(\d+)", answer)
    if numbers is None:
        return _finding("version", False, f"no version in {answer[:60]!r}", "Check the address.")
    version = (int(numbers[1]), int(numbers[2]))
    supported = MIN_VERSION <= version < (6, 0) or MIN_VERSION_X <= version < (11, 0)
    return _finding(
        "version", supported, f"PolyScope {version[0]}.{version[1]}",
        "Needed: PolyScope {}.{} or newer of 5, or {}.{} or newer of 10 (X): update the "
        "controller.".format(*MIN_VERSION, *MIN_VERSION_X),
    )  # fmt: skip


def _no_program(dashboard: Dashboard, clock: Callable[[], float]) -> Finding:
    """Wait until a program of ours that was just abandoned has ended by its watchdog."""
    start_s = clock()
    while "true" in (answer := dashboard.ask("running").lower()):
        if clock() - start_s > 0.3:
            return _finding(
                "program", False, answer,
                "Another program runs on the arm: stop it at the pendant, or end the other client.",
            )  # fmt: skip
        time.sleep(0.05)
    return _finding("program", True, "none runs")


def _on_rtde(
    rtde: Rtde, settings: UrSettings, seconds: float, clock: Callable[[], float]
) -> list[Finding]:
    findings = [_finding("RTDE", True, "controller {}.{}".format(*rtde.version()))]
    in_use = rtde.inputs_in_use()
    findings.append(_finding(
        "registers", not in_use, f"{len(in_use)} in use, {in_use[0]} first" if in_use else "free",
        "Another client, EtherNet/IP, PROFINET or a MODBUS unit has them: end or disable it.",
    ))  # fmt: skip
    missing = rtde.subscribe(WATCHED, settings.supervision_hz)
    if REQUIRED & set(missing):
        names = ", ".join(sorted(REQUIRED & set(missing)))
        findings.append(_finding("variables", False, f"missing: {names}", "Update the controller."))
        return findings
    if missing:
        rtde.subscribe([n for n in WATCHED if n not in missing], settings.supervision_hz)
    rtde.start()
    sample = rtde.sample()
    stamps, arrivals = [sample["timestamp"][0]], [clock()]
    while arrivals[-1] - arrivals[0] < seconds:
        sample = rtde.sample()
        stamps.append(sample["timestamp"][0])
        arrivals.append(clock())
    findings.append(_stream(stamps, arrivals, settings))
    findings += _state(sample, settings)
    return findings


def _stream(stamps: list[float], arrivals: list[float], settings: UrSettings) -> Finding:
    gaps_ms = 1e3 * np.diff(arrivals)
    p50, p99, worst = (float(np.percentile(gaps_ms, p)) for p in (50, 99, 100))
    detail = (
        f"every {p50:.1f} ms (p50), {p99:.1f} ms (p99), {worst:.1f} ms (max) at "
        f"{settings.supervision_hz:g} Hz"
    )
    if stamps[-1] <= stamps[0]:
        return _finding("data", False, "its time stands still", "Restart the controller.")
    # This process has ordinary priority: few gaps may hold a stray pause and are not checked.
    even = len(gaps_ms) < MIN_GAPS or p99 < settings.stale_ms
    return _finding(
        "data", even, detail,
        f"Gaps must stay below {settings.stale_ms:g} ms: use a direct cable and a machine that is "
        "not busy.",
    )  # fmt: skip


def _state(sample: dict[str, tuple[float, ...]], settings: UrSettings) -> list[Finding]:
    bits = int(sample["safety_status_bits"][0])
    fraction = sample["target_speed_fraction"][0]
    findings = [
        _finding(
            "safety bits", not safety_text(bits), safety_text(bits) or "normal",
            "Release the stop at the pendant.",
        ),
        _finding(
            "speed slider", fraction >= settings.min_speed_fraction, f"{fraction:.0%}",
            f"Move the pendant's speed slider to at least {settings.min_speed_fraction:.0%}.",
        ),
        _tcp(sample["actual_TCP_pose"][:3], sample.get("tcp_offset"), settings),
    ]  # fmt: skip
    if "payload" in sample:
        kg = sample["payload"][0]
        setting = "as set" if abs(kg - settings.payload_kg) < 1e-3 else "set when connected"
        findings.append(
            _finding("payload", True, f"{kg:.3g} kg; {settings.payload_kg:g} kg {setting}")
        )
    return findings


def _tcp(
    position: tuple[float, ...], offset: tuple[float, ...] | None, settings: UrSettings
) -> Finding:
    position_text = f"({position[0]:.3f}, {position[1]:.3f}, {position[2]:.3f}) m"
    configured = (*settings.tcp_offset_m, *settings.tcp_offset_rad)
    if offset is not None and np.allclose(offset, configured, atol=1e-5):
        return _finding("TCP", True, f"as set, at {position_text}")
    return _finding(
        "TCP",
        True,
        f"another one is set now, at {position_text}; {list(configured)} set when connected",
    )


def _script_port(host: str) -> Finding:
    try:
        socket.create_connection((host, SCRIPT_PORT), timeout=0.4).close()
    except OSError as error:
        return _finding(
            "script port", False, f"{host}:{SCRIPT_PORT}: {error}", "Allow it in the firewall."
        )
    return _finding("script port", True, "open")
