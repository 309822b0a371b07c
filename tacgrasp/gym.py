"""The closed loop as an environment of gymnasium: ``tacgrasp/Strawberry-v0``.

    import gymnasium
    import tacgrasp.gym  # registers it

    env = gymnasium.make("tacgrasp/Strawberry-v0")

An episode is one of ``tacgrasp.loop``: the same readings, contract, executor, limits, ends and
verification by lifting. The agent is its policy: an action is a primitive, or the declaration that
the grasp is good. Closings on nothing are reset by the loop itself, without asking the agent. An
observation is what a policy is given. The simulator's truth is in ``info`` and in the reward of the
end, and nowhere else.

Needs the extra ``gym``.
"""

from __future__ import annotations

import math
import threading
from queue import SimpleQueue
from typing import Any

import numpy as np

from cltp.tactile.cloud import TactileCloud
from cltp.tactile.measure import contact_state
from cltp.tactile.states import ContactState, Side
from policies import Decision, Observation
from policies.extraction import extract
from policies.speech import ACTION_WORDINGS, SUCCESS_WORDINGS
from primitives import Primitive
from primitives.contract import Band, Contract
from sim.grasp.rig import BENCHMARK_SEED, SimRig
from tacgrasp.base.errors import UsageError
from tacgrasp.config.layers import load
from tacgrasp.config.schema import RunConfig
from tacgrasp.config.terms import contract_of
from tacgrasp.episodes.record import TruthFacts
from tacgrasp.rig.factory import make_rig
from tacgrasp.rig.gel_sense import GelSense
from tacgrasp.run import run_unrecorded
from tacgrasp.runtime.outcome import EndOfEpisode, EndReason, Outcome
from tacgrasp.runtime.shutdown import read_truth

try:
    import gymnasium
    from gymnasium import spaces
except ImportError:
    raise UsageError("gymnasium is not installed: pip install 'tacgrasp[gym]'") from None

STRAWBERRY = "tacgrasp/Strawberry-v0"

ACTIONS: tuple[Primitive | None, ...] = (*Primitive, None)
"""The action of each number; None declares that the grasp is good."""

DECLARE = "declare the grasp good"
"""The last action in words."""

CELLS = 16
"""Rows and columns of ``heights``."""

TOUCH = (
    *("in_contact", "x_cm", "y_cm", "depth_mm", "area_fraction", "cut_top", "cut_bottom"),
    *("cut_left", "cut_right", "ln_felt_over_band", "ln_commanded_n", "width_dm", "steps"),
)
"""Entries of ``touch``. ``ln_felt_over_band``: of the felt force over the middle of the contract's
band, -5 without one; ``steps``: fraction of the task's actions that are used up."""

STEP_COST, LOST = 0.02, 1.0
"""Reward: 1 for a grasp that is verified, unbruised and held by the truth; ``-LOST`` for one that
is bruised or dropped; ``-STEP_COST`` an action. Our choice."""

TRUNCATIONS = (EndReason.MAX_STEPS, EndReason.TIMEOUT)


