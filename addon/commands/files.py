"""`reftrace trace` and `reftrace export`: a scene -> one file, a picture or a scene."""

from __future__ import annotations

import argparse
from pathlib import Path

from .. import images
from ..arguments import add_camera, add_settings, camera_from, settings_from
from ..interrupts import progress_bar
from ..opening import SOURCES, load
from ..report import folders
from ..scene import SceneError
from ..scene_files import save_scene
from ..tracer.render import render
from .parts import Commands, command

_PICTURES = "picture.png (what a screen shows) or picture.exr (every output)"


def add_trace(commands: Commands) -> None:
    """Add the command."""
    parser = command(
        commands,
        "trace",
        trace,
        "trace a scene or a mesh into a picture",
        "reftrace trace mesh.ply --out mesh.png --width 800",
        SOURCES,
    )
    parser.add_argument("--out", required=True, type=Path, metavar="PICTURE", help=_PICTURES)
    parser.set_defaults(endings={"out": (".png", ".exr")})
    add_settings(parser)
    add_camera(parser)


def trace(options: argparse.Namespace) -> int:
    """Trace, and write the picture."""
    with folders.made_for_file(options.out):
        scene, stored = load(options.scene, *camera_from(options, options.scene))
        settings = settings_from(options, stored)
        with progress_bar() as progress:
            frame = render(scene, settings, progress)
        with folders.replacing_file(options.out) as new:
            if options.out.suffix.lower() == ".png":
                images.save_png(new, images.to_display(frame.color))
            else:
                images.save_exr(new, frame.passes())
    s = frame.statistics
    print(
        f"{frame.t.shape[1]} x {frame.t.shape[0]} pixels, {s.triangles:,} triangles, "
        f"{s.pairs_tested:,} pairs tested in {s.seconds:.2f} s ({s.method}, "
        f"{settings.precision.value}): {options.out}"
    )
    for line in s.required():
        print(line)
    return 0


def add_export(commands: Commands) -> None:
    """Add the command."""
    parser = command(
        commands,
        "export",
        export,
        "export a .blend to a scene that needs no Blender",
        "reftrace export scene.blend --out scene.npz",
        "scene.blend",
    )
    parser.add_argument("--out", required=True, type=Path, metavar="SCENE.npz", help="the file")
    parser.set_defaults(endings={"out": (".npz",)})


def export(options: argparse.Namespace) -> int:
    """Export, and write the scene."""
    if options.scene.suffix.lower() != ".blend":
        raise SceneError(f"'{options.scene}' is not a .blend: only those are exported")
    with folders.made_for_file(options.out):
        scene, _ = load(options.scene)
        with folders.replacing_file(options.out) as new:
            save_scene(new, scene)
    print(f"{scene.triangle_count:,} triangles: {options.out}")
    return 0
