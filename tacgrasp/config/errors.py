"""What is wrong with a configuration, in one line: the field, what was expected, what came.

Not here: where values come from (``tacgrasp.config.layers``), the fields
(``tacgrasp.config.schema``).
"""

from __future__ import annotations

import re
from difflib import get_close_matches
from typing import Any, get_args

from pydantic import BaseModel
from pydantic_core import ErrorDetails

from tacgrasp.config.schema import RunConfig

UNITS = {
    "mm": "mm",
    "m": "m",
    "g": "g",
    "n": "N",
    "s": "s",
    "m_s": "m/s",
    "m_s2": "m/s²",
    "share": "share of 0 to 1",
}
"""What the end of a field's name says about its unit."""


def unit_of(field: str) -> str:
    """Unit that the end of a field's name stands for, '' when it names none."""
    endings = [e for e in UNITS if field.endswith(f"_{e}")]
    return UNITS[max(endings, key=len)] if endings else ""


def explain(first: ErrorDetails) -> str:
    """One thing that is wrong with a configuration, in a line: field, expected, got."""
    path = path_of(first["loc"]) or "the run"
    got = first["input"]
    kind = first["type"]
    if kind == "extra_forbidden":
        return f"unknown field {path}; {_known_beside(first['loc'])}"
    if kind == "missing" and isinstance(first["loc"][-1], int):
        return f"{path} has too few values, got {got!r}"
    if kind == "missing":
        return f"{path} is missing"
    if kind in ("union_tag_invalid", "union_tag_not_found"):
        kinds = ", ".join(str(_kind_of(model)) for model in _located(first["loc"])[1])
        given = got.get("kind") if isinstance(got, dict) else got
        return f"{path}.kind must be one of {kinds}, got {given!r}"
    if kind == "model_type":
        return f"{path} must be a section with fields of its own, got {got!r}"
    if kind == "value_error":
        return f"{path}: {first['msg'].removeprefix('Value error, ')}"
    if kind == "path_type":
        return f"{path} must be the path of a file, got {got!r}"
    message = re.sub(r"^\w+ should | after validation.*", "", first["msg"])
    message = message.replace("a valid tuple", "a list")
    unit = unit_of(path.rsplit(".", 1)[-1])
    return f"{path} must {message}{f' [{unit}]' if unit else ''}, got {got!r}"


def _known_beside(loc: tuple[int | str, ...]) -> str:
    """What fields there are beside an unknown one, the closest names first."""
    _, models = _located(loc[:-1])
    known = list(models[0].model_fields)
    close = get_close_matches(str(loc[-1]), known, n=1, cutoff=0.6)
    hint = f"did you mean {close[0]}? " if close else ""
    return f"{hint}known here: {', '.join(known)}"


def path_of(loc: tuple[int | str, ...]) -> str:
    """Dotted path of a field as a person wrote it.

    Pydantic's also names places in lists, and of a driver's settings their kind.
    """
    return _located(loc)[0]


def _located(loc: tuple[int | str, ...]) -> tuple[str, list[type[BaseModel]]]:
    """Path of a field, and the models that the section there may be of."""
    path: list[str] = []
    here: list[type[BaseModel]] = [RunConfig]
    for part in loc:
        of_kind = [model for model in here if _kind_of(model) == part]
        if of_kind:
            here = of_kind
        elif isinstance(part, str):
            path.append(part)
            fields = [m.model_fields[part] for m in here if part in m.model_fields]
            inner = [model for field in fields for model in _models_in(field.annotation)]
            here = inner or here
    return ".".join(path), here


def _models_in(annotation: Any) -> list[type[BaseModel]]:
    """Every model that an annotation names, also inside of unions and tuples, in order."""
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return [annotation]
    return [model for part in get_args(annotation) for model in _models_in(part)]


def _kind_of(model: type[BaseModel]) -> object:
    field = model.model_fields.get("kind")
    return None if field is None else field.default
