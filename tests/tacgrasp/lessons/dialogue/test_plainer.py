"""Questions without address, thanks and tags, in metric units."""

import pytest

from tacgrasp.lessons.dialogue.plainer import plainer
from tacgrasp.lessons.dialogue.rules.unread import is_beyond


@pytest.mark.parametrize(
    ("question", "plain"),
    [
        ("Hang on, isn't something pressing on it?", "is something pressing on it?"),
        ("We haven't gone past 1 mm, have we?", "have We gone past 1 mm?"),
        ("There's nothing on the pad, is there?", "is There anything on the pad?"),
        ("The finish isn't rough, or is it?", "is The finish rough?"),
        ("It isn't a cylinder, is it?", "is It a cylinder?"),
        ("A 50 g part won't slip, will it?", "will A 50 g part slip?"),
        ("You're not pushing over 4 N, are you?", "are You pushing over 4 N?"),
        ("That's a cylinder, isn't it?", "is That a cylinder?"),
        ("It'll slide out, won't it?", "will It slide out?"),
        ("They’d fit in the band, wouldn’t they?", "would They fit in the band?"),
        ("We'll not be over 2 N, will we?", "will We be over 2 N?"),
        ("Force in mN pls", "Force in mN"),
        ("I'm not going to drop it, am I?", "am I going to drop it?"),
        ("1500 mN over limit?", "is 1500 mN over limit?"),
        ("5 N past max?", "is 5 N past the limit?"),
        ("5 N exceeds the limit?", "does 5 N exceeds the limit?"),
        ("2 N over the left edge?", "2 N over the left edge?"),
        ("Is 1 N <= force < 3 N?", "Is force between 1 N and 3 N?"),
        ("3 N > F > 1 N?", "the force between 1 N and 3 N?"),
        ("Is 3 N > F?", "is the force less than 3 N?"),
        ("Is it ~2 N?", "Is it about 2 N?"),
        ("How far is it to the nearest edge?", "How far is it to the nearest edge?"),
        ("Could I trouble you for the depth?", "give me the depth?"),
        ("Give me the force, so I may put it into the report", "Give me the force"),
        ("Is it over 0.5 pounds?", "is it over 226.8 grams?"),
        ("Is it over 0.05 kgf?", "is it over 0.4903 newtons?"),
        ("Is it over 0.001 kN?", "is it over 1 newtons?"),
        ("Is it deeper than 10 thou?", "is it deeper than 0.254 mm?"),
        ("Is it deeper than 0.1 m?", "is it deeper than 100 mm?"),
        ("Am I over 5 nm?", "am i over 0.000005 mm?"),
        ("Is the patch over 2 sq. cm?", "is the patch over 200 mm²?"),
        ("Is it deeper than a tenth of an inch?", "is it deeper than 2.54 mm?"),
    ],
)
def test_what_does_not_change_the_question_is_left_out(question, plain):
    assert plainer(question) == plain


@pytest.mark.parametrize(
    "question",
    [
        "Is it not deep?",
        "It is not deep, right?",
        "How deep is it?",
        "Is it a cylinder or a ring?",
        "Left or right, and palm or tip?",
        "How wide is the band, in newtons?",
        "I can't tell whether this is a sphere or a ring; can you?",
        "please",
        "",
    ],
)
def test_other_questions_stay(question):
    assert plainer(question) == question


def test_pressures_and_strange_multiples_are_beyond_every_query():
    assert is_beyond("Is the pressure above 10 kPa?")
    assert is_beyond("Would ten times that be too much?")
    assert not is_beyond("Would twice that be too much?")
    assert not is_beyond("Is the pressure above 2 N?")
