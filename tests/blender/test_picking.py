"""The pixel under the mouse in the camera's view, as Blender's own matrices place it there."""

from __future__ import annotations

from types import SimpleNamespace

import bpy
import numpy as np
import pytest
from reference_tracer.blender.reading.camera import resolution
from reference_tracer.blender.ui import blocks
from reference_tracer.blender.ui.picking import pick
from reference_tracer.blender.versions import lens
from reference_tracer.scene import SceneError

REGION = {"width": 300, "height": 200, "x": 40, "y": 30}
ZOOM = np.array((0.62, 0.71))  # the frame's size in the view, from -1 to 1
OFFSET = np.array((0.11, -0.07))  # its middle


@pytest.fixture
def click(build):
    """Give a function: what a click finds on a point of the picture, its size being 1 x 1."""
    scene = build.scene(48, 27)
    camera = build.corner_camera()

    def click(u, v):
        bpy.context.view_layer.update()
        depsgraph = bpy.context.evaluated_depsgraph_get()
        width, height = resolution(scene.render)
        matrix = np.array(camera.calc_matrix_camera(depsgraph, x=width, y=height))
        matrix[:2] = ZOOM[:, None] * matrix[:2] + OFFSET[:, None] * matrix[3]
        view = SimpleNamespace(
            view_perspective="CAMERA",
            window_matrix=matrix,
            view_matrix=camera.matrix_world.normalized().inverted(),
        )
        region = SimpleNamespace(type="WINDOW", data=view, **REGION)
        space = SimpleNamespace(use_local_camera=False)
        area = SimpleNamespace(
            type="VIEW_3D", regions=[region], spaces=SimpleNamespace(active=space)
        )
        screen = SimpleNamespace(areas=[area])
        context = SimpleNamespace(window=SimpleNamespace(screen=screen), scene=scene)
        at = (ZOOM * (2 * np.array((u, v)) - 1) + OFFSET + 1) / 2
        x = REGION["x"] + int(at[0] * REGION["width"])
        y = REGION["y"] + int(at[1] * REGION["height"])
        return pick(context, x, y)

    return click


@pytest.mark.parametrize("kind", ["PERSP", "ORTHO"])
@pytest.mark.parametrize("shift", [0, 0.3])
def test_the_pixel_under_the_mouse(click, kind, shift):
    camera = bpy.context.scene.camera.data
    camera.type = kind
    camera.shift_x = shift
    for x, y in ((0, 0), (47, 26), (11, 20), (30, 3)):
        assert click((x + 0.5) / 48, (y + 0.5) / 27) == (x, y, "SCENE")


def test_a_render_border_is_the_pictures_origin(click):
    render = bpy.context.scene.render
    render.use_border = True
    render.border_min_x = 0.5
    assert click(30.5 / 48, 3.5 / 27) == (6, 3, "SCENE")
    with pytest.raises(SceneError, match="outside of the render border"):
        click(0.25, 0.5)


@pytest.mark.parametrize(
    ("name", "source"),
    [
        (blocks.TRACED, "COMPARISON"),
        (blocks.BLENDER, "COMPARISON"),
        (blocks.PUT_RIGHT, "PUT_RIGHT"),
        ("", "SCENE"),
    ],
)
def test_a_pixel_of_an_image_is_of_what_that_shows(build, name, source):
    scene = build.scene(48, 27)
    build.corner_camera()
    image = bpy.data.images.new("Any", 48, 27)
    if name:
        image[blocks.MARK] = name
    assert pick(over(image, scene), 22, 41) == (11, 20, source)


@pytest.mark.parametrize(
    ("border", "crop", "x"), [(False, False, 25), (True, True, 12), (True, False, 13)]
)
def test_a_pixel_of_a_render_is_one_of_its_border(build, border, crop, x):
    """Blender does not say how large a render is: with a crop it is the border alone."""
    scene = build.scene(48, 27)
    build.corner_camera()
    render = scene.render
    render.use_border, render.use_crop_to_border = border, crop
    render.border_min_x, render.border_max_x = 0.25, 0.75
    image = SimpleNamespace(type="RENDER_RESULT", name="Render Result")
    assert pick(over(image, scene), 50, 41) == (x, 20, "RENDER")


def over(image, scene):
    """Return the context of an Image Editor that shows a small image twice as large."""
    view = SimpleNamespace(region_to_view=lambda x, y: (x / 96, y / 54))
    region = SimpleNamespace(type="WINDOW", view2d=view, x=0, y=0, width=96, height=54)
    active = SimpleNamespace(active=SimpleNamespace(image=image))
    area = SimpleNamespace(type="IMAGE_EDITOR", regions=[region], spaces=active)
    window = SimpleNamespace(screen=SimpleNamespace(areas=[area]))
    return SimpleNamespace(window=window, scene=scene)


def test_what_is_no_pixel_is_said(click):
    with pytest.raises(SceneError, match="outside of the camera's frame"):
        click(-0.05, 0.5)
    camera = bpy.context.scene.camera.data
    camera.type = "PANO"
    lens(camera).panorama_type = "EQUIRECTANGULAR"
    with pytest.raises(SceneError, match="which a 3D view does not show"):
        click(0.5, 0.5)
