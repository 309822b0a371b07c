"""Bounds of a force that are said in an unusual order, written as plainly as the others.

'1 N must not be exceeded' becomes 'at most 1 n', '1 N >= force' becomes 'force <= 1 n', and
'not below 0.5 N or above 1 N' becomes 'not below 0.5 n or not above 1 n': the denial counts for both.
"""

from __future__ import annotations

import re

from policies.instructions.english.denials import FORBIDDEN_AFTER, NO_CASE
from policies.instructions.english.number_pattern import NumberPattern
from policies.instructions.quantities.force_units import LOOSE, NUMBER, UNIT, in_newtons, number

_ONE = rf"(?P<one>{NUMBER}(?:\s*-?\s*(?:{UNIT}|{LOOSE})\b)?(?: of (?:grip )?force\b)?)"
_NOT = rf"(?:not|never|no longer|{NO_CASE})"
_MODAL = (
    r"(?:must|may|should|shall|can|could|will|would|ought(?: to)?|is|are|be|to|has|have|needs?)"
)
_EXCEEDED = r"(?:exceeded|surpassed|topped|overstepped|overshot|outdone|bettered|passed|crossed|reached|hit|attained|gone (?:over|above|beyond|past))"
_UNDERCUT = r"(?:undercut|undershot|underrun|fallen below|gone (?:below|under))"
_WHAT = r"(?: (?:mark|limit|line|threshold|level|force))?"
_MORE = r"(?:more than|over|above|beyond|past|exceed(?:ing)?|higher than|harder than|greater than|firmer than)"
_LESS = r"(?:less than|under|below|beneath|lower than|softer than|smaller than|fewer than)"
_FORCE = r"(?:the )?(?:grip(?:ping)? )?(?:force|f|grip|pressure|it|x)\b"
_ADVERB = r"(?: \w+ly| ever| to| be| under any circumstances| at any time)*"

_SIDE = r"(?:(?:anything|any|go|going|force|a force|and|or|but|so) )*"
_NO = (
    r"(?:(?:no|nope|nah|never|nein)(?: (?:way|chance|thanks?|thank you|sir|please))?|not (?:ok\w*|allowed|a chance|today|here|with me)|absolutely not|forbidden|do not(?: you dare| even think(?: about it| of it)?)?|out of the question|forget it)\b"
    r"(?: ?[.!,;:–-]+ ?(?:(?:any(?:thing)? )?(?:less|more|below|under|above|over)(?: than that)? (?:is|would be) (?:fine|ok(?:ay)?|all right|good|no problem)|(?:it|that) (?:would|will|might|could|can)(?: \w+){1,4}))?"
)
"""'More than 1 N? No. Less is fine.'"""
_BEHIND = rf"{_ONE}{_WHAT},? (?:(?:which|that) )?(?:{_MODAL} )*{_NOT}{_ADVERB} "
_SHORT_WORDS = r"(?:(?!no\b|not\b|nor\b|never\b)\w+ ){0,2}"

_DENIED = r"\b(?:not|never|no|avoid\w*|without|nothing|refrain\w* from|stay\w* (?:away|clear) (?:from|of))\b(?! (?:hesitate|forget|fail|mind|worry|be (?:afraid|shy)|need|problem|reason|less|more)\b)"
_OR_MORE = r",? (?:or|and) (?:anything )?(?:more|above|over|higher|up|upwards?|beyond|greater|harder|firmer|stronger)\b(?! (?:than )?[\d.])"
_OR_LESS = r",? (?:or|and) (?:anything )?(?:less|under|below|lower|down|downwards?|smaller|softer|gentler|lighter)\b(?! (?:than )?[\d.])"
_THERE = r"[^.;:,#\d]{0,50}?"
_NO_AND = r"(?:(?!\band\b)[^.;:,#\d]){0,50}?"

