"""Data sets of labelled contacts: the record, its files, and the batches that learning draws.

Not here: simulating contacts (``sim``), commands on data sets (``tacgrasp.datasets``).

May import: cltp, cltp.tactile.
"""
