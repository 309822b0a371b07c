"""Questions about what would be if a quantity were another one.

    If the force dropped by 20 %, what would remain?        0.8 * force_n
    Suppose you pushed 1 N harder: above the band?          force_n + 1 > band_high_n
    If the limit were halved, would the force violate it?   force_n > 0.5 * limit_n
    Could I double the force without going over the limit?  2 * force_n <= limit_n

Not here: questions about what is (``tacgrasp.lessons.dialogue.calculations.amounts``,
``tacgrasp.lessons.dialogue.calculations.checks``).
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace

from tacgrasp.lessons.dialogue.calculations.amounts import amount_of, calculated_amount
from tacgrasp.lessons.dialogue.calculations.asked import AskedWords
from tacgrasp.lessons.dialogue.calculations.changes import changed
from tacgrasp.lessons.dialogue.calculations.checks import calculated_check, condition_of
from tacgrasp.lessons.dialogue.calculations.loads import load_amount, stays, sure_to_hold
from tacgrasp.lessons.dialogue.calculations.phrases import is_made_of
from tacgrasp.lessons.dialogue.calculations.quantity_names import UNIT
from tacgrasp.lessons.dialogue.calculations.terms import Term
from tacgrasp.lessons.dialogue.expression import Expression
from tacgrasp.lessons.dialogue.meaning import Calculated
from tacgrasp.lessons.dialogue.scene import NAMES

_SUPPOSED = re.compile(
    r"(?:(?:what )?(?:if|suppose|supposing|imagine|assume|assuming|say|were|should|had|"
    r"with|after|once|when|let us say|picture|pretend|given|at|by)(?: that)? )?(?P<all>.+)"
)
_QUESTION = re.compile(
    r" (?:(?:then|so|now|and) )*(?:(?:tell|give|show) (?:me|us) )?(?=(?:what|how|would|will|could|"
    r"can|is|are|am|does|do|which|by how|in|still|(?:the )?(?:new|resulting|final|total|sure)|"
    r"result|the (?:sum|result|difference|answer|outcome|reading|figure)|where|that is|gives|"
    r"giving|force|depth|over|under|above|below|percent|percentage|"
    r"safe|max|maximum|heaviest|(?:we|i|it|you|that) (?:would|will))\b)"
)
_CONDITION = re.compile(
    r" (?:if|suppose|supposing|provided|assuming|once|when|after|with|at|were)(?: that)? (?=.)|"
    r" by (?=\w+ing\b)"
)
_IMPERATIVE = re.compile(
    r"(?:(?:now|please|let us|let me) )*(?P<change>(?:multiply|divide|halve|double|triple|treble|"
    r"quadruple|add|cut|"
    r"take|raise|increase|lower|reduce|drop|knock|shave|trim|back off|ease off|put|boost|turn up|"
    r"turn down|loosen|tighten|(?:crank|turn|dial|step|push|bring|ease) (?:it|the \w+) (?:up|down|"
    r"off)) .+)"
)
_BEGINS = re.compile(
    r"(?:what )?(?:if|suppose|supposing|imagine|assume|assuming|say|were|with|after|once|"
    r"multiply|divide|halve|double|triple|treble|quadruple|add|cut|raise|increase|lower|reduce|"
    r"knock|shave|(?:crank|turn|dial|step|push|bring|ease) (?:it|the \w+) (?:up|down|off))\b",
    re.I,
)
_FORCE = r"(?:force|grip|squeeze|pressure|indentation)"
_EXTRA = re.compile(
    rf"(?:would|will|does|do|is|could|might|can|should) (?P<change>"
    rf"(?:(?:adding|putting on|applying|another|an? extra|a further|an additional|extra) )*"
    rf"#\d+ (?:{UNIT})(?: of {_FORCE})?"
    r"(?: (?:more|extra|less|fewer|further|harder|softer|on top|added|off))*"
    rf"(?: (?:of )?(?:the )?(?:present |current )?{_FORCE})?) (?P<rest>.+)"
)
_DOING = re.compile(
    r"(?:would|will|does|could|might|can) (?P<all>(?:\w+ing|twice|double|half|an?|another) .+)"
)
_HOLDING_MORE = re.compile(
    rf"(?P<rest>(?:is|are|would|will|does|do|can|could) (?:.+ )?(?:hold|carry|lift|support|bear|"
    rf"keep|handle|manage|enough (?:for|to (?:hold|carry|lift))))(?: it)? (?P<change>"
    rf"(?:plus|another|an? (?:extra|additional|further)|half|twice|double|two|thrice|triple|three|"
    rf"four|quadruple|(?:an? )?#\d+ (?:times|x|fold|of (?:these|them|those)|"
    rf"(?:{UNIT}) (?:more|extra)))\b.*)"
)
"""'Would it hold twice the mass?', 'does it hold another 20 g?'."""

_SO_DONE = re.compile(
    r" (?=(?:be|put|bring|take|push|get|send|land|carry|leave|keep|make|break|exceed|violate|"
    r"breach|reach|bust|cross|overshoot|still|go|blow|lift|tip|run|suffice|drop|knock|pull|set|"
    r"move|lower|raise|throw|fall)\b)"
)
_WITHOUT = re.compile(
    r"(?:(?:with|given) the \w+(?: \w+){0,4}? (?=can|could|may))?(?:can|could|may|might|should|do|"
    r"would|is|am|are)(?: (?:it|be|safe|ok|okay|fine|possible|"
    r"for|me|us|to|allowed|there|room|have))* ?(?:(?:i|we|you|it|the (?:robot|gripper)) )?"
    r"(?:(?:still|safely|be able to|get away with|afford to|to|allowed to|then) )*(?P<change>.+?) "
    r"(?:(?P<without>without|and (?:still )?not)|(?:and|while|yet) (?:(?:still|yet) )?"
    r"(?P<while>be|stay|staying|remain|remaining|keep|keeping|being|end up|land)) (?P<rest>.+)"
)
_GERUNDS = {
    "doubling": "double", "halving": "halve", "tripling": "triple", "adding": "add",
    "raising": "raise", "increasing": "increase", "lowering": "lower", "reducing": "reduce",
    "easing": "ease", "backing": "back", "pressing": "press", "squeezing": "squeeze",
    "tightening": "tighten", "loosening": "loosen", "cutting": "cut", "dropping": "drop",
    "going": "go", "pushing": "push", "gripping": "grip", "putting": "put", "applying": "apply",
    "taking": "take", "letting": "let", "giving": "give", "turning": "turn", "knocking": "knock",
    "shaving": "shave", "trimming": "trim", "relaxing": "relax", "slackening": "slacken",
}  # fmt: skip
_SUBJECT = re.compile(
    r"(?:what|how (?:much|deep|large|big|strong|high)) (?:would|will|is) (.+?) "
    r"(?:be|become|come to|amount to)\b"
)
"""What a pronoun before or behind stands for: 'what would the force be if it rose'."""

_EXCEEDED = re.compile(
    r"(?:would|will|is|has|does|could|might) (?:the |our )?(?P<bound>limit|ceiling|maximum) "
    r"(?:(?:be|been|get|being) )*(?:breached|exceeded|violated|passed|broken|overshot|crossed|"
    r"surpassed|overstepped)"
)
"""'Would the limit be breached', which asks whether it would exceed the limit."""

_MAKES = re.compile(r"(?<=^would it) (?:make|let) (?:it|us|the \w+)(?= )")
_OVER_IT = re.compile(
    r"((?:is|are|would|will) (?:it|we|you|i|this|that)(?: be)?(?: still)? (?:over|above|past|"
    r"beyond|under|below|within))"
)

_HAVING = re.compile(
    r"^(?:(?:we|i|you|it) )?(?:(?:had|have|got) )?(?=#\d+ \w+ (?:more|less|extra)$)"
)
_THEN = re.compile(r"^(?:(?:then|so|and|now) )+| (?:then|afterwards|after that)$")
_MEASURED = {"deep": "length", "heavy": "mass", "strong": "force", "hard": "force"}
_HOW = re.compile(rf"how ({'|'.join(_MEASURED)})\b")
_NOUN = re.compile(r"\b(?:force|depth|mass|weight|area|limit)\b")
_RESULT = re.compile(
    r"(?:what|how (?:much|deep|heavy|large|big|strong|hard))(?: "
    r"(?:force|depth|mass|weight|area|limit))? (?:would|will|is|are|does|"
    r"do)(?: (?:that|it|we|you|i|there|each(?: of them)?|"
    r"the (?:new|total|resulting|whole|combined) \w+|the (?:force|depth|mass|weight|area|limit)|"
    r"the|remain|be|left|have|result|become|read|show|get|make|come|to|amount|still|then|apply|"
    r"feel|carry|hold|take|weigh|in total|all told|altogether))*|(?:what|how much) (?:remains|"
    r"is left|results)|"
    r"(?:what|how many|how much|which)(?: (?:percent|percentage|share))? of (?:the )?pad "
    r"(?:would|will|does) (?:it|that) (?:cover|touch)"
)
_RESULTING = (
    r"(?:what|how|much|many|would|will|is|are|am|be|does|do|it|that|this|the|a|an|my|our|new|"
    r"resulting|total|final|combined|overall|force|grip|squeeze|reading|readings|read|reads|show|"
    r"shows|result|results|i|we|you|get|gets|have|has|left|remain|remains|remaining|become|"
    r"becomes|come|comes|to|out|at|then|now|still|end|up|with|leave|leaves|me|us|figure|value|tell|"
    r"give|gives|giving|say|and|amount|amounts|sensor|gauge|display|dial|feel|feels|press|pressing|"
    r"gripping|squeezing|exert|exerting|hard|make|makes|sit|sits|stand|stands|land|lands|on|pad|"
    r"there|number|apply|applying|which|object|where|gripper|fingers|tightly|strong|"
    r"sum|answer|outcome|going|happens|happen|weigh|weighs|difference|"
    r"depth|deep|indentation|dent|so|under|mean|in|clamping|after|afterwards|altogether|all|told)"
)
"""Words that may ask for a changed force or depth itself."""

_OF_FORCE = re.compile(r"\b(?:force|grip|squeeze|hard|pressing|squeezing|gripping|strong)\b")
_OF_DEPTH = re.compile(r"\b(?:depth|deep|indentation|dent)\b")


_ANOTHER_MASS = re.compile(
    rf"(?:(?:[a-z]+ing|for|with|take|say|suppose|imagine|assume|next|now|then|of|make it|"
    rf"consider) )*"
    rf"(?:(?:an?|the|one|some|my|this|that) )?(?P<mass>#\d+ (?:{UNIT}))(?: (?:of )?(?!(?:more|less|"
    r"extra|is|are|or|and|on|off|of)\b)[a-z]+){0,3}?(?: (?:instead|next|now|then|up))* "
    r"(?P<rest>(?:what|how|is|are|would|will|could|can|does|do) .+)"
)
_SAFE = re.compile(
    r"(?:is|would|will) (?:it|that|this|(?:the|a) (?:lift|grip))(?: (?:still|then|now))? (?:be )?"
    r"(?:safe|ok|okay|fine)(?: to (?:lift|pick up|raise|hoist)(?: it)?)?\b"
)
"""'Would it be safe to lift?', which the band tells."""


def supposed(asked: AskedWords) -> Calculated | None:
    """What a question asks about a changed quantity; None where it changes none."""
    asked = replace(asked, words=_SAFE.sub("is the force in the band", asked.words))
    if kept := _kept(asked):
        return kept
    for change, rest in _clauses(asked.words):
        named = _SUBJECT.match(rest)
        subject = asked.term(named[1]) if named else None
        before = asked if subject is None else asked.about(subject, change)
        if (told := changed(before, change)) is None:
            continue
        base = _base(asked, told)
        rest = _EXCEEDED.sub(r"would it exceed the \g<bound>", rest)
        if base == "limit_n" and _OVER_IT.fullmatch(rest):
            rest = f"{rest} the limit"
        after = asked.about(told, rest, base)
        rest = _THEN.sub("", rest)
        if not rest or _is_result(told, rest):
            noun = _NOUN.search(rest)
            about = asked.term(noun[0]) if noun else None
            is_other = about is not None and about.expression != base
            how = _HOW.match(rest)
            is_other = is_other or (how is not None and _MEASURED[how[1]] != told.dimension)
            return None if is_other else amount_of(told, after)
        found = stays(after) or calculated_check(after) or calculated_amount(after)
        found = found or calculated_check(asked.about(told, f"is it {rest}", base))
        found = found or sure_to_hold(after) or sure_to_hold(replace(after, words=f"is it {rest}"))
        found = found or load_amount(after)
        if found and told.expression in found.truth:
            return found
    return _of_another(asked)


def _of_another(asked: AskedWords) -> Calculated | None:
    """What a question asks about another mass, which it names first: 'a 60 g pear, then: ...'."""
    if (found := _ANOTHER_MASS.fullmatch(asked.words)) is None:
        return None
    mass = asked.term(found["mass"])
    if mass is None or mass.dimension != "mass":
        return None
    after = asked.about(mass, found["rest"])
    return sure_to_hold(after) or load_amount(after)


def begins_supposed(question: str) -> bool:
    """Whether a question begins with what it supposes: 'if it doubled', 'double it'."""
    return _BEGINS.match(question) is not None


def supposes(asked: AskedWords) -> bool:
    """Whether a question supposes a change of a quantity."""
    return any(changed(asked, change) for change, rest in _clauses(asked.words) if rest)


def _is_result(told: Term, rest: str) -> bool:
    """Whether words ask for what a changed quantity then is."""
    if _RESULT.fullmatch(rest.replace(told.words, "it") if told.words else rest):
        return True
    other = {"force": _OF_DEPTH, "length": _OF_FORCE}.get(told.dimension)
    return other is not None and is_made_of(rest, _RESULTING) and not other.search(rest)


def _base(asked: AskedWords, told: Term) -> str:
    """Name of the quantity that a supposition changes; '' where it is none of a scene."""
    named = asked.term(told.words) if told.words else None
    names = (named.expression,) if named else Expression(told.expression).names
    return names[0] if len(names) == 1 and names[0] in NAMES else ""


def _clauses(words: str) -> Iterator[tuple[str, str]]:
    """What a question supposes, and what it asks, in every way it may be divided so."""
    if found := _EXTRA.fullmatch(words):
        yield found["change"], _MAKES.sub("", f"would it {found['rest']}")
    if found := _HOLDING_MORE.fullmatch(words):
        is_count = re.match(r"#\d+ of", found["change"])
        yield f"{'holding ' if is_count else ''}{found['change']}", found["rest"]
    if found := _DOING.fullmatch(words):
        for joint in _SO_DONE.finditer(found["all"]):
            rest = _MAKES.sub("", f"would it{found['all'][joint.start() :]}")
            yield _done(found["all"][: joint.start()]), rest
    if found := _IMPERATIVE.fullmatch(words):
        done = f"i {found['change']}"
        yield done, ""
        for joint in _QUESTION.finditer(done):
            yield done[: joint.start()], done[joint.end() :]
    if found := _SUPPOSED.fullmatch(words):
        for joint in _QUESTION.finditer(found["all"]):
            yield _done(found["all"][: joint.start()]), found["all"][joint.end() :]
    for joint in _CONDITION.finditer(words):
        yield _done(words[joint.end() :]), words[: joint.start()]


def _done(change: str) -> str:
    """A change without its subject as one with it: 'doubling the force' is 'i double the force'."""
    change = _HAVING.sub("with ", change)
    verb, _, rest = change.removeprefix("by ").partition(" ")
    return f"i {_GERUNDS[verb]} {rest}" if verb in _GERUNDS else change


def _kept(asked: AskedWords) -> Calculated | None:
    """Whether a change keeps something: 'could I double it without going over the limit?'."""
    if (found := _WITHOUT.fullmatch(asked.words)) is None:
        return None
    change = _done(found["change"])
    told = changed(asked, change) or changed(asked, f"i {change}")
    if told is None:
        return None
    after, rest = asked.about(told, "", _base(asked, told)), found["rest"]
    if found["while"]:
        kept = condition_of(after, f"it be {rest}")
        return Calculated(truth=kept, unit=None) if kept else None
    broken = condition_of(after, f"it {rest}") or condition_of(after, f"it {rest} the limit")
    if broken is None:
        return None
    simple = re.fullmatch(r"([^<>]+) (>=?|<=?) ([^<>]+)", broken)
    if simple and not re.search(r" (?:and|or) ", broken):
        sign = {">": "<=", "<": ">=", ">=": "<", "<=": ">"}[simple[2]]
        return Calculated(truth=f"{simple[1]} {sign} {simple[3]}", unit=None)
    return Calculated(truth=f"not ({broken})", unit=None)
