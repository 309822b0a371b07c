"""No bytes of a client end an emulator: not on any port of it, and not for its other clients."""

import logging
import os
import socket
import struct
import termios
import time
import tty
from random import Random

import numpy as np
import pytest

from cltp.sensing.taxel_packets import PacketParser, TaxelFrame, encode_mark
from sim.emulators.dynamixel import packets as dxl
from sim.emulators.dynamixel.bus_process import DynamixelEmulator
from sim.emulators.dynamixel.options import ServoOptions
from sim.emulators.taxels.array import TaxelEmulator
from sim.emulators.taxels.ball import PressedBall
from sim.emulators.ur import packets as rtde
from sim.emulators.ur.controller_process import UrEmulator
from sim.emulators.ur.options import UrOptions
from sim.emulators.ur.server import MAX_CLIENTS
from sim.emulators.ur.sessions import DASHBOARD_PORT, PORTS, RTDE_PORT, SCRIPT_PORT
from tests.fuzz.wire import TARGETS

CASES = 60
TARGET_OF = {RTDE_PORT: "rtde", DASHBOARD_PORT: "dashboard", SCRIPT_PORT: "urscript"}
RESET_ON_CLOSE = struct.pack("ii", 1, 0)


def cases(name, count=CASES):
    target = next(target for target in TARGETS if target.name == name)
    return [target.make_case(Random(f"{name} {i}"))[1:] for i in range(count)]


@pytest.fixture
def no_errors(caplog):
    """Fails a test in which an emulator has logged an error of its own."""
    caplog.set_level(logging.ERROR)
    yield
    assert not [record.getMessage() for record in caplog.records]


@pytest.fixture
def ur(no_errors):
    high, low = divmod(os.getpid() % (254 * 254), 254)
    emulator = UrEmulator(UrOptions(host=f"127.51.{high + 1}.{low + 1}"))
    yield emulator
    emulator.close()


def connect(ur, port):
    return socket.create_connection((ur.server.host, port), timeout=5)


def whole(client, size):
    data = b""
    while len(data) < size:
        piece = client.recv(size - len(data))
        assert piece, f"closed after {data!r}"
        data += piece
    return data


def serves(ur):
    """A client that keeps to the protocols is served on the ports that answer."""
    with connect(ur, RTDE_PORT) as client:
        client.sendall(rtde.packet(rtde.VERSION, b"\x00\x02"))
        assert whole(client, 4) == b"\x00\x04V\x01"
    with connect(ur, DASHBOARD_PORT) as client:
        client.sendall(b"get serial number\n")
        lines = client.makefile("rb")
        assert lines.readline().startswith(b"Connected") and lines.readline().strip().isdigit()
    return True


def test_a_protocol_request_without_its_version_is_answered_and_the_stream_goes_on(ur):
    with connect(ur, RTDE_PORT) as other, connect(ur, RTDE_PORT) as client:
        client.sendall(b"\x00\x03V")
        size, kind = struct.unpack(">HB", whole(client, 3))
        assert kind == rtde.MESSAGE
        assert b"expected a protocol version of 2 bytes" in whole(client, size - 3)
        for one in (client, other):
            one.sendall(rtde.packet(rtde.VERSION, b"\x00\x02"))
            assert whole(one, 4) == b"\x00\x04V\x01"


@pytest.mark.parametrize("port", PORTS)
def test_a_controller_outlives_mutated_and_aborted_sessions(ur, port):
    for number, data in enumerate(cases(TARGET_OF[port])):
        with connect(ur, port) as client:
            if number % 3 == 0:
                client.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, RESET_ON_CLOSE)
            try:
                client.sendall(data)
            except OSError:
                continue  # it has hung up, which is an answer
    assert serves(ur)


