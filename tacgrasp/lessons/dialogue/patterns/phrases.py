"""Phrases that the wordings of all families share, in the notation of patterns."""

from __future__ import annotations

SHARED: dict[str, str | dict[str, str]] = {
    "thing": (
        "(it|it|it|this|that|this thing|this one|that thing|"
        "the (object|thing|item|piece|part|target|load|workpiece|sample|specimen)|"
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
        "I am new here|I can not see it|I do not know)"
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
    "joiner": "(please|so|and|but|then|now|also|next|ok so|okay so|well then|and now|so now)",
    "lead": (
        "[{joiner}|{opener} ,|{opener} :|{greet} ,|{greet} , {opener} ,|"
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
        "if possible|if I may ask|when you have a moment|for me|for the log|for the record|"
        "for the report|for my notes|for my {*people_words}|as we speak|at all|anyway]"
    ),
    "ask": (
        "(can you tell me|could you tell me|do you know|I would like to know|I'd like to know|"
        "tell me|I wonder|let me know|any idea|have you any idea|would you mind telling me|"
        "I want to know|I need to know|please say|please tell me|can you say|could you say|"
        "are you able to tell|can you work out|can you find out|do you feel|can you feel|"
        "would you tell me|I am curious|I am asking|remind me|let us see|my question is|"
        "the question is|help me understand|we need to know|we would like to know|"
        "just tell me|do tell me|kindly tell me|please let me know|will you tell me|"
        "could you please tell me|can you please tell me|would you please tell me|"
        "could you let me know|can you let me know|could you kindly tell me|"
        "can you figure out|could you work out|could you find out|could you check|can you check|"
        "please check|check|figure out|work out|find out|say|show me|do you have any idea|"
        "got any idea|any clue|have you got an idea|do you happen to know|would you happen to know|"
        "do you by any chance know|would you know|might you know|are you able to say|"
        "is it possible to say|is it possible to know|can one tell|can we tell|can it be told|"
        "I have no idea|I do not know|I can not tell|I am not sure|I am unsure|I was wondering|"
        "I am wondering|just wondering|I keep wondering|I ask myself|I want you to tell me|"
        "I would love to know|I would be glad to know|I would be interested to know|"
        "I am interested in|I must know|I have to know|I should know|we have to know|we wonder|"
        "we want to know|my {*people_words} wants to know|my {*people_words} asks|"
        "the customer wants to know|they want to know|someone asks|explain to me|explain|"
        "please explain|can you explain|can you sense|do you sense|can you guess|guess|"
        "can you judge|could you judge|can you determine|please determine|determine|"
        "could you determine|please estimate|could you estimate|can you measure|tell us|"
        "can you tell us|can you tell|could you tell|could you feel|from touch can you tell|"
        "give me an idea of|I forgot|I need you to tell me|what I want to know is|"
        "what I need to know is|what interests me is|all I want to know is)"
    ),
    "want": (
        "(give me|tell me|what is|what's|what would be|I need|I want|show me|report|read out|"
        "state|let me have|let me know|how about|please send|log|please measure|estimate|"
        "look up|do you have|can I have|could I get|may I ask for|I'd like|I would like|"
        "what do you read for|what do you get for|what is your estimate of|"
        "what is your reading of|could you give me|can you give me|can you tell me|"
        "could you tell me|can you estimate|can you measure|we need|we want|please print|"
        "please report|what did you measure for|what are you reading for|what about|"
        "do you know|remind me of|write down|say|i am looking for|how much is|"
        "please give me|please tell me|just give me|just tell me|now give me|give us|"
        "could you please give me|would you give me|will you give me|kindly give me|"
        "could you report|can you report|could you state|can you state|please state|"
        "could you measure|could you estimate|please estimate|measure|determine|"
        "please determine|can you determine|work out|figure out|find out|find|get me|get|"
        "fetch me|read me|read|please read out|can you read out|print|print out|display|output|"
        "return|provide|please provide|can you provide|supply|note down|record|please record|"
        "put down|check|please check|can you check|could you check|can you show me|"
        "could you show me|please show me|can I get|can I see|could I have|could I see|"
        "may I have|may I know|may I see|might I have|let me see|let us see|let us have|"
        "let us hear|let me hear|I would like to know|I'd like to know|I want to know|"
        "I need to know|I would like to have|I would love to have|we would like|"
        "we would like to know|we need to know|I have to know|I am interested in|"
        "I am asking for|I ask for|I was asking about|I am after|my question is about|"
        "I wonder about|I am curious about|tell me about|what was|what might be|what could be|"
        "what do you think is|what would you say is|what do you say is|what do you feel for|"
        "what do you have for|what have you got for|what did you get for|what do you measure as|"
        "what value do you have for|what is the value of|what is the reading for|"
        "what is the estimate of|what does the sensor say about|what does the sensor give for|"
        "what does the touch say about|any idea of|any idea about|any estimate of|"
        "any reading of|any word on|anything on|do you feel|can you feel|can you sense|"
        "do you measure|do you sense|do you read|do you happen to know|would you know|"
        "have you got|have you measured|did you measure|did you get|could you say|can you say|"
        "please say|please name|name|quote|specify|please specify|I forgot|once more|again|"
        "only|just|required :|needed :|wanted :|the customer wants|they want|"
        "my {*people_words} needs|my {*people_words} wants to know|for the log :|for the report :)"
    ),
    "whether": (
        "(can you tell (whether|if)|could you tell me (whether|if)|do you (think|feel|find) [that]|"
        "would you say [that]|tell me (whether|if)|check (whether|if)|please check (whether|if)|"
        "can you confirm that|could you check (whether|if)|I would like to know (whether|if)|"
        "let me know (whether|if)|I wonder (whether|if)|do you know (whether|if)|"
        "I need to know (whether|if)|is it true that|is it so that|is it the case that|"
        "are you sure that|would it be right that|can I assume that|may I assume that|"
        "does it seem that|does it feel as if|please say whether|see if|find out whether|"
        "i am asking whether|verify that|"
        "do you (believe|reckon|guess|suppose|suspect|sense|notice|agree|see) [that]|"
        "can you (feel|sense|see|say|check|verify|find out|work out|determine|judge) (whether|if)|"
        "could you (say|check|verify|find out|confirm|determine|judge) (whether|if)|"
        "can you tell me (whether|if)|could you please tell me (whether|if)|"
        "please tell me (whether|if)|just tell me (whether|if)|please let me know (whether|if)|"
        "I want to know (whether|if)|I'd like to know (whether|if)|we need to know (whether|if)|"
        "we would like to know (whether|if)|I was wondering (whether|if)|just wondering if|"
        "I am (not sure|unsure|curious|wondering|asking) (whether|if)|I (ask|doubt) (whether|if)|"
        "I do not know (whether|if)|I can not tell (whether|if)|the question is (whether|if)|"
        "my question is (whether|if)|any idea (whether|if)|do you happen to know (whether|if)|"
        "would you know (whether|if)|are you able to tell (whether|if)|say (whether|if)|"
        "determine (whether|if)|judge (whether|if)|find out if|work out (whether|if)|"
        "make sure that|confirm that|please confirm that|please verify that|could you confirm that|"
        "would you agree that|would you confirm that|is it right that|is it correct that|"
        "is it right to say that|is it fair to say that|is it a fact that|is it possible that|"
        "is it likely that|could it be that|can it be that|might it be that|"
        "can (I|we|one) say that|may (I|we) say that|can we assume that|should I assume that|"
        "am I right that|am I right in thinking that|am I correct that|"
        "would I be right that|are we sure that|are you certain that|are you positive that|"
        "true or false :|right or wrong :|yes or no :|"
        "does it look as if|does it look like|does it feel like|does the touch say that|"
        "does the sensor say that|does the sensor show that|do you have the impression that|"
        "do you get the feeling that|would you think that|would you guess that|"
        "my {*people_words} asks (whether|if)|my {*people_words} wants to know (whether|if))"
    ),
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
        ", could that be|, right or wrong|, yeah|, surely|, or do I imagine that)"
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
        "I have been told that|I am under the impression that|so you say|you mean|you think)"
    ),
    "length": {
        "word": (
            "(in one word|in a single word|one word only|just one word|as briefly as you can|"
            "only the answer|keep it short|a short answer|nothing more|in a word|one word|"
            "one word please|one word will do|one word is enough|a single word|"
            "a single word will do|just a word|only one word|one-word answer|a one-word answer|"
            "a one word answer please|with one word|with a single word|"
            "(answer|reply|respond) (in|with) (one|a single|just one|only one) word|"
            "(answer|reply) in a word|say it in (one|a single) word|no more than one word|"
            "not more than a word|use one word|use just one word|use a single word|"
            "briefly|very briefly|in brief|in short|short answer|short answer please|"
            "a short answer please|a brief answer|a brief answer please|a quick answer|"
            "short and sweet|short please|keep it brief|be brief|be quick|be short|"
            "make it short|make it brief|as short as possible|as short as you can|"
            "as briefly as possible|the shortest answer|just the answer|only the answer please|"
            "just the answer please|the answer only|the bare answer|nothing else|and nothing else|"
            "no explanation|no explanations|without explanation|no details|no sentence|"
            "not a sentence|no long answer|no story|no extra words|no more words|"
            "answer briefly|answer shortly|reply briefly|to the point|spare me the details|"
            "skip the details|just say it)"
        ),
        "sentence": (
            "(in one sentence|in a full sentence|in a whole sentence|as a sentence|"
            "in one complete sentence|answer in a sentence|in a sentence|in one full sentence|"
            "in one whole sentence|in a complete sentence|in a single sentence|in full sentences|"
            "in complete sentences|in whole sentences|as a full sentence|as a whole sentence|"
            "as a complete sentence|as one sentence|with a sentence|with a full sentence|"
            "with a whole sentence|with a complete sentence|with one sentence|"
            "(answer|reply|respond) (in|with) (a|one|a full|a whole|a complete|one full|"
            "one whole|one complete|a proper) sentence|"
            "(say|put|phrase|write) it (in|as) (a|one|a full|a whole|a complete|one full) sentence|"
            "a full sentence please|one sentence please|a whole sentence please|full sentence|"
            "complete sentence|whole sentence|full sentence please|one sentence|a sentence please|"
            "use a full sentence|use a whole sentence|use a complete sentence|use one sentence|"
            "use full sentences|make it a sentence|make it a full sentence|in a proper sentence|"
            "a proper sentence please|I want a full sentence|I want a whole sentence|"
            "I need a full sentence|I would like a full sentence|not just a word|not just one word|"
            "not in one word|more than one word|more than a word|and use a full sentence|"
            "spelled out in a sentence|written out in a sentence|formulate a sentence|"
            "give me a full sentence|give me a whole sentence|give me a sentence)"
        ),
    },
    "first_length": {
        "word": (
            "((in (one|a single) word|with one word|one word|one word only|one-word answer|"
            "a one-word answer|short answer|briefly|in brief|in short|very briefly|"
            "(answer|reply|tell me) in (one|a single) word|(answer|reply) (briefly|with one word)|"
            "just one word|as briefly as you can|keep it short|be brief) (,|:))"
        ),
        "sentence": (
            "((in (a|one|a full|a whole|a complete|one full|a single) sentence|as a sentence|"
            "(answer|reply|tell me) (in|with) (a|a full|a whole|a complete|one) sentence|"
            "in full sentences|in complete sentences|with a full sentence|full sentence|"
            "one sentence|use a full sentence|as a full sentence) (,|:))"
        ),
    },
    "verdict": {
        "word": (
            "(yes or no only|just yes or no|only yes or no|a simple yes or no|a plain yes or no|"
            "a yes or no|a yes or no will do|yes or no is enough|yes or no please|"
            "a simple yes or no will do|a clear yes or no|(answer|reply|"
            "respond) (with|by) yes or no|"
            "answer yes or no|(say|just say|answer|only answer|just answer|reply) yes or no|"
            "yes or no answer|yes or no answer please|a yes or no answer|please answer yes or no|"
            "no more than yes or no|nothing but yes or no|yes or no and nothing else|"
            "one word , yes or no|yes or no in one word|yes or no without explanation|"
            "a yes or a no|just a yes or a no|with a yes or a no|with yes or no|only a yes or a no|"
            "a one-word yes or no)"
        ),
        "sentence": (
            "(not just yes or no|not only yes or no|more than yes or no|not merely yes or no|"
            "do not just say yes or no|not a bare yes or no|yes or no in a full sentence|"
            "with more than yes or no|a full sentence , not just yes or no|"
            "yes or no is not enough)"
        ),
    },
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
        f"[, is it|, are they|, right|, is that right|, am I right|, true or false|"
        f", correct|, true|"
        f", is that so|, is that correct|, do you agree|, or is it|, yes or no|, would you say] ) "
        f"{{tail}} [, {{length}}|, {{verdict}}]"
    )
