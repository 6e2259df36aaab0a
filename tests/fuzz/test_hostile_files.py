"""Hostile files: each is read and can be traced, or is refused in a line that names it.

No other error, no warning, no process that dies, none that takes more memory than it may. Valid
files are changed at random, from a seed, and read in a process of their own.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections import Counter
from pathlib import Path

import numpy as np
import OpenEXR
import pytest
import trimesh
from PIL import Image
from reference_tracer.derivation import reproducer
from reference_tracer.derivation.candidates import gather_pixel
from reference_tracer.files import exr, images
from reference_tracer.files.certificates import save_certificate
from reference_tracer.files.scenes import save_scene
from reference_tracer.rendering import render
from reference_tracer.scene import Instance, Mesh, Plane, Scene
from reference_tracer.tracer.settings import Settings

from ..meshes import gltf_build

DAILY, LONG, AT_ONCE = 1_000, 100_000, 20_000
PICTURES, ARRAYS = {".png", ".exr"}, {".npz", ".npy"}
SUFFIXES = {*PICTURES, *ARRAYS, ".json", ".obj", ".ply", ".off", ".stl", ".glb", ".gltf"}


@pytest.fixture
def folder(make, tmp_path, rng):
    """Small valid files, of each format as it comes."""
    valid = tmp_path / "valid"
    valid.mkdir()
    quad = Mesh(rng.normal(size=(4, 3)), [[0, 1, 2], [0, 2, 3]], [0, 1], rng.random((2, 3, 4)))
    plain = Mesh(rng.normal(size=(3, 3)).astype(np.float32), [[0, 1, 2]], name="plain")
    instances = [Instance(k % 2, k % 2, np.eye(4), rng.random((2, 4))) for k in range(3)]
    planes = [Plane(1, (0, 0, -2), (0, 0, 1))]
    camera = make.camera(8, 8, eye=(0, 0, 5))
    scene = Scene(camera, (quad, plain), instances, planes, rng.random(4), ("A", "B"))
    save_scene(valid / "scene.npz", scene)
    frame = render(scene, Settings("certified"))
    save_certificate(valid / "certificate.npz", frame)
    np.save(valid / "depth.npy", frame.t)
    np.savez_compressed(valid / "depth.npz", depth=frame.t, objects=np.array(scene.objects))
    np.savez(valid / "rays.npz", origins=rng.normal(size=(9, 3)), directions=np.ones((1, 3)))
    text = reproducer.text(gather_pixel(scene, 4, 4, source="scene.npz"))
    (valid / "pixel.json").write_text(text)
    shape = trimesh.creation.box()
    for name in ("mesh.obj", "binary.ply", "binary.stl", "mesh.glb", "mesh.off"):
        shape.export(valid / name)
    shape.export(valid / "text.ply", encoding="ascii")
    shape.export(valid / "text.stl", file_type="stl_ascii")
    several = trimesh.Scene([shape, trimesh.creation.icosahedron()])
    several.export(valid / "several.glb")
    several.export(valid / "several.obj")
    (valid / "plain.gltf").write_text(gltf_build.plain().with_data_uri())
    picture = rng.integers(0, 256, (9, 11, 4), dtype=np.uint8)
    images.save_png(valid / "own.png", picture)
    Image.fromarray(picture[..., :3]).quantize(9).save(valid / "palette.png", transparency=1)
    Image.fromarray(rng.integers(0, 2**16, (9, 11), dtype=np.uint16)).save(valid / "grey.png")
    exr.save(valid / "own.exr", {"color": picture / np.float32(255), "depth": picture[..., 0]})
    halves = {c: rng.random((9, 11)).astype(np.float16) for c in "RGBA"}
    header = {"compression": OpenEXR.NO_COMPRESSION, "type": OpenEXR.scanlineimage}
    OpenEXR.File(header, halves).write(str(valid / "halves.exr"))
    assert {path.suffix for path in valid.iterdir()} == SUFFIXES
    return tmp_path


def run(folder: Path, seed: int, cases: int) -> tuple[Counter[str], list, int]:
    """Return how many were read and refused by format, what went wrong, and the most memory, KiB.

    The process is started again after what it dies of, which is a failure.
    """
    found, failures, memory, first = Counter(), [], 0, 0
    one_thread = dict.fromkeys(("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS"), "1")
    while first < cases:
        count = min(AT_ONCE, cases - first)
        command = [sys.executable, Path(__file__).with_name("child.py"), folder]
        done = subprocess.run(
            [*map(str, command), str(seed), str(first), str(count)],
            capture_output=True,
            text=True,
            env=os.environ | one_thread,
        )
        lines = [json.loads(line) for line in done.stdout.splitlines()]
        failures += [line for line in lines if "case" in line]
        if done.returncode == 0:
            found += Counter(lines[-1]["found"])
            memory = max(memory, lines[-1]["memory"])
            first += count
        else:
            assert (folder / "at").exists(), done.stderr
            first = int((folder / "at").read_text()) + 1
            failures.append(
                {"died": first - 1, "code": done.returncode, "said": done.stderr[-999:]}
            )
            assert len(failures) < 500, failures[-9:]
    return found, failures, memory


def check(found: Counter[str], failures: list, cases: int) -> None:
    assert not failures
    assert found.total() == cases
    assert {name.split()[0] for name in found} == SUFFIXES
    assert all(found[f"{s} read"] and found[f"{s} refused"] for s in SUFFIXES), found


def test_hostile_files(folder):
    found, failures, _ = run(folder, 13, DAILY)
    check(found, failures, DAILY)


@pytest.mark.torture
def test_very_many_hostile_files(folder, capsys):
    cases = int(os.environ.get("CASES", LONG))
    found, failures, memory = run(folder, int(os.environ.get("SEED", 14)), cases)
    with capsys.disabled():
        print(
            f"\n{cases:,} hostile files: {len(failures)} failures, {memory / 1024:.0f} MiB at most"
        )
        print(*(f"{name}: {number:,}" for name, number in sorted(found.items())), sep=", ")
        print(*failures, sep="\n")
    check(found, failures, cases)
