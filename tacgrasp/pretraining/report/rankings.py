"""Rankings of methods: whether they stand in the paper's order, dimension by dimension.

Methods of points are compared on the paper's 1024 points, where they were measured so.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from cltp.tactile.states import CLASSES
from tacgrasp.pretraining.report.pages import PageSection, PageTable
from tacgrasp.pretraining.report.paper_numbers import PAPER, PAPER_TABLES
from tacgrasp.pretraining.report.rows import EVEN
from tacgrasp.pretraining.report.store import TITLES, Groups, mean, nested

_IN_ORDER = ("cltp", "cltp_no_image", "point_bert", "point_mae", "random")
_EXPECTED = "CLTP > CLTP w/o image > Point-BERT, Point-MAE > random encoder"


class MethodRanking(NamedTuple):
    """The methods of one column of the paper's tables, best first."""

    title: str
    split: str
    dimension: str
    paper: list[str]
    ours: list[str]


def rankings(groups: Groups) -> Iterator[MethodRanking]:
    """The paper's ranking and ours in every column where all methods were measured."""
    figures = nested(_on_equal_input(groups))
    for title, (table, methods, _) in PAPER_TABLES.items():
        measured = figures.get(table, {})
        for split in ("contact", "physics"):
            for column, dimension in enumerate(CLASSES):
                paper = {
                    method: PAPER[table, method, split][column]
                    for method in methods
                    if (table, method, split) in PAPER
                }
                values = {m: measured.get(m, {}).get(split, {}).get(dimension) for m in methods}
                ours = {method: value for method, value in values.items() if value is not None}
                if len(paper) == len(ours) == len(methods):
                    papers = sorted(paper, key=lambda m: -paper[m])
                    ranked = sorted(ours, key=lambda m: -ours[m])
                    yield MethodRanking(title, split, dimension, papers, ranked)


def _on_equal_input(groups: Groups) -> Groups:
    """Only the encoder of 1024 points of every method, table and split that was measured so."""
    even = {(table, method, split) for table, method, variant, split in groups if variant == EVEN}
    return {k: same for k, same in groups.items() if k[2] == EVEN or (*k[:2], k[3]) not in even}


def _mean_rows(groups: Groups) -> Iterator[list[str]]:
    """Means over the dimensions, by probes, of the paper's methods and the random encoder."""
    measured = nested(_on_equal_input(groups)).get("probe", {})
    for split in ("contact", "object", "physics"):
        values = {
            name: mean(list(measured.get(name, {}).get(split, {}).values())) for name in _IN_ORDER
        }
        known = {name: value for name, value in values.items() if value is not None}
        if len(known) < len(_IN_ORDER):
            continue
        first, second, *others, last = (known[name] for name in _IN_ORDER)
        same = first > second > max(others) and min(others) > last
        ours = (
            f"{TITLES[name]} {known[name]:.1f}" for name in sorted(known, key=lambda m: -known[m])
        )
        yield [
            f"Probes, {split}",
            "mean",
            "as in the paper" if same else "differs",
            " > ".join(ours),
            _EXPECTED,
        ]


def ranking_section(groups: Groups) -> PageSection:
    """A row for each column of the paper's tables."""
    rows = []
    for ranking in rankings(groups):
        paper, ours = (" > ".join(TITLES[m] for m in row) for row in (ranking.paper, ranking.ours))
        same = "as in the paper" if ranking.paper == ranking.ours else "differs"
        title = ranking.title.split(":")[0]
        rows.append([f"{title}, {ranking.split}", ranking.dimension, same, ours, paper])
    rows += _mean_rows(groups)
    differing = sum(row[2] == "differs" for row in rows)
    text = f"{len(rows) - differing} of {len(rows)} columns have the paper's order."
    if not rows:
        text = "No column has all of the paper's methods yet."
    head = ["", "dimension", "order", "ours", "the paper's"]
    table = PageTable(head=head, rows=rows) if rows else None
    return PageSection(title="Order of methods", text=[text], table=table)
