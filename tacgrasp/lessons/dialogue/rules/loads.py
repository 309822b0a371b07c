"""Questions that name masses or several objects: a named force for one, and several at once.

Is 0.5 N ok for 30 g?                   check needed #2 g <= #1 N.
Will 30 g slip at 0.5 N?                check needed #1 g > #2 N.
Would it hold 10 g and 50 g?            check stays #1 g; check stays #2 g.
How much force for 10 g and 50 g?       amount needed #1 g N; amount needed #2 g N.
How many grams does it hold?            amount holds g.
Would two of these be held?             force_n >= gram_n * 2 * mass_g
Would half its mass slip?               force_n < gram_n * 0.5 * mass_g
By how many grams is it too heavy?      mass_g - holds_g

A count is no mass: 'would it hold two?' is not about 2 g.

Not here: the multiple of a supposed mass (``tacgrasp.lessons.dialogue.calculations``).
"""

from __future__ import annotations

import re

from tacgrasp.lessons.dialogue.calculations.quantity_names import THING

_FORCE_UNITS = {"n": "N", "newton": "N", "newtons": "N", "mn": "mN", "millinewtons": "mN"}
_MASS_UNITS = {"g": "g", "gram": "g", "grams": "g", "kg": "kg", "kilo": "kg", "kilos": "kg",
               "kilogram": "kg", "kilograms": "kg"}  # fmt: skip
_NUMBER = re.compile(r"#(?: (\w+))?")
_TOO_LITTLE = re.compile(
    r"\b(?:slips?|slipping|drops?|falls?|loses?|slides?|too (?:little|weak|low|small|light|feeble)|"
    r"insufficient|inadequate|not|never|fails?|needs? more|requires? more|short)\b"
)
_ENOUGH = re.compile(
    r"\b(?:ok|okay|okey|fine|good|enough|sufficient|sufficiently|suffices?|adequate|plenty|safe|"
    r"alright|right for|works? for|do for|holds?|held|holding|carry|carries|lift|lifts|lifted|"
    r"keeps?|kept|supports?|grips?|stays?|suitable|appropriate|acceptable|needs?|requires?)\b"
)
_OTHERWISE = re.compile(r"\b(?:too (?:much|strong|high|firm|hard)|bruise|crush|damage|between)\b")
_COMPARED = re.compile(r"\b(?:more|less|greater|smaller) than\b|\bexactly\b")
_NEEDS = re.compile(r"\b(?:needs?|requires?)\b")
_HOLDS = re.compile(
    r"\b(?:holds?|held|holding|carry|carries|lift|lifts|lifted|keeps?|kept|supports?|bears?|enough|"
    r"sufficient|stay|stays)\b"
)
_SLIPS = re.compile(r"\b(?:slips?|slipping|drops?|dropped|falls?|fall|slides?|lose|lost)\b")
_HELD = re.compile(
    r"(?:how (?:many|much|heavy)|what|which)"
    r"(?: (?:an?|the|mass|weight|load|grams?|kilos?|kilograms?|kg|g|pounds?|lbs?|ounces?|oz|most|"
    r"maximum|largest|heaviest))*"
    r"(?: (?:does|can|could|would|will|do|is))?"
    r"(?: (?:it|this|that|you|we|they|"
    r"(?:the|this|that|our|your) (?:grip|gripper|grasp|fingers?|hold)))?"
    r"(?: (?:be able to|able to|safely|surely|currently|still|now))*"
    r" (?:hold|carry|lift|bear|support|hold up)"
    r"(?: (?:now|safely|surely|at most|in \w+|like this|as it is))*"
)
_VERB = re.compile(r"(?:is|are|was|will|would|can|could|does|do|should|may|might|has|#)(?= |$)")
_ASKS_FORCE = re.compile(
    r"(?:how (?:much|strong|hard|many newtons)|what|which)\b.*\b(?:force|grip|newtons?|squeeze)\b"
)


