"""What a user does with the pixel inspector, played in its window: see `play.py`."""

import bpy
from hands import click
from story import (
    compared,
    data_blocks,
    invoke,
    module,
    noted,
    open_tab,
    press,
    press_compare,
    result,
    running,
    scaled,
    screenshot,
    settings,
    until,
    window,
)

BUTTON = 44  # pixels from the top of the image editor's sidebar to the middle of our button
HALF = 50  # percent: so that a pixel of the picture is about as large as one of the screen
DERIVATION = "PIXEL"


def area_of(kind):
    """The largest area, made an editor of a kind."""
    area = max(window().screen.areas, key=lambda a: a.width * a.height)
    area.type = kind
    area.spaces.active.show_region_ui = True
    return area


def region_of(area):
    return next(r for r in area.regions if r.type == "WINDOW")


def zoom(area, ratio):
    """Show an image's pixels so large, the image in the middle."""
    with bpy.context.temp_override(window=window(), area=area, region=region_of(area)):
        bpy.ops.image.view_zoom_ratio(ratio=ratio)


def pixel():
    found = result(DERIVATION)
    if found is None:
        return None
    p = found.content.pixel
    seen = found.content.seen
    return [p.x, p.y, seen and seen.object, found.content.certified.t]


def look_through_camera(area):
    space = area.spaces.active
    space.region_3d.view_perspective = "CAMERA"
    space.region_3d.view_camera_zoom = 0
    space.region_3d.view_camera_offset = (0, 0)


def place_in_view(area, x, y):
    """Where the centre of a pixel is in the camera's view, by Blender's own projection."""
    from bpy_extras.view3d_utils import location_3d_to_region_2d

    scene = window().scene
    derived = module("derivation.pixel")
    with bpy.context.temp_override(window=window()):
        camera = module("blender.jobs.open_file").export_open_file(bpy.context)[0].camera
    looking = derived.Pixel(camera, x, y, (), None)
    point = looking.origin + 5 * looking.direction
    assert scene.camera
    region = region_of(area)
    return location_3d_to_region_2d(region, region.data, point)


def in_images():
    """In the traced image, the difference, a render: each click is its pixel; Esc ends it."""
    window().scene.render.resolution_percentage = HALF
    press_compare()
    yield from until(compared)
    comparison = result().content
    noted["frame"] = {}
    area = area_of("IMAGE_EDITOR")
    yield
    yield from open_tab(area)
    before = settings()
    sidebar = next(r for r in area.regions if r.type == "UI")
    yield from click(sidebar, 0.4 * sidebar.width, sidebar.height - scaled(BUTTON))
    noted["running"] = running()
    region = region_of(area)
    for name, x, y in (("Traced", 235, 150), ("Difference", 200, 95), ("Blender", 300, 100)):
        area.spaces.active.image = bpy.data.images[f"Reference Tracer {name}"]
        zoom(area, 2)
        yield
        u, v = region.view2d.view_to_region((x + 0.5) / 480, (y + 0.5) / 270, clip=False)
        yield from click(region, u, v)
        noted[name] = {"clicked": [x, y], "pixel": pixel()}
        frame = comparison.frame
        noted["frame"][name] = float(frame.t[y, x])
        screenshot(f"inspect_{name.lower()}")
    zoom(area, 0.5)
    yield
    u, v = region.view2d.view_to_region(-0.02, 0.5, clip=False)
    yield from click(region, u, v)
    noted["outside"] = pixel()
    bpy.data.images.new("Other", 64, 64)
    area.spaces.active.image = bpy.data.images["Other"]
    yield
    u, v = region.view2d.view_to_region(0.5, 0.5, clip=False)
    yield from click(region, u, v)
    noted["other"] = pixel()
    screenshot("inspect_refused")
    press("Escape")
    yield
    noted["after_escape"] = running()
    noted["changed"] = {k: v for k, v in settings().items() if before[k] != v}
    noted["texts"] = [t.name for t in bpy.data.texts]
    noted["text_begins"] = bpy.data.texts[0].as_string().splitlines()[0]


def in_view():
    """In the camera's view, with the ray drawn."""
    window().scene.render.resolution_percentage = HALF
    area = area_of("VIEW_3D")
    look_through_camera(area)
    yield
    yield from open_tab(area)
    bpy.context.window_manager.reference_tracer.draw_ray = True
    clean = data_blocks()
    selected = [o.name for o in window().view_layer.objects if o.select_get()]
    noted["started"] = list(invoke("inspect"))
    region = region_of(area)
    noted["clicks"] = []
    for x, y in ((240, 150), (298, 45)):
        yield from click(region, *place_in_view(area, x, y))
        noted["clicks"].append([[x, y], pixel()])
    screenshot("inspect_view")
    now = data_blocks()
    noted["drawn"] = sorted(set(now["objects"]) - set(clean["objects"]))
    noted["selection_kept"] = selected == [
        o.name for o in window().view_layer.objects if o.select_get()
    ]
    view = area.spaces.active.region_3d
    view.view_perspective = "PERSP"
    yield
    last = pixel()
    yield from click(region, region.width / 3, region.height / 2)
    noted["not_through_the_camera"] = pixel() == last
    screenshot("inspect_not_the_camera")
    press("Escape")
    yield
    noted["after_escape"] = running()


def other_file():
    """Another file ends it, and it can be begun again."""
    area_of("VIEW_3D")
    yield
    invoke("inspect")
    noted["running"] = running()
    bpy.ops.wm.open_mainfile(filepath="/project/sample_scenes/exercise_triangle.blend")
    yield
    noted["left"] = running()
    noted["again"] = list(invoke("inspect"))
    press("Escape")
    yield
    noted["ended"] = running()


SCENE = "suzanne"
STORIES = (in_images, in_view, other_file)
