"""Files as other programs and people write them, where these say more than ours do.

What is expected is written out from each program's documents.
"""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest
from reference_tracer.camera_files.convention import View
from reference_tracer.camera_files.files import chosen, read
from reference_tracer.projections import ORTHOGRAPHIC
from reference_tracer.scene import SceneError
from reference_tracer.tracer.camera import film_of

from .cameras import camera as any_camera
from .cameras import kubric

SENSOR = """<scene version="3.0.0">
  <default name="wide" value="640"/>
  <integrator type="path"/>
  <sensor type="{kind}">
    {values}
    <transform name="to_world">{places}</transform>
    <film type="hdrfilm">
      <integer name="width" value="$wide"/><integer name="height" value="{height}"/>{film}
    </film>
  </sensor>
</scene>"""


def mitsuba(tmp_path, values="", places="", film="", kind="perspective", height=480):
    path = tmp_path / "scene.xml"
    text = SENSOR.format(kind=kind, values=values, places=places, film=film, height=height)
    path.write_text(text, encoding="utf-8")
    (view,) = read(path)
    return view.camera


def test_mitsubas_look_at(tmp_path):
    place = '<lookat origin="1, 1, 1" target="1, 2, 1" up="0, 0, 1"/>'
    camera = mitsuba(tmp_path, '<float name="fov" value="90"/>', place)
    assert np.allclose(camera.origin, 1) and np.allclose(camera.forward, (0, 1, 0))
    assert np.allclose(camera.up, (0, 0, 1)) and np.allclose(camera.right, (1, 0, 0))
    assert camera.window.right == pytest.approx(1) and camera.window.top == pytest.approx(0.75)
    assert (camera.clip_start, camera.clip_end) == pytest.approx((1e-2, 1e4))  # its defaults


def test_mitsubas_transforms_come_one_after_the_other(tmp_path):
    places = '<scale value="-1, 1, 1"/><rotate y="1" angle="90"/><translate x="2" z="3"/>'
    camera = mitsuba(tmp_path, '<float name="fov" value="90"/>', places)
    # +Z turned about Y by 90 degrees is +X; +X, the left, is mirrored first.
    assert np.allclose(camera.forward, (1, 0, 0)) and np.allclose(camera.origin, (2, 0, 3))
    assert np.allclose(camera.right, (0, 0, -1)) and np.allclose(camera.up, (0, 1, 0))


def test_mitsubas_other_transforms_place_no_camera(tmp_path):
    values = '<float name="fov" value="90"/><transform name="other"><translate x="9"/></transform>'
    assert np.allclose(mitsuba(tmp_path, values, '<translate x="2"/>').origin, (2, 0, 0))
    moving = values + '<animation name="to_world"><transform time="0"/></animation>'
    with pytest.raises(SceneError, match="its to_world is animated"):
        mitsuba(tmp_path, moving)
    with pytest.raises(SceneError, match="not of finite numbers"):
        mitsuba(tmp_path, values, '<rotate angle="9"/>')


HALF = np.tan(np.radians(50) / 2)
AXES = {
    "x": HALF,
    "y": HALF * 4 / 3,
    "diagonal": HALF * 0.8,
    "smaller": HALF * 4 / 3,
    "larger": HALF,
}


@pytest.mark.parametrize("axis", AXES)
def test_mitsubas_angle_is_of_an_axis(axis, tmp_path):
    values = f'<float name="fov" value="50"/><string name="fov_axis" value="{axis}"/>'
    assert mitsuba(tmp_path, values).window.right == pytest.approx(AXES[axis])


def test_mitsubas_focal_length_is_of_a_film_of_36_by_24(tmp_path):
    diagonal = np.hypot(36, 24) / 2
    for values, length in (("", 50), ('<string name="focal_length" value="35mm"/>', 35)):
        camera = mitsuba(tmp_path, values)
        assert np.hypot(camera.window.right, camera.window.top) == pytest.approx(diagonal / length)


def test_mitsubas_orthographic_film_is_scaled(tmp_path):
    camera = mitsuba(tmp_path, places='<scale x="10" y="10"/>', kind="orthographic")
    assert camera.projection is ORTHOGRAPHIC
    assert camera.window.right == pytest.approx(10) and camera.window.top == pytest.approx(7.5)


