import dataclasses
import functools
import itertools
import random
from pathlib import Path

import numpy as np
import pytest
import torch

from cltp.llm.constrained.decode import ConstrainedDecoder
from cltp.llm.constrained.grammar import match
from cltp.llm.constrained.tokens import TextTokens
from cltp.tactile.sensors import SENSORS
from cltp.tactile.states import (
    Area,
    ContactState,
    Depth,
    Position,
    Shape,
    Side,
    Texture,
    area_word,
    depth_word,
    position_word,
)
from cltp.texts.tokenizer import ACTIONS, Words
from policies.errors import PolicyError
from policies.goal import Goal
from policies.llm.grammar import (
    ADVICE_IN_CONTACT,
    ADVICE_WITHOUT_CONTACT,
    ALL_NOUNS,
    MAX_FORCE_N,
    caption_grammar,
    step_grammar,
)
from policies.llm.parse import parse_caption_reply, parse_reply
from policies.llm.text import (
    NOTHING,
    advice_text,
    caption_text,
    contact_text,
    goal_text,
    said_numbers,
)
from policies.teacher import Advice, Reason, teacher
from primitives import Primitive
from primitives.contract import Band
from tests.fakes.language import FakeDecoder, random_logits, random_text

MINI = SENSORS["gelsight_mini"]
BAND = Band(low=0.42, high=0.51)
WEIGHTS = Path(__file__).parents[3] / "policies/weights/lm"


@pytest.fixture(scope="module", params=["small", "shipped"])
def words(request: pytest.FixtureRequest) -> Words:
    if request.param == "shipped":
        return Words.load(WEIGHTS)
    rng = random.Random(0)
    texts = [random_text(step_grammar(MINI, BAND), rng) for _ in range(100)]
    return Words.train(texts, size=500)


def random_state(rng: np.random.Generator) -> ContactState:
    depth_mm, area = rng.uniform(0.02, 3.3), float(rng.uniform(0.001, 1) ** 2)
    x_mm, y_mm = rng.uniform(-0.5, 0.5, 2) * (MINI.width_mm, MINI.height_mm)
    return ContactState(
        depth_mm=depth_mm,
        x_mm=x_mm,
        y_mm=y_mm,
        area_fraction=area,
        force_n=float(rng.uniform(0, 40)),
        depth=depth_word(depth_mm),
        position=position_word(x_mm, y_mm, MINI),
        area=area_word(area),
        cut=frozenset(side for side in Side if rng.random() < 0.3),
        shape=list(Shape)[rng.integers(19)],
        texture=list(Texture)[rng.integers(5)],
    )


def test_the_advice_of_the_grammar_is_what_the_teacher_can_give() -> None:
    rng = np.random.default_rng(0)
    given = {False: set(), True: set()}
    for _ in range(4000):
        state = random_state(rng)
        state = dataclasses.replace(state, force_n=rng.uniform(0.05, 2.0))
        near = rng.choice([0.0, 0.3, 1.0])
        state = dataclasses.replace(state, x_mm=near * state.x_mm, y_mm=near * state.y_mm)
        if rng.random() < 0.1:
            state = dataclasses.replace(state, area_fraction=0.002)
        if rng.random() < 0.05:
            state = dataclasses.replace(state, depth=None)
        low, reach_mm = rng.uniform(0.1, 1.5), rng.choice([1.0, 3.0])
        goal = Goal(
            force_n=Band(low=low, high=low * rng.uniform(1.02, 2.1)),
            depth_mm=Band(low=0.0, high=5.0),
            area_fraction=Band(low=0.0, high=1.0),
            x_mm=Band(low=-reach_mm, high=reach_mm),
            y_mm=Band(low=-reach_mm, high=reach_mm),
        )
        given[state.in_contact].add(teacher(state, goal, move_step_mm=3.0))
    assert given[True] == set(ADVICE_IN_CONTACT)
    assert given[False] == set(ADVICE_WITHOUT_CONTACT)


