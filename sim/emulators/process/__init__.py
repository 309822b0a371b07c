"""Processes around the emulators: start and end them, announce their addresses, inject faults.

Not here: the emulated devices themselves (``sim.emulators.ur``, ``dynamixel``, ``taxels``).

May import: primitives.
"""
