"""The command line on files that need no Blender."""

from __future__ import annotations

import argparse
import json
import multiprocessing
import signal
import subprocess
import sys
from contextlib import contextmanager, suppress

import numpy as np
import OpenEXR
import pytest
import trimesh
from PIL import Image
from reference_tracer import __version__, images, interrupts
from reference_tracer.arguments import AGREE, INPUT_ERROR, INTERRUPTED, settings_from
from reference_tracer.cli import main
from reference_tracer.commands import trace as trace_command
from reference_tracer.scene import SceneError
from reference_tracer.scene_files import save_scene
from reference_tracer.study import extremes, tradeoff
from reference_tracer.tracer import certainty
from reference_tracer.tracer.progress import result_of
from reference_tracer.tracer.settings import Settings

SMALL = ["--width", "24", "--height", "16"]


@pytest.fixture
def ball(tmp_path):
    path = tmp_path / "ball.ply"
    trimesh.creation.icosphere(2, radius=1.0).export(path)
    return path


def channels(path):
    with OpenEXR.File(str(path), separate_channels=True) as file:
        return {name: c.pixels[::-1] for name, c in file.channels().items()}


def trace(path, out, *options):
    return main(["trace", str(path), "--out", str(out), *SMALL, *options])


def test_mesh_to_png(ball, tmp_path, capsys):
    assert trace(ball, tmp_path / "new" / "ball.png") == AGREE
    picture = np.asarray(Image.open(tmp_path / "new" / "ball.png"))
    assert picture.shape == (16, 24, 4)
    assert picture[8, 12, 3] == 255 and picture[0, 0, 3] == 0
    assert "24 x 16 pixels, 320 triangles" in capsys.readouterr().out


@pytest.mark.parametrize("suffix", ["obj", "stl", "glb"])
def test_other_meshes(suffix, tmp_path):
    trimesh.creation.box().export(tmp_path / f"box.{suffix}")
    assert trace(tmp_path / f"box.{suffix}", tmp_path / "box.png") == AGREE
    assert np.asarray(Image.open(tmp_path / "box.png"))[8, 12, 3] == 255


def test_eye_target_angle(ball, tmp_path):
    """Seen from 2 radii, a sphere fills the cone of 30 degrees around the axis."""
    half = np.degrees(np.arctan(np.tan(np.radians(30)) * 1.25))
    assert (
        trace(ball, tmp_path / "b.exr", "--eye", "0", "-2", "0", "--angle", str(2 * half)) == AGREE
    )
    depth = channels(tmp_path / "b.exr")["depth.V"]
    assert depth[7:9, 11:13].min() == pytest.approx(1, abs=0.03)
    rows = np.flatnonzero(np.isfinite(depth).any(axis=1))
    assert (rows.min(), rows.max()) in ((1, 14), (2, 13))  # 16 rows / 1.25, less the corners cut


def test_target_and_up(ball, tmp_path):
    """Looking past the ball to its right and above, one sees it at the left and below."""
    assert (
        trace(ball, tmp_path / "b.exr", "--eye", "0", "-5", "0", "--target", "1", "0", "0.7")
        == AGREE
    )
    y, x = np.nonzero(np.isfinite(channels(tmp_path / "b.exr")["depth.V"]))
    assert x.mean() < 11 and y.mean() < 7


def test_ortho_scale(ball, tmp_path):
    assert trace(ball, tmp_path / "b.exr", "--eye", "0", "0", "5", "--ortho-scale", "4") == AGREE
    found = channels(tmp_path / "b.exr")
    seen = np.isfinite(found["depth.V"])
    assert seen.any(axis=0).sum() == seen.any(axis=1).sum() == 8  # the height, 4 m, is 16 pixels
    assert found["position.Z"][seen] == pytest.approx(5 - found["depth.V"][seen], abs=1e-5)


