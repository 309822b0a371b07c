"""Forces that a text names without asking for them: another object's, and those that are allowed.

'Grasp the strawberry. The egg needs 3 N.' asks for no 3 N, and 'you may go over 2 N' for no more than
usual. Not here: forces of the past and what they led to (``outcomes``).
"""

from __future__ import annotations

import re
from typing import NamedTuple

from policies.instructions.english import words
from policies.instructions.english.number_pattern import NumberPattern
from policies.instructions.quantities.force import MARK
from policies.instructions.quantities.force_units import NUMBER, ONE_FORCE, UNIT
from policies.instructions.quantities.masses import OBJECT

_TAKES = (
    r"(?:needs?|needed|takes?|took|wants?|wanted|requires?|required|gets?|got|calls? for|likes?|(?:can|could|may|might|must|should|will|would) (?:\w+ )?(?:take|get|have|stand|bear|need)|"
    r"(?:is|was|were|are) (?:held|gripped|picked|done|fine|happy|good|set|run) (?:up )?(?:with|at))"
)
_OF_OBJECT = NumberPattern(
    rf"\b(?P<object>{OBJECT})(?: (?:here|there|before|yesterday|earlier|over there))?,? "
    rf"(?:(?:which|that|it|usually|always|normally|only|really|just) )*{_TAKES} "
    rf"(?:(?:about|around|roughly|some|only|just|at least|at most|up to|a|an) )*(?P<force>{ONE_FORCE}"
    rf"(?: ?(?:to|-|–|and) ?{ONE_FORCE})?)"
)
"""'The egg which needs 4 N'."""
_NEWTONS = rf"{NUMBER}\s*-?\s*(?:{UNIT})\b"
_WEIGHT = NumberPattern(
    rf"\b(?:weigh(?:s|ed|ing)?(?: in)?(?: at)?|weight(?: of| is| was|:)?|label(?:l?ed)?|marked|engraved|stamped)(?: (?:about|around|roughly|only|just))? ?['\"]?(?P<force>{_NEWTONS})"
    rf"|(?P<other>{_NEWTONS})['\"]? (?:(?:test|dead|brass|steel|calibration) )?(?:weights?|springs?|dumb-?bells?|magnets?|load cells?|sensors?|(?:force )?gauges?|heavy|in weight)\b"
)
"""'The apple that weighs 1.5 N', 'beside the 2 N weight'."""
_DEVICE = NumberPattern(
    rf"\b(?:load ?cell|friction|lid|suction|vacuum|spring|magnet\w*|cable|belt|motor|payload|preload)(?: (?:range|force|capacity|rating|load|pull))+(?: (?:is|of|about))* ?:? ?(?P<force>{_NEWTONS})"
    rf"|\b(?:while|when|as) (?:i|we|he|she|they|someone) (?:pull|push|tug|lift|press)\w*(?: (?:on )?(?:it|the \w+))? (?:with|at|by) (?P<mine>{_NEWTONS})"
    rf"|(?P<other>{_NEWTONS}) of (?:suction|vacuum|pull|friction|thrust|drag)\b"
)
"""'Load cell range 5 N', 'while I pull with 3 N', '3 N of suction'."""
_AS_MUCH_AS = re.compile(r"\b(?:as \w+ as|like|than)(?: (?:the|an?|that|this|my|our))? $")
_PART = NumberPattern(
    rf"\b(?:stem|stalk|lid|cap|cork|label|peel|leaf|leaves|calyx|sticker|button|key|switch|latch|zip)s? (?:\w+ )?(?:comes?|came|pulls?|pulled|peels?|breaks?|snaps?|pops?|detach\w*|separat\w*|opens?|clicks?|holds?|needs|takes|resists)\b[^.;,#]{{0,30}}?(?P<force>{ONE_FORCE})"
)
"""'The stem comes off with 2.5 N'."""
_ANY = re.compile(r"specimen|sample|object|item|piece|thing\w*|target|ones?")
"""What may be any object: 'pick this one, the egg needs 3 N' is about one."""
_THAT_TOOK = re.compile(r"ones?,? (?:that|which) (?:took|needed|wanted|required|got|was|were)\b")
"""'Riper than the one that took 2 N'."""
_LIFTED = NumberPattern(
    rf"\b(?:there is )?(?:no need|no reason|not (?:need|have)|not (?:necessary|needed|required|true that (?:it|you) (?:must|has|have))|need not)(?: (?!not\b|never\b)\w+){{0,4}}? (?:below|under|beneath|less than) {ONE_FORCE}"
)
"""'There is no need to stay below 1 N': a bound that is lifted asks for nothing."""
_THING = rf"(?:the |an? |my |our |your |his |her |that |this |those |these |all |every |each |any )?(?:(?:other|raw|fresh|green|next|neighbou?ring|big|small) )*(?P<object>{words.any_of('other_object')}|(?<=other )(?!(?:straw)?berr|fruit)\w+)\b(?: over there| (?:in|on|at) the \w+| next door| beside it)?"
_BOUND = r"(?:(?:upper|lower|force|grip|hard|top|safe|allowed|maximum|minimum|max|min) )*(?:limits?|max(?:imum)?|min(?:imum)?|ceiling|cap|bound|threshold|force|target|set-?point|setting|preset|recipe|profile)"
_FIGURE = rf"(?:(?:of|at|is|was|are|to|about|around|only|just|at most|at least|no more than|not more than|up to|never more than|under|below|max|maximum|:|=) ?)*(?P<force>{ONE_FORCE}(?: ?(?:to|-|–|and) ?{ONE_FORCE})?)"
_BOUND_OF = tuple(
    NumberPattern(pattern)
    for pattern in (
        rf"\b{_BOUND} (?:on|for|of|with) {_THING},? {_FIGURE}",
        rf"\b{_THING}(?:'s?)? {_BOUND},? {_FIGURE}",
        rf"\b{_THING}(?: (?:always|only|usually))? (?:is|are|was|were|may|must|can|should|shall|will|has to|have to|gets?|needs?|takes?|wants?|requires?) (?:(?:not|never|be|get|have|take|exceed|only|always|held|gripped|picked|taken|squeezed|pressed|touched|handled|with|at|by) )*{_FIGURE.replace('at most', 'more than|over|above|at most')}",
        rf"\b(?:on|for|with|as for) {_THING}[,:]? (?:(?:the|a|our|my|its) )?(?:{_BOUND} )?(?:(?:it|we|they|you|i|that|this) (?:\w+ly )?(?:is|are|use|take|takes|need|needs|want|go with|hold|give) )?(?:with )?{_FIGURE}",
        rf"\b(?:we|they|i|people|you) (?:usually |always |normally |only )?give {_THING} {_FIGURE}",
        rf"(?P<force>{ONE_FORCE})(?: (?:is|was|as))?(?: (?:the|a|our|an|my))?(?: {_BOUND})? (?:for|on|of|with) {_THING}",
    )
)
"""'The limit on the egg is 3 N', 'for eggs at most 1 N', '1 N for the egg'."""
_HOLDS = rf"\b{words.any_of('hold')}(?: up| on| onto| hold of)? (?:(?:the|a|an|this|that|my|our|your|these|those|another|some) )?(?:\w+ ){{0,2}}?"
_HELD = re.compile(rf"{_HOLDS}(?P<object>{OBJECT})")
"""'Pick the ripe berry'."""
_AN_OBJECT = rf"(?:for|on|to) (?:the |this |these |my |our |an? )?{OBJECT}"
_GIVEN = NumberPattern(
    rf"\b(?:use|apply|take|set|try|give|go with|make it)\b[^.;]*{ONE_FORCE}|"
    rf"{ONE_FORCE} {_AN_OBJECT}|\b{_AN_OBJECT}\b[^.;]*{ONE_FORCE}"
)
"""'Use 1 N on the berry'."""
_SAME = re.compile(
    r"\b(?:like|as if|as though|as with|too|also|same|treat|use the|both|either|or)\b"
)
"""What gives the bound of another object to this one."""
_CLAUSE = re.compile(r"[.,;:!?()](?!\d)|\s[-–—]+\s|—|\b(?:and|but|while|because|since|so|as)\b")
_ALLOWED = NumberPattern(
    r"\b(?:you (?:may|can|could|might|are (?:allowed|free|welcome|permitted) to)|feel free to|"
    r"(?:it is|that is|it would be|i am) (?:perfectly |quite |absolutely )?(?:fine|ok(?:ay)?|al(?:l )?right|no problem|acceptable|happy)(?: with me| by me)?"
    r" (?:if (?:it|you|the (?:force|grip)) |to |for you to )|(?:i|we) do not (?:mind|care) if (?:it|you|the (?:force|grip)) )"
    rf" ?(?:(?!not\b|never\b|only\b|no\b)\w+ ){{0,4}}?(?:over|above|beyond|past|more than|exceed(?:s|ing)?|higher than) {ONE_FORCE}"
    r"(?:,? (?:if|when|where|as) (?:\w+ )?(?:you )?(?:need|needed|necessary|must|have|like|want|required)(?: (?:to|be))?\b)?"
    r"(?!(?: (?:if|when|where|as)[^.;,]{0,20})?,? (?:but|and|yet|though) (?:please |do )?(?:not|never)(?: (?:with|go|use))? (?:less|below|under|lower)\b)"
)
"""'You may go over 2 N if you need to': what is allowed is not asked for."""


