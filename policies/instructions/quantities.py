"""Forces that a text names, in newtons: each a value, a most or a least.

Read are newtons with prefixes, grams, kilograms, pounds and ounces of force, in digits and in words,
with tolerances, ranges, factors on the task's force, and lengths with what they bound. Not here: manner.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

from policies.instructions.bounds import with_plain_bounds
from policies.instructions.denials import NO_CASE
from policies.instructions.elisions import written_out
from policies.instructions.force_units import ALONE, LOOSE, NUMBER, UNIT, in_newtons, number
from policies.instructions.numerals import in_digits
from policies.instructions.tolerances import (
    TOLERANCE,
    band_of,
    with_plain_tolerances,
    without_lone,
)
from policies.instructions.unknown_units import unknown_force

MARK = "#"
"""Stands for a quantity in the rest of a text."""

Kind = Literal["value", "most", "least"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Force:
    """One force that a text names.

    Attributes:
        kind: A value to hold with, the most, or the least.
        value_n: The force [N].
        words: The words that name it.
        within_n: Lowest and highest force of a stated tolerance [N]; None where none is stated.
    """

    kind: Kind
    value_n: float
    words: str
    within_n: tuple[float, float] | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Quantities:
    """What a text says in numbers.

    Attributes:
        forces: Forces in their order; the ends of a range are a least and a most.
        delta_n: Force to add to the task's ('half a newton more'); None where none is named [N].
        factor: Factor on the task's force ('half as hard'); None where none is named.
        factor_words: The words that name it.
        slip_mm, depth_mm: Largest slip, and depth, that are named [mm]; None where none is.
        area_fraction: Part of the pad in contact that is named; None where none is.
        pressure: Words of a pressure that is named in place of a force; '' for none.
        unitless: A number that stands where a force would, without a unit; '' for none.
        unread: Why a number that stands where a force would is none that can be read ('1 Nm');
            '' for none.
        percentage: A percentage or tolerance of nothing, where a force would stand; '' for none.
        place: Words about the place on the pad, which are not read; '' for none.
        denied: Words of a force that is not to be used, where no other one is named; '' for none.
        rest: The plain text with each quantity and its relation replaced by ``MARK``.
    """

    forces: tuple[Force, ...] = ()
    delta_n: float | None = None
    factor: float | None = None
    factor_words: str = ""
    slip_mm: float | None = None
    depth_mm: float | None = None
    area_fraction: float | None = None
    pressure: str = ""
    unitless: str = ""
    unread: str = ""
    percentage: str = ""
    place: str = ""
    denied: str = ""
    rest: str = ""


_SIGNED = (
    rf"(?:(?<![\w.])(?:-|minus |negative )\s?)?(?:{NUMBER}|infinite|infinity|unlimited|inf|nan)"
)
_LINK = r"\s*(?:-|–|—|\.\.\.?|…|,|\bup to\b|\bto\b|\bthrough\b|\btill\b|\band\b)\s*"

_RANGE = re.compile(
    rf"(?P<pre>\b(?:betw\w*|from|within|inside|range(?: of)?|window(?: of)?|in)\s*\[?\s*|\[\s*)?"
    rf"(?P<a>{NUMBER})\s*(?P<ua>(?:{UNIT}|{LOOSE})\b)?(?P<link>{_LINK})"
    rf"(?P<b>{NUMBER.removeprefix(ALONE)})\s*\]?\s*-?(?P<ub>(?:{UNIT}|{LOOSE})\b)"
)
_FORCE = re.compile(
    rf"\(?(?P<a>{_SIGNED})(?:\s*±\s*(?P<ti>{NUMBER.removeprefix(ALONE)})\s*(?P<tip>%)?\s*)?\)?\s*-?\s*(?P<ua>(?:{UNIT}|{LOOSE})\b){TOLERANCE}"
)
_ELLIPSIS = re.compile(
    rf"\b(?:not|no) (?:an?|1|one|a single) (millinewton|newton|gram|mn|n|gf) (more|less)(?: than)? ({NUMBER})(?!\s*(?:{UNIT})\b)"
)
_CHAIN = re.compile(
    rf"({NUMBER})\s*(?:{UNIT})?\s*<=?\s*(?:f|force|it|x|grip)\s*<=?\s*({NUMBER})\s*((?:{UNIT})\b)"
)
_PAIR = re.compile(rf"[\[(]\s*({NUMBER})\s*[,;]\s+({NUMBER})\s*[\])]\s*((?:{UNIT})\b)")
_PRESSURE = re.compile(
    rf"(?:{NUMBER})\s*(?:[kmh]?pa\b|(?:kilo|mega|milli|hecto)?pascals?|m?bars?\b|psi\b|mm\s?hg|atm\b|"
    r"n ?(?:/|per) ?(?:square )?[cm]m)"
)
_PERCENT_OF_NOTHING = re.compile(
    rf"\b(?:with|at|use|using|apply|to) ({NUMBER}\s*(?:%|percent|per cent))(?=\s*(?:$|[.,;!]| please| and| force\b))"
)
_LENGTH = re.compile(rf"(?P<a>{NUMBER})\s*(?P<u>mm|millimet\w+|µm|μm|um|microns?|micromet\w+)\b")
_PAD = r"(?:pads?|gels?|sensors?|sensing area|finger ?(?:tip|pad)s?)"
_SIDE = r"(?:left|right|top|bottom|upper|lower|middle|cent(?:re|er)|edge|corner|tip|base|end)"
_PLACE = re.compile(
    rf"\b{_SIDE}(?: \w+){{0,2}}? (?:of|on) (?:the |your |each |both )?{_PAD}\b|"
    rf"\b{_SIDE}[- ](?:\w+ ){{0,2}}?{_PAD}\b|"
    r"\b(?:off-? ?cent(?:re|er)|cent(?:red|ered|ring|ering|rally)|cent(?:re|er) (?:it|the contact))\b(?:[^.;#]{0,20}\d ?(?:mm|millimet\w+))?|"
    rf"{NUMBER}\s*(?:mm|millimet\w+)(?: \w+){{0,3}}? (?:left of|right of|off|above|below|from) (?:the )?(?:cent(?:re|er)|middle|edge)\b|"
    rf"\b(?:contact|touch)\w*(?: \w+){{0,4}} (?:left|right|edge|corner|middle)\b"
)
_AREA = re.compile(
    rf"(?P<a>{NUMBER})\s*(?:%|percent|per cent) (?:of )?(?:the )?(?:\w+ )?(?:pad|area|gel|sensor)"
)

_FIRMER = r"(?:harder|firmer|tighter|stronger|heavier|larger|bigger|greater|higher)"
_SOFTER = r"(?:softer|gentler|lighter|weaker|looser|lower|smaller|fewer)"
_ABOVE = re.compile(
    rf"\b(?:over|above|beyond|past|exceed(?:s|ed|ing)?|surpass\w*|in excess of|north of|upwards? of|"
    rf"pass(?:es|ing)?|top(?:s|ping)?|cross(?:es|ing)?|overshoot\w*|overstep\w*|(?:any |a \w+ |\w+ )?more(?: \w+)? than|{_FIRMER}(?: \w+)? than(?: you would)?(?: with| at)?)"
    r"(?: the| a| of)?\s*$|>\s*$"
)
_BELOW = re.compile(
    rf"\b(?:under(?:neath)?|below|beneath|less(?: \w+)? than|{_SOFTER}(?: \w+)? than|south of|short of|"
    r"shy of|sub)(?: the| a)?\s*-?$|<\s*$"
)
_MOST = re.compile(
    r"(?:\b(?:less|lower|smaller) than or equal to|\b(?:at|under|below) or (?:under|below|at)|\b(?:ends|tops out|finish\w*|finishes)(?: \w+){0,3} (?:at|before)|\bstop\w*(?: \w+){0,3} before|\bstop (?:squeez|press)ing at|"
    r"\bat (?:the )?(?:very |absolute )?most|\batmost|\bhard stop(?: at| of| is)?|\bup to|\b(?:as (?:hard|much|high|firm|far) as|no further than)|"
    r"\bmax(?:imum|imal(?:ly)?|ed)?\.?(?: \w+){0,3}?(?: of| is| at| to|:| =|=)?|"
    r"\blimit(?:s|ed|ing)?(?: \w+){0,3}?(?: to| of| at| is|:| =|=)?|"
    r"\bcap(?:ped|ping)?(?: \w+){0,3}?(?: at| to| of| is|:| =|=)?|\bceiling(?: of| is| at|:| =|=)?|"
    r"\bupper (?:\w+ )?(?:limit|bound|end)(?: \w+){0,2}?(?: of| is| at|:| =|=)?|\bpeak(?: \w+){0,2}?(?: of| is| at|:| =|=)?|"
    r"<=|≤|=<|\bnot to exceed|\bwithin|\bbounded (?:above )?(?:by|at)|\b(?:not|never)(?: let it)? (?:go|push|squeeze|press)(?: \w{1,4})?|\b(?:top|max|peak|level)(?:p?ing|s|p?ed)?(?: \w+)?(?: out)? at|\b(?:restrict|confin|constrain|throttl)\w*(?: \w+){0,3}? (?:to|at|by)|\b(?:may|can|could|might)(?: only| just| at most)? (?:be (?:raised|increased)|rise|go|climb|increase|grow|build|reach|extend)(?: up)?(?: to)?|\b(?:not|never|without|avoid\w*)(?: (?:ever|let|the|force|it|grip|even|quite|to|be|going|you|allow\w*|pressure|have|want|go|come|rise)){0,5} (?:reach(?:es|ing)?|hit(?:s|ting)?|get(?:s|ting)? (?:up )?to|attain\w*|ris(?:e|es|ing) to|climb\w* to)|\bno more than|\bnowhere near|\b(?:allowed|permitted)(?: (?:up )?to(?: (?:use|reach|rise to|climb to|go(?: up)? to))?)?|"
    r"\b(?:ease|eases|back|let)(?: \w+){0,2} (?:once|when|as soon as|at)(?: (?:you|it|we))?(?: (?:feel|reach|hit|see|measure|get to|read)\w*)?|\bfar (?:away )?from|\b(?:not|never)(?: (?:even|anywhere|get|go|come|be))* (?:close|near)(?: to)?|\bf[_ ]?max\s*[:=]?)"
    r"(?: (?:about|around|roughly))?\s*$"
)
_LEAST = re.compile(
    r"(?:\b(?:more|greater|higher|larger) than or equal to|\b(?:at|over|above) or (?:over|above|at)|"
    r"\bat (?:the )?(?:very |absolute )?least|\batleast|\bmin(?:imum|imal(?:ly)?)?\.?(?: \w+){0,3}?(?: of| is| at|:| =|=)?|"
    r"\blower (?:\w+ )?(?:limit|bound|end)(?: \w+){0,2}?(?: of| is| at|:| =|=)?|\bfloor(?: \w+){0,3}?(?: of| is| at|:| =|=)?|"
    r">=|≥|=>|\bno less than|\b(?:it|berry|fruit|this|that|one|strawberry|thing) (?:really |always )?(?:needs|requires|takes)|\bf[_ ]?min\s*[:=]?|\bstarting (?:at|from)|\bbottom out at)"
    r"(?: (?:about|around|roughly))?\s*$"
)
_OTHERS = r"(?!(?: than| of| is| to|:| =)?(?: (?:about|around|roughly))?(?: an?)? ?(?:\d|\.\d))"
"""Ends a bound after a number: '2 N, at most 2.2 N' bounds the second number, not the first."""

_HARMS = r"(?:g[ia]ves? (?:way|in)|broke|tore|left (?:a |its )?(?:mark|dent|bruise)|fail|yield|suffer|complain|leak|collapse|spoil|bruis|crush|squash|burst|break|split|crack|damag|mark|dent|pop|hurt|mush|ruin|spoil|tear|pulp)\w*"
_SLIPS = r"(?:slips?|falls?|drops?|slides?|turns?|gets? away|wobbles?)"
_BEEN = r"(?:is|was|are|were|would be|will be|would have been|has been|had been|seems?|seemed|felt|proved|turned out)(?: to be)?"
_UNWANTED = (
    r"(?:forbidden|prohibited|banned|disallowed|unacceptable|excessive|overkill|unnecessary|needless|dangerous|harmful|risky|taboo|ruled out|out of (?:the question|bounds)|"
    r"off[ -]limits|an? no[ -]?(?:no|go)|not (?:allowed|permitted|acceptable|tolerated|tolerable|necessary|needed|required|wanted|safe|ok(?:ay)?|an option|advisable|recommended))"
)
"""What is said of a force that is too large."""
_MOST_AFTER = re.compile(
    r"\s*(?:-|–|,|:)?\s*(?:(?:at |as )?(?:a |the )?max(?:imum|imal)?\b(?!\.?(?: of| is|:| =)? ?\d)|tops\b|at (?:the )?(?:very |absolute )?most\b|"
    r"(?:or|and) (?:a (?:little|bit|touch) |slightly |even )?(?:less|below|under|lower|lighter|softer|gentler|smaller)\b|(?: [a-z]+){1,3} at (?:the )?(?:very |absolute )?most\b|"
    r"[;,.]? ?(?:and )?(?:do not|never|not|but not) (?:\w+ ){0,2}(?:past|over|above|beyond|exceed|higher than) (?:it|that|this)\b|"
    r"(?:,? ?(?:and|but|yet|though) )?(?:absolutely )?(?:no|not|never|without)(?! need)(?: \w+){0,2} (?:more|higher|harder|above|over|further|beyond|past)\b"
    r"(?!,? (?:and |or )?(?:no|not|nor|never)(?: \w+)? less)(?! (?:no|not) less)|"
    r"(?:is|as|being)(?: (?!lower)\w+){0,3} (?:limit|max(?:imum)?|ceiling|cap|most|end of the line|last word)\b|(?:limit|ceiling|cap)\b(?!(?: of| is|:| =)? ?\d)|"
    r"(?:(?:an?|the|my|your|as|is|as an?|as the) )*upper (?:\w+ )?(?:bound|limit|end)\b|"
    rf"(?:,? ?(?:and|but) (?:it|that|this) )?(?:{_BEEN} )?(?:already |way |far |just |clearly |evidently )*too (?:much|hard|firm|high|strong|tight|rough|heavy|great)|and under\b|"
    rf"{_BEEN} (?:already |strictly |absolutely |still |simply )*{_UNWANTED}|"
    rf"(?<!, )(?:already |surely |will |would |can |could |may |might |has |had |have )*{_HARMS}(?= (?:it|the|this|that|my|our|one|some|berr\w+|strawberr\w+|fruits?|a|easily|already|them)\b|\s*(?:$|[.;!,]))|"
    rf"(?:will|would|is where \w+|is when \w+) (?:already |surely )?{_HARMS}|(?:it|they|the (?:(?:last|previous|first|other) )?\w+) (?:already |surely )?{_HARMS})"
    + _OTHERS
)
_LEAST_AFTER = re.compile(
    r"\s*(?:-|–|,|:|\+)?\s*(?:(?:at |as )?(?:a |the )?min(?:imum)?\b(?!\.?(?: of| is|:| =)? ?\d)|(?:(?:or|and) )?upwards?\b|(?:or|and) (?:a (?:little|bit|touch) |slightly |even )?(?:more|above|higher|over|harder|firmer|better|greater|larger|up|upwards?)\b|(?: [a-z]+){1,3} at (?:the )?(?:very |absolute )?least\b|[;,.]? ?(?:and )?(?:do not|never|not|but not) (?:\w+ ){0,2}(?:under|below|beneath|lower than) (?:it|that|this)\b|"
    r"at (?:the )?(?:very |absolute )?least\b|plus\b|"
    r"(?:,? ?and )?(?:absolutely )?(?:no|not|never)(?: \w+){0,2} (?:less|lower|softer|under|below)\b|"
    r"(?:is|as|being)(?: \w+){0,3} (?:minimum|min|floor|least)\b|(?:floor)\b|"
    r"(?:(?:an?|the|my|your|as|is|as an?|as the) )*lower (?:\w+ )?(?:bound|limit|end)\b|"
    r"(?:(?:is|was|were|would be|are|will be|will|proved|turned out) )?(?:(?:to be )?not (?:do|enough)|(?:just |way |far )?too (?:little|light|soft|low|weak))|"
    rf"(?:it|they|the \w+) (?:still |just |already )?{_SLIPS}\b)" + _OTHERS
)
_MOST_SOMEWHERE = re.compile(
    r"\b(?:cut ?-?offs?|saturate at|clip(?:ped)? at|(?:not|never)(?: \w+){0,4} reach(?:es)?|before it reaches|back off at|the most (?:i|you|we|it|that)|upper (?:\w+ )?(?:bound|limit|end)|ceiling|red line|draw the line|top of (?:what|the|its)|bounded above|"
    r"maximum|(?:not|without|never|avoid)(?: to)?(?: be(?:ing)?)? (?:exceed|surpass)\w*|(?:not|never|nor)\b.{0,30}\b(?:pass|past|exceed|over|above|beyond|surpass|cross) (?:it|that|this)\b|"
    r"(?:remain|stay|keep|stop|be)\w* (?:it )?(?:just |well |safely )?(?:below|under|short of|beneath) (?:it|that|this)\b|as (?:a|the|an) (?:ceiling|cap|maximum|upper))"
)
_LEAST_SOMEWHERE = re.compile(
    r"\b(?:the least (?:i|you|we|it|that)|lower (?:\w+ )?(?:bound|limit|end)|minimum|"
    r"(?:not|never|nor)\b.{0,30}\b(?:below|under|beneath|short of|less than|lower than) (?:it|that|this)\b|"
    r"(?:remain|stay|keep|be)\w* (?:it )?(?:just |well |safely )?(?:above|over) (?:it|that|this)\b|as (?:a|the) (?:floor|minimum|lower))"
)
_EITHER_WAY = re.compile(
    r"\b(?:more or less|less or more|harder (?:or|nor) softer|softer (?:or|nor) harder|higher (?:or|nor) lower|lower (?:or|nor) higher|"
    r"above (?:or|nor) below|below (?:or|nor) above|over (?:or|nor) under|under (?:or|nor) over|firmer (?:or|nor) softer|softer (?:or|nor) firmer)(?: than)?\s*$"
)
_THAT_AFTER = re.compile(
    r"[^.;#\d]{0,40}?\b(below|under|beneath|above|over) (?:that|it)\b(?! (?:goes|is|will))"
)
_EXACT_AFTER = re.compile(
    r"[.,;:]?\s*(?:and )?(?:(?:not|no) (?:a \w+ )?(?:more|higher|harder)(?:,| and| or|\.)* ?(?:not|no|nor) "
    r"(?:a \w+ )?(?:less|lower|softer)|(?:not|no) (?:a \w+ )?(?:less|lower|softer)(?:,| and| or|\.)* ?(?:not|no|nor) "
    r"(?:a \w+ )?(?:more|higher|harder)|neither (?:more|harder|firmer|higher) nor (?:less|softer|lower|gentler)|"
    r"neither (?:less|softer|lower|gentler) nor (?:more|harder|firmer|higher)|no (?:more|less) and no (?:less|more))"
)
_NOT = re.compile(
    r"\b(?:not|no|never|none|nothing|nowhere|without|nor|neither|avoid\w*|refrain|refuse|forbid\w*|stop|"
    r"prevent\w*|keep(?: \w+){0,4} from|rather than|hardly|nobody)\b"
)
_IF = re.compile(r"(?<!appreciate it )(?<!like it )(?<!good )\bif (?:you|it|the \w+)\b")
_DROPPED = re.compile(
    r"\b(?:not|never|instead of|rather than|forget(?: about)?|isn't|skip|no longer|nor)(?: (?:at|the|with|use|using|to|about|exactly))*\s*$"
)
_NOT_WITH = re.compile(
    rf"\b(?<!why )(?<!why do )(?:{NO_CASE}|not(?! you (?:just |please )?(?:use|hold|keep|grip|grasp|take|try|go|apply)\b)|never|no|avoid\w*|refrain from)"
    r"(?: (?:ever|want|like|dare|you|to|hold|keep|grip|grasp|pinch|pick|take|lift|set|go|apply|use|using|it|this|that|the|"
    r"(?:straw ?)?berry|fruit|one|at|with|a|force|of|for|exactly|about|around|in|within|between|from))*\s*$"
)
"""Before a force: it is not to be used."""

_OUTSIDE = re.compile(
    r"\b(?:outside|out of|beyond|apart from|other than|except(?: for)?|exclud(?:e|es|ing))(?: of)?(?: the)?(?: (?:force )?(?:range|window|band|interval))?(?: of| from| between)?\s*$"
)
"""Before a range: it is not to be used."""

_RISE = re.compile(
    r"\b(?:bring|take|raise|get|ramp|crank|turn|increase|dial|build|work|go)(?: (?:it|this|that|the \w+))?\s*$"
)
_BETWEEN = re.compile(
    rf"\bbetween(?: (?:the|a|some\w*|about))* {MARK}(?: \w+)? and(?: (?:the|a|about))*\s*$"
)
_CORRECTION = re.compile(
    r"\b(?:no,? wait|wait,? no|make (?:that|it)|i mean|i meant|correction|scratch that|in other words|i\.e\.|meaning|or rather|sorry|actually)\b[ ,:-]*"
)
_PAST = re.compile(
    r"\b(?:last (?:time|one|run|trial|try|berry)|yesterday|previous(?:ly)?|before|earlier|used to|was|were|had|"
    r"slipped|slid|crushed|squashed|bruised|dropped|tried|went|did)\b"
)
_STOPS_SHORT = re.compile(
    r"\bstop(?:s|ping)?(?: (?!squeez|press|grip|hold)\w+){0,2}? (?:short of|shy of|before|below|under|beneath)(?: (?:about|around|roughly|the|a))?\s*$"
)
_NOT_STOPPING = re.compile(r"\b(?:not|never|without|no)(?: \w+){0,2} $")
_HARMED = re.compile(
    rf"\b{_HARMS}(?: \w+){{0,3}} (?:above|over|beyond|past|at|from|with more than|after)\s*$"
)
_SLIPPING = re.compile(
    rf"(?:^|[,;:]|\b(?:it|berry|fruit|one|this|thing|they|and|or|but|these|berries)) ?{_SLIPS}(?: \w+){{0,3}} (?:under|below|at|with|with less than)\s*$"
)
_TOO_MUCH = re.compile(
    rf"[^.;#]{{0,20}}\b(?:too much|out of|no go|not ok\w*|pointless|useless|no (?:use|sense|point|need|good)|wast\w+|{_UNWANTED}|(?:not|never) (?:be )?(?:needed|necessary|required|called for|wise|good|wanted|used)|{_HARMS})"
)
_TOO_LITTLE = re.compile(
    rf"[^.;#]{{0,20}}\b(?:will not do|not (?:allowed|acceptable|permitted|ok\w*|on)|forbidden|banned|not (?:enough|sufficient)|too little|insufficient|useless|will not hold|no good|not acceptable|{_SLIPS}|let it)"
)
_FORCE_WORD = re.compile(
    r"(?:\b(?:with|apply|applying|use|using|at|to|about|around|roughly|exactly|than|most|least|under|over|above|"
    r"below|exceed\w*|max\w*\.?|min\w*\.?|limit\w*|force|of|between|from|set|just|only|approximately|nearly|by)|"
    r"[:=<>≤≥~])(?: (?:a|an|the|about|around|roughly|exactly|just|only|some))?\s*$"
)
_MASS_WORD = re.compile(r"\b(?:weigh\w*|mass|heavy|scale|berry of|fruit of)\b[^.;]*$")
_THING = re.compile(
    r"\s*-?\s*(?:heavy )?(?:\w+ )?(?:berry|berries|strawberry|fruit|one|piece|object|thing|specimen|heavy|in weight)\b"
)


def read_quantities(text: str) -> Quantities:
    """Read the numbers of a plain text (``policies.instructions.text.plain``)."""
    text = _ELLIPSIS.sub(r"no \2 than \3 \1", in_digits(text))
    text = re.sub(rf"({NUMBER}), (?=newtons?\b)", r"\1 ", text)
    text = re.sub(r"(?<=\d)['\u00a0\u202f ](?=\d{3}\b(?! ?mm))", "", text)  # 1 400 mN
    text = re.sub(rf"({NUMBER})\s?-?ish\b", r"\1", text)
    text = re.sub(rf"({NUMBER}) ?\(((?:{UNIT}))\)", r"\1 \2", text)
    text = re.sub(rf"(\d)\.\s*(?=(?:{UNIT})\b)", r"\1 ", text)  # '5. N'
    text, lone = without_lone(with_plain_tolerances(text))
    text = with_plain_bounds(text)
    text = _CHAIN.sub(r"between \1 and \2 \3", text)
    text = _PAIR.sub(r"between \1 and \2 \3", text)
    unread = unknown_force(text)
    text, unitless = written_out(text)
    pressure = _PRESSURE.search(text)
    slip_mm, depth_mm = _lengths(text)
    area = _AREA.search(text)
    delta_n, text = _delta(text)
    forces, denied, text = _forces(text)
    before_factor = text
    factor, factor_words, text = _factor(text)
    if factor is not None and not forces:
        denied = denied or _denied_factor(before_factor, factor, factor_words)
    is_alone = factor is None and area is None
    percentage = _PERCENT_OF_NOTHING.search(text) if is_alone else None
    place = _PLACE.search(text)
    return Quantities(
        forces=tuple(forces),
        delta_n=delta_n,
        factor=factor,
        factor_words=factor_words,
        slip_mm=slip_mm,
        depth_mm=depth_mm,
        area_fraction=None if area is None else number(area["a"]) / 100,
        pressure="" if pressure is None else pressure[0],
        unitless=unitless,
        unread=unread,
        percentage=lone if percentage is None else percentage[1],
        place="" if place is None else place[0],
        denied=denied,
        rest=text,
    )


def _delta(text: str) -> tuple[float | None, str]:
    """Force to add to the task's [N], and the text without it."""
    one = rf"(?P<a>{NUMBER})\s*(?P<u>(?:{UNIT})\b)"
    for pattern, sign in (
        (
            rf"{one} (?:more|harder|firmer|tighter|extra|higher|above|over)(?= (?:than |the |your )*(?:usual|normal|standard|default|last|before|that)|[.,!]*$| please)",
            1,
        ),
        (
            rf"{one} (?:less|softer|gentler|lighter|lower|looser|below|under)(?= (?:than |the |your )*(?:usual|normal|standard|default|last|before|that)|[.,!]*$| please)",
            -1,
        ),
        (
            rf"\b(?:add|plus|another|an extra|increase(?: \w+){{0,3}} by|raise(?: \w+){{0,3}} by|up(?: \w+){{0,3}} by) {one}",
            1,
        ),
        (
            rf"\b(?:subtract|take off|(?:reduce|lower|decrease|drop|cut)(?: \w+){{0,3}} by) {one}",
            -1,
        ),
    ):
        if match := re.search(pattern, text):
            rest = f"{text[: match.start()]} {MARK} {text[match.end() :]}"
            return sign * in_newtons(match["a"], match["u"]), " ".join(rest.split())
    return None, text


