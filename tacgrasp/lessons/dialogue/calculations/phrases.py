"""Words of comparisons that several kinds of questions share, as patterns.

Not here: names of quantities (``tacgrasp.lessons.dialogue.calculations.quantity_names``).
"""

from __future__ import annotations

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

PARTS = r"(?:percent|percentage|share|fraction|part|proportion)"
"""Words of a share."""

IS = r"(?:is|are|am|was|would|does|do|did|will|has|have|lies|lie|stands?)"
"""Verbs between the terms of a question."""
