"""Questions about another time, place or finger than those of this touch, or about the gripper.

    Did the force ever go above 4 N?                unknown past.
    What was the depth last Monday?                 unknown past.
    How hard will we be gripping in ten minutes?    unknown future.
    How deep is it at the other finger?             unknown elsewhere.
    How high above the bench is the gripper?        unknown surroundings.
    How many months has the pad been in use?        unknown age.
    Is there more than one contact?                 unknown surroundings.
    Left finger or right finger?                    unknown finger.
    How far apart are the jaws?                     unknown opening.
    What if I opened the gripper by 1 mm?           unknown outcome.
    Is it heavier than an egg?                      unknown trait.

A time or a place beside a question, in a clause of its own, changes nothing: 'We met last week;
how deep is it?'. A supposed force is calculated with, a supposed move of the gripper is not: how
stiff the object is and what else holds it is not felt.

Not here: what nobody asks a gripper's touch for (``tacgrasp.lessons.dialogue.clauses.unfelt``), the
sides of the pad (``tacgrasp.lessons.dialogue.rules.edges``).
"""

from __future__ import annotations

import re

from tacgrasp.lessons.dialogue.calculations.quantity_names import THING
from tacgrasp.lessons.dialogue.clauses.unfelt import is_off_topic, names_touch
from tacgrasp.lessons.dialogue.meaning import Meaning
from tacgrasp.lessons.dialogue.query import read_query

