"""An animation compared frame by frame: resumed, the worst first, simulations stepped in order."""

from __future__ import annotations

import json
import re
from dataclasses import replace

import bpy
import numpy as np
import pytest
from reference_tracer.blender.jobs import compare as compare_module
from reference_tracer.blender.jobs.cameras import cameras
from reference_tracer.blender.reading.camera import export_camera
from reference_tracer.blender.ui import results
from reference_tracer.blender.ui.results import Kind
from reference_tracer.camera_files.convention import View
from reference_tracer.camera_files.files import CONVENTIONS, texts
from reference_tracer.camera_files.frame import part
from reference_tracer.cli import in_blender
from reference_tracer.scene import Region

from . import hard_cases as hard
from .test_hard_cases import own_picture

SIZE = 48, 27


@pytest.fixture
def moving(build, tmp_path):
    """A saved scene in which a cube moves, and another is see-through at frame 3 alone."""
    scene = build.scene(*SIZE)
    build.camera()
    cube = build.cube(material=build.material("Red", 0.8, 0.1, 0.1))
    glass = build.material("Glass", 0.1, 0.2, 0.9)
    build.cube("Glass", 1.0, location=(0, 0, 1.5), material=glass)
    for frame, x in ((1, -1.0), (4, 1.0)):
        cube.location.x = x
        cube.keyframe_insert("location", frame=frame)
    for frame, alpha in ((2, 1.0), (3, 0.5), (4, 1.0)):
        glass.diffuse_color[3] = alpha
        glass.keyframe_insert("diffuse_color", frame=frame)
    scene.frame_start, scene.frame_end = 1, 4
    save(tmp_path)
    return scene


def save(tmp_path) -> None:
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "moving.blend"))


@pytest.fixture
def out(tmp_path):
    return tmp_path / "out"


@pytest.fixture
def run(out):
    """Compare frames of the open file, as the command does; returns the exit code."""

    def command(frames: str, *options: str) -> int:
        given = ["--out", str(out), f"--frames={frames}", "--no-identity", *options]
        return in_blender.run(["compare", *given])

    return command


def done(out) -> dict[int, tuple[int, int]]:
    """Which files the frames' comparisons are: one that is done again is another."""
    paths = sorted(out.glob("frame_*/comparison.json"))
    stats = {int(path.parent.name.removeprefix("frame_")): path.stat() for path in paths}
    return {frame: (s.st_ino, s.st_mtime_ns) for frame, s in stats.items()}


def table(out) -> dict:
    return json.loads((out / "animation.json").read_text(encoding="utf-8"))


def test_the_worst_frame_is_first_and_its_code_the_exit_code(moving, run, out, capsys):
    assert run("all") == 1
    printed, meanwhile = capsys.readouterr()
    found = table(out)
    assert found["frames"][0]["frame"] == 3
    assert {row["frame"]: row["verdict"] for row in found["frames"]} == {
        1: "agree",
        2: "agree",
        3: "warnings",
        4: "agree",
    }
    assert found["verdict"] == "warnings" and found["asked_for"] == [1, 4, 1]
    for row in found["frames"]:
        own = json.loads((out / f"frame_{row['frame']:04d}" / "comparison.json").read_text())
        assert own["scene"]["frame"] == row["frame"]
        assert own["pixels"]["agree"] == row["agree"]
        assert own["pixels"]["differ"] == row["explained"] + row["unexplained"]
    told = re.findall(
        r"^frame (\d): agree [\d,]+ / explained [\d,]+ / unexplained 0$", meanwhile, re.M
    )
    assert told == ["1", "2", "3", "4"]
    assert printed.splitlines()[-3:][0] == "verdict: warnings"


def test_only_what_is_missing_is_done_again(moving, run, out):
    """A frame is whole with all its files, and for the same file and options."""

    def again(frames: str, *options: str) -> set[int]:
        before = done(out)
        run(frames, *options)
        return {frame for frame, file in done(out).items() if before.get(frame) != file}

    assert again("1-3:2") == {1, 3}
    assert again("all") == {2, 4}
    assert again("all") == set()
    (out / "frame_0002" / "traced.png").unlink()
    (out / "frame_0003" / "comparison.json").write_text("{}")
    assert again("1-4") == {2, 3}
    assert again("1-2", "--method", "textbook") == {1, 2}
    assert [row["frame"] for row in table(out)["frames"]] == [1, 2]  # no more are of these options
    assert again("all") == {1, 2}
    assert again("2", "--identity") == {2}
    save(out.parent)
    assert again("3-4") == {3, 4}
    assert [row["frame"] for row in table(out)["frames"]] == [3, 4]


