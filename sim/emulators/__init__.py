"""Emulators of the devices, which speak the real wire protocols, each in a process of its own.

They let the hardware drivers, with the unmodified device libraries, close the loop without
hardware: ``python -m sim.emulators KIND``. Tests and benchmarks inject faults and read the true
state through a control channel (``process.control``); ``process.spawn`` starts a child process.

Not here: the drivers (``tacgrasp.drivers``), and the simulated devices without wire protocols
(``sim.grasp``).

May import: cltp, primitives, sim.emulators.dynamixel, sim.emulators.process, sim.emulators.taxels,
sim.emulators.ur, sim.grasp.
"""
