"""What a report says of results: rankings, figures, failures, which run it was."""

import dataclasses
from pathlib import Path

import pytest
import torch

from cltp.data.contact import Split
from cltp.data.dataset import ContactDataset
from cltp.errors import TouchError
from cltp.evaluation.features import EncodedContacts
from cltp.tactile.states import CLASSES
from tacgrasp.pretraining.report.failures import Failures, collect_failures, load_failures
from tacgrasp.pretraining.report.paper_numbers import PAPER
from tacgrasp.pretraining.report.rankings import rankings
from tacgrasp.pretraining.report.report import describe_run, report
from tacgrasp.pretraining.report.store import grouped, nested, save
from tests.fakes.fake_results import fake_result


def values(*five: float | None) -> dict[str, float | None]:
    return dict(zip(CLASSES, five, strict=True))


def test_the_order_of_methods_is_compared_where_all_were_measured() -> None:
    papers = {m: PAPER["zero_shot", m, "contact"] for m in ("cltp", "cltp_no_image")}
    rows = [
        fake_result(table="zero_shot", method=m, values=values(*five)) for m, five in papers.items()
    ]
    assert [one.paper == one.ours for one in rankings(grouped(rows))] == [True] * 5
    lower = dataclasses.replace(rows[0], values=values(1, 1, 99, 99, 99))
    assert [one.paper == one.ours for one in rankings(grouped([lower, rows[1]]))] == [
        False,
        False,
        True,
        True,
        True,
    ]
    assert not list(rankings(grouped(rows[:1])))


def test_figures_are_those_of_the_usual_encoder() -> None:
    deep = fake_result(variant="pointbert", values=dict.fromkeys(CLASSES, 90.0))
    assert nested(grouped([deep, fake_result()]))["probe"]["cltp"]["contact"]["shape"] == 50.0
    assert nested(grouped([deep]))["probe"]["cltp"]["contact"]["shape"] == 90.0
    assert "object" not in nested(grouped([deep]))["probe"]["cltp"]


@pytest.mark.parametrize(
    ("changed", "expected"),
    [
        ({}, "Without an accelerator."),
        ({"device": "NVIDIA H200"}, "With an accelerator (NVIDIA H200)."),
        ({"device": None}, "don't say on what encoders were trained"),
    ],
)
def test_the_report_says_which_run_it_is(changed: dict[str, object], expected: str) -> None:
    results = [fake_result(**changed), fake_result(seed=1, **changed)]
    text = describe_run(results, grouped(results))
    assert expected in text
    assert "One seed of pre-training; spread over 2 seeds of probes for CLTP" in text


@pytest.fixture(scope="module")
def data(tmp_path_factory: pytest.TempPathFactory) -> ContactDataset:
    from cltp.data.dataset_writer import DatasetWriter
    from tests.fakes.fake_contacts import fake_contact

    folder = tmp_path_factory.mktemp("contacts")
    with DatasetWriter(folder) as writer:
        for seed in range(4):
            writer.add(fake_contact(seed, split=Split.TEST))
    return ContactDataset(folder)


def four(shapes: list[str], predicted: list[str]) -> tuple[EncodedContacts, list[torch.Tensor]]:
    """Contacts of these shapes at one position, and scores: the last shape has the highest."""
    names = CLASSES["shape"]
    classes = torch.tensor([[names.index(shape), 0, 0, 0, -1] for shape in shapes])
    scores = [torch.zeros(4, len(of_slot)) for of_slot in CLASSES.values()]
    for row, name in enumerate(predicted):
        scores[0][row, names.index(name)] = 0.5 + row / 10
    scores[3][:, 0], scores[3][0, 1] = 0.5, 0.9  # the first is predicted elsewhere
    nothing = torch.zeros(4, 5)
    return EncodedContacts(nothing, nothing, classes, nothing, torch.arange(4)), scores


def test_failures_are_counted_by_class_and_by_the_papers_cases(
    data: ContactDataset, tmp_path: Path
) -> None:
    shapes = ["plane", "triangle", "triangle", "peak"]
    encoded, scores = four(shapes, ["plane", "peak", "peak", "peak"])
    found = collect_failures(fake_result(), data, encoded, scores, "probability")
    counts = {(f.dimension, f.name): (f.wrong, f.contacts) for f in (*found.classes, *found.cases)}
    assert counts["shape", "triangle"] == (2, 2)
    assert counts["shape", "peak"] == (0, 1)
    assert counts["shape", "triangle as peak"] == (2, 2)
    assert counts["shape", "peak as triangle"] == (0, 1)
    assert counts["shape", "sphere as ellipsoid"] == (0, 0)
    assert counts["position", "position of planes"] == (1, 1)
    assert counts["position", "position of all others"] == (0, 3)
    assert counts["area", "tiny"] == (0, 0)  # without labels
    triangle = next(f for f in found.classes if f.name == "triangle")
    assert [one.index for one in triangle.examples] == [2, 1]  # highest score first
    assert (triangle.examples[0].predicted, triangle.examples[0].predicted_score) == ("peak", 0.7)
    save(tmp_path, found)
    assert load_failures(tmp_path, "abc") == [found]
    save(tmp_path, fake_result())
    page = report(tmp_path, tmp_path)[1].read_text()
    assert page.count("predicted: peak (0.70)") == 2  # as a triangle, and as the paper's case


def test_failures_of_other_data_or_damaged_are_refused(
    data: ContactDataset, tmp_path: Path
) -> None:
    encoded, scores = four(["plane"] * 4, ["peak"] * 4)
    failures = collect_failures(fake_result(), data, encoded, scores, "cosine")
    path = save(tmp_path, failures)
    with pytest.raises(TouchError, match="other data"):
        load_failures(tmp_path, "def")
    path.write_text(path.read_text()[:100])
    with pytest.raises(TouchError, match=r"failures/.* is damaged"):
        load_failures(tmp_path, "abc")
    assert path.parent.name == Failures.folder == "failures"
