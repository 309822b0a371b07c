"""Whether the words beside a force make it a value, a most or a least."""

from __future__ import annotations

import re

from policies.instructions.quantities.force import NO_OTHER_FORCE, Kind

_FIRMER = r"(?:harder|firmer|tighter|stronger|heavier|larger|bigger|greater|higher)"
_SOFTER = r"(?:softer|gentler|lighter|weaker|looser|lower|lesser|smaller|small|low|fewer)"
_ABOUT = r"(?: ?(?:about|around|roughly|approximately|approx\.?|circa|ca\.?|some|something like|nearly|almost))"
"""What may stand between a bound and its force; it changes no bound."""
_TOPS = r"(?:(?<=force )|(?<=pressure )|(?<=grip )|(?<=reading )|(?<=value )|(?<=load )|(?<=gauge )|(?<=sensor )|(?<=never )|(?<=not )|(?<=ever )|(?<=when it )|(?<=once it )|(?<=if it )|(?<=until it )|(?<=before it ))tops?"
"""'When it tops 1 N'; 'hold it, tops 1 N' names a most."""
_ABOVE = re.compile(
    rf"\b(?:over|above|beyond|past|exceed(?:s|ed|ing)?|surpass\w*|in excess of|north of|upwards? of|"
    rf"pass(?:es|ing)?|topping|{_TOPS}|cross(?:es|ing)?|overshoot\w*|overstep\w*|(?:any |a \w+ |\w+ )?more(?: \w+)? than(?: (?:you|i|we) (?:would|do|did)(?: (?:hold|press|squeeze|use|with|at|for|on))*)?|{_FIRMER}(?: \w+)? than(?: you would)?(?: with| at)?)"
    rf"(?: the| a| of)?{_ABOUT}?\s*$|>{_ABOUT}?\s*$"
)
_BELOW = re.compile(
    rf"\b(?:under(?:neath)?|below|beneath|less(?: \w+)? than|{_SOFTER}(?: \w+)? than|south of|short of|"
    rf"shy of|sub)(?: the| a)?{_ABOUT}?\s*-?$|<{_ABOUT}?\s*$"
)
_MOST = re.compile(
    r"(?:\b(?:less|lower|smaller) than or equal to|\b(?:at|under|below) or (?:under|below|at)|\b(?:ends|tops out|finish\w*|finishes)(?: \w+){0,3} (?:at|before)|\b(?:stop\w*|halt\w*|quit\w*|ceas\w*|abort\w*|relent\w*|releas\w*|loosen\w*|(?:back\w*|eas\w+|lay\w*|leav\w+|cut\w*) off|let\w* (?:go|up)|giv\w+ (?:up|way)|pull\w* (?:up|back|out))(?: \w+){0,3} before|(?<!not )(?<!never )\b(?:stop|quit|halt|cease|leave off|cut (?:out|off)|finish|pull up|abort|bail(?: out)?|trip|fault|e-?stop|shut (?:down|off)|give up|let go|back off|alarm)(?:s|p?p?ing|ed)?(?: \w+ing)?(?: (?:it|in|down|up|on it|on this|dead|short|the (?:berry|strawberry|fruit|fingers|jaws|gripper)))? at|"
    r"\bat (?:the )?(?:very |absolute )?most|\batmost|\b(?:allowed|allowable|permitted|permissible|admissible|tolerable|tolerated)(?: (?:only|just|force|forces|grip|load|value|level|is|are|of))*:?|\b(?:allows?|permits?|tolerates?)(?: us| me| you| only| just)*|\bthe (?:safe|right|low|lower|soft|gentle|near) side of|\btops:?|\b(?:alarm|warning|buzzer|siren)s?(?: \w+)? (?:goes|go|comes?|is set|sounds?|rings?|beeps?)(?: off| on)? (?:at|from)|\b(?:overload|pressure|force) warning at|\b(?:highest|largest|strongest|biggest|hardest) (?:force|grip|squeeze|pressure)(?: (?:i|we|you|it|that|the \w+)\b[^.;#\d]*?)? (?:is|=|:)|\bbudget for (?:the )?(?:squeez\w*|grip\w*|force|press\w*)(?: is|:| =)|\b(?:keep|put) (?:a|the) lid on (?:it|that|this|the \w+)(?:,? at| of|:)?|\b(?:limiter|guard|protection|cut-?off|breaker|interlock|safety)(?: \w+){0,3}? (?:kicks?|cuts?|steps?|trips?|comes?) in at|\b(?:roof|lid) (?:for|on|of)(?: the| my| our)?(?: grip(?:ping)?)?(?: force| squeeze)?(?: is|:| =)|\bsaturat\w*(?: \w+){0,3}? at|\bclip(?:s|ped|ping)?(?: \w+){0,3}? (?:at|to)|\bthe (?:absolute |very |outright |extreme )?most(?: \w+)? ?(?:is|=|:)|\b(?:threshold|level|mark) for (?:the |an? )?(?:emergency )?(?:stop|abort|alarm|trip|fault|shut-?down)\w*(?: is|:| =|=)?|\bhard stop(?: at| of| is)?|\bup to|\b(?:as (?:hard|much|high|firm|far) as|no further than)|"
    r"\bmax(?:\.|imum|imal(?:ly)?|ed)?(?: \w+){0,3}?(?: of| is| at| to|:| =|=)?|"
    r"\blimit(?:s|ed|ing)?(?: (?!not\b|never\b)\w+){0,3}?(?: to| of| at| is|:| =|=)?|"
    r"(?<!bottle )(?<!screw )(?<!jar )(?<!pen )(?<!tube )(?<!vial )\bcap(?:s|ped|ping)?(?: \w+){0,3}?(?: at| to| of| is|:| =|=)?|\bceiling(?: of| is| at|:| =|=)?|"
    r"\bcritical (?:force|load|value|level|point)(?: of| is| at| to|:| =|=)?|"
    r"\b(?:alarm|trip|overload|risk|fault|critical)(?: (?:is|at))*\s*[:=]|\b(?:alarm|trip|overload|fault)s?(?: is)? (?:set )?at|"
    r"\b(?:alarm|trip(?:ping)?|fault|safety|abort|stop|shut-?down|e-?stop|emergency|overload|warning)s?[ -](?:threshold|level|point|limit|value|mark|line)(?: of| is| at| to|:| =|=)?|\b(?:red|danger) ?line(?: of| is| at|:| =|=)?|"
    r"\b(?:upper|top) (?:\w+ )?(?:limit|bound|end|threshold|cut-?off)(?: (?!not\b|never\b)\w+){0,3}?(?: of| is| at|:| =|=)?|\bpeaks?(?: \w+){0,2}?(?: of| is| at|:| =|=)?|"
    r"\b(?:bruis\w*|ruptur\w*|fractur\w*|fail\w*|break\w*|burst\w*|crush\w*|damag\w*|yield\w*|crack\w*|tear\w*|squash\w*|collaps\w*) (?:threshold|onset|force|load|limit|point|level|pressure|strength|mark)s?(?: (?:is|of|at|about))*\s*[:=]?|\b(?:warning|danger|caution)\s*[:=]|"
    r"\bkeep(?:s|ing)?(?: \w+){0,3} from (?:reach|hitt|gett|ris|go|climb)ing(?: (?:up |all the way )?to)?|\b(?:can not|could not|will not|never) (?:handle|take|stand|bear|withstand|tolerate|survive|endure)|"
    r"<=|≤|=<|\bnot to exceed|\bat (?:the )?worst|\bworst case|\bwithin|\bbounded (?:above )?(?:by|at)|\b(?:not|never)(?: let it)? (?:go|push|squeeze|press)(?: \w{1,4})?|\b(?:top|max|peak|level)(?:p?ing|s|p?ed)?(?: \w+)?(?: out)? at|\b(?:restrict|confin|constrain|throttl)\w*(?: \w+){0,3}? (?:to|at|by)|\b(?:may|can|could|might)(?: only| just| at most)? (?:be (?:raised|increased)|rise|go|climb|increase|grow|build|reach|extend)(?: up)?(?: to)?|\b(?:not|never|without|avoid\w*)(?: (?:ever|let|the|force|it|grip|even|quite|to|be|going|you|allow\w*|pressure|have|want|go|come|rise)){0,5} (?:reach(?:es|ing)?|hit(?:s|ting)?|get(?:s|ting)? (?:up )?to|attain\w*|ris(?:e|es|ing) to|climb\w* to|go(?:ing|es)? (?:up |all the way )?to)|\b(?:budget|allowance)(?: of| is|:)?|\bno more than|\bnowhere near|\b(?:allow(?:ed)?|permit(?:ted)?)(?: is (?:until|till|up to))?(?: (?:up )?to(?: (?:use|reach|rise to|climb to|go(?: up)? to))?)?|"
    r"\b(?:ease|eases|back|let)(?: \w+){0,2} (?:once|when|as soon as|at)(?: (?:you|it|we))?(?: (?:feel|reach|hit|see|measure|get to|read)\w*)?|\bfar (?:away )?from|\b(?:not|never)(?: (?:even|anywhere|get|go|come|be))* (?:close|near)(?: to)?|\bf[_ ]?max\s*[:=]?(?: is| of)?)"
    rf"{_ABOUT}?\s*$"
)
_LEAST = re.compile(
    r"(?:\b(?:more|greater|higher|larger) than or equal to|\b(?:at|over|above) or (?:over|above|at)|"
    r"\bat (?:the )?(?:very |absolute )?least|\batleast|\bmin(?:\.|imum|imal(?:ly)?)?(?: (?!not\b|never\b)\w+){0,3}?(?: of| is| at|:| =|=)?|"
    r"\b(?:lower|bottom) (?:\w+ )?(?:limit|bound|end)(?: \w+){0,4}?(?: of| is| at|:| =|=)?|\bfloor(?: \w+){0,3}?(?: of| is| at|:| =|=)?|"
    r"\b(?:lowest|smallest|least|weakest|softest|minimum) (?:force|grip|squeeze|hold)(?: (?:(?:that )?(?:i|we|you|it)|that|the \w+)\b[^.;#\d]*?)? (?:is|=|:)|"
    r">=|≥|=>|\bno less than|\bno (?:weaker|less|softer|lower|gentler|looser|smaller)(?: an?)? (?:grip|squeeze|hold|force|clamp|pressure|grasp)(?: strength)? than|\bat (?:the )?(?:very )?least (?:with|at|use|apply)|\b(?:it|berry|fruit|this|that|one|strawberry|thing) (?:really |always )?(?:needs|requires|takes)|\bf[_ ]?min\s*[:=]?(?: is| of)?|\bstarting (?:at|from)|\bbottom out at|"
    r"\b(?:lower|low|bottom)[ -](?:alarm|trip|warning|threshold|cut-?off|guard)s?(?: (?:threshold|level|limit|point|value))?(?: of| is| at|:| =|=)?)"
    rf"{_ABOUT}?\s*$"
)
_TAKES = re.compile(r"\b(?:needs|requires|takes)\b")
"""'It takes 0.8 N, no more'."""
_OTHERS = r"(?!(?: it| them)?(?: than| of| is| to|:| =| at| with| from| above| over| beyond| by| under| below)?(?: (?:about|around|roughly))?(?: an?)? ?(?:\d|\.\d))"
"""Ends a bound after a number: '2 N, at most 2.2 N' bounds the second number, not the first."""

