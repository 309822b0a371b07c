"""Settings of every benchmark; ``tacgrasp bench`` reads its flags into them.

Imports nothing heavy, so that ``tacgrasp bench NAME --help`` answers at once.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import tyro

from tacgrasp.base.errors import UsageError


def names_in(text: str) -> list[str]:
    """Names in a list that is separated by commas, each once."""
    return list(dict.fromkeys(name.strip() for name in text.split(",")))


@dataclass(frozen=True, kw_only=True)
class BenchmarkSettings:
    """What every benchmark takes.

    Attributes:
        json: File to write the figures to.
    """

    json: Path | None = None


@dataclass(frozen=True, kw_only=True)
class ModelBenchmarkSettings(BenchmarkSettings):
    """What every benchmark with a language model takes.

    Attributes:
        weights: Folder of llm's weights. Default: TACGRASP_WEIGHTS, else the shipped weights.
    """

    weights: Path | None = None


QUICK_SEEDS = 8
"""Number of seeds with ``--quick``."""


@dataclass(frozen=True, kw_only=True)
class ResumableSettings(BenchmarkSettings):
    """What a benchmark takes that goes on after it was ended.

    Attributes:
        json: File to write the figures to, after every few seeds.
        quick: Take 8 seeds, to try it.
        resume: Go on with the figures in the file of --json, if settings and weights are the same.
    """

    quick: bool = False
    resume: bool = False

    def __post_init__(self) -> None:
        if self.resume and self.json is None:
            raise UsageError("--resume needs --json, the file of the figures to go on with")


@dataclass(frozen=True, kw_only=True)
class SeedSettings(ResumableSettings):
    """What a benchmark takes that runs the same for each seed.

    Attributes:
        episodes: Number of random seeds.
        first_seed: First seed. Seeds from 1000000 on are kept for benchmarks.
    """

    episodes: int = 200
    first_seed: int = 1_000_000

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.episodes < 1 or self.first_seed < 0:
            raise UsageError("--episodes must be at least 1 and --first-seed at least 0")

    @property
    def seeds(self) -> range:
        """All seeds, or the first few with --quick."""
        count = min(QUICK_SEEDS, self.episodes) if self.quick else self.episodes
        return range(self.first_seed, self.first_seed + count)


@dataclass(frozen=True, kw_only=True)
class StrawberrySettings(ModelBenchmarkSettings, SeedSettings):
    """Grasp many simulated bodies with each policy, and count how the grasps end.

    Attributes:
        task: Task of the grasps.
        object: Object between the fingers; none: the task's.
        instruction: Instruction; none: the task's.
        policies: Names of the policies, separated by commas: rules, llm, fixed_force, random,
            true_force, center_only, force_only, informed, oracle. The last five run here alone.
    """

    task: str = "strawberry"
    object: str | None = None
    instruction: str | None = None
    policies: str = "rules,fixed_force,true_force,center_only,force_only,informed,random,oracle"


@dataclass(frozen=True, kw_only=True)
class MissedSettings(ModelBenchmarkSettings, SeedSettings):
    """Close the fingers beside the berry, and count what follows; exit code 1 off the targets.

    As many ordinary episodes of the same seeds show how often a berry that is touched is reset.

    Attributes:
        episodes: Number of missed and of ordinary episodes, one random seed each.
        policies: Names of the policies, separated by commas.
    """

    policies: str = "llm,rules"


@dataclass(frozen=True, kw_only=True)
class LimitsSettings(ModelBenchmarkSettings, SeedSettings):
    """Draw a fault into each episode; the hard limit must hold; exit code 1 when it does not.

    The same faults without contract and reflex stand beside the figures. With --json each failing
    episode is kept in a folder beside that file.

    Attributes:
        episodes: Number of episodes, one random seed and one fault each.
        task: Task of the grasps.
        sensor: Sensor that feels: taxels, gelsight_mini_markers, or gelsight_mini, with which no
            reflex runs.
        policy: Policy that decides where the fault is not the policy's: rules or llm.
        keep: Folder for the failing episodes; none: that of --json, with '-failing' in its name.
    """

    episodes: int = 2000
    task: str = "strawberry"
    sensor: str = "taxels"
    policy: str = "rules"
    keep: Path | None = None

    @property
    def failing_folder(self) -> Path:
        """Folder for the failing episodes."""
        if self.keep is not None:
            return self.keep
        base = Path("limits") if self.json is None else self.json
        return base.with_name(f"{base.stem}-failing")


@dataclass(frozen=True, kw_only=True)
class GentleSettings(ModelBenchmarkSettings, SeedSettings):
    """Hold fruit that bruise within 40 % of what touch can tell: firmly enough, and no more.

    Attributes:
        episodes: Number of fruit, one random seed each; every arm grasps the same ones.
        sensor: Sensor that feels slip: taxels or gelsight_mini_markers.
        arms: Names of the arms, separated by commas: llm, gentle, firm, reflex_off,
            touch_blanked, language_off, constant, centring, oracle. Default: all.
    """

    episodes: int = 300
    sensor: str = "taxels"
    arms: str = ""

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.sensor not in ("taxels", "gelsight_mini_markers"):
            raise UsageError(
                "--sensor must be taxels or gelsight_mini_markers, which measure shear for the "
                f"reflex, got {self.sensor!r}"
            )


@dataclass(frozen=True, kw_only=True)
class ReflexSettings(SeedSettings):
    """Load held bodies until some slip; see when the reflex says so; exit code 1 off the limits.

    A language model decides beside the part that is timed.

    Attributes:
        sensor: Sensor that measures shear: taxels or gelsight_mini_markers.
        episodes: Number of loads, one random seed each.
        wire: Number of loads, of the first seeds, that are followed through emulated serial wires
            too, in real time; 0 for none. Of taxels alone.
    """

    sensor: str = "taxels"
    episodes: int = 2000
    wire: int = 100

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.wire < 0:
            raise UsageError(f"--wire must be 0 or more, got {self.wire}")

    @property
    def wire_seeds(self) -> range:
        """Seeds of the loads through the wire."""
        return self.seeds[: self.wire] if self.sensor == "taxels" else range(0)


@dataclass(frozen=True, kw_only=True)
class GainSettings(SeedSettings):
    """Estimate the gripper's force gain over some grips; exit code 1 off the limits.

    Attributes:
        task: Task whose object is gripped.
        sensor: Sensor that feels it.
        episodes: Number of rigs, one random seed each.
    """

    task: str = "strawberry"
    sensor: str = "gelsight_mini"
    episodes: int = 100


@dataclass(frozen=True, kw_only=True)
class MeshesSettings(BenchmarkSettings):
    """Find a grasp on every mesh of a folder, and try it with rules in simulated episodes.

    Attributes:
        data: Folder of the meshes [mm, +z up]; folders in it are searched too.
        names: Names of the meshes, without suffix, separated by commas. Default: all.
        task: Task of every grasp. Default: strawberry, egg or peg, by mass and force.
        mass_g: Mass of every mesh [g]. Default: from its volume, 0.3 g/cm³.
        episodes: Number of episodes a mesh, one random seed each.
        first_seed: First seed. Seeds from 1000000 on are kept for benchmarks.
        plot: PNG file to draw the meshes and their grasps to.
        workers: Number of processes. Default: one a core.
    """

    data: Path
    names: str | None = None
    task: str | None = None
    mass_g: float | None = None
    episodes: int = 3
    first_seed: int = 1_000_000
    plot: Path | None = None
    workers: int | None = None

    def __post_init__(self) -> None:
        if self.episodes < 1 or self.first_seed < 0:
            raise UsageError("--episodes must be at least 1 and --first-seed at least 0")
        if self.workers is not None and self.workers < 1:
            raise UsageError(f"--workers must be at least 1, got {self.workers}")
        if self.mass_g is not None and not 0.1 <= self.mass_g <= 5000:
            raise UsageError(f"--mass-g must be 0.1 to 5000 g, got {self.mass_g:g}")
        if not self.data.is_dir():
            raise UsageError(f"--data {self.data} is no folder")


@dataclass(frozen=True, kw_only=True)
class DrawsSettings(BenchmarkSettings):
    """Show what the seeds draw: masses, stiffnesses, forces that hold and that bruise.

    Attributes:
        episodes: Number of bodies of each kind, one random seed each.
        first_seed: First seed. Seeds from 1000000 on are kept for benchmarks.
        plot: PNG file to draw the histograms to.
    """

    episodes: int = 200
    first_seed: int = 1_000_000
    plot: Path | None = None

    def __post_init__(self) -> None:
        if self.episodes < 1 or self.first_seed < 0:
            raise UsageError("--episodes must be at least 1 and --first-seed at least 0")

    @property
    def seeds(self) -> range:
        """All seeds."""
        return range(self.first_seed, self.first_seed + self.episodes)


@dataclass(frozen=True, kw_only=True)
class VerifierSettings(SeedSettings):
    """Count false alarms and missed slips of 2 mm of the verification by touch.

    Attributes:
        episodes: Number of bodies of each kind, one random seed each.
    """

    episodes: int = 400


@dataclass(frozen=True, kw_only=True)
class RobustnessSettings(ModelBenchmarkSettings, ResumableSettings):
    """Measure what is right, and what is grasped, under each nuisance of a sensor at each level.

    The table is long: choose subjects and nuisances to make it in parts, with --resume.

    Attributes:
        json: File to write the figures to, after every condition.
        data: Data set whose test split is read. Default: contacts are pressed for the purpose.
        contacts: Number of contacts that heads and captions read in each cell.
        episodes: Number of episodes in each cell of the policies, one random seed each.
        first_seed: First seed of the episodes. Seeds from 1000000 on are kept for benchmarks.
        task: Task of the grasps.
        subjects: What is measured: heads, captions, rules, llm, fixed_force, separated by commas.
        nuisances: Names of the nuisances, separated by commas. Default: all.
        workers: Number of processes. Default: one a core.
        quick: Take 40 contacts and 4 episodes, to try it.
        plot: File (.png) to draw the figures to.
    """

    data: Path | None = None
    contacts: int = 500
    episodes: int = 200
    first_seed: int = 1_000_000
    task: str = "strawberry"
    subjects: str = "heads,captions,rules,llm"
    nuisances: str = ""
    workers: int | None = None
    plot: Path | None = None

    def __post_init__(self) -> None:
        super().__post_init__()
        if min(self.contacts, self.episodes, self.workers or 1) < 1 or self.first_seed < 0:
            raise UsageError(
                "--contacts, --episodes and --workers must be at least 1, --first-seed at least 0"
            )


@dataclass(frozen=True, kw_only=True)
class OtherSimSettings(ModelBenchmarkSettings):
    """Read contacts of another simulator, clean and noisy, zero-shot and by the state heads.

    Attributes:
        data: Data set, or folder with labels.csv and heights [mm], that is read in the place of
            the second generator's contacts (docs/data-tools.md says what it holds).
        sensor: Sensor of the contacts.
        contacts: Number of contacts.
        first_seed: Random seed of the first contact; each has its own. With --data: of the noise.
        quick: Take 95 contacts, five of each shape, to try it.
        sheet: File (.png) for pictures of the first 60 contacts with their labels.
    """

    data: Path | None = None
    sensor: str = "gelsight_mini"
    contacts: int = 608
    first_seed: int = 1_000_000
    quick: bool = False
    sheet: Path | None = None

    def __post_init__(self) -> None:
        if self.contacts < 1 or self.first_seed < 0:
            raise UsageError("--contacts must be at least 1 and --first-seed at least 0")
        if self.data is not None and not self.data.is_dir():
            raise UsageError(f"--data {self.data} is not a folder")


@dataclass(frozen=True, kw_only=True)
class SoakSettings(BenchmarkSettings):
    """Run recorded episodes in one process, one by one; exit code 1 if memory or open files grow.

    With --json a later call with the same file goes on, so that a soak can be made in parts.

    Attributes:
        episodes: Number of episodes in total, those of earlier calls included.
        policy: Policy that decides.
        task: Task of every episode.
        first_seed: Random seed of the first episode; each has its own.
    """

    episodes: int = 1000
    policy: str = "rules"
    task: str = "strawberry"
    first_seed: int = 2_000_000

    def __post_init__(self) -> None:
        if self.episodes < 1 or self.first_seed < 0:
            raise UsageError("--episodes must be at least 1 and --first-seed at least 0")


@dataclass(frozen=True, kw_only=True)
class ContactSettings(ResumableSettings):
    """Count false contacts in air and missed light contacts; exit code 1 with too many false ones.

    Attributes:
        closings: Number of closings in air, two seconds each.
        first_seed: First random seed of the closings. The limits of the test were chosen on seeds
            below 10000.
        bodies: Number of bodies of each kind, two positions each.
        quick: Take 24 closings and 8 bodies of each kind, to try it.
    """

    closings: int = 1200
    first_seed: int = 10_000
    bodies: int = 150

    def __post_init__(self) -> None:
        super().__post_init__()
        if min(self.closings, self.bodies) < 1 or self.first_seed < 0:
            raise UsageError("--closings and --bodies must be at least 1, --first-seed at least 0")

    @property
    def num_closings(self) -> int:
        """Number of closings, a few at each level of the noise with --quick."""
        return min(3 * QUICK_SEEDS, self.closings) if self.quick else self.closings

    @property
    def num_bodies(self) -> int:
        """Number of bodies of each kind, a few with --quick."""
        return min(QUICK_SEEDS, self.bodies) if self.quick else self.bodies


@dataclass(frozen=True, kw_only=True)
class LatencySettings(ModelBenchmarkSettings):
    """Time one step of a policy, stage by stage: from the cloud to the complete decision.

    Attributes:
        ticks: Number of steps to time.
        contacts: Number of contacts that are felt in turn. The language model also replies to each
            without its draft, and the replies are compared.
        policy: Policy to time. For llm, the arithmetic floor and plain decoding are timed too.
        task: Task whose goal and instruction the policy is given.
    """

    ticks: int = 200
    contacts: int = 60
    policy: Annotated[str, tyro.conf.arg(aliases=["--policies"])] = "rules"
    task: str = "strawberry"

    def __post_init__(self) -> None:
        for name in ("ticks", "contacts"):
            if getattr(self, name) < 1:
                raise UsageError(f"--{name} must be at least 1, got {getattr(self, name)}")


@dataclass(frozen=True, kw_only=True)
class ServeSettings(BenchmarkSettings):
    """Measure one policy server that 1, 4 and 16 robots ask at once.

    Attributes:
        policy: Policy that is served.
        seconds: Time for each number of robots [s].
    """

    policy: str = "llm"
    seconds: float = 20.0

    def __post_init__(self) -> None:
        if not 0.5 <= self.seconds <= 3600:
            raise UsageError(f"--seconds must be 0.5 to 3600, got {self.seconds}")


@dataclass(frozen=True, kw_only=True)
class RigsSettings(ModelBenchmarkSettings):
    """Run the same seeds on the simulated and the emulated rig; exit code 1 if too few agree.

    Attributes:
        seeds: Number of seeds.
        first_seed: First seed.
        policy: Policy that decides: rules or llm.
        parallel: Number of emulated rigs that run side by side.
        json: File to write the ends of all episodes to.
    """

    seeds: int = 50
    first_seed: int = 0
    policy: str = "rules"
    parallel: int = 2

    def __post_init__(self) -> None:
        if min(self.seeds, self.parallel) < 1 or self.first_seed < 0:
            raise UsageError(
                "--seeds and --parallel must be at least 1 and --first-seed at least 0"
            )


@dataclass(frozen=True, kw_only=True)
class DriversSettings(BenchmarkSettings):
    """Time the drivers on the emulated rig: period of supervision, delay of commands and readings.

    Attributes:
        minutes: Duration of the measurement [min].
    """

    minutes: float = 10.0

    def __post_init__(self) -> None:
        if not 0.01 <= self.minutes <= 600:
            raise UsageError(f"--minutes must be 0.01 to 600, got {self.minutes:g}")


@dataclass(frozen=True, kw_only=True)
class FaultsSettings(BenchmarkSettings):
    """Inject each fault into the emulated rig; exit code 1 if one is not dealt with as it must be.

    Attributes:
        repeats: Number of injections of each fault.
        only: Part of the names of the faults to inject. Default: all faults.
        markdown: File to write the table to, in the form of docs/faults.md.
        load: Keep all processor cores busy with child processes; the arm must then be at rest
            within 250 ms instead of 150.
        fault_free: Number of short episodes to run without any fault, in place of the injections;
            each fault among them is spurious. An earlier file of --json is gone on with.
    """

    repeats: int = 20
    only: str = ""
    markdown: Path | None = None
    load: bool = False
    fault_free: int = 0

    def __post_init__(self) -> None:
        if self.fault_free < 0:
            raise UsageError(f"--fault-free must be 0 or more episodes, got {self.fault_free}")


@dataclass(frozen=True, kw_only=True)
class GelSettings(BenchmarkSettings):
    """Compare the simulated gel with closed forms and, if given, with profiles of real presses.

    Attributes:
        data: Folder with radial profiles of real ball presses (profile_<diameter>mm.csv).
            Default: real presses are not compared.
    """

    data: Path | None = None

    def __post_init__(self) -> None:
        if self.data is not None and not self.data.is_dir():
            raise UsageError(f"--data {self.data} is not a folder")


@dataclass(frozen=True, kw_only=True)
class TouchSettings(BenchmarkSettings):
    """Compare the direct measurement of contacts with the truth of simulated grasps.

    Attributes:
        bodies: Number of bodies of each kind, four grasps each.
        untouched: Number of nearly untouched frames, one random seed each from 5000 on.
    """

    bodies: int = 60
    untouched: int = 1000

    def __post_init__(self) -> None:
        if min(self.bodies, self.untouched) < 1:
            raise UsageError("--bodies and --untouched must be at least 1")


@dataclass(frozen=True, kw_only=True)
class GrowthSettings(BenchmarkSettings):
    """Compare the force that a reflex feels in one frame with the truth of simulated contacts.

    Attributes:
        contacts: Number of contacts, one random seed each.
        first_seed: First seed. Seeds from 1000000 on are kept for benchmarks.
        sensor: Sensor that measures shear: taxels or gelsight_mini_markers.
    """

    contacts: int = 300
    first_seed: int = 1_000_000
    sensor: str = "taxels"

    def __post_init__(self) -> None:
        if self.contacts < 1:
            raise UsageError("--contacts must be at least 1")


@dataclass(frozen=True, kw_only=True)
class BallsSettings(BenchmarkSettings):
    """Measure how right the heights of real GelSight Mini frames of a pressed ball are.

    Attributes:
        data: Folder of the frames.
        diameter_mm: Diameter of the ball [mm].
        background: Frame of the untouched gel. Default: background.png in the folder.
        folds: Number of calibrations; each leaves its part of the presses out. 44 takes minutes.
        bare_sphere: Calibrate on the sphere alone, without the gel's profile around it.
    """

    data: Path
    diameter_mm: float = 6.31
    background: Path | None = None
    folds: int = 11
    bare_sphere: bool = False

    def __post_init__(self) -> None:
        if not 1.0 <= self.diameter_mm <= 100.0 or self.folds < 2:
            raise UsageError("--diameter-mm must be 1 to 100 and --folds at least 2")


@dataclass(frozen=True, kw_only=True)
class BallCurveSettings(BenchmarkSettings):
    """Measure how many presses of a ball a calibration of a GelSight Mini needs.

    Attributes:
        data: Folder of the frames.
        diameter_mm: Diameter of the ball [mm].
        background: Frame of the untouched gel. Default: background.png in the folder.
        presses: Numbers of presses to calibrate on.
        subsets: Random subsets of each size.
        seed: Random seed of the subsets and of the calibrations.
        plot: PNG file to draw the curve to.
    """

    data: Path
    diameter_mm: float = 6.31
    background: Path | None = None
    presses: tuple[int, ...] = (8, 12, 20, 33)
    subsets: int = 5
    seed: int = 0
    plot: Path | None = None

    def __post_init__(self) -> None:
        if not 1.0 <= self.diameter_mm <= 100.0 or self.subsets < 1:
            raise UsageError("--diameter-mm must be 1 to 100, --subsets at least 1")


@dataclass(frozen=True, kw_only=True)
class BallGainsSettings(BenchmarkSettings):
    """Measure how well a few presses tell the x and y gains of another unit's calibration.

    The calibration is made from half of the presses, its slopes are multiplied by artificial gains,
    and presses of the other half are to find these.

    Attributes:
        data: Folder of the frames.
        diameter_mm: Diameter of the ball [mm].
        background: Frame of the untouched gel. Default: background.png in the folder.
        presses: Numbers of presses to find the gains from.
        subsets: Random subsets of each size.
        seed: Random seed of the halves, the subsets and the calibration.
    """

    data: Path
    diameter_mm: float = 6.31
    background: Path | None = None
    presses: tuple[int, ...] = (3, 5, 8)
    subsets: int = 50
    seed: int = 0

    def __post_init__(self) -> None:
        if not 1.0 <= self.diameter_mm <= 100.0 or self.subsets < 1 or min(self.presses) < 3:
            raise UsageError(
                "--diameter-mm must be 1 to 100, --subsets at least 1, --presses at least 3 each"
            )


@dataclass(frozen=True, kw_only=True)
class NoiseSettings(BenchmarkSettings):
    """Measure the errors of real GelSight Mini heights outside the contacts of a pressed ball.

    Attributes:
        data: Folder of the frames.
        diameter_mm: Diameter of the ball [mm].
        background: Frame of the untouched gel. Default: background.png in the folder.
        calibration: Calibration of the unit. Default: the shipped one, made from presses of a
            6.31 mm ball on one unit.
        plot: PNG file to draw spectrum and correlation to.
        seed: Random seed of the simulated closings of the ideal detector.
    """

    data: Path
    diameter_mm: float = 6.31
    background: Path | None = None
    calibration: Path | None = None
    plot: Path | None = None
    seed: int = 0

    def __post_init__(self) -> None:
        if not 1.0 <= self.diameter_mm <= 100.0 or self.seed < 0:
            raise UsageError("--diameter-mm must be 1 to 100 and --seed at least 0")


@dataclass(frozen=True, kw_only=True)
class BallCaptionsSettings(ModelBenchmarkSettings):
    """Print and score what the model says about real GelSight Mini frames of a pressed ball.

    Attributes:
        data: Folder of the frames.
        weights: Folder of weights. Default: TACGRASP_WEIGHTS, else the shipped weights.
        diameter_mm: Diameter of the ball [mm].
        background: Frame of the untouched gel. Default: background.png in the folder.
        calibration: Calibration of the unit. Default: the shipped one, which was made from presses
            of a 6.31 mm ball on one unit.
        folds: Number of calibrations; each leaves its part of the presses out. 0: none is made.
    """

    data: Path
    diameter_mm: float = 6.31
    background: Path | None = None
    calibration: Path | None = None
    folds: int = 0

    def __post_init__(self) -> None:
        if not 1.0 <= self.diameter_mm <= 100.0 or self.folds < 0 or self.folds == 1:
            raise UsageError("--diameter-mm must be 1 to 100 and --folds 0 or at least 2")
        if self.folds and self.calibration is not None:
            raise UsageError("--folds makes its own calibrations: give either it or --calibration")


@dataclass(frozen=True, kw_only=True)
class EncoderSettings(BenchmarkSettings):
    """Time training and encoding beside a PointBERT of the same size, written plainly in torch.

    Attributes:
        preset: Name of the encoder: grid, small, ulip2, ...
        repeats: Number of encodings of one cloud; batches and training steps take a tenth of it.
        threads: Number of torch's threads.
    """

    preset: str = "grid"
    repeats: int = 100
    threads: int = 1

    def __post_init__(self) -> None:
        if min(self.repeats, self.threads) < 1:
            raise UsageError("--repeats and --threads must be at least 1")


@dataclass(frozen=True, kw_only=True)
class Tcl3dSettings(BenchmarkSettings):
    """Time the making of contacts at a sensor's own resolution, from object to caption.

    Attributes:
        series: Number of series, four contacts each.
        workers: Number of processes, one thread each.
        device: Device for ray casting and contact solving: cpu or cuda.
        tacto: Python interpreter with TACTO installed, whose renderer is timed in the same run.
    """

    series: int = 60
    workers: int = 2
    device: str = "cpu"
    tacto: Path | None = None

    def __post_init__(self) -> None:
        if self.workers < 1 or self.series < 2 * self.workers:
            raise UsageError("--workers must be at least 1 and --series at least twice as many")
