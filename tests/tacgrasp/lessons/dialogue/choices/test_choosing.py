"""Questions that name the alternatives of their answer."""

import pytest

from tacgrasp.lessons.answering import answered
from tacgrasp.lessons.dialogue.answers import answer
from tacgrasp.lessons.dialogue.choices.choosing import chosen
from tacgrasp.lessons.dialogue.choices.own_words import in_its_words
from tacgrasp.lessons.dialogue.expression import Expression
from tacgrasp.lessons.dialogue.meaning import AnswerKind, kind_of
from tacgrasp.lessons.dialogue.query import asked_text, query_of, read_query
from tacgrasp.lessons.dialogue.scoring.answer_reading import read_answer
from tacgrasp.lessons.read_question import ReadQuestion
from tests.fakes.question_scenes import ASIDE, FIRM, HELD, LIGHT, UNTOUCHED

SIDES = [
    ("Is the dent deeper or shallower than 0.6 mm?", "Shallower: the depth is 0.19 mm."),
    ("Half a millimetre: is the dent more than that, or less?", "Less: the depth is 0.19 mm."),
    ("Would you put the sure load over or under 20 g?", "Over: the heaviest load held is 40 g."),
    ("Is the object heavier or lighter than 80 grams?", "Lighter: the mass is 25 g."),
    ("Does it cover more or less than a quarter of the pad?", "Less: the contact area is 12 %."),
    ("Is it pressing with at least 2 N or less?", "Less: the force is 0.83 N."),
    ("Is the force over or under 900 mN?", "Under: the force is 0.83 N."),
    ("Sideways distance from the middle: bigger than 0.5 mm or smaller?", "Bigger: x is +0.8 mm."),
    ("Within the limit or over it?", "Within: the force is 0.83 N and the limit is 1.30 N."),
    ("Contact below 5 % of the pad, or 5 % and above?", "Above: the contact area is 12 %."),
]
BINS = [
    (
        "Sort the indentation: 'light' up to 0.5 mm, 'medium' up to 1 mm, 'heavy' beyond that.",
        "Light: the depth is 0.19 mm.",
    ),
    (
        "If anything under 2 N is gentle and the rest is firm, which one fits the grip?",
        "Gentle: the force is 0.83 N.",
    ),
    (
        "Classify the load as low (less than 0.5 N), mid (0.5 to 3 N) or high (over 3 N).",
        "Mid: the force is 0.83 N.",
    ),
    (
        "In our shop, parts of 200 g and up are 'big' and everything else is 'small'; which is it?",
        "Small: the mass is 25 g.",
    ),
    ("We call it light below 500 mN, otherwise heavy. What is it?", "Heavy: the force is 0.83 N."),
    ("A squeeze under 0.5 N is weak, over 2 N strong. Which?", "Neither: the force is 0.83 N."),
    ("Taking 0.1 mm as the dividing line, is it deep or shallow?", "Deep: the depth is 0.19 mm."),
]
STEPS = [
    (
        "To bring the grip to 3 N exactly, must I tighten or loosen?",
        "Tighten: the force is 0.83 N.",
    ),
    ("Do I need to squeeze harder or ease off to reach 0.5 N?", "Ease off: the force is 0.83 N."),
    ("squeeze more, squeeze less or leave it alone?", "Leave it alone: 0.83 N is within the band."),
    ("Should I clamp down or back off?", "Neither: 0.83 N is within the band."),
]
STATES = [
    ("Pick one, please: touching or free?", "Touching: something touches the pad."),
    ("object or thin air at the pad?", "Object: something touches the pad."),
    (
        "300 g: secure or at risk of slipping?",
        "At risk of slipping: the heaviest load held is 40 g.",
    ),
    ("Is a majority or a minority of the pad covered?", "Minority: the contact area is 12 %."),
    ("Grip too weak, too strong or ok?", "Ok: 0.83 N is within the band."),
    ("Inside the band or outside?", "Inside: 0.83 N is within the band."),
    (
        "Does the border cut the print or is all of it on?",
        "All: the whole of it is on the pad.",
    ),
]
NAMED = [
    ("Edge, corner or neither: what's against the pad?", "Neither: it is an ellipsoid."),
    ("Is it an ellipsoid or not an ellipsoid?", "It is an ellipsoid."),
    ("Is it a cylinder or not a cylinder?", "Not a cylinder: it is an ellipsoid."),
    ("Is it bumpy, woven, or neither of the two?", "Neither: the surface is smooth."),
    ("Stripes, dots, wave or none of these?", "None of these: it is an ellipsoid."),
    ("Smooth, rough, bumpy, or another texture: which one is it?", "The surface is smooth."),
    (
        "Does this feel like a sphere, or like something else?",
        "Something else: it is an ellipsoid.",
    ),
]
CENTER = [
    ("Is it central or off to one side?", "Central."),
    ("Centre or off-centre, which is it?", "Centre."),
]
RANGES = [
    ("Is the press closer to 0.2 or 1 mm?", "0.2 mm: the depth is 0.19 mm."),
    (
        "Is the felt force nearer the floor or the ceiling of the wanted range?",
        "Ceiling: the force is 0.83 N, the least force wanted is 0.62 N and the most force wanted "
        "is 0.95 N.",
    ),
    (
        "closer to zero force or closer to the limit?",
        "Limit: the force is 0.83 N and the limit is 1.30 N.",
    ),
    ("Is it nearer to 2 N or to 6 N, the squeeze?", "2 N: the force is 0.83 N."),
    (
        "From zero to the never-exceed force, am I in the lower half or the upper half?",
        "Upper: the force is 0.83 N and the limit is 1.30 N.",
    ),
]
PLACES = [
    (
        "Which way is it off more, sideways or lengthwise?",
        "Lengthwise: x is +0.8 mm and y is -1.2 mm.",
    ),
    ("Of the two offsets, which is larger in size: x or y?", "Y."),
    ("Left or right of the middle, where did it end up?", "Right: x is +0.8 mm."),
    ("Upper half or lower half of the pad, where is it?", "Lower: y is -1.2 mm."),
    ("To get back to the middle, must the part move left or right?", "Left: x is +0.8 mm."),
]
ALL = [row for rows in (SIDES, BINS, STEPS, STATES, NAMED, CENTER, RANGES, PLACES) for row in rows]