_PLAIN = tuple((NumberPattern(pattern), plainly) for pattern, plainly in (
    (rf"(?:^|(?<=[.;!,:] )){_SIDE}{_MORE} {_ONE} ?\? ?{_NO}", r"at most \g<one>"),
    (rf"(?:^|(?<=[.;!,:] )){_SIDE}{_LESS} {_ONE} ?\? ?{_NO}", r"at least \g<one>"),
    (rf"\b(?:limits|bounds|ends|thresholds|extremes)(?: (?!not\b|never\b)\w+){{0,3}}? ?(?:are|:|=|of) (?P<low>{NUMBER}(?:\s*(?:{UNIT})\b)?) ?(?:and|to|-|–) {_ONE}", r"between \g<low> and \g<one>"),
    (rf"\bnot (?:even )?(?:an?|one|{NUMBER})\s*(?:{UNIT}) (?:above|over|beyond|more than) {_ONE}", r"at most \g<one>"),
    (rf"\b(?:can|could|will|would|do) not you\b[^.;,#\d]*?\b{_LESS} {_ONE}", r"at most \g<one>"),
    (rf"\b(?:stay|steer|keep|remain)\w* (?:well |far |right )?(?:away|clear|off|out)(?: (?:from|of))?(?: the)? {_ONE}", r"at most \g<one>"),
    (rf"{_ONE}{_WHAT} (?:should|must|is|ought to|has)(?: to)? (?:best |better )?(?:be )?(?:avoided|excluded|shunned|off the table)\b", r"at most \g<one>"),
    (rf"\b(prefer|rather have|would take) {_ONE} (?:to|over|than) {NUMBER}\s*(?:{UNIT})\b", r"\1 \g<one>"),
    (rf"\b(?:no|not|never)\b[^.;:,#\d]{{0,30}}? (?:(?:force|value|setting|grip) but|other (?:force|value|setting|grip) than|other than|except|apart from)(?: for| with| at)? {_ONE}", r"exactly \g<one>"),
    (rf"\b(?:(?:do|must|should|may) not|never) (\w+)(?: it)?(?: with| at)? not {_ONE}", r"\1 exactly \g<one>"),
    (rf"\b(?:except|other than|apart from|all but|excluding)(?: for)? {_ONE}", r"at most \g<one>"),
    (rf"({_DENIED}{_THERE} ?){_ONE}{_OR_MORE}", r"\1more than \g<one>"),
    (rf"({_DENIED}{_NO_AND} ?){_ONE}{_OR_LESS}", r"\1less than \g<one>"),
    (rf"{_ONE}{_OR_MORE} (?={FORBIDDEN_AFTER})", r"more than \g<one> "),
    (rf"{_ONE}{_OR_LESS} (?={FORBIDDEN_AFTER})", r"less than \g<one> "),
    (rf"{_BEHIND}{_EXCEEDED}\b", r"at most \g<one>"),
    (rf"{_BEHIND}{_UNDERCUT}\b", r"at least \g<one>"),
    (rf"\bwithout {_ONE}{_WHAT} (?:ever )?being {_EXCEEDED}\b", r"at most \g<one>"),
    (rf"\b(?:no|not) less (?:and|but|or),? (?:also )?(?:no|not) more than {_ONE}", r"no less than \g<one> and no more than \g<one>"),
    (rf"\b(?:no|not) more (?:and|but|or),? (?:also )?(?:no|not) less than {_ONE}", r"no less than \g<one> and no more than \g<one>"),
    (rf"\bneither (?:more nor less|less nor more) than {_ONE}", r"no less than \g<one> and no more than \g<one>"),
    (rf"{_ONE} ?(?:>=|≥|=>) ?{_FORCE}", r"force <= \g<one>"),
    (rf"{_ONE} ?> ?{_FORCE}", r"force < \g<one>"),
    (rf"{_ONE} ?(?:<=|≤|=<) ?{_FORCE}", r"force >= \g<one>"),
    (rf"{_ONE} ?< ?{_FORCE}", r"force > \g<one>"),
    (rf"(\b(?:not|never|no|nothing|avoid\w*|without)\b[^.;,#\d]*?\b{_LESS} {_ONE},? (?:or|and)) (?={_SHORT_WORDS}{_MORE} )", r"\1 not "),
    (rf"(\b(?:not|never|no|nothing|avoid\w*|without)\b[^.;,#\d]*?\b{_MORE} {_ONE},? or) (?={_SHORT_WORDS}{_LESS} )", r"\1 not "),
    (rf"{_ONE},? but (?:a (?:bit|little|touch) |slightly |rather )?(?:softer|gentler|lighter|less|lower)\b(?! than)", r"less than \g<one>"),
    (rf"{_ONE},? (?:minus|less) (?:an?|some) (?:\w+ )?(?:bit|little|hair|touch|tad|smidge\w*)\b", r"less than \g<one>"),
))  # fmt: skip

