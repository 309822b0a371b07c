"""Build a policy by name. A new policy gets a function and a line in the table ``POLICIES``."""

from __future__ import annotations

import logging
import os
import traceback
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import policies
from cltp import TouchError
from policies import Decision, Observation, Policy, PolicyError, checked
from primitives import LimitError, RobotError
from primitives.contract import Contract
from tacgrasp.base.errors import UsageError
from tacgrasp.base.plugins import load_plugin, names_with, plugins
from tacgrasp.config.schema import RunConfig
from tacgrasp.runtime.outcome import EndOfEpisode

log = logging.getLogger(__name__)

if TYPE_CHECKING:
    from policies.llm.policy import LlmPolicy

WEIGHTS_VARIABLE = "TACGRASP_WEIGHTS"
SHIPPED = "shipped"
"""Word for the shipped weights where a folder of weights is expected."""

LLM_THREADS = 1
"""Threads of torch for our own language model. Its matrices are too small to gain from another
one, and with a fixed number a decision can be repeated to the bit."""


def default_weights() -> Path:
    """Folder of weights without a flag: ``TACGRASP_WEIGHTS``, else the shipped weights."""
    folder = os.environ.get(WEIGHTS_VARIABLE)
    return Path(folder) if folder else shipped_weights()


def shipped_weights() -> Path:
    """Folder of the shipped weights, in the ``policies`` package."""
    return Path(policies.__file__).parent / "weights"


def named_weights(folder: Path | None) -> Path | None:
    """A folder of weights as it is given; the word ``shipped`` names the shipped weights."""
    return shipped_weights() if folder == Path(SHIPPED) else folder


def stock_threads() -> int:
    """Threads of torch for a language model that others made, whose matrices are large."""
    return os.cpu_count() or 1


def load_llm(weights: Path | None = None) -> LlmPolicy:
    """Load the language model of a folder, and set the number of torch's threads in this process.

    Args:
        weights: Folder; None takes ``default_weights``.

    Raises:
        TouchError: Weights are missing, damaged, or of different models.
    """
    import torch

    from cltp.checkpoints.base_lm import is_stock
    from policies.llm.policy import LlmPolicy

    folder, threads = weights or default_weights(), LLM_THREADS
    if is_stock(folder / "lm"):
        from transformers.utils.logging import disable_progress_bar

        disable_progress_bar()
        threads = stock_threads()
    torch.set_num_threads(threads)
    return LlmPolicy(folder)


def _llm(config: RunConfig) -> Policy:
    policy = load_llm(config.weights_folder)
    try:
        policy.check_move_step(config.primitives.move_step_mm)
    except PolicyError as error:
        raise UsageError(str(error)) from None
    return policy


def _rules(config: RunConfig) -> Policy:
    from policies.rules import RulesPolicy

    return RulesPolicy(move_step_mm=config.primitives.move_step_mm)


def _fixed_force(config: RunConfig) -> Policy:
    from policies.baselines import FixedForcePolicy

    return FixedForcePolicy()


def _random(config: RunConfig) -> Policy:
    from policies.baselines import RandomPolicy

    return RandomPolicy(config.seed)


def _remote(config: RunConfig) -> Policy:
    from tacgrasp.serving.keys import read_key
    from tacgrasp.serving.remote import RemotePolicy

    if config.policy_url is None:
        raise UsageError("--policy remote needs --policy-url, such as ws://127.0.0.1:8000")
    path, key = config.policy_key_file, None
    if path is not None:
        key = read_key(path, flag="--policy-key-file")
    policy = RemotePolicy(config.policy_url, timeout_s=config.policy_timeout_s, key=key)
    policy.connect()  # a server that is not there is named before anything moves
    return policy


POLICIES: dict[str, Callable[[RunConfig], Policy]] = {
    "rules": _rules,
    "llm": _llm,
    "fixed_force": _fixed_force,
    "random": _random,
    "remote": _remote,
}

_OTHER_COMMANDS = {
    "oracle": "it sees the simulator's truth: only `tacgrasp bench strawberry` has it",
    "recorded": "it repeats an episode: use `tacgrasp replay EPISODE`",
}


def check_policy(name: str, config: RunConfig) -> None:
    """Check the name of a policy and the folder of its weights, before anything heavy is loaded.

    Raises:
        UsageError: It is unknown, or a run can't use it; or it has no weights.
    """
    if name not in POLICIES and name not in plugins("policies"):
        hint = f"; {_OTHER_COMMANDS[name]}" if name in _OTHER_COMMANDS else ""
        known = ", ".join(names_with("policies", POLICIES))
        raise UsageError(f"unknown policy {name!r}; known: {known}{hint}")
    weights = config.weights_folder or default_weights()
    if name == "llm" and not weights.is_dir():
        raise UsageError(
            f"weights are missing: {weights} is not a folder; train them with `tacgrasp train "
            "all`, name another folder with --weights, or decide with --policy rules"
        )


