"""``tacgrasp bench meshes``: where each mesh of a folder is grasped, and whether that grasp holds.

Each mesh is grasped by ``rules`` under the task that suits it, for a few seeds: position on
the pad, friction, stiffness and gripper are drawn as ever. What can't be grasped is listed with the
reason. Not here: the search for the grasp (``sim.grasp.antipodal``).
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from dataclasses import asdict, dataclass
from functools import partial
from pathlib import Path
from statistics import median
from typing import Any

from rich.console import Console

from cltp.errors import TouchError
from cltp.tactile.sensors import sensor_named
from sim.grasp.antipodal import GraspPlace, find_grasp
from sim.grasp.bodies import OBJECTS
from sim.grasp.mesh_bodies import ScannedObject, natural_mass_g
from sim.grasp.rig import SimRig, build
from sim.objects.meshes import SUFFIXES, checked_mesh
from tacgrasp.base.errors import UsageError
from tacgrasp.benchmarks.figures import number_table, write_figures
from tacgrasp.benchmarks.loop.contestants import informed_band
from tacgrasp.benchmarks.loop.meshes_plot import write_plot
from tacgrasp.benchmarks.loop.strawberry import EpisodeResult, run_seed
from tacgrasp.benchmarks.pool import each_result
from tacgrasp.benchmarks.settings import MeshesSettings, names_in
from tacgrasp.config.layers import load
from tacgrasp.config.schema import RunConfig
from tacgrasp.config.terms import contract_of
from tacgrasp.runtime.verify import accelerations

TASKS = ("strawberry", "egg", "peg")
"""Tasks by their forces. A mesh gets the first whose objects weigh as much and whose least force,
for its size and stiffness, holds it at the least friction; or else the last."""


@dataclass(frozen=True, slots=True, kw_only=True)
class MeshResult:
    """What became of one mesh.

    Attributes:
        path: Its file.
        task: Task that it was grasped under; empty where it was refused.
        place: Where it was grasped; None where it was refused.
        refused: Why it was refused, in one line; empty otherwise.
        mass_g: Its mass [g].
        force_n: Force band of the task [N].
        episodes: The episodes, one a seed.
    """

    path: Path
    task: str = ""
    place: GraspPlace | None = None
    refused: str = ""
    mass_g: float = 0.0
    force_n: tuple[float, float] = (0.0, 0.0)
    episodes: tuple[EpisodeResult, ...] = ()

    @property
    def held(self) -> int:
        """Number of episodes that truly held through lift and shake, without a bruise."""
        return sum(episode.verified for episode in self.episodes)

    @property
    def needed_n(self) -> float:
        """Median of the least true forces that would have held it, centred [N]."""
        return median(episode.slip_minimum_n for episode in self.episodes)

    @property
    def ends(self) -> str:
        """How the episodes ended, as words."""
        counts = Counter(map(_end, self.episodes))
        return ", ".join(f"{end} {count}" for end, count in counts.most_common())


def _end(episode: EpisodeResult) -> str:
    if episode.verified:
        return "held"
    truth = episode.truth
    for is_so, words in (
        (episode.bruised, "bruised"),
        (truth.dropped, "dropped"),
        (truth.slipped, f"slipped {truth.slip_mm:.0f} mm"),
    ):
        if is_so:
            return words
    return f"not lifted: {episode.reason}"


def run(settings: MeshesSettings) -> None:
    """Grasp every mesh, print the table and write the figures.

    Raises:
        UsageError: The folder has no meshes, or not all that are named; or an unknown task.
    """
    paths = _paths(settings)
    if settings.task is not None:
        load(settings.task)  # an error shows here
    console = Console()
    attempt = partial(_attempt, settings, paths)
    results = list(
        each_result(console, "meshes", attempt, range(len(paths)), workers=settings.workers)
    )
    _print(console, results, settings.episodes)
    if settings.plot is not None:
        write_plot(settings.plot, [(r.path, r.place, _caption(r)) for r in results])
    write_figures(settings.json, {"meshes": [_flat(result) for result in results]})


def _paths(settings: MeshesSettings) -> list[Path]:
    """Files of the meshes, in the order of their names."""
    files = [path for path in settings.data.rglob("*") if path.suffix.lower() in SUFFIXES]
    files.sort(key=lambda path: path.stem)
    if not files:
        raise UsageError(f"--data {settings.data} has no mesh ({', '.join(SUFFIXES)})")
    if settings.names is None:
        return files
    wanted = names_in(settings.names)
    unknown = [name for name in wanted if name not in {path.stem for path in files}]
    if unknown:
        raise UsageError(f"--names: {settings.data} has no mesh {', '.join(unknown)}")
    return [path for path in files if path.stem in wanted]


def _attempt(settings: MeshesSettings, paths: list[Path], index: int) -> MeshResult:
    path = paths[index]
    try:
        vertices, faces = checked_mesh(path)
        mass_g = settings.mass_g or natural_mass_g(vertices, faces)
        make = partial(build, mesh=ScannedObject(path=path, mass_g=settings.mass_g))
        config = _suited(make, mass_g) if settings.task is None else load(settings.task)[0]
        sensor = sensor_named(config.sensor)
        place = find_grasp(vertices, faces, (sensor.width_mm, sensor.height_mm))
    except TouchError as error:
        return MeshResult(path=path, refused=str(error).removeprefix(f"{path}: "))
    seeds = range(settings.first_seed, settings.first_seed + settings.episodes)
    return MeshResult(
        path=path,
        task=config.task,
        place=place,
        mass_g=mass_g,
        force_n=config.goal.force_n,
        episodes=tuple(run_seed(config, [("rules", None)], seed, make)[0] for seed in seeds),
    )


def _suited(make: Callable[..., SimRig], mass_g: float) -> RunConfig:
    """The run under the task that suits a mesh, as ``TASKS`` says."""
    for task in TASKS:
        config, ranges = load(task)[0], OBJECTS[task]
        if not ranges.mass_g.low <= mass_g <= ranges.mass_g.high:
            continue
        rig = make(config.object, 0, sensor_name=config.sensor)
        fingers = rig.grasp.fingers
        needed_n = fingers.slip_minimum_n(accelerations(config.verify))
        least_n = informed_band(contract_of(config), rig).low
        if needed_n * fingers.body.friction / ranges.friction.low <= least_n:
            return config
    return load(TASKS[-1])[0]


def _caption(result: MeshResult) -> str:
    if result.place is None:
        return result.refused
    return (
        f"{result.place.width_mm:.0f} mm wide, {result.mass_g:.0f} g, {result.task}: held "
        f"{result.held} of {len(result.episodes)}"
    )


def _flat(result: MeshResult) -> dict[str, Any]:
    if result.place is None:
        return {"name": result.path.stem, "refused": result.refused}
    return {
        "name": result.path.stem,
        "task": result.task,
        "mass_g": result.mass_g,
        "grasp": asdict(result.place),
        "held": result.held,
        "needed_n": result.needed_n,
        "ends": result.ends,
        "episodes": [asdict(episode) for episode in result.episodes],
    }


def _print(console: Console, results: list[MeshResult], episodes: int) -> None:
    columns = ["mesh", "grasp at x, y, z [mm]", "closing [°]", "width [mm]", "patches [mm²]"]
    columns += ["from centre of mass [mm]", "mass [g]", "task", "may, needs [N]", "held", "ends"]
    title = f"rules, {episodes} episodes a mesh; needs: least force that holds, in the median"
    table = number_table(title, columns, ("mesh", "task", "ends"))
    for result in results:
        if result.place is None:
            continue
        place, (low, high) = result.place, result.force_n
        table.add_row(
            result.path.stem,
            ", ".join(f"{value:.0f}" for value in place.centre_mm),
            f"{place.yaw_deg:.0f}",
            f"{place.width_mm:.1f}",
            ", ".join(f"{area:.0f}" for area in place.patch_mm2),
            f"{place.from_com_mm:.1f}",
            f"{result.mass_g:.0f}",
            result.task,
            f"{low:g}-{high:g}, {result.needed_n:.1f}",
            f"{result.held}/{len(result.episodes)}",
            result.ends,
        )
    console.print(table)
    for result in results:
        if result.place is None:
            console.print(f"{result.path.stem}: refused: {result.refused}", soft_wrap=True)
    grasped = [result for result in results if result.place is not None]
    console.print(
        f"{len(grasped)} of {len(results)} meshes have a grasp; held in "
        f"{sum(r.held for r in grasped)} of {sum(len(r.episodes) for r in grasped)} episodes"
    )
