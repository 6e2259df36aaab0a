"""The committed sample scenes: as make_scenes.py builds them, small, naming nobody's machine."""

from __future__ import annotations

import importlib.util
import os
import sys
import tempfile
from pathlib import Path

import bpy
import numpy as np
import pytest
import zstandard  # comes with Blender and with bpy

FOLDER = Path(__file__).resolve().parents[2] / "sample_scenes"
LARGEST = 1_000_000  # bytes
SAME = 1e-5  # metres: what float32 sines and cosines of different Blender builds may differ by

_spec = importlib.util.spec_from_file_location("make_scenes", FOLDER / "make_scenes.py")
make_scenes = importlib.util.module_from_spec(_spec)
_spec.loader.exec_module(make_scenes)
NAMES = list(make_scenes.SCENES)


@pytest.fixture(scope="module", autouse=True)
def properties():
    """Have the add-on's properties registered, and leave them as they were."""
    there = hasattr(bpy.types.Object, "reference_tracer")
    make_scenes.register_properties()
    yield
    if not there:
        sys.modules["reference_tracer.blender.ui.properties"].unregister()


def opened(name: str, folder: Path = FOLDER) -> bpy.types.Scene:
    bpy.ops.wm.open_mainfile(filepath=str(folder / f"{name}.blend"), load_ui=False)
    return bpy.context.scene


def decompressed(name: str) -> bytes:
    with (FOLDER / f"{name}.blend").open("rb") as file:
        return zstandard.ZstdDecompressor().stream_reader(file, read_across_frames=True).read()


def shape(scene: bpy.types.Scene) -> dict:
    """Return the scene's settings, what is drawn where, and each mesh as triangles (n, 3, 3)."""
    depsgraph = bpy.context.evaluated_depsgraph_get()
    names, places, triangles = [], [], {}
    for instance in depsgraph.object_instances:
        obj = instance.object
        names.append((obj.name, instance.parent.name if instance.is_instance else ""))
        places.append(np.array(instance.matrix_world))
        if obj.name in triangles or obj.type not in {"MESH", "CURVE", "SURFACE", "FONT", "META"}:
            continue
        mesh = obj.data if obj.type == "MESH" else obj.to_mesh()
        mesh.calc_loop_triangles()
        points = np.empty(3 * len(mesh.vertices), np.float32)
        corners = np.empty(3 * len(mesh.loop_triangles), np.int32)
        mesh.vertices.foreach_get("co", points)
        mesh.loop_triangles.foreach_get("vertices", corners)
        triangles[obj.name] = points.reshape(-1, 3)[corners].reshape(-1, 3, 3)
    camera, render = scene.camera.data, scene.render
    return {
        "settings": (
            scene.name,
            scene.display.shading.color_type,
            camera.type,
            camera.sensor_fit,
            camera.lens,
            camera.ortho_scale,
            camera.shift_x,
            camera.shift_y,
            render.resolution_x,
            render.resolution_y,
            render.pixel_aspect_x,
            render.pixel_aspect_y,
        ),
        "objects": {
            obj.name: (
                obj.type,
                tuple(obj.color),
                obj.reference_tracer.infinite_plane,
                tuple(slot.name for slot in obj.material_slots),
            )
            for obj in scene.objects
        },
        "names": names,
        "places": np.array(places),
        "triangles": triangles,
    }


def area(triangles: np.ndarray) -> float:
    sides = triangles[:, 1:] - triangles[:, :1]
    return float(np.linalg.norm(np.cross(sides[:, 0], sides[:, 1]), axis=1).sum() / 2)


def ends(triangles: np.ndarray) -> np.ndarray:
    return np.array([triangles.min(axis=(0, 1)), triangles.max(axis=(0, 1))])


def test_every_scene_is_committed_and_described():
    assert sorted(path.stem for path in FOLDER.glob("*.blend")) == sorted(NAMES)
    described = (FOLDER / "README.md").read_text(encoding="utf-8")
    assert [name for name in NAMES if f"`{name}`" not in described] == []
    assert [name for name, build in make_scenes.SCENES.items() if not build.__doc__] == []


@pytest.mark.parametrize("name", NAMES)
def test_file_is_small_and_opens_in_blender_4_2(name):
    path = FOLDER / f"{name}.blend"
    assert path.stat().st_size < LARGEST
    assert path.read_bytes()[:4] == zstandard.FRAME_HEADER  # compressed
    assert decompressed(name)[:12] == b"BLENDER-v402"


@pytest.mark.parametrize("name", NAMES)
def test_file_names_no_place_on_a_machine(name):
    content = decompressed(name)
    places = {
        os.path.expanduser("~"),
        tempfile.gettempdir(),
        os.path.abspath(os.curdir),
        str(FOLDER),
        sys.prefix,
    }
    places |= {os.path.realpath(place) for place in places}
    found = [place for place in places if len(place) > 3 and os.fsencode(place) in content]
    assert found == []


@pytest.mark.parametrize("name", NAMES)
def test_scene_has_a_camera_and_nothing_unused(name):
    scene = opened(name)
    assert scene.camera is not None
    assert scene.render.resolution_x * scene.render.resolution_y <= 960 * 540
    assert scene.reference_tracer.method == ("textbook" if name.startswith("exercise") else "auto")
    kinds = (
        "objects",
        "meshes",
        "curves",
        "metaballs",
        "cameras",
        "materials",
        "collections",
        "node_groups",
        "images",
        "worlds",
        "texts",
        "brushes",
        "linestyles",
        "palettes",
    )
    data = [block for kind in kinds for block in getattr(bpy.data, kind)]
    assert [block.name for block in data if block.use_fake_user or not block.users] == []


@pytest.mark.parametrize("name", NAMES)
def test_make_scenes_builds_what_is_committed(name, tmp_path):
    committed = shape(opened(name))
    make_scenes.make(name, tmp_path)
    rebuilt = shape(opened(name, tmp_path))
    assert rebuilt["settings"] == pytest.approx(committed["settings"])
    assert rebuilt["objects"].keys() == committed["objects"].keys()
    assert rebuilt["objects"] == committed["objects"]
    assert rebuilt["names"] == committed["names"]
    np.testing.assert_allclose(rebuilt["places"], committed["places"], rtol=1e-6, atol=SAME)
    assert rebuilt["triangles"].keys() == committed["triangles"].keys()
    for obj, triangles in committed["triangles"].items():
        again = rebuilt["triangles"][obj]
        if committed["objects"].get(obj, ("",))[0] == "FONT":
            # 5.2 fills the same outlines with other triangles in a text that it made itself
            assert again.shape == triangles.shape
            assert area(again) == pytest.approx(area(triangles))
            again, triangles = (ends(mesh) for mesh in (again, triangles))
        np.testing.assert_allclose(again, triangles, rtol=0, atol=SAME, err_msg=obj)


@pytest.mark.parametrize("name", NAMES)
def test_it_opens_where_the_button_is_and_looks_through_its_camera(name):
    bpy.ops.wm.open_mainfile(filepath=str(FOLDER / f"{name}.blend"), load_ui=True)
    spaces = {area.type: area.spaces.active for area in bpy.data.screens["Layout"].areas}
    assert spaces["PROPERTIES"].context == "RENDER"
    assert spaces["VIEW_3D"].region_3d.view_perspective == "CAMERA"
