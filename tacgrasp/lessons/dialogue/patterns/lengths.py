"""Phrases that say how long an answer is to be."""

from __future__ import annotations

LENGTHS: dict[str, str | dict[str, str]] = {
    "length": {
        "one word": (
            "(in one word|in a single word|one word only|just one word|in a word|one word|"
            "one word please|one word will do|one word is enough|a single word|"
            "a single word will do|just a word|only one word|one-word answer|a one-word answer|"
            "a one word answer please|with one word|with a single word|"
            "(answer|reply|respond) (in|with) (one|a single|just one|only one) word|"
            "by one word [only]|"
            "(answer|reply) in a word|say it in (one|a single) word|no more than one word|"
            "not more than a word|use one word|use just one word|use a single word)"
        ),
        "word": (
            "(as briefly as you can|only the answer|keep it short|a short answer|nothing more|"
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
        "one word": (
            "((in (one|a single) word|with one word|one word|one word only|one-word answer|"
            "a one-word answer|just one word|in a word|"
            "(answer|reply|tell me) in (one|a single) word|(answer|reply) with one word) (,|:))"
        ),
        "word": (
            "((short answer|briefly|in brief|in short|very briefly|(answer|reply) briefly|"
            "as briefly as you can|keep it short|be brief) (,|:))"
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
"""Who asks for one word gets one where there is one; who asks briefly may get a number.
``first_length`` goes before a question, ``length`` and ``verdict`` after it, the latter
where yes or no is asked for."""
