"""Presses of a gel at a sensor's own resolution, on finer and finer grids around the contact.

Not here: the plain press on one grid (``sim.gel.layer``).

May import: cltp.gel, sim.gel.
"""
