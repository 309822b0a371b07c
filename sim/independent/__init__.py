"""A second generator of contacts, made in another way than ours on purpose, for tests alone.

Its gel is a spring foundation under a stretched membrane, its bodies are height functions over
other outlines, its noise has bands and blind spots. What reads these contacts as well as those that
it learned from has learned contacts, and not a generator. Labels follow the definitions of
``sim.tcl3d.labels``.

Not here: contacts to learn from (``sim.full``, ``sim.tcl3d``). Nothing that trains, and nothing
that makes data for training, may import this folder; a test holds it.

May import: cltp.data, cltp.tactile, sim.gel, sim.tcl3d.
"""
