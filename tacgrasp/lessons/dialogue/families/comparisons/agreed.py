"""Families that compare mass, limit, band and load with a number."""

from __future__ import annotations

from tacgrasp.lessons.dialogue.families.comparisons.felt import compare_family
from tacgrasp.lessons.dialogue.families.comparisons.thresholds import BETWEEN
from tacgrasp.lessons.dialogue.families.comparisons.wordings import (
    MORE,
    NOT_COMPARED,
    measured_pattern,
    not_measured_pattern,
    slots_of,
    thing_pattern,
)
from tacgrasp.lessons.dialogue.patterns.family import QuestionFamily
from tacgrasp.lessons.dialogue.patterns.pattern import Slots

_FIXED_MASSES = {
    "100 g": "(a hundred|one hundred) grams",
    "200 g": "two hundred grams",
    "50 g": "fifty grams",
    "20 g": "twenty grams",
    "500 g": "five hundred grams",
    "1 kg": "one (kilogram|kilo|kg)",
    "2 kg": "two (kilograms|kilos)",
}
_FIXED_FORCES = {
    "0.5 N": "half a newton",
    "1 N": "(one newton|a newton)",
    "2 N": "two newtons",
    "3 N": "three newtons",
    "5 N": "five newtons",
}
_SHARED: Slots = {
    "compared": MORE,
    "not_compared": NOT_COMPARED,
    "least": {">=": ""},
}
_MASS_SLOTS: Slots = {
    **slots_of(("g", "kg"), _FIXED_MASSES),
    **_SHARED,
    "heavier": {
        ">": "(heavier than|heavier than|weightier than)",
        "<": "(lighter than|lighter than|less heavy than|not as heavy as)",
        ">=": "(at least as heavy as|no lighter than|as heavy as|not lighter than)",
        "<=": "(no heavier than|not heavier than|at most as heavy as)",
    },
    "or_heavier": {">=": "(or heavier|or more)", "<=": "(or lighter|or less)"},
    "hold": "(hold|carry|lift|bear|support|take|manage|keep|handle|hold on to)",
    "grip": "(this grip|the grip|our grip|this force|the gripper|this hold|these fingers)",
    "can": "(can|can|could|will)",
}
_FORCE_SLOTS: Slots = {
    **slots_of(("N",), _FIXED_FORCES),
    **_SHARED,
    "allowed": "(allowed|permitted|acceptable|tolerated|within the limit|admissible)",
    "want": "(ask for|want|demand|require|call for|prescribe|specify)",
    "contract": "(contract|band|force band|goal|task|agreement|target)",
    "left": "(left|left over|to spare|in reserve|remaining|free)",
    "to_limit": "(to|until|before|up to|below) the [hard|force] limit",
    "end": "(end|stop|finish|top out)",
    "ends": "(ends|stops|finishes|tops out)",
    "start": "(start|begin|set in)",
    "starts": "(starts|begins|sets in)",
}

_MASS = (
    "(the|its) (mass|weight)|the (mass|weight) of {thing}|weight|mass|"
    "the given (mass|weight)|the weight that you were told"
)
_MASS_DIRECT = (
    "is {thing} {now} {heavier} {amount}|(does|doesn't|did) {thing} weigh {now} ({compared})|"
    "is {thing} {amount} {or_heavier}|does {thing} weigh {amount} {or_heavier}|"
    "is {thing} ({compared}) (in weight|heavy)|are we (holding|lifting|carrying) something "
    "{heavier} {amount}|do we (hold|have|carry) ({compared}) of (weight|mass)|"
    "does {thing} have a (mass|weight) of ({compared})|"
    "is {thing} a (thing|part|load) of ({compared})|does {thing} bring ({compared}) to the scale"
)
_MASS_STATEMENTS = (
    "{thing} is {now} {heavier} {amount}|{thing} weighs ({compared})|"
    "{thing} has a (mass|weight) of ({compared})|{thing} is {amount} {or_heavier}"
)
_MASS_BARE = "{heavier} {amount}|weighing ({compared})|({compared}) in weight|({compared}) heavy"

