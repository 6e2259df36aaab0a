"""The command `reftrace`: the tracer and the comparison outside Blender's window.

A .blend is opened with the `bpy` module, in the one function here that imports it; scenes and
meshes from other files need no Blender.
"""

from __future__ import annotations

import argparse
import sys
import traceback
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

from . import __version__, images
from .arguments import (
    EXIT_CODES,
    INPUT_ERROR,
    Parser,
    add_camera,
    add_judge,
    add_settings,
    camera_from,
    refuse,
    settings_from,
)
from .report import files
from .scene import Scene, SceneError
from .scene_files import MESH_SUFFIXES, load_meshes, load_scene, save_scene, scene_of_meshes
from .tracer.render import render
from .tracer.settings import Settings


def main(argv: list[str] | None = None) -> int:
    """Run `reftrace`; returns the exit code."""
    options = _parser().parse_args(argv)
    try:
        return options.run(options)
    except (SceneError, OSError, images.MissingLibraryError) as error:
        print(f"reftrace: {error}", file=sys.stderr)
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

    def command(name: str, run: Callable, text: str, example: str, source: str) -> Any:
        sub = commands.add_parser(
            name,
            help=text,
            description=text[0].upper() + text[1:] + ".",
            epilog=f"example:\n  {example}\n\n{EXIT_CODES}",
        )
        sub.set_defaults(run=run)
        sub.add_argument("scene", type=Path, metavar="SCENE", help=source)
        return sub

    sources = f"scene.blend, scene.npz, or a mesh ({', '.join(MESH_SUFFIXES)})"
    sub = command(
        "compare",
        _compare,
        "trace a .blend and compare it with Blender's own picture",
        "reftrace compare scene.blend --out out/",
        "scene.blend",
    )
    sub.add_argument("--out", required=True, metavar="DIR", help="folder for what is found")
    add_settings(sub)
    add_judge(sub)

    sub = command(
        "trace",
        _trace,
        "trace a scene or a mesh into a picture",
        "reftrace trace mesh.ply --out mesh.png --width 800",
        sources,
    )
    sub.add_argument(
        "--out",
        required=True,
        type=Path,
        metavar="PICTURE",
        help="picture.png (what a screen shows) or picture.exr (every output)",
    )
    add_settings(sub)
    add_camera(sub)

    sub = command(
        "trade",
        _trade,
        "measure seconds and wrong pixels of every method and precision",
        "reftrace trade sample_scenes/suzanne.blend --width 160",
        sources,
    )
    add_camera(sub, width=160, height=90)
    sub.set_defaults(heard=("width",))

    sub = command(
        "export",
        _export,
        "export a .blend to a scene that needs no Blender",
        "reftrace export scene.blend --out scene.npz",
        "scene.blend",
    )
    sub.add_argument(
        "--out", required=True, type=Path, metavar="SCENE.npz", help="the file to write"
    )
    return parser


def _load(options: argparse.Namespace) -> tuple[Scene, Settings]:
    """Return the scene of a file, with the settings that it stores."""
    path = options.scene
    if not path.is_file():
        raise SceneError(f"there is no file '{path}'")
    suffix = path.suffix.lower()
    if suffix not in MESH_SUFFIXES:
        own = {"width", "height", "eye", "target", "angle", "ortho_scale"} - set(options.heard)
        refuse(options, tuple(sorted(own)), f"is for meshes: '{path}' has its own camera")
    if suffix == ".npz":
        return load_scene(path), Settings()
    if suffix in MESH_SUFFIXES:
        width, height = (
            default if (value := getattr(options, name)) is None else value
            for name, default in zip(("width", "height"), options.default_size, strict=True)
        )
        meshes = load_meshes(path)
        return scene_of_meshes(
            meshes, camera_from(options, width, height), width, height
        ), Settings()
    if suffix == ".blend":
        with _open_blend(path) as blender:
            from .blender.compare import export_open_file

            scene, manifest, settings = export_open_file(blender.context)
        print(*manifest.lines(), sep="\n")
        return scene, settings
    raise SceneError(f"'{path}' is none of .blend, .npz, {', '.join(MESH_SUFFIXES)}")


