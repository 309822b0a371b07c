"""Training behind a language model that others made.

Not here: our own small one (``cltp.train.llm``), whose exchanges and stages are used.

May import: cltp, cltp.checkpoints, cltp.data, cltp.llm, cltp.train.
"""
