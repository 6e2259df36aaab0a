"""What `import reference_tracer` offers: its page is what the docstrings say, its examples run."""

import doctest
import os
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import reference_tracer
from reference_tracer import Region, compare, load_scene, render, save_scene
from reference_tracer.files import images
from reference_tracer.opened import open_scene
from reference_tracer.scene import SceneError

from .files.png_files import chunk

PAGE = Path(__file__).parent.parent / "docs" / "python.md"
TRIANGLE = "v -1 -1 0\nv 1 -1 0\nv 0 1 0\nf 1 2 3\n"


@pytest.fixture
def triangle(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("triangle.obj").write_text(TRIANGLE, encoding="utf-8")
    scene = load_scene("triangle.obj")
    scene = scene.seen_by(replace(scene.camera, width=192, height=108, region=None))
    save_scene("triangle.npz", scene)
    return scene


def test_the_examples_of_the_page_run(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    found = doctest.testfile(str(PAGE), module_relative=False, encoding="utf-8")
    assert found.attempted > 8 and not found.failed


@pytest.mark.parametrize("name", reference_tracer.__all__)
def test_all_that_is_offered_is_there_and_described(name):
    offered = getattr(reference_tracer, name)
    assert offered.__doc__ and name in dir(reference_tracer)
    assert f"`{name}" in PAGE.read_text(encoding="utf-8")


def test_nothing_is_imported_before_it_is_asked_for():
    """So that Blender starts no later for it."""
    code = "import sys, reference_tracer; print('numpy' in sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "False"
    with pytest.raises(AttributeError, match="no attribute 'raytrace'"):
        _ = reference_tracer.raytrace


def test_a_file_and_an_array_give_the_same(triangle):
    color = render(triangle).color.copy()
    color[20:24, 60:66] = (0.2, 0.5, 0.1, 1)
    images.save_png("picture.png", images.to_display(color))
    of_file = compare(triangle, "picture.png", diagnose=False)
    stored = images.open_picture("picture.png").read().color
    of_array = compare(triangle, stored, diagnose=False)
    assert of_file.verdict == of_array.verdict == "differences"
    assert of_file.counts == of_array.counts and of_file.counts.unexplained == 24


def test_rgb_alone_has_no_alpha_to_compare(triangle):
    frame = render(triangle)
    opaque = np.where(frame.instance_index[..., None] >= 0, frame.color[..., :3], 0)
    same = compare(triangle, opaque)
    assert same.verdict == "agree" and same.metrics.rmse == 0  # nor to measure
    assert compare(triangle, opaque[::-1]).verdict == "differences"


def test_the_command_says_the_same(triangle, capsys, tmp_path):
    """As one function does it."""
    from reference_tracer.cli.main import main

    color = render(triangle).color[::-1]
    images.save_png("picture.png", images.to_display(color))
    code = main(["compare", "triangle.npz", "--against", "picture.png", "--out", "out"])
    found = compare("triangle.npz", "picture.png")
    assert code == found.verdict.exit_code
    said = capsys.readouterr().out
    assert f"verdict: {found.verdict}" in said
    assert all(line in said for line in found.diagnosis.lines())
    assert os.path.exists("out/comparison.json")


def test_what_is_wrong_is_named(triangle, tmp_path):
    with pytest.raises(ValueError, match="'fast'; it must be one of rays, raster"):
        compare(triangle, np.zeros((108, 192, 4)), renderer="fast")
    with pytest.raises(ValueError, match=r"\(h, w, 3\) or \(h, w, 4\), not \(108, 192\)"):
        compare(triangle, np.zeros((108, 192)))
    for wrong in (-1.0, np.nan, np.inf):
        with pytest.raises(ValueError, match=r"filter_radius is .*; it must be 0 or more"):
            compare(triangle, np.zeros((108, 192, 4)), filter_radius=wrong)
    with pytest.raises(ValueError, match="dither is -1; it must be 0 or more"):
        compare(triangle, np.zeros((108, 192, 4)), dither=-1)
    with pytest.raises(ValueError, match="floats from 0 to 1, not uint8"):
        compare(triangle, np.zeros((108, 192, 4), np.uint8))
    with pytest.raises(ValueError, match="3 x 2 pixels"):
        compare(triangle, np.zeros((2, 3, 4)))
    with pytest.raises(SceneError, match=r"there is no file 'none.npz'"):
        load_scene("none.npz")


def test_what_a_file_holds_and_the_scene_does_not_is_a_warning(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    bent = "v 0 0 0\nv 1 0 0\nv 1 1 1\nv 0 1 0\nf 1 2 3 4\n"
    Path("bent.obj").write_text(bent, encoding="utf-8")
    with pytest.warns(UserWarning, match="bent.obj: .*flat"):
        load_scene("bent.obj")


def test_what_the_file_of_a_scene_lacks_counts_in_the_verdict(tmp_path, monkeypatch):
    """Also once it is exported: what a .npz's source lacked, a comparison of it knows."""
    monkeypatch.chdir(tmp_path)
    Path("curve.obj").write_text(TRIANGLE + "curv 0 1 1 2\n", encoding="utf-8")
    scene, manifest, _ = open_scene(Path("curve.obj"))
    assert manifest.lacks
    color = render(scene).color
    save_scene("kept.npz", scene, manifest)
    save_scene("alone.npz", scene)
    verdicts = [compare(of, color).verdict for of in ("curve.obj", "kept.npz", "alone.npz", scene)]
    assert verdicts == ["warnings", "warnings", "agree", "agree"]
    kept = open_scene(Path("kept.npz")).manifest
    assert kept.lines()[1:] == manifest.lines()[1:]
    assert [u.to_dict() for u in kept.lacks] == [u.to_dict() for u in manifest.lacks]


def test_what_is_remarked_of_a_picture_is_said(triangle, monkeypatch):
    images.save_png("own.png", images.to_display(render(triangle).color))
    content = Path("own.png").read_bytes()
    Path("own.png").write_bytes(content[:33] + chunk(b"gAMA", (100000).to_bytes(4)) + content[33:])
    notes = compare(triangle, "own.png", diagnose=False).manifest.notes
    assert any("of the picture" in note and "gAMA" in note for note in notes)


def test_an_array_of_the_whole_view_is_compared_in_the_region(triangle):
    color = render(triangle).color
    part = replace(triangle.camera, region=Region(20, 40, 140, 80))
    part = replace(triangle, camera=part)
    assert compare(part, color).verdict == "agree"
    assert compare(part, color[40:80, 20:140]).verdict == "agree"
    with pytest.raises(ValueError, match="120 x 60 pixels"):
        compare(part, color[40:100, 20:140])


def test_cameras_are_written_and_read(triangle):
    reference_tracer.write_camera("sparse", triangle.camera, "colmap")
    again = reference_tracer.read_camera("sparse", triangle.camera.name)
    assert np.array_equal(
        render(triangle.seen_by(again)).instance_index, render(triangle).instance_index
    )
    with pytest.raises(SceneError, match="'maya' is none of opencv, "):
        reference_tracer.write_camera("camera.ma", triangle.camera, "maya")
    with pytest.raises(SceneError, match="no camera '7'"):
        reference_tracer.read_camera("sparse", 7)
