"""From words, configuration and task to the contract of an episode, once, before anything moves.

Explicit configuration wins over words, words over the task; what they say against each other is
refused by name. The words are read by ``policies.instructions``. Not here: a step under the
contract (``policies.contract_steps``), keeping its limit (``primitives.force_guard``).
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from cltp.texts.captions import with_article
from policies.force_terms import (
    AROUND,
    LEANS,
    MANNER_NAMES,
    MANNERS,
    ROUNDING,
    RefusedError,
    most_by_words_n,
    most_of,
    named_terms,
    scaled_terms,
    stated_most,
    toleranced_band,
    words_of,
)
from policies.instructions.other_forces import is_another, kind_of
from policies.instructions.quantities import Force, Quantities
from policies.instructions.reader import Request, read_request
from primitives.contract import (
    DEFAULT_AREA,
    DEFAULT_DEPTH_MM,
    LIMIT_OVER_BAND,
    NEUTRAL_LEAN,
    Band,
    Contract,
    ForceTerms,
    TaskTerms,
    default_limit_n,
)
from primitives.errors import LimitError

_OR = re.compile(r"\b(?:or|otherwise|if)\b")
"""Alternatives are refused by what they come to, and near ones are not."""

ONE_FORCE = 1.06
"""Largest over smallest of two named forces that are one: '1 N, which is 100 g'."""

BANDS = ("force_n", "limit_n", "slip_mm", "x_mm", "y_mm", "depth_mm", "area_fraction")

TASK, DEFAULT, CONFIGURATION = "the task", "default", "the configuration"
"""Origins of a band, beside the words."""


@dataclass(slots=True)
class _Draft:
    """A contract while it is being made.

    Attributes:
        force: Band and limit.
        bands: The other bands, by name.
        origins: Origin of each.
        assumed: Notes.
        words: The words that name a force; '' where none do.
        named_most_n: Limit that the words name [N]; None where they name none.
        lean, scale: As in ``Contract``.
    """

    force: ForceTerms
    bands: dict[str, Any]
    origins: dict[str, str]
    assumed: list[str] = field(default_factory=list)
    words: str = ""
    named_most_n: float | None = None
    lean: float = NEUTRAL_LEAN
    scale: float = 1.0

    def set_force(self, force: ForceTerms, origin: str) -> None:
        """Take band and limit; depth and area of the task no longer fit, they follow from it."""
        self.force = force
        self.origins["force_n"] = self.origins["limit_n"] = origin
        for name, band in (("depth_mm", DEFAULT_DEPTH_MM), ("area_fraction", DEFAULT_AREA)):
            if self.origins[name] in (TASK, DEFAULT):
                self.bands[name], self.origins[name] = band, DEFAULT


def read_contract(text: str, task: TaskTerms, given: Mapping[str, object]) -> Contract:
    """Make the contract of an episode.

    Args:
        text: The instruction, as a person wrote it.
        task: Terms of the task and the gripper.
        given: Values of explicit configuration by their name in ``BANDS``: ``Band`` or a number.

    Returns:
        The contract; a refused one has a reason and no force band.

    Raises:
        LimitError: ``given`` names no band.
    """
    if unknown := sorted(set(given) - set(BANDS)):
        raise LimitError(f"no band of a contract is called {unknown[0]}; known: {', '.join(BANDS)}")
    request = read_request(text)
    draft = _Draft(
        force=task.force,
        bands={name: getattr(task, name) for name in BANDS[2:]},
        origins={name: DEFAULT if name in task.defaults else TASK for name in BANDS},
    )
    refused = ""
    try:
        if request.refused:
            raise RefusedError(request.refused)
        _take_words(draft, request, task, is_own=_key(text) == _key(task.instruction))
        _take_configuration(draft, given)
        _check_reach(draft, given, task)
    except RefusedError as error:
        refused = str(error)
    insists = "force_n" in given or "limit_n" in given
    return Contract(
        text=text,
        summary=f"{request.verb} the {request.thing or task.object.replace('_', ' ')}",
        force_n=None if refused else draft.force.force_n,
        limit_n=None if refused else draft.force.limit_n,
        origins=draft.origins,
        assumed=tuple(draft.assumed),
        insists=insists,
        soft=None if insists else _soft_terms(draft, task),
        needs=draft.force.needs,
        lean=draft.lean,
        scale=draft.scale,
        refused=refused,
        **draft.bands,
    )


def _soft_terms(draft: _Draft, task: TaskTerms) -> ForceTerms | None:
    """Terms that a soft contact would be held to: under a contract for hard things alone."""
    soft = task.soft
    if soft is None or draft.force.force_n.high <= LIMIT_OVER_BAND * soft.force_n.high:
        return None
    return soft


def _take_words(draft: _Draft, request: Request, task: TaskTerms, *, is_own: bool) -> None:
    """Let the words change the draft; ``is_own``: they are the task's own instruction."""
    numbers, manner = request.numbers, request.manner
    if numbers.pressure:
        raise RefusedError(
            f"{numbers.pressure!r} is a pressure, and the area of the contact is not known before "
            "it is touched; name the force, for example '1.5 N'"
        )
    if numbers.unitless:
        raise RefusedError(f"{numbers.unitless} has no unit; say '{numbers.unitless} N'")
    if numbers.unread:
        raise RefusedError(numbers.unread)
    if numbers.percentage:
        raise RefusedError(f"{numbers.percentage} of what is not said; name the force: '0.5 N'")
    if numbers.masses.conflict:
        raise RefusedError(f"it says two masses of one object: {numbers.masses.conflict}")
    if numbers.denied:
        raise RefusedError(
            f"it says what not to hold with ({numbers.denied}), or what was used once, and "
            "names no other force"
        )
    if request.need and is_another(request.need.object, task.object):
        held = task.object.replace("_", " ")
        raise RefusedError(
            f"{request.need.words!r} says what something else takes than the {held}; say 'use ...' "
            "for this grip"
        )
    held, left = request.in_place
    if left and not is_another(left, task.object) and is_another(held, task.object):
        raise RefusedError(
            f"it asks for the {held}, not for the {left}; the forces here are those of "
            f"{with_article(task.object.replace('_', ' '))} (--task)"
        )
    if not is_own and _is_of_another_task(request.thing, task):
        draft.assumed.append(
            f"the {request.thing} is the object of another task (--task); the forces here are "
            f"those of {with_article(task.object.replace('_', ' '))}"
        )
    is_named = any(force.kind == "value" for force in numbers.forces)
    if is_named and numbers.factor is not None:
        raise RefusedError(
            f"it names {words_of(numbers.forces)} and a change ({numbers.factor_words.strip()}); "
            "say the force that is meant, for example '0.8 N'"
        )
    _take_lengths(draft, numbers)
    if numbers.place:
        draft.assumed.append(
            f"{numbers.place!r} is not read: goal.x_mm and goal.y_mm set the place on the pad"
        )
    if manner.sign and not is_own and not manner.conflict:
        draft.lean = LEANS[manner.sign, manner.strong]
    if numbers.forces:
        draft.words = words_of(numbers.forces)
        _check_wishes(numbers)
        draft.set_force(
            named_terms(numbers.forces, manner, task.force), f"your words: {draft.words}"
        )
        if (most_n := most_of(numbers.forces)) < math.inf:
            draft.named_most_n = ROUNDING * most_n
            if draft.force.limit_n < draft.named_most_n and draft.force == task.force:
                draft.origins["force_n"] = draft.origins["limit_n"] = TASK
                limit = f"the task's limit of {task.force.limit_n:.3g} N"
                draft.assumed.append(f"{draft.words!r} is above {limit} and does not raise it")
        _keep_within(draft, numbers)
        _note_tolerances(draft, numbers.forces, numbers.rest)
    elif numbers.delta_n is not None:
        draft.words = f"{numbers.delta_n:+.3g} N"
        draft.scale = 1 + numbers.delta_n / task.force.force_n.middle
        draft.set_force(scaled_terms(draft.scale, task.force), f"your words: {draft.words}")
    elif numbers.factor is not None:
        draft.words, draft.scale = numbers.factor_words.strip(), numbers.factor
        draft.set_force(scaled_terms(numbers.factor, task.force), f"your words: {draft.words}")
    elif not is_own and (other := _others(task).get(_key(request.text))):
        draft.set_force(other, "your words: those of another task")
        draft.lean = NEUTRAL_LEAN  # its manner is that of its own terms
    elif manner.conflict:
        raise RefusedError(f"it asks for both: {manner.conflict}; say which")
    elif manner.sign and is_own:
        draft.assumed.append(f"{manner.words!r} is what the task's own band means")
    elif manner.sign:
        name = MANNER_NAMES[manner.sign, manner.strong]
        force = scaled_terms(MANNERS[manner.sign, manner.strong], task.force)
        draft.set_force(force, f"{name}: your words: {manner.words}")
    elif manner.words:
        draft.assumed.append(f"{manner.words!r} cancel each other: the task's band")


