"""What a text without a digit is not tried with must need a digit."""

from __future__ import annotations

import re
import re._constants as ops
import re._parser as parser
import subprocess
import sys
from collections.abc import Iterable, Iterator
from typing import Any

import pytest

import policies.instructions.reader  # noqa: F401  # makes the patterns
from policies.instructions.english.number_pattern import NumberPattern


def needs_digit(sequence: Iterable[tuple[Any, Any]]) -> bool:
    return any(is_digit(op, argument) for op, argument in sequence)


def is_digit(op: Any, argument: Any) -> bool:
    """Whether a node of a parsed expression matches nothing without a digit."""
    if op is ops.LITERAL:
        return chr(argument).isdigit()
    if op is ops.IN:
        return all(is_digit(*member) for member in argument)
    if op is ops.CATEGORY:
        return argument is ops.CATEGORY_DIGIT
    if op is ops.RANGE:
        return all(chr(end).isdigit() for end in argument)
    if op is ops.BRANCH:
        return all(map(needs_digit, argument[1]))
    if op in (ops.MAX_REPEAT, ops.MIN_REPEAT):
        return argument[0] > 0 and needs_digit(argument[2])
    if op is ops.SUBPATTERN:
        return needs_digit(argument[3])
    return op is ops.ASSERT and needs_digit(argument[1])


def patterns_in(value: object) -> Iterator[NumberPattern]:
    if isinstance(value, NumberPattern):
        yield value
    elif isinstance(value, tuple):
        for each in value:
            yield from patterns_in(each)


def test_every_number_pattern_needs_a_digit() -> None:
    modules = [m for name, m in sys.modules.items() if name.startswith("policies.instructions")]
    found = [each for module in modules for each in patterns_in(tuple(vars(module).values()))]
    assert len(found) > 100
    for each in found:
        assert needs_digit(parser.parse(each.pattern)), each.pattern


@pytest.mark.parametrize(
    ("pattern", "expected"),
    [
        (r"\d+ N", True),
        (r"(?:a|\d) N", False),
        (r"(?:[1-9]|0\.\d) N", True),
        (r"a \d*", False),
        (r"more (?=\d)", True),
        (r"more (?!\d)", False),
        (r"[\d.] N", False),
    ],
)
def test_the_check_tells_what_needs_a_digit(pattern: str, expected: bool) -> None:
    assert needs_digit(parser.parse(pattern)) == expected


def test_it_is_as_the_expression_that_it_stands_for() -> None:
    pattern, plain = NumberPattern(r"(\d+) N\b"), re.compile(r"(\d+) N\b")
    for text in ("hold it", "12 N and 3 N", "4", ""):
        for method in ("search", "match", "fullmatch"):
            ours, theirs = getattr(pattern, method)(text), getattr(plain, method)(text)
            assert (ours and ours.groups()) == (theirs and theirs.groups())
        spans = [[each.span() for each in one.finditer(text)] for one in (pattern, plain)]
        assert spans[0] == spans[1]
        assert pattern.sub(r"\1 newtons", text) == plain.sub(r"\1 newtons", text)
    found = pattern.search("12 N and 3 N", 4)
    assert found is not None
    assert found.group(1) == "3"
    assert pattern.search("12 N and 3 N", 0, 3) is None


def test_an_instruction_without_a_number_compiles_none_of_them() -> None:
    code = (
        "import gc\n"
        "from policies.instructions.english.number_pattern import NumberPattern\n"
        "from tacgrasp.config.layers import load\n"
        "from tacgrasp.config.terms import contract_of\n"
        "contract_of(load('strawberry')[0])\n"
        "made = [e for e in gc.get_objects() if isinstance(e, NumberPattern)]\n"
        "print(len(made), sum('_compiled' in vars(e) for e in made))\n"
    )
    printed = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True).stdout
    made, compiled = map(int, printed.split())
    assert made > 100
    assert compiled == 0
