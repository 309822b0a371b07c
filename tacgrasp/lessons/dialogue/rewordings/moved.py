"""Parts of a question that stand elsewhere, or are said more plainly, in one of the same meaning.

    I'd like to know, in µm, how deep it is.                  how deep it is, in µm
    If the limit counts as 100 %, at what % is the force?     what percentage of the limit is the force
    Take the force away from the limit; what is left, in N?   what is the limit minus the force, in N
    On the left, does it go over the edge?                    does it go over the left edge
    How many newtons are left (zero if none)?                 How many newtons are left, zero if none

Not here: constructions with a denial or a choice (``reworded``), phrases that have a plainer one in
the same place (``phrases``).
"""

from __future__ import annotations

import re
from collections.abc import Callable

_END = r"(?=[?.! ]*$)"
_UNIT = r"(?P<unit>m?N|mm²?|[µu]m|cm²?|g|%|(?:milli|micro|centi)?(?:newtons?|met(?:re|er)s?)|microns?|grams?|per ?cent)"
_ASKS = r"(?:how|what|where|by how|which)\b"
_SUPPOSED = (
    r"(?:suppose|supposing|assume|assuming|imagine|let(?:['’]s| us) (?:say|suppose|assume)|say)"
)
_WHOLE = r"(?:100 ?(?:%|per ?cent)|a hundred (?:%|per ?cent)|one hundred (?:%|per ?cent))"
_SIDE = r"(?P<side>left|right|top|bottom|upper|lower|palm|fingertip)"
_NUMBER = r"(?:\d[\d.,]*|half an?|one|two|three|an?) ?(?:m?N|mm²?|[µu]m|cm²?|%|(?:milli|micro|centi)?(?:newtons?|met(?:re|er)s?)|microns?|per ?cent)"
_MASS = r"(?:\d[\d.,]* ?(?:k?g|grams?|kilos?|kilograms?|oz|ounces?|pounds?)|(?:a quarter of a|half a) (?:kilo(?:gram)?|pound))"
_BAND = r"(?:the |our |its )?(?:force |target )?band"


def _to_edge(found: re.Match[str]) -> str:
    unit = f", in {found['unit']}" if found["unit"] else found["behind"] or ""
    return f"how far is the contact from the {found['side']} edge{unit}"


def _to_end(found: re.Match[str]) -> str:
    other = "fingertip" if found["end"].lower() == "palm" else "palm"
    end = "palm" if other == "fingertip" else "fingertip"
    unit = f", in {found['unit']}" if found["unit"] else ""
    return f"how far towards the {end} is it, minus for the {other}{unit}"


OTHER_HALF = {
    "left": "right",
    "right": "left",
    "upper": "lower",
    "lower": "upper",
    "top": "bottom",
    "bottom": "top",
}
"""The half of the pad opposite to each."""


def _other_half(found: re.Match[str]) -> str:
    other = OTHER_HALF[found["half"].lower()]
    return f"lie in the {other} half"


def _by_how_much(found: re.Match[str]) -> str:
    is_above = re.match(r"stronger|harder|above|over|higher|more", found["how"], re.I)
    side = "above" if is_above else "below"
    return f"by how {found['n']} is {found['a']} {side} {found['b']}, zero if it isn't"


