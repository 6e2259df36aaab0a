"""*Select What the Camera Sees*, in both modes: what is selected, stored, and not said."""

from __future__ import annotations

import bmesh
import bpy
import numpy as np
import pytest
from reference_tracer.blender.jobs.open_file import export_open_file
from reference_tracer.blender.versions import lens
from reference_tracer.visible import SEEN, visible

select_seen = bpy.ops.reference_tracer.select_seen


@pytest.fixture(autouse=True)
def scene(build):
    """A scene whose camera is straight above the origin."""
    scene = build.scene()
    build.camera()
    return scene


def selected():
    return sorted(obj.name for obj in bpy.context.view_layer.objects if obj.select_get())


def edit(*objects):
    for obj in objects:
        obj.select_set(True)
        bpy.context.view_layer.objects.active = obj
    bpy.ops.object.mode_set(mode="EDIT")


def edited(obj):
    return bmesh.from_edit_mesh(obj.data)


def faces(obj):
    """Which faces of an object in Edit Mode are selected."""
    return [face.select for face in edited(obj).faces]


def stored(obj):
    """What is stored of each face."""
    if obj.mode == "EDIT":
        bpy.ops.object.mode_set(mode="OBJECT")
    return [item.value for item in obj.data.attributes["camera_sees"].data]


def upwards(obj):
    """Which faces look up: those that the camera sees of a cube below it."""
    return [polygon.normal.z > 0.5 for polygon in obj.data.polygons]


def test_objects_of_which_any_face_is_seen(build):
    """An instance is of what instances it."""
    build.cube("Front")
    build.cube("Behind", size=1, location=(0, 0, -3))
    build.cube("Beside", location=(50, 0, 0))
    build.object("Light", bpy.data.lights.new("Light", "POINT"))
    inner = build.collection("Inner", build.cube("Inner", size=0.5, link=False))
    build.instances("Empty", inner, location=(0, 0, 2))
    assert select_seen() == {"FINISHED"}
    assert selected() == ["Empty", "Front"]
    select_seen(hidden=True)
    assert selected() == ["Behind", "Beside"]


def test_faces_in_edit_mode_as_they_are_edited(build):
    """Unapplied edits count; what Edit Mode hides stays hidden, and hides nothing less."""
    cube, other = build.cube("Cube"), build.cube("Other", size=1, location=(0, 0, -3))
    edit(cube, other)
    bpy.ops.mesh.select_mode(type="VERT")
    assert select_seen() == {"FINISHED"}
    assert faces(cube) == upwards(cube) and not any(faces(other))
    select_seen(hidden=True)
    assert faces(cube) == [not up for up in upwards(cube)] and all(faces(other))
    for obj in cube, other:  # as each face has them
        assert all(vertex.select for vertex in edited(obj).verts)
    mesh = edited(cube)
    mesh.faces.ensure_lookup_table()
    top = mesh.faces[upwards(cube).index(True)]
    top.hide_set(True)
    bmesh.update_edit_mesh(cube.data)
    select_seen()
    assert not any(faces(cube)) and not any(faces(other))
    bmesh.ops.delete(mesh, geom=[top], context="FACES")
    bmesh.update_edit_mesh(cube.data)
    select_seen()
    inside = faces(cube)
    assert len(inside) == 5 and any(inside)  # through the hole: the bottom, from behind


def test_faces_of_a_shape_key_that_is_edited(build):
    """Edit Mode shows it alone; a copy of the object has the mean of all keys."""
    cube = build.cube("Cube")
    cube.shape_key_add(name="Basis")
    key = cube.shape_key_add(name="Moved")
    for point in key.data:
        point.co.x += 0.5
    cube.active_shape_key_index, key.value = 1, 0.25
    edit(cube)
    select_seen()
    assert faces(cube)[upwards(cube).index(True)] and sum(faces(cube)) == 1


def test_the_attribute_is_stored_in_both_modes_and_no_other_is_written_over(build):
    cube = build.cube("Cube")
    expected = [int(up) for up in upwards(cube)]
    select_seen(attribute=True)
    assert stored(cube) == expected
    edit(cube)
    mesh = edited(cube)
    for face in mesh.faces:
        face[mesh.faces.layers.int["camera_sees"]] = 7
    select_seen(attribute=True)
    assert stored(cube) == expected
    cube.data.attributes.remove(cube.data.attributes["camera_sees"])
    cube.data.attributes.new("camera_sees", "FLOAT", "POINT")
    others = build.cube("Other"), build.cube("Another")
    with pytest.raises(RuntimeError, match=r"has another attribute 'camera_sees': rename it"):
        select_seen(attribute=True)
    assert not any("camera_sees" in other.data.attributes for other in others)


def test_a_linked_mesh_cannot_have_an_attribute_which_is_said(scene, build, tmp_path, capsys):
    path = str(tmp_path / "library.blend")
    cube = build.cube("Cube")
    cube.data.attributes.new("camera_sees", "FLOAT", "POINT")  # which nobody here can rename
    bpy.data.libraries.write(path, {cube})
    bpy.data.objects.remove(cube)
    with bpy.data.libraries.load(path, link=True) as (_, linked):
        linked.objects = ["Cube"]
    build.link(linked.objects[0])
    select_seen(attribute=True)
    assert "Mesh 'Cube' is linked from a library" in capsys.readouterr().out


def modified(obj, kind, **values):
    modifier = obj.modifiers.new(kind.title(), kind)
    for name, value in values.items():
        setattr(modifier, name, value)
    return obj


