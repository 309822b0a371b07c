"""What a report says of results: goals missed, orders, tries, failures, which run it was."""

import dataclasses
import math
from pathlib import Path

import pytest
import torch

from cltp.data.contact import Split
from cltp.data.dataset import ContactDataset
from cltp.errors import TouchError
from cltp.evaluation.features import Observed
from cltp.tactile.states import CLASSES
from tacgrasp.base.errors import UsageError
from tacgrasp.pretraining.report.ablations import COLUMNS, FILE, load_tries
from tacgrasp.pretraining.report.failures import FOLDER, collect, load_failures, save_failures
from tacgrasp.pretraining.report.paper_numbers import PAPER
from tacgrasp.pretraining.report.report import report, which_it_is
from tacgrasp.pretraining.report.store import Result, nested, save
from tacgrasp.pretraining.report.targets import best_of_others, goals, orders
from tests.fakes.fake_results import fake_result


def values(*five: float | None) -> dict[str, float | None]:
    return dict(zip(CLASSES, five, strict=True))


def missed(found: list[Result]) -> dict[tuple[str, str, str, str], float]:
    return {
        (g.table, g.method, g.trial, g.quantity): g.missed_by
        for g in goals(found)
        if not math.isnan(g.missed_by)
    }


def test_a_figure_is_missed_by_what_lacks_to_the_papers() -> None:
    found = missed([fake_result(values=values(80.0, 96.1, 99.3, None, 90.0))])
    assert found["probe", "cltp", "contact", "shape"] == pytest.approx(4.8)
    assert found["probe", "cltp", "contact", "texture"] == 0
    assert found["probe", "cltp", "contact", "depth"] == 0
    assert found["probe", "cltp", "contact", "area"] == pytest.approx(7.1)
    assert len(found) == 4  # the position was not measured, nor anything else


def test_what_other_encoders_give_stands_beside_what_is_missed(tmp_path: Path) -> None:
    usual = fake_result(values=values(80.0, 90.0, 99.3, None, 90.0))
    fine = fake_result(variant="small_fine", values=values(83.0, 95.0, 99.0, None, None))
    dense = fake_result(variant="small_pressed", values=values(82.0, 97.5, 99.0, None, None))
    rows = [usual, fine, dense]
    beside = {
        g.quantity: best_of_others(rows, g)
        for g in goals(rows)
        if (g.table, g.method, g.trial) == ("probe", "cltp", "contact")
    }
    assert beside["shape"] == (83.0, "small_fine")
    assert beside["texture"] == (97.5, "small_pressed")
    assert beside["area"] is None
    shares = [{"coverage_force": 83.0}, {"coverage_force": 99.0}, {"coverage_force": 84.0}]
    variants = ("small_graded", "small_fine", "small_pressed")
    numbers = [
        fake_result(table="numbers", trial="object", variant=variant, values=share)
        for variant, share in zip(variants, shares, strict=True)
    ]
    (force,) = (g for g in goals(numbers) if (g.trial, g.quantity) == ("object", "coverage_force"))
    assert best_of_others(numbers, force) == (84.0, "small_pressed")
    for row in rows:
        save(tmp_path, row)
    page = report(tmp_path, tmp_path)[0].read_text()
    assert "| 96.1 | 90.0 | 6.10 | – | 97.5 (small_pressed) | the paper's |" in page


def test_unseen_objects_may_be_three_points_lower() -> None:
    found = missed([fake_result(trial="object", values=values(81.8, 93.0, 96.2, 92.9, 94.1))])
    assert found["probe", "cltp", "object", "shape"] == pytest.approx(0)
    assert found["probe", "cltp", "object", "texture"] == pytest.approx(0.1)


