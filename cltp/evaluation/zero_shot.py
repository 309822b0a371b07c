"""Classes of contacts by the nearest prompt in the shared space, without training on labels.

Each class of a dimension has one feature: that of the paper's prompt, or the mean over all wordings
in ``cltp.texts.paraphrases`` (an ensemble). Wordings and synonyms that no training uses show how
much depends on the very texts of the training.
"""

from __future__ import annotations

import torch
import torch.nn.functional as F
from torch import Tensor

from cltp.encoder.clip_towers import Towers
from cltp.tactile.states import CLASSES
from cltp.texts.paraphrases import prompts, synonym_prompt, unseen_prompts

PROMPTINGS = ("single", "ensemble", "unseen", "synonyms")


class ClassPrompts:
    """Features of the prompts of every class.

    Args:
        towers: The encoders that share the space.
        prompting: ``single``, the paper's prompt; ``ensemble``; ``unseen``, each of the wordings
            that no training uses by itself; ``synonyms``, the paper's prompt with a synonym.
    """

    def __init__(self, towers: Towers, prompting: str = "single") -> None:
        self._features = []
        for dimension, names in CLASSES.items():
            rows = [_features(towers, dimension, name, prompting) for name in names]
            self._features.append(torch.stack(rows, dim=1).cpu())

    def cosines(self, feature: Tensor) -> list[Tensor]:
        """Cosines of contacts with aligned features (N, F) and every prompt: (N, classes) each.

        Of ``unseen`` each wording's follow on the last one's: (wordings × N, classes).
        """
        unit = F.normalize(feature, dim=1)
        return [(unit @ rows.mT).flatten(0, 1) for rows in self._features]


def _features(towers: Towers, dimension: str, name: str, prompting: str) -> Tensor:
    """Features of a class's prompts, shape (wordings, F)."""
    if prompting == "unseen":
        return F.normalize(towers.texts(unseen_prompts(dimension, name)), dim=1)
    if prompting == "synonyms":
        texts = [synonym_prompt(dimension, name)]
    else:
        texts = prompts(dimension, name)[: 1 if prompting == "single" else None]
    return F.normalize(towers.texts(texts).mean(dim=0, keepdim=True), dim=1)
