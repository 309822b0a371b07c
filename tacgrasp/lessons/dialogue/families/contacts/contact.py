"""Families about the contact itself: whether there is one, whether it is whole, and all of it.

Not here: where it lies (``tacgrasp.lessons.dialogue.families.contacts.sides``), several questions at once
and what follows another (``tacgrasp.lessons.dialogue.families.contacts.together``).
"""

from __future__ import annotations

from collections.abc import Callable

from tacgrasp.lessons.dialogue.conditions import check_of
from tacgrasp.lessons.dialogue.meaning import Check, Description, Which
from tacgrasp.lessons.dialogue.patterns.family import Bindings, Numbers, QuestionFamily, length_of
from tacgrasp.lessons.dialogue.patterns.phrases import denied_pattern


def _condition(*slots: str, denied: bool = False) -> Callable[[Bindings, Numbers], Check]:
    def build(bindings: Bindings, _: Numbers) -> Check:
        name = next(bindings[slot] for slot in slots if slot in bindings)
        return check_of(name, denied=denied, length=length_of(bindings))

    return build


def _one_of(name: str) -> Callable[[Bindings, Numbers], Which]:
    return lambda bindings, _: Which(name=name, length=length_of(bindings))


def _states(*states: tuple[str, str, str]) -> str:
    """Wordings that ask whether something is so, for each of some states.

    Args:
        states: Name of a slot that marks the state, questions without their question mark, and
            statements to be confirmed.
    """
    parts = [
        f"{{{name}}} ( ({direct}) | ({direct}) | {{whether}} ({statement}) "
        f"| [{{believe}}] ({statement}) [{{tag}}] )"
        for name, direct, statement in states
    ]
    return f"{{lead}} ( {' | '.join(parts)} ) {{tail}} [, {{length}}]"


