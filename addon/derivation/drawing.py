"""Draws a derivation: the film, the surface's plane, and the view from the side.

All points are the textbook's numbers in float64, which the tables have; none is moved. What has no
place in a drawing, as a plane that the ray never meets, is left out.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import SupportsFloat

import numpy as np

from ..arrays import Floats
from ..svg import said
from .derivation import Derivation
from .plate import NEGATIVE, Plate
from .view import CORNERS, View

_AROUND = 4.5  # pixels on each side of the ray, in the drawing from near
_FAR_APART = 5.0  # so much longer is t than d, or d than t: a drawing of the nearer end helps
_PIECES = 24  # of a film that is a part of a sphere


def figures(derivation: Derivation) -> str:
    """Return the drawings with their captions, as HTML; "" if there is nothing to draw."""
    with np.errstate(all="ignore"):
        drawn = [_figure(plate, caption) for plate, caption in _plates(derivation)]
    return f'<div class="derivation-drawings">{"".join(drawn)}</div>' if drawn else ""


def _figure(plate: Plate, caption: str) -> str:
    return f"<figure>{plate.svg()}{said('figcaption', caption)}</figure>"


def _plates(derivation: Derivation) -> Iterator[tuple[Plate, str]]:
    view = View(derivation)
    if not view.sound:
        return
    yield _film(view)
    if not view.bends:
        yield _near(view)
    if view.meets:
        yield _plane(view)
    yield from _sides(view)


def _named(number: SupportsFloat) -> str:
    return f"{float(number):.4g}".replace("-", "−")


def _outline(view: View, plate: Plate) -> None:
    """Draw the surface on the film."""
    if view.test and not view.test.candidate.is_plane and np.isfinite(view.corners).all():
        on_film = view.film(view.corners)
        if len(on_film) > 2:
            plate.shape("triangle", on_film, "triangle")
        for name, corner in zip(CORNERS, view.corners, strict=True):
            for place in view.film(corner[None])[:1]:
                plate.point(name, place, name)


def _film(view: View) -> tuple[Plate, str]:
    (left, bottom), (right, top) = view.edges
    at = np.array((view.u, view.v))
    pixel = f"pixel ({view.pixel.x}, {view.pixel.y})"
    plate = Plate("film", f"The film plane with {pixel}", view.edges)
    frame = np.array([(left, bottom), (right, bottom), (right, top), (left, top)])
    plate.shape("film", frame, "film")
    _outline(view, plate)
    for name, foot in (("u", (view.u, bottom)), ("v", (left, view.v))):
        plate.shape(name, np.stack((at, foot)), "thin", closed=False)
        plate.point(name, np.array(foot), f"{name} = {_named(getattr(view, name))}", "foot")
    plate.point("pixel", at, "pixel", "x")
    return plate, (
        f"The film: u from {_named(left)} to {_named(right)}, v from {_named(bottom)} to "
        f"{_named(top)}. The ray passes it in the middle of {pixel}."
    )


def _near(view: View) -> tuple[Plate, str]:
    at, step = np.array((view.u, view.v)), np.array((view.width, view.height))
    around = np.array([at - _AROUND * step, at + _AROUND * step])
    plate = Plate("pixel", "The pixel from near", around)
    for k in np.arange(-_AROUND, _AROUND + 1):
        for axis in (0, 1):
            ends = around.copy()
            ends[:, axis] = at[axis] + k * step[axis]
            plate.shape("grid", ends, "grid", closed=False)
    square = at + np.array([(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)]) * step
    _outline(view, plate)
    plate.shape("square", square, "square")
    plate.point("pixel", at, "u, v", "x")
    return plate, (
        f"The film from near: each square is a pixel, {_named(step[0])} × {_named(step[1])}; the "
        "ray passes through the middle of its own."
    )


def _plane(view: View) -> tuple[Plate, str]:
    """Draw the surface in its own plane, seen from the side that the ray comes from."""
    x, n = view.steps["x"], view.steps["n"] / np.abs(view.steps["n"]).max()
    n = n / np.linalg.norm(n) * (-1 if view.steps["towards"][0] > 0 else 1)  # towards the eye
    up = view.axes[:, 1] if abs(n @ view.axes[:, 1]) < 0.9 else view.axes[:, 2]
    across = np.cross(up, n)
    across /= np.linalg.norm(across)
    axes = np.stack((across, np.cross(n, across)), axis=1)
    points = (view.corners - x) @ axes
    at, title = np.zeros(2), view.test.candidate.title if view.test else ""
    plate = Plate("plane", f"{title} in its plane, with x", np.concatenate((points, at[None])))
    if len(points) == 1:
        plate.shape("way", np.stack((points[0], at)), "thin", closed=False)
    else:
        s = [float(view.steps[key][0]) for key in ("s1", "s2", "s3")]
        for k, share in enumerate(s):
            area = np.stack((at, points[k - 2], points[k - 1]))
            plate.shape(f"s{k + 1}", area, f"s{k + 1}{NEGATIVE * (share < 0)}")
        plate.shape("triangle", points, "outline")
    for name, corner in zip(view.names, points, strict=True):
        plate.point(name, corner, name)
    plate.point("x", at, "x", "x")
    if len(points) == 1:
        return plate, f"{title}, in its plane: its point p, and x, where the ray meets it."
    for k, share in enumerate(s):
        middle = (at + points[k - 2] + points[k - 1]) / 3
        plate.words(middle, f"s{'₁₂₃'[k]} = {_named(share)}")
    inside = "x is inside: all three are at least 0"
    outside = "x is outside: a negative one is dashed, on the far side of its edge"
    return plate, (
        f"{title}, in its plane, from the ray's side. Each sᵢ is the share of the area between x "
        f"and the edge across from pᵢ; {inside if min(s) >= 0 else outside}."
    )


def _sides(view: View) -> Iterator[tuple[Plate, str]]:
    """Draw the view from the side; where t and d differ much, also its nearer end by itself."""
    t = view.t if view.meets else None
    about = abs(t) if t is not None else 1.0
    yield _side(view, "side", t is not None, True)
    if about > _FAR_APART:
        yield _side(view, "eye", False, True)
    elif about < 1 / _FAR_APART:
        yield _side(view, "eye", True, False)


def _side(view: View, name: str, with_x: bool, with_film: bool) -> tuple[Plate, str]:
    """Draw o, d and the film, x and the surface, or both, seen along the camera's right."""
    d = view.turned(view.d)[0]
    bends = view.bends
    level = np.array((d[0], 0.0, d[2])) if bends else np.array((0.0, 0.0, 1.0))
    level /= max(np.linalg.norm(level), 1e-300)
    flat = np.stack((level, (0.0, 1.0, 0.0)), axis=1)
    o, along = view.seen(view.o)[0] @ flat, d @ flat
    film = _film_from_the_side(view)
    fitted = [o[None]]
    if with_film:
        fitted += [film, (o + along)[None]]
    if with_x:
        fitted.append(view.seen(view.steps["x"]) @ flat)
        corners = view.seen(view.corners) @ flat
        fitted += [corners] if name == "side" and len(corners) > 1 else []
    title = "The ray from the side" if name == "side" else "The beginning of the ray"
    plate = Plate(name, title, np.concatenate(fitted))
    plate.shape("film", film, "film", closed=False)
    if view.meets:
        x, corners = view.seen(view.steps["x"])[0] @ flat, view.seen(view.corners) @ flat
        if len(corners) > 1:
            plate.shape("triangle", corners, "triangle")
        plate.shape("ray", np.stack((o, x)), "ray", closed=False)
        if with_x:
            plate.words((o + x) / 2, f"t = {_named(view.t)} m")
            for known, corner in zip(view.names, corners, strict=True):
                plate.point(known, corner, known)
            plate.point("x", x, "x", "x")
    plate.arrow("d", o, o + along, "d")
    plate.point("o", o, "o")
    if with_film and np.linalg.norm(along) * plate.scale > 24:
        plate.point("tip", o + along, "d", "foot")
        plate.words(film[-1], "film")
    where = "up and the way that the ray goes" if bends else "up and forward"
    said = f"From the side, by the camera's {where}: from o the ray goes along d"
    said += f", and meets x at t = {_named(view.t)} m." if with_x else "."
    return plate, said if name == "side" else f"Its beginning, by itself. {said}"


def _film_from_the_side(view: View) -> Floats:
    """Return the film as a line: at depth 1, where the rays begin, or on the unit sphere."""
    bottom, top = view.edges[:, 1]
    if view.bends:
        angles = np.linspace(bottom, top, _PIECES)
        return np.stack((np.cos(angles), np.sin(angles)), axis=1)
    depth = 0.0 if view.pixel.camera.projection.shares_direction else 1.0
    return np.array([(depth, bottom), (depth, top)])
