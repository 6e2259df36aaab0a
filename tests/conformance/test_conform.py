"""`reftrace conform`: Embree agrees on the kit, and what is wrong with a renderer is named."""

from __future__ import annotations

import json
import os
import sys
from pathlib import Path
from xml.etree import ElementTree

import pytest
from reference_tracer.scene import SceneError
from reference_tracer_conformance import judging
from reference_tracer_conformance.report import NAMES
from reference_tracer_processes.running import SECONDS
from reference_tracer_processes.sandbox import sandbox

PROJECT = Path(__file__).parents[2]
RENDERER = PROJECT / "packages" / "conformance" / "examples" / "embreex_obj.py"
MATRICES = 'K, R, t = (np.array(camera[key]) for key in "KRt")'
DIRECTIONS = "np.stack((x, y), axis=1)"
WRONG = {  # what is written in place of what, and what is said of it
    "half": (" + 0.5, np.arange(height) + 0.5", ", np.arange(height)", "the pixels' corners"),
    "rows": ("(255 * rgba)", "(255 * rgba[::-1])", "mirrored upside down"),
    "handed": (DIRECTIONS, DIRECTIONS.replace("(x", "(-x"), "mirrored left to right"),
    "fov": (MATRICES, f"{MATRICES}; K[0, 0] *= 1.15; K[1, 1] *= 1.15", "focal length is +15 %"),
    "shift": (MATRICES, f"{MATRICES}; K[0, 2] = width / 2", "the camera's shift is left out"),
    "square": (MATRICES, f"{MATRICES}; K[0, 0] = K[1, 1]", "pixel aspect"),
    "cull": (
        "vertices, triangles, colors = read_obj(obj)",
        "vertices, triangles, colors = read_obj(obj)\n"
        "    a, b, c = vertices[triangles].transpose(1, 0, 2)\n"
        "    eye = -np.array(camera['R']).T @ camera['t']\n"
        "    seen = (np.cross(b - a, c - a) * (eye - a)).sum(1) > 0\n"
        "    triangles, colors = triangles[seen], colors[seen]",
        "'Sheet' is missing",  # all of it is seen from behind, so that this is as true
    ),
}
OF = {"shift": "camera-shift-x", "square": "camera-tall-pixels", "cull": "mesh-back"}


@pytest.fixture
def out(tmp_path):
    return tmp_path / "report"


@pytest.fixture
def conform(out, exit_code, capsys):
    """Run a command on scenes; returns the exit code, what is printed, and the JSON by scenes."""

    def run(command, *only, options=("--no-sandbox",)):
        words = ["conform", command, "--out", str(out), *(["--only", *only] if only else [])]
        code = exit_code([*words, *options])
        told = capsys.readouterr()
        held = out / "conformance.json"
        found = json.loads(held.read_text(encoding="utf-8"))["scenes"] if held.exists() else []
        return code, told.out + told.err, {each["name"]: each for each in found}

    return run


def rendered(script):
    return f'"{sys.executable}" "{script}" {{obj}} {{camera}} {{out}}'


def made_wrong(name, folder):
    """Return the renderer with a fault, and what is said of it."""
    before, after, said = WRONG[name]
    text = RENDERER.read_text(encoding="utf-8")
    assert before in text
    path = folder / f"{name}.py"
    path.write_text(text.replace(before, after), encoding="utf-8")
    return path, said


def test_embree_agrees(conform, out):
    code, told, found = conform(
        rendered(RENDERER), "camera-shift-portrait", "camera-orthographic-shift", "mesh-behind"
    )
    assert code == 0 and "3 of 3 scenes agree" in told, told
    assert not any(each["wrong"] for each in found.values())
    assert not (out / "mesh-behind").exists()


@pytest.mark.parametrize("name", WRONG)
def test_what_is_wrong_is_named(name, conform, out, tmp_path):
    path, said = made_wrong(name, tmp_path)
    scene = OF.get(name, "camera-plain")
    code, told, found = conform(rendered(path), scene)
    assert code == 2 and said in found[scene]["wrong"] and said in told
    assert "0 of 1 scene agrees" in told
    page = (out / scene / "page.html").read_text(encoding="utf-8")
    assert "diagnosis" in page
    index = (out / "index.html").read_text(encoding="utf-8")
    assert f'href="{scene}/page.html"' in index and "0 of 1" in index
    failure = ElementTree.parse(out / "junit.xml").find(".//failure")
    assert said in failure.get("message") and "verdict: differences" in failure.text
    assert "0 of 1" in (out / "badge.svg").read_text(encoding="utf-8")


