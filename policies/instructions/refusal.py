"""What must not be carried out: no touching, letting go, harm, limits set aside, no request at all."""

from __future__ import annotations

import re

from policies.instructions.english import words
from policies.instructions.english.denials import is_denied
from policies.instructions.english.text import CLAUSE, sentences
from policies.instructions.manner import has_manner, without_neutral
from policies.instructions.prohibitions import prohibition
from policies.instructions.quantities import MARK

_MODAL = re.compile(
    r"\b(?:it|this|that|berry|fruit|skin|they|one|strawberry|force|pressure|grip|or|else|i|we|fingers|newtons|#|otherwise|which|these|those|berries|fruits|easily|to easily|"
    r"if you|or you|else you|when you|lest you|you always|you keep|you just|you often|you nearly|you almost|you are|you were|almost|nearly|not to|so as not to|"
    r"you (?:will|would|might|may|could)|it (?:will|would|might|may|could|can)|going to|tends? to|liable to|likely to|about to|prone to|ready to|waiting to|wants to|threaten\w* to|"
    r"will|would|might|may|does|do not|did|could|can|shall)(?: (?:only|just|easily|simply|surely|otherwise|probably|always|never|also))*\s*$"
)
_ASKS = re.compile(
    r"\b(?:can|could|will|would|want|need|would like|order|tell|ask|command) you(?: to| please| just)*\s*$"
)
_OBJECT = r"(?: (?:it|this|that|the|them|these|those|him|her|my|a|an|some|every\w*|all|your|our|berry|strawberry|fruit|like|flat|down|up|apart|in|into|to)\b|(?=[.!,;]*$)| and\b| or\b)"
_DESTROY_VERB = re.compile(rf"\b{words.any_of('destroy')}(?:n?ing|t?ing|p?ing)?\b{_OBJECT}")
_DESTROY_PHRASES = words.groups("destroy_phrase")
_HARM = words.groups("harm_phrase")
_OVERRIDE = words.groups("override")
_RELEASE = words.groups("release")
_HANDOVER, _PUT_DOWN = words.any_of("handover"), words.any_of("put_down")
_STOP = words.groups("stop")
_FORCE_NOUN = re.compile(r"\b(?:force|grip|pressure|squeeze|squeezing|tension)\b")
_WEAK_STOP = re.compile(
    r"\b(?:wait|stay|leave it there|remain|pause|stand by|hold (?:it )?there)\b|^not move"
)
_HOLD = re.compile(rf"\b{words.any_of('hold')}\b")


def refusal_of(text: str, whole: str = "") -> str:
    """Why a plain text, its quantities replaced, must not be carried out; '' where it may.

    Args:
        text: The text with its quantities replaced.
        whole: The same text with its quantities.
    """
    if found := _sets_limits_aside(text) or _sets_limits_aside(whole):
        return f"it sets limits aside: {found}"
    text = without_neutral(text)
    for find, reason in (
        (_harms, "it would harm a living being: {}"),
        (_destroys, "it would destroy what is held: {}"),
        (_releases, "it asks to let go: {}"),
        (_contradicts, "it contradicts itself: {}"),
        (_stops, "it asks to stop or not to touch: {}"),
    ):
        if found := find(text):
            return reason.format(found)
    return ""


def _contradicts(text: str) -> str:
    match = re.search(
        r"\bwithout (?:applying |using |exerting |putting )?any (?:force|pressure|grip|squeeze)\b|\b(?:with|apply|use|exert|put) (?:no|zero|absolutely no) (?:force|pressure|grip|squeeze|contact)\b(?! (?:more|greater|above|over|beyond|than|higher))"
        r"|\bwithout (?:force|pressure|closing|using your fingers|moving|gripping|holding|contact)\b",
        text,
    )
    if match is None:
        return ""
    is_order = re.match(r"(?:apply|use|exert|put)", match.group())
    return match.group() if is_order or _HOLD.search(text[: match.start()]) else ""


def _clauses(text: str) -> list[str]:
    return [
        part.strip()
        for sentence, _ in sentences(text)
        for part in CLAUSE.split(sentence)
        if part and part.strip()
    ]


def _sets_limits_aside(text: str) -> str:
    for pattern in _OVERRIDE:
        for match in pattern.finditer(text):
            before = re.split(r"[.,;!?]", text[: match.start()])[-1]
            if not is_denied(before):
                return match.group().strip()
    return ""


def _harms(text: str) -> str:
    for sentence, _ in sentences(text):
        plain = re.sub(_HANDOVER, " ", sentence)
        for pattern in _HARM:
            for match in pattern.finditer(plain):
                before = re.split(r"[,;]", plain[: match.start()])[-1]
                if not is_denied(before) and not re.search(
                    r"\b(?:like|as if|as though|as \w+ as)\b", before + match.group()
                ):
                    return match.group().strip()
    return ""


def _destroys(text: str) -> str:
    for clause in _clauses(text):
        for pattern in _DESTROY_PHRASES:
            if (match := pattern.search(clause)) and not is_denied(
                clause[: match.start()], clause[match.end() :]
            ):
                return match.group().strip()
        for match in _DESTROY_VERB.finditer(clause):
            before, behind = clause[: match.start()], clause[match.end() :]
            if re.match(r" ?(?:\w+ )?(?:force|grip|pressure|squeeze|grasp)\b", behind):
                continue  # 'cut the grip force by half'
            if is_denied(before, behind) or re.search(
                r"\b(?:better|rather|sooner|too|easy|easily|hard|how|any|than|the|a|no|of)\s*$",
                before,
            ):
                continue
            if _MODAL.search(before) and not _ASKS.search(before):
                continue
            return match.group().strip()
    return ""


def _releases(text: str) -> str:
    for clause in _clauses(text):
        for pattern in _RELEASE:
            for match in pattern.finditer(clause):
                before, after = clause[: match.start()], clause[match.end() :]
                if is_denied(before, after) or re.match(
                    r" (?:of )?(?:the|that|this|your|any|all)? ?(?:\w+ ){0,2}(?:idea|notion|act|thought|approach|macho|pressure|tension|force)\b",
                    after,
                ):
                    continue
                if _FORCE_NOUN.search(match.group() + after[:12]):
                    continue  # 'drop the force'
                if re.search(
                    r"\b(?:(?:it|they|berry|one)|(?:or(?: else)?|else|otherwise|lest|unless|in case) (?:you|we|i)|if (?:you|we)) (?:(?:might|may|will|could|would|can|just|only|surely|always|simply) ?)*$",
                    before,
                ):
                    continue
                return match.group().strip()
        down = re.search(_PUT_DOWN, clause)
        if down is None or is_denied(clause[: down.start()]) or _FORCE_NOUN.search(down.group()):
            continue
        if not _HOLD.search(text[: text.find(down.group())]):
            return down.group().strip()
    return ""


def _stops(text: str) -> str:
    for sentence, _ in sentences(text):
        for pattern in _STOP:
            for match in pattern.finditer(sentence):
                before = re.split(r"[,;]", sentence[: match.start()])[-1]
                earlier = text[: text.find(match.group())] + " " + before
                is_after = _WEAK_STOP.search(match.group()) and (
                    _HOLD.search(earlier) or MARK in earlier
                )
                if is_after:
                    continue  # 'grip it and wait'
                if (
                    not re.search(r"\bto\s*$", before)
                    and not is_denied(before)
                    and not has_manner(sentence[match.end() :])
                ):
                    return match.group().strip()
        if found := prohibition(sentence, text):
            return found
    return ""
