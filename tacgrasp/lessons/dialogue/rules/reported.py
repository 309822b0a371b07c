"""Questions whether what somebody reports is right.

    The display says 1 N. Is that right?            check force about #1 N.
    Is the operator right that the force is 2 N?    check force about #1 N.
    My colleague wrote 0.1 mm. Is he wrong?         check not depth about #1 mm.

Not here: statements that are doubted (``tacgrasp.lessons.dialogue.clauses.verdicts``).
"""

from __future__ import annotations

import re

from policies.instructions.quantities.numerals import in_digits
from tacgrasp.lessons.dialogue.calculations.quantity_names import unit_of
from tacgrasp.lessons.dialogue.meaning import Meaning
from tacgrasp.lessons.dialogue.query import asked_text, read_query
from tacgrasp.lessons.dialogue.written_units import numbers_in_units

_REPORTS = (
    r"(?:says?|said|reads?|shows?|showed|wrote|writes|written|noted|notes|logged|recorded|"
    r"reported|reports|claims?|claimed|thinks?|believes?|displays?|displayed|told|measured|"
    r"estimated|estimates|guessed|guesses|stated|states|entered|gives|gave|put down|typed)"
)
_RIGHT = r"(?:right|correct|true|accurate|so|fine|ok(?:ay)?|plausible|credible)"
_WRONG = r"(?:wrong|false|incorrect|mistaken|off|lying|untrue|inaccurate)"
_WHO = r"(?:that|this|it|he|she|they|the (?:value|figure|number|reading|entry|log|report))"
_VERDICT = re.compile(rf"\b(?:{_RIGHT}|{_WRONG}|sign|confirm|accept|trust|believe|agree)\b")
"""What such a question has in any case: most others are told from it by this alone."""
_NUMBER = re.compile(
    r"(?<![\w.])\d+(?:\.\d+)? ?(?P<unit>(?P<force>m?n|newtons?|millinewtons?)|(?P<depth>mm|µm|um|"
    r"microns?|millimet(?:re|er)s?|micromet(?:re|er)s?)|(?P<area>%|percent))(?![\w²³/])"
)
_TOLD = re.compile(
    rf"(?:[a-z' ]+ {_REPORTS} .+?[.,;:–—-]+ *(?:so |and )?(?:(?:is|are|was) {_WHO} (?:{_RIGHT}|"
    rf"(?P<a>{_WRONG}))|{_RIGHT}|(?P<b>{_WRONG})|can i (?:sign|confirm|accept|trust|believe) "
    r"(?:that|it|this)|(?:do|would|can) you (?:agree|confirm (?:that|it|this)|sign that))|"
    rf"(?:is|was|are) (?!it\b|that\b|this\b)(?:the |my |our )?[a-z]+ "
    rf"(?:{_RIGHT}|(?P<c>{_WRONG})) (?:that|when (?:he|she|they|it) {_REPORTS}(?: that)?|"
    r"in saying(?: that)?) .+|"
    r"(?:is|was) (?:the |a |this |that )?(?:reported|logged|noted|displayed|recorded|stated|"
    r"entered|written|shown|claimed|measured) (?:\w+ of )?[\d.]+ ?\S+ (?:really )?"
    rf"(?:{_RIGHT}|(?P<d>{_WRONG})))[ ?.!]*"
)
_COMPARES = re.compile(
    r"\b(?:over|under|above|below|more|less|at least|at most|between|within|than|exceeds?|beyond|"
    r"limit|band|weighs?|offset|left|right of|wide|away|from)\b"
)


def reported(question: str) -> Meaning | None:
    """Whether a number that somebody reports is about what is felt; None of other questions."""
    words = " ".join(question.lower().replace("’", "'").split())
    if _VERDICT.search(words) is None:
        return None
    words = in_digits(words)
    if (told := _TOLD.fullmatch(words)) is None or _COMPARES.search(words):
        return None
    numbers = list(_NUMBER.finditer(words))
    if len(numbers) != 1 or numbers[0]["area"]:
        return None
    quantity = "force" if numbers[0]["force"] else "depth"
    unit = unit_of(numbers[0]["unit"])
    denied = "not " if any(told.groups()) else ""
    query = f"check {denied}{quantity} about #1 {unit}."
    asked = asked_text(question)
    values = numbers_in_units(query, asked.words, asked.numbers)
    return None if values is None else read_query(query, values)
