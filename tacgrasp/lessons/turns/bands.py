"""Follow-ups about the force band, written anew.

    What is its lower end?          And the upper one?  What is the upper end of the band?
    Is the force within the band?   How far off its middle?

Not here: the band that a person tells (``tacgrasp.lessons.turns.told``).
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from tacgrasp.lessons.dialogue.meaning import (
    Amount,
    Meaning,
    Several,
    truth_of,
)
from tacgrasp.lessons.turns.leads import END, LEAD, without_lead

_ASKED_END = r"(?:where does it |where's the |what(?:'s| is) |the |its |it )*"
_AGREED = r"(?: (?:of the band|we agreed on|allowed))?"
_BAND_WORDS = {
    rf"{_ASKED_END}(?:end|ends|stop|stops|(?:upper|high|higher|highest|largest|most)"
    rf"(?: end| one)?|top){_AGREED}": "What is the upper end of the band?",
    rf"{_ASKED_END}(?:start|starts|begin|begins|(?:low(?:er|est)?|smallest|least)"
    rf"(?: end| one)?|bottom){_AGREED}": "What is the lower end of the band?",
    r"(?:how (?:wide|broad) (?:is it|does that make it)|(?:the |its )?(?:width|breadth|span))":
        "What is the width of the band?",
    r"(?:(?:where|what) is )?(?:the |its )?(?:middle|midpoint|cent(?:er|re)|mean)(?: of (?:it|"
    r"them|both|"
    r"the two))?":
        "What is the middle of the band?",
}  # fmt: skip
_BAND_WORD = {
    re.compile(rf"{LEAD}(?:{words}){END}", re.I): text for words, text in _BAND_WORDS.items()
}
"""Follow-ups about the band, once one of its ends was asked for."""
_OWN_END = re.compile(
    r"\b(?:the|its|that|this) (?P<which>upper|lower|top|bottom|high|low)(?: (?:end|edge|bound|"
    r"limit|one)\b(?: of (?:it|that|this)\b)?(?! of)|(?= or )|(?=[?.! ]*$))",
    re.I,
)
HOW_FAR_FROM = re.compile(
    r"^(?:(?:and|so|ok)[, ]+)*how (?:far|much|many newtons)(?: (?:are we|is that|is it|am i))?"
    r"(?: away)? (?:from|off|to) ",
    re.I,
)
_PLAIN_END = {"high": "upper", "low": "lower", "top": "upper", "bottom": "lower"}
_ARE_WE = re.compile(r"^(?:am i|are we)\b", re.I)
_NEARER = re.compile(
    r"which(?: (?:of the two|one|end|bound))? is (?:the )?(?:near|clos)er(?: to (?:it|us))?[,:]? "
    r"(?:the )?(?P<a>lower|upper)(?: one| end)? or (?:the )?(?P<b>lower|upper)(?: one| end)?"
    r"[?.! ]*",
    re.I,
)
_IN = re.compile(r"(?<=\w )(?:in|inside|within)(?: (?:it|that|there))?(?=[?.! ]*$)", re.I)
"""'Am I in?', after a band."""


def about_the_band(question: str, meant: Meaning | None) -> Iterator[str]:
    """A short question about the band that was asked for before."""
    if meant is None or "band_" not in truth_of(meant):
        return
    parts = meant.parts if isinstance(meant, Several) else (meant,)
    if all(isinstance(each, Amount) and each.quantity.startswith("band_") for each in parts):
        yield from (text for words, text in _BAND_WORD.items() if words.fullmatch(question))
    own = _OWN_END.sub(
        lambda end: f"the {_PLAIN_END.get(end['which'].lower(), end['which'])} end of the band",
        without_lead(question),
    )
    own = re.sub(r"\bof (?:it|them)\b", "of the band", own)
    own = re.sub(
        r"\b(?:that|this|its) middle|\b(?:that|this) (?:midpoint|cent(?:er|re))\b",
        "the middle of the band",
        own,
    )
    own = re.sub(r"\bthe new one\b", "the band", own)
    if nearer := _NEARER.fullmatch(own):
        yield f"Is the force nearer to the {nearer['a']} or the {nearer['b']} end of the band?"
    texts = (
        own,
        HOW_FAR_FROM.sub("how far is the force from ", own),
        _ARE_WE.sub("Is the force", own),
    )
    yield from (text for text in texts if text != without_lead(question))
    if _IN.search(question):
        yield _IN.sub("in the band", without_lead(question))
