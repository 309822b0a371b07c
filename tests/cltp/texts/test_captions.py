"""Captions in the paper's template and back."""

import dataclasses
import itertools

import pytest

from cltp import TouchError
from cltp.tactile.sensors import sensor_named
from cltp.tactile.states import (
    NO_CONTACT_STATE,
    Area,
    ContactState,
    Depth,
    Position,
    Shape,
    Texture,
)
from cltp.texts.captions import NO_CONTACT, Slots, caption, numeric_caption, parse_caption, slots_of


def state(
    depth: Depth = Depth.DEEP,
    position: Position = Position.BOTTOM_CENTER,
    area: Area = Area.SMALL,
    shape: Shape | None = None,
    texture: Texture | None = None,
) -> ContactState:
    return ContactState(
        depth_mm=0.75,
        x_mm=1.0,
        y_mm=-5.25,
        area_fraction=0.05,
        force_n=1.234,
        depth=depth,
        position=position,
        area=area,
        shape=shape,
        texture=texture,
    )


def test_the_template_is_the_papers_word_for_word():
    text = caption(state(shape=Shape.SPHERE, texture=Texture.SMOOTH))
    assert text == "a smooth sphere object, pressed deep in bottom-center with small contact area."


@pytest.mark.parametrize(
    ("shape", "texture", "start"),
    [
        (None, None, "an object, pressed"),
        (Shape.ELLIPSOID, None, "an ellipsoid object, pressed"),
        (Shape.EDGE, Texture.ROUGH, "a rough edge object, pressed"),
        (None, Texture.WOVEN, "a woven object, pressed"),
    ],
)
def test_unnamed_slots_are_left_out_and_the_article_fits(shape, texture, start):
    assert caption(state(shape=shape, texture=texture)).startswith(start)


def test_every_combination_of_words_reads_back_exactly():
    texts = set()
    for shape, texture in itertools.product([None, *Shape], [None, *Texture]):
        for depth, position, area in itertools.product(Depth, Position, Area):
            one = state(depth, position, area, shape, texture)
            assert parse_caption(caption(one)) == slots_of(one)
            texts.add(caption(one))
    assert len(texts) == 20 * 6 * 4 * 9 * 5


def test_no_contact_has_a_caption_that_reads_back():
    assert caption(NO_CONTACT_STATE) == NO_CONTACT
    assert numeric_caption(NO_CONTACT_STATE, sensor_named("gelsight_mini")) == NO_CONTACT
    assert parse_caption("No contact") == Slots()


def test_the_numeric_caption_gives_mm_mm2_and_newtons():
    # 5 % of 20.288 mm x 15.216 mm = 15.4 mm²
    text = numeric_caption(state(), sensor_named("gelsight_mini"))
    assert text == (
        "pressed 0.75 mm at x +1.0 mm, y -5.2 mm, with 15.4 mm² contact area and 1.23 N."
    )


@pytest.mark.parametrize(
    "text",
    ["", "a cat", "a smooth sphere object, pressed", "a smooth blob object, pressed deep in "
     "centered with small contact area.", caption(state()) + " and more", caption(state()) * 2],
)  # fmt: skip
def test_a_text_outside_the_template_is_refused_with_the_template(text):
    with pytest.raises(TouchError, match="expected 'a \\[texture\\]"):
        parse_caption(text)


def test_a_state_with_depth_but_no_position_is_refused():
    broken = dataclasses.replace(state(), position=None, area=None)
    with pytest.raises(TouchError, match="position"):
        caption(broken)
