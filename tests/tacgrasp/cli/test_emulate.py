"""Options of an emulator that can't be are one line, before anything starts."""

import pytest

from tacgrasp.__main__ import main


@pytest.mark.parametrize(
    ("option", "value"),
    [
        *[("--rows", value) for value in ("0", "-1", "256", "99999999999")],
        *[("--columns", value) for value in ("0", "1000000")],
        *[("--rate-hz", value) for value in ("0", "-30", "nan", "inf", "1e9")],
        ("--seed", "-1"),
    ],
)
def test_a_taxel_array_that_can_not_be_is_refused(
    option: str, value: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["emulate", "taxels", option, value]) == 2
    error = capsys.readouterr().err
    assert error.startswith("tacgrasp: ")
    assert option in error
    assert error.count("\n") == 1
