"""What a question says beside its alternatives: terms, cues of what it is about, and no more.

Every word must be one of a term, a cue or a word without a bearing; where one is not, the question
says something that is not understood.

Not here: the alternatives (``tacgrasp.lessons.dialogue.choices.scales``).
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from tacgrasp.lessons.dialogue.calculations.asked import AskedWords
from tacgrasp.lessons.dialogue.calculations.terms import UNSAID, Term
from tacgrasp.lessons.dialogue.choices.scales import GAP

LONGEST_TERM = 10
"""Most words of a term. Our choice."""

MOST_WORDS = 45
"""Longest question [words]: its time grows with the square."""

_PAD = r"(?:pad|gel|sensor|sensing area|skin|finger|fingertip|surface|face)"
_CUES = {
    "band": (
        r"(?:(?:target|wanted|goal|force|desired|requested|required|agreed|ordered|asked for|"
        r"intended|set|permitted|allowed|given|specified|our|the) )*"
        r"(?:band|range|window|corridor|interval|goal|target)(?: (?:wanted|agreed|given|asked for|"
        r"that (?:i|we) (?:want|wanted|asked for|agreed)))?|wanted|desired|requested|ordered"
    ),
    "force": (
        r"press(?:es|ed|ing)?|push(?:es|ed|ing)?|squeez(?:e|es|ed|ing)|gripp(?:ed|ing)|"
        r"pinch(?:es|ed|ing)?|clamp(?:s|ed|ing)?|exert(?:s|ed|ing)?|appl(?:y|ies|ied|ying)|"
        r"bearing down|newtons"
    ),
    "area": (
        r"cover(?:s|ed|ing|age)?|fill(?:s|ed|ing)?|occup(?:y|ies|ied|ying)|"
        r"t(?:ake|akes|aking|aken|ook) up|touch(?:es|ed|ing)?|in contact|under contact"
    ),
    "depth": (
        r"deep|indent(?:s|ed|ing)?|s[iu]nk(?:s|ing)?(?: in)?|(?:pressed|pushed|poked|dug) in|"
        r"(?:goes|gone|went|going) in|dimple|hollow|squash|into the (?:pad|gel|skin)|in depth|"
        r"penetrat(?:e|es|ed|ing)"
    ),
    "offset": (
        rf"(?:away |off )?from (?:the |its )?(?:very |exact |dead )?(?:middle|center|midline|"
        rf"bullseye)(?: line)?(?: of (?:the |our )?{_PAD})?|off(?: center)?|offsets?|displaced|"
        r"displacements?|out(?: of place)?|shift(?:ed)?|strayed|wandered|drifted|miss(?:es|ed)?|"
        r"error|misplaced|misplacement|deviation|deviates?|away|distance|eccentric"
    ),
    "x": r"sideways|horizontal(?:ly)?|lateral(?:ly)?|crosswise|left (?:to )?right|side to side",
    "y": (
        r"lengthwise|lengthways|vertical(?:ly)?|up (?:and )?down|along the finger|"
        r"palm to (?:finger)?tip"
    ),
    "holds": (
        r"holds?|holding|held|carr(?:y|ies|ied|ying)|lift(?:s|ed|ing)?|support(?:s|ed|ing)?|"
        r"bears?|keep(?:s|ing)?|surely|sure|safely|safe|certain(?:ly)?|guaranteed|load|payload|"
        r"for (?:sure|certain)|without (?:slipping|dropping it)|capacity"
    ),
    "mass": r"weighs?|weighing|heavy",
    "near": r"near(?:er|est)?|clos(?:e|er|est)",
    "larger": (
        r"larger|bigger|greater|more|most(?:ly)?|main(?:ly)?|further|farther|furthest|worse|"
        r"worst|stronger|chiefly|largely|primarily|predominantly|larger part|greater part|"
        r"bigger part|predominates?|bulk|largest|greatest|biggest|dominates?|dominant"
    ),
    "smaller": r"smaller|less(?:er)?|smallest|least",
    "middle": (
        rf"(?:in |to |of |into |at |on |onto )?(?:the )?(?:dead |very |exact |re )?(?:middle|"
        rf"center(?:ed)?|midline|midpoint|halfway (?:line|mark))(?: line)?"
        rf"(?: of (?:the |our )?{_PAD})?"
    ),
    "half": r"half|halves",
    "end": r"ends?|edges?|bounds?|boundary|boundaries|limits?|borders?",
    "place": (
        rf"(?:of |on |in |at )?(?:the |our |my |your )?{_PAD}|sides?|part|portion|where(?: is)?|"
        r"whereabouts|area|region|position(?:ed)?|lies?|sits?|lands?|landed|lying|sitting|located"
    ),
    "move": (
        r"mov(?:e|es|ed|ing)|go(?:es)?|shift(?:s|ed)?|slid(?:e|es)|nudg(?:e|es|ed)|push(?:ed)?|"
        r"shov(?:e|es|ed)|travel|bring|brought|get|steer|correct(?:ed|ion)?|adjust(?:ed)?"
    ),
}
_FILLER = re.compile(
    r"(?:"
    r"(?:i|we) (?:can|could|do) not (?:tell|know|say|decide|work out|remember)(?: (?:whether|if))?|"
    r"(?:would|could|can|do|should|shall|will) (?:you|i|we) (?:rather |please |just )?"
    r"(?:say|call|describe|put|bet|class|file|think|reckon|tell me|rate|judge|guess|pick|mark|"
    r"record|write|note|report|consider|count|have|tick)(?: (?:of|it|that|this|down|on))?|"
    r"pick (?:one|#\d+|a side)|choose (?:one|#\d+|between)|(?:just )?one of (?:the )?(?:two|#\d+)|"
    r"(?:of )?(?:the |these |those )?(?:two|#\d+)(?= (?:ends?|sides?|halves|offsets?|axes|words?|"
    r"options?|alternatives?|answers?|directions?|numbers?|bounds?|edges?|borders?|parts?|\|))|"
    r"which (?:one )?of (?:the |these |those )?(?:two|#\d+)(?: is it)?|#\d+ or the other|"
    r"(?:to be|in order to be|it has to|we have to|you have to|i have to|have to|has to|had to|"
    r"need(?:s)? to|would have to|ought to|supposed to|so as to|in order to)|"
    r"what would you (?:say|call it)|(?:what is )?(?:your|the) (?:verdict|judgement|opinion|call|"
    r"ruling)|"
    r"(?:would|could|can|do) you (?:sort|put|place|group|list) (?:this|it|that)|under|"
    r"which(?: (?:one|way|is it|would you say|do you (?:say|feel)))?|"
    r"at the moment|right now|for the moment|as it is|at present|just now|in size|in magnitude|"
    r"end(?:s|ed)? up|as (?:far as|much as)|on the whole|in total|in all|on average|all in all|"
    r"(?:i|we) (?:wonder|ask|am asking|need to know|want to know|am wondering)(?: (?:whether|if))?|"
    r"let me know(?: (?:whether|if))?|tell me(?: (?:whether|if))?|say(?: (?:whether|if))?|"
    r"do (?:you|we|i)|(?:one|single) word|in (?:a|one|#\d+) words?|short answer|"
    r"(?:the |a |an |this |that |our |your |my )?(?:object|thing|berry|strawberry|fruit|item|piece|"
    r"egg|tomato|peg|part|body|specimen|sample|workpiece|contact|touch|print|imprint|mark|patch|"
    r"spot|grip|gripper|robot|hand|fingers|jaws|grasp|hold|reading|result|value|figure|number|it|"
    r"centroid|answer|scale|line|size|amount|level|amount of|level of|direction|way|axis|rim)|"
    r"the|a|an|is|are|am|was|were|be|being|been|do|does|did|has|have|had|will|would|should|shall|"
    r"must|can|could|may|might|it|that|this|there|these|those|here|now|i|we|you|us|me|my|our|your|"
    r"its|she|he|her|him|they|them|one|ones|of|in|on|at|to|by|for|from|with|than|as|or|either|"
    r"versus|vs|rather|just|only|please|what|so|then|currently|presently|actually|really|"
    r"still|already|exactly|precisely|quite|measured|against|compared|relative|respect|"
    r"(?:if|when|once) (?:i|we|you|the robot) (?:raise|lift|move|hoist) (?:up )?(?:it|"
    r"the (?:arm|hand|robot|gripper))(?: up| off)?|"
    r"with (?:this|that|the present|the current) (?:grip|force)|"
    r"describes?|fits|applies|beneath|surface|sign|given|stated|told|known|status|state|hanging|some|my|got|ought|reach|hit|arrive|achieve|"
    r"anything|got hold of|felt|feel|feeling|feels|actual|present|current|true|real|whole|overall|"
    r"total|both|"
    r"(?:for (?:the |my |our |this |a )?(?:[a-z]+ ){0,2})?(?:chart|log|logbook|report|form|sheet|"
    r"records?|file|protocol|notes|paperwork|table)|i tick #?\w+ box(?: only)?|"
    r"dear|darling|mate|chef|boss|friend|bet|rather|more likely|likely|"
    r"choose|choice|decide|answer|name|state|towards?|onto|into|along|between|"
    r"come|comes|coming|put|puts|stand|stands|stay|stays|be|make|makes|show|shows|read|reads|"
    r"whether|back|straight|"
    r"\|"
    r")(?= |$)"
)
_CUE = [(name, re.compile(rf"(?:{words})(?= |$)")) for name, words in _CUES.items()]


@dataclass(frozen=True, slots=True)
class RestOfQuestion:
    """What a question says beside its alternatives.

    Attributes:
        terms: Its terms, each once, in their order.
        cues: Names of the cues.
    """

    terms: tuple[Term, ...]
    cues: frozenset[str]

    def has_only(self, *cues: str) -> bool:
        """Whether there are no cues but these."""
        return self.cues <= set(cues)


def rest_of(asked: AskedWords, words: str) -> RestOfQuestion | None:
    """The terms and cues of words; None where they have something else.

    Args:
        asked: The question.
        words: Its plain words, with ``GAP`` for each alternative.
    """
    left = words.split()
    if len(left) > MOST_WORDS:
        return None
    terms: dict[str, Term] = {}
    cues: set[str] = set()
    while left:
        size, term = _term(asked, left)
        text = " ".join(left)
        name, cue = max(
            ((name, _length(pattern.match(text))) for name, pattern in _CUE),
            key=lambda each: each[1],
        )
        filler = _length(_FILLER.match(text))
        longest = max(size, cue, filler)
        if longest == 0:
            return None
        if term is not None and size == longest and (filler < size or term.dimension != UNSAID):
            terms.setdefault(term.expression, term)
        elif cue == longest:
            cues.add(name)
        left = left[longest:]
    return RestOfQuestion(tuple(terms.values()), frozenset(cues))


def _length(match: re.Match[str] | None) -> int:
    return len(match[0].split()) if match else 0


def _term(asked: AskedWords, words: list[str]) -> tuple[int, Term | None]:
    """The longest term at the beginning, with how many words it has."""
    for size in range(min(LONGEST_TERM, len(words)), 0, -1):
        begin = words[:size]
        if GAP in begin or begin[-1] in ("the", "of", "than", "or"):
            continue
        term = asked.term(" ".join(begin))
        if term is not None and (term.has_quantity or "#" in term.words):
            return size, term
    return 0, None
