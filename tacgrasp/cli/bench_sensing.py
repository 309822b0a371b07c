"""``tacgrasp bench gel|contact|touch|balls|ball-captions``: the gel, and what is read from its shape."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from tacgrasp.base.errors import UsageError
from tacgrasp.cli.flags import writable


@dataclass(frozen=True)
class GelBenchFlags:
    """Compare the simulated gel with closed forms and, if given, with profiles of real presses.

    Attributes:
        data: Folder with radial profiles of real ball presses (profile_<diameter>mm.csv).
            Default: real presses are not compared.
        json: File to write the figures to.
    """

    data: Path | None = None
    json: Path | None = None


def gel(flags: GelBenchFlags) -> None:
    """Run the benchmark of the gel."""
    from tacgrasp.benchmarks.sensing import gel as benchmark

    benchmark.run(_folder(flags.data), writable(flags.json))


@dataclass(frozen=True)
class ContactBenchFlags:
    """Count false contacts in air and missed light contacts; exit code 1 with too many false ones.

    Attributes:
        closings: Number of closings in air, two seconds each.
        bodies: Number of bodies of each kind, two positions each.
        json: File to write the figures to.
    """

    closings: int = 1200
    bodies: int = 150
    json: Path | None = None


def contact(flags: ContactBenchFlags) -> bool:
    """Run the benchmark of the contact test."""
    if min(flags.closings, flags.bodies) < 1:
        raise UsageError("--closings and --bodies must be at least 1")
    json_path = writable(flags.json)
    from tacgrasp.benchmarks.sensing import contact as benchmark

    return benchmark.run(flags.closings, flags.bodies, json_path)


@dataclass(frozen=True)
class TouchBenchFlags:
    """Compare the direct measurement of contacts with the truth of simulated grasps.

    Attributes:
        bodies: Number of bodies of each kind, four grasps each.
        json: File to write the figures to.
    """

    bodies: int = 60
    json: Path | None = None


def touch(flags: TouchBenchFlags) -> None:
    """Run the benchmark of direct measurement."""
    if flags.bodies < 1:
        raise UsageError("--bodies must be at least 1")
    from tacgrasp.benchmarks.sensing import touch as benchmark

    benchmark.run(flags.bodies, writable(flags.json))


@dataclass(frozen=True)
class BallsBenchFlags:
    """Measure how right the heights of real GelSight Mini frames of a pressed ball are.

    Attributes:
        data: Folder of the frames.
        diameter_mm: Diameter of the ball [mm].
        background: Frame of the untouched gel. Default: background.png in the folder.
        folds: Number of calibrations; each leaves its part of the presses out. 44 takes minutes.
        bare_sphere: Calibrate on the sphere alone, without the gel's profile around it.
        json: File to write the figures to.
    """

    data: Path
    diameter_mm: float = 6.31
    background: Path | None = None
    folds: int = 11
    bare_sphere: bool = False
    json: Path | None = None


def balls(flags: BallsBenchFlags) -> bool:
    """Run the benchmark of real heights."""
    if not 1.0 <= flags.diameter_mm <= 100.0 or flags.folds < 2:
        raise UsageError("--diameter-mm must be 1 to 100 and --folds at least 2")
    from tacgrasp.benchmarks.sensing import balls as benchmark

    return benchmark.run(
        flags.data,
        diameter_mm=flags.diameter_mm,
        background=flags.background,
        folds=flags.folds,
        bare_sphere=flags.bare_sphere,
        json_path=writable(flags.json),
    )


@dataclass(frozen=True)
class BallCaptionsBenchFlags:
    """Print and score what the model says about real GelSight Mini frames of a pressed ball.

    Attributes:
        data: Folder of the frames.
        weights: Folder of weights. Default: TACGRASP_WEIGHTS, else the shipped weights.
        diameter_mm: Diameter of the ball [mm].
        background: Frame of the untouched gel. Default: background.png in the folder.
        calibration: Calibration of the unit. Default: the shipped one, which was made from presses
            of a 6.31 mm ball on one unit.
        folds: Number of calibrations; each leaves its part of the presses out. 0: none is made.
        json: File to write the figures to.
    """

    data: Path
    weights: Path | None = None
    diameter_mm: float = 6.31
    background: Path | None = None
    calibration: Path | None = None
    folds: int = 0
    json: Path | None = None


def ball_captions(flags: BallCaptionsBenchFlags) -> None:
    """Run the benchmark of captions of real frames."""
    if not 1.0 <= flags.diameter_mm <= 100.0 or flags.folds < 0 or flags.folds == 1:
        raise UsageError("--diameter-mm must be 1 to 100 and --folds 0 or at least 2")
    if flags.folds and flags.calibration is not None:
        raise UsageError("--folds makes its own calibrations: give either it or --calibration")
    from tacgrasp.benchmarks.sensing import ball_captions as benchmark
    from tacgrasp.policy_factory import default_weights

    benchmark.run(
        flags.data,
        weights=flags.weights or default_weights(),
        diameter_mm=flags.diameter_mm,
        background=flags.background,
        calibration=flags.calibration,
        folds=flags.folds,
        json_path=writable(flags.json),
    )


def _folder(path: Path | None) -> Path | None:
    if path is not None and not path.is_dir():
        raise UsageError(f"--data {path} is not a folder")
    return path
