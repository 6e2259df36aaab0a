"""What a user does with F12 and the engine, played in Blender's window: see `play.py`."""

import bpy
from story import noted, press, render_result, reports, screenshot, until, window


def f12():
    """F12 with the engine: the picture is there, and it is the tracer's."""
    window().scene.render.engine = "REFERENCE_TRACER"
    bpy.context.preferences.view.render_display_type = "AREA"
    done = []
    bpy.app.handlers.render_complete.append(lambda *a: done.append(True))
    yield
    press("F12")

    def rendered():
        return done

    yield from until(rendered)
    yield
    screenshot("f12")
    noted["result"] = render_result()
    noted["areas"] = [a.type for w in bpy.context.window_manager.windows for a in w.screen.areas]
    bpy.context.preferences.view.render_display_type = "NONE"  # as `play.py` sets it


def f12_escape():
    """Esc while a long render runs: it stops, and keeps the rows that are done."""
    scene = window().scene
    scene.render.engine = "REFERENCE_TRACER"
    scene.reference_tracer.samples = 16
    scene.render.use_lock_interface = False
    cancelled = []
    bpy.app.handlers.render_cancel.append(lambda *a: cancelled.append(True))
    yield
    press("F12")
    yield from until(rendering)
    yield 2
    screenshot("f12_running")
    press("Escape")
    yield from until(lambda: cancelled)
    noted["cancelled"] = cancelled
    yield
    screenshot("f12_cancelled")
    noted["result"] = render_result()


def rendering():
    return bpy.app.is_job_running("RENDER")


def f12_error():
    """F12 on a scene that cannot be traced: the window says why."""
    window().scene.render.engine = "REFERENCE_TRACER"
    window().scene.camera.data.type = "PANO"
    yield
    earlier = reports()
    press("F12")
    yield
    yield from until(lambda: not rendering())
    yield
    screenshot("f12_error")
    noted["reports"] = reports().removeprefix(earlier)


SCENE = "suzanne"
STORIES = (f12, f12_escape, f12_error)