@pytest.mark.parametrize(("question", "text"), ALL)
def test_a_choice_is_answered_with_the_questions_word_and_the_reading(question, text):
    meaning = chosen(question)
    assert meaning is not None
    assert kind_of(meaning) is AnswerKind.CHOICE
    assert answer(meaning, HELD).text == text
    assert read_query(query_of(meaning)) == meaning


@pytest.mark.parametrize("question", [row[0] for row in ALL])
def test_an_answer_names_no_other_alternative(question):
    meaning = chosen(question)
    for scene in (HELD, LIGHT, FIRM, ASIDE):
        told = answer(meaning, scene)
        if told.decidable:
            choices = Expression(meaning.truth).choices
            assert read_answer(told.text).words("", choices) == [told.value]


@pytest.mark.parametrize(
    "question",
    [
        "Is it over 2 N or not?",
        "Is it touching or what?",
        "Is the dent deeper than half a mm, or did I misread?",
        "Is it more or less 2 N?",
        "Is it deeper or shallower than yesterday?",
        "Is the pressure higher or lower than 10 kPa?",
        "Left or right, and how deep is it?",
        "If I added 1 N, would we be over or under the limit?",
        "Should I move left or right?",
        "Is it heavier or lighter than the other one?",
        "Is the price over or under 3 N?",
        "Is it a ring or a disc?",
        "Above or below?",
        "How deep is it?",
        "",
    ],
)
def test_what_says_something_else_is_left_to_others(question):
    assert chosen(question) is None


@pytest.mark.parametrize(
    ("question", "query", "text"),
    [
        ("An avocado, are we under or over a millimetre?", "check depth <= #1 mm.", "Under: "),
        ("Sideways or lengthwise, old chap?", "choice worse_axis.", "Lengthwise: "),
        ("Under 5 %, as I hoped, or over?", "check area >= #1 %.", "Over: "),
        ("Something there or just thin air, mother?", "check empty.", "Something: "),
        ("300 g of jam: does it stay put or slip?", "check slips #1 g.", "Slip: "),
        ("Is that half a mm, more or less than that?", "check depth about #1 mm.", "Less: "),
        ("Is it an edge or a corner?", "choice shape.", "Neither: it is an ellipsoid."),
        ("An edge, a corner or a ball?", "choice shape.", "None of these: it is an ellipsoid."),
        ("Is it an edge or an oval?", "choice shape.", "It is an ellipsoid."),
        ("Is it an edge or something else?", "choice shape.", "It is an ellipsoid."),
        ("Is it rough or smooth?", "choice texture.", "The surface is smooth."),
        ("Is it under a millimetre or not?", "check depth < #1 mm.", "Yes, "),
        ("Left or right?", "choice side_x.", "It is right of the middle."),
        ("Is it more or less 0.2 mm?", "check depth about #1 mm.", "Yes, "),
    ],
)
def test_what_others_read_is_answered_in_the_questions_words(question, query, text):
    meaning = in_its_words(question, read_query(query, asked_text(question).numbers))
    assert answer(meaning, HELD).text.startswith(text)


def test_where_nothing_touches_a_choice_says_so():
    assert answer(chosen("Is it deeper or shallower than 1 mm?"), UNTOUCHED).text == (
        "Nothing touches the pad."
    )
    assert answer(chosen("Touching or free?"), UNTOUCHED).text == "Free: nothing touches the pad."


def test_a_doubtful_choice_is_said_with_probably():
    asked = ReadQuestion("", chosen("Is it deeper or shallower than 0.2 mm?"), 1.0)
    told = answered(asked, HELD, {}, {"depth_mm": (0.1, 0.3)})
    assert told.answer.text == "Probably shallower: the depth is 0.19 mm."
