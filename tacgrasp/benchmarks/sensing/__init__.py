"""Benchmarks of the gel, and of what is read from its shape, against truth and real frames.

Not here: scores of learned models on data sets (``tacgrasp.training``).

May import: cltp, sim.gel, sim.grasp, tacgrasp, tacgrasp.base, tacgrasp.benchmarks,
tacgrasp.benchmarks.loop, tacgrasp.bringup, tacgrasp.config, tacgrasp.rig.
"""
