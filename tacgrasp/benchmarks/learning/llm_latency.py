"""``tacgrasp bench latency --policy llm``: arithmetic floors, and transformers' own decoding.

Floor: the operations of each stage, as torch counts them, over the rate of a matrix product that is
measured in the same run; of the language model those of one pass over prompt and reply. Baseline:
transformers' ``generate`` with its cache, made to say the same tokens. Start: a process of its own,
from launch to the first action.
"""

from __future__ import annotations

import itertools
import re
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any, cast

import numpy as np
import torch
from torch.utils.flop_counter import FlopCounterMode
from transformers.utils.logging import disable_progress_bar

from cltp.llm.causal_lm import load_language
from cltp.llm.fast_decode import FastDecoder
from cltp.llm.generation import Reply, Talker
from cltp.tactile.cloud import TactileCloud
from policies import Observation
from policies.llm.policy import LlmPolicy, SaidStep
from policies.llm.text import step_request
from primitives.contract import Contract
from tacgrasp.base.errors import UsageError
from tacgrasp.benchmarks.figures import times_ms

BASELINE_RUNS = PRECISE_RUNS = 5
START_LIMIT_S = 120.0
PRODUCT_SIZE = 768
"""Edge of the square matrices whose product is the machine's rate; large enough for its best."""

_STEP_LINE = re.compile(r"^\s*\d+\s+\d+\.\d s ")


def language_report(
    policy: LlmPolicy,
    lm_folder: Path,
    clouds: Sequence[TactileCloud],
    contract: Contract,
    stages_ms: Mapping[str, Mapping[str, float]],
) -> dict[str, Any]:
    """Numbers of tokens and passes, floors and baseline.

    Args:
        policy: The policy of the model.
        lm_folder: Folder of the same language model for transformers.
        clouds: The clouds that were timed.
        contract: The contract that they were timed under.
        stages_ms: Measured durations by stage, with ``p50`` [ms].

    Returns:
        ``contacts``, ``same_without_draft``, ``same_in_32_bits``, ``tokens``, ``passes``,
        ``close_calls``, ``precision``, ``tick_ms_in_32_bits``, ``threads``, ``product_gflops``,
        ``floors``, ``with_cache_ms``, ``speedup_cached``.
    """
    terms = contract.terms
    observations = [Observation(cloud=cloud, in_contact=True) for cloud in clouds]
    precise = policy.through(Talker(policy.talker.model, reduces=False))
    said, plain, precisely = (
        [each.say(felt, terms.force_n, terms.limit_n) for felt in observations]
        for each in (policy, policy.through(cast(Talker, _Undrafted(policy.talker))), precise)
    )
    same, same_precisely = (
        sum(a.reply.text == b.reply.text for a, b in zip(said, other, strict=True))
        for other in (plain, precisely)
    )
    in_turn = itertools.cycle(observations)  # as in the loop, where no contact comes twice in a row
    precise_ms = times_ms(
        lambda: precise.decide(next(in_turn), contract), PRECISE_RUNS * len(observations)
    )
    lengths = [each.reply.num_tokens for each in said]
    tokens, rate = int(np.median(lengths)), product_rate()
    request = step_request(terms.force_n, terms.limit_n)
    ours_ms = stages_ms["prefill"]["p50"] + stages_ms["generate"]["p50"]
    spent_ms = {stage: stages_ms[stage]["p50"] for stage in ("encode", "project")}
    spent_ms["prefill"] = ours_ms
    floors = {
        stage: {
            "million_operations": count / 1e6,
            "floor_ms": 1e3 * count / rate,
            "times_floor": spent_ms[stage] * rate / (1e3 * count),
        }
        for stage, count in operations(policy.talker, said[0], request).items()
    }
    cached_ms = with_cache_ms(policy.talker, lm_folder, said[0], request)
    return {
        "contacts": len(said),
        "same_without_draft": same,
        "same_in_32_bits": same_precisely,
        "tokens": {"p50": tokens, "max": max(lengths)},
        "passes": _quantiles([each.reply.passes for each in said]),
        "close_calls": sum(each.reply.close_calls for each in said),
        "precision": "bfloat16" if policy.talker.reduces else "float32",
        "tick_ms_in_32_bits": _quantiles(precise_ms, 99),
        "threads": torch.get_num_threads(),
        "product_gflops": rate / 1e9,
        "floors": floors,
        "with_cache_ms": cached_ms,
        "speedup_cached": cached_ms / ours_ms,
    }


class _Undrafted:
    """A talker that is given no draft."""

    def __init__(self, talker: Talker) -> None:
        self.model, self.layout, self.feel = talker.model, talker.layout, talker.feel
        self._talker = talker

    def reply_to(self, *args: Any, draft: str = "", **options: Any) -> Reply:
        return self._talker.reply_to(*args, **options)


def _quantiles(values: Sequence[float], upper: int = 90) -> dict[str, float]:
    p50, most = np.percentile(values, [50, upper])
    return {"p50": float(p50), f"p{upper}": float(most)}


def operations(talker: Talker, said: SaidStep, request: str) -> dict[str, int]:
    """Number of operations of each stage for one reply; ``prefill`` is all of the language model's.

    Products and convolutions are counted, norms and activations are not, so that the floor is never
    too high.
    """
    model, language = talker.model, talker.model.language
    felt, ids = said.felt, language.encode(said.reply.text)
    points = torch.zeros(1, talker.layout.num_points, 3)
    inputs = torch.cat([felt.touch, language.embed(language.prompt(request))])
    decoder = FastDecoder(language.lm)
    stages: dict[str, Callable[[], object]] = {
        "encode": lambda: model.encoder(points),
        "project": lambda: model.projected(felt.encoded, felt.readings),
        "prefill": lambda: decoder.begin(inputs, ids),
    }
    return {stage: _counted(function) for stage, function in stages.items()}


def _counted(function: Callable[[], object]) -> int:
    with FlopCounterMode(display=False) as counter, torch.no_grad():
        function()
    return int(counter.get_total_flops())


def product_rate(runs: int = 20) -> float:
    """Operations a second of a product of square float32 matrices: the best of ``runs``."""
    a, b = torch.rand(2, PRODUCT_SIZE, PRODUCT_SIZE)
    return 2e3 * PRODUCT_SIZE**3 / min(times_ms(lambda: torch.mm(a, b), runs))


@torch.inference_mode()
def with_cache_ms(talker: Talker, lm_folder: Path, said: SaidStep, request: str) -> float:
    """Duration of transformers' ``generate`` with its cache for the same tokens [ms], the median.

    Greedy, without our grammar: at each token only ours is allowed.
    """
    disable_progress_bar()
    language = load_language(lm_folder)
    ids = language.encode(said.reply.text)
    inputs = torch.cat([said.felt.touch, language.embed(language.prompt(request))])
    times: list[float] = []
    for _ in range(BASELINE_RUNS):
        began = time.perf_counter()
        out = language.lm.generate(
            inputs_embeds=inputs[None],
            attention_mask=torch.ones(1, len(inputs), dtype=torch.long),
            max_new_tokens=len(ids),
            min_new_tokens=len(ids),
            do_sample=False,
            use_cache=True,
            prefix_allowed_tokens_fn=lambda _, before: [ids[min(len(before), len(ids) - 1)]],
        )
        times.append(1e3 * (time.perf_counter() - began))
        assert out[0].tolist() == ids
    return float(np.median(times))


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