_COMPARED_ASIDE = re.compile(
    rf",? which is (?:(?:a bit|a little|much|far|rather|somewhat|slightly) )?(?:more|less|firmer|softer|higher|lower|harder) than (?:what )?(?:i|we|you) (?:would |do |did |had to )?(?:use|used|need|needed|apply|take|took|try) (?:on|for|with) (?:an? |the |my |our )?(?:{words.any_of('other_object')}|raspberr(?:y|ies)|blackberr(?:y|ies)|blueberr(?:y|ies))\b"
)
"""'2 N, which is more than I would use on a raspberry'."""


_CONTRASTED = re.compile(
    rf"(?:(?<=^)|(?<=[.;!] ))(?:(?:with|for|as for|on) )?(?:(?:the|an?|my|our|those|these) )?(?:\w+ )?(?:{words.any_of('other_object')}|raspberr(?:y|ies)|blackberr(?:y|ies)|blueberr(?:y|ies))\b(?![^.;]*\b(?:straw ?berr|pick|lift|grab|take)[^,]*,)(?:[^.;,]|\.(?=\d))*(?:, (?:i know|of course|sure|fine|granted|as you know|admittedly|true))?, (?:but|whereas|while|yet) (?=[^.;]*\b(?:straw ?berr(?:y|ies)|berr(?:y|ies)|this (?:one|fruit))\b)"
)
"""'Plums put up with 4 N, but this strawberry tolerates only 1.6 N.'"""


