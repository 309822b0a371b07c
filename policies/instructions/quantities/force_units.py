"""Units of force in words, and numbers that stand before them.

N with its prefixes, dynes, grams, kilograms, pounds and ounces of force, spelled as people spell them.
"""

from __future__ import annotations

import re

GRAM_N = 9.80665e-3
"""Weight of a gram [N] at standard gravity (CGPM 1901)."""

_GRIP = (
    r"(?:the )?(?:grip(?:ping)?|clamp(?:ing)?|squeez(?:e|ing)|finger|contact|holding|hand)?[ -]?"
)
_OF_FORCE = rf"[ -]*(?:of )?{_GRIP}(?:force|grip|pressure|squeeze|clamp)"
_KILO = r"(?:kilo(?:gram(?:me)?)?s?|kgs?)"
_GRAM = r"(?:gram(?:me)?s?|gr?)"
_POUND, _OUNCE = r"(?:pounds?|lbs?)", r"(?:ounces?|oz)"
POUND_N, OUNCE_N = 453.59237 * GRAM_N, 28.349523 * GRAM_N
"""Weights of the avoirdupois pound and ounce [N]."""
UNITS: tuple[tuple[str, float], ...] = (
    (r"(?:kilo-?\s?newtons?|kn)", 1000.0),
    (r"(?:mill?i-?\s?n[ew]+t[a-z]{0,3}ns?|mn)", 1e-3),
    (r"(?:micro-?\s?newtons?|[µμu]n)", 1e-6),
    (r"(?:de[ck]a-?\s?newtons?|dan)", 10.0),
    (r"(?:deci-?\s?newtons?|dn)", 0.1),
    (r"(?:dyn(?:e|es|s)?)", 1e-5),
    (r"(?:centi-?\s?newtons?|cn)", 1e-2),
    (r"(?:n[ew]+t[a-z]{0,3}ns?|netwons?|newtos?|n)", 1.0),
    (rf"(?:{_KILO}{_OF_FORCE}|kgf|{_KILO}[ -]f(?:orce)?|kilo(?:gram)?-?force|kiloponds?|kp)", 1000 * GRAM_N),
    (rf"(?:{_GRAM}{_OF_FORCE}|{_GRAM}[ -]weight|gf|{_GRAM}[ -]f(?:orce)?|gram-?force|ponds?)", GRAM_N),
    (rf"(?:{_POUND}{_OF_FORCE}|lbf)", POUND_N),
    (rf"(?:{_OUNCE}{_OF_FORCE}|ozf)", OUNCE_N),
)  # fmt: skip
MASSES = ((_KILO, 1000 * GRAM_N), (_GRAM, GRAM_N), (_POUND, POUND_N), (_OUNCE, OUNCE_N))
"""Masses stand for a force only after a word such as 'with' or 'at most'."""
UNIT = "|".join(unit for unit, _ in UNITS)
LOOSE = "|".join(unit for unit, _ in MASSES)
ALONE = r"(?<![\d.,])(?<!\de)(?<!\de[+-])"
NUMBER = (
    ALONE
    + r"(?:\d{1,3}(?:,\d{3})+(?:\.\d+)?|\d{1,12}(?:[.,]\d{1,12})?|\.\d{1,12})(?:e[+-]?\d{1,4})?(?![.,]?\d)"
)

ONE_FORCE = rf"{NUMBER}\s*-?\s*(?:{UNIT}|{LOOSE})\b"
"""A number and its unit, which may be one of mass."""


def in_newtons(digits: str, unit: str) -> float:
    """A force of so many of a unit [N].

    Raises:
        ValueError: No unit of force.
    """
    if digits.strip("- ") in ("infinite", "infinity", "unlimited", "inf", "nan"):
        return float("inf")
    for pattern, unit_n in (*UNITS, *MASSES):
        if re.fullmatch(pattern, unit):
            return number(digits) * unit_n
    raise ValueError(f"no unit of force: {unit!r}")


def number(text: str) -> float:
    """A number with a decimal point or comma; '15,000' and '1.500.000' have separators."""
    sign = -1 if re.match(r"-|minus|negative", text) else 1
    text = re.sub(r"^(?:-|minus|negative)\s*", "", text)
    if re.fullmatch(r"\d{1,3}(?:,\d{3})+(?:\.\d+)?", text) and not text.startswith("0,"):
        text = text.replace(",", "")
    elif re.fullmatch(r"\d{1,3}(?:\.\d{3}){2,}", text):
        text = text.replace(".", "")
    return sign * float(text.replace(",", "."))
