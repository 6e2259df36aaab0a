"""Files of others: what they may leave out, what is refused, and what is named."""

from __future__ import annotations

import json

import numpy as np
import pytest
from reference_tracer.camera_files.convention import View
from reference_tracer.camera_files.files import CONVENTIONS, chosen, read, texts
from reference_tracer.scene import SceneError

from .cameras import camera


def changed(tmp_path, name, change):
    """Write a camera as a JSON file of a convention, with its content changed."""
    view = View(camera(np.random.default_rng(8), shift=(0.1, 0.2), tall=1.2), "0001.png", 1)
    content = json.loads(texts([view], CONVENTIONS[name])[""])
    change(content)
    path = tmp_path / "file.json"
    path.write_text(json.dumps(content), encoding="utf-8")
    return view.camera, path


def test_nerf_of_blenders_first_exporter_has_an_angle_alone(tmp_path):
    """`transforms_train.json` of the NeRF paper: camera_angle_x, and no size."""
    matrix = np.eye(4)
    content = {
        "camera_angle_x": 0.6911112070083618,
        "frames": [
            {"file_path": "./train/r_0", "rotation": 0.01, "transform_matrix": matrix.tolist()},
            {"file_path": "./train/r_1", "rotation": 0.01, "transform_matrix": matrix.tolist()},
        ],
    }
    path = tmp_path / "transforms_train.json"
    path.write_text(json.dumps(content), encoding="utf-8")
    with pytest.raises(SceneError, match="no size of the picture: add --set width="):
        read(path)
    view = chosen(read(path, size=(800, 800)), "r_1")
    assert view.camera.window.right == pytest.approx(np.tan(0.6911112070083618 / 2))
    assert view.camera.window.top == pytest.approx(view.camera.window.right)
    assert not view.is_clipped


def test_what_is_not_undone_is_said(tmp_path):
    _, path = changed(
        tmp_path, "nerf", lambda c: c.__setitem__("applied_transform", [[1, 0, 0, 0]])
    )
    assert "applied_transform is not undone" in read(path)[0].notes[0]
    _, path = changed(tmp_path, "nerf", lambda c: c.__setitem__("applied_scale", 0.1))
    assert "applied_scale is not undone" in read(path)[0].notes[0]


@pytest.mark.parametrize(
    ("name", "change", "said"),
    [
        ("opencv", lambda c: c.pop("K"), "none of opencv"),
        ("opencv", lambda c: c["K"][1].__setitem__(0, 2.0), "not of the form"),
        ("opencv", lambda c: c["K"][0].__setitem__(0, 0.0), "not of the form"),
        ("opencv", lambda c: c.__setitem__("R", [[1, 0, 0]] * 3), "no inverse"),
        ("opencv", lambda c: c.__setitem__("R", [1, 2]), "R must be 3 x 3 finite numbers"),
        ("opencv", lambda c: c.__setitem__("t", [1, 2]), "t must be 3 finite numbers"),
        ("opencv", lambda c: c.__setitem__("width", 0), "0 x 360 pixels"),
        ("opencv", lambda c: c.__setitem__("width", 1.5), "width must be an integer"),
        ("opencv", lambda c: c.__setitem__("pixel_centers", "quarter"), "must be half or integer"),
        ("opengl", lambda c: c.__setitem__("projection", np.eye(3).tolist()), "4 x 4"),
        ("opengl", lambda c: c["projection"][3].__setitem__(2, 1), "row 0 0 -1 0"),
        ("opengl", lambda c: c["projection"][2].__setitem__(2, 0), "depths from -1 to 1"),
        ("opengl", lambda c: c["view"].__setitem__(3, [0, 0, 0, 2]), "last row than 0 0 0 1"),
        ("nerf", lambda c: c["frames"].clear(), "none of opencv"),
        ("nerf", lambda c: c.__setitem__("orthographic", True), "another projection"),
        ("nerf", lambda c: c.__setitem__("ftheta_p0", 0.0), "another projection"),
        (
            "nerf",
            lambda c: c["frames"][0]["transform_matrix"].__setitem__(3, [0, 0, 1, 1]),
            "last row than 0 0 0 1",
        ),
        (
            "nerf",
            lambda c: (
                [c.pop(k) for k in ("fl_x", "fl_y")] and c.__setitem__("camera_angle_x", "wide")
            ),
            "camera_angle_x must be a finite number",
        ),
    ],
)
def test_what_is_wrong_is_named(name, change, said, tmp_path):
    _, path = changed(tmp_path, name, change)
    with pytest.raises(SceneError, match=said):
        read(path)


