"""Setting up a bench: checking its devices, jogging, and the measurements for calibrations.

Not here: the checks of one device (``tacgrasp.drivers``), the commands (``tacgrasp.cli``).
"""
