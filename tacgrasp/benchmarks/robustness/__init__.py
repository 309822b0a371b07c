"""The robustness benchmark: each nuisance of a sensor at several levels, all others nominal.

Not here: the nuisances themselves (``cltp.tactile.sensor_noise``, ``sim.grasp``), episodes
(``tacgrasp.benchmarks.loop``).

May import: cltp, policies.llm, sim.full, sim.gel, sim.grasp, tacgrasp, tacgrasp.base,
tacgrasp.benchmarks, tacgrasp.benchmarks.loop, tacgrasp.config, tacgrasp.lessons.
"""
