"""True answers to questions, worded: in one word, in a sentence, or in between.

Every wording reads back to the same value
(``tacgrasp.lessons.dialogue.scoring.answer_reading``; tested).
An answer that needs what nobody gave says what is missing.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace

from cltp.texts.captions import with_article
from tacgrasp.lessons.dialogue.conditions import IN_BAND
from tacgrasp.lessons.dialogue.expression import Expression
from tacgrasp.lessons.dialogue.facts import (
    ACTIONS,
    FACT_OF,
    NOTHING_TOUCHES,
    REASONS,
    UNMEASURED,
    UNTOUCHED_NAMES,
    capital,
    fact,
    is_plural,
    named,
    place,
)
from tacgrasp.lessons.dialogue.meaning import (
    Amount,
    AnswerKind,
    Calculated,
    Check,
    Description,
    Length,
    Meaning,
    OffTopic,
    Several,
    Unknowable,
    Which,
    Why,
    kind_of,
    names_of,
    truth_of,
)
from tacgrasp.lessons.dialogue.quantities import (
    MEAN_PRESSURE,
    QUANTITIES,
    amount_text,
    can_be_in,
    number_in,
    to_step,
    value_text,
)
from tacgrasp.lessons.dialogue.scene import PER_GRAM, AskedScene, Value

OFF_TOPIC = "That is not about touch."
UNKNOWABLE = "I can't feel {}."
_BAND_TESTS = (IN_BAND, "force_n < band_low_n", "force_n > band_high_n")
_COMPARED = re.compile(
    rf"(?:not \()?(?:abs\()?(?P<left>{re.escape(MEAN_PRESSURE)}|area_mm2|"
    rf"(?:min\(|hypot\()?pad_[^<>=]+?)(?: - [\d.]+\))? (?:<=|>=|<|>) [\d.]+\)?"
)
_SUPPOSED_N = re.compile(
    r"(?P<force>\(?force_n [+-] [\d.]+\)?|[\d.]+ \* force_n|\(1 [+-] [\d.]+ / 100\) \* force_n|"
    r"\([^<>=]*\bforce_n\b[^<>=]*[+*-] [\d.]+\)|\([\d.]+ \* force_n\)) (?:<=|>=|<|>) (?P<with>.+)|"
    r"band_low_n <= (?P<within>(?!force_n <)[^<>]*\bforce_n\b[^<>]*) <= band_high_n"
)
"""A force that a question supposes, and what it is compared with."""

_SUPPOSED_G = re.compile(
    r"(?:(?P<force>force_n)|[\d.]+) (?:<|>=) "
    rf"(?P<needed>{PER_GRAM} \* (?P<mass>.*\bmass_g\b.*|[\d. *]+))"
)
"""The force that a supposed mass needs, or that the given one needs: '2 >= gram_n * mass_g'."""

_DENIED = re.compile(r"not \((.+)\)")
_NEEDED_N = re.compile(rf"{PER_GRAM} \* (?:mass_g|[\d. *]+)$")
"""The force that a mass needs, which another force is compared with."""

_TESTED = re.compile(r"(?P<name>\w+) .*\d (?P<unit>\S+)")
"""A quantity that a check compares with a number: 'force > 100 g'."""

BY_NOTHING = "I can't say: it would be divided by nothing."


@dataclass(frozen=True, slots=True, kw_only=True)
class Answer:
    """An answer.

    Attributes:
        text: Its wording.
        kind: What kind of answer it is.
        value: Its value: a number in ``unit``, a word, or whether yes; None without one.
        unit: Unit of a number; ''.
        decidable: Whether touch and what was given decide the question.
    """

    text: str
    kind: AnswerKind
    value: Value = None
    unit: str = ""
    decidable: bool = True


def answer(meaning: Meaning, scene: AskedScene) -> Answer:
    """The true answer to a question about a scene."""
    lacking = _lacking(meaning, scene)
    if lacking is not None and isinstance(meaning, Several):
        return _in_part(meaning, scene, lacking)
    if lacking is not None:
        return lacking
    match meaning:
        case Amount():
            return _amount(meaning, scene)
        case Check():
            return _check(meaning, scene)
        case Calculated():
            return _calculated(meaning, scene)
        case Which():
            return _which(meaning, scene)
        case Several():
            return _several(meaning, scene)
        case Why():
            return _why(meaning, scene)
        case Description():
            return Answer(text=_description(scene), kind=AnswerKind.TEXT)
        case Unknowable(subject=subject, length=length):
            text = "Unknown." if length is Length.WORD else UNKNOWABLE.format(subject)
            return Answer(text=text, kind=AnswerKind.UNKNOWABLE, decidable=False)
        case OffTopic():
            return Answer(text=OFF_TOPIC, kind=AnswerKind.OFF_TOPIC, decidable=False)


def _lacking(meaning: Meaning, scene: AskedScene) -> Answer | None:
    """The answer where a name has no value; None where all have one."""
    names, values = names_of(meaning), scene.values()
    needed_n = meaning.needed_n if isinstance(meaning, Check) else ""
    needed = Expression(needed_n).names if needed_n else ()
    if not scene.state.in_contact and not set(names) <= UNTOUCHED_NAMES:
        return Answer(text=NOTHING_TOUCHES, kind=kind_of(meaning))
    for name in (*names, *needed):
        if values[name] is None:
            reason = UNMEASURED.get(name)
            text = f"I can't say: {reason}." if reason else f"I can't tell the {name}."
            return Answer(
                text=text.replace("force_n", "force"),
                kind=AnswerKind.UNKNOWABLE,
                decidable=False,
            )
    return None


def _amount(asked: Amount, scene: AskedScene) -> Answer:
    text, clause = _amount_clause(asked, scene)
    worded = f"{capital(clause)}." if asked.length is Length.SENTENCE else f"{text}."
    return Answer(text=worded, kind=AnswerKind.NUMBER, value=number_in(text), unit=asked.unit)


def _amount_clause(asked: Amount, scene: AskedScene) -> tuple[str, str]:
    """An amount in short and as a clause: '0.19 mm', 'the depth is 0.19 mm'."""
    quantity, is_less = QUANTITIES[asked.quantity], bool(asked.less)
    value = Expression(truth_of(asked)).evaluate(scene.values()).value
    text = amount_text(asked.quantity, float(value or 0.0), asked.unit, scene, is_signed=is_less)
    text = to_step(text, asked.step)
    # the number of the question is not repeated: an answer has one number
    noun = f"the difference of {quantity.name}" if is_less else quantity.name
    return text, f"{noun} is {text}"


def _check(asked: Check, scene: AskedScene) -> Answer:
    values = scene.values()
    is_so = bool(Expression(asked.condition).evaluate(values).value)
    yes = "yes" if is_so else "no"
    clause = _shown(asked, scene)
    is_word = asked.length is Length.WORD
    text = f"{yes.capitalize()}." if is_word else f"{yes.capitalize()}, {clause}."
    return Answer(text=text, kind=AnswerKind.YES_NO, value=is_so)


def _shown(asked: Check, scene: AskedScene) -> str:
    """What a yes or no is based on: 'it needs 0.62 N and the force is 0.83 N'.

    What is compared with a number is told in the unit of that.
    """
    units = {}
    if (tested := _TESTED.fullmatch(asked.test)) and can_be_in(tested["name"], tested["unit"]):
        units[tested["name"]] = tested["unit"]
    clauses = [fact(name, scene, units.get(name, ""))[1] for name in asked.shows]
    if asked.needed_n:
        needed = float(Expression(asked.needed_n).evaluate(scene.values()).value or 0.0)
        clauses.insert(0, f"it needs {needed:.2f} N")
    *first, last = clauses
    return f"{', '.join(first)} and {last}" if first else last


def _calculated(asked: Calculated, scene: AskedScene) -> Answer:
    kind = kind_of(asked)
    value = Expression(asked.truth).evaluate(scene.values()).value
    if value is None:
        return Answer(text=BY_NOTHING, kind=AnswerKind.UNKNOWABLE, decidable=False)
    if asked.unit is not None:
        is_count = isinstance(value, int) and not asked.unit
        text = str(int(value)) if is_count else value_text(float(value), asked.unit)
        text = to_step(text, asked.step)
        return Answer(text=f"{text}.", kind=kind, value=number_in(text), unit=asked.unit)
    is_of_band = any(test in asked.truth for test in _BAND_TESTS)
    shown = [FACT_OF[name] for name in names_of(asked) if name in FACT_OF]
    if kind is AnswerKind.CHOICE:  # 'central' says as much as 'it is centered'
        shown = [name for name in shown if name != "position"]
    if is_of_band and (kind is AnswerKind.CHOICE or asked.truth in _BAND_TESTS):
        shown = ["force_band"]
    compared = _compared(asked.truth, scene)
    clauses = [compared] if compared else [fact(each, scene)[1] for each in dict.fromkeys(shown)]
    if names_of(asked) == ("action",):
        clauses = [f"the advice is to {ACTIONS[str(scene.values()['action'])]}"]
    if supposed := _SUPPOSED_N.fullmatch(asked.truth):
        if needed_n := _NEEDED_N.search(asked.truth):
            needed = float(Expression(needed_n[0]).evaluate(scene.values()).value or 0.0)
            clauses = [f"it needs {needed:.2f} N"]
        clauses = _supposed_clauses(supposed["force"] or supposed["within"], clauses, scene)
    denied = _DENIED.fullmatch(asked.truth)
    if loaded := _SUPPOSED_G.fullmatch(denied[1] if denied else asked.truth):
        needed = float(Expression(loaded["needed"]).evaluate(scene.values()).value or 0.0)
        needs = "needs" if loaded["mass"] == "mass_g" else "would need"
        felt = f" and {fact('force', scene)[1]}" if loaded["force"] else ""
        clauses = [f"it {needs} {needed:.2f} N{felt}"]
    if kind is AnswerKind.CHOICE:
        text = _chosen(str(value), clauses, Expression(asked.truth).choices)
        return Answer(text=text, kind=kind, value=value)
    yes = "Yes" if value else "No"
    return Answer(text=f"{', '.join((yes, *clauses))}.", kind=kind, value=bool(value))


def _supposed_clauses(force: str, clauses: Sequence[str], scene: AskedScene) -> list[str]:
    """A supposed force, and what it is compared with, in place of the force that is felt."""
    would = float(Expression(force).evaluate(scene.values()).value or 0.0)
    bounds = [each for each in clauses if not each.startswith("the force is")]
    return [f"the force would be {would:.2f} N", *bounds]


def _compared(truth: str, scene: AskedScene) -> str:
    """A pressure, area or distance from the border that is compared with a number; else ''."""
    found = _COMPARED.fullmatch(truth)
    if found is None:
        return ""
    value = Expression(found["left"]).evaluate(scene.values()).value
    if not isinstance(value, float):
        return ""
    if found["left"] == "area_mm2":
        return fact("area", scene, "mm²")[1]
    if found["left"] == MEAN_PRESSURE:
        return f"the mean pressure is {value_text(value, 'kPa')}"
    return f"the distance is {value_text(value, 'mm')}"


def _chosen(word: str, clauses: list[str], choices: Sequence[str]) -> str:
    """A word with the readings behind it, unless they name another one to choose from."""
    others = "|".join(
        re.escape(choice[:1] if choice[:2] in ("x ", "y ") else choice)
        for choice in choices
        if choice != word
    )
    told = ", ".join([*clauses[:-2], " and ".join(clauses[-2:])])
    if not told or re.search(rf"\b(?:{others})\b", told, re.I):
        return f"{capital(word)}."
    if re.search(rf"\b(?:is|an?) {re.escape(word)}\b", told):
        return f"{capital(told)}."
    return f"{capital(word)}: {told}."


def _calculated_clause(asked: Calculated, scene: AskedScene) -> str:
    """What is calculated in short, beside other answers."""
    told = _calculated(asked, scene)
    if told.kind is AnswerKind.YES_NO:
        return "yes" if told.value else "no"
    if told.kind is AnswerKind.CHOICE:
        return str(told.value)
    text = told.text.rstrip(".")
    return f"that is {text}" if told.decidable else text


def _which(asked: Which, scene: AskedScene) -> Answer:
    word = str(scene.values()[asked.name])
    short, clause = named(asked.name, word, scene)
    if asked.length is Length.WORD:
        text = f"{capital(short if asked.name == 'action' else word)}."
    else:
        text = f"{capital(clause)}."
    if asked.offered and word not in asked.offered:
        none = "Neither" if len(asked.offered) == 2 else "None of these"
        text = f"{none}: {text[:1].lower()}{text[1:]}"
    return Answer(text=text, kind=kind_of(asked), value=word)


def _several(asked: Several, scene: AskedScene) -> Answer:
    clauses = []
    has_amount = any(isinstance(part, Amount) for part in asked.parts)
    asks_shape = any(isinstance(part, Which) and part.name == "shape" for part in asked.parts)
    for part in asked.parts:
        if isinstance(part, Which):
            clause = named(part.name, str(scene.values()[part.name]), scene)[1]
        elif isinstance(part, Calculated):
            clause = _calculated_clause(part, scene)
        elif isinstance(part, Amount):
            clause = _amount_clause(part, scene)[1]
            clause = clause.replace("holds it", f"holds {part.of}") if part.of else clause
        else:
            yes = "yes" if Expression(part.condition).evaluate(scene.values()).value else "no"
            shown = _shown(part, scene)
            if mass := re.fullmatch(r"(?:slips|stays) (\S+ g|\S+ kg)", part.test):
                shown = shown.replace("it needs", f"{mass[1]} needs")
            is_number = has_amount and re.search(r"\d", shown)
            # a number, or an edge, would be taken for one that was asked for
            is_mistakable = is_number or (asks_shape and part.shows == ("cut",))
            clause = yes if is_mistakable else f"{yes}, {shown}"
        clauses.append(clause)
    return Answer(text=f"{capital('; '.join(clauses))}.", kind=AnswerKind.TEXT)


def _in_part(asked: Several, scene: AskedScene, lacking: Answer) -> Answer:
    """The answer to what has one among several questions, and why the others have none."""
    known = [part for part in asked.parts if _lacking(part, scene) is None]
    if not known or not scene.state.in_contact:
        return lacking
    told = _several(replace(asked, parts=tuple(known)), scene)
    unsaid = lacking.text[:1].lower() if not lacking.text.startswith("I ") else lacking.text[:1]
    return replace(lacking, text=f"{told.text.rstrip('.')}; {unsaid}{lacking.text[1:]}")


def _why(asked: Why, scene: AskedScene) -> Answer:
    values = scene.values()
    clauses = [fact(name, scene)[1] for name in asked.shows]
    *first, last = clauses or [REASONS[str(values["reason"])]]
    clause = f"{', '.join(first)} and {last}" if first else last
    if asked.with_action:
        text = f"{capital(ACTIONS[str(values['action'])])}: {clause}."
    else:
        text = f"Because {clause}."
    return Answer(text=text, kind=AnswerKind.TEXT)


def _description(scene: AskedScene) -> str:
    state = scene.state
    words = [str(word) for word in (state.texture, state.shape) if word is not None]
    several = state.shape is not None and is_plural(state.shape)
    noun = " ".join(words if several else [with_article(" ".join(words or ["object"]))])
    area = amount_text("area", 100 * state.area_fraction, "%", scene)
    return (
        f"{capital(noun)}, {place(str(state.position))}, with {with_article(str(state.depth))} "
        f"press ({state.depth_mm:.2f} mm), {with_article(str(state.area))} contact area ({area}) "
        f"and {state.force_n:.2f} N."
    )
