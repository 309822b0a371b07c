"""Episodes in formats of other programs: a Parquet table, a data set of LeRobot.

Not here: rerun's format (``tacgrasp.viewer``), episodes themselves, which viewers of MCAP open.

May import: cltp, primitives, tacgrasp.episodes.
"""