_THAN = re.compile(
    r"\b(more|less|fewer|greater|higher|lower|smaller|bigger|larger|harder|softer|firmer|gentler|tighter|lighter|stronger|weaker) (?:then|tan|thn|as|from|(?<!more )like)(?= (?:about |around |roughly |exactly )?[\d.])"
)
"""'No more then 1 N'."""


_FROM = re.compile(
    r"\b(under|below|beneath|above|over|beyond|exceed) (?:from|of|as|than|to) (?=[\d.])"
)
"""'Under from 1 N', as other languages have it."""


_NOT_MORE = re.compile(r"\b(not (?:\w+ )?(?:more|less|higher|harder|bigger)) (?=(?:about )?\.?\d)")
"""'Not more 1 N please'."""

SLIGHTLY = 1.25
"""What is slightly more than a force is at most so many times it. Our choice."""
_SLIGHTLY_MORE = NumberPattern(
    rf"(?P<before>[^.;:,#\d]*?)\b(?:an? (?:(?:wee|tiny|little|small) )*(?:bit|little|touch|tad|hair|shade|smidge\w*|fraction|whisker)|just|slightly|barely|marginally) "
    rf"(?:more than|over|above|higher than|beyond|north of|past) (?P<value>{NUMBER})\s*-?\s*(?P<unit>(?:{UNIT})\b)"
)
"""'A bit more than 1 N' asks for no 2 N."""
_LIMITS = re.compile(
    r"\b(?:not|never|no|nothing|nor|neither|without|avoid\w*|if|when\w*|once|unless|until|should|before|stop\w*|abort|soon)\b"
)


def _close_above(match: re.Match[str]) -> str:
    if _LIMITS.search(match["before"]):
        return match[0]
    top = f"{SLIGHTLY * number(match['value']):.6g}"
    return f"{match['before']}between {match['value']} and {top} {match['unit']}"


