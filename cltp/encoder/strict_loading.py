"""Models of transformers from a local directory, read strictly."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import torch

from cltp.errors import TouchError


def load_strictly(
    model_class: Any,
    folder: Path,
    title: str,
    *,
    expected: Callable[[str], bool] = lambda name: True,
    error_class: type[TouchError] = TouchError,
    dtype: torch.dtype = torch.float32,
) -> Any:
    """Read a model with every weight there, of the right shape, and no other.

    Args:
        model_class: A model class of transformers.
        folder: Directory in transformers' layout.
        title: Name of the model in errors.
        expected: Whether a weight in the directory must be one of the model's; others are ignored.
        error_class: Class of the errors.
        dtype: Precision of its weights in memory; 32 bits by default.

    Raises:
        TouchError: Missing, damaged, or weights that don't fit.
    """
    try:
        model, info = model_class.from_pretrained(
            folder, local_files_only=True, output_loading_info=True, dtype=dtype
        )
    except Exception as error:  # transformers raises errors of every kind for a bad configuration
        reason = str(error).splitlines()[0] if str(error) else repr(error)
        raise error_class(f"no {title} could be read from {folder}: {reason}") from error
    wrong = [*info["missing_keys"], *map(str, info["mismatched_keys"])]
    wrong += [name for name in info["unexpected_keys"] if expected(name)]
    if wrong:
        names = ", ".join(sorted(wrong)[:5])
        raise error_class(f"the {title} in {folder} lacks or adds weights: {names}")
    return model
