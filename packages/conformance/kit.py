"""Writes the kit: a folder for each scene, with its files in every format."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import replace
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from reference_tracer.camera_files.frame import Y_UP_FROM_Z_UP
from reference_tracer.camera_files.opencv import body_of
from reference_tracer.files.scenes import save_scene
from reference_tracer.pictures import colors_file
from reference_tracer.report.folders import write_all
from reference_tracer.scene import Camera, SceneError

from .gltf_files import glb
from .obj_files import mtl_text, obj_text
from .scenes import KitScene

FILES = {  # what stands for a file of a scene in a command: the file, and what it is
    "scene": ("scene.glb", "glTF, Y up, with its camera where glTF can say that"),
    "obj": ("scene.obj", "Wavefront, in world space, Z up, with scene.mtl"),
    "blend": ("scene.blend", "Blender's own, where the kit was written with bpy"),
    "npz": ("scene.npz", "the reference's own"),
    "camera": ("camera.json", "K, R and t for Z up; with {scene} that for Y up"),
    "colors": ("colors.json", "the colours of all objects, linear and sRGB"),
}
CAMERA_Y_UP = "camera_y_up.json"


def write_kit(folder: Path, scenes: Sequence[KitScene], blends: bool | None = None) -> None:
    """Write scenes into a folder, each into one of its own.

    Parameters
    ----------
    folder : Path
        Made where it is not there.
    scenes : sequence of KitScene
    blends : bool, optional
        Whether .blend files are written, too, by a Blender of its own; by default where bpy is
        installed.

    Raises
    ------
    SceneError
        If .blend files are asked for and bpy is not installed, or fails.
    OSError
        If the folder cannot be written.
    """
    for kit in scenes:
        own = folder / kit.name
        write_all(
            own,
            {
                "scene.obj": obj_text(kit, "scene.mtl"),
                "scene.mtl": mtl_text(kit),
                "colors.json": colors_file.text(kit.scene, ()),
                "camera.json": opencv(kit.camera),
                CAMERA_Y_UP: opencv(kit.camera, y_up=True),
            },
        )
        save_scene(own / "scene.npz", kit.scene)
        (own / "scene.glb").write_bytes(glb(kit))
    about = {kit.name: kit.sentence for kit in scenes}
    text = json.dumps(about, indent=1, ensure_ascii=False)
    (folder / "kit.json").write_text(text + "\n", encoding="utf-8")
    has_blender = find_spec("bpy") is not None
    if blends and not has_blender:
        raise SceneError("the kit's .blend files need bpy: pip install 'reference_tracer[blender]'")
    if has_blender if blends is None else blends:
        _write_blends([folder / kit.name for kit in scenes])


def opencv(camera: Camera, y_up: bool = False) -> dict[str, Any]:
    """Return a camera for JSON, as docs/conformance.md has it; y_up: in glTF's world."""
    if y_up:
        camera = replace(camera, world_from_camera=Y_UP_FROM_Z_UP @ camera.world_from_camera)
    return {
        "projection": camera.projection.name,
        "width": camera.width,
        "height": camera.height,
        **body_of(camera),
        "up": "y" if y_up else "z",
    }


def _write_blends(folders: Sequence[Path]) -> None:
    """Write a .blend beside each .npz, in a process of its own: Blender keeps what it has open."""
    words = [sys.executable, "-P", "-m", f"{__package__}.blend_child", *map(str, folders)]
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    if done.returncode:
        why = (done.stderr.strip().splitlines() or ["no reason is said"])[-1]
        raise SceneError(f"Blender did not write the kit's .blend files: {why}")
