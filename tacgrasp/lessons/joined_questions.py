"""Questions of several parts, each of which the grammar or a rule reads.

    How deep is it, and is it round?        both
    Is it deep, rough and cut off?          each with the subject of the first
    Is it neither rough nor deep?           each denied
    Is it rough or deep?                    either; words of one kind are a choice
    Is it a smooth ball?                    the adjective and the noun

Not here: parts that only the language model reads (``tacgrasp.lessons.understanding``).
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from tacgrasp.lessons.dialogue.choices.named import either_named
from tacgrasp.lessons.dialogue.clauses.lists import Reader
from tacgrasp.lessons.dialogue.conditions import check_of
from tacgrasp.lessons.dialogue.families.catalogue import understand
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
from tacgrasp.lessons.dialogue.plainer import AUXILIARY, plainer
from tacgrasp.lessons.dialogue.rules.ruled import ruled
from tacgrasp.lessons.question_form import is_one_clause

MOST_JOINED = 5
"""Most wordings of the grammar that are asked together. Our choice; a model's query has three."""

MOST_APART = 3
"""Most joined questions that are read by more than the grammar. Our choice."""

MOST_JOINTS = 8
"""Most places where a question may be divided. Our choice: three questions with commas of their own
have fewer, and a pasted page would take seconds."""

JOINT = re.compile(
    r"\s*[?;.]\s+(?:oh,?\s+)?(?:and\s+|also\s+)?|\s*,?\s+(?:as well as|along with|and also)\s+|"
    r"\s*,\s+(?:(?:and|but)\s+)?|\s+(?:and|plus|but)\s+",
    re.I,
)
"""What joins two questions."""

_SUBJECT = re.compile(
    rf"{AUXILIARY} (?:it|this|that|we|they|(?:the|our|this|that) \w+) ",
    re.I,
)
"""Verb and subject that begin a question: 'is it', 'does the object'."""

_SIDES_JOINED = re.compile(
    r"\b(?:left|right|top|bottom|upper|lower|palm|fingertip)(?:[- ]hand)?(?: \w+)? (?:and|or) "
    r"(?:(?:on|at|over|off|by) )?(?:the )?(?:left|right|top|bottom|upper|lower|palm|fingertip)\b",
    re.I,
)
"""Sides that are no clauses of their own: 'the left and the bottom edge'."""

_ADJECTIVE = re.compile(
    rf"({AUXILIARY} (?:it|this|that) )an? ((?:very )?\w+) (.*)",
    re.I,
)

_NEITHER = re.compile(
    rf"(?:(?P<verb>{AUXILIARY}) )?(?:(?P<subject>it|this|that|(?:the|our|this|that) \w+)"
    r"(?: (?:touching|on|against|in|under) the \w+)?)? ?"
    r"(?:is |['’]s )?neither (?P<parts>.+? nor .+?)(?:,? (?:right|correct|yes|no|true))?[?.! ]*",
    re.I,
)
_NOR = re.compile(r",? nor (?:is it )?|, ", re.I)
"""'Is it neither rough nor deep': verb, subject and what is denied."""

_OR = re.compile(r",? or (?:is it )?", re.I)
"""What joins conditions of which one is enough."""

_EITHER = re.compile(r"\beither (?=.* or )", re.I)
_NOT_EITHER = re.compile(r"\b(?:and|not|neither|or not)\b|n['’]t\b", re.I)

REQUEST = re.compile(
    r"^(?:(?:could|can|would|will) you )?(?:please |kindly )?(?:give|tell|note|state|report|name|"
    r"list|enumerate|specify|show|measure|read|write|send|log|record|quote|describe|"
    r"summari[sz]e)(?: down| out| off)?(?: (?:me|us))?(?: for the \w+)?[ :,]+|"
    r"^(?:(?:could|can|may) (?:i|we) (?:have|get|see)|(?:i|we) (?:need|want|would like)|let "
    r"me have) ",
    re.I,
)
"""What may stand before a list of things that are asked for."""

_COUNTED = re.compile(
    r"^(?:(?:the|these|just|only) )?(?:\d|two|three|four|five|several|a few) "
    r"(?:things|items|figures|values|numbers|readings|words|answers|facts|"
    r"entries)\b[^:,]{0,25}(?:, please)?[:,] *|^(?:(?:give|tell|send) (?:us|me) )?(?:the lot|"
    r"all of it|everything): *|^(?:quick |"
    r"short |brief |full )?(?:status|summary|report)(?: please)?: *",
    re.I,
)
"""'Three items for the log, please: ...'"""

