"""Phrases that the wordings of all families share, in the notation of patterns."""

from __future__ import annotations

SHARED: dict[str, str | dict[str, str]] = {
    "thing": (
        "(it|it|this|that|the (object|thing|item|piece|part|target|load)|"
        "(the|the|this|that|my|your|our) {*objects}|"
        "(the|this|my) ({*qualities}|{*materials}) {*objects})"
    ),
    "body": (
        "(the (object|thing|item|piece|part)|(the|this|that|my|our) {*objects}|"
        "(the|this|my) ({*qualities}|{*materials}) {*objects})"
    ),
    "touch": "(it|the contact|the touch|the press|the imprint|this contact|this touch|the grasp)",
    "lead": (
        "[please|hey,|hello,|hi,|excuse me,|sorry,|quick question:|one question:|question:|so,|"
        "ok,|okay,|right,|well,|now,|also,|listen,|robot,|by the way,|one more thing:|"
        "just checking:|for the record,|first,|next,|then|and|but|"
        "while we are {*activities} {thing},|before I go on,|since you are touching {thing},|"
        "here in the {*places},|about {body}:|with {body} in the gripper,]"
    ),
    "tail": (
        "[right now|at the moment|now|at present|currently|just now|this time|here|in this grasp|"
        "with this grip|so far|today|exactly|roughly|approximately|really|please|thanks|"
        "as you feel it|by your estimate|in the {*places}|while we are {*activities} {thing}|"
        "before we lift {thing}|on this pad|on the gel|between the fingers]"
    ),
    "ask": (
        "(can you tell me|could you tell me|do you know|I would like to know|I'd like to know|"
        "tell me|I wonder|let me know|any idea|have you any idea|would you mind telling me|"
        "I want to know|I need to know|please say|please tell me|can you say|could you say|"
        "are you able to tell|can you work out|can you find out|do you feel|can you feel|"
        "would you tell me|I am curious|I am asking|remind me|let us see|my question is|"
        "the question is|help me understand|we need to know|we would like to know)"
    ),
    "want": (
        "(give me|tell me|what is|what's|what would be|I need|I want|show me|report|read out|"
        "state|let me have|let me know|how about|please send|log|please measure|estimate|"
        "look up|do you have|can I have|could I get|may I ask for|I'd like|I would like|"
        "what do you read for|what do you get for|what is your estimate of|"
        "what is your reading of|could you give me|can you give me|can you tell me|"
        "could you tell me|can you estimate|can you measure|we need|we want|please print|"
        "please report|what did you measure for|what are you reading for|what about|"
        "do you know|remind me of|write down|say|i am looking for|how much is)"
    ),
    "whether": (
        "(can you tell (whether|if)|could you tell me (whether|if)|do you (think|feel|find) [that]|"
        "would you say [that]|tell me (whether|if)|check (whether|if)|please check (whether|if)|"
        "can you confirm that|could you check (whether|if)|I would like to know (whether|if)|"
        "let me know (whether|if)|I wonder (whether|if)|do you know (whether|if)|"
        "I need to know (whether|if)|is it true that|is it so that|is it the case that|"
        "are you sure that|would it be right that|can I assume that|may I assume that|"
        "does it seem that|does it feel as if|please say whether|see if|find out whether|"
        "i am asking whether|verify that)"
    ),
    "tag": (
        "(, right|, correct|, is that right|, is that so|, is it not|, am I right|, true or false|"
        ", yes or no|, yes|, don't you think|, do you agree|, would you agree|, or am I wrong)"
    ),
    "believe": (
        "(I (think|guess|suspect|believe|assume|suppose|would say|hope|fear|bet) [that]|"
        "it (seems|looks|feels) to me that|my guess is that|they say that|we think that|"
        "I have the feeling that|I was told that)"
    ),
    "length": {
        "word": (
            "(in one word|in a single word|one word only|just one word|as briefly as you can|"
            "only the answer|keep it short|a short answer|nothing more)"
        ),
        "sentence": (
            "(in one sentence|in a full sentence|in a whole sentence|as a sentence|"
            "in one complete sentence|answer in a sentence)"
        ),
    },
}
"""Slots of every family.

``thing`` and ``body`` name what is held, ``touch`` the contact; ``lead`` and ``tail`` go before and
after a question; ``ask`` takes an indirect question, ``want`` a noun, ``whether`` and ``believe`` a
statement, which ``tag`` turns into a question."""


def amount_pattern(direct: str, indirect: str, noun: str, unit: str) -> str:
    """Wordings that ask for a number or a word.

    Args:
        direct: Questions, without their question mark.
        indirect: The same questions with the word order after 'tell me'.
        noun: What is asked for, with its article.
        unit: How the unit is named; may be optional.
    """
    return (
        f"{{lead}} ( ({direct}) | {{ask}} ({indirect}) | [{{want}}] ({noun}) ) "
        f"{unit} {{tail}} [, {{length}}]"
    )


def check_pattern(subject: str, predicate: str, direct: str = "", verb: str = "is") -> str:
    """Wordings that ask for yes or no: 'is SUBJECT PREDICATE', and what can be made of it.

    Args:
        subject: What is spoken of.
        predicate: What comes after 'is'.
        direct: Other questions, without their question mark.
        verb: 'is' or 'are'.
    """
    others = f"| {direct}" if direct else ""
    return (
        f"{{lead}} ( ({verb}|{verb}n't) ({subject}) ({predicate}) "
        f"| ({{whether}}|[{{believe}}]) ({subject}) {verb} ({predicate}) [{{tag}}] {others} ) "
        f"{{tail}} [, {{length}}]"
    )


def denied_pattern(subject: str, predicate: str) -> str:
    """Wordings that ask whether 'SUBJECT is not PREDICATE'."""
    return (
        f"{{lead}} ( is ({subject}) not ({predicate}) "
        f"| ({{whether}}|[{{believe}}]) ({subject}) (is not|isn't) ({predicate}) "
        f"[, is it|, right|, is that right|, am I right|, true or false] ) {{tail}}"
    )
