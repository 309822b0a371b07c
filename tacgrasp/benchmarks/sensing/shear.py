"""Part of ``tacgrasp bench gel``: friction with memory against closed forms.

A ball on a layer many times as thick as the contact is wide is Cattaneo's and Mindlin's problem.
Their constant is Johnson's: a shift of 3 mu P S / (16 a) [1 - (1 - Q / mu P)^(2/3)], where S is the
sum of (2 - nu)/G over both bodies. For small loads that is Mindlin's stiffness 8 a / S.

Source: Johnson, Contact Mechanics, sections 7.2, 7.4 and 7.5; the loss of a cycle is Mindlin's and
Deresiewicz's. Our own check: each follows from the shift by Masing's rule.

Not here: what the form for the closed loop is worth (``shear_pace``).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import torch
from torch import Tensor

from cltp.processor import torch_threads
from sim.gel.layer import ElasticLayer, GelMaterial, Press, gel_of
from sim.gel.shear.layer import Shear, ShearLayer
from tacgrasp.benchmarks.figures import Figure

FRICTION, POISSON = 0.5, 0.47
SIZE, BALL_MM, CONTACT_MM = 61, 20.0, 1.0
LOADS = 10
HALF_CYCLE = 16
"""Grid, ball and contact radius; loads up to 0.99 of sliding; steps from one end to the other."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Mindlin:
    """Closed forms of a ball that is loaded sideways, t = Q / mu P.

    Attributes:
        limit_n: Friction mu P [N].
        slide_mm: Shift at which all of the contact slides [mm].
    """

    limit_n: float
    slide_mm: float

    def shift_mm(self, t: float) -> float:
        """Shift under a load."""
        return self.slide_mm * (1 - (1 - t) ** (2 / 3))

    def load(self, shift_mm: float) -> float:
        """Load t of a shift."""
        return 1 - (1 - shift_mm / self.slide_mm) ** 1.5

    def loss_mj(self, t: float) -> float:
        """Loss of a cycle between -t and t [mJ]."""
        lost = 1 - (1 - t) ** (5 / 3) - 5 / 6 * t * (1 + (1 - t) ** (2 / 3))
        return 24 / 5 * self.slide_mm * self.limit_n * lost

    def residue_mm(self, t: float) -> float:
        """Shift that is left when a load t is taken away."""
        return self.shift_mm(t) - 2 * self.slide_mm * (1 - (1 - t / 2) ** (2 / 3))


@dataclass(frozen=True, slots=True, kw_only=True)
class Ball:
    """A ball pressed on a thick layer.

    Attributes:
        layer: Gel and friction.
        press: The press.
        radius_mm: Radius of a disc as large as the contact [mm].
        forms: Closed forms of this contact.
    """

    layer: ShearLayer
    press: Press
    radius_mm: float
    forms: Mindlin

    def stick_radius(self, shear: Shear) -> float:
        """Radius of a disc as large as the sticking part, over the contact's."""
        return math.sqrt(shear.sticking.sum().item() / (self.press.pressure_kpa > 0).sum().item())

    def step(self, before: Shear | None, by_mm: float) -> Shear:
        """Contact after a motion along x."""
        motion = torch.tensor([[by_mm, 0.0, 0.0]], dtype=torch.float64)
        return self.layer.step(before, self.press.pressure_kpa, motion, tol=1e-5)


def ball_on(thickness_mm: float, size: int = SIZE) -> Ball:
    """A ball on a layer, with a contact of ``CONTACT_MM``."""
    pitch = 2.3 * CONTACT_MM / size
    material = GelMaterial(thickness_mm=thickness_mm, young_mpa=0.4, poisson=POISSON)
    gel = _square(material, size, pitch)
    gap = _radius_mm(size, pitch) ** 2 / (2 * BALL_MM)
    press = gel.press_to_depth(gap[None], CONTACT_MM**2 / BALL_MM)
    area = (press.pressure_kpa > 0).sum().item() * pitch**2
    radius = math.sqrt(area / math.pi)
    modulus = material.young_mpa / (2 * (1 + POISSON))
    limit = FRICTION * press.force_n.item()
    slide = 3 * limit / (16 * radius) * (2 - POISSON) / modulus
    return Ball(
        layer=ShearLayer(gel, friction=FRICTION),
        press=press,
        radius_mm=radius,
        forms=Mindlin(limit_n=limit, slide_mm=slide),
    )