_ENOUGH_FOR = re.compile(
    r"(?:(?:is|are|would|will|does|do|can) )?(?:(?:it|this|that|we|i|the|my|our|your) "
    r")?(?:(?:current |present )?(?:grip|force|squeeze|hold) )?(?:(?:also|still|be|surely|really) "
    r")*(?:(?:strong|firm|tight|hard) enough|enough(?: grip| force)?|sufficient|do|work|suffice|"
    r"good)(?: (?:surely|really))? (?:to (?:hold|lift|carry) |for )(?:(?:an?|one of|one|this|the) "
    r")?# \w+(?: (?:one|#|object|part|piece|thing|egg|berry))?(?: (?:too|as well|surely|for "
    r"sure))?"
)
_SURELY_NEEDED = re.compile(
    r"(?=.*\b(?:surely|safely|for sure|certain|certainly)\b)(?=.*\b(?:hold|holds|held|keep|keeps|"
    r"kept|stay|stays|carry)\b)(?:^|.*\b)(?:what|which|how much|how many newtons(?: of)?|newtons|"
    r"least|minimum)(?: (?:force|grip|squeeze|gripping force))?(?: in \w+)?(?: (?:is|are|would|"
    r"will|does|do|it|we|i))*(?: (?:enough|needed|required|sufficient|necessary|need|take|takes|"
    r"it takes))"
)
_LEAST_TO_HOLD = re.compile(
    r"(?:what is |give me |tell me )?(?:the )?(?:minimum|min|least|lowest|smallest|weakest) "
    r"(?:(?:grip|gripping|holding|clamping) )?(?:force|grip|squeeze)(?: (?:that|which|i|we|you|it|"
    r"is|need|needs|needed|required|necessary|takes|would|will|can|still|surely|safely|to|just|"
    r"for))* "
    r"(?:hold|holds|holding|lift|lifts|lifting|carry|carries|keep|keeps) "
    r"(?:it|this|that|the (?:object|thing|part|berry|item))"
    r"(?: (?:from slipping|up|without slipping|without dropping it|surely|safely))?"
)
_OF_BOUNDS = re.compile(
    r"\b(?:limit|band|heaviest|mass|grams?|load|more|less|still|missing|left)\b"
)
_ENOUGH_TO_HOLD = re.compile(
    r"(?:is|are|would|will) (?:(?:the|this|my|our|your) )?(?:(?:current |present )?(?:grip|force|"
    r"squeeze|hold)|we gripping|i gripping|we squeezing|i squeezing) (?:(?:be|surely|really) )*"
    r"(?:(?:strong |firm |hard |tight |firmly )?enough|sufficient)(?: (?:surely|really))? to "
    r"(?:(?:surely|safely|be sure of|be sure to) )*(?:hold|lift|carry|holding) "
    r"(?:it|this|(?:the |this |that |my |our )?[a-z]+)"
    r"(?: (?:surely|for sure|safely))?"
)
_WORKS = re.compile(
    r"(?:would|will|can|could|is|are) (?:an? )?# \w+(?: (?:object|part|piece|thing|one))?(?: "
    r"(?:surely|still|be))* (?:work|ok|okay|fine|do|hold|held|safe|possible|stay|stays|all "
    r"right)(?: (?:at|with|in|for) (?:the |this |that |our )?(?:present |current )?(?:grip|force|"
    r"squeeze))?"
)


