"""Sections of a report on CLTP's wrong predictions: the paper's cases, and every class."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from cltp.tactile.states import CLASSES
from tacgrasp.pretraining.report.failures import CONFUSED_SHAPES, FailureCount, Failures
from tacgrasp.pretraining.report.pages import PageCardGroup, PageSection, PageTable
from tacgrasp.pretraining.report.store import Groups, merged_accuracy

_TABLES = {"zero_shot": "zero-shot", "probe": "probe"}


def failure_sections(groups: Groups, failures: Sequence[Failures]) -> Iterator[PageSection]:
    """The paper's cases with their rates, then the classes of each evaluation split."""
    yield from _confused_shapes(groups)
    if failures:
        yield _cases(failures)
    yield from map(_classes, failures)


def _confused_shapes(groups: Groups) -> Iterator[PageSection]:
    """Confusion rates of the shapes that the paper names, and those most often confused."""
    names, rows = CLASSES["shape"], []
    for (table, method, variant, split), same in groups.items():
        counts = same[0].confusion.get("shape")
        if method != "cltp" or table not in _TABLES or counts is None:
            continue
        cells = [f"{_TABLES[table]}, {split}"]
        for one, other in CONFUSED_SHAPES:
            rate = _rate(counts, names.index(one), names.index(other))
            back = _rate(counts, names.index(other), names.index(one))
            cells.append(f"{rate} / {back}")
        right = (same[0].values.get("shape"), merged_accuracy(same[0], "sphere", "ellipsoid"))
        cells += ["–" if value is None else f"{value:.1f}" for value in right]
        wrong = [
            (count, truth, predicted)
            for truth, row in enumerate(counts)
            for predicted, count in enumerate(row)
            if predicted != truth and count
        ]
        most = [f"{names[t]} as {names[p]} ({n})" for n, t, p in sorted(wrong)[:-6:-1]]
        rows.append([*cells, variant, ", ".join(most) or "none"])
    if rows:
        pairs = [f"{one} as {other} / back, %" for one, other in CONFUSED_SHAPES]
        columns = ["shape right, %", "sphere = ellipsoid, %", "encoder"]
        yield PageSection(
            title="Failures of CLTP: confused shapes",
            text=[
                "The paper (section 5.2) names triangle and peak, sphere and ellipsoid, and the "
                "position of large planes. – where a split has no such shape."
            ],
            table=PageTable(head=["", *pairs, *columns, "most frequent (contacts)"], rows=rows),
        )


def _rate(counts: Sequence[Sequence[int]], truth: int, predicted: int) -> str:
    total = sum(counts[truth])
    return f"{100 * counts[truth][predicted] / total:.0f}" if total else "–"


def _cases(failures: Sequence[Failures]) -> PageSection:
    rows, cards = [], []
    for each in failures:
        name = f"{_TABLES[each.table]}, {each.split} ({each.variant})"
        rows.append([name, *(_percent(case) for case in each.cases)])
        cards += [
            PageCardGroup(title=f"{name}: {case.name}", cards=case.examples) for case in each.cases
        ]
    return PageSection(
        title="The paper's failure cases, with pictures",
        text=[
            "Percent of the contacts of that shape, and their number. Our label of a plane's "
            "position is the centre of the pressed area, not the deepest point. Pictures show the "
            "clean gel from the sensor's side: the contacts with the highest score of the wrong "
            "class."
        ],
        table=PageTable(head=["", *(case.name for case in failures[0].cases)], rows=rows),
        cards=cards,
    )


def _percent(count: FailureCount) -> str:
    return "–" if count.percent is None else f"{count.percent:.0f} ({count.contacts})"


def _classes(failures: Failures) -> PageSection:
    rows, cards = [], []
    for dimension in CLASSES:
        counts = [c for c in failures.classes if c.dimension == dimension and c.contacts]
        worst = sorted(counts, key=lambda count: -(count.percent or 0.0))
        words = ", ".join(f"{count.name} {_percent(count)}" for count in worst)
        rows.append([dimension, words or "–"])
        cards += [
            PageCardGroup(
                title=f"{dimension} {count.name}: {count.wrong} of {count.contacts} wrong",
                cards=count.examples,
                is_open=False,
            )
            for count in worst
        ]
    return PageSection(
        title=f"Failures of CLTP by class: {_TABLES[failures.table]}, {failures.split}",
        table=PageTable(head=["", "% wrong (contacts), worst first"], rows=rows),
        note=f"Encoder {failures.variant}, seed {failures.seed}; scores are "
        f"{'cosines' if failures.measure == 'cosine' else 'probabilities'}.",
        cards=cards,
    )
