"""Driver of a gripper with one or two Dynamixel servos: bus, polling thread, force in newtons.

The force comes from a calibration file, measured with ``tacgrasp calibrate gripper``. Not here: the
emulated servos (``sim.emulators.dynamixel``), and when a grasp closes or opens (``primitives``).

May import: cltp, primitives, tacgrasp.base, tacgrasp.drivers.
"""