def load_query(words: str) -> str:
    """The query of a question that names masses, in plain words; '' of any other question."""
    units = [match[1] or "" for match in _NUMBER.finditer(words)]
    forces = [place for place, unit in enumerate(units, start=1) if unit in _FORCE_UNITS]
    masses = [place for place, unit in enumerate(units, start=1) if unit in _MASS_UNITS]
    if _OTHERWISE.search(words):
        return ""
    words = re.sub(rf"^(?:at|with) (?=# (?:{'|'.join(_FORCE_UNITS)})\b)", "", words)
    if len(units) == 2 and len(forces) == len(masses) == 1 and _VERB.match(words):
        mass, force = masses[0], forces[0]
        tested = f"needed #{mass} {_MASS_UNITS[units[mass - 1]]}"
        newtons = f"#{force} {_FORCE_UNITS[units[force - 1]]}"
        if _COMPARED.search(words) and not _NEEDS.search(words):
            return ""
        if _TOO_LITTLE.search(words):
            return f"check {tested} > {newtons}."
        return f"check {tested} <= {newtons}." if _ENOUGH.search(words) else ""
    asks_if_held = _WORKS.fullmatch(words) or _ENOUGH_FOR.fullmatch(words)
    if len(masses) == 1 and not any(units[: masses[0] - 1]) and asks_if_held:
        return f"check stays #{masses[0]} {_MASS_UNITS[units[masses[0] - 1]]}."
    if not units and _LEAST_TO_HOLD.fullmatch(words):
        return "amount needed N."
    if not units and _SURELY_NEEDED.search(words) and not _OF_BOUNDS.search(words):
        return "amount needed N."
    if not units and _ENOUGH_TO_HOLD.fullmatch(words):
        return "check stays given."
    if not units and _HELD.fullmatch(words):
        return "amount holds g."
    if len(units) > 1 and not forces and units[-1] in _MASS_UNITS and _are_listed(words):
        shared = _MASS_UNITS[units[-1]]
        each = [f"#{n} {_MASS_UNITS.get(unit, shared)}" for n, unit in enumerate(units, start=1)]
        if _VERB.match(words) and (_HOLDS.search(words) or _SLIPS.search(words)):
            fate = "slips" if _SLIPS.search(words) else "stays"
            return f"{'; '.join(f'check {fate} {mass}' for mass in each)}."
        if _ASKS_FORCE.match(words):
            return f"{'; '.join(f'amount needed {mass} N' for mass in each)}."
    return ""


def _are_listed(words: str) -> bool:
    """Whether the numbers stand in one list: 'a 10 g and a 50 g berry'."""
    return re.search(r"#(?: \w+)?(?: (?:(?:and|or|an?|the) )*#(?: \w+)?)+", words) is not None and (
        re.search(r"\b(?:more|less|plus|minus|over|under)\b", words) is None
    )


_COUNTS = {
    "two": 2, "three": 3, "four": 4, "five": 5, "six": 6, "seven": 7, "eight": 8, "nine": 9,
    "ten": 10, "a dozen": 12, "a pair": 2, "both": 2,
}  # fmt: skip
_TIMES = {"half": 0.5, "a third of": 1 / 3, "a quarter of": 0.25, "twice": 2, "double": 2,
          "thrice": 3, "triple": 3}  # fmt: skip
_UNITS = r"(?:newtons|grams|kilos|kilograms|millinewtons|ounces|pounds|times|percent)"
_MASS = rf"(?P<mass>\d+(?:\.\d+)?)[ -]?(?P<unit>{'|'.join(_MASS_UNITS)})"
_THINGS = rf"(?!{_UNITS}\b)[a-z]{{2,}}s\b"
_ALIKE = r"(?:identical|equal|like|similar)"
_SEVERAL = (
    rf"(?P<count>{'|'.join(_COUNTS)}|\d+(?= (?:of|such|{_ALIKE}|{_THINGS}|\d)))"
    rf"(?: of (?:these|those|them|it)| such)?(?: {_ALIKE})?(?: (?:{_MASS} )?{_THINGS})?"
)
"""'Two', 'two of these', '2 such objects', 'three 20 g weights'; '60' leaves out the grams."""

