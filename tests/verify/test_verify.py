"""The checker agrees with the definition and the tracer, alone, and names what it does not know."""

from __future__ import annotations

import ast
import json
import subprocess
import sys
from dataclasses import replace
from itertools import permutations
from pathlib import Path

import numpy as np
import pytest
import reference_tracer_verify.verify as checker
from reference_tracer import rendering
from reference_tracer.certificate_file import save_certificate
from reference_tracer.certified import ties
from reference_tracer.certified.definition import definition
from reference_tracer.certified.plain import plain
from reference_tracer.cli.parser import AGREE, DIFFERENCES, INPUT_ERROR
from reference_tracer.projections import ORTHOGRAPHIC
from reference_tracer.rendering import certified_tracer, render
from reference_tracer.scene import Camera, Mesh, Region, ViewWindow
from reference_tracer.scene_files import load_scene
from reference_tracer.tracer.hits import no_measures
from reference_tracer.tracer.settings import Settings

from ..certified.test_definition import small
from ..tracer.hostile_scenes import scene_of_integers
from .certificates import arrays_of, certified, refusal, scene_of

STORED = Path(__file__).parents[2] / "packages" / "grading" / "scenes"
FILE = Path(checker.__file__)


@pytest.fixture
def stored(tmp_path):
    """The certificate of a small scene with instances and a plane."""
    path = tmp_path / "certificate.npz"
    return path, certified(scene_of(None, 0), path)


def held(make, seeds, path, scene=scene_of) -> tuple[int, int]:
    """Have the certificates of some scenes checked; return how many rays and ambiguous ones."""
    rays = ambiguous = 0
    for seed in seeds:
        answers = certified(scene(make, seed), path)
        assert not refusal(path), seed
        rays += answers["t"].size
        ambiguous += len(np.unique(answers["tie_pixel"]))
    return rays, ambiguous


def test_the_tracers_pictures_are_true(make, tmp_path):
    rays, ambiguous = held(make, range(24), tmp_path / "c.npz")
    assert rays > 1500 and ambiguous > 50


def test_on_small_integers(make, tmp_path):
    """Edges, corners, silhouettes, equal depths, clip ends at surfaces, rays that begin on them."""

    def scene(make, seed):
        return scene_of_integers(make, np.random.default_rng(seed))

    rays, ambiguous = held(make, (*range(40), 175, 596), tmp_path / "c.npz", scene)
    assert rays > 800 and ambiguous > 150


@pytest.mark.parametrize("depth", [4.0, 0.0])
def test_surfaces_that_intersect_where_a_ray_meets_them(depth, make, tmp_path):
    """Three planes behind a half that ends there; or those where the ray begins, in any order."""
    x, y = np.array([[-8, 8, 0], [-8, -8, 8]]) * 1.0
    slopes = (-1, 0), (0.5, 1), (0.5, -1)
    sheets = [np.stack((x, y, u * x + v * y - depth), axis=1) for u, v in slopes]
    if depth:
        sheets.append(np.array([(0, -8, -2), (0, 8, -2), (8, 0, -2)]) * 1.0)
    window = ViewWindow(-1, 1, -1, 1)
    camera = Camera(np.eye(4), window, 1, 1, ORTHOGRAPHIC, clip_start=-1.0, clip_end=9.0)
    owners = set()
    for order in permutations(range(len(sheets))):
        scene = make.scene(camera, *(Mesh(sheets[k], [[0, 1, 2]]) for k in order))
        answers = certified(scene, tmp_path / "c.npz")
        assert not refusal(tmp_path / "c.npz"), order
        assert len(answers["tie_pixel"]) == len(sheets)
        owners.add(order[int(answers["instance"][0, 0])])
    assert len(owners) == 1


def test_in_small_parts(make, tmp_path, monkeypatch):
    """However few pixels, surfaces or pairs are looked at together."""
    for name, size in {"PIXELS": 30, "SURFACES": 3, "PAIRS": 5}.items():
        monkeypatch.setattr(checker, name, size)
    held(make, range(0, 12, 3), tmp_path / "c.npz")


