"""The rig of an episode: its contract, and its simulated, emulated and hardware versions.

Not here: the device drivers (``tacgrasp.drivers``), the simulated devices (``sim.grasp``).

May import: cltp, primitives, sim.emulators, sim.grasp, tacgrasp.base, tacgrasp.config,
tacgrasp.drivers, tacgrasp.episodes.
"""
