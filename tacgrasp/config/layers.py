"""Fill the configuration: defaults < task file < rig file < environment (< flags, ``cli.run``).

A limit of the rig's file may be narrowed by all others, the task's file too, and widened by none.

Not here: the fields and their ranges (``tacgrasp.config.schema``).
"""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from importlib import resources
from pathlib import Path
from typing import Any, get_args

from pydantic import BaseModel, ValidationError

from tacgrasp.base.errors import UsageError
from tacgrasp.base.plugins import load_plugin, names_with, plugins
from tacgrasp.base.settings import SettingsBase
from tacgrasp.base.strict_yaml import YamlError, YamlSyntaxError, read_yaml, read_yaml_file
from tacgrasp.config.errors import explain, path_of
from tacgrasp.config.hard_limits import LIMITS, HardLimits
from tacgrasp.config.hardware import resolve_paths
from tacgrasp.config.schema import ArmConfig, GripperConfig, LlmConfig, RunConfig

ENV_PREFIX = "TACGRASP_"
"""``TACGRASP_ARM__MAX_STEP_MM=4`` sets ``arm.max_step_mm``."""

RIG_FIELDS = ("devices", "hardware", "arm", "gripper", "pad")
"""Sections of a rig's file; other fields without a default belong to the task's file."""

Sources = dict[str, str]
"""Source of each value: dotted path of a field -> 'default', a file, a variable, a flag."""


def load(
    task: str | None = None, rig: str | None = None, environment: Mapping[str, str] | None = None
) -> tuple[RunConfig, Sources]:
    """Configuration and sources of ``load_with_limits``, for callers without flags."""
    return load_with_limits(task, rig, environment)[:2]


def load_with_limits(
    task: str | None = None, rig: str | None = None, environment: Mapping[str, str] | None = None
) -> tuple[RunConfig, Sources, HardLimits]:
    """Fill the model from the task's file, the rig's file and the environment, in this order.

    Args:
        task: Name or path; None takes ``TACGRASP_TASK``, and without it the strawberry.
        rig: Name or path; None takes ``TACGRASP_RIG``, and without it the simulated one.
        environment: Variables; only those with our prefix are read.

    Returns:
        The configuration, the source of each value, and the limits that nothing may widen.

    Raises:
        UsageError: No such task or rig, not YAML, an unknown field, a value that doesn't fit, or
            the environment would widen a limit of the rig's file.
    """
    variables = {k: v for k, v in (environment or {}).items() if k.startswith(ENV_PREFIX)}
    sources: Sources = {}
    merged: dict[str, Any] = {}
    for kind, flag, default in (("task", task, "strawberry"), ("rig", rig, "sim")):
        variable = f"{ENV_PREFIX}{kind.upper()}"
        from_env = variables.pop(variable, None)
        if "" in (flag, from_env):
            where = f"--{kind}" if flag == "" else f"environment variable {variable}"
            raise UsageError(f"{where} is empty; name a {kind}, or leave it out for {default}")
        merged[kind] = flag or from_env or default
        if from_env and not flag:
            sources[kind] = f"environment variable {variable}"
    task_source, of_task, _ = _read_layer("task", merged["task"])
    if "hardware" in of_task:
        raise UsageError(f"{task_source}: hardware belongs into a rig's file")
    may_narrow = _limits_in(of_task)
    _merge(merged, of_task, task_source, sources)
    source, of_rig, folder = _read_layer("rig", merged["rig"])
    _merge(merged, of_rig, source, sources)
    hard = _hard_limits(merged)
    if may_narrow:
        _merge(merged, may_narrow, task_source, sources)
    for variable, value in sorted(variables.items()):
        layer: Any = value  # a sentence that is no YAML is a text
        try:
            with suppress(YamlSyntaxError):
                layer = read_yaml(value)
        except YamlError as error:
            raise UsageError(f"environment variable {variable}: {error}") from None
        keys = variable.removeprefix(ENV_PREFIX).lower().split("__")
        if keys[0] == "hardware":
            raise UsageError(
                f"environment variable {variable}: hardware is set in the rig's file alone"
            )
        for key in reversed(keys):
            layer = {key: layer}
        _merge(merged, layer, f"environment variable {variable}", sources)
    config = _complete(merged)
    if config.hardware is not None:
        config = config.model_copy(update={"hardware": resolve_paths(config.hardware, folder)})
    hard.check(config, lambda path: sources.get(path, "the default"))
    return config, {path: sources.get(path, "default") for path in leaves(config)}, hard


