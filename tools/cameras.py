"""How far each convention's camera files are off, in pixels, over a camera's settings: one table.

    make cameras             the published formulas; COLMAP's, Mitsuba's, OpenCV's, pyrender's code
    make cameras OPEN3D=1    Open3D's, too, whose wheel has 400 MB

What is judged is the largest distance over known points from Blender's own matrix. The programs are
installed from their wheels into out/cameras, and read the files by themselves. The exit code is 1
if one is farther off than float32 allows.
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


def written(folder: Path) -> tuple[dict[str, dict[str, float]], list[dict[str, Any]]]:
    """Write all files; return what the formulas make of them, and the cases for the programs."""
    from reference_tracer.camera_files.files import CONVENTIONS, texts

    sys.path.insert(0, str(PROJECT))
    from tests.camera_files.formulas import FORMULAS

    rows: dict[str, dict[str, float]] = {name: {} for name in CONVENTIONS}
    cases = []
    for setting, own in scene_cameras().items():
        film = np.stack((own.film[0], own.view.camera.height - own.film[1]))
        for name, convention in CONVENTIONS.items():
            if convention.lacks(own.view.camera):
                continue
            files = texts([own.view], convention)
            rows[name][setting] = float(np.abs(FORMULAS[name](files, own.points) - film).max())
            place = folder / setting.replace(" ", "_") / name
            place.mkdir(parents=True)
            for file, text in files.items():
                (place / (file or "camera.xml")).write_text(text, encoding="utf-8")
            inside = (film > 0).all(axis=0) & (
                film.T < (own.view.camera.width, own.view.camera.height)
            ).all(axis=1)
            cases.append(
                {
                    "convention": name,
                    "setting": setting,
                    "folder": str(place),
                    "points": own.points[:, inside].tolist(),
                    "film": film[:, inside].tolist(),
                }
            )
    return rows, cases


def judged(cases: list[dict[str, Any]], names: list[str], folder: Path) -> dict[str, Any]:
    """Return how far off the programs' own code is: by program and setting, pixels."""
    python = PLACE / ("Scripts" if sys.platform == "win32" else "bin") / "python"
    if not python.exists():
        venv.create(PLACE, with_pip=True)
    wheels = [WHEELS[name] for name in names]
    subprocess.run([python, "-m", "pip", "install", "--quiet", *wheels], check=True)
    asked = folder / "cases.json"
    asked.write_text(json.dumps([c for c in cases if c["convention"] in names]), encoding="utf-8")
    done = subprocess.run([python, CHILD, asked], capture_output=True, text=True)
    if done.returncode:
        raise SystemExit(done.stdout + done.stderr)
    found: dict[str, Any] = json.loads(done.stdout.splitlines()[-1])
    return found


def words(row: dict[str, float]) -> list[str]:
    """A row's cells: one digit says what there is to say of a rounding."""
    return [f"{row[name]:.0e}" if name in row else "refused" for name in SETTINGS]


def main() -> int:
    parser = argparse.ArgumentParser(description="Measure camera files by their formulas.")
    parser.add_argument("--formulas", action="store_true", help="no programs, and no downloads")
    parser.add_argument("--open3d", action="store_true", help="Open3D, too: 400 MB")
    options = parser.parse_args()
    names = [name for name in WHEELS if options.open3d or name != "open3d"]
    with tempfile.TemporaryDirectory() as folder:
        rows, cases = written(Path(folder))
        print(table([[name, *words(row)] for name, row in rows.items()], ("formula of", *SETTINGS)))
        if not options.formulas:
            found = judged(cases, names, Path(folder))
            print(
                table([[name, *words(row)] for name, row in found.items()], ("code of", *SETTINGS))
            )
            rows |= found
    worst = max(value for row in rows.values() for value in row.values())
    return int(not worst <= ALLOWED)


if __name__ == "__main__":
    sys.exit(main())
