"""The certified picture of every sample scene is the same to the bit, wherever it is traced.

Digests of pictures are kept beside those of what Blender exported: where the second is another one,
it is Blender that has changed its mind, not the tracer. Pictures are traced here, and by other
Pythons with other numpys (tests/others.py), which read the scenes from files. With numpy's choices
of this CPU switched off, all loops run as the compiler made them for any CPU.
"""

from __future__ import annotations

import json
import os
import subprocess
from dataclasses import replace
from pathlib import Path

import bpy
import pytest
from reference_tracer.blender.jobs.open_file import export_open_file
from reference_tracer.files.certificates import save_certificate
from reference_tracer.files.scenes import save_scene
from reference_tracer.rendering import render
from reference_tracer.scene import Scene
from reference_tracer_verify.verify import verified

from .. import others
from ..certified import digest

PROJECT = Path(__file__).parents[2]
KEPT = Path(digest.__file__).with_name("digests.json")
SCENES = sorted((PROJECT / "sample_scenes").glob("*.blend"))
# Pictures are a third as wide and high as the scene says, as all take their time: but this one,
# whose rays meet edges and corners at its own size.
WHOLE = "technical_view"
# Without what numpy could choose of this CPU: of numpy 1 and of the newest. Every day the oldest
# traces every second scene, and the newest the others, but the one that takes as long as all.
ELSEWHERE = [(name, False) for name in others.NAMES]
ELSEWHERE += [(name, True) for name in others.NAMES if name.startswith(("3.11-1.26", "3.14"))]
DAILY = [(others.NAMES[0], False, slice(0, None, 2)), (others.NAMES[-1], True, slice(1, 9, 2))]


@pytest.fixture(scope="module")
def kept() -> dict[str, dict[str, str]]:
    return json.loads(KEPT.read_text(encoding="utf-8"))


@pytest.fixture(scope="module")
def scenes() -> dict[str, Scene]:
    out = {}
    for path in SCENES:
        bpy.ops.wm.open_mainfile(filepath=str(path), load_ui=False, use_scripts=False)
        scene = export_open_file(bpy.context)[0]
        camera, part = scene.camera, 1 if path.stem == WHOLE else 3
        size = camera.width // part, camera.height // part
        camera = replace(camera, width=size[0], height=size[1], region=None)
        out[path.stem] = scene.seen_by(camera)
    return out


@pytest.fixture(scope="module")
def folder(scenes, tmp_path_factory) -> Path:
    """The scenes in files, and the add-on where another Python finds it."""
    out = tmp_path_factory.mktemp("digests")
    for name, scene in scenes.items():
        save_scene(out / f"{name}.npz", scene)
    (out / "reference_tracer").symlink_to(PROJECT / "addon")
    return out


def traced_by(name: str, folder: Path, without: bool, some: slice) -> dict:
    """What another Python makes of some of the scenes, `without` numpy's choices of the CPU."""
    paths = sorted(map(str, folder.glob("*.npz")))[some]
    command = [str(others.python(name)), "-s", digest.__file__, *paths]
    env = os.environ | {"PYTHONPATH": str(folder), "PYTHONDONTWRITEBYTECODE": "1"}
    env.pop(digest.OFF, None)
    if without:
        env[digest.OFF] = "all"
    done = subprocess.run(command, env=env, capture_output=True, text=True, check=False)
    assert not done.returncode, done.stderr
    return json.loads(done.stdout)


def test_pictures_are_the_ones_that_are_kept(scenes, kept):
    """Where all of it is meant to be another, what is printed is the file's new content."""
    found = {
        name: {"scene": digest.of_scene(scene), "picture": digest.of_picture(scene)}
        for name, scene in scenes.items()
    }
    exported = [
        name for name, of in found.items() if name in kept and kept[name]["scene"] != of["scene"]
    ]
    assert not exported, f"Blender exports other numbers of {exported}: pictures say nothing"
    assert found == kept, json.dumps(found, indent=1)


@pytest.mark.parametrize(
    ("name", "without", "some"),
    [*DAILY, *(pytest.param(*p, slice(None), marks=pytest.mark.torture) for p in ELSEWHERE)],
)
def test_pictures_are_the_same_elsewhere(folder, kept, name, without, some):
    found = traced_by(name, folder, without, some)
    assert name.startswith(f"{found['python']}-{found['numpy']}-")
    assert not (without and found["features"])
    assert found["pictures"] == {scene: kept[scene]["picture"] for scene in sorted(kept)[some]}


@pytest.mark.torture
def test_their_certificates_are_true(scenes, tmp_path):
    for scene in scenes.values():
        save_certificate(tmp_path / "c.npz", render(scene))
        assert verified(str(tmp_path / "c.npz")).startswith("all ")
