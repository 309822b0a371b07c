"""Whether a mentioned primitive is asked for, or forbidden, supposed, past, questioned.

Works on the segments of a sentence: a negation reaches to the end of its own segment, and beyond it
as far as the grammar carries it ('do not move up or down'; 'you must not, ever, move down').
What can't be decided is not asked for: a made-up action is worse than holding still.
"""

from __future__ import annotations

from enum import StrEnum

from policies.extraction.clauses import NEGATORS, UNKNOWN, Sentence, word_set
from policies.extraction.mentions import Form, Mention

GOAL_LABELS = word_set(
    "said says operator "
    "goal task instruction instructions aim target objective prompt user question requirement "
    "example human previous previously history earlier"
)
"""What comes after 'goal:' is somebody's wish, not what is felt or advised."""


class Status(StrEnum):
    """What a mention amounts to."""

    ASKED = "asked for"
    NEGATED = "negated"
    SUPPOSED = "only supposed"
    PAST = "about the past"
    QUESTIONED = "a question"
    LATER = "before or after something else"
    DESCRIBED = "a description"


_NO_VERBS = word_set(
    "forget "
    "avoid avoiding avoids refrain refraining prevent prevents preventing stop stops stopping "
    "quit cease skip skipping against cancel abort forbid forbids forbidden prohibited prohibits "
    "prohibit instead_of unable impossible unnecessary needless pointless useless fail fails "
    "failed wrong dangerous harmful unwise bad mistake inadvisable refuse risky unsafe foolish "
    "premature inappropriate undesirable discouraged lest cannot disallowed banned "
    "counterproductive excluded ignore reject disregard unadvisable unhelpful rejected ignored "
    "omit forgo withhold resist beware false untrue overkill superfluous redundant incorrect no- "
    "one few unwarranted unneeded avoided oppose opposed decline"
)
_FIRST_ONLY = word_set("instead_of avoid avoiding without against skip stop prevent refrain")
_UNBOUND_NO = word_set(
    "need reason point cause use benefit sense further more action necessity way advantage call "
    "case longer justification grounds good idea one additional extra other request requirement "
    "excuse"
)
_UNDO = word_set("hesitate forget neglect delay")
_SUPPOSING = word_set(
    "if unless whenever suppose supposing assuming would could might may perhaps maybe possibly "
    "hypothetically whether otherwise depending asked told said says instruction instructions "
    "imagine wonder doubt meaning means called options choices possible available wish wished "
    "unclear unsure uncertain undecided example"
) | {UNKNOWN}
_ANYWHERE = word_set(
    "if unless whenever suppose supposing assuming depending lest hypothetically"
) | {UNKNOWN}
_PAST = word_set("was were had did previously previous earlier ago already yesterday")
_ASK_PASSIVE = word_set("be")
_NEEDED = word_set(
    "perform do execute suggest recommend request need needs needed require requires required "
    "necessary recommended advised apply applying use using exert give add adding wanted called "
    "call calls demands want wants demanded exerting advisable"
)
_FRAGMENT = word_set(
    "slightly a bit little please action now with use some much advice next next_action decision "
    "the answer recommendation"
)
_FELT = word_set(
    "contact object berry strawberry fruit egg tomato peg cherry item gel deepest patch slip load "
    "weight stem imprint centre center"
)
_LINKS = word_set(
    "should must to be needs need has have ought tends starts may begins continues about going "
    "likely is are will can shall it also then now seems appears threatens wants bit keeps could "
    "might would does did was were been"
)
_PLACE = word_set(
    "bottom top left right edge pad at the of on in side near corner upper lower middle its a "
    "point position area"
)
_COPULA = word_set(
    "is are was would must should does do will can be has have may could seems looks remains "
    "makes shall might : been feels"
)
_EMPTY = word_set(
    "ever even please now yet just at all to try slightly again here attempt dare think believe "
    "recommend"
)
_RESUME = word_set("but however therefore thus hence so")
_RESUME_WORDS = word_set("instead rather just simply only better")
_ASKING = word_set("should shall can could do does is are will would")
_PERSONS = word_set("i we you it the they this")