@contextmanager
def _open_blend(path: Path) -> Iterator[Any]:
    """Open a .blend in this process, with the add-on registered; gives bpy."""
    if not path.is_file():
        raise SceneError(f"there is no file '{path}'")
    try:
        import bpy
    except ImportError as error:
        raise SceneError(
            f"a .blend needs Blender as a module: pip install 'reference_tracer[blender]' ({error})"
        ) from error
    from .blender import registration

    registration.register()
    try:
        try:
            bpy.ops.wm.open_mainfile(filepath=str(path.resolve()), load_ui=False, use_scripts=False)
        except RuntimeError as error:
            raise SceneError(f"'{path}' cannot be opened: {error}") from error
        yield bpy
    finally:
        registration.unregister()


def _compare(options: argparse.Namespace) -> int:
    try:
        if options.scene.suffix.lower() != ".blend":
            raise SceneError(f"'{options.scene}' is not a .blend: Blender draws only those")
        with _open_blend(options.scene):
            from .blender.commands import compare_open_file

            with _progress() as progress:
                return compare_open_file(options, progress)
    except (SceneError, OSError) as error:
        with suppress(OSError):
            files.write_failure(options.out, error)
        raise


def _trace(options: argparse.Namespace) -> int:
    suffix = options.out.suffix.lower()
    if suffix not in (".png", ".exr"):
        raise SceneError(f"'{options.out}' must end in .png or .exr")
    scene, stored = _load(options)
    settings = settings_from(options, stored)
    with _progress() as progress:
        frame = render(scene, settings, progress)
    options.out.parent.mkdir(parents=True, exist_ok=True)
    if suffix == ".png":
        images.save_png(options.out, images.to_display(frame.color))
    else:
        images.save_exr(options.out, frame.passes())
    s = frame.statistics
    print(
        f"{frame.t.shape[1]} x {frame.t.shape[0]} pixels, {s.triangles:,} triangles, "
        f"{s.pairs_tested:,} pairs tested in {s.seconds:.2f} s ({settings.method.value}, "
        f"{settings.precision.value}): {options.out}"
    )
    return 0


def _trade(options: argparse.Namespace) -> int:
    from .study.judge import TooLargeError
    from .study.tradeoff import measure, table

    scene, _ = _load(options)
    try:
        with _progress() as progress:
            rows = measure(
                scene, options.default_size[0] if options.width is None else options.width, progress
            )
    except TooLargeError as error:
        raise SceneError(str(error)) from error
    print(table(rows))
    return 0


def _export(options: argparse.Namespace) -> int:
    if options.out.suffix.lower() != ".npz":
        raise SceneError(f"'{options.out}' must end in .npz")
    if options.scene.suffix.lower() != ".blend":
        raise SceneError(f"'{options.scene}' is not a .blend: only those are exported")
    options.heard = ()
    scene, _ = _load(options)
    options.out.parent.mkdir(parents=True, exist_ok=True)
    save_scene(options.out, scene)
    print(f"{scene.triangle_count:,} triangles: {options.out}")
    return 0


@contextmanager
def _progress() -> Iterator[Callable[[float], None]]:
    """Show a bar on standard error, if it is a terminal and tqdm is there."""
    try:
        from tqdm import tqdm
    except ImportError:
        if sys.stderr.isatty():
            print(
                "reftrace: no progress bar without tqdm: pip install 'reference_tracer[progress]'",
                file=sys.stderr,
            )
        yield lambda share: None
        return
    layout = "{percentage:3.0f} %|{bar}| {elapsed}, {remaining} left"
    with tqdm(total=1.0, bar_format=layout, disable=None, leave=False) as bar:

        def show(share: float) -> None:
            bar.update(share - bar.n)

        yield show


if __name__ == "__main__":
    sys.exit(main())
