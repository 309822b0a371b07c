"""Everything that an instruction says, read once: numbers, manner, and a reason to refuse it."""

from __future__ import annotations

import re
from dataclasses import dataclass, replace

from policies.instructions.english import words
from policies.instructions.english.denials import without_interposed
from policies.instructions.english.spelling import spelled
from policies.instructions.english.text import plain, sentences
from policies.instructions.manner import Manner, has_manner, read_manner
from policies.instructions.other_forces import SaidNeed, in_place_of, need_of, without_other_forces
from policies.instructions.own_work import without_own_work
from policies.instructions.quantities import Quantities, read_quantities
from policies.instructions.quantities.bounds import with_bounds_at_forces
from policies.instructions.quantities.numerals import in_digits
from policies.instructions.refusal import refusal_of
from policies.instructions.statements import condition_of, without_statements
from policies.instructions.unproved_least import needs_of_others, unproved_least
from policies.instructions.unread_bounds import unread_bound


@dataclass(frozen=True, slots=True, kw_only=True)
class Request:
    """What an instruction says.

    Attributes:
        text: The instruction, without spaces around it.
        numbers: Its quantities.
        manner: Its manner.
        verb, thing: What is asked for, in words ('hold', 'berry').
        in_place: Kinds of an object to hold and of one not to hold ('tomato', 'berry'); '' without.
        need: What it says that an object needs, where that may be a wish; None where it says none.
        refused: Reason not to carry it out; '' without one.
    """

    text: str
    numbers: Quantities
    manner: Manner
    verb: str
    thing: str
    in_place: tuple[str, str]
    need: SaidNeed | None
    refused: str


NOT_ENGLISH = "it is not in English; say it plainly, for example 'Pick the strawberry gently'"
MAX_CHARACTERS = 1000
"""Longest instruction. Our choice: longer ones are pasted by mistake, and take seconds to read."""

