"""Blender as a peer: BVHTree, Cycles and Workbench, in a process of its own.

Here is the side that asks; `blender_child.py` answers, a line of JSON for each. A process of its
own may crash, as Workbench does where there is nothing to draw with, and nobody else notices.
"""

from __future__ import annotations

import importlib.util
import json
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import IO, Any

from reference_tracer.scene import Scene

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
        self._process: Any = None
        self._errors: Any = None
        self._opened: dict[str, Any] | None = None

    def make_suzanne(self, path: Path) -> None:
        """Write Blender's monkey, subdivided, to a .npz."""
        self._ask(do="suzanne", path=str(path))

    def open(self, scene: Scene) -> None:
        """Build a scene of the benchmark in Blender, in place of the one before."""
        camera = scene.camera
        self._opened = {
            "do": "open",
            "scene": scene.meshes[0].name,
            "cache": str(self._cache),
            "size": [camera.width, camera.height],
            "camera": camera.projection.name,
        }
        self._ask(**self._opened)

    def bvhtree(self, budget: float) -> Timed:
        """Cast the open scene's rays, or a sample that takes about `budget` seconds."""
        return Timed(**self._ask(do="bvhtree", budget=budget))

    def render(self, engine: str) -> float:
        """Render the open scene with one of ENGINES, one sample; returns seconds of the call."""
        return self._ask(do=engine)["seconds"]

    def close(self) -> None:
        """End it, if it runs."""
        if self._process:
            self._process.kill()
            self._process.communicate()
        if self._errors:
            self._errors.close()
        self._process = self._errors = None

    def _ask(self, **question: Any) -> dict[str, Any]:
        if self._process is None:
            self._start()
            if question["do"] not in ("open", "suzanne") and self._opened:
                self._ask(**self._opened)  # it ended in between
        answer = self._said(question)
        if "error" in answer:
            raise MissingPeerError(answer["error"])
        return answer

    def _said(self, question: dict[str, Any]) -> dict[str, Any]:
        try:
            self._process.stdin.write(json.dumps(question) + "\n")
            self._process.stdin.flush()
            # What Blender says while it starts comes before the answer.
            return json.loads(next(x for x in self._process.stdout if x.startswith("{")))
        except (OSError, ValueError, StopIteration):  # a broken pipe, or no line
            last = _last_line(self._errors)
            self.close()
            return {"error": f"Blender ended without an answer to '{question['do']}' ({last})"}

    def _start(self) -> None:
        self._errors = tempfile.TemporaryFile("w+", encoding="utf-8", errors="replace")
        self._process = subprocess.Popen(
            [sys.executable, "-m", "reference_tracer_benchmarks.blender_child"],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=self._errors,
            text=True,
            start_new_session=True,  # Ctrl-C is ours: we end it ourselves
        )


def _last_line(file: IO[str] | None) -> str:
    if file is None:
        return "no message"
    file.seek(0)
    return (file.read().strip().splitlines() or ["no message"])[-1]
