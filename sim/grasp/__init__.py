"""The world of the closed loop: one body between two gel fingers, with simulated devices around it.

Friction, slip, bruises and the truth of an episode are here. Not here: emulated devices that speak
the protocols of real ones (``sim.emulators``).

May import: cltp, primitives, sim.gel, sim.objects.
"""
