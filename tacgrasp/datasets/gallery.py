"""A page to look through a data set: drawn contacts with pictures and words, counts of all classes.

One HTML file that needs nothing else: pictures, style and script are inside it, and its own policy
forbids the browser to load anything. Without a script it still shows every contact.
"""

from __future__ import annotations

import base64
import html
import io
import json
from collections.abc import Mapping, Sequence
from importlib.resources import files
from pathlib import Path

from numpy.typing import NDArray
from PIL import Image

from cltp.data.dataset import ContactDataset
from cltp.tactile.picture import depth_picture, picture
from cltp.tactile.sensors import sensor_named
from cltp.tactile.states import DIMENSIONS, ContactState
from cltp.texts.contact_texts import ContactTexts, texts_of
from tacgrasp.datasets.contact_sheet import unsure_of
from tacgrasp.datasets.stats import LEAST_SHARE, NOBODY_SAYS, DataStats, stats

_WEBP_QUALITY = 82
_POLICY = "default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'unsafe-inline'"


def write_gallery(folder: Path, indices: Sequence[int] | NDArray, path: Path, *, seed: int) -> None:
    """Write the page.

    Args:
        folder: Data set.
        indices: The contacts to show.
        path: HTML file, overwritten.
        seed: What the contacts were drawn with; the page says it.

    Raises:
        TouchError: The data set, or one of the contacts, is damaged.
        OSError: The file can't be written.
    """
    data = ContactDataset(folder, partial=True)
    found = stats(folder)
    cards = "\n".join(_card(data, int(index)) for index in indices)
    shown = [data.state(int(index)) for index in indices]
    doubtful = sum(bool(unsure_of(data, int(index))) for index in indices)
    title = f"{html.escape(folder.name)}: {found.contacts:,} contacts"
    page = f"""<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="{_POLICY}">
<title>{title}</title>
<style>
{_asset("gallery.css")}
</style>
</head>
<body>
<header>
<h1>{title}</h1>
<p>{_facts(found, len(indices), seed)}</p>
<div class="tools">
<input id="search" type="search" placeholder="Search captions, objects, numbers …"
 aria-label="Search">
<label><input id="doubtful" type="checkbox"> ambiguous only ({doubtful})</label>
<button id="reset" type="button">Show all</button>
<output id="count">{len(indices)} shown</output>
</div>
</header>
<div class="page">
<aside>
<details open id="classes">
<summary>Classes, of all {found.contacts:,} contacts</summary>
{"".join(_panel(slot, found, shown) for slot in DIMENSIONS)}
{_plain_panel("split", found.splits, found.contacts)}
{_numbers(found)}
</details>
</aside>
<main id="cards">
{cards}
<p id="none" hidden>No contact of these {len(indices)} is like that.</p>
</main>
</div>
<dialog id="detail"></dialog>
<script>
{_asset("gallery.js")}
</script>
</body>
</html>
"""
    path.write_text(page, encoding="utf-8")


def _asset(name: str) -> str:
    return files("tacgrasp.datasets").joinpath("pages", name).read_text(encoding="utf-8")


def _facts(found: DataStats, shown: int, seed: int) -> str:
    parts = [
        f"{shown} drawn with seed {seed}",
        f"{found.series:,} presses of {len(found.objects)} objects",
        f"cut by the edge {found.cut / found.contacts:.1%}",
    ]
    if found.missing:
        parts.insert(0, f"INCOMPLETE, {found.missing:,} contacts are missing")
    if found.ambiguous is not None:
        parts.append(f"ambiguous {found.ambiguous['any'] / found.contacts:.1%}")
    said = [f"{name} {value}" for name, value in found.about.items() if name != "made_by"]
    text = " · ".join([*parts, *said])
    return f"{html.escape(text)} · <code title='SHA-256'>{found.checksum[:16]}</code>"


