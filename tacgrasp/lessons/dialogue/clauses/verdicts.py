"""Statements to be judged, rules with a threshold, and several conditions under one verdict.

    True or false: we're under a newton.
    A cone pressed in by over 0.4 mm: is that what we have here?
    My rule for hoisting is that something is touching ...: does this touch pass?
    I want no more than 800 mN on this tissue. Have we exceeded that?

Not here: the conditions themselves (``tacgrasp.lessons.dialogue.clauses.conditions``).
"""

from __future__ import annotations

import re

from tacgrasp.lessons.dialogue.clauses.conditions import condition_of_statement
from tacgrasp.lessons.dialogue.meaning import Calculated
from tacgrasp.lessons.dialogue.plainer import is_denied_first

_TRUE = (
    r"(?:true|correct|right|so|accurate|valid|fair|the case|what (?:we|you|i) (?:have|feel|see|"
    r"got)(?: (?:here|there))?|what (?:it|this|that) is|what is (?:here|there)|ok(?:ay)?|"
    r"your (?:reading|view|finding))"
)
_FALSE = r"(?:false|wrong|incorrect|untrue|mistaken|a lie)"
_PASS = (
    r"(?:pass(?:es|ed)?|counts?|(?:be )?met|satisfied|fulfilled|hold(?:s)?(?: (?:true|up|water))?|"
    r"kept|respected|qualif(?:y|ies)|comply|complies|accepted|acceptable|cleared|granted|ok(?:ay)?|"
    r"good|fine|valid|(?:be )?observed|satisfy (?:it|that|this|them)|meet (?:it|that|this|them)|"
    r"match(?:es)?(?: that| it)?|hit|apply|applies|obeyed|in order)"
)
_WHAT = (
    r"(?:it|this|that|these|those|they|we|you|i|she|he|both|all(?: of (?:them|it|that))?|each|"
    r"(?:the|this|"
    r"that|our|my|its|your) (?:touch|contact|grip|grasp|part|piece|object|thing|hold|rule|entry|"
    r"note|label|guess|remark|"
    r"criterion|condition|conditions|requirement|claim|statement|test|check|boxes|case|sample|one|"
    r"spec|reading|state))"
)
_AUX = r"(?:is|are|was|do|does|did|has|have|would|will|can|could|may|shall|should)"
_TAIL = re.compile(
    rf"[\s:;,.?!–—-]*(?:(?:so|then|now|well),? )?(?:{_AUX}(?:n['’]t)? {_WHAT}(?: (?:still|all|both|"
    rf"now|really|indeed|not))* (?:{_TRUE}|{_PASS})|(?:{_TRUE}|{_PASS})(?:,? (?:or (?:not|{_FALSE}|"
    rf"fail|no)))?|"
    r"(?:pass|go|ok(?:ay)?|true|yes|right) (?:or|/) (?:fail|no(?:-| )?go|not|false|no|wrong)|"
    r"(?:both|all)(?: (?:of (?:them|these)|boxes|conditions|three|four))? (?:true|met|right|hold|"
    r"correct|ticked|yes|so|fulfilled|satisfied|given|kept|ok|okay|fine|there|in order)|"
    r"(?:all (?:three|four|of (?:them|these|that))|both(?: of (?:them|these))?|every one of them)|"
    r"am i (?:right|correct)(?: (?:there|about that|in that|in thinking so))?|(?:do|would|"
    r"can)(?:n['’]t)? you (?:agree|say|confirm(?: (?:it|that|this))?|concur|say so|sign (?:it|"
    r"that))|(?:do|does|can|could|may|shall) (?:i|we) (?:tick|sign)(?: (?:it|that|both|off|"
    r"the box))*|agreed?|confirm(?:ed)?|or not|yes(?: or no|, no)?|y/n|no\b|"
    r"correct me if i am wrong|(?:is )?that (?:about )?right|deal|check|got it|tick(?: or cross)?|"
    r"yay or nay|yea or nay"
    r")(?: (?:here|now|then|please|for (?:me|us|this)|at (?:the moment|present)))*[\s?.!]*$",
    re.I,
)
_DENYING = re.compile(
    rf"[\s:;,.?!–—'\"-]*(?:(?:is|am|are|was|would) {_WHAT}(?: be)? {_FALSE}|"
    r"am i (?:wrong|mistaken)|"
    r"do(?:es)? (?:your|the) (?:readings?|data|sensors?|figures|touch) (?:contradict|disagree with|"
    r"refute|deny|rule out) (?:this|that|it)|"
    rf"{_FALSE})[\s?.!]*$",
    re.I,
)
_TAG = re.compile(
    rf"[\s,;–—-]+(?:or )?(?:{_AUX}|am|were|ai)(?P<denied>n['’]?t| not)? (?:it|we|you|they|there|"
    r"this|that|i|he|"
    r"she|those|these)(?P<not> not)?[\s?.!]*$",
    re.I,
)
_DENIED = re.compile(r"n['’]t\b|\b(?:not|never|no|nothing|nobody)\b", re.I)
_SAY = (
    r"(?:confirm|verify|check|validate|assess|judge|decide|determine|establish|ascertain|certify|"
    r"attest|evaluate|find out|say|see|tell (?:me|us)|let (?:me|us) know|answer)"
)
_NOUN = (
    r"(?:statement|claim|assertion|hypothesis|criterion|condition|conditions|requirement|rule|spec|"
    r"specification|test|check|acceptance|tolerance|target|assumption|guess|bet|hunch|prediction|"
    r"question|gate|proposition|theory|checklist|sanity check|go/no-go|pass/fail|standard)"
)
_MODIFIER = r"(?:[a-z-]+ ){0,3}"
_HEADS = (
    r"(?:my|our|the|a) [a-z]+ (?:swears|says|claims|insists|thinks|believes|reckons|maintains|bets|"
    r"assumes|asserts|wrote|noted|told me|tells me)(?: that)?[:,]? ",
    r"(?:is (?:it|this) )?(?:true|right|correct|yes|pass|go|ok|fact) ?(?:or|/|-) ?(?:false|wrong|"
    r"incorrect|no|fail|no[ -]?go|not|fiction|myth)(?: (?:that|on this one|here|"
    r"question))?[\s:,;?.–—-]+",
    r"(?:(?:please|kindly|can you|could you|would you|will you|i(?: would|['’]d) like you to|"
    r"i need you "
    rf"to|just) )*(?:please )?{_SAY}(?: (?:for (?:me|us|the \w+)|please|here))*"
    r"(?:[:,–—-]+ ?| )(?:that|whether(?: or not)?|if|for (?:me|us) that)?[:, ]*",
    r"i (?:take it|gather|assume|suppose|presume|believe|understand|reckon|think|guess|trust|"
    r"would say|['’]d say|claim|bet|maintain|expect|hope|imagine|contend|submit|say|suspect|feel|"
    r"am "
    r"(?:sure|certain|told|guessing|betting|assuming))[:,]?(?: that)? ",
    r"(?:it is|it['’]s) (?:my (?:view|guess|belief|understanding)|said|claimed|written here) that ",
    r"(?:tick|check|mark) (?:both|all|the|these|two|three|every) (?:\w+ )?boxes?"
    r"(?: (?:for (?:me|us)|please))*[\s:,–—-]+",
    r"(?:two|three|both|several) (?:things|conditions|criteria|boxes|checks)(?: [a-z]+){0,5}"
    r"[\s]*[:–—-]+ ?",
    rf"(?:the|my|our|this|a|here is (?:a|my|the)|here['’]s (?:a|my|the))? ?{_MODIFIER}{_NOUN}"
    r"(?: (?:for|of|to|before) [a-z -]{2,30}?)?(?: (?:is|says|reads|demands|requires|states|being|"
    r"goes)"
    r"(?: (?:that|as follows|this))?[:,]? |[\s]*[:–—-]+ )(?:that )?",
    r"(?:are|is) (?:we|i|it|this|that|the \w+) (?:good|ready|clear|cleared|fit|ok|okay|set|safe|"
    r"fine|"
    r"all set)(?: to go)?(?: (?:for|to) [a-z ]{2,20}?)?[:–—-]+ ?",
    r"(?:is|are|do|does|would|will|can) (?:(?:the following|(?:both|"
    r"all)(?: (?:of )?(?:the following|the(?:se)?|those|them|three|four))?|these|this|the|"
    r"each)(?: (?:two|three|four|conditions?|statements?|claims?|criteria|things|points|"
    r"facts))?)(?: (?:all|both|be|still|now|at once|together))* (?:true|right|correct|met|so|"
    r"the case|satisfied|fulfilled|hold|apply|holds|given|ok|okay)"
    r"(?: (?:true|here|now|at once|together))*[\s:,–—-]+",
    r"(?:would|can|could) (?:you|one|we|i) (?:say|agree|claim|call it|confirm|sign off)(?: that)? ",
    r"(?:is it|would it be) (?:true|right|correct|fair|accurate|safe|the case|"
    r"so)(?: to say)?(?: that|(?<=say))? ",
    r"(?:does|do|would) (?:it|this|that|we|the \w+) (?:tick|meet|satisfy|fulfil|pass) (?:all|both|"
    r"every|each)(?: of)?"
    r"(?: (?:the|these|my|our|those))?(?: \w+)?[:,] ",
    r"(?:both|all|these|two|three)(?: (?:conditions|things|points|criteria|of these|"
    r"of them))? (?:have to|must|should|"
    r"need to|are to) (?:be |all |both )*(?:true|hold|met|right|satisfied|fulfilled|given)[:,.] ",
    r"(?:does|would) it (?:hold|follow|apply|stand)(?: true)? that ",
    r"(?:we|i|you|it|this|a \w+|the \w+) (?:only )?(?:pass(?:es)?|qualif(?:y|ies)|counts?|"
    r"go(?:es)?|lifts?|accepts?|(?:is|are) (?:accepted|good|ok|okay|fine|ready|cleared|safe|"
    r"allowed|approved))(?: to go)?,? (?:only )?(?:when|if|where|provided|as long "
    r"as|once)(?: that| both| all)? ",
    r"(?:do|am) (?:i|we) (?:have|right (?:in thinking )?(?:that )?|"
    r"correct (?:in thinking )?(?:that )?|got) ",
    r"(?:have|has) (?:we|you|i) (?:got|caught) ",
)
_HEAD = re.compile("|".join(f"(?:{head})" for head in _HEADS), re.I)
_VERB_FIRST = re.compile(
    r"(?:is|are|was|were|does|do|did|has|have|had|can|could|will|would|isn['’]t|aren['’]t|"
    r"doesn['’]t)\b",
    re.I,
)
_ANOTHER = re.compile(
    rf"(?:[?;!]|,|\band\b|\bor\b|\bbut\b)\s*(?:and |or |also |then )*(?:(?:{_AUX}|is)(?:n['’]t)? "
    r"(?:it|the|there|we|you|this|that|something|anything|its|our|any|an?) |how\b|what\b|which\b|"
    r"where\b|"
    r"why\b|whether\b|tell\b|give\b)",
    re.I,
)
_OPEN = re.compile(r"\b(?:how|what|which|where|why|who|whose|when)\b", re.I)
_ALL_OF = re.compile(r"\b(?:both|all|each)\b", re.I)
_ANY_OF = re.compile(r"\b(?:at least one|either one|any of)\b", re.I)

