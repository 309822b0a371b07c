"""Questions that are read clause by clause: lists, verdicts, thresholds, and what is not felt."""

import pytest

from tacgrasp.lessons.dialogue.answers import answer
from tacgrasp.lessons.dialogue.clauses.clauses import clauses_of, judged_as_one, unfelt
from tacgrasp.lessons.dialogue.clauses.conditions import condition_of_statement
from tacgrasp.lessons.dialogue.clauses.plain_clause import numbered
from tacgrasp.lessons.dialogue.clauses.speech import asked_in_speech
from tacgrasp.lessons.dialogue.meaning import truth_of
from tacgrasp.lessons.dialogue.query import query_of
from tests.fakes.question_scenes import HELD


def read(question):
    return clauses_of(question, lambda text: None)


@pytest.mark.parametrize(
    ("statement", "condition"),
    [
        ("a cone pressed in by over 0.4 mm", "(shape == 'peak') and (depth_mm > 0.4)"),
        ("off centre by more than 3 mm", "hypot(x_mm, y_mm) > 3"),
        ("at least two millimetres left of the middle", "-x_mm >= 2"),
        ("the dent goes 500 µm down or more", "depth_mm >= 0.5"),
        ("it fills 15 % of the pad or more", "area_percent >= 15"),
        ("a full square centimetre or more is being touched", "area_mm2 >= 100"),
        ("more than half of your squishy thing is covered", "area_percent > 50"),
        ("over half of the sensing area remains bare", "100 - area_percent > 50"),
        ("we are not squeezing the bun with more than a newton and a half", "force_n <= 1.5"),
        ("pressing with over 100 g", "force_n > 0.980665"),
        ("the force is between 1 and 2 N", "min(1, 2) <= force_n <= max(1, 2)"),
        ("the force is above 2", "force_n > 2"),
        ("sure to hold a hundred grams", "holds_g >= 100"),
        ("0.3 kg, guaranteed no slip", "holds_g >= 300"),
        ("300 g will slip", "holds_g < 300"),
        ("the contact isn't clipped by the border", "not (cut)"),
        ("the left edge crops it", "cut_left"),
        ("the contact is whole", "not cut"),
        ("grip neither under nor over the range", "band_low_n <= force_n <= band_high_n"),
        ("the force is past its limit", "force_n > limit_n"),
        ("we have hit the limit", "force_n >= limit_n"),
        ("the force exceeds half of the permitted maximum", "force_n > 0.5 * limit_n"),
        ("nothing is on the pad", "not (contact)"),
        ("smooth, and either a ring or a disc", "(texture == 'smooth') and "
         "((shape == 'disc' or shape == 'ring'))"),
        ("the thing is on the left half of the pad", "x_mm < 0"),
        ("whole on the pad, without being rough", "(not cut) and (not (texture == 'rough'))"),
    ],
)  # fmt: skip
def test_each_condition_of_a_statement_counts(statement, condition):
    assert condition_of_statement(statement) == condition


@pytest.mark.parametrize(
    "statement",
    [
        "the pear's diameter is over 2 mm",
        "the temperature is above 2 N",
        "the friction force is above 2 N",
        "the berry is ripe and the force is above 2 N",
        "the cone is new and pressed by over 0.4 mm",
        "it is deeper than before",
        "not neither",
        "",
    ],
)
def test_a_word_without_a_meaning_here_leaves_none(statement):
    assert condition_of_statement(statement) == ""


@pytest.mark.parametrize(
    ("question", "truth"),
    [
        (
            "Is the force under 4 N while the contact spans upwards of 15 % of the pad?",
            "(force_n < 4) and (area_percent > 15)",
        ),
        (
            "A cone pressed in by over 0.4 mm: is that what we have here?",
            "(shape == 'peak') and (depth_mm > 0.4)",
        ),
        (
            "tick both boxes for me: off centre by more than 3 mm, and sure to hold 100 g. "
            "Both true?",
            "(hypot(x_mm, y_mm) > 3) and (holds_g >= 100)",
        ),
        (
            "My rule for hoisting is that something is touching and the force lies in its band: "
            "does this touch pass?",
            "(contact) and (band_low_n <= force_n <= band_high_n)",
        ),
        (
            "To sign off I need the contact whole and the force under its limit. Can I sign off?",
            "(not cut) and (force_n <= limit_n)",
        ),
        ("True or false: we're at less than a quarter of the 2 mm dent range.", "depth_mm < 0.5"),
        ("Acceptance criterion: distance from pad centre not above 2 mm. Pass?",
         "hypot(x_mm, y_mm) <= 2"),
        ("I say we're pressing harder than a newton. Am I wrong?", "not (force_n > 1)"),
        ("Isn't the force at least 1.5 newtons?", "force_n >= 1.5"),
        ("Over half of the sensing area remains bare, doesn't it?", "100 - area_percent > 50"),
        ("We're not over two newtons, are we?", "not (force_n <= 2)"),
        ("I want no more than 800 millinewtons on this tissue. Have we exceeded that?",
         "force_n > 0.8"),
        ("I'm aiming for a depth of 0.4 to 1.2 mm; do we meet that?", "0.4 <= depth_mm <= 1.2"),
        ("The spec asks for between 1 and 2 N. Are we outside it?", "not (1 <= force_n <= 2)"),
        ("The plaster may bear 0.9 N at the very most; are we beneath that figure?",
         "force_n < 0.9"),
        ("Minimum contact is 10 % of the pad. Do we meet it?", "area_percent >= 10"),
        ("These crack at 4 N. Haven't we passed that?", "force_n <= 4"),
        ("Anything above 700 mN bruises these. Are we safe?", "force_n <= 0.7"),
        ("This jar is 320 g. Can the grip hold it for certain?", "holds_g >= 320"),
        ("The pot weighs half a kilo. Will it slip?", "holds_g < 500"),
    ],
)  # fmt: skip
def test_what_is_stated_gets_one_verdict(question, truth):
    assert truth_of(read(question)) == truth


