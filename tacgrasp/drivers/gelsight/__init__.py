"""Driver of a GelSight Mini: its camera or a recording, the capture thread, its background image.

Not here: frames to heights (``cltp.sensing.photometric``), learning a unit's calibration
(``tacgrasp calibrate gelsight-mini``).

May import: cltp, tacgrasp.base, tacgrasp.drivers.
"""
