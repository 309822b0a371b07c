"""Whether a text forbids to take hold of the object, in the active or the passive voice.

'Never grip it', 'it must not be held', 'gripping is forbidden', 'I do not want it touched' and
'hold nothing' all do; 'it must not be held too hard' forbids a manner only. Not here: other ways to ask for no grasp ('stop', 'hands off'), which are phrases in ``words.txt``.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from policies.instructions.english import words
from policies.instructions.english.denials import (
    FORBIDDEN,
    FORBIDDEN_AFTER,
    NO_CASE,
    REFUSES,
    is_denied,
)
from policies.instructions.english.text import CLAUSE
from policies.instructions.manner import has_manner
from policies.instructions.quantities import MARK

_ANY_MORE = re.compile(r"\b(gripped|grasped|held|touched|picked(?: up)?|lifted) any ?more\b")

_OBJECT_WORD = re.compile(rf"(?:{words.any_of('fruit')}|gripper|fingers?|robot)")

_INSTEAD = r"(?:instead of|rather than|except(?: for)?|save for|skip|omit|forgo|forego)"
_LEAD = (
    rf"(?:not|never|nobody|no one|neither|without|avoid|no|{REFUSES}|{FORBIDDEN}|{_INSTEAD}|cease|resist|illegal|wrong|undesirable|leave off|give up|(?:hold|shrink|shy|keep|stay)(?: back| away) from|"
    r"against (?:the|my|our|all) (?:rules?|orders?|will|wish(?:es)?)|"
    r"keep(?: (?:yourself|the (?:gripper|robot|fingers)|your (?:fingers|gripper|hands?)))? from)"
)
_FILLER = (
    r"(?:even|ever|again|is|there|here|grippers?|a single|a(?= (?:finger|hand)\b)|single|fingers?|hands?|part|you|your|think|about|of|try|to|dare|may|should|shall|must|can|will|are|allow|allowed|permit|permitted|authori[sz]ed|supposed|meant|"
    r"start|just|please|now|be|being|go|attempt|any|under|circumstances?|means|cases?|times?|way|events?|accounts?|conditions?|moment|point|price|permission|"
    r"want|wants|ask(?:s|ed)?|told|tells?|expects?|needs|would|like|me|it|yet|need|have|necessary|going|robots?|the|anyone|anybody|everyone|all|for|from|on|against|let|strictly|absolutely|"
    r"(?:ok(?:ay)?|wise|safe|desirable|desired|wanted|required|advised|advisable|acceptable|right|a good idea|reason)(?= (?:to|for)\b))"
)
_VERB = (
    r"(?:pick(?:ing)?|grasp(?:ing)?|grip(?:ping)?|hold(?:ing)?|lift(?:ing)?|grab(?:bing)?|seiz(?:e|ing)|touch(?:ing)?|rais(?:e|ing)|clasp(?:ing)?|"
    r"squeez(?:e|ing)|press(?:ing)?|clamp(?:ing)?|pinch(?:ing)?|clos(?:e|ing)|clutch(?:ing)?|handl(?:e|ing)|carry(?:ing)?|tak(?:e|ing)(?= (?:it|the|this|that)\b)|"
    r"(?:start|begin|perform|execut|attempt|carry out|initiat|do|mak)(?:e|n?ing)? (?:the|a|any|this|that|your) (?:grasp|grip|grab|pick-?up|lift)\b|"
    r"(?:get(?:ting)?|tak(?:e|ing)|lay(?:ing)?) hold\b|(?:lay|put|plac|set)(?:e|t?ing)? (?:an? |your |any |the )?(?:fingers?|hands?|gripper|claws?|jaws?) (?:on|onto|to|around|near)\b|"
    r"approach(?:ing)?|mov(?:e|ing)(?=[.!,]*$| the (?:gripper|arm|fingers?|robot)| at all| (?:a|an) (?:inch|muscle|millimet\w+|finger)| anything| toward\w*| it\b))"
)
_ACTIVE = re.compile(rf"\b(?P<lead>{_LEAD})(?: {_FILLER}){{0,7}} (?P<verb>{_VERB})\b(?P<after>.*)")

_HELD = (
    r"(?:pick(?:ed)?(?: up)?|grasped|gripped|held|lifted|grabbed|seized|touched|squeezed|pressed|clamped|pinched|clutched|handled|carried|"
    r"taken(?: hold of)?|approached|moved|closed|raised|clasped|plucked|harvested|fetched|contacted|engaged)"
)
_NEVER = rf"(?:not|never|nothing|none(?: of (?:it|them|the \w+))?|no longer|nobody|no one|neither|{NO_CASE})"
_OBJECT = r"(?:it|this|that|them|these|those|(?:the|my|our|this|that|any|an?) (?:\w+ )?\w+)"
_WISH = r"(?:want|wants|wish|wishes|like|need|have|see|let|allow|permit|accept|tolerate|stand)"
_HOW = r"(?: (?!to )\w+ly| ever| yet| again)?"
_PASSIVES = tuple(
    re.compile(rf"\b{pattern}{_HOW} (?P<verb>{_HELD})\b(?P<after>.*)")
    for pattern in (
        rf"(?P<lead>{_NEVER})(?: {_FILLER}){{0,7}} (?:be|being|get|getting|gets)",
        rf"(?P<lead>{_NEVER})(?: \w+){{0,2}}? {_WISH}(?: to (?:see|have|find))? {_OBJECT}(?: to be| to get| being| be| getting| get)?",
        rf"(?P<lead>prevent\w*|keep\w*|protect\w*|sav(?:e|ing)|stop|avoid\w*|without|instead of|rather than|{REFUSES}|{FORBIDDEN})(?: {_OBJECT}| its?)?(?: from| to)? (?:being|be)",
        r"(?:be|been) (?P<lead>not|never|neither)(?: to)?",
        r"(?:must|may|should|shall|can|will|is to|best|better|rather) (?P<lead>not|never)(?: be)?",
    )
)
_STATE = re.compile(
    rf"(?:\b(?:is|are|was|were|gets?|stays?|remains?) |^ ?)(?P<lead>not|never|neither)(?: to)?{_HOW} (?P<verb>{_HELD})\b(?P<after>.*)"
)
"""'It is not gripped', 'only to be looked at, not gripped': a wish where nothing else is asked for."""
_GERUND = (
    r"(?:picking|grasping|gripping|holding|lifting|grabbing|seizing|touching|raising|clasping|squeezing|pressing|clamping|pinching|closing|clutching|"
    r"handling|carrying|taking|approaching|(?:(?:any|all|physical|every) )*(?:contact|touch)|(?:the|a|any|every|this) (?:grasp|grip|pick-?up))"
)
_FORBIDDEN_GERUND = re.compile(
    rf"\b(?:\w+ )?(?P<verb>{_GERUND})\b(?P<object>[^,;#]{{0,40}}?)[:,]? (?P<lead>{FORBIDDEN_AFTER})(?P<after>.*)"
)
_COLON = re.compile(
    rf"\b({_GERUND})(?: it| the \w+)?: (?=(?:strictly |absolutely )?(?:{FORBIDDEN}|not\b|never\b|off\b))"
)
_NOTHING = re.compile(
    rf"\b(?P<verb>{_VERB})(?: up| onto| on to| hold of)? (?P<lead>(?:absolutely )?nothing|none of (?:it|them|the \w+))\b"
    r"(?P<after>(?! (?:but|else|more|less|other|except|special|over|above|beyond|\w+er)\b).*)"
)
_OLD_FASHIONED = re.compile(
    rf"^(?:please |robot,? |now )*(?P<verb>{_VERB}) (?:it|this|that|them|the \w+) (?P<lead>not)(?P<after>)[.!]*$"
)

_OTHER_THING = re.compile(
    r" (?:the|that|this|those|any) (?!straw|berr|fruit|gripper|fingers?|one\b|object|thing)\w+\b"
)
_OTHER_SUBJECT = re.compile(
    r"\b(?:the|its|that|this|these|those|any|all|both|your|my|other|neighbouring)(?: \w+)?? (?P<noun>\w+)(?: (?:must|may|should|shall|can|could|will|would|is|are|ought|need|needs|has|have|also|which|that|to|do|does))*\s*$"
)
_WAY = re.compile(
    r"\b(?:with(?! your| the gripper| any)|by(?! (?:you|any\w*|the (?:robot|gripper|arm|fingers?|hand)|a robot)\b)|like that|like this|table|mat|other|neighbou?r\w*|leaf|leaves|stem|anything else|against|back|up to|"
    r"otherwise|differently|any other way|without|except|alone|unattended|upside|sideways|again and again)\b"
)
"""Says in what way, or what else, so that only that is forbidden."""
_TIME = re.compile(r"\b(?:until|till|unless|before)\b")
_OTHERS_TURN = re.compile(
    r"\b(?:until|till|unless|before|when|once)(?: (?:i|he|she|they|we|my|our|someone|somebody|told|asked|instructed|further|the (?:operator|boss|supervisor))\b.*)"
)
_COORDINATED = re.compile(rf"\b(?:or|nor)(?: to)?(?: be)? (?:{_VERB}|{_HELD})\b")
_NO_ANSWER = re.compile(
    r"\?\s*(?:no|never|nope|nah)\b(?:,? (?:thanks|thank you|please|sir|way|never|no))*[.! ]*$"
)
"""'Hold it? No.'"""
_IDIOM = re.compile(r"\b(?:take (?:care|note)|keep in mind|get me right)\b")
"""No holding, in spite of its verb."""
_PURPOSE = re.compile(r"\b(?:so|such|lest|where|because|or|else|if|to)\b")
_ABOUT_IT = re.compile(r"\b(?:it|berry|fruit|one|this|that|strawberry)\b")


def prohibition(sentence: str, text: str) -> str:
    """The words of a plain sentence that forbid to take hold of the object; '' for none.

    Args:
        sentence: The sentence, its quantities replaced by ``MARK``.
        text: The whole text that it is of.
    """
    if (answer := _NO_ANSWER.search(text)) and not has_manner(text):
        return answer.group(0).strip("? .!")
    for clause in CLAUSE.split(_with_plain_words(sentence)):
        for match, is_passive in _matches(clause or ""):
            if _forbids(match, text, is_passive=is_passive):
                return match.group().strip()
    return ""


def _is_asked_elsewhere(after: str, core: str, text: str) -> bool:
    """Whether a text has a verb of holding beside the forbidden ones."""
    forbidden = (
        f"{core} {' '.join(_COORDINATED.findall(after))} {''.join(_OTHERS_TURN.findall(after))}"
    )
    return len(words.HOLD.findall(_IDIOM.sub("", text))) > len(words.HOLD.findall(forbidden))


def _with_plain_words(sentence: str) -> str:
    """'Gripping: forbidden' as 'gripping is forbidden', 'held any more' as 'held'."""
    return _ANY_MORE.sub(r"\1", _COLON.sub(r"\1 is ", sentence))


def _matches(clause: str) -> Iterator[tuple[re.Match[str], bool]]:
    """Prohibitions in a clause, each with whether it stands in the passive voice."""
    for pattern in (_ACTIVE, _FORBIDDEN_GERUND, _NOTHING, _OLD_FASHIONED):
        if match := pattern.search(clause):
            yield match, False
    for pattern in (*_PASSIVES, _STATE):
        if match := pattern.search(clause):
            yield match, True


def _forbids(match: re.Match[str], text: str, *, is_passive: bool) -> bool:
    """Whether a match forbids every hold, and not a manner, a way, a time or another thing."""
    before, after, verb = match.string[: match.start()], match["after"], match["verb"]
    said = match.group()
    if is_denied(before) or re.search(r"\b(?:i|we) (?:can|could|will|may)\s*$", before):
        return False  # 'I can't hold it myself'
    if (
        has_manner(said)
        or MARK in after
        or re.search(
            r"\b(?:(?:so|too|that|as) (?:often|long|far)|much|(?:more|further|longer|deeper) than)\b",
            after,
        )
    ):
        return False
    core = said.removesuffix(after)
    has_other = _is_asked_elsewhere(after, core, text)
    if match.re is _STATE:
        return not (has_other or MARK in text)
    is_purpose = (is_passive or match["lead"].startswith("no")) and _PURPOSE.search(before)
    if re.fullmatch(_INSTEAD, match["lead"]) or is_purpose:
        return not (has_other or MARK in text or has_manner(text))
    if _WAY.search(after):
        return False
    if _TIME.search(after) and (has_other or MARK in text):
        return False  # 'don't lift it before you hold it'
    if verb.startswith("mov"):
        earlier = text[: text.find(said)] if said in text else ""
        is_about_it = bool(_ABOUT_IT.search(before)) and not is_passive
        # 'it must not move' wants a firm grip; 'don't move, only hold it'; 'grip it and don't move'
        return not (is_about_it or has_other or words.HOLD.search(earlier) or MARK in earlier)
    if not has_other:
        return True
    if _OTHER_THING.match(after) or (is_passive and _is_of_other_thing(before)):
        return False  # 'don't take the lid, take the berry'
    if verb.startswith("taken"):
        return False  # 'hold it, do not let it be taken away'
    return not re.match(r"(?:squeez|press|pinch|clamp)", verb)  # 'pick it up without squeezing'


def _is_of_other_thing(before: str) -> bool:
    subject = _OTHER_SUBJECT.search(before)
    return subject is not None and not _OBJECT_WORD.fullmatch(subject["noun"])
