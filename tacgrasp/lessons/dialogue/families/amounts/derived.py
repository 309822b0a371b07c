"""Families that ask for what follows from other amounts: multiples, the free area, the band's middle.

Not here: differences from a number of the question (``tacgrasp.lessons.dialogue.families.amounts.differences``).
"""

from __future__ import annotations

from tacgrasp.lessons.dialogue.families.amounts.wordings import (
    UNIT_WORDS,
    AmountWording,
    Asked,
    amount_family,
    amount_slots,
    number_pattern,
)
from tacgrasp.lessons.dialogue.meaning import Amount
from tacgrasp.lessons.dialogue.patterns.family import QuestionFamily, length_of, multiple_of
from tacgrasp.lessons.dialogue.patterns.pattern import Slots

_FORCE = (
    "(the|our|this|that|the (present|felt|current|measured)) (force|grip force|squeeze|grip|"
    "pressure|grip strength|pinch|hold)"
)
_DEPTH = (
    "(the|our|this|that|the (present|felt|current|measured)) ([contact] depth|indentation|dent|"
    "penetration|depth of the (dent|press|contact))"
)
_HELD = (
    "(what (this|the|our) (grip|hold|force) [surely|certainly] (holds|can hold|carries|can carry)|"
    "(the|our|this) (payload|carrying capacity|holding capacity|capacity|heaviest load)|"
    "the (weight|load|mass) (we|this grip) can [surely|certainly] (hold|carry))"
)


def _times(noun: str, much: str) -> Slots:
    """Multiples of what a noun names, and verbs that make them, by their names in queries.

    Args:
        noun: What is multiplied, with its article.
        much: What comes after 'twice as': '(much|hard)'.
    """
    return {
        "times": {
            "half": f"(half|one half of|half of) ({noun})",
            "twice": f"(twice|double|two times|the double of) ({noun})",
            "thrice": f"(three times|thrice|triple|the triple of|threefold) ({noun})",
        },
        "changed": {
            "half": "(halved|cut in half|cut by half|divided by two)",
            "twice": "(doubled|multiplied by two|made twice as (large|big|great))",
            "thrice": "(tripled|multiplied by three|made three times as (large|big|great))",
        },
        "change": {
            "half": "(halve|cut in half|halved)",
            "twice": "(double|doubled)",
            "thrice": "(triple|tripled)",
        },
        "as_much": {
            "half": f"half as {much}",
            "twice": f"(twice|two times) as {much}",
            "thrice": f"(three times|thrice) as {much}",
        },
    }


def _multiple_wording(noun: str, asks: str, do: str) -> AmountWording:
    """Wordings that ask for a multiple of an amount.

    Args:
        noun: What is multiplied, with its article.
        asks: What the question begins with: 'how (much|hard)'.
        do: What is done so many times as much: '(press|squeeze)'.
    """
    would = "(would|will|does|might)"
    return AmountWording(
        asked=(
            Asked(
                f"(how much|what|{asks})",
                "(is|are|would be|would) {times} [be]",
                "{times} (is|would be|comes to|amounts to|makes)",
            ),
            Asked("what", f"{would} {{times}} (be|make|come to|amount to)", "{times} comes to"),
            Asked(
                f"(how much|what|{asks})",
                f"{would} (it|that|the result) (be|make|come to) (if|when) ({noun}) (were|was|is) "
                f"{{changed}}|{would} we (have|get) (if|when) we {{change}} ({noun})",
                f"it would be if ({noun}) (were|was|is) {{changed}}|we (would have|get) (if|when) "
                f"we {{change}} ({noun})",
            ),
            Asked(
                f"(if|suppose|imagine|say|supposing|assume|assuming) (we|you|I|the fingers) "
                f"({do}) {{as_much}} [as now|as we do now|as this] [, then|,] (how much|what|{asks})",
                "would (that|it) be|would (that|it) make|would we have|is (that|it)",
                "that (would be|would make|is)",
            ),
            Asked(
                f"(if|suppose|imagine|supposing|assuming|say) [that] ({noun}) [were|was|is|gets|got] "
                f"{{changed}} [, then|,|:] (how much|what|{asks})",
                "would (that|it) be|would (that|it) make|would we have|is (that|it)",
                "that (would be|would make|is)",
            ),
            Asked(
                f"{{as_much}} [as this|as that|as now] (is|would be|makes) (how much|{asks})",
                "",
                "",
            ),
        ),
        counted=(
            Asked(
                "how many {unit}",
                "(is|are|would be|make|would|does) {times} [be|make]|would (it|that) be (if|when) "
                f"({noun}) (were|was|is) {{changed}}|would {{as_much}} (be|make)",
                "{times} (is|are|would be|comes to|makes)",
            ),
            Asked(
                f"(if|suppose|imagine|supposing|say) (we|you|I) ({do}) {{as_much}} [as now] "
                "[, then|,|:] how many {unit} [deep]",
                "would (that|it) (be|make)|is (that|it)",
                "that would (be|make)",
            ),
            Asked(
                f"(if|suppose|imagine|supposing|say) [that] ({noun}) [were|was|got|is] {{changed}} "
                "[, then|,|:] how many {unit}",
                "would (that|it) (be|make)|is (that|it)",
                "that would (be|make)",
            ),
        ),
        nouns=f"{{times}}|({noun}) {{changed}}|{{times}}",
        bare=f"{{times}}|({noun}) {{changed}}|{{times}} [in numbers|as a number|please]",
        others="{times} (is|are|would be|makes|comes to|equals) (what|how much)",
    )


