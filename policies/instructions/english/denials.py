"""Whether the words around an order deny it: 'never', 'by no means', '... is forbidden'."""

from __future__ import annotations

import re

from policies.instructions.english import words

NO_CASE = r"(?:(?:in|by|at|under|on|for) (?:absolutely )?no (?:means|cases?|times?|way|events?|accounts?|conditions?|circumstances?|moment|point|price))"
"""'By no means', 'in no case'."""
FORBIDDEN = r"(?:forbid(?:s|den|ding)?|forbade|prohibit(?:s|ed|ing)?|bann?(?:ed|ing)?|disallow(?:s|ed)?|outlaw(?:s|ed)?|veto(?:es|ed)?)"
"""Verbs that forbid."""
REFUSES = r"(?:refus(?:e|es|ing)|declin(?:e|es|ing)|abstain(?:ing)? from|desist(?:ing)? from|refrain(?:ing)? from)"
"""Verbs of not doing."""

_NOT = re.compile(
    r"\b(?:not|never|without|avoid\w*|nor|neither|no need to|no reason|prevent\w*|instead of|rather than|refrain\w* from|stop|"
    rf"{FORBIDDEN}|{NO_CASE}|{REFUSES}|"
    r"keep(?:s|ing)? (?:it |me |you )?from|until|till|before|unless|when i|once i|if i|after i|than|risk of|afraid of|fear of|danger of|do not want|careful not|mind|watch(?: out for)?|careful (?:of|with|about)|beware of|clear of|away from|quit|free of)\b"
)
_IS = r"(?:is|are|was|were|be|being|stays?|remains?|(?:has|have) been|seems?|counts as)"
_FORBIDDEN_STATE = (
    r"(?:forbidden|prohibited|banned|disallowed|outlawed|vetoed|taboo|verboten|illegal|impermissible|inadmissible|unacceptable|unwanted|undesired|undesirable|inadvisable|wrong|unwelcome|"
    r"(?:no longer |never )?(?:out of the question|off[ -]limits|ruled out)|an? no[ -]?(?:no|go)|(?:a bad|no) (?:idea|option)|a mistake|against (?:the|my|our) (?:rules|orders|will)|"
    r"(?:not|never|no longer) (?:to be (?:done|tried|attempted)|allowed|permitted|acceptable|admissible|authori[sz]ed|tolerated|wanted|desired|desirable|advisable|wise|needed|necessary|required|called for|welcome|ok(?:ay)?|all ?right|an? (?:good idea|option)|what i want))"
)
_AVOIDED = r"(?:(?:must|should|shall|may|can|will|is|has|needs?|ought)(?: to)? (?:(?:be avoided|be refrained from|be omitted|be skipped)|(?:not|never) (?:happen|occur|take place|be (?:done|tried|attempted|allowed|permitted|started|performed|tolerated|used|applied|exerted|employed|exercised|chosen|commanded|set|put on))))"
FORBIDDEN_AFTER = rf"(?:(?:{_IS} (?:\w+ly |still |now |therefore |also |hereby )*)?{_FORBIDDEN_STATE}(?! (?:to|from)\b)|{_AVOIDED})\b"
"""Behind what somebody does: it is forbidden."""

_FORBIDDEN_BEHIND = re.compile(rf"^[^,;.#]{{0,30}}? {FORBIDDEN_AFTER}")


_REPEATED = re.compile(
    r"(?<=\bit )(?=(?:do not|never)\b)|(?<=\b(?:them|this|that) )(?=(?:do not|never)\b)"
)
"""'Do not drop it do not drop it': the second denial does not undo the first."""


def is_denied(before: str, after: str = "") -> bool:
    """Whether the words before or behind a match in its clause deny it."""
    before = _REPEATED.split(before[-70:])[-1]
    part = before.rpartition(" and ")[2]
    denials = len(_NOT.findall(part if _NOT.search(part) else before))
    return (denials + bool(_FORBIDDEN_BEHIND.match(after))) % 2 == 1


_BEGUN = (
    r"(?<!why )(?<!if )(?<!or )(?<!whether )(?:not|never|nothing|nobody|neither|refrain(?:ing)?|abstain(?:ing)?|no (?:time|account|circumstances?|case|means|way|event|need|more|reason))"
    r"(?: (?:you|i|we|it|the grip|the force|ever|even|again|to|from|should|must|may|can|will|want|wants|allow|like|need|for|a|an|one|once|single|second|moment|instant|dare|trying|try|in|any|robot|please|repeat|whatsoever|be|going))*"
)
_GOES_ON = (
    rf"(?!(?:\w+ ){{0,2}}?(?:not|never|no|but|instead)\b)(?:\w+ ){{0,2}}?(?:{words.any_of('hold')}|use|using|apply|applying|exert|exerting|press|go|going|get|feel|exceed|let|touch|put|make|"
    r"more|over|above|beyond|in excess|higher|harder|less|under|below|lower|weaker|anything|a force)\b"
)
_INTERPOSED = re.compile(
    rf"\b(?P<denial>{_BEGUN})(?: ?,+ | \(| [-–—]+ )(?!(?:{words.any_of('hold')}|use|using|but (?!nothing|never)|and (?!i\b|this\b|that\b|it\b))\b)"
    rf"[^,;.:!?()#\d–—]{{2,60}}?(?:, ?|\) ?| [-–—]+ )(?={_GOES_ON})"
)
"""'It should not, in my opinion, feel more than 1 N.'"""


def without_interposed(text: str) -> str:
    """A plain text whose denials stand beside what they deny."""
    return _INTERPOSED.sub(r"\g<denial> ", text)
