"""Rows of tables with nothing measured behind them."""

from cltp.tactile.states import CLASSES
from tacgrasp.pretraining.report.store import USUAL_VARIANTS, Budget, Result


def fake_result(**changed: object) -> Result:
    """A row of probes of CLTP at 50 % on ``contact``, but for what is changed."""
    usual: dict[str, object] = {
        "table": "probe",
        "method": "cltp",
        "variant": USUAL_VARIANTS[str(changed.get("method", "cltp"))],
        "split": "contact",
        "seed": 0,
        "data": "abc",
        "budget": Budget(steps=10, batch_size=4),
        "command": "tacgrasp eval probe",
        "contacts": 7,
        "values": dict.fromkeys(CLASSES, 50.0),
        "device": "cpu",
        "learned_seed": 0,
    }
    return Result(**{**usual, **changed})  # type: ignore[arg-type]
