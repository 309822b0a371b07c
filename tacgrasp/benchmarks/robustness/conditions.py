"""Conditions of the robustness benchmark: each nuisance at its levels, all others nominal."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from cltp.tactile.noise_levels import NoiseLevels
from cltp.tactile.sensors import sensor_named
from sim.gel.layer import GelMaterial, gel_of

SENSOR = "gelsight_mini"

_ONCE = NoiseLevels()


@dataclass(frozen=True, slots=True, kw_only=True)
class Condition:
    """State of a sensor.

    Attributes:
        levels: Its noise.
        turn_deg: 90 for a sensor mounted a quarter turn; 0 for an upright one of which only those
            contacts count that could be turned as well; None for all contacts.
        young_factor: Young's modulus of its gel over the nominal one.
        gel_mm: Thickness of its gel [mm]; None for the nominal one.
    """

    levels: NoiseLevels = _ONCE
    turn_deg: int | None = None
    young_factor: float = 1.0
    gel_mm: float | None = None

    @property
    def gel(self) -> GelMaterial | None:
        """Its gel; None for the nominal one."""
        if self.young_factor == 1 and self.gel_mm is None:
            return None
        nominal = gel_of(SENSOR)
        return dataclasses.replace(
            nominal,
            young_mpa=nominal.young_mpa * self.young_factor,
            thickness_mm=self.gel_mm or nominal.thickness_mm,
        )

    @property
    def in_the_loop(self) -> Condition:
        """The condition of an episode, which has no choice of contacts."""
        return dataclasses.replace(self, turn_deg=None) if self.turn_deg == 0 else self


NOMINAL = Condition()

_FACTORS = (0.0, 1.0, 2.0, 3.0)
_THIN_MM, _THICK_MM = 3.0, 4.2


def _noise(name: str, level: float) -> Condition:
    """One kind of noise at a level, the others as measured."""
    changes: dict[str, Any] = {name: level}
    return Condition(levels=dataclasses.replace(_ONCE, **changes))


NUISANCES: Mapping[str, Mapping[float, Condition]] = {
    "fine": {level: _noise("fine", level) for level in _FACTORS},
    "drift": {level: _noise("drift", level) for level in _FACTORS},
    "tilt": {level: _noise("tilt", level) for level in _FACTORS},
    "scale": {level: _noise("scale", level) for level in _FACTORS},
    "missing": {level: _noise("missing", level) for level in (0.0, 0.1, 0.2, 0.3)},
    "order": {0.0: NOMINAL, 1.0: Condition(levels=NoiseLevels(shuffled=True))},
    "rotation": {0.0: Condition(turn_deg=0), 90.0: Condition(turn_deg=90)},
    "gel_young": {
        0.6: Condition(young_factor=0.6),
        1.0: Condition(),
        1.7: Condition(young_factor=1.7),
    },
    "gel_mm": {
        _THIN_MM: Condition(gel_mm=_THIN_MM),
        sensor_named(SENSOR).gel_mm: NOMINAL,
        _THICK_MM: Condition(gel_mm=_THICK_MM),
    },
}
"""By name and level: noise as factors on what is measured, missing points as a fraction, order as
shuffled or not, rotation in degrees, Young's modulus over the nominal one, thickness in mm.

Contacts of the two gel nuisances, the nominal gel included, are pressed for them
(``tacgrasp.benchmarks.robustness.contacts``); of the others they are those of a data set.
"""

GEL_NUISANCES = ("gel_young", "gel_mm")
