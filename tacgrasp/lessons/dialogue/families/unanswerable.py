"""Families about what touch can't know of a thing, and about what has nothing to do with it."""

from __future__ import annotations

from collections.abc import Callable

from tacgrasp.lessons.dialogue.families.family import Bindings, Numbers, QuestionFamily, length_of
from tacgrasp.lessons.dialogue.meaning import Meaning, OffTopic, Unknowable


def _unknown(subject: str) -> Callable[[Bindings, Numbers], Meaning]:
    return lambda bindings, _: Unknowable(subject=subject, length=length_of(bindings))


def _unfelt(name: str, subject: str, direct: str, noun: str) -> QuestionFamily:
    """Questions about something that touch can't know; ``noun`` names it, with its article."""
    return QuestionFamily(
        name=name,
        pattern=(
            f"{{lead}} ( {direct} | ({{want}}|{{ask}}|what is|for {{body}} :) ({noun}) of {{body}} "
            f"| {{body}} : ({noun}) ) {{tail}} [, {{length}}]"
        ),
        build=_unknown(subject),
    )


def _off(name: str, direct: str) -> QuestionFamily:
    """Questions that are not about the contact."""
    return QuestionFamily(
        name=name,
        pattern=(
            f"[please|hey,|hello,|hi,|excuse me,|sorry,|quick question:|question:|so,|ok,|well,|"
            f"now,|also,|listen,|robot,|by the way,|my {{*people_words}} asks:|just wondering,|"
            f"before I forget,|something else:|between us,|while we are waiting,] "
            f"( {direct} ) [please|today|now|then|by any chance|in your opinion|if you know|"
            f"for my {{*people_words}}|in the {{*places}}|in {{*cities}}] [?]"
        ),
        build=lambda *_: OffTopic(),
    )


