"""Slips of the keyboard in words that matter, set right: 'genlty' is 'gently'."""

from __future__ import annotations

import re

from policies.instructions import words

_TARGETS = (
    "gently gentle gentler softly softer lightly lighter firmly firm firmer tightly tight tighter harder "
    "strawberry berry squeeze squeezing grip hold grasp grab pick lift newton newtons force pressure release drop stop "
    "crush squash destroy limit ignore between maximum minimum least most exceed more than beneath delicate delicately careful "
    "carefully fragile bruise strongly stronger loosely looser under above below touch please open gripper fingers strong "
    "grams carefully override safety disable without never with half twice"
).split(" ")
_KNOWN = words.ENGLISH | words.FOREIGN | set(_TARGETS) | frozenset(
    "form farm film mast moist post lost host least beast feast lease drip drops gasp grape grapes gripe grips crust brush rush crash "
    "cash trust slip stop step shop stoop limits light might right night fight sight eight tights slight soften lift left loft gift life soft sift "
    "that then them their there thing thin think text test nest best rest beat heat hall hole hell help halt fold cold gold sold told bold mold "
    "half calf hall wish width wire wine wise wide moor mort moss must lose loose noose goose pack park peck pink pine pic pike sick tick brick trick "
    "bury very merry ferry cherry perry open pen over oven even event ever fever sever never nerve merge gram graph grass grain grand grad grid grin grim "
    "torch couch pouch tough though teach texts though thorough through bruises bruised gently tender under sunder wander where were wore worse moore store "
    "safely safety hard hardy holder holds touching touched picked lifted gripped squeezed crushed squashed below bellow yellow lowest lower slower flower power "
    "twice thrice dice rice price nice juice force farce source course horse morse worse fierce forge gore fore sore bore tore wore more mode mole sore".split()
)


def spelled(text: str) -> str:
    """Replace an unknown word by the word that matters from which one slip leads to it."""
    return re.sub(r"[a-z]{4,}", lambda match: _right(match.group()), text)


def _right(word: str) -> str:
    if word in _KNOWN:
        return word
    found = {target for target in _TARGETS if _one_slip(word, target)}
    return found.pop() if len(found) == 1 else word


def _one_slip(word: str, target: str) -> bool:
    """Two letters changed places, or one missing or doubled; in long words also another letter."""
    if abs(len(word) - len(target)) > 1 or word[0] != target[0] and sorted(word) != sorted(target):
        return False
    if len(word) == len(target):
        differ = [i for i, (a, b) in enumerate(zip(word, target, strict=True)) if a != b]
        if len(differ) == 2 and differ[1] == differ[0] + 1:
            return word[differ[0]] == target[differ[1]] and word[differ[1]] == target[differ[0]]
        return len(differ) == 1 and len(word) >= 6 and differ[0] > 0 or (
            len(differ) == 1 and len(word) >= 5 and {word[differ[0]], target[differ[0]]} <= set("aeiou")
        )
    shorter, longer = sorted((word, target), key=len)
    if longer == target and len(target) < 5:
        return False
    if longer == word and word in (target + "s", target + "d", target + "y"):
        return False
    return any(longer[:i] + longer[i + 1 :] == shorter for i in range(1, len(longer)))
