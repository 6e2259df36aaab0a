"""`reftrace compare`: compares a scene with a picture of it, Blender's own or anybody's."""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence
from contextlib import nullcontext
from dataclasses import replace
from pathlib import Path
from typing import Any

from ...camera_files.files import of_frames
from ...causes.case import Case
from ...comparison import engines
from ...comparison.animation import frames_named
from ...comparison.comparison import Comparison
from ...comparison.verdict import Verdict
from ...files import images
from ...framing import FRAMED
from ...manifest import Effect
from ...pictures import colors_file
from ...pictures.colors_file import in_colors
from ...pictures.given import GivenFile, GivenPicture
from ...pictures.palette import By, GivenColors
from ...report import animation as frames_report
from ...report import comparison as comparison_report
from ...report import engines as engines_report
from ...report import folders, page
from ...report.junit import Judged, junit, of_comparison
from ...report.lines import describe
from ...scene import Scene, SceneError
from ...tracer.progress import Event, Work, result_of
from ...wording import show
from ..arguments import is_blend
from ..compare_options import CompareOptions, add_options
from ..opening import evaluating, import_trimesh, open_blend, open_file
from ..parser import AGREE, EXIT_CODES_HELP, Parser
from ..running import progress_bar

_FRAMED = (
    "the camera is none of the mesh's: it was placed to see all of it; "
    "--set eye=, target= and angle= say that of the picture"
)


def add(parser: Parser) -> None:
    """Add the command's options."""
    examples = (
        "reftrace compare scene.blend --out out/\n"
        "  reftrace compare scene.npz --against student.png --out out/"
    )
    parser.runs(lambda given: compare(CompareOptions.parsed(given)), examples, EXIT_CODES_HELP)
    add_options(parser)


def compare(options: CompareOptions) -> int:
    """Compare; the exit code is the verdict's, and a folder without results says why."""
    if options.only_colors:
        return _only_colors(options, options.only_colors)
    results = [folders.place_of(options.out / name) for name in comparison_report.NAMES]
    colors = options.colors if isinstance(options.colors, Path) else None
    for file in (options.scene, options.against, colors, options.colors_out, options.junit):
        if file and folders.place_of(file) in results:
            raise SceneError(
                f"'{file}' has the name of a result: choose another --out, or rename it"
            )
    if options.junit:  # that of an earlier run would pass for this one's
        options.junit.unlink(missing_ok=True)
    written = comparison_report.failure_written(options.out)  # but for an animation
    with (
        folders.made(options.out),
        written if options.frames is None else nullcontext(),
        options.place as place,
    ):
        import_trimesh()  # which diagnoses the meshes
        if options.against is None:
            return _with_blender(options, place)
        picture = options.data or GivenFile(images.open_picture(options.against))
        return _with_picture(options, picture, place)


def _with_blender(options: CompareOptions, place: dict[str, Any]) -> int:
    """Compare a .blend with what Blender draws of it; return the exit code."""
    if not is_blend(options.scene):
        raise SceneError(
            f"'{options.scene}' is not a .blend: Blender draws only those. Name a picture of it "
            "with --against"
        )
    with open_blend(options.scene, options.choice) as blender, progress_bar() as progress:
        from ...blender.jobs.compare import compare_open_file
        from ...blender.jobs.engines import compare_all

        stored = blender.context.scene.reference_tracer.settings()
        judge = options.judge.upper() if options.judge else None
        chosen: dict[str, Any] = {
            "settings": options.settings.over(stored),
            "as_is": options.as_is or None,
            "colors": _colors(options),
            "identity": options.identity,
            "self_check": options.self_check,
            "renderer": options.making.renderer or None,
            "filter": options.making.filter_radius or None,
            **place,
        }
        if options.frames:
            return _frames(
                options, options.frames, blender.context.scene, progress, judge=judge, **chosen
            )
        chosen["diagnose"] = options.diagnosis
        layer = blender.context.view_layer
        if options.judge == "all":
            with evaluating(layer, "and draw the scene"):
                work_of_all = compare_all(blender.context, options.out, **chosen)
            return _told_engines(options, result_of(work_of_all, progress))
        studies = options.trade, options.extremes
        with evaluating(layer, "and draw the scene"):
            work = compare_open_file(blender.context, options.out, *studies, judge=judge, **chosen)
        return _told_comparison(options, result_of(work, progress))


def _frames(
    options: CompareOptions,
    named: str,
    scene: Any,
    progress: Callable[[Event], None],
    **chosen: Any,
) -> int:
    """Compare the frames that are named of the open file; the exit code is that of the worst."""
    from ...blender.jobs.animation import compare_frames, depends_on, frames_of
    from ...blender.jobs.stepping import bake_bodies

    frames = frames_named(named) or frames_of(scene)
    views = of_frames(options.choice.views, frames) if options.choice.views else {}
    bake_bodies(scene, frames[-1])

    made_by = depends_on(options.of_a_frame())
    work = compare_frames(options.out, frames, made_by, views, **chosen)
    try:
        rows = result_of(work, progress)
    except KeyboardInterrupt:
        show("what is done is kept: the same command goes on from there", file=sys.stderr)
        raise
    show(*frames_report.lines(frames, rows))
    _write_junit(
        options, [_judged(f"frame {r.frame}", r.verdict, frames_report.line(r)) for r in rows]
    )
    return _told(options, frames_report.verdict(rows), options.out / frames_report.PAGE)


