"""Families that ask for a number: what is pressed and where, mass, and what the contract says."""

from __future__ import annotations

from tacgrasp.lessons.dialogue.families.amounts import placed, pressed
from tacgrasp.lessons.dialogue.families.amounts.wordings import (
    UNIT_WORDS,
    AmountWording,
    Asked,
    amount_family,
    amount_slots,
    number_pattern,
)
from tacgrasp.lessons.dialogue.meaning import Amount
from tacgrasp.lessons.dialogue.patterns.family import QuestionFamily, length_of
from tacgrasp.lessons.dialogue.patterns.pattern import Slots

_BAND = (
    "(the [force|target|wanted|goal|grip force|target force|requested|agreed|permitted|stipulated|"
    "requested force|agreed force|permitted force] (band|band|range|window|corridor|"
    "interval)|the goal (band|range|window)|the job|the [force] contract|the (goal|target|specification|task)|our (goal|contract|band))"
)
_WANTED = (
    "(wanted|asked for|required|needed|called for|desired|requested|expected|prescribed|demanded|"
    "intended|aimed for|specified)"
)
_SQUEEZE = "(press|grip|squeeze|hold|clamp|push|pinch|grasp)"
_FOR = "[for {body}|for {thing}|by {band}|in {band}|here]"
_BOUND_FORCE = (
    "{bound} ([grip|contact|target|gripping] force (of|in|for|from) {band}|"
    f"{_WANTED} [grip|contact] force|(force|grip force|grip) (that is|that we|we|to be|"
    f"I) {_WANTED}|force {_WANTED} {_FOR}|force {{band}} (wants|asks for|allows for|names|"
    f"calls for))"
)
_BAND_WORDING = AmountWording(
    asked=(
        Asked(
            "(how much|what) force",
            f"is {{bound}} {_WANTED}|is {_WANTED} {{at_end}} {_FOR}|(do|"
            f"should) we need {{at_end}} {_FOR}|should (we|I|the fingers) (use|apply|"
            f"{_SQUEEZE} with) {{at_end}}|"
            "does {band} (ask for|want|call for|need) {at_end}|is {bound} in {band}",
            f"is {_WANTED} {{at_end}} {_FOR}|we need {{at_end}} {_FOR}|we should (use|"
            f"apply) {{at_end}}|"
            "{band} (asks for|wants|calls for) {at_end}",
        ),
        Asked(
            "how (hard|firmly|strongly|tightly)",
            f"should (we|I|the fingers) {_SQUEEZE} [{{thing}}] {{at_end}}",
            f"(we|I|the fingers) should {_SQUEEZE} [{{thing}}] {{at_end}}",
        ),
        Asked("what", f"is the ({_BOUND_FORCE})", f"the ({_BOUND_FORCE}) is"),
        Asked(
            "(how much|what) (force|grip)",
            "{needed}",
            "{needs}",
        ),
        Asked(
            "what",
            "is the {end} (end|bound|edge|limit|boundary|border|value) of {band}|is the {tip} of {band}",
            "the {end} (end|bound|edge|limit|boundary|border|value) of {band} is|the {tip} of {band} is",
        ),
        Asked("where", "does {band} {edge}", "{band} {edges}"),
        Asked("at (what|which) force", "does {band} {edge}", "{band} {edges}"),
        Asked(
            "how (high|low|large|big)",
            "is the {end} (end|bound|edge|limit) of {band}",
            "the {end} (end|bound|edge|limit) of {band} is",
        ),
    ),
    counted=(
        Asked(
            "how many {unit}",
            f"{{needed}}|(are|is) {_WANTED} {{at_end}}|do we need {{at_end}} {_FOR}|"
            f"should we {_SQUEEZE} with {{at_end}}|"
            "does {band} (ask for|want|call for) {at_end}|does {band} {edge} at",
            f"{{needs}}|are {_WANTED} {{at_end}}|we need {{at_end}}|{{band}} (asks for|wants) {{at_end}}",
        ),
    ),
    nouns=(
        f"the ({_BOUND_FORCE})|the {{end}} (end|bound|edge|limit|boundary|value) of {{band}}|"
        "the {bound} force of {band}|where {band} {edges}|the {end} band (edge|limit|end)|"
        f"the force {_WANTED} {{at_end}}|the {{bound}} (value|number) of {{band}}|"
        "the force at which {band} {edges}"
    ),
    bare=(
        f"{{bound}} force (of|in) {{band}}|{{bound}} {_WANTED} force|{{end}} (end|bound|"
        f"edge) of {{band}}|"
        "{bound} force in the band|{end} band (edge|end|limit)|{bound} target force|"
        "{bound} force wanted"
    ),
    terse=f"{{unit}} ({_WANTED}|needed) {{at_end}}",
    others=(
        "{band} {edges} (where|at what force|at how much)|what does {band} (ask for|want|call for|"
        "say) {at_end}|which is the {bound} force (in|of) {band}"
    ),
)
_BAND_SLOTS: Slots = {
    "band": _BAND,
    "bound": {
        "band_low": "(least|lowest|smallest|minimum|minimal|weakest|lightest|min)",
        "band_high": "(most|highest|largest|greatest|maximum|maximal|biggest|strongest|max)",
    },
    "edge": {
        "band_low": "(start|begin|open)",
        "band_high": "(end|stop|finish|close)",
    },
    "edges": {
        "band_low": "(starts|begins|opens)",
        "band_high": "(ends|stops|finishes|closes)",
    },
    "tip": {"band_low": "(bottom|start|floor|beginning)", "band_high": "(top|ceiling|end)"},
    "end": {
        "band_low": "(lower|low|bottom|lowest|minimum)",
        "band_high": "(upper|top|high|highest|maximum)",
    },
    "needed": {
        "band_low": "((do|would) (we|I|you) need [to (hold|lift|pick up|carry) {thing}]|does {thing} need [to be "
        "(held|lifted)]|is (needed|necessary) (to (hold|lift|pick up) {thing}|for {thing}))",
    },
    "needs": {
        "band_low": "((we|I|you) need [to (hold|lift|pick up|carry) {thing}]|{thing} needs|is needed to (hold|lift) {thing})",
    },
    "at_end": {
        "band_low": "(at least|at the least|at a minimum|as a minimum|at the very least)",
        "band_high": "(at most|at the most|at a maximum|as a maximum|at the very most)",
    },
}
_BOUNDS = ("bound", "edge", "edges", "end", "at_end", "needed", "needs", "tip")
"""Slots that name an end of the force band."""

