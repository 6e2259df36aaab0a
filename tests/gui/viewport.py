"""The 3D view that the viewport's stories turn, and what it shows on the screen."""

import gc
import weakref

import bpy
import numpy as np
from story import OUT, module, screenshot, until, window


def prepared():
    """Our engine, flat light, nothing over the picture, and a small view: less is to be drawn."""
    all_noted()
    window().scene.render.engine = "REFERENCE_TRACER"
    for shading in (window().scene.display.shading, space().shading):
        shading.light, shading.color_type = "FLAT", "MATERIAL"
        shading.show_object_outline = shading.show_cavity = False
    space().shading.background_type = "THEME"  # 5.2 draws the world's in its solid shading alone
    space().overlay.show_overlays = space().show_gizmo = False
    for name in ("header", "tool_header", "toolbar", "ui", "hud"):
        setattr(space(), f"show_region_{name}", False)
    with bpy.context.temp_override(window=window(), area=area(), region=region()):
        bpy.ops.screen.area_split(direction="VERTICAL", factor=0.5)
    yield 0.05
    both = [a for a in window().screen.areas if a.type == "VIEW_3D"]
    max(both, key=lambda a: a.width).type = "TEXT_EDITOR"
    yield 0.05


def area():
    return next(a for a in window().screen.areas if a.type == "VIEW_3D")


def space():
    return area().spaces.active


def region():
    return next(r for r in area().regions if r.type == "WINDOW")


def region_3d():
    return space().region_3d


def live():
    """The views in Rendered mode that there are."""
    return list(module("blender.live.view").LiveView.all)


def all_noted():
    """Have each such view note itself, from now on: to look for them all the time takes long."""
    kind = module("blender.live.view").LiveView
    if not hasattr(kind, "all"):
        kind.all, begin = weakref.WeakSet(), kind.__init__

        def noting(self):
            kind.all.add(self)
            begin(self)

        kind.__init__ = noting


def alive(kind):
    """How many objects of a class of ours there are."""
    path, name = kind.split(".")
    kind = getattr(module(f"blender.live.{path}"), name)
    return sum(type(o) is kind for o in gc.get_objects())


def rests():
    views = live()
    return views and all(v.rests for v in views)


def in_mode(name):
    """Choose a mode of the view, wait for its picture, and return that, as the screen has it."""
    space().shading.type = name
    area().tag_redraw()
    yield 0.1
    if name == "RENDERED":
        yield from settled()
    return screen(f"viewport_{name.lower()}")


def settled():
    yield 0.05
    yield from until(rests, 60)
    yield 0.05


def screen(name):
    """The view on the screen, (h, w, 3) from 0 to 255, row 0 at the bottom; a file keeps it."""
    r = region()
    screenshot(name, (r.x, window().height - r.y - r.height, r.width, r.height))
    image = bpy.data.images.load(str(OUT / f"{name}.png"))
    image.colorspace_settings.name = "Non-Color"
    pixels = np.empty(r.width * r.height * 4, np.float32)
    image.pixels.foreach_get(pixels)
    bpy.data.images.remove(image)
    return np.rint(255 * pixels.reshape(r.height, r.width, 4)[..., :3]).astype(int)


def apart(camera):
    """How far known points are, at most, from where Blender's own matrices have them, in pixels."""
    certificate, view = module("pictures.certificate"), region_3d()
    points = certificate.known_points(camera)
    matrix = np.array(view.window_matrix, float) @ np.array(view.view_matrix, float)
    at = matrix @ np.vstack((points, np.ones(points.shape[1])))
    film = (at[:2] / at[3] + 1) / 2 * np.array([[camera.width], [camera.height]])
    return certificate.certify(camera, points, film).largest


def beside(seen, solid, region):
    """How many pixels of a region differ, and how many are not even as one beside them is."""
    inside = np.zeros(seen.shape[:2], bool)
    inside[region.y0 : region.y1, region.x0 : region.x1] = True
    y, x = np.nonzero(inside & (np.abs(seen - solid) > 1).any(axis=-1))
    own = np.pad(seen, ((1, 1), (1, 1), (0, 0)), "edge")
    steps = [own[y + j, x + i] for j, i in np.ndindex(3, 3)]
    nearest = np.abs(np.array(steps) - solid[y, x]).max(axis=-1).min(axis=0)
    shades = seen @ (1 << 16, 1 << 8, 1)
    # Of the background there are two shades, one by passepartout, each dithered.
    _, counts = np.unique((seen[~inside] // 8) @ (1 << 10, 1 << 5, 1), return_counts=True)
    return {
        "colors": len(np.unique(shades[inside])),
        "differ": len(y),
        "strange": int((nearest > 1).sum()),
        "outside": float(np.sort(counts)[-4:].sum() / max(1, counts.sum())),
    }
