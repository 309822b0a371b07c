"""Drivers of real devices: each captures or commands, and imports its SDK where it is used.

An arm and a gripper keep the contracts of ``primitives.devices``, a sensor that of
``tacgrasp.rig.sensor``. ``tacgrasp.rig.hardware`` composes them into a rig.
"""