_A_FORCE = rf"(?:(?:about|around|roughly|approximately) )?{NUMBER}\s*-?\s*(?:{UNIT})\b"
_WORDED = NumberPattern(
    r"(?<!needs )(?<!need )(?<!takes )(?<!requires )(?<!wants )\b(?:an?|the|your|its|my|our|this|that) (?:(?!max|min|peak|top|upper|lower|high|low|least|most|limit|more|less|small|larg|bigg|great)\w+ ){0,2}"
    rf"(?:force|grip|squeeze|total|value|strength|pressure|load|level|figure|magnitude|amount|equivalent|sum|force value) of (?={_A_FORCE})"
)
"""'A gripping force of 0.9 N' is 0.9 N."""
_GOES_ON = r"(?=\s*(?:$|[.,;:!?()\[\]–-]|(?:at|max|maximum|tops|or|and|but|is|must|should|may|as|would|already|crush\w*|hurts?|breaks?)\b))"
_OF_FORCE = NumberPattern(
    rf"(?P<force>{NUMBER}\s*-?\s*(?:{UNIT})\b)(?: of (?:(?:the|your|its|my|our) )?(?:(?!max|min|peak|top|upper|lower|no|at)\w+ ){{0,2}}(?:force|grip|pressure|squeeze|strength)\b| (?:in )?total\b| all in all\b| overall\b|"
    r" (?:per|on each|with each|on either) (?:finger|pad|side|jaw)\b| each\b(?! (?:time|second|step|try))| or so\b|"
    rf"(?: (?:on|to) (?:it|this|that|the (?:(?:straw ?)?berr(?:y|ies)|fruit|object|thing))| there| here| right now| please){_GOES_ON}|,? i (?:think|guess|suppose|believe|reckon)\b,?)+"
)
"""'0.9 N of gripping force' is 0.9 N, and '0.9 N or so' too."""
_HARMED = r"(?:bruis|crush|squash|damag|hurt|harm|break|broken|burst|split)\w*"
_NO_MORE = NumberPattern(
    rf"(?P<force>{NUMBER}\s*-?\s*(?:{UNIT})\b)(?:\s*[,;:–—-]+\s*| )(?:(?:and|but) )?(?:"
    r"not (?:any )?more than (?:that|this)\b|nothing (?:above|beyond)(?: (?:that|it))?(?=\s*(?:$|[.,;!?]))|"
    r"not (?:a|one|1) (?:single )?(?:newton|millinewton|bit|gram|hair|tad|whit|jot) more\b|"
    rf"(?:any(?:thing)? )?more (?:would|will|might|could|may) {_HARMED}(?: it)?|(?:beyond|above|past) (?:that|this|it) it (?:(?:will|would|may|might|could) )?{_HARMED}|"
    rf"or (?:else )?it (?:(?:gets|is|will be|would be|will get|will|would) )?{_HARMED}|"
    rf"is (?:all|as much as|the most) (?:that )?(?:it|this|the (?:\w+ )?(?:berry|fruit)) (?:(?:can|will|could) )?(?:takes?|stands?|bears?|tolerates?|endures?)(?: before it (?:is )?{_HARMED})?|"
    r"is all (?:that )?(?:i|we|they|you)(?: (?:will|would|can|could|am|are|is|ever|shall))* (?:allow|permit|grant|give|tolerate|accept)(?:ed|s|ing)?\b(?: you)?(?: (?:on|for) (?:it|this|that|(?:the|this|that) \w+))?|"
    r"is as (?:far|high|hard|much|firm) as (?:you|it|we) (?:may|can|should|shall|must) (?:ever )?(?:go|press|squeeze|use|get)\b|"
    rf"is (?:(?:the point )?where|when) it {_HARMED}|\[\s*max(?:imum|\.)?\s*\])"
)
"""'0.9 N or it breaks', '0.9 N is all it can take'."""
_AFTER_BOUND = NumberPattern(
    r"(?P<bound>\b(?:most|least|than|below|under|beneath|exceed(?:s|ing)?|above|over|past|beyond|within|up to|before|max(?:imum)?|min(?:imum)?|(?:limit(?:ed)?(?: it)?|cap(?:ped)?) (?:to|of|is|at)|short of|(?:bruis|break|burst|crush|squash)\w* at|(?:allowed|cap|limit|max|ceiling):)|[<>≤≥]=?)"
    r"(?: (?:the|exactly|precisely|just|only|a mere|merely|maybe|perhaps|possibly|say|something like|the equivalent of|what (?:you|we|i) know as|an? (?!max|min)\w+(?:ed|al)))+"
    rf" (?={_A_FORCE})"
)
"""'At most a mere 0.9 N', 'below the 0.9 N'."""


_TOLD_BEFORE = NumberPattern(
    rf"(?P<told>\b(?:slip|slid|fell|drop|bruis|crush|broke|burst|squash)\w*[^.;,#\d]{{0,30}}{NUMBER}\s*-?\s*(?:{UNIT})) [-–—] "
    rf"(?={NUMBER}\s*-?\s*(?:{UNIT})\b,? (?:at most|max|tops|or (?:less|below|under)|is (?:all|the|too|as)|and (?:no|not|never)|must not|not more|no more|stay))"
)
"""'It slipped with 0.3 N - 0.9 N at most' has no range."""