def with_values(
    config: RunConfig, sources: Sources, hard: HardLimits, values: Mapping[str, Any], source: str
) -> RunConfig:
    """The configuration with values of a caller laid over it, as flags would be.

    Args:
        config: Configuration from ``load_with_limits``.
        sources: Its sources; those of the values are noted in it.
        hard: Limits that the values may not widen.
        values: Fields by name; those of a section as a mapping of their own.
        source: Name of the caller, for sources and messages.

    Raises:
        UsageError: An unknown field, a value that doesn't fit, or a wider limit.
    """
    fixed = next((name for name in ("task", "rig", "devices", "hardware") if name in values), None)
    if fixed is not None:
        raise UsageError(f"{source}: {fixed} is chosen by the names of task and rig alone")
    merged = config.model_dump()
    _merge(merged, dict(values), source, sources)
    changed = _complete(merged)
    hard.check(changed, lambda path: sources.get(path, "the default"))
    return changed


def leaves(config: SettingsBase, prefix: str = "") -> dict[str, Any]:
    """Values of a configuration by dotted path, in the order of the models."""
    flat: dict[str, Any] = {}
    for name in type(config).model_fields:
        value = getattr(config, name)
        if isinstance(value, SettingsBase):
            flat |= leaves(value, f"{prefix}{name}.")
        else:
            flat[prefix + name] = value
    return flat


def task_fields(task: str) -> dict[str, Any]:
    """Fields of a task's file alone, as they are written.

    Raises:
        UsageError: There is no such task, or its file is not YAML.
    """
    return _read_layer("task", task)[1]


def names(kind: str) -> list[str]:
    """Names of the shipped tasks or rigs (``kind`` is 'task' or 'rig')."""
    folder = resources.files("tacgrasp") / f"{kind}s"
    files = [f.name for f in folder.iterdir() if f.name.endswith(".yaml")]
    return sorted(name.removesuffix(".yaml") for name in files)


def layer_source(kind: str, name: str) -> str:
    """Name of a layer's file in messages and sources."""
    if name.endswith((".yaml", ".yml")):
        return name
    if name not in names(kind) and kind == "task" and name in plugins("tasks"):
        return f"task {name} of {plugins('tasks')[name].package}"
    return f"{kind}s/{name}.yaml"


def task_refusal(added: object) -> str:
    """Why a plugin's object is no task; empty for the path of a file."""
    if isinstance(added, (str, Path)) and Path(added).is_file():
        return ""
    return f"expected the path of a task's YAML file, got {added!r:.200}"


def _read_layer(kind: str, name: str) -> tuple[str, dict[str, Any], Path]:
    """Name of a layer's file for messages, its fields, and the folder of its relative paths."""
    source = layer_source(kind, name)
    if name.endswith((".yaml", ".yml")):
        path = Path(name)
        if not path.is_file():
            problem = "is a folder" if path.is_dir() else "does not exist"
            raise UsageError(f"{kind} file {name} {problem}")
    elif name in names(kind):
        path = Path(str(resources.files("tacgrasp"))) / f"{kind}s" / f"{name}.yaml"
    elif kind == "task" and name in plugins("tasks"):
        path = Path(str(load_plugin("tasks", name, task_refusal)))
    else:
        known = names_with("tasks", names(kind)) if kind == "task" else names(kind)
        raise UsageError(
            f"unknown {kind} {name!r}; known: {', '.join(known)}, or the path of a .yaml file"
        )
    try:
        fields = read_yaml_file(path)
    except (OSError, UnicodeDecodeError) as error:
        raise UsageError(f"{kind} file {name} can't be read as text: {error}") from None
    except YamlSyntaxError as error:
        raise UsageError(f"{source} is not YAML: {error}") from None
    except YamlError as error:
        raise UsageError(f"{source}: {error}") from None
    if not isinstance(fields, dict):
        raise UsageError(
            f"{source} must hold fields such as "
            f"{'instruction: ...' if kind == 'task' else 'devices: ...'!r}, got {fields!r:.60}"
        )
    for field in ("task", "rig"):
        if field in fields:
            raise UsageError(f"{source}: {field} can't be set in a file; give --{field} instead")
    folder = path.resolve().parent
    return source, _rooted(RunConfig, fields, folder), folder


