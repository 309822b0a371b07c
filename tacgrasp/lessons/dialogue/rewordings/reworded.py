"""Constructions that have a plainer one of the same meaning, which other readers know.

    Is it not unsafe to lift?                            Is it safe to lift?
    Setting aside the shape, where does it touch?        where does it touch?
    Reject if deeper than 0.8 mm. Reject or accept?      Say 'reject' if ..., otherwise 'accept'.
    Shallow or deep? I'd call anything under 1 mm shallow.
    Tighten or loosen?                                   To get into the band, tighten or loosen?

Not here: phrases inside a question (``phrases``), address, thanks and tags
(``tacgrasp.lessons.dialogue.plainer``), what tells of circumstances
(``tacgrasp.lessons.dialogue.clauses.speech``).
"""

from __future__ import annotations

import re
from collections.abc import Callable

from cltp.texts.captions import with_article
from tacgrasp.lessons.dialogue.plainer import AUXILIARY
from tacgrasp.lessons.dialogue.quantities import measured_by
from tacgrasp.lessons.dialogue.rewordings.moved import with_parts_in_place
from tacgrasp.lessons.dialogue.rewordings.phrases import with_plain_phrases
from tacgrasp.lessons.dialogue.rewordings.recast import recast
from tacgrasp.lessons.dialogue.rewordings.supposed import supposed