def test_what_a_few_pixels_show_gets_no_wrong_name(conform, tmp_path):
    """A post that is moved at the picture's rim: it is as if two of its triangles were missing."""
    path = tmp_path / "moved.py"
    read = "vertices, triangles, colors = read_obj(obj)"
    moved = f"{read}\n    vertices[12:20] += 0.15, -0.1, 0.12"
    path.write_text(RENDERER.read_text(encoding="utf-8").replace(read, moved), encoding="utf-8")
    code, _, found = conform(rendered(path), "camera-shift-portrait", "camera-plain")
    assert code == 2 and "lacks" not in found["camera-shift-portrait"]["wrong"]
    assert "'Post' is moved" in found["camera-plain"]["wrong"]


def test_the_time_limit_is_that_of_the_diagnosis_too(conform, out, tmp_path, monkeypatch):
    """It is counted in steps of work, and changes no verdict."""
    monkeypatch.setattr(judging, "STEPS", 5)
    path, said = made_wrong("fov", tmp_path)
    code, told, _ = conform(rendered(path), "camera-plain")
    held = (out / "camera-plain" / "comparison.json").read_text(encoding="utf-8")
    found = json.loads(held)["diagnosis"]
    assert code == 2 and said not in told
    assert found["steps"] == 5 * SECONDS and "focal_length" in found["untried"]


@pytest.mark.torture
def test_embree_agrees_on_the_whole_kit(conform):
    code, told, _ = conform(rendered(RENDERER))
    assert code == 0 and "40 of 40 scenes agree" in told, told


@pytest.mark.torture
@pytest.mark.parametrize("name", WRONG)
def test_what_is_wrong_is_named_everywhere(name, conform, tmp_path):
    """And where a scene does not have what the renderer does wrong, it agrees."""
    path, said = made_wrong(name, tmp_path)
    _, told, found = conform(rendered(path))
    wrong = {k: each["wrong"] for k, each in found.items() if each["verdict"] != "agree"}
    if name in OF:
        assert said in wrong[OF[name]], wrong
        assert "camera-plain" not in wrong
    else:
        assert sum(said in text for text in wrong.values()) >= 30, told


def test_a_copy_is_a_right_export(conform):
    """In the sandbox, where there is one."""
    options = ("--ending", ".glb")
    _, told, found = conform("cp {scene} {out}", "transform-sheared", "mesh-mat", options=options)
    assert "2 of 2 scenes agree" in told, told
    assert len(found) == 2


@pytest.mark.torture
def test_what_trimesh_makes_of_the_whole_kit(conform):
    """All is right, but for the names of what has two materials."""
    script = RENDERER.with_name("trimesh_glb.py")
    command = f'"{sys.executable}" "{script}" {{scene}} {{out}}'
    _, told, found = conform(command, options=("--no-sandbox", "--ending", ".glb"))
    assert "39 of 40 scenes agree" in told, told
    assert "lacks 'Bracket'" in found["mesh-materials"]["wrong"]


def test_an_export_with_another_axis_up_is_named(conform):
    swap = r"s/^v \(\S*\) \(\S*\) \(\S*\)/v \1 \3 -\2/"
    command = f"""sed -n '{swap};w {{out}}' {{obj}}"""
    code, _, found = conform(command, "transform-moved", options=("--ending", ".obj"))
    assert code == 2 and "up" in found["transform-moved"]["wrong"], found


def test_an_export_of_other_objects_is_refused_by_name(conform, out):
    command = "sed -n 's/^o Post/o Pole/;w {out}' {obj}"
    code, _, found = conform(command, "transform-moved", options=("--ending", ".obj"))
    wrong = found["transform-moved"]["wrong"]
    assert code == 4 and "lacks 'Post' and has besides 'Pole'" in wrong


