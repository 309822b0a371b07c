"""``tacgrasp bench reflex``: drawn loads on held bodies, the pace, and the wire.

Not here: the reflex (``policies.reflex``), its training (``tacgrasp.training.slip``).

May import: cltp, policies, primitives, sim, tacgrasp, tacgrasp.base, tacgrasp.benchmarks,
tacgrasp.config, tacgrasp.drivers, tacgrasp.episodes, tacgrasp.rig, tacgrasp.runtime.
"""
