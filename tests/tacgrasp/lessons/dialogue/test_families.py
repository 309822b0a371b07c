"""The grammar: how much it can say, that it understands what it says, and that its answers hold."""

import dataclasses
from collections import Counter

import numpy as np
import pytest

from tacgrasp.lessons.dialogue.answers import answer
from tacgrasp.lessons.dialogue.expression import Expression
from tacgrasp.lessons.dialogue.families.catalogue import FAMILIES, understand
from tacgrasp.lessons.dialogue.meaning import AnswerKind, kind_of, truth_of
from tacgrasp.lessons.dialogue.patterns.family import word_lists
from tacgrasp.lessons.dialogue.scoring.answer_scores import score_answer
from tacgrasp.lessons.question_draws import draw_question, families_by_kind
from tests.fakes.question_scenes import HELD, SCENES, random_states

LEAST_FAMILIES, LEAST_WORDINGS, LEAST_VOCABULARY = 30, 1000, 4000


RANDOM = [
    dataclasses.replace(HELD, state=state, mass_g=mass_g)
    for state, mass_g in zip(random_states(60), (5.0, 40.0, 250.0) * 20, strict=True)
]


MANY = [scene.values() for scene in (*SCENES, *RANDOM)]


def is_same(one, other):
    """Whether two truths are one, or have the same values in many scenes."""
    if one == other:
        return True
    sides = [[Expression(part) for part in text.split(";") if part] for text in (one, other)]
    return all(
        [each.evaluate(values).value for each in sides[0]]
        == [each.evaluate(values).value for each in sides[1]]
        for values in MANY
    )


def test_there_are_families_of_every_kind():
    assert len(FAMILIES) >= LEAST_FAMILIES
    assert len({family.name for family in FAMILIES}) == len(FAMILIES)
    assert all(len(families_by_kind()[kind]) >= 3 for kind in AnswerKind)


@pytest.mark.parametrize("family", FAMILIES, ids=lambda family: family.name)
def test_a_family_has_a_thousand_wordings(family):
    """Counted with every noun of a list, and every number, as one."""
    assert family.automaton.num_wordings(LEAST_WORDINGS) == LEAST_WORDINGS


def test_the_vocabulary_is_wide():
    words = set().union(*(family.automaton.vocabulary for family in FAMILIES))
    print(  # noqa: T201
        f"{len(words)} words, {len(FAMILIES)} families"
    )
    assert len(words) >= LEAST_VOCABULARY


def test_no_word_list_is_empty_and_its_words_are_words():
    for name, words in word_lists().items():
        assert words, name
        assert all(word.replace(" ", "").replace("-", "").isalpha() for word in words), name


@pytest.mark.parametrize("family", FAMILIES, ids=lambda family: family.name)
def test_questions_are_understood_and_their_answers_true(family):
    """Every drawn question reads back to its truth, and its answer is right in its scene."""
    rng = np.random.default_rng(len(family.name))
    for scene in SCENES:
        for _ in range(2):
            question = draw_question(scene, rng, family)
            read = understand(question.text, before=question.before)
            assert read is not None, question.text
            assert is_same(truth_of(read), truth_of(question.meaning)), question.text
            assert kind_of(read) is kind_of(question.meaning)
            given = answer(question.meaning, scene)
            score = score_answer(given.text, question.row, scene)
            assert score.right, (question.text, given.text, truth_of(question.meaning))
            assert score.right_kind, (question.text, given.text)
            assert score.decidable == given.decidable, (question.text, given.text)


def test_questions_before_a_follow_up_are_understood():
    for question in {before for family in FAMILIES for before in family.before}:
        assert understand(question) is not None, question


def test_a_follow_up_is_understood_after_its_question_alone():
    assert understand("And in microns?") is None
    after = understand("And in microns?", before="How deep is it?")
    assert after is not None
    assert truth_of(after) == "depth_mm"
    assert after.unit == "µm"
    why = [understand("Why?", before=b) for b in ("What next?", "Is it safe to lift?")]
    assert [truth_of(meaning) for meaning in why] == ["reason", "force_band"]
    assert understand("Why?") is None


@pytest.mark.parametrize(
    ("before", "truth"),
    [
        ("How deep is it?", "depth_mm; area_percent; force_n"),
        ("Is it deeper than 0.5 mm?", "depth_mm"),
        ("Is it a sphere?", "shape"),
        ("Are we over the limit?", "force_n; limit_n"),
        ("Will it slip at this weight?", "force_n; holds_g"),
        ("Is it cut off?", "wholeness"),
    ],
)
def test_why_names_what_the_answer_before_was_about(before, truth):
    meaning = understand("Why?", before=before)
    assert meaning is not None
    assert truth_of(meaning) == truth