_HARMS = r"(?:g[ia]ves? (?:way|in)|broke|tore|left (?:a |its )?(?:mark|dent|bruise)|fail|yield|suffer|complain|leak|collapse|spoil|bruis|crush|squash|burst|break|split|crack|damag|mark|dent|pop|hurt|mush|ruin|spoil|tear|pulp)\w*\b"
_SLIPS = r"(?:slips?|falls?|(?:drop|slide)(?:s|(?! (?:it|this|that|them|the|my|our)\b))|turn(?:s(?! (?:mush\w*|soft|brown|black|red|dark|bad|sour|watery|pulpy|squashy|slimy|wet|blue|purple)\b)|(?! (?:it|this|that|them|the|my|our|mush\w*|soft|brown|black|red|dark|bad|sour|watery|pulpy|squashy|slimy|wet|blue|purple)\b))|gets? away|wobbles?)"
_BEEN = r"(?:is|was|are|were|(?:would|will|should)(?: already| surely| certainly| probably| simply| just)? be|would have been|has been|had been|seems?|seemed|felt|proved|turned out)(?: to be)?"
_UNWANTED = (
    r"(?:forbidden|prohibited|banned|disallowed|unacceptable|excessive|overkill|unnecessary|needless|dangerous|harmful|risky|taboo|ruled out|out of (?:the question|bounds)|"
    r"off[ -]limits|an? no[ -]?(?:no|go)|not (?:allowed|permitted|acceptable|tolerated|tolerable|necessary|needed|required|wanted|safe|ok(?:ay)?|an option|advisable|recommended))"
)
"""What is said of a force that is too large."""
_STRICT = r"(?:(?:absolute|hard|strict|firm|safety|upper|very|fixed|final|outer|allowed|permitted|allowable) )*"
_MOST_AFTER = re.compile(
    rf"\s*(?:-|–|,|:)?\s*(?:(?:(?:at|as|is|being) )?(?:an? |the |my |our |its )?{_STRICT}(?:max(?:imum|imal)?|peaks?|(?:upper )?(?:limit|ceiling|cap)(?! is\b))\b(?!\.?(?: (?:grip |clamp\w* |holding )?force)?(?: of| is|:| ?=)? ?\d)|tops\b|at (?:the )?(?:very |absolute )?most\b|"
    r"(?:or|and) (?:a (?:little|bit|touch) |slightly |even )?(?:less|below|under|lower|lighter|softer|gentler|smaller)\b(?! (?:no|any|all)\b)|(?: [a-z]+){1,3} at (?:the )?(?:very |absolute )?most\b|"
    r"[;,.]? ?(?:and )?(?:do not|never|not|but not) (?:\w+ ){0,2}(?:past|over|above|beyond|exceed|higher than) (?:it|that|this)\b|"
    r"(?:(?:is|are|will be|should be) (?:plenty|enough|sufficient|fine|all right|ok(?:ay)?|good|right|perfect|ideal|adequate)\b)?(?:,? ?(?:and|but|yet|though) )?(?:,? )?(?:absolutely |(?:under|in|on|by|at) )?(?:no|not|never|without)(?! need)(?: \w+){0,2} (?:more|higher|harder|above|over|further|beyond|past)\b"
    r"(?!,? (?:and |or )?(?:no|not|nor|never)(?: \w+)? less)(?! (?:no|not) less)|"
    r"(?:is|as|being|=)(?: (?!lower)\w+){0,3} (?:limit|max(?:imum)?|ceiling|cap|most|(?:highest|strongest|largest|hardest|firmest) (?:grip|force|squeeze)|end of the line|last word|where (?:it|we|you|i|that|the \w+) (?:stops?|ends?|draws?)|top(?! (?:shelf|tray|drawer|layer|row|end|of)\b))\b|(?:limit|ceiling|cap)\b(?!(?: force)?(?: of| is|:| ?=)? ?\d)|"
    r"(?:(?:an?|the|my|your|as|is|as an?|as the) )*upper (?:\w+ )?(?:bound|limit|end)\b|"
    rf"(?:,? ?(?:and|but) (?:it|that|this) )?(?:{_BEEN} )?(?:already |way |far |just |clearly |evidently )*(?:(?:you (?:are|have|would be|were) )?(?:going|gone|squeezing|pressing|gripping) (?:way |much |far )?)?too (?:much|far|hard|firm|high|strong|tight|rough|heavy|great)|and under\b(?! (?:no|any|all)\b)|"
    rf"at (?:the )?(?:outside|utmost|very top|worst|extreme)\b|in the (?:very )?(?:worst|extreme) case\b|(?:for|as) (?:the|a|my|our) (?:hard |final |upper )*(?:stop|limit|cap|ceiling|max(?:imum)?)\b|(?:is )?(?:the )?(?:(?:most|maximum) )?(?<!is )(?:allowed|allowable|permitted|permissible|admissible|tolerated)\b|is (?:about |just |only )?as (?:high|far|hard|much|firm|tight|strong) as (?:i|you|we|it|they|the \w+|this)\b|to (?:play|work) with\b|(?:is|as) (?:the|my|our|a) (?:\w+ )?(?:roof|lid|wall|red line|end of it)\b|{_BEEN} (?:already |strictly |absolutely |still |simply )*{_UNWANTED}|"
    rf"(?<!, )(?:already |surely |will |would |can |could |may |might |has |had |have )*{_HARMS}(?= (?:it|the|this|that|my|our|one|some|berr\w+|strawberr\w+|fruits?|a|easily|already|them)\b|\s*(?:$|[.;!,]))|"
    rf"(?:will|would|is where \w+|is when \w+) (?:already |surely )?{_HARMS}|(?:it|they|the (?:(?:last|previous|first|other) )?\w+) (?:already |surely )?{_HARMS})"
    + _OTHERS
)
_LEAST_AFTER = re.compile(
    r"\s*(?:-|–|,|:|\+)?\s*(?:(?:at |as )?(?:a |the )?min(?:imum)?\b(?!\.?(?: of| is|:| =)? ?\d)|(?:(?:or|and) )?upwards?\b|(?:or|and) (?:a (?:little|bit|touch) |slightly |even )?(?:more|above|higher|over|harder|firmer|better|greater|larger|up|upwards?)\b|(?: [a-z]+){1,3} at (?:the )?(?:very |absolute )?least\b|[;,.]? ?(?:and )?(?:do not|never|not|but not) (?:\w+ ){0,2}(?:under|below|beneath|lower than) (?:it|that|this)\b|"
    r"at (?:the )?(?:very |absolute )?least\b|plus\b(?! (?:or )?minus\b)|"
    r"(?:,? ?and )?(?:absolutely |(?:under|in|on|by|at) )?(?:no|not|never)(?: \w+){0,2} (?:less|lower|softer|under|below)\b|"
    r"(?:is|as|being)(?: \w+){0,3} (?:minimum|min|floor|least|(?:lowest|weakest|smallest|lightest|softest) (?:grip|force|squeeze))\b|(?:floor)\b|"
    r"(?:(?:an?|the|my|your|as|is|as an?|as the) )*lower (?:\w+ )?(?:bound|limit|end)\b|"
    r"(?:(?:is|was|were|would be|are|will be|will|proved|turned out) )?(?:(?:to be )?not (?:do|enough)|(?:just |way |far )?too (?:little|light|soft|low|weak))|"
    rf"(?:it|they|the \w+) (?:still |just |already )?{_SLIPS}\b)" + _OTHERS
)
_NO_VERB = r"\b(?:not|never)(?: (?:ever|please|just|even|to|go|get|be|rise|climb|push|press|squeeze|let|take|force|it|any))*"
_END = (
    r"(?=\s*(?:$|[.;,!)])"
    r"| (?:and(?! (?:above|below|beyond|over|under)\b)|but|because|since|so|please|when|while|as long as|until|today|whatever|at any|at all|ever)\b)"
)
_NO_FURTHER = rf"{_NO_VERB} (?:exceed|over|above|beyond|past|further|higher|harder){_END}"
"""'1 N is plenty, do not go beyond'."""
_NO_LESS = rf"{_NO_VERB} (?:below|under|beneath|lower){_END}"
_MOST_SOMEWHERE = re.compile(
    rf"{_NO_FURTHER}|"
    r"\b(?:cut ?-?offs?|saturate at|clip(?:ped)? at|(?:not|never)(?: \w+){0,4} reach(?:es)?|before it reaches|back off at|the most (?:i|you|we|it|that)|upper (?:\w+ )?(?:bound|limit|end)|ceiling|red line|draw the line|top of (?:what|the|its)|bounded above|"
    r"maximum|(?:not|without|never|avoid)(?: to)?(?: be(?:ing)?)? (?:exceed|surpass)\w*|(?:not|never|nor)\b.{0,30}\b(?:pass|past|exceed|over|above|beyond|surpass|cross) (?:it|that|this)\b|"
    r"(?:remain|stay|keep|stop|be)\w* (?:it )?(?:just |well |safely )?(?:below|under|short of|beneath) (?:it|that|this)\b|as (?:a|the|an) (?:ceiling|cap|maximum|upper))"
)
_LEAST_SOMEWHERE = re.compile(
    rf"{_NO_LESS}|"
    r"\b(?:the least (?:i|you|we|it|that)|lower (?:\w+ )?(?:bound|limit|end)|minimum|"
    r"(?:not|never|nor)\b.{0,30}\b(?:below|under|beneath|short of|less than|lower than) (?:it|that|this)\b|"
    r"(?:remain|stay|keep|be)\w* (?:it )?(?:just |well |safely )?(?:above|over) (?:it|that|this)\b|as (?:a|the) (?:floor|minimum|lower))"
)
_LOWERED = re.compile(
    r"(?:\b(?:lower|reduce|decrease|cut|drop|bring down) (?:the|my|your|our|that|this|its) (?:\w+ )?|(?:^|[.;,!] ?|\b(?:please|just|now|then|and) )(?:lower|reduce|decrease|cut) (?:\w+ )?)"
    r"(?:limit|bound|end|cap|ceiling|max\w*)(?: \w+){0,2}? (?:to|at)(?: (?:about|around|roughly))?\s*$"
)
"""'Lower the limit to 1 N' names a most, 'the lower limit is 1 N' a least."""
_CONDITION = re.compile(
    r"\b(?:if|unless|in case|only when|as needed|where needed|when(?:ever)? (?:it|the \w+) (?:slips?|slides?|starts?|moves?|needs?))\b"
)
_ONLY_IF = re.compile(
    r"\s*,?\s*(?:(?:but )?only )?(?:if|when|where|as|unless) (?:really |absolutely |strictly )?(?:needed|necessary|required|need be|you must|you have to|(?:it|the \w+) (?:slips|slides|needs|moves|(?:starts?|begins?) (?:to )?(?:slip|slid|mov|fall|drop)\w*)|unavoidable)\b|"
    r"\s*,? (?:only )?in case (?:it (?:slips|slides|moves|starts)|of (?:an? )?(?:slip|need|emergency))"
)
_IF_SLIPS = re.compile(
    r"\b(?:if|when(?:ever)?|should|in case|once) (?:it|the \w+) (?:(?:still|ever|really|then|should) )?(?:slips?|slides?|wobbles?|moves?|falls?|(?:starts?|begins?) (?:to )?(?:slip|slid|wobbl|mov|fall)\w*)"
    r"(?: (?:out|away|again|at all|a bit|a little))?(?:, ?| then |:| (?=(?:please|you can|use|take|try|hold|grip|grasp|squeeze|apply|go|set|make|switch|\d)\b))(?:(?!\b(?:least|min\w*|more|above|over|less|under|below|not|never)\b)[^.;#\d])*$"
)
"""'If it slips, use 1 N': the most that is ever used."""
_RISES = re.compile(
    r"\b(?:go|get|rise|raise|increase|up|ramp|climb|bring|turn|crank|squeeze|more)\b[^.;,]{0,25}\bto(?: (?:about|around|roughly))?\s*$"
)
_REACHED = re.compile(
    r"\b(?:if|when|whenever|once|should|as soon as|the (?:moment|instant|second|minute|point (?:at which|where))|at the (?:moment|point)|by the time|the very (?:moment|instant))\b(?: [\w'-]+){1,6}? (?:reach(?:es|ed)?|feels?|sees?|measures?|hits?|gets? to|comes? to|goes to|attains?|shows?|reads?|says?|reports?|indicates?|displays?|registers?|records?|crosses|touch(?:es)?|passes|is at|are at|climbs? to|rises? to)(?: (?:about|around|roughly))?\s*$"
)
_STOP_ONCE = re.compile(
    r"\b(?:stop|quit|halt|cease|freeze|finish|end|enough|cut (?:out|off|it|the)|abort|release|leave off|back off|ease off|let up|hold off|pull up|call it|no (?:further|more|tighter|harder|firmer)|(?:not|never)(?: \w+){1,4}? (?:further|more|tighter|harder|firmer|any ?more))\b[^.;#\d]{0,40}$"
)
"""Before 'as soon as the sensor reads 1 N': what is reached ends it."""
_NOT_STOPPED = re.compile(r"\b(?:not|never|without|no need to)(?: (?!stop)\w+){0,2} $")
_IS_REACHED = re.compile(
    r"\s*(?:is|are|has been|was|were) (?:reached|hit|attained|there|shown|felt)\b"
)
_ONCE = re.compile(r"\b(?:if|when|whenever|once|as soon as|the moment|should)\b[^.;,]{0,20}$")
_TOO_FAR = re.compile(
    r"\b(?:too (?:far|much|hard|high|strong|tight)|over(?:did|done|doing|shot|stepped))\b[^.;,#]*$"
)
"""'You have gone too far if you hit 1 N'."""
_ENOUGH = re.compile(
    r"[^#]{0,40}?\b(?:stop|not|no more|never|enough|ease|back off|quit|halt|no further|hold there|cut|too (?:far|much|hard|high|strong|tight)|over(?:did|done|doing|shot|stepped)|gone past|is the end|all over)\b"
)
"""Behind a force that is reached: it ends there."""
_EITHER_WAY = re.compile(
    r"\b(?:more or less|less or more|harder (?:or|nor) softer|softer (?:or|nor) harder|higher (?:or|nor) lower|lower (?:or|nor) higher|"
    r"above (?:or|nor) below|below (?:or|nor) above|over (?:or|nor) under|under (?:or|nor) over|firmer (?:or|nor) softer|softer (?:or|nor) firmer)(?: than)?\s*$"
)
_THAT_AFTER = re.compile(
    r"[^.;#\d]{0,40}?\b(below|under|beneath|above|over) (?:that|it)\b(?! (?:goes|is|will))"
)
_HARMS_BEYOND = re.compile(
    rf"(?: (?:it|they|the \w+))?(?: (?:just|only|will|would|easily))* {_HARMS}"
)
"""'Above that it bruises'."""
_ENDED = r"(?=\s*(?:$|[.;)!,](?!\s*[:=]?\s*\d)|(?:and|because|but|since|so|thanks|please)\b))"
_LIMIT_AFTER = re.compile(
    r"\s*[.;(:!,–—-]*\s*(?:(?:and|but) )?(?:(?:that|this|which|it)(?: is|'s| has to be| must be) (?:really |already |also )?(?:the|my|our|your|a|an)? ?(?:very |absolute |hard |upper |strict )*"
    rf"(?:max(?:imum|imal)?|limit|ceiling|cap|most(?: (?:i|we|you|it|that)\b[^.;#\d]*)?|upper (?:limit|bound|end))|(?:hard |absolute |upper |strict )*(?:limit|max(?:imum)?|ceiling|peak){_ENDED}|"
    rf"(?:absolutely |definitely |and |but |really )*(?:no|never|not|nothing) (?:more|higher|harder|further){_ENDED}|(?:that|this|which|it) (?:must|may|should|can|shall|is) (?:not|never) (?:to )?be (?:exceeded|passed|surpassed|crossed)|"
    r"(?:please |just )*(?:go|push|press|squeeze|rise|get) no (?:higher|further|harder|more|tighter|firmer))\b(?! (?:than|of) \d)(?!\s*(?:is|of|:|=|at|to)?\s*\.?\d)"
)
"""'1 N. That is the maximum.' '1 N; absolutely no more'."""
_ONLY_ALLOWED = re.compile(
    r"\b(?:only|just|merely|a mere) # (?:is|are) (?:allowed|permitted|tolerated|acceptable)\b"
)
_FROM = re.compile(r"\bfrom\s*$")
_DOWN = re.compile(r"\s*(?:and |or )?(?:on )?down(?:wards?)?\b(?! (?:to|by)\b)")
"""'From 2 N down'."""
_STOPS_AT = re.compile(r"\bstop\w* (?:\w+ )?at\s*$")
_HELD_THERE = re.compile(
    r"\s*,? (?:and|then) (?:then )?(?:hold|keep|stay|remain)(?: (?:it|that|the \w+))? (?:there|steady|like that)\b"
)
"""'Stop at 0.9 N and hold it there' holds with 0.9 N."""
_EXACT_AFTER = re.compile(
    r"[.,;:]?\s*(?:and )?(?:(?:not|no) (?:a \w+ )?(?:more|higher|harder)(?:,| and| or|\.)* ?(?:not|no|nor) "
    r"(?:a \w+ )?(?:less|lower|softer)|(?:not|no) (?:a \w+ )?(?:less|lower|softer)(?:,| and| or|\.)* ?(?:not|no|nor) "
    r"(?:a \w+ )?(?:more|higher|harder)|neither (?:more|harder|firmer|higher) nor (?:less|softer|lower|gentler)|"
    r"neither (?:less|softer|lower|gentler) nor (?:more|harder|firmer|higher)|no (?:more|less) and no (?:less|more))"
)

