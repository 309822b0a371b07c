"""What became of an earlier grip: a force at which it slipped is a least, one that did harm a most.

'It slipped at 0.5 N', '0.5 N was not enough', 'the last one cracked at 2 N', 'it can take 2 N'. A force
that only 'did not work' may have been too little or too much, and is not to be used. Not here: bounds
that a text states itself (``relations``).
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Literal

from policies.instructions.quantities.force import NO_OTHER_FORCE


@dataclass(frozen=True, slots=True, kw_only=True)
class EarlierGrip:
    """What a text says became of one force.

    Attributes:
        kind: 'least' where it was too little, 'most' where it did harm, 'failed' where neither is
            said.
        left_cut: Where its words begin in the text before the force.
        right_cut: Where they end in the text behind it.
    """

    kind: Literal["least", "most", "failed"]
    left_cut: int
    right_cut: int


_MAY = r"(?:will|would|might|may|can|could|shall|should|did|does|do|to|start(?:s|ed)? to|began to|begins to|tend(?:s|ed)? to)(?: \w+ly| just| still| only| always| simply| have)?"
_LOOSE = r"(?:away|loose|free|out|off|down)"
_SLIPPED = (
    rf"(?:slip(?:s|ped|pe?d|page|ping)|(?<!on )(?<!for )(?<!the )(?<!of )(?<!glass )(?<!with )slid(?:e?d|den|es|ing)?|falls|fell|fallen|falling|dropped|drops|dropping|tumble[sd]|escape[sd]|wobble[sd]|roll(?:s|ed)|turn(?:s|ed)(?! (?:an?|the|it|this|that|my|your|into|to|mush\w*|soft|brown|black|red|dark|bad|sour|watery|pulpy|squashy|slimy|wet|blue|purple)\b)|twist(?:s|ed)|rotate[sd]|shift(?:s|ed)|moved|moves|"
    rf"{_MAY} (?:be )?(?:slip(?:ped)?|slide|fall(?:en)?|drop(?:ped)?|escape|roll|turn|twist|shift|move|lose (?:it|grip|hold|contact))|"
    rf"(?:got|gets|getting|came|comes|coming|went|goes|broke|breaks|popped|pops|wriggle[sd]|worked|flew|shot|jumped) (?:right |straight |completely )?{_LOOSE}\b(?! (?:of|(?:\w+ly )?(?:clean|fine|ok(?:ay)?|well|good|great|best|perfect\w*|nice\w*|beautiful\w*|all ?right|intact|whole|unharmed|undamaged|unmarked|unscathed|unbruised|spotless|as|on top|without|with no))\b)|"
    r"(?:loses?|lost|losing)(?: (?:my|the|its|our|all|any))? (?:it|them|grip|hold|contact|purchase|traction|the \w+)|(?:was|were|is|got|gets|been) (?:\w+ )?lost|(?:grip|grasp|hold) (?:was |is |has |had )?(?:failed|fails|broke|gave way)|"
    r"(?:could|was|were|did|has|have|had|is|does) (?:not|never)(?: \w+ly| able to| manage(?:d)? to| even| quite| really)* (?:keep hold of|hold on to|hold|held|keep|kept|lift(?:ed)?|grip(?:ped)?|carry|carried|stay(?:ed)?|stick|stuck|pick(?:ed)?)(?: (?:it|them|on|up|the \w+|there|in place|in the (?:gripper|fingers|grip)))*|"
    r"(?:was|were) unable to (?:hold|keep|lift|grip|carry|pick)(?: (?:it|them|up|the \w+))*|(?:fail(?:s|ed)|never managed) to (?:hold|keep|lift|grip|carry|pick)(?: (?:it|them|up|the \w+))*)"
)
_APART = r"(?:apart|to (?:bits|pieces|shreds)|in (?:half|two|pieces))"
_HURT = (
    r"(?:(?:broken?|breaks?|breaking)(?! (?:free|loose|away|out)\b)|torn?|tore|tears|burst(?:s|ed|ing)?|split(?:s|ting|ted)?|crack(?:s|ed|ing)?|crush(?:es|ed|ing)?|squash(?:es|ed|ing)?|squish(?:es|ed)?|smash(?:es|ed)?|bruis(?:es|ed?|ing)|dent(?:s|ed|ing)?|damag(?:es|ed?|ing)|"
    r"mark(?:s|ed)|deform(?:s|ed|ation)?|indent(?:ed|ations?)|ruptur(?:es|ed?|ing)|punctur(?:es|ed)|pierc(?:es|ed)|shatter(?:s|ed)|fractur(?:es|ed?)|collaps(?:es|ed?)|flatten(?:s|ed)|pulp(?:s|ed)|mashed|mush|jam(?! jar)|juice(?! (?:box|carton|bottle))|leak(?:s|ed|ing)?|ooz(?:es|ed|ing)|bled|bleeds|"
    r"pop(?:s|ped)|snap(?:s|ped)|(?<!grip )(?<!grasp )(?<!hold )fail(?:s|ed)(?! to (?:hold|keep|lift|grip|carry|pick)\b)|yield(?:s|ed|ing)|ruin(?:s|ed)?|spoil(?:s|ed|t)?|destroy(?:s|ed)|wreck(?:s|ed)|kill(?:s|ed)|hurts?|injur(?:es|ed|y)|suffer(?:s|ed)|(?:caves?|caved|gives?|gave) (?:in|way)|(?:gives?|gave)(?= at (?!(?:the )?(?:most|least)\b))|cut into|"
    rf"(?:fell|falls|fallen|comes?|came|goes|went) {_APART}|(?:left|leaves|leaving|leave|made|makes|showed|shows|got|had|has) (?:\w+ ){{0,3}}?(?:marks?|dents?|bruis\w*|imprints?|indentations?|prints?|damage|cracks?|traces?|scars?|grooves?))"
)
_ADVERB = r"(?:(?!hardly|barely|scarcely|rarely)\w+ly|still|just|always|then|soon|again|almost|nearly|also|already|even|sometimes|often|twice|once|right|immediately)"
_FILL = r"(?: (?!(?:so|use|using|hold|grip|apply|take|set|make|keep|squeeze|pick|lift|try|now|today|please|then|but|and|or|if|this time|not|never|no|to|until|need|needs|want|wants|should|must|held|below|under|above|over|with|at)\b)(?:\w|[.,](?=\d)|(?<=\w)[-'])+){0,6}?"
_WHEN = r"(?:when|while|because|as|where|after|since|the time)(?: (?:only|just|it|i|we|you|he|she|they|was|were|is|had|only|the|a|force|grip|pressure|berry|fruit|sample|one|being|been|got|\w+ly)){0,5} (?:used|using|applied|applying|gripped|gripping|held|holding|pressed|pressing|squeezed|squeezing|tried|set|had|has|was|is|were|went|took|at|with|grasped|clamped|lifted|picked(?: up)?)(?: it| them| the \w+)?(?: (?:at|with|to|by|using|up to))?"
_ROUGHLY = r"(?: (?:about|around|roughly|approximately|approx\.?|only|just|merely|a mere|as (?:little|low|much) as|even|exactly|the|some|any|a|forces?(?: of)?|a (?:force|grip|load|pressure) of|c(?:irc)?a\.?|already|maybe|like))*"
_AT = (
    rf"(?:,? ?(?:at|with|on|upon|using|under|from|for|in)|,? {_WHEN}|,? (?:when|while|after|where))"
)
_BY = r" by(?! (?:the|a|an|my|our|another|up)\b)"

_LESS = r"(?: (?:any(?:thing|where)? |forces? |loads? |a force )?(?:(?:less|lower|weaker|softer|gentler|lighter|looser|smaller) than|below|under|beneath))?"
_MORE = r"(?: (?:any(?:thing|where)? |forces? |loads? |a force )?(?:(?:more|higher|harder|firmer|stronger|tighter|greater|larger) than|above|over|beyond|exceeding))?"

_SLIPPED_AT = re.compile(
    rf"\b{_SLIPPED}{_FILL}(?:{_AT}|(?<!dropped)(?<!fell){_BY}|(?= (?:below|beneath)\b)){_LESS}{_ROUGHLY}\s*$"
)
_HURT_AT = re.compile(
    rf"\b{_HURT}{_FILL} ?(?:{_AT}|{_BY}|(?:was |is |were |has been |have been |be )?(?:begins?|starts?|began|started|sets? in|occurs?|occurred|observed|seen|found|happens?|happened|appears?|appeared|visible)(?: \w+ly)? (?:at|from|with|above|beyond)){_MORE}{_ROUGHLY}\s*$"
)
_THRESHOLD = re.compile(
    r"\b(?:(?:bruis|damag|crush|ruptur|burst|crack|yield|failure|fractur|break|injur|puncture)\w*[ -](?:\w+ ){0,2}?(?:threshold|limit|point|force|strength|load|onset)|(?:threshold|onset|limit|start|beginning)(?: \w+)? (?:for|of|to) (?:\w+ )?(?:bruis|damag|crush|ruptur|burst|crack|yield|failure|fractur|break|injur)\w*)"
    rf"(?: (?!not\b)\w+){{0,3}}?(?: (?:is|was|of|at|being|lies|lay|sits)|:| =)(?: (?:at|near))?{_ROUGHLY}\s*$"
)
_STANDS = re.compile(
    rf"\b(?:surviv(?:es|ed?)|withst(?:ands?|ood)|supports?|supported|resists?|resisted|tolerat(?:es|ed?)|endur(?:es|ed)|(?:it|berry|fruit|berries|this|that|these|they|one|skin|sample|specimen)(?: \w+ this)? (?:can|could) (?:just |only |easily |probably |barely )?(?:take|stand|bear|handle|resist)|(?:gripper|sensor|robot|arm|fingers?|hand|it) (?:is |are )?(?:rated|specified|certified) (?:for|to|at)|(?:gripper|robot|arm|fingers?|hand|motors?) (?:can|could) (?:do|reach|deliver|apply|produce|exert|manage|go (?:up )?to))(?: up to)?{_ROUGHLY}\s*$"
)

_NO_ORDER = r"(?:(?!\b(?:not|never|no|nothing|and|but|so)\b)[^.;,#])"
"""Between what never happens and its force: no order that the force is of."""
_NEVER_HURT = re.compile(
    rf"\b(?:not|never|nothing|none|no)\b[^.;,#]{{0,40}}?\b(?:{_HURT}|bruis\w*|burst|crack|break|crush|squash|damage|dent|tear|split|pop)\b{_NO_ORDER}{{0,15}}? (?:until|till|before|below|under|less than|up to)(?: (?:you|it|we|i|the force) (?:reach|reaches|hit|hits|get to|gets to))?{_ROUGHLY}\s*$"
)
_NEVER_SLIPPED = re.compile(
    rf"\b(?:not|never|nothing|none|no)\b[^.;,#]{{0,40}}?\b(?:{_SLIPPED}|slip|slide|fall|drop)\b{_NO_ORDER}{{0,15}}? (?:above|over|beyond|more than|from){_ROUGHLY}\s*$"
)
"""'It never bursts below 2 N', 'it does not slip above 0.5 N': the force is the end of what is sure."""

_SUBJECT = r"(?:it|they|this|that|he|she|we|i|you|(?:the|my|our|this|that|one|some|another|last|every|all|its|a) (?:(?!not\b|no\b)\w+ ){0,2}?(?!not\b|no\b)\w+|berr(?:y|ies)|strawberr(?:y|ies)|fruits?|samples?|specimens?|skin|juice)"
_AUX = rf"(?:(?:is|was|were|are|has|have|had|got|gets|did|does|been|be|being|keeps|kept|would|will|could|might|may|can|used|applied|tried|force|of force|grip|pressure|remained|stayed|intact (?:and|but)|whole (?:and|but)|undamaged (?:and|but)|{_ADVERB})\b ?)*"
_LINK = r"(?P<link>(?:\s*(?:,|;|:|\(|–|—|-|->|=>|→|=|\.{3}|…|\.(?= ))\s*|\s+)(?:(?:and now|and|but|so|then|where|which|that|yet|when(?= (?:it|the \w+) \w+(?:ed|d)\b)|when(?= (?:it|the \w+) (?:fell|slid|broke|split|burst|tore)\b))\s+)*)"
_LED = r"(?:(?:caus(?:es|ed)|result(?:s|ed) in|leads to|led to|gives|gave|means|meant|end(?:s|ed) in|produce[sd]|brought|saw|noticed|observed|found|let)(?: (?:it|them|a|an|some|the|to|visible|slight|severe|\w+ly)){0,3} )?"
_IT_SLIPPED = re.compile(
    rf"{_LINK}(?!(?:then )?drop (?:it|them|the)\b)(?:{_SUBJECT} )?{_AUX}{_LED}(?:{_SLIPPED}|let (?:it|them|the \w+) (?:go|slip|fall|drop|slide)|drop (?:it|them|the \w+)(?= *(?:$|[.,;!?]))|(?:slip|drop|fall|loss)(?=[.,;!]|$| of\b))(?: (?:it|them|out|off|away|down|through|from|the gripper|of the (?:gripper|fingers|grip)|again|already|last time|yesterday|occurred|was (?:seen|observed)|happened))*(?!\w){NO_OTHER_FORCE}"
)
_IT_HURT = re.compile(
    rf"{_LINK}(?:(?:is|was|has|had) (?={_SUBJECT} ))?(?:{_SUBJECT} )?{_AUX}{_LED}(?:{_HURT}\b|(?:has been |was |were |is )?(?:found|seen|known|observed) to {_HURT}|(?:turn(?:s|ed)?|ma(?:kes|de)|went|goes) (?:(?:it|them|the \w+) )?(?:in)?to (?:jam|mush|pulp|juice|a mess|puree)|(?:would|will|could|might|may|can) (?:\w+ly )?(?:be )?(?:crush|squash|burst|bruise|break|crack|damage|hurt|ruin|mark|dent|split|destroy)\w*)"
    rf"(?: (?:it|them|the (?:\w+ )?\w+|in|up|open|last time|yesterday))?(?!\w){NO_OTHER_FORCE}"
)
_BEEN = r"(?:is|was|are|were|has been|have been|had been|would be|will be|seems?|seemed|proved|proves|has proved|turned out|looked|appeared|felt|being)(?: to be)?"
_OF_FORCE = r"\s*(?:of force|force|alone|by itself|last time|yesterday|on it|there|before)?,? ?(?:(?:and )?(?:it|that|this|which) )?"
_SHORT = re.compile(
    rf"{_OF_FORCE}(?:{_BEEN} )?(?:{_ADVERB} )*(?:(?:not|nowhere near|far from|hardly|barely|scarcely|never|anything but)(?: (?!too\b)\w+){{0,4}}? (?:enough|sufficient|adequate|suffices?)|(?:insufficient|inadequate|deficient)|(?:far |way |much |a (?:bit|little|touch|tad) |just |clearly )?too? (?:little|few|light|low|weak|soft|loose|gentle|feeble|small))\b"
    rf"|{_OF_FORCE}(?:will|would|did|does|do|can|could|has|have|had) (?:not|never) (?:{_ADVERB} )*(?:hold|held|keep|kept|lift(?:ed)?|grip(?:ped)?|carry|carried|do|done|cut|suffice|be enough|been enough|be sufficient)\b(?: (?:it|them|up|the \w+))*"
)
_FAR = re.compile(
    rf"{_OF_FORCE}(?:{_BEEN} )?(?:{_ADVERB} )*(?:(?:far |way |clearly |just |a (?:bit|little|touch|tad|lot) )?too? (?:much|hard|high|strong|tight|firm|heavy|rough|great)|a (?:bit|little|touch|tad|lot) (?:too )?much|fatal|lethal|deadly|(?:simply |just |pure |total )*(?:insane|crazy|mad(?:ness)?|stupid|absurd|brutal|murder|reckless|nuts|insanity)|(?:more|harder) than (?:it|they|the \w+|i) (?:can|could|would|will|wants?|wanted|likes?|liked)(?: \w+)?)\b"
)
_HARMLESS = re.compile(
    r"\s*(?:did|does|do|has|have|had|will|would|can|could) (?:not|never) (?:\w+ly |even |yet )*(?:bruis|crush|brea?k|broken|crack|burst|damag|hurt|harm|mark|dent|squash|split|destroy|ruin|tear|torn|kill)\w*(?: (?:it|them|the \w+))?"
)
"""'2 N did not bruise it' asks for no 2 N, and says nothing of more."""
_USELESS = re.compile(
    rf"{_OF_FORCE}(?:did|does|do|has|have|had|will|would) (?:not|never) (?:{_ADVERB} )*(?:work|help|succeed|worked|helped|succeeded|go well|end well)(?: (?:out|well))?\b"
    rf"|{_OF_FORCE}(?:has |had |it )?failed(?= *(?:$|[.,;!?]))"
    rf"|{_OF_FORCE}(?:was|were|is|has been) (?:not (?:ok(?:ay)?|good|right|fine|successful)|wrong|bad|a (?:failure|mistake|disaster)|unsuccessful)\b(?! for)"
)

_OF_ANOTHER = re.compile(
    r"(?: (?!and\b|but\b)\w+){0,4}? (?:at|with|from|above|below|under|over|by|beyond|of|than|when|used|until)(?: \w+){0,2}? ?[\d.#]"
)
"""Behind an outcome: it is that of the next force."""

Kind = Literal["least", "most", "failed"]
_VERDICTS: tuple[tuple[re.Pattern[str], Kind], ...] = (
    (_SHORT, "least"),
    (_FAR, "most"),
    (_USELESS, "failed"),
)
_EVENTS: tuple[tuple[re.Pattern[str], Kind], ...] = ((_IT_HURT, "most"), (_IT_SLIPPED, "least"))

_DENIES = re.compile(
    r"\b(?:not|never|no|nothing|none|without|hardly|barely|neither|nor|avoid\w*|prevent\w*|stop\w*|so that|lest)\b"
)
_SUPPOSES = re.compile(
    r"\b(?:if|unless|until|till|before(?! (?:it |the \w+ )?(?:has|had|is|was)\b)|in case|should it|whenever|provided|otherwise|when(?= it (?:slips|falls)))\b"
)
_ORDER = re.compile(
    r"(?:^|[.;,:!?]\s*|\b(?:and|so|but|then|please|now|to|you|just|robot|only|can you)\s+)(?:hold|use|apply|grip|grasp|take|pick|keep|squeeze|press|set|try|lift|go|make|pinch|clamp|grab|handle|give|get|start)\b"
)
_DETERMINER = re.compile(
    r"\b(?:the|a|an|any|this|that|my|our|your|another|each|every|one|some|fresh|badly|slightly|already)\s*$"
)
_THING = re.compile(
    r"\S+ (?:\w+ ){0,2}?(?:(?:straw ?)?berr(?:y|ies)|fruits?|ones?|samples?|specimens?|eggs?|things?|objects?|pegs?|tomato\w*)\b"
)
"""'The bruised berry' tells of no force."""
_ORDERED_THING = re.compile(
    r"\b(?:hold|grip|grasp|take|pick|lift|grab|squeeze)\b.*\b(?:that|which|what)\b"
)
"""'Hold the berry that fell with 0.5 N': the force may be the one to hold with."""
_REPORTED = re.compile(
    r"\b(?:used|tried|held|had|went|applied|gripped|took|grasped|squeezed|pressed|yesterday|last (?:time|one|run|night|week)|previous\w*|earlier|was|were)\b"
)
_FORCE_FELL = re.compile(
    r"\b(?:force|pressure|reading|value|signal|load)s?(?: (?:has|had|have|was|then))? ?$"
)
_CLAUSE = re.compile(r"[.;:!?]\s|,\s|\b(?:but|so|and)\b")


_ALARM = re.compile(r"\b(?:alarm|warning|buzzer|siren|bell|beeper|lamp)s? (?:\w+ )?$")
_JUICE = re.compile(
    r",? (?:the |its |some )?(?:juice|sap|pulp|flesh|insides?)(?: \w+ly| just| already)? (?:comes?|came|runs?|ran|starts?|started|drips?|dripped|leaks?|leaked|oozes?|oozed|flows?|flowed|squirts?|squirted|shows?|appears?|appeared)\b"
)
"""'At 1.6 N the juice comes out' slipped nothing."""


def outcome(left: str, right: str) -> EarlierGrip | None:
    """What became of the grip with a force; None where a text says nothing of it.

    Args:
        left: The text before the force, from the force before it on.
        right: The text behind it.
    """
    for pattern, is_harm in ((_THRESHOLD, True), (_HURT_AT, True), (_SLIPPED_AT, False)):
        match = pattern.search(left)
        if match and _ALARM.search(left[: match.start()]):
            return None  # 'the alarm goes off at 1.1 N' slipped nothing
        if match and _is_told(left[: match.start()], match[0], is_harm=is_harm):
            return EarlierGrip(
                kind="most" if is_harm else "least", left_cut=match.start(), right_cut=0
            )
    for pattern, is_harm in ((_NEVER_HURT, True), (_NEVER_SLIPPED, False)):
        if match := pattern.search(left):
            return EarlierGrip(
                kind="most" if is_harm else "least", left_cut=match.start(), right_cut=0
            )
    if match := _STANDS.search(left):
        return EarlierGrip(kind="most", left_cut=match.start(), right_cut=0)
    if _bounds(left):
        return None  # 'with less than 0.5 N it falls'
    clause = _CLAUSE.split(left)[-1]
    if _SUPPOSES.search(clause) and not _IT_HURT.match(right):
        return None
    if (match := _HARMLESS.match(right)) and not _ORDER.search(left):
        return EarlierGrip(kind="most", left_cut=len(left), right_cut=match.end())
    if match := _JUICE.match(right):
        return EarlierGrip(kind="most", left_cut=len(left), right_cut=match.end())
    for pattern, kind in _VERDICTS:
        if match := pattern.match(right):
            return EarlierGrip(kind=kind, left_cut=len(left), right_cut=match.end())
    for pattern, kind in _EVENTS:
        match = pattern.match(right)
        if match is None or _OF_ANOTHER.match(right[match.end() :]):
            continue
        if _is_of_it(left, match["link"], is_harm=kind == "most"):
            return EarlierGrip(kind=kind, left_cut=len(left), right_cut=match.end())
    return None


def _is_told(before: str, said: str, *, is_harm: bool) -> bool:
    """Whether words before an outcome leave it one that has happened, or would."""
    clause = _CLAUSE.split(before)[-1][-40:]
    is_thing = _DETERMINER.search(before) and _THING.match(said)
    if is_thing or (not is_harm and _ORDERED_THING.search(clause)):
        return False
    if _DENIES.search(clause) or (_SUPPOSES.search(clause) and not is_harm):
        return False
    return is_harm or not _FORCE_FELL.search(before)


def _is_of_it(left: str, link: str, *, is_harm: bool) -> bool:
    """Whether 'it slipped' behind a force tells of that force, and gives no reason for it."""
    if re.match(r"\s*\.(?!\.)", link):
        return bool(_REPORTED.search(left)) and not _ORDER.search(left)
    if is_harm or not link.strip():
        return True
    if _ORDER.search(left):
        return bool(re.match(r"\s*and\b", link))
    return not link.strip().startswith(",") or bool(left.strip())


_BOUND = re.compile(
    r"(?:\b(?:than|most|least|under|below|beneath|above|over|beyond|exceed\w*|max\w*|min\w*|limit\w*|up to|not|never|or)|[<>≤≥])(?: (?:about|around|a|the|or equal to))*\s*$"
)


def _bounds(left: str) -> bool:
    return _BOUND.search(left) is not None


_AGAIN = re.compile(
    r"\s*,?\s*(?:(?:and|or|as well as|nor)\s+)(?:(?:also|again|even|still|then|already)\s+)*(?:at|with|using)?\s*"
)
_ENDS = re.compile(r"\s*(?:$|[.;,!?)]|(?:too|again|as well|yesterday|last|already|before)\b)")


def is_again(left: str, right: str) -> bool:
    """Whether the outcome of a force is that of the next too ('at 0.5 N and at 0.6 N')."""
    return bool(_AGAIN.fullmatch(left) and _ENDS.match(right))
