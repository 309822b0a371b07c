"""Worlds: elastic gel, bodies, simulated arm, gripper and sensor, emulators, contact generation.

Nothing here is for use on a robot, and nothing of its truth may reach a policy.
"""