_NEEDED = re.compile(
    r"(?:(?:to|for|before) (?:[a-z]+ ){1,4}?)?,?(?:(?:i|we|they|my \w+|our \w+|the (?:boss|"
    r"customer|client|inspector|spec|rule|drawing|manual|plan|task|job)) (?:only |just |really |"
    r"must |do )*(?:needs?|wants?|requires?|demands?|insists? on|asks? for|accepts?|approves?|"
    r"takes?|have|having|would like|calls? for)|only|there (?:must|has to|should|"
    r"needs to) be)(?: (?:only|that|to have|to see|both|all))* (?P<what>.+?)(?: (?:counts?|"
    r"qualif(?:y|ies)|pass(?:es)?|will do|(?:is|are) (?:ok|fine|accepted|acceptable|needed|"
    r"required|allowed|wanted|good enough|approved)))?(?P<ask>[.;:?!,–—-]+ ?(?:so |then |"
    r"now )*(?:(?:can|may|could|do|shall|should|am|are|have|did|is|does|will) (?:i|we|you|it|this|"
    r"that|"
    r"they|both)(?: (?!more|less|over|under|above|below|how|what)[a-z]+){1,4}))?",
    re.I,
)
_SENTENCE = re.compile(r"[.?!] +[A-Za-z]")
_DENIAL = re.compile(r"(?<=\w)(?<!ca)(?<!wo)n['’]?t\b", re.I)
_BEGINS = re.compile(r"^(we|you|they|it|that|this)['’](re|s|ve)\b", re.I)
_WHOLE = {"re": "are", "s": "is", "ve": "have"}
_ONLY_ONE = re.compile(
    r"\b(?:(?:exactly|only|at most|just) one\b(?! (?:newton|milli|gram|kilo|percent|mm|n|g))|"
    r"not both)",
    re.I,
)
_NONE_OFFERED = re.compile(r"\bor (?:is it |maybe |perhaps |on |in )?(?:neither|none)\b", re.I)
_OFFERED = re.compile(r"== '[\w -]+' or ")
_OFFERS = re.compile(r"\w+,? (?:or|and) (?!more\b|less\b|above\b|over\b|below\b|under\b)", re.I)
_EITHER = re.compile(r"\b(?:either|neither|nor|one of|any of|whichever|and)\b", re.I)