@pytest.mark.torture
def test_many_of_the_tracers_pictures_are_true(make, tmp_path):
    rays, ambiguous = held(make, range(24, 6000), tmp_path / "c.npz")
    assert rays > 400_000 and ambiguous > 20_000


def test_the_definitions_pictures_are_true(make, tmp_path):
    """Without the tracer: what the definition says is written into the file, ties included."""
    path = tmp_path / "c.npz"
    ambiguous = 0
    for seed in (*range(0, 36, 3), *range(1, 25, 3)):
        scene = small(scene_of(make, seed), 60)
        arrays = certified(scene, path)
        seen = list(definition(scene))
        shape = arrays["t"].shape
        names = np.array([s.name for s in seen], np.int32).reshape(*shape, 2)
        rows = [(k, *name) for k, s in enumerate(seen) for name in s.ties]
        arrays |= dict(instance=names[..., 0], triangle=names[..., 1])
        arrays["t"] = np.array([s.t for s in seen]).reshape(shape)
        of_ties = np.array(rows, np.int64).reshape(-1, 3).T
        arrays |= dict(zip(("tie_pixel", "tie_instance", "tie_triangle"), of_ties, strict=True))
        np.savez(path, **arrays)
        assert not refusal(path), seed
        ambiguous += len(set(arrays["tie_pixel"].tolist()))
    assert ambiguous > 40


@pytest.mark.parametrize(
    "settings", [Settings("watertight"), Settings("moller_trumbore", "float32")]
)
def test_an_unproven_picture_is_refused(settings, tmp_path):
    scene = load_scene(STORED / "exercise_triangle.npz")
    scene = scene.seen_by(replace(scene.camera, region=Region(0, 150, 640, 180)))
    save_certificate(tmp_path / "c.npz", render(scene, settings))
    assert refusal(tmp_path / "c.npz").startswith("pixel (")


def lying(kind: str):
    """Return a tracer that says something wrong of one pixel in some thousand."""

    def tracer(scene, settings, reach, statistics):
        honest = yield from certified_tracer(scene, settings, reach, statistics)

        def trace_band(band, dx, dy):
            hits = yield from honest(band, dx, dy)
            values = hits.values.copy()
            pixel = np.flatnonzero(hits.instance >= 0)[::1001]
            if kind == "another owner":
                hits.triangle[pixel] = 0
            elif kind == "nothing":
                hits.instance[pixel] = hits.triangle[pixel] = -1
                values[:, pixel] = no_measures(len(pixel))
            elif kind == "t":
                values[0, pixel] = np.nextafter(values[0, pixel], 0)
            return replace(hits, measures=values)

        return trace_band

    return tracer


@pytest.mark.parametrize("kind", ["honest", "another owner", "nothing", "t"])
def test_workers_that_lie_are_found(kind, tmp_path):
    scene = load_scene(STORED / "exercise_perspective.npz")
    scene = scene.seen_by(replace(scene.camera, region=Region(0, 200, 640, 230)))
    save_certificate(tmp_path / "c.npz", render(scene, tracer=lying(kind)))
    assert bool(refusal(tmp_path / "c.npz")) == (kind != "honest")


@pytest.mark.parametrize("wrong", [False, True])
def test_without_the_sweep(wrong, monkeypatch, make, tmp_path):
    """`plain` alone is checked the same; with another rule for ties, it is refused."""
    monkeypatch.setattr(rendering, "sweep", plain)
    if wrong:
        monkeypatch.setattr(ties, "PERTURBATION", ((-1, 0, 0), (0, -1, 0), (0, 0, 1)))
    refused = 0
    for seed in (3, 9, 15, 21):
        save_certificate(tmp_path / "c.npz", render(scene_of(make, seed)))
        refused += refusal(tmp_path / "c.npz").startswith("pixel (")
    assert refused == 0 if not wrong else refused > 1


