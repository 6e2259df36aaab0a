"""The exported camera against Blender's own projection, over the whole matrix of settings.

The judge is `Object.calc_matrix_camera`, by the certificate that each export has: known points are
put on the film by the tracer's camera and by Blender's matrices.
"""

from __future__ import annotations

from itertools import islice, product

import bpy
import numpy as np
import pytest
from mathutils import Matrix
from reference_tracer.blender.drawing.camera_object import add_camera
from reference_tracer.blender.reading.camera import certify_camera, export_camera, window_of
from reference_tracer.scene import Camera, ViewWindow

from ..sampled import sampled

SIZES = {"landscape": (192, 108), "portrait": (90, 160), "square": (128, 128)}
BORDERS = (None, False, True)  # no border, border, border and crop
ASPECTS = ((1, 1), (2, 1), (1, 2))
SHIFTS = ((0, 0), (0.3, 0), (0, -0.2), (0.15, 0.4))
# What Blender's matrix may be off on the film, in shares of its longer side: its entries and those
# of the camera's own matrix are float32 (2^-24 each), read in a handful of products and one
# division.
ROUNDING = 8 * 2.0**-24


def plain(camera: bpy.types.Object) -> None:
    camera.matrix_world = Matrix.LocRotScale((1.3, -2.1, 0.7), Matrix.Rotation(0.8, 3, "X"), None)


def parented(camera: bpy.types.Object) -> None:
    parent = bpy.data.objects.new("Parent", None)
    bpy.context.scene.collection.objects.link(parent)
    parent.location, parent.rotation_euler = (2, 1, -1), (0.3, 0.7, -1.2)
    camera.parent = parent
    camera.location, camera.rotation_euler = (0.5, 0.2, 3), (0.2, 0.1, 0.4)


def scaled(camera: bpy.types.Object) -> None:
    parented(camera)
    camera.scale = (2.5, 0.4, 7)


def mirrored(camera: bpy.types.Object) -> None:
    parented(camera)
    camera.scale = (-1, 1, 1)


def sheared(camera: bpy.types.Object) -> None:
    parented(camera)
    camera.parent.scale = (1, 2, 0.6)


@pytest.fixture
def settings_matrix(build):
    """Set one combination after another; yields the camera object."""
    scene, camera = build.scene(), build.camera()

    def run(kind: str, fit: str, place):
        place(camera)
        bpy.context.view_layer.update()
        data, render = camera.data, scene.render
        data.type, data.sensor_fit, data.lens, data.ortho_scale = kind, fit, 41.0, 5.3
        data.sensor_width, data.sensor_height, data.clip_end = 36, 22, 20
        for size, percent, shift, aspect, border in product(
            SIZES.values(), (100, 37), SHIFTS, ASPECTS, BORDERS
        ):
            render.resolution_x, render.resolution_y = size
            render.resolution_percentage = percent
            data.shift_x, data.shift_y = shift
            render.pixel_aspect_x, render.pixel_aspect_y = aspect
            render.use_border = border is not None
            render.use_crop_to_border = bool(border)
            render.border_min_x, render.border_max_x = 0.3, 0.81
            render.border_min_y, render.border_max_y = 0.1, 0.7
            yield camera

    return run


PLACES = [plain, parented, scaled, mirrored, sheared]


@sampled(len(PLACES))
@pytest.mark.parametrize("place", PLACES)
@pytest.mark.parametrize("fit", ["AUTO", "HORIZONTAL", "VERTICAL"])
@pytest.mark.parametrize("kind", ["PERSP", "ORTHO"])
def test_projects_as_blender_does(kind, fit, place, every, settings_matrix):
    """Every combination: every day with one of the places, in the long run with each."""
    tried, first = 0, PLACES.index(place) % every
    for _ in islice(settings_matrix(kind, fit, place), first, None, every):
        depsgraph = bpy.context.evaluated_depsgraph_get()
        exported = export_camera(depsgraph.scene_eval)
        certificate = certify_camera(depsgraph, exported)
        size, distance = max(exported.width, exported.height), np.linalg.norm(exported.origin)
        assert certificate.points > 1000
        assert certificate.largest <= ROUNDING * size * (1 + distance)
        tried += 1
    whole = len(SIZES) * 2 * len(SHIFTS) * len(ASPECTS) * len(BORDERS)
    assert tried == len(range(first, whole, every))


@pytest.mark.parametrize(("size", "percent"), [((1920, 1080), 33), ((3, 200), 50), ((7, 9), 99)])
def test_the_percentage_cuts_off_as_blender_does(size, percent, build, workbench):
    scene = build.scene(*size)
    build.camera()
    scene.render.resolution_percentage = percent
    camera = export_camera(scene)
    assert (camera.height, camera.width) == workbench().shape[:2]


def test_a_pixel_that_blender_cannot_have_is_the_nearest():
    camera = Camera(np.eye(4), ViewWindow(-1, 1, -1e-6, 1e-6), 20, 10)
    scene = bpy.context.scene
    add_camera(scene, camera)
    assert scene.render.pixel_aspect_x == 200
    shown = window_of(scene)
    assert (shown.left, shown.right) == pytest.approx((-1, 1))
    assert shown.top == pytest.approx(2 / 20 * 10 / 200 / 2)
