"""Questions about the gripper itself, which the touch of one fingertip does not tell.

    Left finger or right finger?                        unknown finger.
    How far apart are the jaws?                         unknown opening.
    What would happen if I opened the gripper by 1 mm?  unknown outcome.

A supposed force is calculated with, a supposed move of the gripper is not: how stiff the object is
and what else holds it is not felt.

Not here: the sides of the pad (``tacgrasp.lessons.dialogue.rules.edges``), another finger
(``tacgrasp.lessons.dialogue.rules.elsewhere``).
"""

from __future__ import annotations

import re

from tacgrasp.lessons.dialogue.meaning import Meaning
from tacgrasp.lessons.dialogue.query import read_query

_FINGER = r"(?:(?:gripper |robot )?(?:finger|fingertip|jaw|arm)|gripper|sensor)"
_NO_SIDE = r"(?![- ](?:side|edge|end|border|rim|half|part|force|of)\b)"
_ONE = r"(?:left|right|other|first|second|upper|lower)(?:[- ]hand)?"
_WHICH_FINGER = re.compile(
    r"\b(?:which|what)(?: one)?(?: of (?:the|your|our)(?: two)?)? (?:finger|fingertip|jaw|arm)s?"
    r"(?=$| (?:is|are|am|do|does|did|has|have|was|it|i|we|you|touches|feels|holds|presses)\b)|"
    rf"\b{_ONE} {_FINGER}{_NO_SIDE},? or (?:[a-z]+ ){{0,3}}?{_ONE}\b{_NO_SIDE}|"
    rf"\b{_ONE}(?: one)?,? or (?:[a-z]+ ){{0,3}}?{_ONE} {_FINGER}\b{_NO_SIDE}"
)
"""'Which finger is touching?', 'the left or the right finger?'"""

_GRIPPER = r"(?:gripper|jaws?|fingers?|hand)"
_OPENING = re.compile(
    rf"\b{_GRIPPER}(?:['’]s|s['’])? (?:gap|opening|aperture|stroke|spacing|clearance)\b|"
    rf"\b(?:gap|opening|distance|space|spacing|clearance) (?:between|of) (?:(?:the|your|our|both|"
    rf"two) )*{_GRIPPER}\b|"
    rf"\bhow (?:far|wide|widely|much) (?:is|are) (?:the |your |our )?(?:two )?{_GRIPPER} "
    r"(?:still )?(?:open|opened|apart|closed|spread)\b|"
    rf"\bhow (?:far|wide|widely)(?: open| apart| closed) (?:is|are) (?:the |your |our )?{_GRIPPER}"
)

_WHO = (
    r"(?:i|we|you|they|one|someone|somebody|(?:the|my|our|your) "
    rf"(?:{_GRIPPER}|robot|arm|wrist|operator))"
)
_AGREED = r"(?:force|grip force|squeeze|pressure|load|limit|band)"
_MOVES = (
    r"(?:(?:re)?open(?:s|ed)?|clos(?:e|es|ed)|"
    r"lets? (?:it |this |that |the \w+ )?go(?! (?:of|by|to)\b)|"
    rf"(?:releas|rotat)(?:e|es|ed)|(?:drop(?:s|ped)?|tilt(?:s|ed)?|twist(?:s|ed)?|"
    r"jerk(?:s|ed)?|bump(?:s|ed)?|knock(?:s|ed)?)|sh(?:ake|akes|ook)|sw(?:ing|ings|ung)|"
    rf"turn(?:s|ed)? (?:it|this|that|the \w+) (?:over|around|round|upside down|on its side))"
    rf"(?! (?:the |my |our )?(?:{_AGREED}|eyes)\b)"
)
_SUPPOSES = r"(?:if|when|once|after|suppose|supposing|assuming|imagine)"
_MOVED = re.compile(
    rf"\b{_SUPPOSES} {_WHO}(?: (?:now|then|were to|was to|would|should|could|just|simply|"
    rf"suddenly|quickly|slowly))* (?P<clause>{_MOVES}\b[^,;?]*)"
)
_OF_FORCE = re.compile(
    rf"\d ?(?:m?n|(?:milli)?newtons?|%|per ?cent|k?g|grams?)\b|\b(?:newton|percent|{_AGREED})\b"
)
"""What a clause has that supposes a force: 'if I closed it until 2 N are felt'."""

_HAPPENS = re.compile(
    r"(?:(?:and|but|so|then) )*what (?:would|will|might|could|may|does|do|is going to)?(?: then| "
    r"likely| probably)? ?(?:happens?|change|changes|occurs?|follows?|come of it|go wrong)\b.* "
    rf"{_SUPPOSES} .+"
)
_OF_LIFTING = re.compile(r"\b(?:lift|hold|carr[yi]|rais|pick|weigh|slip|add|mass|gram)\w*\b|\d")


def of_gripper(question: str) -> Meaning | None:
    """What touch can't know of the gripper and its moves; None of other questions."""
    words = _words(question)
    if _WHICH_FINGER.search(words):
        return read_query("unknown finger.")
    if _OPENING.search(words):
        return read_query("unknown opening.")
    moved = _MOVED.search(words)
    if moved and not _OF_FORCE.search(moved["clause"]):
        return read_query("unknown outcome.")
    return None


def of_outcome(question: str) -> Meaning | None:
    """What would happen after something that nothing is calculated with; None of others.

    'What happens if someone leans on the arm?'
    """
    words = _words(question)
    is_outcome = _HAPPENS.fullmatch(words) and not _OF_LIFTING.search(words)
    return read_query("unknown outcome.") if is_outcome else None


def _words(question: str) -> str:
    return " ".join(question.lower().replace("’", "'").split()).rstrip("?.! ")
