"""Follow-ups whose pronoun stands for the number that was answered before.

    What is the limit?      Is that more than 2 N?          limit_n > 2
    How deep, in microns?   What would half of that be?     0.5 * depth_mm in µm
    What is the force?      And with 10 % more?             1.1 * force_n
    x in mm?  y too         The sum of both?                x_mm + y_mm

Not here: conditions under a supposed force (``tacgrasp.lessons.turns.supposed``).
"""

from __future__ import annotations

import re
from dataclasses import replace

from tacgrasp.lessons.dialogue.calculations.asked import asked_words
from tacgrasp.lessons.dialogue.calculations.calculated import calculated, calculated_about
from tacgrasp.lessons.dialogue.calculations.terms import PLAIN, Term, alike
from tacgrasp.lessons.dialogue.meaning import Amount, Calculated, Check, Meaning, truth_of
from tacgrasp.lessons.dialogue.plainer import in_words
from tacgrasp.lessons.dialogue.quantities import GRAVITY_N_PER_G, QUANTITIES, UNITS
from tacgrasp.lessons.turns.leads import without_lead
from tacgrasp.lessons.turns.units import TIMES, unit_symbol

_POINTS = re.compile(r"\b(?:that|this|it|those|these|the result|the same)\b", re.I)

_WOULD_BE = (
    r"(?:what (?:would|will|is) be |(?:what|how much|how many \S+|which) (?:would|will|is|does|do|"
    r"are|makes?) )?{}(?: (?:would|will|does|do|is|(?:what|how much) (?:would|will|is)))?(?: it| "
    r"that)?(?: (?:be|make|come to|give|read|mean))?"
)
_AS_MUCH = (
    r"(?: (?:of )?(?:that|it|this|those|the same|as (?:much|many|hard|deep|strong|far|big|large|"
    r"heavy|firm|tight|strongly|firmly)(?: as that)?|the (?:force|depth|grip|amount|value|"
    r"number|mass|area)))?"
)
_MULTIPLE = re.compile(
    _WOULD_BE.format(
        rf"(?:(?P<times>{'|'.join(TIMES)})|(?P<percent>\d+(?:\.\d+)?) ?(?:%|percent)(?= of)|"
        rf"(?P<number>\d+(?:\.\d+)?) times){_AS_MUCH}"
    )
)
_DIMENSIONS = {"force": "force", "grip": "force", "depth": "length", "mass": "mass", "area": "area"}
_NAMED = re.compile(rf"\bthe ({'|'.join(_DIMENSIONS)})$")
"""A quantity that a multiple names itself, and what it measures."""
_SHARE_MORE = re.compile(
    r"(?:(?:what|how much) )?(?:if |with |at |plus |minus )?(?:i |we |you )?(?:(?:add|take off|"
    r"raise it by|increase it by|lower it by|reduce it by|went up|went down|go up|go down)"
    r"(?: by)? )?(?P<share>\d+(?:\.\d+)?) ?(?:%|percent)(?: (?P<way>more|less|harder|softer|"
    r"higher|lower|deeper|firmer|extra|on top|added|off))?(?:,? (?:what|how much) (?:would|will) "
    r"(?:it|that) (?:read|be|give|come to|make))?"
)
_LESS = re.compile(r"\b(?:less|softer|lower|reduce|take off|minus|off|down)\b")

_DIFFERENCE = re.compile(
    r"(?:(?:what is|what's|and|how big is) )?(?:the |their )?(?:difference|gap|distance)"
    r"(?: (?:between|of) (?:the two|them|both|those(?: two)?|these(?: two)?))?|"
    r"how (?:far|much) (?:apart|do) (?:are )?(?:the two|they|those(?: two)?|these(?: two)?|both)"
    r"(?: (?:apart|differ))?|by how much do (?:they|the two) differ"
)
_SUM = re.compile(
    r"(?:(?:what is|what's) )?(?:the |their )?(?:sum|total)(?: of (?:both|the two|them|those|"
    r"these)(?: two)?)?|(?:both|the two|them)(?: added)? (?:together|added(?: up)?|in total)"
)


