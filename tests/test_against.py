"""`reftrace compare SCENE --against PICTURE`: scenes and meshes that need no Blender."""

from __future__ import annotations

import json
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import trimesh
from reference_tracer.cli.main import main
from reference_tracer.files import exr, images
from reference_tracer.files.scenes import save_scene
from reference_tracer.manifest import Effect, Manifest, Unmodelled
from reference_tracer.pictures.colors_file import in_colors
from reference_tracer.pictures.palette import By
from reference_tracer.rendering import render
from reference_tracer.scene import Region


@pytest.fixture
def scene(make):
    solids = (
        trimesh.creation.icosphere(2, radius=0.7).apply_translation((-0.6, 0.3, 0.4)),
        trimesh.creation.box((0.8, 0.6, 1.1)).apply_translation((0.7, -0.4, -0.3)),
    )
    camera = make.camera(60, 45, half=0.4, eye=(3, -4, 2), target=(0, 0, 0))
    return replace(make.scene(camera, *(make.mesh(s) for s in solids)), objects=("Ball", "Box"))


def moved(camera):
    """Return the camera with another angle of view."""
    return replace(camera, window=camera.window.scaled(1.1, 1.1))


@pytest.fixture
def against(scene, tmp_path, capsys, exit_code):
    """Compare the scene with a picture; returns the exit code, the JSON and what was printed."""
    save_scene(tmp_path / "scene.npz", scene)

    def run(color=None, name="picture.png", source="scene.npz", save=None, options=()):
        path = tmp_path / name
        if save:
            save(path)
        elif name.endswith(".png"):
            images.save_png(path, images.to_display(color))
        elif color is not None:
            exr.save(path, {"color": color})
        out = tmp_path / "out"
        arguments = ["compare", tmp_path / source, "--against", path, "--out", out, *options]
        code = exit_code([str(a) for a in arguments])
        held = out / "comparison.json"
        found = json.loads(held.read_text(encoding="utf-8")) if held.exists() else None
        printed = capsys.readouterr()
        return code, found, printed.out + printed.err

    return run


def test_an_object_without_a_surface_in_the_file_is_not_counted(scene, tmp_path, against):
    """As one that was outside the view at the export: the .blend says of it what the file says."""
    save_scene(tmp_path / "gone.npz", replace(scene, objects=(*scene.objects, "Gone")))
    _, found, printed = against(render(scene).color, source="gone.npz")
    assert "2 of 3 objects exported" in printed and "skipped Gone (MESH): nothing of it" in printed
    assert [entry["exported"] for entry in found["scene"]["objects"]] == [True, True, False]


def test_every_result_and_every_array_is_on_the_page_of_files(scene, tmp_path, against):
    text = (Path(__file__).parent.parent / "docs" / "files.md").read_text(encoding="utf-8")
    against(render(scene).color)
    with np.load(tmp_path / "out" / "frame.npz") as held:
        names = {*held} - {"rows_done"}  # of a picture that was cancelled
    names |= {path.name for path in (tmp_path / "out").iterdir()}
    assert not [name for name in names if f"`{name}`" not in text]


@pytest.mark.parametrize("name", ["picture.png", "picture.exr"])
def test_its_own_picture_agrees(scene, against, name):
    code, found, text = against(render(scene).color, name)
    assert code == 0 and found["verdict"] == "agree"
    assert found["blender"]["source"] == "picture" and found["blender"]["picture"] == name
    assert found["pixels"]["agree"] == found["pixels"]["total"] == 60 * 45
    assert f"agree with the picture '{name}'" in text
    assert [o["name"] for o in found["scene"]["objects"]] == ["Ball", "Box"]
    assert found["scene"]["objects"][1]["triangles"] == 12


def test_surfaces_in_other_colours_are_told_and_no_more_is_guessed(scene, against):
    """A picture with another camera, or with an object less, has a reason of its own."""
    color = render(scene).color
    told = "most surfaces are shown in other colours"
    lit = color.copy()
    lit[..., :3] *= np.linspace(0.3, 0.9, 60)[:, None]
    assert told in against(lit)[2]
    half = scene.instances[:1]
    for wrong in (replace(scene, instances=half), scene.seen_by(moved(scene.camera))):
        assert told not in against(render(wrong).color)[2]


def test_a_profile_of_the_pictures_is_named(scene, against):
    """A note of the comparison: its values were read by sRGB's curve all the same."""
    from PIL import Image, ImageCms

    profile = ImageCms.ImageCmsProfile(ImageCms.createProfile("LAB")).tobytes()
    rows = images.to_display(render(scene).color)[::-1]
    code, found, text = against(
        save=lambda path: Image.fromarray(rows).save(path, icc_profile=profile)
    )
    (note,) = found["scene"]["notes"]
    assert re.fullmatch(r"of the picture: its colour profile '.+' is not applied: .+", note)
    assert code == 0 and note in text


