"""Whether a text surely asks for more than a force, where its words could as well warn of it.

'More than 1 N' is a wish in 'hold it with more than 1 N', and none in 'only a fool exceeds 1 N' or
'more than 1 N is asking for trouble'. Taken for a wish it would raise the force and the limit, so
that it counts only where nothing else is said: every other word of its clause must be one of a plain
request. Not here: denials and warnings that are known (``relations``).
"""

from __future__ import annotations

import re

from policies.instructions.english import words
from policies.instructions.english.number_pattern import NumberPattern
from policies.instructions.quantities.force_units import ONE_FORCE

_OVER = NumberPattern(
    rf"(?:\b(?:more than|over|above|beyond|past|exceed\w*|surpass\w*|pass(?:es|ing)?|(?:higher|greater|harder|firmer|tighter|stronger|larger) than|in excess of|north of)"
    rf"|>)(?: (?:a|an|the|about|around|roughly|force of|total of))* ?{ONE_FORCE}|{ONE_FORCE},? (?:or|and) (?:more|above|over|higher|up|upwards?|greater|harder|firmer|beyond)\b"
)
_LEAST = NumberPattern(
    rf"\b(?:at (?:the )?(?:very |absolute )?least|(?:a )?minimum(?: of)?|no less than) (?:about |around )?{ONE_FORCE}"
)
_CLAUSE = re.compile(
    r"[.;:!?,()](?!\d)|\s[-–—]+\s|\b(?:but|because|since|so that|otherwise|or else|until|till|while|whatever happens)\b"
)
_PLAIN = words.word_list("plain_request")
_OURS = r"(?:(?:straw ?)?berr|fruit|object|thing|force|grip|squeeze|pressure|strength|hand|finger|sample|specimen|task|job|target|minimum|band|range|one\b|egg|tomato|peg)"
"""How nouns begin that a request may have for its subject."""
_CLIENTS = rf"(?:{words.any_of('in_charge')}\b|test|trial|experiment|check|protocol|recipe|contract|spec|rule|item|piece|product|workpiece|part\b|it\b)"
"""The same of nouns that may want a force."""
_OTHERS = re.compile(
    r"^(?:(?:and|so|then|well|because|since|but) )*(?!(?:and|so|well|because|since|but|please|just|now|then|i|we|you|it|this|that|these|they|what|use|hold|grip|keep|apply|take|make|let|go|give|get|have|there)\b)"
    r"(?:(?:the|my|our|your|an?|most|all|other|some|old|previous|any) ){0,3}"
    rf"(?!{_OURS}|(?:the|my|our|your|an?|answer|kpi)\b|(?:\w+ )?{words.any_of('in_charge')} (?:wants|needs|requires|asks for|insists on|would like|demands|orders|specifies)\b)"
    r"[a-z']+(?: robots?| gripper| operator)?(?: \w+ly)? (?:uses?|used|needs?|needed|wants?|wanted|takes?|took|insists?(?: on)?|says?|said|say|has|had|would|are|is|was|were|can|gets?|got|"
    r"exerts?|squeezes?|holds?|grips?|picks?|requires?|required|recommends?)\b"
)
_HELD = re.compile(
    r"\b((?:(?:hold|grip|grasp|pick|lift|take|grab|squeeze|clamp|fetch|catch|handle)(?:p?ing)?(?: up)?|(?:force|grip|hold|squeeze|pressure) on|for) (?:the|an?|that|this|my|our|your)) "
    r"(?:\w+ ){0,2}\w+(?= (?:with|at|by|using|and|in|above|over|must|should|shall|to)\b|[,.;!]| ?$)"
)
"""'Grip the rubber plug with', 'the force on the test tube': whatever it is."""
_WARNED = NumberPattern(
    rf"\b(?:careful|caution|warning|danger|attention|beware|watch out|mind)[:,!]? (?:of |for |about |with )?(?:{_OVER.pattern})"
)
_NOT_MEANT = re.compile(
    r"\b(?:the )?last thing\b|\b(?:just )?(?:kidding|joking)\b|\bas if\b|\b(?:keep|always|again) exceed\w*|\bi (?:fear|worry(?: about)?|am afraid)\b|"
    r"\b(?:if|when) you (?:use|exceed|go)\b|\bbroke the\b|\b(?:gripper|robot|arm|motor) (?:can|could|has)\b"
)
"""What shows that a force is no wish, wherever it stands."""
_UNAFRAID = re.compile(r"\b(?:not|never) (?:hesitate|be afraid|fear|mind)(?: to| of)?\b")
_OTHER_NEEDS = NumberPattern(
    r"(?:^|(?<=[.;,] )|\b(?:and|but|because) )(?:the|my|our|your|an?|other|most|that) (?:\w+ )?"
    rf"(?!{_OURS}|{_CLIENTS}|(?:can|could|may|might|will|would)\b)"
    rf"[a-z]+ (?:usually |always |only |really |just )?(?:needs?|takes?|took|wants?|requires?|required|pulls?(?: with)?|saturates? at|clips? at|stalls? at|squeezes?(?: at| with)?) (?:about |around |only |just |at least )?{ONE_FORCE}"
)
"""'The lid needs 4 N'."""


def needs_of_others(text: str) -> str:
    """The words of a force that something else needs or makes; '' for none."""
    found = _OTHER_NEEDS.search(text)
    return found[0].strip(" .;,") if found else ""


def unproved_least(text: str) -> str:
    """The words of a force that may be meant as a least one or as a warning; '' for none.

    Args:
        text: Plain text, its numbers in digits, in which a least force was read.
    """
    if warned := _WARNED.search(text) or _NOT_MEANT.search(text):
        return warned[0].strip()
    for clause in _CLAUSE.split(text):
        found = _OVER.search(clause or "")
        least = _LEAST.search(clause or "")
        if least and _OTHERS.match(clause.strip()):
            return least[0].strip()
        if found is None or least:
            continue
        clause = _HELD.sub(r"\1", _UNAFRAID.sub(" ", re.sub(ONE_FORCE, " ", clause)))
        if not _PLAIN.issuperset(re.findall(r"[a-z][a-z'-]*", clause)):
            return found[0].strip()
    return ""
