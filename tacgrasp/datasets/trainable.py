"""Whether a data set may be learned from: made by today's recipe, of today's gels.

An older set can still be looked into. To learn from it would teach what this program no longer
simulates.
"""

from __future__ import annotations

import numpy as np

from cltp.data.dataset import GEL_COLUMNS, ContactDataset
from cltp.errors import TouchError
from sim.gel.layer import GEL_MATERIALS
from tacgrasp.datasets.recipes import FULL_MAKER, TCL3D_MAKER

GENERATED = "tacgrasp data generate"
MAKERS = {"full": FULL_MAKER, "tcl3d": TCL3D_MAKER}
FORMER_SET = "starter"
"""A set that this program no longer makes. Its files name no set."""

ENOUGH = 500
"""Contacts on a sensor from which its nominal gel must be among them."""

_RELATIVE = 1e-3


def check_trainable(data: ContactDataset) -> None:
    """Refuse a generated data set of another recipe or other gels; others may be learned from.

    Raises:
        TouchError: It must be generated again; the message says how.
    """
    about = data.about
    if about.get("made_by") != GENERATED:
        return
    name = about.get("set", FORMER_SET)
    maker, again = about.get("maker"), f"tacgrasp data generate --set full --out {data.folder}-full"
    if name not in MAKERS or maker != MAKERS[name]:
        today = (
            f"this program has {MAKERS[name]!r}" if name in MAKERS else "which is no longer made"
        )
        raise TouchError(
            f"{data.folder} was made by the recipe {maker!r} of the set {name}, {today}; "
            f"it can be looked into, but not learned from: {again}"
        )
    for sensor, found in _other_gels(data).items():
        gel = GEL_MATERIALS[sensor]
        raise TouchError(
            f"{data.folder} was made with other gels ({sensor}: {found}; this program has "
            f"{gel.thickness_mm:g} mm, {gel.young_mpa:g} MPa, nu {gel.poisson:g}); it can be "
            f"looked into, but not learned from: {again}"
        )


def _other_gels(data: ContactDataset) -> dict[str, str]:
    """Sensors whose nominal gel of today is not among many contacts, and their first gel."""
    sensors = data.column("sensor")
    other = {}
    for sensor, gel in GEL_MATERIALS.items():
        rows = np.flatnonzero(sensors == sensor)
        if len(rows) < ENOUGH:
            continue
        columns = [np.asarray(data.column(GEL_COLUMNS[n])[rows], dtype=np.float64) for n in _NAMES]
        nominal = [getattr(gel, name) for name in _NAMES]
        same = [
            np.isclose(column, value, rtol=_RELATIVE)
            for column, value in zip(columns, nominal, strict=True)
        ]
        if not np.logical_and.reduce(same).any():
            first = [float(column[0]) for column in columns]
            other[sensor] = f"{first[0]:g} mm, {first[1]:g} MPa, nu {first[2]:g}"
    return other


_NAMES = ("thickness_mm", "young_mpa", "poisson")
