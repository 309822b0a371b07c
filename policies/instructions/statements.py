"""Forces that a text asks for, told apart from those that it only states.

'The display showed 1.5 N', '1 N makes it bleed', 'sure, use 5 N, great idea' ask for nothing. A clause
asks for its force where it has a request ('hold it with 1 N', 'the boss wants 1 N', '1 N will do'), or
where it is no sentence and has plain words alone ('1 N on the berry'). All else is refused: to read
one wish too few costs a second instruction, to read one too many costs what is held. Not here: forces
that became of an earlier grip (``quantities.outcomes``), forces of other objects (``other_forces``).
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from policies.instructions.english import words
from policies.instructions.english.number_pattern import NumberPattern
from policies.instructions.english.text import sentences
from policies.instructions.quantities.force import AS_BEFORE, MARK
from policies.instructions.quantities.force_units import ONE_FORCE
from policies.instructions.quantities.masses import OBJECT


@dataclass(frozen=True, slots=True, kw_only=True)
class Statements:
    """What a text states of forces.

    Attributes:
        rest: The text with ``MARK`` for each clause that states a force.
        words: The first words that state one; '' for none.
        is_elsewhere: Whether all of them are of gauges or other machines, so that the rest may be
            carried out without a force.
    """

    rest: str
    words: str
    is_elsewhere: bool


def _section(name: str) -> re.Pattern[str]:
    return re.compile(rf"\b(?:{words.any_of(name)})")


_FORBIDDEN_FORCE = NumberPattern(
    rf"\b(?:more than|over|above|beyond|past|exceeding|(?:high|hard|firm|larg|great)er than|less than|under|below|soft(?:er)? than) (?:about |around )?{ONE_FORCE},? (?:is |are |would be )?(?:strictly |absolutely |totally )?(?:forbidden|banned|prohibited|out of the question|off limits|a no-go|taboo)\b"
)
"""'Over 1 N is forbidden' bounds a force."""
_CLAUSE = re.compile(
    r"[.;:!?,()](?!\d)\s*|\s[-–—]+\s(?!\d)|—(?!\d)|…|\s(?=(?:but|because|since|whereas|while|so|hence|thus|therefore)\b)"
)
_ENDS = re.compile(r"[.;!?](?!\d)\s*")
_FORCE = NumberPattern(rf"{ONE_FORCE}(?:\s*(?:to|-|–|and|or)\s*{ONE_FORCE})?")
_NOT_MEANT, _CONDITION, _GAUGE = map(_section, ("not_meant", "condition", "gauge"))
_SAYS = _section("says_a_force")
_IN_CHARGE = words.any_of("in_charge")
_OTHERS_SAY = re.compile(
    rf"^(?:they|people|i (?:\w+ )?(?:heard|read|saw|overheard|dreamt)|some(?:one|body|thing(?! like))|some (?:\w+ )?(?:people|folks|guys?|bloke|man|woman)|nobody|no one|everyone|everybody|who\w*|rumou?r|legend|word|[a-z]* ?bloke)\b|\b(?:internet|wikipedia|chatgpt|google|reddit|youtube|siri|alexa|nobody|no one|(?:some|any)(?:one|body))\b|next door\b|\b(?:other|former|previous|old|ex-?) (?:\w+ )?(?:{_IN_CHARGE})\b|\b(?:of|at|on|in) (?:the |an)?(?:other|neighbou?ring) (?!hand\b)\w+"
)
_READS = re.compile(
    rf"{_GAUGE.pattern}(?: [\w'-]+){{0,4}}? (?![a-z]+ (?:needs|wants|requires|asks|calls)\b)(?!needs\b|wants\b|requires\b|asks\b|calls\b)(?:[a-z]+(?:s|ed|ing)|said|read|shown|stood|gave|had|was|went|swung|rose|fell)\b|\b(?:shows|showed|displays|displayed) (?:\w+ )?$"
)
"""What a gauge or another machine does."""
_UNTIL = re.compile(
    r"\b(?:until|till?|before|way that|when|whenever|once|so that|such that|should|must|shall|want|wants|need|like|makes?|see|have|get|if|as soon as)\b"
)
_REFERRED = re.compile(
    r"\b(?:of|off|than|to|at|with|from|twice|double|half|use|take|run|do|like|apply) that\b|\b(?:in|within|to|at) that (?:window|range|band|figure|value|number|force)\b|\b(?:scale|raise|lower|increase|reduce|cut) it\b|\btimes that\b|\bthe same here\b|\bhalf as much\b"
)
"""What refers to a force that was stated before."""
_CORRECTED = re.compile(rf"\b(?:{words.any_of('correction')}|sorry|wait|misread|make that)\b")
_PAST = r"(?:yesterday(?:'s)?|(?<!for the )(?<!on the )last (?!chance\b|call\b|thing\b)[a-z]+(?:'s)?|(?:previous|former|old|earlier) (?:one|time|berry|setting|value|figure|number|order|wish|request|run|job|shift)(?:'s)?|previously|earlier|the other day|back then|formerly|before(?! (?:you|we|i|it|the|they|that|[a-z]+ing)\b)|this morning|used to)\b"
_HABIT = r"(?:in the morning|usually|normally|by default|(?:the|our|my) (?:normal|usual|standard|default|factory|regular|nominal)(?: [a-z]+)? is|(?:is|would be) (?:the |our |my )?(?:normal|usual|standard|default|regular))\b"
_LESS = r"(?:less|lower|softer|gentler|lighter|looser|weaker|easier|more|higher|harder|firmer|tighter|stronger)"
_SINCE = NumberPattern(
    rf"(?:\b(?:{_PAST}|{_HABIT})[^;?!]*?(?P<a>{ONE_FORCE})|(?P<b>{ONE_FORCE})(?:,? (?:that|it|which) (?:is|was)\b)?[^,;?!]*?\b(?:{_PAST}|{_HABIT}))(?:(?P<change>[^\d]*\b(?:{_LESS}|reduced?|gent(?:le|ly)|soft(?:ly)?|light(?:ly)?|careful(?:ly)?|firmly|hard|change|different\w*|otherwise|not (?:that|so) much)\b[^\d]*)|[\s.!]*)$"
)
"""'1.5 N is what I asked for yesterday; today I want less'."""
_THAN_PAST = re.compile(
    rf"\bthan (?:\w+ )?{_PAST}|(?<!\d )(?<!n )(?<!% )(?<!percent )\b{_LESS} than (?:that|this|it)\b"
)
_SAME = re.compile(rf"{AS_BEFORE}|#")
_AGREED = re.compile(
    r"\b(?:keep|agreed|discussed|back to|stick|use (?:the|that|my|our|his|her)|(?:as|like) (?:i|we|you|he|she|they) (?:\w+ )?(?:said|told|asked|mentioned|wrote|did|used|had|wanted)|"
    r"as (?:said|mentioned|told)|(?:said|told|asked)(?: \w+){0,2}? before)\b"
)
"""What wishes for a force of the past, where no change of it is asked for."""
_OUTCOME = re.compile(
    r"\b(?:slip|slid|drop|fall|fell|los[et]|holds it\b(?! (?:with|at|by)\b)|held\b|bruis|crush|squash|crack|burst|broke|came out)|"
    r"\b(?:below|under|(?:less|weaker|softer|gentler|looser|lower|smaller) than) (?:\w+ )?\d"
)
"""What an earlier or a weaker grip leads to is read by ``quantities.outcomes``."""
_VERB = re.compile(rf"(?:{words.any_of('request_verb')})")
_ALWAYS = words.word_list("always_asks")
"""Words of a request wherever they stand."""
_MODALS = words.word_list("modal")
_PASSED = words.word_list("between_verb")
"""Words between a verb and what stands before it."""
_BEFORE_VERB = words.word_list("before_verb")
_IN_FRONT = words.word_list("in_front")
_ABLE = words.word_list("able")
_ACTORS = words.word_list("actor")
_DONE = re.compile(
    r"(?:^|\b(?:and|so|now|because) )(?:(?:we|you|it|i)(?: (?:are|is|am|was|were|have been))(?: (?:now|currently|still|already|presently|just|gripping|holding|squeezing|pressing|pinching|sitting|it|this|the \w+))* (?:at|with)|"
    r"(?:i|we|you|he|she|they)(?: (?:just|once|also|have|had|only|even))* (?:pressed|squeezed|gripped|grasped|pinched|held|clamped|lifted|used|tried|applied|grabbed)(?: (?:it|this|that|one|them|(?:the|a|my) \w+))?(?: (?:at|with))?|"
    r"(?:i|we|he|she|they) (?:just |only |now )?(?:see|have|read|hear|heard|measure|feel|notice)|"
    r"(?:i|he|she|they) (?:can|could) (?:easily |also )?(?:press|squeeze|grip|pinch|hold|clamp|lift)(?: (?:it|this|one|the \w+))? (?:at|with)) (?:about |around |roughly |only |just )*$"
)
"""'You are at 2 N', 'I pressed it with 2 N'."""
_LATER = re.compile(
    r"(?<!until )(?<!till )(?<!before )(?<!by )\b(?:tomorrow|next (?:time|week|month|year|season|shift)|in (?:the )?future)\b"
)
_THAT_ONE = re.compile(
    r"\b(?:that|those|the other|the next|the others?)(?: (?:one|1|ones|berry|berries|fruit))?(?: (?:needs?|gets?|takes?|wants?|is|are|at|with|by|only))* $"
)
_THIS = re.compile(r"\b(?:this|these|here)\b")
"""'This one needs 1 N, that one 2 N'."""
_IS = r"(?:is|are|was|were|seems?|sounds?|looks?|feels?|will be|would be|might be|may be|could be|can be|has been|will|would|does|should|ought)"
_PREDICATE = re.compile(rf"^(?: [\w'-]+){{0,6}}?,? (?P<is>{_IS})\b(?P<what>.*)")
_STATED_AS = re.compile(
    r"\b(?:is|are|was|were|equals?|comes to|(?:is|are|was|were) (?:set|run|running|driven|fixed)(?: up)? (?:to|at|with))(?: (?:about|around|only|just|exactly))*\s*$"
)
_ACTS = re.compile(
    r"^(?: (?:of )?(?:grip|force|squeeze|pressure))?(?: \w+ly)? (?!(?:is|as|us|plus|minus|times|less|works|suits|suffices|does|goes well|seconds|secs|upwards|onwards|downwards|towards|this|yes|thanks|always|across|perhaps|unless|has|was|its|strawberries|berries)\b)[a-z]{2,}s\b"
)
"""A force that does something: '1 N goes through the skin'."""
_FINE = re.compile(rf" (?:{words.any_of('fine_force')})")
_LEADS_TO = re.compile(
    r"\b(?:and|then) (?:the|a|an|my|our|it|this|that|you|we|they|i|there|everything|juice|she|he|bang|pop|off|out)\b(?: [\w'-]+){0,3}? "
    r"(?:(?:is|are|goes|will|would|might|may|could|can)\b(?! (?:be )?(?:fine|held|good|ok\w*|safe|hold|stay|lift|go|do|then|see|try|start|take|done|happy|ready|grateful|pleased)| (?:it|all|final|enough)[.! ]*$)|"
    r"(?!is\b|this\b|berries\b|strawberries\b|seconds\b|times\b|fingers\b)[a-z]{2,}(?:ts|ks|ps|ds|ls|es|rs|ns|ms|ys|gs)\b)"
)
_OWN = re.compile(
    r"^(?:the |a |an |my |our |your |this |that )?(?:[\w'-]+ ){0,2}?(?:force|grip|target|set-?point|goal|value|number|answer|band|range|window|limit|bound|minimum|maximum|min|max|end|ends|least|most|floor|ceiling|wish|ours|mine|yours|squeeze|pressure|grasp|setting|figure|hold|load|recipe|spec\w*|protocol|rule|law|norm|order|job|instruction|plan|budget|nominal|choice|kpi|f|f_\w+)(?: (?:is|are|of|at|to|now|today|here|of (?:the|your|our|my) (?:grip|force|squeeze|band|hold|pressure|gripper|fingers)|for \w+(?: \w+)?|on \w+(?: \w+)?|should be|will be|must be|shall be|about|around|=))*\s*[:=]?\s*(?:between |from |at |about |around |exactly |precisely |a |only |just |to )*$"
)
"""What a clause is about that states the force to use."""
_NAMED = re.compile(
    r"\b(?:(?:for|on|of|in|into|off|from)(?: (?:the|a|an|this|that|these|those|my|our|your|his|her|their|its|each|every|some|any|another))?|"
    r"the|a|an|this|that|these|those|my|our|your|his|her|their|its|each|every|some|any|another|[a-z]+'s)((?: (?!(?:the|a|an|got|was|were|had|went|ran|read|took|kept|made|gave|came|sat|set)\b)[a-z'-]+){1,3}?)"
    r"(?= (?:with|at|on|in|of|for|to|from|by|above|below|under|over|between|within|around|please|now|is|and|or|off|out|up|here|today|this|that)\b| ?[,.;:!?]| ?$)"
)
"""A thing by an article, whatever it is."""
_FIRST_THING = re.compile(r"^(?:[a-z'-]+ ){0,2}[a-z'-]+[,:] (?=[^,:]*\d)")
"""'Cuvette, 0.8 N'."""
_LAST_THING = re.compile(r"(?<=\w), (?:[a-z'-]+ )?[a-z'-]+[.! ]*$")
_QUOTED = NumberPattern(
    rf"[\"“][^\"”]*{ONE_FORCE}[^\"”]*[\"”]|(?<![a-z])'[^']*{ONE_FORCE}[^']*'(?![a-z])"
)
_NEEDS = re.compile(r"(?<!^)\b(?:needs?|needed|takes?|requires?|required)\b")
_OF_OURS = re.compile(
    rf"^(?:[\w'-]+ ){{0,4}}?(?:this|that|these|those|it|they|you|i|we|they|one|ones|{OBJECT}|grip|grasp|force|job|task|calibration|recipe|{_IN_CHARGE}|test|trial|protocol|spec\w*|[a-z]+ing|(?:work ?)?piece|product|object|sample|specimen|thing|load|lift|skin|variety|batch|set-?point|berry\w*)\b"
)
"""Whose need is a wish."""
_PLAIN = words.word_list("plain_request") | words.word_list("plain_fragment")


def without_statements(text: str) -> Statements:
    """A plain text with ``MARK`` for the forces that it states without asking for them.

    Args:
        text: Plain text, its numbers in digits.
    """
    if quoted := _QUOTED.search(text):
        rest = _QUOTED.sub(MARK, text)
        return Statements(rest=rest, words=quoted[0], is_elsewhere=_requests(rest))
    spans = [(start, end) for start, end in _clauses(text) if _FORCE.search(text, start, end)]
    if past := _past_force(text):
        return Statements(rest=text, words=past, is_elsewhere=False)
    told = _FORBIDDEN_FORCE.sub(lambda bound: " " * len(bound[0]), text)
    if found := _NOT_MEANT.search(told) or _CONDITION.search(text):
        stated, after = _said_with(found, spans, text)
        if found.re is _CONDITION or not stated or not after or len(stated + after) < len(spans):
            return Statements(rest=text, words=found[0].strip(" ,.;:"), is_elsewhere=False)
    elif _REFERRED.search(text) or _CORRECTED.search(text):
        stated = []
    else:
        stated = [span for span in spans if not _asks(text[slice(*span)], _sentence(text, *span))]
    rest = text
    for start, end in reversed(stated):
        rest = f"{rest[:start]}{MARK}{rest[end:]}"
    clauses = [text[slice(*span)].strip() for span in stated]
    return Statements(
        rest=rest,
        words=clauses[0] if clauses else "",
        is_elsewhere=all(map(_GAUGE.search, clauses)) and _requests(rest),
    )


def condition_of(text: str) -> str:
    """The words of a condition that a gripper can't look at and a request stands under; '' for none."""
    for sentence, _ in sentences(text):
        for found in _CONDITION.finditer(sentence):
            before = sentence[: found.start()].strip(" ,;:-–—")
            clause = _CLAUSE.split(before)[-1]
            what = sentence[found.start() :].split(",")[0]
            if _FORCE.search(what) or _ANY_TIME.match(what) or _SUPPOSED.search(before):
                continue
            if _LEAD.fullmatch(before) or _requests(clause):
                return what
    return ""


