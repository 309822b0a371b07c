"""Contacts drawn onto pages, each with what is said of it, to be read one by one.

Not here: the page with all of it in a browser (``tacgrasp.datasets.gallery``).
"""

from __future__ import annotations

import textwrap
from collections.abc import Iterator, Sequence
from functools import lru_cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw, ImageFont

from cltp.data.dataset import ContactDataset
from cltp.tactile.picture import depth_picture, picture
from cltp.tactile.sensors import sensor_named
from cltp.texts.contact_texts import texts_of

PICTURE_PX = 300
_COLUMNS, _GAP, _LINE_PX, _LETTERS = 2, 14, 17, 78
_TEXT_LINES = 6
_INK, _PAPER, _DIM = (232, 232, 228), (24, 26, 30), (150, 152, 156)


def drawn(count: int, contacts: int, seed: int) -> NDArray[np.int64]:
    """Which contacts of ``count`` are looked at: ``contacts`` of them, in ascending order."""
    chosen = np.random.default_rng(seed).permutation(count)[:contacts]
    return np.sort(chosen).astype(np.int64)


def contact_card(data: ContactDataset, index: int) -> Image.Image:
    """One contact: its picture, its depth, its number, and its captions under both."""
    sensor = sensor_named(data.column("sensor")[index])
    heights = data.height_mm(index)
    pair = [view(heights, sensor, PICTURE_PX) for view in (picture, depth_picture)]
    high = pair[0].shape[0]
    card = Image.new("RGB", (2 * PICTURE_PX + 2, high + (_TEXT_LINES + 2) * _LINE_PX), _PAPER)
    for place, image in enumerate(pair):
        card.paste(Image.fromarray(image), (place * (PICTURE_PX + 2), 0))
    draw = ImageDraw.Draw(card)
    _draw_thirds(draw, PICTURE_PX, high)
    texts = texts_of(data, index)
    head = f"{index}  {data.column('object')[index]}  {data.column('split')[index]}"
    if unsure := unsure_of(data, index):
        head += f"  AMBIGUOUS in {', '.join(unsure)}"
    lines = [*textwrap.wrap(texts.caption, _LETTERS), *textwrap.wrap(texts.numbers, _LETTERS)]
    lines += textwrap.wrap(texts.paraphrase, _LETTERS)
    draw.text((2, high + 4), head, font=_font(13), fill=_DIM)
    for row, line in enumerate(lines[:_TEXT_LINES]):
        draw.text((2, high + 4 + (row + 1) * _LINE_PX), line, font=_font(13), fill=_INK)
    return card


def pages(data: ContactDataset, indices: Sequence[int], per_page: int = 8) -> Iterator[Image.Image]:
    """Pages of cards, two side by side."""
    for start in range(0, len(indices), per_page):
        cards = [contact_card(data, int(index)) for index in indices[start : start + per_page]]
        rows = -(-len(cards) // _COLUMNS)
        wide = max(card.width for card in cards) + _GAP
        high = max(card.height for card in cards) + _GAP
        page = Image.new("RGB", (_COLUMNS * wide + _GAP, rows * high + _GAP), _PAPER)
        for place, card in enumerate(cards):
            at = (_GAP + place % _COLUMNS * wide, _GAP + place // _COLUMNS * high)
            page.paste(card, at)
        yield page


def write_pages(data: ContactDataset, indices: Sequence[int], folder: Path) -> list[Path]:
    """Save pages as ``sheet-01.png`` and on; returns what was written."""
    folder.mkdir(parents=True, exist_ok=True)
    written = []
    for number, page in enumerate(pages(data, indices), start=1):
        path = folder / f"sheet-{number:02d}.png"
        page.save(path)
        written.append(path)
    return written


def unsure_of(data: ContactDataset, index: int) -> list[str]:
    """Dimensions in which a contact is marked as ambiguous; empty too where nobody looked."""
    if "unsure" not in data.column_names:
        return []
    return str(data.column("unsure")[index] or "").split()


def _draw_thirds(draw: ImageDraw.ImageDraw, wide: int, high: int) -> None:
    """The nine positions, over the depth's picture."""
    for third in (1, 2):
        x, y = wide + 2 + third * wide // 3, third * high // 3
        draw.line([(x, 0), (x, high)], fill=(70, 76, 90))
        draw.line([(wide + 2, y), (2 * wide + 2, y)], fill=(70, 76, 90))


@lru_cache(maxsize=4)
def _font(size: int) -> ImageFont.FreeTypeFont:
    """A font with ± and ², which Pillow's own lacks."""
    import matplotlib

    path = Path(matplotlib.get_data_path()) / "fonts" / "ttf" / "DejaVuSans.ttf"
    return ImageFont.truetype(str(path), size)