_AT_LENGTH = re.compile(
    r"^in (?:one|a) (?:single )?(?:sentence|word)(?: each| for [\w ]{2,20})?[,:] |"
    r",? (?:all )?in (?:one|a) "
    r"(?:single |short |full |complete )?(?:sentence|word|line)(?: each)?(?:[.?!]*$|, )",
    re.I,
)
"""How long an answer is to be; that to several questions is as long as it must be."""

_LISTED = re.compile(
    r",? (?:(?:please|both|all|all three|each)(?: (?:figures|numbers|values|of (?:them|these)))?|"
    r"nothing else|go|side by side|in one go|at once|(?:and )?keep it (?:short|brief)|be brief|"
    r"briefly|in that order|"
    r"of what (?:you|we) feel|for (?:my|our|the) \w+)(?=[.?!,]*$)",
    re.I,
)
"""What may stand behind a list."""

_BOTH_ENDS = re.compile(
    r"\b(?:(?:the )?(?:two |both )?(?:ends|edges|bounds|limits) of "
    r"(?:the |our )?(?:\w+ )?(?:band|window|range)|(?:the |our )?(?:\w+ )?(?:band|window|"
    r"range)(?:,|:| -)? (?:its )?(?:low|lower|bottom|lower end)(?: end)? and "
    r"(?:its )?(?:high|upper|top|upper end)(?: end)?|from "
    r"(?:what|which|how many|how much)(?: \w+)? to (?:what|which|how many|how much)(?: \w+)? "
    r"(?:does|do|is) (?:the |our )?(?:\w+ )?(?:band|window|range)(?: (?:go|run|reach|extend))?|"
    r"(?:the |our )?(?:\w+ )?(?:band|window|range)(?: we (?:were|are) aiming for)?, from and to)\b",
    re.I,
)
_HOW_MUCH = re.compile(
    r"\bhow much (?=(?:force|area|depth|pressure)(?: in \w+)?(?:,|;|[?.!]*$| and\b))", re.I
)
"""'How deep, how much force': a noun in a list."""

_INDIRECT = (
    (
        r"\b(?:with |under |at )?(?:what|which) (shape|texture|surface|force|depth|area|"
        r"position)(?: (?:you|we) (?:feel|sense|measure|see)| it (?:is|has)| there is)?(?=,|;|"
        r"[?.!]*$|"
        r" and\b| in \w+)",
        r"\1",
    ),
    (
        r"\b(force|limit|band|depth|area|mass) (?:that |which )?(?:we|you|i) "
        r"(?:have|must|should|can|feel|keep|are)"
        r"(?: \w+){0,2}(?=,|;|[?.!]*$| and\b)",
        r"\1",
    ),
    (r"\bhow deep (?:it is|it goes|it sits)\b", "depth"),
    (
        r"\bhow (?:strong|hard|firm|firmly|strongly) (?:it is (?:pressed|held|gripped)|it "
        r"presses|it is)\b",
        "force",
    ),
    (r"\bwhere (?:on the \w+ )?(?:it is|it sits|it lies|the contact is)\b", "position"),
    (r"\bhow (?:large|big) (?:the (?:area|contact|patch) is|it is)\b", "area"),
    (r"\b(?:how|what) (?:the|its) surface (?:feels|is)(?: like)?\b", "texture"),
)
"""Parts of 'tell me how deep it is and with what force', as the nouns that they ask for."""

_LOW_AND_HIGH = "lower end of the band and upper end of the band"


def asked_together(question: str) -> Meaning | None:
    """The meaning of a question with several parts, or of one that a rule reads; None of others."""
    parts = _neither(question) or _either(question) or joined(question)
    return together(parts) if parts else _ruled(question)


def is_either(question: str) -> bool:
    """Whether one of the conditions that a question names is enough: 'is it rough or deep?'."""
    return _OR.search(question) is not None and _NOT_EITHER.search(question) is None


def asked_apart(question: str, read: Reader) -> Meaning | None:
    """The meaning of two or three joined questions, each of which ``read`` reads; else None."""
    parts = _joined(question, MOST_APART, read)
    return together(parts) if parts else None


def joined(question: str, most: int = MOST_JOINED) -> tuple[Part, ...]:
    """The meanings of at most so many joined wordings of the grammar; none where it lacks one."""
    return _joined(question, most, read_part)


