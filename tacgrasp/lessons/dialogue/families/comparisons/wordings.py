"""Wordings that compare something with a number: slots and patterns, affirmed and denied."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from tacgrasp.lessons.dialogue.families.comparisons.thresholds import (
    BETWEEN,
    COMPARISONS,
    DENIED,
    MORE_THAN,
    OR_MORE,
    UNDENIED,
    UNITS,
)
from tacgrasp.lessons.dialogue.patterns.pattern import Slots

_VERBS: Mapping[str, Sequence[str]] = {
    ">": (
        "exceed exceeds exceeded",
        "exceed exceeds exceeded",
        "pass passes passed",
        "surpass surpasses surpassed",
        "top tops topped",
        "go goes gone (over|above|beyond|past)",
        "lie lies lain (above|over)",
        "get gets got (above|over|past)",
        "rise rises risen above",
        "come comes come out above",
        "amount amounts amounted to more than",
        "measure measures measured more than",
        "read reads read (more than|above|over)",
    ),
    "<": (
        "fall falls fallen (below|short of)",
        "stay stays stayed (below|under)",
        "remain remains remained (below|under)",
        "keep keeps kept below",
        "lie lies lain (below|under)",
        "drop drops dropped (below|under)",
        "come comes come out below",
        "amount amounts amounted to less than",
        "measure measures measured less than",
        "read reads read (less than|below|under)",
    ),
    ">=": (
        "reach reaches reached",
        "reach reaches reached",
        "hit hits hit",
        "attain attains attained",
        "get gets got (to|up to|as far as)",
        "come comes come to at least",
        "amount amounts amounted to at least",
        "make makes made it to",
    ),
    "<=": (
        "amount amounts amounted to at most",
        "come comes come to no more than",
        "measure measures measured at most",
        "stay stays stayed at or below",
    ),
}
"""Verbs with a number: their base, third person and participle, and what follows."""

_DENIED_VERBS = {
    ">": (*_VERBS[">"][:6], "rise rises risen above", "get gets got above"),
    "<": ("fall falls fallen (below|under)", "drop drops dropped below"),
    ">=": (*_VERBS[">="][:5], "come comes come up to"),
}
"""Verbs that 'not' may stand before."""


def _forms(verbs: Mapping[str, Sequence[str]], form: int) -> dict[str, str]:
    table = {}
    for sign, entries in verbs.items():
        parts = [entry.split(" ", 3) for entry in entries]
        table[sign] = f"({'|'.join(' '.join([part[form], *part[3:]]) for part in parts)})"
    return table


SLOTS: Slots = {
    "comparison": COMPARISONS,
    "not_comparison": UNDENIED,
    "more_than": MORE_THAN,
    "or_more": OR_MORE,
    "exceed": _forms(_VERBS, 0),
    "exceeds": _forms(_VERBS, 1),
    "exceeded": _forms(_VERBS, 2),
    "not_exceed": _forms(_DENIED_VERBS, 0),
    "not_exceeds": _forms(_DENIED_VERBS, 1),
    "not_exceeded": _forms(_DENIED_VERBS, 2),
    "go": {
        ">": "(exceed|pass|go over|go past|go beyond|get above|surpass)",
        "<": "(stay under|stay below|stay short of|keep below|keep under|fall below)",
        ">=": "(reach|hit|get to|get up to|attain)",
    },
    "gone": {
        ">": "(exceeded|passed|gone over|gone past|gone beyond|got above|surpassed)",
        "<": "(stayed under|stayed below|kept below|fallen below)",
        ">=": "(reached|hit|got to|attained)",
    },
    "not_more": {
        ">": "(more than|more than|over|above|beyond)",
        "<": "(less than|under|below)",
        ">=": "at least",
    },
    "exceeding": {
        ">": "(exceeding|going over|going past|going beyond|passing|past|over|above|beyond)",
        "<": "(below|under|short of|falling short of|staying under|staying below)",
        ">=": "(reaching|hitting|at or above|getting to)",
    },
    "passed": {
        ">": "(exceeded|exceeded|passed|surpassed|topped|overshot|overstepped|gone past)",
        ">=": "(reached|reached|attained|hit|achieved|arrived at)",
    },
    "denied": {DENIED: ""},
    "not": {DENIED: "not"},
    "never": {DENIED: "(never|not|not|not yet)"},
    "now": "[already|already|still|still|now|really|actually|indeed|currently|definitely|clearly]",
    "or_not": (
        "(or not|or not|, or not|yet|already|by now|, yes or no|, yes or no|, true or false|or no|or is it not|"
        ", can you say|, do you think|, would you say|, do you reckon|, can you check|"
        ", please check|, right|, yes|, please confirm|, could you confirm)"
    ),
    "claim": "({whether}|{whether}|{believe}|{verdict}|{verdict}|)",
    "verdict": (
        "([please] (confirm|verify|double-check|make sure|check) [that]|"
        "[please] (confirm|verify|double-check|see|test|determine) (whether|if)|"
        "(true or false|yes or no|right or wrong|just yes or no|true or not) [:|,]|"
        "is it (fair|right|correct|safe|true|accurate) [to say] that|"
        "would it be (fair|right|correct|safe|true|accurate) to say that|"
        "(can|could|may|would) (we|I|you) (say|claim|conclude|confirm|agree) that|"
        "could it be that|I take it [that]|(say|answer|reply|tell me) yes (if|when)|"
        "is it a fact that|does it look [to you] like|do you reckon [that]|"
        "am I right [in thinking] that|does the sensor (say|show|tell us) that|"
        "do your readings (say|show) that|(please|) tell me yes or no , (is it so that|whether)|"
        "I want to be sure that|someone (says|claims) that|any chance that|so|"
        "do we know (if|whether)|I am not sure (if|whether)|I need you to confirm that|"
        "assure me that|is there evidence that|have you noticed (if|whether)|"
        "I want to know (if|whether)|we need to know (if|whether)|"
        "it matters (if|whether)|can you see (if|whether)|judge (if|whether)|say (if|whether))"
    ),
    "false": (
        "((is it|would it be) (false|untrue|incorrect|wrong) (that|to say that|"
        "to claim that)|am I wrong (that|to think that|in saying that)|"
        "would I be wrong to say that|is the claim false that|is it a mistake to say that)"
    ),
    "sure": (
        "(, right|, right|, correct|, correct|, is that right|, is that so|, am I right|"
        ", true or false|, yes|, do you agree|, would you agree|, yes or no|, true)"
    ),
    "outside": {DENIED: "(outside|outside of|out of|not within|not in)"},
}
"""Slots of every comparison; ``slots_of`` adds the amounts."""


def slots_of(units: Sequence[str], fixed: Mapping[str, str], *, is_bare: bool = False) -> Slots:
    """Slots of a comparison with amounts.

    Args:
        units: Units by symbol, the usual one first.
        fixed: Amounts in words by number and unit ('half a newton').
        is_bare: Whether a number without a unit is in the usual one.
    """
    spans = {symbol: f"{{#t}} {UNITS[symbol]} and {{#u}} {UNITS[symbol]}" for symbol in units}
    numbers = "{#t} {unit}|{#t} {unit}|{#t} {usual_unit}"
    united = f"({numbers}|{{fixed}})" if fixed else f"({numbers})"
    return {
        **SLOTS,
        "unit": {symbol: UNITS[symbol] for symbol in units},
        "usual_unit": {units[0]: UNITS[units[0]]},
        "units": spans,
        "fixed": dict(fixed),
        "united": united,
        "amount": f"({numbers}|({{fixed}}|{{fixed}}|{{#t}}))" if is_bare else united,
        "usual": f"({{#t}} {{usual_unit}}|{{#t}} {{usual_unit}}|{'{fixed}' if fixed else '{#t}'})",
        "between": {
            BETWEEN: (
                "((between|between|somewhere between|anywhere between|in between) "
                "({#t} and {#u} {unit}|{units})|"
                "(from|in the range|in the range of|in the range from|within|inside|"
                "in the interval|anything from|within the range) {#t} (to|to|-) {#u} {unit}|"
                "{#t} (to|-) {#u} {unit}|"
                "(more than|over|above|at least) {#t} [{unit}] (and|but) (less than|under|below|at most|not more than) {#u} {unit})"
            )
        },
        "range": {
            BETWEEN: (
                "(the (range|interval|window) [of|from] ({#t} (to|-) {#u} {unit})|"
                "{#t} (to|-) {#u} {unit})"
            )
        },
    }


COMPARED = (
    "{comparison} {amount}|{comparison} {amount}|{comparison} {amount}|{amount} {or_more}|{between}"
)
"""What comes after 'the depth is', or stands for an amount: 'more than 2 N'."""

MORE = COMPARED.replace("{comparison}", "{more_than}")
"""What comes after a verb."""

NOT_MORE = "{not_more} {amount}|{not_more} {amount}|{between}"
"""What comes after a denied verb."""

NOT_COMPARED = "{not_comparison} {amount}|{not_comparison} {amount}|{between}"
"""What comes after 'the depth is not'."""


def measured_pattern(nouns: str, *, is_usual: bool = False) -> str:
    """Wordings that ask whether what is measured is more, or less, than a number.

    Args:
        nouns: What is measured, with its article.
        is_usual: Whether it is meant where only the number is named: 'is 2 N exceeded'.
    """
    passed = f"[by ({nouns})]" if is_usual else f"by ({nouns})"
    return (
        f"{{lead}} ( (is|is|isn't|was) ({nouns}) {{now}} ({COMPARED}|{{outside}} {{range}}) "
        f"[{{or_not}}] "
        f"| (is|is|was) ({nouns}) {{now}} ({COMPARED}) [{{or_not}}] "
        f"| (could|might) ({nouns}) be {{comparison}} {{amount}} [{{or_not}}] "
        f"| (does|does|doesn't|did) ({nouns}) {{now}} {{exceed}} {{amount}} [{{or_not}}] "
        f"| (has|hasn't) ({nouns}) {{now}} {{exceeded}} {{amount}} [{{or_not}}] "
        f"| {{claim}} ({nouns}) (is|is|is|was) {{now}} ({COMPARED}) [{{or_not}}|{{tag}}] "
        f"| {{claim}} ({nouns}) {{now}} {{exceeds}} {{amount}} [{{or_not}}|{{tag}}] "
        f"| {{claim}} ({nouns}) has {{now}} {{exceeded}} {{amount}} [{{or_not}}|{{tag}}] "
        f"| ({nouns}) {{now}} ({COMPARED}) [{{or_not}}|{{tag}}] "
        f"| ({nouns}) , is it {{now}} ({COMPARED}) [{{or_not}}] "
        f"| (do|did|can) (you|we) (measure|read|get|see|have|find|record|feel) "
        f"({nouns}) (of|at) {{comparison}} {{amount}} [{{or_not}}] "
        f"| (is|are|was) {{united}} {{now}} {{passed}} {passed} [{{or_not}}] "
        f"| (has|have) {{united}} {{now}} been {{passed}} {passed} [{{or_not}}] ) {{tail}} [, {{length}}]"
    )


def thing_pattern(direct: str, statements: str, bare: str) -> str:
    """Wordings that ask the same of the thing: what it does, and what is done with it.

    Args:
        direct: Questions, without their question mark.
        statements: Statements, for 'check whether'.
        bare: What may stand alone, as 'deeper than 2 mm'.
    """
    return (
        f"{{lead}} ( ({direct}) [{{or_not}}] | ({direct}) [{{or_not}}] "
        f"| {{claim}} ({statements}) [{{or_not}}|{{tag}}] "
        f"| [(would you say|do you think|do you reckon|is that|isn't (that|it|this)|would that be|so|maybe|please check :|"
        f"true or false :|yes or no :|I say|let us say|yes or no ,|quick check :|what , )] ({bare}) [{{or_not}}|{{tag}}] ) {{tail}} [, {{length}}]"
    )


def not_measured_pattern(nouns: str, *, is_usual: bool = False) -> str:
    """Wordings that ask whether what is measured is not more, or less, than a number.

    Args:
        nouns: What is measured, with its article.
        is_usual: Whether it is meant where only the number is named: 'is 2 N not reached'.
    """
    passed = f"[by ({nouns})]" if is_usual else f"by ({nouns})"
    return (
        f"{{lead}} ( is ({nouns}) {{never}} ({NOT_COMPARED}) [{{sure}}] "
        f"| (does|did) ({nouns}) {{never}} {{not_exceed}} {{amount}} [{{sure}}] "
        f"| has ({nouns}) {{never}} {{not_exceeded}} {{amount}} [{{sure}}] "
        f"| {{claim}} ({nouns}) (is|was) {{never}} ({NOT_COMPARED}) [{{sure}}] "
        f"| {{claim}} ({nouns}) isn't {{denied}} ({NOT_COMPARED}) [{{sure}}] "
        f"| {{claim}} ({nouns}) (does|did) {{not}} {{not_exceed}} {{amount}} [{{sure}}] "
        f"| {{claim}} ({nouns}) never {{denied}} {{not_exceeds}} {{amount}} [{{sure}}] "
        f"| {{claim}} ({nouns}) has {{never}} {{not_exceeded}} {{amount}} [{{sure}}] "
        f"| {{false}} {{denied}} ({nouns}) (is ({NOT_COMPARED})|{{not_exceeds}} {{amount}}) "
        f"| (is {{united}} {{never}}|has {{united}} {{never}} been) {{passed}} {passed} [{{sure}}] "
        f"| {{claim}} {{united}} (is {{never}}|are {{never}}|has {{never}} been) {{passed}} {passed} "
        f"[{{sure}}] "
        f") {{tail}}"
    )


def not_thing_pattern(direct: str, statements: str, affirmed: str) -> str:
    """Wordings that ask the same of the thing.

    Args:
        direct: Questions with ``{not}`` or ``{never}``, without their question mark.
        statements: Statements with ``{not}`` or ``{never}``.
        affirmed: Statements without, for 'is it false that'.
    """
    return (
        f"{{lead}} ( ({direct}) [{{sure}}] | {{claim}} ({statements}) [{{sure}}] "
        f"| {{false}} {{denied}} ({affirmed}) ) {{tail}}"
    )
