"""Benchmarks of whole episodes, and of the rigs and drivers that they run on.

Not here: injected faults (``tacgrasp.benchmarks.faults``).

May import: cltp, cltp.tactile, policies, primitives, sim.emulators, sim.grasp, sim.objects,
tacgrasp, tacgrasp.base, tacgrasp.benchmarks, tacgrasp.config, tacgrasp.drivers, tacgrasp.episodes,
tacgrasp.rig, tacgrasp.runtime, tacgrasp.serving.
"""
