"""What a robot can be asked to do: seven primitives, the devices that do them, and their limits.

Imports none of the other four packages.
"""

from primitives.errors import LimitError, RobotError
from primitives.primitive import Primitive

__all__ = ["LimitError", "Primitive", "RobotError"]
