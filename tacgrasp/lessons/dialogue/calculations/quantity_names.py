"""Names of quantities and units in plain words, as patterns.

Not here: what is made of them (``tacgrasp.lessons.dialogue.calculations.terms``).
"""

from __future__ import annotations

import re
from collections.abc import Mapping

from tacgrasp.lessons.dialogue.quantities import MEAN_PRESSURE
from tacgrasp.lessons.dialogue.written_units import SPELLED

_THING = (
    r"(?:object|thing|berry|strawberry|fruit|item|part|piece|egg|tomato|peg|load|body|specimen|"
    r"sample|product|article|workpiece|good|goods|payload|carton|box|jar|bottle|component|weight|"
    r"block|parcel|package|lump|bracket|casting|cup|glass|vial|apple|gadget|unit|brick|tool|mass)"
)
THING = _THING
"""What a mass may be of."""

_OF_THING = rf"(?: of (?:the |this |that |our )?{_THING})"
_BAND_NAME = (
    r"(?:(?:target|wanted|goal|force|grip|desired|requested|required|agreed|intended|set|permitted|"
    r"allowed|given|specified|aimed at|asked for|prescribed|sanctioned|approved|allotted|working|"
    r"safe|acceptable|admissible|ordered) )*"
    r"(?:band|range|window|corridor|interval|goal|target|bracket|zone)"
)
_LOW = r"(?:lower|lowest|low|bottom|minimum|least|min|floor|foot|base)"
_HIGH = r"(?:upper|highest|high|top|maximum|most|max|ceiling|roof)"
_END = (
    r"(?:end|edge|bound|boundary|border|limit|side|rim|value|force|threshold|point|mark|part|line)"
)
_OWN = r"(?:the |our |my |your |this |that )?"
_MIDDLE = r"(?:middle|midpoint|mid point|center|mid|mean|average)"
_ON = (
    r"(?: (?:on|against|at|in|onto|upon|of) (?:the )?(?:pad|gel|sensor|object|contact|finger|grip|"
    r"skin))?"
)


def _ends(which: str) -> str:
    """Names of one end of the band."""
    return (
        rf"{which}(?: {_END})? (?:of|in|to) {_OWN}{_BAND_NAME}(?: of force)?|"
        rf"{_BAND_NAME}(?:'s| is)? {which}(?: {_END})?|{which} {_BAND_NAME} {_END}|"
        rf"{which} (?:wanted|requested|desired|required) force|{which} force (?:wanted|requested)"
    )


