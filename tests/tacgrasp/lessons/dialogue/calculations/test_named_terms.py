"""Names of terms, and loads that are not the told one."""

import pytest

from tacgrasp.lessons.dialogue.calculations.calculated import calculated
from tacgrasp.lessons.dialogue.clauses.lists import listed
from tacgrasp.lessons.dialogue.query import query_of

WEIGHT_N = "0.00980665 * mass_g"


@pytest.mark.parametrize(
    ("question", "truth", "unit"),
    [
        ("What is half the pad's width?", "0.5 * pad_width_mm", "mm"),
        ("How long is the pad's diagonal, in cm?", "hypot(pad_width_mm, pad_height_mm)", "cm"),
        ("What is the whole sensitive surface, in cm²?", "pad_width_mm * pad_height_mm", "cm²"),
        ("How hard does gravity tug at the part?", WEIGHT_N, "N"),
        ("The bolt pulls down with how much force, in mN?", None, None),
        ("The part tugs down with how much force, in mN?", WEIGHT_N, "mN"),
        ("The weakest grip we settled on, in kilograms-force?", "band_low_n", "kgf"),
        ("Convert the limit to pounds-force.", "limit_n", "lbf"),
        ("What is the grip in mN rather than N?", "force_n", "mN"),
        ("Our scale shows ounces-force; what would it read for this squeeze?", "force_n", "ozf"),
    ],
)
def test_a_name_of_a_term_stands_for_it(question, truth, unit):
    read = calculated(question)
    assert (read and read.truth, read and read.unit) == (truth, unit)


@pytest.mark.parametrize(
    ("question", "truth"),
    [
        ("Limit divided by the force that 80 g need?", "limit_n / (gram_n * 80)"),
        ("How many times could the band's width fit into the limit?",
         "limit_n / (band_high_n - band_low_n)"),
        ("How many times over is the told mass carried by the sure load?", "holds_g / mass_g"),
        ("Divide the band's top by its bottom.", "band_high_n / band_low_n"),
        ("With the limit as 100 percent, what percentage is the grip?",
         "100 * force_n / limit_n"),
        ("How many 30 g nuts would be held for sure?", "holds_g / 30"),
        ("Is the grip that the object needs below the limit?", "gram_n * mass_g < limit_n"),
        ("Does the part weigh more than 0.7 N?", f"{WEIGHT_N} > 0.7"),
        ("Does the upper end of the band give enough grip for 90 g?",
         "band_high_n >= gram_n * 90"),
        ("Were the part twice as heavy, would it surely be held?",
         "force_n >= gram_n * 2 * mass_g"),
        ("Suppose another such object were glued to it: what force would both need?",
         "gram_n * 2 * mass_g"),
        ("If 15 g of sand were poured into it, would it still surely be held?",
         "force_n >= gram_n * (mass_g + 15)"),
        ("An 80 g plug next: what grip would be needed?", "gram_n * 80"),
        ("A 30 g cap instead; is the grip sure to hold that?", "force_n >= gram_n * 30"),
        ("With another 0.4 N on top of it, what would the force be?", "force_n + 0.4"),
    ],
)  # fmt: skip
def test_a_load_and_a_ratio_are_calculated(question, truth):
    assert calculated(question).truth == truth


@pytest.mark.parametrize(
    ("question", "truth"),
    [
        ("How many mm separate the right rim from the dent's midpoint?", "pad_width_mm / 2 - x_mm"),
        ("Of the pad's four edges, how far is the nearest one from the imprint's middle?", None),
        ("Of the four edges, the nearest one is how far away?",
         "min(pad_width_mm / 2 - abs(x_mm), pad_height_mm / 2 - abs(y_mm))"),
        ("What percentage of the way up the pad is it, from the bottom?",
         "100 * (pad_height_mm / 2 + y_mm) / pad_height_mm"),
        ("How far up from the bottom edge is the print, in mm?", "pad_height_mm / 2 + y_mm"),
        ("Is the print nearer to the right rim or to the top rim?",
         "'right' if pad_width_mm / 2 - x_mm < pad_height_mm / 2 - y_mm else 'top'"),
        ("How broad is the sensing window?", "pad_width_mm"),
        ("Please find the newtons per mm of penetration.", "force_n / depth_mm"),
    ],
)  # fmt: skip
def test_a_place_is_told_from_the_borders(question, truth):
    read = calculated(question)
    assert (read and read.truth) == truth


@pytest.mark.parametrize(
    ("question", "query"),
    [
        ("Pad size: height, width, both in cm.",
         "calculate pad_height_mm in cm; calculate pad_width_mm in cm."),
        ("Depth first, then half of the limit.", "amount depth mm; calculate 0.5 * limit_n in N."),
        ("The agreed mass, and the pad's diagonal?",
         "amount mass g; calculate hypot(pad_width_mm, pad_height_mm) in mm."),
        ("Depth, then whether it is below, within or above the band.",
         "amount depth mm; word force_band."),
        ("Left or right, and then palm side or fingertip side?", "word side_x; word side_y."),
    ],
)  # fmt: skip
def test_a_term_is_one_of_a_list(question, query):
    listing = listed(question, lambda _: None)
    assert listing is not None and query_of(listing) == query
