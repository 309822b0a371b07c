"""Questions whose wording the grammar has are read by it, and the model is not asked."""

from dataclasses import replace

import pytest

from tacgrasp.lessons.answering import answered
from tacgrasp.lessons.understanding import understood, understood_by_grammar
from tests.fakes.question_scenes import HELD


class Refusing:
    """A model that must not be asked."""

    width = 8

    def reply_to(self, touch, prompt, *, grammar):
        __tracebackhide__ = True  # the repr of a grammar is endless
        raise AssertionError(f"the model was asked {prompt!r}")


@pytest.mark.parametrize(
    ("question", "query"),
    [
        ("What percentage of 2 mm is the depth?", "calculate 100 * depth_mm / 2 in %."),
        ("If the force doubled, would it exceed the limit?", "calculate 2 * force_n > limit_n."),
        (
            "Could another newton be piled on top without going past the cap?",
            "calculate limit_n - force_n >= 1.",
        ),
        (
            "Say 'stop' if the force is past its limit and 'go' if it isn't.",
            "calculate 'stop' if force_n > limit_n else 'go'.",
        ),
        (
            "If it is deeper than 1 mm answer A, otherwise B.",
            "calculate 'A' if depth_mm > 1 else 'B'.",
        ),
        ("Say yes if the depth is over 1 mm, otherwise no.", "calculate depth_mm > 1."),
        (
            "Were another 2 N added, would the limit be breached?",
            "calculate force_n + 2 > limit_n.",
        ),
        (
            "Should the force rise by 1 N, would it pass the limit?",
            "calculate force_n + 1 > limit_n.",
        ),
        (
            "Had we 1 N more, would we be within the band?",
            "calculate band_low_n <= (force_n + 1) <= band_high_n.",
        ),
        ("Would holding 250 g require more than the limit?", "calculate gram_n * 250 > limit_n."),
        (
            "Would a 300 g apple need more than you're allowed to press?",
            "calculate gram_n * 300 > limit_n.",
        ),
        ("Will lifting 50 g take less than the limit?", "calculate gram_n * 50 < limit_n."),
        (
            "Does the imprint belong to either a triangle or a hexagon?",
            "calculate shape == 'triangle' or shape == 'hexagon'.",
        ),
        (
            "Help me settle it - cylinder or cuboid? Say neither should both be wrong.",
            "calculate 'cylinder' if shape == 'cylinder' else 'cuboid' if shape == 'cuboid' "
            "else 'neither'.",
        ),
        (
            "Is that thing hexagonal like a nut, triangular like a tortilla chip, or something "
            "else?",
            "calculate 'hexagonal' if shape == 'hexagon' else 'triangular' if shape == 'triangle' "
            "else 'something else'.",
        ),
        (
            "Is the press slight, moderate, or neither?",
            "calculate 'slight' if depth == 'slight' else 'moderate' if depth == 'moderate' "
            "else 'neither'.",
        ),
        (
            "Requirement R-12 says no indentation beyond 0.6 mm. Do we violate it?",
            "calculate depth_mm > 0.6.",
        ),
        ("I must not exceed 400 mN on tissue. Am I above that?", "calculate force_n > 0.4."),
        (
            "At 75 % of the maximum allowed force I get nervous. Are we there already?",
            "calculate 100 * force_n / limit_n >= 75.",
        ),
        ("force-to-depth ratio in N/mm?", "calculate force_n / depth_mm in N/mm."),
        ("The limit is how many times the present force?", "calculate limit_n / force_n in 1."),
        (
            "Taking 0.4 mm as the dividing line, is the dent above or below that?",
            "calculate 'above' if depth_mm > 0.4 else 'below'.",
        ),
        (
            "And would one more newton take you over the limit they set you?",
            "calculate force_n + 1 > limit_n.",
        ),
        (
            "Crank it up by 20 percent: resulting newtons?",
            "calculate (1 + 20 / 100) * force_n in N.",
        ),
        (
            "State for the record whether the force is over 0.2 N and lower than 2 N.",
            "calculate (force_n > 0.2) and (force_n < 2).",
        ),
        (
            "What margin remains to the top of the band, in newtons?",
            "calculate band_high_n - force_n in N.",
        ),
        ("What does the held item weigh, in newtons?", "calculate 0.00980665 * mass_g in N."),
        (
            "Is it in one of the corners of the pad?",
            "calculate position in ('top-left', 'top-right', 'bottom-left', 'bottom-right').",
        ),
        (
            "Is the contact at the corner?",
            "calculate position in ['top-left', 'top-right', 'bottom-left', 'bottom-right'].",
        ),
        (
            "Which corner of the pad is it closest to?",
            "calculate ('top-left' if y_mm > 0 else 'bottom-left') if x_mm < 0 else "
            "('top-right' if y_mm > 0 else 'bottom-right').",
        ),
        (
            "How many newtons may I add before leaving the band?",
            "calculate band_high_n - force_n in N.",
        ),
        (
            "How far can I loosen before the force drops below the band?",
            "calculate force_n - band_low_n in N.",
        ),
        (
            "Does it stay 2 mm clear of the top edge?",
            "calculate pad_height_mm / 2 - y_mm >= 2.",
        ),
        (
            "What is the depth minus 0.2 mm, and is it 3 mm clear of the left edge?",
            "amount depth - #1 mm; calculate pad_width_mm / 2 + x_mm >= 3.",
        ),
        (
            "Into which range does the force fall: 0-2 N, 2-5 N or over 5 N?",
            "calculate '0-2 N' if 0 <= force_n <= 2 else '2-5 N' if 2 <= force_n <= 5 "
            "else 'over 5 N' if force_n > 5 else 'neither'.",
        ),
        (
            "Is the depth under 0.3 mm, between 0.3 and 0.6 mm, or over 0.6 mm?",
            "calculate 'under 0.3 mm' if depth_mm < 0.3 else 'between 0.3 and 0.6 mm' "
            "if 0.3 <= depth_mm <= 0.6 else 'over 0.6 mm'.",
        ),
        (
            "Is the contact patch between 20 and 60 mm² in size?",
            "calculate min(20, 60) <= area_mm2 <= max(20, 60).",
        ),
        (
            "Is the force nearer to the upper end of the band than to the lower end?",
            "calculate abs(force_n - band_high_n) < abs(force_n - band_low_n).",
        ),
        (
            "Does the force clear the bottom of the band by more than 300 mN?",
            "calculate force_n - band_low_n > 0.3.",
        ),
        (
            "Is neither the band nor the limit exceeded by the present force?",
            "calculate not (force_n > band_high_n) and not (force_n > limit_n).",
        ),
        (
            'With regard to shape, should I log "cylinder" or "other"?',
            "calculate 'cylinder' if shape == 'cylinder' else 'other'.",
        ),
        ("It's a sphere. Am I wrong?", "calculate not (shape == 'sphere')."),
        (
            "At or over the lower bound of the band, is that where the force is?",
            "calculate force_n >= band_low_n.",
        ),
        (
            "Does either of these hold: a force beyond 5 newtons, or a dent beyond 0.9 mm?",
            "calculate (force_n > 5) or (depth_mm > 0.9).",
        ),
        (
            "Does at least one hold: over 8 N, or deeper than 1 mm?",
            "calculate (force_n > 8) or (depth_mm > 1).",
        ),
        (
            "The horizontal coordinate of the contact, in centimetres, right being plus?",
            "calculate x_mm in cm.",
        ),
        (
            "Headroom left under the top of the band, in N?",
            "calculate band_high_n - force_n in N.",
        ),
        (
            "Gravity pulls on the lifted mass with how many newtons?",
            "calculate 0.00980665 * mass_g in N.",
        ),
    ],
)
def test_what_calculates_is_read_with_some_doubt(question, query):
    asked = understood(Refusing(), question)
    assert asked.query == query
    assert 0.8 < asked.confidence < 1