def _forces(text: str) -> tuple[list[Force], str, str]:
    """Forces of a text, words of the one that it only denies, the text with ``MARK`` for each."""
    denied = ""
    found: list[tuple[Force, bool]] = []  # a force, and whether it is of the past or denied
    rest, end = "", 0
    for start, stop, ends, within_n in _matches(text):
        left, right = text[end:start], text[stop:]
        words = text[start:stop].strip()
        if found and len(ends) == 1 and _BETWEEN.search(" ".join(f"{rest}{left}".split())):
            other = found.pop()[0]
            low, high = sorted((other.value_n, ends[0]))
            words = f"{other.words} to {words}"
            found += [
                (Force(kind="least", value_n=low, words=words), True),
                (Force(kind="most", value_n=high, words=words), True),
            ]
        elif len(ends) == 2:
            low, high = sorted(ends)
            is_outside = bool(_OUTSIDE.search(left)) and not _NOT.search(left)
            kept = not (_DROPPED.search(left) or is_outside)
            if not kept or _NOT_WITH.search(left):
                kept, denied = False, words
            found += [
                (Force(kind="least", value_n=low, words=words), kept),
                (Force(kind="most", value_n=high, words=words), kept),
            ]
        else:
            kind, left_cut, right_cut = _relation(left, right)
            words = (
                f"{left[left_cut:]}{words}{right[:right_cut]}".strip(" ,:")
                .removeprefix("- ")
                .rstrip(" -")
            )
            left, stop = left[:left_cut], stop + right_cut
            before = re.split(r"[.;,]\s|\bbut\b", left)[-1]
            after = re.split(r"[.;,]\s?|\b(?:instead of|rather than)\b", text[stop:], maxsplit=1)[0]
            clause = before + after
            is_denied = kind == "value" and bool(_DROPPED.search(left) or _NOT.search(before))
            if _CORRECTION.search(left) or _CORRECTION.match(text[stop:].lstrip(" .,;-–—")):
                is_denied = is_denied or not _CORRECTION.search(left)
                if _CORRECTION.search(left):
                    if kind == "value":
                        kind = _kind_corrected([force for force, _ in found])
                    found = [(force, False) for force, _ in found]
            kept = not (_PAST.search(clause) or is_denied)
            if kind == "value" and _NOT_WITH.search(left):
                denied = words
            force = Force(kind=kind, value_n=ends[0], words=words, within_n=within_n)
            found.append((force, kept))
        rest, end = f"{rest}{left} {MARK} ", stop
    rest = " ".join((rest + text[end:]).split())
    kept_forces = [force for force, kept in found if kept]
    if denied and not kept_forces:
        return [], denied, rest
    kept_forces = kept_forces or [force for force, _ in found]
    bounds = {force.value_n for force in kept_forces if force.kind != "value"}
    return [f for f in kept_forces if f.kind != "value" or f.value_n not in bounds], "", rest


