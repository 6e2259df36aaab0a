"""`reftrace visible`: which faces a camera sees, each with a witness or a proof."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Iterator
from functools import reduce
from pathlib import Path

from reference_tracer.cli.arguments import check_frames
from reference_tracer.cli.camera_options import add_camera, choice_from
from reference_tracer.cli.opening import SOURCES, open_frames
from reference_tracer.cli.parser import AGREE, COUNT, POSITIVE, Parser
from reference_tracer.cli.running import progress_bar
from reference_tracer.report import folders
from reference_tracer.scene import SceneError
from reference_tracer.tracer.progress import result_of, scaled
from reference_tracer.visible.visible import LIMIT, WORK, steps
from reference_tracer.wording import show

from .files import Total


def add(parser: Parser) -> None:
    """Add the command's options."""
    parser.runs(
        find,
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
        "face; FILE.json beside it has each object's counts, and each frame's camera",
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


def find(given: Namespace) -> int:
    """Decide every face, and write what is found."""
    written = given.out, given.out.with_suffix(".json")
    read = given.scene, Path(given.camera or given.scene)
    if {*map(folders.place_of, written)} & {*map(folders.place_of, read)}:
        raise SceneError(f"--out '{given.out}' replaces a file that is read: choose another")
    notes: dict[str, None] = {}
    with folders.made_for_file(written[0]), folders.made_for_file(written[1]):
        total = reduce(Total.add, _frames(given, notes))
        total.save(*written, given.limit)
    show(*notes, *total.lines(), f"Written: {given.out}")
    return AGREE


def _frames(given: Namespace, notes: dict[str, None]) -> Iterator[Total]:
    """Yield what is found in each frame; `notes` gets what there is to say of their scenes."""
    of_frames = given.frames is not None
    if of_frames:
        check_frames(given, ())
    choice = choice_from(given, given.scene, of_frames)
    for frame, opened in open_frames(given.scene, choice, given.frames, whole=True):
        notes |= dict.fromkeys(opened.manifest.remarks())
        work = steps(opened.scene, given.limit, given.work)
        with progress_bar() as progress:
            work = scaled(work, 0.0, None, f"frame {frame}" if of_frames else "")
            found = result_of(work, progress)
        yield Total(opened.scene, found, frame)
