"""The contact of a D_t reads back to the state that it was worded from."""

from dataclasses import replace

import pytest

from cltp.tactile.states import CLASSES, NO_CONTACT_STATE
from policies.llm.reading import SaidContact, read_contact
from policies.llm.text import NOTHING, contact_text, said_numbers
from tests.fakes.question_scenes import contact, random_states


def test_every_contact_reads_back() -> None:
    for state in random_states(200):
        said = read_contact(contact_text(state) + " Goal 0.42 - 0.51 N. Action: <none>.")
        assert said is not None
        assert said.words == {name: (getattr(state, name).value,) for name in CLASSES}
        assert said.cut == state.cut
        assert said.numbers["depth_mm"][0] == pytest.approx(state.depth_mm, abs=0.006)
        assert said.numbers["x_mm"][0] == pytest.approx(state.x_mm, abs=0.06)
        assert said.numbers["area_fraction"][1] == pytest.approx(state.area_fraction, abs=0.006)
        assert not said.is_doubtful


def test_rivals_and_intervals_are_doubt() -> None:
    state = contact()
    rivals = {"shape": "sphere", "texture": "rough", "depth": "moderate", "area": "large"}
    said = read_contact(contact_text(state, rivals=rivals))
    assert said is not None and said.is_doubtful
    assert said.words["texture"] == ("smooth", "rough")
    assert said.words["shape"] == ("ellipsoid", "sphere")
    ends = said_numbers(state, {"depth_mm": (0.12, 0.31)})
    said = read_contact(contact_text(state, ends))
    assert said is not None and said.is_doubtful
    assert said.numbers["depth_mm"] == (0.12, 0.31)


@pytest.mark.parametrize("without", [("shape",), ("texture",), ("shape", "texture")])
def test_unknown_shapes_and_textures_are_left_out(without: tuple[str, ...]) -> None:
    state = replace(contact(), **dict.fromkeys(without))
    said = read_contact(contact_text(state))
    assert said is not None
    assert set(said.words) == set(CLASSES) - set(without)


def test_no_contact_says_nothing_and_other_texts_are_none() -> None:
    assert read_contact(contact_text(NO_CONTACT_STATE)) == SaidContact()
    assert read_contact(f"{NOTHING} Goal 0.42 - 0.51 N.") == SaidContact()
    assert read_contact("Move left: it is off center.") is None
    assert read_contact("smooth sphere, deep 0.70 mm. Goal 0.95 - 1.90 N.") is None
