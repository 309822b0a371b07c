"""The truth of a question as an expression over a scene's names, evaluated without running code.

An expression has names of ``tacgrasp.lessons.dialogue.scene``, numbers, words in quotes (or bare,
where they are words of a class: ``shape == sphere``), ``+ - * / **``, comparisons, ``in`` a list,
``and or not``, ``a if c else b`` and the functions ``abs``, ``hypot``, ``min``, ``max`` and
``sqrt``. Nothing else is read. Words of depth and area have an order, so ``depth >= 'deep'`` is a
comparison. What is true counts as 1 in a sum (``cut_left + cut_right``).
"""

from __future__ import annotations

import ast
import math
import operator
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from cltp.tactile.states import CLASSES
from tacgrasp.lessons.dialogue.scene import NAMES, Value

MAX_LENGTH = 1000
"""Longest expression [characters]."""

MAX_POWER = 4
"""Largest power of a number: more would take its time."""

_WORDS = frozenset(word for words in CLASSES.values() for word in words)
_ORDERED = [CLASSES["depth"], CLASSES["area"]]
_ARITHMETIC: Mapping[type[ast.AST], Callable[[float, float], float]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.Pow: math.pow,
}
_COMPARISONS: Mapping[type[ast.AST], Callable[[Any, Any], bool]] = {
    ast.Lt: operator.lt,
    ast.LtE: operator.le,
    ast.Gt: operator.gt,
    ast.GtE: operator.ge,
    ast.Eq: operator.eq,
    ast.NotEq: operator.ne,
}
_FUNCTIONS: Mapping[str, tuple[Sequence[int], Callable[..., float]]] = {
    "abs": ((1,), abs),
    "hypot": ((2,), math.hypot),
    "min": (range(2, 9), min),
    "max": (range(2, 9), max),
    "sqrt": ((1,), math.sqrt),
}
"""Functions, and how many arguments they may have."""


_CONDITION_NAMES = frozenset(("contact", "cut", "cut_left", "cut_right", "cut_top", "cut_bottom"))
_WORD_NAMES = frozenset(
    (*CLASSES, "cut_sides", "wholeness", "side_x", "side_y", "worse_axis", "force_band", "action",
     "reason")
)  # fmt: skip


@dataclass(frozen=True, slots=True, kw_only=True)
class TruthValue:
    """Value of an expression in a scene.

    Attributes:
        value: The value; None where a name that it needs has none, or something is divided by 0.
        margin: Least distance of two numbers that were compared; infinite without a comparison.
    """

    value: Value
    margin: float = math.inf


