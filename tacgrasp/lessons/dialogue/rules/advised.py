"""Questions whether a certain step is the one that is advised.

    Would you advise lifting now?                       action == 'lift'
    Is the next step a move of some sort?               action in ['move_up', 'move_down', ...]
    Does your advice involve shifting sideways?         action in ['move_left', 'move_right']
    Hold, lift or something else?                       the first two, or 'something else'

Not here: what is advised, and why (``tacgrasp.lessons.dialogue.families``).
"""

from __future__ import annotations

import re
from collections.abc import Iterable

from primitives import Primitive
from tacgrasp.lessons.dialogue.meaning import Calculated
from tacgrasp.lessons.dialogue.plainer import AUXILIARY
from tacgrasp.lessons.dialogue.scene import HOLD, LIFT

_UP, _DOWN, _LEFT, _RIGHT = (
    Primitive.MOVE_UP.value,
    Primitive.MOVE_DOWN.value,
    Primitive.MOVE_LEFT.value,
    Primitive.MOVE_RIGHT.value,
)
_MOVE = (
    r"(?:mov(?:e|es|ed|ing|ement)|shifted|shift(?:s|ing)?|slid(?:e|es|ing)|translat(?:e|ion|ing)|"
    r"re-?position(?:ing)?|re-?cent(?:er|re|ring|ering)|nudg(?:e|es|ing)|go(?:ing)?)"
)
_GRIP = r"(?:grip|squeeze|press|push|pinch|hold|clamp|grasp)(?:p?ing)?"
_FIRMER = r"(?:harder|tighter|firmer|stronger|more(?: (?:force|firmly|strongly|tightly))?)"
_SOFTER = r"(?:softer|looser|lighter|gentler|less(?: (?:force|firmly|strongly|tightly|hard))?)"
_STEPS: tuple[tuple[re.Pattern[str], tuple[str, ...]], ...] = tuple(
    (re.compile(rf"\b(?:{pattern})\b"), actions)
    for pattern, actions in (
        (
            r"sideways,? (?:or )?up,? (?:or )?down|up,? down,? left,? or right|(?:any|whatever|"
            r"some) direction|one of the (?:four|4) moves",
            (_UP, _DOWN, _LEFT, _RIGHT),
        ),
        (
            r"chang(?:e|es|ing)(?: of| in)?(?: the)? force|force change|(?:raise|raising) or "
            r"lower(?:ing)?",
            (Primitive.INCREASE_FORCE.value, Primitive.DECREASE_FORCE.value),
        ),
        (
            rf"sideways|side to side|horizontally|left or right|{_MOVE} (?:to the )?(?:left or "
            r"(?:to the )?right|right or (?:to the )?left)",
            (_LEFT, _RIGHT),
        ),
        (rf"vertically|up or down|lengthways?|{_MOVE} (?:down or up)", (_UP, _DOWN)),
        (rf"{_MOVE} (?:\w+ ){{0,3}}(?:to the )?left|to the left", (_LEFT,)),
        (rf"{_MOVE} (?:\w+ ){{0,3}}(?:to the )?right|to the right", (_RIGHT,)),
        (rf"{_MOVE} (?:\w+ ){{0,3}}(?:up|upwards?|palm)|up(?:wards?)?$", (_UP,)),
        (rf"{_MOVE} (?:\w+ ){{0,3}}(?:down|downwards?|fingertip)|down(?:wards?)?$", (_DOWN,)),
        (
            rf"{_GRIP} (?:\w+ ){{0,2}}{_FIRMER}|(?:increas|rais)(?:e|ing)|"
            rf"tighten(?:ing)?|{_FIRMER}",
            (Primitive.INCREASE_FORCE.value,),
        ),
        (
            rf"{_GRIP} (?:\w+ ){{0,2}}{_SOFTER}|(?:decreas|reduc)(?:e|ing)|lower(?:ing)?(?: the "
            rf"force)?|loosen(?:ing)?|eas(?:e|ing) off|back(?:ing)? off|{_SOFTER}",
            (Primitive.DECREASE_FORCE.value,),
        ),
        (
            r"(?:start|starting|begin|beginning|try|trying|grasp|grasping|grip|gripping) "
            r"(?:over|again|anew|afresh)|re-?grasp(?:ing)?|re-?grip(?:ping)?|reset(?:ting)?|"
            r"let(?:ting)? (?:it )?go|open(?:ing)? (?:up|the (?:gripper|fingers|hand))|"
            r"releas(?:e|ing)",
            (Primitive.RESET.value,),
        ),
        (r"lift(?:ing)?|pick(?:ing)?(?: it)? up|rais(?:e|ing) it|hoist(?:ing)?", (LIFT,)),
        (
            r"hold(?:ing)?(?: still)?|stay(?:ing)?(?: put)?|wait(?:ing)?|do(?:ing)? nothing|"
            r"keep(?:ing)? still|leav(?:e|ing) it",
            (HOLD,),
        ),
        (_MOVE, (_UP, _DOWN, _LEFT, _RIGHT)),
    )
)
"""Words of steps, and the values of ``action`` that they mean; the first that fits counts."""

