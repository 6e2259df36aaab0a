"""What a 3D view shows, told of each update as a handler is: while `depsgraph.updates` names it."""

from __future__ import annotations

import bpy
import pytest
from reference_tracer.blender.live.scene import ViewScene
from reference_tracer.blender.reading import meshes
from reference_tracer.blender.reading.camera import export_camera
from reference_tracer.blender.reading.export import export as export_depsgraph

HANDLERS = bpy.app.handlers.depsgraph_update_post, bpy.app.handlers.frame_change_post


def space():
    """Return a 3D view's space; in an empty file there is one, too."""
    areas = bpy.context.window_manager.windows[0].screen.areas
    return next(area.spaces[0] for area in areas if area.type == "VIEW_3D")


class Counted(ViewScene):
    """Counts the meshes that its last update has read, and those of all."""

    meshes_read, reads = 0, 0

    def update(self, depsgraph, space):
        self.meshes_read = 0
        super().update(depsgraph, space)
        self.reads += self.meshes_read


@pytest.fixture
def kept(monkeypatch):
    """Give a ViewScene that hears of every update, and what its last updates have read."""
    scene = Counted()
    for name in dir(space()):  # Blender keeps a view while it opens an empty file
        if name.startswith("show_object_viewport_"):
            setattr(space(), name, True)

    def read_mesh(*arguments):
        found = meshes.read_mesh(*arguments)
        scene.meshes_read += found is not None
        return found

    def update(_, depsgraph):
        scene.update(depsgraph, space())

    monkeypatch.setattr("reference_tracer.blender.live.scene.read_mesh", read_mesh)

    for handlers in HANDLERS:
        handlers.append(update)
    yield scene
    for handlers in HANDLERS:
        if update in handlers:
            handlers.remove(update)


def contents(scene):
    """Return all that a scene holds but its camera, to be compared to the bit."""
    return (
        [
            [a if a is None else (a.dtype, a.shape, a.tobytes()) for a in arrays]
            for m in scene.meshes
            for arrays in [(m.vertices, m.triangles, m.slots, m.corner_colors)]
        ],
        [
            (i.mesh, i.object, i.world_from_object.tobytes(), i.colors.tobytes())
            for i in scene.instances
        ],
        [
            (p.object, p.point.tobytes(), p.normal.tobytes(), p.color.tobytes())
            for p in scene.planes
        ],
        scene.objects,
    )


def of_view(kept):
    return kept.scene(export_camera(bpy.context.scene))


def assert_as_a_whole_export(kept):
    """It is what an export of all has, of which all is in the view."""
    bpy.context.view_layer.update()
    whole, _ = export_depsgraph(bpy.context.evaluated_depsgraph_get())
    assert contents(of_view(kept)) == contents(whole)
    assert not kept.outdated(bpy.context.scene, space())
