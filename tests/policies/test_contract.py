"""The contract: configuration over words over the task, and what is refused by name."""

from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from policies.contract import BANDS, read_contract
from primitives import LimitError
from primitives.contract import LIMIT_OVER_BAND, Band, Contract, ForceTerms
from tests.fakes.contracts import BERRY, PEG, STRAWBERRY, contract, peg_terms, terms

TASK = terms()
MOST_N = 3 * STRAWBERRY.limit_n


def read(text: str, **given_bands: object) -> Contract:
    return read_contract(text, TASK, given_bands)


def test_the_tasks_own_instruction_means_the_tasks_own_terms():
    own = read(TASK.instruction)
    assert own.terms == STRAWBERRY
    assert (own.depth_mm, own.area_fraction) == (TASK.depth_mm, TASK.area_fraction)
    assert own.slip_mm == TASK.slip_mm
    assert set(own.origins.values()) == {"the task"}
    assert any("gently" in note for note in own.assumed)


def test_the_same_manner_in_other_words_is_relative_to_the_task():
    assert read("Pick the strawberry gently.").terms.force_n.middle < STRAWBERRY.force_n.middle


def test_words_win_over_the_task_and_are_named_as_the_origin():
    said = read("Hold it at 1.2 N.")
    assert 1.2 in said.terms.force_n
    assert said.origins["force_n"] == "your words: 1.2 N"
    assert said.origins["slip_mm"] == "the task"
    assert said.origins["depth_mm"] == "default"  # the task's depth is that of the task's force


@pytest.mark.parametrize("most_n", [1.0, 3.0, 5.3, 8.0])
def test_a_firm_grip_under_a_named_most_starts_where_a_peg_is_felt_to_be_below_it(most_n: float):
    plain, firm = (
        read_contract(f"{manner}at most {most_n} N", peg_terms(), {}).terms
        for manner in ("", "firmly, ")
    )
    assert firm.limit_n == plain.limit_n
    assert firm.force_n.high == plain.force_n.high
    assert firm.force_n.low >= plain.force_n.low
    assert firm.force_n.low <= max(plain.force_n.low, 0.5801 * firm.limit_n)


@pytest.mark.parametrize("least_n", [0.5, 1.0, 3.0, 6.0])
def test_a_least_asks_for_no_less_than_the_task_does(least_n: float):
    named = read_contract(f"hold it with at least {least_n} N", peg_terms(), {}).terms
    assert named.force_n.low == pytest.approx(max(PEG.force_n.low, 1.03 * least_n))
    assert named.limit_n >= PEG.limit_n


def test_configuration_wins_over_manner_and_says_so():
    held = read("Hold it gently.", force_n=Band(low=4.0, high=6.0))
    assert held.terms.force_n == Band(low=4.0, high=6.0)
    assert held.terms.limit_n == pytest.approx(LIMIT_OVER_BAND * 6.0)
    assert held.origins["force_n"] == "the configuration"
    assert held.insists
    assert any("gently" in note and "gives way" in note for note in held.assumed)


@pytest.mark.parametrize(
    ("text", "band", "named"),
    [
        ("Hold it with 1 N.", (4.0, 6.0), "1 N"),
        ("Hold it with at most 2 N.", (1.5, 3.0), "at most 2 N"),
        ("Hold it with at least 5 N.", (1.0, 2.0), "at least 5 N"),
        ("Hold it with 2 to 3 N.", (0.5, 1.5), "2 to 3 N"),
    ],
)
def test_a_force_in_words_against_the_configuration_is_refused_with_both_named(text, band, named):
    refused = read(text, force_n=Band(low=band[0], high=band[1])).refused
    assert named in refused
    assert f"{band[0]:g}-{band[1]:g} N" in refused
    assert "change one of them" in refused


def test_a_most_in_words_stays_the_limit_under_a_configured_band_that_fits():
    held = read("Hold it with at most 2 N.", force_n=Band(low=1.0, high=1.5))
    assert held.terms.force_n == Band(low=1.0, high=1.5)
    assert 0.95 * 2 <= held.terms.limit_n <= 2


