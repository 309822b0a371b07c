"""Families about the contract: the force band, the limit, lifting, slipping, what next and why."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np

from tacgrasp.lessons.dialogue.conditions import GIVEN, check_of, number_text
from tacgrasp.lessons.dialogue.families.family import (
    Bindings,
    Numbers,
    QuestionFamily,
    length_of,
)
from tacgrasp.lessons.dialogue.families.phrases import (
    amount_pattern,
    check_pattern,
    denied_pattern,
)
from tacgrasp.lessons.dialogue.meaning import Check, Which, Why
from tacgrasp.lessons.dialogue.scene import AskedScene

SAFE_QUESTIONS = (
    "Is it safe to lift?",
    "Can we lift it?",
    "Is the grip good?",
    "May I lift it now?",
)
NEXT_QUESTIONS = ("What should I do next?", "What next?", "Which step comes next?", "What now?")
DEPTH_QUESTIONS = ("How deep is it?", "What is the depth?", "How far is it pressed in?")

_BAND = "(the band|the force band|the wanted range|the goal|the contract|the target range)"
_GRIP = "the (grip|force|grip force|squeeze|hold) [on {body}]"


def _conditional(
    *slots: str, default: str = "", denied: bool = False
) -> Callable[[Bindings, Numbers], Check]:
    """A condition by the value of the first slot that a wording has."""

    def build(bindings: Bindings, _: Numbers) -> Check:
        name = next((bindings[slot] for slot in slots if slot in bindings), default)
        return check_of(f"force {name}", denied=denied, length=length_of(bindings))

    return build


def _safe(*, denied: bool) -> Callable[[Bindings, Numbers], Check]:
    return lambda bindings, _: check_of("force within", denied=denied, length=length_of(bindings))


def _slipping(bindings: Bindings, numbers: Numbers) -> Check:
    mass = f"{number_text(numbers['m'])} {bindings['unit']}" if "m" in numbers else GIVEN
    fate = next(bindings[slot] for slot in ("fall", "keep", "firm") if slot in bindings)
    return check_of(f"{fate} {mass}", length=length_of(bindings))


def _choose_mass(
    scene: AskedScene, bindings: Bindings, rng: np.random.Generator
) -> Mapping[str, str]:
    if "unit" not in bindings:
        return {}
    holds = scene.values()["holds_g"]
    middle = float(holds) if isinstance(holds, float) and holds > 1 else 40.0
    grams = middle * float(np.exp(rng.choice([-1, 1]) * rng.uniform(0.15, 0.9)))
    if bindings["unit"] == "kg":
        return {"m": number_text(max(0.01, round(grams / 1000, 2)))}
    step = 5 if grams > 30 else 1
    return {"m": number_text(max(1, step * round(grams / step)))}


_WHY_LAST = (
    "why|why so|why that|why is that|how so|what is the reason|for what reason|"
    "why do you say (that|so)|what is that based on|how do you know [that]|"
    "(can|could) you explain [that|why]|explain that|please explain|tell me why|what for|"
    "what tells you (that|so)|why do you think (that|so)|give me the reason|because of what|"
    "why not something else|I don't see why|and the reason|may I ask why|how did you decide that|"
    "and why|but why|ok, why|why would that be|what is the cause|what led you to that|"
    "what makes you (think|believe) that|where does that come from"
)

FAMILIES: tuple[QuestionFamily, ...] = (
    QuestionFamily(
        name="force_band",
        pattern=check_pattern(
            _GRIP,
            "{state}",
            "do we (hold|grip|squeeze) {thing} {manner}|is {thing} (held|gripped|squeezed) {manner}|"
            "does the (grip|force) (fit|meet|match) " + _BAND,
        ),
        build=_conditional("state", "manner", default="within"),
        slots={
            "state": {
                "within": f"(within {_BAND}|inside {_BAND}|as it should be|right for {{body}}|"
                f"in line with {_BAND})",
                "below": f"(below {_BAND}|too (light|weak|loose|low|gentle) [for {{body}}])",
                "above": f"(above {_BAND}|too (firm|strong|tight|high|hard) [for {{body}}])",
                "enough": "((strong|firm|tight) enough [for {body}]|sufficient [for {body}])",
            },
            "manner": {
                "enough": "(tightly|firmly|strongly) enough",
                "below": "too (loosely|lightly|weakly|softly|gently)",
                "above": "too (tightly|firmly|hard|strongly)",
            },
        },
    ),
    QuestionFamily(
        name="not_force_band",
        pattern=denied_pattern(_GRIP, "{state}"),
        build=_conditional("state", denied=True),
        slots={
            "state": {
                "within": f"(within {_BAND}|inside {_BAND}|right for {{body}})",
                "below": "too (light|weak|loose|low) [for {body}]",
                "above": "too (firm|strong|tight|high|hard) [for {body}]",
                "enough": "(strong|firm|tight) enough [for {body}]",
            }
        },
    ),
    QuestionFamily(
        name="force_limit",
        pattern=check_pattern(
            "the ([contact|grip] force|grip|load|squeeze)",
            "{side} the [hard|force] limit [of the contract]",
            "do we {keep} the [hard|force] limit|did we {keep} the [hard|force] limit",
        ),
        build=_conditional("side", "keep"),
        slots={
            "side": {
                "over": "(above|over|beyond|past|higher than)",
                "under": "(below|under|within|lower than|inside)",
            },
            "keep": {
                "over": "(exceed|break|pass|violate|overstep|go over)",
                "under": "(keep to|respect|observe|stay below|keep below|stay under)",
            },
        },
    ),
    QuestionFamily(
        name="force_band_word",
        pattern=amount_pattern(
            "is the (force|grip) (too light, right or too firm|below, within or above "
            + _BAND
            + ")|"
            "how does the (force|grip) compare with " + _BAND + "|"
            "on which side of " + _BAND + " is the (force|grip)|"
            "is the (force|grip) below or above " + _BAND,
            "how the (force|grip) compares with " + _BAND + "|"
            "on which side of " + _BAND + " the (force|grip) is|"
            "whether the (force|grip) is below, within or above " + _BAND,
            "the (force|grip) (against|compared with|in relation to) " + _BAND,
            "",
        ),
        build=lambda bindings, _: Which(name="force_band", length=length_of(bindings)),
    ),
    QuestionFamily(
        name="safe",
        pattern=check_pattern(
            "it|it already|the grip|the situation",
            "safe (to lift|for lifting|for a lift) [{thing}]",
            "(can|may|could|should) (we|I|the robot) [now|already|safely] lift {thing}|"
            "(can|could) {thing} be lifted [safely|now|already]|is {thing} ready to be lifted|"
            "is the (grip|grasp|hold) (good|fine|secure|right) [enough to lift {thing}]|"
            "are we (ready|fine|clear) to lift [{thing}]|would lifting [{thing}] be safe|"
            "is lifting [{thing}] safe|is {thing} (held|gripped) well enough to lift [it]",
        ),
        build=_safe(denied=False),
    ),
    QuestionFamily(
        name="not_safe",
        pattern=denied_pattern("it", "safe (to lift|for lifting|to raise|to pick up) [{thing}]"),
        build=_safe(denied=True),
    ),
    QuestionFamily(
        name="slip",
        pattern=(
            "{lead} ( (will|would|could|does|might) {thing} {fall} {weight} {tail} [, {length}] ? "
            "| {whether} {thing} (will|would) {fall} {weight} {tail} [, {length}] [?] "
            "| {weight} , (will|would|does) {thing} {fall} {tail} [, {length}] ? "
            "| (will|would|can) (the grip|this grip|the force|our grip) {keep} {weight} {tail} ? "
            "| {whether} (the grip|this grip|the force) (will|can|does) {keep} {weight} {tail} [?] "
            "| is the (grip|force) {firm} {weight} {tail} [, {length}] ? )"
        ),
        build=_slipping,
        slots={
            "fall": {
                "slips": "(slip|fall|slide|drop out|slip out|slip away|slide out|get lost|fall down)",
                "stays": "(stay|hold|stay in place|stay put|remain held)",
            },
            "keep": {
                "stays": "(hold|carry|keep|hold on to|bear|secure) {thing}",
                "slips": "(lose|drop|let go of) {thing}",
            },
            "firm": {
                "stays": "(strong|firm|tight) enough for {thing}",
                "slips": "too (weak|loose|light) for {thing}",
            },
            "weight": (
                "(at (this|its|the given) (weight|mass)|with (this|its) (weight|mass)|"
                "given its (weight|mass)|at {#m} {unit}|if it weighs {#m} {unit}|"
                "with a (weight|mass) of {#m} {unit}|when it weighs {#m} {unit}|"
                "should it weigh {#m} {unit}|if its mass is {#m} {unit})"
            ),
            "unit": {"g": "(g|grams|gram)", "kg": "(kg|kilograms)"},
        },
        choose=_choose_mass,
    ),
    QuestionFamily(
        name="next",
        pattern=amount_pattern(
            "what (should|shall|must|can|could|do) (I|we|the robot) do (next|now|about {thing}|"
            "with {thing})|what (next|now)|what is the next (step|action|move)|"
            "what (comes|is|happens) next|which (step|action|move) (comes next|is next|is best|"
            "do you advise|do you suggest|would you take|should we take)|what do you (advise|suggest|"
            "recommend|propose)|what would you do (next|now|with {thing})|how (should|shall) we "
            "(proceed|continue|go on)|what has to be done [next]|should we move, squeeze or lift|"
            "do we grip harder or softer or move|what must be (changed|corrected|done)",
            "what (I|we|the robot) (should|must|can) do (next|now)|what to do (next|now|about {thing}|"
            "with {thing})|what comes next|which (step|action|move) (is next|is best|you advise)|"
            "how to (proceed|continue|go on)|what you (advise|suggest|recommend)",
            "the (next|best|right) (step|action|move|thing to do)|your (recommendation|suggestion|"
            "proposal)|a (recommendation|suggestion) for the next step|the next (command|order)",
            "",
        ),
        build=lambda bindings, _: Which(name="action", length=length_of(bindings)),
    ),
    QuestionFamily(
        name="why_next",
        pattern=(
            "{lead} ( what (should|shall|must) (I|we) do (next|now) (and why|, and for what reason|"
            "and what is the reason) {tail} ? | which (step|action|move) (is next|is best|do you "
            "advise) (, and why|and for what reason) {tail} ? | {want} the (next|best) (step|action|"
            "move) (and the reason|with the reason|and why|with an explanation) {tail} [?] "
            "| what do you (advise|suggest|recommend) (and why|, with the reason) {tail} ? "
            "| {ask} what to do (next|now) and why {tail} [?] )"
        ),
        build=lambda *_: Why(with_action=True),
    ),
    QuestionFamily(
        name="why_bad",
        pattern=(
            "{lead} ( what is (wrong|amiss|not right|the matter|the problem) with (the|this|our) "
            "(grip|hold|force|position|contact) {tail} [?] | why (can we not|can't we|should we not) "
            "lift {thing} [yet] {tail} ? | what (keeps|stops|prevents) us from lifting {thing} {tail} ? "
            "| is (anything|something) wrong with the (grip|hold) , and what {tail} ? "
            "| {ask} what is (wrong|amiss) with the (grip|hold|contact) {tail} [?] "
            "| what (must|should) be better (about|in) the (grip|hold) {tail} ? )"
        ),
        build=lambda *_: Why(),
    ),
    QuestionFamily(
        name="why_after_next",
        pattern=f"{{lead}} ({_WHY_LAST}) {{tail}} [?]",
        build=lambda *_: Why(),
        before=NEXT_QUESTIONS,
    ),
    QuestionFamily(
        name="why_after_safe",
        pattern=f"{{lead}} ({_WHY_LAST}) {{tail}} [?]",
        build=lambda *_: Why(shows=("force_band",)),
        before=SAFE_QUESTIONS,
    ),
)
