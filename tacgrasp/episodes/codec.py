"""Frozen dataclasses to JSON and back, exactly, and the JSON Schema that documents them.

Only what episodes need: dataclasses whose fields are numbers, text, enums, arrays, tuples, mappings
and other dataclasses. Floats survive bit for bit (Python writes the shortest text that reads back
as the same double). The descriptions in a schema are the ``Attributes:`` of the docstrings, so that
field, unit and frame are written in one place.

Not here: which records an episode has (``tacgrasp.episodes.record``).
"""

from __future__ import annotations

import dataclasses
import inspect
import math
import re
import types
import typing
from collections.abc import Mapping
from enum import Enum
from functools import cache
from typing import Any, Literal, TypeVar, Union, get_args, get_origin

import numpy as np

T = TypeVar("T")

_SCALARS: dict[Any, str] = {float: "number", int: "integer", bool: "boolean", str: "string"}
_UNIONS = (Union, types.UnionType)


def to_json(value: object) -> Any:
    """Turn a value into what ``json.dumps`` takes.

    Raises:
        TypeError: A type that episodes don't carry; the message names it.
    """
    if value is None or isinstance(value, bool):
        return value
    if isinstance(value, Enum):
        return value.value
    if isinstance(value, np.bool_):
        return bool(value)
    if isinstance(value, (int, np.integer)):
        return int(value)
    if isinstance(value, (float, np.floating)):
        return float(value)
    if isinstance(value, str):
        return str(value)
    if isinstance(value, np.ndarray):
        return value.tolist()
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        return {f.name: to_json(getattr(value, f.name)) for f in dataclasses.fields(value)}
    if isinstance(value, Mapping):
        return {str(key): to_json(item) for key, item in value.items()}
    if isinstance(value, (tuple, list)):
        return [to_json(item) for item in value]
    if isinstance(value, (set, frozenset)):
        return sorted(to_json(item) for item in value)
    raise TypeError(f"an episode can't carry a {type(value).__name__}: {value!r}")


def not_finite(data: Any, where: str) -> str:
    """Name and value of the first number in ``data`` that JSON has no word for; '' without one."""
    if isinstance(data, float) and not math.isfinite(data):
        return f"{where} is {data}"
    inner: list[tuple[str, Any]] = []
    if isinstance(data, dict):
        inner = [(f"{where}.{key}", item) for key, item in data.items()]
    elif isinstance(data, list):
        inner = [(f"{where}[{i}]", item) for i, item in enumerate(data)]
    return next((found for name, item in inner if (found := not_finite(item, name))), "")


def from_json(kind: type[T], data: object) -> T:
    """Build a dataclass ``kind`` from what ``to_json`` made of one.

    Raises:
        ValueError: A field is missing, unknown or of another type; the message names it. Checks of
            the dataclass itself raise their own errors.
    """
    built: T = _from(kind, data, kind.__name__)
    return built


def json_schema(kind: type) -> dict[str, Any]:
    """JSON Schema (draft 2020-12) of a dataclass, described by its docstring."""
    return {"$schema": "https://json-schema.org/draft/2020-12/schema", **_schema(kind)}


@cache
def _hints(kind: type) -> dict[str, Any]:
    return typing.get_type_hints(kind)


def _from(hint: Any, data: object, where: str) -> Any:
    origin = get_origin(hint)
    if hint in _SCALARS:
        return _scalar(hint, data, where)
    if hint is type(None):
        return _expect(data is None, None, "null", data, where)
    if origin in _UNIONS:
        return _union(hint, data, where)
    if origin is Literal:
        return _expect(data in get_args(hint), data, f"one of {get_args(hint)}", data, where)
    if inspect.isclass(hint) and issubclass(hint, Enum):
        known = [member.value for member in hint]
        _expect(data in known, data, f"one of {', '.join(map(str, known))}", data, where)
        return hint(data)
    if dataclasses.is_dataclass(hint) and inspect.isclass(hint):
        return _dataclass(hint, data, where)
    if inspect.isclass(origin) and issubclass(origin, np.ndarray):
        _expect(isinstance(data, list), data, "a list of numbers", data, where)
        return np.array(data, dtype=_dtype(hint))
    if inspect.isclass(origin) and issubclass(origin, Mapping):
        _expect(isinstance(data, dict), data, "an object", data, where)
        (_, item), pairs = get_args(hint), typing.cast(dict[str, object], data).items()
        return {key: _from(item, value, f"{where}.{key}") for key, value in pairs}
    if origin in (tuple, list, set, frozenset):
        _expect(isinstance(data, list), data, "a list", data, where)
        return _sequence(hint, typing.cast(list[object], data), where)
    raise ValueError(f"{where}: episodes don't carry the type {hint}")


def _expect(holds: bool, value: object, expected: str, got: object, where: str) -> object:
    if not holds:
        raise ValueError(f"{where}: expected {expected}, got {got!r}")
    return value


