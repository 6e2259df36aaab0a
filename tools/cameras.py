"""How far camera files are off, in pixels, in the code of other programs: one table.

    make cameras             COLMAP's, Mitsuba's, OpenCV's, pyrender's code
    make cameras OPEN3D=1    Open3D's, too, whose wheel has 400 MB

What is judged, over a camera's settings, is the largest distance over known points from Blender's
own matrix. The programs are installed from their wheels into out/cameras, and read the files by
themselves. The exit code is 1 if one is farther off than float32 allows.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
import tempfile
import venv
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from matrix import table

PROJECT = Path(__file__).resolve().parents[1]
CHILD = PROJECT / "tools" / "cameras_child.py"
PLACE = PROJECT / "out" / "cameras"  # the programs' own environment
WHEELS = {
    "colmap": "pycolmap==4.2.1",
    "mitsuba": "mitsuba==3.9.1",
    "opencv": "opencv-python-headless==5.0.0.93",
    "nerf": "pyrender==0.1.45",  # whose camera is told by these numbers
    "open3d": "open3d==0.20.0",
}
# Pixels: Blender's matrix and Mitsuba's and Open3D's rays are float32.
ALLOWED = 1e-2


def scaled_parent(scene: Any, camera: Any) -> None:
    import bpy

    parent = bpy.data.objects.new("Parent", None)
    scene.collection.objects.link(parent)
    parent.location, parent.rotation_euler, parent.scale = (2, 1, -1), (0.3, 0.7, 0), (2, 2, 2)
    camera.parent = parent


def set_all(**values: Any) -> Callable[[Any, Any], None]:
    """A function that sets properties of the camera's data, of the render, or of the object."""

    def change(scene: Any, camera: Any) -> None:
        for name, value in values.items():
            places = camera.data, scene.render, camera
            setattr(next(p for p in places if hasattr(p, name)), name, value)

    return change


BORDER = {
    "use_border": True,
    "use_crop_to_border": True,
    "border_min_x": 0.25,
    "border_max_x": 0.8,
    "border_min_y": 0.1,
    "border_max_y": 0.55,
}
SETTINGS = {
    "plain": set_all(),
    "portrait": set_all(resolution_x=360, resolution_y=640),
    "fit vertical": set_all(sensor_fit="VERTICAL", sensor_height=20),
    "37 %": set_all(resolution_percentage=37),
    "parent": scaled_parent,
    "shift": set_all(shift_x=0.3, shift_y=-0.2),
    "border": set_all(**BORDER),
    "pixel aspect": set_all(pixel_aspect_y=1.5),
    "orthographic": set_all(type="ORTHO", ortho_scale=5),
    "mirrored": set_all(scale=(-1, 1, 1)),
}


def scene_cameras() -> dict[str, Any]:
    """A camera of Blender's with each setting, and where Blender's matrix has points."""
    import bpy
    from reference_tracer.blender.jobs.cameras import cameras

    found = {}
    for name, change in SETTINGS.items():
        bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
        scene: Any = bpy.context.scene
        camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
        scene.collection.objects.link(camera)
        scene.camera = camera
        camera.location, camera.rotation_euler = (1.3, -2.1, 0.7), (1.1, 0.1, 0.6)
        camera.data.lens, camera.data.clip_start, camera.data.clip_end = 41, 0.5, 50
        scene.render.resolution_x, scene.render.resolution_y = 640, 360
        scene.render.resolution_percentage = 100
        change(scene, camera)
        (found[name],) = cameras()
    return found


def written(names: list[str], folder: Path) -> list[dict[str, Any]]:
    """Write all files that conventions have of the settings; return the cases for the programs."""
    from reference_tracer.camera_files.files import CONVENTIONS, texts

    cases = []
    for setting, own in scene_cameras().items():
        camera = own.view.camera
        film = np.stack((own.film[0], camera.height - own.film[1]))
        for name in names:
            convention = CONVENTIONS[name]
            if convention.lacks(camera):
                continue
            place = folder / setting.replace(" ", "_") / name
            place.mkdir(parents=True)
            for file, text in texts([own.view], convention).items():
                (place / (file or "camera.xml")).write_text(text, encoding="utf-8")
            size = [[camera.width], [camera.height]]
            inside = ((film > 0) & (film < size)).all(axis=0)
            points, seen = own.points[:, inside].tolist(), film[:, inside].tolist()
            case = {"convention": name, "setting": setting, "folder": str(place)}
            cases.append(case | {"points": points, "film": seen})
    return cases


def judged(cases: list[dict[str, Any]], names: list[str], folder: Path) -> dict[str, Any]:
    """Return how far off the programs' own code is: by program and setting, pixels."""
    python = PLACE / ("Scripts" if sys.platform == "win32" else "bin") / "python"
    if not python.exists():
        venv.create(PLACE, with_pip=True)
    wheels = [WHEELS[name] for name in names]
    subprocess.run([python, "-m", "pip", "install", "--quiet", *wheels], check=True)
    asked = folder / "cases.json"
    asked.write_text(json.dumps(cases), encoding="utf-8")
    done = subprocess.run([python, CHILD, asked], capture_output=True, text=True)
    if done.returncode:
        raise SystemExit(done.stdout + done.stderr)
    found: dict[str, Any] = json.loads(done.stdout.splitlines()[-1])
    return found


def words(row: dict[str, float]) -> list[str]:
    """A row's cells: one digit says what there is to say of a rounding."""
    return [f"{row[name]:.0e}" if name in row else "refused" for name in SETTINGS]


def main() -> int:
    parser = argparse.ArgumentParser(description="Measure camera files by other programs' code.")
    parser.add_argument("--open3d", action="store_true", help="Open3D, too: 400 MB")
    options = parser.parse_args()
    names = [name for name in WHEELS if options.open3d or name != "open3d"]
    with tempfile.TemporaryDirectory() as folder:
        rows = judged(written(names, Path(folder)), names, Path(folder))
    print(table([[name, *words(row)] for name, row in rows.items()], ("code of", *SETTINGS)))
    worst = max(value for row in rows.values() for value in row.values())
    return int(not worst <= ALLOWED)


if __name__ == "__main__":
    sys.exit(main())
