"""`reftrace rays`: what any rays meet in a scene, certified, for who writes intersectors."""

from __future__ import annotations

from argparse import Namespace
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from reference_tracer.certified.any_rays import nearest_hits
from reference_tracer.certified.arithmetic import check_assumptions
from reference_tracer.cli.camera_options import add_parts, choice_from
from reference_tracer.cli.opening import SOURCES, open_file
from reference_tracer.cli.parser import AGREE, Parser, number
from reference_tracer.cli.running import progress_bar
from reference_tracer.framing import Choice
from reference_tracer.report import folders
from reference_tracer.scene import SceneError
from reference_tracer.tracer.hits import NOTHING, Statistics
from reference_tracer.tracer.progress import result_of, scaled
from reference_tracer.tracer.world import refused
from reference_tracer.wording import count_of, show

from .files import load_rays, save_hits

_T = number(float, lambda value: not np.isnan(value), "a number")


@dataclass(frozen=True)
class RaysOptions:
    """The options of `reftrace rays`."""

    scene: Path
    rays: Path
    out: Path
    choice: Choice
    start: float
    end: float
    every_pair: bool

    @classmethod
    def parsed(cls, given: Namespace) -> RaysOptions:
        """Return what was parsed; raises SceneError if options contradict one another."""
        if not given.start < given.end:
            raise SceneError(f"--start {given.start:g} is not below --end {given.end:g}")
        if folders.place_of(given.out) in map(folders.place_of, (given.scene, given.rays)):
            raise SceneError(f"--out '{given.out}' is a file that is read: choose another")
        choice = choice_from(given, given.scene)
        return cls(
            given.scene, given.rays, given.out, choice, given.start, given.end, given.every_pair
        )


def add(parser: Parser) -> None:
    """Add the command's options."""
    parser.runs(
        lambda given: rays(RaysOptions.parsed(given)),
        "reftrace rays scene.glb rays.npz --out hits.npz",
    )
    parser.add_scene(SOURCES)
    parser.add_argument(
        "rays",
        type=parser.path_ending(".npz"),
        metavar="RAYS.npz",
        help="arrays origins and directions, (n, 3) each, world space, Z up, in metres",
    )
    parser.add_argument(
        "--out",
        required=True,
        type=parser.path_ending(".npz"),
        metavar="HITS.npz",
        help="the file to write: t, object, instance, triangle, barycentrics and ties of each ray",
    )
    for name, own, what in (("start", 0.0, "least"), ("end", np.inf, "largest")):
        parser.add_argument(
            f"--{name}",
            type=_T,
            default=own,
            metavar="T",
            help=f"the {what} t that counts, in lengths of the direction (default %(default)g)",
        )
    parser.add_argument(
        "--every-pair",
        action="store_true",
        help="test each ray with each triangle, without a tree of boxes: sees the same, far slower",
    )
    add_parts(parser)


def rays(options: RaysOptions) -> int:
    """Trace, and write what the rays meet."""
    check_assumptions()
    given = load_rays(options.rays)
    with folders.made_for_file(options.out):
        opened = open_file(options.scene, options.choice, whole=True)
        scene = opened.scene
        show(*opened.manifest.lines())
        found = Statistics(method="certified", refused=refused(scene))
        clip = options.start, options.end
        with progress_bar() as progress:
            work = nearest_hits(scene, given, clip, found, culled=not options.every_pair)
            hits = result_of(scaled(work, 0.0, 1.0, "tracing"), progress)
        with folders.replacing_file(options.out) as new:
            save_hits(new, scene, hits)
    met = count_of(int((hits.instance != NOTHING).sum()), "hit")
    show(
        f"{count_of(len(hits), 'ray')}, {count_of(scene.triangle_count, 'triangle')}: {met}, "
        f"{len(hits.ties.ray):,} ambiguous: {options.out}"
    )
    show(*found.required())
    return AGREE
