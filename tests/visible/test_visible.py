"""Which faces are seen: never a seen one that is hidden, nor the reverse."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from reference_tracer.certified.definition import seen_by
from reference_tracer.projections import PROJECTIONS
from reference_tracer.scene import (
    Camera,
    Instance,
    Mesh,
    Plane,
    Region,
    Scene,
    SceneError,
    ViewWindow,
)
from reference_tracer.tracer.camera import camera_rays
from reference_tracer_visible import HIDDEN, SEEN, UNDECIDED, visible

from .arrangement import seen_areas

PERSPECTIVE, ORTHOGRAPHIC = PROJECTIONS["perspective"], PROJECTIONS["orthographic"]
GREY = np.full((1, 4), 0.5, np.float32)


def camera(projection=PERSPECTIVE, at=(0, 0, 4), axes=None, **others):
    matrix = np.eye(4)
    matrix[:3, :3] = np.eye(3) if axes is None else axes
    matrix[:3, 3] = at
    half = 0.5 if projection is PERSPECTIVE else 2.0
    given = {"clip_start": 0.25, "clip_end": 64.0, "width": 16, "height": 16} | others
    window = given.pop("window", ViewWindow(-half, half, -half, half))
    return Camera(matrix, window, projection=projection, **given)


def scene_of(*meshes, camera=None, matrices=None, planes=()):
    """Return a scene of meshes (vertices, triangles), an instance each."""
    made = [Mesh(np.array(v, np.float64), np.array(t, np.int32)) for v, t in meshes]
    places = matrices or [np.eye(4)] * len(made)
    instances = [Instance(k, 0, place, GREY) for k, place in enumerate(places)]
    return Scene(camera, tuple(made), tuple(instances), planes, objects=("things",))


def triangles(points):
    """Return a mesh of triangles (n, 3, 3) that share no vertex."""
    points = np.asarray(points, np.float64).reshape(-1, 3)
    return points, np.arange(len(points)).reshape(-1, 3)


def cube(size=1.0):
    v = np.array([(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)]) * size
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return v, [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]


def judged(scene, **options):
    """Return what is found, held against the oracle; every witness is traced again."""
    found = visible(scene, **options)
    for face, area in enumerate(seen_areas(scene)):
        state = found.seen[face]
        assert state != SEEN or area > 0, f"face {face} is seen, but hidden"
        assert state != HIDDEN or area == 0, (
            f"face {face} is hidden, but {float(area)} px² are seen"
        )
        if state == UNDECIDED:
            assert area <= Fraction(found.area[face]) + Fraction(1, 10**12), face
        else:
            assert found.area[face] == 0, face
    check_witnesses(scene, found)
    return found


def check_witnesses(scene, found):
    seen = np.flatnonzero(found.seen == SEEN)
    assert (
        np.isfinite(found.witness[seen]).all() and np.isnan(found.witness[found.seen != SEEN]).all()
    )
    rays = camera_rays(scene.camera, *found.witness[seen].T)
    clip = scene.camera.clip_start, scene.camera.clip_end
    for face, ray in zip(seen.tolist(), seen_by(scene, rays, clip), strict=True):
        instance = int(np.searchsorted(found.start, face, side="right")) - 1
        assert ray.name == (instance, face - found.start[instance])


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
def test_border_shift_and_planes(projection):
    """What is beside the region counts no more than what a plane hides."""
    random = np.random.default_rng(5)
    points = random.integers(-8, 9, (24, 3, 3)) / 4
    points[..., 2] = np.minimum(points[..., 2], 2)
    plane = Plane(0, np.array([0.0, 0.0, -0.25]), np.array([0.0, 0.25, 1.0]), GREY[0])
    half = 0.5 if projection is PERSPECTIVE else 2.0
    window = ViewWindow(-half, half, -half, half).moved(0.25, -0.125)
    own = camera(projection, window=window, region=Region(3, 5, 9, 14))
    found = judged(scene_of(triangles(points), camera=own, planes=(plane,)))
    assert (found.seen == SEEN).any() and (found.seen == HIDDEN).any()


@pytest.mark.parametrize("projection", [PERSPECTIVE, ORTHOGRAPHIC])
@pytest.mark.parametrize("seed", [31, 83, 111])
def test_what_two_planes_leave_at_the_edge_of_a_long_face(projection, seed):
    """A tip as thin as the rounding of where the first plane cuts the face's edge."""
    random = np.random.default_rng(seed)
    angle = random.uniform(0, 2 * np.pi)
    along = np.array([np.cos(angle), np.sin(angle), 0])
    across = np.array([-np.sin(angle), np.cos(angle), 0])
    up = np.array([0, 0, 1])
    first = Plane(0, np.zeros(3), up + along, GREY[0])
    second = Plane(0, across * random.uniform(0, 1e-10), up - across, GREY[0])
    face = triangles([along * -6e5, along * 6e5, across * 0.2])
    judged(scene_of(face, camera=camera(projection), planes=(first, second)))


