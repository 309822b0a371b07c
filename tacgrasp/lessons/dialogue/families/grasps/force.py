"""Families about the contract: the force band, the limit, and what they ask of the grip.

Not here: whether it may be lifted (``tacgrasp.lessons.dialogue.families.grasps.lifting``), what to do
next and why (``tacgrasp.lessons.dialogue.families.grasps.advice``).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np

from tacgrasp.lessons.dialogue.conditions import check_of, number_text
from tacgrasp.lessons.dialogue.meaning import Amount, Check, Several, Which
from tacgrasp.lessons.dialogue.patterns.family import (
    Bindings,
    Numbers,
    QuestionFamily,
    length_of,
)
from tacgrasp.lessons.dialogue.patterns.phrases import amount_pattern
from tacgrasp.lessons.dialogue.scene import AskedScene

DEPTH_QUESTIONS = ("How deep is it?", "What is the depth?", "How far is it pressed in?")

_BAND = (
    "(the band|the force band|the [wanted|target|agreed|desired|required|specified|given] range|"
    "the (requested|agreed|stipulated) [force] (band|range|window)|the (band|range) [that] (we agreed on|I asked for|was asked for)|the window we agreed on|"
    "the goal|the contract|the agreed (band|window|force)|the (wanted|target|desired) (band|force)|"
    "the target|the window|the range (we agreed on|in the contract|we want|that was agreed)|"
    "what (we agreed on|we want|was agreed|is wanted|the contract (wants|asks for|says|demands)))"
)
_MIDDLE_OF_BAND = (
    "(the (middle|center|midpoint|mid point|mean|halfway point) of (the|our) [force|wanted|target] (band|range|window)|"
    "the band's (middle|center|midpoint)|mid-band)"
)
_SPEC = f"({_BAND}|{_BAND}|spec|specification|the specs|tolerance|the tolerance)"
_FORCE = (
    "(force|force|pressure|grip|grip force|squeeze|gripping force|clamping force|strength|"
    "contact force|grip strength)"
)
_GRIP = (
    "(the|the|our|this|my) (grip|force|grip force|squeeze|hold|grasp|pressure|clamping force|"
    "pinch|contact force|gripping force) [on {body}|you feel|we use|of the (fingers|gripper)]"
)
_HOLD = "(hold|grip|squeeze|pinch|clamp|grasp|press|clutch|grab|push)"
_HOLDING = (
    "(holding|gripping|squeezing|pinching|clamping|grasping|pressing|clutching|grabbing|pushing)"
)
_HELD = "(held|gripped|squeezed|pinched|clamped|grasped|pressed|clutched|being held|being squeezed|nipped|seized|clenched)"
_DEGREE = "[much|far|way|a bit|a little|slightly|still|already|maybe|perhaps|rather]"
_AGREED = (
    "(wanted|agreed|we want|we agreed [on]|the contract (wants|says|asks for|demands)|required|"
    "desired|it should be|planned|specified|intended|the target|the goal)"
)

_STATES = {
    "within": (
        f"((within|inside|in|within|well within|in line with) {_SPEC}|as (it should be|wanted|"
        "agreed|required|desired|we want it|planned|specified)|[just|about|quite] right "
        "[for {body}]|correct|OK|okay|fine|in order|all right|appropriate|suitable|"
        "acceptable|on target|spot on|in the green|bang on|within bounds|dialled in|on the money|just so|"
        "as ordered|per spec|satisfactory|on spec|in the sweet spot|in the zone|where (it should be|we want it)|up to spec|ideal)"
    ),
    "below": (
        f"((below|under|short of|lower than|weaker than) {_SPEC}|{_DEGREE} too (light|weak|loose|"
        "low|gentle|soft|slack|small|little|feeble|faint|flimsy|timid|puny|meagre|sloppy|slight|wimpy) [for {body}|for the (contract|band|goal|task)]|"
        "[a bit|a little|rather] (loose|slack|weak)|insufficient [for {body}]|"
        f"on the (loose|weak|light|low|soft) side|(less|lower|weaker|looser|lighter) than "
        f"{_AGREED})"
    ),
    "above": (
        f"((above|over|higher than|beyond|stronger than) {_SPEC}|{_DEGREE} too (firm|strong|tight|"
        "high|hard|much|great|rough|forceful|harsh|heavy|brutal|aggressive|intense|stiff|violent|fierce) [for {body}|for the (contract|band|goal|task)]|"
        "[a bit|a little|rather] excessive|on the (tight|firm|strong|high|hard) side|"
        f"(more|higher|stronger|tighter|firmer|harder) than {_AGREED}|overdone)"
    ),
    "enough": (
        "((strong|firm|tight|high|hard|great) enough [for {body}|for the contract]|enough "
        "[for {body}]|[quite] sufficient [for {body}]|adequate|sufficiently (firm|strong|tight|"
        "high)|"
        "at least (what we need|what the contract wants|the least that is wanted))"
    ),
}
"""What may be said of the force, by its place in the band."""

_MANNERS = {
    "within": (
        "([just|about] right|correctly|properly|as (wanted|agreed|we should|planned|required)|"
        "with [just|about] the (right|wanted|agreed|required|correct|proper) (force|pressure)|"
        f"the right way|neither too (hard|tightly) nor too (lightly|loosely)|within {_SPEC})"
    ),
    "below": (
        f"({_DEGREE} too (loosely|lightly|weakly|softly|gently|little|carefully|loose|soft)|"
        "not (hard|tightly|firmly|strongly) enough|with too little (force|pressure|grip)|loosely|"
        f"with less force than {_AGREED}|with not enough force)"
    ),
    "above": (
        f"({_DEGREE} too (tightly|firmly|hard|strongly|tight|forcefully|roughly|much|heavily)|"
        "with too much (force|pressure|grip)|harder than (we should|needed|necessary|wanted|"
        "agreed)|"
        f"with more force than {_AGREED}|tighter than (needed|necessary|wanted|agreed))"
    ),
    "enough": (
        "((tightly|firmly|strongly|hard|tight) enough|enough|with (enough|sufficient) "
        "(force|pressure|grip|strength)|sufficiently (firmly|tightly|hard)|"
        "as (hard|firmly|tightly) as needed)"
    ),
}
"""How something may be held, by the force's place in the band."""

