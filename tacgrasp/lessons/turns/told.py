"""What a person tells in a dialogue: the object's mass, the force band, the limit.

    The object weighs 50 g.
    If the band is 1 to 2 N, is it safe to lift?
    Suppose it weighs 70 g. How many newtons are missing?

Not here: a mass or bound that a question compares with what is felt, which the grammar reads.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, replace

from tacgrasp.lessons.dialogue.meaning import Amount, Meaning, Several, names_of
from tacgrasp.lessons.dialogue.plainer import AUXILIARY, with_plain_numbers
from tacgrasp.lessons.dialogue.scene import AskedScene, band_contract
from tacgrasp.lessons.turns.units import dimension_of, in_own_unit

_N = r"(?P<{}>\d+(?:[.,]\d+)?)"
_UNIT = r"(?P<{}>[a-zA-Zµ]+)"
_IF = (
    r"(?P<if>(?:(?:if|suppose|supposing|assuming|assume|say|given(?: that)?|let us say|and|what)"
    r"[,:]? )*)(?:(?:note|ok|no|sorry|i mean|i meant|actually|correction|so|now|by the way)"
    r"[,:]? )*"
)
_THING = r"(?:it|this|that|(?:the|my|our|this) (?!limit\b|band\b|force\b)[a-z]+)"
_TOLD = re.compile(
    rf"{_IF}(?:{_THING} ?(?:weighs|weighed|is|was|'s|has a mass of) (?:about |only |actually "
    rf")?{_N.format('mass')} ?{_UNIT.format('mass_unit')}(?:,? not [^,.?]+)?|(?:(?:i|we) (?:do "
    rf"not|don['’]?t|must not|never) (?:want|allow|accept|need) (?:it |us )?(?:to (?:get|see|"
    rf"have) )?(?:more than|over|above|anything over)|no more than|at most|(?:(?:the|my|our|a) "
    rf")?(?:(?:new|hard|force|upper|maximum|max) )*(?:limit|maximum|max|cap)(?: (?:from|of|by|"
    rf"for) (?:the|my|our) \w+)? ?(?:is now|is|was|were|=|:|now)) {_N.format('limit')} "
    rf"?{_UNIT.format('limit_unit')}(?: (?:on|for) (?:it|this|that|the \w+)| (?:is )?allowed)?|"
    rf"(?:(?:the|my|our|a) )?(?:(?:new|force|wanted|target) )*(?:band|goal|range|target) ?(?:is "
    rf"now|is|was|were|=|:|goes from|now) (?:from )?{_N.format('low')}(?: "
    rf"?{_UNIT.format('low_unit')})? ?(?:to|-|–|and) ?{_N.format('high')} "
    rf"?{_UNIT.format('high_unit')})(?P<end>[.!]?$|[,.;:] (?P<asked>.+))",
    re.I,
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Told:
    """What was told.

    Attributes:
        mass_g: Mass of the object [g]; None where it was not told.
        band_n: Force band [N]; None likewise.
        limit_n: Limit of the force [N]; None likewise.
        is_supposed: Whether it counts for one question alone: 'if it weighs 50 g'.
        end_n: One end of the band alone, 'lower' or 'upper', and its force [N]; None likewise.
    """

    mass_g: float | None = None
    band_n: tuple[float, float] | None = None
    limit_n: float | None = None
    is_supposed: bool = False
    end_n: tuple[str, float] | None = None

    @property
    def question(self) -> str:
        """The question that it answers."""
        if self.mass_g is not None:
            return "What is the mass?"
        is_band = self.band_n is not None or self.end_n is not None
        return "What is the band?" if is_band else "What is the limit?"

    @property
    def text(self) -> str:
        """It in words."""
        told = []
        if self.mass_g is not None:
            told.append(f"the object weighs {self.mass_g:g} g")
        if self.band_n is not None:
            told.append(f"the force band is {self.band_n[0]:g} to {self.band_n[1]:g} N")
        if self.end_n is not None:
            told.append(f"the {self.end_n[0]} end of the force band is {self.end_n[1]:g} N")
        if self.limit_n is not None:
            told.append(f"the limit is {self.limit_n:g} N")
        return " and ".join(told)


_CORRECTED = re.compile(
    rf"(?:(?:no|nah|nope|oh|sorry|actually|wait|ok|now|i mean|i meant)[,:]? )*(?:"
    rf"(?:make|set|let us make|change) (?:it|that|this)(?: to)?|(?:i mean|i meant)) "
    rf"(?P<value>{_N.format('first')}.*?)"
    r"(?:,? (?:instead|then|please|now))*[.!]?",
    re.I,
)
_WHAT_IF = re.compile(r"(?:(?:and|but|so)[, ]+)*(?:what )?(?:if|suppose|assuming) ", re.I)
_BESIDE_IT = re.compile(
    r"\b(in|inside|within|over|above|under|below|(?:harder|more|firmer|tighter|higher|stronger|less|"
    r"softer|weaker|lower) than) (?:it|that|this)"
    r"(?: (?:force|value|number|figure|mark))?(?=[?.! ]*$)",
    re.I,
)
"""'Would we be in it?', behind a band that is told."""

_BEFORE_IT = re.compile(r"[^\d,.:;?]+[,.:;] +(?=\D)")
"""A clause before what is told: 'It's an egg, so the limit is 1.5 N.'"""


