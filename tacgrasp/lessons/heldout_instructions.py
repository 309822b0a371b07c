"""Hand-written instructions that are never trained on; half of them name no object.

Each stands for the goal of a task. They were written before the first training, and wordings that
the model gets wrong stay.
"""

PARAPHRASES: dict[str, tuple[str, ...]] = {
    "cherry_tomato": (
        "Take hold of the cherry tomato, but only just, or its skin will split.",
        "This grape is tiny and bursts at once, so use the least force you can.",
        "Get the raspberry, touching it as lightly as possible.",
        "A very light grip on the little tomato, please.",
        "Hardly squeeze it at all; the skin is thin and bursts.",
        "The lightest possible hold, it splits at almost nothing.",
        "Use very little pressure, this one bursts easily.",
        "Extremely light and soft, please.",
    ),
    "strawberry": (
        "Would you pick the strawberry for me and not bruise it?",
        "Bring up the ripe berry with a soft, gentle hold.",
        "The strawberry is delicate, lift it without leaving bruises.",
        "Gently now: get the strawberry off the table.",
        "Be gentle, this bruises.",
        "Soft grip, no bruises please.",
        "Handle it with care so it is not squashed or bruised.",
        "Lift this gently and leave no marks on it.",
    ),
    "egg": (
        "Raise the egg safely and keep its shell from cracking.",
        "The egg must not fall, but it must not crack either.",
        "Take the raw egg with a secure grip that does not break the shell.",
        "Carry the light bulb safely without breaking it.",
        "A secure hold, careful enough that the shell stays whole.",
        "Not too loose and not too hard: it is heavy and cracks.",
        "Moderate force, it should neither drop nor break.",
        "Hold on securely, yet do not crack it.",
    ),
    "peg": (
        "Clamp the peg so strongly that it can't rotate during insertion.",
        "Get a tight hold of the steel rod.",
        "The bolt must not slip, so grip it hard.",
        "Take the metal peg with a really firm grip.",
        "Squeeze it tightly, nothing can be damaged.",
        "As strong a grip as you have, it must not turn.",
        "Hold this firmly, it will be pushed into a hole.",
        "Grip tight and hard, it must not slip.",
    ),
}
"""Instructions by task: the first four of each name an object, the last four do not."""