NOT = re.compile(
    r"\b(?:not|no|never|none|nothing|nowhere|without|nor|neither|avoid\w*|refrain|refuse|forbid\w*|stop|"
    r"prevent\w*|keep(?: \w+){0,4} from|rather than|instead of|in place of|hardly|nobody)\b"
)
_BEGINS = re.compile(
    r"[.;:,]\s|\s[–—-]\s|\(|\b(?:so|but|because|then)\b|\band (?=(?:do not|never|not|no)\b)|(?<= )(?=do not\b)|(?<=\bit )(?=never\b)"
)
_BEGINS_BELOW = re.compile(
    rf"{_BEGINS.pattern}|\b(?:it|them|this|that|one|(?:straw ?)?berry|fruit) and\b"
)
"""Where the reach of a denial begins: in 'do not drop it do not go over 1 N' at the second."""
_IF = re.compile(
    r"(?<!only )(?<!just )\b(?:if|should) (?:you|it|we|the \w+)\b(?! (?:would |could |can |just |only |always |never )*(?:stay|stays|stayed|keep|keeps|kept|remain\w*|hold|held|use|used|limit\w*|were|was kept|is kept)\b)"
)
_WHEN_ABOVE = re.compile(
    r"\b(?:when|whenever|once|in case|as soon as|the moment|every time|any ?time|if)(?: (?!use\b|using\b|with\b|apply\b|hold\b|grip\b|it slips?\b)\w+){0,3} $"
    r"|\b(?:stop|abort|halt|trip|quit|fault|alarm|e-?stop|back off|ease off|shut (?:down|off)|cut (?:out|off))(?:s|p?p?ing|p?ed)?(?: (?!at\b)\w+){0,2} $"
)
"""'Whenever it is above 1 N, ease off'."""
_WHEN_BELOW = re.compile(
    r"(?<!only )(?<!just )\b(?:if|when|whenever|once|as soon as|the moment|in case|should) (?:it|(?:the|my|our|your|its) (?:\w+ )?\w+)(?: ever| once| again| then)* (?:reads?|shows?|falls?|drops?|goes|go|gets?|sinks?|dips?|comes?|feels?|measures?|sees|is|reports?)(?: ever| anything| back| down| to| a force| values?)* $"
)
"""'When it reads below': a warning, whatever stands behind it."""
_PLEASED = re.compile(
    r"[^.;#\d]{0,25}\b(?:fine|ok(?:ay)?|happy|good|glad|great|perfect|all right|alright|well|safe|pleased|content|ideal|excellent)\b"
)
"""'If it is below 1 N, that is fine' warns of nothing."""
_WISHED = re.compile(
    r"\b(?:prefer|appreciate|like|love|wish|happ\w+|glad|nicer?|great|good|best|better|ideal|grateful|thankful|pleased|safer|safest|kind|lovely|fine|ok|okay|cool|perfect|helpful|wonderful|sure)(?: it| for me| of you)? if\b"
)
"""'I would prefer it if it went below 1 N' supposes nothing."""

