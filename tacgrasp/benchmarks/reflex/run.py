"""``tacgrasp bench reflex``: does the reflex see slips, how soon, and what does it hold?

Each seed draws a body, a grip and a load (``sim.grasp.drawn.loads``), and a noisy unit of the
sensor. Followed once without corrections, the load is one that slips, one that holds, or one
between, for which either answer is right. Beside the reflex stand detectors without touch of shear:
always, never, and a threshold on displacement over indentation, chosen with hindsight.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

import numpy as np
from rich.console import Console

from cltp.sensing.calibration import WITHOUT_DOTS
from cltp.tactile.sensors import sensor_named
from tacgrasp.base.errors import UsageError
from tacgrasp.benchmarks.figures import number_table
from tacgrasp.benchmarks.loop.strawberry import wilson
from tacgrasp.benchmarks.reflex.images import ImageResult, measure_images
from tacgrasp.benchmarks.reflex.loads import LoadResult, run_seed
from tacgrasp.benchmarks.reflex.pace import Pace, measure_pace
from tacgrasp.benchmarks.reflex.wire import WireResult, run_wire
from tacgrasp.benchmarks.results_file import SeedResults, shear_models_sum
from tacgrasp.benchmarks.settings import ReflexSettings
from tacgrasp.console import count_progress, make_table_console, working

PACE_S, QUICK_PACE_S = 20.0, 4.0
"""Duration of the run in real time [s]."""

SENSORS = ("taxels", "gelsight_mini_markers")

COMMAND_MS, RECALL, PRECISION = 10.0, 0.95, 0.99

IMAGE_MS = 15.0
"""Largest image_to_markers_ms.p99."""

IMAGE_LOADS, QUICK_IMAGE_LOADS = 20, 2
"""Loads whose images are read."""

WIRE_MS = 45.0
"""Largest wire_slip_to_command_ms.p99: that of taxels without a wire, and a gripper's poll."""


def delay_limit_ms(sensor_name: str) -> float:
    """Largest slip_to_command_ms.p99: 30 ms with taxels, two periods and 25 ms with a camera."""
    sensor = sensor_named(sensor_name)
    return 30.0 if sensor.frame_hz >= 100 else 2000.0 / sensor.frame_hz + 25.0


def run(settings: ReflexSettings) -> bool:
    """Run the benchmark, print its tables and write its figures.

    Returns:
        Whether all limits are kept.

    Raises:
        UsageError: The sensor measures no shear, or a file with figures of something else.
    """
    if settings.sensor not in SENSORS:
        raise UsageError(f"bench reflex needs --sensor {' or '.join(SENSORS)}")
    seeds, console = settings.seeds, make_table_console()
    about = {
        "benchmark": "reflex",
        "sensor": settings.sensor,
        "first_seed": settings.first_seed,
        "shear_models": shear_models_sum(),
    }
    store = SeedResults(path=settings.json, about=about)
    store.read(resume=settings.resume)
    function = partial(run_seed, settings.sensor)
    found = store.map_seeds(console, "loads", LoadResult | None, function, seeds)
    results = [each for each in found if each is not None]
    if not results:
        raise UsageError("no load could be drawn; take more --episodes")
    with working("timing the reflex beside a language model"):
        pace = measure_pace(settings.sensor, seeds[0], QUICK_PACE_S if settings.quick else PACE_S)
    images = None
    if settings.sensor in WITHOUT_DOTS:
        count = QUICK_IMAGE_LOADS if settings.quick else IMAGE_LOADS
        with working("reading images beside a language model"):
            images = measure_images(settings.sensor, seeds[:count])
    wire = _through_wire(console, settings.wire_seeds)
    figures = summary(settings.sensor, results, pace, wire, images)
    _print(console, settings, figures)
    store.write(figures)
    return bool(figures["keeps_limits"])


def _through_wire(console: Console, seeds: range) -> list[WireResult]:
    if not seeds:
        return []
    with count_progress(console) as progress:
        task = progress.add_task("loads through the wire", total=len(seeds))
        return run_wire(seeds, lambda _: progress.advance(task))


