"""What encoders are tried on: a split of the data, and the noise with which it is read.

``contact`` and ``object`` are read as they were simulated, with no noise but that of sampling 1024
points, as the paper's simulated set is; ``physics`` with the whole noise of a calibrated unit. The
others show what noise costs by itself, and further sensors.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from cltp.data.contact import Split
from cltp.data.dataset import ContactDataset
from cltp.data.sampler import CLEAN, NOISY, Augmentation
from cltp.errors import TouchError


@dataclass(frozen=True, slots=True, kw_only=True)
class EvaluationSplit:
    """One test set.

    Attributes:
        name: As tables call it.
        split: Of the data.
        noise: How it is read.
        about: For people.
    """

    name: str
    split: Split
    noise: Augmentation
    about: str


EVALUATION_SPLITS = (
    EvaluationSplit(
        name="contact",
        split=Split.TEST,
        noise=CLEAN,
        about="unseen contacts of seen objects, no sensor noise",
    ),
    EvaluationSplit(
        name="object", split=Split.OBJECT, noise=CLEAN, about="unseen objects, no sensor noise"
    ),
    EvaluationSplit(
        name="physics",
        split=Split.PHYSICS,
        noise=NOISY,
        about="unseen gels; drift, tilt, depth scale ±15 %, fine noise",
    ),
    EvaluationSplit(
        name="contact_noisy",
        split=Split.TEST,
        noise=NOISY,
        about="contact; drift, tilt, depth scale ±15 %, fine noise",
    ),
    EvaluationSplit(
        name="object_noisy",
        split=Split.OBJECT,
        noise=NOISY,
        about="object; drift, tilt, depth scale ±15 %, fine noise",
    ),
    EvaluationSplit(
        name="gelstereo", split=Split.GELSTEREO, noise=NOISY, about="a sparse cloud of markers"
    ),
    EvaluationSplit(
        name="gelsight", split=Split.GELSIGHT, noise=NOISY, about="GelSight-like hand presses"
    ),
)

LEARNING = Augmentation(clean=0.5)
"""How contacts are read where methods learn to be tried: half of them without noise."""


def evaluation_splits(data_dir: Path, names: tuple[str, ...] = ()) -> list[EvaluationSplit]:
    """The trials that a data set has contacts for, in the order of ``EVALUATION_SPLITS``.

    Args:
        data_dir: A data set of contacts.
        names: Only these; all when empty.

    Raises:
        TouchError: An unknown name, or one that the data has no contacts for.
    """
    there = set(ContactDataset(data_dir).column("split"))
    found = [trial for trial in EVALUATION_SPLITS if trial.split.value in there]
    known = [trial.name for trial in found]
    for name in names:
        if name not in known:
            raise TouchError(f"no contacts in {data_dir} for {name!r}; it has {', '.join(known)}")
    return [trial for trial in found if not names or trial.name in names]
