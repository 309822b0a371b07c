"""From a cloud and an instruction to a Decision.

``rules`` (the teacher on the computed state), ``llm`` (Tac3D-LLM), baselines and ``recorded``; and
``extract``, which reads an action and a verdict out of what a policy said. Importing this package
loads no torch.
"""

from policies.errors import PolicyError
from policies.policy import Decision, Policy

__all__ = ["Decision", "Policy", "PolicyError"]
