"""Run one episode from Python, watch its steps, and read how it ended.

python examples/01_run_an_episode.py [seed]
"""

import sys

from tacgrasp import api


def watch(step):
    """Called with the record of every step, as soon as it is on disk."""
    said = step.decision.text if step.decision else step.phase.name.lower()
    sent = step.executed.sent if step.executed else "nothing sent"
    print(f"{step.index:2d}  {said}  ->  {sent}")


seed = int(sys.argv[1]) if len(sys.argv) > 1 else 6
run = api.configure("strawberry", policy="rules", seed=seed, arm={"max_travel_mm": 100.0})
print(f"contract: {run.contract.summary}, never above {run.contract.limit_n:.2f} N")
policy = api.make_policy(run)
with api.connect(run) as rig:
    episode = api.run_episode(run, rig, policy, observers=[watch])
outcome = episode.outcome
print(f"end: {outcome.label} - {outcome.message}")
print(f"truth, which no policy sees: peak {outcome.truth['peak_force_n']:.2f} N")
print(f"recorded in {episode.path}")