@pytest.mark.parametrize(
    ("question", "query"),
    [
        ("Is the depth above 20 thousandths of an inch?", "check depth > #1 mm."),
        ("Is 'centered' the word you'd use for where it touches?", "check position centered."),
        ("Should I squeeze more?", "check force below."),
        ("y in cm", "amount y cm."),
        ("If I ran a thumb over it, how would it feel?", "word texture."),
        ("Which cell of the three-by-three grid is the contact in?", "word position."),
        ("Which pupil left this on my desk?", "unknown owner."),
        (
            "What's the sideways distance in mm between the patch's middle and the pad's middle, "
            "sign ignored?",
            "amount offset_x mm.",
        ),
        ("Lateral offset x, in micrometres?", "amount x µm."),
        ("How far off sideways in mm, left counted as positive?", "amount leftward mm."),
        ("How many µm is it off vertically, down is positive?", "amount tipward µm."),
        ("Vertical distance from the middle, never mind the sign", "amount offset_y mm."),
        (
            "To be centred, by how many mm must it be moved sideways (positive = to the right)?",
            "amount leftward mm.",
        ),
        ("Is it a strawberry?", "unknown name."),
        ("How warm is it?", "unknown temperature."),
        ("Is it round?", "check shape sphere."),
        ("How heavy a berry could you hold?", "amount holds g."),
        ("Will it bruise?", "check force over."),
        ("Is it slippery?", "unknown trait."),
        ("Should I move left or right?", "choice action."),
        ("Is the object off to one side?", "check not position centered."),
        ("Is something wrong?", "check not force within."),
        ("Do I have to press harder to hold 60 g?", "check slips #1 g."),
        ("Is 0.3 N too little?", "check band_low > #1 N."),
        ("How many newtons do I need to lift it?", "amount band_low N."),
        ("Is there room to squeeze harder?", "check force under."),
        ("How deep is it, in microns?", "amount depth µm."),
        ("Is the force above half a newton?", "check force > #1 N."),
        ("Is the force above half a pound?", "check force > #1 g."),
        ("Hang on, isn't it deeper than 0.3 mm?", "check depth > #1 mm."),
        ("Is it false that we exceed 2 N?", "check not force > #1 N."),
        ("Is it not true that the force is within the band?", "check not force within."),
        ("Isn't it true that the force is within the band?", "check force within."),
        ("Isn't more than 25 % of the pad touched?", "check area > #1 %."),
        ("Is not more than 25 % of the pad touched?", "check area <= #1 %."),
        ("How far left is it?", "amount leftward mm."),
        ("How far down is it?", "amount tipward mm."),
        ("How far up is it?", "amount y mm."),
        ("Is the force over 0.001 kN?", "check force > #1 N."),
        ("force > 5 N ?", "check force > #1 N."),
        ("Is it ≤ 3 mm?", "check depth <= #1 mm."),
        ("|x| in mm?", "amount offset_x mm."),
        ("limit - force", "amount headroom N."),
        ("Would you say it's at the middle-right?", "check position middle-right."),
        ("Is it bottom-center?", "check position bottom-center."),
        ("Is the patch bigger than a square centimetre?", "check area > #1 mm²."),
        ("Shape and depth, in a sentence.", "word shape; amount depth mm."),
        ("Would it be wrong to say that it is not round?", "check shape sphere."),
        ("Does 2 N exceed what you feel?", "check force < #1 N."),
        ("forse and dpeth plz", "amount force N; amount depth mm."),
        ("is ther a contcat", "check touched."),
        ("The stem is thin and I worry. Is it deep?", "check depth deep."),
        ("The contact is left of the middle, is that correct?", "check left."),
        ("Is it either a ring or a crescent?", "check shape ring; check shape crescent."),
        (
            "Three items for the log: shape, texture, force.",
            "word shape; word texture; amount force N.",
        ),
        ("Target window, low and high, go.", "amount band_low N; amount band_high N."),
        ("Force and limit, both figures, nothing else.", "amount force N; amount limit N."),
        (
            "In one sentence, tell me how deep it is and with what force.",
            "amount depth mm; amount force N.",
        ),
        (
            "Is the object on the pad neither a ring nor a disc?",
            "check not shape ring; check not shape disc.",
        ),
        ("Is the dent slight, moderate, deep or very deep?", "choice depth."),
        ("Is it a sphere, a cube or a ring?", "choice shape."),
        ("Is it round and about 0.8 N?", "check shape sphere; check force about #1 N."),
        ("Is it deep, rough and cut off?", "check depth deep; check texture rough; check cut."),
        ("Is it a smooth ball?", "check texture smooth; check shape sphere."),
        ("how far toward the tip is it, negative meaning palm", "amount tipward mm."),
        ("We aren't pushing with more than 5 newtons, are we?", "check force > #1 N."),
        ("Is it exactly 0.3 mm deep?", "check depth about #1 mm."),
        ("Is it deeper than 0.3 and less than 0.4 mm?", "check depth #1 - #2 mm."),
        ("What percentage of the limit are we using?", "amount used %."),
        ("Have we used more than half of the force limit?", "check used > #1 %."),
        ("Is the force above the midpoint of the band?", "check force upper."),
        ("How much force is needed for 60 g?", "amount needed #1 g N."),
        ("What force is needed to hold the given weight?", "amount needed N."),
        ("How big is the contact, in one word?", "choice area in a word."),
        ("How big is the contact, briefly?", "amount area % in a word."),
        ("Contact patch area in mm²?", "amount area mm²."),
        ("Could I trouble you for the depth in microns?", "amount depth µm."),
        (
            "Force, coverage, depth: all three numbers in N, percent, mm.",
            "amount force N; amount area %; amount depth mm.",
        ),
        ("Give me the depth and force in mm and N", "amount depth mm; amount force N."),
        ("How many mm2 of the pad stay untouched?", "amount free_area mm²."),
        ("Is it quite a deep dent?", "check depth deep."),
        (
            "When I shut the hand like this, is the contact in the upper or the lower half?",
            "calculate 'upper' if y_mm > 0 else 'lower'.",
        ),
    ],
)
def test_a_wording_of_the_grammar_means_what_the_grammar_says(question, query):
    read = understood(Refusing(), question)
    assert read.query == query
    assert read.confidence == 1.0


