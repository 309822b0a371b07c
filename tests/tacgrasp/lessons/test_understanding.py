"""From a question to its answer, by a model that writes what it is told to."""

import math
from types import SimpleNamespace

import pytest

from tacgrasp.lessons import joined_questions, understanding
from tacgrasp.lessons.answering import NOT_UNDERSTOOD, UNSURE_BELOW, answered
from tacgrasp.lessons.dialogue.query import read_query
from tacgrasp.lessons.query_classifier import QueryOdds
from tacgrasp.lessons.read_question import ReadQuestion
from tacgrasp.lessons.understanding import understood
from tests.fakes.question_scenes import HELD, UNTOUCHED


class Odds:
    """Names one rival of the model's query, and finds all equally likely."""

    rival = "unknown name."

    def __init__(self, words):
        self.words = words

    def likeliest(self):
        return iter([self.rival])

    def of(self, query):
        return 0.0


@pytest.fixture(autouse=True)
def wordings_unknown_to_the_grammar(monkeypatch):
    """Every question is left to the model."""
    monkeypatch.setattr(understanding, "understand", lambda *_, **__: None)
    readers = ("calculated", "chosen", "judged_as_one", "ruled_whole", "clauses_of", "unfelt")
    for reader in readers:
        monkeypatch.setattr(understanding, reader, lambda *_: None)
    monkeypatch.setattr(understanding, "asked_in_speech", lambda _: ())
    monkeypatch.setattr(understanding, "QueryOdds", Odds)


class Writer:
    """Writes one query, which is so much likelier to it than the rival that it has 0.81."""

    width = 8

    def __init__(self, query, *, ended=True):
        self.query, self.ended = query, ended

    def reply_to(self, touch, prompt, *, grammar):
        self.prompt = prompt
        return SimpleNamespace(text=self.query, ended=self.ended)

    def log_likelihoods(self, prompt, replies):
        rival = math.log(0.19 / 0.81) / understanding.WRITERS_PART
        return [0.0 if reply == self.query else rival for reply in replies]


def test_the_numbers_of_a_question_come_from_the_question():
    writer = Writer("check force > #1 g.")
    asked = understood(writer, "Is the force above eighty grams?")
    assert writer.prompt == "is the force above # grams"
    given = answered(asked, HELD)
    assert given.answer.text == "Yes, the force is 85 g."
    assert (given.answer.value, given.answer.decidable) == (True, True)
    assert given.confidence == pytest.approx(asked.confidence)


@pytest.mark.parametrize(
    ("question", "query"),
    [
        (
            "Would you be so good as to put what this is shaped like into a few words?",
            "word shape.",
        ),
        ("What shape is it?", "word shape; amount depth mm."),
    ],
)
def test_a_long_question_and_one_of_several_parts_are_less_sure(question, query):
    brief = understood(Writer("word shape."), "What shape is it?")
    assert understood(Writer(query), question).confidence < brief.confidence - 0.02
    assert 0.9 < brief.confidence < 1


@pytest.mark.parametrize(
    ("question", "query"),
    [
        ("Is the force zorp 2 N?", "check force about #1 N."),
        ("Is the force slower than 2 N?", "check force about #1 N."),
        ("So is the area roughly 20 mm² now?", "check area > #1 mm²."),
    ],
)
def test_a_comparison_that_is_not_read_is_never_sure(question, query):
    assert understood(Writer(query), question).confidence < UNSURE_BELOW


def test_a_comparison_that_is_read_may_be_sure():
    for question, query in {
        "Is the force about 2 N?": "check force about #1 N.",
        "Is the area over 20 mm²?": "check area > #1 mm².",
    }.items():
        assert understood(Writer(query), question).confidence > 0.8


def test_a_word_in_capitals_keeps_them_behind_probably():
    meaning = read_query("calculate 'STOP' if force_n > 0.5 else 'go'.")
    told = answered(ReadQuestion("", meaning, 1.0), HELD, {}, {"force_n": (0.3, 2.0)})
    assert told.answer.text == "Probably STOP: the force is 0.83 N."


