"""Scenes that are hard to judge, built and compared in the window: they are `tests/blender`'s."""

import sys
from pathlib import Path

import bpy
from story import compared, noted, press_compare, result, until, window

sys.path.insert(0, str(Path(__file__).parents[1] / "blender"))

import hard_cases as hard
from scenes import Build


def hard_scenes():
    """One after another, with the viewport as the judge, and whether each stayed as it was."""
    for make in PLAYED:
        bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
        yield
        try:
            yield from built_and_compared(make)
        except RuntimeError as error:  # of one scene: the others are played all the same
            noted[make.__name__] = {"failed": str(error)}


def built_and_compared(make):
    with bpy.context.temp_override(window=window()):
        make(Build())
    yield
    before = places()
    press_compare()
    yield from until(compared)
    comparison = result().content.to_dict()
    noted[make.__name__] = {
        "failed": "",
        "verdict": comparison["verdict"],
        "source": comparison["blender"]["source"],
        "unexplained": comparison["pixels"]["unexplained"],
        "same": places() == before,
    }


def places():
    """Where all that the viewport shows is."""
    with bpy.context.temp_override(window=window()):
        shown = bpy.context.evaluated_depsgraph_get().object_instances
        return sorted([i.object.name, *(x for row in i.matrix_world for x in row)] for i in shown)


PLAYED = (
    hard.particles,
    hard.cloth,
    hard.edited,
    hard.edited_shared,
    hard.particle_hair,
    hard.grease_pencil,
    hard.glass_pane,
    hard.in_front,
    hard.fine_edges,
)
SCENE = "suzanne"
STORIES = (hard_scenes,)
