"""What is set after a training: which encoders and data sets get a force head."""

from dataclasses import replace

import numpy as np
import pytest
import torch

from cltp.checkpoints.manifest import WeightsError, check_manifest, write_manifest
from cltp.checkpoints.tac3d_llm import load_encoder, save_encoder
from cltp.data.contact import Split
from cltp.data.dataset_writer import DatasetWriter
from cltp.data.sampler import CLEAN
from cltp.encoder import force_head
from cltp.encoder.encoder import PRESETS, TactileEncoder
from cltp.encoder.force_head import ForceHead
from cltp.encoder.heads import StateHeads
from cltp.tactile.states import NO_CONTACT_STATE
from cltp.train import calibration
from cltp.train.calibration import even_weights, fit_force
from cltp.train.stage import TrainingRun
from tacgrasp.__main__ import main
from tests.fakes.fake_contacts import fake_contact, write_contacts


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    folder = tmp_path_factory.mktemp("contacts")
    write_contacts(folder, {Split.TRAIN: range(80), Split.VALIDATION: range(80, 120)})
    return TrainingRun(data=folder, out=folder)


@pytest.fixture
def brief(monkeypatch):
    monkeypatch.setattr(force_head, "STEPS", 20)
    monkeypatch.setattr(calibration, "LEAST_FORCE_CONTACTS", 10)
    monkeypatch.setattr(calibration, "FORCE_CONTACTS", 64)


def random_model(preset):
    torch.manual_seed(0)
    encoder = TactileEncoder(PRESETS[preset]).eval()
    return encoder, StateHeads.of(encoder.config).eval()


def test_few_contacts_give_no_force_head(run):
    encoder, heads = random_model("tiny_grid")
    fit_force(run, encoder, heads, CLEAN)
    assert heads.force is None


def test_an_encoder_of_other_points_gets_none(run, brief):
    encoder, heads = random_model("tiny")
    fit_force(run, encoder, heads, CLEAN)
    assert heads.force is None


def test_the_force_head_is_fitted_and_the_heads_stay_as_they_are(run, brief):
    encoder, heads = random_model("tiny_grid")
    before = {name: value.clone() for name, value in heads.state_dict().items()}
    fit_force(run, encoder, heads, CLEAN)
    assert heads.force is not None
    after = heads.state_dict()
    assert all(torch.equal(after[name], value) for name, value in before.items())
    assert float(heads.force.spread.max()) > 0.1
    assert float(heads.force.widening) != 1.0


def test_a_force_head_that_is_trained_on_is_fitted_anew_by_enough_contacts(run, brief):
    encoder, heads = random_model("tiny_grid")
    start = ForceHead()
    fit_force(run, encoder, heads, CLEAN, start)
    assert heads.force is not None and heads.force is not start


def test_with_fewer_it_stays_but_for_its_intervals(run, brief, monkeypatch):
    monkeypatch.setattr(calibration, "FORCE_CONTACTS", 81)
    encoder, heads = random_model("tiny_grid")
    start = ForceHead()
    weights = [p.clone() for p in start.parameters()]
    fit_force(run, encoder, heads, CLEAN, start)
    assert heads.force is start
    assert all(torch.equal(a, b) for a, b in zip(start.parameters(), weights, strict=True))
    assert float(start.widening) != 1.0


@pytest.mark.parametrize("held_out", [0, 2])
def test_its_intervals_are_not_set_by_a_handful_of_contacts(brief, tmp_path, held_out):
    write_contacts(tmp_path, {Split.TRAIN: range(80), Split.VALIDATION: range(80, 80 + held_out)})
    if not held_out:  # contacts there are, but none that touch
        lost = replace(
            fake_contact(99, split=Split.VALIDATION),
            state=NO_CONTACT_STATE,
            height_mm=np.zeros((76, 102), np.float32),
        )
        with DatasetWriter(tmp_path) as writer:
            writer.add(lost)
    encoder, heads = random_model("tiny_grid")
    fit_force(TrainingRun(data=tmp_path, out=tmp_path), encoder, heads, CLEAN)
    assert float(heads.force.widening) == 1.0


