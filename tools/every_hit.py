"""Counts the wrong answers of others to what docs/every.md is about, and their seconds, in a table.

    .venv/bin/python tools/every_hit.py [--picture docs/images/every.svg]

Beside `trace(..., every=True)`: Embree through embreex, called again and again from a little behind
each hit; trimesh's `intersects_id`, which does so with embreex. Beside `inside`: trimesh's
`contains`. A ray is wrong if the number of surfaces is another; the parity, if that is odd where
ours is even, or the reverse. It takes some seconds.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
import trimesh
from embreex.mesh_construction import TriangleMesh
from embreex.rtcore_scene import EmbreeScene
from numpy.typing import NDArray
from reference_tracer import Camera, Instance, Mesh, Rays, Scene, ViewWindow, inside, trace
from reference_tracer.projections import ORTHOGRAPHIC

Points = NDArray[np.float64]  # (n, 3)
MOST = 64  # hits of a ray


def scene_of(shape: trimesh.Trimesh) -> Scene:
    """Return a mesh as a scene, whose camera clips nothing in front."""
    window = ViewWindow(-1, 1, -1, 1)
    camera = Camera(np.eye(4), window, 4, 4, ORTHOGRAPHIC, clip_start=0.0, clip_end=np.inf)
    mesh = Mesh(np.array(shape.vertices), np.array(shape.faces))
    return Scene(camera, (mesh,), (Instance(0, 0, np.eye(4)),), objects=("Shape",))


def ours(shape: trimesh.Trimesh, origins: Points, directions: Points) -> NDArray[np.int64]:
    """Return how many surfaces each ray meets, certified."""
    found = trace(scene_of(shape), rays=Rays(origins.T, directions.T), every=True)
    return np.diff(found.start(len(origins)))


def loop(shape: trimesh.Trimesh, origins: Points, directions: Points) -> NDArray[np.int64]:
    """Count by Embree, from 1e-5 of the mesh's size behind each hit."""
    scene = EmbreeScene()
    TriangleMesh(scene, shape.vertices.astype(np.float32), shape.faces.astype(np.int32))
    step = 1e-5 * shape.scale / np.linalg.norm(directions, axis=1)
    origins = origins.copy()
    count = np.zeros(len(origins), int)
    live = np.arange(len(origins))
    for _ in range(MOST):
        some = origins[live].astype(np.float32), directions[live].astype(np.float32)
        found = scene.run(*some, output=1)
        hit = found["primID"] >= 0
        live = live[hit]
        count[live] += 1
        origins[live] += directions[live] * (found["tfar"][hit] + step[live])[:, None]
    return count


def by_trimesh(shape: trimesh.Trimesh, origins: Points, directions: Points) -> NDArray[np.int64]:
    """Count by trimesh with embreex."""
    _, ray = shape.ray.intersects_id(origins, directions, multiple_hits=True, max_hits=MOST)
    return np.bincount(ray, minlength=len(origins))


def timed(count: Callable[..., NDArray], *inputs: object) -> tuple[NDArray, str]:
    """Return what is counted, and the CPU seconds."""
    began = time.process_time()
    found = count(*inputs)
    return found, f"{time.process_time() - began:.2f} s"


def row_of_rays(name: str, shape: trimesh.Trimesh, origins: Points, directions: Points) -> str:
    """Return a row of the table of rays."""
    right, seconds = timed(ours, shape, origins, directions)
    cells = [name, f"{len(origins):,}", seconds]
    for count in (loop, by_trimesh):
        told, seconds = timed(count, shape, origins, directions)
        wrong, parity = (told != right).sum(), (told % 2 != right % 2).sum()
        cells.append(f"{wrong:,} ({parity:,}), {seconds}")
    return f"| {' | '.join(cells)} |"


def row_of_points(name: str, shape: trimesh.Trimesh, points: Points) -> str:
    """Return a row of the table of points; those on the surface are nobody's mistakes."""
    found, seconds = timed(inside, scene_of(shape), points)
    told, others = timed(shape.contains, points)
    off = found.place < 2
    wrong = (told != (found.place == 1))[off].sum()
    on = f"{(~off).sum():,}, {told[~off].sum():,} of them inside"
    return f"| {name} | {len(points):,} | {seconds} | {wrong:,}, {others} | {on} |"


