"""Frozen dataclasses to JSON and back, exactly, and the JSON Schema that documents them.

It covers the types of episodes: dataclasses whose fields are numbers, text, enums, arrays, tuples,
mappings and other dataclasses. Floats survive bit for bit (Python writes the shortest text that
reads back as the same double). The descriptions in a schema are the ``Attributes:`` of the
docstrings, so that field, unit and frame are written in one place.

Not here: the records of an episode (``tacgrasp.episodes.record``).
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
    """Turn a value into types of JSON.

    Raises:
        TypeError: A type that episodes don't carry; the message names it.
    """
    if isinstance(value, Enum):
        return value.value
    if isinstance(value, (np.ndarray, np.generic)):
        return value.tolist()
    if value is None or isinstance(value, (bool, int, float, str)):
        return value
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        return {f.name: to_json(getattr(value, f.name)) for f in dataclasses.fields(value)}
    if isinstance(value, Mapping):
        return {str(key): to_json(item) for key, item in value.items()}
    if isinstance(value, (tuple, list)):
        return [to_json(item) for item in value]
    if isinstance(value, (set, frozenset)):
        return sorted(to_json(item) for item in value)
    raise TypeError(f"an episode can't carry a {type(value).__name__}: {value!r}")


def non_finite_number(data: Any, path: str) -> str:
    """Path and value of the first number in ``data`` that JSON can't express; '' without one."""
    if isinstance(data, float) and not math.isfinite(data):
        return f"{path} is {data}"
    items: list[tuple[str, Any]] = []
    if isinstance(data, dict):
        items = [(f"{path}.{key}", item) for key, item in data.items()]
    elif isinstance(data, list):
        items = [(f"{path}[{i}]", item) for i, item in enumerate(data)]
    return next(filter(None, (non_finite_number(item, name) for name, item in items)), "")


def from_json(kind: type[T], data: object) -> T:
    """Build a dataclass ``kind`` from the output of ``to_json``.

    Raises:
        ValueError: A field is missing, unknown or of another type; the message names it. Checks of
            the dataclass itself raise their own errors.
    """
    value: T = _from(kind, data, kind.__name__)
    return value


def json_schema(kind: type) -> dict[str, Any]:
    """JSON Schema (draft 2020-12) of a dataclass, described by its docstring."""
    return {"$schema": "https://json-schema.org/draft/2020-12/schema", **_schema(kind)}


@cache
def _hints(kind: type) -> dict[str, Any]:
    return typing.get_type_hints(kind)


def _from(hint: Any, data: object, path: str) -> Any:
    origin = get_origin(hint)
    if hint in _SCALARS:
        return _scalar(hint, data, path)
    if hint is type(None):
        return _expect(data is None, None, "null", data, path)
    if origin in _UNIONS:
        return _union(hint, data, path)
    if origin is Literal:
        return _expect(data in get_args(hint), data, f"one of {get_args(hint)}", data, path)
    if inspect.isclass(hint) and issubclass(hint, Enum):
        values = [member.value for member in hint]
        _expect(data in values, data, f"one of {', '.join(map(str, values))}", data, path)
        return hint(data)
    if dataclasses.is_dataclass(hint) and inspect.isclass(hint):
        return _dataclass(hint, data, path)
    if inspect.isclass(origin) and issubclass(origin, np.ndarray):
        _expect(isinstance(data, list), data, "a list of numbers", data, path)
        return np.array(data, dtype=_dtype(hint))
    if inspect.isclass(origin) and issubclass(origin, Mapping):
        _expect(isinstance(data, dict), data, "an object", data, path)
        (_, item), pairs = get_args(hint), typing.cast(dict[str, object], data).items()
        return {key: _from(item, value, f"{path}.{key}") for key, value in pairs}
    if origin in (tuple, list, set, frozenset):
        _expect(isinstance(data, list), data, "a list", data, path)
        return _sequence(hint, typing.cast(list[object], data), path)
    raise ValueError(f"{path}: episodes don't carry the type {hint}")


def _expect(valid: bool, value: object, expected: str, got: object, path: str) -> object:
    if not valid:
        raise ValueError(f"{path}: expected {expected}, got {got!r}")
    return value


def _scalar(hint: type, data: object, path: str) -> object:
    if hint is float and isinstance(data, int) and not isinstance(data, bool):
        return float(data)
    return _expect(type(data) is hint, data, _SCALARS[hint], data, path)


def _union(hint: Any, data: object, path: str) -> object:
    problems = []
    # Exact scalar types first: in ``bool | float | int`` an integer must not become a float.
    members = sorted(get_args(hint), key=lambda member: member is not type(data))
    for member in members:
        try:
            return _from(member, data, path)
        except ValueError as error:
            problems.append(str(error))
    raise ValueError("; or ".join(problems))


def _sequence(hint: Any, data: list[object], path: str) -> object:
    origin, items = get_origin(hint), get_args(hint)
    if origin is tuple and not (len(items) == 2 and items[1] is Ellipsis):
        _expect(len(data) == len(items), data, f"{len(items)} items", data, path)
        pairs = zip(items, data, strict=True)
        return tuple(_from(item, value, f"{path}[{i}]") for i, (item, value) in enumerate(pairs))
    return origin(_from(items[0], value, f"{path}[{i}]") for i, value in enumerate(data))


def _dataclass(kind: type, data: object, path: str) -> object:
    _expect(isinstance(data, dict), data, f"an object ({kind.__name__})", data, path)
    values = typing.cast(dict[str, object], data)
    fields = {field.name: field for field in dataclasses.fields(kind)}
    if unknown := sorted(values.keys() - fields.keys()):
        raise ValueError(f"{path}: unknown field {unknown[0]!r}; known: {', '.join(fields)}")
    for name, field in fields.items():
        required = (field.default, field.default_factory) == (dataclasses.MISSING,) * 2
        if required and name not in values:
            raise ValueError(f"{path}: field {name!r} is missing")
    hints = _hints(kind)
    return kind(
        **{name: _from(hints[name], item, f"{path}.{name}") for name, item in values.items()}
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
        return {"anyOf": [_schema(member) for member in get_args(hint)]}
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
    descriptions = field_descriptions(kind)
    summary = (inspect.getdoc(kind) or "").split("\n\n")[0].replace("\n", " ")
    properties = {}
    for field in dataclasses.fields(kind):
        properties[field.name] = _schema(_hints(kind)[field.name])
        if field.name in descriptions:
            properties[field.name]["description"] = descriptions[field.name]
    return {
        "title": kind.__name__,
        "description": summary,
        "type": "object",
        "properties": properties,
        "required": list(properties),
    }


@cache
def field_descriptions(kind: type) -> dict[str, str]:
    """Descriptions of the fields from the ``Attributes:`` of a class and of its base classes.

    A line ``a, b: text`` describes both; lines indented further continue the one before.
    """
    descriptions: dict[str, str] = {}
    names: list[str] = []
    docs = "\n".join(inspect.cleandoc(base.__doc__ or "") for base in reversed(kind.__mro__))
    for section in re.findall(r"^Attributes:\n(.*?)(?=^\S|\Z)", docs, re.M | re.S):
        for line in section.splitlines():
            start = re.match(r" {4}(\w+(?:, \w+)*): (.*)", line)
            if start:
                names = start.group(1).split(", ")
                descriptions.update(dict.fromkeys(names, start.group(2)))
            elif line.strip():
                descriptions |= {name: f"{descriptions[name]} {line.strip()}" for name in names}
    return descriptions