@pytest.mark.parametrize(
    ("command", "said"),
    [
        ("true {scene} {out}", "wrote no file {out} (out.png)"),
        ("false {scene} {out}", "exit code 1"),
        ("cp {scene} {out}", "out.png"),
        ("sleep 30 {scene} {out}", "exit code|longer than the time limit"),
    ],
)
def test_a_program_that_fails_is_a_failed_scene(command, said, conform, out):
    code, _, found = conform(command, "mesh-ball", options=("--time-limit", "1"))
    assert code == 4 and found["mesh-ball"]["verdict"] == "failed"
    assert any(part in found["mesh-ball"]["wrong"] for part in said.split("|")), found
    assert str(out) not in found["mesh-ball"]["wrong"]


def test_a_picture_of_another_size_fails(conform, out, tmp_path):
    script = tmp_path / "small.py"
    text = RENDERER.read_text(encoding="utf-8").replace(".save(out)", ".resize((32, 24)).save(out)")
    script.write_text(text, encoding="utf-8")
    code, _, found = conform(rendered(script), "camera-plain")
    assert code == 4
    assert found["camera-plain"]["wrong"] == (
        "The picture has 32 x 24 pixels, the traced one 64 x 48. Render it at that size"
    )


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["render {scene} {out}"], "--out DIR"),
        (["render {out}", "--out", "r"], "names no file of a scene"),
        (["render {scene}", "--out", "r"], "names no {out}"),
        (["render {obj} {colours} {out}", "--out", "r"], "{colours}; {colors} is the nearest"),
        (["render '{scene} {out}", "--out", "r"], "is not understood"),
        (["no-such {scene} {out}", "--out", "r"], "there is no program 'no-such'"),
        (["./no/such {scene} {out}", "--out", "r"], "there is no program './no/such'"),
        ([f"{__file__} {{scene}} {{out}}", "--out", "r"], "test_conform.py' cannot be executed"),
        ([f"{PROJECT} {{scene}} {{out}}", "--out", "r"], f"'{PROJECT}' cannot be executed"),
        (["true {scene} {out}", "--out", "r", "--only", "none"], "there are camera-plain"),
        (["--write", "kit", "--only", "mesh"], "is for a run"),
        (["x {scene} {out}", "--write", "kit"], "leave out the command"),
    ],
)
def test_what_contradicts_itself_is_refused(words, said, exit_code, capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert exit_code(["conform", *words]) == 4
    assert said in capsys.readouterr().err
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("command", ["judge --subject plane --run", "conform"])
def test_a_program_that_the_sandbox_does_not_show_is_refused(command, exit_code, capsys, tmp_path):
    """And is not judged to fail: as of an environment in /tmp, whose Python is a link."""
    (tmp_path / "python").symlink_to(Path(sys.executable).resolve())
    out = tmp_path / "report"
    words = [*command.split(), f"{tmp_path}/python -c 1 {{scene}} {{out}}", "--out", str(out)]
    assert (exit_code(words) == 4 and not out.exists()) == bool(sandbox())
    assert (f"does not show '{tmp_path}/python'" in capsys.readouterr().err) == bool(sandbox())


@pytest.mark.skipif(os.name == "nt", reason="Windows has no such signals")
def test_a_signal_without_a_name_is_told_by_its_number(conform):
    _, _, found = conform("sh -c 'kill -40 $$; : {scene} {out}'", "mesh-ball")
    assert found["mesh-ball"]["wrong"] == "the program was ended by signal 40"


def test_a_run_that_breaks_off_leaves_no_result_of_an_earlier_one(conform, out, monkeypatch):
    conform(rendered(RENDERER), "mesh-triangle")
    assert (out / "junit.xml").exists()

    def breaks(*_):
        raise SceneError("the kit cannot be written")

    monkeypatch.setattr("reference_tracer_conformance.judging.write_kit", breaks)
    code, told, _ = conform(rendered(RENDERER), "mesh-triangle")
    assert code == 4 and "cannot be written" in told
    assert not any((out / name).exists() for name in NAMES)


def test_the_second_run_leaves_no_page_of_the_first(conform, out, tmp_path):
    path, _ = made_wrong("rows", tmp_path)
    conform(rendered(path), "mesh-triangle")
    assert (out / "mesh-triangle" / "page.html").exists()
    conform(rendered(RENDERER), "mesh-triangle")
    assert not (out / "mesh-triangle").exists()
