"""Several things asked for at once, whatever stands before, between and behind them.

    dump: force N, depth mm, band status
    First tell me whether anything is in contact; then how far the gel is pressed in, in µm.
    Are we over the force limit, does the edge cut it, and how many grams would the grip hold?

All of them are read, in their order, or none.

Not here: each of them (``tacgrasp.lessons.dialogue.clauses.items``).
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from functools import cache

from tacgrasp.lessons.dialogue.calculations.quantity_names import UNIT
from tacgrasp.lessons.dialogue.clauses.items import item_of
from tacgrasp.lessons.dialogue.meaning import (
    Amount,
    Calculated,
    Check,
    Length,
    Meaning,
    Part,
    Several,
    Which,
)

MOST_ITEMS = 5
"""Most things that are asked for at once. Our choice."""

MOST_SEGMENTS = 10
"""Most segments of a question. Our choice: a pasted page would take seconds."""

MOST_TOGETHER = 4
"""Most segments that are read as one part: 'the force, which is in N, and so on' has no end."""

MOST_FOREIGN = 2
"""Most segments that another reader is asked about. Our choice: it takes tenths of a second."""

Reader = Callable[[str], Meaning | None]

_HEAD = re.compile(
    r"^(?:[^:;.?!–—]{1,60}[:–—]|[^:;.?!]{1,40} - ) *(?=\S)|^[\w' ]{1,40}\. (?=\w)", re.I
)
_BEARING = re.compile(
    r"\b(?:if|unless|when|after|before|compare|compared|which|ratio|sum|difference|larger|smaller|"
    r"greater|choose|pick|either|or|change|changed|between|product|total|mean|average|not|without|"
    r"except|"
    r"twice|half|double|what|how|is|are|does|why|most|least)\b|\d",
    re.I,
)
_OPENING = re.compile(
    r"^(?:(?:so|ok(?:ay)?|right|well|now|hey|hi|please|kindly|quickly|quick|alright|robot|and|just|"
    r"first|both)[,:]? )+|^(?:in|on|with|as) (?:one|a|a few|two|the same|"
    r"as few) (?:\w+ )?(?:sentence|line|go|breath|words?|message|reply|answer|"
    r"words as possible)[,:]? |^for (?:the|my|"
    r"our) \w+(?: \w+)?[,:] ",
    re.I,
)
_REQUEST = re.compile(
    r"^(?:(?:could|can|would|will) (?:you|i|we) (?:please |kindly |just )?)?(?:(?:please|kindly|"
    r"just|also|first|then|i need|i want|i would like|i['’]d like|we need|let['’]s have|"
    r"let me have|let me know|let us have|i['’]ll need|i['’]ll have|have|get|need|"
    r"want) )*(?:to (?:know|have|see|hear) )?(?:(?:tell|give|show|send|read|quote|state|report|say|"
    r"list|name|log|print|dump|output|spit out|describe|record|measure|note|display|provide|"
    r"start with|begin with|end with|finish with|open with|return|include|mention|add|read out|"
    r"sum up|summari[sz]e|(?:run|go|take (?:me|us)|walk (?:me|us)) through|rattle off|"
    r"recite)(?: (?:me|us|"
    r"down|out|off|back))*(?: (?:both|all|everything|please))?[:,]? )?(?:for (?:me|us)[:,]? )?",
    re.I,
)
_ORDINAL = re.compile(
    r"^(?:(?:first(?:ly)?(?: of all| off| up)?|second(?:ly)?|third(?:ly)?|fourth(?:ly)?|then|next|"
    r"after that|afterwards?|finally|lastly|last|last but not least|also|in addition|additionally|"
    r"besides(?: that)?|and|plus|as well as|followed by|one|two|three|four|a|b|c|d|i|ii|iii|"
    r"\d)(?:[,:)]|\b(?!\))) ?)+"
    r"(?=\S)|^\(?(?:\d|[a-d]|i{1,3})[.)] ?",
    re.I,
)
_PLACE = re.compile(r" (?:first|second|third|last|next|too|as well|also|at the end)$", re.I)
_NUMBERING = re.compile(r"(?:(?<=^)|(?<=[\s,;:.?]))\(?(?:[1-6]|[a-f]|i{1,3})[.)] ", re.I)
_ENDING = re.compile(
    r"[,;. –—-]*(?:\b(?:please|thanks|thank you|pls|in that order|in this order|nothing (?:else|"
    r"more)|that is all|that['’]s all|be quick|go|now|quick(?:ly)?|keep it short|in one (?:go|line|"
    r"sentence|reply)|on one line|all (?:at once|together|in one)|at once|cheers|ta|will do|"
    r"is all i need|(?:read|give|tell|list|send|report|state|name|show)(?: (?:me|us))? (?:them|it)"
    r"(?: (?:all|both))?(?: out| off)?|for (?:the|my|our) "
    r"(?:log|record|report|sheet|protocol|file|logbook|notes?))\b[\s.,!?]*)+$",
    re.I,
)
_OWN_UNIT = re.compile(
    rf"\s*,\s*(?=(?:in|as) (?:{UNIT}|µm|cm²|mm²|%|percent)(?=[\s,;.?!]|$))", re.I
)
_SHARED_UNIT = re.compile(
    r",? (?:both|all(?: three| of (?:it|them))?|each)(?: (?:of them|figures|numbers|"
    rf"values))? in (?P<unit>{UNIT}|µm)[\s.?!]*$",
    re.I,
)
_EACH_UNIT = rf"(?:{UNIT}|µm|cm²|mm²|%)"
_UNITS_BEHIND = re.compile(
    rf"(?P<items>.+?)[:;,.]*(?: (?:all (?:the )?(?:two|three|four|of them)|both)(?: (?:numbers|"
    rf"figures|values|of them))?,?)? (?:respectively )?in "
    rf"(?P<units>{_EACH_UNIT}(?:(?:, and |, | and ){_EACH_UNIT})+)"
    r"(?: respectively)?[\s.?!]*",
    re.I,
)
"""'Force, coverage, depth in N, percent, mm'."""

_PAD_SIZE = re.compile(
    r"(?:what (?:is|are) )?(?:the |your |our )?(?:sensing )?(?:pad|sensor|gel)(?:['’]s)?(?: "
    r"(?:size|"
    r"dimensions|measurements))?[?:,.–—-]* (?=(?:the )?(?:width|height|diagonal)\b)",
    re.I,
)
_SIZE = re.compile(r"\b(?:width|height|diagonal)\b", re.I)
"""'Pad dimensions: width, height', which are the pad's."""

