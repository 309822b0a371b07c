"""An emulated Universal Robots controller: dashboard, script and RTDE ports, motions, faults.

Not here: the driver of a UR (``tacgrasp.drivers.ur``), contacts (``sim.emulators.world``).

May import: primitives, sim.emulators.process.
"""
