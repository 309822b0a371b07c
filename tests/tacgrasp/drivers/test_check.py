import pytest

from tacgrasp.drivers.check import Finding


def test_a_finding_that_is_not_ok_needs_advice():
    with pytest.raises(ValueError, match="gripper voltage: no advice for '9"):
        Finding(device="gripper", name="voltage", ok=False, detail="9.1 V")
    Finding(device="gripper", name="voltage", ok=True, detail="12.1 V")
