"""Phrases inside a question for which others know a plainer one of the same meaning.

    less than a quarter of our allowance        less than a quarter of the limit
    a 1-cent coin, i.e. 207 mm²                 207 mm²
    the ratio limit : force                     the ratio of limit to force

Not here: constructions of whole questions
(``tacgrasp.lessons.dialogue.rewordings.reworded``).
"""

from __future__ import annotations

import re

_ALLOWED = re.compile(
    r"\b(?:(?:our|my|your|the|its) (?:whole |full |total |force )*(?:allowance|quota|force budget|"
    r"(?:permitted|allowed|allowable|permissible) (?:force|load|squeeze|grip))|"
    r"(?:the )?(?:most |maximum )?(?:what|that) (?:it|we|you|i|they|the (?:grip|gripper|robot))"
    r"(?:(?:['’](?:s|re|m))| is| are| am) (?:ever )?(?:allowed|permitted)"
    r"(?: to (?:use|apply|exert|press(?: with)?|squeeze(?: with)?|put on))?)(?! to\b)",
    re.I,
)
_MEANS_NUMBER = re.compile(
    r"\b(?P<sign>than|over|above|under|below|exceeds?|exceeding) (?:an?|the) [^,;?]*?,? ?\(?"
    r"(?:i\.? ?e\.?|that is|meaning|namely)[,:]? (?P<number>[\d.,]+ ?[^\s,?)]+)\)?",
    re.I,
)
_LIFTS = r"(?:lift|hoist|raise|pick|take)(?: (?:it|this|that|the \w+))?(?: up)?"


_GRIP = r"(?:the |this |our |my )?(?:grip(?:ping force)?|force|hold|grasp|squeeze|pressure)"
_CHANGE = r"correct(?:ion|ing)|adjust(?:ment|ing)|chang(?:e|ing)|tuning|alteration|fixing"


def _end_of_band(found: re.Match[str]) -> str:
    is_low = found["end"].lower() in ("lowest", "least", "smallest", "lightest", "minimum")
    return f"the {'lower' if is_low else 'upper'} end of the band"