def test_a_most_in_words_that_was_set_aside_raises_no_limit_of_a_configured_band():
    band = Band(low=0.8, high=1.2)
    for words in ("Pick it.", f"Hold it with at most {4 * STRAWBERRY.limit_n:g} N."):
        assert read(words, force_n=band).terms.limit_n == pytest.approx(LIMIT_OVER_BAND * 1.2)


@given(limit=st.integers(110, 900), text=st.sampled_from([TASK.instruction, "Hold it firmly."]))
def test_a_configured_limit_is_the_limit_and_ends_the_band(limit, text):
    held = read(text, limit_n=limit / 100)
    assert held.insists
    if not held.refused:
        assert held.terms.limit_n == pytest.approx(limit / 100)
        assert held.origins["limit_n"] == "the configuration"
    else:
        assert "limit_n" in held.refused


def test_a_configured_limit_below_the_band_is_refused():
    assert "limit_n 0.5 N" in read(TASK.instruction, limit_n=0.5).refused


def test_a_lower_most_in_words_wins_over_a_configured_limit():
    assert read("Hold it with at most 1.5 N.", limit_n=3.0).terms.limit_n <= 1.5
    assert read("Hold it with at most 1.5 N.", limit_n=1.2).terms.limit_n == 1.2


def test_every_other_configured_band_is_used_and_named():
    bands = {
        "slip_mm": 0.7,
        "x_mm": Band(low=-1, high=1),
        "y_mm": Band(low=-2, high=2),
        "depth_mm": Band(low=0.1, high=0.3),
        "area_fraction": Band(low=0.05, high=0.2),
    }
    held = read("Hold it at 1.2 N.", **bands)
    for name, value in bands.items():
        assert getattr(held, name) == value
        assert held.origins[name] == "the configuration"
    assert not held.insists  # the force was left to the words
    assert {*bands, "force_n", "limit_n"} == set(BANDS)


def test_a_band_that_no_contract_has_is_an_error_of_the_caller():
    with pytest.raises(LimitError, match="forse_n; known: force_n"):
        read(TASK.instruction, forse_n=Band(low=1, high=2))


def test_words_alone_may_not_name_more_than_three_times_the_tasks_limit():
    assert read("Hold it with 7 N.").refused == ""
    refused = read("Hold it with 8 N.").refused
    assert "8 N is more than 3 times the task's limit" in refused
    assert "--goal.force-n" in refused
    assert read(TASK.instruction, force_n=Band(low=7.5, high=8.5)).refused == ""
    assert read_contract("Hold it with 8 N.", peg_terms(), {}).refused == ""


@given(hundredth=st.integers(701, 20000))
def test_a_limit_alone_that_no_words_may_name_leaves_band_and_limit_to_the_task(hundredth):
    berry = replace(TASK, force=BERRY)
    held = read_contract(f"Hold it with at most {hundredth / 100:g} N.", berry, {})
    assert held.terms == BERRY
    assert read(f"At most {hundredth / 100 + 1:g} N.").terms == STRAWBERRY


def test_such_a_limit_does_not_contradict_a_configured_band_below_it():
    held = read("Hold it with at most 8 N.", force_n=Band(low=4.0, high=6.0))
    assert held.terms.force_n == Band(low=4.0, high=6.0)
    assert held.terms.limit_n == LIMIT_OVER_BAND * 6.0 < 8  # the lower of both
    assert 0.95 * 8 <= read("Hold it with at most 8 N.", limit_n=10.0).terms.limit_n <= 8


def test_the_limit_of_a_named_force_is_no_more_than_words_may_name():
    berry = replace(TASK, force=BERRY)
    held = read_contract("Hold it with 7 N.", berry, {}).terms
    assert (held.force_n.low, held.force_n.high) == pytest.approx((0.86 * 7, 7))
    assert held.limit_n == pytest.approx(7)
    assert read_contract("Three times as hard.", berry, {}).terms.limit_n == pytest.approx(7)


