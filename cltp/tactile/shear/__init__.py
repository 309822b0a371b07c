"""What a sensor with markers or taxels reports of shear: displacements and forces at its points.

Not here: the cloud of heights (``cltp.tactile.cloud``), which stays as it is for all sensors; how
a gel shears (``sim.gel.shear``).

May import: cltp, cltp.tactile.
"""
