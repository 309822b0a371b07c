"""From words, configuration and task to the contract of an episode, once, before anything moves.

Explicit configuration wins over words, words over the task; what they say against each other is
refused by name. The words are read by ``policies.instructions``. Not here: what the executor makes
of a contract (``primitives.force_guard``).
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any

from cltp.tactile.states import ContactState
from policies.goal import Goal
from policies.instructions.quantities import Force, Quantities
from policies.instructions.reader import Request, read_request
from primitives import Primitive
from primitives.contract import (
    LIMIT_OVER_BAND,
    Band,
    Contract,
    ForceTerms,
    TaskTerms,
    default_limit_n,
)
from primitives.errors import LimitError
from primitives.sense import Interval

AROUND = 0.14
"""Half width of the band around a named force, as a fraction. Our choice: below the 15 % that
people mean by a number; the felt force varies by some percent from frame to frame."""

BELOW_MOST = 0.9
"""Top of the band under a named most, as a fraction of it: room for the error of a felt force."""

ROUNDING = 0.99
"""Hard limit over a named most: '200 g' is 1.96 N to one reader and 1.961 N to another."""

ABOVE_LEAST = 1.03
"""Low end of the band over a named least, as a factor."""

SPAN = 2.0
"""High over low end of a band of which one end is named. Source: the bands of the tasks."""

MANNERS: Mapping[tuple[int, bool], float] = {
    (-1, True): 0.65,
    (-1, False): 0.82,
    (1, False): 1.18,
    (1, True): 1.32,
}
"""Middle of the band over the middle of the task's, by direction and emphasis. Our choice: people
ask for a change that they would notice, and a strawberry stands no more than a third."""

HALF_WIDTH = 0.17
"""Least half width of a band for a manner or a factor, as a fraction of its middle."""

MOST_OF_TASK = 3.0
"""Largest limit that words alone may name, as a factor on the task's limit."""

DEFAULT_DEPTH_MM = Band(low=0.0, high=5.0)
DEFAULT_AREA = Band(low=0.0, high=1.0)
"""Bands of depth and area where nobody sets them: a force that is asked for decides them."""

PLACE_MARGIN_MM, DEPTH_FACTOR, AREA_FACTOR = 1.0, 1.3, 1.5
"""How far a measured state may lie outside its band before a declared success counts as beyond the
contract: the spread of the direct measurement on noisy contacts."""

CLEARLY = 1.65
"""Factor by which a felt force must lie outside the band before a decision goes against it. Source:
the largest error of a felt force in 160 simulated contacts on the pad, 1.7."""

BANDS = ("force_n", "limit_n", "slip_mm", "x_mm", "y_mm", "depth_mm", "area_fraction")


@dataclass(slots=True)
class _Draft:
    """A contract while it is being made."""

    force_n: Band
    limit_n: float
    others: dict[str, Any]
    origins: dict[str, str]
    assumed: list[str] = field(default_factory=list)


class _RefusedError(Exception):
    """Ends the reading with a reason."""


def read_contract(text: str, task: TaskTerms, given: Mapping[str, object]) -> Contract:
    """Make the contract of an episode.

    Args:
        text: The instruction, as a person wrote it.
        task: Terms of the task and the gripper.
        given: Values of explicit configuration by their name in ``BANDS``: ``Band`` or a number.

    Returns:
        The contract; a refused one has a reason and no force band.
    """
    request = read_request(text)
    summary = f"{request.verb} the {request.thing or task.object.replace('_', ' ')}"
    draft = _Draft(
        force_n=task.force.force_n,
        limit_n=task.force.limit_n,
        others={name: getattr(task, name) for name in BANDS[2:]},
        origins=dict.fromkeys(BANDS, "the task"),
    )
    is_tasks_own = text.strip() == task.instruction.strip()
    try:
        if request.refused:
            raise _RefusedError(request.refused)
        named = _from_words(draft, request, task, is_tasks_own=is_tasks_own)
        _from_configuration(draft, given, named)
        _check_reach(draft, given, task)
    except _RefusedError as refusal:
        return _contract(text, summary, draft, task, given, refused=str(refusal))
    return _contract(text, summary, draft, task, given)


def _contract(
    text: str,
    summary: str,
    draft: _Draft,
    task: TaskTerms,
    given: Mapping[str, object],
    refused: str = "",
) -> Contract:
    insists = "force_n" in given or "limit_n" in given
    return Contract(
        text=text,
        summary=summary,
        force_n=None if refused else draft.force_n,
        limit_n=None if refused else draft.limit_n,
        origins=draft.origins,
        assumed=tuple(draft.assumed),
        insists=insists,
        soft=None if insists else _soft_terms(draft, task),
        refused=refused,
        **draft.others,
    )


