"""Questions how much of the pad lies bare, or is touched, without or with a number.

    Over half of the sensing area remains bare, doesn't it?     calculate 100 - area_percent > 50.
    Does more of the pad lie idle than is occupied?             calculate area_percent < 50.
    Is most of it covered?                                      calculate area_percent > 50.
    Is it mostly idle or mostly in use?                         calculate 'in use' if ...
    What part of the gel lies idle?                             amount free_area %.

Every word of a question must be known. Not here: 'how much stays free' and 'is the area above 5 %'
(``tacgrasp.lessons.dialogue.families.amounts``).
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

from tacgrasp.lessons.dialogue.conditions import number_text
from tacgrasp.lessons.dialogue.plainer import AUXILIARY

_FREE = (
    r"(?:bare|idle|free|uncovered|untouched|unused|vacant|empty|exposed|unoccupied|unloaded|"
    r"unpressed|undisturbed|unengaged|virgin|blank|clear|naked|open|spare|"
    r"(?:not|without|sees? no|see no|has no|have no|feels? no|makes? no|make no)(?: being)? "
    r"(?:touch(?:ed|ing anything)|covered|pressed|occupied|used|in contact|in use|"
    r"contact(?:ed)?|loaded|busy)|(?:touch|feel|see|meet)(?:ing|es|ed by|s)? nothing|out of "
    r"(?:contact|use|work)|doing nothing|"
    r"out of touch|to spare|contact free|"
    r"(?:free|clear|bare|empty) of (?:contact|touch|anything))"
)
_TOUCHED = (
    r"(?:covered|touched|occupied|pressed(?: on)?|used|in contact|in touch|in use|loaded|busy|"
    r"engaged|taken(?: up)?|"
    r"filled|contacted|under load|under (?:the )?(?:object|contact|load|pressure)|at work|"
    r"(?:touch|cover|press)ing(?: (?:something|anything|the object))?)"
)
_PAD = (
    r"(?:the |our |your |my |its |this |that )?(?:whole |entire |soft |squishy |rubber |total |"
    r"jelly )*"
    r"(?:(?:sensor|gel|touch|tactile) pad|pad|gel|sensor|sensing (?:area|surface|face|field|"
    r"region)|pad area|"
    r"(?:pad|gel|sensor)(?:'s)? (?:area|surface|face)|active area|tactile (?:area|surface)|"
    r"finger(?:tip)?|"
    r"surface|skin|rubber|cushion|jelly|thing|face|it)"
)
_SHARES: Mapping[str, float] = {
    r"(?:a |one |the )?half": 50.0, r"(?:a |one )?third": 100 / 3, r"two thirds": 200 / 3,
    r"(?:a |one )?quarter": 25.0, r"three quarters": 75.0, r"(?:a |one )?fifth": 20.0,
    r"(?:a |one "
    r")?tenth": 10.0, r"nine tenths": 90.0, r"four fifths": 80.0, r"(?:an? |one )?eighth": 12.5,
    r"(?:a |one )?twentieth": 5.0,
}  # fmt: skip
_SHARE = rf"(?P<share>#(?: percent| per cent)?|{'|'.join(_SHARES)})"
_SIGNS = {
    ">=": r"at least|no less than|not less than|a good|fully",
    "<=": r"at most|no more than|not more than|up to",
    ">": r"more than|over|above|upwards of|in excess of|greater than|better than",
    "<": r"less than|under|below|fewer than|smaller than|not even|not quite",
}
_SIGN = "|".join(rf"(?P<s{place}>{said})" for place, said in enumerate(_SIGNS.values()))
_STATE = rf"(?:(?P<free>{_FREE})|(?P<touched>{_TOUCHED}))"
_OTHER_STATE = rf"(?:(?P<free2>{_FREE})|(?P<touched2>{_TOUCHED}))"
_MAINLY = r"mostly|mainly|largely|for the most part|predominantly|chiefly|more than half"
_IS = (
    r"(?:(?:that )?(?:is|are|was|be|being|been|has been|have been|remains?|remaining|lies?|lying|"
    r"stays?|sits?|left|"
    r"goes|stands?|still|currently|now|actually|presently|to be|gets?|getting|just|sitting|"
    r"standing|there|lie|sit|go|keeps?) )*"
)
_AUX = (
    r"(?:(?:is|are|does|do|has|was|did|would|will|can|could) )?"
    r"(?:it (?:true|so|correct|fair to say) (?:that )?)?"
)
_OPENING = re.compile(
    r"^(?:(?:can|could|may|might) (?:it|i|we) (?:be said|say|claim|assume)(?: that)? |"
    r"(?:would|do) you (?:say|think|agree)(?: that)? |is it (?:true|so|correct|right|fair to say) "
    r"(?:that )?|"
    r"am i right (?:in thinking |to think |that )*|(?:i|we) (?:think|reckon|guess|believe|suppose|"
    r"take it|bet)(?: that)? |"
    r"(?:so|well|and|ok|okay|then|hey|please) )+"
)
_TAG = re.compile(
    rf"(?: (?:{AUXILIARY} not (?:it|they|we|that)|right|correct|yes|no|true|then|now|or not|please|"
    r"thanks|is it(?: not)?|does it(?: not)?|"
    r"is that (?:so|right|correct|true)|am i right|eh|innit|yes or no|true or false|right or wrong|"
    r"at the moment|right now|"
    r"currently|do you think|would you say|by the (?:object|contact|touch|thing)|by (?:it|anything|"
    r"this)))+$"
)
_MOST = (
    r"(?:(?P<most>most|the majority|a majority|(?:the )?(?:greater|larger|bigger|better|main|"
    r"major) (?:part|share|"
    r"portion|half)|the bulk|the lion's share)|(?P<least>a minority|the minority|(?:the "
    r")?(?:lesser|smaller|minor) "
    r"(?:part|share|portion|half)))"
)
_COMPARED = re.compile(
    rf"{_AUX}(?:there )?(?:(?P<more>more|a (?:larger|greater|bigger) part)|(?P<less>less|a smaller "
    r"part)) "
    rf"(?:of {_PAD} {_IS}{_STATE}|{_STATE.replace('>', '5>')} {_PAD}) than {_IS}(?:it is |of it is "
    r")?"
    rf"{_OTHER_STATE}(?: {_PAD})?"
)
_OUTWEIGHS = re.compile(
    rf"{_AUX}(?:the )?{_STATE} (?:area|part|portion|share|surface|zone|region)(?: of {_PAD})? "
    r"(?:(?P<less>(?:is |be )?(?:smaller|less) than)|outweighs?|exceeds?|"
    r"(?:is |be )?(?:larger|bigger|greater|more) than|larger than|bigger than) (?:the )?"
    rf"{_OTHER_STATE}(?: (?:one|area|part|portion|share|surface|zone|region))?"
)
_MOSTLY = re.compile(
    rf"{_AUX}(?:{_MOST} of {_PAD} {_IS}{_STATE}|{_PAD} {_IS}(?:(?:{_MAINLY}) {_OTHER_STATE}|"
    rf"more {_OTHER_STATE.replace('2>', '3>')} than (?:not|{_STATE.replace('>', '4>')})))"
)
_COUNTED = re.compile(
    rf"{_AUX}(?:(?:{_SIGN}) {_SHARE}|{_SHARE.replace('share', 'share2')} (?:or|and) "
    rf"(?:(?P<up>more|over|above|better)|less|under|fewer)) (?:of )?(?:{_PAD} )?{_IS}{_STATE}"
)
_COVERS = re.compile(
    rf"{_AUX}(?:it|this|that|we|you|(?:the |our |this |my )?\w+) (?:touch|cover|occupy|fill|take "
    r"up|press on|use|"
    rf"touching|covering|occupying|filling|taking up|pressing on|using|touches|covers|occupies|"
    r"fills|takes up|uses) "
    rf"(?:(?:{_SIGN}) {_SHARE}|{_MOST}) (?:of )?{_PAD}"
)
_EITHER = re.compile(
    rf"(?:.*\b)?{_PAD} {_IS}(?:(?:more|mostly|mainly|rather|largely|chiefly) )?{_STATE} or "
    rf"(?:is it )?(?:(?:more|mostly|mainly|rather|largely|chiefly) )?"
    rf"{_OTHER_STATE}"
)
_MORE_OR_LESS = re.compile(r"\b(?:more|mostly|mainly|rather|largely|chiefly|predominantly)\b")
"""Without such a word 'touched or free' asks whether anything touches."""

_PART_OR_PART = re.compile(
    rf"(?P<before>.*?)\b(?:a |the )?(?:(?P<one>minority|smaller part|lesser part)|(?P<two>majority|"
    r"larger part|"
    rf"greater part|bigger part))(?: of {_PAD})?(?: (?:being |is |that is )?{_STATE})? or "
    r"(?:rather )?(?:a |the )?"
    rf"(?(one)(?P<two2>majority|larger part|greater part|bigger part|larger one)|"
    rf"(?P<one2>minority|smaller part|lesser part|smaller one))(?: of {_PAD})?(?: (?:being |is |"
    r"that is )?"
    rf"{_OTHER_STATE})?"
)
_BETTING = re.compile(
    r"(?:would|do|should|can|is|are|does|you|i|we|it|rather|sooner|bet|on|say|put|money|your|my|"
    r"that|think|"
    r"what|which|so|if|had|to|a|the|pad|gel|sensor|there|here|covered|touched| )*"
)
_HOW_MANY_MM2 = re.compile(
    rf"(?:(?:tell|give) me )?how many (?:mm2|square millimetres)(?: of {_PAD})?(?: of (?:the )?#)? "
    rf"{_IS}(?P<free>{_FREE})"
)
_HOW_MUCH = re.compile(
    rf"(?:(?:tell|give) me )?(?:how much|how large a (?:part|share|percentage|fraction|portion)|"
    r"how many percent|"
    rf"(?:what|which) (?:part|share|percent|percentage|fraction|portion|proportion|area)) (?:of "
    rf")?{_PAD} "
    rf"{_IS}(?P<free>{_FREE})(?: in (?:percent|mm2|square millimetres|terms of area|per cent))?"
)


def bare_query(words: str, numbers: Sequence[float]) -> str:
    """The query of a question how much of the pad is bare; '' of any other question.

    Args:
        words: The question in plain words.
        numbers: Its numbers.
    """
    words = _TAG.sub("", _OPENING.sub("", words))
    if _HOW_MANY_MM2.fullmatch(words):
        return "amount free_area mm²."
    if _HOW_MUCH.fullmatch(words):
        return "amount free_area %."
    if found := _COMPARED.fullmatch(words):
        is_free = bool(found["free"] or found["free5"])
        if is_free == bool(found["free2"]):
            return ""
        return _half(is_free=is_free == bool(found["more"]))
    if found := _OUTWEIGHS.fullmatch(words):
        if bool(found["free"]) == bool(found["free2"]):
            return ""
        return _half(is_free=bool(found["free"]) != bool(found["less"]))
    if found := _MOSTLY.fullmatch(words):
        is_free = bool(found["free"] or found["free2"] or found["free3"])
        return _half(is_free=is_free == (not found["least"]))
    if found := _COUNTED.fullmatch(words):
        return _counted(found, numbers, is_free=bool(found["free"]))
    if found := _COVERS.fullmatch(words):
        if found["share"]:
            return _counted(found, numbers, is_free=False)
        return _half(is_free=bool(found["least"]))
    if found := _EITHER.fullmatch(words):
        free, touched = found["free"] or found["free2"], found["touched"] or found["touched2"]
        if free and touched and _MORE_OR_LESS.search(words):
            return f"calculate {touched!r} if area_percent > 50 else {free!r}."
    return _parts(words)


def _half(*, is_free: bool) -> str:
    """The query whether the free part is the larger one, or the touched one."""
    return f"calculate area_percent {'<' if is_free else '>'} 50."


def _counted(found: re.Match[str], numbers: Sequence[float], *, is_free: bool) -> str:
    told = found.groupdict()
    said = told["share"] or told["share2"]
    if said.startswith("#"):
        if len(numbers) != 1:
            return ""
        share = numbers[0]
    else:
        share = next(value for name, value in _SHARES.items() if re.fullmatch(name, said))
    named = (sign for place, sign in enumerate(_SIGNS) if told[f"s{place}"])
    sign = next(named, ">=" if told.get("up") else "<=")
    part = "100 - area_percent" if is_free else "area_percent"
    return f"calculate {part} {sign} {number_text(share)}."


def _parts(words: str) -> str:
    """A minority or a majority of the pad, in the question's own words."""
    found = _PART_OR_PART.fullmatch(words)
    if found is None or _BETTING.fullmatch(f"{found['before']}") is None:
        return ""
    less, more = found["one"] or found["one2"], found["two"] or found["two2"]
    is_free = found["free"] or found["free2"]
    sign = "<" if is_free else ">"
    return f"calculate {more!r} if area_percent {sign} 50 else {less!r}."
