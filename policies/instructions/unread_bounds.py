"""Words of a bound that no force was read with.

'0.7 N is its breaking point' names one force, and words that bound it in a way that nothing reads. It
would be taken for a wish, and held with more than the bound. So where a text has such words left
beside its only forces, it is refused.

Not here: bounds that are read (``quantities``), forces that are only stated (``statements``).
"""

from __future__ import annotations

import re

from policies.instructions.quantities import MARK, Quantities

_UPPER = re.compile(
    r"\b(?:limits?\b|max(?:imum|imal)?\b|caps?\b|ceiling|(?:the|my|our|your) most\b|exceed\w*|breaking point|point of no return|"
    r"nothing (?:above|over|beyond|more|higher|harder|stronger)|not (?:an?|one|1|any) (?:\w+ )?(?:above|over|higher|more|harder)|"
    r"upper|highest|(?:lower|less|softer|gentler|weaker) than (?:that|this|it)\b|(?:stay|remain|keep|be) (?:\w+ )?(?:lower|below|under)\b|"
    r"(?:not|never) (?:\w+ )?(?:reach|pass|cross|exceed)\b|(?:not|never) (?:\w+ )?go (?:past|over|above|beyond) (?:it|that|this)\b)"
)
_LOWER_ALONE = (
    r"(?:the|my|our|your) least\b|feebler|nothing (?:feebler|weaker|softer|less|below|under|looser)|as good as lost|too (?:gentle|weak|loose|little|feeble)\b|"
    r"(?:not|never) (?:\w+ ){0,3}(?:weaker|looser|feebler)\b|(?:rejects?|refuses?) (?:\w+ ){0,3}# \. (?:see to it|make sure)"
)
_LOWER = re.compile(
    rf"\b(?:{_LOWER_ALONE}|min(?:imum|imal)?\b|(?<!on the )(?<!to the )(?<!onto the )(?<!off the )(?<!on )floor\b|lower (?:limit|bound|end)|lowest|(?:weaker|looser|softer|less|lower) than (?:that|this|it)\b|(?:not|never) (?:\w+ ){{0,3}}(?:under|below)\b)"
)
_LOWER_BESIDE_MOST = re.compile(rf"\b(?:{_LOWER_ALONE}|(?:get|be) that (?:loose|weak|soft)\b)")
_MORE_THAN = re.compile(
    r"\b(?:more than|over|above|beyond|exceed\w*|past|higher than|harder than|in excess of)\b"
)
_DENIED = re.compile(
    r"\b(?:not|never|no|nothing|nobody|none|neither|nor|forbid\w*|refus\w*|avoid\w*|prohibit\w*|refrain\w*|abstain\w*|desist\w*|cannot)\b"
    r"(?! matter\b)(?![^,.;:!?#(–—-]{0,40}\b(?:slip|drop|fall|los[et]|hesitat|afraid|shy|mind|worry|problem|break|bruis|crush|hurt|damag|gentl|soft|careful)\w*)[^.;:!?#]*#"
)
_NO_DENIAL = re.compile(r"\b(?:not|never|no|nothing|nobody|neither)\b")
_HARMED = re.compile(
    r"^[^#]*#[^.;:!?#]*\b(?<!the )(?<!this )(?<!that )(?<!a )(?<!my )(?:crushed|squashed|burst|bruised|broke|ruined|damaged|destroyed|split|mangled)\b[^#]*$"
)
"""'The 1.6 N we used in the pilot crushed every raspberry.'"""
_OF_FORCE = re.compile(r"\b(?:milli)?newtons?\b")
_BARE = re.compile(r"\d+\.\d+")


def unread_bound(numbers: Quantities) -> str:
    """Why a text's forces may be bounds that were not read as such; '' where none may."""
    kinds = {force.kind for force in numbers.forces}
    if not kinds:
        return _without_unit(numbers)
    found = (
        None
        if "most" in kinds
        else (_UPPER.search(numbers.rest) or _denied_more(numbers) or _HARMED.search(numbers.rest))
    )
    if not found and "least" not in kinds:
        lower = _LOWER_BESIDE_MOST if "most" in kinds else _LOWER
        found = lower.search(numbers.rest)
    if not found:
        return ""
    return (
        f"{found[0].replace(MARK, '...')!r} may bound the force, and no bound was understood; say 'at most ...', "
        "'at least ...' or 'use ...' with the number behind it"
    )


def _denied_more(numbers: Quantities) -> re.Match[str] | None:
    """A denial before 'more than 1 N' that was read as a least force: it may be a limit."""
    is_more = any(
        force.kind == "least"
        and _MORE_THAN.search(force.words)
        and not _NO_DENIAL.search(force.words)
        for force in numbers.forces
    )
    return _DENIED.search(numbers.rest) if is_more else None


def _without_unit(numbers: Quantities) -> str:
    """Why to refuse newtons that stand apart from their number."""
    bare = _BARE.search(numbers.rest)
    is_changed = numbers.delta_n is not None or numbers.factor is not None
    if not bare or is_changed or not _OF_FORCE.search(numbers.rest):
        return ""
    return f"{bare[0]} has no unit; say '{bare[0]} N'"
