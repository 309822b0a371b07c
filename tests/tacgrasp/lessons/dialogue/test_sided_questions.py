import pytest

from tacgrasp.lessons.dialogue.sided_questions import to_named_side


@pytest.mark.parametrize(
    ("words", "query", "turned"),
    [
        ("how far left is it", "amount x µm.", "amount leftward µm."),
        ("how far is it to the left", "amount x mm in a word.", "amount leftward mm in a word."),
        ("how far down is it", "amount y mm.", "amount tipward mm."),
        ("how far to the left minus for the right", "amount x mm.", "amount leftward mm."),
        ("how far off left counted as plus", "amount x mm.", "amount leftward mm."),
        ("over # mm below the middle", "check y > #1 mm.", "check y < -#1 mm."),
        ("not at most # mm left", "check not x <= #1 mm.", "check not x >= -#1 mm."),
        (
            "how far left and down",
            "amount x mm; amount y mm.",
            "amount leftward mm; amount tipward mm.",
        ),
    ],
)
def test_a_query_counts_to_the_side_that_is_named(words, query, turned):
    assert to_named_side(query, words) == turned


@pytest.mark.parametrize(
    ("words", "query"),
    [
        ("how far right is it", "amount x mm."),
        ("how far left or right is it", "amount x mm."),
        ("how far left counting as negative", "amount x mm."),
        ("how far to the right minus for the left", "amount x mm."),
        ("how far along x right is positive left is negative", "amount x mm."),
        ("is x below # mm", "check x < #1 mm."),
        ("is y below # mm", "check y < #1 mm."),
        ("how far down is it and how deep", "amount depth mm."),
    ],
)
def test_what_names_both_sides_a_sign_or_the_other_side_stays(words, query):
    assert to_named_side(query, words) == query