def test_it_runs_alone(stored, tmp_path):
    """A copy of the one file, in a folder by itself, in a process that finds no tracer."""
    path, arrays = stored
    alone = tmp_path / "alone.py"
    alone.write_text(FILE.read_text("utf-8"), "utf-8")
    run = [sys.executable, "-I", str(alone), str(path)]
    done = subprocess.run(run, capture_output=True, text=True)
    assert done.returncode == 0 and done.stdout.startswith("all 96 pixels"), done
    arrays["t"][1, 2] = 3.25
    np.savez(path, **arrays)
    done = subprocess.run(run, capture_output=True, text=True)
    assert done.returncode == 2 and "pixel (2, 1): the file says" in done.stdout, done


def test_it_imports_numpy_alone_and_is_short():
    tree = ast.parse(FILE.read_text("utf-8"))
    imports = [node for node in ast.walk(tree) if isinstance(node, (ast.Import, ast.ImportFrom))]
    names = {n.module if isinstance(n, ast.ImportFrom) else n.names[0].name for n in imports}
    outside = {name for name in names if name.partition(".")[0] not in sys.stdlib_module_names}
    assert outside == {"numpy"} and not any(getattr(n, "level", 0) for n in imports)


def test_what_it_does_not_know_is_refused_by_name(stored):
    path, arrays = stored

    def said(**changed) -> str:
        scene = json.loads(str(arrays["scene"]))
        scene["camera"] |= changed.pop("camera", {})
        scene |= changed.pop("scene", {})
        np.savez(path, **(arrays | {"scene": np.array(json.dumps(scene))} | changed))
        return refusal(path)

    assert said() == ""
    assert said(spheres=np.zeros(3)) == "not covered: array spheres"
    assert said(scene={"fog": 1}) == "not covered: part of the scene fog"
    assert said(camera={"lens_shift": 1}) == "not covered: part of the camera lens_shift"
    assert said(camera={"projection": "fisheye"}) == "not covered: camera fisheye"
    assert "schema reference_tracer.certificate/2" in said(
        certificate=np.array("reference_tracer.certificate/2")
    )
    assert said(mesh0_triangles=np.full((14, 3), 24)) == "not covered: vertex 24"
    assert said(instance=arrays["instance"][1:]) == "the answers are not those of 12 x 8"
    assert said(tie_pixel=arrays["tie_pixel"] + 50).startswith("not covered: tie of pixel 11")


def test_numbers_of_another_type_are_refused(stored):
    """What rounds otherwise than the page says, or is no number at all."""
    path, arrays = stored

    def said(**changed) -> str:
        np.savez(path, **(arrays | changed))
        return refusal(path)

    for kind in ("f2", "f4", "U", "c16", "M8[s]"):
        assert said(t=np.zeros((8, 12), kind)).startswith("not covered: type of t "), kind
    wide = np.dtype(np.longdouble).str[1:]
    real = "mesh0_vertices", "instance0_world_from_object", "plane0_point", "plane0_normal"
    for name in real:
        for kind in {"U", "c16", wide} - {"f8"}:  # long doubles are doubles on some machines
            assert said(**{name: arrays[name].astype(kind)}).startswith(
                f"not covered: type of {name} "
            )
    for name in ("instance", "triangle", "tie_pixel", "tie_triangle", "mesh0_triangles"):
        assert f"type of {name} f8" in said(**{name: arrays[name].astype(float)})
    assert said(plane0_point=np.zeros(6)) == "plane0_point has the shape (6,)"
    assert said(instance0_world_from_object=np.eye(5)).endswith("has the shape (5, 5)")