def told_in(text: str, about: Meaning | None = None) -> tuple[Told, str] | None:
    """What a text tells, and what it asks besides, or ''; None where it tells nothing.

    Args:
        text: The text.
        about: What was asked for, or told, before it: what a correction is of.
    """
    text = with_plain_numbers(text.strip())
    if not _ASKS.match(text):
        text = _ASKS_BEHIND.sub(r"\g<told>. ", _RUN_ON.sub(r"\g<told>. ", text))
    if _WHAT_IF.match(text):
        text = text.rstrip("? ")
    corrected = _CORRECTED.fullmatch(text)
    if corrected and (what := _told_before(about)):
        text = f"{what} is {corrected['value']}"
    found = _TOLD.fullmatch(text)
    if found is None and (circumstance := _BEFORE_IT.match(text)):
        found = _TOLD.fullmatch(text[circumstance.end() :])
    if found is None and (end := _END_MOVED.fullmatch(text)):
        side = "lower" if re.match("low|bottom|min|least", end["end"], re.I) else "upper"
        return Told(end_n=(side, in_own_unit(end["number"], end["unit"]))), ""
    if found is None and (mass := _CORRECTED_MASS.fullmatch(text)):
        return Told(mass_g=in_own_unit(mass["number"], mass["unit"])), ""
    if found is None:
        return _told_freely(text)
    mass_g = _number(found, "mass", "mass")
    limit_n = _number(found, "limit", "force")
    high_n = _number(found, "high", "force")
    low_n = _number(found, "low", "force") if found["low_unit"] else None
    if high_n is not None and low_n is None:
        low_n = in_own_unit(found["low"], found["high_unit"])
    band_n = None if low_n is None or high_n is None else (low_n, high_n)
    if mass_g is None and limit_n is None and band_n is None:
        return None
    told = Told(mass_g=mass_g, band_n=band_n, limit_n=limit_n, is_supposed=bool(found["if"]))
    asked = _of_what_is_told(found["asked"] or "", told)
    is_asked = "?" in asked or _ASKS.match(asked)  # 'the limit is 3 N, it is glass' asks nothing
    return told, asked if is_asked else ""


