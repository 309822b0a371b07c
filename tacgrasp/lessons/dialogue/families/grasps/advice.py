"""Families about what to do next, and about the reasons of an advice or of an answer."""

from __future__ import annotations

from tacgrasp.lessons.dialogue.meaning import Which, Why
from tacgrasp.lessons.dialogue.patterns.family import QuestionFamily, length_of
from tacgrasp.lessons.dialogue.patterns.phrases import amount_pattern

SAFE_QUESTIONS = (
    "Is it safe to lift?",
    "Can we lift it?",
    "Is the grip good?",
    "May I lift it now?",
    "Good to go?",
    "Shall I pick it up?",
    "Is the force within the band?",
    "Is the grip too tight?",
    "Is it held too loosely?",
    "Is the grip firm enough?",
    "Is it not safe to lift?",
    "Are we squeezing too hard?",
)
NEXT_QUESTIONS = (
    "What should I do next?",
    "What next?",
    "Which step comes next?",
    "What now?",
    "What do you suggest?",
    "Your advice?",
    "What would you do?",
    "How do we proceed?",
)

_WE = "(I|we|I|we|the robot|the gripper|the arm)"
_STEP = "(step|action|move|command|order|primitive|thing|correction|adjustment|instruction)"
_CHANGES = (
    "(should|shall|do|must) (we|I) (move, squeeze or lift|tighten, loosen or (move|shift|lift)|"
    "(grip|squeeze) harder or softer or move|lift, hold or (move|let go)|go left, right, up or "
    "down|"
    "move (left or right|up or down) or (squeeze|tighten)|lift or (wait|adjust|regrip|try again)|"
    "{deed} or {deed}|{deed}, {deed} or {deed}) [first|now]|{deed} or {deed} [first]|"
    "is it better to {deed} or to {deed}|(should|shall|do) (we|I) ("
    "squeeze more, squeeze less or move|increase or decrease the force or move)|"
    "tighten, loosen or (shift|move|lift)|(lift|go|lift it) [now] [,] or (wait|hold on|not yet|stay)|harder, softer or move|move, squeeze or lift|"
    "do we (tighten, loosen or move|grip harder or softer or move)|"
    "(should|shall|must|do) (we|I|the gripper) (move|go|shift|slide) [it] (left or right|right or left|up or down|down or up|"
    "left , right , up or down|to the left or [to] the right)|"
    "(which|what) (way|direction) (should|shall|must) (we|I|the gripper) (move|go|shift|correct|slide)|in (which|what) "
    "direction (should|shall|must) (we|I|the gripper) (move|go|shift)|(where|where to|how far) (should|shall|must) "
    "(we|I|the gripper) (move|go|shift)|(should|shall|must) (we|I) (move|shift|reposition|regrip) [the (gripper|hand|"
    "fingers|grip)|{thing}]|(do|must) (we|I) (need|have) to (move|shift|reposition|regrip|realign) [the (gripper|hand|"
    "fingers|grip)|{thing}]|(move|go) (left or right|up or down)|which way|"
    "(should|shall|must|do|may|can) (we|I|the gripper) [now] (let go [of {thing}]|release [{thing}]|"
    "open [the (gripper|fingers|hand|grip)|up]|drop {thing}) [now]"
)
_NEXT = "(next|now|next|then|from here|at this point|here|first|in this situation)"

WHY_LAST = (
    "why|why|why so|wherefore|why though|on whose say-so|says what|prove it|show me why|"
    "any proof|where is the proof|back that up|what backs that|what is that founded on|"
    "what convinced you|what persuaded you|what gave it away|how did you figure that out|"
    "how did you get there|why that|why is that|why is that so|why exactly|how so|how come|"
    "[and] what is the reason [for that|behind that]|for what reason|for which reason|"
    "on what grounds|on which grounds|on what basis|based on what|on account of what|"
    "why do you say (that|so|this)|why do you (conclude|believe|claim|assume) (that|so|this)|"
    "what is (that|this|your answer) based on|how do you know [that]|what do you base that on|"
    "(can|could|would) you (explain [that|why]|justify that|give [me] (a|the) reason|say why|"
    "tell me why|elaborate)|explain [that|yourself|why|please|your answer|your reasoning]|"
    "please (explain|elaborate|say why|justify that)|tell me why [so]|what for|what tells you "
    "(that|so|this)|why do you think (that|so|this)|[give me] (the|your|a) (reason|reasons|grounds|"
    "explanation|justification) [for that|, please]|because of what|because|due to what|"
    "why not something else|I don't see why|and the reason|may I ask (why|for the reason)|"
    "how did you (decide|reach|arrive at|come to|conclude|get to) that|and why [is that|so|that]|"
    "but why|ok, why|why would (that|it) be|what is the (cause|rationale|explanation|logic|"
    "thinking|reasoning) [behind that|of that]|what (led|brings|makes|leads|brought) you to that "
    "[conclusion]|what makes you (think|believe|say|so sure of|conclude) (that|so|this)|"
    "where does that come from|what is behind that|what is your (reason|reasoning|evidence|ground|"
    "explanation|argument) [for that]|justify (that|this|it|your answer|yourself)|"
    "what speaks for that|I would like to know why|I'd like to know why|I want to know why|"
    "do you know why|any reason [for that|why]|is there a reason [for that]|what evidence do you "
    "have|"
    "what (supports|backs up|justifies|explains) that|elaborate|help me understand why|"
    "I do not understand why|can I know why|would you mind explaining [that|why]|"
    "how can you (tell|say that|know that|be sure)|says who|why should that be|"
    "are you (sure|certain|positive) [about (it|that|this)]|how (sure|certain|confident) are you [about (it|that)]|"
    "walk me through (it|that|your reasoning)|what gives you that idea|reason"
)
"""Wordings that ask for the reason of the last answer."""