_HOLDS = (
    "the (largest|greatest|highest|maximum) (weight|mass|load) (we|this grip|these fingers) can "
    "(hold|carry)|the (payload|carrying capacity|capacity) [of this grip]|"
    "the load [that] (we|this grip) can (hold|carry|bear)|the (maximum|largest) payload|"
    "the holding capacity"
)
_HOLDS_DIRECT = (
    "{can} (we|{grip}) {now} {hold} {at_least_or}|(will|does) {grip} {hold} {at_least_or}|"
    "is {grip} (good|strong enough|enough|sufficient|fit) for {at_least_or}|"
    "could (something|a thing|a load|an object) of {least} {amount} be (held|carried|lifted) "
    "[with this grip]|is ({compared}) the most (we|{grip}) can {hold}|"
    "is (the most|all) (we|{grip}) can {hold} ({compared})"
)
_HOLDS_STATEMENTS = (
    "(we|{grip}) can {hold} {at_least_or}|{grip} is (good|strong enough|enough) for {at_least_or}|"
    "the most (we|{grip}) can {hold} is ({compared})"
)
_HOLDS_BARE = (
    "a payload of ({compared})|{grip} (good|enough|strong enough) for {at_least_or}|"
    "able to {hold} {at_least_or}|a capacity of ({compared})"
)

_LIMIT = (
    "the (hard|force|grip|safety|upper|given|agreed) limit|the limit|the limit (of|on|for) "
    "(the force|{body}|the contract)|the contract's limit|the force's limit|limit|force limit|"
    "the limit (in|of) the contract"
)
_LIMIT_DIRECT = (
    "is {least} {amount} [still] {allowed}|are {least} {amount} [still] {allowed}|"
    "(may|can) we (go up to|press with up to|use up to|grip with up to) {least} {amount}|"
    "are we allowed (up to|to go up to|to press with up to) {least} {amount}|"
    "is the limit (set|fixed|placed|put) (at|to) ({compared})|"
    "does the contract (set|have|give|put) a limit (of|at) ({compared})|"
    "do we have a limit of ({compared})|was a limit of ({compared}) (given|agreed|set)"
)
_LIMIT_STATEMENTS = (
    "{least} {amount} (is|are) [still] {allowed}|the limit is set (at|to) ({compared})|"
    "we (may|can) go up to {least} {amount}|there is a limit of ({compared})"
)
_LIMIT_BARE = "a limit of ({compared})|limit ({compared})|{least} {amount} {allowed}"

_LOW = (
    "the (least|lowest|smallest|minimum|minimal) force (of the band|in the contract|that is wanted|"
    "wanted|[that] we want|allowed by the band)|the (lower|low|bottom) (end|edge|bound|limit) of the "
    "[force] band|the (start|bottom|beginning) of the [force] band|the band's (lower end|start)|"
    "the minimum force|the required minimum|the lower bound|the least force"
)
_LOW_DIRECT = (
    "(does|did) the [force] band {start} (at ({compared})|{position} {amount})|"
    "does the {contract} {want} {more_least} {amount} [at the least|as a minimum]|"
    "is the (least|minimum) [that is] wanted ({compared})"
)
_LOW_STATEMENTS = (
    "the [force] band {starts} (at ({compared})|{position} {amount})|"
    "the {contract} {want_s} {more_least} {amount}|the least [that is] wanted is ({compared})"
)
_LOW_BARE = "a band {from} {position} {amount}|a minimum force of ({compared})|band start {position} {amount}"

_HIGH = (
    "the (most|highest|largest|greatest|maximum) force (of the band|in the contract|that is wanted|"
    "wanted|[that] we want)|the (upper|top|high) (end|edge|bound) of the [force] band|"
    "the (end|top) of the [force] band|the band's (upper end|end|top)|the upper bound|"
    "the most force"
)
_HIGH_DIRECT = (
    "(does|did) the [force] band {end} (at ({compared})|{position} {amount})|"
    "does the [force] band (reach|extend|go) {up_to} {amount}|"
    "is the most [that is] wanted ({compared})"
)
_HIGH_STATEMENTS = (
    "the [force] band {ends} (at ({compared})|{position} {amount})|"
    "the [force] band (reaches|extends|goes) {up_to} {amount}|the most [that is] wanted is ({compared})"
)
_HIGH_BARE = "a band (ending|that ends) {position} {amount}|band end {position} {amount}"

