"""Our tokenizer and transformers' AutoTokenizer read and write the same, from the same folder."""

import json
import random
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from transformers import AutoTokenizer

from cltp.errors import TouchError
from cltp.texts.tokenizer import ACTIONS, CONTROL, Words, names_our_tokens
from tacgrasp.policy_factory import shipped_weights

TEXTS = [
    "Pick the strawberry gently, without bruising it.",
    "smooth sphere, deep 0.70 mm, centered x +0.0 y -1.2, large 21 %, 2.10 N. Goal 1.00 - 2.00 N.",
    "Action: <move_up>. It is off centre. Action: <none>. The grasp is stable.",
] * 5
RARE = ("compare", "why", "how", "softer", "lemon", "quite", "because", "explain")
KINDS = ("shipped lm", "shipped clip", "small", "large", "earlier layout")


def earlier_layout(words: Words, folder: Path) -> None:
    """The one file that a folder had before: actions special, a decoder that joins bytes alone."""
    words.save(folder)
    content = json.loads((folder / "tokenizer.json").read_text())
    for token in content["added_tokens"]:
        token["special"] = True
    content["decoder"] = {**content["decoder"]["decoders"][0]}
    for path in folder.iterdir():
        path.unlink()
    (folder / "tokenizer.json").write_text(json.dumps(content))


@pytest.fixture(scope="module")
def pairs(tmp_path_factory: pytest.TempPathFactory) -> dict[str, tuple[Words, AutoTokenizer]]:
    """By kind: our tokenizer, and what transformers reads from its folder; nothing is online."""
    root = tmp_path_factory.mktemp("tokenizers")
    folders = {kind: root / kind for kind in KINDS}
    folders |= {f"shipped {part}": shipped_weights() / part for part in ("lm", "clip")}
    Words.train(TEXTS, size=400).save(folders["small"])
    Words.train(TEXTS, size=4000, whole=RARE).save(folders["large"])
    earlier_layout(Words.train(TEXTS, size=400), root / "before")
    Words.load(root / "before").save(folders["earlier layout"])
    return {
        kind: (Words.load(folder), AutoTokenizer.from_pretrained(folder, local_files_only=True))
        for kind, folder in folders.items()
    }


def numeric_text(rng: random.Random) -> str:
    """A text of two to twelve pieces: numbers of all spellings, actions, words, other signs."""
    number = f"{rng.uniform(0, 10 ** rng.randint(0, 4)):.{rng.randint(0, 4)}f}"
    pieces = (
        lambda: f"{rng.choice(('', '+', '-', '−', '±', '~', '--'))}{number}",
        lambda: f"{number}{rng.choice((' mm', ' N', ' %', '%', ' µm', 'µm', '°', 'N/mm²'))}",
        lambda: f"{number}{rng.choice(('-', ' - ', '–', '..', ' to ', '/'))}{number}",
        lambda: rng.choice((f"1e-{rng.randint(0, 9)}", f".{rng.randint(0, 9)}", "1,000", "٣", "½")),
        lambda: rng.choice((*ACTIONS, *CONTROL, f"<{rng.choice(('move', 'move_up', '/none>'))}")),
        lambda: rng.choice(("Grip", "GRIP", "gRiP", "berry", "Kraftschluss", "qzxv", "isn't")),
        lambda: rng.choice((*RARE, "naïve", "naïve", "Ελλάς", "力", "👍🏽", "a\u200db", "x_y")),
        lambda: rng.choice(("?!", "...", "“q”", "(a)", "#1", "\t", "\n", "  ", "\u00a0", "é")),
    )  # fmt: skip
    chosen = (rng.choice(pieces)() for _ in range(rng.randint(2, 12)))
    return rng.choice(("", " ")).join(chosen) if rng.random() < 0.3 else " ".join(chosen)


def assert_same(words: Words, theirs: AutoTokenizer, text: str) -> None:
    ids = words.encode(text)
    assert theirs(text)["input_ids"] == ids
    assert theirs.decode(ids, skip_special_tokens=True) == words.decode(ids)


@pytest.mark.parametrize("kind", KINDS)
def test_a_thousand_texts_with_numbers_have_the_same_tokens(
    kind: str, pairs: dict[str, tuple[Words, AutoTokenizer]]
) -> None:
    words, theirs = pairs[kind]
    rng = random.Random(0)
    texts = {numeric_text(rng) for _ in range(1050)}
    assert len(texts) >= 1000
    assert sum(any(sign.isdigit() for sign in text) for text in texts) > 700
    for text in texts:
        assert_same(words, theirs, text)


parts = st.one_of(
    st.text(max_size=6),
    st.sampled_from((*ACTIONS, *CONTROL)),
    st.floats(-99, 99).map(lambda x: f"{x:+.2f}"),
    st.sampled_from((" ", "\n", ".", "-", " %", "µm")),
)