_PRODUCT = re.compile(
    r"(?:(?:what is|what's|and|so|please) )?(?:(?:multiply|times|multiplying) (?:the two|both|them|"
    r"those(?: two)?|these(?: two)?|one by the other)(?: (?:together|for me|please))*|(?:the |"
    r"their )?"
    r"product(?: of (?:the two|both|them))?|(?:the two|both|them) multiplied)"
)

_SHARES = {"a quarter": "25", "a third": "33.3333", "half": "50", "a half": "50", "a tenth": "10",
         "a fifth": "20", "two thirds": "66.6667", "three quarters": "75"}  # fmt: skip
_PARTS = re.compile(rf"(?<=than )(?:{'|'.join(_SHARES)})\b(?! of)")
_BOUND_TAG = re.compile(
    r"^(?P<bound>(?:over|above|under|below|beyond|past|at least|at most|(?:more|less) than) [^\s,]+"
    r"(?: \w+)?),? (?:is|are|does|do|has|have)(?:n['’]?t)? (?:it|we|that|they)$"
)
"""'Over 80, is it?'"""

_THAT_IS = re.compile(
    r"^(?:that|this|it)(?:['’]s| is) (?P<what>.+?)(?:, is(?:n['’]?t)? (?:it|that)(?: not)?)?$"
)
_OFF = re.compile(
    r"how (?:far|much) (?:off|short|away)(?: (?:am i|are we|is it|is that))?(?:,? in N)?", re.I
)
_HARDER = re.compile(
    r"^(?:are we|am i|is it|do we|do i) (?:press|grip|squeez|hold|push)(?:ing|p?ing|e)? "
    r"(?:with )?(?:it )?(?P<way>more|less|harder|softer)(?: force)? than"
)
_IN_UNIT = re.compile(r",? in (?P<unit>[a-zµ]+2?)$")
_HOW_FAR = re.compile(r"^how (?:far|much) (?P<way>from|off|above|below) (?:it|that)$")
_DISTANCE = re.compile(
    r"(?:(?:what is|what['’]s|the|absolute|its) )*(?:distance|difference|gap|margin) (?:to|from) "
    r"(?P<what>.+?)(?:,? in [a-zµ]+2?)?"
)
_FELT_FORCE = re.compile(
    r"(?:the |our |my )?(?:(?:present|current|actual|felt|measured|applied) )?(?:force|grip|"
    r"squeeze)|"
    r"what (?:we|i|you) (?:have|apply|feel|measure)(?: now)?"
)
_COMPARES = re.compile(
    r"(?:more|less|over|under|above|below|at least|at most|exactly|about|deeper|shallower|higher|"
    r"lower|heavier|lighter|bigger|smaller|stronger|weaker|larger)(?: than)? (?=\d|\.\d|the |our |"
    r"half |twice )|than (?=\d|\.\d)|(?:in )?between (?=\d|\.\d)"
)
_UP_TO = re.compile(r"(?<=between )(?P<low>\d*\.?\d+) and (?P<high>\d*\.?\d+ ?(?P<unit>[a-zµ%²]+))")
"""'Between 0.4 and 0.5 mm', whose first number has the unit too."""

_HAVE_IT = re.compile(
    r"(?:do|are|have) (?:i|we|you)(?: (?:have|apply|press with|reach|reached|got|make|there|at))*"
    r"(?: (?:that|it|this|as)(?: much| many)?)?(?: (?:force|grip|newtons))?"
    r"(?: (?:already|yet|now|there))*|"
    r"(?:are|is) (?:i|we|you|it|the (?:gripper|hand|robot)) (?:grip|press|squeez|hold|push|clamp)"
    r"(?:p?ing)(?: it)? (?:that|this|so) (?:hard|firmly|strongly|much|tight|tightly)"
    r"(?: (?:already|yet|now))*|"
    r"(?:is|would) (?:the|our|my) (?:current |present )?(?:force|grip|squeeze) "
    r"(?:be )?(?:enough|sufficient|do|suffice)(?: for (?:that|it|this))?|"
    r"(?:does|is) (?:that|it|the grip|the force) (?:suffice|enough)"
)
"""'Do we have that much already?', after a force that is needed or agreed."""


