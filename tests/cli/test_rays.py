"""`reftrace rays`: any rays, certified."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
import trimesh
from reference_tracer.files.scenes import save_scene
from reference_tracer.scene import Plane

PAGE = Path(__file__).parents[2] / "docs" / "rays.md"


@pytest.fixture
def run(tmp_path, exit_code, capsys):
    """Trace rays through a scene; returns the exit code, the arrays, and what is printed."""

    def traced(scene, *options, **arrays):
        save_scene(tmp_path / "scene.npz", scene)
        np.savez(tmp_path / "rays.npz", **arrays)
        words = ["rays", tmp_path / "scene.npz", tmp_path / "rays.npz", "--out", tmp_path / "h.npz"]
        code = exit_code([*map(str, words), *options])
        found = None
        if code == 0:
            with np.load(tmp_path / "h.npz") as held:
                found = dict(held)
        printed = capsys.readouterr()
        return code, found, printed.out + printed.err

    return traced


@pytest.fixture
def scene(make):
    ball = make.mesh(trimesh.creation.icosphere(2), name="Ball")
    plane = Plane(0, (0, 0, -1.5), (0, 0, 1))
    made = make.scene(make.camera(4, 4), ball)
    return type(made)(made.camera, made.meshes, made.instances, (plane,), objects=made.objects)


def random_rays(count, seed=1):
    rng = np.random.default_rng(seed)
    origins = rng.normal(size=(count, 3)) * 3
    return {"origins": origins, "directions": rng.normal(size=(count, 3)) - origins}


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"origins": None}, "has no array 'origins'"),
        ({"directions": np.zeros((5, 3))}, "row 0 of directions is zero"),
        ({"directions": np.ones((4, 3))}, "5 origins and 4 directions"),
        ({"origins": np.full((5, 3), [[1], [2], [np.nan], [0], [0]])}, "row 2 of origins"),
        ({"origins": np.full((5, 3), 2**53 + 1)}, "numbers that float64 does not"),
    ],
)
def test_rays_that_are_wrong_are_refused_by_name(change, said, scene, run):
    arrays = random_rays(5) | change
    code, _, printed = run(scene, **{k: v for k, v in arrays.items() if v is not None})
    assert code == 4 and said in printed, printed


def test_options_that_are_wrong_are_refused(scene, run, tmp_path, exit_code, capsys):
    assert (
        "--start 2 is not below --end 1"
        in run(scene, "--start", "2", "--end", "1", **random_rays(2))[2]
    )
    rays = str(tmp_path / "rays.npz")
    assert exit_code(["rays", str(tmp_path / "scene.npz"), rays, "--out", rays]) == 4
    assert "is a file that is read" in capsys.readouterr().err


def test_the_example_of_the_page_runs(scene, tmp_path, monkeypatch, exit_code):
    monkeypatch.chdir(tmp_path)
    save_scene("scene.npz", scene)
    before, after = re.findall(r"^```python\n(.*?)^```$", PAGE.read_text("utf-8"), re.M | re.S)
    exec(compile(before, "rays.md", "exec"), {})
    assert exit_code("rays scene.npz rays.npz --out hits.npz".split()) == 0
    exec(compile(after, "rays.md", "exec"), held := {})
    assert held["wrong"].sum() == 0


def test_every_hit_and_parity(make, run):
    """What Python's functions return, in a file: rows of each ray, and where points are."""
    ball = make.scene(make.camera(4, 4), make.mesh(trimesh.creation.icosphere(2), name="Ball"))
    given = random_rays(300)
    code, found, printed = run(ball, "--every", **given)
    _, first, _ = run(ball, **given)
    start = found["start"]
    assert code == 0 and len(start) == 301 and start[-1] == len(found["t"]) > 100
    assert f"300 rays, 320 triangles: {len(found['t']):,} hits, 0 ambiguous" in printed
    met = np.flatnonzero(first["triangle"] >= 0)
    assert (np.diff(start) > 0).nonzero()[0].tolist() == met.tolist()
    for name in ("t", "triangle", "object", "instance"):
        assert (found[name][start[met]] == first[name][met]).all(), name
    assert found["barycentrics"].shape == (start[-1], 3) and found["objects"] == ["Ball"]
    points = np.array([(0, 0, 0), (0, 2, 0), ball.meshes[0].vertices[5]])
    code, places, printed = run(ball, "--parity", points=points)
    assert code == 0 and places["place"].tolist() == [1, 0, 2]
    assert places["winding"][:2].tolist() == [1, 0]
    assert "3 points, 320 triangles: 1 outside, 1 inside, 1 on a surface" in printed


def test_parity_refuses_what_it_can_not_say(scene, run):
    points = np.zeros((1, 3))
    assert "no array 'points'" in run(scene, "--parity", origins=points)[2]
    assert "leave out --start and --end" in run(scene, "--parity", "--end", "3", points=points)[2]
    assert "not allowed with" in run(scene, "--parity", "--every", points=points)[2]


def test_a_row_alone_and_none(scene, run):
    """Alone a ray shares nothing, as among others: not even how it is decided is another."""
    given = random_rays(4, seed=3)
    _, many, _ = run(scene, **given)
    assert (many["triangle"] >= 0).sum() > 1
    for k in range(4):
        _, one, _ = run(scene, **{name: rows[k : k + 1] for name, rows in given.items()})
        for name in ("t", "instance", "triangle", "certainty", "barycentrics"):
            assert one[name].tobytes() == many[name][k].tobytes(), (k, name)
    for origins in (given["origins"][0], given["origins"][:0]):
        code, none, _ = run(scene, origins=origins, directions=given["directions"][:0])
        assert code == 0 and len(none["t"]) == 0