class StrawberryEnv(gymnasium.Env[Any, Any]):
    """One berry between two fingers; each episode draws another.

    Args:
        shaped: Whether the reward is shaped by a potential of what is felt (Ng et al. 1999), which
            leaves the best policy as it is.
        render_mode: None; nothing is drawn.

    ``reset(options={"seed": n})`` takes the world of that seed of the simulator, as ``tacgrasp run
    --seed n``; without it, one below those of the benchmark is drawn.
    """

    metadata: dict[str, Any] = {"render_modes": []}  # noqa: RUF012 - as gymnasium declares it

    def __init__(self, *, shaped: bool = True, render_mode: str | None = None) -> None:
        if render_mode is not None:
            raise UsageError(f"nothing is drawn: render_mode must be None, got {render_mode!r}")
        self.render_mode, self._shaped = render_mode, shaped
        self.action_space = spaces.Discrete(len(ACTIONS))
        self.observation_space = spaces.Dict(
            {
                "heights": spaces.Box(-5.0, 5.0, (CELLS, CELLS), np.float32),
                "touch": spaces.Box(-10.0, 10.0, (len(TOUCH),), np.float32),
            }
        )
        self._config = load("strawberry")[0]
        self._episode: _Episode | None = None
        self._last: dict[str, np.ndarray] = {}
        self._potential = 0.0

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[dict[str, np.ndarray], dict[str, Any]]:
        """Draw a berry and close the fingers until it is felt.

        Raises:
            UsageError: An unknown option, or a seed that is none.
        """
        super().reset(seed=seed)
        options = options or {}
        if unknown := options.keys() - {"seed"}:
            raise UsageError(f"reset knows the option seed alone, got {sorted(unknown)}")
        if "seed" in options and _whole(options["seed"]) is None:
            raise UsageError(
                f"the option seed is a whole number, 0 or more, got {options['seed']!r}"
            )
        while True:  # a berry that is missed twice ends before the agent is asked
            world = options.get("seed", int(self.np_random.integers(BENCHMARK_SEED)))
            self.close()
            self._episode = _Episode(self._config.model_copy(update={"seed": int(world)}))
            asked = self._episode.next()
            if not isinstance(asked, Outcome):
                break
            if "seed" in options:
                self.close()
                raise UsageError(f"the episode of seed {world} ends before anything is decided")
        self._last, self._potential = self._observed(*asked)
        return self._last, self._info(None)

    def step(self, action: int) -> tuple[dict[str, np.ndarray], float, bool, bool, dict[str, Any]]:
        """Carry one action out, within contract and limits, and feel what came of it.

        Raises:
            UsageError: No episode goes on, or no action has this number; nothing moves.
        """
        if self._episode is None:
            raise UsageError("the episode has ended; call reset first")
        number = _whole(action)
        if number is None or number >= len(ACTIONS):
            known = ", ".join(f"{i} {each or DECLARE}" for i, each in enumerate(ACTIONS))
            raise UsageError(f"an action is one of {known}; got {action!r}")
        self._episode.act(ACTIONS[number])
        asked = self._episode.next()
        reward, before = -STEP_COST, self._potential
        if isinstance(asked, Outcome):
            self._potential = 0.0
            reward += _end_reward(asked)
        else:
            self._last, self._potential = self._observed(*asked)
        if self._shaped:
            reward += self._potential - before
        if not isinstance(asked, Outcome):
            return self._last, reward, False, False, self._info(None)
        info, is_cut = self._info(asked), asked.reason in TRUNCATIONS
        self.close()
        return self._last, reward, not is_cut, is_cut, info

    def close(self) -> None:
        """End the episode that runs; idempotent."""
        if self._episode is not None:
            self._episode.end()
        self._episode = None

    def _info(self, outcome: Outcome | None) -> dict[str, Any]:
        assert self._episode is not None
        info: dict[str, Any] = {
            "truth": self._episode.truth() if outcome is None else outcome.truth,
            "world": self._episode.config.seed,
        }
        if outcome is not None:
            info |= {"end": outcome.label, "is_success": outcome.completed}
        return info

    def _observed(
        self, observation: Observation, contract: Contract
    ) -> tuple[dict[str, np.ndarray], float]:
        """An observation as arrays, and its potential."""
        assert self._episode is not None
        state = contact_state(observation.cloud, in_contact=observation.in_contact)
        force, band = observation.felt_force_n, contract.terms.force_n
        middle_n = math.sqrt(band.low * band.high)
        ln_felt = -5.0 if force is None else math.log(force.value / middle_n)
        values = (
            float(state.in_contact),
            *(state.x_mm / 10, state.y_mm / 10, state.depth_mm, state.area_fraction),
            *(float(side in state.cut) for side in (Side.TOP, Side.BOTTOM, Side.LEFT, Side.RIGHT)),
            ln_felt,
            math.log(max(observation.commanded_force_n or 0.0, 1e-3)),
            10 * (observation.width_m or 0.0),
            self._episode.num_asked / self._config.loop.max_steps,
        )
        touch = np.clip(np.array(values, np.float32), -10, 10)
        arrays = {"heights": heights_on_grid(observation.cloud), "touch": touch}
        return arrays, _potential(state, force.value if force else None, contract)


def _whole(number: object) -> int | None:
    """A whole number from 0 on, of Python or numpy, a scalar array too; None for anything else."""
    if isinstance(number, np.ndarray) and number.ndim == 0:
        number = number[()]
    if isinstance(number, bool) or not isinstance(number, int | np.integer):
        return None
    return int(number) if number >= 0 else None