_END_MOVED = re.compile(
    r"(?:(?:now|so|ok|and|then|please|actually)[, ]+)*(?:(?:raise|lower|set|move|put|change|"
    r"increase|reduce|bring)(?: up| down)? )?(?:the |its )?(?P<end>(?:lower|upper|bottom|top|low|"
    r"high)(?: (?:end|bound|edge|side))?|min(?:imum)?|least)(?: of (?:the|my|our) (?:force )?band)?"
    r" ?(?:to|is now|is|at|becomes|=|:) ?(?P<number>\d+(?:[.,]\d+)?) ?"
    r"(?P<unit>N|newtons?|mN|millinewtons?)(?: now| instead)?[.!]*",
    re.I,
)
"""'Now raise the lower end to 1.8 N.'"""

_CORRECTED_MASS = re.compile(
    r"(?:sorry|no|wait|correction|oops|i meant?)[,:]? (?:(?:it['’]?s|it is|i meant?) )?"
    r"(?P<number>\d+(?:[.,]\d+)?) ?(?P<unit>g|grams?|kg|kilos?|kilograms?)[.!]*",
    re.I,
)
"""'Sorry, 82 g.'"""

_SENTENCE = re.compile(r"(?<=[.!?])(?<!\d\.)\s+(?=\S)")
_ASKS = re.compile(
    rf"(?:(?:and|so|but|then|ok|now|please|well)[, ]+)*(?:{AUXILIARY}(?:n['’]?t)?|what|which|how|"
    r"where|why|when|who|by how|tell|give|say|list|report|log|state|name|show|describe|compare|"
    r"confirm|check|verify|add|take|press|squeeze|true|false|pass|fail|if|answer|pick|"
    r"choose|express|convert|more|less|over|under|above|below|and|half|twice|"
    r"(?:at|with|for|in)\b(?!.*\b(?:is|are|was|weighs?|wants?|set|have|has)\b))\b",
    re.I,
)
"""What begins a question, an order or a supposition, and no statement."""

_STATES = re.compile(
    r"(?:\b(?:is|are|was|weighs?|weighed|runs?|has|have|had|got|handling|holding|gripping|took|"
    r"wants?|need|needs|set|keep|keeping|assume|caps?|allows?|permits?|each|apiece|says?|told|"
    r"cracks?|breaks?|bruises?|crush\w*|ruins?|spoils?|hurts?|damages?|squash\w*|must|max|limit|"
    r"never|pretend|imagine|suppose|recipe)\b|['’](?:s|re|ve)\b)",
    re.I,
)
"""What a statement has, and a question without its mark has not: 'grip strong enough for 25 g'."""

_SUPPOSES = re.compile(r"(?:(?:and|now|so)[, ]+)*(?:suppose|supposing|assume|say|imagine)\b", re.I)
_IS_MASS = re.compile(
    r"(?<![\w.,])(?P<number>\d+(?:[.,]\d+)?)[ -]?(?P<unit>g|grams?|gr|kg|kilos?|kilograms?|"
    r"oz|ounces?|lbs?|pounds?)\b(?![ -]?(?:force|of force))",
    re.I,
)
_FORCE_UNIT = r"(?P<{}>N|newtons?|mN|millinewtons?)\b"
_IS_BAND = re.compile(
    rf"(?<![\w.,])(?P<low>\d+(?:[.,]\d+)?)(?: ?{_FORCE_UNIT.format('low_unit')})? ?"
    rf"(?:to|-|–|and|up to) ?(?P<high>\d+(?:[.,]\d+)?) ?{_FORCE_UNIT.format('high_unit')}",
    re.I,
)
_IS_FORCE = re.compile(
    rf"(?<![\w.,])(?P<number>\d+(?:[.,]\d+)?) ?{_FORCE_UNIT.format('unit')}", re.I
)
_BOUNDS = re.compile(
    r"\b(?:limit\w*|max\w*|caps?|never|no more|not more|(?:don['’]?t|do not|must not|may not|"
    r"mustn['’]?t|"
    r"can['’]?t) (?:\w+ ){0,3}?(?:more|exceed|above|over|beyond)|anything (?:above|over|beyond|"
    r"past|more than)|(?:more than|above|over|beyond) [^.]*\b(?:ruins?|spoils?|bruises?|cracks?|"
    r"breaks?|hurts?|damages?|crush\w*|squash\w*)|at most|ceiling|cap|(?:cracks?|"
    r"breaks?|bruises?|crush\w*|bursts?|splits?|gives way) (?:above|over|at|beyond|from|past)|not "
    r"above|not over|not exceed\w*|stay (?:below|under)|keep (?:it )?(?:below|under))\b",
    re.I,
)
_CHANGES = re.compile(
    r"\b(?:heavier|lighter|more than|less than|over|under|above|below|added?|extra|scale|spec|"
    r"weight of|true|false|correct|right|wrong)\b",
    re.I,
)
"""What a mass may be besides that of the object."""


