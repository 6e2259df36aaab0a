"""The committed sample scenes: as make_scenes.py builds them, small, naming nobody's machine."""

from __future__ import annotations

import importlib.util
import os
import sys
import tempfile
from pathlib import Path

import bpy
import pytest
import zstandard  # comes with Blender and with bpy
from reference_tracer.blender.jobs.open_file import export_open_file

from .scenes import assert_same_scene

FOLDER = Path(__file__).resolve().parents[2] / "sample_scenes"
LARGEST = 1_000_000  # bytes

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
def test_make_scenes_builds_what_is_committed(name, tmp_path):
    opened(name)
    texts = {obj.data.name for obj in bpy.data.objects if obj.type == "FONT"}
    committed, manifest, _ = export_open_file(bpy.context, whole=True)
    make_scenes.make(name, tmp_path)
    opened(name, tmp_path)
    rebuilt, again, _ = export_open_file(bpy.context, whole=True)
    assert again == manifest
    # 5.2 fills the same outlines with other triangles in a text that it made itself.
    assert_same_scene(rebuilt, committed, texts)


@pytest.mark.parametrize("name", NAMES)
def test_it_opens_where_the_button_is_and_looks_through_its_camera(name):
    bpy.ops.wm.open_mainfile(filepath=str(FOLDER / f"{name}.blend"), load_ui=True)
    spaces = {area.type: area.spaces.active for area in bpy.data.screens["Layout"].areas}
    assert spaces["PROPERTIES"].context == "RENDER"
    assert spaces["VIEW_3D"].region_3d.view_perspective == "CAMERA"
