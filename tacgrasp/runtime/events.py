"""A run for machines: the contract, every step and the end, a JSON object each.

The file grows while the run goes on, so that another program can follow it. A file ``.json`` is one
array, which is closed again behind each event: whatever ends the process, it is valid and holds
what has been. Anything else has an object a line: a file ``.jsonl``, and a pipe, which can't be
gone back in. Not here: the full record of an episode (``tacgrasp.episodes``).
"""

from __future__ import annotations

import fcntl
import json
import os
from contextlib import suppress
from io import FileIO
from pathlib import Path
from types import TracebackType
from typing import Any

from primitives.contract import Contract
from tacgrasp.base.errors import UsageError
from tacgrasp.config.terms import contract_json
from tacgrasp.episodes.codec import to_json
from tacgrasp.episodes.record import StepRecord
from tacgrasp.runtime.outcome import EndReason, Outcome

REFUSED = "refused"
"""End of a run that was not begun, in the place of an ``EndReason``: its instruction is no
contract, or something in its configuration does not fit."""


class EventFile:
    """Writes events to a file as they come; without a file it does nothing.

    A file that can't be written any more, as on a full disk, ends there, and the run goes on.

    Attributes:
        problem: Why the file lacks what came later, as '--json F: No space left on device'; ''
            where it lacks nothing.
    """

    def __init__(self, path: Path | None) -> None:
        self._path = path
        self._file: FileIO | None = None
        self._is_array = self._is_empty = False
        self._began_s: float | None = None
        self._has_ended = False
        self._num_steps = self._num_actions = 0
        self.problem = ""

    def __enter__(self) -> EventFile:
        """Open the file.

        Raises:
            UsageError: It can't be written, or another run writes to it.
        """
        if self._path is not None:
            try:
                self._file = FileIO(os.open(self._path, os.O_WRONLY | os.O_CREAT, 0o666), "wb")
                if self._path.is_file():
                    self._lock()
                    self._file.truncate(0)
            except OSError as error:
                raise UsageError(f"--json {self._path} can't be written: {error}") from None
            is_json = self._path.resolve().suffix.lower() == ".json"
            self._is_array = self._is_empty = is_json and self._file.seekable()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Close the file; one whose run gave no outcome says why."""
        if error is not None and not self._has_ended:
            if isinstance(error, KeyboardInterrupt):
                self._end_without(EndReason.OPERATOR, str(error) or "stopped by the operator")
            elif isinstance(error, UsageError):
                self._end_without(REFUSED, str(error))
            else:
                self._end_without(EndReason.FAULT, str(error))
        if self._file is not None:
            self._file.close()

    def _lock(self) -> None:
        assert self._file is not None
        try:
            fcntl.flock(self._file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            self._file.close()
            raise UsageError(
                f"--json {self._path} is being written by another run; name another file"
            ) from None
        except OSError:
            return  # a disk without locks: another run can't be detected

    def contract(self, contract: Contract) -> None:
        """The contract, before anything moves."""
        self._write("contract", contract_json(contract))

    def step(self, record: StepRecord) -> None:
        """One step; a contract that what is felt has changed comes before it. An ``Observer``."""
        if record.contract is not None:
            self.contract(record.contract)
        decision, executed = record.decision, record.executed
        self._num_steps += 1
        self._num_actions += executed is not None
        if self._began_s is None:
            self._began_s = record.stamp.monotonic_s
        felt = record.felt_force_n
        self._write(
            "step",
            {
                "index": record.index,
                "phase": record.phase,
                "t_s": record.stamp.monotonic_s - self._began_s,
                "text": None if decision is None else decision.text,
                "action": None if decision is None else decision.action,
                "success": None if decision is None else decision.success,
                "reason": None if decision is None else decision.reason,
                "in_contact": record.in_contact,
                "felt_force_n": None if felt is None else [felt.low, felt.value, felt.high],
                "needed_force_n": None
                if record.need is None
                else [record.need.force_n.low, record.need.force_n.high],
                "force_scale": to_json(record.cloud.force_scale),
                "commanded_force_n": record.gripper.force_n,
                "sent": None if executed is None else executed.sent,
                "clamped": [] if executed is None else list(executed.clamped),
                "note": record.note,
                "reflex": None if record.reflex is None else record.reflex.text,
            },
        )

    def end(self, outcome: Outcome) -> None:
        """The end, with the simulator's truth where there is one."""
        truth = outcome.truth or {}
        bruised = [truth[name] for name in ("bruised", "bruised_at_start") if name in truth]
        self._write(
            "end",
            {
                "reason": outcome.reason,
                "message": outcome.message,
                "safe_state": outcome.safe_state,
                "verified": outcome.verified,
                "bruised": any(bruised) if bruised else None,
                "dropped": truth.get("dropped"),
                "peak_force_n": truth.get("peak_force_n"),
                "slip_minimum_n": outcome.slip_minimum_n,
                "steps": outcome.num_steps,
                "actions": outcome.num_actions,
            },
        )

    def refused(self, contract: Contract) -> None:
        """The end of a run whose contract is refused."""
        self._end_without(REFUSED, contract.refused)

    def _end_without(self, reason: str, message: str) -> None:
        """The end of a run without an outcome: it did not begin, or its closing was cut short."""
        nothing = dict.fromkeys(
            ("safe_state", "verified", "bruised", "dropped", "peak_force_n", "slip_minimum_n")
        )
        counts = {"steps": self._num_steps, "actions": self._num_actions}
        self._write("end", {"reason": reason, "message": message, **nothing, **counts})

    def _write(self, event: str, fields: dict[str, Any]) -> None:
        if self._file is None:
            return
        self._has_ended = event == "end"
        text = json.dumps({"event": event, **to_json(fields, event)}, ensure_ascii=False)
        if self._is_array:
            start = "[\n" if self._is_empty else ",\n"
            if not self._is_empty:
                self._file.seek(-len(_CLOSED), os.SEEK_CUR)
            text, self._is_empty = start + text + _CLOSED.decode(), False
        else:
            text += "\n"
        self._append(text.encode("utf-8"))

    def _append(self, data: bytes) -> None:
        """Write in one piece, so that the array is never seen open; or leave the file as it was."""
        assert self._file is not None
        whole, done = self._file.tell() if self._file.seekable() else None, 0
        try:
            while done < len(data):
                done += self._file.write(data[done:]) or 0
        except OSError as error:
            self.problem = f"--json {self._path}: {error.strerror}"
            with suppress(OSError), self._file:
                if whole is not None:
                    self._file.truncate(whole)
                    if self._is_array and whole > 0:
                        self._file.seek(whole)
                        self._file.write(_CLOSED)
            self._file = None


_CLOSED = b"\n]\n"
