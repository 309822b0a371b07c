"""The tactile encoder: tokenizers, transformer, state heads, losses, masked modelling, and CLIP.

Everything here is a module or a loss over tensors. Not here: training (``cltp.train``) and files of
weights (``cltp.checkpoints``).

May import: cltp, cltp.gel, cltp.tactile, cltp.texts.
"""
