"""`reftrace judge`: its files, options and exit codes."""

from __future__ import annotations

import json
import os
import shlex
import signal
import subprocess
import sys
import time

import pytest
from reference_tracer.cli.main import main
from reference_tracer.cli.parser import AGREE, DIFFERENCES, INPUT_ERROR, INTERRUPTED
from reference_tracer.files.scenes import save_scene
from reference_tracer_processes.sandbox import sandbox

from .conftest import running

SMALL = ["--pixels", "300"]


@pytest.fixture
def template(tmp_path, capsys):
    path = tmp_path / "new" / "mine.py"
    assert main(["judge", "--template", str(path)]) == AGREE
    capsys.readouterr()
    return path


@pytest.fixture
def solution(template):
    """The template, filled in as its comments say."""
    lines = template.read_text(encoding="utf-8").replace("    # p1, p2", "    p1, p2").splitlines()
    end = next(k for k, line in enumerate(lines) if line.strip() == "return t, barycentrics")
    lines[end:] = [
        "    n = np.cross(p3 - p1, p2 - p1)",
        "    dn = (directions * n).sum(axis=1)",
        "    t = -((origins - p1) * n).sum(axis=1) / dn",
        "    x = origins + t[:, None] * directions",
        "    n_s = np.cross(p2 - p3, x - p3), np.cross(p3 - p1, x - p1), np.cross(p1 - p2, x - p2)",
        "    s = [(n * k).sum(axis=1) / (n * n).sum(axis=1) for k in n_s]",
        "    barycentrics = np.stack(s, axis=1)",
        "    hit = (barycentrics >= 0).all(axis=1) & (t > 0)",
        "    return np.where(hit, t, np.inf), barycentrics",
    ]
    path = template.with_name("solution.py")
    path.write_text("\n".join(lines), encoding="utf-8")
    return path


def test_the_template_runs_and_hits_nothing(template, capsys):
    assert main(["judge", str(template), *SMALL]) == DIFFERENCES
    text = capsys.readouterr().out
    assert "score 0.0 of 100" in text and "no_hits" in text


def test_the_template_is_not_overwritten(template, capsys):
    before = template.read_bytes()
    assert main(["judge", "--template", str(template)]) == INPUT_ERROR
    assert template.read_bytes() == before


def test_filled_in_as_it_says(solution, tmp_path, capsys):
    out = tmp_path / "judged"
    assert main(["judge", str(solution), *SMALL, "--out", str(out)]) == AGREE
    text = capsys.readouterr().out
    assert "all right, score 100.0" in text
    found = json.loads((out / "judge.json").read_text(encoding="utf-8"))
    assert [s["name"] for s in found["students"][0]["scenes"]] == [
        "exercise_orthographic",
        "exercise_perspective",
        "exercise_plane",
        "exercise_triangle",
    ]
    assert (out / "judge.html").is_file()


def test_it_goes_on_where_it_was(template, solution, tmp_path, capsys):
    """The second time only the new one is run; the tables have all."""
    out = ["--out", str(tmp_path / "out"), "--format", "csv"]
    main(["judge", str(solution), *SMALL, *out])
    capsys.readouterr()
    assert main(["judge", str(template), str(solution), *SMALL, *out]) == DIFFERENCES
    text = capsys.readouterr().out
    # Without a sandbox nobody's record is believed.
    assert ("1 student judged before" in text) == bool(sandbox())
    assert ("solution.py: all right" in text) != bool(sandbox())
    assert [line.split()[:2] for line in text.splitlines()[-3:-1]] == [
        ["mine.py", "0.0"],
        ["solution.py", "100.0"],
    ]
    assert (tmp_path / "out" / "judge.csv").read_text().count("\n") == 3


def test_ones_own_scenes(make, solution, tmp_path, capsys):
    scene = make.scene(make.camera(10, 6), make.quad(-9, 0.03, -9, 9.1, -2))
    save_scene(tmp_path / "mine.npz", scene)
    assert main(["judge", str(solution), str(tmp_path / "mine.npz")]) == AGREE
    text = capsys.readouterr().out
    assert "mine  " in text and "exercise" not in text