_QUESTION, _REQUEST = (re.compile(words.any_of(name)) for name in ("question", "request"))
_MUST_BE = re.compile(
    r"^(?:so |and |but )*(?:(?:it|that|this|they|the \w+(?: \w+)?) )?(?:must|should|shall|needs?(?: to)?|has(?: got)?(?: to)?|have(?: to)?|ought(?: to)?|supposed to) be (?:\w+ )?#"
)
"""'Must be 2 N?' asks for no action, in spite of its verb."""
_ENGLISH, _FOREIGN = words.word_list("english"), words.word_list("foreign")
_FOREIGN_MANNER = words.word_list("foreign_manner")
_OFF = re.compile(rf"\b{words.any_of('off_domain')}\b")
_OURS = re.compile(
    r"\b(?:straw ?berr(?:y|ies)|berr(?:y|ies)|fruits?|grips?|grasps?|squeeze|fingers|gripper|compression|clamping|pinch(?:ing)?)\b"
)
_THING = re.compile(
    r"\b(straw ?berr(?:y|ies)|berr(?:y|ies)|fruit|tomato|egg|peg|object|thing|sample|specimen|one)\b"
)
_A_LITTLE = re.compile(r"\b(?:just )?a touch\b(?! on\b)")
_LIKE = re.compile(r"\b(?:like|as if|as though)\b[^,.;]*")
_VERB_OBJECT = re.compile(
    rf"\b{words.any_of('hold')}(?: (?:up|on|onto|hold|of|to|over|out|me|us|down|firm\w*|tight\w*|gent\w*|soft\w*|light\w*|and|or|\w+ing))*"
    rf"(?: (?:{words.any_of('fruit')}|the|#|my|your|our|\w+'s)\b| (?:a|an|another|some) (?:\w+ )?(?:straw ?berr(?:y|ies)|berr(?:y|ies)|fruit|one|specimen|sample|object|grip|grasp|hold)\b|(?=[.,;:!]|$| please| now| then| already| go| with| again| and))|"
    r"\b(?:up with|let us|let me) (?:it|the|that|this|see)|\bgo (?:ahead|on|for it|get)\b|\bdo (?:it|that|this|the|your|a)\b(?! \w+ (?:dance|flip|dishes|laundry))|\bhave (?:it|at it|a go)\b|\b(?:want|need|like) (?:the|that|this|my|a) (?:\w+ )?(?:straw)?berry (?:in|between|held|picked|lifted|up|out|off|gripped|grasped)\b|\bgive it\b|\bproceed\b|\bstart\b|\bcommence\b|\bgo\b(?=[.!]*$)"
)
_KEEP = re.compile(r"\b(?:not|never)(?: \w+){0,2} (?:let|releas\w*|drop|los\w*|stop)\b")
_TURN = re.compile(
    r";|,? (?:so|but|and) (?:today|now|this time|please|use|try|make|set|let us|(?:just |you can )?go (?:ahead|on)|we hold|we use|here|then)\b|,? (?:so|but|and) (?:just )?"
    + words.any_of("hold")
    + r"\b|\btoday\b|\bthis time\b"
)
"""Where a report ends and a request begins."""
_SO = re.compile(r",? (?:so|therefore|hence),? ")
"""Before what is asked for, behind its reason: 'it is for a birthday cake, so be gentle'."""
_REPORT = re.compile(
    r"^(?:yesterday|last (?:week|time|night|year)|earlier|once|the other (?:robot|day)|another robot|my colleague|he|she|they|i|we|someone)\b"
    r"(?: (?!would|want|need|like)\w+){0,4} (?:held|picked|was|were|did|used|took|grabbed|gripped|squeezed|lifted|had)\b"
)
_ABOUT_GRIP = re.compile(
    rf"\b{words.any_of('hold')}\b|\b{words.any_of('grip_noun')}\b|\b(?:it|its|this|that|these|those|them|one|ones|you|your|be|go|easy|hand|hands|fingers|muscle|strength|ease|easing|gloves|coddle|pamper|bear|baby|delica\w+|tender\w*|thing|lay|let|dial|crank|relax|loosen|slacken|tone|slip\w*|bruis\w*|squash\w*|crush\w*|fragile|care|careful\w*|usual|normal|last|tight\w*|loose\w*|gent\w+|soft\w*|firm\w*|hard\w*|light\w*)\b(?! (?:peaks|music))"
)
_BERRY_VERB = re.compile(
    r"(?:please |robot,? |hey,? |now |just |kindly |can you |could you |would you |go |yo |bro |ok(?:ay)?,? |and |so )*"
    r"(?!describe|explain|photograph|film|paint|draw|weigh|count|rate|name|look|watch|smell|taste|wash|cook|sell|buy|see|is|are|was|has|do|does|did|the|a|i|we|strawberr|about|of|forget|avoid|ignore|rinse|inspect|sketch|order|love|like|hate|want)"
    r"[a-z-]+(?: up| out| off| down| me| over)?(?: one more| another| the| that| this| my| our)+ (?:\w+ ){0,2}(?:straw ?berry|berry\w*|fruit|grasp|grip|pick|lift|one)\b"
)
_STARTS = re.compile(
    rf"(?:please |robot,? |hey,? |now |just |kindly |can you |could you |would you |go |ok(?:ay)?,? |and |so )*{words.any_of('hold')}"
    r"(?: (?!an? |my |your |me |care|place|part|time|turns|notes?|note|on\b)\w+|\b.*\b(?:straw)?berry\b)"
)
_THIS_WHILE = re.compile(
    rf"(?:please |can you |could you |would you |now |just )*{words.any_of('hold')}(?: up| on| on to)? (?:(?:the|that|this) (?:\w+ )?one\b|(?:it|this|that|these|one)\b(?= while| for me| and| so| until|,|$))"
)
_USUAL_GRIP = re.compile(
    r"\b(?:no|without(?: any)?|nothing) (?:special|fancy|extra|particular)(?: (?:treatment|handling|care|grip|attention|measures?|instructions?|wishes|requests?|requirements?))?(?=[.,;:!]| (?:for|with|about|here|needed|required|please|today|this time)\b|$)|"
    r"\bwhatever (?:force|grip|squeeze|pressure)? ?(?:you think )?(?:is |seems )?(?:right|best|needed|necessary|fit|appropriate)\b|"
    r"\b(?:standard|usual|normal|regular|default|same|ordinary|medium|moderate|average|everyday|nominal|baseline|typical|customary) (?:old |amount of |level of )?"
    r"(?:grip|grasp|hold|force|pick|strength|pressure|squeeze)\b|"
    r"\b(?:just|simply|only) (?:normal|ordinary|regular|usual)(?:ly)?\b|"
    r"^(?:please |just |do )*(?:the |it )?same(?: (?:procedure|way|thing|force|grip))? as (?:usual|before|last time|always)\b|"
    r"^(?:please |just |do )*(?:it |business )?(?:as|like) (?:usual|normal|always|before|last time|ever)\b|"
    rf"{words.any_of('neither')}|"
    r"\bas (?:hard|firm|tight|strong|soft|gent|light|careful|delicate)\w* as (?:usual|normal|before|last time|always|needed|necessary|required|it takes|you did)\b"
)
_RECIPE = (
    r"(?:recipes?|profiles?|settings?|procedures?|routines?|protocols?|program(?:me)?s?|modes?|parameters|presets?|config\w*|approach|methods?|treatment|handling|values?|"
    r"(?:grip|grasp|force|squeeze|pressure|handling|gripping|picking|clamping)(?:ping)? (?:recipe|profile|setting|procedure|routine|protocol|program(?:me)?|mode|preset|curve|schedule|level|value|parameter)s?)"
)
_RECIPE_ASKED = re.compile(
    rf"^(?:(?:ok(?:ay)?|so|please|just|robot|right|again|for this one|for this|use|run|apply|stick (?:to|with)|keep (?:to|with)|go with|go back to|back to|follow|with|on|it is|same|your|the|our|my|a|good old|plain|old|execute|do)[ ,]*)*"
    rf"(?:standard|usual|normal|regular|default|same|ordinary|nominal|baseline|stock|factory|typical|customary|established|unchanged|current|existing|everyday)(?: old| same)? {_RECIPE}"
    r"(?=\s*(?:$|[.,;:!–—-])| (?:please|here|is|are|will|would|works|does|should|suits|for (?:this|that|the|it|me|now|today)|no|again|today|as|on|with|and|thanks|i|this)\b)"
)
"""'Standard recipe, no changes': recipes of cooks are asked for in other words."""
_UNCHANGED = re.compile(
    r"\b(?:no|without(?: any)?|zero) (?:changes?|modifications?|adjustments?|deviations?|tweaks?|alterations?)\b(?! of (?:mind|plan))|\b(?:change|alter|adjust|modify|tweak) nothing\b|"
    r"\b(?:do not|never|no need to|without) (?:chang|alter|adjust|modify|tweak|touch)(?:e|ing)? (?:a thing|anything|any (?:of the )?(?:settings?|parameters?)|the (?:grip|force|settings?|recipe|squeeze|parameters?|way))\b(?! (?:else|but|other))|"
    r"\bas you were(?=[.,;!]*(?:$| ))|^(?:as|like)(?: per)? (?:usual|always|normal|ever|before)\b|^same again\b|^(?:the )?usual(?=\s*(?:$|[.,;!]| please| for))|^(?:business|same) as (?:usual|always|ever|before)\b|\bsame (?:drill|deal|story|again)(?: as (?:ever|always|usual|before))?(?=\s*(?:$|[.,;!]| please| for))|"
    r"(?:^|[,;:–-] ?|\b(?:and|but|then) )(?:it is |do it |just |exactly |much )*(?:the )?same(?: (?:procedure|way|thing|force|grip))? as (?:usual|before|last time|always|ever|the (?:last|previous|others?|rest))\b"
)
_NEXT = re.compile(
    r"^(?:(?:right|ok(?:ay)?|now|and|so|then|good|great|well|please|robot|hey|on to|onto|bring on|let us have|ready for|time for|the|that is the) ?,? )*(?:next(?: up)?|another|one more|same again|and again|once more|again)(?: (?:the|big|small|red|ripe|little|good|straw|berry|strawberry|fruit|one|please|up|now|time|in line|in the row|in the (?:tray|punnet|box|queue))){0,4}(?=\s*(?:$|[,;:!–—-]))"
)
"""'Next one, ...'."""
_WANTED = re.compile(
    r"^(?:(?:please|robot|robo|hey|hi|hello|ok(?:ay)?|so|yo|now)[ ,]*)*"
    r"(?:(?:i (?:would|will) (?:like|love|take)(?: to (?:have|get))?|i (?:want|need)(?: to have)?|(?:can|could|may|might) (?:i|we) (?:please )?(?:have|get)|(?:give|hand|pass) (?:me|us)|let (?:me|us) have)"
    r"(?: please)? (?:(?:the|that|this|a|one|another|my|some)(?: \w+){0,2}? (?:straw ?berr(?:y|ies)|berr(?:y|ies)|fruit|one)\b|(?:straw ?berr(?:y|ies)|berr(?:y|ies))(?=\s*(?:$|[.,;:!])))|"
    r"(?:initiate|start|begin|run|execute|perform|trigger)(?: the| a| your)? (?:pick\w*|grasp\w*|grip\w*|lift\w*)(?:[- ]up)? (?:sequence|cycle|routine|procedure|motion|run)\b)"
)
"""'I would like to have this fruit', 'initiate pick sequence'."""
_SHORT = re.compile(
    r"^(?=.*(?:berry|fruit|usual|standard|default|next|again|another|one more))(?:(?:the|that|this|a|one|my|our|red|ripe|next|straw|berry|strawberry|fruit|please|if you please|if you would|kindly|up|now|ok|okay|alright|right|good|yo|hey|robot|go|and|then|usual|normal|standard|default|same|again|another|once|more|pick-?up|pick|grasp|lift)\b[ ,!.]*)+$"
)


