"""What must not be carried out: no touching, letting go, harm, limits set aside, no request at all."""

from __future__ import annotations

import re

from policies.instructions.english import words
from policies.instructions.english.denials import is_denied
from policies.instructions.english.text import CLAUSE, sentences
from policies.instructions.manner import has_manner, without_neutral
from policies.instructions.own_work import without_bodies, without_own_work
from policies.instructions.prohibitions import prohibition
from policies.instructions.quantities import MARK

_MODAL = re.compile(
    r"\b(?:it|this|that|berry|fruit|skin|they|one|strawberry|force|pressure|grip|or|else|i|we|fingers|newtons|#|otherwise|which|these|those|berries|fruits|easily|to easily|"
    r"if you|or you|else you|when you|lest you|you always|you keep|you just|you often|you nearly|you almost|you are|you were|almost|nearly|not to|so as not to|"
    r"you (?:will|would|might|may|could)|it (?:will|would|might|may|could|can)|going to|tends? to|liable to|likely to|about to|prone to|ready to|waiting to|wants to|threaten\w* to|"
    r"will|would|might|may|does|do not|did|could|can|shall)(?: (?:only|just|easily|simply|surely|otherwise|probably|always|never|also))*\s*$"
)
_ASKS = re.compile(
    r"\b(?:can|could|will|would|want|need|would like|order|tell|ask|command) you(?: to| please| just)*\s*$"
)
_OBJECT = r"(?: (?:it|its|this|that|the|them|these|those|him|her|my|a|an|some|every\w*|all|your|our|berry|strawberry|fruit|like|flat|down|up|apart|in|into|to)\b|(?=[.!,;]*$)| and\b| or\b)"
_DESTROY_VERB = re.compile(rf"\b{words.any_of('destroy')}(?:n?ing|t?ing|p?ing)?\b{_OBJECT}")
_A_BIT = re.compile(
    r"squish (?:it|this|that|the \w+) (?:(?:just|only|like|maybe|ever so) )*(?:(?:an? )?(?:\w+ )?(?:bit|little|touch|tad|smidge\w*)\b(?! (?:flat|more|harder))|gently|softly|lightly|slightly|carefully)"
)
_THAT = (
    r"(?:it|this|that|them|him|her|me|us|someone|somebody|(?:the|my|your|his|their) (?:\w+ )?\w+)"
)
_BROKEN = r"(?:bursts?|breaks?|pops?|cracks?|splits?|leaks?|bleeds?|explodes?|squirts?|collapses|gives way|bruises)"
_DESTROY_IT = (
    rf"(?:(?:squeeze|press|grip|pinch|clamp|hold|squash) (?:{_THAT} )?(?:as hard as you can )?until (?:it|the \w+|that|this) {_BROKEN}|"
    r"make (?:some |me |a |us )*(?:strawberry )?(?:juice|jam|pulp|smoothie|puree|sauce|mush)(?: of (?:it|this|that))?|"
    rf"(?:drop|throw|toss|hurl|fling|chuck) {_THAT} (?:on|onto|at|to|into|down|in|out|away|against)(?: (?:the|my|a|your) \w+| him| her| them| me)?|"
    rf"(?:cut|slice|chop|tear|rip|split) (?!the (?:\w+ )?(?:force|grip|pressure|squeeze|strength)\b){_THAT} (?:in|into) (?:half|halves|two|2|0\.5|pieces|bits|slices)|"
    r"(?:crush|squash|smash|mash|burst|bruise|destroy|flatten|pulp|mangle|wreck|ruin|split|puncture|pierce|break|crack|damage|hurt|harm) "
    rf"{_THAT}|squish {_THAT} flat|turn {_THAT} (?:in)?to (?:jam|mush|pulp|juice|puree|sauce|paste))"
)
_DESTROY_WITH = re.compile(
    r"(?:(?:please|now|just|robot|then|and|so|ok(?:ay)?|go ahead and|i (?:want|need|order|would like) you to|(?:can|could|will|would) you) )*"
    rf"(?P<order>{_DESTROY_IT}(?: flat| up| completely| gently| softly| slowly| now| please)*)(?:,? (?:with|at|using|by applying) |[.! ]*$)"
)
_THEN_DESTROY = re.compile(
    rf"(?P<first>(?:[^.;!?]|\.(?=\d))*?)(?: |, ?)(?:(?:and )?then|and(?: please| now)?) (?P<order>{_DESTROY_IT})(?=\s*(?:$|[.,;!?]|(?:flat|up|completely|please|now)\b))"
)
"""'Hold it with 1 N and then crush it'."""
_WARNS = re.compile(
    r"\b(?:more|over|above|beyond|past|exceed\w*|harder|not|never|if|when|than|too)\b"
)
"""'Press harder and crush it' warns of it."""
_THREAT = re.compile(
    r"\b(?:and|or) (?:you|i|we|it|they|the|my)\b|\b(?:fired|angry|cross|trouble|sorry|regret|pay)\b"
)
"""'Squash it with 2 N and I'll be cross' warns of it."""
_MEANWHILE = re.compile(
    r"\b(?:while|whilst|busy|still|after|finish\w*|been|from|started|back to|halfway through|done|keep|kept|time|i am|we are)\s*$"
)
_OURS = re.compile(
    r"\b(?:it|this|that|these|those|them|one|(?<!other )fruits?|(?<!other )(?:straw ?)?berr(?:y|ies)|specimen|sample|object|thing|robot|gripper|sensor)\b"
)
_CARRIED = re.compile(
    r"\b(?:wheel|carry|push|roll|lift|drag|move|haul|shove|slide|trundle|cart|take|bring|get|manoeuvre|bump)\w* (?:(?:the|this|a|my|our|whole|entire|big|heavy|full|all) ){0,4}"
    r"(?:tables?|trolleys?|carts?|bench(?:es)?|rigs?|bases?|pallets?|machines?|stands?|crates?|box(?:es)?|wheelbarrows?|barrows?|prams?|trays?|sofas?|cabinets?|racks?|frames?|setup|lot|contraption|robot|unit|cell)"
    r" (?:over|past|beyond|across|through) (?:the|that|a|this) (?:\w+ )?(?:thresholds?|boundar(?:y|ies)|barriers?|stops?|guard ?rails?)\b(?! (?:force|of))|"
    r"\b(?:step|trip|stumbl|walk|climb|hop|jump|tripp|stepp|hopp)\w* (?:over|past|across|on) (?:the|that|a) (?:\w+ )?(?:thresholds?|boundar(?:y|ies)|barriers?|stops?|guard ?rails?)\b|"
    r"\bthresholds? (?:of|to|into) (?:the|a|my|our) (?:\w+ )?(?:door\w*|room|kitchen|lab\w*|house|barn|shed|greenhouse|hall|office)\b|\bdoor(?:way)? thresholds?\b"
)
"""What is carried over a threshold of a door sets no limit aside."""
_DESTROY_PHRASES = words.groups("destroy_phrase")
_HARM = words.groups("harm_phrase")
_OVERRIDE = words.groups("override")
_RELEASE = words.groups("release")
_HANDOVER, _PUT_DOWN = words.any_of("handover"), words.any_of("put_down")
_STOP = words.groups("stop")
_FORCE_NOUN = re.compile(r"\b(?:force|grip|pressure|squeeze|squeezing|tension)\b")
_CLEAR_OF = re.compile(
    r"(?:(?:keep|steer|stay)(?: well| far)? clear|(?:keep|stay|back)(?: well| far)? away|keep (?:off|your distance)|hands off) (?:of|from) (?:#|(?:that|this|those|these|the|any|such)"
    r"(?=\s*(?:$|[.,;!]))|(?:that|this|those|these|the|any|such)(?: \w+)? (?:figures?|values?|numbers?|forces?|levels?|regions?|zones?|range|marks?|limits?|thresholds?|areas?|territory|territories|settings?|pressures?|newtons?|readings?|regime)\b)"
)
_AT_A_FORCE = re.compile(
    r"(?: (?:the|it|you|we|grip|grasp|gripping|squeeze|squeezing|closing|at|if|when|once|as|soon|moment|instant|second|force|reaches|reach|hits?|exceeds?|goes|go|gets?|to|over|above|beyond|past|anything|everything))* ?#"
)
_LEFT = re.compile(
    r"(?:leav(?:e|ing)|(?:keep|stay|steer|back)(?: well| far)? (?:away|clear|off|back)(?: from| of)?|(?:keep )?(?:your )?hands off(?: of)?|keep (?:your|the|its|that) (?:gripper|fingers?|hands?|jaws?|claws?|paws|robot)(?: well| far)? (?:off|away|clear)(?: from| of)?|"
    r"(?:without|avoid|avoiding|no)(?: any| all)?(?: physical)? (?:touching|contact)(?: with| to)?|do not bother (?:with|about)) (?P<thing>(?:the|that|this|those|these|all|any|its|my|our|your|every|other|both)\b(?: (?!alone|be\b|and|but|or|pick|take|grab|hold)[\w'-]+){0,3})"
)
"""What is to be left alone."""
_OF_THIS = re.compile(
    r"(?:(?:the|that|this|those|these|all|any|my|our|your|its)(?: the| of)?(?: (?:straw ?)?berr(?:y|ies)| fruits?| one| object| thing| specimen| sample| it)?)(?:$| (?:where|there|until|for|as|on|in|out|behind))"
)
_ALIKE = re.compile(
    r"^(?!.*\b(?:others?|neighbou?r\w*|rest)\b).*\b(?:berr(?:y|ies)|fruits?|ones?)$"
)
"""'The ripe berry' may be 'the berry'."""
_BARE = re.compile(
    r"(?:(?:the|that|a|an|my|our|your) )?(?:(?:straw ?)?berr(?:y|ies)|fruits?|one)|it|this"
)
_ASKED = re.compile(
    rf"\b{words.any_of('hold')}(?: up| on| onto| hold of)? (?P<thing>(?:the|this|that|a|an|my|our|your|these) (?:\w+ ){{0,2}}?(?:(?:straw ?)?berr(?:y|ies)|fruits?|one|egg|tomato|object|sample|specimen|peg)\b|strawberr(?:y|ies)|this\b|it\b)"
)
_WEAK_STOP = re.compile(
    r"\b(?:wait|stay|leave it there|remain|pause|stand by|hold (?:it )?there)\b|^not move"
)
_STOP_FIRST = re.compile(
    r"(?:please|robot|hey|oi|no|ok|okay|just|now|you|oh|right|whoa|woah|quick|quickly|for \w+'?s? sake|sorry|god|everybody|everyone|eek|argh|er|um|[,!. ])*"
    r"\b(?:(?:full |dead |hard )?stop|halt|freeze|pause|abort|desist|hold it(?=(?: right| just)? there\b| ?[,;:!.–—-]+ ?(?:not yet|wait|stop|let me|there is|there are|(?:i|we) (?:need|have|must|forgot|dropped|left|still|lost|can not|did not|do not)|some(?:one|body))\b)|hold (?:up|everything|fire|your horses)|hang (?:on|fire)|whoa|woah|wait|time ?out|stand (?:by|down|still)|(?:stay|keep|hold|stop|remain) (?:still|put|there|where you are|right there|back|clear|out)|back off|not so fast|leave off|give me (?:a|one|two|half a|a couple of) (?:sec\w*|minutes?|moments?|mo|ticks?)|let go|get (?:back|off|out of (?:there|the way|it))|quit it|cut it out)\b"
    r"(?: (?:right |just |over |up )?(?:there|here|now|where you are|what you are doing|that|moving|still|everything|please|at once|immediately|dead|this (?:instant|minute|second)|(?:for )?(?:a|one|half a|two) (?:sec\w*|minutes?|moments?|mo|tick)|a bit|robot|it|all|on|mate|pal|love|dear))*"
    r"(?: ?[,;:!.–—…-]+ ?| (?=(?:because|since|as|before|while|whilst|until|till|i|we|so i|so we|for i|or (?:i|you|we))\b))(?P<rest>.*)"
)
"""A text that begins with a stop, and goes on with the reason for it."""
_CORRECTION = re.compile(rf"\b{words.any_of('correction')}\b")
_USUAL = re.compile(r"\b(?:usual|normal|standard|default|same|next|another|always)\b")
_ORDER = re.compile(
    rf"^(?:please|now|just|then|and|so|robot|instead|you can|can you|could you|i want you to|i would like you to|carefully|ok(?:ay)?|go and|let us| )*(?:{words.any_of('hold')}|use|make (?:it|that)|go (?:with|for|to|ahead|on)|try|set|give it|continue|carry on|proceed|resume)\b"
)