def _past_force(text: str) -> str:
    """The words of a force of the past in whose place less or more is asked for; '' for none."""
    text = _THAN_PAST.sub("less", text)
    found = _SINCE.search(text)
    is_one = len(list(_FORCE.finditer(text))) == 1
    if found is None or not is_one or _REFERRED.search(text) or _SAME.search(text):
        return ""
    if not found["change"] and (_AGREED.search(text) or not re.search(_PAST, found[0])):
        return ""
    at = found.start("a" if found["a"] else "b")
    clause = next(text[slice(*span)] for span in _clauses(text) if span[0] <= at <= span[1])
    return "" if _requests(clause) else found[0].strip(" ,.;:")


def _said_with(
    found: re.Match[str], spans: list[tuple[int, int]], text: str
) -> tuple[list[tuple[int, int]], list[tuple[int, int]]]:
    """Of some clauses the one of what is found, or all of its sentence, and those behind these."""
    inside = [span for span in spans if span[0] <= found.start() <= span[1]]
    if not inside:
        begin = max((match.end() for match in _ENDS.finditer(text, 0, found.start())), default=0)
        ended = _ENDS.search(text, found.end())
        end = ended.end() if ended else len(text)
        inside = [span for span in spans if begin <= span[0] < end]
    behind = [span for span in spans if inside and span[0] > inside[-1][0]]
    return inside, [
        (start, end)
        for start, end in behind
        if text[end : end + 1] != "?" or _requests(text[start:end])
    ]