def test_another_wording_is_put_to_the_model():
    with pytest.raises(AssertionError, match="the model was asked 'does it fancy a waltz'"):
        understood(Refusing(), "Does it fancy a waltz?")


@pytest.mark.parametrize(
    ("question", "query"),
    [
        (
            "Is the force about 0.8 N and is it round?",
            "check force about #1 N; check shape sphere.",
        ),
        ("Is it rough, and how deep is it?", "check texture rough; amount depth mm."),
        ("Is it deep? Is it round?", "check depth deep; check shape sphere."),
        ("Is the contact small and shallow?", "check area small; check depth slight."),
        ("Is it above 0.5 N and below 1 N?", "check force > #1 N; check force < #2 N."),
        (
            "How deep is it, how hard is it pressed and what shape is it?",
            "amount depth mm; amount force N; word shape.",
        ),
        (
            "How deep, how hard, where, what shape, what texture?",
            "amount depth mm; amount force N; choice position; word shape; word texture.",
        ),
        ("How deep is it, and how deep is it?", "amount depth mm."),
        ("Is it deep, please?", "check depth deep."),
    ],
)
def test_joined_wordings_are_asked_together(question, query):
    assert understood(Refusing(), question).query == query


@pytest.mark.parametrize(
    "question",
    [
        "Is it red and round?",  # the first is not felt
        "Is it soft and ripe?",
        "How deep is it? And why?",
        "Tell me x and y, is it round, is it deep, is it rough, and is it centered?",  # six
        "How deep is it, " * 12,
        "and",
        ", ",
    ],
)
def test_what_is_joined_with_something_else_is_left_to_the_model(question):
    with pytest.raises(AssertionError, match="the model was asked"):
        understood(Refusing(), question)


@pytest.mark.parametrize(
    ("question", "force_n", "text"),
    [
        ("Is the force about 0.8 N?", 0.83, "Yes, the force is 0.83 N."),
        ("Is it 0.7 N or thereabouts?", 0.83, "No, the force is 0.83 N."),
        ("Are we at about half a newton?", 0.83, "No, the force is 0.83 N."),
    ],
)
def test_about_a_number_is_within_a_tenth_of_it(question, force_n, text):
    assert HELD.state.force_n == force_n
    assert answered(understood(Refusing(), question), HELD).answer.text == text


@pytest.mark.parametrize(
    ("question", "text"),
    [
        ("How much force is needed for 60 g?", "1.23 N."),
        ("What force is needed to hold the given weight?", "0.51 N."),
        ("Is the force above half of the limit?", "Yes, the share of the limit in use is 64 %."),
        (
            "What shape is it, and is it safe to lift?",
            "It is an ellipsoid; I can't say: no force band is given.",
        ),
    ],
)
def test_what_has_no_band_is_said_to_have_none_beside_what_is_felt(question, text):
    bare = question.startswith("What shape")
    scene = replace(HELD, contract=None if bare else HELD.contract)
    assert answered(understood(Refusing(), question), scene).answer.text == text


def test_a_pressure_is_the_force_over_the_area_and_not_put_to_the_model():
    class Silent(Refusing):
        def reply_to(self, touch, prompt, *, grammar):
            __tracebackhide__ = True
            raise AssertionError("a pressure was put to the model")

    read = understood(Silent(), "Is the pressure above 10 kPa?")
    assert read.query == "calculate force_n / area_mm2 > 0.01."


@pytest.mark.parametrize(
    ("question", "text"),
    [
        ("Is it round and smooth?", "No, it is an ellipsoid and the surface is smooth."),
        ("Is it an ellipsoid and smooth?", "Yes, it is an ellipsoid and the surface is smooth."),
        ("Is it a smooth ball?", "No, the surface is smooth and it is an ellipsoid."),
        ("Is it round, and is it smooth?", "No, it is an ellipsoid; yes, the surface is smooth."),
        ("Is it round? Is it smooth?", "No, it is an ellipsoid; yes, the surface is smooth."),
    ],
)
def test_conditions_of_one_clause_get_one_verdict(question, text):
    assert answered(understood(Refusing(), question), HELD).answer.text == text


