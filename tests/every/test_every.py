"""All that rays meet, each once and in order: held to fractions, and to the tables of reports."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
import trimesh
from reference_tracer import Rays, trace
from reference_tracer.certainty import Certainty
from reference_tracer.certified.definition import seen_by
from reference_tracer.scene import Instance, Mesh, Plane, Scene, SceneError
from reference_tracer.tracer.settings import Settings

from .oracle import every_hit

SCALES = 1.0, 2.0**-500, 2.0**500, (2.0**-300, 1.0, 2.0**310)
RANGES = (0.0, np.inf), (0.5, 1.5), (1.0, 2.0)


def hostile(rng):
    """Return a ball with corners on a lattice: faces without area, doubled, in one plane."""
    ball = trimesh.creation.icosphere(1, 2.0)
    return np.round(ball.vertices + rng.normal(size=ball.vertices.shape) * 0.4), ball.faces


def scene_of(make, vertices, faces, *matrices, clip=(0.0, np.inf)):
    camera = make.camera(4, 4, orthographic=True, clip_start=clip[0], clip_end=clip[1])
    instances = tuple(Instance(0, 0, m) for m in matrices or [np.eye(4)])
    return Scene(camera, (Mesh(vertices, faces, name="Shape"),), instances, objects=("Shape",))


def box(size=1.0):
    shape = trimesh.creation.box((size, size, size))
    return np.array(shape.vertices), np.array(shape.faces)


def rows(found, count):
    """Return the rows of each ray."""
    return [range(*ends) for ends in pairwise(found.start(count).tolist())]


@pytest.mark.parametrize("scale", SCALES, ids=str)
@pytest.mark.parametrize("clip", RANGES, ids=str)
def test_as_fractions_say(scale, clip, make):
    """Through edges and corners, along edges, in planes of faces; from the surface, too."""
    tied = ruled = empty = 0
    for seed in range(2):
        rng = np.random.default_rng(seed)
        vertices, faces = hostile(rng)
        vertices = vertices * scale
        origins, directions = rng.integers(-4, 5, (2, 30, 3)) * np.array(scale)
        directions[~directions.any(axis=1)] = scale
        scene = scene_of(make, vertices, faces, clip=clip)
        found = trace(scene, rays=Rays(origins.T, directions.T), every=True)
        for ray, own in enumerate(rows(found, 30)):
            wanted = every_hit(origins[ray], directions[ray], vertices[faces], *clip)
            assert found.triangle[own].tolist() == [hit.triangle for hit in wanted], (seed, ray)
            assert found.t[own].tolist() == [float(hit.t) for hit in wanted]
            assert found.enters[own].tolist() == [hit.enters for hit in wanted]
            level = [False, *(a.t == b.t for a, b in pairwise(wanted))]
            assert found.same_t[own].tolist() == level[: len(wanted)]
            empty += not wanted
        tied += found.same_t.sum()
        ruled += (found.certainty == Certainty.AMBIGUOUS).sum()
    assert ruled > 4 and empty < 58 and (tied or clip[0])


@pytest.mark.parametrize("scale", [1.0, 2.0**-500, 2.0**500])
def test_a_closed_mesh_is_entered_and_left_in_turn(scale, make):
    """Along rays to each corner of a ball, and to points of each edge."""
    ball = trimesh.creation.icosphere(2)
    vertices = ball.vertices * scale
    ends = np.concatenate((vertices, vertices[ball.edges_unique].mean(axis=1)))
    origin = np.array([[2.0], [0.5], [0.25]]) * scale
    scene = scene_of(make, vertices, ball.faces)
    found = trace(scene, rays=Rays(origin, ends.T - origin), every=True)
    assert (found.certainty == Certainty.AMBIGUOUS).sum() > 50
    for own in rows(found, len(ends)):
        assert len(own) in (0, 2)
        assert found.enters[own].tolist() == [True, False][: len(own)]


def unit_cube(make, *matrices):
    return scene_of(make, *box(), *matrices)


def crossed(scene, origin, direction):
    """Return t of all hits of a ray, those that enter as positive numbers, those that leave not."""
    rays = Rays(np.array([origin], float).T, np.array([direction], float).T)
    found = trace(scene, rays=rays, every=True)
    return [t if enters else -t for t, enters in zip(found.t, found.enters, strict=True)]


def of_even(hits):
    """Return whether hits enter and leave in turn, as of a point outside."""
    return len(hits) % 2 == 0 and [t > 0 for t in hits] == [True, False] * (len(hits) // 2)


@pytest.mark.parametrize(
    ("origin", "direction", "count"),
    [
        ((-1, 0, 0), (1, 0, 0), 2),  # parry #171, by its rays: at the diagonal of a face
        ((-0.5, 0.5, 0.5), (1, 1, 0), None),  # begins on an edge, and leaves: none of it is met
        ((-0.5, 0.5, 0.5), (1, 1, 1), None),  # begins at a corner
        ((-1, -1, 0.5), (1, 1, 0), None),  # through two edges, in the plane of a face
        ((-1, -1, -1), (1, 1, 1), 2),  # through two corners
        ((1, 0.1, 0.1), (-1, 0, 0), 2),  # libigl #2026: three hits were told, one of them twice
        ((0.25, 0.25, 3), (0, 0, -1), 2),  # trimesh #1766: at the diagonal between two triangles
        ((-1, 0.5, 0.5), (1, 0, 0), None),  # manifold 1645: along an edge
        ((-1, 0, 0.5), (1, 0, 0), None),  # in the plane of a face
        ((0, 0, -0.3), (0, 0, 1), 1),  # its +Z ray meets a diagonal: inside
        ((0.5, 0.5, -3), (0, 0, 1), None),  # its +Z ray runs along an edge: outside
        ((4.5, 0, -23), (0, 0, 1), 0),  # libigl #2025: far beside the mesh, thousands were told
    ],
)
def test_rays_of_public_reports(origin, direction, count, make):
    """By hand; where what is met is a matter of the rule, it is none or two, not one or three."""
    hits = crossed(unit_cube(make), origin, direction)
    assert len(hits) == count if count is not None else len(hits) in (0, 2)
    assert count == 1 or of_even(hits)


def test_face_edge_and_corner_of_a_box(make):
    """trimesh #2317: one hit in a face, two at an edge, n at a corner? One, whichever it is."""
    scene = unit_cube(make)
    for target in ((0.5, 0.1, 0.2), (0.5, 0.5, 0.2), (0.5, 0.5, 0.5)):
        assert crossed(scene, (0, 0, 0), target) == [-1.0]