def test_the_same_seed_fits_the_same_force_head(run, brief):
    states = []
    for other in range(2):
        encoder, heads = random_model("tiny_grid")
        torch.manual_seed(other)
        fit_force(run, encoder, heads, CLEAN)
        states.append(heads.state_dict())
    for name, value in states[0].items():
        torch.testing.assert_close(states[1][name], value, rtol=0, atol=0)


def test_a_thickness_counts_as_the_part_of_the_range_that_is_nearest_to_it():
    thicknesses = np.repeat([2.0, 3.0, 4.5, 9.0], [10, 70, 15, 5])
    weights = even_weights(thicknesses).numpy()
    assert weights.mean() == pytest.approx(1)
    total = np.array([weights[thicknesses == each].sum() for each in np.unique(thicknesses)])
    cells = np.log([1.5, 1.5, 3**0.5, 2.0])
    np.testing.assert_allclose(total / total.sum(), cells / cells.sum(), rtol=1e-5)
    assert (even_weights(np.full(7, 3.4)) == 1).all()


def test_intervals_are_learned_with_the_weights_of_the_gels(run, brief, monkeypatch):
    seen = []
    monkeypatch.setattr(calibration, "even_weights", lambda t: seen.append(t) or even_weights(t))
    fit_force(run, *random_model("tiny_grid"), CLEAN)
    assert len(seen) == 1
    assert (seen[0] == 1.0).all()  # these contacts have no gel, which counts as the nominal one


def test_weights_of_other_points_are_refused_by_name(run, tmp_path, capsys):
    save_encoder(tmp_path / "encoder", *random_model("tiny"))
    assert main(["train", "force", "--weights", str(tmp_path), "--data", str(run.data)]) == 2
    message = capsys.readouterr().err
    assert "'lattice'" in message and "tacgrasp data generate" in message


def test_intervals_are_set_anew_and_nothing_else(run, brief, tmp_path):
    encoder, heads = random_model("tiny_grid")
    fit_force(run, encoder, heads, CLEAN)
    save_encoder(tmp_path / "encoder", encoder, heads)
    encoder, heads = load_encoder(tmp_path / "encoder")  # rounded as they are stored
    assert main(["train", "intervals", "--weights", str(tmp_path), "--data", str(run.data)]) == 0
    again, set_anew = load_encoder(tmp_path / "encoder")
    before, after = heads.state_dict(), set_anew.state_dict()
    changed = {name for name in before if not torch.equal(before[name], after[name])}
    assert {"widening", "contradiction"} < changed
    assert all(name.startswith("force.") for name in changed - {"widening", "contradiction"})
    for name, value in encoder.state_dict().items():
        torch.testing.assert_close(again.state_dict()[name], value, rtol=0, atol=0)


@pytest.mark.parametrize("stage", ["intervals", "force"])
def test_a_damaged_part_beside_the_encoder_is_not_signed_anew(run, brief, tmp_path, capsys, stage):
    save_encoder(tmp_path / "encoder", *random_model("tiny_grid"))
    for name in ("lm", "projector"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "model.safetensors").write_bytes(b"weights")
    write_manifest(tmp_path / "lm")
    write_manifest(tmp_path / "projector", trained_with=("encoder", "lm"))
    (tmp_path / "lm" / "model.safetensors").write_bytes(b"weighty")
    assert main(["train", stage, "--weights", str(tmp_path), "--data", str(run.data)]) == 2
    assert "lm/model.safetensors is damaged" in capsys.readouterr().err
    with pytest.raises(WeightsError):
        check_manifest(tmp_path / "lm")


def test_intervals_need_contacts_that_nothing_was_learned_from(tmp_path, capsys):
    save_encoder(tmp_path / "encoder", *random_model("tiny_grid"))
    write_contacts(tmp_path / "data", {Split.TRAIN: range(40)})
    command = ["train", "intervals", "--weights", str(tmp_path), "--data", str(tmp_path / "data")]
    assert main(command) == 2
    assert "has 0 of them: tacgrasp data generate" in capsys.readouterr().err