@pytest.mark.parametrize(
    ("question", "text"),
    [
        ("How much is the force in pounds?", "0.187 lbf."),
        ("Isn't it touching the left edge?", "No, the edge of the pad does not cut it."),
        (
            "How deep is it and does it touch the left edge?",
            "The depth is 0.19 mm; no, the edge of the pad does not cut it.",
        ),
        ("Is it neither rough nor deep?", "Yes, the surface is smooth and the press is slight."),
        ("Neither a cube nor an ellipsoid, right?", "No, it is an ellipsoid."),
        ("Is it not round but smooth?", "Yes, it is an ellipsoid and the surface is smooth."),
        ("Is it rough or deep?", "No, the surface is smooth and the press is slight."),
        (
            "depth > 0.1 mm or force > 1 N?",
            "Yes, the depth is 0.19 mm and the force is 0.83 N.",
        ),
        ("Is it left or right of the middle?", "It is right of the middle."),
        ("A cube or a ring, no?", "Neither: it is an ellipsoid."),
        ("Is it either a sphere or an ellipsoid?", "Yes, it is an ellipsoid."),
        ("Is it both smooth and round?", "No, the surface is smooth and it is an ellipsoid."),
        ("Is the force less than twice 0.2 N?", "No, the force is 0.83 N."),
        ("leftward > 2 mm", "No, x is +0.8 mm."),
        ("Is the offset to the tip at least 1 mm?", "Yes, y is -1.2 mm."),
        ("Force to three decimals.", "0.83 N."),
        ("Is it a square?", "No, it is an ellipsoid."),
        ("Hey, is that a star you are holding?", "No, it is an ellipsoid."),
        ("Not clipped on the left, is it?", "No, the edge of the pad does not cut it."),
        ("Left edge: does it chop the contact off?", "No, the edge of the pad does not cut it."),
        ("Either a star or an ellipsoid, am I right?", "Yes, it is an ellipsoid."),
        ("Over half of the gel remains bare, doesn't it?", "Yes, the contact area is 12 %."),
        ("How deep is it, and is it a star?", "The depth is 0.19 mm; no."),
        (
            "Is it further off sideways or further off up-and-down?",
            "Up-and-down: x is +0.8 mm and y is -1.2 mm.",
        ),
    ],
)
def test_a_rule_reads_what_the_grammar_does_not_compose(question, text):
    assert answered(understood(Refusing(), question), HELD).answer.text == text


@pytest.mark.parametrize("question", ["Is it neither zorby nor deep?", "x in pixels"])
def test_what_no_query_has_is_not_put_to_the_model(question):
    assert understood(Refusing(), question) is None


