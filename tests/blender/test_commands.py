"""The command behind `blender FILE --command reference_tracer`: its exit codes and messages."""

from __future__ import annotations

import json

import bpy
import pytest
from reference_tracer.blender.jobs import compare as compare_module
from reference_tracer.cli import in_blender

from .scenes import save


@pytest.fixture
def saved(build, tmp_path):
    """An open file with a small scene."""
    scene = build.room(64, 36, lens=40)
    save(tmp_path / "scene.blend")
    return scene


@pytest.fixture
def out(tmp_path):
    return tmp_path / "out" / "deeper"


def verdict(out) -> dict:
    return json.loads((out / "comparison.json").read_text(encoding="utf-8"))


def test_0_the_pictures_agree(saved, out, capsys):
    assert in_blender.run(["compare", "--out", str(out)]) == 0
    assert sorted(p.name for p in out.iterdir()) == [
        "blender.png",
        "comparison.json",
        "difference.png",
        "frame.npz",
        "page.html",
        "traced.png",
    ]
    printed = capsys.readouterr().out
    assert "verdict: agree" in printed
    assert "of 2,304 pixels agree with Blender's workbench picture" in printed
    assert "4 of 5 objects exported" in printed
    assert str(out) in printed
    assert verdict(out)["verdict"] == "agree"
    assert verdict(out)["scene"]["file"] == "scene.blend"


def test_1_something_is_not_modelled(saved, out):
    bpy.data.materials["Red"].diffuse_color[3] = 0.5
    assert in_blender.run(["compare", "--out", str(out)]) == 1
    found = verdict(out)
    assert found["verdict"] == "warnings"
    assert [u["feature"] for u in found["scene"]["unmodelled"]] == ["transparency"]
    assert found["pixels"]["unexplained"] == 0 < found["pixels"]["by_cause"]["not_modelled"]


def test_3_the_sizes_do_not_match(saved, out, shown_otherwise, capsys):
    shown_otherwise(lambda picture: picture[:-1])
    assert in_blender.run(["compare", "--out", str(out)]) == 3
    found = verdict(out)
    assert found["verdict"] == "failed"
    assert "64 x 35" in found["error"]["message"]
    assert "64 x 35" in capsys.readouterr().err


def test_4_no_file_is_open(build, out, capsys):
    build.camera()
    assert not bpy.data.filepath
    assert in_blender.run(["compare", "--out", str(out)]) == 4
    assert "no file is open" in capsys.readouterr().err
    assert [p.name for p in out.iterdir()] == ["comparison.json"]
    assert verdict(out)["verdict"] == "failed"


@pytest.mark.parametrize(
    "argv",
    [
        [],
        ["nothing"],
        ["compare", "--out"],
        ["compare", "--out", "x", "--method", "magic"],
        ["compare", "--out", "x", "--samples", "two"],
        ["compare", "--out", "x", "--no-such-option"],
        ["compare", "--out", "x", "more"],
    ],
    ids=str,
)
def test_4_an_option_that_is_wrong(argv, saved, capsys):
    assert in_blender.run(argv) == 4
    message = capsys.readouterr().err
    assert "--help" in message


@pytest.mark.parametrize("kind", [RuntimeError, KeyError, MemoryError])
def test_4_an_exception_of_its_own(kind, saved, out, monkeypatch, capsys):
    def fail(*args, **options):
        raise kind("on purpose")

    monkeypatch.setattr(compare_module, "_picture", fail)
    assert in_blender.run(["compare", "--out", str(out)]) == 4
    assert "on purpose" in capsys.readouterr().err
    assert verdict(out)["error"]["type"] == kind.__name__


@pytest.mark.parametrize(
    ("options", "section", "key", "value"),
    [
        (["--method", "moller_trumbore"], "tracer", "method", "moller_trumbore"),
        (["--precision", "float32"], "tracer", "precision", "float32"),
        (["--samples", "2", "--as-is"], "tracer", "samples", 2),
        (["--samples", "2"], "tracer", "samples", 1),  # like for like has Blender's one
        (["--judge", "cycles"], "blender", "source", "cycles"),
        (["--judge", "auto"], "blender", "source", "workbench"),
        ([], "tracer", "method", "textbook_literal"),
    ],
    ids=str,
)
def test_options_hold_before_what_the_scene_stores(options, section, key, value, saved, out):
    saved.reference_tracer.method = "textbook_literal"
    saved.reference_tracer.judge = "CYCLES" if "auto" in options else "WORKBENCH"
    saved.reference_tracer.shading = "LIKE_FOR_LIKE" if options else "AS_IS"
    in_blender.run(["compare", "--no-diagnosis", "--out", str(out), *options])
    found = verdict(out)
    assert found[section][key] == value
    as_is = not options or "--as-is" in options
    assert found["blender"]["settings"]["like_for_like"] is not as_is
    assert saved.reference_tracer.method == "textbook_literal"


def test_a_folder_beside_the_file(saved, tmp_path):
    """The file may be one of Blender's backups."""
    save(tmp_path / "scene.blend1")
    assert in_blender.run(["compare", "--out", "//beside"]) == 0
    assert (tmp_path / "beside" / "comparison.json").is_file()
    written = ["--out", "//beside/pixel.md", "--reproducer", "//beside/pixel.json"]
    assert in_blender.run(["explain", "--pixel", "0", "0", *written]) == 0
    assert (tmp_path / "beside" / "pixel.md").is_file()
    assert (tmp_path / "beside" / "pixel.json").is_file()
    traced = ["--against", "//beside/traced.png"]
    assert in_blender.run(["compare", "--out", "//again", *traced]) == 0