def _kind_corrected(found: list[Force]) -> Kind:
    """Kind of the force that a bare one corrects: 'at most 2 N, make that 1 N' is at most 1 N."""
    if not found or (len(found) > 1 and found[-2].words == found[-1].words):  # a range
        return "value"
    return found[-1].kind


def _matches(text: str) -> Iterator[tuple[int, int, list[float], tuple[float, float] | None]]:
    """Begin, end, forces and tolerance [N] of every range and single force, in order."""
    at = 0
    while at < len(text):
        span = _RANGE.search(text, at)
        one = _FORCE.search(text, at)
        if span and (not one or span.start() <= one.start()) and _is_range(span, text):
            unit = span["ub"]
            first = span["ua"] or unit
            yield (
                span.start(),
                span.end(),
                [in_newtons(span["a"], first), in_newtons(span["b"], unit)],
                None,
            )
            at = span.end()
        elif one:
            if _is_force(one, text):
                yield one.start(), one.end(), [in_newtons(one["a"], one["ua"])], band_of(one)
            at = one.end()
        else:
            return


def _is_range(match: re.Match[str], text: str) -> bool:
    link = match["link"].strip()
    if link in ("and", ","):
        before = match["pre"] or ""
        return "[" in before or (link == "and" and bool(before))
    if not _is_loose(match["ub"]):
        return True
    return bool(_FORCE_WORD.search(text[: match.start()]) or match["pre"])