def heights_on_grid(cloud: TactileCloud) -> np.ndarray:
    """Mean height [mm] of the points in each cell, shape (CELLS, CELLS), row 0 at the top.

    A cell without points is 0, as an untouched gel.
    """
    points, sensor = cloud.points_mm, cloud.sensor
    column = np.floor((points[:, 0] / sensor.width_mm + 0.5) * CELLS).clip(0, CELLS - 1)
    row = np.floor((0.5 - points[:, 1] / sensor.height_mm) * CELLS).clip(0, CELLS - 1)
    cell = (row * CELLS + column).astype(np.intp)
    sums = np.bincount(cell, weights=points[:, 2], minlength=CELLS**2)
    counts = np.bincount(cell, minlength=CELLS**2)
    means = sums / np.maximum(counts, 1)
    return np.clip(means.reshape(CELLS, CELLS), -5, 5).astype(np.float32)


def _potential(state: ContactState, force_n: float | None, contract: Contract) -> float:
    """How near a contact is to the contract, at most 0; from touch alone."""
    if not state.in_contact or force_n is None or force_n <= 0:
        return -1.0
    away_mm = math.hypot(_beyond(state.x_mm, contract.x_mm), _beyond(state.y_mm, contract.y_mm))
    band = contract.terms.force_n
    ln_band = Band(low=math.log(band.low), high=math.log(band.high))
    return -min(1.0, 0.05 * away_mm + 0.2 * _beyond(math.log(force_n), ln_band))


def _beyond(value: float, band: Band) -> float:
    return max(0.0, band.low - value, value - band.high)


def _end_reward(outcome: Outcome) -> float:
    if outcome.completed:
        return 1.0
    truth = outcome.truth or {}
    is_lost = any(truth.get(name) for name in ("bruised", "bruised_at_start", "dropped"))
    return -LOST if is_lost else 0.0


class _Episode:
    """The loop in a thread of its own, which waits in its policy for the agent's action."""

    name = "agent"

    def __init__(self, config: RunConfig) -> None:
        rig = make_rig(config)
        assert isinstance(rig, SimRig)  # the task runs on the rig sim
        self.rig, self.config, self.num_asked = rig, config, 0
        self._contract = contract_of(config)
        self._asked: SimpleQueue[tuple[Observation, Contract] | Outcome | Exception] = SimpleQueue()
        self._actions: SimpleQueue[Primitive | EndOfEpisode | None] = SimpleQueue()
        self._thread = threading.Thread(target=self._run, name="episode", daemon=True)
        self._thread.start()

    def truth(self) -> TruthFacts | None:
        """The simulator's truth now, by the names of the end's and of episode files."""
        return read_truth(self.rig, self.config.verify)

    def next(self) -> tuple[Observation, Contract] | Outcome:
        """The next question to the agent, or the end.

        Raises:
            Exception: As the loop has, each time that it is asked.
        """
        asked = self._asked.get()
        if isinstance(asked, Exception):
            self._asked.put(asked)
            raise asked
        return asked

    def act(self, action: Primitive | None) -> None:
        """Answer the question."""
        self._actions.put(action)

    def end(self) -> None:
        """End the loop, if it has not ended; the simulated robot is made safe."""
        self._actions.put(EndOfEpisode(EndReason.OPERATOR, "the environment was reset"))
        self._thread.join()
        self.rig.disconnect()

    def _run(self) -> None:
        try:
            sense = GelSense(self.rig.sensor)
            ended = run_unrecorded(self.rig, self, self.config, self._contract, sense=sense)
            self._asked.put(ended)
        except Exception as error:  # raised again in the agent's thread
            self._asked.put(error)

    def start(self) -> None: ...

    def decide(self, observation: Observation, contract: Contract) -> Decision:
        self.num_asked += 1
        self._asked.put((observation, contract))
        action = self._actions.get()
        if isinstance(action, EndOfEpisode):
            raise action
        text = SUCCESS_WORDINGS[0] if action is None else ACTION_WORDINGS[action][0]
        found = extract(text)
        return Decision(text=text, action=found.action, success=found.success, reason=found.reason)


if STRAWBERRY not in gymnasium.registry:
    gymnasium.register(STRAWBERRY, entry_point="tacgrasp.gym:StrawberryEnv")
