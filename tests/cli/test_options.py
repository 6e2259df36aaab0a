"""What the options refuse, and what the help says."""

from __future__ import annotations

import json
import subprocess
import sys

import pytest
from reference_tracer import __version__
from reference_tracer.cli.arguments import GivenSettings
from reference_tracer.cli.main import main
from reference_tracer.cli.parser import INPUT_ERROR
from reference_tracer.scene import SceneError
from reference_tracer.tracer.settings import Settings

BAD = {
    "no file": (["none.ply"], "none.ply"),
    "a kind that is not read": (["words.txt"], "'words.txt' is none of .blend, .npz, .obj"),
    "a kind that Blender imports": (["scene.fbx"], "import it into Blender"),
    "a name without an end": (["words"], ".usdz: its name has no such end; rename it"),
    "a backup": (["scene.blend1"], "a .blend once it is renamed"),
    "a folder": (["folder.png"], "'folder.png' is no file but a folder"),
    "empty mesh": (["empty.obj"], "empty.obj"),
    "same point": (["ball.ply", "--set", "eye=1,2,3", "target=1,2,3"], "target are the same point"),
    "angle 180": (["ball.ply", "--set", "eye=0,0,5", "angle=180"], "--set angle: 180"),
    "no eye": (["ball.ply", "--set", "eye=nan,0,5"], "--set eye: nan"),
    "angle of an orthographic camera": (
        ["ball.ply", "--set", "eye=0,0,5", "ortho-scale=2", "angle=40"],
        "--set angle is for a camera that is not orthographic",
    ),
    "no name": (["ball.ply", "--set", "wide=5"], "--set takes NAME=VALUE, not 'wide=5'; width is"),
    "a file behind the names": (["--set", "up=y", "ball.ply"], "not 'ball.ply'; the names are wid"),
    "two numbers": (["ball.ply", "--set", "eye=1,2"], "--set eye: 1,2 is not X,Y,Z"),
    "no such axis": (["ball.ply", "--set", "up=x"], "--set up: x is none of y, z"),
    "two cameras": (
        ["none.blend", "--camera", "A", "--set", "eye=all"],
        "--set eye is for a new camera, and --camera names one",
    ),
    "scale of all": (
        ["none.blend", "--set", "eye=all", "ortho-scale=2"],
        "--set ortho-scale is for a camera that eye=X,Y,Z",
    ),
    "target alone": (["none.blend", "--set", "target=0,0,5"], "--set target is for a camera that"),
    "angle alone": (["none.blend", "--set", "angle=30"], "--set angle is for a new camera"),
    "axis up of a .blend": (["none.blend", "--set", "up=y"], "--set up is for meshes"),
    "scene of a mesh": (
        ["ball.ply", "--set", "scene=A"],
        "--set scene is for a .blend: 'ball.ply'",
    ),
    "camera of a scene": (["empty.npz", "--camera", "A"], "'empty.npz' has its own camera"),
    "size of a scene": (["empty.npz", "--set", "width=40"], "--set width is for a .blend or a"),
    "frame too far": (
        ["none.blend", "--set", "frame=9999999"],
        "--set frame: 9999999 is not from -1048574",
    ),
    "ortho scale below 0": (
        ["ball.ply", "--set", "eye=0,0,5", "ortho-scale=-1"],
        "--set ortho-scale: -1 is not a finite number above 0",
    ),
    "width 0": (["ball.ply", "--set", "width=0"], "--set width: 0 is not an integer of at least 1"),
    "options before the scene": (["none.ply", "--samples", "65"], "--samples is 65"),
    "float32 of auto": (
        ["none.ply", "--precision", "float32"],
        "--precision is float32; auto is proven for float64",
    ),
    "float32 of certified, whatever is stored": (
        ["none.blend", "--precision", "float32", "--method", "certified"],
        "--precision is float32; certified is proven for float64 only",
    ),
    "unknown method": (["ball.ply", "--method", "magic"], "--method"),
    "a fraction": (["ball.ply", "--samples", "1.5"], "--samples: 1.5 is not an integer"),
    "a comma": (
        ["ball.ply", "--set", "angle=0,5"],
        "--set angle: 0,5 is not between 0 and 180 degrees; the decimal sign is a point",
    ),
    "a misspelt option": (
        ["ball.ply", "--colour=facing"],
        "reftrace trace: there is no option --colour; --color is the nearest\n"
        "reftrace trace --help lists the options.\n",
    ),
    "no such option": (
        ["ball.ply", "--zzz"],
        "there is no option --zzz\nreftrace trace --",
    ),
    "options are told before words": (["ball.ply", "two.ply", "--zzz"], "no option --zzz"),
    "out suffix": (["ball.ply", "--out", "x.jpg"], "x.jpg"),
    "masks of a method without a proof": (
        ["ball.ply", "--masks", "masks", "--method", "textbook"],
        "--masks: textbook proves nothing",
    ),
    "out is a folder, PNG": (["ball.ply", "--out", "folder.png"], "folder.png"),
    "out under a file": (["empty.obj", "--out", "words.txt/x.png"], "to the folder 'words.txt'"),
}