def test_a_student_who_forgot_the_curve_and_cut_off(scene, against):
    from PIL import Image

    color = render(scene).color
    flat = np.concatenate((np.floor(255 * color[..., :3]), 255 * color[..., 3:]), axis=-1)

    def save(path):
        Image.fromarray(flat[::-1].astype(np.uint8)).save(path)

    code, found, text = against(save=save)
    assert code == 1 and found["pixels"]["unexplained"] == 0
    assert found["transform"].startswith("sRGB's curve left out")
    assert found["pixels"]["by_cause"]["color"] > 250
    first = text.index(f"diagnosis: the picture's colours: {found['transform']}")
    assert text.index(f"what to do: {found['advice']}") < text.index("interior and")
    assert first < text.index(found["advice"])


def test_a_png_without_alpha(scene, against):
    from PIL import Image

    stored = images.to_display(render(scene).color)

    def save(path):
        Image.fromarray(stored[::-1, :, :3].copy()).save(path)

    assert against(save=save)[0] == 0


def test_few_bits_excuse_no_missing_object(make, against, tmp_path):
    """In one bit both greys are white, which is what is compared."""
    from PIL import Image

    quads = make.quad(-0.5, 0.5, -0.5, 0.5, -2), make.quad(-9, 9, -9, 9, -3)
    scene = make.scene(make.camera(24, 18), *quads)
    table = ([[g, g, g, 1]] for g in (0.8, 0.3))
    own = (replace(i, colors=c) for i, c in zip(scene.instances, table, strict=True))
    scene = replace(scene, instances=tuple(own))
    save_scene(tmp_path / "greys.npz", scene)
    white = Image.new("1", (24, 18), 1)
    code, found, _ = against(save=white.save, source="greys.npz")
    assert code == 2 and found["pixels"]["unexplained"] > 0.9 * 24 * 18


def test_half_transparent_colours_are_premultiplied_once(make, against, tmp_path):
    from PIL import Image

    scene = make.scene(
        make.camera(20, 16), make.quad(-0.5, 0.4, -0.4, 0.4, -2), background=(0.1, 0.05, 0.2, 0.5)
    )
    save_scene(tmp_path / "half.npz", scene)
    stored = images.to_display(render(scene).color)
    assert set(np.unique(stored[..., 3])) == {128, 255}
    back = images.open_picture(_saved(Image, stored, tmp_path / "half.png")).read()
    assert not back.opaque and back.levels == 255
    np.testing.assert_allclose(back.color, render(scene).color, atol=2 / 255)
    assert against(render(scene).color, "half2.png", source="half.npz")[0] == 0


def _saved(image, stored, path):
    image.fromarray(stored[::-1].copy()).save(path)
    return path


@pytest.mark.slow
def test_a_smoothed_picture_needs_its_filter(scene, against):
    from reference_tracer.tracer.settings import Settings

    color = render(scene, Settings(samples=4)).color
    assert against(color, "smooth.exr")[0] == 2
    code, found, _ = against(color, "smooth.exr", options=("--excuse", "filter=1"))
    assert code == 1 and found["pixels"]["unexplained"] == 0
    assert found["pixels"]["by_cause"]["anti_aliasing"] > 50
    assert found["blender"]["filter_radius"] == 1


def test_sizes_that_do_not_match(scene, against):
    code, found, text = against(render(scene).color[:-1])
    assert code == 3 and found["verdict"] == "failed"
    assert (
        "The picture has 60 x 44 pixels, the traced one 60 x 45. Render it at that size, or" in text
    )


def test_a_whole_picture_for_a_border(scene, against, tmp_path):
    """What lies outside the border is not compared."""
    camera = replace(scene.camera, region=Region(11, 6, 52, 41))
    save_scene(tmp_path / "border.npz", replace(scene, camera=camera))
    color = render(scene).color.copy()
    color[:6] = 1
    code, found, _ = against(color, source="border.npz")
    assert code == 0 and found["pixels"]["total"] == 41 * 35


def test_a_mesh_with_a_camera_of_the_command_line(against, tmp_path):
    trimesh.creation.box((1, 2, 1)).export(tmp_path / "box.ply")
    options = ("--set", "width=40", "height=30", "eye=4,3,2")
    arguments = ["trace", tmp_path / "box.ply", "--out", tmp_path / "box.png", *options]
    assert main([str(a) for a in arguments]) == 0
    code, found, _ = against(
        name="box.png", source="box.ply", save=lambda path: None, options=options
    )
    assert code == 0 and found["scene"]["evaluation"] == "FILE"


@pytest.mark.slow
def test_self_check_without_blender(scene, against):
    code, found, text = against(render(scene).color, "picture.exr", options=("--self-check",))
    assert code == 0 and re.search(r"self-check: (\d\d) of \1 faults", text)
    assert {row["result"] for row in found["self_check"]} == {"caught", "cannot be seen here"}


