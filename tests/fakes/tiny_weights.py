"""Weights that were never trained, and a small data set: enough to run every command in seconds."""

from pathlib import Path

import numpy as np
import torch

from cltp.checkpoints.tac3d_llm import save_encoder, save_pretrained, save_tac3d_llm
from cltp.data.contact import Contact, Split
from cltp.data.dataset_writer import DatasetWriter
from cltp.encoder.clip_towers import small_clip
from cltp.encoder.encoder import EncoderConfig, TactileEncoder
from cltp.encoder.heads import StateHeads
from cltp.llm.causal_lm import Language, small_lm
from cltp.llm.tac3d_llm import Projector, Tac3dLlm
from cltp.tactile.sensors import SENSORS
from cltp.tactile.states import ContactState, Shape, Texture, area_word, depth_word, position_word
from cltp.texts.tokenizer import Words

MINI = SENSORS["gelsight_mini"]
ROWS, COLUMNS = 76, 102
TEXTS = [
    "Pick the strawberry gently, without bruising it.",
    "What is the force? How deep is it pressed? Describe the contact.",
    "smooth sphere, deep 0.70 mm, centered x +0.0 y -1.2, large 21 %, 2.10 N. Goal 1.00 - 2.00 N.",
    "a smooth sphere object, pressed deep in centered with large contact area. That is too firm.",
] * 20


def bump(x_mm: float, y_mm: float, depth_mm: float) -> np.ndarray:
    """Heights of a round dent, shape (76, 102) [mm]."""
    x = ((np.arange(COLUMNS) + 0.5) / COLUMNS - 0.5) * MINI.width_mm
    y = (0.5 - (np.arange(ROWS) + 0.5) / ROWS) * MINI.height_mm
    far2 = (x[None, :] - x_mm) ** 2 + (y[:, None] - y_mm) ** 2
    return (depth_mm * np.exp(-far2 / 12)).astype(np.float32)


def state(x_mm: float, y_mm: float, depth_mm: float, force_n: float) -> ContactState:
    """Labels of such a dent."""
    return ContactState(
        depth_mm=depth_mm,
        x_mm=x_mm,
        y_mm=y_mm,
        area_fraction=0.12,
        force_n=force_n,
        depth=depth_word(depth_mm),
        position=position_word(x_mm, y_mm, MINI),
        area=area_word(0.12),
        shape=Shape.SPHERE,
        texture=Texture.SMOOTH,
    )


def make_data(folder: Path, num: int = 60) -> Path:
    """Contacts of the test split with forces from 0.3 to 9 N, every other one off centre."""
    rng = np.random.default_rng(0)
    with DatasetWriter(folder) as writer:
        for number in range(num):
            force_n = float(np.exp(rng.uniform(np.log(0.3), np.log(9))))
            x_mm, y_mm = rng.uniform(-1, 1, 2)
            if number % 2:
                x_mm, y_mm = ((7, 0), (-7, 0), (0, 5), (0, -5))[number // 2 % 4]
            depth_mm = 0.3 + 0.03 * force_n
            writer.add(
                Contact(
                    height_mm=bump(x_mm, y_mm, depth_mm),
                    sensor=MINI,
                    state=state(float(x_mm), float(y_mm), depth_mm, force_n),
                    object="bump",
                    series=number,
                    split=Split.TEST,
                )
            )
    return folder


def make_weights(folder: Path, *, seed: int = 0) -> Path:
    """A whole folder of weights of the tiniest sizes, as the seed left them."""
    torch.manual_seed(seed)
    words = Words.train(TEXTS, size=600)
    encoder = TactileEncoder(EncoderConfig(dim=48, depth=1, heads=2, stem_dim=8, feature_dim=32))
    save_encoder(folder / "encoder", encoder, StateHeads(2 * encoder.config.dim))
    save_pretrained(folder / "clip", small_clip(words, dim=32), words)
    language = Language(small_lm(words, dim=48, layers=1), words=words)
    save_tac3d_llm(
        folder, Tac3dLlm(encoder, StateHeads(2 * encoder.config.dim), Projector(48, 48), language)
    )
    (folder / "README.md").write_text("# Tac3D-LLM, small\n\nfacts\n\n## Scores\n\nold\n")
    return folder
