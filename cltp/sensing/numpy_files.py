"""Arrays of numbers in .npy and .npz files, bounded before anything is allocated.

numpy's own reader allocates what a header announces, and unpacks what an archive holds, before it
knows either: a file of a megabyte can ask for gigabytes. Here both are checked first.
"""

from __future__ import annotations

import io
import math
import zipfile
import zlib

import numpy as np
from numpy.typing import NDArray

from cltp.errors import TouchError

MAX_NUMBERS = 8_000_000
"""Most numbers of one array: a map of 3264 × 2448, far above any tactile camera's. Our choice."""

_MAX_ARRAYS = 1000
_MAX_HEADER_BYTES = 10_000
_ENTRY = b"PK\x01\x02"
_DAMAGED = (
    zipfile.BadZipFile,
    zlib.error,
    EOFError,
    NotImplementedError,
    OSError,
    OverflowError,
    RuntimeError,
    ValueError,
)
"""Whatever zipfile raises for a damaged or encrypted archive."""
_AS_NUMPY = (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED)
_ARRAY_HEADERS = {
    (1, 0): np.lib.format.read_array_header_1_0,
    (2, 0): np.lib.format.read_array_header_2_0,
}


def read_npy(data: bytes) -> NDArray[np.float64]:
    """The array of a .npy file.

    Raises:
        TouchError: Not a whole .npy array of real numbers, or more than ``MAX_NUMBERS``.
    """
    shape, fortran_order, dtype, start = _header(data)
    body = memoryview(data)[start:]
    count = _count(shape)
    if len(body) < count * dtype.itemsize:
        raise TouchError(
            f"not a whole .npy array: {count} numbers need {count * dtype.itemsize} bytes, the "
            f"file has {len(body)}"
        )
    flat = np.frombuffer(body, dtype=dtype, count=count)
    with np.errstate(over="ignore"):  # a long double beyond float64 is refused as infinite
        return flat.reshape(shape, order="F" if fortran_order else "C").astype(np.float64)


def read_npz(data: bytes) -> NDArray[np.float64]:
    """The one array of a .npz file, or the first named ``points_mm``, ``seen_mm``, ``height_mm``.

    ``points_mm`` and ``seen_mm`` are what a sensor reports, beside the true heights
    (``tacgrasp simulate``).

    Raises:
        TouchError: Not a whole .npz file, none or several arrays, an encrypted one, points that are
            not (N, 3), or as ``read_npy``.
    """
    if data.count(_ENTRY) > _MAX_ARRAYS:
        raise TouchError(f"expected one array, the .npz file has more than {_MAX_ARRAYS}")
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            return read_npy(_member(archive))
    except _DAMAGED as error:
        raise TouchError(f"not a whole .npz of numbers: {error}") from None


def sensor_in_npz(data: bytes) -> str:
    """The name of the sensor that a .npz file is of, which ``read_npz`` has read; '' for none."""
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            info = archive.getinfo("sensor.npy")
            if info.compress_type not in _AS_NUMPY:
                return ""
            with archive.open(info) as file:
                head = file.read(_MAX_HEADER_BYTES)
        shape, _, dtype, start = _any_header(head)
    except (*_DAMAGED, KeyError, TouchError):
        return ""
    if shape != () or dtype.kind != "U" or len(head) < start + dtype.itemsize:
        return ""
    return str(np.frombuffer(head, dtype=dtype, count=1, offset=start)[0])


def _member(archive: zipfile.ZipFile) -> bytes:
    """The bytes of the one array, as far as ``MAX_NUMBERS`` of them can need."""
    entries = {info.filename.removesuffix(".npy"): info for info in archive.infolist()}
    names = list(entries)
    candidates = [n for n in ("points_mm", "seen_mm", "height_mm") if n in names][:1] or names
    if len(candidates) != 1:
        raise TouchError(
            "expected one array, or one named points_mm, seen_mm or height_mm; the file has "
            f"{', '.join(names[:10]) or 'none'}"
        )
    info = entries[candidates[0]]
    if info.compress_type not in _AS_NUMPY:
        raise TouchError(
            "not a whole .npz of numbers: an array is neither stored nor deflated, as numpy "
            "writes them; save it with numpy.savez or numpy.savez_compressed"
        )
    with archive.open(info) as file:
        head = file.read(_MAX_HEADER_BYTES)
        shape, _, dtype, _ = _header(head)
        if candidates[0].startswith("points") and (len(shape) != 2 or shape[1] != 3):
            raise TouchError(
                f"the array {candidates[0]} is a cloud by its name, and a cloud needs shape "
                f"(N, 3), got {shape}"
            )
        return head + file.read(_count(shape) * dtype.itemsize)


def _header(data: bytes) -> tuple[tuple[int, ...], bool, np.dtype[np.generic], int]:
    """Shape, order, type and start of an array of real numbers in a .npy file; none is made."""
    shape, fortran_order, dtype, start = _any_header(data)
    if dtype.kind not in "fiu":
        raise TouchError(f"expected real numbers in the .npy array, got {dtype}")
    return shape, fortran_order, dtype, start


def _any_header(data: bytes) -> tuple[tuple[int, ...], bool, np.dtype[np.generic], int]:
    """The same of an array of anything."""
    file = io.BytesIO(data[:_MAX_HEADER_BYTES])
    try:
        version = np.lib.format.read_magic(file)
        read = _ARRAY_HEADERS.get(version)
        if read is None:
            raise TouchError(f"not a whole .npy array: format {version} is not read; save it anew")
        shape, fortran_order, dtype = read(file)
    except TouchError:
        raise
    except Exception as error:  # numpy evaluates the header's text, and any error may come of it
        raise TouchError(f"not a whole .npy array of numbers: {error}") from None
    return shape, fortran_order, dtype, file.tell()


def _count(shape: tuple[int, ...]) -> int:
    """Numbers in an array of that shape."""
    if any(length < 0 for length in shape) or len(shape) > 2:
        raise TouchError(f"expected an array of shape (N, 3) or (H, W), got shape {shape}")
    count = math.prod(shape)
    if max((count, *shape)) > MAX_NUMBERS:
        raise TouchError(
            f"the header announces an array of shape {shape}; at most {MAX_NUMBERS} numbers "
            "are read"
        )
    return count
