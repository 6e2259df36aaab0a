"""Which faces are seen: never a seen one that is hidden, nor the reverse."""

from __future__ import annotations

import numpy as np
import pytest
from reference_tracer.projections import PROJECTIONS
from reference_tracer.scene import (
    SceneError,
    ViewWindow,
)
from reference_tracer_visible import HIDDEN, SEEN, visible

from .arrangement import seen_areas
from .scenes import ORTHOGRAPHIC, PERSPECTIVE, camera, cube, judged, scene_of, triangles


@pytest.mark.slow
@pytest.mark.parametrize("projection", [PERSPECTIVE, ORTHOGRAPHIC])
@pytest.mark.parametrize("seed", range(5))
def test_lattice(projection, seed):
    """Corners on a coarse lattice: many share edges and planes, and many are edge-on."""
    random = np.random.default_rng(seed)
    points = random.integers(-4, 5, (random.integers(4, 40), 3, 3)) / 2
    points[..., 2] = np.minimum(points[..., 2], 1.5)
    found = judged(scene_of(triangles(points), camera=camera(projection)))
    assert (found.seen == SEEN).any()


@pytest.mark.parametrize("projection", [PERSPECTIVE, ORTHOGRAPHIC])
@pytest.mark.parametrize("seed", range(6))
def test_closed_meshes(projection, seed):
    """Cubes in and before one another, turned, mirrored, and instances of one mesh."""
    random = np.random.default_rng(seed)
    matrices = []
    for _ in range(random.integers(1, 6)):
        place = np.eye(4)
        place[:3, :3] = random.permutation(np.eye(3)) * random.choice([-1, 1, 0.5], 3)
        if seed % 2:
            place[:3, :3] += random.normal(0, 0.3, (3, 3))
        place[:3, 3] = random.integers(-4, 4, 3) / 2
        matrices.append(place)
    axes = np.linalg.qr(random.normal(size=(3, 3)))[0] if seed > 3 else None
    at = (0, 0, 4) if axes is None else axes[:, 2] * 4
    own = camera(projection, at, axes)
    found = judged(scene_of(*[cube()] * len(matrices), camera=own, matrices=matrices))
    assert (found.seen == HIDDEN).any()


def test_touching_boxes_before_a_turned_camera():
    """Edges that are seen as one point have nothing beside them: what they end is not hidden."""
    random = np.random.default_rng(0)
    axes = np.linalg.qr(random.normal(size=(3, 3)))[0]
    boxes = []
    for _ in range(4):
        corners, sides = cube(random.choice([0.5, 1, 2]))
        boxes.append(((corners + random.integers(-4, 3, 3) / 2) @ axes.T, sides))
    judged(scene_of(*boxes, camera=camera(ORTHOGRAPHIC, axes[:, 2] * 4, axes)))


@pytest.mark.parametrize("width", [2.0**-10, 2.0**-16, 2.0**-20])
@pytest.mark.parametrize("projection", [PERSPECTIVE, ORTHOGRAPHIC])
def test_a_sliver_between_two_walls(projection, width):
    """The wall behind a gap is seen, and found, however few pixels' centres look through."""
    pixel = 0.25
    gap = width * pixel
    wall = [(-4, -4, 0), (4, -4, 0), (4, 4, 0), (-4, 4, 0)]
    quads = [(0, 1, 2), (0, 2, 3)]

    def part(x0, x1, z):
        return [(x0, -4, z), (x1, -4, z), (x1, 4, z), (x0, 4, z)], quads

    x = 0.3125
    meshes = (part(-4, x, 1.0), part(x + gap, 4, 1.0), (np.array(wall) * (2, 2, 1), quads))
    found = judged(scene_of(*meshes, camera=camera(projection)))
    assert (found.seen == SEEN).all()
    closed = part(-4, x, 1.0), part(x, 4, 1.0), meshes[2]
    found = judged(scene_of(*closed, camera=camera(projection)))
    assert (found.seen[4:] == HIDDEN).all()


def test_coplanar_faces():
    """Of faces in one plane the first is seen; of doubled ones only that."""
    small = [(-1, -1, 0), (1, -1, 0), (0, 1, 0)]
    large = [(-4, -4, 0), (4, -4, 0), (0, 6, 0)]
    both = camera(), camera(ORTHOGRAPHIC)
    for own in both:
        found = judged(scene_of(triangles([small, small, large]), camera=own))
        assert found.seen.tolist() == [SEEN, HIDDEN, SEEN]
        found = judged(scene_of(triangles([large, small]), camera=own))
        assert found.seen.tolist() == [SEEN, HIDDEN]


def test_a_lower_face_of_the_same_outline_is_hidden():
    """Though above the upper one there is another whose edges reach over it."""
    outline = [(-1, -1), (1, -1), (0, 1)]
    upper, lower = ([(x, y, z) for x, y in outline] for z in (0.5, 0.0))
    above = [(-0.2, -0.6, 0.9), (1.5, -0.6, 0.9), (0.2, 0.1, 0.9)]
    found = judged(scene_of(triangles([upper, lower, above]), camera=camera(ORTHOGRAPHIC)))
    assert found.seen.tolist() == [SEEN, HIDDEN, SEEN]


