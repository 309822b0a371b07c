"""Classes of contacts by the nearest prompt in the shared space, without training on labels.

Each class of a dimension has one feature: that of the paper's prompt, or the mean over all wordings
in ``cltp.texts.paraphrases`` (an ensemble).
"""

from __future__ import annotations

import torch
import torch.nn.functional as F
from torch import Tensor

from cltp.encoder.clip_towers import Towers
from cltp.tactile.states import CLASSES
from cltp.texts.paraphrases import prompts

PROMPTINGS = ("single", "ensemble")


class ClassPrompts:
    """Features of the prompts of every class.

    Args:
        towers: The encoders that share the space.
        prompting: ``single``, the paper's prompt, or ``ensemble``.
    """

    def __init__(self, towers: Towers, prompting: str = "single") -> None:
        self._features = []
        for dimension, names in CLASSES.items():
            rows = []
            for name in names:
                wordings = prompts(dimension, name)
                chosen = wordings[:1] if prompting == "single" else wordings
                rows.append(F.normalize(towers.texts(chosen).mean(dim=0), dim=0))
            self._features.append(torch.stack(rows).cpu())

    def cosines(self, feature: Tensor) -> list[Tensor]:
        """Cosines of contacts with aligned features (N, F) and every prompt: (N, classes) each."""
        unit = F.normalize(feature, dim=1)
        return [unit @ rows.T for rows in self._features]
