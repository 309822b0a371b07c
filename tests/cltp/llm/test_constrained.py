import itertools
import math
import random

import numpy as np
import pytest
import torch

from cltp.errors import TouchError
from cltp.llm.constrained.decode import (
    CLOSE,
    CLOSE_REDUCED,
    Constrained,
    ConstrainedDecoder,
)
from cltp.llm.constrained.grammar import NumberRange, Option, TextChoice, Verbatim, match
from cltp.llm.constrained.tokens import TextTokens
from cltp.llm.fast_decode import FastDecoder
from cltp.texts.tokenizer import ACTIONS, Words
from tests.fakes.language import (
    FakeDecoder,
    random_lm,
    random_logits,
    random_text,
    scripted_logits,
)


def words_of(name: str, values: tuple[str, ...]) -> TextChoice:
    return TextChoice(name, tuple(Option(v, f" {v}", f" or {v}") for v in values))


PLACES = ("top-left", "top-right", "centered", "low-left", "low-right")
DEPTH = words_of("depth", ("slight", "deep", "very deep"))
PLACE = words_of("place", PLACES)
HUNDREDTHS = tuple(f"{i / 100:.2f}" for i in range(121))
PERCENTS = tuple([f"{i / 10:.1f}" for i in range(100)] + [str(i) for i in range(10, 101)])
ACT = TextChoice("action", tuple(Option(a, f" {a}", then=(Verbatim(" is it."),)) for a in ACTIONS))
GRAMMAR = (
    Verbatim("It is"),
    DEPTH,
    NumberRange("depth_mm", HUNDREDTHS, " mm,", interval=True),
    PLACE,
    NumberRange("x_mm", ("-1.0", "-0.5", "+0.0", "+0.5", "+1.0"), ","),
    NumberRange("area", PERCENTS, " %.", interval=True),
    Verbatim(" Action:"),
    ACT,
)


@pytest.fixture(scope="module")
def words() -> Words:
    rng = random.Random(0)
    return Words.train([random_text(GRAMMAR, rng) for _ in range(60)], size=450)


def decoder_of(words: Words, logits) -> tuple[FakeDecoder, ConstrainedDecoder]:
    fake = FakeDecoder(logits)
    return fake, ConstrainedDecoder(fake, TextTokens(words.encode))


INPUTS = torch.zeros(7, 4)


def test_what_is_forced_costs_no_pass(words: Words) -> None:
    fake, decoder = decoder_of(words, random_logits(len(words), 0))
    reply = decoder.decode(INPUTS, (Verbatim("It is deep."),))
    assert (reply.text, reply.passes, fake.passes) == ("It is deep.", 0, 0)
    only = TextChoice("depth", DEPTH.options[:1])
    reply = decoder.decode(INPUTS, (Verbatim("It is"), only, Verbatim(", in"), PLACE))
    assert fake.passes == reply.passes <= 3  # two decisions, and perhaps that of a rival
    assert reply.decisions["depth"].probability == 1.0


def prefix(words: Words, text: str) -> tuple[int, ...]:
    return tuple(words.encode(text))


def softmax(*scores: float) -> list[float]:
    weights = np.exp(scores)
    return list(weights / weights.sum())


def test_a_word_is_chosen_by_softmax_over_its_slot_alone(words: Words) -> None:
    slight, deep, very = (words.encode(f" {w}")[0] for w in ("slight", "deep", "very"))
    other = words.encode(" Action")[0]
    script = {prefix(words, "It is"): {slight: 1.0, deep: 3.0, very: 0.5, other: 50.0}}
    _, decoder = decoder_of(words, scripted_logits(len(words), script))
    decision = decoder.decode(INPUTS, (Verbatim("It is"), DEPTH)).decisions["depth"]
    expected = softmax(1.0, 3.0, 0.5)
    assert decision.chosen == "deep"
    assert decision.rival == ""
    assert decision.probability == pytest.approx(expected[1])
    assert decision.probabilities == pytest.approx(
        dict(zip(("slight", "deep", "very deep"), expected, strict=True))
    )


@pytest.mark.parametrize(("below", "text"), [(0.6, "deep or slight"), (0.5, "deep")])
def test_a_word_in_doubt_is_said_with_its_rival(words: Words, below: float, text: str) -> None:
    slight, deep, very = (words.encode(f" {w}")[0] for w in ("slight", "deep", "very"))
    row = {slight: math.log(30), deep: math.log(55), very: math.log(15)}
    _, decoder = decoder_of(words, scripted_logits(len(words), {prefix(words, "It is"): row}))
    grammar = (Verbatim("It is"), DEPTH, Verbatim("."))
    reply = decoder.decode(INPUTS, grammar, doubt_below={"depth": below})
    assert reply.text == f"It is {text}."
    assert reply.decisions["depth"].probability == pytest.approx(0.55)
    assert reply.decisions["depth"].rival == ("slight" if below == 0.6 else "")