def _check_wishes(numbers: Quantities) -> None:
    """Refuse two forces that differ and are no alternatives: the larger one may be a bound.

    Raises:
        RefusedError: There are such two.
    """
    values = [force.value_n for force in numbers.forces if force.kind == "value"]
    if len(values) < 2 or max(values) <= ONE_FORCE * min(values) or _OR.search(numbers.rest):
        return
    raise RefusedError(
        f"it names {words_of(numbers.forces)} and does not say what each is for; say, for example, "
        f"'{min(values):.3g} N, at most {max(values):.3g} N'"
    )


def _keep_within(draft: _Draft, numbers: Quantities) -> None:
    """Lower the limit to a number that the words state above the force that they ask for."""
    stated = stated_most(numbers.forces, numbers.stated)
    if stated is None or draft.force.limit_n <= (most_n := ROUNDING * stated.value_n):
        return
    band = draft.force.force_n
    within = Band(low=min(band.low, most_n), high=min(band.high, most_n))
    draft.force = replace(draft.force, force_n=within, limit_n=most_n)
    draft.named_most_n = min(most_n, draft.named_most_n or most_n)
    draft.assumed.append(f"{words_of([stated])!r} is taken as a limit, as it is not asked for")


def _note_tolerances(draft: _Draft, forces: Sequence[Force], rest: str) -> None:
    """Say which stated tolerances are not kept as they are."""
    if re.search(r"± ?[\d.,]+ ?(?:%|per)", rest):
        draft.assumed.append("a tolerance that belongs to no single force is not used")
    for force in forces:
        if force.within_n and force.kind != "value":
            draft.assumed.append(f"{force.words!r}: the tolerance of a bound is not used")
        elif force.within_n:
            band, (low_n, high_n) = toleranced_band(force), force.within_n
            if (band.low, band.high) != (low_n, high_n):
                draft.assumed.append(
                    f"{force.words!r} is narrower than can be held, which is "
                    f"{band.low:.3g}-{band.high:.3g} N"
                )


