"""From an observation and an instruction to a Decision.

``rules`` (the teacher on the computed state), ``llm`` (Tac3D-LLM) and baselines; and ``extract``,
which reads an action and a verdict out of a policy's text. Importing this package
loads no torch.
"""

from policies.errors import PolicyError
from policies.observation import Observation
from policies.policy import Decision, Policy

__all__ = ["Decision", "Observation", "Policy", "PolicyError"]
