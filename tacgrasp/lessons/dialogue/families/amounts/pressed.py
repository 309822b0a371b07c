"""Families that ask how deep, how hard and over how much area something presses."""

from __future__ import annotations

from tacgrasp.lessons.dialogue.families.amounts.wordings import (
    UNIT_WORDS,
    AmountWording,
    Asked,
    amount_family,
    amount_of,
    amount_slots,
    number_pattern,
)
from tacgrasp.lessons.dialogue.patterns.family import QuestionFamily

_DENT = (
    "(the (dent|dip|dimple|indentation|impression|imprint|print|mark|hollow|depression|deformation|"
    "crater|dint|ding|groove|cavity|bulge|recess|trough|valley|furrow|"
    "penetration|press|contact|touch|pit) [in {gel}|on {gel}|of {thing}])"
)
_INTO = "(in|in|into {gel}|into {gel}|inside {gel})"
_SUNK = (
    "(pressed|pressed|pushed|pushed|squeezed|squished|sunk|dug|driven|poked|jammed|forced|sitting|"
    "sinking|pressing|pushing|digging|biting|buried|embedded|lodged|wedged|rammed|plunged|bedded|"
    "nestled|stuck|thrust|burrowed|planted|nudged)"
)
_SQUASHED = (
    "(pressed|pressed in|pushed in|indented|dented|compressed|squashed|squished|deformed|"
    "pressed down|pushed down|depressed|squeezed in|pushed back|displaced|caved in|flattened|"
    "dimpled|pitted|bulged|distorted|bent in|hollowed|crumpled|dinged|bowed in)"
)
_PRESSING = (
    "(pressing|pushing|squeezing|squishing|sinking|digging|poking|ramming|plunging|burrowing|"
    "thrusting|driving|jabbing|prodding|nudging|easing)"
)
_DEPTH = AmountWording(
    asked=(
        Asked(
            "how deep",
            f"(is|was|would you call) ({{touch}}|{{body}}|{_DENT})",
            f"({{touch}}|{{body}}|{_DENT}) is",
        ),
        Asked("how deep", f"is {_DENT}|is it", f"{_DENT} is|it is"),
        Asked(
            "how (deep|far|deeply)",
            f"is {{thing}} [{_SUNK}] {_INTO}",
            f"{{thing}} is {_SUNK} {_INTO}",
        ),
        Asked(
            "how (deep|far|deeply|much)",
            f"does {{thing}} (go|sink|push|press|dig|poke|bite|cut|dip|stick|reach|burrow|plunge|protrude|"
            f"intrude|extend|settle|nestle|bulge) {_INTO}",
            f"{{thing}} (goes|sinks|pushes|presses|digs|pokes|bites|cuts|dips|sticks|"
            f"reaches) {_INTO}",
        ),
        Asked(
            "how deep",
            "does {thing} (go|reach|sink|get|penetrate|dent {gel}|press {gel})",
            "{thing} (goes|reaches|sinks|gets|penetrates|dents {gel}|presses {gel})",
        ),
        Asked(
            "how (deep|far|deeply)",
            f"has {{thing}} [been] (gone|sunk|pushed|pressed|dug|poked|squeezed|come) {_INTO}|"
            f"did {{thing}} (go|sink|push|press|dig|poke|bite|get|come) {_INTO}",
            f"{{thing}} has [been] (gone|sunk|pushed|pressed|dug|poked|squeezed|come) {_INTO}",
        ),
        Asked(
            "how (deep|far|deeply)",
            f"are {{hands}} {_PRESSING} [{{thing}}] {_INTO}|did (we|you|I) (press|"
            f"push) [{{thing}}] {_INTO}|have (we|you|I) (pressed|pushed|gone) [{{thing}}] {_INTO}|"
            f"are we in",
            f"{{hands}} are {_PRESSING} [{{thing}}] {_INTO}|(we|you|I) (pressed|"
            f"pushed) [{{thing}}] {_INTO}|we have (pressed|pushed|gone) [{{thing}}] {_INTO}|"
            f"we are in",
        ),
        Asked(
            "how (deeply|far|much|deep)",
            f"((is|was) {{gel}}|has {{gel}} been) {_SQUASHED} [by {{thing}}|under {{thing}}]",
            f"{{gel}} (is|was|has been|gets) {_SQUASHED} [by {{thing}}|under {{thing}}]",
        ),
        Asked(
            "how (much|far|deeply)",
            "(does|did) {thing} (dent|indent|press in|push in|squash|squish|compress|deform|"
            "depress) {gel}|is {thing} (denting|compressing|squashing|deforming|pressing in) {gel}",
            "{thing} (dents|indents|presses in|squashes|squishes|compresses|deforms) {gel}|"
            "{thing} is (denting|compressing|squashing|deforming) {gel}",
        ),
        Asked(
            "how (much|far)",
            "does {gel} (give|yield|give way|sink|bend|go) in [under {thing}]",
            "{gel} (gives way|yields|gives|sinks in) [under {thing}]",
        ),
        Asked(
            "(what|which|to what|at what) depth",
            "is {thing} (at|pressed to|pressed in)|does {thing} (reach|get to|sit at|go to|have)|"
            "(do|did) you (feel|measure|read|get|see|have|find)|are we at|have we reached|"
            "has {thing} (reached|got to)|is there|does the sensor (show|read|give|measure)",
            "{thing} (reaches|is at|is pressed to|has reached|has|sits at|gets to)|it is|we are at|"
            "you (feel|measure|read|get|see)|we have reached|there is|the sensor (shows|reads)",
        ),
        Asked(
            "what",
            "is (the [contact|press|indentation|penetration|maximum] depth|the indentation [depth]|"
            "the depth (of {thing}|in {gel}|now|here|of {touch})|our depth|the depth reading)",
            "(the [contact|press|indentation|penetration|maximum] depth|the indentation|"
            "the depth (of {touch}|in {gel}|here)|our depth) (is|was|comes to|amounts to)",
        ),
        Asked(
            "what",
            "(does|would) (the dent|the imprint|the indentation) measure|would a depth gauge (show|say|read) [for this dent|here]",
            "(the dent|the imprint) measures|a depth gauge would (show|say|read)",
        ),
        Asked(
            "how (large|big|great|high)",
            "is the ([contact|press] depth|indentation|penetration)",
            "the ([contact|press] depth|indentation|penetration) is",
        ),
        Asked(
            "how (squished|squashed|compressed|dented|indented|deformed)",
            "is {gel} [by {thing}|under {thing}]",
            "{gel} is [by {thing}|under {thing}]",
        ),
    ),
    counted=(
        Asked(
            "how many {unit}",
            f"(deep|in|into {{gel}}) is ({{thing}}|{_DENT})|deep are we|is {{thing}} {_SUNK} in|"
            "does {thing} (sink|go|press|push|dig) (in|into {gel})|of (depth|indentation) [is it|"
            "are there|do you feel|do you have]|deep|are we in|does {gel} give way|"
            "is {gel} pressed in|has (it|that) (sunk|gone) (in|into {gel})|did {thing} (sink|go|press) (in|into {gel})",
            f"(deep|in) {{thing}} is|{{thing}} (is {_SUNK} in|sinks in|goes in|presses in)|"
            "of (depth|indentation) there are|{gel} is pressed in|we are in",
        ),
        Asked(
            "(by|about|around|roughly|so) how many {unit}",
            f"is {{gel}} {_SQUASHED} [here|at this contact|by {{thing}}]|did {{gel}} give|is {{thing}} pressed in|is {{gel}} pressed in|"
            "does {thing} sink in|deep is it",
            "{thing} is pressed in|{gel} is pressed in|{thing} sinks in",
        ),
    ),
    nouns=(
        "the [contact|press|pressing|indentation|maximum|largest|greatest|peak|present|overall|"
        "penetration|dent|gel] depth|the indentation|the penetration [depth]|the dent|"
        "the depth of (the contact|the dent|the indentation|the press|the imprint|{body}|{touch})|"
        "the (depth|distance) to which {thing} is pressed [in]|the depth (in|into|on|at|"
        "under) {gel}|the [largest|deepest] indentation [of {gel}]|the deepest (point|"
        "spot) of {touch}|the amount of indentation|the depth you (feel|measure)|the (compression|"
        "deformation) (depth|of {gel})|the depth that {thing} reaches"
    ),
    bare=(
        "depth|depth|dip|dint|immersion|sinkage|intrusion depth|imprint depth|crater depth|"
        "depth of indent|depth value|z|how far in|contact depth|indentation depth|penetration depth|indentation|press depth|"
        "pressing depth|penetration|dent depth|depth of contact|depth of the dent|gel depth|"
        "max depth|maximum depth|depth of touch|depth of press"
    ),
    terse="{unit} (deep|in|pressed in|of depth|of indentation|into {gel}|sunk in)",
    others=(
        "how deep|how deep in|how deep down|how buried is {thing}|how sunken is {thing}|"
        "how dented is {gel}|how big a dint|what size of dent|how pronounced is the (dent|imprint)|"
        "to what extent is {gel} (pushed in|dented|indented)|(what|how much) did {gel} (yield|give)|"
        "how much has {gel} (caved|sagged|sunk) in|how thick a (slice|layer) of {gel} is pushed aside|"
        "what is the z [value|travel] of the press|how far past the surface are we|"
        "how far did we (go|get) past the surface|{thing} (is|goes|sits|sinks) how deep [in]|{thing} is [pressed|"
        "pushed] in how far|the depth is (what|how much)|(deep|pressed in|in) by how much|"
        "by how much is (it|{gel}|{thing}) "
        f"{_SQUASHED}|how much depth (is there|do you feel|do we have|have we got)|"
        f"how much (indentation|penetration|depth) (is there|do you (feel|see|measure)|do we have)|"
        "how deep (a|is the) (dent|mark|hole|imprint|dip) [does {thing} make|has {thing} made|"
        "is {thing} making|did {thing} leave] [in {gel}]|how much (further|"
        "deeper) than the surface is {thing}|how far (beneath|below|under) the surface is {thing}"
    ),
)

