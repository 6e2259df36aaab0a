"""Faults of the scene's objects: which are there, where, how large, and with which triangles."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from ...arrays import Array, Bools
from ...projections import ORTHOGRAPHIC
from ...rendering import steps
from ...scene import Camera, Instance, Mesh, Scene
from ...tracer.camera import pixel_size
from ...tracer.frame import Frame
from ...tracer.progress import Work
from ..case import Case
from ..checks.probe import SOUND
from ..evidence import Evidence
from .fault import Example, Fault, Find, Guess, instances_named, of_object
from .pose import DISPLACED, MOVED, SCALED, TWICE, copied, inflated, moved, scaled

UNITS = (0.01, 100.0, 0.001, 1000.0, 0.1, 10.0, 0.0254, 1 / 0.0254, 0.3048, 1 / 0.3048)


def suspects(*values: float) -> Find:
    """Return what suspects each object that is seen in unexplained pixels, with some numbers."""

    def find(evidence: Evidence) -> Work[list[Guess]]:
        chosen: list[tuple[float, ...]] = [(value,) for value in values] or [()]
        return [Guess(some, object=name) for name in evidence.suspects for some in chosen]
        yield

    return find


def largest(case: Case, frame: Frame) -> Guess | None:
    """Pick the object whose instance is seen in the most pixels."""
    seen = seen_instances(case, frame)
    if not seen:
        return None
    return Guess(object=case.scene.objects[case.scene.instances[seen[0]].object])


def seen_instances(case: Case, frame: Frame) -> list[int]:
    """Return the instances of meshes that are seen, those of the most pixels first."""
    index = frame.instance_index
    index = index[(index >= 0) & (index < len(case.scene.instances))]
    found, count = np.unique(index, return_counts=True)
    return [int(i) for i in found[np.argsort(-count, kind="stable")]]


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


def with_triangles(mesh: Mesh, left: Bools | slice, corners: slice = slice(None)) -> Mesh:
    """Return the mesh of some of the triangles, with their corners in some order."""
    colors = None if mesh.corner_colors is None else mesh.corner_colors[left][:, corners]
    triangles = mesh.triangles[left][:, corners]
    return replace(mesh, triangles=triangles, slots=mesh.slots[left], corner_colors=colors)


def _meshes(change: Callable[[Mesh], Mesh]) -> Callable[[Case, Frame, Guess], Case | None]:
    """Return what changes the meshes of an object, or of all objects where none is named."""

    def make(case: Case, frame: Frame, guess: Guess) -> Case | None:
        def changed(scene: Scene) -> Scene:
            own = {scene.instances[n].mesh for n in instances_named(scene, guess.object)}
            meshes = [
                change(mesh) if n in own or not guess.object else mesh
                for n, mesh in enumerate(scene.meshes)
            ]
            return replace(scene, meshes=tuple(meshes))

        return case.with_scenes(changed)

    return make


def _flipped(mesh: Mesh) -> Mesh:
    return with_triangles(mesh, slice(None), slice(None, None, -1))


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


def _culled(case: Case, frame: Frame, guess: Guess) -> Case | None:
    """Leave out the triangles whose backs the camera sees."""

    def culled(scene: Scene) -> Scene:
        meshes: list[Mesh] = []
        instances: list[Instance] = []
        for instance in scene.instances:
            mesh = scene.meshes[instance.mesh]
            matrix = instance.world_from_object
            world = mesh.vertices @ matrix[:3, :3].T + matrix[:3, 3]
            a, b, c = (world[mesh.triangles[:, k]] for k in range(3))
            front = _towards(scene.camera, a, np.cross(b - a, c - a))
            front *= np.sign(np.linalg.det(matrix[:3, :3]))  # Blender turns the normals back
            instances.append(replace(instance, mesh=len(meshes)))
            meshes.append(with_triangles(mesh, front >= 0))
        return replace(scene, meshes=tuple(meshes), instances=tuple(instances))

    return case.with_scenes(culled)


def _towards(camera: Camera, points: Array, normals: Array) -> Array:
    """Return a positive number where a normal (n, 3) points towards the camera."""
    back = -camera.forward if camera.projection is ORTHOGRAPHIC else camera.origin - points
    return (normals * back).sum(axis=1)


def _largest_triangle(case: Case, frame: Frame) -> Guess | None:
    if not seen_instances(case, frame):
        return None
    names = np.stack((frame.instance_index, frame.triangle_index), axis=-1)
    found, count = np.unique(names[frame.triangle_index >= 0], axis=0, return_counts=True)
    instance, triangle = (int(n) for n in found[np.argmax(count)])
    name = case.scene.objects[case.scene.instances[instance].object]
    return Guess((1.0, float(instance), float(triangle)), object=name)


def _without_triangles(case: Case, frame: Frame, guess: Guess) -> Case | None:
    """Drop triangles of an instance: the values are their count, its number, and theirs."""
    instance, *triangles = (int(v) for v in guess.values[1:])
    rank = instances_named(case.scene, guess.object).index(instance)

    def less(scene: Scene) -> Scene:
        own = instances_named(scene, guess.object)
        if rank >= len(own):
            return scene
        mesh = scene.meshes[scene.instances[own[rank]].mesh]
        left = ~np.isin(np.arange(len(mesh.triangles)), triangles)
        instances = list(scene.instances)
        instances[own[rank]] = replace(instances[own[rank]], mesh=len(scene.meshes))
        meshes = (*scene.meshes, with_triangles(mesh, left))
        return replace(scene, meshes=meshes, instances=tuple(instances))

    return case.with_scenes(less)


LEAST_WRONG = 2  # pixels of a triangle that is missing
MOST_LAYERS = 6  # of triangles one behind another
MOST_TRIANGLES = 4096  # of an instance that may be missing
PIXELS_PER_TRIANGLE = 4  # else any shape is a sum of triangles


def _missing_triangles(evidence: Evidence) -> Work[list[Guess]]:
    """Return, for each object, the triangles in which it is unexplained, one behind another."""
    out = []
    for name in evidence.suspects:
        for instance in instances_named(evidence.case.scene, name):
            own = evidence.frame.instance_index == instance
            if (own & evidence.open).any():
                guess = yield from _peeled(evidence, name, instance)
                out += [guess] if guess else []
    return out


def _peeled(evidence: Evidence, name: str, instance: int) -> Work[Guess | None]:
    """Drop an instance's triangles that are wrong, then those behind them that are, and so on."""
    case, frame = evidence.case, evidence.frame
    gone: set[int] = set()
    wrong = evidence.open
    mesh = case.scene.meshes[case.scene.instances[instance].mesh]
    left = np.arange(len(mesh.triangles))  # their numbers in the scene as it is
    for _ in range(MOST_LAYERS):
        found = frame.triangle_index[wrong & (frame.instance_index == instance)]
        # A triangle that is there is nowhere wrong, but for what another fault does at its rim.
        number, count = np.unique(found, return_counts=True)
        more = left[number[count >= LEAST_WRONG]]
        if not len(more):
            break
        gone |= set(more.tolist())
        left = np.setdiff1d(left, more)
        values = (float(len(gone)), float(instance), *map(float, sorted(gone)))
        guess = Guess(values, object=name)
        if len(gone) * PIXELS_PER_TRIANGLE > evidence.open.sum() or len(gone) > MOST_TRIANGLES:
            return None
        other = _without_triangles(case, evidence.frame, guess)
        if other is None:
            return None
        frame = Frame.empty(other.scene)
        yield from steps(other.scene, SOUND, frame)
        shown = evidence.picture.alike(other.scene, frame.instance_index, frame.color)
        wrong = evidence.open & ~shown
    if not (frame.instance_index == instance).any():
        return None  # all that is seen of it is gone: the object is missing
    return guess if gone else None


