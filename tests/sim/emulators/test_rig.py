"""One process with arm, gripper, sensor and world; and two of them side by side."""

import dataclasses

import pytest
import trimesh

from primitives.errors import RobotError
from sim.emulators.process.spawn import EmulatorProcess
from sim.emulators.rig import addresses
from sim.grasp.rig import build


@pytest.fixture(scope="module")
def two():
    with (
        EmulatorProcess("rig", "--seed", "3") as one,
        EmulatorProcess("rig", "--seed", "4") as other,
    ):
        yield one, other


def test_two_rigs_have_addresses_and_ports_of_their_own(two):
    one, other = two
    for name in ("host", "gripper_port", "sensor_port", "control_port"):
        assert one.ready[name] != other.ready[name]
    assert one.ready["host"].startswith("127.77.")


def test_each_world_is_the_one_that_the_simulated_rig_of_its_seed_has(two):
    for seed, emulated in zip((3, 4), two, strict=True):
        rig = build("strawberry", seed)
        truth, facts = dataclasses.asdict(rig.truth()), emulated.control.facts("world")
        x_mm, y_mm = truth.pop("offset_mm")
        truth |= {"offset_x_mm": x_mm, "offset_y_mm": y_mm}
        assert {name: facts[name] for name in truth} == pytest.approx(truth)
        assert emulated.ready["first_force_n"] == pytest.approx(rig.first_force_n)


def test_a_mesh_has_the_properties_that_it_is_given(tmp_path):
    path = tmp_path / "ball.ply"
    trimesh.creation.icosphere(radius=14.0).export(path)
    numbers = {"--object-mass-g": 12.0, "--object-young-mpa": 0.3, "--object-bruise-n": 2.5}
    flags = [word for flag, value in numbers.items() for word in (flag, str(value))]
    with EmulatorProcess("rig", "--object-mesh", str(path), *flags) as emulated:
        facts = emulated.control.facts("world")
    assert [facts[name] for name in ("mass_g", "young_mpa", "bruise_n")] == pytest.approx(
        list(numbers.values())
    )


def test_a_property_of_a_mesh_without_a_mesh_is_refused():
    with (
        pytest.raises(RobotError, match="--object-bruise-n is that of a mesh; give --object-mesh"),
        EmulatorProcess("rig", "--object-bruise-n", "2"),
    ):
        pass


def test_every_device_answers_at_the_one_control_channel(two):
    one, _ = two
    assert one.control.facts("ur")["tcp_x_m"] == pytest.approx(0.45)
    assert one.control.facts("taxels")["plugged"]
    assert one.control.facts("dynamixel")["force_n"] == 0.0


def test_addresses_to_try_are_loopback_and_all_different():
    tried = list(addresses(12345))
    assert len(set(tried)) == len(tried) > 1
    assert all(1 <= int(part) <= 254 for host in tried for part in host.split(".")[2:])
