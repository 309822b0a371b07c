"""Families about words: shape, texture, depth, area and place, asked openly; and all of them.

Not here: such words checked (``tacgrasp.lessons.dialogue.families.classes.checked``) or offered
(``tacgrasp.lessons.dialogue.families.classes.offered``).
"""

from __future__ import annotations

from tacgrasp.lessons.dialogue.families.classes import checked, offered
from tacgrasp.lessons.dialogue.meaning import Which
from tacgrasp.lessons.dialogue.patterns.family import QuestionFamily, length_of
from tacgrasp.lessons.dialogue.patterns.phrases import amount_pattern

_PAD = "(pad|gel|sensor|finger|fingertip|tip|skin)"
_GUESS = (
    "(if you had to guess|in your opinion|as far as you can tell|from what you feel|by touch|"
    "judging by touch|according to the sensor|your best guess :)"
)
_NAME = "(name|identify|determine|describe|classify|state|indicate|specify|estimate|output|guess)"
_OWNERS = "the (object|item|thing|contact|part)'s"
_KIND = "(kind|sort|type)"
_RATE = "(describe|classify|rate|characterise|judge|grade|label|sum up|put)"


def _open(name: str, subject: str, direct: str, indirect: str, noun: str) -> QuestionFamily:
    return QuestionFamily(
        name=name,
        pattern=amount_pattern(direct, indirect, noun, ""),
        build=lambda bindings, _: Which(
            name=subject, is_open=subject in ("shape", "texture"), length=length_of(bindings)
        ),
    )


