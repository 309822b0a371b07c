"""What the questions of a dialogue mean, one after another."""

from __future__ import annotations

import pytest

from tacgrasp.lessons.answering import answered
from tacgrasp.lessons.dialogue.meaning import Calculated
from tacgrasp.lessons.dialogue.query import read_query
from tacgrasp.lessons.read_question import ReadQuestion
from tacgrasp.lessons.turns import turn as turns
from tacgrasp.lessons.turns.follow_ups import difference_of, reason_of
from tacgrasp.lessons.turns.turn import Turn, next_turn
from tacgrasp.lessons.understanding import understood_by_grammar
from tests.fakes.question_scenes import HELD

MOVED = "calculate action in ['move_up', 'move_down', 'move_left', 'move_right']."


IN_AFTER = "calculate band_low_n <= (force_n + 0.5) <= band_high_n."
HOLDS = "check stays given."
HOLDS_IT = "calculate force_n >= 0.0205 * mass_g."
TWICE = "calculate (2 * force_n) / gram_n in g."


class Refusing:
    """A model that must not be asked."""

    width = 8

    def reply_to(self, touch, prompt, *, grammar):
        pytest.fail(f"the model was asked {prompt!r}", pytrace=False)  # a grammar's repr is endless


def last_turn(*questions: str) -> Turn:
    """The turn of the last of some questions."""
    turn = Turn()
    for question in questions:
        turn = next_turn(Refusing(), question, turn)
    return turn


def answers(*questions: str) -> str:
    """The answer to the last of some questions about what is held."""
    return answered(last_turn(*questions).read, HELD).answer.text


@pytest.mark.parametrize(
    ("before", "question", "query"),
    [
        ("How deep is it?", "And in microns?", "amount depth µm."),
        ("Is it above the limit?", "By how much?", "calculate abs(force_n - (limit_n)) in N."),
        (
            "Is the force within the band?",
            "by how much",
            "calculate max(0, band_low_n - force_n, force_n - band_high_n) in N.",
        ),
        (
            "Is it deeper than 0.2 mm?",
            "How much less?",
            "calculate abs(depth_mm - (0.2)) in mm.",
        ),
        (
            "How far is it from the middle?",
            "And from the left edge?",
            "calculate pad_width_mm / 2 + x_mm in mm.",
        ),
        ("Is the force above 1 N?", "And below the limit?", "check force under."),
        ("Is it in the left half?", "And in the top half?", "check top."),
        ("How deep is it in microns?", "Is that more than 50?", "check depth > #1 µm."),
        ("What is the force in grams?", "Is it more than 100?", "check force > #1 g."),
        ("What if I add 0.2 N?", "And 0.9 N?", "calculate force_n + 0.9 in N."),
        ("What if I add 0.9 N?", "Is that over the limit?", "calculate force_n + 0.9 > limit_n."),
        (
            "If I double the force, is it over the limit?",
            "and if I halve it?",
            "calculate 0.5 * force_n > limit_n.",
        ),
        ("What is the limit?", "Are we over it?", "check force over."),
        ("What is the limit?", "How much of it do we use?", "amount used %."),
        ("What is the band?", "Are we in it?", "check force within."),
        ("Does it touch the left edge?", "And the right?", "check cut right."),
        ("Does it run off the pad?", "Which edge?", "word cut_sides."),
        ("Which edge cuts it?", "And the left one?", "check cut left."),
        ("What next?", "how far?", "amount distance mm."),
        (
            "How much force is needed for 100 g?",
            "Would that break the limit?",
            "calculate gram_n * 100 > limit_n.",
        ),
        ("Will it hold 60 g?", "and 65?", "check stays #1 g."),
    ],
)
def test_a_follow_up_is_completed_by_the_question_before_it(before, question, query):
    assert last_turn(before, question).read.query == query


@pytest.mark.parametrize(
    ("questions", "query"),
    [
        (
            ("What if I add 0.2 N?", "Is that over the limit?", "And 0.9 N?"),
            "calculate force_n + 0.9 > limit_n.",
        ),
        (
            ("How far is it from the right edge?", "and from the left?", "and from the top?"),
            "calculate pad_height_mm / 2 - y_mm in mm.",
        ),
        (
            ("Is it below the limit?", "by how much?", "in grams?"),
            "calculate (abs(force_n - (limit_n))) / 0.00980665 in g.",
        ),
    ],
)
def test_several_follow_ups_in_a_row_lose_nothing(questions, query):
    assert last_turn(*questions).read.query == query


