"""The last lines of a run say what happened, and call nothing good that was bruised or lost."""

from dataclasses import replace

import pytest

from primitives.gain import GainEstimate
from tacgrasp.cli.run import EXIT_CODES
from tacgrasp.config.layers import load
from tacgrasp.config.schema import RunConfig
from tacgrasp.console import COLUMNS, COMPLETED, end_lines
from tacgrasp.runtime.end_text import end_text
from tacgrasp.runtime.outcome import EndReason, Outcome

TRUTH = {
    "held": True,
    "slipped": False,
    "slip_mm": 0.0,
    "dropped": False,
    "bruised_at_start": False,
    "bruised": False,
    "peak_force_n": 1.3,
    "force_n": 1.2,
    "mass_g": 27.1,
}
GOOD = Outcome(
    reason=EndReason.SUCCESS,
    message="held through the lift: moved 0.3 mm, 98% of the depth left",
    declared=True,
    verified=True,
    num_actions=5,
    num_steps=8,
    duration_s=14.2,
    safe_state="the gripper keeps its grip",
    truth=TRUTH,
    slip_minimum_n=0.8,
)


@pytest.fixture(scope="module")
def config() -> RunConfig:
    return load("strawberry")[0]


def ended(**changes: object) -> Outcome:
    """The good end with another truth."""
    return replace(GOOD, truth={**TRUTH, **changes})


def printed(outcome: Outcome, config: RunConfig) -> list[str]:
    return [line.plain for line in end_lines(outcome, config)]


def test_a_good_end_is_told_with_the_lift_the_bruise_and_the_peak(config: RunConfig) -> None:
    expected = "Held: lifted 40 mm, shaken, 2 s. Not bruised. Peak 1.3 N, 1.6 × what was needed."
    assert end_text(GOOD, config) == expected
    assert printed(GOOD, config)[-2:] == [expected, COMPLETED]


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"bruised_at_start": True}, "Held: lifted 40 mm, shaken, 2 s. Bruised at first touch."),
        ({"bruised": True}, "Bruised after the first touch. Peak 1.3 N"),
        ({"bruised": True, "bruised_at_start": True}, "Bruised at first touch and again later."),
        ({"held": False, "slipped": True, "slip_mm": 3.24}, "Slipped by 3.2 mm: lifted 40 mm"),
        ({"held": False, "slipped": True, "dropped": True}, "Dropped: lifted 40 mm"),
        ({"held": False}, "Nothing gripped: lifted 40 mm"),
        ({"held": False, "dropped": True, "bruised": True}, "by touch, but dropped and bruised"),
    ],
)
def test_what_touch_verified_and_the_truth_denies_is_not_called_a_success(
    changes: dict[str, object], words: str, config: RunConfig
) -> None:
    outcome = ended(**changes)
    lines = printed(outcome, config)
    assert words in " ".join(line.strip() for line in lines)
    assert not any("success" in line.lower() for line in lines)
    assert lines[0].startswith("end: verified by touch, but ")
    assert not outcome.completed
    assert EndReason.SUCCESS not in EXIT_CODES  # so that the exit code is 1


def test_without_a_lift_the_words_say_so(config: RunConfig) -> None:
    early = replace(GOOD, reason=EndReason.TIMEOUT, declared=False, verified=None)
    assert end_text(early, config).startswith("Gripped: not lifted. Not bruised.")
    cut_short = replace(early, reason=EndReason.FAULT, declared=True)
    assert "Gripped: the lift was not completed." in end_text(cut_short, config)
    never = replace(early, truth={**TRUTH, "held": False, "peak_force_n": 0.0})
    assert end_text(never, config) == "Nothing gripped: not lifted. Not bruised."


def test_a_lift_without_shakes_is_not_called_shaken(config: RunConfig) -> None:
    still = config.model_copy(update={"verify": config.verify.model_copy(update={"shakes": 0})})
    assert end_text(GOOD, still).startswith("Held: lifted 40 mm, 2 s.")


def test_what_slid_and_was_caught_is_held(config: RunConfig) -> None:
    caught = ended(held=True, slipped=True, slip_mm=2.5)
    assert end_text(caught, config).startswith("Held, slid by 2.5 mm: lifted 40 mm")
    assert caught.completed


def test_what_was_lost_as_it_was_lifted_off_is_not_called_lifted() -> None:
    lost = replace(ended(held=False, dropped=True), verified=False, lifted=False)
    text = end_text(lost, load("fruit")[0])
    assert text.startswith("Dropped: lifted off by 1 mm alone.")


def test_a_real_rig_tells_what_touch_knows_and_nothing_else(config: RunConfig) -> None:
    felt = replace(GOOD, truth=None, slip_minimum_n=None, peak_felt_n=1.24)
    assert end_text(felt, config) == (
        "By touch: held, lifted 40 mm, shaken, 2 s. Peak felt 1.2 N; a bruise can't be felt."
    )
    assert printed(felt, config)[-1] == COMPLETED
    lost = replace(felt, reason=EndReason.UNVERIFIED, verified=False, force_mark="uncalibrated")
    assert end_text(lost, config) == (
        "By touch: not held, lifted 40 mm, shaken, 2 s. Peak felt 1.2 N (uncalibrated); a bruise "
        "can't be felt."
    )
    nothing = replace(felt, reason=EndReason.FAULT, declared=False, verified=None, peak_felt_n=None)
    assert end_text(nothing, config) == "By touch: not lifted. A bruise can't be felt."


def test_a_dry_run_claims_nothing(config: RunConfig) -> None:
    dry = config.model_copy(update={"dry_run": True})
    assert end_text(replace(GOOD, verified=False), dry) == "Dry run: nothing moved."


def test_no_line_of_the_end_is_wider_than_a_hundred_columns(config: RunConfig) -> None:
    long = replace(GOOD, reason=EndReason.FAULT, message="the sensor gave no frame; " * 20)
    lines = printed(long, config)
    assert max(map(len, lines)) <= COLUMNS
    assert " ".join(line.strip() for line in lines).count("the sensor gave no frame;") == 20


def test_the_gain_of_the_gripper_stands_with_the_residual_of_the_force_it_is_known_by(
    config: RunConfig,
) -> None:
    gain = GainEstimate(value=1.56, low=1.46, high=1.67, num_grips=2)
    known = replace(GOOD, gain=gain, force_residual=0.04)
    line = "gripper: presses 1.56 times its command (1.46-1.67, 2 grips), felt force "
    assert line + "calibrated to 4%" in printed(known, config)
    raw = replace(known, force_mark="uncalibrated, -26 to +35 %")
    assert line + "uncalibrated, -26 to +35 %" in " ".join(printed(raw, config))
    assert not any("times its command" in each for each in printed(GOOD, config))
