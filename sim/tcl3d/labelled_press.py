"""Contacts of a pressed series: what was solved, with the labels that follow from it.

Not here: the labels themselves (``sim.tcl3d.labels``), and how an object names its shape and
texture (``sim.tcl3d.shape_labels``).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict, dataclass

from cltp.data.contact import Contact, Gel, Split
from cltp.tactile.sensors import SensorSpec
from cltp.tactile.states import Texture
from sim.gel.force_factor import force_factor
from sim.gel.layer import GelMaterial, Press
from sim.tcl3d.contact_geometry import Mask, ShapeLabel
from sim.tcl3d.labels import SHAPE, TEXTURE, in_contact, label, uncertain_labels


@dataclass(frozen=True, slots=True, kw_only=True)
class Naming:
    """Shape and texture of a contact, and whether each is certain."""

    shape: ShapeLabel
    texture: Texture
    is_texture_sure: bool


NameContact = Callable[[Mask, Mask, float], Naming]
"""Names a contact by its points under pressure, the same with fine gaps closed, and its depth
[mm]; masks are (H, W)."""


def label_press(
    press: Press,
    name: NameContact,
    *,
    object_name: str,
    sensor: SensorSpec,
    gel: GelMaterial,
    split: Split,
    seed: int,
    series: int,
) -> list[Contact]:
    """Label the solved contacts of one series.

    Args:
        press: B solved contacts, lightest first.
        name: Names each of them.
        object_name: Name of the pressed object.
        sensor: The sensor, whose whole sensing area was solved.
        gel: Its gel.
        split: Use of the contacts.
        seed: Random seed of the data set.
        series: Number of the series.

    Returns:
        B contacts.
    """
    pressure = press.pressure_kpa.cpu()
    closed = in_contact(pressure, sensor.width_mm / pressure.shape[2])
    contacts = []
    for i in range(len(pressure)):
        height_mm, load = press.height_mm[i].cpu().numpy(), pressure[i].numpy()
        naming = name(load > 0, closed[i], float(height_mm.max()))
        state = label(
            height_mm=height_mm,
            pressure_kpa=load,
            touching=closed[i],
            force_n=float(press.force_n[i]),
            sensor=sensor,
            shape=naming.shape.shape,
            texture=naming.texture,
        )
        unsure = uncertain_labels(state, sensor)
        unsure |= set() if naming.shape.sure else {SHAPE}
        unsure |= set() if naming.is_texture_sure else {TEXTURE}
        contacts.append(
            Contact(
                height_mm=height_mm,
                sensor=sensor,
                state=state,
                object=object_name,
                series=series,
                split=split,
                gel=Gel(**asdict(gel)),
                seed=seed,
                unsure=frozenset(unsure),
                approach_mm=float(press.depth_mm[i]),
                peak_kpa=float(load.max()),
                force_factor=force_factor(gel, sensor.name),
            )
        )
    return contacts