def read_request(text: str) -> Request:
    """Read an instruction as a person wrote it."""
    clean = with_bounds_at_forces(
        in_digits(spelled(without_interposed(plain(text[:MAX_CHARACTERS]))))
    )
    clean = without_other_forces(clean)
    clean, numbers, stated = _meant(clean)
    verb = words.HOLD.search(_A_LITTLE.sub("", numbers.rest))
    thing = _THING.search(_LIKE.sub(" ", numbers.rest))
    return Request(
        text=text.strip(),
        numbers=numbers,
        manner=read_manner(numbers.rest),
        verb=verb.group() if verb else "hold",
        thing=thing.group(1) if thing else "",
        in_place=in_place_of(numbers.rest),
        need=need_of(clean) if numbers.forces else None,
        refused=_refusal(text, clean, numbers) or stated or unread_bound(numbers),
    )


def _meant(clean: str) -> tuple[str, Quantities, str]:
    """The text and its quantities without forces that are only stated; why to refuse it, or ''."""
    numbers = read_quantities(clean)
    is_wish = any(force.kind != "most" for force in numbers.forces)
    is_told = any(force.is_told for force in numbers.forces)
    if is_told or (not is_wish and numbers.delta_n is None):
        return clean, numbers, ""
    statements = without_statements(clean)
    if not statements.words:
        return clean, numbers, ""
    rest = read_quantities(statements.rest)
    is_changed = (rest.delta_n is not None and numbers.delta_n is None) or (
        rest.factor is not None and numbers.factor is None
    )
    if is_changed or (numbers.is_worked_out and (rest.forces != numbers.forces or numbers.unread)):
        return clean, numbers, ""  # 'take 2 N, subtract 0.5 N': one clause changes another's force
    is_left = rest.forces or rest.delta_n is not None
    if statements.is_elsewhere:
        return statements.rest, rest, ""
    if is_left and statements.rest != clean:
        left = {(force.kind, force.value_n) for force in rest.forces}
        stated = [force for force in numbers.forces if (force.kind, force.value_n) not in left]
        wished_n = max((force.value_n for force in rest.forces), default=0.0)
        if lower := [each for each in stated if each.kind == "most" and each.value_n < wished_n]:
            return clean, numbers, f"{lower[0].words!r} is below {wished_n:.3g} N; say which counts"
        return statements.rest, replace(rest, stated=(*rest.stated, *stated)), ""
    return clean, numbers, f"{statements.words!r} asks for no force; say 'use ...' or 'at most ...'"


