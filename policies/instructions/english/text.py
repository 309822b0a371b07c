"""Text of an instruction in a plain form: lower case, contractions written out, sentences apart."""

from __future__ import annotations

import html
import re
import unicodedata

_MARKS = "´‘’ʼ′‵＇ʹ`"
"""What people and keyboards write for an apostrophe."""

_STEMS = "do|does|did|is|are|was|were|have|has|had|must|should|could|would|need|might"
"""Verbs that 'n't' denies."""

_WANTED = r"(?:^|(?<=[.!;,:] ))what (?:(?:i|we|you|it|this|that|they|the (?:\w+ )?\w+) (?:(?:really|just|only) )?(?:wants?|needs?|would like|requires?|means?|meant|prefers?|asks? for|asked for|am after|must have|should have)|matters|counts)(?: (?:most|here|now|today|from you))* (?:is|was),?:?"
"""'What I want is'."""

_CONTRACTIONS = (
    (rf"\b({_STEMS}|ca|wo|sha|ai) ?n ?['\";“”] ?t\b", r"\1n't"),
    (rf"\b({_STEMS}|ca|wo|sha|ai)(?: nt|n t)\b", r"\1n't"),
    (r"\bdnt\b|\bdon(?= (?:go|exceed|use|squeeze|press|apply|let|hold|grip|be|push|put|get|take|give|make|pass)\b)", "do not"),
    (r"\bcann'?t\b", "can not"),
    (r"\bwon['’]?t\b", "will not"),
    (r"\bcan['’]t\b|\bcannot\b|\bcant\b", "can not"),
    (r"\bshan['’]?t\b", "shall not"),
    (r"\bain['’]?t\b", "is not"),
    (rf"\b({_STEMS})n['’]t\b", r"\1 not"),
    (r"\b(do|does|did|is|are|was|were|must|should|could|would|need)nt\b", r"\1 not"),
    (r"\blet['’]s\b", "let us"),
    (r"(?<=[a-z])['’](?:ll)\b", " will"),
    (r"\b(i|you|we|they)['’](?:d)\b", r"\1 would"),
    (r"\b(i|you|we|they)['’](?:ve)\b", r"\1 have"),
    (r"\b(you|we|they)['’]re\b", r"\1 are"),
    (r"\bi['’]m\b", "i am"),
    (r"\b(it|that|there|this|one|he|she|what|who|here)['’]s\b", r"\1 is"),
    (r"\bd['’]?y(?:ou|a)\b", "do you"),
    (r"\by['’](?=think|know|reckon)", "you "),
    (r"\bupto\b", "up to"),
    (r"\bw/o\b", "without"),
    (r"\bw/", "with "),
    (r"\bgonna\b", "going to"),
    (r"\bwanna\b", "want to"),
    (r"\bgimme\b", "give me"),
    (r"\bgotta\b", "have to"),
    (r"\bpls\b|\bplz\b", "please"),
    (r"\bu\b", "you"),
    (r"\badn\b", "and"),
    (r"\bteh\b|\bhte\b|\bda\b", "the"),
    (r"\bur\b", "your"),
    (r"\bles\b", "less"),
    (r"\b(hold|grip|grab|lift|pick)['’]er\b", r"\1 it"),
    (r"\bwi['’]?(?= )", "with"),
    (r"\ban['’](?= )", "and"),
    (r"\bye\b", "you"),
    (r"\b(?:dinnae|dinna)\b", "do not"),
    (r"\bmor\b", "more"),
    (r"\b(more|less|higher|harder|softer|lower|firmer) ?'n(?= )", r"\1 than"),
    (r"(?<!\w)'?bout\b(?! of)", "about"),
    (r"\boughta\b", "ought to"),
    (r"\bthats\b", "that is"),
    (r"\blemme\b", "let me"),
    (r"\boutta\b", "out of"),
    (r"\b(hold|grip|grab|lift|pick|squeeze|press|pinch|handle|take) '?er(?= (?!rather\b))", r"\1 it"),
    (r"\bfor (?:the )?avoidance of (?:all |any )?doubt\b[,:]? ?", ""),
    (r"\bhow (?:hard|tough|difficult) (?:can|could) (?:it|this|that) (?:possibly )?be\b", "well"),
    (r"\bsub[- ]?newtons?\b", "below 1 newton"),
    (r"\b(?:do not|never) (?:forget|neglect|fail|omit) to\b", "please"),
    (rf"{_WANTED} (?:for you to|that you|to have you|to be) (?!.*\?)", "please "),
    (rf"{_WANTED} (?:that|for) (?!.*\?)", "make sure that "),
    (rf"{_WANTED} (?=(?:an?|the|some|at|about|around|roughly|exactly|no|not|between|something|\.?\d)\b)(?!.*\?)", "use "),
    (r"\b((?:hand|pass|turn|bring|carry|move|flip|roll|give|take|get|tip|lift|put|set|send|slide|swing)(?:e?d|ing)? (?:it|this|that|them|(?:the|my|our) (?:\w+ )?\w+)) over(?= (?:with|at|using|below|under|between|and|to|here|there|by|in|max|min|not|no|never|without|but|as|very|\w+ly)\b)", r"\1"),
    (r"\bon top of (?=(?:the|my|our|an?|some|all|those|these) (?!(?:usual|normal|standard|default|task|last|previous)\b))", "onto "),
)  # fmt: skip