@pytest.mark.parametrize(
    ("values", "places", "said"),
    [
        ('<float name="fov" value="200"/>', "", "between 0 and 180"),
        ('<float name="fov" value="$angle"/>', "", r"its fov is '\$angle'"),
        ('<string name="focal_length" value="50in"/>', "", "focal_length is '50in'"),
        ("", '<matrix value="1 2 3"/>', "matrix is '1 2 3', which must be 16"),
        ("", "<spin/>", "to_world has 'spin'"),
    ],
)
def test_what_is_wrong_in_mitsubas_file_is_named(values, places, said, tmp_path):
    with pytest.raises(SceneError, match=said):
        mitsuba(tmp_path, values, places)
    with pytest.raises(SceneError, match="of the type 'thinlens'"):
        mitsuba(tmp_path, kind="thinlens")


def test_pytorch3ds_ndc_is_in_halves_of_the_shorter_side(tmp_path):
    arguments = {
        "R": [np.eye(3).tolist()],
        "T": [[0, 0, 0]],
        "focal_length": [[2, 2]],
        "principal_point": [[0.5, 0]],
        "image_size": [[200, 400]],
    }
    path = tmp_path / "cameras.json"
    path.write_text(json.dumps({"class": "PerspectiveCameras", "arguments": arguments}))
    (view,) = read(path)
    window = view.camera.window
    assert np.allclose(view.camera.forward, (0, 0, 1)) and np.allclose(
        view.camera.right, (-1, 0, 0)
    )
    # x_ndc = 2 x / z + 0.5 is from -2 at the right edge to 2 at the left one; +x is left.
    assert window.left == pytest.approx(-(2 - 0.5) / 2) and window.right == pytest.approx(2.5 / 2)
    assert window.top == pytest.approx(1 / 2)
    arguments["K"] = [np.eye(4).tolist()]  # which PyTorch3D would take in their place
    path.write_text(json.dumps({"class": "PerspectiveCameras", "arguments": arguments}))
    with pytest.raises(SceneError, match=r"arguments\.K is not read"):
        read(path)


def test_bops_size_is_in_a_folder_above_and_its_unit_millimetres(tmp_path):
    scene = tmp_path / "lm" / "test" / "000001"
    scene.mkdir(parents=True)
    (tmp_path / "lm" / "camera.json").write_text('{"width": 640, "height": 480, "fx": 1}')
    image = {"cam_K": [572.4, 0, 325.3, 0, 573.6, 242.0, 0, 0, 1], "depth_scale": 1.0}
    pose = {"cam_R_w2c": [1, 0, 0, 0, 1, 0, 0, 0, 1], "cam_t_w2c": [100, 0, 1500]}
    path = scene / "scene_camera.json"
    path.write_text(json.dumps({"3": image | pose}))
    (view,) = read(path)
    assert view.name == "000003.png" and np.allclose(view.camera.origin, (-0.1, 0, -1.5))
    assert view.camera.window.left == pytest.approx(-325.3 / 572.4)
    assert chosen(read(scene), "3").camera.height == 480
    path.write_text(json.dumps({"3": image}))
    with pytest.raises(SceneError, match="image 3: cam_R_w2c is missing"):
        read(path)
    path.write_text(json.dumps({"3": image | pose, "4": None}))
    with pytest.raises(SceneError, match="4 must be an object in braces"):
        read(path)


def gltf(tmp_path, nodes, camera=None):
    lens = {"type": "perspective", "perspective": {"yfov": 1.0, "znear": 0.1}}
    content = {
        "asset": {"version": "2.0"},
        "nodes": nodes,
        "cameras": [camera or lens],
    }
    path = tmp_path / "camera.gltf"
    path.write_text(json.dumps(content))
    return read(path, size=(100, 50))[0].camera