def summary(
    sensor_name: str,
    results: Sequence[LoadResult],
    pace: Pace,
    wire: Sequence[WireResult] = (),
    images: ImageResult | None = None,
) -> dict[str, Any]:
    """All figures of a sensor; quantiles of nothing are None."""
    command = _quantiles(pace.command_ms)
    delays = [each.delay_ms for each in results if each.delay_ms is not None and each.slips]
    added_ms = command["p50"] or 0.0
    slip_to_command = _quantiles([delay + added_ms for delay in delays])
    scores = detector(results, lambda each: each.called, lambda each: each.early)
    figures: dict[str, Any] = {
        "sensor": sensor_name,
        "loads": len(results),
        "rate_hz": _rates(pace.interval_ms),
        "command_ms": command,
        "late_ms": _quantiles(pace.late_ms),
        "language_model_decisions": pace.decisions,
        "slip_to_command_ms": slip_to_command,
        **scores,
        "detectors": {
            "always": detector(results, lambda each: True, lambda each: False),
            "never": detector(results, lambda each: False, lambda each: False),
            "ratio alone": best_threshold(results),
        },
        "by_noise": by_noise(results),
        "kept": kept(results),
        **wire_figures(wire, results),
        **image_figures(images or ImageResult()),
    }
    figures["keeps_limits"] = _keeps(sensor_name, figures)
    return figures


def detector(
    results: Sequence[LoadResult],
    called: Callable[[LoadResult], bool],
    early: Callable[[LoadResult], bool],
) -> dict[str, Any]:
    """Recall, precision and counts of a detector; a call that came early is a false alarm."""
    slips = [each for each in results if each.slips]
    right = sum(called(each) and not early(each) for each in slips)
    false = sum(called(each) and (early(each) or each.holds) for each in results)
    between = [each for each in results if not each.slips and not each.holds]
    return {
        "recall": right / len(slips) if slips else None,
        "recall_interval": wilson(right, len(slips)) if slips else None,
        "precision": right / (right + false) if right + false else None,
        "precision_interval": wilson(right, right + false) if right + false else None,
        "slips": len(slips),
        "holds": sum(each.holds for each in results),
        "between": len(between),
        "between_called": sum(called(each) for each in between),
        "false_alarms": false,
    }


def best_threshold(results: Sequence[LoadResult]) -> dict[str, Any]:
    """The threshold of displacement over indentation with the best F1, known afterwards."""

    def f1(scores: dict[str, Any]) -> float:
        recall, precision = scores["recall"] or 0.0, scores["precision"] or 0.0
        return 2 * recall * precision / (recall + precision) if recall + precision else 0.0

    ratios = sorted({round(each.largest_ratio, 2) for each in results})
    scored = [
        detector(results, lambda each, at=at: each.largest_ratio > at, lambda each: False)  # type: ignore[misc]
        | {"threshold": at}
        for at in ratios
    ]
    return max(scored, key=f1)


def by_noise(results: Sequence[LoadResult]) -> list[dict[str, Any]]:
    """Recall and precision of the quietest, the middle and the noisiest third of the units."""
    ordered = sorted(results, key=lambda each: each.noise_mm)
    thirds = [list(part) for part in np.array_split(np.array(ordered, dtype=object), 3)]
    return [
        {"noise_um": [1e3 * third[0].noise_mm, 1e3 * third[-1].noise_mm]}
        | detector(third, lambda each: each.called, lambda each: each.early)
        for third in thirds
        if third
    ]


def kept(results: Sequence[LoadResult]) -> dict[str, Any]:
    """What became of the loads that slip by a millimetre when nothing is corrected."""
    lost = [each for each in results if each.slid_mm >= 1.0]
    return {
        "slipped_1_mm_alone": len(lost),
        "slipped_1_mm_with_reflex": sum(each.slid_kept_mm >= 1.0 for each in lost),
        "gone_alone": sum(each.gone for each in results),
        "gone_with_reflex": sum(each.gone_kept for each in results),
        "slide_mm_alone": _quantiles([each.slid_mm for each in lost]),
        "slide_mm_with_reflex": _quantiles([each.slid_kept_mm for each in lost]),
        "force_factor": _quantiles([each.force_factor for each in results]),
    }


def wire_figures(wire: Sequence[WireResult], results: Sequence[LoadResult]) -> dict[str, Any]:
    """Times through the wire, and those of the same loads without one."""
    delayed = [each for each in wire if each.delay_ms is not None]
    alone = {each.seed: each.delay_ms for each in results}
    both = [delay for each in delayed if (delay := alone.get(each.seed)) is not None]
    return {
        "wire_loads": len(wire),
        "wire_slides": sum(each.slid for each in wire),
        "wire_slip_to_command_ms": _quantiles([each.delay_ms or 0.0 for each in delayed]),
        "wire_without_ms": _quantiles(both),
        "wire_command_ms": _quantiles([ms for each in wire for ms in each.command_ms]),
        "wire_step_ms": _quantiles([each.largest_step_ms for each in wire]),
        "wire_blind": sum(each.num_blind for each in wire),
    }


def image_figures(images: ImageResult) -> dict[str, Any]:
    """Times from an image to its markers, and how far off these are."""
    return {
        "image_to_markers_ms": _quantiles(images.ms),
        "marker_error_um": {
            "along": _root_mean_square(images.along_um),
            "depth": _root_mean_square(images.depth_um),
        },
        "markers_found": float(np.mean(images.found)) if images.found else None,
    }


