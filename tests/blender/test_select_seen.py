"""*Select What the Camera Sees*, in both modes: what is selected, stored, and not said."""

from __future__ import annotations

import bmesh
import bpy
import numpy as np
import pytest
from reference_tracer.blender.versions import lens

select_seen = bpy.ops.reference_tracer.select_seen


@pytest.fixture
def looking(build):
    """A camera straight above the origin."""
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


def faces(obj):
    """Which faces of an object in Edit Mode are selected."""
    return [face.select for face in bmesh.from_edit_mesh(obj.data).faces]


def stored(obj):
    """What is stored of each face, in Object Mode."""
    values = np.empty(len(obj.data.polygons), np.int32)
    obj.data.attributes["camera_sees"].data.foreach_get("value", values)
    return values.tolist()


def upwards(obj):
    """Which faces look up: those that the camera sees of a cube below it."""
    return [polygon.normal.z > 0.5 for polygon in obj.data.polygons]


def test_objects_of_which_any_face_is_seen(looking, build):
    build.cube("Front", location=(0, 0, 0))
    build.cube("Behind", size=1, location=(0, 0, -3))
    build.cube("Beside", location=(50, 0, 0))
    build.object("Light", bpy.data.lights.new("Light", "POINT"))
    assert select_seen() == {"FINISHED"}
    assert selected() == ["Front"]
    select_seen(hidden=True)
    assert selected() == ["Behind", "Beside"]


def test_an_instance_is_of_what_instances_it(looking, build):
    inner = bpy.data.collections.new("Inner")
    cube = build.cube("Cube", link=False)
    inner.objects.link(cube)
    empty = build.object("Empty", None)
    empty.instance_type, empty.instance_collection = "COLLECTION", inner
    select_seen()
    assert selected() == ["Empty"]


def test_faces_in_edit_mode_as_they_are_edited(looking, build):
    """Unapplied edits count; what Edit Mode hides stays hidden, and hides nothing less."""
    cube, other = build.cube("Cube"), build.cube("Other", size=1, location=(0, 0, -3))
    edit(cube, other)
    bpy.ops.mesh.select_mode(type="VERT")
    assert select_seen() == {"FINISHED"}
    assert faces(cube) == upwards(cube) and not any(faces(other))
    select_seen(hidden=True)
    assert faces(cube) == [not up for up in upwards(cube)] and all(faces(other))
    for mesh in map(bmesh.from_edit_mesh, (cube.data, other.data)):  # as each face has them
        assert all(vertex.select for vertex in mesh.verts)
    edited = bmesh.from_edit_mesh(cube.data)
    edited.faces.ensure_lookup_table()
    top = edited.faces[upwards(cube).index(True)]
    top.hide_set(True)
    bmesh.update_edit_mesh(cube.data)
    select_seen()
    assert not any(faces(cube)) and not any(faces(other))
    bmesh.ops.delete(edited, geom=[top], context="FACES")
    bmesh.update_edit_mesh(cube.data)
    select_seen()
    inside = faces(cube)
    assert len(inside) == 5 and any(inside)  # through the hole: the bottom, from behind


def test_faces_of_a_shape_key_that_is_edited(looking, build):
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


def test_the_attribute_is_stored_in_both_modes_and_no_other_is_written_over(looking, build):
    cube = build.cube("Cube")
    expected = [int(up) for up in upwards(cube)]
    select_seen(attribute=True)
    assert stored(cube) == expected
    edit(cube)
    edited = bmesh.from_edit_mesh(cube.data)
    for face in edited.faces:
        face[edited.faces.layers.int["camera_sees"]] = 7
    select_seen(attribute=True)
    bpy.ops.object.mode_set(mode="OBJECT")
    assert stored(cube) == expected
    cube.data.attributes.remove(cube.data.attributes["camera_sees"])
    others = build.cube("Other"), build.cube("Another")
    cube.data.attributes.new("camera_sees", "FLOAT", "POINT")
    with pytest.raises(RuntimeError, match=r"has another attribute 'camera_sees': rename it"):
        select_seen(attribute=True)
    assert not any("camera_sees" in other.data.attributes for other in others)


def test_a_linked_mesh_cannot_have_an_attribute_which_is_said(looking, build, tmp_path, capsys):
    path = str(tmp_path / "library.blend")
    cube = build.cube("Cube")
    bpy.data.libraries.write(path, {cube})
    bpy.data.objects.remove(cube)
    with bpy.data.libraries.load(path, link=True) as (_, linked):
        linked.objects = ["Cube"]
    looking.collection.objects.link(linked.objects[0])
    select_seen(attribute=True)
    assert "Mesh 'Cube' is linked from a library" in capsys.readouterr().out


def modified(obj, kind, **values):
    modifier = obj.modifiers.new(kind.title(), kind)
    for name, value in values.items():
        setattr(modifier, name, value)
    return modifier


@pytest.mark.parametrize("mode", ("OBJECT", "EDIT"))
def test_faces_of_modified_meshes_are_those_that_they_come_from(looking, build, mode):
    """Each face of these copies comes from one; a face is seen if any copy of it is."""
    cube = build.cube("Cube", size=1)
    modified(cube, "ARRAY", relative_offset_displace=(0, 0, -1.5))
    modified(cube, "SUBSURF", subdivision_type="SIMPLE", levels=1, render_levels=2)
    modified(cube, "TRIANGULATE")
    covered = build.cube("Covered", size=0.5, location=(0, 0, -2))
    modified(covered, "MIRROR", mirror_object=build.place(build.square("Far"), location=(40, 0, 0)))
    expected = [int(up) for up in upwards(cube)]
    if mode == "EDIT":
        edit(cube)
        cube.modifiers["Array"].show_in_editmode = False
    assert select_seen(attribute=True) == {"FINISHED"}
    if mode == "EDIT":
        bpy.ops.object.mode_set(mode="OBJECT")
    assert stored(cube) == expected


