"""The graph of imports: packages and folders, their arrows, circles, sizes, and what loads."""

import ast
import re
import subprocess
import sys
from collections import defaultdict
from functools import cache

import pytest

from tests.paths import ROOT

PACKAGES = {
    "tacgrasp": {"policies", "sim", "primitives", "cltp"},
    "policies": {"cltp", "primitives"},
    "sim": {"cltp", "primitives"},
    "cltp": set(),
    "primitives": set(),
}
HEAVY = ("torch", "open3d", "rtde_control", "rtde_receive", "dynamixel_sdk", "serial")
MAX_MODULES = {"tacgrasp": 8, "cltp": 3, "sim": 3, "tacgrasp.cli": 99}
"""Modules that a folder may hold, 16 where nothing is said."""


@cache
def trees():
    """Every module of the product by its dotted name; a folder's __init__ by the folder's."""
    found = {}
    for package in PACKAGES:
        for path in sorted((ROOT / package).rglob("*.py")):
            parts = path.relative_to(ROOT).with_suffix("").parts
            name = ".".join(parts[:-1] if parts[-1] == "__init__" else parts)
            found[name] = ast.parse(path.read_text(encoding="utf-8"))
    return found


@cache
def folders():
    return {
        ".".join(path.parent.relative_to(ROOT).parts)
        for package in PACKAGES
        for path in (ROOT / package).rglob("__init__.py")
    }


@cache
def imported(module):
    """Full names that a module imports; 'from a import b' may mean module a.b."""
    return tuple(_imported(trees()[module], module))


def _imported(tree, module):
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{module}: a relative import; use absolute ones"
            yield from (
                name if name in trees() else node.module
                for name in (f"{node.module}.{alias.name}" for alias in node.names)
            )


def folder_of(module):
    return module if module in folders() else module.rpartition(".")[0]


@cache
def arrows():
    """Folder -> the folders that it imports from -> one import that shows it."""
    graph = defaultdict(dict)
    for module in trees():
        for target in imported(module):
            if target.split(".")[0] in PACKAGES:
                assert target in trees(), f"{module} imports {target}, which does not exist"
                if folder_of(target) != folder_of(module):
                    graph[folder_of(module)][folder_of(target)] = f"{module} imports {target}"
    return graph


def allowed(folder):
    """The names after 'May import:' at the end of a folder's docstring."""
    paragraphs = (ast.get_docstring(trees()[folder]) or "").split("\n\n")
    match = re.fullmatch(r"May import: (.+)\.", " ".join(paragraphs[-1].split()))
    assert match, f"{folder}/__init__.py must end with a paragraph 'May import: ….'"
    return set() if match[1] == "nothing of ours" else set(match[1].split(", "))


def covers(name, folder, origin):
    """Whether a name in origin's docstring permits a folder: itself, or one that it lies in.

    The name of origin's own package stands for the modules at its root alone.
    """
    return folder == name or (folder.startswith(f"{name}.") and name != origin.partition(".")[0])


@pytest.mark.parametrize("package", PACKAGES)
def test_a_package_imports_only_what_its_arrows_allow(package):
    wrong = [
        f"{name} imports {other}"
        for name in trees()
        if name.split(".")[0] == package
        for other in imported(name)
        if other.split(".")[0] in PACKAGES.keys() - PACKAGES[package] - {package}
    ]
    assert not wrong


@pytest.mark.parametrize("folder", sorted(folders()))
def test_a_folder_says_what_it_is_for_and_imports_what_it_says(folder):
    paragraphs = (ast.get_docstring(trees()[folder]) or "").split("\n\n")
    assert len(paragraphs) >= 2, "expected what it is for, what it is not, and 'May import: ….'"
    names = allowed(folder)
    targets = arrows()[folder]
    assert not [why for to, why in targets.items() if not any(covers(n, to, folder) for n in names)]
    unused = {n for n in names if not any(covers(n, to, folder) for to in targets)}
    assert not unused, f"{folder} may import {unused}, and does not"


@pytest.mark.parametrize("folder", sorted(folders()))
def test_a_folder_is_small_enough_to_be_read(folder):
    modules = [m for m in trees() if m not in folders() and folder_of(m) == folder]
    assert len(modules) <= MAX_MODULES.get(folder, 16), modules


def circles(edges):
    """Nodes that lie on a circle, or between two."""
    left = dict(edges)
    while True:
        done = [name for name, targets in left.items() if not targets & left.keys()]
        if not done:
            return sorted(left)
        for name in done:
            del left[name]


def test_the_search_for_circles_finds_one_and_only_that():
    assert circles({"a": {"b"}, "b": {"c"}, "c": set()}) == []
    assert circles({"a": {"b"}, "b": {"a"}, "c": set()}) == ["a", "b"]


def test_no_circle_of_folders():
    assert circles({folder: set(arrows()[folder]) for folder in folders()}) == []


def test_no_circle_of_modules():
    edges = {name: {o for o in imported(name) if o in trees() and o != name} for name in trees()}
    # Importing a folder's module runs its __init__ first, which may itself import that module.
    for name in edges.keys() - folders():
        edges[name] -= {p for p in edges if name.startswith(p + ".")}
    assert circles(edges) == []


def test_no_public_class_name_stands_twice():
    places = defaultdict(list)
    for module, tree in trees().items():
        for node in tree.body:
            if isinstance(node, ast.ClassDef) and not node.name.startswith("_"):
                places[node.name].append(module)
    assert not {name: where for name, where in places.items() if len(where) > 1}


@pytest.mark.parametrize(
    "statement",
    [
        "import tacgrasp",
        "import primitives, primitives.execution, primitives.limits",
        "import cltp.tactile.cloud, cltp.tactile.states, cltp.texts.captions, policies.rules",
        "import policies.extraction, policies.teacher, policies.baselines",
    ],
)
def test_an_import_loads_neither_torch_nor_open3d_nor_a_device_sdk(statement):
    code = (
        f"import sys; {statement}; "
        f"print([m for m in {HEAVY!r} if m in sys.modules])"
    )  # fmt: skip
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True
    )
    assert done.stdout.strip() == "[]"


FOR_TESTS_ALONE = "sim.independent"
LEARNING = ("cltp.train", "tacgrasp.training", "tacgrasp.datasets", "sim.full", "sim.tcl3d")


def reached(graph, folder):
    """Folders that a folder imports from, directly or by way of others."""
    found, left = set(), [folder]
    while left:
        new = graph.get(left.pop(), set()) - found
        found |= new
        left += new
    return found


def test_nothing_that_trains_or_makes_data_reaches_the_generator_for_tests():
    graph = {folder: set(targets) for folder, targets in arrows().items()}
    assert FOR_TESTS_ALONE in folders()
    assert not [folder for folder in LEARNING if FOR_TESTS_ALONE in reached(graph, folder)]
    users = {folder for folder, targets in graph.items() if FOR_TESTS_ALONE in targets}
    assert all(folder.startswith("tacgrasp.benchmarks.") for folder in users)


def test_the_search_for_what_is_reached_follows_arrows():
    graph = {"a": {"b"}, "b": {"c"}, "d": {"a"}}
    assert reached(graph, "a") == {"b", "c"}


def test_every_package_is_read():
    assert {name.split(".")[0] for name in trees()} == set(PACKAGES)
