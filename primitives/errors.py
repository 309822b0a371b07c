"""Errors of the robot. The loop stops, makes the robot safe and ends the episode."""


class RobotError(Exception):
    """A device failed or refused a command. The loop stops the arm and makes the robot safe."""


class TorqueOffError(RobotError):
    """A gripper has failed with its torque off: it holds nothing any more."""


class LimitError(RobotError):
    """A command was refused because it would leave the limits. Nothing was sent."""
