"""Two trainings that must not mix are told apart by names and values, not by checksums alone."""

import dataclasses
import json
from typing import Any

from cltp.encoder.encoder import PRESETS
from cltp.evaluation.splits import LEARNING_NOISE
from cltp.train.recipes import CLTP_SCHEDULE, CltpRecipe
from cltp.train.stage import differences

IDENTITY: dict[str, Any] = {
    "data": "0123456789abcdef" * 4,
    "config": PRESETS["grid"].identity,
    "variant": f"{CltpRecipe().identity} True False {LEARNING_NOISE.identity}",
    "recipe": {"tune": "lora", "lora_rank": 16},
    "schedule": str(CLTP_SCHEDULE),
    "seed": 0,
}


def differing(**changed: Any) -> list[str]:
    return differences(json.dumps(IDENTITY), json.dumps({**IDENTITY, **changed}))


def test_the_same_training_differs_in_nothing() -> None:
    assert not differing()


def test_the_values_of_a_schedule_are_named_one_by_one() -> None:
    other = dataclasses.replace(CLTP_SCHEDULE, steps=9, learning_rate=5e-4)
    assert differing(schedule=str(other)) == [
        "learning_rate 0.002 instead of 0.0005",
        "steps 5000 instead of 9",
    ]


def test_sizes_recipes_and_noise_are_named_by_their_fields() -> None:
    sizes = dataclasses.replace(PRESETS["grid"], depth=3, grades=0)
    assert differing(config=sizes.identity) == ["depth 2 instead of 3", "grades 60 instead of none"]
    recipe = dataclasses.replace(CltpRecipe(), texts="caption")
    noise = dataclasses.replace(LEARNING_NOISE, loose=0.5)
    assert differing(variant=f"{recipe.identity} True False {noise.identity}") == [
        "loose 0.05 instead of 0.5",
        "texts mixed instead of caption",
    ]
    assert differing(recipe={"tune": "all", "lora_rank": 16}) == ["tune lora instead of all"]


def test_checksums_and_long_values_are_cut_and_what_is_missing_is_none() -> None:
    assert differing(data="f" * 64) == ["data 01234567 instead of ffffffff"]
    assert differing(start="a" * 64) == ["start none instead of aaaaaaaa"]
    (words,) = differing(classes=["sphere"] * 9)
    assert len(words) < 60
