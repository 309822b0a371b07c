"""Files that are whole whenever they are there: written beside, then put in place."""

from __future__ import annotations

import os
from pathlib import Path


def write_whole(path: Path, text: str) -> None:
    """Write a text file in UTF-8 in the place of any before; its folder is there.

    Raises:
        OSError: It can't be written; what stood there before still does.
    """
    beside = path.with_name(f"{path.name}.{os.getpid()}.part")
    beside.write_text(text, encoding="utf-8")
    beside.replace(path)