def without_other_forces(text: str) -> str:
    """A plain text with ``MARK`` for the forces of other objects, and 'the usual' for what is allowed.

    Args:
        text: Plain text, its numbers in digits.
    """
    text = _CONTRASTED.sub("", _COMPARED_ASIDE.sub("", text))
    text = _LIFTED.sub("the usual grip will do", _ALLOWED.sub("the usual grip will do", text))
    for pattern in (_WEIGHT, _DEVICE):
        for match in reversed(list(pattern.finditer(text))):
            if _AS_MUCH_AS.search(text[: match.start()]):
                continue  # 'as hard as a 2 N spring'
            start, end = match.span(match.lastgroup or "force")
            text = f"{text[:start]}{MARK}{text[end:]}"
    if part := _PART.search(text):
        text = f"{text[: part.start('force')]}{MARK}{text[part.end('force') :]}"
    text = _without_bounds_of_others(text)
    for match in reversed(list(_OF_OBJECT.finditer(text))):
        rest = f"{text[: match.start()]} {text[match.end() :]}"
        named = (each[0] for each in re.finditer(OBJECT, rest))
        others = {kind_of(name) for name in named if not _ANY.fullmatch(name)}
        is_named = not _ANY.fullmatch(match["object"])
        is_other = is_named and others and kind_of(match["object"]) not in others
        if re.search(ONE_FORCE, rest) and not (_HELD.search(rest) or _GIVEN.search(rest)):
            continue  # 'the tomato gets 2 N, the berry 1 N' does not say which one is held
        if is_other or _THAT_TOOK.match(match[0]):
            text = f"{text[: match.start('force')]}{MARK}{text[match.end('force') :]}"
    return text


