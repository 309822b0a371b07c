"""What would be, and differences in other words, as expressions of the numbers felt."""

import pytest

from tacgrasp.lessons.dialogue.rewordings.supposed import supposed
from tacgrasp.lessons.understanding import understood_by_grammar


@pytest.mark.parametrize(
    ("question", "query"),
    [
        ("If the limit were 1 N lower, where would it lie?", "calculate limit_n - 1 in N."),
        ("If the limit were 300 mN higher, where would it lie?", "calculate limit_n + 0.3 in N."),
        (
            "If somebody increased the limit by 1 N, how much headroom would the grip have?",
            "calculate limit_n + 1 - force_n in N.",
        ),
        ("Is the sideways offset more than 0.5 cm?", "check offset_x > #1 mm."),
        ("Is the lateral offset less than 500 µm?", "check offset_x < #1 mm."),
        ("The force is under goal maximum, isn't it?", "calculate force_n < band_high_n."),
        (
            "Assuming somebody raised the limit by a quarter of a newton, how much headroom "
            "would your present grip have?",
            "calculate limit_n + 0.25 - force_n in N.",
        ),
        (
            "Had the limit been set 1 N lower, would the current force break it?",
            "calculate force_n > limit_n - 1.",
        ),
        (
            "Let go by ten percent and the force would be what, in newtons?",
            "calculate force_n * 0.9 in N.",
        ),
        (
            "Tighten by 20 % and the force would be what?",
            "calculate force_n * 1.2 in N.",
        ),
        (
            "Imagine that the berry slips two millimetres toward the fingertips; at which y "
            "would its contact then be centred?",
            "calculate y_mm - 2 in mm.",
        ),
        (
            "If the object slid 500 µm to the left, what would its x become?",
            "calculate x_mm - 0.5 in mm.",
        ),
        (
            "Measured from a point 2 mm above the pad's middle, how far off is the contact?",
            "calculate hypot(x_mm, y_mm - 2) in mm.",
        ),
        (
            "How much deeper or shallower than one millimetre is the dent, ignoring the sign?",
            "calculate abs(depth_mm - 1) in mm.",
        ),
        (
            "Should the contact patch shrink to half its present size, what percent of the pad "
            "would it still take up?",
            "calculate area_percent * 0.5 in %.",
        ),
        (
            "Is one newton a force that this task's goal band would accept?",
            "calculate band_low_n <= 1 <= band_high_n.",
        ),
        ("You're holding it too gently for this task, right?", "calculate force_n < band_low_n."),
        ("You're holding it too firmly for this task, right?", "calculate force_n > band_high_n."),
        ("Depth? Microns will do.", "amount depth µm."),
        ("Is it not so that the force is above 1 N?", "check force > #1 N."),
        ("Am I wrong that the surface is smooth?", "check not texture smooth."),
        ("Would you disagree if I said that the press is deep?", "check not depth deep."),
        (
            "Someone claims that the force is above 1 N. Is that false?",
            "check not force > #1 N.",
        ),
        ("Say mass. Grams. Over.", "amount mass g."),
        (
            "Apart from a sphere and an ellipsoid, is it some other shape that you feel?",
            "check not shape sphere; check not shape ellipsoid.",
        ),
        ("Report the grip force in units of millinewtons.", "amount force mN."),
        ("What indentation do you measure, in microns?", "amount depth µm."),
        ("What's the force limit? Answer in N.", "amount limit N."),
        ("What is the sideways offset in cm?", "calculate abs(x_mm) in cm."),
        ("At the moment, is the depth over 0.5 mm?", "check depth > #1 mm."),
        ("Are we sure the grip force is below 1 N?", "check force < #1 N."),
        ("Is the contact area anything but over 20 %?", "check not area > #1 %."),
        (
            "Is it lighter or heavier than a twenty gram bar of chocolate?",
            "calculate 'lighter' if mass_g < 20 else 'heavier'.",
        ),
        (
            "Where does the force stand within the band on a 0 to 1 scale?",
            "calculate (force_n - band_low_n) / (band_high_n - band_low_n) in 1.",
        ),
        (
            "Feather-light or firm - say feather-light if it's under half a newton",
            "calculate 'feather-light' if force_n < 0.5 else 'firm'.",
        ),
        (
            "Does the grip force exceed the object's weight force?",
            "calculate force_n > 0.00980665 * mass_g.",
        ),
        (
            "If I add half a newton, will it still be below the limit?",
            "calculate force_n + 0.5 < limit_n.",
        ),
        (
            "What do you get by subtracting the object's weight from the grip force, both in "
            "newtons?",
            "calculate force_n - 0.00980665 * mass_g in N.",
        ),
        (
            "Ten objects exactly like this one, put on a scale together, would have what mass?",
            "calculate mass_g + 9 * mass_g in g.",
        ),
    ],
)
def test_a_supposition_is_an_expression_of_what_is_felt(question: str, query: str) -> None:
    asked = understood_by_grammar(question)
    assert asked is not None
    assert asked.query == query


@pytest.mark.parametrize(
    "question",
    [
        "Is the force below the limit?",
        "If it slips, what then?",
        "The limit is 1 N. Is it over?",
        "To re-centre it, must the contact shift leftward or rightward?",
        "What is the force in newtons?",
    ],
)
def test_other_questions_are_left_as_they_are(question: str) -> None:
    assert supposed(question) == question
