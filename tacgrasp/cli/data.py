"""``tacgrasp data NAME``: make data sets of contacts, and look into them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from tacgrasp.base.counted import counted
from tacgrasp.cli import data_tools
from tacgrasp.cli.flags import run_subcommand
from tacgrasp.datasets.requests import GenerateRequest, ImportRequest


def generate(request: GenerateRequest) -> None:
    """Make a data set, or what is missing of it."""
    from tacgrasp.datasets.generate import generate

    generate(request)


def import_table(request: ImportRequest) -> None:
    """Make a data set of measured contacts, and count where its labels come from."""
    from tacgrasp.console import make_console
    from tacgrasp.datasets.import_touches import import_touches

    counts, out = import_touches(request), make_console()
    out.print(f"written   {request.out}: {counted(counts.contacts, 'contact')}")
    if counts.untouched:
        out.print(f"untouched {counts.untouched} with no contact, not counted below")
    for slot in counts.given:
        out.print(
            f"{slot:9} {counts.given[slot]} given, {counts.measured[slot]} measured, "
            f"{counts.unknown[slot]} unknown"
        )


COMMANDS: dict[str, tuple[type[Any], Callable[[Any], int | None]]] = {
    "generate": (GenerateRequest, generate),
    "inspect": (data_tools.InspectFlags, data_tools.inspect),
    "stats": (data_tools.StatsFlags, data_tools.stats),
    "verify": (data_tools.VerifyFlags, data_tools.verify),
    "gallery": (data_tools.GalleryFlags, data_tools.gallery),
    "sheet": (data_tools.SheetFlags, data_tools.sheet),
    "import": (ImportRequest, import_table),
}
"""Flags and function of each subcommand; the function returns the exit code, None for 0."""


def main(argv: Sequence[str]) -> int:
    """Run one subcommand and return its exit code."""
    return run_subcommand("data", argv, COMMANDS) or 0