class Expression:
    """A parsed expression.

    Args:
        text: The expression.

    Attributes:
        text: The expression.
        names: Names of a scene that it has, in their order.

    Raises:
        ValueError: It is too long, or has something that is no part of an expression.
    """

    def __init__(self, text: str) -> None:
        self.text = text.strip()
        if not self.text or len(self.text) > MAX_LENGTH:
            raise ValueError(f"a truth needs 1 to {MAX_LENGTH} characters, got {len(self.text)}")
        try:
            self._tree = ast.parse(self.text, mode="eval").body
        except (SyntaxError, ValueError, RecursionError, MemoryError):
            raise ValueError(f"{self.text!r} is no expression") from None
        nodes = [node for node in ast.walk(self._tree) if isinstance(node, ast.Name)]
        nodes.sort(key=lambda node: node.col_offset)
        self.names = tuple(dict.fromkeys(node.id for node in nodes if node.id in NAMES))
        self._check(self._tree)

    @cached_property
    def divided(self) -> tuple[tuple[str, ...], ...]:
        """The names above and below the bar of the first quotient of two; empty without one."""
        for node in ast.walk(self._tree):
            if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Div):
                sides = tuple(
                    tuple(n.id for n in ast.walk(side) if isinstance(n, ast.Name) and n.id in NAMES)
                    for side in (node.left, node.right)
                )
                if all(len(set(side)) == 1 for side in sides):
                    return sides
        return ()

    @cached_property
    def numbers(self) -> tuple[float, ...]:
        """Its numbers, in their order."""
        return tuple(
            float(node.value)
            for node in ast.walk(self._tree)
            if isinstance(node, ast.Constant) and isinstance(node.value, (int, float))
        )

    @property
    def power_of_ten(self) -> float:
        """The power of ten that all of it is multiplied with, or divided by; else 1."""
        match self._tree:
            case ast.BinOp(
                op=ast.Div(),
                left=ast.BinOp(op=ast.Mult(), left=left, right=right),
                right=ast.Name(),
            ):
                return _power_of_ten(right) or _power_of_ten(left) or 1.0
            case ast.BinOp(op=ast.Mult(), left=left, right=right):
                return _power_of_ten(right) or _power_of_ten(left) or 1.0
            case ast.BinOp(op=ast.Div(), right=right):
                return 1 / (_power_of_ten(right) or 1.0)
        return 1.0

    @property
    def is_percentage(self) -> bool:
        """Whether 100 times a quotient is in it."""
        nodes = list(ast.walk(self._tree))
        products = [n for n in nodes if isinstance(n, ast.BinOp) and isinstance(n.op, ast.Mult)]
        is_hundredfold = any(
            isinstance(side, ast.Constant) and side.value == 100
            for product in products
            for side in (product.left, product.right)
        )
        return is_hundredfold and any(isinstance(node, ast.Div) for node in nodes)

    @property
    def is_hundredth(self) -> bool:
        """Whether something in it is divided by 100."""
        return any(
            isinstance(node, ast.BinOp)
            and isinstance(node.op, ast.Div)
            and isinstance(node.right, ast.Constant)
            and node.right.value == 100
            for node in ast.walk(self._tree)
        )

    @cached_property
    def choices(self) -> tuple[str, ...]:
        """The words of ``a if c else b`` where it is one between quoted words; else empty.

        Of ``shape if shape in ('ring', 'disc') else 'neither'`` all that it names.
        """

        def words(node: ast.AST) -> list[str | None]:
            match node:
                case ast.IfExp(body=body, orelse=orelse):
                    return words(body) + words(orelse)
                case ast.Constant(value=str(word)):
                    return [word]
                case ast.Name(id=name) if name in CLASSES:
                    return [
                        each.value
                        for each in ast.walk(self._tree)
                        if isinstance(each, ast.Constant) and isinstance(each.value, str)
                    ]
            return [None]

        found = [word for word in words(self._tree) if word is not None]
        is_choice = isinstance(self._tree, ast.IfExp) and len(found) == len(words(self._tree))
        return tuple(dict.fromkeys(found)) if is_choice else ()

    @cached_property
    def result(self) -> str:
        """What it comes to: 'number', 'condition' or 'word'; '' where it can be several."""
        return _result_of(self._tree)

    def _check(self, node: ast.AST) -> None:
        """Refuse all that is not listed in the module's docstring."""
        match node:
            case ast.Name(id=name) if name in NAMES or name in _WORDS:
                return
            case ast.Name(id=name):
                raise ValueError(f"no name is called {name!r}; known: {', '.join(NAMES)}")
            case ast.Constant(value=str() | int() | float()):
                return
            case ast.UnaryOp(op=ast.USub() | ast.UAdd() | ast.Not(), operand=operand):
                parts = [operand]
            case ast.BinOp(op=ast.Pow(), right=right) if not _is_power(right):
                raise ValueError(
                    f"{self.text!r}: a truth's power must be a number from 0 to {MAX_POWER}"
                )
            case ast.BinOp(op=ast.Div(), right=ast.Constant(value=0)):
                raise ValueError(f"{self.text!r} divides by 0")
            case ast.BinOp(left=left, op=op, right=right) if type(op) in _ARITHMETIC:
                parts = [left, right]
            case ast.BoolOp(values=values):
                parts = values
            case ast.IfExp(test=test, body=body, orelse=orelse):
                parts = [test, body, orelse]
            case ast.Compare(
                left=left,
                ops=[ast.In() | ast.NotIn()],
                comparators=[ast.Tuple(elts=others) | ast.List(elts=others) | ast.Set(elts=others)],
            ):
                parts = [left, *others]
            case ast.Compare(left=left, ops=ops, comparators=others) if all(
                type(op) in _COMPARISONS for op in ops
            ):
                parts = [left, *others]
            case ast.Call(func=ast.Name(id=name), args=args, keywords=[]) if (
                name in _FUNCTIONS and len(args) in _FUNCTIONS[name][0]
            ):
                parts = args
            case _:
                raise ValueError(
                    f"{self.text!r} has {type(node).__name__}, which no truth may have; use names, "
                    "numbers, quoted words, + - * / **, comparisons, in, and or not, if else, "
                    + " ".join(_FUNCTIONS)
                )
        for part in parts:
            self._check(part)

    def evaluate(self, values: Mapping[str, Value]) -> TruthValue:
        """The value in a scene.

        Raises:
            ValueError: Words and numbers are mixed, or a root has no value.
        """
        margins = [math.inf]
        try:
            value = _evaluate(self._tree, values, margins)
        except (_UndefinedError, ZeroDivisionError):
            return TruthValue(value=None)
        except (TypeError, ValueError, ArithmeticError) as error:
            raise ValueError(f"{self.text!r} can't be evaluated: {error}") from None
        return TruthValue(value=value, margin=min(margins))


