import math

import pytest
import torch

from cltp.encoder.encoder import PRESETS, TactileEncoder
from cltp.encoder.heads import StateHeads, transformed
from cltp.encoder.heads_output import HeadsOutput
from cltp.encoder.readings import HeadReadings, readings_of
from cltp.llm.causal_lm import Language, small_lm
from cltp.llm.reading_tokens import LAST_DIGIT, NUM_READINGS, ReadingTokens
from cltp.llm.tac3d_llm import Projector, Tac3dLlm
from cltp.tactile.states import CLASSES, NUMBERS
from cltp.texts.tokenizer import Words

SPOKEN = torch.tensor([[0.47, -3.2, 1.9, 0.123, 1.58]])
"""Depth [mm], x [mm], y [mm], share, force [N]: whole last digits."""


def read(numbers: torch.Tensor, margin: float = 0.1) -> HeadReadings:
    batch = len(numbers)
    return readings_of(
        HeadsOutput(
            tuple(torch.zeros(batch, len(names)) for names in CLASSES.values()),
            transformed(numbers),
            torch.zeros(batch),
            torch.zeros(batch, 4),
            torch.full((batch, len(NUMBERS), 2), margin),
        )
    )


def test_every_number_is_a_token_beside_one_of_the_words() -> None:
    assert ReadingTokens(12)(read(SPOKEN)).shape == (1, NUM_READINGS, 12)
    assert list(LAST_DIGIT) == list(NUMBERS)


def test_phases_turn_once_in_ten_last_digits() -> None:
    features = ReadingTokens(12).features(read(SPOKEN))[0]
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


def test_the_end_of_an_interval_changes_its_number_alone() -> None:
    tokens = ReadingTokens(12)
    narrow = read(SPOKEN)
    high = narrow.high.clone()
    high[0, 4] += 0.3
    changed = (tokens(narrow) - tokens(narrow._replace(high=high))).abs().amax(dim=(0, 2)) > 1e-6
    assert changed.tolist() == [False] * 5 + [True]


def test_readings_that_are_left_out_tell_nothing() -> None:
    tokens = ReadingTokens(12)
    torch.nn.init.normal_(tokens.left_out)
    given = torch.tensor([[True, False, True, True, True, True]])
    other = SPOKEN.clone()
    other[0, 0] = 0.11
    torch.testing.assert_close(tokens(read(SPOKEN), given), tokens(read(other), given))
    assert not torch.allclose(tokens(read(SPOKEN), given)[:, 1], tokens(read(SPOKEN))[:, 1])


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
        read_as = model.heads(encoded.pooled)
        nominal, scaled, batch = (
            model.projected(encoded, readings_of(read_as, factor))
            for factor in (1.0, 1.7, torch.tensor([1.0, 1.7]))
        )
    changed = (nominal - scaled).abs().amax(dim=(0, 2)) > 1e-6
    assert changed.tolist() == [False] * (model.num_touch - 1) + [True]
    torch.testing.assert_close(batch[0], nominal[0])
    torch.testing.assert_close(batch[1], scaled[1])