def status(sentence: Sentence, mention: Mention, earlier: tuple[Mention, ...]) -> Status:
    """What ``mention`` amounts to, with the mentions ``earlier`` in the same sentence."""
    index = sentence.segment_index(mention.start)
    segment = sentence.segments[index]
    left = sentence.words[segment.start : mention.start]
    if sentence.question or _asks(sentence.of(index), left):
        return Status.QUESTIONED
    if after_goal_label(sentence, mention.start):
        return Status.DESCRIBED
    if _negated(sentence, mention, index, left, earlier) or _refused_after(sentence, mention):
        return Status.NEGATED
    if _supposed(sentence, index, left):
        return Status.SUPPOSED
    if _is_past(mention, left):
        return Status.PAST
    if _later(sentence, mention, index, left, earlier):
        return Status.LATER
    return Status.DESCRIBED if _described(sentence, mention, left) else Status.ASKED


def after_goal_label(sentence: Sentence, word: int) -> bool:
    """Whether a label such as 'Goal:' stands before ``word`` in its sentence."""
    for i, item in enumerate(sentence.words[:word]):
        if item != ":":
            continue
        start = max((j for j in range(i) if sentence.words[j] in (",", ":")), default=-1)
        label = sentence.words[start + 1 : i]
        if GOAL_LABELS & set(label) or (label[:1] == ("last",)):
            return not any(w == ":" for w in sentence.words[i + 1 : word])
    return False


def _asks(words: tuple[str, ...], left: tuple[str, ...]) -> bool:
    first = words[1:2] if words[:1] in (("why",), ("how",)) else words[:1]
    if first and first[0] in _ASKING and len(words) > 1 and left:
        return words[words.index(first[0]) + 1] in _PERSONS
    return words[:1] in (("why",), ("what",))


def negates(words: tuple[str, ...], *, bound_no: bool = True) -> int | None:
    """Index of the last negation in ``words``; 'no slip' negates the slip alone."""
    last = None
    for i, word in enumerate(words):
        follower = words[i + 1] if i + 1 < len(words) else ""
        if word == "no" and bound_no and follower and follower not in _UNBOUND_NO:
            continue
        if word in ("not", "never") and follower in _UNDO:
            continue
        if word in _UNDO and i and words[i - 1] in NEGATORS:
            continue
        if (word in NEGATORS or word in _NO_VERBS) and not (
            word == "without" and follower and not follower.endswith("ing")
        ):
            last = i
    return last


def _negated(
    sentence: Sentence,
    mention: Mention,
    index: int,
    left: tuple[str, ...],
    earlier: tuple[Mention, ...],
) -> bool:
    segment = sentence.segments[index]
    here = negates(left)
    if mention.form is Form.NAME and left[-1:] == ("no",):
        return True
    if here is not None:
        if left[here] not in _FIRST_ONLY or mention.form in (Form.GERUND, Form.NAME):
            between = [m for m in earlier if m.start >= segment.start + here]
            same = all(m.form is mention.form for m in between)
            return left[here] not in _FIRST_ONLY or not between or same
        return not any(m.start >= segment.start + here for m in earlier)
    if segment.lead == "nor":
        return True
    if segment.lead in _RESUME or set(left[:1]) & _RESUME_WORDS or _own_clause(left):
        return False
    return _carried(sentence, mention, index, left, earlier)


def _own_clause(left: tuple[str, ...]) -> bool:
    """Whether the words before the verb are a subject and a modal of their own."""
    if left[:1] in (("that",), ("whether",), ("to",)):
        return False
    modals = {"should", "must", "needs", "need", "has", "have", "will", "shall", "recommend"}
    modals |= {"suggest", "is", "us", "advise", "requires", "want", "calls", "better", "best"}
    return any(w in modals for w in left[1:]) or left[:1] in (("please",), ("let",), ("now",))


def _carried(
    sentence: Sentence,
    mention: Mention,
    index: int,
    left: tuple[str, ...],
    earlier: tuple[Mention, ...],
) -> bool:
    """Whether a negation in an earlier segment still reaches this one."""
    listed = any(s.lead in ("or", "nor") for s in sentence.segments[index:])
    for back in range(index - 1, -1, -1):
        words, follower = sentence.of(back), sentence.segments[back + 1].lead
        at = negates(words)
        lead = sentence.segments[back].lead
        if at is not None:
            inside = [m for m in earlier if sentence.segment_index(m.start) == back]
            after = [m for m in inside if m.start >= sentence.segments[back].start + at]
            tail = words[at + 1 :]
            dangling = not after and (set(tail) <= _EMPTY or lead in ("or", "nor"))
            dangling &= words[at] != "no" or len(words) > 1
            open_end = not after and (left[:1] in (("to",), ("that",), ("whether",)))
            open_end |= not after and not left and mention.form is Form.GERUND
            joined = bool(after) and (follower in ("and", "or", "nor") or listed)
            if after and words[at] in _FIRST_ONLY:
                joined = follower in ("or", "nor", "and") and after[-1].form is mention.form
            return dangling or open_end or joined
        if lead in _RESUME or sentence.segments[back + 1].lead in _RESUME:
            return False
    return False