_UNFELT_SIGNS = (
    r"(?!.*\b(?:signs?|directions?|units?|numbers?|figures?|digits|decimals?|left|right|side\w*|"
    r"way|which|whether|minus)\b)"
)
_ASIDE = (
    r"(?:(?:setting|putting|leaving|laying) (?P<a>[^,:;?]+?) aside|"
    r"(?:setting|putting|leaving|laying) aside (?P<b>[^,:;?]+?)|"
    r"(?:ignoring|disregarding|forgetting(?: about)?|regardless of|apart from) (?P<d>[^:;?]+?)"
    rf"(?=, (?:how|what|where|which|{AUXILIARY})\b)|"
    r"(?:i am|i['’]m|we are|we['’]re|this is) (?:not|n['’]t) (?:asking|interested|after|enquiring|"
    r"talking|about)(?: (?:about|in|for|after))? (?P<c>[^,:;?.]+?))"
)
_LEFT_OUT = re.compile(rf"{_ASIDE}[,:;.–—-]+ *(?:but |instead,? )?(?P<rest>\S.*)", re.I | re.S)
_ASKING = re.compile(r"(?:i am|i['’]m|we are|we['’]re) asking (?:about |for |you )?", re.I)
_SAFE = re.compile(
    rf"^(?P<head>{AUXILIARY} (?:[a-z]+ ){{1,3}}?(?:be )?)not (?:at all |in any way |too |very )?"
    r"(?:unsafe|dangerous|risky|hazardous)\b(?!.*, )",
    re.I,
)
_NOT_OFF = re.compile(
    rf"^(?P<head>{AUXILIARY} (?:[a-z]+ ){{1,3}}?(?:be )?)not un(?P<word>touched|covered|loaded)\b"
    r"(?!.*, )",
    re.I,
)
_DENIES = re.compile(
    r"^(?:do|would|will|can|could) (?:you|we|one|i) (?:deny|dispute|rule out) that\b", re.I
)
_NEITHER = re.compile(
    r"(?:(?P<aux>does|do|did|has|have) (?P<subject>(?:the |our )?\w+) )?neither (?P<verb>"
    r"(?:fall|drop|go|lie|sit|sink|stay|fallen|dropped|gone)\w* (?P<one>below|above|under|over)|"
    r"(?:exceed|surpass|pass|undercut|undershoot|overshoot)\w*) nor (?:does it |has it )?"
    r"(?P<other>(?:rise|go|climb|lie|sit|stay|fall|drop|risen|gone)\w* (?:above|below|over|under)|"
    r"(?:exceed|surpass|pass|undercut|undershoot|overshoot)\w*)\b",
    re.I,
)
_WHICH_TOO = re.compile(
    r"^(?=.*\b(?:edges?|borders?|sides?|rims?|cut|clipped|run)\b)[^?]{3,60}\?\s*"
    r"(?:(?:and|if so|so)[,]? )*"
    r"(?:which|what)(?: (?:ones?|edges?|sides?|borders?))?[?.! ]*$",
    re.I,
)
_TELL_APART = re.compile(
    r".*\b(?P<a>an? [a-z]+) (?:from|or|and) (?P<b>an? [a-z]+)\b.*\bwhich of (?:the two|"
    r"these(?: two)?|them|those(?: two)?) (?:is it|it is|do you (?:feel|have|hold))\b(?P<rest>.*)",
    re.I | re.S,
)
_THAT_NUMBER = re.compile(
    r"[^?]*?(?<![\w.,])(?P<number>\d+(?:[.,]\d+)? ?[a-zµ%²]+)[^?\d]*[.;:!–—-] +"
    r"(?:and |so |but )?(?P<asks>(?:are|is|do|does|am|have|has|would|will)\b[^?.;:]*"
    r"\b(?:than|above|over|below|under|beyond|past|exceed(?:ing)?)) (?:that|it|this)"
    r"(?P<rest>[?.! ]*)$",
    re.I,
)
"""'A grape bursts at 5 N. Are you pressing harder than that?'"""
_WHICH_ONE = re.compile(
    r"[^?]*\b(?P<a>an? [a-z]+|(?<=between )[a-z]+) (?:or|and) (?P<b>(?:an? )?[a-z]+)[.;:,!–—-]+ +"
    r"(?:so )?which (?:one |of (?:them|the two) )?(?:is it|did (?:you|we|i) (?:pick up|get|grab|"
    r"take|choose)|(?:do|have) you (?:feel|have|hold|got|picked up))\b[?.! ]*",
    re.I,
)
"""'There is a cube and a sphere; which one did you pick up?'"""
_CALLED = re.compile(
    r"(?P<asks>.*\b(?P<a>[a-z]+) or (?P<b>[a-z]+)\b[^?]*)\?\s*(?:for (?:me|us),? )?(?:(?:i|we|"
    r"they)(?:['’]d| would)? (?:call|count|consider|treat|regard|class)(?: as)? )?(?:anything|"
    r"everything|all|whatever(?:['’]s| is)?) (?P<bound>(?:under|over|above|below|beyond|up to|"
    r"less than|more than|deeper than|past) [^?]+?) (?:(?:is|counts as|means|as) )?(?:an? )?"
    r"(?P<same>[a-z]+)[.! ]*$",
    re.I | re.S,
)
_GRADED = re.compile(
    r"(?:spec: |rule: )?(?P<a>[a-z]+) (?:if|when) (?P<if>[^?]+?)[.;,:–—-]+ (?:so[,:]? )?"
    r"(?P<one>[a-z]+) or (?P<two>[a-z]+)[?.! ]*$",
    re.I,
)
_BOUNDED = re.compile(
    r"(?:anything|everything|all) (?P<bound>(?:over|above|beyond|past|under|below|more than|"
    r"less than|deeper than) [\d.,]+ ?(?P<unit>[a-zµ%²]+)) (?:is|counts as|means|gets|must be) "
    r"(?:an? )?(?P<a>[a-z]+)[.;,:–—-]+ (?:so[,:]? )?(?:(?:is (?:it|this)) )?(?:an? )?"
    r"(?P<one>[a-z]+) or (?:an? )?(?P<two>[a-z]+)[?.! ]*$",
    re.I,
)
_FROM_THAT = re.compile(
    r"[^?]*?(?<![\w.,])(?P<number>\d+(?:[.,]\d+)? ?(?P<unit>[a-zµ%²]+))[^?\d]*[.;:!–—-] +"
    r"(?:and |so )?how far (?:(?:off|away) )?(?:is|are) (?:this(?: one)?|it|we|that) (?:off |"
    r"away )?from (?:that|it|there)[?.! ]*$",
    re.I,
)
"""'My last one read 2.3 N. How far off is this one from that?'"""