@pytest.mark.parametrize(
    ("questions", "query"),
    [
        # the number before
        (("What is the limit?", "Is that more than 2 N?"), "calculate limit_n > 2."),
        (
            ("How deep, in microns?", "What would half of that be?"),
            "calculate 0.5 * depth_mm in µm.",
        ),
        (
            ("What is the force?", "And with 10 % more?"),
            "calculate (1 + 10 / 100) * force_n in N.",
        ),
        (
            ("What is the force?", "twice as hard would be?", "Triple?"),
            "calculate 3 * force_n in N.",
        ),
        (("What is x in mm?", "and y?", "sum of both?"), "calculate x_mm + y_mm in mm."),
        (
            ("What is the middle of the band?", "How far are we from that?"),
            "amount off_middle N.",
        ),
        (
            ("What is the force in grams?", "More than 100?"),
            "calculate (force_n) / 0.00980665 > 100.",
        ),
        (
            ("How much force is needed for 60 g?", "Do we have that much?"),
            "calculate force_n >= (gram_n * 60).",
        ),
        (
            ("What percentage of the limit is used?", "half of that?"),
            "calculate 0.5 * (100 * force_n / limit_n) in %.",
        ),
        (
            ("How far are we below the limit?", "what would a tenth of that be?", "in mN?"),
            "calculate 0.1 * (limit_n - force_n) in mN.",
        ),
        (
            ("What is the limit?", "in grams?", "and half of it?"),
            "calculate 0.5 * ((limit_n) / 0.00980665) in g.",
        ),
        (("What is the limit?", "Are we over half of it?"), "check used > #1 %."),
        (
            ("What percentage of the limit is used?", "Is that more than 30 %?", "By how much?"),
            "calculate abs(100 * force_n / limit_n - (30)) in %.",
        ),
        (
            ("Is the force above 3 N?", "so between 1 and 2?"),
            "calculate min(1, 2) <= force_n <= max(1, 2).",
        ),
        (("How deep is it in microns?", "between 0.4 and 0.5 mm?"), "check depth #1 - #2 mm."),
        (
            ("What is the band?", "Are we in it?", "What's missing?"),
            "calculate max(0, band_low_n - force_n, force_n - band_high_n) in N.",
        ),
        # sides, axes and classes
        (("Does it run off the pad anywhere?", "On the left?"), "check cut left."),
        (
            ("Does it run off the pad anywhere?", "On the left?", "The other side?"),
            "check cut right.",
        ),
        (("Does it run off the pad anywhere?", "up at the palm end?"), "check cut top."),
        (("Does it touch the left edge?", "any other edge?"), "calculate cut."),
        (("Where is it?", "in mm?"), "amount x mm; amount y mm."),
        (("Where is it?", "exactly?"), "amount x mm; amount y mm."),
        (("What is the contact area?", "what's the rest?"), "amount free_area %."),
        (
            ("Does it run off the pad anywhere?", "So how many sides altogether?"),
            "calculate cut_left + cut_right + cut_top + cut_bottom in 1.",
        ),
        (("How many mm is it off sideways?", "And vertically?"), "amount offset_y mm."),
        (("Is the area at least large?", "How about medium or bigger?"), "check area >= medium."),
        (("Is the surface ridged?", "What would you call it?"), "word texture."),
        # the band
        (("Where does the band start?", "And where does it end?"), "amount band_high N."),
        (("What is the lower end of the band?", "So how wide is it?"), "amount band_width N."),
        (("What is the lower end of the band?", "its midpoint?"), "amount band_middle N."),
        # masses
        (("Will it slip at 30 g?", "and a full hundred?"), "check slips #1 g."),
        (
            ("How much does it weigh?", "What is that in newtons?"),
            "calculate (mass_g) * 0.00980665 in N.",
        ),
        (
            ("Will it slip at this weight?", "And if it were twice as heavy?"),
            "calculate force_n < 0.0205 * (2 * mass_g).",
        ),
        (("The object weighs 40 g.", "Is the grip strong enough for it?"), HOLDS_IT),
        (
            ("Will 25 g slip?", "What's the least force for that one?"),
            "amount needed #1 g N.",
        ),
        (
            ("Will it slip at this weight?", "And two of them?"),
            "calculate force_n < 0.0205 * (2 * mass_g).",
        ),
        # another force
        (
            ("Is it safe to lift?", "and with 0.4 N less?", "and 0.2 N more?"),
            "calculate band_low_n <= (force_n + 0.2) <= band_high_n.",
        ),
        (
            ("Is it below the limit?", "If I add 0.3 N, still under?", "and 1 N harder?"),
            "calculate (force_n + 1) < limit_n.",
        ),
        (("How many grams does it hold?", "and with twice the force?"), TWICE),
        (
            ("Is it safe to lift?", "What if I add 0.3 N?", "and 0.2?"),
            "calculate band_low_n <= (force_n + 0.2) <= band_high_n.",
        ),
        (
            ("Are we over the limit?", "How about if I double the force?"),
            "calculate (2 * force_n) > limit_n.",
        ),
        (
            ("Is it safe to lift?", "What if I add 0.3 N?", "What would the force be then?"),
            "calculate force_n + 0.3 in N.",
        ),
        (("The band is 1 to 2 N.", "If I press 0.5 N harder, are we in then?"), IN_AFTER),
        (("The limit is 3 N.", "And now, are we over?"), "check force over."),
        (("Object mass is 32 g.", "Will it hold?", "Sorry, 82 g.", "Still enough?"), HOLDS),
        (
            ("How much force is needed for 150 g?", "How many newtons are we away from that?"),
            "calculate abs(force_n - gram_n * 150) in N.",
        ),
        # two conditions
        (
            ("Is it deeper than 0.4 mm?", "Is the area over 10 %?", "So are both true?"),
            "calculate (depth_mm > 0.4) and (area_percent > 10).",
        ),
        # figures and shifts
        (("Is it deep?", "What is the real figure then?"), "amount depth mm."),
        (
            ("If it moved 2 mm to the right, what would x be?", "And 3 mm to the left?"),
            "calculate x_mm - 3 in mm.",
        ),
        (("Is it left or right of the middle?", "By how many mm?"), "calculate abs(x_mm) in mm."),
        # the pad, guesses, advice
        (("How wide is the pad?", "And its height?"), "calculate pad_height_mm in mm."),
        (("My guess is a sphere.", "Am I right?"), "check shape sphere."),
        (("What next?", "Is that a move of some sort?"), MOVED),
        (("What next?", "So your advice isn't to lift?"), "calculate not (action == 'lift')."),
        # 'and' before a whole question
        (("What shape is it?", "And how does its surface feel?"), "word texture."),
    ],
)
def test_a_follow_up_points_at_what_was_asked_before(questions, query, monkeypatch):
    monkeypatch.setattr(turns, "understood", lambda writer, text: understood_by_grammar(text))
    assert last_turn(*questions).read.query == query