_ADVICE = re.compile(
    r"\b(?:advi[sc]e[ds]?|advising|recommend\w*|suggest\w*|proposed?|your (?:tip|counsel|verdict)|"
    r"next (?:step|move|action|command)|would(?:n['’]?t)? you (?=move|shift|reset|start|let)|want "
    r"(?:me|us|it|the \w+) (?:to )?|tell(?:ing)? me to|have me(?: do)?|what you(?:['’]d| would) "
    r"(?:do|have me do|pick|choose|try)(?: now| next)?|(?:do i )?take it(?: "
    r"that)? you want|(?:system|policy|robot|controller)(?: now)? (?:call|calls|ask|asks|want|"
    r"wants)(?: for)?|policy output|call for)\b"
)
_ASKS_YES = re.compile(rf"{AUXILIARY}(?:n['’]?t)?\b")
_DENIED = re.compile(
    r"\b(?:not|n['’]t|never|isn['’]?t|don['’]?t|doesn['’]?t|against|other than|anything but|but)\b"
)
_IN_QUESTION = re.compile(rf"^{AUXILIARY}n['’]?t\b")
_ELSE = r"(?:something (?:else|different|other)|neither(?: of them)?|other|another (?:one|step))"
_CHOICE = re.compile(
    rf"(?P<first>[a-z ]+?)(?:,| or) (?P<second>[a-z ]+?),? or (?P<else>{_ELSE})"
    r"(?:[ ,:–-]+(?:pick|choose|which|what|say|one|is it|next|now).*)?[?.! ]*"
)


def step_condition(words: str) -> str:
    """The condition that a step which some words name is advised; '' where they name none."""
    for pattern, actions in _STEPS:
        if pattern.search(words):
            if len(actions) == 1:
                return f"action == '{actions[0]}'"
            return f"action in [{', '.join(repr(each) for each in actions)}]"
    return ""


def is_step_advised(question: str) -> Calculated | None:
    """Whether the step that a question names is advised, by its words alone; None of others."""
    words = question.lower().strip(" ?.!")
    if re.search(r"\d|\bwhy\b|\bif\b|\bbecause\b", words):
        return None
    condition = step_condition(_ADVICE.sub(" ", words))
    if not condition:
        return None
    is_denied = _DENIED.search(words) and not _IN_QUESTION.match(words)
    return Calculated(truth=f"not ({condition})" if is_denied else condition, unit=None)


def advised(question: str) -> Calculated | None:
    """What a question asks of the advice: yes or no, or one of two steps; None of others."""
    words = question.lower().strip()
    words = _STATED.sub(r"is \g<what>", words)
    words = _EQUALS.sub("is the next step ", words)
    if _ASKS_YES.match(words) and _ADVICE.search(words) and " or no" not in words:
        return is_step_advised(words)
    if ways := _ways(words) or _choice_of_steps(words):
        return ways
    if (found := _CHOICE.fullmatch(words)) is None:
        return None
    first, second = (_one_of(found[name]) for name in ("first", "second"))
    if not first or not second:
        return None
    told = (found["first"].strip(), first), (found["second"].strip(), second)
    return _first_of(told, found["else"])


_WAYS = re.compile(
    r"(?=.*\b(?:next|now|should|must|advise\w*|recommend\w*|travel|move|moved|shift|shifted|go)\b)"
    r".*?\b(?P<a>left|right|up|down),? (?P<b>left|right|up|down),? (?P<c>left|right|up|down),? "
    r"(?:or )?(?P<d>left|right|up|down)(?:,? or (?P<none>[a-z ]+?))?(?: next| now)?[?.! ]*"
)
_BY_WORD = {"left": _LEFT, "right": _RIGHT, "up": _UP, "down": _DOWN}


def _ways(words: str) -> Calculated | None:
    """The way to move, of all four: 'left, right, up, down or nowhere?'."""
    found = _WAYS.fullmatch(words)
    named = [found[name] for name in "abcd"] if found else []
    if found is None or len(set(named)) < len(_BY_WORD):
        return None
    none = found["none"] or "none"
    return _first_of(((way, f"action == '{_BY_WORD[way]}'") for way in named), none)


