"""``tacgrasp eval ablate``: what the language model does without a part of its input.

Not here: how good it is with all of it (``tacgrasp.training.evaluate``).

May import: cltp, policies, sim.grasp, tacgrasp, tacgrasp.benchmarks.loop,
tacgrasp.config, tacgrasp.lessons, tacgrasp.rig, tacgrasp.runtime, tacgrasp.training.
"""