_NEAREST = "min(pad_width_mm / 2 - abs(x_mm), pad_height_mm / 2 - abs(y_mm))"
_READ = {
    "1,500 mN over limit?": "calculate 1.5 > limit_n.",
    "0.8 N inside band?": "calculate band_low_n <= 0.8 <= band_high_n.",
    "3 N too much?": "check limit < #1 N.",
    "Is 1 N <= force <= 3 N?": "check force #1 - #2 N.",
    "Would it slip if the berry were 3 times heavier?": "calculate force_n < gram_n * 3 * mass_g.",
    "Would it slip if it were 2.5 times the weight?": "calculate force_n < gram_n * 2.5 * mass_g.",
    "Would it slip if it was half as heavy?": "calculate force_n < gram_n * 0.5 * mass_g.",
    "Will it slip if the object is 50% heavier?": (
        "calculate force_n < gram_n * (1 + 50 / 100) * mass_g."
    ),
    "Were it 20 % lighter, would it slip?": (
        "calculate force_n < gram_n * (1 - 20 / 100) * mass_g."
    ),
    "Does it slip at double the mass?": "calculate force_n < gram_n * 2 * mass_g.",
    "If it weighed 4x as much, would it slip?": "calculate force_n < gram_n * 4 * mass_g.",
    "Would it hold ten times the mass?": "calculate force_n >= gram_n * 10 * mass_g.",
    "Is that enough for twice the mass?": "calculate force_n >= gram_n * 2 * mass_g.",
    "If the load triples, do we drop it?": "calculate force_n < gram_n * 3 * mass_g.",
    "If I hang another 80 g on it, will it slip?": "calculate force_n < gram_n * (mass_g + 80).",
    "Will it slip with 10 g more on it?": "calculate force_n < gram_n * (mass_g + 10).",
    "Plus 20 g, does it slip?": "calculate force_n < gram_n * (mass_g + 20).",
    "Can it carry another 0.1 kg?": "calculate force_n >= gram_n * (mass_g + 100).",
    "Will it slip if it gets 80 g heavier?": "calculate force_n < gram_n * (mass_g + 80).",
    "Would adding 100 g make it slip?": "calculate force_n < gram_n * (mass_g + 100).",
    "Would it slip if I added 1 N?": "calculate (force_n + 1) < gram_n * mass_g.",
    "Would it hold five of these?": "calculate force_n >= gram_n * 5 * mass_g.",
    "Can it lift 3 of those?": "calculate force_n >= gram_n * 3 * mass_g.",
    "Would 2 N hold it?": "calculate 2 >= gram_n * mass_g.",
    "Would half the force hold it?": "calculate 0.5 * force_n >= gram_n * mass_g.",
    "What's the minimum force to hold it?": "amount needed N.",
    "What is the smallest grip that still holds it?": "amount needed N.",
    "Is the band wider than 1 N?": "calculate band_high_n - band_low_n > 1.",
    "Is the gap between band and limit more than 1 N?": "calculate limit_n - band_high_n > 1.",
    "Is the force within 10 % of 2.5 N?": "calculate abs(force_n - 2.5) <= 10 / 100 * 2.5.",
    "Is the force 2 N ± 20 %?": "calculate abs(force_n - 2) <= 20 / 100 * 2.",
    "Is the area within 5 % of 20 %?": "calculate abs(area_percent - 20) <= 5.",
    "At 3 N would 200 g slip?": "check needed #2 g > #1 N.",
    "With a limit of 2 N are we over?": "calculate force_n > 2.",
    "Is it deaper then 0.2 mm?": "check depth > #1 mm.",
    "is depht les then 1mm": "check depth < #1 mm.",
    "Is the area about 20 mm²?": "calculate abs(area_mm2 - 20) <= 2.",
    "Is the area approximately 20 square mm?": "calculate abs(area_mm2 - 20) <= 2.",
    "Does it cover about 12 % of the pad?": "calculate abs(area_percent - 12) <= 1.2.",
    "Is x about -2 mm?": "calculate abs(x_mm - -2) <= 0.2.",
    "Is the area not about 20 mm²?": "calculate not (abs(area_mm2 - 20) <= 2).",
    "Is the mean pressure about 60 kPa?": "calculate abs(force_n / area_mm2 - 0.06) <= 0.006.",
    "Is the limit around 4 N?": "calculate abs(limit_n - 4) <= 0.4.",
    "Is the limit 4 N?": "calculate abs(limit_n - 4) <= 0.04.",
    "Is the mass 25 g?": "calculate abs(mass_g - 25) <= 0.25.",
    "Is it about 5 mm off centre?": "calculate abs(hypot(x_mm, y_mm) - 5) <= 0.5.",
    "Is it 4 mm left?": "calculate abs(-1 * x_mm - 4) <= 0.4.",
    "If the force is above 3 N, say STOP.": "calculate 'STOP' if force_n > 3 else 'not so'.",
    "Say stop if the force is above 3 N.": "calculate 'stop' if force_n > 3 else 'not so'.",
    "Reply OK if the force is within the band.": (
        "calculate 'OK' if band_low_n <= force_n <= band_high_n else 'not so'."
    ),
    "Is the safety factor above 2?": "calculate holds_g / mass_g > 2.",
    "What is the size of the pad?": "calculate pad_width_mm * pad_height_mm in mm².",
    "How far is the contact from the nearest border, in mm?": f"calculate {_NEAREST} in mm.",
    "Does the touch keep at least 3 mm from every edge?": f"calculate {_NEAREST} >= 3.",
    "What is the distance to the upper right corner of the pad?": (
        "calculate hypot(pad_width_mm / 2 - x_mm, pad_height_mm / 2 - y_mm) in mm."
    ),
    "With the origin in the bottom left corner, what is y of the contact, in mm?": (
        "calculate pad_height_mm / 2 + y_mm in mm."
    ),
    "Which of the four edges is the contact nearest to?": (
        "calculate ('left' if x_mm < 0 else 'right') if pad_width_mm / 2 - abs(x_mm) < "
        "pad_height_mm / 2 - abs(y_mm) else ('top' if y_mm > 0 else 'bottom')."
    ),
    "Of a pad of 300 mm², how many square millimetres are not touched?": (
        "calculate 300 - area_mm2 in mm²."
    ),
    "What volume in mm³ is the contact area times the depth?": (
        "calculate area_mm2 * depth_mm in mm³."
    ),
    "What is the compliance in µm per newton?": "calculate depth_mm / force_n in µm/N.",
    "How many newtons are there for each millimetre of depth?": (
        "calculate force_n / depth_mm in N/mm."
    ),
    "What is the mean contact pressure in mmHg?": "calculate force_n / area_mm2 in mmHg.",
    "Is the mean pressure (1 bar = 100 kPa) above 0.2 bar?": (
        "calculate force_n / area_mm2 > 0.02."
    ),
    "Does the grip beat the weight of what we lift?": "calculate force_n > 0.00980665 * mass_g.",
    "How many times the weight of the load is the force (g = 9.81 m/s²)?": (
        "calculate force_n / (0.00980665 * mass_g) in 1."
    ),
    "Signed deviation from the middle of the band, N?": (
        "calculate force_n - (band_low_n + band_high_n) / 2 in N."
    ),
    "From here to the top of the band it is how many newtons? (negative = past it)": (
        "calculate band_high_n - force_n in N."
    ),
    "Before the force that must never be passed, is there at least 0.5 N to spare?": (
        "calculate limit_n - force_n >= 0.5."
    ),
    "Is the force closer to the band's ceiling than to its floor?": (
        "calculate abs(force_n - band_high_n) < abs(force_n - band_low_n)."
    ),
    "Set-point 3 N, tolerance ±0.4 N: out of tolerance?": (
        "calculate not (abs(force_n - 3) <= 0.4)."
    ),
    "The drawing asks for 0.5 mm of indentation with 20 % either way. Are we in spec?": (
        "calculate abs(depth_mm - 0.5) <= 0.2 * 0.5."
    ),
    "Pass or fail: the force is at least 2 N.": "calculate 'pass' if force_n >= 2 else 'fail'.",
    "Heads for a depth over 0.5 mm, tails for anything else. Heads or tails?": (
        "calculate 'heads' if depth_mm > 0.5 else 'tails'."
    ),
    "Is it smooth or textured?": "calculate 'smooth' if texture == 'smooth' else 'textured'.",
    "My boss claims it is a sphere. Is he wrong?": "calculate not (shape == 'sphere').",
    "Am I wrong to think that the surface is not bumpy?": "check texture bumpy.",
    "Would I be lying if I said that nothing touches the pad?": "check not empty.",
    "Skip the figures: how deep is it?": "choice depth.",
    "In words rather than numbers, how big is the contact area?": "choice area.",
    "Is texture != smooth?": "check not texture smooth.",
    "What is |x| + |y|?": "calculate abs(x_mm) + abs(y_mm) in mm.",
    "Kilos of force, please": "calculate force_n / 0.00980665 in kg.",
    "What is the friction coefficient between the gel and it?": "unknown friction.",
    "How far does it stick out past the edge of the pad?": "unknown size.",
    "Ball or cylinder, what would you say?": "choice shape.",
    "Convert the mass into a weight in newtons.": "calculate 0.00980665 * mass_g in N.",
    "What are the band's two ends and the limit?": (
        "amount band_low N; amount band_high N; amount limit N."
    ),
    "Is it the lower or the upper end of the band that the force is nearer to?": (
        "calculate 'lower' if abs(force_n - band_low_n) < abs(force_n - band_high_n) else 'upper'."
    ),
    "How far is x from the left border?": "calculate pad_width_mm / 2 + x_mm in mm.",
    "How hard can I squeeze it before it bruises?": "unknown trait.",
    "Is the depth less than 500 microns and more than 300?": (
        "check depth < #1 µm; check depth > #2 µm."
    ),
    "Is it deeper than 300 microns but less than 500?": "check depth #1 - #2 µm.",
    "How much force could I add at most and still be in the band?": (
        "calculate band_high_n - force_n in N."
    ),
    "How far may we tighten, yet remain below the cap?": "calculate limit_n - force_n in N.",
    "How much would be missing to 2 N?": "calculate 2 - force_n in N.",
    "By what factor is the force short of the limit?": "calculate limit_n / force_n in 1.",
    "By which factor does the limit surpass our grip?": "calculate limit_n / force_n in 1.",
    "What part of the limit does the force take?": "calculate 100 * force_n / limit_n in %.",
    "It'll slip at 50 g, won't it?": "check slips #1 g.",
    "Is it impossible that the surface is rough?": "check not texture rough.",
    "Is it out of the question that the force is above 2 N?": "check not force > #1 N.",
    "So, um, is it, you know, safe to lift?": "check force within.",
    "How deep is it, like, in microns?": "amount depth µm.",
    "Is it in one of the corners?": (
        "calculate position in ('top-left', 'top-right', 'bottom-left', 'bottom-right')."
    ),
    "Is the little thing fragile?": "unknown trait.",
}


