"""Driver of a serial taxel array that sends the packets of docs/taxels.md.

Not here: the packets (``cltp.sensing.taxel_packets``), the emulated array
(``sim.emulators.taxels``).

May import: cltp, primitives, tacgrasp.base, tacgrasp.drivers.
"""
