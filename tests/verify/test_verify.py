"""The checker agrees with the definition and the tracer, alone, and names what it does not know."""

from __future__ import annotations

import ast
import subprocess
import sys
import tracemalloc
import zipfile
from dataclasses import replace
from itertools import permutations
from pathlib import Path

import numpy as np
import pytest
import reference_tracer_verify.verify as checker
from reference_tracer.certified.definition import definition
from reference_tracer.cli.parser import AGREE, DIFFERENCES, INPUT_ERROR
from reference_tracer.projections import EQUIRECTANGULAR, ORTHOGRAPHIC, PROJECTIONS
from reference_tracer.scene import Camera, Mesh, ViewWindow

from ..certified.test_definition import small
from ..tracer.hostile_scenes import scene_of_integers
from .certificates import arrays_of, certified, refusal, scene_of
from .mutants import MUTANTS

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
        ambiguous += len(np.unique(answers["ties"][:, 0]))
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


def test_what_is_seen_through_a_narrow_gap_is_a_tie(make, tmp_path):
    """The ray meets a corner; around it, but for less than a degree, there are triangles."""
    around = (0, 0, -2), (8, 0, -2), (-8, 8, -2), (-8, -8, -2), (8, -0.1, -2)
    fan = Mesh(np.array(around) * 1.0, [[0, 1, 2], [0, 2, 3], [0, 3, 4]])
    behind = Mesh(np.array([(-8, -8, -3), (8, -8, -3), (0, 8, -3)]) * 1.0, [[0, 1, 2]])
    camera = Camera(np.eye(4), ViewWindow(-1, 1, -1, 1), 1, 1, ORTHOGRAPHIC)
    answers = certified(make.scene(camera, fan, behind), tmp_path / "c.npz")
    assert not refusal(tmp_path / "c.npz")
    assert answers["ties"].tolist() == [[0, 0, 0], [0, 0, 1], [0, 0, 2], [0, 1, 0]]


def test_corners_are_rounded_in_the_order_of_the_page(make, tmp_path):
    """Turned and scaled instances, of which two have a corner that is not finite."""
    rng = np.random.default_rng(5)
    corners = rng.uniform(-1, 1, (12, 3))
    corners[[0, 4]] = 1e308
    mesh = Mesh(corners, np.arange(12).reshape(4, 3))
    scene = make.scene(make.camera(12, 8), mesh, mesh, mesh)
    matrices = [np.eye(4), np.eye(4), np.eye(4)]
    for matrix in matrices:
        matrix[:3, :3] = rng.uniform(-2.5, 2.5, (3, 3))
        matrix[:3, 3] = *rng.uniform(-0.3, 0.3, 2), -4
    placed = zip(scene.instances, matrices, strict=True)
    instances = tuple(replace(i, world_from_object=m) for i, m in placed)
    answers = certified(replace(scene, instances=instances), tmp_path / "c.npz")
    assert not refusal(tmp_path / "c.npz")
    assert len(np.unique(answers["seen"].reshape(-1, 2), axis=0)) > 4


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
        assert len(answers["ties"]) == len(sheets)
        owners.add(order[int(answers["seen"][0, 0, 0])])
    assert len(owners) == 1


def test_in_small_parts(make, tmp_path, monkeypatch):
    """However few pixels or pairs are looked at together: fewer than a row has, too."""
    monkeypatch.setattr(checker, "PAIRS", 5)
    for pixels in (30, 5):
        monkeypatch.setattr(checker, "PIXELS", pixels)
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
        arrays["seen"] = np.array([s.name for s in seen]).reshape(*shape, 2)
        arrays["t"] = np.array([s.t for s in seen]).reshape(shape)
        rows = [(k, *name) for k, s in enumerate(seen) for name in s.ties]
        arrays["ties"] = np.array(rows, np.int64).reshape(-1, 3)
        np.savez(path, **arrays)
        assert not refusal(path), seed
        ambiguous += len(set(arrays["ties"][:, 0].tolist()))
    assert ambiguous > 40


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
    assert done.returncode == 2 and "pixel (2, 1): the file says" in done.stderr, done