_SOME = "(anything|something|an object|any object|anything at all|some object|a thing)"
_TOUCHED = (
    "(can you tell|tell me|check|do you know|let me know|I wonder|please say|see|find out|can "
    "you say) "
    "(whether|if) ({some} (touches|is touching|is on|is resting on|presses on) {pad}|there is "
    "{some})|"
    "is {some} (touching|pressing|pushing|making contact) [right now|now|here]|(have|did) we (actually|really|indeed) (got|get) hold of {some}|"
    "is {some} (brushing|grazing|bumping|nudging|tickling|rubbing) {pad}|"
    "any (sign|trace|hint|evidence|whiff) of (contact|touch|{some})|(did|do) we (bump into|run into|"
    "come across|hit upon) {some}|is {pad} (busy|engaged|occupied)|have the fingers landed [on "
    "{thing}]|have we (landed|arrived|docked) [on {body}]|is {thing} (aboard|on board|captured|"
    "safely in hand|in our clutches)|did we (snag|nab|bag|hook|score) ({some}|{thing})|"
    "is {some} [still|already|really|actually] ({touching} {pad}|there [yet|at all])|"
    "is {thing} [still|already|really|actually] {touching} {pad}|"
    "is ({thing}|{pad}) [really|actually|even] (touching [you|us|anything|something|anything "
    "at all]|making contact)|has {hand} got ({some}|{thing})|does {hand} (hold|have|contain) "
    "({some}|{thing})|have you got ({some}|{thing})|are the (fingers|jaws|fingertips) [still|"
    "already] (touching|holding|gripping|on|closed on) ({some}|{thing})|do the (fingers|jaws) "
    "(touch|hold|grip) ({some}|{thing})|are (we|you) [still] holding on to ({some}|{thing})|"
    "are (we|you) [still] holding onto ({some}|{thing})|am I touching {pad}|do you (feel|sense|"
    "notice) me [touching {pad}]|is there {some} between (the|your) fingers|did (anything|"
    "something) (happen|change) "
    "{where}|any object (present|in {hand})|is (an object|something|anything) (present|"
    "detected|felt|in the way)|do you feel me|are you being (touched|pressed)|is contact (made|"
    "detected|established)|"
    "is {some} ((on|at|against|under) {pad}|between {pads}|in {hand})|"
    "is {thing} [still|already|really] (in {hand}|between the (fingers|jaws)|in the grasp|"
    "there [yet])|"
    "(does|do|did) {some} touch {pad}|does {thing} (touch|contact|reach|press on|meet) {pad}|"
    "is there {some} [there|at all|{where}]|is there [a|any|some|still] (contact|touch) "
    "[yet|at all|with {body}|{where}]|is there (a|any|some) (load|pressure|signal) {where}|"
    "(do|can|did) you [already|still|actually] (feel|sense|detect|notice|perceive) "
    "({some}|{thing}|a (touch|contact)|any (touch|contact|pressure)|contact)|"
    "do you (have|register|get) (contact|a contact|any contact) [with {body}]|"
    "does {pad} (feel|sense|register|detect|see|touch) ({some}|a contact|any contact|contact)|"
    "are (we|you) [still|already] (touching|holding|gripping|grasping|in contact with|pressing "
    "on|pressing against|clamping|pinching|squeezing|carrying|up against) "
    "({some}|{thing})|are (we|you) in contact [with {body}|yet]|is {pad} [still|already|being] "
    "(touched|in contact|pressed|loaded) [yet|by {some}|at all]|"
    "is {hand} [still|already] (holding|gripping|clamping|pinching) ({some}|{thing})|"
    "is {hand} (loaded|occupied|full)|(have|did) (we|you|I) (got|get|catch|grab|grasp|grip|"
    "touch|hit|"
    "caught|grabbed|reached|reach|found) ({some}|{thing})|(have|do) (we|you) [got|have] (a "
    "(hold|grip) on|hold of) ({some}|{thing})|(do|did) (we|you) [still|actually] "
    "(hold|have|touch|hit) ({some}|{thing})|(have|did) (we|you) [already] (made|make) contact "
    "[with {body}]|have we touched down|did the (fingers|jaws|gripper) (touch|reach|catch|find|"
    "close on|"
    "meet) ({some}|{thing})|has ({some}|{thing}) [already] (touched|reached|met|hit|arrived "
    "at) {pad} "
    "[yet]|did {thing} (arrive|make contact)|"
    "(anything|something) (there|{where}|touching|touching {pad}|in {hand}|between the fingers)|"
    "any (contact|touch|object) [yet|at all|so far|{where}|detected]|contact [yet|yes or no|or "
    "not]|"
    "(touching|feeling|holding|got) (anything|something|it) [yet|at all]|still (touching|in "
    "contact|"
    "holding it|there)|got (it|{body})|contact (made|established|detected)|"
    "feel (anything|something) [there|at all]|touching or not|"
    "can (anything|something|a contact) be (felt|detected|sensed) [{where}]|"
    "was (anything|a contact|{thing}) (felt|detected|touched|caught|gripped)|"
    "has [a] contact been (made|detected|established)"
)
_TOUCHED_SAID = (
    "(something|an object|{thing}) (touches|is touching|is pressing on|is in contact with|rests on|"
    "is resting on|presses on) {pad}|"
    "there is (something|an object|a contact|contact) [{where}|there]|"
    "(we|you) [already|still] (have contact|are in contact|touch something|feel something|"
    "are touching something|are holding something) [with {body}]|we [already|still] (hold|have|"
    "have got|"
    "are holding|caught|grabbed|got) {thing}|{thing} is [already|still] (in {hand}|between the "
    "fingers)|"
    "{pad} is [already|still] (touched|in contact|pressed|touching something)|contact (is|has "
    "been|was) "
    "(made|established)"
)
_EMPTY = (
    "are the (fingers|jaws) (clutching|grasping|closing) (at|on) (thin air|nothing|air)|does the (reading|sensor) (show|say) "
    "no contact [at all]|is the [gripper] finger (feeling|touching) nothing [at all]|"
    "has {thing} (vanished|disappeared|wandered off|rolled away|flown off|got lost)|"
    "is {pad} (idle|lonely|vacant|deserted|unoccupied)|is {hand} (vacant|unoccupied|bare)|"
    "did we come away (empty-handed|with nothing)|are we (grasping|clutching) at (nothing|straws|"
    "shadows)|did {hand} whiff|did we grab a handful of (air|nothing)|is {pad} in the void|"
    "is {pad} [still|now|already|completely|totally|entirely] (empty|free|clear|untouched|unloaded|"
    "bare|left alone|not touched) "
    "[of objects|of anything|of any object|of any contact] [right now|now|at the moment]|"
    "is the (sensor|gel|pad) surface [still|completely] (empty|free|clear|untouched|bare) [of any "
    "object] [right now|now]|(is|was) {hand} [still|completely] (empty|unloaded|not holding "
    "anything|"
    "holding nothing|closed on nothing)|are the (fingers|jaws) [still|completely] (empty|"
    "not touching anything|closed on (nothing|air))|(did|have) (we|you|I|the fingers|the "
    "robot) [just] "
    "(miss|missed) [{thing}] [completely|altogether|again]|missed [it|{body}] [again]|a miss|"
    "did (it|{thing}) miss {pad}|is it a miss|did {hand} come up empty|is (contact|the contact|"
    "{thing}) lost|is there nothing between (the|your) fingers|was (it|that) a miss|was "
    "{thing} missed|is "
    "{hand} (free|clear)|nothing (felt|detected|caught|gripped)|was nothing (felt|touched|"
    "caught)|are we clear of {thing}|is {pad} away from {thing}|"
    "are (we|you) [still|just] (in the [free] air|in free space|off {body}|"
    "(grasping|gripping|closing on|clutching|squeezing|touching|feeling|holding|sensing) "
    "(nothing|thin air|air|nothing at all)|not (touching|feeling|holding|sensing) anything|"
    "without contact|empty-handed|out of contact)|"
    "is (nothing|no object|no contact) ({touching} {pad}|there|on {pad}|in {hand}|between the "
    "fingers)|"
    "is there (nothing|no contact|no object|no touch) [there|at all|{where}|yet|in {hand}]|"
    "(nothing|no object) (there|{where}|touching|in {hand}) [yet|at all]|no (contact|touch) "
    "[yet|at all|{where}]|nothing [yet|at all]|(did|have) we [just] (lose|lost) ({thing}|"
    "contact|touch|"
    "the object|the contact) [again]|lost (it|contact|touch|{body})|"
    "(has|did) {thing} [already] (fallen|fall|dropped|drop|slip|slipped) (out [of {hand}]|from "
    "{hand})|"
    "(have|did) we [just] (dropped|drop|let go of) {thing}|is {thing} (gone|lost|missing|"
    "not touching [{pad}]|no longer in {hand}|no longer there|not there [at all]|not in {hand})|"
    "did {hand} (close|shut|grip|clamp) on (nothing|air|thin air)|did we (grab|grip|grasp|"
    "catch|touch) "
    "(nothing|air|thin air|nothing at all)|do you (feel|sense|detect|notice|register) "
    "(nothing|no contact|no touch|nothing at all)|do we (have|hold) (nothing|no contact)|"
    "has the contact (ended|broken|gone|been lost)|has nothing (touched|reached) {pad} [yet]|"
    "are the (fingers|jaws) not touching {thing}|did {thing} (get away|escape)|is the pad in "
    "the air"
)
_EMPTY_SAID = (
    "nothing (touches|is touching|is on|is in contact with|presses on|rests on|is resting on) "
    "{pad}|"
    "there is (nothing|no contact|no object|no touch) [there|at all|{where}|in {hand}]|"
    "we [have|just|completely] missed [{thing}]|(we|you) are (in the air|holding nothing|"
    "touching nothing|out of contact|gripping air|not touching anything|not holding anything)|"
    "(you|we) (feel nothing|have nothing|have no contact|do not feel anything|touch nothing)|"
    "({hand}|{pad}) is [still] (empty|free|untouched|left alone|not touched) [now|at the moment]|"
    "{hand} came up empty|the fingers are (empty|touching nothing)|we [have] lost ({thing}|"
    "contact|the contact)|{thing} is (gone|no longer there|not there|"
    "not touching [{pad}])|{thing} does not touch {pad}|nothing is there|nothing is in {hand}"
)

