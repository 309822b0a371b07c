"""Subjects that touch can't know."""

from __future__ import annotations

from collections.abc import Mapping

SUBJECTS: Mapping[str, str] = {
    "color": "its color",
    "temperature": "its temperature",
    "name": "its name",
    "price": "its price",
    "smell": "its smell",
    "taste": "its taste",
    "sound": "its sound",
    "origin": "where it comes from",
    "inside": "what is inside it",
    "sight": "what can only be seen",
    "material": "what it is made of",
    "age": "its age",
    "owner": "whose it is",
    "maker": "who made it",
    "purpose": "what it is for",
    "freshness": "its freshness",
    "danger": "whether it is dangerous",
    "electricity": "its electric or magnetic properties",
    "size": "its full size",
    "surroundings": "what is around it",
    "print": "what is printed on it",
    "past": "what happened to it before",
    "future": "what will be",
    "elsewhere": "what another finger touches",
    "finger": "which finger this is",
    "opening": "how far the gripper is open",
    "outcome": "what would come of that",
    "law": "what the rules say about it",
    "friction": "its friction",
    "trait": "that",
}
"""What touch can't know, as answers name it."""

RULED_SUBJECTS = ("future", "elsewhere", "finger", "opening", "outcome")
"""Those that rules alone read, and no model names (``tacgrasp.lessons.dialogue.rules``)."""
