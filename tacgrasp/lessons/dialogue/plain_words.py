"""Text of a question as plain words: the form in which wordings are compared and understood.

Lower case, contractions and common misspellings written out, numbers as ``NUMBER``, units apart
from their numbers, no punctuation. Two questions with the same plain words are the same wording.

Not here: instructions (``policies.instructions.english.text``), where punctuation carries meaning.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Mapping
from typing import NamedTuple

NUMBER = "#"
"""Stands for any number written in digits."""

CONTRACTIONS: Mapping[str, str] = {
    **{
        f"{verb}n't": f"{verb} not"
        for verb in (
            *("is", "are", "was", "were", "do", "does", "did", "has", "have", "had"),
            *("would", "could", "should", "must", "need", "might"),
        )
    },
    **{
        f"{word}'s": f"{word} is"
        for word in ("it", "that", "what", "where", "there", "how", "here", "who", "which", "this")
    },
    **{f"{word}'re": f"{word} are" for word in ("you", "we", "they")},
    **{f"{word}'ve": f"{word} have" for word in ("i", "you", "we")},
    **{f"{word}'d": f"{word} would" for word in ("i", "you", "we")},
    **{f"{word}'ll": f"{word} will" for word in ("i", "you", "we", "it")},
    "i'm": "i am",
    "can't": "can not",
    "cannot": "can not",
    "won't": "will not",
    "let's": "let us",
}
"""Contractions, written out."""

MISSPELLINGS: Mapping[str, str] = {
    "whats": "what is",
    "wheres": "where is",
    "hows": "how is",
    "its": "it is",
    "isnt": "is not",
    "dont": "do not",
    "doesnt": "does not",
    "wont": "will not",
    "cant": "can not",
    "im": "i am",
    "u": "you",
    "ur": "your",
    "pls": "please",
    "plz": "please",
    "teh": "the",
    "adn": "and",
    "wich": "which",
    "waht": "what",
    "hw": "how",
    "hwo": "how",
    "presure": "pressure",
    "forse": "force",
    "depht": "depth",
    "dept": "depth",
    "shap": "shape",
    "textur": "texture",
    "contakt": "contact",
    "conact": "contact",
    "milimetres": "millimetres",
    "milimeters": "millimetres",
    "millimeters": "millimetres",
    "millimeter": "millimetre",
    "micrometers": "micrometres",
    "centre": "center",
    "centred": "centered",
    "middel": "middle",
    "positon": "position",
    "newtones": "newtons",
    "squezed": "squeezed",
    "tuching": "touching",
    "surfce": "surface",
    "colour": "color",
    "temprature": "temperature",
    "grey": "gray",
    **{
        f"{verb}nt": f"{verb} not"
        for verb in (
            *("are", "was", "were", "did", "has", "have", "had"),
            *("would", "could", "should", "must", "might"),
        )
    },
    "thats": "that is",
    "theres": "there is",
    "whos": "who is",
    "heres": "here is",
    "youre": "you are",
    "theyre": "they are",
    "ive": "i have",
    "youve": "you have",
    "weve": "we have",
    "youll": "you will",
    "itll": "it will",
    "ain't": "is not",
    "aint": "is not",
    "r": "are",
    "ya": "you",
    "thx": "thanks",
    "tho": "though",
    "cuz": "because",
    "gonna": "going to",
    "wanna": "want to",
    "gotta": "have to",
    "gimme": "give me",
    "lemme": "let me",
    "dunno": "do not know",
    "kinda": "kind of",
    "rn": "right now",
    "avg": "average",
    "approx": "approximately",
    "tht": "that",
    "ths": "this",
    "taht": "that",
    "thier": "their",
    "hte": "the",
    "si": "is",
    "od": "do",
    "jsut": "just",
    "nad": "and",
    "wat": "what",
    "wut": "what",
    "whta": "what",
    "hwat": "what",
    "whre": "where",
    "wehre": "where",
    "shoud": "should",
    "shld": "should",
    "woud": "would",
    "wuld": "would",
    "cud": "could",
    "coud": "could",
    "abouve": "above",
    "untill": "until",
    "realy": "really",
    "curently": "currently",
    "exactely": "exactly",
    "definately": "definitely",
    "aproximately": "approximately",
    "preasure": "pressure",
    "pressue": "pressure",
    "forc": "force",
    "froce": "force",
    "fource": "force",
    "newtens": "newtons",
    "neutons": "newtons",
    "gramms": "grams",
    "gramm": "gram",
    "milimeter": "millimetre",
    "milimetre": "millimetre",
    "millimetere": "millimetre",
    "mircons": "microns",
    "micrometer": "micrometre",
    "centimeter": "centimetre",
    "gripp": "grip",
    "gripepr": "gripper",
    "griper": "gripper",
    "sensr": "sensor",
    "senser": "sensor",
    "fingr": "finger",
    "objekt": "object",
    "obejct": "object",
    "onject": "object",
    "ojbect": "object",
    "surfase": "surface",
    "surafce": "surface",
    "textrue": "texture",
    "texure": "texture",
    "shpae": "shape",
    "weigth": "weight",
    "wieght": "weight",
    "wheight": "weight",
    "limt": "limit",
    "limmit": "limit",
    "saftey": "safety",
    "savely": "safely",
    "sqeeze": "squeeze",
    "squeze": "squeeze",
    "sqeezing": "squeezing",
    "toched": "touched",
    "tuched": "touched",
    "touchin": "touching",
    "holdin": "holding",
    "slipp": "slip",
    "slippin": "slipping",
    "aera": "area",
    "middl": "middle",
    "centerd": "centered",
    "positoin": "position",
    "loction": "location",
    "cordinates": "coordinates",
    "coordiantes": "coordinates",
    "deeep": "deep",
    "depper": "deeper",
    "cneterd": "centered",
    "obove": "above",
    "micormeters": "micrometres",
    "recomend": "recommend",
    "reccomend": "recommend",
}
"""Common misspellings and other spellings, as they count."""

_UNITS: Mapping[str, str] = {
    "µm": "um",
    "μm": "um",
    "mm²": "mm2",
    "%": "percent",
}
_TOKEN = re.compile(
    r"(?:(?<![\w.])[+-])?(?:\d+(?:[.,]\d+)?|[.]\d+)|mm²|mm2|%|[^\W\d_]+(?:'[^\W\d_]+)?"
)

_PLUS_MINUS = re.compile(r"±|\+ ?/? ?-(?= ?[\d.])")


class PlainText(NamedTuple):
    """A text in plain words.

    Attributes:
        words: The words.
        numbers: Value of each word that is ``NUMBER``, by its index; others are absent.
    """

    words: tuple[str, ...]
    numbers: dict[int, float]


def plain_text(text: str) -> PlainText:
    """Plain words of a text, with the values of its numbers."""
    lowered = unicodedata.normalize("NFC", text).lower().replace("’", "'").replace("−", "-")
    words: list[str] = []
    numbers: dict[int, float] = {}
    lowered = _PLUS_MINUS.sub(" plus minus ", lowered.replace("μ", "µ").replace("mm^2", "mm2"))
    for token in _TOKEN.findall(lowered):
        if token.lstrip("+-.")[:1].isdecimal():
            numbers[len(words)] = float(token.replace(",", "."))
            words.append(NUMBER)
            continue
        words += _written_out(token)
    return PlainText(words=tuple(words), numbers=numbers)


def plain_words(text: str) -> tuple[str, ...]:
    """Plain words of a text."""
    return plain_text(text).words


def _written_out(token: str) -> list[str]:
    token = _UNITS.get(token, token)
    token = CONTRACTIONS.get(token, token)
    return [word for part in token.split() for word in MISSPELLINGS.get(part, part).split() if word]