_BETWEEN_UNITS = re.compile(r",? and |, ")
_BRACKETED = re.compile(rf"\s*[(\[]\s*(?:in )?(?P<unit>{UNIT}|µm|cm²|mm²|%)\s*[)\]]", re.I)
_JOINT = re.compile(
    r"\s*(?:[,;?!|/+]|\.(?!\d)|\s[–—-]\s|\s&\s|\band\b|\bplus\b|\bthen\b|\bas well as\b|"
    r"\balong with\b|\bfollowed by\b|\btogether with\b|\bnext to\b)(?:\s*(?:[,;]|\band\b|\bthen\b|"
    r"\balso\b|"
    r"\bplus\b))*\s*",
    re.I,
)

_YES_OR_NO = re.compile(r"\by/n\b", re.I)
_FRONTED = re.compile(
    r"[^,;:?.]+[,:] (?:is|are|does|do|has|have|how|what|where|would|can|could|"
    r"which)\b[^,;?]*\b(?:it|that|they|this|there)\b"
    r"[^,;?]*\??$",
    re.I,
)
"""A noun that a question behind it is about: 'the force, is it above 2 N'."""


def listed(question: str, read: Reader) -> Several | None:
    """All that a question of several parts asks for; None where one is not read.

    Args:
        question: The question.
        read: Reads a part that names nothing of the list's own.
    """
    if _YES_OR_NO.search(question):
        return None
    for text in _cores(question):
        if _FRONTED.match(text):
            return None
        segments, joints = _segments(text)
        if not 2 <= len(segments) <= MOST_SEGMENTS:
            continue
        parts = _parts(tuple(segments), tuple(joints), read)
        kept = tuple(dict.fromkeys(parts))
        amounts = [part.quantity for part in kept if isinstance(part, Amount)]
        if 2 <= len(kept) <= MOST_ITEMS and len(set(amounts)) == len(amounts):
            return Several(parts=kept)
    return None