def test_gltfs_nodes_place_it_and_their_scale_is_ignored(tmp_path):
    half = np.sqrt(0.5)
    nodes = [
        {"children": [1], "translation": [1, 2, 3], "scale": [2, 2, 2]},
        {"camera": 0, "rotation": [-half, 0, 0, half], "translation": [0, 0, 1]},
    ]
    camera = gltf(tmp_path, nodes)
    # (1, 2, 3 + 2) with Y up is (1, -5, 2); turned about X by -90 degrees, it looks down.
    assert np.allclose(camera.origin, (1, -5, 2)) and np.allclose(camera.forward, (0, 0, -1))
    assert np.allclose(camera.up, (0, 1, 0))
    assert camera.window.top == pytest.approx(np.tan(0.5))
    assert camera.window.right == pytest.approx(2 * np.tan(0.5))
    assert (camera.clip_start, camera.clip_end) == (0.1, np.inf)
    nodes[0]["scale"] = [-2, 2, 2]
    with pytest.raises(SceneError, match="a scale that is zero or negative"):
        gltf(tmp_path, nodes)


@pytest.mark.parametrize(
    ("lens", "said"),
    [
        ({"type": "fisheye"}, "neither a perspective camera nor an orthographic one"),
        ({"type": "perspective"}, "neither a perspective camera nor an orthographic one"),
        ({"type": "perspective", "perspective": {"yfov": 0, "znear": 1}}, "needs 'yfov'"),
        ({"type": "perspective", "perspective": {"yfov": 1}}, "needs 'znear'"),
        (
            {"type": "perspective", "perspective": {"yfov": 50.0, "znear": 1}},
            r"yfov is 50: .*radians.*degrees",
        ),
    ],
)
def test_what_is_wrong_in_gltfs_camera_is_named(lens, said, tmp_path):
    with pytest.raises(SceneError, match=said):
        gltf(tmp_path, [{"camera": 0}], lens)
    with pytest.raises(SceneError, match="no node of it has a camera"):
        gltf(tmp_path, [{}])


def test_instant_ngps_degrees_come_first(tmp_path):
    frame = {"file_path": "a", "transform_matrix": np.eye(4).tolist(), "x_fov": 90.0}
    content = {"w": 100.0, "h": 50.0, "fl_x": 7, "camera_angle_x": 0.3, "frames": [frame]}
    path = tmp_path / "transforms.json"
    path.write_text(json.dumps(content))
    camera = read(path)[0].camera
    assert camera.window.right == pytest.approx(1) and camera.window.top == pytest.approx(0.5)
    content["rolling_shutter"] = [0, 0, 0.1]
    path.write_text(json.dumps(content))
    assert "rolling_shutter is not applied" in read(path)[0].notes[0]


def same(first, second):
    """Whether two cameras see points in the same places."""
    points = first.origin[:, None] + first.world_from_camera[:3, :3] @ np.array(
        [[-0.2, 0.3, 0.1], [0.1, -0.1, 0.2], [-1.0, -2.0, -30.0]]
    )
    return np.allclose(film_of(first, points)[:2], film_of(second, points)[:2], atol=1e-8)


@pytest.mark.parametrize("in_pixels", [False, True])
def test_kubrics_k_is_of_a_camera_that_looks_along_minus_z(in_pixels, tmp_path):
    """In shares of the picture, as today, or in pixels, as at first."""
    rng = np.random.default_rng(8)
    first = any_camera(rng, shift=(0.05, -0.1))
    second = any_camera(rng)
    views = [View(first, "", 1), View(replace(second, window=first.window), "", 2)]
    path = tmp_path / "metadata.json"
    path.write_text(kubric(views, *((640, 360) if in_pixels else (1, 1))), encoding="utf-8")
    found = read(path)
    assert [view.name for view in found] == ["rgba_00000.png", "rgba_00001.png"]
    for view, own in zip(found, views, strict=True):
        assert same(view.camera, own.camera)


def test_kubrics_positions_are_a_list(tmp_path):
    path = tmp_path / "metadata.json"
    content = json.loads(kubric([View(any_camera(np.random.default_rng(9)), "a.png")], 1, 1))
    content["camera"]["positions"] = 5
    path.write_text(json.dumps(content), encoding="utf-8")
    with pytest.raises(SceneError, match=r"camera\.positions must be a list"):
        read(path)
