"""`reftrace trade`: measures what tracing a scene costs, method by method."""

from __future__ import annotations

from argparse import Namespace
from contextlib import nullcontext
from dataclasses import dataclass
from pathlib import Path

from ...framing import Choice
from ...report import folders
from ...report import trade as report
from ...study import tradeoff
from ...tracer.progress import result_of
from ...tracer.settings import Settings
from ...wording import show
from ..arguments import GivenSettings, Place, place_from
from ..camera_options import add_camera, choice_from
from ..named import Setting
from ..opening import SOURCES, load
from ..parser import AGREE, COUNT, INTEGER, Parser
from ..running import progress_bar


@dataclass(frozen=True)
class TradeOptions:
    """The options of `reftrace trade`."""

    scene: Path
    out: Path | None
    samples: int
    width: int | None  # of the largest picture
    choice: Choice
    place: Place

    @classmethod
    def parsed(cls, given: Namespace) -> TradeOptions:
        """Return what was parsed; raises SceneError if options contradict one another."""
        most = GivenSettings(samples=given.samples).over(Settings(samples=tradeoff.SAMPLES))
        return cls(
            scene=given.scene,
            out=given.out,
            samples=most.samples,
            width=given.largest,
            choice=choice_from(given, given.scene),
            place=place_from(given),
        )


def add(parser: Parser) -> None:
    """Add the command's options."""
    parser.runs(
        lambda given: trade(TradeOptions.parsed(given)),
        "reftrace trade sample_scenes/suzanne.blend --out out/",
    )
    parser.add_scene(SOURCES)
    parser.add_argument(
        "--out", type=parser.path, metavar="DIR", help="folder for the table, JSON and plot"
    )
    parser.add_argument(
        "--samples",
        type=INTEGER,
        metavar="N",
        help=f"measure up to N x N rays a pixel (default {tradeoff.SAMPLES})",
    )
    width = Setting(
        "width",
        "PIXELS",
        COUNT,
        "of the largest picture; its height follows "
        f"(default {tradeoff.WIDTH}, or the scene's own width where that is less)",
        "largest",
    )
    add_camera(parser, (width,))


def trade(options: TradeOptions) -> int:
    """Measure, and print the table."""
    with folders.made(options.out) if options.out else nullcontext():
        scene, _ = load(options.scene, options.choice)
        with options.place as place, progress_bar() as progress:
            name = options.scene.name
            work = tradeoff.measure(scene, options.width, options.samples, name, **place)
            found = result_of(work, progress)
        show(*report.table(found).split("\n"))
        if options.out:
            report.write(options.out, found)
            show(f"written to {options.out}")
    return AGREE