@pytest.mark.parametrize(("question", "query"), _READ.items())
def test_a_question_is_read_as_it_is_meant(question, query):
    read = understood(Refusing(), question)
    assert read is not None
    assert read.query == query


@pytest.mark.parametrize(
    ("question", "text"),
    [
        ("Is the mean pressure above 40 kPa?", "No, the mean pressure is 22.4 kPa."),
        ("Is it more than 3 mm from every edge?", "Yes, the distance is 6.41 mm."),
        ("True or false: it is a sphere.", "False: it is an ellipsoid."),
        ("If the force is above 3 N, say STOP.", "Not so: the force is 0.83 N."),
        ("If the force is above 0.5 N, say STOP.", "STOP: the force is 0.83 N."),
        ("Would 0.4 N hold it?", "No, it needs 0.51 N."),
        ("Is the area about 20 mm²?", "No, the contact area is 37 mm²."),
        ("Is the pressure about 22 kPa?", "Yes, the mean pressure is 22.4 kPa."),
        ("If it weighed 50 g, would it slip?", "Yes, it needs 1.03 N and the force is 0.83 N."),
        ("Will two 30 g nuts fall?", "Yes, it would need 1.23 N and the force is 0.83 N."),
        ("Is it impossible that it slips?", "Yes, it needs 0.51 N and the force is 0.83 N."),
        ("Would twice the force hold 50 g?", "Yes, the force would be 1.66 N, it needs 1.03 N."),
        ("Is it near a corner?", "No, it is centered."),
    ],
)
def test_what_is_compared_is_told(question, text):
    read = understood(Refusing(), question)
    assert read is not None
    assert answered(read, replace(HELD, mass_g=25.0)).answer.text == text


def test_a_supposed_load_is_told_by_the_force_that_it_needs():
    read = understood(Refusing(), "Would it slip if it were 3 times heavier?")
    given = answered(read, replace(HELD, mass_g=25.0)).answer
    assert given.text == "Yes, it would need 1.54 N and the force is 0.83 N."
    unknown = answered(read, replace(HELD, mass_g=None)).answer
    assert (unknown.decidable, unknown.text) == (False, "I can't say: no mass is given.")


@pytest.mark.parametrize("question", ["May I squeeze with 4 N?", "Can I press with 2 N?"])
def test_what_may_be_done_is_not_asked_of_what_is(question):
    read = understood_by_grammar(question)
    assert read is None or "abs(" not in read.query


@pytest.mark.parametrize(
    ("question", "query"),
    [
        ("What band are you aiming for?", "amount band_low N; amount band_high N."),
        ("What force are you going for?", "amount band_low N; amount band_high N."),
        ("What do you feel, in one word?", "word shape in a word."),
        ("Is it heavier than an egg?", "unknown trait."),
        ("Object present, yes/no", "calculate contact."),
        (
            "Is the gel being pressed at all right now, or are we grabbing thin air?",
            "check touched.",
        ),
        ("Surely it doesn't cover half the pad, does it?", "calculate area_percent >= 50."),
        (
            "A grape bursts at about 5 newtons, they say. Are you pressing harder than that?",
            "check force > #1 N.",
        ),
        (
            "Suppose I asked for one extra newton on top. Would that still be within the cap?",
            "calculate force_n + 1 <= limit_n.",
        ),
        (
            "What's the lowest grip that the current instruction will put up with?",
            "amount band_low N.",
        ),
        ("Think of your fingertip as a grid. Which square's the object in?", "choice position."),
        ("We've only two pieces, a cube and a sphere; which one did you pick up?", "choice shape."),
        (
            "What form it has, its texture, the force in newtons and where it's pressing.",
            "word shape; word texture; amount force N; word position.",
        ),
        ("Can we take it up now without crushing or dropping it?", "check force within."),
        ("Was your last squeeze stronger than this one?", "unknown past."),
        ("Does the thumb on the far side get the same pressure as you?", "unknown elsewhere."),
        ("Is the force not yet at two newtons?", "check force < #1 N."),
        ("Is the contact off-centre, not in the middle zone?", "check not position centered."),
        (
            "Is there any reason, from the band, not to raise the object this instant?",
            "check not force within.",
        ),
        ("Would someone be mistaken to deny that this is a cube?", "check shape cuboid."),
        (
            "Is it impossible to truthfully say you are not below 5 newtons?",
            "calculate not (force_n >= 5).",
        ),
        ("What will I ask you to pick up next?", "unknown future."),
        ("Do you object to lifting?", "check not force within."),
        ("Does the force forbid a lift?", "check not force within."),
        ("Is the grip neither too weak nor too strong for lifting?", "check force within."),
        ("Is the limit intact?", "check force under."),
        ("Does the force need correction?", "check not force within."),
        ("Does the grip need no correction?", "check force within."),
        ("Should the grip stay as it is?", "check force within."),
        ("Is the band kept?", "check force within."),
        ("Cross or star, what d'you reckon?", "choice shape."),
        ("Do you have the cylinder one or the hexagon one?", "choice shape."),
        ("Ring/triangle?", "choice shape."),
        ("Help me decide between bumpy and ridged for this one.", "choice texture."),
        ("What've we got, dots or ridges? Say dotted or ridged.", "choice texture."),
        ("Margin to limit, N?", "amount headroom N."),
        (
            "I suspect under a twentieth of the gel is being used. Is that so?",
            "calculate area_percent < 5.",
        ),
        ("Up to what force does the target range go?", "amount band_high N."),
        (
            "Would one be right to say that the contact fails to cover as much as 12 %?",
            "check area < #1 %.",
        ),
        ("The load cell on the other finger just died. What force do you read?", "amount force N."),
        ("What shape was the object you held before this one?", "unknown past."),
        ("Does the object like being held?", "unknown trait."),
    ],
)
def test_a_question_in_other_words_asks_the_same(question, query):
    assert understood_by_grammar(question).query == query


