"""YAML is read within bounds, and what a person can get wrong is one line with its place."""

import datetime
import re
import time

import pytest

from tacgrasp.base.strict_yaml import YamlError, YamlSyntaxError, read_yaml

DOUBLED = "arm:\n  workspace_m: 0.3\nloop:\n  max_steps: 3\narm:\n  workspace_m: 2\n"
BOMB = "a0: &a0 [x, x]\n" + "".join(f"a{n + 1}: &a{n + 1} [*a{n}, *a{n}]\n" for n in range(40))

REFUSED = {
    "a key twice": (DOUBLED, "line 5: arm stands in line 1 already"),
    "a key twice within": ("a:\n- b: 1\n  c: 2\n  b: 3\n", "line 4: b stands in line 2 already"),
    "a key twice in braces": ("{a: 1, a: 1}", "line 1: a stands in line 1 already"),
    "an impossible date": ("a: 1\nday: 2026-02-30\n", "line 2: '2026-02-30' is no possible date"),
    "an impossible zone": ("2026-02-03T00:00:00+99:99", "no possible date"),
    "a long number": ("n: " + "9" * 5000, "a number or date of 5000 characters; at most 40"),
    "a long hexadecimal": ("n: 0x" + "f" * 9000, "9002 characters; at most 40"),
    "a long sexagesimal": ("n: " + "1:" * 20_000 + "1.5", "at most 40"),
    "a number without digits": ("n: 0b_", "'0b_' is no possible number"),
    "deep lists": ("[" * 49_000, "deeper than 20 levels"),
    "deep mappings": ("{a: " * 9000, "deeper than 20 levels"),
    "deep blocks": ("- " * 20_000 + "x", "deeper than 20 levels"),
    "aliases": (BOMB, "line 1: anchors .* are not read"),
    "a merge": ("<<: {a: 1}", "expected a name before the colon, got '<<'"),
    "a number as a key": ("1: 2", "expected a name before the colon, got '1'"),
    "a list as a key": ("? [a]\n: b", "expected a name before the colon, got a list"),
    "a tag": ("a: !!python/object/apply:os.system [x]", "tags .* are not read"),
    "a long text": ("a: b\n" * 20_000, "100000 characters; at most 50000 are read"),
    "two documents": ("a: 1\n---\na: 2\n", "expected a single document"),
    "a control character": ("a: \x07", "special characters are not allowed"),
    "no end": ("a: [1, 2\n", "line 2: while parsing a flow sequence"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_it_is_refused_in_one_line_within_a_second(name: str) -> None:
    text, expected = REFUSED[name]
    began_s = time.thread_time()
    with pytest.raises(YamlError) as caught:
        read_yaml(text)
    assert time.thread_time() - began_s < 1.0
    assert re.search(expected, str(caught.value))
    assert "\n" not in str(caught.value)
    assert len(str(caught.value)) < 200


def test_plain_values_are_read_as_the_stock_loader_reads_them() -> None:
    text = "a: 1\nb: [2.5, -1e-3, .5]\nc: {d: x y, e: null}\nf: 2026-01-31\ng: yes\nh: '1'\n"
    assert read_yaml(text) == {
        "a": 1,
        "b": [2.5, "-1e-3", 0.5],  # YAML 1.1: an exponent needs a point
        "c": {"d": "x y", "e": None},
        "f": datetime.date(2026, 1, 31),
        "g": True,
        "h": "1",
    }


def test_the_same_key_may_stand_in_different_mappings() -> None:
    assert read_yaml("a: {x: 1}\nb: {x: 2}\n") == {"a": {"x": 1}, "b": {"x": 2}}


@pytest.mark.parametrize("text", ["*gently* please", "hold it: now: or never", "!important"])
def test_a_sentence_that_is_no_yaml_is_told_from_bad_yaml(text: str) -> None:
    with pytest.raises(YamlSyntaxError):
        read_yaml(text)
