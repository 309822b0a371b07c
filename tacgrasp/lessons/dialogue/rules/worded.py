"""Questions whether what is felt is called so, by words that may be no class of the sensor.

    Is that a star I'm holding?         calculate shape == 'star'.
    My money's on a cube. Did I win?    check shape cuboid.
    Either a ring or a disc, right?     calculate shape in ['ring', 'disc'].
    Neither dotted nor striped, then?   calculate not (texture in ['bumpy', 'ridged']).
    A star or a square?                 choice shape.

A question is read by its clauses: one at least names a shape or a texture, and beside names every
clause has nothing but words that change nothing. Not here: questions that the grammar has
(``tacgrasp.lessons.dialogue.families.classes``).
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

from cltp.tactile.states import CLASSES
from tacgrasp.lessons.dialogue.families.classes.lexicon import Named, named, words_pattern
from tacgrasp.lessons.dialogue.plain_words import plain_words
from tacgrasp.lessons.dialogue.rules.worded_phrases import FILLERS, PHRASES, REMARKS

MOST_CLAUSES = 6
"""Most clauses of a question that is read so. Our choice: longer ones have more to say."""

MOST_NAMED = 5
"""Most words that are asked for at once. Our choice, as of joined questions."""

_CLAUSE = re.compile(r"[.?!;:,()–—]+(?=\s|$)|\s+[-–—]+\s+|[()]")
_ENOUGH = re.compile(
    r"\b(?:either|any) (?:one |of |would|will|counts?|is |works?|does|do|makes?)|"
    r"\bone of <n>|\bone of (?:them|those|these|the|(?:the |those |these )?(?:two|#))\b|\bof the "
    r"following\b|"
    r"\b(?:mind|care) (?:which|either)\b|\bthe same to me\b|"
    r"\byes (?:means?|if|for|when|to)\b|\b(?:take|accept|settle for|be happy with|be fine with)\b|"
    r"\bwould (?:be fine|do|suit)\b"
)
"""One of several words is enough for a yes."""

_ASKS_YES = re.compile(
    r"\b(?:am i|are we|is (?:it|that)(?: not)?) (?:right|correct|true|so)\b|"
    r"\b(?:yes or no|true or false|right or wrong)$|^(?:is it|yes|no|eh|yeah|agreed|y n)$|"
    r"\b(?:right|correct|true)$|^(?:is|are|does|do|"
    r"has|have|can|could|would|did|was)\b"
)
_OWNED = re.compile(r"(?<=\w)'s\b")
_OR_NEITHER = re.compile(r"\bor (?:neither|none)\b")
_OR_NEITHER_END = re.compile(
    r"\bor (?:neither|none)(?: one)?(?: of (?:them|these|those|the(?: two| three)?))?(?= ;|$)"
)
_IS_IT_ONE = re.compile(r"(?:is|was|are) (?:it|this|that|they)(?: (?:one|so after all|after all))?")
_NOT = re.compile(r"\b(?:not|no|neither|nor|never|nothing|without|hardly)\b")
_OTHER_THAN = re.compile(r"\b(?:anything|something|other) (?:but|other than|than)\b|\bother than\b")
_STAKED = re.compile(
    r"\b(?:my|your|our|his|her|their|the|all)(?: \w+)? (?:money|bets?|guess|hunch|wager|vote|"
    r"hopes?|chips|"
    r"savings|shirt|tip)(?:'s| is| was| are| goes| went| would be| would go)?(?: all)?(?: still)?"
    r"(?: on| for)?(?: it (?:being|is))?(?= |$)|"
    r"\b(?:i|we|he|she|they) (?:would |will |have |had )?(?:bets?|put|wagere?d?|gambled?|stake|"
    r"staked|"
    r"going|go|went|plump|plumped|opt|opted|vote|voted|lay)(?: (?:my|some|good|a|all my|the|\w+))?"
    r"(?: (?:money|shirt|house|life|tenner|fiver|coffee|beer|pint|quid|euro|euros|lunch))?(?: on| "
    r"for)"
    r"(?: it (?:being|is)| this being| that being)?(?= |$)"
)
"""Bets on what it is, whose words would say where it is: 'my money is on a star'."""

_SAYS = re.compile(
    r"\b(?:(?:the|my|our|your|his|her|their|a)(?: \w+){1,2}|some(?:body|one)|every(?:body|one)|"
    r"people|they|he|she) (?:says|said|claims|claimed|promised|promises|shows|"
    r"showed|insists|insisted|swears|swore|told (?:me|us)|tells (?:me|us)|calls? (?:it|this|that)|"
    r"called (?:it|this|that)|lists|listed|states|"
    r"stated|reckons|thinks|thought|bets?|guess(?:es|ed)?|expects?|expected|believes?|suspects?|"
    r"describes? it as)(?: that)?(?= |$)"
)
"""Who says what it is: 'the drawing says'."""

_NOT_THE_OTHER = re.compile(
    r"(?<=<n>)(?: \w+)? (?:rather than|instead of|as opposed to|and not|but not) (?:like )?<n>"
)
"""The word that is denied beside another one: 'striped rather than dotted'."""

_PLACED = re.compile(
    r"\b(?:at|near|nearby|by|in|on|from|over|off|past|beyond|beside|(?<!shape )(?<!form "
    r")(?<!outline )"
    r"(?<!figure )(?<!print )(?<!imprint )(?<!mark )(?<!kind )(?<!sort )(?<!type )(?<!tip )"
    r"(?<!pattern )(?<!one )of) <n>|<n> of\b"
)
"""A name that says where it is: 'at the corner', 'a corner of the pad'."""

_OPEN = re.compile(r"^(?:what|which|how|why|where|when|who)\b")
_OR_NOT = re.compile(r" or (?:not|no|nah|nope|what|am i (?:wrong|mistaken)|is it not)$")
_DOUBLED = re.compile(r"\b(?:rather than|instead of|as opposed to|more than|less than|than)\b")


@dataclass(frozen=True, slots=True)
class _Clause:
    """A clause with names: its words, '<n>' for each name, what they name, and the names."""

    words: str
    names: tuple[tuple[Named, ...], ...]
    said: tuple[str, ...]


def worded_query(question: str) -> str:
    """The query of a question for words of the contact; '' of any other question."""
    clauses = []
    parts = [_OWNED.sub(" is", " ".join(plain_words(part))) for part in _CLAUSE.split(question)]
    parts = [part for part in parts if part]
    if not parts or len(parts) > MOST_CLAUSES or "#" in " ".join(parts):
        return ""
    for part in parts:
        if REMARKS.fullmatch(part):
            continue
        clause = _clause(part)
        if clause is None:
            return ""
        clauses.append(clause)
    names = [name for clause in clauses for name in clause.names]
    if not 0 < len(names) <= MOST_NAMED:
        return ""
    return _query(clauses, parts)


def _clause(words: str) -> _Clause | None:
    """A clause that names something and has nothing else to say; None of others."""
    words = _SAYS.sub("", _STAKED.sub("", _OR_NOT.sub("", words))).strip()
    bare = words_pattern().sub(lambda match: _kept(match[0], "<n>"), words)
    found = list(words_pattern().finditer(words))
    while shorter := _NOT_THE_OTHER.search(bare):
        found.pop(bare[: shorter.end()].count("<n>") - 1)
        bare = f"{bare[: shorter.start()]}{bare[shorter.end() :]}"
    rest = _OTHER_THAN.sub("", PHRASES.sub("", bare)).split()
    if not found or _DOUBLED.search(_OTHER_THAN.sub("", bare)) or _PLACED.search(bare):
        return None
    if _OPEN.match(bare) and " or " not in bare:
        return None
    if any(word not in FILLERS and word != "<n>" for word in rest):
        return None
    said = tuple(match[1] for match in found)
    return _Clause(bare, tuple(named(each) for each in said), said)


def _kept(text: str, name: str) -> str:
    """What stands for a name: 'no' before it stays."""
    return f"no {name}" if text.startswith("no ") else name


def _query(clauses: Sequence[_Clause], parts: Sequence[str]) -> str:
    """The query of clauses with names.

    Args:
        clauses: The clauses with names.
        parts: The plain words of all clauses.
    """
    words = " ; ".join(clause.words for clause in clauses)
    names = [name for clause in clauses for name in clause.names]
    every = [each for name in names for each in name]
    words = _OR_NEITHER_END.sub("or", words)
    denials = len(_NOT.findall(words)) + len(_OTHER_THAN.findall(words))
    if any(_IS_IT_ONE.fullmatch(part) for part in parts):
        denials = 0  # 'it is not a ring, I bet. Is it one?'
    if re.search(r"\bneither\b.*<n>.*\bnor\b", words):
        return _checked(every, is_denied=True)
    if len(set(names)) == 1:
        if words.endswith(" or"):
            return ""
        return "" if denials > 1 else _checked(names[0], is_denied=denials == 1)
    if len(re.findall(r"\b(?:not|no) <n>", words)) == denials == len(names):
        return _checked(every, is_denied=True)  # 'not a ring, not a disc either'
    is_enough = any(_ENOUGH.search(part) for part in (*parts, *words.split(" ; ")))
    is_either = is_enough or re.search(r"\bor\b", words) is not None
    is_either = is_either and re.search(r"\band\b", words) is None
    if not is_either or denials > 1:
        return ""
    if denials == 1:
        return _checked(every, is_denied=True)
    asks_yes = any(_ASKS_YES.search(part) for part in parts) and re.search(r"\beither\b", words)
    if is_enough or asks_yes:
        return _checked(every, is_denied=False)
    if any(_OR_NEITHER.search(part) for part in parts):
        return _or_neither([word for clause in clauses for word in clause.said])
    dimensions = {each.dimension for each in every}
    return f"choice {dimensions.pop()}." if len(dimensions) == 1 else ""


def _or_neither(words: Sequence[str]) -> str:
    """Which of some words is so, or 'neither'."""
    tests = []
    for word in words:
        (name, *others) = named(word)
        if others or len(name.classes) > 1:
            return ""
        tests.append(f"{word!r} if {name.dimension} == {name.classes[0]!r}")
    return f"calculate {' else '.join(tests)} else 'neither'."


def _checked(names: Sequence[Named], *, is_denied: bool) -> str:
    """The query whether one of some names is so, or none of them."""
    classes: dict[str, list[str]] = {}
    for name in names:
        classes.setdefault(name.dimension, []).extend(name.classes)
    told = {name: list(dict.fromkeys(each)) for name, each in classes.items()}
    tests = [
        f"{name} == {each[0]!r}" if len(each) == 1 else f"{name} in {each}"
        for name, each in told.items()
    ]
    test = " or ".join(tests)
    dimension, each = next(iter(told.items()))
    if len(told) == len(each) == 1 and each[0] in CLASSES[dimension]:
        return f"check {'not ' if is_denied else ''}{dimension} {each[0]}."
    if is_denied:
        return f"calculate not ({test})."
    return f"calculate {test}."
