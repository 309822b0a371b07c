"""Time TACTO's own renderer, in an interpreter where TACTO is installed; run by its path.

Imports nothing of ours. With the versions that TACTO asks for it does not import on Python 3.11;
``pip install tacto "numpy<2" "networkx>=3" "pyglet<2"`` does. A ball of 9.5 mm lies 0.8 mm in the
gel of the sensor that it comes with, at 320 × 240; a frame is one call of its renderer with a
contact force, noise included. Prints one line of JSON: medians over 30 frames.
"""

from __future__ import annotations

import json
import os
import sys
import time
from statistics import median

os.environ.setdefault("PYOPENGL_PLATFORM", "egl")  # no screen here


def main() -> None:
    """Render a ball that presses, and print what a frame takes [ms]."""
    import numpy as np
    import tacto
    import trimesh

    renderer = tacto.Sensor(width=320, height=240, visualize_gui=False).renderer
    # The gel of its default sensor is centred on (22, 0, 15) mm and seen along +x.
    place, level = [0.022 + 0.00475 - 0.0008, 0.0, 0.015], [0.0, 0.0, 0.0]
    ball = trimesh.creation.icosphere(subdivisions=4, radius=0.00475)
    renderer.add_object(ball, "ball", position=place, orientation=level)
    poses = {"ball": (np.array(place), np.array(level))}
    wall, cpu = [], []
    for _ in range(33):
        begin, used = time.perf_counter(), time.process_time()
        colors, depths = renderer.render(poses, {"ball": 1.0}, noise=True)
        wall.append(1e3 * (time.perf_counter() - begin))
        cpu.append(1e3 * (time.process_time() - used))
    if np.shape(colors[0]) != (240, 320, 3):
        raise SystemExit(f"expected frames of 240 x 320, got {np.shape(colors[0])}")
    times = {
        "wall_ms": median(wall[3:]),
        "cpu_ms": median(cpu[3:]),
        "depth_mm": 1e3 * float(np.max(renderer.depth0[0] - depths[0])),
    }
    sys.stdout.write(json.dumps(times) + "\n")


if __name__ == "__main__":
    main()