_RISE = re.compile(
    r"\b(?:bring|take|raise|get|ramp|crank|turn|increase|dial|build|work|go)(?: (?:it|this|that|the \w+))?\s*$"
)
_UNCONCERNED = re.compile(
    r"\b(?:(?:do|does|did|would|should|need|must|can) not (?:really |much )?(?:care|mind|matter|worry|bother|know|want to know|understand|fuss)|(?:do not|never) (?:rush|hurry|worry|panic|stress|fret|dawdle|linger|wait)\b|no (?:matter|problem|worries|idea|rush|hurry|question)|not (?:sure|bothered|fussed|certain)|why not|whether or not|no(?= (?:not|never|no)\b)|not (?=(?:not|never|no)\b))"
)
"""Denials that don't deny a bound: 'I do not care, just not above 1 N'."""
_STOPS_SHORT = re.compile(
    r"\bstop(?:s|ping)?(?: (?!squeez|press|grip|hold)\w+){0,2}? (?:short of|shy of|before|below|under|beneath)(?: (?:about|around|roughly|the|a))?\s*$"
)
_NOT_STOPPING = re.compile(r"\b(?:not|never|without|no)(?: \w+){0,2} $")
_HARMED = re.compile(
    rf"\b{_HARMS}(?: \w+){{0,3}} (?:above|over|beyond|past|at|from|with more than|after)\s*$"
)
_SLIPPING = re.compile(
    rf"(?:^|[,;:]|\b(?:it|berry|fruit|one|this|thing|they|and|or|but|these|berries)) ?{_SLIPS}(?: \w+){{0,3}} (?:under|below|at|with|with less than)\s*$"
)
_LOST_BELOW = re.compile(
    r"\b(?:it|(?:straw ?)?berry|berries|fruits?|one|ones|this|that|these|those|thing|they|egg|peg|you|we|i)(?: like (?:this|that|these))? (?:\w+ly |just |always |simply |will |would |can )*(?:(?:slip|fall|drop|slide|escape)s?|(?:get|come|work|wriggle|break|pop)s? (?:away|loose|free|out|lost|off)|loses? (?:it|them|hold|grip)|drop (?:it|them))\b"
    r"(?: (?!not\b|never\b|no\b|and\b|but\b|so\b|unless\b|until\b)[\w']+){0,4}?(?: (?:if|when|whenever|where|once|as soon as|the moment|from|out of|at|under|by|with)(?: (?!not\b|never\b|unless\b|until\b)[\w']+){0,5}?)? ?(?:(?:less|lower|weaker|softer|looser|smaller|gentler) than|under|below|beneath)\s*$"
)
"""'It drops if you hold it with less than'."""
_NOBODY_HOLDS = re.compile(
    r",? ?(?:(?:(?:the |my |our |your |these |its )?(?:fingers?|gripper|robot|hand|jaws|i|we|you|they|it) (?:always |usually |just |simply |will |would |can |often )*(?:loses?|drops?|lets? go of|can ?not hold|fails? to hold) (?:it|them|this|(?:the|this|that) (?:straw ?)?(?:berry|fruit|one)))|(?:(?:nobody|no one|none|no gripper|no robot)(?: (?:has|have|had|could|can|will|would|was|is))?(?: ever| yet)*|(?:i|we|you|they|it|the (?:gripper|robot))(?: (?:have|has|had|could|can|will|would|were|was|am|are|is|did|do|does))? (?:never|not))"
    r"(?: (?:ever|been|be|manage[sd]?|able|succeed(?:s|ed)?|to|in|quite|really|yet))* (?:hold|holds|held|holding|lift|lifts|lifted|lifting|keep|keeps|kept|keeping|carry|carried|grip|gripped)\b)"
)
"""'Below 1.1 N nobody has ever managed to hold it.'"""
_ONLY_ABOVE = re.compile(
    r"\b(?:only|just) (?:comes?|lifts?|holds?|stays?|moves?|sticks?|keeps?|works?|gets?|can be (?:held|lifted|picked))\b[^.;,#]{0,30} (?:if|when|once|where|with|at)\b[^.;,#]{0,30}\b(?:more|harder|higher|firmer) than\s*$|"
    r"\b(?:only|just) (?:comes?|lifts?|holds?|stays?|moves?|sticks?|keeps?|works?|gets?)\b[^.;,#]{0,30} (?:above|over|beyond)\s*$"
)
"""'It only comes off the tray if you grip it with more than'."""
_ORDERED = re.compile(
    r"\b(?:(?:stay|remain)|(?:keep|hold|use|apply|grip|squeeze|grasp|take|press|pinch|clamp)(?: (?:it|this|that|(?:the|this|that|your|my) (?:\w+ )?\w+|everything|yourself))?)(?: (?:well|far|always|safely|at all times|gently|softly|please|only|just|a bit|at|with|to|anything))*"
    r" (?P<bound>(?:(?:a |any )?(?:force|grip)s? )?(?:(?P<below>(?:less|lower|weaker|softer|looser|smaller) than|below|under|beneath)|(?:more|higher|stronger|harder|firmer|greater) than|above|over|beyond))\s*$"
)
"""An order to stay on one side of a force, whatever reason stands beside it."""
BROUGHT_BELOW = re.compile(
    r"\b(?:make (?:sure|certain)|ensure|see to it|(?:reduce|lower|ease|decrease|loosen|relax)\b[^.;,#]{0,30} (?:so|such|until|till)|(?:i|we) (?:want|need|would like))\b[^.;,#]{0,20}\b(?:it|this|that)(?: to| should| must)? (?:falls?|drops?|goes|go|comes|come|gets?|stays?|stay)(?: back| down| well)* (?P<bound>below|under|beneath)\s*$"
)
"""'Make sure it falls below': 'it' is the force."""
_NOT_ORDERED = re.compile(
    r"(?:\b(?:not|never|no|nobody|none|nothing|neither|nor|without|rather than|instead of|stop|avoid|if|when|whenever|unless|can|could|would|will|may|might|i|we|you|they|it|who|that|which|to)\b|n't\b)(?: (?!and\b|but\b|since\b|because\b|so\b|as\b|then\b)\w+){0,2}? ?$|"
    r"\b(?:any|every|each|an?|the|no|all|some|your|my|its|this|that|firm|loose|tight|soft) $"
)
"""Before words that give no order: 'do not use less than', 'if you hold it below'."""
_AND_SO = re.compile(
    rf",? (?:and|or) (?:it|the \w+|you|they) (?:will |would |just |simply )*(?:{_SLIPS}|lose)\b(?!(?: \w+){{0,3}}? (?:if|when|unless|once)\b)"
)
"""'Hold it with less than 0.7 N and it drops.'"""
_AND_HARM = re.compile(
    rf"[,;:–—-]?\s*(?:(?:and|or|as|because|since|then) )?(?:it|this|that|the \w+|they|you|we) (?:will |would |can |could |might |may |just |surely |soon |already |starts? to |begins? to |are |is |get |gets )*(?:too much|{_HARMS})(?! (?:only|easily|never|if|when|once|unless)\b)|"
    r"[,;:–—-]? (?:and|or) (?:(?:you|we|i) (?:are|will be) (?:out|fired|dead|in (?:big )?trouble|done|finished|sorry|history)|(?:you|we) (?:will )?(?:get|have|make) (?:jam|juice|mush|pulp|a mess)|it is (?:jam|juice|mush|pulp|over|ruined))\b"
)
"""'Squeeze with more than 1 N and it bruises.'"""
_IMPOSSIBLE_BELOW = re.compile(
    r"\b(?:impossible|not possible|hopeless|useless|no use|pointless|futile|no good)(?: for \w+)? (?:to|trying to) (?:hold|lift|keep|grip|carry|pick)\b[^.;,#]{0,30} (?:(?:less|lower|weaker|softer|looser) than|below|under)\s*$"
)
"""'It is impossible to hold it with less than'."""
_STATED_BELOW = re.compile(
    r"(?:^|[.;:,!–—-] ?|\b(?:that|because|since|as|and|but|so|for) )(?:(?:anywhere|somewhere|even|just|only|well|far|much|always|already|apparently|usually) ){0,2}(?:at |with )?(?:anything |any force |a force |forces |a grip )?(?:(?:less|lower|weaker|softer|looser) than|below|under|beneath)\s*$"
)
"""Begins a statement: no order stands before it, as in 'stay below'."""
_BUT_NEVER = re.compile(
    r"(?: (?:if (?:you|it|need)[^.;,#]{0,20}|freely|without worry|all you (?:like|want)))?[,;]? (?:but|and|yet|though) (?:(?:please|do|you) )*(?:never|not)(?: (?:with|go|use|any(?:thing)?|be|apply))* (?P<side>less|below|under|lower|more|above|over|higher|beyond)\b(?! than #?\d| #?\d)"
)
"""'You can squeeze with more than 0.9 N, but never with less.'"""
_TOO_MUCH = re.compile(
    rf"[^.;#(]{{0,30}}\b(?:(?<!not )(?<!never )too (?:much|far|hard)|out of|no go|not ok\w*|pointless|useless|no (?:use|sense|point|need|good)|wast\w+|{_UNWANTED}|(?:you|we|it) (?:must|may|should|shall|can|are to) not|(?:not|never) (?:be )?(?:needed|necessary|required|called for|wise|good|wanted|used)|jam\b|juice\b|smoothies?\b|pur[eé]e|pulp\b|mush\b|sauce\b|{_HARMS})"
)
_TOO_LITTLE = re.compile(
    rf"(?:(?!\b(?:not|never|no|without)\b)[^.;#(]){{0,20}}\b(?:will not do|not (?:allowed|acceptable|permitted|ok\w*|on)|forbidden|banned|not (?:enough|sufficient)|too (?:little|weak|soft|loose|gentle|light|low|feeble)|insufficient|useless|will not hold|no good|not acceptable|{_SLIPS}\w*(?!\w){NO_OTHER_FORCE}|let it|(?:gets?|is|becomes?|feels) (?:loose|shaky|unstable|slippery))"
)


