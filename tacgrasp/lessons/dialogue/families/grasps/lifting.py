"""Families about what happens when it is lifted: whether it is safe, and whether it slips."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from tacgrasp.lessons.dialogue.conditions import GIVEN, check_of, number_text
from tacgrasp.lessons.dialogue.families.grasps.force import asked_or_stated, conditional
from tacgrasp.lessons.dialogue.meaning import Check
from tacgrasp.lessons.dialogue.patterns.family import (
    Bindings,
    Numbers,
    QuestionFamily,
    length_of,
)
from tacgrasp.lessons.dialogue.scene import AskedScene

_LIFT = (
    "(lift {thing} [up|now|off the (table|tray|bench)]|lift {thing}|pick {thing} up|"
    "pick up {thing}|raise {thing}|hoist {thing}|take {thing} up|pull {thing} up|"
    "raise the (arm|hand|gripper) [now]|lift the (arm|hand|gripper)|carry {thing} [away|off]|"
    "start (lifting|the lift)|begin (lifting|the lift)|go ahead and lift [{thing}]|"
    "go ahead with the lift|lift|lift off|heave {thing} up|hoick {thing} up|elevate {thing}|take off|go up|ascend|"
    "send {thing} up|boost {thing} up|scoop {thing} up|snatch {thing} up|bring {thing} up|lift [{thing}] now)"
)
_LIFTING = (
    "(lifting {thing} [up|now]|lifting [{thing}]|raising {thing}|picking {thing} up|"
    "picking up {thing}|hoisting {thing}|raising the (arm|hand|gripper)|a lift|the lift|"
    "carrying {thing} [away])"
)
_LIFTED = "(lifted [up|off]|raised|picked up|hoisted|carried [away]|taken up)"
_WE = "(we|I|you|we|the robot|the arm|the gripper)"
_HOLD = "(grip|grasp|hold)"
_SAFE = "(safe|safe|OK|okay|all right|fine|wise|sensible|a good idea|advisable|possible)"
_GOOD = "(good|fine|secure|stable|right|OK|okay|safe|solid|reliable|all right|in order|sound|trustworthy)"
_READY = "(ready|fine|clear|good|OK|okay|all set|set|cleared|safe)"
_RISKY = (
    "(risky|[too] risky|[too] dangerous|unsafe|unwise|a bad idea|too early|too soon|premature|"
    "a risk|a mistake|reckless|foolish|hazardous|asking for trouble)"
)
_BAD = "(bad|unsafe|insecure|poor|wrong|unreliable|shaky|off|dodgy|unsound|no good)"

_MASS = "({#m} {unit}|{#m} {unit}|{#m} {unit}|{fixed})"
_KNOWN = (
    "((this|its|the given|that|the stated|the known|its own) (weight|mass)|the (weight|mass) "
    "(we (told|gave) you|I (told|gave) you|you (know|were told|were given)|that is given|I "
    "mentioned))"
)
_WHEN_LIFTED = (
    "[when (lifted|(we|I) lift [it]|it is lifted)|if (lifted|(we|I) lift [it]|we raise it|"
    "we pick it up|I raise the arm)|once lifted|on the way up|during the lift|when we go up]"
)
_SLIP = (
    "(slip|slip|fall|slide|drop out|slip out|slip away|slide out|get lost|fall down|drop|fall out|"
    "slip through|slip off|slide away|slide down|get away|slip from the (fingers|gripper|grip)|"
    "come loose|escape|skid|slither|wriggle out|tumble|plummet|plop down|budge|creep out|squirm out|slide through the fingers|fall out of the (gripper|hand|fingers))"
)
_STAY = (
    "(stay|hold|stay in place|stay put|remain held|stay (in the (grip|gripper|hand|fingers)|put)|"
    "remain in place|hold fast|cling on|hang on|stick|survive|stay on board|hang in there|stay where it is|stay held|remain put)"
)
_SLIPPING = "(slipping|falling|sliding [out]|dropping|slipping (out|away|off))"
_HOLDER = (
    "(the grip|this grip|the force|our grip|the hold|the gripper|the grasp|the squeeze|this force|"
    "this much force|the pinch|this hold)"
)
_LOSE = "(lose|lose|drop)"
_CARRY = "(hold|carry|keep|hold on to|bear|secure|support|lift|take|manage|hold up|cope with)"
_MIGHT = "(will|would|could|does|might)"

_FATE_SLOTS = (
    *("fall", "unfall", "keep", "carry", "bear", "keeps", "firm", "danger", "sure", "enough"),
    *("losing", "heavy", "more", "harder", "without", "hold"),
)
"""Slots that name what becomes of the object."""


def _slipping(bindings: Bindings, numbers: Numbers) -> Check:
    mass = GIVEN
    if "m" in numbers:
        mass = f"{number_text(numbers['m'])} {bindings['unit']}"
    elif "fixed" in bindings:
        mass = bindings["fixed"]
    fate = next(bindings[name] for name in _FATE_SLOTS if name in bindings)
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


FAMILIES: tuple[QuestionFamily, ...] = (
    QuestionFamily(
        name="safe",
        pattern=asked_or_stated(
            f"(is|is|isn't) it [already|now] ({_SAFE} to {_LIFT}|(safe|fine|OK) for (lifting|a "
            f"lift))|"
            f"(can|may|could|should|shall|can|can't) {_WE} [now|already|safely|just] {_LIFT}|"
            f"do (we|I) {_LIFT}|would you {_LIFT}|"
            f"(can|may|could) {_WE} {_LIFT} [now] without (harm|damage|harming {{thing}}|damaging "
            f"{{thing}}|risk|danger|any risk|worry|trouble)|"
            f"(can|could|may|should) {{thing}} be [safely|now|already] {_LIFTED}|"
            f"is {{thing}} (ready|safe|good|OK) (to be {_LIFTED}|for lifting|for a lift|to lift)|"
            f"is (the|our|this|my) {_HOLD} {_GOOD} [enough] [to {_LIFT}|for lifting|for the lift]|"
            f"is (the|our|this) {_HOLD} [on {{body}}] {_GOOD}|is this a {_GOOD} {_HOLD}|"
            f"do we have a (good|safe|secure|solid|reliable|proper) {_HOLD} [on {{thing}}]|"
            f"(have we|we have) got a (good|safe|secure|proper) {_HOLD} [on {{thing}}]|"
            f"(are we|am I|is the robot) {_READY} (to {_LIFT}|for the lift|for lifting|for takeoff|"
            "for lift-off)|(are we|am I|is it|is everything) good to go|are we good|"
            "(can|may|could) (we|I) go [ahead]|"
            "is {thing} (secure|securely held|safe|safe and secure) [in the (grip|gripper|hand|"
            "fingers)]|"
            f"(would|will) {_LIFTING} be {_SAFE}|is {_LIFTING} [already|now] {_SAFE}|"
            f"would it be {_SAFE} to {_LIFT}|is it time to {_LIFT}|"
            f"is {{thing}} (held|gripped|grasped) (well|securely|safely) enough to "
            f"(lift [it]|be {_LIFTED}|carry [it])|"
            f"(do I|do we) have (the green light|the go-ahead|clearance|your OK|permission) "
            f"(to {_LIFT}|for the lift|for lifting)|do you (allow|permit|approve|recommend) "
            f"{_LIFTING}|"
            f"does the {_HOLD} (allow|permit) {_LIFTING}|does the {_HOLD} (feel|seem|look) {_GOOD}|"
            "is (everything|all|it all) (fine|OK|okay|good|all right|as it should be|under control)|"
            "can the lift (start|begin)|is everything (ready|fine|OK|in order|set) (to lift|for "
            "the "
            "lift|for lifting)|are we all set|is {thing} safely (held|gripped|in the gripper)|"
            f"is (now|this) (a good|the right) (time|moment) to {_LIFT}|"
            f"(will|would) it be (fine|OK|safe) if (I|we) {_LIFT}|does it (look|seem) safe to "
            f"{_LIFT}|"
            f"(am I|are we) allowed to {_LIFT}|(can|may) I have (a|the) go for (lifting|the lift)",
            f"it is {_SAFE} to {_LIFT}|it is safe for lifting|(we|I|you|the robot) (can|may|could|"
            f"should) "
            f"[now|already|safely] {_LIFT}|{{thing}} (can|may) [safely|now] be {_LIFTED}|"
            f"{{thing}} is ready (to be {_LIFTED}|for lifting)|the {_HOLD} is {_GOOD} [enough to "
            f"lift]|"
            f"we are {_READY} (to {_LIFT}|for the lift|for lifting)|we have a (good|safe|secure) "
            f"{_HOLD} [on {{thing}}]|{_LIFTING} (is|would be) {_SAFE}|we are good to go|"
            f"the {_HOLD} (feels|seems|looks) {_GOOD}|{{thing}} is safely (held|gripped)",
            f"(everything|all) (fine|OK|okay|good|all right|under control)|thumbs up for lifting|are we golden|up up and away|liftoff|lift-off|shall we|up we go|let us lift [it]|"
            f"cleared for (lift-off|takeoff|lifting)|all systems go|good to go|ready for (takeoff|lift-off|lifting|the lift|a lift)|ready to {_LIFT}|"
            f"{_SAFE} to {_LIFT}|all (set|clear|good) (to {_LIFT}|for lifting|for the lift)|"
            f"clear to {_LIFT}|green light (to lift|for lifting|for the lift)|{_HOLD} {_GOOD}|"
            f"permission to {_LIFT}|lift [it|this|that] [now]|lift or not|go for (lift|lifting|"
            f"the lift)|safe for lifting|"
            f"lift , yes or no|safe or not|safe [now]|{_HOLD} (good|secure) enough to lift",
        ),
        build=conditional(default="within"),
    ),
    QuestionFamily(
        name="not_safe",
        pattern=(
            f"{{lead}} ( is it not [yet] (safe|wise|advisable|OK) (to {_LIFT}|for lifting) "
            f"| (is|would) it [be] {{risk}} | (is it|would it be) {_RISKY} to {_LIFT} "
            f"| (would|will) {_LIFTING} be {_RISKY} | is {_LIFTING} [still] {_RISKY} "
            f"| is there (a|any) (risk|danger) (in {_LIFTING}|if (we|I) {_LIFT}) "
            f"| is the {_HOLD} not [yet] {_GOOD} [enough] [to lift|for lifting] "
            f"| is (the|our|this) {_HOLD} {_BAD} | is this (a (bad|poor|dodgy|shaky)|an (unsafe|"
            f"insecure)) {_HOLD} "
            f"| (is|isn't) (something|anything) (wrong|amiss|not right|off) "
            f"| are we not [yet] ready to {_LIFT} | is {{thing}} not [yet] ready to be {_LIFTED} "
            f"| (should|must|shall) (we|I) (wait|hold off) (before lifting|with {_LIFTING}|"
            f"before we {_LIFT}) | should (we|I) (avoid|refrain from|hold back from) {_LIFTING} "
            f"| should (we|I) (rather|better) not {_LIFT} | do you (advise|warn) against "
            f"{_LIFTING} "
            f"| is there anything (against|that speaks against) {_LIFTING} "
            f"| does anything (speak against|forbid|prevent) {_LIFTING} "
            f"| [are there|is there|do you have] any (objection|objections) to {_LIFTING} "
            f"| do we risk (something|anything|trouble|an accident) (by {_LIFTING}|if we {_LIFT}) "
            f"| (am I|are we) taking a risk (by {_LIFTING}|if (I|we) {_LIFT}) "
            f"| ({{whether}}|[{{believe}}]) ( it (is not|isn't) [yet] (safe|wise|OK) (to {_LIFT}|"
            f"for "
            f"lifting) | it (is|would be) {_RISKY} to {_LIFT} | {_LIFTING} (is|would be) {_RISKY} "
            f"| the {_HOLD} is {_BAD} | the {_HOLD} is not [yet] {_GOOD} [enough to lift] "
            f"| we (should|must) not {_LIFT} [yet] | (we|I) (should|must) (wait|hold off) before "
            f"lifting "
            f"| we (are not|aren't) ready to {_LIFT} ) "
            "[, right|, is that right|, am I right|, true or false|, correct] "
            f"| {_RISKY} to {_LIFT} | {_LIFTING} , {_RISKY} | not [yet] (safe|ready) to {_LIFT} ) "
            f"{{tail}} "
        ),
        build=conditional(default="within", denied=True),
        slots={"risk": "(too risky|too dangerous) to lift [{thing}]"},
    ),
    QuestionFamily(
        name="slip",
        pattern=(
            f"{{lead}} ( {_MIGHT} {{thing}} {{fall}} {_WHEN_LIFTED} {{weight}} {{tail}} [, "
            f"{{length}}] ? "
            f"| (won't|wouldn't) {{thing}} {{fall}} {{weight}} {{tail}} ? "
            f"| is {{thing}} going to {{fall}} {_WHEN_LIFTED} [{{weight}}] {{tail}} [, "
            f"{{length}}] ? "
            "| (will|would|does) {thing} {unfall} {weight} {tail} ? "
            "| ({whether}|[{believe}]) {thing} (will|would) {unfall} {weight} [{tag}] [?] "
            f"| (will|would|could|does) {{thing}} {{fall}} {_WHEN_LIFTED} {{tail}} [, {{length}}] "
            f"? "
            "| {whether} {thing} (will|would) {fall} {weight} {tail} [, {length}] [?] "
            f"| [{{believe}}] {{thing}} (will|would|is going to) {{fall}} [{_WHEN_LIFTED}] "
            f"{{weight}} "
            "[{tag}] [?] | {weight} , (will|would|does) {thing} {fall} {tail} [, {length}] ? "
            "| (will|would|can|could|does) (a|a|an|this|my|the) {load} {fall} {tail} [, {length}] "
            "? "
            "| (will|would|can|could|does) (a|a|an|this|my|the) {load} {fall} in (the|our|this) "
            "grip ? "
            f"| (will|would|can|could|does) {_HOLDER} {{keep}} {{thing}} {{weight}} {{tail}} ? "
            f"| (will|would|can|could|does) {_HOLDER} {{carry}} {_MASS} {{tail}} [, {{length}}] ? "
            f"| (will|would|can|could|do) (we|I|you|the fingers|the jaws) {{carry}} {_MASS} "
            f"{{tail}} ? "
            f"| (will|would|can|could|does) it {{carry}} {_MASS} {{tail}} [, {{length}}] ? "
            f"| (will|would|can|could) (we|I|the robot) {{keep}} (a|this|the) {{load}} "
            "{tail} [, {length}] ? | (will|could) {thing} {fall} (if|when) it "
            f"(weighs|is|weighed) {_MASS} {{tail}} ? "
            f"| {{whether}} {_HOLDER} (will|can|does) {{keep}} {{thing}} {{weight}} {{tail}} [?] "
            f"| ({{whether}}|[{{believe}}]) {_HOLDER} (will|can|could) {{carry}} {_MASS} "
            f"[{{tag}}] [?] "
            f"| (will|would|could|might|do) (we|I|you|the robot) {{losing}} {{weight}} {{tail}} "
            f"[?] "
            f"| (will|would|could|might) (we|I) {{losing}} {_WHEN_LIFTED} {{tail}} ? "
            "| {weight} , (will|would|do) (we|I|the fingers) {losing} {tail} ? "
            "| (can|could|may) (we|I) (lift|raise|carry|pick up) {thing} {without} [{weight}] "
            "{tail} ? "
            "| is the (grip|force|hold) {firm} {thing} {weight} {tail} [, {length}] ? "
            f"| is the (grip|force|hold|squeeze) {{firm}} ([a load of] {_MASS}|a {{load}}) "
            f"{{tail}} ? "
            f"| is (this|that|it|(this|that|the) (grip|force|hold)) {{enough}} ({_MASS}|a {{load}}) {{tail}} [, "
            f"{{length}}] ? "
            f"| is (there|there a|there any) {{danger}} {{weight}} {{tail}} ? "
            f"| is there (a|any|some) {{danger}} {{tail}} ? | {{danger}} {{weight}} {{tail}} [?] "
            "| {sure} {weight} {tail} ? | {sure} {tail} ? | {fall} or not {weight} ? "
            f"| (will|would|can|could|do) {_MASS} {{fall}} [in (this|the|our) grip] {{tail}} ? "
            f"| (will|would) {_HOLDER} be (enough|strong enough|sufficient|firm enough) for "
            f"({_MASS}|"
            "a {load}|{thing} {weight}) {keeps} {tail} ? "
            f"| (is|are|would) {_MASS} [be] {{heavy}} {{tail}} ? | is a {{load}} {{heavy}} "
            f"{{tail}} ? "
            "| is {thing} {heavy} [{weight}] {tail} ? | ({whether}|[{believe}]) {thing} is {heavy} "
            "{weight} {tail} [?] "
            f"| (do|would) we need {{more}} (for|to (hold|carry|lift)) ({_MASS}|a {{load}}) "
            f"{{tail}} ? "
            f"| (do|must|would) (we|I) (have|need) to {{harder}} (for|to (hold|carry|lift)) ({_MASS}|a "
            f"{{load}}) {{tail}} ? "
            f"| (do|does) (the grip|this grip) suffice for ({_MASS}|a {{load}}) {{keeps}} "
            f"{{tail}} ? "
            f"| (good|strong enough|enough|enough grip|enough force) for {_MASS} {{keeps}} "
            f"{{tail}} ? "
            f"| {_MASS} , (will|would|can|does) (it|{{thing}}) {{fall}} {{tail}} ? "
            f"| (can|could) (we|I|it|this|the robot|the grip|this grip) {{hold}} (a|an) {{*objects}} (of|weighing) {_MASS} {{tail}} ? "
            f"| (can|could|may) (we|I) {{bear}} {_MASS} (with (that|this|it)|like (that|this)) {{tail}} ? "
            f"| (will|would|could|might) (something|a thing|an object|a load) (weighing|of) {_MASS} {{fall}} {{tail}} ? "
            f"| {_MASS} , (can|could|will) (we|it|the grip) {{bear}} (it|that) {{tail}} ? "
            f"| (suppose|say|imagine|assume|if) {{thing}} (weighs|weighed|is|has) {_MASS} , "
            "(will|would|does) it {fall} {tail} ? "
            "| with {body} (weighing|at) {#m} {unit} , (will|would) it {fall} {tail} ? )"
        ),
        build=_slipping,
        slots={
            "fall": {"slips": _SLIP, "stays": _STAY},
            "unfall": {"stays": f"not {_SLIP}", "slips": f"not {_STAY}"},
            "keep": {"stays": _CARRY, "slips": "(lose|drop|let go of)"},
            "carry": {"stays": _CARRY},
            "bear": {"stays": _CARRY},
            "hold": {"stays": "(hold|carry|keep|bear|lift)"},
            "keeps": {"stays": ""},
            "firm": {
                "stays": "(strong|firm|tight|good) enough for",
                "slips": "too (weak|loose|light|low|soft) for",
            },
            "heavy": {
                "slips": "(too (heavy|much) [for (this grip|the grip|our grip|this force|this "
                "hold)]|"
                "more than (this|the|our) grip can (hold|carry|take|bear)|too heavy to (hold|"
                "carry))",
                "stays": "(light enough (for (this|the|our) grip|for this force|to hold)|"
                "within what (this|the|our) grip can (hold|carry|bear))",
            },
            "without": {
                "stays": "without (dropping|losing) (it|{thing})|without it (slipping|falling)"
            },
            "more": {
                "slips": "(more force|a (firmer|tighter|stronger) (grip|hold)|more grip|"
                "to (grip|squeeze|hold) harder|to tighten [the grip])"
            },
            "harder": {
                "slips": "(grip|squeeze|press|hold) (harder|tighter|more|more firmly|[it] firmer)"
            },
            "enough": {
                "stays": "(enough|sufficient|adequate|up to) (for|to (hold|carry|lift))",
                "slips": "(too little|not enough) (for|to (hold|carry|lift))",
            },
            "losing": {"slips": f"{_LOSE} {{thing}}", "stays": "(keep hold of|hold on to) {thing}"},
            "danger": {
                "slips": f"(risk|danger|chance) (of {{thing}} {_SLIPPING}|of {_SLIPPING}|of a slip|"
                "that {thing} (slips|falls|slides|drops|slips out|gets lost|will slip))"
            },
            "sure": {
                "stays": "(is {thing} (sure|certain|guaranteed) not to slip|is it sure not to slip|"
                "is {thing} (safe|secure) from (slipping|falling)|are you sure {thing} will not "
                "(slip|fall|drop)|are you sure {thing} (stays|holds|will stay|will hold))",
                "slips": f"(is {{thing}} (likely|about|bound|going|sure|certain|liable) to {_SLIP}|"
                f"is {{thing}} in danger of {_SLIPPING}|are we (likely|about|bound) to {_LOSE} "
                f"{{thing}})",
            },
            "load": (
                f"({{#m}} {{unit}} ({{*objects}}|{{*objects}}|{{*materials}} {{*objects}}|load|"
                f"thing|"
                f"object|part|weight)|(load|weight|mass|thing|part) of {_MASS}|"
                f"{{*objects}} (of|weighing|that weighs|with) {_MASS})"
            ),
            "weight": (
                f"(at {_KNOWN}|with {_KNOWN}|under {_KNOWN}|given {_KNOWN}|"
                "as heavy as it is|given (what|how much) it weighs|knowing (its weight|how heavy "
                "it is)|"
                f"at {_MASS}|at {_MASS}|if it (weighs|is|weighed) {_MASS}|if {{thing}} (weighs|"
                f"weighed|is) {_MASS}|with {_MASS}|"
                f"with a (weight|mass|load) of {_MASS}|when it (weighs|is) {_MASS}|"
                f"should it weigh {_MASS}|if its (weight|mass) is {_MASS}|weighing {_MASS}|"
                f"under a load of {_MASS}|given (a weight of|a mass of) {_MASS}|"
                f"(supposing|assuming|provided) [that] it weighs {_MASS}|at a (weight|mass) of "
                f"{_MASS})"
            ),
            "unit": {"g": "(g|g|grams|gram)", "kg": "(kg|kilograms|kilos|kilo)"},
            "fixed": {
                "0.5 kg": "(half a (kilo|kilogram|kg))",
                "1 kg": "((a|one) (kilo|kilogram))",
                "2 kg": "two (kilos|kilograms)",
                "100 g": "(a|one) hundred grams",
                "200 g": "two hundred grams",
                "50 g": "fifty grams",
                "20 g": "twenty grams",
                "30 g": "thirty grams",
                "10 g": "ten grams",
            },
        },
        choose=_choose_mass,
    ),
)
