"""Scenes for tests of questions."""

from __future__ import annotations

import numpy as np

from cltp.tactile.sensors import SENSORS
from cltp.tactile.states import (
    NO_CONTACT_STATE,
    ContactState,
    Shape,
    Side,
    Texture,
    area_word,
    depth_word,
    position_word,
)
from tacgrasp.lessons.dialogue.scene import AskedScene, band_contract

MINI = SENSORS["gelsight_mini"]


def contact(
    depth_mm: float = 0.19,
    x_mm: float = 0.8,
    y_mm: float = -1.2,
    area_fraction: float = 0.12,
    force_n: float = 0.83,
    shape: Shape | None = Shape.ELLIPSOID,
    texture: Texture | None = Texture.SMOOTH,
    cut: frozenset[Side] = frozenset(),
) -> ContactState:
    return ContactState(
        depth_mm=depth_mm,
        x_mm=x_mm,
        y_mm=y_mm,
        area_fraction=area_fraction,
        force_n=force_n,
        depth=depth_word(depth_mm),
        position=position_word(x_mm, y_mm, MINI),
        area=area_word(area_fraction),
        shape=shape,
        texture=texture,
        cut=cut,
    )


HELD = AskedScene(state=contact(), contract=band_contract(0.62, 0.95, 1.3), mass_g=25.0)
LIGHT = AskedScene(state=contact(force_n=0.3, depth_mm=0.08), contract=band_contract(0.62, 0.95))
FIRM = AskedScene(
    state=contact(
        force_n=5.31, depth_mm=0.95, area_fraction=0.34, shape=Shape.STRIPES, texture=Texture.WOVEN
    ),
    contract=band_contract(0.62, 0.95),
    mass_g=300.0,
)
ASIDE = AskedScene(
    state=contact(
        x_mm=-7.4, y_mm=5.2, cut=frozenset({Side.LEFT}), shape=Shape.DOTS, texture=Texture.BUMPY
    ),
    contract=band_contract(0.5, 1.2),
    mass_g=60.0,
)
FREE = AskedScene(state=contact(shape=None, texture=None))
"""Neither contract nor mass, and an object that nobody named."""

UNTOUCHED = AskedScene(contract=band_contract(0.62, 0.95), mass_g=25.0)
MIDDLE_LEFT = AskedScene(
    state=contact(x_mm=-6.0, y_mm=0.3, shape=Shape.EDGE, texture=Texture.ROUGH, force_n=18.2),
    contract=band_contract(8.0, 14.0),
)
SCENES = (
    HELD,
    LIGHT,
    FIRM,
    ASIDE,
    MIDDLE_LEFT,
    FREE,
    UNTOUCHED,
    AskedScene(state=NO_CONTACT_STATE),
)


def random_states(num: int, seed: int = 0) -> list[ContactState]:
    """Contacts of all classes."""
    rng = np.random.default_rng(seed)
    shapes, textures, sides = list(Shape), list(Texture), list(Side)
    return [
        contact(
            depth_mm=float(np.exp(rng.uniform(np.log(0.03), np.log(1.3)))),
            x_mm=float(rng.uniform(-10, 10)),
            y_mm=float(rng.uniform(-7.5, 7.5)),
            area_fraction=float(np.exp(rng.uniform(np.log(0.01), np.log(0.6)))),
            force_n=float(np.exp(rng.uniform(np.log(0.1), np.log(9.0)))),
            shape=shapes[rng.integers(len(shapes))],
            texture=textures[rng.integers(len(textures))],
            cut=frozenset([sides[rng.integers(len(sides))]] if rng.random() < 0.3 else []),
        )
        for _ in range(num)
    ]
