"""Vocabulary of the training instructions, by firmness of the grip.

There are four levels of firmness, one for each task. They differ in the danger to the object
(bursting, bruising, cracking, slipping), its properties and the manner of the grip. Not here: how
the words become sentences (``tacgrasp.lessons.instructions``), and the wordings kept for tests
(``tacgrasp.lessons.heldout_instructions``).
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class Firmness:
    """Phrases for one level of firmness.

    Attributes:
        objects: Objects, after 'the'.
        manners: Manners of gripping: 'Pick it up ...'.
        grips: Adjectives of the grip with their articles, before 'grip'.
        forces: Quantities, before 'force' or 'pressure'.
        attitudes: Attitudes of the gripper: 'Be ...'.
        properties: Properties of the object: 'it is ...'.
        fates: Dangers to the object as verbs: 'it ...', some with their causes.
        prohibitions: The same as prohibitions: 'do not ...'.
        harms: The same as gerunds: 'without ...'.
        dangers: The same as infinitives: 'it must not ...'.
        clauses: Other reasons for the grip, as whole clauses.
    """

    objects: tuple[str, ...]
    manners: tuple[str, ...]
    grips: tuple[str, ...]
    forces: tuple[str, ...]
    attitudes: tuple[str, ...]
    properties: tuple[str, ...]
    fates: tuple[str, ...]
    prohibitions: tuple[str, ...]
    harms: tuple[str, ...]
    dangers: tuple[str, ...]
    clauses: tuple[str, ...]


_BURSTS = Firmness(
    objects=(
        "cherry tomato", "tomato", "small tomato", "raspberry", "blackberry", "grape", "blueberry",
        "currant", "soap bubble", "water drop", "rose petal", "poppy",
    ),
    manners=(
        "very gently", "extremely gently", "with the lightest touch", "as softly as you can",
        "very softly", "with hardly any force", "with very little force", "barely squeezing it",
        "very lightly", "ever so gently", "as gently as possible", "with the least force",
        "with almost no pressure", "hardly touching it", "as lightly as you can manage",
        "with the faintest grip", "really lightly", "with minimal force", "just barely",
        "only just", "with next to no force", "touching it as little as you can",
    ),
    grips=(
        "a very light", "an extremely light", "the lightest", "the softest", "a feather-light",
        "a very soft", "a barely closed", "the gentlest", "a minimal", "the faintest",
        "an extremely gentle", "the slightest",
    ),
    forces=(
        "very little", "hardly any", "almost no", "the least possible", "minimal", "the smallest",
        "next to no", "the lightest", "scarcely any", "extremely little",
    ),
    attitudes=(
        "extremely gentle", "very gentle", "as gentle as you can", "extremely careful and light",
        "very light", "as light as a feather", "extremely soft",
    ),
    properties=(
        "very fragile", "very fragile and light", "tiny", "very thin-skinned", "extremely delicate",
        "as thin as paper", "about to burst", "tiny and thin-skinned", "extremely fragile",
        "full of juice under a thin skin", "very easily torn",
    ),
    fates=(
        "splits easily", "bursts at the slightest pressure", "bursts at once", "tears easily",
        "splits under the least load", "bursts easily", "pops if you press it at all",
        "splits at a touch", "gives way at almost no force", "tears at the slightest squeeze",
        "bursts very quickly", "pops open at nearly nothing",
    ),
    prohibitions=("burst it", "split its skin", "tear it", "pop it", "let it burst", "split it"),
    harms=("bursting it", "splitting its skin", "tearing it", "popping it"),
    dangers=("burst", "split", "tear", "pop", "be torn"),
    clauses=(
        "the least pressure will burst it", "its skin is very thin", "the skin tears at nothing",
        "any pressure will split it", "the skin splits easily", "its thin skin must stay whole",
    ),
)  # fmt: skip

_BRUISES = Firmness(
    objects=(
        "strawberry", "berry", "ripe strawberry", "apricot", "fig", "ripe fruit", "peach", "plum",
        "fruit", "soft berry", "pastry", "marshmallow",
    ),
    manners=(
        "gently", "softly", "with care", "with a soft grip", "delicately", "with a gentle grip",
        "tenderly", "with little force", "with a light hand", "without squeezing hard", "carefully",
        "with gentle fingers", "gently and carefully", "in a gentle way", "with low force",
        "softly and with care", "with light pressure", "with a gentle touch", "lightly",
        "with a tender grip", "without pressing hard", "mildly",
    ),
    grips=(
        "a gentle", "a soft", "a tender", "a light", "a careful", "a delicate", "a mild",
        "a soft and careful", "a gentle, careful", "a caring",
    ),
    forces=("little", "gentle", "light", "low", "mild", "soft", "a small", "only a little"),
    attitudes=("gentle", "careful", "soft", "tender", "delicate", "gentle and careful", "kind"),
    properties=(
        "soft and ripe", "delicate", "soft", "ripe", "tender", "ripe and juicy", "quite delicate",
        "easily bruised", "soft inside", "sensitive", "easily squashed", "fresh and soft",
    ),
    fates=(
        "bruises easily", "bruises", "squashes easily", "gets marks easily", "dents easily",
        "bruises when squeezed", "is bruised by a hard grip", "is easily crushed",
        "gets bruised if you press hard", "shows every mark",
    ),
    prohibitions=(
        "bruise it", "squash it", "leave marks on it", "crush it", "mash it", "dent it", "mark it",
        "leave any bruise", "squeeze it too hard", "damage its flesh", "make it mushy",
    ),
    harms=(
        "bruising it", "squashing it", "leaving marks on it", "crushing it", "denting it",
        "any bruises", "leaving a bruise", "marking it", "mashing it", "making dents",
    ),
    dangers=("be bruised", "get bruised", "be squashed", "be crushed", "be marked", "get dents"),
    clauses=(
        "there should be no bruises", "no marks, please", "no bruises", "leave no bruise on it",
        "it should stay unbruised", "leave no dents", "keep it free of bruises",
        "it should look untouched",
    ),
)  # fmt: skip

_CRACKS = Firmness(
    objects=(
        "egg", "raw egg", "hen's egg", "light bulb", "wine glass", "eggshell", "glass", "teacup",
        "porcelain cup", "glass bottle", "vase", "fresh egg",
    ),
    manners=(
        "securely", "safely", "with a secure but careful grip", "reliably, but not too hard",
        "with moderate force", "with a medium grip", "steadily and carefully",
        "not too hard and not too loosely", "with a safe hold", "fairly firmly, but with care",
        "with a steady grip", "in a secure way", "with medium force", "safely and steadily",
        "securely, yet carefully", "neither loosely nor hard", "moderately firmly",
        "with a balanced grip", "well enough to hold its weight", "with a sure hand",
        "surely but with caution", "with a reliable grip",
    ),
    grips=(
        "a secure", "a safe", "a moderate", "a medium", "a steady", "a secure but careful",
        "a reliable", "a sure", "a balanced", "a safe and steady", "a medium-strength",
    ),
    forces=("moderate", "medium", "a moderate", "a fair", "an average", "middling", "balanced"),
    attitudes=(
        "secure but careful", "safe", "steady", "moderate", "reliable but not rough",
        "sure and steady", "neither too soft nor too hard",
    ),
    properties=(
        "heavy but brittle", "brittle", "made of thin glass", "hard but breakable", "heavy",
        "heavy and brittle", "smooth and breakable", "of brittle shell", "fragile and heavy",
        "stiff but not unbreakable",
    ),
    fates=(
        "cracks when pressed too hard", "falls when held too loosely", "cracks or falls",
        "shatters if it drops", "cracks", "breaks if it falls", "can crack and can fall",
        "drops out of a loose grip", "breaks under a hard grip", "chips and cracks",
    ),
    prohibitions=(
        "crack it", "break it", "break the shell", "crack the shell", "drop it and do not break it",
        "let it fall and do not crack it", "shatter it", "chip it", "drop or crack it",
        "break it or let it fall",
    ),
    harms=(
        "cracking it", "breaking it", "breaking the shell", "cracking or dropping it",
        "shattering it", "dropping or breaking it", "breaking the glass",
    ),
    dangers=(
        "crack", "break", "crack and must not fall", "shatter", "fall or break", "be cracked",
        "drop, nor crack",
    ),
    clauses=(
        "it must neither crack nor fall", "the shell must not break", "keep the shell whole",
        "it should arrive whole", "keep it from cracking and from falling",
        "neither drop nor crack it", "it must not fall, and it must not break",
        "the shell should stay intact", "it should neither fall nor break",
    ),
)  # fmt: skip

_SLIPS = Firmness(
    objects=(
        "peg", "metal peg", "bolt", "steel rod", "screwdriver", "hammer", "wrench", "metal bar",
        "steel pin", "screw", "drill bit", "iron bar",
    ),
    manners=(
        "firmly", "tightly", "with a strong grip", "with plenty of force", "hard",
        "as firmly as you can", "with a tight grip", "very firmly", "strongly", "with high force",
        "with a lot of force", "really tightly", "as tightly as possible", "with full strength",
        "with a firm grip", "forcefully", "with great force", "solidly", "as hard as you can",
        "with all your strength", "tightly and firmly", "powerfully",
    ),
    grips=(
        "a firm", "a tight", "a strong", "a very firm", "a really tight", "a powerful", "a hard",
        "the strongest", "the firmest", "a solid", "an iron",
    ),
    forces=(
        "high", "strong", "plenty of", "a lot of", "great", "full", "maximum", "much", "large",
        "a great deal of",
    ),
    attitudes=(
        "firm", "strong", "forceful", "tough", "as strong as you can", "firm and tight", "rough",
    ),
    properties=(
        "hard and can not be damaged", "made of steel", "solid metal", "hard", "robust",
        "unbreakable", "rigid and tough", "heavy metal", "tough", "solid", "indestructible",
    ),
    fates=(
        "slips out of a weak grip", "turns when held loosely", "can not be damaged",
        "has to withstand a push", "is going to be pushed in", "twists in a loose grip",
        "takes any force", "will be hammered in", "has to resist a strong push",
        "rotates if you are too soft",
    ),
    prohibitions=(
        "let it slip", "let it turn", "let it rotate", "let it twist", "allow it to move",
        "let it spin in the fingers", "let it give way",
    ),
    harms=("letting it slip", "letting it turn", "any slipping", "letting it rotate or twist"),
    dangers=(
        "slip", "rotate", "turn", "twist", "move in the fingers", "slip or turn", "spin",
        "rotate in the fingers",
    ),
    clauses=(
        "nothing can break", "so that it does not turn when it is inserted",
        "so that it can not turn", "so that it can't slip", "it will be driven into a hole",
        "no slipping", "it has to stay put while it is pushed", "there is nothing to damage",
        "so that it stays in place under load",
    ),
)  # fmt: skip

LEVELS: dict[str, Firmness] = {
    "cherry_tomato": _BURSTS,
    "strawberry": _BRUISES,
    "egg": _CRACKS,
    "peg": _SLIPS,
}
"""Phrases by task, from gentle to firm."""

VERBS = (
    "pick", "pick up", "grasp", "grip", "hold", "lift", "take", "grab", "seize", "get", "raise",
    "carry", "handle", "take hold of", "hold on to", "lift up", "collect", "fetch", "squeeze",
    "clasp", "close on", "bring up", "clamp",
)  # fmt: skip
THINGS = (
    "it", "the object", "this", "the thing", "what you feel", "this object", "the item", "this one",
    "that", "this thing", "whatever is there",
)  # fmt: skip
POLITE = (
    "Please", "Now", "Could you", "I want you to", "Carefully:", "Next,", "Robot,", "Okay,",
    "Would you", "Can you", "You should", "Try to", "Go and", "Let's", "Kindly",
)  # fmt: skip
GRIPS = ("grip", "hold", "grasp", "touch", "squeeze")
