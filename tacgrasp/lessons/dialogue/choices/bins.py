"""Questions that say for which values each of their own words stands.

    Call it light below 1 N, medium up to 3 N, else heavy.   'light' if force_n < 1 else ...
    If anything under 2 N is gentle and the rest firm, which one is it?
    With 0.8 mm as the dividing line, is it deep or shallow?
    Into which range does the force fall: 0-2 N, 2-5 N or over 5 N?

A value that none of the words stands for is neither.

Not here: words of a scale without values of their own (``tacgrasp.lessons.dialogue.choices``).
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

from tacgrasp.lessons.dialogue.calculations.asked import (
    AskedWords,
    asked_words,
    usual,
    usual_unit,
)
from tacgrasp.lessons.dialogue.calculations.quantity_names import UNIT
from tacgrasp.lessons.dialogue.calculations.terms import UNSAID, Term, alike
from tacgrasp.lessons.dialogue.choices.conditions import NEITHER, choice_of
from tacgrasp.lessons.dialogue.expression import Expression

_BELOW = (
    r"under|below|less than|smaller than|lower than|lighter than|beneath|fewer than|"
    r"shallower than|short of"
)
_UP_TO = (
    r"(?:from (?:there|that|then) (?:on )?)?up to(?: and including)?|from (?:there|"
    r"that)(?: on)? to|"
    r"at most|no more than|not more than|not above|until|till"
)
_ABOVE = (
    r"over|above|more than|greater than|beyond|past|exceeding|higher than|larger than|deeper than|"
    r"heavier than|in excess of"
)
_FROM = r"from|at least|no less than|upwards? of|starting (?:at|from)"
_HEAD = (
    r"(?:(?:for|an?|the|if|when|where|is|are|being|means?|meaning|as|at|with|anything|everything|"
    r"all|whatever|what|it|that|they|of|values?|forces?|depths?|areas?|masses|weights?|readings?|"
    r"takes?|those|dent|contact|parts?|things?|objects?|items?|pieces?|grips?|indentations?|dents?|prints?|patches|presses|"
    r"contacts?) )*?"
)
_REST = (
    r"(?:(?:anything|everything|all|whatever is|what is|any|something) )?(?:(?:beyond|above|over|"
    r"below|under|less than|more than) (?:that|this|it)|otherwise|else|(?:any )?more(?: than that)?"
    r"|less(?: than that)?|(?:the )?(?:rest|remainder|others?)|in between|between(?: (?:those|them|"
    r"these))?|remaining|beyond|above|below|"
    r"higher|lower|deeper|heavier|lighter|larger|smaller)(?: (?:that|it))?"
)
_VALUES = (
    rf"{_HEAD}(?:(?P<below>{_BELOW}) (?P<b>#\d+)(?: (?P<b_unit>{UNIT}))?|"
    rf"(?P<upto>{_UP_TO}) (?P<t>#\d+)(?: (?P<t_unit>{UNIT}))?|"
    rf"(?:between |from )?(?P<low>#\d+)(?: (?P<low_unit>{UNIT}))? (?:(?:to|and|through|up to) )?"
    rf"(?P<high>#\d+)(?: (?P<high_unit>{UNIT}))?|"
    rf"(?P<m>#\d+)(?: (?P<m_unit>{UNIT}))?(?: of (?:the )?pad)? (?:and|or) "
    r"(?:(?P<up>up|upwards?|more|above|over|beyond|heavier|deeper|larger|higher)|"
    r"(?:less|below|under|down|lighter|smaller|lower))|"
    rf"(?P<above>{_ABOVE}) (?P<a>#\d+)(?: (?P<a_unit>{UNIT}))?|"
    rf"(?P<from>{_FROM}) (?P<f>#\d+)(?: (?P<f_unit>{UNIT}))?|"
    rf"(?P<rest>{_REST}))(?: (?:of|in) (?:the )?(?:pad|force|grip|depth|mass|weight|"
    r"(?:(?:hard|force|never exceed) )?limit))?"
)
_NO_LABEL = (
    r"(?!(?:and|or|but|the|a|an|is|are|am|it|its|of|for|if|as|that|this|to|be|we|i|you|me|us|with|"
    r"call|calls|called|counts?|means?|makes?|gives?|anything|everything|all|whatever|what|which|"
    r"then|so|do|does|now|in|on|at|by|not|no|one|rest|otherwise|else|more|less|than|pad|n|mm|g|"
    r"force|depth|area|mass|grip|dent|press|weight)\b)"
)
_LABEL = rf"(?:the |an? )?(?P<label>{_NO_LABEL}[a-z][a-z'-]*(?: (?:right|enough))?)"
_LABEL_FIRST = re.compile(rf"{_LABEL} {_VALUES}(?= |$)")
_VALUES_FIRST = re.compile(
    rf"(?:(?:and|then|but) )?{_VALUES} (?:(?:(?:it|that|this|they|we|i) )?(?:is|are|be|being|as|"
    rf"counts? as|means?|makes?|gives?|say|(?:is|are) (?:called|named|counted as)|"
    rf"calls?(?: (?:it|that|them))?|goes (?:as|down as|under)) )?{_LABEL}(?= |$)"
)
_VALUES_ALONE = re.compile(rf"{_VALUES}(?= |$)")
_ASKS_RANGE = re.compile(
    r"\b(?:which|what) (?:of (?:the|these) )?(?:\w+ )?(?:range|bin|bracket|interval|class|group|"
    r"category|bucket|slot)s?\b"
)
_JOINT = re.compile(r"(?: (?:for|to) me)? (?:(?:and|or|but|then|versus|vs) )*")
_OTHER = re.compile(
    r"\b(?:if|not|never|how|why|limit|band|headroom|margin|offset|center|middle|distance|edge|x|y|"
    r"ratio|squared?|than|minus|plus|times|texture|shape|next)\b|#"
)
_OF_FORCE = re.compile(r"\b(?:force|grip\w*|press\w*|squeez\w*|push\w*|load|pinch\w*|clamp\w*)\b")
_LINE_NAME = (
    r"(?:dividing line|divide|threshold|cut off|cutoff|boundary|border|line|mark|split|watershed|"
    r"borderline)(?: between \w+ and \w+)?"
)
_DIVIDED = re.compile(
    rf"(?:(?:taking|with|using|use|take|given(?: that)?|at|let) )*"
    rf"(?:(?P<n>#\d+ (?:{UNIT}))(?: of (?:the )?pad)? "
    r"(?:(?:as|is|being|for|be|to be|marks?|forms?) )?(?:(?:the|a|an|our|my) )?"
    rf"{_LINE_NAME}|(?:(?:the|a|an|our|my) )?{_LINE_NAME} (?:(?:is|at|being|of|lies at|drawn at) )+"
    rf"(?P<m>#\d+ (?:{UNIT}))(?: of (?:the )?pad)?)"
)
_MORE_WORDS = (
    r"(?:deep|heavy|firm|strong|large|big|high|hard|tight|broad|wide|much|powerful|great|thick|"
    r"coarse|fat|massive|bold|considerable)"
)
_LESS_WORDS = (
    r"(?:shallow|light|gentle|weak|small|little|low|soft|loose|narrow|slight|faint|feeble|thin|"
    r"tiny|mild|delicate|modest|superficial)"
)
_EITHER = re.compile(
    rf"\b(?:(?P<a>{_MORE_WORDS}) (?:or|and|versus|vs) (?:rather )?(?P<b>{_LESS_WORDS})|"
    rf"(?P<c>{_LESS_WORDS}) (?:or|and|versus|vs) (?:rather )?(?P<d>{_MORE_WORDS}))\b"
)

_SHARE_OF_LIMIT = re.compile(
    r"\b(?:(?:share|part|percentage|percent|fraction) of (?:the )?(?:(?:hard|force|"
    r"never exceed) )?limit|"
    r"(?:limit (?:share|usage)))\b"
)
_SHARE = Term(expression="100 * force_n / limit_n", dimension="fraction", words="it", is_sum=True)
"""What values in percent of the limit are of."""

_LETTER = re.compile(r"\b[A-E]\b(?!['’])")

_GRADES = re.compile(
    rf"{_MORE_WORDS}|{_LESS_WORDS}|medium|mid|middle|middling|fair|normal|ok|okay|fine|good|bad|"
    r"warn|warning|fault|alarm|error|moderate|average|standard|acceptable|pass|fail|safe|unsafe|green|"
    r"amber|yellow|red|poor|"
    r"excellent|short|long|easy|rough|just right"
)
"""Words that need no quotes and no verb to stand for values."""

_LISTED = re.compile(r"\b(?:(\w+) )?(\w+) or (\w+)\b")
"""'Heads or tails?', which names the words to choose from."""

_MEANS = re.compile(
    r"\b(?:is|are|as|be|means?|meaning|counts?|makes?|gives?|goes|calls?|named|say)\b"
)


@dataclass(frozen=True, slots=True)
class _Bin:
    """A word, with the least and the largest value that it stands for; all others without these."""

    label: str
    low: float | None = None
    high: float | None = None
    has_low: bool = True
    has_high: bool = True

    def condition(self, value: str) -> str:
        """Whether it stands for the value of an expression; '' where it stands for all others."""
        low, high = (None if end is None else f"{end:g}" for end in (self.low, self.high))
        if low and high:
            return f"{low} <= {value} <= {high}"
        if low:
            return f"{value} {'>=' if self.has_low else '>'} {low}"
        return f"{value} {'<=' if self.has_high else '<'} {high}" if high else ""

    def has(self, value: float) -> bool:
        """Whether it stands for a value that is none of its ends."""
        above = self.low is None or value > self.low
        return above and (self.high is None or value < self.high)


def binned(question: str, asked: AskedWords) -> str | None:
    """The word that a question's own values choose; None where it gives none.

    Args:
        question: The question, as it is written.
        asked: The same in plain words.
    """
    if truth := _divided(asked):
        return truth
    if len(set(_LETTER.findall(question))) > 1:
        named = _LETTER.sub(lambda each: f"letter{each[0].lower()}", question)
        truth = binned(named, asked_words(named))
        return truth and re.sub(r"'letter([a-e])'", lambda each: f"'{each[1].upper()}'", truth)
    starts = _starts(asked.words)
    rows = [
        _row(asked.words, pattern, start)
        for pattern in (_LABEL_FIRST, _VALUES_FIRST)
        for start in starts
    ]
    row = max(rows, key=len, default=())
    listed = {word for each in _LISTED.findall(asked.words) for word in each if word}
    labelled = all(match["label"] in listed or _is_label(question, match) for match in row)
    told = _chosen(asked, row) if len(row) > 1 and labelled else None
    if told or len(asked.numbers) < 2:
        return told
    return _range(question)


def _range(question: str) -> str | None:
    """The one of several ranges that a question names, in its words; None of other questions."""
    asked = asked_words(question)  # as it is written: 'between', not 'from ... to'
    rows = (
        _row(asked.words, _VALUES_ALONE, start, _VALUES_ALONE)
        for start in reversed(_starts(asked.words))
    )
    row = max(rows, key=len, default=())
    if len(row) < (2 if _ASKS_RANGE.search(asked.words) else 3) or any(m["rest"] for m in row):
        return None
    to = "-" if re.search(r"\d ?[-–] ?\d", question) else " to "
    said = [asked.said(match[0]).replace("zero", "0") for match in row]
    return _chosen(asked, row, [re.sub(r"(?<=\d) (?=\d)", to, words) for words in said])


def _starts(words: str) -> Sequence[int]:
    """Where words and numbers begin."""
    return [match.start() for match in re.finditer(r"(?<![^ ])(?=[a-z#])", words)]


def _is_label(question: str, match: re.Match[str]) -> bool:
    """Whether a word stands for values: by quotes, a verb between them, or as a usual grade."""
    label = match["label"]
    if (
        _GRADES.fullmatch(label)
        or re.search(rf"['\"“‘]{re.escape(label)}['\"”’,.]", question, re.I)
        or re.fullmatch(r"letter[a-e]", label)
    ):
        return True
    return _MEANS.search(match[0]) is not None and not re.fullmatch(UNIT, label)


def _row(
    words: str,
    pattern: re.Pattern[str],
    start: int,
    others: re.Pattern[str] = _VALUES_FIRST,
) -> Sequence[re.Match[str]]:
    """Bins that stand one behind the other."""
    found: list[re.Match[str]] = []
    while match := pattern.match(words, start) or (found and others.match(words, start)):
        found.append(match)
        if (joint := _JOINT.match(words, match.end())) is None:
            break
        start = joint.end()
    return found


def _chosen(
    asked: AskedWords, found: Sequence[re.Match[str]], labels: Sequence[str] = ()
) -> str | None:
    """The word of the bin that holds the value; ``labels`` are the words of bins without."""
    labels = labels or [match["label"] for match in found]
    before, after = asked.words[: found[0].start()], asked.words[found[-1].end() :]
    is_of_limit = _SHARE_OF_LIMIT.search(asked.words) is not None
    if is_of_limit:
        before = _SHARE_OF_LIMIT.sub("", before)
    if _OTHER.search(
        re.sub(r"\bif(?: (?:i|we|you) (?:call|say|count))?\s*$", "", before)
    ) or _OTHER.search(after):
        return None
    ends = [_ends(asked, match) for match in found]
    named = next((term for each in ends for term in each if term and term.unit), None)
    subject = _subject(named, f"{before} {after}") if named else None
    if subject and is_of_limit:
        subject = _SHARE if subject.dimension == _SHARE.dimension else None
    if named is None or subject is None:
        return None
    if any(end.dimension not in (named.dimension, UNSAID) for each in ends for end in each if end):
        return None
    bins = [
        _bin(match, label, each, named, subject)
        for match, label, each in zip(found, labels, ends, strict=True)
    ]
    sized = [each for each in bins if each and (each.low is not None or each.high is not None)]
    others = [each.label for each in bins if each and each not in sized]
    if None in bins or not sized or len(others) > 1:
        return None
    cases = [(each.label, each.condition(subject.expression)) for each in sized]
    if others or not _covers(sized):
        return choice_of(*cases, (others[0] if others else NEITHER, ""))
    return choice_of(*cases)


def _ends(asked: AskedWords, match: re.Match[str]) -> tuple[Term | None, Term | None]:
    """The numbers of a bin; of a range two."""

    def read(number: str) -> Term | None:
        words = " ".join(filter(None, (match[number], match[f"{number}_unit"])))
        return asked.term(words) if words else None

    first = next((name for name in ("b", "t", "m", "a", "f", "low") if match[name]), "")
    return (read(first) if first else None), read("high")


def _bin(
    match: re.Match[str],
    label: str,
    ends: tuple[Term | None, Term | None],
    named: Term,
    subject: Term,
) -> _Bin | None:
    """A word with its values in the unit of the subject; None where these do not fit it."""
    if match["rest"]:
        return _Bin(label)
    low, high = (None if end is None else _value(end, named, subject) for end in ends)
    if low is None:
        return None
    if match["low"]:
        return None if high is None else _Bin(label, low, high)
    is_above = bool(match["a"] or match["f"] or match["up"])
    has_end = not (match["b"] or match["a"])
    if is_above:
        return _Bin(label, low=low, has_low=has_end)
    return _Bin(label, high=low, has_high=has_end)


def _value(end: Term, named: Term, subject: Term) -> float | None:
    """A number in the unit of the subject; a bare one has the unit that is named beside others."""
    both = alike(end, named) if end.dimension == UNSAID else (end, named)
    pair = alike(both[0], subject) if both else None
    if pair is None or pair[1].expression != subject.expression:
        return None
    value = Expression(pair[0].expression).evaluate({}).value
    return None if value is None or isinstance(value, bool | str) else float(value)


def _subject(named: Term, around: str) -> Term | None:
    """What the values are of, by their unit and by the words around."""
    if named.dimension == "area":
        return Term(expression="area_mm2", dimension="area", words="it")
    if named.dimension == "mass" and _OF_FORCE.search(around):
        return usual("force")
    return usual(named.dimension) if usual_unit(named.dimension) else None


def _covers(bins: Sequence[_Bin]) -> bool:
    """Whether every value has a word."""
    ends = sorted({end for one in bins for end in (one.low, one.high) if end is not None})
    between = [(a + b) / 2 for a, b in pairwise(ends)]
    return all(any(one.has(v) for one in bins) for v in (ends[0] - 1, *between, ends[-1] + 1))


def _divided(asked: AskedWords) -> str | None:
    """The one of two opposites that a named dividing line leaves."""
    found = _DIVIDED.search(asked.words)
    if found is None:
        return None
    rest = f"{asked.words[: found.start()]} {asked.words[found.end() :]}"
    either, line = _EITHER.search(rest), asked.term(found["n"] or found["m"])
    if either is None or line is None or _OTHER.search(rest):
        return None
    subject = _subject(line, rest)
    value = _value(line, line, subject) if subject else None
    if subject is None or value is None:
        return None
    more, less = (either["a"], either["b"]) if either["a"] else (either["d"], either["c"])
    return choice_of((more, f"{subject.expression} > {value:g}"), (less, ""))