def _key(instruction: str) -> str:
    """An instruction without what changes no meaning: case, spaces and the final full stop."""
    return " ".join(instruction.casefold().split()).rstrip(" .!")


def _is_of_another_task(thing: str, task: TaskTerms) -> bool:
    """Whether a thing is not the task's object, and another task's own instruction names it."""
    if not thing or not is_another(kind_of(thing), task.object):
        return False
    return any(kind_of(thing) in instruction.casefold() for instruction in task.others)


def _others(task: TaskTerms) -> dict[str, ForceTerms]:
    return {_key(instruction): terms for instruction, terms in task.others.items()}


def _take_lengths(draft: _Draft, numbers: Quantities) -> None:
    """Slip, depth and area that the words name."""
    bands: dict[str, Any] = {}
    if numbers.slip_mm is not None:
        bands["slip_mm"] = numbers.slip_mm
    for name, value, most in (
        ("depth_mm", numbers.depth_mm, DEFAULT_DEPTH_MM.high),
        ("area_fraction", numbers.area_fraction, 1.0),
    ):
        if value is not None:
            low, high = (min(most, value * (1 + side * AROUND)) for side in (-1, 1))
            bands[name] = Band(low=low, high=high)
    draft.bands |= bands
    draft.origins |= dict.fromkeys(bands, "your words")


