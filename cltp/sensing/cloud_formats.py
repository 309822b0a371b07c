"""Readers of three small formats of point clouds: PLY, PCD and plain columns of x, y and z.

They return points as written, (N, 3) float64; ``cltp.sensing.touch_files`` checks them. What a
header announces is bounded, and compared with the file's size, before anything is allocated.
Sources: Turk, 'The PLY polygon file format' (1994); pointclouds.org, 'The PCD file format', v0.7.
"""

from __future__ import annotations

import io

import numpy as np
from numpy.typing import NDArray

from cltp.errors import TouchError

MAX_POINTS = 2_000_000
"""Most points of a cloud: one for each pixel of a camera of 2 megapixels. Our choice."""

MAX_FIELDS = 1000
"""Most fields of a point, each place of an array counted. Our choice: PCL's largest have 352."""

MAX_TEXT_BYTES = 16_000_000
"""Most bytes of points in text: Python holds a line in several times its size. Our choice."""

_NAMES = ("char", "uchar", "short", "ushort", "int", "uint", "float", "double")
_CODES = ("i1", "u1", "i2", "u2", "i4", "u4", "f4", "f8")
_PLY_TYPES = dict(zip(_NAMES, _CODES, strict=True)) | {np.dtype(code).name: code for code in _CODES}
_PCD_TYPES = {kind + size for kind in "FIU" for size in "1248"} - {"F1"}
_PLY_ORDERS = {"ascii": "", "binary_little_endian": "<", "binary_big_endian": ">"}


def read_ply(data: bytes) -> NDArray[np.float64]:
    """Vertices of a PLY file (ascii or binary); faces and other elements are ignored.

    Raises:
        TouchError: Not PLY, vertices without x, y, z, truncated, or vertices not first.
    """
    head, separator, body = data.partition(b"end_header")
    if not data.startswith(b"ply") or not separator:
        raise TouchError("expected a PLY file ('ply' … 'end_header'), got something else")
    body = body[2:] if body.startswith(b"\r\n") else body[1:]
    order, count, fields = _ply_header(head.decode("ascii", errors="replace").split("\n"))
    if order == "":
        return _text_columns(body, fields, count)
    return _binary_columns(body, [(name, order + kind) for name, kind in fields], count)


def _ply_header(lines: list[str]) -> tuple[str, int, list[tuple[str, str]]]:
    """Byte order ('' for text), number of vertices, and their properties (name, dtype)."""
    order: str | None = None
    element, count, fields = "", None, []
    for words in (line.split() for line in lines):
        if words[:1] == ["format"] and len(words) == 3:
            order = _PLY_ORDERS.get(words[1])
        elif words[:1] == ["element"] and len(words) == 3:
            if count is None and words[1] != "vertex":
                raise TouchError(f"expected the vertices first in a PLY file, got {words[1]!r}")
            element = words[1]
            if element == "vertex":
                count = _count(words[2])
        elif words[:1] == ["property"] and element == "vertex":
            kind = _PLY_TYPES.get(words[1]) if len(words) == 3 else None
            if kind is None:
                raise TouchError(f"can't read the vertex property {' '.join(words[1:])!r} of a PLY")
            fields.append((words[2], kind))
    if order is None or count is None:
        raise TouchError("the PLY header names no known format or no vertices")
    return order, count, fields


