"""Scenes that simulate, are edited, grow hair or are of glass: no false alarm, no false excuse.

The scenes are in `hard_cases`. What a scene is hard for is also checked to be there: a verdict on a
scene that shows nothing hard proves nothing.
"""

from __future__ import annotations

import subprocess
import sys
from dataclasses import replace
from itertools import product

import bpy
import numpy as np
import pytest
from reference_tracer.blender.drawing.judges import judge_named
from reference_tracer.blender.drawing.picture import drawn_once, prepare_scene
from reference_tracer.blender.jobs.against import gather_against
from reference_tracer.blender.jobs.compare import gather_case
from reference_tracer.blender.jobs.stepping import bake_bodies
from reference_tracer.blender.reading.camera import export_camera
from reference_tracer.causes.explain import NOT_MODELLED, UNEXPLAINED
from reference_tracer.comparison.comparing import trace_and_compare
from reference_tracer.pictures.palette import By
from reference_tracer.tracer.progress import result_of

from ..sampled import daily
from . import hard_cases as hard
from .test_unchanged import differences, snapshot, state

JUDGES = ("WORKBENCH", "CYCLES")
SEEN = 20  # pixels: enough to be no edge
AGREE, WARNINGS, NOT_COMPARABLE = "agree", "warnings", "not comparable"

# What Cycles draws otherwise than Workbench: its constant colours know no transparency, no texture
# and nothing in front; its hairs are as thin as they are, so that a lawn is mostly seen through.
NOT_OF_CYCLES = (*hard.GLASS, *hard.IN_FRONT, hard.glass_around)
OF_CYCLES_ALONE = (hard.unseen_by_camera_rays, hard.holdout)
WARNED_OF = (
    *hard.HAIR,
    *hard.GLASS,
    *hard.IN_FRONT,
    *hard.EMPTY,
    hard.no_active_color,
)
TOO_MUCH = (hard.hair_everywhere, hard.glass_around)
DRAWN_OTHERWISE = (*hard.HAIR, *hard.GLASS, *hard.IN_FRONT, *TOO_MUCH)
MAY_BE_UPSET = (*hard.SIMULATIONS, *hard.EDIT_MODE, *hard.HAIR)  # by being drawn


def verdict_of(make, judge: str) -> str:
    if make is hard.far_from_origin:  # where no pixel is decidable
        return NOT_COMPARABLE
    if judge == "CYCLES":
        # Of a scene with one, 4.2 rounds each colour to a half float: it may be under all of them.
        if bpy.app.version < (4, 3, 0) and make in (hard.grease_pencil, hard.empty_grease_pencil):
            return NOT_COMPARABLE
        if make in NOT_OF_CYCLES:
            return AGREE
        if make in OF_CYCLES_ALONE or make is hard.hair_everywhere:
            return WARNINGS
    if make in TOO_MUCH:
        return NOT_COMPARABLE
    return WARNINGS if make in WARNED_OF else AGREE


def name_of(make) -> str:
    return make.__name__


def id_of(value) -> str:
    """Return the name of a scene's function, or of a judge."""
    return getattr(value, "__name__", value)


def shown_otherwise(comparison) -> np.ndarray:
    """Return which pixels (h, w) are of another colour than the traced ones, edges or not."""
    return (np.abs(comparison.frame.color - comparison.picture) > 0.02).any(axis=-1)


def around(mask: np.ndarray, pixels: int = 2) -> np.ndarray:
    """Return a mask widened by so many pixels."""
    out = np.pad(mask, pixels)
    for axis in (0, 1):
        out = np.any([np.roll(out, n, axis) for n in range(-pixels, pixels + 1)], axis=0)
    return out[pixels:-pixels, pixels:-pixels]


def user_state() -> dict:
    """Everything of `test_unchanged.state`, and what drawing without something could touch."""
    return state() | {
        "drawn": {
            obj.name_full: (
                list(obj.color),
                obj.display_type,
                obj.show_in_front,
                obj.show_instancer_for_render,
                obj.show_instancer_for_viewport,
                obj.mode,
                [(m.name, m.show_render, m.show_viewport) for m in obj.modifiers],
            )
            for obj in bpy.data.objects
        },
        "particles": {p.name: snapshot(p, 0) for p in bpy.data.particles},
        "materials": {m.name: list(m.diffuse_color) for m in bpy.data.materials},
    }