_TAKEN_UP = r"(?:it|that|this|(?:that|this|the|said) (?:line|figure|value|number|mark|level|threshold|limit|force|point|ceiling|bound|floor|peak))(?=\s*(?:$|[.,;:!?)]|(?:and|or|but|when|while|whatever|at any|under any|please|today|with|at all|ever|this time)\b))"
_NOT_TO = r"(?:(?:do|must|may|should|shall|can|will|to) not|never|cannot|not to|no need to|refuse to)(?: ever| you| even)*"
_TO = r"(?:go|get|be|push|climb|rise|squeeze|grip|hold|press|stray|step|creep|move|drift|come|fall|drop|dip|sink|let it (?:go|get|fall|drop|climb|rise))(?: (?:it|any|even|far))?"
_KEEP = r"(?:stay|keep|remain|stop|hold)(?: (?:it|yourself|well|far|safely|always|just|strictly|today|clearly|(?:the|your|its) (?:\w+ )?(?:force|grip|squeeze|pressure|fingers?|gripper)))*"
_CALL = r"(?:respect|treat|take|regard|consider|see|count|call) (?:it|that|this) (?:as )?(?:an?|the|your|my|our)(?: \w+)?"
_CALLED_LATER = NumberPattern(
    rf"(?P<force>{NUMBER}\s*-?\s*(?:{UNIT})\b)[.;:!?,–—-]* (?:(?:so|and|but|please|just|you|now|then)\b,? ?)*{_CALL} (?:(?P<most>ceiling|limit|maximum|max|cap|roof)|floor|minimum|least|lower limit)\b"
)
"""'0.9 N. Treat it as a ceiling.'"""
_BOUND_LATER = NumberPattern(
    r"(?:^|(?<=[.;:!?,] ))(?P<told>(?:i|we|he|she|they|you|our|my|his|her|the|its?|this|that|here|there|yesterday|somebody|someone|measured|found|remember)\b[^.;:!?\d]*? )"
    rf"(?P<force>{NUMBER}\s*-?\s*(?:{UNIT})\b)(?P<more>[^.;:!?\d]{{0,40}}?)[.;:!?,–—-]+\s*"
    r"(?:(?:so|and|but|please|just|you|now|then|therefore|today|i say|robot)\b,? ?)*(?:"
    rf"(?P<most>{_NOT_TO} (?:{_TO} (?:above|over|beyond|past|higher than|harder than|more than|across)|cross|exceed|pass|surpass|overstep|breach|overshoot) {_TAKEN_UP}|"
    rf"{_KEEP} (?:under|below|beneath|underneath|short of|clear of|away from|on this side of) {_TAKEN_UP})|"
    rf"(?P<least>{_NOT_TO} (?:{_TO} (?:under|below|beneath|lower than|softer than|less than)|undercut|undershoot) {_TAKEN_UP}|"
    rf"{_KEEP} (?:above|over) {_TAKEN_UP}))"
)
"""'I measured 0.65 N. Don't cross it.': a number that is told, and made a bound by the clause behind it."""
_ASKS = re.compile(
    r"\b(?:use|using|hold|grip|grasp|squeeze|lift|pick|apply|want|need|must|should|shall|may)\b"
)


def _as_bound(match: re.Match[str]) -> str:
    if _ASKS.search(match.groupdict().get("told", "")):
        return match[0]
    return f"{'at most' if match['most'] else 'at least'} {match['force']}"