_FORBIDDEN = re.compile(
    r"(?=[^?]*\b(?:never|not|nothing|no more|don['’]t|mustn['’]t)\b)[^?]*\b(?:past|over|above|"
    r"beyond|exceed\w*|more than) (?P<number>\d+(?:[.,]\d+)? ?(?P<unit>[a-zµ%²]+))[^?]*"
    r"[.;,:–—-]+ (?:have|am|are|did|do) (?:i|we|you)[?.! ]*",
    re.I,
)
"""'The card says never past 2.5 N. Have I?'"""

_WANTS_TO_KNOW = re.compile(
    r"(?P<before>.+[,;.!–—-]) *(?:and |but |so |now )*(?:i|we|my \w+|the \w+)(?:['’]d)? "
    r"(?:just |only |really |merely )*(?:want|wants|need|needs|would like|like|would love|have|"
    r"has) to (?:know|hear|be told|find out|learn) "
    r"(?P<asks>(?:if|whether|how|what|where|which)\b.*)",
    re.I | re.S,
)
_BEARS = re.compile(
    r"\d ?(?:[mµk]?n|[mcµ]m|k?g|%|percent|newtons?|grams?|microns?|millimet\w+)\b|"
    r"\b(?:if|unless|suppose|supposing|imagine|assum\w+|force|depth|band|limit|mass|weighs?|grip|"
    r"squeeze|instead)\b|\?",
    re.I,
)
"""What bears on a question behind it, in a clause of circumstances."""

_MORE = (
    r"(?:tighten|(?:squeeze|grip|press) (?:more|harder)|clamp (?:down|harder)|harder|firmer|"
    r"tighter|more(?: (?:force|pressure|grip|squeeze))?|increase)"
)
_LESS = (
    r"(?:loosen|ease off|relax|slacken|(?:squeeze|grip|press) less|softer|gentler|looser|"
    r"less(?: (?:force|pressure|grip|squeeze))?|decrease|reduce|release)"
)
_KEPT = r"(?:neither|hold|stay|keep|leave it|fine|ok|okay|just right|enough|do nothing|as it is)"
_LEAD = (
    r"(?:should|shall|must|do|does|would|will|can) (?:i|we|it|you|the (?:grip|gripper|robot|"
    r"hand))(?: (?:now|rather|have to|need to|need|want|be))*|what do (?:i|we) do:?|"
    r"do you (?:want|need) (?:me|us) to|am i to|are we to|squeeze|grip|press"
)
_TO_DO = re.compile(
    rf"(?:(?:so|now|ok|okay|right|well)[,:]? )*(?P<lead>{_LEAD})? ?(?P<one>{_MORE}|{_LESS})"
    rf"(?: (?:it|the grip|up|now))?(?:,|,? or) (?:to |be )?(?P<two>{_MORE}|{_LESS})"
    r"(?: (?:it|the grip|up|now))?(?:,? (?:boss|please|now|then|here|"
    r"or (?:is (?:it|that) |am i |are we |be |to )?"
    rf"(?P<kept>{_KEPT})))*[?.! ]*$",
    re.I,
)
_IS_MORE = re.compile(rf"{_MORE}$", re.I)
_COMPARATIVE = re.compile(r"(?:harder|firmer|tighter|more|softer|gentler|looser|less)$", re.I)


def reworded(question: str) -> str:
    """A question in a plainer construction of the same meaning; '' where it has none here."""
    text = " ".join(question.split())
    for reader in _READERS:
        if (said := reader(text)) and said != text:
            return said
    return ""


def _affirmed(text: str) -> str:
    """What two denials affirm: 'not unsafe' is safe, 'deny that' asks whether it is false."""
    text = _SAFE.sub(r"\g<head>safe", text)
    text = _NOT_OFF.sub(r"\g<head>\g<word>", text)
    return _DENIES.sub("is it false that", text)


def _neither(text: str) -> str:
    """'Neither falls below nor exceeds' is 'is neither below nor above'."""
    if (found := _NEITHER.search(text)) is None:
        return ""
    sides = {_side(found["verb"]), _side(found["other"])}
    if sides != {"below", "above"}:
        return ""
    head = f"is {found['subject']} " if found["aux"] else "is "
    return f"{text[: found.start()]}{head}neither below nor above{text[found.end() :]}"


