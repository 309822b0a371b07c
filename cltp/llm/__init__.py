"""The language model behind the encoder: projector, reading tokens, generation, fast decoding.

Not here: training (``cltp.train``), the texts that it learns (``cltp.texts``, ``tacgrasp.lessons``)
and decisions made of its replies (``policies``).

May import: cltp, cltp.encoder, cltp.llm.constrained, cltp.tactile, cltp.texts.
"""
