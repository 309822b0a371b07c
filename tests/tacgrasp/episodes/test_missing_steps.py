"""Missing steps are named by the numbers of the records that are there."""

import pytest

from tacgrasp.episodes.reader import missing_steps

HEADER = (0, None)


@pytest.mark.parametrize(
    ("records", "expected"),
    [
        ([], ""),
        ([HEADER], ""),
        ([HEADER, (1, 0), (2, 1), (3, None)], ""),
        ([HEADER, (1, 1), (2, 2)], ""),  # step 0 could not be written: it has no record
        ([HEADER, (1, 0), (3, 2)], "step 1 is missing"),
        ([HEADER, (4, 3), (5, 4), (8, None)], "steps 0 to 2 and steps 5 to 6 are missing"),
        ([HEADER, (1, 0), (3, 3)], "1 record before step 3 is missing"),
        (
            [HEADER, *((2 * i, 2 * i - 1) for i in range(1, 9))],
            "step 0, step 2, step 4, step 6, step 8 and others are missing",
        ),
        ([HEADER, (4_000_000_000, 5)], "3999999999 records before step 5 are missing"),
    ],
)
def test_a_gap_in_the_numbers_is_named(
    records: list[tuple[int, int | None]], expected: str
) -> None:
    assert missing_steps(records) == expected
