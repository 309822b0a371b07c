"""Low-rank adapters of a stock language model, by peft (the optional extra 'lora').

Source: Hu et al., LoRA, 2021: W x becomes W x + (alpha / r) B A x, with A of r rows and B zero at
first. Every matrix of the language model's layers has one; those of a vision tower have none, since
no picture is shown.
"""

from __future__ import annotations

import warnings
from pathlib import Path
from typing import Any

import torch
from safetensors import SafetensorError
from safetensors.torch import load_file

from cltp.errors import TouchError

TARGETS = (
    r"model\.(?:language_model\.)?layers\.\d+\.(?:self_attn|mlp)\.(?:q|k|v|o|gate|up|down)_proj"
)
"""The names of the adapted matrices, in Qwen2, Qwen2.5-VL and Qwen3 alike."""

WEIGHTS = "adapter_model.safetensors"
"""peft's file."""


def with_adapter(lm: Any, *, rank: int, alpha: float) -> Any:
    """Add an adapter with random weights to a model, in place; everything else is frozen.

    Args:
        lm: A model of transformers.
        rank: Rank r.
        alpha: Numerator of the scale alpha / r.

    Returns:
        peft's model around it.

    Raises:
        TouchError: peft is not installed.
    """
    peft = _peft()
    config = peft.LoraConfig(
        r=rank, lora_alpha=alpha, lora_dropout=0.0, bias="none", target_modules=TARGETS
    )
    return _wrapped(lm, config)


def merged(lm: Any, folder: Path) -> Any:
    """Read an adapter and add it to the matrices of its model, which is changed in place.

    Raises:
        TouchError: peft is not installed; or the adapter can't be read, does not fit the model
            strictly, or is not finite.
    """
    peft = _peft()
    try:
        config = peft.PeftConfig.from_pretrained(str(folder))
        state = load_file(folder / WEIGHTS)
        model = _wrapped(lm, config)
        result = peft.set_peft_model_state_dict(model, state)
    except (OSError, SafetensorError, ValueError, RuntimeError, KeyError, TypeError) as error:
        reason = str(error).splitlines()[0] if str(error) else repr(error)
        raise TouchError(
            f"the adapter in {folder} can't be read or does not fit the model: {reason}; copy the "
            "whole folder again, or train again"
        ) from error
    wrong = [name for name in result.missing_keys if "lora_" in name] + list(result.unexpected_keys)
    wrong += [name for name, value in state.items() if not torch.isfinite(value).all()]
    if wrong:
        names = ", ".join(sorted(wrong)[:5])
        raise TouchError(f"the adapter in {folder} does not fit the model: {names}; train again")
    return model.merge_and_unload()


def require_peft() -> None:
    """Refuse to go on where peft is missing, before anything long begins.

    Raises:
        TouchError: It is not installed.
    """
    _peft()


def _wrapped(lm: Any, config: Any) -> Any:
    with warnings.catch_warnings():  # peft asks transformers by a name that will be another one
        warnings.simplefilter("ignore", FutureWarning)
        return _peft().get_peft_model(lm, config)


def _peft() -> Any:
    try:
        import peft  # its import takes seconds
    except ImportError:
        raise TouchError(
            "peft is not installed; adapters need it: pip install 'tacgrasp[lora]', or train "
            "without one: --tune all or --tune projector"
        ) from None
    return peft