_SHAPE_DIRECT = (
    "what (silhouette|contour|outline|profile|figure|morphology|configuration) (is it|does {thing} have|do you "
    "feel|has {thing})|what does {thing} resemble [in shape|geometrically]|what is the (outline|contour|silhouette|"
    "profile|morphology) [of {thing}]|which (silhouette|contour|outline|profile) is it|"
    "what form does {thing} take|(what|which) (shape|form|geometry) (am I|are my fingers) (holding|touching|gripping|squeezing|feeling|squishing)|"
    "what (sort|kind) of body am I (holding|touching) [, geometrically [speaking]]|"
    "(what|which) (geometric form|shape|geometry) does the (imprint|contact|print|dent) (suggest|have|show)|"
    "what shape is it|what is the shape|what shape is {thing}|what shape does {thing} have|"
    "what is the (shape|form|geometry) of {thing}|what shape do you feel|which shape is it|"
    "(what|which) shape (has {thing}|has {thing} got|did you feel|do you (sense|detect|read|make "
    "out))|"
    f"(what|which) (shape|form|geometry) (touches|is touching|is pressing on|is on|is in|is "
    f"against) "
    f"the {_PAD}|(what|which) (shape|form) (is|was) (that|this)|"
    "what (form|geometry) (does {thing} have|is {thing}|do you feel)|"
    "what (shape|form|geometry) are (we|you) (touching|holding|gripping|feeling|dealing with)|"
    "what shape (have we got|do we have|did we touch) [here|there]|"
    "what are (we|you) (touching|holding|feeling) , (geometrically|in terms of shape|shape-wise)|"
    "geometrically , what (is it|is {thing}|are we touching|do you feel)|how is {thing} shaped|"
    f"what {_KIND} of (shape|form|geometry) (is it|is {{thing}}|is this|does {{thing}} have|"
    f"do you feel|touches the {_PAD})|what is {{thing}} shaped like|"
    "how would you (describe|classify|characterise|name) the (shape|form|geometry) [of {thing}]|"
    "what would you call (this|the) shape|what do you call this shape|"
    "which (geometric shape|geometric form|shape class|primitive) (is it|do you feel|fits best)|"
    "what does the (shape|form) [of {thing}] (feel|look) like|what is the contact shape|"
    "what shape does (the contact|the touch|the imprint) have|what shape is the (contact|imprint)|"
    "(can|could|would) you (identify|recognise|name|tell|determine|describe) the (shape|form) "
    "[of {thing}]|do you (know|recognise|feel) (the shape|what shape it is)|of what shape is "
    "{thing}|"
    f"{_NAME} the (shape|form|geometry) [of {{thing}}]|what is the shape like|"
    f"which form has {{thing}}|{_GUESS} , what shape is (it|{{thing}})|what is {_OWNERS} (shape|"
    f"form)|"
    "what shape (would you say it is|could it be)|"
    "what is its (shape|form|geometry)|shape-wise , what (is it|do we have)|if you had to name "
    "the shape , what is it"
)
_SHAPE_INDIRECT = (
    "what shape {thing} (is|has)|which shape (you feel|{thing} has|touches the pad|this is)|"
    "what the (shape|form|geometry) [of {thing}] is|what (form|geometry) {thing} has|"
    "how {thing} is shaped|what shape (we are touching|we are holding|you are feeling|we have)|"
    f"what {_KIND} of shape (it is|{{thing}} has|you feel|this is)|what shape the contact (is|has)|"
    f"(what|which) shape is (touching|pressing on|on) the {_PAD}|what its (shape|form) is|"
    "what you would call this shape|what {thing} is shaped like|the (shape|form) [of {thing}]"
)
_SHAPE_NOUN = (
    "the [contact] (shape|form|geometry) [of {thing}]|the shape|shape|contact shape|its shape|"
    f"the {_KIND} of shape [of {{thing}}]|the name of the shape|the local (shape|geometry)|"
    "shape of ({thing}|the contact)|(geometry|form) of {thing}|shape class|the shape class|"
    "a word for the shape|object shape|the object's shape|your guess for the shape|the geometric "
    "(shape|form)|"
    "the shape (you feel|under the sensor|on the pad|of the contact|that touches the pad)"
)
_TEXTURE_DIRECT = (
    "what is the feel [of (it|{body}|the surface)]|how (rough|smooth) is it where (we|you) touch it|what does it feel "
    "like where (we|you) touch it|"
    "what (grain|weave|nap|topography|smoothness|tactility|coarseness|microstructure) (is it|has {thing}|do you feel)|"
    "what is the (grain|feel|touch|topography|smoothness|coarseness|surface character|surface quality) "
    "of {body}|how (coarse|bumpy|grainy|even|sleek|slick|uneven|polished|scratchy|ribbed|textured|patterned) "
    "(is {thing}|is the surface|does {thing} feel)|"
    "what is the (texture|surface) [of {thing}] [like]|what texture is it|what texture is {thing}|"
    "what texture does {thing} have|what texture do you feel|which texture is it|"
    "(what|which) (texture|surface|finish) (does {thing} have|has {thing}|has {thing} got|is this|"
    "do you (feel|sense|detect))|how does the (surface|skin|outside|material) [of {body}] feel|"
    "what does the (surface|skin|outside|texture) [of {body}] feel like|how is the (surface|"
    "texture)|"
    f"what {_KIND} of (surface|texture|finish|skin|relief) (is it|is {{thing}}|is this|does "
    f"{{thing}} "
    "have|do you feel|are we touching)|how does {thing} feel|how does {thing} feel to the touch|"
    "what does {thing} feel like (to the touch|on the surface|on the outside)|"
    "how (rough|smooth) is (it|{thing}|the surface|the texture)|"
    "how (rough|smooth) does (it|{thing}|the surface) feel|what is its (texture|surface)|"
    "how would you (describe|classify|characterise|name) the (texture|surface|roughness|relief) "
    "[of {thing}]|what word describes the (texture|surface)|what would you call this texture|"
    "what is the (roughness|relief|surface structure|surface texture|fine structure) [of {thing}]|"
    "what surface (do you feel|are we touching|is on the pad|touches the gel)|"
    "texture-wise , what (is it|do we have|do you feel)|"
    "(can|could|would) you (identify|name|tell|determine|describe) the (texture|surface) [of "
    "{thing}]|"
    f"{_NAME} the (texture|surface|roughness|finish) [of {{thing}}]|what is {_OWNERS} texture|"
    f"{_GUESS} , what texture is (it|{{thing}})|{_GUESS} , how does the surface feel|"
    "do you (know|recognise|feel) (the texture|what texture it is)|what is the (skin|finish|"
    "outside) [of {body}] like|"
    f"(what|which) texture (touches|is touching|is pressing on|is on) the {_PAD}|"
    "what texture are (we|you) (touching|holding|feeling)"
)
_TEXTURE_INDIRECT = (
    "what the (texture|surface|finish|skin) [of {body}] is [like]|what texture {thing} (is|has)|"
    "which texture (you feel|{thing} has|this is)|how the (surface|skin) [of {body}] feels|"
    f"what {_KIND} of (surface|texture|finish) (it is|{{thing}} has|you feel|this is)|"
    "how (rough|smooth) (it|{thing}|the surface) is|what its texture is|how {thing} feels to the "
    "touch|"
    "how the surface is|what texture we are touching|what the surface feels like|"
    "the (texture|surface texture) [of {thing}]"
)
_TEXTURE_NOUN = (
    "the [surface] texture [of {thing}]|the texture|texture|surface texture|its texture|"
    "the (surface|relief|roughness|finish|feel of the surface) [of {body}]|"
    f"the {_KIND} of (surface|texture)|surface|texture of ({{thing}}|the surface)|texture class|"
    "the texture class|a word for the (texture|surface)|surface (type|finish|roughness)|"
    "the texture (you feel|under the sensor|on the pad|of the surface|that you feel)|"
    "the (surface structure|fine structure|skin texture) [of {thing}]|relief"
)
_DEPTH_DIRECT = (
    "without (quoting a number|any number|a figure|figures|any figure) , how deep is ({touch}|{thing}|the dent)|"
    "(in words|in plain words|as a word|not in numbers|without numbers|without a number|"
    "qualitatively|in a category) , how deep is ({touch}|{thing}|the dent)|"
    "how deep is ({touch}|{thing}|the dent) , (in words|in plain words|not in numbers|without "
    "numbers|"
    "qualitatively|as a class)|how deep is it in words|how deep in words|how deep , qualitatively|"
    f"how would you {_RATE} the (depth|indentation|dent|press)|"
    "what would you call (the|this) depth|which [class of] depth is (it|this)|"
    "which depth (class|category|word) (is it|is this|does {touch} have|fits|applies)|"
    "what depth (class|category) (is it|are we in|is this|do we have)|"
    "what word (describes|fits|would you use for) the (depth|dent|indentation)|"
    "(what|which) (class|category) is the (dent|depth|press) [in] , from slight (over|through) moderate and deep to very deep|is it slight, moderate, deep or very deep|which of slight, moderate, deep and very deep is it|"
    "what is the (depth class|class of the depth|depth category)|"
    f"what {_KIND} of depth is (it|this)|what {_KIND} of (dent|indentation) is it|"
    "(describe|classify|rate|judge|categorise|characterise|label|grade) the (depth|indentation|"
    "dent) [in words]|"
    "(can|could|would) you (describe|classify|rate|categorise) the (depth|indentation|dent) [in "
    "words]|"
    "say in words how deep it is|put the depth in words|how does the depth rate|"
    "in which (class|category) is the depth|in which depth (class|category) are we"
)
_DEPTH_INDIRECT = (
    "(in words|in plain words|without numbers) how deep ({touch}|{thing}|the dent) is|"
    "how deep ({touch}|{thing}|the dent) is (in words|without numbers|as a word)|"
    "which depth (class|category) (it is|{touch} has|we are in|this is)|"
    f"how you would {_RATE} the (depth|indentation|dent)|what depth (class|category) it is|"
    "what the depth (class|category) is|what word fits the depth|"
    "whether it is slight, moderate, deep or very deep"
)
_DEPTH_NOUN = (
    "the depth (class|word|category|label) [of {touch}]|"
    "the (class|category) of the (depth|indentation)|"
    "the depth (in words|as a word|as a class|in plain words|without numbers|not in numbers)|"
    "depth (class|category|in words|as a word)|the (indentation|dent) in words|"
    "a word for the (depth|indentation|dent)|the qualitative depth|a rating of the depth|"
    "the depth rating"
)
_AREA_DIRECT = (
    "how (large|big|sizeable|extensive) is (it|the (contact|contact area|footprint|patch|contact patch|touch|imprint)) [,|:] (tiny , small|small) [,|or] medium [, |,] [or] (large|large or "
    "very large)|(without (numbers|a number|quoting a number|any number|quoting any percentage|a percentage|figures)) , how (large|big|"
    "sizeable|extensive) is the (contact|contact area|footprint|patch|touch)|"
    "(in words|in plain words|as a word|not in numbers|without numbers|without a number|"
    "qualitatively|in a category) , how (large|big) is the (contact|contact area|footprint|patch)|"
    "how (large|big) is the (contact|contact area|footprint|area) , (in words|in plain words|"
    "not in numbers|without numbers|qualitatively|as a class)|how large is the area in words|"
    f"how would you {_RATE} the ([contact] area|footprint|size of the contact)|"
    "what would you call (the|this) (area|contact area)|which area class is (it|this)|"
    "which (area|size) (class|category) (is it|is this|does {touch} have|fits|applies)|"
    "what area (class|category) (is it|are we in|is this|do we have)|"
    "what word (describes|fits|would you use for) the [contact] area|"
    "is the area tiny, small, medium, large or very large|(what|which) size (class|category) is the (patch|contact|area|footprint) [in] [, from tiny (over|through) small , medium and large to very large|, from tiny to very large]|"
    "which of tiny, small, medium, large and very large is the area|"
    "what is the (area class|class of the area|area category|size class of the contact)|"
    f"what {_KIND} of area is (it|this)|"
    "(describe|classify|rate|judge|categorise|characterise) the ([contact] area|footprint) [in "
    "words]|"
    "(can|could|would) you (describe|classify|rate|categorise) the [contact] area [in words]|"
    "say in words how large the (contact|area) is|put the area in words|how does the area rate|"
    "in which (class|category) is the area|in which area (class|category) are we"
)
_AREA_INDIRECT = (
    "(in words|in plain words|without numbers) how (large|big) the (contact|footprint|area) is|"
    "how (large|big) the (contact|area|footprint) is (in words|without numbers|as a word)|"
    "which area (class|category) (it is|{touch} has|we are in|this is)|"
    f"how you would {_RATE} the [contact] area|what area (class|category) it is|"
    "what the area (class|category) is|what word fits the area|"
    "whether the area is tiny, small, medium, large or very large"
)
_AREA_NOUN = (
    "the size (class|category) [of the (contact|patch|footprint|touch)]|"
    "the area (class|word|category|label) [of {touch}]|"
    "the (class|category) of the [contact] area|the size class of the contact|"
    "the [contact] area (in words|as a word|as a class|in plain words|without numbers|not in "
    "numbers)|"
    "[contact] area (class|category|in words|as a word)|the footprint in words|"
    "a word for the [contact] area|the qualitative area|a rating of the [contact] area|"
    "the area rating"
)
_SPOT = "(part|region|zone|area|section|cell|third)"
_PLACE_DIRECT = (
    "(no coordinates|no numbers|without coordinates|without numbers|in words) [please] [,|:] (what|which) (part|region|corner|area|side) of the "
    "(pad|gel|sensor) is (it|{thing}|the contact) on|"
    "whereabouts [on the (pad|gel|sensor)] (is {thing} touching|does {thing} touch|do we touch)|where on (the pad|the gel|you) is {thing} touching|"
    "whereabouts on the (gel|pad|sensor|skin) [is it|are we]|in (what|which) (quadrant|sector|neighbourhood|district) of "
    f"the {_PAD} (is {{thing}}|is the contact|are we)|which (quadrant|sector) [is it in|are we in]|"
    "where has {thing} (ended up|settled|come to rest|parked|wound up|planted itself)|"
    "pinpoint (it|{thing}|the contact)|where should I look [for the contact]|"
    "which way (is {thing}|are we) off|"
    "where is it|where is the contact|where is ({touch}|{body})|where are we touching|where|"
    "where exactly|where abouts|where about is it|whereabouts is ({thing}|the contact)|"
    "where does {thing} touch [the pad|the gel|the sensor]|where do (we|you) (touch|feel) {thing}|"
    f"where (on|in which part of) the {_PAD} is ({{thing}}|the contact)|"
    f"where (on|along|at) the {_PAD} (are we touching|does {{thing}} (touch|press|sit|lie)|do you "
    f"feel "
    f"{{thing}}|is the touch|is it)|on (what|which) {_SPOT} of the {_PAD} is ({{thing}}|the "
    f"contact)|"
    f"in (what|which) {_SPOT} of the {_PAD} (is {{thing}}|does {{thing}} touch|is the contact|are "
    f"we)|"
    "what is the (position|location|place) [of ({touch}|{body})]|where do you feel (it|something)|"
    f"(what|which) {_SPOT} of the {_PAD} is (touched|pressed|being touched|being pressed|loaded)|"
    f"(what|which) {_SPOT} of the {_PAD} (does {{thing}} (touch|press)|do you feel it on)|"
    "at (which|what) (place|spot|position) is {thing}|in which (cell|corner|third) is {thing}|"
    "(what|which) corner is it in|(what|which) (spot|place|cell) is (it|{thing}) in|"
    "where is the contact (point|spot|patch|located|on the pad)|where is the contact (happening|"
    "made)|"
    "where (is|was) {thing} (pressing|touching|located|positioned|placed|sitting|resting)|"
    "where did {thing} (land|touch|come down) [on the (pad|gel|sensor)]|where does {thing} (sit|"
    "lie|press)|"
    "how is {thing} (positioned|placed|located) [on the (pad|gel|sensor)]|where have we got it|"
    "where on you is {thing}|where are you (touched|being touched|pressed|feeling it)|"
    f"{_GUESS} , where is (it|{{thing}}|the contact)|{_NAME} the (position|location) [of "
    f"{{thing}}]|"
    f"what is {_OWNERS} (position|location)|"
    "(locate|localise) (it|{thing}|the contact|the touch) [for me|on the pad]|"
    "(can|could) you (locate|localise) (it|{thing}|the contact|the touch) [for me]|"
    "what (position|location|place|spot) (is it|is {thing} at|is {thing} in|do you feel|does it "
    "have)|"
    "where would you say (it|the contact) is|where is the (pressure|press|imprint|dent|footprint)|"
    "how would you describe the (position|location|place) [of {thing}]|where is it pressing|"
    "describe (the position|the location|where it is|where the contact is) [on the pad]|"
    "in words , where is (it|the contact)"
)
_PLACE_INDIRECT = (
    "where ({touch}|{body}) is|where it is|where {thing} touches [the pad|the gel|the sensor]|"
    "where you feel (it|{thing})|where on the (pad|gel|sensor|finger|fingertip) "
    "(it is|{thing} is|the contact is|we are touching)|where we are touching|where we touch "
    "{thing}|"
    f"in which {_SPOT} of the {_PAD} (it is|{{thing}} is|the contact is|we are)|"
    "what the (position|location|place) [of {thing}] is|where the contact (point|spot|patch) is|"
    f"which {_SPOT} of the {_PAD} is (touched|pressed|in use)|where {{thing}} is "
    "(pressing|touching|located|sitting|positioned)|where {thing} (landed|sits|lies|presses)|"
    "where abouts it is|whereabouts {thing} is|where exactly (it|{thing}|the contact) is|"
    "where the (pressure|press|dent|imprint) is|which corner it is in|at which spot {thing} is"
)
_PLACE_NOUN = (
    "the (position|place|location|whereabouts) [of ({touch}|{body})]|the [contact] position|"
    "position|location|contact (position|location|place|spot)|the contact (location|place|spot)|"
    "(position|location) of ({thing}|the contact)|the part of the pad that is touched|"
    f"the {_SPOT} of the {_PAD} that is (touched|pressed)|the (spot|place) that is touched|"
    "the spot where {thing} touches|its (position|location)|the position class|position class|"
    "the position (in words|as a word|on the pad|on the gel|on the sensor)|position on the pad"
)

FAMILIES: tuple[QuestionFamily, ...] = (
    _open("shape", "shape", _SHAPE_DIRECT, _SHAPE_INDIRECT, _SHAPE_NOUN),
    _open("texture", "texture", _TEXTURE_DIRECT, _TEXTURE_INDIRECT, _TEXTURE_NOUN),
    _open("depth_word", "depth", _DEPTH_DIRECT, _DEPTH_INDIRECT, _DEPTH_NOUN),
    _open("area_word", "area", _AREA_DIRECT, _AREA_INDIRECT, _AREA_NOUN),
    _open("position", "position", _PLACE_DIRECT, _PLACE_INDIRECT, _PLACE_NOUN),
    *checked.FAMILIES,
    *offered.FAMILIES,
)
