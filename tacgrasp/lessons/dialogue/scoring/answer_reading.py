"""Reads answers: numbers with units, yes and no, words of a class, and what can't be answered.

Strict: a number counts only with its unit, two different numbers are no answer to a question for
one, and a text with both yes and no is neither. Not here: comparing with the truth
(``tacgrasp.lessons.question_scores``).
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from cltp.tactile.states import CLASSES
from cltp.texts.captions import alternatives
from policies.teacher import Reason
from primitives import Primitive
from tacgrasp.lessons.dialogue.quantities import UNITS
from tacgrasp.lessons.dialogue.scene import HOLD, LIFT

_UNIT_NAMES: Mapping[str, str] = {
    "N/mm²": r"N/mm(?:²|\^?2)",
    "N/cm²": r"N/cm(?:²|\^?2)",
    "Pa": r"Pa|pascals?",
    "hPa": r"hPa|hectopascals?",
    "kPa": r"kPa|kilopascals?",
    "MPa": r"MPa|megapascals?",
    "mbar": r"mbar|millibars?",
    "bar": r"bars?",
    "psi": r"psi",
    "mmHg": r"mmHg",
    "atm": r"atm",
    "mm³": r"mm(?:³|\^?3)|cubic millimet(?:re|er)s?",
    "cm³": r"cm(?:³|\^?3)|cubic centimet(?:re|er)s?",
    "µL": r"[µμu]L|microlit(?:re|er)s?",
    "mL": r"mL|millilit(?:re|er)s?",
    "daN": r"daN|decanewtons?",
    "dmm": r"dmm|tenths? of an? (?:mm|millimet(?:re|er))",
    "cmm": r"cmm|hundredths? of an? (?:mm|millimet(?:re|er))",
    "dN": r"dN|decinewtons?|tenths? of an? (?:N|newton)",
    "mm": r"mm|millimet(?:re|er)s?",
    "µm": r"[µμ]m|um|microns?|micromet(?:re|er)s?",
    "cm": r"cm|centimet(?:re|er)s?",
    "N": r"N|newtons?",
    "mN": r"mN|millinewtons?",
    "cN": r"cN|centinewtons?",
    "%": r"%|percent|per cent",
    "mm²": r"mm²|mm\^?2|square millimet(?:re|er)s?|sq\.? mm",
    "g": r"gf?|grams?|grammes?",
    "kg": r"kg|kilograms?",
    "m": r"m|met(?:re|er)s?",
    "in": r"in(?=[.;,]|$)|inch(?:es)?",
    "thou": r"thou|mils?",
    "kN": r"kN|kilonewtons?",
    "kgf": r"kgf",
    "lbf": r"lbf",
    "ozf": r"ozf",
    "dyn": r"dyn|dynes?",
    "cm²": r"cm²|cm\^?2",
    "in²": r"in²|in\^?2",
    "mg": r"mg|milligrams?",
    "lb": r"lbs?|pounds?",
    "oz": r"oz|ounces?",
}
_NUMBER = r"(?<![\w.])([+-]?\d+(?:[.,]\d+)?)"
_MEASURED = re.compile(
    _NUMBER
    + r"\s*-?(?:"
    + "|".join(
        f"(?P<u{index}>{pattern})(?![\\w²^])" for index, pattern in enumerate(_UNIT_NAMES.values())
    )
    + ")?"
)
_POLARITY = r"(?P<yes>yes|yeah|yep|correct|true)|(?P<no>no|nope|false|wrong|incorrect)"
_FIRST = re.compile(rf"\s*(?:{_POLARITY})\b(?=\s*(?:[.,;:!\d]|$|(?:it|the|an?|in)\b))", re.I)
_LAST = re.compile(rf"(?:,|;|:)?\s*\bso (?:{_POLARITY})\s*[.!]?\s*$", re.I)
_ANY = re.compile(r"(?:(?<=^)|(?<=[;.,:] ))(?:(?P<yes>yes)|(?P<no>no))\b(?=[,.;:]|$)", re.I)
_UNKNOWN = re.compile(
    r"\b(?:can(?:no|['’]|\s?no)?t (?:feel|tell|say|know|answer|see|judge|sense)|don['’]?t know|"
    r"do not know|unknown|not (?:something|a thing) (?:that )?(?:i|touch) can)\b",
    re.I,
)
_OFF_TOPIC = re.compile(
    r"\bonly (?:answer|talk|speak|know)\b.*\b(?:touch\w*|contact|pad)\b"
    r"|\bnot (?:about|a question about) (?:touch|the contact|this contact|this touch)\b"
    r"|\boff[- ]topic\b",
    re.I,
)
_NOTHING = re.compile(
    r"\bnothing (?:touches|is touching|touched|on the pad)\b|\b(?:there is )?no contact\b", re.I
)
_PHRASES: Mapping[str, Mapping[str, str]] = {
    "action": {
        Primitive.MOVE_UP: r"\b(?:move|shift|go)[ _](?:the gripper )?up",
        Primitive.MOVE_DOWN: r"\b(?:move|shift|go)[ _](?:the gripper )?down",
        Primitive.MOVE_LEFT: r"\b(?:move|shift|go)[ _](?:the gripper )?(?:to the )?left",
        Primitive.MOVE_RIGHT: r"\b(?:move|shift|go)[ _](?:the gripper )?(?:to the )?right",
        Primitive.INCREASE_FORCE: r"\bincrease\b|\btighten\b|\bmore force\b|\bgrip harder\b",
        Primitive.DECREASE_FORCE: r"\bdecrease\b|\bloosen\b|\bless force\b|\bgrip softer\b",
        Primitive.RESET: r"\breset\b|\bgrasp again\b",
        LIFT: r"\blift\b",
        HOLD: r"\bhold still\b|\bhold on\b",
    },
    "reason": {
        Reason.NO_CONTACT: r"\bnothing touches\b|\bno contact\b|\bmissed\b",
        Reason.OVER_THE_EDGE: r"\bsliver\b|\bover the edge\b",
        Reason.TOO_FIRM: r"\btoo (?:firm|hard|strong|tight)(?:ly)?\b|\btoo much\b",
        Reason.OFF_CENTER: r"\boff[- ]cent(?:er|re)\b|\bbadly cent(?:er|re)d\b",
        Reason.CUT: r"\bcuts? it\b|\bcut off\b",
        Reason.TOO_LIGHT: r"\btoo (?:light|loose|weak)(?:ly)?\b|\btoo little\b",
        Reason.BAND_TOO_NARROW: r"\bno step fits\b|\bovershoot\b",
        Reason.GOOD: r"\bwithin the (?:goal|band|limits)\b",
    },
    "side_x": {"left": r"\bleft\b", "right": r"\bright\b"},
    "side_y": {"fingertip": r"\bfingertip\b|\btip\b|\bbottom\b", "palm": r"\bpalm\b|\btop\b"},
    "force_band": {
        "below": r"\bbelow\b|\btoo (?:little|light|low)\b",
        "within": r"\bwithin\b|\bon target\b|\binside\b",
        "above": r"\babove\b|\btoo (?:much|hard|high)\b",
    },
    "wholeness": {"cut": r"\bcuts?\b", "whole": r"\bwhole\b|\bnot cut\b|\bcomplete\b"},
    "worse_axis": {"horizontal": r"\bhorizontal", "vertical": r"\bvertical"},
}


_ALSO: Mapping[str, str] = {
    "inside": "within", "in": "within", "x": "horizontal", "y": "vertical",
    **dict.fromkeys(("upper", "top", "up"), "palm"),
    **dict.fromkeys(("lower", "bottom", "down"), "fingertip"),
}  # fmt: skip
"""Words to choose from that a file may have, as scenes name them."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Measured:
    """A number of an answer.

    Attributes:
        value: Its value in mm, N, percent, mm² or g.
        dimension: What it measures; '' for a number without a unit.
        size: Its unit in that of the value: 0.001 of µm.
    """

    value: float
    dimension: str
    size: float = 1.0