_HISTORY = re.compile(
    r"\bat any (?:time|point|moment|stage)\b|(?<!must )(?<!may )\bat no (?:time|point|moment)\b|"
    r"\b(?:during|throughout) (?:the|this|your|our|my) (?:whole |entire |full |last |past )?"
    r"(?:shift|day|night|week|month|cycle|run|session|morning|afternoon|hour)\b|"
    r"\b(?:the|this) (?:whole|entire) (?:time|shift|day|run|cycle|job)\b|\ball along\b|"
    r"\b(?:so far|until now|up to now) today\b|"
    r"\b(?:did|has|have|had|was|were) (?:(?:the|my|our|its|this) \w+|it|we|you|i|this|that) "
    r"(?:ever|always|never)\b(?!-)|"
    r"\bnever (?:exceeded|went|got|left|fell|rose|passed|reached|dropped|slipped)\b|"
    r"\bnever (?:been )?left\b|\balways (?:stayed|remained|kept|been)\b"
)
_NOW = re.compile(r"\d+ ?(?:g|grams?|kg)\b.*\b(?:ever|always)\b")
_UNITS_OF_TIME = r"(?:seconds?|minutes?|hours?|days?|nights?|weeks?|months?|years?|shifts?)"
_WEEKDAY = r"(?:(?:mon|tues|wednes|thurs|fri|satur|sun)day)"
_SPAN = (
    r"(?:an?|one|two|three|four|five|six|ten|fifteen|twenty|thirty|a few|several|some|half an?|"
    r"\d+) "
    rf"{_UNITS_OF_TIME}"
)
_BEFORE = re.compile(
    rf"\b(?:{_SPAN} (?:ago|earlier|before (?:this|now))|yesterday|last (?:{_UNITS_OF_TIME}|time|"
    rf"{_WEEKDAY}|spring|summer|autumn|winter)|(?:earlier|before) (?:today|this {_UNITS_OF_TIME})|"
    r"(?:the )?(?:previous|preceding|last) (?:grip|grasp|squeeze|hold|press|pick|touch|contact|"
    r"object|item|part|piece|"
    r"one)|in the past|back then|before this one|when (?:it|the \w+) was new)\b"
)
_AFTER = re.compile(
    rf"\b(?:{_SPAN} (?:from now|from today|later|hence)|(?:in|within|after) (?:another )?{_SPAN}|"
    rf"tomorrow|tonight|later$|next (?:{_UNITS_OF_TIME}|time|{_WEEKDAY})|later (?:today|on|this "
    rf"{_UNITS_OF_TIME})|in (?:the )?future|some day|by (?:then|tonight|the evening|{_WEEKDAY})|"
    r"(?:the )?next (?:grip|grasp|pick|touch|object|item|part|piece|one))\b"
)
_IN_PAST = re.compile(r"\b(?:was|were|did|had|has|have|been|used to)\b|\bago\b")
_IN_FUTURE = re.compile(r"\b(?:will|shall|going to|gonna)\b|['’]ll\b")
_HOW_LONG = re.compile(
    r"(?:(?:and|but|so|then) )*how (?:long|soon|much longer|many (?:seconds|minutes|"
    r"hours))\b.*\b(?:"
    r"until|till|before|will|would|can|does)\b.*\b(?:slip|fall|drop|break|burst|hold|stay|last)s?\b"
)
"""'How long until it slips?'"""
_PAD_ITSELF = re.compile(
    r"(?:(?:and|but|so) )*(?:is|are|was|has|looks?) (?:the|your|this) (?:gel|pad|sensor|camera|"
    r"skin|"
    r"rubber)(?: (?:still|very|too|already|a bit|got|been|become))* (?:worn(?: out)?|dirty|clean|"
    r"scratched|torn|damaged|broken|new|old|dusty|cracked|defective|dried out)[?.! ]*|"
    r"(?:is|are) there (?:(?:any|a|an|some) )?(?:\w+ )?(?:hairs?|dust|dirt|grease|oil|crumbs?|"
    r"fluff|"
    r"moisture|scratch(?:es)?|tears?) (?:on|in|under) (?:the|your) (?:gel|pad|sensor|camera|"
    r"skin)\b.*"
)
"""'Is the gel worn?', which the touch does not tell."""
_THAN_A_THING = re.compile(
    r"\b(?:heavier|lighter|softer|harder|stiffer|tougher|firmer|stronger|weaker|warmer|colder|"
    r"hotter|cooler|stickier|wetter|denser|squishier|riper|fresher|older) than (?:an?|my|your|his|"
    r"her) (?!bit\b|little\b|few\b|lot\b|newton|gram|kilo|pound|ounce|limit|band|target|goal|"
    r"light\b|slight\b|firm\b|medium\b|moderate\b|heavy\b|soft\b|hard\b)[a-z]+"
)
"""'Is it heavier than an egg?'; no 'press harder than a light touch'."""
_CLAUSES = re.compile(r"[.,;:!?–—]+(?!\d)|\s-\s")
_ASKING = re.compile(
    r"(?:(?:and|but|so|now|or|then|also|tell me|roughly) )*(?:by how|to what|with what|at what|"
    r"what|"
    r"how|which|where|when|will|was|were|did|had|has|have|is|are|does|do)\b"
)
_HELD = re.compile(rf"\b(?:it|this|that|(?:the|this|that|our) {THING})\b")
_OTHER = r"(?:other|opposite|opposing|second|partner|far)"
_OTHER_FINGER = re.compile(
    rf"\b{_OTHER} (?:finger|fingertip|jaw|gel|gel pad|sensor|pad)\b"
    r"(?! (?:\w+ )?(?:edge|side|border|rim|end|half|corner|exerts?|presses|pushes|takes?|gives?|"
    r"may|"
    r"might|carries|helps|does))(?!'s (?:edge|side))"
)
_THUMB = re.compile(
    r"\b(?:the|your) (?:thumb|opposing digit)\b|"
    r"\b(?:far|other|back|reverse|opposite|hidden) side of (?:the|this|that|your) "
    r"(?:object|part|thing|fruit|berry|item|workpiece|piece)\b"
)
_LAST_SENTENCE = re.compile(r"(?<=[.!]) (?=\S+ \S+ \S)")
_FEELINGS = re.compile(
    r"\b(?:is|does|do|are|was) (?:it|he|she|they|the \w+|this|that)\b[^?]*\b(?:sad|happy|afraid|"
    r"scared|angry|lonely|alive|in pain|suffering|suffer|enjoy\w*|like being|feel pain|"
    r"mind being|love being)\b"
)
"""'Is it sad?', 'does it like being held?'"""
_WISHES = re.compile(
    r"\bwhat (?:will|shall) (?:i|we|they|he|she|the (?:operator|user|boss)) (?:\w+ )?"
    r"(?:ask|want|need|say|tell|request|order|bring|give)\b"
)
_OF_BOTH = re.compile(
    r"\b(?:sum|both|together|total|altogether|combined|two fingers|same|equal\w*|identical|alike|"
    r"if|"
    r"suppose|assum\w+|half)\b"
)
_GROUND = r"(?:table|floor|ground|bench|desk|conveyor|belt|tray|bin|wall|door|shelf|room)"
_NEARBY = re.compile(
    rf"\bhow (?:high|far|near|close|long|fast|many \w+)\b.*\b(?:above|over|from|off|to|below|"
    rf"under|across|on|is|does) the {_GROUND}\b"
)
_AGE = re.compile(
    r"\bhow old\b|\bwhen (?:was|were|did|has) (?:(?:the|this|that|your|our|its) )?(?:\w+ ){1,3}"
    r"(?:made|built|changed|replaced|exchanged|installed|fitted|calibrated|cleaned|serviced|"
    r"bought|delivered)\b|"
    r"\b(?:in|how many) (?:seconds|minutes|hours|days|weeks|months|years)\b"
)

