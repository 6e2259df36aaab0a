"""`reftrace export`: a .blend -> a scene that needs no Blender."""

from __future__ import annotations

import argparse
from pathlib import Path

from ..opening import load
from ..report import folders
from ..scene import SceneError
from ..scene_files import save_scene
from .parts import Commands, command


def add(commands: Commands) -> None:
    """Add the command."""
    parser = command(
        commands,
        "export",
        run,
        "export a .blend to a scene that needs no Blender",
        "reftrace export scene.blend --out scene.npz",
        "scene.blend",
    )
    parser.add_argument("--out", required=True, type=Path, metavar="SCENE.npz", help="the file")
    parser.set_defaults(endings={"out": (".npz",)})


def run(options: argparse.Namespace) -> int:
    """Export, and write the scene."""
    if options.scene.suffix.lower() != ".blend":
        raise SceneError(f"'{options.scene}' is not a .blend: only those are exported")
    with folders.made_for_file(options.out):
        scene, _ = load(options.scene)
        with folders.replacing_file(options.out) as new:
            save_scene(new, scene)
    print(f"{scene.triangle_count:,} triangles: {options.out}")
    return 0
