"""A bound that nothing reads is no wish: the text is refused, or held within the bound."""

import pytest

from policies.contract import read_contract
from tacgrasp.config.layers import load
from tacgrasp.config.terms import task_terms

TASK = task_terms(load("strawberry")[0])

MOST = [
    ("Nine hundred millinewtons is allowed: not a whisker above.", 0.9),
    ("0.7 N and 30 mm: the former is your upper limit, the latter the berry's width.", 0.7),
    ("Maximum force? 1.7 N. Weight? 20 grams. Temperature? 4 degrees.", 1.7),
    ("Out of 12 g, 1.4 N and 5 s only the force is a limit: don't exceed it.", 1.4),
    ("1100 millinewtons is the point of no return for the skin. Don't reach it.", 1.1),
    ("We used to allow 1.8 N; since Monday it's 1.4 N, and nothing above is accepted.", 1.4),
    ("At 1.55 N my colleague's berry burst. That is too much, so remain lower.", 1.55),
    ("On the newton dial, don't let the needle swing past 2.0.", 2.0),
    ("What's the most it can take? 1.1 N. Then you know your upper limit.", 1.1),
    ("The most froce it may feel is 1.4 N.", 1.4),
    ("We agred on a cap for the gripp. Its 1.2 N.", 1.2),
    ("The fruit has been frozen: 0.7 N is its breaking point; be lower than that.", 0.7),
    ("At no time, whatever happens, go over 1.25 N.", 1.25),
    ("Never, and I mean never, go above 1.25 N.", 1.25),
    ("You are not, repeat not, to go over 1.25 N.", 1.25),
    ("It should not, in my opinion, feel more than 1.25 N.", 1.25),
    ("You shouldn't ever, not in a million years, use more than 1.25 N.", 1.25),
    ("Under no circumstances, even if it slips a bit, use more than 3.4 N.", 3.4),
    ("Not for one second should you, even by accident, go over 1.25 N.", 1.25),
    ("Nothing, but nothing, above 1.25 N.", 1.25),
    ("On no account, not even briefly, squeeze with more than 1.25 N.", 1.25),
    ("The 1.6 N we used in the pilot crushed every berry we picked. Pick up this one.", 1.6),
]
LEAST = [
    ("Don't drop it, use more than 1 N.", 1.0),
    ("0.6 N and 45 mm; the former is the least grip I accept, the latter how far to lift.", 0.6),
    (
        "By weak I mean anything short of 0.9 N, so never weaker than that.",
        0.9,
    ),
    ("With a hold looser than 0.6 N the berry is as good as lost.", 0.6),
    ("Too gentle is under 0.5 N, too rough is over 1.4 N. Be neither.", 0.5),
    ("You may squeeze with 0.7 N or anything stronger, but nothing feebler.", 0.7),
]
READ = [
    ("Mind the leaves and use 0.9 N.", 0.9),
    ("Use 1 N on the bruised one.", 1.0),
    ("Hold it with 0.9 N for a minute.", 0.9),
    ("1 N. Don't go over the edge of the table.", 1.0),
    ("Hold with 0.8 N, no more and no less.", 0.8),
    ("force: 0.8 N; mass: 20 g", 0.8),
]


@pytest.mark.parametrize(("text", "most_n"), MOST)
def test_no_limit_is_taken_for_a_wish(text: str, most_n: float) -> None:
    contract = read_contract(text, TASK, {})
    assert contract.refused or contract.limit_n <= 1.001 * most_n


@pytest.mark.parametrize(("text", "least_n"), LEAST)
def test_no_least_force_is_taken_for_a_limit(text: str, least_n: float) -> None:
    contract = read_contract(text, TASK, {})
    assert contract.refused or contract.force_n.low >= least_n


@pytest.mark.parametrize(("text", "value_n"), READ)
def test_words_of_other_things_bound_nothing(text: str, value_n: float) -> None:
    contract = read_contract(text, TASK, {})
    assert not contract.refused
    assert contract.force_n.low < value_n < contract.force_n.high