def _soft_terms(draft: _Draft, task: TaskTerms) -> ForceTerms | None:
    """Terms that a soft contact would be held to: under a contract for hard things alone."""
    soft = task.soft
    if soft is None or draft.limit_n <= LIMIT_OVER_BAND * soft.limit_n:
        return None
    return soft


def _from_words(draft: _Draft, request: Request, task: TaskTerms, *, is_tasks_own: bool) -> str:
    """Let the words change the draft; the words that name a force, '' where none do."""
    numbers = request.numbers
    if numbers.pressure:
        raise _RefusedError(
            f"{numbers.pressure!r} is a pressure, and the area of the contact is not known before "
            "it is touched; name the force, for example '1.5 N'"
        )
    if numbers.unitless:
        raise _RefusedError(
            f"{numbers.unitless} has no unit; say for example '{numbers.unitless} N'"
        )
    _lengths(draft, numbers)
    if numbers.forces:
        return _named_forces(draft, numbers.forces, request, task)
    if numbers.delta_n is not None:
        middle = task.force.force_n.middle
        _scale(draft, task, 1 + numbers.delta_n / middle, f"your words: {numbers.delta_n:+.3g} N")
        return f"{numbers.delta_n:+.3g} N"
    if numbers.factor is not None:
        _scale(draft, task, numbers.factor, f"your words: {numbers.factor_words.strip()}")
        return numbers.factor_words.strip()
    manner = request.manner
    if manner.conflict:
        raise _RefusedError(f"it asks for both: {manner.conflict}; say which")
    if manner.sign and is_tasks_own:
        draft.assumed.append(f"{manner.words!r} is what the task's own band means")
    elif manner.sign:
        factor = MANNERS[manner.sign, manner.strong]
        _scale(
            draft,
            task,
            factor,
            f"{_manner_name(manner.sign, manner.strong)}: your words: {manner.words}",
        )
    elif manner.words:
        draft.assumed.append(f"{manner.words!r} cancel each other: the task's band")
    return ""


def _manner_name(sign: int, strong: bool) -> str:
    return ("very " if strong else "") + ("gentle" if sign < 0 else "firm")


def _lengths(draft: _Draft, numbers: Quantities) -> None:
    if numbers.slip_mm is not None:
        draft.others["slip_mm"] = numbers.slip_mm
        draft.origins["slip_mm"] = "your words"
    if numbers.depth_mm is not None:
        depth = numbers.depth_mm
        draft.others["depth_mm"] = Band(low=depth * (1 - AROUND), high=depth * (1 + AROUND))
        draft.origins["depth_mm"] = "your words"
    if numbers.area_fraction is not None:
        area = min(1.0, numbers.area_fraction)
        draft.others["area_fraction"] = Band(
            low=area * (1 - AROUND), high=min(1.0, area * (1 + AROUND))
        )
        draft.origins["area_fraction"] = "your words"


def _scale(draft: _Draft, task: TaskTerms, factor: float, origin: str) -> None:
    """Move the band so that its middle is ``factor`` times the task's."""
    band = task.force.force_n
    middle = factor * band.middle
    if middle <= 0:
        raise _RefusedError(f"{origin.removeprefix('your words: ')} leaves no force to hold with")
    half = max(HALF_WIDTH * middle, min(abs(middle - band.low), abs(band.high - middle)))
    half = min(half, 0.34 * middle)
    draft.force_n = Band(low=middle - half, high=middle + half)
    # a firmer grip than the task's goes to the task's own limit first
    draft.limit_n = max(min(default_limit_n(draft.force_n), task.force.limit_n), draft.force_n.high)
    if draft.force_n.high > 0.95 * task.force.limit_n:
        draft.limit_n = default_limit_n(draft.force_n)
    draft.origins["force_n"] = origin
    draft.origins["limit_n"] = "the band's top and a margin"
    _free_others(draft)


def _free_others(draft: _Draft) -> None:
    """Depth and area follow from a force that is asked for; the task's bands no longer fit."""
    for name, band in (("depth_mm", DEFAULT_DEPTH_MM), ("area_fraction", DEFAULT_AREA)):
        if draft.origins[name] == "the task":
            draft.others[name], draft.origins[name] = band, "default"


