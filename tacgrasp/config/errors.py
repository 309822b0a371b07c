"""Error messages of a configuration, one line each: the field, the expected and the actual value.

Not here: where values come from (``tacgrasp.config.layers``), the fields
(``tacgrasp.config.schema``).
"""

from __future__ import annotations

import re
from difflib import get_close_matches
from typing import Any, get_args

from pydantic import BaseModel, ValidationError
from pydantic_core import ErrorDetails

from tacgrasp.base.plugins import names_with
from tacgrasp.config.schema import RunConfig

UNITS = {
    "mm": "mm",
    "m": "m",
    "g": "g",
    "n": "N",
    "s": "s",
    "m_s": "m/s",
    "m_s2": "m/s²",
    "share": "fraction of 0 to 1",
}
"""Units by the ending of a field's name."""

Location = tuple[int | str, ...]
"""Position of a field as pydantic gives it: names, and indices in lists."""


def flag_of(path: str) -> str:
    """Flag of a dotted path: ``--arm.max-step-mm`` of ``arm.max_step_mm``."""
    return f"--{path.replace('_', '-')}"


def denied_flag_of(path: str) -> str:
    """Flag that switches a dotted path off: ``--verify.no-set-down`` of ``verify.set_down``."""
    section, dot, name = path.rpartition(".")
    return flag_of(f"{section}{dot}no_{name}")


def explain(details: ErrorDetails) -> str:
    """One error of a configuration file or variable: field, expected, got."""
    return _explain(details, path_of(details["loc"]) or "the run")


def explain_flag(error: ValidationError) -> str:
    """The first error of a model that was built from flags: flag, expected, got."""
    sections = [
        name
        for name, field in RunConfig.model_fields.items()
        if error.title in [model.__name__ for model in _models_in(field.annotation)]
    ]
    details = error.errors()[0]
    details["loc"] = (*sections[:1], *details["loc"])
    path = path_of(details["loc"])
    return _explain(details, flag_of(path) if path else "the run")


def _explain(details: ErrorDetails, name: str) -> str:
    loc, got, kind = details["loc"], details["input"], details["type"]
    if kind == "extra_forbidden":
        return f"unknown field {name}; {_known_fields(loc)}"
    if kind == "missing" and isinstance(loc[-1], int):
        return f"{name} has too few values, got {got!r}"
    if kind == "missing":
        return f"{name} is missing"
    if kind in ("union_tag_invalid", "union_tag_not_found"):
        own = [k for model in _located(loc)[1] if isinstance(k := _kind_of(model), str)]
        kinds = ", ".join(names_with(f"{loc[-1]}s", own))
        actual = got.get("kind") if isinstance(got, dict) else got
        return f"{name}.kind must be one of {kinds}, got {actual!r}"
    if kind == "model_type":
        return f"{name} must be a section with fields of its own, got {got!r}"
    if kind == "value_error":
        return f"{name}: {details['msg'].removeprefix('Value error, ')}"
    if kind == "path_type":
        return f"{name} must be the path of a file, got {got!r}"
    message = re.sub(r"^\w+ should | after validation.*", "", details["msg"])
    message = message.replace("a valid tuple", "a list")
    endings = [ending for ending in UNITS if path_of(loc).endswith(f"_{ending}")]
    unit = f" [{UNITS[max(endings, key=len)]}]" if endings else ""
    return f"{name} must {message}{unit}, got {got!r}"


def _known_fields(loc: Location) -> str:
    """Fields beside an unknown one, the closest name first."""
    _, models = _located(loc[:-1])
    names = list(models[0].model_fields)
    matches = get_close_matches(str(loc[-1]), names, n=1, cutoff=0.6)
    hint = f"did you mean {matches[0]}? " if matches else ""
    return f"{hint}known here: {', '.join(names)}"


def path_of(loc: Location) -> str:
    """Dotted path of a field as in a file, without list indices and kinds of drivers."""
    return _located(loc)[0]


def _located(loc: Location) -> tuple[str, list[type[BaseModel]]]:
    """Path of a field, and the models that a section at that path may be of."""
    path: list[str] = []
    models: list[type[BaseModel]] = [RunConfig]
    for part in loc:
        of_kind = [model for model in models if _kind_of(model) == part]
        if of_kind:
            models = of_kind
        elif isinstance(part, str):
            path.append(part)
            fields = [m.model_fields[part] for m in models if part in m.model_fields]
            models = [m for field in fields for m in _models_in(field.annotation)] or models
    return ".".join(path), models


def _models_in(annotation: Any) -> list[type[BaseModel]]:
    """Every model of an annotation, also inside of unions and tuples, in order."""
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return [annotation]
    return [model for part in get_args(annotation) for model in _models_in(part)]


def _kind_of(model: type[BaseModel]) -> object:
    field = model.model_fields.get("kind")
    return None if field is None else field.default
