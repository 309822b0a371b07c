"""Numbers that somebody reports."""

import pytest

from tacgrasp.lessons.understanding import understood_by_grammar


@pytest.mark.parametrize(
    ("question", "query"),
    [
        ("The display says 1 N. Is that right?", "check force about #1 N."),
        ("Someone wrote 0.1 mm in the log, is that correct?", "check depth about #1 mm."),
        ("Is the operator right that the force is 2 N?", "check force about #1 N."),
        ("Is the reported 2.2 N correct?", "check force about #1 N."),
        ("The supervisor noted 1 N. Can I sign that?", "check force about #1 N."),
        ("My colleague claims it is 0.1 mm deep. Is he wrong?", "check not depth about #1 mm."),
        ("The sheet reads 200 µm, correct?", "check depth about #1 µm."),
    ],
)
def test_a_reported_number_is_compared_with_what_is_felt(question, query):
    assert understood_by_grammar(question).query == query


@pytest.mark.parametrize(
    "question",
    [
        "The display says more than 1 N. Is that right?",
        "Is it correct that the indentation does not reach 0.8 mm?",
        "The label says 200 g. Is that right?",
    ],
)
def test_a_bound_or_a_mass_is_no_report(question):
    read = understood_by_grammar(question)
    assert read is None or "about" not in read.query


@pytest.mark.parametrize(
    ("question", "query"),
    [
        (
            "What is bigger: the distance to the left edge or to the right edge?",
            "calculate 'left' if x_mm > 0 else 'right'.",
        ),
        ("Which edge is farther, top or bottom?", "calculate 'top' if y_mm < 0 else 'bottom'."),
        ("Which edge is nearer, left or right?", "calculate 'left' if x_mm < 0 else 'right'."),
        ("Is the force in the band with 0.5 N less?",
         "calculate band_low_n <= (force_n - 0.5) <= band_high_n."),
        ("Would it be safe to lift with 0.5 N less?",
         "calculate band_low_n <= (force_n - 0.5) <= band_high_n."),
        ("Don't tell me the depth, tell me the force.", "amount force N."),
        ("Is it in the corner?",
         "calculate position in ['top-left', 'top-right', 'bottom-left', 'bottom-right']."),
        ("How many fingers hold it?", "unknown trait."),
        ("And what colour?", "unknown color."),
        ("Yes or no, nothing else: is anything touching you?", "check touched."),
        ("Is it an edge or a corner, yes or no?", "calculate shape in ['edge', 'corner']."),
    ],
)  # fmt: skip
def test_what_testers_found(question, query):
    assert understood_by_grammar(question).query == query
