"""A user's hands: the pointer, its button, and a button of Blender's that is looked for."""

import ctypes
import subprocess

import bpy
from story import window


def xdotool(*words):
    subprocess.run(["xdotool", *map(str, words)], check=True)


def on_screen(region, x, y):
    """Return where a place of a region is on the screen, whose y goes down."""
    return region.x + int(x), window().height - 1 - region.y - int(y)


def click(region, x, y):
    """Click with the left button at a place of a region, as a hand does."""
    for action in (("mousemove", *on_screen(region, x, y)), ("mousedown", 1), ("mouseup", 1)):
        xdotool(*action)
        yield


WHEEL = 24  # its clicks from the end of a panel to its top
_last = {}  # how high in its region each command's button was found last: it is looked for there


def found(area, command, across=0.6, step=16):
    """Go down an editor, scrolled if need be, until the pointer is on a command's button.

    So far across it, as a share of its width. Returns where that is.

    Raises
    ------
    LookupError
        If there is none.
    """
    region = next(r for r in area.regions if r.type == "WINDOW")
    x = across * region.width

    def is_under_the_pointer(y):
        xdotool("mousemove", *on_screen(region, x, y))
        yield
        with bpy.context.temp_override(window=window(), area=area, region=region):
            if bpy.ops.ui.copy_python_command_button.poll():  # what Ctrl+C does on a button
                bpy.ops.ui.copy_python_command_button()
                return command in bpy.context.window_manager.clipboard
        return False

    xdotool("mousemove", 0, 0)  # what was under the pointer is it no more
    yield 0.3
    if command in _last and (yield from is_under_the_pointer(_last[command])):
        return region, x, _last[command]
    xdotool("mousemove", *on_screen(region, x, step), "click", "--repeat", WHEEL, 4)  # to the top
    for _ in range(4):
        yield
        for y in range(region.height - step, 0, -step):
            if (yield from is_under_the_pointer(y)):
                _last[command] = y
                return region, x, y
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
