"""Emulators that speak the real wire protocols, each in a process of its own.

They let the hardware drivers, with the unmodified device libraries, close the loop without
hardware: ``python -m sim.emulators KIND``. Every emulator has a control channel through which tests
and benchmarks inject faults and ask for the truth (``control``); ``spawn`` starts one as a child.
"""
