"""Forces that a text states without asking for them are no wishes; those that it asks for are."""

import pytest

from policies.instructions.reader import read_request
from policies.instructions.statements import without_statements


@pytest.mark.parametrize(
    "text",
    [
        "The display showed 1.5 N.",
        "The needle swung to 4.4 newtons when I closed the drawer.",
        "My other robot grips at 2 N.",
        "A crab can pinch with 3.8 newtons, fancy that.",
        "1 N makes it bleed.",
        "1 N goes straight through the skin.",
        "With 1.5 N the peach weeps juice all over the place.",
        "0.9 N would be the death of this macaron.",
        "2 N is cruel.",
        "One newton was fine yesterday.",
        "Put 1.9 N on it and it'll squirt across the room.",
        "Oh sure, use 5 N, great idea.",
        "Use 2 N - hm, too much.",
        "Hold the fig at 1.2 N - just kidding!",
        "Grip it at 2 newtons, actually forget I said so.",
        "I'm scared you'll put 3 N on my strawberry.",
        "I am not asking you for 1.5 newtons.",
        "Nobody said anything about 2 N.",
        "They say 1.2 N does the trick, but people say all sorts.",
        "Maybe 1.2 newtons, maybe not.",
        '"Hold it with 2 N" was printed on the box of a different product.',
        "If Martha has signed the form, hold the egg with 1.4 N.",
        "Use 2 N unless it is a strawberry.",
        "Use 2 N provided the fruit was picked before Sunday.",
        "Don't hold the plum with 1.8 N.",
        "1.5 N is what I asked for yesterday; today I want less",
        "Last week I wanted 2 N. This time I want less than that.",
        "You are at 2 N, go lower",
        "I can squeeze with 2 N",
        "Use 2 N tomorrow",
        "2 N? Are you crazy?",
        "The other operator wants 2 N",
        "To crush it takes 2 N",
        "Don't squash it with 2 N",
        "Wonderful, another 2.5 N masterpiece on the floor.",
    ],
)
def test_a_force_that_is_only_stated_is_refused(text: str) -> None:
    request = read_request(text)

    assert request.refused or (request.numbers.denied and not request.numbers.forces)


@pytest.mark.parametrize(
    ("text", "values"),
    [
        ("1.2 N on the berry, please", [1.2]),
        ("Cuvette, 0.8 N", [0.8]),
        ("1.65 N is what I would choose, so take it with that.", [1.65]),
        ("My supervisor says 1.6 N, so hold it with 1.6 N.", [1.6, 1.6]),
        ("My readers want to see 1.8 N. Go ahead.", [1.8]),
        ("Hold it so that the force gauge reads 1.85 newtons.", [1.85]),
        ("Nab the wee Lego man wi' 1.8 newtons", [1.8]),
        ("Hold it firmly, with 3.2 N, because the belt jumps.", [3.2]),
        ("The sensor calibration needs a steady 2 N grip on this one.", [2.0]),
        ("Use 1 N if you can", [1.0]),
        ("Use 0.8 N... no wait, sorry, I misread my own notes, 0.9 N.", [0.9]),
    ],
)
def test_a_force_that_is_asked_for_is_read(text: str, values: list[float]) -> None:
    request = read_request(text)

    assert not request.refused
    assert [force.value_n for force in request.numbers.forces] == pytest.approx(values)


@pytest.mark.parametrize(
    ("text", "value_n"),
    [
        ("Robot B grips at 2 N; you stick to 1 N on the plum.", 1.0),
        ("Display said 2.1 N, but I want 1.4 N on the lemon.", 1.4),
        ("I dread 2 N on the tomato, so keep it under 1 N.", 1.0),
        ("In theory one could try 3 N, but in practice grip the lime with 2 N.", 2.0),
    ],
)
def test_a_wish_beside_a_stated_force_is_the_wish(text: str, value_n: float) -> None:
    request = read_request(text)

    assert not request.refused
    assert [force.value_n for force in request.numbers.forces] == pytest.approx([value_n])


@pytest.mark.parametrize(
    "text",
    [
        "The screen still says 1.5 N from the previous job, ignore that and pick up the berry.",
        "Pick up the apple that weighs 1.5 N.",
        "Put the strawberry beside the 2 N test weight.",
        "The press next door works at 4 N. You just pick that strawberry up.",
    ],
)
def test_a_force_of_something_else_leaves_the_force_to_the_task(text: str) -> None:
    request = read_request(text)

    assert not [force for force in request.numbers.forces if force.kind != "most"]


@pytest.mark.parametrize(
    ("text", "kind"),
    [
        ("Hold the strawberry with höchstens 0.9 N.", "most"),
        ("Pick up the lemon with mindestens 1.5 N please.", "least"),
        ("Grab the pear with au moins 1 N.", "least"),
        ("Lift the tomato with al massimo 1.4 N.", "most"),
        ("Hold the egg, no más de 0.7 N.", "most"),
    ],
)
def test_bounds_in_other_languages_are_bounds(text: str, kind: str) -> None:
    assert [force.kind for force in read_request(text).numbers.forces] == [kind]


@pytest.mark.parametrize(
    "text",
    [
        "The operator wants 1 N",
        "The grower needs 1 N for this one",
        "As I said before, 1 N",
        "Use 1 N, it worked yesterday",
        "Hold it with 1 N, softer than last time",
        "We are at 2 N, go to 1 N",
        "Squish it a wee bit, like 1 N",
        "I'd be grateful for 1 N",
    ],
)
def test_what_is_wished_is_carried_out(text: str) -> None:
    request = read_request(text)

    assert [(force.kind, force.value_n) for force in request.numbers.forces] == [("value", 1.0)]
    assert request.refused == ""


@pytest.mark.parametrize(
    "text",
    [
        "Grab the berry unless it is 4 pm",
        "If it is ripe, pick it",
        "Pick it only if the boss agrees",
        "As long as it is red, pick it",
        "Hold it at most with 1 N if it is ripe",
    ],
)
def test_a_request_under_a_condition_that_cannot_be_looked_at_is_refused(text: str) -> None:
    assert "is a condition that a gripper can't check" in read_request(text).refused


@pytest.mark.parametrize(
    "text",
    [
        "Grab the berry if you can",
        "Pick the berry unless told otherwise",
        "Pick it even if it rains",
        "If in doubt, hold it gently",
        "Be gentle, my boss gets angry if the berry is bruised",
        "Hold it tighter if it slips",
    ],
)
def test_what_is_no_condition_of_a_request_is_carried_out(text: str) -> None:
    assert read_request(text).refused == ""


def test_what_is_stated_is_named() -> None:
    found = without_statements("robot b grips at 2 n; you stick to 1 n on the plum.")

    assert found.words == "robot b grips at 2 n"
    assert "2 n" not in found.rest
    assert "1 n" in found.rest
