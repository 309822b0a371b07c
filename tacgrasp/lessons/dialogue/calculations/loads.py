"""Questions for the load that a force surely holds, and for the force that surely holds a load.

    At a grip of 4 N, what load is surely held?     4 / gram_n
    How many mN per gram do you budget?             gram_n
    How much more force for a 200 g part?           gram_n * 200 - force_n
    Which safety factor has a 200 g part?           holds_g / 200

What is asked is known by its words in any order: each of them must be one that such a question
has, besides a force or a mass.

Not here: whether something slips (``tacgrasp.lessons.dialogue.rules.loads``).
"""

from __future__ import annotations

import re

from tacgrasp.lessons.dialogue.calculations.asked import AskedWords, usual
from tacgrasp.lessons.dialogue.calculations.phrases import PARTS, is_made_of
from tacgrasp.lessons.dialogue.calculations.quantity_names import THING, UNIT, unit_of
from tacgrasp.lessons.dialogue.calculations.terms import PLAIN, Term, in_newtons
from tacgrasp.lessons.dialogue.meaning import Calculated
from tacgrasp.lessons.dialogue.quantities import UNITS

MOST_TERM_WORDS = 9
"""Longest force or mass in such a question [words]."""

_SURE = (
    r"(?:sure|surely|certain|certainly|certainty|safe|safely|secure|securely|reliably|reliable|"
    r"definitely|guarantee|guaranteed|guarantees|confident|confidently|dependably|trust|"
    r"trusted|count|counted|bank|rely|promise|promised|vouch|doubt|fail|risk|slip|slipping|"
    r"slips|dropping|drop)"
)
_HOLD = (
    r"(?:hold|holds|held|holding|carry|carried|carries|carrying|lift|lifted|lifting|support|"
    r"supports|supported|bear|bears|keep|keeps|kept|hang|hanging|pick|picked|hoist|hoisted|"
    r"manage|handle|handled|take|grip|gripped|retain|retained|stay|stays|sustain|sustained|"
    r"suspend|suspended|raise|raised|move|haul|hauled|secure|secured)"
)
_LOAD = (
    rf"(?:load|loads|mass|masses|weight|weights|heavy|heaviest|capacity|payload|{THING}|grams|"
    r"kilos|kilograms|much|many)"
)
_FORCE = (
    r"(?:force|grip|squeeze|newtons|millinewtons|hard|tight|firmly|pressure|clamp|clamping|"
    r"gripping|pinch|strong|strongly|tightly|press|pressing|stronger|harder|firmer|tighter)"
)
_NEEDED = (
    r"(?:need|needs|needed|require|requires|required|necessary|must|have|has|should|take|takes|"
    r"minimum|min|least|smallest|enough|call|calls|sufficient|suffices|ought|want|wants|demand|"
    r"demands|do|would)"
)
_LEAST = r"(?:minimum|min|least|smallest|needed|required|necessary)"
_FILL = (
    r"(?:what|which|how|is|are|be|would|will|could|can|does|do|did|may|might|should|shall|the|a|"
    r"an|of|in|on|onto|to|by|at|with|for|from|it|this|that|these|we|i|you|one|my|our|your|their|"
    r"up|most|max|maximum|biggest|largest|greatest|limit|still|just|then|there|ever|object|"
    r"without|before|any|no|not|so|and|out|off|being|only|under|such|amount|figure|value|"
    r"number|gripper|fingers|finger|jaws|robot|hand|touch|state|present|current|currently|now|"
    r"tell|me|give|get|got|gets|able|possible|rule|thumb|really|actually|exactly|reckon|"
    r"think|say|expect|expected|allow|am|as|if|absolute|absolutely|hundred|percent|all|put|place|"
    r"us|buy|buys|earn|earns|something|anything|stuff|steady|still|"
    r"each|every|per|theory|principle|practice|here|together|using|based|think|go|come|comes)"
)
_EXPLAINED = re.compile(r" (?:i e|that is to say|meaning|defined as|in other words) .+$")
_TOLD_MASS = re.compile(
    r"(?:given|with|for|from|by|going by|based on|at|of|using|knowing) (?:the )?"
    r"(?:(?:stated|told|known|recorded|given|declared|quoted|listed) )?(?:mass|weight)"
    rf"(?: (?:of (?:the |this |that |our )?{THING}|on (?:record|file|the \w+)|in the \w+|"
    rf"for (?:the |this |that |our )?{THING}|(?:that )?(?:i|we|you|it) (?:\w+ ){{0,2}}\w+|"
    rf"(?:as )?(?:stated|told|given|known|recorded)))*"
)
_HOLDING_IT = re.compile(
    rf"(?:for|to {_HOLD})(?: up)? (?:it|this|that|(?:the|this|that|our) {THING})"
    r"(?: (?:safely|surely|up|securely))*$"
)
"""'How much force is missing to hold it?'"""
_INTO = (
    r"(?:(?:right|exactly|just|only) )?(?:at|with|by|using|under|"
    r"for|given|from|of|up to|right up to|all the way (?:up )?to|to)"
)
_GRIPPING = (
    r"(?:(?:squeezing|gripping|pressing|clamping|pinching|holding|pushing|squeezed|clamped|gripped|"
    r"applying|exerting|going|go|went|may|use|using|used|reach|reached|hit|run|could|can|would|"
    r"will|does|do|if|were|was|we|i|you|is|it|the|"
    r"squeeze|squeeze it|press|grip|apply|clamp|are) )*"
)
_BEFORE_FORCE = re.compile(
    rf"(?:^|(?<= )){_GRIPPING}(?:{_INTO} )?(?:an? |the )?(?:steady |constant )?"
    r"(?:(?:grip|squeeze|force|clamp|pinch|grip force) (?:of|at|is at|set to|set at|is|were|"
    r"was) )?$"
)
_BEFORE_MASS = re.compile(
    r"(?:^|(?<= ))(?:(?:for|to|with|of|under|given|on|if|before|so|that|it|is|weighs|weighing|i|we|"
    r"can|could|until|hold|lift|carry|pick|up|safely|surely|the|an?|object|mass|weight|load|by) )*$"
)
_PER_GRAM = re.compile(
    r"(?:(?:per|for (?:each|every|one|a)|(?:to|of) (?:each|every)|each|every) (?:single )?"
    r"(?P<each>gram|kilogram|kilo|kg)|per g)(?: of (?:load|mass|weight|payload|object|it))?"
    r"(?: (?:to be )?(?:lifted|held|carried|gripped|hoisted))?"
)
_PER_NEWTON = re.compile(
    r"\b(?:per|for (?:each|every)|each|every) (?:single )?(?:newton|n)\b(?: of (?:grip|force|"
    r"squeeze))?"
)
_SHARE_OF = re.compile(rf"\b(?:what|which) {PARTS} of ")
_SHORT = re.compile(
    r"\b(?:short|shy|lack|lacking|missing|shortfall|too (?:weak|little|loose|low|light|feeble))\b"
)
_FACTOR = re.compile(
    r"(?:factor of safety|safety factor|holding factor|safety ratio|margin of safety as a factor|"
    r"how many times (?:over|as much as needed|its weight|(?:(?:the|what is) )?"
    r"(?:needed|required|necessary) force|the force (?:that is )?(?:needed|required)))"
)