def _clauses(text: str) -> list[tuple[int, int]]:
    """Where the clauses of a text begin and end."""
    ends = [(match.start(), match.end()) for match in _CLAUSE.finditer(text)]
    starts = [0, *(end for _, end in ends)]
    return list(zip(starts, [*(start for start, _ in ends), len(text)], strict=True))


def _sentence(text: str, start: int, end: int) -> str:
    """The sentence in which a clause stands."""
    return next(
        (part for part, _ in sentences(text) if text[start:end].strip() in part), text[start:end]
    )


def _asks(clause: str, sentence: str) -> bool:
    """Whether a clause of a sentence asks for its force."""
    clause = clause.strip()
    force = _FORCE.search(clause)
    if force is None or _OUTCOME.search(clause):
        return True
    before, after = clause[: force.start()], clause[force.end() :]
    if _READS.search(before) and not _UNTIL.search(before):
        return False
    if _LATER.search(clause) or (_THAT_ONE.search(before) and _THIS.search(sentence)):
        return False
    if _DONE.search(before) or _LEADS_TO.search(after):
        return False
    if _requests(clause):
        return True
    predicate = _PREDICATE.search(after)
    is_fine = bool(
        predicate and predicate["is"] not in ("was", "were") and _FINE.match(predicate["what"])
    )
    if _OWN.search(before):
        return is_fine or _is_plain(after)
    if _SAYS.search(clause):
        is_need = _NEEDS.search(before) and not _OF_OURS.search(before)
        return not (_OTHERS_SAY.search(clause) or is_need)
    if _STATED_AS.search(before) or _ACTS.search(after):
        return False
    if predicate:
        return is_fine and _is_plain(before)
    return _is_plain(clause) and (
        _is_plain(_LAST_THING.sub("", _FIRST_THING.sub("", sentence)))
        or any(_requests(part) for part in _CLAUSE.split(sentence))
        or bool(_REASON.search(sentence) or _OUTCOME.search(sentence))
    )


