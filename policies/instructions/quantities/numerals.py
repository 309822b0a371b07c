"""Numbers in words as digits: 'two and a half newtons' becomes '2.5 newtons'.

Own rules, since the library that we tried (text2num) reads 'one point two five' as 1.2 and 5, and
'six hundred and fifty' as 600 and 50; a force must not be misread.
"""

from __future__ import annotations

import re

from policies.instructions.english.number_pattern import NumberPattern

_SMALL = {
    word: value
    for value, word in enumerate(
        [
            "zero",
            "one",
            "two",
            "three",
            "four",
            "five",
            "six",
            "seven",
            "eight",
            "nine",
            "ten",
            "eleven",
            "twelve",
            "thirteen",
            "fourteen",
            "fifteen",
            "sixteen",
            "seventeen",
            "eighteen",
            "nineteen",
        ]
    )
} | {"nought": 0, "naught": 0, "nil": 0}
_TENS = {
    word: 10 * value
    for value, word in enumerate(
        ["twenty", "thirty", "forty", "fifty", "sixty", "seventy", "eighty", "ninety"], start=2
    )
}
_SCALES = {"hundred": 100, "thousand": 1000, "million": 1_000_000}
_PARTS = {
    "half": 1 / 2, "halves": 1 / 2, "third": 1 / 3, "quarter": 1 / 4, "fourth": 1 / 4,
    "fifth": 1 / 5, "sixth": 1 / 6, "eighth": 1 / 8, "tenth": 1 / 10,
    "twelfth": 1 / 12, "twentieth": 1 / 20, "fiftieth": 1 / 50,
    "hundredth": 1 / 100,
    "thousandth": 1 / 1000,
}  # fmt: skip

_CARDINAL = "|".join([*_SMALL, *_TENS])
_WORD = f"(?:{_CARDINAL}|{'|'.join(_SCALES)})"
_CHAIN = re.compile(
    rf"\b(?:an? (?=(?:{'|'.join(_SCALES)})\b))?{_WORD}(?:(?:[ -]+| and ){_WORD})*\b"
)
_PART = f"(?:{'|'.join(_PARTS)})s?"
_PRONOUN = re.compile(
    r"\bone\b(?!-|,? ?(?:and (?:an?|one|1|three|3) |point |dot |comma |decimal |and \d| full | single "
    rf"|(?:(?:to|or|and|up to|maybe|perhaps|possibly) )?(?:{_WORD}\b|\d|half )|newt|milli|kilo|kg|kn\b|n\b|mn\b|gram|gf?\b"
    r"|nw?t?e?w?tons?))"
)
"""'One' that is no number: 'this one'."""

_UNIT = r"(?=[ -]*(?:of )?(?:an? |1 )?(?:single |full |whole )?(?:milli|kilo|newt|n\b|kn\b|mn\b|kg|gram|gf|inch|pounds?\b|lbs?\b|lbf\b|ounces?\b|oz\b|ozf\b))"
_OF_A = r"(?:[ -]+(?:of )?(?:an?|1)(?= ))?"


_FIRST_PART = re.compile(
    rf"\b(?P<between>between )?(?:(?P<n>an?|\d+)[ -])?(?P<part>{_PART})(?P<link>(?: ?(?:-|–) ?| (?:to|or|up to|through) |(?(between) and | to ))"
    rf"(?=(?:(?:an?|\d+)[ -])?(?:{_PART}\b{_OF_A}|\d*\.?\d+)?{_UNIT}))"
)
"""'A quarter to three quarters of a newton': the first part is of a newton too."""

_SHARED_PART = re.compile(
    rf"(?P<between>\bbetween )?(?<![.,/\d])\b(?P<a>\d+)(?P<link> ?(?:-|–) ?| (?:to|or|up to|through) |(?(between) and | to ))"
    rf"(?P<rest>\d+[ -](?P<part>{_PART})\b{_OF_A}{_UNIT})"
)
"""'6 to 12 tenths of a newton': the part counts for both."""
_PART_ALONE = re.compile(rf"(?<=than )(\d+)[ -]({_PART})(?=\s*(?:$|[.,;:!?)]))")
"""'No stronger than 12 tenths', of the unit that stands elsewhere."""

