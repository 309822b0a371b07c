"""Whether a text declares the present grasp good.

Each 'stable', 'appropriate', 'secure' or 'reliable', and each of their opposites, is read in its
own clause: who it is said of, under which negation, tense and mood. Success needs one that is
affirmed of the grasp now, and none that is denied. In doubt, no. Source: paper, Algorithm 1,
keyword set K; the reading is ours.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from policies.extraction import verdict_words as lex
from policies.extraction.clauses import NEGATORS, Sentence
from policies.extraction.requests import after_goal_label


@dataclass(frozen=True, slots=True, kw_only=True)
class Verdict:
    """Whether the grasp is declared good, and why."""

    success: bool
    reason: str


def verdict(requests: Sequence[tuple[Sentence, int]]) -> Verdict:
    """Read the verdict from sentences, each with the index of the first word that asks for motion.

    A word after that index tells what the motion is for ('move down, so the grasp is stable'), and
    declares nothing.
    """
    affirmed: list[str] = []
    notes: list[str] = []
    whole = all(first == len(s.words) for s, first in requests)
    whole = whole and not any(lex.CONTRAST & set(s.words) for s, _ in requests)
    for number, (sentence, first) in enumerate(requests):
        following = requests[number + 1][0] if number + 1 < len(requests) else None
        for k, word in enumerate(sentence.words):
            if word not in lex.DESCRIPTORS | lex.OPPOSITES:
                continue
            sign, why = _read(sentence, k, first, following, whole)
            if word in lex.OPPOSITES:
                sign = -sign if sign > 0 else 0
            if sign < 0:
                denied = "said" if word in lex.OPPOSITES else "denied"
                return Verdict(success=False, reason=f"no success: '{word}' is {denied}")
            if sign > 0:
                affirmed.append(word)
            elif word in lex.DESCRIPTORS:
                notes.append(f"'{word}' is {why}")
    if affirmed:
        return Verdict(success=True, reason=f"declares the grasp {affirmed[0]}")
    return Verdict(success=False, reason="; ".join(["declares no success", *notes]))


def _read(
    sentence: Sentence, k: int, first_request: int, following: Sentence | None, whole: bool
) -> tuple[int, str]:
    """+1 affirmed, -1 denied, 0 neither; and why."""
    index = sentence.segment_index(k)
    segment = sentence.segments[index]
    left = sentence.words[segment.start : k]
    right = sentence.words[k + 1 : segment.end]
    if sentence.question or _inverted(left):
        return 0, "asked, not said"
    back = () if _has_own_clause(left) else _looked_back(sentence, index)
    context = (*back, *left)
    if mood := _unreal(sentence, k, index, first_request, context, left, right):
        return 0, mood
    if _denied(sentence, index, back, left, right, following):
        return -1, "denied"
    if mood := _reserved(sentence, index, left, right):
        return 0, mood
    if not _of_the_grasp(context, left, right, whole=whole):
        return 0, "not said of the grasp"
    return 1, "affirmed"


def _inverted(left: tuple[str, ...]) -> bool:
    """'is the grasp stable', without its question mark."""
    asking = {"is", "are", "does", "do", "can", "could", "will", "would", "should", "has", "was"}
    asking |= {"were", "may", "might", "am", "did", "have"}
    rest = [w for w in left[1:] if not w.endswith("ly") and w not in ("now", "very", "both", "not")]
    return (
        bool(left[:1])
        and left[0] in asking
        and bool(rest)
        and rest[0]
        in (lex.WHOLE | {"the", "my", "our", "a", "you", "he", "any", "your", "its"})
        - {"both", "all", "now", "here"}
    )


def _has_own_clause(left: tuple[str, ...]) -> bool:
    verbs = [i for i, w in enumerate(left) if w in lex.VERBS]
    if not verbs or (left[0] in ("that", "whether") and len(left) > 1 and left[1] not in lex.VERBS):
        return False
    subject = left[: verbs[0]]
    return any(w in lex.WHOLE | lex.PART | lex.FOREIGN or w in ("the", "a", "you") for w in subject)


def _looked_back(sentence: Sentence, index: int) -> tuple[str, ...]:
    """Words of earlier segments that the one at ``index`` still hangs on."""
    found: tuple[str, ...] = ()
    lead = sentence.segments[index].lead
    for back in range(index - 1, -1, -1):
        words = sentence.of(back)
        if lead == "but":  # 'not firm but stable': the negation ends here
            words = tuple(w for w in words if w not in NEGATORS)
        found = (*words, *found)
        person = words[0] in ("i", "we") and len(words) <= 4
        if any(w in lex.VERBS for w in words[1:]) and not person:
            break
        lead = sentence.segments[back].lead if lead != "but" else lead
    return found


def _unreal(
    sentence: Sentence,
    k: int,
    index: int,
    first_request: int,
    context: tuple[str, ...],
    left: tuple[str, ...],
    right: tuple[str, ...],
) -> str:
    """Why what is said of word ``k`` is no statement about now; '' when it may be one."""
    if lex.ANYWHERE & set(sentence.words):
        return "under a condition or a doubt"
    if first_request < k:
        return "what the action is for"
    if after_goal_label(sentence, k):
        return "a goal"
    if _timed(sentence, index, left):
        return "said of another time"
    judged = _judged(context)
    ignored = (
        lex.BEFORE_OK_SUBJECT if not judged else lex.BEFORE_OK_SUBJECT | {"be", "called", "said"}
    )
    if any(context[i : i + 2] == ("with", w) for i in range(len(context)) for w in lex.CHANGED):
        return "after a change that is not made"
    for i, word in enumerate(context):
        hedge = word in lex.BEFORE_IT and word not in ignored
        hedge |= word == "hold" and i == 0
        hedge |= word == "sure" and context[i - 1 : i] in (("make",), ("be",))
        hedge &= not (word == "become" and context[i - 1 : i] in (("has",), ("have",)))
        hedge |= word == "made" and context[i - 1 : i] not in (("been",), ("is",))
        hedge |= word == "to" and not judged and _infinitive(context, i)
        if word in ("less", "more", "least", "most", "too", "only"):
            hedge = i >= len(context) - 2 and word in left
        if hedge and word not in NEGATORS:
            return f"after '{word}'"
    verbs = [w for w in context if w in lex.VERBS]
    if verbs and verbs[-1] in lex.PAST_VERBS:
        return "about the past"
    if not verbs and lex.PAST_WORDS & set(left):
        return "about the past"
    return ""


def _judged(context: tuple[str, ...]) -> bool:
    """'can be called', 'is considered (to be)', 'appears to be': said of now, by a judge."""
    if not (lex.JUDGED & set(context)):
        return False
    return "be" not in context or bool({"can", "to"} & set(context))


def _infinitive(context: tuple[str, ...], i: int) -> bool:
    after = context[i + 1] if i + 1 < len(context) else ""
    return after not in {"the", "its", "our", "this", "that", "your"} or context[i - 1] in (
        "leads", "lead", "leading", "back", "close", "way", "path", "next", "due"
    )  # fmt: skip


def _timed(sentence: Sentence, index: int, left: tuple[str, ...]) -> bool:
    """'once the grasp is stable', 'stable when it is centred', 'stable after moving down'."""
    segment = sentence.segments[index]
    if segment.lead in ("once", "when", "before", "then"):
        return True
    if segment.lead == "after" and (not left or left[0] not in ("the", "this", "that", "a", "one")):
        return True
    for i, other in enumerate(sentence.segments):
        words = sentence.of(i)
        if (
            i != index
            and other.lead in ("once", "when", "before")
            and not (other.lead == "before" and i < index and len(words) <= 3)
        ):
            return True
        if i != index and other.lead == "after":
            planned = {"more", "another", "further", "next"} & set(words[:4])
            if planned or words[0] not in ("the", "this", "that", "a", "one", "two", "our", "last"):
                return True
    return False


def _denied(
    sentence: Sentence,
    index: int,
    back: tuple[str, ...],
    left: tuple[str, ...],
    right: tuple[str, ...],
    following: Sentence | None,
) -> bool:
    if any(w in NEGATORS for w in left) or sentence.segments[index].lead == "nor":
        return True
    bound = {"no", "without", "nothing", "none"}  # 'no slip is felt, ...' negates the slip alone
    if any(w in NEGATORS - bound for w in back):
        return True
    if any(w in bound for w in back[-1:]):
        return True
    for i, word in enumerate(right):
        if word in NEGATORS - {"no", "without", "nothing", "none"}:
            return True
        if word == "no" and (i + 1 == len(right)):
            return True
    return _retracted(sentence, index, following)


def _retracted(sentence: Sentence, index: int, following: Sentence | None) -> bool:
    """Whether it is taken back: 'stable: no', 'The grasp is stable. That is not true.'."""
    later = [sentence.of(i) for i in range(index + 1, len(sentence.segments))]
    later += [] if following is None else [following.of(0)]
    return any(set(w) <= lex.RETRACT and set(w) & lex.DENY for w in later)


def _reserved(sentence: Sentence, index: int, left: tuple[str, ...], right: tuple[str, ...]) -> str:
    """A comparison or an adverb that takes the statement back."""
    lead = sentence.segments[index].lead
    before = sentence.of(index - 1) if index and lead == "as" else ()
    if lead == "as" and not left and not (lex.JUDGED & set(before)):
        return "compared"
    for word in left[-2:]:
        if word.endswith("ly") and word not in lex.SURE_LY:
            return f"after '{word}'"
    if right[:1] == ("than",) or right[:2] in (("for", "a"), ("for", "an")):
        return "said of something else"
    return ""


def _of_the_grasp(
    context: tuple[str, ...], left: tuple[str, ...], right: tuple[str, ...], *, whole: bool
) -> bool:
    """Whether the descriptor is said of the grasp, as a predicate or in front of its noun."""
    noun = next((i for i, w in enumerate(right) if w not in lex.ADJECTIVES | lex.DESCRIPTORS), None)
    if noun is not None and right[noun] in lex.GRASP:
        return _attributive(context, left, right[noun + 1 :])
    if (
        right
        and right[0] not in lex.FOLLOWERS | lex.ACHIEVED
        and not (right[0] in lex.SURE_LY or right[0][0].isdigit())
    ):
        return False
    return _subject_fits(context, whole=whole)


def _attributive(context: tuple[str, ...], left: tuple[str, ...], rest: tuple[str, ...]) -> bool:
    """'this is a stable grasp', 'secure grip achieved'; not 'a stable grasp needs more force'."""
    if {"for", "of", "into", "towards", "toward", "to"} & set(left[-3:]) or lex.GOALS & set(
        context
    ):
        return False
    if lex.ACHIEVED & set(rest):
        return not ({"be", "will", "to", "yet", "lost"} & set(rest))
    needing = {"needs", "requires", "needed", "required", "wanted", "comes", "depends", "takes"}
    needing |= {"calls", "demands", "lost", "gone", "missing", "first", "means", "begins", "starts"}
    return not ((lex.VERBS | needing) & set(rest))


def _subject_fits(context: tuple[str, ...], *, whole: bool) -> bool:
    verbs = [i for i, w in enumerate(context) if w in lex.VERBS]
    subject = context[: verbs[-1]] if verbs else context
    prepositions = {
        "of",
        "on",
        "in",
        "at",
        "between",
        "around",
        "with",
        "by",
        "from",
        "for",
        "under",
    }
    at = next((i for i, w in enumerate(subject) if w in prepositions), None)
    if at == 0:
        last = max((i for i, w in enumerate(subject) if w in ("the", "this", "it", "a")), default=0)
        head = subject[last:]
    else:
        head = subject if at is None else subject[:at]
    nouns = [w for w in head if w not in lex.DESCRIPTORS | lex.OPPOSITES]
    if set(nouns) & lex.FOREIGN:
        return False
    if set(nouns) & lex.PART:
        return whole
    if verbs and subject:
        return bool(set(nouns) & lex.WHOLE)
    plain = (
        lex.WHOLE
        | lex.ADJECTIVES
        | lex.SURE_LY
        | {"the", "a", "very", "and", "quite", "still", "just"}
    )
    plain |= {"so", "good", "ok", "okay", "yes", "done", "finally", "well", "firm", "deep", "as"}
    plain |= {"perfect", "great", "moderate", "gripped", "held", "felt", "fine", "final", "is"}
    plain |= {"remains", "stays", "feels", "looks", "considered", "judged", "deemed", "action"}
    return all(w in plain for w in nouns) or bool(set(nouns) & lex.GRASP)