def test_a_plane_whose_normal_is_very_long_or_short():
    """What over- or underflows says nothing of what is behind the plane."""
    far = 2.0**25
    face = [(far, 0.001, 1 - far), (far, 0.002, 1 - far), (-far, 0.001, 1 + far)]
    plane = Plane(0, np.zeros(3), np.array([1, 0, 1]) * 2.0**1000, GREY[0])
    judged(scene_of(triangles(face), camera=camera(ORTHOGRAPHIC), planes=(plane,)))
    random = np.random.default_rng(1286)
    normal = np.array((*random.normal(0, 0.3, 2), 1)) * 2.0**-525
    plane = Plane(0, np.zeros(3), normal * 2.0**-525, GREY[0])
    x, y = random.normal(0, 0.3, (3, 2)).T * [[1], [0.01]]
    slope = plane.normal * 2.0**600 * 2.0**450
    above = -(x * slope[0] + y * slope[1]) / slope[2] + 2.0**-26 * random.random()
    face = np.stack((x, y, above), axis=1)
    judged(scene_of(triangles(face), camera=camera(ORTHOGRAPHIC), planes=(plane,)))


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


@pytest.mark.parametrize("projection", [PERSPECTIVE, ORTHOGRAPHIC])
@pytest.mark.parametrize("flat", ["plane", "face"])
def test_what_sticks_out_of_the_ground_by_a_rounding_is_hardly_seen(projection, flat):
    """A strip that few rays meet has a witness; a tip that none meets may show next to nothing."""
    turns = np.linspace(0, 2 * np.pi, 9)[:-1]
    ring = np.stack((np.cos(turns), np.sin(turns), np.full(8, 2.0**-53)), axis=1)
    points = np.concatenate((ring, ring * (0.5, 0.5, 0) - (0, 0, 0.5)))
    bands = [t for k in range(8) for n in [(k + 1) % 8] for t in ((k, n, k + 8), (n, n + 8, k + 8))]
    plane = Plane(0, np.zeros(3), np.array([0.0, 0.0, 1.0]), GREY[0])
    tilt = np.array([[1, 0, 0], [0, 0.28, -0.96], [0, 0.96, 0.28]])
    own = camera(projection, at=4 * tilt[:, 2], axes=tilt)
    found = judged(scene_of((points, bands), camera=own, planes=(plane,)))
    assert (found.area < 1e-6).all()
    assert (found.seen[::2] == SEEN).sum() > 5 and (found.seen[1::2] == UNDECIDED).any()


@pytest.mark.parametrize("height", [1e-4, 1e-6, 1e-9])
@pytest.mark.parametrize("projection", [PERSPECTIVE, ORTHOGRAPHIC])
def test_an_edge_just_above_the_ground_is_seen(projection, height):
    """Most of the face is below, so that rays through its middle see the ground."""
    tilt = np.array([[1, 0, 0], [0, 0.28, -0.96], [0, 0.96, 0.28]])
    face = [(0, 0, -1), (0.25, -0.5, height), (-0.25, 0.5, height)]
    ground = [(-5, -5, 0), (15, -5, 0), (-5, 15, 0)]
    own = camera(projection, at=4 * tilt[:, 2], axes=tilt)
    found = judged(scene_of(triangles([face, ground]), camera=own))
    assert found.seen.tolist() == [SEEN, SEEN]
