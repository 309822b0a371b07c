"""Wordings of questions for a number, from what is asked and the names of the quantity.

Not here: the quantities (``pressed_amounts``, ``placed_amounts``, ``amounts``).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

from tacgrasp.lessons.dialogue.meaning import Amount, Which
from tacgrasp.lessons.dialogue.patterns.family import (
    Bindings,
    Numbers,
    QuestionFamily,
    length_of,
    wants_one_word,
)
from tacgrasp.lessons.dialogue.patterns.pattern import Slots


class Asked(NamedTuple):
    """A question in its parts: 'how deep' 'is it', and 'it is' after 'tell me how deep'.

    Attributes:
        head: What it begins with.
        inverted: The rest of a direct question.
        plain: The rest after 'tell me', and after 'do you think'.
    """

    head: str
    inverted: str
    plain: str


@dataclass(frozen=True, slots=True, kw_only=True)
class AmountWording:
    """How a quantity is asked for.

    Attributes:
        asked: Questions that a unit may follow.
        counted: Questions that name their unit, as ``{unit}``: 'how many {unit} deep' 'is it'.
        nouns: Its names, with their articles.
        bare: Its names without an article.
        others: Whole questions of another build.
        terse: A few words that name their unit, as ``{unit}``: '{unit} deep'.
    """

    asked: Sequence[Asked]
    nouns: str
    bare: str
    counted: Sequence[Asked] = ()
    others: str = ""
    terse: str = ""


UNIT_WORDS: Mapping[str, str] = {
    "mm": "(mm|mm|millimetres|millimetres|millimetre|mms)",
    "µm": "(microns|microns|micrometres|µm|micron|micrometre|thousandths of a (millimetre|mm))",
    "cm": "(cm|centimetres|centimeters|centimetre)",
    "N": "(newtons|newtons|N|newton)",
    "mN": "(millinewtons|mN|millinewton)",
    "gf": "(grams|grams|grams of force|gram-force|grams-force|grams force|grams of weight|gram force|g|gf)",
    "%": "(percent|percent|per cent|%|percentage points|pct)",
    "mm²": "(mm²|mm2|square millimetres|square mm|millimetres squared|mm squared|sq mm)",
    "g": "(grams|grams|g|gram|grammes)",
    "kg": "(kg|kilograms|kilos|kilo|kilogrammes|kilogram)",
}
"""Words of units; 'gf' are grams of a force."""

GEL = (
    "(the (gel|gel|pad|pad|skin|sensor|finger|fingertip|rubber|membrane|elastomer|sensor skin|"
    "gel pad|tip|cushion|soft (skin|layer|pad|surface)|silicone|sensing (skin|face|layer|surface|area)|"
    "tactile (pad|skin|sensor)|touch (pad|sensor)|jelly|polymer|pad surface|finger pad)|your (gel|skin|pad|finger|fingertip))"
)
"""What is pressed, as people call it."""

HANDS = (
    "(we|we|we|you|the (fingers|jaws|grippers|fingertips|pads|two fingers|pincers|claws|tongs|prongs)|your (fingers|jaws)|"
    "the robot's fingers)"
)
"""Who holds, with a verb in the plural."""

HAND = "(the (gripper|robot|hand|claw|robot hand|machine|claw|pincer|manipulator|end effector|clamp|bot)|our (gripper|robot)|your (gripper|hand))"
"""Who holds, with a verb in the singular."""

GUESS = (
    "(do you think|would you say|do you reckon|do you guess|do you believe|do you estimate|"
    "would you guess|would you estimate|do you suppose)"
)
FIND = (
    "(measure|estimate|check|determine|find out|work out|figure out|see|look|show me|show|judge|"
    "please (measure|estimate|check|determine|find out|work out|show me|let me know|explain)|(can|"
    "could|would|will) you [please] (measure|estimate|check|determine|find out|see|judge|guess|"
    "figure out|work out|show me|let me know|tell us|quantify|confirm|remind me)|do we know|"
    "is it known|I do not know|I can not see|I have no idea|I am not sure|I forgot|I was wondering|"
    "just tell me|tell us|I am trying to find out|I am interested in|it would help to know|"
    "it would be good to know|we have to know|I have to know|is there a way to tell|"
    "is it possible to say|would you be so kind as to tell me|I would be glad to know|"
    "I have to write down|the customer asks|my boss asks|they ask|my (teacher|colleague|professor|"
    "chef|friend) (asks|wants to know)|we are wondering|i must know|can you see|can i know|"
    "may i know|may i ask|can i ask|does the sensor (say|tell|show|know)|quickly tell me|"
    "tell me quickly|tell me again|say again|repeat|nobody told me|let me see|let us find out|"
    "want to know|wondering)"
)
GET = (
    "(express|quantify|quote|get me|get|read me|read me off|read off|read|fetch|print|display|output|return|measure|check|determine|quantify|"
    "please (give me|give us|measure|read|show|tell me|check|display|state|share|provide)|(can|"
    "could|would|will) you [please] (measure|read|check|show me|show|give me|give us|report|"
    "estimate|tell us|state|provide|share|print|determine|quantify|look up)|(can|could|may) (I|"
    "we) (see|get|have|know|read)|what was|what is|what are you getting for|what did you (get|read|"
    "feel|find) for|what have you got for|what do you make of|[do] you have|have you got|got|"
    "do we have|do we know|do you see|[give me|what is|tell me|is there] (a|an|the|any|"
    "your) (value|reading|number|figure|estimate|measurement|guess|result) (for|of)|what (value|"
    "reading|number|figure) (do you (get|have|read|see|show)|is there) for|what does the (sensor|"
    "pad|gel|gripper|display|robot) (say|read|show|report|give|measure) for|put a number on|"
    "tell us|give us|send me|send|let us see|let us have|I would like to (see|have|know|get)|"
    "I want to (see|have|know)|I need to (see|have|know)|we need to know|i only need|i just need|"
    "just|only|just give me|just tell me|i am interested in|i have to know|i am after|"
    "i wonder about|i am asking for|i ask for|i was asked for|my question is about|"
    "remind me what was|repeat|once more|again|and|what about|how about|as for)"
)
_KIND = (
    "(current|present|measured|actual|latest|momentary|exact|estimated|approximate|real|final|"
    "precise|live|instantaneous|last)"
)
_READING = (
    "(value|reading|figure|number|estimate|measurement|data|readout|readings|result|info|"
    "in numbers|as a number|right now|now|please)"
)
OPENING = (
    "[if you had to guess,|at a guess,|in your opinion,|according to (you|the sensor|the gel|"
    "your measurement|your reading),|from what you feel,|judging by the (gel|touch|sensor),|"
    "as far as you can tell,|in numbers,|roughly speaking,|as of now,|at this moment,|"
    "in this contact,|with this touch,|by feel,|in total,|after this (press|grasp|touch),|"
    "now that we (hold|touch|have) {thing},|when you feel {thing},|approximately,|"
    "just out of interest,|to be sure,|for my (notes|report|log|table|homework),|good,|great,|"
    "thanks,|sorry to bother you,|friend,|mate,|sir,|dear robot,]"
)
CLOSING = (
    "[, would you say|, in your opinion|, as far as you can tell|, in numbers|, as a number|"
    ", roughly speaking|, if I may ask|, if you know|, can you tell|, do you know|, any idea|"
    ", if you had to guess|, more or less|, or so|, all in all|, if you please|, be exact|"
    ", be precise|, just the number|, only the number|, number only|, as exactly as possible|"
    ", to be exact|, according to (you|the sensor|the gel)|, for my (notes|report|log)|, thank you|"
    ", I wonder|, robot|, tell me|, can you say|by feel|by touch|, i mean|, i can not see it|"
    ", do you think|again|, at a guess|, ballpark|in this contact|, mate]"
)


def number_pattern(wording: AmountWording, *, is_unit_needed: bool, extra_unit: str = "") -> str:
    """Wordings of a question for a number.

    Args:
        wording: What is asked.
        is_unit_needed: Whether every wording names the unit.
        extra_unit: Other ways to name the unit.
    """
    extra = f"|{extra_unit}" if extra_unit else ""
    named = (
        "(in {unit}|in {unit}|in {unit}|[now|here|roughly|exactly|measured|expressed|given|"
        "right now"
        f"|at the moment] in {{unit}}|, {{unit}}|, {{unit}} please|, in {{unit}} please|"
        f"as {{unit}}{extra})"
    )
    unit = named if is_unit_needed else f"[{named}]"
    direct = "|".join(f"({a.head}) ({a.inverted})" for a in wording.asked)
    plain = "|".join(f"({a.head}) ({a.plain})" for a in wording.asked)
    thought = "|".join(f"({a.head}) {GUESS} ({a.plain})" for a in wording.asked)
    short = (
        f"[the|your|our|this|any|what] ({wording.bare}) {_READING}|[the|your|"
        f"our] {_KIND} ({wording.bare})|({wording.bare})|({wording.bare})"
    )
    ways = [
        f"({direct}) {unit}",
        f"({direct}) {unit}",
        f"({{ask}}|{{ask}}|{FIND}|{FIND}|) ({plain}) {unit}",
        f"({thought}) {unit}",
        f"[{{want}}] ({wording.nouns}) {unit}",
        f"{GET} ({wording.nouns}|{short}) {unit}",
        f"({short}) {unit}",
        f"({wording.bare}) {unit}",
        f"({wording.nouns}) [,|:] (how (much|large) is (it|that)|what is (it|that)) {unit}",
        f"({wording.nouns}) [,|:] how many {{unit}} (is|would) (it|that) [be]",
        f"in {{unit}} [,|please,] (({direct})|[{{want}}] ({wording.nouns})|{{ask}} ({plain}))",
    ]
    if wording.counted:
        direct = "|".join(f"({a.head}) ({a.inverted})" for a in wording.counted)
        plain = "|".join(f"({a.head}) ({a.plain})" for a in wording.counted)
        ways += [f"({direct})", f"({{ask}}|{FIND}) ({plain})"]
    if wording.terse:
        ways.append(wording.terse)
    if wording.others:
        ways.append(f"({wording.others}) {unit}")
    return f"{{lead}} {OPENING} ( {' | '.join(ways)} ) {CLOSING} {{tail}} [, {{length}}]"


WORDED = ("depth", "area")
"""Quantities that have a word too: 'how deep is it, in one word' wants it."""


def amount_of(quantity: str, unit: str) -> Callable[[Bindings, Numbers], Amount | Which]:
    """Meaning of a wording that asks for a quantity, in its own unit or else in this one."""

    def build(bindings: Bindings, _: Numbers) -> Amount | Which:
        if quantity in WORDED and "unit" not in bindings and wants_one_word(bindings):
            return Which(name=quantity, length=length_of(bindings))
        unit_asked = bindings.get("unit", unit)
        return Amount(quantity=quantity, unit=unit_asked, length=length_of(bindings))

    return build


def amount_slots(units: Mapping[str, str]) -> Slots:
    """Slots of a question for a number: its units by symbol, and what holds and is pressed."""
    return {"unit": units, "gel": GEL, "hands": HANDS, "hand": HAND}


def amount_family(
    name: str,
    quantity: str,
    wording: AmountWording,
    *units: str,
    is_unit_needed: bool = False,
    extra_unit: str = "",
    slots: Slots | None = None,
) -> QuestionFamily:
    """A family that asks for a quantity; its first unit is meant where none is named."""
    return QuestionFamily(
        name=name,
        pattern=number_pattern(wording, is_unit_needed=is_unit_needed, extra_unit=extra_unit),
        build=amount_of(quantity, units[0]),
        slots={
            **amount_slots({symbol: UNIT_WORDS[symbol] for symbol in units}),
            **(slots or {}),
        },
    )
