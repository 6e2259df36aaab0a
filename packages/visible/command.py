"""`reftrace visible`: which faces a camera sees, each with a witness or a proof."""

from __future__ import annotations

from argparse import Namespace
from dataclasses import dataclass
from pathlib import Path

from reference_tracer.cli.arguments import check_frames
from reference_tracer.cli.camera_options import add_camera, choice_from
from reference_tracer.cli.opening import SOURCES, open_frames
from reference_tracer.cli.parser import AGREE, COUNT, POSITIVE, Parser
from reference_tracer.cli.running import progress_bar
from reference_tracer.framing import Choice
from reference_tracer.report import folders
from reference_tracer.scene import SceneError
from reference_tracer.tracer.progress import result_of, scaled
from reference_tracer.visible.visible import LIMIT, WORK, steps
from reference_tracer.wording import show

from .files import Total


@dataclass(frozen=True)
class VisibleOptions:
    """The options of `reftrace visible`."""

    scene: Path
    out: Path
    choice: Choice
    frames: str | None  # as they are typed
    limit: float
    work: int

    @classmethod
    def parsed(cls, given: Namespace) -> VisibleOptions:
        """Return what was parsed; raises SceneError if options contradict one another."""
        if folders.place_of(given.out) == folders.place_of(given.scene):
            raise SceneError(f"--out '{given.out}' is the scene that is read: choose another")
        if given.frames is not None:
            check_frames(given, ())
        choice = choice_from(given, given.scene, given.frames is not None)
        return cls(given.scene, given.out, choice, given.frames, given.limit, given.work)


def add(parser: Parser) -> None:
    """Add the command's options."""
    parser.runs(
        lambda given: find(VisibleOptions.parsed(given)),
        "reftrace visible scene.blend --out visible.npz\n"
        "  reftrace visible scene.blend --frames all --out visible.npz",
    )
    parser.add_scene(SOURCES)
    parser.add_argument(
        "--out",
        required=True,
        type=parser.path_ending(".npz"),
        metavar="FILE.npz",
        help="the file to write: seen (0 hidden, 1 seen, 2 undecided), witness and area of each "
        "face; FILE.json beside it has the counts of each object",
    )
    parser.add_argument(
        "--limit",
        type=POSITIVE,
        default=LIMIT,
        metavar="AREA",
        help="square pixels: a face that may show no more than this stays undecided (default "
        "%(default)g)",
    )
    parser.add_argument(
        "--work",
        type=COUNT,
        default=WORK,
        metavar="PAIRS",
        help="compare about so many pairs of faces; the rest is undecided (default %(default)s)",
    )
    parser.add_argument(
        "--frames",
        metavar="FRAMES",
        help="what is seen in any of these frames of a .blend, and in how many: 1-250, 1-250:5 or "
        "all",
    )
    add_camera(parser)


def find(options: VisibleOptions) -> int:
    """Decide every face, and write what is found."""
    scene, choice, named = options.scene, options.choice, options.frames
    with folders.made_for_file(options.out):
        total = None
        frames = []
        said: dict[str, None] = {}
        for frame, file in open_frames(scene, choice, named, whole=True):
            said |= dict.fromkeys(file.manifest.remarks())
            with progress_bar() as progress:
                work = steps(file.scene, options.limit, options.work)
                work = scaled(work, 0.0, None, f"frame {frame}" if named else "")
                found = result_of(work, progress)
            add = total.add if total else Total.of
            total = add(file.scene, found, frame)
            frames.append(frame)
        if total is None:
            raise SceneError("--frames names none")
        total.save(options.out, frames if named else [], options.limit)
    show(*said, *total.lines(), f"{total.summary()}: {options.out}")
    return AGREE