_SEVERAL = r"(?:more than one|two|three|several|multiple|many|(?:a )?second|another|any other)"
_CONTACTS = (
    r"(?:(?:separate|different|distinct|other) )?(?:contacts?|touch(?:es)?|"
    r"contact (?:points?|areas?|patch(?:es)?|spots?|places?)|points? of contact)"
)
_MORE_CONTACTS = re.compile(
    rf"\b(?:is|are) there {_SEVERAL} {_CONTACTS}\b(?! (?:force|limit|than))|"
    rf"\bhow many {_CONTACTS}\b|"
    rf"\b(?:do|can) you (?:feel|sense|see|detect) {_SEVERAL} {_CONTACTS}\b|"
    rf"\b(?:touch\w*|contact|press\w*) (?:\w+ ){{0,2}}?(?:in|at) (?:more than one|two|three|"
    r"several|multiple|different) (?:\w+ )?(?:places?|spots?|points?)\b"
)


def of_elsewhere(question: str) -> Meaning | None:
    """What is at another time, place or finger than this touch; None of other questions."""
    words = " ".join(question.lower().replace("’", "'").split())
    subject = _subject(words)
    return read_query(f"unknown {subject}.") if subject else None


def _subject(words: str) -> str:
    """What touch can't know of it; '' where the question is about this touch."""
    if _HISTORY.search(words) and not _NOW.search(words):
        return "past"
    if is_off_topic(words):
        return ""
    if _HOW_LONG.match(words) or _WISHES.search(words):
        return "future"
    has_feelings = _FEELINGS.search(words) is not None
    if has_feelings or _PAD_ITSELF.fullmatch(words) or _compared_with_a_thing(words):
        return "trait"
    if _MORE_CONTACTS.search(words):
        return "surroundings"
    asked = _LAST_SENTENCE.split(words)[-1]
    is_of_one = _OTHER_FINGER.search(asked) and not _OF_BOTH.search(words)
    if is_of_one or _THUMB.search(words):
        return "elsewhere"
    for clause in map(str.strip, _CLAUSES.split(words)):
        if not _ASKING.match(clause) or re.search(r"\bif\b", words):
            continue
        if _NEARBY.search(clause):
            return "surroundings"
        if not _HELD.search(clause) and not names_touch(clause):
            continue
        if _BEFORE.search(clause) and _IN_PAST.search(clause):
            return "past"
        if _AFTER.search(clause) and _IN_FUTURE.search(clause):
            return "future"
        is_of_something = re.search(r"\b(?:it|its|this|that|the|these)\b", clause)
        if is_of_something and _AGE.search(words) and not re.search(r"\d", words):
            return "age"
    return ""


def _compared_with_a_thing(words: str) -> bool:
    return bool(_THAN_A_THING.search(words)) and not re.search(r"\d", words)


_FINGER = r"(?:(?:gripper |robot )?(?:finger|fingertip|jaw|arm)|gripper|sensor)"
_NO_SIDE = r"(?![- ](?:side|edge|end|border|rim|half|part|force|of)\b)"
_ONE = r"(?:left|right|other|first|second|upper|lower)(?:[- ]hand)?"
_WHICH_FINGER = re.compile(
    r"\b(?:which|what)(?: one)?(?: of (?:the|your|our)(?: two)?)? (?:finger|fingertip|jaw|arm)s?"
    r"(?=$| (?:is|are|am|do|does|did|has|have|was|it|i|we|you|touches|feels|holds|presses)\b)|"
    rf"\b{_ONE} {_FINGER}{_NO_SIDE},? or (?:[a-z]+ ){{0,3}}?{_ONE}\b{_NO_SIDE}|"
    rf"\b{_ONE}(?: one)?,? or (?:[a-z]+ ){{0,3}}?{_ONE} {_FINGER}\b{_NO_SIDE}"
)
"""'Which finger is touching?', 'the left or the right finger?'"""

