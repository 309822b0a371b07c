"""The arrows between the five packages, circles, and what an import loads."""

import ast
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
MAY_IMPORT = {
    "tacgrasp": {"policies", "sim", "primitives", "cltp"},
    "policies": {"cltp", "primitives"},
    "sim": {"cltp", "primitives"},
    "cltp": set(),
    "primitives": set(),
}
HEAVY = ("torch", "open3d", "rtde_control", "rtde_receive", "dynamixel_sdk", "serial")


def modules():
    for package in MAY_IMPORT:
        for path in sorted((ROOT / package).rglob("*.py")):
            parts = path.relative_to(ROOT).with_suffix("").parts
            yield ".".join(parts[:-1] if parts[-1] == "__init__" else parts), path


def imported(tree, module):
    """Full names that a module imports; 'from a import b' may mean module a.b."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{module}: a relative import; use absolute ones"
            yield node.module
            yield from (f"{node.module}.{alias.name}" for alias in node.names)


def trees():
    return {name: ast.parse(path.read_text(encoding="utf-8")) for name, path in modules()}


@pytest.mark.parametrize("package", MAY_IMPORT)
def test_a_package_imports_only_what_its_arrows_allow(package):
    wrong = [
        f"{name} imports {other}"
        for name, tree in trees().items()
        if name.split(".")[0] == package
        for other in imported(tree, name)
        if other.split(".")[0] in MAY_IMPORT.keys() - MAY_IMPORT[package] - {package}
    ]
    assert not wrong


def circles(edges):
    """Modules that lie on a circle of imports."""
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


def test_no_circle_of_imports():
    parsed = trees()
    edges = {
        name: {o for o in imported(tree, name) if o in parsed and o != name}
        for name, tree in parsed.items()
    }
    # Importing a package's part runs its __init__ first, which may itself import that part.
    for name in edges:
        if (ROOT / name.replace(".", "/") / "__init__.py").exists():
            continue
        edges[name] -= {p for p in edges if name.startswith(p + ".")}
    assert circles(edges) == []


@pytest.mark.parametrize(
    "statement",
    [
        "import tacgrasp",
        "import primitives, primitives.execution, primitives.limits",
        "import cltp.tactile.cloud, cltp.tactile.states, cltp.texts.captions, policies.rules",
        "import policies.extraction, policies.teacher, policies.baselines, policies.recorded",
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


def test_every_package_is_read():
    found = {name.split(".")[0] for name, _ in modules()}
    assert found == set(MAY_IMPORT)
