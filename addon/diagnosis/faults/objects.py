"""Faults of the scene's objects: which are there, where, and how large."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, replace

import numpy as np

from ...causes.case import Case
from ...pictures.picture import MAJORITY
from ...scene import Instance, Scene
from ...tracer.camera import pixel_size
from ...tracer.frame import Frame
from ...tracer.progress import at_once
from ...wording import listed
from ..evidence import LEAST_SEEN, Evidence
from .changes import MOVED, SCALED, TURNED
from .fault import (
    AnyFault,
    Effort,
    Example,
    Fault,
    Guess,
    Key,
    Numbers,
    always,
    keys_of,
    of_object,
)
from .object_matrices import OBJECT_MATRIX_FAULTS
from .pose import Posed, posing
from .search import values_of
from .suspects import largest, seen_instances, suspects

NAMED = 4  # objects
UNITS = (0.01, 100.0, 0.001, 1000.0, 0.1, 10.0, 0.0254, 1 / 0.0254, 0.3048, 1 / 0.3048)


@dataclass(frozen=True, eq=False)
class Several(Guess):
    """Some instances."""

    keys: frozenset[Key]


def _without(case: Case, guess: Several) -> Case:
    """Return the case without some instances."""

    def without(scene: Scene) -> Scene:
        pairs = zip(keys_of(scene), scene.instances, strict=False)
        return replace(scene, instances=tuple(i for key, i in pairs if key not in guess.keys))

    return case.with_scenes(without)


@at_once
def _not_shown(evidence: Evidence) -> list[Several]:
    """Guess that each instance is left out if most of its pixels are unexplained."""
    scene, index = evidence.case.scene, evidence.frame.instance_index
    count = len(scene.instances)
    seen, wrong = (
        np.bincount(index[where & (index >= 0)], minlength=count)[:count]
        for where in (index >= 0, evidence.unexplained)
    )
    gone = np.flatnonzero((wrong > MAJORITY * seen) & (wrong >= LEAST_SEEN))
    if not 1 < len(gone) < (seen > 0).sum():
        return []
    keys = [keys_of(scene)[n] for n in gone]
    named = Counter(name for name, _ in keys)
    words = [f"'{name}'" + f" ({n})" * (n > 1) for name, n in named.most_common()]
    return [Several(frozenset(keys), words=listed(words, NAMED))]


def _a_pixel_to_the_right(case: Case, frame: Frame) -> Posed | None:
    """Pick the object visible in the most pixels, moved by a pixel to the right."""
    seen = seen_instances(case, frame)
    if not seen:
        return None
    camera = case.scene.camera
    depth = float(np.median(frame.t[frame.instance_index == seen[0]]))
    move = pixel_size(camera)[0] * camera.projection.scale(depth) * camera.right
    name = case.scene.objects[case.scene.instances[seen[0]].object]
    return Posed(values_of(move), object=name)


def _whole(instance: Instance, factor: float) -> Instance:
    """Scale an instance about the world's origin."""
    matrix = instance.world_from_object.copy()
    matrix[:3] *= factor
    return replace(instance, world_from_object=matrix)


OBJECT_FAULTS: tuple[AnyFault, ...] = (
    Fault(
        "nothing_shown",
        "nothing of the scene is in the picture",
        "The camera looks elsewhere, or stands inside an object or too far away; or "
        "everything was hidden or skipped.",
        "check where the camera is and looks, and whether anything is rendered",
        lambda case, guess: case.with_scenes(lambda scene: replace(scene, instances=(), planes=())),
        sums_up=True,
        witness="facebookresearch/pytorch3d#1308",
    ),
    Fault(
        "object_missing",
        "'{object}' is missing",
        "Exporters skip objects that are no meshes (curves, texts, metaballs), "
        "instances, or objects that are hidden in the viewport only.",
        "check why it was not exported, or is hidden",
        of_object(lambda instance: None),
        suspects,
        removes=True,
        examples=(Example("dropped_instance", "the largest object left out", largest),),
        witness="KhronosGroup/glTF-Blender-IO#2726",
    ),
    Fault(
        "instances_missing",
        "several objects or instances are missing: {words}",
        "Exporters write each mesh once, and leave out what instances it: collections, particles, "
        "geometry nodes.",
        "write what `depsgraph.object_instances` lists, each with a matrix of its own",
        _without,
        _not_shown,
        words="which, and how many",
        witness="KhronosGroup/glTF-Blender-IO#1537",
    ),
    *OBJECT_MATRIX_FAULTS,
    Fault(
        "object_scaled",
        "'{object}' is {words}",
        "FBX files are in centimetres, CAD files often in millimetres, Blender's in metres. Of "
        "three factors one is stored; a negative one, or the delta scale, is left out.",
        "check the units (100 is metres for centimetres), and multiply its vertices by its whole "
        "world matrix",
        **posing(*SCALED, exact=UNITS),
        numbers=("factor", "factor_y", "factor_z"),
        effort=Effort.OBJECT,
        words="some times as large, about its origin, base or middle, or along its own axes",
        witness="assimp/assimp#775",
    ),
    Fault(
        "scene_scaled",
        "all objects are {factor:.4g} times as large, and the camera is not",
        "The unit of the scene, or of the file format, is applied to the meshes only.",
        "use the same unit for the meshes and the camera",
        of_object(_whole),
        always(*(Numbers((factor,)) for factor in UNITS)),
        ("factor",),
        effort=Effort.VIEW,  # with what shows nothing: all that is left of it may be a few pixels
        witness="thodan/obj_pose_eval#1",
    ),
    Fault(
        "object_moved",
        "'{object}' is moved by ({x:+.4g}, {y:+.4g}, {z:+.4g}) m",
        "Its delta transform, a constraint or its animation is left out, or the exporter "
        "centred its mesh.",
        "compare its world matrix with the one that the scene has",
        **posing(*MOVED),
        numbers=("x", "y", "z"),
        effort=Effort.OBJECT,
        examples=(
            Example("moved_object", "the largest object moved by a pixel", _a_pixel_to_the_right),
        ),
        witness="AsoboStudio/Microsoft-Flight-Simulator-2020-glTF-Blender-IO#98",
    ),
    Fault(
        "object_turned",
        "'{object}' is turned by {words}",
        "A file with Y up is read as one with Z up, or turned twice; the delta rotation, or the "
        "order of the angles, is left out.",
        "compare its world matrix with the one that the scene has",
        **posing(*TURNED),
        numbers=("degrees", "degrees_y", "degrees_z"),
        effort=Effort.OBJECT,
        words="some degrees about an axis, such as one of its own",
        witness="rdb/blender-egg-importer#2",
    ),
    Fault(
        "object_twice",
        "'{object}' is there twice: again at ({x:+.4g}, {y:+.4g}, {z:+.4g}) m from its place",
        "Blender doesn't draw the object itself where its parent instances it on "
        "vertices or faces; an exporter writes both.",
        "look for a second export of it, as an instance or a duplicate",
        **posing(*MOVED, kept=True),
        numbers=("x", "y", "z"),
        effort=Effort.ANYTHING,
        witness="LuxCoreRender/BlendLuxCore#366",
    ),
)