def _power_of_ten(node: ast.AST) -> float | None:
    """The number that a node is if that is a power of ten, else None."""
    match node:
        case ast.Constant(value=int(number) | float(number)) if number > 0:
            power = round(math.log10(number))
            return float(number) if math.isclose(number, 10.0**power) else None
    return None


def _is_power(node: ast.AST) -> bool:
    match node:
        case ast.Constant(value=int(power) | float(power)):
            return 0 <= power <= MAX_POWER
    return False


class _UndefinedError(Exception):
    """A name has no value in the scene."""


def _evaluate(node: ast.AST, values: Mapping[str, Value], margins: list[float]) -> Any:
    match node:
        case ast.Name(id=name):
            value = values.get(name) if name in NAMES else name
            if value is None:
                raise _UndefinedError
            return value
        case ast.Constant(value=value):
            return value
        case ast.UnaryOp(op=ast.Not(), operand=operand):
            return not _evaluate(operand, values, margins)
        case ast.UnaryOp(op=op, operand=operand):
            inner = _evaluate(operand, values, margins)
            return -inner if isinstance(op, ast.USub) else +inner
        case ast.BinOp(left=left, op=op, right=right):
            pair = (_evaluate(left, values, margins), _evaluate(right, values, margins))
            if any(isinstance(one, str) for one in pair):
                raise TypeError("words have no sum or product")
            return _ARITHMETIC[type(op)](*pair)
        case ast.BoolOp(op=op, values=parts):
            truths = [bool(_evaluate(part, values, margins)) for part in parts]
            return all(truths) if isinstance(op, ast.And) else any(truths)
        case ast.IfExp(test=test, body=body, orelse=orelse):
            return _evaluate(body if _evaluate(test, values, margins) else orelse, values, margins)
        case ast.Compare(
            left=left,
            ops=[(ast.In() | ast.NotIn()) as op],
            comparators=[ast.Tuple(elts=parts) | ast.List(elts=parts) | ast.Set(elts=parts)],
        ):
            own = _evaluate(left, values, margins)
            is_in = own in [_evaluate(part, values, margins) for part in parts]
            return is_in == isinstance(op, ast.In)
        case ast.Compare(left=left, ops=ops, comparators=others):
            sides = [_evaluate(part, values, margins) for part in (left, *others)]
            return all(
                _compare(_COMPARISONS[type(op)], a, b, margins)
                for op, a, b in zip(ops, sides, sides[1:], strict=False)
            )
        case ast.Call(func=ast.Name(id=name), args=args):
            return _FUNCTIONS[name][1](*(_evaluate(arg, values, margins) for arg in args))
    raise TypeError(f"unexpected {type(node).__name__}")


def _compare(comparison: Callable[[Any, Any], bool], a: Any, b: Any, margins: list[float]) -> bool:
    if isinstance(a, str) != isinstance(b, str):
        raise TypeError(f"{a!r} and {b!r} can't be compared")
    if isinstance(a, str):
        if comparison in (operator.eq, operator.ne):
            return comparison(a, b)
        for order in _ORDERED:
            if a in order and b in order:
                return comparison(order.index(a), order.index(b))
        raise TypeError(f"{a!r} and {b!r} have no order")
    margins.append(abs(float(a) - float(b)))
    return comparison(a, b)


def _result_of(node: ast.AST) -> str:
    match node:
        case ast.Compare() | ast.BoolOp() | ast.UnaryOp(op=ast.Not()):
            return "condition"
        case ast.Name(id=name) if name in _CONDITION_NAMES:
            return "condition"
        case ast.Name(id=name) if name in _WORD_NAMES or name in _WORDS:
            return "word"
        case ast.Constant(value=str()):
            return "word"
        case ast.IfExp(body=body, orelse=orelse):
            result = _result_of(body)
            return result if result == _result_of(orelse) else ""
    return "number"