def check_run_policy(config: RunConfig) -> None:
    """Check the policy of a run and the folder that it is given, before anything heavy is loaded.

    Raises:
        UsageError: As for ``check_policy``; or the policy can't grasp in a run; or the folder does
            not exist, or a server is named, which a policy without them would not notice.
    """
    name, weights = config.policy, config.weights_folder
    if name == "fixed_force":  # a run's closing stops at the first touch
        raise UsageError(
            "--policy fixed_force never changes the force, so in a run the grip stays as light as "
            "the first touch; compare with it by `tacgrasp bench strawberry --policies fixed_force`"
        )
    check_policy(name, config)
    check_remote_options(name, url=config.policy_url, key_file=config.policy_key_file)
    if weights is not None and not weights.is_dir():
        raise UsageError(
            f"--weights {weights} is not a folder; leave it out, since --policy {name} needs none"
        )


def check_remote_options(name: str, *, url: str | None, key_file: Path | None) -> None:
    """Check that a server is named only for a policy that may ask one: ``remote``, or a plugin's.

    Args:
        name: Name of the policy.
        url: Address of the server, if one was given.
        key_file: File with its key, if one was given.

    Raises:
        UsageError: The policy asks no server.
    """
    if name == "remote" or name not in POLICIES:
        return
    for flag, value in (("--policy-url", url), ("--policy-key-file", key_file)):
        if value is not None:
            raise UsageError(
                f"{flag} {value} is for --policy remote; leave it out, since --policy {name} asks "
                "no server"
            )


def make_policy(name: str, config: RunConfig) -> Policy:
    """Build the policy called ``name``.

    Raises:
        UsageError: It is unknown, a run can't use it, or its plugin is broken.
        TouchError: The language model's weights can't be used.
        PolicyError: A remote policy's server does not answer.
    """
    check_policy(name, config)
    return POLICIES[name](config) if name in POLICIES else _of_plugin(name, config)


def policy_refusal(added: object) -> str:
    """Why a plugin's object makes no policy; empty for a function."""
    return "" if callable(added) else f"expected a function of a RunConfig, got {added!r:.80}"


def _of_plugin(name: str, config: RunConfig) -> Policy:
    make: Any = load_plugin("policies", name, policy_refusal)
    title = plugins("policies")[name].title
    try:
        policy: Policy = make(config)
    except (UsageError, TouchError, PolicyError):
        raise
    except (Exception, SystemExit) as error:  # of foreign code: nothing has moved yet
        raise UsageError(
            f"the plugin {title} made no policy: {type(error).__name__}: {error}"
        ) from error
    missing = [part for part in ("name", "decide", "start") if not hasattr(policy, part)]
    if missing:
        raise UsageError(f"the plugin {title} made a policy without {', '.join(missing)}")
    return PluginPolicy(policy, title)


class PluginPolicy:
    """A plugin's policy, whose own faults are named as the plugin's: a ``PolicyError`` each.

    Args:
        policy: The policy.
        title: The plugin in a message.
    """

    def __init__(self, policy: Policy, title: str) -> None:
        self._policy, self._title = policy, title
        if callable(twin := getattr(policy, "twin", None)):
            self.twin = lambda: PluginPolicy(twin(), title)

    @property
    def name(self) -> str:
        return self._policy.name

    def start(self) -> None:
        """Begin an episode.

        Raises:
            PolicyError: The plugin raised something else.
        """
        with self._named("start"):
            self._policy.start()

    def decide(self, observation: Observation, contract: Contract) -> Decision:
        """Decide, as ``policies.Policy``.

        Raises:
            PolicyError: Also where the plugin raised something else, or gave no sound Decision.
        """
        with self._named("decide"):
            reply = self._policy.decide(observation, contract)
        try:
            return checked(reply)
        except PolicyError as error:
            raise PolicyError(f"the plugin {self._title}: {error}") from None

    @contextmanager
    def _named(self, function: str) -> Iterator[None]:
        try:
            yield
        except (PolicyError, TouchError, LimitError, RobotError, EndOfEpisode):
            raise
        except (Exception, SystemExit) as error:  # of foreign code, which is no bug of ours
            log.debug("%s of the plugin %s raised", function, self._title, exc_info=True)
            reason = " ".join(f"{type(error).__name__}: {error}".split())
            raise PolicyError(
                f"the plugin {self._title} is broken: its {function} raised {reason}"
                f"{_place_of(error)}"
            ) from error


def _place_of(error: BaseException) -> str:
    """File and line of foreign code that raised."""
    last = traceback.extract_tb(error.__traceback__)[-1]
    return f" ({Path(last.filename).name}, line {last.lineno})"


def policy_maker(config: RunConfig) -> Callable[[], Policy]:
    """Make the run's policy once, and return what makes more of it, each for a robot of its own.

    Raises:
        UsageError, TouchError, PolicyError: As for ``make_policy``.
    """
    first = make_policy(config.policy, config)
    twin: Callable[[], Policy] | None = getattr(first, "twin", None)  # large models are shared
    return twin or (lambda: make_policy(config.policy, config))
