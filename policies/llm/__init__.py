"""The language model as a policy: what it is asked in a step, and the D_t that it may answer with.

Also which questions it is not asked. Importing this package loads no torch, ``policy`` does. Not
here: what to advise (``policies.teacher``), D_t of the
rules in free words (``policies.speech``), reading an action out of any text
(``policies.extraction``).

May import: cltp, policies, policies.extraction, primitives.
"""
