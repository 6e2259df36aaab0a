"""What tests of others use: `assert_sees`, the plugin of pytest, JUnit's XML."""

from __future__ import annotations

import re
import subprocess
import sys
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from reference_tracer import Verdict, render, save_scene
from reference_tracer.files import images
from reference_tracer.files.scenes import Account
from reference_tracer.manifest import Effect, Unmodelled
from reference_tracer.opened import file_manifest
from reference_tracer.report.junit import Judged, junit
from reference_tracer_conformance.pytest_plugin import _name_of
from reference_tracer_conformance.scenes import kit_scenes
from reference_tracer_conformance.testing import assert_sees as check

PAGE = Path(__file__).parents[2] / "docs" / "testing.md"
RENDERER = """
import os
from dataclasses import replace
from reference_tracer import load_scene, render

def draw(path):
    scene = load_scene(path)
    half = 0.5 * ("test_1" in os.environ["PYTEST_CURRENT_TEST"])
    window = scene.camera.window
    x, y = window.size
    moved = window.moved(half * x / scene.camera.width, half * y / scene.camera.height)
    return render(scene.seen_by(replace(scene.camera, window=moved))).color
"""


@pytest.fixture
def scene():
    return kit_scenes()[0].scene


def moved(scene, pixels):
    """Return the scene with a camera that looks past the pixels' centres."""
    window = scene.camera.window
    step = pixels * window.size[0] / scene.camera.width
    return scene.seen_by(replace(scene.camera, window=window.moved(step, step)))


def test_its_own_picture_passes_and_another_camera_s_does_not(scene, tmp_path):
    color = render(scene).color
    assert check(scene, color).verdict is Verdict.AGREE
    assert check(moved(scene, 3), color, camera=scene.camera).verdict is Verdict.AGREE
    save_scene(tmp_path / "scene.npz", moved(scene, 3))
    assert check(tmp_path / "scene.npz", color, camera=scene.camera).counts.differ == 0
    with pytest.raises(AssertionError, match="not what the camera sees: the camera"):
        check(moved(scene, 3), color)


def test_what_a_file_lacks_counts_with_another_camera_too(scene, tmp_path):
    lost = Unmodelled("lost.bin", "buffer", effect=Effect.MISSING)
    manifest = file_manifest(tmp_path, scene, Account((lost,)))
    path = tmp_path / "scene.npz"
    save_scene(path, scene, manifest)
    color = render(scene).color
    for camera in (None, scene.camera):
        with pytest.raises(AssertionError, match=r"what the camera sees: \(.*lost\.bin"):
            check(path, color, camera=camera)


def test_a_failure_says_what_is_wrong_and_leaves_a_page(scene, tmp_path):
    color = render(moved(scene, 0.5)).color
    with pytest.raises(AssertionError) as failed:
        check(scene, color, page=tmp_path / "page")
    said = str(failed.value)
    assert "pixels' corners, not their centres" in said and "verdict: differences" in said
    [page] = re.findall(r"its page: (.+)", said)
    assert "corners" in Path(page).read_text(encoding="utf-8")


def test_depths_pass_and_millimetres_are_named(scene):
    frame = render(scene)
    depth = np.where(frame.instance_index >= 0, frame.depth, np.inf).astype(np.float32)
    assert check(scene, depth, kind="depth").counts.differ == 0
    with pytest.raises(AssertionError, match="the values are in millimetres"):
        check(scene, depth * 1000, kind="depth")
    assert check(scene, depth * 1000, kind="depth", scale=0.001).counts.differ == 0


@pytest.mark.parametrize("scale", [0.0, -1.0, np.nan, np.inf])
def test_a_scale_that_is_none_is_refused(scene, scale):
    depth = render(scene).depth
    with pytest.raises(ValueError, match="must be above 0"):
        check(scene, depth, kind="depth", scale=scale)


@pytest.mark.parametrize("kind", ["", "ids", "normals"])
def test_a_scale_of_what_has_none_is_refused(scene, kind):
    with pytest.raises(ValueError, match="scale is"):
        check(scene, render(scene).color, kind=kind, scale=0.001)


