"""Forces of a text in their order, with what denies, corrects or reports them."""

from __future__ import annotations

import re
from typing import Literal, NamedTuple

from policies.instructions.english import words as english
from policies.instructions.english.denials import FORBIDDEN_AFTER, NO_CASE
from policies.instructions.quantities.force import AS_BEFORE, MARK, WORKED_OUT, Force, Kind
from policies.instructions.quantities.masses import OBJECT
from policies.instructions.quantities.outcomes import EarlierGrip, is_again, outcome
from policies.instructions.quantities.relations import BROUGHT_BELOW, NOT, relation
from policies.instructions.quantities.spans import force_spans

_LEFT_OUT = r"(?:leav(?:e|ing) out|omit(?:ting)?|skip(?:ping)?|(?:move|get|back|steer) away from|resist(?:ing)? the (?:temptation|urge))"
_DROPPED = re.compile(
    rf"\b(?:(?<!if )not|never|instead of|rather than|forget(?: about)?|isn't|{_LEFT_OUT}|no longer|nor)(?: (?:at|the|with|use|using|to|about|exactly))*\s*$|^\s*,? ?than(?: (?:at|with|use|using))*\s*$"
)
_NOT_WITH = re.compile(
    rf"\b(?<!why )(?<!why do )(?:{NO_CASE}|(?<!if )not(?! you (?:just |please )?(?:use|hold|keep|grip|grasp|take|try|go|apply)\b)|never|no|avoid\w*|refrain from|{_LEFT_OUT})"
    r"(?: (?:(?:crush|squash|squish|smash|bruise|burst|damage|hurt|break|mark|dent|destroy)(?= (?:it|this|that|the|them)\b)|ever|true|correct|want|like|dare|you|to|hold|keep|grip|grasp|pinch|pick|take|lift|set|go|apply|use|using|it|this|that|the|"
    r"(?:straw ?)?berry|fruit|one|at|with|a|force|of|for|exactly|about|around|in|within|between|from|(?<=\bthe )\w+|(?<=\bmy )\w+|(?<=\bthis )\w+|(?<=\bthat )\w+))*\s*$"
)
"""Before a force: it is not to be used."""

_OUTSIDE = re.compile(
    r"\b(?:outside|out of|beyond|apart from|other than|except(?: for)?|exclud(?:e|es|ing))(?: of)?(?: the)?(?: (?:force )?(?:range|window|band|interval))?(?: of| from| between)?\s*$"
)
"""Before a range: it is not to be used."""

