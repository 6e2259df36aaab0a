"""Counts the faces of a city that samples miss, beside `reftrace visible`: with embreex.

    .venv/bin/python tools/visible_faces.py [BLOCKS [PICTURE.svg]]  # 57, a side: a million faces
    .venv/bin/python tools/visible_faces.py 4 docs/images/visible.svg

The city is made from a seed. embreex counts which triangles 8 x 8 samples of each pixel see. The
picture has a red ring around each one that they miss.
"""

from __future__ import annotations

import sys
import time
from pathlib import Path

import numpy as np
from reference_tracer.framing import Choice
from reference_tracer.rendering import render
from reference_tracer.scene import Instance, Mesh, Scene
from reference_tracer.tracer.camera import camera_rays, film_of
from reference_tracer_benchmarks.peers import Embreex
from reference_tracer_benchmarks.rays import Rays
from reference_tracer_visible import HIDDEN, SEEN, UNDECIDED, visible

SIDE = 5  # quads along the side of a house
SAMPLES = 8  # along the side of a pixel
SIZE = 960, 540


def main() -> None:
    """Print the table."""
    scene = city(int(sys.argv[1]) if sys.argv[1:] else 57)
    began = time.process_time()
    render(scene)
    picture = time.process_time() - began
    began = time.process_time()
    found = visible(scene)
    ours = time.process_time() - began
    began = time.process_time()
    sampled = by_samples(scene)
    theirs = time.process_time() - began
    seen = found.seen == SEEN
    wrong = np.count_nonzero(sampled & (found.seen == HIDDEN))
    print(f"{scene.triangle_count:,} faces, {SIZE[0]} x {SIZE[1]} pixels; CPU seconds:")
    print(f"certified picture  {picture:8.1f} s")
    print(f"reftrace visible   {ours:8.1f} s  {np.count_nonzero(seen):,} seen, ", end="")
    print(f"{np.count_nonzero(found.seen == UNDECIDED):,} undecided")
    print(f"embreex, 8 x 8     {theirs:8.1f} s  {np.count_nonzero(sampled):,} seen, ", end="")
    print(f"{np.count_nonzero(seen & ~sampled):,} missed, {wrong:,} hidden ones named")
    for path in sys.argv[2:]:
        Path(path).write_text(drawn(scene, seen, found.witness[seen & ~sampled]), encoding="utf-8")


def drawn(scene: Scene, seen: np.ndarray, missed: np.ndarray) -> str:
    """Return the outlines of the faces that are seen, and rings around those that are missed."""
    width, height = SIZE
    mesh = scene.meshes[0]
    x, y, _ = film_of(scene.camera, mesh.vertices.T.astype(float))
    at = np.round(np.stack((x, height - y), axis=1)).astype(int)
    faces = at[mesh.triangles[seen]].reshape(-1, 6)
    lines = "".join("M{} {}L{} {} {} {}Z".format(*face) for face in np.unique(faces, axis=0))
    rings = "".join(
        f'<circle cx="{x:.0f}" cy="{height - y:.0f}" r="9" fill="none" stroke="#d00"/>'
        for x, y in missed
    )
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}">'
        f'<rect width="{width}" height="{height}" fill="#fff"/>'
        f'<path d="{lines}" fill="none" stroke="#999" stroke-width=".5"/>{rings}</svg>\n'
    )


def by_samples(scene: Scene) -> np.ndarray:
    """Return which triangles embreex sees by 8 x 8 samples a pixel."""
    tracer = Embreex(scene.meshes[0])
    tracer.build()
    camera = scene.camera
    x = (np.arange(SAMPLES * camera.width) + 0.5) / SAMPLES
    seen = np.zeros(scene.triangle_count, bool)
    for y in (np.arange(SAMPLES * camera.height) + 0.5) / SAMPLES:
        directions = camera_rays(camera, x, np.full_like(x, y)).directions.T
        origins = camera.origin + camera.clip_start * directions
        rays = Rays(
            origins.astype(np.float32),
            directions.astype(np.float32),
            camera.clip_end - camera.clip_start,
            len(x),
            slice(None),
        )
        _, hits = tracer.trace(rays)
        seen[hits["primID"][hits["primID"] >= 0]] = True
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
    mesh = Mesh(vertices, triangles.astype(np.int32), name="city")
    choice = Choice(eye=(-6, -9, 7), target=(blocks / 2, blocks / 2, 0), angle=37)
    return Scene(choice.placed(*SIZE), (mesh,), (Instance(0, 0, np.eye(4)),), objects=("city",))


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


if __name__ == "__main__":
    main()