def _panel(slot: str, found: DataStats, shown: Sequence[ContactState]) -> str:
    """Bars of a dimension's classes in the whole set; each is a button that filters the cards."""
    counts = found.classes[slot]
    here = [str(getattr(state, slot) or NOBODY_SAYS) for state in shown]
    most = max(counts.values())
    rows = "".join(
        f'<button type="button" class="bar{_low(count, found)}" data-slot="{slot}" '
        f'data-word="{html.escape(word)}" aria-pressed="false" style="--share:{count / most:.4f}" '
        f'title="{count:,} of all, {here.count(word)} on this page">'
        f"<span>{html.escape(word)}</span><span>{count:,}</span>"
        f"<span>{count / found.contacts:.1%}</span></button>"
        for word, count in counts.items()
    )
    return f'<section class="{slot}"><h2>{slot}</h2>{rows}</section>'


def _low(count: int, found: DataStats) -> str:
    return " low" if count < LEAST_SHARE * found.contacts else ""


def _plain_panel(name: str, counts: Mapping[str, int], total: int) -> str:
    rows = "".join(
        f"<tr><td>{html.escape(str(word))}</td><td>{count:,}</td><td>{count / total:.1%}</td></tr>"
        for word, count in counts.items()
    )
    return f"<section><h2>{name}</h2><table>{rows}</table></section>"


def _numbers(found: DataStats) -> str:
    rows = "".join(
        f"<tr><td>{name}</td><td>{values[1]:.2f}</td><td>{values[3]:.2f}</td>"
        f"<td>{values[5]:.2f}</td></tr>"
        for name, values in found.quantiles.items()
    )
    head = "<tr><th></th><th>5 %</th><th>50 %</th><th>95 %</th></tr>"
    return f"<section><h2>numbers</h2><table>{head}{rows}</table></section>"


def _card(data: ContactDataset, index: int) -> str:
    state = data.state(index)
    sensor = sensor_named(data.column("sensor")[index])
    heights = data.height_mm(index)
    texts = texts_of(data, index)
    name = f"{data.column('object')[index]} · series {data.column('series')[index]}"
    where = f"{name} · {data.column('split')[index]} · {sensor.name}"
    words = {slot: str(getattr(state, slot) or NOBODY_SAYS) for slot in DIMENSIONS}
    labels = "".join(
        f'<span class="label {slot}">{html.escape(word)}</span>' for slot, word in words.items()
    )
    if state.cut:
        labels += f'<span class="label">cut {html.escape(" ".join(sorted(state.cut)))}</span>'
    doubtful = unsure_of(data, index)
    if doubtful:
        labels += f'<span class="label doubt">ambiguous: {" ".join(doubtful)}</span>'
    attributes = "".join(f' data-{slot}="{html.escape(word)}"' for slot, word in words.items())
    attributes += f' data-doubt="{int(bool(doubtful))}"'
    attributes += f' data-more="{html.escape(json.dumps(_more(texts)), quote=True)}"'
    alt = html.escape(texts.caption)
    return f"""<article tabindex="0"{attributes}>
<div class="views">
<img alt="{alt}" src="{_image(picture(heights, sensor))}">
<img alt="depth" src="{_image(depth_picture(heights, sensor))}">
</div>
<h3>#{index} <small>{html.escape(where)}</small></h3>
<p class="labels">{labels}</p>
<p class="caption">{html.escape(texts.caption)}</p>
<p class="numbers">{html.escape(texts.numbers)}</p>
<p class="other">{html.escape(texts.paraphrase)}</p>
</article>"""


def _more(texts: ContactTexts) -> dict[str, list[list[str]]]:
    """What the page shows of a contact when it is opened."""
    return {
        "questions": [[pair.question, pair.answer] for pair in texts.questions],
        "prompts": [[slot, " ".join(wordings)] for slot, wordings in texts.prompts.items()],
    }


def _image(pixels: NDArray) -> str:
    buffer = io.BytesIO()
    Image.fromarray(pixels).save(buffer, format="WEBP", quality=_WEBP_QUALITY, method=4)
    return f"data:image/webp;base64,{base64.b64encode(buffer.getvalue()).decode()}"
