"""`reftrace compare`: compares a scene with a picture of it, Blender's own or anybody's."""

from __future__ import annotations

from argparse import BooleanOptionalAction, Namespace
from contextlib import nullcontext
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from ... import images
from ...compare import engines
from ...compare.animation import frames_named
from ...compare.case import Case
from ...compare.comparison import EXIT_CODES, Comparison, trace_and_compare
from ...compare.picture import Picture, Source
from ...diagnosis import diagnosed
from ...framing import Choice
from ...manifest import Manifest, ObjectEntry
from ...report import comparison as comparison_report
from ...report import engines as engines_report
from ...report import folders, page
from ...scene import Camera, Scene, SceneError
from ...tracer.progress import Work, result_of
from ..arguments import (
    GivenSettings,
    Place,
    add_settings,
    is_blend,
    place_from,
    refuse,
    settings_from,
)
from ..camera_options import add_camera, choice_from
from ..opening import import_trimesh, load, open_blend
from ..parser import AT_LEAST_0, EXIT_CODES_HELP, Parser
from ..running import progress_bar

# A frame of an animation stays the same whatever these are.
_NOT_OF_A_FRAME = "scene", "out", "frames", "against", "place"


@dataclass(frozen=True)
class CompareOptions:
    """The options of `reftrace compare`."""

    scene: Path
    out: Path
    settings: GivenSettings
    choice: Choice
    # Blender's picture; None for what the scene stores.
    judge: str | None
    as_is: bool
    identity: bool | None
    self_check: bool | None
    frames: str | None  # of an animation, as they are typed
    # Another picture, in place of Blender's.
    against: Path | None
    filter: float | None  # pixels
    dither: float | None  # levels of 255
    # What the page shows besides.
    trade: bool
    extremes: bool
    place: Place

    @classmethod
    def parsed(cls, given: Namespace) -> CompareOptions:
        """Return what was parsed; raises SceneError if options contradict one another."""
        _refuse_beside_frames(given)
        if given.against is None:
            refuse(given, ("filter", "dither"), "is for a picture of --against")
        else:
            why = "is for Blender's picture, not for one of --against"
            refuse(given, ("judge", "identity", "as_is"), why)
        return cls(
            scene=given.scene,
            out=given.out,
            settings=settings_from(given),
            choice=choice_from(given, given.scene),
            judge=given.judge,
            as_is=given.as_is,
            identity=given.identity,
            self_check=given.self_check,
            frames=given.frames,
            against=given.against,
            filter=given.filter,
            dither=given.dither,
            trade=given.trade,
            extremes=given.extremes,
            place=place_from(given),
        )

    def of_a_frame(self) -> dict[str, str]:
        """Return the options that a frame's comparison depends on, in words that can be stored."""
        return {k: str(v) for k, v in vars(self).items() if k not in _NOT_OF_A_FRAME}


def _refuse_beside_frames(given: Namespace) -> None:
    if given.frames is None:
        return
    why = "is for one frame, not for --frames"
    refuse(given, ("frame", "against", "trade", "extremes"), why)
    if given.judge == "all":
        raise SceneError("--judge all is for one frame: name one judge with --frames")
    try:
        frames_named(given.frames)
    except ValueError as error:
        raise SceneError(f"--frames {error}") from error


def add(parser: Parser) -> None:
    """Add the command's options."""
    examples = (
        "reftrace compare scene.blend --out out/\n"
        "  reftrace compare scene.npz --against student.png --out out/"
    )
    parser.runs(lambda given: compare(CompareOptions.parsed(given)), examples, EXIT_CODES_HELP)
    parser.add_scene("scene.blend; with --against also scene.npz or a mesh")
    parser.add_argument(
        "--out", required=True, type=parser.path, metavar="DIR", help="folder for what is found"
    )
    add_settings(parser)
    _add_blenders_picture(parser)
    _add_page(parser)
    _add_against(parser)
    add_camera(parser)


