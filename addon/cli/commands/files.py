"""`reftrace trace`, `export` and `explain`: a scene -> a picture, a scene, or a pixel's maths."""

from __future__ import annotations

import argparse
import sys
from contextlib import redirect_stdout
from dataclasses import replace

from ... import images
from ...certified.rounding import check_rounding
from ...rendering import render
from ...report import folders
from ...scene import Scene, SceneError
from ...scene_files import MESH_SUFFIXES, save_scene
from ...tracer.coloring import Color
from ...tracer.progress import result_of
from ..arguments import add_pixel, add_settings, printable, settings_from
from ..camera_options import add_camera, choice_from
from ..opening import SOURCES, load
from ..parser import Parser, add_options
from ..running import progress_bar
from .parts import command


def add_trace(parser: Parser) -> None:
    """Add the command's options."""
    command(parser, trace, "reftrace trace mesh.ply --out mesh.png --width 800", SOURCES)
    add_options(parser, "trace")
    parser.set_defaults(endings={"out": (".png", ".exr")})
    add_settings(parser)
    add_options(parser, "look", color={"choices": [c.value for c in Color]})
    add_camera(parser)


def trace(options: argparse.Namespace) -> None:
    """Trace, and write the picture."""
    with folders.made_for_file(options.out):
        scene, stored = load(options.scene, choice_from(options, options.scene))
        settings, checked = settings_from(options, stored), []
        if options.check_rounding and settings.method.is_plain:
            raise SceneError("--check-rounding is about proven pixels: --method certified has them")
        if options.rows:
            scene = _rows_alone(scene, settings.color, *options.rows)
        with options.place(options) as place, progress_bar() as progress:
            frame = render(scene, settings, progress, **place)
            if options.check_rounding:
                checked = result_of(check_rounding(scene, frame), progress)
        with folders.replacing_file(options.out) as new:
            if options.out.suffix.lower() == ".png":
                images.save_png(new, images.to_display(frame.color))
            else:
                images.save_exr(new, frame.passes())
    s = frame.statistics
    print(
        f"{frame.shape[1]} x {frame.shape[0]} pixels, {s.triangles:,} triangles, "
        f"{s.pairs_tested:,} pairs tested in {s.seconds:.2f} s ({s.method}, "
        f"{settings.precision.value}): {options.out}"
    )
    for line in (*s.required(), *checked):
        print(line)
    drawn = options.out.suffix.lower() == ".png" and not options.color
    if drawn and options.scene.suffix.lower() in MESH_SUFFIXES:
        print("each mesh has one flat colour: --color facing shows its shape")


def _rows_alone(scene: Scene, color: Color, first: int, last: int) -> Scene:
    """Return a scene of which only some rows of the picture are traced."""
    r = scene.camera.region
    if color == Color.DEPTH:
        raise SceneError("--rows: the greys of --color depth are those of a whole picture")
    if not 0 <= first <= last < r.height:
        raise SceneError(f"--rows {first} {last}: rows are 0 to {r.height - 1}, the lower first")
    region = replace(r, y0=r.y0 + first, y1=r.y0 + last + 1)
    return replace(scene, camera=replace(scene.camera, region=region))


def add_export(parser: Parser) -> None:
    """Add the command's options."""
    command(parser, export, "reftrace export scene.blend --out scene.npz", "scene.blend")
    add_options(parser, "export")
    parser.set_defaults(endings={"out": (".npz",)})
    add_camera(parser)


def export(options: argparse.Namespace) -> None:
    """Export, and write the scene."""
    if options.scene.suffix.lower() != ".blend":
        raise SceneError(f"'{options.scene}' is not a .blend: only those are exported")
    with folders.made_for_file(options.out):
        scene, _ = load(options.scene, choice_from(options, options.scene))
        with folders.replacing_file(options.out) as new:
            save_scene(new, scene)
    print(f"{scene.triangle_count:,} triangles: {options.out}")


def add_explain(parser: Parser) -> None:
    """Add the command's options."""
    example = "reftrace explain scene.blend --pixel 480 270 --out pixel.html"
    command(parser, explain, example, f"{SOURCES}, or a pixel.json that --reproducer wrote")
    add_pixel(parser)
    add_camera(parser)


def explain(options: argparse.Namespace) -> None:
    """Derive, and print or write it."""
    from ...explain import reproducer
    from ...explain.candidates import LIMIT, gather_pixel
    from ...report import pixel

    path = options.scene
    if path.suffix.lower() == ".json":
        found = reproducer.read(path)
    else:
        # What is said meanwhile, by Blender too, is no part of the Markdown.
        with images.redirected(1, 2), redirect_stdout(sys.stderr):
            scene, _ = load(path, choice_from(options, path))
        found = gather_pixel(scene, *options.pixel, options.limit or LIMIT, path.name)
    print(printable(pixel.write(found, options.out, options.reproducer)), end="")
