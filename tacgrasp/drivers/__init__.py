"""Drivers of real devices, a folder for each device, with its settings in ``settings.py``.

A driver imports its manufacturer's library where it uses it. An arm and a gripper keep the
contracts of ``primitives.devices``, a sensor that of ``tacgrasp.rig.protocols``. Not here: a whole
rig (``tacgrasp.rig.hardware``), emulated devices (``sim.emulators``).

May import: cltp, primitives, tacgrasp.base.
"""