def _multiple(name: str, noun: str, much: str, asks: str, do: str, *units: str) -> QuestionFamily:
    """A family that asks for half, twice or three times a quantity."""
    symbols = {("gf" if unit == "g" and name == "force" else unit): unit for unit in units}
    return QuestionFamily(
        name=f"{name}_multiple",
        pattern=number_pattern(_multiple_wording(noun, asks, do), is_unit_needed=False),
        slots={
            **amount_slots({unit: UNIT_WORDS[words] for words, unit in symbols.items()}),
            **_times(noun, much),
        },
        build=lambda bindings, _: Amount(
            quantity=multiple_of(bindings, name),
            unit=bindings.get("unit", units[0]),
            length=length_of(bindings),
        ),
    )


_PAD = "(the|our|your) (pad|gel|sensor|skin|fingertip|sensing (area|surface|face)|touch pad)"
_FREE = (
    "(free|uncovered|untouched|bare|empty|unused|clear|vacant|unpressed|out of contact|"
    "not (touched|covered|in contact|used|occupied|pressed)|without contact|unoccupied|left over)"
)
_STAYS = "(stays|is|remains|is left|is still|lies|is being left)"
_FREE_AREA = AmountWording(
    asked=(
        Asked(
            f"(how much|what (part|share|fraction|percentage|portion|proportion)|how large a (part|"
            f"share)) of {_PAD}",
            f"{_STAYS} {_FREE} [of {{thing}}|by {{thing}}]|does {{thing}} (leave|not) "
            "(free|untouched|uncovered|cover|touch|reach)|(touches|feels|meets) nothing|"
            "is there nothing on",
            f"{_STAYS} {_FREE}|{{thing}} leaves (free|untouched|uncovered)|touches nothing",
        ),
        Asked(
            f"how much (of the area|area|room|space) on {_PAD}",
            f"{_STAYS} {_FREE}|does {{thing}} leave (free|untouched)",
            f"{_STAYS} {_FREE}|{{thing}} leaves (free|untouched)",
        ),
        Asked(f"how {_FREE}", f"is {_PAD} [still]|is the rest of {_PAD}", f"{_PAD} is [still]"),
        Asked(
            "how (large|big)",
            f"is the {_FREE} (part|area|share|remainder|rest) [of {_PAD}]",
            f"the {_FREE} (part|area|share|rest) [of {_PAD}] is",
        ),
    ),
    counted=(
        Asked(
            f"(how many|what) {{unit}} of {_PAD}",
            f"{_STAYS} {_FREE}|(are|do) [still] {_FREE}|does {{thing}} (leave|not) (free|cover|touch)",
            f"(are|remain|stay) {_FREE}",
        ),
    ),
    nouns=(
        f"the {_FREE} (part|area|share|fraction|portion|percentage|remainder|surface) [of {_PAD}]|"
        f"the (part|share|area|fraction) of {_PAD} that (is|stays|remains) {_FREE}|"
        f"the (rest|remainder) of {_PAD}|the area [that] {{thing}} (does not (cover|touch)|"
        f"leaves free)"
    ),
    bare=(
        f"{_FREE} (area|part|share|surface|fraction|percentage)|rest of {_PAD}|free pad|"
        f"free share of {_PAD}|{_PAD} minus the contact [area]|area left over"
    ),
    terse=f"{{unit}} (free|uncovered|untouched|still free)|{_FREE} {{unit}}",
)