_ALLOWED = r"(?:permitted|allowed|permissible|allowable|admissible|tolerated)"
_MAXIMUM = r"(?:maximum|max|most|highest|largest)"
_FORCE = r"(?: (?:force|grip|squeeze|pressure))"
_LIMIT = (
    rf"(?:(?:force|grip|squeeze|hard|upper|safety|absolute|maximum|max|never exceed|{_ALLOWED}) )*"
    rf"(?:limit|ceiling|cap|cut ?off)(?: (?:force|value|line|mark|figure))?|"
    rf"never exceed(?: (?:limit|value|force|mark|figure|line|level|threshold|number))?|"
    rf"{_ALLOWED} (?:{_MAXIMUM}{_FORCE}?|force)|{_MAXIMUM} {_ALLOWED}{_FORCE}?|"
    rf"{_MAXIMUM}{_FORCE} (?:that is )?{_ALLOWED}|limiting force|force (?:at|of) the limit|"
    rf"what is {_ALLOWED}(?: at (?:the )?most)?|(?:the )?most (?:that is |we are )?{_ALLOWED}|"
    rf"(?:absolute|hard) {_MAXIMUM}{_FORCE}?|force {_MAXIMUM}"
)
_NEVER = (
    r"(?:(?:that|which) )?(?:(?:we|you|i|it|one|nobody) )?(?:must|may|should|can|shall|is|are) "
    r"(?:never|not)(?: (?:to|ever))?(?: (?:be|get))?(?: (?:exceed|exceeded|cross|crossed|pass|"
    r"passed|break|broken|violate|violated|overstep|overstepped|go over|go past|surpass|surpassed))"
)
_PAD = (
    r"(?:(?:whole|entire|full|complete|sensing|sensor|gel|touch|tactile) )*(?:pad|sensor|gel|skin|"
    r"sensing (?:area|surface|window))"
)
_AS_TOLD = (
    r"(?: (?:that )?(?:(?:was |were |has been )?(?:told|stated|given|agreed|entered|declared)|"
    r"(?:you|we|i) (?:(?:were|was|are|am|have|been) )*(?:know|told|given|said|entered|agreed)"
    r"(?: (?:you|me|us|on|about|of|before))*))"
)
_AGREED = (
    r"(?:(?: that| which)?(?: (?:we|you|i|they))?(?: (?:have|had|has been|is|was))? (?:agreed|"
    r"settled|decided|wanted?|desired|asked)(?: (?:on|upon|for))?)"
)
_SURELY = (
    r"(?:sure|sure hold|sure holding|surely held|surely holdable|guaranteed|certain|safe|secure|"
    r"safely held|safe working|sure carrying)"
)
_HELD = r"(?:load|mass|weight|payload|holding capacity|capacity|holding mass|hold)"
_NAMED: Mapping[str, tuple[str, str]] = {
    rf"(?:normal |contact |grip |gripping |grasp |pressing |squeezing |pinch |clamping |clamp |"
    rf"holding |squeeze |pushing |pressing )*(?:force|squeeze|push|pressure|grip|pinch|press|clamp|"
    rf"clench|grasp)"
    rf"{_ON}|(?:grip|force|squeeze) (?:strength|level|reading)|clamping|squeezing|"
    r"(?:force |what )?(?:that )?(?:you|we)(?: are)? (?:feel|press|apply|measur|sens|exert|squeez|"
    r"push|clamp)(?:e|ing)?"
    r"(?: with)?(?: at present| now)?|force felt": (
        "force_n", "force",
    ),
    rf"(?:{_LIMIT})(?: {_NEVER})?": ("limit_n", "force"),
    rf"(?:force|value|grip|figure|number|mark|line|squeeze|cut ?off) {_NEVER}": (
        "limit_n", "force",
    ),
    _ends(_LOW): ("band_low_n", "force"),
    r"(?:agreed|wanted|required|requested|desired) (?:minimum|min)(?: force)?|"
    rf"(?:least|lowest|smallest|minimum|weakest){_FORCE}{_AGREED}": ("band_low_n", "force"),
    rf"{_ends(_HIGH)}|(?:most|highest|largest|strongest){_FORCE}{_AGREED}": (
        "band_high_n", "force",
    ),
    rf"{_MIDDLE} of (?:the |our )?{_BAND_NAME}|{_BAND_NAME}(?:'s)? {_MIDDLE}": (
        "(band_low_n + band_high_n) / 2", "force",
    ),
    rf"(?:width|span|breadth) of (?:the |our )?{_BAND_NAME}|{_BAND_NAME}(?:'s)? (?:width|span)": (
        "band_high_n - band_low_n", "force",
    ),
    rf"(?:maximum |max |largest |peak |contact |dent |gel |press |indentation |penetration |"
    rf"imprint |greatest |"
    rf"deepest )*(?:depth|"
    rf"indentation|dent|penetration|imprint)(?: of (?:the )?(?:contact|dent|press|"
    rf"indentation|imprint|{_THING}))?": ("depth_mm", "length"),
    r"(?:contact |touched |covered |pressed |touching )*(?:area|patch|footprint|"
    r"coverage)(?: (?:size|percentage|share))?(?: of (?:the )?contact)?|"
    r"(?:touched|covered|pressed) (?:share|part|portion|fraction|percentage)(?: of (?:the )?pad)?|"
    r"(?:share|part|portion|fraction|percentage) of (?:the )?pad (?:that is )?"
    r"(?:touched|covered|pressed)": ("area_percent", "fraction"),
    r"(?:free|untouched|uncovered) (?:part|share|portion|area|rest)(?: of (?:the )?pad)?": (
        "100 - area_percent", "fraction",
    ),
    r"abs x": ("abs(x_mm)", "length"),
    r"abs y": ("abs(y_mm)", "length"),
    r"x(?: (?:offset|coordinates?|value|position|component|displacement))?|(?:horizontal|sideways|"
    r"lateral|left right) (?:offset|position|displacement|coordinate)(?: of (?:the )?(?:contact|"
    r"touch|patch|print)(?: spot| point| patch)?)?|contact's x": (
        "x_mm", "length",
    ),
    r"y(?: (?:offset|coordinates?|value|position|component|displacement))?|(?:vertical|lengthwise|"
    r"up down|up and down) "
    r"(?:offset|position|displacement|coordinate)(?: of (?:the )?(?:contact|touch|patch|print)"
    r"(?: spot| point| patch)?)?|contact's y": ("y_mm", "length"),
    r"sum of (?:both|(?:the )?(?:two|#\d+)) (?:coordinates|offsets)(?: of (?:the )?contact)?": (
        "x_mm + y_mm", "length",
    ),
    rf"(?:radial )?(?:distance|offset)(?: of (?:the )?(?:contact|{_THING}))? (?:from|to) "
    r"(?:the )?(?:pad )?(?:middle|center)(?: of (?:the )?pad)?": ("hypot(x_mm, y_mm)", "length"),
    rf"(?:(?:stated|told|agreed|given|declared|entered|known) )?mass{_OF_THING}?{_AS_TOLD}?|"
    rf"{_THING}(?:'s)?(?: own)? mass{_AS_TOLD}?": ("mass_g", "mass"),
    rf"{_PAD}(?:'s)? (?:width|breadth)|(?:width|breadth) of (?:the )?{_PAD}": (
        "pad_width_mm", "length",
    ),
    rf"{_PAD}(?:'s)? height|height of (?:the )?{_PAD}": ("pad_height_mm", "length"),
    rf"{_PAD}(?:'s)? diagonal|diagonal of (?:the )?{_PAD}": (
        "hypot(pad_width_mm, pad_height_mm)", "length",
    ),
    r"(?:payload|carrying capacity|holding capacity|heaviest load|load it holds)|"
    rf"(?:maximum |max |heaviest |largest |most )?{_SURELY} {_HELD}|"
    rf"(?:maximum |max |heaviest |largest )?{_HELD} (?:that )?(?:(?:it|we|i|you|the grip|"
    rf"this grip) )?"
    r"(?:is |can |could )?(?:be )?(?:surely|safely|certainly|definitely|for sure|"
    r"for certain) (?:held|holds?|carried|"
    r"carries|carry|bears?|supports?)|what (?:it|the grip|this grip) (?:surely|safely) holds": (
        "holds_g", "mass",
    ),
    rf"(?:gap|room|distance|difference|space) between (?:the )?(?:top of (?:the )?)?{_BAND_NAME} "
    r"and (?:the )?limit": ("limit_n - band_high_n", "force"),
    r"safety factor|factor of safety|holding factor": ("holds_g / mass_g", "ratio"),
    r"(?:headroom|margin|room|reserve|leeway|slack)(?: left)? (?:to|below|under|before|until|"
    r"up to) "
    r"(?:the )?(?:force )?limit|headroom": ("limit_n - force_n", "force"),
    r"(?:mean|average|nominal) (?:contact |normal )?(?:pressure|stress)(?: (?:on|"
    r"over) (?:the )?(?:contact|patch|pad|contact "
    r"area|contact patch))?": (MEAN_PRESSURE, "pressure"),
    r"(?:whole |full |entire )?(?:pad|sensing area)|(?:full|complete|total) coverage": (
        "100", "fraction",
    ),
    r"what (?:the )?(?:(?:force )?limit|contract|rules?|spec|task|instructions?) (?:lets?|allows?|"
    r"permits?) "
    r"(?:(?:you|us|me|it|the gripper) )?(?:(?:to )?(?:apply|use|exert|press with|put on|"
    r"squeeze with))?"
    r"(?: at (?:the )?(?:very )?most)?": ("limit_n", "force"),
    r"(?:needed|required|necessary) force|what is (?:needed|required)(?: (?:for|to hold) it)?": (
        "gram_n * mass_g", "force",
    ),
}  # fmt: skip
NAMED = [(re.compile(pattern), *meant) for pattern, meant in _NAMED.items()]
"""Names of a quantity without its article, its expression, and the dimension of its unit."""