def _named_forces(
    draft: _Draft, forces: tuple[Force, ...], request: Request, task: TaskTerms
) -> str:
    """Band and limit of forces in newtons; the words that name them."""
    words = ", ".join(dict.fromkeys(force.words for force in forces))
    values = [f.value_n for f in forces if f.kind == "value"]
    mosts = [f.value_n for f in forces if f.kind == "most"]
    leasts = [f.value_n for f in forces if f.kind == "least"]
    most, least = min(mosts, default=None), max(leasts, default=None)
    if not all(0 < f.value_n < math.inf for f in forces):
        raise _RefusedError(f"{words}: a grip needs a finite force above 0 N")
    if values and max(values) > (1 + AROUND) ** 2 * min(values):
        raise _RefusedError(f"it names forces that exclude each other: {words}")
    low_needed = max([*leasts, *values], default=0.0)
    if most is not None and low_needed > most:
        raise _RefusedError(f"it names forces that exclude each other: {words}")
    if values and least is not None and least > max(values) * (1 + AROUND):
        raise _RefusedError(f"it names forces that exclude each other: {words}")
    task_band = task.force.force_n
    if values:
        value = sum(values) / len(values)
        band = Band(low=value * (1 - AROUND), high=value * (1 + AROUND))
        if least is not None:
            band = Band(low=max(band.low, least), high=max(band.high, least))
    elif most is not None and least is not None:
        top = BELOW_MOST * most if BELOW_MOST * most > 1.1 * least else most
        band = Band(low=least, high=top)
    elif most is not None:
        top = min(task_band.high, BELOW_MOST * most)
        band = Band(
            low=min(task_band.low, top / SPAN) if top < 1.3 * task_band.low else task_band.low,
            high=top,
        )
        band = _leaning(band, request)
    else:
        assert_low = ABOVE_LEAST * (least or 0.0)
        high = task_band.high if task_band.high > 1.4 * assert_low else assert_low * SPAN**0.5
        band = Band(low=assert_low, high=high)
    limit = default_limit_n(band)
    if values or most is None:
        limit = min(limit, task.force.limit_n) if band.high <= 0.8 * task.force.limit_n else limit
    if most is not None:
        limit = ROUNDING * most
        band = Band(low=min(band.low, limit), high=min(band.high, limit))
    draft.force_n, draft.limit_n = band, limit
    draft.origins["force_n"] = draft.origins["limit_n"] = f"your words: {words}"
    if request.manner.words and not values:
        pass
    _free_others(draft)
    return words


def _leaning(band: Band, request: Request) -> Band:
    """The part of a band that a manner beside a named most asks for."""
    if request.manner.sign == 0 or request.manner.conflict:
        return band
    middle = band.middle
    if request.manner.sign < 0:
        return Band(low=band.low, high=max(middle, band.low * 1.3))
    return Band(low=min(middle, band.high / 1.3), high=band.high)


def _from_configuration(draft: _Draft, given: Mapping[str, object], named: str) -> None:
    """Let explicit configuration win; a force that words name against it is a conflict."""
    unknown = sorted(set(given) - set(BANDS))
    if unknown:
        raise LimitError(f"no band of a contract is called {unknown[0]}; known: {', '.join(BANDS)}")
    band = given.get("force_n")
    limit = given.get("limit_n")
    if isinstance(band, Band):
        if named and (band.low > draft.limit_n or band.high < draft.force_n.low):
            raise _RefusedError(
                f"the configuration sets force_n {band.low:g}-{band.high:g} N, the instruction says "
                f"{named!r}; change one of them"
            )
        if draft.origins["force_n"] != "the task":
            draft.assumed.append(
                f"{draft.origins['force_n'].removeprefix('your words: ')!r} gives way to the configuration"
            )
            kept = (
                draft.limit_n
                if named and draft.origins["limit_n"].startswith("your words")
                else None
            )
        else:
            kept = None
        draft.force_n, draft.origins["force_n"] = band, "the configuration"
        if kept is not None and band.high <= kept:
            draft.limit_n = kept
        else:
            draft.limit_n, draft.origins["limit_n"] = (
                default_limit_n(band),
                "the band's top and a margin",
            )
        _free_others(draft)
    if isinstance(limit, (int, float)):
        if limit < draft.force_n.low:
            raise _RefusedError(
                f"the configuration sets limit_n {limit:g} N, but the force band begins at "
                f"{draft.force_n.low:g} N ({draft.origins['force_n']}); change one of them"
            )
        draft.limit_n, draft.origins["limit_n"] = float(limit), "the configuration"
        if draft.force_n.high > limit:
            draft.force_n = Band(low=draft.force_n.low, high=float(limit))
            draft.assumed.append(f"the band ends at limit_n {limit:g} N")
    for name in BANDS[2:]:
        if name in given:
            draft.others[name], draft.origins[name] = given[name], "the configuration"