def _radius_mm(size: int, pitch_mm: float) -> Tensor:
    axis = (torch.arange(size, dtype=torch.float64) - (size - 1) / 2) * pitch_mm
    return torch.hypot(axis[:, None], axis[None, :])


def _square(material: GelMaterial, size: int, pitch_mm: float) -> ElasticLayer:
    return ElasticLayer(material, rows=size, columns=size, pitch_mm=pitch_mm, dtype=torch.float64)


def cattaneo_mindlin(radii: float, *, size: int = SIZE, loads: int = LOADS) -> list[Figure]:
    """Worst errors of shift and stick radius on a layer so many contact radii thick."""
    ball = ball_on(radii * CONTACT_MM, size)
    shifts, sticks, shear = [], [], None
    for k in range(1, loads + 1):
        shear = ball.step(shear, 0.95 * ball.forms.slide_mm / loads)
        t = shear.force_n[0, 0].item() / ball.forms.limit_n
        shift = 0.95 * ball.forms.slide_mm * k / loads
        shifts.append(100 * (shift / ball.forms.shift_mm(t) - 1))
        sticks.append(100 * (ball.stick_radius(shear) / (1 - t) ** (1 / 3) - 1))
    note = f"layer {radii:g} contact radii thick, {loads} loads; limit 5 %"
    resolved = "; the last load, with few elements that stick, is left out"
    return [
        Figure(
            f"mindlin_shift_error_percent_{radii:g}_radii",
            "Shift against Mindlin, worst",
            max(shifts, key=abs),
            "%",
            note,
        ),
        Figure(
            f"mindlin_stick_radius_error_percent_{radii:g}_radii",
            "Stick radius against Cattaneo, worst",
            max(sticks[:-1], key=abs),
            "%",
            note + resolved,
        ),
    ]


def cycle() -> list[Figure]:
    """Loss of a full cycle, and the shift that is left half way back, at three quarters of sliding.

    The loss is the heat of the steps. The residue is where the force passes zero.
    """
    ball = ball_on(100 * CONTACT_MM, size=41)
    forms = ball.forms
    end = forms.shift_mm(0.75)
    shear, shift = ball.step(None, end), end
    t = shear.force_n[0, 0].item() / forms.limit_n
    step, heat, residue = 2 * end / HALF_CYCLE, 0.0, 0.0
    for k in range(2 * HALF_CYCLE):
        by = -step if k < HALF_CYCLE else step
        before, shear = shear.force_n[0, 0].item(), ball.step(shear, by)
        shift += by
        heat += shear.dissipated_mj.item()
        after = shear.force_n[0, 0].item()
        if k < HALF_CYCLE and before > 0 >= after:
            residue = shift - by * after / (after - before)
    note = f"between ±{t:.3f} of sliding, {2 * HALF_CYCLE} steps"
    return [
        Figure(
            "mindlin_cycle_loss_error_percent",
            "Loss of a cycle against Mindlin and Deresiewicz",
            100 * (heat / forms.loss_mj(t) - 1),
            "%",
            f"{note}: {heat:.4g} mJ",
        ),
        Figure(
            "mindlin_residue_error_percent",
            "Shear: shift left without load",
            100 * (residue / forms.residue_mm(t) - 1),
            "%",
            f"{note}: {1e3 * residue:.3g} of {1e3 * end:.3g} µm",
        ),
        Figure(
            "mindlin_closing_error_percent",
            "Shear: force after a cycle, of the limit",
            100 * (shear.force_n[0, 0].item() / forms.limit_n - t),
            "%",
            f"{note}; 0 in theory",
        ),
    ]