def _add_blenders_picture(parser: Parser) -> None:
    from ...blender.drawing.judges import choices

    group = parser.add_argument_group("Blender's picture (default: as the scene says)")
    group.add_argument(
        "--judge",
        choices=["auto", *choices(), "all"],
        help="the engine of Blender that draws the picture to compare with; all makes a table of "
        "all engines (and of the viewport, in a window)",
    )
    group.add_argument(
        "--as-is",
        action="store_true",
        help="leave Blender's shading as the scene has it, not like for like",
    )
    group.add_argument(
        "--identity",
        action=BooleanOptionalAction,
        help="draw once more, with one colour for each object, to know which one a pixel shows",
    )
    group.add_argument(
        "--self-check",
        action="store_true",
        default=None,
        help="also make known faults (a pixel off, mirrored, an object left out...) and see that "
        "each is found",
    )
    group.add_argument(
        "--frames",
        metavar="FRAMES",
        help="compare an animation: 1-250, 1-250:5 for every fifth, 7, or all; frames that an "
        "earlier run with the same file and options has finished in DIR are not done again",
    )


def _add_page(parser: Parser) -> None:
    group = parser.add_argument_group("the page (page.html in DIR)")
    group.add_argument(
        "--trade",
        action="store_true",
        help="also measure what each method costs on this scene: half a minute",
    )
    group.add_argument(
        "--extremes", action="store_true", help="also find where every method breaks: two minutes"
    )


def _add_against(parser: Parser) -> None:
    group = parser.add_argument_group("another picture, in place of Blender's")
    group.add_argument(
        "--against",
        type=parser.path,
        metavar="PICTURE",
        help="a .png (sRGB) or .exr (linear) of the same camera and size; a background of its own, "
        "of one colour or transparent, is named and does not count as a difference",
    )
    group.add_argument(
        "--filter",
        type=AT_LEAST_0,
        metavar="PIXELS",
        help="how far its anti-aliasing reaches (default 0: one sample in each pixel's centre)",
    )
    group.add_argument(
        "--dither",
        type=AT_LEAST_0,
        metavar="LEVELS",
        help="noise in a .png, in levels of 255 (default what the .blend says, else 0)",
    )


def compare(options: CompareOptions) -> int:
    """Compare; the exit code is the verdict's, and the folder says why there is no comparison."""
    results = [options.out.resolve() / name for name in comparison_report.NAMES]
    for file in (options.scene, options.against):
        if file and file.resolve() in results:
            raise SceneError(
                f"'{file}' has the name of a result: choose another --out, or rename it"
            )
    written = comparison_report.failure_written(options.out)  # but for an animation
    with (
        folders.made(options.out),
        written if options.frames is None else nullcontext(),
        options.place as place,
    ):
        import_trimesh()  # which diagnoses the meshes
        if options.against is None:
            return _with_blender(options, place)
        return _with_picture(options, images.read_picture(options.against), place)


def _with_blender(options: CompareOptions, place: dict[str, Any]) -> int:
    if not is_blend(options.scene):
        raise SceneError(
            f"'{options.scene}' is not a .blend: Blender draws only those. Name a picture of it "
            "with --against"
        )
    with open_blend(options.scene, options.choice) as blender, progress_bar() as progress:
        from ...blender import animation
        from ...blender.compare import compare_all, compare_to_folder

        stored = blender.context.scene.reference_tracer.settings()
        judge = options.judge.upper() if options.judge else None
        out = str(options.out)
        chosen: dict[str, Any] = {
            "settings": options.settings.over(stored),
            "as_is": options.as_is or None,
            "identity": options.identity,
            "self_check": options.self_check,
            **place,
        }
        if options.frames:
            made_by = options.of_a_frame()
            chosen["judge"] = judge
            return animation.compare_open_file(options.frames, out, made_by, progress, **chosen)
        if options.judge == "all":
            rows = result_of(compare_all(blender.context, out, **chosen), progress)
            return _told_engines(options, rows)
        for_page = {"trade": options.trade, "extremes": options.extremes}
        work = compare_to_folder(blender.context, out, **for_page, judge=judge, **chosen)
        return _told_comparison(options, result_of(work, progress))


