"""Phrases inside a question for which others know a plainer one of the same meaning.

    less than a quarter of our allowance        less than a quarter of the limit
    a 1-cent coin, i.e. 207 mm²                 207 mm²
    the ratio limit : force                     the ratio of limit to force

Not here: constructions of whole questions
(``tacgrasp.lessons.dialogue.rewordings.reworded``).
"""

from __future__ import annotations

import re

_ALLOWED = re.compile(
    r"\b(?:(?:our|my|your|the|its) (?:whole |full |total |force )*(?:allowance|quota|force budget)|"
    r"(?:the )?(?:most |maximum )?(?:what|that) (?:it|we|you|i|they|the (?:grip|gripper|robot))"
    r"(?:(?:['’](?:s|re|m))| is| are| am) (?:ever )?(?:allowed|permitted)"
    r"(?: to (?:use|apply|exert|press(?: with)?|squeeze(?: with)?|put on))?)(?! to\b)",
    re.I,
)
_MEANS_NUMBER = re.compile(
    r"\b(?P<sign>than|over|above|under|below|exceeds?|exceeding) (?:an?|the) [^,;?]*?,? ?\(?"
    r"(?:i\.? ?e\.?|that is|meaning|namely)[,:]? (?P<number>[\d.,]+ ?[^\s,?)]+)\)?",
    re.I,
)
_PLAIN = (
    (re.compile(r"\bratio (?:of )?(?P<a>[a-z]+) ?[:/] ?(?P<b>[a-z]+)\b", re.I),
     r"ratio of \g<a> to \g<b>"),
    (re.compile(r"\bits own weight (?P<verb>is|was) (?P<rest>(?:the|our|this) (?:[a-z]+ )?"
                r"(?:force|grip|squeeze))(?: on (?:this \w+|the \w+|it))?", re.I),
     r"the object's weight \g<verb> \g<rest>"),
    (re.compile(r"(?<=as much as )(?:this|the|our|my) (?:grip|gripper|hand|robot) "
                r"(?:presses|squeezes|pushes|clamps|grips)(?: with)?\b", re.I), "the force"),
    (re.compile(r"\ban? (?:[a-z]+ )?(?:thing|form|shape|something)(?: shaped)? like (?=an? )",
                re.I), ""),
    (re.compile(r"how many (?:%|per ?cent) (?P<side>above|below|over|under) (?P<b>[^?]+?) "
                r"(?:is|are|does) (?P<a>(?:the |our )?(?:[a-z]+ )?[a-z]+)(?: lie)?(?=[?.! ]*$)",
                re.I),
     r"by what percentage is \g<a> \g<side> \g<b>"),
    (re.compile(r"(?<=\w)\s*[,;:–—-]+ (?:all |just |only )?(?:two|three|four) (?:numbers|figures|"
                r"values|readings)(?: please)?(?=[?.! ]*$)", re.I), ""),
    (re.compile(r"(?<=\w), (?:or|no)(?=\s*\?+\s*$)", re.I), ", right"),
    (re.compile(r"\b(?P<name>depth|force|area|mass|x|y)_(?:mm|n|percent|g)\b", re.I),
     r"\g<name>"),
    (re.compile(r"^assert (?P<what>[^?]+?)[,;–—-]* *(?:[–—-] )?(?:would|will|does) (?:that|it) "
                r"(?:pass|hold|fail not)", re.I), r"is it true that \g<what>"),
    (re.compile(r"^(?:do|does|is|are) (?P<who>(?:the |our )?[a-z]+) (?:still )?need(?:s|ing)? "
                r"(?P<least>at least|more than|less than|over|under) (?:another |an? (?:extra|"
                r"further) )?(?P<number>[\d.,]+ ?[a-z]+)(?: more| extra)? to "
                r"(?:reach|get (?:in)?to|enter|be in|come into) (?:the )?(?:force )?"
                r"(?:band|range|window)", re.I),
     r"is the lower end of the band minus the force \g<least> \g<number>"),
    (re.compile(r"(?P<need>\b(?:how much|what) (?:grip|force|squeeze)\b[^?]*\b(?:needed|required|"
                r"necessary|needs?|requires?)\b[^?]*?)(?:,? and|\?) (?:do|have) (?:we|you|i) "
                r"(?:have |got |apply |press )?(?:it|that|enough|that much|so much)\b", re.I),
     r"\g<need>? Is the hold strong enough for what it weighs"),
    (re.compile(r"\b(?P<a>[a-z]+) or (?P<b>(?:an? )?[a-z]+),? or (?P<rest>(?:is it )?(?:neither|"
                r"none of (?:them|those|these)|something else))\b", re.I),
     r"\g<a>, \g<b> or \g<rest>"),
    (re.compile(r"\bhow far (?:off|away|apart) is (?=[^,;.?]+ from )", re.I), "how far is "),
    (re.compile(r"\b(?:squished|squashed|pressed|touched|flattened) (?:spot|bit|patch)\b", re.I),
     "contact area"),
    (re.compile(r"\b(?P<number>\d+(?:\.\d+)?|a) mills?\b", re.I), r"\g<number> millimetre"),
    (re.compile(r"\b(?:is|was)(?:n['’]t| not) (?:even |quite )?as (?:much|high|strong|large|big|"
                r"deep) as\b", re.I), "is less than"),
    (re.compile(r"^(?:relative|compared) to (?P<mark>[^:,;?]+)[:,] (?P<sides>over or under|"
                r"above or below|under or over|below or above)(?=[?.! ]*$)", re.I),
     r"is the force \g<sides> \g<mark>"),
    (re.compile(r"\b(?:unwise|foolish|reckless|a bad idea|a mistake) to (?=(?:lift|hoist|raise|"
                r"pick)\b)", re.I), "unsafe to "),
    (re.compile(r"(?<= of )(?:your|my|our) (?=pad\b)", re.I), "the "),
    (re.compile(r"\bthe wh?ether\b", re.I), "the weather"),
    (re.compile(r"^(?:and |so |but )*(?:what|which) (?:force )?(?:band|range|window) (?:are|do|is|"
                r"did|must|should) (?:you|we|the (?:robot|gripper)|i) (?:aim|go|try|want|work|"
                r"target|mean|plan|hope)\w*(?: (?:for|at|after|to (?:reach|hit|get|be in)|in|"
                r"now))*(?=[?.! ]*$)", re.I), "what is the force band"),
    (re.compile(r"^(?:and |so |but )*(?:what|which) force (?:are|do|is) (?:you|we|the (?:robot|"
                r"gripper)) (?:aiming|going|trying|working|heading)(?: (?:for|at|after|towards?|"
                r"to (?:reach|hit|get(?: to)?)))*(?=[?.! ]*$)", re.I), "what is the force band"),
    (re.compile(r"^((?:in )?(?:just |only )?(?:one|a single) word[:,;–—-]+ *)?(?:what (?:do|can) "
                r"you (?:feel|sense|touch)|what (?:is it|have you got|are you (?:feeling|holding|"
                r"touching))|describe (?:it|the (?:contact|touch|object)|what you feel))"
                r"(?(1)|[,:]? (?:in|using|with) (?:just |only )?(?:one|a single) word)"
                r"(?=[?.! ]*$)", re.I), "shape in one word"),
)  # fmt: skip


def with_plain_phrases(text: str) -> str:
    """A question with plainer phrases; the text itself where it has no others."""
    text = _ALLOWED.sub("the limit", text)
    text = _MEANS_NUMBER.sub(r"\g<sign> \g<number>", text)
    for pattern, plain in _PLAIN:
        text = pattern.sub(plain, text)
    return text
