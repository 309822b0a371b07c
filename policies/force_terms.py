"""Force band and limit out of what words say: forces in newtons, factors, manner.

Not here: what the configuration says beside them (``policies.contract``).
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import replace

from policies.instructions.manner import Manner
from policies.instructions.quantities import Force
from primitives.contract import Band, ForceTerms, default_limit_n

AROUND = 0.14
"""Half width of the band around a named force, as a fraction. Our choice: below the 15 % that
people mean by a number; the felt force varies by some percent from frame to frame."""

LEAST_TOLERANCE = 0.05
"""Narrowest half width of a band that a tolerance names, as a fraction. Our choice: a step aims
with about 5 %, and the felt force varies by some percent from frame to frame."""

BELOW_MOST = 0.9
"""Top of the band under a named most, as a fraction of it: room for the error of a felt force."""

FIRMEST = 0.58
"""Largest low end of a firm band under a named most, as a fraction of the hard limit. Our choice: a
peg's force is felt to within a factor of 1.65, and what it may be at most stays below the limit, so
that 0.6 of the limit is reached there."""

ROUNDING = 0.99
"""Hard limit over a named most: '200 g' is 1.96 N to one reader and 1.961 N to another."""

ABOVE_LEAST = 1.03
"""Low end of the band over a named least, as a factor."""

SPAN = 2.0
"""High over low end of a band of which one end is named. Source: the bands of the tasks."""

MANNERS: Mapping[tuple[int, bool], float] = {
    (-1, True): 0.65,
    (-1, False): 0.82,
    (1, False): 1.16,
    (1, True): 1.32,
}
"""Middle of the band over the middle of the task's, by direction and emphasis. Our choice: people
ask for a change that they would notice, and a strawberry stands no more than a third."""

MOST_OF_TASK = 3.0
"""Largest force that words alone may name, as a factor on the task's limit."""

MOST_OF_NEEDS = 1.4
"""The same for a task whose band is that of objects of all sizes: three times what one of a common
size (a berry of 25 g) may be pressed with."""

MANNER_NAMES: Mapping[tuple[int, bool], str] = {
    (-1, True): "very gentle",
    (-1, False): "gentle",
    (+1, False): "firm",
    (+1, True): "very firm",
}
"""How the origin of a band that a manner has moved begins, by the keys of ``MANNERS``."""

LEANS: Mapping[tuple[int, bool], float] = {
    (-1, True): 0.1,
    (-1, False): 0.25,
    (1, False): 0.5,
    (1, True): 0.65,
}
"""Lean of the target (``primitives.contract.Contract``), by direction and emphasis. Our choice: the
ends themselves are as uncertain as what is felt. Of 80 strawberries none bruised so, two with
emphasis; with 0.65 and 0.8 it was four and nine."""

LEAST_HALF, MOST_HALF = 0.17, 0.34
"""Half width of a scaled band, as a fraction of its middle; the task's bands have 0.33."""


FIRMER_LIMIT = 1.08
"""Hard limit over the top of a band that is firmer than the task's. Our choice: the firmer the
grip, the nearer the bruise, so that the reserve is smaller than ``LIMIT_OVER_BAND``."""


def most_by_words_n(task: ForceTerms) -> float:
    """Largest force, and largest limit, that words alone may name under a task [N]."""
    return (MOST_OF_NEEDS if task.needs else MOST_OF_TASK) * task.limit_n


class RefusedError(Exception):
    """An instruction that makes no contract; the message says why."""


def named_terms(forces: Sequence[Force], manner: Manner, task: ForceTerms) -> ForceTerms:
    """Band and limit of forces that are named in newtons.

    Args:
        forces: The forces; at least one.
        manner: Manner beside them: it leans within the band under a named most.
        task: Terms of the task, for the end that is not named.

    Raises:
        RefusedError: A force is not finite and positive, or they exclude each other.
    """
    values = [f.value_n for f in forces if f.kind == "value"]
    most, top = (
        most_of(forces),
        min((f.value_n for f in forces if f.kind == "most"), default=math.inf),
    )
    least = max((f.value_n for f in forces if f.kind == "least"), default=0.0)
    _check(forces, values, top, least)
    if values:
        band = _around(forces, least)
    elif least > 0 and most < math.inf:
        top_n = min(top, BELOW_MOST * most)
        low_n = least if least < ROUNDING * top else (1 - AROUND) * top  # 'no less and no more'
        band = Band(low=low_n, high=top_n if top_n > 1.1 * low_n else top)
    elif most < math.inf and most > most_by_words_n(task):
        return task  # it asks for nothing beyond the task's own
    elif most < math.inf:
        band = _under(BELOW_MOST * most, task.force_n)
        band = band if task.needs else _lean(band, manner, FIRMEST * ROUNDING * most)
    else:
        low_n, high_n = ABOVE_LEAST * least, task.force_n.high
        if not task.needs:  # a least asks for no less than the task does
            low_n = max(low_n, task.force_n.low)
        band = Band(low=low_n, high=high_n if high_n > 1.4 * low_n else low_n * math.sqrt(SPAN))
    is_told = all(f.is_told for f in forces if f.kind != "value")
    is_range = least > 0 and most < math.inf and not is_told
    needs = "" if values or is_range else task.needs  # named newtons are the target themselves
    if most < math.inf:
        limit_n = ROUNDING * most
        if all(f.is_told for f in forces if f.kind == "most"):  # 'it cracked at 6 N' raises none
            limit_n = min(limit_n, default_limit_n(band) if values else task.limit_n)
        band = Band(low=min(band.low, limit_n), high=min(band.high, limit_n))
        return ForceTerms(force_n=band, limit_n=limit_n, needs=needs)
    limit_n = default_limit_n(band)
    if not values:  # a least bounds nothing from above
        limit_n = max(limit_n, task.limit_n)
    return ForceTerms(force_n=band, limit_n=limit_n, needs=needs)


