"""One HTML and one Markdown page from stored results: our tables beside the paper's, and plots.

Reads files of rows and single results; trains and measures nothing. Rows of other data or of
another budget are marked, rows that are missing are named. Single results of different data are
refused.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from cltp.atomic_write import write_atomically
from tacgrasp.base.errors import UsageError
from tacgrasp.base.html_page import render_page
from tacgrasp.base.result_file import check_replaceable
from tacgrasp.pretraining.report.caption_table import caption_section
from tacgrasp.pretraining.report.failure_sections import failure_sections
from tacgrasp.pretraining.report.failures import load_failures
from tacgrasp.pretraining.report.pages import PageSection
from tacgrasp.pretraining.report.plots import bars, confusions, curves
from tacgrasp.pretraining.report.rankings import ranking_section
from tacgrasp.pretraining.report.row_file import load_rows
from tacgrasp.pretraining.report.store import (
    CAPTIONS,
    GEOMETRIC_BASELINE,
    TITLES,
    Groups,
    Result,
    grouped,
    load_results,
)
from tacgrasp.pretraining.report.tables import (
    detail_tables,
    paper_tables,
    row_section,
    wording_section,
)

TITLE = "Pre-training: our results beside the paper's"


def report(results: Path, out: Path, *, weights: Path | None = None) -> list[Path]:
    """Write ``pretraining.md`` with its plots in ``pretraining-plots``, and ``pretraining.html``.

    Args:
        results: Folder of rows, of single results and of failures.
        out: Folder for the pages.
        weights: Folder of all methods, whose training curves are shown too.

    Raises:
        UsageError: There is no such folder, or the pages can't be written, or would replace one of
            somebody else's.
        TouchError: Results are damaged, or single ones of different data.
    """
    if not results.is_dir():
        raise UsageError(
            f"no folder {results}; `tacgrasp eval row` makes rows, `tacgrasp eval probe` others"
        )
    check_replaceable(out / "pretraining.md", flag="--out")
    sections = _sections(results, weights)
    plots, html_page = out / "pretraining-plots", "pretraining.html"
    content = {"sections": sections, "plots": plots.name, "html_page": html_page}
    pages = {
        file: render_page(f"pretraining/templates/{template}", title=TITLE, **content)
        for file, template in (("pretraining.md", "report.md.txt"), (html_page, "report.html"))
    }
    try:
        plots.mkdir(parents=True, exist_ok=True)
        for plot in (plot for section in sections for plot in section.plots):
            write_atomically(plots / f"{plot.name}.png", plot.png)
        for file, text in pages.items():
            write_atomically(out / file, text)
    except OSError as error:
        raise UsageError(f"the report can't be written to {out}: {error.strerror}") from None
    return [out / file for file in pages]


def _sections(folder: Path, weights: Path | None) -> list[PageSection]:
    rows, single = load_rows(folder), load_results(folder)
    results = [*(result for row in rows for result in row.results()), *single]
    groups = grouped(results)
    failures = load_failures(folder, single[0].data) if single else []
    commands = sorted({result.command for result in results if result.command})
    sections = [
        PageSection(title="", text=_introduction(results, groups)),
        *([row_section(rows, folder)] if rows or not single else []),
        *paper_tables(groups),
        *wording_section(groups),
        caption_section(groups),
        ranking_section(groups),
        *detail_tables(groups),
        *failure_sections(groups, failures),
        PageSection(title="Plots", plots=[*bars(groups), *confusions(groups)]),
        PageSection(title="Curves", plots=curves(weights) if weights is not None else []),
        PageSection(title="Commands", code=commands),
    ]
    return [section for section in sections if not section.is_empty]


def _introduction(results: Sequence[Result], groups: Groups) -> list[str]:
    if not results:
        return []
    data = ", ".join(sorted({f"{result.data:.60}" for result in results}))
    return [describe_run(results, groups), f"Measured on the data {data}."]


def describe_run(results: Sequence[Result], groups: Groups) -> str:
    """Devices, encoder presets and numbers of seeds, as the results name them."""
    devices = {r.device for r in results if r.device is not None}
    accelerators = sorted(devices - {"cpu"})
    if not devices:
        device = "The results don't say on what encoders were trained"
    elif accelerators:
        device = f"With an accelerator ({', '.join(accelerators)})"
    else:
        device = "Without an accelerator"
    encoders = [r for r in results if r.table != CAPTIONS and r.method != GEOMETRIC_BASELINE]
    presets = sorted({r.variant.split(",")[0].split("+")[0] for r in encoders})
    seeds = len({r.learned_seed for r in results if r.learned_seed is not None})
    learned = {0: "an unknown number of seeds", 1: "one seed"}.get(seeds, f"{seeds} seeds")
    methods: dict[int, set[str]] = {}
    for (table, method, _, _), rows in groups.items():
        if table == "probe" and method != GEOMETRIC_BASELINE and len(rows) > 1:
            methods.setdefault(len(rows), set()).add(TITLES[method])
    spread = "; ".join(
        f"spread over {count} seeds of probes for {', '.join(sorted(names))}"
        for count, names in sorted(methods.items())
    )
    return (
        f"{device}. Encoders: {', '.join(presets) or 'none'}. "
        f"{learned[0].upper() + learned[1:]} of pre-training; "
        f"{spread or 'no spread over seeds was measured'}."
    )
