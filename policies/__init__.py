"""Policies: from a tactile cloud and an instruction to a decision in words.

The rule-based teacher, Tac3D-LLM and baselines; ``policies.extraction`` reads the action out of the
words. Importing this package loads no torch. Not here: the loop that carries decisions out
(``tacgrasp.loop``), and the training of the model (``cltp.train``, ``tacgrasp.lessons``).

May import: cltp, policies.extraction, policies.instructions, primitives.
"""

from policies.errors import PolicyError
from policies.observation import Observation
from policies.policy import Decision, Policy, checked, decision_of

__all__ = ["Decision", "Observation", "Policy", "PolicyError", "checked", "decision_of"]
