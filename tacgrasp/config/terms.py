"""Terms of a task for its contract, out of the configuration, and what in them was set explicitly.

Not here: reading the instruction (``policies.contract``).
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache
from pathlib import Path

from pydantic import ValidationError

from policies.contract import BANDS, read_contract
from primitives.contract import Band, Contract, ForceTerms, TaskTerms, default_limit_n
from tacgrasp.base.errors import UsageError
from tacgrasp.config.layers import layer_source, names, task_fields
from tacgrasp.config.schema import GoalConfig, RunConfig

SOFT_TASK = "strawberry"
"""Task whose terms a soft contact is held to, whatever the contract says."""

FIELDS: Mapping[str, str] = {
    "goal.force_n": "force_n",
    "goal.limit_n": "limit_n",
    "goal.depth_mm": "depth_mm",
    "goal.area_share": "area_fraction",
    "goal.x_mm": "x_mm",
    "goal.y_mm": "y_mm",
    "verify.max_shift_mm": "slip_mm",
}
"""Band of the contract by the path of its field."""


def contract_of(config: RunConfig, sources: Mapping[str, str] | None = None) -> Contract:
    """Contract of a run: its instruction, its task and what the configuration sets explicitly.

    Args:
        config: The run.
        sources: Source of each value; None takes every value as the task's.
    """
    return read_contract(config.instruction, task_terms(config, sources), given(config, sources))


def worded_contract(
    instruction: str, config: RunConfig, sources: Mapping[str, str] | None = None
) -> Contract:
    """Contract of a run with an instruction of the command line in place of its own.

    Args:
        instruction: The instruction.
        config: The run.
        sources: As for ``contract_of``.
    """
    config = config.model_copy(update={"instruction": instruction})
    if sources is not None:
        sources = {**sources, "instruction": "the command line"}
    return contract_of(config, sources)


def task_terms(config: RunConfig, sources: Mapping[str, str] | None = None) -> TaskTerms:
    """Terms of the task's own file, and of the rig's gripper."""
    goal, instruction = config.goal, config.instruction
    slip_mm = config.verify.max_shift_mm
    if sources is not None:
        own = task_fields(config.task)
        goal = GoalConfig.model_validate(own["goal"]) if "goal" in own else goal
        instruction = str(own.get("instruction", instruction))
        slip_mm = float(own.get("verify", {}).get("max_shift_mm", slip_mm))
    else:
        instruction = _own_instruction(config)
    goal_bands = goal.goal()
    return TaskTerms(
        name=Path(config.task).stem,
        object=config.object,
        instruction=instruction,
        force=_force_terms(goal),
        slip_mm=slip_mm,
        x_mm=goal_bands.x_mm,
        y_mm=goal_bands.y_mm,
        depth_mm=goal_bands.depth_mm,
        area_fraction=goal_bands.area_fraction,
        least_n=config.gripper.min_force_n * config.gripper.max_force_gain,
        most_n=config.gripper.max_force_n,
        others=dict(terms for name, terms in _shipped_terms().items() if name != config.task),
        defaults=frozenset(
            name
            for path, name in FIELDS.items()
            if sources is not None and sources.get(path, "default") == "default"
        ),
        soft=_shipped_terms()[SOFT_TASK][1],
    )


def given(config: RunConfig, sources: Mapping[str, str] | None) -> dict[str, object]:
    """Bands that rig file, environment or flags set, by their names in a contract."""
    values: dict[str, object] = {}
    for path, name in FIELDS.items():
        source = (sources or {}).get(path, "default")
        if source in ("default", layer_source("task", config.task)):
            continue
        section, field = path.split(".")
        value = getattr(getattr(config, section), field)
        if value is not None:
            values[name] = Band(low=value[0], high=value[1]) if isinstance(value, tuple) else value
    return values


def contract_lines(contract: Contract) -> list[str]:
    """The contract in words, for people: what was understood, then what was assumed."""
    if contract.refused:
        return [f"refused: {contract.refused}", f"understood: {contract.summary}"]
    band, limit_n = contract.terms.force_n, contract.terms.limit_n
    of_band, of_limit = (contract.origins.get(name, "the task") for name in ("force_n", "limit_n"))
    own = "" if of_band == of_limit else f" ({of_band})"
    line = (
        f"understood: {contract.summary}, {band.low:.2f}-{band.high:.2f} N{own}, never above "
        f"{limit_n:.3g} N ({of_limit}); place x {_span(contract.x_mm)}, y {_span(contract.y_mm)} mm"
    )
    return [line, *(f"  {note}" for note in contract.assumed)]


def _span(band: Band) -> str:
    is_even = band.low == -band.high
    return f"±{band.high:g}" if is_even else f"{band.low:g} to {band.high:g}"


def band_lines(contract: Contract) -> list[str]:
    """Every band of a contract with its origin, a line each."""
    lines = []
    for name in BANDS:
        value = getattr(contract, name)
        if isinstance(value, Band):
            text = f"[{value.low:.4g}, {value.high:.4g}]"
        else:
            text = "none" if value is None else f"{value:.4g}"
        lines.append(f"contract.{name:13}  {text}  [{contract.origins.get(name, 'the task')}]")
    return lines


def contract_json(contract: Contract) -> dict[str, object]:
    """A contract for machines; forces in N, lengths in mm, the area as a fraction."""
    return {
        "summary": contract.summary,
        "force_n": _pair(contract.force_n),
        "limit_n": contract.limit_n,
        "slip_mm": contract.slip_mm,
        "place_mm": {"x": _pair(contract.x_mm), "y": _pair(contract.y_mm)},
        "depth_mm": _pair(contract.depth_mm),
        "area": _pair(contract.area_fraction),
        "origins": dict(contract.origins),
        "assumed": list(contract.assumed),
        "refused": contract.refused or None,
    }


def _pair(band: Band | None) -> list[float] | None:
    return None if band is None else [band.low, band.high]


def _force_terms(goal: GoalConfig) -> ForceTerms:
    band = Band(low=goal.force_n[0], high=goal.force_n[1])
    limit_n = default_limit_n(band) if goal.limit_n is None else goal.limit_n
    band = Band(low=band.low, high=min(band.high, limit_n))  # a limit may end a band by touch
    return ForceTerms(force_n=band, limit_n=limit_n, needs=goal.needs or "")


@lru_cache(maxsize=1)
def _shipped_terms() -> dict[str, tuple[str, ForceTerms]]:
    """Instruction and terms of every task that comes along, by its name; read once a process."""
    fields = {name: task_fields(name) for name in names("task")}
    return {
        name: (each["instruction"], _force_terms(GoalConfig.model_validate(each["goal"])))
        for name, each in fields.items()
    }


def _own_instruction(config: RunConfig) -> str:
    try:
        return str(task_fields(config.task).get("instruction", config.instruction))
    except (UsageError, ValidationError):
        return config.instruction  # a recorded run whose task file is elsewhere