def test_noise_lowers_what_is_asked_to_the_ceiling_and_no_further() -> None:
    ours = fake_result(trial="physics", values=values(70.0, 92.7, 79.0, 81.0, 77.2))
    ceiling = fake_result(
        method="ceiling",
        variant="measured",
        trial="physics",
        values=values(None, None, 80.0, 95.0, 60.0),
    )
    found = missed([ours, ceiling])
    assert found["probe", "cltp", "physics", "shape"] == pytest.approx(1.2)
    assert found["probe", "cltp", "physics", "depth"] == pytest.approx(1.0)  # the ceiling
    assert found["probe", "cltp", "physics", "position"] == pytest.approx(0.4)  # the paper's
    assert found["probe", "cltp", "physics", "area"] == 0


def test_intervals_can_hold_too_little_and_too_much() -> None:
    names = ("depth", "position", "area", "force")
    shares = dict(zip((f"coverage_{n}" for n in names), (86.0, 88.0, 93.5, 92.0), strict=True))
    found = missed([fake_result(table="numbers", values=shares)])
    told = [found["numbers", "cltp", "contact", f"coverage_{n}"] for n in names]
    assert told == pytest.approx([2.0, 0.0, 1.5, 0.0])
    errors = {"depth_mm": 0.04, "position_mm": 0.1, "area_percent": 8.5, "force_percent": 9.0}
    found = missed([fake_result(table="numbers", trial="object", values=errors)])
    assert found["numbers", "cltp", "object", "depth_mm"] == pytest.approx(0.01)
    assert found["numbers", "cltp", "object", "area_percent"] == pytest.approx(0.5)


def test_the_order_of_methods_is_compared_where_all_were_measured() -> None:
    papers = {m: PAPER["zero_shot", m, "contact"] for m in ("cltp", "cltp_no_image")}
    rows = [
        fake_result(table="zero_shot", method=m, values=values(*five)) for m, five in papers.items()
    ]
    assert [order.paper == order.ours for order in orders(rows)] == [True] * 5
    lower = dataclasses.replace(rows[0], values=values(1, 1, 99, 99, 99))
    assert [o.paper == o.ours for o in orders([lower, rows[1]])] == [False, False, True, True, True]
    assert not list(orders(rows[:1]))


def test_figures_are_those_of_the_usual_encoder() -> None:
    deep = fake_result(variant="pointbert", values=dict.fromkeys(CLASSES, 90.0))
    assert nested([deep, fake_result()])["probe"]["cltp"]["contact"]["shape"] == 50.0
    assert nested([deep])["probe"]["cltp"]["contact"]["shape"] == 90.0
    assert "object" not in nested([deep])["probe"]["cltp"]


@pytest.mark.parametrize(
    ("changed", "expected"),
    [
        ({}, "Without an accelerator."),
        ({"device": "NVIDIA H200"}, "With an accelerator (NVIDIA H200)."),
        ({"device": None}, "don't say on what encoders were trained"),
    ],
)
def test_the_report_says_which_run_it_is(changed: dict[str, object], expected: str) -> None:
    said = which_it_is([fake_result(**changed), fake_result(seed=1, **changed)])
    assert expected in said
    assert "one seed of pre-training; spread over 2 seeds of probes for CLTP" in said


def test_tries_are_shown_with_their_figures(tmp_path: Path) -> None:
    save(tmp_path, fake_result())
    assert "What was tried" not in report(tmp_path, tmp_path)[0].read_text()
    head = ",".join(COLUMNS)
    row = 'groups,128 groups,probe,contact,61.5,,,,,"slower, no better",tacgrasp train cltp'
    (tmp_path / FILE).write_text(f"{head}\n{row}\n")
    page = report(tmp_path, tmp_path)[0].read_text()
    assert (
        "| 128 groups | groups | probe, contact | 61.5 | – | – | – | – | slower, no better |"
        in page
    )


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("about,tried\n", "needs the columns"),
        (f"{','.join(COLUMNS)}\na,b,probe,contact,much,,,,,,\n", "row 2: no number in shape"),
        (f"{','.join(COLUMNS)}\na,b,probe,contact,140,,,,,,\n", "row 2: shape 140 is no percent"),
        (f"{','.join(COLUMNS)}\na,b,table,contact,1,,,,,,\n", "row 2: needs what was tried"),
        (f"{','.join(COLUMNS)}\na,b,probe,contact,1,,,,,,,x\n", "row 2: more cells"),
    ],
)
def test_wrong_tries_are_named_by_row(tmp_path: Path, text: str, expected: str) -> None:
    (tmp_path / FILE).write_text(text)
    with pytest.raises(UsageError, match=expected):
        load_tries(tmp_path)


