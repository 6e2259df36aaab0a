"""`reftrace compare`: a scene and a picture of it, Blender's own or anybody's."""

from __future__ import annotations

import argparse
import os
from contextlib import nullcontext
from dataclasses import replace
from pathlib import Path

import numpy as np

from ... import images
from ...compare import engines
from ...compare.case import Case
from ...compare.comparison import EXIT_CODES, Comparison, trace_and_compare
from ...compare.picture import Picture, Source
from ...diagnosis import diagnosed
from ...manifest import Manifest, ObjectEntry
from ...report import comparison as comparison_report
from ...report import engines as engines_report
from ...report import folders, page
from ...scene import Camera, Scene, SceneError
from ...tracer.progress import Work, result_of
from ..arguments import add_judge, add_settings, settings_from
from ..camera_options import add_camera, choice_from
from ..opening import import_trimesh, load, open_blend
from ..parser import EXIT_CODES_HELP, Parser, add_options
from ..running import progress_bar
from .parts import command


def add_compare(parser: Parser) -> None:
    """Add the command's options."""
    from ...blender.drawing.judges import choices

    examples = (
        "reftrace compare scene.blend --out out/\n"
        "  reftrace compare scene.npz --against student.png --out out/"
    )
    sources = "scene.blend; with --against also scene.npz or a mesh"
    command(parser, run, examples, sources, EXIT_CODES_HELP)
    add_options(parser, "compare")
    add_settings(parser)
    add_judge(parser, choices())
    for names in ("animation", "page", "against"):
        add_options(parser, names)
    add_camera(parser)


def run(options: argparse.Namespace) -> int:
    """Compare; the exit code is the verdict's, and the folder says why there is no comparison."""
    if options.out.startswith("//"):  # here it is the shell's: Blender's is beside the file
        options.out = os.path.realpath(options.out)
    out = Path(options.out).resolve()
    for file in (options.scene, options.against):
        if file and file.resolve() in [out / name for name in comparison_report.NAMES]:
            raise SceneError(f"'{file}' is called as a result: choose another --out, or rename it")
    written = comparison_report.failure_written(options.out)  # but for an animation
    with (
        folders.made(Path(options.out)),
        written if options.frames is None else nullcontext(),
        options.place(options) as options.placed,
    ):
        import_trimesh()  # which diagnoses the meshes
        return _with_blender(options) if options.against is None else _against(options)


def _with_blender(options: argparse.Namespace) -> int:
    if options.scene.suffix.lower() != ".blend":
        raise SceneError(
            f"'{options.scene}' is not a .blend: Blender draws only those. Name a picture of it "
            "with --against"
        )
    with open_blend(options.scene, choice_from(options)) as blender, progress_bar() as progress:
        from ...blender import animation
        from ...blender.compare import compare_all, compare_to_folder

        chosen = {
            "settings": settings_from(options, blender.context.scene.reference_tracer.settings()),
            "as_is": options.as_is or None,
            "identity": options.identity,
            "self_check": options.self_check,
            **options.placed,
        }
        judge = options.judge.upper() if options.judge else None
        if options.frames:
            return animation.compare_open_file(options, progress, judge=judge, **chosen)
        if options.judge == "all":
            rows = result_of(compare_all(blender.context, options.out, **chosen), progress)
            verdict = engines.worst(rows)
            print(*engines_report.lines(rows), f"verdict: {verdict}", sep="\n")
            pages = [Path(options.out) / row.engine / page.NAME for row in rows if row.pixels]
            return _told(options, verdict, *pages)
        for_page = {"trade": options.trade, "extremes": options.extremes}
        work = compare_to_folder(blender.context, options.out, **for_page, judge=judge, **chosen)
        return _told_comparison(options, result_of(work, progress))


def _against(options: argparse.Namespace) -> int:
    """Compare with a picture of unknown make."""
    picture = images.read_picture(options.against)
    with progress_bar() as progress:
        of = _blend if options.scene.suffix.lower() == ".blend" else _file
        comparison = result_of(of(options, picture), progress)
        finding = page.extras(comparison, options.trade, options.extremes)
        extras = result_of(finding, progress)
    comparison_report.write(options.out, comparison, extras)
    return _told_comparison(options, comparison)


def _told_comparison(options: argparse.Namespace, comparison: Comparison) -> int:
    print(*comparison.manifest.lines(), *comparison.lines(), sep="\n")
    return _told(options, comparison.verdict, Path(options.out) / page.NAME)


def _told(options: argparse.Namespace, verdict: str, *pages: Path) -> int:
    """Say where the results are; return the verdict's exit code."""
    print(f"written to {options.out}")
    print("open", *pages, "in a browser")
    return EXIT_CODES[verdict]


def _blend(options: argparse.Namespace, picture: images.StoredPicture) -> Work[Comparison]:
    with open_blend(options.scene, choice_from(options)) as blender:
        from ...blender.against import gather_against
        from ...blender.compare import compared
        from ...blender.reading.camera import export_camera
        from ...blender.versions import DITHER

        context = blender.context
        dither = DITHER * context.scene.render.dither_intensity
        shown = _shown(options, picture, export_camera(context.scene), dither)
        settings = settings_from(options, context.scene.reference_tracer.settings())
        case = gather_against(context, shown, settings, bool(options.self_check))
        return (yield from compared(replace(case, **options.placed)))


def _file(options: argparse.Namespace, picture: images.StoredPicture) -> Work[Comparison]:
    scene, stored = load(options.scene, choice_from(options, options.scene))
    manifest = yield from diagnosed(scene, _manifest(options.scene, scene))
    settings, shown = settings_from(options, stored), _shown(options, picture, scene.camera)
    case = Case(scene, manifest, settings, shown, curves=(), self_check=bool(options.self_check))
    return (yield from trace_and_compare(replace(case, **options.placed)))


def _shown(
    options: argparse.Namespace, picture: images.StoredPicture, camera: Camera, dither: float = 0.0
) -> Picture:
    """Return what is compared of a picture: of one of the whole view, the camera's border."""
    color, r = picture.color, camera.region
    if color.shape[:2] == (camera.height, camera.width):
        color = np.ascontiguousarray(color[r.y0 : r.y1, r.x0 : r.x1])
    if options.dither is not None:
        dither = options.dither * picture.levels / 255
    elif picture.levels > 255:  # Blender adds it to 8 bits alone
        dither = 0.0
    return Picture(
        color,
        Source(file=options.against.name),
        filter_radius=options.filter or 0.0,
        levels=picture.levels,
        dither=dither,
        opaque=picture.opaque,
    )


def _manifest(path: Path, scene: Scene) -> Manifest:
    """Return the account of a scene that never saw Blender."""
    entries = []
    for number, name in enumerate(scene.objects):
        own = [scene.meshes[i.mesh] for i in scene.instances if i.object == number]
        planes = sum(p.object == number for p in scene.planes)
        entries.append(
            ObjectEntry(
                name,
                "INFINITE_PLANE" if planes else "MESH",
                exported=bool(own or planes),
                reason="" if own or planes else "nothing of it is in the file",
                triangles=sum(len(m.triangles) for m in {id(m): m for m in own}.values()),
                vertices=sum(len(m.vertices) for m in {id(m): m for m in own}.values()),
                instances=len(own) + planes,
                traced_triangles=sum(len(m.triangles) for m in own),
            )
        )
    return Manifest(path.name, path.stem, "", 0, "FILE", scene.camera.name, tuple(entries))