def seen_by_slots(obj):
    """What is stored if a face is seen just where a triangle of its own material's slot is."""
    scene, *_ = export_open_file(bpy.context, whole=True)
    slots = [scene.meshes[instance.mesh].slots for instance in scene.instances]
    seen = np.concatenate(slots)[visible(scene).seen == SEEN]
    return [int(slot in seen) for slot in range(len(obj.data.polygons))]


@pytest.mark.parametrize("mode", ("OBJECT", "EDIT"))
@pytest.mark.parametrize(
    ("kind", "values"),
    [
        ("ARRAY", {"relative_offset_displace": (0.5, 0, -1.5)}),
        ("BEVEL", {"width": 0.1, "show_viewport": False}),
        ("MIRROR", {"use_axis": (True, True, False), "show_in_editmode": False}),
        ("SOLIDIFY", {"thickness": 0.2, "show_render": False}),
        ("SUBSURF", {"levels": 0, "render_levels": 2}),
        ("TRIANGULATE", {}),
    ],
)
def test_faces_of_modified_meshes_are_those_that_they_come_from(build, kind, values, mode):
    """Each has a material of its own, whose slot goes through modifiers by itself."""
    cube = build.cube("Cube", size=1, location=(0.3, 0.2, 0), rotation=(0.5, 0.3, 0.2))
    for number, polygon in enumerate(cube.data.polygons):
        cube.data.materials.append(build.material(str(number), 1, 1, 1, 1))
        polygon.material_index = number
    modified(cube, kind, **values)
    if mode == "EDIT":
        edit(cube)
    expected = seen_by_slots(cube)
    assert select_seen(attribute=True) == {"FINISHED"}
    assert stored(cube) == expected and {*expected} == {0, 1}


def test_what_modifiers_make_of_nothing_mix_or_merge_is_said(build, capsys):
    """A face of the original is not called hidden if what may come from it is seen."""
    cutter = build.cube("Cutter", size=0.5, location=(0, 0, 0.5))
    cutter.hide_render = True
    corners = [(x / 4, y, 0) for x in range(5) for y in (1, 2)]
    flat = build.mesh("Merged", corners, [(k, k + 2, k + 3, k + 1) for k in range(0, 8, 2)])
    roof = [(0.8, 0, 0), (1.2, -0.5, 0.5), (1.2, 0.5, 0.5), (1.6, 0, 0)]
    mean = build.mesh("Mean", roof, [(0, 1, 2), (1, 3, 2)])
    _, (extruded,) = build.nodes(mean, "GeometryNodeExtrudeMesh")
    extruded.mode = "EDGES"  # which get the mean of what their faces have
    expected = {
        modified(build.cube("Lost", size=1, location=(-2, 0, 0)), "REMESH"): {2},
        modified(build.cube("Made", size=1), "BOOLEAN", object=cutter, operation="UNION"): {1, 2},
        modified(flat, "DECIMATE", decimate_type="DISSOLVE"): {1, 2},
        mean: {1},
        modified(build.cube("Covered", size=0.2, location=(0, 0, -1)), "REMESH"): {0},
    }
    plane = build.square("Plane", size=0.5, location=(0, 0, -9))
    plane.reference_tracer.infinite_plane = True
    select_seen(attribute=True)
    said = capsys.readouterr().out
    for obj, states in expected.items():
        assert {*stored(obj)} == states, obj.name
        assert (f"'{obj.name}' shows faces" in said) == (states != {0}), obj.name
    assert stored(plane) == [2]


def test_frames_are_those_of_the_scene_which_goes_back(scene, build):
    """Seen in any frame, and in none; what was moved and is not keyed yet stays where it is."""
    scene.frame_start, scene.frame_end = 1, 4
    cube = build.cube("Cube", size=1, location=(0, 0, -3))
    lid = build.square("Lid", size=3)
    for frame, x in ((2, 0), (3, 30)):
        lid.location.x = x
        lid.keyframe_insert("location", frame=frame)
    scene.frame_set(2)
    stepped = []
    bpy.app.handlers.frame_change_pre.append(lambda of, *_: stepped.append(of.name))
    select_seen()
    assert selected() == ["Lid"] and scene.name not in stepped
    lid.location.y = 1
    select_seen(frames=True, attribute=True)
    assert selected() == ["Cube", "Lid"] and scene.frame_current == 2 and lid.location.y == 1
    assert stored(cube) == [int(up) for up in upwards(cube)]
    select_seen(frames=True, hidden=True)
    assert selected() == []


def test_nothing_of_it_stays_in_the_file(build):
    cube = modified(build.cube("Cube"), "SUBSURF")
    cube.shape_key_add(name="Basis")
    before = {block.name_full for block in bpy.data.user_map()}
    select_seen(attribute=True)
    assert {block.name_full for block in bpy.data.user_map()} == before
    assert "reference_tracer_face" not in cube.data.attributes


def test_what_cannot_be_answered_is_an_error(scene, build):
    camera = scene.camera
    with pytest.raises(RuntimeError, match=r"shows no faces"):
        select_seen()
    edit(build.cube("Cube"))
    camera.data.type = "PANO"
    lens(camera.data).panorama_type = "EQUIRECTANGULAR"
    with pytest.raises(RuntimeError, match=r"which faces are seen is decided for"):
        select_seen()
    scene.camera = None
    with pytest.raises(RuntimeError, match=r"has no camera"):
        select_seen()
    scene.camera = camera
    bpy.ops.object.mode_set(mode="SCULPT")
    with pytest.raises(RuntimeError, match=r"Only in Object Mode and in Edit Mode of meshes"):
        select_seen()
    bpy.ops.object.mode_set(mode="OBJECT")
