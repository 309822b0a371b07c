"""Benchmarks of whole episodes, and of the rigs and drivers that they run on.

May import: cltp.tactile, policies, primitives, sim.emulators, sim.grasp, tacgrasp, tacgrasp.base,
tacgrasp.benchmarks, tacgrasp.config, tacgrasp.drivers, tacgrasp.episodes, tacgrasp.rig,
tacgrasp.runtime.
"""
