"""Expressions in a truth's own names are what they say."""

import pytest

from tacgrasp.lessons.understanding import understood_by_grammar


@pytest.mark.parametrize(
    ("question", "query"),
    [
        ("force_n - band_low_n = ? in N, signed", "calculate force_n - band_low_n in N."),
        ("print(limit_n) # newtons", "calculate limit_n in N."),
        ("max(abs(x_mm), abs(y_mm)) == ? (mm)", "calculate max(abs(x_mm), abs(y_mm)) in mm."),
        ("x_mm < 0 ? 'left' : 'right'", "calculate 'left' if x_mm < 0 else 'right'."),
        ("force_n > 2 && depth_mm < 0.5", "calculate force_n > 2 and depth_mm < 0.5."),
        ("band_low_n <= force_n <= band_high_n", "calculate band_low_n <= force_n <= band_high_n."),
        ("100 * force_n / limit_n in %", "calculate 100 * force_n / limit_n in %."),
        ("what is force_n / limit_n?", "calculate force_n / limit_n in 1."),
        ("Math.hypot(x_mm, y_mm)", "calculate hypot(x_mm, y_mm) in mm."),
        ("limit_n - force_n, in mN", "calculate limit_n - force_n in mN."),
        (
            "return depth_mm * 1e3; // what's the value, in um?",
            "calculate (depth_mm * 1e3) / 1000 in µm.",
        ),
    ],
)
def test_an_expression_is_what_it_says(question: str, query: str) -> None:
    asked = understood_by_grammar(question)
    assert asked is not None
    assert asked.query == query


@pytest.mark.parametrize(
    "question", ["What does force_n mean?", "force_n.__class__", "open('force_n')", "force_n >"]
)
def test_what_is_none_is_not_evaluated(question: str) -> None:
    asked = understood_by_grammar(question)
    assert asked is None or not asked.query.startswith("calculate force_n")