_WRONG = "(wrong|amiss|not right|the matter|the problem|the trouble|the issue|off|faulty|bad)"
_GRIP = "(the|this|our|my|your) (grip|hold|force|position|contact|grasp)"
_CANT = (
    "why (can we not|can't we|should we not|can't I|shouldn't we|may I not|must we not|"
    "am I not allowed to|are we not allowed to)"
)
_LIFT = "(lift {thing}|pick {thing} up|raise {thing}|pick up {thing}|lift|raise the arm|go|start)"
_LIFTING = "(lifting {thing}|picking up {thing}|lifting|raising {thing}|going up|the lift)"

_ADVICE = "(advice|recommendation|suggestion|proposal|next (step|move|action|command)|plan|choice)"

FAMILIES: tuple[QuestionFamily, ...] = (
    QuestionFamily(
        name="next",
        pattern=amount_pattern(
            f"what (should|shall|must|should) {{doer}}|what (can|could|do) (I|we) do {_NEXT}|what "
            f"do (I|we) do|"
            f"what would (an expert|a human|an operator|a good robot) do [{_NEXT}]|"
            f"what do (I|we) (have|need) to do [{_NEXT}]|now what|so now what|and now|what now then|"
            f"what ought (I|we) to do [{_NEXT}]|what (next|now|then)|"
            f"what is the (next|best|right|proper|following|wisest|smart|sensible|safest) {_STEP} "
            f"[{_NEXT}]|"
            f"what (comes|is|happens|follows) (next|now)|which {_STEP} (comes next|is next|is best|"
            "now|next|do you (advise|suggest|recommend|propose|want)|would you (take|choose|pick|"
            "send|"
            "give)|should (we|I) (take|send|give|choose)|is (needed|required|called for|right|due)|"
            "makes [the most] sense)|what do you (advise|suggest|recommend|propose|think we "
            "should do|"
            "want (me|us) to do) [now]|what would you (do|change|try|adjust|correct|fix|suggest|"
            f"recommend|advise) [{_NEXT}|with {{thing}}|about the grip|in my place]|"
            f"how (should|shall|do|must|can) (we|I) (proceed|continue|go on|carry on|move on|react|"
            "go ahead|improve the grip|correct (this|that|it)|fix (this|that|it)|make it better)|"
            "what has to (be done|change|happen) [next|now]|what (needs|is left|remains) to be "
            "done|"
            "what (must|should|has to|can) be (changed|corrected|done|adjusted|improved|fixed) "
            f"[next|now|first]|what is your (move|call|advice|recommendation|suggestion|plan|"
            f"verdict|"
            f"next {_STEP}|decision|order|pick)|{_CHANGES}|where do we go from here|what is to be "
            f"done|"
            f"what is there to do|what is the game plan|what is on the agenda|how do we play this|"
            "what would be wise [now]|any pointers|any tips|got a tip|what is the play|guide me|"
            "steer me|lead me|coach me|where to from here|what should be our next (step|move)|"
            "what is called for|what would you have done [here]|give me directions|what (needs|has) to (change|happen)|what am I (supposed|meant) "
            f"to do "
            f"[{_NEXT}]|what are we (supposed|meant|going) to do [{_NEXT}]|any (advice|suggestions|"
            "ideas|recommendation) [what to do|for the next step]|do you have (any|a|some) (advice|"
            "suggestion|suggestions|recommendation) [for (me|us)]|what else (should|must) (we|I) "
            "do|"
            "what would (help|be best|you have (me|us) do) [now]|what would improve the (grip|"
            "hold)",
            f"what {_WE} (should|must|ought to|should) do [{_NEXT}|about {{thing}}|with {{thing}}]|"
            "what to do (next|now|about {thing}|with {thing}|first|here|then)|what (comes|is) next|"
            f"which {_STEP} (is next|is best|you (advise|suggest|recommend)|comes next|to (take|"
            f"send|"
            "give)|we should take|is needed)|how to (proceed|continue|go on|carry on|improve the "
            "grip|"
            "correct it|fix it)|what you (advise|suggest|recommend|would do|would change|propose)|"
            f"what the (next|best|right) {_STEP} is|what has to (be done|change)|what (must|"
            f"should) be "
            "(done|changed|corrected)|how we should (proceed|continue|go on)|what your advice is|"
            "(whether|if) we should (tighten, loosen or move|move, squeeze or lift)",
            f"the (next|best|right|following|proper) {_STEP} [to take|for {{body}}]|your "
            f"(recommendation|"
            f"suggestion|proposal|advice|call|move|verdict|next {_STEP}|decision|plan)|a "
            "(recommendation|suggestion|proposal) [for the next step]|some advice|advice|next|"
            f"next {_STEP}|the next (command|order)|(instructions|orders|the plan)",
            "",
        ),
        build=lambda bindings, _: Which(name="action", length=length_of(bindings)),
        slots={
            "deed": (
                "(lift|tighten|loosen|move|shift|squeeze more|squeeze less|ease off|regrip|adjust|"
                "grip harder|grip softer|move left|move right|let go and try again|go left|"
                "go right|reset|hold still|"
                "correct)"
            ),
            "doer": (
                f"{_WE} (do|do|change|try|correct|adjust|improve|fix) [{_NEXT}|about {{thing}}|"
                "with {thing}|about the grip]"
            ),
        },
    ),
    QuestionFamily(
        name="why_next",
        pattern=(
            "{lead} ( what (should|shall|must|do) (I|we|the robot) (do|do|change|try) [next|now|"
            "about it] "
            f"{{and_why}} {{tail}} ? | which {_STEP} (is next|is best|do you (advise|suggest|"
            f"recommend)|"
            "would you take|comes next|should we take) {and_why} {tail} ? "
            f"| {{want}} (the (next|best|right) {_STEP}|your (advice|recommendation|suggestion|"
            "proposal)) {with_why} {tail} [?] "
            "| what do you (advise|suggest|recommend|propose) {and_why} {tail} ? "
            "| what would you (do|change|try|suggest) [next|now] {and_why} {tail} ? "
            "| {ask} (what to do [next|now]|what we should do [next|now]|what you (advise|suggest|"
            "would do)|how to (proceed|go on)) {and_why} {tail} [?] "
            "| what (next|now|comes next|is next) {and_why} {tail} ? "
            f"| what is (the (next|best|right) {_STEP}|your (advice|move|call|recommendation)) "
            "{and_why} {tail} ? | how (do|should|shall) we (proceed|continue|go on) {and_why} "
            "{tail} ? "
            f"| [your] (next {_STEP}|advice|recommendation|move) {{with_why}} {{tail}} [?] "
            "| what has to (change|be done) {and_why} {tail} ? "
            "| (advise|instruct) (me|us) {with_why} {tail} "
            "| what to do [next|now] {and_why} {tail} ? )"
        ),
        build=lambda *_: Why(with_action=True),
        slots={
            "and_why": (
                "(and why|and why|, and why|and for what reason|, and for what reason|"
                "and what is the reason|and what for|and on what grounds|, with the reason|"
                "and why that|and what is it based on|and why so|? and why|? why|"
                "and how do you (justify|explain) (it|that)|, and please say why|and because of "
                "what|"
                ", with a reason|and what makes you (say|think) so)"
            ),
            "with_why": (
                "(and the reason|with the reason|with a reason|and why|with an explanation|"
                "and your reasoning|with reasons|and explain why|, and say why|together with the "
                "reason|"
                "and the reason for it|and its reason|, with your reasons|and justify it|"
                "and the grounds for it|plus the reason|and reason|with reason|and reasons|, "
                "explained)"
            ),
        },
    ),
    QuestionFamily(
        name="why_bad",
        pattern=(
            f"{{lead}} ( what is {_WRONG} with {_GRIP} [on {{body}}] {{tail}} [?] "
            f"| what (bothers|worries|troubles) you about {_GRIP} {{tail}} ? "
            f"| {_CANT} {_LIFT} [yet|now] {{tail}} ? "
            f"| why (is it not|isn't it) [yet] (safe|OK|wise|possible) to {_LIFT} {{tail}} ? "
            f"| why is {_LIFTING} (unsafe|risky|dangerous|a bad idea|not safe) {{tail}} ? "
            f"| what (keeps|stops|prevents|holds) (us|me|you) from {_LIFTING} {{tail}} ? "
            f"| what (speaks against|is against|stands in the way of|hinders|prevents|forbids) "
            f"{_LIFTING} "
            f"{{tail}} ? | what is (holding us back|in the way|missing [for the lift]|stopping us) "
            "{tail} ? | is (anything|something) wrong with the (grip|hold|grasp) , and what "
            "{tail} ? "
            f"| {{ask}} what is {_WRONG} with {_GRIP} {{tail}} [?] "
            f"| {{ask}} why (we|I) (can not|can't|should not|shouldn't|may not) {_LIFT} [yet] "
            f"{{tail}} [?] "
            f"| {{ask}} what (keeps|stops|prevents) us from {_LIFTING} {{tail}} [?] "
            f"| what (must|should|has to|could) be better (about|in|with) {_GRIP} {{tail}} ? "
            f"| what do you (dislike|not like|criticise|find wrong) (about|in|with) {_GRIP} "
            f"{{tail}} ? "
            f"| what (are we|am I) doing wrong [with {{thing}}|with the grip] {{tail}} ? "
            f"| why is {_GRIP} (bad|not good|not right|wrong|poor|not good enough|unsafe|not OK) "
            f"{{tail}} ? | what makes {_GRIP} (bad|unsafe|wrong|poor) {{tail}} ? "
            f"| [{{want}}] the (problem|trouble|issue|fault|flaw) with {_GRIP} {{tail}} [?] "
            "| what is (wrong|amiss|not right|off) {tail} ? | what is the (problem|trouble|issue|"
            "fault|hold-up|snag|matter) {tail} ? "
            "| what (went|is going) wrong {tail} ? | why not lift [yet|now|it] {tail} ? "
            "| where is the problem {tail} ? | what needs (improving|fixing) and why {tail} ? )"
        ),
        build=lambda *_: Why(),
    ),
    QuestionFamily(
        name="why_advice",
        pattern=(
            f"{{lead}} ( why (do|would|did) you (advise|suggest|recommend|choose|propose|want) "
            f"(this|that) [{_STEP}] {{tail}} ? | justify the {_STEP} [that] you (advise|propose|suggest|recommend) {{tail}} | "
            f"(for|on) (what|which) (reason|grounds) (do|did) you (give|offer|make) [me|us] (this|that) {_ADVICE} {{tail}} ? | why is (this|that) the (next|best|right) {_STEP} "
            f"{{tail}} ? | what is the reason (for|behind|of) (your|this|the) {_ADVICE} {{tail}} ? "
            f"| on what grounds do you (advise|suggest|recommend) (this|that) [{_STEP}] {{tail}} ? "
            f"| what is (your|the) {_ADVICE} based on {{tail}} ? "
            f"| {{want}} the (reason|reasons|reasoning|grounds|explanation|rationale) (for|behind|"
            f"of) "
            f"(your|this|the) {_ADVICE} {{tail}} [?] "
            f"| (explain|justify|give the reason for|give reasons for|account for) (your|this|the) "
            f"{_ADVICE} {{tail}} | {{ask}} why you (advise|suggest|recommend|chose) (that|this) "
            f"[{_STEP}] {{tail}} [?] | (can|could|would) you (explain|justify) (your|this|the) "
            f"{_ADVICE} "
            f"{{tail}} ? | why (this|that|your) {_ADVICE} {{tail}} ? "
            f"| how do you (explain|justify) (your|this|the) {_ADVICE} {{tail}} ? "
            f"| [the] (reason|grounds|reasons) (for|behind) (your|this|the) {_ADVICE} {{tail}} [?] "
            f"| what (led|brought) you to (your|this|the) {_ADVICE} {{tail}} ? "
            f"| what makes you (advise|suggest|recommend) (this|that) [{_STEP}] {{tail}} ? "
            f"| (why|how come|for what reason) (am I|are we|I am|we are|must I|must we|should I|should we) [supposed to|meant to|to] "
            f"do (that|this|it) {{tail}} ? "
            f"| how did you (arrive at|come to|reach|decide on) (your|this|the) {_ADVICE} "
            f"{{tail}} ? )"
        ),
        build=lambda *_: Why(),
    ),
    QuestionFamily(
        name="why_after_next",
        pattern=f"{{lead}} ({WHY_LAST}) {{tail}} [?]",
        build=lambda *_: Why(),
        before=NEXT_QUESTIONS,
    ),
    QuestionFamily(
        name="why_after_safe",
        pattern=f"{{lead}} ({WHY_LAST}) {{tail}} [?]",
        build=lambda *_: Why(shows=("force_band",)),
        before=SAFE_QUESTIONS,
    ),
)