def _with_picture(options: CompareOptions, picture: GivenPicture, place: dict[str, Any]) -> int:
    """Compare with a picture from a file."""
    with progress_bar() as progress:
        of = _blend if is_blend(options.scene) else _file
        comparison = result_of(of(options, picture, place), progress)
    return _told_comparison(options, comparison)


def _colors(options: CompareOptions) -> By | GivenColors | None:
    """Return where the colours come from; None if nothing says so."""
    return colors_file.read(options.colors) if isinstance(options.colors, Path) else options.colors


def _told_engines(options: CompareOptions, rows: tuple[engines.EngineRow, ...]) -> int:
    verdict = engines.worst(rows)
    show(*engines_report.lines(rows), f"verdict: {verdict}")
    pages = [options.out / row.engine / page.NAME for row in rows if row.counts]
    told = [_judged(r.engine, r.verdict, "\n".join(engines_report.lines([r]))) for r in rows]
    _write_junit(options, told)
    return _told(options, verdict, *pages)


def _told_comparison(options: CompareOptions, comparison: Comparison) -> int:
    """Print a comparison; return the exit code."""
    if options.colors_out:
        _write_colors(options.colors_out, comparison.scene, comparison.manifest.owners)
    show(*comparison.manifest.lines(), *describe(comparison))
    _write_junit(options, [of_comparison(options.scene.name, comparison)])
    return _told(options, comparison.verdict, options.out / page.NAME)


def _judged(name: str, verdict: Verdict, lines: str) -> Judged:
    return Judged(name, "" if verdict is Verdict.AGREE else str(verdict), lines)


def _write_junit(options: CompareOptions, judged: Sequence[Judged]) -> None:
    if options.junit:
        text = junit("reftrace compare", {str(options.scene): judged})
        folders.write_text(options.junit, text)


def _only_colors(options: CompareOptions, path: Path) -> int:
    """Write the colours for a picture that is still to be rendered."""
    colors = _colors(options)
    if is_blend(options.scene):
        with open_blend(options.scene, options.choice) as blender:
            from ...blender.jobs.against import exported_in
            from ...blender.jobs.open_file import Choices

            colors = colors or Choices.of(blender.context.scene, {}).colors
            _, scene, manifest = exported_in(blender.context, colors)
    else:
        scene, manifest, _ = open_file(options.scene, options.choice)
        scene, notes = in_colors(scene, colors or By.AUTOMATIC)
        manifest = replace(manifest, notes=(*manifest.notes, *notes))
    _write_colors(path, scene, manifest.owners)
    show(*manifest.lines(), f"written to {path}")
    return AGREE


def _write_colors(path: Path, scene: Scene, owners: Sequence[str]) -> None:
    folders.write_text(path, colors_file.text(scene, owners))


def _told(options: CompareOptions, verdict: Verdict, *pages: Path) -> int:
    """Say where the results are; return the verdict's exit code."""
    written = " and ".join(map(str, filter(None, (options.out, options.colors_out))))
    show(f"written to {written}", f"open {' '.join(map(str, pages))} in a browser")
    return verdict.exit_code


def _blend(
    options: CompareOptions, picture: GivenPicture, place: dict[str, Any]
) -> Work[Comparison]:
    with open_blend(options.scene, options.choice) as blender:
        from ...blender.jobs.against import gather_against
        from ...blender.versions import DITHER

        context = blender.context
        dither = DITHER * context.scene.render.dither_intensity
        making = replace(options.making, default_dither=dither)
        settings = options.settings.over(context.scene.reference_tracer.settings())
        colors = _colors(options) or By.VIEWPORT
        with evaluating(context.view_layer, "the scene"):
            case = gather_against(
                context,
                lambda drawing: picture.picture(drawing.exported, making),
                settings,
                bool(options.self_check),
                colors,
            )
        return (yield from _written(options, replace(case, **place)))


def _file(
    options: CompareOptions, picture: GivenPicture, place: dict[str, Any]
) -> Work[Comparison]:
    scene, manifest, stored = open_file(options.scene, options.choice)
    own = scene
    scene, notes = in_colors(own, _colors(options) or By.VIEWPORT)
    if scene is not own:  # in given colours none is unknown
        known = tuple(u for u in manifest.unmodelled if u.effect is not Effect.COLOR)
        manifest = replace(manifest, unmodelled=known)
    if scene.camera.name == FRAMED:
        notes = (*notes, _FRAMED)
    manifest = replace(manifest, notes=(*manifest.notes, *notes))
    shown = picture.picture(scene, options.making)
    settings, checked = options.settings.over(stored), bool(options.self_check)
    case = Case(scene, manifest, settings, shown, curves=(), self_check=checked)
    return (yield from _written(options, replace(case, **place)))


def _written(options: CompareOptions, case: Case) -> Work[Comparison]:
    diagnose = options.diagnosis is not False
    return comparison_report.written(options.out, case, diagnose, options.trade, options.extremes)