def _take_configuration(draft: _Draft, given: Mapping[str, object]) -> None:
    """Let explicit configuration win; a force that words name against it is a conflict."""
    band, limit_n = given.get("force_n"), given.get("limit_n")
    if isinstance(band, Band):
        said = draft.force.force_n
        is_above = draft.named_most_n is not None and band.high > draft.named_most_n
        highest_n = max(said.high, draft.named_most_n or 0.0)
        if draft.words and (is_above or band.high < said.low or band.low > highest_n):
            raise RefusedError(
                f"the configuration sets force_n {band.low:g}-{band.high:g} N, the instruction "
                f"says {draft.words!r}; change one of them"
            )
        if draft.origins["force_n"] != TASK:
            words = draft.origins["force_n"].rpartition("your words: ")[2]
            draft.assumed.append(f"{words!r} gives way to the configuration's force_n")
        top_n = draft.named_most_n
        if top_n is None or draft.origins["limit_n"] == TASK:  # words above the task's limit
            top_n = min(default_limit_n(band), math.inf if top_n is None else top_n)
        draft.set_force(ForceTerms(force_n=band, limit_n=top_n), CONFIGURATION)
    if isinstance(limit_n, (int, float)):
        band = draft.force.force_n
        if limit_n < band.low:
            raise RefusedError(
                f"the configuration sets limit_n {limit_n:g} N, but the force band begins at "
                f"{band.low:.3g} N ({draft.origins['force_n']}); change one of them"
            )
        if limit_n < band.high:
            draft.assumed.append(f"the band ends at the configuration's limit_n {limit_n:g} N")
            band = Band(low=band.low, high=float(limit_n))
        if draft.named_most_n is None or limit_n < draft.named_most_n:
            draft.force = replace(draft.force, force_n=band, limit_n=float(limit_n))
            draft.origins["limit_n"] = CONFIGURATION
        else:
            draft.force = replace(draft.force, limit_n=draft.named_most_n)
            draft.assumed.append(f"{draft.words!r} is below the configuration's limit_n")
    for name in BANDS[2:]:
        if name in given:
            draft.bands[name], draft.origins[name] = given[name], CONFIGURATION


def _check_reach(draft: _Draft, given: Mapping[str, object], task: TaskTerms) -> None:
    """Refuse what the gripper can't keep, or what words alone may not ask for."""
    band, limit_n = draft.force.force_n, draft.force.limit_n
    if band.low > task.most_n:
        raise RefusedError(
            f"{draft.words or f'{band.low:.3g} N'} is beyond the gripper's {task.most_n:g} N "
            "(gripper.max_force_n)"
        )
    if limit_n < task.least_n:
        raise RefusedError(
            f"a limit of {limit_n:.3g} N is below {task.least_n:.3g} N, the least that this "
            "gripper can keep to for certain (gripper.min_force_n times gripper.max_force_gain)"
        )
    by_words = draft.origins["force_n"] not in (TASK, CONFIGURATION)
    most_n = most_by_words_n(task.force)
    # the limit of a named range is bounded too, so that "1 to 50 N" is refused
    is_named = draft.named_most_n is not None
    is_beyond = band.middle > most_n or (is_named and limit_n > most_n)
    if by_words and "limit_n" not in given and is_beyond:
        factor = most_n / task.force.limit_n
        raise RefusedError(
            f"{draft.words or f'{band.middle:.3g} N'} is more than {factor:g} times the "
            f"task's limit ({task.force.limit_n:.3g} N); if it is meant, set --goal.force-n"
        )
    if by_words and draft.words and "limit_n" not in given and limit_n > most_n:
        within = Band(low=min(band.low, most_n), high=min(band.high, most_n))
        draft.force = replace(draft.force, force_n=within, limit_n=most_n)
