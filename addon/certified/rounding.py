"""The two roundings before the proof, of rays and of corners: their bounds, and what they decide.

What is proven is proven of stored rays and corners. The camera's own rays, x right + y up + forward
for a pixel's centre, and world_from_object . vertex may be other numbers: fractions.
"""

from __future__ import annotations

from copy import copy
from dataclasses import replace
from fractions import Fraction
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ..certainty import check_assumptions
from ..scene import SceneError, ViewWindow
from ..tracer.camera import Rays, camera_rays, corner_rays, dual_axes, film_positions, pixel_size
from ..tracer.candidates import candidates, cull
from ..tracer.hits import NOTHING, Hits, Name
from ..tracer.vector import Index, rational
from ..tracer.world import reaches, world_corners
from .bounds import BOUND
from .contest import Contest
from .settle import BY_INTEGERS, Decisions, by_ray
from .surfaces import Candidates, Surfaces

if TYPE_CHECKING:
    from ..scene import Scene
    from ..tracer.frame import Frame
    from ..tracer.progress import Work

# Roundings on the longest path and one for the bound's own: of a ray four for x, a product and two
# sums; of a corner a product and three sums. The last is far above what gradual underflow may lose.
_RAY, _CORNER, _SLACK = 8 * 2.0**-53, 5 * 2.0**-53, 2.0**-1060
_ROWS = 32  # of a tile


class Rounding(NamedTuple):
    """Bounds for all of a picture in float64; the lengths are sums over x, y and z."""

    ray: float  # of a direction; of parallel rays, an origin, metres
    corner: float  # metres
    pixels: float  # how far a ray passes its pixel's centre

    def __str__(self) -> str:
        moved = f"rays by at most {self.pixels:.1g} px, corners by at most {self.corner:.1g} m"
        return f"before any test, rounding moves {moved}"


@np.errstate(over="ignore", invalid="ignore")  # what overflows has no bound
def rounding(scene: Scene) -> Rounding:
    """Return the bounds of a scene's picture."""
    camera, w = scene.camera, scene.camera.window
    x, y = abs(w.left) + abs(w.right), abs(w.bottom) + abs(w.top)
    frame = np.stack((camera.right, camera.up, camera.forward, camera.origin))
    ray = _RAY * camera.projection.terms(x, y, frame) + _SLACK
    aside = (np.abs(dual_axes(camera)) * ray).sum(axis=1).max()
    pixels = aside * camera.projection.slant(max(x, y)) / min(pixel_size(camera))
    corner = (_CORNER * reaches(scene) + _SLACK).sum(axis=0).max(initial=0.0)
    return Rounding(float(ray.sum()), float(corner), float(pixels))


