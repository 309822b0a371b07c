"""Benchmarks of the cost of models and data: encoders, decisions, simulated contacts.

Not here: how right models are (``tacgrasp.training``, ``tacgrasp.pretraining``).

May import: cltp, policies, policies.llm, primitives, sim.gel, sim.gel.fine, sim.tcl3d, tacgrasp,
tacgrasp.base, tacgrasp.benchmarks, tacgrasp.config, tacgrasp.episodes, tacgrasp.rig.
"""
