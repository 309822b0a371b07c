"""How a text asks to grip: softer or firmer than the task, by its words and their denials."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, replace

from policies.instructions.english import words
from policies.instructions.english.denials import FORBIDDEN_AFTER
from policies.instructions.english.text import CLAUSE, sentences


@dataclass(frozen=True, slots=True, kw_only=True)
class Cue:
    """One word or phrase of manner.

    Attributes:
        sign: -1 softer, +1 firmer, denials counted.
        level: 2 says how to grip, 1 gives a reason for it.
        strong: Whether it is said with emphasis ('very', 'as ... as').
        words: The words, with their denial.
        turned: Whether a denial turned its sign.
    """

    sign: int
    level: int
    strong: bool
    words: str
    turned: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class Manner:
    """Manner of a whole text.

    Attributes:
        sign: -1 softer, +1 firmer, 0 as the task.
        strong: Whether with emphasis.
        words: The words that say so.
        conflict: Words of both directions, where neither outranks the other; '' otherwise.
    """

    sign: int
    strong: bool = False
    words: str = ""
    conflict: str = ""


_TABLES: tuple[tuple[str, int, int, bool], ...] = (
    ("soft_reason_first", -1, 1, False),
    ("firm_reason_first", +1, 1, False),
    ("soft_object", -1, 1, True),
    ("firm_object", +1, 1, True),
    ("soft", -1, 2, True),
    ("firm", +1, 2, True),
    ("like_something", -1, 1, True),
    ("soft_reason", -1, 1, True),
    ("firm_reason_slip", +1, 1, False),
    ("firm_reason_secure", +1, 1, True),
    ("firm_reason_shaken", +1, 1, False),
    ("firm_reason", +1, 1, True),
    ("soft_reason_harm", -1, 1, False),
)
"""Sections of words with sign, level, and whether a denial turns them. The first match takes its
words out, so the order matters."""

_COMPILED = [
    (sign, level, turns, pattern)
    for section, sign, level, turns in _TABLES
    for pattern in words.groups(section)
]
_NEUTRAL = words.groups("neutral")
_DENIAL = re.compile(rf"\b{words.any_of('denial')}\b")
_VERY = re.compile(rf"\b{words.any_of('very')}\b")
_TOO = re.compile(
    r"\b(not|never|nothing|none|without|avoid\w*|nor|stop|no|forbidden|forbid|prohibited|refuse|refrain from|keep from)\b((?: \w+){0,4}?) (?:too|over|overly|excessive(?:ly)?|unnecessarily)\b"
)
_TOO_FORBIDDEN = re.compile(rf"\b(?:too|overly) (?=\w+[^,;.]{{0,30}} {FORBIDDEN_AFTER})")
"""'Too hard is forbidden' forbids what is too hard."""
_NEVER_TOO = re.compile(
    r"\b(?:can|could) (?:not|never|hardly)((?: \w+){0,4}?) (?:too|over(?:ly)?)\b"
)
_MILDLY = re.compile(
    r"\b((\w{4,}?)(?:ly|le)?),? (?:but|though|yet|and)(?: please)? (?:not|never)(?: hold it| grip it)? (?:too|over(?:ly)?) \2(?:ly|le)?\b"
)
"""'Firm, but not too firm' is firm."""
_JUST_ENOUGH = re.compile(
    r"\b(?!just)(\w{4,}?)(?:ly)? enough\b([^.;]*?),? (?:but |and |yet )?(?:no|not)(?: any| a bit)? (?:\1e?r|more)\b"
)
"""'Tight enough that it stays, but not tighter' is just enough."""
_TOO_FOR = re.compile(
    r"(?<!grip)(?<!hold)(?<!force)(?<!squeeze)(?<!pressure)(?<!that)(?<!this)(?P<is> (?:is|are|looks|seems|feels|was|be) (?:\w+ )?|^|(?<=[,;:] ))too (?P<what>\w+) (?:for|to)\b(?P<rest>[^,;]*)"
)
"""'Too delicate to grip hard': it is delicate, and not to be gripped hard."""
_NOT_YOU = re.compile(r"\b(can|could|will|would|should) not (?=you|we)\b")
"""'Can't you hold it gently?' denies nothing."""
_RATHER = re.compile(
    r"\b(?:rather|better|sooner|prefer\w*)\b(?: \w+)*? (?:too )?(?!little\b|much\b)(\w+) than (?:too |be |being )?(?!usual|normal|before|last|that|this|it\b|standard|the\b|you)\w+"
)
_RATHER_THIS = re.compile(
    r"\b((?:rather|better|sooner|prefer\w*)\b[^.;,#]{0,40}?) (?:than|to|over) (?:an? |any )(?!usual|normal|standard)\w+ (?:one|grip|hold|touch|squeeze|grasp|hand)\b"
)
"""'I'd rather have a slack hold than a hard one.'"""
_SETTING = re.compile(r"\b(force|grip|strength|pressure|power|squeeze) ?[:=] ?(?=[a-z])")
"""'Strength: low'."""
_LESSER_EVIL = re.compile(
    r"\b(?:rather|better|sooner|prefer\w*)\b(?: \w+){0,4}? "
    r"(?:(?:bruise|squash|squish|damage|dent|mark|drop|lose)(?: (?:it|one|the \w+))?"
    r"|(?:bruis|squash|squish|damag|dent|mark|dropp)ed|hurt|lost|fallen|slipped) than "
)
"""'Better bruised than dropped' fears the drop."""
_WOULD_NOT_MIND = re.compile(
    r"\b(?:would|should|could|do) not (?:mind|object|be (?:unhappy|sorry|upset|sad|angry|opposed|against it))\b(?: if| to)? ?"
)
"""'I wouldn't mind if you held it tighter' denies nothing."""
_THAN_TOO = re.compile(
    r"\b(?:rather|better|sooner|prefer\w*)(?: \w+){0,4}? too (?:(?P<little>little|low|light|weak)|much|high|strong|hard)"
    r"(?: (?:force|pressure|grip|squeeze|strength))? than too (?:much|high|strong|hard|little|low|light|weak)\b"
)
"""'Rather too little pressure than too much'."""
_DENIED_AFTER = re.compile(
    rf"^(?:(?!\b(?:and|but|so|because|since|it|they|i|we|you)\b)[^,;]){{0,40}}?\b(?:{FORBIDDEN_AFTER}|(?:is|are) (?:not|no longer|wrong|out\b|useless|forbidden|unnecessary|overrated|the wrong|a mistake|for)|"
    r"(?:is|are) (?:no (?:use|good|help)|not)|will not (?:do|cut|work|help|suffice|be)|does not (?:work|help|cut|do)|never (?:works|helps)|(?:is|are) never)"
)
_COMPLAINT = re.compile(
    r"\b(?:grip|hold|grasp|squeeze|touch|force|pressure|you|fingers)(?: (?!what|which|that\b)\w+){0,1} (?:is|was|feels|seems|are|were|felt|looks)(?: (?!to|not)\w+){0,2} $"
)
_BREAK = re.compile(
    rf"\b(?:and|so) (?=(?:please |just |then |only |really )?(?:{words.any_of('hold')}|be|use|go|ease|make|mind|watch|do|try|give|that|get|stay)\b)"
)
_AS_BEFORE = re.compile(
    r"^\w* as (?:it |they |that )?(?:is |was |were )?(?:usual|normal|always|ever|before|last|the last|the previous|yesterday|"
    r"you (?:usually|normally|always|did|do|were|need|must|have to)|needed|necessary|required|need be|it (?:takes|needs|was|has to))\b"
)
"""After 'as hard': as the task has it."""

