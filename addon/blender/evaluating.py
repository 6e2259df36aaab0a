"""Has Blender evaluate a temporary scene once, to be exported, and drawn as often as is wanted.

To evaluate is to apply every modifier, which may take minutes; each render does it anew. A window
keeps what it has evaluated. In a render, Blender's engines can keep it from frame to frame of an
animation: so one frame is rendered again and again. What is changed in between, Blender evaluates
alone, before it draws.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

import bpy
from bpy.types import Depsgraph

from ..manifest import Manifest
from ..scene import Scene, SceneError
from ..tracer.signals import held
from .reading.export import export
from .reading.rendered import result_image
from .temporary import ENGINE, go_to, remove
from .turns import InTurns, T, Turns, once
from .values import values_restored
from .versions import ENGINES

if TYPE_CHECKING:
    from .drawing.judge import Judge


def evaluated(scene: bpy.types.Scene, judge: Judge | None, work: Turns[T]) -> T:
    """Have Blender evaluate a temporary scene, and draw it, in turns with the work.

    A 'Render Result' that did not exist before is removed.

    Parameters
    ----------
    scene : bpy.types.Scene
        Its `render.filepath` is then in a folder that goes with what is in it.
    judge : Judge, optional
        What draws; None for work that has a render's evaluation, and no picture.
    work : generator
        What it returns is returned, and what it raises is raised.

    Raises
    ------
    SceneError
        If Blender draws nothing.
    """
    turns = InTurns(work)
    had_result = result_image()
    with held(), TemporaryDirectory() as folder:
        scene.render.filepath = str(Path(folder) / "picture")  # also one of work that has ended
        try:
            if judge and judge.needs_window:
                _draw_in_window(turns, scene)
            else:
                _render(turns, scene, judge)
        except RuntimeError as error:  # what Blender reports, as that a GPU has no such size
            said = str(error).removeprefix("Error: ").strip()
            turns.fail(SceneError(f"{judge.name} draws no picture: {said}" if judge else said))
        turns.fail(SceneError("Blender ended the render"))
        if not had_result and (image := result_image()):
            bpy.data.images.remove(image)
    return turns.result()


def export_at(tmp: Any, frame: float, judge: Judge | None = None) -> Scene:
    """Return what a temporary scene has at another frame, or between two; it goes back."""
    now = tmp.frame_current + tmp.frame_subframe
    with values_restored():
        go_to(tmp, frame)
        scene, _ = export_for_render(tmp, judge)
        go_to(tmp, now)
    return scene


def _draw_in_window(turns: InTurns[Any], scene: bpy.types.Scene) -> None:
    # Adding a window, area or region to the override crashes Blender (4.3, 5.2).
    with bpy.context.temp_override(scene=scene, view_layer=scene.view_layers[0]):
        while not turns.go_on(bpy.context.evaluated_depsgraph_get()):
            bpy.ops.render.opengl(view_context=False, write_still=True)
            if turns.go_on():
                return


def _render(turns: InTurns[Any], scene: Any, judge: Judge | None) -> None:
    """Render a scene, by the engine of a judge or without a picture.

    Blender's operator evaluates the context's scene at its end: it is given an empty one, unless an
    add-on's engine draws, which may ask the context for the user's.
    """
    engine = judge.engine or "" if judge else ENGINE
    scene.render.engine = ENGINES.get(engine, engine)
    # Blender crashes if it is to write, within the render, what an engine did not finish (5.2). And
    # an animation has no frame below 0.
    writes = judge is not None and judge.known and scene.frame_current >= 0
    scene.render.use_persistent_data = writes  # Cycles keeps the evaluation, too
    empty: Any = bpy.data.scenes.new("Reference Tracer")
    empty.frame_set(scene.frame_current, subframe=scene.frame_subframe)  # it is rendered (5.2)
    try:
        context: Any = empty if judge is None or judge.known else bpy.context.scene
        override = bpy.context.temp_override(scene=context, view_layer=context.view_layers[0])
        with values_restored(), override, _one_frame(turns, scene):
            bpy.ops.render.render(scene=scene.name, animation=writes)
    finally:
        remove(empty)
        scene.render.engine = ENGINE  # the one that has drawn lets go of what it kept
    if judge and not writes:
        try:
            result_image().save_render(f"{scene.render.filepath}.exr", scene=scene)
        except RuntimeError:
            turns.fail(SceneError(f"{judge.label} made no picture: see the console."))
    if judge and not turns.go_on():
        _render(turns, scene, judge)  # the next picture


@contextmanager
def _one_frame(turns: InTurns[Any], scene: bpy.types.Scene) -> Iterator[None]:
    """Have each animation that is rendered of a scene be of its one frame, for a while.

    It is as long as the work wants. What Blender evaluates has the scene's own range of frames: a
    simulation may ask for it.
    """
    names = "frame_start", "frame_end", "frame_step", "frame_current", "frame_subframe"
    own = {name: getattr(scene, name) for name in names}
    rendered = max(scene.frame_current, 1)  # the one before it, too, is a frame
    pictures = 0

    def begins(of: Any, *_: Any) -> None:
        if of == scene:
            restore()
            if pictures:
                turns.go_on()

    def restore() -> None:
        for name, value in own.items():
            if getattr(scene, name) != value:  # Blender takes any setting for a change
                setattr(scene, name, value)

    def is_evaluated(of: Any, depsgraph: Depsgraph) -> None:
        if of == scene:
            depsgraph.update()  # what other handlers have changed
            turns.go_on(depsgraph)

    def is_written(*_: Any) -> None:
        nonlocal pictures
        turns.hear()
        pictures += 1
        scene.frame_current = rendered - 1 if turns.wants_more else rendered

    with _told(render_pre=begins, frame_change_post=is_evaluated, render_write=is_written):
        scene.frame_start = rendered
        scene.frame_end = rendered
        scene.frame_step = 0
        try:
            yield
        finally:
            restore()


@contextmanager
def _told(**handlers: Callable[..., None]) -> Iterator[None]:
    """Tell handlers of Blender's events for a while, by the names of these.

    Whatever is changed after a picture crashes Blender in the next one (5.2): so no other is told
    that it is there.
    """
    events: Any = bpy.app.handlers
    untold = [(event, event.copy()) for event in (events.render_post, events.render_write)]
    for event, _ in untold:
        event.clear()
    for name, handler in handlers.items():
        getattr(events, name).append(handler)
    try:
        yield
    finally:
        for name, handler in handlers.items():
            getattr(events, name).remove(handler)
        for event, others in untold:
            event.extend(others)


def export_for_render(scene: bpy.types.Scene, judge: Judge | None = None) -> tuple[Scene, Manifest]:
    """Return the *render* evaluation of a temporary scene, or what a judge's picture shows.

    Its engine is then this one: such an evaluation exists only while an engine renders.

    Raises
    ------
    SceneError
        If the scene cannot be traced.
    """
    return evaluated(scene, judge if judge and judge.needs_window else None, once(export))
