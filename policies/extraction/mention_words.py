"""The words of ``policies.extraction.mentions``: verbs, directions, things and comparatives."""

from __future__ import annotations

from enum import StrEnum

from policies.extraction.clauses import word_set
from primitives import Primitive


class Form(StrEnum):
    """How the mention is put, which decides what can negate it."""

    NAME = "name"  # move_down
    BASE = "base"  # move down
    GERUND = "gerund"  # moving down
    PAST = "past"  # moved down
    FINITE = "finite"  # moves down
    WANT = "want"  # more force: needs a 'needed' around it


def _forms(verbs: str) -> dict[str, Form]:
    """Regular forms of verbs, as 'base' or 'base/gerund/past' where they are irregular."""
    table: dict[str, Form] = {}
    for entry in verbs.split():
        base, gerund, past = ([*entry.split("/"), "", ""])[:3]
        stem = base[:-1] if base.endswith("e") else base
        table |= {gerund or f"{stem}ing": Form.GERUND, past or f"{stem}ed": Form.PAST}
        table |= {f"{base}{'es' if base.endswith(('ss', 'sh', 'x', 'o')) else 's'}": Form.FINITE}
        table[base] = Form.BASE
    return table


MOTION = _forms(
    "move shift go/going/went slide/sliding/slid translate step/stepping/stepped nudge displace "
    "adjust reposition bring/bringing/brought head jog advance travel steer relocate guide come"
)
RISE = _forms("raise elevate lift")
FALL = _forms("lower")
CLIMB = _forms("ascend climb")
SINK = _forms("descend")
MORE = _forms("increase boost strengthen intensify amplify raise add/adding/added")
LESS = _forms(
    "decrease reduce lower lessen ease relax loosen soften weaken lighten diminish slacken "
    "drop/dropping/dropped reduction"
)
TIGHTEN = _forms("tighten firm strengthen")
LOOSEN = _forms("loosen slacken ease relax soften")
SQUEEZE = _forms("squeeze grip/gripping/gripped grasp hold/holding/held press clamp pinch push")
TURN = _forms(
    "bring/bringing/brought turn dial scale take/taking/took ramp push step/stepping/stepped back "
    "throttle crank let/letting/let ease"
)
GIVE = _forms("apply/applying/applied use exert give/giving/gave add/adding/added need require")
RESET = _forms(
    "reset/resetting/reset regrasp regrip/regripping/regripped restart retry/retrying/retried redo"
)
AGAIN = _forms("start begin/beginning/began grasp grip/gripping/gripped try/trying/tried")
RETURN = _forms("go/going/went return move come/coming/came")
UP = word_set("up upward upwards higher top upper palm palmward")
DOWN = word_set("down downward downwards lower bottom fingertip fingertips")
LEFT = word_set("left leftward leftwards")
RIGHT = word_set("right rightward rightwards")
DIRECTION: dict[str, Primitive] = {
    **dict.fromkeys(UP, Primitive.MOVE_UP),
    **dict.fromkeys(DOWN, Primitive.MOVE_DOWN),
    **dict.fromkeys(LEFT, Primitive.MOVE_LEFT),
    **dict.fromkeys(RIGHT, Primitive.MOVE_RIGHT),
}
NOT_A_SIDE = word_set(
    "now away ahead place spot amount force way one finger fingers position pose moment pad "
    "sensor jaw gripper hand arm on before"
)
HAND = word_set(
    "gripper grippers hand arm fingers finger fingertips fingertip robot tool tcp effector grip "
    "grasp pad sensor wrist jaws it position pose yourself point manipulator"
)
HAND_ONLY = HAND - {"it", "grip", "grasp", "position", "pose", "point", "sensor", "pad"}
FORCE = word_set("force forces pressure strength tightness firmness squeeze")
GRIP = FORCE | {"grip", "grasp", "hold", "clamp"}
JAWS = GRIP | {"gripper", "fingers", "jaws", "hand"}
NOT_FORCE = word_set(
    "sensor sensors reading readings limit limits threshold width opening area time estimate "
    "range band scale gauge noise point position pose depth angle height control controller map "
    "speed frequency stability quality duration resolution rate bound bounds plate"
)
ADVERBS = word_set(
    "slightly gently slowly carefully bit little step steps two three single small tiny further "
    "more again now just by mm some straight directly about approximately around distance one cm "
    "of millimetre millimetres millimeter millimeters somewhat touch please a an the its your our "
    "my this that whole entire back there considerably significantly much all only notch shade"
)
MODIFIERS = word_set(
    "gripping grip grasp grasping clamping normal contact applied current commanded finger "
    "gripper gripper's overall total squeezing holding closing pressing grippers fingers robot "
    "robots end tool center amount on and pinch present existing exerted level"
)
TOWARDS = word_set("to toward towards in direction into for on side")
HARDER = word_set("harder tighter firmer stronger")
SOFTER = word_set("softer gentler lighter looser less easier weaker")
HARD = word_set("firmly tightly strongly hard securely force pressure")
SOFT = word_set("gently softly lightly loosely delicately carefully tenderly")
MORE_OF = word_set("more greater higher additional extra stronger firmer")
MORE_GRIP = MORE_OF | {"tighter", "harder"}
LESS_OF = word_set("less lower smaller reduced weaker gentler lighter softer")
LESS_GRIP = LESS_OF | {"looser"}
SAID_OF = word_set("is was would could has will can might may are")
ADJECTIVE_AFTER = word_set(
    "a an the its is are be at with in on of no much far even any too was from this that"
)
