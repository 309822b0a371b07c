"""Parts of the loop: steps and their bounds, verification, the reflex, ends, the safe shutdown.

Not here: the order of a step's stages (``tacgrasp.loop``), the devices (``tacgrasp.rig``).

May import: cltp, policies, primitives, tacgrasp.base, tacgrasp.config, tacgrasp.drivers,
tacgrasp.episodes, tacgrasp.rig.
"""