def nodes(obj, *kinds):
    """Geometry nodes of an object, in a row."""
    group = bpy.data.node_groups.new("Nodes", "GeometryNodeTree")
    for way in ("INPUT", "OUTPUT"):
        group.interface.new_socket("Geometry", in_out=way, socket_type="NodeSocketGeometry")
    last = group.nodes.new("NodeGroupInput")
    for kind in kinds:
        node = group.nodes.new(kind)
        socket = next(s for s in node.inputs if s.type == "GEOMETRY")
        group.links.new(last.outputs[0], socket)
        last = node
    group.links.new(last.outputs[0], group.nodes.new("NodeGroupOutput").inputs[0])
    modified(obj, "NODES", node_group=group)
    return group


def test_what_modifiers_make_of_nothing_or_mix_is_said(looking, build, capsys):
    """A face of the original is not called hidden if what may come from it is seen."""
    dual = build.cube("Dual", location=(-1.5, 0, 0), size=1)
    nodes(dual, "GeometryNodeDualMesh")
    made = build.cube("Made", location=(1.5, 0, 0), size=1)
    group = nodes(made)
    cone, join = (group.nodes.new(f"GeometryNode{n}") for n in ("MeshCone", "JoinGeometry"))
    output = next(n for n in group.nodes if n.bl_idname == "NodeGroupOutput")
    group.links.new(group.nodes[0].outputs[0], join.inputs[0])
    cone.inputs["Radius Bottom"].default_value = 0.2
    group.links.new(cone.outputs[0], join.inputs[0])
    group.links.new(join.outputs[0], output.inputs[0])
    plane = build.square("Plane", size=0.5)
    plane.reference_tracer.infinite_plane = True
    plane.location.z = -9
    select_seen(attribute=True)
    said = capsys.readouterr().out
    assert said.count("nobody knows which of its own they come from") == 2
    assert "'Dual' shows faces" in said and set(stored(dual)) == {2}
    assert "'Made' shows faces" in said and set(stored(made)) == {1, 2}
    assert stored(made)[upwards(made).index(True)] == 1
    assert stored(plane) == [2]
    assert selected() == ["Dual", "Made"]


def test_the_mean_of_faces_is_none_of_them(looking, build, capsys):
    """Extruded edges get the mean of what their faces have."""
    obj = build.mesh("Roof", [(-1, 0, 0), (0, -1, 1), (0, 1, 1), (1, 0, 0)], [(0, 1, 2), (1, 3, 2)])
    group = nodes(obj, "GeometryNodeExtrudeMesh")
    node = next(n for n in group.nodes if n.bl_idname == "GeometryNodeExtrudeMesh")
    node.mode = "EDGES"
    node.inputs["Offset Scale"].default_value = 0.4
    obj.location.x = 0.5  # else what is extruded of the ridge is edge-on
    select_seen(attribute=True)
    assert "nobody knows which of its own they come from" in capsys.readouterr().out
    assert set(stored(obj)) <= {1, 2}


def test_frames_are_those_of_the_scene_which_goes_back(looking, build):
    """Seen in any frame, and in none."""
    scene = looking
    scene.frame_start, scene.frame_end = 1, 4
    scene.frame_set(2)
    build.cube("Cube", size=1, location=(0, 0, -3))
    lid = build.square("Lid", size=3)
    lid.keyframe_insert("location", frame=2)
    lid.location.x = 30
    lid.keyframe_insert("location", frame=3)
    for obj in bpy.data.objects["Cube"], lid:
        obj.select_set(False)
    scene.frame_set(2)
    select_seen()
    assert selected() == ["Lid"]
    select_seen(frames=True, attribute=True)
    assert selected() == ["Cube", "Lid"] and scene.frame_current == 2
    cube = bpy.data.objects["Cube"]
    assert stored(cube) == [int(up) for up in upwards(cube)]
    select_seen(frames=True, hidden=True)
    assert selected() == []


def test_nothing_of_it_stays_in_the_file(looking, build):
    cube = build.cube("Cube")
    modified(cube, "SUBSURF")
    kinds = ("objects", "meshes", "scenes", "node_groups", "cameras", "collections")
    before = {kind: [b.name for b in getattr(bpy.data, kind)] for kind in kinds}
    select_seen(attribute=True)
    assert {kind: [b.name for b in getattr(bpy.data, kind)] for kind in kinds} == before
    assert "reference_tracer_face" not in cube.data.attributes


def test_what_cannot_be_answered_is_an_error(looking, build):
    with pytest.raises(RuntimeError, match=r"shows no faces"):
        select_seen()
    cube = build.cube("Cube")
    bpy.context.scene.camera.data.type = "PANO"
    lens(bpy.context.scene.camera.data).panorama_type = "EQUIRECTANGULAR"
    with pytest.raises(RuntimeError, match=r"which faces are seen is decided for"):
        select_seen()
    bpy.context.scene.camera = None
    with pytest.raises(RuntimeError, match=r"has no camera"):
        select_seen()
    build.camera()
    bpy.context.view_layer.objects.active = cube
    bpy.ops.object.mode_set(mode="SCULPT")
    with pytest.raises(RuntimeError, match=r"Only in Object Mode and in Edit Mode of meshes"):
        select_seen()
    bpy.ops.object.mode_set(mode="OBJECT")