_SENSOR = (
    "the (pad|gel|sensor|sensing area|touch pad|gel pad|skin|sensing surface|sensor area|"
    "finger pad|"
    "active area)"
)
_WHOLE = f"(on|on|inside|within) {_SENSOR}"
_RIM = (
    f"(the (edge|edges|border|rim|boundary|side) [of {_SENSOR}]|"
    "the (pad|sensor|gel) (edge|border|rim|boundary))"
)
_OVER = f"((over|beyond|past|across|off|outside) ({_RIM}|{_SENSOR}))"
_PART = "(part|some|a part|a bit|any|any part|a piece|one end|a portion|one side|half)"
_CUT = (
    "(is|was) {print} [partly|partially|being|a bit] (cut|cut off|lopped off|sliced off|shaved off|"
    "guillotined|docked|curtailed|clipped|cropped|truncated|"
    "chopped off|"
    f"trimmed|cut short) [(by|at) {_RIM}]|"
    "is {print} (cropped|truncated|cut) by the (border|edge|rim)|"
    "does {print} (overflow|straddle|transgress|cross|outgrow|overshoot) "
    f"{_RIM}|is {{print}} (dangling|peeking|jutting|poking|bulging|teetering) {_OVER}|"
    "does {print} (run|reach|go|extend|hang|stick out|spill|lap|protrude|stretch|poke out|jut out) "
    f"{_OVER}|is {{print}} ((hanging|sticking out|running|going|reaching|spilling|lapping|"
    f"extending|partly|partially|half|partway) {_OVER}|over {_RIM})|is {{print}} (only partly|"
    f"only partially|not fully|not completely|not wholly|not entirely) {_WHOLE}|(has|did) "
    f"{{print}} (run|gone|go|slid|slide|spilled) {_OVER}|is there (more|some) of {{print}} "
    f"{_OVER}|is {{print}} (missing a part|incomplete|cut in half|cut short)|do we lose some "
    f"of {{print}} {_OVER}|does {{print}} (stick out|hang over|hang out|protrude|overhang|"
    f"overlap {_RIM}|overrun {_SENSOR})|is {{print}} (hanging over|sticking out|overhanging|"
    f"protruding)|"
    f"does {_PART} of {{print}} (stick out|hang over|hang out|protrude|hang off|lie outside|"
    f"overhang|"
    f"go {_OVER}|reach {_OVER}|lie {_OVER}|stick out {_OVER}|miss {_SENSOR})|"
    f"is {_PART} of {{print}} (off|outside|beyond|over|past) ({_SENSOR}|{_RIM})|"
    f"is {_PART} of {{print}} (cut off|missing|sticking out|hanging over|outside|out of range|"
    f"lost)|"
    f"does {_RIM} (cut|clip|crop|chop|truncate|trim) {{print}} [off]|"
    f"does {{print}} (touch|hit|meet|run into) (the|an|any) (edge|border|rim|boundary) of "
    f"{_SENSOR}|"
    "(do|did) we (lose|miss|cut off) (part|some|a piece) of {print}|am I [only] (getting|"
    "seeing) [only] part of {print}|are (we|you) [only] (getting|feeling|seeing) [only] part "
    "of {print}|are (we|you) (missing|losing|"
    "cutting off) (part|some|a piece) of {print}|(do|can) you [only] feel only (part|a part|"
    "some|half) "
    "of {print}|is only (part|a part|some|half) of {print} " + _WHOLE + "|"
    "(over the edge|cut off|hanging over [the edge]|clipped|cropped|sticking out|partly off "
    "the pad)|"
    f"any [part] of {{print}} (outside|off the pad|cut off)|is {{print}} not (fully|entirely|"
    f"wholly|"
    f"completely|all) {_WHOLE}|is {{print}} (too big|too large|too wide|too long) for {_SENSOR}"
)
_CUT_SAID = (
    f"{{print}} is [partly|partially] (cut off|cut|clipped|cropped) [(by|at) {_RIM}]|"
    f"{{print}} (runs|reaches|goes|hangs|sticks out|extends|spills) {_OVER}|"
    f"{{print}} is (hanging|sticking out|running|partly) {_OVER}|"
    f"(part|some|a part|a bit) of {{print}} (is|lies|hangs) (off|outside|beyond|over) "
    f"({_SENSOR}|{_RIM})|(part|some|a part|a bit) of {{print}} (sticks out|is cut off|hangs over|"
    f"is missing)|{_RIM} cuts {{print}} [off]|we are missing part of {{print}}|"
    f"{{print}} is not (fully|entirely|wholly|completely) {_WHOLE}"
)
_UNCUT = (
    f"is {{print}} [still] (wholly|entirely|completely|fully|totally|all) {_WHOLE}|"
    f"is (all|the whole|every part|the entirety|every bit) of {{print}} {_WHOLE}|"
    f"(is|are) (the whole|the entire|all the|the full) (contact|object|imprint|thing|footprint|"
    f"print) "
    f"({_WHOLE}|captured|covered)|does {{print}} ((fit|stay) [wholly|entirely|completely|"
    f"fully]|(lie|sit|rest|land) "
    f"(wholly|entirely|completely|fully)) {_WHOLE}|does (the whole contact|all of {{touch}}|"
    f"the whole thing|everything) (fit|lie|sit) {_WHOLE}|(do|can|did) (you|we) (feel|see|have|"
    f"get|cover|capture|sense) (all of|the whole of|the entirety of) {{print}}|(do|can) you "
    f"(feel|see|have|cover) "
    f"the (whole|entire|full|complete) (contact|imprint|footprint|print|object|thing)|"
    f"(fully|entirely|wholly|completely|all) {_WHOLE}|is the (contact|imprint|print|footprint) "
    f"(complete|whole|uncut|uncropped)|is {{print}} (clear of|away from|within|inside|free of) "
    f"(the (edges|borders|bounds|boundaries) [of {_SENSOR}]|all [the] edges)|"
    f"(is|are) (nothing|no part) of {{print}} (cut off|outside|off the pad|sticking out)|"
    f"does {{print}} (keep|stay) (clear of|away from|off) {_RIM}|is {{print}} (in full|as a whole) "
    f"{_WHOLE}|is {_SENSOR} (big|large) enough for {{print}}|is everything {_WHOLE}"
)
_UNCUT_SAID = (
    f"(the whole contact|all of {{print}}|the whole object|the entire contact|everything) is "
    f"{_WHOLE}|"
    f"{{print}} is [still] (wholly|entirely|completely|fully|all) {_WHOLE}|"
    f"{{print}} (fits|stays|lies wholly|lies completely|lies fully) {_WHOLE}|you feel (all of|"
    f"the whole of) "
    f"{{print}}|no part of {{print}} is (cut off|outside|off the pad)|nothing is cut off|"
    f"{{print}} is clear of {_RIM}|the (contact|imprint|footprint) is (complete|whole)"
)

