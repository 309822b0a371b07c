"""Evaluation splits: which contacts of a data set are evaluated, and with which sensor noise.

``contact`` and ``object`` have no noise but the sampling of 1024 points, as the paper's simulated
set; ``physics`` has the whole noise of a calibrated unit. The others show what noise costs by
itself, and further sensors.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

from cltp.data.contact import Split
from cltp.data.dataset import ContactDataset
from cltp.data.sampler import CLEAN, NOISY, Augmentation
from cltp.errors import TouchError
from cltp.tactile.noise_levels import WIDE


@dataclass(frozen=True, slots=True)
class EvaluationSplit:
    """One test set.

    Attributes:
        name: Name in tables.
        split: Split of the data set that the contacts are taken from.
        noise: Sensor noise that is added.
        about: Description for tables.
    """

    name: str
    split: Split
    noise: Augmentation
    about: str

    @property
    def probe_noise(self) -> Augmentation:
        """Noise of the contacts that its probes learn from."""
        return PROBE_NOISE if self.noise.is_noisy else PROBE_CLEAN


_NOISE = "drift, tilt, depth scale ±15 %, fine noise"

EVALUATION_SPLITS = (
    EvaluationSplit(
        "contact", Split.TEST, CLEAN, "unseen contacts of seen objects, no sensor noise"
    ),
    EvaluationSplit("object", Split.OBJECT, CLEAN, "unseen objects, no sensor noise"),
    EvaluationSplit("physics", Split.PHYSICS, NOISY, f"unseen gels; {_NOISE}"),
    EvaluationSplit("contact_noisy", Split.TEST, NOISY, f"contact; {_NOISE}"),
    EvaluationSplit("object_noisy", Split.OBJECT, NOISY, f"object; {_NOISE}"),
    EvaluationSplit("gelstereo", Split.GELSTEREO, NOISY, "a sparse cloud of markers"),
    EvaluationSplit("gelsight", Split.GELSIGHT, NOISY, "GelSight-like hand presses"),
)

LEARNING_NOISE = Augmentation(noise_level=WIDE, clean=0.2, loose=0.05, windows=0.3)
"""Noise of the contacts that methods learn from: drawn from wide ranges, none in a fifth of them.
Some come as 1024 loose points, as clouds in files do, some on smaller pads of other proportions."""

PROBE_NOISE = replace(LEARNING_NOISE, windows=0.0)
PROBE_CLEAN = Augmentation(noise_level=0.0, uncalibrated=0.0)
"""Noise of the contacts that probes learn from, for splits with noise and for those without: a
probe learns under the conditions that it is tested in, as the paper's do."""


def evaluation_splits(data_dir: Path, names: tuple[str, ...] = ()) -> list[EvaluationSplit]:
    """The splits that a data set has contacts for, in the order of ``EVALUATION_SPLITS``.

    Args:
        data_dir: A data set of contacts.
        names: Names of splits; all when empty.

    Raises:
        TouchError: An unknown name, or one that the data has no contacts for.
    """
    stored = set(ContactDataset(data_dir).column("split"))
    available = [split for split in EVALUATION_SPLITS if split.split.value in stored]
    known = [split.name for split in available]
    for name in names:
        if name not in known:
            raise TouchError(f"no contacts in {data_dir} for {name!r}; it has {', '.join(known)}")
    return [split for split in available if not names or split.name in names]
