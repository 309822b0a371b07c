"""A task of one's own: a YAML file, no code. See what it asks for, then run it.

python examples/02_own_task.py
"""

from pathlib import Path

from tacgrasp import api
from tacgrasp.config.terms import band_lines, contract_lines

TASK = """\
# A ripe tomato for the salad, held a little to the left of the pad's middle.
instruction: Hold the tomato very gently; it splits easily.
object: cherry_tomato          # a key of sim.grasp.bodies.OBJECTS, or a plugin's
goal:
  force_n: [0.5, 0.9]          # felt force of a good grasp [N]
  limit_n: 1.1                 # never above [N]
  x_mm: [-6.0, 2.0]            # place of the contact on the pad [mm]
verify:
  lift_mm: 60                  # a declared success is lifted and shaken
on_success: hold
on_failure: release
"""

path = Path("own_task.yaml")
if path.exists() and path.read_text(encoding="utf-8") != TASK:
    raise SystemExit(f"{path} exists and is kept; run this example in another folder")
path.write_text(TASK, encoding="utf-8")

run = api.configure(str(path), policy="rules", seed=3)
for line in [*contract_lines(run.contract), *band_lines(run.contract)]:
    print(line)
with api.connect(run) as rig:
    episode = api.run_episode(run, rig, api.make_policy(run))
print(f"end: {episode.outcome.label} - {episode.outcome.message}")
print(f"on the command line: tacgrasp run --task {path} --policy rules --seed 3")
