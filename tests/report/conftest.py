"""Small comparisons for the page: a room with solids and a plane, and pixels that differ."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import trimesh
from reference_tracer.causes.case import Case
from reference_tracer.comparison.comparing import compare
from reference_tracer.manifest import Manifest, ObjectEntry, Unmodelled
from reference_tracer.pictures.picture import Picture
from reference_tracer.pictures.source import Source
from reference_tracer.projections import PROJECTIONS
from reference_tracer.rendering import render
from reference_tracer.scene import Instance
from reference_tracer.tracer.camera import camera_rays
from reference_tracer.tracer.progress import result_of
from reference_tracer.tracer.settings import Settings

from ..drawn import Plot
from .browser import show

__all__ = ["show"]  # a fixture

HOSTILE = (
    '</script><script>window.hacked = "name"</script>',
    "<img src=x onerror=\"window.hacked='image'\">",
    "\"quotes\" 'and' &amp; \\u003c \\ \u2028 é Ω 猫",
)
FOREIGN = (0.1, 0.9, 0.3, 1.0)  # linear; no surface here has it


def _scene(make, projection="perspective", float32=False, planes=True):
    """Return a ball, a box and a turned instance of it, before an infinite plane."""
    half = 1.5 if projection == "orthographic" else 0.28
    eye, of = (3, -4, 2.2), PROJECTIONS[projection]
    camera = make.camera(48, 36, half=half, eye=eye, target=(0, 0, 0), projection=of)
    ball = make.mesh(trimesh.creation.icosphere(2, radius=0.8), name=HOSTILE[0])
    box = make.mesh(trimesh.creation.box((0.9, 0.7, 1.3)), name=HOSTILE[1])
    if float32:
        ball, box = (replace(m, vertices=m.vertices.astype(np.float32)) for m in (ball, box))
    floor = [((0, 0, -1.1), (0.1, 0.05, 1))] if planes else []
    scene = make.scene(camera, ball, box, planes=floor, background=(0, 0, 0, 1))
    turn = np.array([[0.6, -0.8, 0, 1.1], [0.8, 0.6, 0, -0.4], [0, 0, 1, 0.1], [0, 0, 0, 1]])
    there, other = np.eye(4), len(scene.objects)
    there[:3, 3] = -0.9, 0.5, 0.4
    instances = (
        Instance(0, 0, there, scene.instances[0].colors),
        Instance(1, 1, turn, scene.instances[1].colors),
        Instance(1, other, np.linalg.inv(turn), [[0.9, 0.8, 0.2, 1]]),
    )
    return replace(scene, instances=instances, objects=(*scene.objects, HOSTILE[2]))


def _compared(scene, change=None, unmodelled=(), settings=None):
    """Return the comparison of a scene with its own picture, changed."""
    settings = settings or Settings()
    frame = render(scene, settings)
    picture = frame.color.copy()
    if change:
        change(picture)
    entries = tuple(ObjectEntry(name, "MESH", True, triangles=12) for name in scene.objects)
    manifest = Manifest(
        "a.blend", "Scene", "ViewLayer", 1, "RENDER", "Camera", entries, tuple(unmodelled)
    )
    source = Source("workbench", "5.2.3", settings={"light": "FLAT"})
    return result_of(compare(Case(scene, manifest, settings, Picture(picture, source)), frame))


@pytest.fixture
def hostile():
    """Names that would break out of a page if they could."""
    return HOSTILE


@pytest.fixture
def room(make):
    """Return what makes the room's scene."""
    return lambda **choices: _scene(make, **choices)


@pytest.fixture
def compared():
    """Return what compares a scene with a changed picture of it."""
    return _compared


@pytest.fixture
def differing(room):
    """Return a comparison with pixels that are not modelled (row 4) and not explained (row 30)."""

    def change(picture):
        picture[4, 5:11] = FOREIGN
        picture[30, 40:42] = FOREIGN

    scene = room()
    # A box that covers the lower left of the picture, as far as its 20 lowest rows.
    film = np.array([[0.0, 14.0, 0.0, 14.0], [0.0, 0.0, 12.0, 12.0]])
    points = camera_rays(scene.camera, *film).at(np.array([1.0, 1.0, 1.0, 1.0]))
    bounds = np.stack((points.min(axis=1), points.max(axis=1)))
    return _compared(scene, change, [Unmodelled(HOSTILE[0], "hair", "long", bounds)])


@pytest.fixture
def plotted(open_page):
    """Return what opens a page, and reads the plot on it."""

    def read(text):
        tab = open_page(text, ready=".plot svg")
        svg = tab.locator(".plot svg")
        return Plot(svg.evaluate("e => new XMLSerializer().serializeToString(e)"))

    return read