_UNDER_TEN = "|".join(word for word, value in _SMALL.items() if 0 < value < 10)
_SHARED_SCALE = re.compile(
    rf"(?P<before>\bbetween )?(?<![.,\d])(?<!ty[ -])(?<!hundred )(?<!thousand )(?<!point )(?<!and )\b(?P<a>{_UNDER_TEN}|[1-9])"
    rf"(?P<link> to | or | up to | through | ?[-–] ?|(?(before) and | to ))(?P<b>{_UNDER_TEN}|[1-9])[ -](?P<scale>{'|'.join(_SCALES)})\b"
)
"""'Two to three hundred': the scale counts for both."""

_TEENS = "|".join(word for word, value in _SMALL.items() if 10 <= value < 20)
_HUNDREDS = re.compile(
    rf"(?<!and )(?<!point )\b(?P<h>{_UNDER_TEN})[ -](?P<t>{_TEENS}|(?:{'|'.join(_TENS)})(?:[ -](?:{_UNDER_TEN}))?)\b(?= ?(?:-|–|\b(?:to|and|or|up to)\b)?[a-z -]{{0,40}}?\b(?:milli|mn\b))"
)
"""'Six fifty millinewtons' are 650."""
_DIGIT_WORD = rf"(?:zero|{_UNDER_TEN})"
_DIGIT_BY_DIGIT = re.compile(
    rf"\b{_DIGIT_WORD}(?:[ -]{_DIGIT_WORD}){{2,3}}(?=[ -](?:milli|mn\b|newt|n\b|gram|gf\b))"
)
"""'Six five zero millinewtons', as one says it by radio."""
_DECIMALS = re.compile(rf"\b(?:point|dot|comma|decimal)(?:[ -](?:{_DIGIT_WORD}|oh))*[ -]$")

_TWICE = NumberPattern(
    rf"\b(?P<words>{_WORD}(?:(?:[ -]+| and | point ){_WORD})*) \((?P<digits>\d+(?:\.\d+)?)\)(?= ?[a-z])|"
    rf"(?<![\d.,])(?P<first>\d+(?:\.\d+)?) \((?P<then>{_WORD}(?:(?:[ -]+| and | point ){_WORD})*)\)(?= ?[a-z])"
)
"""'One (1) newton', as contracts have it."""


def _once(match: re.Match[str]) -> str:
    """The digits, where the words beside them say the same; else what no unit makes a force of."""
    digits = match["digits"] or match["first"]
    said = in_digits(f"{match['words'] or match['then']} newtons").split()[0]
    return digits if float(said) == float(digits) else f"{said}({digits})"


def in_digits(text: str) -> str:
    """Write the numbers of a plain text in digits; ordinals stay as they are."""
    text = _TWICE.sub(_once, re.sub(r"(\d)⁄(\d)", r"\1/\2", text))
    text = _DIGIT_BY_DIGIT.sub(_by_digit, _HUNDREDS.sub(r"\g<h> hundred \g<t>", text))
    text = _SHARED_SCALE.sub(_scale_of_both, text)
    text = re.sub(r"\b(\d+) (hundred|thousand|million)\b", _scaled, text)
    text = re.sub(r"\bhundred and (?=(?:\w+[ -])?\w+ hundred\b)", "hundred  and  ", text)
    text = _CHAIN.sub(lambda match: _cardinals(match[0]), _PRONOUN.sub("1ne", text))
    text = text.replace("1ne", "one")
    text = re.sub(
        r"\b(\d+)[ -](?:point|dot|comma|decimal)[ -]((?:oh?\b|\d+)(?:[ -](?:oh?|\d)\b)*)",
        _decimal,
        text,
    )
    text = re.sub(
        r"(?<!set )(?<!set-)\b(?:point|dot) ((?:oh?\b|\d+)(?:[ -](?:oh?|\d)\b)*)(?![.,]\d)",
        _bare_decimal,
        text,
    )
    text = re.sub(rf"\b(\d+)[ -](?:and|&)[ -](an?|\d)[ -]({_PART})\b{_OF_A}", _mixed, text)
    text = re.sub(
        r"\b(\d+) (\d)/(\d)\b",
        lambda m: f"{int(m[1]) + int(m[2]) / int(m[3]):.6g}" if m[3] != "0" else m[0],
        text,
    )
    text = re.sub(r"\b(\d+) (newtons?|kilos?|n) and (?:a|1) half\b", r"\1.5 \2", text)
    text = re.sub(
        r"\b(?:an?|(\d+)) newtons? and (?:a|1) (half|quarter)\b",
        lambda m: f"{int(m[1] or 1) + _part(m[2]):.6g} newtons",
        text,
    )
    text = re.sub(r"\bbetween (?:(?:an?|one|1) )?half and(?= \d)", "between 0.5 and", text)
    text = _SHARED_PART.sub(r"\g<between>\g<a> \g<part>\g<link>\g<rest>", text)
    text = _PART_ALONE.sub(_fraction, text)
    text = _FIRST_PART.sub(
        lambda m: f"{m['between'] or ''}{_count(m['n']) * _part(m['part']):.6g}{m['link']}", text
    )
    text = re.sub(rf"\b(?:(an?|\d+)[ -])?({_PART})\b{_OF_A}{_UNIT}", _fraction, text)
    text = re.sub(
        r"\b(\d)/(\d)" + _OF_A + _UNIT,
        lambda m: f"{int(m[1]) / int(m[2]):.6g}" if m[2] != "0" else m[0],
        text,
    )
    text = re.sub(r"\ba couple of\b(?= newt)|\ba couple(?= newt)", "2", text)
    text = re.sub(rf"\b(?:(half )?an?|(\d+)) dozen\b{_UNIT}", _dozens, text)
    return re.sub(
        r"\b(?:an?|single)(?: single| full| whole| mere)? (?=newton\b|(?:kilo(?:gram|newton)?|pound|ounce)(?:-force| of| force)|kgf\b|lbf\b|ozf\b)",
        "1 ",
        text,
    )