def stuck_layer() -> list[Figure]:
    """A wide flat punch that sticks to a thin layer: in the middle, pure shear G shift / h."""
    material = GelMaterial(thickness_mm=1.0, young_mpa=0.4, poisson=POISSON)
    size, pitch, shift = 61, 0.25, 0.01
    pressed = (_radius_mm(size, pitch) <= 7.0).double()[None] * 100.0
    layer = ShearLayer(_square(material, size, pitch), friction=10.0)
    shear = layer.step(None, pressed, torch.tensor([[shift, 0.0, 0.0]]), tol=1e-5)
    middle = shear.traction_kpa[0, 0, size // 2, size // 2].item()
    expected = 1e3 * material.young_mpa / (2 * (1 + POISSON)) * shift / material.thickness_mm
    return [
        Figure(
            "stuck_layer_error_percent",
            "Traction of a stuck layer against G/h",
            100 * (middle / expected - 1),
            "%",
            "punch 14 thicknesses wide; limit 2 %",
        )
    ]


def twist() -> list[Figure]:
    """Moment of a ball that is turned until all of it slides: 3 pi mu P a / 16."""
    ball = ball_on(100 * CONTACT_MM, size=41)
    motion = torch.tensor([[0.0, 0.0, 5.0]], dtype=torch.float64)
    shear = ball.layer.step(None, ball.press.pressure_kpa, motion, tol=1e-5)
    expected = 3 * math.pi / 16 * ball.forms.limit_n * ball.radius_mm
    return [
        Figure(
            "sliding_twist_error_percent",
            "Moment of a sliding twist",
            100 * (shear.moment_nmm.item() / expected - 1),
            "%",
            "Hertz's pressure",
        )
    ]


def coupling(ball_mm: float, force_n: float) -> list[Figure]:
    """What the coupling of pressure and traction changes on a GelSight Mini's gel.

    A ball is pressed in five steps, then moved sideways. Without coupling, with the displacement
    that pressure causes along the surface, and with the pressure solved again under the traction.
    """
    size, pitch = 61, 0.2
    gel = _square(gel_of("gelsight_mini"), size, pitch)
    gap = (_radius_mm(size, pitch) ** 2 / (2 * ball_mm))[None]
    plain = _pressed_and_moved(gel, gap, force_n, coupled=False, rounds=1)
    one_way = _pressed_and_moved(gel, gap, force_n, coupled=True, rounds=1)
    both = _pressed_and_moved(gel, gap, force_n, coupled=True, rounds=3)
    sideways = plain.force_n[0, 0].item()
    key = f"coupling_{ball_mm:g}mm"
    note = f"nu 0.47, ball R {ball_mm:g} mm, {force_n:g} N, at {sideways:.3f} N sideways"
    figures = []
    for way, name, other in (
        ("one_way", "pressure drags", one_way),
        ("both", "both ways", both),
    ):
        force = 100 * (other.force_n[0, 0].item() / sideways - 1)
        stick = 100 * (other.stick_fraction - plain.stick_fraction).item()
        what = f"Coupling, {name}"
        figures += [
            Figure(f"{key}_{way}_force_percent", f"{what}: force", force, "%", note),
            Figure(f"{key}_{way}_stick_percent", f"{what}: stick fraction", stick, "%", note),
        ]
    sunk = 1e3 * ShearLayer(gel, friction=FRICTION).sink_mm(plain).abs().max().item()
    return [*figures, Figure(f"{key}_rise_um", "Coupling: rise by traction", sunk, "µm", note)]


def _pressed_and_moved(
    gel: ElasticLayer, gap: Tensor, force_n: float, *, coupled: bool, rounds: int
) -> Shear:
    """A ball pressed in five steps and moved by 0.15 mm in five; pressure solved in ``rounds``."""
    layer = ShearLayer(gel, friction=FRICTION, coupled=coupled)
    shear = layer.at_rest()
    for k in range(1, 11):
        motion = torch.tensor([[0.03 if k > 5 else 0.0, 0.0, 0.0]], dtype=torch.float64)
        after = shear
        for _ in range(rounds):
            lifted = gap + layer.sink_mm(after) if rounds > 1 else gap
            press = gel.press_to_force(lifted - lifted.min(), force_n * min(1.0, 0.2 * k))
            after = layer.step(shear, press.pressure_kpa, motion)
        shear = after
    return shear


@torch_threads()
def mechanics() -> list[Figure]:
    """All figures of friction but those of the form for the closed loop."""
    thick = cattaneo_mindlin(100) + cattaneo_mindlin(10)
    return thick + cycle() + stuck_layer() + twist() + coupling(7.5, 1.0) + coupling(40.0, 3.0)