_GRIPPER = r"(?:gripper|jaws?|fingers?|hand)"
_OPENING = re.compile(
    rf"\b{_GRIPPER}(?:['’]s|s['’])? (?:gap|opening|aperture|stroke|spacing|clearance)\b|"
    rf"\b(?:gap|opening|distance|space|spacing|clearance) (?:between|of) (?:(?:the|your|our|both|"
    rf"two) )*{_GRIPPER}\b|"
    rf"\bhow (?:far|wide|widely|much) (?:is|are) (?:the |your |our )?(?:two )?{_GRIPPER} "
    r"(?:still )?(?:open|opened|apart|closed|spread)\b|"
    rf"\bhow (?:far|wide|widely)(?: open| apart| closed) (?:is|are) (?:the |your |our )?{_GRIPPER}"
)

_WHO = (
    r"(?:i|we|you|they|one|someone|somebody|(?:the|my|our|your) "
    rf"(?:{_GRIPPER}|robot|arm|wrist|operator))"
)
_AGREED = r"(?:force|grip force|squeeze|pressure|load|limit|band)"
_MOVES = (
    r"(?:(?:re)?open(?:s|ed)?|clos(?:e|es|ed)|"
    r"lets? (?:it |this |that |the \w+ )?go(?! (?:of|by|to)\b)|"
    rf"(?:releas|rotat)(?:e|es|ed)|(?:drop(?:s|ped)?|tilt(?:s|ed)?|twist(?:s|ed)?|"
    r"jerk(?:s|ed)?|bump(?:s|ed)?|knock(?:s|ed)?)|sh(?:ake|akes|ook)|(?:jiggl|wiggl|rattl)e(?:s|d)?|sw(?:ing|ings|ung)|"
    rf"turn(?:s|ed)? (?:it|this|that|the \w+) (?:over|around|round|upside down|on its side))"
    rf"(?! (?:the |my |our )?(?:{_AGREED}|eyes)\b)"
)
_SUPPOSES = r"(?:if|when|once|after|suppose|supposing|assuming|imagine)"
_MOVED = re.compile(
    rf"\b{_SUPPOSES} {_WHO}(?: (?:now|then|were to|was to|would|should|could|just|simply|"
    rf"suddenly|quickly|slowly))* (?P<clause>{_MOVES}\b[^,;?]*)"
)
_OF_FORCE = re.compile(
    rf"\d ?(?:m?n|(?:milli)?newtons?|%|per ?cent|k?g|grams?)\b|\b(?:newton|percent|{_AGREED})\b"
)
"""What a clause has that supposes a force: 'if I closed it until 2 N are felt'."""

_HAPPENS = re.compile(
    r"(?:(?:and|but|so|then) )*what (?:would|will|might|could|may|does|do|is going to)?(?: then| "
    r"likely| probably)? ?(?:happens?|change|changes|occurs?|follows?|come of it|go wrong)\b.* "
    rf"{_SUPPOSES} .+"
)
_OF_LIFTING = re.compile(r"\b(?:lift|hold|carr[yi]|rais|pick|weigh|slip|add|mass|gram)\w*\b|\d")


def of_gripper(question: str) -> Meaning | None:
    """What touch can't know of the gripper and its moves; None of other questions."""
    words = _words(question)
    if _WHICH_FINGER.search(words):
        return read_query("unknown finger.")
    if _OPENING.search(words):
        return read_query("unknown opening.")
    moved = _MOVED.search(words)
    if moved and not _OF_FORCE.search(moved["clause"]):
        return read_query("unknown outcome.")
    return None


def of_outcome(question: str) -> Meaning | None:
    """What would happen after something that nothing is calculated with; None of others.

    'What happens if someone leans on the arm?'
    """
    words = _words(question)
    is_outcome = _HAPPENS.fullmatch(words) and not _OF_LIFTING.search(words)
    return read_query("unknown outcome.") if is_outcome else None


def _words(question: str) -> str:
    return " ".join(question.lower().replace("’", "'").split()).rstrip("?.! ")
