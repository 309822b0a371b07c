"""A page to look through a data set: random contacts with pictures, and counts of all classes.

One self-contained HTML file (``tacgrasp.base.html_page``). Without scripts it still shows every
contact.
"""

from __future__ import annotations

import base64
import io
import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from numpy.typing import NDArray
from PIL import Image

from cltp.data.dataset import ContactDataset
from cltp.tactile.picture import DEPTH_STOPS_MM, depth_picture, depth_scale, picture
from cltp.tactile.sensors import sensor_named
from cltp.tactile.states import DIMENSIONS, ContactState
from cltp.texts.contact_texts import texts_of
from tacgrasp.base.counted import counted
from tacgrasp.base.html_page import render_page
from tacgrasp.datasets.contact_sheet import ambiguous_dimensions
from tacgrasp.datasets.stats import MIN_CLASS_FRACTION, UNKNOWN, DataStats, stats

_WEBP_QUALITY = 82


def write_gallery(folder: Path, indices: Sequence[int] | NDArray, path: Path, *, seed: int) -> None:
    """Write the page.

    Args:
        folder: Data set.
        indices: The contacts to show.
        path: HTML file, overwritten.
        seed: Random seed that drew the contacts, for the page's header.

    Raises:
        TouchError: The data set, or one of the contacts, is damaged.
        OSError: The file can't be written.
    """
    data, counts = ContactDataset(folder, partial=True), stats(folder)
    cards = [_card(data, int(index)) for index in indices]
    states = [data.state(int(index)) for index in indices]
    page = render_page(
        "datasets/templates/gallery.html",
        title=f"{folder.name}: {counted(counts.contacts, 'contact')}",
        facts=_facts(counts, len(indices), seed),
        stats=counts,
        panels=[_panel(dimension, counts, states) for dimension in DIMENSIONS],
        cards=cards,
        depth_scale=_image(depth_scale(160, 8)),
        depth_stops=DEPTH_STOPS_MM,
        num_ambiguous=sum(bool(card["ambiguous"]) for card in cards),
    )
    path.write_text(page, encoding="utf-8")


def _facts(counts: DataStats, num_shown: int, seed: int) -> list[str]:
    facts = [
        f"{num_shown} drawn with seed {seed}",
        f"{counts.series:,} presses of {len(counts.objects)} objects",
        f"cut by the edge {counts.cut / counts.contacts:.1%}",
    ]
    if counts.missing:
        facts.insert(0, f"INCOMPLETE, {counts.missing:,} contacts are missing")
    if counts.ambiguous is not None:
        facts.append(f"ambiguous {counts.ambiguous['any'] / counts.contacts:.1%}")
    return facts + [f"{name} {value}" for name, value in counts.about.items() if name != "made_by"]


def _panel(dimension: str, counts: DataStats, states: Sequence[ContactState]) -> dict[str, Any]:
    """Bars of a dimension's classes in the whole set; each is a button that filters the cards."""
    classes = counts.classes[dimension]
    words = [str(getattr(state, dimension) or UNKNOWN) for state in states]
    longest = max(classes.values())
    return {
        "dimension": dimension,
        "bars": [
            {
                "word": word,
                "count": count,
                "length": count / longest,
                "fraction": count / counts.contacts,
                "on_page": words.count(word),
                "is_rare": count < MIN_CLASS_FRACTION * counts.contacts,
            }
            for word, count in classes.items()
        ],
    }


def _card(data: ContactDataset, index: int) -> dict[str, Any]:
    state = data.state(index)
    sensor = sensor_named(data.column("sensor")[index])
    heights = data.height_mm(index)
    texts = texts_of(data, index)
    questions = [[pair.question, pair.answer] for pair in texts.questions]
    prompts = [[name, " ".join(wordings)] for name, wordings in texts.prompts.items()]
    name = f"{data.column('object')[index]} · series {data.column('series')[index]}"
    return {
        "index": index,
        "origin": f"{name} · {data.column('split')[index]} · {sensor.name}",
        "words": {name: str(getattr(state, name) or UNKNOWN) for name in DIMENSIONS},
        "cut": " ".join(sorted(state.cut)),
        "ambiguous": ambiguous_dimensions(data, index),
        "texts": texts,
        "details": json.dumps({"questions": questions, "prompts": prompts}),
        "picture": _image(picture(heights, sensor)),
        "depth_picture": _image(depth_picture(heights, sensor)),
    }


def _image(pixels: NDArray) -> str:
    buffer = io.BytesIO()
    Image.fromarray(pixels).save(buffer, format="WEBP", quality=_WEBP_QUALITY, method=4)
    return f"data:image/webp;base64,{base64.b64encode(buffer.getvalue()).decode()}"