_LIMIT = (
    "(the [hard|force|upper force|absolute|strict|safety|grip force|contract] limit|the (force|"
    "force's|contract's) [hard] limit|our [force] limit|the limit (of the contract|on the force|"
    "of the force|for the force|for {body}|for {thing}|we must keep|of the grip))"
)
_ALLOWED = "(allowed|permitted|tolerated|admissible|permissible|acceptable|authorised|tolerable)"
_LIMIT_WORDING = AmountWording(
    asked=(
        Asked("what", f"is {_LIMIT}", f"{_LIMIT} is"),
        Asked("where", f"is {_LIMIT}|does {_LIMIT} lie|does the limit sit", f"{_LIMIT} (is|lies)"),
        Asked("how (high|large|big|strict|low)", f"is {_LIMIT}", f"{_LIMIT} is"),
        Asked("(which|what) force", f"is {_LIMIT}|counts as the limit", f"is {_LIMIT}"),
        Asked(
            "how much force",
            f"is {_ALLOWED} [at most|at the most|on {{thing}}|for {{thing}}]|(may|can) we (use|"
            f"apply) at "
            "(most|the most)|are we allowed [to use|to apply|to put on {thing}]|does the (contract|"
            "limit) allow|may {thing} (get|take|see)",
            f"is {_ALLOWED} [at most|on {{thing}}]|we (may|can) (use|apply) at most|"
            f"we are allowed [to use|to apply]|the (contract|limit) allows",
        ),
        Asked(
            "how (hard|firmly|strongly|tightly)",
            f"(may|can|could) (we|I|the fingers|the robot) {_SQUEEZE} [{{thing}}] at (most|"
            f"the most)|are we allowed to {_SQUEEZE} [{{thing}}]|may (we|I|"
            f"the fingers) {_SQUEEZE} [{{thing}}]",
            f"(we|I|the fingers) (may|can) {_SQUEEZE} [{{thing}}] at (most|the most)|"
            f"we are allowed to {_SQUEEZE} [{{thing}}]|(we|I) may {_SQUEEZE} [{{thing}}]",
        ),
        Asked(
            "(what|which) force",
            f"must (never|not) be (exceeded|passed|reached|crossed|overstepped)|must we (never|"
            f"not) exceed|should we never (exceed|go beyond)|is {_ALLOWED} at most|"
            f"is the most we may use|may we not exceed|is too much for the contract",
            f"must (never|not) be (exceeded|passed|crossed)|we must (never|not) exceed|"
            f"is {_ALLOWED} at most",
        ),
    ),
    counted=(
        Asked(
            "how many {unit}",
            f"(are|is) {_ALLOWED} [at most|on {{thing}}]|(is|has) {_LIMIT}|(may|"
            f"can) we use at most|are we allowed [to use]|may we {_SQUEEZE} [{{thing}}] with [at "
            f"most]",
            f"are {_ALLOWED}|{_LIMIT} is|we are allowed|we may use",
        ),
    ),
    nouns=(
        f"the force (I|you|the fingers) must never (exceed|pass)|{_LIMIT}|{_LIMIT}|the (maximum|max|greatest|highest|largest|most) {_ALLOWED} force|"
        f"the (maximum|max|greatest|highest|largest) force (that is|we are|we may be) (allowed|"
        f"permitted)|the force (that must not be|we must not|we must never|never to be|"
        f"not to be) (exceeded|exceed)|the {_ALLOWED} (force|maximum|load)|the (ceiling|cap|"
        f"upper bound) (on|for) the force|the (maximum|most) force we may (use|apply)|"
        f"the limiting force|the force (ceiling|cap)"
    ),
    bare=(
        f"limit|ceiling|cap|redline|cutoff|max|maximum|upper limit|force maximum|force limit|hard limit|limit of the contract|contract limit|limit on the force|"
        f"(maximum|max) {_ALLOWED} force|{_ALLOWED} force|limit force|grip force limit|force cap|"
        "safety limit|force ceiling|upper force limit|limit for ({body}|{thing})"
    ),
    terse=f"{{unit}} {_ALLOWED}|{{unit}} at the limit|limit {{unit}}",
    others=(
        f"where is the (redline|ceiling|cutoff|cap) [for {{body}}]|what is the (redline|cutoff|cap|ceiling)|"
        f"when is it too much for the contract|what force would be one too many|"
        f"how much can {{thing}} (take|stand|endure) under the contract|which is {_LIMIT}|at (what|which) force (is|comes) {_LIMIT}|at what force must we stop|"
        f"beyond (what|which) force must we not go|up to (what|which) force may we (go|squeeze|"
        f"press)|{_LIMIT} is (what|how much|how high)|what limit (applies|holds|do we have|was set|"
        f"is set|does the contract set|is in the contract|must we respect|do we have to respect)"
    ),
)