def test_a_warning_fails_unless_it_is_accepted(scene):
    """Of an empty picture nothing could have been wrong."""
    away = scene.seen_by(replace(scene.camera, clip_end=0.2))
    color = render(away).color
    with pytest.raises(AssertionError, match="the picture is empty"):
        check(away, color)
    assert check(away, color, accepted=Verdict).verdict is Verdict.WARNINGS


def test_the_examples_of_the_page_run(scene, tmp_path):
    """The first with a renderer that is right, the second with one that is half a pixel off."""
    save_scene(tmp_path / "scene.npz", scene)
    (tmp_path / "my_renderer.py").write_text(RENDERER, encoding="utf-8")
    examples = re.findall(r"^```python\n(.*?)^```$", PAGE.read_text(encoding="utf-8"), re.M | re.S)
    for number, text in enumerate(examples):
        (tmp_path / f"test_{number}.py").write_text(text, encoding="utf-8")
    words = [sys.executable, "-m", "pytest", "-q", "--reftrace-pages", "pages"]
    done = subprocess.run(words, cwd=tmp_path, capture_output=True, text=True, timeout=300)
    assert len(examples) == 2 and "1 failed, 1 passed" in done.stdout, done.stdout
    assert "the pixels' corners, not their centres" in done.stdout
    [page] = (tmp_path / "pages").rglob("page.html")
    assert page.parent.name == "sees-1" and page.parent.parent.name.startswith("test_1.py")
    assert f"its page: {page.relative_to(tmp_path)}" in done.stdout
    assert "testing.py" not in done.stdout  # the failure is the test's own line


def test_folders_of_tests_with_long_names_can_be_made(tmp_path):
    names = {_name_of(f"test_a.py::test[{'x' * 400}{end}]") for end in "ab"}
    names |= {_name_of(f"test_a.py::test[{'ä' * 400}]"), _name_of("test_a.py::test")}
    assert len(names) == 4 and "test_a.py-test" in names
    for name in names:
        (tmp_path / name).mkdir()


def test_the_plugin_imports_nothing_before_it_is_used():
    code = "import sys, reference_tracer_conformance.pytest_plugin; print('numpy' in sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "False"


@pytest.fixture
def against(scene, tmp_path, exit_code):
    """Compare a picture of the scene on the command line; returns the exit code and the XML."""
    save_scene(tmp_path / "scene.npz", scene)

    def run(color, *options):
        images.save_png(tmp_path / "picture.png", images.to_display(color))
        words = ["compare", "scene.npz", "--against", "picture.png", "--out", "out", *options]
        code = exit_code([*words, "--junit", "out/x/junit.xml"])
        found = Path("out/x/junit.xml")
        return code, ElementTree.parse(found).getroot() if found.exists() else None

    return run


def test_a_comparison_writes_junit(scene, against, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    code, found = against(render(moved(scene, 3)).color, "--no-diagnosis")
    assert code == 2
    [case] = found.iter("testcase")
    assert case.get("name") == case.get("classname") == "scene.npz"
    assert "no cause explains it" in case.find("failure").get("message")
    code, found = against(render(scene).color)
    assert code == 0 and found.find(".//failure") is None
    assert found.find("testsuite").attrib == {"name": "scene.npz", "tests": "1", "failures": "0"}
    code, found = against(render(scene).color[:10])  # no comparison, and no file of an earlier one
    assert code == 3 and found is None


def test_junit_without_a_comparison_is_refused(scene, tmp_path, exit_code, capsys):
    save_scene(tmp_path / "scene.npz", scene)
    words = ["compare", str(tmp_path / "scene.npz"), "--colors-out"]
    assert exit_code([*words, str(tmp_path / "c.json"), "--junit", str(tmp_path / "j.xml")]) == 4
    assert "--junit is for a comparison" in capsys.readouterr().err


def test_whatever_a_name_holds_the_xml_can_be_read():
    text = junit("a", {"b\x00<": [Judged("\ud800&", "no\x07", "\n\x1b[31m"), Judged("c")]})
    root = ElementTree.fromstring(text.encode())
    failure = root.find(".//failure")
    assert failure.get("message") == r"no\x07" and failure.text == "\n\\x1b[31m"
    assert [c.get("name") for c in root.iter("testcase")] == [r"\ud800&", "c"]