_PORTIONS = {
    "within": "(the right amount of|the right|just the right|about the right)",
    "below": "(too little|not enough|insufficient|too small a)",
    "above": "(too much|too much|excessive|way too much|a bit too much)",
    "enough": "(enough|enough|sufficient|adequate)",
}
"""How much force there may be, by its place in the band."""


def asked_or_stated(direct: str, stated: str, short: str) -> str:
    """Wordings that ask for yes or no, with any verb.

    Args:
        direct: Questions, without their question mark.
        stated: The same as statements, to be asked for or confirmed.
        short: Fragments of a few words.
    """
    return (
        f"{{lead}} ( ({direct}) | ({{whether}}|is it true|are you sure|would you agree [that]) "
        f"({stated}) "
        f"| [{{believe}}] ({stated}) [{{tag}}|, (isn't it|aren't we|don't we|aren't you|doesn't "
        f"it)] "
        f"| ({short}) ) {{tail}} [, {{length}}]"
    )


def conditional(
    *slots: str, default: str = "", denied: bool = False, prefix: str = ""
) -> Callable[[Bindings, Numbers], Check]:
    """A condition on the force by the value of the first slot that a wording has.

    Args:
        slots: The slots.
        default: The condition of a wording that has none of them.
        denied: Whether it is denied.
        prefix: What a query has before it.
    """

    def build(bindings: Bindings, _: Numbers) -> Check:
        name = next((bindings[slot] for slot in slots if slot in bindings), default)
        return check_of(f"{prefix}force {name}", denied=denied, length=length_of(bindings))

    return build


def _force_named(bindings: Bindings, numbers: Numbers) -> Check:
    return check_of(
        f"{bindings['worth']} {number_text(numbers['n'])} N", length=length_of(bindings)
    )


def _near_an_end(
    scene: AskedScene, bindings: Bindings, rng: np.random.Generator
) -> Mapping[str, str]:
    """A number below or above the end of the band, or the limit, that a wording speaks of [N]."""
    end = scene.values()[f"{bindings['worth'].split()[0]}_n"]
    middle = float(end) if isinstance(end, float) and end > 0 else 1.0
    newtons = middle * float(np.exp(rng.choice([-1, 1]) * rng.uniform(0.15, 0.9)))
    return {"n": number_text(max(0.05, round(newtons / 0.05) * 0.05))}


def _wanted(bindings: Bindings, _: Numbers) -> Several:
    ends = [Amount(quantity=quantity, unit="N") for quantity in ("band_low", "band_high")]
    return Several(parts=tuple(ends))


