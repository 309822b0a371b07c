"""Objects drawn as height functions: faces, round and sharp bodies, bars and dots, and their scans.

Not here: pose, press and labels of an object (``sim.full``).

May import: cltp, cltp.tactile, sim.gel.
"""
