"""Curves of a training for TensorBoard, beside the CSV file that is always written.

Needs the package ``tensorboard``, which the program itself does not (``pip install
'tacgrasp[tensorboard]'``). The CSV file has every step; these curves have the smoothed scores of
every tenth step, as the progress bar shows them.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from cltp.errors import TouchError


def _stock_writer(folder: Path, step: int) -> Any:
    from torch.utils.tensorboard import SummaryWriter

    # Events of later steps are of a run that was interrupted: they come again.
    return SummaryWriter(str(folder), purge_step=step)


class TensorBoardReport:
    """A ``ProgressReport`` that writes event files, one folder for each stage; a context manager.

    Args:
        folder: Folder of the event files.
        writer: Opens the events of a stage's folder from a step on.

    Raises:
        TouchError: The package is missing.
    """

    def __init__(self, folder: Path, writer: Callable[[Path, int], Any] = _stock_writer) -> None:
        if writer is _stock_writer:
            try:
                import torch.utils.tensorboard  # noqa: F401
            except ImportError as error:
                raise TouchError(
                    f"--tensorboard needs the package tensorboard, which is optional ({error}); "
                    "do `pip install 'tacgrasp[tensorboard]'`, or read the CSV files in .training"
                ) from None
        self._folder, self._open = folder, writer
        self._writers: dict[str, Any] = {}

    def __enter__(self) -> TensorBoardReport:
        return self

    def __exit__(self, *_: object) -> None:
        for writer in self._writers.values():
            writer.close()
        self._writers.clear()

    def __call__(self, stage: str, step: int, steps: int, scores: Mapping[str, float]) -> None:
        if stage not in self._writers:
            self._writers[stage] = self._open(self._folder / stage.replace(" ", "-"), step)
        for name, value in scores.items():
            self._writers[stage].add_scalar(name, value, step)
