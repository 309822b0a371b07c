"""Questions of how sure an answer is: of the one before, or of a quantity that they name.

    What is the force?                  How sure are you?
    What range could the force have?    How accurate is the depth?

Not here: confidences and intervals (``tacgrasp.lessons.answering``).
"""

from __future__ import annotations

import re

LAST = "last"
"""What is doubted where a question names nothing: the answer before."""

SHAPE = "What shape is it?"
"""What is doubted where nothing was answered yet."""

_NAMES = {
    "force": "What is the force?",
    "depth": "How deep is it?",
    "indentation": "How deep is it?",
    "contact area": "What is the contact area?",
    "area": "What is the contact area?",
    "shape": SHAPE,
    "texture": "What is the texture?",
    "position": "Where is it?",
}
_QUANTITY = (
    rf"(?:the |your |its )?(?P<of>{'|'.join(_NAMES)})(?: (?:reading|estimate|value|figure))?"
)
_IT = r"(?:it|that|this|the answer|your answer|they|those|your (?:estimate|reading|answer))"
_SPREAD = (
    r"(?:uncertainty|error|error bars?|interval|confidence interval|confidence|accuracy|precision|"
    r"spread|margin of error|reliability|certainty)"
)
_SURE = r"(?:sure|certain|confident|accurate|exact|precise|reliable|trustworthy|uncertain)"
_LEAD = r"(?:(?:and|but|so|ok|okay)[, ]+)*"
_END = r"(?: then| really| anyway| actually)?[?.! ]*"
_OF_QUANTITY = re.compile(
    rf"{_LEAD}(?:(?:what(?: is|'s)|tell me|give me|how (?:large|big|high) is) )?(?:the |your )?"
    rf"{_SPREAD} (?:of|on|in|for) {_QUANTITY}{_END}|"
    rf"{_LEAD}how {_SURE} (?:are you (?:of|about|in) |is ){_QUANTITY.replace('<of>', '<b>')}{_END}|"
    rf"{_LEAD}(?:are )?you (?:really |quite |absolutely |completely |so )*{_SURE} (?:of|about|in) "
    rf"{_QUANTITY.replace('<of>', '<f>')}{_END}|"
    rf"{_LEAD}(?:(?:can|should|shall|may) (?:i|we|you) (?:trust|rely on|believe) |is (?=.*{_SURE}))"
    rf"{_QUANTITY.replace('<of>', '<e>')}(?: {_SURE}(?: enough)?)?{_END}|"
    rf"{_LEAD}(?:in )?what range (?:could|can|may|might|does) {_QUANTITY.replace('<of>', '<c>')} "
    rf"(?:have|be(?: in)?|lie(?: in)?|fall(?: in)?){_END}|"
    rf"{_LEAD}(?:between )?(?:which|what) (?:values|bounds|limits|ends) (?:does|could|can|may) "
    rf"{_QUANTITY.replace('<of>', '<d>')} lie(?: between)?{_END}",
    re.I,
)
_OF_STATED = re.compile(rf"{_LEAD}how {_SURE} (?:are you|is it) that (?P<stated>.+?){_END}", re.I)
"""'How sure are you that it is a sphere?'"""
_OF_LAST = re.compile(
    rf"{_LEAD}(?:(?:can|should|shall|may) (?:i|we) (?:trust|rely on|believe) (?:{_IT}|"
    rf"(?:this|that|the) (?:number|figure|reading|value))|"
    r"(?:are )?you (?:really |quite |absolutely |completely )?(?:sure|certain)(?: "
    rf"(?:of|about) {_IT})?|(?:really |quite )?(?:sure|certain)|really|how sure|is {_IT} {_SURE}|"
    rf"how {_SURE} (?:are you|is {_IT}|are (?:they|those|those numbers))(?: (?:of|about|in) "
    rf"{_IT})?|(?:what is|what's) (?:the |your )?{_SPREAD}(?: of {_IT})?|how (?:much )?(?:percent "
    rf")?(?:are )?you sure|how many percent(?: sure)?(?: are you)?|(?:in )?what range (?:could|"
    rf"can|may|might) {_IT} (?:have|be(?: in)?|lie(?: in)?)){_END}",
    re.I,
)


def doubted_by(question: str) -> str:
    """The question whose answer is doubted: ``LAST``, or that for a quantity; '' of others."""
    question = question.strip()
    if found := _OF_QUANTITY.fullmatch(question):
        return _NAMES[next(filter(None, found.groupdict().values())).lower()]
    if found := _OF_STATED.fullmatch(question):
        return f"Is it true that {found['stated']}?"
    return LAST if _OF_LAST.fullmatch(question) else ""