def _refusal(text: str, clean: str, numbers: Quantities) -> str:
    """Reason not to carry a text out, of which ``clean`` is the plain form; '' without one."""
    if len(text) > MAX_CHARACTERS:
        return f"it is longer than {MAX_CHARACTERS} characters; shorten it"
    if not re.search(r"[^\W_]", clean):
        return "there are no words; say what to grasp, for example 'Pick the strawberry gently'"
    reason = refusal_of(numbers.rest, clean) or _no_english(clean) or _nothing_asked(numbers)
    return reason or _unproved(clean, numbers) or _conditional(clean)


def _conditional(clean: str) -> str:
    """Reason to refuse a request under a condition that can't be looked at; '' for none."""
    words = condition_of(clean)
    return (
        f"{words!r} is a condition that a gripper can't check; say it once it is met"
        if words
        else ""
    )


_TAKE_IT = re.compile(
    r"[,.;] (?:\w+ ){0,2}?(?:pick|take|lift|grab|hold|grip|get|fetch|handle) (?:it|this|that)\b(?! (?:one|straw|berr|fruit))"
)
"""'The pear needs 1.8 N, pick it up': it is the pear."""


def _unproved(clean: str, numbers: Quantities) -> str:
    """Reason to refuse a force that may be no wish; '' for none."""
    if numbers.forces and not _TAKE_IT.search(clean) and (words := needs_of_others(clean)):
        return f"{words!r} says what something else takes; say 'use ...' for this grip"
    kinds = {force.kind for force in numbers.forces if not force.is_told}
    if kinds == {"least"} and (words := unproved_least(clean)):
        return f"{words!r} may be a wish or a warning; say 'hold it with at least ...' or 'at most ...'"
    return ""


