"""Views of a run and of its record: the live table of a terminal, and rerun.

Not here: plain lines (``tacgrasp.console``), pictures of an episode (``tacgrasp.episodes.plot``).

May import: cltp.sensing, cltp.tactile, primitives, tacgrasp, tacgrasp.base, tacgrasp.config,
tacgrasp.episodes, tacgrasp.rig.
"""
