"""Questions about another time, place or finger than those of this touch, which it does not tell.

    Did the force ever go above 4 N?                unknown past.
    What was the depth last Monday?                 unknown past.
    How hard will we be gripping in ten minutes?    unknown future.
    How deep is it at the other finger?             unknown elsewhere.
    How high above the bench is the gripper?        unknown surroundings.
    How many months has the pad been in use?        unknown age.
    Is there more than one contact?                 unknown surroundings.

A time or a place beside a question, in a clause of its own, changes nothing: 'We met last week;
how deep is it?'.

Not here: what nobody asks a gripper's touch for (``tacgrasp.lessons.dialogue.clauses.unfelt``).
"""

from __future__ import annotations

import re

from tacgrasp.lessons.dialogue.calculations.quantity_names import THING
from tacgrasp.lessons.dialogue.clauses.unfelt import is_off_topic, names_touch
from tacgrasp.lessons.dialogue.meaning import Meaning
from tacgrasp.lessons.dialogue.query import read_query

_HISTORY = re.compile(
    r"\bat any (?:time|point|moment|stage)\b|\bat no (?:time|point|moment)\b|"
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
    r"(?:the )?(?:previous|preceding|last) (?:grip|grasp|pick|touch|contact|object|item|part|piece|"
    r"one)|in the past|back then|when (?:it|the \w+) was new)\b"
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
    if _HOW_LONG.match(words):
        return "future"
    if _PAD_ITSELF.fullmatch(words):
        return "trait"
    if _MORE_CONTACTS.search(words):
        return "surroundings"
    if _OTHER_FINGER.search(words) and not _OF_BOTH.search(words):
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
