"""Scores of frozen encoders and of the language model on contacts that they did not learn from.

Evaluation splits, encoded contacts, zero-shot prompts, probes, retrieval and the geometric baseline
that all of them are compared with. Not here: training (``cltp.train``), and the tables and commands
that show these scores (``tacgrasp.pretraining``, ``tacgrasp.training.evaluate``).

May import: cltp, cltp.checkpoints, cltp.data, cltp.encoder, cltp.tactile, cltp.texts,
cltp.train.
"""
