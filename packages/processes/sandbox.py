"""What a program of others may see, write and take: in bubblewrap, and by the system's limits."""

from __future__ import annotations

import os
import shutil
import subprocess
from collections.abc import Iterator
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
_KEPT_ENVIRONMENT = "PATH", "LANG", "HOME", "JAVA_HOME"


@cache
def sandbox() -> tuple[str, ...]:
    """Return the command that keeps a program in, without its folder; () where there is none."""
    if not shutil.which("bwrap"):
        return ()
    tried = subprocess.run([*_SANDBOX, "true"], capture_output=True, check=False)
    return _SANDBOX if tried.returncode == 0 else ()


def kept_in(words: list[str], folder: Path, environment: dict[str, str]) -> list[str]:
    """Return the command that runs another one in the sandbox; without a sandbox, that one.

    Parameters
    ----------
    words : list of str
    folder : Path
        The one that it may write to.
    environment : dict of str to str
        What it is told besides what is kept of the user's.
    """
    if not (kept := sandbox()):
        return words
    own = environment | {k: os.environ[k] for k in _KEPT_ENVIRONMENT if k in os.environ}
    return [*kept, *_seen(words, folder, own), "--", *words]


def _seen(words: list[str], folder: Path, environment: dict[str, str]) -> Iterator[str]:
    """Yield the sandbox's options for what a program may see and write, and its environment."""
    named = [Path(word).resolve() for word in words if os.path.exists(word)]
    folders = [path if path.is_dir() else path.parent for path in named]
    for path in dict.fromkeys((*named, *folders, Path.cwd())):
        if not any(hidden.is_relative_to(path) for hidden in _HIDDEN):
            yield from ("--ro-bind", str(path), str(path))
    yield from ("--bind", str(folder), str(folder), "--chdir", str(Path.cwd()))
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
            with suppress(ValueError, OSError):
                resource.setrlimit(kind, (most, most))

    return {"preexec_fn": limit}  # beside a thread it may import nothing and take no lock
