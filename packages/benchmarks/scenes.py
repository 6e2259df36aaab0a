"""Makes the scenes of the benchmark by name: a mesh and a view of it, through either camera."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np
from reference_tracer.framing import axes_of
from reference_tracer.projections import PROJECTIONS, Projection
from reference_tracer.scene import Camera, Instance, Mesh, Scene, SceneError, ViewWindow

from . import meshes
from .meshes import Triangles

Vector = tuple[float, float, float]
CAMERAS = tuple(name for name, p in PROJECTIONS.items() if p.is_linear)  # which the sweep traces
EVERYDAY, ADVERSARIAL, SCALING = "everyday", "adversarial", "scaling"
SUZANNE_FILE = "monkey.npz"  # not a name that somebody exports a scene to


@dataclass(frozen=True)
class View:
    """Where the cameras stand, and how much they see."""

    eye: Vector
    target: Vector
    angle: float  # tangent of half the vertical angle of view (perspective)
    height: float  # metres from the picture's middle to its upper edge (orthographic)
    clip: tuple[float, float]  # metres along the view axis


@dataclass(frozen=True)
class Subject:
    """A scene to measure: a mesh and how it is looked at."""

    name: str
    triangles: int
    mesh: Callable[[], Triangles] | None  # None for the one that Blender makes
    view: View
    group: str = EVERYDAY
    copies: int = 1  # instances of the mesh, a square number: side by side, see `_places`

    @property
    def traced_triangles(self) -> int:
        """Of all copies."""
        return self.copies * self.triangles


_AROUND = View((2.7, -2.5, 1.7), (0, 0, 0), 0.28, 1.12, (0.5, 10.0))  # frames the unit sphere
_CUBE = View((3.9, -3.6, 2.5), (0, 0, 0), 0.32, 1.85, (0.5, 15.0))  # frames the cube's corners
_GRAZING = View((0.1, -1.35, 0.19), (0, 0, 0.02), 0.4, 0.24, (0.01, 10.0))
_INSIDE = View((0.01, 0.02, 0.03), (1, 0.4, 0.2), 0.5, 0.5, (0.001, 10.0))
_ALONG = View((0.95, 0.02, 0.03), (0.6, 0.7, 0.2), 0.5, 0.5, (0.001, 10.0))  # the sphere's wall
_FIELD = View((1.5, -1.7, 1.1), (0, 0, 0), 0.35, 1.0, (0.1, 10.0))  # frames the square of copies

SUBJECTS = {
    s.name: s
    for s in (
        Subject("cube", 12, meshes.cube, _CUBE),
        Subject("icosphere_5k", 5_120, partial(meshes.icosphere, 4), _AROUND),
        Subject("icosphere_82k", 81_920, partial(meshes.icosphere, 6), _AROUND),
        Subject("icosphere_1m", 1_310_720, partial(meshes.icosphere, 8), _AROUND),
        Subject("heightfield", 500_000, partial(meshes.heightfield, 500), _GRAZING),
        Subject("soup_10k", 10_000, partial(meshes.soup, 10_000, 0.1), _CUBE),
        Subject("suzanne", meshes.SUZANNE, None, _AROUND),
        Subject("slivers_20k", 20_000, partial(meshes.slivers, 20_000), _CUBE, ADVERSARIAL),
        Subject("slivers_100k", 100_000, partial(meshes.slivers, 100_000), _CUBE, ADVERSARIAL),
        Subject(
            "large_100k", 100_000, partial(meshes.large_triangles, 100_000), _CUBE, ADVERSARIAL
        ),
        Subject("small_1m", 1_000_000, partial(meshes.soup, 1_000_000, 0.005), _CUBE, ADVERSARIAL),
        Subject(
            "nested_spheres", 1_310_720, partial(meshes.nested_spheres, 64, 5), _AROUND, ADVERSARIAL
        ),
        Subject("inside_soup", 10_000, partial(meshes.soup, 10_000, 0.1), _INSIDE, ADVERSARIAL),
        Subject("inside_sphere", 1_310_720, partial(meshes.icosphere, 8), _ALONG, ADVERSARIAL),
        Subject("foliage", 600_000, partial(meshes.foliage, 300_000, 0.015), _AROUND, ADVERSARIAL),
        Subject(
            "subpixel_1m", 1_000_000, partial(meshes.soup, 1_000_000, 0.0006), _CUBE, ADVERSARIAL
        ),
        Subject(
            "instances_10k", 5_120, partial(meshes.icosphere, 4), _FIELD, ADVERSARIAL, copies=10_000
        ),
        Subject("icosphere_5m", 5_242_880, partial(meshes.icosphere, 9), _AROUND, SCALING),
    )
}


def subject(name: str) -> Subject:
    """Return the scene of a name.

    Raises
    ------
    SceneError
        If there is none, naming those that there are.
    """
    if name not in SUBJECTS:
        raise SceneError(f"there is no benchmark scene '{name}': choose of {', '.join(SUBJECTS)}")
    return SUBJECTS[name]


def mesh_of(name: str, cache: Path | None) -> Mesh:
    """Return a scene's mesh.

    Parameters
    ----------
    name : str
        One of SUBJECTS.
    cache : Path
        The folder with SUZANNE_FILE.

    Raises
    ------
    meshes.MissingMeshError
        If it is one that Blender makes, and has not made.
    """
    make = subject(name).mesh or partial(meshes.stored, Path(cache or ".", SUZANNE_FILE))
    return Mesh(*make(), name=name)


def build(mesh: Mesh, width: int, height: int, camera: str) -> Scene:
    """Return the scene of a mesh from :func:`mesh_of`, through one of CAMERAS.

    A scene keeps tables once they are made: a new one has none yet.
    """
    wanted = subject(mesh.name)
    return Scene(
        camera_of(wanted.view, width, height, PROJECTIONS[camera]),
        (mesh,),
        tuple(Instance(0, 0, place) for place in _places(wanted.copies)),
        objects=(mesh.name,),
    )


def _places(copies: int) -> Iterator[np.ndarray]:
    """Yield where a mesh of the unit ball stands: copies side by side fill a square from -1 to 1.

    One alone stays as it is.
    """
    side = int(copies**0.5)
    for k in range(copies):
        place = np.eye(4)
        if copies > 1:
            place[range(3), range(3)] = 0.9 / side
            place[:2, 3] = (2 * np.array((k % side, k // side)) + 1) / side - 1
        yield place


def camera_of(view: View, width: int, height: int, projection: Projection) -> Camera:
    """Return the camera of a view: its picture is `width` x `height` pixels, which are square."""
    matrix = np.eye(4)
    matrix[:3, :3] = axes_of(np.subtract(view.eye, view.target))
    matrix[:3, 3] = view.eye
    y = view.height if projection.shares_direction else view.angle
    x = y * width / height
    return Camera(
        matrix,
        ViewWindow(-x, x, -y, y),
        width,
        height,
        projection=projection,
        clip_start=view.clip[0],
        clip_end=view.clip[1],
        name=projection.name,
    )
