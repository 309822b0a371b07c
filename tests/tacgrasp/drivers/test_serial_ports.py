"""Serial ports by stable names, on made-up ports and on a pty."""

import os
import pty

import pytest

from primitives import RobotError
from tacgrasp.drivers.serial_ports import SerialPort, claim, find_port, serial_ports

U2D2 = SerialPort(
    device="/dev/ttyUSB0",
    stable_id="usb-FTDI_USB__-__Serial_Converter_FT3FSMBC-if00-port0",
    serial_number="FT3FSMBC",
    description="USB <-> Serial Converter",
)
OTHER = SerialPort(
    device="/dev/ttyUSB1",
    stable_id="usb-FTDI_USB__-__Serial_Converter_FT9ZZZZZ-if00-port0",
    serial_number="FT9ZZZZZ",
    description="USB <-> Serial Converter",
)


@pytest.fixture
def terminal():
    """Path of a pty."""
    master, slave = pty.openpty()
    yield os.ttyname(slave)
    os.close(master)
    os.close(slave)


@pytest.mark.parametrize("name", ["FT3FSMBC", U2D2.stable_id, "Converter_FT3F"])
def test_a_port_is_found_by_serial_number_stable_name_or_a_part_of_it(name):
    assert find_port(name, "the gripper", [OTHER, U2D2]) == "/dev/ttyUSB0"


def test_a_path_that_exists_is_taken_as_it_is(terminal):
    assert find_port(terminal, "the gripper", []) == terminal


def test_a_missing_port_is_refused_with_those_that_exist():
    with pytest.raises(RobotError, match=r"no serial port matches 'U2D2'.*FT3FSMBC.*FT9ZZZZZ"):
        find_port("U2D2", "the gripper", [U2D2, OTHER])


def test_a_missing_path_is_refused_and_says_when_there_is_none_at_all(tmp_path):
    with pytest.raises(RobotError, match="no serial port /dev/ttyUSB7 for the gripper; this comp"):
        find_port("/dev/ttyUSB7", "the gripper", [], tmp_path)


def test_a_name_that_means_two_ports_is_refused():
    with pytest.raises(RobotError, match="2 serial ports match 'FTDI'"):
        find_port("FTDI", "the gripper", [U2D2, OTHER])


def test_an_empty_name_means_no_port():
    with pytest.raises(RobotError, match="no serial port matches ''"):
        find_port("", "the gripper", [U2D2])


def test_listing_the_ports_of_this_computer_gives_devices_that_exist():
    assert all(os.path.exists(port.device) for port in serial_ports())  # noqa: PTH110


def test_a_port_can_be_claimed_once(terminal):
    first, second = os.open(terminal, os.O_RDWR), os.open(terminal, os.O_RDWR)
    try:
        claim(first, terminal, "the gripper")
        with pytest.raises(RobotError, match="in use by another program"):
            claim(second, terminal, "the gripper")
    finally:
        os.close(first)
        os.close(second)