def _rooted(model: type[BaseModel], layer: dict[str, Any], folder: Path) -> dict[str, Any]:
    """A file's fields with their relative paths resolved against the file's folder.

    Those of the section ``hardware`` are resolved once its drivers are known.
    """
    rooted = dict(layer)
    for name, value in layer.items():
        field = model.model_fields.get(name)
        kinds = () if field is None else (field.annotation, *get_args(field.annotation))
        if isinstance(value, str) and Path in kinds:
            rooted[name] = str(folder / value)
        elif isinstance(value, dict) and LlmConfig in kinds:
            rooted[name] = _rooted(LlmConfig, value, folder)
    return rooted


def _merge(merged: dict[str, Any], layer: dict[str, Any], source: str, sources: Sources) -> None:
    """Lay ``layer`` over ``merged`` (changed in place), check it, and note its ``source``.

    Missing fields may still come from a later layer; any other error is this layer's.
    """
    _overlay(merged, layer)
    try:
        RunConfig.model_validate(merged)
    except ValidationError as error:
        # pydantic also calls a list with wrong items too short: the item's error explains more
        for details in sorted(error.errors(), key=lambda one: one["type"] == "too_short"):
            is_in_list = any(isinstance(part, int) for part in details["loc"])
            if details["type"] != "missing" or is_in_list:
                raise UsageError(f"{source}: {explain(details)}") from None
    sources |= dict.fromkeys(_paths(layer), source)


def _complete(merged: dict[str, Any]) -> RunConfig:
    try:
        return RunConfig.model_validate(merged)
    except ValidationError as error:
        first = error.errors()[0]
    if first["type"] != "missing":
        raise UsageError(explain(first))
    field = path_of(first["loc"])
    kind = "rig" if field.split(".")[0] in RIG_FIELDS else "task"
    raise UsageError(f"the {kind}'s file ({merged[kind]}) must set {field}; it has no default")


def _hard_limits(merged: dict[str, Any]) -> HardLimits:
    """Limits after both files.

    Raises:
        UsageError: The rig's file leaves a limit open that has no default.
    """
    try:
        return HardLimits(
            ArmConfig.model_validate(merged.get("arm", {})),
            GripperConfig.model_validate(merged.get("gripper", {})),
        )
    except ValidationError:
        _complete(merged)
        raise


def _limits_in(fields: Mapping[str, Any]) -> dict[str, Any]:
    """The fields of a file that are limits."""
    found: dict[str, Any] = {}
    for section, field in (path.split(".") for path in LIMITS):
        held = fields.get(section)
        if isinstance(held, dict) and held.get(field) is not None:
            found.setdefault(section, {})[field] = held[field]
    return found


def _overlay(below: dict[str, Any], above: dict[str, Any]) -> None:
    for key, value in above.items():
        if isinstance(value, dict) and isinstance(below.get(key), dict):
            _overlay(below[key], value)
        else:
            below[key] = value


def _paths(layer: Mapping[str, Any], prefix: str = "") -> list[str]:
    paths: list[str] = []
    for key, value in layer.items():
        nested = isinstance(value, dict)
        paths += _paths(value, f"{prefix}{key}.") if nested else [f"{prefix}{key}"]
    return paths
