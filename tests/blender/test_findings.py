"""What the diagnosis found, in Blender: the button diagnoses, and what leads to a finding."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import bpy
import numpy as np
import pytest
from reference_tracer.blender.drawing.camera_object import copy_camera
from reference_tracer.blender.reading.camera import export_camera
from reference_tracer.blender.ui import findings, results
from reference_tracer.blender.ui.results import Kind
from reference_tracer.diagnosis.diagnosis import Diagnosis, Told
from reference_tracer.diagnosis.faults import FAULTS
from reference_tracer.diagnosis.faults.fault import Numbers, Option
from reference_tracer.rendering import render
from reference_tracer.scene import SceneError
from reference_tracer.tracer.camera import camera_rays
from reference_tracer.tracer.progress import result_of

OPS = bpy.ops.reference_tracer
BY_NAME = {fault.name: fault for fault in FAULTS}


@pytest.fixture
def seen(build):
    """A scene with solids of different colours."""
    scene = build.scene(160, 90)
    build.solids()
    camera = build.corner_camera(lens=40)
    scene.display.shading.color_type = "OBJECT"
    scene.reference_tracer.identity = False  # a second drawing, of which a test would have to lie
    rng = np.random.default_rng(27)
    for obj in bpy.data.objects:
        obj.color = (*rng.uniform(0.1, 1, 3), 1)
    return scene, camera


def found():
    return results.content(Kind.COMPARISON, bpy.context.scene).diagnosis


@pytest.mark.slow
def test_an_object_that_was_found_is_selected(seen, drawn_otherwise):
    scene, _ = seen
    name = next(o.name for o in scene.objects if o.type == "MESH" and o.name != "Plane")
    obj = bpy.data.objects[name]
    hidden = partial(setattr, obj, "hide_render")
    with drawn_otherwise(partial(hidden, True), partial(hidden, False)):
        OPS.compare(directory="")
    told = found().told
    assert [t.guess.object for t in told] == [name]
    for other in scene.objects:
        other.select_set(True)
    assert OPS.select_object(name=name) == {"FINISHED"}
    assert bpy.context.selected_objects == [obj] == [bpy.context.view_layer.objects.active]
    obj.name = "Renamed"
    with pytest.raises(RuntimeError, match=f"no object '{name}' now"):
        OPS.select_object(name=name)


class Drawn(list):
    """A layout that notes the sentences and the buttons that are drawn in it."""

    def box(self):
        return self

    def operator(self, name):
        self.append(name.partition(".")[2])
        return bpy.context.window_manager.operator_properties_last(name)


def after_each_sentence(monkeypatch):
    """Return the buttons that are drawn below each finding."""
    drawn = Drawn()
    with monkeypatch.context() as patched:
        patched.setattr(findings, "wrapped", lambda box, *_: box.append(None))
        comparison = results.content(Kind.COMPARISON, bpy.context.scene)
        findings.draw_findings(drawn, bpy.context, comparison)
    own = []
    for name in drawn:
        if name is None:
            own.append([])
        else:
            own[-1].append(name)
    return own


def test_a_copy_is_offered_below_its_own_finding_alone(seen, compare, monkeypatch):
    """And no other camera of the user's is."""
    scene, camera = seen
    comparison = compare()
    case, told = comparison.case, []
    for name, guess in (
        ("focal_length", Numbers((5.0,), words="it is off")),
        ("roll", Numbers((3.0,))),
    ):
        case = BY_NAME[name].assume(case, guess)
        frame = render(case.scene)
        told.append(Told(BY_NAME[name], guess, 9, 4, 9, 0, frame, comparison.picture))
    result_of(
        results.keep_comparison(
            replace(comparison, diagnosis=Diagnosis(tuple(told))), bpy.context.scene.session_uid
        )
    )
    apply, show = "copy_camera", "show_put_right"
    other = camera.copy()
    scene.collection.objects.link(other)
    bpy.context.view_layer.objects.active = other
    assert after_each_sentence(monkeypatch) == [[apply, show]] * 2
    assert not OPS.activate_copy.poll()
    for number in 0, 1:
        OPS.copy_camera(number=number)
        copy = bpy.context.view_layer.objects.active
        wanted = [[apply, show], [apply, show]]
        wanted[number].insert(1, "activate_copy")
        assert after_each_sentence(monkeypatch) == wanted
    bpy.context.view_layer.objects.active = other
    assert not OPS.activate_copy.poll()
    bpy.context.view_layer.objects.active = copy
    assert OPS.activate_copy() == {"FINISHED"} and scene.camera == copy
    assert after_each_sentence(monkeypatch) == [[apply, show]] * 2
    assert not OPS.activate_copy.poll()


@pytest.mark.parametrize(
    ("name", "guess"),
    [
        ("pixel_offset", Numbers((0.5, -0.25))),
        ("focal_length", Numbers((-30.0,))),
        ("roll", Numbers((40.0,))),
        ("mirrored_x", Option(1)),
        ("sensor_fit", Option(0)),
        ("clip_end", Numbers((9.0,))),
        ("forward", Option(0)),
        ("matrix_inverted", Option(0)),
    ],
)
@pytest.mark.parametrize("kind", ["PERSP", "ORTHO"])
def test_a_copy_sees_as_the_camera_of_a_fault(seen, compare, name, guess, kind):
    """Exported again, its rays pass where the fault's do, but for the rounding to float32."""
    scene, camera = seen
    camera.data.type = kind
    camera.data.shift_x = 0.05
    case = compare().case
    wanted = BY_NAME[name].assume(case, guess).scene.camera
    copy = copy_camera(scene, wanted, "Copy")
    assert scene.camera == camera
    scene.camera = copy
    bpy.context.view_layer.update()
    again = export_camera(scene)
    x, y = np.meshgrid(np.linspace(0, 160, 9), np.linspace(0, 90, 7))
    rays, others = (camera_rays(c, x.ravel(), y.ravel()) for c in (wanted, again))
    np.testing.assert_allclose(others.directions, rays.directions, atol=3e-6)
    np.testing.assert_allclose(others.origins, rays.origins, atol=3e-6)
    assert (again.clip_start, again.clip_end) == (
        np.float32(wanted.clip_start),
        np.float32(wanted.clip_end),
    )


def test_what_no_camera_has_is_said(seen, compare):
    scene, _ = seen
    camera = compare().scene.camera
    count = len(bpy.data.objects), len(bpy.data.cameras)
    scene.render.pixel_aspect_y = 2.0
    with pytest.raises(SceneError, match="pixel aspect"):
        copy_camera(scene, camera, "Copy")
    scene.render.pixel_aspect_y = 1.0
    scene.render.resolution_x = 200
    with pytest.raises(SceneError, match="resolution"):
        copy_camera(scene, camera, "Copy")
    scene.render.resolution_x = 160
    sheared = camera.world_from_camera.copy()
    sheared[:3, 1] += 0.3 * sheared[:3, 0]
    with pytest.raises(SceneError, match="right angles"):
        copy_camera(scene, replace(camera, world_from_camera=sheared), "Copy")
    assert (len(bpy.data.objects), len(bpy.data.cameras)) == count
