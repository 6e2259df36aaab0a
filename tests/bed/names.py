"""Which names are right for a wrong picture: its own, and those of faults that are the same there.

Two faults are the same in a scene if no picture could tell them apart: if both make the same one,
or if the numbers of one, which a fit finds, make the other. Every name comes with this reason.
"""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np

from .description import Description
from .faults import FAULTS
from .making import Fault, Made, right
from .renderer import Solid, Tracer

# Pixels beside an edge in which Embree's float32 may tell the same picture apart.
ROUNDED = 6
LEAST = 20  # pixels of a second colour that a picture must have to say anything
EXACT = 1e-9  # relative: sums of some float64 products


# The diagnosis' own names of what the bed calls otherwise: by key, and by how the label begins.
SPOKEN = {
    ("srgb_for_linear", "the curve applied"): "srgb_twice",
    ("srgb_for_linear", "the curve left"): "srgb_left_out",
    ("premultiplied", "alpha divided"): "straight_alpha",
    ("rounding_level", "cut off"): "cut_off",
    ("object_scaled", "all"): "scene_scaled",
    ("object_turned", "mirrored"): "object_scaled",
    ("sensor_fit", "horizontal"): "sensor_fit_setting",
    ("jpeg", ""): "processed",
    ("white_balance", ""): "processed",
    ("saturation", ""): "processed",
    ("dithered", ""): "processed",
}


def spoken(fault: Fault) -> str:
    """Return the diagnosis' name of a fault."""
    found = (n for (k, b), n in SPOKEN.items() if k == fault.key and fault.label.startswith(b))
    return next(found, fault.key)


def right_names(fault: Fault, scene: Description) -> dict[str, str]:
    """Return every name that is right, and why."""
    made = fault.make(scene, right(scene))
    out = {fault.key: "it is this fault"}
    out.setdefault(spoken(fault), "it is this fault, by the diagnosis' name")
    if made is None:
        return out
    for key, reason in (*_of_camera(scene, made), *_of_solids(scene, made)):
        out.setdefault(key, reason)
    own = picture_of(fault, scene)
    if own is not None and "object_missing" not in out:
        out.update(_of_missing(scene, made, own))
    for other in FAULTS:
        if other.key not in out and scene.number in other.only and _slow(other) == _slow(fault):
            shown = picture_of(other, scene)
            if shown is not None and same(own, shown):
                out[spoken(other)] = out[other.key] = f"the same picture: {other.name}"
    return out


def _slow(fault: Fault) -> bool:
    """Return whether a picture is filtered: no fault of another kind makes the same."""
    return fault.key in ("filter_radius", "supersampled")


@cache
def picture_of(fault: Fault, scene: Description) -> np.ndarray | None:
    """Return the wrong picture, (h, w, 4)."""
    made = fault.make(scene, right(scene))
    return None if made is None else made.stored()


def same(first: np.ndarray, second: np.ndarray) -> bool:
    """Return whether two pictures are the same but for pixels that an edge passes."""
    if first.shape != second.shape:
        return False
    with np.errstate(invalid="ignore"):
        apart = (first != second) & ~(np.abs(first - second) <= 1e-5)
    return int(apart.any(axis=-1).sum()) <= ROUNDED


def says_nothing(picture: np.ndarray) -> bool:
    """Return whether a picture has one colour: nothing of the fault could be seen in it."""
    flat = np.ascontiguousarray(picture).reshape(-1, picture.shape[-1])
    _, count = np.unique(flat, axis=0, return_counts=True)
    return int(flat.shape[0] - count.max()) < LEAST


