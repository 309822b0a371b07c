"""Families that ask why after an answer, by what the answer was about.

Not here: why after advice, and after the question whether it is safe
(``tacgrasp.lessons.dialogue.families.grasps.advice``).
"""

from __future__ import annotations

from tacgrasp.lessons.dialogue.families.grasps.advice import WHY_LAST
from tacgrasp.lessons.dialogue.meaning import Why
from tacgrasp.lessons.dialogue.patterns.family import QuestionFamily


def _why_after(name: str, shows: tuple[str, ...], *before: str) -> QuestionFamily:
    return QuestionFamily(
        name=f"why_after_{name}",
        pattern=f"{{lead}} ({WHY_LAST}) {{tail}} [?]",
        build=lambda *_: Why(shows=shows),
        before=before,
    )


FAMILIES: tuple[QuestionFamily, ...] = (
    _why_after(
        "limit",
        ("force", "limit"),
        "Is the force above the limit?",
        "Are we over the limit?",
        "Is the limit exceeded?",
        "Is the force below the limit?",
        "Do we respect the limit?",
    ),
    _why_after(
        "slip",
        ("force", "holds"),
        "Will it slip at this weight?",
        "Will it fall at this weight?",
        "Will it slip at 30 g?",
        "Will a 50 g apple fall?",
        "Can the grip hold 100 grams?",
        "Does the grip hold 20 g?",
    ),
    _why_after(
        "shape",
        ("shape",),
        "Is it a sphere?",
        "Is it a ring?",
        "Is it a cylinder?",
        "What shape is it?",
        "Is it not a sphere?",
    ),
    _why_after(
        "texture",
        ("texture",),
        "Is the surface smooth?",
        "Is the surface rough?",
        "What texture does it have?",
        "Is it bumpy?",
    ),
    _why_after(
        "position",
        ("position",),
        "Is it centered?",
        "Where is it?",
        "Where is the contact?",
        "What is the position?",
    ),
    _why_after("cut", ("cut",), "Is it cut off?", "Is all of it on the pad?"),
    _why_after(
        "depth",
        ("depth",),
        "Is the depth above 0.3 mm?",
        "Is it deeper than 0.5 mm?",
        "Is it deeper than 200 microns?",
        "Is the depth below half a millimetre?",
        "Is the press deep?",
    ),
    _why_after(
        "felt",
        ("depth", "area", "force"),
        "How deep is it?",
        "What is the force?",
        "How hard is it held?",
        "How large is the contact?",
        "What is the contact area?",
        "Describe the contact.",
        "What is the force in grams?",
        "Is the force above 1 N?",
        "Is the force below 2 N?",
        "Is the area above 10 %?",
        "Is anything touching the pad?",
        "Is the pad empty?",
        "Do you feel anything?",
    ),
)
