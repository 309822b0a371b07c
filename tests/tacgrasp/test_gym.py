"""The loop as an environment of gymnasium."""

import math

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env
from gymnasium.vector import AsyncVectorEnv, SyncVectorEnv

import tacgrasp.gym
from cltp.tactile.cloud import cloud_from_heights
from cltp.tactile.sensors import sensor_named
from primitives import Primitive
from sim.grasp.rig import BENCHMARK_SEED
from tacgrasp.base.errors import UsageError
from tacgrasp.gym import ACTIONS, CELLS, STRAWBERRY, TOUCH, heights_on_grid

DECLARE = ACTIONS.index(None)


@pytest.fixture
def env():
    env = gymnasium.make(STRAWBERRY)
    yield env
    env.close()


def centred(observation):
    """The action of a careful person: centre it, press it into the band, say so."""
    touch = dict(zip(TOUCH, observation["touch"], strict=True))
    if not touch["in_contact"]:
        return ACTIONS.index(Primitive.RESET)
    if abs(touch["x_cm"]) > 0.3:
        right = touch["x_cm"] > 0
        return ACTIONS.index(Primitive.MOVE_RIGHT if right else Primitive.MOVE_LEFT)
    if abs(touch["y_cm"]) > 0.2:
        top = touch["y_cm"] > 0
        return ACTIONS.index(Primitive.MOVE_UP if top else Primitive.MOVE_DOWN)
    if touch["ln_felt_over_band"] < -0.3:
        return ACTIONS.index(Primitive.INCREASE_FORCE)
    return DECLARE


def played(env, policy=centred, **reset):
    """Rewards, observations and last info of an episode."""
    observation, info = env.reset(**reset)
    rewards, observations = [], [observation]
    is_over = False
    while not is_over:
        observation, reward, terminated, truncated, info = env.step(policy(observation))
        rewards.append(reward)
        observations.append(observation)
        is_over = terminated or truncated
    return rewards, observations, info


def test_it_keeps_the_rules_of_gymnasium():
    env = gymnasium.make(STRAWBERRY)
    check_env(env.unwrapped)
    env.close()


def test_a_careful_agent_ends_with_success_and_its_reward(env):
    rewards, _, info = played(env, options={"seed": 6})
    assert info["is_success"], info
    assert info["end"] == "success"
    assert rewards[-1] > 0.9
    assert info["world"] == 6


def test_the_same_seed_gives_the_same_episode_to_the_bit(env):
    first, second = (played(env, seed=3) for _ in range(2))
    assert first[0] == second[0]
    for one, other in zip(first[1], second[1], strict=True):
        assert all(np.array_equal(one[name], other[name]) for name in one)
    assert first[2]["world"] == second[2]["world"] < BENCHMARK_SEED
    assert played(env, seed=4)[2]["world"] != first[2]["world"]


def test_the_shaping_changes_the_sum_of_an_episode_by_its_first_potential_alone():
    sums = []
    for shaped in (False, True):
        env = gymnasium.make(STRAWBERRY, shaped=shaped)
        rewards, _, _ = played(env, options={"seed": 6})
        potential = env.unwrapped._potential
        sums.append(sum(rewards))
        env.reset(options={"seed": 6})
        first = env.unwrapped._potential
        env.close()
        assert potential == 0
    assert sums[1] == pytest.approx(sums[0] - first)
    assert first < 0


def test_truth_is_in_info_alone(env):
    observation, info = env.reset(options={"seed": 6})
    assert info["truth"]["gripper_factor"] > 0
    assert set(observation) == {"heights", "touch"}
    env.unwrapped._episode.rig.grasp.peak_kpa = 12345.0  # a truth that nothing felt depends on
    assert not any((array == 12345.0).any() for array in observation.values())


def test_to_declare_at_once_is_refused_by_the_contract_and_ends_without_an_action(env):
    _, _, info = played(env, lambda _: DECLARE, options={"seed": 6})
    assert info["end"] == "no_action"
    assert not info["is_success"]


def test_to_open_and_close_for_ever_is_truncated(env):
    env.reset(options={"seed": 6})
    reset = ACTIONS.index(Primitive.RESET)
    ends = [env.step(reset)[2:4] for _ in range(26)]
    assert ends[-1] == (False, True)
    assert set(ends[:-1]) == {(False, False)}


def test_an_episode_that_is_left_is_ended_and_its_rig_freed(env):
    env.reset(seed=1)
    episode = env.unwrapped._episode
    env.reset()
    assert not episode._thread.is_alive()
    with pytest.raises(Exception, match="disconnected"):
        episode.rig.arm.pose()


