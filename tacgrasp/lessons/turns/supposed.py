"""Follow-ups under a supposition: another force than the one that is felt.

    Is it safe to lift?             And with 0.4 N less?    the band for force_n - 0.4
    What if I add 0.9 N?            Is that too much?       If I add 0.9 N, is the force too much?
    If I double it, are we over?    And if I halve it?      If I halve it, are we over?

Not here: suppositions of a question alone (``tacgrasp.lessons.dialogue.calculations``).
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace

from tacgrasp.lessons.dialogue.expression import Expression
from tacgrasp.lessons.dialogue.meaning import (
    Amount,
    Calculated,
    Check,
    Meaning,
    truth_of,
)
from tacgrasp.lessons.dialogue.plainer import in_words
from tacgrasp.lessons.dialogue.quantities import UNITS
from tacgrasp.lessons.turns.leads import LEAD, capital, uncapital, without_lead
from tacgrasp.lessons.turns.told import told_in
from tacgrasp.lessons.turns.units import TIMES, in_own_unit
from tacgrasp.lessons.understanding import understood_by_grammar

_SUPPOSED = (
    re.compile(r"(?:what|how about) (?P<if>if .+?)[?.! ]*", re.I),
    re.compile(
        r"(?P<if>(?:if|suppose|supposing|assuming) [^,?.]+(?:\.\d+[^,?.]*)*)[,?.] ?(?P<asked>.+)",
        re.I,
    ),
    re.compile(r"(?P<asked>.+?),? (?P<if>if .+?)[?.! ]*", re.I),
    re.compile(
        r"(?P<asked>.+?) (?P<if>with \d+(?:\.\d+)? ?(?:N|newtons?|mN|millinewtons?) (?:more|less|"
        r"extra|on top))[?.! ]*",
        re.I,
    ),
)
"""A question with a supposition, before or behind what is asked."""
_ANOTHER_IF = re.compile(rf"{LEAD}(?:what )?(?P<if>if [^,]+?)[?.! ]*", re.I)
_CHANGED = re.compile(r"\b(?:halved|doubled|tripled|raised|increased|lowered|reduced)\b", re.I)
"""What names the supposed force itself."""
_UNDER_IT = re.compile(r"\b(?:it|that|this|then|still|would)\b", re.I)
_STILL = re.compile(r"\b(?:then|still|would)\b", re.I)
_THEN = re.compile(r",? ?\bthen\b", re.I)
_SUBJECT = re.compile(r"\b(?P<verb>is|are|would|will|does|do) (?:it|that|this)\b", re.I)
_STILL_UNDER = re.compile(
    r"(?:and )?(?P<if>(?:if|with|assume|suppose) [^,?]*?(?:\.\d+[^,?]*?)?)[,.:] (?:is (?:it|that) "
    r"|are we |do we |would we )?(?:still )?(?:stay |be )?(?P<side>over|under|above|below)(?: "
    r"(?:it|that))?(?: then| still)?[?.! ]*",
    re.I,
)
_STILL_IN = re.compile(
    r"(?:and )?(?P<if>(?:if|with) [^,?]*?(?:\.\d+[^,?]*?)?), (?:is (?:it|that) |are we |am i |"
    r"would "
    r"(?:we|i|it) be )?(?:still )?(?:in|inside|within)(?: (?:it|that))?(?: then| still)?[?.! ]*",
    re.I,
)
_ARE_WE_OVER = re.compile(
    r"(?:(?:and|so|but)[, ]+)*(?:now[, ]+)?(?:are we|am i|is it)(?: still| now)* (?:over|under|"
    r"above|"
    r"below|past|beyond)[?.! ]*",
    re.I,
)
"""'Are we over?', of the limit that was told."""
_WITH_FORCE = re.compile(
    r"(?:(?:what|how) about )?(?:if (?:i|we|you) )?(?:with |at |assume |suppose |assuming "
    r")?(?:(?:add|adding|squeeze|press|"
    r"grip) )?(?P<number>\d+(?:\.\d+)?)(?: ?(?P<unit>N|newtons?|mN|millinewtons?))? "
    r"(?P<way>more|less|extra|harder|softer|on top|off|added|fewer)"
    r"(?: (?:force|grip|than(?: (?:now|that|measured|at present))?|squeeze))*(?:[, ]+instead)?",
    re.I,
)
_TIMES_FORCE = re.compile(
    r"(?:with |at |if (?:i|we) (?:had|used|applied) )?(?:squeezing |gripping |pressing )?"
    r"(?P<times>twice|double|half|three times) "
    r"(?:(?:the|that|this|our|my) (?:force|grip|squeeze)|as (?:hard|firmly|strongly|tight))",
    re.I,
)
_FEWER = ("less", "softer", "off", "fewer")
_TAKING = re.compile(
    r"(?:what (?:if|about) |how about |with )?(?:(?:i|we) )?(?:taking|take|easing|ease|letting|let|"
    r"backing|back)(?: off)? (?P<number>\d+(?:\.\d+)?) ?(?P<unit>N|newtons?|mN|millinewtons?)"
    r"(?: off| away)?(?:[, ]+instead)?",
    re.I,
)
_LETTING = re.compile(r"(?:(?:what|how about) )?(?P<if>if (?:i|we|you) [^,]+)", re.I)


def still_under(question: str, noun: str) -> str:
    """'If I add 0.3 N, still under?' with what it may be under."""
    if (inside := _STILL_IN.fullmatch(question)) is not None:
        return f"{inside['if']}, is the force in the band?"
    if noun and _ARE_WE_OVER.fullmatch(question):
        return f"{without_lead(question).rstrip('?.! ')} {noun}?"
    found = _STILL_UNDER.fullmatch(question)
    if found is None:
        return ""
    return f"{found['if']}, is the force {found['side']} {noun}?" if noun else ""


def supposed_in(text: str) -> tuple[str, str] | None:
    """The supposition of a question and what is asked under it; None without one."""
    for pattern in _SUPPOSED:
        if found := pattern.fullmatch(text.strip()):
            return found["if"], found.groupdict().get("asked") or ""
    return None


def with_another_supposition(question: str, before: str) -> Iterator[str]:
    """What was asked before, under another supposition."""
    found, supposed = _ANOTHER_IF.fullmatch(question), supposed_in(before)
    if found is None:
        return
    asked = supposed[1] if supposed else before
    if asked:
        yield f"{capital(found['if'])}, {uncapital(asked)}"
        yield f"{capital(_with_force(found['if']))}, {uncapital(asked)}"
    yield f"What {found['if']}?"


def under_supposition(question: str, before: str) -> str:
    """A follow-up about what was supposed before."""
    supposed = supposed_in(before)
    if _CHANGED.search(question):
        return ""
    if supposed is None or _ANOTHER_IF.match(question) or not _UNDER_IT.search(question):
        return ""
    told = told_in(before)
    if told and told[0].is_supposed and not _STILL.search(question):
        return ""  # a band, a limit or a mass counts for the question that supposes it
    asked = re.sub(rf"^{LEAD}", "", _THEN.sub("", question), flags=re.I)
    return f"{capital(supposed[0])}, {uncapital(about_the_force(asked))}"


def about_the_force(question: str) -> str:
    """A question about 'it' as one about the force."""
    return _SUBJECT.sub(r"\g<verb> the force", question)


def _with_force(clause: str) -> str:
    return re.sub(r"\b(?:it|that)\b", "the force", clause, flags=re.I)


def changed_force(question: str) -> str:
    """The force that a follow-up supposes, as an expression: 'and with 0.4 N less'; '' of none."""
    words = in_words(without_lead(question)).strip(" ?.!")
    if found := _WITH_FORCE.fullmatch(words):
        newtons = in_own_unit(found["number"], found["unit"] or "N")
        return f"(force_n {'-' if found['way'].lower() in _FEWER else '+'} {newtons:.6g})"
    if found := _TAKING.fullmatch(words):
        newtons = in_own_unit(found["number"], found["unit"])
        return f"(force_n - {newtons:.6g})"
    if found := _TIMES_FORCE.fullmatch(words):
        return f"({TIMES[found['times'].lower()]:g} * force_n)"
    letting = _LETTING.fullmatch(words)
    if letting and (read := understood_by_grammar(f"What {letting['if']}?")):
        is_force = isinstance(read.meaning, Calculated) and read.meaning.unit == "N"
        names = Expression(truth_of(read.meaning)).names if is_force else ()
        return f"({truth_of(read.meaning)})" if names == ("force_n",) else ""
    return ""


def unsupposed(asked: Meaning, text: str) -> Meaning | None:
    """What a question asks under a supposition, of the force that is felt; None where it has none.

    Args:
        asked: What it asks.
        text: Its words: 'if I add 0.3 N, are we over the limit?'.
    """
    supposed = supposed_in(text)
    force = changed_force(supposed[0]).strip("()") if supposed else ""
    if not force or not isinstance(asked, Calculated) or force not in asked.truth:
        return None
    return replace(asked, truth=asked.truth.replace(force, "force_n"))


def of_changed_force(force: str, asked: Meaning | None) -> Calculated | None:
    """What was asked before, of another force; None of what has no force.

    Args:
        force: The other force.
        asked: What was asked of the felt one.
    """
    if not isinstance(asked, Amount | Check | Calculated):
        return None
    truth = re.sub(r"\bholds_g\b", "force_n / gram_n", truth_of(asked))
    if "force_n" not in truth:
        return None
    unit = None if isinstance(asked, Check) else asked.unit
    return Calculated(truth=re.sub(r"\bforce_n\b", force, truth), unit=unit)


def of_supposed_force(asked: Meaning, supposed: Meaning) -> Calculated | None:
    """A condition of the force, of the force that was worked out before; None of others."""
    if not isinstance(supposed, Amount | Calculated) or not isinstance(asked, Check | Calculated):
        return None
    unit, force = supposed.unit or "", truth_of(supposed)
    is_force = unit in UNITS and UNITS[unit].dimension == "force"
    if not is_force or force == "force_n" or re.search(r"limit_n|band_|abs|max", force):
        return None  # what is felt itself, or how far it is from something
    if isinstance(asked, Calculated) and asked.unit is not None:
        return None
    condition = asked.condition if isinstance(asked, Check) else asked.truth
    if "force_n" not in condition:
        return None
    return Calculated(truth=re.sub(r"\bforce_n\b", f"({force})", condition), unit=None)
