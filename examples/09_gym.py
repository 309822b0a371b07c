"""The loop as an environment of gymnasium: a person's rule of thumb, played on a few berries.

pip install 'tacgrasp[gym]'
python examples/09_gym.py [episodes]
"""

import sys

import gymnasium

import tacgrasp.gym
from primitives import Primitive
from tacgrasp.gym import ACTIONS, TOUCH


def rule_of_thumb(observation):
    """Centre the contact, press it into the band, then say that it is good."""
    touch = dict(zip(TOUCH, observation["touch"], strict=True))
    if not touch["in_contact"]:
        return Primitive.RESET
    if abs(touch["x_cm"]) > 0.3:
        return Primitive.MOVE_RIGHT if touch["x_cm"] > 0 else Primitive.MOVE_LEFT
    if abs(touch["y_cm"]) > 0.2:
        return Primitive.MOVE_UP if touch["y_cm"] > 0 else Primitive.MOVE_DOWN
    if touch["ln_felt_over_band"] < -0.3:
        return Primitive.INCREASE_FORCE
    if touch["ln_felt_over_band"] > 0.3:
        return Primitive.DECREASE_FORCE
    return None  # declares that the grasp is good


episodes = int(sys.argv[1]) if len(sys.argv) > 1 else 4
env = gymnasium.make(tacgrasp.gym.STRAWBERRY)
successes = 0
for episode in range(episodes):
    observation, info = env.reset(seed=episode)
    total, num_steps, is_over = 0.0, 0, False
    while not is_over:
        action = ACTIONS.index(rule_of_thumb(observation))
        observation, reward, terminated, truncated, info = env.step(action)
        total, num_steps, is_over = total + reward, num_steps + 1, terminated or truncated
    successes += info["is_success"]
    peak_n = info["truth"]["peak_force_n"]
    print(
        f"berry {info['world']}: {info['end']} in {num_steps} steps, {total:+.2f}, {peak_n:.2f} N"
    )
env.close()
print(f"{successes} of {episodes} held")