_TYPED = (
    (
        r"\bkeep (?:the|your|its|our) (?:\w+ )?(?:force|grip|gripper|squeeze|pressure|load) (?:well |far )?clear of (?=\d)",
        "keep clear of ",
    ),
    (
        r"[\[(] ?(\d[\d.]*) ?(?:m?n|(?:milli)?newtons?)? ?[,;] ?(\d[\d.]*) ?(m?n|(?:milli)?newtons?) ?[\])]",
        r"\1 \3 to \2 \3",
    ),
    (r"\bthere(?: i|['’])s no (?:earthly |good )?reason not to\b", "please"),
    (
        r"(?:\bnot|\bnever|n['’]t)\b[^.;,#\d]{0,40}?\b(?:any )?other (?:way|manner) than (?=\w+)",
        " hold it ",
    ),
    (
        r"\bhalf (?:of )?(?=(?:the|these|those|my|our) (?:\w+ )?(?:berries|fruits|boxes|people|others|customers|eggs|time)\b)",
        "some of ",
    ),
    (r"^(?:(?:uh+m?|um+|er|erm|hmm+|ah+|oh)\b[,.…]* )+(?=\w)", ""),
    (
        r"\bmin\.? ?/ ?max\.?(?: (?:grip(?:ping)?|force|squeeze))* ?[:=] ?(\.?\d[\d.,]*(?: ?m?n)?) ?/ ?(\.?\d[\d.,]* ?m?n)\b",
        r"between \1 and \2",
    ),
    (r"\b(?:un)?till? s?he(?= )", "until it"),
    (
        r"\b(would|could|can|will) (?:the|this|that) (?:machine|robot|gripper|arm|device|hand)\b",
        r"\1 you",
    ),
    (
        r"\b(?:in )?(?:just |exactly )?the (?:same )?way (?:that )?(?:(?:you|one|i|we)(?:['’]d| would)?|an? \w+|people|mothers) (?:hold|carr(?:y|ie)|pick up|handle|treat|grip|touch|lift|cradle)s? ",
        "like holding ",
    ),
    (r"\bcareful not to (?:press|squeeze|push|lean)(?: down)? (?:on|upon) it\b", "careful"),
    (
        r"\b(so|and|therefore|hence) (hold|keep|stay|remain|be|grip|stop)( it| them| the \w+)? (?:somewhere |anywhere |safely |well |right )?in[ -]?between(?: (?:the two|these|those|them|both))?(?=\s*(?:$|[.,;!]| please))",
        r"\1 \2\3 there",
    ),
    (
        r"(\b(?:over|above|beyond|past|more than|under|below|less than) \.?\d[^.;?!]{2,60}?),? so (?:please )?(?:do not|don['’]t|never)(?: do (?:it|that|so))?(?=\s*(?:$|[.!]))",
        r"\1",
    ),
    (r"\blsl\b(?=[ :=]*\.?\d)", "at least"),
    (r"\busl\b(?=[ :=]*\.?\d)", "at most"),
    (r"\blesser than\b", "less than"),
    (r"(?<=[a-z])_(?=[a-z])", " "),
    (
        r"\b(for [a-z ]{1,30}?(?:the|our|my) (limit|maximum|max|cap|ceiling) is [^.;]{1,20}[.;,]+ (?:(?:and|but) )?for (?:this|the|our|my|these) [a-z ]{1,20}?)(?:it|that) is\b",
        r"\1the \2 is",
    ),
    (r"\bf[ _-]?(min|max)\b(?=[ :=]*\.?\d)", r"\1imum force"),
    (
        r"\b(?:stop|quit|cease|end) (?:clos|squeez|press|tighten|gripp)\w* before (?:the|your|my|our) (?:\w+ )?\w+ (?:shows?|reads?|sees?|says|registers?|reaches|hits|gets to) ",
        "stay below ",
    ),
    (
        r"\bstop (?:clos|squeez|press|tighten|gripp)\w* before (?:(?:you|it|we|the force) )?(?:reach(?:es)?|hits?|gets? to|pass(?:es)?|exceeds?) ",
        "stay below ",
    ),
    (
        r"\b(is|than|most|maximum|max|least|minimum|min|below|under|above|over|at|to),(?: (?:hmm+|uh+m?|er+|oh|well|say|let me (?:think|see)|as (?:written|stated|per|agreed|said|told|i|we|you)\b[^,;.]{0,30}|my (?:dear|friend)|i (?:think|guess|believe)|you know|mind you|if i remember[^,;.]{0,20}),)+ (?=\.?\d)",
        r"\1 ",
    ),
    (r"\blest (?=(?:it|the|this|that|he|she|they)\b)", "for fear "),
    (r"(?<=\d)[·٫](?=\d)", "."),  # decimal points of other keyboards
    (r"(?<=[a-z]{2}),(?=\.?\d)", ", "),
    (r"(?<=\d)\s*(?:pct|p\.c\.)(?![a-z])", " %"),
    (r"\s*(?:!=|≠|<>)\s*", " not "),
    (r"\s&\s", " and "),
    (r"(?<=\d)(\s*(?:m?n|(?:milli)?newtons?)?)\s+[~∼〜]\s+(?=\.?\d)", r"\1 to "),
    (r"(?<![\w.])[~∼≈≃≅]\s*(?=\.?\d)", "about "),
    (r"\b(?:approximately|approx\.?|circa|ca\.)\s*(?=\.?\d)", "about "),
    (r"^\(\s*(\.?\d[\d.,]*\s*[a-zµ]+)\s*\)", r"\1"),
    (r"(?<=\d )newton's\b", "newtons"),
    (r"(?:^|(?<=\s))!\s*(?=\.?\d)", "not "),
    (r"(?<=\d)\s*\[\s*([a-zµ]{1,12})\s*\]", r" \1"),
    (r"(?<!\w)(['\"“”„«»*_]+)(\.?\d[^'\"“”„«»*]{0,20}?)['\"“”„«»*_]+(?!\w)", r"\2"),
)
"""How numbers are typed: in quotes, in bold, with their unit in brackets."""

