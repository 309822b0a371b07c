"""Objects to touch: solids as signed distances, meshes, skins, the catalogue, and ray casting.

Not here: poses, presses and labels of contacts (``sim.tcl3d``), bodies to grasp (``sim.grasp``).

May import: cltp, sim.gel.
"""