@pytest.mark.parametrize(
    "question",
    [
        *("How deep is it?", "Is it a sphere?", "Is it safe to lift?", "Is it over 2 mm deep?"),
        *("What depth is it?", "What area is it?"),
    ],
)
def test_a_number_before_does_not_change_what_stands_alone(question):
    alone = understood_by_grammar(question).query
    assert last_turn("What is the limit?", question).read.query == alone


def test_a_supposed_force_is_told_in_the_answer():
    text = answers("What if I add 0.9 N?", "Is that over the limit?")
    assert text == "Yes, the force would be 1.73 N, the limit is 1.30 N."
    text = answers("What if I add 0.1 N?", "Is that within the band?")
    assert text.startswith("Yes, the force would be 0.93 N, ")
    text = answers("Will it slip?", "What if I take off 0.4 N?")
    assert text == "Yes, the force would be 0.43 N, it needs 0.51 N."
    text = answers("With 10 % more force, are we in the band?")
    assert text.startswith("Yes, the force would be 0.91 N, ")


def test_reasons_are_a_list():
    text = answers("What is the force?", "Why?")
    assert text == (
        "Because the depth is 0.19 mm, the contact area is 12 % and the force is 0.83 N."
    )


def test_a_question_that_stands_alone_follows_nothing():
    turn = last_turn("What if I add 0.9 N?", "What shape is it?")
    assert turn.read.query == "word shape."
    assert turn.text == "What shape is it?"
    assert next_turn(Refusing(), "Is it deep?", turn).read.query == "check depth deep."


