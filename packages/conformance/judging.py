"""Runs a renderer or an exporter on the kit's scenes, and compares what it makes of each."""

from __future__ import annotations

import shutil
import tempfile
import time
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

from reference_tracer.causes.case import Case
from reference_tracer.comparison.comparing import compared, diagnosed
from reference_tracer.comparison.comparison import Comparison
from reference_tracer.comparison.verdict import Verdict
from reference_tracer.errors import EXPECTED, words
from reference_tracer.files.images import open_picture
from reference_tracer.files.scenes import Account
from reference_tracer.opened import file_manifest
from reference_tracer.pictures.colors_file import in_colors
from reference_tracer.pictures.given import Making, picture_of_array, picture_of_file
from reference_tracer.pictures.palette import GivenColors
from reference_tracer.pictures.picture import Picture
from reference_tracer.pictures.source import SizeError
from reference_tracer.rendering import render
from reference_tracer.report import comparison as comparison_report
from reference_tracer.report.junit import Judged, of_comparison
from reference_tracer.scene import Scene, SceneError
from reference_tracer.tracer.progress import Progress, Work, scaled
from reference_tracer.tracer.settings import Settings
from reference_tracer_meshes import FORMATS
from reference_tracer_meshes.load import load_meshes, scene_of_meshes
from reference_tracer_processes.running import Limits, ProgramError, filled, run

from .kit import CAMERA_Y_UP, FILES, write_kit
from .scenes import KitScene

PICTURES = ".png", ".exr"
# Of a diagnosis, for each second that the program may take: some five times as many are done.
STEPS = 200
SCENE, OUT, CAMERA = "{scene}", "{out}", "{camera}"


@dataclass(frozen=True)
class Program:
    """How a renderer or an exporter is started, and what is known of its pictures."""

    command: str
    words: tuple[str, ...]  # with {out}, and {scene} or another of FILES in braces
    ending: str = ".png"  # of what it writes: a picture's, or a mesh file's of an exporter
    renderer: str = ""  # whose rounding excuses a pixel, as of `Making`
    filter_radius: float = 0.0
    limits: Limits = field(default_factory=Limits)
    boxed: bool = True  # kept in the sandbox

    @property
    def files(self) -> dict[str, str]:
        """The file that stands for each name in braces."""
        names = {f"{{{key}}}": name for key, (name, _) in FILES.items()}
        if any(SCENE in word for word in self.words):
            names[CAMERA] = CAMERA_Y_UP
        return names | {OUT: f"out{self.ending}"}


@dataclass(frozen=True, eq=False)
class Result:
    """The result of a scene."""

    kit: KitScene
    judged: Judged
    verdict: Verdict
    comparison: Comparison | None = None  # None if it could not be compared


def conform(program: Program, scenes: Sequence[KitScene], out: Path) -> Work[list[Result]]:
    """Judge a program on scenes, in steps; the page of each is written before the next is made.

    Raises
    ------
    SceneError
        If .blend files are asked for, and there is no bpy.
    """
    found = []
    with tempfile.TemporaryDirectory(
        prefix="reftrace-conform-", ignore_cleanup_errors=True
    ) as name:
        folder = Path(name)
        yield Progress(0.0, "writing the kit")
        write_kit(folder, scenes, any("{blend}" in word for word in program.words))
        for k, kit in enumerate(scenes):
            yield Progress(k / len(scenes), kit.name)
            work = _judged(program, kit, folder / kit.name)
            result = yield from scaled(work, k / len(scenes), 1 / len(scenes), kit.name)
            yield from _keep(out, result)
            found.append(replace(result, comparison=None))  # it is large
            shutil.rmtree(folder / kit.name, ignore_errors=True)
    return found


def _keep(folder: Path, result: Result) -> Work[None]:
    """Write the page of a scene that does not agree; remove one that an earlier run left."""
    own = folder / result.kit.name
    found = result.comparison
    if found and result.judged.failure:
        yield from comparison_report.write(own, found)
        return
    for name in comparison_report.NAMES:
        (own / name).unlink(missing_ok=True)
    if own.is_dir() and not any(own.iterdir()):
        own.rmdir()


def _judged(program: Program, kit: KitScene, folder: Path) -> Work[Result]:
    """Run the program on one scene, and compare."""
    began = time.monotonic()
    try:
        made = _run(program, folder)
        seconds = time.monotonic() - began
        making = Making(program.renderer, program.filter_radius)
        scene = kit.scene
        if program.ending in FORMATS:
            colors = _one_color_each(scene)
            scene, _ = in_colors(scene, colors)
            shown = _picture_of_export(made, scene, colors, making)
        else:
            shown = picture_of_file(open_picture(made), scene.camera, making)
        manifest = file_manifest(folder / "scene.npz", scene, Account())
        case = Case(scene, manifest, Settings(), shown, curves=())
        found = yield from compared(case)
        found = yield from diagnosed(found, at_most=STEPS * program.limits.seconds)
    except (ProgramError, ValueError, *EXPECTED) as error:
        # There are no options of a kit's scene.
        why = error.args[0] if isinstance(error, SizeError) else words(error)
        why = why.replace(f"{folder}/", "")
        judged = Judged(kit.name, why, why, time.monotonic() - began)
        return Result(kit, judged, Verdict.FAILED)
    return Result(kit, of_comparison(kit.name, found, seconds), found.verdict, found)


def _run(program: Program, folder: Path) -> Path:
    """Run the program in a scene's folder, the one that it may write to; return what it made."""
    names = {name: str(folder / file) for name, file in program.files.items()}
    with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err:
        run(
            filled(program.words, names),
            folder,
            program.limits,
            (None, out, err),
            program.boxed,
        )
    made = folder / program.files[OUT]
    if not made.is_file():
        raise SceneError(f"it ended well, but wrote no file {OUT} ({made.name})")
    return made


def _one_color_each(scene: Scene) -> GivenColors:
    """Return the first colour of each object, by its name."""
    names = scene.objects
    first = {(names[i.object],) * 2: i.colors[:1, :3] for i in scene.instances}
    return GivenColors("the kit", first)


def _picture_of_export(made: Path, scene: Scene, colors: GivenColors, making: Making) -> Picture:
    """Trace an exported file through a scene's own camera, each object in the colour of its name.

    Raises
    ------
    SceneError
        If it has other objects, or fewer.
    """
    camera = scene.camera
    found = scene_of_meshes(load_meshes(made), camera, camera.width, camera.height)
    own, other = set(scene.objects), set(found.objects)
    if own != other:
        parts = {"lacks": own - other, "has besides": other - own}
        said = (f"{verb} {', '.join(map(repr, sorted(n)))}" for verb, n in parts.items() if n)
        how = "objects are told apart by their names"
        raise SceneError(f"{how}, and the export {' and '.join(said)}")
    found, _ = in_colors(found, colors)
    return picture_of_array(render(found).color, camera, making)
