"""A plugin for tacgrasp that adds one of everything, for raspberries."""

from pathlib import Path

TASK = Path(__file__).parent / "raspberry.yaml"
"""The entry point of the task: the path of its file."""