_SIGNS = str.maketrans(
    {
        **dict.fromkeys("≦⪅≲≯⩽", "<="),
        **dict.fromkeys("≧⪆≳≮⩾", ">="),
        **dict.fromkeys("≪≱", "<"),
        **dict.fromkeys("≫≰", ">"),
        "¬": " not ",
    }
)
"""Signs of comparison, written as those that bounds are read by."""

_FOREIGN_BOUNDS = (
    (r"\b(?:höchstens|hoechstens|maximal|maximaal|hoogstens|nicht mehr als|nicht über|niet meer dan|au plus|au maximum|pas plus (?:de|que)|como m[áa]ximo|a lo sumo|no m[áa]s de|al massimo|non più di|no máximo|högst|højst|enintään)(?= (?:(?:de|di|von) )?\d)", "at most"),
    (r"\b(?:mindestens|wenigstens|nicht weniger als|minstens|ten ?minste|au moins|pas moins (?:de|que)|como m[íi]nimo|por lo menos|al menos|almeno|come minimo|pelo menos|no mínimo|minst|mindst|vähintään)(?= (?:(?:de|di|von) )?\d)", "at least"),
    (r"\b(?:ungefähr|etwa|environ|ongeveer|aproximadamente|unos)(?= \d)", "about"),
    (r"\b(?:zwischen|entre|tra|tussen|fra|mellan) (?=(\d[\d.,]*(?: ?[a-zµ]+)?) (?:und|et|y|e|en|och|og) (\d))\1 \w+ ", r"between \1 and "),
)  # fmt: skip
"""Bounds that people say in their own language, whatever the rest of the sentence is in."""

_SENTENCE = re.compile(r"(?<!\d)[.!?]+|[.!?]+(?=\s|$)|\n+")
CLAUSE = re.compile(
    r"[,;:()]|\s[-–—]+\s|—|\.\.+|…|\bbut\b|\bbecause\b|\bsince\b|\band then\b|\bthen\b"
)
"""What ends the reach of a negation within a sentence."""


_ASIDE = re.compile(
    r"(\b(?:not|never|must|may|should|shall|can|could|will|would|is|are|be|to|do|does)),? "
    r"(?:under any circumstances?|in any (?:case|event|way|circumstances?)|at any (?:time|cost|price|point)|on any account|by any means(?! necessary)|"
    r"for any reason|whatsoever|whatever happens|at all costs|(?<=, )(?:please|ever|really|however|therefore|of course|i repeat|i insist|for \w+'?s? sake)(?=,)),?(?= (?!do not\b|not\b|never\b))"
)
"""Said between a denial and its verb: 'do not, under any circumstances, exceed 1 N'."""


