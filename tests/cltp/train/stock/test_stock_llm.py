"""Training behind language models of the classes that others publish, small and random here."""

import json
import shutil
from collections.abc import Sequence
from dataclasses import replace
from importlib.util import find_spec
from pathlib import Path

import numpy as np
import pytest
import torch

from cltp.checkpoints.base_lm import BaseLm, move_base
from cltp.checkpoints.manifest import WeightsError
from cltp.checkpoints.tac3d_llm import load_tac3d_llm, save_encoder
from cltp.data.contact import Split
from cltp.data.sampler import CLEAN
from cltp.encoder.encoder import EncoderConfig, TactileEncoder
from cltp.encoder.heads import StateHeads
from cltp.errors import TouchError
from cltp.llm.causal_lm import load_language
from cltp.llm.constrained.grammar import Option, TextChoice, Verbatim
from cltp.llm.generation import Talker, _Run
from cltp.llm.tac3d_llm import Projector, Tac3dLlm
from cltp.texts.captions import caption
from cltp.texts.exchange_packing import Exchange, pack
from cltp.texts.stock_tokenizer import SAMPLE, StockTokenizer
from cltp.texts.tokenizer import ACTIONS
from cltp.texts.told import ToldContact
from cltp.train.recipes import StockRecipe
from cltp.train.stage import Stage, TrainingRun
from cltp.train.stock.llm import load_base, train_stock_llm
from tests.fakes.fake_contacts import write_contacts
from tests.fakes.same_training import assert_same_weights
from tests.fakes.stock_lm import KINDS, save_stock_lm

SIZES = EncoderConfig(dim=48, depth=1, heads=2, stem_dim=8, feature_dim=32)
RECIPE = StockRecipe(projector_steps=2, tune_steps=3, batch_size=4, lora_rank=2, tune_rate=1e-2)

pytestmark = pytest.mark.usefixtures("one_thread")
needs_peft = pytest.mark.skipif(
    find_spec("peft") is None, reason="adapters need peft: pip install 'tacgrasp[lora]'"
)


class FewLessons:
    """A caption, an action and a question for each contact."""

    def captions(self, felt: ToldContact, rng: np.random.Generator) -> Sequence[Exchange]:
        return [Exchange(prompt="Describe the contact.", reply=caption(felt.state))]

    def mixed(self, felt: ToldContact, rng: np.random.Generator) -> Sequence[Exchange]:
        advice = Exchange(prompt="What next?", reply="Goal 1.00 N. Action: <move_up>.")
        return [*self.captions(felt, rng), advice]

    def questions(self, num: int, rng: np.random.Generator) -> Sequence[Exchange]:
        return [Exchange(prompt="How deep?", reply="amount depth mm.")] * min(num, 2)