_HELD = (
    "(held|held|gripped|grasped|clamped|squeezed|pinched|pressed|clenched|clutched|clasped|"
    "being (held|squeezed|gripped|pressed|clamped|pinched)|throttled|seized|nipped|trapped|"
    "sandwiched|secured|crushed|wrung|crimped|restrained|fastened)"
)
_HOLDING = (
    "(holding|gripping|squeezing|pinching|pressing|clamping|grasping|clutching|pushing|nipping|"
    "crushing|throttling|clenching|clinging|bearing down|leaning)"
)
_HOLD = "(hold|grip|squeeze|pinch|press|clamp|grasp|clutch|push)"
_HARD = (
    "(hard|hard|firmly|firmly|tightly|tight|strongly|forcefully|powerfully|firm|gently|softly|"
    "lightly|loosely|vigorously|intensely|violently|fiercely|heavily|securely|snugly|stiffly|"
    "energetically|robustly|timidly|delicately)"
)
_GRIP = (
    "(the|our|your|this) (grip|grasp|hold|squeeze|pinch|press|push|clamp|clamping|"
    "touch) [on {thing}]"
)
_FORCE_NAME = (
    "(the|our|your|this) [contact|normal|grip|gripping|grasp|clamping|pressing|holding|pinch|"
    "squeezing|pushing|touch|reaction|total] force [on ({thing}|{gel})|here]"
)
_FORCE_ASKED = (
    Asked(f"how {_HARD}", f"(is|was) {{thing}} {_HELD}", f"{{thing}} (is|was) {_HELD}"),
    Asked(
        f"how {_HARD}",
        f"are (we|you) {_HOLDING} [{{thing}}|on {{thing}}]|(do|did) (we|you|I) {_HOLD} [{{thing}}]|"
        f"am I {_HOLDING} [{{thing}}]",
        f"{{hands}} (are {_HOLDING}|{_HOLD}) [{{thing}}|on {{thing}}]",
    ),
    Asked(
        f"how {_HARD}",
        f"do {{hands}} {_HOLD} [{{thing}}]|are the (fingers|jaws|fingertips) {_HOLDING} "
        f"[{{thing}}]|is {{hand}} {_HOLDING} [{{thing}}]|does {{hand}} {_HOLD} [{{thing}}]",
        f"{{hand}} is {_HOLDING} [{{thing}}]|I am {_HOLDING} {{thing}}",
    ),
    Asked(
        "how (hard|strongly|firmly|heavily|forcefully)",
        "does {thing} (press|push|bear|lean|squeeze) [down] (on|against) {gel}|does {thing} press|"
        "is {thing} (pressing|pushing|leaning|bearing) [down] (on|against) {gel}|"
        "does {thing} push [back]|is {gel} (pressed|pushed|loaded)",
        "{thing} (presses|pushes|bears|leans) [down] (on|against) {gel}|{thing} (presses|pushes)|"
        "{thing} is (pressing|pushing|leaning) (on|against) {gel}|{gel} is (pressed|pushed|loaded)",
    ),
    Asked("how (strong|strong|firm|tight|hard)", f"is {_GRIP}", f"{_GRIP} is"),
    Asked("how (strong|large|big|high|great|much)", f"is {_FORCE_NAME}", f"{_FORCE_NAME} is"),
    Asked(
        "how much [grip|grasp|contact|normal|gripping|squeezing] force",
        "is (there|there on {thing}|on {thing}|acting on {thing}|felt|pressing on {gel}|being used|"
        "used|applied [to {thing}]|being applied|exerted|on {gel}|between the fingers|in the grip)|"
        "are {hands} (using|applying|exerting|putting on {thing}|pressing with|gripping with)|"
        "do {hands} (use|apply|exert|put on {thing}|press with|grip with|hold {thing} with)|"
        "do you (feel|measure|read|sense|notice|see|get|have)|does {thing} (put on|exert on) {gel}|"
        "does {gel} (feel|see|get|carry)|does {thing} (feel|get|see|take)|do we have",
        "is on ({thing}|{gel})|there is [on ({thing}|{gel})]|is (acting|being applied|applied|"
        "used)|{hands} (use|apply|exert|put on {thing}|press with|hold {thing} with|are using)|"
        "you (feel|measure|read|sense)|{thing} (puts on|exerts on) {gel}|{thing} (feels|gets)",
    ),
    Asked(
        "how (much|hard|strongly)",
        "does {thing} (push back|press back|resist)|is {thing} (pushing|pressing) back",
        "{thing} (pushes back|presses back|resists)|{thing} is (pushing|pressing) back",
    ),
    Asked(
        "how much (pressure|load|squeeze|push|strength|power|oomph|muscle|effort|thrust|strain|might|punch|"
        "compression|tension|juice|clout)",
        "is (there|on {thing}|on {gel}|there on {gel}|pressing on {gel})|do you (feel|measure|"
        "sense)|are we (putting on|applying to) {thing}|do (we|you) apply [to {thing}]|"
        "does {thing} put on {gel}|is {thing} (under|feeling|getting)",
        "is on ({thing}|{gel})|there is [on ({thing}|{gel})]|we (put on {thing}|apply)|you (feel|"
        "measure)|{thing} is under",
    ),
    Asked(
        "(with what|with how much|with which|at what) force",
        f"is {{thing}} {_HELD}|do {{hands}} {_HOLD} [{{thing}}]|are {{hands}} {_HOLDING} {{thing}}|"
        "does {thing} (press|push) [on {gel}]",
        f"{{thing}} is {_HELD}|{{hands}} {_HOLD} [{{thing}}]|{{thing}} (presses|"
        f"pushes) [on {{gel}}]",
    ),
    Asked(
        "(what|which) force",
        f"is {{thing}} {_HELD} with|do {{hands}} {_HOLD} [{{thing}}] with|"
        f"are {{hands}} {_HOLDING} [{{thing}}] with|do you (feel|measure|read|get|sense|see)|"
        f"is (there|it|being applied|acting|felt)|are we at|"
        "does {thing} (press|push) [on {gel}] [with]|does the (sensor|gripper) (read|show|use|"
        "apply)|are we (using|applying)|do we (use|apply|have)|is on ({thing}|{gel})|did you (feel|"
        "measure|get)",
        f"{{thing}} is {_HELD} with|{{hands}} {_HOLD} [{{thing}}] with|you (feel|measure|read|get)|"
        "there is|{thing} (presses|pushes) [on {gel}] with|the sensor (reads|shows)|we (use|apply|"
        "have)|is (acting|applied|on {thing})|it is",
    ),
    Asked(
        "what",
        f"is ({_FORCE_NAME}|the (load|pressure) on {{gel}}|the (grip|gripping|clamping) strength|"
        f"the strength of (the|our) (grip|grasp|hold|squeeze))",
        f"({_FORCE_NAME}|the (load|pressure) on {{gel}}|the (grip|gripping) strength|"
        f"the strength of the (grip|grasp|hold)) (is|was|comes to|amounts to)",
    ),
)
_FORCE_COUNTED = (
    Asked(
        "how many {unit}",
        "(do|did) you (feel|measure|read|sense|get)|are (on {thing}|on {gel}|acting|felt|"
        "there on {gel})|"
        f"is {{thing}} {_HELD} with|do {{hands}} ({_HOLD} [{{thing}}] with|use|apply|"
        f"put on {{thing}})|are {{hands}} {_HOLDING} [{{thing}}] with|"
        "(does|is) {thing} (press|push|pressing|pushing) [on {gel}] with|of (force|grip|squeeze|"
        "load|"
        f"pressure) [is it|are there|do you feel|do we have]|is {_FORCE_NAME}|is {_GRIP}|"
        "of force (is|are) (on {thing}|on {gel}|we using|we applying)|does the sensor (read|feel|"
        "show)",
        "you (feel|measure|read|sense|get)|are (on {thing}|on {gel}|acting)|"
        f"{{thing}} is {_HELD} with|{{hands}} (use|apply|{_HOLD} with)|{{thing}} presses with|"
        f"{_FORCE_NAME} is|of force there are|the sensor (reads|feels|shows)",
    ),
)
_FORCE_NOUNS = (
    "the [contact|normal|grip|gripping|grasp|clamping|pressing|felt|present|holding|pinch|"
    "squeezing|pushing|touch|reaction|measured|total|acting|applied|sensed|finger] force|the (load|"
    "pressure|push) on {gel}|the (force|pressure|load) (of|from|on) {body}|the [grip|gripping|"
    "clamping|holding|squeezing] (strength|power)|the (clamping force|pressure|load)|"
    "the force (between|of|in|at|from) the (fingers|jaws|fingertips|gripper)|the squeeze|"
    f"the force (with|at) which {{thing}} is {_HELD}|the force (on|in|at) {{gel}}|the (strength|"
    f"force|firmness|tightness) of (the|our|your) (grip|grasp|hold|squeeze|press|push)|"
    "the (force|load) (that|which) (acts on {thing}|you feel|you measure|we apply|we use)|"
    "the force we (are applying|apply|use|press with|hold {thing} with)|the force (you are feeling|"
    "of {touch}|being applied|acting on {gel})|the force in the grip|the push of {thing}"
)
_FORCE_BARE = (
    "force|force|newtons|thrust|load|squeeze|oomph|push|clamp load|grip level|tightness|"
    "firmness|strength|force reading|force value|normal load|pad load|compression force|"
    "contact force|grip force|normal force|gripping force|clamping force|press force|"
    "pressing force|holding force|grip strength|squeeze force|pinch force|grasp force|"
    "force normal to the pad|perpendicular force|load perpendicular to the pad|"
    "force on (the pad|the gel|it|the finger|{thing})|load on (the pad|the gel)|force level|"
    "force of the grip|pressure on (the pad|the gel)|squeezing force|force between the fingers"
)
_FORCE_OTHERS = (
    "how hard is the finger (pressing|pushing|squeezing)|how hard am I (pressing|squeezing|gripping) [{thing}]|"
    "what (force|load) reading do you get [from this touch|here]|how strong is the (press|push|squeeze|pinch)|"
    "how much (is|are) (the (finger|fingers|gripper|robot|hand)|it|we|you) (pressing|squeezing|gripping|"
    "pushing) [on {thing}]|what (is|was) (the grip|the force|the squeeze|our grip|the load) at|"
    "what does (the [tactile] sensor|the pad|the gel|the gripper) say about [the] force|"
    "{thing} is (held|gripped|squeezed|pressed) how (hard|tightly|firmly|strongly)|"
    "how (tight|firm|vigorous|brutal|gentle|intense) is the (squeeze|pinch|clamping|hug|embrace)|"
    "what does the (force gauge|dynamometer|load cell|force meter) (say|show|read)|"
    "if {gel} were a (scale|load cell|force gauge) , what would it (show|read|say)|"
    "what are we (exerting|putting on it|laying on it|dishing out) in force|"
    "how much does {gel} have to (take|bear|endure|withstand)|"
    "how (stressed|loaded|strained) is {gel} [by {thing}]|"
    "what is {thing} (pushing|bearing|leaning) against {gel} with|"
    "the force is (what|how much|how high)|we are (squeezing|pressing|gripping) how hard|"
    "by what force is {thing} (held|pressed)|{thing} presses with what force|with how much (force|"
    "pressure|strength|power) (is {thing} held|do we hold {thing}|are we (pressing|squeezing|"
    "gripping) [{thing}]|does {thing} press [on {gel}])|how (much force|much pressure|"
    "hard) on ({thing}|{gel})|what is pressing on {gel} in terms of force|what (load|"
    "pressure) is (on {gel}|acting on {gel})|what (load|grip strength) do you (feel|measure|sense)|"
    "how hard a (grip|squeeze|press|push) is (it|this|that)|how strong a (grip|force|squeeze|"
    "press) (is this|do we have|do you feel|is it)"
)