_BAND = (
    "(the|our|this) [force|wanted|target|goal|agreed|allowed|contract] (band|range|window|corridor|"
    "interval)|the (band|range) (of the contract|we agreed on|that is wanted)|the contract's band"
)
_MIDDLE = "(middle|center|midpoint|mid point|mean|halfway point|mid|exact middle|very middle)"
_BAND_MIDDLE = AmountWording(
    asked=(
        Asked(
            "(what|which) force",
            f"(sits|lies|is|falls) [right|exactly|just] (in the {_MIDDLE} of|at the {_MIDDLE} of|"
            f"halfway (through|into|up)|in the middle between the ends of) ({_BAND})|is the {_MIDDLE} "
            f"of ({_BAND})|is (equally far from|halfway between) (both|the two|the) ends [of ({_BAND})]",
            f"(sits|lies|is) [right|exactly] (in|at) the {_MIDDLE} of ({_BAND})",
        ),
        Asked(
            "(what|where|how large|at what force)",
            f"is the {_MIDDLE} of ({_BAND})|does the {_MIDDLE} of ({_BAND}) lie",
            f"the {_MIDDLE} of ({_BAND}) (is|lies)",
        ),
        Asked(
            "what",
            f"(is|would be) (halfway|midway) between the (least|lower|minimum) and the (most|upper|"
            f"maximum) [force] [wanted|end|bound]|is the (mean|average) of the [two] (ends|bounds|"
            f"limits) of ({_BAND})",
            f"the (mean|average) of the [two] (ends|bounds) of ({_BAND}) is",
        ),
        Asked(
            "(what|which) force",
            f"should we aim (at|for) to be (in the middle|right in the middle|well inside) [of ({_BAND})]|"
            f"would put us [right] in the {_MIDDLE} of ({_BAND})",
            f"would put us in the {_MIDDLE} of ({_BAND})",
        ),
    ),
    counted=(
        Asked(
            "(at how many|how many) {unit}",
            f"is the {_MIDDLE} of ({_BAND})|does the {_MIDDLE} of ({_BAND}) lie|(are|lie) [exactly] in "
            f"the {_MIDDLE} of ({_BAND})",
            f"the {_MIDDLE} of ({_BAND}) (is|lies)",
        ),
    ),
    nouns=(
        f"the {_MIDDLE} of ({_BAND})|the (middle|mean|central) (force|value) of ({_BAND})|the force "
        f"(in|at) the {_MIDDLE} of ({_BAND})|the (mean|average) of the [two] ends of ({_BAND})|the band's "
        f"{_MIDDLE}"
    ),
    bare=(
        f"band (middle|center|midpoint)|{_MIDDLE} of ({_BAND})|mid-band force|middle (force|value) of "
        f"({_BAND})|mean of the band ends|central target force"
    ),
    terse="{unit} (in|at) the middle of the band",
)
_OF_MIDDLE = f"(the {_MIDDLE} of ({_BAND})|the band's (middle|center)|mid-band)"
_OUR_FORCE = (
    "((the|our|this|the present|the felt|the current) (force|grip|grip force|squeeze|pressure)|we|"
    "our grip)"
)
_IS = "(is|are)"
_EITHER = "[, either way|, in either direction|, no matter which side|, whichever side|, without a sign|, never mind the sign|]"
_OFF_MIDDLE = AmountWording(
    asked=(
        Asked(
            "(how far|by how much|how much)",
            f"{_IS} {_OUR_FORCE} (from|away from|off|beside) {_OF_MIDDLE} {_EITHER}|(does|do|did) "
            f"{_OUR_FORCE} (miss|differ from|deviate from) {_OF_MIDDLE} {_EITHER}",
            f"{_OUR_FORCE} {_IS} (from|away from|off) {_OF_MIDDLE} {_EITHER}|{_OUR_FORCE} (misses|"
            f"differs from) {_OF_MIDDLE}",
        ),
        Asked(
            f"(from|measured from) {_OF_MIDDLE} [,] how far [away|off]",
            f"{_IS} {_OUR_FORCE} {_EITHER}",
            f"{_OUR_FORCE} {_IS} {_EITHER}",
        ),
        Asked(
            "(how close|how near)",
            f"{_IS} {_OUR_FORCE} to {_OF_MIDDLE}",
            f"{_OUR_FORCE} {_IS} to {_OF_MIDDLE}",
        ),
        Asked(
            "what",
            f"is the (distance|difference|gap|deviation|offset) (between|of) {_OUR_FORCE} (and|from) "
            f"{_OF_MIDDLE} {_EITHER}|separates {_OUR_FORCE} from {_OF_MIDDLE}",
            f"the (distance|difference|gap) between {_OUR_FORCE} and {_OF_MIDDLE} is",
        ),
    ),
    counted=(
        Asked(
            "how many {unit}",
            f"{_IS} {_OUR_FORCE} (from|away from|off) {_OF_MIDDLE} {_EITHER}|lie between {_OUR_FORCE} and "
            f"{_OF_MIDDLE}",
            f"{_OUR_FORCE} {_IS} (from|away from|off) {_OF_MIDDLE}",
        ),
    ),
    nouns=(
        f"the (distance|difference|gap|deviation|offset) (between|of) {_OUR_FORCE} (and|from) {_OF_MIDDLE}|"
        f"the (distance|deviation|offset|difference) [of the force] (from|to) {_OF_MIDDLE}"
    ),
    bare=(
        f"(distance|deviation|offset) (from|to) {_OF_MIDDLE}|force (minus|against) {_OF_MIDDLE} {_EITHER}|"
        f"off {_OF_MIDDLE} by"
    ),
    terse="{unit} (off|from|away from) the (middle|center) of the band",
)
_BAND_WIDTH = AmountWording(
    asked=(
        Asked("how (wide|broad|narrow|large)", f"is ({_BAND})", f"({_BAND}) is"),
        Asked(
            "(how much|what) [force]",
            f"(is|lies) between the (ends|two ends|bounds|limits|edges) of ({_BAND})|does ({_BAND}) span|"
            f"separates the (two ends|ends) of ({_BAND})",
            f"(is|lies) between the (ends|bounds) of ({_BAND})|({_BAND}) spans",
        ),
        Asked(
            "(how much|what) (room|play|leeway|scope)",
            f"does ({_BAND}) (leave|give|allow|have)|is there (in|within) ({_BAND})",
            f"({_BAND}) (leaves|gives|allows)",
        ),
        Asked(
            "(what|how large)",
            f"is the (width|breadth|span|extent|size) of ({_BAND})",
            f"the (width|breadth|span|extent) of ({_BAND}) is",
        ),
        Asked(
            "how far",
            f"(apart are|is it between) the (ends|two ends|bounds|edges) of ({_BAND})",
            f"apart the (ends|two ends|bounds) of ({_BAND}) are",
        ),
    ),
    counted=(
        Asked(
            "how many {unit}", f"(wide|broad) is ({_BAND})|does ({_BAND}) span", f"({_BAND}) spans"
        ),
    ),
    nouns=(
        f"the (width|breadth|span|extent|spread|size) of ({_BAND})|the (distance|difference|gap) between "
        f"the (ends|two ends|bounds|upper and [the] lower (end|bound)) of ({_BAND})"
    ),
    bare="band width|width of the band|band span|breadth of the band|range width|upper end minus lower end [of the band]",
    terse="{unit} (wide|between the ends of the band)",
)
_BAND_TO_LIMIT = AmountWording(
    asked=(
        Asked(
            "(how much|what) [force]",
            f"(lies|is) between (the (top|upper end|end) of ({_BAND})|({_BAND})) and the [hard|force] limit",
            f"(lies|is) between the (top|upper end|end) of ({_BAND}) and the [hard|force] limit",
        ),
        Asked(
            "how far",
            f"is the [hard|force] limit (above|over|from|beyond) (({_BAND})|the (top|upper end) of ({_BAND}))|"
            f"(does|is) ({_BAND}) (end|below|end below|under) the [hard|force] limit",
            f"the [hard|force] limit (is|lies) (above|over|from|beyond) ({_BAND})",
        ),
        Asked(
            "how much (room|margin|reserve|space|distance)",
            f"(is there|lies|is left) between ({_BAND}) and the [hard|force] limit",
            f"there is between ({_BAND}) and the [hard|force] limit",
        ),
    ),
    counted=(
        Asked(
            "how many {unit}",
            f"(lie|are|are there) between (the (top|upper end|end) of ({_BAND})|({_BAND})) and the [hard|"
            f"force] limit|is the [hard|force] limit (above|over) ({_BAND})",
            f"(lie|are) between ({_BAND}) and the limit",
        ),
    ),
    nouns=(
        f"the (gap|distance|difference|room|margin) between (the (top|upper end) of ({_BAND})|({_BAND})) and "
        f"the [hard|force] limit|the [hard] limit minus the (upper end|top|end) of ({_BAND})"
    ),
    bare=(
        "gap between band and limit|band to limit distance|room between the band and the limit|"
        "limit minus band end|margin from the band to the limit"
    ),
)

