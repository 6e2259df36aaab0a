"""What tests share: cameras, meshes and scenes in a line each."""

from __future__ import annotations

import gc
import signal
from collections.abc import Iterator

import numpy as np
import pytest
import trimesh
from reference_tracer.certified import arithmetic
from reference_tracer.projections import ORTHOGRAPHIC
from reference_tracer.scene import Camera, Instance, Mesh, Plane, Scene, ViewWindow

from .report.browser import chromium, open_page

__all__ = ["chromium", "open_page"]  # fixtures
COLORS = ((0.9, 0.1, 0.1), (0.1, 0.8, 0.2), (0.2, 0.3, 0.9), (0.9, 0.8, 0.1))


@pytest.fixture
def exit_code():
    """Return the function that runs `reftrace`, for the exit code also where argparse ends it."""
    from reference_tracer.cli.main import main

    def run(argv) -> int:
        try:
            return main(argv)
        except SystemExit as stop:
            return stop.code

    return run


MARKED = {  # all tests of a folder, or of a file
    "tests/bed/": "slow",
    "tests/benchmarks/": "slow",
    "tests/blender/": "blender",
    "tests/fuzz/": "slow",
    "tests/conformance/": "slow",
    "tests/grading/": "slow",
    "tests/suites/": "slow",
    "tests/test_errands.py": "slow",
}


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config, log):
    """Keep the tests of a file in one worker, and all that share a Blender's window or Dask."""
    from xdist.scheduler import LoadScopeScheduling

    class Together(LoadScopeScheduling):
        def _split_scope(self, nodeid):
            file = nodeid.split("::")[0]
            folder = file.rpartition("/")[0]
            return folder if folder in ("tests/gui", "tests/cluster") else file

    return Together(config, log)


# The files whose tests take longest are begun with: a worker that comes to one last is waited for.
# The whole Blender of the window may have to be set up first; the farms come when it is.
LONGEST = (
    "tests/gui/",
    "tests/cluster/",
    "tests/blender/test_attacks.py",
    "tests/blender/test_hard_cases.py",
    "tests/blender/test_digests.py",
    "tests/certified/sweep/test_sweep.py",
    "tests/farms/",
    "tests/test_docs.py",
    "tests/blender/test_cli_blend.py",
    "tests/study/test_extremes.py",
)


def _place(item) -> int:
    """Return where a test comes in the order."""
    return next((n for n, at in enumerate(LONGEST) if item.nodeid.startswith(at)), len(LONGEST))


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items):
    """Mark whole folders, and begin with the longest."""
    items.sort(key=_place)
    for item in items:
        for folder, mark in MARKED.items():
            if item.nodeid.startswith(folder):
                item.add_marker(mark)


def pytest_collection_finish():
    """Have Python's collector pass over the half a million objects that stay until the end."""
    gc.freeze()


