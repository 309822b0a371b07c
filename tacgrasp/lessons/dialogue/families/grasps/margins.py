"""Families about how far the force is from the contract's band, and about multiples of it.

Not here: the force left to the limit (``tacgrasp.lessons.dialogue.families.amounts.agreed``).
"""

from __future__ import annotations

from tacgrasp.lessons.dialogue.families.amounts.wordings import (
    AmountWording,
    Asked,
    amount_family,
)
from tacgrasp.lessons.dialogue.families.grasps.force import asked_or_stated, conditional
from tacgrasp.lessons.dialogue.patterns.family import QuestionFamily

_BAND = (
    "(the [force|target|wanted|agreed] (band|range|window|corridor)|the goal|the target|the spec)"
)
_LOW_END = (
    f"({_BAND}|the (lower|bottom|low) (end|edge|bound) of {_BAND}|the (least|minimum) [force] "
    "(wanted|required|needed)|the minimum|the start of the band)"
)
_HIGH_END = (
    f"({_BAND}|the (upper|top|high) (end|edge|bound) of {_BAND}|the (most|maximum) [force] "
    "(wanted|required|asked for)|the end of the band)"
)
_FORCE = "(the|our|this) (force|grip|grip force|squeeze|pressure|hold)"
_HOLD = "(squeeze|grip|press|pinch|hold|clamp)"

_NONE = (
    "[, (zero|nothing) if (there is none|none|not|it is not)|, zero otherwise|, or zero|"
    ", (say|answer) zero if (there is none|not|none)]"
)

_LACKING = AmountWording(
    asked=(
        Asked(
            "how much [more] force",
            f"(is (missing|lacking|needed|wanting|still needed) [to (reach|get into|enter) {_BAND}]|"
            f"do we (still need|lack|need to add) [to (reach|get into|enter) {_BAND}]|must (we|I) add "
            f"[to (reach|get into) {_BAND}]|does it take to (reach|get into|enter) {_BAND}|"
            "are we short of)",
            f"(is (missing|lacking|still needed) [to (reach|enter) {_BAND}]|we (lack|still need|must "
            f"add) [to (reach|get into) {_BAND}]|it takes to (reach|get into) {_BAND})",
        ),
        Asked(
            "(how far|by how much)",
            f"(is {_FORCE}|are we) (below|under|short of) {_LOW_END}|does {_FORCE} (fall short of|"
            f"miss) {_LOW_END}",
            f"({_FORCE} is|we are) (below|under|short of) {_LOW_END}",
        ),
        Asked(
            "how much (harder|tighter|firmer|more)",
            f"(must|should|do) (we|I) (have to|need to|) {_HOLD} to (reach|get into|enter) {_BAND}",
            f"(we|I) (must|should|have to) {_HOLD} to (reach|get into|enter) {_BAND}",
        ),
        Asked(
            "what",
            f"(is (missing|lacking) to {_LOW_END}|separates us from {_LOW_END} (below|underneath))",
            f"(is (missing|lacking) to {_LOW_END})",
        ),
    ),
    counted=(
        Asked(
            "how many {unit}",
            f"(are (missing|lacking|still needed)|do we lack|are we short|is {_FORCE} (below|short "
            f"of) {_LOW_END}|must we add to reach {_BAND})",
            f"(are (missing|lacking|still needed)|we lack|we are short|we must add to reach {_BAND})",
        ),
    ),
    nouns=(
        f"the (missing|lacking) force|the (shortfall|shortage|deficit|deficiency) [of force|in "
        f"force]|the force (that is (missing|lacking)|we lack) [to {_LOW_END}]|"
        f"the (gap|distance|climb) up to {_LOW_END}"
    ),
    bare=(
        f"(shortfall|shortage|deficit) (below|under|against) (the band|{_LOW_END}) {_NONE}|"
        "shortfall|missing force|lacking force|force deficit|force (missing|lacking) to the band|"
        "force shortfall|gap up to the band|margin below the band"
    ),
    terse="{unit} (missing|short|lacking|too few)|[how many] {unit} up to the band",
    others=(
        f"what do we lack in force|how much too (weak|light|loose|low) is {_FORCE}|"
        f"how much too (weakly|lightly|loosely|little) do we {_HOLD}|how much more [force] (until|till|before) "
        f"(we are|it is) in {_BAND}|how much more [force] to (reach|get into|be in) {_BAND}"
    ),
)

