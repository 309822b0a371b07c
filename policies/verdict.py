"""Whether a text declares the present grasp good.

Each 'stable', 'appropriate', 'secure' or 'reliable', and each of their opposites, is read in its own
clause: who it is said of, under which negation, tense and mood. Success needs one that is affirmed
of the grasp now, and none that is denied. Source: paper, Algorithm 1, keyword set K; the reading is
ours. In doubt, no.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from policies.clauses import NEGATORS, UNKNOWN, Sentence
from policies.requests import after_goal_label

DESCRIPTORS = frozenset({"stable", "appropriate", "secure", "reliable"})
OPPOSITES = frozenset(
    {"unstable", "instable", "inappropriate", "insecure", "unsecure", "unreliable", "unsafe"}
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Verdict:
    """Whether the grasp is declared good, and why."""

    success: bool
    reason: str


_GRASP = frozenset(
    {"grasp", "grip", "hold", "contact", "grasping", "gripping", "holding", "touch", "clasp"}
)
_WHOLE = _GRASP | frozenset(
    {"it", "this", "that", "everything", "all", "things", "state", "status", "result", "verdict"}
    | {"assessment", "evaluation", "object", "berry", "strawberry", "fruit", "egg", "tomato", "peg"}
    | {"cherry", "apple", "marker", "item", "situation", "condition", "configuration", "quality"}
    | {
        "i",
        "we",
        "conclusion",
        "judgment",
        "judgement",
        "judgement",
        "setup",
        "they",
        "both",
        "now",
    }
    | {"here", "outcome", "there", "kiwi", "body", "part", "piece", "workpiece", "which", "success"}
)
_PART = frozenset(
    {"force", "pressure", "position", "depth", "area", "location", "placement", "alignment", "load"}
    | {"tightness", "strength", "indentation", "pose", "posture", "level", "forces", "distribution"}
)
_FOREIGN = frozenset(
    {
        "sensor",
        "sensors",
        "reading",
        "readings",
        "signal",
        "measurement",
        "data",
        "estimate",
        "image",
    }
    | {"camera", "table", "robot", "arm", "network", "connection", "policy", "model", "action"}
    | {"move", "movement", "motion", "step", "adjustment", "option", "choice", "plan", "approach"}
    | {"strategy", "goal", "aim", "target", "task", "requirement", "response", "answer", "command"}
    | {"previous", "next", "other", "last", "former", "future", "ideal", "desired", "another"}
    | {"instruction", "objective", "purpose", "key", "idea", "word", "words", "term", "nothing"}
    | {"moving", "increasing", "decreasing", "reducing", "resetting", "lowering", "raising"}
    | {"gripper", "base", "mount", "stand", "temperature", "supposed", "hypothetical", "intended"}
    | {"descriptor", "descriptors", "keyword", "keywords", "first", "second", "earlier", "half"}
    | {"increase", "decrease", "reduction", "advice", "recommendation", "suggestion", "question"}
    | {"part", "left", "right", "side", "edge"}
) - {"part", "left", "right", "side", "edge"}
_GOALS = frozenset(
    {"goal", "aim", "target", "task", "requirement", "objective", "purpose", "key", "plan", "idea"}
    | {"instruction", "next", "condition", "question", "desired", "ideal", "previous", "last"}
    | {"wanted", "missing", "other", "step", "challenge", "problem", "word", "term", "action"}
)
_VERBS = frozenset(
    {"is", "are", "am", "was", "were", "has", "have", "had", "remains", "stays", "looks", "feels"}
    | {"seems", "appears", "holds", "proves", "will", "would", "should", "could", "might", "may"}
    | {"must", "shall", "can", "do", "does", "did", "think", "consider", "judge", "deem", "rate"}
    | {"call", "find", "declare", "conclude", "became", "becomes", "used", "got", "sits", "became"}
    | {"went", "turned", "kept", "felt", "looked", "seemed", "appeared", "stayed", "remained"}
    | {"feel", "believe", "report", "judged", "lies", "rests", "look", "seem", "remain", "stay"}
)
_PAST_VERBS = frozenset(
    {"was", "were", "had", "did", "became", "used", "went", "turned", "kept", "felt", "looked"}
    | {"seemed", "appeared", "stayed", "remained", "got"}
)
_PAST_WORDS = frozenset(
    {"previously", "formerly", "initially", "originally", "earlier", "yesterday"}
)
_PAST_WORDS |= {"before", "once", "formerly", "past"}
_ANYWHERE = frozenset(
    {"if", "unless", "until", "till", "provided", "providing", "assuming", "supposing", "suppose"}
    | {"whether", "lest", "otherwise", "perhaps", "maybe", "possibly", "hopefully", "presumably"}
    | {"probably", "supposedly", "allegedly", "soon", "eventually", "later", "ago", "doubt", "wish"}
    | {"doubtful", "hope", "pretend", "imagine", "false", "untrue", "incorrect", "mistaken", "lie"}
    | {"myth", "illusion", "nonsense", "wrong", "depending", "depends", "questionable", "dubious"}
    | {"unclear", "uncertain", "unlikely", "tomorrow", "theory", "hypothetically", "wonder"}
    | {"doubts", "unproven", "unverified", "debatable", "wishful", "joking", "kidding", UNKNOWN}
    | {"whenever", "likely", "conceivably", "arguably", "pretending", "unsure", "disputed"}
)
_BEFORE_IT = frozenset(
    {"will", "would", "should", "could", "might", "may", "must", "shall", "ought", "be", "become"}
    | {
        "becoming",
        "getting",
        "turning",
        "growing",
        "get",
        "gets",
        "keep",
        "keeping",
        "keeps",
        "make",
    }
    | {"makes", "making", "made", "let", "lets", "want", "wants", "need", "needs", "require", "aim"}
    | {
        "requires",
        "aiming",
        "try",
        "trying",
        "seek",
        "seeks",
        "attempt",
        "expect",
        "expected",
        "got",
    }
    | {
        "prefer",
        "desire",
        "desired",
        "target",
        "goal",
        "plan",
        "toward",
        "towards",
        "improve",
        "being",
    }
    | {"ensure", "ensures", "ensuring", "check", "verify", "promises", "guarantee", "guarantees"}
    | {
        "looking",
        "toward",
        "said",
        "says",
        "claim",
        "claims",
        "claimed",
        "told",
        "asked",
        "reported",
    }
    | {"instruction", "word", "words", "term", "descriptor", "descriptors", "example", "define"}
    | {
        "definition",
        "means",
        "then",
        "so_that",
        "so-called",
        "called",
        "like",
        "instead_of",
        "stay",
    }
    | {
        "lack",
        "lacks",
        "lacking",
        "fail",
        "fails",
        "failed",
        "failing",
        "missing",
        "ceases",
        "cease",
    }
    | {"ceased", "stopped", "stops", "loses", "lost", "losing", "lose", "absence", "deny", "denies"}
    | {"refuse", "less", "least", "most", "impossible", "unable", "insufficiently", "inadequately"}
    | {"almost", "nearly", "near", "nearing", "partly", "partially", "somewhat", "only", "half"}
    | {"semi", "quasi", "pseudo", "temporarily", "momentarily", "briefly", "approaching", "remain"}
    | {"few", "too", "more", "despite", "opposite", "contrary", "devoid", "would-be", "anything"}
    | {"away", "prevent", "prevents", "disagree", "dispute", "cannot", "until", "yields", "gives"}
    | {"hold", "bring", "brings", "restore", "restores", "help", "helps", "achieve", "tends"}
    | {
        "without",
        "supposed",
        "thought",
        "assumed",
        "believed",
        "hoped",
        "wanted",
        "demanded",
        "sure",
    }
    | {"starts", "begins", "beginning", "starting", "threatens", "stop", "avoid", "sort", "kind"}
    | {"borderline", "once", "formerly", "un", "if", "when", "ready", "enable", "enables", "allow"}
    | {
        "allows",
        "confirm",
        "see",
        "produce",
        "produces",
        "create",
        "creates",
        "give",
        "ex",
        "never",
    }
)
_BEFORE_OK_SUBJECT = frozenset({"hold", "sure", "goal", "made"})
_JUDGED = frozenset(
    {"called", "considered", "described", "deemed", "regarded", "declared", "judged", "rated"}
    | {"classified", "trusted", "found", "judge", "consider", "deem", "seems", "appears", "proves", "known", "termed"}
    | {
        "labelled",
        "labeled",
        "seen",
        "viewed",
        "assessed",
        "evaluated",
        "rate",
        "classify",
        "regard",
    }
    | {"describe", "counts", "classed", "qualifies", "assess"}
)
_SURE_LY = frozenset(
    {"perfectly", "fully", "completely", "entirely", "totally", "truly", "really", "clearly"}
    | {
        "certainly",
        "definitely",
        "absolutely",
        "firmly",
        "sufficiently",
        "adequately",
        "reasonably",
    }
    | {
        "fairly",
        "extremely",
        "highly",
        "finally",
        "currently",
        "presently",
        "undoubtedly",
        "surely",
    }
    | {"evidently", "visibly", "noticeably", "nicely", "properly", "remarkably", "exceptionally"}
    | {"consistently", "thoroughly", "genuinely", "equally", "simply", "obviously", "demonstrably"}
    | {"satisfactorily", "evenly", "mechanically", "physically", "already", "wonderfully", "overly"}
    | {"consequently", "accordingly", "verifiably", "indeedly", "unquestionably", "positively"}
) - {"overly", "indeedly"}
_FOLLOWERS = frozenset(
    {"now", "enough", "again", "already", "at", "in", "on", "with", "for", "by", "under", "between"}
    | {"throughout", "during", "due", "without", "today", "overall", "indeed", "too", "this", "it"}
    | {"from", "against", "across", "of", "over", "given", "within", "right", "still", "is", "are"}
    | {"both", "also", "surely", "everywhere", "no", "not", "i", "here", "currently", "inside"}
)
_ADJECTIVES = frozenset(
    {"two", "finger", "firm", "good", "centred", "centered", "gentle", "parallel"}
)
_ADJECTIVES |= {"overall", "well", "balanced", "safe", "soft", "current", "gripper", "pinch"}
_ACHIEVED = frozenset(
    {"achieved", "reached", "confirmed", "obtained", "established", "detected", "found", "made"}
    | {"attained", "accomplished", "verified", "present"}
)
_RETRACT = frozenset(
    {"no", "not", "nope", "never", "really", "at", "all", "quite", "far", "from", "it", "that"}
    | {
        "this",
        "is",
        "was",
        "i",
        "think",
        "do",
        "does",
        "so",
        "true",
        "the",
        "case",
        "yet",
        "correct",
    }
    | {
        "false",
        "wrong",
        "untrue",
        "a",
        "lie",
        "hardly",
        "just",
        "actually",
        "statement",
        "incorrect",
    }
)
_DENY = frozenset({"no", "not", "nope", "never", "false", "wrong", "untrue", "hardly", "lie"})
_DENY |= {"incorrect"}
_CONTRAST = frozenset({"but", "however", "yet", "although", "though", "except", "unfortunately"})


def verdict(requests: Sequence[tuple[Sentence, int]]) -> Verdict:
    """Read the verdict from sentences, each with the index of the first word that asks for motion.

    A word after that index tells what the motion is for ('move down, so the grasp is stable'), and
    declares nothing.
    """
    affirmed: list[str] = []
    notes: list[str] = []
    whole = all(first == len(s.words) for s, first in requests)
    whole = whole and not any(_CONTRAST & set(s.words) for s, _ in requests)
    for number, (sentence, first) in enumerate(requests):
        following = requests[number + 1][0] if number + 1 < len(requests) else None
        for k, word in enumerate(sentence.words):
            if word not in DESCRIPTORS | OPPOSITES:
                continue
            sign, why = _read(sentence, k, first, following, whole)
            if word in OPPOSITES:
                sign = -sign if sign > 0 else 0
            if sign < 0:
                denied = "said" if word in OPPOSITES else "denied"
                return Verdict(success=False, reason=f"no success: '{word}' is {denied}")
            if sign > 0:
                affirmed.append(word)
            elif word in DESCRIPTORS:
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
        in (_WHOLE | {"the", "my", "our", "a", "you", "he", "any", "your", "its"})
        - {"both", "all", "now", "here"}
    )


def _has_own_clause(left: tuple[str, ...]) -> bool:
    verbs = [i for i, w in enumerate(left) if w in _VERBS]
    if not verbs or left[0] in ("that", "whether") and len(left) > 1 and left[1] not in _VERBS:
        return False
    subject = left[: verbs[0]]
    return any(w in _WHOLE | _PART | _FOREIGN or w in ("the", "a", "you") for w in subject)


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
        if any(w in _VERBS for w in words[1:]) and not person:
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
    if _ANYWHERE & set(sentence.words):
        return "under a condition or a doubt"
    if first_request < k:
        return "what the action is for"
    if after_goal_label(sentence, k):
        return "a goal"
    if _timed(sentence, index, left):
        return "said of another time"
    judged = _judged(context)
    ignored = _BEFORE_OK_SUBJECT if not judged else _BEFORE_OK_SUBJECT | {"be", "called", "said"}
    for i, word in enumerate(context):
        hedge = word in _BEFORE_IT and word not in ignored
        hedge |= word == "hold" and i == 0
        hedge |= word == "sure" and context[i - 1 : i] in (("make",), ("be",))
        hedge &= not (word == "become" and context[i - 1 : i] in (("has",), ("have",)))
        hedge |= word == "made" and context[i - 1 : i] not in (("been",), ("is",))
        hedge |= word == "to" and not judged and _infinitive(context, i)
        if word in ("less", "more", "least", "most", "too", "only"):
            hedge = i >= len(context) - 2 and word in left
        if hedge and word not in NEGATORS:
            return f"after '{word}'"
    verbs = [w for w in context if w in _VERBS]
    if verbs and verbs[-1] in _PAST_VERBS:
        return "about the past"
    if not verbs and _PAST_WORDS & set(left):
        return "about the past"
    return ""


def _judged(context: tuple[str, ...]) -> bool:
    """'can be called', 'is considered (to be)', 'appears to be': said of now, by a judge."""
    if not (_JUDGED & set(context)):
        return False
    if "be" in context and not {"can", "to"} & set(context):
        return False
    return True


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
    """'Stable? No.', 'stable: no', 'The grasp is stable. That is not true.'"""
    later = [sentence.of(i) for i in range(index + 1, len(sentence.segments))]
    later += [] if following is None else [following.of(0)]
    return any(set(w) <= _RETRACT and set(w) & _DENY for w in later)


def _reserved(sentence: Sentence, index: int, left: tuple[str, ...], right: tuple[str, ...]) -> str:
    """A comparison or an adverb that takes the statement back."""
    lead = sentence.segments[index].lead
    before = sentence.of(index - 1) if index and lead == "as" else ()
    if lead == "as" and not left and not (_JUDGED & set(before)):
        return "compared"
    for word in left[-2:]:
        if word.endswith("ly") and word not in _SURE_LY:
            return f"after '{word}'"
    if right and right[0] == "than":
        return "compared"
    return ""


def _of_the_grasp(
    context: tuple[str, ...], left: tuple[str, ...], right: tuple[str, ...], *, whole: bool
) -> bool:
    """Whether the descriptor is said of the grasp, as a predicate or in front of its noun."""
    noun = next((i for i, w in enumerate(right) if w not in _ADJECTIVES | DESCRIPTORS), None)
    if noun is not None and right[noun] in _GRASP:
        return _attributive(context, left, right[noun + 1 :])
    if (
        right
        and right[0] not in _FOLLOWERS | _ACHIEVED
        and not (right[0] in _SURE_LY or right[0][0].isdigit())
    ):
        return False
    return _subject_fits(context, whole=whole)


def _attributive(context: tuple[str, ...], left: tuple[str, ...], rest: tuple[str, ...]) -> bool:
    """'this is a stable grasp', 'secure grip achieved'; not 'a stable grasp needs more force'."""
    if {"for", "of", "into", "towards", "toward", "to"} & set(left[-3:]) or _GOALS & set(context):
        return False
    if _ACHIEVED & set(rest):
        return not ({"be", "will", "to", "yet", "lost"} & set(rest))
    needing = {"needs", "requires", "needed", "required", "wanted", "comes", "depends", "takes"}
    needing |= {"calls", "demands", "lost", "gone", "missing", "first", "means", "begins", "starts"}
    return not ((_VERBS | needing) & set(rest))


def _subject_fits(context: tuple[str, ...], *, whole: bool) -> bool:
    verbs = [i for i, w in enumerate(context) if w in _VERBS]
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
    nouns = [w for w in head if w not in DESCRIPTORS | OPPOSITES]
    if set(nouns) & _FOREIGN:
        return False
    if set(nouns) & _PART:
        return whole
    if verbs and subject:
        return bool(set(nouns) & _WHOLE)
    plain = _WHOLE | _ADJECTIVES | _SURE_LY | {"the", "a", "very", "and", "quite", "still", "just"}
    plain |= {"so", "good", "ok", "okay", "yes", "done", "finally", "well", "firm", "deep", "as"}
    plain |= {"perfect", "great", "moderate", "gripped", "held", "felt", "fine", "final", "is"}
    plain |= {"remains", "stays", "feels", "looks", "considered", "judged", "deemed", "action"}
    return all(w in plain for w in nouns) or bool(set(nouns) & _GRASP)
