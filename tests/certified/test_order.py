"""Order by what two surfaces are, once: as by every ray's own integers."""

from __future__ import annotations

import numpy as np
import pytest
from reference_tracer.certainty import Certainty, Reason
from reference_tracer.certified.decisions import Decisions
from reference_tracer.projections import ORTHOGRAPHIC, PERSPECTIVE
from reference_tracer.rendering import render
from reference_tracer.scene import Camera, Instance, Mesh, Plane, Scene, ViewWindow
from reference_tracer.tracer.settings import Settings

ULP = 2.0**-52


def turned(rng):
    return np.linalg.qr(rng.normal(size=(3, 3)))[0]


def layers(rng, orthographic, with_plane):
    """Return triangles across the view at depths some ulp apart, one of them twice."""
    world_from_camera = np.eye(4)
    world_from_camera[:3, :3] = turned(rng)
    world_from_camera[:3, 3] = rng.normal(size=3) * 10.0 ** rng.integers(0, 5)
    half = 2.0 if orthographic else 0.45
    projection = ORTHOGRAPHIC if orthographic else PERSPECTIVE
    window = ViewWindow(-1.7 * half, 1.7 * half, -half, half)
    camera = Camera(world_from_camera, window, 32, 18, projection=projection)
    mesh = Mesh(np.array([(-9.0, -9, 0), (9, -9, 0), (0, 12, 0)]), [[0, 1, 2]])
    matrices = []
    for k in range(4):
        angle, matrix = rng.uniform(0, 6), np.eye(4)
        matrix[:2, :2] = [[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]]
        matrix[2, 3] = -5 * (1 + rng.choice([0, 0, 1, -1, 4, 100]) * ULP)
        matrix[2, 0] = 1e-15 * (k == 3)  # one crosses the others
        matrices.append(world_from_camera @ matrix)
    matrices.insert(2, matrices[1])
    point, normal = world_from_camera[:3] @ (0, 0, -5, 1), world_from_camera[:3, 2]
    planes = [Plane(0, point, normal)] if with_plane else []
    instances = [Instance(0, 0, m) for m in matrices]
    return Scene(camera, (mesh,), instances, planes, objects=("A",))


@pytest.mark.parametrize("with_plane", [False, True])
@pytest.mark.parametrize("orthographic", [False, True])
def test_as_by_every_ray_itself(rng, orthographic, with_plane, monkeypatch):
    seen, ambiguous = set(), 0
    for _ in range(10):
        scene = layers(rng, orthographic, with_plane)
        frame = render(scene, Settings("certified"))
        with monkeypatch.context() as patch:
            patch.setattr(
                Decisions, "by_order", lambda self, found, nearest: found
            )  # leaves all to the slow way
            slow = render(scene, Settings("certified"))
        for name in ("t", "instance_index", "triangle_index", "certainty"):
            assert np.array_equal(getattr(frame, name), getattr(slow, name)), name
        assert np.allclose(frame.barycentrics, slow.barycentrics, rtol=0, atol=1e-12)
        assert frame.ties == slow.ties and frame.statistics.reasons == slow.statistics.reasons
        seen |= set(frame.instance_index.ravel().tolist())
        ambiguous += (frame.certainty == Certainty.AMBIGUOUS).sum()
    assert len(seen) >= 4 and ambiguous


def test_coplanar_surfaces_do_not_cost_a_ray_each(make, monkeypatch):
    """Where only the order is asked for, no ray is turned into integers."""
    monkeypatch.setattr(Decisions, "by_integers", lambda *a: pytest.fail("a ray by itself"))
    quads = make.quad(-9, 9.3, -8, 9.17, -2), make.quad(-8, 9.1, -9, 8.7, -2)
    scene = make.scene(make.camera(), *quads)
    frame = render(scene, Settings("certified"))
    assert (frame.object_index == 0).all()
    assert (frame.certainty == Certainty.AMBIGUOUS).all()
    assert set(frame.statistics.reasons) == {Reason.COPLANAR}
    assert len(frame.ties) == frame.t.size
