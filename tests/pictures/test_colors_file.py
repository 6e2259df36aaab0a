"""The palette for another renderer: written, read, and refused with what to do."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import jsonschema
import numpy as np
import pytest
from reference_tracer.cli.main import main
from reference_tracer.cli.parser import INPUT_ERROR
from reference_tracer.files import images
from reference_tracer.files.scenes import save_scene
from reference_tracer.pictures import colors_file
from reference_tracer.pictures.palette import By
from reference_tracer.rendering import render
from reference_tracer.report import page
from reference_tracer.scene import SceneError

SCHEMA = json.loads((Path(page.__file__).parent / "colors.schema.json").read_text("utf-8"))


@pytest.fixture
def scene(make):
    """Two squares and a plane in one grey: nothing tells them apart."""
    squares = make.quad(-1, 0, -1, 1, -3, "Left"), make.quad(0, 1, -1, 1, -3, "Right")
    found = make.scene(make.camera(12, 8), *squares, planes=[((0, 0, -9), (0, 0, 1))])
    grey = np.array([[0.8, 0.8, 0.8, 1]], np.float32)
    return replace(
        found,
        instances=tuple(replace(i, colors=grey) for i in found.instances),
        planes=tuple(replace(p, color=grey[0]) for p in found.planes),
    )


@pytest.fixture
def files(scene, tmp_path, exit_code):
    """Return what compares the scene, in a file, with a picture of a scene."""
    save_scene(tmp_path / "scene.npz", scene)

    def compared(shown, *options):
        images.save_png(tmp_path / "picture.png", images.to_display(render(shown).color))
        paths = ["compare", tmp_path / "scene.npz", "--against", tmp_path / "picture.png"]
        return exit_code([*map(str, paths), "--out", str(tmp_path / "out"), *map(str, options)])

    return compared


def test_what_is_written_is_as_the_schema_says_and_is_read_again(scene, tmp_path):
    jsonschema.Draft202012Validator.check_schema(SCHEMA)
    clear, notes = colors_file.in_colors(scene, By.OBJECT)
    text = colors_file.text(clear, ())
    jsonschema.validate(json.loads(text), SCHEMA)
    path = tmp_path / "colors.json"
    path.write_text(text, encoding="utf-8")
    given = colors_file.read(path)
    again, _ = colors_file.in_colors(scene, given)
    np.testing.assert_array_equal(render(again).color, render(clear).color)
    names = [entry["name"] for entry in json.loads(text)["objects"]]
    assert names == ["Left", "Plane 0", "Right"] and notes == ()
    for entry in json.loads(text)["objects"]:
        [slot] = entry["slots"]
        shown = images.to_display(np.array([[*slot["linear"], 1.0]]))[0, :3]
        assert shown.tolist() == slot["srgb"]


def changed(content, change):
    change(content)
    return content


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (lambda c: c["objects"].pop(0), "no colour for 'Left'"),
        (lambda c: c["objects"][0].update(name="Lft"), "a colour for 'Lft', and the scene has no"),
        (
            lambda c: c["objects"].append(c["objects"][0]),
            "name is 'Left', which is there twice",
        ),
        (lambda c: c["objects"][0].update(slots=[]), "slots of 'Left' is empty"),
        (lambda c: c["objects"][0].pop("slots"), "objects[0].slots is missing"),
        (lambda c: c["objects"].insert(0, 1), "objects[0] must be an object in braces"),
        (lambda c: c["objects"][0]["slots"].insert(0, 1), "slots[0] of 'Left' must be an object"),
        (lambda c: slot(c).update(linear=[0, 2, 0]), "each must be from 0 to 1"),
        (lambda c: slot(c).update(linear=[0, 2]), "linear must be 3 finite numbers"),
        (lambda c: slot(c).update(srgb=[1, 2, 3]), "leave out srgb, or make both the same"),
        (lambda c: c.update(schema="another"), "--colors-out writes such files"),
        (lambda c: c.update(slots_past_the_end="black"), "must be 'show the last colour'"),
    ],
)
def test_what_is_wrong_is_named(scene, files, tmp_path, capsys, change, said):
    content = json.loads(colors_file.text(colors_file.in_colors(scene, By.OBJECT)[0], ()))
    path = tmp_path / "colors.json"
    path.write_text(json.dumps(changed(content, change)), encoding="utf-8")
    assert files(scene, "--colors", path) == INPUT_ERROR
    error = capsys.readouterr().err
    assert said in error and str(path) in error and "Traceback" not in error


def slot(content):
    return content["objects"][0]["slots"][0]


@pytest.mark.parametrize("text", ["", "[" * 100_000, "[]", "\ud800"])
def test_what_is_no_palette_is_refused(tmp_path, text):
    path = tmp_path / "colors.json"
    path.write_bytes(text.encode("utf-8", "surrogatepass"))
    with pytest.raises(SceneError, match=r"colors\.json'"):
        colors_file.read(path)


def test_what_no_palette_can_name(scene):
    corners = np.ones((2, 3, 4), np.float32)
    attribute = replace(scene, meshes=[replace(m, corner_colors=corners) for m in scene.meshes])
    with pytest.raises(SceneError, match="'Left' shows a colour attribute"):
        colors_file.text(attribute, ())
    first, second = scene.instances
    other = replace(second, object=first.object, colors=second.colors / 2)
    with pytest.raises(SceneError, match="'Left' has instances in several colours"):
        colors_file.text(replace(scene, instances=(first, other)), ())


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (("--colors", "material"), "is for a .blend"),
        (("--as-is",), "--as-is is for Blender's picture"),
        (("--colors", "red"), "'red' is none of automatic, viewport, object, material"),
    ],
)
def test_options_that_cannot_be(scene, files, capsys, options, said):
    assert files(scene, *options) == INPUT_ERROR
    assert said in capsys.readouterr().err


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (("--as-is", "--colors", "object"), "--colors is for a picture like for like"),
        (("--judge", "all", "--colors-out", "c.json"), "--colors-out is for one judge"),
        (("--frames", "1", "--colors-out", "c.json"), "--colors-out is for one frame"),
    ],
)
def test_options_that_contradict_one_another(tmp_path, capsys, options, said):
    blend = str(tmp_path / "none.blend")
    assert main(["compare", blend, "--out", str(tmp_path / "out"), *options]) == INPUT_ERROR
    assert said in capsys.readouterr().err