@pytest.mark.parametrize("kind", ["cache_files", "images"])
def test_a_frame_is_done_again_if_a_file_that_it_uses_is_another(kind, moving, run, out):
    path = out.parent / "used.abc"
    path.write_bytes(b"1")
    if kind == "images":
        bpy.data.images.new("Used", 1, 1).source = "FILE"
        bpy.data.images["Used"].filepath = str(path)
    else:
        bpy.ops.cachefile.open(filepath=str(path))
    [block] = getattr(bpy.data, kind)
    block.use_fake_user = True
    save(out.parent)
    run("1")
    before = done(out)
    run("1")
    assert done(out) == before
    path.write_bytes(b"12")
    run("1")
    assert done(out) != before


@pytest.fixture
def seen_by(moving, out):
    """Write transforms.json: a camera a name, each of a width of its own, so that one tells it."""
    own = export_camera(moving)

    def write(*names: str) -> str:
        regions = [Region(0, 0, 24 + 4 * k, own.height) for k in range(len(names))]
        cameras = [part(replace(own, region=region)) for region in regions]
        views = [View(c, name) for c, name in zip(cameras, names, strict=True)]
        path = out.parent / "transforms.json"
        path.write_text(texts(views, CONVENTIONS["nerf"])[""], encoding="utf-8")
        return str(path)

    return write


def widths(out) -> list[int]:
    """Of the frames' pictures, whose height is that of the scene's."""
    paths = sorted(out.glob("frame_*/comparison.json"))
    found = [json.loads(path.read_text("utf-8")) for path in paths]
    return [one["pixels"]["total"] // SIZE[1] for one in found]


def test_each_frame_is_seen_by_its_own_camera_of_a_file(moving, run, out, seen_by):
    """Its number is its image's; and a frame whose camera is another is done again."""
    options = "--judge", "workbench", "--camera"
    assert run("1-2", *options, seen_by("r_0.png", "r_1.png", "r_2.png")) == 0
    assert widths(out) == [28, 32]
    before = done(out)
    assert run("1-2", *options, seen_by("r_2.png", "r_1.png", "r_3.png")) == 0
    assert widths(out) == [28, 24]
    assert [frame for frame, file in done(out).items() if before[frame] != file] == [2]
    assert not any("transforms" in c.name or "r_" in c.name for c in bpy.data.cameras)


@pytest.mark.parametrize(
    ("names", "said"),
    [
        (("r_1.png", "r_3.png"), "no camera for frame 2; there are r_1.png, r_3.png"),
        (("a1.png", "b1.png"), "2 cameras for frame 1; there are a1.png, b1.png"),
        (("a.png", "b.png", "c.png"), "3 cameras without numbers for 2 frames"),
    ],
)
def test_a_frame_without_its_camera_is_refused_by_name(
    names, said, moving, run, out, seen_by, capsys
):
    assert run("1-2", "--camera", seen_by(*names)) == 4
    assert said in capsys.readouterr().err and not list(out.glob("frame_*"))


def test_cameras_without_numbers_are_those_of_the_frames_in_order(moving, run, out, seen_by):
    run("2-3", "--camera", seen_by("left.png", "right.png"))
    assert widths(out) == [24, 28]


def test_no_camera_is_said_once(moving, run, out, capsys):
    moving.camera = None
    assert run("1-4") == 4
    said, told = capsys.readouterr()
    assert told.count("has no camera") == 1 and "camera" not in said
    assert not out.exists() or not list(out.iterdir())


@pytest.mark.parametrize("judge", ["RENDER_RESULT", "IMAGE"])
def test_a_still_is_not_held_against_every_frame(judge, moving, run, out, capsys, tmp_path):
    assert bpy.ops.reference_tracer.compare_animation.poll()
    moving.reference_tracer.judge = judge
    assert not bpy.ops.reference_tracer.compare_animation.poll()
    save(tmp_path)
    assert run("all") == 4
    assert "is of one frame" in capsys.readouterr().err
    assert not out.exists()


def test_an_interruption_keeps_what_is_done(moving, run, out, monkeypatch, capsys):
    def interrupted(frame: int) -> None:
        if frame == 3:
            raise KeyboardInterrupt

    changed_at(monkeypatch, interrupted)
    assert run("1-4") == 130
    assert "the same command goes on from there" in capsys.readouterr().err
    assert moving.frame_current == 1
    assert [row["frame"] for row in table(out)["frames"]] == list(done(out)) == [1, 2]
    monkeypatch.undo()
    before = done(out)
    assert run("1-4") == 1
    assert done(out).items() > before.items() and len(done(out)) == 4


def changed_at(monkeypatch, change) -> None:
    """Have Blender's picture of each frame go through a function of its number."""
    real = compare_module._picture

    def changed(pixels, **options):
        other = change(bpy.context.scene.frame_current)
        return real(np.ascontiguousarray(other(pixels)) if other else pixels, **options)

    monkeypatch.setattr(compare_module, "_picture", changed)


def test_differences_and_failures_are_worse_than_warnings(moving, run, out, monkeypatch, capsys):
    wrong = {2: lambda drawn: drawn[::-1] * np.float32(0.9)}
    changed_at(monkeypatch, wrong.get)
    assert run("1-4") == 2
    assert [row["frame"] for row in table(out)["frames"]] == [2, 3, 1, 4]
    camera = moving.camera
    for frame, size in ((3, 1.0), (4, 0.0)):
        camera.scale = (size, size, size)
        camera.keyframe_insert("scale", frame=frame)
    save(out.parent)
    assert run("1-4") == 4
    assert [row["frame"] for row in table(out)["frames"]] == [4, 2, 3, 1]
    error = table(out)["frames"][0]["error"]
    assert "Camera" in error and f"frame 4: {error}" in capsys.readouterr().err
    kept = out / "frame_0004"
    assert error not in (kept / "comparison.json").read_text()  # its earlier results stay
    assert not (kept / "made_by.json").exists()
    assert table(out)["verdict"] == "failed"


SIMULATED = hard.particles_of_collection, hard.simulation_zone, hard.rigid_body


@pytest.mark.parametrize("make", SIMULATED)
def test_simulations_are_stepped_in_order(make, build, run, out, tmp_path):
    """A frame shows what the scene does once it is played up to there, also when resumed."""
    make(build)
    bpy.context.scene.frame_set(1)
    bpy.context.scene.render.resolution_x, bpy.context.scene.render.resolution_y = SIZE
    save(tmp_path)

    def opened(*frames: int) -> None:
        bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "moving.blend"))
        for frame in frames:
            bpy.context.scene.frame_set(frame)

    opened(10)
    at_once = own_picture()
    opened(*range(1, 11))
    expected = own_picture()
    assert (at_once != expected).any()
    for redone in ({3, 10}, {10}):
        opened()
        before = done(out)
        assert run("3-10:7") == 0
        assert {f for f, file in done(out).items() if before.get(f) != file} == redone
        found = np.load(out / "frame_0010" / "frame.npz")["blender"]
        np.testing.assert_array_equal(found, expected)
        (out / "frame_0010" / "made_by.json").unlink()
    # A copy of the scene cannot have the second frame of rigid bodies: that is said.
    assert run("2") == (make is hard.rigid_body)


