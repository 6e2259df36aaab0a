"""`reftrace rays`: what any rays meet in a scene, certified, for who writes intersectors."""

from __future__ import annotations

from argparse import Namespace
from typing import Any

import numpy as np
from reference_tracer.certainty import Certainty
from reference_tracer.certified.any_rays import nearest_hits
from reference_tracer.cli.camera_options import add_parts, choice_from
from reference_tracer.cli.opening import SOURCES, open_file
from reference_tracer.cli.parser import AGREE, Parser, number
from reference_tracer.cli.running import progress_bar
from reference_tracer.report import folders
from reference_tracer.scene import SceneError
from reference_tracer.tracer.hits import NOTHING, Hits, Statistics
from reference_tracer.tracer.progress import Work, result_of, scaled
from reference_tracer.tracer.world import refused
from reference_tracer.wording import count_of, show

from .every import Crossings, all_hits
from .files import load_points, load_rays, save
from .inside import Inside, places

_T = number(float, lambda _: True, "a number")


def add(parser: Parser) -> None:
    """Add the command's options."""
    parser.runs(rays, "reftrace rays scene.glb rays.npz --out hits.npz")
    parser.add_scene(SOURCES)
    parser.add_argument(
        "rays",
        type=parser.path_ending(".npz"),
        metavar="RAYS.npz",
        help="arrays origins and directions, (n, 3) each, world space, Z up, in metres; points "
        "with --parity",
    )
    parser.add_argument(
        "--out",
        required=True,
        type=parser.path_ending(".npz"),
        metavar="HITS.npz",
        help="the file to write: t, object, instance, triangle, barycentrics and ties of each ray; "
        "also start, enters and same_t with --every; place and winding with --parity",
    )
    for name, t, what in (("start", 0.0, "least"), ("end", np.inf, "largest")):
        words = f"the {what} t that counts, in lengths of the direction (default %(default)g)"
        parser.add_argument(f"--{name}", type=_T, default=t, metavar="T", help=words)
    ways = parser.add_mutually_exclusive_group()
    for name, words in (
        ("every", "write all that each ray meets, each surface once, in order of t"),
        ("parity", "write which points lie inside closed meshes, and their winding numbers"),
        ("every-pair", "test each ray with each triangle, without a tree of boxes: far slower"),
    ):
        ways.add_argument(f"--{name}", action="store_true", help=words)
    add_parts(parser)


def rays(given: Namespace) -> int:
    """Trace, and write what the rays meet, or where points are."""
    clip = given.start, given.end
    if not given.start < given.end:
        raise SceneError(f"--start {given.start:g} is not below --end {given.end:g}")
    if given.parity and clip != (0, np.inf):
        raise SceneError("--parity takes whole rays: leave out --start and --end")
    if folders.place_of(given.out) in map(folders.place_of, (given.scene, given.rays)):
        raise SceneError(f"--out '{given.out}' is a file that is read: choose another")
    choice = choice_from(given, given.scene)
    read = (load_points if given.parity else load_rays)(given.rays)
    with folders.made_for_file(given.out):
        opened = open_file(given.scene, choice, whole=True)
        scene = opened.scene
        show(*opened.manifest.lines())
        statistics = Statistics(refused=refused(scene))
        work: Work[Any]
        if given.parity:
            work = places(scene, read)
        elif given.every:
            work = all_hits(scene, read, clip)
        else:
            statistics.method = "certified"
            work = nearest_hits(scene, read, clip, statistics, not given.every_pair)
        with progress_bar() as progress:
            found: Any = result_of(scaled(work, 0.0, 1.0, "tracing"), progress)
        with folders.replacing_file(given.out) as new:
            save(new, scene, read.count, found)
    counts = count_of(read.count, "point" if given.parity else "ray")
    counts += f", {count_of(scene.triangle_count, 'triangle')}: {_said(found)}"
    show(f"{counts}: {given.out}", *statistics.required())
    return AGREE


def _said(found: Hits | Crossings | Inside) -> str:
    if isinstance(found, Inside):
        said = "{:,} outside, {:,} inside, {:,} on a surface"
        if found.winding is None:
            said += "; no winding numbers, as faces of a mesh are turned against one another"
        return said.format(*np.bincount(found.place, minlength=3))
    met = count_of((found.instance != NOTHING).sum(), "hit")
    return f"{met}, {(found.certainty == Certainty.AMBIGUOUS).sum():,} ambiguous"