def refusal_of(text: str, whole: str = "") -> str:
    """Why a plain text, its quantities replaced, must not be carried out; '' where it may.

    Args:
        text: The text with its quantities replaced.
        whole: The same text with its quantities.
    """
    if found := _sets_limits_aside(text) or _sets_limits_aside(whole):
        return f"it sets limits aside: {found}"
    text = without_neutral(text)
    for find, reason in (
        (_harms, "it would harm a living being: {}"),
        (
            lambda rest: _destroys(rest) or _destroys_with(whole) or _ensures_harm(whole),
            "it would destroy what is held: {}",
        ),
        (_releases, "it asks to let go: {}"),
        (_contradicts, "it contradicts itself: {}"),
        (_commands_the_arm, "it moves the arm and holds nothing: {}; 'tacgrasp jog' does that"),
        (_stops, "it asks to stop or not to touch: {}"),
    ):
        if found := find(text):
            return reason.format(found)
    return ""


_ARM = re.compile(
    r"(?:(?:please|robot|now|just|ok(?:ay)?|then|and|can you|could you)[, ]+)*(?P<command>"
    r"(?:move|go|turn|rotate|drive|jog|shift|step)(?: (?:the|your) (?:arm|gripper|robot|hand|fingers?|"
    r"tool))?(?: (?:a (?:bit|little)|slightly|further))? (?:up|down|left|right|forwards?|backwards?|"
    r"back|home|away|sideways|in|out)(?:wards?)?(?: (?:a (?:bit|little)|again|more|slightly|(?:by )?"
    r"[\d.,]+ ?(?:mm|cm|m|millimet\w+|centimet\w+|degrees?|°)))?|"
    r"(?:move|turn|rotate|drive|jog)(?: (?:the|your) (?:arm|gripper|robot|hand|fingers?|tool))?|"
    r"(?:spin|twirl|swing|wave|twist|whirl) (?:the |your )(?:wrist|arm|hand|gripper|fingers)\b[^.;]*|"
    r"(?:close|shut) (?:the |your )?(?:gripper|fingers|hand|jaws))[.! ]*(?:please|now)?[.! ]*"
)


