import pytest

from tacgrasp.drivers.check import Finding


def test_a_finding_that_is_not_ok_must_say_what_to_do():
    with pytest.raises(ValueError, match="gripper voltage: say what to do"):
        Finding(device="gripper", name="voltage", ok=False, found="9.1 V")
    Finding(device="gripper", name="voltage", ok=True, found="12.1 V")
