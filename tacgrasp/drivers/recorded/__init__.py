"""A sensor that plays a recording: an episode or a folder of contacts.

For looking at a policy without a sensor; a grasp needs a real one. Not here: a GelSight Mini that
plays a video or images (``tacgrasp.drivers.gelsight``).

May import: cltp, tacgrasp.drivers, tacgrasp.episodes.
"""
