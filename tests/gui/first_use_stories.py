"""What comes in between in a first use: each event comes as from a user's hand."""

import time

import bpy
from hands import click, click_on
from interruption_stories import still_running
from story import (
    MODULE,
    compared,
    ended,
    module,
    noted,
    press,
    result,
    running,
    screenshot,
    settings,
    show_panel,
    until,
    window,
)

COMPARE = "reference_tracer.compare("
LARGE = 400  # percent: it takes long enough to be interrupted


def properties():
    return next(a for a in window().screen.areas if a.type == "PROPERTIES")


def images():
    return [i.name for i in bpy.data.images if i.name.startswith("Reference Tracer")]


def at_the_panel(percentage=50):
    window().scene.render.engine = "REFERENCE_TRACER"  # its tab is short: our panel is in sight
    window().scene.render.resolution_percentage = percentage
    show_panel()
    yield


def second_press():
    """Press it again while it runs, then Esc: one ran, and nothing is left of it."""
    yield from at_the_panel(LARGE)
    before = settings()
    where = yield from click_on(properties(), COMPARE)
    noted["first"] = running()
    yield from click(*where)
    noted["second"] = running()
    screenshot("first_use_running")
    pressed = time.monotonic()
    press("Escape")
    yield from until(ended, 60)
    noted["seconds_to_stop"] = time.monotonic() - pressed
    yield
    noted["changed"] = {k: v for k, v in settings().items() if before[k] != v}
    noted["left"] = [*still_running(), *images()]
    noted["compared"] = compared()


def new_file():
    """Ctrl+N and *General* while it runs."""
    yield from at_the_panel(LARGE)
    yield from click_on(properties(), COMPARE)
    noted["ran"] = running() != []
    for key in ("ctrl+n", "g"):
        press(key)
        yield
    screenshot("first_use_new_file")
    noted["file"] = bpy.data.filepath
    noted["left"] = [*still_running(), *images()]


def unticked():
    """The add-on's tick in the Preferences is taken away while it runs, and set again."""
    yield from at_the_panel(LARGE)
    window_manager = bpy.context.window_manager
    bpy.context.preferences.active_section = "ADDONS"
    window_manager.addon_search = "Reference Tracer"
    area = next(a for a in window().screen.areas if a.type == "VIEW_3D")
    area.type = "PREFERENCES"
    yield
    yield from click_on(properties(), COMPARE)
    noted["ran"] = running() != []
    yield from click_on(area, "preferences.addon_disable(", across=0.046)
    noted["disabled"] = not enabled()
    screenshot("first_use_unticked")
    yield from click_on(area, "preferences.addon_enable(", across=0.046)
    yield from until(enabled, 30)
    area.type = "VIEW_3D"
    yield from at_the_panel()
    noted["left"] = [*still_running(), *images()]
    module("blender.ui.results").forget()
    yield from click_on(properties(), COMPARE)
    yield from until(compared)
    noted["verdict"] = result().content.verdict


def enabled():
    return MODULE in bpy.context.preferences.addons


SCENE = "exercise_perspective"
STORIES = (second_press, new_file, unticked)
