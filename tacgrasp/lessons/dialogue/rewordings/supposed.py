"""Questions about what would be, and differences in other words, as expressions of the numbers felt.

    If the limit were 1 N lower, where would it lie?                  limit_n - 1
    Let go by ten percent: the force would be what?                   force_n * 0.9
    Ten objects like this one would have what mass?                   mass_g * 10
    Is 1 N a force that the goal band would accept?                   band_low_n <= 1 <= band_high_n

The expressions are in the names of a truth (``expressed`` reads them). Not here: other questions in
one clause of their own (``recast``).
"""

from __future__ import annotations

import re
from collections.abc import Callable

from policies.instructions.quantities.numerals import in_digits

_END = r"(?=[?.! ]*$)"
_LENGTH = (
    r"(?:exactly |about )?(?P<n>\d[\d.]*) ?"
    r"(?P<u>mm|[µu]m|cm|microns?|(?:milli|centi|micro)met(?:re|er)s?)"
)
_FORCE = r"(?:exactly |about )?(?P<n>\d[\d.]*) ?(?P<u>m?N|(?:milli)?newtons?)"
_IF = (
    r"(?:if|suppose|supposing|imagine|assume|assuming|say|let['’]s say|pretend|should|were|had)"
    r"(?: that)?"
)
_WHOEVER = r"(?:somebody|someone|i|we|you|they|one|the \w+)"
_SIGNLESS = (
    r",? (?:ignoring|disregarding|regardless of|no matter|whatever|whichever|in which|sign)"
    r"(?: (?:the|its|in which|which|is|be))*(?: (?:sign|direction|way|side|ignored|disregarded))*"
)
_DENT = r"(?:the )?(?:dent|indentation|penetration|press|depth|contact|it)"
_GRIP = r"(?:the |my |your |our )?(?:(?:current|present|grip|gripping|measured) )*(?:force|grip|squeeze)"
_AREA = r"(?:the )?(?:(?:contact|touch) )?(?:patch|area|coverage|footprint|contact)"
_THING = r"(?:the )?(?:object|fruit|berry|strawberry|tomato|egg|peg|thing|contact|it)"
_UNITS = (
    r"(?:in )?(?P<u>mm²?|[µu]m|cm²?|microns?|m?N|k?g|gf|per ?cent|%|gram[- ]?forces?|(?:kilo)?grams?|"
    r"(?:milli)?newtons?|(?:milli|centi|micro)met(?:re|er)s?)"
)
_COMPARATIVE = (
    r"(?:(?:no |not )?(?:more|less|greater|smaller|higher|lower|larger|deeper) than|at least|"
    r"at most|over|under|above|below|beyond|in excess of|short of)"
)
_ANY_UNIT = (
    r"(?P<u>mm²?|[µu]m|cm²?|microns?|m?N|k?g|kgf|lbf|per ?cent|%|gram[- ]?forces?|(?:kilo)?grams?|"
    r"(?:milli)?newtons?|(?:milli|centi|micro)met(?:re|er)s?|inch(?:es)?|pounds?(?:-force)?)"
)
_NAMES = {
    "force": "force", "grip": "force", "squeeze": "force", "limit": "limit", "ceiling": "limit",
    "depth": "depth", "indentation": "depth", "area": "area", "coverage": "area",
    "mass": "mass", "weight": "mass", "x": "x", "y": "y",
}  # fmt: skip
_IS_BELOW = re.compile(r"under|below|less", re.I)
_COMPARED = {"at least": ">=", "at most": "<=", "more than": ">", "less than": "<"}
_SIZES = {"half": 0.5, "a third": 1 / 3, "a quarter": 0.25, "twice": 2.0, "double": 2.0}
_LESS = re.compile(
    r"\b(?:lower|less|down|softer|reduc|decreas|drop|cut|let go|eas|loosen|back|relax)", re.I
)


def _in_unit_of(found: re.Match[str], symbol: str) -> float:
    """The number of a question in newtons or millimetres."""
    unit = found["u"].lower()
    is_small = unit.startswith("m" if symbol == "N" else ("µ", "um", "micro"))
    scale = 1e-3 if is_small else 10.0 if unit.startswith("c") else 1.0
    return float(found["n"].rstrip(".")) * scale


def _mm(found: re.Match[str]) -> str:
    return f"{_in_unit_of(found, 'mm'):g}"


def _newtons(found: re.Match[str]) -> str:
    return f"{_in_unit_of(found, 'N'):g}"


def _moved(name: str, unit: str) -> Callable[[re.Match[str]], str]:
    """A name, less or more by the question's number."""

    def written(found: re.Match[str]) -> str:
        sign = "-" if _LESS.search(found["way"]) else "+"
        return f"{name} {sign} {_in_unit_of(found, unit):g}"

    return written


def _shifted(found: re.Match[str]) -> str:
    """Where the contact's centre would be."""
    way = found["way"].lower()
    axis = "x" if way in ("left", "right") else "y"
    sign = "-" if way in ("left", "fingertip", "fingertips", "tip", "bottom", "down") else "+"
    return f"{axis}_mm {sign} {_mm(found)}"


_Plain = str | Callable[[re.Match[str]], str]