@pytest.mark.parametrize(
    ("text", "truth"),
    [
        ("How deep is it?", "depth_mm"),
        ("how hard is the mango held, in grams?", "force_n"),
        ("Is the force above 1 N?", "force_n > 1"),
        ("Isn't the force above 300 mN?", "force_n > 300 / 1000"),
        ("Is the depth not more than 0.3 mm?", "not (depth_mm > 0.3)"),
        ("Is the depth between 100 and 300 µm?", "100 / 1000 <= depth_mm <= 300 / 1000"),
        ("Is the force at least half a newton?", "force_n >= 0.5"),
        ("Does it go in further than 0.3 mm?", "depth_mm > 0.3"),
        ("Have we passed 300 grams?", "force_n > 300 * 0.00981"),
        ("The force never gets to 2 N, correct?", "force_n < 2"),
        ("Is it false that the depth exceeds 0.5 mm?", "depth_mm <= 0.5"),
        ("Is x below -2 mm?", "x_mm < -2"),
        ("Does it weigh at least 200 g?", "mass_g >= 200"),
        ("Is the area smaller than medium?", "area < 'medium'"),
        ("Is it a sphere?", "shape == 'sphere'"),
        ("Is it not shaped like a ball?", "shape != 'sphere'"),
        ("Is the mango held tightly enough?", "force_n >= band_low_n"),
        ("Is it safe to lift?", "band_low_n <= force_n <= band_high_n"),
        ("Will it slip at 30 g?", "force_n < 0.0205 * 30"),
        ("Will it slip at this weight?", "force_n < 0.0205 * mass_g"),
        ("What next?", "action"),
        ("What should I do next and why?", "action; reason"),
        ("Is anything touching the pad?", "contact"),
        ("Is the pad empty?", "not contact"),
        ("The depth and the force?", "depth_mm; force_n"),
        ("Where is it?", "position"),
        ("Is it left of the middle?", "x_mm < 0"),
        ("How far are we below the band?", "max(0, band_low_n - force_n)"),
        ("How much force is in excess?", "max(0, force_n - band_high_n)"),
        ("Would twice that be too much?", "2 * force_n > band_high_n"),
        ("Would twice the force be over the limit?", "2 * force_n > limit_n"),
        ("If we halve the force, would it still be enough?", "0.5 * force_n >= band_low_n"),
        ("Is the force 1.2 N plus or minus 0.1?", "abs(force_n - 1.2) <= 0.1"),
        ("What would twice the force be?", "2 * force_n"),
        ("Half of the depth in microns?", "0.5 * depth_mm"),
        ("If the force doubled, how many newtons would that make?", "2 * force_n"),
        ("How much of the pad stays free?", "100 - area_percent"),
        ("The middle of the band?", "(band_low_n + band_high_n) / 2"),
        (
            "How far is the force from the middle of the band?",
            "abs(force_n - (band_low_n + band_high_n) / 2)",
        ),
        ("How wide is the band?", "band_high_n - band_low_n"),
        ("How much deeper than 0.1 mm does it go?", "depth_mm - 0.1"),
        ("Would half the force still be over 0.4 N?", "0.5 * force_n > 0.4"),
        ("Would 2 N be more than we may use?", "limit_n < 2"),
        ("The force does not exceed 2 N, does it?", "force_n > 2"),
        ("The force does not exceed 2 N, right?", "force_n <= 2"),
        ("It isn't bumpy, is it?", "texture == 'bumpy'"),
        ("Hexagonal, yes?", "shape == 'hexagon'"),
        ("The palm half?", "y_mm > 0"),
        ("Ball or box? If neither, name it.", "shape"),
        ("In words only, how deep and how large is it?", "depth; area"),
        ("The depth class and the area class?", "depth; area"),
        ("First the shape, then the location.", "shape; position"),
        ("How hard is it held, in pounds?", "force_n"),
        ("Is the depth 300 µm ± 50?", "abs(depth_mm - 0.3) <= 0.05"),
        ("Is the force within 100 of 800 mN?", "abs(force_n - 0.8) <= 0.1"),
    ],
)
def test_plain_questions_have_their_truths(text, truth):
    meaning = understand(text)
    assert meaning is not None
    assert is_same(truth_of(meaning), truth), truth_of(meaning)


@pytest.mark.parametrize(
    ("text", "kind"),
    [
        ("What color is it?", AnswerKind.UNKNOWABLE),
        ("How much does the vase cost?", AnswerKind.UNKNOWABLE),
        ("Is the cup hot?", AnswerKind.UNKNOWABLE),
        ("What is its viscosity?", AnswerKind.UNKNOWABLE),
        ("What do you think about glaciers?", AnswerKind.OFF_TOPIC),
        ("What is the capital of France?", AnswerKind.OFF_TOPIC),
        ("Tell me a joke.", AnswerKind.OFF_TOPIC),
    ],
)
def test_what_can_not_be_known_is_understood_as_such(text, kind):
    meaning = understand(text)
    assert meaning is not None
    assert kind_of(meaning) is kind


def test_half_of_the_answers_to_a_comparison_are_yes():
    rng = np.random.default_rng(5)
    for family in FAMILIES:
        if family.name in (
            "depth_above",
            "not_force",
            "shape_is",
            "not_texture_is",
            "slip",
            "side",
        ):
            drawn = [draw_question(HELD, rng, family).meaning for _ in range(60)]
            counts = Counter(answer(meaning, HELD).value for meaning in drawn)
            assert 15 <= counts[True] <= 45, (family.name, counts)
