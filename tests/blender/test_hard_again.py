"""What a review found beside `hard_cases`: right pictures called wrong, and the reverse."""

from __future__ import annotations

import bpy
import numpy as np
import pytest
from reference_tracer.blender.jobs.against import gather_against
from reference_tracer.blender.jobs.compare import gather_case
from reference_tracer.comparison.comparing import compared
from reference_tracer.pictures.picture import Picture
from reference_tracer.pictures.storage import Storage
from reference_tracer.tracer.progress import result_of
from reference_tracer.tracer.settings import Settings

from . import hard_cases as hard

JUDGES = ("WORKBENCH", "CYCLES")


def against(color, **options):
    case = gather_against(bpy.context, Picture(color, **options), Settings())
    return result_of(compared(case))


def drawn():
    return gather_case(bpy.context, judge="WORKBENCH", identity=False).picture.color.copy()


def pane(build):
    """A transparent pane on the camera, behind everything, as wide as the picture."""
    glass = build.square("Pane", 90.0, material=build.material("Glass", 0.5, 0.5, 0.9, 0.3))
    glass.parent, glass.location = bpy.context.scene.camera, (0, 0, -40.0)
    return glass


@pytest.mark.parametrize("judge", JUDGES)
def test_what_hair_instances_is_drawn_beside_hair(build, compare, judge):
    hard.stage(build)
    ground = hard.grid(build, "Ground", 20, 6.0, location=(0, 0, -0.9))
    tree = build.cube("Tree", 0.5, location=(50, 0, 0))
    hard.grow_hair(ground, 60, 0.6)
    settings = hard.grow_hair(ground, 15, 1.0)
    settings.render_type, settings.instance_object, settings.particle_size = "OBJECT", tree, 1.0
    assert compare(judge=judge).counts.unexplained == 0


@pytest.mark.parametrize("make", [hard.hair_curves, hard.grease_pencil])
def test_a_keyed_visibility_leaves_hair_out_all_the_same(build, compare, make):
    make(build)
    for obj in bpy.data.objects:
        if obj.type in ("CURVES", "GREASEPENCIL"):
            obj.keyframe_insert("hide_render", frame=1)
    assert compare(judge="WORKBENCH").verdict == "warnings"


@pytest.mark.parametrize("make", [hard.particle_hair, hard.grease_pencil])
def test_what_draws_itself_before_glass(build, compare, make):
    make(build)
    for name in ("Red", "Green", "Blue", "Grey"):
        bpy.data.materials[name].diffuse_color[3] = 0.5
    assert compare(judge="WORKBENCH").counts.unexplained == 0


@pytest.mark.parametrize("judge", JUDGES)
def test_hair_on_an_emitter_that_is_not_shown(build, compare, judge):
    hard.particle_hair(build)
    bpy.data.objects["Patch"].show_instancer_for_render = False
    assert compare(judge=judge).counts.unexplained == 0


@pytest.mark.parametrize("color", [(1, 1, 1, 1), (0, 0, 0, 1)])
def test_linked_objects_are_told_apart(build, compare, tmp_path, color):
    one = build.cube("Cube", 1.2, color=color)
    kit, path = build.collection("Kit", one), str(tmp_path / "kit.blend")
    bpy.data.libraries.write(path, {kit}, fake_user=True)
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    hard.stage(build)
    with bpy.data.libraries.load(path, link=True) as (_, wanted):
        wanted.collections = ["Kit"]
    bpy.context.scene.collection.children.link(wanted.collections[0])
    found = compare(judge="WORKBENCH")
    assert found.verdict == "agree" and found.identity.shows().not_known == 0
    bpy.context.scene.display.shading.color_type = "RANDOM"
    assert compare(judge="CYCLES").verdict == "agree"


@pytest.mark.parametrize("color_type", ["MATERIAL", "OBJECT"])
def test_an_animated_black_is_nobodys_colour(build, compare, color_type):
    hard.stage(build, color_type=color_type)
    grey = build.material("Same", 0.5, 0.5, 0.5)
    for obj in bpy.data.objects:
        if obj.type == "MESH":
            obj.data.materials.clear()
            obj.data.materials.append(grey)
    green = bpy.data.objects["Green"]
    green.color = (0, 0, 0, 1)
    green.keyframe_insert("color", frame=1)
    assert compare(judge="WORKBENCH").verdict == "agree"


def test_glass_in_front_of_all_cannot_be_judged(build):
    hard.stage(build)
    pane(build).show_in_front = True
    assert against(drawn() * 0).verdict == "not comparable"


def test_glass_of_another_frame_is_no_evidence(build):
    hard.stage(build)
    color, glass = drawn(), pane(build)
    for frame, x in ((1, 200.0), (2, 0.0)):
        glass.location.x = x
        glass.keyframe_insert("location", frame=frame)
    bpy.context.scene.frame_set(1)
    noise = np.random.default_rng(1).random(color.shape, np.float32)
    assert against(np.where(color[..., 3:] == 0, noise, color)).verdict == "differences"


def test_a_background_beside_a_surface_of_nearly_its_colour(build):
    hard.stage(build)
    bpy.data.materials["Red"].diffuse_color = (0.995, 0.995, 0.995, 1)
    color = drawn()
    alpha = color[..., 3:]
    shown = np.concatenate((color[..., :3] * 0.5 + 1 - alpha, np.ones_like(alpha)), axis=-1)
    assert against(shown.astype(np.float32), storage=Storage(opaque=True)).counts.unexplained == 0


@pytest.mark.parametrize("smooth", ["FXAA", "8", "32"])
def test_anti_aliasing_before_a_transparent_background(build, compare, smooth):
    scene = hard.stage(build)
    scene.display.render_aa, scene.display.shading.light = smooth, "FLAT"
    scene.display.shading.show_specular_highlight = False
    found = compare(judge="WORKBENCH", as_is=True)
    assert found.counts.unexplained == 0
