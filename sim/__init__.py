"""Simulated worlds: elastic gel, objects, grasps, and emulators of real devices.

They generate contacts to learn from and stand in for a robot in the closed loop. Not here: drivers
of real devices (``tacgrasp.drivers``). No policy may see the truth of a simulated world.

May import: nothing of ours.
"""
