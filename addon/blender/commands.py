"""`blender FILE --command reference_tracer compare|explain|trade|extremes`, for scripts."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager, nullcontext
from pathlib import Path
from typing import Any

import bpy

from .. import arguments, running
from ..arguments import settings_from
from ..camera_options import add_camera, choice_from
from ..compare import engines
from ..compare.comparison import EXIT_CODES
from ..explain.candidates import LIMIT, gather_pixel
from ..parser import AGREE, DONE_HELP, EXIT_CODES_HELP, Parser
from ..report import comparison as comparison_report
from ..report import engines as engines_report
from ..report import extremes as extremes_report
from ..report import page, pixel
from ..report import trade as trade_report
from ..scene import SceneError
from ..study import tradeoff
from ..tracer.progress import result_of
from ..tracer.settings import Settings
from . import animation, studies
from .choice import chosen
from .compare import compare_all, compare_to_folder, export_open_file, made_folder
from .judges import choices

_handle: Any = None


def run(argv: list[str]) -> int:
    """Run the command; Blender exits with what this returns.

    An exception would make Blender exit with 1, which means warnings here.
    """
    try:
        return running.run(lambda: _run(argv), "reference_tracer")
    except SystemExit as stop:
        return int(stop.code or 0)


def _run(argv: list[str]) -> int:
    options = _parser().parse_args(argv)
    arguments.check_options(options)
    return options.run(options)


def _parser() -> Parser:
    parser = Parser("blender FILE --command reference_tracer", epilog=EXIT_CODES_HELP)
    commands = parser.add_subparsers(required=True, metavar="COMMAND", parser_class=Parser)

    def command(name: str, run: Callable[[Any], int], text: str) -> Parser:
        codes = EXIT_CODES_HELP if name == "compare" else DONE_HELP
        sub = commands.add_parser(name, help=text, epilog=codes)
        sub.set_defaults(run=run)
        sub.add_argument("--out", required=True, metavar="DIR", help="folder for what is found")
        return sub

    sub = command(
        "compare", _compare, "trace the open scene, compare it with Blender's picture, write files"
    )
    arguments.add_settings(sub)
    arguments.add_judge(sub, choices())
    arguments.add_page(sub)
    add_camera(sub)
    text = "show the maths of one pixel's ray: every step, in float32, float64 and exactly"
    sub = commands.add_parser("explain", help=text, epilog=DONE_HELP)
    sub.set_defaults(run=_explain)
    arguments.add_pixel(sub)
    add_camera(sub)
    sub = command(
        "trade",
        _trade,
        "measure what every method, precision, number of samples and size costs on the open scene",
    )
    add_camera(sub, tradeoff.WIDTH, of_scenes=True)
    sub.add_argument("--samples", type=int, metavar="N", help="up to N x N rays a pixel")
    sub = command("extremes", _extremes, "find where every method breaks; needs no file")
    sub.add_argument("--rays", type=int, metavar="N", help="about so many through each scene")
    return parser


def _compare(options: Any) -> int:
    out = bpy.path.abspath(options.out)
    with nullcontext() if options.frames is not None else comparison_report.failure_written(out):
        with _opened(options):
            return compare_open_file(options)


def _explain(options: Any) -> int:
    with _opened(options):
        scene, _, _ = export_open_file(bpy.context)
    source = bpy.path.basename(bpy.data.filepath)
    found = gather_pixel(scene, *options.pixel, options.limit or LIMIT, source)
    text = pixel.write(found, options.out, options.reproducer)
    print(arguments.printable(text), end="")
    return AGREE


def _trade(options: Any) -> int:
    with _opened(options):
        folder = made_folder(options.out)
        samples = settings_from(options, Settings(samples=tradeoff.SAMPLES)).samples
        found = result_of(studies.trade(bpy.context, options.width, samples))
    studies.write(trade_report, folder, found)
    print(trade_report.table(found), f"written to {folder}", sep="\n")
    return AGREE


def _extremes(options: Any) -> int:
    folder = made_folder(options.out)
    rows = result_of(studies.extremes(rays=options.rays))
    studies.write(extremes_report, folder, rows)
    print(extremes_report.breaking_table(rows), f"written to {folder}", sep="\n")
    return AGREE


@contextmanager
def _opened(options: Any) -> Iterator[None]:
    """Have the open file as the options choose, for a while."""
    if not bpy.data.filepath:
        raise SceneError("no file is open (is its name right?): name a .blend before --command")
    with chosen(choice_from(options)):
        yield


def compare_open_file(options: Any, progress: Any = None) -> int:
    """Compare the scene of the open file as the options say, print it, return the exit code.

    Raises
    ------
    SceneError, SizeError, OSError, AssumptionError, MemoryError
        What :func:`compare_to_folder` raises; the folder's JSON says why.
    """
    chosen = {
        "settings": settings_from(options, bpy.context.scene.reference_tracer.settings()),
        "as_is": options.as_is or None,
        "identity": options.identity,
        "self_check": options.self_check,
    }
    judge = options.judge.upper() if options.judge else None
    if options.frames:
        return animation.compare_open_file(options, progress, judge=judge, **chosen)
    if options.judge == "all":
        rows = result_of(compare_all(bpy.context, options.out, **chosen), progress)
        verdict = engines.worst(rows)
        print(*engines_report.lines(rows), f"verdict: {verdict}", sep="\n")
        print(f"written to {options.out}")
        pages = [Path(options.out) / row.engine / page.NAME for row in rows if row.pixels]
        print("open", *pages, "in a browser")
        return EXIT_CODES[verdict]
    for_page = {"trade": options.trade, "extremes": options.extremes}
    work = compare_to_folder(bpy.context, options.out, **for_page, judge=judge, **chosen)
    comparison = result_of(work, progress)
    print(*comparison.manifest.lines(), *comparison.lines(), f"written to {options.out}", sep="\n")
    print(f"open {Path(options.out) / page.NAME} in a browser")
    return EXIT_CODES[comparison.verdict]


def register() -> None:
    """Register the command."""
    global _handle
    _handle = bpy.utils.register_cli_command("reference_tracer", run)


def unregister() -> None:
    """Undo :func:`register`."""
    bpy.utils.unregister_cli_command(_handle)