@pytest.fixture(scope="module")
def data(tmp_path_factory: pytest.TempPathFactory) -> ContactDataset:
    from cltp.data.dataset import DatasetWriter
    from tests.fakes.fake_contacts import fake_contact

    folder = tmp_path_factory.mktemp("contacts")
    with DatasetWriter(folder) as writer:
        for seed in range(4):
            writer.add(fake_contact(seed, split=Split.TEST))
    return ContactDataset(folder)


def four(shapes: list[str], said: list[str]) -> tuple[Observed, list[torch.Tensor]]:
    """Contacts of these shapes at one place, and what is said of them: the last most surely."""
    names = CLASSES["shape"]
    classes = torch.tensor([[names.index(shape), 0, 0, 0, -1] for shape in shapes])
    sure = [torch.zeros(4, len(of_slot)) for of_slot in CLASSES.values()]
    for row, name in enumerate(said):
        sure[0][row, names.index(name)] = 0.5 + row / 10
    sure[3][:, 0], sure[3][0, 1] = 0.5, 0.9  # the first is put elsewhere
    seen = Observed(torch.zeros(4, 2), torch.zeros(4, 2), classes, torch.zeros(4, 5),
                    torch.arange(4))  # fmt: skip
    return seen, sure


def test_failures_are_counted_by_class_and_by_the_papers_cases(
    data: ContactDataset, tmp_path: Path
) -> None:
    seen, sure = four(["plane", "triangle", "triangle", "peak"], ["plane", "peak", "peak", "peak"])
    found = collect(fake_result(), data, seen, sure, "probability")
    counts = {(f.slot, f.name): (f.wrong, f.contacts) for f in (*found.classes, *found.cases)}
    assert counts["shape", "triangle"] == (2, 2)
    assert counts["shape", "peak"] == (0, 1)
    assert counts["shape", "triangle as peak"] == (2, 2)
    assert counts["shape", "peak as triangle"] == (0, 1)
    assert counts["shape", "sphere as ellipsoid"] == (0, 0)
    assert counts["position", "place of planes"] == (1, 1)
    assert counts["position", "place of everything else"] == (0, 3)
    assert counts["area", "tiny"] == (0, 0)  # nobody named one
    triangle = next(f for f in found.classes if f.name == "triangle")
    assert [one.index for one in triangle.examples] == [2, 1]  # the surest first
    assert (triangle.examples[0].said, triangle.examples[0].said_sure) == ("peak", 0.7)
    save_failures(tmp_path, fake_result(), found)
    assert load_failures(tmp_path, "abc") == [found]
    save(tmp_path, fake_result())
    page = report(tmp_path, tmp_path)[1].read_text()
    assert page.count("said peak (0.70)") == 2  # as a triangle, and as the paper's case


def test_failures_of_other_data_or_damaged_are_refused(
    data: ContactDataset, tmp_path: Path
) -> None:
    seen, sure = four(["plane"] * 4, ["peak"] * 4)
    path = save_failures(
        tmp_path, fake_result(), collect(fake_result(), data, seen, sure, "cosine")
    )
    with pytest.raises(TouchError, match="other data"):
        load_failures(tmp_path, "def")
    path.write_text(path.read_text()[:100])
    with pytest.raises(TouchError, match="are damaged"):
        load_failures(tmp_path, "abc")
    assert path.parent.name == FOLDER