@dataclass(frozen=True, slots=True, kw_only=True)
class AnswerReading:
    """What an answer says.

    Attributes:
        text: The answer.
        numbers: Its numbers in order.
        is_yes: Whether it says yes, or no; None where neither, or both.
        verdicts: Every yes and no at the beginning of a clause, in order.
        is_unknown: Whether it says that touch, or what was given, does not tell.
        is_off_topic: Whether it says that the question is not about touch.
        is_nothing: Whether it says that nothing touches.
    """

    text: str
    numbers: tuple[Measured, ...]
    is_yes: bool | None
    verdicts: tuple[bool, ...]
    is_unknown: bool
    is_off_topic: bool
    is_nothing: bool

    def words(self, name: str, choices: Sequence[str] = ()) -> Sequence[str]:
        """Words of a scene's name in the answer, or of these to choose from, each once.

        Choices that are words of a name are said as that name's. One that begins an answer, before
        a colon, is said alone: 'Limit: the force is 1 N and the limit is 2 N.'
        """
        if name in CLASSES:
            return _class_words(name, self.text)
        head, colon, _ = self.text.casefold().partition(":")
        ends = [each for each in choices if f" {head}".endswith(f" {each.casefold()}")]
        if colon and ends:
            return [max(ends, key=len)]  # 'not a ring' ends with 'a ring'
        phrases = _PHRASES.get(name) or _phrases_of(choices)
        text = self.text.replace("not cut", "whole")
        found = []
        for word in sorted(phrases, key=lambda each: -len(each)):
            # what is said once is taken out: 'off-centre' says no 'centre'
            text, times = re.subn(phrases[word], " ", text, flags=re.I)
            if times:
                found.append(word)
        return [str(word) for word in phrases if word in found]


