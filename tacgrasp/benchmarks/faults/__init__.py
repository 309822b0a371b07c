"""The fault benchmark: inject every fault into the emulated rig and measure the reaction.

Not here: the faults' effects on devices (``sim.emulators``), the reactions (``tacgrasp.drivers``,
``tacgrasp.runtime``).
"""