def check_rounding(scene: Scene, frame: Frame) -> Work[list[str]]:
    """Return in how many pixels another surface would be seen had nothing been rounded, in words.

    A SceneError says that rounding may move what is seen first behind the eye, or that the camera's
    rays are no fractions.
    """
    check_assumptions()
    if not scene.camera.projection.is_linear:
        raise SceneError(
            f"The unrounded rays of an {scene.camera.projection.name} camera are sines and "
            "cosines, which no fractions are: --check-rounding is for other cameras."
        )
    off, camera, asked, others, cracks = rounding(scene), scene.camera, 0, [], {}
    # By how much depths may be other ones; and rays beside themselves, as a moved corner moves no
    # point of its triangle farther than itself, and nothing that is seen by more than at the least
    # depth. All is twice that, as these are rounded, too.
    axes, projection = np.abs(dual_axes(camera)).sum(axis=1).max(), camera.projection
    along = 2 * (off.ray + off.corner) * axes
    ends = {"clip_start": camera.clip_start - along, "clip_end": camera.clip_end + along}
    loose, r = scene.seen_by(replace(camera, **ends)), camera.region
    aside = 2 * (off.ray + off.corner / projection.scale(loose.camera.clip_start))
    reach = aside * axes * projection.slant(np.abs([*vars(camera.window).values()]).max())
    names = [f"'{scene.objects[s.object]}' (instance {i})" for i, s in enumerate(scene.instances)]
    stored = np.stack((frame.instance_index, frame.triangle_index))
    plan = yield from cull(loose, np.dtype(float), 1 << 26, reach / min(pixel_size(camera)))
    # A bound for rays that are as far apart as this is one for those beside these.
    shared, ends = corner_rays(camera), np.array((-1, 1)).repeat(4) * aside / BOUND
    around = Rays(*(v if len(v.T) == 1 else np.tile(v, 2) + ends for v in vars(shared).values()))
    for y in range(r.y0, r.y1, _ROWS):
        tile = replace(r, y0=y, y1=min(y + _ROWS, r.y1))
        film = film_positions(tile)
        contest = Contest.of(scene, camera_rays(camera, *film), around, aside)
        for _, pairs in candidates(plan, tile):
            if pairs:
                contest.enter(pairs)
        found, clear, surfaces = contest.left()
        shown = stored[:, y - r.y0 : tile.y1 - r.y0].reshape(2, -1)
        for part in by_ray(found.take(np.flatnonzero(~clear)), BY_INTEGERS):
            rays, own = _unrounded(scene, film, part, surfaces)
            asked += len(rays)
            for k in np.flatnonzero((own != shown[:, rays]).any(axis=0)).tolist():
                one, instead = (tuple(v.tolist()) for v in (own[:, k], shown[:, rays[k]]))
                others.append((int(r.x0 + rays[k] % r.width), int(y + rays[k] // r.width)))
                near = surfaces.names(part.surface[part.ray == rays[k]])
                for other in zip(*(v.tolist() for v in near), strict=True):
                    if instead not in (one, other) and _parts(scene, one, other):
                        first, second = (names[i] for i in sorted((one[0], other[0])))
                        both = f"{first} and {second} share an edge, but rounding parts it"
                        cracks.setdefault(both, f"the ray of pixel {others[-1]} passes between")
        yield (tile.y1 - r.y0) / r.height
    at = f", as at {others[0]}" if others else ""
    count = f"{len(others):,} of {stored[0].size:,} pixels would show another surface unrounded"
    lines = [f"a crack: {both}: {where}" for both, where in cracks.items()]
    return [f"{count}{at} ({asked:,} were asked exactly)", *lines]


def _unrounded(scene: Scene, film, found: Candidates, surfaces: Surfaces) -> tuple[Index, Index]:
    """Return the rays of these candidates, (n,), and what they meet unrounded: names, (2, n)."""
    camera, (which, ray) = copy(scene.camera), np.unique(found.ray, return_inverse=True)
    window = ViewWindow(*map(Fraction, vars(camera.window).values()))
    vars(camera).update(window=window, world_from_camera=rational(camera.world_from_camera))
    unit = 4 * camera.width * camera.height  # of lengths: denominators are powers of two
    rays = camera_rays(camera, *(rational(v[which]) for v in film), object)
    rays, hits = Rays(*(v * unit for v in vars(rays).values())), Hits.none(len(which))
    some, surface = surfaces.only(found.surface)
    corners = world_corners(scene, some.triangles.instance, some.triangles.triangle, object)
    planes = [(rational(point) * unit, normal) for point, normal in some.planes]
    triangles = replace(some.triangles, corners=corners * unit)
    some = replace(some, planes=planes, triangles=triangles)
    exact = Decisions(hits, rays, some, (camera.clip_start, camera.clip_end), rays)
    exact.by_integers(replace(found, ray=ray, surface=surface))
    return which, np.stack((hits.instance, hits.triangle))


def _parts(scene: Scene, one: Name, other: Name) -> bool:
    """Return whether triangles of two instances share an edge, but not as they are stored."""

    def shared(dtype: type) -> int:
        corners = world_corners(scene, *np.array((one, other)).T, dtype).transpose(2, 0, 1)
        return len(set.intersection(*(set(map(tuple, corner)) for corner in corners.tolist())))

    whole = one[0] != other[0] and NOTHING not in (one[1], other[1])
    return whole and shared(object) == 2 > shared(float)