def _phrases_of(choices: Sequence[str]) -> Mapping[str, str]:
    """How answers say each of some words to choose from."""
    plain = {word: _said(told) for word, told in _told_apart(choices).items()}
    for phrases in _PHRASES.values():
        meant = {word: _ALSO.get(word, word) for word in choices}
        if choices and set(meant.values()) <= phrases.keys():
            return {word: f"{phrases[meant[word]]}|{plain[word]}" for word in choices}
    return plain


_BESIDE = re.compile(r"(above|over|below|under|beyond|past) (?:(?:the|our) )?(\w+)")


def _said(choice: str) -> str:
    """How an answer says a choice: 'over the limit' also as 'Over: the limit is 1 N'."""
    found = _BESIDE.fullmatch(choice)
    other = rf"|\b{found[1]}\b(?=:.*\b{found[2]}\b)" if found else ""
    return rf"\b{re.escape(choice)}\b{other}"


def _told_apart(choices: Sequence[str]) -> Mapping[str, str]:
    """What tells each of some choices from the others: 'left' of 'left half' and 'right half'."""
    shared = set.intersection(*(set(choice.split()) for choice in choices)) if choices else set()
    told = {
        choice: " ".join(word for word in choice.split() if word not in shared)
        for choice in choices
    }
    is_apart = all(told.values()) and not any(
        one in other.split() for a, one in told.items() for b, other in told.items() if a != b
    )
    return told if is_apart else {choice: choice for choice in choices}


def read_answer(text: str) -> AnswerReading:
    """Read an answer."""
    first, last = _FIRST.match(text), _LAST.search(text)
    polarity = {bool(match["yes"]) for match in (first, last) if match is not None}
    return AnswerReading(
        text=text,
        numbers=tuple(_measured(match) for match in _MEASURED.finditer(text)),
        is_yes=polarity.pop() if len(polarity) == 1 else None,
        verdicts=tuple(bool(match["yes"]) for match in _ANY.finditer(text)),
        is_unknown=bool(_UNKNOWN.search(text)),
        is_off_topic=bool(_OFF_TOPIC.search(text)),
        is_nothing=bool(_NOTHING.search(text)),
    )


def _measured(match: re.Match[str]) -> Measured:
    value = float(match[1].replace(",", "."))
    for index, symbol in enumerate(_UNIT_NAMES):
        if match[f"u{index}"] is not None:
            unit = UNITS[symbol]
            return Measured(value=value * unit.size, dimension=unit.dimension, size=unit.size)
    return Measured(value=value, dimension="")


def _class_words(name: str, text: str) -> list[str]:
    """Words of a class; 'very deep' is not 'deep', and '0.3 mm deep' names no class."""
    plain = re.sub(r"(?<=[mµ]m) deep\b", "", text.lower())
    if name == "position":
        plain = re.sub(r"\b(top|middle|bottom)[ -](left|center|centre|right)\b", r"\1-\2", plain)
        plain = plain.replace("centre", "center")
        plain = re.sub(r"\bin the (?:center|middle)\b(?!-)", "centered", plain)
    pattern = rf"(?<![\w-])(?:{alternatives(CLASSES[name])})(?![\w-])"
    return list(dict.fromkeys(match[0] for match in re.finditer(pattern, plain)))
