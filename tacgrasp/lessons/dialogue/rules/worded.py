"""Questions whether what is felt is called so, by words that may be no class of the sensor.

    Is that a star I'm holding?         calculate shape == 'star'.
    My money's on a cube. Did I win?    check shape cuboid.
    Either a ring or a disc, right?     calculate shape in ['ring', 'disc'].
    Neither dotted nor striped, then?   calculate not (texture in ['bumpy', 'ridged']).
    A star or a square?                 choice shape.

A question is read by its clauses: one at least names a shape or a texture, and beside names every
clause has nothing but words that change nothing. Not here: questions that the grammar has
(``tacgrasp.lessons.dialogue.families.classes``).
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

from cltp.tactile.states import CLASSES
from tacgrasp.lessons.dialogue.families.classes.lexicon import Named, named, words_pattern
from tacgrasp.lessons.dialogue.plain_words import plain_words
from tacgrasp.lessons.dialogue.plainer import AUXILIARY

MOST_CLAUSES = 6
"""Most clauses of a question that is read so. Our choice: longer ones have more to say."""

MOST_NAMED = 5
"""Most words that are asked for at once. Our choice, as of joined questions."""

_CLAUSE = re.compile(r"[.?!;:,()–—]+(?=\s|$)|\s+[-–—]+\s+|[()]")
_PAD = r"(?:the|your|our|my|this) (?:\w+ )?(?:pad|gel|sensor|finger|fingers|fingertip|gripper|skin)"
_REMARKS = re.compile(
    "|".join(
        (
            # one of several is enough
            r"(?:is|was|would|could|can|might) (?:it|this|that) (?:be )?(?:any |either )?(?:one "
            r")?of "
            r"(?:them|those|these|the)(?: two| three| #| following)?"
            r"(?: (?:that |which )?(?:you|we|i)(?: \w+){1,3})?",
            r"(?:say |answer )?yes (?:means?|if|for|when|to)\b.*|"
            r"(?:just )?(?:say|answer) yes (?:if|for|when)\b.*",
            r"(?:either|any|both)(?: one)?(?: of (?:them|those|these|the))?(?: two| three| #| "
            r"ones?)?"
            r"(?: \w+)? (?:counts?|is|are|would|will|does|do|works?|suits?|makes?|goes?|go)\b.*",
            r"one of (?:the|those|these|them)(?: two| three| #)?(?: at least| is enough)?",
            r"(?:either|any)(?: one)?(?: of (?:them|those|these|the)(?: two| three| #)?)?",
            # was it right
            r"(?:did|have|do) (?:i|we|they|he|she|my \w+) (?:win|won|lose|lost|get it right|guess "
            r"(?:right|correctly|well)|got it right|guessed right|have it right|"
            r"hit it)",
            r"(?:am|was|were|are|is|would) (?:i|we|they|he|she|that|this|it|"
            r"the \w+|my \w+)(?: be)? (?:not )?(?:right|correct|true|so|wrong|mistaken|accurate|"
            r"dreaming|justified|a good (?:bet|guess)|the case|not)",
            r"(?:does|do|did|can|could|would|will) (?:the|your|this|that|my)? ?"
            r"(?:touch|contact|sensor|gel|pad|feel|reading|readings|finger|fingers|fingertip|press|"
            r"imprint|you|it|evidence|tactile \w+)(?: \w+)? (?:bears?|back|confirms?|agrees?|fits?|"
            r"match|"
            r"matches|"
            r"supports?|concur|say so|tell|verify|second)(?: (?:that|this|it|me|out|up|with|so|"
            r"as much|my \w+|what you feel|(?:that|this|it|me) (?:out|up)))*",
            r"(?:is|was) (?:it|that|this)(?: (?:one|so|it|not|what you feel|what we have|"
            r"what you have|what it is|there|borne out|confirmed))?(?: by (?:the )?(?:touch|"
            r"contact|feel|sensor))?",
            r"(?:would|do|can|could) (?:you|we) (?:not )?(?:agree|confirm|concur|say so|say that|"
            r"second that|go along)(?: (?:to|with) (?:that|it|me))?(?: (?:that )?it is (?:one|"
            r"so))?",
            r"(?:please )?(?:confirm|deny|confirm or deny|check|verify)(?: (?:that|this|it))?"
            r"(?: please| for me)?",
            r"(?:right|correct|true|yes|no|nah|ok|okay|agreed?|concur|deal|yeah|eh|huh|innit|true "
            r"or false|"
            r"yes or no|right or wrong|y n|true false|or (?:not|no|nah|what|am i (?:wrong|"
            r"mistaken)|"
            r"is it(?: not)?|have i got (?:it|that) wrong)|is it|is it not|does it|does it not|are "
            r"they|"
            r"do you think|would you say|in your (?:view|opinion|judgement)|by (?:feel|touch)|"
            r"as far as you can (?:tell|feel)|from what you feel|what do you (?:say|think)|"
            r"(?:i|we) (?:would )?(?:suppose|think|guess|take it|believe|reckon|presume|gather|"
            r"assume|bet|hope|"
            r"expect|imagine|say)|"
            rf"{AUXILIARY} not (?:it|they|that|this|we|you|i)|"
            r"by any chance|then|or neither(?: of (?:them|these|those|the two))?|or neither one)",
            r"(?:i|we) (?:do not|would not) (?:mind|care)(?: (?:which|either way)(?: one| of "
            r"them)?)?|"
            r"(?:it is |is it )?(?:all )?the same to me",
            # have we one
            r"(?:have|has|had|do|did|does|is|was|are) (?:we|you|i|it|there|this|that|they)"
            r"(?: (?:got|have|feel|see|find|hold|holding|touching|feeling))? "
            r"(?:one|any|either|it|that|those)(?: (?:here|there|then|(?:one )?of (?:them|those|"
            r"these)))?",
            # address, beginnings, likenesses
            r"(?:my (?:good |dear |old )?(?:machine|friend|robot|man|dear)|robot|mate|buddy|pal|"
            r"dear|sir|hey|hi|hello|yo|ok|okay|so|well|now|right|please|thanks|thank you|listen|"
            r"look|"
            r"(?:a |one |my )?(?:quick |sanity |small |little |silly |last |another |first |next )*"
            r"(?:question|check|query)|quick one|tell me|honestly|be honest|go on|come on|excuse "
            r"me|sorry|"
            r"just checking|one more|next|hm+|um+|uh+|oh|and|the (?:shape|texture|surface|finish|"
            r"form)|"
            r"shape|texture|surface|finish|form|about the (?:shape|texture|surface))",
            r"(?:just |a bit |kind of )?(?:like|as) (?!an?$).*",
        )
    )
)
"""Clauses that name nothing and change nothing."""

_ENOUGH = re.compile(
    r"\b(?:either|any) (?:one |of |would|will|counts?|is |works?|does|do|makes?)|"
    r"\bone of <n>|\bone of (?:them|those|these|the|(?:the |those |these )?(?:two|#))\b|\bof the "
    r"following\b|"
    r"\b(?:mind|care) (?:which|either)\b|\bthe same to me\b|"
    r"\byes (?:means?|if|for|when|to)\b|\b(?:take|accept|settle for|be happy with|be fine with)\b|"
    r"\bwould (?:be fine|do|suit)\b"
)
"""One of several words is enough for a yes."""

_ASKS_YES = re.compile(
    r"\b(?:am i|are we|is (?:it|that)(?: not)?) (?:right|correct|true|so)\b|"
    r"\b(?:yes or no|true or false|right or wrong)$|^(?:is it|yes|no|eh|yeah|agreed|y n)$|"
    r"\b(?:right|correct|true)$|^(?:is|are|does|do|"
    r"has|have|can|could|would|did|was)\b"
)
_OWNED = re.compile(r"(?<=\w)'s\b")
_OR_NEITHER = re.compile(r"\bor (?:neither|none)\b")
_OR_NEITHER_END = re.compile(
    r"\bor (?:neither|none)(?: one)?(?: of (?:them|these|those|the(?: two| three)?))?(?= ;|$)"
)
_IS_IT_ONE = re.compile(r"(?:is|was|are) (?:it|this|that|they)(?: (?:one|so after all|after all))?")
_NOT = re.compile(r"\b(?:not|no|neither|nor|never|nothing|without|hardly)\b")
_OTHER_THAN = re.compile(r"\b(?:anything|something|other) (?:but|other than|than)\b|\bother than\b")
_STAKED = re.compile(
    r"\b(?:my|your|our|his|her|their|the|all)(?: \w+)? (?:money|bets?|guess|hunch|wager|vote|"
    r"hopes?|chips|"
    r"savings|shirt|tip)(?:'s| is| was| are| goes| went| would be| would go)?(?: all)?(?: still)?"
    r"(?: on| for)?(?: it (?:being|is))?(?= |$)|"
    r"\b(?:i|we|he|she|they) (?:would |will |have |had )?(?:bets?|put|wagere?d?|gambled?|stake|"
    r"staked|"
    r"going|go|went|plump|plumped|opt|opted|vote|voted|lay)(?: (?:my|some|good|a|all my|the|\w+))?"
    r"(?: (?:money|shirt|house|life|tenner|fiver|coffee|beer|pint|quid|euro|euros|lunch))?(?: on| "
    r"for)"
    r"(?: it (?:being|is)| this being| that being)?(?= |$)"
)
"""Bets on what it is, whose words would say where it is: 'my money is on a star'."""

_SAYS = re.compile(
    r"\b(?:(?:the|my|our|your|his|her|their|a)(?: \w+){1,2}|some(?:body|one)|every(?:body|one)|"
    r"people|they|he|she) (?:says|said|claims|claimed|promised|promises|shows|"
    r"showed|insists|insisted|swears|swore|told (?:me|us)|tells (?:me|us)|calls? (?:it|this|that)|"
    r"called (?:it|this|that)|lists|listed|states|"
    r"stated|reckons|thinks|thought|bets?|guess(?:es|ed)?|expects?|expected|believes?|suspects?|"
    r"describes? it as)(?: that)?(?= |$)"
)
"""Who says what it is: 'the drawing says'."""

_NOT_THE_OTHER = re.compile(
    r"(?<=<n>)(?: \w+)? (?:rather than|instead of|as opposed to|and not|but not) (?:like )?<n>"
)
"""The word that is denied beside another one: 'striped rather than dotted'."""

_PLACED = re.compile(
    r"\b(?:at|near|nearby|by|in|on|from|over|off|past|beyond|beside|(?<!shape )(?<!form "
    r")(?<!outline )"
    r"(?<!figure )(?<!print )(?<!imprint )(?<!mark )(?<!kind )(?<!sort )(?<!type )(?<!tip )"
    r"(?<!pattern )(?<!one )of) <n>|<n> of\b"
)
"""A name that says where it is: 'at the corner', 'a corner of the pad'."""

_OPEN = re.compile(r"^(?:what|which|how|why|where|when|who)\b")
_OR_NOT = re.compile(r" or (?:not|no|nah|nope|what|am i (?:wrong|mistaken)|is it not)$")
_DOUBLED = re.compile(r"\b(?:rather than|instead of|as opposed to|more than|less than|than)\b")
_FILLERS = frozenset(
    """
    a an the this that these those it they he she we i you me us my our your there here one
    is are was were be been being am do does did has have had got get getting could can may might
    would will
    should expect expected expecting suspect suspected think thought thinking believe believed
    bet betting wager guess guessed guessing say saying said call called consider hope hoping hoped
    assume assumed reckon reckoned imagine fear feared take taken swear sworn told tell
    claim claimed describe described class classed classify rate count deem
    is on my hunch bet gut feeling impression understanding idea theory
    to feel feels feeling felt touch touches touching touched hold holds holding held grip grips
    gripping gripped grasp grasping press presses pressing pressed squeeze squeezing catch caught
    hit sense sensing detect detecting detected find found meet met notice
    look looks seem seems appear appears resemble resembles come comes across
    shape shaped shapes form figure outline geometry profile section cross-section kind sort type of
    like as pattern patterned texture textured finish finished surface relief feel skin exterior
    coating face outside material imprint print mark contact object thing item piece part one stuff
    thingy specimen sample side end tip
    under against on at in between into by from with for pad gel sensor finger fingers fingertip
    gripper fingertips hand
    what which whether if about maybe perhaps really actually indeed certainly truly possibly
    probably surely definitely clearly quite rather fairly pretty very somewhat at all just only
    any some sort so well then now right still also too even simply basically honestly
    right correct wrong true mistaken in thinking assuming saying supposing believing
    both either or and nor neither not no n't
    little whole entire guessing supposing perfect proper regular
    fine good enough by money anything something fair description apt term accurate word name proper
    suitable fitting honest
    deal dealing handling recognise recognize recognised
    now currently presently please yo hey
    """.split()  # noqa: SIM905
)
_NOUNS = re.compile(
    rf"\b(?:on|against|under|in|into|between|at|by|to|from|with) {_PAD}\b|"
    r"\bby any (?:chance|means)\b|\bfor (?:once|sure|real|certain)\b|\bsome sort of\b|\ball over\b|"
    r"\bof (?:it|this|that|(?:the|this|that|my|our|your) (?:object|thing|item|piece|part))\b|"
    r"\b(?:it is )?(?:the case|fair|safe|possible|true) (?:that|to say(?: that)?)\b|"
    r"\b(?:deserves?|merits?) the name\b|\b(?:answers? to|fits?|matches|match) the description\b"
)
"""Phrases that change nothing, whose words would elsewhere."""


@dataclass(frozen=True, slots=True)
class _Clause:
    """A clause with names: its words, '<n>' for each name, what they name, and the names."""

    words: str
    names: tuple[tuple[Named, ...], ...]
    said: tuple[str, ...]


def worded_query(question: str) -> str:
    """The query of a question for words of the contact; '' of any other question."""
    clauses = []
    parts = [_OWNED.sub(" is", " ".join(plain_words(part))) for part in _CLAUSE.split(question)]
    parts = [part for part in parts if part]
    if not parts or len(parts) > MOST_CLAUSES or "#" in " ".join(parts):
        return ""
    for part in parts:
        if _REMARKS.fullmatch(part):
            continue
        clause = _clause(part)
        if clause is None:
            return ""
        clauses.append(clause)
    names = [name for clause in clauses for name in clause.names]
    if not 0 < len(names) <= MOST_NAMED:
        return ""
    return _query(clauses, parts)


def _clause(words: str) -> _Clause | None:
    """A clause that names something and has nothing else to say; None of others."""
    words = _SAYS.sub("", _STAKED.sub("", _OR_NOT.sub("", words))).strip()
    bare = words_pattern().sub(lambda match: _kept(match[0], "<n>"), words)
    found = list(words_pattern().finditer(words))
    while shorter := _NOT_THE_OTHER.search(bare):
        found.pop(bare[: shorter.end()].count("<n>") - 1)
        bare = f"{bare[: shorter.start()]}{bare[shorter.end() :]}"
    rest = _OTHER_THAN.sub("", _NOUNS.sub("", bare)).split()
    if not found or _DOUBLED.search(_OTHER_THAN.sub("", bare)) or _PLACED.search(bare):
        return None
    if _OPEN.match(bare) and " or " not in bare:
        return None
    if any(word not in _FILLERS and word != "<n>" for word in rest):
        return None
    said = tuple(match[1] for match in found)
    return _Clause(bare, tuple(named(each) for each in said), said)


def _kept(text: str, name: str) -> str:
    """What stands for a name: 'no' before it stays."""
    return f"no {name}" if text.startswith("no ") else name


def _query(clauses: Sequence[_Clause], parts: Sequence[str]) -> str:
    """The query of clauses with names.

    Args:
        clauses: The clauses with names.
        parts: The plain words of all clauses.
    """
    words = " ; ".join(clause.words for clause in clauses)
    names = [name for clause in clauses for name in clause.names]
    every = [each for name in names for each in name]
    words = _OR_NEITHER_END.sub("or", words)
    denials = len(_NOT.findall(words)) + len(_OTHER_THAN.findall(words))
    if any(_IS_IT_ONE.fullmatch(part) for part in parts):
        denials = 0  # 'it is not a ring, I bet. Is it one?'
    if re.search(r"\bneither\b.*<n>.*\bnor\b", words):
        return _checked(every, is_denied=True)
    if len(set(names)) == 1:
        if words.endswith(" or"):
            return ""
        return "" if denials > 1 else _checked(names[0], is_denied=denials == 1)
    is_enough = any(_ENOUGH.search(part) for part in (*parts, *words.split(" ; ")))
    is_either = is_enough or re.search(r"\bor\b", words) is not None
    is_either = is_either and re.search(r"\band\b", words) is None
    if not is_either or denials > 1:
        return ""
    if denials == 1:
        return _checked(every, is_denied=True)
    asks_yes = any(_ASKS_YES.search(part) for part in parts) and re.search(r"\beither\b", words)
    if is_enough or asks_yes:
        return _checked(every, is_denied=False)
    if any(_OR_NEITHER.search(part) for part in parts):
        return _or_neither([word for clause in clauses for word in clause.said])
    dimensions = {each.dimension for each in every}
    return f"choice {dimensions.pop()}." if len(dimensions) == 1 else ""


def _or_neither(words: Sequence[str]) -> str:
    """Which of some words is so, or 'neither'."""
    tests = []
    for word in words:
        (name, *others) = named(word)
        if others or len(name.classes) > 1:
            return ""
        tests.append(f"{word!r} if {name.dimension} == {name.classes[0]!r}")
    return f"calculate {' else '.join(tests)} else 'neither'."


def _checked(names: Sequence[Named], *, is_denied: bool) -> str:
    """The query whether one of some names is so, or none of them."""
    classes: dict[str, list[str]] = {}
    for name in names:
        classes.setdefault(name.dimension, []).extend(name.classes)
    told = {name: list(dict.fromkeys(each)) for name, each in classes.items()}
    tests = [
        f"{name} == {each[0]!r}" if len(each) == 1 else f"{name} in {each}"
        for name, each in told.items()
    ]
    test = " or ".join(tests)
    dimension, each = next(iter(told.items()))
    if len(told) == len(each) == 1 and each[0] in CLASSES[dimension]:
        return f"check {'not ' if is_denied else ''}{dimension} {each[0]}."
    if is_denied:
        return f"calculate not ({test})."
    return f"calculate {test}."
