"""What the roundings before the proof change is counted."""

from __future__ import annotations

import subprocess
import sys
from dataclasses import replace
from itertools import pairwise

import check_rounding as tool
import numpy as np
import pytest
from check_rounding import check_rounding
from reference_tracer.certified import arithmetic
from reference_tracer.files.scenes import save_scene
from reference_tracer.rendering import render
from reference_tracer.scene import Instance, Scene, SceneError, ViewWindow
from reference_tracer.tracer.hits import NOTHING
from reference_tracer.tracer.settings import Settings

from ..moved import touched
from ..oracle import scene_sights

CAMERAS = pytest.mark.parametrize("orthographic", [False, True], ids=["persp", "ortho"])


def checked(scene: Scene) -> tuple[int, int]:
    """Return the pixels that differ, and those that were asked exactly."""
    frame = render(scene, Settings("certified"))
    found = check_rounding(scene, frame)
    assert found.total == frame.certainty.size
    return len(found.others), found.asked


def unrounded(scene: Scene) -> Scene:
    """The scene with the depth of each quad in its matrix: no sum rounds."""
    instances = []
    for instance in scene.instances:
        z, matrix = (
            float(scene.meshes[instance.mesh].vertices[0, 2]),
            instance.world_from_object.copy(),
        )
        matrix[:3, 3] += matrix[:3, 2] * z
        matrix[:3, 2] = 0
        instances.append(replace(instance, world_from_object=matrix))
    return replace(scene, instances=instances)


def by_hand(scene: Scene) -> tuple[int, int]:
    """Return in how many pixels the unrounded owner is another one: at least, and at most.

    By the oracle. Where the unrounded ray meets an edge, only the tie rule knows.
    """
    frame = render(scene, Settings("certified"))
    names = zip(frame.instance_index.ravel(), frame.triangle_index.ravel(), strict=True)
    least, most = 0, 0
    for name, sight in zip(names, scene_sights(unrounded(scene)), strict=True):
        least += name not in touched(sight)
        most += touched(sight) != {name}
    return least, most


def strips(make, rng, orthographic: bool, count: int = 12) -> Scene:
    """Strips side by side before a wall: every second one is placed by a sum that rounds.

    Their edges are where pixels' centres are, but for some 2^-35 m. x + 2^20 - 2^20 keeps x down to
    its digit of 2^-32.
    """
    at = np.arange(-1, count + 1) + rng.integers(-8, 9, count + 2) * 2.0**-35
    far = np.array([[1, 0, 2.0**20, -(2.0**20)], [0, 1, 0, 0], [0, 0, 1, -2], [0, 0, 0, 1]])
    near = np.eye(4)
    near[2, 3] = -2
    meshes = [make.quad(a, b, -9, 9, 1, f"Strip {k}") for k, (a, b) in enumerate(pairwise(at))]
    meshes.append(make.quad(-99, 99, -99, 99, -7, "Wall"))
    aside = float(rng.integers(-8, 9)) * 2.0**-35
    window = ViewWindow(aside - 0.5, aside + count - 0.5, 0.25, 3.25)
    camera = make.camera(count, 3, window=window, orthographic=orthographic, clip_start=0.5)
    scene = make.scene(camera, *meshes)
    placed = [far if k % 2 else near for k in range(count + 1)] + [np.eye(4)]
    instances = [
        replace(i, world_from_object=m) for i, m in zip(scene.instances, placed, strict=True)
    ]
    return replace(scene, instances=instances)


