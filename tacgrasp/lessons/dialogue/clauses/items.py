"""Things that a list asks for, each known by its words: 'grip force in newtons', 'whereabouts'.

    depth mm                                the depth in mm
    how many newtons we're applying         the force in N
    what form the object has                the shape
    whether anything is in contact          yes or no

Not here: the list (``tacgrasp.lessons.dialogue.clauses.lists``).
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from tacgrasp.lessons.dialogue.calculations.amounts import amount_of
from tacgrasp.lessons.dialogue.calculations.asked import asked_words
from tacgrasp.lessons.dialogue.calculations.quantity_names import UNIT, unit_of
from tacgrasp.lessons.dialogue.clauses.conditions import condition_of_statement
from tacgrasp.lessons.dialogue.clauses.plain_clause import numbered
from tacgrasp.lessons.dialogue.clauses.vocabulary import FILLERS
from tacgrasp.lessons.dialogue.clauses.word_sets import words_of
from tacgrasp.lessons.dialogue.meaning import Amount, Calculated, Part, Which
from tacgrasp.lessons.dialogue.quantities import QUANTITIES, UNITS, can_be_in

_ASKING = words_of(
    "what which how much many big large is say says tell give state report name quote show list "
    "finally also then next please value reading figure number amount measured felt feel feels "
    "exact exactly estimate estimated would you think there s readout rough roughly approximately "
    "approx about plain whole kindly current present describe me us if"
)
_PADS = "pad gel sensor skin surface fingertip finger contact"


@dataclass(frozen=True, slots=True)
class _Item:
    """Something that may be asked for.

    Attributes:
        name: Name of the quantity, or of the word of a scene.
        marks: What must stand in it.
        known: Words that may stand beside.
        units: Units in which it is counted; none of a word.
    """

    name: str
    marks: str
    known: frozenset[str]
    units: str = ""


def _item(name: str, marks: str, known: str, units: str = "") -> _Item:
    return _Item(name, marks, words_of(known) | _ASKING, units)


MOST_WORDS = 14
"""Longest item [words]. Our choice: a longer one says more than what is asked for."""

_BAND = "band range window corridor target wanted goal force desired set end edge bound limit of"
_ITEMS = (
    _item("depth_word", r"\b(?:depth|indentation|press)\b.*\b(?:class|category|word|grade|label|"
                        r"level|words)\b|\b(?:class|category|word|grade|label)\b.*"
                        r"\b(?:depth|indentation|press)\b",
          "depth indentation press class category word grade label level words in of imprint"),
    _item("area_word", r"\b(?:area|size|coverage|patch)\b.*\b(?:class|category|word|grade|label|"
                       r"words)\b|\b(?:class|category|word|grade)\b.*\b(?:area|size|patch)\b",
          f"{_PADS} area size coverage patch class category word grade label words in of imprint"),
    _item("force_band", r"\b(?:band|range|window|corridor)\b.*\b(?:status|state|verdict|"
                        r"position|standing|"
          r"check|flag)\b|\b(?:status|state|verdict|standing)\b.*\b(?:band|range|window|"
          r"corridor)\b|\bwhere\b.*\b(?:band|range|window)\b|\b(?:below|under)\b.*\b(?:within|in|"
          r"inside)\b.*\b(?:above|over)\b.*\b(?:band|range|"
          r"window)\b",
          f"{_BAND} status state verdict standing check flag below under within in inside above "
          "over or "
          "where force grip squeeze versus vs against relative compared sits lies position"),
    _item("action", r"\b(?:next (?:step|move|action)|(?:advice|recommendation|suggestion)|"
                    r"what to do(?: next)?)\b",
          "next step move action advice recommendation suggestion do to should i we advised "
          "recommended"),
    _item("wholeness", r"\b(?:cut|clipped|cropped) or (?:whole|complete|not)\b|"
                       r"\bwhole or (?:cut|clipped)\b",
          "cut clipped cropped or whole complete not off edge"),
    _item("worse_axis", r"\bworse (?:axis|offset|direction)\b", "worse axis offset direction"),
    _item("side_x", r"\bleft or (?:the )?right\b|\bside\b.*\b(?:horizontal\w*|sideways)\b",
          "left right or side half of horizontally horizontal sideways leans lean center middle"),
    _item("side_y", r"\bpalm(?: side)? or (?:the )?(?:finger)?tip\b|"
                    r"\bside\b.*\b(?:vertical\w*|lengthwise)\b",
          "palm tip fingertip or side half of vertically vertical lengthwise leans lean nearer "
          "closer center middle"),
    _item("texture", r"\b(?:texture|finish|grain|roughness)\b|\bsurface (?:feel|type|quality|"
                     r"kind|relief)\b|"
          r"\bfeel\b$|^(?:the )?surface$|\bkind of surface\b|\bhow (?:it|the surface|"
          r"its surface) feels\b|"
          r"\bhow (?:does it|does the surface) feel\b|\bfeel of\b|\bwhat the surface is like\b",
          "texture finish grain surface feel feels type quality kind sort relief of skin like "
          "outside "
          "touch roughness pattern has have"),
    _item("shape", r"\b(?:shape|form|outline|figure|geometry|silhouette|contour|profile)\b",
          "shape form outline figure geometry silhouette contour profile kind sort of has have got "
          "local object's touched touching gripped held pressed holding gripping feeling "
          "contact shaped"),
    _item("distance", r"\b(?:distance|far|offset|off|away|eccentricity|radius)\b.*\b(?:center|"
                      r"middle)\b|"
          r"\b(?:off|from) center\b|\bradial offset\b|\beccentricity\b|\boff center distance\b",
          f"{_PADS} distance far offset off away eccentricity center middle from to radial "
          "straight line of",
          "mm µm cm"),
    _item("x", r"\bx\b", "x offset coordinate position value of sideways horizontal", "mm µm cm"),
    _item("y", r"\by\b", "y offset coordinate position value of lengthwise vertical", "mm µm cm"),
    _item("position", r"\b(?:where|whereabouts|position|place|spot|location|cell|sector|region|"
                      r"zone)\b",
          f"{_PADS} where whereabouts position place spot location cell sector region zone touches "
          "touching "
          "touched sits lies "
          "is located on of presses meets landed pressed presses lands"),
    _item("depth", r"\b(?:depth|deep|indentation|dent|penetration|indented|sunk)\b|"
          r"\b(?:press\w*|push\w*|goes|gone|dug|squashed|squished|compressed)\b.*\b(?:in|into|down|"
          r"far)\b|"
          r"\bfar (?:in|down|into)\b",
          f"{_PADS} depth deep indentation dent penetration indented sunk pressed press presses "
          "pushed goes gone in into down far dug squashed squished compressed maximum max peak "
          "deepest of "
          "rubber",
          "mm µm cm"),
    _item("area", r"\b(?:area|coverage|footprint|patch)\b|\b(?:cover\w*|touched|occupied|"
                  r"contact)\b.*"
          r"\b(?:percent|percentage|pad|share)\b|\b(?:percent|percentage|share|much) of (?:the |"
          r"your |our )?"
          r"(?:pad|sensor|gel)\b",
          f"{_PADS} area coverage footprint patch size covers covered cover touched touches "
          "occupied percent "
          "percentage share fraction part of pressed taken up take takes fills spans", "% mm² cm²"),
    _item("holds", r"\b(?:hold|holds|carry|carries|lift|lifts|bear|support|hang|"
                   r"keep)\b(?=.*\b(?:g|grams?|kg|kilos?|kilograms?)\b)|"
          r"\b(?:g|grams?|kg|kilos?|kilograms?)\b.*\b(?:hold|holds|carry|carries|lift|lifts|bear|"
          r"support|hang|keep)\b|"
          r"\b(?:payload|capacity|sure load|safe load|load it holds)\b",
          "hold holds carry carries lift lifts bear support payload capacity load hang keep surely "
          "sure certain certainly safely safe grip grasp squeeze most maximum max heaviest mass "
          "weight "
          "guaranteed definitely for without slipping secure securely able up reliably",
          "g kg oz lb"),
    _item("headroom", r"\b(?:headroom|margin|room|left|reserve|remaining)\b.*\b(?:limit|"
                      r"ceiling)\b|\bheadroom\b|"
          r"\bmargin\b", "headroom margin room left reserve remaining limit ceiling force under "
                         "below to",
          "N mN"),
    _item("used", r"\b(?:percent|share|percentage)\b.*\blimit\b", "share percentage of limit "
        "force used use", "%"),
    _item("limit", r"\b(?:limit|ceiling)\b",
          "limit ceiling force hard maximum allowed permitted", "N mN"),
    _item("band_low", r"\b(?:lower|low|bottom|minimum|least)\b",
          f"{_BAND} lower low bottom minimum least", "N mN"),
    _item("band_high", r"\b(?:upper|high|top|maximum|most)\b",
          f"{_BAND} upper high top maximum most", "N mN"),
    _item("mass", r"\b(?:mass|weight|weighs|heavy)\b", "mass weight weighs heavy of object "
                                                       "given stated told agreed", "g kg oz lb"),
    _item("force", r"\b(?:force|squeez\w*|grip\w*|pinch\w*|clamp\w*|push\w*|press\w*|hard|"
                   r"strong\w*|(?:milli|centi)?newtons?|n|mn)\b",
          "force grip gripping squeeze squeezing pinch clamp clamping pushing pressing press "
          "pressure hard strong strongly strength firmly apply applying applied exert exerting "
          "exerted contact normal holding held with put putting on onto use using used go going "
          "are being "
          f"{_PADS}", "N mN cN g kg kgf lbf ozf"),
)  # fmt: skip
_UNIT = re.compile(
    rf"(?:\b(?:in|as|how many|how much) )?(?:\b(?:plain|whole|full) )?\b(?P<unit>{UNIT})\b"
)
_WHETHER = re.compile(
    r"(?:(?:tell me|say|also|and|state|then|confirm) )*(?:whether(?: or not)?|if) (?P<stated>.+)",
    re.I,
)
_VERB_FIRST = re.compile(
    r"(?:is|are|was|does|do|has|have|can|could|will|would|isn['’]t|aren['’]t|doesn['’]t|"
    r"anything|something|nothing) ",
    re.I,
)
_CIRCUMSTANCE = re.compile(
    r"(?:going by|given|at|with|under|from|based on|considering|knowing|so|so that|because|since|"
    r"if|that|about|regarding|as for|concerning|by|like|not|no|or|than|hang on|hold on|but|while|"
    r"of|per|until|till|"
    r"unless|without|within)\b(?! (?:what|which|how|where))",
    re.I,
)
"""What a part of a question begins with that asks for nothing of its own."""

_REFERS = re.compile(
    r"\b(?:of|than|to|from|below|above|until|with) (?:it|that|this|them|these|those)\b", re.I
)
_WISHED = re.compile(r"\b(?:should|must|ought|need|needs|needed|could we)\b", re.I)
_YES_NO = re.compile(r",? (?:yes(?:/| or )no|y(?:/| or )n|true or false|or not)$", re.I)


def item_of(text: str) -> Part | None:
    """What one place of a list asks for; None where a word of it has no meaning here."""
    text = _YES_NO.sub(" yes or no", text.strip(" .,;:?!"))
    is_verdict = text.endswith(" yes or no")
    text = text.removesuffix(" yes or no")
    if _CIRCUMSTANCE.match(text) or _WISHED.search(text) or _REFERS.search(text):
        return None
    if whether := _WHETHER.fullmatch(text):
        return _check(whether["stated"]) or _named(numbered(whether["stated"])[0])
    words, numbers = numbered(text)
    if is_verdict or _VERB_FIRST.match(text):
        return _check(text)
    if words.count(" ") >= MOST_WORDS:
        return None
    return (None if numbers else _named(words)) or _calculated(text)


def _calculated(text: str) -> Calculated | None:
    """A term that is itself what is asked for: 'the pad's width', 'half of the limit'."""
    asked = asked_words(text)
    term = asked.term(asked.words)
    return amount_of(term, asked) if term else None


