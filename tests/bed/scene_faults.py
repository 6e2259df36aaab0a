"""Faults of the scene, each by its own formula in world-space vertices and triangles."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

import numpy as np

from .description import Description, Item, Shape
from .making import Change, Fault, Made, once
from .renderer import Camera, Solid, Tracer
from .scenes import placed as posed
from .setup import placed, solid_of

# Which object a fault is made with, by the scene's number: in the foreground, then a smaller one.
FIRST = {1: "Cube", 2: "Cube", 3: "Cube", 4: "Ball", 5: "Pebble", 6: "Thing14"}
SECOND = {1: "Ring", 2: "Post", 3: "Ring", 4: "Roller", 5: "Leaf", 6: "Near"}
GREY = 0.8, 0.8, 0.8, 1.0  # of a viewport
BENT = {4: "Mast", 5: "Cloth"}
SEVERAL = {1: "Far", 5: ("Leaf", "Stem"), 6: "Thing1"}  # how their names begin
FLOORS = dict.fromkeys((1, 3, 4, 5, 6), "Floor")


def exchanged(made: Made, name: str, *others: Solid) -> Made:
    """Return others in place of a solid; none: it is missing."""
    out = []
    for solid in made.solids:
        out += others if solid.name == name else (solid,)
    return replace(made, solids=tuple(out))


def changed(of: dict[int, str], change: Callable[[Description, Item, Solid], Solid]) -> Change:
    """Return what changes one solid."""

    def make(scene: Description, made: Made) -> Made | None:
        name = of.get(scene.number)
        own = next((s for s in made.solids if s.name == name), None)
        if own is None:
            return None
        return exchanged(made, own.name, change(scene, scene.item(own.name), own))

    return make


def missing(of: Mapping[int, str | tuple[str, ...]]) -> Change:
    """Return what drops the solids whose names begin so."""

    def make(scene: Description, made: Made) -> Made:
        left = tuple(s for s in made.solids if not s.name.startswith(of[scene.number]))
        return replace(made, solids=left)

    return make


def reposed(change: Callable[[np.ndarray], np.ndarray], of: dict[int, str] | None = None) -> Change:
    """Return one object, or all, with another matrix, (4, 4)."""

    def make(scene: Description, made: Made) -> Made | None:
        for item in scene.shown:
            if of is None or item.name == of.get(scene.number):
                at = placed(item.shape.vertices, change(item.world(scene.frame)))
                own = replace(solid_of(item, scene.frame), vertices=at)
                made = exchanged(made, item.name, own)
        return made

    return make


def transposed(matrix: np.ndarray) -> np.ndarray:
    """Return a matrix with its rotation transposed: its scale is what it was."""
    matrix = matrix.copy()
    lengths = np.linalg.norm(matrix[:3, :3], axis=0)
    matrix[:3, :3] = (matrix[:3, :3] / lengths).T * lengths
    return matrix


def repainted(change: Callable[[np.ndarray, int], np.ndarray]) -> Change:
    """Return all objects in other colours: of those of a solid, and its number."""

    def make(_: Description, made: Made) -> Made:
        out = (replace(s, paint=change(s.colors, n)) for n, s in enumerate(made.solids))
        return replace(made, solids=tuple(out))

    return make


def in_slots(change: Callable[[np.ndarray, int], np.ndarray]) -> Change:
    """Return faces in the colours of other material slots: of their own, and how many there are."""

    def make(scene: Description, made: Made) -> Made:
        for own, item in zip(made.solids, scene.shown, strict=True):
            count = len(item.colors)
            slots = change(item.shape.slots(count), count)
            made = exchanged(made, own.name, replace(own, paint=np.array(item.colors)[slots]))
        return made

    return make


def _random(colors: np.ndarray, number: int) -> np.ndarray:
    """Return a colour by lot, the same for a whole object."""
    return np.tile([*np.random.default_rng([3, number]).uniform(0.05, 0.9, 3), 1], (len(colors), 1))


def twice(of: dict[int, str], *by: float) -> Fault:
    """Return an object that is there again, somewhere else."""

    def make(scene: Description, made: Made) -> Made:
        own = next(s for s in made.solids if s.name == of[scene.number])
        again = replace(own, vertices=own.vertices + np.array(by))
        return exchanged(made, own.name, own, again)

    label = f"{'first' if of is FIRST else 'second'} by {', '.join(map(str, by))} m"
    return Fault("object_twice", label, make, {"by": by})


def moved(of: dict[int, str], *by: float) -> Fault:
    """Return an object at another place."""
    change = changed(of, lambda _, __, s: replace(s, vertices=s.vertices + np.array(by)))
    label = f"{'first' if of is FIRST else 'second'} by {', '.join(map(str, by))} m"
    return Fault("object_moved", label, change, {"by": by})


def scaled(of: dict[int, str], factor: float) -> Fault:
    """Return an object of another size, from its own origin."""

    def change(scene: Description, item: Item, own: Solid) -> Solid:
        origin = item.world(scene.frame)[:3, 3]
        return replace(own, vertices=origin + factor * (own.vertices - origin))

    return Fault("object_scaled", f"by {factor:g}", changed(of, change), {"factor": factor})


def units(factor: float) -> Fault:
    """Return everything in other units, but for the camera."""

    def make(_: Description, made: Made) -> Made:
        out = tuple(replace(s, vertices=factor * s.vertices) for s in made.solids)
        return replace(made, solids=out)

    return Fault("object_scaled", f"all by {factor:g}", make, {"factor": factor})


def reshaped(name: str, shape: Callable[[Item], Shape | None]) -> Change:
    """Return an object in another of its shapes."""

    def change(scene: Description, item: Item, _: Solid) -> Solid:
        return solid_of(item, scene.frame, shape(item))

    return changed(dict.fromkeys(range(1, 7), name), change)


def _no_instancer(scene: Description, made: Made) -> Made:
    """Return instanced objects where they are in their own collection."""
    for item in scene.shown:
        if item.pose.instancer is not None:
            at = item.pose.basis(scene.frame)
            own = replace(solid_of(item, scene.frame), vertices=placed(item.shape.vertices, at))
            made = exchanged(made, item.name, own)
    return made


def _no_parent_inverse(scene: Description, item: Item, own: Solid) -> Solid:
    at = item.pose.parent @ item.pose.basis(scene.frame)
    return replace(own, vertices=placed(item.shape.vertices, at))


def layered(order: Callable[[Camera, Sequence[Solid]], np.ndarray]) -> Change:
    """Return the picture in which solids are drawn one over the other, the lowest number first."""

    def drawn(made: Made) -> np.ndarray:
        out = once(replace(made, solids=()))
        for n in np.argsort(order(made.camera, made.solids), kind="stable"):
            alone = Tracer(made.camera, (made.solids[n],)).owners() >= 0
            out[alone] = made.solids[n].color
        return out

    return lambda _, made: replace(made, draw=drawn)


def without(of: dict[int, str], half: bool) -> Change:
    """Return an object without half its triangles, drawn by lot, or without the first of them."""

    def change(_: Description, __: Item, own: Solid) -> Solid:
        lot = np.random.default_rng(7).random(len(own.triangles)) < 0.5
        left = lot if half else np.arange(len(lot)) > 0
        return replace(own, triangles=own.triangles[left])

    return changed(of, change)


def _other_diagonal(scene: Description, made: Made) -> Made:
    """Return all quads, cut the other way."""
    for item in scene.shown:
        own = replace(solid_of(item, scene.frame), triangles=item.shape.triangles(True))
        made = exchanged(made, item.name, own)
    return made


def _shown(name: str) -> Change:
    """Return the scene with an object that a render does not show."""

    def make(scene: Description, made: Made) -> Made:
        return replace(made, solids=(*made.solids, solid_of(scene.item(name), scene.frame)))

    return make


def _culled(_: Description, made: Made) -> Made:
    """Return only triangles that turn their front to the camera."""
    out, camera = [], made.camera
    forward = np.linalg.solve(camera.r, [0.0, 0.0, 1.0])
    for solid in made.solids:
        p = solid.vertices[solid.triangles]
        normal = np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0])
        to = forward if camera.parallel else p[:, 0] - camera.center
        out.append(replace(solid, triangles=solid.triangles[(normal * to).sum(axis=1) < 0]))
    return replace(made, solids=tuple(out))


def level(name: str, by: int) -> Fault:
    """Return an object subdivided more or less."""
    change = reshaped(name, lambda item: item.levels[item.level + by])
    return Fault("subdivision", f"{name} {by:+d}", change, {"levels": by}, (5,))


SCENE_FAULTS = (
    Fault("object_missing", "first", missing(FIRST)),
    Fault("object_missing", "second", missing(SECOND)),
    Fault("instances_missing", "several", missing(SEVERAL), only=(1, 5, 6)),
    Fault("rotation_transposed", "of all", reposed(transposed)),
    Fault("rotation_transposed", "of one", reposed(transposed, FIRST)),
    Fault(
        "object_turned", "by a quarter", reposed(lambda m: m @ posed((0, 0, 0), (90, 0, 0)), SECOND)
    ),
    Fault(
        "object_turned",
        "mirrored",
        reposed(lambda m: m @ np.diag((-1, 1, 1, 1)), BENT),
        only=(4, 5),
    ),
    Fault("color_source", "white", repainted(lambda c, _: np.ones_like(c))),
    Fault("color_source", "grey", repainted(lambda c, _: c * 0 + GREY)),
    Fault("color_source", "random", repainted(_random)),
    Fault("color_source", "slot 0", in_slots(lambda slots, _: 0 * slots), only=(7,)),
    Fault(
        "color_source", "slots off by one", in_slots(lambda slots, n: (slots + 1) % n), only=(7,)
    ),
    twice(FIRST, 0.9, 1.1, 0.4),
    twice(SECOND, -0.9, 0.2, 1.2),
    Fault("rest_pose", "", reshaped("Mast", lambda item: item.rest), only=(4,)),
    moved(FIRST, 0.03, -0.02, 0.01),
    moved(FIRST, 0.4, -0.3, 0.2),
    moved(SECOND, 0.0, 0.0, 0.15),
    Fault("depth_order", "as listed", layered(lambda _, solids: np.arange(len(solids)))),
    scaled(FIRST, 1.15),
    scaled(FIRST, 0.01),
    scaled(FIRST, 100.0),
    units(0.01),
    units(100.0),
    Fault("instance_transform", "", _no_instancer, only=(5,)),
    Fault("parent_inverse", "", changed({4: "Child"}, _no_parent_inverse), only=(4,)),
    Fault("viewport_modifiers", "", reshaped("Tower", lambda i: i.viewport), only=(5,)),
    Fault("no_modifiers", "", reshaped("Tower", lambda i: i.plain), only=(5,)),
    level("Cage", -1),
    level("Cage", 1),
    level("Cage", -3),
    level("Pebble", -1),
    Fault("triangles_missing", "half of the first", without(FIRST, True)),
    Fault("triangles_missing", "one of the floor", without(FLOORS, False), only=(1, 3, 4, 5, 6)),
    Fault("other_diagonal", "", _other_diagonal, only=(5,)),
    Fault("hidden_shown", "Ghost", _shown("Ghost"), only=(5,)),
    Fault("hidden_shown", "Secret", _shown("Secret"), only=(5,)),
    Fault("hidden_shown", "Thing8", _shown("Thing8"), only=(6,)),
    Fault("culled", "", _culled, only=(1, 3)),
    Fault("other_layer", "Elsewhere", _shown("Elsewhere"), only=(5,)),
    Fault("other_layer", "Thing4", _shown("Thing4"), only=(6,)),
)
