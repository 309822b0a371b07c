"""The large objects: 36 from a household and 26 from a workshop, in mm.

Sizes follow everyday things; where the YCB set has the object, its published size to a few mm, as
far as analytic solids go. Our choice of what stands in for the paper's scans, which aren't public.
"""

from __future__ import annotations

from cltp.tactile.states import Shape
from sim.objects.assemblies import (
    angle_bar,
    apple,
    bolt,
    centre_punch,
    comb,
    fork,
    hairbrush,
    heat_sink,
    hose,
    lemon,
    link,
    mug,
    mustard_bottle,
    pear,
    pencil,
    phillips_driver,
    pulley,
    ribbed_cap,
    spatula,
    strawberry,
)
from sim.objects.booleans import Blend
from sim.objects.faces import Form
from sim.objects.object import Family, Hold, Part, Thing
from sim.objects.placing import along, moved
from sim.objects.primitives import (
    ball,
    block,
    bored,
    box,
    cone,
    flat_bar,
    lengthwise,
    oval,
    polygon,
    prism,
    rod,
    rounded,
    taper,
    tube,
    waves,
)
from sim.objects.skins import SMOOTH, Skin, bumpy, ridged, rough, woven
from sim.objects.solids import Hoop, Solid


def _things(family: Family, *rows: Thing) -> tuple[Thing, ...]:
    return tuple(
        Thing(r.name, family, r.features, r.parts, r.holds, r.held, r.modulus_mpa) for r in rows
    )


def _a(
    name: str,
    features: str,
    *solids: Solid | Part,
    skin: Skin = SMOOTH,
    shown: float = 0.0,
    at: tuple[float, float, float] = (0.0, 0.0, 0.0),
    towards: tuple[float, float, float] = (0.0, 0.0, 1.0),
    soft: float | None = None,
) -> Thing:
    """An object of solids with one skin, or of parts with their own.

    ``shown``: how often the side ``towards`` is held to the pad on purpose.
    """
    parts = tuple(one if isinstance(one, Part) else Part(one, skin) for one in solids)
    holds = (Hold(towards, at, 1.0),) if shown else ()
    return Thing(name, Family.HOUSEHOLD, features, parts, holds, shown, soft)


_CARD = rough(0.03, 0.6)

HOUSEHOLD = _things(
    Family.HOUSEHOLD,
    _a("cracker_box", "large carton", box(60, 160, 210, 0.5)),
    _a("sugar_box", "carton, rough", box(38, 89, 175, 0.5), skin=_CARD),
    _a("gift_box", "box in ribbed paper", box(70, 70, 50, 0.4), skin=ridged(0.08, 1.2)),
    _a("woven_basket", "wicker box", box(90, 60, 40, 1.2), skin=woven(0.2, 1.4)),
    _a("toy_block", "block of wood", box(13, 10, 30, 0.5), skin=ridged(0.07, 1.1)),
    _a("soup_can", "can", rod(66, 101, 0.8), skin=ridged(0.06, 1.5)),
    _a("chips_can", "tall can", rod(75, 150, 0.5), skin=rough(0.03, 0.5)),
    _a("tuna_can", "flat can", rod(85, 33, 1.0)),
    _a(
        "mustard_bottle",
        "bottle with a pointed cap",
        mustard_bottle(),
        moved(cone(22, 22, 0.5, 17.0), z=152),
    ),
    _a(
        "water_bottle",
        "ribbed bottle",
        Part(rod(62, 120, 6.0), ridged(0.2, 1.5)),
        Part(moved(ribbed_cap(28, 16, 38, 1.1), z=12)),
    ),
    _a("banana", "banana", Hoop(75, 17, 0.75, Form.CURVED), soft=1.0),
    _a("apple", "apple", apple(), soft=2.5),
    _a("orange", "orange, pimpled peel", ball(74), skin=bumpy(0.08, 1.8), soft=1.2),
    _a("lemon", "lemon, rough peel", lemon(), skin=bumpy(0.06, 1.2), soft=1.2),
    _a("peach", "peach, furry", ball(60), skin=rough(0.04, 0.35), soft=0.8),
    _a("pear", "pear", pear(), soft=1.5),
    _a("plum", "plum", oval(40, 38, 38), soft=1.0),
    _a("strawberry", "strawberry with seeds", strawberry(), skin=bumpy(0.1, 2.6), soft=0.5),
    _a("egg", "hen's egg", oval(44, 44, 58)),
    _a("tennis_ball", "felt ball", ball(66), skin=rough(0.08, 0.6), soft=1.5),
    _a("golf_ball", "dimpled ball", ball(42.7), skin=bumpy(0.18, 2.9)),
    _a("marble_25", "glass ball", ball(25)),
    _a(
        "mug",
        "mug with a handle",
        *mug(),
    ),
    _a("napkin_ring", "band", tube(12.4, 10, 24), shown=0.55),
    _a("fork", "fork", *fork(), shown=0.6),
    _a("spoon", "spoon", oval(32, 55, 14), moved(along("y", lengthwise(5, 110)), 0, 130, 2)),
    _a("kitchen_knife", "blade, 1.2 mm thick", flat_bar(120, 1.2, 30), shown=0.55),
    _a("spatula", "slotted turner", *spatula(), shown=0.55),
    _a("pencil", "round rod with a point", *pencil(), shown=0.35),
    _a("marker", "round pen", lengthwise(16, 110), moved(rod(9, 14), z=20)),
    _a("sponge", "sponge", box(95, 62, 26, 4.0), skin=rough(0.05, 0.32), soft=0.3),
    _a("rope", "rope, laid", along("x", moved(lengthwise(12, 120), z=60)), skin=woven(0.2, 1.5)),
    _a("hairbrush", "brush with balls", *hairbrush(), shown=0.75, at=(0, 0, 7)),
    _a("comb", "comb", *comb(), shown=0.65),
    _a("soap", "oval bar of soap, knobbed", oval(85, 55, 30), skin=bumpy(0.12, 2.4)),
    _a("cork", "cork", taper(13, 15.5, 28, 0.6), skin=rough(0.07, 0.5)),
)

