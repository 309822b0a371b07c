"""Is a UR controller as it must be before anything is commanded? Looked at without the library.

``look`` gathers findings for ``tacgrasp doctor``; ``preflight`` refuses with the first bad one.
Bounded: a controller that is silent, garbles or refuses is told within two seconds.
"""

from __future__ import annotations

import logging
import re
import socket
import time
from collections.abc import Callable, Sequence

import numpy as np

from primitives.errors import RobotError
from tacgrasp.drivers.check import Finding
from tacgrasp.drivers.ur.dashboard import SCRIPT_PORT, Dashboard, Rtde
from tacgrasp.drivers.ur.settings import UrSettings

log = logging.getLogger(__name__)

DEVICE = "arm"
ENOUGH = 100
"""Gaps between data from which their 99 % quantile is judged."""

OLDEST = (5, 6)
"""From here on the dashboard tells whether the controller is in remote control."""

OLDEST_X = (10, 11)
"""PolyScope X before this takes the library's script and never runs it."""

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


def safety_words(bits: int) -> str:
    """What safety_status_bits say is wrong, '' when nothing."""
    wrong = [words for bit, words in SAFETY_BITS.items() if bits >> bit & 1]
    return ", ".join(wrong)


def preflight(settings: UrSettings) -> None:
    """Refuse a controller that is not ready, before the library is loaded.

    Raises:
        RobotError: What was found and what to do.
    """
    for finding in look(settings, seconds=0.08):
        log.debug("%s: %s", finding.name, finding.detail)
        if not finding.ok:
            raise RobotError(
                f"the UR arm at {settings.host} is not ready: {finding.name}: {finding.detail}. "
                f"{finding.advice}"
            )


def check(settings: UrSettings) -> Sequence[Finding]:
    """What ``tacgrasp doctor`` says of the arm; takes about a second, moves and sets nothing."""
    return look(settings, seconds=1.0)


def look(
    settings: UrSettings, *, seconds: float, clock: Callable[[], float] = time.monotonic
) -> list[Finding]:
    """All findings, in the order of asking; ends early where the rest can't be asked.

    Args:
        settings: Which controller, and what it is to be.
        seconds: How long to listen to its data [s].
        clock: Monotonic clock [s].
    """
    findings: list[Finding] = []
    try:
        with Dashboard(settings.host) as dashboard:
            findings += _on_dashboard(dashboard, clock)
    except RobotError as error:
        findings.append(_bad("dashboard", str(error), "Nothing was moved."))
    if any(not finding.ok for finding in findings):
        return findings
    try:
        with Rtde(settings.host) as rtde:
            findings += _on_rtde(rtde, settings, seconds, clock)
    except RobotError as error:
        findings.append(_bad("RTDE", str(error), "Nothing was moved."))
    findings.append(_script_port(settings.host))
    return findings


def _good(name: str, found: str) -> Finding:
    return Finding(device=DEVICE, name=name, ok=True, detail=found)


def _bad(name: str, found: str, advice: str) -> Finding:
    return Finding(device=DEVICE, name=name, ok=False, detail=found, advice=advice)


def _judged(name: str, ok: bool, found: str, advice: str) -> Finding:
    return _good(name, found) if ok else _bad(name, found, advice)


def _on_dashboard(dashboard: Dashboard, clock: Callable[[], float]) -> list[Finding]:
    began_s = clock()
    version = dashboard.ask("PolyscopeVersion")
    took_ms = 1e3 * (clock() - began_s)
    findings = [_good("dashboard", f"answers within {took_ms:.1f} ms"), _version(version)]
    if not findings[-1].ok:
        return findings
    remote = dashboard.ask("is in remote control")
    findings.append(_judged(
        "remote control", remote.lower() == "true", remote,
        "Switch the pendant to Remote Control (top right; enable it in the settings first).",
    ))  # fmt: skip
    mode = dashboard.ask("robotmode")
    findings.append(_judged(
        "robot mode", mode.lower() == "robotmode: running", mode,
        "Power the arm on and release its brakes at the pendant.",
    ))  # fmt: skip
    safety = dashboard.ask("safetystatus")
    findings.append(_judged(
        "safety", safety.lower() in ("safetystatus: normal", "safetystatus: reduced"), safety,
        "Find out why it stopped, clear the reason and release the stop at the pendant.",
    ))  # fmt: skip
    findings.append(_no_program(dashboard, clock))
    return findings