@pytest.mark.parametrize(
    "text",
    ["30 % more.", "Hold it firmly.", "Very firmly.", "0.3 N more than usual.", "At least 1.5 N."],
)
@pytest.mark.parametrize("force", [BERRY, STRAWBERRY], ids=["berry", "soft"])
def test_asking_for_more_than_usual_never_lowers_the_limit(text, force):
    held = read_contract(text, replace(TASK, force=force), {}).terms
    assert held.force_n.middle > force.force_n.middle
    assert held.limit_n >= force.limit_n


@pytest.mark.parametrize(
    "change", [str.upper, str.lower, lambda text: text.rstrip("."), "  {} ".format]
)
def test_case_spaces_and_the_full_stop_of_the_tasks_own_instruction_change_nothing(change):
    assert read(change(TASK.instruction)).terms == STRAWBERRY
    other = replace(TASK, others={"Grip the peg.": PEG})
    assert read_contract(change("Grip the peg."), other, {}).terms == PEG


@pytest.mark.parametrize(
    ("text", "low_n", "high_n"),
    [
        ("1 N plus minus 20 percent", 0.8, 1.2),
        ("1 N ± 50%", 0.5, 1.5),
        ("3 N +/- 0.2 N", 2.8, 3.2),
        ("2 ± 0.3 N", 1.7, 2.3),
        ("Hold it with 2 N, with a tolerance of 0.1 N.", 1.9, 2.1),
        ("With a tolerance of 10 %, hold it at 2 N.", 1.8, 2.2),
        ("2 N of force, give or take 0.4", 1.6, 2.4),
        ("2 N +0.4/-0.2 N", 1.8, 2.4),
    ],
)
def test_a_stated_tolerance_is_the_band(text, low_n, high_n):
    held = read(text)
    assert (held.terms.force_n.low, held.terms.force_n.high) == pytest.approx((low_n, high_n))
    assert held.terms.limit_n == pytest.approx(LIMIT_OVER_BAND * high_n)
    assert held.assumed == ()


def test_a_tolerance_that_can_not_be_kept_is_widened_or_refused_and_never_silently():
    narrow = read("Hold it with 2 N ± 0.5 %.")
    assert (narrow.terms.force_n.low, narrow.terms.force_n.high) == pytest.approx((1.9, 2.1))
    assert "narrower than can be held" in narrow.assumed[0]
    assert "tolerance of a bound" in read("At most 2 N ± 10 %.").assumed[0]
    assert "belongs to no single force" in read("1 N to 2 N, within ± 5 %.").assumed[0]
    assert "no force at all" in read("Hold it with 1 N ± 120 %.").refused
    assert "10 % of what" in read("Hold it with a tolerance of 10 %.").refused


@pytest.mark.parametrize(
    "text",
    [
        "Keep the contact at the left of the pad.",
        "Hold it centred within 1 mm.",
        "Place the contact 3 mm to the left.",
        "Hold it at 2 mm to the left.",
        "Take it with 0.8 N, 2 mm to the left.",
        "Grip it near the stem with 0.8 N.",
    ],
)
def test_a_place_in_words_is_said_to_be_not_read(text):
    held = read(text)
    assert (held.x_mm, held.y_mm) == (TASK.x_mm, TASK.y_mm)
    assert "is not read: goal.x_mm and goal.y_mm" in held.assumed[0]


@pytest.mark.parametrize(
    "text",
    [
        "Grasp the berry on the left and move it 30 mm to the right.",
        "It slipped 2 mm to the left, hold it with 0.8 N.",
        "Hold it with 0.8 N.",
    ],
)
def test_a_place_of_the_object_is_no_place_on_the_pad(text):
    assert read(text).assumed == ()


def test_no_configuration_goes_beyond_the_gripper():
    refused = read(TASK.instruction, force_n=Band(low=31.0, high=40.0)).refused
    assert "the gripper's 30 N" in refused


def test_a_limit_below_the_least_that_the_gripper_can_keep_to_is_refused():
    weak = replace(TASK, least_n=0.6)
    assert "below 0.6 N" in read_contract("Hold it with at most 0.5 N.", weak, {}).refused
    assert read_contract("Hold it with at most 0.5 N.", TASK, {}).refused == ""


