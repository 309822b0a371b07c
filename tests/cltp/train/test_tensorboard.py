"""Curves for TensorBoard: what is written, from which step, and what is said when it is missing."""

import sys
from pathlib import Path

import pytest

from cltp.errors import TouchError
from cltp.train.tensorboard import TensorBoardReport


class Written:
    def __init__(self, folder: Path, step: int) -> None:
        self.folder, self.first = folder, step
        self.scalars: list[tuple[str, float, int]] = []
        self.closed = False

    def add_scalar(self, name: str, value: float, step: int) -> None:
        self.scalars.append((name, value, step))

    def close(self) -> None:
        self.closed = True


def test_each_stage_has_a_folder_that_goes_on_at_its_step(tmp_path: Path) -> None:
    opened: list[Written] = []

    def writer(folder: Path, step: int) -> Written:
        opened.append(Written(folder, step))
        return opened[-1]

    with TensorBoardReport(tmp_path, writer) as board:
        board("tvl t2l", 30, 100, {"loss": 2.0, "temperature": 0.07})
        board("tvl t2l", 40, 100, {"loss": 1.0})
        board("clip", 10, 10, {"contrast": 3.0})
        assert not opened[0].closed
    assert [(w.folder.name, w.first, w.closed) for w in opened] == [
        ("tvl-t2l", 30, True),
        ("clip", 10, True),
    ]
    assert opened[0].scalars == [("loss", 2.0, 30), ("temperature", 0.07, 30), ("loss", 1.0, 40)]


def test_a_missing_package_is_named_before_anything_is_trained(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delitem(sys.modules, "torch.utils.tensorboard", raising=False)
    monkeypatch.setitem(sys.modules, "tensorboard", None)
    with pytest.raises(TouchError, match=r"pip install 'tacgrasp\[tensorboard\]'"):
        TensorBoardReport(tmp_path)
    assert not list(tmp_path.iterdir())
