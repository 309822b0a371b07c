"""``tacgrasp bench latency --policy llm``: arithmetic floors, and transformers' own decoding.

Floor: the operations of each stage, counted by formula, over the rate of a matrix product that is
measured in the same run. Baselines: the same model through transformers' ``generate``, with its
cache, and with all positions computed anew for each token. Start: a process of its own, from launch
to the first action.
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
from tacgrasp.benchmarks.figures import times_ms

BASELINE_RUNS = 5
START_LIMIT_S = 120.0
PRODUCT_SIZE = 768
"""Edge of the square matrices whose product is the machine's rate; large enough for its best."""

_STEP_LINE = re.compile(r"^\s*\d+\s+\d+\.\d s ")


def language_report(
    talker: Talker,
    lm_folder: Path,
    clouds: Sequence[TactileCloud],
    instruction: str,
    stages_ms: Mapping[str, Mapping[str, float]],
) -> dict[str, Any]:
    """Numbers of tokens, floors and baselines.

    Args:
        talker: The model.
        lm_folder: Folder of the same language model for transformers.
        clouds: The clouds that were timed.
        instruction: The instruction that was given with them.
        stages_ms: Measured durations by stage, with ``p50`` [ms].

    Returns:
        ``tokens``, ``threads``, ``product_gflops``, ``floors``, ``naive``.
    """
    points = [encoder_input(cloud) for cloud in clouds]
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
        "naive": decoding_baselines(talker, lm_folder, points[0], instruction, model_ms),
    }


def operations(talker: Talker, instruction: str, num_tokens: int) -> dict[str, int]:
    """Number of operations of each stage for a prompt and a reply of ``num_tokens``."""
    model = talker.model
    config = model.language.lm.config
    config = getattr(config, "text_config", config)
    num_prompt = model.num_touch + len(model.language.prompt(instruction))
    return {
        "encode": encoder_operations(model.encoder),
        "project": projector_operations(model.projector, model.encoder.config.num_groups + 1),
        "prefill": prefill_operations(config, num_prompt),
        "generate": generate_operations(config, num_prompt, num_tokens),
    }


def product_rate(runs: int = 20) -> float:
    """Operations a second of a product of square float32 matrices: the best of ``runs``."""
    a, b = torch.rand(2, PRODUCT_SIZE, PRODUCT_SIZE)
    return 2e3 * PRODUCT_SIZE**3 / min(times_ms(lambda: torch.mm(a, b), runs))


@torch.inference_mode()
def decoding_baselines(
    talker: Talker, lm_folder: Path, points: np.ndarray, instruction: str, model_ms: float
) -> dict[str, Any]:
    """Durations of transformers' decoding, beside ours of ``model_ms`` [ms].

    ``with_cache`` is plain ``generate``. ``no_cache`` computes all earlier positions anew for each
    token, in a loop of ours, since ``generate`` keeps its cache when it is given embeddings,
    whatever ``use_cache`` says (transformers 5.23).

    Returns:
        By baseline: ``ms``, its ``ratio`` to ours, and whether it gives the ``same_text``.
    """
    disable_progress_bar()
    model, language = talker.model, load_language(lm_folder)
    ours = talker.reply(points, instruction).text
    baselines: dict[str, Any] = {}
    for name, decode in (("no_cache", _recomputed), ("with_cache", _generated)):
        times, text = [], ""
        for _ in range(BASELINE_RUNS):
            began = time.perf_counter()
            touch = model.touch(torch.from_numpy(points)[None])[0]
            inputs = torch.cat([touch, language.embed(language.prompt(instruction))])
            text = language.decode(decode(language, inputs)).strip()
            times.append(1e3 * (time.perf_counter() - began))
        median_ms = float(np.median(times))
        baselines[name] = {
            "ms": median_ms,
            "ratio": median_ms / model_ms,
            "same_text": text == ours,
        }
    return baselines


def _recomputed(language: Language, inputs: torch.Tensor) -> list[int]:
    """Greedy tokens after embeddings (T, D), each from a pass over all positions before it."""
    ids: list[int] = []
    while len(ids) < MAX_TOKENS:
        token = int(language.lm(inputs_embeds=inputs[None], use_cache=False).logits[0, -1].argmax())
        if token == language.end:
            break
        ids.append(token)
        inputs = torch.cat([inputs, language.embed([token])])
    return ids


def _generated(language: Language, inputs: torch.Tensor) -> list[int]:
    """Greedy tokens after embeddings (T, D), by ``generate``."""
    out = language.lm.generate(
        inputs_embeds=inputs[None],
        attention_mask=torch.ones(1, len(inputs), dtype=torch.long),
        max_new_tokens=MAX_TOKENS,
        do_sample=False,
    )
    return [int(token) for token in out[0] if int(token) != language.end]


def start_to_first_action_s(task: str, weights: Path | None) -> float:
    """Time from starting ``tacgrasp run --policy llm`` to its first printed step [s].

    A step is printed when its action has been carried out.

    Raises:
        UsageError: The run printed no step within ``START_LIMIT_S``, or ended before.
    """
    with tempfile.TemporaryDirectory() as folder:
        command = [sys.executable, "-m", "tacgrasp", "run", "--task", task, "--policy", "llm"]
        command += ["--record", folder, "--seed", "1"]
        command += ["--weights", str(weights)] if weights else []
        began = time.perf_counter()
        run = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        last_line = ""
        try:
            for line in run.stdout or ():
                elapsed_s = time.perf_counter() - began
                if _STEP_LINE.match(line):
                    return elapsed_s
                last_line = line
                if elapsed_s > START_LIMIT_S:
                    break
        finally:
            run.kill()
            run.wait()
            if run.stdout is not None:
                run.stdout.close()
    raise UsageError(
        f"`tacgrasp run --policy llm` printed no step; its last line was: {last_line.strip()}"
    )
