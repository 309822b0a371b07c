"""Families that ask for a number: depth, force, area, place, mass and what the contract says."""

from __future__ import annotations

from collections.abc import Callable

from tacgrasp.lessons.dialogue.families.family import Bindings, Numbers, QuestionFamily, length_of
from tacgrasp.lessons.dialogue.families.phrases import amount_pattern
from tacgrasp.lessons.dialogue.meaning import Amount

DEPTH_NOUN = (
    "the [contact|press|indentation|maximum|largest|greatest|peak|present] depth|the indentation|"
    "the depth of ({touch}|{body}|the dent|the indentation)|the penetration [depth]|"
    "how deep {touch} is|the depth in the gel|the largest indentation|the dent|"
    "the depth to which {thing} is pressed"
)
DEPTH_DIRECT = (
    "how deep is ({touch}|{body}|the dent|the indentation)|how deep is {thing} pressed [in]|"
    "how far is {thing} pressed in|how far does {thing} (sink|go|push|press) in|"
    "how deeply (is|has) the gel (pressed|been pressed)|how far is the gel pushed in|"
    "how far has {thing} sunk into the (gel|pad)|what depth does {thing} reach|"
    "what is the [contact|press|indentation] depth|how much does {thing} dent the gel|"
    "how deep does {thing} (sink|go|reach)|how much is the gel indented by {thing}|"
    "to what depth is {thing} pressed"
)
DEPTH_INDIRECT = (
    "how deep ({touch}|{body}|the dent) is|how deep {thing} is pressed [in]|"
    "how far {thing} (sinks|goes|is pushed|presses) in|how deeply the gel is pressed|"
    "what the [contact|press|indentation] depth is|how far {thing} has sunk into the (gel|pad)|"
    "what depth {thing} reaches|how much {thing} dents the gel"
)
FORCE_NOUN = (
    "the [contact|normal|grip|gripping|pressing|felt|present] force|the load on the pad|"
    "the (force|pressure|load) (of|from|on) {body}|the grip strength|the force between the fingers|"
    "the force with which {thing} is (held|pressed|gripped|squeezed)|the squeeze|the clamping force"
)
FORCE_DIRECT = (
    "how hard is {thing} (pressed|held|squeezed|gripped)|how strong is the (grip|force|press)|"
    "what is the [contact|normal|grip] force|how much force is (on|there on) ({thing}|the pad)|"
    "how firmly (is {thing} held|do we hold {thing}|are we holding {thing})|"
    "how hard are we (pressing|squeezing|gripping) [{thing}]|how large is the force|"
    "how hard does {thing} press [on the pad]|what force do you (feel|measure|read)|"
    "with what force (is {thing} held|do we hold {thing})|how tight is the grip [on {thing}]|"
    "how much (force|load) do you feel|how strongly is {thing} (held|pressed|gripped)"
)
FORCE_INDIRECT = (
    "how hard {thing} is (pressed|held|squeezed|gripped)|how strong the (grip|force|press) is|"
    "what the [contact|normal|grip] force is|how much force is on ({thing}|the pad)|"
    "how firmly {thing} is held|how hard we are (pressing|squeezing|gripping) [{thing}]|"
    "how large the force is|what force you (feel|measure|read)|how tight the grip is|"
    "with what force {thing} is held"
)
AREA_NOUN = (
    "the [contact] area|the area of (contact|the contact|{touch}|the footprint)|the footprint|"
    "the size of the (contact|contact patch|footprint|imprint)|the part of the pad in contact|"
    "the area that {thing} (touches|covers)|the covered (area|part)|the contact patch"
)
AREA_DIRECT = (
    "how large is (the contact|the contact area|the contact patch|the footprint|the imprint)|"
    "how big is (the contact|the contact area|the touched area|the footprint)|"
    "how much of the (pad|gel|sensor) (is covered|is touched|does {thing} touch|does {thing} cover)|"
    "what area does {thing} (touch|cover)|how wide an area is touched|what is the contact area|"
    "how much area (is in contact|does {thing} cover|is touched by {thing})|"
    "what part of the (pad|gel|sensor) is (covered|in contact)"
)
AREA_INDIRECT = (
    "how large (the contact|the contact area|the contact patch|the footprint) is|"
    "how big (the contact|the touched area|the footprint) is|"
    "how much of the (pad|gel|sensor) (is covered|is touched|{thing} touches|{thing} covers)|"
    "what area {thing} (touches|covers)|what the contact area is|how much area is in contact"
)


