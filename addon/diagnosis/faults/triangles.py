"""Faults of objects' triangles: which are there, how quads are cut, which side is shown."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ...arrays import Bools, Places
from ...causes.case import Case
from ...causes.checks.probe import SOUND
from ...projections import ORTHOGRAPHIC
from ...rendering import frame_of
from ...scene import Mesh, Scene
from ...tracer.frame import Frame
from ...tracer.progress import Work
from ...tracer.vector import dot
from ...tracer.world import planes_of
from ..evidence import Evidence, least_with
from .fault import AnyFault, Effort, Example, Fault, Guess, instances_named, of_meshes
from .suspects import seen_instances


def with_triangles(mesh: Mesh, left: Bools | slice, corners: slice = slice(None)) -> Mesh:
    """Return a mesh with some of its triangles, and their corners reordered."""
    colors = None if mesh.corner_colors is None else mesh.corner_colors[left][:, corners]
    triangles = mesh.triangles[left][:, corners]
    return replace(mesh, triangles=triangles, slots=mesh.slots[left], corner_colors=colors)


def _other_diagonal(mesh: Mesh) -> Mesh:
    """Cut every quad along its other diagonal: (a, b, c) and (a, c, d), one after the other."""
    triangles = mesh.triangles.copy()
    k = 0
    first, second = triangles[:-1], triangles[1:]
    pairs = (first[:, 0] == second[:, 0]) & (first[:, 2] == second[:, 1])
    while k < len(pairs):
        if pairs[k]:
            a, b, c = triangles[k]
            d = triangles[k + 1, 2]
            triangles[k], triangles[k + 1] = (a, b, d), (b, c, d)
            k += 1
        k += 1
    return replace(mesh, triangles=triangles)


def _culled(case: Case, guess: Guess) -> Case:
    """Leave out the back faces."""

    def culled(scene: Scene) -> Scene:
        meshes: dict[int, Mesh] = {}
        camera = scene.camera
        for n, instance in enumerate(scene.instances):
            mesh = scene.meshes[instance.mesh]
            every = np.arange(len(mesh.triangles))
            points, normals = planes_of(scene, np.full_like(every, n), every)
            is_parallel = camera.projection is ORTHOGRAPHIC
            along = camera.forward[:, None] if is_parallel else points - camera.origin[:, None]
            front = dot(normals, along)  # the textbook's normals point inwards
            front *= np.sign(np.linalg.det(instance.world_from_object[:3, :3]))
            meshes[n] = with_triangles(mesh, front >= 0)  # Blender turns the normals back
        return scene.with_meshes(meshes)

    return case.with_scenes(culled)


@dataclass(frozen=True, eq=False)
class Triangles(Guess):
    """The triangles that an instance lacks, by index."""

    rank: int  # among the object's instances: another scene may number them otherwise
    missing: Places


def _a_triangle(case: Case, frame: Frame) -> Triangles | None:
    """Pick the triangle of the largest object that is visible in the most pixels."""
    if not (seen := seen_instances(case, frame)):
        return None
    own = frame.triangle_index[frame.instance_index == seen[0]]
    name = case.scene.objects[case.scene.instances[seen[0]].object]
    rank = instances_named(case.scene, name).index(seen[0])
    return Triangles(rank, np.bincount(own).argmax(keepdims=True), object=name, values=(1.0,))


def _without_triangles(case: Case, guess: Triangles) -> Case:
    """Drop the missing triangles of an instance."""
    rank = guess.rank

    def less(scene: Scene) -> Scene:
        own = instances_named(scene, guess.object)
        if rank >= len(own):
            return scene
        mesh = scene.meshes[scene.instances[own[rank]].mesh]
        left = ~np.isin(np.arange(len(mesh.triangles)), guess.missing)
        return scene.with_meshes({own[rank]: with_triangles(mesh, left)})

    return case.with_scenes(less)


LEAST_WRONG = 2  # pixels of a triangle that is missing
MOST_LAYERS = 6  # of triangles one behind another
MOST_INSTANCES = 4  # of an object, of which triangles may be missing
MOST_TRIANGLES = 4096  # of an instance that may be missing


def _missing_triangles(evidence: Evidence) -> Work[list[Triangles]]:
    """Guess the missing triangles of each suspect, layer by layer.

    Its instances with the most unexplained pixels are tried.
    """
    seen = evidence.frame.instance_index[evidence.unexplained]
    count = np.bincount(seen[seen >= 0], minlength=len(evidence.case.scene.instance_objects))
    out = []
    for name in evidence.suspects:
        own = instances_named(evidence.case.scene, name)
        ranks = sorted(range(len(own)), key=lambda rank: -count[own[rank]])
        for rank in ranks[:MOST_INSTANCES]:
            if count[own[rank]]:
                guess = yield from _peeled(evidence, name, own[rank], rank)
                out += [guess] if guess else []
    return out


def _peeled(evidence: Evidence, name: str, instance: int, rank: int) -> Work[Triangles | None]:
    """Drop an instance's wrong triangles, then the wrong ones behind them, and so on."""
    case, frame = evidence.case, evidence.frame
    wrong = evidence.unexplained
    mesh = case.scene.meshes[case.scene.instances[instance].mesh]
    every = np.arange(len(mesh.triangles))
    left, guess = every, None  # by their numbers in the scene as it is
    for _ in range(MOST_LAYERS):
        found = frame.triangle_index[wrong & (frame.instance_index == instance)]
        # A triangle that is there is nowhere wrong, but for what another fault does at its rim.
        number, count = np.unique(found, return_counts=True)
        more = left[number[count >= LEAST_WRONG]]
        if not len(more):
            break
        left = np.setdiff1d(left, more)
        gone = np.setdiff1d(every, left)
        guess = Triangles(rank, gone, object=name, values=(float(len(gone)),))
        # Each is as a number that is fitted: any shape is a sum of triangles.
        if len(gone) > MOST_TRIANGLES or least_with(len(gone)) > evidence.unexplained.sum():
            return None
        other = _without_triangles(case, guess)
        if (yield from evidence.score(other)).gain < 0:
            return None  # where they are missing, they break nothing that agrees
        frame = yield from frame_of(other.scene, SOUND)
        shown = evidence.picture.shows(frame)
        wrong = evidence.unexplained & ~shown
    if not (frame.instance_index == instance).any():
        return None  # all that is seen of it is gone: the object is missing
    return guess


