"""Keys of a policy server: a text in a file that only its owner can read."""

from __future__ import annotations

import ipaddress
from pathlib import Path

from tacgrasp.base.errors import UsageError

MIN_CHARACTERS, MAX_CHARACTERS = 16, 200


def read_key(path: Path, *, flag: str) -> str:
    """Read a key.

    Args:
        path: Its file.
        flag: Flag that named it, for messages.

    Raises:
        UsageError: No such file, one that others can read, or no key in it.
    """
    advice = f"make one: (umask 077; openssl rand -hex 32 > {path})"
    try:
        mode = path.stat().st_mode
        with path.open("rb") as file:
            data = file.read(MAX_CHARACTERS + 2)
    except OSError as error:
        raise UsageError(f"{flag} {path} can't be read: {error.strerror}; {advice}") from None
    if mode & 0o077:
        raise UsageError(f"{flag} {path} can be read by others; run: chmod 600 {path}")
    key = data.decode("ascii", errors="replace").strip()
    if not (MIN_CHARACTERS <= len(key) <= MAX_CHARACTERS and key.isascii() and key.isprintable()):
        raise UsageError(
            f"{flag} {path} must hold one key of {MIN_CHARACTERS} to {MAX_CHARACTERS} printable "
            f"characters; {advice}"
        )
    return key


def is_loopback(host: str) -> bool:
    """Whether only this computer reaches a host."""
    if host == "localhost":
        return True
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return False