def _check(text: str) -> Calculated | None:
    condition = condition_of_statement(text)
    if not condition or re.search(r" or ", condition):
        return None
    return Calculated(truth=condition, unit=None)


def _named(words: str) -> Amount | Which | None:
    """A quantity or a word that is named, in the unit that stands beside."""
    said = [match for match in _UNIT.finditer(words) if not _is_no_unit(match, words)]
    if len(said) > 1:
        return None
    unit = unit_of(said[0]["unit"]) if said else ""
    rest = f"{words[: said[0].start()]} {words[said[0].end() :]}".split() if said else words.split()
    for item in _ITEMS:
        fits = re.search(item.marks, words) and all(
            word in item.known or word in FILLERS for word in rest
        )
        if not fits or bool(unit) > bool(item.units):
            continue
        if not item.units:
            return Which(name=item.name.removesuffix("_word"), is_open=True)
        usual = QUANTITIES[item.name].unit
        if unit and (unit not in item.units.split() or not can_be_in(item.name, unit)):
            continue
        if (
            unit
            and item.name == "force"
            and UNITS[unit].dimension == "mass"
            and "force" not in words
        ):
            continue
        return Amount(quantity=item.name, unit=unit or usual)
    return None


def _is_no_unit(match: re.Match[str], words: str) -> bool:
    """Whether a letter or 'points' is no unit: 'percent of the pad' says what is counted."""
    return match["unit"] in ("points", "point") or (
        match["unit"] == "percent" and words[match.end() :].startswith(" of the limit")
    )
