"""The contrastive loss by hand, with several that fit, and spread over processes."""

import math
import os
import subprocess
import sys
from itertools import product
from pathlib import Path

import pytest
import torch

from cltp.encoder.all_gather import averaged_gradients, gathered, num_processes
from cltp.encoder.losses import CltpLoss, ContrastiveLoss
from tests.cltp.encoder.gather_ranks import step
from tests.paths import ROOT

HERE = Path(__file__).resolve().parent


def test_two_processes_give_the_loss_and_gradients_of_one(tmp_path: Path) -> None:
    environment = {**os.environ, "OMP_NUM_THREADS": "1", "PYTHONPATH": f"{ROOT}:{HERE}"}
    ranks = [
        subprocess.Popen(
            [sys.executable, str(HERE / "gather_ranks.py"), str(rank), "2", str(tmp_path)],
            env=environment,
        )
        for rank in range(2)
    ]
    try:
        assert [rank.wait(timeout=120) for rank in ranks] == [0, 0]
    finally:
        for rank in ranks:
            rank.kill()
    for rank, several in product(range(2), (False, True)):
        alone = step(0, 8, several=several)
        gradients = torch.load(tmp_path / f"{rank}-{several}.pt", weights_only=True)
        assert gradients.keys() == alone.keys()
        for name, value in alone.items():
            torch.testing.assert_close(gradients[name], value, rtol=1e-5, atol=1e-5)


def test_one_process_alone_gathers_nothing() -> None:
    rows = torch.randn(3, 2, requires_grad=True)
    assert num_processes() == 1
    assert gathered(rows) is rows
    parameter = torch.nn.Parameter(torch.ones(2))
    parameter.grad = torch.tensor([1.0, 2.0])
    averaged_gradients([parameter])
    assert parameter.grad.tolist() == [1.0, 2.0]


def test_a_row_that_fits_two_wants_half_of_each() -> None:
    loss = ContrastiveLoss()
    with torch.no_grad():
        loss.log_scale.fill_(0.0)
    one = torch.tensor([[1.0, 0.0], [0.0, 1.0]])
    fits = torch.ones(2, 2, dtype=torch.bool)
    # Every row: logits 1 and 0, wanted one half of each: log(1 + e) - 1/2.
    assert loss(one, one, fits).item() == pytest.approx(math.log(1 + math.e) - 0.5, rel=1e-6)


def test_fitting_ones_own_alone_is_the_plain_loss() -> None:
    torch.manual_seed(0)
    one, other, loss = torch.randn(5, 4), torch.randn(5, 4), ContrastiveLoss()
    own = torch.eye(5, dtype=torch.bool)
    torch.testing.assert_close(loss(one, other, own), loss(one, other))


def test_contacts_without_a_class_do_not_count_against_prompts() -> None:
    loss = CltpLoss()
    touch, prompts = torch.randn(3, 4), torch.nn.functional.normalize(torch.randn(2, 4), dim=-1)
    some = loss.against_prompts(touch, prompts, torch.tensor([1, -1, 0]))
    those = loss.against_prompts(touch[[0, 2]], prompts, torch.tensor([1, 0]))
    torch.testing.assert_close(some, those)
    assert loss.against_prompts(touch, prompts, torch.tensor([-1, -1, -1])).item() == 0.0