@pytest.mark.parametrize(
    ("question", "told", "query"),
    [
        ("The object weighs 50 g.", "the object weighs 50 g", None),
        ("it weighs 0.05 kg", "the object weighs 50 g", None),
        ("The limit is 900 mN.", "the limit is 0.9 N", None),
        ("The band is 1 to 2 N.", "the force band is 1 to 2 N", None),
        ("New limit from the boss: 2.5 N.", "the limit is 2.5 N", None),
        ("Sorry, I mean the limit is 2.5 N.", "the limit is 2.5 N", None),
        ("My peaches run about 150 g.", "the object weighs 150 g", None),
        ("We're handling 40 g vials here.", "the object weighs 40 g", None),
        ("It cracks above 0.8 N.", "the limit is 0.8 N", None),
        (
            "For this test the band is 0.8 to 1.6 N and the limit is 3 N.",
            "the force band is 0.8 to 1.6 N and the limit is 3 N",
            None,
        ),
        ("It's an egg, so the limit is 1.5 N.", "the limit is 1.5 N", None),
        ("There's an egg in it, I don't want more than 1.2 N on it.", "the limit is 1.2 N", None),
        (
            "If the band is 1 to 2 N, is it safe to lift?",
            "the force band is 1 to 2 N",
            "check force within.",
        ),
    ],
)
def test_what_is_told_is_kept_beside_what_is_asked(question, told, query):
    turn = last_turn(question)
    assert turn.told is not None
    assert turn.told.text == told
    assert (turn.read.query if turn.read else None) == query


def test_a_correction_is_of_what_was_told_last():
    told = last_turn("The band is 1 to 2 N.", "make it 0.5 to 1.5 N instead").told
    assert told.text == "the force band is 0.5 to 1.5 N"
    assert last_turn("The limit is 2 N.", "Make that 900 mN.").told.text == "the limit is 0.9 N"
    assert (
        last_turn("The object weighs 40 g.", "I meant 60 g").told.text == "the object weighs 60 g"
    )


@pytest.mark.parametrize(
    "question",
    [
        "The limit is 900 mm.",
        "Is the object 50 g?",
        "It is deep.",
        "grip fine for 25 g",  # a question without its mark
        "It is 20 g heavier than the last one.",
        "Either 20 g or 30 g is right.",
    ],
)
def test_what_is_no_mass_or_bound_is_not_told(question, monkeypatch):
    monkeypatch.setattr(turns, "understood", lambda *_: None)
    assert next_turn(Refusing(), question, Turn()).told is None


@pytest.fixture
def confidences(monkeypatch):
    """Confidences of what a model reads, by the question and that before it."""
    known = {}

    def read(writer, question, before=""):
        query = "amount depth µm." if before else "other."
        return ReadQuestion(query, read_query(query), known[question, before])

    monkeypatch.setattr(turns, "read_by_model", read)
    monkeypatch.setattr(turns, "understood_by_grammar", lambda *_: None)
    monkeypatch.setattr(turns, "understood", lambda writer, *asked: read(writer, *asked))
    return known


BEFORE = Turn(text="How deep is it?")


@pytest.mark.parametrize(
    ("question", "alone", "behind", "query"),
    [
        ("And in microns?", 1.0, 0.1, "amount depth µm."),  # begins as a follow-up
        ("In microns?", 0.3, 0.8, "amount depth µm."),  # the likelier of two
        ("What a day!", 0.8, 0.3, "other."),
        ("Who won the final match in Paris last night?", 0.2, 0.9, "other."),  # too long for one
        ("Has it moved?", 0.3, 0.9, "other."),  # has a verb of its own
    ],
)
def test_what_the_grammar_lacks_is_read_behind_the_question_before(
    question, alone, behind, query, confidences
):
    confidences |= {(question, ""): alone, (question, BEFORE.text): behind}
    assert next_turn(None, question, BEFORE).read.query == query


def test_without_a_question_before_nothing_follows(confidences):
    confidences["And in microns?", ""] = 0.5
    assert next_turn(None, "And in microns?", Turn()).read.query == "other."


def test_a_reason_that_nobody_asked_for_is_no_answer(monkeypatch):
    why = ReadQuestion("why shape.", read_query("why shape."), 0.9)
    monkeypatch.setattr(turns, "understood", lambda *_: why)
    assert next_turn(None, "And the other flurb?", BEFORE).read is None
    assert next_turn(None, "And the reason?", BEFORE).read is why


