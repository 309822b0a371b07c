"""Plugins: what other installed packages add, found by their entry points and loaded when named.

A package names each addition in its ``pyproject.toml``, for example
``[project.entry-points."tacgrasp.policies"]`` with ``theirs = "their_package:make_policy"``. Only
what a run names is loaded, so that a broken plugin harms no run that does without it. A name of
tacgrasp's own can't be taken. Not here: what an addition of each group is (docs/plugins.md).
"""

from __future__ import annotations

from collections.abc import Callable, Collection
from dataclasses import dataclass, replace
from functools import cache
from importlib import metadata
from typing import TypeVar

from tacgrasp.base.errors import UsageError

T = TypeVar("T")

GROUPS = ("sensors", "arms", "grippers", "policies", "tasks", "objects")
"""What a plugin can add: the entry points ``tacgrasp.<group>``."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Plugin:
    """One addition of an installed package, not loaded yet.

    Attributes:
        group: One of ``GROUPS``.
        name: Name by which a run asks for it.
        package: Package that adds it, with its version.
        place: Module and attribute (``module:attribute``).
        others: Packages that add the same name and are left out.
    """

    group: str
    name: str
    package: str
    place: str
    others: tuple[str, ...] = ()

    @property
    def title(self) -> str:
        """The plugin in a message."""
        return f"{self.name} of {self.package} (tacgrasp.{self.group})"


@cache
def plugins(group: str) -> dict[str, Plugin]:
    """Every plugin of a group by its name, sorted; nothing of it is imported.

    Of packages that add one name, the first by alphabet is taken.
    """
    found: dict[str, Plugin] = {}
    points = metadata.entry_points(group=f"tacgrasp.{group}")
    for point in sorted(points, key=lambda each: (each.name, _package(each))):
        name, package = point.name, _package(point)
        if name in found:
            found[name] = replace(found[name], others=(*found[name].others, package))
        else:
            found[name] = Plugin(group=group, name=name, package=package, place=point.value)
    return found


def names_with(group: str, own: Collection[str]) -> list[str]:
    """Names of tacgrasp's own, then those of plugins."""
    return [*own, *(name for name in plugins(group) if name not in own)]


def load_plugin(group: str, name: str, check: Callable[[object], str]) -> object:
    """Import a plugin and check what it gives.

    Args:
        group: One of ``GROUPS``.
        name: A name out of ``plugins(group)``.
        check: Why an object is no addition of this group; empty for one that is.

    Raises:
        UsageError: It can't be imported, or gives something else; the message names the package.
    """
    plugin = plugins(group)[name]
    point = metadata.EntryPoint(name=name, group=f"tacgrasp.{group}", value=plugin.place)
    try:
        added = point.load()
    except (Exception, SystemExit) as error:  # of foreign code: whatever it raises, it is named
        reason = f"{type(error).__name__}: {error}"
    else:
        reason = check(added)
        if not reason:
            return added
    raise UsageError(
        f"the plugin {plugin.title} is left out: {' '.join(reason.split())}; mend or uninstall "
        f"{plugin.package.split()[0]}"
    ) from None


def _package(point: metadata.EntryPoint) -> str:
    return "an unknown package" if point.dist is None else f"{point.dist.name} {point.dist.version}"