def _cores(question: str) -> Sequence[str]:
    """A question without what stands before and behind its list."""
    text = _BRACKETED.sub(lambda match: f" in {match['unit']}", " ".join(question.split()))
    text = _ENDING.sub("", text)
    if shared := _SHARED_UNIT.search(text):
        told = f"{text[: shared.start()]} in {shared['unit']}"
        text = re.sub(r"\s*(?=[,;?]| and\b)", f" in {shared['unit']}", told)
    text = _OWN_UNIT.sub(" ", text)
    if pad := _PAD_SIZE.match(text):
        text = _SIZE.sub(r"pad \g<0>", text[pad.end() :])
    if behind := _UNITS_BEHIND.fullmatch(text):
        items, units = (_BETWEEN_UNITS.split(behind[name]) for name in ("items", "units"))
        if len(items) == len(units):
            text = ", ".join(f"{item} in {unit}" for item, unit in zip(items, units, strict=True))
    texts = [text]
    if (head := _HEAD.match(text)) and not _BEARING.search(_OPENING.sub("", head[0])):
        texts.insert(0, text[head.end() :])
    return [_REQUEST.sub("", _OPENING.sub("", _OPENING.sub("", each))) for each in texts]


def _segments(text: str) -> tuple[list[str], list[str]]:
    """Parts of a list, and what stands between them."""
    text = _NUMBERING.sub(", ", text).strip(" ,.;:?!")
    places = list(_JOINT.finditer(text))
    starts = [0, *(place.end() for place in places)]
    ends = [*(place.start() for place in places), len(text)]
    return (
        [text[start:end] for start, end in zip(starts, ends, strict=True)],
        [place[0] for place in places],
    )


def _parts(segments: Sequence[str], joints: Sequence[str], read: Reader) -> tuple[Part, ...]:
    """The parts of all segments, as few of them together as can be read; none where one is not.

    What is slow to read, by ``read``, is a segment of its own beside at least one of the list's.
    """
    own = [item_of(text) is not None for text in map(_bare, segments)]
    may_be_slow = any(own) and own.count(False) <= MOST_FOREIGN

    @cache
    def from_place(start: int) -> tuple[Part, ...]:
        for end in range(start + 1, min(start + MOST_TOGETHER, len(segments)) + 1):
            text = "".join(
                f"{segments[place]}{joints[place] if place < end - 1 else ''}"
                for place in range(start, end)
            )
            found = _read(text, read if may_be_slow and end == start + 1 else None)
            if not found:
                continue
            if end == len(segments):
                return found
            if others := from_place(end):
                return (*found, *others)
        return ()

    return from_place(0)


def _bare(text: str) -> str:
    """A segment without what asks for it and says which it is: 'then tell me the depth'."""
    text = _PLACE.sub("", text.strip(" .,;:?!"))
    while (shorter := _REQUEST.sub("", _ORDINAL.sub("", text))) != text and shorter:
        text = shorter
    return text


def _read(text: str, read: Reader | None) -> tuple[Part, ...]:
    text = _bare(text)
    if not text:
        return ()
    if item := item_of(text):
        return (item,)
    return _joinable(read(text)) if read else ()


def _joinable(meaning: Meaning | None) -> tuple[Part, ...]:
    if isinstance(meaning, Several):
        return meaning.parts
    if isinstance(meaning, Calculated):
        return (meaning,)
    if isinstance(meaning, Amount | Check | Which) and meaning.length is Length.FREE:
        return (meaning,)
    return ()