_FORCE_N = AmountWording(
    asked=_FORCE_ASKED,
    counted=(*_FORCE_COUNTED, Asked("how many {unit}", "is it|are there", "it is|there are")),
    nouns=_FORCE_NOUNS,
    bare=_FORCE_BARE,
    others=_FORCE_OTHERS,
    terse=(
        "{unit} (on|at|onto) ({gel}|{thing})|[how many] {unit}|{unit} of (force|grip|squeeze|load)"
    ),
)
_FORCE_OTHER = AmountWording(
    asked=_FORCE_ASKED,
    counted=_FORCE_COUNTED,
    nouns=_FORCE_NOUNS,
    bare=_FORCE_BARE,
    others=_FORCE_OTHERS,
    terse=(
        "{unit} of (force|grip|squeeze|grip force|pressing force)|{unit} of force on ({gel}|"
        "{thing})"
    ),
)

_COVERED = (
    "(covered|touched|in contact|in use|occupied|taken up|pressed|under {thing}|in touch|"
    "being touched|being covered|contacted|touching {thing}|touching|pressed on|engaged|filled|"
    "hidden|blanketed|shaded|wetted|claimed|busy|swallowed|affected|involved|"
    "loaded)"
)
_PATCH = (
    "(the (contact|contact area|contact patch|footprint|imprint|touched area|area|touch|"
    "contact surface|contact region|contact zone|contact spot|print|covered area|area of contact|"
    "patch|pressed area) [of {thing}|on {gel}|with {body}])"
)
_SPREAD = (
    "(touch|touch|cover|cover|occupy|take up|fill|use|press on|make contact with|lie on|rest on|"
    "span|blanket|claim|hide|shade|sit on|spread over|stretch over|swallow|engage|bear on)"
)
_SPREADS = (
    "(touches|touches|covers|covers|occupies|takes up|fills|uses|presses on|lies on|rests on|"
    "makes contact with)"
)
_AREA_ASKED = (
    Asked("how (large|big|large|big|small|extensive|great)", f"is {_PATCH}", f"{_PATCH} is"),
    Asked("how much of {gel}", f"is {_COVERED} [by {{thing}}]", f"is {_COVERED} [by {{thing}}]"),
    Asked("how much of {gel}", f"(does|did) {{thing}} {_SPREAD}", f"{{thing}} {_SPREADS}"),
    Asked(
        "how much (area|surface|surface area|contact area|contact surface|space|room)",
        f"(does|did) {{thing}} {_SPREAD} [on {{gel}}]|is {_COVERED} [by {{thing}}|with {{thing}}]|"
        f"is there|do you (feel|measure|see|have)|do we have|are we (touching|covering)|"
        "of {gel} is (touched|covered|in contact)|is {thing} (covering|touching|taking up)",
        f"{{thing}} {_SPREADS} [on {{gel}}]|is {_COVERED} [by {{thing}}]|there is|you (feel|"
        f"measure)|"
        "we (touch|cover)|{thing} is (covering|touching)",
    ),
    Asked(
        "(what|which|how large an|how big an|how wide an) area",
        f"(does|did) {{thing}} {_SPREAD}|is {_COVERED} [by {{thing}}]|do you (feel|measure|read|"
        f"get)|is it|is there|does the (contact|touch|footprint) have|are we touching",
        f"{{thing}} {_SPREADS}|is {_COVERED} [by {{thing}}]|you (feel|measure|read|get)|there is|"
        f"the (contact|touch|footprint) has|we are touching",
    ),
    Asked(
        "what",
        "is the ([contact|touched|covered] area|area of [the] contact|size of the (contact|"
        "footprint|imprint|contact patch)|contact surface [area]|extent of the contact)",
        "the ([contact|touched|covered] area|area of [the] contact|size of the (contact|footprint|"
        "contact patch)|extent of the contact) (is|was|comes to|amounts to)",
    ),
    Asked(
        "over (what|how large an|how big an|how much) area",
        "does {thing} (touch|press on) {gel}|is {gel} (touched|pressed)|are we in contact|"
        "do we touch",
        "{thing} (touches|presses on) {gel}|{gel} is (touched|pressed)|we are in contact",
    ),
)
_AREA_SHARE = (
    Asked(
        "(what (share|fraction|percentage|proportion)|how (large|big) a (part|share)) of {gel}",
        f"is {_COVERED} [by {{thing}}]|(does|did) {{thing}} {_SPREAD}|are we touching|"
        "(sees|feels|has|makes) contact",
        f"is {_COVERED} [by {{thing}}]|{{thing}} {_SPREADS}|we are touching",
    ),
    Asked(
        "(what|how many|to what|how much) (percent|per cent|percentage|%) of {gel}",
        f"(is|are) {_COVERED} [by {{thing}}]|(does|did) {{thing}} {_SPREAD}",
        f"(is|are) {_COVERED} [by {{thing}}]|{{thing}} {_SPREADS}",
    ),
)
_AREA_NOUNS = (
    "the [contact|touched|covered|total|pressed|present|touching] area|the (contact|"
    "touched) surface [area]|the surface area|the area of (contact|the contact|{touch}|the footprint|the imprint|"
    "touch)|the footprint|the size of (the contact|the contact patch|the footprint|the imprint|"
    "the touch|the patch)|the (part|portion) of {gel} (in contact|covered by {thing}|taken up)|"
    "what part of {gel} is covered|the area (that|which) {thing} (touches|covers|presses on|"
    "occupies)|the covered (area|part)|the contact (patch|region|zone|spot) [size]|"
    "the footprint (size|area|of {thing})|the (extent|spread) of the (contact|touch|imprint)|"
    "the area (in contact|under {thing}|covered)|the imprint (size|area)"
)
_SHARE_NOUNS = (
    "the (percentage|fraction|share|proportion|percent) of {gel} (in contact|that is (touched|"
    "covered)|covered [by {thing}]|touched [by {thing}]|under {thing}|{thing} (touches|covers))|"
    "the (contact|covered) (coverage|percentage|fraction)|the coverage [of {gel}]|"
    "the contact area (relative to|compared with) {gel}"
)
_AREA_BARE = (
    "area|contact area|contact area|extent|spread|surface area|patch size|size of the patch|"
    "imprint area|touching area|touch area|expanse|square area|area figure|contact extent|"
    "contact patch|contact patch area|patch area|footprint area|footprint|area of contact|contact size|"
    "touched area|covered area|size of the contact|contact surface|size of the contact patch|"
    "area of the contact|contact patch size|footprint size|imprint size|area touched|area covered|"
    "contact region size|surface in contact|area in contact"
)
_AREA_OTHERS = (
    "how (extended|wide-ranging|spread out|widespread|roomy) is the (contact|touch|imprint)|"
    "how much ground does {thing} cover|how much real estate does {thing} take up|"
    "what is the spread of the contact|how generous is the contact patch|"
    "how much skin (is in the game|gets touched)|how far does the contact spread|"
    "{thing} (covers|touches) how much [of {gel}]|the area is (what|how large|how big)|how (large|"
    "big) (a (patch|footprint|contact|spot|mark)|an (area|imprint)) (does {thing} make|is it|"
    "is there|do you feel|does {thing} leave)|how much contact (is there|do we have|"
    "does {thing} make|do you feel)|how much {thing} (covers|touches)|how much is (covered|touched|"
    "in contact)|how (large|big) is the (part|piece|bit|portion) of {gel} that is (touched|covered|"
    "in contact)|how much of {gel} (feels|senses|has contact with) {thing}|"
    "how much of {gel} does {thing} have contact with"
)

