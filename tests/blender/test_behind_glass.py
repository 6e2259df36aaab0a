"""What is behind glass is judged: Blender draws once more without it."""

from __future__ import annotations

import bpy
import numpy as np
import pytest
from reference_tracer.blender.drawing import drawings
from reference_tracer.causes.cause import UNEXPLAINED
from reference_tracer.pictures.palette import By
from reference_tracer.report.lines import describe

PANES = 5


@pytest.fixture
def panes(build):
    """Five panes of glass, one behind another, before objects and a wall."""
    scene = build.scene(96, 54)
    build.camera((0, 0, 9))
    glass = build.material("Glass", 0.2, 0.7, 0.9, 0.3)
    for k in range(PANES):
        build.square(f"Pane {k}", 2.6, location=(-0.4, 0, 5 - 0.5 * k), material=glass)
    build.square("Wall", 30, location=(0, 0, -4), material=build.material("Grey", 0.3, 0.3, 0.3))
    red = build.material("Red", 0.9, 0.1, 0.1)
    build.cube("Behind", 1.6, location=(-0.4, 0.2, 0.5), rotation=(0.4, 0.3, 0.1), material=red)
    build.cube("Beside", 1.0, location=(4, 1, 0), material=build.material("Blue", 0.1, 0.2, 0.9))
    for material in bpy.data.materials:
        material.use_nodes = True
        socket = material.node_tree.nodes["Principled BSDF"].inputs["Base Color"]
        socket.default_value = (*material.diffuse_color[:3], 1)
    return scene


def through(found):
    """Return the pixels that show a pane."""
    names = found.scene.objects
    return np.isin(found.frame.object_index, [names.index(n) for n in names if "Pane" in n])


COLORS = [By.VIEWPORT, By.AUTOMATIC, By.MATERIAL]


@pytest.mark.parametrize("identity", [True, False])
@pytest.mark.parametrize("colors", COLORS)
def test_an_honest_scene_has_no_alarm(panes, compare, colors, identity):
    alphas = [m.diffuse_color[3] for m in bpy.data.materials]
    hidden = [o.hide_render for o in bpy.data.objects]
    found = compare(judge="WORKBENCH", colors=colors, identity=identity)
    assert found.counts.unexplained == 0
    seen = through(found)
    assert seen.mean() > 0.1 and found.causes.behind is not None
    np.testing.assert_array_equal(found.causes.behind, seen)
    assert found.counts.behind == (seen.sum(), 0)
    assert any("what is behind transparent surfaces" in line for line in describe(found))
    assert [m.diffuse_color[3] for m in bpy.data.materials] == alphas
    assert [o.hide_render for o in bpy.data.objects] == hidden


@pytest.mark.parametrize("colors", COLORS)
@pytest.mark.parametrize("what", ["moved", "removed", "recoloured"])
def test_a_fault_behind_is_found(panes, compare, drawn_otherwise, colors, what):
    obj = bpy.data.objects["Behind"]
    material = obj.data.materials[0]

    def moved(x):
        obj.location.x += x
        obj.update_tag()

    def removed(hidden):
        obj.hide_render = hidden

    def recoloured(color):
        if colors == By.AUTOMATIC:  # each object has its own, whatever its material
            obj.color = (*color, 1)
        material.diffuse_color = (*color, 1)

    changes = {
        "moved": (lambda: moved(0.3), lambda: moved(-0.3)),
        "removed": (lambda: removed(True), lambda: removed(False)),
        "recoloured": (lambda: recoloured((0.1, 0.9, 0.2)), lambda: recoloured((0.9, 0.1, 0.1))),
    }
    with drawn_otherwise(*changes[what]):
        found = compare(judge="WORKBENCH", colors=colors, identity=False)
    wrong = found.causes.cause == UNEXPLAINED
    seen = through(found)
    assert (wrong & seen).sum() > 50
    assert found.verdict == "differences"
    assert not (wrong & (found.frame.object_index == found.scene.objects.index("Beside"))).any()


def test_panes_of_a_collection_instance(panes, build, compare):
    scene = bpy.context.scene
    one = build.square("Pane X", 1.0, link=False, material=bpy.data.materials["Glass"])
    build.instances("Holder", build.collection("Panes", one), location=(2.5, -1, 3))
    scene.display.shading.color_type = "MATERIAL"
    found = compare(judge="WORKBENCH", colors=By.VIEWPORT)
    assert found.counts.unexplained == 0
    np.testing.assert_array_equal(found.causes.behind, through(found))


def test_nothing_more_is_drawn_without_glass(build, compare, monkeypatch):
    build.scene(32, 18)
    build.camera()
    build.square("Solid", material=build.material("Red", 0.9, 0.1, 0.1))
    drawn = []
    real = drawings.picture
    monkeypatch.setattr(drawings, "picture", lambda *a, **k: drawn.append(1) or real(*a, **k))
    found = compare(judge="WORKBENCH", identity=False)
    assert len(drawn) == 1 and found.causes.behind is None