def _refused_after(sentence: Sentence, mention: Mention) -> bool:
    """'moving down is not needed', 'increase_force: no', 'move_down would be wrong'."""
    index = sentence.segment_index(mention.start)
    end = sentence.segments[index].end
    after = sentence.words[mention.end : end]
    at = negates(after)
    if at is not None:
        to = after[at - 1 : at] == ("to",) or after[at + 1 : at + 2] == ("to",)
        more = after[at + 1 : at + 2] in (("more",), ("further",))
        if (set(after[:at]) & _COPULA or at == 0) and not (to or more):
            return after[at] not in ("without", "against", "avoid", "prevent", "stop", "instead_of")
    if index + 1 < len(sentence.segments) and sentence.segments[index + 1].lead != "but":
        following = sentence.of(index + 1)
        if len(following) <= 2 and following[0] in ("no", "not", "never", "nope", "false"):
            return following[1:] in (
                (),
                ("now",),
                ("yet",),
                ("needed",),
                ("allowed",),
                ("required",),
            )
    return False


def _unpraised(left: tuple[str, ...]) -> tuple[str, ...]:
    """Without the 'would' of 'it would be better to', which advises."""
    praise = ("better", "best", "good", "wise", "advisable", "sensible", "right", "helpful")
    advises = any(left[i : i + 2] == ("would", "be") for i in range(len(left)))
    if advises and set(praise) & set(left):
        return tuple(w for w in left if w != "would")
    return left


def _supposed(sentence: Sentence, index: int, left: tuple[str, ...]) -> bool:
    segment = sentence.segments[index]
    if _ANYWHERE & set(sentence.words) or _SUPPOSING & set(_unpraised(left)):
        return True
    if segment.lead in ("when", "once") and index == 0:
        return True
    for i, other in enumerate(sentence.segments):
        timely = other.lead in ("when", "once") and sentence.of(i)[:1] != ("per",)
        if timely and (i != index or not left):
            return True
    shared = not left and segment.lead in ("or", "and", "nor")  # 'could move up or squeeze harder'
    return shared and index > 0 and bool(set(sentence.of(index - 1)) & _SUPPOSING)


def _is_past(mention: Mention, left: tuple[str, ...]) -> bool:
    if mention.form is Form.PAST:
        before = [w for w in left if not w.endswith("ly")]
        return before[-1:] != ["be"] and "be" not in before[-2:]
    last = "last" in left and bool({"action", "move", "step", "time"} & set(left))
    return bool(_PAST & set(left)) or last


def _later(
    sentence: Sentence,
    mention: Mention,
    index: int,
    left: tuple[str, ...],
    earlier: tuple[Mention, ...],
) -> bool:
    segment = sentence.segments[index]
    if segment.lead not in ("before", "after", "until", "till"):
        return False
    return not any(m.start >= segment.start for m in earlier)


def _described(sentence: Sentence, mention: Mention, left: tuple[str, ...]) -> bool:
    """Whether the words tell what happens to the contact rather than what to do."""
    if mention.form is Form.FINITE:
        return True
    if mention.form is Form.WANT:
        around = sentence.of(sentence.segment_index(mention.start))
        rest = set(around[: len(left)]) | set(around[len(left) + mention.end - mention.start :])
        return not (rest & _NEEDED or rest <= _FRAGMENT)
    plain = [w for w in left if not w.endswith("ly")]
    if mention.form is Form.GERUND:
        progressive = {
            "is",
            "are",
            "be",
            "been",
            "starts",
            "begins",
            "keeps",
            "was",
            "were",
            "a",
            "an",
        }
        return plain[-1:] != [] and plain[-1] in progressive | _FELT
    if plain[-1:] and plain[-1] in ("a", "an", "the", "any", "this", "such", "small", "slight"):
        around = sentence.of(sentence.segment_index(mention.start))
        return not set(around) & _NEEDED  # 'an increase in force' is a noun
    linked = False
    for word in reversed(plain):
        if word in _FELT:
            return True
        if word in _LINKS:
            linked = True
        elif not (linked and word in _PLACE):
            return False
    return False
