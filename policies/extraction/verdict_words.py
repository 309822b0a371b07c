"""The words of ``policies.extraction.verdict``."""

from __future__ import annotations

from policies.extraction.clauses import UNKNOWN, word_set

DESCRIPTORS = word_set("stable appropriate secure reliable")
OPPOSITES = word_set("unstable instable inappropriate insecure unsecure unreliable unsafe")
GRASP = word_set("grasp grip hold contact grasping gripping holding touch clasp")
WHOLE = GRASP | word_set(
    "it this that everything all things state status result verdict assessment evaluation object "
    "berry strawberry fruit egg tomato peg cherry apple marker item situation condition "
    "configuration quality i we conclusion judgment judgement setup they both now here outcome "
    "there kiwi body part piece workpiece which success"
)
PART = word_set(
    "force pressure position depth area location placement alignment load tightness strength "
    "indentation pose posture level forces distribution"
)
FOREIGN = word_set(
    "sensor sensors reading readings signal measurement data estimate image camera table robot "
    "arm network connection policy model action move movement motion step adjustment option "
    "choice plan approach strategy goal aim target task requirement response answer command "
    "previous next other last former future ideal desired another instruction objective purpose "
    "key idea word words term nothing moving increasing decreasing reducing resetting lowering "
    "raising gripper base mount stand temperature supposed hypothetical intended descriptor "
    "descriptors keyword keywords first second earlier half increase decrease reduction advice "
    "recommendation suggestion question"
)
GOALS = word_set(
    "goal aim target task requirement objective purpose key plan idea instruction next condition "
    "question desired ideal previous last wanted missing other step challenge problem word term "
    "action"
)
VERBS = word_set(
    "is are am was were has have had remains stays looks feels seems appears holds proves will "
    "would should could might may must shall can do does did think consider judge deem rate call "
    "find declare conclude became becomes used got sits went turned kept felt looked seemed "
    "appeared stayed remained feel believe report judged lies rests look seem remain stay"
)
PAST_VERBS = word_set(
    "was were had did became used went turned kept felt looked seemed appeared stayed remained got"
)
PAST_WORDS = word_set("previously formerly initially originally earlier yesterday before once past")
ANYWHERE = word_set(
    "if unless until till provided providing assuming supposing suppose whether lest otherwise "
    "perhaps maybe possibly hopefully presumably probably supposedly allegedly soon eventually "
    "later ago doubt wish doubtful hope pretend imagine false untrue incorrect mistaken lie myth "
    "illusion nonsense wrong depending depends questionable dubious unclear uncertain unlikely "
    "tomorrow theory hypothetically wonder doubts unproven unverified debatable wishful joking "
    "kidding guess assume whenever likely conceivably arguably pretending unsure disputed"
) | {UNKNOWN}
BEFORE_IT = word_set(
    "will would should could might may must shall ought be become becoming getting turning "
    "growing get gets keep keeping keeps make makes making made let lets want wants need needs "
    "require aim requires aiming try trying seek seeks attempt expect expected got prefer desire "
    "desired target goal plan toward towards improve being ensure ensures ensuring check verify "
    "promises guarantee guarantees looking said says claim claims claimed told asked reported "
    "instruction word words term descriptor descriptors example define definition means then "
    "so_that so-called called like instead_of stay lack lacks lacking fail fails failed failing "
    "missing ceases cease ceased stopped stops loses lost losing lose absence deny denies refuse "
    "less least most impossible unable insufficiently inadequately almost nearly near nearing "
    "partly partially somewhat only half semi quasi pseudo temporarily momentarily briefly "
    "approaching remain few too more despite opposite contrary devoid would-be anything away "
    "prevent prevents disagree dispute cannot until yields gives hold bring brings restore "
    "restores help helps achieve tends without supposed thought assumed believed hoped wanted "
    "demanded sure starts begins beginning starting threatens stop avoid sort kind borderline "
    "once formerly un if when ready enable enables allow allows confirm see produce produces "
    "create creates give ex never"
)
BEFORE_OK_SUBJECT = word_set("hold sure goal made")
JUDGED = word_set(
    "called considered described deemed regarded declared judged rated classified trusted found "
    "judge consider deem seems appears proves known termed labelled labeled seen viewed assessed "
    "evaluated rate classify regard describe counts classed qualifies assess"
)
SURE_LY = word_set(
    "perfectly fully completely entirely totally truly really clearly certainly definitely "
    "absolutely firmly sufficiently adequately reasonably fairly extremely highly finally "
    "currently presently undoubtedly surely evidently visibly noticeably nicely properly "
    "remarkably exceptionally consistently thoroughly genuinely equally simply obviously "
    "demonstrably satisfactorily evenly mechanically physically already wonderfully consequently "
    "accordingly verifiably unquestionably positively"
)
FOLLOWERS = word_set(
    "now enough again already at in on with for by under between throughout during due without "
    "today overall indeed too this it from against across of over given within right still is are "
    "both also surely everywhere no not i here currently inside"
)
ADJECTIVES = word_set(
    "two finger firm good centred centered gentle parallel overall well balanced safe soft "
    "current gripper pinch"
)
ACHIEVED = word_set(
    "achieved reached confirmed obtained established detected found made attained accomplished "
    "verified present"
)
RETRACT = word_set(
    "no not nope never really at all quite far from it that this is was i think do does so true "
    "the case yet correct false wrong untrue a lie hardly just actually statement incorrect"
)
DENY = word_set("no not nope never false wrong untrue hardly lie incorrect")
CONTRAST = word_set("but however yet although though except unfortunately")
CHANGED = word_set("more less higher lower greater smaller extra another")
