"""Train a small policy in tacgrasp/Strawberry-v0 with stable-baselines3, and measure it.

    pip install 'tacgrasp[gym]' stable-baselines3
    python examples/10_train_in_gym.py --steps 20000 --episodes 200 --json gym.json

The agent sees the 13 numbers of ``tacgrasp.gym.TOUCH``. It is measured on the benchmark's seeds,
which it never trained on: compare with `tacgrasp bench strawberry --policies fixed_force`.
"""

import argparse
import json
from pathlib import Path
from statistics import mean

import gymnasium
import torch
from gymnasium.wrappers import FilterObservation, FlattenObservation
from stable_baselines3 import PPO
from stable_baselines3.common.callbacks import BaseCallback

import tacgrasp.gym
from sim.grasp.rig import BENCHMARK_SEED


def make_env():
    """The environment with the numbers of touch alone, as one vector."""
    env = gymnasium.make(tacgrasp.gym.STRAWBERRY)
    return FlattenObservation(FilterObservation(env, ["touch"]))


class Curve(BaseCallback):
    """Fraction of successes among the episodes of every thousand steps."""

    def __init__(self):
        super().__init__()
        self.points, self._ends = [], []

    def _on_step(self):
        self._ends += [info["is_success"] for info in self.locals["infos"] if "end" in info]
        if self.num_timesteps % 1000 == 0 and self._ends:
            self.points.append([self.num_timesteps, round(mean(self._ends), 3)])
            print(f"{self.num_timesteps} steps: {self.points[-1][1]:.0%}", flush=True)
            self._ends = []
        return True


def measure(model, episodes):
    """Ends of the benchmark's first episodes, by name."""
    env, ends = make_env(), {}
    for seed in range(BENCHMARK_SEED, BENCHMARK_SEED + episodes):
        observation, info = env.reset(options={"seed": seed})
        while "end" not in info:
            action, _ = model.predict(observation, deterministic=True)
            observation, _, _, _, info = env.step(int(action))
        ends[str(info["end"])] = ends.get(str(info["end"]), 0) + 1
    env.close()
    return ends


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--steps", type=int, default=20000)
    parser.add_argument("--episodes", type=int, default=200)
    parser.add_argument("--json", type=Path)
    flags = parser.parse_args()
    torch.set_num_threads(1)
    settings = {"n_steps": 256, "batch_size": 64, "gamma": 0.9, "learning_rate": 1e-3}
    model = PPO("MlpPolicy", make_env(), ent_coef=0.01, seed=0, device="cpu", **settings)
    curve = Curve()
    model.learn(flags.steps, callback=curve)
    ends = measure(model, flags.episodes)
    success = ends.get("success", 0) / flags.episodes
    print(f"verified and unbruised: {success:.1%} of {flags.episodes} unseen berries; ends: {ends}")
    if flags.json:
        figures = {"steps": flags.steps, "episodes": flags.episodes, "success": success}
        flags.json.write_text(json.dumps({**figures, "ends": ends, "curve": curve.points}))
