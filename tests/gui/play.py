"""Play stories in Blender's window: `blender --python play.py -- NAME...`, then quit.

A story is a generator. It yields how many seconds to wait, while Blender draws and handles events;
or nothing, to wait until all that was done has been handled and drawn. What it notes is written to
out/gui/NAME.json when it ends. All stories share one Blender, and each begins with its sample scene
opened anew, as if Blender had been started with it.
"""

import json
import os
import sys
import time
import traceback
from pathlib import Path

import bpy

sys.path.insert(0, str(Path(__file__).parent))  # Blender doesn't put it there
sys.path.append(str(Path(__file__).parents[1]))  # for what other tests have, too

import diagnosis_stories
import given_stories
import hard_stories
import inspector_stories
import installation_stories
import interruption_stories
import lesson_stories
import picture_stories
import render_stories
import seen_stories
import select_stories
import session_stories
import stories
import viewport_stories
import work_stories
from story import OUT, by_rounds, noted, resized, screenshot, window

STORIES = {
    story.__name__: (module.SCENE, story)
    for module in (
        stories,
        diagnosis_stories,
        given_stories,
        hard_stories,
        inspector_stories,
        installation_stories,
        interruption_stories,
        lesson_stories,
        picture_stories,
        render_stories,
        seen_stories,
        select_stories,
        session_stories,
        viewport_stories,
        work_stories,
    )
    for story in module.STORIES
}


BROKEN = 3  # how Blender ends where this script is, as conftest.py asks for
# Of the window, in pixels, and the scale of all in it: most of the time goes into drawing it, in
# software. What is half as large is laid out alike.
LARGE = 1600, 900, 1.0
SMALL_LARGE = 800, 450, 0.5
SMALL = 640, 360, 0.5
SIZES = {  # of other stories
    "panel": LARGE,
    "second_day": LARGE,
    "tried": (1280, 720, 1.0),
    **dict.fromkeys(("first_result", "heavy", "selected"), (1000, 600, 1.0)),
    **dict.fromkeys(("compared_images", "in_images"), SMALL_LARGE),
    **dict.fromkeys(
        (story.__name__ for story in lesson_stories.STORIES),
        LARGE if lesson_stories.RECORDED else SMALL_LARGE,
    ),
}


def played(names):
    """Play one story after another, each until its end or its first error."""
    for name in names:
        began, cpu = time.monotonic(), time.process_time()
        noted.clear()
        try:
            scene, story = STORIES[name]
            yield from opened(scene)
            *size, bpy.context.preferences.view.ui_scale = SIZES.get(name, SMALL)
            bpy.context.preferences.is_dirty = False
            yield from resized(*size)
            yield from story()
        except Exception:
            noted["error"] = traceback.format_exc()
            screenshot(f"{name}_error")
        took, cpu = time.monotonic() - began, time.process_time() - cpu
        print(f"story {name}: {took:.1f} s, {cpu:.1f} s of CPU", flush=True)
        (OUT / f"{name}.json").write_text(json.dumps(noted, indent=1))


def prepared():
    """Have little drawn: no graphics card helps here, and most of the time went into 3D views."""
    preferences = bpy.context.preferences
    preferences.system.viewport_aa = "OFF"
    preferences.view.render_display_type = "NONE"  # a story that wants to see results says where
    preferences.is_dirty = False


@bpy.app.handlers.persistent
def without_overlays(*_):
    """Have nothing drawn over the 3D views of a file that was opened: it costs as much as they."""
    for area in (a for w in bpy.context.window_manager.windows for a in w.screen.areas):
        if area.type == "VIEW_3D":
            area.spaces.active.overlay.show_overlays = False


def opened(scene):
    """Open a sample scene with the window that it was saved with, and nothing of the last story."""
    prepared()
    bpy.context.window_manager.property_unset("reference_tracer")
    bpy.ops.wm.open_mainfile(filepath=f"/project/sample_scenes/{scene}.blend")
    yield
    assert len(bpy.context.window_manager.windows) == 1
    assert not window().modal_operators


bpy.app.handlers.load_post.append(without_overlays)


def all_played():
    """Play what is named, and end Blender."""
    yield from by_rounds(played(sys.argv[sys.argv.index("--") + 1 :]))
    bpy.ops.wm.quit_blender()


going = all_played()


def go():
    """Go on with the story, and say when to come again; what no story catches ends Blender."""
    try:
        return next(going, None)
    except Exception:
        traceback.print_exc()
        os._exit(BROKEN)


bpy.app.timers.register(go, first_interval=2, persistent=True)
