"""The weights that the llm policy uses: their training, their evaluation and their model card.

Not here: the comparison of encoders with the paper's methods (``tacgrasp.pretraining``).

May import: cltp, policies, policies.llm, primitives, sim.full, sim.gel, sim.grasp, tacgrasp,
tacgrasp.base, tacgrasp.datasets, tacgrasp.lessons, tacgrasp.lessons.turns, tacgrasp.pretraining.
"""
