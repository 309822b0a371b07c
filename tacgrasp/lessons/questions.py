"""Questions about a contact and their answers, in wordings for training and others for tests."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from cltp.tactile.states import ContactState
from cltp.texts.exchange_packing import Exchange

CAPTION_REQUESTS: tuple[str, ...] = (
    "Describe the contact.",
    "What do you feel?",
    "Describe what touches the pad.",
    "Tell me about the contact.",
    "What is touching the sensor?",
    "Give a description of this touch.",
    "What can you feel?",
    "What is the contact like?",
    "Say what you feel.",
    "Describe this.",
)

QUESTIONS: dict[str, tuple[str, ...]] = {
    "depth": (
        "How deep is it pressed?",
        "What is the depth of the contact?",
        "How far is the gel pressed in?",
        "How deep is the contact?",
        "What is the indentation?",
        "How deeply is the pad pressed?",
        "How many millimetres deep is it?",
        "What depth does it reach?",
        "Is it pressed deeply or lightly?",
        "How far does it go into the gel?",
        "Give me the depth.",
        "How far has it sunk in?",
    ),
    "position": (
        "Where is the contact?",
        "Where does it touch the pad?",
        "In which part of the pad is it?",
        "What is the position of the contact?",
        "Where do you feel it?",
        "Whereabouts is it touching?",
        "At which place on the pad is the contact?",
        "Where is it?",
        "Is it in the middle or off centre?",
        "Which part of the sensor is touched?",
        "Give me the position.",
        "Where does the thing lie?",
    ),
    "area": (
        "How large is the contact?",
        "What is the contact area?",
        "How much of the pad is covered?",
        "How big is the area that touches?",
        "What area does it cover?",
        "Is the contact large or small?",
        "How many percent of the pad is in contact?",
        "How large a patch do you feel?",
        "How much of the gel does it touch?",
        "Give me the area.",
        "What is the size of the contact patch?",
        "How wide is the contact?",
    ),
    "shape": (
        "What shape is it?",
        "What is the shape of the object?",
        "Which shape do you feel?",
        "What does it look like?",
        "What form does the object have?",
        "Which form do you feel?",
        "What kind of object is it?",
        "Is it round, flat or pointed?",
        "Tell me its shape.",
        "What geometry is pressed in?",
        "What sort of thing is it?",
        "Which shape does the contact have?",
    ),
    "texture": (
        "What is its texture?",
        "How does its surface feel?",
        "What texture does the object have?",
        "Is it smooth or rough?",
        "What is the surface like?",
        "What kind of surface is it?",
        "Tell me its texture.",
        "How does it feel?",
        "Is its surface even or bumpy?",
        "Which texture do you feel?",
        "Describe the surface.",
        "What is the object's surface like to the touch?",
    ),
    "force": (
        "How hard is it pressed?",
        "What is the force?",
        "How many newtons is it?",
        "How strong is the grip?",
        "What force do you feel?",
        "How large is the force?",
        "With what force is it held?",
        "How much does it press?",
        "Give me the force.",
        "Tell me the force in newtons.",
        "How firmly is it pressed?",
        "What is the normal force?",
    ),
    "cut": (
        "Is the contact cut off by the edge?",
        "Does it run over the edge of the pad?",
        "Is the whole contact on the pad?",
        "Does the edge cut the contact?",
        "Does the contact reach beyond the pad?",
        "Is any of it off the pad?",
        "Does part of the object lie outside the sensor?",
        "Is it wholly inside the pad?",
        "Is it cut off?",
        "Which sides cut the contact?",
    ),
}

HELD_OUT: dict[str, tuple[str, ...]] = {
    "depth": ("How deep does the object sink into the gel?", "Tell me the depth of this touch."),
    "position": ("On which part of the sensor is the object?", "Where on the pad is the touch?"),
    "area": ("How much area is in contact?", "How wide an area does the object touch?"),
    "shape": ("What kind of shape touches the pad?", "Name the shape of what you feel."),
    "texture": ("What does the surface of the object feel like?", "Name the texture."),
    "force": ("How much force is there?", "With how many newtons does it press?"),
    "cut": ("Is part of the contact over the edge?", "Is it cut by the edge of the pad?"),
}
"""Wordings that are never trained on; the evaluation asks them."""

NOTHING = "Nothing touches the pad."


def answer(slot: str, state: ContactState) -> str:
    """Answer a question about one slot of ``QUESTIONS``."""
    return NOTHING if not state.in_contact else _ANSWERS[slot](state)


def percent(state: ContactState) -> str:
    """Fraction of the sensing area in contact [%], to two figures or so."""
    value = 100 * state.area_fraction
    return f"{value:.1f}" if value < 9.95 else f"{value:.0f}"


def _cut(state: ContactState) -> str:
    return f"Cut {' '.join(sorted(state.cut))}." if state.cut else "Not cut."


_ANSWERS: dict[str, Callable[[ContactState], str]] = {
    "depth": lambda s: f"Pressed {s.depth}, {s.depth_mm:.2f} mm.",
    "position": lambda s: f"In {s.position}, x {s.x_mm:+.1f}, y {s.y_mm:+.1f}.",
    "area": lambda s: f"A {s.area} area, {percent(s)} %.",
    "shape": lambda s: f"A {s.shape}." if s.shape else "I can't tell.",
    "texture": lambda s: f"It is {s.texture}." if s.texture else "I can't tell.",
    "force": lambda s: f"About {s.force_n:.2f} N.",
    "cut": _cut,
}


def draw_question(state: ContactState, rng: np.random.Generator) -> Exchange:
    """Draw the wording of a question, and answer it."""
    slot = list(QUESTIONS)[rng.integers(len(QUESTIONS))]
    wording = QUESTIONS[slot][rng.integers(len(QUESTIONS[slot]))]
    return Exchange(prompt=wording, reply=answer(slot, state))