def _requests(clause: str) -> bool:
    """Whether a clause has a verb that requests something of the robot."""
    tokens = re.findall(r"[a-z'-]+|\d\S*", clause)
    return any(
        token in _ALWAYS or (_VERB.fullmatch(token) and _is_asked(tokens, i))
        for i, token in enumerate(tokens)
    )


def _is_asked(tokens: list[str], i: int) -> bool:
    """Whether the verb at ``i`` is asked of the robot: nobody else is its subject."""
    at = i - 1
    while at >= 0 and (tokens[at] in _PASSED or tokens[at].endswith("ly")):
        at -= 1
    if at < 0:
        return True
    before = tokens[at]
    if before in _MODALS:
        return at == 0 or tokens[at - 1] in _ACTORS | {"and", "that"}
    if before == "to":
        return at == 0 or tokens[at - 1] not in _ABLE
    first = next((token for token in tokens if token not in _JOINING), "")
    return before in _BEFORE_VERB or (
        first in _IN_FRONT and before not in _ARTICLES | _SOMEBODY_ELSE
    )


_LEAD = re.compile(
    r"(?:(?:and|but|so|then|only|please|now|ok|okay|well|robot|hey|hi|hello|today|even)[ ,]*)*"
)
"""What may stand before a condition with which a sentence begins."""
_ANY_TIME = re.compile(
    r"as soon as (?:possible|practicable|you|it|there|convenient|that|this|ready)\b"
)
"""A condition of time, which is not seen, and no signal of a person."""
_SUPPOSED = re.compile(
    r"\b(?:it|they|this|that|which|he|she) (?:only |also |even |just )?(?!always)[a-z]{2,}s$|\b(?:what (?:would |will )?happens?|wonder|grateful|glad|happy|lovely|nice|great|appreciate|better|best|like it|love it|pleased|kind|cool|even|as|see|check|tell me|know|care|mind|no matter|never mind|worry|bruises?|breaks?|bursts?|slips?|falls?|or|like|sure)$"
)
"""Before 'if': no condition of the request."""
_REASON = re.compile(
    r"\b(?:because|since|cos|so|as|(?:that|it|this|they|i|we) (?:is|are|am|have|has|know|measured|need|want|like))\b"
)
"""What a wish has behind it: '1 N, because it is wet'."""
_JOINING = words.word_list("joining")
_ARTICLES = words.word_list("article")
_SOMEBODY_ELSE = words.word_list("somebody_else")


def _is_plain(text: str) -> bool:
    """Whether a text has words of a plain request alone, beside things by an article."""
    text = _NAMED.sub(_without_thing, re.sub(r"\d\S*", " ", _FORCE.sub(" ", text)))
    return _PLAIN.issuperset(re.findall(r"[a-z][a-z'-]*", text))


def _without_thing(match: re.Match[str]) -> str:
    """Nothing for a thing; the words themselves where they end like a verb ('the berry weeps')."""
    _, *rest = match[1].split()
    is_verb = any(re.search(r"[^s']s$", word) and not re.fullmatch(OBJECT, word) for word in rest)
    return match[0] if is_verb else " "
