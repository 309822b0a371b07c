"""Read a recorded episode, and ask another policy what it would have done at each step.

    python examples/06_decide_again.py [episode.mcap]

Without a file, an episode is run first. On the command line: tacgrasp replay EPISODE --decide.
"""

import sys
from pathlib import Path

from policies.baselines import FixedForcePolicy
from policies.rules import RulesPolicy
from tacgrasp import api
from tacgrasp.episodes import read_episode
from tacgrasp.playback.replay import config_of, contract_in, differences


def recorded() -> Path:
    """An episode of the rules."""
    run = api.configure("strawberry", policy="rules", seed=6)
    with api.connect(run) as rig:
        return api.run_episode(run, rig, api.make_policy(run)).path


path = Path(sys.argv[1]) if len(sys.argv) > 1 else recorded()
episode = read_episode(path)
config = config_of(episode, path)
contract = contract_in(episode, config)
print(f"{path.name}: {episode.header.policy}, {len(episode.steps)} steps, {episode.end.reason}")
for step in episode.steps:
    action = step.decision.action if step.decision else None
    print(f"  {step.index:2d} {action or '-':15} grip {step.gripper.force_n:.2f} N")

policies = [RulesPolicy(move_step_mm=config.primitives.move_step_mm), FixedForcePolicy()]
for policy in policies:
    found = list(differences(episode, policy, contract))
    print(f"{policy.name} decides {len(found)} steps otherwise")
    for difference in found[:2]:
        print(f"  {difference.index:2d} {difference.text}")
