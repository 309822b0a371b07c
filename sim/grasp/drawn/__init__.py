"""What is drawn for a held body: loads, drags along a support, grips that grow ever firmer.

For training and measuring what tells a slip. Not here: the dynamics (``sim.grasp.holding``,
``sim.grasp.world``), errors of a sensor.

May import: cltp, sim.gel, sim.grasp.
"""
