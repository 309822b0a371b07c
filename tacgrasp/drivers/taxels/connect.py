"""Open and check the serial taxel array of a rig's file."""

from __future__ import annotations

import time
from collections.abc import Sequence
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from cltp.errors import TouchError
from cltp.tactile.sensors import sensor_named
from primitives.errors import RobotError
from tacgrasp.drivers.check import Finding, finding, read_durations_ms
from tacgrasp.drivers.force_scale import force_scale_of
from tacgrasp.drivers.serial_ports import claim, find_port, in_use_message
from tacgrasp.drivers.taxels.sensor import TaxelArray
from tacgrasp.drivers.taxels.settings import TaxelSettings

if TYPE_CHECKING:
    from serial import Serial

_POLL_S = 0.02
_WRITE_S = 0.2
_CHECKS = 20


def connect_taxels(settings: TaxelSettings) -> TaxelArray:
    """Open the array of a rig's file and wait for its first frame.

    Raises:
        TouchError: The port is missing, can't be opened or is in use by another program; nothing or
            another device sends on it; or the grid does not fit the sensor.
    """
    sensor_named(settings.sensor)
    scale = force_scale_of(settings)
    array = TaxelArray(_open(settings), settings, force_scale=scale)
    try:
        array.wait_until_alive()
    except BaseException:
        array.disconnect()
        raise
    return array


def _open(settings: TaxelSettings) -> Serial:
    from serial import Serial, SerialException

    device = "the taxel array"
    try:
        path = find_port(settings.port, device)
        port = Serial(path, settings.baud, timeout=_POLL_S, write_timeout=_WRITE_S, exclusive=True)
    except RobotError as error:
        raise TouchError(str(error)) from None
    except (SerialException, OSError) as error:
        if "exclusively lock" in str(error):
            raise TouchError(in_use_message(path, device)) from None
        raise TouchError(
            f"the serial port {path} of {device} can't be opened: {error}; is it a serial port, "
            "and may you read it (group dialout)?"
        ) from None
    try:
        claim(port.fileno(), path, device)
    except RobotError as error:
        port.close()
        raise TouchError(str(error)) from None
    return port


def check(settings: TaxelSettings) -> Sequence[Finding]:
    """Check the array for ``tacgrasp doctor``; nothing moves."""
    try:
        array = connect_taxels(settings)
    except TouchError as error:
        return [_finding("connection", False, str(error), "check cable, port and power")]
    try:
        return _read_findings(array, settings)
    finally:
        array.disconnect()


def _read_findings(array: TaxelArray, settings: TaxelSettings) -> list[Finding]:
    connection = _finding("connection", True, f"{settings.port}, sensor {array.spec.name}")
    start_s, first = time.perf_counter(), array.counts().frames
    try:
        p50, p99, _ = read_durations_ms(array.read, _CHECKS)
    except TouchError as error:
        advice = "correct the error; docs/taxels.md has the format"
        return [connection, _finding("reads", False, str(error), advice)]
    counts = array.counts()
    rate = (counts.frames - first) / (time.perf_counter() - start_s)
    return [
        connection,
        _finding(
            "fresh frame",
            p99 <= 1e3 * settings.read_timeout_s / 2,
            f"p50 {p50:.0f}, p99 {p99:.0f} ms; {rate:.0f} frames/s",
            "raise the baud rate, or read_timeout_s to more than twice the p99",
        ),
        _finding(
            "line",
            counts.damaged + counts.missing <= 0.01 * counts.frames + 1,
            f"{counts.frames} frames, {counts.damaged} damaged, {counts.missing} missing, "
            f"{counts.garbage_bytes} bytes of garbage",
            "shorten the cable, or lower the baud rate",
        ),
        _shear_finding(array),
    ]


def _shear_finding(array: TaxelArray) -> Finding:
    """What the array measures along its gel; it must, where its sensor is one that does."""
    field, expected = array.last_shear(), array.spec.shear_grid
    if field is not None:
        largest_um = 1e3 * float(np.abs(field.displacement_mm[:, :2]).max())
        text = f"{len(field.positions_mm)} points, displaced by {largest_um:.0f} µm at most"
    else:
        text = "none: the array sends heights alone, packets of version 1"
    advice = "load firmware that sends version 2, or name another sensor"
    return _finding("shear", expected is None or field is not None, text, advice)


_finding = partial(finding, "sensor")
