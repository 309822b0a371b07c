"""Calibrating a sensor on presses of a ball: from frames to the network that reads slopes.

Not here: the network in use (``cltp.sensing.photometric``), its file
(``cltp.sensing.calibration``).

May import: cltp, cltp.sensing, cltp.tactile.
"""