_CORRECTED = re.compile(
    rf"\b(?:no,? wait|wait,? no|{words.any_of('correction')}|(?:oh|hmm+|ah),? no|(?<=[,.;!] )sorry(?=[,:.]))\b[ ,:.…!-]*"
)
_AS_USUAL = re.compile(
    r"\b(?:normal(?:ly)?|usual(?:ly)?|ordinary|ordinarily|regular(?:ly)?|medium|default|standard)\b|\b(?:as|like) (?:always|ever)\b|\balways do\b"
)

_COMPARES = re.compile(
    rf"(?:\b(?:than|of|above|below|over|under|beyond|instead of|not|reduce|increase|lower|raise|cut|decrease|change|drop|forget|skip|ditch|no)|\b(?:{words.any_of('firm_word')}|{words.any_of('soft_word')}|much|careful\w*|delicate\w*) as)(?: (?:the|your|you|is|it|we|i|what))*\s*$"
)
"""Before 'usual': 'not as gentle as usual'."""
_AS_EVER = re.compile(r"\b(?:as|like) (?:usual|always|ever|normal)\b")
"""Beside a reason it says no force: 'be careful, as always'."""
_OF_GRIP = re.compile(
    r"(?! \w+ (?:is|was|seems|feels) (?:far |way |much )?(?:too|not|never|no)\b)"
    r"(?:\W*$|\s*[,.;:!?]| (?:grip|grasp|hold|force|pressure|squeeze|way|manner|strength|touch|procedure|will|is|would|does|please|and|but)\b)"
)
"""Behind 'usual': no 'usual tray'."""

_REACH = 60
"""Characters before a cue in which a denial turns it. Our choice: about ten words."""


