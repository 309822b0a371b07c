"""``tacgrasp bench limits``: simulated episodes with a fault in each; the hard limit must hold.

Not here: faults of devices on the wire (``tacgrasp.benchmarks.faults``), keeping the limit
(``primitives.force_guard``, ``policies.reflex``).

May import: cltp, policies, primitives, sim.grasp, tacgrasp, tacgrasp.base, tacgrasp.benchmarks,
tacgrasp.config, tacgrasp.episodes, tacgrasp.rig, tacgrasp.runtime.
"""