_OF_PAD = re.compile(
    r"%|\bpercent\b|\bof (?:the|our|your|its) (?:whole |entire )?(?:pad|gel|sensor|fingertip|"
    r"surface)\b"
)
"""'Is that over a quarter of the pad?', of an area in mm²."""
_OF_GRIP = re.compile(r"\b(?:it|this)\b.*\b(?:hold|lift|carry|slip|drop)\b")
"""'Is it enough to hold it?', which is about the grip and not about a number."""


_OF_ITS_OWN = re.compile(
    r"(?:what|which) (?:\w+ )?(?:force|depth|area|size|indentation|load|squeeze|pressure|position|"
    r"offset|x|y|mass|weight)(?: value| reading)? (?:is it|does it have|do you (?:feel|read))\b"
)
"""'What force is it?' asks for what it names, whatever was asked before."""


def is_multiple(question: str) -> bool:
    """Whether a follow-up asks for nothing but a multiple or a share: 'half of that?'."""
    core = in_words(without_lead(question)).lower().strip(" ?.!")
    return _MULTIPLE.fullmatch(_IN_UNIT.sub("", core)) is not None


def of_number(question: str, about: Meaning | None, earlier: Meaning | None) -> Calculated | None:
    """What a follow-up asks of the number before it; None where it asks for something else.

    Args:
        question: The follow-up.
        about: The number that was asked for before it; None for none.
        earlier: What was asked for before that; None for nothing.
    """
    term, unit = _number(about)
    if term is None:
        return None
    is_bound = term.dimension == "force" and "force_n" not in term.expression
    if is_bound and _OFF.fullmatch(without_lead(question).strip(" ?.!")):
        return Calculated(truth=f"abs(force_n - {term.factor})", unit=unit)
    core = in_words(without_lead(question)).lower().strip(" ?.!")
    if _OF_ITS_OWN.match(core):
        return None
    core = _BOUND_TAG.sub(r"\g<bound>", core)
    core = _THAT_IS.sub(r"is that \g<what>", core)
    if term.dimension == "fraction":
        core = _PARTS.sub(lambda part: f"{_SHARES[part[0]]} %", core)
    core = _HOW_FAR.sub(r"how far is the force \g<way> it", core)
    distance = _DISTANCE.fullmatch(core)
    if distance and is_bound and _FELT_FORCE.fullmatch(distance["what"]):
        return Calculated(truth=f"abs(force_n - {term.factor})", unit=unit)
    if distance:
        core = f"how far is it from {distance['what']}"
    core = _UP_TO.sub(r"\g<low> \g<unit> and \g<high>", core)
    if _COMPARES.match(core):
        core = f"is it {'' if not core.startswith('than') else 'more '}{core}"
    if is_bound and _HAVE_IT.fullmatch(core):
        return Calculated(truth=f"force_n >= {term.factor}", unit=None)
    core = _HARDER.sub(r"is the force \g<way> than", core)
    if term.dimension == "area" and _OF_PAD.search(core):
        of_pad = f"100 * {term.factor} / (pad_width_mm * pad_height_mm)"
        if term.expression == "area_mm2":
            of_pad = "area_percent"
        term, unit = Term(expression=of_pad, dimension="fraction", words="it", is_sum=True), "%"
    if in_unit := _IN_UNIT.search(core):
        unit = unit_symbol(in_unit["unit"]) or unit
        core = core[: in_unit.start()] if _MULTIPLE.fullmatch(core[: in_unit.start()]) else core
    if of_both := _of_both(core, term, earlier):
        return replace(of_both, unit=of_both.unit or unit)
    if found := _MULTIPLE.fullmatch(core):
        if (named := _NAMED.search(core)) and _DIMENSIONS[named[1]] != term.dimension:
            return None  # 'twice the force', after a depth
        factor = TIMES.get(found["times"] or "") or float(
            found["number"] or float(found["percent"] or 100) / 100
        )
        base = term if _POINTS.search(core) else _felt(term, earlier)
        return Calculated(truth=f"{factor:.6g} * {base.factor}", unit=unit)
    if found := _SHARE_MORE.fullmatch(core):
        sign = "-" if _LESS.search(core) else "+"
        if not found["way"] and not re.match(r"(?:what |with |if |plus |minus )", core):
            return None
        share = f"(1 {sign} {float(found['share']):.6g} / 100)"
        truth = f"{share} * {_felt(term, earlier).factor}"
        return Calculated(truth=truth, unit=unit)
    if _POINTS.search(core) is None or _OF_GRIP.search(core):
        return None
    if re.search(r"\binstead\b", question, re.I):
        term = _felt(term, earlier)
    core = re.sub(r"\b(that|this) one\b", r"\1", core.partition(", if ")[0])
    if found := _MULTIPLE.fullmatch(core):
        return of_number(core, about, None)
    return _calculated(core, term, unit)


