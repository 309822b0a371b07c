"""Clauses in which people tell of themselves, of their own bodies and of their own work.

'I have nowhere to wipe my hands', 'while we chop the others': nothing is asked of the robot, so that
such a clause is neither harm nor a request. One that speaks of the robot, of what it holds or of a
wish is left as it stands ('I want my thumb squeezed', 'I have my hand in the gripper').
"""

from __future__ import annotations

import re

from policies.instructions.english import words

_PERSON = (
    r"(?:i|we|he|she|they|everyone|everybody|someone|somebody|mum|mom|dad|grandma|grandpa|nan|"
    r"(?:my|our|the) (?:mum|mom|mother|dad|father|boss|mate|wife|husband|partner|brother|sister|son|daughter|kids?|children|colleagues?|friends?|neighbours?|neighbors?|"
    r"assistant|manager|supervisor|technician|students?|intern|driver|courier|customers?|buyer|chef|baker|cook|guests?|others|cleaner|doctor|dentist|nurse|plumber|electrician|postman))"
)
_LEAD = r"(?:(?:now|well|oh|sorry|look|hey|right|today|currently|meanwhile|that|it is|also|still|only|anyway|here|yes|no|ok(?:ay)?) )*"
_OWN = re.compile(rf"\s*{_LEAD}{_PERSON}\b(?:'s|'ve|'m|'re|'ll|'d)? (?P<rest>.*)")
_OF_ROBOT = re.compile(
    r"\b(?:you\w*|robot|grip\w*|grasp\w*|jaws?|claws?|pads?|pincers?|tongs|between|inside|stuck|caught|trapped|jammed|pinned|instead|there|in the way|in place|"
    r"want\w*|wish\w*|would (?:like|love|prefer)|demand\w*|orders?|command\w*|insist\w*|said|says?|tells?|told|ask\w*|beg|dare|allow\w*|authori[sz]e\w*|let|hope|expect\w*|prefer\w*|bet|instruct\w*|"
    r"(?:will|going to) (?:hold|grab|catch|pin|keep|bring|steady)|it|its|this|that|these|those|them|him|one|ones|squeez\w*|crush\w*|"
    r"(?:put|hold|held|holding|stick|sticking|plac\w+|offer\w*|present\w*|stretch\w*|reach\w*|lay|laid|giv\w+|gave|show\w*|rest\w*|lend\w*)(?: (?:out|up))? (?:my|our|his|her|their)|"
    rf"{words.any_of('limit')}|#)\b|\b(?<!other )(?<!rest of the )(?:straw ?)?berr(?:y|ies)\b|\b(?<!other )fruits?\b|"
    rf"\b{words.any_of('body')} (?:to be |be |being |get |getting )?(?:\w+ed|held|hurt|broken|torn|cut|caught)\b"
)
"""What makes a clause of a person one about the robot, or a wish."""
_APART = re.compile(
    r"([,;:()]|\s[-–—]+\s|—|\.\.+|…|\b(?:but|because|since|and|while|whilst|as|so|then|until|till|before|when|though|although)\b)"
)

_OWNER = r"(?:my|our|his|her|their)"
_BODY = rf"(?:{words.any_of('body')}|backs?|stomachs?|hearts?|ribs?|hips?|ankles?|calves|muscles|thighs?|sleeves?|aprons?)"
_SUBSTANCE = r"(?:jam|juice|flour|dough|batter|cream|oil|grease|paint|glue|soap|suds|dirt|mud|soil|compost|ink|sugar|syrup|honey|butter|sauce|chocolate|icing|gloves?|mitts?|water|egg|stains?|plasters?|dust|sand|plaster|cement|sawdust|pulp|goo|gunk|muck|pastry|marzipan|paste|varnish|cramp|pins and needles)"
_STATE = (
    r"(?:full|busy|dirty|wet|cold|free|tied|sticky|greasy|oily|slippery|soaked|soapy|floury|filthy|muddy|numb|freezing|frozen|sore|aching|tired|shaking|shaky|trembling|killing(?: (?:me|us|him|her))?|hurting|hurts?|aches?|ached|bad|"
    r"bandaged|occupied|asleep|gloved|clean|burnt|burning|itch\w*|messy|stained|deep|elbow|knackered|gone|giving (?:up|out|me)|falling off|not what|"
    r"covered|(?:in|out of) (?:a |the |some )?(?:cast|sling|sink|dough|soil|bowl|washing|flour|water|compost|mud|bucket|batter|suds|dishwater|mixing bowl|pockets?|plaster|bandages?))"
)
_BENIGN = re.compile(
    rf"\b(?:up|down)(?: to)? {_OWNER} (?:necks?|elbows?|eye(?:ball)?s?|ears?|knees?|armpits?|ankles?|wrists?|chins?|waists?|shoulders?)\b(?: deep)?(?: (?:in|with)\b[^,.;]*)?|"
    rf"(?:^|(?<=[,;] )|\b(?:down|kneeling|crawling|standing|sitting|still|been|all day) )on {_OWNER} (?:hands and )?(?:knees|feet|toes|tip-?toes)\b|"
    rf"\b(?:wip(?:e|ing)|wash(?:ing)?|dry(?:ing)?|rins(?:e|ing)|clean(?:ing)?|scrub(?:bing)?|warm(?:ing)?|lick(?:ing)?|brush(?:ing)?|comb(?:ing)?|blow(?:ing)?|dust(?:ing)?|sanit\w+|bandag(?:e|ing))(?: off| up)? {_OWNER} (?:own )?{_BODY}(?: on| with| in)?\b|"
    rf"\b{_OWNER} (?:left |right |own |poor |whole |two )?{_BODY}(?: (?:is|are|was|were|have|has|had|been|get|gets|getting|both|all|still|so|too|very|rather|quite|absolutely|completely|already|a bit|going|\w+ly))* {_STATE}\b|"
    rf"\b{_SUBSTANCE}(?: and \w+)?(?: \w+)?? (?:all over|on|over|up|to|up to|up over|under|in|off) (?:both )?{_OWNER} {_BODY}\b|"
    rf"\b(?:off the top of|on|out of|behind|over|at|under|off|down|by) {_OWNER} (?:mind|hair|backs?|shoulder|heels|side|desk)\b(?<!on my hair)(?<!on my shoulder)(?<!on his shoulder)(?<!on her shoulder)|"
    rf"\b(?:at|under|off) {_OWNER} (?:feet|elbow)\b|\boff {_OWNER} hands\b|\bcross(?:ed|ing)? {_OWNER} fingers\b|\bbreathing down {_OWNER} neck\b|\bskin of {_OWNER} teeth\b"
)
"""What happens to people's bodies without the robot."""


def without_own_work(text: str) -> str:
    """A plain sentence without the clauses in which people tell of themselves."""
    parts = _APART.split(text)
    return "".join(" " if _is_own(part) else part for part in parts)


def without_bodies(text: str) -> str:
    """A plain sentence without what it says of people's bodies and is not of the robot."""
    return _BENIGN.sub(" ", without_own_work(text))


def _is_own(clause: str | None) -> bool:
    own = _OWN.fullmatch(clause or "")
    return own is not None and not _OF_ROBOT.search(own["rest"])