def test_exr_holds_the_passes(ball, tmp_path):
    assert (
        trace(ball, tmp_path / "b.exr", "--method", "moller_trumbore", "--precision", "float32")
        == 0
    )
    found = channels(tmp_path / "b.exr")
    seen = found["object_index.V"] == 0
    assert seen.any() and not seen.all()
    assert (found["triangle_index.V"][seen] >= 0).all() and (
        found["triangle_index.V"][~seen] == -1
    ).all()
    weights = sum(found[f"barycentrics.{x}"] for x in "XYZ")
    assert weights[seen] == pytest.approx(1, abs=1e-5)
    assert np.isinf(found["depth.V"][~seen]).all()


def test_npz_keeps_its_camera(make, tmp_path):
    scene = make.scene(make.camera(10, 6), make.quad(-9, 0, -9, 9, -2))
    save_scene(tmp_path / "s.npz", scene)
    assert main(["trace", str(tmp_path / "s.npz"), "--out", str(tmp_path / "s.png")]) == AGREE
    alpha = np.asarray(Image.open(tmp_path / "s.png"))[..., 3]
    assert alpha.shape == (6, 10)
    assert (alpha[:, :5] == 255).all() and (alpha[:, 5:] == 0).all()


def test_samples_are_shown(ball, tmp_path):
    assert trace(ball, tmp_path / "b.png", "--samples", "3") == AGREE
    alpha = np.asarray(Image.open(tmp_path / "b.png"))[..., 3]
    assert set(np.unique(alpha)) - {0, 255}


