"""Tables of a report: which rows there are, the paper's three, each evaluation split by itself."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import product
from pathlib import Path

from cltp.evaluation.splits import EVALUATION_SPLITS
from cltp.tactile.cloud import NUM_POINTS
from cltp.tactile.states import CLASSES
from cltp.train.methods import ALIGNED_METHODS, IMAGE_METHODS
from tacgrasp.pretraining.report.pages import PageSection, PageTable
from tacgrasp.pretraining.report.paper_numbers import PAPER, PAPER_TABLES
from tacgrasp.pretraining.report.row_file import RowFile, missing
from tacgrasp.pretraining.report.row_status import HEAD, points_text, row_statuses
from tacgrasp.pretraining.report.rows import BUDGET, DATA, ROWS, wanted
from tacgrasp.pretraining.report.store import TITLES, Groups, Result, mean, means, spread

COLUMNS = ("contact", "object", "physics", "real")

TABLE_TITLES = {
    "zero_shot": "Zero-shot, the paper's prompt (table 1)",
    "zero_shot_ensemble": "Zero-shot, an ensemble of prompts",
    "zero_shot_unseen": "Zero-shot, prompts in unseen wordings",
    "zero_shot_synonyms": "Zero-shot, prompts with synonyms",
    "probe": "Frozen encoder and MLP (table 2; image encoders: appendix A)",
    "numbers": "Numbers: median errors, % of the true values inside 90 % intervals, their widths",
    "retrieval": "Retrieval: captions and contacts of a whole split, % found",
}

_DIMENSIONS = " / ".join(CLASSES)

_EFFORT = ("points", "samples", "minutes")
"""Columns of every table: points of the input, samples seen in pre-training, minutes of it all."""


def row_section(rows: Sequence[RowFile], folder: Path) -> PageSection:
    """The rows with points, samples and minutes; what is missing and what differs."""
    absent, marked = missing(rows), [row for row in rows if row.marks]
    text = (
        f"Made from {len(rows)} files of rows in {folder.as_posix()}. Nothing was trained or "
        f"measured for this page. {len(absent)} of {len(list(wanted()))} rows are missing; the "
        "command that makes each stands beside it."
    )
    parts = {recipe.part for recipe in ROWS.values()} - {1}
    budget = (
        f"One budget for every method: {BUDGET:,} samples seen by the encoder; rows of "
        f"{', '.join(map(str, sorted(parts)))} of it are marked so. Data: {DATA['paper']}."
    )
    if marked:
        budget += f" {len(marked)} rows are of other data or of another budget, as marked."
    return PageSection(
        title="Rows",
        text=[text, budget],
        table=PageTable(head=list(HEAD), rows=row_statuses(rows)),
        note="Points: of the encoder's input; – for images, and where nothing is measured yet. "
        "Minutes: of the whole command in empty folders, CLIP's training included.",
    )


def paper_tables(groups: Groups) -> Iterator[PageSection]:
    """The paper's three tables: our rows, and the paper's below each."""
    for title, (table, methods, further) in PAPER_TABLES.items():
        rows = []
        for method in (*methods, *further):
            of_method = {k[2:]: same for k, same in groups.items() if k[:2] == (table, method)}
            rows += _our_rows(of_method, TITLES[method])
            if any((table, method, split) in PAPER for split in COLUMNS):
                cells = [_joined(PAPER.get((table, method, split), ())) for split in COLUMNS]
                rows.append(
                    [f"– the paper's {TITLES[method]}", *cells, "", *_papers_effort(method)]
                )
        yield PageSection(
            title=title,
            text=[f"{_DIMENSIONS}, % right; – where nothing was measured."],
            table=PageTable(head=["", *COLUMNS, "encoder", *_EFFORT], rows=rows),
            note="The paper's real-world row stands in the column physics. Geometric baseline: "
            "computed directly from the same 1024 points, which gives no shape and texture; "
            "'heights alone': probes on their heights in falling order, without positions.",
        )


def _our_rows(groups: dict[tuple[str, str], Sequence[Result]], title: str) -> list[list[str]]:
    """A row for each variant of a method, those that saw the most samples first."""
    rows = []
    firsts: dict[str, Result] = {}
    for (variant, _), same in groups.items():
        firsts.setdefault(variant, same[0])
    for variant, first in sorted(firsts.items(), key=lambda pair: -_samples(pair[1])):
        cells = []
        for split in COLUMNS:
            same = groups.get((variant, split), ())
            cells.append(_joined([mean([r.values.get(slot) for r in same]) for slot in CLASSES]))
        rows.append([first.name, *cells, variant, *_effort(first)])
    return rows or [[title, *["–"] * len(COLUMNS), "not measured", *["–"] * len(_EFFORT)]]


def _papers_effort(method: str) -> list[str]:
    """Cells of ``_EFFORT``; the paper states no samples and no minutes."""
    return [points_text(None if method in IMAGE_METHODS else NUM_POINTS), "–", "–"]


def _samples(result: Result) -> int:
    return 0 if result.budget is None else result.budget.samples


def _effort(result: Result) -> list[str]:
    """Cells of ``_EFFORT``."""
    samples = "–" if result.budget is None else f"{result.budget.samples:,}"
    minutes = "–" if result.minutes is None else f"{result.minutes:.0f}"
    return [points_text(result.points), samples, minutes]


def _joined(values: Sequence[float | None]) -> str:
    if all(value is None for value in values):
        return "–"
    return " / ".join("–" if value is None else f"{value:.1f}" for value in values)


def wording_section(groups: Groups) -> Iterator[PageSection]:
    """Zero-shot in wordings and words that no training used, on the split ``contact``."""
    rows = []
    for (table, method, variant, split), same in groups.items():
        if (table, split) != ("zero_shot", "contact") or method not in ALIGNED_METHODS:
            continue
        usual = means(same)
        for kind, name in (("unseen", "unseen wordings"), ("synonyms", "synonyms")):
            other = groups.get((f"zero_shot_{kind}", method, variant, split))
            if other is None:
                continue
            values = means(other)
            pairs = [(usual.get(slot), values.get(slot)) for slot in CLASSES]
            known = [(was, now) for was, now in pairs if was is not None and now is not None]
            total = sum(was for was, _ in known)
            kept = f"{100 * sum(now for _, now in known) / total:.0f} %" if total else "–"
            cells = [_joined([column for column, _ in pairs]), _joined([now for _, now in pairs])]
            rows.append([f"{same[0].name}: {name}", *cells, kept, variant])
    if rows:
        chance = _joined([100 / len(names) for names in CLASSES.values()])
        rows.append(["chance", "", chance, "", ""])
        yield PageSection(
            title="Zero-shot in wordings that no training used, split contact",
            text=[f"{_DIMENSIONS}, % right, by the paper's prompt and by the other texts."],
            table=PageTable(
                head=["", "the paper's prompt", "other texts", "kept", "encoder"], rows=rows
            ),
            note="Unseen wordings: the mean over three other sentences around the same words. "
            "Synonyms: the paper's prompt with a word that no alignment learned from. Kept: the "
            "mean over the dimensions, of that by the paper's prompt.",
        )


def detail_tables(groups: Groups) -> Iterator[PageSection]:
    """Every table and evaluation split by itself, with the spread over seeds."""
    about = {split.name: split.about for split in EVALUATION_SPLITS} | {"real": "real touches"}
    for table, (split, contents) in product(TABLE_TITLES, about.items()):
        of_split = {k[1:3]: same for k, same in groups.items() if (k[0], k[3]) == (table, split)}
        if not of_split:
            continue
        first = next(iter(of_split.values()))[0]
        columns = list(first.values)
        has_paper = any((table, method, split) in PAPER for method in TITLES)
        names = (name.replace("coverage_", "inside: ").replace("percent", "%") for name in columns)
        head = ["", *(name.replace("_", " ") for name in names)]
        if has_paper:
            head += [f"paper: {slot}" for slot in CLASSES]
        head += ["encoder", *_EFFORT, "seeds"]
        rows = []
        for (method, variant), same in of_split.items():
            cells = [_cell([row.values.get(column) for row in same]) for column in columns]
            if has_paper:
                paper = PAPER.get((table, method, split))
                cells += [f"{v:.1f}" for v in paper] if paper else ["–"] * len(CLASSES)
            rows.append([same[0].name, *cells, variant, *_effort(same[0]), str(len(same))])
        note = f"{split}: {contents}; {first.contacts} contacts. ± is half of the range over seeds."
        if has_paper and split == "physics":
            note += " The paper's columns are its real-world ones."
        yield PageSection(
            title=f"{TABLE_TITLES[table]} – {split}",
            table=PageTable(head=head, rows=rows),
            note=note,
        )


def _cell(values: Sequence[float | None]) -> str:
    """Mean over seeds, with half of the range where there are several."""
    middle, range_ = mean(values), spread(values)
    if middle is None:
        return "–"
    digits = 1 if abs(middle) >= 10 else 2 if abs(middle) >= 1 else 3  # depths are 0.02 mm off
    half = f" ± {range_ / 2:.{digits}f}" if range_ is not None else ""
    return f"{middle:.{digits}f}{half}"