_LIMIT = (
    "((the|the|our|its) [hard|force|agreed|allowed|permitted|safety|set|contract] limit "
    "[of the contract|on the force|for {body}|we agreed on|that was set|for the force]|"
    "the (ceiling|cap) [on the force|of the contract]|the safe (force|limit)|what is (allowed|permitted)|"
    "what (the contract (allows|permits)|we are allowed|we may use)|"
    "the (force|pressure) (that is (allowed|permitted)|we are allowed)|"
    "the (allowed|permitted|maximum allowed|largest allowed|highest permitted) (force|pressure))"
)
_LIMITED = (
    "(the|the|our|this|my) ([contact|grip|gripping|normal|clamping] force|grip|load|squeeze|"
    "pressure|hold) [on {body}]"
)
_SIDES = {
    "over": (
        f"((above|over|over|beyond|past|higher than|in excess of|greater than|exceeding) {_LIMIT}|"
        "(more|higher|greater|larger|stronger) than (allowed|permitted|the contract (allows|"
        "permits)|"
        "we are allowed|is (allowed|permitted))|on the wrong side of the limit)"
    ),
    "under": (
        f"((below|under|within|lower than|inside|still (below|under|within)|safely (below|under)|"
        f"no (more|higher) than) {_LIMIT}|on the (safe|right) side of the limit)"
    ),
}
_KEPT = {
    "over": (
        "(exceed|break|pass|violate|overstep|go over|go past|surpass|go beyond|overrun|breach|"
        "overshoot|cross|top|bust|blow|bust through|transgress|outstrip|run over)"
    ),
    "under": (
        "(keep to|respect|observe|stay (below|under|within)|keep (below|under|within)|obey|"
        "remain (below|under|within)|comply with|honour|stick to)"
    ),
}
_KEEPS = {
    "over": "(exceeds|breaks|passes|violates|goes over|goes past|is over|surpasses|breaches)",
    "under": "(respects|observes|stays (below|under|within)|keeps to|remains (below|under))",
}
_BEEN = {
    "over": "(exceeded|broken|passed|violated|overstepped|crossed|surpassed|breached|overrun)",
    "under": "(respected|observed|kept|obeyed|adhered to)",
}

_HARDER = {
    "below": (
        f"({_HOLD} [{{thing}}] (harder|more firmly|tighter|more tightly|more|more strongly|a bit "
        "harder|with more force|more)|tighten [up|the grip|the hold]|increase the (force|grip|"
        "pressure|squeeze)|(use|apply|add) [some] more (force|pressure)|firm up the (grip|hold)|crank it up|dial it up|clamp down|bear down|bite harder|"
        "step up the (force|grip)|close (the gripper|the fingers|the jaws) [a bit|a little] (more|further)|close [it] (more|further)|beef up the grip|raise the (force|pressure)|snug it up)"
    ),
    "above": (
        f"({_HOLD} [{{thing}}] (softer|more softly|more gently|less|less hard|looser|more loosely|"
        "more lightly|a bit softer|with less force)|loosen [up|the grip|the hold]|(decrease|reduce|"
        "lower) the (force|grip|pressure|squeeze)|(use|apply) less (force|pressure)|ease off|chill out a bit|dial it (down|back)|tone it down|go easier|release a bit|"
        "let up [a bit]|back off [a bit]|open (the gripper|the fingers|the jaws) (a bit|a little|slightly)|relax the (grip|hold)|ease the grip|slacken the grip)"
    ),
}
_FIRMER = {
    "below": (
        "([a bit|a little|some] more (force|pressure|grip|squeeze)|"
        "a (firmer|tighter|stronger|harder) (grip|hold|squeeze|grasp))"
    ),
    "above": (
        "([a bit|a little] less (force|pressure|grip|squeeze)|"
        "a (softer|looser|lighter|gentler|weaker) (grip|hold|squeeze|grasp))"
    ),
}

_SCALE = (
    "(too light, [just] right or too firm|too (loose|weak|light|low|soft) or too (tight|strong|"
    "firm|"
    f"high|hard)|(below|under), (within|in|inside) or (above|over) {_BAND}|too (loose|little|"
    f"weak), "
    f"too (tight|much|strong) or [just] (right|fine|OK)|(below|under) or (above|over) {_BAND}|"
    "too (tight|high|strong|firm|hard) or too (loose|low|weak|light|soft)|"
    "too much, too little or [just] (right|enough)|low, right or high|too little or too much)"
)