def judged(question: str) -> Calculated | None:
    """The one verdict that a question wants on all that it states; None of other questions."""
    text = " ".join(question.split())
    if is_denied_first(text):  # it expects 'yes'
        text = _DENIAL.sub("", text, count=1)
    text = _BEGINS.sub(lambda found: f"{found[1]} {_WHOLE[found[2].lower()]}", text)
    core, denied = _without_tag(text)
    if core == text:
        core, denied = _without_tail(text)
    has_tail = core != text
    heads = 0
    while heads < 3 and (head := _HEAD.match(core)):
        core, heads = core[head.end() :], heads + 1
        core, flips = _without_tail(core)
        denied ^= flips
    core = core.strip(" ,.;:?!–—-\"'“”")
    if needed := _NEEDED.fullmatch(core):
        core, has_tail = needed["what"], has_tail or needed["ask"] is not None
    is_framed = bool(heads) or has_tail
    if not core or _OPEN.search(core) or (_ANOTHER.search(core) and not _ALL_OF.search(text)):
        return None
    if not is_framed and not (_VERB_FIRST.match(core) or text.rstrip().endswith("?")):
        return None
    if _SENTENCE.search(core) or _ONLY_ONE.search(text) or _NONE_OFFERED.search(text):
        return None
    condition = condition_of_statement(core, is_any=_ANY_OF.search(text) is not None)
    offers = _OFFERED.search(condition) is not None or _OFFERS.search(core) is not None
    if not condition or (offers and not (has_tail or _EITHER.search(core))):
        return None
    return Calculated(truth=f"not ({condition})" if denied else condition, unit=None)