_RUN_ON = re.compile(
    r"(?P<told>\b(?:weighs|weigh|is|are) (?:about )?\d+(?:[.,]\d+)? ?(?:k?g|grams?|kilos?)),? "
    r"(?=(?:could|can|would|will|does|do|is) (?:you|we|it|this|that|the grip)\b)",
    re.I,
)
"""'My hamster weighs 30 g could you hold it'."""

_ASKS_BEHIND = re.compile(
    r"(?P<told>\d[^,;?]*), (?=(?:are|is|do|does|will|would|can|could|have|has|am) (?:we|it|you|i|"
    r"they|this|that|the (?:grip|force))\b(?: \w+){2})",
    re.I,
)
"""'It cracks at 0.8 N, are we still below that force'."""

_IS_THAT = re.compile(
    r"(?:it|this|that)(?:['’]s| is| weighs| has)\b[^.?!]*\d+ ?(?:k?g|grams?|kilos?)\b", re.I
)
"""'Will it slip? It's the 35 g one.'"""

_NOT_SO = re.compile(
    r"\b(?:(?:is|was|are|were)(?:n['’]?t| not)|(?:does|do|did)(?:n['’]?t| not) (?:weigh|have|be)|"
    r"never was|no longer)\b[^.;?,]*\d|"
    r"\b(?:(?:i|we) (?:doubt|wonder|am not sure|do not think|don['’]?t (?:think|believe|know)))\b|"
    r"\b(?:yesterday|last (?:week|time|month|year|night)|used to|formerly|in the past)\b|"
    r"\b(?:the )?(?:last|previous|other|former|old) (?:one|robot|gripper|arm|object|berry|rig)\b|"
    r"\b(?:gripper|robot|arm|sensor|finger|box|tray|basket|table|camera|bench|load cell)s?"
    r"(?:['’]s)? (?:weighs?|weighed|limit|mass)\b|(?<![\w\d])[-−]\s?\d",
    re.I,
)
"""What is denied, doubted or past, or something else's."""


def not_so(text: str) -> str:
    """Words by which a statement tells nothing of what is held now; '' of all others."""
    found = _NOT_SO.search(text)
    return found[0] if found and told_in(text) is not None else ""


def _told_freely(text: str) -> tuple[Told, str] | None:
    """What a statement tells in whatever words: 'My peaches run about 150 g'; None of others."""
    sentences = _SENTENCE.split(text)
    stated = [each for each in sentences if not each.endswith("?") and not _ASKS.match(each)]
    asked = " ".join(each for each in sentences if each not in stated)
    words = " ".join(stated)
    is_last = len(stated) == 1 and sentences[-1:] == stated and _IS_THAT.match(words)
    if not stated or not (sentences[: len(stated)] == stated or is_last):
        return None
    if not _STATES.search(words):
        return None
    told = Told(is_supposed=bool(_SUPPOSES.match(words) and asked))
    masses, band = list(_IS_MASS.finditer(words)), _IS_BAND.search(words)
    if len(masses) == 1 and not _CHANGES.search(words):
        told = replace(told, mass_g=in_own_unit(masses[0]["number"], masses[0]["unit"]))
    if band:
        low_n = in_own_unit(band["low"], band["low_unit"] or band["high_unit"])
        told = replace(told, band_n=(low_n, in_own_unit(band["high"], band["high_unit"])))
    rest = f"{words[: band.start()]} {words[band.end() :]}" if band else words
    forces = list(_IS_FORCE.finditer(rest))
    if len(forces) == 1 and _BOUNDS.search(rest):
        told = replace(told, limit_n=in_own_unit(forces[0]["number"], forces[0]["unit"]))
    elif forces:
        return None
    is_told = told.mass_g is not None or told.band_n is not None or told.limit_n is not None
    return (told, _of_what_is_told(asked, told)) if is_told else None