def _with_picture(
    options: CompareOptions, picture: images.StoredPicture, place: dict[str, Any]
) -> int:
    """Compare with a picture of unknown make."""
    with progress_bar() as progress:
        of = _blend if is_blend(options.scene) else _file
        comparison = result_of(of(options, picture, place), progress)
        finding = page.extras(comparison, options.trade, options.extremes)
        extras = result_of(finding, progress)
    comparison_report.write(options.out, comparison, extras)
    return _told_comparison(options, comparison)


def _told_engines(options: CompareOptions, rows: tuple[engines.EngineRow, ...]) -> int:
    verdict = engines.worst(rows)
    print(*engines_report.lines(rows), f"verdict: {verdict}", sep="\n")
    pages = [options.out / row.engine / page.NAME for row in rows if row.pixels]
    return _told(options, verdict, *pages)


def _told_comparison(options: CompareOptions, comparison: Comparison) -> int:
    print(*comparison.manifest.lines(), *comparison.lines(), sep="\n")
    return _told(options, comparison.verdict, options.out / page.NAME)


def _told(options: CompareOptions, verdict: str, *pages: Path) -> int:
    """Say where the results are; return the verdict's exit code."""
    print(f"written to {options.out}")
    print("open", *pages, "in a browser")
    return EXIT_CODES[verdict]


def _blend(
    options: CompareOptions, picture: images.StoredPicture, place: dict[str, Any]
) -> Work[Comparison]:
    with open_blend(options.scene, options.choice) as blender:
        from ...blender.against import gather_against
        from ...blender.compare import compared
        from ...blender.reading.camera import export_camera
        from ...blender.versions import DITHER

        context = blender.context
        dither = DITHER * context.scene.render.dither_intensity
        shown = _shown(options, picture, export_camera(context.scene), dither)
        settings = options.settings.over(context.scene.reference_tracer.settings())
        case = gather_against(context, shown, settings, bool(options.self_check))
        return (yield from compared(replace(case, **place)))


def _file(
    options: CompareOptions, picture: images.StoredPicture, place: dict[str, Any]
) -> Work[Comparison]:
    scene, stored = load(options.scene, options.choice)
    manifest = yield from diagnosed(scene, _manifest(options.scene, scene))
    shown = _shown(options, picture, scene.camera)
    settings, checked = options.settings.over(stored), bool(options.self_check)
    case = Case(scene, manifest, settings, shown, curves=(), self_check=checked)
    return (yield from trace_and_compare(replace(case, **place)))


def _shown(
    options: CompareOptions, picture: images.StoredPicture, camera: Camera, dither: float = 0.0
) -> Picture:
    """Return what is compared of a picture: if it shows the whole view, the camera's border."""
    color = picture.color
    r = camera.region
    if color.shape[:2] == (camera.height, camera.width):
        color = np.ascontiguousarray(color[r.y0 : r.y1, r.x0 : r.x1])
    if options.dither is not None:
        dither = options.dither * picture.levels / 255
    elif picture.levels > 255:  # Blender dithers only what has 8 bits
        dither = 0.0
    return Picture(
        color,
        Source(file=options.against.name if options.against else ""),
        filter_radius=options.filter or 0.0,
        levels=picture.levels,
        dither=dither,
        opaque=picture.opaque,
    )


def _manifest(path: Path, scene: Scene) -> Manifest:
    """Return the account of a scene that never saw Blender."""
    entries = tuple(_entry(scene, number, name) for number, name in enumerate(scene.objects))
    return Manifest(path.name, path.stem, "", 0, "FILE", scene.camera.name, entries)


def _entry(scene: Scene, number: int, name: str) -> ObjectEntry:
    used = [scene.meshes[i.mesh] for i in scene.instances if i.object == number]
    planes = sum(p.object == number for p in scene.planes)
    own = {id(mesh): mesh for mesh in used}.values()
    return ObjectEntry(
        name,
        "INFINITE_PLANE" if planes else "MESH",
        exported=bool(used or planes),
        reason="" if used or planes else "nothing of it is in the file",
        triangles=sum(len(m.triangles) for m in own),
        vertices=sum(len(m.vertices) for m in own),
        instances=len(used) + planes,
        traced_triangles=sum(len(m.triangles) for m in used),
    )