_AREA_PERCENT = AmountWording(
    asked=(*_AREA_ASKED, *_AREA_SHARE),
    counted=(
        Asked(
            "how many {unit}",
            "are (covered|touched|in contact)|is {gel} covered|does {thing} (cover|touch)|"
            "is the (contact [area]|area|footprint)|of {gel} (do we touch|do you feel contact on)",
            "are (covered|touched|in contact)|{thing} (covers|touches)|the area is",
        ),
    ),
    nouns=f"{_AREA_NOUNS}|{_SHARE_NOUNS}",
    bare=f"{_AREA_BARE}|coverage|contact percentage|percentage covered|contact fraction|"
    "percentage of the (pad|gel) (covered|touched)|pad coverage|gel coverage|covered fraction",
    others=_AREA_OTHERS,
    terse="[how many] {unit} (covered|touched|in contact|of {gel}|of coverage|used)",
)
_AREA_SQUARE = AmountWording(
    asked=_AREA_ASKED,
    counted=(
        Asked(
            "how many {unit}",
            f"are {_COVERED} [by {{thing}}]|of {{gel}} are {_COVERED}|does {{thing}} {_SPREAD}|"
            f"is the (contact [area]|area|footprint)|of (contact|area) [are there|do you feel|"
            f"is it]|large is the (contact|footprint)|do we (touch|cover)",
            f"are {_COVERED} [by {{thing}}]|{{thing}} {_SPREADS}|the (contact|area|footprint) is|"
            f"of contact there are|we touch",
        ),
    ),
    nouns=_AREA_NOUNS,
    bare=_AREA_BARE,
    others=_AREA_OTHERS,
    terse="[how many] {unit} [covered|touched|in contact|of contact|of {gel}|of area|of touch]",
)

FAMILIES: tuple[QuestionFamily, ...] = (
    amount_family("depth", "depth", _DEPTH, "mm"),
    amount_family("depth_micron", "depth", _DEPTH, "µm", is_unit_needed=True),
    amount_family("depth_cm", "depth", _DEPTH, "cm", is_unit_needed=True),
    amount_family("force", "force", _FORCE_N, "N"),
    QuestionFamily(
        name="force_grams",
        pattern=number_pattern(_FORCE_OTHER, is_unit_needed=True),
        build=amount_of("force", "g"),
        slots=amount_slots({"mN": UNIT_WORDS["mN"], "g": UNIT_WORDS["gf"]}),
    ),
    amount_family(
        "area",
        "area",
        _AREA_PERCENT,
        "%",
        extra_unit="as a (percentage|fraction) [of the (pad|gel|sensor)]|"
        "in {unit} of the (pad|gel|sensor)|relative to the (pad|gel)",
    ),
    amount_family("area_mm2", "area", _AREA_SQUARE, "mm²", is_unit_needed=True),
)