_ANY_MORE = re.compile(
    r"\s*[.,;:!–—-]*\s*(?:(?:and|but) )?(?:(?:any(?:thing)?|even|just|an?|slightly|bit|little|touch|tad|hair|one|much) )+"
    r"(?:(?P<more>more|harder|higher|firmer|tighter|stronger|above|beyond|over)|less|softer|lower|looser|gentler|under|below)\b(?: than (?:that|this|it)\b)?(?! (?:than )?(?:about |around )?\d)"
)
"""'1 N, any more would crush it', '0.8 N, anything less lets it slip'."""
_NO_FURTHER_AFTER = re.compile(rf"\s*[.;,!]+ (?:(?:and|but|so) )?(?:do )?{_NO_FURTHER}")
"""'1 N. And do not go over.'"""


def _end_of_conditional_most(left: str, right: str) -> int | None:
    """How much behind a force says that it is an end to be reached; None where it is none."""
    reached = _IS_REACHED.match(right) if _ONCE.search(left) else None
    cut = reached.end() if reached else 0
    reaches = reached or _REACHED.search(left)
    if reaches and (_ENOUGH.match(right[cut:]) or _TOO_FAR.search(left)):
        return cut  # 'once 1 N is reached, stop'
    if reaches:
        once = _ONCE.search(left) if reaches is reached else reaches
        stop = _STOP_ONCE.search(left[: once.start()]) if once else None
        if stop and not _NOT_STOPPED.search(left[: stop.start()]):
            return cut  # 'stop as soon as it reads 1 N'
    if _IF_SLIPS.search(left):
        return 0
    conditional = _CONDITION.search(re.split(r"[.;]\s", left)[-1])
    only_if = _ONLY_IF.match(right)
    if only_if and "unless" in only_if[0] and not NOT.search(left):
        only_if = None  # '1 N unless it slips' holds with 1 N
    return 0 if (conditional and _RISES.search(left)) or only_if else None


