"""Whole questions that others ask in one clause of their own.

    Of the left and right edge, take the nearer: how far is it?    how far is it from the nearer ...
    Criterion 2: at least 25 % shall be covered. Met?              is it true that at least 25 % ...
    Weak or strong, if the boundary is 2.5 N?                      say 'strong' if ..., else 'weak'
    Keep it unless it is rough, in which case reject it.           say 'reject' if it is rough, ...
    How many grams would have to lie on it to press so hard?       what is the force in grams

Not here: parts that stand elsewhere in the same question (``moved``), phrases (``phrases``).
"""

from __future__ import annotations

import re
from collections.abc import Callable

from tacgrasp.lessons.dialogue.quantities import measured_by
from tacgrasp.lessons.dialogue.rewordings.moved import OTHER_HALF

_END = r"(?=[?.! ]*$)"
_CONTACT = (
    r"(?:(?:the |this )?(?:(?:cent(?:re|er)|middle) of (?:the |this )?)?"
    r"(?:contact|touch|press|imprint|dent|footprint|patch)(?:['’]s)?"
    r"(?: (?:cent(?:re|er)|middle|cent(?:re|er)d))?|it|you|we)"
)
_PAD = r"(?:(?:the |your |our |this )?(?:pad|gel|sensor)(?:['’]s)?)"
_MIDDLE = rf"(?:{_PAD} |the )?(?:cent(?:re|er)|middle|origin|midpoint)(?: of {_PAD})?"
_FORCE = (
    r"(?:(?:the |this |our |your )?(?:(?:present|current|felt|gripping|contact) )?"
    r"(?:force|grip|squeeze)|it|we|you)"
)
_BAND = r"(?:the |our |its |this )?(?:(?:agreed|wanted|allowed|contract['’]s|force) )*band"
_LOWER = r"(?:lower|low|bottom|minimum|smallest|least)(?: (?:end|edge|bound|limit|value|boundary))?"
_UPPER = r"(?:upper|high|top|maximum|largest|most)(?: (?:end|edge|bound|limit|value|boundary))?"
_UNIT = r"(?:(?:milli|micro|centi)?(?:newtons?|met(?:re|er)s?)|m?N|mm|[µu]m|cm|microns?|grams?|g)"
_FORCE_NUMBER = r"\d[\d.,]* ?m?N|\d[\d.,]* (?:milli)?newtons?|half a newton|an? newton"
_LENGTH = (
    r"\d[\d.,]* ?(?:mm|[µu]m|cm|microns?|millimet(?:re|er)s?)|half a (?:centi|milli)met(?:re|er)"
)
_BEHIND = rf"(?P<unit>,? in {_UNIT})?"
_LITTLE = r"weak|light|low|small|shallow|soft|slight|narrow|loose|gentle|tiny|faint"
_MUCH = r"strong|heavy|high|large|big|deep|hard|firm|great|wide|tight|massive"
_BOUNDARY = r"(?:the |our |my )?(?:boundary|border|threshold|line|limit|cut-?off|dividing line)"

_AMOUNT = (
    r"\d[\d.,]* ?(?:m?N|mm²?|[µu]m|cm|%|(?:milli)?newtons?|millimet(?:re|er)s?|microns?|per ?cent)"
)
_JUDGED = (
    r"(?:the )?(?:(?:contact|grip|gripping|press) )?(?:force|depth|area|coverage|grip|squeeze)"
)

_WORD_OF = r"(?:shape|texture|surface|position|location|place|depth|area|size)"
_NAMED = (
    r"(?:the |its |this )?(?:(?:contact|press|grip) )?"
    r"(?:area|depth|position|shape|texture|surface|skin|press|indentation|dent|contact)"
)

_Plain = str | Callable[[re.Match[str]], str]


def _nearer(found: re.Match[str]) -> str:
    return f"how far is it from the nearer of the {found['sides']} edges{_told_unit(found)}"


def _told_unit(found: re.Match[str]) -> str:
    """The unit that a question names, behind it; in millimetres where it names none."""
    unit = found.groupdict().get("unit") or found.groupdict().get("ahead")
    return f", in {unit.strip(' ,').removeprefix('in ')}" if unit else ", in mm"


def _in_mm(length: str) -> str:
    """A length without a number, with one: 'half a centimetre'."""
    if not length.lower().startswith("half"):
        return length
    return "5 mm" if "centi" in length.lower() else "0.5 mm"


def _said_by_size(found: re.Match[str]) -> str:
    """'Weak or strong, if the boundary is 2.5 N?' by which of both is the word for more."""
    one, two = found["one"].lower(), found["two"].lower()
    more, less = (one, two) if re.fullmatch(_MUCH, one) else (two, one)
    if not (re.fullmatch(_MUCH, more) and re.fullmatch(_LITTLE, less)):
        return found[0]
    measured = measured_by(found["n"])
    if not measured:
        return found[0]
    return f"say '{more}' if {measured} is above {found['n']}, otherwise '{less}'"


def _graded(found: re.Match[str]) -> str:
    """Three words with the ends of the first and of the last."""
    low, middle, high = (found[name].lower() for name in ("low", "middle", "high"))
    if found["first"].lower() != low or found["last"].lower() != high:
        return found[0]
    measured = measured_by(found["a"])
    if not measured:
        return found[0]
    return (
        f"say '{low}' if {measured} is below {found['a']}, '{high}' if {measured} is above "
        f"{found['b']}, otherwise '{middle}'"
    )


def _along_or_across(found: re.Match[str]) -> str:
    is_level = re.match("sideways|horizontal|left", found["way"], re.I) is not None
    return f"is {'|x| larger than |y|' if is_level else '|y| larger than |x|'}"


def _opposite(found: re.Match[str]) -> str:
    """Farther from one border than from the opposite one: on the other side of the middle."""
    side, other = found["side"].lower(), found["other"].lower()
    if other not in (OTHER_HALF[side], "opposite", "other"):
        return found[0]
    is_far = re.match("f", found["how"], re.I) is not None
    where = OTHER_HALF[side] if is_far else side
    return f"is the contact in the {where} half"


