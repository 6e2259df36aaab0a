"""Blender as a peer: BVHTree, Cycles and Workbench, in a process of its own.

`blender_child.py` has what runs there. A process of its own may crash, as Workbench does where
there is nothing to draw with, and nobody else notices.
"""

from __future__ import annotations

import importlib.util
from importlib import import_module
from pathlib import Path
from typing import Any

from reference_tracer.scene import Scene

from .children import Child
from .peers import MissingPeerError, Timed, missing

ENGINES = "cycles", "workbench"


class BlenderPeer:
    """A Blender that waits to be asked; :meth:`close` ends it."""

    def __init__(self, cache: Path) -> None:
        """Start nothing yet; `cache` is the folder with Suzanne.

        Raises
        ------
        MissingPeerError
            If there is no bpy.
        """
        if importlib.util.find_spec("bpy") is None:
            raise missing("bpy")
        self._cache = cache
        self._child: Child | None = None
        self._opened: tuple[Any, ...] = ()

    def make_suzanne(self, path: Path) -> None:
        """Write Blender's monkey, subdivided, to a .npz."""
        self._ask("suzanne", path)

    def open(self, scene: Scene) -> None:
        """Build a scene of the benchmark in Blender, in place of the one before."""
        camera = scene.camera
        size = camera.width, camera.height
        self._opened = scene.meshes[0].name, self._cache, size, camera.projection.name
        self._ask("open_benchmark", *self._opened)

    def bvhtree(self, budget: float) -> Timed:
        """Cast the open scene's rays, or a sample that takes about `budget` seconds."""
        return Timed(*self._ask("bvhtree", budget))

    def render(self, engine: str) -> float:
        """Render the open scene with one of ENGINES, one sample; returns seconds of the call."""
        seconds: float = self._ask("render", engine)
        return seconds

    def close(self) -> None:
        """End it, if it runs."""
        if self._child:
            self._child.end()
        self._child = None

    def _ask(self, name: str, *arguments: Any) -> Any:
        if self._child is None:
            self._child = Child()
            if self._opened and name in ("bvhtree", "render"):  # it ended in between
                self._ask("open_benchmark", *self._opened)
        try:
            return self._child.call(do, name, *arguments)
        except MissingPeerError as error:
            if not self._child.is_alive:
                self.close()
                what = arguments[0] if name == "render" else name
                said = f"Blender ended without an answer to '{what}' ({error})"
                raise MissingPeerError(said) from None
            raise


def do(name: str, *arguments: Any) -> Any:
    """Call a function of `blender_child.py`, in a process that may import bpy."""
    return getattr(import_module(f"{__package__}.blender_child"), name)(*arguments)