_TO_LIMIT = "(to|until|before|up to) (the|our) [force|hard|safety|grip force] limit"
_BEFORE_LIMIT = (
    "(before (the limit|we (hit|reach|break|exceed|cross|are at) the [force|hard] limit|"
    "it is over the limit)|until we (hit|reach|are at) the [force|hard] limit|without (breaking|"
    "exceeding|passing|crossing) the [force|hard] limit|(within|under) the [force|hard] limit|"
    "up to the [force] limit)"
)
_ROOM = "(room|margin|headroom|leeway|slack|reserve|play|allowance|space|buffer|distance)"
_HEADROOM_WORDING = AmountWording(
    asked=(
        Asked(
            "how much [more] force",
            f"(is left|remains|is there left|is still free|do we have left|"
            f"have we left) {_TO_LIMIT}|(may|can|could) (we|I) (add|put on|apply|use|"
            f"still add) {_BEFORE_LIMIT}",
            f"(is left|remains|is still free|we have left) {_TO_LIMIT}|we (may|can|could) (add|"
            f"put on|apply|still add) {_BEFORE_LIMIT}",
        ),
        Asked(
            f"how much {_ROOM}",
            f"(is left|is there|remains|do we have|have we got|have we) {_TO_LIMIT}|(is there|"
            f"does the force have|do we have) (to|below) the limit",
            f"(is left|there is|remains|we have) {_TO_LIMIT}",
        ),
        Asked(
            "how far",
            "(are we|is the [grip] force|is the grip) (from|below|away from|under) (the|"
            "our) [force|hard] limit",
            "(we are|the [grip] force is|the grip is) (from|below|away from|under) (the|"
            "our) [force|hard] limit",
        ),
        Asked(
            "how (close|near)",
            "(are we|is the [grip] force|is the grip) to (the|our) [force|hard] limit",
            "(we are|the [grip] force is|the grip is) to (the|our) [force|hard] limit",
        ),
        Asked(
            "how much (harder|tighter|more firmly|more strongly|more tightly|stronger)",
            f"(can|may|could) (we|I|the fingers) {_SQUEEZE} [{{thing}}] [{_BEFORE_LIMIT}]",
            f"(we|I) (can|may|could) {_SQUEEZE} [{{thing}}] [{_BEFORE_LIMIT}]",
        ),
        Asked(
            "(by (how much|what amount)|how far)",
            "does the (limit|force limit|maximum [allowed|permitted] force|allowed maximum) (exceed|lie above|surpass) "
            "(the [felt|present] force|the one (being applied|we apply|we use)|our (grip|force)|the grip)",
            "the (limit|force limit|allowed maximum) (exceeds|lies above) (the [felt|present] force|our (grip|force))",
        ),
        Asked(
            "(how much [more]|by how much)",
            f"(can|may|could) the (force|grip force) (grow|rise|increase|go up) [{_BEFORE_LIMIT}]|"
            f"(is the force|are we) (below|under) the [force] limit",
            f"the (force|grip force) (can|may) (grow|rise|increase) [{_BEFORE_LIMIT}]|"
            f"(the force is|we are) (below|under) the [force] limit",
        ),
        Asked(
            "what",
            f"is the (force|{_ROOM}) (left|that is left|remaining) {_TO_LIMIT}|is the {_ROOM} (to|"
            f"below|up to) the [force|hard] limit|is the force margin",
            f"the {_ROOM} (to|below|up to) the [force|hard] limit is|the force margin is|"
            f"is left {_TO_LIMIT}|remains {_TO_LIMIT}",
        ),
    ),
    counted=(
        Asked(
            "how many [more] {unit}",
            f"(are left|are there left|remain) {_BEFORE_LIMIT}|(are left|remain|do we have [left]|are there [left]|are we|is it) {_TO_LIMIT}|(can|"
            f"may) (we|I) (add|put on|still add) [{_BEFORE_LIMIT}]",
            f"(are left|remain|we have|we are|there are) {_TO_LIMIT}|we (can|may) (add|"
            f"still add) [{_BEFORE_LIMIT}]",
        ),
    ),
    nouns=(
        f"the {_ROOM} (to|below|up to) the [force|hard] limit|the (force|"
        f"newtons) [that is] left {_TO_LIMIT}|the force (margin|reserve|headroom)|the (gap|"
        f"difference) between the force and the limit|the headroom|the remaining force [up to the "
        f"limit]|the difference (to|from) the limit|our (margin|headroom|safety margin)|"
        f"the safety margin|the limit minus the [present|current] force|the distance from the limit"
    ),
    bare=(
        "headroom|leeway|breathing room|slack|reserve|elbow room|play left|wiggle room|safety buffer|"
        "unused force|spare force|force to spare|allowance left|force headroom|force margin|margin to the limit|margin|room to the limit|"
        "distance to the limit|force left|force left to the limit|safety margin|remaining force|"
        "force reserve|gap to the limit|newtons left|margin below the limit"
    ),
    terse=(
        f"[how many] {{unit}} (left|to go|to spare|more) {_TO_LIMIT}|{{unit}} to the limit|"
        "{unit} left"
    ),
    others=(
        f"how much {_ROOM} {_TO_LIMIT}|how much {_ROOM} (do we have|have we|is there|is left) below the limit|how much breathing room (is left|is there|do we have)|how much wiggle room is left|"
        f"how much force is (spare|to spare|in reserve)|what is our cushion below the limit|"
        f"how (close|near) to the (redline|ceiling|cap|threshold|cutoff) are we|"
        f"how far off the (ceiling|cap|redline|cutoff) are we|how much can we still (pile on|add)|"
        f"what (is left|remains) {_TO_LIMIT}|can we {_SQUEEZE} harder and by how much|"
        f"how much (harder|more) {_BEFORE_LIMIT}|how much is (it|there) {_TO_LIMIT}|"
        f"how much more (squeezing|pressing|gripping|force) is (allowed|permitted)"
    ),
)