def read_pcd(data: bytes) -> NDArray[np.float64]:
    """Points of a PCD file (DATA ascii or binary).

    Raises:
        TouchError: Not PCD, compressed, no x, y, z, or truncated.
    """
    header: dict[str, list[str]] = {}
    offset = 0
    while "DATA" not in header:
        end = data.find(b"\n", offset)
        if end < 0:
            raise TouchError("expected a PCD file (a header up to 'DATA …'), got something else")
        words = data[offset:end].decode("ascii", errors="replace").split()
        if words and not words[0].startswith("#"):
            header[words[0]] = words[1:]
        offset = end + 1
    header.setdefault("COUNT", ["1"] * len(header.get("FIELDS", [])))
    columns = [header.get(key, []) for key in ("FIELDS", "TYPE", "SIZE", "COUNT")]
    if len(set(map(len, columns))) > 1 or "POINTS" not in header:
        raise TouchError("the PCD header's FIELDS, SIZE, TYPE, COUNT and POINTS don't fit together")
    fields: list[tuple[str, str]] = []
    for name, kind, size, count in zip(*columns, strict=True):
        if kind + size not in _PCD_TYPES:
            raise TouchError(f"can't read the PCD field {name!r} of type {kind} and size {size}")
        dtype, length = f"<{kind.lower()}{size}", _count(count, "a COUNT", MAX_FIELDS)
        length = min(length, MAX_FIELDS + 1 - len(fields))  # one too many is refused below
        fields += [(f"{name}[{n}]" if n else name, dtype) for n in range(length)]
    num_points = _count(" ".join(header["POINTS"]))
    coding = " ".join(header["DATA"])
    if coding == "ascii":
        return _text_columns(data[offset:], fields, num_points)
    if coding == "binary":
        return _binary_columns(data[offset:], fields, num_points)
    raise TouchError(f"PCD with DATA {coding} is not read; save it as binary or ascii")


def read_xyz(data: bytes) -> NDArray[np.float64]:
    """Rows of x, y, z in text, separated by spaces or commas; '#' begins a comment.

    Raises:
        TouchError: Not numbers, or fewer than three in a row.
    """
    _bound_text(data)
    try:
        text = data.decode("utf-8").replace(",", " ")
        if not any(line.split("#")[0].strip() for line in text.splitlines()):
            return np.zeros((0, 3))
        columns = np.loadtxt(io.StringIO(text), ndmin=2)
    except UnicodeDecodeError:
        raise TouchError("expected rows of three numbers in text, got binary data") from None
    except ValueError as error:
        raise TouchError(f"expected rows of three numbers: {error}") from None
    if columns.shape[1] < 3:
        raise TouchError(f"expected three numbers in a row, got {columns.shape[1]}")
    return columns[:, :3]


def _count(text: str, name: str = "a number of points", most: int = MAX_POINTS) -> int:
    if not (text.isascii() and text.isdigit() and len(text) < 19):
        raise TouchError(f"expected {name} in the header, got {text[:40]!r}")
    count = int(text)
    if count > most:
        raise TouchError(f"the header has {name} of {count}; at most {most} are read")
    return count


def _bound_text(body: bytes) -> None:
    if len(body) > MAX_TEXT_BYTES:
        raise TouchError(
            f"{len(body)} bytes of points in text, at most {MAX_TEXT_BYTES} are read; save the "
            "cloud in binary"
        )


def _coordinates(fields: list[tuple[str, str]]) -> list[int]:
    if len(fields) > MAX_FIELDS:
        raise TouchError(f"the header has {len(fields)} fields; at most {MAX_FIELDS} are read")
    names = [name for name, _ in fields]
    missing = [axis for axis in "xyz" if axis not in names]
    if missing or len(set(names)) != len(names):
        raise TouchError(f"expected fields x, y and z, got {', '.join(names) or 'none'}")
    return [names.index(axis) for axis in "xyz"]


def _text_columns(body: bytes, fields: list[tuple[str, str]], count: int) -> NDArray[np.float64]:
    indices = _coordinates(fields)
    _bound_text(body)
    lines = [line for line in body.decode("ascii", errors="replace").splitlines() if line.strip()]
    if len(lines) < count:
        raise TouchError(f"truncated: the header says {count} points, the file has {len(lines)}")
    if count == 0:
        return np.zeros((0, 3))
    try:
        rows = [[float(word) for word in line.split()] for line in lines[:count]]
        return np.array([[row[i] for i in indices] for row in rows])
    except (ValueError, IndexError) as error:
        raise TouchError(f"expected {len(fields)} numbers in a row: {error}") from None


def _binary_columns(body: bytes, fields: list[tuple[str, str]], count: int) -> NDArray[np.float64]:
    _coordinates(fields)
    row = np.dtype(fields)
    if len(body) < count * row.itemsize:
        raise TouchError(
            f"truncated: {count} points need {count * row.itemsize} bytes, the file has {len(body)}"
        )
    points = np.frombuffer(body, dtype=row, count=count)
    return np.stack([points[axis].astype(np.float64) for axis in "xyz"], axis=1)
