"""Whether there is memory for a picture, asked before any work.

Systems hand out more memory than they have, and end the process that uses it: so what is free has
to be asked for.
"""

from __future__ import annotations

import ctypes
import sys
from contextlib import suppress
from pathlib import Path

_GIB = 1 << 30

# What a pixel takes at most at any time, of processes that make pictures of 1024 x 1024 pixels:
# while it is traced, and made into what is written; and while it is compared. Measured by
# `tools/memory_a_pixel.py`, rounded up.
TRACED, COMPARED = 256, 512
ALWAYS = 64 << 20  # bytes of temporaries, however small the picture is


class PictureTooLargeError(MemoryError):
    """The picture cannot be held in memory; the message says by how much."""


def check_memory(width: int, height: int, bytes_per_pixel: int, always: int = ALWAYS) -> None:
    """Raise a PictureTooLargeError if a picture of this size does not fit into free memory.

    Where the system does not say what is free, nothing is refused.
    """
    needed, free = always + width * height * bytes_per_pixel, free_memory()
    if free is not None and needed > free:
        raise PictureTooLargeError(
            f"The picture has {width} x {height} pixels, which take {needed / _GIB:.1f} GiB with "
            f"all outputs, and {free / _GIB:.1f} GiB of memory are free: choose a smaller size, "
            "a border, or --rows."
        )


def free_memory() -> int | None:
    """Return how many bytes can be had without swapping; None if the system does not say."""
    if sys.platform == "win32":
        return _free_on_windows()
    found = []
    for ask in (_free_of_machine, _free_of_container, _free_of_process):
        # A system that does not have it; or "max", which is no number: there is no limit.
        with suppress(ImportError, OSError, ValueError, StopIteration):
            found += ask()
    return min(found, default=None)


def _free_of_machine() -> list[int]:
    lines = Path("/proc/meminfo").read_text(encoding="ascii").splitlines()
    return [next(int(v.split()[1]) for v in lines if v.startswith("MemAvailable:")) << 10]


def _free_of_container() -> list[int]:
    folder = Path("/sys/fs/cgroup")
    limit, used = ((folder / name).read_text() for name in ("memory.max", "memory.current"))
    return [int(limit) - int(used)]


def _free_of_process() -> list[int]:
    """Return what is left of the process's own limits, as `ulimit -v` and `-d` set them."""
    import resource

    pages = Path("/proc/self/statm").read_text(encoding="ascii").split()
    limits = (resource.RLIMIT_AS, pages[0]), (resource.RLIMIT_DATA, pages[5])
    soft = [(resource.getrlimit(kind)[0], int(used)) for kind, used in limits]
    page = resource.getpagesize()
    return [limit - used * page for limit, used in soft if limit != resource.RLIM_INFINITY]


def _free_on_windows() -> int | None:
    # A MEMORYSTATUSEX: its length and the load in 32 bits each, what there is, what is free, ...
    status = (ctypes.c_uint64 * 8)(64)
    done = ctypes.windll.kernel32.GlobalMemoryStatusEx(ctypes.byref(status))
    return status[2] if done else None
