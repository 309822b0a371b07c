"""Terms of a task out of the configuration, and what in them counts as set explicitly."""

from dataclasses import replace

import pytest

from policies.contract import BANDS
from primitives.contract import LIMIT_OVER_BAND, Band
from tacgrasp.config.layers import load
from tacgrasp.config.terms import (
    FIELDS,
    band_lines,
    contract_json,
    contract_lines,
    contract_of,
    given,
    task_terms,
)
from tests.fakes.contracts import BERRY, PEG, refused_contract

TASKS = ("strawberry", "egg", "peg", "cherry_tomato")


@pytest.mark.parametrize("task", TASKS)
def test_an_unchanged_run_has_nothing_given_and_the_tasks_own_terms(task):
    config, sources = load(task)
    assert given(config, sources) == {}
    terms = task_terms(config, sources)
    assert replace(terms, defaults=frozenset()) == task_terms(config)
    own = set() if config.goal.limit_n is None else {"limit_n"}
    assert terms.defaults == {"limit_n", "slip_mm"} - own
    contract = contract_of(config, sources)
    assert contract.terms == terms.force
    over_band = 2.0 if own else LIMIT_OVER_BAND
    assert terms.force.limit_n == pytest.approx(over_band * terms.force.force_n.high)


def test_the_terms_are_those_of_the_task_files():
    assert task_terms(load("strawberry")[0]).force == BERRY
    assert task_terms(load("peg")[0]).force == PEG
    assert task_terms(load("peg")[0]).soft == BERRY


def test_the_gripper_of_the_rig_bounds_the_forces():
    config, sources = load("strawberry")
    gripper = config.gripper
    terms = task_terms(config, sources)
    assert terms.least_n == gripper.min_force_n * gripper.max_force_gain
    assert terms.most_n == gripper.max_force_n


def test_what_a_layer_above_the_task_sets_is_given_and_leaves_the_tasks_terms():
    config, sources = load("strawberry")
    goal = config.goal.model_copy(update={"force_n": (4.0, 6.0)})
    changed = config.model_copy(update={"goal": goal})
    sources = {**sources, "goal.force_n": "flag --goal.force-n"}
    assert given(changed, sources) == {"force_n": Band(low=4.0, high=6.0)}
    assert task_terms(changed, sources).force == BERRY
    assert contract_of(changed, sources).terms.force_n == Band(low=4.0, high=6.0)


def test_every_band_of_a_contract_has_a_field_of_the_configuration_and_a_line():
    assert set(FIELDS.values()) == set(BANDS)
    contract = contract_of(*load("strawberry"))
    lines = band_lines(contract)
    assert [line.split()[0] for line in lines] == [f"contract.{name}" for name in BANDS]
    assert all(line.endswith("]") for line in lines)


def test_the_printed_line_shows_forces_limit_and_place():
    line = contract_lines(contract_of(*load("strawberry")))[0]
    assert line.endswith("0.15-2.50 N, never above 5 N (the task); place x ±4, y ±3 mm")
    moved = replace(contract_of(*load("strawberry")), x_mm=Band(low=-1, high=2))
    assert "place x -1 to 2, y ±3 mm" in contract_lines(moved)[0]


def test_a_refused_contract_is_shown_with_its_reason_and_without_a_band():
    refused = refused_contract()
    assert contract_lines(refused)[0] == "refused: it asks to let go: drop"
    shown = contract_json(refused)
    assert (shown["force_n"], shown["limit_n"]) == (None, None)
    assert shown["refused"] == "it asks to let go: drop"
    assert "contract.force_n        none" in band_lines(refused)[0]
