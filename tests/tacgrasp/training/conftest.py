from pathlib import Path

import pytest

from tests.fakes.tiny_weights import make_weights


@pytest.fixture(scope="module")
def weights(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Weights of the tiniest sizes, each module its own."""
    return make_weights(tmp_path_factory.mktemp("weights"))