def test_a_number_comes_in_the_unit_of_the_query():
    asked = understood(Writer("check x > #1 mm."), "Is x over 500 microns?")
    assert asked.meaning.condition == "x_mm > 0.5"


def test_a_side_that_is_named_is_the_side_that_is_counted_to():
    asked = understood(Writer("check x > #1 mm."), "Is it more than 2 mm left of the middle?")
    assert (asked.query, asked.meaning.condition) == ("check x < -#1 mm.", "x_mm < -2")


def test_a_unit_that_is_asked_for_is_the_one_that_is_given():
    asked = understood(Writer("amount limit N."), "Which limit have I, in mN?")
    assert asked.query == "amount limit mN."


@pytest.mark.parametrize(
    "question",
    [
        "Would 0.5 N more be too much?",
        "Would 30 % more be too much?",
        "What's the pressure in kPa?",
        "Is 0.2 N within the band?",
        "If I raise it by 0.2 N, is that too much?",
        "Is twice the limit exceeded?",
        "Is the limit three times the force?",
        "Does exactly one hold, force over 2 N or depth over 1 mm?",
        "Is the force more than 5 N per mm?",
    ],
)
def test_what_no_query_has_is_not_taken_for_something_near(question):
    assert understood(Writer("check force above."), question) is None


@pytest.mark.parametrize(
    "question", ["Is it more than 0.5 N?", "Is 0.5 mm or less felt?", "Is it 2 N less than that?"]
)
def test_what_sounds_like_it_is_still_read(question):
    assert understood(Writer("check force above."), question) is not None


def test_what_takes_a_force_for_a_mass_is_not_named(monkeypatch):
    monkeypatch.setattr(Odds, "rival", "check stays #2 g.")
    asked = understood(Writer("check stays #1 g."), "Does 0.5 N match 30 g?")
    assert asked.query == "check stays #2 g."


class Forgetful(Writer):
    """Reads the last part of a question alone."""

    def __init__(self):
        super().__init__("word texture.")


@pytest.mark.parametrize(
    ("known", "query"),
    [
        ({"How deep is it": "amount depth mm."}, "amount depth mm; word texture."),
        ({}, "word texture."),
        ({"How deep is it": "why step."}, "word texture."),
    ],
)
def test_a_part_that_the_grammar_knows_is_not_lost(monkeypatch, known, query):
    def meant(text, **_):
        return read_query(known[text]) if text in known else None

    for module in (understanding, joined_questions):
        monkeypatch.setattr(module, "understand", meant)
    asked = understood(Forgetful(), "How deep is it, and how would its skin feel?")
    assert asked.query == query


def test_a_word_in_doubt_is_probable_and_lowers_the_confidence():
    asked = understood(Writer("word shape."), "What shape is it?")
    sure, unsure = (answered(asked, HELD, {"shape": p}) for p in (0.95, 0.5))
    assert sure.answer.text == "It is an ellipsoid."
    assert unsure.answer.text == "Probably it is an ellipsoid."
    assert unsure.answer.value == sure.answer.value == "ellipsoid"
    assert unsure.confidence == pytest.approx(asked.confidence * 0.5)


@pytest.mark.parametrize(
    ("ends", "text", "holds"),
    [
        ((0.82, 0.84), "Yes, the force is 0.83 N.", 1.0),
        ((0.7, 1.0), "Yes, probably: the force is 0.83 N.", 0.65),
        ((0.3, 2.0), "Yes, probably: the force is 0.83 N.", 0.54),
    ],
)
def test_a_threshold_inside_the_interval_is_probable_and_lowers_the_confidence(ends, text, holds):
    asked = understood(Writer("check force > #1 N."), "Is the force above 0.8 N?")
    given = answered(asked, HELD, {}, {"force_n": ends})
    assert given.answer.text == text
    assert given.answer.value is True
    assert given.confidence == pytest.approx(asked.confidence * holds, abs=0.07)
    assert given.interval is None


def test_a_word_that_is_asked_for_stays_one_where_it_is_in_doubt():
    asked = understood(Writer("check force > #1 N in a word."), "Above 0.8 N?")
    assert answered(asked, HELD, {}, {"force_n": (0.5, 1.2)}).answer.text == "Yes, probably."