_MANY_THINGS = re.compile(
    rf"\bhow many (?:of (?:them|these|those|such)|#1 |(?!(?:{UNIT})\b)#?[a-z]+)"
)
_HELD_AT_ONCE = re.compile(
    rf"how many (?:whole )?(?:of (?:these|those) )?#1 (?:{UNIT}) (?:[a-z]+ "
    rf")?(?P<rest>(?=.*\b{_HOLD}\b)"
    r"(?:can|could|would|will|may|might|does|do|is|are) .+)"
)
_EQUALS = re.compile(
    r"\b(?:equals?|equalling|match(?:es)?|as (?:thick|heavy|deep|much|hard) as|stack(?:ed)?|"
    r"weights?|"
    r"weigh|weighs|weighing|push|press|balance|make(?:s)? up|correspond|worth|same)\b"
)
_OF_DEPTH = re.compile(r"\b(?:depth|deep|dent|indentation|gone in|sunk)\b")
_OF_FORCE = re.compile(r"\b(?:force|push|press|squeeze|grip)\w*\b")


def as_many_as(asked: AskedWords) -> Term | None:
    """How many things of a named thickness are the depth, or of a named mass weigh the force.

    'How many 0.1 mm sheets, stacked, equal the depth?'
    """
    words = asked.words
    if asked.unit or not _MANY_THINGS.search(words):
        return None
    each = asked.only_value()
    if each is None or re.search(r"\b(?:limit|band|area|pad)\b", words):
        return None
    if each.dimension == "mass" and (held := _HELD_AT_ONCE.fullmatch(words)):
        if is_made_of(held["rest"], rf"(?:{_FILL}|{_SURE}|{_HOLD}|{_FORCE}|{_LOAD}|once)"):
            return Term(expression=f"holds_g / {each.divisor}", dimension=PLAIN, words="")
        return None
    if not _EQUALS.search(words):
        return None
    if each.dimension == "length" and _OF_DEPTH.search(words):
        return Term(expression=f"depth_mm / {each.divisor}", dimension=PLAIN, words="")
    if each.dimension not in ("mass", "force") or not _OF_FORCE.search(words):
        return None
    return Term(expression=f"force_n / {in_newtons(each).divisor}", dimension=PLAIN, words="")