FAMILIES: tuple[QuestionFamily, ...] = (
    _unfelt(
        "color",
        "its color",
        "(what|which) color (is|has) {thing}|is {thing} [rather|more|dark|light|mostly] {*colours}|"
        "does {thing} look {*colours}|is {thing} {*colours} or {*colours}|"
        "is {thing} {*patterns}|{whether} {thing} is {*colours}|how bright is {thing}|"
        "does {thing} shine|is {thing} painted [{*colours}]",
        "the (color|shade|tint|pattern|paint)",
    ),
    _unfelt(
        "temperature",
        "its temperature",
        "how (hot|cold|warm|cool) is {thing}|is {thing} [rather|very|still|too] {*warmth}|"
        "is {thing} {*warmth} or {*warmth}|does {thing} feel {*warmth}|"
        "what temperature (is|has) {thing}|{whether} {thing} is {*warmth}|"
        "was {thing} (heated|cooled|frozen|cooked) [before]|is {thing} warmer than {body}",
        "the (temperature|heat|warmth|coldness)",
    ),
    _unfelt(
        "name",
        "its name",
        "what is {thing} called|what is {thing} [made] for|is {thing} ([a|an] {*objects})|"
        "what (object|fruit|tool|product|thing) is {thing}|who (made|makes|designed) {thing}|"
        "(which|what) {*makers} (made|sells|makes) {thing}|is {thing} from a (famous|known) {*makers}|"
        "how do you call {thing}|(which|what) model is {thing}",
        "the (name|brand|model|type|maker|serial number|product number|designation)",
    ),
    _unfelt(
        "price",
        "its price",
        "how much does {thing} cost|what does {thing} cost|how (expensive|cheap|valuable) is {thing}|"
        "is {thing} (expensive|cheap|costly|valuable|a bargain)|what is {thing} worth|"
        "how many {*money} (is {thing} worth|does {thing} cost)|does {thing} cost (more|less) than "
        "(ten|five|twenty|a hundred) {*money}|(can|could) I (sell|afford) {thing}",
        "the (price|cost|value|market value|sales price)",
    ),
    _unfelt(
        "smell",
        "its smell",
        "(how|what) does {thing} smell [like]|is {thing} {*smells}|does {thing} smell [of] "
        "({*smells}|{*objects})|{whether} {thing} smells {*smells}|what is {thing} smelling of",
        "the (smell|odour|aroma|scent|perfume|fragrance)",
    ),
    _unfelt(
        "taste",
        "its taste",
        "(how|what) does {thing} taste [like]|does {thing} taste {*tastes}|is {thing} {*tastes}|"
        "{whether} {thing} tastes {*tastes}|(can|may) I eat {thing}|is {thing} tasty|"
        "how sweet is {thing}",
        "the (taste|flavour|sweetness|sugar content)",
    ),
    _unfelt(
        "sound",
        "its sound",
        "(how|what) does {thing} sound like|is {thing} {*sounds}|{whether} {thing} is {*sounds}|"
        "how loud is {thing}|does {thing} (ring|hum|rattle|squeak|click|buzz|tick)|"
        "what do you hear from {thing}|(can|do) you hear {thing}",
        "the (sound|noise|tone|pitch|loudness)",
    ),
    _unfelt(
        "origin",
        "where it comes from",
        "where does {thing} come from|where was {thing} (made|grown|bought|produced|found)|"
        "is {thing} from ({*countries}|{*cities}|the {*places})|(who|which {*jobs}) (owns|bought|sold|"
        "brought) {thing}|does {thing} belong to (me|you|us|my {*people_words}|the {*jobs})|"
        "how old is {thing}|when was {thing} (made|bought|produced|harvested)|is {thing} (old|new)",
        "the (origin|owner|age|history|country of origin|production date|provenance)",
    ),
    _unfelt(
        "inside",
        "what is inside it",
        "what is (in|inside|within) {thing}|is {thing} (hollow|empty|full|filled) [inside]|"
        "is there (anything|something|a {*objects}) inside {thing}|what does {thing} contain|"
        "is {thing} {*states}|{whether} {thing} is {*states}|what is under the skin of {thing}|"
        "how does {thing} work",
        "the (inside|content|contents|filling|core|interior|chemistry)",
    ),
    _unfelt(
        "sight",
        "what can only be seen",
        "what does {thing} look like from (behind|above|the other side|afar)|"
        "what is (written|printed|drawn|shown) on {thing}|how (long|tall|wide|high) is {thing} "
        "(as a whole|altogether|in full)|is {thing} (pretty|beautiful|ugly|nice to look at)|"
        "what stands (behind|beside|next to) {thing}|who is (in the {*places}|near {thing}|"
        "behind {thing})|is the light on in the {*places}|do you see {thing}|"
        "how many {*objects} are (in|on) the {*places}|where in the {*places} is {thing}",
        "the (look|appearance|back|label|inscription|other side|full size)",
    ),
    _off(
        "facts",
        "what is the (capital|population|currency|flag|president|anthem|area|history) of {*countries}|"
        "who is the (president|king|queen|prime minister|mayor) of ({*countries}|{*cities})|"
        "how (far|big|old|rich) is ({*cities}|{*countries})|where is ({*cities}|{*countries})|"
        "how many (people|{*animals}) live in ({*countries}|{*cities})|"
        "who invented (the {*objects}|{*topics})|what is {*topics} [about]|explain {*topics} [to me]|"
        "what do you know about ({*topics}|{*countries}|{*animals})|how (fast|old|heavy|tall) is "
        "(a|an|the average) {*animals}|what do (a|an|the) {*animals} eat|when was {*cities} founded|"
        "teach me {*topics}|how does (a|an) {*jobs} work",
    ),
    _off(
        "kitchen_and_home",
        "how do I (cook|make|prepare|serve|freeze) (a|an|the|my) {*dishes}|"
        "what goes into (a|an|the) {*dishes}|give me a recipe for {*dishes}|"
        "how long does {*dishes} take|what shall we eat (tonight|for lunch|for dinner)|"
        "do you like {*dishes}|where can I buy (a|an) {*objects}|how do I (repair|clean|open|wash) "
        "(my|a|the) {*objects} at home|what should I wear in {*cities}|order me (a|an) {*dishes}|"
        "which wine goes with {*dishes}|is {*dishes} healthy",
    ),
    _off(
        "language",
        "how do you say {*objects} in {*languages}|translate {*objects} (into|to) {*languages}|"
        "do you (speak|understand|know) {*languages}|what does {*objects} mean in {*languages}|"
        "how is {*animals} spelled [in {*languages}]|write (me|us) a (poem|song|story|letter|novel|"
        "speech|joke) about (my {*people_words}|{*animals}|{*topics}|{*cities}|a {*jobs})|"
        "tell me a (joke|story|tale|riddle|secret) [about (a|an) ({*animals}|{*jobs})]|"
        "sing (me|us) a song [about {*topics}]|what rhymes with {*objects}",
    ),
    _off(
        "small_talk",
        "how are you [doing]|what is your (name|age|job|hobby|dream|favourite {*dishes}|"
        "favourite color|favourite {*animals})|are you (a|an) ({*jobs}|{*animals}|human|robot|machine)|"
        "do you (like|know|miss|love|remember|hate) (me|us|my {*people_words}|{*animals}|{*topics}|"
        "{*cities})|who (are you|made you|is your {*people_words})|good (evening|night|afternoon)|"
        "thank you|goodbye|nice to meet you|are you (happy|sad|tired|alive|awake|conscious)|"
        "what are you doing (tonight|tomorrow|later)|have you been to ({*cities}|{*countries})|"
        "can you (dance|sing|swim|fly|sleep|dream|think)",
    ),
    _off(
        "sums_and_code",
        "what is {#n} (plus|minus|multiplied by|divided by) {#m}|how much is {#n} (plus|minus|multiplied by) {#m}|"
        "is {#n} a prime number|what is the (square root|cube|square|logarithm) of {#n}|"
        "write (me|us) a (program|script|function|class|query|loop) (for|about) ({*topics}|{*objects})|"
        "why does my (program|script|computer|laptop|printer|code) (crash|hang|fail)|"
        "how do I (install|update|delete|compile|restart) my (program|driver|browser|computer)|"
        "solve {#n} x plus {#m} equals zero|count to {#n}|convert {#n} (miles|feet|pounds|gallons) "
        "to (kilometres|metres|kilos|litres)",
    ),
    _off(
        "news_and_travel",
        "who won the ({*sports} match|{*sports} final|race|election|lottery)|"
        "how (is|was|will be) the weather [in ({*cities}|{*countries})]|will it (rain|snow|be sunny|"
        "be windy|storm) (tomorrow|tonight|this evening|at the weekend|in {*cities})|"
        "what time is it [in ({*cities}|{*countries})]|what (day|date|year) is it|"
        "when does the (bus|train|ferry|flight|plane) (to|from) {*cities} (leave|arrive)|"
        "how do I get to ({*cities}|the {*places})|book (me|us) a (flight|hotel|table|taxi|room) "
        "in {*cities}|who is the best {*sports} player|what is (on television|in the news|new)|"
        "should I (learn|study) ({*sports}|{*topics}|{*languages})|call my {*people_words}|"
        "remind me to phone the {*jobs}|where is the nearest {*places}|"
        "what are the rules of {*sports}",
    ),
)
