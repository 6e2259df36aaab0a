"""Faults of the scene's objects: which are there, where, and how large."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ...scene import Instance
from ...tracer.camera import pixel_size
from ...tracer.frame import Frame
from ...tracer.progress import Work
from ..case import Case
from ..evidence import Evidence
from .fault import Example, Fault, Guess, of_object
from .pose import DISPLACED, MOVED, SCALED, TWICE, copied, inflated, moved, scaled
from .suspects import largest, seen_instances, suspects

UNITS = (0.01, 100.0, 0.001, 1000.0, 0.1, 10.0, 0.0254, 1 / 0.0254, 0.3048, 1 / 0.3048)


def _a_pixel_to_the_right(case: Case, frame: Frame) -> Guess | None:
    """Pick the object that is seen in the most pixels, moved by a pixel of them."""
    seen = seen_instances(case, frame)
    if not seen:
        return None
    camera = case.scene.camera
    depth = float(np.median(frame.t[frame.instance_index == seen[0]]))
    move = pixel_size(camera)[0] * camera.projection.scale(depth) * camera.right
    name = case.scene.objects[case.scene.instances[seen[0]].object]
    return Guess(tuple(float(v) for v in move), object=name)


def _without_parts(instance: Instance, part: float) -> Instance:
    """Leave out an instance's transform, or the rotation, scale or place in it."""
    matrix = instance.world_from_object
    axes, lengths = matrix[:3, :3], np.linalg.norm(matrix[:3, :3], axis=0)
    lengths = np.where(lengths > 0, lengths, 1)
    other = matrix.copy()
    if part == 0:
        other = np.eye(4)
    elif part == 1:
        other[:3, :3] = np.diag(lengths)
    elif part == 2:
        other[:3, :3] = axes / lengths
    else:
        other[:3, 3] = 0
    return replace(instance, world_from_object=other)


def _units_or_fitted(evidence: Evidence) -> Work[list[Guess]]:
    """Return factors between units for each object that is suspected, and one that is fitted."""
    fitted = yield from SCALED[0](evidence)
    return [*(yield from suspects(*UNITS)(evidence)), *fitted]


def _whole(instance: Instance, factor: float) -> Instance:
    """Scale an instance about the world's origin."""
    matrix = instance.world_from_object.copy()
    matrix[:3] *= factor
    return replace(instance, world_from_object=matrix)


def _units(evidence: Evidence) -> Work[list[Guess]]:
    return [Guess((factor,)) for factor in UNITS]
    yield


OBJECT_FAULTS = (
    Fault(
        "nothing_shown",
        "nothing of the scene is in the picture",
        "check where the camera is and looks, and whether anything is rendered",
        lambda case, frame, guess: case.with_scenes(
            lambda scene: replace(scene, instances=(), planes=())
        ),
        sums_up=True,
    ),
    Fault(
        "object_missing",
        "'{object}' is missing",
        "check why it was not exported, or is hidden",
        of_object(lambda instance: None),
        suspects(),
        examples=(Example("dropped_instance", "the largest object left out", largest),),
    ),
    Fault(
        "transform_left_out",
        "the transform of '{object}' is left out",
        "multiply its vertices by its world matrix",
        of_object(lambda instance: _without_parts(instance, 0)),
        suspects(),
    ),
    Fault(
        "rotation_left_out",
        "the rotation of '{object}' is left out",
        "multiply its vertices by its whole world matrix",
        of_object(lambda instance: _without_parts(instance, 1)),
        suspects(),
    ),
    Fault(
        "scale_left_out",
        "the scale of '{object}' is left out",
        "multiply its vertices by its whole world matrix",
        of_object(lambda instance: _without_parts(instance, 2)),
        suspects(),
    ),
    Fault(
        "place_left_out",
        "'{object}' is at the world's origin",
        "multiply its vertices by its whole world matrix",
        of_object(lambda instance: _without_parts(instance, 3)),
        suspects(),
    ),
    Fault(
        "object_scaled",
        "'{object}' is {factor:.4g} times as large",
        "check the units: a factor of 100 is metres for centimetres",
        of_object(scaled),
        _units_or_fitted,
        ("factor",),
        refine=SCALED[1],
        effort=2,
    ),
    Fault(
        "scene_scaled",
        "all objects are {factor:.4g} times as large, and the camera is not",
        "use the same unit for the meshes and the camera",
        of_object(lambda instance, factor: _whole(instance, factor)),
        lambda evidence: _units(evidence),
        ("factor",),
    ),
    Fault(
        "object_moved",
        "'{object}' is moved by ({x:+.4g}, {y:+.4g}, {z:+.4g}) m",
        "compare its world matrix with the one that the scene has",
        of_object(moved),
        MOVED[0],
        ("x", "y", "z"),
        refine=MOVED[1],
        effort=3,
        examples=(
            Example("moved_object", "the largest object moved by a pixel", _a_pixel_to_the_right),
        ),
    ),
    Fault(
        "object_twice",
        "'{object}' is there twice: again at ({x:+.4g}, {y:+.4g}, {z:+.4g}) m from its place",
        "look for a second export of it, as an instance or a duplicate",
        copied,
        TWICE[0],
        ("x", "y", "z"),
        refine=TWICE[1],
        effort=4,
    ),
    Fault(
        "smooth_displaced",
        "the vertices of '{object}' are displaced along their normals by {distance:+.4g} m",
        "check a displacement's strength and midlevel, and whether normals are smooth",
        inflated,
        DISPLACED[0],
        ("distance",),
        refine=DISPLACED[1],
        effort=2,
    ),
)
