"""The textbook's steps, each of them kept: from the film to the ray, to a plane, to a triangle.

In come numbers in one arithmetic, out go all that is computed on the way, by name and in order. The
operations are those of `tracer/camera.py`, `plane.py` and `triangle.py` one by one: in float32 and
float64 these numbers are the tracer's own, to the last bit, and a test holds them to it.

    camera      u = u_min + X w,  v = v_min + Y h,  d = u right + v up + forward
    plane       t = −((o − p) · n) / (d · n)
    triangle    n = (p₃ − p₁) × (p₂ − p₁),  t = −((o − p₁) · n) / (d · n),  x = o + t d
                nₛ₁ = (p₂ − p₃) × (x − p₃), nₛ₂ = (p₁ − p₂) × (x − p₂), nₛ₃ = (p₃ − p₁) × (x − p₁)
                s₁ = n · nₛ₁ / ‖n‖²,  s₂ = n · nₛ₃ / ‖n‖²,  s₃ = n · nₛ₂ / ‖n‖²

The last line has the textbook's first erratum mended: see `formulas.ERRATA`.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..scene import Camera
from ..tracer.camera import pixel_size
from .arithmetic import Arithmetic, Number, Vector, add, cross, divides, dot, scale, subtract

Steps = dict[str, Number | Vector]


@np.errstate(all="ignore")
def camera_steps(kind: Arithmetic, camera: Camera, x: int, y: int) -> Steps:
    """Return how the ray through the centre of a pixel comes about.

    Parameters
    ----------
    kind : Arithmetic
    camera : Camera
    x, y : int
        Column and row of the whole picture.
    """
    w = camera.window
    out: Steps = {
        "left": kind.number(w.left),
        "right_end": kind.number(w.right),
        "bottom": kind.number(w.bottom),
        "top": kind.number(w.top),
        "width": _pixel_size(kind, camera, 0),
        "height": _pixel_size(kind, camera, 1),
        "px": kind.number(x + 0.5),
        "py": kind.number(y + 0.5),
        "right": kind.vector(camera.right),
        "up": kind.vector(camera.up),
        "forward": kind.vector(camera.forward),
        "eye": kind.vector(camera.origin),
    }
    out["u"] = out["left"] + out["px"] * out["width"]
    out["v"] = out["bottom"] + out["py"] * out["height"]
    aside = add(scale(out["u"], out["right"]), scale(out["v"], out["up"]))
    o, d = camera.projection.ray(out["eye"], aside, out["forward"], add)
    return out | {"o": o, "d": d}


def _pixel_size(kind: Arithmetic, camera: Camera, axis: int) -> Number:
    """Return a pixel's width or height; float32 takes that of float64, as the tracer does."""
    if kind is not Arithmetic.EXACT:
        return kind.number(pixel_size(camera)[axis])
    w = camera.window
    low, high = (w.left, w.right) if axis == 0 else (w.bottom, w.top)
    return (kind.number(high) - kind.number(low)) / (camera.width, camera.height)[axis]


@np.errstate(all="ignore")
def plane_steps(o: Vector, d: Vector, point: Vector, normal: Vector) -> Steps:
    """Return how a ray meets an infinite plane; without `t` where one would divide by 0."""
    out: Steps = {"p": point, "n": normal}
    out["from_p"] = dot(subtract(o, point), normal)
    out["towards"] = dot(d, normal)
    if divides(out["towards"]):
        out["t"] = -out["from_p"] / out["towards"]
        out["x"] = add(o, scale(out["t"], d))
    return out


@np.errstate(all="ignore")
def triangle_steps(o: Vector, d: Vector, p1: Vector, p2: Vector, p3: Vector) -> Steps:
    """Return how a ray meets a triangle; exactly, up to where one would divide by 0."""
    out: Steps = {"p1": p1, "p2": p2, "p3": p3}
    out["n"] = n = cross(subtract(p3, p1), subtract(p2, p1))
    out["from_p"] = dot(subtract(o, p1), n)
    out["towards"] = dot(d, n)
    if not divides(out["towards"]):
        return out
    out["t"] = -out["from_p"] / out["towards"]
    out["x"] = x = add(o, scale(out["t"], d))
    out["ns1"] = cross(subtract(p2, p3), subtract(x, p3))
    out["ns2"] = cross(subtract(p1, p2), subtract(x, p2))
    out["ns3"] = cross(subtract(p3, p1), subtract(x, p1))
    out["area"] = dot(n, n)
    out["s1"] = dot(n, out["ns1"]) / out["area"]
    out["s2"] = dot(n, out["ns3"]) / out["area"]  # printed as s3: it weighs p2
    out["s3"] = dot(n, out["ns2"]) / out["area"]  # printed as s2: it weighs p3
    out["sum"] = out["s1"] + out["s2"] + out["s3"]
    return out


@np.errstate(all="ignore")
def color_steps(weights: Sequence[Number], corners: Sequence[Sequence[Number]]) -> Steps:
    """Return the colour between corners: red, green and blue as weighed sums."""
    (s1, s2, s3), (c1, c2, c3) = weights, (tuple(c[:3]) for c in corners)
    color = add(add(scale(s1, c1), scale(s2, c2)), scale(s3, c3))
    return {"c1": c1, "c2": c2, "c3": c3, "color": color}
