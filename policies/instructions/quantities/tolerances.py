"""Tolerances of a force, however they are said, as a person who measures writes them.

'1 N plus or minus 10 percent', '1 N with a tolerance of 0.1 N' and '10 % accuracy, 1 N' become
'1 n ± 10 %' and '1 n ± 0.1 n'; unlike ones stay as in '1 n (+0.1/-0.2 n)'.
"""

from __future__ import annotations

import re

from policies.instructions.english.number_pattern import NumberPattern
from policies.instructions.quantities.force_units import ALONE, NUMBER, UNIT, in_newtons, number

_BARE = NUMBER.removeprefix(ALONE)
_PART = rf"(?:%|percent\b|per cent\b|(?:{UNIT})\b)"
_NOUN = r"(?:tolerance|tol\.?|margin|slack|error|accuracy|precision|leeway|deviation|variation)"
_ONE = rf"{NUMBER}\s*(?:{UNIT})\b"
_OTHER = r"(?!\s*(?:mm|cm|[µμu]m|micro\w+|millimet\w+|s|ms|sec\w*|minutes?|degrees?|deg|times)\b)"

_SYMMETRIC = rf"(?:±\s*(?P<t>{_BARE})\s*(?P<tu>{_PART})?|(?P<uneven>\(\+{_BARE}[^()]*\)))"
TOLERANCE = rf"(?:\s*,?\s*{_SYMMETRIC}{_OTHER})?"
"""Behind the unit of a force: groups t, tu and uneven."""

_PLAIN = tuple((NumberPattern(pattern), plainly) for pattern, plainly in (
    (rf"(?:\+\s*(?:/|or)?\s*-|-\s*/?\s*\+|∓|\bplus[ /-]*(?:or |and )?[ /-]*minus|\bgive or take)\s*(?={_BARE})", " ± "),
    (rf"\(\s*(±\s*{_BARE}\s*{_PART}?)\s*\)", r" \1"),
    (rf"({_ONE}(?: of [a-z]+| force| grip)*)\s*,?\s*\(?(?:to )?within (?={_BARE}\s*{_PART})", r"\1 ± "),
    (rf"(?:,|\bwith|\band|\bto)?\s*\b(?:an? |the )?{_NOUN}(?: of| is| to|:)?\s*(?:±\s*)?({_BARE}\s*{_PART})", r" ± \1"),
    (rf"(?:,|\bwith|\band|\bto)?\s*(?:\b(?:an? |the ))?(?:±\s*)?\b({_BARE}\s*{_PART})[ -]{_NOUN}\b", r" ± \1"),
    (rf"\b(?:to )?within ({_BARE}\s*{_PART}) (?:of|either (?:way|side) of) ({_ONE})", r"\2 ± \1"),
    (rf"({_ONE}),? ({_BARE}\s*{_PART}) (?:either way|each way|up or down|on either side)\b", r"\1 ± \2"),
    (rf"\baccurate to ({_BARE}\s*{_PART})", r" ± \1"),
    (rf"({_ONE})\s*\(?\+\s*({_BARE})\s*[/,]\s*-\s*({_BARE})\s*\)?(?!\s*{_PART})(?![\d.,])", r"\1 (+\2/-\3)"),
    (rf"({_ONE})\s*\(?-\s*({_BARE})\s*[/,]\s*\+\s*({_BARE})\s*\)?(?!\s*{_PART})(?![\d.,])", r"\1 (+\3/-\2)"),
    (rf"\(?\+\s*({_BARE})\s*({_PART})?\s*[/,]?\s*-\s*({_BARE})\s*({_PART})\s*\)?", r"(+\1 \2/-\3 \4)"),
    (rf"\(?-\s*({_BARE})\s*({_PART})?\s*[/,]?\s*\+\s*({_BARE})\s*({_PART})\s*\)?", r"(+\3 \4/-\1 \2)"),
))  # fmt: skip
_BEHIND = NumberPattern(
    rf"(?P<one>{_ONE})(?P<between>[^.±\d]{{1,40}}?)(?P<tolerance>±\s*{_BARE}(?:\s*{_PART})?){_OTHER}"
)
_AHEAD = NumberPattern(
    rf"^(?P<between>[^\d]*?)(?P<tolerance>±\s*{_BARE}\s*{_PART}){_OTHER}(?P<more>[^\d]*)(?P<one>{_ONE})"
)
_LONE = NumberPattern(rf"^[^\d]*?±\s*(?P<part>{_BARE}\s*{_PART})")

_PARTS = {"half": 50, "third": 33, "quarter": 25, "fifth": 20, "tenth": 10}
_PART_EITHER_WAY = re.compile(
    rf"(?P<sign>±|\bplus[ /-]*(?:or |and )?[ /-]*minus|\bgive or take) (?:an? |one |1 )?(?P<part>{'|'.join(_PARTS)})\b"
)
"""'1 N, plus or minus a fifth'."""


def _in_percent(match: re.Match[str]) -> str:
    return f"{match['sign']} {_PARTS[match['part']]} %"


def with_plain_tolerances(text: str) -> str:
    """Write each tolerance of a plain text, its numbers in digits, directly behind its force."""
    text = _PART_EITHER_WAY.sub(_in_percent, text)
    for pattern, plainly in _PLAIN:
        text = pattern.sub(plainly, text)
    text = _BEHIND.sub(r"\g<one> \g<tolerance>\g<between>", text)
    text = _AHEAD.sub(r"\g<between>\g<more>\g<one> \g<tolerance>", text)
    return " ".join(text.split())


def without_lone(text: str) -> tuple[str, str]:
    """A text without a tolerance that has no force, and the words of that; '' for none."""
    match = _LONE.search(text)
    if match is None:
        return text, ""
    return f"{text[: match.start('part')].rstrip('± ')} {text[match.end() :]}", match["part"]


def band_of(match: re.Match[str]) -> tuple[float, float] | None:
    """Lowest and highest force of a match with ``TOLERANCE`` [N]; None where none is said."""
    unit, value_n = match["ua"], in_newtons(match["a"], match["ua"])
    if inner := match["ti"]:
        sides = [(inner, match["tip"])] * 2
    elif match["t"]:
        sides = [(match["t"], match["tu"])] * 2
    elif match["uneven"]:
        found = re.findall(rf"[+-]({_BARE})\s*({_PART})?", match["uneven"])
        sides = [(digits, part or found[-1][1]) for digits, part in found]
    else:
        return None
    up_n, down_n = (_size_n(digits, part or unit, value_n) for digits, part in sides)
    return value_n - down_n, value_n + up_n


def _size_n(digits: str, part: str, value_n: float) -> float:
    if part.startswith(("%", "per")):
        return number(digits) / 100 * value_n
    return in_newtons(digits, part)