_LIFTED = (
    r"(?:(?:is |are )?(?:being )?(?:lifted|held|carried|gripped|grasped|hoisted)|"
    r"(?:we|you|i|they|it|the (?:gripper|robot))(?: (?:are|is|am|have to))? (?:lift|hold|carry|"
    r"grip|hoist|pick|grasp|mov)(?:e|s|ing)?(?: up)?|hangs? (?:in|from) (?:the |our |your )?"
    r"(?:grip|gripper|hand|fingers))"
)
_BODY = (
    rf"(?:(?:(?:the|this|that|our|its) )?(?:lifted |held |gripped |carried |grasped )?{_THING}"
    rf"(?: (?:that |which )?{_LIFTED}| in (?:the |our |your )?(?:grip|gripper|hand|fingers))?|"
    rf"what {_LIFTED})"
)
WEIGHT = re.compile(
    rf"(?:(?:own|plain|dead|bare) )*weight(?: of {_BODY})?(?: as a force)?|"
    r"weight of (?:the|this|that|our|my) (?!(?:force|grip|squeeze|limit|band|depth|area|contact|"
    r"touch|pad|gel|press|gripper|robot|hand)\b)[a-z]+(?: as a force)?|"
    rf"(?:lifted |held |gripped )?{_THING}(?:'s)?(?: own)? weight|what {_BODY} weighs|"
    rf"(?:lifted|held|gripped|carried) {_THING}|{_THING} (?:that |which )?{_LIFTED}|"
    rf"gravity's pull(?: (?:on|at) {_BODY})?|(?:pull|force) of gravity(?: (?:on|at) {_BODY})?"
)
"""Names of the mass that are asked for in newtons too."""