def _is_force(match: re.Match[str], text: str) -> bool:
    if not _is_loose(match["ua"]):
        return True
    left, right = text[: match.start()], text[match.end() :]
    if not left and re.fullmatch(r"(?:,? please)?[ .!]*", right):
        return True  # nothing else is said
    if re.search(r"\b(?:force|press\w*|squeez\w*|push\w*)\b.*\bweight of\s*$", left):
        return True
    return (
        bool(_FORCE_WORD.search(left)) and not _MASS_WORD.search(left) and not _THING.match(right)
    )


def _is_loose(unit: str) -> bool:
    return not re.fullmatch(UNIT, unit)


def _relation(left: str, right: str) -> tuple[Kind, int, int]:
    """Kind of a force, and how much of the text on either side says so."""
    if match := _THAT_AFTER.match(right):
        return ("most" if match[1] in ("below", "under", "beneath") else "least"), len(left), 0
    if _EITHER_WAY.search(left):
        return "value", len(left), 0
    if exact := _EXACT_AFTER.match(right):
        return "value", len(left), exact.end()
    if match := _STOPS_SHORT.search(left):
        return (
            ("least" if _NOT_STOPPING.search(left[: match.start()]) else "most"),
            match.start(),
            0,
        )
    for pattern, plainly, denied, harm in (
        (_ABOVE, "least", "most", _TOO_MUCH),
        (_BELOW, "most", "least", _TOO_LITTLE),
    ):
        if match := pattern.search(left):
            clause_start = max(
                (m.end() for m in re.finditer(r"[.;:,]\s|\bso\b|\bbut\b", left[: match.start()])),
                default=0,
            )
            denial = list(_NOT.finditer(left, clause_start, match.end())) or list(
                _IF.finditer(left, clause_start, match.end())
            )
            stated = _HARMED if pattern is _ABOVE else _SLIPPING
            is_denied = len(denial) % 2 == 1 or bool(harm.match(right)) or bool(stated.search(left))
            start = denial[0].start() if len(denial) % 2 == 1 else match.start()
            return (denied if is_denied else plainly), start, 0  # type: ignore[return-value]
    if match := _HARMED.search(left):
        return "most", match.start(), 0
    if match := _SLIPPING.search(left):
        return "least", match.start(), 0
    most, least = _MOST.search(left), _LEAST.search(left)
    if most and most.group().startswith("up to") and _RISE.search(left[: most.start()]):
        most = None  # 'bring it up to 1.4 N'
    if most and (not least or most.start() < least.start()):
        return "most", most.start(), 0
    if least:
        return "least", least.start(), 0
    if match := _MOST_AFTER.match(right):
        return "most", len(left), match.end()
    if match := _LEAST_AFTER.match(right):
        return "least", len(left), match.end()
    after = re.split(r"[.!?](?:\s|$)|#", right)[0]
    after = "" if re.search(r"\d", after) else after  # it belongs to the next force
    sentence = re.split(r"[.;!?]\s|#", left)[-1] + " # " + after
    if _MOST_SOMEWHERE.search(sentence):
        return "most", len(left), 0
    if _LEAST_SOMEWHERE.search(sentence):
        return "least", len(left), 0
    return "value", len(left), 0