_RECAST: tuple[tuple[str, _Plain], ...] = (
    # What somebody asks to be checked.
    (r"^(?:please )?(?:(?:check|verify|confirm|find out|see|make sure|establish|determine)(?: for me)?,? (?:that|if|whether)|(?:can|could|may) it be said that|"
     r"would (?:it be )?(?:correct|right|fair|accurate|true) to (?:say|state|claim) that|(?:is|would) it (?:be )?(?:the case|correct|right|fair) (?:to say )?that|tell me (?:whether|if)) (?P<s>(?:the|it|there|this|our|its|anything|something|all|any|more|less|at) [^?]+?)" + _END,
     r"is it true that \g<s>"),
    (r"^(?:criterion|requirement|rule|item|point|spec(?:ification)?|condition|feature|field|column)(?: (?:no\.? ?)?\d+)?(?: is|:) *(?=\S)", ""),
    (r"^(?P<s>(?:at least|at most|no more than|no less than|more than|less than|between) [^.?]*?) (?:shall|must|should|has to|have to|needs? to) be (?P<v>\w+)[.;:] *(?:(?:criterion|requirement|condition|is that|is it|is this)? ?(?:met|fulfilled|satisfied|ok|the case|so))[?.! ]*$",
     r"is \g<s> \g<v>"),
    (r"^(?P<s>(?:the )?(?:(?:lateral|sideways|vertical|contact|gripping) )?(?:contact|force|depth|area|touch|grip|offset|coverage|it)(?: along [xy])?) (?:shall|must|should|has to|needs? to) (?:be kept|be|stay|lie|remain) (?P<c>[^.?]*?)(?:, judging by its (?:cent(?:re|er)|middle))?[.;:] *(?:(?:criterion|requirement|condition) met|is (?:it|that|this)(?: so)?|met|ok)[?.! ]*$",
     r"is \g<s> \g<c>"),
    # The band and the limit.
    (r"\bthe force (?:presently|currently|now|actually) (?:exerted|applied|felt|measured)\b", "the force"),
    (rf"(?P<head>\b(?:is|are|it true that) {_FORCE}(?: is)?|\b{_FORCE} is) neither (?:less|lower|weaker|smaller|below|under)(?: than)? (?:the |its )?{_LOWER}(?: of {_BAND})? nor (?:greater|higher|stronger|larger|more|above|over|beyond)(?: than)? (?:the |its )?{_UPPER}(?: of {_BAND})?",
     r"\g<head> inside the band"),
    (r"\b(?:the )?contract['’]s (?=(?:force )?(?:band|limit)\b)", "the "),
    (rf"\b(?:the )?(?P<end>upper|lower) (?:value|figure|boundary|border|number) of (?:the )?{_BAND}", r"the \g<end> end of the band"),
    (r"\bwould (?P<s>the force|it|the grip) (?:then )?(?:lie|sit|fall|land|end up|come to lie|still lie) (?P<where>inside|within|in|outside)\b", r"would \g<s> be \g<where>"),
    (rf"^if (?P<n>{_FORCE_NUMBER}) more were (?:applied|put on|exerted|used)", r"if \g<n> were added"),
    (rf"^(?:after|on|by|when|once) adding (?:(?:another|an extra|a further) )?(?P<n>{_FORCE_NUMBER})(?: to (?:the (?:grip|force|squeeze)|it))?,? (?:how (?:many newtons|many N|much)(?: of)? (?:margin|room|headroom|reserve)|what (?:margin|room|headroom|reserve))(?: to the limit)? (?:would|will) (?:remain|be left|there be)",
     r"if \g<n> were added, how far would the force be below the limit"),
    (rf"^(?:say|suppose|imagine)(?: that)? (?:you|we|i) (?:pushed|pressed|squeezed|gripped) (?P<n>{_FORCE_NUMBER}) harder(?: than now)?[.;:,] *what would the (?:reading|force|result)(?: then)? be{_BEHIND}",
     r"if the force were \g<n> higher, what would it be\g<unit>"),
    (rf"^how much (?:more )?(?:could|can|may) {_FORCE} (?:tighten|rise|grow|increase|go up|climb)(?: further)? before (?:it leaves|leaving|it reaches|reaching|passing) (?:the band (?:at|by|over|through) its {_UPPER}|the {_UPPER} of the band),? ?(?P<unit>in {_UNIT})?[^?]*",
     r"what is the upper end of the band minus the force, \g<unit>"),
    (rf"^{_FORCE} (?:stands|is|lies|sits) at (?:what|which) (?:percentage|share|per ?cent) of (?:the )?(?:band['’]s (?P<a>upper|lower) (?:bound|end)|(?P<b>upper|lower) (?:bound|end) of the band)" + _END,
     lambda m: f"what percentage of the {m['a'] or m['b']} end of the band is the force"),
    (rf"^nearer (?:to )?(?P<end>{_BAND}['’]s (?:minimum|maximum|lower end|upper end|bottom|top)) or (?:to )?(?P<other>its [a-z ]+?), (?:this|the) (?:force|grip|squeeze)" + _END,
     r"is the force nearer the lower or the upper end of the band"),
    (rf"^which (?:bound|end|edge|side) of {_BAND} (?:does {_FORCE} (?:come|lie|sit)(?: (?:nearest|closest)(?: to)?)|is {_FORCE} (?:nearest|closest|nearer|closer)(?: to)?),? (?:the )?(?P<a>lower|upper)(?: one)? or (?:the )?(?P<b>lower|upper)(?: one)?" + _END,
     r"is the force nearer the \g<a> or the \g<b> end of the band"),
    (r"\b(?:what(?:['’]s| is) (?:still )?left (?:before|until|up to) the (?:force )?limit)(?= more or less| larger| smaller| bigger)", "the room to the limit"),
    (r"\bthe remaining (?:margin|room|headroom) (?:up )?to the limit\b", "the room to the limit"),
    (r"\bthan what (?:you|we) (?:already |now )?(?:apply|exert|use|press with)(?: already| now)?" + _END, "than the force"),
    (r"^closer to zero or (?:closer )?to the limit[:,;]? (?:which\b[^?]*|(?:is )?(?:the |your )?(?:force|grip|squeeze)[^?]*)" + _END, "is the force closer to zero or to the limit"),
    (r"\b(?:with regard to|regarding|as to|concerning) the (?:absolute |hard |force )?limit,? is (?:the (?:gripper|force|grip)|it|this) (?P<a>compliant|in order|fine) or (?P<b>in breach|in violation|over)" + _END,
     r"say '\g<a>' if the force is within the limit, otherwise '\g<b>'"),
    # Where the contact is.
    (rf"^(?:out of|of|from|taking|between) the (?P<sides>left and right|right and left|top and bottom|bottom and top|upper and lower) (?:borders?|edges?|sides?),? (?:(?:take|pick|choose) )?the (?:one )?(?:nearer|closer|nearest|closest)(?: one)?(?: to {_CONTACT})?[:;,.]? *(?:what(?:['’]s| is) the distance|how far (?:off |away )?is it|how many (?P<ahead>\w+) (?:off|away)? ?is it){_BEHIND}" + _END,
     _nearer),
    (rf"^how (?:many (?P<ahead>\w+)|far|much) (?:stays|is|are|lies?|remains?)(?: there| left)? (?:between|from) {_CONTACT} (?:and|to) the (?:nearest|nearer|closest|closer) of (?:the )?(?P<sides>left or right|top or bottom|left and right|top and bottom) (?:border|edge|side)s?(?: of {_PAD})?{_BEHIND}" + _END,
     _nearer),
    (rf"^(?:out of|of) (?:all )?(?:the )?four (?:borders|edges),? (?:pick|take|choose)? ?(?:the )?(?:one )?(?:that is )?(?:farthest|furthest)(?: away)?(?: from {_CONTACT})?[;:,.]* *(?:how far (?:off|away) is it|what(?:['’]s| is) the distance|how many \w+ (?:off|away) is it){_BEHIND}" + _END,
     lambda m: f"how far is it from the farthest edge{_told_unit(m)}"),
    (rf"^the (?:{_PAD} )?(?:edge|border|rim) (?:that is )?(?:closest|nearest) to {_CONTACT}[:;,]? *how (?:many (?P<ahead>\w+)|far) (?:away|off)(?: is it)?{_BEHIND}" + _END,
     lambda m: f"how far is it from the nearest edge{_told_unit(m)}"),
    (rf"^(?:before|until) {_CONTACT} (?:ran|runs|went|goes|slid|fell) off (?:at |over )?the (?P<side>left|right|top|bottom|upper|lower|palm|fingertip)(?:-side)? edge(?: of {_PAD})?,? how (?:many (?P<ahead>\w+)|far|much) (?:could|can) it (?:travel|move|go|slide|shift)[^?]*" + _END,
     lambda m: f"how far is it from the {m['side']} edge{_told_unit(m)}"),
    (rf"^(?:if i )?(?:started|starting|start|walking|going) (?:at|from) the (?P<side>left|right|top|bottom|upper|lower|palm|fingertip)(?:-side)? edge and (?:walked|went|walking|going|walk|go) (?:straight )?(?:up |down |across |right |left )?to {_CONTACT},? how (?:many (?P<ahead>\w+)|far|much)[^?]*" + _END,
     lambda m: f"how far is it from the {m['side']} edge{_told_unit(m)}"),
    (rf"^the (?P<side>left|right|top|bottom|upper|lower|palm|fingertip) (?:border|edge) is how (?:many (?P<ahead>\w+)|far) (?:away )?from (?:where you feel )?{_CONTACT}(?: of the (?:contact|touch|press))?" + _END,
     lambda m: f"how far is it from the {m['side']} edge{_told_unit(m)}"),
    (rf"\bthere(?:['’]s| is) a (?:mark|dot|point|spot|scratch) at (?P<p>[^.;:?]*?\d[^.;:?]*?(?:[.,]\d+)?[^.;:?]*?)[.;:] *how (?:many (?P<ahead>\w+)|far) (?:away )?from (?:it|that|there) is {_CONTACT}(?: of the contact)?" + _END,
     lambda m: f"how far is the contact from {m['p']}{_told_unit(m)}"),
    (rf"^(?:add(?: up)?|sum(?: up)?|take the sum of) the (?:horizontal|sideways) and the (?:vertical|lengthwise) (?:displacements?|offsets?|distances?)(?: from {_MIDDLE})?,? (?:both )?(?:without (?:their |the )?signs?|ignoring (?:the |their )?signs?|in absolute value)[:;,]? *(?:total|what is (?:it|the (?:sum|total))|how much)?{_BEHIND}" + _END,
     r"what is |x| + |y|\g<unit>"),
    (rf"^(?:(?:what(?:['’]s| is)|give|state|tell me) )?the (?:L1|manhattan|taxicab|city[- ]block) distance (?:of|from|between) {_CONTACT}(?: (?:from|to|and) {_MIDDLE})?{_BEHIND}(?:[.;,] *(?:value|what is it))?" + _END,
     r"what is |x| + |y|\g<unit>"),
    (r"^if you (?:drop|ignore|leave out) the signs of x and y and add (?:the two|them|both)(?: together)?, (?:how many (?P<unit>\w+)|what) (?:do you get|is it|comes out|is the (?:sum|result))" + _END,
     r"what is |x| + |y|, in \g<unit>"),
    (rf"^is {_CONTACT} (?:farther|further|more) (?:off|from|away from) {_MIDDLE} (?P<way>sideways|horizontally|vertically|lengthwise) than (?:it is )?(?:in the )?(?:palm-to-fingertip direction|lengthwise|vertically|sideways|horizontally|up and down)" + _END,
     _along_or_across),
    (rf"^(?:is )?{_CONTACT} (?P<how>farther|further|closer|nearer)(?: away)? (?:from|to) the (?P<side>left|right|top|bottom|upper|lower) (?:edge|border|side)(?: of {_PAD})? than (?:from |to )?the (?P<other>left|right|top|bottom|upper|lower|opposite|other)(?: one| edge| border| side)?" + _END,
     _opposite),
    (r"^is (?P<s>the touch|the contact|it) neither right of x = (?P<b>[\d.]+) ?mm nor left of x = (?P<a>[-−][\d.]+) ?mm" + _END,
     r"is x between \g<a> and \g<b> mm"),
    (rf"^is {_CONTACT} (?:closer|nearer) than (?P<n>{_LENGTH}) to the (?P<side>\w+) (?:edge|border)" + _END,
     lambda m: f"is the distance to the {m['side']} edge less than {_in_mm(m['n'])}"),
    (rf"^is the (?P<side>\w+) (?:edge|border) (?P<how>farther|further|closer|nearer|more|less)(?: away)?(?: from {_CONTACT}| to {_CONTACT})? than (?P<n>{_LENGTH})(?: (?:away )?(?:from|to) {_CONTACT})?" + _END,
     lambda m: f"is the distance to the {m['side']} edge {'more' if m['how'].lower()[0] in 'fm' else 'less'} than {_in_mm(m['n'])}"),
    (r"^(?:is )?(?:the )?(?P<how>bigger|larger|greater|smaller) of the two offsets,?(?: ignoring (?:the )?signs?,)? (?:is it )?(?:the )?(?P<a>horizontal|vertical)(?: one)? or (?:the )?(?P<b>horizontal|vertical)(?: one)?" + _END,
     r"is the \g<a> or the \g<b> offset \g<how>"),
    (r"^if (?:the contact|it) is(?:n['’]t| not) in the (?P<x>\w+) half,? (?:then )?it['’]?s in the \w+ half[.;,:] *which (?:one )?is it,? (?P<a>\w+) or (?P<b>\w+)" + _END,
     r"is it in the \g<a> or the \g<b> half"),
    (r"^(?:off|from) the middle(?: line)?,? does it (?:hang|lie|sit|go|lean) (?:to the )?(?P<a>left|right) or (?:to the )?(?P<b>left|right)" + _END, r"is it \g<a> or \g<b> of the middle"),
    (r"^(?P<a>top|upper|left|right|bottom|lower) (?:edge|border)(?: versus| vs\.?| or| against) (?:the )?(?P<b>top|upper|left|right|bottom|lower) (?:edge|border)[:;,]? *which (?:of (?:them|the two|these))?,?[^?]*\b(?P<how>farther|further|farthest|nearer|closer|nearest)\b[^?]*" + _END,
     r"is it \g<how> from the \g<a> or the \g<b> edge"),
    # The contact area.
    (r"\b(?:(?:the|that) )?(?:portion|part|share|area|section) of the (?P<p>pad|gel|sensor) (?:that|which) (?:is|lies|stays) (?:not (?:in contact|touched|covered)|out of contact|untouched)(?: with (?:the object|it|anything))?", r"the free area of the \g<p>"),
    (r"^how (?P<n>many \S+|much) of the (?:surface|pad|gel) (?:feels?|senses?|gets?|has) (?:nothing|no (?:touch|contact|load))(?: at all)?" + _END, r"how \g<n> of the pad is free"),
    (r"^(?:the )?(?:footprint|contact area|coverage|contact|patch) is how many percentage points (?P<how>short of|below|under|above|over) (?P<n>(?:half|a third|a quarter|[\d.]+ ?%)(?: (?:of )?the (?:pad|gel))?)(?: \(negative if[^)]*\))?" + _END,
     r"by how many percentage points is the area \g<how> \g<n>, negative if not"),
    (r"^compare the (?:touched|contact|covered) area with (?P<n>[\d.]+ ?mm²)[:;,.]? *how (?:big|large|much) is the difference[^?]*" + _END, r"how far is the area from \g<n>, in mm²"),
    # What weighs as much.
    (r"^(?:to press (?:this|so|that) hard by weight alone, )?how many grams would (?:have to|need to) (?:rest|lie|sit|be put|be placed) on the (?:pad|gel|sensor)(?: to press (?:this|so|that|as) hard)?[^?]*" + _END, "what is the force in grams"),
    (r"^(?:what|which) (?:mass|weight),? in grams,? would(?:,? by its weight(?: alone)?)?[^?]*? press (?:just |exactly )?as hard (?:as|on)[^?]*" + _END, "what is the force in grams"),
    (r"^knowing that (?P<s>(?:the|this|my|our) \w+) weighs (?P<m>[^,]+), ", r"\g<s> weighs \g<m>. "),
    # A part of the whole, in other counts than percent.
    (r"^(?=[^?]*\b(?:(?:between|from|btw) (?:0|zero) (?:and|to) (?:1|one)(?! ?(?:m?n|[mcµu]m|%|per|newton|milli|centi|micro))|decimal)\b)(?!(?:is|are|does|do|has|have)\b)(?![^?]*\b(?:force|limit|band|depth|grip|\d{2})\b)[^?]*\b(?:pad|sensor|gel|sensing surface)\b[^?]*\b(?:cover(?:ed|age)|imprinted|touched|in contact|contact area)\b[^?]*" + _END,
     "how much of the pad is covered, as a number between 0 and 1"),
    (r"^(?=[^?]*\b(?:(?:between|from|btw) (?:0|zero) (?:and|to) (?:1|one)(?! ?(?:m?n|[mcµu]m|%|per|newton|milli|centi|micro))|decimal)\b)(?!(?:is|are|does|do|has|have)\b)(?![^?]*\b(?:force|limit|band|depth|grip|\d{2})\b)[^?]*\b(?:cover(?:ed|age)|imprinted|touched|contact(?: area)?)\b[^?]*\b(?:pad|sensor|gel|sensing surface)\b[^?]*" + _END,
     "how much of the pad is covered, as a number between 0 and 1"),
    (r"^(?:if i (?:cut|divided|split) (?:the|your) (?:pad|gel|sensor) into (?:a|one) hundred (?:equal )?(?:bits|parts|pieces|squares),? |out of (?:every |a |each |one )*(?:hundred|100)(?: (?:parts?|bits?|pieces?|points?) of (?:the |your )?(?:pad|gel|sensor)(?: surface)?)?,? )(?:how many|what share|what part)\b[^?]*\b(?:beneath|under|on them|on it|touched|covered|in contact)\b[^?]*" + _END,
     "what percentage of the pad is covered"),
    (r"\b(?:three[- ]by[- ]three|3 ?[x×] ?3|noughts-and-crosses|tic-tac-toe)\b(?!(?:is|are|does|do|has|have)\b)(?![^?]*\b(?:left|right|top|bottom|cent(?:re|er)|middle|upper|lower)\b)[^?]*\b(?:cell|box|boxes|square|field)\b[^?]*" + _END, "grid, in which cell of the pad is it"),
    (r"^[^?]*grid, in which cell of the pad is it|^(?:were|if) (?:the|your) pad (?:were )?a (?=grid, in which)[^?]*" + _END, "in which zone of the pad is it"),
    # Sums and multiples of what is felt.
    (r"^(?:signs ignored, )?(?:add|sum)(?: up)? (?:the )?(?:how far )?(?:sideways|left-right|horizontal)(?: offset)? and (?:the )?(?:how far )?(?:vertical(?:ly)?|up-down|lengthwise|up-and-down)(?: offset)?(?: the [^,?]*)?,?(?: both (?:taken as positive|without (?:a )?signs?)| signs ignored)?[:;,]?(?: how many (?P<unit>\w+))?[^?]*" + _END,
     lambda m: f"what is |x| + |y|{_told_unit(m)}"),
    (r"^manhattan distance(?: \|x\| ?\+ ?\|y\|)?(?: from (?:the )?(?:cent(?:re|er)|middle))?(?P<unit>,? (?:in )?mm)?" + _END, "what is |x| + |y|, in mm"),
    (r"^(?:the (?:opposite|other) finger presses exactly as hard[.;:,] *sum of both|(?:if|suppose|say) (?:both fingers|a second finger) (?:push|press)\w* (?:the same as|exactly as hard as) this one,? (?:what(?:['’]?s| is) the sum of the two (?:normal )?forces|what would the (?:two )?forces add up to))(?P<unit>,? in \w+)?" + _END,
     r"what is twice the force\g<unit>"),
    (r"^(?:imagine|suppose|say) (?P<n>two|three|four|five) (?:fingers|pads) (?:pushing|pressing) exactly as hard as this one[.;:,] *how many newtons would they (?:make|carry|press)[^?]*" + _END, r"what is \g<n> times the force"),
    (r"^(?P<n>two|three|four|five) (?:fingers|pads) each (?:press|push|feel) (?:exactly as hard as this one|this same force)[;:,] *(?:what is their combined force|how many newtons do they carry)[^?]*" + _END, r"what is \g<n> times the force"),
    (r"^(?:(?:the|your|our) )?(?:squeeze|grip|force|press) is how many times the weight of (?:the )?(?:object|thing|item)(?: you(?:['’]ve| have)? (?:lifted|hold|held))?" + _END, "how many times the weight of the object is the force"),
    (r"\bhow many times (?:its own|the object['’]s(?: own)?|that) weight (?:are (?:we|you) (?:gripping|squeezing)(?: with)?|is (?:the thing being squeezed with|(?:the|our) grip force))(?:, [^?]*)?" + _END, "how many times the weight of the object is the force"),
    (r"^(?:with g (?:at|of|=) ?[\d.]+, )?(?:gravity (?:pulls|tugs) (?:on|at) the (?:held )?(?:object|thing) with (?:what force in newtons|a certain number of newtons)|convert the mass you were given into a weight in newtons|(?:and )?its weight, so the pull of gravity on it, in newtons)[^?]*" + _END,
     "what is the weight of the object in newtons"),
    (r"^not (?:the )?\w+(?:,| and| or) not (?:the )?\w+,? (?:but )?(?:only|just) (?P<q>the \w+)[:,;]? (?P<r>how many \w+|in \w+)" + _END, lambda m: f"what is {m['q']} in {m['r'].removeprefix('how many ').removeprefix('in ')}"),
    (rf"^(?:we|i) (?:need|want|asked for|require) (?P<n>{_FORCE_NUMBER}) of (?:grip|force|squeeze)[.;,] *by how many newtons (?:are we|is it) (?P<how>short of|over|above|below|under) it,? (?:counting )?(?:zero|0) if[^?]*" + _END,
     lambda m: f"by how many newtons is the force {'below' if m['how'].lower() in ('short of', 'below', 'under') else 'above'} {m['n']}, zero if it isn't"),
    # What is left of a depth.
    (rf"^(?:the \w+|it) (?:must(?:n['’]t| not)|may(?: not)?|can|should not|shouldn['’]t) (?:sink|go|be pushed|be pressed) in (?:more than |by )?(?P<n>{_LENGTH})[.;] *how (?:many mm|much(?: of this travel)?)(?: (?:are|is|do|have))*(?: we)?(?: still)?(?: (?:left|got|have))*[^?]*" + _END,
     r"what is \g<n> minus the depth"),
    (rf"^(?:let['’]s say |suppose |if |say )?the gel bottoms out at (?P<n>{_LENGTH})[.;,] *how many mm (?:are|is) left[^?]*" + _END, r"what is \g<n> minus the depth"),
    # What the grip surely holds.
    (r"^is (?P<m>\d[\d.,]* ?(?:k?g|grams?|kilos?)) no (?:trouble|problem|bother|issue) for (?:this|the|our|your) (?:grip|grasp|gripper|hold)" + _END, r"does this grip surely hold \g<m>"),
    (r"^(?:can|could|may) (?:this|the|our|your) (?:grip|grasp|gripper|hold) be (?:trusted|relied on|entrusted) (?:with|to (?:hold|carry)) (?P<m>\d[\d.,]* ?(?:k?g|grams?|kilos?))" + _END, r"does this grip surely hold \g<m>"),
    (r"^(?:suppose )?i (?:handed|gave) you (?:an? )?(?P<m>\d[\d.,]*)[- ](?P<u>grams?|g|kilos?)[- ][a-z]+ with exactly this grip[;:,.] *(?:it['’]d|it would) be (?:guaranteed|sure|certain) not to (?:fall|slip|drop)(?:, (?:true|right|correct))?" + _END,
     r"does this grip surely hold \g<m> \g<u>"),
    (r"^(?P<m>[^,?]*\b(?:kilogram|kilo|grams?|k?g)) (?:is|are) (?:beyond|more than) what we(?:['’]re| are) sure to hold(?: at the moment| now)?,? (?:is|are)n['’]t (?:it|they)" + _END, r"does this grip not surely hold \g<m>"),
    (r"^(?P<head>does|is) (?P<s>the (?:\w+ )?force) (?:lie |lying |inside |within )*(?:in|inside|within) the (?:closed )?interval between (?:the )?(?:lower and (?:the )?upper|band['’]s ends)(?: band)?(?: values?| ends?)?(?: of the band)?" + _END, r"is \g<s> inside the band"),
    (r"^(?:please confirm|check the (?:gripping )?force against the contract)[:,] *(?:the )?(?:process |gripping )?(?:force|is it in the corridor),? neither (?:below|under)(?: the lower)? nor (?:above|over)(?: the upper)?(?: band)?(?: value| end)?(?: in the contract)?" + _END, "is the force inside the band"),
    # Where it is, by a sign that the question sets.
    (rf"^(?:by )?how many (?P<unit>\w+) is {_CONTACT} displaced (?P<way>upward|downward|to the (?:left|right)|leftward|rightward)s? from (?:the )?(?:pad['’]s )?(?:midpoint|middle|cent(?:re|er))[^?]*" + _END,
     lambda m: f"what is {'minus ' if re.search('down|left', m['way'], re.I) else ''}{'y' if re.search('up|down', m['way'], re.I) else 'x'} in {m['unit']}"),
    (r"^(?:measured|counted) from the (?P<side>left|right|bottom|top|lower|upper)(?:-hand)? (?:border|edge|side)(?: of the (?:pad|gel|sensor))?,? where (?:along the (?:width|height|length) )?is [^?]*?(?P<unit>,? in \w+)?" + _END,
     lambda m: f"how far is it from the {m['side']} edge{_told_unit(m)}"),
    (r"^how many (?P<unit>\w+) of (?:the )?pad lie to the (?P<side>left|right) of (?:the (?:cent(?:re|er)|middle) of )?the (?:contact|touch)" + _END, r"how far is it from the \g<side> edge, in \g<unit>"),
    (r"^how many (?P<unit>\w+) of (?:the )?pad lie between the (?P<side>\w+) (?:border|edge) and (?:the (?:cent(?:re|er)|middle) of )?the (?:contact|touch)" + _END, r"how far is it from the \g<side> edge, in \g<unit>"),
    (r"^take the (?P<side>bottom|top|left|right|lower|upper) edge as zero(?: instead of the cent(?:re|er))?[;:,.] *(?:then )?(?:the (?:height|position) of the contact is what|how (?:high|far) is (?:it|the contact)|what is (?:its|the) (?:height|position))(?P<unit>,? in \w+)?" + _END,
     lambda m: f"how far is it from the {m['side']} edge{_told_unit(m)}"),
    # Whether anything touches.
    (r"^(?:do you )?(?:have )?contact live" + _END, "is anything touching the pad"),
    (r"^(?:so )?(?:have you |u )?got (?:smth|something|anything|sth) in the (?:gripper|hand|fingers)" + _END, "is anything touching the pad"),
    (r"^(?:there(?:['’]s| is) nothing on the pad, is there\? *)(?:i mean, )?(?P<q>do you feel [^?]+)" + _END, r"\g<q>"),
    (r"^(?:would|is) (?:a |the )?binary label ['\"“]?contact['\"”]? (?:be )?(?:1|true|one)\b[^?]*" + _END, "is anything touching the pad"),
    (r"^[^?]*\b(?:can you assure me|be sure|confirm) that the (?:pad|gel) is free of (?:any )?contact" + _END, "is the pad untouched"),
    # More grip or not.
    (r"^next step[:,] (?:do (?:i|we) need to )?squeeze harder,? yes or no" + _END, "do I need to squeeze harder to get into the band"),
    # Units.
    (r"\bhow many kilograms['’]? worth of (?:push|force|grip|squeeze)(?: is (?:that|it|this))?" + _END, "what is the force in kgf"),
    (r"\b(?:into|in) pounds-force\b(?P<p> (?:for me|please))?" , r"in pounds-force"),
    (r"^(?:put|convert|turn|translate|bring) the (?:\w+ )*?(?P<s>force|grip|squeeze|depth|area) (?:in|into) (?P<u>[\w²-]+)(?: for (?:me|us)| please)*" + _END, r"what is the \g<s> in \g<u>"),
    # More or less than a number, and what to do about it.
    (rf"^is (?:my|the|our|your|this) (?:grip|force|squeeze|press) (?P<a>gentler|softer|weaker|lighter|looser|lower|less) or (?P<b>firmer|stronger|harder|tighter|higher|more) than (?P<n>{_FORCE_NUMBER})" + _END,
     r"say '\g<a>' if the force is below \g<n>, otherwise '\g<b>'"),
    (rf"^is (?:my|the|our|your|this) (?:grip|force|squeeze|press) (?P<b>firmer|stronger|harder|tighter|higher|more) or (?P<a>gentler|softer|weaker|lighter|looser|lower|less) than (?P<n>{_FORCE_NUMBER})" + _END,
     r"say '\g<b>' if the force is above \g<n>, otherwise '\g<a>'"),
    (rf"^(?P<a>pass|ok|okay|good|accept|go) or (?P<b>fail|ng|bad|reject|not ok|no[- ]go)[:,;.–—-]+ *(?P<s>{_JUDGED}) (?:must|may|shall|should|can)(?:n['’]t| ?not|not) (?:exceed|be (?:more|higher|greater|deeper|larger) than|be (?:above|over)|go (?:above|over|beyond)|pass) (?P<n>{_AMOUNT})" + _END,
     r"say '\g<a>' if \g<s> is at most \g<n>, otherwise '\g<b>'"),
    (rf"^(?P<a>pass|ok|okay|good|accept|go) or (?P<b>fail|ng|bad|reject|not ok|no[- ]go)[:,;.–—-]+ *(?P<s>{_JUDGED}) (?:must|shall|should|has to|needs to) (?:be|stay|remain|lie) (?P<c>[^.?]*\d[^?]*?)" + _END,
     r"say '\g<a>' if \g<s> is \g<c>, otherwise '\g<b>'"),
    (r"^(?:(?:the )?spec(?:ification)?(?: says| wants| asks)?|(?:the )?(?:rule|requirement)(?: is| says)?)[:,]? (?:that )?the contact must cover (?P<n>[\d.]+ ?(?:%|per ?cent))(?: of the (?:pad|gel|sensor))? or more[.;,:–—-]+ *(?P<a>\w+) or (?P<b>\w+)" + _END,
     r"say '\g<a>' if the contact area is at least \g<n>, otherwise '\g<b>'"),
    (rf"^(?:so )?(?:do|should|must|shall) (?:i|we|you) (?:have to |need to )?(?P<a>tighten|squeeze more|grip harder) or (?P<b>loosen|ease off|relax|grip softer) to (?:get|come|arrive) (?:to|at) (?P<n>{_FORCE_NUMBER})" + _END,
     r"say '\g<a>' if the force is below \g<n>, otherwise '\g<b>'"),
    (rf"^[^.?]*\b(?:told me|wants me|asked me|said|have|am told) to (?:keep|stay) (?:it |the force )?(?P<c>under|below|over|above) (?P<n>{_FORCE_NUMBER})[.;,] *(?:am i|are we|do (?:i|we)|are you) (?:obey(?:ing)?|comply(?:ing)?|doing|follow(?:ing)?|keep(?:ing)?)(?: that| it| to that| with that| so)?" + _END,
     r"is the force \g<c> \g<n>"),
    (rf"^[^.?]*\b(?:wants?|needs?|asked for|would like) (?P<n>{_FORCE_NUMBER})(?: on it| of grip)?[.;,] *how (?:many more newtons|much more) do (?:i|we|you) need(?: to get there)?" + _END,
     r"what is \g<n> minus the force"),
    (rf"^(?:i|we) (?:was|were|am|are) aiming for (?P<n>{_LENGTH})(?: of depth| deep)?[.;,] *how many (?P<unit>\w+) short (?:am i|are we)[^?]*" + _END, r"what is \g<n> minus the depth, in \g<unit>"),
    (rf"^(?:suppose|if|say|imagine)(?: that)? (?:my|the|our|your)(?: own)? limit (?:were|was|is) (?P<n>{_FORCE_NUMBER})(?: instead)?[.;,] *would (?:the )?(?:current |present )?(?:grip|force|it) (?:violate|exceed|break|be over|be above|breach) (?:it|that)" + _END,
     r"is the force over \g<n>"),
    (rf"^(?:suppose|if|say|imagine)(?: that)? (?:my|the|our|your)(?: own)? limit (?:were|was|is) (?P<n>{_FORCE_NUMBER})(?: instead)?[.;,] *how (?:many newtons|much) would be left" + _END,
     r"what is \g<n> minus the force"),
    (r"^has (?P<s>the force|it|the grip) (?:still )?not (?:yet )?(?:got|come|risen|climbed|reached)(?: up)?(?: to)? (?P<n>(?:half|a third|a quarter|two thirds|three quarters|[\d.]+ ?(?:%|per ?cent))(?: of)? the limit)" + _END, r"is the force below \g<n>"),
    (r"^which (?:one )?is the force (?P<h>closer|nearer) to,? (?:the )?(?P<a>limit|zero) or (?:the )?(?P<b>limit|zero)" + _END, "is the force closer to the limit or to zero"),
    (r"\bif i let go of half (?:of )?the force\b", "if the force were halved"),
    (r"^if the force were halved, would (?:i|it|we|the force) be (?P<w>below, within or above|above, within or below|below or above|in or outside|within or outside) the band" + _END, r"is half the force \g<w> the band"),
    (r"^by (?:what|which) factor could (?:i|we|you) multiply the (?:current |present )?force before reaching the limit" + _END, "what is the limit divided by the force"),
    (rf"^(?:how many per ?cent|what percentage) of the (?P<n>{_FORCE_NUMBER}) (?:cracking|breaking|bruising|crushing|bursting|maximum) force am i using" + _END, r"what percentage of \g<n> is the force"),
    (r"^is (?:the thing(?: i hold)?|it|the contact|the object) (?P<h>nearer|closer) to (?:my|the|your) (?P<a>fingertip|palm) than (?:to )?(?:my|the|your) (?P<b>fingertip|palm)" + _END, r"is it \g<h> to the \g<a> than to the \g<b>"),
    (rf"^(?P<head>(?:tell me |say )?(?:in one word )?)(?:whether |if |is )?(?P<s>{_JUDGED})(?: is)? (?P<a>\w+) or (?P<b>\w+), (?P<x>\w+) being (?:anything |everything |all )?(?P<c>(?:under|below|less than|over|above|more than)) (?P<n>{_AMOUNT})" + _END,
     lambda m: f"say '{m['x']}' if {m['s']} is {m['c']} {m['n']}, otherwise '{m['b'] if m['x'].lower() == m['a'].lower() else m['a']}'"),
    (rf"^by how (?:many \w+|much) does (?P<s>{_JUDGED}) differ from (?:an? |the |my |our )?(?:nominal |target |wanted |planned )?(?P<n>{_AMOUNT}),? (?:ignoring (?:the )?sign|either way|whichever way|in either direction)" + _END, r"how far is \g<s> from \g<n>"),
    (rf"^(?:give|tell)(?: me)? the distance(?P<unit>,? in \w+)? (?:between|from) {_CONTACT} (?:and|to) (?:the )?point (?P<p>x = [^?]+?)" + _END, r"how far is the contact from the point \g<p>"),
    (rf"^how many (?P<unit>\w+) (?P<w>below|above) the (?:middle|cent(?:re|er))(?: of the (?:pad|gel))? is {_CONTACT}[,?;.]? *\(?negative if (?:it is |it['’]s )?(?:above|below)[^?]*" + _END,
     lambda m: f"what is {'minus ' if m['w'].lower() == 'below' else ''}y in {m['unit']}"),
    (rf"^is (?:it|{_CONTACT}) near the (?P<side>\w+) (?:edge|border), (?:say|meaning|i\.?e\.?|that is),? within (?P<n>{_LENGTH})(?: of it)?(?:, measured from [^?]*)?" + _END, r"is the distance to the \g<side> edge at most \g<n>"),
    (rf"^[^?]*\bnowhere near the (?P<side>\w+) (?:edge|border),? is it more than (?P<n>{_LENGTH}) (?:away )?from (?:it|that)(?: edge)?" + _END, r"is the distance to the \g<side> edge more than \g<n>"),
    (r"^are we in the upper half of the band or beyond, (?:i\.?e\.?,? |that is,? )?(?:above its middle)" + _END, "is the force above the middle of the band"),
    # How far it is from what is wanted.
    (r"^(?:measured|counted) from the (?P<side>left|right|top|bottom|upper|lower) edge,? at how many (?P<unit>\w+) is the (?:contact|touch) cent(?:re|er)d" + _END, r"how far is it from the \g<side> edge, in \g<unit>"),
    (rf"^how far,? in (?P<unit>{_UNIT}),? is (?:the )?(?:current |present )?force from the (?P<end>top|upper end|bottom|lower end) of the band[?.;,] *(?:count it )?negative (?:if|when) [^?]*" + _END,
     lambda m: f"what is {'the upper end of the band minus the force' if m['end'].lower() in ('top', 'upper end') else 'the force minus the lower end of the band'}, in {m['unit']}"),
    (rf"^(?:i|we) (?:want|need|would like) (?:the gel dented|it (?:to go|pressed|pushed) in|a dent|a depth)(?: by| of)? (?P<n>{_LENGTH})[.;,:–—-]+ *how (?:many (?P<unit>\w+)|much) (?:deeper|further|more) (?:do (?:i|we) (?:have|need) to go|is (?:needed|missing))[^?]*?(?:[?.;,] *(?:a )?negative[^?]*)?" + _END,
     r"what is \g<n> minus the depth"),
    (rf"^(?:my|our|the) (?:target|goal|wanted|desired) (?:force|grip) is (?P<n>{_FORCE_NUMBER})[.;,:–—-]+ *how (?:many newtons|much) do (?:i|we) (?:need|have) to add[^?]*" + _END, r"what is \g<n> minus the force"),
    (r"^(?:we|i) (?:are|am) after (?P<n>[\d.]+ ?(?:%|per ?cent)) (?:coverage|of the pad)[.;,:–—-]+ *how many percentage points off (?:that|it) are we, (?:regardless of|ignoring the) sign" + _END, r"how far is the area from \g<n>"),
    (rf"^(?:suppose|if|say|imagine)(?: that)? (?:i|we|you) (?:press|push|pressed|pushed)(?: it)? (?P<n>{_LENGTH}) further(?: in)?[:;,.–—-]+ *what depth would (?:that|it) (?:make|be|give)(?P<unit>,? in \w+)?" + _END,
     r"if it went \g<n> deeper, how deep would it be\g<unit>"),
    (rf"^(?:were the (?:contact|touch) to (?:shift|slide|move)|(?:if|suppose) the (?:contact|touch) (?:shifted|slid|moved)) (?P<n>{_LENGTH}) (?:to the )?(?P<side>left|right),? (?:what|which) would its x(?: position| coordinate)? be(?P<unit>,? in \w+)?" + _END,
     lambda m: f"what is x {'minus' if m['side'].lower() == 'left' else 'plus'} {m['n']}"),
    (rf"^the (?:gel|skin|pad) (?:tears|rips|breaks|fails) if (?:it is )?(?:pushed|pressed) (?:in )?(?:beyond|over|more than|past) (?P<n>{_LENGTH})[.;,] *(?:is it safe|are we (?:safe|ok(?:ay)?|fine))(?: right now| now)?" + _END, r"is the depth at most \g<n>"),
    (r"^which (?:share|part) of the limit is (?P<h>bigger|larger|greater), (?:the )?(?P<a>used|unused)(?: one)? or (?:the )?(?P<b>used|unused)(?: one)?" + _END, "say 'used' if the force is above half of the limit, otherwise 'unused'"),
    (r"^(?:would you )?(?:describe|call|class) (?:the object|it|this) (?:as )?(?P<a>an? \w+) or (?:as )?(?:something else|another shape)[?.;,]* *(?:reply|answer|say)(?: with)? ['\"“]?(?P<x>\w+)['\"”]? or ['\"“]?(?P<y>\w+)['\"”]?" + _END, r"say '\g<x>' if it is \g<a>, otherwise '\g<y>'"),
    (r"^touch(?:ing|ed) or not[:;,.]? *(?:reply|answer|say)(?: with)? ['\"“]?(?P<x>\w+)['\"”]? or ['\"“]?(?P<y>\w+)['\"”]?" + _END, r"say '\g<x>' if anything touches the pad, otherwise '\g<y>'"),
    (rf"^(?P<a>cent(?:re|er)d|central|in the middle) or (?P<b>off[- ]cent(?:re|er)|off|not)[?.;,] *(?:i|we) (?:count|call|take|consider) (?:anything|everything) within (?P<n>{_LENGTH}) of the (?:middle|cent(?:re|er)) (?:as )?(?P=a)" + _END, r"say '\g<a>' if it is within \g<n> of the middle, otherwise '\g<b>'"),
    (r"^which kind of (?:solid|body|shape) (?:is the (?:pad|gel|sensor) feeling|do you feel|are you feeling)" + _END, "what shape is it"),
    (r"^what does the surface against (?:you|the pad) feel like[:;,] *(?=what is its shape)", ""),
    (r"\bhalf a centimet(?:re|er)\b", "5 mm"),
    (r"\b(?P<w>coordinate|position) of the (?:patch|footprint|imprint|touch)\b", r"\g<w> of the contact"),
    # Words that fit or don't.
    (rf"^(?:would|is|does) ['\"“]?(?P<w>[\w -]+?)['\"”]? (?:be |count as )?(?:the|an?) (?:wrong|incorrect|false|bad|poor|unsuitable) (?:word|label|term|name|description|category) for (?P<s>{_NAMED})" + _END, r"is \g<s> not \g<w>"),
    (rf"^(?:going|judging|according) (?:by|from|to) (?:your|the|its) (?:{_WORD_OF} )?(?:word|label|class|category)(?: (?:for|of) (?:the )?(?:{_WORD_OF}))?,? (?=(?:is|are|does|do|would|what|where)\b)", ""),
    (rf"^(?P<a>[\w -]+?) or (?P<b>[\w -]+?),? (?:going|judging|according) (?:by|from|to) (?:your|the|its) (?:{_WORD_OF} )?(?:word|label|class|category)" + _END, r"is it \g<a> or \g<b>"),
    (r"^(?:please )?(?:correct me|stop me|tell me|shout|say so) if (?:not|(?:i['’]?m|i am) (?:wrong|mistaken)|(?:that|this|it)(?:['’]s| is) (?:wrong|false|not so))[:,;.–—-]+ *(?:but )?(?P<q>[^?.;:]+)" + _END, r"is it true that \g<q>"),
    (r"^(?:the )?shape is (?:an? )?(?P<a>\w+) or (?:an? )?(?P<b>\w+),? (?:i\.?e\.?|that is|meaning)[, ]+(?:one|either) of (?:these|those|the|them)(?: two)?[^?]*" + _END, r"is the shape a \g<a> or a \g<b>, yes or no"),
    # Numbers asked for in other words.
    (rf"^in (?P<unit>{_UNIT}),? (?P<q>(?:what|how)(?: is|['’]s| are| far| much) [^?]*\b(?:x|y|middle|cent(?:re|er)|edge|border)\b[^?]*?)" + _END, r"\g<q>, in \g<unit>"),
    (rf"^how far (?P<way>sideways|to the side|up or down|along the finger) (?:from {_MIDDLE} )?(?:does it sit|is it|is {_CONTACT}|does {_CONTACT} (?:sit|lie))(?: from {_MIDDLE})?,? (?:ignoring|disregarding|regardless of|no matter|whichever|never mind) (?:which|the) (?:side|way|direction)(?P<unit>,? in \w+)?" + _END,
     lambda m: f"how far is it from the middle along {'x' if 'side' in m['way'].lower() else 'y'}, without sign{_told_unit(m)}"),
    (rf"^how many (?P<unit>\w+) (?:toward|towards|to) (?:the|your|my) (?P<way>palm|fingertip|tip)(?: side| end)? is {_CONTACT},? (?:with )?(?:an? )?(?:negative|minus)(?: sign| number)? (?:meaning|for|being|if|when|means) [^?]*" + _END,
     lambda m: f"what is {'' if m['way'].lower() == 'palm' else 'minus '}y in {m['unit']}"),
    (rf"^{_PAD} (?:is|measures) [\d.]+ ?(?:mm)? ?(?:by|x|×) ?[\d.]+ ?(?:mm)? *[.;,:–—-]+ *(?:so )?(?P<q>(?:how|what) [^?]+)" + _END, r"\g<q>"),
    (r"^on a scale (?:where|on which|with) (?:0|zero) (?:is|being|means|=) no (?:force|grip) and (?:1|one) (?:is|being|means|=)? ?the limit,? (?:where|what) is the (?:grip|force)" + _END, "what is the force divided by the limit"),
    (rf"^how many times its(?: own)? weight (?:is|are) (?:the \w+|it|{_FORCE}) (?:being )?(?:squeezed|gripped|pressed|held)(?: with)?" + _END, "how many times the weight of the object is the force"),
    (r"^(?:squeezed|gripped|pressed|held) (?:by|with|at) (?P<c>at least|at most|more than|less than) (?P<n>[\w.]+) times its(?: own)? weight,? is it" + _END, r"is the force \g<c> \g<n> times the weight of the object"),
    (r"^(?P<q>does (?:the |this )?(?:contact|touch|patch|object|it|berry) (?:take up|cover|fill|occupy)) (?P<n>an? \w+|one \w+|half|[\d.]+ ?(?:%|per ?cent)) or (?P<c>more|less) of (?:the |your |our )?(?:surface|pad|gel|sensor|area)" + _END,
     lambda m: f"{m['q']} at {'least' if m['c'].lower() == 'more' else 'most'} {m['n']} of the pad"),
    (r"^are x and y both (?P<w>positive|negative)" + _END, lambda m: "is x {0} 0 mm and y {0} 0 mm".format("above" if m["w"].lower() == "positive" else "below")),
    (rf"^does (?:your|the|its) {_WORD_OF} (?:label|word|class|category) (?:have|contain|include) ['\"“]?(?P<w>top|bottom|left|right)['\"”]?(?: in it)?" + _END,
     lambda m: f"is it in the {m['w']} {'row' if m['w'].lower() in ('top', 'bottom') else 'column'}"),
    (r"^(?:have (?:we|you|i) (?:spent|used)|is the force|are we at) (?P<a>less than half) (?:of )?the limit,? or (?:already )?(?P<b>more than half|more)(?: of it)?" + _END, r"say '\g<a>' if the force is below half of the limit, otherwise '\g<b>'"),
    (r"^(?:what|which)(?:['’]s| is) (?P<c>larger|bigger|greater|more|smaller|less)[:,]? (?:the )?(?P<a>force)(?: now)?,? or (?:the )?(?P<b>room|headroom|rest|remainder)(?: that)?(?: is)?(?: left| remains| remaining)? (?:until|till|up to|to|before) the limit" + _END,
     lambda m: f"say 'the {m['a']}' if the force is {'above' if m['c'].lower() in ('larger', 'bigger', 'greater', 'more') else 'below'} half of the limit, otherwise 'the {m['b']}'"),
    (r"^[^?\d]*\b(?:if|because|since|as|when)\b[^?\d]*, so (?P<q>(?:is|are|does|do|has|have|am) [^?,]+)" + _END, r"\g<q>"),
    # Words to choose from.
    (rf"^(?:the )?(?:force|depth|contact|grip|press|area|touch|it)? ?(?:is )?(?P<one>{_LITTLE}|{_MUCH})(?:,)? or (?P<two>{_LITTLE}|{_MUCH}),? (?:if|with|given|taking|where) {_BOUNDARY} (?:is|at|being|of|as)? ?(?P<n>\d[\d.,]* ?[a-zµ%²]+)" + _END,
     _said_by_size),
    (r"^(?P<low>\w+), (?P<middle>\w+) or (?P<high>\w+)(?: imprint| dent| press| grip| contact)?,? if (?P<first>\w+) (?:ends|stops) (?:at|with) (?P<a>\d[\d.,]* ?[a-zµ%²]+) and (?P<last>\w+) (?:begins|starts) (?:at|with|from) (?P<b>\d[\d.,]* ?[a-zµ%²]+)" + _END,
     _graded),
    (r"^of (?P<a>\d[\d.,]* ?[a-zµ%²]+) and (?P<b>\d[\d.,]* ?[a-zµ%²]+),? (?:which|what)(?: one)? is (?P<s>the \w+) (?:closer|nearer|closest|nearest)(?: to)?" + _END, r"is \g<s> closer to \g<a> or to \g<b>"),
    (r"^would you (?:label|call|mark|rate) (?:a contact patch|an? (?:contact|area|patch|footprint)|it)(?: of)?(?: this size)? ['\"“](?P<a>over|above|more)['\"”] or ['\"“](?P<b>under|below|less)['\"”] (?P<n>[^?]+?)(?: of the pad)?" + _END,
     r"say '\g<a>' if the contact area is above \g<n> of the pad, otherwise '\g<b>'"),
    (r"^which (?:one )?(?:describes|fits) it (?:better|best),? (?:an? )?(?P<a>\w+) or (?:something else|another|other)[?.;,]* *(?:reply|answer|say)(?: with)? ['\"“](?P<x>\w+)['\"”] or ['\"“](?P<y>\w+)['\"”]" + _END,
     r"say '\g<x>' if it is a \g<a>, otherwise '\g<y>'"),
    (r"^(?P<a>keep|use|accept|take|pass|leave)(?: it)? unless (?P<c>[^,.;?]+?), in which case (?P<b>reject|discard|drop|fail|refuse|bin)(?: it)?[.;] *(?:keep|use|accept|take|pass|leave) or \w+" + _END,
     r"say '\g<b>' if \g<c>, otherwise '\g<a>'"),
    # The shape.
    (r"^(?:any idea |do you know |can you tell )?(?:which|what) (?:kind|sort|type) of (?:body|shape|solid|form|thing)(?: (?:has )?(?:left|made|pressed) (?:this|the) (?:imprint|dent|mark|contact)| is it| is this)" + _END, "what shape is it"),
    (r"\bwhich shape is left (?:when|once|after) you(?:['’]ve| have) (?:struck out|ruled out|crossed off|excluded) [^?]*" + _END, "what shape is it"),
)  # fmt: skip
_COMPILED = tuple((re.compile(pattern, re.I), plain) for pattern, plain in _RECAST)


def recast(text: str) -> str:
    """A question in the one clause that others ask it in; the text itself where it has none."""
    for pattern, plain in _COMPILED:
        text = pattern.sub(plain, text)
    return text
