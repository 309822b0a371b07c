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


@pytest.mark.parametrize(
    ("option", "value", "message"),
    [
        ("--object", "unicorn", "no object 'unicorn'; known: strawberry"),
        ("--object-mesh", "nowhere.stl", "nowhere.stl does not exist"),
    ],
)
def test_an_object_that_is_not_there_is_refused_before_an_emulator_starts(
    option: str,
    value: str,
    message: str,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("tacgrasp.cli.emulate.emulate", lambda *_: pytest.fail("it was started"))
    assert main(["emulate", "rig", option, value]) == 2
    error = capsys.readouterr().err
    assert message in error
    assert error.count("\n") == 1
