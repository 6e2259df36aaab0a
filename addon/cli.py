"""The command `reftrace`: the tracer, the comparison and the studies outside Blender's window."""

from __future__ import annotations

import argparse
import os
import sys
import traceback
from collections.abc import Callable
from contextlib import nullcontext, suppress
from pathlib import Path
from typing import Any

from . import __version__, images, interrupts
from .arguments import (
    EXIT_CODES,
    INPUT_ERROR,
    INTERRUPTED,
    SIZES_DIFFER,
    Parser,
    add_bench,
    add_camera,
    add_judge,
    add_processes,
    add_settings,
    check,
    settings_from,
    words,
)
from .compare.comparison import SizeError
from .opening import SOURCES, load, open_blend
from .report import files, folders
from .report.progress_bar import progress_bar
from .scene import SceneError
from .scene_files import save_scene
from .tracer.certainty import AssumptionError
from .tracer.processes import WorkerError, render_with, tracing
from .tracer.progress import result_of
from .tracer.settings import Settings

_PICTURES = "picture.png (what a screen shows) or picture.exr (every output)"
_EXPECTED = (  # what a user can do something about
    *(SceneError, SizeError, OSError, MemoryError),
    *(images.MissingLibraryError, AssumptionError, WorkerError),
)


def main(argv: list[str] | None = None) -> int:
    """Run `reftrace`; returns the exit code."""
    options = _parser().parse_args(argv)
    try:
        with interrupts.heard():
            check(options)
            return options.run(options)
    except KeyboardInterrupt:
        print("reftrace: interrupted", file=sys.stderr)
        return INTERRUPTED
    except _EXPECTED as error:
        print(f"reftrace: {words(error)}", file=sys.stderr)
        return SIZES_DIFFER if isinstance(error, SizeError) else INPUT_ERROR
    except Exception as error:  # Python's own exit code for it, 1, means warnings here
        traceback.print_exc()
        print(f"reftrace: {type(error).__name__}: {error}", file=sys.stderr)
        return INPUT_ERROR


def _parser() -> argparse.ArgumentParser:
    parser = Parser(
        "reftrace",
        epilog=EXIT_CODES,
        description=(
            "Trace a scene with the textbook's plane and triangle maths, and compare what Blender "
            "shows with it, pixel by pixel."
        ),
    )
    parser.add_argument("--version", action="version", version=f"reftrace {__version__}")
    commands = parser.add_subparsers(required=True, metavar="COMMAND", parser_class=Parser)

    def command(run: Callable, text: str, example: str, source: str | None) -> Any:
        sub = commands.add_parser(
            run.__name__.lstrip("_"),
            help=text,
            description=text[0].upper() + text[1:] + ".",
            epilog=f"example:\n  {example}\n\n{EXIT_CODES}",
        )
        sub.set_defaults(run=run)
        if source:
            sub.add_argument("scene", type=Path, metavar="SCENE", help=source)
        return sub

    sub = command(
        _compare,
        "trace a .blend and compare it with Blender's own picture",
        "reftrace compare scene.blend --out out/",
        "scene.blend",
    )
    sub.add_argument("--out", required=True, metavar="DIR", help="folder for what is found")
    add_settings(sub)
    add_processes(sub)
    add_judge(sub)

    sub = command(
        _trace,
        "trace a scene or a mesh into a picture",
        "reftrace trace mesh.ply --out mesh.png --width 800",
        SOURCES,
    )
    sub.add_argument("--out", required=True, type=Path, metavar="PICTURE", help=_PICTURES)
    add_settings(sub)
    add_processes(sub)
    add_camera(sub)

    sub = command(
        _trade,
        "measure what every method, precision, number of samples and size costs on a scene",
        "reftrace trade sample_scenes/suzanne.blend --out out/",
        SOURCES,
    )
    sub.add_argument("--out", metavar="DIR", help="folder for the table, JSON and plot")
    sub.add_argument(
        "--samples", type=int, metavar="N", help="measure up to N x N rays a pixel (default 4)"
    )
    add_camera(sub, width=160, height=90, of_scenes=True)

    sub = command(
        _extremes,
        "find where every method breaks: far away, tiny, edge-on, and so on",
        "reftrace extremes --out out/",
        None,
    )
    sub.add_argument("--out", required=True, metavar="DIR", help="folder for what is found")
    sub.add_argument("--rays", type=int, metavar="N", help="about so many through each scene")

    sub = command(
        _bench,
        "measure the speed of the tracer beside embreex, Cycles and others",
        "reftrace bench --quick --out out/bench",
        None,
    )
    add_bench(sub)

    sub = command(
        _export,
        "export a .blend to a scene that needs no Blender",
        "reftrace export scene.blend --out scene.npz",
        "scene.blend",
    )
    sub.add_argument("--out", required=True, type=Path, metavar="SCENE.npz", help="the file")
    return parser


