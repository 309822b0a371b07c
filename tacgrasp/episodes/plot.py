"""Draw an episode as one picture: every cloud, force against its contract, depth and position."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import ListedColormap, Normalize
from matplotlib.figure import Figure
from matplotlib.gridspec import GridSpec
from matplotlib.patches import Rectangle

from cltp.atomic_write import replacing
from cltp.tactile.cloud import FloatArray, TactileCloud
from cltp.tactile.picture import DEPTH_PALETTE, DEPTH_STOPS_MM, depth_levels
from cltp.tactile.sensors import SensorSpec
from policies.reflex_trace import NO_SLIP, ReflexTrace
from tacgrasp.episodes.errors import EpisodeError
from tacgrasp.episodes.paths import refusal
from tacgrasp.episodes.reader import read_episode
from tacgrasp.episodes.record import PHASE_LABELS, Episode, StepPhase, StepRecord, end_label

MAX_PICTURES = 24
"""Largest number of drawn clouds; more are thinned out evenly, first and last stay. Our choice."""

MOST_SPAN = 2.5
"""Largest ratio of goal and limit to the forces at which the axis reaches up to them. Our choice: a
light hold stays readable under a limit of many times its force."""

TITLE_LENGTH = 100
"""Most characters of a title in this size on a picture of this width."""

_COLUMNS = 6
_HEAT = ListedColormap(DEPTH_PALETTE / 255)
_FORCE, _DEPTH, _PATH, _MUTED = "#1f6f8b", "#c8553d", "#3d405b", "#8a8a8a"
_GOOD, _BAD = "#2f7d4f", "#b3261e"


def plot_episode(path: Path, png_path: Path) -> None:
    """Draw the episode in ``path`` to ``png_path``.

    Raises:
        EpisodeError: The episode can't be read or has no step, or the picture can't be written.
    """
    episode = read_episode(path)
    if not episode.steps:
        raise EpisodeError(f"{path} has no touch to draw: the run ended before its first step")
    figure = draw_episode(episode, path.name)
    try:
        with replacing(png_path) as part:
            figure.savefig(part, format="png", dpi=110, facecolor="white")
    except OSError as error:
        raise EpisodeError(refusal(png_path, "write", error, flag="--out")) from None


def draw_episode(episode: Episode, name: str) -> Figure:
    """The picture of an episode with at least one step; ``name`` goes into the title."""
    num_steps = len(episode.steps)
    shown = np.linspace(0, num_steps - 1, min(num_steps, MAX_PICTURES)).round().astype(int)
    drawn = [episode.steps[i] for i in shown]
    rows = math.ceil(len(drawn) / _COLUMNS)
    reflex_in = 1.5 if _traces(episode) else 0.0
    height_in = 1.0 + 1.75 * rows + 4.2 + reflex_in
    figure = Figure(figsize=(13, height_in))
    top, bottom = 1 - 0.95 / height_in, (4.5 + reflex_in) / height_in
    curves_box = (0.07, 0.6 / height_in, 0.97, (3.85 + reflex_in) / height_in)
    pictures = GridSpec(rows, _COLUMNS, figure, 0.04, bottom, 0.93, top, wspace=0.08, hspace=0.32)
    rows_of = 3 if _traces(episode) else 2
    layout: dict[str, Any] = {"width_ratios": (1.7, 1), "hspace": 0.16, "wspace": 0.12}
    curves = GridSpec(rows_of, 2, figure, *curves_box, **layout)
    _title(figure, episode, name, height_in)
    scale = Normalize(0, len(DEPTH_PALETTE) - 1)
    for index, step in enumerate(drawn):
        _draw_cloud(figure.add_subplot(pictures[divmod(index, _COLUMNS)]), step, scale)
    bar = figure.add_axes((0.94, bottom, 0.012, top - bottom))
    stops = list(depth_levels(np.array(DEPTH_STOPS_MM)))
    drawn_bar = figure.colorbar(ScalarMappable(scale, _HEAT), cax=bar)
    bar.set_title("mm", fontsize=9.5, pad=6)
    drawn_bar.set_ticks(stops, labels=[f"{stop:g}" for stop in DEPTH_STOPS_MM])
    contacts = np.array([_contact(step.cloud) for step in episode.steps])
    _draw_curves(figure, curves, episode, contacts)
    _draw_path(figure.add_subplot(curves[:, 1]), episode, contacts)
    return figure


def _contact(cloud: TactileCloud) -> FloatArray:
    """Centre of the points pressed at least half as deep as the deepest one, and its depth [mm]."""
    points = cloud.points_mm
    depth = points[:, 2].max()
    pressed = points[points[:, 2] >= depth / 2]
    return np.array([*pressed[:, :2].mean(axis=0), max(depth, 0.0)])


def _title(figure: Figure, episode: Episode, name: str, height_in: float) -> None:
    header, end = episode.header, episode.end
    outcome = f"{end_label(end.reason, end.truth)}: {end.message}" if end else "no end recorded"
    if not episode.complete:
        outcome += " (incomplete)" if episode.finished else " (unfinished file)"
    seed = "" if header.seed is None else f", seed {header.seed}"
    title = f"{header.task}, {header.policy}{seed} → {outcome}"
    title = textwrap.shorten(title, TITLE_LENGTH, placeholder=" …")
    figure.text(0.04, 1 - 0.36 / height_in, title, fontsize=15, weight="bold")
    subtitle = f"“{header.instruction}”   {name}"
    if len(episode.steps) > MAX_PICTURES:
        subtitle += f"   ({MAX_PICTURES} of {len(episode.steps)} touches shown)"
    if episode.missing:
        subtitle += f"   ({episode.missing})"
    figure.text(0.04, 1 - 0.62 / height_in, subtitle, fontsize=10, color=_MUTED)


def _draw_cloud(axes: Axes, step: StepRecord, scale: Normalize) -> None:
    x, y, z = step.cloud.points_mm.astype(np.float64).T
    axes.tripcolor(x, y, depth_levels(z).astype(float), cmap=_HEAT, norm=scale, shading="gouraud")
    untouched = DEPTH_PALETTE[depth_levels(np.zeros(1))[0]] / 255
    axes.set_facecolor(tuple(untouched))  # between the outermost points and the pad's edge
    _outline_pad(axes, step.cloud.sensor)
    axes.set_xticks([])
    axes.set_yticks([])
    axes.set_title(f"{step.index}  {_caption(step)}", fontsize=9.5, pad=4)


def _caption(step: StepRecord) -> str:
    if step.phase != StepPhase.LOOP:
        return PHASE_LABELS[step.phase]
    decision = step.decision
    if decision is None:
        return "no decision"
    if decision.action is not None:
        return f"→ {decision.action.value}" + ("" if step.executed else " (not done)")
    return "success declared" if decision.success else "no action"


def _outline_pad(axes: Axes, sensor: SensorSpec) -> None:
    corner = (-sensor.width_mm / 2, -sensor.height_mm / 2)
    axes.add_patch(
        Rectangle(corner, sensor.width_mm, sensor.height_mm, fill=False, lw=1.2, ec="#333333")
    )
    axes.set_aspect("equal")
    axes.set_xlim(-0.505 * sensor.width_mm, 0.505 * sensor.width_mm)
    axes.set_ylim(-0.505 * sensor.height_mm, 0.505 * sensor.height_mm)
    for side in axes.spines.values():
        side.set_visible(False)


def _draw_curves(figure: Figure, grid: GridSpec, episode: Episode, contacts: FloatArray) -> None:
    """Felt force against its contract, commanded force and depth, with the actions between them."""
    start_s = episode.header.stamp.monotonic_s
    time_s = [step.stamp.monotonic_s - start_s for step in episode.steps]
    traces = _traces(episode)
    force = figure.add_subplot(grid[0, 0])
    depth = figure.add_subplot(grid[1, 0], sharex=force)
    commanded = [step.gripper.force_n for step in episode.steps]
    stepped = time_s, commanded
    if traces:
        stepped = _with_corrections(time_s, commanded, traces, start_s)
    force.step(*stepped, where="post", color=_FORCE, lw=1.4, label="commanded")
    if traces:
        _draw_reflex(force, figure.add_subplot(grid[2, 0], sharex=force), traces, start_s)
    felt = [(at_s, s.felt_force_n) for at_s, s in zip(time_s, episode.steps, strict=True)]
    readings = [(at_s, reading) for at_s, reading in felt if reading is not None]
    if readings:
        values = np.array([[at_s, r.value, r.low, r.high] for at_s, r in readings]).T
        spans = [values[1] - values[2], values[3] - values[1]]
        style: dict[str, Any] = {"fmt": "s-", "color": _DEPTH, "ms": 5, "lw": 1, "capsize": 3}
        force.errorbar(values[0], values[1], spans, label="felt", **style)
    force.set_ylabel(force_label(episode))
    most_n = max(*stepped[1], *(r.high for _, r in readings), 0.1)
    force.set_ylim(0, 1.2 * _draw_contract(force, episode, time_s, most_n))
    force.legend(loc="upper left", fontsize=8, ncols=4, frameon=False)
    _draw_end(force, episode)
    depth.plot(time_s, contacts[:, 2], "o-", color=_DEPTH, lw=2, ms=5)
    depth.set_ylabel("largest\nindentation [mm]")
    depth.set_ylim(0, 1.3 * max(contacts[:, 2].max(), 0.1))
    if traces:  # their panel stands below, on the same time
        depth.tick_params(labelbottom=False)
    else:
        depth.set_xlabel("time since start [s]")
    force.tick_params(labelbottom=False)
    for axes in (force, depth):
        axes.grid(alpha=0.25)
        axes.spines[["top", "right"]].set_visible(False)
        for at_s in time_s:
            axes.axvline(at_s, color=_MUTED, lw=0.6, alpha=0.5, ls=":")
    if len(episode.steps) <= MAX_PICTURES:
        _label_times(force, time_s, episode.steps)


def _traces(episode: Episode) -> list[ReflexTrace]:
    """What the reflex saw and did, where it saw anything."""
    traces = [step.reflex for step in episode.steps if step.reflex is not None]
    return [trace for trace in traces if len(trace.t_s)]


def _with_corrections(
    time_s: list[float], commanded_n: list[float], traces: list[ReflexTrace], start_s: float
) -> tuple[list[float], list[float]]:
    """Commanded force over time, with what the reflex commanded between the steps."""
    changes = [(c.t_s - start_s, c.after_n) for trace in traces for c in trace.corrections]
    merged = sorted([*zip(time_s, commanded_n, strict=True), *changes])
    return [at_s for at_s, _ in merged], [force_n for _, force_n in merged]


def _draw_reflex(force: Axes, slip: Axes, traces: list[ReflexTrace], start_s: float) -> None:
    """The force and the slip that the reflex saw, and its corrections."""
    for trace in traces:
        at_s, felt = trace.t_s - start_s, trace.felt_n
        known = felt > 0
        force.plot(at_s[known], felt[known], "-", color=_DEPTH, lw=0.9, alpha=0.8)
        told = trace.slip > NO_SLIP
        slip.plot(at_s[told], trace.slip[told], "-", color=_PATH, lw=1.0)
        for each in trace.corrections:
            color = _BAD if each.after_n > each.before_n else _GOOD
            for axes in (force, slip):
                axes.axvline(each.t_s - start_s, color=color, lw=0.9, alpha=0.7)
    slip.axhline(0, color=_BAD, lw=1.0, ls="--")
    slip.set_ylabel("slip, log odds\nover threshold")
    slip.set_xlabel("time since start [s]")
    slip.grid(alpha=0.25)
    slip.spines[["top", "right"]].set_visible(False)
    corrected = sum(len(trace.corrections) for trace in traces)
    note = f"reflex: {corrected} corrections" if corrected != 1 else "reflex: 1 correction"
    slip.annotate(note, (0.01, 0.05), xycoords="axes fraction", fontsize=8)


def force_label(episode: Episode) -> str:
    """Label of the axis of forces: without a force calibration it says so."""
    marks = {step.cloud.force_scale.mark for step in episode.steps} - {""}
    return "\n".join(["force [N]", *sorted(marks)])


def _draw_contract(axes: Axes, episode: Episode, time_s: Sequence[float], most_n: float) -> float:
    """The target band and the limit of each step; returns what the axis must show [N].

    That is ``most_n`` at least. Of a limit far above it only the name is shown.
    """
    contract, spans = episode.header.contract, []
    for step, at_s in zip(episode.steps, time_s, strict=True):
        contract = step.contract or contract
        if contract is not None and not contract.refused:
            band = contract.terms.force_n if step.need is None else step.need.force_n
            spans.append((at_s, band.low, band.high, contract.terms.limit_n))
    if not spans:
        return most_n
    last_s = max(time_s[-1], _end_s(episode))
    at, low, high, limit = np.array([*spans, (last_s, *spans[-1][1:])]).T
    axes.fill_between(at, low, high, step="post", color=_GOOD, alpha=0.18, lw=0, label="goal")
    edges_n = [float(each.max()) for each in (high, limit)]
    is_far = float(limit.min()) > MOST_SPAN * most_n
    label = f"never above {limit.min():.3g} N (beyond the axis)" if is_far else "never above"
    axes.step(at, limit, where="post", color=_BAD, lw=1.2, ls="--", label=label)
    return max([most_n, *(each for each in edges_n if each <= MOST_SPAN * most_n)])


def _draw_end(axes: Axes, episode: Episode) -> None:
    """The moment of the end, green for a success; the title names it."""
    if episode.end is None:
        return
    label, at_s = end_label(episode.end.reason, episode.end.truth), _end_s(episode)
    color = _GOOD if label == "success" else _BAD
    axes.axvline(at_s, color=color, lw=1.5)
    text: dict[str, Any] = {
        "rotation": 90,
        "va": "top",
        "ha": "right",
        "fontsize": 8,
        "color": color,
    }
    axes.annotate("end", (at_s, 0.97), xycoords=("data", "axes fraction"), **text)


def _end_s(episode: Episode) -> float:
    """Time of the end, or of the last step without one, since the start [s]."""
    last = episode.end or episode.steps[-1]
    return last.stamp.monotonic_s - episode.header.stamp.monotonic_s


def _label_times(axes: Axes, time_s: Sequence[float], steps: Sequence[StepRecord]) -> None:
    """Label the steps above the curves; a label that would cover another is left out."""
    free_s = -math.inf
    for at_s, step in zip(time_s, steps, strict=True):
        if at_s < free_s:
            continue
        free_s = at_s + 0.04 * (time_s[-1] - time_s[0])
        axes.annotate(
            _caption(step).removeprefix("→ ").replace("_", " "),
            (at_s, 0.99),
            xycoords=("data", "axes fraction"),
            xytext=(2, 0),
            textcoords="offset points",
            fontsize=8,
            rotation=30,
            va="bottom",
            color="#444444",
        )


def _draw_path(axes: Axes, episode: Episode, contacts: FloatArray) -> None:
    """Path of the contact on the pad."""
    _outline_pad(axes, episode.header.sensor)
    sensor = episode.header.sensor
    for third in (-1, 1):  # the nine cells of the position words
        axes.axvline(third * sensor.width_mm / 6, color=_MUTED, lw=0.6, ls=":")
        axes.axhline(third * sensor.height_mm / 6, color=_MUTED, lw=0.6, ls=":")
    felt = np.array(
        [
            depth_mm > 0.05 if step.in_contact is None else step.in_contact
            for step, depth_mm in zip(episode.steps, contacts[:, 2], strict=True)
        ]
    )
    x, y = contacts[felt, :2].T
    axes.plot(x, y, "-", color=_PATH, lw=1.2, alpha=0.6)
    axes.scatter(x, y, c=range(len(x)), cmap="viridis", s=60, zorder=3, ec="white")
    numbers = [step.index for step, is_felt in zip(episode.steps, felt, strict=True) if is_felt]
    for label, point in _labels(contacts[felt, :2], numbers):
        axes.annotate(label, point, xytext=(6, 5), textcoords="offset points", fontsize=9)
    axes.set_title("contact on the pad [mm], +y towards the palm", fontsize=10)
    axes.tick_params(labelsize=8)


def _labels(path_mm: FloatArray, numbers: Sequence[int]) -> list[tuple[str, tuple[float, float]]]:
    """Numbers of the steps; those at one position share a label, and none covers another."""
    runs: list[tuple[tuple[float, float], list[int]]] = []
    for (x, y), number in zip(path_mm, numbers, strict=True):
        if runs and math.dist(runs[-1][0], (x, y)) < 0.6:
            runs[-1][1].append(number)
        else:
            runs.append(((x, y), [number]))
    labels: list[tuple[str, tuple[float, float]]] = []
    for point, run in runs:
        if all(math.dist(point, other) > 1.2 for _, other in labels):
            labels.append((str(run[0]) if len(run) == 1 else f"{run[0]}–{run[-1]}", point))
    return labels