_ROOM = (
    "the (distance|margin|room|gap|reserve|headroom) (to|below|up to|under) the [force|hard] limit|"
    "the force (that is|) left (to|below|before) the limit|the force margin|the headroom|"
    "the (safety|remaining) margin|our (margin|headroom|reserve)|the force we may still add|"
    "headroom|the (gap|difference) between the force and the limit"
)
_ROOM_DIRECT = (
    "(is|are) there {now} ({compared}) {left} [{to_limit}]|do we have ({compared}) {left} [{to_limit}]|"
    "have we [got] ({compared}) {left} [{to_limit}]|are we {now} ({compared}) (below|under|short of|"
    "away from|from) the [force|hard] limit|is the limit ({compared}) away|"
    "(can|may|could) we [still] (add|press|squeeze|grip) [with] {another} {amount} [more|harder] "
    "(before|without reaching|until) the limit|"
    "(can|may|could) (we|I) [still] (add|put on|apply|use|go up by) {another} {amount} [more] [and [still] (not "
    "(break|exceed|pass|reach|cross)|keep below|stay (below|under|within)|be (below|under|within)) the [force|hard] "
    "limit]|is there {now} ({compared}) [of force] in (hand|reserve|store) [{to_limit}|until the limit is reached|"
    "before the limit is reached]|"
    "is the (force|grip) ({compared}) (below|under) the [force|hard] limit|"
    "(do|does) ({compared}) remain {to_limit}|(is|are) ({compared}) {left} {to_limit}"
)
_ROOM_STATEMENTS = (
    "there (is|are) ({compared}) {left} [{to_limit}]|we have ({compared}) {left} [{to_limit}]|"
    "we are ({compared}) (below|under|away from) the [force|hard] limit|"
    "the (force|grip) is ({compared}) (below|under) the [force|hard] limit|"
    "({compared}) (is|are) {left} {to_limit}"
)
_ROOM_BARE = (
    "({compared}) {left} {to_limit}|({compared}) (below|under) the limit|({compared}) {to_limit}"
)

_OF_LIMIT = "of [the|our] [hard|force|grip|safety|allowed|whole] limit"
_FIXED_SHARES = {
    "50 %": f"(half|one half) ({_OF_LIMIT}|the [hard|force] limit)",
    "25 %": f"(a quarter|one quarter) {_OF_LIMIT}",
    "75 %": f"three quarters {_OF_LIMIT}",
    "33.3 %": f"(a|one) third {_OF_LIMIT}",
    "66.7 %": f"two thirds {_OF_LIMIT}",
    "20 %": f"(a fifth|one fifth) {_OF_LIMIT}",
    "10 %": f"(a tenth|one tenth) {_OF_LIMIT}",
}
_USED = (
    "the [present|felt|current|grip|gripping] force|our (force|grip)|the (grip|squeeze|load|pressure)|what we "
    "(use|apply|squeeze with)"
)
_USED_DIRECT = (
    "(do|did|does) (we|you|I|the fingers|this grip) {now} {use_up} {share_of}|have (we|you|I|the fingers) {now} {used_up} "
    "{share_of}|(is|are|was) {share_of} {now} {spent}|(are|is) (we|the gripper) {now} (using|using up|at|running at|"
    "working at) {share_of}|has {share_of} {now} been {spent}|(has|have) (the force|we) {now} (gone|got) {share_of}"
    "|is (the force|our grip|it) {now} {share_of}|are we {now} {share_of}"
)
_USED_STATEMENTS = "(we|the fingers) {now} (use|use up|are using|are at) {share_of}|{share_of} is {now} {spent}|we have {used_up} {share_of}"
_USED_BARE = "{share_of} {spent}|using {share_of}|at {share_of}"
_USED_SLOTS: Slots = {
    **slots_of(("%",), _FIXED_SHARES),
    "unit": {"%": "(%|percent|per cent)"},
    "between": {BETWEEN: f"(between|somewhere between) {{#t}} and {{#u}} {{unit}} {_OF_LIMIT}"},
    "range": {BETWEEN: f"{{#t}} (to|-) {{#u}} {{unit}} {_OF_LIMIT}"},
    "share": f"({{#t}} {{unit}} {_OF_LIMIT}|{{fixed}})",
    "amount": f"({{#t}} {{unit}} {_OF_LIMIT}|{{fixed}})",
    "united": f"({{#t}} {{unit}} {_OF_LIMIT}|{{fixed}})",
    "share_of": "({more_than} {share}|{more_than} {share})",
    "use_up": "(use|use up|take|need|spend|exhaust|consume|go beyond)",
    "used_up": "(used|used up|taken|spent|exhausted|consumed|eaten up)",
    "spent": "(used|used up|in use|spent|taken|exhausted|being used)",
}

