"""Setting up a bench: checking its devices, jogging, and the measurements for calibrations.

Not here: the checks of one device (``tacgrasp.drivers``), the commands (``tacgrasp.cli``).

May import: cltp, primitives, sim.emulators, sim.gel, sim.grasp, tacgrasp, tacgrasp.base,
tacgrasp.config, tacgrasp.drivers, tacgrasp.rig.
"""