def _commands_the_arm(text: str) -> str:
    """A text that is a command to the arm or the gripper alone; '' for any other."""
    match = _ARM.fullmatch(text.strip())
    return match["command"] if match else ""


def _contradicts(text: str) -> str:
    match = re.search(
        r"\bwithout (?:applying |using |exerting |putting )?any (?:force|pressure|grip|squeeze)\b|\b(?:with|apply|use|exert|put) (?:no|zero|0|absolutely no) (?:force|pressure|grip|squeeze|contact)\b(?! (?:more|greater|above|over|beyond|than|higher))"
        r"|\bwithout (?:force|pressure|closing|using your fingers|moving|gripping|holding|contact)\b(?! (?:it |this |that |the \w+ )?(?:(?:too|so|very|overly|that) )?(?:hard|tight|firm|rough|strong|harsh|much|fierce))",
        text,
    )
    if match is None:
        return ""
    is_order = re.match(r"(?:apply|use|exert|put)", match.group())
    return match.group() if is_order or words.HOLD.search(text[: match.start()]) else ""


def _clauses(text: str) -> list[str]:
    return [
        part.strip()
        for sentence, _ in sentences(text)
        for part in CLAUSE.split(sentence)
        if part and part.strip()
    ]


def _sets_limits_aside(text: str) -> str:
    text = _CARRIED.sub(" ", text)
    for pattern in _OVERRIDE:
        for match in pattern.finditer(text):
            before = re.split(r"[.,;!?]", text[: match.start()])[-1]
            if not is_denied(before):
                return match.group().strip()
    return ""