def _of_one_color(case: Case, frame: Frame) -> list[int]:
    """Return the instances that are seen without colours of their corners."""
    scene = case.scene
    meshes = {n: scene.meshes[scene.instances[n].mesh] for n in seen_instances(case, frame)}
    return [n for n, mesh in meshes.items() if mesh.corner_colors is None]


def _in_color(case: Case, frame: Frame, guess: Guess) -> Case | None:
    """Give an object one colour, linear RGB."""
    color = np.array([[*guess.values[:3], 1.0]], np.float32)
    return of_object(lambda instance, *_: replace(instance, colors=color))(case, frame, guess)


def _recolored(change: Callable[[Array], Array]) -> Callable[[Case, Frame], Guess | None]:
    """Return what picks the largest object of one colour that changes, and that colour changed."""

    def pick(case: Case, frame: Frame) -> Guess | None:
        for number in _of_one_color(case, frame):
            instance = case.scene.instances[number]
            other = change(instance.colors[:1])[0, :3]
            if len(instance.colors) == 1 and not np.allclose(other, instance.colors[0, :3]):
                name = case.scene.objects[instance.object]
                return Guess(tuple(float(v) for v in other), object=name)
        return None

    return pick


def _shown_color(evidence: Evidence) -> Work[list[Guess]]:
    """Return, for each object that is suspected, the colour in which most of it is shown."""
    out = []
    scene, picture = evidence.case.scene, evidence.picture
    for name in evidence.suspects:
        own = np.isin(evidence.frame.instance_index, instances_named(scene, name))
        where = own & evidence.open
        if 2 * where.sum() > own.sum() and picture.transform is None:
            color = np.median(picture.color[where], axis=0)
            if np.isfinite(color).all() and color[3] > 0:
                values = tuple(float(v) for v in color[:3])
                out.append(Guess(values, values, values, object=name))
        yield 0.0
    return out