_LEADS = re.compile(
    r"^(?:(?:and|so|then|ok)[, ]+)*(?:(?:as to |going by |for )?(?:your|the|my) )?(?:next (?:step|"
    r"move|action|command)|advice|recommendation|what next)[:,–—-]+ ?|^(?:if it (?:was|were) your "
    r"turn(?: now)?|going by your advice|next)[, ]+"
)
MOST_CHOICE = 16
"""Longest choice of steps that is read before anything else [words]. Our choice."""

_ASKS_STEP = re.compile(
    r"^(?:(?:are|is) (?:we|it) to|should (?:i|we|it|the \w+)|would you(?: have (?:me|us))?|do you "
    r"want (?:me|us) to|(?:shall|must) (?:i|we)|which do you want from me next:?|do (?:i|we)) "
)
_ASKED_BEHIND = re.compile(
    r"[ ,:–—-]+(?:(?:what|which(?: one)?) (?:do|would|is|are) (?:you|your).*|pick (?:one|1)|"
    r"which(?: one)?|what now|next|now)[?.! ]*$"
)
_LEFT_ALONE = re.compile(
    r"(?:(?:leave|keep) (?:it|the \w+)(?: as it is| alone| be)?|neither(?: of (?:them|these))?|"
    r"none|nothing|(?:do )?something (?:else|different|other)|a different (?:one|command|step)|"
    r"another (?:one|step|command)|not(?: yet)?|nowhere|stay(?: put| where (?:i am|it is|we "
    r"are))?|wait|other)"
)


def _choice_of_steps(words: str) -> Calculated | None:
    """Which of some steps is advised, or none of them: 'tighten, loosen or leave it?'."""
    lead = _LEADS.match(words)
    rest = words[lead.end() :] if lead else words
    asks = _ASKS_STEP.match(rest)
    behind = _ASKED_BEHIND.search(rest)
    is_bare = (
        re.fullmatch(r"(?:lift|hold)(?: it)?(?: now)? or (?!not[?.! ]*$)[a-z ]+[?.! ]*", words)
        is not None
    )
    if not (lead or asks or is_bare or (behind and _ADVICE.search(words))):
        return None
    rest = rest[asks.end() if asks else 0 : behind.start() if behind else len(rest)]
    parts = [part.strip(" ?.!") for part in re.split(r",? or |, ", rest)]
    told, none = [], ""
    for part in parts:
        if _LEFT_ALONE.fullmatch(part) and part == parts[-1]:
            none = part
        elif condition := _one_of(part):
            told.append((part, condition))
        else:
            return None
    return _first_of(told, none) if told and none else None


def _first_of(told: Iterable[tuple[str, str]], none: str) -> Calculated:
    """The word of the first condition that holds, or the word for none of them."""
    branches = " else ".join(f"'{word}' if {condition}" for word, condition in told)
    return Calculated(truth=f"{branches} else '{none}'", unit=None)


def step_asked(question: str) -> Calculated | None:
    """Whether to move, or to begin again: 'should I shift it?'; None of other questions."""
    words = question.lower().strip()
    if (
        " or " in words
        and len(words.split()) <= MOST_CHOICE
        and (chosen := _choice_of_steps(words))
    ):
        return chosen
    if not _SHOULD.match(words) or re.search(r"\bor\b|\d|\bif\b|\bwhy\b", words):
        return None
    condition = step_condition(_SHOULD.sub("", words))
    is_step = "reset" in condition or ("move_" in condition and bool(_MOVES.search(words)))
    is_step = is_step or ("force" in condition and bool(_NEXT.search(words)))
    return Calculated(truth=condition, unit=None) if is_step else None


_EQUALS = re.compile(r"^(?:the )?(?:next (?:step|move|action)|policy output) (?:=|is|:) ?")
_STATED = re.compile(r"^(?:so )?(?P<what>(?:your|the) (?:advice|recommendation|tip) is) ")
_MOVES = re.compile(rf"\b{_MOVE}\b")
_NEXT = re.compile(r"\b(?:next|as a next step|first)$")
"""'Should I squeeze harder next?' asks for the advice, without 'next' for the band."""
_SHOULD = re.compile(
    r"(?:and |so |then )*(?:(?:should|shall|must|do|does|need) (?:i|we|it|the "
    r"(?:gripper|robot|hand|finger))(?: (?:have|need|ought) to)?|do you (?:have|need) to) (?:be )?"
)


def _one_of(words: str) -> str:
    """The condition of a step that some words name and nothing else; '' of others."""
    bare = re.sub(r"\b(?:now|it|the (?:force|grip|squeeze))\b", "", words).strip()
    whole = next((p for p, _ in _STEPS if p.fullmatch(bare)), None)
    return step_condition(bare) if whole else ""
