"""D_t of the language model: what it is asked in a step, and the text that it may answer with.

Also which questions it is not asked. Not here: what to advise (``policies.teacher``), D_t of the
rules in free words (``policies.speech``), reading an action out of any text
(``policies.extraction``).

May import: cltp.llm.constrained, cltp.tactile, cltp.texts, policies, primitives.
"""
