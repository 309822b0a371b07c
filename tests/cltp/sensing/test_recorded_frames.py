"""Frames in records: small JPEG files, and refused before they are decoded when they are not."""

import io

import numpy as np
import pytest
from PIL import Image

from cltp.errors import TouchError
from cltp.sensing.frames import MAX_RECORDED_PX, frame_of_jpeg, jpeg_of


def test_a_frame_is_stored_small_and_looks_the_same():
    x, y = np.meshgrid(np.linspace(0, 255, 320), np.linspace(0, 255, 240))
    frame = np.stack([x, y, (x + y) / 2], axis=-1).astype(np.uint8)
    jpeg = jpeg_of(frame)
    assert len(jpeg) < frame.nbytes / 10
    assert np.abs(frame_of_jpeg(jpeg).astype(int) - frame).mean() < 2


def test_a_frame_that_claims_too_many_pixels_is_refused():
    file = io.BytesIO()
    Image.new("L", (8000, MAX_RECORDED_PX // 8000 + 1)).save(file, format="JPEG")
    with pytest.raises(TouchError, match="expected at most 4000000 pixels"):
        frame_of_jpeg(file.getvalue())


@pytest.mark.parametrize("data", [b"", b"hello", jpeg_of(np.zeros((99, 99, 3), np.uint8))[:300]])
def test_what_is_no_whole_jpeg_is_refused(data):
    with pytest.raises(TouchError, match="no whole JPEG"):
        frame_of_jpeg(data)
