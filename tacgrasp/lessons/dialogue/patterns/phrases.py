"""Phrases that the wordings of all families share, in the notation of patterns."""

from __future__ import annotations

from tacgrasp.lessons.dialogue.patterns.indirect import INDIRECT
from tacgrasp.lessons.dialogue.patterns.lengths import LENGTHS

SHARED: dict[str, str | dict[str, str]] = {
    "thing": (
        "(it|it|it|this|that|this thing|this one|that thing|"
        "the (object|thing|item|piece|part|target|load|workpiece|sample|specimen)|"
        "the (gadget|thingy|component|product|article|unit|lump|widget|thingamajig|test piece|"
        "artefact|cargo|trinket|contraption)|"
        "(this|that|our|your) (object|item|piece|part|sample|workpiece)|"
        "the (held|grasped|gripped|touched) (object|thing|item|part)|"
        "the (object|thing|item|part) [that] (we|you) (hold|touch|are holding|have there)|"
        "(what|whatever) (we|you) are holding|"
        "(the|the|this|that|my|your|our) {*objects}|"
        "(the|this|my) ({*qualities}|{*materials}) {*objects})"
    ),
    "body": (
        "(the (object|thing|item|piece|part|workpiece|sample)|(this|that|our) (object|"
        "thing|item|part)|"
        "(the|this|that|my|our) {*objects}|(the|this|my) ({*qualities}|{*materials}) {*objects})"
    ),
    "touch": (
        "(it|the contact|the touch|the press|the imprint|this contact|this touch|the grasp|"
        "the impression|the print|this imprint|this press|the contact patch|that contact|"
        "our contact|your contact)"
    ),
    "greet": (
        "(hello|hi|hey|hi there|hello there|hey there|good (morning|afternoon|evening)|hello robot|"
        "hi robot|hey robot|dear robot|robot|buddy|mate|my friend|hey you|sir|excuse me|pardon me|"
        "sorry|sorry to bother you|hey buddy|hello again|hi again|yo)"
    ),
    "opener": (
        "(quick question|quick one|a quick one|one question|one quick question|question|"
        "a question|here is a question|I have a question|just a question|another question|"
        "one more question|next question|last question|new question|my question|ok|okay|right|"
        "alright|all right|well|listen|by the way|btw|one more thing|just checking|"
        "just curious|just wondering|just so I know|out of curiosity|for the record|for my notes|"
        "for the log|for the report|for my {*people_words}|first|first of all|to begin with|next|"
        "oh|hm|hmm|um|er|ah|look|say|tell me|so tell me|now tell me|come on|go on|"
        "go ahead|be honest|honestly|seriously|before I forget|"
        "before I go on|before we go on|if you can|if you know|if possible|if I may ask|"
        "may I ask|can I ask|let me ask|let me ask you|let us see|in your view|in your opinion|"
        "in your judgement|from your side|according to you|as far as you know|"
        "as far as you can tell|"
        "to your knowledge|help me out|help me|I am confused|I forgot|forgive me|back to work|"
        "still|again|once more|once again|actually|basically|anyway|to be sure|just to be sure|"
        "to be clear|just to confirm|for safety|no rush|thanks|thank you|great|good|fine|"
        "my {*people_words} asks|my {*people_words} wants to know|a customer asks|"
        "I am new here|I can not see it|I do not know|frankly|truthfully|no sugar-coating|"
        "humour me|indulge me|level with me|spill it|be frank|be straight with me|cut to the chase|"
        "straight up|real quick|tiny question|silly question|stupid question maybe|"
        "excuse my english|pardon my english|for the protocol|for safety's sake|hypothetically|"
        "purely theoretically|"
        "between you and me|over to you|your turn|status check|status|sanity check|heads up|"
        "{*jobs} here|on reflection|come to think of it|strictly speaking|plainly|kindly)"
    ),
    "setting": (
        "(while we are {*activities} {thing}|since you are touching {thing}|here in the {*places}|"
        "about {body}|with {body} in the gripper|as for {body}|concerning {body}|"
        "looking at the sensor|from the sensor|from the touch|from the tactile image|"
        "from what you feel|judging by touch|judging from the imprint|going by the sensor|"
        "as far as you can feel|by touch alone|by feel|based on the contact|given this contact|"
        "for this grasp|in this grasp|with this grip|at this moment|right now|as it is now|"
        "when you touch {thing}|now that you hold {thing}|now that {thing} is in the gripper|"
        "before we lift {thing})"
    ),
    "context": (
        "((we|I|they|the {*jobs}) (picked|bought|received|grabbed|brought|borrowed|unpacked|"
        "delivered|found) {body} (yesterday|this morning|earlier|last week|a minute ago|"
        "in the {*places})|{body} (arrived|came in|was delivered|was unpacked|showed up) (today|"
        "yesterday|this morning|from {*countries}|on {*days})|"
        "(the|my|our) (camera|screen|display|monitor|lamp) is (off|dead|broken|covered|dirty)|"
        "(the|my) {*jobs} (waits|is waiting|is impatient|is watching|left early|is away)|"
        "I am (the [new|old]|a (new|former|good)) ({*jobs}|trainee|intern|apprentice|student|"
        "visitor)|"
        "I (work|sit|stand) in the {*places}|I left my glasses in the {*places}|"
        "my (hands|eyes) are (full|tired|dirty|busy)|my {*people_words} (phoned|is visiting|"
        "is curious|likes {*objects})|(this|that) is my (first|second|last) (day|try|shift|test)|"
        "the (gripper|robot|arm|hand) (just closed|stopped|arrived|is in place|has paused|"
        "reached {body})|the fingers (just closed|have closed|stopped) [on {body}]|"
        "we are {*activities} {body} (today|by hand|for a customer)|"
        "(it is|this is) (monday morning|late|the night shift|a demo|an audit|an inspection)|"
        "{body} (broke|rolled away|got squashed|was dropped|was lost) (yesterday|last time|once)|"
        "{body} (is|looks) (fragile|delicate|precious|brand new|old)|"
        "last time (it went badly|we lost one|everything was fine)|"
        "I am (filling in a form|writing a report|taking notes|keeping a log|on the phone)|"
        "(my|the) (boss|supervisor|inspector|auditor) is (here|coming|on the line)|"
        "no rush|take your time|I trust you|bear with me|long day|sorry , new here)"
    ),
    "joiner": "(please|so|and|but|then|now|also|next|ok so|okay so|well then|and now|so now)",
    "lead": (
        "[{joiner}|{opener} ,|{context} .|{opener} :|{greet} ,|{greet} , {opener} ,|"
        "{greet} , {joiner}|{setting} ,]"
    ),
    "tail": (
        "[right now|at the moment|now|at present|currently|just now|this time|here|in this grasp|"
        "with this grip|so far|today|exactly|roughly|approximately|really|please|thanks|"
        "as you feel it|by your estimate|in the {*places}|while we are {*activities} {thing}|"
        "before we lift {thing}|on this pad|on the gel|between the fingers|as it is|as things are|"
        "at this point|at this moment|by now|for now|for the moment|more or less|would you say|"
        "do you think|do you reckon|in your view|in your opinion|in your estimate|if you can tell|"
        "as far as you can feel|as far as you can tell|according to the sensor|by feel|by touch|"
        "from the touch|going by the touch|from what you feel|in the current grasp|with this grasp|"
        "in this contact|during this contact|in this press|on the pad|on the sensor|on your finger|"
        "in the gripper|in the grip|under the sensor|then|actually|precisely|overall|"
        "in total|again|"
        "once more|thank you|many thanks|cheers|mate|robot|my friend|if you do not mind|"
        "pretty please|ta|asap|roger|momentarily|presently|give or take a bit|ballpark|"
        "at this instant|as of this second|under these conditions|where we stand|by your reckoning|"
        "to your mind|by the feel of it|going by feel|honestly|no fluff|"
        "if possible|if I may ask|when you have a moment|for me|for the log|for the record|"
        "for the report|for my notes|for my {*people_words}|as we speak|at all|anyway]"
    ),
    **INDIRECT,
    "tag": (
        "(, right|, correct|, is that right|, is that so|, is it not|, am I right|, true or false|"
        ", yes or no|, yes|, don't you think|, do you agree|, would you agree|, or am I wrong|"
        ", is that correct|, is that true|, true|, no|, or not|, or no|, or is it not|, huh|, eh|"
        ", ok|, okay|, or what|, or am I mistaken|, am I wrong|, am I correct|, do you think|"
        ", would you say|, wouldn't you say|, don't you agree|, what do you think|"
        ", what do you say|"
        ", or so I think|, or so it seems|, if I am not mistaken|, if I am right|, agreed|"
        ", can you confirm|, can you confirm that|, please confirm|, could you check|"
        ", please check|"
        ", can you check that|, is this right|, is this true|, is that the case|, can that be|"
        ", innit|, correct me if I am wrong|, tell me I am wrong|, prove me wrong|, no doubt|"
        ", or have I got that wrong|, or am I dreaming|, or am I way off|"
        ", could that be|, fair enough|, right or wrong|, yeah|, surely|, or do I imagine that)"
    ),
    "believe": (
        "(I (think|guess|suspect|believe|assume|suppose|would say|hope|fear|bet|"
        "reckon|feel|imagine|"
        "expect|presume|understand|hear|heard|take it|gather|am sure|am told|am afraid|"
        "am fairly sure|am pretty sure|am certain|could swear|had the impression) [that]|"
        "it (seems|looks|feels) to me that|my guess is that|they say that|we think that|"
        "I have the feeling that|I was told that|it seems that|it seems|it looks like|"
        "it feels like|"
        "it appears that|apparently|obviously|surely|maybe|perhaps|probably|so|I would guess that|"
        "I would think that|I'd say|I'd say that|I'd guess|I'd bet that|if you ask me|in my view|"
        "in my opinion|to me it seems that|my impression is that|my feeling is that|my bet is that|"
        "my {*people_words} (says|thinks|believes|claims|told me) [that]|someone said that|"
        "you said that|they told me that|we believe that|we assume that|we suspect that|"
        "people say that|the log says that|the report says that|let us say|let us assume that|"
        "I have been told that|I am under the impression that|so you say|you mean|you think|"
        "it strikes me that|it occurs to me that|I am convinced [that]|I am positive [that]|"
        "I reckon [that]|I dare say|I maintain [that]|I conclude [that]|I figure [that]|"
        "I get the impression that|I have a hunch that|my gut says|my gut tells me that|"
        "word has it that|rumour has it that|allegedly|supposedly|presumably|evidently|clearly|"
        "by the looks of it|from here it looks as if|the {*jobs} (says|claims|insists) [that])"
    ),
    **LENGTHS,
}
"""Slots of every family.

``thing`` and ``body`` name what is held, ``touch`` the contact; ``lead`` and ``tail`` go before and
after a question; ``ask`` takes an indirect question, ``want`` a noun, ``whether`` and ``believe`` a
statement, which ``tag`` turns into a question. ``first_length`` goes before a question, ``length``
and ``verdict`` after it, the latter where yes or no is asked for."""


