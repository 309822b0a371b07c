"""Recorded and scripted behaviour: replay an episode, play a demo, describe a contact from a file.

Not here: reading episodes (``tacgrasp.episodes``), the commands' flags (``tacgrasp.cli``).

May import: cltp, policies, primitives, sim.grasp, tacgrasp, tacgrasp.base, tacgrasp.config,
tacgrasp.episodes, tacgrasp.lessons, tacgrasp.rig, tacgrasp.runtime.
"""
