"""A pixel as a file: the same derivation again, and an error that names what is wrong in it."""

from __future__ import annotations

import json
from copy import deepcopy

import pytest
from reference_tracer.derivation import reproducer
from reference_tracer.derivation.candidates import gather_pixel
from reference_tracer.derivation.derivation import derive, derive_pixel
from reference_tracer.report.pixel import WRITERS
from reference_tracer.scene import SceneError


@pytest.fixture
def saved(ball_scene, tmp_path):
    """The file of a pixel of the ball, and what is in it."""
    path = tmp_path / "pixel.json"
    path.write_text(
        reproducer.text(gather_pixel(ball_scene, 12, 9, source="ball")), encoding="utf-8"
    )
    return path, json.loads(path.read_text(encoding="utf-8"))


@pytest.mark.slow
@pytest.mark.parametrize("limit", [1, 3, 99])
@pytest.mark.parametrize("pixel", [(12, 9), (0, 17), (16, 3)])
def test_the_same_derivation_again(ball_scene, tmp_path, pixel, limit):
    path = tmp_path / "pixel.json"
    first = derive(ball_scene, *pixel, limit=limit, source="ball.npz")
    path.write_text(reproducer.text(first.pixel), encoding="utf-8")
    again = derive_pixel(reproducer.read(path))
    for write in WRITERS.values():
        assert write(again) == write(first)
    assert reproducer.text(again.pixel) == path.read_text(encoding="utf-8")


def drop(*keys):
    def change(content):
        *path, last = keys
        for key in path:
            content = content[key]
        del content[last]

    return change


def put(value, *keys):
    def change(content):
        *path, last = keys
        for key in path:
            content = content[key]
        content[last] = value

    return change


@pytest.mark.parametrize(
    ("change", "says"),
    [
        (put("other/1", "schema"), "its schema is 'other/1'"),
        (drop("camera"), "camera is missing"),
        (drop("x"), "x is missing"),
        (put(1.5, "x"), "x must be an integer"),
        (put(-1, "y"), "y is -1; it must be between 0"),
        (put(24, "x"), "no pixel \\(24, 9\\)"),
        (put([], "camera"), "camera must be an object"),
        (put("wide", "camera", "window", "left"), "camera.window.left must be a finite number"),
        (put([[1]], "camera", "world_from_camera"), "camera.world_from_camera must be 4 x 4"),
        (put([0, 0, 1], "ray", "direction"), "ray.direction is not that of the camera"),
        (put({}, "candidates"), "candidates must be a list"),
        (put(7, "candidates", 0), "candidates\\[0\\] must be an object"),
        (drop("candidates", 1, "points"), "candidates\\[1\\].points is missing"),
        (put([[0, 0, 1e999]] * 3, "candidates", 0, "points"), "points must be 3 x 3 finite"),
        (put(-2, "candidates", 0, "triangle"), "triangle is -2"),
        (put([[1e39, 0, 0, 1]], "candidates", 0, "colors"), "beyond what a float32 holds"),
        (put([[0, 0, 0, 1]] * 3, "candidates", -1, "colors"), "one for each corner of a triangle"),
        (put(True, "camera", "clip_end"), "clip_end must be a finite number"),
        (put(10**30, "candidates", 0, "slot"), "slot is 1000"),
        (put([[0, 0, 0], [0, 0, 0]], "candidates", -1, "points"), "normal, is zero"),
        (put(99, "candidates", -1, "instance"), "planes are not numbered"),
        (put(99, "candidates", 0, "instance"), "instance is not below first_plane"),
        (put(5, "candidates", 0, "object"), "object must be text"),
        (put([0, 0], "background"), "background must be 4 finite numbers"),
    ],
)
def test_what_is_wrong_is_named(saved, change, says):
    path, content = saved
    change(content)
    path.write_text(json.dumps(content))
    with pytest.raises(SceneError, match=says) as error:
        reproducer.read(path)
    assert str(path) in str(error.value)


@pytest.mark.parametrize("text", ["{", "[" * 100_000, "\x80", "null", "[]", '"x"', "NaN"])
def test_what_is_no_pixel(tmp_path, text):
    path = tmp_path / "pixel.json"
    path.write_bytes(text.encode("latin-1"))
    with pytest.raises(SceneError, match=r"not JSON|its schema is"):
        reproducer.read(path)


def test_two_of_a_name_and_no_file(saved, tmp_path):
    path, content = saved
    content["candidates"].insert(0, deepcopy(content["candidates"][0]))
    path.write_text(json.dumps(content))
    with pytest.raises(SceneError, match="same instance and triangle"):
        reproducer.read(path)
    with pytest.raises(SceneError, match="there is no file"):
        reproducer.read(tmp_path / "none.json")