@pytest.mark.parametrize("kind", KINDS)
def test_any_text_has_the_same_tokens(
    kind: str, pairs: dict[str, tuple[Words, AutoTokenizer]]
) -> None:
    @given(st.lists(parts, max_size=8).map("".join))
    def same(text: str) -> None:
        assert_same(*pairs[kind], text)

    same()


@pytest.mark.parametrize("kind", KINDS)
def test_any_tokens_have_the_same_text(
    kind: str, pairs: dict[str, tuple[Words, AutoTokenizer]]
) -> None:
    words, theirs = pairs[kind]

    @given(st.lists(st.integers(0, len(words) - 1), max_size=12))
    def same(ids: list[int]) -> None:
        assert theirs.decode(ids, skip_special_tokens=True) == words.decode(ids)

    same()


@pytest.mark.parametrize("kind", KINDS)
def test_transformers_knows_size_ends_and_padding(
    kind: str, pairs: dict[str, tuple[Words, AutoTokenizer]]
) -> None:
    words, theirs = pairs[kind]
    assert len(theirs) == len(words)
    ids = (theirs.pad_token_id, theirs.bos_token_id, theirs.eos_token_id)
    assert ids == (words.pad, words.bos, words.eos)
    assert set(theirs.all_special_tokens) == set(CONTROL)


def test_what_transformers_writes_again_is_read_the_same(
    pairs: dict[str, tuple[Words, AutoTokenizer]], tmp_path: Path
) -> None:
    words, theirs = pairs["shipped lm"]
    theirs.save_pretrained(tmp_path)
    again = AutoTokenizer.from_pretrained(tmp_path, local_files_only=True)
    for text in TEXTS[:3]:
        assert_same(words, again, text)
        assert Words.load(tmp_path).encode(text) == words.encode(text)


def test_saving_twice_writes_the_same_bytes(tmp_path: Path) -> None:
    earlier_layout(Words.train(TEXTS, size=400), tmp_path)
    Words.load(tmp_path).save(tmp_path)
    once = {path.name: path.read_bytes() for path in tmp_path.iterdir()}
    assert once.keys() == {"tokenizer.json", "tokenizer_config.json", "special_tokens_map.json"}
    Words.load(tmp_path).save(tmp_path)
    assert once == {path.name: path.read_bytes() for path in tmp_path.iterdir()}


def test_an_earlier_layout_is_read_as_todays(tmp_path: Path) -> None:
    words = Words.train(TEXTS, size=400)
    earlier_layout(words, tmp_path)
    before = Words.load(tmp_path)
    ids = words.encode(TEXTS[2])
    assert before.encode(TEXTS[2]) == ids
    assert before.decode(ids) == TEXTS[2]
    assert before.fingerprint() == words.fingerprint()


def test_rare_words_become_one_token_each_and_others_are_spelled() -> None:
    words = Words.train(TEXTS, size=600, whole=RARE)
    assert all(words.has_token(word) for word in RARE)
    assert not Words.train(TEXTS, size=600).has_token("compare")
    ids = words.encode(" comparison")
    assert len(ids) > 1
    assert words.decode(ids) == " comparison"


def test_four_thousand_words_fit_beside_subwords() -> None:
    rng = random.Random(1)
    syllables = [a + b + c for a in "bdfgklmnprst" for b in "aeiou" for c in ("", "n", "r", "s")]
    names = sorted({"".join(rng.choices(syllables, k=rng.randint(1, 3))) for _ in range(7000)})
    names = names[:4000]
    words = Words.train(TEXTS, size=8192, whole=names)
    assert len(words) <= 8192
    assert len(names) == 4000
    assert all(words.has_token(name) for name in names)
    assert [len(words.encode(f" {n}")) for n in ("0.42", "-1.97", "+7.3", "8")] == [3, 3, 2, 1]
    assert [len(words.encode(action)) for action in ACTIONS] == [1] * 8


def test_a_vocabulary_that_is_too_small_for_its_words_is_refused() -> None:
    with pytest.raises(TouchError, match=r"8 of 8 words .* 'compare'; give a larger size"):
        Words.train(TEXTS, size=320, whole=RARE)
    with pytest.raises(TouchError, match="1 of 1 words"):
        Words.train(TEXTS, size=4000, whole=["two words"])


def test_a_folder_of_a_stock_model_is_not_taken_for_ours(tmp_path: Path) -> None:
    assert not names_our_tokens(tmp_path)
    Words.train(TEXTS, size=400).save(tmp_path)
    assert names_our_tokens(tmp_path)
    for text in ("{", "[]", '{"eos_token": "<eos>", "pad_token": "<pad>"}'):
        (tmp_path / "tokenizer_config.json").write_text(text)
        assert not names_our_tokens(tmp_path)
