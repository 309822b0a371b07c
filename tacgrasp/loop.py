"""Algorithm 1 of the paper (appendix B), corrected: read, decide, act, until the grasp is good.

As printed it has four holes; the loop closes them as follows:

1. 'Stable' is part of 'unstable': ``policies.extraction`` reads whole words, and negation.
2. It executes before it tests success. A text that declares success and names no action ends the
   loop and moves nothing; one with both acts, and has to declare again in the next step.
3. No action, or two: nothing moves, the gel is read and the policy asked again, ``max_asks`` times
   in a row, then ``no_action``.
4. It never ends: actions, time, travel and force are bounded. Every end has a name and leaves the
   gripper as the task says.

Every decision is held to the episode's contract (``policies.contract``): one that goes against what
is clearly felt counts as no action, and a soft contact may object to a contract for hard things.

Contact is decided by test before any policy (``tacgrasp.rig.gel_sense``). Fingers that have closed
on nothing are followed by the runtime's own ``reset``, without asking the policy; the second one
with no contact in between ends the episode with ``contact_lost``.

A declared success is then checked by lifting (``tacgrasp.runtime.verify``); only that makes a
``success``. While it is lifted, and while a policy decides, the reflex keeps the contract
(``tacgrasp.runtime.reflex_loop``).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import count

from cltp import TouchError
from policies import Decision, Policy, PolicyError
from primitives import LimitError, Primitive, RobotError
from primitives.contract import Contract
from primitives.execution import AT_LIMIT, Executed, Executor
from tacgrasp.config.schema import RunConfig
from tacgrasp.episodes import EpisodeError
from tacgrasp.rig.gel_sense import GelSense
from tacgrasp.rig.protocols import Rig
from tacgrasp.runtime.outcome import EndOfEpisode, EndReason, Observer, Outcome, Verification
from tacgrasp.runtime.reflex_loop import make_reflex
from tacgrasp.runtime.shutdown import Ending, close
from tacgrasp.runtime.steps import (
    NO_CONTACT_DECISION,
    Recorder,
    Step,
    Steps,
    decide,
    read_observation,
)


def run_episode(
    rig: Rig,
    executor: Executor,
    policy: Policy,
    config: RunConfig,
    contract: Contract,
    *,
    verify: Callable[[Rig, Steps, RunConfig, Contract], Verification],
    recorder: Recorder,
    observers: Sequence[Observer] = (),
    sense: GelSense | None = None,
) -> Outcome:
    """Close the loop until one of the named ends; the robot is then in the task's state.

    Raises:
        LimitError: The contract is refused; nothing has moved.
        TouchError: The slip calibration can't be used; nothing has moved.
        Exception: A bug in a called function; the robot has been made safe and the episode ended.
    """
    _ = contract.terms  # a refused one ends here
    reflex = make_reflex(rig, executor, config)
    steps = Steps(rig, config.loop, recorder, observers, sense, reflex)
    end = EndOfEpisode(EndReason.FAULT, "stopped by an unforeseen error; this is a bug")
    step: Step | None = None
    verification: Verification | None = None
    if sense is not None:
        sense.retry_or_raise = steps.retry_or_raise
    try:
        policy.start()
        executor.grasp()
        while True:
            steps.check_time()
            for attempt in count(1):  # repeated after an error, loop.max_faults times in a row
                try:
                    observation = read_observation(rig, sense)
                    if observation.in_contact is False:
                        decision = NO_CONTACT_DECISION
                    else:
                        contract = steps.soften_if_soft(executor, observation, contract)
                        seen = observation.for_policy(steps.elapsed_s)
                        target = steps.with_target(executor, seen, contract)
                        with steps.deciding(contract, observation):
                            decision = decide(policy, seen, target)
                    break
                except (TouchError, PolicyError) as error:
                    steps.retry_or_raise(error, attempt)
            step = Step(observation=observation, decision=decision)
            if step.declared:
                steps.record(step)
                verification = verify(rig, steps, config, contract)
                reason = EndReason.SUCCESS if verification.passed else EndReason.UNVERIFIED
                raise EndOfEpisode(reason, verification.message)
            if decision.action is None:
                steps.record(step, note=f"nothing moved: {decision.reason}")
                steps.ask_again(decision)
                continue
            _check_bounds(step, decision.action, steps, config)
            executed = executor.execute(decision.action)
            steps.record(step, executed)
            _check_sent(executed, decision, steps)
    except EndOfEpisode as reached:
        end = reached
    except LimitError as error:
        end = EndOfEpisode(EndReason.LIMIT, str(error))
    except (RobotError, TouchError, PolicyError, EpisodeError) as error:
        end = EndOfEpisode(EndReason.FAULT, str(error))
    except KeyboardInterrupt as stop:
        end = EndOfEpisode(EndReason.OPERATOR, str(stop) or "stopped by the operator")
    finally:
        ending = Ending(
            rig=rig,
            config=config,
            recorder=recorder,
            steps=steps,
            end=end,
            last_step=step,
            verification=verification,
            open_width_m=executor.open_width_m,
        )
        outcome = close(ending)
    return outcome


def _check_bounds(step: Step, action: Primitive, steps: Steps, config: RunConfig) -> None:
    """End the episode in place of a second empty closing or an action beyond ``max_steps``."""
    if step.decision is NO_CONTACT_DECISION and steps.num_empty:
        steps.record(step, note="second closing on nothing: not executed")
        raise EndOfEpisode(EndReason.CONTACT_LOST, "the fingers closed on nothing twice in a row")
    if steps.num_actions >= config.loop.max_steps:
        steps.record(step, note="max_steps: not executed")
        message = f"{steps.num_actions} actions without a good grasp (loop.max_steps)"
        raise EndOfEpisode(EndReason.MAX_STEPS, message)


def _check_sent(executed: Executed, decision: Decision, steps: Steps) -> None:
    """Bound what sends nothing: the next observation would be the same, for ever."""
    if executed.dry_run:
        raise EndOfEpisode(EndReason.DRY_RUN, "one decision was made, nothing was sent")
    if executed.sent_nothing and AT_LIMIT in executed.clamped:
        raise EndOfEpisode(EndReason.LIMIT, "; ".join(executed.clamped))
    if executed.sent_nothing:  # the goal leaves no room for the change
        steps.ask_again(decision)
