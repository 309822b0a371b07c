"""Packages with entry points, as an installer would leave them, without one."""

from __future__ import annotations

import tomllib
from pathlib import Path

from pytest import MonkeyPatch

from tacgrasp.base.plugins import plugins
from tests.paths import ROOT

EXAMPLE = ROOT / "examples" / "plugin"


def install(
    folder: Path,
    monkeypatch: MonkeyPatch,
    points: dict[str, dict[str, str]],
    *,
    name: str = "their-package",
    code: Path | None = None,
) -> None:
    """Lay metadata of a package into ``folder`` and put it, and its code, on the path.

    Args:
        folder: An empty folder.
        monkeypatch: Undoes it.
        points: Entry points by group.
        name: Name of the package.
        code: Folder of its modules; by default ``folder``.
    """
    info = folder / f"{name.replace('-', '_')}-1.2.dist-info"
    info.mkdir(parents=True)
    (info / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {name}\nVersion: 1.2\n")
    lines = [
        line
        for group, names in points.items()
        for line in (f"[{group}]", *(f"{key} = {value}" for key, value in names.items()))
    ]
    (info / "entry_points.txt").write_text("\n".join(lines) + "\n")
    monkeypatch.syspath_prepend(str(folder))
    if code is not None:
        monkeypatch.syspath_prepend(str(code))
    plugins.cache_clear()


def install_example(folder: Path, monkeypatch: MonkeyPatch) -> None:
    """Install ``examples/plugin`` by what its own pyproject.toml says."""
    project = tomllib.loads((EXAMPLE / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    install(folder, monkeypatch, project["entry-points"], name=project["name"], code=EXAMPLE)
