"""Families about several things at once, and about what follows another question.

Not here: phrases for each of these things (``tacgrasp.lessons.dialogue.families.contacts.parts``), and
each of them asked alone (the other modules of this folder).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping

from tacgrasp.lessons.dialogue.families.contacts.parts import (
    INDIRECT,
    NOUNS,
    QUESTIONS,
    SLOTS,
    UNITS,
    Part,
    asked,
    different,
    in_both,
    in_other,
)
from tacgrasp.lessons.dialogue.families.grasps.force import DEPTH_QUESTIONS
from tacgrasp.lessons.dialogue.patterns.family import QuestionFamily

_PAIRS: Mapping[str, str] = {
    "amount x mm; amount y mm": "(x and y|[the|its] coordinates [of {touch}]|both coordinates|"
    "the x and y (coordinates|values|position)|the x y position|the exact coordinates|"
    "the horizontal and [the] vertical (position|coordinates)) [in (mm|millimetres)]",
    "amount band_low N; amount band_high N": "(both ends of the [force] band|the (ends|bounds|"
    "limits) "
    "of the [force] band|the least and [the] most force wanted|"
    "the lower and [the] upper end of the [force] band|"
    "the (target|wanted|allowed) forces) [in (newtons|N)]",
}

_PAIR_QUESTIONS: Mapping[str, str] = {
    "word shape; word texture": "(what|which) (shape and [what|which] texture|form and surface) "
    "(is {thing}|does {thing} have|do you feel)",
    "word texture; word shape": "(what|which) (texture and [what|which] shape|surface and form) "
    "(is {thing}|does {thing} have|do you feel)",
    "choice side_x; choice side_y": "(left or right|right or left) [of the (center|middle)] [,] and ([towards] the palm or [towards] "
    "the (tip|fingertip)|palm or (tip|fingertip)|up or down|above or below [the middle])",
    "amount x mm; amount y mm": "(where exactly is {thing} in x and [in] y|what are its "
    "coordinates|"
    "at (what|which) (x and y|coordinates) (is {thing}|does it touch)|what is it in x and [in] y|"
    "how far is {thing} off in x and [in] y) [in (mm|millimetres)]",
    "amount band_low N; amount band_high N": "([what is|give me|tell me|show me] the [force|"
    "target|wanted|goal] (band|range)|what force is wanted|(between which|within what) "
    "forces should we stay) [in (newtons|N)]",
}
"""Questions for two amounts or words at once."""

_TELL = (
    "(tell me|please tell me|I want to know|can you tell me|could you tell me|I need to know|say|"
    "I would like to know|I'd like to know|do you know|we need to know|let me know|give me)"
)
_JOIN = "(and|, and|? and|and also|, and also|? also ,|, plus|? and then|? oh , and|, then|?|.|,)"

_REPLY = (
    "[ok,|okay,|good,|thanks,|right,|I see,|understood,|well,|alright,|great,|hm,|so,|fine,|"
    "thank you,|got it,|perfect,|noted,|cool,|sure,|aha,|oh,|nice,|please,|now,]"
)
_AFTER: tuple[str, ...] = (
    *DEPTH_QUESTIONS,
    "How deep is it in microns?",
    "What is the force?",
    "How hard is it held?",
    "What is the force in grams?",
    "How large is the contact?",
    "What is the mass?",
    "How far is it from the center?",
    "What is x?",
    "What is y?",
    "What is the force limit?",
    "How much force is left to the limit?",
    "What shape is it?",
    "What texture does it have?",
    "Where is it?",
    "Which depth class is it?",
    "Which area class is it?",
    "Is it safe to lift?",
    "Can we lift it?",
    "What should I do next?",
    "Is anything touching the pad?",
    "Is the pad empty?",
    "Is it cut off?",
    "Is it centered?",
    "Is it a sphere?",
    "Is the surface smooth?",
    "Is the grip too firm?",
    "Is the grip too weak?",
    "Is the force above the limit?",
    "Will it slip at this weight?",
    "Is it left of the middle?",
    "Is it left or right of the middle?",
    "Describe the contact.",
    "The depth and the force?",
    "What shape is it and what texture does it have?",
)
"""Questions that another one may follow."""

FORCE_QUESTIONS = (
    "What is the force?",
    "How hard is it held?",
    "How hard is it pressed?",
    "How strong is the grip?",
    "And the force?",
)
AREA_QUESTIONS = (
    "How large is the contact?",
    "What is the contact area?",
    "How much of the pad is covered?",
    "And the area?",
)
MASS_QUESTIONS = ("What is the mass?", "How heavy is it?", "How much does it weigh?")

_OF_FORCE: Mapping[str, str] = {
    "check force within": "(within|inside|in) the (band|range|goal|target range|force band)",
    "check force below": "(too (little|low|weak|light)|below the (band|range)|not enough)",
    "check force above": "(too (much|high|strong|firm|hard)|above the (band|range))",
    "check force enough": "(enough|sufficient|strong enough|high enough)",
    "check force over": "(over|above|beyond|past) the [force|hard] limit",
    "check force under": "(under|below|within) the [force|hard] limit",
}
"""What may be asked of a force that was just named."""

_CONVERSION = (
    "[and|but|now|then] in {unit} | [and|so] (what|how much) is (that|it) in {unit} | [and|so] "
    "(what|how much) would (that|it) be in {unit} "
    "| [and] how much is (that|it|this) in {unit} | [and] what about {unit} | [and] how about "
    "{unit} "
    "| (can|could|would) you (convert|turn|change|translate) (that|it|this) (to|into) {unit} "
    "| (convert|turn|change|translate) [(that|it|this)] (to|into) {unit} "
    "| [and] how many {unit} (is (that|it)|are (that|those)|would (that|it) be|does that make) "
    "| how many {unit} "
    "| [please] (give|tell) (me that|that|it|me it|me the same|us that|me) in {unit} "
    "| that in {unit} | (can|could|may) I (have|get|see) (that|it|this) in {unit} "
    "| make (that|it) {unit} | once more in {unit} | again in {unit} | [I] (prefer|want|need|"
    "meant|mean) "
    "(it in|that in|) {unit} | [the] same in {unit} | (say|put|express|repeat|show) (it|that) "
    "in {unit} "
    "| {unit} [instead|rather|please] | in {unit} instead "
    "| (I'd|I would) like (it|that) in {unit} | (what|which) (number|value) is that in {unit} "
    "| same (thing|value|number|question) [but] in {unit} | (what|how much) does that (make|"
    "come to) in "
    "{unit} | I asked for {unit} | do you have (that|it) in {unit} | (switch|change) to {unit} "
    "| [and] expressed in {unit} | [and] as {unit} | (what|how much) in {unit}"
)


def _in_units(
    name: str, quantity: str, units: Iterable[str], before: tuple[str, ...]
) -> QuestionFamily:
    """The number that was asked for, in another unit."""
    parts = {f"amount {quantity} {unit}": UNITS[unit] for unit in units}
    pattern = _CONVERSION.replace("{unit}", "{noun1}")
    return QuestionFamily(
        name=name,
        pattern=f"{_REPLY} ( {pattern} ) {{tail}} [, please] [?]",
        build=asked,
        slots={"noun1": parts},
        before=before,
    )


def _joined(name: str, pattern: str) -> QuestionFamily:
    return QuestionFamily(
        name=name,
        pattern=f"{{lead}} ( {pattern} ) {{tail}} [, please] [?]",
        build=asked,
        slots={**SLOTS, "join": _JOIN, "tell": _TELL, "claims": _CLAIMS_BOTH},
        steer=different,
    )


_CLAIMS_BOTH = (
    "(am I right that|is it true that|do you agree that|is it so that|would you agree that|"
    "is it correct that|can you confirm that|I think that|I guess that|I believe that)"
)
_LIST = (
    "([please] (report|list|name|give|state|say|tell me|note|log|read out)|(could|can|would) you "
    "[please] (give|list|name|report|state)|I (need|want|would like)|for the (record|log|report)|"
    "three things|the following)"
)
_ORDER = "(, in (this|that|exactly this) order|, one after the other|, in sequence)"
_WORDED = (
    "(in words only|only in words|in words|in words not numbers|no numbers|without numbers|as words|"
    "as classes|in your classes|by class|with your words|words only|no numbers please)"
)


def _amount_in(name: str, in_units: Callable[[Part], Mapping[str, str]]) -> QuestionFamily:
    """One amount, in the units that are put behind its phrases."""
    return QuestionFamily(
        name=name,
        pattern=(
            "{lead} ( [{want}] {pair} | {pair1} | {pair} | {ask} {pair2} ) {tail} [, please] [?]"
        ),
        build=asked,
        slots={
            "pair": in_units(NOUNS),
            "pair1": in_units(QUESTIONS),
            "pair2": in_units(INDIRECT),
        },
    )


_MORE = "(and|, and|plus|as well as|together with|along with|and also|,)"

FAMILIES: tuple[QuestionFamily, ...] = (
    _joined(
        "several",
        f"[{{want}}] {{noun1}} {_MORE} {{noun2}} | {{noun1}} and {{noun2}} "
        "| [{want}] {noun1} , {noun2} [,] and {noun3} | {noun1} , {noun2} , {noun3} "
        "| [{want}] (both|both|the following:|these two:) {noun1} and {noun2} "
        "| what are {noun1} and {noun2} | what are {noun1} , {noun2} and {noun3} "
        "| what is {noun1} and what is {noun2} | what is {noun1} and {noun2} "
        "| {want} {noun1} , and [also|then] {noun2} | first {noun1} , then {noun2} "
        "| [{want}] {noun1} and {noun2} and {noun3} | {ask} what {noun1} and {noun2} are | "
        "[{want}] {noun1} and {noun2} (both|too|as well|"
        "together)",
    ),
    _joined(
        "two_questions",
        "{asks1} {join} {asks2} | {asks1} {join} {is1} | {is1} {join} {asks1} | {is1} {join} {is2} "
        "| {asks1} and {asks2} | {asks1} and {is1} | first , {asks1} ? second , ({asks2}|{is1}) "
        "| {asks1} , {asks2} and {asks3} | {asks1} , {asks2} and {is1} | {asks1} ? {asks2} ? "
        "{asks3} "
        "| two (questions|things) : {asks1} and ({asks2}|{is1}) | {how1} and {how2} is {touch} "
        "[pressed|held|gripped] "
        "| {how1} , {how2} and {how3} is {touch} [pressed|held] | {asks1} and {how2} | {how1} "
        "and {how2} | {how1} , {how2} and {how3} | {asks1} {join} {how2} {join} {is1} | {is1} "
        "{join} {how1} | {how1} ? {how2} ? [{how3} ?] | {how1} , and {how2} | {noun1} ? and {asks2} "
        "| {noun1} ? {asks2} | {noun1} ? {is1} | {is1} ? {is2} | {asks1} , then {asks2}",
    ),
    _joined(
        "question_and_noun",
        "{asks1} {join} [what (is|about)] {noun2} | [{want}] {noun1} {join} {asks2} "
        "| [{want}] {noun1} {join} {is1} | {noun1} and {is1} | {is1} {join} [what (is|about)] "
        "{noun1} "
        "| [{want}] {noun1} and {noun2} {join} {is1} | {want} {noun1} , {noun2} and {is1} | "
        "{noun1} , {noun2} and {is1} | {asks1} , {noun2} and {is1} | {asks1} , with {noun2} "
        "| [{want}] {noun1} {join} (tell me|say|check|let me know) (whether|if) {if1} "
        "| {asks1} {join} (tell me|say|check|let me know) (whether|if) {if1} "
        "| {asks1} (and|, and) (give me|tell me|also) {noun2} "
        "| check (whether|if) {if1} and (give me|tell me|report) {noun1} "
        "| {want} {noun1} , {noun2} and (whether|if) {if1}",
    ),
    _joined(
        "told_together",
        "{ask} {told1} and {told2} | {ask} {told1} , {told2} and {told3} "
        "| {ask} {told1} and (whether|if) {if1} | {ask} (whether|if) {if1} and {told1} "
        "| {ask} (whether|if) {if1} and (whether|if) {if2} | {whether} {if1} and (that|"
        "whether) {if2} "
        "| {ask} {told1} and {noun2} | {tell} {noun1} and {told2} | {tell} {noun1} and (whether|"
        "if) {if1} "
        "| {ask} {told1} , {told2} and (whether|if) {if1} | {told1} and {told2} "
        "| {ask} {told1} (, then|and then|, and then|, and also|, and) {told2} | {ask} first {told1} "
        ", then {told2} | {ask} {told1} , then {noun2} | {claims} {if1} and [that] {if2} [, right|, "
        "correct] | {if1} and {if2} (, right|, correct|, am I right|, is that so|, true)",
    ),
    _joined(
        "classes_together",
        f"{_LIST} : {{named1}} , [and] {{named2}} [, [and] {{named3}}] [{_ORDER}] "
        f"| [{_LIST}] first {{named1}} , (then|next|after that|and then|second) {{named2}} [, (then|"
        "finally|last|lastly|and then|third) {named3}] "
        f"| [{_LIST}] {{named1}} , {{named2}} [and|,] {{named3}} [{_ORDER}] "
        f"| [{_LIST}] {{named1}} (and|then|, then|before) {{named2}} {_ORDER} "
        f"| [{_LIST}] [:] [the] {{class1}} (class|word|category) (and|,) [the] {{class2}} (class|word|"
        f"category) [(,|and) [the] {{class3}} (class|word|category)] [{_ORDER}] "
        f"| [{_LIST}] [the] (classes|words|categories) (of|for) {{class1}} (and|,) {{class2}} [and "
        f"{{class3}}] [{_ORDER}] | {{class1}} (class|word) and {{class2}} (class|word) "
        f"| {_WORDED} , {{degree1}} and {{degree2}} (is {{touch}}|is it|are we) "
        f"| {{degree1}} and {{degree2}} (is {{touch}}|is it) , {_WORDED} "
        f"| {_WORDED} , {{class1}} , {{class2}} [and {{class3}}] | {{class1}} and {{class2}} , {_WORDED} "
        f"| (which|what) {{class1}} class and (which|what) {{class2}} class (is it|does it have|has "
        "{thing}|do you feel) | (classify|categorise|label|grade|rate) [the] {class1} and [the] {class2} "
        "[in words]",
    ),
    QuestionFamily(
        name="pair",
        pattern="{lead} ( [{want}] {pair} | what are {pair} "
        "| {ask} what {pair} are | {pair1} "
        "| {pair} ) {tail} [, please] [?]",
        build=asked,
        slots={"pair": dict(_PAIRS), "pair1": dict(_PAIR_QUESTIONS)},
    ),
    _amount_in("both_units", in_both),
    _amount_in("other_unit", in_other),
    QuestionFamily(
        name="follow",
        pattern=(
            f"{_REPLY} ( and {{noun1}} | what about {{noun1}} | how about {{noun1}} "
            "| and what about {noun1} | and what is {noun1} | now {noun1} | then {noun1} | "
            "also {noun1} "
            "| {noun1} as well | {noun1} too | the same for {noun1} | and then {noun1} | next "
            ", {noun1} "
            "| (could|can|would) you add {noun1} | {noun1} next | and {noun1} then | {noun1} "
            "| (give|tell) me {noun1} (too|as well|also) | and how about {noun1} | I also "
            "(need|want) "
            "{noun1} | with {noun1} as well | do you also have {noun1} | while you are at it , "
            "{noun1} "
            "| (can|could) I (also|now) (have|get) {noun1} | what is {noun1} then | and what "
            "was {noun1} "
            "| and {asks1} | {asks1} | {is1} | {asks1} then | and {is1} | {is1} then | and "
            "{noun1} and {noun2} "
            "| what about {noun1} and {noun2} | and {told1} | and (whether|if) {if1} "
            "| also tell me {told1} | also (tell me|say) (whether|if) {if1} "
            "| same question for {noun1} | {noun1} also | and can you tell {noun1} "
            "| forget that , {noun1} | no , {noun1} | (I meant|I mean) {noun1} | rather {noun1} ) "
            "{tail} [, please] [?]"
        ),
        build=asked,
        slots={**SLOTS, "join": _JOIN, "tell": _TELL},
        steer=different,
        before=_AFTER,
    ),
    _in_units("follow_unit", "depth", ("µm", "mm", "cm"), DEPTH_QUESTIONS),
    _in_units("follow_unit_force", "force", ("N", "mN", "g"), FORCE_QUESTIONS),
    _in_units("follow_unit_area", "area", ("%", "mm²"), AREA_QUESTIONS),
    _in_units("follow_unit_mass", "mass", ("g", "kg"), MASS_QUESTIONS),
    QuestionFamily(
        name="follow_force",
        pattern=(
            f"{_REPLY} ( [and|so|but] is (that|this|it) {{is1}} | [and|so] (would you say|do "
            f"you think) "
            "(that|it) is {is1} | (that|it) is {is1} [{tag}] | {whether} (that|it) is {is1} "
            "| {is1} ) {tail} [?]"
        ),
        build=asked,
        slots={"is1": _OF_FORCE},
        before=FORCE_QUESTIONS,
    ),
    QuestionFamily(
        name="force_and_check",
        pattern=(
            "{lead} ( ([{want}] {noun1}|{asks1}|{noun1}) (and|, and|?|and also|, but) "
            "(is (it|that|this) {is1}|(would you say|do you think) (it|that) is {is1}) "
            "| ({ask} {told1}|(tell me|can you tell me|give me) {noun1}) and (whether|if) (it|"
            "that) is {is1} ) {tail} [?]"
        ),
        build=asked,
        slots={
            "is1": _OF_FORCE,
            **{
                kind: {part: said for part, said in SLOTS[kind].items() if " force " in part}
                for kind in ("noun1", "asks1", "told1")
            },
        },
    ),
)
