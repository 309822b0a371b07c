"""Words of clauses: those that change nothing, and names of things that nobody foresees.

Not here: what the words of a clause mean (``tacgrasp.lessons.dialogue.clauses.comparing``,
``tacgrasp.lessons.dialogue.clauses.states``).
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from tacgrasp.lessons.dialogue.clauses.class_names import is_class_named
from tacgrasp.lessons.dialogue.clauses.word_sets import words_of

FILLERS = words_of(
    "is are was were be been being am it this that these those there here we us you i he she they "
    "them me my our your his her their its the a an of by with at in on to for from as do does did "
    "doing has have had having can could will would shall should may might must currently current "
    "now still already presently present momentary actual actually really just yet even also then "
    "so moment overall any some all one robot gripper finger fingers jaw jaws hand hands machine "
    "arm object thing item part piece workpiece sample specimen load berry fruit touch indeed "
    "please ever who total today time least only together s t ok okay surely truly certainly "
    "clearly definitely get gets got getting going go goes gone come comes came let make makes "
    "made making keep keeps kept keeping stay stays stayed staying remain remains remained lie "
    "lies lying lay sit sits sitting stand stands standing run runs running into onto like up out "
    "using use used seem seems appear appears end ends big deal"
)
"""Words that change nothing in a clause whose marks are there."""

BLOCKED = words_of(
    "temperature speed width diameter height length thickness radius friction shear torque drag "
    "roughness stiffness hardness tension voltage current wall gap size weight volume density "
    "angle velocity time duration pulse age price distance limit band range window goal target "
    "ceiling maximum minimum middle center edge border rim half quarter third percent twice double "
    "and or but not never no nor neither either than more less most least over under above below "
    "before after if unless when while because only until since except without between both each "
    "every other another same different what which who whose how why where any x y first second "
    "last palm fingertip tip side corner sides corners stripe stripes upper lower left right top "
    "bottom rather instead versus against"
)
"""Words that are no mere name of a thing."""

_HANDLED = words_of(
    "on onto squeezing squeeze gripping grip pressing press holding hold pinching pinch clamping "
    "crushing squashing with into upon of for to touching covering pushing hugging giving around "
    "under put putting is are was were does do did has have can may must will"
)
"""What a thing's name may stand behind: 'putting on the bun', 'does the bun touch'."""

_DETERMINERS = words_of("the this that these those my our your his her their a an some")

NEGATIONS = frozenset({"not", "never", "no", "nothing", "none", "nor", "neither", "without"})


_AT_LEAST = re.compile(r"\bat least(?! (?:one|two|three|half|#))")


def all_known(words: Sequence[str], known: frozenset[str], *, may_name: bool = True) -> bool:
    """Whether every word is known, or is the name of some thing.

    Args:
        words: The words of a clause.
        known: Words that its meaning knows, beside those that change nothing.
        may_name: Whether a thing may have a name that nobody foresees: 'the bun'.
    """
    if "least" not in known and _AT_LEAST.search(" ".join(words)):
        return False  # 'at least deep' is not 'deep'
    named = set(_names(words, known)) if may_name else set()
    return all(
        word in known or word in FILLERS or place in named for place, word in enumerate(words)
    )


def _names(words: Sequence[str], known: frozenset[str]) -> Iterator[int]:
    """Places of the words of names: at most three behind 'the', where a thing may be spoken of."""
    for place, word in enumerate(words):
        if word not in _DETERMINERS or (place and words[place - 1] not in _HANDLED):
            continue
        for after in range(place + 1, min(place + 4, len(words))):
            if words[after] in known or words[after] in FILLERS or not _is_name(words[after]):
                break
            yield after


def _is_name(word: str) -> bool:
    """Whether a word may be the name of a thing: it has no meaning of its own here."""
    return (
        word not in BLOCKED
        and re.fullmatch(r"[a-z]{3,}", word) is not None
        and not is_class_named(word)
    )
