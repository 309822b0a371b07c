"""Our own small Qwen2, read from its files in milliseconds, for decoding alone.

``cltp.llm.fast_decode`` needs the weights and a few sizes. transformers reads the same numbers
(tested), but its import alone takes seconds, more than everything else before a robot's first
action. Any other checkpoint, and training, go through ``cltp.llm.causal_lm``.

``config.json`` calls the model ``seed_oss``, transformers' other name for the same network: with
its biases on queries, keys and values alone, Seed-OSS is Qwen2, to the bit (tested). Under
``qwen2``, ``AutoTokenizer`` of transformers 5 puts Qwen2's own splitting of texts in the place of
ours, whatever tokenizer_config.json says, and every number becomes other tokens.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass, fields
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import torch
from safetensors import SafetensorError
from safetensors.torch import load_file
from torch import Tensor

from cltp.atomic_write import write_atomically
from cltp.errors import TouchError

_SEED_OSS = {
    "model_type": "seed_oss",
    "hidden_act": "silu",
    "tie_word_embeddings": True,
    "attention_bias": True,
    "attention_out_bias": False,
    "mlp_bias": False,
}
_QWEN2 = {
    "model_type": "qwen2",
    "hidden_act": "silu",
    "tie_word_embeddings": True,
    "use_sliding_window": False,
}
SMALL_LM_SETTINGS = {"seed_oss": _SEED_OSS, "qwen2": _QWEN2}
"""Settings of ``cltp.llm.causal_lm.small_lm`` as ``config.json`` has them, and as it had them
before; another one is no language model of ours."""

_KEPT = (
    "dtype",
    "bos_token_id",
    "eos_token_id",
    "pad_token_id",
    "initializer_range",
    "max_position_embeddings",
    "rope_parameters",
    "transformers_version",
    "use_cache",
)
"""What both names of the model have in common beside the sizes."""


@dataclass(frozen=True, slots=True, kw_only=True)
class StoredConfig:
    """Sizes of a Qwen2, under transformers' names.

    Attributes:
        vocab_size: Number of tokens.
        hidden_size: Width D.
        intermediate_size: Width inside the gated MLP.
        num_hidden_layers: Number of layers.
        num_attention_heads: Number of heads of queries.
        num_key_value_heads: Number of heads of keys and values.
        rms_norm_eps: Epsilon of the norms.
        rope_theta: Base of the rotary frequencies.
    """

    vocab_size: int
    hidden_size: int
    intermediate_size: int
    num_hidden_layers: int
    num_attention_heads: int
    num_key_value_heads: int
    rms_norm_eps: float
    rope_theta: float

    def __post_init__(self) -> None:
        for part in fields(self):
            value = getattr(self, part.name)
            most = 200 if part.name == "num_hidden_layers" else 1_000_000
            whole = part.type == "int"
            if type(value) not in ((int,) if whole else (int, float)) or not 0 < value <= most:
                kind = "whole number" if whole else "number"
                raise ValueError(f"{part.name} must be a {kind} up to {most}, got {value!r:.40}")
        heads, keys = self.num_attention_heads, self.num_key_value_heads
        if self.hidden_size % heads or heads % keys:
            raise ValueError(f"{heads} heads with {keys} of keys don't divide {self.hidden_size}")

    @property
    def head_dim(self) -> int:
        return self.hidden_size // self.num_attention_heads


class StoredLm:
    """Weights and sizes, under the names that ``FastDecoder`` and ``Language`` use.

    Args:
        config: Sizes.
        state: Every weight by transformers' name, in 32 bits.
    """

    def __init__(self, config: StoredConfig, state: Mapping[str, Tensor]) -> None:
        self.config = config
        root = SimpleNamespace()
        for name, value in state.items():  # 'a.b.weight' as attributes
            *path, last = name.split(".")
            node = root
            for part in path:
                node = node.__dict__.setdefault(part, SimpleNamespace())
            setattr(node, last, value)
        self.model = root.model
        layers = vars(root.model.layers)
        self.model.layers = [layers[str(n)] for n in range(config.num_hidden_layers)]
        self.model.rotary_emb = self._rotary

    def get_input_embeddings(self) -> Any:
        """The table (V, D), as ``weight``; output embeddings are the same."""
        return self.model.embed_tokens

    def get_output_embeddings(self) -> Any:
        return self.model.embed_tokens

    def _rotary(self, like: Tensor, positions: Tensor) -> tuple[Tensor, Tensor]:
        """Cosine and sine of positions (1, T), each of shape (1, T, head_dim)."""
        half = torch.arange(0, self.config.head_dim, 2, device=like.device).float()
        frequency = 1.0 / self.config.rope_theta ** (half / self.config.head_dim)
        angle = positions[..., None].float() * frequency
        angles = torch.cat([angle, angle], dim=-1)
        return angles.cos(), angles.sin()


def load_stored_lm(folder: Path) -> StoredLm:
    """Read what ``cltp.checkpoints.tac3d_llm.save_tac3d_llm`` wrote into ``lm``; strict.

    Raises:
        TouchError: Missing, damaged, not ours, or weights that don't fit the sizes.
    """
    config = _config(folder / "config.json")
    try:
        state = load_file(folder / "model.safetensors")
    except (OSError, SafetensorError, ValueError, KeyError) as error:
        raise TouchError(f"no language model could be read from {folder}: {error}") from error
    shapes = _shapes(config)
    wrong = sorted(set(shapes) ^ set(state))
    wrong += [name for name in shapes if name in state and state[name].shape != shapes[name]]
    if wrong:
        raise TouchError(f"language model in {folder}: weights don't fit: {', '.join(wrong[:5])}")
    floats = {name: value.float() for name, value in state.items()}
    broken = [name for name, value in floats.items() if not torch.isfinite(value).all()]
    if broken:
        raise TouchError(f"language model in {folder}: {broken[0]} is not finite; train again")
    return StoredLm(config, floats)


def write_seed_oss_config(folder: Path) -> None:
    """Give our language model in a folder the name under which its tokenizer is left as it is.

    Raises:
        TouchError: The folder holds no language model of ours.
    """
    path = folder / "config.json"
    sizes = _config(path)
    stored = json.loads(path.read_text())
    named = {part.name: getattr(sizes, part.name) for part in fields(StoredConfig)}
    del named["rope_theta"]  # in rope_parameters
    config: dict[str, Any] = {
        "architectures": ["SeedOssForCausalLM"],
        **_SEED_OSS,
        **named,
        "head_dim": sizes.head_dim,
        "attention_dropout": 0.0,
        "residual_dropout": 0.0,
        **{name: stored[name] for name in _KEPT if name in stored},
    }
    write_atomically(path, json.dumps(config, indent=2, sort_keys=True) + "\n")


def _config(path: Path) -> StoredConfig:
    try:
        stored = json.loads(path.read_text())
        expected = SMALL_LM_SETTINGS.get(stored["model_type"], _SEED_OSS)
        other = {k: stored.get(k) for k, v in expected.items() if stored.get(k) != v}
        rope = stored["rope_parameters"]
        if other or rope["rope_type"] != "default":
            raise TouchError(f"{path} describes no language model of ours: {other or rope!r:.200}")
        sizes = {**stored, "rope_theta": rope["rope_theta"]}
        config = StoredConfig(**{part.name: sizes[part.name] for part in fields(StoredConfig)})
        head_dim = stored.get("head_dim", config.head_dim)
        if head_dim != config.head_dim:
            raise ValueError(f"head_dim must be {config.head_dim}, got {head_dim!r:.40}")
        return config
    except (OSError, ValueError, KeyError, TypeError, AttributeError, RecursionError) as error:
        raise TouchError(f"{path} describes no language model: {error!r}") from error


def _shapes(config: StoredConfig) -> dict[str, tuple[int, ...]]:
    dim, inner = config.hidden_size, config.intermediate_size
    query = config.num_attention_heads * config.head_dim
    key = config.num_key_value_heads * config.head_dim
    layer = {
        "input_layernorm.weight": (dim,),
        "post_attention_layernorm.weight": (dim,),
        "self_attn.o_proj.weight": (dim, query),
        "mlp.gate_proj.weight": (inner, dim),
        "mlp.up_proj.weight": (inner, dim),
        "mlp.down_proj.weight": (dim, inner),
    }
    for name, size in (("q", query), ("k", key), ("v", key)):
        layer[f"self_attn.{name}_proj.weight"] = (size, dim)
        layer[f"self_attn.{name}_proj.bias"] = (size,)
    shapes: dict[str, tuple[int, ...]] = {
        "model.embed_tokens.weight": (config.vocab_size, dim),
        "model.norm.weight": (dim,),
    }
    for number in range(config.num_hidden_layers):
        shapes |= {f"model.layers.{number}.{name}": shape for name, shape in layer.items()}
    return shapes
