"""No limit is lost beside other numbers, whatever these were said for."""

from __future__ import annotations

from dataclasses import replace
from itertools import permutations, product

import pytest

from policies.contract import TaskTerms, read_contract
from tests.fakes.contracts import terms

LEASTS = ("at least 0.5 N", "0.5 newtons at the minimum", "minimum 0.5 N", "no less than 500 mN")
LINKS = (" and ", ", ", ". ", " then ")
NUMBERS = {"0.7": 0.7, "1": 1.0, "0.7 N": 0.7, "700 mN": 0.7}


@pytest.mark.parametrize(
    "most",
    [
        "{} at the maximum",
        "{} tops",
        "{} as the ceiling",
        "{} absolute max",
        "never {}",
        "do not go past {}",
        "cap it at {}",
        "peak {}",
        "{} peak",
        "{} is the limit",
        "{} is the most it can take",
        "{} at worst",
        "{} in the worst case",
        "{} for the hard stop",
        "{} when it slips",
    ],
)
def test_no_limit_lies_above_a_number_beside_a_least(most: str) -> None:
    task = terms()
    for least, link, (said, most_n) in product(LEASTS, LINKS, NUMBERS.items()):
        text = least + link + most.format(said)
        held = read_contract(text, task, {})
        assert held.refused or held.terms.limit_n <= most_n, (text, held.terms.limit_n)


WISHES = ("hold it with 0.5 N", "grip it gently", "aim for 500 mN", "at least 0.4 N", "take it")
BOUNDS = (
    "back off before 0.8 N",
    "0.8 N max",
    "anything over 0.8 N ruins it",
    "without going past 0.8 N",
    "0.8 N tops",
)
ASIDES = ("the eggs need 3 N", "yesterday we used 2 N", "this is berry 7", "the tray holds 12")


@pytest.mark.parametrize("bound", BOUNDS)
def test_a_bound_holds_beside_a_wish_and_an_aside_in_any_order(bound: str) -> None:
    task = terms()
    for wish, aside, link in product(WISHES, ASIDES, (". ", "; ", " - ")):
        for parts in permutations((wish, bound, aside)):
            held = read_contract(link.join(parts), task, {})
            assert held.refused or held.terms.limit_n <= 0.8, (link.join(parts), held.terms)


@pytest.mark.parametrize(
    ("text", "task", "is_refused"),
    [
        ("The eggs need 3 N; gently.", terms(), True),
        ("The eggs need 3 N; at least 0.4 N.", terms(), True),
        ("Berries need 0.8 N.", terms(), False),
        ("The fruit takes 1 N.", terms(), False),
        ("The tomatoes need 1 N.", replace(terms(), object="cherry_tomato"), False),
        ("The strawberry needs 0.5 N.", replace(terms(), object="egg"), True),
    ],
)
def test_what_another_object_needs_is_no_wish(text: str, task: TaskTerms, is_refused: bool) -> None:
    assert ("something else takes" in read_contract(text, task, {}).refused) is is_refused


@pytest.mark.parametrize(
    "text",
    [
        "P0: force never under 1.55 N",
        "Take berry number 3, and mind that less than 1.4 N isn't allowed.",
        "Slip was logged at 0.35 N on runs 4 through 9, so stay above that",
    ],
)
def test_a_number_that_counts_is_no_force(text: str) -> None:
    assert not read_contract(text, terms(), {}).refused


def test_a_force_that_is_denied_above_a_least_is_the_most() -> None:
    held = read_contract("Use at least 0.5 N and never 0.7 N.", terms(), {})
    assert held.terms.limit_n == pytest.approx(0.99 * 0.7)
    assert any("0.7 N" in note and "limit" in note for note in held.assumed)


MOSTS = (
    *("at most", "no more than", "less than", "below", "under", "up to", "max", "a maximum of"),
    *("never exceed", "do not exceed", "not above", "stay below", "keep it under", "beneath"),
    *("without exceeding", "limit it to", "capped at", "no higher than", "short of", "within"),
    *("lower than", "not beyond", "<", "<=", "≤", "avoid exceeding", "back off before"),
    *("the force must stay below", "the upper limit is", "it can take at most", "it breaks at"),
)
FILLERS = (
    *("", "about ", "~", "approx. ", "ca. ", "a force of ", "a total of ", "a gripping force of "),
    *("exactly ", "the ", "a mere ", "just ", "only ", "something like ", "a value of ", "maybe "),
)


@pytest.mark.parametrize("filler", FILLERS)
def test_words_between_a_bound_and_its_force_change_no_bound(filler: str) -> None:
    task = terms()
    lost = [
        text
        for most, frame in product(MOSTS, ("hold it, {}", "{}"))
        for text in (frame.format(f"{most} {filler}0.9 N"),)
        for held in (read_contract(text, task, {}),)
        if not held.refused and held.terms.limit_n > 0.9
    ]
    assert lost == []


BEHIND = (
    *("at most", "max", "tops", "or less", "and no more", "and never above", "(max)", "[max]"),
    *("as an upper bound", "is the limit", "is the most it can take", "is all it can take"),
    *("must not be exceeded", "is too much", "crushes it", "would hurt it", "or it breaks"),
    *("and not a newton more", "and nothing above", "; not more than that", ", not more"),
    *(", stay below it", ", that is the limit", ", more would bruise it", "- not more"),
)
BETWEEN = (
    *("", " of force", " of gripping force", " or so", " total", " in total", " of pressure"),
    *(" per finger", " each", " on the berry", " on it", " here", " please", " I think"),
)


@pytest.mark.parametrize("between", BETWEEN)
def test_words_between_a_force_and_its_bound_change_no_bound(between: str) -> None:
    task = terms()
    lost = [
        text
        for bound, frame in product(BEHIND, ("hold it: {}", "{}"))
        for text in (frame.format(f"0.9 N{between}{bound if bound[0] in ',;' else f' {bound}'}"),)
        for held in (read_contract(text, task, {}),)
        if not held.refused and held.terms.limit_n > 0.9
    ]
    assert lost == []
