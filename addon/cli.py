"""The command `reftrace`: the tracer, the comparison and the studies outside Blender's window."""

from __future__ import annotations

import sys

from . import interrupts, running


def main(argv: list[str] | None = None) -> int:
    """Run `reftrace`; returns the exit code."""
    return running.run(lambda: _run(argv), "reftrace")


def _run(argv: list[str] | None) -> int:
    with interrupts.held():  # an import that is interrupted leaves half a module
        from .commands.parser import parser

        known = parser()
    options = known.parse_args(argv)
    return options.run(options)


if __name__ == "__main__":
    sys.exit(main())
