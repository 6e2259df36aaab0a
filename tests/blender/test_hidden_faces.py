"""Faces that Edit Mode hides are traced where Blender draws them, and nowhere else."""

from __future__ import annotations

from dataclasses import replace

import bpy
import numpy as np
import pytest
from reference_tracer.blender.jobs.compare import gather_case
from reference_tracer.comparison.comparing import compared
from reference_tracer.tracer.progress import result_of

from .hard_cases.edited import hide_faces

JUDGES = ("WORKBENCH", "CYCLES")
MODIFIERS = ("", "SUBSURF", "CAST")


def edited(build, modifier: str, step: int, color_type: str = "MATERIAL") -> None:
    """A mesh of two cubes side by side, edited as the one, with hidden faces."""
    build.scene(color_type=color_type)
    one = build.cube("One", 1, location=(-1, 0, 0), rotation=(0.4, 0.3, 0))
    other = build.object("Other", one.data)
    other.location, other.rotation_euler = (1, 0, 0), (0.2, 0.7, 0)
    if modifier:
        one.modifiers.new(modifier, modifier)
    build.camera()
    bpy.context.view_layer.objects.active = one
    bpy.ops.object.mode_set(mode="EDIT")
    hide_faces(one.data, step)


@pytest.mark.parametrize("judge", JUDGES)
@pytest.mark.parametrize("step", [1, 2], ids=["all hidden", "half hidden"])
@pytest.mark.parametrize("shown", [True, False], ids=["", "modifier is off in Edit Mode"])
@pytest.mark.parametrize("modifier", MODIFIERS)
def test_no_false_alarm(modifier, shown, step, judge, build, compare):
    edited(build, modifier, step)
    for own in bpy.data.objects["One"].modifiers:
        own.show_in_editmode = shown
    found = compare(judge=judge)
    assert found.counts.unexplained == 0


@pytest.mark.parametrize("judge", JUDGES)
def test_in_object_mode_all_faces_are_drawn(judge, build, compare):
    edited(build, "", 1)
    bpy.ops.object.mode_set(mode="OBJECT")
    assert all(face.hide for face in bpy.data.meshes[0].polygons)
    found = compare(judge=judge)
    assert found.verdict == "agree" and not found.empty


def test_corner_colours_stay_with_their_faces(build, compare):
    edited(build, "", 2, "VERTEX")
    bpy.ops.object.mode_set(mode="OBJECT")
    build.color_attribute(bpy.data.objects["One"], "CORNER")
    bpy.ops.object.mode_set(mode="EDIT")
    hide_faces(bpy.data.meshes[0], 2)
    found = compare(judge="WORKBENCH")
    assert found.verdict == "agree" and not found.empty


@pytest.mark.parametrize("judge", JUDGES)
def test_a_picture_of_the_other_judge_is_not_excused(judge, build):
    """Hidden faces that are drawn, and shown ones that are not: both are found."""
    edited(build, "", 2)
    here = gather_case(bpy.context, judge=judge)
    other = gather_case(bpy.context, judge=next(j for j in JUDGES if j != judge))
    assert (here.picture.color != other.picture.color).any(axis=-1).sum() > 50
    owners = replace(here.picture.owners, pixels=other.picture.owners.pixels)
    wrong = replace(here.picture, color=np.array(other.picture.color), owners=owners)
    found = result_of(compared(replace(here, picture=wrong)))
    assert found.verdict == "differences" and found.counts.unexplained > 50