def _compare(options: argparse.Namespace) -> int:
    if options.out.startswith("//"):  # here it is the shell's: Blender's is beside the file
        options.out = os.path.realpath(options.out)
    with folders.made(Path(options.out)):
        try:
            if options.scene.suffix.lower() != ".blend":
                raise SceneError(f"'{options.scene}' is not a .blend: Blender draws only those")
            with open_blend(options.scene):
                from .blender.commands import compare_open_file

                with tracing(options.processes) as trace, progress_bar() as progress:
                    return compare_open_file(options, progress, trace)
        except Exception as error:
            with suppress(OSError):
                files.write_failure(options.out, error)
            raise


def _trace(options: argparse.Namespace) -> int:
    suffix = options.out.suffix.lower()
    if suffix not in (".png", ".exr"):
        raise SceneError(f"'{options.out}' must end in .png or .exr")
    with folders.made_for_file(options.out):
        scene, stored = load(options)
        settings = settings_from(options, stored)
        with progress_bar() as progress:
            frame = render_with(scene, settings, options.processes, progress)
        with folders.replacing_file(options.out) as new:
            if suffix == ".png":
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


def _trade(options: argparse.Namespace) -> int:
    from .report import trade as report
    from .study import tradeoff

    with folders.made(Path(options.out)) if options.out else nullcontext():
        scene, _ = load(options)
        samples = settings_from(options, Settings(samples=tradeoff.SAMPLES)).samples
        with progress_bar() as progress:
            work = tradeoff.measure(scene, options.width, samples, options.scene.name)
            trade = result_of(work, progress)
        print(report.table(trade))
        if options.out:
            _write(options.out, lambda: report.write(options.out, trade, images.save_png))
    return 0


def _extremes(options: argparse.Namespace) -> int:
    from .report import extremes as report
    from .study import extremes

    with folders.made(Path(options.out)):
        with progress_bar() as progress:
            rows = result_of(extremes.measure(rays=options.rays), progress)
        print(extremes.breaking_table(rows))
        _write(options.out, lambda: report.write(options.out, rows, images.save_png))
    return 0


def _bench(options: argparse.Namespace) -> int:
    from .report import bench as report
    from .report.bench_run import run

    with folders.made(Path(options.out)):
        with progress_bar() as progress:
            bench, baseline = run(options, progress)
        print(report.table(bench, baseline))
        _write(options.out, lambda: report.write(options.out, bench, images.save_png, baseline))
    return INTERRUPTED if bench.interrupted else 0


def _write(directory: str, write: Callable[[], None]) -> None:
    """Write a study; where pictures need a library that is not there, say so and do without."""
    try:
        write()
    except images.MissingLibraryError as error:
        print(f"reftrace: {error}", file=sys.stderr)
    print(f"written to {directory}")


def _export(options: argparse.Namespace) -> int:
    if options.out.suffix.lower() != ".npz":
        raise SceneError(f"'{options.out}' must end in .npz")
    if options.scene.suffix.lower() != ".blend":
        raise SceneError(f"'{options.scene}' is not a .blend: only those are exported")
    options.heard = ()
    with folders.made_for_file(options.out):
        scene, _ = load(options)
        with folders.replacing_file(options.out) as new:
            save_scene(new, scene)
    print(f"{scene.triangle_count:,} triangles: {options.out}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
