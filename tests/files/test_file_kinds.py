"""What a file is, where its name says something else: told by its first bytes, with what to do."""

from __future__ import annotations

import numpy as np
import pytest
from reference_tracer.files.file_kinds import check_is_file, mistaken
from reference_tracer.files.images import open_picture
from reference_tracer.files.scenes import load_scene, save_scene
from reference_tracer.scene import SceneError
from reference_tracer_meshes import FORMATS as READERS

SUFFIXES = *READERS, ".npz", ".blend", ".png", ".exr", ".json"
POINTER = b"version https://git-lfs.github.com/spec/v1\noid sha256:4d7a\nsize 12345\n"
PAGE = b"\xef\xbb\xbf\n<!DOCTYPE html>\n<html><head><title>404</title></head></html>"
CASES = {
    "pointer": (POINTER, SUFFIXES, "is a pointer of Git LFS.*`git lfs pull`"),
    "page": (PAGE, SUFFIXES, "is a web page: download the file itself"),
    "nothing": (b"", SUFFIXES, "is empty: save, copy or download it again"),
    "png": (b"\x89PNG\r\n\x1a\n", {*SUFFIXES} - {".png"}, "is a PNG picture: rename it"),
    "jpeg": (b"\xff\xd8\xff\xe0", SUFFIXES, "is a JPEG picture: save the picture as PNG"),
    "exr": (b"v/1\x01\x02", {*SUFFIXES} - {".exr"}, "is an EXR picture: rename it"),
    "blend": (b"BLENDER-v402", {*SUFFIXES} - {".blend"}, r"is a \.blend: rename it"),
    "glb": (b"glTF\2\0\0\0", {*SUFFIXES} - {".glb", ".gltf"}, r"is a \.glb: rename it"),
    "ply": (b"ply\r\nformat", {*SUFFIXES} - {".ply"}, r"is a \.ply: rename it"),
    "zip": (b"PK\3\4", {*SUFFIXES} - {".npz", ".usdz"}, "is a zip archive: unpack it"),
    "noise": (b"\3\1\4\1\5", (".blend", ".npz", ".png", ".exr"), r"is no \.\w+, as its first"),
}


@pytest.mark.parametrize("case", CASES)
def test_what_a_file_is_and_what_to_do(case, tmp_path):
    content, suffixes, says = CASES[case]
    for suffix in suffixes:
        path = tmp_path / f"file{suffix}"
        path.write_bytes(content)
        with pytest.raises(SceneError, match=f"^'[^'\\n]*file{suffix}' {says}[^\\n]*$"):
            check_is_file(path)


@pytest.mark.parametrize(
    ("name", "content"),
    [
        ("a.obj", b"# v/1\nv 0 0 0\n"),
        ("a.stl", b"BLENDER-export".ljust(84, b"\0")),  # 80 bytes of any text
        ("a.stl", b"BLENDER-export".ljust(80) + b"\1\0\0\0".ljust(54)),
        ("a.blend", b"\x28\xb5\x2f\xfd"),
        ("a.blend", b"\x1f\x8b"),
        ("a.BLEND", b"BLENDER17-01v0500"),
        ("a.gltf", b"glTF"),
        ("a.json", b"{}"),
    ],
)
def test_what_is_as_it_is_called_passes(name, content, tmp_path):
    (tmp_path / name).write_bytes(content)
    assert mistaken(tmp_path / name) == ""


def test_a_picture_that_is_none_is_named_so(tmp_path):
    (tmp_path / "a.png").write_bytes(POINTER)
    with pytest.raises(OSError, match=r"a\.png' is a pointer of Git LFS"):
        open_picture(tmp_path / "a.png")


def test_a_scene_that_is_cut_off_or_lacks_an_array_is_told_so(make, tmp_path):
    path = tmp_path / "a.npz"
    save_scene(path, make.scene(make.camera()))
    content = path.read_bytes()
    for end in (40, len(content) // 2, len(content) - 1):
        path.write_bytes(content[:end])
        with pytest.raises(SceneError, match=r"a\.npz' is cut off or damaged: copy it again"):
            load_scene(path)
    np.savez(path, other=np.zeros(3))
    with pytest.raises(SceneError, match=r"it has no array 'scene': `reftrace export` writes"):
        load_scene(path)
