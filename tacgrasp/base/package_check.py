"""Check that our five top-level packages lie in one folder, since their names are common ones."""

from __future__ import annotations

from importlib.util import find_spec
from pathlib import Path

from tacgrasp.base.errors import UsageError

PACKAGES = ("cltp", "primitives", "policies", "sim")


def check_packages() -> None:
    """Refuse to run with another distribution's ``sim`` or ``policies``. Imports none of them.

    Raises:
        UsageError: A package is missing or comes from another folder, which the message names.
    """
    home = Path(__file__).resolve().parents[2]
    for name in PACKAGES:
        location = _location(name)
        if location is None:
            raise UsageError(
                f"package {name!r} is missing beside tacgrasp in {home}; install tacgrasp again "
                "in a virtual environment of its own"
            )
        if location.parent != home:
            raise UsageError(
                f"package {name!r} comes from {location}, not from {home} like tacgrasp: another "
                "distribution or folder of that name is in the way; remove it, or install "
                "tacgrasp in a virtual environment of its own"
            )


def _location(name: str) -> Path | None:
    try:
        spec = find_spec(name)
    except ValueError:  # something without a spec sits in sys.modules under this name
        spec = None
    if spec is None:
        return None
    if spec.origin is not None and spec.origin not in ("built-in", "frozen"):
        origin = Path(spec.origin).resolve()
        return origin.parent if origin.name == "__init__.py" else origin
    folders = list(spec.submodule_search_locations or [])
    return Path(folders[0]).resolve() if folders else Path(spec.origin or name)