def tables() -> str:
    """Return both tables."""
    rng = np.random.default_rng(0)
    ball = trimesh.creation.icosphere(4)
    far, tiny = ball.copy(), ball.copy()
    far.vertices += 1e5
    tiny.vertices *= 1e-9
    shells = trimesh.util.concatenate(
        [trimesh.creation.icosphere(3, radius) for radius in 1 - np.arange(12) * 1e-5]
    )
    corners = np.array(ball.vertices)
    edges = corners[ball.edges_unique].mean(axis=1)
    cloud = rng.normal(size=(20_000, 3)) * 0.4

    def towards(targets: Points, scale: float = 1.0, at: float = 0.0) -> tuple[Points, Points]:
        origins = rng.normal(size=targets.shape)
        origins *= 3 / np.linalg.norm(origins, axis=1, keepdims=True)
        return origins * scale + at, (targets - origins) * scale

    rays = [
        row_of_rays("random", ball, *towards(cloud)),
        row_of_rays("at corners", ball, *towards(corners)),
        row_of_rays("at edges", ball, *towards(edges)),
        row_of_rays("100 km away", far, *towards(cloud, at=1e5)),
        row_of_rays("a nanometre in size", tiny, *towards(cloud[:5000], 1e-9)),
        row_of_rays("12 shells, 10 µm apart", shells, *towards(cloud[:5000])),
    ]
    near = corners * (1 - 2e-4 * rng.random((len(corners), 1)))
    beside = np.concatenate((corners, corners * (1 - 1e-6), corners * (1 + 1e-6)))
    points = [
        row_of_points("random", ball, cloud),
        row_of_points("corners, and beside them", ball, beside),
        row_of_points("100 km away", far, cloud + 1e5),
        row_of_points("a nanometre in size", tiny, cloud * 1e-9),
        row_of_points("between 12 shells", shells, near),
    ]
    head = (
        "| rays, a ball | rays | ours | Embree in a loop: wrong (parity) | trimesh, embreex |\n"
        "|---|---|---|---|---|"
    )
    second = (
        "| points, a ball | points | ours | `contains`: wrong | on the surface |\n"
        "|---|---|---|---|---|"
    )
    return "\n".join([head, *rays, "", second, *points])


def picture() -> str:
    """Return the drawing: a ball from the eye, and where rays to corners and edges count wrong."""
    ball = trimesh.creation.icosphere(3)
    eye = np.array([0.31, 0.22, 3.0])
    edges = np.array(ball.vertices)[ball.edges_unique]
    targets = np.concatenate((ball.vertices, edges.mean(axis=1)))
    origins = np.tile(eye, (len(targets), 1))
    told = loop(ball, origins, targets - eye)
    right = ours(ball, origins, targets - eye)
    front = ((eye - targets) * targets).sum(axis=1) > 0

    def on_film(point: Points) -> Points:
        seen = (point - eye) / (eye - point)[..., 2:] + eye / eye[2]
        return 200 + 520 * seen[..., :2] * (1, -1)

    facing = ((eye - edges) * edges).sum(axis=2).min(axis=1) > 0
    lines = "".join(
        f"M{a[0]:.0f} {a[1]:.0f}L{b[0]:.0f} {b[1]:.0f}" for a, b in on_film(edges[facing])
    )
    wrong = np.flatnonzero(front & (told % 2 != right % 2))
    dots = "".join(f'<circle cx="{x:.0f}" cy="{y:.0f}" r="5"/>' for x, y in on_film(targets[wrong]))
    return (
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 400 400" width="400" height="400">'
        f'<rect width="400" height="400" fill="#fff"/><path d="{lines}" stroke="#8aa" fill="none"/>'
        f'<g fill="none" stroke="#d22" stroke-width="2.5">{dots}</g></svg>\n'
    )


def main() -> None:
    """Print the tables, or draw."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--picture", type=Path, help="the SVG to write in place of the tables")
    given = parser.parse_args()
    if given.picture:
        given.picture.write_text(picture(), encoding="utf-8")
    else:
        print(tables())


if __name__ == "__main__":
    main()