def load(asked: AskedWords) -> Term | None:
    """The load that a force surely holds: the felt one, or one that the question names."""
    words = _EXPLAINED.sub("", asked.words)
    if _SHARE_OF.search(words):
        return None
    if asked.unit in ("g", "kg", "g/N", "kg/N") and (each := _PER_NEWTON.search(f"{words} ")):
        rest = f"{words[: each.start()]} {words[each.end() :]}"
        if _is_load(f"how much {rest}"):
            unit = f"{asked.unit.partition('/')[0]}/N"
            return Term(expression="1 / gram_n", dimension=unit, words="")
    if not _asks_load(asked, words):
        return None
    for force, rest in _with_term(asked, words, "force", _BEFORE_FORCE):
        if _is_load(rest):
            expression = f"{force.factor} / gram_n"
            return Term(expression=expression, dimension="mass", words="")
    if _is_load(words) and asked.subject is not None and "force_n" in asked.base:
        held = asked.subject.factor
        return Term(expression=f"{held} / gram_n", dimension="mass", words="")
    return None


def needed(asked: AskedWords) -> Term | None:
    """The force that surely holds a load, or how much more than the felt one that is."""
    words = _EXPLAINED.sub("", asked.words)
    if per := _per_gram(asked, words):
        return per
    if "/" in asked.unit or (asked.unit and UNITS[asked.unit].dimension != "force"):
        return None
    if not asked.unit and not re.search(rf"\b{_FORCE}\b", words):
        return None
    if _ASKS_SO.match(words) or _APART.search(words):
        return None
    if not asked.unit and not re.search(rf"\b(?:what|which|how|{_LEAST})\b", words):
        return None
    for mass, rest in (*_with_term(asked, words, "mass", _BEFORE_MASS), *_told_mass(words)):
        if mass.expression == "holds_g" or not _is_needed(rest):
            continue
        expression = f"gram_n * {mass.factor}"
        if asked.is_more or _SHORT.search(words):
            return Term(
                expression=f"{expression} - force_n", dimension="force", words="", is_sum=True
            )
        return Term(expression=expression, dimension="force", words="")
    return None


def load_amount(asked: AskedWords) -> Calculated | None:
    """The force that a supposed mass needs; None where that is not asked."""
    if (
        asked.subject is None
        or asked.subject.dimension != "mass"
        or asked.unit not in ("", "N", "mN")
    ):
        return None
    words = re.sub(
        rf"\b(?:it|them|that|both|the (?:pair|two|both|lot|{THING}))\b", "it", asked.words
    )
    words = re.sub(r"\b(?:makes?|against)\b ?", "", words)
    is_force = asked.unit or re.search(rf"\b{_FORCE}\b", words)
    if not is_force or not re.match(r"(?:what|which|how)\b", words) or not _is_needed(words):
        return None
    return Calculated(truth=f"gram_n * {asked.subject.factor}", unit=asked.unit or "N")