def _of_camera(scene: Description, made: Made) -> list[tuple[str, str]]:
    """Return what a fit in numbers finds of a camera, if nothing else is changed."""
    own, other = right(scene).camera, made.camera
    if made.after or made.draw or own.parallel != other.parallel or own.near != other.near:
        return []
    turn = other.r @ np.linalg.inv(own.r)
    close = {"rtol": EXACT, "atol": EXACT}
    if np.allclose(turn, np.eye(3), **close) and np.allclose(own.t, other.t, **close):
        film = other.k @ np.linalg.inv(own.k)  # what is done to film positions
        x, y = film[:2, 2]
        if np.allclose(film[:2, :2], np.eye(2), **close) and np.hypot(x, y) > 1e-6:
            return [("pixel_offset", f"the content moved by ({x:+.4g}, {y:+.4g}) px")]
        ratio = film[0, 0]
        middle = own.k[:2, 2]
        straight = abs(film[0, 1]) + abs(film[1, 0]) < EXACT and film[1, 1] > 0 < ratio
        stays = straight and np.allclose(film[:2, :2] @ middle + film[:2, 2], middle, atol=1e-6)
        if stays and abs(film[1, 1] - ratio) > EXACT:
            by = f"{ratio:.6g} across and {film[1, 1]:.6g} up"
            return [("focal_lengths", f"the film stretched by {by} around the principal point")]
        if stays and abs(ratio - 1) > EXACT:
            key = "ortho_scale" if own.parallel else "focal_length"
            return [(key, f"the film magnified by {ratio:.6g} around the principal point")]
    if not np.array_equal(own.k, other.k):
        return []
    moved = not np.allclose(own.center, other.center, **close)
    if moved and np.allclose(turn, np.eye(3), **close):
        by = np.round(other.center - own.center, 6).tolist()
        names = ["camera_moved", *(["pixel_offset"] if own.parallel else [])]
        return [(key, f"the camera moved by {by} m") for key in names]
    turned = np.allclose(turn[2], (0, 0, 1), **close) and np.allclose(turn @ turn.T, np.eye(3))
    if turned and np.linalg.det(turn) > 0 and np.allclose(turn @ own.t, other.t):
        angle = np.degrees(np.arctan2(turn[1, 0], turn[0, 0]))
        if np.array_equal(own.k, other.k) and abs(angle) > 1e-6:
            return [("roll", f"turned by {angle:+.4g} degrees about the view axis")]
    rotation = np.allclose(turn @ turn.T, np.eye(3)) and np.linalg.det(turn) > 0
    if rotation and not moved and not np.allclose(turn, np.eye(3), **close):
        return [("camera_turned", "turned in its place")]
    return []


def _of_solids(scene: Description, made: Made) -> list[tuple[str, str]]:
    """Return what a fit finds of the one object that is changed."""
    before, after = ({s.name: s for s in m.solids} for m in (right(scene), made))
    if before.keys() != after.keys() or len(made.solids) != len(before):
        return []
    found = [n for n in before if not _alike(before[n], after[n])]
    if len(found) != 1:
        return []
    name = found[0]
    own, other = before[name], after[name]
    index = [s.name for s in made.solids].index(name)
    if not (Tracer(made.camera, made.solids).owners() == index).any():
        return [("object_missing", f"nothing is seen of '{name}'")]
    if _corners(other) < _corners(own):
        return [("triangles_missing", f"'{name}' has fewer triangles, none of them new")]
    if np.array_equal(own.triangles, other.triangles):
        by = other.vertices - own.vertices
        if np.allclose(by, by[0], atol=1e-9):
            return [("object_moved", f"'{name}' moved by {np.round(by[0], 6).tolist()} m")]
        return _of_nearer(made, own, other)
    return []


def _of_nearer(made: Made, own: Solid, other: Solid) -> list[tuple[str, str]]:
    """Return that a larger object is one that is moved towards a pinhole, if all see it so.

    Scaled about the camera, back to its own size, it covers the same pixels: only what stands
    before or behind it may tell.
    """
    factor = np.sqrt(np.var(other.vertices, axis=0).sum() / np.var(own.vertices, axis=0).sum())
    center = made.camera.center
    back = replace(other, vertices=center + (other.vertices - center) / factor)
    by = back.vertices - own.vertices
    if made.camera.parallel or made.after or made.draw or not np.allclose(by, by[0], atol=1e-6):
        return []
    moved = replace(made, solids=tuple(back if s is other else s for s in made.solids))
    text = f"'{own.name}' moved by {np.round(by[0], 6).tolist()} m, the same picture"
    return [("object_moved", text)] if same(made.stored(), moved.stored()) else []


def _corners(solid: Solid) -> set[bytes]:
    """Return each triangle by its corners, in their order, to a millionth of a metre."""
    return {p.tobytes() for p in np.round(solid.vertices[solid.triangles], 6) + 0.0}


def _of_missing(scene: Description, made: Made, own: np.ndarray) -> dict[str, str]:
    """Return what else leaves out all of one object that is seen, as culling does of a sheet."""
    correct = right(scene)
    left = {s.name: len(s.triangles) for s in made.solids}
    for solid in correct.solids:
        if left.get(solid.name, 0) < len(solid.triangles):
            others = tuple(s for s in correct.solids if s.name != solid.name)
            if same(own, replace(correct, solids=others).stored()):
                return {"object_missing": f"the same picture: '{solid.name}' is missing"}
    return {}


def _alike(first: Solid, second: Solid) -> bool:
    return np.array_equal(first.vertices, second.vertices) and np.array_equal(
        first.triangles, second.triangles
    )
