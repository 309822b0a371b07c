"""A question in plain words, with its numbers and what its pronouns stand for.

Not here: what it asks (``tacgrasp.lessons.dialogue.calculations.calculated``).
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from tacgrasp.lessons.dialogue.calculations.quantity_names import UNIT, is_band, unit_of
from tacgrasp.lessons.dialogue.calculations.terms import Term, TermReader, alike
from tacgrasp.lessons.dialogue.conditions import number_text
from tacgrasp.lessons.dialogue.plainer import plainer
from tacgrasp.lessons.dialogue.quantities import MEAN_PRESSURE
from tacgrasp.lessons.dialogue.query import asked_text

_USUAL: Mapping[str, tuple[str, str]] = {
    "force": ("force_n", "N"),
    "length": ("depth_mm", "mm"),
    "mass": ("mass_g", "g"),
    "fraction": ("area_percent", "%"),
    "pressure": (MEAN_PRESSURE, "kPa"),
}
"""What a pronoun stands for beside a dimension ('how far below 2 N are we'), and its unit."""

_ITS = re.compile(r"\bits\b", re.I)
_PRONOUN = re.compile(
    r"(?:(?:we|us|me|it|this|that|i|you|they|these|those|he|she|"
    r"the (?:robot|gripper|contact|object|thing|result|reading|value|touch|fingers?)|what you feel|"
    r"what there is)(?: (?:now|pressing|gripping|here))?)"
)
_PEOPLE = re.compile(r"(?:we|us|me|i|you|they)\b")
_AS_IT_IS = re.compile(r"\b(?:present|presently|current|currently|now|old)\b")
_GRAVITY = re.compile(
    r"^(?:with|using|at|for|taking) (?:a |the )?(?:g |gravity )?(?:of )?#\d+ m\b \S+ |"
    r"^(?:with|using|at|for|taking) (?:a |the )?(?:g|gravity)(?: (?:taken|set|at|as|of|is|equals|"
    r"to|"
    r"being|equal))* #\d+(?: (?:m|n) \S+(?: #\d+)?)? "
)
_LEADING = re.compile(
    r"^(?:(?:please|kindly|do the (?:arithmetic|maths?|sums?|calculation)(?: for (?:me|us))?|"
    r"express|tell me|give me|state|say|report|compute|calculate|work out|"
    r"determine|figure out|find|find me|show me|name|quote|put|now|well|ok|okay|right|then|and|so|"
    r"hmm+|um+|uh+|for (?:my|the|our|your) (?:log|notes?|record|report|minutes|sheet|table|file|"
    r"book|boss|form|spec|calc|sums?)|just|roughly|"
    r"approximately|exactly|(?:i |we )?(?:want|need|would like)(?: to know)?(?! to\b)|let me know|"
    r"as a force|i ask|i wonder|tell us|give us|how about|what about|any idea|"
    r"(?:can|could|would|will) you (?:tell me|say|work out|calculate|give me|figure out)) )+"
)
_MORE = r"(?:more|further|extra|additional)"
_CLAIMED = re.compile(
    r"^(?:(?:true or false|yes or no|right or wrong|(?:confirm|verify|check)(?: for me)?"
    r"(?: (?:that|whether|if))?|(?:is it|would it be|am i) (?:true|correct|right|fair|so|the case)"
    r"(?: (?:that|to say(?: that)?|in (?:saying|thinking)(?: that)?))?|"
    r"(?:would|can|could|do) (?:you|i|we|one) (?:say|agree|confirm|think|claim)(?: that)?|"
    r"i (?:take it|believe|assume|guess|think)(?: that)?) )+"
    r"(?!(?:is|are|does|do|has|have|would|will|can|could)\b)"
)
_CLAIM_TAG = re.compile(
    r" (?:(?:is|am i|are we) )?(?:(?:that|it|this|i) )?(?:yes or no|true or false|right or wrong|"
    r"y or n|right|correct|true|agreed|yes|no)$"
)
_IN_UNIT = re.compile(
    rf"(?:(?: (?:measured|expressed|given|said|stated|counting|counted|only|just))? (?:in|as)|"
    r" (?:converted|translated|turned) (?:to|into)|"
    rf"^(?:counting |measured |expressed )?in) (?:plain |whole )?({UNIT})(?= |$)"
)
_CONVERT = re.compile(
    rf"^(?:convert|translate|turn|change) (?P<what>.+?) (?:in)?to (?P<unit>{UNIT})$"
)
_LAST_UNIT = re.compile(
    rf"(?<!#\d)(?<!\bsquare)(?<!\bsq)(?<!\bper)(?<!\ba)(?<!\bone)(?<!\bof)(?<!\bby)(?<!\bthan) "
    rf"({UNIT})(?: (?:that|it) is)?$"
)
"""A unit at the end, behind a comma: 'the new force, N'."""

_FIRST_UNIT = re.compile(
    rf"^(?:(?:number of|spare|remaining|{_MORE}) )*({UNIT})"
    r"(?: of (?:force|grip|squeeze|travel|indentation|depth|gel travel|load))? "
    r"(?=(?:left|short|needed|required|missing|lacking|to|remaining|over|above|below|under|"
    r"until|till|before|from|between|in (?:hand|reserve)|up to|still|available|i|we|you|"
    r"for me|averaged|on average|mean|average|nominal|contact|center|spare|away|shy|past|beyond|"
    r"surely|safely|certainly|held|guaranteed)\b)"
)
"""A unit that begins a question without 'how many': 'mm of travel left'."""

_PRESSURE_UNIT = re.compile(
    r"(?<!\d )\b(?:psi|(?:hecto|kilo|mega)?pascals?|[hkm]pa|millibars?|mbar|mmhg|atmospheres?)\b"
)
_MANY = re.compile(
    rf"\b(?:how many(?: (?:{_MORE}|whole))?|what|which|how much(?: {_MORE})?) "
    rf"({UNIT})\b(?! of (?:the |our )?(?!force|grip|squeeze|pressure|indentation|travel|load|it))"
    rf"(?: of (?:force|grip|squeeze|indentation|travel)\b)?(?: {_MORE}\b)?"
)
_EXTRA = re.compile(
    rf"^{_MORE} |\bhow (?:much|many)(?: (?:{UNIT}))? {_MORE}\b|\bhow many {_MORE} "
    rf"(?:{UNIT})\b|\b(?:{_MORE}) (?:force|grip|squeeze|indentation)\b|"
    r"\bhow much (?:stronger|harder|firmer|tighter)\b"
)
_AS_RATIO = re.compile(
    r"(?: (?:expressed )?)?as (?:a )?(?:plain |simple |decimal |bare )?(?:fraction|number|"
    r"ratio)(?: between #\d+ and (?:one|#\d+))?(?= |$) ?"
)
_WERE_FIRST = re.compile(
    r"^were ((?:the|our|my|its|this) \w+|it|this|that) (?!to\b)"
    r"(?=[^,]+, (?:would|will|is|are|does|could|what|how)\b)"
)
"""'Were it 0.2 mm deeper, would it be over 0.9 mm?'"""
_AS_PERCENTAGE = re.compile(r" (?:in percent|as (?:a )?percentages?)(?= |$)")
_ANSWERED = re.compile(
    r" (?:answer|say|reply|respond|just say)(?: with| only)? "
    r"[a-z]+(?: [a-z]+)?(?: or [a-z]+(?: [a-z]+)?)+$"
)
_TAKING_G = re.compile(
    r" (?:use|take|taking|with|using) (?:g )?(?:as |of )?#\d+(?: (?:m|"
    r"n) (?:per )?(?!(?:less|more|extra|harder|softer|off|fewer|on|added)\b)\S+(?: #\d+)?)?"
    r"(?: (?:for|as) g)?$"
)
_ONE_MORE = re.compile(
    rf"\b(?:one (?:more|extra|additional|further)|(?:another|an extra|a further)(?: more)?) "
    rf"({UNIT})\b"
)
_PER_UNIT = re.compile(
    rf"(?: (?:in|how (?:many|much)) | |^how (?:many|much) |^in |^)(?P<one>{UNIT}) per "
    rf"(?P<each>{UNIT})(?: (?:is|are|does|do) (?:that|it|this)(?: \w+)*| on average)?$"
)
_EXTRA_ONE = re.compile(rf"\bone extra (?={UNIT}\b)|\banother (?=half (?:an? )?(?:{UNIT})\b)")
_FULL_ONE = re.compile(rf"\b(?:one|an?) (?:full|whole|single) (?={UNIT}\b)")
_PER_SLASH = re.compile(rf"\b({UNIT}) ?/ ?({UNIT})\b")
_SLASH = re.compile(
    r"(?<=[a-z]) ?/ ?(?=(?:the )?(?:(?:actual|measured|felt|current) )?(?:force|limit|depth|area|"
    r"mass|"
    r"weight|actual|x|y)\b)"
)
_OVER_MAXIMUM = re.compile(
    r"\b(over|past|above|beyond|exceed(?:s|ing)?|below|under) (?:the|our) max(?:imum)?(?=[,.?! ]*$)"
)
_HOLD_ALL = re.compile(
    r"(?:do|does|are|is) (?:(?:both|all)(?: of (?:them|these))?|the following)(?: conditions)? "
    r"(?:hold|holds|true|met|satisfied|the case|so)[:,]? "
)
_WERE_TO = re.compile(r"^(?:were|should|if) (i|we|you|it|the \w+) (?:were )?to ")
_HAD = re.compile(r"^had (?=(?:i|we|you|it|the \w+) \w+ed\b)")
_OR_NOT = re.compile(r" or (?:not|no)$")
_KEEPING_SIGNS = re.compile(r",? (?:keeping|with|counting) (?:the|their) signs?\b")
_AT_ONCE = re.compile(r" (?:at the same time|simultaneously|together|at once)$")
_GIVEN_MASS = re.compile(
    r"^(?:with|given|by|from|going by) the (?:mass|weight)(?: "
    r"(?:that )?(?:i|we|you)(?: \w+){1,3}?)? (?=what|how)|"
    r" (?:going by|given|from|by|taking|using|with) the (?:(?:told|stated|given) )?(?:mass|"
    r"weight)$|"
    r" (?:going by|given|from|by) the (?:mass|weight) (?:(?:that )?(?:i|we|you|it)\b.*|(?:given|"
    r"stated|told))$"
)
_REMARK = re.compile(
    r" one way or (?:the other|another)\b| (?:without|beyond) (?:any|a) doubt\b|"
    rf"(?: only| just)?(?: instead of| rather than| not) (?:in )?(?:{UNIT})$| (?:for me )?would "
    rf"you$|"
    r" (?:makes|comes to|amounts to)$| (?:i|we) need (?:it|this|"
    r"that|them) .*$| whichever (?:is|one is) \w+$"
)
_AMOUNT_OF = re.compile(
    r"^(?:by )?(?:what|which) (?:amount|distance)\b|^what(?: is|"
    r" are)?(?= (?:still )?(?:missing|lacking|left)\b)"
)
_ZERO_SAID = (
    r"(?:(?:call(?:ing)?(?: (?:it|that))?|say(?:ing)?|give|answer|report|put|use|write|tell|count|"
    r"make it|it is|that is|just|with|let it be|return|treat(?:ing)? (?:it|that) as) )*"
)
_OR_ZERO = re.compile(
    rf" (?:(?:or|and|else|otherwise) )*{_ZERO_SAID}(?:or )?(?P<a>#\d+) "
    r"(?:if|when|where|should|unless|in case|for (?:no|none)) .+$|"
    rf" (?:if|when|where|should) (?:(?!#).)+? {_ZERO_SAID}(?P<b>#\d+)$|"
    rf" (?:or else|else|otherwise|or) {_ZERO_SAID}(?P<c>#\d+)$|"
    r" (?:none|nothing|no \w+|not)(?: (?:is|are))?(?: (?:needed|required|missing|lacking|at all|"
    r"short|"
    r"necessary|left|there|over|under|above|below))*(?: (?:is|means|counts as|as|being|equals|"
    r"gives|"
    r"to be|reads))? (?P<d>#\d+)$|"
    r" (?:counting|treating|taking|with) (?:(?!#).)+? as (?P<e>#\d+)$|"
    r" (?:never|not) (?:below|under|less than) (?P<f>#\d+)$|"
    r" clamp(?:ed|ing)?(?: it)? (?:at|to) (?P<g>#\d+)(?: (?:once|if|when) .+)?$"
)
_SIGNED = re.compile(
    r"(?:^| )(?:(?:use|give|say|put|with|write) )?(?:an? |it )?(?:minus|negative|plus|positive)"
    r"(?: (?:sign|figure|value|number|one))? (?:if|for|when|meaning|means|already|too) "
    r"(?:(?! (?:(?:and|but) (?:is|are|does|do|will|would)|(?:has|have|does) the) ).)+$|^signed |"
    r" signed(?= in \S+(?: \S+)?$|$)|"
    r" an? (?:minus|negative) "
    r"(?:figure|value|number|sign)(?: would| will)? means? .+$| with (?:a |the )?sign$|"
    r" (?:right|up) (?:being|as|is|counts as) (?:plus|positive)$"
)
_UNSIGNED = re.compile(
    r" (?:leaving|putting|setting) (?:the )?signs? aside$|"
    r"^(?:ignoring|without|regardless of|disregarding|leaving out|dropping) "
    r"(?:the |its )?(?:sign|direction) | (?:ignoring|without|regardless of|disregarding|no matter) "
    r"(?:the |its )?(?:sign|direction|which(?: is \w+)?|whether .+)$|"
    r" (?:and )?(?:(?:both|each) )?without (?:a |the |any |their )?signs?$|"
    r" (?:the )?sign (?:does not|doesn't) matter$| never mind which(?: way)?$| either way$|"
    r" on either side$| (?:whichever|either) (?:way|direction)\b"
)


@dataclass(frozen=True, slots=True, kw_only=True)
class AskedWords:
    """A question.

    Attributes:
        words: Its plain words, without what they say of unit and sign; numbers are #1, #2, ...
        numbers: Its numbers.
        unit: Symbol of the unit that is asked for, or of a quotient of two; '' where none is.
        is_ratio: Whether a share is asked for as a plain number.
        is_unsigned: Whether the sign is to be left out.
        has_floor: Whether what is below zero counts as zero.
        is_signed: Whether a difference is asked for with its sign.
        is_more: Whether what is asked for comes on top of what is felt: 'how many more newtons'.
        subject: What its pronouns stand for; None for the usual quantity of a dimension.
        base: Name of a scene that the question supposes to be ``subject``; ''.
    """

    words: str
    numbers: tuple[float, ...]
    unit: str = ""
    is_ratio: bool = False
    is_unsigned: bool = False
    has_floor: bool = False
    is_signed: bool = False
    is_more: bool = False
    subject: Term | None = None
    base: str = ""

    def term(self, words: str, beside: Term | None = None) -> Term | None:
        """The meaning of a noun phrase, or of a pronoun beside another term; None of others."""
        if not _PRONOUN.fullmatch(words):
            read = TermReader(self.numbers).read(words)
            return read if read is None or _AS_IT_IS.search(words) else self._supposed(read)
        if self.subject is not None and not _PEOPLE.match(words):
            return self.subject
        if beside is None or beside.dimension not in _USUAL or beside.expression.startswith("-"):
            return None
        return self._supposed(usual(beside.dimension))

    def _supposed(self, term: Term) -> Term:
        """A term with what the question supposes in place of what is."""
        if self.subject is None or not self.base:
            return term
        value = f"({self.subject.expression})"
        if term.expression == self.base:
            return replace(self.subject, words=term.words, is_weight=term.is_weight)
        held = term.expression
        if self.base == "force_n":
            held = re.sub(r"\bholds_g\b", "force_n / gram_n", held)
        expression = re.sub(rf"\b{self.base}\b", value, held)
        return replace(term, expression=expression)

    def bound(self, words: str, *, is_above: bool) -> Term | None:
        """As ``term``; above the band is above its upper end, below it below its lower one."""
        if is_band(words):
            end = "band_high_n" if is_above else "band_low_n"
            return Term(expression=end, dimension="force", words=words)
        return self.term(words)

    def pair(
        self, a: str | None, b: str, *, is_above: bool | None = None
    ) -> tuple[Term, Term] | None:
        """Two terms in one dimension; without the first it is the usual one beside the second.

        Above or below the band is above or below its end.
        """
        second = self.term(b) if is_above is None else self.bound(b, is_above=is_above)
        if second is None and a and _PRONOUN.fullmatch(b):
            second = self.term(b, beside=self.term(a))
        if second is None:
            return None
        felt = usual(second.dimension) if usual_unit(second.dimension) else None
        first = self.term(a, beside=second) if a else self.subject or felt
        if first and felt and first.expression == second.expression:
            first = self._supposed(felt)  # 'if the limit fell, would we exceed it'
        if first is None or first.expression == second.expression:
            return None
        return alike(first, second)

    def only_value(self) -> Term | None:
        """The one number of the question, with its unit; None where it has none or more."""
        named = re.search(rf"#1 (?:{UNIT})\b", self.words)
        return self.term(named[0]) if named and len(self.numbers) == 1 else None

    def in_its_unit(self, words: str) -> str:
        """Words whose bare numbers have the unit that the question names beside them."""
        if not self.unit:
            return words
        unit = "percent" if self.unit == "%" else self.unit.lower()
        return re.sub(rf"(#\d+)(?! (?:{UNIT})\b| times| \w+ of )", rf"\1 {unit}", words)

    def about(self, subject: Term, words: str, base: str = "") -> AskedWords:
        """The rest of the question, whose pronouns stand for a term, and so does a name."""
        return replace(self, words=words, subject=subject, base=base)

    def said(self, words: str) -> str:
        """Plain words as an answer repeats them, with the numbers in place."""

        def number(match: re.Match[str]) -> str:
            value = number_text(self.numbers[int(match[1]) - 1])
            if value == "0" and not match[2]:
                return "zero"
            return f"{value} {unit_of(match[2])}" if match[2] else value

        return re.sub(rf"#(\d+)(?: ({UNIT})\b)?", number, words)


def usual(dimension: str) -> Term:
    """The felt quantity that a dimension makes think of."""
    return Term(expression=_USUAL[dimension][0], dimension=dimension, words="it")


def usual_unit(dimension: str) -> str:
    """Unit in which answers give a dimension; '' of a ratio."""
    return _USUAL[dimension][1] if dimension in _USUAL else ""


def asked_words(question: str) -> AskedWords:
    """A question in plain words, with what it says of unit and sign taken out."""
    question = _WERE_FIRST.sub(r"if \1 were ", question.lower())
    question = _EXTRA_ONE.sub("another ", _ITS.sub("the", question))
    question = _OVER_MAXIMUM.sub(r"\1 the limit", question)
    question = _FULL_ONE.sub("1 ", _ONE_MORE.sub(r"1 \1 more", question))
    question = _PER_SLASH.sub(r"\1 per \2", _KEEPING_SIGNS.sub("", question))
    question = _SLASH.sub(" divided by ", _WERE_TO.sub(r"if \1 ", question))
    if _HOLD_ALL.search(question):
        question = re.sub(r"[,;:] (?!and |or )", " and ", _HOLD_ALL.sub("both ", question))
    asked = asked_text(plainer(question))
    places = iter(range(1, len(asked.numbers) + 1))
    words = re.sub("#", lambda _: f"#{next(places, 0)}", asked.words)
    words = _LEADING.sub("", _GRAVITY.sub("", words))
    words = _OR_NOT.sub("", _HAD.sub("if ", words))
    words, has_floor = _floored(words, asked.numbers)
    if claimed := _CLAIMED.match(words):
        words = f"is {words[claimed.end() :]}"
        words = _CLAIM_TAG.sub("", words)
    for remark in (_GIVEN_MASS, _ANSWERED, _TAKING_G, _AT_ONCE, _REMARK):
        words = remark.sub("", words)
    per = ""
    if (found := _PER_UNIT.search(words)) and not re.search(r"#\d+$", words[: found.start()]):
        per = f"{unit_of(found['one'])}/{unit_of(found['each'])}"
        words = words[: found.start()]
    words = _AMOUNT_OF.sub("how much", words)
    is_unsigned = _UNSIGNED.search(words) is not None
    is_signed = _SIGNED.search(words) is not None
    words = _SIGNED.sub("", _UNSIGNED.sub("", words))
    is_ratio = _AS_RATIO.search(words) is not None and _AS_PERCENTAGE.search(words) is None
    is_more = _EXTRA.search(words) is not None
    unit, words = _unit(_AS_RATIO.sub("", words) if is_ratio else words)
    return AskedWords(
        words=" ".join(words.split()),
        numbers=asked.numbers,
        unit=per or unit,
        is_ratio=is_ratio,
        is_unsigned=is_unsigned,
        has_floor=has_floor,
        is_signed=is_signed,
        is_more=is_more,
    )


def _floored(words: str, numbers: Sequence[float]) -> tuple[str, bool]:
    """Words without what they say of zero, and whether what is below zero counts as zero."""
    zero = _OR_ZERO.search(words)
    place = next((place for place in zero.groups() if place), "") if zero else ""
    if zero is None or numbers[int(place[1:]) - 1] != 0:
        return words, False
    return words[: zero.start()], True


def _unit(words: str) -> tuple[str, str]:
    """The unit that is asked for, and the words without it."""
    if converted := _CONVERT.match(words):
        return unit_of(converted["unit"]), converted["what"]
    if many := _MANY.search(words):
        return unit_of(many[1]), f"{words[: many.start()]}how much{words[many.end() :]}"
    found = list(_IN_UNIT.finditer(words))
    if not found and (last := _LAST_UNIT.search(words)):
        return unit_of(last[1]), words[: last.start()]
    if not found and (first := _FIRST_UNIT.match(words)):
        return unit_of(first[1]), f"how much {words[first.end() :]}"
    if not found and (pressure := _PRESSURE_UNIT.search(words)):
        return unit_of(pressure[0]), f"{words[: pressure.start()]}{words[pressure.end() :]}"
    if not found:
        return "", words
    return unit_of(found[-1][1]), f"{words[: found[-1].start()]}{words[found[-1].end() :]}"