def _felt(term: Term, earlier: Meaning | None) -> Term:
    """What a number was made of, where it was worked out of the one before; else the number."""
    other, _ = _number(earlier)
    is_made_of = other is not None and other.expression in term.expression
    return other if other is not None and is_made_of else term


_COMPARED = re.compile(r"(?P<name>\w+) (?:>=|<=|>|<) \S+ (?P<unit>\S+)")


def compared_in(meant: Meaning) -> Amount | None:
    """The number that a yes or a no was about: the depth, of 'is it over 0.6 mm?'; None of none."""
    found = _COMPARED.fullmatch(meant.test) if isinstance(meant, Check) else None
    if found is None or found["name"] not in QUANTITIES or found["unit"] not in UNITS:
        return None
    return Amount(quantity=found["name"], unit=found["unit"])


_YES_OR_NO = re.compile(r"(?:is|are|does|do) (?:it|that|this|they|we|you|i|the \w+)\b")
"""How a follow-up begins that asks for no number."""


def _calculated(core: str, term: Term, unit: str) -> Calculated | None:
    """What is calculated of a pronoun that stands for a number."""
    asked = asked_words(core)
    with_units = replace(asked, unit=asked.unit or unit)
    asked = replace(with_units, words=with_units.in_its_unit(asked.words))
    usual = calculated(core)
    told = calculated_about(asked, term)
    if told is None or (usual is not None and usual.truth == told.truth):
        return None
    if told.unit is not None and _YES_OR_NO.match(core):
        return None
    is_of_it = term.expression in told.truth or term.factor in told.truth
    return told if is_of_it else None


def _of_both(core: str, term: Term, earlier: Meaning | None) -> Calculated | None:
    """The difference, the sum, or the product, of the last two numbers."""
    is_sum = _SUM.fullmatch(core) is not None
    is_product = _PRODUCT.fullmatch(core) is not None
    if not is_sum and not is_product and _DIFFERENCE.fullmatch(core) is None:
        return None
    other, _ = _number(earlier)
    if is_product:
        if other is None or (other.dimension, term.dimension) != ("length", "length"):
            return None
        return Calculated(truth=f"{other.factor} * {term.factor}", unit="mm²")
    pair = alike(other, term) if other is not None else None
    if pair is None or pair[0].expression == pair[1].expression:
        return None
    a, b = pair
    truth = f"{a.expression} + {b.expression}" if is_sum else f"abs({a.expression} - {b.factor})"
    return Calculated(truth=truth, unit="")


def _number(meaning: Meaning | None) -> tuple[Term | None, str]:
    """A number that was asked for as a noun phrase's meaning, and its unit; None of others."""
    if not isinstance(meaning, Amount | Calculated) or meaning.unit is None:
        return None, ""
    truth, unit = truth_of(meaning), meaning.unit
    if isinstance(meaning, Amount):
        dimension = UNITS[unit].dimension
        own = UNITS[QUANTITIES[meaning.quantity].unit].dimension
        if (own, dimension) == ("force", "mass"):
            truth = f"({truth}) / {GRAVITY_N_PER_G}"
        elif (own, dimension) == ("fraction", "area"):
            truth = truth.replace("area_percent", "area_mm2")
        elif own != dimension:
            return None, ""
    elif unit:
        dimension = UNITS[unit].dimension if unit in UNITS else unit
    else:
        dimension = PLAIN
    is_sum = re.fullmatch(r"\w+|\w+\([^()]*\)", truth) is None
    return Term(expression=truth, dimension=dimension, words="it", is_sum=is_sum), unit
