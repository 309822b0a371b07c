"""What a question's form tells of its query: a question that begins with 'is' wants yes or no.

The readers of questions (``tacgrasp.lessons.understanding``) know words; of long or strange
questions they mistake the kind of answer that is wanted, which the first words tell.
"""

from __future__ import annotations

import re

from tacgrasp.lessons.dialogue.plainer import AUXILIARY, plainer

_BEGINS_WITH_VERB = re.compile(rf"{AUXILIARY}\b", re.I)
_INDIRECT = re.compile(
    r"(?:can|could|will|would|may|might|do|did|have|shall) (?:you|i|we) (?:[a-z]+ly )?"
    r"(?:please |perhaps |be so kind as to |be able to |mind |like to |happen to |have to )*"
    r"(?:tell|give|say|state|report|describe|name|know|let|show|quote|estimate|specify|share|note|"
    r"read|have|ask|trouble|explain|provide|measure|check|see|express|send|put|write|call|class|"
    r"get|learn|"
    r"identify|summari|feel|sense|find|work|guess|indicate|confirm|comment|inform|remind|pass|"
    r"advise|"
    r"suggest|recommend)|(?:is|was|are|were) there\b",
    re.I,
)
"""'Could you tell me' asks for anything."""

_ASKS_OPENLY = re.compile(
    r"(?:(?:and|so|now|then) )*(?:(?:by|at|to|of|in|with|from|on|for|about|roughly) )*"
    r"(?:what(?! (?:if|about|makes)\b)|which|where|whereabouts|how (?:much|many|far|deep|deeply|"
    r"big|"
    r"large|heavy|high|wide|strong|strongly|hard|firmly|long|close|near|great))\b",
    re.I,
)
"""'How many' and 'where' want no yes or no, but where another clause begins with a verb."""

_OPENS_LAST = re.compile(
    r"[–—:;.,]\s+(?:(?:and|so|but|then) )*(?:(?:by|at|to|of|in|with|from|on) )*"
    r"(?:what(?:['’]s)?(?! (?:if|about)\b)|how (?:many|much|far|deep|large|big|high|wide))\b"
    r"[^?!;:.]*(?:\.\d[^?!;:.]*)*[?.! ]*$",
    re.I,
)
_REQUESTS = re.compile(
    r"(?:please )?(?:give|tell|state|report|quote|name|read out|show|convert|put|express|work out|"
    r"calculate|compute|take|subtract|add up)(?: me| us)?(?: out)? (?:the|its|our|this|how|what|a|"
    r"an)\b",
    re.I,
)
_IF_SO = re.compile(
    r"[(,;]? *(?:(?:with|use|put|add|and) )?(?:an? |the )?(?:negative|minus|positive|plus|zero|"
    r"nought|nothing|nil|0)\b[^().;?]*\b(?:if|when|where|should)\b[^().;?]*\)?(?=[.?! ]*$)",
    re.I,
)
"""'Negative if it is beyond', which asks for no yes or no."""

_LAST_CLAUSE = re.compile(
    rf"[–—:;.,?!-]\s+(?:(?:and|so|but|then) )*(?P<clause>{AUXILIARY} (?:it|that|this|there|we|i|"
    rf"you|"
    r"they|the|my|our|your|any\w*|something)\b(?! (?:please|"
    r"kindly)\b)[^?!;:,.]*\w[^?!;:,.]*)\??\s*$",
    re.I,
)
_VERB_INSIDE = re.compile(
    rf"(?:[–—:;.,?!-]|\b(?:whether|if|and|so))\s+{AUXILIARY}\b|\b(?:whether|if)\b", re.I
)

_ASKS_WHY = re.compile(
    r"\b(?:why|how come|reason|because|ground|justif|explain|explanation|motive|basis|rationale|"
    r"evidence|based|cause|wherefore|what for|what makes|sure|certain)",
    re.I,
)

_VERB = rf"{AUXILIARY}(?:n['’]?t)?"
_ANOTHER_CLAUSE = re.compile(
    rf"[?!;:]\s*\w|[.,]\s+(?:and |or |also )*{_VERB}\b|\b(?:and|or|plus|also) (?:also )?{_VERB}\b"
    r"|\b(?:and|plus|also) (?:what|which|how|why|where|whether|if|"
    r"the(?! (?:left|right|top|bottom|upper|lower)\b)|its|it)\b",
    re.I,
)