_THAN = re.compile(r"\b(?:more|harder|firmer|tighter|higher|over|above|exceed\w*)(?: than)?\s*$")
"""Before a factor that bounds: 'no more than twice the usual force'."""
_AT_MOST = re.compile(
    r"\b(?:(?:no|not|n't|never) (?:\w+ ){0,3}?(?:more|harder|firmer|tighter|higher) than|at (?:the )?most|"
    r"up to|maximum(?: of)?|less than|below|under|not over|not above|without exceeding) (?:about )?$"
)
_USUAL = r"(?:the |your |its |that |what (?:you|is) |our |as )"
_HOW = r"(?:hard|firm(?:ly)?|tight(?:ly)?|strong(?:ly)?|much|gentl[ey]|soft(?:ly)?|light(?:ly)?|forceful(?:ly)?)"
_UP = r"(?:more|harder|firmer|tighter|stronger|higher|above|extra|over|up|heavier)"
_DOWN = r"(?:less|softer|gentler|lighter|weaker|lower|below|under|looser|down|fewer)"
_GO_UP = r"(?:increase|raise|up|boost|turn up|crank up|bump|dial up|strengthen|tighten|add)"
_GO_DOWN = r"(?:reduce|lower|decrease|cut|drop|turn down|dial down|ease|back off|loosen|scale back|bring down|lessen|down)"
_FRACTION = r"(?:(?P<n>an?|one|two|three|\d) (?P<d>half|third|quarter|fifth|tenth)s?|(?P<h>half))"
_MULTIPLE = rf"(?:(?P<x>{NUMBER})\s*(?:times|x|×)|\b(?P<w>twice|double|thrice|triple)) "
_DENOMINATORS = {"half": 2, "third": 3, "quarter": 4, "fifth": 5, "tenth": 10}


