"""The data set ``full``: contacts as varied as those of the world, with true labels.

Not here: the paper's data set (``sim.tcl3d``), contacts for tests alone (``sim.independent``),
files and worker processes (``tacgrasp.datasets``).

May import: cltp.data, cltp.tactile, sim.full.drawn, sim.gel, sim.grasp, sim.objects, sim.tcl3d.
"""