_TOP = (
    "(the [hard|force|grip|safety|allowed] limit|the limit force|the (allowed maximum|permitted maximum|"
    "allowed force|permitted force)|the (maximum|largest|highest) (allowed|permitted) force|our limit|"
    "what (is allowed|the contract allows))"
)
_SPENT = "(used|used up|in use|spent|taken|exhausted|consumed|reached|already used|being used)"
_USED_UP = (
    "(is|are we|is already|is being|are|has been|have we|are we already) {spent}|"
    "(do|did|does) (we|I|our grip|the grip|the force|this grip) (use|use up|need|take up|reach|make up|"
    "amount to)|is (the [present|felt|current] force|our (force|grip)|this [force])|"
    "are we (using|using up|at|running at)"
)
_USED = AmountWording(
    asked=(
        Asked(
            f"(what|which|how many|how large a) (percent|percentage|per cent|share|fraction|proportion|part) of {_TOP}",
            _USED_UP,
            "(is|we have) {spent}|(we|I) (use|use up|reach)|the [present|felt] force is",
        ),
        Asked(
            f"how much of {_TOP}",
            _USED_UP,
            "(is|we have) {spent}|(we|I) (use|use up)",
        ),
        Asked(
            f"in percent of {_TOP} [, | ,|,] (how (large|high|strong)|what)",
            "is (the [present|felt] force|our (force|grip))",
            "the [present|felt] force is",
        ),
        Asked(
            "how (high|large|big|far) in percent",
            f"is (the [present|felt] force|our (force|grip)) (against|compared (to|with)|relative to|of) {_TOP}",
            f"(the force|our grip) is (against|compared with|relative to) {_TOP}",
        ),
        Asked(
            "(to what|to which) (extent|percentage|degree)",
            f"(is|have we) {_TOP} {{spent}}",
            f"{_TOP} is {{spent}}",
        ),
    ),
    counted=(
        Asked(
            f"how many {{unit}} of {_TOP}",
            _USED_UP,
            "(is|are) {spent}|(we|I) (use|use up)",
        ),
    ),
    nouns=(
        f"the [used|present|felt] force (in percent|as a (percentage|share|fraction)|as a percent) of {_TOP}|the "
        f"(percentage|share|fraction|proportion) of {_TOP} [that is|that we have|we have] {{spent}}|the force (relative "
        f"to|divided by|over) {_TOP} [in percent|as a percentage]|the (use|usage|utilisation|utilization) of {_TOP}|the "
        f"used (part|share|fraction|percentage) of {_TOP}"
    ),
    bare=(
        f"(limit|force limit) (usage|utilisation|utilization|use)|(percent|percentage|share|fraction) of {_TOP} "
        f"[that is] {{spent}}|force in percent of {_TOP}|force (as percent|as percentage|as share) of {_TOP}|"
        f"used (percentage|share) of {_TOP}"
    ),
    terse=f"[how many] {{unit}} of {_TOP} [{{spent}}]",
    others=(
        f"how close [in percent] to {_TOP} are we [in percent|as a percentage]|(what|which) "
        f"percentage are we at [of {_TOP}]|how (full|exhausted) is {_TOP} [in percent]"
    ),
)

