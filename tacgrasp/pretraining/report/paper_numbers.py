"""The paper's accuracies: percent right of shape, texture, depth, position and area."""

from __future__ import annotations

from collections.abc import Mapping

Five = tuple[float, float, float, float, float]

PAPER: Mapping[tuple[str, str, str], Five] = {
    ("zero_shot", "cltp_no_image", "contact"): (52.6, 65.7, 96.5, 91.9, 67.1),
    ("zero_shot", "cltp", "contact"): (70.1, 68.9, 98.3, 94.4, 81.8),
    ("probe", "point_bert", "contact"): (28.7, 89.5, 64.4, 80.8, 91.3),
    ("probe", "point_mae", "contact"): (31.6, 90.2, 68.1, 82.9, 92.6),
    ("probe", "cltp_no_image", "contact"): (61.2, 94.5, 94.7, 91.4, 94.8),
    ("probe", "cltp", "contact"): (84.8, 96.1, 99.2, 95.9, 97.1),
    ("probe", "unitouch", "contact"): (65.8, 94.7, 59.3, 85.2, 92.3),
    ("probe", "tvl", "contact"): (63.4, 95.3, 65.6, 88.9, 94.4),
    ("probe", "point_bert", "physics"): (21.9, 91.1, 52.1, 51.2, 73.4),
    ("probe", "point_mae", "physics"): (23.9, 89.2, 52.1, 55.3, 56.2),
    ("probe", "cltp_no_image", "physics"): (55.3, 90.3, 77.3, 73.8, 64.4),
    ("probe", "cltp", "physics"): (71.2, 92.7, 83.6, 81.4, 77.2),
}
"""By table, method and evaluation split. ``physics`` is compared with the paper's real set.
Source: paper, tables 1, 2 and that of appendix A."""

PAPER_TABLES: Mapping[str, tuple[str, tuple[str, ...], tuple[str, ...]]] = {
    "Table 1: zero-shot, the paper's prompt": (
        "zero_shot",
        ("cltp_no_image", "cltp"),
        ("geometric_baseline",),
    ),
    "Table 2: frozen encoder and MLP": (
        "probe",
        ("point_bert", "point_mae", "cltp_no_image", "cltp"),
        ("random", "geometric_baseline"),
    ),
    "Table A: vision-based methods (appendix A), frozen encoder and MLP": (
        "probe",
        ("unitouch", "tvl", "cltp"),
        ("geometric_baseline",),
    ),
}
"""The paper's tables: our table, the paper's methods, and our further rows."""

PAPER_RATINGS: Mapping[str, float] = {"cltp": 4.28, "point_bert": 1.73, "point_mae": 1.61}
"""Ratings of captions by GPT-4, 1 to 5, by the method that pre-trained the encoder. Source: paper,
appendix C."""
