"""The contract: every fault is named, and what is in a scene stays as it is."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from reference_tracer.scene import (
    Camera,
    Instance,
    Mesh,
    Plane,
    Region,
    Scene,
    SceneError,
    ViewWindow,
    alike,
    drop_non_finite,
)

WINDOW = ViewWindow(-1, 1, -1, 1)
POINTS = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], np.float32)
FACES = np.array([[0, 1, 2]])
NAN = np.where(np.eye(4) > 0, np.nan, 0)


def camera(**changes):
    return Camera(
        **{"world_from_camera": np.eye(4), "window": WINDOW, "width": 8, "height": 6} | changes
    )


def mesh(**changes):
    return Mesh(**{"vertices": POINTS, "triangles": FACES, "name": "Cube"} | changes)


def scene(**changes):
    whole = {
        "camera": camera(),
        "meshes": (mesh(),),
        "instances": (Instance(0, 0, np.eye(4)),),
        "objects": ("Cube",),
    }
    return Scene(**whole | changes)


FAULTS = {
    "no columns": (camera, {"width": 0}, ["0 x 6", "resolution"]),
    "too many rows": (camera, {"height": 2**28 + 1}, ["8 x 268435457", "most 268435456"]),
    "no rows": (camera, {"height": -3}, ["8 x -3", "resolution"]),
    "empty border": (camera, {"region": Region(3, 1, 3, 5)}, ["border", "3 to 3"]),
    "border outside": (camera, {"region": Region(0, 0, 9, 6)}, ["border", "0 to 9"]),
    "border below": (camera, {"region": Region(0, -1, 8, 6)}, ["border", "-1 to 6"]),
    "clip range": (
        camera,
        {"clip_start": 5, "clip_end": 5, "name": "Cam.001"},
        ["Cam.001", "clip", "5 m"],
    ),
    "clip not a number": (camera, {"clip_start": np.nan, "name": "Cam.001"}, ["Cam.001", "clip"]),
    "flat window": (
        camera,
        {"window": ViewWindow(1, 1, -1, 1), "name": "C"},
        ["'C'", "view window"],
    ),
    "turned window": (camera, {"window": ViewWindow(-1, 1, 1, -1)}, ["view window"]),
    "infinite window": (camera, {"window": ViewWindow(-np.inf, 1, -1, 1)}, ["view window"]),
    "camera matrix": (camera, {"world_from_camera": NAN, "name": "Cam.001"}, ["Cam.001", "finite"]),
    "camera matrix shape": (
        camera,
        {"world_from_camera": np.eye(3)},
        ["camera 'Camera'", "(4, 4)"],
    ),
    "flat camera": (
        camera,
        {"world_from_camera": np.diag([1, 0, 1, 1])},
        ["camera 'Camera'", "scale"],
    ),
    "eye as clip start": (camera, {"clip_start": 0.0, "name": "Cam.001"}, ["Cam.001", "clip"]),
    "clip behind the eye": (camera, {"clip_start": -1.0, "name": "Cam.001"}, ["Cam.001", "clip"]),
    "vertices": (mesh, {"vertices": POINTS[:, :2]}, ["Mesh 'Cube'", "vertices", "(3, 2)"]),
    "triangles": (mesh, {"triangles": FACES[0]}, ["Mesh 'Cube'", "triangles", "(3,)"]),
    "index past the end": (
        mesh,
        {"triangles": [[0, 1, 3]]},
        ["Mesh 'Cube'", "triangles must be at least 0"],
    ),
    "negative index": (
        mesh,
        {"triangles": [[0, 1, -1]]},
        ["Mesh 'Cube'", "triangles must be at least 0"],
    ),
    "index beyond 32 bits": (mesh, {"triangles": np.array([[0, 1, 2**32 + 2]])}, ["Mesh 'Cube'"]),
    "no vertex": (mesh, {"vertices": POINTS[:0]}, ["Mesh 'Cube'", "triangles must be at least 0"]),
    "slots": (mesh, {"slots": [0, 0]}, ["Mesh 'Cube'", "slots"]),
    "negative slot": (mesh, {"slots": [-1]}, ["Mesh 'Cube'", "slots"]),
    "not finite": (mesh, {"vertices": POINTS * np.float32(np.nan)}, ["Mesh 'Cube'", "not finite"]),
    "corner colours": (mesh, {"corner_colors": np.ones((1, 3, 3))}, ["Mesh 'Cube'", "(1, 3, 3)"]),
    "instance matrix": (Instance, {"mesh": 0, "object": 7, "world_from_object": NAN}, ["object 7"]),
    "instance colours": (
        Instance,
        {"mesh": 0, "object": 7, "world_from_object": np.eye(4), "colors": np.zeros((0, 4))},
        ["object 7", "(0, 4)"],
    ),
    "plane point": (Plane, {"object": 0, "point": (0, 0, np.inf), "normal": (0, 0, 1)}, ["point"]),
    "plane normal": (
        Plane,
        {"object": 0, "point": (0, 0, 0), "normal": (0, 0, 0)},
        ["normal", "zero"],
    ),
    "plane colour": (
        Plane,
        {"object": 0, "point": (0, 0, 0), "normal": (0, 0, 1), "color": (1, 1, 1)},
        ["infinite plane"],
    ),
    "mesh of instance": (scene, {"meshes": ()}, ["mesh 0 of 0"]),
    "object of instance": (scene, {"objects": ()}, ["object 0 of 0"]),
    "object of plane": (scene, {"planes": [Plane(4, (0, 0, 0), (0, 0, 1))]}, ["object 4 of 1"]),
    "background": (scene, {"background": np.zeros(3)}, ["background"]),
}


@pytest.mark.parametrize("fault", FAULTS)
def test_fault_is_named(fault):
    kind, changes, words = FAULTS[fault]
    with pytest.raises(SceneError) as caught:
        kind(**changes)
    for word in words:
        assert word in str(caught.value)


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_drop_non_finite(dtype):
    vertices = np.arange(15, dtype=dtype).reshape(5, 3)
    vertices[1, 2], vertices[3, 0] = np.nan, -np.inf
    faces = np.array([[0, 2, 4], [0, 1, 2], [3, 3, 3], [4, 2, 0]])
    finite, keep = drop_non_finite(vertices, faces)
    assert keep.tolist() == [True, False, False, True]
    assert finite.dtype == dtype and np.isfinite(finite).all()
    assert np.array_equal(finite[[0, 2, 4]], vertices[[0, 2, 4]])
    assert len(mesh(vertices=finite, triangles=faces[keep]).triangles) == 2


def test_drop_non_finite_leaves_finite_meshes_alone():
    finite, keep = drop_non_finite(POINTS, FACES)
    assert finite is POINTS and keep.all() and len(keep) == 1


@pytest.mark.parametrize("kind", ["instance", "infinite plane"])
def test_what_names_no_object_is_called_what_it_is(kind):
    meshes = (Mesh(POINTS, FACES),)
    shown = {"instances": (Instance(0, 1, np.eye(4)),)}
    if kind == "infinite plane":
        shown = {"planes": (Plane(1, np.zeros(3), np.ones(3)),)}
    with pytest.raises(SceneError, match=f"^An {kind} names object 1 of 1"):
        Scene(camera(), meshes, objects=("Cube",), **shown)


def test_alike_is_what_holds_the_same():
    def scene(dx=0.0, name="Cube", meshes=()):
        matrix = np.eye(4)
        matrix[0, 3] = dx
        meshes = meshes or (Mesh(POINTS.copy(), FACES),)
        return Scene(camera(), meshes, (Instance(0, 0, matrix),), objects=(name,))

    one = scene()
    assert alike(one, one) and alike(one, scene()) and alike(one, scene(meshes=one.meshes))
    others = scene(1.0), scene(name="Cone"), scene(meshes=(Mesh(POINTS * 2, FACES),))
    others += (scene(meshes=one.meshes * 2), replace(scene(), camera=camera(width=9)))
    assert not any(alike(one, other) for other in others)


def test_a_view_window_is_moved_scaled_and_centred_anew():
    window = ViewWindow(-1, 3, 0, 2)
    assert window.size == (4, 2) and window.centre == (1, 1)
    assert window.moved(1, -2) == ViewWindow(0, 4, -2, 0)
    assert window.scaled(2, 0.5) == ViewWindow(-2, 6, 0, 1)
    assert window.scaled(-1, 1) == ViewWindow(-3, 1, 0, 2)
    assert window.about((0, 0), y=3) == ViewWindow(-2, 2, -3, 3)
    assert window.about(window.centre) == window