def test_what_the_teacher_says_is_in_the_grammar_and_reads_back() -> None:
    rng = np.random.default_rng(1)
    for _ in range(300):
        state = random_state(rng)
        advice = ADVICE_IN_CONTACT[rng.integers(len(ADVICE_IN_CONTACT))]
        doubtful = {"depth_mm": (0.2, 0.55), "area_fraction": (0.021, 0.12)}
        ends = doubtful if rng.random() < 0.5 else {}
        rivals = {"shape": "ring", "depth": "deep"} if rng.random() < 0.5 else {}
        if state.shape == "ring" or state.depth == "deep":
            rivals = {}
        contact = contact_text(state, said_numbers(state, ends), rivals)
        text = f"{contact} {goal_text(BAND)} {advice_text(advice)}"
        assert match(step_grammar(MINI, BAND), text)[1], text
        parsed = parse_reply(text, MINI)
        assert (parsed.goal, parsed.advice, parsed.cut) == (BAND, advice, state.cut)
        assert parsed.words["shape"] == state.shape
        assert parsed.words["position"] == state.position
        assert parsed.rivals == rivals
        assert parsed.numbers["x_mm"] == pytest.approx((state.x_mm,) * 2, abs=0.051)
        assert parsed.numbers["force_n"] == pytest.approx((state.force_n,) * 2, abs=0.0051)
        if ends:
            assert parsed.numbers["depth_mm"] == (0.2, 0.55)
            assert parsed.numbers["area_fraction"] == pytest.approx((0.021, 0.12))


def test_captions_of_states_are_in_the_grammar_and_read_back() -> None:
    rng = np.random.default_rng(2)
    for number in range(300):
        state = random_state(rng)
        state = dataclasses.replace(state, depth_mm=min(state.depth_mm, 3.1))
        missing = [n for n in ("texture", "shape") if number % 5 == 0 and rng.random() < 0.5]
        state = dataclasses.replace(state, **dict.fromkeys(missing))
        parsed = parse_caption_reply(caption_text(state), MINI)
        assert parsed.in_contact
        assert parsed.words.get("texture") == state.texture
        assert parsed.words.get("shape") == state.shape
        assert parsed.numbers["depth_mm"] == pytest.approx((state.depth_mm,) * 2, abs=0.0051)
        assert parsed.cut == state.cut
        ends = {
            "depth_mm": (0.7 * state.depth_mm, state.depth_mm + 0.2),
            "x_mm": (-9.0, 9.0),
            "force_n": (0.95 * state.force_n, 1.05 * state.force_n),
        }
        parsed = parse_caption_reply(caption_text(state, ends=ends), MINI)
        low, high = ends["depth_mm"]
        assert parsed.numbers["depth_mm"] == pytest.approx((low, high), abs=0.0051)
        assert parsed.numbers["x_mm"] == pytest.approx((state.x_mm,) * 2, abs=0.051)
        assert parsed.numbers["force_n"] == pytest.approx((state.force_n,) * 2, abs=0.0051)
    empty = dataclasses.replace(state, depth=None)
    assert not parse_caption_reply(caption_text(empty)).in_contact


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ("0.31", "0.31"),
        ("18.79-67.89", "18.79-60.00"),
        ("61.20-70.00", "60.00"),
        ("-0.05-0.20", "0.00-0.20"),
        ("75.00", "60.00"),
    ],
)
def test_a_number_beyond_the_range_is_said_as_the_nearest_and_never_made_up(given, said) -> None:
    grammar, rng = caption_grammar(MINI, numbers={"force_n": given}), random.Random(0)
    texts = [text for _ in range(60) if " mm, 0.00 N." not in (text := random_text(grammar, rng))]
    assert texts
    assert all(f" mm, {said} N, " in text for text in texts)


@pytest.mark.parametrize("sensor", SENSORS)
def test_random_texts_of_the_grammar_read_back_and_have_the_tokens_of_their_parts(
    sensor: str, words: Words
) -> None:
    rng = random.Random(sensor)
    tokens = TextTokens(words.encode)
    for nouns, _ in itertools.product(ALL_NOUNS, range(40)):
        grammar = step_grammar(SENSORS[sensor], BAND, nouns=nouns)
        text = random_text(grammar, rng)
        assert parse_reply(text, SENSORS[sensor]).goal == BAND
        described = random_text(caption_grammar(SENSORS[sensor], nouns), rng)
        parse_caption_reply(described, SENSORS[sensor])
        for said, each in ((text, grammar), (described, caption_grammar(SENSORS[sensor], nouns))):
            segments, is_whole = match(each, said)
            assert is_whole
            parts = [token for segment in segments for token in tokens.of(segment.text)]
            assert parts == words.encode(said)
            assert words.decode(parts) == said


