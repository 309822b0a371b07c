"""Multiples of a question's numbers, worked out: 'less than twice 0.2 N' is 'less than 0.4 N'.

    Is it two times deeper than 0.1 mm?         is it deeper than 0.2 mm?
    Is it three times as deep as 0.1 mm?        is it deeper than 0.3 mm?

Not here: multiples of what is felt ('would twice that be too much?'), which queries have.
"""

from __future__ import annotations

import re

_FACTORS = {
    "half": 0.5, "half of": 0.5, "twice": 2.0, "double": 2.0, "triple": 3.0, "thrice": 3.0,
    "quadruple": 4.0, "a quarter of": 0.25, "one quarter of": 0.25, "three quarters of": 0.75,
    "a third of": 1 / 3, "one third of": 1 / 3, "two thirds of": 2 / 3,
    "a fifth of": 0.2, "a tenth of": 0.1,
}  # fmt: skip
_COUNTS = {"two": 2.0, "three": 3.0, "four": 4.0, "five": 5.0, "ten": 10.0}
_MULTIPLE = (
    rf"\b(?P<multiple>(?P<factor>{'|'.join(sorted(_FACTORS, key=len, reverse=True))})|"
    r"(?P<count>\d+(?:\.\d+)?|two|three|four|five|ten)(?: times|x| x))"
)
_NUMBER = r"(?P<number>\d+(?:\.\d+)?)(?![\d.])(?= ?[a-zµ%])"
_PRODUCT = re.compile(rf"{_MULTIPLE} (?:of )?(?:the )?{_NUMBER}", re.I)
_COMPARED = re.compile(
    rf"{_MULTIPLE} (?:(?P<more>deeper|stronger|larger|bigger|higher|heavier|more|greater) than|"
    r"as (?P<as>deep|strong|large|big|high|heavy|much|great) as) (?:the )?"
    rf"{_NUMBER}",
    re.I,
)
_MORE = {
    "deep": "deeper", "strong": "stronger", "large": "larger", "big": "bigger", "high": "higher",
    "heavy": "heavier", "much": "more", "great": "greater",
}  # fmt: skip

_PARTS = {"half": 0.5, "quarter": 0.25}
_UNIT = r"(?:(?:milli|micro|centi|kilo)?(?:met(?:re|er)|newton|gram|gramme)|kilo|mm|kg|cm|n|g)s?"


def _and_part(match: re.Match[str]) -> str:
    whole = {"a": 1.0, "an": 1.0, "one": 1.0, **_COUNTS}.get(match["whole"].lower())
    number = (float(match["whole"]) if whole is None else whole) + _PARTS[match["part"].lower()]
    return f"{number:g} {match['unit']}"


_SPOKEN = (
    (
        re.compile(
            r"\b(?P<whole>an?|one|two|three|four|five|ten|\d+) (?P<unit>"
            rf"(?:square )?{_UNIT}) and (?:an?|one|1) (?P<part>half|quarter)\b",
            re.I,
        ),
        _and_part,
    ),
    (re.compile(rf"\ba dozen (?={_UNIT}\b)", re.I), "12 "),
    (re.compile(rf"\ba couple of (?={_UNIT}\b)", re.I), "2 "),
)


def with_products(text: str) -> str:
    """A text with the products that it names in place of their factors."""
    text = _spoken(text)
    text = _COMPARED.sub(
        lambda match: f"{match['more'] or _MORE[match['as'].lower()]} than {_product(match)}", text
    )
    return _PRODUCT.sub(_product, text)


def _spoken(text: str) -> str:
    """A text with digits for counts of a unit that stand around it: 'a millimetre and a half'."""
    for pattern, number in _SPOKEN:
        text = pattern.sub(number, text)
    return text


def _product(match: re.Match[str]) -> str:
    factor, count = (match["factor"] or "").lower(), (match["count"] or "").lower()
    times = _FACTORS[factor] if factor else _COUNTS.get(count) or float(count)
    return f"{times * float(match['number']):.6g}"
