"""The seven action primitives, their execution on an arm and a gripper, and all limits.

Not here: drivers of devices (``tacgrasp.drivers``), and the choice of a primitive (``policies``).

May import: nothing of ours.
"""

from primitives.errors import LimitError, RobotError
from primitives.primitive import Primitive

__all__ = ["LimitError", "Primitive", "RobotError"]
