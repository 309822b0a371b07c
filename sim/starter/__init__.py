"""The starter data set: analytic indenters and grasped bodies, pressed into gels and labelled.

The shipped weights were trained on it. Not here: objects of the catalogue (``sim.tcl3d``), files
and worker processes (``tacgrasp.datasets``).

May import: cltp.data, cltp.tactile, sim.gel, sim.grasp, sim.objects, sim.tcl3d.
"""
