"""An emulated serial taxel array: packets over a pty, with faults.

Not here: the driver of an array (``tacgrasp.drivers.taxels``), the packet format
(``cltp.sensing.taxel_packets``).

May import: cltp.sensing, sim.emulators.process.
"""