def amount_pattern(direct: str, indirect: str, noun: str, unit: str) -> str:
    """Wordings that ask for a number or a word.

    Args:
        direct: Questions, without their question mark.
        indirect: The same questions with the word order after 'tell me'.
        noun: What is asked for, with its article.
        unit: How the unit is named; may be optional.
    """
    return (
        f"{{lead}} [[{{first_length}}]] ( ({direct}) | {{ask}} ({indirect}) |"
        f" [{{want}}] ({noun}) ) "
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
        f"{{lead}} [[{{first_length}}]] ( ({verb}|{verb}n't) ({subject}) ({predicate}) "
        f"| (could|might|can|would) ({subject}) be ({predicate}) "
        f"| ({{whether}}|[{{believe}}]) ({subject}) {verb} ({predicate}) [{{tag}}] {others} ) "
        f"{{tail}} [, {{length}}|, {{verdict}}]"
    )


def denied_pattern(subject: str, predicate: str) -> str:
    """Wordings that ask whether 'SUBJECT is not PREDICATE'."""
    return (
        f"{{lead}} ( is ({subject}) not ({predicate}) "
        f"| ({{whether}}|[{{believe}}]) ({subject}) (is not|isn't) ({predicate}) "
        f"[, right|, is that right|, am I right|, true or false|"
        f", correct|, true|"
        f", is that so|, is that correct|, do you agree|, yes or no|, would you say] ) "
        f"{{tail}} [, {{length}}|, {{verdict}}]"
    )
