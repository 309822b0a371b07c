"""Benchmarks of trained weights on contacts that come from elsewhere than those they learned from.

Not here: scores on the test splits of our own data sets (``tacgrasp.training``,
``tacgrasp.pretraining``).

May import: cltp, sim.grasp, sim.independent, tacgrasp, tacgrasp.base, tacgrasp.benchmarks,
tacgrasp.benchmarks.loop, tacgrasp.datasets.
"""
