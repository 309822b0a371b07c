"""The model card of a folder of weights: ``README.md`` as the Hub reads and shows it.

Front matter, what was given to the training, the parts as they lie in the folder, how they are
read, and the scores. Scores are measured by ``tacgrasp eval``, which writes them in the last
section.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from pathlib import Path

from safetensors import SafetensorError, safe_open

from cltp.atomic_write import write_atomically
from cltp.checkpoints.base_lm import BASE_FILE, BaseLm, is_stock
from cltp.checkpoints.manifest import WeightsError
from cltp.checkpoints.weight_files import CONFIG, read_config

CARD = "README.md"
SCORES = "## Scores"
_PARTS = "## Parts"

PARTS = ("clip", "encoder", "projector", "lm")

FRONT_MATTER = """---
license: mit
library_name: tacgrasp
pipeline_tag: robotics
language:
- en
tags:
- tactile
- robotics
- point-cloud
- clip
- text-generation
metrics:
- accuracy
base_model: []
datasets: []
---
"""
"""What the Hub sorts models by. No base model and no data set of others: every part began with
random weights, on contacts that this program computes."""

_USE = """No part began with the weights of another model, and the contacts are computed by
`tacgrasp data generate`. Every part has a `manifest.json` with the SHA-256 of its files. Read from
this folder:

```python
from pathlib import Path

from cltp.checkpoints.parts import StoredEncoder, StoredProjector
from cltp.checkpoints.tac3d_llm import load_tac3d_llm
from transformers import AutoModel, AutoModelForCausalLM, AutoTokenizer

model = load_tac3d_llm(Path("."))  # all parts but clip, and that they belong together
encoder = StoredEncoder.from_pretrained("encoder")
projector = StoredProjector.from_pretrained("projector")
clip = AutoModel.from_pretrained("clip")
lm = AutoModelForCausalLM.from_pretrained("lm")
tokenizer = AutoTokenizer.from_pretrained("lm")
```

A text for clip stands between `<bos>` and `<eos>`, a prompt for lm between `<user>` and `<reply>`;
the tokenizers add none of them. Text features are those of `<eos>`, as
`cltp.encoder.clip_towers.text_features` takes them: transformers' `get_text_features` takes another
token of every clip whose end has the number 2."""


_BASE_USE = """The language model was trained behind another one, the {kind} in `{path}`, of which
`lm` has {trained}; the other parts began with random weights, and the contacts are computed by
`tacgrasp data generate`. Every part has a `manifest.json` with the SHA-256 of its files. Read from
this folder, with that language model where it was (`tacgrasp train base` names another place):

```python
from pathlib import Path

from cltp.checkpoints.tac3d_llm import load_tac3d_llm

model = load_tac3d_llm(Path("."))  # all parts but clip, and that they belong together
```"""

_TRAINED = {"lora": "an adapter in peft's format", "all": "all, changed", "projector": "nothing"}


def write_card(folder: Path, facts: Mapping[str, str]) -> None:
    """Write the model card of weights that lie in a folder, with an empty table of scores.

    Args:
        folder: Folder of the weights.
        facts: Command, seed, checksum of the data, versions, duration.

    Raises:
        WeightsError: A part can't be read.
    """
    size = ", small" if not is_stock(folder / "lm") else ""
    lines = [f"# Tac3D-LLM{size}", "", "| | |", "|---|---|"]
    lines += [f"| {name} | {value} |" for name, value in facts.items()]
    _write(folder, "\n".join(lines), "\n\n| | |\n|---|---|\n")


def facts_of(folder: Path) -> dict[str, str]:
    """Facts of the model card in a folder by their names; empty where there is no card."""
    path = folder / CARD
    if not path.exists():
        return {}
    above = path.read_text(encoding="utf-8", errors="replace").partition(_PARTS)[0]
    rows = [line.strip("| ").split(" | ", 1) for line in above.splitlines()]
    return {row[0]: row[1] for row in rows if len(row) == 2}


def renew_card(folder: Path, facts: Mapping[str, str] | None = None) -> None:
    """Write today's front matter and parts into a card; scores and other facts stay as they are.

    Args:
        folder: Folder of the weights.
        facts: Facts that are added, or take the place of those of the same name.

    Raises:
        WeightsError: There is no card, or a part can't be read.
    """
    try:
        text = (folder / CARD).read_text(encoding="utf-8")
    except (OSError, ValueError) as error:
        raise WeightsError(f"the model card {folder / CARD} can't be read: {error}") from error
    if text.startswith("---\n"):
        text = text.partition("\n---\n")[2]
    above, _, scores = text.partition(SCORES)
    lines = above.partition(_PARTS)[0].strip().splitlines()
    for name, value in (facts or {}).items():
        lines = [line for line in lines if not line.startswith(f"| {name} |")]
        lines.append(f"| {name} | {value} |")
    _write(folder, "\n".join(lines), scores)


def _write(folder: Path, above: str, scores: str) -> None:
    rows = ["| part | model_type | architectures | numbers | bytes |", "|---|---|---|---|---|"]
    rows += [f"| {' | '.join(row)} |" for row in _part_rows(folder)]
    matter, use = FRONT_MATTER, _USE
    if is_stock(folder / "lm"):
        base = BaseLm.read(folder / "lm")
        matter = matter.replace("base_model: []", f"base_model: [{Path(base.path).name!r}]")
        use = _BASE_USE.format(kind=base.model_type, path=base.path, trained=_TRAINED[base.tune])
    sections = [f"{matter}\n{above}", _PARTS, "\n".join(rows), use, f"{SCORES}{scores}"]
    folder.mkdir(parents=True, exist_ok=True)
    write_atomically(folder / CARD, "\n\n".join(sections))


def _part_rows(folder: Path) -> Iterator[tuple[str, ...]]:
    """Name, model type, classes, count of numbers and bytes of each part that is there."""
    for name in PARTS:
        part = folder / name
        if not part.is_dir():
            continue
        config = read_config(part / (CONFIG if (part / CONFIG).exists() else BASE_FILE))
        classes = config.get("architectures") or ["-"]
        size = sum(path.stat().st_size for path in part.iterdir() if path.is_file())
        yield (
            name,
            f"`{config.get('model_type', '-')}`",
            ", ".join(f"`{kind}`" for kind in classes),
            f"{sum(map(_count, part.glob('*.safetensors'))):,}",
            f"{size:,}",
        )


def _count(path: Path) -> int:
    """How many numbers a file of weights holds."""
    try:
        with safe_open(path, framework="pt") as weights:
            return sum(math.prod(weights.get_slice(key).get_shape()) for key in weights.keys())  # noqa: SIM118
    except (OSError, SafetensorError) as error:
        raise WeightsError(f"{path} is damaged: {error}; copy the whole folder again") from error
