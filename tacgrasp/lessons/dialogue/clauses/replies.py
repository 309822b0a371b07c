"""Questions that say which word to reply under a condition.

    Say 'stop' if the force is past its limit and 'go' if it isn't.
    If it is deeper than 1 mm answer A, otherwise B.
    If the force is above 3 N, say STOP.                    else that it is not so

Words with values of their own ('light below 1 N') are ``tacgrasp.lessons.dialogue.choices.bins``.

Not here: the condition (``tacgrasp.lessons.dialogue.clauses.conditions``).
"""

from __future__ import annotations

import re

from tacgrasp.lessons.dialogue.choices.conditions import choice_of
from tacgrasp.lessons.dialogue.clauses.conditions import condition_of_statement
from tacgrasp.lessons.dialogue.expression import Expression
from tacgrasp.lessons.dialogue.meaning import Calculated

_SAY = (
    r"(?:say|reply|answer|respond|write|print|return|output|put down|tell me|give me|call it|put|"
    r"shout|yell|show|display|signal|report|tick|flag)(?: with| me| only| just)?"
)
_QUOTE = "['\"“”‘’`]?"
_LAST = (
    rf"(?:[,;.]\s*|\s+)(?:(?:and|or|"
    rf"but)\s+)?(?:{_SAY}\s+)?{_QUOTE}(?P<b>[\w-]+(?: [\w-]+)?){_QUOTE}"
    r"\s+(?:if (?:it|they|we|that|this|there|the \w+) (?:is|are|does|do|has|have|was)(?:n['’]t|"
    r" not)|"
    r"if not|otherwise|else|in (?:any|every) other case)[.?!\s]*"
)
_OTHERWISE = (
    rf"[,;.:]?\s+(?:(?:and|or|but)\s+)?(?:otherwise|else|if not|or else)[,:]?\s+(?:{_SAY}\s+)?"
    rf"{_QUOTE}(?P<b>[\w-]+(?: [\w-]+)?){_QUOTE}[.?!\s]*"
)
_WORD = rf"{_QUOTE}(?P<a>[\w-]+(?: [\w-]+)?){_QUOTE}"
_WHEN = r"(?:only )?(?:if|when|where|in case|as long as|provided(?: that)?)"
_REPLIES = tuple(
    re.compile(pattern, re.I | re.S)
    for pattern in (
        rf"(?:please\s+)?{_SAY}\s+{_WORD}\s+{_WHEN}\s+(?P<if>.+?){_LAST}",
        rf"(?:please\s+)?{_SAY}\s+{_WORD}\s+{_WHEN}\s+(?P<if>.+?){_OTHERWISE}",
        rf"{_WHEN}\s+(?P<if>.+?),?\s+(?:then\s+)?{_SAY}\s+{_WORD}{_OTHERWISE}",
        rf"unless\s+(?P<unless>.+?),?\s+(?:then\s+)?{_SAY}\s+{_WORD}{_OTHERWISE}",
    )
)
_CODE = (
    r"(?P<a>(?-i:[A-Z][A-Z-]+)|['\"“‘`][\w-]+(?: [\w-]+)?['\"”’`]|(?!(?:the|an?|its?|how|what|"
    r"which|where|whether|why|if|me|us|something|anything|nothing|so|that|this|depth|force|area|shape|"
    r"texture|position|mass|weight|limit|band|advice|one|hello|please)\b)[\w-]+)"
)
_ALONE = tuple(
    re.compile(pattern, re.I | re.S)
    for pattern in (
        rf"(?:please\s+)?{_SAY}\s+{_CODE}\s+{_WHEN}\s+(?P<if>.+)",
        rf"{_WHEN}\s+(?P<if>.+?),?\s+(?:then\s+)?(?:please\s+)?{_SAY}\s+{_CODE}[.?!\s]*",
    )
)
"""One word under a condition, and none otherwise."""

NOT_SO = "not so"
"""What is said otherwise."""

_WHICH = re.compile(
    r"(?<=[.?!'\"”’])\s*(?:which(?: (?:is it|one|word|do you say))?|what is it|what do you say|"
    rf"{_QUOTE}[\w-]+{_QUOTE} or {_QUOTE}[\w-]+{_QUOTE})\s*\?\s*$",
    re.I,
)
"""What asks once more behind it: 'Which is it?', 'Accept or reject?'."""

_TWO = re.compile(
    rf"(?:please\s+)?{_SAY}\s+{_WORD}\s+{_WHEN}\s+(?P<if>.+?)(?:[,;.]\s*|\s+)(?:(?:and|or|but)\s+)?"
    rf"(?:{_SAY}\s+)?{_QUOTE}(?P<b>[\w-]+){_QUOTE}\s+{_WHEN}\s+(?P<else>.+)",
    re.I | re.S,
)
_DEFINED = re.compile(
    rf".*?\b{_QUOTE}(?P<a>[\w-]+){_QUOTE},? or {_QUOTE}(?P<b>[\w-]+){_QUOTE}\b.*?(?:where|"
    rf"given that|when|if|and),? "
    rf"(?:an? |the )?{_QUOTE}(?P<same>[\w-]+){_QUOTE} (?:means?|needs?|requires?|is|takes?|wants?|"
    rf"stands for|"
    r"calls for)(?: that)? (?P<if>.+)",
    re.I | re.S,
)
_YES, _NO = ("yes", "true"), ("no", "false")


def replied(question: str) -> Calculated | None:
    """What a question means that says itself what to reply; None of other questions."""
    text = _WHICH.sub("", " ".join(question.split()))
    for pattern in _REPLIES:
        if (found := pattern.fullmatch(text)) is None:
            continue
        unless = found.groupdict().get("unless")
        if condition := condition_of_statement(unless or found["if"]):
            words = (found["b"], found["a"]) if unless else (found["a"], found["b"])
            return _reply(words[0], condition, words[1])
    if (found := _DEFINED.fullmatch(text)) and found["same"].lower() in (
        found["a"].lower(),
        found["b"].lower(),
    ):
        condition = condition_of_statement(found["if"])
        other = found["b"] if found["same"].lower() == found["a"].lower() else found["a"]
        return _reply(found["same"], condition, other) if condition else None
    found = _TWO.fullmatch(text)
    if found is None or not (condition := condition_of_statement(found["if"])):
        return _replied_alone(text)
    other = re.sub(r"\bit['’]s\b", "it is", found["else"].strip(" .?!"))
    if not condition_of_statement(other):
        return None
    return _reply(found["a"], condition, found["b"])


def _replied_alone(text: str) -> Calculated | None:
    """The word that is to be said under a condition, where none is named for the other case."""
    for pattern in _ALONE:
        found = pattern.fullmatch(text)
        if found and (condition := condition_of_statement(found["if"])):
            word = found["a"].strip("'\"“”‘’`")
            return _reply(word, condition, "no" if word.lower() in _YES else NOT_SO)
    return None


def _reply(first: str, condition: str, second: str) -> Calculated | None:
    """A choice between two words, or a verdict where these are yes and no."""
    words = (first.lower(), second.lower())
    if words[0] in _YES and words[1] in _NO:
        truth: str | None = condition
    elif words[0] in _NO and words[1] in _YES:
        truth = f"not ({condition})"
    else:
        truth = choice_of((first, condition), (second, ""))
    return Calculated(truth=truth, unit=None) if truth and Expression(truth).names else None
