"""One HTML and one Markdown page from stored results: our tables beside the paper's, and plots.

Reads results alone, trains and measures nothing, and refuses results of different data.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from cltp.atomic_write import write_atomically
from tacgrasp.base.errors import UsageError
from tacgrasp.pretraining.report.ablations import load_tries
from tacgrasp.pretraining.report.failure_sections import failure_sections
from tacgrasp.pretraining.report.failures import load_failures
from tacgrasp.pretraining.report.pages import PageSection, markdown, page
from tacgrasp.pretraining.report.plots import bars, confusions, curves
from tacgrasp.pretraining.report.store import METHODS, Result, grouped, load
from tacgrasp.pretraining.report.tables import (
    budgets,
    detail_tables,
    order_of_methods,
    paper_tables,
    shortfalls,
    tries_section,
)

TITLE = "Pre-training: our results beside the paper's"


def report(
    results: Path, out: Path, name: str = "pretraining", *, weights: Path | None = None
) -> list[Path]:
    """Write ``out/name.md`` with its plots in ``out/name-plots``, and ``out/name.html``.

    Args:
        results: Folder of results, failures and ``tries.csv``.
        out: Folder for the pages.
        name: Of the pages.
        weights: Folder of all methods, whose curves are shown too.

    Raises:
        UsageError: No results, wrong tries, or the pages can't be written.
        TouchError: Results are damaged or of different data.
    """
    sections = _sections(results, weights)
    plots = out / f"{name}-plots"
    pages = {
        f"{name}.md": markdown(TITLE, sections, plots=plots.name, page=f"{name}.html"),
        f"{name}.html": page(TITLE, sections),
    }
    try:
        plots.mkdir(parents=True, exist_ok=True)
        for section in sections:
            for plot in section.plots:
                (plots / f"{plot.name}.png").write_bytes(plot.png)
        for file, text in pages.items():
            write_atomically(out / file, text)
    except OSError as error:
        raise UsageError(f"the report can't be written to {out}: {error.strerror}") from None
    return [out / file for file in pages]


def _sections(results: Path, weights: Path | None) -> list[PageSection]:
    found = load(results)
    tries = tries_section(load_tries(results))
    sections = [
        PageSection(title="", text=_facts(found)),
        *paper_tables(found),
        *shortfalls(found),
        order_of_methods(found),
        *([tries] if tries is not None else []),
        *detail_tables(found),
        *failure_sections(found, load_failures(results, found[0].data)),
        PageSection(title="Plots", plots=[*bars(found), *confusions(found)]),
    ]
    drawn = curves(weights) if weights is not None else []
    if drawn:
        sections.append(PageSection(title="Curves", plots=drawn))
    commands = sorted({result.command for result in found if result.command})
    return [*sections, PageSection(title="Commands", code=commands)]


def _facts(found: Sequence[Result]) -> list[str]:
    return [which_it_is(found), f"Data {found[0].data[:16]}. {budgets(found)}"]


def which_it_is(found: Sequence[Result]) -> str:
    """With an accelerator or without, which presets, how many seeds: as the results say."""
    devices = {r.device for r in found if r.device is not None}
    others = sorted(devices - {"cpu"})
    if not devices:
        where = "The results don't say on what encoders were trained"
    elif others:
        where = f"With an accelerator ({', '.join(others)})"
    else:
        where = "Without an accelerator"
    presets = sorted({r.variant for r in found if r.method != "ceiling"})
    learned = sorted({r.learned_seed for r in found if r.learned_seed is not None})
    of_learning = {0: "an unknown number of seeds", 1: "one seed"}.get(
        len(learned), f"{len(learned)} seeds"
    )
    counts: dict[int, set[str]] = {}
    for (table, method, _, _), rows in grouped(found).items():
        if table == "probe" and method != "ceiling" and len(rows) > 1:
            counts.setdefault(len(rows), set()).add(METHODS[method])
    spread = "; ".join(
        f"spread over {count} seeds of probes for {', '.join(sorted(names))}"
        for count, names in sorted(counts.items())
    )
    return (
        f"{where}. Encoders: {', '.join(presets) or 'none'}; {of_learning} of pre-training; "
        f"{spread or 'no spread over seeds was measured'}."
    )