class Make:
    """Builders of scenes; cameras look along -Z from the origin, Y up, unless told otherwise."""

    @staticmethod
    def camera(width=24, height=18, half=0.5, eye=(0, 0, 0), target=None, axes=None, **options):
        """Return a camera whose picture is 2 `half` high at depth 1 (or in metres)."""
        matrix = np.eye(4)
        if axes is not None:
            matrix[:3, :3] = axes
        elif target is not None:
            backward = np.subtract(eye, target) / np.linalg.norm(np.subtract(eye, target))
            right = np.cross((0.1, 0.2, 0.97), backward)
            right /= np.linalg.norm(right)
            matrix[:3, :3] = np.stack((right, np.cross(backward, right), backward), axis=1)
        matrix[:3, 3] = eye
        wide = half * width / height
        window = options.pop("window", None) or ViewWindow(-wide, wide, -half, half)
        if options.pop("orthographic", False):
            options["projection"] = ORTHOGRAPHIC
        return Camera(matrix, window, width, height, **options)

    @staticmethod
    def quad(x0, x1, y0, y1, z, name="Quad"):
        """Return a rectangle across the Z axis, two triangles."""
        corners = [(x0, y0, z), (x1, y0, z), (x1, y1, z), (x0, y1, z)]
        return Mesh(np.array(corners, float), [[0, 1, 2], [0, 2, 3]], name=name)

    @staticmethod
    def mesh(shape: trimesh.Trimesh, matrix=None, name="Shape"):
        """Return a trimesh as a mesh."""
        vertices = np.array(shape.vertices)
        if matrix is not None:
            vertices = vertices @ matrix[:3, :3].T + matrix[:3, 3]
        return Mesh(vertices, np.array(shape.faces), name=name)

    @staticmethod
    def scene(camera, *meshes, planes=(), background=(0, 0, 0, 0)):
        """Return a scene with an instance, a colour and an object for each mesh and plane."""
        rgba = [[*COLORS[k % len(COLORS)], 1] for k in range(len(meshes) + len(planes))]
        count = len(meshes)
        return Scene(
            camera,
            meshes,
            tuple(Instance(k, k, np.eye(4), [rgba[k]]) for k in range(count)),
            tuple(Plane(count + k, *p, color=rgba[count + k]) for k, p in enumerate(planes)),
            np.array(background),
            (*(m.name for m in meshes), *(f"Plane {k}" for k in range(len(planes)))),
        )

    @classmethod
    def room(cls, orthographic=False):
        """Return some solids of different colours before a wall, without any symmetry."""
        camera = cls.camera(
            60,
            45,
            half=2.0 if orthographic else 0.4,
            eye=(3, -4, 2),
            target=(0, 0, 0),
            orthographic=orthographic,
        )
        ball = trimesh.creation.icosphere(2, radius=0.7).apply_translation((-0.6, 0.3, 0.4))
        box = trimesh.creation.box((0.8, 0.6, 1.1)).apply_translation((0.7, -0.4, -0.3))
        wall = trimesh.creation.box((0.1, 4, 3)).apply_translation((-1.8, 0, -0.2))
        return cls.scene(camera, *(cls.mesh(s) for s in (ball, box, wall)))

    @classmethod
    def stripes(cls):
        """Return slanted stripes: an edge in almost every pixel of every row."""
        camera = cls.camera(80, 60, half=30, orthographic=True, eye=(40, 30, 0))
        x = np.arange(0, 80, 2.003)
        low, high = (
            np.stack((x + s, np.full(len(x), y), np.full(len(x), -5.0)), 1)
            for s, y in ((-0.7, -1), (0.9, 61))
        )
        n, right = len(x), np.array([1, 0, 0])
        points = np.concatenate((low, low + right, high, high + right))
        k = np.arange(n)[:, None]
        faces = np.concatenate([k + np.array(corners) * n for corners in ((0, 1, 3), (0, 3, 2))])
        return cls.scene(camera, Mesh(points, faces), cls.quad(-9, 99, -9, 99, -6))


@pytest.fixture(scope="session")
def make() -> type[Make]:
    """Builders of scenes."""
    return Make


@pytest.fixture(params=[False, True], ids=["perspective", "orthographic"])
def room(request, make):
    return make.room(request.param)


@pytest.fixture
def stripes(make):
    return make.stripes()


@pytest.fixture
def rng() -> np.random.Generator:
    """Random numbers, the same in every run."""
    return np.random.default_rng(20240611)


@pytest.fixture(scope="session", autouse=True)
def ctrl_c() -> Iterator[None]:
    """Hear Ctrl-C, also where whoever started the tests has it ignored, as a shell's `&` does."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before or signal.SIG_DFL)


@pytest.fixture
def broken_arithmetic(monkeypatch):
    """An arithmetic that rounds 1 + 2^-53 up; no process needs to be changed for that."""

    def add(x, y):
        return np.nextafter(np.add(x, y), np.inf)

    runs = [r._replace(function=add) if r.function is np.add else r for r in arithmetic._RUNS]
    monkeypatch.setattr(arithmetic, "_RUNS", runs)
