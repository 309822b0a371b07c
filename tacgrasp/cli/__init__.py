"""The commands: one module each with ``main(argv) -> exit code``, imported only when it is needed.

Not here: the work of a command (the folder that its module imports), the dispatch and the exit
codes of errors (``tacgrasp.__main__``).

May import: cltp, policies, primitives, sim.emulators, tacgrasp, tacgrasp.base, tacgrasp.benchmarks,
tacgrasp.bringup, tacgrasp.config, tacgrasp.datasets, tacgrasp.drivers, tacgrasp.episodes,
tacgrasp.episodes.export, tacgrasp.lessons, tacgrasp.playback, tacgrasp.pretraining,
tacgrasp.pretraining.report, tacgrasp.rig, tacgrasp.runtime, tacgrasp.serving, tacgrasp.training,
tacgrasp.viewer.
"""
