"""What a user does with the two studies, played in its window: see `play.py`."""

from pathlib import Path
from urllib.parse import urlparse
from urllib.request import url2pathname

import bpy
from hands import click, command_under, found
from story import (
    data_blocks,
    ended,
    invoke,
    module,
    noted,
    open_tab,
    press,
    render_result,
    result,
    running,
    scaled,
    screenshot,
    settings,
    until,
    window,
)

TRADE, EXTREMES = "TRADE", "EXTREMES"
SMALL = {"width": 24, "samples": 2}


def note_changes(before):
    after = settings(), data_blocks(), render_result()
    noted["changed"] = {k: (before[0][k], v) for k, v in after[0].items() if before[0][k] != v}
    noted["new"] = {
        k: sorted(set(v) - set(before[1][k])) for k, v in after[1].items() if v != before[1][k]
    }
    noted["render_result_kept"] = before[2] == after[2]


COMPARE = "reference_tracer.compare("
# Pixels from the lower end of *Trace and Compare* down to the header of a folded panel, where
# nothing is compared yet; and from there to the panel's button.
FOLDED, BUTTON = {"trade": 151, "extremes": 177}, 27


def show_study(name):
    """Unfold a panel of our tab by its header, and look at it."""
    yield from open_tab()
    area = next(a for a in window().screen.areas if a.type == "VIEW_3D")
    region, x, y = yield from found(area, COMPARE, kind="UI")
    while COMPARE in (yield from command_under(area, region, x, y)):
        y -= scaled(4)
    y -= scaled(FOLDED[name])
    yield from click(region, x, y)
    noted["button"] = yield from command_under(area, region, x, y - scaled(BUTTON))
    screenshot(name)


def images():
    return [i.name for i in bpy.data.images if i.name.startswith("Reference Tracer")]


def study(name, kind, **options):
    """Press a button, look at it run, and at what it shows."""
    yield
    bpy.ops.render.render()  # the user's own last render must survive
    before = settings(), data_blocks(), render_result()
    noted["pressed"] = list(invoke(name, **options))
    yield
    noted["running"] = running()
    noted["others"] = [
        operator.poll()
        for operator in (bpy.ops.reference_tracer.compare, bpy.ops.reference_tracer.trade)
    ]
    screenshot(f"{name}_running")

    def measured():
        return result(kind)

    yield from until(measured, 900)
    yield
    note_changes(before)
    noted["lines"] = list(result(kind).lines)
    page = Path(url2pathname(urlparse(result(kind).page).path))  # what the panel's button opens
    held = page.read_text(encoding="utf-8").partition('"plots":')[2]
    noted["plots"] = held.count('"title":') and 1  # its own script draws them
    noted["in_add_on"] = Path(module("blender.ui.results").__file__).parents[2] in page.parents
    yield from show_study(name)


def trade():
    """The sentence is in the panel, the plot behind its button."""
    yield from study("trade", TRADE, **SMALL)
    noted["rows"] = len(result(TRADE).content.whole)
    noted["advice"] = result(TRADE).content.advice


def extremes():
    """Every sixth scenario, with few rays."""
    measure = module("study.extremes").measure
    scenarios, *others = whole = measure.__defaults__
    measure.__defaults__ = (scenarios[::6], *others)
    try:
        yield from study("extremes", EXTREMES, rays=6)
    finally:
        measure.__defaults__ = whole
    points = module("study.extremes").breaking_points(result(EXTREMES).content)
    noted["points"] = [[p.scenario, p.method, p.precision, p.never] for p in points]


def escape(name, kind, **options):
    """Esc midway: stopped, and everything as before."""
    yield
    before = settings(), data_blocks(), render_result()
    invoke(name, **options)
    yield 0.5
    noted["running"] = running()
    press("Escape")
    yield from until(ended)
    note_changes(before)
    noted["found"] = result(kind) is not None
    noted["can_begin"] = bpy.ops.reference_tracer.trade.poll()


def trade_escape():
    yield from escape("trade", TRADE)


def extremes_escape():
    yield from escape("extremes", EXTREMES)


SCENE = "exercise_triangle"
STORIES = (trade, extremes, trade_escape, extremes_escape)
