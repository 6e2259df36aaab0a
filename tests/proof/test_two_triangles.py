"""What Coq computes of a scene of two triangles is what Python answers: TwoTriangles.v."""

from __future__ import annotations

import re

import numpy as np
import prove
from reference_tracer.certified.definition import definition
from reference_tracer.rendering import render
from reference_tracer.scene import Mesh, ViewWindow
from reference_tracer.tracer.camera import camera_rays
from reference_tracer.tracer.settings import Settings

TEXT = (prove.PROOFS / "further" / "TwoTriangles.v").read_text(encoding="utf-8")


def numbers(name: str) -> list[int]:
    """Return the numbers of a definition of the file, in their order."""
    [text] = re.findall(
        rf"^Definition {name} :=(.*?)\.\s", TEXT.replace("Integers.", ""), re.M | re.S
    )
    return [int(n) for n in re.findall(r"-?\d+", re.sub(r"\w*[A-Za-z_]\w*", " ", text))]


def test_owner_and_t_are_what_coq_says(make):
    meshes = [
        Mesh(np.reshape(numbers(name), (3, 3)) / 16, [[0, 1, 2]], name=name)
        for name in ("far", "near")
    ]
    window = ViewWindow(-0.25, 0.5, -0.5, 0.25)  # its one pixel is at (1 / 8, -1 / 8)
    camera = make.camera(1, 1, window=window, clip_start=1 / 16, clip_end=100)
    scene = make.scene(camera, *meshes)
    rays = camera_rays(camera, np.array([0.5]), np.array([0.5]))
    assert (rays.origins.ravel() * 16).tolist() == numbers("from")
    assert (rays.directions.ravel() * 16).tolist() == numbers("along")
    assert np.abs(rays.directions.ravel() * 16).tolist() == numbers("reach")
    frame = render(scene, Settings("certified"))
    m, e = numbers("t_of_near")
    assert frame.instance_index.item() == 1
    assert frame.t.item() == m * 2.0**e
    [seen] = definition(scene)
    assert seen.name == (1, 0) and seen.t == m * 2.0**e and not seen.ties


def test_the_integers_are_of_the_same_scene():
    for name in ("far", "near"):
        assert numbers(f"hit_{name}") == numbers("along") + numbers(name)
        clip = [1, 16, 100, 1]  # from 1 / 16 to 100, as the scene's
        named = [int(name == "near"), 0]
        assert numbers(f"checked_{name}") == clip + named + numbers("along") + numbers(name)
