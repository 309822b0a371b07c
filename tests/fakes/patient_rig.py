"""The emulated rig with more patience, for tests that share a busy machine with others."""

from pathlib import Path

import yaml

from tacgrasp.config.layers import load
from tacgrasp.config.schema import RunConfig
from tests.paths import ROOT

SHIPPED = ROOT / "tacgrasp" / "rigs" / "emulated.yaml"


def fields() -> dict:
    """The fields of the rig's file."""
    rig = yaml.safe_load(SHIPPED.read_text())
    hardware = rig["hardware"]
    hardware["arm"] |= {"stale_ms": 400, "watchdog_hz": 10, "start_timeout_s": 30}
    hardware["gripper"] |= {"reply_timeout_ms": 100, "settle_timeout_s": 20}
    hardware["sensor"] |= {"read_timeout_s": 5, "connect_timeout_s": 10}
    return rig


def patient_rig(folder: Path) -> Path:
    """A rig file in ``folder``."""
    path = folder / "patient.yaml"
    path.write_text(yaml.safe_dump(fields()))
    return path


def patient_config(folder: Path, **changes: object) -> RunConfig:
    """A run of the strawberry on it, without a language model."""
    config, _ = load("strawberry", str(patient_rig(folder)))
    return config.model_copy(update={"policy": "rules", "record": folder, **changes})
