"""``tacgrasp ask FILE ["question"]``: the language model answers questions about a contact."""

from __future__ import annotations

import io
import json
import sys
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

import tyro

from primitives.contract import Contract
from tacgrasp.base.errors import UsageError
from tacgrasp.cli.contact_flags import ContactFlags
from tacgrasp.cli.flags import parse

if TYPE_CHECKING:
    from tacgrasp.playback.conversation import Conversation, Spoken


@dataclass(frozen=True)
class LlmFolder:
    """The language model, as tacgrasp run names it.

    Attributes:
        dir: Folder of weights that tacgrasp train llm wrote; the same as --weights.
    """

    dir: Path | None = None


@dataclass(frozen=True)
class AskFlags(ContactFlags):
    """Answer questions about a cloud (.ply .pcd .xyz .npy .npz) or height map (.npy .npz).

    In mm, positive into the gel, with the untouched gel at 0. Of an episode (.mcap) they are about
    the contact of one step, under that step's contract.

    Without a question, a dialogue: follow-ups such as "Why?" are put with the exchange before, an
    empty line or ctrl-D ends it. Without a terminal, each line of the input is answered by a line,
    a blank one by a blank one (with --json by null); where one can't be answered, the line says why
    (with --json as "error"), and the exit code is 2.

    Attributes:
        question: Question in plain English, for example "How deep is it pressed?".
        goal: Least and most force of a good grasp [N], for questions such as "Safe to lift?".
        limit: Force that is never exceeded [N]; by default 1.25 times the most of --goal.
        task: Task whose contract is told to the model, instead of --goal.
        instruction: Instruction whose contract is told to the model, instead of --goal.
        mass: Mass of the object [g], for questions such as "Will it slip?".
        weights: Folder of weights; by default TACGRASP_WEIGHTS, else the shipped weights.
        llm: The same by another name: --llm.dir.
        json: Print a JSON object for each answer: answer, kind, value, unit, confidence, decidable.
    """

    question: tyro.conf.Positional[str | None] = None
    goal: tuple[float, float] | None = None
    limit: float | None = None
    task: str | None = None
    instruction: str | None = None
    mass: float | None = None
    weights: Path | None = None
    llm: LlmFolder = field(default_factory=LlmFolder)
    json: bool = False

    def __post_init__(self) -> None:
        if None not in (self.weights, self.llm.dir):
            raise UsageError("--weights and --llm.dir name the same folder; give one")
        if self.goal is not None and (self.task or self.instruction) is not None:
            raise UsageError("--goal and --task or --instruction both name a contract; give one")
        if self.limit is not None and self.goal is None:
            raise UsageError("--limit belongs to --goal LOW HIGH")


def main(argv: Sequence[str]) -> int:
    """Answer one question, or those of a dialogue."""
    flags = parse(AskFlags, argv, prog="tacgrasp ask")
    named = _band(flags)
    from cltp.sensing.touch_files import path_in_errors
    from tacgrasp.console import make_console, working
    from tacgrasp.playback.conversation import Conversation
    from tacgrasp.policy_factory import load_llm

    contact = flags.read()
    contract = named or contact.contract
    if (flags.task or flags.instruction) is not None:
        contract = flags.contract_in_words(contact, flags.instruction, flags.task)
    with working("loading the language model"):
        policy = load_llm(flags.weights or flags.llm.dir)
    try:
        with path_in_errors(flags.file):
            talk = Conversation(
                contact.cloud,
                policy.talker,
                contract=contract,
                mass_g=flags.mass,
                in_contact=contact.in_contact,
            )
    except ValueError as error:
        raise UsageError(f"--mass: {error}") from None
    console = make_console()

    def show(spoken: Spoken) -> None:
        if flags.json:
            sys.stdout.write(json.dumps(spoken.json(), ensure_ascii=False) + "\n")
        else:
            console.print(spoken.text)
        sys.stdout.flush()

    if flags.question is not None:
        show(_answer(talk, policy.check, flags.question))
        return 0
    if sys.stdin.isatty():
        _dialogue(talk, policy.check, show)
        return 0

    def show_error(message: str) -> None:
        line = json.dumps({"error": message}, ensure_ascii=False) if flags.json else message
        sys.stdout.write(line + "\n")
        sys.stdout.flush()

    def show_blank() -> None:
        sys.stdout.write("null\n" if flags.json else "\n")
        sys.stdout.flush()

    return _answer_lines(talk, policy.check, show, show_error, show_blank)


def _band(flags: AskFlags) -> Contract | None:
    """The contract of --goal and --limit; None without them."""
    from primitives.errors import LimitError
    from tacgrasp.lessons.dialogue.scene import band_contract

    if flags.goal is None:
        return None
    try:
        return band_contract(*flags.goal, flags.limit)
    except (LimitError, ValueError) as error:
        raise UsageError(f"--goal, --limit: {error}") from None


def _answer(talk: Conversation, check: Callable[[str], None], question: str) -> Spoken:
    """The answer to a question that is in English, by its words or because the grammar has it."""
    from policies import PolicyError
    from tacgrasp.lessons.understanding import understood_by_grammar

    try:
        check(question)
    except PolicyError as error:
        if understood_by_grammar(question) is None:
            raise UsageError(str(error)) from None
    return talk.ask(question)


def _dialogue(
    talk: Conversation, check: Callable[[str], None], show: Callable[[Spoken], None]
) -> None:
    """Ask on the terminal until an empty line; what can't be answered does not end it."""
    from policies import PolicyError
    from tacgrasp.console import make_console

    console = make_console()
    for question in _typed():
        try:
            show(_answer(talk, check, question))
        except (UsageError, PolicyError) as error:
            console.print(str(error))


def _typed() -> Iterator[str]:
    """Lines that are typed, until an empty one or the end of the input."""
    while True:
        try:
            line = input("? ").strip()
        except EOFError:
            sys.stdout.write("\n")
            return
        if not line:
            return
        yield line


def _answer_lines(
    talk: Conversation,
    check: Callable[[str], None],
    show: Callable[[Spoken], None],
    show_error: Callable[[str], None],
    show_blank: Callable[[], None],
) -> int:
    """Answer each line of the input by a line; returns the exit code.

    A line that can't be answered is told in its place and on stderr, and does not end the others.
    A blank line keeps its place too, so that answers can be laid beside their questions.

    Raises:
        UsageError: There is no question.
    """
    is_asked, code = False, 0
    if isinstance(sys.stdin, io.TextIOWrapper):  # what is no UTF-8 is no word that is known
        sys.stdin.reconfigure(errors="replace")
    for number, line in enumerate(sys.stdin, start=1):
        if not line.strip():
            show_blank()
            continue
        is_asked = True
        try:
            show(_answer(talk, check, line.strip()))
        except UsageError as error:
            sys.stderr.write(f"tacgrasp: line {number}: {error}\n")
            show_error(str(error))
            code = 2
    if not is_asked:
        raise UsageError("there is no question: give one after FILE, or lines of input")
    return code