_GRIP = "(the grip|this grip|our grip|the hold|this hold|the gripper|we|the force|this squeeze)"
_MASS = (
    "(the (mass|weight|load) [(I|we) (told|gave) you|you were told|that is given|I mentioned|I stated]|the "
    "(given|told|stated|known) (mass|weight)|its (mass|weight)|what {thing} weighs|this (mass|weight))"
)
_MINUS = (
    "[, (negative|minus|with a minus|use a minus) if (too weak|it is too weak|not enough|it can not hold it|it "
    "would slip)|, signed|, with its sign|, with sign|, minus (meaning|means|for) too weak|]"
)
_SPARE_NOUN = "(reserve|spare|margin|surplus|headroom|capacity left|spare capacity|slack|safety margin|reserve capacity)"
_SPARE = AmountWording(
    asked=(
        Asked(
            "how much (more|additional|extra) [weight|mass|load] (than|beyond|on top of|besides|over)",
            f"{_MASS} (can|could|would|does) {_GRIP} (hold|carry|bear|take|manage) {_MINUS}",
            f"{_MASS} {_GRIP} (can|could|would) (hold|carry|bear|take) {_MINUS}",
        ),
        Asked(
            "how much (weight|mass|load)",
            f"(can|could|would) {_GRIP} (hold|carry|bear) (beyond|on top of|over and above|besides) {_MASS} "
            f"{_MINUS}|(could|can|may) we (add|put on|load) to {_MASS} (before it slips|without slipping)",
            f"{_GRIP} (can|could) (hold|carry) (beyond|on top of) {_MASS} {_MINUS}",
        ),
        Asked(
            f"how much {_SPARE_NOUN} [in weight|of weight|in mass]",
            f"(has|does) {_GRIP} [have] (beyond|over|above|on top of|against|for|at|with) {_MASS} {_MINUS}|is "
            f"there (beyond|over|above|at) {_MASS} {_MINUS}",
            f"{_GRIP} has (beyond|over|above|for|at) {_MASS} {_MINUS}|there is beyond {_MASS}",
        ),
        Asked(
            "(how much|by how much)",
            f"does (what (this|the) (grip|hold) (holds|can hold)|the (capacity|payload)) exceed {_MASS} {_MINUS}|"
            f"(heavier|more) could {{thing}} (be|weigh|get) (before it slips|without slipping) {_MINUS}",
            f"(what this grip holds|the (capacity|payload)) exceeds {_MASS} {_MINUS}",
        ),
    ),
    counted=(
        Asked(
            f"how many {{unit}} [of {_SPARE_NOUN}|more|extra|to spare]",
            f"(has|does) {_GRIP} [have] (beyond|over|above|for|at|with) {_MASS} {_MINUS}|(can|could) {_GRIP} "
            f"(hold|carry|take) (beyond|on top of|more than) {_MASS} {_MINUS}|are left (beyond|over|at) {_MASS}|"
            f"(heavier|more) could {{thing}} (be|weigh) (before it slips|without slipping)",
            f"{_GRIP} (has|can hold) (beyond|above|on top of) {_MASS} {_MINUS}",
        ),
    ),
    nouns=(
        f"the {_SPARE_NOUN} (of the (grip|hold)|we have|in grams|) (beyond|over|above|for|at|with) {_MASS} {_MINUS}|"
        f"the load (this grip holds|held) beyond {_MASS} {_MINUS}|the (capacity|payload) minus {_MASS} {_MINUS}|"
        f"the (weight|mass|load) we could (add|still add) (before it slips|without slipping) {_MINUS}"
    ),
    bare=(
        f"(weight|mass|load|payload|holding|carrying) (reserve|surplus|margin|headroom) {_MINUS}|capacity minus "
        f"{_MASS}|(payload|capacity) left (over|beyond) {_MASS} {_MINUS}|{_SPARE_NOUN} (beyond|over|at) {_MASS} "
        f"{_MINUS}|spare (payload|load|weight capacity)"
    ),
    terse="{unit} (to spare|of reserve) (beyond|over|at) (the mass|the weight|this weight)",
)

