"""Benchmarks of whole episodes, and of the rigs and drivers that they run on."""