def _factor(text: str) -> tuple[float | None, str, str]:
    """Factor on the task's force that a text names, its words, and the text without them."""
    percent = rf"(?P<p>{NUMBER})\s*(?:%|percent|per cent)"
    for pattern, value in (
        (rf"\b(?:{_GO_UP}|{_UP})\b[^.;#]{{0,40}}?by (?:about |around )?(?:a )?half\b", lambda m: 1.5),
        (rf"half (?:again as {_HOW}|as {_HOW} again)", lambda m: 1.5),
        (rf"(?P<x>{NUMBER})\s*(?:times|x|×) (?:as {_HOW}|{_USUAL})(?: as)?", lambda m: number(m["x"])),
        (rf"{_MULTIPLE}{_UP}\b", _multiple),
        (rf"{_MULTIPLE}{_DOWN}\b", lambda m: 1 / _multiple(m) if _multiple(m) else 0.0),
        (rf"(?:twice|double|2 times|two times) (?:as {_HOW}|{_USUAL})|\bdouble (?:up )?(?:the|your)", lambda m: 2.0),
        (rf"(?:three times|triple|thrice) (?:as {_HOW}|{_USUAL})|\btriple (?:the|your)", lambda m: 3.0),
        (rf"(?:half|0\.5) as {_HOW}|\bhalf {_USUAL}|\bhalf (?:of )?{_USUAL}|\b(?:in|by) half\b|\bhalve\b|\bhalf (?:the )?(?:force|grip|strength|pressure|power|squeeze)", lambda m: 0.5),
        (rf"(?:another|an extra|extra|additional|add|plus) {NUMBER}\s*(?:%|percent|per cent)|{NUMBER}\s*(?:%|percent|per cent) (?:on top|extra)", lambda m: 1 + _percent(m) / 100),
        (r"\bto (?:about |around |roughly )?half\b", lambda m: 0.5),
        (rf"{percent} {_UP}", lambda m: 1 + number(m["p"]) / 100),
        (rf"{percent} {_DOWN}", lambda m: 1 - number(m["p"]) / 100),
        (rf"\b(?:{_GO_UP}|{_UP})\b[^.;#]{{0,40}}?by (?:about |around )?{percent}", lambda m: 1 + number(m["p"]) / 100),
        (rf"\b(?:{_GO_DOWN}|{_DOWN})\b[^.;#]{{0,40}}?by (?:about |around )?{percent}", lambda m: 1 - number(m["p"]) / 100),
        (rf"{percent} (?:of )?(?:{_USUAL}|usual|normal|full|standard|default)", lambda m: number(m["p"]) / 100),
        (rf"{_FRACTION} {_UP}", lambda m: 1 + _part(m)),
        (rf"{_FRACTION} {_DOWN}", lambda m: 1 - _part(m)),
        (rf"\b(?:{_GO_UP}|{_UP})\b[^.;#]{{0,40}}?by (?:about |around )?{_FRACTION}", lambda m: 1 + _part(m)),
        (rf"\b(?:{_GO_DOWN}|{_DOWN})\b[^.;#]{{0,40}}?by (?:about |around )?{_FRACTION}", lambda m: 1 - _part(m)),
        (rf"{_FRACTION} (?:of )?(?:{_USUAL}|usual|normal|standard|default)", lambda m: _part(m)),
    ):  # fmt: skip
        if match := re.search(pattern, text):
            factor = value(match)
            if factor > 1 and re.search(r"\bas (?:gent|soft|light)", match[0]):
                factor = 1 / factor  # 'twice as gently'
            if factor > 1 and _AT_MOST.search(text[: match.start()]):
                factor = 1.0  # 'no more than twice the usual force' asks for no more than usual
            return factor, match[0], text[: match.start()] + f" {MARK} " + text[match.end() :]
    return None, "", text