_BETWEEN = re.compile(
    rf"\bbetween(?: (?:the|a|some\w*|about))* {MARK}(?: \w+)? and(?: (?:the|a|about))*\s*$"
)
_WITHIN = re.compile(r"(?:between|from|in|within)\b")
_CORRECTION = re.compile(
    rf"\b(?:no,? wait|wait,? no|make (?:that|it)|{english.any_of('correction')}|in other words|i\.e\.|meaning|sorry|(?:hmm+|oh),? no|actually|(?:or )?better(?: still| yet)?(?=[ ,:]*$))\b[ ,:-]*"
)
_TAKEN_BACK = re.compile(
    rf"[\s.,;:!…–—-]*\b(?:no,? wait|wait,? no|{english.any_of('correction')})(?:[\s.!]*$|[ ,.;:!…–—-]+[^\d]*\b{english.any_of('grip_word')})"
)
"""Behind a force: no other one takes its place ('1 N. Scratch that.', '2 N, oops, gently')."""
_WRONG = (
    r"(?:(?:got|gets|had|has|wrote|copied|read|typed|put|took|set|noted|scribbled|jotted)(?: (?:it|that|this|them|the \w+))?(?: down| up)? (?:all )?(?:wrong(?:ly)?|incorrect(?:ly)?|in error|by mistake)|"
    rf"(?:is|was|are|were|'s|looks|seems)(?: (?:just|simply|plain|clearly|definitely|totally|completely|obviously|quite|all))? (?:wrong|incorrect|mistaken|inaccurate|outdated|out of date|obsolete|rubbish|nonsense|garbage|bogus|(?:not|never) (?:right|correct|true)|an? (?:typo|mistake|misprint|error|slip|old (?:figure|value|number))|not (?:\w+ )?(?:for|right for|suited to) (?:the |this |these |our |my |an? )?{OBJECT})|(?:does|do) not (?:apply|count|fit|suit|belong)|"
    r"made an? (?:\w+ )?(?:mistake|typo|slip|error)|(?:misread|mistyped|misprinted|mis-?wrote|miswritten|misheard|miscopied|misnoted))"
)
_WAS_WRONG = re.compile(
    rf"(?<!nothing )(?<!something )(?<!what )\b(?:{_WRONG}\b|"
    r"(?:should|ought to|(?:was|is) (?:meant|supposed) to)(?: really| actually| of course)? (?:be|read|say|have (?:been|read|said))(?: about| around| roughly)?\s*$)"
)
"""Between two forces: the second stands for the first ('he wrote 0.9 N but got it wrong, it is 0.6 N')."""
_IS_WRONG = re.compile(
    rf"(?:(?:,? (?:on|in|at|from|of|by|up on) (?:the |his|her|my|that)?[^\d.;,!?#]{{1,25}})?,? ?[–—-]? ?(?:(?:but|which|that|however|though|yet|only)\b[^\d.;!?#]{{0,30}}? ?)?){_WRONG}\b"
)
"""Behind a force that is not to be used."""
_CONDITION = re.compile(
    r"\bif\b.*?(?=\b(?:use|hold|grip|apply|take|go|try|squeeze|press|then)\b)|\bif not\b"
)
"""'If it does not slip use 0.5 N': its denial is not that of the force."""
_MAKE_SURE = re.compile(
    r"\b(?:make (?:sure|certain)|ensure|see (?:to it )?that|take care|be sure)\b[^.;!?]*\b(?:not|never)\b[^.;!?]*$"
)
_AGAINST = re.compile(
    r"\b(?:i doubt|doubtful|foolish|unwise|inadvisable|ill-advised|stupid|crazy|insane|madness|silly|reckless|careless|irresponsible|idiotic|folly|pointless|senseless|daft|nonsense) (?:\w+ ){0,6}$"
)
"""'It would be foolish to grip it with 2 N'."""
_NO_DENIAL = re.compile(
    r"\bwhy (?:not|do not)\b|\b(?:can|could|will|would|do|should) not (?:you|we)\b|\b(?:slip|slid|crush|bruis|squash)\w*|\bstop\w* (?:\w+ )?at\s*$|"
    r"\b(?:harder|firmer|more|higher|tighter|above|over) (?:or|nor) (?:softer|gentler|less|lower|looser|below|under)\b|\b(?:will|would) not do\b|"
    r"\bnot (?:too|go(?:ing)? wrong|mind|object|hesitate|forget|fail|be (?:shy|afraid|scared))\b|\b(?:nothing|no|never|not) (?:wrong|problem|objection|harm|hurry|rush|worr(?:y|ies)|stress|panic|gent\w+|soft\w*)\b"
)
"""'Why not use 2 N', 'it did not slip at 0.5 N': what is denied is not the force."""
_REJECTED = re.compile(
    rf"\s*(?:[:,;.!?–—-]*\s*(?:no way|no thanks?|no chance|not a chance|absolutely not|certainly not|definitely not|not on your life|nope|never|forget it|no|not|wrong)[.!]*\s*$|"
    rf"(?:\w+ ){{0,2}}?{FORBIDDEN_AFTER}|(?:is|would be|was|sounds|seems) (?:just |plain |simply |really |rather )?(?:an? )?(?:(?:really |very |terribl[ey] )?(?:bad|terrible|awful|poor|stupid|foolish|silly|crazy|dreadful) (?:idea|choice|plan)|foolish|unwise|inadvisable|stupid|crazy|insane|madness|reckless|irresponsible|nonsense|folly)\b|"
    r",? ?like the (?:\w+ ){1,3}?(?:that|which|you) (?:(?:got|was|were|had|just) )*(?:crush|bruis|squash|burst|broke|ruin|split)\w*)"
)
"""'2 N: no way', 'holding it with 2 N is a bad idea'."""
_LESS = re.compile(r"\b(?:less|short|shy|fewer|lower|softer|gentler|below|under|beneath)\b")
"""In the words of a least force: 'not less than 1 N' has its denial in them."""
_PAST = re.compile(
    r"\b(?:last (?:time|one|run|trial|try|berry)|yesterday|previous(?:ly)?|before(?! (?:you|we|i|it|the|they|that|[a-z]+ing)\b)|earlier|used to|was|were|had|"
    r"slipped|slid|crushed|squashed|bruised|dropped|tried|went|did)\b"
)


