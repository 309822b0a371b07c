import pytest

from tacgrasp.lessons.dialogue.plain_words import plain_text, plain_words


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("How deep is it?", "how deep is it"),
        ("WHAT'S the depth", "what is the depth"),
        ("whats teh depht", "what is the depth"),
        ("Isn't it above 0.3 mm?", "is not it above # mm"),
        ("over 300µm or 1,5 N", "over # um or # n"),
        ("12-gram berry, 0.1-0.3 mm", "# gram berry # # mm"),
        ("30 mm² or 8 %?", "# mm2 or # percent"),
        ("the fingertip's side", "the fingertip's side"),
        ("Is its centre grey?", "is it is center gray"),
        ("isnt it 1.2 N +-0.1?", "is not it # n plus minus #"),
        (
            "0.3±0.05 mm, 1 +/- 2 or plus/minus 3",
            "# plus minus # mm # plus minus # or plus minus #",
        ),
        ("whos gonna lift, theyre ready", "who is going to lift they are ready"),
        ("?!", ""),
    ],
)
def test_a_text_becomes_plain_words(text, words):
    assert plain_words(text) == tuple(words.split())


def test_numbers_keep_their_values_and_signs():
    plain = plain_text("x between -0.5 and +1.5, not .25 or 3-4 mm")
    assert [plain.numbers[i] for i, word in enumerate(plain.words) if word == "#"] == [
        -0.5, 1.5, 0.25, 3.0, 4.0,
    ]  # fmt: skip