_JOINT = re.compile(
    r"\b(?:and|plus|also|both|besides|additionally|further|then|nor|but|yet|as well|along with|"
    r"together with|followed by)\b|[?!;:/&+]\s*\w|[.\n]\s+\w",
    re.I,
)
_LIST = re.compile(r"[^,]+(?:, *(?:\S+ ?){1,4})+")
"""'Shape, depth, force in grams?'."""

_SENTENCE = re.compile(r"[^.!?]+(?:[.](?=\d)[^.!?]*)*[.!?]*")

_BEARS_ON_IT = re.compile(
    r"[\d:]|\b(?:pick|choose|answer|say|tell|give|name|one word|sentence|assume|suppose|if|imagine|"
    r"rule|only|not|call|means?)\b",
    re.I,
)
"""What a sentence beside a question has that changes what is asked."""

_HOLDS = (
    r"(?:say|saying|said|claim|claiming|claimed|assume|assuming|assumed|think|thinking|thought|"
    r"state|stating|stated|believe|believing|believed|suppose|supposing|tell|telling|told|"
    r"expect|expecting|guess|guessing|conclude|concluding|report|reporting|write|writing)"
)
_CALLED_FALSE = re.compile(
    r"(?:(?:would (?:i|we|you|one) be|am i|are we) (?:wrong|mistaken|incorrect|lying|off) "
    rf"(?:to {_HOLDS}|in {_HOLDS}|(?:when|if|where) (?:i|we|you|one) {_HOLDS})"
    r"(?: (?!nothing\b|something\b|anything\b)(?:them|him|her|you|people|(?:the |my |our )\w+))?"
    r"(?: that)?|(?:is|was|would) it (?:be )?(?:(?:false|"
    r"(?:impossible|out of the question)(?= that\b)|untrue|wrong|incorrect|inaccurate|mistaken)|"
    r"not (?:true|correct|right|the case|so)|an? (?:mistake|error|lie))"
    r"(?: to (?:say|write|claim|state|assume|think|note|record|put down|report))?(?: that)?) "
    r"(?P<stated>.+)",
    re.I,
)


_TOPIC = re.compile(
    r"(?:with (?:regard|respect) to|regarding|as (?:for|regards|to)|concerning|in terms of|"
    r"when it comes to|speaking of|about|on) (?:the |its |our |this )?(?:\w+ )?"
    r"(?P<topic>shape|form|texture|surface|depth|force|grip|area|size|position|place|location)"
    r"(?: of (?:the |this )?(?:contact|touch|object|thing))?[,:] +(?P<rest>.+)",
    re.I,
)
_ABOUT = {
    "form": "shape", "surface": "texture", "grip": "force", "size": "area", "place": "position",
    "location": "position",
}  # fmt: skip


def without_topic(question: str) -> tuple[str, str]:
    """A question without the topic that it begins with, and the name of that; '' where none.

    'Regarding the shape: sphere or cylinder?'
    """
    if (found := _TOPIC.match(question)) is None:
        return question, ""
    topic = found["topic"].lower()
    return found["rest"], _ABOUT.get(topic, topic)


_SENTENCES = re.compile(r"(?<=[.!?;:]) +(?=\S)")
_OUTSIDE = re.compile(
    r"n['’]t\b|\b(?:not|no|never|neither|nor|without|too|outside|out of|outwith|off|wrong\w*|"
    r"beyond|over\w*|under\w*|above|below|un\w+|in(?:correct|adequate|appropriate|sufficient)\w*|danger\w*|bad\w*|less|more|"
    r"wait\w*|fail\w*|miss\w*|violat\w*|br(?:eak|oke)\w*|trouble|risk\w*|problem\w*|excess\w*|"
    r"adjust\w*|chang\w*|correct\w*|fix\w*|lack\w*|false|lie|exceed\w*|leav\w*|left|stray\w*|"
    r"deviat\w*|err\w*|alarm\w*|worr\w*|stop\w*|reject\w*|loos\w*|weak\w*|hard\w*|soft\w*|tight\w*)\b",
    re.I,
)
"""Without such a word nobody asks whether the force is outside the band."""
_LIFT = re.compile(r"\b(?:lift|rais|hoist|pick)\w*", re.I)
_NO_LIFT = re.compile(
    r"n['’]t\b|\b(?:not|no|never|without|too|wrong\w*|un\w+|danger\w*|risk\w*|bad\w*|wait\w*|"
    r"(?:hold|holding|back|call) off|outside|stop\w*|refrain\w*|forbid\w*|fail\w*|trouble|"
    r"mistak\w*|fool\w*|hazard\w*|against|object\w*|missing|lack\w*|premature\w*|early|prevent\w*|"
    r"oppos\w*|veto\w*|block\w*|keep\w*|hinder\w*|rul\w+ out)\b",
    re.I,
)
"""Without such a word nobody asks whether it is wrong to lift."""


