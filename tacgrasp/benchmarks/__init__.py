"""Benchmarks: measure the system, print figures, write them as JSON.

Not here: what has one right answer (``tests``), and the flags (``tacgrasp.cli.bench``).

May import: cltp, tacgrasp.base.
"""
