"""A user's hands: the pointer, its button, and a button of Blender's that is looked for."""

import ctypes
import subprocess

import bpy
from story import scaled, window


def xdotool(*words):
    subprocess.run(["xdotool", *map(str, words)], check=True)


def on_screen(region, x, y):
    """Return where a place of a region is on the screen, whose y goes down."""
    return region.x + int(x), window().height - 1 - region.y - int(y)


def click(region, x, y):
    """Click with the left button at a place of a region, as a hand does."""
    last[click] = region, y
    for action in (("mousemove", *on_screen(region, x, y)), ("mousedown", 1), ("mouseup", 1)):
        xdotool(*action)
        yield


def command_under(area, region, x, y):
    """Move the pointer to a place; return the command of the button there, or ""."""
    xdotool("mousemove", *on_screen(region, x, y))
    yield
    with bpy.context.temp_override(window=window(), area=area, region=region):
        if not bpy.ops.ui.copy_python_command_button.poll():  # what Ctrl+C does on a button
            return ""
        bpy.ops.ui.copy_python_command_button()
    return bpy.context.window_manager.clipboard


def properties():
    """Return the Properties editor, in which our panel is."""
    return next(a for a in window().screen.areas if a.type == "PROPERTIES")


COMPARE = "reference_tracer.compare("
STEP = 16  # less than a button is high, at a scale of 1


def along(area, command):
    """Go along an editor's header until the pointer is on a command's button; return where."""
    region, step = next(r for r in area.regions if r.type == "HEADER"), scaled(STEP)
    for x in range(step, region.width, step):
        if command in (yield from command_under(area, region, x, region.height // 2)):
            return region, x, region.height // 2
    raise LookupError(f"there is no button {command}")


WHEEL = 24  # its clicks from the end of a panel to its top
last = {}  # how high in its region each command's button was found last, and what was clicked on


def found(area, command, across=0.6, kind="WINDOW"):
    """Look for a command's button in an editor, scrolled if need be, with the pointer.

    So far across a region of it, as a share of its width. Returns where that is. A button that was
    not found before is first looked for near the last click.

    Raises
    ------
    LookupError
        If there is none.
    """
    region = next(r for r in area.regions if r.type == kind)
    x, step = across * region.width, scaled(STEP)
    downwards = range(region.height - step, step, -step)  # the edges are to be dragged

    def among(heights):
        for y in heights:
            if command in (yield from command_under(area, region, x, y)):
                last[command] = y
                return region, x, y

    xdotool("mousemove", 0, 0)  # what was under the pointer is it no more
    yield 0.3
    if command in last:
        near = [last[command]]
    elif last.get(click, (None,))[0] == region:
        near = sorted(downwards, key=lambda y: abs(y - last[click][1]))
    else:
        near = []
    if there := (yield from among(near)):
        return there
    # To the top, where a sidebar has something: else the wheel is for what is below it.
    top = on_screen(region, x, region.height - step)
    xdotool("mousemove", *top, "click", "--repeat", WHEEL, 4)
    for _ in range(4):
        yield
        if there := (yield from among(downwards)):
            return there
        xdotool("click", "--repeat", 8, 5)  # the wheel
    raise LookupError(f"there is no button {command}")


def click_on(area, command, **options):
    """Find a button by the command that it is for, and click on it; return where it is."""
    where = yield from found(area, command, **options)
    yield from click(*where)
    return where


def windows():
    """Return the numbers that the screen gives to Blender's windows, the first one first."""
    command = ["xdotool", "search", "--onlyvisible", "--class", "Blender"]
    return sorted(map(int, subprocess.run(command, capture_output=True, text=True).stdout.split()))


def close(number):
    """Have a window hear what it hears if a hand clicks on the cross in its frame.

    The screen of the tests has no window manager, which draws frames: this is its event.
    """
    x = ctypes.CDLL("libX11.so.6")
    x.XOpenDisplay.restype = ctypes.c_void_p
    x.XInternAtom.restype = ctypes.c_long
    screen = ctypes.c_void_p(x.XOpenDisplay(None))
    protocols, delete = (
        x.XInternAtom(screen, name, 0) for name in (b"WM_PROTOCOLS", b"WM_DELETE_WINDOW")
    )
    message, size = 33, 32  # a ClientMessage, of numbers of so many bits
    event = (ctypes.c_long * 24)(message, 0, 0, 0, number, protocols, size, delete)
    x.XSendEvent(screen, ctypes.c_ulong(number), 0, ctypes.c_long(0), event)
    x.XCloseDisplay(screen)
