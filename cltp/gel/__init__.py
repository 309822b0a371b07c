"""The mechanics of a sensor's gel: its compliance, and the force that its heights need.

Not here: the simulation of contacts (``sim.gel``), learned readings (``cltp.encoder``).

May import: cltp.tactile.
"""
