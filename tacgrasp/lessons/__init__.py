"""Texts that teach and test the language model: instructions, questions, answers and advice.

Not here: captions (``cltp.texts``), training (``cltp.train``, ``tacgrasp.training``), and the rule
behind the advice (``policies.teacher``).

May import: cltp.checkpoints, cltp.data, cltp.llm, cltp.tactile, cltp.texts, policies, primitives,
tacgrasp.base, tacgrasp.config, tacgrasp.lessons.dialogue.
"""
