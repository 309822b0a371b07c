"""From a sensor's frames, packets and files to height maps and clouds, with its calibration.

Not here: device drivers (``tacgrasp.drivers``), what a cloud means (``cltp.tactile``).

May import: cltp, cltp.tactile.
"""
