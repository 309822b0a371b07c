"""Trained weights on disk: written, read strictly, and refused where they are damaged or don't fit.

Not here: checkpoints of a training under way (``cltp.train.stage``).

May import: cltp, cltp.data, cltp.encoder, cltp.llm, cltp.tactile, cltp.texts.
"""
