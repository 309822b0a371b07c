"""Words of comparisons that several kinds of questions share, as patterns.

Not here: names of quantities (``tacgrasp.lessons.dialogue.calculations.quantity_names``).
"""

from __future__ import annotations

import re

BELOW = (
    r"short of|below|under|beneath|shy of|(?:less|smaller|lower) than|falls? short of|"
    r"(?:lies?|falls?|stays?|remains?) (?:below|under|short of)|undershoots?|lacks? to|lacking to"
)
"""Behind a term that is less than what follows."""

ABOVE = (
    r"above|over|beyond|past|in excess of|exceeds?|surpass(?:es)?|overshoots?|"
    r"(?:more|greater|larger|higher|deeper) than|(?:lies?|goes|rises) (?:above|over|beyond)"
)
"""Behind a term that is more than what follows."""

MOVES = (
    r"(?:(?:put|land|take|bring|push|get|carry|leave|keep|set|move|drop|knock|pull|lift|send|drive|"
    r"tip|lower|raise|throw|shove)(?:s|ing)? (?:us|me|you|it|things|the (?:force|grip|squeeze)))"
)
"""Verbs of what brings the grip somewhere, with their object."""

_THROUGH = r"(?:through|past|over|beyond|above)"
EXCEEDS = (
    r"exceed(?:s|ed|ing)?|surpass(?:es|ed|ing)?|violat(?:es?|ed|ing)|break(?:s|ing)?|broken|broke|"
    r"breach(?:es|ed|ing)?|tops?|topped|topping|bust(?:s|ing)?|cross(?:es|ed|ing)?|"
    r"beats?|beating|overshoot(?:s|ing)?|overstep(?:s|ped|ping)?|outweigh(?:s|ed)?|trip(?:s|ped|"
    r"ping)?|"
    r"outstrip(?:s|ped)?|"
    rf"(?:go|goes|going|gone|went|get|gets|got|getting|run|running|blow|blows|blowing|burst|bursts|"
    rf"bursting|shoot|shooting|sail|sailing|push|pushing|rise|rises|rising|climb|climbs|climbing|"
    rf"jump|jumping|move|moving|tip|tipping|step|stepping|come|coming|land|landing|slip|"
    rf"pass|passing|smash|smashing|crash|crashing|{MOVES}(?: up)?) {_THROUGH}|pass(?:es|ed|ing)?"
)
"""Verbs between a term and what it is more than."""

REACHES = (
    r"(?:(?:at least|just|barely|even) )?(?:reach(?:es|ed|ing)?|comes? up to|coming up to|meets?|"
    r"attains?|attained|(?:(?:get|gets|got|go|goes|make it|come|comes|climb|climbs|rise|rises|"
    rf"{MOVES}) )(?:(?:all the way|right|even) )?"
    r"(?:up )?(?:to|as far as)|(?:be |is )?(?:enough|sufficient) to (?:reach|get (?:up )?to|meet)|"
    r"suffices? to reach|arrives? at|hits?|touch(?:es|ing)?|clears?)"
)
"""Verbs between a term and what it is at least as much as."""

AGAINST = (
    r"(?P<more>(?:more|further|farther|greater|higher) than|over|beyond|above|exceed(?:s|ing)?)|"
    r"(?P<less>(?:less|fewer|nearer|closer|smaller|lower|gentler|lighter|weaker|milder) than|under|"
    r"within|below)|"
    r"(?P<least>at least|no less than)|(?P<most>at most|no more than)"
)
"""Before a number that something is more or less than; ``sign_of`` tells which."""

_SIGNS = {"more": ">", "less": "<", "least": ">=", "most": "<="}

PARTS = r"(?:percent|percentage|share|fraction|part|proportion)"
"""Words of a share."""

IS = r"(?:is|are|am|was|would|does|do|did|will|has|have|lies|lie|stands?)"
"""Verbs between the terms of a question."""


def sign_of(found: re.Match[str]) -> str:
    """The comparison that a match of ``AGAINST`` states."""
    return next(sign for name, sign in _SIGNS.items() if found[name])


def is_made_of(words: str, used: str) -> bool:
    """Whether each of some words is one that a pattern has."""
    return all(re.fullmatch(used, word) for word in words.split())
