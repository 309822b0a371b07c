"""What may stand beside the name of a shape or a texture, and changes nothing, in plain words.

Not here: what is made of the names (``tacgrasp.lessons.dialogue.rules.worded``).
"""

from __future__ import annotations

import re

from tacgrasp.lessons.dialogue.plainer import AUXILIARY

_PAD = r"(?:the|your|our|my|this) (?:\w+ )?(?:pad|gel|sensor|finger|fingers|fingertip|gripper|skin)"
REMARKS = re.compile(
    "|".join(
        (
            # one of several is enough
            r"(?:is|was|would|could|can|might) (?:it|this|that) (?:be )?(?:any |either )?(?:one "
            r")?of "
            r"(?:them|those|these|the)(?: two| three| #| following)?"
            r"(?: (?:that |which )?(?:you|we|i)(?: \w+){1,3})?",
            r"(?:say |answer )?yes (?:means?|if|for|when|to)\b.*|"
            r"(?:just )?(?:say|answer) yes (?:if|for|when)\b.*",
            r"(?:either|any|both)(?: one)?(?: of (?:them|those|these|the))?(?: two| three| #| "
            r"ones?)?"
            r"(?: \w+)? (?:counts?|is|are|would|will|does|do|works?|suits?|makes?|goes?|go)\b.*",
            r"one of (?:the|those|these|them)(?: two| three| #)?(?: at least| is enough)?",
            r"(?:either|any)(?: one)?(?: of (?:them|those|these|the)(?: two| three| #)?)?",
            # was it right
            r"(?:did|have|do) (?:i|we|they|he|she|my \w+) (?:win|won|lose|lost|get it right|guess "
            r"(?:right|correctly|well)|got it right|guessed right|have it right|"
            r"hit it)",
            r"(?:am|was|were|are|is|would) (?:i|we|they|he|she|that|this|it|"
            r"the \w+|my \w+)(?: be)? (?:not )?(?:right|correct|true|so|wrong|mistaken|accurate|"
            r"dreaming|justified|a good (?:bet|guess)|the case|not)",
            r"(?:does|do|did|can|could|would|will) (?:the|your|this|that|my)? ?"
            r"(?:touch|contact|sensor|gel|pad|feel|reading|readings|finger|fingers|fingertip|press|"
            r"imprint|you|it|evidence|tactile \w+)(?: \w+)? (?:bears?|back|confirms?|agrees?|fits?|"
            r"match|"
            r"matches|"
            r"supports?|concur|say so|tell|verify|second)(?: (?:that|this|it|me|out|up|with|so|"
            r"as much|my \w+|what you feel|(?:that|this|it|me) (?:out|up)))*",
            r"(?:is|was) (?:it|that|this)(?: (?:one|so|it|not|what you feel|what we have|"
            r"what you have|what it is|there|borne out|confirmed))?(?: by (?:the )?(?:touch|"
            r"contact|feel|sensor))?",
            r"(?:would|do|can|could) (?:you|we) (?:not )?(?:agree|confirm|concur|say so|say that|"
            r"second that|go along)(?: (?:to|with) (?:that|it|me))?(?: (?:that )?it is (?:one|"
            r"so))?",
            r"(?:please )?(?:confirm|deny|confirm or deny|check|verify)(?: (?:that|this|it))?"
            r"(?: please| for me)?",
            r"(?:right|correct|true|yes|no|nah|ok|okay|agreed?|concur|deal|yeah|eh|huh|innit|true "
            r"or false|"
            r"yes or no|right or wrong|y n|true false|or (?:not|no|nah|what|am i (?:wrong|"
            r"mistaken)|"
            r"is it(?: not)?|have i got (?:it|that) wrong)|is it|is it not|does it|does it not|are "
            r"they|"
            r"do you think|would you say|in your (?:view|opinion|judgement)|by (?:feel|touch)|"
            r"as far as you can (?:tell|feel)|from what you feel|what do you (?:say|think)|"
            r"(?:i|we) (?:would )?(?:suppose|think|guess|take it|believe|reckon|presume|gather|"
            r"assume|bet|hope|"
            r"expect|imagine|say)|"
            rf"{AUXILIARY} not (?:it|they|that|this|we|you|i)|"
            r"by any chance|then|or neither(?: of (?:them|these|those|the two))?|or neither one)",
            r"(?:i|we) (?:do not|would not) (?:mind|care)(?: (?:which|either way)(?: one| of "
            r"them)?)?|"
            r"(?:it is |is it )?(?:all )?the same to me",
            # have we one
            r"(?:have|has|had|do|did|does|is|was|are) (?:we|you|i|it|there|this|that|they)"
            r"(?: (?:got|have|feel|see|find|hold|holding|touching|feeling))? "
            r"(?:one|any|either|it|that|those)(?: (?:here|there|then|(?:one )?of (?:them|those|"
            r"these)))?",
            # address, beginnings, likenesses
            r"(?:my (?:good |dear |old )?(?:machine|friend|robot|man|dear)|robot|mate|buddy|pal|"
            r"dear|sir|hey|hi|hello|yo|ok|okay|so|well|now|right|please|thanks|thank you|listen|"
            r"look|"
            r"(?:a |one |my )?(?:quick |sanity |small |little |silly |last |another |first |next )*"
            r"(?:question|check|query)|quick one|tell me|honestly|be honest|go on|come on|excuse "
            r"me|sorry|"
            r"just checking|one more|next|hm+|um+|uh+|oh|and|the (?:shape|texture|surface|finish|"
            r"form)|"
            r"shape|texture|surface|finish|form|about the (?:shape|texture|surface))",
            r"(?:just |a bit |kind of )?(?:like|as) (?!an?$).*",
        )
    )
)
"""Clauses that name nothing and change nothing."""

