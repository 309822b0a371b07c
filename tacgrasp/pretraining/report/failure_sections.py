"""Sections of a report on what CLTP names wrongly: the paper's cases by name, and every class."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from cltp.tactile.states import CLASSES
from tacgrasp.pretraining.report.failures import NAMED, Failed, Failure, Failures
from tacgrasp.pretraining.report.pages import PageCard, PageCardGroup, PageSection, PageTable
from tacgrasp.pretraining.report.store import Result, as_one, grouped

_WORDS = {"zero_shot": "zero-shot", "probe": "probe"}


def failure_sections(
    found: Sequence[Result], failures: Sequence[Failures]
) -> Iterator[PageSection]:
    """The paper's cases with their rates, then the classes of each trial."""
    yield from _shapes(found)
    if failures:
        yield _cases(failures)
    for each in failures:
        yield _classes(each)


def _shapes(found: Sequence[Result]) -> Iterator[PageSection]:
    """Confusion rates of the shapes that the paper names, and those most often confused."""
    names, rows = CLASSES["shape"], []
    for (table, method, variant, trial), same in grouped(found).items():
        result = same[0]
        counts = result.confusion.get("shape")
        if method != "cltp" or table not in _WORDS or counts is None:
            continue
        cells = [f"{_WORDS[table]}, {trial}"]
        for one, other in NAMED:
            there = _said_as(counts, names.index(one), names.index(other))
            back = _said_as(counts, names.index(other), names.index(one))
            cells.append(f"{there} / {back}")
        merged = as_one(result, "sphere", "ellipsoid")
        right = result.values.get("shape")
        cells += ["–" if value is None else f"{value:.1f}" for value in (right, merged)]
        wrong = [
            (count, truth, said)
            for truth, row in enumerate(counts)
            for said, count in enumerate(row)
            if said != truth and count
        ]
        most = [f"{names[t]} as {names[s]} ({n})" for n, t, s in sorted(wrong)[:-6:-1]]
        rows.append([*cells, variant, ", ".join(most) or "none"])
    if rows:
        pairs = [f"{one} as {other} / back, %" for one, other in NAMED]
        merged_head = ["shape right, %", "sphere = ellipsoid, %", "encoder"]
        yield PageSection(
            title="Failures of CLTP: shapes taken for each other",
            text=[
                "The paper (section 5.2) names triangle and peak, sphere and ellipsoid, and the "
                "position of large planes. – where a trial has no such shape."
            ],
            table=PageTable(head=["", *pairs, *merged_head, "most frequent (contacts)"], rows=rows),
        )


def _said_as(counts: Sequence[Sequence[int]], truth: int, said: int) -> str:
    total = sum(counts[truth])
    return f"{100 * counts[truth][said] / total:.0f}" if total else "–"


def _cases(failures: Sequence[Failures]) -> PageSection:
    head = ["", *(case.name for case in failures[0].cases)]
    rows, cards = [], []
    for each in failures:
        named = f"{_WORDS[each.table]}, {each.trial} ({each.variant})"
        rows.append([named, *(_share(case) for case in each.cases)])
        cards += [
            PageCardGroup(title=f"{named}: {case.name}", cards=_cards(case.examples))
            for case in each.cases
        ]
    return PageSection(
        title="The paper's failure cases, with pictures",
        text=[
            "% of the contacts of that shape, and how many there are. Our label of a plane's "
            "position is the centre of what is pressed, not the deepest point. Pictures show the "
            "clean gel from the sensor's side; of each case those of which CLTP was surest."
        ],
        table=PageTable(head=head, rows=rows),
        cards=cards,
    )


def _share(of: Failed) -> str:
    return "–" if of.percent is None else f"{of.percent:.0f} ({of.contacts})"


def _classes(failures: Failures) -> PageSection:
    rows, cards = [], []
    for slot in CLASSES:
        of_slot = [each for each in failures.classes if each.slot == slot and each.contacts]
        worst = sorted(of_slot, key=lambda each: -(each.percent or 0.0))
        words = ", ".join(f"{each.name} {_share(each)}" for each in worst)
        rows.append([slot, words or "–"])
        cards += [
            PageCardGroup(
                title=f"{slot} {each.name}: {each.wrong} of {each.contacts} wrong",
                cards=_cards(each.examples),
                is_open=False,
            )
            for each in worst
        ]
    return PageSection(
        title=f"Failures of CLTP by class: {_WORDS[failures.table]}, {failures.trial}",
        table=PageTable(head=["", "% wrong (contacts), worst first"], rows=rows),
        note=f"Encoder {failures.variant}, seed {failures.seed}; how sure: {failures.measure}.",
        cards=cards,
    )


def _cards(failures: Sequence[Failure]) -> list[PageCard]:
    return [
        PageCard(
            webp=one.image,
            lines=[
                f"is {one.truth} ({one.true_sure:.2f})",
                f"said {one.said} ({one.said_sure:.2f})",
                f"#{one.index} {one.object}",
            ],
        )
        for one in failures
    ]
