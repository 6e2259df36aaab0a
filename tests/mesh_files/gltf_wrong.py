"""Changes that make a small glTF file wrong."""

from __future__ import annotations

import numpy as np
import pytest
from reference_tracer.mesh_files.gltf import read_gltf
from reference_tracer.scene import SceneError


def refused(path, pattern):
    with pytest.raises(SceneError, match=pattern) as found:
        read_gltf(path)
    assert "\n" not in str(found.value) and len(str(found.value)) < 300


def edit(kind, /, **changes):
    """Change the first of a list of the file's things."""

    def change(build):
        build.json[kind][0] |= changes

    return change


def primitive(**changes):
    def change(build):
        build.json["meshes"][0]["primitives"][0] |= changes

    return change


def whole(**changes):
    def change(build):
        build.json |= changes

    return change


def sparse(**changes):
    """Make the positions sparse, with something wrong."""

    def change(build):
        parts = {
            "count": 2,
            "indices": {"bufferView": build.view(bytes([1, 2])), "componentType": 5121},
            "values": {"bufferView": build.view(bytes(24))},
        }
        build.json["accessors"][0]["sparse"] = parts | changes

    return change


def positions(values, **more):
    def change(build):
        number = build.accessor(values, **more)
        build.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = number

    return change


def indices(*values, dtype=np.uint8, **more):
    def change(build):
        number = build.accessor(np.array(values, dtype), **more)
        build.json["meshes"][0]["primitives"][0]["indices"] = number

    return change


def instanced(**attributes):
    def change(build):
        held = {key: build.accessor(np.float32(values)) for key, values in attributes.items()}
        extension = {"EXT_mesh_gpu_instancing": {"attributes": held}}
        build.json["nodes"][0]["extensions"] = extension

    return change


def requiring(*names):
    def change(build):
        for name in names:
            build.extension(name, required=True)

    return change
