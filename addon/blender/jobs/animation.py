"""Compares the frames of an animation: the scene is stepped through them, in order.

What is simulated and not baked depends on the frames before: these are visited, too.
"""

from __future__ import annotations

import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import bpy
import numpy as np
from bpy.types import Scene

from ...camera_files.convention import View
from ...comparison.animation import FrameRow
from ...errors import words
from ...report import animation as report
from ...scene import SceneError
from ...tracer.progress import Found, Progress, Work, scaled
from ..drawing.judges import OF_ONE_FRAME, STILLS
from ..reading.camera import export_camera
from ..slowest import announced
from ..values import values_restored
from .choice import seen_by
from .compare import compare_open_file
from .open_file import Choices
from .stepping import frame_restored, visited

_DRAWS = "Blender draws the scene"
_ADDON = __package__.rsplit(".", 2)[0]  # which imports this, and must not be imported here


def compare_frames(
    folder: Path,
    frames: range,
    made_by: Any = None,
    views: Mapping[int, View] | None = None,
    **choices: Any,
) -> Work[list[FrameRow]]:
    """Step the context's scene to each frame, compare it, and write the table of all so far.

    A frame that cannot be compared is a row, too; all rows are found after each new one.

    Parameters
    ----------
    folder : Path
        Of all that is written.
    frames : range
    made_by : dict, optional
        What the comparisons depend on. Frames that are whole in the folder and were made by the
        same are not compared again.
    views : mapping of int to View, optional
        The camera of a file for each frame, in place of the scene's.
    **choices
        The fields of :class:`.compare.Choices`.

    Raises
    ------
    SceneError, OSError
        If there is no camera, the picture to compare with is a still, or the folder cannot be
        written.
    """
    scene = bpy.context.scene
    if Choices.of(scene, choices).judge in STILLS:
        raise SceneError(f"{OF_ONE_FRAME}.")
    if not (views or scene.camera or any(marker.camera for marker in scene.timeline_markers)):
        export_camera(scene)  # says so once, not in each frame
    title = f"{bpy.path.basename(bpy.data.filepath)}, {scene.name}"
    views = views or {}
    made = {frame: _made_by(made_by, views.get(frame)) for frame in frames}
    rows = [r for f in frames if (r := report.row_of_whole(folder, f, made[f]))]
    todo = sorted(set(frames) - {row.frame for row in rows})
    report.write(folder, title, frames, rows)
    takes = _DRAWS
    with values_restored(), frame_restored(scene):
        for frame in visited(scene, todo):
            share = sum(f < frame for f in todo) / len(todo)
            yield Progress(share, f"frame {frame}: {takes}")
            scene.frame_set(frame)
            takes = announced(bpy.context.view_layer, _DRAWS)  # asked while all is evaluated
            yield Progress(share, f"frame {frame}: {takes}")
            if frame in todo:
                work = _compared(folder, frame, made[frame], views.get(frame), choices)
                work = scaled(work, share, 1 / len(todo), f"frame {frame}")
                rows.append((yield from work))
                report.write(folder, title, frames, rows)
                yield Found(rows, report.line(rows[-1]))
    return rows


def _made_by(made_by: Any, view: View | None) -> Any:
    """Return what a frame depends on: also its own camera, to the last digit."""
    if made_by is None or view is None:
        return made_by
    with np.printoptions(precision=17):
        return {**made_by, "camera": repr(view)}


def _compared(
    folder: Path, frame: int, made_by: Any, view: View | None, choices: dict[str, Any]
) -> Work[FrameRow]:
    own = report.folder_of(folder, frame)
    try:
        # Hundreds of frames with the same fault are diagnosed one at a time, by who asks for it.
        choices = choices | {"diagnose": False, "literal": False}
        with seen_by(bpy.context.scene, view):
            comparison = yield from compare_open_file(bpy.context, own, **choices)
    except (SceneError, RuntimeError, MemoryError) as error:  # other frames may well be compared
        return FrameRow(frame, error=words(error))
    report.mark_whole(folder, frame, made_by)
    return FrameRow.of(frame, comparison.to_dict())


def frames_of(scene: Scene) -> range:
    """Return the frames of a scene's animation.

    Raises
    ------
    SceneError
        If it is playing.
    """
    screen = bpy.context.screen
    if screen and screen.is_animation_playing:
        raise SceneError("The animation is playing: stop it first.")
    return range(scene.frame_start, scene.frame_end + 1, scene.frame_step)


def depends_on(options: dict[str, str]) -> dict[str, Any]:
    """Return all that a frame's comparison depends on, but for the frame's number.

    The options are those of the command line: a frame that was compared with others, or of another
    file, is compared again.
    """
    used = {bpy.data.filepath, *bpy.utils.blend_paths(absolute=True)}  # libraries, Alembic, images
    files = sorted(path for path in map(Path, used) if path.is_file())
    return {
        "versions": [sys.modules[_ADDON].__version__, bpy.app.version_string],
        "files": {str(f): [f.stat().st_size, f.stat().st_mtime_ns] for f in files},
        "options": options,
    }