INDUSTRIAL = _things(
    Family.INDUSTRIAL,
    _a(
        "bolt_m12",
        "bolt with a hexagonal head",
        *bolt(),
        shown=0.5,
    ),
    _a(
        "nut_m8",
        "hexagonal nut",
        bored(prism(polygon(6, 14.5), 7, Shape.HEXAGON, 0.4), 8),
        shown=0.5,
    ),
    _a("washer_m8", "washer", tube(16, 8.4, 1.6, 0.2), shown=0.6),
    _a("retaining_ring", "open ring", moved(Hoop(5.6, 0.75, 2.0), z=-0.75), shown=0.75),
    _a("chain_link", "oval link", link(), shown=0.6),
    _a("o_ring", "rubber ring", moved(Hoop(5.2, 0.75), z=-0.75), shown=0.75),
    _a("shackle", "bent rod", Hoop(14, 3.5, 1.7, Form.CURVED), skin=rough(0.05, 0.4)),
    _a(
        "castor",
        "wheel with a round tread",
        Blend((Hoop(20, 12, form=Form.CURVED), rod(36, 8)), 1.0),
        skin=ridged(0.1, 1.2),
    ),
    _a("belt_pulley", "wheel with narrow teeth", pulley()),
    _a("heat_sink", "fins", *heat_sink(), shown=0.75),
    _a("corrugated_sheet", "corrugated sheet", waves(90, 90, 5.5, 0.45), shown=0.85),
    _a("corrugated_hose", "hose with rings", *hose()),
    _a("file", "flat file", box(40, 150, 8, 0.4), skin=woven(0.1, 0.7)),
    _a("rasp", "round rasp", along("x", moved(rod(24, 120, 1.0), z=60)), skin=bumpy(0.2, 2.2)),
    _a(
        "hexagonal_bar",
        "hexagonal bar",
        along("x", moved(prism(polygon(6, 21), 100, Shape.HEXAGON, 0.5), z=50)),
    ),
    _a("dowel", "wooden rod", along("x", moved(rod(8, 100), z=50)), skin=rough(0.035, 0.5)),
    _a("pipe", "pipe", along("x", moved(tube(34, 28, 120, 0.6), z=60)), skin=rough(0.05, 0.5)),
    _a(
        "flange",
        "disc with a bore",
        bored(rod(14.4, 9, 0.5), 6.0),
        skin=ridged(0.07, 0.9),
        shown=0.3,
    ),
    _a("knurled_knob", "knurled knob", rod(24, 16, 1.2), skin=woven(0.15, 1.1)),
    _a("rubber_foot", "dome", rounded(14, 12, 26), skin=bumpy(0.1, 1.5), soft=3.0),
    _a("ball_knob", "ball on a rod", ball(24), moved(rod(8, 40), z=-10)),
    _a("angle_bar", "angle, sharp outside", angle_bar(), skin=rough(0.04, 0.5)),
    _a("square_bar", "square bar", box(24, 24, 120, 0.5), skin=ridged(0.08, 0.7)),
    _a("centre_punch", "punch with a point", centre_punch(), shown=0.5),
    _a("phillips_driver", "cross tip, ribbed handle", *phillips_driver(), shown=0.5),
    _a(
        "perforated_plate",
        "plate with a hole",
        bored(block(14, 12, 9), 5.5),
        skin=woven(0.08, 0.9),
        shown=0.4,
    ),
)

LARGE: tuple[Thing, ...] = (*HOUSEHOLD, *INDUSTRIAL)
