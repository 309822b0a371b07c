"""Asks the language model what a question means.

It writes a query under the grammar of queries (``tacgrasp.lessons.dialogue.query``), without any
touch: what a question asks for does not hang on the contact.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from typing import NamedTuple, Protocol

import torch
from torch import Tensor

from cltp.llm.constrained.grammar import Grammar
from cltp.llm.generation import Reply
from tacgrasp.lessons.dialogue.answers import Answer, answer
from tacgrasp.lessons.dialogue.meaning import AnswerKind, Meaning, names_of
from tacgrasp.lessons.dialogue.query import asked_text, query_grammar, read_query
from tacgrasp.lessons.dialogue.scene import AskedScene

PROBABLY_BELOW = 0.6
"""Probability of a word below which an answer says 'probably'. As in D_t."""

FOLLOW_UP_WORDS = 5
"""Longest question [words] that may be a follow-up without beginning as one. Our choice."""

ALONE_FROM = 0.5
"""Confidence from which a question that does not begin as a follow-up is none. Our choice."""

_FOLLOWS = re.compile(r"(?:and|but|then|why|how come|what about|how about|same)\b", re.I)

NOT_UNDERSTOOD = "I don't understand the question."


class QueryWriter(Protocol):
    """What writes queries; ``cltp.llm.generation.Talker`` is one."""

    @property
    def width(self) -> int:
        """Width of its embeddings."""
        ...

    def reply_to(self, touch: Tensor, prompt: str, *, grammar: Grammar) -> Reply:
        """Reply to a prompt behind touch embeddings, here none."""
        ...


class ReadQuestion(NamedTuple):
    """What a question means to the model.

    Attributes:
        query: What it wrote.
        meaning: The query's meaning.
        confidence: Probability of the query, as the product over its parts.
    """

    query: str
    meaning: Meaning
    confidence: float


def understood(writer: QueryWriter, question: str, before: str = "") -> ReadQuestion | None:
    """What a question means; None where the model comes to no query.

    Args:
        writer: The model.
        question: The question.
        before: The question before it, where it follows one; ''.
    """
    asked = asked_text(question, before)
    grammar = query_grammar(len(asked.numbers))
    reply = writer.reply_to(torch.zeros(0, writer.width), asked.words, grammar=grammar)
    meaning = read_query(reply.text, asked.numbers) if reply.ended else None
    if meaning is None:
        return None
    confidence = math.prod(slot.probability for slot in reply.slots.values())
    return ReadQuestion(reply.text, meaning, confidence)


def understood_in_turn(writer: QueryWriter, question: str, before: str) -> ReadQuestion | None:
    """What a question means after another one.

    One that begins as follow-ups do is read behind the question before it. So is another short one
    where it means little alone, and that gives the likelier query.
    """
    if not before:
        return understood(writer, question)
    if _FOLLOWS.match(question):
        return understood(writer, question, before)
    alone = understood(writer, question)
    stands_alone = alone is not None and alone.confidence >= ALONE_FROM
    if stands_alone or len(question.split()) > FOLLOW_UP_WORDS:
        return alone
    read = [each for each in (alone, understood(writer, question, before)) if each is not None]
    return max(read, key=lambda each: each.confidence, default=None)


class Answered(NamedTuple):
    """An answer with its confidence.

    Attributes:
        answer: The answer.
        confidence: Probability that the question is understood and its words are right.
    """

    answer: Answer
    confidence: float


def answered(
    asked: ReadQuestion | None, scene: AskedScene, words: Mapping[str, float] | None = None
) -> Answered:
    """The answer to a question about what is felt.

    Args:
        asked: What the question means; None where it is not understood.
        scene: The contact as it is felt and said, with the contract and the mass.
        words: Probabilities of the contact's words, by dimension.
    """
    if asked is None:
        unclear = Answer(text=NOT_UNDERSTOOD, kind=AnswerKind.UNKNOWABLE, decidable=False)
        return Answered(unclear, 0.0)
    given = answer(asked.meaning, scene)
    told = [(words or {}).get(name, 1.0) for name in names_of(asked.meaning)]
    if given.decidable and min(told, default=1.0) < PROBABLY_BELOW:
        text = f"Probably {given.text[:1].lower()}{given.text[1:]}"
        given = Answer(text=text, kind=given.kind, value=given.value, unit=given.unit)
    return Answered(given, asked.confidence * math.prod(told))
