"""Friction between gel and body, with memory: traction, stick and slip, and what a sensor sees.

Not here: the pressure (``sim.gel.layer``), which is solved without friction; how a body moves
(``sim.grasp``).

May import: sim.gel, cltp.gel, cltp.tactile.
"""