@pytest.mark.parametrize(
    ("question", "query"),
    [
        (
            "In one sentence, say what form the object has, whereabouts it touches and how many "
            "newtons we're applying.",
            "word shape; word position; amount force N.",
        ),
        (
            "First tell me whether anything is in contact; then how far the gel is pressed in, "
            "in µm.",
            "calculate contact; amount depth µm.",
        ),
        (
            "Are we over the force limit, does the pad's edge cut the contact, and how many grams "
            "would the grip surely hold?",
            "calculate force_n > limit_n; calculate cut; amount holds g.",
        ),
        ("Rundown please: form, feel, grip force in newtons.",
         "word shape; word texture; amount force N."),
        ("dump: force N, depth mm, band status",
         "amount force N; amount depth mm; word force_band."),
        ("log line: band verdict | force (mN) | force limit",
         "word force_band; amount force mN; amount limit N."),
        ("How far off centre are we, how far in are we, both in microns?",
         "amount distance µm; amount depth µm."),
        ("Shape first, then texture, then how many millinewtons we're on.",
         "word shape; word texture; amount force mN."),
        ("Report contact yes/no, force N, in band yes/no.",
         "calculate contact; amount force N; calculate band_low_n <= force_n <= band_high_n."),
    ],
)  # fmt: skip
def test_all_that_a_list_asks_for_is_read_in_its_order(question, query):
    assert query_of(read(question)) == query


@pytest.mark.parametrize(
    "question",
    [
        "Ratio: force, depth",
        "Which is larger: x, y?",
        "shape, colour, force in newtons",
        "The force, is it above 2 N?",  # one thing
        "How deep is it, in µm and mm?",
        "Going by the mass, is it heavy?",
        "rough or smooth?",  # a choice
        "Is it a sphere or a cube?",
        "depth, depth in µm",
        "Does exactly one hold, force over 2 N or depth over 1 mm?",
        "Is the force more than 5 N per mm?",
        "Would 30 % more be too much?",
    ],
)
def test_what_is_no_list_and_no_verdict_is_left(question):
    assert read(question) is None


@pytest.mark.parametrize(
    ("question", "query"),
    [
        ("Does the skin seem feverish to you?", "unknown temperature."),
        ("Has this loaf got rye in it?", "unknown inside."),
        ("How old do you reckon the little guy is?", "unknown age."),
        ("How much did this thing cost us per unit?", "unknown price."),
        ("Is that my bracket you're gripping or Marta's?", "unknown owner."),
        ("Which of my kids broke this?", "unknown past."),
        ("tulip bulb or daffodil bulb, I mixed up the bags", "unknown name."),
        ("Has the lander's battery still got more than sixty percent?", "unknown electricity."),
        ("How much sugar has it got per 100 g?", "unknown inside."),
        ("Write a Python function that reverses a linked list.", "other."),
        ("Book me a table for two at eight.", "other."),
    ],
)
def test_what_touch_cannot_know_of_peoples_things(question, query):
    assert query_of(unfelt(question)) == query


@pytest.mark.parametrize(
    "question",
    [
        "Is the red one round?",
        "Is it soft and ripe?",
        "How old is the universe?",
        "Write the force down.",
        "Is the force more than a battery weighs?",
        "Is the water bottle touched?",
        "Is the battery pack pressed deeper than 1 mm?",
    ],
)
def test_what_may_be_felt_or_is_of_no_thing_is_none_of_these(question):
    assert unfelt(question) is None


@pytest.mark.parametrize(
    ("speech", "asked"),
    [
        (
            "Three drops this week, so before we lift it I have to ask: is the force too low?",
            "is the force too low?",
        ),
        ("Is it deeper than 1 mm? I never know with these.", "Is it deeper than 1 mm?"),
        (
            "careful these bruise like nothing, you're not squeezing it with a newton are you",
            "you're not squeezing it with a newton, are you?",
        ),
        ("The kettle's on and I'm in a rush. Is it over its limit?", "Is it over its limit?"),
    ],
)
def test_what_tells_of_circumstances_is_left_out(speech, asked):
    assert asked in list(asked_in_speech(speech))


@pytest.mark.parametrize(
    "speech",
    [
        "It weighs 30 g. Is it safe?",
        "Only the left edge counts. Is it cut?",
        "The force, is it above 2 N?",
        "If it slips, is it too heavy?",
    ],
)
def test_what_bears_on_the_question_stays(speech):
    assert not list(asked_in_speech(speech))


def test_conditions_that_are_to_hold_at_once_get_one_verdict():
    question = "Would both of these be right: deeper than half a millimetre, wholly on the pad?"
    meaning = judged_as_one(question)
    assert truth_of(meaning) == "(depth_mm > 0.5) and (not cut)"
    assert answer(meaning, HELD).text == "No, the depth is 0.19 mm."
    assert judged_as_one("Is it deep? Is it round?") is None


def test_numbers_of_a_clause_are_numbered():
    assert numbered("less then a quater of the senser, or 2 mm") == (
        "less than #1 percent of the sensor or #2 millimetre",
        (25.0, 2.0),
    )
