"""`reftrace trade`: measures what tracing a scene costs, method by method."""

from __future__ import annotations

from argparse import Namespace
from contextlib import nullcontext
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


def add(parser: Parser) -> None:
    """Add the command's options."""

    def run(given: Namespace) -> int:
        most = GivenSettings(samples=given.samples).over(Settings(samples=tradeoff.SAMPLES))
        choice = choice_from(given, given.scene)
        size = given.largest, most.samples
        return trade(given.scene, choice, given.out, *size, place_from(given))

    parser.runs(run, "reftrace trade sample_scenes/suzanne.blend --out out/")
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


def trade(
    scene: Path, choice: Choice, out: Path | None, width: int | None, samples: int, place: Place
) -> int:
    """Measure, and print the table; `width` is that of the largest picture."""
    with folders.made(out) if out else nullcontext():
        loaded, _ = load(scene, choice)
        with place as chosen, progress_bar() as progress:
            work = tradeoff.measure(loaded, width, samples, scene.name, **chosen)
            found = result_of(work, progress)
        show(*report.table(found).split("\n"))
        if out:
            report.write(out, found)
            show(f"written to {out}")
    return AGREE