def is_unlikely(question: str, query: str) -> bool:
    """Whether a question's form speaks against a query.

    Args:
        question: The question, as ``tacgrasp.lessons.dialogue.plainer`` leaves it.
        query: The query (``tacgrasp.lessons.dialogue.query``).
    """
    parts = query.split(";")
    if len(parts) > 1 and not (_JOINT.search(question) or _LIST.fullmatch(question.strip(" ?.!"))):
        return True
    kinds = {part.strip().partition(" ")[0].rstrip(".") for part in parts}
    if "why" in kinds and not _ASKS_WHY.search(question):
        return True
    if "check not force within" in query:
        last = _SENTENCES.split(question)[-1]
        if not (_NO_LIFT if _LIFT.search(last) else _OUTSIDE).search(last):
            return True
    is_choice = re.search(r"\bor\b", question, re.I) is not None
    signless = _IF_SO.sub("", question)
    asks_for_one = _ASKS_OPENLY.match(question) or _REQUESTS.match(question)
    asks_last = not _BEGINS_WITH_VERB.match(question) and _OPENS_LAST.search(signless)
    is_open = asks_for_one or asks_last
    if is_open and not is_choice and not _VERB_INSIDE.search(signless):
        return "check" in kinds
    last = _LAST_CLAUSE.search(question)
    clause = last["clause"] if last else question
    if not _BEGINS_WITH_VERB.match(clause) or _INDIRECT.match(clause):
        return False
    wanted = {"check", "unknown", "other"}
    if is_choice:
        wanted.add("choice")
    return not kinds & wanted


_SAID_FIRST = re.compile(
    r"(?P<said>[^,;?.!]+)[,;:–—-]+ is (?:that|this) (?:what|how|where) (?P<subject>(?:the \w+|it|"
    r"this|that)) (?:is|feels|sits|lies|stands)[?.! ]*",
    re.I,
)


def in_usual_order(question: str) -> str:
    """A question that says first what it asks: 'Rough, is that how it feels?'; '' of others."""
    found = _SAID_FIRST.fullmatch(question.strip())
    return f"Is {found['subject']} {found['said'].lower()}?" if found else ""


_NUMBER_BEFORE = re.compile(
    r"(?P<told>[^?]*?(?<![\w.])(?P<number>\d+(?:\.\d+)? ?(?:mm|cm|µm|microns?|millimet(?:re|"
    r"er)s?|N|mN|"
    r"newtons?|millinewtons?|grams?|g|percent|%))(?![\w])[^?]*?[.,;:!–—-]) +(?:(?:so|and|but) )?"
    rf"(?P<asked>{AUXILIARY} [^?,;:]*?\b(?:over|above|beyond|past|under|below|within|more than|"
    rf"less than|"
    r"exceed(?:ed|ing)?|at|reach(?:ed)?)) (?:that|this)(?: (?:figure|mark|value|number|limit|"
    r"bound|amount|"
    r"line|threshold))?(?: (?:now|already|yet|at the moment|still|here|at present))*[?.! ]*",
    re.I,
)
_HAS_NUMBER = re.compile(r"\d")


def with_number_before(question: str) -> str:
    """A question of 'that', with the only number told before it; '' of others.

    'Anything above 2.5 N worries me. Is the grip over that?'
    """
    found = _NUMBER_BEFORE.fullmatch(question.strip())
    if found is None or len(re.findall(r"\d+(?:\.\d+)?", found["told"])) != 1:
        return ""
    return f"{found['asked']} {found['number']}?" if not _HAS_NUMBER.search(found["asked"]) else ""


def begins_as_one(question: str) -> bool:
    """Whether the first word asks: a verb, 'what', 'how far'."""
    return bool(_BEGINS_WITH_VERB.match(question) or _ASKS_OPENLY.match(question))


def is_one_clause(question: str) -> bool:
    """Whether a question has one verb for all that it asks: 'Is it round and smooth?'."""
    return _ANOTHER_CLAUSE.search(question) is None