def test_a_step_before_reset_and_an_unknown_option_are_refused():
    env = tacgrasp.gym.StrawberryEnv()
    with pytest.raises(UsageError, match="call reset first"):
        env.step(0)
    with pytest.raises(UsageError, match="option seed alone"):
        env.reset(options={"berry": 1})


@pytest.mark.parametrize("action", [-1, 8, 1.5, True, "1", None, np.array([1])])
def test_what_is_no_action_is_refused_with_those_that_are_and_nothing_moves(action):
    env = tacgrasp.gym.StrawberryEnv()
    env.reset(options={"seed": 6})
    with pytest.raises(UsageError, match=r"one of 0 move_up, .*, 7 declare the grasp good; got"):
        env.step(action)
    assert env.step(np.int64(ACTIONS.index(Primitive.INCREASE_FORCE)))[2:4] == (False, False)
    env.close()


@pytest.mark.parametrize("seed", [1.5, -1, True, "1", None])
def test_a_seed_that_is_none_is_refused(seed):
    with pytest.raises(UsageError, match="option seed is a whole number"):
        tacgrasp.gym.StrawberryEnv().reset(options={"seed": seed})


def test_the_truth_has_the_same_names_at_the_end_as_before(env):
    _, first = env.reset(options={"seed": 6})
    _, _, last = played(env, options={"seed": 6})
    assert first["truth"].keys() == last["truth"].keys()
    assert {"gripper_factor", "offset_x_mm", "offset_y_mm"} <= first["truth"].keys()


def test_the_last_reward_pays_the_potential_back_whatever_the_end(env):
    env.reset(options={"seed": 6})
    rewards = []
    for _ in range(3):
        before = env.unwrapped._potential
        _, reward, is_over, _, info = env.step(DECLARE)
        rewards.append(reward)
    assert is_over
    assert info["end"] == "no_action"
    assert rewards[-1] == pytest.approx(-tacgrasp.gym.STEP_COST - before)


def test_heights_are_means_of_cells_whatever_the_number_of_points():
    sensor = sensor_named("gelsight_mini")
    ramp = np.linspace(0, 1, 240)[:, None] * np.ones((1, 320))
    for num in (1024, 4096, 76800):
        grid = heights_on_grid(cloud_from_heights(ramp, sensor, num_points=num))
        expected = (np.arange(CELLS) + 0.5) / CELLS
        assert grid == pytest.approx(np.tile(expected[:, None], CELLS), abs=0.02)


def test_an_error_of_the_loop_comes_to_the_agent(env, monkeypatch):
    env.reset(seed=1)

    def break_down():
        raise ZeroDivisionError

    monkeypatch.setattr(type(env.unwrapped._episode.rig.sensor), "read", lambda *_: break_down())
    for _ in range(2):  # again, and it does not wait for what never comes
        with pytest.raises(ZeroDivisionError):
            env.step(ACTIONS.index(Primitive.RESET))


def test_berries_side_by_side_are_each_their_own():
    vector = SyncVectorEnv([lambda: gymnasium.make(STRAWBERRY) for _ in range(3)])
    first, infos = vector.reset(seed=0)
    assert first["touch"].shape == (3, len(TOUCH))
    assert len(set(infos["world"])) == 3
    _, rewards, *_ = vector.step(np.full(3, ACTIONS.index(Primitive.INCREASE_FORCE)))
    assert all(math.isfinite(reward) for reward in rewards)
    vector.close()


@pytest.mark.slow
def test_berries_in_processes_of_their_own_are_those_of_one_process():
    makers = [lambda: gymnasium.make(tacgrasp.gym.STRAWBERRY) for _ in range(2)]
    one, many = SyncVectorEnv(makers), AsyncVectorEnv(makers, context="spawn")
    try:
        for vector in (one, many):
            vector.reset(seed=0)
        action = np.full(2, ACTIONS.index(Primitive.MOVE_DOWN))
        here, there = one.step(action)[0], many.step(action)[0]
        assert all(np.array_equal(here[name], there[name]) for name in here)
    finally:
        one.close()
        many.close()


def test_an_episode_that_ends_before_anything_is_decided_leaves_none(monkeypatch):
    monkeypatch.setattr("tacgrasp.gym.Outcome", object)  # whatever comes first is an end
    env = tacgrasp.gym.StrawberryEnv()
    with pytest.raises(UsageError, match="ends before anything is decided"):
        env.reset(options={"seed": 6})
    with pytest.raises(UsageError, match="call reset first"):
        env.step(0)
