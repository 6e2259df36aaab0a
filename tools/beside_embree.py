"""What Embree and trimesh count wrong, beside `every`, `inside` and `visible`, and their seconds.

    .venv/bin/python tools/beside_embree.py [BLOCKS]  # 57, a side of the city: a million faces

The tables of docs/every.md and docs/visible.md. Beside `trace(..., every=True)`: Embree through
embreex, called again and again from a little behind each hit; trimesh's `intersects_id`, which does
so with embreex. Beside `inside`: trimesh's `contains`. A ray is wrong if the number of surfaces is
another; the parity, if that is odd where ours is even, or the reverse. Beside `visible`, of a city
made from a seed: which triangles embreex sees by 8 x 8 samples of each pixel.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from typing import Any

import numpy as np
import trimesh
from numpy.typing import NDArray
from reference_tracer import Camera, Instance, Mesh, Rays, Scene, ViewWindow, inside, trace
from reference_tracer.framing import Choice
from reference_tracer.projections import ORTHOGRAPHIC
from reference_tracer.tracer.camera import camera_rays
from reference_tracer_benchmarks.peers import Embreex
from reference_tracer_benchmarks.rays import Rays as Float32Rays
from reference_tracer_visible import HIDDEN, SEEN, UNDECIDED, visible

Points = NDArray[np.float64]  # (n, 3)
MOST = 64  # hits of a ray
SIDE = 5  # quads along the side of a house
SAMPLES = 8  # along the side of a pixel
SIZE = 960, 540


def scene_of(camera: Camera, vertices: NDArray, triangles: NDArray) -> Scene:
    """Return one mesh as a scene."""
    mesh = Mesh(vertices, triangles)
    return Scene(camera, (mesh,), (Instance(0, 0, np.eye(4)),), objects=("Shape",))


def unclipped(shape: trimesh.Trimesh) -> Scene:
    """Return a mesh as a scene, whose camera clips nothing in front."""
    window = ViewWindow(-1, 1, -1, 1)
    camera = Camera(np.eye(4), window, 4, 4, ORTHOGRAPHIC, clip_start=0.0, clip_end=np.inf)
    return scene_of(camera, np.array(shape.vertices), np.array(shape.faces))


def first_hits(
    embree: Embreex, origins: Points, directions: Points, length: float = np.inf
) -> dict[str, Any]:
    """Return what Embree finds of rays in float32."""
    rays = origins.astype(np.float32), directions.astype(np.float32)
    return embree.trace(Float32Rays(*rays, length, len(origins), slice(None)))[1]


def ours(shape: trimesh.Trimesh, origins: Points, directions: Points) -> NDArray[np.int64]:
    """Return how many surfaces each ray meets, certified."""
    found = trace(unclipped(shape), rays=Rays(origins.T, directions.T), every=True)
    return np.diff(found.start(len(origins)))


def loop(shape: trimesh.Trimesh, origins: Points, directions: Points) -> NDArray[np.int64]:
    """Count by Embree, from 1e-5 of the mesh's size behind each hit."""
    embree = Embreex(Mesh(shape.vertices.astype(np.float32), np.array(shape.faces)))
    step = 1e-5 * shape.scale / np.linalg.norm(directions, axis=1)
    origins = origins.copy()
    count = np.zeros(len(origins), int)
    live = np.arange(len(origins))
    for _ in range(MOST):
        found = first_hits(embree, origins[live], directions[live])
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
    found, seconds = timed(inside, unclipped(shape), points)
    told, others = timed(shape.contains, points)
    off = found.place < 2
    wrong = (told != (found.place == 1))[off].sum()
    on = f"{(~off).sum():,}, {told[~off].sum():,} of them inside"
    return f"| {name} | {len(points):,} | {seconds} | {wrong:,}, {others} | {on} |"


def hits_and_points() -> str:
    """Return the tables of rays and of points."""
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