_WITH_LESS = NumberPattern(
    rf"(?P<force>{NUMBER}\s*-?\s*(?:{UNIT})\b)(?P<more>[^.;:#\d]{{0,50}}?)[,;:.–—-]+ (?:but )?with (?P<side>less|more)(?: than that)?,? (?:it|that|this) (?:is|does|do|will|would|may|might|can|could) not\b[^.;#\d]*"
)
"""'With 1.6 N it is safe, with less it is not.'"""
_NOT_BUT = NumberPattern(
    rf"\b(?P<is>is|be|was|means|mean) not {NUMBER}\s*-?\s*(?:{UNIT})\b,? (?:but|it is|(?:and )?instead) (?:rather )?(?=(?:about |around )?{NUMBER}\s*-?\s*(?:{UNIT})\b)"
)
"""'The limit is not 1.9 N but 0.9 N.'"""
_STRAY = NumberPattern(
    rf"(?P<force>{NUMBER}\s*-?\s*(?:{UNIT})\b)[,;]? (?:and |but )?(?:you (?:may|can|might) |it (?:may|can) )?(?:stray|deviate|vary|wander|drift|differ|move|go)s? (?:from (?:it|that) )?(?:by )?(?:up to |at most )?(?P<by>{NUMBER}\s*-?\s*(?:{UNIT})\b) (?:in )?(?:either|both|any) (?:direction|way|side)s?(?:,? (?:but |and )?(?:no|not any) (?:further|more|farther))?"
)
"""'1 N, and you may stray by 0.5 N in either direction'."""
_NO_LOOSER = NumberPattern(
    r"\b(?:do|must|should|may|can|will)? ?(?:not|never)(?: (?:ever|even|let it))* (?:loosen|relax|slacken|soften|weaken|ease(?: off| up)?|back off|let (?:go|up)|give way)(?: (?:it|off|up|the \w+|your \w+))* (?:past|beyond|further than) "
    rf"(?={NUMBER}\s*-?\s*(?:{UNIT})\b)"
)
"""'Do not loosen past 0.6 N.'"""


def _with_less(match: re.Match[str]) -> str:
    bound = "least" if match["side"] == "less" else "most"
    return f"at {bound} {match['force']}{match['more']}"


_ENTRY = re.compile(
    r"(?:(?<=^)|(?<=[;,.?] ))(?:(?:object|fruit|berry|the|its) )?(?:weight|mass|width|size|diameter|length|temperature|colou?r|origin|variety|lot|batch|id|date|time) ?[:=?] ?(?:about )?[^;,.?]*(?:\.\d+[^;,.?]*)?(?:[;,.] ?|$)"
)
"""'max: 1 N; weight: 22 g': an entry of a list that is about the object."""


def with_bounds_at_forces(text: str) -> str:
    """Leave out of a plain text what stands between a force and its bound and changes neither.

    Args:
        text: Plain text, its numbers in digits.
    """
    if "max" in text or "min" in text or "force" in text:
        text = _ENTRY.sub("", text)
    text = _OF_FORCE.sub(r"\g<force>", _WORDED.sub("", text))
    text = _TOLD_BEFORE.sub(r"\g<told>. ", text)
    text = _CALLED_LATER.sub(_as_bound, _BOUND_LATER.sub(_as_bound, text))
    text = _NOT_BUT.sub(r"\g<is> ", _STRAY.sub(r"\g<force> ± \g<by>", text))
    text = _WITH_LESS.sub(_with_less, text)
    text = _NO_LOOSER.sub(" hold it with at least ", _NO_MORE.sub(r"\g<force> at most", text))
    return _AFTER_BOUND.sub(r"\g<bound> ", text)


_LOWER_UPPER = NumberPattern(
    rf"\b(?:lower|low|bottom)(?: end| limit| bound)?[:=]? (?P<low>{NUMBER})\s*(?P<u>(?:{UNIT})\b)?,? (?:and )?(?:upper|high|top)(?: end| limit| bound)?[:=]? (?P<high>{NUMBER})\s*(?P<v>(?:{UNIT})\b)"
)
"""'Lower 0.6 N, upper 1.8 N'."""


def _both_ends(match: re.Match[str]) -> str:
    low = in_newtons(match["low"], match["u"] or match["v"])
    if low > in_newtons(match["high"], match["v"]):
        return match[0]
    return f"between {match['low']} {match['u'] or match['v']} and {match['high']} {match['v']}"


def with_plain_bounds(text: str) -> str:
    """Write each bound of a plain text, its numbers in digits, with its words before its force."""
    text = _NOT_MORE.sub(r"\1 than ", text)
    text = _FROM.sub(r"\1 ", _THAN.sub(r"\1 than", text))
    text = _LOWER_UPPER.sub(_both_ends, _SLIGHTLY_MORE.sub(_close_above, text))
    for pattern, plainly in _PLAIN:
        text = pattern.sub(plainly, text)
    return text
