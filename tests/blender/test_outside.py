"""What lies wholly outside the view is not exported, and nobody could tell from the picture."""

from __future__ import annotations

import numpy as np
import pytest
from reference_tracer.blender.reading import export as export_module
from reference_tracer.blender.reading.view_volume import outside
from reference_tracer.methods import Method
from reference_tracer.projections import ORTHOGRAPHIC, PERSPECTIVE
from reference_tracer.rendering import render
from reference_tracer.scene import Camera, ViewWindow
from reference_tracer.tracer.camera import film_of
from reference_tracer.tracer.settings import Settings
from reference_tracer.tracer.vector import transform_points

MODES = ("VIEWPORT", "RENDER")
BESIDE = 1.0  # pixels: twice as far as a comparison looks


def hostile_camera(rng, orthographic: bool) -> Camera:
    """Return a camera with sheared axes, a shifted window, at any scale, anywhere."""
    matrix = np.eye(4)
    matrix[:3, :3] = np.linalg.qr(rng.normal(size=(3, 3)))[0] + rng.uniform(-0.3, 0.3, (3, 3))
    matrix[:3, 3] = rng.normal(size=3) * 10.0 ** rng.integers(-3, 5)
    x, y = np.sort(rng.uniform(-1, 1, (2, 2)), axis=1) * 10.0 ** rng.integers(-2, 3)
    start = 10.0 ** rng.uniform(-4, 1)
    end = start * 10.0 ** rng.uniform(0.1, 5)
    projection = ORTHOGRAPHIC if orthographic else PERSPECTIVE
    return Camera(matrix, ViewWindow(*x, *y), 64, 48, projection, start, end)


@pytest.mark.parametrize("orthographic", [False, True], ids=["perspective", "orthographic"])
def test_no_box_that_could_be_seen_is_outside(orthographic):
    """The judge is where the tracer itself has points of the boxes on its film."""
    rng = np.random.default_rng(11)
    left_out = seen = 0
    for _ in range(150):
        camera = hostile_camera(rng, orthographic)
        k = 40
        matrices = np.tile(np.eye(4), (k, 1, 1))
        scale = camera.clip_start * 10.0 ** rng.uniform(-2, 5, (k, 1, 1))
        matrices[:, :3, :3] = rng.normal(size=(k, 3, 3)) * scale
        matrices[:, :3, 3] = camera.origin + rng.normal(size=(k, 3)) * scale[..., 0] * rng.choice(
            [0.3, 3.0], (k, 1)
        )
        low, high = np.sort(rng.normal(size=(2, k, 3)), axis=0).astype(np.float32)
        out = outside(camera, np.stack((low, high)).swapaxes(1, 2), matrices.transpose(1, 2, 0))
        left_out += out.sum()
        shares = np.concatenate((np.indices((2, 2, 2)).reshape(3, 8), rng.random((3, 200))), axis=1)
        for i in range(k):
            points = low[i, :, None] + shares * (high[i] - low[i]).astype(np.float64)[:, None]
            x, y, depth = film_of(camera, transform_points(matrices[i], points))
            inside = (np.abs(x - 32) <= 32 + BESIDE) & (np.abs(y - 24) <= 24 + BESIDE)
            inside &= (depth >= camera.clip_start) & (depth <= camera.clip_end)
            assert not (out[i] and inside.any())
            seen += inside.any()
    assert left_out > 500  # it is of use
    assert seen > 100


def test_what_has_no_finite_box_is_never_outside():
    camera = Camera(np.eye(4), ViewWindow(-1, 1, -1, 1), 8, 8)
    behind = np.array([[0, 0, 5.0]] * 3)
    low, high = behind - 1, behind + 1
    matrices = np.tile(np.eye(4), (3, 1, 1))
    high[0, 0], matrices[1, 0, 3] = np.nan, np.inf
    bounds = np.stack((low.T, high.T))
    assert outside(camera, bounds, matrices.transpose(1, 2, 0)).tolist() == [False, False, True]


def scatter(build) -> None:
    """Cubes all around the camera and beyond its clip range, each in its own colour."""
    rng = np.random.default_rng(3)
    for number, place in enumerate(rng.uniform(-9, 9, (120, 3))):
        color = build.material(f"M{number}", *rng.random(3))
        angles = rng.uniform(0, 3, 3)
        build.cube(f"Cube {number}", 1.5, location=place, rotation=angles, material=color)
    source = build.cube("Source", 2, link=False, color=(0.2, 0.5, 0.9, 1))
    build.instances_on_points(build.mesh("Points", rng.uniform(-9, 9, (200, 3)), []), source)
    build.square("Floor", 100, location=(0, 0, -6), material=build.material("Grey", 0.3, 0.3, 0.3))


CAMERAS = {
    "perspective": {"clip_end": 12},
    "shifted": {"shift_x": 0.6, "shift_y": -0.4, "lens": 80},
    "orthographic": {"type": "ORTHO", "ortho_scale": 7, "clip_start": 3, "clip_end": 9},
}


@pytest.fixture
def keeping_all(monkeypatch):
    """Export also what lies outside the view."""

    def keep() -> None:
        monkeypatch.setattr(
            export_module, "outside", lambda _, bounds, *__: np.zeros(bounds.shape[2], bool)
        )

    return keep


@pytest.mark.parametrize("mode", MODES)
@pytest.mark.parametrize("camera", CAMERAS)
def test_the_picture_is_the_same_without(camera, mode, build, export, keeping_all, entries):
    build.scene()
    scatter(build)
    build.corner_camera(**CAMERAS[camera])
    few, manifest = export.modes[mode]()
    keeping_all()
    whole, all_manifest = export.modes[mode]()
    assert len(whole.instances) == 321
    assert 10 < len(few.instances) < 250
    assert few.objects == whole.objects  # so that an object's index stays when the camera moves
    for method in (Method.CERTIFIED, Method.MOLLER_TRUMBORE):
        one, other = (render(s, Settings(method)) for s in (few, whole))
        for name in ("color", "object_index", "triangle_index", "t", "normal"):
            np.testing.assert_array_equal(getattr(one, name), getattr(other, name))
    found, everything = entries(manifest), entries(all_manifest)
    for name, entry in found.items():
        assert entry.instances + entry.outside == everything[name].instances
        assert entry.exported == bool(entry.instances)
    unseen = [e for e in found.values() if e.outside]
    assert sum(e.outside for e in unseen) == len(whole.instances) - len(few.instances)
    gone = [e for e in unseen if not e.exported]
    assert gone
    assert {e.reason for e in gone} == {"outside the view"}
    lines = "\n".join(manifest.lines())
    assert not any(f"skipped {e.name} " in lines for e in gone)
    assert f"{sum(e.outside for e in unseen)} instances of {len(unseen)} objects" in lines