_BAND = re.compile(rf"(?:(?:the|our|this|whole of|all of|whole|entire) )*{_BAND_NAME}")

_UNIT_WORDS: Mapping[str, str] = {
    r"kgf|(?:kg|kilos?|kilograms?) (?:of )?force": "kgf",
    r"lbf|(?:pounds?|lbs?) (?:of )?force": "lbf",
    r"ozf|(?:ounces?|oz) (?:of )?force": "ozf",
    r"(?:g|grams?) (?:of )?force": "g",
    r"pounds|lbs": "lb",
    r"ounces|oz": "oz",
    r"inch(?:es)?": "in",
    r"thou|mils": "thou",
    r"(?:n|newtons?) per (?:cm²|(?:square|sq) (?:cm|centimet(?:re|er)s?))": "N/cm²",
    r"(?:n|newtons?) per (?:mm2|mm²|(?:square|sq) (?:mm|millimet(?:re|er)s?))": "N/mm²",
    **SPELLED,
    r"percentage points?|points?|per cent": "%",
    r"cm²|(?:square|sq) (?:cm|centimet(?:re|er)s?)": "cm²",
    r"nm|nanomet(?:re|er)s?": "nm",
    r"decimillimetres|dmm": "dmm",
    r"centimillimetres|cmm": "cmm",
    r"decinewtons|dn": "dN",
    r"pa|pascals?": "Pa",
    r"hpa|hectopascals?": "hPa",
    r"kpa|kilopascals?": "kPa",
    r"mpa|megapascals?": "MPa",
    r"mbar|millibars?": "mbar",
    r"bar": "bar",
    r"psi": "psi",
    r"mmhg|(?:mm|millimet(?:re|er)s?) (?:of )?(?:hg|mercury)": "mmHg",
    r"atm|atmospheres?": "atm",
    r"dan|decanewtons?": "daN",
    r"mm³": "mm³",
    r"cm³|ccm": "cm³",
    r"ul|µl|microlit(?:re|er)s?": "µL",
    r"ml|millilit(?:re|er)s?": "mL",
}
UNIT = "|".join(_UNIT_WORDS)
"""Words of the units that a calculation may be in."""


def is_band(words: str) -> bool:
    """Whether a noun phrase is the band itself, whose nearer end counts above and below it."""
    return _BAND.fullmatch(words) is not None


def unit_of(words: str) -> str:
    """The unit that plain words name."""
    return next(unit for said, unit in _UNIT_WORDS.items() if re.fullmatch(said, words))