GOOD = (
    "smooth or rough sphere, deep 0.70-0.90 mm, centered x +0.4 y -1.1, tiny 2.1 %, 0.43 N, cut "
    "left right. Goal 0.42 - 0.51 N. Action: <none>. The grasp is stable."
)


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("smooth or rough", "smooth or smooth"),
        ("smooth or rough", "smooth or sphere"),
        ("smooth", "Smooth"),
        ("0.70-0.90", "0.90-0.70"),
        ("0.70-0.90", "0.70-0.70"),
        ("0.70-0.90", "0.70-3.41"),
        ("0.70-0.90", "00.70"),
        ("0.70-0.90", "0.7"),
        ("+0.4", "0.4"),
        ("+0.4", "+10.2"),
        ("+0.4", "+0.4-0.5"),
        ("-1.1", "-7.7"),
        ("2.1 %", "12.1 %"),
        ("2.1 %", "101 %"),
        ("0.43 N,", "60.01 N,"),
        ("0.43 N,", "0.43 N"),
        ("left right", "right left"),
        ("left right", "left left"),
        ("0.42 - 0.51", "0.51 - 0.42"),
        ("0.42 - 0.51", "00.42 - 0.51"),
        ("<none>", "<move_up>"),
        ("<none>", "<reset>"),
        ("<none>", "none"),
        ("The grasp is stable.", "The object was missed."),
        ("The grasp is stable.", "The grasp is stable. "),
        ("The grasp is stable.", "The grasp is stable"),
        ("smooth", " smooth"),
        (" Goal", "  Goal"),
        (" Goal 0.42 - 0.51 N.", " Goal 0.42 - 0.51 N. Goal 0.42 - 0.51 N."),
    ],
)
def test_a_text_that_is_off_by_a_little_is_refused(old: str, new: str) -> None:
    parse_reply(GOOD, MINI)
    assert old in GOOD
    with pytest.raises(PolicyError):
        parse_reply(GOOD.replace(old, new, 1), MINI)


def test_random_changes_of_a_character_are_refused_or_say_something_else() -> None:
    rng = random.Random(3)
    grammar = step_grammar(MINI, BAND)
    refused = 0
    for _ in range(1000):
        text = random_text(grammar, rng)
        at = rng.randrange(len(text))
        changed = text[:at] + rng.choice("aeorstx019 .,-+<>_%") + text[at + 1 :]
        if changed == text:
            continue
        try:
            assert parse_reply(changed, MINI) != parse_reply(text, MINI) or "0.0" in text
        except PolicyError:
            refused += 1
    assert refused > 700


@pytest.mark.parametrize(
    "words", [pytest.param("small", marks=pytest.mark.slow), "shipped"], indirect=True
)
def test_ten_thousand_replies_by_chance_all_keep_the_grammar(words: Words) -> None:
    tokens = TextTokens(words.encode)
    named, barred_named, doubts, intervals = set(), set(), 0, 0
    for seed in range(5000):
        sensor = list(SENSORS.values())[seed % 4]
        band = Band(low=0.1 + seed % 50 / 100, high=1.0 + seed % 70 / 100)
        barred = ACTIONS[: seed % 8] if seed % 3 == 0 else ()
        decoder = ConstrainedDecoder(FakeDecoder(random_logits_of(words, seed)), tokens)
        reply = decoder.decode(torch.zeros(5, 1), step_grammar(sensor, band, barred))
        assert reply.ended
        assert reply.ids == words.encode(reply.text)
        parsed = parse_reply(reply.text, sensor)
        assert parsed.goal == Band(low=round(band.low, 2), high=round(band.high, 2))
        action = f"<{parsed.advice.action or 'none'}>"
        assert action == reply.decisions["action"].chosen
        (barred_named if action in barred else named).add(action)
        doubts += bool(parsed.rivals)
        if parsed.in_contact:
            assert 0 <= parsed.numbers["depth_mm"][1] <= sensor.gel_mm
            assert abs(parsed.numbers["x_mm"][0]) <= sensor.width_mm / 2
            assert abs(parsed.numbers["y_mm"][0]) <= sensor.height_mm / 2
            assert 0 <= parsed.numbers["area_fraction"][1] <= 1
            assert 0 <= parsed.numbers["force_n"][1] <= MAX_FORCE_N
            intervals += any(low < high for low, high in parsed.numbers.values())
        else:
            assert parsed.advice.reason is Reason.NO_CONTACT
    assert named == set(ACTIONS)
    assert not barred_named
    assert doubts > 500
    assert intervals > 500


