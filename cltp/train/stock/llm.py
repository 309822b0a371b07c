"""Stages 'projector' and 'joint' of a Tac3D-LLM behind a language model that others made.

projector: the language model is frozen; the MLP learns by captioning (paper, section 5.3).
joint: projector and adapters, or projector and the whole language model, learn captions, advice and
    questions, as our own model does (``cltp.train.llm``). It knows language already, so that the
    stage of texts alone is left out.

The base is never changed. What is written names it (``cltp.checkpoints.base_lm``).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path

import torch
from torch import nn

from cltp.checkpoints.base_lm import BaseLm
from cltp.checkpoints.manifest import manifest_digest
from cltp.checkpoints.tac3d_llm import load_encoder, save_stock_llm
from cltp.data.sampler import Augmentation
from cltp.errors import TouchError
from cltp.llm.adapter import require_peft, with_adapter
from cltp.llm.causal_lm import Language, load_language
from cltp.llm.tac3d_llm import Projector, Tac3dLlm
from cltp.train.llm import ExchangeLearner, Lessons, earlier
from cltp.train.recipes import StockRecipe
from cltp.train.stage import Stage, TrainingRun

QUESTIONS_PER_CONTACT = 8
"""Questions in a step of the stage joint for each of its contacts, as our own model has them."""


def load_base(folder: Path, recipe: StockRecipe, precision: str) -> tuple[BaseLm, Language]:
    """Read the language model to train behind, before anything long begins.

    Weights that stay as they are lie in memory in the precision of the matrix products; those that
    are trained, in 32 bits.

    Args:
        folder: Its directory, as transformers' ``save_pretrained`` writes it.
        recipe: What is trained.
        precision: ``no`` (32 bits) or ``bf16``.

    Raises:
        TouchError: It is missing, of another type, without a tokenizer, or one of ours; or peft is
            not installed, which an adapter needs.
    """
    if recipe.tune == "lora":
        require_peft()
    base = BaseLm.of(folder, recipe.tune)
    is_frozen = recipe.tune != "all"
    language = load_language(
        Path(base.path), torch.bfloat16 if precision == "bf16" and is_frozen else torch.float32
    )
    if language.stock is None:
        raise TouchError(
            f"{folder} is a language model of ours; train it on by --start, whose folder has "
            "encoder, projector and lm"
        )
    return base, language


def train_stock_llm(
    run: TrainingRun,
    base: BaseLm,
    language: Language,
    lessons: Lessons,
    recipe: StockRecipe,
    *,
    augmentation: Augmentation | None = None,
) -> Path:
    """Train, or continue training, and write ``projector`` and ``lm`` into ``run.out``.

    Args:
        run: Data, folder with ``encoder`` in it, seed and progress.
        base: The language model, as ``load_base`` gives it.
        language: The same in memory; its weights are changed.
        lessons: The exchanges about contacts.
        recipe: What is trained, how long and how fast.
        augmentation: How contacts are varied.

    Raises:
        TouchError: Data, encoder or a checkpoint can't be used.
    """
    data = run.dataset()
    encoder, heads = load_encoder(run.out / "encoder")
    torch.manual_seed(run.seed)
    projector = Projector(encoder.config.dim, language.dim)
    adapter = None
    if recipe.tune == "lora":
        adapter = with_adapter(language.lm, rank=recipe.lora_rank, alpha=recipe.lora_alpha)
        tuned = [p for p in language.lm.parameters() if p.requires_grad]
    else:  # of a Qwen2.5-VL, the tower that sees pictures stays as it is
        tuned = [p for name, p in language.lm.named_parameters() if ".visual." not in name]
    model = Tac3dLlm(encoder, heads, projector, language).to(run.workers.device)
    if recipe.recompute_activations:
        enable = getattr(language.lm, "activation_checkpointing_enable", None)  # today's name
        (enable or language.lm.gradient_checkpointing_enable)({"use_reentrant": False})
    questions = {"joint": QUESTIONS_PER_CONTACT * run.workers.per_process(recipe.batch_size)}
    learner = ExchangeLearner(run, model, language.tokens, data, lessons, augmentation, questions)
    schedules = {"projector_steps", "tune_steps", "batch_size", "projector_rate", "tune_rate"}
    identity = {
        "data": data.checksum(),
        "encoder": manifest_digest(run.out / "encoder"),
        "base": base.fingerprint,
        "recipe": {k: v for k, v in asdict(recipe).items() if k not in schedules},
        "variant": str(augmentation and augmentation.identity),
    }
    for number, (name, schedule) in enumerate(recipe.stages.items(), start=1):
        learned = _learned(model, tuned if name == "joint" else [])
        language.lm.train()  # without it, transformers keeps activations; there is no dropout
        made_of = identity | earlier(recipe.stages, name)
        learner.train(Stage(name, run, learned, schedule, made_of), number)
    if run.workers.is_first:
        save_stock_llm(run.out, model.cpu().eval(), base, adapter)
    run.workers.wait()
    return run.out


def _learned(model: Tac3dLlm, tuned: Sequence[nn.Parameter]) -> nn.Module:
    """What a stage learns, and its checkpoint holds: never the weights of a frozen base."""
    model.requires_grad_(False)
    return nn.ModuleList([model.projector, nn.ParameterList(tuned)]).requires_grad_(True)