def _joined(question: str, most: int, read: Reader) -> tuple[Part, ...]:
    question = _COUNTED.sub("", REQUEST.sub("", _AT_LENGTH.sub(" ", question).strip(), count=1))
    question = _HOW_MUCH.sub("", _BOTH_ENDS.sub(_LOW_AND_HIGH, question))
    for pattern, noun in _INDIRECT:
        question = re.sub(pattern, noun, question, flags=re.I)
    while (shorter := _LISTED.sub("", question)) != question:
        question = shorter
    joints = list(JOINT.finditer(question))
    if len(joints) > MOST_JOINTS:
        return ()
    for joint in joints:
        first = joinable(read(question[: joint.start()]))
        if not first:
            continue
        rest, left = question[joint.end() :], most - len(first)
        for others_asked in (rest, *_same_subject(question, joint, rest)):
            others = joinable(read(others_asked))
            others = others or (_joined(others_asked, left, read) if left > 1 else ())
            if 0 < len(others) <= left:
                return first + others
    return ()


def read_part(question: str) -> Meaning | None:
    """The meaning of a question of one clause by the grammar or by a rule; None of others."""
    return understand(question) or _ruled(plainer(question))


def _ruled(question: str) -> Meaning | None:
    return ruled(question) if is_one_clause(_SIDES_JOINED.sub("side", question)) else None


def _neither(question: str) -> tuple[Check, ...]:
    """The denied parts of 'is it neither rough nor deep'; none of another question."""
    if (found := _NEITHER.fullmatch(question)) is None:
        return ()
    begin = " ".join((found["verb"] or "is", found["subject"] or "it"))
    parts = [understand(f"{begin} {part}") for part in _NOR.split(found["parts"])]
    checks = [part for part in parts if isinstance(part, Check) and part.test and not part.denied]
    if len(checks) < len(parts):
        return ()
    return tuple(check_of(check.test, denied=True) for check in checks)


def either_of(question: str) -> Meaning | None:
    """What 'is it either a ring or a disc' means: whether it is one of them; None of others."""
    if _EITHER.search(question) is None:
        return None
    parts = _either(_EITHER.sub("", question), of_one_kind=True)
    return together(parts) if parts else either_named(question)


def _either(question: str, *, of_one_kind: bool = False) -> tuple[Check, ...]:
    """The parts of 'is it rough or deep'; else none of words of one kind, which are a choice."""
    first, *others = _OR.split(question)
    if not is_either(question) or len(others) >= MOST_JOINED:
        return ()
    begin = _SUBJECT.match(question)
    told = [understand(first)]
    for part in others:
        told.append((understand(f"{begin[0]}{part}") if begin else None) or understand(part))
    checks = [each for each in told if isinstance(each, Check) and not each.needed_n]
    if len(checks) < len(told):
        return ()
    kinds = {check.shows for check in checks}  # 'left' and 'right' are of one kind
    are_compared = all(re.search(r"\d", check.test) for check in checks)
    return tuple(checks) if len(kinds) > 1 or are_compared or of_one_kind else ()


def _same_subject(question: str, joint: re.Match[str], rest: str) -> Iterator[str]:
    """What comes behind a joint, with the verb and subject of the first part: 'and smooth?'."""
    if (begin := _SUBJECT.match(question)) and joint[0].strip()[:1] not in ("?", ";", "."):
        yield f"{begin[0]}{rest}"


def with_adjective(question: str) -> Meaning | None:
    """The meaning of 'is it a smooth ball': is it smooth, and is it a ball; None of others."""
    if (asked := _ADJECTIVE.fullmatch(question)) is None:
        return None
    begin, adjective, noun = asked.groups()
    parts = [understand(f"{begin}{part}") for part in (adjective, f"a {noun}")]
    checks = [part for part in parts if isinstance(part, Check)]
    named = [check.test.partition(" ")[0] for check in checks]
    return Several(parts=tuple(checks)) if named == ["texture", "shape"] else None


def together(parts: Sequence[Part]) -> Meaning:
    """Parts as one meaning; 'is it slight, moderate or deep' offers all three words."""
    offered = {part.name for part in parts if isinstance(part, Which) and not part.is_open}
    kept = tuple(
        part
        for part in dict.fromkeys(parts)
        if not (isinstance(part, Check) and part.test.partition(" ")[0] in offered)
    )
    return kept[0] if len(kept) == 1 else Several(parts=kept)


def joinable(meaning: Meaning | None) -> tuple[Part, ...]:
    """The parts of what can be asked together with others; none of what can't be."""
    if isinstance(meaning, Several):
        return meaning.parts
    if isinstance(meaning, Calculated):
        return (meaning,)
    if isinstance(meaning, Amount | Check | Which) and meaning.length is Length.FREE:
        return (meaning,)
    return ()