@given(hundredth=st.integers(21, 700), task=st.sampled_from([terms(), peg_terms()]))
def test_at_most_sets_the_limit_just_below_the_named_force(hundredth, task):
    most_n = hundredth / 100
    held = read_contract(f"Hold it with at most {most_n:g} N.", task, {})
    assert held.refused == ""
    assert 0.95 * most_n <= held.terms.limit_n <= most_n
    assert held.terms.force_n.high <= 0.9 * most_n * 1.001


@given(hundredth=st.integers(25, 700))
def test_a_named_force_is_the_middle_of_a_narrow_band(hundredth):
    force_n = hundredth / 100
    band = read(f"Hold it with {force_n:g} N.").terms.force_n
    assert 0.85 * force_n <= band.low < force_n < band.high <= 1.15 * force_n


@given(hundredth=st.integers(25, 650))
def test_at_least_sets_the_low_end_just_above_the_named_force_or_leaves_it(hundredth):
    least_n = hundredth / 100
    held = read(f"Hold it with at least {least_n:g} N.")
    if held.refused:
        assert 1.2 * least_n > MOST_N / 1.05
    else:
        bound_n = max(least_n, STRAWBERRY.force_n.low)
        assert bound_n <= held.terms.force_n.low <= 1.1 * bound_n


@given(text=st.sampled_from(["Hold it.", "Hold it gently.", "Hold it at 2 N.", "Twice as hard."]))
def test_an_unnamed_limit_is_at_most_a_quarter_above_the_band(text):
    held = read(text).terms
    assert held.force_n.high <= held.limit_n <= LIMIT_OVER_BAND * held.force_n.high * 1.0001


@pytest.mark.parametrize(
    ("text", "factor"),
    [("Hold it half as hard.", 0.5), ("Grip it twice as hard.", 2.0)],
)
def test_a_factor_is_relative_to_the_task(text, factor):
    assert read(text).terms.force_n.middle == pytest.approx(factor * STRAWBERRY.force_n.middle)
    peg = read_contract(text, peg_terms(), {}).terms
    assert peg.force_n.middle == pytest.approx(factor * PEG.force_n.middle)


def test_slip_and_depth_in_words_become_bands_of_the_contract():
    held = read("Hold it with 1.5 N, 0.4 mm deep, and let it slip no more than 0.5 mm.")
    assert held.slip_mm == 0.5
    assert 0.4 in held.depth_mm
    assert held.origins["slip_mm"] == held.origins["depth_mm"] == "your words"
    assert held.origins["force_n"].startswith("your words")


def test_only_a_contract_for_hard_things_is_open_to_the_objection_of_a_soft_contact():
    assert read(TASK.instruction).soft is None
    hard = read_contract("Grip the peg firmly.", peg_terms(), {})
    assert hard.soft == STRAWBERRY
    insisting = read_contract("Grip it.", peg_terms(), {"force_n": PEG.force_n})
    assert insisting.soft is None


def test_a_contract_has_a_band_or_a_reason_and_never_both():
    good = contract(1.0, 2.0, 2.5)
    with pytest.raises(LimitError, match="or a reason"):
        replace(good, refused="why")
    with pytest.raises(LimitError, match="or a reason"):
        replace(good, force_n=None)
    with pytest.raises(LimitError, match="reaches above its"):
        replace(good, limit_n=1.9)
    with pytest.raises(LimitError, match="nothing was moved"):
        _ = replace(good, force_n=None, limit_n=None, refused="why").terms


@pytest.mark.parametrize(("low", "high"), [(2, 1), (float("nan"), 1), (0, float("inf"))])
def test_a_band_in_no_order_is_refused(low, high):
    with pytest.raises(ValueError, match="low <= high"):
        Band(low=low, high=high)


def test_force_terms_of_nothing_are_refused():
    with pytest.raises(LimitError, match="above 0 N"):
        ForceTerms(force_n=Band(low=0.0, high=1.0), limit_n=2.0)