def _side(verb: str) -> str:
    return "below" if re.search(r"below|under", verb, re.I) else "above"


def _without_aside(text: str) -> str:
    """A question without what it does not want to know."""
    if (found := _LEFT_OUT.fullmatch(text)) is None:
        return ""
    left = found["a"] or found["b"] or found["c"] or found["d"]
    if not re.match(_UNFELT_SIGNS, left, re.I):
        return ""
    return _ASKING.sub("tell me ", found["rest"], count=1)


def _wanted(text: str) -> str:
    """What somebody wants to know, without the circumstances that are told first."""
    found = _WANTS_TO_KNOW.fullmatch(text)
    if found is None or _BEARS.search(found["before"]):
        return ""
    return f"tell me {found['asks']}"


def _told_apart(text: str) -> str:
    found = _TELL_APART.fullmatch(text)
    if found is None:
        return ""
    either = re.search(r"\bor (?:is it )?(?:neither|none|something else)\b", found["rest"], re.I)
    return (
        f"Is it {found['a']}, {found['b']}, {either[0]}?"
        if either
        else (f"Is it {found['a']} or {found['b']}?")
    )


def _which_one(text: str) -> str:
    found = _WHICH_ONE.fullmatch(text)
    if found is None:
        return ""
    one, other = (name if " " in name else with_article(name) for name in found.group("a", "b"))
    return f"Is it {one} or {other}?"


def _called(text: str) -> str:
    """A choice between two words of which one is said to be whatever is under a number."""
    found = _CALLED.fullmatch(text)
    if found is None or found["same"].lower() not in (found["a"].lower(), found["b"].lower()):
        return ""
    return f"Is it {found['a']} or {found['b']}, where {found['same']} is {found['bound']}?"


def _graded(text: str) -> str:
    """A choice between two words of which one is to be said under a condition."""
    found = _GRADED.fullmatch(text)
    bounded = None if found else _BOUNDED.fullmatch(text)
    if (told := found or bounded) is None:
        return ""
    words = (told["one"].lower(), told["two"].lower())
    if (first := told["a"].lower()) not in words:
        return ""
    condition = found["if"] if found else _of_measure(told["bound"], told["unit"])
    if not condition:
        return ""
    other = words[1 - words.index(first)]
    return f"Say '{first}' if {condition}, otherwise '{other}'."


def _of_measure(bound: str, unit: str) -> str:
    """A bound with the quantity that its unit measures; '' of other units."""
    what = measured_by(unit)
    return f"{what} is {bound}" if what else ""


def _from_that(text: str) -> str:
    """How far what is felt is from the number told before."""
    found = _FROM_THAT.fullmatch(text)
    what = measured_by(found["unit"]) if found else ""
    return f"How far is {what} from {found['number']}?" if found and what else ""


def _than_that(text: str) -> str:
    """A comparison with the number told before."""
    found = _THAT_NUMBER.fullmatch(text)
    return f"{found['asks']} {found['number']}{found['rest']}" if found else ""


def _forbidden(text: str) -> str:
    """Whether what is felt is past the number that is forbidden."""
    found = _FORBIDDEN.fullmatch(text)
    what = measured_by(found["unit"]) if found else ""
    return f"Is {what} over {found['number']}?" if found and what else ""


def _which_too(text: str) -> str:
    return "Which edges cut it?" if _WHICH_TOO.fullmatch(text) else ""


def _to_do(text: str) -> str:
    """More or less grip, to get into the band where nothing else is named."""
    found = _TO_DO.fullmatch(text)
    if found is None or bool(_IS_MORE.match(found["one"])) == bool(_IS_MORE.match(found["two"])):
        return ""
    if not found["lead"] and _COMPARATIVE.match(found["one"]):
        return ""
    return f"To get into the band, {found['one']}, {found['two']} or {found['kept'] or 'neither'}?"


_READERS: tuple[Callable[[str], str], ...] = (
    supposed, _affirmed, _neither, _without_aside, _told_apart, _which_one, _called, _graded, _forbidden,
    _from_that, _than_that, _which_too, _to_do, recast, with_parts_in_place,
    with_plain_phrases, _wanted,
)  # fmt: skip