_MULTIPLE = (
    rf"(?P<times>{'|'.join(_TIMES)}|(?P<number>\d+(?:\.\d+)?|{'|'.join(_COUNTS)}) times) "
    rf"(?:(?:the|its|this|that) )(?:(?:object|{THING})(?:'s)? )?(?:mass|weight|load)"
)
_SEVERAL_HELD = rf"(?:{_SEVERAL}|{_MULTIPLE})"
_GRIP = r"(?:it|this|that|i|we|you|(?:the|this|that|our|my) (?:grip|gripper|hand|robot|force))"
_STILL = r"(?: (?:still|also|even|safely|surely|now|be able to))*"
_AT_ONCE = (
    r"(?: (?:at once|at (?:the same|one) time|together|altogether|in one go|like this|too|as well|"
    r"then|now|safely|surely|instead|up|out|away))*"
)
_SEVERAL_HOLDS = r"(?:hold|carry|lift|support|take|bear|keep|pick up|manage)"
_CARRIES = re.compile(
    rf"(?:would|will|can|could|does|do|may) {_GRIP}{_STILL} {_SEVERAL_HOLDS}"
    rf"(?: up)? {_SEVERAL_HELD}{_AT_ONCE}"
)
_ARE_CARRIED = re.compile(
    rf"(?:would|will|can|could|are|is|do) {_SEVERAL_HELD}{_STILL} "
    r"(?:(?:be )?(?:held|carried|lifted|kept|"
    r"safe|supported)|hold|stay(?: put)?|stick|remain|(?P<slips>slip|fall|drop|slide|be dropped|be "
    rf"lost)){_AT_ONCE}"
)

_NEEDED_FOR = re.compile(
    r"(?:how much|what|which) (?:force|grip|squeeze) (?:(?:is|are|would|will|do|does|should|be|i|"
    r"we|"
    r"you|it|need|needs|needed|required|necessary|take|have) )*(?:for|to (?:hold|lift|carry)) "
    rf"{_SEVERAL_HELD}{_AT_ONCE}"
)
_IT = rf"(?:it|this|that|(?:the|this|that|our|my) {THING})"
_TOO_HEAVY = re.compile(
    rf"(?:by )?how (?:much|many (?P<unit>grams|kilos|kilograms)) (?:(?:is|are) )?(?:{_IT} )?too "
    rf"heavy(?: (?:is|are) {_IT})?(?: (?:for|to) .+)?|"
    r"how (?:much|many (?P<grams>grams|kilos|kilograms)) lighter (?:must|should|would|does|has) "
    rf"{_IT} (?:(?:have|need) to )?(?:be|become|get)(?: (?:for|to|so|if) .+)?"
)
"""'By how many grams is it too heavy?', 'how much lighter must it be?'"""


def several_query(question: str) -> str:
    """The query of a question for several objects, or for what one has too much; '' of others.

    Args:
        question: The question, as ``tacgrasp.lessons.dialogue.plainer`` leaves it.
    """
    words = " ".join(question.lower().replace("’", "'").split()).strip(" ?.!")
    if heavy := _TOO_HEAVY.fullmatch(words):
        unit = heavy["unit"] or heavy["grams"] or "grams"
        return f"calculate mass_g - holds_g in {'g' if unit == 'grams' else 'kg'}."
    if found := _NEEDED_FOR.fullmatch(words):
        return f"calculate gram_n * {_factor(found):.6g} * {_each(found)} in N."
    found = _CARRIES.fullmatch(words) or _ARE_CARRIED.fullmatch(words)
    if found is None:
        return ""
    sign = "<" if found.groupdict().get("slips") else ">="
    return f"calculate force_n {sign} gram_n * {_factor(found):.6g} * {_each(found)}."


def _factor(found: re.Match[str]) -> float:
    """How many objects are meant, or which multiple of one."""
    if said := found["count"] or found["number"]:
        return float(_COUNTS.get(said) or said)
    return _TIMES[found["times"]]


def _each(found: re.Match[str]) -> str:
    """The mass of one: a number of grams, or that which was told."""
    if found["mass"] is None:
        return "mass_g"
    return f"{float(found['mass']) * (1000 if _MASS_UNITS[found['unit']] == 'kg' else 1):.6g}"
