"""What the tracer does not model is named by object, and explains pixels in its place alone."""

from __future__ import annotations

import bpy
import numpy as np
import pytest

from . import hard_cases as hard

MODES = ("VIEWPORT", "RENDER")
NAMED = {
    hard.glass_pane: ("Pane", "transparency"),
    hard.see_through_object_color: ("Green", "transparency"),
    hard.in_front: ("Behind", "in-front drawing"),
    hard.holdout: ("Blue", "holdout"),
    hard.particle_hair: ("Patch", "hair"),
    hard.textured: ("Textured", "texture"),
    hard.grease_pencil: (None, "grease pencil"),  # each Blender has another name for it
    hard.hair_curves: ("Hair Curves", "hair curves"),
    hard.point_cloud: ("Cloud", "point cloud"),
    hard.empty_volume: ("Volume", "volume"),
}


@pytest.mark.parametrize("make", NAMED, ids=lambda make: make.__name__)
@pytest.mark.parametrize("mode", MODES)
def test_is_named_with_object_and_bounds(mode, make, build, export):
    make(build)
    _, manifest = export.modes[mode]()
    name, feature = NAMED[make]
    name = name or bpy.context.object.name
    [found] = [u for u in manifest.unmodelled if u.object == name]
    assert found.feature == feature
    obj = bpy.data.objects[name].evaluated_get(bpy.context.evaluated_depsgraph_get())
    corners = np.array([obj.matrix_world @ type(obj.location)(c) for c in obj.bound_box])
    assert (found.bounds[0] <= corners.min(axis=0) + 1e-6).all()
    assert (found.bounds[1] >= corners.max(axis=0) - 1e-6).all()
    said = f"  not modelled: {name}: {feature}"
    assert any(line.startswith(said) for line in manifest.lines())
    assert found.to_dict() in manifest.to_dict()["unmodelled"]


@pytest.mark.parametrize("make", hard.SWITCHED_OFF, ids=lambda make: make.__name__)
def test_of_the_scene_is_not_in_the_picture_and_still_named(make, build, compare):
    make(build)
    comparison = compare()
    assert comparison.counts.unexplained == 0
    [found] = comparison.manifest.unmodelled
    assert found.feature == hard.SWITCHED_OFF[make] and found.bounds is None
    of_scene = f"scene '{bpy.context.scene.name}'"
    assert found.object == ("Camera" if found.feature == "depth of field" else of_scene)


def test_several_instances_share_one_entry_around_all_of_them(build, export):
    build.camera()
    cube = build.cube("Thing", 1, link=False, material=build.material("Glass", 1, 1, 1, 0.5))
    collection = build.collection("Kit", cube)
    for x in (-4, 4):
        build.instances(f"Empty {x}", collection, location=(x, 0, 0))
    _, manifest = export.viewport()
    (found,) = manifest.unmodelled
    np.testing.assert_allclose(found.bounds, [(-4.5, -0.5, -0.5), (4.5, 0.5, 0.5)])
