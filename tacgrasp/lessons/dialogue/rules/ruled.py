"""The meaning of a question that a rule reads."""

from __future__ import annotations

import re

from tacgrasp.lessons.dialogue.meaning import Meaning
from tacgrasp.lessons.dialogue.plain_words import plain_words
from tacgrasp.lessons.dialogue.plainer import AUXILIARY
from tacgrasp.lessons.dialogue.query import asked_text, read_query
from tacgrasp.lessons.dialogue.rules.bare import bare_query
from tacgrasp.lessons.dialogue.rules.edges import edge_query
from tacgrasp.lessons.dialogue.rules.halves import half_query
from tacgrasp.lessons.dialogue.rules.loads import load_query, several_query
from tacgrasp.lessons.dialogue.rules.offsets import offset_query
from tacgrasp.lessons.dialogue.rules.others import other_query
from tacgrasp.lessons.dialogue.rules.worded import worded_query
from tacgrasp.lessons.dialogue.written_units import numbers_in_units

_ASKS_YES = re.compile(rf"{AUXILIARY}\b", re.I)
_EDGE_FIRST = re.compile(
    r"(?:(?:the|at the|on the) )?[a-z-]+(?: hand)?(?: (?:and|or) (?:the )?[a-z-]+(?: hand)?)?"
    r"(?: (?:edges?|rims?|borders?|sides?|boundary|boundaries|margins?|ends?))?"
    rf"(?: of the \w+)?\s?[:,;–—-]+ {AUXILIARY} [^.?!:;]+[?.! ]*",
    re.I,
)
"""'Left edge: does it cut it?'"""
_NEWTONS = r"(?P<{0}>\d+(?:\.\d+)?) ?(?P<{0}u>m?N|(?:milli)?newtons?)"
_SAFE_FORCE = re.compile(
    rf"(?:(?:would|will) {_NEWTONS.format('a')}(?: still)? be|is {_NEWTONS.format('b')}|"
    rf"(?P<at>is it|would it be) safe (?:at|with) {_NEWTONS.format('c')})"
    r"(?(at)| (?:a )?safe(?: (?:force|grip|to (?:lift|hold|use)(?: it)?(?: with)?))?)[?.! ]*",
    re.I,
)
"""'Would 2.9 N be safe?' asks for the band."""
_NOT_TAGGED = re.compile(
    rf"(?:so |and |but |then )?not (?P<stated>[^.?!:;,]+), (?:{AUXILIARY}) (?:it|they|we|you|"
    r"that)[?.! ]*",
    re.I,
)
"""'Not clipped on the left, is it?' asks whether it is."""


def ruled(question: str) -> Meaning | None:
    """What a question of one clause means by a rule; None where none reads it.

    Args:
        question: The question, as ``tacgrasp.lessons.dialogue.plainer`` leaves it.
    """
    if safe := _SAFE_FORCE.fullmatch(question):
        force, unit = next((safe[n], safe[f"{n}u"]) for n in "abc" if safe[n])
        newtons = float(force) / (1000 if unit.lower().startswith("m") else 1)
        return read_query(f"calculate band_low_n <= {newtons:g} <= band_high_n.")
    if several := several_query(question):
        return read_query(several)
    asked = asked_text(question)
    plain = " ".join(plain_words(question))  # 'half of the pad' is no percentage here
    query = (
        load_query(asked.words)
        or half_query(plain)
        or offset_query(plain)
        or edge_query(asked.words)
        or bare_query(asked.words, asked.numbers)
        or other_query(asked.words)
        or (worded_query(question) if _ASKS_YES.match(question) else "")
    )
    if not query:
        return None
    if query.startswith("calculate"):
        return read_query(_as_spelled(query, question))
    numbers = numbers_in_units(query, asked.words, asked.numbers)
    return None if numbers is None else read_query(query, numbers)


def ruled_whole(question: str) -> Meaning | None:
    """What a question of one or more clauses means by a rule that accounts for every clause.

    Args:
        question: The question, as ``tacgrasp.lessons.dialogue.plainer`` leaves it.
    """
    if tagged := _NOT_TAGGED.fullmatch(question):
        return ruled(tagged["stated"]) or ruled_whole(tagged["stated"])
    plain = " ".join(plain_words(question))
    asked = asked_text(question)
    query = (
        worded_query(question)
        or half_query(plain)
        or offset_query(plain)
        or bare_query(asked.words, asked.numbers)
        or (edge_query(plain) if _EDGE_FIRST.fullmatch(question) else "")
    )
    return read_query(_as_spelled(query, question)) if query else None


def _as_spelled(query: str, question: str) -> str:
    """A query whose offered words are spelled as in the question: 'up-and-down'."""

    def spelled(match: re.Match[str]) -> str:
        said = re.search(match[1].replace(" ", "[ -]+"), question.lower())
        return f"'{said[0]}'" if said else match[0]

    return re.sub(r"(?<!== )'([a-z]+(?: [a-z]+)+)'", spelled, query)
