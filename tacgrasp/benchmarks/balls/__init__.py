"""Benchmarks on frames of a pressed ball: heights, presses needed, gains, captions.

Not here: calibrating a unit (``cltp.train.photometric``), the noise of its heights
(``tacgrasp.benchmarks.sensing``).

May import: cltp, tacgrasp, tacgrasp.base, tacgrasp.benchmarks, tacgrasp.bringup, tacgrasp.lessons.
"""
