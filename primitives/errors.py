"""Errors of the robot: stop, make safe, end the episode."""


class RobotError(Exception):
    """A device failed or refused. The loop stops the arm, leaves the task's safe state and ends."""


class LimitError(RobotError):
    """A command was refused because it would leave the limits. Nothing was sent."""