def alone_asked(question: str) -> str:
    """The one sentence that asks, of several; all of them where none, or more than one, asks.

    'The stem is thin. Is it deep?' asks whether it is deep.
    """
    sentences = [each.strip() for each in _SENTENCE.findall(question)]
    asking = [each for each in sentences if each.endswith("?")]
    beside = " ".join(each for each in sentences if not each.endswith("?"))
    if len(asking) != 1 or not beside or _BEARS_ON_IT.search(beside):
        return question
    return asking[0]


_MEASURED = re.compile(
    r"\d ?(?:m?n|newtons?|millinewtons?|[mcµu]m|mm²?|microns?|millimet\w+|k?g|grams?|%|percent|"
    r"per cent)(?!\w)|\b(?:if|unless|suppos\w+|assum\w+|imagine|answer|reply|call|means?|counts?|"
    r"instead|criterion|otherwise|say|not ask\w*|counting|positive|negative|minus|axis|"
    r"origin)\b|\?",
    re.I,
)
"""What a sentence has that the next one may build on."""

_THAT_ONE = re.compile(
    r"\b(?:that|this|said) (?=(?:patch|band|limit|contact|force|dent|imprint|area|touch|depth)\b)",
    re.I,
)
_WHAT_I_WANT = re.compile(
    r"^(?:(?:anyway|so|now|well|but)[, ]+)*(?:all|what) (?:i|we)(?:['’]d| would)? "
    r"(?:like|want|need|am after|care about|ask for)(?: to (?:know|hear))? (?:now )?is (?=the\b)",
    re.I,
)
"""'What I'd like is the depth.'"""


def last_asked(question: str) -> str:
    """The last sentence, where those before it have nothing that it builds on; '' of others.

    'We had tea. The cat walked over the keyboard. What I'd like is the depth, in millimetres.'
    """
    sentences = [each.strip() for each in _SENTENCE.findall(question)]
    *before, last = sentences or [""]
    if not before or _MEASURED.search(" ".join(before)):
        return ""
    last = _WHAT_I_WANT.sub("what is ", last)
    return _THAT_ONE.sub("the ", last) if begins_as_one(last) else ""


_ASIDE = re.compile(r"\s*\((?!s\))[^()\d]*\)|,? if (?:any|at all)(?=[?.! ]*$)", re.I)
_FILLER = re.compile(
    r"(?:^|(?<=\w),|(?<=\.\.\.)) ?(?:um+|uh+|er+m?|like|you know|i mean|sort of|kind of|let['’]s "
    r"say)"
    r"(?:,|\.\.\.)(?= )",
    re.I,
)
"""'So, um, is it, you know, deep?'"""
_REPLY_FIRST = re.compile(
    r"^(?:yes or no|short answer|quick (?:one|question))"
    r"(?:,? (?:nothing else|no more|only|please|nothing more|just that))*[:,.–—-]+ +",
    re.I,
)


_NOT_THIS = re.compile(
    r"^(?:please )?(?:(?:do not|don['’]?t|never|no need to) (?:(?:just|only) )?(?:tell|give|say|"
    r"show|report|read)(?: me| us)?(?: about)?|(?:i|we) (?:do not|don['’]?t) (?:want|need|care "
    r"(?:about|for)|mean|ask for)(?: to know)?|not|forget(?: about)?|never mind|leave out) (?:the "
    r"|its |your )?[a-z]+(?: (?:please|now|at all))*(?:[,;.:–—-]+| -+) +"
    r"(?:but |just |only |instead |rather )?(?P<rest>\S.*)",
    re.I,
)
_WISHED = re.compile(
    r"^(?:(?:i|we) (?:want|need|meant?|asked for|would like)(?: to know)?|"
    r"(?:tell|give|show) (?:me|us)|say|report) (?=(?:the |its )?[a-z]+[.! ]*$)",
    re.I,
)
"""'I want the position', 'tell me the force'."""


def wanted_instead(question: str) -> str:
    """What is asked for in place of something: 'don't tell me the depth, tell me the force'.

    '' of other questions.
    """
    found = _NOT_THIS.match(question.strip())
    return _WISHED.sub("what is ", found["rest"]) if found else ""


def without_aside(question: str) -> str:
    """A question without what it says aside, and without how it wants to be replied to.

    'How far is it from the lower end (the fingertip)?', 'Yes or no, nothing else: is it deep?'
    """
    return _REPLY_FIRST.sub("", _ASIDE.sub("", _FILLER.sub("", question)))


def denied_statement(question: str) -> str:
    """The statement that a question calls false ('is it untrue that it is deep?'); '' if none."""
    found = _CALLED_FALSE.match(plainer(question))
    return found["stated"] if found else ""