@pytest.mark.parametrize(
    ("name", "content", "message"),
    [
        ("none.png", None, "there is no file"),
        ("text.png", b"no picture", "is no .png"),
        ("text.exr", b"no picture", "is no .exr"),
        ("picture.jpg", b"", "must be .png or .exr"),
    ],
)
def test_what_is_no_picture_is_said(against, tmp_path, name, content, message):
    def save(path):
        if content is not None:
            path.write_bytes(content)

    code, found, text = against(name=name, save=save)
    assert code == 4 and found["verdict"] == "failed" and message in text


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (("--judge", "cycles"), "--judge is for Blender's picture"),
        (("--as-is",), "--as-is is for Blender's picture"),
        (("--excuse", "filter=-1"), "at least 0"),
        (("--excuse", "filter=nan"), "at least 0"),
        (("--set", "eye=1,2,3"), "has its own camera"),
    ],
)
def test_options_that_do_not_fit(scene, against, options, message):
    code, found, text = against(render(scene).color, options=options)
    assert code == 4 and message in text
    assert found is None  # nothing is written


def test_a_filter_needs_a_picture(tmp_path, capsys):
    """Or an engine that is named: that is said before the file is opened."""
    for judge in ((), ("--judge", "workbench"), ("--judge", "auto")):
        options = *judge, "--excuse", "filter=1", "--out", str(tmp_path)
        assert main(["compare", str(tmp_path / "a.blend"), *options]) == 4
        assert "--excuse filter is for a picture of --against" in capsys.readouterr().err


@pytest.mark.slow
def test_whose_rounding_excuses_is_chosen_and_said(make, against, tmp_path):
    """The farther of two walls: a depth buffer may show it, rays may not."""
    camera = make.camera(24, 18, clip_start=0.001, clip_end=1e4)
    walls = make.scene(camera, *(make.quad(-300, 300, -300, 300, z) for z in (-900, -900.1)))
    save_scene(tmp_path / "walls.npz", walls)
    color = render(replace(walls, instances=walls.instances[1:])).color
    code, found, text = against(color, "far.exr", source="walls.npz")
    assert code == 2 and found["blender"]["renderer"] == "rays"
    assert "by the rounding of float32 rays" in text
    options = ("--excuse", "renderer=raster")
    code, found, text = against(color, "far.exr", source="walls.npz", options=options)
    assert code == 1 and found["blender"]["renderer"] == "raster"
    assert found["pixels"]["unexplained"] == 0 and found["excused"]["share"] > 0.02
    assert "float32 rasterisation with a depth buffer of 24 bits" in text


def test_a_mesh_says_in_which_colours_and_from_where_it_is_to_be_drawn(tmp_path, capsys):
    """Its colours are written without a picture; then only the camera is left to be named."""
    (tmp_path / "two.obj").write_text(
        "o A\nv -1 0 0\nv 1 0 0\nv 0 2 0\nf 1 2 3\no B\nv -1 0 1\nv 1 0 1\nv 0 -2 1\nf 4 5 6\n"
    )
    mesh, colors = str(tmp_path / "two.obj"), str(tmp_path / "colors.json")
    out = ["--out", str(tmp_path / "out")]
    assert main(["compare", mesh, "--colors", "object", "--colors-out", colors]) == 0
    assert sorted(p.name for p in tmp_path.iterdir()) == ["colors.json", "two.obj"]
    wanted = {
        o["name"]: o["slots"][0]["linear"]
        for o in json.loads(Path(colors).read_text(encoding="utf-8"))["objects"]
    }
    assert len({tuple(color) for color in wanted.values()}) == len(wanted) == 2
    eye = ["--set", "eye=4,-5,3"]
    for camera, is_placed in ((eye, False), ([], True)):
        size = [*camera, "--set", "width=64", "height=36"]
        picture = str(tmp_path / "picture.png")
        main(["trace", mesh, *size, "--out", picture])
        capsys.readouterr()
        main(["compare", mesh, *size, "--against", picture, "--no-diagnosis", *out])
        assert ("eye=, target= and angle= say" in capsys.readouterr().out) == is_placed


def test_what_a_file_says_of_unknown_colours_excuses_none_that_are_given(scene, tmp_path, capsys):
    """Of glass the colour is not known; drawn in a palette it is."""
    glass = Unmodelled("Box", "transparency", effect=Effect.COLOR)
    manifest = Manifest("a", "a", "", 0, "FILE", "", unmodelled=(glass,))
    save_scene(tmp_path / "scene.npz", scene, manifest)
    argv = [
        "compare",
        str(tmp_path / "scene.npz"),
        "--no-diagnosis",
        "--out",
        str(tmp_path / "out"),
    ]
    argv += ["--against", str(tmp_path / "picture.png")]
    for colors, verdict in (("viewport", "warnings"), ("object", "differences")):
        shown, _ = in_colors(scene, By(colors))
        frame = render(shown)
        color = frame.color.copy()
        color[frame.object_index == scene.objects.index("Box")] = (0.3, 0.9, 0.2, 1)
        images.save_png(tmp_path / "picture.png", images.to_display(color))
        main([*argv, "--colors", colors])
        assert f"verdict: {verdict}" in capsys.readouterr().out
