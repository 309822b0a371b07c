"""Texts drawn for contacts, and the contacts that each text is true of."""

import dataclasses
from pathlib import Path

import numpy as np
import pytest
import torch
from tokenizers import Tokenizer, models, pre_tokenizers, trainers

from cltp.encoder.clip_towers import load_towers, small_clip, text_features
from cltp.errors import TouchError
from cltp.tactile.states import CLASSES, ContactState
from cltp.texts.captions import caption
from cltp.texts.paraphrases import prompts
from cltp.texts.tokenizer import Words
from cltp.train.clip import ClassDirections
from cltp.train.text_targets import UNNAMED, TextTargets, class_numbers, draw_texts, matches
from tests.fakes.fake_contacts import fake_contact

STATES = [fake_contact(seed).state for seed in range(12)]
EMPTY = ContactState(
    depth_mm=0, x_mm=0, y_mm=0, area_fraction=0, force_n=0, depth=None, position=None, area=None
)


def test_captions_name_every_dimension() -> None:
    targets = draw_texts(STATES, "caption", np.random.default_rng(0))
    assert targets.texts == [caption(state) for state in STATES]
    assert targets.named.all()


def test_mixed_texts_are_captions_and_prompts_of_the_named_dimension() -> None:
    targets = draw_texts(STATES * 4, "mixed", np.random.default_rng(0))
    for text, state, named in zip(targets.texts, STATES * 4, targets.named, strict=True):
        if named.all():
            assert text == caption(state)
            continue
        (slot,) = (slot for slot, is_named in zip(CLASSES, named, strict=True) if is_named)
        assert text in prompts(slot, str(getattr(state, slot)))
    assert 0.2 < targets.named.all(dim=1).float().mean() < 0.8


def test_a_prompt_fits_its_class_and_a_caption_its_twins() -> None:
    contacts = torch.tensor([[0, 1, 2, 3, 4], [0, 1, 2, 3, 4], [5, 1, 2, 3, 4]])
    whole, texture, shape = (
        torch.ones(5, dtype=torch.bool),
        torch.arange(5) == 1,
        [True] + [False] * 4,
    )
    named = torch.stack([whole, texture, torch.tensor(shape)])
    matching = matches(contacts, contacts, named)
    assert matching.tolist() == [[True, True, False], [True, True, False], [False, True, True]]


def test_without_contact_nothing_but_that_is_said() -> None:
    targets = draw_texts([EMPTY], "mixed", np.random.default_rng(0))
    assert targets.texts == ["no contact."]
    assert class_numbers([EMPTY]).tolist() == [[UNNAMED] * 5]
    unnamed = dataclasses.replace(STATES[0], shape=None)
    assert class_numbers([unnamed])[0, 0] == UNNAMED
    assert not matches(class_numbers([STATES[0]]), targets.classes, targets.named).any()


def test_unknown_kinds_are_refused() -> None:
    with pytest.raises(ValueError, match="caption, mixed"):
        draw_texts(STATES, "songs", np.random.default_rng(0))


def test_the_feature_of_a_text_knows_all_of_it_and_nothing_of_its_neighbours() -> None:
    torch.manual_seed(0)
    texts = ["Contact at top-left.", "Contact at top-right.", "Contact is deep."]
    words = Words.train(texts * 5, 400)
    clip = small_clip(words, dim=32, layers=1).eval()
    alone = torch.cat([text_features(clip, words, [text]) for text in texts])
    together = text_features(clip, words, [*texts, "a much longer text than all of the others"])
    torch.testing.assert_close(together[:3], alone, atol=1e-5, rtol=0)
    assert (alone[0] - alone[1]).abs().max() > 0.01  # the last word alone differs


def test_a_stock_checkpoint_brings_its_own_tokenizer(tmp_path: Path) -> None:
    texts = ["Contact at top-left.", "Contact is deep."]
    stock = Tokenizer(models.BPE(unk_token="?"))
    stock.pre_tokenizer = pre_tokenizers.Whitespace()
    ends = ["?", "<|startoftext|>", "<|endoftext|>"]
    stock.train_from_iterator(texts, trainers.BpeTrainer(vocab_size=200, special_tokens=ends))
    clip = small_clip(Words.train(texts * 5, 400), dim=32, layers=1)
    clip.save_pretrained(tmp_path)
    with pytest.raises(TouchError, match="no tokenizer"):
        load_towers(tmp_path)
    stock.save(str(tmp_path / "tokenizer.json"))
    towers = load_towers(tmp_path)
    assert (towers.words.bos, towers.words.eos) == (1, 2)
    assert towers.texts(texts).shape == (2, 32)
    other = Tokenizer(models.BPE(unk_token="?"))
    other.train_from_iterator(texts, trainers.BpeTrainer(vocab_size=200, special_tokens=["?"]))
    other.save(str(tmp_path / "tokenizer.json"))
    with pytest.raises(TouchError, match="lacks"):
        load_towers(tmp_path)


def test_texts_that_lie_at_their_meanings_are_read_back() -> None:
    torch.manual_seed(0)
    class_directions = ClassDirections(64)
    classes = torch.tensor([[3, UNNAMED, 1, UNNAMED, 2], [5, UNNAMED, 0, UNNAMED, 4]])
    named = torch.tensor([[False, False, True, False, False], [False, True, True, False, False]])
    texts = TextTargets(texts=["", ""], classes=classes, named=named)
    depth = class_directions.directions[2].detach()
    right, wrong = depth[[1, 0]] * 7.0, depth[[0, 1]]
    assert class_directions.loss(right, texts) < 0.01  # no shape is named, no texture labelled
    assert class_directions.loss(wrong, texts) > 5.0
    nothing = TextTargets(texts=["", ""], classes=classes, named=torch.zeros_like(named))
    assert class_directions.loss(wrong, nothing) == 0.0
