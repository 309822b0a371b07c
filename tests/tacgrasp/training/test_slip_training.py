"""Training of the slip models: what is learned from loads made by hand, and loads as seen."""

import numpy as np
import pytest
from rich.console import Console

from cltp.errors import TouchError
from cltp.tactile.shear.contact_shear import NUM_VALUES
from cltp.tactile.shear.slip import SlipJudge, SlipModel
from tacgrasp.__main__ import main
from tacgrasp.training import slip_loads
from tacgrasp.training.slip import SeenLoad, fit, see_loads
from tacgrasp.training.slip_loads import BLOCK, FIRST_SEED, SENSORS, Course, read_block, simulate
from tacgrasp.training.slip_network import joined

FRAMES = 10


def load(seed, *, slips, stick=None, sensor="taxels"):
    """Ten frames; the first cue tells a slip."""
    rng = np.random.default_rng(seed)
    cues = rng.standard_normal((FRAMES, NUM_VALUES))
    sliding = np.arange(FRAMES) >= 6 if slips else np.zeros(FRAMES, bool)
    cues[:, 0] = np.where(sliding, 3.0, -3.0) + 0.3 * rng.standard_normal(FRAMES)
    return SeenLoad(
        sensor=sensor,
        seed=seed,
        course=Course.LOAD,
        cues=cues,
        steps=np.arange(FRAMES),
        stick=np.where(sliding, 0.0, 0.8) if stick is None else np.array(stick),
        slipped_mm=np.where(sliding, 0.5, 0.0),
    )


def test_a_cue_that_tells_is_learned_and_the_threshold_parts_what_was_held_out():
    model = fit([load(seed, slips=seed // 4 % 2 == 0) for seed in range(400)], 0)
    for seed in range(1000, 1010):
        seen = load(seed, slips=seed % 2 == 0)
        judge = SlipJudge(model, 100.0)
        scores = [judge.see(each) for each in seen.cues]
        assert max(scores[:6]) < 0
        assert (max(scores) > 0) == seen.slips


@pytest.mark.parametrize("slips", [True, False])
def test_loads_of_one_kind_alone_teach_nothing(slips):
    with pytest.raises(TouchError, match="loads that slip, loads that hold"):
        fit([load(seed, slips=slips) for seed in range(8)], 0)


def test_a_lesson_asks_for_a_call_from_a_fifth_on_and_leaves_out_what_comes_after():
    stick = [1.0, 0.9, 0.8, 0.6, 0.3, 0.1, 0.0, 0.0, 0.9, 0.9]
    lesson = load(1, slips=True, stick=stick).lesson(np.zeros(NUM_VALUES), np.ones(NUM_VALUES))
    assert lesson.slips.tolist() == [0, 0, 0, 0, 0, 1, 1, 1, 1, 0]  # of two steps the least
    assert lesson.held.tolist() == [1, 1, 1, 1, 1, 0, 0, 0, 0, 0]
    assert lesson.due.tolist() == [0, 0, 0, 0, 0, 1, 1, 1, 1, 0]
    assert (lesson.weight > 0).tolist() == [True] * 9 + [False]
    assert lesson.weight[5] < lesson.weight[0] < lesson.weight[6]


def test_a_load_that_nearly_slid_weighs_more_than_one_that_was_firm():
    zeros, ones = np.zeros(NUM_VALUES), np.ones(NUM_VALUES)
    firm = load(1, slips=False).lesson(zeros, ones)
    close = load(1, slips=False, stick=[0.8] * 5 + [0.3] * 5).lesson(zeros, ones)
    assert (close.weight > firm.weight).all()
    assert not firm.slips.any() and not firm.due.any() and firm.held.all()


@pytest.fixture(scope="module")
def block(tmp_path_factory):
    """A file of six seeds' loads."""
    folder = tmp_path_factory.mktemp("loads")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(slip_loads, "BLOCK", 6)
        slip_loads.write_block(folder, FIRST_SEED)
    return folder / f"loads_{FIRST_SEED}.npz"


def test_a_block_holds_loads_drags_and_changes_of_force(block):
    loads = list(read_block(block))
    assert {each.course for each in loads} == set(Course)
    for each in loads:
        assert each.seed in range(FIRST_SEED, FIRST_SEED + BLOCK)
        assert (each.commanded >= 0) == (each.course is Course.CHANGED)
        assert {len(moved) for moved in each.moved_mm.values()} == {len(each.stick)}
        assert each.stick[0] > 0.2 and each.slipped_mm[0] == 0


def test_a_load_is_seen_by_units_of_every_sensor(block):
    seen = see_loads(2, SENSORS, block)
    count = len(list(read_block(block)))
    assert [each.sensor for each in seen] == count * [
        SENSORS[0],
        SENSORS[0],
        SENSORS[1],
        SENSORS[1],
    ]
    for each in seen:
        assert each.cues.shape == (len(each.steps), NUM_VALUES)
        assert np.isfinite(each.cues).all()
        assert each.steps[0] == 0 and each.steps[-1] < len(each.stick)
    assert seen[0].cues.shape != seen[1].cues.shape or (seen[0].cues != seen[1].cues).any()


def test_one_sensor_is_seen_as_it_is_among_others(block):
    both, alone = see_loads(1, SENSORS, block), see_loads(1, SENSORS[1:], block)
    assert {each.sensor for each in alone} == {SENSORS[1]}
    others = [each for each in both if each.sensor == SENSORS[1]]
    assert all(np.array_equal(a.cues, b.cues) for a, b in zip(alone, others, strict=True))


def test_a_model_of_a_sensor_without_shear_is_refused(tmp_path, capsys):
    assert main(["train", "slip", "--out", str(tmp_path), "--sensor", "digit"]) != 0
    assert "slip models are of taxels and gelsight_mini_markers" in capsys.readouterr().err


def test_loads_that_are_there_are_not_simulated_again(block):
    before = block.stat().st_mtime_ns
    assert simulate(block.parent, range(FIRST_SEED, FIRST_SEED + BLOCK), Console()) == [block]
    assert block.stat().st_mtime_ns == before


def test_a_damaged_file_of_loads_is_named(tmp_path):
    path = tmp_path / "loads_100.npz"
    path.write_bytes(b"no loads")
    with pytest.raises(TouchError, match="loads_100"):
        list(read_block(path))


def test_networks_that_are_joined_give_the_mean_of_their_odds():
    rng = np.random.default_rng(0)
    shapes = {"enter": (4, NUM_VALUES), "take": (12, 4), "keep": (12, 4), "leave": (1, 4)}

    def model_of(layers):
        zeros, ones = np.zeros(NUM_VALUES), np.ones(NUM_VALUES)
        return SlipModel(mean=zeros, spread=ones, **layers, frame_hz=100.0, threshold=0.0)

    parts = [
        {k: (rng.standard_normal(n), rng.standard_normal(n[0])) for k, n in shapes.items()}
        for _ in range(3)
    ]
    alone = [SlipJudge(model_of(part), 100.0) for part in parts]
    together = SlipJudge(model_of(joined(parts)), 100.0)
    for values in rng.standard_normal((5, NUM_VALUES)):
        assert together.see(values) == pytest.approx(np.mean([each.see(values) for each in alone]))