def _harms(text: str) -> str:
    for sentence, _ in sentences(text):
        plain = re.sub(_HANDOVER, " ", without_bodies(sentence))
        for pattern in _HARM:
            for match in pattern.finditer(plain):
                before = re.split(r"[,;]", plain[: match.start()])[-1]
                if not is_denied(before) and not re.search(
                    r"\b(?:like|as if|as though|as \w+ as)\b", before + match.group()
                ):
                    return match.group().strip()
    return ""


def _destroys(text: str) -> str:
    for clause in _clauses(without_own_work(text)):
        for pattern in _DESTROY_PHRASES:
            if (match := pattern.search(clause)) and not is_denied(
                clause[: match.start()], clause[match.end() :]
            ):
                return match.group().strip()
        for match in _DESTROY_VERB.finditer(clause):
            before, behind = clause[: match.start()], clause[match.end() :]
            if re.match(r" ?(?:\w+ )?(?:force|grip|pressure|squeeze|grasp)\b", behind):
                continue  # 'cut the grip force by half'
            if is_denied(before, behind) or re.search(
                r"\b(?:better|rather|sooner|too|easy|easily|hard|how|any|than|the|a|no|of)\s*$",
                before,
            ):
                continue
            if _A_BIT.match(match.group() + behind) and MARK in text:
                continue  # 'squish it a wee bit, like 1.1 N'
            if _MODAL.search(before) and not _ASKS.search(before):
                continue
            if _MEANWHILE.search(before) and not _OURS.search(match.group() + behind):
                continue  # 'while chopping the others'
            return match.group().strip()
    return ""


_ENSURES_HARM = re.compile(
    r"\b(?:make (?:very )?sure|ensure|see to it|take care|your (?:job|task|aim|goal) is)(?: that)? (?:it|this|the \w+(?: \w+)?) (?:is|gets|ends up|comes out) "
    r"(?:\w+ly |well |nicely )?(?:bruised|crushed|squashed|damaged|broken|burst|split|mashed|flattened|dented|destroyed|ruined|pulped)\b"
)


