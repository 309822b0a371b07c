"""The heights of a cloud as a small picture with its colour scale, made in a millisecond.

Colours mean the same depth everywhere (``cltp.tactile.picture``). Not here: the whole episode as
one picture (``tacgrasp.episodes.plot``).
"""

from __future__ import annotations

import io
from functools import cache

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw, ImageFont

from cltp.tactile.cells import pictured_heights
from cltp.tactile.cloud import TactileCloud
from cltp.tactile.picture import DEPTH_PALETTE, DEPTH_STOPS_MM, depth_levels

WIDTH_PX = 200
"""Width of the gel in the picture; its height follows from the sensing area."""

SCALE_PX = 60
"""Width of the colour scale beside it."""

_WHITE, _DARK = 255, 33  # levels of the palette for the scale's text and ground
_MARGIN, _BAR_PX = 8, 14


def height_image(cloud: TactileCloud) -> NDArray[np.uint8]:
    """Levels of ``DEPTH_PALETTE``, shape (H, W): the gel, row 0 = top, and the scale in mm."""
    sensor = cloud.sensor
    rows = round(WIDTH_PX * sensor.height_mm / sensor.width_mm)
    cells = Image.fromarray(depth_levels(pictured_heights(cloud)))
    gel = np.asarray(cells.resize((WIDTH_PX, rows), Image.Resampling.BILINEAR))
    return np.hstack([gel, _scale(rows)])


def height_png(cloud: TactileCloud) -> bytes:
    """``height_image`` as a PNG file in colour."""
    image = Image.fromarray(height_image(cloud), mode="P")
    image.putpalette(DEPTH_PALETTE.tobytes())
    file = io.BytesIO()
    image.save(file, format="PNG", compress_level=1)
    return file.getvalue()


@cache
def _scale(rows: int) -> NDArray[np.uint8]:
    """The colour scale, shape (rows, SCALE_PX): deepest on top, with a number at every stop."""
    image = Image.new("L", (SCALE_PX, rows), _DARK)
    draw, font = ImageDraw.Draw(image), ImageFont.load_default(11)
    draw.fontmode = "1"  # a level between text and ground would be another colour
    top, bottom = 2 * _MARGIN + 6, rows - _MARGIN
    draw.text((_MARGIN - 2, 3), "depth mm", fill=_WHITE, font=font)
    for y in range(top, bottom):
        level = round(255 * (bottom - 1 - y) / (bottom - 1 - top))
        draw.line([(_MARGIN, y), (_MARGIN + _BAR_PX, y)], fill=level)
    for number, stop_mm in enumerate(DEPTH_STOPS_MM):
        down = (bottom - 1 - top) * number / (len(DEPTH_STOPS_MM) - 1)
        place = (_MARGIN + _BAR_PX + 5, bottom - 1 - down)
        draw.text(place, f"{stop_mm:g}", fill=_WHITE, font=font, anchor="lm")
    return np.asarray(image)