_ALL_OF_IT = (
    "(the contact|the touch|what you (feel|sense|have|are holding|are touching)|"
    "what (touches|is touching) the (pad|gel|sensor)|this contact|this touch|{thing}|the whole "
    "contact|"
    "everything [you feel|you know]|how {thing} touches the pad|the current (contact|state|grasp)|"
    "the state of the contact|the contact state|the (whole|overall|current) situation|the "
    "(present|current) touch|the situation on the pad|what is on the (pad|gel|sensor)|"
    "what we are holding|the tactile (image|reading|state)|what is going on [at the pad])"
)

FAMILIES: tuple[QuestionFamily, ...] = (
    QuestionFamily(
        name="contact",
        pattern=_states(("touched", _TOUCHED, _TOUCHED_SAID), ("empty", _EMPTY, _EMPTY_SAID)),
        build=_condition("touched", "empty"),
        slots={
            "pad": "(the pad|the gel|the sensor|you|the finger|the fingertip [sensor]|the skin|"
            "the touch pad|the tip|the sensing surface)",
            "pads": "(the pads|the fingers|the fingertips|the jaws)",
            "hand": "(the gripper|the hand|your hand|the grip|the grasp|your grip)",
            "touching": "(touching|pressing|pressing on|pressing against|in contact with|"
            "resting on|"
            "lying on|sitting on|pushing on|pushing against|leaning on|leaning against|up against|"
            "poking|bearing on)",
            "where": "(on|at|against) {pad}",
            "some": _SOME,
            "touched": {"touched": ""},
            "empty": {"empty": ""},
        },
    ),
    QuestionFamily(
        name="cut",
        pattern=_states(("cut", _CUT, _CUT_SAID), ("whole", _UNCUT, _UNCUT_SAID)),
        build=_condition("cut", "whole"),
        slots={
            "print": "({touch}|{thing}|the (imprint|print|footprint|contact patch|object))",
            "cut": {"cut": ""},
            "whole": {"whole": ""},
        },
    ),
    QuestionFamily(
        name="not_cut",
        pattern=denied_pattern(
            "{touch}|{body}|the (imprint|footprint|contact patch)", "[at all|really|even] {state}"
        ),
        build=_condition("state", denied=True),
        slots={
            "state": {
                "cut": f"(cut off [at {_RIM}]|cut [off] by {_RIM}|clipped|cropped|over {_RIM}|"
                f"hanging {_OVER}|sticking out|cut)"
            }
        },
    ),
    QuestionFamily(
        name="whole_or_cut",
        pattern=(
            "{lead} ( is {print} {whole} or {part} | is {print} {part} or {whole} "
            "| {ask} whether {print} is ({whole} or {part}|{part} or {whole}) "
            "| do you (feel|see|have) (all|the whole) of {print} or (only|just) (part|a part|"
            "some) [of it] "
            "| {whole} or {part} | {part} or {whole} "
            "| does {print} (fit on|stay on) the (pad|gel|sensor) or (hang|stick|run|go) "
            "over [the edge] ) {tail} [, {length}]"
        ),
        build=_one_of("wholeness"),
        slots={
            "print": "({touch}|{body}|the (imprint|footprint|contact patch))",
            "whole": f"(whole|complete|all there|(wholly|fully|entirely|all) {_WHOLE})",
            "part": "(cut [off]|cut [off] by the edge|partly (cut off|off the pad|outside)|"
            "[hanging] over the edge|clipped|cropped)",
        },
    ),
    QuestionFamily(
        name="describe",
        pattern=(
            "{lead} ( (describe|report|explain|sketch|narrate|detail|itemise|break down|run through|"
            "put into words|give us the rundown on|walk me through|talk me through|verbalise|depict|"
            "summarise|summarize|characterise|sum up|picture|"
            "outline|"
            "report on|give an account of|comment on|recap) [to (me|us)|for (me|us)|briefly|in "
            "full] {all} "
            "| what (do|can|did) you [really|actually|currently] (feel|sense|perceive|notice|"
            "detect) "
            "[there|on the pad|between the fingers|about {thing}|from {body}] "
            "| what are you (feeling|touching|sensing|holding|in contact with|reading) "
            "| what can you (tell|say) [me|us] [about ({all}|the pad)] | {ask} what you (feel|"
            "sense|notice) "
            "| {ask} (everything|all|all that) you (feel|know|can feel|can tell|sense|have) "
            "[about ({thing}|{touch})] | (tell me|say) (everything|all|more|something|a bit "
            "more) [about "
            "{all}] | (tell me|talk|say something|say more|tell us|speak) about {all} "
            "| [{want}] (a|the|a short|a full|a brief|a quick|a complete) (description|summary|"
            "report|"
            "overview|rundown|account|status report|characterisation) [of {all}] [, please] "
            "| [{want}] the big picture | [{want}] the (full|whole|complete|overall) (picture|"
            "story|report|reading) [of {touch}] "
            "| (give|send|show|read) (me|us) (everything|all of it|it all|all you (have|know)|"
            "all [the] (values|readings|data|numbers)|the works|the lot) "
            "| what (is|was) the (contact|touch) [with {body}] like | what is it like "
            "| what (touches|is touching|presses on|is on|is pressing on|rests on|is resting on|"
            "is in contact with) (the (pad|gel|sensor|finger|fingertip)|you) "
            "| how does the (contact|touch|grasp) [with {body}] feel "
            "| what have (you|we) got [there|here|on the pad|between the fingers|in the gripper] "
            "| what do (you|we) have [there|here|on the pad|between the fingers|in the gripper] "
            "| what is (there|going on|happening|happening at the pad|going on at the contact) "
            "| how (do|would) you describe {all} | all you know about {touch} | all about {touch} "
            "| what does (the touch|the pad|the sensor|the gel|the contact) (feel|tell|say|"
            "show|report) "
            "[you|us] | what is your (impression|picture|sense|perception) [of {all}] "
            "| (status|report|describe|description|summary|overview|status report|full report|"
            "details) "
            "| describe it [all] [in (detail|full|words)] | how would you (sum it up|summarise it|"
            "describe it|put it in words) | what is (in|between) the (gripper|fingers|jaws) "
            "| what is the (state|status|situation|story|contact state|overall situation|"
            "overall state) [of the (contact|touch|pad)] | how (is|are) (the contact|things|"
            "things on the pad|things at the pad) | fill me in [on {all}] | (bring|get) me up "
            "to speed | walk me through {all} | what is your report | (what do|what can) you "
            "make of {all} | what is the full (picture|story) | paint me a picture [of {all}] |"
            " how is it all | what sort of (contact|touch) is (it|this|that) | what kind of "
            "contact (is (it|this|that)|do (we|you) have) ) {tail} [, {length}]"
        ),
        build=lambda bindings, _: Description(length=length_of(bindings)),
        slots={"all": _ALL_OF_IT},
    ),
)