def test_each_wrong_version_is_one_of_this_text():
    """The list is run by itself (`tests.verify.mutants`); docs/certificate.md says how many."""
    text = FILE.read_text("utf-8")
    tree = ast.dump(ast.parse(text))
    for mutant in MUTANTS:
        assert ast.dump(ast.parse(text.replace(mutant.old, mutant.new, 1))) != tree, mutant
    said = (STORED.parents[2] / "docs" / "certificate.md").read_text("utf-8")
    wrong = sum(m.is_wrong for m in MUTANTS)
    assert f"of the {len(MUTANTS)} in" in said and f"tests notice {wrong};" in said


def test_it_imports_numpy_alone_and_is_short():
    text = FILE.read_text("utf-8")
    tree = ast.parse(text)
    imports = [node for node in ast.walk(tree) if isinstance(node, (ast.Import, ast.ImportFrom))]
    names = {n.module if isinstance(n, ast.ImportFrom) else n.names[0].name for n in imports}
    outside = {name for name in names if name.partition(".")[0] not in sys.stdlib_module_names}
    assert outside == {"numpy"} and not any(getattr(n, "level", 0) for n in imports)
    code = ast.unparse(_without_docstrings(tree))  # without comments, one statement a line
    assert len([line for line in code.splitlines() if line]) <= 310


def _without_docstrings(tree: ast.Module) -> ast.Module:
    for node in ast.walk(tree):
        if isinstance(node, (ast.Module, ast.ClassDef, ast.FunctionDef)) and ast.get_docstring(
            node
        ):
            node.body = node.body[1:] or [ast.Pass()]
    return tree


def test_what_it_does_not_know_is_refused_by_name(stored):
    path, arrays = stored

    def said(**changed) -> str:
        np.savez(path, **(arrays | changed))
        return refusal(path)

    def but(name, at, value):
        array = arrays[name].copy()
        array[at] = value
        return {name: array}

    assert said() == ""
    assert said(spheres=np.zeros(3)) == "not covered: array spheres"
    assert said(camera=np.array("fisheye")) == "not covered: camera fisheye"
    older = "reference_tracer.certificate/1"
    assert said(certificate=np.array(older)) == f"not covered: schema {older}"
    for vertex in (24, -1):
        assert said(**but("triangles", (0, 0), vertex)) == f"not covered: vertex {vertex}"
    for triangle in (len(arrays["triangles"]) + 1, -1):
        assert said(**but("instances", 0, triangle)) == f"not covered: triangle {triangle}"
    assert said(seen=arrays["seen"][1:]) == "not covered: answers (7, 12)"
    assert said(t=arrays["t"][:, 1:]) == "not covered: answers (8, 11)"
    for pixel in (-1, arrays["t"].size):
        ties = np.array([(pixel, 0, 0)])
        assert said(ties=ties) == f"not covered: tie of pixel {pixel}"


def test_an_array_that_is_there_twice_is_refused(stored):
    """Which of the two is read would be the reader's choice."""
    path, _ = stored
    with zipfile.ZipFile(path) as file:
        t = file.read("t.npy")
    with zipfile.ZipFile(path, "a") as file, pytest.warns(UserWarning, match="Duplicate name"):
        file.writestr("t.npy", t)
    assert refusal(path) == "an array is in the file twice"


def test_a_picture_larger_than_its_answers_is_refused_before_it_is_made(stored):
    """A file of a kilobyte said that it has 2^40 columns: so much memory was asked for."""
    path, arrays = stored
    for width in (2**28, 2**40, 2**63 - 1):
        np.savez(path, **(arrays | {"pixels": np.array([(0, width, width), (0, 8, 8)])}))
        tracemalloc.start()
        assert refusal(path) == "not covered: answers (8, 12), (8, 12)"
        _, peak = tracemalloc.get_traced_memory()
        tracemalloc.stop()
        assert peak < 2**24


