"""The button that opens the page, pressed inside Blender's window: see `play.py`."""

from pathlib import Path

import bpy
from story import (
    OUT,
    compared,
    data_blocks,
    invoke,
    noted,
    open_tab,
    opened,
    press_compare,
    screenshot,
    settings,
    show_panel,
    until,
    with_browser,
)


def page():
    """Compare, then the button: a file that the browser is told to open, and nothing else."""
    with_browser()
    show_panel()
    yield
    yield from open_tab()
    noted["before"] = bpy.ops.reference_tracer.open_page.poll()
    press_compare()
    yield from until(compared)
    yield
    screenshot("page_button")
    before = settings(), data_blocks()
    noted["pressed"] = list(invoke("open_page"))

    yield from until(opened)
    noted["address"] = opened()
    path = Path(noted["address"].removeprefix("file://"))
    (OUT / "page.html").write_bytes(path.read_bytes())
    noted["unchanged"] = before == (settings(), data_blocks())


SCENE = "suzanne"
STORIES = (page,)