def test_the_operator_goes_back_to_the_users_frame(moving, out):
    """And leaves what was moved but not keyed; all is compared anew, as it may have changed."""
    moving.frame_set(2)
    cube = bpy.data.objects["Cube"]
    cube.location.x = 0.25
    for _ in range(2):
        before = done(out)
        assert bpy.ops.reference_tracer.compare_animation(directory=str(out)) == {"FINISHED"}
        assert moving.frame_current == 2 and cube.location.x == 0.25
        assert not before.items() & done(out).items() and len(done(out)) == 4
    path, rows = results.latest(Kind.FRAMES, moving).content
    assert path == out / "animation.html" and rows[0].frame == 3


def test_each_frame_is_traced_as_it_is_by_itself(moving, tmp_path, capsys):
    """Pictures, all passes and masks, under the names that `camera --frames` gives them."""
    files = (("--out", "png"), ("--out", "exr"), ("--certificate", "npz"))
    wanted = [w for o, end in files for w in (o, str(tmp_path / f"all/####.{end}"))]
    masks = str(tmp_path / "masks/####")
    assert in_blender.run(["trace", "--frames", "2-4:2", *wanted, "--masks", masks]) == 0
    assert bpy.context.scene.frame_current == 1
    for frame in (2, 4):
        moving.frame_set(frame)
        alone = [w for o, end in files for w in (o, str(tmp_path / f"one/{frame:04d}.{end}"))]
        own = str(tmp_path / f"own/{frame:04d}")
        assert in_blender.run(["trace", *alone, "--masks", own]) == 0
    for found, single in (("all", "one"), ("masks", "own")):
        names = {p.relative_to(tmp_path / found) for p in (tmp_path / found).rglob("*.*")}
        assert names == {p.relative_to(tmp_path / single) for p in (tmp_path / single).rglob("*.*")}
        assert len(names) == 6
        for name in names:
            assert (tmp_path / found / name).read_bytes() == (tmp_path / single / name).read_bytes()
    moving.frame_set(1)
    named = [camera.view.name for camera in cameras([2, 4])]
    assert named == ["0002.png", "0004.png"]


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (("--out", "picture.png"), "needs a number, as in ####.png"),
        (("--out", "####.png", "--set", "frame=2"), "--set frame is for one frame"),
        (("--out", "####.png", "--frames", "4-1"), "ends before it begins"),
    ],
)
def test_frames_that_are_none(moving, capsys, options, said):
    assert in_blender.run(["trace", "--frames", "1-2", *options]) == 4
    assert said in capsys.readouterr().err
