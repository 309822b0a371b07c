"""What ``bench latency`` says of the language model beside durations: floors and the naive way.

Floors: operations of each stage, counted by formula, over the rate of a matrix product that is
measured in the same run. The naive way: the same model through transformers' ``generate``, with all
positions computed again for every token, and once with its cache. The start: a process of its own,
from nothing to the first decision.
"""

from __future__ import annotations

import re
import subprocess
import sys
import tempfile
import time
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import torch
from transformers.utils.logging import disable_progress_bar

from cltp.llm.causal_lm import Language, load_language
from cltp.llm.flops import (
    encoder_operations,
    generate_operations,
    prefill_operations,
    projector_operations,
)
from cltp.llm.generation import MAX_TOKENS, Talker
from cltp.tactile.cloud import TactileCloud
from cltp.tactile.encoder_input import encoder_input
from tacgrasp.base.errors import UsageError

NAIVE_RUNS = 5
START_LIMIT_S = 120.0
PRODUCT_SIZE = 768
"""Edge of the square matrices whose product is the machine's rate; large enough for its best."""

_TURN = re.compile(r"^\s*\d+\s+\d+\.\d s ")


def language_report(
    talker: Talker,
    lm_folder: Path,
    touches: Sequence[TactileCloud],
    instruction: str,
    stages_ms: Mapping[str, Mapping[str, float]],
) -> dict[str, Any]:
    """Tokens, floors and the naive way.

    Args:
        talker: The model.
        lm_folder: Where transformers reads the same language model from.
        touches: The clouds that were timed.
        instruction: What was asked of them.
        stages_ms: Measured durations by stage, with ``p50`` [ms].

    Returns:
        ``tokens``, ``threads``, ``product_gflops``, ``floors``, ``naive``.
    """
    points = [encoder_input(touch) for touch in touches]
    lengths = [talker.reply(each, instruction).num_tokens for each in points]
    tokens = int(np.median(lengths))
    rate = product_rate()
    floors = {
        stage: {
            "million_operations": count / 1e6,
            "floor_ms": 1e3 * count / rate,
            "times_floor": stages_ms[stage]["p50"] * rate / (1e3 * count),
        }
        for stage, count in operations(talker, instruction, tokens).items()
    }
    model_ms = sum(stages_ms[stage]["p50"] for stage in floors)
    return {
        "tokens": {"p50": tokens, "max": max(lengths)},
        "threads": torch.get_num_threads(),
        "product_gflops": rate / 1e9,
        "floors": floors,
        "naive": naive_ways(talker, lm_folder, points[0], instruction, model_ms),
    }


def operations(talker: Talker, instruction: str, num_tokens: int) -> dict[str, int]:
    """Operations of the model's stages for a prompt and a reply of ``num_tokens``."""
    model = talker.model
    config = model.language.lm.config
    config = getattr(config, "text_config", config)
    before = model.num_touch + len(model.language.prompt(instruction))
    return {
        "encode": encoder_operations(model.encoder),
        "project": projector_operations(model.projector, model.encoder.config.num_groups + 1),
        "prefill": prefill_operations(config, before),
        "generate": generate_operations(config, before, num_tokens),
    }


def product_rate(runs: int = 20) -> float:
    """Operations a second of a product of two square matrices in 32 bits: the best of ``runs``."""
    a, b = torch.rand(2, PRODUCT_SIZE, PRODUCT_SIZE)
    best_s = float("inf")
    for _ in range(runs):
        began = time.perf_counter()
        torch.mm(a, b)
        best_s = min(best_s, time.perf_counter() - began)
    return 2 * PRODUCT_SIZE**3 / best_s


@torch.inference_mode()
def naive_ways(
    talker: Talker, lm_folder: Path, points: np.ndarray, instruction: str, model_ms: float
) -> dict[str, Any]:
    """The model's stages by transformers' own forward, beside ours of ``model_ms`` [ms].

    ``no_cache`` computes all that came before anew for every token, in a loop of ours: given
    embeddings, ``generate`` keeps its cache whatever ``use_cache`` says (transformers 5.23).
    ``with_cache`` is plain ``generate``.

    Returns:
        By way ``ms``, the ``ratio`` to ours, and whether the text is the ``same_text``.
    """
    disable_progress_bar()
    model, language = talker.model, load_language(lm_folder)
    ours = talker.reply(points, instruction).text
    ways: dict[str, Any] = {}
    for name, tokens_after in (("no_cache", _recomputed), ("with_cache", _generated)):
        times, text = [], ""
        for _ in range(NAIVE_RUNS):
            began = time.perf_counter()
            touch = model.touch(torch.from_numpy(points)[None])[0]
            inputs = torch.cat([touch, language.embed(language.prompt(instruction))])
            text = language.decode(tokens_after(language, inputs)).strip()
            times.append(1e3 * (time.perf_counter() - began))
        took = float(np.median(times))
        ways[name] = {"ms": took, "ratio": took / model_ms, "same_text": text == ours}
    return ways


def _recomputed(language: Language, inputs: torch.Tensor) -> list[int]:
    """The likeliest tokens after embeddings (T, D), each from a pass over all before it."""
    ids: list[int] = []
    while len(ids) < MAX_TOKENS:
        token = int(language.lm(inputs_embeds=inputs[None], use_cache=False).logits[0, -1].argmax())
        if token == language.end:
            break
        ids.append(token)
        inputs = torch.cat([inputs, language.embed([token])])
    return ids


def _generated(language: Language, inputs: torch.Tensor) -> list[int]:
    """The same by ``generate``."""
    out = language.lm.generate(
        inputs_embeds=inputs[None],
        attention_mask=torch.ones(1, len(inputs), dtype=torch.long),
        max_new_tokens=MAX_TOKENS,
        do_sample=False,
    )
    return [int(token) for token in out[0] if int(token) != language.end]


def start_to_first_action_s(task: str, weights: Path | None) -> float:
    """Time from starting ``tacgrasp run --policy llm`` to its first printed turn [s].

    A turn is printed when its action has been carried out.

    Raises:
        UsageError: The run ended before, or came to no turn in ``START_LIMIT_S``.
    """
    with tempfile.TemporaryDirectory() as folder:
        command = [sys.executable, "-m", "tacgrasp", "run", "--task", task, "--policy", "llm"]
        command += ["--record", folder, "--seed", "1"]
        command += ["--weights", str(weights)] if weights else []
        began = time.perf_counter()
        run = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        said = ""
        try:
            for line in run.stdout or ():
                took_s = time.perf_counter() - began
                if _TURN.match(line):
                    return took_s
                said = line
                if took_s > START_LIMIT_S:
                    break
        finally:
            run.kill()
            run.wait()
            if run.stdout is not None:
                run.stdout.close()
    raise UsageError(f"`tacgrasp run --policy llm` came to no turn; it said: {said.strip()}")
