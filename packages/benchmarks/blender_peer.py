"""Blender as a peer: BVHTree, Cycles and Workbench, in a process of its own.

`blender_child.py` has what runs there. A process of its own may crash, as Workbench does where
there is nothing to draw with, and nobody else notices.
"""

from __future__ import annotations

import importlib.util
import os
import signal
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from importlib import import_module
from multiprocessing import active_children, get_context
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from reference_tracer.scene import Scene

from .peers import MissingPeerError, Timed, missing

ENGINES = "cycles", "workbench"


class BlenderPeer:
    """A Blender that waits to be asked, and is started at first; :meth:`close` ends it.

    Each question raises a MissingPeerError if there is no bpy, it fails, or the process ends.
    """

    def __init__(self) -> None:
        """Start nothing yet."""
        self._pool: ProcessPoolExecutor | None = None
        self._opened: Scene | None = None
        self._folder = TemporaryDirectory(prefix="reftrace-bench-", ignore_cleanup_errors=True)
        # What it prints is not shown, but for the last line, where it ends by itself.
        self._printed = Path(self._folder.name, "printed.txt")
        self._printed.touch()

    def make_suzanne(self, path: Path) -> None:
        """Write Blender's monkey, subdivided, to a .npz."""
        self._ask("suzanne", path)

    def open(self, scene: Scene) -> None:
        """Build a scene of the benchmark in Blender, in place of the one before."""
        self._ask("open_scene", scene)
        self._opened = scene

    def bvhtree(self, budget: float) -> Timed:
        """Cast the open scene's rays, or a sample that takes about `budget` seconds."""
        return Timed(*self._ask("bvhtree", budget))

    def render(self, engine: str) -> float:
        """Render the open scene with one of ENGINES, one sample; returns seconds of the call."""
        seconds: float = self._ask("render", engine)
        return seconds

    def close(self) -> None:
        """End it, if it runs."""
        if self._pool:
            for process in active_children():
                process.kill()
            self._pool.shutdown()
        self._pool = None

    def _ask(self, name: str, *arguments: Any) -> Any:
        if self._pool is None:
            if importlib.util.find_spec("bpy") is None:
                raise missing("bpy")
            printed = (str(self._printed),)
            self._pool = ProcessPoolExecutor(1, get_context("spawn"), _begin, printed)
            if self._opened:  # it ended in between
                self._ask("open_scene", self._opened)
        try:
            return self._pool.submit(do, name, *arguments).result()
        except BrokenProcessPool:
            self.close()
            what = arguments[0] if name == "render" else name
            lines = self._printed.read_text("utf-8", "replace").strip().splitlines()
            said = f"({lines[-1] if lines else 'no message'})"
            raise MissingPeerError(f"Blender ended without an answer to '{what}' {said}") from None
        except Exception as error:  # whoever asks is told, and goes on without
            raise MissingPeerError(f"{type(error).__name__}: {error}") from None


def _begin(printed: str) -> None:
    """Have the process print into a file, and leave Ctrl-C to who started it, and ends it."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    with open(printed, "ab") as file:
        for stream in (1, 2):
            os.dup2(file.fileno(), stream)


def do(name: str, *arguments: Any) -> Any:
    """Call a function of `blender_child.py`, in a process that may import bpy."""
    return getattr(import_module(f"{__package__}.blender_child"), name)(*arguments)