def test_an_instance_that_ends_before_it_begins_is_refused(stored):
    path, arrays = stored
    arrays["instances"][0] = arrays["instances"][0, ::-1].copy()
    np.savez(path, **arrays)
    assert refusal(path) == "an instance ends before it begins"


def test_a_refusal_is_short(stored):
    path, arrays = stored
    np.savez(path, **(arrays | {"triangles": np.arange(3000).reshape(-1, 3)}))
    assert refusal(path).startswith("not covered: vertex 24, 25, ") and len(refusal(path)) < 99


def test_a_panorama_of_too_many_turns_is_refused(make, tmp_path):
    """Of such angles the series is no sine: at 10^22 radians a "sine" was 10^94."""
    camera = Camera(np.eye(4), ViewWindow(0, 1, 0, 1), 2, 1, EQUIRECTANGULAR)
    arrays = certified(make.scene(camera), tmp_path / "c.npz")
    for far, said in ((2.0**20, ""), (2.0**21, "an angle is beyond 2^20 radians")):
        for k in (0, 1):
            arrays["window"][:] = (0, 1), (0, 1)
            arrays["window"][k, 0] = -far
            np.savez(tmp_path / "c.npz", **arrays)
            assert refusal(tmp_path / "c.npz") == said, (far, k)


@pytest.mark.filterwarnings("error")
def test_numpy_does_not_warn_of_what_overflows(make, tmp_path):
    """Nothing is seen, without a clip end: what is above the largest float64?"""
    certified(make.scene(make.camera(2, 1, clip_end=np.inf)), tmp_path / "c.npz")
    assert not refusal(tmp_path / "c.npz")


def test_ranges_that_are_empty_or_endless_are_refused(stored):
    path, arrays = stored

    def said(name, value) -> str:
        np.savez(path, **(arrays | {name: np.array(value)}))
        return refusal(path)

    for clip in ((2.0, 2.0), (3.0, 2.0), (np.nan, 2.0), (1.0, np.inf), (-np.inf, 1.0)):
        assert said("clip", clip) == "the clip range is empty or endless", clip
    for x0, x1, width in ((0, 0, 12), (-12, 0, 12), (12, 24, 12), (0, 13, 12)):
        found = said("pixels", [(x0, x1, width), (0, 8, 8)])
        assert found == "the region is empty, or not within the picture", (x0, x1)
    assert said("window", [(np.nan, 1.0), (-1.0, 1.0)]) == "a ray or a plane is not finite"
    planes = np.array(arrays["planes"])
    planes[0, 0, 1] = np.inf
    assert said("planes", planes) == "a ray or a plane is not finite"


def test_numbers_of_another_type_are_refused(stored):
    """What rounds otherwise than the page says, or is no number at all."""
    path, arrays = stored

    def said(name, changed) -> str:
        np.savez(path, **(arrays | {name: changed}))
        return refusal(path)

    wide = np.dtype(np.longdouble).str[1:]  # long doubles are doubles on some machines
    for name in checker.ARRAYS:
        known = arrays[name].dtype.str[1:]
        for kind in sorted({"f4", "U1", "c16", "M8[s]", "i4", "u8", "i8", "f8", wide} - {known}):
            found = said(name, np.zeros(arrays[name].shape, kind))
            assert found.startswith(f"{name} is of {kind} "), (name, kind)
        for other in (arrays[name][None], arrays[name][..., None], arrays[name].sum(axis=0)):
            assert said(name, other).startswith(f"{name} is of {known}"), (name, other.shape)


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
    assert answers["t"].tolist() == [[4, 2, 2]] and answers["ties"][:, 1].tolist() == [0, 2]
    answers["ties"] = np.array([(1, 0, 0), (1, -1, -1)])
    np.savez(path, **answers)
    assert refusal(path).startswith("pixel (1, 0): the file says")
    np.savez(path, **(answers | {"t": answers["t"].astype(np.float32)}))
    assert refusal(path).startswith("t is of f4 1 3")


