"""Put a stock Qwen2 or Qwen2.5-VL from disk behind our tactile encoder, and let it speak.

    python examples/12_qwen_from_disk.py [/path/to/Qwen2.5-0.5B]

Without a path, a tiny one with random weights is written to disk first. The projector between the
two is untrained here, so that the text means nothing: nothing is extracted from it, and a run would
hold still.
"""

import sys
from pathlib import Path

import torch
from transformers import PreTrainedTokenizerFast, Qwen2Config, Qwen2ForCausalLM

from cltp import TouchError
from cltp.checkpoints.tac3d_llm import load_encoder
from cltp.llm.causal_lm import load_language
from cltp.llm.generation import Talker
from cltp.llm.tac3d_llm import Projector, Tac3dLlm
from cltp.tactile.encoder_input import encoder_input
from policies.extraction import extract
from sim.grasp.rig import build
from tacgrasp.policy_factory import default_weights


def tiny_qwen(folder: Path) -> Path:
    """A checkpoint of Qwen2's very class and layout, with random weights and few words."""
    from tokenizers import Tokenizer, models, pre_tokenizers, trainers

    tokenizer = Tokenizer(models.BPE())
    tokenizer.pre_tokenizer = pre_tokenizers.ByteLevel(add_prefix_space=False)
    alphabet = pre_tokenizers.ByteLevel.alphabet()
    trainer = trainers.BpeTrainer(
        vocab_size=300, special_tokens=["<eos>"], initial_alphabet=alphabet
    )
    tokenizer.train_from_iterator(["Move the gripper down. The grasp is stable."], trainer)
    PreTrainedTokenizerFast(tokenizer_object=tokenizer, eos_token="<eos>").save_pretrained(folder)
    config = Qwen2Config(
        vocab_size=320, hidden_size=32, intermediate_size=48, num_hidden_layers=2,
        num_attention_heads=2, num_key_value_heads=1,
    )  # fmt: skip
    Qwen2ForCausalLM(config).save_pretrained(folder)
    return folder


torch.manual_seed(0)
torch.set_num_threads(1)
folder = Path(sys.argv[1]) if len(sys.argv) > 1 else tiny_qwen(Path("tiny_qwen"))
try:
    language = load_language(folder)  # strict: every weight there, of the right shape, finite
except TouchError as error:
    sys.exit(str(error))
encoder, heads = load_encoder(default_weights() / "encoder")
model = Tac3dLlm(encoder, heads, Projector(encoder.config.dim, language.dim), language)
print(f"{type(language.lm).__name__} of width {language.dim} behind {model.num_touch} touch tokens")

rig = build("strawberry", 6, start_offset_mm=(0.0, 0.0))
rig.gripper.grip(1.0)
points = encoder_input(rig.sensor.read(), encoder.config.variant.layout)
reply = Talker(model).reply(points, "Say what to do.", max_tokens=24)
print(f"it says: {reply.text!r}")
print(f"read from it: {extract(reply.text).reason}")
