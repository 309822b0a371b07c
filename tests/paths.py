"""Where the project stands, and where data that is not part of it may lie beside it."""

from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
SHARED_DATA = ROOT.parent / "shared" / "data"
"""Real frames and meshes; tests that read them skip, saying so, where they are absent."""
