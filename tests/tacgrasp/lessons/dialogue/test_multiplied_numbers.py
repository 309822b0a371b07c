import pytest

from tacgrasp.lessons.dialogue.multiplied_numbers import with_products


@pytest.mark.parametrize(
    ("text", "product"),
    [
        ("Is the force less than twice 0.2 N?", "Is the force less than 0.4 N?"),
        ("more than 5 times the 0.2 N", "more than 1 N"),
        ("half of 0.4 mm", "0.2 mm"),
        ("Is it two times deeper than 0.1 mm?", "Is it deeper than 0.2 mm?"),
        ("Is it three times as deep as 0.1 mm?", "Is it deeper than 0.3 mm?"),
    ],
)
def test_a_multiple_of_a_number_is_its_product(text, product):
    assert with_products(text) == product


@pytest.mark.parametrize(
    "text",
    ["Would twice that be too much?", "Is half of it over 0.4 N?", "half a newton", "three times"],
)
def test_a_multiple_of_what_is_felt_stays(text):
    assert with_products(text) == text