def safety_factor(asked: AskedWords) -> Term | None:
    """How many times the load the grip surely holds."""
    words = _EXPLAINED.sub("", asked.words)
    if not _FACTOR.search(words):
        return None
    words = _FACTOR.sub("", words)
    held = asked.term("sure load")
    told = [*_with_term(asked, words, "mass", _BEFORE_MASS), *_told_mass(words)]
    told.append((usual("mass"), words))
    for mass, rest in told:
        if held and mass.expression != "holds_g" and _is_filled(rest):
            return Term(expression=f"{held.factor} / {mass.divisor}", dimension=PLAIN, words="")
    return None


def stays(asked: AskedWords) -> Calculated | None:
    """Whether the object stays in the grip under a supposed force or mass; None of others."""
    found = _STAYS.fullmatch(asked.words)
    if found is None or asked.subject is None:
        return None
    sign = "<" if found["slips"] else ">="
    if asked.subject.dimension == "mass":
        return Calculated(truth=f"force_n {sign} gram_n * {asked.subject.factor}", unit=None)
    if asked.base != "force_n":
        return None
    return Calculated(truth=f"{asked.subject.factor} {sign} gram_n * mass_g", unit=None)


def sure_to_hold(asked: AskedWords) -> Calculated | None:
    """Whether a supposed force surely holds a named load; None where that is not asked."""
    if asked.subject is None or not _ASKS_SO.match(asked.words):
        return None
    if asked.subject.dimension == "mass":
        return _holds_it(asked, asked.subject)
    if asked.base != "force_n":
        return None
    for mass, rest in (
        *_with_term(asked, asked.words, "mass", _BEFORE_MASS),
        *_told_mass(asked.words),
    ):
        used = rf"(?:{_FILL}|{_SURE}|{_HOLD}|{_LOAD}|{_FORCE}|has|have)"
        if re.search(r"\b(?:slip|slips|slipping|drop|dropping|fail|risk|not|too)\b", rest):
            return None
        if re.search(rf"\b(?:{_SURE}|{_HOLD}|enough)\b", rest) and is_made_of(rest, used):
            truth = f"{asked.subject.factor} >= gram_n * {mass.factor}"
            return Calculated(truth=truth, unit=None)
    return None


def needs_more(asked: AskedWords) -> Calculated | None:
    """Whether a load needs more, or less, force than a bound; None of other questions."""
    found = _NEEDS_MORE.fullmatch(_ALLOWED.sub("the limit", asked.words))
    bound = asked.term(found["bound"]) if found else None
    if found is None or bound is None or bound.dimension != "force":
        return None
    for mass, rest in _with_term(asked, found["load"], "mass", _BEFORE_MASS):
        if is_made_of(rest, rf"(?:{_FILL}|{_HOLD}|{_LOAD})"):
            sign = ">" if found["sign"] == "more" else "<"
            truth = f"gram_n * {mass.factor} {sign} {bound.factor}"
            return Calculated(truth=truth, unit=None)
    return None


def _holds_it(asked: AskedWords, mass: Term) -> Calculated | None:
    """Whether the felt force surely holds a supposed mass."""
    used = rf"(?:{_FILL}|{_SURE}|{_HOLD}|{_LOAD}|{_FORCE}|{THING}|enough|sufficient)"
    if re.search(r"\b(?:slip|slips|slipping|drop|dropping|fail|risk|not|too)\b", asked.words):
        return None
    if not re.search(
        rf"\b(?:{_SURE}|hold|held|kept|keep|carry|carried|lift|bear|enough)\b", asked.words
    ):
        return None
    if not is_made_of(asked.words, used):
        return None
    return Calculated(truth=f"force_n >= gram_n * {mass.factor}", unit=None)


