"""The elastic gel of a tactile sensor under a rigid or soft body: surface, pressure, force.

Not here: the pressing bodies and objects (``sim.objects``, ``sim.grasp``, ``sim.full``), sensor
noise (``cltp.tactile.sensor_noise``).

May import: cltp.gel, cltp.sensing, cltp.tactile.
"""