def read_manner(text: str) -> Manner:
    """Manner of a plain text whose quantities have been replaced.

    What is taken back ('hard, no wait, softly') does not count.
    """
    said, *corrected = _CORRECTED.split(text)
    if corrected and has_manner(said):
        if _says_manner(corrected[-1]) or read_manner(corrected[-1]).sign < 0:
            return read_manner(corrected[-1])
        if not re.search(r"\w", corrected[-1]):
            return Manner(sign=0, words=text.strip())  # 'hard. whoops'
    text = ", ".join((said, *corrected))
    cues = [cue for sentence, asks in sentences(text) for cue in _cues(sentence, asks)]
    for level in (2, 1):
        found = [cue for cue in cues if cue.level == level]
        signs = {cue.sign for cue in found}
        is_denied = all(cue.turned for cue in found)
        if found and (
            (is_denied and _asks_usual(text))
            or (level == 1 and _asks_usual(_AS_EVER.sub("", text)))  # a reason is less than a wish
        ):
            return Manner(sign=0, words=", ".join(cue.words for cue in found))
        if len(signs) == 1:
            sign = signs.pop()
            said = ", ".join(dict.fromkeys(cue.words for cue in found))
            return Manner(sign=sign, strong=any(cue.strong for cue in found), words=said)
        if len(signs) == 2:
            said = " and ".join(dict.fromkeys(cue.words for cue in found))
            is_between = all(cue.turned for cue in found)  # 'not too hard, not too soft'
            is_conflict = level == 2 and not is_between
            return Manner(sign=0, words=said, conflict=said if is_conflict else "")
    return Manner(sign=0)


def _asks_usual(text: str) -> bool:
    """Whether a text asks for the usual grip, and compares none with it."""
    return any(
        _OF_GRIP.match(text[match.end() :]) and not _COMPARES.search(text[: match.start()])
        for match in _AS_USUAL.finditer(text)
    )


def _says_manner(text: str) -> bool:
    return has_manner(text) or _AS_USUAL.search(text) is not None


def has_manner(clause: str) -> bool:
    """Whether a clause of a plain text says how to grip."""
    return any(cue.level == 2 for cue in _clause_cues(clause))


def without_neutral(text: str) -> str:
    """A text without phrases whose words of manner or denial mean none."""
    for pattern in _NEUTRAL:
        text = pattern.sub(" ", text)
    return text


def _cues(sentence: str, asks: bool) -> Iterator[Cue]:
    if asks and re.match(r"^(?:and )?(?:i said|did i say|who said|you said)\b", sentence):
        return
    sentence = _NOT_YOU.sub(r"\1 ", without_neutral(sentence))
    sentence = _JUST_ENOUGH.sub(r"just enough\2", _MILDLY.sub(r"\1", sentence))
    sentence = _WOULD_NOT_MIND.sub("like ", sentence)
    sentence = _THAN_TOO.sub(lambda said: " gently " if said["little"] else " firmly ", sentence)
    sentence = _NEVER_TOO.sub(r"\1 ", sentence)
    sentence = _RATHER_THIS.sub(r"\1", _LESSER_EVIL.sub(" not ", sentence))
    sentence = _RATHER.sub(r" \1 ", sentence)
    sentence = _too_for(_SETTING.sub(r"\1 ", sentence))
    sentence = _TOO_FORBIDDEN.sub("", _TOO.sub(r"\1\2", sentence))
    for part in CLAUSE.split(sentence):
        for clause in _BREAK.split(part):
            for cue in _clause_cues(" ".join(clause.split())):
                is_complaint = asks and re.match(
                    r"(?:and )?(?:why|must you|do you (?:have to|need to))\b", sentence
                )
                yield replace(cue, sign=-cue.sign, turned=True) if is_complaint else cue


def _too_for(sentence: str) -> str:
    match = _TOO_FOR.search(sentence)
    if match is None or not has_manner(match["rest"]):
        return sentence
    rest = re.sub(r"\btoo ", "", match["rest"])
    return f"{sentence[: match.start()]}{match['is']}{match['what']}, not{rest}{sentence[match.end() :]}"


def _clause_cues(clause: str) -> Iterator[Cue]:
    masked = clause
    found: list[tuple[int, int, int, int, bool]] = []
    for sign, level, turns, pattern in _COMPILED:
        for match in pattern.finditer(masked):
            if match.group().strip():
                found.append((match.start(), match.end(), sign, level, turns))
        masked = pattern.sub(lambda match: "~" * len(match.group()), masked)
    denied = 0  # the sign of the cue before, where a denial turned it
    for start, end, sign, level, turns in sorted(found):
        before = masked[max(0, start - _REACH) : start]
        after_and = before.rpartition(" and ")[2]
        is_wish = denied == -sign  # 'without rough grips and with soft ones'
        before = after_and if is_wish or _DENIAL.search(after_and) else before
        denials = list(_DENIAL.finditer(before)) if turns else []
        if not denials and before.endswith("as ") and _AS_BEFORE.match(clause[end:]):
            continue
        turned = len(denials) % 2 == 1
        if turns and not denials and _COMPLAINT.search(masked[:start]):
            turned = True
        if turns and _DENIED_AFTER.match(masked[end:]) and "~" not in masked[end : end + 3]:
            turned = not turned
        denied = sign if turned and denials else 0
        begin = start - len(before) + denials[0].start() if denials else start
        near = clause[max(0, start - 22) : end + 12]
        yield Cue(
            sign=-sign if turned else sign,
            level=level,
            strong=bool(_VERY.search(near)) and not turned,
            words=clause[begin:end].strip(),
            turned=turned,
        )
