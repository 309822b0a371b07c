"""Families of many subjects: any property that touch can't know, and anything beside the contact.

Not here: subjects that have wordings of their own (``traits``, ``backgrounds``, ``off_topic``).
"""

from __future__ import annotations

from tacgrasp.lessons.dialogue.families.unfelt.off_topic import off
from tacgrasp.lessons.dialogue.meaning import Unknowable
from tacgrasp.lessons.dialogue.patterns.family import QuestionFamily, length_of
from tacgrasp.lessons.dialogue.subjects import SUBJECTS

_KNOW = "(know|tell|guess|find out|judge|estimate|work out|sense|detect|determine)"

FAMILIES: tuple[QuestionFamily, ...] = (
    QuestionFamily(
        name="trait",
        pattern=(
            "{lead} [[{first_length}]] ( what is (its|the) {*properties} "
            "| what is the {*properties} of {thing} | what {*properties} has {thing} "
            "| (which|what) {*properties} does {thing} have | does {thing} have (any|some|a known) "
            "{*properties} | has {thing} got (any|a known|a good|the right) {*properties} "
            "| {ask} what (its|the) {*properties} is "
            "| {want} {possessed} "
            f"| (can|could|do) you {_KNOW} {{possessed}} "
            "| how (good|bad|high|low|important|reliable|interesting|impressive) is {possessed} "
            "| {*properties} of {thing} | its {*properties} "
            "| (what|how) about (its|the) {*properties} "
            "| is {possessed} (good|bad|high|low|known|all right|normal|better than average|"
            "worth mentioning) "
            "| {body} (:|,) {*properties} | what do you (know|say|think) about {possessed} "
            "| who (knows|checked|wrote down|set|changed) {possessed} "
            "| {whether} {thing} has (any|a known|a good) {*properties} "
            "| {believe} {thing} has (a good|a bad|a high|a low) {*properties} [{tag}] "
            ") {tail} [, {length}]"
        ),
        build=lambda bindings, _: Unknowable(subject=SUBJECTS["trait"], length=length_of(bindings)),
        slots={"possessed": "(its {*properties}|the {*properties} [of {thing}])"},
    ),
    QuestionFamily(
        name="condition",
        pattern=(
            "{lead} [[{first_length}]] ( (is|is|isn't|was) {thing} [too|very|rather|quite|a bit|still] {state} "
            "| is {thing} {state} or {state} | how {state} is {thing} | {state} or {state} "
            "| does {thing} feel [too|very|rather|quite|a bit] {state} "
            "| {whether} {thing} is [too|very|rather] {state} | {ask} how {state} {thing} is "
            "| {believe} {thing} is [too|very|rather] {state} [{tag}] "
            "| {thing} is [too|very|rather] {state} {tag} | (could|might) {thing} be {state} "
            "| (can|could) you (tell|feel) (whether|if|how) {thing} is {state} "
            "| {want} (its|the) {feature} [of {thing}] | what is (its|the) {feature} [of {thing}] "
            ") {tail} [, {length}]"
        ),
        build=lambda bindings, _: Unknowable(subject=SUBJECTS["trait"], length=length_of(bindings)),
        slots={
            "state": (
                "(wet|dry|damp|moist|sticky|slippery|slick|oily|greasy|soft|squishy|squashy|mushy|"
                "elastic|springy|rubbery|brittle|pliable|bendy|fluffy|dirty|clean)"
            ),
            "feature": (
                "(softness|hardness|stiffness|elasticity|wetness|stickiness|slipperiness|friction|"
                "friction coefficient|cleanliness|dampness)"
            ),
        },
    ),
    off(
        "subjects",
        "what (is|are) {*subjects}|what do you (think|know|say) about {*subjects}|"
        "(do|did) you (like|enjoy|believe in|understand|study|fear|miss) {*subjects}|"
        "why (is|are|do we need|do people like|does nobody like) {*subjects}|"
        "how do I (learn about|get into|avoid|survive|explain|understand) {*subjects}|"
        "where (can I|do people) (read about|find|see) {*subjects}|who (invented|likes|hates|needs|"
        "teaches) {*subjects}|when (is|was|does) {*subjects} [over|due|start]|"
        "{*subjects} or {*subjects}|{*subjects}|tell me (about|more about|something about|a story "
        "about) {*subjects}|is {*subjects} (good|bad|useful|dangerous|boring|overrated|a thing|"
        "worth it|important)|are {*subjects} (real|dangerous|useful|overrated)|"
        "have you (heard|read|thought) [anything] about {*subjects}|let us (talk|chat) about "
        "{*subjects}|I (love|hate|adore|dislike|am into|am against|dream of|am writing about) "
        "{*subjects}|my {*people_words} (loves|hates|teaches|studies) {*subjects}|"
        "does {*subjects} (matter|help|hurt|exist|make sense)|what is the (best|worst|latest|"
        "funniest) (book|film|news|joke|song) (about|on) {*subjects}|any (news|thoughts|books|"
        "opinion) on {*subjects}|how (common|popular|expensive|old) (is|are) {*subjects}",
        "what {*subjects} (is|are)|who invented {*subjects}|how {*subjects} works|"
        "whether {*subjects} (matters|is real)|about {*subjects}",
        "(write|compose|recite|print) [me] (a|an) (poem|essay|report|article|letter|speech) (about|"
        "on|against) {*subjects}|(explain|define|summarise|defend|criticise) {*subjects} [to me]|"
        "(recommend|suggest) (a|some) (book|books|film) (about|on) {*subjects}|"
        "change the subject to {*subjects}",
    ),
    off(
        "asides",
        "(can|could|will|would|do|did) you {*errands} [for me|with me|sometimes|at night]|"
        "why (do|don't) you {*errands}|have you ever tried to {*errands}|"
        "(shall|should) we {*errands} [together|tonight]|(may|can) I {*errands} [now|here|later]|"
        "do {*animals} {*errands}|does my {*people_words} {*errands}|"
        "(am I|are you|is my {*people_words}|are we all) {*ask_others}|"
        "I (want|would love|need|have) to {*errands}|let us {*errands}|"
        "who (wants|likes|has) to {*errands}|how do I stop my {*people_words} when they {*errands}|"
        "is it (rude|healthy|fun|normal) to {*errands} [in the {*places}|in {*countries}]|"
        "how (often|well|long) (do|can) you {*errands}|where do people {*errands}|"
        "{*errands} or {*errands}|do you think I am {*ask_others}|when will I be {*ask_others}",
        "how to {*errands}|why (people|{*animals}) {*errands}|whether I am {*ask_others}",
        "{*errands} [for me|with me|please|quietly|loudly]|(stop|start) and {*errands}|"
        "(go|come) and {*errands}",
    ),
)
