"""Refuses a picture that does not fit into free memory, before any work on it.

Systems grant more memory than they have, and kill the process that uses it. So the free memory has
to be looked up.
"""

from __future__ import annotations

import ctypes
import sys
from contextlib import suppress
from pathlib import Path

_GIB = 1 << 30

# The most bytes that a pixel takes at any time in a large picture; a test runs commands in that.
TRACED = 256  # while it is traced, and while the files of the picture are made
COMPARED = 512  # while it is compared
ALWAYS = 64 << 20  # bytes of temporaries of a picture of any size


class PictureTooLargeError(MemoryError):
    """The picture does not fit into memory; the message says what it needs and what is free."""


def check_memory(width: int, height: int, bytes_per_pixel: int, always: int = ALWAYS) -> None:
    """Refuse a picture that does not fit into free memory.

    Where the system does not say what is free, nothing is refused.

    Raises
    ------
    PictureTooLargeError
    """
    needed = always + width * height * bytes_per_pixel
    free = free_memory()
    if free is not None and needed > free:
        raise PictureTooLargeError(
            f"The picture has {width} x {height} pixels, which take {needed / _GIB:.1f} GiB with "
            f"all outputs, and {free / _GIB:.1f} GiB of memory are free: choose a smaller size, "
            "a border, or --rows."
        )


def give_back() -> None:
    """Give memory that was freed back to the system, where the C library would keep it (glibc)."""
    if sys.platform == "linux" and hasattr(library := ctypes.CDLL(None), "malloc_trim"):
        library.malloc_trim(0)


def free_memory() -> int | None:
    """Return how many bytes are free without swapping; None if the system does not say."""
    if sys.platform == "win32":
        # A MEMORYSTATUSEX: its length and the load in 32 bits each, the total, what is free, ...
        status = (ctypes.c_uint64 * 8)(64)
        done = ctypes.windll.kernel32.GlobalMemoryStatusEx(ctypes.byref(status))
        return status[2] if done else None
    found: list[int] = []
    for ask in (_free_of_machine, _free_of_container, _free_of_process):
        # The system may not have this limit, or call it "max": then there is none.
        with suppress(ImportError, OSError, ValueError, StopIteration):
            found += ask()
    return min(found, default=None)


def _free_of_machine() -> list[int]:
    lines = Path("/proc/meminfo").read_text(encoding="ascii").splitlines()
    return [next(int(v.split()[1]) for v in lines if v.startswith("MemAvailable:")) << 10]


def _free_of_container() -> list[int]:
    folder = Path("/sys/fs/cgroup")
    limit = int((folder / "memory.max").read_text())
    return [limit - int((folder / "memory.current").read_text())]


def _free_of_process() -> list[int]:
    """Return the bytes left below the process's own limits, which `ulimit -v` and `-d` set."""
    import resource

    pages = Path("/proc/self/statm").read_text(encoding="ascii").split()
    limits = (resource.RLIMIT_AS, pages[0]), (resource.RLIMIT_DATA, pages[5])
    soft = [(resource.getrlimit(kind)[0], int(used)) for kind, used in limits]
    page = resource.getpagesize()
    return [limit - used * page for limit, used in soft if limit != resource.RLIM_INFINITY]