def evaluated_geometry() -> list:
    """Where everything is and how it is deformed, as the user sees it in the viewport."""
    bpy.context.view_layer.update()
    out = []
    for item in bpy.context.evaluated_depsgraph_get().object_instances:
        obj, points = item.object, []
        if obj.type == "MESH":
            mesh = obj.to_mesh()
            points = np.empty(len(mesh.vertices) * 3, np.float32)
            mesh.vertices.foreach_get("co", points)
            points = [len(points), float(points.sum()), float(np.abs(points).sum())]
            obj.to_mesh_clear()
        out.append((obj.name_full, np.array(item.matrix_world).ravel().tolist(), points))
    return sorted(out)


def judged(scenes: tuple, with_cycles: tuple) -> list:
    """Return each scene with each judge: with Cycles, those that are named every day."""
    return [
        pytest.param(make, judge, marks=() if daily else pytest.mark.torture)
        for make in scenes
        for judge in JUDGES
        for daily in [judge == "WORKBENCH" or make in with_cycles]
    ]


OF_EVERY_DAY = (*hard.ALL[::6], *NOT_OF_CYCLES, *OF_CYCLES_ALONE, *TOO_MUCH)


@pytest.mark.parametrize(("make", "judge"), judged(hard.ALL, OF_EVERY_DAY), ids=id_of)
def test_no_false_alarm(make, judge, build, compare):
    make(build)
    found = compare(judge=judge)
    assert found.counts.unexplained == 0
    assert found.verdict == verdict_of(make, judge)
    otherwise = shown_otherwise(found)
    if judge == "WORKBENCH" and make in DRAWN_OTHERWISE:
        assert otherwise.sum() > SEEN
        assert (found.causes.cause[otherwise] == NOT_MODELLED).mean() > 0.9
    if judge == "WORKBENCH" and make in TOO_MUCH:
        assert otherwise.mean() > 0.5
    if judge == "CYCLES" and make in OF_CYCLES_ALONE:
        assert otherwise.sum() > SEEN
    if make is hard.fine_edges:
        assert found.counts.boundary.total > 5000
    if make in hard.EMPTY:
        assert not found.picture.any() and not found.frame.color.any()


@pytest.mark.parametrize(
    ("make", "judge"),
    [
        *daily((make, "WORKBENCH") for make in (*hard.EDIT_MODE, *hard.HAIR)),
        *judged(hard.SIMULATIONS, hard.SIMULATIONS[::3]),
    ],
    ids=id_of,
)
def test_leaves_the_users_data_and_simulation_alone(make, judge, build, compare):
    make(build)
    geometry, before = evaluated_geometry(), user_state()
    frame = bpy.context.scene.frame_current
    found = compare(judge=judge)
    assert differences(before, user_state()) == []
    assert evaluated_geometry() == geometry
    assert bpy.context.scene.frame_current == frame
    again = compare(judge=judge)
    assert again.counts == found.counts
    np.testing.assert_array_equal(again.picture, found.picture)


def own_picture() -> np.ndarray:
    """The user's own scene, not a copy of it, as Workbench draws it in constant colours."""
    scene = bpy.context.scene
    engine = judge_named("WORKBENCH", True)
    prepare_scene(scene, engine, True)
    return drawn_once(scene, engine, export_camera(scene), True)


@pytest.mark.parametrize("make", daily(MAY_BE_UPSET), ids=name_of)
def test_compares_what_the_user_would_render(make, build, compare):
    make(build)
    found = compare(judge="WORKBENCH", colors=By.VIEWPORT).picture
    np.testing.assert_array_equal(found, own_picture())


def test_rigid_bodies_that_are_not_baked(build, compare):
    """A copy of a scene has no cache of them: they must not be compared where they began."""
    hard.rigid_body(build)
    geometry, before = evaluated_geometry(), user_state()
    found = compare(judge="WORKBENCH")
    assert differences(before, user_state()) == []
    assert evaluated_geometry() == geometry
    assert found.counts.unexplained == 0
    assert found.verdict != AGREE or (found.picture == own_picture()).all()


# A Blender of its own: one that frees what it still uses ends at once, and all tests with it.
PLAYED_ON = """
import sys, bpy, reference_tracer
from reference_tracer.blender.jobs.compare import gather_case
reference_tracer.register()
bpy.ops.wm.open_mainfile(filepath=sys.argv[1], load_ui=False)
scene = bpy.context.scene
for frame in (*range(1, 9), 1, 2, 1):
    scene.frame_set(frame)
    gather_case(bpy.context, judge="WORKBENCH")
    print("PLACES", [list(o.matrix_world.translation) for o in scene.objects])
reference_tracer.unregister()
"""