_PLAIN = (
    (re.compile(r"\bratio (?:of )?(?P<a>[a-z]+) ?[:/] ?(?P<b>[a-z]+)\b", re.I),
     r"ratio of \g<a> to \g<b>"),
    (re.compile(r"\bits own weight (?P<verb>is|was) (?P<rest>(?:the|our|this) (?:[a-z]+ )?"
                r"(?:force|grip|squeeze))(?: on (?:this \w+|the \w+|it))?", re.I),
     r"the object's weight \g<verb> \g<rest>"),
    (re.compile(r"(?<=as much as )(?:this|the|our|my) (?:grip|gripper|hand|robot) "
                r"(?:presses|squeezes|pushes|clamps|grips)(?: with)?\b", re.I), "the force"),
    (re.compile(r"\ban? (?:[a-z]+ )?(?:thing|form|shape|something)(?: shaped)? like (?=an? )",
                re.I), ""),
    (re.compile(r"how many (?:%|per ?cent) (?P<side>above|below|over|under) (?P<b>[^?]+?) "
                r"(?:is|are|does) (?P<a>(?:the |our )?(?:[a-z]+ )?[a-z]+)(?: lie)?(?=[?.! ]*$)",
                re.I),
     r"by what percentage is \g<a> \g<side> \g<b>"),
    (re.compile(r"(?<=\w)\s*[,;:–—-]+ (?:all |just |only )?(?:two|three|four) (?:numbers|figures|"
                r"values|readings)(?: please)?(?=[?.! ]*$)", re.I), ""),
    (re.compile(r"(?<=\w), (?:or|no)(?=\s*\?+\s*$)", re.I), ", right"),
    (re.compile(r"\b(?P<name>depth|force|area|mass|x|y)_(?:mm|n|percent|g)\b", re.I),
     r"\g<name>"),
    (re.compile(r"^assert (?P<what>[^?]+?)[,;–—-]* *(?:[–—-] )?(?:would|will|does) (?:that|it) "
                r"(?:pass|hold|fail not)", re.I), r"is it true that \g<what>"),
    (re.compile(r"^(?:do|does|is|are) (?P<who>(?:the |our )?[a-z]+) (?:still )?need(?:s|ing)? "
                r"(?P<least>at least|more than|less than|over|under) (?:another |an? (?:extra|"
                r"further) )?(?P<number>[\d.,]+ ?[a-z]+)(?: more| extra)? to "
                r"(?:reach|get (?:in)?to|enter|be in|come into) (?:the )?(?:force )?"
                r"(?:band|range|window)", re.I),
     r"is the lower end of the band minus the force \g<least> \g<number>"),
    (re.compile(r"(?P<need>\b(?:how much|what) (?:grip|force|squeeze)\b[^?]*\b(?:needed|required|"
                r"necessary|needs?|requires?)\b[^?]*?)(?:,? and|\?) (?:do|have) (?:we|you|i) "
                r"(?:have |got |apply |press )?(?:it|that|enough|that much|so much)\b", re.I),
     r"\g<need>? Is the hold strong enough for what it weighs"),
    (re.compile(r"\b(?P<a>[a-z]+) or (?P<b>(?:an? )?[a-z]+),? or (?P<rest>(?:is it )?(?:neither|"
                r"none of (?:them|those|these)|something else))\b", re.I),
     r"\g<a>, \g<b> or \g<rest>"),
    (re.compile(r"\bhow far (?:off|away|apart) is (?=[^,;.?]+ from )", re.I), "how far is "),
    (re.compile(r"\b(?:squished|squashed|pressed|touched|flattened) (?:spot|bit|patch)\b", re.I),
     "contact area"),
    (re.compile(r"\b(?P<number>\d+(?:\.\d+)?|a) mills?\b", re.I), r"\g<number> millimetre"),
    (re.compile(r"\b(?:is|was)(?:n['’]t| not) (?:even |quite )?as (?:much|high|strong|large|big|"
                r"deep) as\b", re.I), "is less than"),
    (re.compile(r"^(?:relative|compared) to (?P<mark>[^:,;?]+)[:,] (?P<sides>over or under|"
                r"above or below|under or over|below or above)(?=[?.! ]*$)", re.I),
     r"is the force \g<sides> \g<mark>"),
    (re.compile(r"\b(?:unwise|foolish|reckless|a bad idea|a mistake) to (?=(?:lift|hoist|raise|"
                r"pick)\b)", re.I), "unsafe to "),
    (re.compile(r"(?<= of )(?:your|my|our) (?=pad\b)", re.I), "the "),
    (re.compile(r"\bthe wh?ether\b", re.I), "the weather"),
    (re.compile(r"^(?:and |so |but )*(?:what|which) (?:force )?(?:band|range|window) (?:are|do|is|"
                r"did|must|should) (?:you|we|the (?:robot|gripper)|i) (?:aim|go|try|want|work|"
                r"target|mean|plan|hope)\w*(?: (?:for|at|after|to (?:reach|hit|get|be in)|in|"
                r"now))*(?=[?.! ]*$)", re.I), "what is the force band"),
    (re.compile(r"^(?:and |so |but )*(?:what|which) force (?:are|do|is) (?:you|we|the (?:robot|"
                r"gripper)) (?:aiming|going|trying|working|heading)(?: (?:for|at|after|towards?|"
                r"to (?:reach|hit|get(?: to)?)))*(?=[?.! ]*$)", re.I), "what is the force band"),
    (re.compile(r"^((?:in )?(?:just |only )?(?:one|a single) word[:,;–—-]+ *)?(?:what (?:do|can) "
                r"you (?:feel|sense|touch)|what (?:is it|have you got|are you (?:feeling|holding|"
                r"touching))|describe (?:it|the (?:contact|touch|object)|what you feel))"
                r"(?(1)|[,:]? (?:in|using|with) (?:just |only )?(?:one|a single) word)"
                r"(?=[?.! ]*$)", re.I), "shape in one word"),
    (re.compile(r"[,;:–—-]+ *(?:a )?(?:yes ?/ ?no|y ?/ ?n)(?=[?.! ]*$)", re.I), ", yes or no"),
    (re.compile(r",? or (?:(?:are (?:we|you)|is it|am i) )?(?:just |only )*(?:grab|gripp?|hold|"
                r"poke?|paw|snatch|"
                r"clos|clutch|squeez|touch|feel|press)\w* (?:on )?(?:at )?(?:just |only )*(?:thin "
                r"air|empty air|empty space|air|nothing)(?: at all)?(?=[?.! ]*$)", re.I), ""),
    (re.compile(rf"^(?P<ask>[^?]*{_LIFTS}[^?]*?),? or (?:should|shall|must|do|had) (?:i|we|you)"
                r" (?:rather |better |still )*(?:wait|hold (?:off|on|back)|stop|leave it|not)"
                r"(?: (?:a bit|a little|first|longer|still))*(?=[?.! ]*$)", re.I), r"\g<ask>"),
    (re.compile(rf"^(?P<ask>(?:can|may|could|shall|should) (?:i|we|you) [^?]*{_LIFTS}[^?]*?),? "
                r"without (?:(?:crush|squash|bruis|damag|break)\w+(?: it)? (?:or|and|nor) (?:dropp|"
                r"los|slipp)\w+|(?:dropp|los|slipp)\w+(?: it)? (?:or|and|nor) (?:crush|squash|"
                r"bruis|damag|break)\w+)(?: (?:it|the \w+|anything))?(?=[?.! ]*$)", re.I),
     r"\g<ask>"),
    (re.compile(rf"(?P<to>\bto {_LIFTS}) (?:it |this |that |the \w+ )?(?:off|from|up from|clear of)"
                r" (?:the|its|our|this) \w+(?=[?.! ]*$)", re.I), r"\g<to> it"),
    (re.compile(r"\b(?:firm|tight|strong|hard)(?:ly)? enough,? (?:and|but|yet|while|without being)"
                r" (?:not )?too (?:firm|tight|strong|hard)(?:ly)?,?(?= (?:for|to)\b|[?.! ]*$)",
                re.I), "right"),
    (re.compile(r"\b(?P<verb>covers?|fills?|touch(?:es)?|tak(?:es?|ing) up|occup(?:y|ies)|"
                r"covering|filling|is|are) (?=half (?:of )?(?:the|our|your|this) (?:pad|gel|"
                r"sensor|fingertip)\b)", re.I), r"\g<verb> at least "),
    (re.compile(r"\b(?:(?:the|what) )?(?P<end>lowest|least|smallest|lightest|minimum|"
                r"highest|most|largest|greatest|maximum|hardest) (?:grip|force|squeeze) (?:that |"
                r"which )?(?:the |my |our |your |this )?(?:(?:current|present|given|actual) )?"
                r"(?:instruction|order|job|brief|wording)s? (?:will |would |can |does )?"
                r"(?:puts? up with|allows?|"
                r"accepts?|tolerates?|permits?|asks? for|wants?|needs?|stands?|calls? for)"
                r"(?=[?.! ]*$)", re.I), _end_of_band),
    (re.compile(r"\b(?:which|what) (?:square|cell|box|field|ninth|sector|zone|tile)(?:['’]s| is|"
                r" does| did| has)(?: of (?:it|the \w+|those|these))? (?P<what>it|the \w+|this|"
                r"that|my \w+) (?:in|at|on|lie(?: in)?|sit(?: in)?|touch|fall(?: in)?|be(?: in)?|"
                r"land (?:in|on))(?=[?.! ]*$)", re.I), r"where is \g<what>"),
    (re.compile(r"\b(?P<more>(?:plus|more|extra|another|added)\b[^?.]*?) (?:still )?(?:be|stay|"
                r"remain|lie|keep) (?:still )?(?:with)?in(?:side)? (?:the|our|your|my) (?:force )?"
                r"(?:limit|cap|maximum|max)\b", re.I), r"\g<more> be at most the limit"),
    (re.compile(r"^(?:suppose|supposing|imagine|say|assume)(?: that)? (?:i|we|you) (?:asked? for|"
                r"add(?:ed)?|used?|put on|gave|give|appl(?:y|ied)|wanted?) (?P<n>one|a|\d[\d.]*) "
                r"(?P<x>extra |more |additional |further )?(?P<unit>newtons?|n|m?n|millinewtons?)"
                r"(?(x)| more)(?: on top(?: of [^?.;,]+)?| than [^?.;,]+)?[.;,–—-]+ *(?:would|will|"
                r"does) (?:that|it|this) (?:still )?(?:be|stay|remain|keep) (?:with)?in(?:side)? "
                r"(?:the|our|your|my) (?:force )?(?:limit|cap|maximum|max)(?=[?.! ]*$)", re.I),
     r"would \g<n> \g<unit> more be at most the limit"),
    (re.compile(r"(?:(?<=, )|(?<=and ))where(?: exactly)? (?:it|the (?:thing|object|"
                r"contact)|that)(?:['’]s| is) (?:pressing|sitting|touching|resting|"
                r"lying|pushing|making contact)\b", re.I), "the position"),
    (re.compile(r"\bnot yet (?:at|up to) (?=[\d.]|half|one|two|three|four|five|an? )", re.I),
     "below "),
    (re.compile(r"\b(?P<off>off[- ]?cent(?:re|er)(?:ed|d)?), not (?:quite )?(?:in|on|at) [^,?]+",
                re.I), r"\g<off>"),
    (re.compile(r",? (?:for|into|in) (?:my|the|our|your) (?:(?:log|lab|test|work|inspection|data|"
                r"shift)[ -]?)?(?:sheet|book|report|notes?|file|records?|protocol|notebook)\b"
                r"(?=[,.?! ])", re.I), ""),
    (re.compile(r",? (?:bitte|por favor|s['’]il vous pla[iî]t|per favore)(?=[,.?! ]*$)", re.I),
     " please"),
    (re.compile(r"^(?P<is>is|are) (?:the |this |our |my )?(?:grip|grasp|hold|force) (?:good|"
                r"fine|ok|okay|right) enough,? (?:so |that |so that |for (?:me|us) )"
                rf"(?:we |i |you |one )?(?:can |could |may |to )?{_LIFTS}"
                r"(?: the \w+)?(?=[?.! ]*$)", re.I),
     "is it safe to lift it"),
    (re.compile(r"^(?:so |and )?what (?:must|should|do|can|shall) (?:we|i|you) (?:have to |"
                r"need to )?do,? (?:so|to (?:get|bring|have)|until) (?:that )?(?:the )?"
                r"(?:grip )?force (?:to )?(?:comes?|gets?|is|goes|be)? ?(?:with|back |into |in)*"
                r"(?:in|into|inside) (?:the |its )?(?:force )?(?:band|range|window)"
                r"(?=[?.! ]*$)", re.I),
     "To get into the band, tighten or loosen"),
    (re.compile(r"^(?:(?:do|would) you (?:object to|oppose|veto|forbid|rule out)|(?:does|would|do) "
                r"(?:the |this |our |my )?(?:force|grip|band|contract|limit) (?:forbid|prohibit|"
                r"prevent|rule out|block|veto|speak against)) (?:a |the |my |our )?(?:lift|hoist|"
                r"rais|pick)\w*(?: (?:it|the \w+|this|that))?(?: up)?(?: now)?(?=[?.! ]*$)", re.I),
     "is it unsafe to lift it"),
    (re.compile(r"\bis (?:the|our|your|my) (?:force )?(?:limit|cap|ceiling|"
                r"maximum) (?:still )?(?:intact|"
                r"unbroken|observed|holding|kept|honou?red)(?=[?.! ]*$)", re.I),
     "is the limit respected"),
    (re.compile(r"\bis (?:the|our|your|my) (?:force )?(?:band|range|window) (?:still )?(?:kept|"
                r"observed|respected|held|met|"
                r"honou?red)(?=[?.! ]*$)", re.I), "is the force within the band"),
    (re.compile(rf"^does {_GRIP} (?:still |now )?need no (?:{_CHANGE})(?=[?.! ]*$)|"
                rf"^(?:should|can|may|must) {_GRIP} (?:stay|remain|be left|be kept) (?:as it is|"
                rf"unchanged|"
                r"the same|like this|like that|alone)(?=[?.! ]*$)|"
                rf"^can (?:i|we|you) leave {_GRIP} (?:alone|as it is|unchanged|"
                rf"like this)(?=[?.! ]*$)",
                re.I), "is the force within the band"),
    (re.compile(rf"^does {_GRIP} (?:still |now )?need (?:any |an? |"
                rf"some )?(?:{_CHANGE})(?=[?.! ]*$)|"
                rf"^(?:should|must) {_GRIP} (?:be )?(?:chang|adjust|correct|alter|fix)(?:e|"
                rf"ed)?(?=[?.! ]*$)|"
                rf"^(?:is|are) (?:an? |any |some )?(?:{_CHANGE})s? (?:of|to|in) {_GRIP} (?:needed|"
                r"necessary|required|called for|due)(?=[?.! ]*$)", re.I),
     "is the force outside the band"),
    (re.compile(r"^would (?:another|one more|one further|a further) newton (?:still )?be (?:ok|"
                r"okay|fine|all "
                r"right|allowed|possible|within) (?:with|by|under|for) the (?:limit|cap|maximum)"
                r"(?=[?.! ]*$)", re.I), "would 1 N more be at most the limit"),
    (re.compile(r"\bneither too (?:weak|soft|loose|light)(?:ly)? nor too (?:strong|hard|firm|tight)"
                r"(?:ly)?\b|\bneither too (?:strong|hard|firm|tight)(?:ly)? nor too (?:weak|soft|"
                r"loose|light)(?:ly)?\b", re.I), "right"),
    (re.compile(rf"^(?:is|are) there (?:any|a|some) (?:good )?reasons?\b[^?]*\bnot to {_LIFTS}\b"
                r"[^?]*(?=[?.! ]*$)", re.I), "is it unsafe to lift it"),
    (re.compile(r"^(?:would|am|is|are) (?:someone|somebody|anyone|one|i|we|you)(?: be)? (?:wrong|"
                r"mistaken) to (?:deny|dispute|doubt|reject) (?:that )?", re.I),
     "is it true that "),
    (re.compile(r"^is it impossible to (?:truthfully |honestly |correctly )?(?:say|claim|state) "
                r"(?:that )?", re.I), "is it false that "),
    (re.compile(r"^(?P<a>(?!y\b|yes\b|left\b)[a-z]{4,}) ?(?:vs\.?|versus|"
                r"/) ?(?P<b>[a-z]{4,})(?=[?.! ]*$)",
                re.I), r"\g<a> or \g<b>"),
    (re.compile(r"^(?P<a>[a-z]+ or [a-z]+)[,;:–—-]+ *(?:what|which) (?:do|d['’]) ?(?:you|"
                r"ya) (?:think|reckon|say|guess)(?=[?.! ]*$)", re.I), r"\g<a>"),
    (re.compile(r"^(?:.*[.!] )?(?:do|did|have) (?:you|we|i) (?:have|hold|got|feel|get|pick up) the (?P<a>[a-z]+) one or the (?P<b>[a-z]+) one(?=[?.! ]*$)", re.I),
     r"\g<a> or \g<b>"),
    (re.compile(r"^(?:please )?(?:help me |i must |i have to |i need to )(?:decide|choose) between "
                r"(?P<a>[a-z]+) and (?P<b>[a-z]+)(?: for this(?: one)?| here)?(?=[?.! ]*$)", re.I),
     r"\g<a> or \g<b>"),
    (re.compile(r"^[^?]+\bor\b[^?]+\? (?:just )?say (?P<a>[a-z]+) or (?P<b>[a-z]+)(?=[?.! ]*$)",
                re.I), r"\g<a> or \g<b>"),
    (re.compile(r"(?P<a>feels?|seems?|looks?) (?P<b>[a-z]+) to (?:you|your finger),? or ", re.I),
     r"\g<a> \g<b> or "),
    (re.compile(r"^(?:the |what(?:['’]s| is) the )?next grip (?:action|move|step)(?=[?.! ]*$)|"
                r"^what (?:do|should|must|will) (?:you|we|i) do with (?:the|your|"
                r"our) grip(?: now| next)?"
                r"(?=[?.! ]*$)", re.I), "To get into the band, tighten or loosen"),
    (re.compile(r"^(?:the )?(?:margin|headroom|distance|gap|reserve|room)(?: left)? (?:to|below|"
                r"under|until) (?:the )?(?:hard |force )?limit,? (?:in )?(?P<unit>m?N|newtons?|"
                r"millinewtons?)(?=[?.! ]*$)", re.I), r"how many \g<unit> are left to the limit"),
    (re.compile(r"^does (?P<what>the (?:difference|gap|margin|distance)\b[^?]*?) (?:come|amount|"
                r"add up) to ", re.I), r"is \g<what> "),
    (re.compile(r"\bout of (?:a |one )hundred,? how much\b", re.I), "what percentage"),
    (re.compile(r"\bwhich size (?:class|category|bin) (?:does |is )?(?:the|this|"
                r"our) (?:footprint|patch|"
                r"contact|imprint|spot) (?:belongs? (?:to|in)|falls? in(?:to)?|in)\b", re.I),
     "what is the area class"),
    (re.compile(r"^(?:i (?:suspect|think|believe|guess|reckon|assume|bet|suppose)|my guess is|"
                r"they say|somebody (?:says|claims|"
                r"thinks))(?: that)? (?P<stated>[^.?!;]*[^.?!;\d])[.;!,]+ (?:is (?:that|"
                r"this|it) (?:so|right|true|correct|the case)|am i right|"
                r"do you agree)(?=[?.! ]*$)", re.I),
     r"is it true that \g<stated>"),
    (re.compile(r"\bthe (?:force )?(?:interval|range|band|window) (?:which |that )?(?:the |my |"
                r"our |your )?(?:(?:present|current|given) )?(?:command|instruction|order|"
                r"contract)s? (?:prescribes?|"
                r"asks? for|demands?|requires?|wants?|sets?|calls? for)\b", re.I), "the band"),
    (re.compile(r"\bthe (?:force|value|line|mark) (?:that|which)(?:,[^,]*,)? (?:must|may|can|"
                r"should) (?:never|"
                r"not|at no time|under no circumstances) be (?:passed|surpassed|exceeded|"
                r"crossed)\b", re.I),
     "the limit"),
    (re.compile(r"\bup to (?:what|which) force does (?:the|our|my) (?:target |force |"
                r"wanted )?(?:range|band|"
                r"window) (?:go|reach|extend)\b", re.I), "what is the upper end of the band"),
    (re.compile(r"\bfails? to (?:occupy|cover|fill|touch) (?:as much as |so much as |"
                r"even )?", re.I),
     "covers less than "),
    (re.compile(r"^would (?:one|i|we) be (?:right|correct|justified) (?:in|to) (?:assert|claim|"
                r"say|stat)(?:ing|e)? that ", re.I), "is it true that "),
    (re.compile(r"\bwhat(?:['’]s| is) the name of the person\b[^?]*", re.I), "who owns it"),
    (re.compile(r"\bgive me the lot[:,;–—-]+ *", re.I), "tell me "),
)  # fmt: skip


def with_plain_phrases(text: str) -> str:
    """A question with plainer phrases; the text itself where it has no others."""
    text = _ALLOWED.sub("the limit", text)
    text = _MEANS_NUMBER.sub(r"\g<sign> \g<number>", text)
    for pattern, plain in _PLAIN:
        text = pattern.sub(plain, text)
    return text
