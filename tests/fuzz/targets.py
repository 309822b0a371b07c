"""Every parser that is fuzzed."""

from __future__ import annotations

from importlib import import_module
from importlib.util import find_spec

from tests.fuzz.target import FuzzTarget

MODULES = ("tests.fuzz.files", "tests.fuzz.wire", "tests.fuzz.policy_messages")


def all_targets() -> tuple[FuzzTarget, ...]:
    """Targets of all modules that exist, in order."""
    modules = [import_module(name) for name in MODULES if find_spec(name) is not None]
    return tuple(target for module in modules for target in module.TARGETS)