def by_samples(scene: Scene) -> np.ndarray:
    """Return which triangles embreex sees by 8 x 8 samples a pixel."""
    embree = Embreex(scene.meshes[0])
    camera = scene.camera
    x = (np.arange(SAMPLES * camera.width) + 0.5) / SAMPLES
    seen = np.zeros(scene.triangle_count, bool)
    for y in (np.arange(SAMPLES * camera.height) + 0.5) / SAMPLES:
        directions = camera_rays(camera, x, np.full_like(x, y)).directions.T
        origins = camera.origin + camera.clip_start * directions
        length = camera.clip_end - camera.clip_start
        found = first_hits(embree, origins, directions, length)["primID"]
        seen[found[found >= 0]] = True
    return seen


def city(blocks: int, seed: int = 1) -> Scene:
    """Return houses, a tower on the roof of each, and the ground, seen from above a corner."""
    random = np.random.default_rng(seed)
    parts = [box((-1, -1, -1), (blocks + 1, blocks + 1, 0), 1)]
    for x, y in np.ndindex(blocks, blocks):
        half = random.uniform(0.25, 0.45, 2)
        height = random.gamma(2.0, 0.7) + 0.3
        at = np.array([x + 0.5, y + 0.5])
        parts.append(box((*(at - half), 0), (*(at + half), height), SIDE))
        top = height + random.uniform(0.1, 0.4)
        parts.append(box((*(at - half / 3), height), (*(at + half / 4), top), 1))
    first = np.cumsum([0, *(len(vertices) for vertices, _ in parts)])
    vertices = np.concatenate([v for v, _ in parts]).astype(np.float32)
    triangles = np.concatenate([t + k for (_, t), k in zip(parts, first, strict=False)])
    choice = Choice(eye=(-6, -9, 7), target=(blocks / 2, blocks / 2, 0), angle=37)
    return scene_of(choice.placed(*SIZE), vertices, triangles)


def box(
    low: tuple[float, ...], high: tuple[float, ...], side: int
) -> tuple[np.ndarray, np.ndarray]:
    """Return a closed box of `side` x `side` quads on each side: vertices and triangles."""
    at = np.arange(side + 1) / side
    grid = np.stack(np.meshgrid(at, at, indexing="ij"), axis=-1).reshape(-1, 2)
    i, j = np.indices((side, side)).reshape(2, -1)
    a = i * (side + 1) + j
    b, c, d = a + side + 1, a + side + 2, a + 1
    quads = np.concatenate((np.stack((a, b, c), axis=1), np.stack((a, c, d), axis=1)))
    vertices = np.empty((6, len(grid), 3))
    triangles = []
    for number, (axis, end) in enumerate(np.ndindex(3, 2)):
        vertices[number, :, axis] = end
        vertices[number][:, [(axis + 1) % 3, (axis + 2) % 3]] = grid
        triangles.append((quads if end else quads[:, ::-1]) + number * len(grid))
    welded, place = np.unique(vertices.reshape(-1, 3), axis=0, return_inverse=True)
    corners = place.reshape(-1)[np.concatenate(triangles)]
    return np.array(low) + welded * (np.array(high) - low), corners


def faces(blocks: int) -> str:
    """Return the table of a city's faces."""
    scene = city(blocks)
    found, ours = timed(visible, scene)
    told, theirs = timed(by_samples, scene)
    seen, undecided = (found.seen == state for state in (SEEN, UNDECIDED))
    missed, wrong = (seen & ~told).sum(), (told & (found.seen == HIDDEN)).sum()
    rows = [
        f"| {scene.triangle_count:,} faces | seen | missed | hidden, but named | undecided | |",
        "|---|---|---|---|---|---|",
        f"| `reftrace visible` | {seen.sum():,} | | | {undecided.sum():,} | {ours} |",
        f"| embreex, 8 × 8 | {told.sum():,} | {missed:,} | {wrong:,} | | {theirs} |",
    ]
    return "\n".join(rows)


if __name__ == "__main__":
    print(hits_and_points(), faces(int(sys.argv[1]) if sys.argv[1:] else 57), sep="\n\n")
