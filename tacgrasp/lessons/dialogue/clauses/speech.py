"""What of a longer speech asks: the rest tells of circumstances, and is left out.

    Three drops this week, so before we lift it I have to ask: is the force too low?
    Is it deeper than 1 mm? I never know with these machines.
    careful these bruise like nothing, you're not over a newton are you

What has numbers, conditions or words of touch stays, because it may bear on what is asked.

Not here: address, thanks and tags (``tacgrasp.lessons.dialogue.plainer``).
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from tacgrasp.lessons.dialogue.clauses.class_names import is_class_named
from tacgrasp.lessons.dialogue.plain_words import plain_words

_AUX = (
    r"(?:is|are|was|were|has|have|had|do|does|did|can|could|will|would|should|shall|must|may|might|"
    r"am|isn['’]t|aren['’]t|haven['’]t|hasn['’]t|doesn['’]t|don['’]t|didn['’]t|can['’]t|won['’]t)"
)
_ASKS = re.compile(
    rf"(?:(?:and|so|but|now|then|ok|okay|please|well|right)[, ]+)*(?:{_AUX} (?:it|we|you|they|"
    r"there|i|this|that|these|those|the|my|our|your|its|any|anything|something|a|an|he|she|more|"
    r"less|over|under|at|both|either|all|half)\b|(?:what|how|which|where|whereabouts|why|whose|who|"
    r"when|by how|at what|in what|on what|to what|what['’]s|"
    r"how['’]s|where['’]s)\b)",
    re.I,
)
_TELL = re.compile(
    r"(?:please )?(?:tell (?:me|us)|say|let me know) (?=(?:what|how|where|which)\b)", re.I
)
_STATES = re.compile(r"(?:you|we|it|they|that|there)(?:['’]re|['’]s|['’]ve)?\b", re.I)
_TAG = re.compile(
    r"(?<=[\w%])(?:,)? (?P<tag>(?:is|are|was|have|has|do|does|did|can|will)(?:n['’]t)? "
    r"(?:it|we|you|they|there|i|that))\s*[?.!]*$",
    re.I,
)
_ASK_ME = re.compile(
    r"(?:i|we) (?:have to|need to|must|want to|would like to|gotta|should|['’]d like to) (?:ask|"
    r"know|be sure|"
    r"check|find out)(?: you)?(?: is)?[:,]? $",
    re.I,
)
_BEARS = re.compile(
    r"\d|\b(?:if|unless|suppose|supposing|imagine|assum\w+|instead|answer|reply|pick|choose|call|"
    r"means?|sign(?! (?:it|this|that|the|off|for|up|on)\b)|minus|negative|positive|word|"
    r"sentence|count|counting|say|whichever|either|"
    r"neither|or|force\w*|newtons?|depth|deep|dent|contact|area|patch|limit|band|range|window|"
    r"edges?|borders?|offset|shapes?|textures?|surface|position|mass|weight|weighs?|grams?|kilos?|"
    r"mm|micro\w+|milli\w+|(?:left|right|top|bottom|palm|fingertip) (?:side|edge|half|hand|part|"
    r"rim)|(?:the|to the|on the) (?:left|right)|left or right|(?:a|one|two|three|four|five|ten|"
    r"hundred|half an?|quarter of an?) (?:newtons?|milli\w+|micro\w+|grams?|kilos?|percent)|"
    r"percent|middle|cent(?:re|er)|pressed|grip|squeeze|squeezing|pad|gel|more than|less than|"
    r"at least|at most|x|y|rule|criterion|true|false|absolute|decimals?|digits?|round\w*|signed|"
    r"unit|units|both|ends|figure|number|figures|numbers|centi\w+|inch\w*|press\w*|"
    r"what|how|which|whether|where|compared|than|object|label)\b",
    re.I,
)
_BREAK = re.compile(r"[,:;–—]\s+|\s[-–]\s|\.\.+\s*|\b(?:so|but) (?=\w)", re.I)
_TRAILING = re.compile(r"[,;–—]\s+|\s[-–]\s|\.\.+\s*|\s(?=because )", re.I)
_SENTENCE = re.compile(r"(?<=[.!?])(?<!i\.e\.)(?<!e\.g\.)\s+(?=\S)", re.I)
_MODIFIES = re.compile(
    r"(?:and |but |or )?(?:in (?:words|terms|one|a|an|centi|milli|micro|newtons?|qualit\w+|grams?|"
    r"kilos?|percent\w*|\w+ terms|which)|as|by|from|along|without|ignor\w+|measur\w+|sideways|"
    r"lengthw\w+|between|out of|left|right|top|bottom|going by|judg\w+|look\w*|according|no|"
    r"never mind|of|to|end|regardless|disregard\w*|count\w*|with|at|on|under|over|per|not|leaving|"
    r"apart|except|only|each|every|"
    r"roughly|for (?!my|our|the|your))\b",
    re.I,
)
"""What begins something that bears on the question: 'ignoring its direction', 'in words'."""

_POINTS_BACK = re.compile(r"\b(?:it|they|them|there|that|this|its|their)\b", re.I)
_TELLS = re.compile(
    r"\b(?:i|we|you|me|us|let us|careful|sorry|hurry|quick|listen|right|look)\b|\b(?:i|we|"
    r"you)['’]",
    re.I,
)
"""Who speaks of the circumstances; without, a noun may be what 'it' stands for."""

_WHEN = re.compile(r"when (?:i|we|he|she|they|my|our|the) [^?]+, ", re.I)
_WHETHER = re.compile(
    r"(?P<before>[^?]*\b(?:tell|know|say|establish|hear|learn|inform|advise|confirm|check|"
    r"determine|"
    r"clarify|state|find out|see|report|record|wonder(?:ing)?|ask(?:ing)?|answer|decide|judge)\b"
    r"[^?]*?)\b(?:whether|if) (?P<stated>[^?]+\??)",
    re.I,
)
"""'I should like to tell the students whether it is round'."""

_ASIDE = re.compile(
    r",? ?\b(?:for (?:the|my|our|his|her) (?:record|log|logbook|minutes|report|file|protocol|form|"
    r"notes?|books|homework|notebook|thesis|boss|paperwork|sheet|checklist)|without (?:any )?"
    r"(?:hedging|waffl\w+|ifs (?:and|or) buts|beating a\w+ the bush)|possibly|perchance|"
    r"by any chance|"
    r"(?:rather|quite|fairly|pretty)(?! than)(?= (?:an? )?[a-z]+(?: [a-z]+)?\W*$)|"
    r"if (?:i|we) may (?:ask|be so bold)|in your (?:own )?(?:opinion|view|judge?ment|estimation|"
    r"estimate)|as far as you (?:can )?(?:tell|feel|judge|know|see)|to be (?:honest|frank|fair)|"
    r"honestly|frankly|all things considered|as (?:it|things) stands?|as of now|"
    r"(?:right this|at this very) (?:second|minute|instant|moment|point))\b,?(?! or\b)",
    re.I,
)
"""What changes nothing wherever it stands."""

LEAST_WORDS = 3
"""Shortest question that may stand alone [words]. Our choice: 'is it?' follows something."""


def asked_in_speech(question: str) -> Iterator[str]:
    """What of a speech may be its question, the longest first; nothing of what is no speech."""
    text = " ".join(question.split())
    seen = {text}
    alone = " ".join(_ASIDE.sub(" ", text).split())
    found = (*_of_sentences(text), *_of_clauses(text), _with_comma(text), alone, *_whether(text))
    for each in found:
        if each not in seen and len(each.split()) >= LEAST_WORDS:
            seen.add(each)
            yield each


def _of_sentences(text: str) -> Iterator[str]:
    """The only sentence that asks, where no other one bears on it."""
    sentences = _SENTENCE.split(text)
    if len(sentences) < 2:
        return
    asking = [each for each in sentences if each.endswith("?") or _ASKS.match(each)]
    if len(asking) != 1:
        return
    beside = [each for each in sentences if each is not asking[0]]
    if not any(_bears(each) for each in beside):
        yield asking[0]
        yield from _of_clauses(asking[0])


def _of_clauses(text: str) -> Iterator[str]:
    """What asks behind, or before, a clause that tells of something else."""
    if _ASKS.match(text) and not _WHEN.match(text):
        for joint in _TRAILING.finditer(text):
            before, behind = text[: joint.start()], text[joint.end() :]
            is_told = re.match(r"(?:i|he|she|my|our|they|because)\b", behind, re.I)
            if is_told and not _bears(behind) and not _ASKS.match(behind):
                yield f"{before.rstrip(' ,')}?"
                return
        return
    for joint in _BREAK.finditer(text):
        before, behind = text[: joint.start()], text[joint.end() :]
        if _MODIFIES.match(before) or _bears(_ASK_ME.sub("", before)):
            return
        if _POINTS_BACK.search(behind) and not _TELLS.search(before):
            continue
        states = _STATES.match(behind) and _TAG.search(behind)
        if _ASKS.match(behind) or _TELL.match(behind) or states:
            yield _with_comma(behind)
            return


def _whether(text: str) -> Iterator[str]:
    """What somebody wants to be told whether it is so, without why they ask."""
    found = _WHETHER.fullmatch(text)
    if found and not _bears(found["before"]):
        yield f"Is it true that {found['stated'].rstrip('?')}?"


def _bears(text: str) -> bool:
    """Whether something may bear on the question beside it."""
    return _BEARS.search(text) is not None or is_class_named(" ".join(plain_words(text)))


def _with_comma(text: str) -> str:
    """A statement whose tag lacks its comma, with it: 'you're not over a newton are you'."""
    if not _STATES.match(text) or (found := _TAG.search(text)) is None:
        return text
    return f"{text[: found.start()]}, {found['tag']}?"