def _no_english(text: str) -> str:
    letters = [c for c in text if c.isalpha()]
    if letters and sum(ord(c) > 0x24F and c not in "µμ" for c in letters) > 0.3 * len(letters):
        return NOT_ENGLISH
    tokens = [t for t in re.findall(r"[^\W\d_]+", text) if len(t) > 1]
    foreign = sum(t in _FOREIGN for t in tokens)
    known = sum(t in _ENGLISH or bool(words.HOLD.fullmatch(t)) for t in tokens)
    if (foreign and foreign >= known) or _FOREIGN_MANNER.intersection(tokens):
        return NOT_ENGLISH
    return ""


def _nothing_asked(numbers: Quantities) -> str:
    """Reason to refuse a text that asks for no grasp; '' where something is asked for."""
    if (
        numbers.forces
        or numbers.delta_n is not None
        or numbers.factor is not None
        or numbers.pressure
        or numbers.unitless
        or numbers.unread
        or numbers.percentage
        or numbers.denied
        or numbers.slip_mm is not None
    ):
        parts = sentences(numbers.rest)
        is_asked = any(
            not _is_question(s, asks) and not _REPORT.search(_TURN.split(s)[-1].strip())
            for s, asks in parts
        )
        return "" if is_asked else "no request to hold anything was understood"
    asked = [s for s, asks in sentences(numbers.rest) if not _is_question(s, asks)]
    if not asked:
        return "it is a question, no request to hold anything"
    if numbers.masses.is_told:
        return ""
    asked += [tail for s in asked if (tail := _SO.split(s)[-1]) != s]
    asked += [tail for s in asked if (tail := s.rpartition(";")[2]) != s and _asks_manner(tail)]
    for sentence in map(without_own_work, asked):
        if _KEEP.search(sentence) or _THIS_WHILE.match(sentence):
            return ""
        if any(p.search(sentence) for p in (_USUAL_GRIP, _RECIPE_ASKED, _UNCHANGED)):
            return ""
        is_off = _OFF.search(sentence) and not _OURS.search(sentence) and not _grips(sentence)
        starts_off = re.match(
            rf"^(?:please |robot,? |hey,? |now |just |go |can you |could you )*\b{words.any_of('off_domain')}\b",
            sentence,
        )
        if is_off or starts_off or _REPORT.search(_TURN.split(sentence)[-1].strip()):
            continue
        if (
            _asks_manner(sentence)
            or _STARTS.match(sentence)
            or _BERRY_VERB.match(sentence)
            or _VERB_OBJECT.search(sentence)
            or _SHORT.match(sentence)
            or _NEXT.match(sentence)
            or _WANTED.match(sentence)
        ):
            return ""
    return "no request to hold anything was understood"


def _grips(sentence: str) -> bool:
    """Whether a sentence says how to grip, and speaks of gripping."""
    is_first = has_manner(" ".join(sentence.split()[:2]))
    return has_manner(sentence) and (is_first or bool(words.HOLD.search(sentence)))


def _asks_manner(sentence: str) -> bool:
    """Whether a sentence says how to grip, and nothing else is its object."""
    if not read_manner(sentence).words:
        return False
    if has_manner(sentence):
        return True
    is_short = len(re.findall(r"[a-z']+", sentence)) <= 5 and not re.search(
        r" (?:the|my|a) ", sentence
    )
    return is_short or bool(_ABOUT_GRIP.search(sentence))


def _is_question(sentence: str, asks: bool) -> bool:
    """Whether a sentence asks for knowledge, not for an action."""
    if _REQUEST.match(sentence):
        return False
    if asks and _MUST_BE.match(sentence):
        return True
    return bool(_QUESTION.match(sentence)) and (asks or not re.search(r"[,;:]", sentence))