_WEIGHT = "(weight|mass|weight|mass|total weight|total mass|net weight)"
_MASS_WORDING = AmountWording(
    asked=(
        Asked("how (heavy|heavy|weighty|massive|light)", "is {thing}", "{thing} is"),
        Asked(
            "how much",
            "(does|does|did|might|would) {thing} weigh",
            "{thing} (weighs|weighs in at|might weigh|would weigh)",
        ),
        Asked("what", "(does|did|might|would) {thing} weigh", "{thing} (weighs|might weigh)"),
        Asked(
            "what",
            f"is the {_WEIGHT} [of {{thing}}|of what we (hold|grip|are holding)]|is its {_WEIGHT}",
            f"the {_WEIGHT} [of {{thing}}] is|its {_WEIGHT} is",
        ),
        Asked(
            f"(what|which|how much) {_WEIGHT}",
            "(does|did) {thing} have|has {thing}|(were|are) (you|we) (told|given)|is {thing}|"
            "is (in the gripper|in our hand|between the fingers|given|known|on record)|"
            "do we have for {thing}|are we (holding|gripping|lifting)|do you assume|is it",
            "{thing} has|(you|we) were (told|given)|is (in the gripper|given|known)|{thing} is|"
            "we are (holding|gripping|lifting)|you assume",
        ),
        Asked("how heavy", "a (thing|load|weight|piece) is {thing}", "a (thing|load) {thing} is"),
    ),
    counted=(
        Asked(
            "how many {unit}",
            "(does|did) {thing} (weigh|have)|is {thing}|is the thing we are (lifting|holding)|heavy is {thing}|has {thing}|"
            "are we (lifting|about to lift)|is the (weight|mass)|does the scale say",
            "{thing} (weighs|is|has)|the (weight|mass) is",
        ),
    ),
    nouns=(
        f"the {_WEIGHT} [of {{thing}}]|the {_WEIGHT} [of {{thing}}]|its {_WEIGHT}|"
        f"the {_WEIGHT} (you were told|that was given|of what we (hold|are holding|grip|lift)|"
        f"in the gripper|between the fingers|to be lifted|on record)|the object {_WEIGHT}|"
        f"the {_WEIGHT} (we have|we are going) to lift|the heaviness of {{thing}}|"
        "the weight {thing} has"
    ),
    bare=(
        "weight|mass|heft|heaviness|kilos or grams|load weight|weight figure|weight of {thing}|mass of {thing}|object (weight|mass)|weight of the (thing|"
        "item|part)|item weight|part weight|known (mass|weight)|given (mass|weight)"
    ),
    terse="weight {unit}|mass {unit}|{unit} (it weighs|on the scale)|how many {unit} heavy",
    others=(
        "{thing} (weighs|is) (how much|how heavy|how many {unit})|{thing} has (what|which) (weight|"
        "mass)|how heavy might {thing} be|if I (put|laid) {thing} on a scale , what would it (show|"
        "say|read)|what would a (scale|balance) (show|say|read) for {thing}|what weight (goes|"
        "should I note|is noted) for {thing}|how heavy|how hefty is {thing}|how weighty is {thing}|what does {thing} bring to the "
        "scale|what does {thing} tip the scales at|how much heft has {thing}|what did they say {thing} weighs"
    ),
)
_CARRY = "(hold|carry|lift|bear|take|support|hold up|handle|keep hold of|hold on to)"
_GRIPPER = (
    "(we|we|you|I|this grip|this grip|these fingers|the (grip|gripper|fingers|robot|grasp|hand)|"
    "our grip|this (force|grasp|squeeze|hold|gripper))"
)
_SLIPPING = (
    "(before it (slips|falls|drops|slides|slides out|gets lost|is lost)|without (slipping|sliding|"
    "falling|dropping it|losing it)|so that it (stays|does not slip|does not fall|holds)|"
    "and (still be held|still not slip|not fall)|until it slips)"
)
_WITH = "[for (sure|certain)|surely|safely|with this (force|grip|squeeze)|at this force|at the present force|like this|as it is]"
_HOLDS_WORDING = AmountWording(
    asked=(
        Asked(
            "how heavy (a (thing|load|part|weight|piece|{*objects})|an (object|item|{*objects}))",
            f"(can|could|would|will|may) {_GRIPPER} {_CARRY} {_WITH}",
            f"{_GRIPPER} (can|could|would|will) {_CARRY} {_WITH}",
        ),
        Asked(
            "(how much [weight|mass|load]|how much weight|(what|which) (weight|mass|load))",
            f"(can|could|would|will|may) {_GRIPPER} {_CARRY} {_WITH} [{_SLIPPING}]",
            f"{_GRIPPER} (can|could|would|will) {_CARRY} {_WITH} [{_SLIPPING}]",
        ),
        Asked(
            "how heavy",
            f"(may|can|could|might) {{thing}} be ({_SLIPPING}|for this grip|at most for this grip)|"
            f"(may|can) {{thing}} be at most|would {{thing}} have to be to slip",
            f"{{thing}} (may|can|could) be ({_SLIPPING}|for this grip)|{{thing}} (may|"
            f"can) be at most",
        ),
        Asked(
            "what",
            f"is the (largest|greatest|highest|heaviest|maximum|biggest|most) (weight|mass|load|"
            f"thing) {_GRIPPER} can {_CARRY} {_WITH}|is the (payload|carrying capacity|"
            f"load capacity) [of this grip]",
            f"the (largest|greatest|highest|heaviest|maximum) (weight|mass|"
            f"load) {_GRIPPER} can {_CARRY} is|the (payload|carrying capacity) of this grip is",
        ),
        Asked(
            "(at|from|above) (what|which) (weight|mass)",
            "(does|will|would) {thing} (slip|slide out|fall|start to slip|drop|begin to slide)|"
            "(does|will|would) (the|this) grip (fail|give way|let go)",
            "{thing} (slips|slides out|falls|starts to slip|would slip)|the grip (fails|gives way)",
        ),
        Asked(
            "up to (what|which) (weight|mass|load)",
            f"(can|will|does|would) (this|the|our) (grip|force|grasp) {_CARRY} [{{thing}}]|(is|"
            f"are) (this grip|we) (safe|strong enough|good enough)",
            f"(this|the|our) (grip|force|grasp) (can|will) {_CARRY} [{{thing}}]|this grip is (safe|"
            f"strong enough)",
        ),
    ),
    counted=(
        Asked(
            "how many {unit}",
            f"(can|could|will|would) {_GRIPPER} {_CARRY} {_WITH} [{_SLIPPING}]|(may|"
            f"can) {{thing}} (weigh|have) ({_SLIPPING}|at most)",
            f"{_GRIPPER} (can|could|will|would) {_CARRY} {_WITH}|{{thing}} may weigh {_SLIPPING}",
        ),
    ),
    nouns=(
        f"the (largest|greatest|highest|heaviest|maximum|biggest|most) (weight|mass|load|thing|"
        f"object) ({_GRIPPER} can {_CARRY}|for this grip|that does not slip|"
        f"that stays in the grip)|the (payload|carrying capacity|load capacity|holding capacity|"
        f"lifting capacity) [of this grip|of the grip|at this force|with this force]|"
        f"the weight (at|above) which "
        "{thing} (slips|would slip|starts to slip)|the heaviest load [held]|the (most|"
        "maximum) we can lift|"
        f"the weight this grip can {_CARRY}|the (weight|mass) (limit|capacity) of this grip"
    ),
    bare=(
        "payload|liftable weight|holding power|carrying power|lifting power|bearable load|"
        "maximum mass|mass limit of this grip|safe load|max payload|maximum payload|carrying capacity|load capacity|holding capacity|"
        "heaviest load|max load for this grip|lifting capacity|payload of this grip|"
        "max weight we can (hold|lift|carry)|most weight we can (hold|lift|carry)|weight capacity|"
        "grip capacity|maximum load (held|we can hold)|heaviest thing we can (hold|lift)"
    ),
    terse=(
        f"{{unit}} (this grip|we) can {_CARRY}|{{unit}} of payload|{{unit}} (held|carried) at most"
    ),
    others=(
        f"how heavy is too heavy [for (this grip|us)]|where does this grip give out|"
        f"what would be too heavy [for (this grip|us)]|how much mass is this squeeze good for|"
        f"when is {{thing}} too heavy for this grip|how much can {_GRIPPER} {_CARRY}|how much may {{thing}} weigh ({_SLIPPING}|at most|"
        f"for this grip)|what may {{thing}} weigh ({_SLIPPING}|at most)|"
        f"this grip can {_CARRY} (what|how much)|what can {_GRIPPER} {_CARRY} at most|"
        f"how much weight is this grip good for|how strong is this grip in terms of (weight|load)|"
        f"what is the heaviest we can (lift|hold|carry) "
        + _WITH
        + "|what payload (does this grip have|"
        "is possible|can we lift|do we have|does this force allow)"
    ),
)

FAMILIES: tuple[QuestionFamily, ...] = (
    *pressed.FAMILIES,
    *placed.FAMILIES,
    QuestionFamily(
        name="band_values",
        pattern=number_pattern(_BAND_WORDING, is_unit_needed=False),
        slots={
            **amount_slots(
                {
                    "N": UNIT_WORDS["N"],
                    "mN": UNIT_WORDS["mN"],
                    "cN": "(cN|centinewtons)",
                    "g": UNIT_WORDS["gf"],
                }
            ),
            **_BAND_SLOTS,
        },
        build=lambda bindings, _: Amount(
            quantity=next(bindings[name] for name in _BOUNDS if name in bindings),
            unit=bindings.get("unit", "N"),
            length=length_of(bindings),
        ),
    ),
    amount_family("limit", "limit", _LIMIT_WORDING, "N"),
    amount_family("headroom", "headroom", _HEADROOM_WORDING, "N"),
    amount_family("mass", "mass", _MASS_WORDING, "g", "kg"),
    amount_family("holds", "holds", _HOLDS_WORDING, "g", "kg"),
)
