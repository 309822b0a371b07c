"""rerun's viewer as a process of its own: on this computer alone, with bounded memory.

rerun's own way listens on every network interface and may fill the memory; here it listens on
127.0.0.1, and drops the oldest data beyond a limit. Not here: what is shown
(``tacgrasp.viewer.scene``).
"""

from __future__ import annotations

import importlib.util
import os
import signal
import socket
import subprocess
import sys
import tempfile
import time
from contextlib import suppress
from typing import TYPE_CHECKING

from tacgrasp.base.errors import UsageError
from tacgrasp.base.stop_signals import until_ctrl_c

if TYPE_CHECKING:
    import rerun as rr

HOST = "127.0.0.1"
MEMORY = "1GB"
"""Most memory of the viewer, and half of it of its server; then the oldest data is dropped."""

START_S = 20.0
"""Longest wait for the viewer's port [s]."""


def require_rerun(user: str = "the viewer", extra: str = "view") -> None:
    """Refuse to go on without rerun.

    Args:
        user: What needs it.
        extra: The package's extra that brings it.

    Raises:
        UsageError: It is not installed; the message says how to install it.
    """
    if importlib.util.find_spec("rerun") is None:
        raise UsageError(
            f"{user} needs rerun, which is not installed; install it: pip install "
            f"'tacgrasp[{extra}]', or pip install -e '.[{extra}]' in a copy of the repository"
        )


def has_display() -> bool:
    """Whether a window can be opened here."""
    return sys.platform != "linux" or bool(
        os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")
    )


class Viewer:
    """A running viewer: a window, or without a display a page for a browser on this computer.

    Attributes:
        url: Where streams connect to.
        page: Address of the page for a browser; empty for a window.
    """

    def __init__(self, *, web: bool) -> None:
        """Start it.

        Raises:
            UsageError: rerun is missing, or the viewer does not start.
        """
        require_rerun()
        port = _free_port()
        self._streams: list[rr.RecordingStream] = []
        self.url, self.page = f"rerun+http://{HOST}:{port}/proxy", ""
        command = [sys.executable, "-m", "rerun", "--bind", HOST, "--port", str(port)]
        command += ["--memory-limit", MEMORY, "--server-memory-limit", "512MB"]
        command.append("--hide-welcome-screen")
        if web:
            web_port = _free_port()
            self.page = f"http://{HOST}:{web_port}/?url={self.url.replace('+', '%2B')}"
            command += ["--serve-web", "--web-viewer-port", str(web_port)]
        self._log = tempfile.TemporaryFile()  # noqa: SIM115 - an unread pipe would fill and stop it
        self._process = subprocess.Popen(
            command, stdout=subprocess.DEVNULL, stderr=self._log, start_new_session=True
        )
        try:
            self._wait_for(port)
        except BaseException:  # Ctrl-C too: the process has a session of its own
            self.close()
            raise

    def stream(self, name: str) -> rr.RecordingStream:
        """A new stream into this viewer."""
        import rerun

        stream = rerun.RecordingStream("tacgrasp", recording_id=name)
        stream.connect_grpc(self.url)
        self._streams.append(stream)
        return stream

    def wait(self) -> None:
        """Wait until the window is closed, or for Ctrl-C."""
        with until_ctrl_c():
            self._process.wait()

    def close(self) -> None:
        """End the viewer and the program that it started. Idempotent."""
        for stream in self._streams:
            stream.disconnect()
        self._streams.clear()
        with suppress(ProcessLookupError):
            os.killpg(self._process.pid, signal.SIGTERM)  # rerun starts its viewer as a child
        try:
            self._process.wait(timeout=5)
        except subprocess.TimeoutExpired:
            os.killpg(self._process.pid, signal.SIGKILL)

    def _wait_for(self, port: int) -> None:
        deadline_s = time.monotonic() + START_S
        while time.monotonic() < deadline_s:
            if self._process.poll() is not None:
                break
            with socket.socket() as probe:
                if probe.connect_ex((HOST, port)) == 0:
                    return
            time.sleep(0.05)
        self.close()
        self._log.seek(0)
        error = self._log.read().decode(errors="replace")
        last = error.strip().splitlines()[-1:] or ["no message"]
        raise UsageError(
            f"rerun's viewer did not start: {last[0]}; without a display give --web, or write a "
            "file: tacgrasp episodes export EPISODE --to rrd"
        )


def _free_port() -> int:
    with socket.socket() as probe:
        probe.bind((HOST, 0))
        return int(probe.getsockname()[1])
