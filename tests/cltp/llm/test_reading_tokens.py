import math

import pytest
import torch

from cltp.encoder.encoder import PRESETS, TactileEncoder
from cltp.encoder.heads import HeadsOutput, StateHeads, transformed, with_read_numbers
from cltp.llm.causal_lm import Language, small_lm
from cltp.llm.reading_tokens import LAST_DIGIT, NUM_READINGS, ReadingTokens
from cltp.llm.tac3d_llm import Projector, Tac3dLlm
from cltp.tactile.states import CLASSES, NUMBERS, Area, ContactState, Depth, Position, Shape
from cltp.texts.tokenizer import Words

SPOKEN = torch.tensor([[0.47, -3.2, 1.9, 0.123, 1.58]])
"""Depth [mm], x [mm], y [mm], share, force [N]: whole last digits."""


def read(numbers: torch.Tensor) -> HeadsOutput:
    batch = len(numbers)
    return HeadsOutput(
        tuple(torch.zeros(batch, len(names)) for names in CLASSES.values()),
        transformed(numbers),
        torch.zeros(batch),
        torch.zeros(batch, 4),
    )


def test_every_number_is_a_token_beside_one_of_the_words() -> None:
    assert ReadingTokens(12)(read(SPOKEN)).shape == (1, NUM_READINGS, 12)
    assert list(LAST_DIGIT) == list(NUMBERS)


def test_phases_turn_once_in_ten_last_digits() -> None:
    features = ReadingTokens(12).features(read(SPOKEN).numbers)[0]
    for row, (name, value) in enumerate(zip(NUMBERS, SPOKEN[0].tolist(), strict=True)):
        turns = value / LAST_DIGIT[name] / 10
        sine, cosine = features[row, 1], features[row, 5]
        assert sine == pytest.approx(math.sin(2 * math.pi * turns), abs=2e-3)
        assert cosine == pytest.approx(math.cos(2 * math.pi * turns), abs=2e-3)


def test_a_number_changes_its_own_token_alone() -> None:
    tokens = ReadingTokens(12)
    other = SPOKEN.clone()
    other[0, 1] = 4.4
    changed = (tokens(read(SPOKEN)) - tokens(read(other))).abs().amax(dim=(0, 2)) > 1e-6
    assert changed.tolist() == [False, False, True, False, False, False]


def test_what_the_heads_read_reaches_the_language_model() -> None:
    torch.manual_seed(0)
    words = Words.train(["a few words"] * 3, size=300)
    encoder = TactileEncoder(PRESETS["tiny"])
    heads = StateHeads(2 * encoder.config.dim)
    language = Language(small_lm(words, dim=48, layers=1), words=words)
    model = Tac3dLlm(encoder, heads, Projector(48, 48), language)
    points = torch.rand(2, 1024, 3)
    before = model.touch(points)
    assert before.shape == (2, model.num_touch, 48)
    with torch.no_grad():
        heads.out.bias += 1.0
    after = model.touch(points)
    torch.testing.assert_close(before[:, :-NUM_READINGS], after[:, :-NUM_READINGS])
    assert not torch.allclose(before[:, -NUM_READINGS:], after[:, -NUM_READINGS:])


def test_felt_states_keep_their_words_and_take_the_numbers_that_were_read() -> None:
    true = ContactState(
        depth_mm=0.5, x_mm=0.0, y_mm=0.0, area_fraction=0.1, force_n=1.0, depth=Depth.MODERATE,
        position=Position.CENTERED, area=Area.MEDIUM, shape=Shape.SPHERE,
    )  # fmt: skip
    nothing = ContactState(
        depth_mm=0.0, x_mm=0.0, y_mm=0.0, area_fraction=0.0, force_n=0.0, depth=None, position=None,
        area=None,
    )  # fmt: skip
    reading, unread = with_read_numbers([true, nothing], transformed(SPOKEN.expand(2, -1)))
    for slot in ("depth", "position", "shape"):
        assert getattr(reading, slot) == getattr(true, slot)
    read = [getattr(reading, name) for name in NUMBERS]
    assert read == pytest.approx(SPOKEN[0].tolist(), rel=1e-4)
    assert unread == nothing


def test_no_felt_depth_is_negative_and_no_area_above_the_field() -> None:
    true = ContactState(
        depth_mm=0.5, x_mm=0.0, y_mm=0.0, area_fraction=0.1, force_n=1.0, depth=Depth.MODERATE,
        position=Position.CENTERED, area=Area.MEDIUM,
    )  # fmt: skip
    (reading,) = with_read_numbers([true], torch.tensor([[-0.2, 0.0, 0.0, 9.0, -1.0]]))
    assert (reading.depth_mm, reading.area_fraction, reading.force_n) == (0.0, 1.0, 0.0)


def test_the_factor_of_a_unit_changes_the_token_of_the_force_alone() -> None:
    torch.manual_seed(0)
    words = Words.train(["a few words"] * 3, size=300)
    encoder = TactileEncoder(PRESETS["tiny"])
    heads = StateHeads(2 * encoder.config.dim)
    with torch.no_grad():
        heads.out.bias += 1.0  # a force above 0
    language = Language(small_lm(words, dim=48, layers=1), words=words)
    model = Tac3dLlm(encoder, heads, Projector(48, 48), language)
    with torch.no_grad():
        encoded = model.encoder(torch.rand(2, 1024, 3))
        nominal, scaled = (model.projected(encoded, factor) for factor in (1.0, 1.7))
        batch = model.projected(encoded, torch.tensor([1.0, 1.7]))
    changed = (nominal - scaled).abs().amax(dim=(0, 2)) > 1e-6
    assert changed.tolist() == [False] * (model.num_touch - 1) + [True]
    torch.testing.assert_close(batch[0], nominal[0])
    torch.testing.assert_close(batch[1], scaled[1])