def stated_most(forces: Sequence[Force], stated: Sequence[Force]) -> Force | None:
    """The smallest force that is stated above the ones that are asked for; None where none is.

    "1 N. The alarm goes off at 1.2 N" asks for 1 N; no grip should pass the other number, whatever
    was meant by it.
    """
    asked_n = max((f.value_n for f in forces if f.kind != "most"), default=math.inf)
    above = [f for f in stated if f.kind != "least" and asked_n < f.value_n < math.inf]
    return min(above, key=lambda force: force.value_n, default=None)


def most_of(forces: Sequence[Force]) -> float:
    """Largest force that words allow [N]; infinite where they bound none.

    A limit beside a range may lie above it: 'between 1 and 2 N, never above 3 N'.
    """
    mosts = [force for force in forces if force.kind == "most"]
    ranges = {force.words for force in forces if force.kind == "least"}
    tops = [force.value_n for force in mosts if force.words in ranges]
    limits = [force for force in mosts if force.words not in ranges]
    limit_n = min((force.value_n for force in limits), default=math.inf)
    if tops and limits and limit_n > min(tops) and not any(each.is_told for each in limits):
        return limit_n
    return min(*tops, limit_n, math.inf)


def _check(forces: Sequence[Force], values: list[float], most: float, least: float) -> None:
    words = words_of(forces)
    if not all(0 < force.value_n < math.inf for force in forces):
        raise RefusedError(f"{words}: a grip needs a finite force above 0 N")
    highest = max(values, default=least)
    excluded = (
        bool(values) and highest > (1 + AROUND) ** 2 * min(values),
        max(highest, least) > most,
        bool(values) and least > (1 + AROUND) * highest,
    )
    if any(excluded):
        raise RefusedError(f"it names forces that exclude each other: {words}")


def words_of(forces: Sequence[Force]) -> str:
    """The words that name forces, each once; newtons with a capital, as they are written."""
    words = ", ".join(dict.fromkeys(force.words for force in forces))
    return _NEWTONS.sub(r"\1N", words)


_NEWTONS = re.compile(r"(?<=\d)(\s*(?:k|c|d|da|m|µ)?)n\b")
"""A number of newtons in a plain text, whose letters are all small."""


def _around(forces: Sequence[Force], least_n: float) -> Band:
    """The band of the stated tolerance around the named forces, or one of ``AROUND``."""
    values = [f.value_n for f in forces if f.kind == "value"]
    value_n = sum(values) / len(values)
    band = Band(low=value_n * (1 - AROUND), high=value_n * (1 + AROUND))
    for force in forces:
        if force.kind == "value" and force.within_n:
            band = toleranced_band(force)
    return Band(low=max(band.low, least_n), high=max(band.high, least_n))


def toleranced_band(force: Force) -> Band:
    """Band of a force with a stated tolerance [N], no narrower than can be held.

    Raises:
        RefusedError: The tolerance is not finite, or leaves no force.
    """
    low_n, high_n = force.within_n or (force.value_n, force.value_n)
    if not 0 < low_n <= high_n < math.inf:
        raise RefusedError(f"{force.words}: with that tolerance the grip may have no force at all")
    least_n = LEAST_TOLERANCE * force.value_n
    return Band(low=min(low_n, force.value_n - least_n), high=max(high_n, force.value_n + least_n))


def _under(top_n: float, task: Band) -> Band:
    """The task's band under a top; below it, as wide as the task's."""
    high = min(task.high, top_n)
    low = task.low if high >= 1.3 * task.low else min(task.low, high / SPAN)
    return Band(low=low, high=high)


def _lean(band: Band, manner: Manner, firmest_n: float) -> Band:
    """The light or the firm part of a band, from ``firmest_n`` at most on."""
    if manner.sign < 0:
        return Band(low=band.low, high=max(band.middle, 1.3 * band.low))
    if manner.sign > 0:
        firm_n = min(band.middle, band.high / 1.3, firmest_n)
        return Band(low=max(firm_n, band.low), high=band.high)
    return band


def scaled_terms(factor: float, task: ForceTerms) -> ForceTerms:
    """The task's band with its middle moved by a factor.

    A softer band has a limit that is softer too, a firmer one less reserve above it, but never a
    lower limit than the task's.

    Raises:
        RefusedError: No force is left.
    """
    band = task.force_n
    middle = factor * band.middle
    if not 0 < middle < math.inf:
        raise RefusedError("it leaves no force to hold with")
    if task.needs:  # the light end stays: it is for other objects, not for another manner
        low = band.low * min(1.0, factor)
        scaled = Band(low=low, high=max(2 * middle - low, low))
        return replace(task, force_n=scaled, limit_n=_scaled_limit_n(factor, scaled, task))
    inside = min(abs(middle - band.low), abs(band.high - middle))
    half = min(max(LEAST_HALF * middle, inside), MOST_HALF * middle)
    scaled = Band(low=middle - half, high=middle + half)
    return ForceTerms(force_n=scaled, limit_n=_scaled_limit_n(factor, scaled, task))


def _scaled_limit_n(factor: float, scaled: Band, task: ForceTerms) -> float:
    """Hard limit of a scaled band [N]; a softer one has as much room above it as the task's."""
    if factor < 1:
        return task.limit_n * scaled.high / task.force_n.high
    return max(FIRMER_LIMIT * scaled.high, task.limit_n)
