"""Driver of a Universal Robots arm: a supervised worker process around ur_rtde.

Not here: the limits of a task, which are narrower (``primitives.limits``), and the emulated
controller (``sim.emulators.ur``).

May import: primitives, tacgrasp.base, tacgrasp.drivers.
"""