def _check_reach(draft: _Draft, given: Mapping[str, object], task: TaskTerms) -> None:
    """Refuse what the gripper can't keep, or what words alone may not ask for."""
    band, limit = draft.force_n, draft.limit_n
    most_by_words = MOST_OF_TASK * task.force.limit_n
    if band.low > task.most_n:
        raise _RefusedError(
            f"{band.low:.3g} N is beyond the gripper's {task.most_n:g} N (gripper.max_force_n)"
        )
    if limit < task.least_n:
        raise _RefusedError(
            f"a limit of {limit:.3g} N is below {task.least_n:.3g} N, the least that this gripper "
            "can keep to for certain (gripper.min_force_n times gripper.max_force_gain)"
        )
    insists = "force_n" in given or "limit_n" in given
    top = (
        band.low / (1 - AROUND) if draft.origins["force_n"].startswith("your words") else band.high
    )
    if not insists and max(top, band.middle) > most_by_words * 1.0001:
        raise _RefusedError(
            f"{top:.3g} N is more than {MOST_OF_TASK:g} times the task's limit "
            f"({task.force.limit_n:.3g} N); if it is meant, set --goal.force-n"
        )


def target_of(contract: Contract) -> Goal:
    """Target bands of a step: those of the contract.

    Raises:
        LimitError: The contract is refused.
    """
    return Goal(
        force_n=contract.terms.force_n,
        depth_mm=contract.depth_mm,
        area_fraction=contract.area_fraction,
        x_mm=contract.x_mm,
        y_mm=contract.y_mm,
    )


def softened(contract: Contract) -> Contract:
    """The contract held to the terms of soft objects, after what is felt has objected."""
    soft = contract.soft
    if soft is None:
        return contract
    words = f"what is felt is soft: held to {soft.force_n.low:.2f}-{soft.force_n.high:.2f} N"
    return replace(
        contract,
        force_n=soft.force_n,
        limit_n=soft.limit_n,
        depth_mm=DEFAULT_DEPTH_MM,
        area_fraction=DEFAULT_AREA,
        origins={**contract.origins, "force_n": "what is felt", "limit_n": "what is felt"},
        assumed=(*contract.assumed, words),
        soft=None,
    )


def beyond(
    contract: Contract,
    action: Primitive | None,
    *,
    success: bool,
    felt: Interval | None,
    state: ContactState | None,
) -> str:
    """Why a decision goes beyond the contract; '' where it keeps it.

    A decision is beyond when it goes against what is clearly felt: success outside the bands, more
    force above the band, less below it.
    """
    band = contract.terms.force_n
    if felt is not None:
        felt = Interval(value=felt.value, low=felt.value / CLEARLY, high=felt.value * CLEARLY)
        if action is Primitive.INCREASE_FORCE and felt.low > band.high:
            return f"more force, but {felt.value:.2f} N is felt and the contract ends at {band.high:.2f} N"
        if action is Primitive.DECREASE_FORCE and felt.high < band.low:
            return f"less force, but {felt.value:.2f} N is felt and the contract begins at {band.low:.2f} N"
    if action is not None or not success:
        return ""
    if felt is not None and (felt.low > band.high or felt.high < band.low):
        return f"success, but {felt.value:.2f} N is felt, not {band.low:.2f}-{band.high:.2f} N"
    return "" if state is None else _outside(contract, state)


def _outside(contract: Contract, state: ContactState) -> str:
    """The first band, with its margin, that a measured state lies outside of."""
    margin = PLACE_MARGIN_MM
    depth, area = contract.depth_mm, contract.area_fraction
    checks = (
        ("x", "mm", state.x_mm, contract.x_mm.low - margin, contract.x_mm.high + margin),
        ("y", "mm", state.y_mm, contract.y_mm.low - margin, contract.y_mm.high + margin),
        ("depth", "mm", state.depth_mm, depth.low / DEPTH_FACTOR, depth.high * DEPTH_FACTOR),
        ("area", "of the pad", state.area_fraction, area.low / AREA_FACTOR, area.high * AREA_FACTOR),
    )  # fmt: skip
    for name, unit, value, low, high in checks:
        if not low <= value <= high:
            return f"success, but the {name} is {value:.2f} {unit}, outside the contract"
    return ""
