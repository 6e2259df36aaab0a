"""Confines another's program: what it may see, write and take, in bubblewrap and by limits.

What is kept for a later run carries a digest under a `secret`, which no program in the sandbox can
read: its folder is empty there.
"""

from __future__ import annotations

import os
import secrets
import shlex
import shutil
import subprocess
from collections.abc import Iterator, Sequence
from contextlib import suppress
from functools import cache
from pathlib import Path
from typing import Any

_LARGEST_FILE = 1 << 30  # bytes that a program may write to one
# Sockets of other programs lie here, which a read-only folder would not keep it from.
_HIDDEN = Path("/run"), Path("/tmp"), Path("/var/tmp")
_SANDBOX = (
    "bwrap",
    "--die-with-parent",
    "--unshare-all",
    "--ro-bind",
    "/",
    "/",
    "--dev",
    "/dev",
    "--proc",
    "/proc",
    *(word for folder in _HIDDEN for word in ("--tmpfs", str(folder))),
    "--clearenv",
)
_KEPT_ENVIRONMENT = "PATH", "LANG", "HOME", "JAVA_HOME", "PYTHONPATH"


@cache
def sandbox() -> tuple[str, ...]:
    """Return the command that keeps a program in, without its folder; () where there is none."""
    if not shutil.which("bwrap"):
        return ()
    tried = subprocess.run([*_SANDBOX, "true"], capture_output=True, check=False)
    return _SANDBOX if tried.returncode == 0 else ()


def secret() -> bytes | None:
    """Return the user's key, made at first; None where programs could read it."""
    path = _secrets() / "key"
    with suppress(OSError):
        if sandbox():
            path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
            with suppress(FileExistsError):
                path.touch(0o600, exist_ok=False)
                path.write_bytes(secrets.token_bytes(32))
            return path.read_bytes() or None
    return None


def _secrets() -> Path:
    state = os.environ.get("XDG_STATE_HOME") or Path.home() / ".local" / "state"
    return (Path(state) / "reference_tracer").resolve()


def kept_in(
    words: list[str],
    folder: Path | None,
    environment: dict[str, str],
    start: Path | None = None,
    libraries: Sequence[Path] = (),
) -> list[str]:
    """Return the command that runs another one in the sandbox; without a sandbox, that one.

    Parameters
    ----------
    words : list of str
    folder : Path, optional
        The one that it may write to.
    environment : dict of str to str
        What it is told besides what is kept of the user's.
    start : Path, optional
        Where it is started: by default where this process is.
    libraries : sequence of Path, optional
        What it needs to see, besides what its words name.
    """
    if not (kept := sandbox()):
        return words
    own = environment | {k: os.environ[k] for k in _KEPT_ENVIRONMENT if k in os.environ}
    named = [Path(word).resolve() for word in words if os.path.exists(word)]
    seen = [*libraries, *named, *(path if path.is_dir() else path.parent for path in named)]
    start = start or Path.cwd()
    options = _seen([*seen, start], folder, own)
    return [*kept, *options, "--chdir", str(start), "--", *words]


def check_shown(words: Sequence[str], otherwise: str = "") -> None:
    """Raise a ValueError if a command's program is here, but not in the sandbox.

    Parameters
    ----------
    words : sequence of str
    otherwise : str
        What else can be done, in words, begun by a comma.
    """
    found = shutil.which(words[0])
    if found and sandbox():
        probe = ["sh", "-c", f"test -x {shlex.quote(found)}", *words]
        if subprocess.run(kept_in(probe, None, {}), capture_output=True, check=False).returncode:
            folders = " or ".join(map(str, _HIDDEN))
            do = f"use one that is not in {folders}{otherwise}"
            raise ValueError(f"the sandbox does not show '{found}': {do}")


def _seen(paths: list[Path], folder: Path | None, environment: dict[str, str]) -> Iterator[str]:
    """Yield the sandbox's options for what a program may see and write, and its environment."""
    for path in dict.fromkeys(paths):
        if not any(hidden.is_relative_to(path) for hidden in _HIDDEN):
            yield from ("--ro-bind", str(path), str(path))
    if _secrets().is_dir():
        yield from ("--tmpfs", str(_secrets()))
    if folder:
        yield from ("--bind", str(folder), str(folder))
    for name, value in environment.items():
        yield from ("--setenv", name, value)


def limited(memory: int) -> dict[str, Any]:
    """Return what has the system limit a process, where it can: memory (bytes), files, dumps."""
    try:
        import resource
    except ImportError:  # Windows
        return {}

    def limit() -> None:
        for kind, most in (
            (resource.RLIMIT_DATA, memory),
            (resource.RLIMIT_FSIZE, _LARGEST_FILE),
            (resource.RLIMIT_CORE, 0),
        ):
            with suppress(ValueError, OSError, OverflowError):
                resource.setrlimit(kind, (most, most))

    return {"preexec_fn": limit}  # beside a thread it may import nothing and take no lock
