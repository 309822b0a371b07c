"""Questions about a friction coefficient of the asker's own, by Coulomb's law.

    Friction 0.5 at two fingers like this: would 100 g slip?    2 * 0.5 * force_n < 0.98
    With µ = 0.6 and two fingers, what is the heaviest mass?    2 * 0.6 * force_n / 0.00981
    What squeeze does a 250 g part need at a friction of 0.5?   0.25 * 9.81 / (2 * 0.5)
    What is the least friction coefficient that holds it?       weight / (2 * force_n)

Two fingers press alike, unless the question says that one contact carries all. What the coefficient
of this object is, touch can't know.
"""

from __future__ import annotations

import re

from tacgrasp.lessons.dialogue.meaning import Calculated
from tacgrasp.lessons.dialogue.quantities import GRAVITY_N_PER_G

_FRICTION = re.compile(r"\b(?:friction|mu)\b|µ|μ", re.I)
_COEFFICIENT = re.compile(
    r"(?:\bfriction(?: coefficient)?|\bcoefficient of friction|\bcoefficient|\bmu\b|[µμ])"
    r"(?:_s)?(?: at [^,.?]*?)?(?: of| is| =|=| at| equal to)* ?"
    r"(?P<mu>0?\.\d+|[01](?:\.\d+)?)(?!\d|\.\d)",
    re.I,
)
_ONE_CONTACT = re.compile(
    r"\b(?:(?:only|just|by) (?:this )?(?:one|single)|this single|single|one) "
    r"(?:contact|finger|pad)\b|\bas the only support\b",
    re.I,
)
_TWO_CONTACTS = re.compile(r"\b(?:fingers?|contacts?|force|pinch|grip)\b", re.I)
_MASS = re.compile(
    r"(?P<number>\d+(?:\.\d+)?) ?(?P<unit>g|grams?|kg|kilos?|kilograms?)\b(?! of force)", re.I
)
_UNIT = re.compile(r"\bin (?P<unit>grams?|g|kg|kilograms?|kilos|newtons?|N|mN)\b", re.I)

_LEAST_FRICTION = re.compile(
    r"\b(?:least|smallest|minimum|min|minimal|lowest|what|which) (?:\w+ )?"
    r"(?:friction coefficient|coefficient of friction|friction|mu)\b.*\b"
    r"(?:hold|holds|carr\w+|keep|keeps|lift|support|need\w*|required|stay|slip\w*|load|weight)\b",
    re.I,
)
_NEEDED = re.compile(
    r"\b(?:what|which|how much|how many|minimum|least)\b.*\b(?:squeeze|force|grip|newtons)\b.*\b"
    r"(?:need|needs|needed|required|require|requires|necessary|must|hold)\b",
    re.I,
)
_HEAVIEST = re.compile(
    r"\b(?:heaviest|how heavy|(?:largest|maximum|max|greatest|biggest|most) (?:mass|weight|load)|"
    r"what (?:mass|load|weight))\b",
    re.I,
)
_TANGENTIAL = re.compile(r"\b(?:tangential|shear|friction) (?:load|force)\b", re.I)
_SLIP_OR_HOLD = re.compile(
    r"\b(?P<a>slip|hold|stay)s?,? or (?:does it |will it )?(?P<b>slip|hold|stay)s?\b", re.I
)
_SLIPS = re.compile(r"\b(?:slip|slide|fall|drop)\b", re.I)
_STAYS = re.compile(
    r"\b(?:stay|stays|held|hold|holds|carry|carried|enough|suffice\w*|keep|kept|lift|safe)\b", re.I
)
_ASKS_WHICH = re.compile(r"\b(?:what|which|how (?:many|much|far|hard))\b", re.I)
_ASKS_SO = re.compile(r"\b(?:would|will|does|do|is|are|can|could)\b", re.I)


def frictional(question: str) -> Calculated | None:
    """What a question with a friction coefficient asks to work out; None of other questions."""
    if _FRICTION.search(question) is None:
        return None
    contacts = 1 if _ONE_CONTACT.search(question) else 2
    found = _COEFFICIENT.search(question)
    rest = question if found is None else question[: found.start()] + question[found.end() :]
    weight_n = _weight_n(rest)
    if found is None:
        if not (_LEAST_FRICTION.search(question) and _TWO_CONTACTS.search(question)):
            return None
        return Calculated(truth=f"{weight_n} / ({contacts} * force_n)", unit="")
    held_n = f"{contacts} * {float(found['mu']):g} * force_n"
    if choice := _SLIP_OR_HOLD.search(rest):
        words = choice["a"].lower(), choice["b"].lower()
        stays = next((word for word in words if word != "slip"), "")
        if "slip" in words and stays:
            truth = f"'{stays}' if {held_n} >= {weight_n} else 'slip'"
            return Calculated(truth=truth, unit=None)
    if _HEAVIEST.search(rest):
        return Calculated(truth=f"{held_n} / {GRAVITY_N_PER_G}", unit=_unit_of(question, "g"))
    if _TANGENTIAL.search(rest):
        return Calculated(truth=held_n, unit=_unit_of(question, "N"))
    if _NEEDED.search(rest) and not re.match(r"(?:would|will|is|does)\b", rest, re.I):
        truth = f"{weight_n} / ({contacts} * {float(found['mu']):g})"
        return Calculated(truth=truth, unit=_unit_of(question, "N"))
    if not _ASKS_SO.search(rest) or _ASKS_WHICH.search(rest):
        return None
    if _STAYS.search(rest) and not _SLIPS.search(rest):
        return Calculated(truth=f"{held_n} >= {weight_n}", unit=None)
    if _SLIPS.search(rest) and not re.search(r"\b(?:without|not|n't|before)\b", rest, re.I):
        return Calculated(truth=f"{held_n} < {weight_n}", unit=None)
    return None


def _weight_n(text: str) -> str:
    """The weight of the mass that a text names, or of the given one, as an expression [N]."""
    found = _MASS.search(text)
    if found is None:
        return f"{GRAVITY_N_PER_G} * mass_g"
    grams = float(found["number"]) * (1000.0 if found["unit"].lower().startswith("k") else 1.0)
    return f"{GRAVITY_N_PER_G * grams:.6g}"


def _unit_of(question: str, usual: str) -> str:
    """The unit that a question asks for."""
    found = _UNIT.search(question)
    if found is None:
        return usual
    unit = found["unit"].lower()
    return {"g": "g", "k": "kg", "n": "N", "m": "mN"}[unit[0]]