def _root_mean_square(values: Sequence[float]) -> float | None:
    return float(np.sqrt(np.mean(np.square(values)))) if len(values) else None


def _quantiles(values: Sequence[float]) -> dict[str, float | None]:
    if not len(values):
        return {"p50": None, "p99": None}
    p50, p99 = np.percentile(values, [50, 99])
    return {"p50": float(p50), "p99": float(p99)}


def _rates(interval_ms: Sequence[float]) -> dict[str, float | None]:
    """Corrections a second: in the median, and in the slowest hundredth of the intervals."""
    return {
        name: None if each is None else 1e3 / each for name, each in _quantiles(interval_ms).items()
    }


def _keeps(sensor_name: str, figures: dict[str, Any]) -> bool:
    command, delay = figures["command_ms"]["p99"], figures["slip_to_command_ms"]["p99"]
    recall, precision = figures["recall"], figures["precision"]
    if None in (command, delay, recall, precision):
        return False
    is_fast = command <= COMMAND_MS and delay <= delay_limit_ms(sensor_name)
    wire = figures["wire_slip_to_command_ms"]["p99"]
    image = figures["image_to_markers_ms"]["p99"]
    is_fast = is_fast and (wire is None or wire <= WIRE_MS)
    is_fast = is_fast and (image is None or image <= IMAGE_MS)
    return bool(is_fast and recall >= RECALL and precision >= PRECISION)


def _print(console: Console, settings: ReflexSettings, figures: dict[str, Any]) -> None:
    table = number_table(
        f"{figures['loads']} loads, {settings.sensor}, seeds from {settings.first_seed:,}: "
        f"{figures['slips']} slip, {figures['holds']} hold, {figures['between']} between",
        ("detector", "recall", "precision", "false alarms", "called between"),
        text=("detector",),
    )
    rows = [("reflex", figures), *figures["detectors"].items()]
    for third in figures["by_noise"]:
        low, high = third["noise_um"]
        rows.append((f"reflex, noise {low:.1f}-{high:.1f} µm", third))
    for name, row in rows:
        shown = [_percent(row[each], row[f"{each}_interval"]) for each in ("recall", "precision")]
        table.add_row(name, *shown, str(row["false_alarms"]), str(row["between_called"]))
    table.add_row("limit", f">= {100 * RECALL:g} %", f">= {100 * PRECISION:g} %", "", "")
    console.print(table)
    times = number_table("times", ("", "p50", "p99", "limit of p99"))
    limits = {
        "command_ms": COMMAND_MS,
        "slip_to_command_ms": delay_limit_ms(settings.sensor),
        "wire_slip_to_command_ms": WIRE_MS,
        "image_to_markers_ms": IMAGE_MS,
    }
    names = ["rate_hz", "command_ms", "late_ms", "slip_to_command_ms"]
    if figures["markers_found"] is not None:
        names.append("image_to_markers_ms")
    if figures["wire_loads"]:
        names += [f"wire_{each}_ms" for each in ("slip_to_command", "without", "command", "step")]
    for name in names:
        cells = ["-" if v is None else f"{v:.1f}" for v in figures[name].values()]
        times.add_row(name, *cells, f"{limits[name]:g}" if name in limits else "")
    console.print(times)
    if figures["wire_loads"]:
        console.print(
            f"through the wire: {figures['wire_loads']} loads, {figures['wire_slides']} slid, "
            f"{figures['wire_blind']} moments without a reading; wire_without_ms: the same loads "
            "without a wire; wire_command_ms: from a frame to the registers; wire_step_ms: the "
            "longest step of each emulated body"
        )
    if figures["markers_found"] is not None:
        error = figures["marker_error_um"]
        console.print(
            f"images: {100 * figures['markers_found']:.1f} % of the points read; displacement off "
            f"by {error['along']:.1f} µm along the gel, {error['depth']:.1f} µm into it (root mean "
            "square)"
        )
    became = figures["kept"]
    console.print(
        f"{became['slipped_1_mm_alone']} loads slip 1 mm or more when nothing is corrected, "
        f"{became['slipped_1_mm_with_reflex']} of them with the reflex; "
        f"{became['gone_alone']} leave the grip, {became['gone_with_reflex']} with it; largest "
        f"force over the grip's {became['force_factor']['p50']:.2f} (median), "
        f"{became['force_factor']['p99']:.2f} (99 %); "
        f"{figures['language_model_decisions']} decisions of the language model beside"
    )


def _percent(value: float | None, interval: Sequence[float] | None) -> str:
    if value is None or interval is None:
        return "-"
    return f"{100 * value:.1f} % [{100 * interval[0]:.1f}, {100 * interval[1]:.1f}]"
