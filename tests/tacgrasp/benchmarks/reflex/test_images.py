"""The images of drawn loads are read as the fields that they show."""

from contextlib import nullcontext

import numpy as np

from tacgrasp.benchmarks.reflex import images
from tacgrasp.benchmarks.reflex.run import image_figures
from tests.tacgrasp.benchmarks.reflex.test_reflex_figures import SLIPS


def test_images_are_read_as_the_fields_that_they_show(monkeypatch):
    monkeypatch.setattr(images, "model_beside", nullcontext)
    monkeypatch.setattr(images, "FRAMES", 4)
    result = images.measure_images("gelsight_mini_markers", [SLIPS])
    figures = image_figures(result)
    assert len(result.ms) == 4 and min(result.ms) > 0
    assert figures["markers_found"] > 0.95
    assert 0 < figures["marker_error_um"]["along"] < 10
    assert 0 < figures["marker_error_um"]["depth"] < 60


def test_no_image_has_no_figures():
    figures = image_figures(images.ImageResult())
    assert figures["image_to_markers_ms"] == {"p50": None, "p99": None}
    assert figures["marker_error_um"] == {"along": None, "depth": None}
    assert figures["markers_found"] is None


def test_errors_are_root_mean_squares():
    result = images.ImageResult(ms=[4.0], along_um=[3.0, 4.0], depth_um=[5.0], found=[1.0, 0.5])
    figures = image_figures(result)
    assert np.isclose(figures["marker_error_um"]["along"], np.sqrt(12.5))
    assert (figures["marker_error_um"]["depth"], figures["markers_found"]) == (5.0, 0.75)
