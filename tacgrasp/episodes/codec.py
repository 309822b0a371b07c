"""Frozen dataclasses to JSON and back, exactly, and the JSON Schema that documents them.

It covers the types of episodes: dataclasses whose fields are numbers, text, enums, arrays of
float64, tuples, mappings and other dataclasses. Floats survive bit for bit (Python writes the
shortest text that reads back as the same double). The descriptions in a schema are the
``Attributes:`` of the docstrings, so that field, unit and frame are written in one place.

Not here: the records of an episode (``tacgrasp.episodes.record``).
"""

from __future__ import annotations

import dataclasses
import inspect
import math
import re
import types
import typing
from collections.abc import Callable, Mapping
from enum import Enum
from functools import cache, partial
from typing import Any, TypeVar, Union, get_args, get_origin

import numpy as np

T = TypeVar("T")

_SCALARS: dict[Any, str] = {float: "number", int: "integer", bool: "boolean", str: "string"}
_UNIONS = (Union, types.UnionType)
_hints = cache(typing.get_type_hints)


def to_json(value: object, path: str = "") -> Any:
    """Turn a value into types of JSON; ``path`` is its name in errors.

    Raises:
        TypeError: A type that episodes don't carry; the message names it.
        ValueError: A number that JSON can't express; the message names its field.
    """
    if isinstance(value, Enum):
        return value.value
    if isinstance(value, (np.ndarray, np.generic)):
        return to_json(value.tolist(), path)
    if isinstance(value, float) and not math.isfinite(value):
        raise ValueError(f"{path} is {value}; expected a finite number")
    if value is None or isinstance(value, (bool, int, float, str)):
        return value
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        value = {f.name: getattr(value, f.name) for f in dataclasses.fields(value)}
    if isinstance(value, Mapping):
        return {str(key): to_json(item, f"{path}.{key}") for key, item in value.items()}
    if isinstance(value, (tuple, list)):
        return [to_json(item, f"{path}[{i}]") for i, item in enumerate(value)]
    raise TypeError(f"an episode can't carry a {type(value).__name__}: {value!r}")


def from_json(kind: type[T], data: object) -> T:
    """Build a dataclass ``kind`` from the output of ``to_json``.

    Raises:
        ValueError: A field is missing, unknown or of another type; the message names it. Checks of
            the dataclass itself raise their own errors.
    """
    hint: Any = kind
    value: T = _codec(hint)[1](data, kind.__name__)
    return value


def json_schema(kind: type) -> dict[str, Any]:
    """JSON Schema (draft 2020-12) of a dataclass, described by its docstring."""
    return {"$schema": "https://json-schema.org/draft/2020-12/schema", **_codec(kind)[0]}


@cache
def _codec(hint: Any) -> tuple[dict[str, Any], Callable[[Any, str], Any]]:
    """JSON Schema of a type, and the reader of its values from data and their path."""
    origin, items = get_origin(hint), get_args(hint)
    if hint in _SCALARS:
        return {"type": _SCALARS[hint]}, partial(_scalar, hint)
    if hint is type(None):
        return {"type": "null"}, lambda data, path: _expect(data is None, data, "null", path)
    if origin in _UNIONS:
        return {"anyOf": [_codec(member)[0] for member in items]}, partial(_union, items)
    if inspect.isclass(hint) and issubclass(hint, Enum):
        return {"enum": [member.value for member in hint]}, partial(_enum, hint)
    if dataclasses.is_dataclass(hint) and inspect.isclass(hint):
        return _object_schema(hint), partial(_dataclass, hint)
    if inspect.isclass(origin) and issubclass(origin, np.ndarray):
        return {"type": "array"}, _array
    if inspect.isclass(origin) and issubclass(origin, Mapping):
        schema, read = _codec(items[1])
        return {"type": "object", "additionalProperties": schema}, partial(_mapping, read)
    if origin is tuple and items[-1] is Ellipsis:
        schema, read = _codec(items[0])
        return {"type": "array", "items": schema}, partial(_sequence, read)
    if origin is tuple:
        schemas = [_codec(item)[0] for item in items]
        schema = {"type": "array", "prefixItems": schemas, "minItems": len(items)}
        return schema, partial(_fixed_tuple, items)
    raise ValueError(f"episodes don't carry the type {hint}")


def _expect(valid: bool, data: object, expected: str, path: str) -> Any:
    if not valid:
        raise ValueError(f"{path}: expected {expected}, got {data!r:.80}")
    return data


def _scalar(hint: type, data: Any, path: str) -> object:
    if type(data) is int and abs(data) >= 1 << 64:
        raise ValueError(f"{path}: expected a number of 64 bits, got one of {data.bit_length()}")
    if hint is float and type(data) is int:
        return float(data)
    valid = type(data) is hint and not (isinstance(data, float) and not math.isfinite(data))
    return _expect(valid, data, _SCALARS[hint], path)


def _union(members: tuple[Any, ...], data: object, path: str) -> object:
    problems = []
    # Exact scalar types first: in ``bool | float | int`` an integer must not become a float.
    for member in sorted(members, key=lambda member: member is not type(data)):
        try:
            return _codec(member)[1](data, path)
        except ValueError as error:
            problems.append(str(error))
    raise ValueError("; or ".join(problems))


def _enum(kind: type[Enum], data: object, path: str) -> Enum:
    values = [member.value for member in kind]
    return kind(_expect(data in values, data, f"one of {', '.join(map(str, values))}", path))


def _array(data: object, path: str) -> object:
    valid = isinstance(data, list) and all(type(value) in (int, float) for value in data)
    values = _expect(valid, data, "a list of numbers", path)
    return np.array([_scalar(float, value, path) for value in values], dtype=np.float64)


def _mapping(read: Callable[[Any, str], Any], data: object, path: str) -> object:
    pairs = _expect(isinstance(data, dict), data, "an object", path).items()
    return {key: read(value, f"{path}.{key}") for key, value in pairs}


def _sequence(read: Callable[[Any, str], Any], data: object, path: str) -> object:
    values = enumerate(_expect(isinstance(data, list), data, "a list", path))
    return tuple(read(value, f"{path}[{i}]") for i, value in values)


def _fixed_tuple(items: tuple[Any, ...], data: Any, path: str) -> object:
    _expect(isinstance(data, list), data, "a list", path)
    _expect(len(data) == len(items), data, f"{len(items)} items", path)
    pairs = zip(items, data, strict=True)
    return tuple(_codec(item)[1](value, f"{path}[{i}]") for i, (item, value) in enumerate(pairs))


def _dataclass(kind: type, data: Any, path: str) -> object:
    _expect(isinstance(data, dict), data, f"an object ({kind.__name__})", path)
    fields = {field.name: field for field in dataclasses.fields(kind)}
    if unknown := sorted(data.keys() - fields.keys()):
        raise ValueError(f"{path}: unknown field {unknown[0]!r}; known: {', '.join(fields)}")
    for name, field in fields.items():
        required = (field.default, field.default_factory) == (dataclasses.MISSING,) * 2
        if required and name not in data:
            raise ValueError(f"{path}: field {name!r} is missing")
    hints = _hints(kind)
    return kind(**{n: _codec(hints[n])[1](item, f"{path}.{n}") for n, item in data.items()})


def _object_schema(kind: type) -> dict[str, Any]:
    descriptions = field_descriptions(kind)
    summary = (inspect.getdoc(kind) or "").split("\n\n")[0].replace("\n", " ")
    properties = {}
    for name, hint in _hints(kind).items():
        described = {"description": descriptions[name]} if name in descriptions else {}
        properties[name] = _codec(hint)[0] | described
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
