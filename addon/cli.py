"""The command `reftrace`: the tracer, the comparison and the studies outside Blender's window."""

from __future__ import annotations

import sys
import traceback

from . import __version__, images, interrupts
from .arguments import EXIT_CODES, INPUT_ERROR, INTERRUPTED, SIZES_DIFFER, Parser, check, words
from .commands import bench, compare, explain, export, extremes, judge, trace, trade
from .compare.comparison import SizeError
from .scene import SceneError
from .tracer.certainty import AssumptionError

COMMANDS = (compare, trace, explain, judge, trade, extremes, bench, export)

_EXPECTED = (  # what a user can do something about
    *(SceneError, SizeError, OSError, MemoryError),
    *(images.MissingLibraryError, AssumptionError),
)


def main(argv: list[str] | None = None) -> int:
    """Run `reftrace`; returns the exit code."""
    for stream in filter(None, (sys.stdout, sys.stderr)):  # which may not have each letter
        stream.reconfigure(errors="backslashreplace")
    options = _parser().parse_args(argv)
    try:
        with interrupts.heard():
            check(options)
            return options.run(options)
    except KeyboardInterrupt:
        print("reftrace: interrupted", file=sys.stderr)
        return INTERRUPTED
    except _EXPECTED as error:
        print(f"reftrace: {words(error)}", file=sys.stderr)
        return SIZES_DIFFER if isinstance(error, SizeError) else INPUT_ERROR
    except Exception as error:  # Python's own exit code for it, 1, means warnings here
        traceback.print_exc()
        print(f"reftrace: {type(error).__name__}: {error}", file=sys.stderr)
        return INPUT_ERROR


def _parser() -> Parser:
    parser = Parser(
        "reftrace",
        epilog=EXIT_CODES,
        description=(
            "Trace a scene with the textbook's plane and triangle maths, and compare what Blender "
            "shows with it, pixel by pixel."
        ),
    )
    parser.add_argument("--version", action="version", version=f"reftrace {__version__}")
    commands = parser.add_subparsers(required=True, metavar="COMMAND", parser_class=Parser)
    for command in COMMANDS:
        command.add(commands)
    return parser


if __name__ == "__main__":
    sys.exit(main())