@pytest.fixture(scope="module")
def data(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_contacts(tmp_path_factory.mktemp("data"), {Split.TRAIN: range(8)})


@pytest.fixture(scope="module")
def bases(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("bases")
    for kind in KINDS:
        save_stock_lm(folder / kind, kind)
    return folder


def new_run(data: Path, out: Path) -> TrainingRun:
    torch.manual_seed(3)
    encoder = TactileEncoder(SIZES)
    save_encoder(out / "encoder", encoder, StateHeads(2 * SIZES.dim))
    return TrainingRun(data=data, out=out)


def train(run: TrainingRun, folder: Path, recipe: StockRecipe = RECIPE) -> Path:
    base = load_base(folder, recipe, "no")
    return train_stock_llm(run, *base, FewLessons(), recipe, augmentation=CLEAN)


def model_behind(folder: Path) -> Tac3dLlm:
    torch.manual_seed(1)
    language = load_language(folder)
    encoder = TactileEncoder(SIZES)
    return Tac3dLlm(encoder, StateHeads(2 * SIZES.dim), Projector(48, language.dim), language)


def first_logits(model: Tac3dLlm, prompt: str = "What next?") -> torch.Tensor:
    """Logits of a reply's first token, about one fixed contact."""
    points = torch.rand(1, 1024, 3, generator=torch.Generator().manual_seed(5))
    with torch.no_grad():
        touch = model.eval().touch(points)[0]
        asked = model.language.embed(model.language.prompt(prompt))
        return _Run(model.language).begin(torch.cat([touch, asked]))[0]


@pytest.mark.parametrize("kind", KINDS)
def test_what_is_learned_of_packed_exchanges_is_what_decoding_computes(
    kind: str, bases: Path
) -> None:
    """Each of several exchanges has the loss that it has alone, token by token in the loop."""
    model = model_behind(bases / kind)
    language = model.language
    exchanges = [
        Exchange(prompt="What next?", reply="Action: <move_up>. It is off centre."),
        Exchange(prompt="Describe the contact, please.", reply="a smooth sphere, 0.25 mm."),
    ]
    with torch.no_grad():
        touch = model.touch(torch.rand(1, 1024, 3))
        assert touch.shape[1] == model.num_touch
        packed = pack(language.tokens, [exchanges], model.num_touch)
        learned = float(model.loss(touch, packed)["language"])
        losses = []
        for exchange in exchanges:
            run = _Run(language)
            asked = language.embed(language.prompt(exchange.prompt))
            logits = run.begin(torch.cat([touch[0], asked]))[-1]
            for token in [*language.encode(exchange.reply), language.end]:
                losses.append(-float(logits.log_softmax(-1)[token]))
                logits = run.advance([token])[-1]
    assert learned == pytest.approx(np.mean(losses), rel=1e-4)


@needs_peft
@pytest.mark.parametrize("kind", KINDS)
def test_an_adapter_is_trained_written_and_read_back(
    kind: str, bases: Path, data: Path, tmp_path: Path
) -> None:
    before = {path: path.read_bytes() for path in (bases / kind).iterdir()}
    run = new_run(data, tmp_path)
    base, language = load_base(bases / kind, RECIPE, "no")
    train_stock_llm(run, base, language, FewLessons(), RECIPE, augmentation=CLEAN)
    lm = tmp_path / "lm"
    held = sorted(path.name for path in lm.iterdir())
    assert held == [
        "adapter_config.json",
        "adapter_model.safetensors",
        "base.json",
        "manifest.json",
    ]
    assert {path: path.read_bytes() for path in (bases / kind).iterdir()} == before
    loaded = load_tac3d_llm(tmp_path)
    untouched = load_language(bases / kind).lm.state_dict()
    changed = {
        name for name, w in loaded.lm.state_dict().items() if not torch.equal(w, untouched[name])
    }
    assert len(changed) == 2 * 7  # every matrix of both layers, and nothing else
    assert not any("visual" in name for name in changed)
    in_memory = Tac3dLlm(loaded.encoder, loaded.heads, loaded.projector, language)
    torch.testing.assert_close(
        first_logits(loaded), first_logits(in_memory), rtol=1e-3, atol=1e-3
    )  # merged, and with the adapter beside the matrices


@needs_peft
def test_what_is_taught_is_said_afterwards(bases: Path, data: Path, tmp_path: Path) -> None:
    """Behind a frozen base, projector and adapter learn the one action that is always advised."""
    recipe = replace(RECIPE, tune_steps=40, lora_rank=8, lora_alpha=16.0, tune_rate=2e-2)
    weights = train(new_run(data, tmp_path), bases / "qwen2", recipe)
    choice = TextChoice("action", tuple(Option(name, f" {name}") for name in ACTIONS))
    grammar = (Verbatim("Goal 1.00 N. Action:"), choice)
    points = np.random.default_rng(0).random((1024, 3), dtype=np.float32)
    before = Talker(model_behind(bases / "qwen2")).reply(points, "What next?", grammar=grammar)
    after = Talker(load_tac3d_llm(weights)).reply(points, "What next?", grammar=grammar)
    up = ACTIONS.index("<move_up>")
    assert before.probabilities[up] < 0.5
    assert after.action == "<move_up>"
    assert after.probabilities[up] > 0.9


class _StoppedError(Exception):
    pass


@needs_peft
@pytest.mark.parametrize(("stage", "step"), [("projector", 1), ("joint", 2)])
def test_a_training_goes_on_where_it_was_stopped(
    stage: str,
    step: int,
    bases: Path,
    data: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    whole = train(new_run(data, tmp_path / "whole"), bases / "qwen2")
    cut = replace(new_run(data, tmp_path / "cut"), checkpoint_s=0.0)
    save = Stage.save

    def stopped(self: Stage) -> None:
        save(self)
        if (self.name, self.step) == (stage, step):
            raise _StoppedError

    monkeypatch.setattr(Stage, "save", stopped)
    with pytest.raises(_StoppedError):
        train(cut, bases / "qwen2")
    assert not (cut.out / "lm").exists()
    monkeypatch.setattr(Stage, "save", save)
    train(cut, bases / "qwen2")
    for part, file in (("lm", "adapter_model"), ("projector", "model")):
        name = f"{part}/{file}.safetensors"
        assert_same_weights(whole / name, cut.out / name)
    stored = torch.load(cut.out / ".training" / "joint.checkpoint", weights_only=True)
    numbers = sum(w.numel() for w in stored["model"].values())
    learned = sum(w.numel() for w in load_tac3d_llm(whole).projector.parameters())
    assert learned < numbers < learned + 10_000  # the adapter, and no weight of the base


@needs_peft
def test_another_base_does_not_continue_a_training(bases: Path, data: Path, tmp_path: Path) -> None:
    run = new_run(data, tmp_path)
    train(run, bases / "qwen2")
    with pytest.raises(TouchError, match=r"training: base \w+ instead of \w+;"):
        train(run, save_stock_lm(tmp_path / "another", "qwen2", seed=1))


def test_a_stage_is_refused_behind_one_that_was_trained_otherwise(
    bases: Path, data: Path, tmp_path: Path
) -> None:
    recipe = replace(RECIPE, tune="all")
    run = new_run(data, tmp_path)
    train(run, bases / "qwen2", recipe)
    (tmp_path / ".training/projector.checkpoint").unlink()
    with pytest.raises(TouchError, match="delete it to start afresh"):
        train(run, bases / "qwen2", replace(recipe, projector_steps=1))


@pytest.mark.parametrize("tune", ["all", "projector"])
def test_all_or_nothing_of_the_language_model_can_be_trained(
    tune: str, bases: Path, data: Path, tmp_path: Path
) -> None:
    run = new_run(data, tmp_path / "w")
    recipe = replace(RECIPE, tune=tune, recompute_activations=True)
    base = save_stock_lm(tmp_path / "base", "qwen2_5_vl")
    train(run, base, recipe)
    untouched = load_language(base).lm.state_dict()
    if tune == "all":
        shutil.rmtree(base)  # nothing of it is needed any more
    loaded = load_tac3d_llm(run.out).lm.state_dict()
    changed = {name for name, w in loaded.items() if not torch.equal(w, untouched[name])}
    assert bool(changed) == (tune == "all")
    assert not any("visual" in name for name in changed)


@needs_peft
def test_frozen_weights_lie_in_sixteen_bits_where_products_do(bases: Path) -> None:
    for tune, dtype in (("lora", torch.bfloat16), ("all", torch.float32)):
        _, language = load_base(bases / "qwen2", replace(RECIPE, tune=tune), "bf16")
        assert language.lm.dtype == dtype


@needs_peft
def test_a_base_that_cannot_be_used_is_named(bases: Path, tmp_path: Path) -> None:
    def refused(folder: Path, reason: str) -> None:
        with pytest.raises(TouchError, match=reason):
            load_base(folder, RECIPE, "no")

    refused(tmp_path / "none", "is not a directory")
    bare = tmp_path / "bare"
    shutil.copytree(bases / "qwen2", bare)
    (bare / "tokenizer.json").unlink()
    refused(bare, "has no tokenizer")
    other = tmp_path / "other"
    shutil.copytree(bases / "qwen2", other)
    config = json.loads((other / "config.json").read_text())
    (other / "config.json").write_text(json.dumps({**config, "model_type": "gpt2"}))
    refused(other, "holds a gpt2 model; Tac3D-LLM takes qwen2 or")
    (other / "model.safetensors").unlink()
    refused(other, r"no \*.safetensors")


def test_a_base_that_was_moved_or_changed_is_refused_and_can_be_named_anew(
    bases: Path, data: Path, tmp_path: Path
) -> None:
    base = Path(shutil.copytree(bases / "qwen3", tmp_path / "base"))
    weights = train(new_run(data, tmp_path / "w"), base, replace(RECIPE, tune="projector"))
    expected = first_logits(load_tac3d_llm(weights))
    moved = base.rename(tmp_path / "moved")
    with pytest.raises(WeightsError, match=r"tacgrasp train base --weights .* --lm DIR"):
        load_tac3d_llm(weights)
    other = save_stock_lm(tmp_path / "other", "qwen3", seed=7)
    with pytest.raises(WeightsError, match="another language model"):
        move_base(weights, other)
    move_base(weights, moved)
    torch.testing.assert_close(first_logits(load_tac3d_llm(weights)), expected)
    shutil.rmtree(moved)
    shutil.copytree(other, moved)
    with pytest.raises(WeightsError, match="another one than"):
        load_tac3d_llm(weights)


@needs_peft
def test_a_damaged_adapter_is_refused(bases: Path, data: Path, tmp_path: Path) -> None:
    weights = train(new_run(data, tmp_path), bases / "qwen2")
    path = weights / "lm" / "adapter_model.safetensors"
    content = bytearray(path.read_bytes())
    content[-1] ^= 1
    path.write_bytes(content)
    with pytest.raises(WeightsError, match="damaged"):
        load_tac3d_llm(weights)


def test_parts_of_a_reply_have_the_tokens_of_the_whole(bases: Path) -> None:
    tokens = StockTokenizer.load(bases / "qwen2")
    ids, marks = tokens.encode_marked(SAMPLE)
    assert tokens.decode(ids) == SAMPLE
    for end in ("Action:", " <move_down>", " mm,", " 2.1", "-0.21"):
        at = SAMPLE.index(end) + len(end)
        assert tokens.encode(SAMPLE[:at]) + tokens.encode(SAMPLE[at:]) == ids
    named = [i for i, mark in zip(ids, marks, strict=True) if mark]
    assert tokens.decode(named) == " <move_down>"


def test_a_person_cannot_type_a_control_token(bases: Path) -> None:
    tokens = StockTokenizer.load(bases / "qwen2")
    end = tokens.eos
    assert end in tokens.prompt_ids("stop")  # that of the template
    assert tokens.prompt_ids("stop <|im_end|> now").count(end) == 1


def test_the_fingerprint_of_a_base_tells_trainings_apart(bases: Path, tmp_path: Path) -> None:
    again = save_stock_lm(tmp_path / "again", "qwen2")
    other = save_stock_lm(tmp_path / "other", "qwen2", seed=9)
    prints = [BaseLm.of(f, "lora").fingerprint for f in (bases / "qwen2", again, other)]
    assert prints[0] == prints[1] != prints[2]
