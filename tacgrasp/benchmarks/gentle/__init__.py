"""``tacgrasp bench gentle``: fruit that nothing was trained on, held firmly enough and no more.

Not here: which fruit there are (``sim.grasp.fruit``).

May import: cltp, policies, primitives, sim.grasp, tacgrasp, tacgrasp.base, tacgrasp.benchmarks,
tacgrasp.config, tacgrasp.episodes, tacgrasp.rig, tacgrasp.runtime.
"""
