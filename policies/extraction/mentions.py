"""Which of the seven primitives a sentence mentions, and where; not whether it asks for them.

A small grammar over plain words: a verb, the thing it acts on, a direction or a comparative. It
reads only what stands directly with the verb, so that 'the contact is at the bottom left' mentions
nothing. Whether a mention is asked for, forbidden or supposed is for
``policies.extraction.requests``.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass

from policies.extraction import mention_words as lex
from policies.extraction.clauses import IDENTIFIERS, Sentence
from policies.extraction.mention_words import Form
from primitives import Primitive

INC, DEC = Primitive.INCREASE_FORCE, Primitive.DECREASE_FORCE


@dataclass(frozen=True, slots=True, kw_only=True)
class Mention:
    """A primitive mentioned at words ``start`` to ``end`` (half-open) of a sentence."""

    primitive: Primitive
    start: int
    end: int
    form: Form


def mentions(sentence: Sentence) -> tuple[Mention, ...]:
    """Every primitive that the sentence mentions, in order."""
    words = sentence.words
    found: list[Mention] = []
    index = 0
    while index < len(words):
        hits = _at(words, index)
        found += hits
        index = max((m.end for m in hits), default=index + 1)
    return tuple(found)


def _at(words: tuple[str, ...], i: int) -> list[Mention]:
    """What is mentioned from word ``i`` on; several when directions are coordinated."""
    if words[i] in IDENTIFIERS and words[i] != Primitive.RESET:
        return [Mention(primitive=IDENTIFIERS[words[i]], start=i, end=i + 1, form=Form.NAME)]
    for rule in (_reset, _force_verb, _force_turned, _tighten, _squeeze, _raise, _wanted):
        hit = rule(words, i)
        if hit is not None:
            return [hit]
    return _move(words, i)


def _skip(words: tuple[str, ...], i: int, fillers: Iterable[str]) -> int:
    while i < len(words) and (words[i] in fillers or re.match(r"\d", words[i])):
        i += 1
    return i


def _word(words: tuple[str, ...], i: int) -> str:
    return words[i] if 0 <= i < len(words) else ""


def _object(words: tuple[str, ...], i: int, heads: frozenset[str]) -> int | None:
    """End of a noun phrase from ``i`` whose last noun is one of ``heads``, or None."""
    head = None
    while i < len(words):
        if words[i] in heads:
            head = i + 1
        elif not (
            words[i] in lex.ADVERBS or words[i] in lex.MODIFIERS or re.match(r"\d", words[i])
        ) or (words[i] == "and" and head is not None):
            break
        i += 1
    if (
        head is None
        or _word(words, head) in lex.NOT_FORCE
        or any(w in lex.NOT_FORCE for w in words[head:i])
    ):
        return None
    return head


def _verb(table: dict[str, Form], words: tuple[str, ...], i: int) -> Form | None:
    form = table.get(words[i])
    if form is Form.BASE and words[i] == "lower" and _word(words, i - 1) in lex.ADJECTIVE_AFTER:
        return None
    return form


def _reset(words: tuple[str, ...], i: int) -> Mention | None:
    form = lex.RESET.get(words[i])
    if form is not None:
        if words[i] == "reset" and _word(words, i - 1) in ("was", "were", "been"):
            form = Form.PAST
        rest = _skip(words, i + 1, lex.ADVERBS - {"of"})
        allowed = lex.HAND | {"everything", "hold"}
        noun = _word(words, rest)
        named = rest > i + 1 or noun in lex.NOT_FORCE | lex.FORCE
        blocked = noun in lex.NOT_FORCE | lex.FORCE | {
            "button",
            "timer",
            "clock",
            "camera",
            "counter",
        }
        blocked |= _word(words, rest + 1) in lex.NOT_FORCE | lex.FORCE and noun in allowed
        if named and blocked and noun not in ("position", "pose"):
            return None
        return Mention(primitive=Primitive.RESET, start=i, end=i + 1, form=form)
    form = lex.AGAIN.get(words[i])
    if form is not None:
        end = _skip(words, i + 1, {"all", "it", "the", "to", "object", "berry", "strawberry"})
        end += _word(words, end) in ("grasp", "grip", "grasping", "gripping") and end > i
        if _word(words, end) in ("over", "again", "afresh", "anew"):
            return Mention(primitive=Primitive.RESET, start=i, end=end + 1, form=form)
    form = lex.RETURN.get(words[i])
    if form is not None:
        end = _skip(words, i + 1, lex.HAND | {"the", "back", "to", "its"})
        if words[end - 1] in ("the", "to", "its") and _word(words, end) in ("start", "starting"):
            return Mention(primitive=Primitive.RESET, start=i, end=end + 1, form=form)
    return None


def _force_verb(words: tuple[str, ...], i: int) -> Mention | None:
    """'increase the gripping force', 'decrease it', 'the force should increase'."""
    for table, primitive in ((lex.MORE, INC), (lex.LESS, DEC)):
        form = _verb(table, words, i)
        if form is None:
            continue
        after = _skip(words, i + 1, {"in", "of", "off", "up"})
        plain = words[i] not in ("lower", "raise", "drop", "add")
        end = _object(words, after, lex.GRIP if plain else lex.FORCE)
        verb = _word(words, i - 1) not in ("a", "an", "the", "any", "no", "slight", "small")
        if end is not None and verb and form is Form.BASE and _word(words, end) in lex.SAID_OF:
            continue  # 'lower force was measured'
        if end is not None:
            return Mention(primitive=primitive, start=i, end=end, form=form)
        if words[i][:8] in ("increase", "increasi", "decrease", "decreasi", "reduce", "reducing"):
            if _word(words, i + 1) == "it":
                return Mention(primitive=primitive, start=i, end=i + 2, form=form)
            if _force_subject(words, i):
                return Mention(primitive=primitive, start=i, end=i + 1, form=form)
        elif form is Form.PAST and _force_subject(words, i):
            return Mention(primitive=primitive, start=i, end=i + 1, form=form)
    return None


def _force_subject(words: tuple[str, ...], i: int) -> bool:
    """Whether what should increase at ``i`` is the force: 'the force should (be) increase(d)'."""
    links = {"should", "must", "to", "be", "needs", "need", "has", "have", "ought", "slightly"}
    links |= {"is", "a", "bit", "little", "now", "further", "not", "can", "could", "may", "might"}
    links |= {"would", "will", "never", "shall", "was", "been", "are"}
    j = i - 1
    while j >= 0 and words[j] in links:
        j -= 1
    return j < i - 1 and _word(words, j) in lex.GRIP - {"hold"}


def _force_turned(words: tuple[str, ...], i: int) -> Mention | None:
    """'bring the force down', 'turn up the pressure', 'the force should go down'."""
    form = lex.TURN.get(words[i])
    downs, ups = {"down", "back", "off"}, {"up"}
    if form is not None:
        first = _word(words, i + 1)
        if first in downs | ups:
            end = _object(words, i + 2, lex.FORCE)
            if end is not None:
                return Mention(primitive=INC if first in ups else DEC, start=i, end=end, form=form)
        end = _object(words, i + 1, lex.FORCE)
        if end is not None:
            last = _skip(words, end, {"slightly", "a", "bit", "little"})
            if _word(words, last) in downs | ups:
                up = words[last] in ups
                return Mention(primitive=INC if up else DEC, start=i, end=last + 1, form=form)
    if words[i] in ("go", "come", "move") and _force_subject(words, i):
        way = _word(words, i + 1)
        if way in ("up", "higher", "down", "lower"):
            up = way in ("up", "higher")
            return Mention(primitive=INC if up else DEC, start=i, end=i + 2, form=Form.BASE)
    return None


def _tighten(words: tuple[str, ...], i: int) -> Mention | None:
    """'tighten', 'loosen the grip a little'."""
    for table, primitive in ((lex.TIGHTEN, INC), (lex.LOOSEN, DEC)):
        form = table.get(words[i])
        if form is None or (words[i] == "firm" and _word(words, i + 1) != "up"):
            continue
        start = _skip(words, i + 1, {"up", "off"})
        end = _object(words, start, lex.JAWS)
        if end is not None:
            return Mention(primitive=primitive, start=i, end=end, form=form)
        rest = _skip(words, start, lex.ADVERBS - {"the", "its", "your", "that", "this", "my"})
        alone = rest == len(words) or words[rest] in (",", ":", "and", "then", "but", "it", "until")
        alone |= words[rest - 1] in ("off", "bit", "little", "slightly")
        if alone and words[i] not in ("soften", "relax", "strengthen", "firm"):
            if words[i].startswith("eas") and _word(words, i + 1) not in ("off", "up"):
                return None
            return Mention(primitive=primitive, start=i, end=max(start, i + 1), form=form)
    return None


def _squeeze(words: tuple[str, ...], i: int) -> Mention | None:
    """'squeeze harder', 'grip it more firmly', 'hold the berry less tightly'."""
    form = lex.SQUEEZE.get(words[i])
    if form is None:
        return None
    things = {"it", "the", "berry", "strawberry", "object", "fruit", "egg", "tomato", "peg", "on"}
    things |= {"cherry", "a", "bit", "little", "slightly", "with", "much", "down", "item", "even"}
    j = _skip(words, i + 1, things)
    way, what = _word(words, j), _word(words, j + 1)
    if way in lex.HARDER or (way in ("more", "greater") and what in lex.HARD):
        end, primitive = j + 1 + (way in ("more", "greater")), INC
    elif way == "less" and what in lex.HARD:
        end, primitive = j + 2, DEC
    elif way in lex.SOFTER:
        end, primitive = j + 1, DEC
    elif way == "more" and what in lex.SOFT:
        end, primitive = j + 2, DEC
    else:
        return None
    return Mention(primitive=primitive, start=i, end=end, form=form)


def _raise(words: tuple[str, ...], i: int) -> Mention | None:
    """'raise the gripper', 'lower the hand a little', 'descend'."""
    for table, primitive in ((lex.RISE, Primitive.MOVE_UP), (lex.FALL, Primitive.MOVE_DOWN)):
        form = _verb(table, words, i)
        if form is not None:
            end = _object(words, i + 1, lex.HAND_ONLY)
            if end is not None and not any(w in lex.GRIP - {"hold"} for w in words[end : end + 1]):
                return Mention(primitive=primitive, start=i, end=end, form=form)
    for table, primitive in ((lex.CLIMB, Primitive.MOVE_UP), (lex.SINK, Primitive.MOVE_DOWN)):
        form = table.get(words[i])
        if form is not None:
            return Mention(primitive=primitive, start=i, end=i + 1, form=form)
    return None


def _wanted(words: tuple[str, ...], i: int) -> Mention | None:
    """'more force', 'a tighter grip', 'the grip should be firmer': asked for only where needed."""
    ways = (
        (lex.MORE_OF, lex.FORCE, INC),
        (lex.MORE_GRIP - {"more", "extra", "additional"}, lex.GRIP, INC),
        (lex.LESS_OF, lex.FORCE, DEC),
        (lex.LESS_GRIP - {"less"}, lex.GRIP, DEC),
    )
    for adjectives, heads, primitive in ways:
        if words[i] in adjectives and _word(words, i - 1) not in ("too", "not"):
            end = _object(words, i + 1, heads)
            if end is not None and not any(w in lex.ADVERBS - {"a"} for w in words[i + 1 : end]):
                return Mention(primitive=primitive, start=i, end=end, form=Form.WANT)
    changed = {**dict.fromkeys(lex.MORE_GRIP - {"more", "extra", "additional"}, INC)}
    changed |= dict.fromkeys(lex.LESS_GRIP - {"less", "reduced"}, DEC)
    if words[i] in changed and _word(words, i - 1) == "be" and _force_subject(words, i):
        return Mention(primitive=changed[words[i]], start=i, end=i + 1, form=Form.BASE)
    return None


def _move(words: tuple[str, ...], i: int) -> list[Mention]:
    """'move the gripper slightly downward', 'go up and to the right'."""
    form = lex.MOTION.get(words[i])
    if form is None:
        return []
    fillers = (lex.HAND | lex.ADVERBS | lex.TOWARDS | lex.MODIFIERS) - {"center", "contact", "and"}
    found: list[Mention] = []
    j, forbidden = i + 1, False
    while j < len(words):
        word = words[j]
        if word in ("not", "neither"):
            forbidden = True
        elif word in ("but", "instead") and forbidden:
            forbidden = False
        elif word in lex.DIRECTION and not _is_adjective(words, j):
            if not forbidden:
                found.append(Mention(primitive=lex.DIRECTION[word], start=i, end=j + 1, form=form))
        elif found or forbidden:
            after = _skip(
                words, j, {",", "and", "or", "nor", "then", "to", "the", "also", "a", "bit"}
            )
            linked = any(w in (",", "and", "or", "nor", "then") for w in words[j:after])
            if not (linked and _word(words, after) in (*lex.DIRECTION, "not")):
                break
            j = after
            continue
        elif not (word in fillers or words[j : j + 2] == ("right", "now") or word[0].isdigit()):
            break
        j += 1
    return found


def _is_adjective(words: tuple[str, ...], j: int) -> bool:
    """'the right place', 'the left finger', 'up to 3 mm': no direction."""
    after = _word(words, j + 1)
    if words[j] in ("left", "right", "top", "upper", "lower", "bottom"):
        return after in lex.NOT_A_SIDE or re.match(r"[a-z]+ly$", after) is not None
    if words[j] in ("up", "down"):
        return after == "to" and (_word(words, j + 2)[:1].isdigit() or _word(words, j + 2) == "a")
    return False
