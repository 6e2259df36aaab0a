"""Digests of what is exported and traced of all sample scenes: equal before and after a change.

    python tools/digests.py --out before.json      # then change the code
    python tools/digests.py --against before.json  # names each array that is another

Every scene is traced as it is, through an orthographic camera, and certified with 3 x 3 samples;
by every method, in both precisions. An array's digest is of its bytes, so that a difference in the
last bit of one pixel shows. Digests are of one machine and one numpy: take both on the same.
"""

import argparse
import hashlib
import json
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
from reference_tracer.cli.opening import open_blend
from reference_tracer.methods import Method
from reference_tracer.projections import ORTHOGRAPHIC
from reference_tracer.rendering import render
from reference_tracer.scene import Camera, Region, Scene, ViewWindow
from reference_tracer.tracer.settings import Settings

SCENES = Path(__file__).resolve().parent.parent / "sample_scenes"
PIXELS = 120_000  # of a plain picture: its pairs are many in the large scenes


def digest(array: np.ndarray) -> str:
    array = np.ascontiguousarray(array)
    head = f"{array.dtype.str} {array.shape} ".encode()
    return hashlib.sha256(head + array.tobytes()).hexdigest()[:16]


def exported(path: Path) -> Scene:
    from reference_tracer.blender.jobs.compare import export_open_file

    with open_blend(path) as bpy:
        return export_open_file(bpy.context)[0]


def orthographic(scene: Scene) -> Scene:
    """The scene through an orthographic camera that shows what the perspective one does."""
    camera = scene.camera
    if camera.projection.shares_direction:
        return scene
    depth = np.median(depths) if len(depths := _depths(scene)) else 10.0
    window = ViewWindow(*(float(v * depth) for v in vars(camera.window).values()))
    return replace(scene, camera=replace(camera, window=window, projection=ORTHOGRAPHIC))


def _depths(scene: Scene) -> np.ndarray:
    t = render(scene, Settings("textbook")).t
    return t[np.isfinite(t)]


def small(scene: Scene) -> Scene:
    """The scene with a region of at most so many pixels, about the picture's middle."""
    camera: Camera = scene.camera
    r = camera.region
    rows = max(1, min(r.height, PIXELS // r.width))
    y = r.y0 + (r.height - rows) // 2
    return replace(scene, camera=replace(camera, region=Region(r.x0, y, r.x1, y + rows)))


def of_scene(scene: Scene) -> dict[str, str]:
    out = {
        "background": digest(scene.background),
        "camera": digest(np.array([*scene.camera.world_from_camera.ravel()])),
        "window": digest(np.array([*vars(scene.camera.window).values()], np.float64)),
        "matrices": digest(scene.instance_matrices),
    }
    for k, mesh in enumerate(scene.meshes):
        out[f"mesh {k}"] = digest(mesh.vertices) + digest(mesh.triangles) + digest(mesh.slots)
    for k, plane in enumerate(scene.planes):
        out[f"plane {k}"] = digest(np.r_[plane.point, plane.normal])
    return out


def of_frame(scene: Scene, settings: Settings) -> dict[str, str]:
    frame = render(scene, settings)
    names = ("color", "t", "barycentrics", "instance_index", "triangle_index", "certainty")
    out = {name: digest(getattr(frame, name)) for name in names}
    ties = sorted((int(k), sorted(map(tuple, v))) for k, v in frame.ties.items())
    out["ties"] = hashlib.sha256(repr(ties).encode()).hexdigest()[:16]
    reasons = sorted((r.name, n) for r, n in frame.statistics.reasons.items())
    out["reasons"] = repr([*reasons, frame.statistics.refused])
    return out


def pictures() -> dict[str, dict[str, str]]:
    out = {}
    plain = [Settings(m, p) for m in Method if not m.is_proven for p in ("float32", "float64")]
    for path in sorted(SCENES.glob("*.blend")):
        scene = exported(path)
        out[path.stem] = of_scene(scene)
        for camera, seen in (("as it is", scene), ("orthographic", orthographic(scene))):
            out[f"{path.stem}, {camera}, certified"] = of_frame(seen, Settings("certified"))
            part = small(seen)
            out[f"{path.stem}, {camera}, 3 x 3"] = of_frame(part, Settings("certified", samples=3))
            for s in plain:
                name = f"{path.stem}, {camera}, {s.method} {s.precision}"
                out[name] = of_frame(part, s)
        print(path.stem, file=sys.stderr, flush=True)
    return out


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=Path, help="write the digests here")
    parser.add_argument("--against", type=Path, help="compare with what was written before")
    options = parser.parse_args()
    now = pictures()
    if options.out:
        options.out.write_text(json.dumps(now, indent=1) + "\n", encoding="utf-8")
    if not options.against:
        return 0
    before = json.loads(options.against.read_text(encoding="utf-8"))
    changed = [
        f"{picture}: {name}"
        for picture in sorted(before.keys() | now.keys())
        for name in sorted(before.get(picture, {}).keys() | now.get(picture, {}).keys())
        if before.get(picture, {}).get(name) != now.get(picture, {}).get(name)
    ]
    count = sum(map(len, now.values()))
    print(*changed, f"{count - len(changed)} of {count} digests are equal", sep="\n")
    return 1 if changed else 0


if __name__ == "__main__":
    sys.exit(main())