@pytest.mark.parametrize("method", ["auto", "textbook"])
def test_processes_make_the_same_picture(method, ball, tmp_path, capsys):
    for count in ("1", "2"):
        options = ["--method", method, "--processes", count]
        assert trace(ball, tmp_path / f"{count}.exr", *options) == AGREE
    one, two = (channels(tmp_path / f"{count}.exr") for count in "12")
    assert one.keys() == two.keys()
    assert all(np.array_equal(one[name], two[name]) for name in one)
    said = capsys.readouterr().out.splitlines()
    assert said[0].split(" pixels, ")[0] == said[len(said) // 2].split(" pixels, ")[0] == "24 x 16"


def test_interrupted_processes(ball, tmp_path, monkeypatch, capsys):
    @contextmanager
    def bar():
        yield lambda share: share > 0 and signal.raise_signal(signal.SIGINT)

    monkeypatch.setattr(trace_command, "progress_bar", bar)
    before = set(multiprocessing.active_children())
    options = ["--processes", "2", "--samples", "8"]
    assert trace(ball, tmp_path / "new" / "b.png", *options) == INTERRUPTED
    assert capsys.readouterr().err == "reftrace: interrupted\n"
    assert not (tmp_path / "new").exists()
    assert set(multiprocessing.active_children()) <= before


@pytest.mark.parametrize("method, came_to", [("auto", "certified"), ("certified", "certified")])
def test_certified_says_what_the_scene_required(method, came_to, ball, tmp_path, capsys):
    assert trace(ball, tmp_path / "b.exr", "--method", method) == AGREE
    said = capsys.readouterr().out.splitlines()
    assert f"({came_to}, float64)" in said[0]
    assert len(said) > 1 and "pairs" in said[1]
    found = channels(tmp_path / "b.exr")["certainty.V"]
    assert (found > 0).all()


def test_plain_methods_require_nothing(ball, tmp_path, capsys):
    assert trace(ball, tmp_path / "b.exr", "--method", "watertight") == AGREE
    said = capsys.readouterr().out.splitlines()
    assert len(said) == 1 and "(watertight, float64)" in said[0]


@pytest.mark.parametrize("method", ["certified", "auto"])
def test_certified_in_float32_is_refused(method, ball, tmp_path, capsys):
    options = ["--method", method, "--precision", "float32"]
    assert trace(ball, tmp_path / "b.png", *options) == INPUT_ERROR
    said = capsys.readouterr().err
    assert "float64 only" in said and "watertight" in said and "Traceback" not in said
    assert not (tmp_path / "b.png").exists()


@pytest.fixture
def broken_arithmetic(monkeypatch):
    monkeypatch.setattr(certainty, "broken_assumptions", lambda: ["subnormal results"])


@pytest.mark.usefixtures("broken_arithmetic")
def test_a_machine_that_cannot_certify_says_so(ball, tmp_path, capsys):
    assert trace(ball, tmp_path / "b.png", "--method", "certified") == INPUT_ERROR
    assert main(["trade", str(ball)]) == INPUT_ERROR
    said = capsys.readouterr().err
    assert said.count("subnormal results") == 2 and "Traceback" not in said
    assert not (tmp_path / "b.png").exists()


@pytest.mark.usefixtures("broken_arithmetic")
def test_auto_falls_back_and_says_so(ball, tmp_path, capsys):
    assert trace(ball, tmp_path / "b.png") == AGREE
    said = capsys.readouterr().out
    assert "(watertight, float64)" in said and "subnormal results" in said


@pytest.fixture
def small_ball(tmp_path):
    trimesh.creation.icosphere(1).export(tmp_path / "small.ply")
    return str(tmp_path / "small.ply")


TRADE = ["--width", "12", "--height", "8", "--samples", "2"]


def test_trade(small_ball, tmp_path, capsys):
    assert main(["trade", small_ball, *TRADE, "--out", str(tmp_path / "new" / "out")]) == AGREE
    said = capsys.readouterr().out
    lines = said.splitlines()
    assert "wrong pixels" in lines[0] and "12 x 8 pixels, 2 x 2 rays each" in lines
    assert "certified, proven to have none" in said and lines[-1].startswith("written to")
    written = sorted(p.name for p in (tmp_path / "new" / "out").iterdir())
    assert written == ["tradeoff.json", "tradeoff.png", "tradeoff.txt"]
    held = json.loads((tmp_path / "new" / "out" / "tradeoff.json").read_text(encoding="utf-8"))
    assert held["scene"] == "small.ply" and max(r["samples"] for r in held["rows"]) == 2
    assert held["advice"] in said


def test_trade_without_out_only_prints(small_ball, tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    before = sorted(tmp_path.rglob("*"))
    assert main(["trade", small_ball, *TRADE]) == AGREE
    assert "wrong pixels" in capsys.readouterr().out
    assert sorted(tmp_path.rglob("*")) == before


def without(module, *argv):
    """Run `reftrace` in a process of its own, in which a module is not there."""
    code = (
        f"import sys; sys.modules[{module!r}] = None; "
        "from reference_tracer.cli import main; sys.exit(main(sys.argv[1:]))"
    )
    return subprocess.run([sys.executable, "-c", code, *argv], capture_output=True, text=True)


def test_trade_without_matplotlib(small_ball, tmp_path):
    """The table and the JSON are there all the same."""
    done = without("matplotlib", "trade", small_ball, *TRADE, "--out", str(tmp_path / "out"))
    assert done.returncode == AGREE, done.stderr
    assert "pip install 'reference_tracer[plots]'" in done.stderr
    assert "Traceback" not in done.stderr and "wrong pixels" in done.stdout
    written = sorted(p.name for p in (tmp_path / "out").iterdir())
    assert written == ["tradeoff.json", "tradeoff.txt"]


@pytest.mark.parametrize(
    "options, word",
    [
        (["--samples", "0"], "samples is 0"),
        (["--samples", "65"], "samples is 65"),
        (["--width", "0"], "--width is 0; it must be at least 1"),
        (["--out", "small.ply"], "cannot write to the folder 'small.ply': it is a file"),
    ],
)
def test_trade_of_bad_input(options, word, small_ball, tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    argv = ["trade", small_ball, *TRADE, *options]
    assert main(argv) == INPUT_ERROR
    said = capsys.readouterr().err
    assert word in said and "Traceback" not in said


def test_trade_takes_the_width_of_a_scene(make, tmp_path, capsys):
    """A scene has its own camera, but how wide its picture is can be chosen."""
    save_scene(tmp_path / "s.npz", make.scene(make.camera(10, 6), make.quad(-9, 0, -9, 9, -2)))
    assert main(["trade", str(tmp_path / "s.npz"), "--samples", "1"]) == AGREE
    assert "10 x 6 pixels, one ray each" in capsys.readouterr().out
    assert main(["trade", str(tmp_path / "s.npz"), "--samples", "1", "--width", "20"]) == AGREE
    assert "20 x 12 pixels, one ray each" in capsys.readouterr().out
    assert main(["trade", str(tmp_path / "s.npz"), "--height", "9"]) == INPUT_ERROR
    said = capsys.readouterr().err
    assert "--height is for meshes" in said and "--width sets the size of its picture" in said


def test_trade_help_says_whose_the_width_is(capsys):
    with pytest.raises(SystemExit):
        main(["trade", "--help"])
    before, after = capsys.readouterr().out.split("camera of a mesh")
    assert "width of the largest picture" in before and "--width" not in after


def test_trade_of_nothing(make, tmp_path, capsys):
    save_scene(tmp_path / "s.npz", make.scene(make.camera(10, 6)))
    out = ["--samples", "1", "--out", str(tmp_path / "out")]
    assert main(["trade", str(tmp_path / "s.npz"), *out]) == AGREE
    assert "Nothing is seen" in capsys.readouterr().out
    held = json.loads((tmp_path / "out" / "tradeoff.json").read_text(encoding="utf-8"))
    assert {r["largest_t_error"] for r in held["rows"]} == {None}


def refuse_memory(*args, **options):
    raise MemoryError("Unable to allocate 1 TiB")


def test_too_little_memory_is_one_line(ball, tmp_path, capsys, monkeypatch):
    monkeypatch.setattr(trace_command, "render_with", refuse_memory)
    assert trace(ball, tmp_path / "new" / "b.png") == INPUT_ERROR
    said = capsys.readouterr().err
    assert said.count("\n") == 1 and "choose a smaller size" in said and "1 TiB" in said
    assert not (tmp_path / "new").exists()


def swallow(*args, **options):
    """Be interrupted where nobody hears it, as in a callback of Blender's."""
    with suppress(KeyboardInterrupt):
        signal.raise_signal(signal.SIGINT)
    yield 0.5
    pytest.fail("the work went on")


@pytest.fixture
def interrupted_work(monkeypatch):
    monkeypatch.setattr(extremes, "measure", swallow)
    monkeypatch.setattr(tradeoff, "measure", swallow)
    monkeypatch.setattr(
        trace_command, "render_with", lambda *given: result_of(swallow(), given[-1])
    )


@pytest.mark.usefixtures("interrupted_work")
@pytest.mark.parametrize("command", ["trace", "trade", "extremes"])
def test_interrupted(command, ball, tmp_path, capsys):
    before = sorted(tmp_path.rglob("*"))
    out = tmp_path / "new" / ("x.png" if command == "trace" else "out")
    scene = [] if command == "extremes" else [str(ball)]
    assert main([command, *scene, "--out", str(out)]) == INTERRUPTED == 130
    assert capsys.readouterr().err.strip().splitlines()[-1] == "reftrace: interrupted"
    assert sorted(tmp_path.rglob("*")) == before
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler


def test_interrupted_while_writing(ball, tmp_path, monkeypatch):
    """The older picture is whole."""
    assert trace(ball, tmp_path / "b.png") == AGREE
    before = {p: p.read_bytes() for p in tmp_path.iterdir()}

    def half(path, picture):
        path.write_bytes(b"half")
        signal.raise_signal(signal.SIGINT)

    monkeypatch.setattr(images, "save_png", half)
    assert trace(ball, tmp_path / "b.png", "--method", "textbook_literal") == INTERRUPTED
    assert {p: p.read_bytes() for p in tmp_path.iterdir()} == before


def test_what_is_held_comes_at_its_end():
    steps = []
    with pytest.raises(KeyboardInterrupt), interrupts.heard():
        with interrupts.held():
            signal.raise_signal(signal.SIGINT)
            steps.append("inside")
        steps.append("after")
    assert steps == ["inside"]
    with interrupts.heard():
        interrupts.check()  # of an earlier one nothing is left


@pytest.fixture
def one_scenario(monkeypatch):
    real, some = extremes.measure, extremes.ALL[:1]
    monkeypatch.setattr(extremes, "measure", lambda rays: real(some, rays, judged=1))


@pytest.mark.usefixtures("one_scenario")
def test_extremes(tmp_path, capsys):
    assert main(["extremes", "--out", str(tmp_path / "out"), "--rays", "40"]) == AGREE
    said = capsys.readouterr().out
    assert "certified" in said and "First scale" in said
    written = {p.name for p in (tmp_path / "out").iterdir()}
    assert {"extremes.json", "extremes.txt", "breaking_points.png"} <= written
    held = json.loads((tmp_path / "out" / "extremes.json").read_text(encoding="utf-8"))
    assert {r["method"] for r in held["rows"]} >= {"certified", "watertight", "textbook"}


@pytest.mark.usefixtures("one_scenario")
def test_extremes_without_matplotlib(tmp_path, capsys, monkeypatch):
    monkeypatch.setitem(sys.modules, "matplotlib.figure", None)
    assert main(["extremes", "--out", str(tmp_path / "out"), "--rays", "40"]) == AGREE
    assert "reference_tracer[plots]" in capsys.readouterr().err
    written = sorted(p.name for p in (tmp_path / "out").iterdir())
    assert written == ["extremes.json", "extremes.txt"]


def test_extremes_needs_rays(tmp_path, capsys):
    assert main(["extremes", "--out", str(tmp_path / "out"), "--rays", "0"]) == INPUT_ERROR
    assert "--rays is 0" in capsys.readouterr().err and not (tmp_path / "out").exists()


BAD = {
    "no file": (["none.ply"], "none.ply"),
    "other suffix": (["words.txt"], "words.txt"),
    "empty mesh": (["empty.obj"], "empty.obj"),
    "no scene": (["empty.npz"], "empty.npz"),
    "same point": (["ball.ply", "--eye", "1", "2", "3", "--target", "1", "2", "3"], "--target"),
    "angle 180": (["ball.ply", "--eye", "0", "0", "5", "--angle", "180"], "--angle"),
    "angle not a number": (["ball.ply", "--eye", "0", "0", "5", "--angle", "nan"], "--angle"),
    "no eye": (["ball.ply", "--eye", "nan", "0", "5"], "--eye"),
    "ortho scale 0": (["ball.ply", "--eye", "0", "0", "5", "--ortho-scale", "0"], "--ortho-scale"),
    "ortho scale below 0": (
        ["ball.ply", "--eye", "0", "0", "5", "--ortho-scale", "-1"],
        "orthographic scale",
    ),
    "width 0": (["ball.ply", "--width", "0"], "--width is 0; it must be at least 1"),
    "height below 0": (["ball.ply", "--height", "-5"], "--height is -5; it must be at least 1"),
    "no process": (["ball.ply", "--processes", "0"], "--processes is 0; it must be at least 1"),
    "samples": (["ball.ply", "--samples", "0"], "--samples is 0; it must be between 1 and 64"),
    "options before the scene": (["none.ply", "--samples", "65"], "--samples is 65"),
    "float32 of auto": (["none.ply", "--precision", "float32"], "reftrace: name a --method with"),
    "float32 of certified, whatever is stored": (
        ["none.blend", "--precision", "float32", "--method", "certified"],
        "reftrace: leave out --precision float32, or name another --method",
    ),
    "unknown method": (["ball.ply", "--method", "magic"], "--method"),
    "not a number": (["ball.ply", "--width", "many"], "--width"),
    "out suffix": (["ball.ply", "--out", "x.jpg"], "x.jpg"),
    "out is a folder, PNG": (["ball.ply", "--out", "folder.png"], "folder.png"),
    "out is a folder, EXR": (["ball.ply", "--out", "folder.exr"], "folder.exr"),
    "out under a file": (["none.ply", "--out", "words.txt/x.png"], "to the folder 'words.txt'"),
}


@pytest.mark.parametrize("case", BAD)
def test_bad_input_is_named_and_nothing_is_written(case, ball, tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for name in ("empty.obj", "empty.npz", "words.txt"):
        (tmp_path / name).touch()
    for name in ("folder.png", "folder.exr"):
        (tmp_path / name).mkdir()
    before = sorted(tmp_path.rglob("*"))
    options, words = BAD[case]
    try:
        code = main(["trace", "--out", "x.png", *SMALL, *options])
    except SystemExit as stop:
        code = stop.code
    assert code == INPUT_ERROR
    assert words in capsys.readouterr().err
    assert sorted(tmp_path.rglob("*")) == before


@pytest.mark.parametrize("command", ["compare", "export"])
def test_only_a_blend_is_compared_or_exported(command, ball, tmp_path, capsys, monkeypatch):
    """A comparison that fails says so in its folder, too."""
    monkeypatch.chdir(tmp_path)
    assert main([command, "ball.ply", "--out", "out.npz"]) == INPUT_ERROR
    assert "ball.ply" in capsys.readouterr().err
    written = [p for p in tmp_path.rglob("*") if p.is_file() and p != ball]
    assert [p.name for p in written] == (["comparison.json"] if command == "compare" else [])
    for path in written:
        held = json.loads(path.read_text(encoding="utf-8"))
        assert held["verdict"] == "failed" and "ball.ply" in held["error"]["message"]


@pytest.mark.parametrize(
    "options, word",
    [
        (["--width", "40"], "--width"),
        (["--eye", "0", "0", "9"], "--eye"),
        (["--angle", "9"], "--angle"),
    ],
)
def test_options_that_would_not_be_heard_are_refused(options, word, make, tmp_path, capsys):
    """A scene has a camera of its own."""
    save_scene(tmp_path / "s.npz", make.scene(make.camera(10, 6)))
    trace = ["trace", str(tmp_path / "s.npz"), "--out", str(tmp_path / "s.png"), *options]
    assert main(trace) == INPUT_ERROR
    assert word in capsys.readouterr().err and not (tmp_path / "s.png").exists()


@pytest.mark.parametrize("command", ["", "compare", "trace", "trade", "extremes", "export"])
def test_help_names_the_exit_codes(command, capsys):
    with pytest.raises(SystemExit) as stop:
        main([*command.split(), "--help"])
    text = capsys.readouterr().out
    assert stop.value.code == 0
    for words in ("0  the pictures agree", "2  differences", "4  the input is wrong"):
        assert words in text
    assert ("example:" in text) == bool(command)


def test_version_and_no_command(capsys):
    with pytest.raises(SystemExit) as stop:
        main(["--version"])
    assert stop.value.code == 0 and __version__ in capsys.readouterr().out
    with pytest.raises(SystemExit) as stop:
        main([])
    assert stop.value.code == INPUT_ERROR and "--help" in capsys.readouterr().err


def test_a_proven_method_takes_float64_whatever_is_stored():
    stored = Settings("textbook", "float32")
    for method in ("certified", "auto"):
        found = settings_from(argparse.Namespace(method=method), stored)
        assert (found.method, found.precision) == (method, "float64")
        with pytest.raises(SceneError, match="float32"):
            settings_from(argparse.Namespace(method=method, precision="float32"), Settings())