def _scalar(hint: type, data: object, where: str) -> object:
    if hint is float and isinstance(data, int) and not isinstance(data, bool):
        return float(data)
    fits = type(data) is hint
    return _expect(fits, data, f"{_SCALARS[hint]}", data, where)


def _union(hint: Any, data: object, where: str) -> object:
    problems = []
    # Exact scalar types first: in ``bool | float | int`` an integer must not become a float.
    arms = sorted(get_args(hint), key=lambda arm: arm is not type(data))
    for arm in arms:
        try:
            return _from(arm, data, where)
        except ValueError as error:
            problems.append(str(error))
    raise ValueError("; or ".join(problems))


def _sequence(hint: Any, data: list[object], where: str) -> object:
    origin, items = get_origin(hint), get_args(hint)
    if origin is tuple and not (len(items) == 2 and items[1] is Ellipsis):
        _expect(len(data) == len(items), data, f"{len(items)} items", data, where)
        pairs = zip(items, data, strict=True)
        return tuple(_from(item, value, f"{where}[{i}]") for i, (item, value) in enumerate(pairs))
    return origin(_from(items[0], value, f"{where}[{i}]") for i, value in enumerate(data))


def _dataclass(kind: type, data: object, where: str) -> object:
    _expect(isinstance(data, dict), data, f"an object ({kind.__name__})", data, where)
    given = typing.cast(dict[str, object], data)
    fields = {field.name: field for field in dataclasses.fields(kind)}
    if unknown := sorted(given.keys() - fields.keys()):
        raise ValueError(f"{where}: unknown field {unknown[0]!r}; known: {', '.join(fields)}")
    for name, field in fields.items():
        required = (field.default, field.default_factory) == (dataclasses.MISSING,) * 2
        if required and name not in given:
            raise ValueError(f"{where}: field {name!r} is missing")
    hints = _hints(kind)
    return kind(
        **{name: _from(hints[name], item, f"{where}.{name}") for name, item in given.items()}
    )


def _dtype(hint: Any) -> np.dtype[Any]:
    """Element type of an annotation ``NDArray[np.float64]``; float64 where it is left open."""
    inner = get_args(get_args(hint)[1])
    return np.dtype(inner[0]) if inner and inspect.isclass(inner[0]) else np.dtype(np.float64)


def _schema(hint: Any) -> dict[str, Any]:
    origin = get_origin(hint)
    if hint in _SCALARS:
        return {"type": _SCALARS[hint]}
    if hint is type(None):
        return {"type": "null"}
    if origin in _UNIONS:
        return {"anyOf": [_schema(arm) for arm in get_args(hint)]}
    if origin is Literal:
        return {"enum": list(get_args(hint))}
    if inspect.isclass(hint) and issubclass(hint, Enum):
        return {"enum": [member.value for member in hint]}
    if dataclasses.is_dataclass(hint) and inspect.isclass(hint):
        return _object_schema(hint)
    if inspect.isclass(origin) and issubclass(origin, np.ndarray):
        return {"type": "array"}
    if inspect.isclass(origin) and issubclass(origin, Mapping):
        return {"type": "object", "additionalProperties": _schema(get_args(hint)[1])}
    if origin is tuple and get_args(hint)[-1:] != (Ellipsis,):
        items = [_schema(item) for item in get_args(hint)]
        return {"type": "array", "prefixItems": items, "minItems": len(items)}
    if origin in (tuple, list, set, frozenset):
        return {"type": "array", "items": _schema(get_args(hint)[0])}
    raise ValueError(f"episodes don't carry the type {hint}")


def _object_schema(kind: type) -> dict[str, Any]:
    described = field_descriptions(kind)
    summary = (inspect.getdoc(kind) or "").split("\n\n")[0].replace("\n", " ")
    properties = {}
    for field in dataclasses.fields(kind):
        text = {"description": described[field.name]} if field.name in described else {}
        properties[field.name] = {**_schema(_hints(kind)[field.name]), **text}
    return {
        "title": kind.__name__,
        "description": summary,
        "type": "object",
        "properties": properties,
        "required": list(properties),
    }


@cache
def field_descriptions(kind: type) -> dict[str, str]:
    """What the ``Attributes:`` section of a docstring says of each field.

    A line ``a, b: text`` describes both; lines indented further continue the one before.
    """
    described: dict[str, str] = {}
    names: list[str] = []
    section = re.search(r"^Attributes:\n(.*?)(?=^\S|\Z)", inspect.getdoc(kind) or "", re.M | re.S)
    for line in section.group(1).splitlines() if section else []:
        start = re.match(r" {4}(\w+(?:, \w+)*): (.*)", line)
        if start:
            names = start.group(1).split(", ")
            described.update(dict.fromkeys(names, start.group(2)))
        elif line.strip():
            described.update({name: f"{described[name]} {line.strip()}" for name in names})
    return described