@pytest.mark.parametrize(
    ("instruction", "words"),
    [
        ("Grip at most 1 n.", "at most 1 N"),
        ("Grip with 900 mn.", "900 mN"),
        ("Grip with 0.9 newtons.", "0.9 newtons"),
    ],
)
def test_units_are_said_as_they_are_written(instruction, words):
    assert words in read(instruction).origins["force_n"]


def test_a_most_above_the_task_s_limit_changes_nothing_and_is_no_origin():
    said = read("at most 500 N")
    assert said.terms == STRAWBERRY
    assert said.origins["limit_n"] == said.origins["force_n"] == "the task"
    assert any("'at most 500 N' is above the task's limit" in note for note in said.assumed)


@pytest.mark.parametrize(
    ("instruction", "most_n"),
    [
        ("Hold it at 0.5 N, 0.6 N absolute max.", 0.6),
        ("Hold it with 1 N, 1.1 N hard limit.", 1.1),
        ("Hold it at 0.5 N and bail out at 0.6 N.", 0.6),
        ("Hold it at 0.5 N, 0.6 N tops.", 0.6),
        ("Hold it at 0.5 N but anything over 0.6 N is too much.", 0.6),
        ("Hold it at 1 N; abort at 1.2 N.", 1.2),
        ("Hold it with 1 N, emergency stop at 1.1 N.", 1.1),
        ("Hold it with 0.5 N. Alarm threshold 0.6 N.", 0.6),
        ("Hold it with 0.5 N, red line 0.6 N.", 0.6),
        ("Hold it with 1 N, 1.2 N is the absolute limit.", 1.2),
    ],
)
def test_no_number_that_is_stated_above_the_wish_is_passed(instruction, most_n):
    held = read(instruction)
    assert held.refused == ""
    assert 0.95 * most_n <= held.terms.limit_n <= most_n
    assert held.terms.force_n.high <= held.terms.limit_n


@pytest.mark.parametrize(
    ("instruction", "reason"),
    [
        ("Hold with 0.5 N and with 0.6 N.", "what each is for"),
        ("1 N but never 1 N", "not to hold with"),
        ("The limit is not 1 N", "not to hold with"),
        ("-50 % more", "a sign and a direction"),
        ("move up", "moves the arm"),
        ("Move.", "moves the arm"),
        ("please rotate the gripper", "moves the arm"),
        ("hold it at 1 N, redline 1.1", "1.1 has no unit; say '1.1 N'"),
        ("hold it at 1.8 N, redline 2", "2 has no unit"),
        ("grip it with 1 N 0.5", "0.5 has no unit"),
        ("Close the gripper.", "moves the arm"),
        ("pick the cat", "living being"),
    ],
)
def test_what_has_no_plain_meaning_is_refused(instruction, reason):
    assert reason in read(instruction).refused


@pytest.mark.parametrize("instruction", [">= 0.5 N", "min 0.5 N", "Use at least 0.5 N."])
def test_a_least_lowers_no_limit(instruction):
    assert read(instruction).terms.limit_n == STRAWBERRY.limit_n


@pytest.mark.parametrize("instruction", ["slip at most 0.5 mm", "Let it slip by at most 0.5 mm."])
def test_a_bound_of_the_slip_asks_for_no_firmer_grip(instruction):
    held = read(instruction)
    assert held.terms == STRAWBERRY
    assert held.slip_mm == 0.5


def test_a_comparison_does_not_name_what_is_held():
    assert read("Hold it like an egg.").summary == "hold the strawberry"


@pytest.mark.parametrize(
    ("instruction", "is_other"),
    [
        ("pick the egg", True),
        ("hold the egg with 0.7 N", True),
        ("take the berry gently", False),
        ("hold it like an egg", False),
        ("pick the fruit", False),
    ],
)
def test_the_object_of_another_task_is_noted(instruction: str, is_other: bool):
    task = replace(TASK, others={"Pick the egg without cracking it.": PEG})
    notes = read_contract(instruction, task, {}).assumed
    assert any("the egg is the object of another task" in note for note in notes) == is_other
    assert not any("another task" in note for note in read(instruction).assumed)
