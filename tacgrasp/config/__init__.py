"""The configuration of a run: its model, its layers of files and variables, and its error messages.

Not here: the settings of each driver (``tacgrasp.drivers``), the flags (``tacgrasp.cli``).

May import: policies, primitives, tacgrasp.base, tacgrasp.drivers.
"""