def _by_digit(match: re.Match[str]) -> str:
    if _DECIMALS.search(match.string[: match.start()]):
        return match[0]  # 'zero point zero six'
    return "".join(str(_SMALL[word]) for word in re.split(r"[ -]", match[0]))


def _scale_of_both(match: re.Match[str]) -> str:
    first, second = (_SMALL.get(match[name]) or int(match[name]) for name in "ab")
    if first >= second:
        return match[0]
    before = match["before"] or ""
    link = match["link"] if match["link"].strip().isalpha() else " to "
    return f"{before}{match['a']} {match['scale']}{link}{match['b']} {match['scale']}"


def _scaled(match: re.Match[str]) -> str:
    return str(int(match[1]) * _SCALES[match[2]])


def _cardinals(chain: str) -> str:
    """Value of each number in a chain of cardinal words; two numbers in a row stay two."""
    numbers: list[int] = []
    total = current = 0
    last = 0  # size of the last word: what may follow it is smaller
    joined = ""
    for word in re.findall(r"[a-z]+", chain):
        if word in ("a", "an"):
            continue
        if word == "and":
            joined = " and "
            continue
        if word in _SCALES:
            scale = _SCALES[word]
            if scale == 100:
                current = max(current, 1) * 100
            else:
                total, current = total + max(current, 1) * scale, 0
            last = scale
            continue
        value = _SMALL.get(word, _TENS.get(word, 0))
        fits = (
            (not numbers and last == 0)
            or last >= 100
            or (last >= 20 and 0 < value < 10 and not joined)
        )
        if not fits and (total or current or last):
            numbers.append(total + current)
            total = current = 0
        current += value
        last, joined = value if value >= 20 else 1, ""
    numbers.append(total + current)
    return (" and " if " and " in chain else " ").join(map(str, numbers))


def _dozens(match: re.Match[str]) -> str:
    return str(6 if match[1] else 12 * int(match[2] or 1))


def _digits(words: str) -> str:
    return "".join("0" if part in ("o", "oh") else part for part in re.split(r"[ -]", words))


def _decimal(match: re.Match[str]) -> str:
    return f"{match[1]}.{_digits(match[2])}"


def _bare_decimal(match: re.Match[str]) -> str:
    return f"0.{_digits(match[1])}"


def _part(word: str) -> float:
    return _PARTS.get(word, 0.0) or _PARTS[word.removesuffix("s")]


def _count(word: str | None) -> int:
    return int(word) if word and word.isdigit() else 1


def _mixed(match: re.Match[str]) -> str:
    return f"{int(match[1]) + _count(match[2]) * _part(match[3]):.6g}"


def _fraction(match: re.Match[str]) -> str:
    return f"{_count(match[1]) * _part(match[2]):.6g}"