_SUPPOSED: tuple[tuple[str, _Plain], ...] = (
    # Depths.
    (rf"^how much (?:deeper or shallower|shallower or deeper) than {_LENGTH} is {_DENT}{_SIGNLESS}" + _END, lambda m: f"abs(depth_mm - {_mm(m)})"),
    (rf"^(?:back|draw|pull)(?:ing)? (?:the )?(?:finger|pad|gripper|jaw)s? (?:off|back|away|out) by {_LENGTH}[^?]*? (?:would )?(?:leave|leaves|give|gives) what {_DENT}[^?]*" + _END, lambda m: f"max(0, depth_mm - {_mm(m)})"),
    (rf"^subtract {_DENT} from (?:a |the )?\w+ of {_LENGTH}[:;,] *how many (?:mm|millimet(?:re|er)s?) (?:remain|are left)" + _END, lambda m: f"{_mm(m)} - depth_mm"),
    (rf"^do the (?:microns|micromet(?:re|er)s) of {_DENT} (?:number|come to|amount to|exceed) (?P<way>over|more than|above|under|less than|below)? ?(?P<n>\d[\d.]*)" + _END,
     lambda m: f"depth_mm * 1000 {'<' if re.match('under|less|below', m['way'] or '') else '>'} {m['n']}"),
    # Forces, limits and bands.
    (rf"^(?P<way>let go|ease off|loosen(?: up)?|relax|back off|squeeze more|tighten(?: up)?|grip harder) by (?P<n>\d+) ?(?:%|per ?cent)(?:,| and|:)* (?:then )?{_GRIP} would be what(?:, in \w+)?" + _END,
     lambda m: f"force_n * {1 + (-1 if _LESS.search(m['way']) else 1) * float(m['n']) / 100:g}"),
    (r"^how much (?:room|space|distance|headroom|margin) is (?:there )?(?:left )?between what you (?:apply|exert|press with) and what you must (?:never|not) exceed" + _END, "limit_n - force_n"),
    (r"^of the (?:permitted|allowed) (?:maximum|most|force),? what share,?(?: in per ?cent)? (?:remains|is(?: still)?) (?:untouched|unused|free|left|available)" + _END, "100 * (limit_n - force_n) / limit_n, in %"),
    (rf"^dividing {_GRIP} by the (?:force )?limit (?:gives|yields|makes) (?:which|what) (?:decimal )?(?:number|figure|value|ratio)" + _END, "force_n / limit_n"),
    (r"^the (?P<q>ceiling|limit|force|grip|depth|area|mass)(?: on the (?:force|grip))?,? (?:put|expressed|stated|given|written|converted) in(?:to)? (?P<u>[\w²/-]+),? is (?:how much|what)" + _END, lambda m: f"what is the {_NAMES[m['q'].lower()]} in {m['u']}"),
    (rf"^(?P<q>depth|force|grip|area|coverage|limit|mass|weight|x|y)[?:.,;]+ *{_UNITS}(?:,? (?:will do|would do|please|thanks|if you['’]?d? (?:please|be so kind|would|will)|is fine|only|is enough))+" + _END,
     lambda m: f"what is the {_NAMES[m['q'].lower()]} in {m['u']}"),
    (rf"^(?:{_IF} the limit (?:were|was|is|be|been set) {_FORCE} (?P<way>lower|higher|less|more)),? where would it (?:lie|be|stand|come to lie)" + _END, _moved("limit_n", "N")),
    (rf"^(?:{_IF} (?:{_WHOEVER} )?(?P<way>raised|increased|lowered|reduced|decreased|cut|dropped) the limit by {_FORCE}),? how much (?:headroom|room|margin|space) would (?:{_GRIP}|you|we|i) (?:still )?have(?: left)?" + _END,
     lambda m: f"{_moved('limit_n', 'N')(m)} - force_n"),
    (rf"^(?:{_IF} the limit (?:were|was|is|be|been(?: set)?) {_FORCE} (?P<way>lower|higher|less|more)),? would {_GRIP} (?:break|exceed|be over|be above|violate|breach|pass) it" + _END,
     lambda m: f"force_n > {_moved('limit_n', 'N')(m)}"),
    (rf"^(?:{_IF} )?(?:both )?ends of the (?:\w+ )?band (?:were )?(?:shifted|moved|pushed|raised|lowered) (?P<way>up|down|upwards?|downwards?) by {_FORCE},? where would (?:its|the) (?P<end>lower|upper|bottom|top) end (?:come to )?(?:lie|be|stand)" + _END,
     lambda m: _moved("band_low_n" if m["end"].lower() in ("lower", "bottom") else "band_high_n", "N")(m)),
    (rf"^taking {_GRIP} and subtracting the (?P<e>band['’]s (?P<end>lower|upper) end|limit) from it (?:yields|gives|makes|leaves) (?:how many newtons|what)[^?]*" + _END,
     lambda m: f"force_n - {'limit_n' if m['end'] is None else 'band_low_n' if m['end'].lower() == 'lower' else 'band_high_n'}"),
    (r"^(?:you['’]re|you are|we are|we['’]re) (?:holding|gripping|squeezing|pressing)(?: it)? too (?P<way>gently|softly|lightly|loosely|weakly|firmly|hard|tightly|strongly) for this (?:task|job|goal|contract),? (?:right|correct|true|no|aren['’]t you)" + _END,
     lambda m: "force_n > band_high_n" if re.match("f|h|t|str", m["way"], re.I) else "force_n < band_low_n"),
    (r"^(?:(?:is it true that|right or wrong[:;,]|true or false[:;,]|correct or not[:;,]) )?the (?P<end>lower|upper|bottom|top) end of the (?:\w+ )?band has been reached or (?:passed|exceeded|crossed)(?: by the (?:grip|force))?" + _END,
     lambda m: f"force_n >= {'band_low_n' if m['end'].lower() in ('lower', 'bottom') else 'band_high_n'}"),
    (rf"^is (?:the )?{_FORCE} (?:a force )?(?:that )?(?:this task['’]s |the |our )?(?:goal )?band (?:would|will|does|might) (?:accept|allow|permit|contain|include)" + _END, lambda m: f"band_low_n <= {_newtons(m)} <= band_high_n"),
    (rf"^do(?:es)? (?P<way>more|less) than {_FORCE} lie between the (?:two )?ends of the (?:\w+ )?band" + _END, lambda m: f"band_high_n - band_low_n {'>' if m['way'].lower() == 'more' else '<'} {_newtons(m)}"),
    (r"^in (?:the )?band,? or out(?: of (?:the )?(?:band|it))?" + _END, "'in band' if band_low_n <= force_n <= band_high_n else 'out of band'"),
    (r"^(?:with respect to|as to|regarding|concerning) the (?:force )?limit,? are (?:you|we) (?P<a>safe|fine|okay|within|under) or (?P<b>in violation|over|beyond|above|in breach)" + _END, r"'\g<b>' if force_n > limit_n else '\g<a>'"),
    # Masses.
    (r"^(?P<n>\d+) (?:objects|things|fruits|berries|pieces|of these|of them)(?: exactly)? like this(?: one)?,? (?:[^,?]*, )?(?:would|will) (?:have|be|come to|make|weigh) what(?: mass)?(?: in \w+)?" + _END, lambda m: f"mass_g + {int(m['n']) - 1} * mass_g"),
    (rf"^(?:cut|slice|split|halve) {_THING}(?: in(?:to)?)? (?:two|2)? ?(?:equal )?(?:halves|half|parts|pieces)?(?: in your mind)?[:;,.] *what mass(?: in grams)? (?:has|does|would) each(?: half| part| piece)?(?: have)?" + _END, "mass_g / 2"),
    (rf"^how many grams is it away from (?P<n>\d+) ?(?:g|grams?){_SIGNLESS}" + _END, r"abs(mass_g - \g<n>)"),
    (rf"^what (?:do you|does one) get by subtracting {_THING}(?:['’]s)? weight from {_GRIP},? (?:both )?in newtons" + _END, "force_n - 0.00980665 * mass_g, in N"),
    (rf"^is {_THING}['’]s(?: own)? weight (?P<way>smaller|less|lower|larger|greater|higher|more) than (?:{_GRIP}|the force with which you (?:grip|hold|squeeze) it)" + _END,
     lambda m: f"0.00980665 * mass_g {'<' if re.match('s|le|lo', m['way'], re.I) else '>'} force_n"),
    (r"^(?:i['’]d like|give me|tell me|i want) the weight force of (?:the )?\w+,? in (?P<u>\w+)(?: rather than \w+)?" + _END, r"what is the weight of the object in \g<u>"),
    (r"^should (?:this|it) go (?:in)?to the (?P<b>\w+) for (?:items|things|fruits?|objects|ones) (?P<one>under|below|over|above) (?P<n>\d+) ?(?:g|grams?) or (?:to |into )?the (?P=b) for (?:items|things|fruits?|objects|ones) (?P<two>under|below|over|above) (?P=n) ?(?:g|grams?)" + _END,
     lambda m: f"'{m['one']}' if mass_g {'<' if m['one'].lower() in ('under', 'below') else '>'} {m['n']} else '{m['two']}'"),
    # Places.
    (r"^what (?:signed )?(?:sideways|lateral|horizontal) (?:shift|move|correction) in mm,? (?:right being (?:plus|positive),? )?would (?:bring|put|move) the contact(?: cent(?:re|er))? (?:back )?(?:over|to|onto) the (?:pad['’]s )?(?:midline|middle|cent(?:re|er))" + _END, "0 - x_mm"),
    (rf"^{_IF} {_THING} (?:slid|slides?|slipped|slips|moved|moves|shifted|shifts|drifted) {_LENGTH} (?:further )?(?:to |toward |towards )?(?:the )?(?P<way>left|right|fingertips?|tip|palm|top|bottom|up|down)[,;:] *(?:what|at which|where|which) (?:would |y |x |will |its )*[^?]*" + _END, _shifted),
    (r"^what(?:['’]s| is) the (?P<w>smaller|lesser|larger|greater|bigger) of the two (?:absolute )?(?:offsets|distances|shifts),? (?:horizontal and vertical|sideways and lengthways|x and y)" + _END, lambda m: f"{'min' if m['w'].lower() in ('smaller', 'lesser') else 'max'}(abs(x_mm), abs(y_mm))"),
    (r"^going first sideways and then (?:straight )?(?:up or down|along the finger) from the (?:pad['’]s )?(?:middle|cent(?:re|er)) to the contact,? how many (?:mm|millimet(?:re|er)s) (?:would|do) (?:i|you|we|one) travel(?: in total)?" + _END, "abs(x_mm) + abs(y_mm)"),
    (rf"^(?:measured|counted) from (?:a|the) point {_LENGTH} (?P<way>left|right|above|below) (?:of )?the (?:pad['’]s )?(?:middle|cent(?:re|er)),? how far (?:off|away) is the contact(?: cent(?:re|er))?(?: in mm)?" + _END,
     lambda m: {"left": f"hypot(x_mm + {_mm(m)}, y_mm)", "right": f"hypot(x_mm - {_mm(m)}, y_mm)", "above": f"hypot(x_mm, y_mm - {_mm(m)})", "below": f"hypot(x_mm, y_mm + {_mm(m)})"}[m["way"].lower()]),
    # Areas.
    (r"^out of (?:every )?(?:a )?(?P<n>thousand|hundred|\d+) (?:points|spots|cells|dots|parts)(?: (?:on|of) the (?:pad|gel|sensor))?,? how many are (?:touched|covered|in contact)" + _END,
     lambda m: f"area_percent * {float({'thousand': 1000, 'hundred': 100}.get(m['n'].lower(), m['n'])) / 100:g}"),
    (rf"^how many (?:percentage points|per ?cent) (?:separate|lie between) {_AREA} (?:from|and) (?P<n>(?:one )?half|\d+ ?(?:%|per ?cent))(?: of the (?:pad|gel))?{_SIGNLESS}" + _END,
     lambda m: f"abs(area_percent - {50 if 'half' in m['n'] else re.sub('[^0-9]', '', m['n'])})"),
    (rf"^{_IF} {_AREA} (?:shrink|shrank|shrinks|shrunk|grow|grew|grows)(?: to)? (?P<n>half|a third|a quarter|twice|double) (?:its|the)(?: present| current)? size,? (?:what|how many) per ?cent(?:age)?(?: of the (?:pad|gel))? would it (?:still )?(?:take up|cover|fill|occupy)(?: of the (?:pad|gel))?" + _END,
     lambda m: f"area_percent * {_SIZES[m['n'].lower()]:.6g}"),
    # Shapes, and whether anything touches.
    (r"^(?:apart from|besides|other than|except(?: for)?) (?:an? )?(?P<a>\w+) (?:and|or) (?:an? )?(?P<b>\w+),? is it (?:some |an)other (?:shape|form|thing)(?: that)?(?: you feel| you have)?" + _END, r"is it neither a \g<a> nor a \g<b>"),
    (r"^(?:judge|check|assess|evaluate) (?:this|the following) (?:statement|sentence|claim)[:;,] *['\"“](?P<s>[^'\"”]+?)[.!]?['\"”]" + _END, r"is it true that \g<s>"),
    (r"\bridges run across the surface(?: texture)?(?: of (?:the )?\w+)?\b", "the surface is ridged"),
    (r"^(?P<a>full|laden|loaded) or (?P<b>empty),? (?:what(?:['’]s| is) the state of |is |are )?(?:your|the|our) (?:grip|hand|gripper|fingers)" + _END, r"say '\g<a>' if anything touches the pad, otherwise '\g<b>'"),
    (r"^(?P<b>sub-?millimet(?:re|er)) or (?P<a>over a millimet(?:re|er)|more than a millimet(?:re|er)|over 1 (?:mm|millimet(?:re|er)))[:;,?][^?]*" + _END, r"'\g<a>' if depth_mm > 1 else '\g<b>'"),
    (r"^would ['\"“](?P<w>[\w -]+)['\"”] be the (?:level|word|class|grade|label|category) (?:that )?you (?:assign|give|attach|put) to (?:this|the) (?P<s>press|depth|area|contact area|texture|surface|shape|position)(?:,? rather than any other)?" + _END, r"is the \g<s> \g<w>"),
    (r"^which (?:size|area) (?:adjective|word|label|class) would you (?:attach|give|assign|apply) to (?:the )?(?:region|part|area|patch|contact)[^?]*" + _END, "which word for the contact area"),
    (r"^(?P<q>(?:does|is) [^?]*?)\b(?P<w>left|right|top|bottom|middle|upper|lower)(?:[- ]hand)? (?P<k>column|row) of (?:your|the) (?:three[- ]by[- ]three|3 ?(?:by|x|×) ?3) grid" + _END, r"is it in the \g<w> \g<k>"),
    # What a band, a limit or a weight makes of the force.
    (r"^should (?:i|we|you) (?:step|turn|move|change|nudge|take) (?:the )?(?:command|grip|force|set-?point) (?P<a>up) or (?P<b>down) to (?:get to|get into|reach|hit) the middle of the band" + _END, r"'\g<a>' if force_n < (band_low_n + band_high_n) / 2 else '\g<b>'"),
    (r"^(?:[\w ]{0,25}[:,] )?(?P<w>under|below|over|above) the (?:goal |target )?(?:band|range),? or not (?P=w) it" + _END, lambda m: f"'{m['w']}' if {'force_n < band_low_n' if m['w'].lower() in ('under', 'below') else 'force_n > band_high_n'} else 'not {m['w']}'"),
    (r"^(?:would|do) you (?:call|say|find) it(?:['’]s)? (?P<a>too (?P<w>tight|hard|firm|loose|soft|weak)) or (?P<b>not too (?P=w)),? [^?]*\b(?:band|range|goal|target)\b[^?]*" + _END,
     lambda m: f"'{m['a']}' if {'force_n > band_high_n' if m['w'].lower() in ('tight', 'hard', 'firm') else 'force_n < band_low_n'} else '{m['b']}'"),
    (r"\b(?:is the force )?(?P<a>compliant) or (?P<b>non-?compliant) with the limit" + _END, r"'\g<a>' if force_n <= limit_n else '\g<b>'"),
    (rf"^(?P<a>[\w-]+) or (?P<b>[\w-]+)[ ,:;–—-]+(?:and )?say (?P=a) if (?:it['’]s|it is) (?P<c>under|below|over|above|less than|more than) {_FORCE}" + _END, lambda m: f"'{m['a']}' if force_n {'<' if _IS_BELOW.match(m['c']) else '>'} {_newtons(m)} else '{m['b']}'"),
    (r"^compared (?:to|with) the (?:midpoint|middle) of the (?:target |goal )?(?:interval|band|range),? is (?:the )?\w+ (?P<a>above) or (?P<b>below)(?: it)?" + _END, r"'\g<a>' if force_n > (band_low_n + band_high_n) / 2 else '\g<b>'"),
    (r"^shall i (?:classify|count|file|log|book) (?:this|it) as ['\"“](?P<a>[\w -]+)['\"”] \(not (?P<w>over|above|under|below) the (?:goal|band)['’]s (?:top|upper end|bottom|lower end)\) or ['\"“](?P<b>[\w -]+)['\"”]" + _END,
     lambda m: f"'{m['a']}' if {'force_n <= band_high_n' if m['w'].lower() in ('over', 'above') else 'force_n >= band_low_n'} else '{m['b']}'"),
    (r"^(?:do|should) i (?P<b>leave) the (?:grip|force) (?:alone|as it is) or (?P<a>tighten) it,? going by the (?:minimum|lower end|bottom) of the (?:goal|band)" + _END, r"'\g<a>' if force_n < band_low_n else '\g<b>'"),
    (r"^(?:the )?force is (?:more )?near(?:er)? (?:of|to) (?P<a>zero|the limit|limit) or (?:more )?near(?:er)? (?:of|to) (?P<b>zero|the limit|limit)" + _END, r"is the force nearer to \g<a> or to \g<b>"),
    (r"^(?:it is|is it|is there|there is) (?P<a>enough)(?: force)? or (?P<b>too little)(?: force)? for the (?:lower|bottom) (?:border|end|edge|limit) of (?:the )?(?:goal|band)" + _END, r"'\g<a>' if force_n >= band_low_n else '\g<b>'"),
    (r"^(?:so )?(?:are we |is it |is the force )?(?P<a>in) (?:the )?(?:sweet spot|zone|window) or (?P<b>off|out of)(?: it)?(?:,? goal-?wise)?" + _END, r"'\g<a>' if band_low_n <= force_n <= band_high_n else '\g<b>'"),
    (rf"^does {_GRIP} exceed {_THING}['’]s weight(?: force)?" + _END, "force_n > 0.00980665 * mass_g"),
    (r"^(?:confirm or deny|affirm or deny|yes or no)[:,;] *(?:the )?applied force is (?P<c>[^?]+)" + _END, r"is the force \g<c>"),
    (r"^[^?]*\bits (?:top|upper end) is (?:under|below) the (?:never-?exceed (?:value|limit)|limit)" + _END, "band_high_n < limit_n"),
    (r"^[^.?]*[.?] *i mean,? (?:is )?(?:the )?force (?P<w>under|below|over|above) the (?:never-?exceed(?: value)?|limit)" + _END, lambda m: f"force_n {'<' if m['w'].lower() in ('under', 'below') else '>'} limit_n"),
    (r"^(?:the )?force is (?P<w>over|above|more|under|below|less)(?: than)? (?:the )?(?:goal|band)(?:['’]s)? (?:(?P<top>maximum|max|top)|minimum|min|bottom)\b[^?]*\?[^?]*$",
     lambda m: f"force_n {'<' if _IS_BELOW.match(m['w']) else '>'} band_{'high' if m['top'] else 'low'}_n"),
    (rf"^if (?:i|we|you) add {_FORCE},? (?:will|would) (?:it |we |the force )?(?:still )?be (?:still )?(?:below|under|within) the limit" + _END, lambda m: f"force_n + {_newtons(m)} < limit_n"),
    (r"^is the grip[- ]to[- ]weight ratio (?P<w>above|over|more than|below|under|less than) (?P<n>\d[\d.]*)(?:,? with [^?]*)?" + _END, lambda m: f"force_n {'<' if _IS_BELOW.match(m['w']) else '>'} {m['n']} * 0.00980665 * mass_g"),
    (r"^(?:do we have|is there|have we got) a safety factor of (?P<n>\d[\d.]*) or more (?:against|to|towards) the limit" + _END, r"limit_n >= \g<n> * force_n"),
    (rf"^is the (?:allowed |goal |target )?(?:window|band|range) (?P<w>at least|at most|more than|less than) {_FORCE} wide" + _END, lambda m: f"band_high_n - band_low_n {_COMPARED[m['w'].lower()]} {_newtons(m)}"),
    (r"^half-?width of (?:our|the|my) [^?]*?\b(?:zone|band|range|window)\b(?: in newtons)?" + _END, "(band_high_n - band_low_n) / 2"),
    (r"^(?:what['’]?s|what is) the max (?:u|you|i|we) (?:can|may) (?:press|squeeze|grip|push)(?: with)? (?:b4|before) (?:ur|you['’]?re|you are) in trouble" + _END, "what is the limit"),
    (r"^where does the force (?:stand|lie|sit) within the band on a (?:0|zero) to (?:1|one) scale\b[^?]*" + _END, "(force_n - band_low_n) / (band_high_n - band_low_n)"),
    (r"^goal ends (?:on|at) how many newtons from (?P<w>upside|above|the top|downside|below|the bottom)" + _END, lambda m: "band_high_n" if m["w"].lower() in ("upside", "above", "the top") else "band_low_n"),
    (r"^[^?]*\bmax(?:imum)? allowed (?:grip|force) \[(?P<u>m?N)\]['\"”]?[^?]*\?[^?]*$", r"what is the limit in \g<u>"),
    (r"^[^?]*[;,.] *so how many grams is (?:your|the|our) (?:squeeze|grip|force)" + _END, "what is the force in grams"),
    (r"^(?:the gel is pushed in by|the depth is|it is pushed in by) what fraction of an inch" + _END, "depth_mm / 25.4"),
    (r"^how many (?P<u>\w+) (?:toward|towards|to) the (?P<way>palm|fingertip) (?:side )?from (?:the )?(?:pad['’]s )?(?:middle|cent(?:re|er)) (?:does the contact sit|is the contact|does it sit|is it)[ ,(]+(?:negative|minus)[^?]*" + _END,
     lambda m: f"what is {'' if m['way'].lower() == 'palm' else 'minus '}y in {m['u']}"),
    (r"^if (?:i|we|you) (?:put|placed|laid|set) it on an? (?:\w+ )?scales?,? (?:how many|what) (?P<u>grams|kilos|kilograms|ounces) would (?:the display|it|the scale) (?:show|read|say)" + _END, r"what is the mass in \g<u>"),
    (r"^gravity pulls (?:the object|it|on it|on the object) (?:down )?with how many (?P<u>(?:milli)?newtons)" + _END, r"what is the weight of the object in \g<u>"),
    (rf"^by how many newtons does {_GRIP} (?P<w>exceed|fall short of|undershoot) the (?P<end>lower|upper) (?:goal|end of the (?:goal|band)|band limit)" + _END,
     lambda m: " - ".join(("force_n", f"band_{'low' if m['end'].lower() == 'lower' else 'high'}_n")[:: 1 if m["w"].lower() == "exceed" else -1])),
    (r"^have (?:you|we) left the (?:allowed|permitted|goal|wanted) (?:force )?(?:range|band|window)" + _END, "not (band_low_n <= force_n <= band_high_n)"),
    (r"^compared (?:with|to) the (?:maximum|limit),? (?:would you say )?(?:is )?the force (?:is )?(?P<a>under|below) or (?P<b>over|above)(?: it)?" + _END, r"'\g<a>' if force_n <= limit_n else '\g<b>'"),
    (r"^say ['\"“](?P<a>[\w -]+)['\"”] if the contact is in the middle (?:cell|field|zone),? otherwise (?:say )?['\"“](?P<b>[\w -]+)['\"”]" + _END, r"say '\g<a>' if it is centered, otherwise '\g<b>'"),
    # A number asked for around its name.
    (rf"^(?:please )?(?:report|state|give|quote)(?: me)? (?P<q>the [\w' -]+?) in units of {_ANY_UNIT}" + _END, r"what is \g<q> in \g<u>"),
    (rf"^(?:by how many {_ANY_UNIT} would you put|which number of {_ANY_UNIT.replace('<u>', '<v>')} is) (?P<q>the [\w' -]+?)" + _END, lambda m: f"what is {m['q']} in {m['u'] or m['v']}"),
    (rf"^what (?P<q>[\w' -]+?) do you (?:measure|feel|sense|read),? in {_ANY_UNIT}" + _END, r"what is the \g<q> in \g<u>"),
    (rf"^(?:what value does|do you know) (?P<q>the [\w' -]+?)(?: have)?,? in {_ANY_UNIT}" + _END, r"what is \g<q> in \g<u>"),
    (rf"^what(?:['’]s| is) (?P<q>the [\w' -]+?)\? *(?:please )?(?:answer|reply|say it|tell me)(?: it)? in {_ANY_UNIT}" + _END, r"what is \g<q> in \g<u>"),
    (r"^(?!(?:is|are|does|do|has|would|isn['’]t)\b)(?![^?]*(?:\d| than\b|\bwhether\b|\bif\b))[^?]*\b(?:sideways|lateral|horizontal) offset\b[^?]*\b(?:cm|centimet(?:re|er)s?)\b[^?]*", "abs(x_mm), in cm"),
    (r"^in (?:cm|centimet(?:re|er)s),? what is the (?:sideways|lateral|horizontal) offset[^?]*", "abs(x_mm), in cm"),
    (rf"(?P<h>\b(?:sideways|lateral|horizontal|vertical) offset\b[^?\d]*?\b){_LENGTH.replace('mm|', '', 1).replace('milli|', '', 1)}\b", lambda m: f"{m['h']}{_mm(m)} mm"),
    # Statements that somebody makes.
    (rf"^is (?P<q>the [\w' -]+?) anything but (?P<rest>{_COMPARATIVE}\b[^?]*)", r"is it false that \g<q> is \g<rest>"),
    (r"^(?:at (?:the|this) moment|right now|just now|at present|presently|as of now|currently),? (?=(?:is|are|does|do|has|have|what|how|which|where)\b)", ""),
    (rf"^are (?:we|you) (?:sure|certain)(?: that)? (?P<q>the [\w' -]+?) is (?P<rest>{_COMPARATIVE}\b[^?]*)", r"is it true that \g<q> is \g<rest>"),
    (rf"^do you (?:measure|feel|sense|read|see) (?P<q>the [\w' -]+?) (?:as|to be|at) (?P<rest>{_COMPARATIVE}\b[^?]*)", r"is \g<q> \g<rest>"),
    (r"^is it not so that ", "is it true that "),
    (r"^(?:am i|was i|are we) wrong (?:that|in (?:thinking|saying|believing) that|if i (?:say|think|believe) that) ", "is it false that "),
    (r"^would you (?:disagree|object|contradict me) if i (?:said|claimed|told you|stated) (?:that )?", "is it false that "),
    (r"^(?:someone|somebody|my \w+|he|she|they|people|the \w+|a \w+) (?:claims?|says?|thinks?|believes?|told me|insists?) that (?P<s>[^.?;]+)[.;] *is (?:that|it|this) (?P<w>so|true|right|correct|false|wrong|untrue|a lie)" + _END,
     lambda m: f"is it {'true' if m['w'].lower() in ('so', 'true', 'right', 'correct') else 'false'} that {m['s']}"),
    (r"^is (?:the|this) (?:statement|claim|sentence)[:,]? ['\"“](?P<s>[^'\"”]+?)[.]?['\"”],? (?P<w>true|right|correct|accurate|false|wrong|untrue|incorrect|inaccurate)" + _END,
     lambda m: f"is it {'true' if m['w'].lower() in ('true', 'right', 'correct', 'accurate') else 'false'} that {m['s']}"),
    # Masses, sizes and places in other words.
    (r"^is it (?P<a>lighter|heavier) or (?P<b>lighter|heavier) than an? (?P<n>\d+)[- ](?:gram|g) [\w ]+" + _END, lambda m: f"'{m['a']}' if mass_g {'<' if m['a'].lower() == 'lighter' else '>'} {m['n']} else '{m['b']}'"),
    (r"^[^?]*['\"“](?P<a>\w+)['\"”] (?:bin|box|tray|pile|class) \((?:up to|at most) (?P<n>\d+) ?(?:g|grams)\) or (?:in |into )?(?:the )?['\"“](?P<b>\w+)['\"”](?: (?:bin|box|tray|pile|class))?" + _END, r"'\g<a>' if mass_g <= \g<n> else '\g<b>'"),
    (r"^would you (?:book|count|log|file|record|enter) (?:this|it) as (?P<a>over|under) or (?P<b>over|under) (?P<n>\d+) ?(?:g|grams)" + _END, lambda m: f"'{m['a']}' if mass_g {'>' if m['a'].lower() == 'over' else '<'} {m['n']} else '{m['b']}'"),
    (r"^do(?:es)? (?:the )?(?:goods|object|fruit|it|thing)(?: in hand)? reach the (?:contracted |promised |agreed |required )?(?P<n>\d+) ?(?:g|grams)" + _END, r"mass_g >= \g<n>"),
    (r"^if i (?:pack|take|buy|stack) (?P<n>\d+) of (?:exactly )?(?:this|these|this one),? how many grams is that" + _END, lambda m: f"mass_g + {int(m['n']) - 1} * mass_g"),
    (r"^what (?:would|is) the gravitational (?:load|force) (?:of|on) the object (?:be )?in (?P<u>\w+)[^?]*" + _END, r"what is the weight of the object in \g<u>"),
    (r"^(?:for [^?]{1,20} )?(?:i need |give me |what is )?(?:the )?euclidean (?:offset|distance)(?!.*\b(?:[µu]m|cm|microns?)\b) [^?]*", "hypot(x_mm, y_mm)"),
    (r"^(?:the )?squared distance of the contact from the (?:pad )?cent(?:re|er)[^?]*", "x_mm ** 2 + y_mm ** 2"),
    (r"^do both coordinates have the same sign\b[^?]*", "x_mm * y_mm > 0"),
    (r"^could you express the contact area as a fraction between (?:0|zero) and (?:1|one)" + _END, "area_percent / 100"),
    (rf"^thickness of the dent compared (?:to|with) a \w+ of \w+ of {_LENGTH}[:;,] *how many \w+" + _END, lambda m: f"depth_mm / {_mm(m)}"),
    (r"^the contact (?:point|cent(?:re|er)),? from (?:the )?cent(?:re|er) to (?:the )?(?P<w>upper|lower|right|left) direction,? how many millimet(?:re|er)s?\b[^?]*\?[^?]*$",
     lambda m: {"upper": "y_mm", "lower": "0 - y_mm", "right": "x_mm", "left": "0 - x_mm"}[m["w"].lower()]),
    (r"^how many millimet(?:re|er)s off-?cent(?:re|er) (?:was|is) (?:the )?\w+,? counting only (?P<w>up-down|left-right)" + _END, lambda m: f"abs({'y' if m['w'].lower() == 'up-down' else 'x'}_mm)"),
    (rf"^[^?]*\bside, (?P<x>[xy]) (?P<w>above|below|over|under) {_LENGTH}" + _END, lambda m: f"{m['x']}_mm {'<' if _IS_BELOW.match(m['w']) else '>'} {_mm(m)}"),
    (r"^[^?]*\bi mean,? is it low down (?:by|near|at) the fingertips?" + _END, "is it in the bottom half"),
    (r"^(?:does|do|is) [^?]*\b(?:leans?|lies?|sits?) (?P<a>leftward) or (?P<b>rightward)\b[^?]*", r"'\g<a>' if x_mm < 0 else '\g<b>'"),
    (r"^(?P<a>\w+) \(palm side\) or (?P<b>\w+) \(fingertip side\)[^?]*", r"'\g<a>' if y_mm > 0 else '\g<b>'"),
    (r"^which of the (?:nine|9) (?:zones|fields|cells|regions) is (?:the )?\w+ (?:reported |felt )?in" + _END, "where on the pad is it"),
    # Shape, skin, and whether anything is held.
    (r"^(?:now )?how does its (?:skin|surface) feel (?:on|to|under) your (?:finger|pad|skin)\b[^?]*", "what is the texture"),
    (r"^morphology of the contact\b[^?]*", "what shape is it"),
    (r"^[^?]*\bpromised an? (?P<a>\w+) or (?P<b>\w+) surface[;,.] *did we get (?:either|one)(?: of (?:these|them|the two))?" + _END, r"is the texture \g<a> or \g<b>, yes or no"),
    (r"^(?:have )?(?:you|u) got hold of (?:it|something|anything)(?: or (?:what|not))?" + _END, "is anything touching the pad"),
    (r"^are you (?:actually|really) holding (?:something|anything)\b[^?]*", "is anything touching the pad"),
    (r"^[^?]*\bis anything there on your (?:skin|pad|gel|finger)" + _END, "is anything touching the pad"),
    (r"^is the (?:little )?contact (?:light|lamp|led|indicator) on\b[^?]*\?[^?]*$", "is anything touching the pad"),
    (r"^contact[.,:;?]* (?:affirm|affirmative|yes|confirm) or (?:negative|no|deny)" + _END, "is anything touching the pad"),
    # What is told around a question.
    (rf"^(?:say|report|send|give) (?P<q>depth|force|grip|area|limit|mass|weight|x|y)[.,;:]+ *{_UNITS}[.,;: ]*(?:over|out)?" + _END, lambda m: f"what is the {_NAMES[m['q'].lower()]} in {m['u']}"),
    (r"^[\w ]{0,15}\bstatus[:,] *(?P<q>grip force|force|depth|area|mass|limit)" + _END, r"what is the \g<q>"),
    (r"^(?:i['’]ve|i have|we['’]ve|we have) got [^,?]{1,40}, (?=(?:what|how|is|where)\b)", ""),
    # What touch can't know.
    (r"\bhow much (?:per|a|for a|by the) (?:kilo|kilogram|kg|pound|punnet|piece|dozen)? ?do(?:es)? (?:they|it|he|she|you|one) (?:charge|cost|ask|pay|take)\b[^?]*", "what is its price"),
    (r"^(?:which|what) cultivar\b[^?]*", "what variety is it"),
    (r"\b(?:are|is) (?:there )?(?:any )?(?:pesticides?|pesticide residues?|fungicides?|chemicals)\b[^?]*", "is it organic"),
    (r"^(?P<q>does|do) (?:its|the) (?:surface|skin|peel) (?:gleam|shine|glisten|glitter|sparkle|glow)\b[^?]*", "is it shiny"),
    (r"^(?P<q>(?:does|do|is) [^?]*?)\bwhat (?:you|we|i) (?:may|can|are allowed to) (?:apply|exert|use) at (?:the very |the )?most" + _END, r"\g<q>the limit"),
    (r"^does what (?:you|we|i) (?:apply|exert|press with) (?:amount|come) to ", "is the force "),
)  # fmt: skip
_COMPILED = tuple((re.compile(pattern, re.I), plain) for pattern, plain in _SUPPOSED)


def supposed(text: str) -> str:
    """A question as an expression, or in plainer words; the text itself where it has none here."""
    for each in (text, in_digits(f"{text[:1].lower()}{text[1:]}")):
        said = each
        for pattern, plain in _COMPILED:
            said = pattern.sub(plain, said)
        if said != each:
            return said
    return text