_STAYS = re.compile(
    rf"(?:would|will|does|do|can|could|is|are) (?:we |it |they |this |that |{THING} |the )+"
    r"(?:(?:still|then|now|be|surely|safely|able to) )*(?:(?P<slips>slip|slide|fall|drop|slips|"
    r"slipping|dropped|lost)|(?:hold|held|stay|stick|remain|hold it|stay put))"
    r"(?: (?:it|up|out|away|down|off|then|now|still|in place|put))*"
)
_SUFFICES = re.compile(
    r"(?:would|will|is|are|does|do|can|could) (?:a |the )?(?:grip of |force of )?(?P<force>.+?) "
    r"(?:(?:be |really )?(?P<enough>enough|sufficient)|suffice|do)"
    rf"(?: (?:to|for)(?: (?:us|me|you))?(?: {_SURE})?(?: {_HOLD})?(?: {_SURE})?(?: up)? ?"
    rf"(?:it|this|that|them|(?:the |this |that )?{THING}|(?P<mass>.+?))(?: {_SURE}| for sure)?)"
)
_LEAVES_ENOUGH = re.compile(
    rf"(?:would|will|does|do|can) (?P<force>.+?) (?:leave|give|allow|offer|provide) (?:me |us |"
    rf"you )?"
    rf"(?P<enough>enough|sufficient)(?: (?:room|force|headroom|grip|slack))? (?:for|to(?: "
    rf"{_SURE})? "
    rf"{_HOLD}) (?P<mass>.+?)(?: {_SURE}| for sure)?"
)


_HOLDS_IT = re.compile(
    rf"(?:would|will|can|could|does|do) (?:a |the )?(?:grip of |force of )?(?P<force>.+?)"
    rf"(?: (?:still|even|also|be able to|{_SURE}))* (?:hold|carry|lift|keep|secure) "
    rf"(?:it|this|that|them|(?:the |this |that )?{THING}|(?P<mass>#\d+ \w+))(?: {_SURE}| for sure)?"
)
"""'Would half the force hold it?'"""


def suffices(asked: AskedWords) -> Calculated | None:
    """Whether a named force surely holds the object; None of other questions."""
    patterns = (_SUFFICES, _LEAVES_ENOUGH, _HOLDS_IT)
    found = next(filter(None, (each.fullmatch(asked.words) for each in patterns)), None)
    force = asked.term(found["force"]) if found else None
    if found is None or force is None or force.dimension != "force":
        return None
    mass = asked.term(found["mass"]) if found["mass"] else usual("mass")
    is_plain = force.expression == "force_n" and not found["mass"]
    if is_plain or mass is None or mass.dimension != "mass" or mass.expression == "holds_g":
        return None
    return Calculated(truth=f"{force.expression} >= gram_n * {mass.factor}", unit=None)


_ALLOWED = re.compile(
    r"\b(?:(?:the force|what) )?(?:that )?(?:we|you|i|it|the gripper) (?:(?:is|are|am) (?:allowed|"
    r"permitted)(?: to)?|may|can) (?:press|use|apply|exert|squeeze)(?: with| at most)?$"
)
_NEEDS_MORE = re.compile(
    r"(?P<load>(?:would|will|does|do) .+?) (?:need|require|take|demand|call for|ask for) "
    r"(?P<sign>more|less) (?:force |grip |newtons )?than (?P<bound>.+?)(?: allows| permits)?"
)
_APART = re.compile(r"\b(?:enough|away|apart|distance|difference|gap)\b|\bhow far (?!short)")
"""What asks for less, or for more, than the force that is needed."""

_ASKS_SO = re.compile(r"(?:is|are|am|would|will|could|can|does|do|has|have|should)\b")


