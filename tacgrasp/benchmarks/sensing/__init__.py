"""Benchmarks of the gel, and of what is read from its shape, against truth and real frames."""
