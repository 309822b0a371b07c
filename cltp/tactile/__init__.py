"""Clouds, sensors and their noise, contact states, and how a state is computed without learning.

Not here: reading sensors and files (``cltp.sensing``), learned encoders (``cltp.encoder``).

May import: cltp.
"""