@pytest.mark.parametrize("name", ["opencv", "opengl", "nerf"])
@pytest.mark.parametrize(
    ("key", "bent", "straight"),
    [
        ("k1", 0.1, 0),
        ("D", [0, -0.1], [0.0]),
        ("dist_coeffs", [[0.1, 0, 0, 0, 0]], [[0.0] * 5]),
        ("distortion", {"k1": 0.1}, {"k1": 0.0}),
        ("distCoeffs", [0, 0.1], None),
    ],
)
def test_a_lens_that_bends_lines_is_refused(name, key, bent, straight, tmp_path):
    _, path = changed(tmp_path, name, lambda c: c.update({key: straight}))
    assert read(path)
    _, path = changed(tmp_path, name, lambda c: c.update({key: bent}))
    with pytest.raises(SceneError, match=f"lens distortion .*{key} = "):
        read(path)


@pytest.mark.parametrize("text", ["{}", "[", "[" * 5000, "[1]", "null", '{"frames": 3}', "solid"])
def test_what_is_no_camera_is_refused(text, tmp_path):
    path = tmp_path / "file.json"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(SceneError, match="cannot be read as a camera: it is of none of opencv"):
        read(path)


@pytest.mark.parametrize("named", [None, "opencv"])
@pytest.mark.parametrize("text", ['{"camera_matrix": [], "rvec": [], "tvec": []}', "%YAML:1.0"])
def test_what_opencvs_own_functions_write_is_told_what_is_needed(text, named, tmp_path):
    path = tmp_path / "file.yml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(SceneError, match=r"OpenCV's is JSON with K, R and t"):
        read(path, named)


MODELS = {
    "SIMPLE_PINHOLE 640 480 500 320 240": True,
    "SIMPLE_RADIAL 640 480 500 320 240 0": True,
    "SIMPLE_RADIAL 640 480 500 320 240 0.01": "lens distortion",
    "OPENCV 640 480 500 500 320 240 0 0 0 0": True,
    "OPENCV 640 480 500 500 320 240 0 0 0 0.1": "lens distortion",
    "PINHOLE 640 480 500 500 320": "4 parameters",
    "PINHOLE 640 480 500 500 320 x": "could not convert",
    "PINHOLE 640 480 500 500 320 nan": "not finite",
    "THIN_PRISM_FISHEYE 640 480 1 1 1 1": "the model 'THIN_PRISM_FISHEYE' is none of",
}


@pytest.mark.parametrize("model", MODELS)
def test_colmaps_models(model, tmp_path):
    (tmp_path / "cameras.txt").write_text(f"# a comment\n\n7 {model}\n", encoding="utf-8")
    images = "# two lines each\n1 1 0 0 0 0 0 0 7 a picture.png\n1.5 2.5 -1\n"
    (tmp_path / "images.txt").write_text(images, encoding="utf-8")
    if MODELS[model] is not True:
        with pytest.raises(SceneError, match=MODELS[model]):
            read(tmp_path)
        return
    (view,) = read(tmp_path)
    assert view.name == "a picture.png"
    assert view.camera.window.left == pytest.approx(-320 / 500)
    assert view.camera.window.top == pytest.approx(240 / 500)
    assert np.allclose(view.camera.forward, (0, 0, 1)) and np.allclose(view.camera.up, (0, -1, 0))


def test_colmaps_binary_is_refused_with_what_to_do(tmp_path):
    (tmp_path / "cameras.bin").write_bytes(b"\0")
    with pytest.raises(SceneError, match=r"no cameras.txt: `colmap model_converter"):
        read(tmp_path)


def test_colmaps_images_need_their_camera(tmp_path):
    (tmp_path / "cameras.txt").write_text("1 PINHOLE 4 4 1 1 2 2\n", encoding="utf-8")
    (tmp_path / "images.txt").write_text("1 1 0 0 0 0 0 0 2 a.png\n\n", encoding="utf-8")
    with pytest.raises(SceneError, match=r"images.txt, line 1: there is no camera 2"):
        read(tmp_path)
    (tmp_path / "images.txt").write_text("1 0 0 0 0 0 0 0 1 a.png\n\n", encoding="utf-8")
    with pytest.raises(SceneError, match="a quaternion is zero"):
        read(tmp_path)


def test_colmaps_images_without_their_lines_of_points_are_refused(tmp_path):
    """Every second one would be taken for the points of the one before."""
    (tmp_path / "cameras.txt").write_text("1 PINHOLE 4 4 1 1 2 2\n", encoding="utf-8")
    images = [f"{n} 1 0 0 0 0 0 0 1 {n}.png" for n in (1, 2, 3)]
    path = tmp_path / "images.txt"
    path.write_text("\n".join(images), encoding="utf-8")
    with pytest.raises(SceneError, match="line 2: an image's second line has its points"):
        read(tmp_path)
    path.write_text("# images\n\n" + "\n\n".join(images), encoding="utf-8")
    assert [view.name for view in read(tmp_path)] == ["1.png", "2.png", "3.png"]
