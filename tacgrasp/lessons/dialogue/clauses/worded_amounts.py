"""Questions that want words instead of numbers: 'Skip the figures: how deep has it dug in?'.

Not here: questions for a word ('is it shallow or deep?'), which need no such remark.
"""

from __future__ import annotations

import re

_FIGURES = (
    r"(?:figures?|numbers?|digits?|units?|values?|decimals?|percent(?:ages?)?|micro(?:ns|met(?:re|"
    r"er)s)|"
    r"millimet(?:re|er)s|newtons|measurements?|maths?)"
)
_IN_WORDS = (
    rf"(?:(?:do not|don['’]t) (?:give|tell|show|quote) (?:me |us )?(?:any )?{_FIGURES}"
    r"(?:, just (?:tell|say)(?: me)?)?|"
    rf"(?:skip|forget|drop|spare me|leave out|leave away|never mind|without|no) "
    r"(?:(?:giving|using|saying|telling me) )?(?:the |any |all |an? )?"
    rf"{_FIGURES}(?:,? please)?(?:,? (?:i['’]m|i am|it['’]s|they) [^,:;.?!]*)?|"
    rf"(?:just |only )?(?:in|with|as) (?:(?:plain|simple|everyday|your own) )?(?:words?|language|"
    rf"terms)(?:(?:,? (?:only|alone|please|likewise))|,? (?:not|rather than|instead of|and not) "
    rf"(?:in |as |with )?(?:an? |the )?{_FIGURES})*|(?:put )?(?:verbally|qualitatively)(?: put|"
    rf" speaking)?|likewise as a word|(?:in )?(?:an? )?word,? not (?:an? )?{_FIGURES}|"
    r"(?:(?:in )?(?:one|a) (?:single )?word (?:for )?each(?: of (?:them|these|the two))?))"
)
_REMARK = re.compile(
    rf"^(?:{_IN_WORDS})\s*[,:;.!–—-]+\s*|[,;:–—-]+\s*(?:{_IN_WORDS})(?=\s*(?:[,;.?!]|and\b|$))|"
    rf"\s*\((?:{_IN_WORDS})\)",
    re.I,
)
_AMOUNT = re.compile(r"\bamount (depth|area) \S+?(?=\.|;|$| in a)")


def without_remark(question: str) -> str:
    """A question without what says that words are wanted; '' where nothing says so."""
    plain = _REMARK.sub(" ", question)
    return " ".join(plain.split()) if plain != question else ""


def in_class_words(query: str) -> str:
    """A query for the words of depth and area instead of their numbers."""
    return _AMOUNT.sub(r"choice \1", query)
