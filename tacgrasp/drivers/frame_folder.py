"""Recordings in folders: their files in counting order, the name of the background, their end.

Not here: folders of ball presses for a calibration (``tacgrasp.bringup.ball_frames``).
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from pathlib import Path

from cltp.errors import TouchError

BACKGROUND = "background.png"


def list_recorded(
    folder: Path, suffixes: Sequence[str], *, content: str, excluded: Iterable[Path]
) -> list[Path]:
    """Files of a folder with one of the suffixes, in counting order: ball_2 before ball_10.

    Args:
        folder: Folder of the recording.
        suffixes: Suffixes of the files, in lower case.
        content: Noun for the error: 'frames'.
        excluded: Files to leave out, the background for instance.

    Raises:
        TouchError: No such file in the folder.
    """
    left_out = {path.resolve() for path in excluded}
    files = (path for path in folder.iterdir() if path.resolve() not in left_out)
    paths = sorted((path for path in files if path.suffix.lower() in suffixes), key=_counting_key)
    if not paths:
        raise TouchError(f"{folder} holds no {content}; expected {', '.join(suffixes)}")
    return paths


def _counting_key(path: Path) -> list[tuple[int, str]]:
    parts = re.split(r"(\d+)", path.name)
    return [(int(part), "") if part.isdigit() else (-1, part) for part in parts]


def ended_message(name: str, num_played: int) -> str:
    """Error message for a read after the end of a recording."""
    return (
        f"the recording {name} has ended after {num_played} reads; nothing newer can be read: "
        "give a longer one, or repeat it"
    )