_BAND_SLOTS: Slots = {
    **_FORCE_SLOTS,
    "position": {
        ">": "(above|over|beyond|higher than)",
        "<": "(below|under|lower than)",
        ">=": "at or above",
        "<=": "at or below",
    },
    "more_least": {">": "(more than|over)", ">=": "at least"},
    "want_s": "(asks for|wants|demands|requires|calls for|prescribes|specifies)",
    "from": "(starting|that starts|beginning|that begins)",
    "up_to": {">": "(beyond|past|above|further than)", ">=": "(up to|as far as|to at least)"},
    "another": {">=": "(another|at least another|at least|a further)"},
}
_LOAD_SLOTS: Slots = {
    **_MASS_SLOTS,
    "at_least_or": "(({more} {amount})|({enough} {amount})|({enough} {amount}))",
    "more": {">": "(more than|over|in excess of|upwards of)"},
    "enough": {">=": "(|at least|as much as|up to|a load of|a weight of|a thing of|something of)"},
}

FAMILIES: tuple[QuestionFamily, ...] = tuple(
    compare_family(name, quantity, unit, pattern, slots)
    for name, quantity, unit, pattern, slots in (
        ("mass_above", "mass", "g", measured_pattern(_MASS), _MASS_SLOTS),
        (
            "heavier_than",
            "mass",
            "g",
            thing_pattern(_MASS_DIRECT, _MASS_STATEMENTS, _MASS_BARE),
            _MASS_SLOTS,
        ),
        ("not_mass", "mass", "g", not_measured_pattern(_MASS), _MASS_SLOTS),
        ("holds_above", "holds", "g", measured_pattern(_HOLDS), _LOAD_SLOTS),
        (
            "holds_as_much",
            "holds",
            "g",
            thing_pattern(_HOLDS_DIRECT, _HOLDS_STATEMENTS, _HOLDS_BARE),
            _LOAD_SLOTS,
        ),
        ("limit_above", "limit", "N", measured_pattern(_LIMIT), _FORCE_SLOTS),
        (
            "limit_allows",
            "limit",
            "N",
            thing_pattern(_LIMIT_DIRECT, _LIMIT_STATEMENTS, _LIMIT_BARE),
            _FORCE_SLOTS,
        ),
        ("band_low_above", "band_low", "N", measured_pattern(_LOW), _BAND_SLOTS),
        (
            "band_starts",
            "band_low",
            "N",
            thing_pattern(_LOW_DIRECT, _LOW_STATEMENTS, _LOW_BARE),
            _BAND_SLOTS,
        ),
        ("band_high_above", "band_high", "N", measured_pattern(_HIGH), _BAND_SLOTS),
        (
            "band_ends",
            "band_high",
            "N",
            thing_pattern(_HIGH_DIRECT, _HIGH_STATEMENTS, _HIGH_BARE),
            _BAND_SLOTS,
        ),
        ("headroom_above", "headroom", "N", measured_pattern(_ROOM), _BAND_SLOTS),
        (
            "room_left",
            "headroom",
            "N",
            thing_pattern(_ROOM_DIRECT, _ROOM_STATEMENTS, _ROOM_BARE),
            _BAND_SLOTS,
        ),
        ("used_above", "used", "%", measured_pattern(_USED), _USED_SLOTS),
        (
            "uses_up",
            "used",
            "%",
            thing_pattern(_USED_DIRECT, _USED_STATEMENTS, _USED_BARE),
            _USED_SLOTS,
        ),
    )
)