def _swapped(case: Case, frame: Frame, guess: Guess) -> Case | None:
    """Give two objects each other's colours: the values are their instances' numbers."""
    instances = case.scene.instances
    first, second = (int(v) for v in guess.values)
    one, other = (case.scene.objects[instances[n].object] for n in (first, second))
    colors = {one: instances[second].colors, other: instances[first].colors}

    def swapped(scene: Scene) -> Scene:
        made = [
            replace(i, colors=colors.get(scene.objects[i.object], i.colors))
            for i in scene.instances
        ]
        return replace(scene, instances=tuple(made))

    return case.with_scenes(swapped)


def _two_colors(case: Case, frame: Frame) -> Guess | None:
    """Pick the largest object, and another one of another colour."""
    instances = case.scene.instances
    first, *others = _of_one_color(case, frame) or [0]
    for second in others:
        if not np.array_equal(instances[first].colors, instances[second].colors):
            return Guess((float(first), float(second)))
    return None


def _nothing_swapped(evidence: Evidence) -> Work[list[Guess]]:
    """Return the two objects that are suspected first, if both have one colour."""
    if len(evidence.suspects) < 2:
        return []
    scene = evidence.case.scene
    first, second = (instances_named(scene, name) for name in evidence.suspects[:2])
    if not (first and second):
        return []
    names = " and ".join(f"'{name}'" for name in evidence.suspects[:2])
    return [Guess((float(first[0]), float(second[0])), words=names)]
    yield


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


OBJECT_FAULTS = (
    Fault(
        "nothing_shown",
        "nothing of the scene is in the picture",
        "check where the camera is and looks, and whether anything is rendered",
        lambda case, frame, guess: case.with_scenes(
            lambda scene: replace(scene, instances=(), planes=())
        ),
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
        "culled",
        "back faces are left out (culled)",
        "Blender shows both sides of a face, unless its material says otherwise",
        _culled,
    ),
    Fault(
        "flipped_winding",
        "all normals are turned over",
        "keep the order of each triangle's corners",
        _meshes(_flipped),
        examples=(Example("flipped_winding", "all normals turned over"),),
    ),
    Fault(
        "other_diagonal",
        "quads are cut along their other diagonal",
        "cut each quad as Blender's loop triangles do",
        _meshes(_other_diagonal),
    ),
    Fault(
        "triangles_missing",
        "{count:.0f} triangles of '{object}' are missing",
        "check which faces are exported: hidden ones, large polygons, the end of the list",
        _without_triangles,
        _missing_triangles,
        ("count",),
        examples=(Example("dropped_triangle", "the largest triangle left out", _largest_triangle),),
    ),
    Fault(
        "swapped_colors",
        "{words} have each other's colours",
        "check by which index colours are taken",
        _swapped,
        _nothing_swapped,
        examples=(
            Example("swapped_colors", "two objects with one another's colours", _two_colors),
        ),
    ),
    Fault(
        "recolored",
        "'{object}' is shown in another colour: ({red:.3f}, {green:.3f}, {blue:.3f}), linear",
        "check its material, and in which colour space its colour is stored",
        _in_color,
        _shown_color,
        ("red", "green", "blue"),
        examples=(
            Example("one_shade", "one object half as bright", _recolored(lambda c: c * 0.5)),
            Example(
                "one_channels",
                "one object's red and blue swapped",
                _recolored(lambda c: c[:, [2, 1, 0, 3]]),
            ),
        ),
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
        effort=3,
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


def _whole(instance: Instance, factor: float) -> Instance:
    """Scale an instance about the world's origin."""
    matrix = instance.world_from_object.copy()
    matrix[:3] *= factor
    return replace(instance, world_from_object=matrix)


def _units(evidence: Evidence) -> Work[list[Guess]]:
    return [Guess((factor,)) for factor in UNITS]
    yield