@pytest.mark.parametrize("arranged", [np.ascontiguousarray, np.asfortranarray])
def test_a_t_in_another_order_hides_no_tie(arranged, make, tmp_path):
    """Two halves end where the first ray passes, so that it may see what is behind both."""
    near, half, behind = (
        Mesh(np.array(corners, float), [[0, 1, 2]])
        for corners in (
            [(0.5, -9, -1), (0.5, 9, -1), (-9, 0.25, -1)],
            [(0.5, 0.5, -2), (9, 0.5, -2), (0.5, 9, -2)],
            [(-20, -20, -3), (20, -20, -3), (0, 40, -3)],
        )
    )
    camera = Camera(np.eye(4), ViewWindow(0, 2, 0, 2), 2, 2, ORTHOGRAPHIC, clip_start=0.5)
    path = tmp_path / "c.npz"
    answers = certified(make.scene(camera, near, half, behind), path)
    answers["t"] = arranged(answers["t"])
    np.savez(path, **answers)
    assert not refusal(path)
    farthest = np.flatnonzero(answers["ties"][:, 1] == 2)
    assert len(farthest)
    for row in farthest.tolist():
        ties = answers["ties"].copy()
        ties[row, 1:] = -1
        np.savez(path, **(answers | {"ties": ties}))
        pixel = tuple(int(v) for v in divmod(ties[row, 0], 2)[::-1])
        assert refusal(path).startswith(f"pixel {pixel}: the file says")


@pytest.mark.parametrize("projection", PROJECTIONS.values(), ids=PROJECTIONS)
def test_a_picture_of_one_pixel(projection, make, tmp_path):
    """It has one direction, as parallel rays have, but not that of the camera's axis."""
    mesh = Mesh(np.array([(4, 4, -5), (6, 4, -5), (5, 6, -5)]) * 1.0, [[0, 1, 2]])
    reach = 10 if projection is ORTHOGRAPHIC else 2
    camera = Camera(np.eye(4), ViewWindow(0, reach, 0, reach), 1, 1, projection)
    if projection is EQUIRECTANGULAR:
        camera = replace(camera, window=ViewWindow(0.6, 0.9, 0.5, 0.7))
    path = tmp_path / "c.npz"
    answers = certified(make.scene(camera, mesh), path)
    assert answers["seen"].tolist() == [[[0, 0]]] and not refusal(path)
    answers["seen"][:], answers["t"][:] = -1, np.inf
    np.savez(path, **answers)
    assert refusal(path).startswith("pixel (0, 0): the file says ((-1, -1)")


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
    answers["seen"][20, 30, 0] += 1
    np.savez(out, **answers)
    assert exit_code(["verify", str(out)]) == DIFFERENCES
    assert "refused: pixel (30, 20)" in capsys.readouterr().out
    for other in (scene, __file__):
        assert exit_code(["verify", other]) == INPUT_ERROR
        assert f"'{other}' is no certificate" in capsys.readouterr().err
    assert exit_code(trace) == INPUT_ERROR
    assert exit_code([*trace, "--certificate", str(out), "--method", "textbook"]) == INPUT_ERROR
    said = capsys.readouterr().err
    assert "name a file to write" in said and "textbook proves nothing" in said
    assert exit_code(["verify", str(out.with_name("none.npz"))]) == INPUT_ERROR
    assert "there is no file" in capsys.readouterr().err
    out.write_bytes(out.read_bytes()[:300])
    assert exit_code(["verify", str(out)]) == DIFFERENCES
    assert f"'{out}' is damaged, or not of" in capsys.readouterr().out


def test_it_refuses_to_check_where_floats_round_otherwise(stored, monkeypatch):
    monkeypatch.setattr(np, "ones", lambda n: np.full(n, 1 + 2.0**-52))
    with pytest.raises(checker.RefusedError, match="IEEE 754"):
        checker.verified(str(stored[0]))