def test_words_that_begin_alike_are_told_apart_further_on(words: Words) -> None:
    top, low, centered = (words.encode(f" {w}")[0] for w in ("top", "low", "centered"))
    dash = words.encode(" top-left")[1]
    left, right = words.encode(" top-left")[2], words.encode(" top-right")[2]
    script = {
        (): {top: math.log(5), low: math.log(3), centered: math.log(2)},
        (top, dash): {left: math.log(8), right: math.log(2)},
        (top, dash, left, *words.encode(" or low-")): {left: 0.0, right: 1.0},
    }
    _, decoder = decoder_of(words, scripted_logits(len(words), script))
    reply = decoder.decode(INPUTS, (PLACE,))
    decision = reply.decisions["place"]
    assert reply.text == " top-left or low-right"
    assert (decision.chosen, decision.rival) == ("top-left", "low-right")
    assert decision.probability == pytest.approx(0.4)
    assert decision.probabilities == pytest.approx(
        {"top-left": 0.4, "top-right": 0.1, "centered": 0.2, "low-left|low-right": 0.3}
    )


def test_the_model_never_decides_itself_to_name_a_rival(words: Words) -> None:
    deep, either = words.encode(" deep")[0], words.encode(" or")[0]
    table = torch.zeros(len(words))
    table[either], table[deep] = 50.0, 9.0
    _, decoder = decoder_of(words, lambda _: table)
    assert decoder.decode(INPUTS, (Verbatim("It is"), DEPTH, Verbatim("."))).text == "It is deep."


def test_the_model_decides_itself_on_an_interval(words: Words) -> None:
    number = NumberRange("depth_mm", HUNDREDTHS, " mm", interval=True)
    low = prefix(words, "It is 0.45")
    dash, unit = words.encode("-0")[0], words.encode(" mm")[0]
    digits = [words.encode(f" 0.4{n}")[2] for n in range(10)]
    start = {prefix(words, "It is 0.4"): {digits[5]: 9.0},
             prefix(words, "It is 0"): {words.encode(" 0.4")[1]: 9.0},
             prefix(words, "It is"): {words.encode(" 0")[0]: 9.0}}  # fmt: skip
    for chance in (dash, unit):
        _, decoder = decoder_of(words, scripted_logits(len(words), start | {low: {chance: 9.0}}))
        reply = decoder.decode(INPUTS, (Verbatim("It is"), number))
        if chance == unit:
            assert reply.text == "It is 0.45 mm"
        else:
            assert reply.text.startswith("It is 0.45-")
            ends = reply.decisions["depth_mm"].chosen.split("-")
            assert float(ends[0]) < float(ends[1]) <= 1.20


def test_nothing_but_the_number_is_possible_at_the_top_of_its_range(words: Words) -> None:
    number = NumberRange("depth_mm", ("0.11", "0.12"), " mm", interval=True)
    dash = words.encode("-0")[0]
    row = torch.zeros(len(words))
    row[dash], row[words.encode(" 0.12")[2]] = 50.0, 9.0
    _, decoder = decoder_of(words, lambda _: row)
    assert decoder.decode(INPUTS, (number,)).text == " 0.12 mm"
    row[words.encode(" 0.11")[2]] = 20.0
    assert decoder.decode(INPUTS, (number,)).text == " 0.11-0.12 mm"


def test_action_probabilities_are_those_of_an_independent_computation(words: Words) -> None:
    for seed in range(20):
        logits = random_logits(len(words), seed)
        _, decoder = decoder_of(words, logits)
        penalties = {ACTIONS[seed % 8]: math.inf, ACTIONS[(seed + 3) % 8]: math.log(3)}
        reply = decoder.decode(INPUTS, (Verbatim("Action:"), ACT), penalties=penalties)
        row = logits(prefix(words, "Action:")).double()
        row[words.actions[seed % 8]] = -math.inf
        row[words.actions[(seed + 3) % 8]] -= math.log(3)
        expected = dict(zip(ACTIONS, row[words.actions].softmax(-1).tolist(), strict=True))
        del expected[ACTIONS[seed % 8]]
        decision = reply.decisions["action"]
        assert decision.probabilities == pytest.approx(expected)
        assert decision.chosen == max(expected, key=expected.__getitem__)
        assert ACTIONS[seed % 8] not in reply.text
    with pytest.raises(TouchError, match="action"):
        decoder.decode(INPUTS, (ACT,), penalties=dict.fromkeys(ACTIONS, math.inf))