def test_a_number_has_an_interval_in_its_unit_that_no_amount_makes_negative():
    asked = understood(Writer("amount depth µm."), "How many microns deep?")
    given = answered(asked, HELD, {}, {"depth_mm": (0.1, 0.22)})
    assert given.answer.text == "About 190 µm."
    narrow = answered(asked, HELD, {}, {"depth_mm": (0.17, 0.22)})
    assert narrow.answer.text == "190 µm."
    assert given.interval == pytest.approx((100, 220), abs=15)
    wide = answered(asked, HELD, {}, {"depth_mm": (-0.5, 0.9)})
    assert wide.interval[0] == 0
    # 190 µm may be off by 50 µm: as probable as it is that the depth lies so near
    assert narrow.confidence == pytest.approx(asked.confidence)
    assert given.confidence == pytest.approx(asked.confidence * 0.7, abs=0.12)
    assert wide.confidence < asked.confidence * 0.3
    assert answered(asked, UNTOUCHED, {}, {}).interval is None


def test_a_question_that_comes_to_nothing_is_not_answered(monkeypatch):
    monkeypatch.setattr(Odds, "rival", "check depth > #3 mm.")
    for asked in (
        understood(Writer("check force > #2 N."), "Is it above 1 N?"),
        understood(Writer("word", ended=False), "What shape is it?"),
    ):
        assert asked is None
        given = answered(asked, HELD)
        assert given.answer.text == NOT_UNDERSTOOD
        assert not given.answer.decidable
        assert given.confidence == 0


def test_an_unsure_reading_says_so():
    asked = ReadQuestion("check touched.", read_query("check touched."), 0.59)
    text = answered(asked, HELD).answer.text
    assert text == "Yes, something touches the pad. Perhaps you meant something else."
    assert answered(asked._replace(confidence=0.6), HELD).answer.text == text.split(". ")[0] + "."


def test_each_of_several_questions_keeps_its_doubt():
    ends = {"depth_mm": (0.12, 0.3), "force_n": (0.4, 1.6)}
    asked = ReadQuestion("", read_query("check force > #1 N; amount depth mm.", (0.8,)), 1.0)
    given = answered(asked, HELD, ends=ends)
    assert given.answer.text == "Yes, probably; the depth is about 0.19 mm."
    alone = [
        answered(asked._replace(meaning=part), HELD, ends=ends) for part in asked.meaning.parts
    ]
    assert given.confidence == pytest.approx(alone[0].confidence * alone[1].confidence)
    assert given.confidence < 0.6
    assert answered(asked, HELD).answer.text == "Yes; the depth is 0.19 mm."


def test_an_untouched_pad_still_has_a_contract():
    limit = understood(Writer("amount limit N."), "What is the limit?")
    depth = understood(Writer("amount depth mm."), "How deep is it?")
    assert answered(limit, UNTOUCHED).answer.text == "1.19 N."
    assert answered(depth, UNTOUCHED).answer.text == "Nothing touches the pad."


class Sure(Odds):
    """Is sure of one query."""

    def of(self, query):
        return 0.0 if query == self.rival else -3.0


@pytest.mark.parametrize(("likelihood", "query"), [(-3.0, "unknown name."), (-30.0, "word shape.")])
def test_the_classifier_overrules_a_model_in_doubt_but_not_one_that_excludes(
    likelihood, query, monkeypatch
):
    class Doubtful(Writer):
        def log_likelihoods(self, prompt, replies):
            return [0.0 if reply == self.query else likelihood for reply in replies]

    monkeypatch.setattr(understanding, "QueryOdds", Sure)
    asked = understood(Doubtful("word shape."), "What is left?")
    assert asked.query == query
    assert 0.5 < asked.confidence < 1


def test_the_shipped_classifier_names_what_is_asked():
    odds = QueryOdds("how deeply does the plum sit inside the gel now")
    assert next(odds.likeliest()) == "amount depth mm."
    assert odds.of("amount depth mm.") > -1
    assert odds.of("amount depth mm; word shape.") == odds.of("word shape; word texture.") < -2
    assert odds.of("amount depth miles.") == -math.inf
