"""A picture that rests on Blender's float32 is no agreement; and what is advised helps."""

from __future__ import annotations

import math
import re
from dataclasses import replace

import bpy
import numpy as np
import pytest
from reference_tracer.blender.jobs.compare import gather_case
from reference_tracer.comparison.comparing import compared
from reference_tracer.report.lines import describe
from reference_tracer.tracer.progress import result_of


def _camera(start, end):
    scene = bpy.context.scene
    scene.render.resolution_x, scene.render.resolution_y = 120, 68
    data = bpy.data.cameras.new("Camera")
    data.clip_start, data.clip_end = start, end
    camera = bpy.data.objects.new("Camera", data)
    scene.collection.objects.link(camera)
    scene.camera = camera
    return camera


def _far_wall():
    """A wall 35 km behind a cube."""
    bpy.ops.mesh.primitive_cube_add(size=3e4, location=(0, 5e4, 0))
    bpy.ops.mesh.primitive_cube_add(size=1.5)
    camera = _camera(1e-6, 1e6)
    camera.location, camera.rotation_euler = (0, -12, 4), (math.radians(75), 0, 0)


def _two_walls():
    """One wall 10 cm behind another, a kilometre away."""
    for name, y in (("Near", 1000), ("Far", 1000.1)):  # Blender draws them by name
        bpy.ops.mesh.primitive_plane_add(size=600, location=(0, y, 0), rotation=(1.5708, 0, 0))
        bpy.context.object.name = name
    _camera(0.001, 1e4).rotation_euler = (math.radians(90), 0, 0)


def _compared():
    return result_of(compared(gather_case(bpy.context, judge="WORKBENCH")))


@pytest.mark.parametrize(
    ("make", "verdict"), [(_far_wall, "not comparable"), (_two_walls, "warnings")]
)
def test_what_is_advised_helps(make, verdict):
    make()
    found = _compared()
    assert found.verdict == verdict and found.counts.unexplained == 0
    (advice,) = found.excused.advice
    start = re.search(r"raise the clip start from .* m to (\S+) m: surfaces", advice)
    assert any(advice in line for line in describe(found))
    bpy.context.scene.camera.data.clip_start = float(start[1])
    assert _compared().verdict == "agree"


def test_cycles_has_no_depth_buffer():
    """A picture of Cycles' that shows the farther wall is wrong; of Workbench, nobody knows."""
    _two_walls()
    for judge, unexplained in (("CYCLES", True), ("WORKBENCH", False)):
        case = gather_case(bpy.context, judge=judge)
        assert result_of(compared(case)).counts.unexplained == 0
        farther = case.scene.instances[case.scene.objects.index("Far")].colors[0]
        color = np.where(case.picture.color[..., 3:] > 0, farther, case.picture.color)
        shown = replace(case.picture, color=color.astype(np.float32), owners=None)
        found = result_of(compared(replace(case, picture=shown)))
        assert (found.counts.unexplained > 1000) is unexplained
