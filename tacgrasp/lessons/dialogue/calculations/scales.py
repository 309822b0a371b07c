"""Questions about a scale that they state themselves: how much of it is used, or left.

    If 2 mm is full scale, what percentage are we at?       100 * depth_mm / 2
    The gel bottoms out at 2 mm. How many mm are left?      2 - depth_mm
    Are we in the lower half of the 0 to 10 N scale?

Not here: shares of what is felt or given (``tacgrasp.lessons.dialogue.calculations.shares``).
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from tacgrasp.lessons.dialogue.calculations.asked import AskedWords, usual, usual_unit
from tacgrasp.lessons.dialogue.calculations.phrases import PARTS, is_made_of
from tacgrasp.lessons.dialogue.calculations.quantity_names import UNIT
from tacgrasp.lessons.dialogue.calculations.terms import PLAIN, Term, alike

_FULL = (
    r"(?:(?:the |its |our |a )?(?:full|whole|entire|maximum|max|complete|total|available) "
    r"(?:scale|range|travel|stroke|depth|indentation|compression|deflection|squash|squeeze|grip|"
    r"press|load|clamp|force|dent)|full|"
    r"(?:the )?(?:maximum|max|limit|end|end stop|bottom|deepest|most|whole (?:of it|thing)|lot)"
    r"(?: (?:of (?:the )?(?:travel|range|scale|stroke)|possible|there is|it can (?:take|do|go)))?|"
    r"all (?:(?:that )?(?:the (?:gel|pad)|it|we|there) (?:has|have|can|is)(?: got)?(?: to)?(?: "
    r"(?:give|take|offer|do|go))?)|"
    r"(?:#\d+|one hundred|a hundred) percent|bottoming out|bottomed out|all the way(?: in| down)?|"
    r"as (?:far|deep) as it (?:goes|can go|will go)|(?:the )?(?:gel|pad)(?: is|'s) limit)"
)
_PLACE = r"(?:the |this |that |our )?(?:gel|pad|skin|jelly|rubber|elastomer|sensor|cushion|it|dent|"
_WHOLE = (
    rf"{_PLACE}indentation|depth|travel|range|scale|stroke|gauge|dial|meter)"
    r"(?: (?:travel|range|scale|stroke|depth|indentation))?"
)
_CAN = (
    r"(?:(?:can|could|may|will|only|at most|goes|go|is|are|has|have|gives?|bottoms?|compress|"
    r"compresses|squish|squishes|squash|squashes|sink|sinks|takes?|runs?|ends?|stops?|tops?|maxes|"
    r"reads?|allows?|offers?|be|pressed|pushed|dented|squished|squashed|compressed|"
    r"indented|in|out|down|up|to|at|by|of|from|about|around|a|an|over|for|with|maximum|max|"
    r"travel|range|scale|thick|full|most|the|limited|rated|measures?|covers?|spans?) )+"
)
_BEHIND = (
    r"(?: (?:max|maximum|at most|at the most|at best|deep|thick|in|down|tops|and no more|"
    r"no further|of travel|of (?:gel )?indentation|of give|of squash|the man said|they say|"
    r"i am told|i was told|we are told|according to (?:the|its) \w+|before it bottoms out))*"
)
_LEAD = (
    r"(?:if|suppose|supposing|assume|assuming|say|given|taking|take|with|since|as|on|of|out of) "
)
_STATED = tuple(
    re.compile(rf"(?:^|(?<= ))(?:{_LEAD})*(?:that )?{pattern}(?= |$)")
    for pattern in (
        rf"(?P<w>#\d+ (?:{UNIT})(?: of \w+| deep| in)?) (?:is|are|was|were|counts as|count as|"
        rf"means|being|be|as|marks|makes|stands for|equals|represents|corresponds to|"
        rf"called) {_FULL}",
        rf"{_FULL}(?: (?:is|are|was|were|means|being|comes|at|of|to|equals|"
        rf"amounts|reached|lies|sits))+ (?P<w>#\d+ (?:{UNIT})){_BEHIND}",
        rf"{_WHOLE} {_CAN}(?P<w>#\d+ (?:{UNIT})){_BEHIND}",
        rf"(?:the |a |our )?(?P<w>(?:scale|range|span|interval) (?:(?:of|from|running from|"
        rf"going from) )?#\d+(?: (?:{UNIT}))? (?:(?:to|through|up to) )?(?:#\d+ (?:{UNIT})|"
        r"the \w+))(?: as (?:a|the) whole)?",
        rf"(?:the |a |our )?(?P<w>#\d+(?: (?:{UNIT}))? (?:to )?#\d+ (?:{UNIT}) "
        r"(?:scale|range|span))",
        rf"(?:the |a |our |its |total |available |full |maximum )*(?P<w>#\d+ (?:{UNIT}))(?: of)? "
        r"(?:(?:gel|indentation|depth|force|full|maximum|available|total|of) )*"
        r"(?:travel|scale|range|stroke)(?: available)?",
        rf"(?:the |a |our )?(?P<w>#\d+ (?:{UNIT}))(?: deep| thick)? (?:gel|limit|maximum|max)\b",
        rf"(?:call|take|treat|count|consider|regard) (?P<w>#\d+ (?:{UNIT}))(?: as)? {_FULL}",
        rf"(?:we|you|i|it) (?:are|were|is|am) (?:allowed|permitted) (?:to (?:go|press|sink) )?"
        rf"(?P<w>#\d+ (?:{UNIT}))(?: deep| in| of \w+)?",
        rf"out of (?:(?:a|the|our|its|possible|total|maximum|max|available|full) )*"
        rf"(?P<w>#\d+ (?:{UNIT}))",
        rf"(?:we|you|i|it|there) (?:have|has|get|is|are|got)(?: got)? (?P<w>#\d+ (?:{UNIT})) "
        r"(?:to (?:play with|work with|go|use)|available|in (?:total|all)|altogether)",
    )
)
_USED = (
    r"(?:used|used up|gone|taken|taken up|reached|filled|covered|consumed|spent|eaten up|squished|"
    r"squashed|compressed|pressed in|pushed in|pressed|dented|indented|done|exhausted|travelled|"
    r"behind us|down|in)"
)
_FREE = (
    r"(?:left|left over|free|available|remaining|remains|remain|in reserve|unused|spare|to spare|"
    r"to go|"
    r"still there|untapped|in hand|before)"
)
_ASKING = (
    r"(?:what|which|how|much|many|far|deep|is|are|am|be|does|do|did|has|have|was|the|a|an|of|that|"
    r"it|"
    r"this|these|those|we|i|you|they|there|then|now|so|at|in|into|to|on|up|along|out|down|still|"
    r"already|currently|present|presently|right|been|get|got|gets|come|comes|stand|stands|sit|sits|"
    r"reach|reaches|read|reads|make|makes|use|uses|using|take|takes|amount|amounts|go|goes|"
    r"work|works|by|as|its|our|my|would|will|tell|me|give|full|whole|entire|scale|range|travel|"
    r"stroke|span|total|maximum|max|possible|gel|pad|felt|current|measured|far|"
    r"object|thing|contact|reading|value|figure|said|press|pressed|pressing|gone|could|can|where|"
    r"deeper|harder|them|wise|along|"
    r"further|more|expressed|before|until|till|bottoming|bottom|bottoms|hit|hits|hitting|end|"
    r"stop|room|sunk|sinks|sink)"
)
_QUANTITIES = {
    "length": r"(?:depth|indentation|dent|penetration|imprint|press|travel|deep)",
    "force": r"(?:force|grip|squeeze|grip force|clamp|pressure)",
    "fraction": r"(?:area|patch|footprint|coverage)",
}
_AS_PART = re.compile(rf"\b{PARTS}\b|\bhow (?:far along|full|much of)\b")
_HALF = re.compile(
    r"(?P<one>lower|upper|first|second|bottom|top|left|right) (?:half )?or (?:in |is it |are we )?"
    r"(?:the )?(?P<two>lower|upper|first|second|bottom|top)(?: half| one)?"
)
_UPPER = ("upper", "second", "top")


def on_scale(asked: AskedWords) -> Term | None:
    """What is used, or left, of a scale that the question states."""
    for whole, rest in _scales(asked):
        used = _used(asked, whole, rest)
        pair = alike(used, whole) if used else None
        if pair is None or not pair[0].has_quantity:
            continue
        is_left = re.search(rf"\b{_FREE}\b", rest) is not None or asked.is_more
        is_left = is_left or re.search(r"\b(?:further|more)\b", rest) is not None
        is_part = asked.unit == "%" or (not asked.unit and _AS_PART.search(rest) is not None)
        if not is_left and not is_part:
            continue
        a, b = pair
        if not is_part:
            expression = f"{b.expression} - {a.factor}"
            return Term(expression=expression, dimension=b.dimension, words="", is_sum=True)
        if asked.is_ratio or (not asked.unit and re.search(r"\bfraction\b", rest)):
            share = f"{a.factor} / {b.divisor}"
            expression = f"1 - {share}" if is_left else share
            return Term(expression=expression, dimension=PLAIN, words="", is_sum=is_left)
        share = f"100 * {a.factor} / {b.divisor}"
        expression = f"100 - {share}" if is_left else share
        return Term(expression=expression, dimension="fraction", words="", is_sum=is_left)
    return None


def half_of_scale(asked: AskedWords) -> tuple[str, str, str] | None:
    """Whether a quantity is in the lower or the upper half of a stated scale.

    Returns:
        The word of the upper half, its condition, and the word of the lower one.
    """
    for whole, rest in _scales(asked):
        if (found := _HALF.search(rest)) is None:
            continue
        one, two = found["one"], found["two"]
        if (one in _UPPER) == (two in _UPPER):
            return None
        rest = f"{rest[: found.start()]} {rest[found.end() :]}"
        used = _used(asked, whole, rest, also=r"|half|halfway|which")
        pair = alike(used, whole) if used else None
        if pair is None:
            continue
        upper, lower = (one, two) if one in _UPPER else (two, one)
        return upper, f"{pair[0].factor} > 0.5 * {pair[1].factor}", lower
    return None


def _scales(asked: AskedWords) -> Iterator[tuple[Term, str]]:
    """Every scale that the words state, with the words that remain."""
    for pattern in _STATED:
        for found in pattern.finditer(asked.words):
            for end in _ends(asked.words, found):
                whole = asked.term(
                    re.sub(r" (?:deep|in)$", "", asked.words[found.start("w") : end])
                )
                if whole is None or not usual_unit(whole.dimension) or whole.dimension == "mass":
                    continue
                rest = f"{asked.words[: found.start()]} {asked.words[max(end, found.end()) :]}"
                if "#" not in rest:
                    yield whole, " ".join(rest.split())


def _ends(words: str, found: re.Match[str]) -> Iterator[int]:
    """Where a scale may end: 'zero to the never-exceed force' ends with any of its last words."""
    yield found.end("w")
    if not re.search(r"\bto the \w+$", found["w"]):
        return
    for more in list(re.finditer(r" |$", words[found.end("w") + 1 :]))[:4]:
        yield found.end("w") + 1 + more.start()


def _used(asked: AskedWords, whole: Term, rest: str, also: str = "") -> Term | None:
    """What is measured against a scale; None where the words say something else."""
    names = _QUANTITIES.get(whole.dimension, "")
    words = rf"(?:{_ASKING}|{_USED}|{_FREE}|{PARTS}|percent|{names}|(?:{UNIT}){also})"
    if not names or not is_made_of(rest, words):
        return None
    force = usual(whole.dimension)
    return asked.term(force.expression.partition("_")[0]) or force