def test_a_perfect_draft_costs_one_pass_and_a_wrong_one_few(words: Words) -> None:
    rng = random.Random(1)
    spent, num_close = [], 0
    for seed in range(50):
        logits = random_logits(len(words), seed)
        _, decoder = decoder_of(words, logits)
        plain = decoder.decode(INPUTS, GRAMMAR)
        fake, decoder = decoder_of(words, logits)
        drafted = decoder.decode(INPUTS, GRAMMAR, draft=plain.text)
        assert said(drafted) == said(plain)
        assert drafted.passes == fake.passes
        if drafted.close_calls == 0:
            assert fake.passes == 1
        num_close += drafted.close_calls
        fake, decoder = decoder_of(words, logits)
        other = decoder.decode(INPUTS, GRAMMAR, draft=random_text(GRAMMAR, rng))
        assert said(other) == said(plain)
        spent.append((plain.passes, fake.passes))
    plain_passes, other_passes = np.mean(spent, axis=0)
    assert num_close < 5
    assert plain_passes > 8
    assert other_passes <= plain_passes


def said(reply: Constrained) -> tuple[object, ...]:
    return reply.text, reply.ids, reply.ended, reply.decisions


def test_after_a_wrong_word_the_rest_of_a_draft_still_saves_passes(words: Words) -> None:
    """The logits depend on the last two tokens alone, so that the rest stays as it was."""
    logits = random_logits(len(words), 5)
    _, decoder = decoder_of(words, lambda said: logits(said[-2:]))
    plain = decoder.decode(INPUTS, GRAMMAR)
    depth = plain.decisions["depth"]
    right = f"{depth.chosen} or {depth.rival}" if depth.rival else depth.chosen
    for wrong in ("slight", "deep or slight", "very deep"):
        if wrong == right:
            continue
        assert right in plain.text
        draft = plain.text.replace(right, wrong, 1)
        drafted = decoder.decode(INPUTS, GRAMMAR, draft=draft)
        assert drafted.text == plain.text
        assert drafted.passes <= 5 < plain.passes  # the draft, its rest in pieces, perhaps a rival