FILLERS = frozenset(
    """
    a an the this that these those it they he she we i you me us my our your there here one
    is are was were be been being am do does did has have had got get getting could can may might
    would will
    should expect expected expecting suspect suspected think thought thinking believe believed
    bet betting wager guess guessed guessing say saying said call called consider hope hoping hoped
    assume assumed reckon reckoned imagine fear feared take taken swear sworn told tell
    claim claimed describe described class classed classify rate count deem
    is on my hunch bet gut feeling impression understanding idea theory
    to feel feels feeling felt touch touches touching touched hold holds holding held grip grips
    gripping gripped grasp grasping press presses pressing pressed squeeze squeezing catch caught
    hit sense sensing detect detecting detected find found meet met notice
    look looks seem seems appear appears resemble resembles come comes across
    grab grabbed supposed meant
    shape shaped shapes form figure outline geometry profile section cross-section kind sort type of
    like as pattern patterned texture textured finish finished surface relief feel skin exterior
    coating face outside material imprint print mark contact object thing item piece part one stuff
    thingy specimen sample side end tip
    under against on at in between into by from with for pad gel sensor finger fingers fingertip
    gripper fingertips hand
    what which whether if about maybe perhaps really actually indeed certainly truly possibly
    probably surely definitely clearly quite rather fairly pretty very somewhat at all just only
    any some sort so well then now right still also too even simply basically honestly
    right correct wrong true mistaken in thinking assuming saying supposing believing
    both either or and nor neither not no n't
    little whole entire guessing supposing perfect proper regular
    fine good enough by money anything something fair description apt term accurate word name proper
    suitable fitting honest
    deal dealing handling recognise recognize recognised
    now currently presently please yo hey
    """.split()  # noqa: SIM905
)
PHRASES = re.compile(
    rf"\b(?:on|against|under|in|into|between|at|by|to|from|with) {_PAD}\b|"
    r"\bby any (?:chance|means)\b|\bfor (?:once|sure|real|certain)\b|\bsome sort of\b|\ball over\b|"
    r"\bof (?:it|this|that|(?:the|this|that|my|our|your) (?:object|thing|item|piece|part))\b|"
    r"\b(?:it is )?(?:the case|fair|safe|possible|true) (?:that|to say(?: that)?)\b|"
    r"\b(?:deserves?|merits?) the name\b|\b(?:answers? to|fits?|matches|match) the description\b"
)
"""Phrases that change nothing, whose words would elsewhere."""
