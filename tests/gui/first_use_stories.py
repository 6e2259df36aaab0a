"""What comes in between in a first use: each event comes as from a user's hand."""

import bpy
from hands import click, click_on
from interruption_stories import still_running
from story import (
    compared,
    ended,
    noted,
    press,
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
    press("Escape")
    yield from until(ended, 60)
    yield
    noted["changed"] = {k: v for k, v in settings().items() if before[k] != v}
    noted["left"] = [*still_running(), *images()]
    noted["compared"] = compared()


SCENE = "exercise_perspective"
STORIES = (second_press,)
