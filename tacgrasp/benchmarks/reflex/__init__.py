"""``tacgrasp bench reflex``: drawn loads on held bodies, and the pace of the reflex.

Not here: the reflex (``policies.reflex``), its training (``tacgrasp.training.slip``).

May import: cltp, policies, primitives, sim, tacgrasp, tacgrasp.base, tacgrasp.benchmarks,
tacgrasp.config, tacgrasp.drivers, tacgrasp.runtime.
"""