def test_files_of_one_name(make, solution, template, tmp_path, capsys):
    """They are told apart, in the tables and in the JSON; a scene that is named twice is one."""
    files = []
    for folder, text in (("a", solution), ("b", template)):
        (tmp_path / folder).mkdir()
        (tmp_path / folder / "own.py").write_bytes(text.read_bytes())
        files.append(str(tmp_path / folder / "own.py"))
    (tmp_path / "c").mkdir()
    empty, full = tmp_path / "c" / "own.npz", tmp_path / "own.npz"
    save_scene(empty, make.scene(make.camera(10, 6)))
    save_scene(full, make.scene(make.camera(10, 6), make.quad(-9, 0.03, -9, 9.1, -2)))
    scenes = [str(empty), str(full), str(full)]
    assert main(["judge", *files, *scenes, "--out", str(tmp_path / "out")]) == DIFFERENCES
    assert [line.split()[:2] for line in capsys.readouterr().out.splitlines()[-3:-1]] == [
        ["a/own.py", "100.0"],
        ["b/own.py", "0.0"],
    ]
    found = json.loads((tmp_path / "out" / "judge.json").read_text(encoding="utf-8"))["students"]
    assert [s["file"] for s in found] == ["a/own.py", "b/own.py"]
    for student, right in zip(found, (True, False), strict=True):
        names, tallies = zip(*((s["name"], s["tally"]) for s in student["scenes"]), strict=True)
        assert [n.split("/")[-2:] for n in names] == [["c", "own.npz"], [tmp_path.name, "own.npz"]]
        assert [t["total"] for t in tallies] == [0, 30]
        assert (tallies[1]["surface"] == 30) is right


def test_the_command_for_a_pixel_can_be_typed(template, tmp_path, capsys):
    """A folder with a space, and a camera that the options have placed."""
    path = tmp_path / "a folder" / "mesh.obj"
    path.parent.mkdir()
    path.write_text("v -1 -1 0\nv 1 -1 0\nv 0 1 .5\nf 1 2 3\n")
    camera = ["--set", "eye=0.1,0,-5", "angle=40", "width=20", "height=14"]
    assert main(["judge", str(template), str(path), *camera]) == DIFFERENCES
    line = next(x for x in capsys.readouterr().out.splitlines() if "reftrace explain" in x)
    command = shlex.split(line.partition(": reftrace ")[2])
    assert main(command) == AGREE
    assert "sees mesh, triangle 0" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ([], "name a student's file"),
        (["FILE", "--format", "csv"], "--format is for a folder"),
        (["scene.npz"], "name a student's file"),
        (["not_there.py"], "no file 'not_there.py'"),
        (["FILE", "not_there.npz"], "no file 'not_there.npz'"),
        (["FILE", "FILE.txt"], "none of .blend"),
        (["FILE", "--set", "eye=0,0,5"], "--set eye is for scenes of your own"),
        (["FILE", "--time-limit", "0"], "--time-limit: 0 is not"),
        (["FILE", "--pixels", "-3"], "--pixels: -3 is not"),
        (["FILE", "--memory-limit", "nan"], "--memory-limit: nan is not"),
        (["FILE", "--memory-limit", "inf"], "--memory-limit: inf is not"),
        (["FILE", "--memory-limit", "1e-6"], "--memory-limit: 1e-6 is not"),
        (["FILE", "--memory-limit", "1e12"], "--memory-limit: 1e12 is not"),
        (["FILE", "--time-limit", "inf"], "--time-limit: inf is not"),
    ],
)
def test_wrong_input(options, words, template, tmp_path, capsys, monkeypatch, exit_code):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "FILE.txt").write_text("x")
    (tmp_path / "scene.npz").write_text("x")
    options = [str(template) if o == "FILE" else o for o in options]
    assert exit_code(["judge", *options]) == INPUT_ERROR
    assert words in capsys.readouterr().err


def test_help_says_that_it_runs_code(capsys):
    with pytest.raises(SystemExit):
        main(["judge", "--help"])
    text = capsys.readouterr().out
    assert "RUNS their code" in text and "no sandbox" in text
    assert "one is wrong, or fails" in text


def test_ctrl_c_ends_the_student_too(tmp_path):
    """The student's process is not the terminal's to end: this one does."""
    path = tmp_path / "endless.py"
    seconds = f"61.{os.getpid()}"  # no other process sleeps as long
    path.write_text(f"import subprocess\nsubprocess.run(['sleep', '{seconds}'])\n")
    command = [sys.executable, "-m", "reference_tracer.cli.main", "judge", str(path), *SMALL]
    process = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
    for _ in range(600):
        if running(seconds):
            break
        time.sleep(0.05)
    process.send_signal(signal.SIGINT)
    try:
        assert "interrupted" in process.communicate(timeout=20)[1]
    finally:
        process.kill()
    assert process.returncode == INTERRUPTED
    assert not running(seconds)