def _of_what_is_told(asked: str, told: Told) -> str:
    """A question with the name of what was told before it: 'are we below that?'."""
    if (told.band_n is None) == (told.limit_n is None):
        return asked
    return _BESIDE_IT.sub(rf"\1 the {'limit' if told.band_n is None else 'band'}", asked)


def _told_before(about: Meaning | None) -> str:
    """What a correction is of: 'the limit', 'the mass' or 'the band'; '' of others."""
    if isinstance(about, Amount) and about.quantity in ("limit", "mass"):
        return f"the {about.quantity}"
    parts = about.parts if isinstance(about, Several) else (about,)
    is_band = all(
        isinstance(each, Amount) and each.quantity in ("band_low", "band_high") for each in parts
    ) or (about is not None and names_of(about) == ("band_low_n", "force_n", "band_high_n"))
    return "the band" if is_band else ""


def _number(found: re.Match[str], name: str, dimension: str) -> float | None:
    """A number in its dimension's own unit; None where there is none, or of another dimension."""
    unit = found[f"{name}_unit"]
    if found[name] is None or dimension_of(unit) != dimension:
        return None
    return in_own_unit(found[name], unit)


def with_told(scene: AskedScene, told: Told) -> AskedScene:
    """A scene with what was told.

    A limit below the band of the scene leaves no band.

    Raises:
        ValueError: It can't be so: a mass of 0, a band that is upside down.
        LimitError: The contract would be refused.
    """
    if told.mass_g is not None:
        scene = replace(scene, mass_g=told.mass_g)
    if told.end_n is not None:
        return _with_end(scene, *told.end_n)
    if told.band_n is None and told.limit_n is None:
        return scene
    limit_n = scene.told_limit_n if told.limit_n is None else told.limit_n
    if told.band_n is not None:
        is_above = limit_n is not None and limit_n >= told.band_n[1]
        if told.limit_n is not None and not is_above:
            raise ValueError("the limit lies below the band")
        contract = band_contract(*told.band_n, limit_n if is_above else None)
        return replace(scene, contract=contract, told_limit_n=limit_n if is_above else None)
    assert limit_n is not None
    contract_before = scene.contract
    if contract_before is None or limit_n < contract_before.terms.force_n.high:
        return replace(scene, contract=None, told_limit_n=limit_n)
    contract = replace(contract_before, limit_n=limit_n)
    return replace(scene, contract=contract, told_limit_n=limit_n)


def _with_end(scene: AskedScene, side: str, force_n: float) -> AskedScene:
    """A scene whose band has another end; its limit stays where it is not below that.

    Raises:
        ValueError: There is no band, or it would be upside down.
        LimitError: The contract would be refused.
    """
    contract = scene.contract
    if contract is None or contract.force_n is None:
        raise ValueError("no force band is given that could have another end")
    band, limit_n = contract.force_n, contract.limit_n
    low_n, high_n = (force_n, band.high) if side == "lower" else (band.low, force_n)
    kept_n = limit_n if limit_n is not None and limit_n >= high_n else None
    return with_told(scene, Told(band_n=(low_n, high_n), limit_n=kept_n))