def _denied_factor(text: str, factor: float, words: str) -> str:
    """The words of a factor above 1 that is not to be used ('never twice as hard'); '' for none."""
    before = re.split(r"[.;:,]\s|\b(?:but|and)\b", text[: text.find(words)])[-1]
    before = re.sub(r"\b(?:not|never) (?:hesitate|forget|fail|be afraid)\b", "", before)
    is_denied = len(_NOT.findall(before)) % 2 == 1 and not _THAN.search(before)
    return words.strip() if factor > 1 and is_denied else ""


def _percent(match: re.Match[str]) -> float:
    return number(re.findall(NUMBER, match[0])[0])


def _multiple(match: re.Match[str]) -> float:
    if match["x"]:
        return number(match["x"])
    return 2.0 if match["w"] in ("twice", "double") else 3.0


def _part(match: re.Match[str]) -> float:
    if match["h"]:
        return 0.5
    count = {"two": 2, "three": 3}.get(match["n"]) or (
        int(match["n"]) if match["n"].isdigit() else 1
    )
    return count / _DENOMINATORS[match["d"]]


_CLAUSE_END = re.compile(r"[,;.]\s|\band\b")
_SLIP = re.compile(r"\b(?:slip|slid|shift|creep|mov(?:e|ement) (?:by )?(?:more|at most))")
_DEEP = re.compile(r"\b(?:deep|depth|indent|into the gel|sink)")


def _lengths(text: str) -> tuple[float | None, float | None]:
    """Slip and depth that a text names [mm]."""
    slip = depth = None
    for match in _LENGTH.finditer(text):
        mm = number(match["a"]) * (
            1e-3 if match["u"][0] in "µμu" or match["u"].startswith("mic") else 1.0
        )
        left, right = text[max(0, match.start() - 40) : match.start()], text[match.end() :][:25]
        clause = f"{_CLAUSE_END.split(left)[-1]}#{_CLAUSE_END.split(right)[0]}"
        for around in (clause, left + right):
            if _SLIP.search(around):
                slip = mm
                break
            if _DEEP.search(around):
                depth = mm
                break
    return slip, depth
