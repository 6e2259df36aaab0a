"""What the tests of certificates share: scenes, and files that are changed."""

from __future__ import annotations

import numpy as np
from reference_tracer.files.certificates import save_certificate
from reference_tracer.projections import EQUIRECTANGULAR, PROJECTIONS
from reference_tracer.rendering import render
from reference_tracer.scene import Camera, Instance, Mesh, Plane, Region, Scene, ViewWindow
from reference_tracer_verify.verify import Certificate, RefusedError, check

from ..certified.test_definition import lattice_scene
from ..tracer.hostile_scenes import hostile_scene, scaled


def scene_of(make, seed: int) -> Scene:
    """A small scene: on a lattice, or hostile, also near the ends of float64, and panoramas."""
    if seed % 3 == 0:
        scene = lattice_scene(seed // 3)
        if seed % 4:
            return scene
        camera = Camera(np.eye(4), ViewWindow(-3, 3, -1.5, 1.5), 12, 8, EQUIRECTANGULAR, 0.5, 9.0)
        return scene.seen_by(camera)
    rng = np.random.default_rng(seed)
    scene = hostile_scene(make, rng, finite=seed % 7 == 0)
    return scaled(scene, 2.0 ** float(rng.choice([-500, -300, 300]))) if seed % 7 == 0 else scene


def arrays_of(path) -> dict[str, np.ndarray]:
    """Return the arrays of a file."""
    with np.load(path) as file:
        return {name: file[name] for name in file.files}


def scene_in(arrays: dict[str, np.ndarray]) -> Scene:
    """Return the scene of a certificate's arrays, a mesh for each instance."""
    (x0, x1, width), (y0, y1, height) = arrays["pixels"].tolist()
    camera = Camera(
        arrays["world_from_camera"],
        ViewWindow(*arrays["window"].ravel().tolist()),
        width,
        height,
        PROJECTIONS[str(arrays["camera"])],
        clip_start=float(arrays["clip"][0]),
        clip_end=float(arrays["clip"][1]),
        region=Region(x0, y0, x1, y1),
    )
    triangles = [arrays["triangles"][a:b] for a, b in arrays["instances"]]
    matrices = arrays["world_from_object"]
    return Scene(
        camera,
        tuple(Mesh(arrays["vertices"], of) for of in triangles),
        tuple(Instance(k, k, matrix) for k, matrix in enumerate(matrices)),
        tuple(Plane(len(matrices), point, normal) for point, normal in arrays["planes"]),
        objects=("of all planes", *map(str, range(len(matrices)))),
    )


def certified(scene: Scene, path) -> dict[str, np.ndarray]:
    """Write the certificate of a scene; return its arrays."""
    save_certificate(path, render(scene))
    return arrays_of(path)


def refusal(path) -> str:
    """Check a certificate; return why it is refused, "" for a true one."""
    try:
        certificate = Certificate(str(path))
        check(certificate, range(len(certificate.t)))
    except RefusedError as error:
        return str(error)
    return ""
