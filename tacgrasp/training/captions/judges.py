"""Judges of captions beside the rule: any command, or a local language model.

A judge gets the reference and the caption of each contact, and gives a rating from 1 to 5. Nothing
is downloaded, and no service is asked: a command may do so by itself.
"""

from __future__ import annotations

import json
import math
import shlex
import subprocess
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple, Protocol

import torch

from tacgrasp.base.errors import UsageError
from tacgrasp.training.captions.rating import HIGHEST, LOWEST

PROMPT = """Rate how well a caption of a touch agrees with the reference, from 1 (everything is wrong) to 5 (everything is right).
Reference: {reference}
Caption: {caption}
Rating from 1 to 5:
"""  # noqa: E501

_SHOWN = 80


class JudgedPair(NamedTuple):
    """What a judge is shown of one contact."""

    reference: str
    caption: str


class Judge(Protocol):
    """Rates captions."""

    @property
    def title(self) -> str:
        """Its name in tables."""
        ...

    def rate(self, pairs: Sequence[JudgedPair]) -> list[float]:
        """A rating from 1 to 5 of each caption."""
        ...


class CommandJudge:
    """A command that reads JSON lines and answers each with a line that holds a rating.

    A line is ``{"reference": …, "caption": …}``.

    Args:
        command: The command with its arguments, as a shell splits it; no shell runs it.
        timeout_s: Longest time for all captions of one call [s].

    Raises:
        UsageError: There is no command in it.
    """

    def __init__(self, command: str, timeout_s: float) -> None:
        try:
            self._argv = shlex.split(command)
        except ValueError as error:
            raise UsageError(f"--judge {command!r} is no command: {error}") from None
        if not self._argv:
            raise UsageError("--judge needs a command")
        self._timeout_s = timeout_s

    @property
    def title(self) -> str:
        return Path(self._argv[0]).name

    def rate(self, pairs: Sequence[JudgedPair]) -> list[float]:
        """Ratings of captions.

        Raises:
            UsageError: It can't be started, fails, takes too long, or answers something else.
        """
        lines = [json.dumps(pair._asdict(), ensure_ascii=False) for pair in pairs]
        try:
            done = subprocess.run(
                self._argv,
                input="\n".join(lines) + "\n",
                capture_output=True,
                text=True,
                encoding="utf-8",
                errors="replace",
                timeout=self._timeout_s,
                check=False,
            )
        except OSError as error:
            raise UsageError(f"--judge {self.title} can't be started: {error.strerror}") from None
        except subprocess.TimeoutExpired:
            raise UsageError(
                f"--judge {self.title} gave no ratings of {len(pairs)} captions within "
                f"{self._timeout_s:g} s; give it --judge-timeout-s, or fewer --contacts"
            ) from None
        if done.returncode:
            told = done.stderr.strip().splitlines()[-1:] or ["nothing"]
            raise UsageError(
                f"--judge {self.title} ended with code {done.returncode}; it says {told[0]:.200}"
            )
        answers = done.stdout.splitlines()
        if len(answers) != len(pairs):
            raise UsageError(
                f"--judge {self.title} answered {len(answers)} lines to {len(pairs)} captions; one "
                "line each is needed"
            )
        return [self._rating(number, line) for number, line in enumerate(answers, start=1)]

    def _rating(self, number: int, line: str) -> float:
        try:
            rating = float(line)
        except ValueError:
            rating = math.nan
        if not LOWEST <= rating <= HIGHEST:
            raise UsageError(
                f"--judge {self.title} answered {line[:_SHOWN]!r} in line {number}; a number from "
                "1 to 5 is needed"
            )
        return rating


class LmJudge:
    """A local causal language model: the mean of 1 to 5 under its probabilities of these tokens.

    Args:
        folder: Its directory in transformers' layout, with tokenizer.

    Raises:
        UsageError: It can't be read, or has no single token for each of the digits 1 to 5.
    """

    def __init__(self, folder: Path) -> None:
        import transformers

        self._folder = folder
        if not folder.is_dir():
            raise UsageError(f"--judge-lm {folder} is no directory")
        try:
            load = {"local_files_only": True}
            self._tokenizer = transformers.AutoTokenizer.from_pretrained(folder, **load)
            self._lm = transformers.AutoModelForCausalLM.from_pretrained(folder, **load).eval()
        except Exception as error:  # transformers raises errors of many kinds for a bad folder
            reason = str(error).splitlines()[0] if str(error) else repr(error)
            raise UsageError(
                f"--judge-lm {folder} holds no causal language model: {reason}"
            ) from error
        self._lm.to("cuda" if torch.cuda.is_available() else "cpu")
        tokens = [self._ids(str(digit)) for digit in range(1, 6)]
        if any(len(ids) != 1 for ids in tokens) or len({ids[0] for ids in tokens}) != 5:
            raise UsageError(
                f"--judge-lm {folder}: its tokenizer has no single token for each of 1 to 5; take "
                "another model"
            )
        self._digits = [ids[0] for ids in tokens]

    @property
    def title(self) -> str:
        return self._folder.resolve().name

    @torch.inference_mode()
    def rate(self, pairs: Sequence[JudgedPair]) -> list[float]:
        """Ratings of captions."""
        ratings = []
        for pair in pairs:
            ids = torch.tensor([self._ids(PROMPT.format(**pair._asdict()))], device=self._lm.device)
            logits = self._lm(input_ids=ids).logits[0, -1, self._digits].float()
            digits = torch.arange(1.0, 6.0, device=logits.device)
            ratings.append(float(logits.softmax(-1) @ digits))
        return ratings

    def _ids(self, text: str) -> list[int]:
        return list(self._tokenizer(text, add_special_tokens=False)["input_ids"])


def make_judge(command: str | None, folder: Path | None, timeout_s: float) -> Judge | None:
    """The judge that flags name; None without one.

    Raises:
        UsageError: Two are named, or it can't be used.
    """
    if command is not None and folder is not None:
        raise UsageError("--judge and --judge-lm exclude each other")
    if command is not None:
        return CommandJudge(command, timeout_s)
    return LmJudge(folder) if folder is not None else None
