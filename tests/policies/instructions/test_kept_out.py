"""The wordings that score the reader are used by none of its rules and tests."""

import csv
from pathlib import Path

import pytest

from tests.paths import ROOT

KEPT_OUT = ROOT / "tacgrasp" / "lessons" / "kept_out_instructions.csv"
RULES = ROOT / "policies" / "instructions"

pytestmark = pytest.mark.skipif(not KEPT_OUT.is_file(), reason="no wordings are kept out")


def wordings(path: Path) -> list[str]:
    with path.open(encoding="utf-8", newline="") as file:
        return [row["text"].lower() for row in csv.DictReader(file)]


def test_there_are_at_least_500_of_them_each_once():
    texts = wordings(KEPT_OUT)
    assert len(texts) >= 500
    assert len(set(texts)) == len(texts)


def test_none_of_them_is_among_the_wordings_that_the_rules_were_held_against():
    read = set(wordings(Path(__file__).with_name("read_wordings.csv")))
    assert not read.intersection(wordings(KEPT_OUT))


@pytest.mark.parametrize("folder", [RULES, ROOT / "tests"], ids=["rules", "tests"])
def test_no_sentence_of_them_is_written_in_a_rule_or_a_test(folder: Path):
    sentences = [text for text in wordings(KEPT_OUT) if len(text.split()) >= 3]
    for path in folder.rglob("*"):
        if path.suffix in (".py", ".txt"):
            source = path.read_text("utf-8").lower()
            assert not [text for text in sentences if text in source], path