def test_a_t_in_float32_hides_no_tie(make, tmp_path):
    """The middle ray meets an edge, and 1e-7 before clip end a surface, which the file leaves out.

    In float32 clip end itself is before that surface.
    """
    window = ViewWindow(-1, 1, -1, 1)
    camera = Camera(np.eye(4), window, 3, 1, ORTHOGRAPHIC, clip_start=0.5, clip_end=9.7)
    half, left, last = (
        Mesh(np.array(corners, float), [[0, 1, 2]])
        for corners in (
            [(0, -8, -2), (0, 8, -2), (8, 0, -2)],
            [(-20, -20, -4), (-0.3, -20, -4), (-0.3, 40, -4)],
            [(-20, -20, -9.6999999), (20, -20, -9.6999999), (0, 40, -9.6999999)],
        )
    )
    path = tmp_path / "c.npz"
    answers = certified(make.scene(camera, half, left, last), path)
    assert answers["t"].tolist() == [[4, 2, 2]] and answers["tie_instance"].tolist() == [0, 2]
    answers["tie_instance"] = np.array([0, -1])
    answers["tie_triangle"] = np.array([0, -1])
    np.savez(path, **answers)
    assert refusal(path).startswith("pixel (1, 0): the file says")
    np.savez(path, **(answers | {"t": answers["t"].astype(np.float32)}))
    assert refusal(path) == "not covered: type of t f4"


def test_keys_within_the_scenes_parts_are_refused_too(stored):
    path, arrays = stored

    def said(change) -> str:
        scene = json.loads(str(arrays["scene"]))
        change(scene)
        np.savez(path, **(arrays | {"scene": np.array(json.dumps(scene))}))
        return refusal(path)

    for part in ("meshes", "instances", "planes"):
        assert said(lambda s, p=part: s[p][0].update(hidden=True)) == (
            f"not covered: part of {part} hidden"
        )
    for part in ("window", "region"):
        assert said(lambda s, p=part: s["camera"][p].update(skew=1)) == (
            f"not covered: part of the {part} skew"
        )
    for region in ({"x1": 0}, {"y1": 0}, {"x0": -12, "x1": 0}, {"y0": 8, "y1": 16}):
        found = said(lambda s, r=region: s["camera"]["region"].update(r))
        assert found == "the region is empty, or not within the picture", region


def test_a_sample_of_no_rows_is_refused(stored):
    for rows in (0, -3):
        with pytest.raises(checker.RefusedError, match="at least one row"):
            checker.verified(str(stored[0]), rows)


def test_the_command(tmp_path, exit_code, capsys):
    out = tmp_path / "c.npz"
    scene = str(STORED / "exercise_triangle.npz")
    trace = ["trace", scene, "--rows", "100", "139"]
    assert exit_code([*trace, "--certificate", str(out)]) == AGREE
    assert exit_code(["verify", str(out)]) == AGREE
    assert "all 25,600 pixels see what it says" in capsys.readouterr().out
    assert exit_code(["verify", str(out), "--sample", "3"]) == AGREE
    assert "a sample, 3 of 40 rows: 1,920 pixels" in capsys.readouterr().out
    answers = arrays_of(out)
    answers["instance"][20, 30] += 1
    np.savez(out, **answers)
    assert exit_code(["verify", str(out)]) == DIFFERENCES
    assert "refused: pixel (30, 20)" in capsys.readouterr().out
    assert exit_code(["verify", scene]) == DIFFERENCES
    assert "is no certificate, or damaged" in capsys.readouterr().out
    assert exit_code(trace) == INPUT_ERROR
    assert exit_code([*trace, "--certificate", str(out), "--method", "textbook"]) == INPUT_ERROR
    said = capsys.readouterr().err
    assert "name a file to write" in said and "textbook proves nothing" in said
    assert exit_code(["verify", str(out.with_name("none.npz"))]) == INPUT_ERROR
    assert "there is no file" in capsys.readouterr().err
    out.write_bytes(out.read_bytes()[:300])
    assert exit_code(["verify", str(out)]) == DIFFERENCES
    assert f"'{out}' is no certificate, or damaged" in capsys.readouterr().out


def test_a_certificate_is_a_scene(stored):
    path, _ = stored
    assert load_scene(path).camera.width == 12


def test_it_refuses_to_check_where_floats_round_otherwise(stored, monkeypatch):
    monkeypatch.setattr(np, "ones", lambda n: np.full(n, 1 + 2.0**-52))
    with pytest.raises(checker.RefusedError, match="IEEE 754"):
        checker.verified(str(stored[0]))