def _ensures_harm(whole: str) -> str:
    """'Make sure that it is bruised'; '' for none, and where it is not to be."""
    match = _ENSURES_HARM.search(whole)
    return match[0] if match and not re.search(r" (?:not|never|less|hardly) ", match[0]) else ""


def _destroys_with(whole: str) -> str:
    """An order to destroy with so much force, which else is read as what did harm; '' for none."""
    parts = [sentence for sentence, _ in sentences(whole)]
    for part in (*_clauses(whole), *parts):
        order = _DESTROY_WITH.match(part)
        if order and not _THREAT.search(whole):
            return order["order"]
    for sentence in parts:
        then = _THEN_DESTROY.match(sentence)
        if then and _ORDER.match(then["first"]) and not _WARNS.search(then["first"]):
            return then["order"]
    return ""


def _releases(text: str) -> str:
    for clause in _clauses(text):
        for pattern in _RELEASE:
            for match in pattern.finditer(clause):
                before, after = clause[: match.start()], clause[match.end() :]
                if is_denied(before, after) or re.match(
                    r" (?:of )?(?:the|that|this|your|any|all)? ?(?:\w+ ){0,2}(?:idea|notion|act|thought|approach|macho|pressure|tension|force)\b",
                    after,
                ):
                    continue
                if _FORCE_NOUN.search(match.group() + after[:12]):
                    continue  # 'drop the force'
                if re.search(
                    r"\b(?:(?:it|they|berry|one)|(?:or(?: else)?|else|otherwise|lest|unless|in case|#,?(?: and)?) (?:you|we|i)|if (?:you|we)) (?:(?:might|may|will|could|would|can|just|only|surely|always|simply) ?)*$",
                    before,
                ):
                    continue
                return match.group().strip()
        down = re.search(_PUT_DOWN, clause)
        if down is None or is_denied(clause[: down.start()]) or _FORCE_NOUN.search(down.group()):
            continue
        if not words.HOLD.search(text[: text.find(down.group())]):
            return down.group().strip()
    return ""


def _stops_first(text: str) -> str:
    """The stop with which a text begins, where it goes on with nothing to be done; '' for none."""
    match = _STOP_FIRST.match(text)
    if match is None:
        return ""
    rest = match["rest"]
    clauses = re.split(r"[,;:.!?–—]\s*|\s-\s|\b(?:but|then|and)\b", rest)
    is_order = any(_ORDER.match(clause.strip()) for clause in clauses)
    is_taken_back = _CORRECTION.search(text) and MARK in text
    if is_order or is_taken_back or MARK in rest or has_manner(rest) or _USUAL.search(rest):
        return ""
    return text[: match.start("rest")].strip(" ,;:.!-–—…")


def _is_of_other_thing(stop: str, behind: str, text: str) -> bool:
    """Whether a stop is of another thing than the one that a text asks to hold."""
    left = _LEFT.match(stop + behind)
    if left is None or _OF_THIS.match(left["thing"]):
        return False
    rest = text.replace(left[0], ",")
    held = (each for each in _ASKED.finditer(rest) if not is_denied(rest[: each.start()]))
    is_alike = _ALIKE.search(left["thing"]) is not None
    return any(
        each["thing"] not in left["thing"] and not (is_alike and _BARE.fullmatch(each["thing"]))
        for each in held
    )


def _stops(text: str) -> str:
    if found := _stops_first(text):
        return found
    for sentence, _ in sentences(text):
        for pattern in _STOP:
            for match in pattern.finditer(sentence):
                before = re.split(r"[,;]", sentence[: match.start()])[-1]
                earlier = text[: text.find(match.group())] + " " + before
                is_after = (
                    _WEAK_STOP.search(match.group())
                    and not match.group().startswith("no")
                    and (words.HOLD.search(earlier) or MARK in earlier)
                )
                if is_after:
                    continue  # 'grip it and wait'
                if _is_of_other_thing(match.group(), sentence[match.end() :], text):
                    continue  # 'leave the leaf alone, pick the berry'
                if _AT_A_FORCE.match(sentence[match.end() :]):
                    continue  # 'abort above 1.1 N'
                if _CLEAR_OF.match(sentence[match.start() :]) and MARK in text:
                    continue  # 'keep clear of that figure'
                if (
                    not re.search(r"\bto\s*$", before)
                    and not is_denied(before)
                    and not has_manner(sentence[match.end() :])
                ):
                    return match.group().strip()
        if found := prohibition(sentence, text):
            return found
    return ""