_EXCESS = AmountWording(
    asked=(
        Asked(
            "how much [of the] force",
            f"(is (too much|in excess|superfluous|over the top|unnecessary)|(must|should|can) (we|I) "
            f"(take off|take away|let go|give up|drop|shed) to (return to|get back into|reach) "
            f"{_BAND})",
            f"(is (too much|in excess|superfluous)|(we|I) (must|should) (take off|drop|shed) to "
            f"(return to|get back into) {_BAND})",
        ),
        Asked(
            "(how far|by how much)",
            f"(is {_FORCE}|are we) (above|over|beyond|past) {_HIGH_END}|does {_FORCE} (exceed|"
            f"overshoot|overstep) {_HIGH_END}|did we overshoot {_HIGH_END}",
            f"({_FORCE} is|we are) (above|over|beyond|past) {_HIGH_END}|{_FORCE} (exceeds|"
            f"overshoots) {_HIGH_END}",
        ),
        Asked(
            "how much (softer|looser|gentler|less)",
            f"(must|should|do) (we|I) (have to|need to|) {_HOLD} to (return to|get back into) {_BAND}",
            f"(we|I) (must|should|have to) {_HOLD} to (return to|get back into) {_BAND}",
        ),
    ),
    counted=(
        Asked(
            "how many {unit}",
            f"(are (too much|too many|in excess)|is {_FORCE} (above|over|past) {_HIGH_END}|are we "
            f"(above|over|past) {_HIGH_END}|must we (take off|shed) to get back into {_BAND})",
            f"(are (too much|too many|in excess)|we are (above|over|past) {_HIGH_END})",
        ),
    ),
    nouns=(
        f"the (surplus|excess|superfluous|unneeded) [of] force|the (surplus|overshoot|excess) [over "
        f"{_BAND}]|the force (beyond|above|over) {_BAND}"
    ),
    bare=(
        f"(overshoot|excess|surplus) (past|over|beyond|above) (the band|{_HIGH_END}) {_NONE}|"
        "surplus|overshoot|excess force|force surplus|surplus force|force excess|"
        "force (above|beyond) the band|margin above the band"
    ),
    terse="{unit} (too much|too many|of surplus|in excess)|[how many] {unit} over the band",
    others=(
        f"how much too (firm|strong|tight|high) is {_FORCE}|how much too (hard|firmly|tightly|"
        f"strongly) do we {_HOLD}"
    ),
)

_OF_IT = "(the|our|this|that) (force|grip force|squeeze|grip|pressure|grip strength)"
_TIMES = {
    "twice": (
        f"(twice [as much|{_OF_IT}|that|this]|double [that|this|{_OF_IT}]|two times {_OF_IT}|"
        f"the double [force]|{_OF_IT} doubled|a doubled force|"
        "twice as much force)"
    ),
    "half": (
        f"(half [as much|{_OF_IT}|that|this]|half of (it|that|{_OF_IT})|{_OF_IT} halved|"
        f"a halved force|one half of {_OF_IT}|half as much force)"
    ),
    "thrice": (
        f"(three times (as much|{_OF_IT}|that|this)|triple [that|this|{_OF_IT}]|thrice {_OF_IT}|"
        f"{_OF_IT} tripled|a tripled force|three times as much force)"
    ),
}
_CHANGE = {
    "twice": "(double|doubled)",
    "half": "(halve|halved|cut in half)",
    "thrice": "(triple|tripled)",
}
_JUDGED = {
    "within": (
        "(within (the band|the force band|the goal|spec|the contract)|in (the band|order|spec)|"
        "[just] right|all right|okay|acceptable|on target|fine)"
    ),
    "below": (
        "(too (little|weak|low|light|small|loose|soft)|below the [force] band|under the band|"
        "too little force)"
    ),
    "above": (
        "(too (much|strong|high|firm|hard|great|tight)|above the [force] band|over the band|"
        "too much force)"
    ),
    "enough": "(enough [for the contract]|sufficient|adequate|strong enough|at least enough)",
    "over": (
        "(over the [hard|force] limit|beyond the limit|forbidden|more than [is] (allowed|permitted)|"
        "too much for the limit|above the limit|past the limit|prohibited)"
    ),
    "under": (
        "(under the [hard|force] limit|(still|) (allowed|permitted)|below the limit|"
        "within the limit|legal under the contract)"
    ),
}
_DO = "(we|I|you|the fingers)"

_SCALED = QuestionFamily(
    name="force_times",
    pattern=asked_or_stated(
        "(would|will|might|could) {times} [still|already|perhaps] be {judged}|"
        "is {times} [still|already] {judged}|"
        f"(if|suppose|imagine|say|when) {_DO} {{change}} {_OF_IT} , (would|will|is) (it|that|the "
        f"force) [be|still be] {{judged}}|"
        f"(would|will) it [still] be {{judged}} (if|when|after|once) {_DO} {{change}} {_OF_IT}|"
        f"what if {_DO} {{change}} (it|{_OF_IT}) , (is|would) (it|that) [be|still be] {{judged}}|"
        "with {times} , would (it|we|that) be {judged}|"
        "would [it|that] be {judged} with {times}|"
        "does {times} count as {judged}",
        "{times} (is|would be|will be) [still|already] {judged}|"
        f"(if|when) {_DO} {{change}} {_OF_IT} , (it|that) (is|would be|will be) {{judged}}",
        "{times} , {judged}|{times} : {judged}|{judged} at {times}|{judged} with {times}",
    ),
    build=lambda bindings, numbers: conditional(
        "judged", prefix=f"{bindings.get('times') or bindings['change']} "
    )(bindings, numbers),
    slots={"times": _TIMES, "judged": _JUDGED, "change": _CHANGE},
)

FAMILIES: tuple[QuestionFamily, ...] = (
    amount_family("lacking", "lacking", _LACKING, "N", "mN"),
    amount_family("excess", "excess", _EXCESS, "N", "mN"),
    _SCALED,
)