def test_walls_of_something_hollow(make):
    """parry #411: four hits, to be sorted, of which the distances are the walls' thickness."""
    outer, inner = box(2.0), box(1.0)
    vertices = np.concatenate((outer[0], inner[0]))
    faces = np.concatenate((outer[1], inner[1][:, ::-1] + 8))
    assert crossed(scene_of(make, vertices, faces), (-3, 0, 0), (1, 0, 0)) == [2, -2.5, 3.5, -4]


def test_an_edge_that_was_met_three_times(make):
    """trimesh #85: a point outside, whose ray grazes an edge, where three hits were counted."""
    roof = np.array([(0, -1, 0), (0, 1, 0), (1, 0, -1), (2, 0, 1)], float)
    scene = scene_of(make, roof, np.array([(0, 1, 2), (0, 3, 1), (1, 3, 2), (0, 2, 3)]))
    for x in (-1, 0, 1):
        assert of_even(crossed(scene, (x, -3, 0), (0, 1, 0)))
        assert of_even(crossed(scene, (x, 0, -3), (0, 0, 1)))


def test_coinciding_surfaces_come_by_name_and_are_marked(make):
    """Two instances in one place, a plane through both their faces, and a mirrored third."""
    mirror = np.diag([-1.0, 1, 1, 1])
    scene = unit_cube(make, np.eye(4), np.eye(4), mirror)
    planes = (Plane(0, (-0.5, 0, 0), (-1, 0, 0)),)
    scene = Scene(scene.camera, scene.meshes, scene.instances, planes, objects=scene.objects)
    rays = Rays(np.array([[-2.0], [0.1], [0.2]]), np.array([[1.0], [0], [0]]))
    found = trace(scene, rays=rays, every=True)
    assert found.t.tolist() == [1.5] * 4 + [2.5] * 3
    assert found.instance.tolist() == [0, 1, 2, 3, 0, 1, 2]
    assert found.same_t.tolist() == [False, True, True, True, False, True, True]
    assert found.enters.tolist() == [True] * 3 + [False] * 4  # a plane encloses nothing
    assert (found.certainty == Certainty.AMBIGUOUS).all()
    assert np.abs(found.s[:, 3]).sum() == 0 and (found.s.sum(axis=0) > 0.99).sum() == 6


def test_depths_that_round_alike_come_in_their_exact_order(make):
    """1 + 2^-52 / 3 and 1 + 2^-52 / 4: the face that is nearer is the second one."""
    faces = [[(1, -1, -1), (1, 1, -1), (1 + 2.0**-52, 0, top)] for top in (2, 3)]
    scene = scene_of(make, np.reshape(faces, (6, 3)), np.arange(6).reshape(2, 3))
    found = trace(scene, rays=Rays(np.zeros((3, 1)), np.eye(3)[:, :1]), every=True)
    assert found.t.tolist() == [1, 1]
    assert found.triangle.tolist() == [1, 0] and not found.same_t.any()


def test_as_many_as_the_definition_counts(make):
    """Of any rays of a scene with planes, also those that share an origin or a direction."""
    rng = np.random.default_rng(3)
    scene = make.room()
    clip = scene.camera.clip_start, scene.camera.clip_end
    some = rng.normal(size=(2, 3, 40))
    for rays in (Rays(*some), Rays(some[0, :, :1], some[1]), Rays(some[0], some[1, :, :1])):
        found = trace(scene, rays=rays, every=True)
        counts = [seen.crossings for seen in seen_by(scene, rays, clip)]
        assert np.diff(found.start(40)).tolist() == counts and max(counts) > 1


def test_rays_that_are_none_or_the_cameras(make):
    scene = unit_cube(make)
    none = trace(scene, rays=Rays(np.zeros((3, 0)), np.zeros((3, 0))), every=True)
    assert len(none) == 0 and none.start(0).tolist() == [0]
    assert len(trace(scene, every=True).start(16)) == 17


def test_rays_in_other_types_and_shapes(make):
    """Those of float16 are float64's, too; of two counts, none is traced."""
    scene = unit_cube(make)
    for dtype in (np.float16, np.float32):
        rays = Rays(np.zeros((3, 1), dtype), np.array([[0], [0], [0.5]], dtype))
        assert trace(scene, rays=rays, every=True).t.tolist() == [1]
    for counts in ((4, 5), (5, 4)):
        with pytest.raises(SceneError, match="of rays must have the shape"):
            trace(scene, rays=Rays(*(np.ones((3, count)) for count in counts)))


def test_a_method_that_proves_nothing_is_refused(make):
    """Else the hits would be taken for the method's."""
    scene = make.scene(make.camera(), make.mesh(trimesh.creation.box()))
    with pytest.raises(SceneError, match="textbook"):
        trace(scene, Settings("textbook"), every=True)