_MOVED: tuple[tuple[str, str | Callable[[re.Match[str]], str]], ...] = (
    (rf"^(?P<head>[^?,]*\b(?:know|tell me|say|hear|learn|give me|told|see)),? in {_UNIT},? (?P<asks>{_ASKS}[^?.]*)",
     r"\g<asks>, in \g<unit>"),
    (rf"^(?:if|with|when|where|taking|counting|say|suppose) (?P<b>the [^,]+?) (?:(?:counts?|is|taken|is taken|makes?|represents?|counted|is set|being|equals?|stands? for|set) )*(?:as |to |at )?{_WHOLE}(?: (?:of it|mark))?,? (?:at )?(?:how many|what|which) (?:%|per ?cent\w*)(?: of (?:it|that))? (?:is|are|would|does|do|lies?|have) (?P<a>(?:the|our|my|your|this) [^?]+?)(?: (?:be|lie|stand|at|reach(?:ed)?|now|then|sit))*(?=[?.! ]*$)",
     r"what percentage of \g<b> is \g<a>"),
    (rf"^(?:(?:expressed|given|stated|put|told|written|taken|measured) )?(?:as|in) (?:a )?(?:per ?cent(?:age)?s?|share|%) of (?P<b>(?:the|our) [^,]+?),? (?:how (?:high|large|big|great|much|strong|hard)|what) is (?P<a>[^?]+?){_END}",
     r"what percentage of \g<b> is \g<a>"),
    (rf"^(?:if (?:you|i|we) )?(?:take|subtract|deduct) (?P<a>the [^,;]+?)(?: away)? from (?P<b>the [^,;?]+?)[,;:.–—-]+ *(?:and )?(?:what|how much|how many newtons|how many grams) (?:is|are|remains?|do (?:you|we|i) (?:get|have)|does that (?:give|leave|make))(?: left)?(?: over)?(?P<rest>,? in \w+)?{_END}",
     r"what is \g<b> minus \g<a>\g<rest>"),
    (rf"^(?:on|at|towards?|to) the {_SIDE}(?: (?:side|end|hand side))?, (?P<rest>(?:does|is|has|do)\b[^?]*?\b(?:the|its|any) )(?P<edge>edge|border|rim)\b",
     r"\g<rest>\g<side> \g<edge>"),
    (rf"\b(?:goe?s?|reach(?:es)?|extends?|spills?) (?:out )?(?:over|past|beyond) (?P<edge>the {_SIDE} (?:edge|border|rim))(?: of the (?:pad|gel|sensor))?", r"run off \g<edge>"),
    (rf"^{_SUPPOSED}(?: that)? (?P<told>[^?:;]+)[:;–—-]+ (?=(?:{_ASKS}|will|would|is|are|does|do|can))",
     r"if \g<told>, "),
    (r"^suppos(?:e|ing)(?: that)? (?=(?:i|we|you) (?:add|put|take|remov|increas|reduc|lower|rais|eas)\w*\b)", "if "),
    (r"(?P<n>\d ?m?N|newtons?) to the (?:present |current )?force(?: (?:that )?(?:we|you|i) (?:have|apply|feel)(?: got)?)?(?: right)?(?: now)?(?=[:,;])", r"\g<n>"),
    (r"(?<=, )how many newtons would (?:i|we|you)(?: then)? (?:still )?have (?:left )?(?=(?:up )?to the limit)",
     "how many newtons are left "),
    (r"\b(?P<a>newtons (?:are|would be)(?: then)?(?: still)? left|how much is(?: then)? left) (?=to the limit)",
     r"\g<a> up "),
    (r"(?<=, )how much is left up (?=to the limit)", "how many newtons are left up "),
    (r"\bleft before (?P<what>(?:the|our) (?:force )?limit) is (?:reached|hit|met|used up)\b", r"left to \g<what>"),
    (r" ?\((?P<zero>(?:zero|0|nothing|nil) (?:if|when|where|otherwise)\b[^()]*|(?:if|when) [^()]*\b(?:zero|0))\)", r", \g<zero>"),
    (r"\bsay (?P<zero>0|zero) (?:otherwise|if not|else)\b", r"\g<zero> otherwise"),
    (r"^short of (?P<end>the (?:lower|bottom) (?:edge|end|bound) of the band) by how many newtons,? (?:zero|0) (?:if|when)\b[^?]*",
     r"by how many newtons is it short of the lower end of the band, zero if it isn't"),
    (rf"^use words,? (?:and )?not (?:coordinates|numbers|figures|digits|millimet\w+),? to (?:say|tell me|describe|state) (?P<asks>{_ASKS}[^?.]*)",
     r"\g<asks>, in words"),
    (r"^in words(?:,| and) not (?:in )?(?:coordinates|numbers|figures|digits|millimet\w+), ", "in words, "),
    (r"(?<=in words), not (?:in )?(?:coordinates|numbers|figures|digits|millimet\w+)", ""),
    (rf"^(?:say|tell me|describe) where (?P<what>the \w+|it) is,? in words{_END}", r"where is \g<what>, in words"),
    (rf"\bwhere (?:the|this) (?:touch|contact|press|imprint|spot|patch) is, in words{_END}|\bwhere is the (?:touch|contact|press|imprint|spot|patch),? in words{_END}",
     "where is it, in words"),
    (r"^(?:i['’]d like|i want|give me|please give me|i would like|i need) (?:one|a|a single) (?:short )?sentence (?:that|which) (?:names|gives|tells|says|states)(?: me)? (?P<a>the [^?,]+?),? and (?:also )?(?:says|tells|gives|states)(?: me)?(?P<words> in (?:plain )?words)? how deep (?:it|the \w+) (?:is|was|has)? ?(?:been )?(?:pressed|gone|sunk)?(?=[?.! ]*$)",
     r"what is \g<a>, and how deep is it\g<words>"),
    (r"^what would you (?:call|say)\b[^?]*? ?[–—:,-]+ (?P<a>[a-z]+) or (?P<b>[a-z]+)(?=[?.! ]*$)", r"\g<a> or \g<b>"),
    (r"^(?P<aux>is|has|have|are) (?P<s>it|this|that|we|the \w+) (?:(?:gone|pressed|sunk|been pressed|got) )?(?P<a>more|less) than (?P<n>[\d.,]+ ?[a-zµ%²]+)(?P<deep> deep)? or (?P<b>more|less) than (?P=n)(?: deep)?(?=[?.! ]*$)",
     r"is \g<s> \g<a> or \g<b> than \g<n>\g<deep>"),
    (r"^(?:of|comparing|between) (?:the (?:contact['’]s )?two|both|the contact['’]s(?: two)?) (?:offsets|distances)[^,]*, (?:which is (?:the )?(?:bigger|larger|greater)[:,–—-]+ |is )(?:the )?(?P<a>sideways|lengthwise|horizontal|vertical)(?: one)? or (?:the )?(?P<b>sideways|lengthwise|horizontal|vertical)(?: \([^)]*\))?(?: one)?(?: (?:the )?(?:bigger|larger|greater))?(?=[?.! ]*$)",
     r"is the offset larger \g<a> or \g<b>"),
    (r"^(?:an? |the )?(?:minimum|least) of (?P<n>[\d.,]+ ?m?N)\b[^?]*?[.;:,–—-]+ (?:and )?(?:is|has|was) (?:that|it|this) (?:been )?(?:reached|met|satisfied|fulfilled|attained)(?: by (?:the|our) (?:\w+ )?force)?(?=[?.! ]*$)",
     r"is the force at least \g<n>"),
    (r"^(?:an? |the )?(?:maximum|most) of (?P<n>[\d.,]+ ?m?N)\b[^?]*?[.;:,–—-]+ (?:and )?(?:is|has|was) (?:that|it|this) (?:been )?(?:respected|kept|observed|honou?red|met)(?: by (?:the|our) (?:\w+ )?force)?(?=[?.! ]*$)",
     r"is the force at most \g<n>"),
    (r"\b(?:allowed|permitted|permissible|agreed|prescribed) (?:force )?limit\b", "limit"),
    (r"^has (?P<s>the force|it|the grip) (?:climbed|risen|got|grown|gone up|gone|come up) to (?P<n>[^?]+?)(?: or (?:beyond|more|above|higher|over))?(?=[?.! ]*$)",
     r"is \g<s> at least \g<n>"),
    (r"^is (?P<s>the force|it) (?:at )?(?P<n>[^?]+? of the limit) or (?:beyond|more|above|higher|over)(?=[?.! ]*$)", r"is \g<s> at least \g<n>"),
    (rf"^(?P<a>lift|go|raise|hoist|start) or (?P<b>wait|hold|stay|stop|don['’]t)[:,;–—-]+ *(?:what|which)(?: of (?:them|these|the two))? does {_BAND} (?:call for|say|want|demand|ask for|suggest|tell \w+ to do)(?=[?.! ]*$)",
     r"say '\g<a>' if the force is in the band, otherwise '\g<b>'"),
    (r"^(?=(?:should|must|does|ought) (?:the|this|our|my) (?:grip|force|squeeze) (?:have to |need to |to )?be (?:tightened|increased|raised|loosened|reduced|lowered|eased|relaxed)\b[^?]*\bor\b)",
     "to get into the band, "),
    (r"^how (?:heavy (?:can|could|may)|much (?:can|could|may)) (?:an? |the |this )?\w+(?: \w+)? (?:be|weigh),? in (?P<unit>\w+),? (?:and|so that|such that|while|before|without)\b[^?]*\b(?:slip|hold|held|drop|fall|slid)\w*\b[^?]*(?=[?.! ]*$)",
     r"how many \g<unit> does the grip surely hold"),
    (r"^(?P<way>sideways|lengthwise|horizontally|vertically), (?P<rest>by how (?:many|much) \w+ (?:are we|is it|is the (?:contact|touch)|does it (?:lie|sit)) off(?: the)? (?:cent(?:re|er)|middle))(?:,? (?:never mind|regardless of|no matter) (?:in )?(?:which|what|the) (?:direction|way|side))?(?=[?.! ]*$)",
     r"\g<rest> \g<way>"),
    (r"^(?:by )?how many (?P<unit>\w+) (?:are we|is it|is the (?:contact|touch)|does it (?:lie|sit)) off(?: the)? (?:cent(?:re|er)|middle),? (?P<way>sideways|lengthwise|horizontally|vertically)(?=[?.! ]*$)",
     r"how many \g<unit> is it off \g<way>"),
    (r"\bthe (?:thing|object|item|piece|part|body)(?: that| which)(?:['’]s| is| are) (?:touching|pressing (?:on|against|into)|pushing (?:on|against)|resting on|lying on|in contact with|under|on) (?:the |your )?(?:pad|gel|sensor|finger|fingertip)\b", "it"),
    (r"\bthe (?:thing|object|item|piece|part)(?: that| which)? you(?:['’]re| are) (?:touching|holding|feeling|gripping)\b", "it"),
    (r",? with (?:none|no part|nothing) of it (?:cut off|lost|missing|hanging over|outside)\b[^?]*(?=[?.! ]*$)", ""),
    (rf"\bhow many (?P<unit>\w+) (?:above or below|below or above) the (?:pad['’]s )?(?:middle|cent(?:re|er))(?: line)? (?:does the (?:touch|contact) (?:sit|lie)|is (?:it|the (?:touch|contact)))(?:,? (?:sign ignored|ignoring the sign|without (?:a |the )?sign))?{_END}", r"how many \g<unit> is it off vertically"),
    (rf"\bhow many (?P<unit>\w+) (?:left or right|right or left) of the (?:pad['’]s )?(?:middle|cent(?:re|er))(?: line)? (?:does the (?:touch|contact) (?:sit|lie)|is (?:it|the (?:touch|contact)))(?:,? (?:sign ignored|ignoring the sign|without (?:a |the )?sign))?{_END}", r"how many \g<unit> is it off sideways"),
    (rf"^(?:please )?(?:give|tell|state|name)(?: me)? the distance,?(?: in (?P<unit>\w+),)? (?:from|between) (?:the (?:middle|cent(?:re|er)) of )?the (?:contact|touch|imprint) (?:to|and) the (?:pad['’]s )?{_SIDE}(?:-hand)? (?P<edge>edge|border|rim)(?:, the pad being [^?]*)?(?P<behind>,? in \w+)?{_END}",
     _to_edge),
    (r"^(?P<head>how much of (?:the |your )?(?:pad|gel|sensor)),? (?:as a percentage|in per ?cent|as a per ?cent),? (?=is\b|are\b|stays\b|remains\b|does\b)", r"\g<head> "),
    (rf"^if (?P<a>the (?:grip|force|squeeze)|it) is (?P<how>weaker|softer|lower|less|below|under|short of|stronger|harder|above|over|higher|more)(?: than)? (?P<b>(?:the |our )?(?:force |target )?(?:band|limit|range))[,:;] *(?:tell me |say )?by how (?P<n>many newtons|much)[;,.] *(?:and )?(?:if (?:it is(?:n['’]t| not)|not)|otherwise|else),? (?:say |answer |tell me )?(?:zero|0){_END}",
     _by_how_much),
    (rf"^the (?:force |target )?band\b[^.?]*[.;] *how wide is it(?P<unit>,? in \w+)?{_END}", r"how wide is the band\g<unit>"),
    (rf"^(?:the )?(?P<a>(?:(?:present|current|felt|grip) )*force|depth|area) as (?:an? )?(?:%|per ?cent(?:age)?) of (?P<b>[^?,]+?){_END}", r"what percentage of \g<b> is the \g<a>"),
    (rf"^(?:divide|take) the (?P<a>[^,?]+?) (?:divided )?by the (?P<b>[^,?]+?)(?: and|,|;)+ (?:give|tell)(?: me)? the (?:ratio|result|quotient)(?: as a (?:decimal|number))?{_END}", r"what is the \g<a> divided by the \g<b>"),
    (r" ?\(take g ?= ?[^)]*\)", ""),
    (r"^(?:going by|given|based on|from|using|by|with) the (?:object['’]s )?mass (?:that )?(?:you['’]ve been given|you were given|you know|i told you|(?:as )?given|told), ", ""),
    (r"^(?:if|were|should) (?:the object|it|the thing) (?:were to )?(?:pushe?s?|goe?s?|sinks?|presse?s?|digs?) in (?:by )?another (?P<n>[\d.,]+ ?[a-zµ]+),? ", r"if it went \g<n> deeper, "),
    (r"(?<=deeper, )what(?:['’]s| is| would be) the (?:total |new |whole )?depth(?: be)?,?(?P<unit> in \w+)?", r"how deep would it be\g<unit>"),
    (rf"^(?:please )?confirm or deny(?: please)?[:,–—-]+ *(?P<s>(?:the|it|there|we|this|that) [^?]+?){_END}", r"is it true that \g<s>"),
    (rf"^(?:the|this|my|our|an?|it) ?[^.?;]*? ?weighs? (?:about )?(?P<m>{_MASS})[.;,] *(?P<q>[^?.]*\b(?:hold|carry|lift|bear|support)) (?:it|that)(?P<rest>[^?.]*){_END}",
     r"\g<q> \g<m>\g<rest>"),
    (r"\bwould (?:that|it|this) bring (?:the force|it|us) (?:up )?to (?P<b>[^?]+?) or (?:higher|more|above|beyond)(?=[?.! ]*$)", r"would the force be at least \g<b>"),
    (r"\bthe (?P<a>sideways|horizontal) (?P<o>offset|distance) (?P<v>bigger|larger|greater) than the (?:up-and-down|lengthwise|up and down)(?: one)?\b", r"the \g<a> \g<o> \g<v> than the vertical one"),
    (r"^looking at how far it is off[- ]cent(?:re|er), ", ""),
    (r"\bof the (?:pad['’]s )?(?:four )?edges,(?: [a-z, ]+?,)? which (?:one )?is (?P<near>nearest|closest) to\b", r"which of the four edges is \g<near> to"),
    (r"\bwhich is the (?P<more>bigger|larger|greater|smaller) (?:number|value|figure)(?: just now| right now| now| at the moment)?, ", r"which is \g<more>, "),
    (rf"^(?:were|if|with|suppose) (?P<n>{_NUMBER}) (?:(?:were|is|was|as) )?the (?:goal|target|aim)[^?]*?,? by how (?:many \w+|much)[^?]*\bwould the (?P<what>depth|force|area)\b[^?]*\bmiss (?:it|that){_END}", r"how far is the \g<what> from \g<n>"),
    (r"^(?:(?:forget|ignore|never mind|leave out|skip)(?: about)? (?:the )?(?:sideways|lengthwise|left and right|up and down|depth|force|area|shape|position)|leave the (?:depth|force|area|shape|position) out of it)[:;.,] *(?=(?:how|what|where|which|is|does|are)\b)", ""),
    (r"^not sideways and not lengthwise,? but as the crow flies, ", "in a straight line, "),
    (r"^(?:in a straight line|as the crow flies), (?P<q>how (?:many \w+|far)\b[^?]*?\b(?:away )?from) (?:the )?(?:dead )?(?P<c>cent(?:re|er)|middle)", r"\g<q> the \g<c>"),
    (rf"^(?:with|taking|using|if) (?P<n>{_NUMBER}) (?:as|is|being) (?:the |our |my |a )?(?:yardstick|reference|full scale|whole|benchmark), what percentage of (?:it|that) is (?P<a>[^?]+?){_END}", r"what percentage of \g<n> is \g<a>"),
    (r"\bthe (?:straight-line |direct )?distance from the (?:pad['’]s )?cent(?:re|er) to the (?:contact|touch|imprint)\b", "the distance from the centre"),
    (r"\bif the (?:footprint|contact|patch|imprint) were (?:reshaped into|made into|turned into) a square[^,]*, how (?:many \w+ )?long would (?:one|a|each) side be\b", "what side would a square of the same area have"),
    (r"\bpress worth (?=in )", "press "),
    (r"\b(?:has|have) not (?:yet )?been used(?: up)?(?: yet)?(?: \([^)]*\))?(?=[?.! ]*$)", "is unused"),
    (rf"^more than (?P<a>{_NUMBER}) (?:but|and) less than (?P<b>{_NUMBER})[:,–—-]+ *(?P<aux>does|is) (?P<s>the \w+|it) (?:fall|lie|sit|come|stand)?s? ?(?:between|within|in)? ?(?:those|these|that|the two)?(?: two| range| limits)?{_END}", r"is \g<s> between \g<a> and \g<b>"),
    (rf"^(?P<n>{_NUMBER})[:;–—-]+ *(?P<aux>does|has|is|do|have) (?P<s>the \w+|it|we|you) (?:clear(?:ed)?|top(?:ped)?|exceed(?:ed)?|beat(?:en)?|pass(?:ed)?|surpass(?:ed)?|over|above) (?:that|it|this){_END}", r"does \g<s> exceed \g<n>"),
    (rf"^(?P<n>{_NUMBER})[:;–—-]+ *(?P<aux>does|has|is|do|have) (?P<s>the \w+|it|we|you) (?:fall short of|fallen short of|stay(?:ed)? (?:under|below)|below|under|short of|undercut) (?:that|it|this){_END}", r"is \g<s> below \g<n>"),
    (r"^is the (?:gel|pad|sensor)(?: lying)? (?:flush|undented|flat|unpressed)\b[^?]*", "is the gel untouched"),
    (rf"^both (?P<a>[a-z]+) and (?P<b>[a-z]+)[:,;–—-]+ *(?:does|is|do|are) [^?]*\b(?:both|boxes|true|hold|apply|the case)\b[^?]*{_END}", r"is it both \g<a> and \g<b>"),
    (rf"\bstraddles? the (?:boundary|edge|border|rim)(?: of the (?:pad|gel))?(?: (?:at|on) the {_SIDE}(?: (?:end|side))?)?", r"run off the \g<side> edge"),
    (r"\b(?:lie|lies|be|is|sit|fall) outside the (?P<half>left|right|upper|lower|top|bottom) half\b", _other_half),
    (rf"^if (?:it|the \w+) (?:weighed|weighs|were|was|had (?:the heft|a (?:mass|weight)) of) (?P<m>{_MASS}),? (?P<q>(?:would|will|could|does|can|do)\b[^?]*\b(?:hold|carry|lift|bear|support)) (?:it|that)(?: up)?{_END}", r"\g<q> \g<m>"),
    (rf"^if (?:it|the \w+) (?:weighed|weighs|were|was|had (?:the heft|a (?:mass|weight)) of) (?P<m>{_MASS}),? (?P<aux>would|will|could) it (?P<how>(?:surely |still |securely )?)be (?:held|carried|safe)(?: up)?{_END}", r"\g<aux> this grip \g<how>hold \g<m>"),
    (r"\b(?:can|could|may|do|would|should) (?:i|we|you) (?:trust|count on|rely on|expect) (?:this|the|our|my) (?:grip|pinch|hold|grasp|squeeze|gripper) not to (?:let (?:it|that) (?:slip|slither|slide|fall|drop)\w*(?: (?:out|away))?|drop (?:it|that)|lose (?:it|that))", "would this grip hold it"),
    (r"^skipping (?:the )?(?:figures|numbers|digits), ", "in words, "),
    (r"\bwhich offset(?: from the (?:middle|cent(?:re|er)))? is the (?P<how>smaller|larger|bigger|greater)(?: one)?, ", r"which offset is \g<how>, "),
    (rf",? (?:in )?{_UNIT}(?:,| and)? not (?:in )?(?:mm|millimet\w+|microns?|m?N|newtons?|millinewtons?|grams?|inches)(?=[?.! ]*$)", r", in \g<unit>"),
    (r"^(?:(?:i|we) )?(?:need|want) (?:a|the|some) (?:one-liner|summary|line|readout|report|overview)(?: for [^:]*)?: ", ""),
    (r"^[^,?]*\bcan['’]?t see\b[^,?]*?,? so (?:just )?(?=tell me\b)", ""),
    (r"\btell me (?:if|whether) (?P<s>it|anything|something) (?P<v>touches|is touching)(?P<o> something| anything| it)?(?: or not)?(?:,? yes ?(?:/|or) ?no)?(?=[?.! ]*$)", "is anything touching it"),
    (rf"\b(?:goe?s?|reach(?:es)?|extends?|spills?|runs?) (?:past|over|beyond|off) the left or the right (?:edge|border|rim)(?:,? either(?: one)?)?{_END}", "run off the left edge or the right edge"),
    (r"^i want to trust [^,?]*? so tell me, ", ""),
    (rf"^(?:by )?how (?:many (?P<unit>\w+)|far) (?:in )?towards? the (?P<end>palm|(?:finger)?tip)(?: (?:side|end))? (?:does (?:it|the \w+) (?:sit|lie)|is (?:it|the \w+))(?: (?:away )?from (?:the )?(?:pad(?:['’]s)? )?(?:cent(?:re|er)|middle))?,? (?:and )?(?:\(?use )?(?:a )?(?:negative|minus)(?: sign)? (?:if|when|for|meaning|where)[^?]*{_END}", _to_end),
    (rf"\bleaves? the (?:pad|sensor|gel) (?:at|on|over|across|by) the {_SIDE}(?:-hand)? (?:border|edge|rim|side)\b", r"run off the \g<side> edge"),
    (r"\b(?P<what>position|place|location|depth|area) as a word\b", r"\g<what> in words"),
    (r"\bthe indent\b", "the indentation"),
    (r"^(?:ok(?:ay)? (?:robot|gripper|machine)|now that (?:it|that|this|everything) (?:has|is) \w+|without (?:looking|guessing|checking)\b[^,?\d]*|off the top of your head), ", ""),
    (r",? or what(?=[?.! ]*$)", ""),
    (r", (?:as we speak|roughly speaking|generally speaking|do you (?:think|reckon|suppose)|would you say|at this (?:very )?(?:moment|point|instant)|right now|honestly|in your (?:own )?(?:view|opinion|estimation)), ", " "),
    (r"^by how many (?P<unit>\w+) do (?P<a>(?:the |our )?[^?]*?) and (?P<b>(?:the |our )[^?]*?) differ(?=[?.! ]*$)", r"how far is \g<a> from \g<b>, in \g<unit>"),
    (r"\bthe depth of (?:this|the) (?:contact|touch|press|imprint) differ\b", "the depth differ"),
    (r"^(?P<sign>counting (?:right|left|up|down)ward as positive), give (?:me )?the (?P<way>sideways|lengthwise) displacement of the (?:contact|touch)(?P<unit>,? in [µ\w]+)?", r"what is the \g<way> offset\g<unit>, \g<sign>"),
    (r" \((?:along |from )?palm to fingertip\)", ""),
    (r"\bfarther from the pad['’]s cent(?:re|er)", "farther from the centre"),
    (r"^choose one: the contact is in the (?P<a>top|upper|left) half ?(?:/|,|;|or) ?(?:or )?the contact is in the (?P<b>bottom|lower|right) half\b", r"is the contact in the \g<a> half or in the \g<b> half"),
    (rf"^is at least one of (?:these|the following|them|the two) true: (?P<a>[^?:]+?),? or (?P<b>[^?:]+?){_END}", r"does at least one hold: \g<a>, or \g<b>"),
    (r"^starting from the (?:pad['’]s )?(?:middle|cent(?:re|er)),? would i have to go (?P<side>right|left) to reach the (?:contact|touch)(?:['’]s (?:middle|cent(?:re|er)))?", r"is the contact \g<side> of the middle"),
)  # fmt: skip
_COMPILED = tuple((re.compile(pattern, re.I), plain) for pattern, plain in _MOVED)


def with_parts_in_place(text: str) -> str:
    """A question whose parts stand where others have them; the text itself where they do."""
    for pattern, plain in _COMPILED:
        text = pattern.sub(plain, text)
    return text