_GOES_ON_BEHIND = frozenset(
    "at with to of than the a an no not never and or but about around below above under over exceed "  # noqa: SIM905
    "from between by is are be for in on as if using use apply".split(" ")
)
_GOES_ON_WITH = frozenset(
    "than of at to or and but nor most least more less max min n mn newton newtons g gram grams with "  # noqa: SIM905
    "without while when if because since that which who so as please tops is are was must should may "
    "might will would can could not per for on in".split(" ")
)
"""Words that a line does not end with, and that none begins with, where a sentence ends there."""


_ENDS_A_NUMBER = re.compile(r"\d\W*$")
_BEGINS_NO_UNIT = re.compile(
    r"\W*\d|(?!(?:[mkcdµu]?n|(?:milli|centi|deci|kilo)?newtons?|g|gf|grams?|kg|kgf|lbf?|ozf?|mm|cm|m|s|ms|seconds?|minutes?|per ?cent|times|of|to|or|and|at|(?:max|min)\w*(?!.{0,12}\d)|tops)\b)[a-z]"
)
_ENDS_A_BOUND = re.compile(r"\b(?:or|and) (?:less|below|under|more|above|over)$")


def _in_sentences(text: str) -> str:
    """A text whose lines end as sentences do, where they may."""
    first, *lines = [line.strip() for line in text.split("\n") if line.strip()] or [""]
    for line in lines:
        before, behind = re.search(r"[a-z]+\W*$", first), re.match(r"[a-z]+", line)
        goes_on = (
            not before
            or not before[0].isalpha()
            or before[0] in _GOES_ON_BEHIND
            or not behind
            or behind[0] in _GOES_ON_WITH
        )
        if _ENDS_A_NUMBER.search(first) and _BEGINS_NO_UNIT.match(line):
            goes_on = False  # 'tray 4' above '900 mN' are two numbers
        if _ENDS_A_BOUND.search(first):
            goes_on = False
        end = "; " if _ENDS_A_NUMBER.search(first) else ". "
        first += (" " if goes_on else end) + line
    return first


_REMARK = re.compile(
    r",? (?:and|but) (?=(?:(?:it|this|(?:this|the) (?:one|berry|strawberry|fruit)) (?:weighs|was picked|(?:is|was) (?:very |quite |so |a bit )*"
    r"(?:ripe|wet|big|small|heavy|light|large|red|fresh|slippery|dry|cold))|i (?:will|am going to) (?:watch|be here|be watching)|we have \d)\b)"
)
"""Before a remark that is a sentence of its own: '... and it is ripe'."""


def plain(text: str) -> str:
    """Lower case, straight quotes, contractions written out, single spaces."""
    text = re.sub(f"[{_MARKS}]", "'", text)  # before compatible forms: '´' would become a space
    text = re.sub("(?:(\\d+) ?)?([½¼¾⅓⅔⅛])", _mixed, text)
    text = re.sub("(?<=[\\w)])([⁺⁻]?[⁰¹²³⁴⁵⁶⁷⁸⁹])", r"^\1", text)  # '0.5²' is no 0.52
    text = text.replace("!>", "<=").replace("!<", ">=").translate(_SIGNS)
    text = unicodedata.normalize("NFKC", html.unescape(text)).lower()
    text = "".join(c for c in text if unicodedata.category(c) != "Cf")  # what nobody sees
    text = _in_sentences(text.replace("()", "").replace("−", "-"))
    for pattern, replacement in (*_TYPED, *_CONTRACTIONS, *_FOREIGN_BOUNDS):
        text = re.sub(pattern, replacement, text)
    text = re.sub(r"\banything (?:but|other than|except)\b", "not", text)
    text = _REMARK.sub(". ", " ".join(text.split()))
    return _ASIDE.sub(r"\1", text)


def _mixed(match: re.Match[str]) -> str:
    """'2½' as '2.5'."""
    return f"{int(match[1] or 0) + unicodedata.numeric(match[2]):.6g}"


def sentences(text: str) -> list[tuple[str, bool]]:
    """Sentences of a plain text, each with whether it ends in a question mark."""
    found, start = [], 0
    for match in _SENTENCE.finditer(text):
        if part := text[start : match.start()].strip():
            found.append((part, "?" in match.group()))
        start = match.end()
    if part := text[start:].strip():
        found.append((part, False))
    return found
