"""Stands in for a manufacturer's library: a bench that is reached by its name.

A real plugin has no such module; it imports the library of its devices.
"""

from dataclasses import dataclass

from sim.grasp.rig import SimRig, build


@dataclass
class Bench:
    """A simulated bench, and how many of its devices are connected."""

    rig: SimRig
    num_connected: int = 0


_benches: dict[str, Bench] = {}


def join(name: str, seed: int) -> SimRig:
    """The bench of this name; the first device that joins it sets it up."""
    if name not in _benches:
        _benches[name] = Bench(rig=build("strawberry", seed, start_offset_mm=(1.0, 4.5)))
    _benches[name].num_connected += 1
    return _benches[name].rig


def leave(name: str) -> None:
    """Leave the bench; it is gone when its last device has left."""
    bench = _benches.get(name)
    if bench is not None:
        bench.num_connected -= 1
        if not bench.num_connected:
            del _benches[name]