FAMILIES: tuple[QuestionFamily, ...] = (
    QuestionFamily(
        name="force_band",
        pattern=asked_or_stated(
            f"(is|is|isn't) ({_GRIP}) {{state}}|is {{thing}} {_HELD} {{manner}}|"
            f"(are|aren't) (we|you|the fingers) {_HOLDING} [{{thing}}] {{manner}}|"
            f"(do|do|don't) (we|you|I|the fingers|the jaws) {_HOLD} [{{thing}}] {{manner}}|"
            f"am I {_HOLDING} [{{thing}}] {{manner}}|is {{actor}} {{manner}}|"
            f"(are (we|you) {{using}}|do (we|you) (use|apply|exert)) {{portion}} {_FORCE} [on "
            f"{{thing}}]|"
            f"(did|do) (we|I) {_HOLD} {{thing}} {{manner}}|"
            f"have (we|I) (gripped|squeezed|grabbed|pressed|grasped) [{{thing}}] {{manner}}|"
            f"(is|was) {_BAND} {{met}}|has {_BAND} been {{met}}|have we {{met}} {_BAND}|"
            "(am I|are we|is the gripper) [being] {rough} [with {thing}]|"
            "(is|is|isn't) (it|this|that|this grip) {terse}|is {thing} {slack}|"
            f"is (there|that|this) {{portion}} {_FORCE} [on {{thing}}|for {{thing}}]|"
            f"(do we have|have we got|does {{thing}} get) {{portion}} {_FORCE} [on {{thing}}]|"
            f"do we {{meet}} {_BAND}|did we meet {_BAND}|did we (hit|reach) the [force] (band|range|window)|does ({_GRIP}) {{meet}} "
            f"{_BAND}|"
            f"(are we|does ({_GRIP}) (lie|stay|fall)) (within|in|inside) {_SPEC}|"
            f"(is ({_GRIP})|are we|does ({_GRIP}) (lie|stay|fall)) {{between_ends}}|(does ({_GRIP})|do we) "
            f"{{both_ends}}|(is|was) {{both_ends_kept}}|(does|do|would|will|did) ({_BAND}|the task|the job) (call for|ask for|want|"
            f"require|need|demand) {{firmer}} [than (this|this one|now|that|we have)]|(do we|are we) {_HOLD} "
            f"[{{thing}}] {{harder_than}}|are (we|you|the fingers) {_HOLDING} [{{thing}}] {{harder_than}}|am I "
            f"{_HOLDING} [{{thing}}] {{harder_than}}",
            f"({_GRIP}) is {{state}}|(we are|you are|I am|the gripper is) {_HOLDING} [{{thing}}] "
            f"{{manner}}|{{thing}} is {_HELD} {{manner}}|(we|you|I|the fingers) {_HOLD} "
            f"[{{thing}}] "
            f"{{manner}}|there is {{portion}} {_FORCE} [on {{thing}}]|we {{meet}} {_BAND}|"
            f"we (use|apply|have) {{portion}} {_FORCE}|(I am|we are) [being] {{rough}} [with "
            f"{{thing}}]|"
            "(it|this|that) is {terse}|{thing} is {slack}|"
            f"we are (within|in|inside) {_SPEC}",
            f"{{portion}} {_FORCE} [on {{thing}}]|{_FORCE} {{state}}|{_HOLDING} [{{thing}}] "
            f"{{manner}}|"
            f"{{terse}}|{{terse}}|{{rough}} [with {{thing}}]",
        ),
        build=conditional(
            *("state", "manner", "portion", "meet", "met", "terse", "rough", "slack", "firmer"),
            *("harder_than", "between_ends", "both_ends", "both_ends_kept"),
            default="within",
        ),
        slots={
            "state": _STATES,
            "manner": _MANNERS,
            "portion": _PORTIONS,
            "actor": f"(the (gripper|robot|hand|arm) {_HOLDING} [{{thing}}])",
            "using": "(using|applying|exerting|putting in|putting)",
            "meet": {
                "within": "(fit|meet|match|satisfy|hit|comply with|agree with|conform to)",
                "below": "(undershoot|fall short of|fall below|stay below)",
                "above": "(overshoot|go above|go beyond|rise above)",
            },
            "met": {"within": "(met|reached|satisfied|fulfilled|attained|achieved)"},
            "terse": {
                "within": "(within (spec|tolerance|the band|the agreed range)|in (spec|tolerance|"
                "the [force] band))",
                "below": "too (loose|weak|light|loosely held|soft) [for {body}]",
                "above": "too (tight|firm|hard|strong|tightly held|much) [for {body}]",
                "enough": "(tight|firm|strong) enough [for {body}]",
            },
            "rough": {
                "below": f"{_DEGREE} too (gentle|soft|weak|timid|careful|light|loose)",
                "above": f"{_DEGREE} too (rough|heavy-handed|forceful|strong|firm|harsh|brutal)",
                "enough": "(firm|strong|forceful) enough",
            },
            "slack": {"below": "[too] loose in the (grip|gripper|fingers|jaws|hand)"},
            "firmer": {
                "below": "(a (firmer|tighter|stronger|harder) (grip|hold|squeeze|grasp)|more force|more (grip|squeeze))",
                "above": "(a (softer|looser|lighter|gentler|weaker) (grip|hold|squeeze|grasp)|less (force|grip))",
            },
            "harder_than": {
                "above": "(harder|tighter|more firmly|more strongly|firmer) than the [force] (band|window|range) (allows|permits|wants|has it)",
                "below": "(softer|more loosely|more weakly|looser|less) than the [force] (band|window|range) (allows|permits|wants|asks for)",
            },
            "between_ends": {
                "within": "([somewhere|anywhere] between the (minimum|least|lower end|lower bound|lower limit) and the (maximum|most|upper end|upper bound|upper limit) "
                "[force] [wanted|specified|asked for|of the band|for (this|the) grip|specified for this grip]|within both (bounds|ends|limits) [of the band])",
            },
            "both_ends": {
                "within": "(respect|keep to|keep within|stay within|observe|satisfy|meet) (both (bounds|ends|limits)|both the (lower|upper) and the "
                "(upper|lower) (bound|end|limit)|the (lower|upper) and the (upper|lower) (bound|end|limit)) [of (the|the contract's) [force] band|of the contract]",
            },
            "both_ends_kept": {
                "within": "both (bounds|ends) of the [force] band (respected|kept|met|observed)"
            },
        },
    ),
    QuestionFamily(
        name="not_force_band",
        pattern=(
            f"{{lead}} ( is ({_GRIP}) not {{state}} "
            f"| is {{thing}} not {_HELD} {{manner}} | are (we|you) not {_HOLDING} [{{thing}}] "
            f"{{manner}} "
            f"| do (we|you) not {_HOLD} [{{thing}}] {{manner}} "
            f"| (is ({_GRIP})|are we) (outside|out of|outside) {{outside}} "
            f"| (does ({_GRIP})|do we) (miss|fail to meet) {{missed}} "
            f"| is there not {{portion}} {_FORCE} [on {{thing}}] "
            f"| ({{whether}}|[{{believe}}]) ( ({_GRIP}) (is not|isn't) {{state}} "
            f"| {{thing}} (is not|isn't) {_HELD} {{manner}} | ({_GRIP}) is (outside|out of) "
            f"{{outside}} "
            f"| we are not {_HOLDING} [{{thing}}] {{manner}} | we do not {_HOLD} [{{thing}}] "
            f"{{manner}} "
            f"| there is not {{portion}} {_FORCE} [on {{thing}}] ) "
            "[, right|, is that right|, am I right|, true or false|, correct] "
            "| [force] out of (spec|tolerance|range) {out} ) {tail}"
        ),
        build=conditional("state", "manner", "portion", default="within", denied=True),
        slots={
            "state": {
                "within": f"((within|inside|in) {_SPEC}|[just] right [for {{body}}]|as (it should "
                f"be|"
                "wanted|agreed|we want it)|on target|acceptable|correct|OK|fine)",
                "below": "(too (light|weak|loose|low|gentle|soft|slack) [for {body}]|"
                f"below {_SPEC})",
                "above": "(too (firm|strong|tight|high|hard|much|great) [for {body}]|"
                f"above {_SPEC}|excessive)",
                "enough": "((strong|firm|tight|high) enough [for {body}]|sufficient [for {body}]|"
                "enough [for {body}]|adequate)",
            },
            "manner": {
                "within": "(correctly|properly|as (wanted|agreed)|with the (right|agreed) force)",
                "below": "too (loosely|lightly|weakly|softly|gently)",
                "above": "too (tightly|firmly|hard|strongly|much)",
                "enough": "(tightly|firmly|strongly|hard) enough",
            },
            "portion": {"above": "too much", "below": "too little"},
            "outside": f"({_BAND}|tolerance|spec)",
            "missed": f"({_BAND}|the spec)",
            "out": "[, right]",
        },
    ),
    QuestionFamily(
        name="band_half",
        pattern=asked_or_stated(
            f"(is|is|isn't) ({_GRIP}) {{half}}|(are|aren't) (we|you|the fingers) {{half}}|(do|does) (we|you|the fingers|"
            f"{_GRIP}) (lie|sit|press|squeeze|stay|fall) {{half}}",
            f"({_GRIP}) is {{half}}|we are {{half}}",
            "[force] {half}",
        ),
        build=conditional("half"),
        slots={
            "half": {
                "upper": (
                    f"((above|over|beyond|past|more than|higher than|in excess of) {_MIDDLE_OF_BAND}|"
                    f"in the (upper|top|higher) half of {_BAND}|(nearer|closer) [to] the (upper|top) "
                    f"end of {_BAND}|(nearer|closer) [to] the (upper|top) "
                    f"end [of {_BAND}] than [to] its lower end|"
                    f"(nearer|closer) [to] the (maximum|most) than the (minimum|least) [of {_BAND}])"
                ),
                "lower": (
                    f"((below|under|less than|lower than|short of) {_MIDDLE_OF_BAND}|"
                    f"in the (lower|bottom) half of {_BAND}|(nearer|closer) [to] the lower "
                    f"end of {_BAND}|(nearer|closer) [to] the lower "
                    f"end [of {_BAND}] than [to] its upper end|"
                    f"(nearer|closer) [to] the (minimum|least) than the (maximum|most) [of {_BAND}])"
                ),
            },
        },
    ),
    QuestionFamily(
        name="force_limit",
        pattern=asked_or_stated(
            f"(is|is|isn't) ({_LIMITED}) {{side}}|(are|are|aren't) (we|you|the fingers) {{side}}|am I {{side}}|"
            f"(do|did|do) (we|you|the fingers) {{keep}} {_LIMIT}|does ({_LIMITED}) {{keep}} "
            f"{_LIMIT}|"
            "(is|has) the [force|hard] limit [been] {been}|"
            f"(are|do) we {_HOLDING} [{{thing}}] {{harder}}|"
            "(can|may|could) (we|I|you) {further} [safely|any (further|more)|a (bit|little)|a bit (more|further)] {fine}|"
            "is there [any|some|still] (room|space|leeway|headroom) [left] [to {further}] {fine}|"
            "is (this|that|so) much force (allowed|permitted) {fine}|"
            f"is ({_LIMITED}) (allowed|permitted) [by the contract] {{fine}}|"
            f"(are we allowed to|may we|may I|am I allowed to) {_HOLD} [{{thing}}] (this|so|that) "
            "(hard|tightly|firmly|much) {fine}|"
            "do we (use|apply) more force than (allowed|permitted|the contract allows) {much}|"
            "have we (gone|got) (over|past|beyond) the [force|hard] limit {much}|"
            "(will|does|would|could|might) {thing} {harmed} {much}|is {thing} (being|getting) {harmed_so} "
            "{much}|(are|aren't) (we|you|the fingers) {harming} {thing} {much}|(will|do|would|could) "
            "(we|I|you|the fingers|this force|this grip) {harm} {thing} {much}|is there (a|any) (risk|danger) (of "
            "{harming} {thing}|that {thing} (bruises|breaks|bursts)) {much}",
            f"({_LIMITED}) is {{side}}|we are {{side}}|we {{keep}} {_LIMIT}|"
            f"({_LIMITED}) {{keeps}} {_LIMIT}|the [force|hard] limit (is|has been) {{been}}|"
            "(this|that) much force is (allowed|permitted) {fine}|"
            f"we are {_HOLDING} [{{thing}}] {{harder}}",
            "[force] {short} [for {body}]|[the] [force] limit {been}|{short}",
        ),
        build=conditional("side", "keep", "been", "harder", "keeps", "fine", "much", "short"),
        slots={
            "side": _SIDES,
            "keep": _KEPT,
            "keeps": _KEEPS,
            "been": _BEEN,
            "harder": {
                "over": "(harder|tighter|more) than (allowed|permitted|the contract allows|"
                "we are allowed [to])",
            },
            "fine": {"under": ""},
            "much": {"over": ""},
            "further": f"({_HOLD} [{{thing}}] (harder|tighter|more firmly|more)|tighten [the grip]|(increase|raise) the (force|grip))",
            "harm": "(bruise|crush|squash|damage|harm|break|hurt|mash|dent)",
            "harming": "(bruising|crushing|squashing|damaging|harming|breaking|hurting|mashing|denting)",
            "harmed": "(bruise|burst|break|be (bruised|crushed|damaged|harmed|squashed)|get (bruised|crushed|damaged|squashed))",
            "harmed_so": "(bruised|crushed|damaged|harmed|squashed)",
            "short": {
                "over": "(over|above|past|beyond) the limit",
                "under": "(under|below|within) the limit",
            },
        },
    ),
    QuestionFamily(
        name="not_force_limit",
        pattern=(
            f"{{lead}} ( is ({_LIMITED}) not {{side}} | are (we|you) not {{side}} "
            f"| do (we|you) not {{keep}} {_LIMIT} | does ({_LIMITED}) not {{keep}} {_LIMIT} "
            "| is the [force|hard] limit not {been} "
            f"| ({{whether}}|[{{believe}}]) ( ({_LIMITED}) (is not|isn't) {{side}} | we are not "
            f"{{side}} "
            f"| we (do not|don't) {{keep}} {_LIMIT} | ({_LIMITED}) (does not|doesn't) {{keep}} "
            f"{_LIMIT} "
            "| the [force|hard] limit is not {been} ) "
            "[, right|, is that right|, am I right|, true or false|, correct] ) "
            "{tail}"
        ),
        build=conditional("side", "keep", "been", denied=True),
        slots={
            "side": {
                "over": f"(above|over|beyond|past|higher than) {_LIMIT}",
                "under": f"(below|under|within|inside) {_LIMIT}",
            },
            "keep": {
                "over": "(exceed|break|pass|violate|overstep|go over|go beyond|breach)",
                "under": "(keep to|respect|observe|stay below|stay under|obey)",
            },
            "been": {"over": "(exceeded|broken|passed|violated)", "under": "(respected|kept)"},
        },
    ),
    QuestionFamily(
        name="need_force",
        pattern=asked_or_stated(
            "(should|shall|must|should) (we|I|you|the robot|the gripper|the fingers) {harder}|"
            "(do|don't) (we|I|you) (need|have|need) to {harder}|do (we|I|you) need {firmer}|"
            "does (the robot|the gripper|the hand) (need|have) to {harder}|"
            "is {firmer} (needed|required|necessary|called for|in order)|"
            "does {thing} (need|require|call for) {firmer}|is it (necessary|time|advisable) to "
            "{harder}|would you {harder}|do you want (us|me) to {harder}|would {firmer} be better|"
            "would it be better to {harder}|do you (want|need|advise|recommend) {firmer}|"
            "is {firmer} what (we|it) need|(must|should|does) {thing} [have to|need to] be "
            "{held_so} [to (reach|get into|be in) (the band|the goal|the range)]",
            "(we|I|you|the robot) (should|must|have to|need to|ought to) {harder}|(we|you) need "
            "{firmer}|"
            "{firmer} is (needed|required|necessary)|{thing} needs {firmer}|"
            "it (is|would be) (necessary|better) to {harder}",
            "{firmer}|{firmer} or not|{harder} or not|{harder} , yes or no|{firmer} (needed|required)|time to "
            "{harder}|need {firmer}|"
            "need to {harder}",
        ),
        build=conditional("harder", "firmer", "held_so"),
        slots={
            "harder": _HARDER,
            "firmer": _FIRMER,
            "held_so": {
                "below": f"({_HELD} (more firmly|more tightly|harder|tighter|more strongly)|tightened)",
                "above": f"({_HELD} (less firmly|less tightly|more gently|more loosely|softer)|loosened)",
            },
        },
    ),
    QuestionFamily(
        name="force_named",
        pattern=asked_or_stated(
            "(is|is|isn't) {#n} {unit} {worth}|(would|will|might) {#n} {unit} be {worth}|"
            "(is|would) a force of {#n} {unit} [be] {worth}",
            "{#n} {unit} (is|would be) {worth}|a force of {#n} {unit} is {worth}",
            "{#n} {unit} , {worth}",
        ),
        build=_force_named,
        slots={
            "unit": "(N|N|newton|newtons)",
            "worth": {
                "band_low <=": "(enough|sufficient|adequate|plenty)",
                "band_low >": "(too (little|weak|low|light|loose)|not enough|insufficient)",
                "limit <": "(too (much|high|hard|strong)|more than (allowed|permitted)|over the limit)",
                "limit >=": "(allowed|permitted|within the limit|acceptable|tolerated)",
            },
        },
        choose=_near_an_end,
    ),
    QuestionFamily(
        name="force_band_word",
        pattern=amount_pattern(
            f"is ({_GRIP}) {_SCALE}|are we {_HOLDING} [{{thing}}] {_SCALE}|"
            f"is (it|this|that) {_SCALE}|how is (the|our|my|this) (grip|hold|grasp)|"
            f"how are we doing (on force|with the force|against {_BAND})|"
            f"is {{thing}} {_HELD} too (lightly|loosely), [just] right or too (firmly|tightly|"
            f"hard)|"
            f"how does ({_GRIP}) (compare with|compare to|relate to|stand against|sit in|"
            f"fit into|measure up to) {_BAND}|"
            f"(on which side|where|in which part) of {_BAND} (is ({_GRIP})|are we)|"
            f"where (is ({_GRIP})|are we|does ({_GRIP}) (lie|stand|sit)) (relative to|compared "
            f"with|"
            f"with respect to|in relation to|against) {_BAND}|"
            f"do we {_HOLD} [{{thing}}] too (little|lightly|loosely) or too (much|hard|tightly)|"
            f"how (would you rate|do you judge|do you rate|would you judge) ({_GRIP}) "
            f"(against|by) {_BAND}|do we have too little, enough or too much {_FORCE}",
            f"how ({_GRIP}) (compares (with|to)|relates to|stands against) {_BAND}|"
            f"on which side of {_BAND} (({_GRIP}) is|we are)|"
            f"(whether|if) ({_GRIP}) is {_SCALE}|where ({_GRIP}) (is|lies|stands) "
            f"(relative to|compared with|with respect to) {_BAND}|"
            f"(whether|if) we are {_HOLDING} [{{thing}}] too (lightly|loosely|little) or too "
            "(hard|tightly|much)",
            f"({_GRIP}) (against|compared with|in relation to|relative to|versus) {_BAND}|"
            f"({_GRIP}) , {_SCALE}|{_SCALE}|{_FORCE} : {_SCALE}|[felt|measured|present] {_FORCE} "
            f"(vs|versus|against|compared to) [the] (target|wanted|agreed|goal|force) (range|band|window) "
            f"[: (below , within or above|above , below or within|above , below , within|"
            f"below , within , above|within , above or below)]",
            "",
        ),
        build=lambda bindings, _: Which(name="force_band", length=length_of(bindings)),
    ),
    QuestionFamily(
        name="band_wanted",
        pattern=(
            "{lead} ( (what|which) force (are we|am I|is the robot) (aiming for|aiming at|"
            "supposed to "
            "(use|apply)|going for|looking for|after|targeting) {tail} ? "
            "| (what|which) [range of] force (is|was) (wanted|agreed|required|asked for|prescribed|"
            "agreed on|specified|aimed at) [for {body}|in the contract] {tail} ? "
            "| (what|which) force (does|did) the (contract|goal) (want|ask for|say|demand|"
            "require|prescribe|specify) [for {body}] {tail} ? "
            "| how hard (should|shall|must) (we|I|the robot) (grip|squeeze|hold|press|pinch) "
            "{thing} "
            "{tail} ? | how (hard|firmly|tightly) should {thing} be (held|gripped|squeezed|"
            "pressed) {tail} "
            "? | how much force (should|shall|must) (we|I) (use|apply) [on {body}] {tail} ? "
            "| how much force does the contract (want|ask for|require) {tail} ? "
            "| between which forces (should|must|do) we (stay|be|keep) {tail} ? "
            "| from what to what force [does the band (go|reach)] {tail} ? "
            "| {ask} (what|which) force (we are aiming for|is wanted|was agreed|the contract wants|"
            "we should use|we agreed on) {tail} [?] "
            "| {ask} how (hard|firmly|tightly) (we|I) should (hold|grip|squeeze|press) {thing} "
            "{tail} [?] "
            "| [{want}] (the [wanted|agreed|target|desired|required] force (band|range|window)|"
            "the target force|the goal force|the wanted force|the force (we want|we agreed on|"
            "we are aiming for)|the (two|both) ends of the [force] band|the (lower and upper|"
            "upper and "
            "lower|lower and the upper) (end|bound|bounds|ends) of the [force] band|"
            "the least and the most force that is wanted|the force goal|the force target) "
            "[in (newtons|N)] {tail} [?] "
            "| what is the [force] (goal|target|band|range we want) [in (newtons|N)] {tail} ? )"
        ),
        build=_wanted,
    ),
)
