"""`reftrace trace`: traces a scene or a mesh into a picture, or a certificate of it."""

from __future__ import annotations

from contextlib import ExitStack
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from ...files import exr, images, npz
from ...files.certificates import save_certificate
from ...opened import mesh_formats
from ...rendering import render
from ...report import cryptomatte, folders, masks
from ...scene import Scene, SceneError
from ...tracer.coloring import Color
from ...tracer.frame import Frame
from ...tracer.progress import Progress
from ...tracer.settings import Settings
from ...wording import count_of, show
from ..arguments import (
    add_settings,
)
from ..camera_options import add_camera
from ..opening import SOURCES, load, open_frames
from ..parser import AGREE, INTEGER, Parser
from ..running import progress_bar
from ..trace_options import TraceOptions


def add(parser: Parser) -> None:
    """Add the command's options."""
    parser.runs(
        lambda given: trace(TraceOptions.parsed(given)),
        "reftrace trace mesh.ply --out mesh.png --set width=800\n"
        "  reftrace trace scene.blend --frames 1-250 --out frames/####.png --out frames/####.exr",
    )
    parser.add_scene(SOURCES)
    _add_files(parser)
    add_settings(parser)
    parser.add_argument(
        "--color",
        choices=[c.value for c in Color],
        help="what a surface shows (default what a .blend stores, else object: its own colour)",
    )
    parser.add_argument(
        "--frames",
        metavar="FRAMES",
        help="these frames, by one Blender: 1-250, 1-250:5, 7, or all; #### in a file's name is "
        "its frame's number: frames/####.png are what `camera --frames` names",
    )
    parser.add_argument(
        "--rows",
        type=INTEGER,
        nargs=2,
        metavar=("FIRST", "LAST"),
        help="trace only a part of a large picture: its rows FIRST to LAST, row 0 the lowest",
    )
    add_camera(parser)


def _add_files(parser: Parser) -> None:
    """Add the options for what is written."""
    parser.add_argument(
        "--out",
        type=parser.path_ending(".png", ".exr", ".npz"),
        action="append",
        metavar="PICTURE",
        help="picture.png (what a screen shows), picture.exr (every output, and Cryptomatte) or "
        "picture.npz (every output as arrays); may be given several times",
    )
    parser.add_argument(
        "--certificate",
        type=parser.path_ending(".npz"),
        metavar="FILE",
        help="a file with the scene and what every pixel sees, for `reftrace verify`, which checks "
        "it without the tracer; implies --method certified",
    )
    parser.add_argument(
        "--masks",
        type=parser.path,
        metavar="DIR",
        help="also write a mask of each object that is seen, as PNG and in coco.json, where its "
        "whole extent is, too, also where others hide a part of it",
    )
    parser.add_argument(
        "--top-down",
        action="store_true",
        help="the first row of the arrays in a .npz is the topmost (default the lowest)",
    )


def trace(options: TraceOptions) -> int:
    """Trace, and write the picture, its certificate, or both."""
    with ExitStack() as stack:
        for path in options.files:
            stack.enter_context(folders.made_for_file(path))
        place = stack.enter_context(options.place)
        if options.frames is None:
            _traced(options, *load(options.scene, options.choice), place)
        else:
            _frames(options, options.frames, place)
    is_mesh = options.scene.suffix.lower() in mesh_formats()
    is_png = any(path.suffix.lower() == ".png" for path in options.out)
    if is_png and is_mesh and not options.settings.color:
        show("each mesh has one flat colour: --color facing shows its shape")
    return AGREE


def _frames(options: TraceOptions, named: str, place: dict[str, Any]) -> None:
    """Trace the frames that are named of a .blend, which is opened once."""
    said: dict[str, None] = {}
    for frame, opened in open_frames(options.scene, options.choice, named):
        said |= dict.fromkeys(opened.manifest.remarks())
        _traced(options.of_frame(frame), opened.scene, opened.settings, place)
    show(*said)


def _traced(options: TraceOptions, scene: Scene, stored: Settings, place: dict[str, Any]) -> None:
    """Trace a scene, and write its picture, its certificate, its masks."""
    settings = options.settings.over(stored)
    for option in ("certificate", "masks"):
        if getattr(options, option) and not settings.method.is_proven:
            raise SceneError(f"--{option}: {settings.method} proves nothing: --method certified")
    if options.rows:
        scene = _rows_alone(scene, settings, *options.rows)
    with progress_bar() as progress:
        frame = render(scene, settings, lambda s: progress(Progress(s, "tracing")), **place)
    for path in options.files:
        with folders.replacing_file(path) as new:
            if path == options.certificate:
                save_certificate(new, frame)
            else:
                _write(path, frame, new, -1 if options.top_down else 1)
    if options.masks:
        masks.write(options.masks, frame, options.out[0].name)
    s = frame.statistics
    show(
        f"{frame.shape[1]} x {frame.shape[0]} pixels, {count_of(s.triangles, 'triangle')}, "
        f"{count_of(s.pairs_tested, 'pair')} tested in {s.seconds:.2f} s ({s.method}, "
        f"{settings.precision}): {', '.join(map(str, options.files))}"
    )
    show(*s.required())


def _write(path: Path, frame: Frame, new: Path, step: int) -> None:
    """Write a frame as `path` is called, into the file `new`; arrays by steps of 1 or -1 rows."""
    if path.suffix.lower() == ".png":
        images.save_png(new, images.to_display(frame.color))
    elif path.suffix.lower() == ".exr":
        passes = frame.passes() | {f"{cryptomatte.LAYER}00": cryptomatte.layer(frame)}
        exr.save(new, passes, cryptomatte.header(frame))
    else:
        passes = {name: values[::step] for name, values in frame.passes().items()}
        npz.save(new, {"objects": np.array(frame.scene.objects, "U")} | passes)


def _rows_alone(scene: Scene, settings: Settings, first: int, last: int) -> Scene:
    """Return the scene with a camera that sees only some rows of the picture."""
    r = scene.camera.region
    if settings.color == Color.DEPTH:
        raise SceneError("--rows: the greys of --color depth are those of a whole picture")
    if not 0 <= first <= last < r.height:
        raise SceneError(f"--rows {first} {last}: rows are 0 to {r.height - 1}, the lower first")
    region = replace(r, y0=r.y0 + first, y1=r.y0 + last + 1)
    return replace(scene, camera=replace(scene.camera, region=region))
