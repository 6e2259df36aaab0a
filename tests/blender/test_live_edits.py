"""After any edits, what a 3D view shows is the same as a whole export, and seldom all is read."""

from __future__ import annotations

import bpy
import numpy as np
import pytest

from .live import assert_as_a_whole_export, of_view


class Edits:
    """A scene of all kinds, and what may be done to it. Each may be done at any time."""

    def __init__(self, build, rng):
        self.build, self.rng, self.count = build, rng, 0
        build.far_camera()
        red = build.material("Red", 1, 0, 0)
        cube = build.cube("Cube", material=red)
        build.object("Linked", cube.data).location.x = 3
        build.cube("Modified").modifiers.new("Array", "ARRAY")
        keyed = build.square("Keyed")
        for name in ("Basis", "Key"):
            key = keyed.shape_key_add(name=name)
        key.data[0].co.z = 1
        key.value = 0
        key.keyframe_insert("value", frame=1)
        key.value = 1
        key.keyframe_insert("value", frame=20)
        build.text("Text", location=(0, 3, 0))
        source = build.cube("Source", link=False)
        build.instances("Empty", build.collection("Kit", source), location=(-3, 0, 0))
        build.collection("Shelf", build.cube("On Shelf", link=False), link=True)
        build.instances_on_points(build.square("Points"), "GeometryNodeMeshCube")
        build.instances_on_points(build.square("Points of Source"), source)
        build.empty("Plane", location=(0, 0, -4)).reference_tracer.infinite_plane = True
        bpy.context.view_layer.update()

    def one(self, kind):
        found = [o for o in bpy.context.view_layer.objects if o and o.type == kind]
        return found[self.rng.integers(len(found))]

    def move(self):
        self.one(("MESH", "MESH", "EMPTY", "FONT")[self.rng.integers(4)]).location = (
            self.rng.normal(size=3) * 3
        )

    def turn(self):
        self.one("MESH").rotation_euler = self.rng.normal(size=3)

    def edit(self):
        mesh = self.one("MESH").data
        if len(mesh.vertices):
            mesh.vertices[0].co = self.rng.normal(size=3)
            mesh.update()

    def modifier(self):
        obj = self.one("MESH")
        if obj.modifiers:
            obj.modifiers.remove(obj.modifiers[0])
        else:
            obj.modifiers.new("Array", "ARRAY").count = self.rng.integers(1, 4)

    def remove(self):
        bpy.data.objects.remove(self.one("MESH"))
        self.build.cube(f"Instead {self.count}")

    def new(self):
        data = self.one("MESH").data if self.count % 2 else bpy.data.meshes.new("Faceless")
        self.build.object(f"New {self.count}", data)

    def other_data(self):
        self.one("MESH").data = self.one("MESH").data

    def material(self):
        bpy.data.materials["Red"].diffuse_color = (*self.rng.random(3), 1)

    def slot(self):
        self.one("MESH").data.materials.append(bpy.data.materials["Red"])

    def hide(self):
        obj = self.one("MESH")
        obj.hide_set(not obj.hide_get())

    def hide_viewport(self):
        obj = self.one("MESH")
        obj.hide_viewport = not obj.hide_viewport

    def shelf(self):
        shelf = bpy.context.view_layer.layer_collection.children["Shelf"]
        name = ("exclude", "hide_viewport")[self.rng.integers(2)]
        setattr(shelf, name, not getattr(shelf, name))

    def display(self):
        self.one("MESH").display_type = ("WIRE", "SOLID", "TEXTURED")[self.rng.integers(3)]

    def frame(self):
        bpy.context.scene.frame_set(int(self.rng.integers(1, 20)))

    def text(self):
        self.one("FONT").data.body = f"Ray {self.count}"

    def parent(self):
        child, parent = self.one("MESH"), self.one("EMPTY")
        if child.parent is None:
            child.parent = parent

    def rename(self):
        self.one("MESH").name = f"Named {self.count}"

    def editor(self):
        bpy.context.view_layer.update()
        bpy.context.view_layer.objects.active = obj = self.one("MESH")
        if obj.visible_get():
            bpy.ops.object.mode_set(mode="EDIT")
            bpy.ops.mesh.select_all(action="SELECT")
            bpy.ops.mesh.delete(type=("ONLY_FACE", "VERT")[self.rng.integers(2)])
            bpy.ops.mesh.primitive_cube_add()
            if self.count % 2:
                bpy.ops.mesh.primitive_cube_add(location=(0, 0, 2))
            bpy.ops.object.mode_set(mode="OBJECT")

    def undo(self):
        bpy.ops.ed.undo_push(message="before")
        self.any_but_undo()
        bpy.ops.ed.undo_push(message="after")
        bpy.ops.ed.undo()

    def any_but_undo(self):
        names = [n for n in vars(Edits) if n[0] != "_" and "undo" not in n and n != "one"]
        for _ in range(self.rng.integers(1, 4)):
            name = names[self.rng.integers(len(names))]
            self.count += 1
            self.done.append(name)
            getattr(self, name)()

    def __call__(self):
        self.done = []
        if self.rng.random() < 0.15:
            self.undo()
        else:
            self.any_but_undo()
        return self.done


@pytest.mark.parametrize("seed", range(4))
def test_after_any_edits_it_is_what_a_whole_export_has(seed, build, kept):
    edits = Edits(build, np.random.default_rng(seed))
    assert_as_a_whole_export(kept)
    less = 0
    for _ in range(30):
        done = edits()
        try:
            assert_as_a_whole_export(kept)
        except AssertionError as error:
            raise AssertionError(done) from error
        less += kept.meshes_read < len(of_view(kept).meshes)
    assert less > 15  # it is of use
