"""A render engine as an add-on registers it: a few lines of numpy, and faults to choose from.

It is no part of what it tests: it reads Blender's own meshes, matrices and colours.
"""

from __future__ import annotations

import bpy
import numpy as np


class ToyEngine(bpy.types.RenderEngine):
    bl_idname = "TOY_TRACER"
    bl_label = "Toy Tracer"

    offset = (0.0, 0.0)  # pixels, of every sample
    left_out = ""  # an object that is not drawn
    is_opaque = False  # a background of its own

    def render(self, depsgraph):
        scene = depsgraph.scene_eval  # the camera of the other may have an older matrix
        width, height = (
            n * scene.render.resolution_percentage // 100
            for n in (scene.render.resolution_x, scene.render.resolution_y)
        )
        color = np.zeros((height * width, 4), np.float32)
        if ToyEngine.is_opaque:
            color[:] = 0.2, 0.3, 0.4, 1.0
        origins, directions = self.rays(scene.camera, width, height)
        nearest = np.full(len(color), np.inf)
        for corners, rgb in self.triangles(depsgraph):
            t = moller_trumbore(origins, directions, *corners)
            closer = t < nearest
            nearest[closer] = t[closer]
            color[closer] = *rgb, 1.0
        result = self.begin_result(0, 0, width, height)
        result.layers[0].passes["Combined"].rect.foreach_set(color.ravel())
        self.end_result(result)

    def rays(self, camera, width, height):
        """Return origins and directions (n, 3) through the frame that Blender has of the camera."""
        corners = np.array(camera.data.view_frame(scene=bpy.context.scene))  # from the upper right
        matrix = np.array(camera.matrix_world)
        low, high = corners.min(axis=0), corners.max(axis=0)
        x, y = np.meshgrid(np.arange(width), np.arange(height))
        share = np.stack((x, y), axis=-1).reshape(-1, 2) + 0.5 + ToyEngine.offset
        film = low[:2] + share / (width, height) * (high - low)[:2]
        ways = np.column_stack((film, np.full(len(film), low[2]))) @ matrix[:3, :3].T
        return np.broadcast_to(matrix[:3, 3], ways.shape), ways

    def triangles(self, depsgraph):
        """Yield the corners (3, 3) of every triangle in world space, and its colour."""
        for instance in depsgraph.object_instances:
            obj = instance.object
            if obj.type != "MESH" or obj.name == ToyEngine.left_out or not instance.show_self:
                continue
            mesh, matrix = obj.data, np.array(instance.matrix_world)
            mesh.calc_loop_triangles()
            for triangle in mesh.loop_triangles:
                local = np.array([mesh.vertices[v].co for v in triangle.vertices])
                yield local @ matrix[:3, :3].T + matrix[:3, 3], obj.color[:3]


def moller_trumbore(origins, directions, p1, p2, p3):
    """Return t (n,), infinite where a ray misses."""
    e1, e2 = p2 - p1, p3 - p1
    h = np.cross(directions, e2)
    det = h @ e1
    with np.errstate(divide="ignore", invalid="ignore"):
        s = origins - p1
        u = (s * h).sum(axis=1) / det
        q = np.cross(s, e1)
        v = (directions * q).sum(axis=1) / det
        t = q @ e2 / det
        hit = (u >= 0) & (v >= 0) & (u + v <= 1) & (t > 0)
    return np.where(hit, t, np.inf)
