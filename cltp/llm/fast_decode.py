"""Greedy decoding of a small Qwen2 without the overhead of a general library.

Same weights and same numbers as transformers' ``Qwen2ForCausalLM`` (tested), a batch of one, a
cache of keys and values that is allocated once, matrices that share an input joined into one. At
a few million parameters a token costs little arithmetic: the number of calls decides. A pass over
many tokens is arithmetic; where asked to, it takes its products of matrices in bfloat16, in half
the time on a processor with instructions for it. Norms, attention, sums and the cache keep 32 bits.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

import torch
import torch.nn.functional as F
from torch import Tensor

LEAST_REDUCED = 16
"""Tokens of a pass from which its products are faster in bfloat16. Source: measured on a Zen 4, at
widths of 192 to 1024; of 20 tokens they take 0.9, of 64 tokens 0.6 of the time in 32 bits."""


_MOST_ROWS = 512
"""Choices whose rows of the output matrix are kept: 1 MB for ten tokens each."""


class _Layer(NamedTuple):
    norm1: Tensor
    qkv: Tensor
    qkv_bias: Tensor
    out: Tensor
    norm2: Tensor
    gate_up: Tensor
    down: Tensor


class FastDecoder:
    """Runs a Qwen2 by one or more tokens at a time, and goes back where they were wrong.

    Args:
        lm: A ``Qwen2ForCausalLM`` or a ``cltp.llm.stored_lm.StoredLm``. Its weights are copied, so
            that it needs a new decoder after further training.
        longest: Number of positions that the cache holds.
        reduces: Whether long passes may take their products in bfloat16, where asked to.
    """

    def __init__(self, lm: Any, longest: int = 512, *, reduces: bool = False) -> None:
        config = lm.config
        self._eps = float(config.rms_norm_eps)
        self._heads = int(config.num_attention_heads)
        self._kv_heads = int(config.num_key_value_heads)
        self._size = int(
            getattr(config, "head_dim", None) or config.hidden_size // config.num_attention_heads
        )
        self._layers = [_joined(layer) for layer in lm.model.layers]
        self._reduced = [_in_bfloat16(layer) for layer in self._layers] if reduces else []
        self.is_reduced = False
        self._norm = lm.model.norm.weight.detach().clone()
        self._embedding = lm.get_input_embeddings().weight.detach().clone()
        self._head = lm.get_output_embeddings().weight.detach().clone()
        self._rows: dict[tuple[int, ...], Tensor] = {}
        self.longest = longest
        with torch.no_grad():
            positions = torch.arange(longest, device=self._norm.device)[None]
            cos, sin = lm.model.rotary_emb(self._embedding[:1, None], positions)
        self._cos, self._sin = cos[0].float(), sin[0].float()
        half = self._size // 2
        self._sin[:, :half] *= -1  # rotation by halves: (-x2, x1) becomes one multiplication
        shape = (len(self._layers), 1, self._kv_heads, longest, self._size)
        self._keys, self._values = self._norm.new_zeros(shape), self._norm.new_zeros(shape)
        self._causal = torch.ones(
            longest, longest, dtype=torch.bool, device=self._norm.device
        ).tril()
        self._length = 0

    @property
    def reduces(self) -> bool:
        """Whether long passes may take their products in bfloat16."""
        return bool(self._reduced)

    @torch.no_grad()
    def prefill(self, embeddings: Tensor) -> Tensor:
        """Begin with inputs (T, D); return the logits of what follows, shape (V,)."""
        return self.logits(self.begin(embeddings)[0])

    @torch.no_grad()
    def begin(
        self, embeddings: Tensor, tokens: Sequence[int] = (), *, reduced: bool = False
    ) -> Tensor:
        """Begin with inputs (T, D) and tokens after them, in one pass.

        Args:
            embeddings: The inputs.
            tokens: What follows them.
            reduced: Whether this pass and those after it may take their products in bfloat16;
                ``is_reduced`` then tells whether they do.

        Returns:
            States behind the inputs, and behind each of the tokens: shape (1 + tokens, D).
        """
        self._length, self.is_reduced = 0, reduced and self.reduces
        return self._advance(
            torch.cat([embeddings, self._embedding[list(tokens)]]), len(tokens) + 1
        )

    @torch.no_grad()
    def step(self, token: int) -> Tensor:
        """Append a token; return the logits of what follows, shape (V,)."""
        return self.logits(self._advance(self._embedding[token : token + 1], 1)[0])

    @torch.no_grad()
    def advance(self, tokens: Sequence[int]) -> Tensor:
        """Append one or more tokens in one pass; the state behind each, shape (tokens, D)."""
        return self._advance(self._embedding[list(tokens)], len(tokens))

    @torch.no_grad()
    def logits(self, states: Tensor) -> Tensor:
        """Logits of what follows states (..., D): shape (..., V)."""
        return F.linear(states, self._head)

    @torch.no_grad()
    def scores(self, state: Tensor, tokens: Sequence[int]) -> list[float]:
        """Logits of some tokens behind a state (D,): the others cost nothing."""
        logits: list[float] = (self._rows_of(tuple(tokens)) @ state).float().tolist()
        return logits

    def _rows_of(self, tokens: tuple[int, ...]) -> Tensor:
        """Rows of the output matrix; the same few choices come again in every reply."""
        if (rows := self._rows.get(tokens)) is None:
            if len(self._rows) == _MOST_ROWS:
                self._rows.clear()
            rows = self._rows[tokens] = self._head[list(tokens)]
        return rows

    def rewind(self, length: int) -> None:
        """Forget all but the first ``length`` positions.

        Raises:
            ValueError: There are not as many.
        """
        if not 0 <= length <= self._length:
            raise ValueError(f"{self._length} positions can't be rewound to {length}")
        self._length = length

    def _advance(self, x: Tensor, rows: int) -> Tensor:
        """Append inputs (T, D); the states behind the last ``rows`` of them, (rows, D)."""
        count = len(x)
        start, end = self._length, self._length + count
        cos, sin = self._cos[start:end], self._sin[start:end]
        width = (x.shape[1],)
        heads, kv_heads, size = self._heads, self._kv_heads, self._size
        is_reduced = self.is_reduced and count >= LEAST_REDUCED
        product = _reduced_product if is_reduced else F.linear
        for number, layer in enumerate(self._reduced if is_reduced else self._layers):
            normed = F.rms_norm(x, width, layer.norm1, self._eps)
            qkv = product(normed, layer.qkv, layer.qkv_bias)
            qkv = qkv.view(count, heads + 2 * kv_heads, size).transpose(0, 1)
            rotated = qkv[: heads + kv_heads]
            rotated = rotated * cos + rotated.roll(size // 2, -1) * sin
            keys, values = self._keys[number], self._values[number]
            keys[0, :, start:end] = rotated[heads:]
            values[0, :, start:end] = qkv[heads + kv_heads :]
            # Of the last layer the cache needs all keys and values, nobody the other states.
            asked = rows if number + 1 == len(self._layers) else count
            x, first = x[-asked:], end - asked
            mixed = F.scaled_dot_product_attention(
                rotated[None, :heads, -asked:],
                keys[:, :, :end],
                values[:, :, :end],
                attn_mask=self._causal[first:end, :end] if asked > 1 and first > 0 else None,
                is_causal=asked > 1 and first == 0,
                enable_gqa=heads != kv_heads,
            )
            x = x + product(mixed[0].transpose(0, 1).reshape(asked, -1), layer.out)
            normed = F.rms_norm(x, width, layer.norm2, self._eps)
            gate, up = product(normed, layer.gate_up).chunk(2, -1)
            x = x + product(F.silu(gate) * up, layer.down)
        self._length = end
        return F.rms_norm(x, width, self._norm, self._eps)


def _in_bfloat16(layer: _Layer) -> _Layer:
    """A layer whose matrices are in bfloat16; norms and biases stay as they are."""
    matrices = {name: getattr(layer, name).bfloat16() for name in ("qkv", "out", "gate_up", "down")}
    return layer._replace(**matrices)


def _reduced_product(x: Tensor, matrix: Tensor, bias: Tensor | None = None) -> Tensor:
    """Product of rows (T, D) with a matrix in bfloat16, in 32 bits again."""
    product = F.linear(x.bfloat16(), matrix).float()
    return product if bias is None else product + bias


def _joined(layer: Any) -> _Layer:
    attention, mlp = layer.self_attn, layer.mlp
    projections = (attention.q_proj, attention.k_proj, attention.v_proj)
    parts = (
        layer.input_layernorm.weight,
        torch.cat([p.weight for p in projections]),
        torch.cat([p.bias for p in projections]),
        attention.o_proj.weight,
        layer.post_attention_layernorm.weight,
        torch.cat([mlp.gate_proj.weight, mlp.up_proj.weight]),
        mlp.down_proj.weight,
    )
    return _Layer(*(part.detach().clone() for part in parts))


def greedy(
    decoder: FastDecoder,
    embeddings: Tensor,
    *,
    stop: int,
    max_tokens: int,
    watch: Callable[[int, Tensor], None] | None = None,
    prefilled: Callable[[], None] | None = None,
    penalties: Mapping[int, float] | None = None,
) -> list[int]:
    """Tokens that follow some inputs, the most probable one each time.

    Args:
        decoder: Runs the model.
        embeddings: Shape (T, D).
        stop: Token that ends the reply; it is not returned.
        max_tokens: Bound on the number of tokens.
        watch: Called with every chosen token and the logits that it was chosen from.
        prefilled: Called once, after the inputs.
        penalties: Amounts taken from the logits of tokens; an infinite one excludes its token.
    """
    limit = min(max_tokens, decoder.longest - len(embeddings))
    ids: list[int] = []
    logits = decoder.prefill(embeddings)
    if prefilled is not None:
        prefilled()
    while len(ids) < limit:
        for penalised, penalty in (penalties or {}).items():
            logits[penalised] -= penalty
        token = int(logits.argmax())
        if token == stop:
            break
        if watch is not None:
            watch(token, logits)
        ids.append(token)
        logits = decoder.step(token)
    return ids