class SaidNeed(NamedTuple):
    """What a text says that an object needs.

    Attributes:
        object: The object ('egg'); its kind, in the singular.
        words: The words that say so.
    """

    object: str
    words: str


def need_of(text: str) -> SaidNeed | None:
    """The first need of a named object that a text says; None where it says none.

    Args:
        text: A text after ``without_other_forces``.
    """
    for match in _OF_OBJECT.finditer(text):
        if not _ANY.fullmatch(match["object"]):
            return SaidNeed(kind_of(match["object"]), match[0])
    return None


_KNOWN = rf"(?:straw ?berr(?:y|ies)|berr(?:y|ies)|{words.any_of('other_object')})\b"
_CHOSEN = rf"{_HOLDS}(?P<object>{_KNOWN})"
_LEFT = rf"(?:(?:the|a|an|this|that|my|our|your|these|those|any) )?(?:\w+ )?(?P<left>{_KNOWN})"
_ELSE = r"(?!(?:it|that|this|one|them|these|those|straw ?berr\w*|berr\w*|fruits?|object|thing|item|piece|specimen|sample|force|grip|firm|gentle|soft|good)\b)[a-z]+"
_IN_PLACE = (
    re.compile(
        rf"\b(?:forget|never mind|ignore|skip|leave|leave out) (?:about )?{_LEFT}[;,.:!]? (?:(?:and|but|instead|please|just) )*(?:(?:i|we) (?:want|need|would like) you to )?{words.any_of('hold')}(?: up| hold of)? (?:the|that|this|my|our|a|an) (?:\w+ )??(?P<object>{_ELSE})(?=[.;,!?]| instead| please|$)"
    ),
    re.compile(
        rf"\b(?:want|need|take|meant?) (?:the |an? |that |this |my |our )?(?P<object>{_KNOWN}),? (?:and )?not {_LEFT}"
    ),
    re.compile(
        rf"{_CHOSEN}[^.;:!?]{{0,30}}?,? (?:instead of|rather than|in place of|and not|not) {_LEFT}"
    ),
    re.compile(
        rf"\b(?:instead of|rather than|in place of|not|forget(?: about)?) {_LEFT}[^.;:!?]{{0,20}}?,? {_CHOSEN}"
    ),
)
"""'Pick up the tomato instead of the berry'."""


def in_place_of(text: str) -> tuple[str, str]:
    """Kinds of what is to be held, and of what is not to be held; '' without such a choice.

    Args:
        text: Plain text, its numbers in digits.
    """
    for pattern in _IN_PLACE:
        if match := pattern.search(text):
            return kind_of(match["object"]), kind_of(match["left"])
    return "", ""


def is_another(name: str, task_object: str) -> bool:
    """Whether the kind of an object is not that of a task's object ('cherry_tomato')."""
    return "fruit" not in (name, task_object) and name != kind_of(task_object.split("_")[-1])


def _without_bounds_of_others(text: str) -> str:
    """A plain text with ``MARK`` for bounds of objects other than those that are to be held."""
    if _SAME.search(text):
        return text
    for pattern in _BOUND_OF:
        for match in reversed(list(pattern.finditer(text))):
            rest = f"{text[: match.start()]}. {text[match.end() :]}"
            held = {kind_of(each["object"]) for each in _HELD.finditer(rest)}
            clause = _CLAUSE.split(text[: match.start()])[-1] + match[0]
            if _HELD.search(clause):
                continue  # 'pick the berry out of the box with at most 1 N'
            is_other = text[: match.start("object")].endswith("other ")
            named = "other" if is_other else kind_of(match["object"])
            is_told_apart = is_other or any(not _ANY.fullmatch(name) for name in held)
            if held and is_told_apart and named not in held:
                text = f"{text[: match.start()]}{MARK}{text[match.end() :]}"
    return text


def kind_of(name: str) -> str:
    """A fruit by one name: 'straw berries' and 'berry' are strawberries here."""
    return "berry" if "berr" in name else re.sub(r"(?<=o)es$|s$", "", name)
