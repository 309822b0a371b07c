"""The fault benchmark: inject every fault into the emulated rig and measure the reaction.

Not here: the faults' effects on devices (``sim.emulators``), the reactions (``tacgrasp.drivers``,
``tacgrasp.runtime``).

May import: cltp, primitives, sim.emulators, tacgrasp, tacgrasp.base, tacgrasp.benchmarks,
tacgrasp.config, tacgrasp.drivers, tacgrasp.episodes, tacgrasp.rig, tacgrasp.runtime.
"""