@pytest.mark.parametrize("case", BAD)
def test_bad_input_is_named_and_nothing_is_written(
    case, ball, tmp_path, capsys, monkeypatch, exit_code
):
    monkeypatch.chdir(tmp_path)
    for name in ("empty.obj", "empty.npz", "words", "words.txt", "scene.fbx", "scene.blend1"):
        (tmp_path / name).write_text("PK")
    (tmp_path / "folder.png").mkdir()
    before = sorted(tmp_path.rglob("*"))
    options, words = BAD[case]
    assert exit_code(["trace", "--out", "x.png", *options]) == INPUT_ERROR
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
    "command", ["", "compare", "trace", "explain", "trade", "extremes", "export"]
)
def test_help_names_the_exit_codes(command, capsys):
    with pytest.raises(SystemExit) as stop:
        main([*command.split(), "--help"])
    text = capsys.readouterr().out
    assert stop.value.code == 0
    for words in ("0  ", "4  the input is wrong", "130  interrupted by Ctrl-C"):
        assert words in text
    of_pictures = command in ("", "compare")  # others compare none
    for words in ("0  the pictures agree", "1  warnings", "2  differences", "3  the sizes"):
        assert (words in text) == of_pictures
    assert ("example:" in text) == bool(command)


def test_the_longest_help_fits_two_screens(capsys):
    """Of 80 columns and 50 lines each; each name of an option that takes several is in it."""
    with pytest.raises(SystemExit):
        main(["compare", "--help"])
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) <= 100
    for name in ("width", "eye", "camera-view", "frame", "renderer", "filter", "scale", "layer"):
        assert sum(line.startswith(f"    {name}=") for line in lines) == 1


def test_who_types_a_name_as_an_option_is_told_where_it_went(capsys, exit_code):
    assert exit_code(["trace", "ball.ply", "--out", "x.png", "--width", "40"]) == INPUT_ERROR
    assert "there is no option --width: --set width=VALUE" in capsys.readouterr().err


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
        found = GivenSettings(method).over(stored)
        assert (found.method, found.precision) == (method, "float64")
        with pytest.raises(SceneError, match="float32"):
            GivenSettings(method, "float32").over(Settings())


def test_a_command_imports_what_it_needs_alone():
    """What one types first takes 0.5 s, were all commands imported for it."""
    code = """if True:
        import sys
        from reference_tracer.cli import main as cli
        for option in ("--help", "--version"):
            try:
                cli.main([option])
            except SystemExit:
                print(sorted({"numpy", "reference_tracer.cli.arguments"} & sys.modules.keys()))
        cli.parser(["trace"])
        needless = {"reference_tracer.causes", "reference_tracer.pictures", "ssl", "trimesh"}
        print("numpy" in sys.modules, sorted(needless & sys.modules.keys()))
        cli.parser(["compare"])
        print([f"reference_tracer.{n}" in sys.modules for n in ("causes", "diagnosis.faults")])
    """
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    said = done.stdout.splitlines()
    assert said.count("[]") == 2 and said[-2:] == ["True []", "[True, False]"]