def _amount(quantity: str, unit: str) -> Callable[[Bindings, Numbers], Amount]:
    def build(bindings: Bindings, _: Numbers) -> Amount:
        unit_asked = bindings.get("unit", unit)
        return Amount(quantity=quantity, unit=unit_asked, length=length_of(bindings))

    return build


def _family(
    name: str, quantity: str, unit: str, direct: str, indirect: str, noun: str, unit_phrase: str
) -> QuestionFamily:
    return QuestionFamily(
        name=name,
        pattern=amount_pattern(direct, indirect, noun, unit_phrase),
        build=_amount(quantity, unit),
    )


BOUNDS = ("bound", "edge", "edges", "end")
"""Slots that name an end of the force band; without one the limit is meant."""

FAMILIES: tuple[QuestionFamily, ...] = (
    _family(
        "depth",
        "depth",
        "mm",
        f"{DEPTH_DIRECT}|how many (millimetres|mm) (deep is {{touch}}|is {{thing}} pressed in)",
        DEPTH_INDIRECT,
        DEPTH_NOUN,
        "[in (mm|millimetres)]",
    ),
    _family(
        "depth_micron",
        "depth",
        "µm",
        DEPTH_DIRECT,
        DEPTH_INDIRECT,
        DEPTH_NOUN,
        "in (microns|micrometres|µm|thousandths of a millimetre)",
    ),
    _family(
        "force",
        "force",
        "N",
        f"{FORCE_DIRECT}|how many newtons (is it|do you feel|are on {{thing}}|is {{thing}} held with)",
        FORCE_INDIRECT,
        FORCE_NOUN,
        "[in (newtons|N)]",
    ),
    QuestionFamily(
        name="force_grams",
        pattern=amount_pattern(FORCE_DIRECT, FORCE_INDIRECT, FORCE_NOUN, "{unit}"),
        build=_amount("force", "g"),
        slots={
            "unit": {
                "mN": "in (millinewtons|mN)",
                "g": "in (grams|grams of force|grams of weight|g|gram-force)",
            }
        },
    ),
    _family(
        "area",
        "area",
        "%",
        f"{AREA_DIRECT}|how many percent of the (pad|gel|sensor) (are covered|does {{thing}} touch)",
        AREA_INDIRECT,
        AREA_NOUN,
        "[in (percent|per cent|percent of the pad|%)]",
    ),
    _family(
        "area_mm2",
        "area",
        "mm²",
        AREA_DIRECT,
        AREA_INDIRECT,
        AREA_NOUN,
        "in (mm²|mm2|square millimetres|square mm)",
    ),
    QuestionFamily(
        name="position_x",
        pattern=amount_pattern(
            "how far (to the side|from the vertical midline) is {thing}|what is x|"
            "at which x is {thing}|how far left or right is {thing}",
            "how far (to the side|from the vertical midline) {thing} is|what x is|"
            "how far left or right {thing} is",
            "the x [coordinate|position|value] [of {touch}]|x|where {thing} is along x",
            "[in (mm|millimetres)]",
        ),
        build=_amount("x", "mm"),
    ),
    QuestionFamily(
        name="position_y",
        pattern=amount_pattern(
            "how far up or down is {thing}|what is y|at which y is {thing}|"
            "how far (from the horizontal midline|towards the palm) is {thing}",
            "how far up or down {thing} is|what y is|how far towards the palm {thing} is",
            "the y [coordinate|position|value] [of {touch}]|y|where {thing} is along y",
            "[in (mm|millimetres)]",
        ),
        build=_amount("y", "mm"),
    ),
    QuestionFamily(
        name="distance",
        pattern=amount_pattern(
            "how far (off|from|away from) [the] (center|middle) [of the pad] is {thing}|"
            "how far is {thing} (from|away from) the (center|middle) [of the pad]|"
            "how badly is {thing} off center|how much is {thing} off center",
            "how far {thing} is (from|away from) the (center|middle) [of the pad]|"
            "how much {thing} is off center|how far off center {thing} is",
            "the (distance|offset) (from|to) the (center|middle) [of the pad]|the centering error|"
            "the eccentricity of {touch}",
            "[in (mm|millimetres)]",
        ),
        build=_amount("distance", "mm"),
    ),
    QuestionFamily(
        name="band_values",
        pattern=amount_pattern(
            "(how much|what) force is {bound} wanted|what is the {bound} force "
            "(of the band|in the contract|that is wanted [for {body}])|where does the force band "
            "{edge}|what is the (hard|force|force's) limit|which force is the limit",
            "what the {bound} force (of the band|in the contract|that is wanted [for {body}]) is|"
            "where the force band {edges}|what the (hard|force) limit is|which force is the limit",
            "the {bound} force (of the band|in the contract|that is wanted [for {body}])|"
            "the (hard limit|force limit|limit) [of the contract|on the force|for {body}]|"
            "the {end} end of the [force] band",
            "[in (newtons|N)]",
        ),
        slots={
            "bound": {
                "band_low": "(least|lowest|smallest|minimum|minimal)",
                "band_high": "(most|highest|largest|greatest)",
            },
            "edge": {"band_low": "(start|begin)", "band_high": "(end|stop)"},
            "edges": {"band_low": "(starts|begins)", "band_high": "(ends|stops)"},
            "end": {"band_low": "(lower|low)", "band_high": "(upper|top)"},
        },
        build=lambda bindings, _: Amount(
            quantity=next((bindings[n] for n in BOUNDS if n in bindings), "limit"),
            unit="N",
            length=length_of(bindings),
        ),
    ),
    QuestionFamily(
        name="headroom",
        pattern=amount_pattern(
            "how much [more] force is left (to|below|until) the limit|how far are we (from|below) "
            "the [force] limit|how many newtons (are left|remain) (to|below|until) the limit|"
            "how much harder (can|may) we (press|grip|squeeze) [{thing}]",
            "how much [more] force is left (to|below|until) the limit|how far we are (from|below) "
            "the [force] limit|how much harder we (can|may) (press|grip|squeeze) [{thing}]",
            "the (distance|margin|room) (to|below|up to) the [force|hard] limit|"
            "the force that is left (to|below) the limit|the force margin",
            "[in (newtons|N)]",
        ),
        build=_amount("headroom", "N"),
    ),
    QuestionFamily(
        name="mass",
        pattern=amount_pattern(
            "how heavy is {thing}|how much does {thing} weigh|what does {thing} weigh|"
            "what is the (mass|weight) of {thing}",
            "how heavy {thing} is|how much {thing} weighs|what {thing} weighs|"
            "what the (mass|weight) of {thing} is",
            "the (mass|weight) [of {thing}]",
            "[in (grams|g)]",
        ),
        build=_amount("mass", "g"),
    ),
    QuestionFamily(
        name="holds",
        pattern=amount_pattern(
            "how heavy a (thing|load|part) (can|could) this grip (hold|carry|lift)|"
            "how much weight (can|could) (we|this grip|these fingers) (hold|carry|lift)|"
            "how heavy may {thing} be [before it slips]|what weight (can|does) this grip (hold|carry)",
            "how much weight (we|this grip|these fingers) (can|could) (hold|carry|lift)|"
            "how heavy {thing} may be [before it slips]",
            "the (largest|greatest|highest) (weight|mass|load) (we|this grip|these fingers) can "
            "(hold|carry)|the (payload|carrying capacity) of this grip",
            "[in (grams|g)]",
        ),
        build=_amount("holds", "g"),
    ),
)
