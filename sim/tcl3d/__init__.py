"""The TCL3D data set: objects of the catalogue pressed into gels, with true labels.

Not here: files and worker processes (``tacgrasp.datasets``), captions (``cltp.texts``).

May import: cltp.data, cltp.tactile, sim.gel, sim.objects.
"""