@pytest.mark.parametrize("projection", [PERSPECTIVE, ORTHOGRAPHIC])
def test_what_pierces_the_face_before_it_is_hidden_behind_a_third(projection):
    low = [(-1, -1, 0), (1, -1, 0), (0, 1, 0)]
    tilted = [(-9, -9, -2), (9, -9, 2), (0, 9, 0)]
    third = [(0.09, -9, 0.5), (0.06, 9, 0.5), (-9, 0, 0.5)]
    found = judged(scene_of(triangles([low, tilted, third]), camera=camera(projection)))
    assert found.seen.tolist() == [HIDDEN, SEEN, SEEN]


def test_both_sides_are_told_apart():
    """A mirrored instance turns no other side to the camera."""
    front = [(-1, -1, 0), (1, -1, 0), (0, 1, 0)]
    mirrored = np.diag([-1.0, 1, 1, 1])
    for own in (camera(), camera(ORTHOGRAPHIC)):
        for place in (np.eye(4), mirrored):
            for points, behind in ((front, False), (front[::-1], True)):
                scene = scene_of(triangles([points]), camera=own, matrices=[place])
                assert judged(scene).behind.tolist() == [behind]


@pytest.mark.parametrize("seed", range(4))
def test_through_the_camera_and_the_clip_range(seed):
    """Faces around the eye, through its plane, and through both ends of the clip range."""
    random = np.random.default_rng(seed)
    points = random.integers(-8, 9, (20, 3, 3)) / 4
    for projection in (PERSPECTIVE, ORTHOGRAPHIC):
        start = 0.25 if projection is PERSPECTIVE else -1.0
        own = camera(projection, (0, 0, 0.5), clip_start=start, clip_end=1.5)
        judged(scene_of(triangles(points), camera=own))


@pytest.mark.parametrize("projection", [PERSPECTIVE, ORTHOGRAPHIC])
@pytest.mark.parametrize("seed", [6, 34])
def test_behind_a_face_in_the_clip_start(projection, seed):
    """Rounding decides which rays see it, so that it hides nothing, whatever rays beside see."""
    random = np.random.default_rng(seed)
    axes = np.linalg.qr(random.normal(size=(3, 3)))[0]
    start = random.uniform(1, 3)
    own = camera(projection, axes[:, 2] * 4, axes, clip_start=start, width=4, height=4)
    large = np.array([(-9, -9, -start), (30, -9, -start), (-9, 30, -start)])
    at = random.uniform(-0.8, 0.8, (40, 1, 3)) * (1, 1, 0) - (0, 0, 3.5)
    small = at + random.normal(0, 0.002, (40, 3, 3))
    points = np.concatenate((large[None], small)) @ axes.T + own.origin
    scene = scene_of(triangles(points), camera=own)
    hidden = visible(scene).seen == HIDDEN
    assert not any(hidden & (np.array(seen_areas(scene)) > 0))


def test_edge_on_faces_are_hidden():
    wall = triangles([[(0.5, -1, 0), (0.5, 1, 0), (0.5, 0, -3)]])
    found = judged(scene_of(wall, camera=camera(ORTHOGRAPHIC)))
    assert found.seen.tolist() == [HIDDEN]
    found = judged(scene_of(wall, camera=camera(at=(0.5, 0, 4))))
    assert found.seen.tolist() == [HIDDEN]


@pytest.mark.parametrize("projection", [PERSPECTIVE, ORTHOGRAPHIC])
def test_what_touches_the_border_from_outside_is_not_seen(projection):
    """By an edge or a corner; a face of which a strip is within is seen."""
    beside = [[(2, -1, 0), (2, 1, 0), (3, 0, 0)], [(0, 2, 0), (1, 3, 0), (-1, 3, 0)]]
    within = [[(-1, -1.999, 0), (1, -1.999, 0), (0, -3, 0)]]
    found = judged(scene_of(triangles([*beside, *within]), camera=camera(projection)))
    assert (found.seen[:2] != SEEN).all() and found.seen[2] == SEEN


def test_tiny_faces_are_seen_between_pixels():
    """Faces far smaller than a pixel, which no pixel's centre meets."""
    random = np.random.default_rng(3)
    at = random.uniform(-1.5, 1.5, (20, 1, 3)) * (1, 1, 0)
    points = at + random.uniform(-1, 1, (20, 3, 3)) * 0.004
    found = judged(scene_of(triangles(points), camera=camera()))
    assert (found.seen == SEEN).sum() >= 15


def test_nothing_to_see():
    empty = scene_of(triangles(np.zeros((0, 3, 3))), camera=camera())
    assert len(visible(empty).seen) == 0
    beside = triangles([[(50, 0, 0), (51, 0, 0), (50, 1, 0)]])
    assert judged(scene_of(beside, camera=camera())).seen.tolist() == [HIDDEN]


def test_what_is_not_finite_is_hidden():
    matrix = np.diag([1e300, 1, 1, 1])
    matrix[0, 3] = 1e308
    far = triangles([[(1e200, 0, 0), (1, 0, 0), (0, 1, 0)]])
    near = triangles([[(-1, -1, 0), (1, -1, 0), (0, 1, 0)]])
    found = visible(scene_of(far, near, camera=camera(), matrices=[matrix, np.eye(4)]))
    assert found.seen.tolist() == [HIDDEN, SEEN]


def test_a_panorama_is_refused():
    own = camera(PROJECTIONS["equirectangular"], window=ViewWindow(-1, 1, -1, 1))
    with pytest.raises(SceneError, match="'Camera' is equirectangular"):
        visible(scene_of(cube(), camera=own))
