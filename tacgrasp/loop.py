"""Algorithm 1 of the paper (appendix B), mended: feel, decide, act, until the grasp is good.

As printed it has four holes; what is done here instead:

1. 'Stable' stands in 'unstable': ``policies.extraction.extract`` reads whole words, and negation.
2. It executes before it tests success. A text that declares success and names no action ends the
   loop and moves nothing; one with both acts, and has to declare again on the next touch.
3. No action, or two: nothing moves, the gel is read and the policy asked again, ``max_asks`` times
   in a row, then ``no_action``.
4. It never ends: actions, time, travel and force are bounded; the second ``reset`` ends it with
   ``contact_lost``. Every end has a name and leaves the gripper as the task says.

A declared success is then checked by lifting (``tacgrasp.runtime.verify``); only that makes a
``success``.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from cltp import TouchError
from policies import Decision, Policy, PolicyError
from primitives import LimitError, Primitive, RobotError
from primitives.execution import Executed, Executor
from tacgrasp.config.schema import RunConfig
from tacgrasp.episodes import EpisodeError
from tacgrasp.rig.protocols import Rig
from tacgrasp.runtime.outcome import EndOfEpisode, EndReason, Observer, Outcome, Verification
from tacgrasp.runtime.shutdown import close
from tacgrasp.runtime.tick import Recorder, Turns


def run_episode(
    rig: Rig,
    executor: Executor,
    policy: Policy,
    config: RunConfig,
    *,
    verify: Callable[[Rig, Turns, RunConfig], Verification],
    recorder: Recorder,
    observers: Sequence[Observer] = (),
) -> Outcome:
    """Close the loop until one of the named ends; the robot is then in the task's state.

    Raises:
        Exception: A bug in what it calls; the robot has been made safe and the episode ended.
    """
    turns = Turns(rig, config.loop, recorder, observers)
    end = EndOfEpisode(EndReason.FAULT, "stopped by an error that nobody foresaw; this is a bug")
    declared, verified, steps, resets = False, None, 0, 0
    try:
        policy.start()
        executor.grasp()
        while True:
            turns.check_time()
            decision = turns.feel_and_ask(policy, config.instruction)
            declared = decision.success and decision.action is None
            if declared:
                turns.record(executed=None)
                verification = verify(rig, turns, config)
                verified = verification.passed
                end = _verified_end(verification)
                break
            if decision.action is None:
                turns.record(executed=None, note=f"nothing moved: {decision.reason}")
                turns.count_blank(decision)
                continue
            resets += decision.action is Primitive.RESET
            _check_bounds(decision, turns, steps, resets, config)
            executed = executor.execute(decision.action)
            steps += not executed.dry_run
            turns.record(executed)
            _check_sent(executed)
    except EndOfEpisode as reached:
        end = reached
    except LimitError as error:
        end = EndOfEpisode(EndReason.LIMIT, str(error))
    except (RobotError, TouchError, PolicyError, EpisodeError) as error:
        end = EndOfEpisode(EndReason.FAULT, str(error))
    except KeyboardInterrupt:
        end = EndOfEpisode(EndReason.OPERATOR, "stopped by the operator")
    finally:
        outcome = close(rig, config, recorder, turns, end, declared, verified, steps)
    return outcome


def _verified_end(verification: Verification) -> EndOfEpisode:
    reason = EndReason.SUCCESS if verification.passed else EndReason.UNVERIFIED
    return EndOfEpisode(reason, verification.message)


def _check_bounds(
    decision: Decision, turns: Turns, steps: int, resets: int, config: RunConfig
) -> None:
    """Ends that forbid the action that was just decided; the turn is recorded as not executed."""
    if resets > 1:
        turns.record(executed=None, note="second reset: not executed")
        raise EndOfEpisode(EndReason.CONTACT_LOST, "a second reset was asked for")
    if steps >= config.loop.max_steps:
        turns.record(executed=None, note="max_steps: not executed")
        raise EndOfEpisode(
            EndReason.MAX_STEPS,
            f"{steps} actions without a good grasp (loop.max_steps)",
        )


def _check_sent(executed: Executed) -> None:
    """Where nothing was sent, the next touch would be the same, for ever."""
    if executed.dry_run:
        raise EndOfEpisode(EndReason.MAX_STEPS, "dry run: one decision, nothing was sent")
    if executed.sent == "nothing":  # the force is at its limit already
        raise EndOfEpisode(EndReason.LIMIT, "; ".join(executed.clamped))