def _per_gram(asked: AskedWords, words: str) -> Term | None:
    """The force that surely holds a gram, in the quotient of units that is asked for."""
    one, _, each = asked.unit.partition("/")
    rest = words
    if not each:
        if (found := _PER_GRAM.search(words)) is None:
            return None
        led = words[: found.start()]
        named = re.search(rf"\b({UNIT}) $", led) if not asked.unit else None
        one = asked.unit or (unit_of(named[1]) if named else "N")
        each = "kg" if (found["each"] or "").startswith("k") else "g"
        rest = f"{led[: named.start()] if named else led} {words[found.end() :]}"
    if one not in UNITS or UNITS[one].dimension != "force" or each not in ("g", "kg"):
        return None
    used = rf"(?:{_FILL}|{_FORCE}|{_NEEDED}|{_SURE}|{_HOLD}|{_LOAD}|{_BUDGETED})"
    is_asked = re.search(rf"\b(?:{_SURE}|{_HOLD}|{_NEEDED}|{_BUDGETED})\b", rest)
    if not is_asked or re.search(_APPLIED, rest) or not is_made_of(rest, used):
        return None
    return Term(expression="gram_n", dimension=f"{one}/{each}", words="")


_BUDGETED = (
    r"(?:budget|budgeted|assume|assuming|assumed|figure|figuring|reckon|reckoning|plan|allow|"
    r"allowing|calculate|work|go|use|using|rule|lifted|count|counting|per|gram|factor|coefficient)"
)
_APPLIED = (
    r"\b(?:apply|applying|applied|exert|exerting|exerted|feel|felt|now|currently|present|current|"
    r"measured|measure)\b"
)


def _asks_load(asked: AskedWords, words: str) -> bool:
    if asked.unit and UNITS.get(asked.unit, UNITS["N"]).dimension != "mass":
        return False
    return bool(asked.unit) or re.search(rf"\b{_LOAD}\b", words) is not None


def _is_load(rest: str) -> bool:
    """Whether words ask what is surely held."""
    used = rf"(?:{_FILL}|{_SURE}|{_HOLD}|{_LOAD}|{_FORCE})"
    is_held = re.search(rf"\b(?:{_SURE}|{_HOLD})\b", rest) is not None
    is_asked = re.search(rf"\b(?:{_LOAD}|what)\b", rest) is not None
    return is_held and is_asked and not _DENIED.search(rest) and is_made_of(rest, used)


def _is_needed(rest: str) -> bool:
    """Whether words ask for the force that is needed."""
    used = (
        rf"(?:{_FILL}|{_SURE}|{_HOLD}|{_LOAD}|{_FORCE}|{_NEEDED}|more|extra|additional|further|"
        r"short|shy|lack|lacking|missing|shortfall|far|too|weak|little|loose|low|light|feeble)"
    )
    is_needed = _SHORT.search(rest) or re.search(rf"\b(?:{_NEEDED}|to {_HOLD}|for)\b", rest)
    return bool(is_needed) and not _DENIED.search(rest) and is_made_of(rest, used)


def _is_filled(rest: str) -> bool:
    return is_made_of(
        rest, rf"(?:{_FILL}|{_SURE}|{_HOLD}|{_LOAD}|{_FORCE}|{_NEEDED}|gives?|offers?)"
    )


_DENIED = re.compile(
    r"\b(?:not (?!(?:to )?(?:slip|drop|fail))|too (?!weak|little|loose|low|light|feeble)|more than|"
    r"less than|spare|left|over|under)\b"
)


def _with_term(
    asked: AskedWords, words: str, dimension: str, before: re.Pattern[str]
) -> list[tuple[Term, str]]:
    """Every term of a dimension that stands in the words, with the words that remain."""
    each = words.split()
    found = []
    for begin in range(len(each)):
        for end in range(min(len(each), begin + MOST_TERM_WORDS), begin, -1):
            term = asked.term(" ".join(each[begin:end]))
            if term is None or term.dimension != dimension or term.words == "it":
                continue
            if term.expression in ("force_n", "mass_g"):
                continue
            led = f"{' '.join(each[:begin])} " if begin else ""
            if (lead := before.search(led)) is None:
                continue
            rest = f"{led[: lead.start()]} {' '.join(each[end:])}"
            found.append((term, " ".join(rest.split())))
            break
    return found


def _told_mass(words: str) -> list[tuple[Term, str]]:
    """The mass that somebody told, where a question names it as that, or what is too little."""
    found = _TOLD_MASS.search(words)
    if found is None and _SHORT.search(words):
        found = _HOLDING_IT.search(words)
    if found is None:
        return []
    return [(usual("mass"), f"{words[: found.start()]} {words[found.end() :]}")]