FAMILIES: tuple[QuestionFamily, ...] = (
    _multiple(
        "force",
        _FORCE,
        "(much|hard)",
        "how (hard|strong|much force)",
        "press|squeeze|grip|hold|pinch|clamp|pressed|squeezed|gripped|pushed",
        *("N", "mN", "g"),
    ),
    _multiple(
        "depth",
        _DEPTH,
        "(much|far|deep)",
        "how (deep|far)",
        "press in|pressed in|go in|went in|push in|pushed in|sink in|sank in|dent it",
        *("mm", "µm"),
    ),
    _multiple(
        "holds",
        _HELD,
        "(much|many)",
        "how (heavy|much weight|many grams)",
        "hold|carry|held|carried|could hold|can hold",
        "g",
    ),
    amount_family("free_area", "free_area", _FREE_AREA, "%"),
    amount_family("band_middle", "band_middle", _BAND_MIDDLE, "N", "mN"),
    amount_family("off_middle", "off_middle", _OFF_MIDDLE, "N", "mN"),
    amount_family("band_width", "band_width", _BAND_WIDTH, "N", "mN"),
    amount_family("band_to_limit", "band_to_limit", _BAND_TO_LIMIT, "N", "mN"),
    amount_family("spare", "spare", _SPARE, "g"),
    amount_family("used", "used", _USED, "%", slots={"spent": _SPENT}),
)
