"""Constructions that are read by a plainer one of the same meaning."""

import pytest

from tacgrasp.lessons.dialogue.answers import answer
from tacgrasp.lessons.dialogue.rewordings.reworded import reworded
from tacgrasp.lessons.turns.told import told_in
from tacgrasp.lessons.understanding import understood_by_grammar
from tests.fakes.question_scenes import FIRM, HELD, LIGHT


def query(question):
    read = understood_by_grammar(question)
    return read.query if read else ""


@pytest.mark.parametrize(
    ("question", "expected"),
    [
        ("Is it not unsafe to lift?", "check force within."),
        ("Would it be not at all dangerous to lift?", "check force within."),
        ("Do you deny that something is touching the pad?", "check not touched."),
        ("Are we using less than a quarter of our allowance?", "check used < #1 %."),
        ("Is the grip at more than half of what it's allowed?",
         "calculate force_n > 0.5 * limit_n."),
        ("Would it be correct to say that the force neither falls below nor exceeds the agreed "
         "band?", "calculate band_low_n <= force_n <= band_high_n."),
        ("Setting aside shape and texture, where does it touch?", "choice position."),
        ("I'm not asking about its colour. I'm asking what shape it is.", "word shape."),
        ("I was born in 1941, I have three grandchildren, and I want to know if it's rough.",
         "check texture rough."),
        ("Is the contact patch bigger than a 1-cent coin, i.e. 207 mm²?", "check area > #1 mm²."),
        ("Is it a circle thing like a doughnut?", "check shape ring."),
        ("edge cut? which", "word cut_sides."),
        ("Ignoring the band, the limit and my feelings, how many newtons is it?",
         "amount force N."),
        ("The card says never squeeze an egg past 2.5 newtons, 6 minutes boil. Have I?",
         "check force > #1 N."),
        ("Something there and dug in more than a tenth of a mill?",
         "calculate (contact) and (depth_mm > 0.1)."),
        ("The force isn't as much as three times the band's lower end, is that right?",
         "calculate force_n < 3 * band_low_n."),
        ("Relative to the cutoff you mustn't cross: over or under?",
         "calculate 'over' if force_n > limit_n else 'under'."),
        ("Would it be unwise to lift?", "check not force within."),
        ("Is the animal breathing?", "unknown trait."),
        ("If the grip were doubled, how many grams would it hold?",
         "calculate 2 * force_n / gram_n in g."),
        ("force, depth, area - three numbers",
         "amount force N; amount depth mm; amount area %."),
        ("The force is too small, or?", "check force below."),
        ("is it ruogh or smoth or neither",
         "calculate 'rough' if texture == 'rough' else 'smooth' if texture == 'smooth' else "
         "'neither'."),
        ("assert 0.1 < depth_mm < 0.5 - would that pass?",
         "calculate min(0.1, 0.5) <= depth_mm <= max(0.1, 0.5)."),
    ],
)  # fmt: skip
def test_a_construction_is_read_by_its_plainer_one(question, expected):
    assert query(question) == expected


@pytest.mark.parametrize(
    ("question", "expected"),
    [
        ("Is the ratio limit : force greater than 1.5?", "calculate limit_n / force_n > 1.5."),
        ("How many times its own weight is the grip force on this object?",
         "calculate force_n / (0.00980665 * mass_g) in 1."),
        ("What mass in grams would weigh as much as this grip presses?",
         "calculate force_n / 0.00980665 in g."),
        ("How many % above the lower band end is the force?",
         "calculate 100 * (force_n - band_low_n) / band_low_n in %."),
        ("Does the grip need at least another 0.3 N to reach the band?",
         "calculate band_low_n - force_n >= 0.3."),
        ("How much grip is required for the given mass, and do we have it?",
         "amount needed N; check stays given."),
        ("My last one read 2.3 newton. How far off is this one from that?",
         "calculate abs(force_n - 2.3) in N."),
        ("Is the force more than 0.3 N below the band?", "calculate band_low_n - force_n > 0.3."),
        ("If I quartered the force, what would remain, in mN?", "calculate 0.25 * force_n in mN."),
    ],
)  # fmt: skip
def test_what_is_compared_is_named_in_other_words(question, expected):
    assert query(question) == expected


@pytest.mark.parametrize(
    ("question", "words"),
    [
        ("tighten or loosen?", ("Neither", "Loosen", "Tighten")),
        ("Does it need more pressure or less, or is it fine?",
         ("Fine", "Less", "More pressure")),
        ("Should I squeeze harder or ease off?", ("Neither", "Ease off", "Squeeze harder")),
        ("Reject if depth > 0.8 mm. Reject or accept?", ("Accept", "Reject", "Accept")),
        ("Anything over 2 N is a fail. Pass or fail?", ("Pass", "Fail", "Pass")),
        ("Would you say it's shallow or deep? I'd call anything under a tenth of a millimetre "
         "shallow.", ("Deep", "Deep", "Shallow")),
        ("Which is further from the force, the limit or the lower end of the band?",
         ("Limit", "Lower end of the band", "Limit")),
        ("Which is the smallest: the force, the limit or 1.25 N?",
         ("Force", "Limit", "Force")),
        ("He asked whether it can tell a ball from a cube - which of the two is it, or neither?",
         ("Neither", "Neither", "Neither")),
    ],
)  # fmt: skip
def test_answers_have_the_words_of_the_question(question, words):
    read = understood_by_grammar(question)
    said = [answer(read.meaning, scene).text for scene in (HELD, FIRM, LIGHT)]
    assert [each.rstrip(".").split(":")[0] for each in said] == list(words)


@pytest.mark.parametrize(
    "question",
    [
        "Is it deep?",
        "It's not unsafe to lift, is it?",
        "Setting aside the sign, how far is it sideways?",
        "Is it harder or softer?",
        "Ignoring its direction, how far is it sideways?",
        "Reject if depth > 0.8 mm. Wood or steel?",
        "If it weighs 30 g, I want to know if it slips.",
        "Is the force 2 N, i.e. more than the limit?",
    ],
)
def test_other_questions_stay(question):
    assert reworded(question) == ""


@pytest.mark.parametrize(
    ("text", "asked"),
    [
        ("My hamster weighs 30 grams could you hold it", "could you hold it"),
        ("Is it going to slip? It's the 30 gram one.", "Is it going to slip?"),
    ],
)
def test_a_mass_is_heard_beside_a_question_that_it_runs_into_or_follows(text, asked):
    told, rest = told_in(text)
    assert (told.mass_g, rest) == (30.0, asked)
