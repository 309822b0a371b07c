"""The pre-training methods that are compared: one table, in the order of the paper's tables."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class PretrainingMethod:
    """One method.

    Attributes:
        title: Name in tables.
        preset: Name of its usual encoder, out of ``cltp.encoder.encoder.PRESETS``.
        is_aligned: Whether it learns from texts about all dimensions, so that zero-shot prompts
            mean something to it.
        sees_images: Whether its encoder takes rendered frames instead of points.
    """

    title: str
    preset: str = "small"
    is_aligned: bool = False
    sees_images: bool = False


METHODS: Mapping[str, PretrainingMethod] = {
    "point_bert": PretrainingMethod(title="Point-BERT"),
    "point_mae": PretrainingMethod(title="Point-MAE"),
    "cltp_no_image": PretrainingMethod(title="CLTP w/o image", preset="grid", is_aligned=True),
    "cltp": PretrainingMethod(title="CLTP", preset="grid", is_aligned=True),
    "unitouch": PretrainingMethod(title="UniTouch (image)", preset="small_image", sees_images=True),
    "tvl": PretrainingMethod(title="TVL (image)", preset="small_image", sees_images=True),
    "random": PretrainingMethod(title="random encoder"),
}
"""Encoders of 1024 points are ``small`` for all methods; CLTP takes all heights of a grid, and is
evaluated with ``small`` too, so that objectives are compared and not inputs. A step of
``small_pointbert`` takes eight times as long on a CPU."""

ALIGNED_METHODS = tuple(name for name, method in METHODS.items() if method.is_aligned)
IMAGE_METHODS = tuple(name for name, method in METHODS.items() if method.sees_images)

_REVERSED = list(METHODS)[::-1]
TRAINING_ORDER = tuple(
    sorted(_REVERSED, key=lambda name: (not METHODS[name].is_aligned, METHODS[name].sees_images))
)
"""What the paper is about first, images last."""