def relation(left: str, right: str) -> tuple[Kind, int, int]:
    """Kind of a force, and how much of the text on either side says so."""
    if match := _THAT_AFTER.match(right):
        is_denied = bool(NOT.search(match[0])) or bool(_HARMS_BEYOND.match(right[match.end() :]))
        is_most = (match[1] in ("below", "under", "beneath")) != is_denied
        return ("most" if is_most else "least"), len(left), 0
    if _EITHER_WAY.search(left):
        return "value", len(left), 0
    if match := _BUT_NEVER.match(right):
        is_least = match["side"] in ("less", "below", "under", "lower")
        if (_ABOVE if is_least else _BELOW).search(left):
            return ("least" if is_least else "most"), len(left), match.end()
    if match := _ONLY_ABOVE.search(left):
        return "least", match.start(), 0
    if _STOPS_AT.search(left) and _HELD_THERE.match(right):
        return "value", len(left), 0
    if exact := _EXACT_AFTER.match(right):
        return "value", len(left), exact.end()
    if match := _LIMIT_AFTER.match(right) or _NO_FURTHER_AFTER.match(right):
        return "most", len(left), match.end()
    if match := _ANY_MORE.match(right):
        is_wrong = (_TOO_MUCH if match["more"] else _TOO_LITTLE).match(right, match.end())
        if is_wrong:
            return ("most" if match["more"] else "least"), len(left), match.end()
    if _FROM.search(left) and _DOWN.match(right):
        return "most", len(left), 0
    if match := _LOWERED.search(left):
        return "most", match.start(), 0
    if match := _ONLY_ALLOWED.search(f"{left.rstrip()} #{right}"):
        return "most", min(match.start(), len(left)), 0
    if (cut := _end_of_conditional_most(left, right)) is not None:
        return "most", len(left), cut
    if match := _STOPS_SHORT.search(left):
        return (
            ("least" if _NOT_STOPPING.search(left[: match.start()]) else "most"),
            match.start(),
            0,
        )
    if (brought := BROUGHT_BELOW.search(left)) and not NOT.search(brought[0]):
        return "most", brought.start("bound"), 0
    ordered = _ORDERED.search(left)
    if ordered and not _NOT_ORDERED.search(left[: ordered.start()]):
        is_most = ordered["below"] is not None
        if not (_AND_SO if is_most else _AND_HARM).match(right):
            return ("most" if is_most else "least"), ordered.start("bound"), 0
    for pattern, plainly, denied, harm, begins in (
        (_ABOVE, "least", "most", _TOO_MUCH, _BEGINS),
        (_BELOW, "most", "least", _TOO_LITTLE, _BEGINS_BELOW),
    ):
        if match := pattern.search(left):
            clause_start = max(
                (m.end() for m in begins.finditer(left[: match.start()])),
                default=0,
            )
            said = _UNCONCERNED.sub(lambda m: " " * len(m.group()), left)
            said = _WISHED.sub(lambda m: " " * len(m.group()), said)
            denial = list(NOT.finditer(said, clause_start, match.end()))
            is_wished = pattern is _BELOW and _PLEASED.match(right) is not None
            if not denial and not is_wished:
                denial = list(_IF.finditer(said, clause_start, match.end()))
            stated = _HARMED if pattern is _ABOVE else _SLIPPING
            beside = denial if pattern is _ABOVE or len(denial) % 2 == 1 else []
            is_denied = bool(beside) or (
                pattern is _ABOVE and bool(_WHEN_ABOVE.search(said[clause_start : match.start()]))
            )
            is_denied = is_denied or bool(harm.match(right)) or bool(stated.search(left))
            if pattern is _BELOW:
                is_lost = (
                    (_WHEN_BELOW.search(said[: match.start()]) and not beside and not is_wished)
                    or _LOST_BELOW.search(left)
                    or _IMPOSSIBLE_BELOW.search(left)
                    or (_STATED_BELOW.search(left) and _NOBODY_HOLDS.match(right))
                )
                is_denied = is_denied or bool(is_lost)
            start = beside[0].start() if beside else match.start()
            return (denied if is_denied else plainly), start, 0  # type: ignore[return-value]
    if match := _HARMED.search(left):
        return "most", match.start(), 0
    if match := _SLIPPING.search(left):
        return "least", match.start(), 0
    most, least = _MOST.search(left), _LEAST.search(left)
    if most and most.group().startswith("up to") and _RISE.search(left[: most.start()]):
        most = None  # 'bring it up to 1.4 N'
    if most and (not least or most.start() < least.start()):
        return "most", most.start(), 0
    if least and _TAKES.search(least.group()) and _MOST_AFTER.match(right):
        return "most", least.start(), 0
    if least:
        return "least", least.start(), 0
    if match := _MOST_AFTER.match(right):
        return "most", len(left), match.end()
    if match := _LEAST_AFTER.match(right):
        return "least", len(left), match.end()
    after = re.split(r"[.!?](?:\s|$)|#", right)[0]
    after = "" if re.search(r"\d", after) else after  # it belongs to the next force
    sentence = re.split(r"[.;!?]\s|#", left)[-1] + " # " + after
    if _MOST_SOMEWHERE.search(sentence):
        return "most", len(left), 0
    if _LEAST_SOMEWHERE.search(sentence):
        return "least", len(left), 0
    return "value", len(left), 0
