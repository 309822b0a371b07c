"""An emulated gripper of one or two Dynamixel X-series servos on a pty, with faults.

Not here: the driver of such a gripper (``tacgrasp.drivers.dynamixel``), the gripped object
(``sim.emulators.world``).

May import: sim.emulators.process.
"""
