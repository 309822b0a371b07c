"""Benchmarks of the cost of models and data: encoders, decisions, simulated contacts.

Not here: how right models are (``tacgrasp.training``, ``tacgrasp.pretraining``).
"""
