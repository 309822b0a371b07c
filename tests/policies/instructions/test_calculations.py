"""Forces are worked out from others that a text names, or it is refused."""

import pytest

from policies.instructions.reader import read_request


def values(text):
    return [round(f.value_n, 6) for f in read_request(text).numbers.forces if f.kind == "value"]


@pytest.mark.parametrize(
    "text",
    [
        "Halfway between 0.4 N and 0.8 N.",
        "The mean of 500 and 700 mN.",
        "Take 0.8 N, derate by 25 percent.",
        "Yesterday 0.8 N; knock a quarter off that today.",
        "The dummy gets 1.2 N, the fruit half of that.",
        "Rated for 3 N. Use 20 % of that.",
        "Preload of 0.4 N plus a further 200 mN for the lift.",
        "Take 0.4 N and add another 0.2 N on top.",
        "Deduct 0.2 N from 0.8 N.",
        "0.4 N slipped, give it half as much again.",
        "A third of the way from 0.5 N to 0.8 N.",
    ],
)
def test_a_force_is_worked_out(text: str) -> None:
    assert values(text) == [0.6]


@pytest.mark.parametrize("text", ["0.8 N, but knock nothing off that.", "0.8 N, lift it by 20 mm."])
def test_what_changes_no_force_leaves_it(text: str) -> None:
    assert values(text) == [0.8]


@pytest.mark.parametrize(
    "text",
    [
        "0.8 N, knock a bit off that.",
        "0.8 N; if it slips, raise it by 0.1 N.",
        "A fraction of 1 N.",
    ],
)
def test_a_change_that_is_not_sure_is_reported(text: str) -> None:
    assert read_request(text).numbers.unread


def test_a_bound_stays_beside_its_multiple() -> None:
    forces = read_request("At least 0.5 N, at most twice that.").numbers.forces
    assert [(f.kind, f.value_n) for f in forces] == [("least", 0.5), ("most", 1.0)]