def test_rigid_bodies_fall_on_after_a_comparison(build, tmp_path):
    """What a copy of the scene simulates is the user's own bodies, which go with the copy."""
    hard.rigid_body(build)
    path, scene = str(tmp_path / "falling.blend"), bpy.context.scene
    bpy.ops.wm.save_as_mainfile(filepath=path)
    argv = [sys.executable, "-c", PLAYED_ON, path]
    done = subprocess.run(argv, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr
    played = []
    for frame in (*range(1, 9), 1, 2, 1):
        scene.frame_set(frame)
        played.append(f"PLACES {[list(o.matrix_world.translation) for o in scene.objects]}")
    assert [x for x in done.stdout.splitlines() if x.startswith("PLACES")] == played
    assert len(set(played)) == 8


@pytest.mark.parametrize("now", [1, 3])
def test_no_copy_simulates_the_second_frame_of_rigid_bodies(now, build):
    """Not for the frame before or after either: Blender crashes at the exit, once in 20 times."""
    hard.rigid_body(build)
    scene = bpy.context.scene
    bake_bodies(scene, 4)
    scene.objects["Body 0"].keyframe_insert("hide_render")  # something is animated
    scene.frame_set(now)
    stepped = set()

    def noted(stepping, _):
        stepped.add((stepping == scene, stepping.frame_current, stepping.rigidbody_world.enabled))

    bpy.app.handlers.frame_change_pre.append(noted)
    try:
        case = gather_case(bpy.context, judge="WORKBENCH", identity=False, self_check=True)
        gather_against(bpy.context, case.picture, case.settings, False)
    finally:
        bpy.app.handlers.frame_change_pre.remove(noted)
    assert (False, 2, False) in stepped and (False, 2, True) not in stepped
    assert scene.rigidbody_world.enabled and scene.frame_current == now


@pytest.mark.parametrize("make", hard.EDIT_MODE, ids=name_of)
def test_edited_objects_are_in_edit_mode_and_in_the_picture(make, build):
    make(build)
    obj = bpy.data.objects["Edited"]
    assert obj.mode == "EDIT"
    colors = By.VIEWPORT
    case = gather_case(bpy.context, judge="WORKBENCH", identity=False, colors=colors)
    assert obj.mode == "EDIT"
    for rgb in (hard.ORANGE, hard.CYAN):
        assert (np.abs(case.picture.color[..., :3] - rgb).max(axis=-1) < 0.01).sum() > SEEN


def mirrored(case):
    """The picture from right to left."""
    shown = case.picture
    owners = shown.owners.at(np.s_[:, ::-1])
    return replace(case, picture=replace(shown, color=shown.color[:, ::-1].copy(), owners=owners))


def recoloured(case):
    """One object of the picture in half its colour."""
    color = case.picture.color.copy()
    owners = case.picture.owners
    color[owners.pixels == owners.names.index("Red"), :3] *= 0.5
    return replace(case, picture=replace(case.picture, color=color))


def dropped(case):
    """One object missing in what is traced."""
    scene = case.scene
    [gone] = [n for n, i in enumerate(scene.instances) if scene.objects[i.object] == "Red"]
    instances = scene.instances[:gone] + scene.instances[gone + 1 :]
    return case.in_scene(replace(scene, instances=instances))


@pytest.fixture(scope="module")
def sound_cases():
    """What was gathered of a scene, and its comparison: neither holds anything of Blender's."""
    return {}


HARD_TO_DRAW = *hard.HAIR, *hard.GLASS, *hard.IN_FRONT


@pytest.mark.parametrize(
    ("make", "damage"), daily(product(HARD_TO_DRAW, (mirrored, recoloured, dropped))), ids=name_of
)
def test_no_false_excuse(make, damage, build, sound_cases):
    """A fault is found wherever the hard thing is not: not only outside of a box around it."""
    if make not in sound_cases:
        make(build)
        case = gather_case(bpy.context, judge="WORKBENCH")
        sound_cases[make] = case, result_of(trace_and_compare(case))
    case, sound = sound_cases[make]
    found = result_of(trace_and_compare(damage(case)))
    assert found.verdict == "differences"
    changed = (np.abs(found.picture - sound.picture) > 0.02).any(axis=-1)
    changed |= (np.abs(found.frame.color - sound.frame.color) > 0.02).any(axis=-1)
    plain = changed & shown_otherwise(found) & ~around(shown_otherwise(sound))
    if damage is mirrored:  # what is hard was mirrored, too
        plain &= ~around(shown_otherwise(sound)[:, ::-1])
    assert plain.sum() > SEEN
    assert (found.causes.cause[plain] == UNEXPLAINED).mean() > 0.9