def test_what_compares_no_numbers_has_no_difference():
    assert difference_of(understood_by_grammar("Is it a sphere?").meaning, "By how much?") is None
    assert difference_of(understood_by_grammar("How deep is it?").meaning, "By how much?") is None


@pytest.mark.parametrize(
    ("questions", "query"),
    [
        (("What is the limit?", "Are we above it?", "Are we near it?"), "amount headroom N."),
        (
            ("What is the limit?", "Is the force over it?", "What percentage of it?"),
            "amount used %.",
        ),
        (("Is it safe to lift?", "Why?"), "why force."),
        (("Is the mass over the sure load?", "Why?"), "because mass, holds."),
        (("How wide is the band?", "How come?"), "because band_width."),
        (
            ("How high is the pad?", "And wide?", "Multiply both."),
            "calculate pad_height_mm * pad_width_mm in mm².",
        ),
        (
            ("What percentage of the limit do we use?", "Under 60, are we?"),
            "calculate 100 * force_n / limit_n < 60.",
        ),
        (("Would this surely hold 25 g?", "Fifty, then?"), "calculate holds_g >= 50."),
        (
            ("How many percent of the pad are touched?", "Does it cover over a third of the pad?"),
            "check area > #1 %.",
        ),
        (("Would this surely hold 25 g?", "And two hundred?"), "calculate holds_g >= 200."),
        (("How far is it from the left edge?", "And why?"), "because x."),
    ],
)
def test_a_pronoun_stands_for_what_was_asked_for_until_something_else_is(questions, query):
    assert last_turn(*questions).read.query == query


def test_what_no_fact_tells_has_no_reason():
    assert reason_of(Calculated(truth="pad_width_mm > 10", unit=None)) is None


def test_a_number_that_is_told_is_another_one_in_a_follow_up():
    turn = last_turn("Suppose it weighs 70 g. Will it slip?", "And for 80 g?")
    assert turn.read.query in ("check slips given.", "check slips #1 g.", "calculate holds_g < 80.")
    turn = last_turn("If the band is 1 to 2 N, is it safe to lift?", "and 3 N?")
    assert turn.told.text == "the force band is 1 to 3 N"


@pytest.mark.parametrize(
    ("questions", "query"),
    [
        (("How much of the pad is covered?", "And uncovered?"), "amount free_area %."),
        (("What is the area in mm2?", "and free?"), "amount free_area mm²."),
        (("How deep is it?", "Is that a lot?"), "choice depth in a word."),
        (
            ("Is the force above the limit?", "How many newtons lie between the two?"),
            "calculate abs(force_n - (limit_n)) in N.",
        ),
        (
            ("What grip is needed to surely hold it?", "Are you gripping that hard?"),
            "calculate force_n >= (gram_n * mass_g).",
        ),
        (
            ("What is the contact area in mm2?", "Is that over a quarter of the pad?"),
            "check area > #1 %.",
        ),
        (("Is it deeper than 0.3 mm?", "0.6?", "ok what's the actual value"), "amount depth mm."),
        (
            ("Is it cut off by the border?", "On more than one side?"),
            "calculate cut_left + cut_right + cut_top + cut_bottom > 1.",
        ),
        (
            ("Is it safe to lift?", "Would it be safe with 0.5 N less?", "And with 0.5 N more?"),
            "calculate band_low_n <= ((force_n + 0.5)) <= band_high_n.",
        ),
        (("What is the lowest force of the band?", "And the highest?"), "amount band_high N."),
        (("How deep is it, in a word?", "Same for the area."), "choice area in a word."),
        (
            ("Is that enough for twice the mass?", "What grip is needed if it is 3 times heavier?"),
            "calculate gram_n * 3 * mass_g in N.",
        ),
    ],
)
def test_what_testers_said_in_a_row(questions, query):
    assert last_turn(*questions).read.query == query


@pytest.mark.parametrize(
    ("question", "query"),
    [
        ("If the band were 2 to 4 N, would we be in it?", "band_low_n <= force_n <= band_high_n"),
        ("If the limit is 2 N, are we over it?", "force_n > 2"),
    ],
)
def test_what_is_supposed_is_what_a_pronoun_behind_it_means(question, query):
    assert query in last_turn(question).read.query