def _version(said: str) -> Finding:
    numbers = re.search(r"(\d+)\.(\d+)", said)
    if numbers is None:
        return _bad("version", f"no version in {said[:60]!r}", "Check the address.")
    version = (int(numbers[1]), int(numbers[2]))
    fits = OLDEST <= version < (6, 0) or OLDEST_X <= version < (11, 0)
    return _judged(
        "version", fits, f"PolyScope {version[0]}.{version[1]}",
        f"Needed: PolyScope {OLDEST[0]}.{OLDEST[1]} or newer of 5, or {OLDEST_X[0]}.{OLDEST_X[1]} "
        "or newer of 10 (X): update the controller.",
    )  # fmt: skip


def _no_program(dashboard: Dashboard, clock: Callable[[], float]) -> Finding:
    """A program of ours that has just been left ends by its watchdog: give it that time."""
    began_s = clock()
    while "true" in (said := dashboard.ask("running").lower()):
        if clock() - began_s > 0.3:
            return _bad(
                "program", said, "Another program runs on the arm: stop it at the pendant, or end "
                "the other client.",
            )  # fmt: skip
        time.sleep(0.05)
    return _good("program", "none runs")


def _on_rtde(
    rtde: Rtde, settings: UrSettings, seconds: float, clock: Callable[[], float]
) -> list[Finding]:
    findings = [_good("RTDE", "controller {}.{}".format(*rtde.version()))]
    taken = rtde.inputs_in_use()
    findings.append(_judged(
        "registers", not taken, f"{len(taken)} in use, {taken[0]} first" if taken else "free",
        "Another client, EtherNet/IP, PROFINET or a MODBUS unit has them: end or disable it.",
    ))  # fmt: skip
    missing = rtde.subscribe(WATCHED, settings.supervision_hz)
    if REQUIRED & set(missing):
        lacking = ", ".join(sorted(REQUIRED & set(missing)))
        findings.append(_bad("variables", f"missing: {lacking}", "Update the controller."))
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
    found = (
        f"every {p50:.1f} ms (p50), {p99:.1f} ms (p99), {worst:.1f} ms (max) at "
        f"{settings.supervision_hz:g} Hz"
    )
    if stamps[-1] <= stamps[0]:
        return _bad("data", "its time stands still", "Restart the controller.")
    # This process runs at ordinary priority: judge when there is enough to leave a stray pause out.
    even = len(gaps_ms) < ENOUGH or p99 < settings.stale_ms
    return _judged(
        "data", even, found,
        f"Gaps must stay below {settings.stale_ms:g} ms: use a direct cable and a machine that is "
        "not busy.",
    )  # fmt: skip


def _state(sample: dict[str, tuple[float, ...]], settings: UrSettings) -> list[Finding]:
    bits = int(sample["safety_status_bits"][0])
    fraction = sample["target_speed_fraction"][0]
    findings = [
        _judged(
            "safety bits", not safety_words(bits), safety_words(bits) or "normal",
            "Release the stop at the pendant.",
        ),
        _judged(
            "speed slider", fraction >= settings.min_speed_fraction, f"{fraction:.0%}",
            f"Move the pendant's speed slider to at least {settings.min_speed_fraction:.0%}.",
        ),
        _place(sample["actual_TCP_pose"][:3], sample.get("tcp_offset"), settings),
    ]  # fmt: skip
    if "payload" in sample:
        kg = sample["payload"][0]
        then = "as set" if abs(kg - settings.payload_kg) < 1e-3 else "set when connected"
        findings.append(_good("payload", f"{kg:.3g} kg; {settings.payload_kg:g} kg {then}"))
    return findings


def _place(
    position: tuple[float, ...], offset: tuple[float, ...] | None, settings: UrSettings
) -> Finding:
    where = f"({position[0]:.3f}, {position[1]:.3f}, {position[2]:.3f}) m"
    wanted = (*settings.tcp_offset_m, *settings.tcp_offset_rad)
    if offset is not None and np.allclose(offset, wanted, atol=1e-5):
        return _good("TCP", f"as set, at {where}")
    return _good("TCP", f"another one is set now, at {where}; {list(wanted)} set when connected")


def _script_port(host: str) -> Finding:
    try:
        socket.create_connection((host, SCRIPT_PORT), timeout=0.4).close()
    except OSError as error:
        return _bad("script port", f"{host}:{SCRIPT_PORT}: {error}", "Allow it in the firewall.")
    return _good("script port", "open")
