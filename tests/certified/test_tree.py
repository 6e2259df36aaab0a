"""Any rays, culled by a tree of boxes, see what `definition.py` says: also where all is hostile."""

from __future__ import annotations

import numpy as np
import pytest
from reference_tracer.certified.any_rays import nearest_hits
from reference_tracer.certified.definition import seen_by
from reference_tracer.certified.tree import WIDE, _cuts
from reference_tracer.certified.triangle_tree import TriangleTree
from reference_tracer.scene import Instance, Mesh, Scene
from reference_tracer.tracer.camera import Rays
from reference_tracer.tracer.hits import Statistics
from reference_tracer.tracer.progress import result_of

ENDS = (0.0, np.inf), (0.25, 3.0), (-2.0, 2.0)
# Of a lattice: sides in the rays' own planes, rays through corners and along edges.
SCALES = 1.0, 2.0**-500, 2.0**300, 1e-3, 3e7


def scene_of(make, triangles, matrix=None, planes=()):
    """Return a scene of triangles (n, 3, 3), each with corners of its own."""
    vertices = np.asarray(triangles, float).reshape(-1, 3)
    faces = np.arange(len(vertices)).reshape(-1, 3)
    mesh = Mesh(vertices, faces)
    matrices = [np.eye(4)] if matrix is None else matrix
    instances = tuple(Instance(0, 0, m) for m in matrices)
    return Scene(make.camera(4, 4), (mesh,), instances, planes, objects=("Mesh",))


def seen(scene, rays, clip, culled=True):
    return result_of(nearest_hits(scene, rays, clip, Statistics(), culled))


def check(scene, rays, clip=(0.0, np.inf)):
    """Hold the culled hits equal to the definition."""
    found = seen(scene, rays, clip)
    every = list(seen_by(scene, rays, clip))
    assert len(every) == len(found) == rays.count
    names = zip(found.instance.tolist(), found.triangle.tolist(), strict=True)
    for k, (name, wanted) in enumerate(zip(names, every, strict=True)):
        assert name == wanted.name, k
        assert found.t[k] == wanted.t, k
        assert found.ties.get(k, frozenset()) == wanted.ties, k
    return every


@pytest.mark.parametrize("clip", ENDS)
@pytest.mark.parametrize("scale", SCALES)
def test_on_a_lattice(scale, clip, make):
    rng = np.random.default_rng(5)
    triangles = rng.integers(-2, 3, (45, 3, 3)) * scale
    origins = rng.integers(-3, 4, (3, 40)) * scale
    directions = rng.integers(-2, 3, (3, 40)) * scale
    directions[:, 7] = 0  # it meets nothing
    every = check(scene_of(make, triangles), Rays(origins, directions), clip)
    assert sum(bool(s.ties) for s in every) > 3


@pytest.mark.parametrize("exponent", [-1000, -537, -300, 0, 200])
def test_directions_with_components_of_all_sizes(exponent, make):
    """Some are subnormal beside others; some are 0, with either sign."""
    rng = np.random.default_rng(exponent + 2000)
    triangles = rng.normal(size=(40, 3, 3))
    directions = np.ldexp(rng.normal(size=(3, 60)), rng.integers(-60, 1, (3, 60)) * 9 + exponent)
    directions[rng.integers(0, 3, 60), np.arange(60)] *= rng.choice((0.0, -0.0, 1.0, 2.0**-400), 60)
    some = directions.any(axis=0)
    origins = rng.integers(-1, 2, (3, 60)) * rng.choice((0.0, 0.5, 1.5), (3, 60))
    check(scene_of(make, triangles), Rays(origins[:, some], directions[:, some]))


@pytest.mark.parametrize("count", [0, 1, WIDE, WIDE + 1, 200])
def test_of_any_number_of_triangles(count, make):
    rng = np.random.default_rng(count)
    scene = scene_of(make, rng.normal(size=(count, 3, 3)))
    tree = TriangleTree.of(scene)
    assert (tree.boxes.children[tree.boxes.is_last] >= 0).sum() == count
    check(scene, Rays(rng.normal(size=(3, 20)), rng.normal(size=(3, 20))))


@pytest.mark.parametrize("count", [600, pytest.param(20_000, marks=pytest.mark.torture)])
def test_as_with_every_triangle(count, make):
    """Larger, and with fewer pairs by far."""
    rng = np.random.default_rng(count)
    middle = rng.normal(size=(count, 1, 3))
    scene = scene_of(make, middle + 0.1 * rng.normal(size=(count, 3, 3)))
    origins = 3 * rng.normal(size=(3, 300))
    rays = Rays(origins, rng.normal(size=(3, 300)) - origins)
    culled, every = Statistics(), Statistics()
    own = result_of(nearest_hits(scene, rays, (0, np.inf), culled))
    other = result_of(nearest_hits(scene, rays, (0, np.inf), every, culled=False))
    assert (own.instance == other.instance).all() and (own.triangle == other.triangle).all()
    assert (own.values == other.values).all() and (own.certainty == other.certainty).all()
    assert (own.triangle >= 0).sum() > 20
    assert culled.pairs_tested < every.pairs_tested / 100


def touching(make, seed):
    """Return a few triangles, and rays exactly at their corners: many touch the box there alone.

    Where a direction has a 0, the ray is in a side of the box.
    """
    rng = np.random.default_rng(seed)
    triangles = rng.integers(-3, 4, (int(rng.integers(1, 4)), 3, 3)) * 1.0
    directions = rng.integers(-99, 100, (3, 60)) * rng.choice((0.0, 1.0, 1.0), (3, 60))
    directions = directions[:, directions.any(axis=0)]
    corner = rng.integers(0, 3 * len(triangles), directions.shape[1])
    away = rng.choice((1, 1000, 2**30), directions.shape[1])
    return scene_of(make, triangles), Rays(
        triangles.reshape(-1, 3)[corner].T - away * directions, directions
    )


def test_rays_that_touch_a_corner(make):
    ties = 0
    for seed in range(12):
        ties += sum(bool(s.ties) for s in check(*touching(make, seed)))
    assert ties > 200


@pytest.mark.parametrize(
    ("name", "value"),
    [("tree._LOOSE", -1e-3), ("tree._LOOSE", 0.0)],
)
def test_a_tree_that_drops_too_much_is_found(name, value, make, monkeypatch):
    """The test above sees it where the bounds are left out."""
    monkeypatch.setattr(f"reference_tracer.certified.{name}", value)
    with pytest.raises(AssertionError):
        for seed in range(12):
            check(*touching(make, seed))


@pytest.mark.parametrize("leaves", [1, 2, 3, 5, 17, 164_000])
def test_parts_are_cut_to_few_more_leaves_than_needed(leaves):
    assert leaves <= np.prod(_cuts(leaves)) <= max(1.2 * leaves, leaves + 1)