def layers(make, rng, orthographic: bool, count: int = 12) -> Scene:
    """A quad that is tilted by less than its sum of 2^20 keeps, and an upright one within that."""
    tilt, depth = 2.0 ** -int(rng.integers(37, 40)), -2 + int(rng.integers(1, 5)) * 2.0**-37
    far = np.array([[1, 0, 0, 0], [0, 1, 0, 0], [tilt, 0, 2.0**20, -(2.0**20) - 2], [0, 0, 0, 1]])
    window = ViewWindow(-0.5, count - 0.5, 0.25, 3.25)
    camera = make.camera(count, 3, window=window, orthographic=orthographic, clip_start=0.5)
    scene = make.scene(camera, make.quad(-9, 99, -9, 99, 1), make.quad(-9, 99, -9, 99, depth))
    tilted, upright = scene.instances
    return replace(scene, instances=[replace(tilted, world_from_object=far), upright])


def crack(make) -> Scene:
    """Two quads whose edge is at 2^-20 + 2^-34: the second one's is stored at 2^-20."""
    edge = 2.0**-20 + 2.0**-34
    window = ViewWindow(edge - 2.0**-35 - 2.5, edge - 2.0**-35 + 2.5, -1.5, 1.5)
    camera = make.camera(5, 3, window=window, orthographic=True)
    right = make.quad(edge, 9, -9, 9, -1, "Right")
    left = make.quad(-9, edge, -9, 9, 1, "Left")
    scene = make.scene(camera, right, left, make.quad(-99, 99, -99, 99, -7, "Wall"))
    far = np.array([[1, 0, 2.0**20, -(2.0**20)], [0, 1, 0, 0], [0, 0, 1, -2], [0, 0, 0, 1]])
    one, other, wall = scene.instances
    return replace(scene, instances=[one, replace(other, world_from_object=far), wall])


def test_a_crack_that_is_known_is_counted(make):
    scene = crack(make)
    frame = render(scene, Settings("certified"))
    assert (frame.instance_index[:, 2] == 2).all()  # the wall is seen between the two
    assert checked(scene) == (3, 3) and by_hand(scene) == (3, 3)
    assert check_rounding(scene, frame).others == [(2, 0), (2, 1), (2, 2)]


def test_no_crack_where_nothing_parts(make):
    scene = crack(make)
    near = np.eye(4)
    near[2, 3] = -2
    one, other, wall = scene.instances
    same = replace(other, world_from_object=near)
    assert checked(replace(scene, instances=[one, same, wall])) == (0, 0)


@CAMERAS
@pytest.mark.parametrize("build", [strips, layers])
def test_as_counted_by_hand(make, build, orthographic):
    total = 0
    for seed in range(5):
        scene = build(make, np.random.default_rng(seed), orthographic)
        differ, asked = checked(scene)
        least, most = by_hand(scene)
        assert least <= differ <= most and asked >= differ
        total += differ
    assert total > 10


def test_nothing_is_said_where_nothing_can_be_proven(make, request):
    scene = crack(make)
    frame = render(scene, Settings("certified"))
    request.getfixturevalue("broken_arithmetic")  # after the frame, which wants a sound one
    with pytest.raises(arithmetic.AssumptionError):
        check_rounding(scene, frame)


def test_rounding_beyond_the_clip_start_is_refused(make):
    scene = make.scene(make.camera(clip_start=0.01), make.quad(-1, 1, -1, 1, -3))
    far = np.eye(4)
    far[0, 3] = 1e15
    scene = replace(scene, instances=[*scene.instances, Instance(0, 0, far)])
    with pytest.raises(SceneError, match="clip start"):
        check_rounding(scene, render(scene, Settings("certified")))


def test_an_empty_picture(make):
    scene = Scene(make.camera(), objects=())
    assert (render(scene, Settings("certified")).instance_index == NOTHING).all()
    assert checked(scene) == (0, 0)


def test_the_tool_says_so(make, tmp_path):
    save_scene(tmp_path / "crack.npz", crack(make))
    command = [sys.executable, tool.__file__, str(tmp_path / "crack.npz")]
    said = subprocess.run(command, check=True, capture_output=True, text=True).stdout.splitlines()
    assert said[-2].startswith("before any test, rounding moves rays by at most")
    assert said[-1].startswith("3 of 15 pixels would show another surface unrounded, as at (2, 0)")
