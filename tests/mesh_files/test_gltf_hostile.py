"""glTF files changed at random: each is read, or refused in a line; none takes much memory."""

from __future__ import annotations

import os
import tracemalloc
import warnings
from collections import Counter

import numpy as np
import pytest
from reference_tracer.mesh_files.gltf import accessors, read_gltf
from reference_tracer.scene import SceneError

from ..fuzz.mutations import changed, damaged
from .gltf_build import Build, glb, rich

DAILY, LONG = 500, 100_000
FREE = 1 << 25  # bytes that the reader is told are free
MOST = 3 * FREE  # that a case may take: a part may fit by itself, and its copy, too


def hostile(build: Build, rng: np.random.Generator) -> bytes:
    """Change the JSON, or bytes of the whole file."""
    content = glb(build.json, bytes(build.data))
    if rng.random() < 0.15:
        return damaged(content, rng, content)
    value = build.json
    for _ in range(rng.geometric(0.7)):
        value = changed(value, rng)
    return glb(value, bytes(build.data))


def run(folder, seed: int, cases: int) -> Counter[str]:
    found: Counter[str] = Counter()
    build, path = rich(), folder / "a.glb"
    for case in range(cases):
        path.write_bytes(hostile(build, np.random.default_rng((seed, case))))
        tracemalloc.reset_peak()
        try:
            contents = read_gltf(path)
            found["read"] += 1
            for mesh, matrix, name in contents.placed:
                assert np.isfinite(mesh.vertices).all() and np.isfinite(matrix).all()
                assert name.isprintable() and len(mesh.triangles)
            assert all(note.isprintable() for note in contents.notes)
        except SceneError as error:
            found["refused"] += 1
            said = str(error)
            assert said.isprintable() and 10 < len(said) < 400, (case, said)
        assert tracemalloc.get_traced_memory()[1] < MOST, case
    return found


@pytest.fixture
def little_memory(monkeypatch):
    monkeypatch.setattr(accessors, "free_memory", lambda: FREE)
    tracemalloc.start()
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        yield
    tracemalloc.stop()


def test_the_file_that_is_changed_can_be_read(tmp_path):
    contents = read_gltf(rich().write(tmp_path / "a.glb"))
    assert len(contents.placed) == 6 and len(contents.notes) == 1


def test_hostile_files(little_memory, tmp_path):
    found = run(tmp_path, 21, DAILY)
    assert min(found["read"], found["refused"]) > DAILY / 20 and found.total() == DAILY, found


@pytest.mark.torture
def test_very_many_hostile_files(little_memory, tmp_path, capsys):
    cases = int(os.environ.get("CASES", LONG))
    found = run(tmp_path, int(os.environ.get("SEED", 22)), cases)
    with capsys.disabled():
        print(f"\n{cases:,} hostile glTF files: {dict(found)}")
    assert found.total() == cases


@pytest.mark.parametrize("kind", ["corners", "indices", "instances", "joints", "targets"])
def test_what_takes_too_much_memory_is_refused(kind, little_memory, tmp_path):
    """Numbers that are all zero need no data, so a small file may ask for many."""
    build = rich()
    many = {"componentType": 5126, "count": 10**8, "type": "VEC3"}
    primitive = build.json["meshes"][0]["primitives"][0]
    attributes = primitive["attributes"]
    if kind == "corners":
        attributes["POSITION"] = build.add("accessors", **many)
    elif kind == "indices":
        indices = many | {"componentType": 5121, "type": "SCALAR", "count": 3 * 10**6}
        primitive["indices"] = build.add("accessors", **indices)
    elif kind == "instances":
        extension = build.json["nodes"][3]["extensions"]["EXT_mesh_gpu_instancing"]
        extension["attributes"] = {"TRANSLATION": build.add("accessors", **many | {"count": 10**5})}
    elif kind == "joints":
        joints = many | {"componentType": 5121, "type": "VEC4"}
        attributes["JOINTS_0"] = build.add("accessors", **joints)
    else:
        primitive["targets"][0]["POSITION"] = build.add("accessors", **many)
    with pytest.raises(SceneError, match="GiB, more than is free"):
        read_gltf(build.write(tmp_path / "a.glb"))
    assert tracemalloc.get_traced_memory()[1] < MOST