def test_given_numbers_are_said_as_they_are_or_as_the_nearest_in_range(words: Words) -> None:
    given = {
        "depth_mm": "0.12-0.31",
        "x_mm": "-8.0",
        "y_mm": "+3.4",
        "area_fraction": "9.7-20",
        "force_n": f"{MAX_FORCE_N + 1:.2f}",
    }
    said = "{depth_mm} mm,", "x {x_mm} y {y_mm},", " {area_fraction} %,"
    grammar, tokens = step_grammar(MINI, BAND, numbers=given), TextTokens(words.encode)
    for seed in range(50):
        decoder = ConstrainedDecoder(FakeDecoder(random_logits_of(words, seed)), tokens)
        reply = decoder.decode(torch.zeros(1, 1), grammar)
        assert reply.ids == words.encode(reply.text)
        parsed = parse_reply(reply.text, MINI)
        if parsed.in_contact:
            assert all(text.format(**given) in reply.text for text in said)
            assert parsed.numbers["depth_mm"] == (0.12, 0.31)
            assert parsed.numbers["force_n"] == (MAX_FORCE_N, MAX_FORCE_N)
            assert not {"depth_mm", "force_n"} & set(reply.decisions)


@pytest.mark.parametrize("text", ["0.31-0.12", "0.12-", "nan", "", "1e-3"])
def test_what_is_no_number_is_not_taken_over(words: Words, text: str) -> None:
    decoder = ConstrainedDecoder(FakeDecoder(random_logits_of(words, 1)), TextTokens(words.encode))
    reply = decoder.decode(
        torch.zeros(1, 1), step_grammar(MINI, BAND, ["<reset>"], numbers={"depth_mm": text})
    )
    assert parse_reply(reply.text, MINI).in_contact
    assert "depth_mm" in reply.decisions


random_table = functools.cache(random_logits)


def random_logits_of(words: Words, seed: int):
    """Logits by chance out of a few tables, which take long to make."""
    table = random_table(len(words), seed % 4)
    return lambda said: table((seed, *said))


def test_where_reset_is_barred_it_can_not_say_that_nothing_touches(words: Words) -> None:
    nothing = words.encode(NOTHING)[0]

    def logits(said: tuple[int, ...]) -> torch.Tensor:
        return torch.nn.functional.one_hot(torch.tensor(nothing), len(words)).float() * 9

    decoder = ConstrainedDecoder(FakeDecoder(logits), TextTokens(words.encode))
    assert decoder.decode(torch.zeros(1, 1), step_grammar(MINI, BAND)).text == (
        f"Nothing touches. {goal_text(BAND)} Action: <reset>. The object was missed."
    )
    barred = decoder.decode(torch.zeros(1, 1), step_grammar(MINI, BAND, ["<reset>"]))
    assert parse_reply(barred.text).in_contact
    with pytest.raises(PolicyError, match="every action"):
        step_grammar(MINI, BAND, ACTIONS)


def test_only_the_goal_of_a_further_step_is_compiled(words: Words) -> None:
    encoded: list[str] = []

    def encode(text: str) -> list[int]:
        encoded.append(text)
        return words.encode(text)

    decoder = ConstrainedDecoder(FakeDecoder(random_logits_of(words, 0)), TextTokens(encode))
    for number in range(50):
        goal = Band(low=0.1, high=1 + number / 100)
        for barred in ([], ["<move_up>"], ["<reset>"]):
            decoder.decode(torch.zeros(1, 1), step_grammar(MINI, goal, barred))
    goals = [text for text in encoded if "Goal" in text]
    assert len(goals) == len(set(goals)) == 50
    assert len(encoded) == len(set(encoded)) < 400


def test_every_word_of_a_contact_can_be_said_in_doubt() -> None:
    for name, classes in (("depth", Depth), ("position", Position), ("area", Area)):
        for word, rival in itertools.permutations(classes, 2):
            state = dataclasses.replace(random_state(np.random.default_rng(0)), **{name: word})
            contact = contact_text(state, rivals={name: rival})
            text = f"{contact} {goal_text(BAND)} {advice_text(ADVICE_IN_CONTACT[0])}"
            assert parse_reply(text).rivals == {name: rival}


def test_success_and_a_band_too_narrow_are_told_apart() -> None:
    narrow = Advice(action=None, success=False, reason=Reason.BAND_TOO_NARROW)
    contact = contact_text(random_state(np.random.default_rng(4)))
    assert parse_reply(f"{contact} {goal_text(BAND)} {advice_text(narrow)}").advice == narrow
    up = Advice(action=Primitive.MOVE_UP, success=False, reason=Reason.CUT)
    assert parse_reply(f"{contact} {goal_text(BAND)} {advice_text(up)}").advice == up


def test_a_caption_says_the_cuts_that_it_is_given():
    rng = random.Random(0)
    for cut in ((), (Side.LEFT,), (Side.TOP, Side.LEFT)):
        grammar = caption_grammar(MINI, cut=cut)
        for text in (random_text(grammar, rng) for _ in range(20)):
            is_empty = " 0.00 mm, 0.00 N." in text
            assert is_empty or parse_caption_reply(text).cut == frozenset(cut)
