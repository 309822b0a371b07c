"""One stored contact on the terminal: origin, labels, numbers, heights, texts."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from cltp.data.dataset import NUMBER_COLUMNS, ContactDataset
from cltp.tactile.sensors import SensorSpec
from cltp.tactile.states import DIMENSIONS
from cltp.texts.contact_texts import texts_of
from tacgrasp.datasets.contact_sheet import ambiguous_dimensions
from tacgrasp.datasets.stats import UNKNOWN

_SHADES = " .:-=+*#%@"
_MAP_COLUMNS, _MAP_ROWS = 64, 24
_LABELS = frozenset({*NUMBER_COLUMNS.values(), *DIMENSIONS, "cut", "unsure"})
_ORIGIN = frozenset({"sensor", "object", "series", "split", "seed"})
_BYTES = frozenset({"offset", "size", "crc32", "rows", "columns"})


def lines_of(data: ContactDataset, index: int) -> Iterator[str]:
    """The contact in lines, one a fact.

    Raises:
        TouchError: The contact is damaged, or its labels can't be put into words.
    """
    contact = data.contact(index)
    state, sensor, heights = contact.state, contact.sensor, contact.height_mm
    yield f"contact   {index} of {len(data):,} in {data.folder}"
    yield f"object    {contact.object}, series {contact.series}, split {contact.split}"
    yield f"sensor    {sensor.name}, {sensor.width_mm:.1f} × {sensor.height_mm:.1f} mm"
    if (gel := contact.gel) is not None:
        yield (
            f"gel       {gel.thickness_mm:.2f} mm thick, E {gel.young_mpa:.3f} MPa, "
            f"ν {gel.poisson:.3f}; seed {contact.seed}"
        )
    else:
        yield "gel       unknown: a real contact"
    yield f"labels    {state.texture or UNKNOWN} {state.shape or UNKNOWN}"
    yield (
        f"          depth {state.depth or 'none'}, position {state.position or 'none'}, "
        f"area {state.area or 'none'}, cut {' '.join(sorted(state.cut)) or 'no'}"
    )
    yield (
        f"numbers   {state.depth_mm:.3f} mm deep at ({state.x_mm:+.2f}, {state.y_mm:+.2f}) mm, "
        f"{state.area_fraction:.2%} of the sensing area, {state.force_n:.3f} N"
    )
    yield f"ambiguous {' '.join(ambiguous_dimensions(data, index)) or 'no'}"
    for name in data.column_names:  # those without a line of their own
        if name not in _LABELS | _ORIGIN | _BYTES and not name.startswith("gel_"):
            yield f"{name:9} {data.column(name)[index]}"
    yield (
        f"heights   {heights.shape[0]} × {heights.shape[1]}, {heights.min():+.3f} to "
        f"{heights.max():+.3f} mm, {int(data.column('size')[index]):,} bytes stored"
    )
    yield from (f"          {line}" for line in height_lines(heights, sensor))
    texts = texts_of(data, index)
    yield f"caption   {texts.caption}"
    yield f"numeric   {texts.numbers}"
    yield f"other     {texts.paraphrase}"
    for slot, wordings in texts.prompts.items():
        yield f"prompts   {slot}: {' | '.join(wordings)}"
    for pair in texts.questions:
        yield f"question  {pair.question} {pair.answer}"


def height_lines(height_mm: NDArray[np.floating], sensor: SensorSpec) -> list[str]:
    """A height map in characters, in the pad's proportions: ' ' untouched, '@' deepest."""
    rows = np.arange(_MAP_ROWS) * height_mm.shape[0] // _MAP_ROWS
    columns = np.arange(_MAP_COLUMNS) * height_mm.shape[1] // _MAP_COLUMNS
    coarse = height_mm[np.ix_(rows, columns)] / sensor.max_depth_mm
    # The square root makes a contact of a tenth of the range visible.
    shade = (np.sqrt(coarse.clip(0, 1)) * len(_SHADES)).astype(int).clip(0, len(_SHADES) - 1)
    return ["".join(_SHADES[value] for value in row).rstrip() for row in shade]