_TRIED = re.compile(
    r"\b(?:i|we|he|she|they|someone|somebody)(?: (?:once|just|also|have|even|only))* (?:tried|used|took|applied|had)(?: (?:it|this|that|one|the \w+))?(?: (?:with|at))?(?: (?:about|around))?\s*$"
)
_THEN = re.compile(
    r"\s*(?:yesterday|last (?:time|week|night|year|month)|earlier|the other day|this morning)\b"
)
_AS_THEN = re.compile(rf"{AS_BEFORE}|\bthat\b")
"""Beside a force of another day: it is asked for today too."""


class ReadForces(NamedTuple):
    """The forces of a text.

    Attributes:
        kept: Those that it asks for or bounds the grip by.
        dropped: Those that it denies, takes back or tells of the past.
        denied: Words of the one that it only denies; '' for none.
        rest: The text with ``MARK`` for each force.
    """

    kept: list[Force]
    dropped: list[Force]
    denied: str
    rest: str


def read_forces(text: str) -> ReadForces:
    """Read the forces of a text."""
    denied = ""
    found: list[tuple[Force, bool]] = []  # a force, and whether it is of the past or denied
    denials: set[str] = set()  # words of the forces whose clause denies them
    rest, end = "", 0
    told = ""  # words of a force that was used on another day
    became: Literal["least", "most"] | None = None  # what the force before is by its outcome
    for start, stop, ends, within_n in force_spans(text):
        left, right = text[end:start], text[stop:]
        is_worked_out = left.rstrip().endswith(WORKED_OUT)
        left = left.replace(WORKED_OUT, " ").rstrip() + " " if is_worked_out else left
        words = text[start:stop].strip()
        said = None
        if not BROUGHT_BELOW.search(left):  # nothing slips in 'make sure it falls below 1 N'
            said = outcome(f"{left.rstrip()} at" if _WITHIN.match(words) else left, right)
        if _MAKE_SURE.search(left):
            said = None  # it is to come, and no outcome
        if said is None and became and is_again(left, right):
            said = EarlierGrip(kind=became, left_cut=len(left), right_cut=0)
        became = said.kind if said and said.kind != "failed" else None
        if said:
            words = f"{left[said.left_cut :]}{words}{right[: said.right_cut]}".strip(" ,:")
            left, stop = left[: said.left_cut], stop + said.right_cut
            if said.kind == "failed":
                denied = words
                found.append((Force(kind="value", value_n=ends[0], words=words), False))
            else:
                value_n = max(ends) if said.kind == "least" else min(ends)
                found.append(
                    (Force(kind=said.kind, value_n=value_n, words=words, is_told=True), True)
                )
        elif found and len(ends) == 1 and _BETWEEN.search(" ".join(f"{rest}{left}".split())):
            other = found.pop()[0]
            low, high = sorted((other.value_n, ends[0]))
            words = f"{other.words} to {words}"
            found += [
                (Force(kind="least", value_n=low, words=words), True),
                (Force(kind="most", value_n=high, words=words), True),
            ]
        elif len(ends) == 2:
            low, high = sorted(ends)
            is_outside = bool(_OUTSIDE.search(left)) and not NOT.search(left)
            kept = not (_DROPPED.search(left) or is_outside)
            if _CORRECTION.search(left):
                found = [(force, False) for force, _ in found]
            if not kept or _NOT_WITH.search(left):
                kept, denied = False, words
            found += [
                (Force(kind="least", value_n=low, words=words), kept),
                (Force(kind="most", value_n=high, words=words), kept),
            ]
        else:
            kind, left_cut, right_cut = relation(left, right)
            words = (
                f"{left[left_cut:]}{words}{right[:right_cut]}".strip(" ,:")
                .removeprefix("- ")
                .rstrip(" -")
            )
            left, stop = left[:left_cut], stop + right_cut
            said_of_last = _WAS_WRONG.search(left) if found else None
            own = left[said_of_last.end() :] if said_of_last else left
            own = _CORRECTION.split(own)[-1]
            before = _CONDITION.sub(
                "",
                re.split(
                    r"[.;,]\s|\s[-–—]\s|\(|\b(?:but|because)\b|\band(?=\s*$| (?:do not|never|not|no|do|at|with|min\w*|max\w*|below|under|above|over|stay|keep|limit|cap)\b)",
                    own,
                )[-1],
            )
            after = re.split(
                r"[.;:,(]\s?|\s[-–—]\s|\band (?=(?:the|i|we|it|yesterday|last)\b)|\b(?:but|though|although|whereas|instead of|rather than|because|since)\b",
                text[stop:],
                maxsplit=1,
            )[0]
            clause = before + after
            may_be_denied = kind == "value" or (kind == "least" and not _LESS.search(words))
            if kind == "value":
                is_denied = bool(_DROPPED.search(left) or NOT.search(before))
            else:
                is_denied = may_be_denied and bool(_NOT_WITH.search(left))
            if is_denied and len(NOT.findall(before)) % 2 and not _NO_DENIAL.search(before):
                denials.add(words)
            behind = text[stop:].lstrip(" .,;-–—")
            corrected = _CORRECTION.match(behind)
            if corrected and NOT.search(behind, corrected.end()) and not re.search(r"\d", behind):
                denials.add(words)  # '1 N, or rather do not hold it'
            if _WAS_WRONG.search(left) and not (found and _DROPPED.search(left)):
                if kind == "value":
                    kind = _kind_corrected([force for force, _ in found if not force.is_told])
                found = [(force, kept and force.is_told) for force, kept in found]
            if _CORRECTION.search(left) or corrected:
                is_denied = is_denied or not _CORRECTION.search(left)
                if _CORRECTION.search(left):
                    if kind == "value":
                        kind = _kind_corrected([force for force, _ in found])
                    found = [(force, False) for force, _ in found]
            if is_worked_out and kind == "value":
                is_denied = False
                found = [(f, kept and (f.is_told or f.kind != "value")) for f, kept in found]
            kept = is_worked_out or not (_PAST.search(clause) or is_denied)
            if _TRIED.search(before) and _THEN.match(after):
                told = words
            is_taken_back = bool(_TAKEN_BACK.match(text[stop:]) or _IS_WRONG.match(text[stop:]))
            if may_be_denied and not is_worked_out:
                is_taken_back |= bool(_AGAINST.search(left) or _REJECTED.match(text[stop:]))
            if is_taken_back or (may_be_denied and _NOT_WITH.search(left)):
                denied, kept = words, kept and not is_taken_back
            force = Force(kind=kind, value_n=ends[0], words=words, within_n=within_n)
            found.append((force, kept))
        rest, end = f"{rest}{left} {MARK} ", stop
    rest = " ".join((rest + text[end:]).split())
    kept_forces = [force for force, kept in found if kept]
    denied_n = {force.value_n for force, kept in found if not kept and force.words == denied}
    if denied and denied_n.issuperset(force.value_n for force in kept_forces):
        return ReadForces([], [], denied, rest)
    if not kept_forces and (unwanted := [force for force, _ in found if force.words in denials]):
        return ReadForces([], [], unwanted[0].words, rest)
    dropped = [force for force, kept in found if not kept] if kept_forces else []
    if not kept_forces and told and not _AS_THEN.search(text):
        return ReadForces([], [], told, rest)  # 'don't crush it, and I tried 3 N yesterday'
    kept_forces = kept_forces or [force for force, _ in found]
    bounds = {force.value_n for force in kept_forces if force.kind != "value"}
    kept_forces = [f for f in kept_forces if f.kind != "value" or f.value_n not in bounds]
    return ReadForces(kept_forces, dropped, "", rest)


def _kind_corrected(found: list[Force]) -> Kind:
    """Kind of the force that a bare one corrects: 'at most 2 N, make that 1 N' is at most 1 N."""
    if not found or (len(found) > 1 and found[-2].words == found[-1].words):  # a range
        return "value"
    return found[-1].kind