@pytest.mark.parametrize(
    ("question", "query"),
    [
        (
            "If the limit counts as 100 percent, at how many percent is the force?",
            "amount used %.",
        ),
        (
            "The lid weighs a quarter of a kilo. Is it true that this grip isn't sure to hold it?",
            "calculate holds_g < 250.",
        ),
        (
            "Say 400 mN were added; would that bring the force up to the band's low end or more?",
            "calculate force_n + 0.4 >= band_low_n.",
        ),
        (
            "Say the object pushes in another 200 microns: what's the total depth in mm?",
            "calculate depth_mm + 0.2 in mm.",
        ),
        (
            "Is the whole footprint inside the pad, with none of it cut off at a border?",
            "check whole.",
        ),
        (
            "If the grip is weaker than the band, say by how many newtons; otherwise zero.",
            "calculate max(0, band_low_n - force_n) in N.",
        ),
        ("How much of the pad, as a percentage, is not being touched?", "amount free_area %."),
        ("Confirm or deny: the indentation does not exceed 300 µm.", "check depth <= #1 µm."),
        ("Who made the thing that's touching the pad?", "unknown maker."),
        (
            "Give the distance from the contact to the pad's right-hand edge, in millimetres.",
            "calculate pad_width_mm / 2 - x_mm in mm.",
        ),
        (
            "Give the distance from the contact to the pad's right-hand edge, in microns.",
            "calculate pad_width_mm / 2 - x_mm in µm.",
        ),
        ("One newton: does the squeeze clear that?", "check force > #1 N."),
        ("Is it, in your view, deeper than 0.4 mm?", "check depth > #1 mm."),
        ("Without looking it up, is it safe to lift, or what?", "check force within."),
        (
            "how many millimetres toward the palm does it sit from pad center, negative if it's "
            "toward the fingertip",
            "amount y mm.",
        ),
        ("Does the patch leave the sensor at the right border?", "check cut right."),
        (
            "does the contact go past the left or the right edge, either one",
            "calculate cut_left or cut_right.",
        ),
        (
            "Which offset from the middle is the smaller one, the sideways or the lengthwise?",
            "calculate 'sideways' if abs(x_mm) < abs(y_mm) else 'lengthwise'.",
        ),
        (
            "If it had the heft of half a kilo, could I trust this pinch not to let it slip?",
            "check stays #1 kg.",
        ),
        (
            "More than 0.3 mm but less than 1.0 mm: does the depth fall between those two?",
            "check depth #1 - #2 mm.",
        ),
        ("Does the middle of the contact lie outside the left half of the pad?", "check right."),
        ("Does the imprint straddle the edge on the fingertip side?", "check cut bottom."),
        ("Is the gel lying flush and undented, with nothing leaning on it?", "check empty."),
        (
            "As the crow flies, how many mm is the imprint away from dead centre?",
            "amount distance mm.",
        ),
        (
            "Expressed as a percentage of the band's lower edge, how high is the force?",
            "calculate 100 * force_n / band_low_n in %.",
        ),
        (
            "Take the force away from the top of the band; what is left over, in newtons?",
            "calculate band_high_n - force_n in N.",
        ),
        (
            "Suppose I add half a newton to the force we have: how many newtons would I then have "
            "left up to the limit?",
            "calculate limit_n - (force_n + 0.5) in N.",
        ),
        ("I'd like to know, in µm, how deep the pad is pressed.", "amount depth µm."),
        (
            "How many newtons are left before the limit is reached (zero if none)?",
            "calculate max(0, limit_n - force_n) in N.",
        ),
        ("Suppose that it weighs 200 g: will it slip?", "check slips #1 g."),
        ("A minimum of 3 N is called for; is that reached?", "check force >= #1 N."),
        (
            "Has the force climbed to nine tenths of the limit or beyond?",
            "calculate force_n >= 0.9 * limit_n.",
        ),
        ("On the left, does the imprint go over the edge of the pad?", "check cut left."),
        ("Use words, not coordinates, to say where the touch is.", "choice position."),
        (
            "Should the grip be tightened, loosened or kept?",
            "calculate 'tightened' if force_n < band_low_n else "
            "'loosened' if force_n > band_high_n else 'kept'.",
        ),
        ("Before I sign this off, tell me how deep it is.", "amount depth mm."),
        (
            "Has it gone more than 0.5 mm deep or less than 0.5 mm deep?",
            "calculate 'more' if depth_mm > 0.5 else 'less'.",
        ),
        (
            "How heavy can an object be, in grams, and it will surely not slip out of this grip?",
            "amount holds g.",
        ),
    ],
)
def test_parts_of_a_question_may_stand_elsewhere(question: str, query: str) -> None:
    read = understood_by_grammar(question)
    assert read is not None
    assert read.query == query