def test_a_client_that_never_reads_costs_the_others_nothing(ur):
    with connect(ur, RTDE_PORT) as lazy, connect(ur, DASHBOARD_PORT) as deaf:
        names = ",".join(sorted(rtde.OUTPUT_TYPES)[:120]).encode()
        lazy.sendall(
            rtde.packet(rtde.VERSION, b"\x00\x02")
            + rtde.packet(rtde.OUTPUTS, struct.pack(">d", 500.0) + names)
            + rtde.packet(rtde.START)
        )
        deaf.settimeout(0.2)
        try:
            for _ in range(200):
                deaf.sendall(b"PolyscopeVersion\n" * 500)
        except OSError:
            pass  # the emulator stops reading, or hangs up
        time.sleep(0.3)
        assert serves(ur)
        assert all(len(c.unsent) <= 1 << 20 for c in ur.server._connections)


def test_more_clients_than_a_controller_takes_are_hung_up_on(ur):
    clients = [connect(ur, SCRIPT_PORT) for _ in range(MAX_CLIENTS + 5)]
    assert clients[-1].recv(1) == b""
    for client in clients:
        client.close()
    deadline_s = time.monotonic() + 5
    while ur.server.num_clients and time.monotonic() < deadline_s:
        time.sleep(0.01)
    assert serves(ur)


def open_raw(path, baud=termios.B1000000):
    descriptor = os.open(path, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)
    tty.setraw(descriptor)
    settings = termios.tcgetattr(descriptor)
    settings[4] = settings[5] = baud
    termios.tcsetattr(descriptor, termios.TCSANOW, settings)
    return descriptor


def send_all(descriptor, data, seconds=2.0):
    deadline_s = time.monotonic() + seconds
    while data and time.monotonic() < deadline_s:
        try:
            data = data[os.write(descriptor, data) :]
        except BlockingIOError:
            drain(descriptor)
            time.sleep(0.001)


def drain(descriptor):
    try:
        return os.read(descriptor, 1 << 16)
    except BlockingIOError:
        return b""


def pings(descriptor, servo_id, before_each=lambda: None, seconds=20.0):
    """Whether a servo answers a ping after the line has been quiet.

    On a busy computer the emulator may still be working off what was sent before.
    """
    deadline_s = time.monotonic() + seconds
    while time.monotonic() < deadline_s:
        drain(descriptor)
        time.sleep(0.08)
        before_each()
        send_all(descriptor, dxl.packet(servo_id, bytes([dxl.PING])))
        answer, answered_s = b"", time.monotonic() + 1.0
        while time.monotonic() < answered_s:
            time.sleep(0.01)
            answer += drain(descriptor)
            if dxl.status(servo_id, 0, bytes(3))[:8] in answer:  # model and firmware
                return True
    return False


@pytest.mark.parametrize("model", ["XC330-T288", "XL430-W250"])
def test_a_bus_outlives_mutated_instructions(no_errors, model):
    emulator = DynamixelEmulator(options=ServoOptions(model=model, num_servos=2))
    try:
        descriptor = open_raw(emulator.serial_port)
        for data in cases("dynamixel"):
            send_all(descriptor, data)
            drain(descriptor)
        emulator.facts()
        assert emulator._thread.is_alive()

        def restore():
            """Ids and baud rates may have been written, and may be yet."""
            with emulator._lock:
                for servo in emulator._servos:
                    servo.table[7], servo.table[8], servo.table[68] = 1, 3, 2

        assert pings(descriptor, 1, before_each=restore)
        os.close(descriptor)
    finally:
        emulator.close()


def test_an_array_outlives_whatever_a_host_sends_and_still_takes_marks(no_errors, tmp_path):
    array = TaxelEmulator(PressedBall(8, 8), link=tmp_path / "array", rate_hz=100)
    try:
        descriptor = open_raw(array.port)
        rng = np.random.default_rng(0)
        for data in [*cases("taxels"), rng.bytes(5000)]:
            send_all(descriptor, data)
            drain(descriptor)
        parser, marks, deadline_s = PacketParser(), set(), time.monotonic() + 5
        send_all(descriptor, bytes(600_000))  # ends any frame that a damaged header announced
        while 77 not in marks and time.monotonic() < deadline_s:
            send_all(descriptor, encode_mark(77))
            frames = parser.feed(drain(descriptor))
            marks |= {frame.mark for frame in frames if isinstance(frame, TaxelFrame)}
            time.sleep(0.02)
        assert 77 in marks
        os.close(descriptor)
    finally:
        array.close()
