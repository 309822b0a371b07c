"""Which data sets may be learned from, and that older ones can still be looked into."""

from dataclasses import asdict, replace

import numpy as np
import pytest

from cltp.data.contact import Contact, Gel, Split
from cltp.data.dataset import ContactDataset
from cltp.data.dataset_writer import DatasetWriter
from cltp.errors import TouchError
from cltp.tactile.cloud import cloud_from_heights
from cltp.tactile.measure import contact_state
from cltp.tactile.sensors import sensor_named
from sim.gel.layer import gel_of
from tacgrasp.__main__ import main
from tacgrasp.datasets import trainable
from tacgrasp.datasets.recipes import FULL_MAKER, TCL3D_MAKER
from tacgrasp.datasets.trainable import GENERATED, check_trainable

MINI = sensor_named("gelsight_mini")
GEL = gel_of("gelsight_mini")
FORMER = {"made_by": GENERATED, "maker": "2", "sensor": "gelsight_mini"}
"""What files of the set ``starter`` say of themselves."""


def stored(folder, gel=GEL, **about):
    x, y = np.meshgrid(np.linspace(-10, 10, 40), np.linspace(7, -7, 30))
    height_mm = (0.5 - (x**2 + y**2) / 20).clip(0).astype(np.float32)
    state = contact_state(cloud_from_heights(height_mm, MINI))
    with DatasetWriter(folder, about=about) as writer:
        for series in range(3):
            writer.add(
                Contact(
                    height_mm=height_mm,
                    sensor=MINI,
                    state=state,
                    object="ball",
                    series=series,
                    split=Split.TRAIN,
                    gel=Gel(**asdict(gel)),
                )
            )
    return ContactDataset(folder)


@pytest.fixture(autouse=True)
def few_are_enough(monkeypatch):
    monkeypatch.setattr(trainable, "ENOUGH", 2)


def test_sets_of_today_and_sets_of_others_may_be_learned_from(tmp_path):
    check_trainable(stored(tmp_path / "a", made_by=GENERATED, set="full", maker=FULL_MAKER))
    check_trainable(stored(tmp_path / "b", made_by=GENERATED, set="tcl3d", maker=TCL3D_MAKER))
    check_trainable(stored(tmp_path / "c"))


def test_a_set_of_an_older_recipe_is_refused_with_what_to_do(tmp_path):
    data = stored(tmp_path / "old", made_by=GENERATED, set="full", maker="full 0")
    with pytest.raises(TouchError, match=r"recipe 'full 0'.*data generate --set full --out"):
        check_trainable(data)


def test_a_set_that_is_no_longer_made_is_refused_with_what_to_do(tmp_path):
    data = stored(tmp_path / "old", **FORMER)
    with pytest.raises(TouchError, match=r"starter, which is no longer made.*generate --set full"):
        check_trainable(data)
    with pytest.raises(TouchError, match=r"recipe None of the set starter"):
        check_trainable(stored(tmp_path / "older", made_by=GENERATED))


def test_a_set_of_other_gels_is_refused_and_both_gels_are_named(tmp_path):
    soft = replace(GEL, young_mpa=0.145)
    data = stored(tmp_path / "soft", soft, made_by=GENERATED, set="tcl3d", maker=TCL3D_MAKER)
    with pytest.raises(TouchError, match=r"0.145 MPa.*0.423 MPa.*data generate --set full"):
        check_trainable(data)


@pytest.mark.parametrize("about", [{**FORMER, "set": "full", "maker": "full 0"}, FORMER])
def test_training_on_an_older_set_is_one_line_and_looking_into_it_works(about, tmp_path, capsys):
    folder = tmp_path / "old"
    stored(folder, **about)
    command = ["train", "cltp", "--data", str(folder), "--out", str(tmp_path / "out")]
    assert main(command) != 0
    shown = capsys.readouterr().err.strip()
    assert "not learned from" in " ".join(shown.split())
    assert "Traceback" not in shown
    assert not (tmp_path / "out").exists()
    assert main(["data", "inspect", str(folder)]) == 0
    assert main(["data", "stats", str(folder)]) == 0