TRIANGLE_FAULTS: tuple[AnyFault, ...] = (
    Fault(
        "culled",
        "back faces are left out (culled)",
        "Game engines and rasterisers leave out faces that are seen from behind, and so does "
        "glTF unless a material is doubleSided.",
        "Blender shows both sides of a face, unless its material says otherwise",
        _culled,
        effort=Effort.PIXELS,
        witness="leozide/leocad#796",
    ),
    Fault(
        "flipped_winding",
        "all normals are turned over",
        "A negative scale, or a change between right- and left-handed coordinates, reverses "
        "the order of the corners.",
        "keep the order of each triangle's corners",
        of_meshes(lambda mesh: with_triangles(mesh, slice(None), slice(None, None, -1))),
        examples=(Example("flipped_winding", "all normals turned over"),),
        witness="ComputationalBiomechanicsLab/opensim-creator#318",
    ),
    Fault(
        "other_diagonal",
        "quads are cut along their other diagonal",
        "OBJ keeps quads, and each reader cuts them in its own way, which shows where a "
        "quad is not flat.",
        "cut each quad as Blender's loop triangles do",
        of_meshes(_other_diagonal),
        witness="bonjorno7/SourceOps#43",
    ),
    Fault(
        "triangles_missing",
        "'{object}' lacks {count:.0f} of its triangles",
        "The exporter leaves out faces with an empty material slot, the reader takes "
        "only the first three corners of each polygon, or 16-bit indices end at 65,535.",
        "check which faces are exported: hidden ones, large polygons, the end of the list",
        _without_triangles,
        _missing_triangles,
        ("count",),
        effort=Effort.PIXELS,  # any shape that is a part of another one has triangles missing
        examples=(
            Example("dropped_triangle", "a triangle of the largest object left out", _a_triangle),
        ),
        witness="InteractiveComputerGraphics/SPlisHSPlasH#16",
    ),
)
