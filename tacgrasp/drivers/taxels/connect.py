"""Open and check the serial taxel array of a rig's file.

Not here: reading it (``taxel_array``), its settings (``taxel_settings``).
"""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

import numpy as np

from cltp.errors import TouchError
from cltp.tactile.cloud import Stamp
from cltp.tactile.sensors import sensor_named
from primitives.errors import RobotError
from tacgrasp.drivers.check import Finding
from tacgrasp.drivers.serial_ports import claim, find_port, taken
from tacgrasp.drivers.stamps import real_stamp
from tacgrasp.drivers.taxels.sensor import TaxelArray
from tacgrasp.drivers.taxels.settings import TaxelSettings

if TYPE_CHECKING:
    from serial import Serial

_POLL_S = 0.02
_WRITE_S = 0.2
_CHECKS = 20


def connect_taxels(
    settings: TaxelSettings,
    *,
    rng: np.random.Generator | None = None,
    stamp: Callable[[], Stamp] = real_stamp,
) -> TaxelArray:
    """Open the array of a rig's file and wait for its first frame.

    Raises:
        TouchError: Its port is missing, not to be opened or another program's; nothing, or
            something else, sends there; or its grid does not fit the sensor.
    """
    sensor_named(settings.sensor)
    array = TaxelArray(_open(settings), settings, rng=rng, stamp=stamp)
    try:
        array.wait_until_alive()
    except BaseException:
        array.disconnect()
        raise
    return array


def _open(settings: TaxelSettings) -> Serial:
    from serial import Serial, SerialException

    what = "the taxel array"
    try:
        path = find_port(settings.port, what)
        port = Serial(path, settings.baud, timeout=_POLL_S, write_timeout=_WRITE_S, exclusive=True)
    except RobotError as error:
        raise TouchError(str(error)) from None
    except (SerialException, OSError) as error:
        if "exclusively lock" in str(error):
            raise TouchError(taken(path, what)) from None
        raise TouchError(
            f"the serial port {path} of {what} can't be opened: {error}; is it a serial port, and "
            "may you read it (group dialout)?"
        ) from None
    try:
        claim(port.fileno(), path, what)
    except RobotError as error:
        port.close()
        raise TouchError(str(error)) from None
    return port


def check(settings: TaxelSettings) -> Sequence[Finding]:
    """Look at the array for ``tacgrasp doctor``; nothing moves."""
    try:
        array = connect_taxels(settings)
    except TouchError as error:
        return [_finding("found", False, str(error), "check cable, port and power")]
    try:
        return _checked(array, settings)
    finally:
        array.disconnect()


def _checked(array: TaxelArray, settings: TaxelSettings) -> list[Finding]:
    found = [_finding("found", True, f"{settings.port}, field of {array.spec.name}")]
    began, times, first = time.perf_counter(), [], array.counts().frames
    try:
        for _ in range(_CHECKS):
            start = time.perf_counter()
            array.read()
            times.append(1e3 * (time.perf_counter() - start))
    except TouchError as error:
        advice = "put right what it says; docs/taxels.md has the format"
        return [*found, _finding("reads", False, str(error), advice)]
    counts = array.counts()
    rate = (counts.frames - first) / (time.perf_counter() - began)
    p50, p99 = np.percentile(times, [50, 99])
    slow = p99 > 1e3 * settings.read_timeout_s / 2
    found.append(
        _finding(
            "fresh frame",
            not slow,
            f"p50 {p50:.0f}, p99 {p99:.0f} ms; {rate:.0f} frames/s",
            "raise the baud rate, or read_timeout_s to more than twice the p99" if slow else "",
        )
    )
    lost = counts.damaged + counts.missing
    many = lost > 0.01 * counts.frames + 1
    found.append(
        _finding(
            "line",
            not many,
            f"{counts.frames} frames, {counts.damaged} damaged, {counts.missing} missing, "
            f"{counts.garbage_bytes} bytes of garbage",
            "shorten the cable, or lower the baud rate" if many else "",
        )
    )
    return found


def _finding(name: str, ok: bool, found: str, advice: str = "") -> Finding:
    return Finding(device="sensor", name=name, ok=ok, found=found, advice=advice)