def calls_wrong(question: str) -> bool:
    """Whether a question asks behind a statement if it is wrong: '... Is she mistaken?'."""
    found = _DENYING.search(question)
    return found is not None and found.start() > 0


def is_doubted_statement(question: str) -> bool:
    """Whether a sentence of its own asks if the one before it is wrong: 'It's a ball. Am I wrong?'.

    Behind a comma it is a tag, which expects the statement to hold.
    """
    found = _DENYING.search(question)
    return found is not None and re.match(r"\s*[.!;]", found[0]) is not None


def _without_tag(text: str) -> tuple[str, bool]:
    """A statement without its tag, and whether that takes a denial out of it."""
    found = _TAG.search(text)
    if found is None or _VERB_FIRST.match(text) or len(text[: found.start()].split()) < 2:
        return text, False
    if text[: found.start()].endswith((".", "!")):  # a question of its own
        return text[: found.start()], False
    is_denied = found["denied"] is not None or found["not"] is not None
    stated = text[: found.start()]
    if re.search(r"\b(?:we|you|i|it|they|this|that|not)$", stated, re.I):  # 'do we have that'
        return text, False
    return stated, not is_denied and _DENIED.search(stated) is not None


def _without_tail(text: str) -> tuple[str, bool]:
    """A statement without what asks behind it whether it is so, and whether that denies it."""
    if found := _DENYING.search(text):
        return (text[: found.start()], True) if found.start() else (text, False)
    found = _TAIL.search(text)
    return (text[: found.start()], False) if found and found.start() else (text, False)
