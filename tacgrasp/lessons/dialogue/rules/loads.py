"""Questions that name masses: a named force for one, and several masses at once.

Is 0.5 N ok for 30 g?                   check needed #2 g <= #1 N.
Will 30 g slip at 0.5 N?                check needed #1 g > #2 N.
Would it hold 10 g and 50 g?            check stays #1 g; check stays #2 g.
How much force for 10 g and 50 g?       amount needed #1 g N; amount needed #2 g N.
How many grams does it hold?            amount holds g.
"""

from __future__ import annotations

import re

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