@pytest.mark.parametrize(
    ("question", "query"),
    [
        (
            "Criterion 2: at least 25 % of the pad shall be covered. Criterion met?",
            "check area >= #1 %.",
        ),
        (
            "Of the left and right borders, take the one nearer to the contact centre: "
            "what's the distance, in mm?",
            "calculate pad_width_mm / 2 - abs(x_mm) in mm.",
        ),
        (
            "Out of all four borders pick the one farthest from the contact's centre; "
            "how far off is it, in mm?",
            "calculate max(pad_width_mm / 2 + abs(x_mm), pad_height_mm / 2 + abs(y_mm)) in mm.",
        ),
        (
            "If I started at the fingertip-side edge and walked straight up to the "
            "contact centre, how many mm would I cover?",
            "calculate pad_height_mm / 2 + y_mm in mm.",
        ),
        (
            "There's a mark at x = 3 mm, y = -2 mm. How many mm away from it is the "
            "middle of the contact?",
            "calculate hypot(x_mm - 3, y_mm - -2) in mm.",
        ),
        (
            "Add up the horizontal and the vertical displacement from the middle, both "
            "without sign: total in mm?",
            "calculate abs(x_mm) + abs(y_mm) in mm.",
        ),
        ("How many mm² of the surface feel nothing at all?", "amount free_area mm²."),
        (
            "As a number from 0 to 1, which fraction of the pad is being touched?",
            "calculate area_percent / 100 in 1.",
        ),
        (
            "To press this hard by weight alone, how many grams would have to rest on "
            "the pad? Take g = 9.81.",
            "amount force g.",
        ),
        (
            "After adding half a newton to the grip, how many N of margin to the limit "
            "would remain?",
            "calculate limit_n - (force_n + 0.5) in N.",
        ),
        (
            "How much could the grip tighten before leaving the band at its upper end, "
            "in N (negative if already outside above)?",
            "calculate band_high_n - force_n in N.",
        ),
        (
            "Is the left border farther from the contact centre than 9000 µm?",
            "calculate pad_width_mm / 2 + x_mm > 9.",
        ),
        (
            "Contact centre farther from the left edge of the pad than from the right one?",
            "check right.",
        ),
        ("Is the touch neither right of x = 5 mm nor left of x = -5 mm?", "check x #1 - #2 mm."),
        (
            "Light, medium or deep imprint, if light ends at 0.3 mm and deep begins at 0.8 mm?",
            "calculate 'light' if depth_mm < 0.3 else 'deep' if depth_mm > 0.8 else 'medium'.",
        ),
        (
            "Force is weak or strong, if boundary is 2.5 N?",
            "calculate 'strong' if force_n > 2.5 else 'weak'.",
        ),
        (
            "Keep it unless the surface is rough, in which case reject it. Keep or reject?",
            "calculate 'reject' if texture == 'rough' else 'Keep'.",
        ),
        ("Can this grip be trusted with 200 g?", "calculate force_n >= gram_n * 200."),
        (
            "Half a kilogram is beyond what we're sure to hold at the moment, isn't it?",
            "calculate holds_g < 500.",
        ),
        (
            "The crown mustn't sink in more than 1.5 mm. How many mm are left until then?",
            "calculate 1.5 - depth_mm in mm.",
        ),
        (
            "Three pads each feel this same force: how many newtons do they carry together?",
            "amount thrice force N.",
        ),
        (
            "Were the pad a three-by-three grid, the cell with the contact in it would "
            "go by what name?",
            "choice position.",
        ),
        (
            "We had tea, and then the cat walked over the keyboard. What I'd like is "
            "the depth, in millimetres.",
            "amount depth mm.",
        ),
        (
            "Is the limit more or less than the force?",
            "calculate 'more' if limit_n > force_n else 'less'.",
        ),
        ("Are 3 N more or less than the force?", "calculate 'more' if 3 > force_n else 'less'."),
        (
            "Does the untouched part come to more than 260 mm²?",
            "calculate pad_width_mm * pad_height_mm * (100 - area_percent) / 100 > 260.",
        ),
        (
            "Convert the mass you were given into a weight in newtons for me.",
            "calculate 0.00980665 * mass_g in N.",
        ),
        (
            "Which way is it off: is the bigger of the two offsets the horizontal or "
            "the vertical one?",
            "calculate 'horizontal' if abs(x_mm) > abs(y_mm) else 'vertical'.",
        ),
        (
            "Is the bigger of the two offsets, ignoring sign, the horizontal or the vertical one?",
            "calculate 'horizontal' if abs(x_mm) > abs(y_mm) else 'vertical'.",
        ),
        (
            "Is it the case that the force presently exerted is neither less than the "
            "lower bound nor greater than the upper bound of the agreed band?",
            "check force within.",
        ),
        (
            "is my grip gentler or firmer than 3 N?",
            "calculate 'gentler' if force_n < 3 else 'firmer'.",
        ),
        (
            "Pass or fail: force must not exceed 7.5 N.",
            "calculate 'Pass' if force_n <= 7.5 else 'fail'.",
        ),
        (
            "Suppose my own limit were 10 N. Would the current grip violate it?",
            "check force > #1 N.",
        ),
        (
            "Has the force not yet got to half of the limit?",
            "check used < #1 %.",
        ),
        (
            "is the thing I hold nearer to my fingertip than to my palm?",
            "check bottom.",
        ),
        (
            "My target force is 4 N. How many newtons do I need to add, negative if I "
            "should take some off?",
            "calculate 4 - force_n in N.",
        ),
        (
            "The gel tears if pushed in beyond 1.5 mm. Is it safe right now?",
            "check depth <= #1 mm.",
        ),
        (
            "Were the contact to shift 2 mm to the left, what would its x position be in mm?",
            "calculate x_mm - 2 in mm.",
        ),
        (
            "Centred or off-centre? I count anything within 3 mm of the middle as centred.",
            "calculate 'Centred' if hypot(x_mm, y_mm) <= 3 else 'off-centre'.",
        ),
        ("Would 'small' be the wrong word for the contact area?", "check not area small."),
        ("Going by your position word, is it in the center?", "check position centered."),
        ("Correct me if not: that shape is an ellipsoid?", "check shape ellipsoid."),
        ("In cm, what is the y coordinate of the patch?", "amount y cm."),
        (
            "How far sideways from the middle does it sit, ignoring which side, in mm?",
            "amount offset_x mm.",
        ),
        (
            "How many mm toward the fingertip is the contact, negative meaning toward the palm?",
            "calculate -1 * y_mm in mm.",
        ),
        (
            "Squeezed by at least three times its own weight, is it?",
            "calculate force_n >= 0.00980665 * 3 * mass_g.",
        ),
        ("Are x and y both positive?", "check x > #1 mm; check y > #1 mm."),
        (
            "What's larger: the force now, or the room that remains until the limit?",
            "calculate 'the force' if force_n > 0.5 * limit_n else 'the room'.",
        ),
        ("It costs me money if it bruises, so is the force under the limit?", "check force under."),
    ],
)
def test_whole_questions_are_read_in_the_clause_that_others_ask_them_in(
    question: str, query: str
) -> None:
    asked = understood_by_grammar(question)
    assert asked is not None
    assert asked.query == query


@pytest.mark.parametrize(
    ("question", "query"),
    [
        ("What share of the pad is covered?", "amount area %."),
        ("Which part of the pad is being touched?", "choice position."),
        ("We have tea. The limit is 3 N. Is it deep?", None),
        ("Are you within 250 mN of the hard limit, or over it already?", None),
        ("Does the contact lie in the top-left cell of the three-by-three grid?", None),
    ],
)
def test_what_only_looks_like_such_a_question_is_not_taken_for_one(
    question: str, query: str | None
) -> None:
    asked = understood_by_grammar(question)
    assert (None if asked is None else asked.query) == query
