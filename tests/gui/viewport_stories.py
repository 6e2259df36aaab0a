"""The 3D view in Rendered mode, in the real window: what it shows, and what may happen to it."""

import gc
import subprocess

import bpy
import numpy as np
from mathutils import Euler
from story import OUT, module, noted, until, window

SWITCHES, MOVES = 20, 100  # every day; ten times as many in the long tests
TURNED = Euler((1.1, 0.1, 0.7)).to_quaternion()


def viewport_pixels():
    """Views of all kinds beside Blender's own solid drawing of them."""
    prepared()
    for view in (frame, zoomed_border, parallel_camera, free, free_border, parallel):
        view()
        seen = yield from in_mode("RENDERED")
        camera = live()[0].camera
        found = certified(camera) | {"projection": camera.projection.name}
        solid = yield from in_mode("SOLID")
        noted[view.__name__] = found | beside(seen, solid, camera.region)


def frame():
    """Look through the camera, as the file has it."""
    assert region_3d().view_perspective == "CAMERA"


def zoomed_border():
    """Look through the camera from nearer, beside its middle, with a border and passepartout."""
    render, view, overlay = window().scene.render, region_3d(), space().overlay
    render.use_border = True
    render.border_min_x, render.border_max_x = 0.3, 0.9
    render.border_min_y, render.border_max_y = 0.2, 0.7
    view.view_camera_zoom, view.view_camera_offset = 12, (0.1, -0.05)
    overlay.show_overlays, overlay.show_text, overlay.show_floor = True, False, False
    for name in ("cursor", "axis_x", "axis_y", "extras", "relationship_lines", "outline_selected"):
        setattr(overlay, f"show_{name}", False)
    window().scene.camera.data.passepartout_alpha = 0.5


def parallel_camera():
    """Look through an orthographic camera with a shift, at pixels that are not square."""
    render, data = window().scene.render, window().scene.camera.data
    render.use_border = space().overlay.show_overlays = False
    data.type, data.ortho_scale, data.shift_x = "ORTHO", 9, 0.1
    render.pixel_aspect_y = 1.5


def free():
    """Look from somewhere else."""
    view = region_3d()
    view.view_perspective, view.view_rotation, view.view_distance = "PERSP", TURNED, 9


def free_border():
    """See a part of it."""
    space().use_render_border = True
    space().render_border_min_x, space().render_border_max_y = 0.4, 0.6


def parallel():
    """Look from there, orthographic."""
    space().use_render_border = False
    region_3d().view_perspective = "ORTHO"


def prepared():
    """Our engine, flat light, and nothing over the picture."""
    window().scene.render.engine = "REFERENCE_TRACER"
    for shading in (window().scene.display.shading, space().shading):
        shading.light, shading.color_type = "FLAT", "MATERIAL"
        shading.show_object_outline = shading.show_cavity = False
    bpy.context.preferences.system.viewport_aa = "OFF"
    space().overlay.show_overlays = space().show_gizmo = False
    for name in ("header", "tool_header", "toolbar", "ui", "hud", "asset_shelf"):
        setattr(space(), f"show_region_{name}", False)


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
    kind = module("blender.live.view").LiveView
    return [o for o in gc.get_objects() if type(o) is kind]


def rests():
    views = live()
    return views and all(v.rests for v in views)


def in_mode(name):
    """Choose a mode of the view, wait for its picture, and return that, as the screen has it."""
    space().shading.type = name
    area().tag_redraw()
    yield 0.3
    if name == "RENDERED":
        yield from settled()
    return screen(f"viewport_{name.lower()}")


def settled():
    yield 0.1
    yield from until(rests, 60)
    yield 0.2


def screen(name):
    """The view on the screen, (h, w, 3) from 0 to 255, row 0 at the bottom; a file keeps it."""
    path = str(OUT / f"{name}.png")
    subprocess.run(["import", "-window", "root", path], check=True)
    image = bpy.data.images.load(path)
    image.colorspace_settings.name = "Non-Color"
    (width, height), r = image.size, region()
    pixels = np.empty(width * height * 4, np.float32)
    image.pixels.foreach_get(pixels)
    bpy.data.images.remove(image)
    whole = np.rint(255 * pixels.reshape(height, width, 4)[..., :3]).astype(int)
    return whole[r.y : r.y + r.height, r.x : r.x + r.width]


def certified(camera):
    """How far known points are from where Blender's matrices have them, and its own product."""
    certificate, view = module("compare.certificate"), region_3d()
    points = certificate.known_points(camera)
    exact = np.array(view.window_matrix, float) @ np.array(view.view_matrix, float)
    found = []
    for matrix in (exact, np.array(view.perspective_matrix, float)):
        at = matrix @ np.vstack((points, np.ones(points.shape[1])))
        film = (at[:2] / at[3] + 1) / 2 * np.array([[camera.width], [camera.height]])
        found.append(certificate.certify(camera, points, film))
    return {"apart": found[0].largest, "certified": found[1].passed}


def beside(seen, solid, region):
    """How many pixels of a region differ, and how many are not even as one beside them is."""
    inside = np.zeros(seen.shape[:2], bool)
    inside[region.y0 : region.y1, region.x0 : region.x1] = True
    differ = (np.abs(seen - solid) > 1).any(axis=-1)
    nearest = np.full(differ.shape, 255)
    for shift in np.ndindex(3, 3):
        moved = np.roll(seen, np.subtract(shift, 1), axis=(0, 1))
        nearest = np.minimum(nearest, np.abs(moved - solid).max(axis=-1))
    return {
        "size": seen.shape[:2],
        "colors": len(np.unique(seen[inside], axis=0)),
        "differ": int((differ & inside).sum()),
        "strange": int((differ & inside & (nearest > 1)).sum()),
        "outside": len(np.unique(seen[~inside], axis=0)),
    }


SCENE = "suzanne"
STORIES = (viewport_pixels,)
