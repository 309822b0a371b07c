"""``tacgrasp simulate press``: press one object into one sensor's gel."""

from __future__ import annotations

from collections.abc import Sequence

from tacgrasp.cli.flags import run_subcommand, writable
from tacgrasp.datasets.requests import PressRequest


def main(argv: Sequence[str]) -> int:
    """Run one subcommand and return its exit code."""
    run_subcommand("simulate", argv, {"press": (PressRequest, _press)})
    return 0


def _press(request: PressRequest) -> None:
    writable(request.out, ".npz", flag="--out")
    from tacgrasp.datasets.press import run

    run(request)
