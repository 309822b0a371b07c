"""Pages (PNG) of contacts with their captions, to be read one by one.

Not here: the HTML page (``tacgrasp.datasets.gallery``).
"""

from __future__ import annotations

import textwrap
from collections.abc import Iterator, Sequence
from functools import lru_cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw, ImageFont

from cltp.atomic_write import replacing
from cltp.data.dataset import ContactDataset
from cltp.tactile.picture import DEPTH_STOPS_MM, depth_picture, depth_scale, picture
from cltp.tactile.sensors import sensor_named
from cltp.texts.contact_texts import texts_of

PICTURE_PX = 300
_COLUMNS, _GAP, _LINE_PX, _LETTERS = 2, 14, 17, 78
_TEXT_LINES = 6
_INK, _PAPER, _DIM = (232, 232, 228), (24, 26, 30), (150, 152, 156)


def draw_contacts(count: int, contacts: int, seed: int) -> NDArray[np.int64]:
    """Draw ``contacts`` of ``count`` indices at random, in ascending order."""
    indices = np.random.default_rng(seed).permutation(count)[:contacts]
    return np.sort(indices).astype(np.int64)


def contact_card(data: ContactDataset, index: int) -> Image.Image:
    """One contact: its picture, its depth map, and its number and captions below."""
    sensor = sensor_named(data.column("sensor")[index])
    heights = data.height_mm(index)
    pair = [view(heights, sensor, PICTURE_PX) for view in (picture, depth_picture)]
    height = pair[0].shape[0]
    card = Image.new("RGB", (2 * PICTURE_PX + 2, height + (_TEXT_LINES + 2) * _LINE_PX), _PAPER)
    for column, image in enumerate(pair):
        card.paste(Image.fromarray(image), (column * (PICTURE_PX + 2), 0))
    draw = ImageDraw.Draw(card)
    for third in (1, 2):  # the grid of the nine positions over the depth map
        x, y = PICTURE_PX + 2 + third * PICTURE_PX // 3, third * height // 3
        draw.line([(x, 0), (x, height)], fill=(70, 76, 90))
        draw.line([(PICTURE_PX + 2, y), (2 * PICTURE_PX + 2, y)], fill=(70, 76, 90))
    texts = texts_of(data, index)
    head = f"{index}  {data.column('object')[index]}  {data.column('split')[index]}"
    if ambiguous := ambiguous_dimensions(data, index):
        head += f"  AMBIGUOUS in {', '.join(ambiguous)}"
    lines = [*textwrap.wrap(texts.caption, _LETTERS), *textwrap.wrap(texts.numbers, _LETTERS)]
    lines += textwrap.wrap(texts.paraphrase, _LETTERS)
    draw.text((2, height + 4), head, font=_font(13), fill=_DIM)
    for row, line in enumerate(lines[:_TEXT_LINES]):
        draw.text((2, height + 4 + (row + 1) * _LINE_PX), line, font=_font(13), fill=_INK)
    return card


def pages(
    data: ContactDataset, indices: Sequence[int], per_page: int = 8, columns: int = _COLUMNS
) -> Iterator[Image.Image]:
    """Pages of cards, ``columns`` side by side."""
    for start in range(0, len(indices), per_page):
        cards = [contact_card(data, int(index)) for index in indices[start : start + per_page]]
        rows = -(-len(cards) // columns)
        width = max(card.width for card in cards) + _GAP
        height = max(card.height for card in cards) + _GAP
        size = (columns * width + _GAP, rows * height + _GAP + 2 * _LINE_PX)
        page = Image.new("RGB", size, _PAPER)
        _draw_scale(page)
        for number, card in enumerate(cards):
            row, column = divmod(number, columns)
            page.paste(card, (_GAP + column * width, _GAP + row * height))
        yield page


def _draw_scale(page: Image.Image) -> None:
    """The colour scale of the depth maps, at the bottom of a page."""
    top, left, step = page.height - _LINE_PX - 4, 90, 44
    width = step * (len(DEPTH_STOPS_MM) - 1)
    page.paste(Image.fromarray(depth_scale(width, 8)), (left, top - 8))
    draw = ImageDraw.Draw(page)
    draw.text((_GAP, top - 10), "depth [mm]", font=_font(12), fill=_DIM)
    for number, stop_mm in enumerate(DEPTH_STOPS_MM):
        place = (left + number * step, top + 2)
        draw.text(place, f"{stop_mm:g}", font=_font(11), fill=_DIM, anchor="mt")


def write_pages(data: ContactDataset, indices: Sequence[int], folder: Path) -> list[Path]:
    """Save pages as ``sheet-01.png`` and on; returns their paths."""
    folder.mkdir(parents=True, exist_ok=True)
    paths = []
    for number, page in enumerate(pages(data, indices), start=1):
        path = folder / f"sheet-{number:02d}.png"
        with replacing(path) as part:
            page.save(part, format="PNG")
        paths.append(path)
    return paths


def ambiguous_dimensions(data: ContactDataset, index: int) -> list[str]:
    """Dimensions in which a contact is marked as ambiguous; empty where the set has no marks."""
    if "unsure" not in data.column_names:
        return []
    return str(data.column("unsure")[index] or "").split()


@lru_cache(maxsize=4)
def _font(size: int) -> ImageFont.FreeTypeFont:
    """A font with ± and ², which Pillow's default font lacks."""
    import matplotlib

    path = Path(matplotlib.get_data_path()) / "fonts" / "ttf" / "DejaVuSans.ttf"
    return ImageFont.truetype(str(path), size)