@pytest.mark.parametrize("seed", range(12))
def test_no_draft_changes_what_a_model_says(words: Words, seed: int) -> None:
    decoder = ConstrainedDecoder(FastDecoder(random_lm(len(words), seed)), TextTokens(words.encode))
    inputs = torch.randn(30, 48, generator=torch.Generator().manual_seed(seed))
    plain = decoder.decode(inputs, GRAMMAR)
    rng = random.Random(seed)
    random_drafts = [random_text(GRAMMAR, rng) for _ in range(4)]
    for draft in (plain.text, plain.text[: len(plain.text) // 2], "nonsense", *random_drafts):
        drafted = decoder.decode(inputs, GRAMMAR, draft=draft)
        assert (drafted.text, drafted.ids) == (plain.text, plain.ids)
        for name, decision in drafted.decisions.items():
            assert decision.probabilities == pytest.approx(
                plain.decisions[name].probabilities, abs=1e-4
            )
        if draft == plain.text and drafted.close_calls == 0:
            assert drafted.passes == 1


def test_close_decisions_are_taken_from_a_pass_of_their_own(words: Words) -> None:
    """What a draft's pass rounds otherwise than single ones must not decide."""
    slight, deep = (words.encode(f" {w}")[0] for w in ("slight", "deep"))

    class Rounding(FakeDecoder):
        """Passes over several tokens at once say 'slight', others 'deep', by a hair."""

        def begin(self, embeddings, tokens=(), *, reduced=False):
            rows = super().begin(embeddings, tokens, reduced=reduced)
            more = torch.zeros(len(words))
            more[slight if len(tokens) > 4 else deep] = CLOSE / 4
            return [row + more for row in rows]

    table = torch.zeros(len(words))
    table[[slight, deep]] = 9.0
    grammar = (Verbatim("It is"), DEPTH, Verbatim("."), PLACE)
    decoder = ConstrainedDecoder(Rounding(lambda _: table), TextTokens(words.encode))
    plain = decoder.decode(INPUTS, grammar, doubt_below={"depth": 0.1})
    drafted = decoder.decode(
        INPUTS, grammar, draft="It is slight. top-left", doubt_below={"depth": 0.1}
    )
    assert plain.decisions["depth"].chosen == "deep"
    assert drafted.text == plain.text
    assert plain.close_calls >= 1
    assert drafted.close_calls >= 1


@pytest.mark.parametrize("scale", [3.0, 0.1])
def test_what_reduced_precision_rounds_decides_nothing(words: Words, scale: float) -> None:
    """Logits are off by half of ``CLOSE_REDUCED`` until tokens are run through again."""
    closest = 0
    for seed in range(30):
        logits = random_logits(len(words), seed, scale)
        error = random_logits(len(words), 1000 + seed, 1.0)

        def rounded(said: tuple[int, ...], logits=logits, error=error) -> torch.Tensor:
            return logits(said) + error(said).clamp(-1, 1) * CLOSE_REDUCED / 4

        reduced = FakeDecoder(logits, rounded)
        _, precise = decoder_of(words, logits)
        draft = random_text(GRAMMAR, random.Random(seed)) if seed % 2 else ""
        expected = precise.decode(INPUTS, GRAMMAR, draft=draft)
        found = ConstrainedDecoder(reduced, TextTokens(words.encode)).decode(
            INPUTS, GRAMMAR, draft=draft
        )
        assert (found.text, found.ids, found.ended) == (expected.text, expected.ids, expected.ended)
        refined = found.close_calls - expected.close_calls
        assert refined in (0, 1)  # once run through again, a reply goes on in full precision
        assert reduced.is_reduced == (refined == 0 and expected.close_calls == 0)
        closest += refined
    assert (closest > 20) == (scale < 1)


def test_reduced_passes_are_nearly_precise_and_a_new_begin_is_precise() -> None:
    lm = random_lm(60, 1)
    inputs, tokens = torch.randn(40, 48), [3, 14, 15, 9, 26, 5]
    precise, reduced = FastDecoder(lm), FastDecoder(lm, reduces=True)
    expected = precise.logits(precise.begin(inputs, tokens))
    found = reduced.logits(reduced.begin(inputs, tokens, reduced=True))
    assert reduced.is_reduced
    assert not torch.equal(found, expected)
    assert (found - expected).std() < 0.03 * expected.std()
    assert torch.equal(reduced.logits(reduced.begin(inputs, tokens)), expected)
    assert not reduced.is_reduced
    precise.begin(inputs, tokens, reduced=True)
    assert not precise.is_reduced


def test_a_reply_beyond_the_positions_is_cut_off_and_says_so(words: Words) -> None:
    fake, decoder = decoder_of(words, random_logits(len(words), 0))
    fake.longest = 12
    reply = decoder.decode(INPUTS, GRAMMAR, draft=random_text(GRAMMAR, random.Random(0)))
    assert not reply.ended
    assert reply.ids == words.encode(reply.text) or len(reply.ids) >= 5


def test_a_text_that_begins_another_is_refused(words: Words) -> None:
    _, decoder = decoder_of(words, random_logits(len(words), 0))
    ambiguous = words_of("depth", ("very", "very deep"))
    with pytest.raises(TouchError, match="begins another"):
        decoder.decode(INPUTS, (ambiguous,))


def test_a_pass_over_many_tokens_gives_the_logits_of_single_ones() -> None:
    lm = random_lm(60, 0)
    inputs = torch.randn(9, 48)
    tokens = [3, 14, 15, 9, 26, 5]
    single, many, joint = FastDecoder(lm), FastDecoder(lm), FastDecoder(lm)
    expected = torch.stack([single.prefill(inputs), *(single.step(t) for t in tokens)])
    torch.testing.assert_close(
        joint.logits(joint.begin(inputs, tokens)), expected, atol=1e-4, rtol=1e-4
    )
    many.prefill(inputs)
    states = many.advance(tokens[:4])
    torch.testing.assert_close(many.logits(states), expected[1:5], atol=1e-4, rtol=1e-4)
    some = torch.tensor(many.scores(states[0], [3, 1]))
    torch.testing.assert_close(some, expected[1][[3, 1]], atol=1e-4, rtol=1e-4)
    many.advance([7, 8, 9])
    many.rewind(9 + 2)
    states = many.advance(tokens[2:])
    torch.testing.assert_close(many.logits(states), expected[3:], atol=1e-4, rtol=1e-4)
    with pytest.raises(ValueError, match="rewound"):
        many.rewind(100)


def test_random_texts_are_split_into_parts_of_the_same_tokens(words: Words) -> None:
    tokens = TextTokens(words.encode)
    rng = random.Random(2)
    for _, cut in itertools.product(range(50), (None, 20)):
        text = random_text(GRAMMAR, rng)[:cut]
        segments, is_whole = match(GRAMMAR, text)
        assert is_whole == (cut is None)
        if is_whole:
            assert [t for s in segments for t in tokens.of(s.text)] == words.encode(text)
        else:
            assert text.startswith("".join(segment.text for segment in segments))
