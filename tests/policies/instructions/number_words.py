"""Numbers in English words, written independently of the reader."""

_ONES = [
    "zero",
    "one",
    "two",
    "three",
    "four",
    "five",
    "six",
    "seven",
    "eight",
    "nine",
    "ten",
    "eleven",
    "twelve",
    "thirteen",
    "fourteen",
    "fifteen",
    "sixteen",
    "seventeen",
    "eighteen",
    "nineteen",
]
_TENS = "twenty thirty forty fifty sixty seventy eighty ninety".split()  # noqa: SIM905


def in_words(number: int, *, link: str = " and ", dash: str = "-") -> str:
    """A whole number from 0 to 9999 ('one thousand two hundred and five')."""
    if number < 20:
        return _ONES[number]
    if number < 100:
        tens, ones = divmod(number, 10)
        return _TENS[tens - 2] + (dash + _ONES[ones] if ones else "")
    size, word = (1000, "thousand") if number >= 1000 else (100, "hundred")
    count, rest = divmod(number, size)
    head = f"{in_words(count, link=link, dash=dash)} {word}"
    if not rest:
        return head
    between = " " if size == 1000 and rest >= 100 else link
    return head + between + in_words(rest, link=link, dash=dash)


def decimal_in_words(whole: int, digits: str) -> str:
    """A decimal ('two point five')."""
    return f"{in_words(whole)} point {' '.join(_ONES[int(d)] for d in digits)}"
