"""What parses a command line, `reftrace`'s or `blender --command`'s, and its exit codes.

Little is imported here: `reftrace --help` takes no longer than Python itself.
"""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import NoReturn

AGREE, WARNINGS, DIFFERENCES, SIZES_DIFFER, INPUT_ERROR = range(5)
INTERRUPTED = 130  # by Ctrl-C, as shells have it: see `running.py`

_CODES = """
  4  the input is wrong, or cannot be read; or standard output cannot be written: files stay
  130  interrupted by Ctrl-C (129, 143: by SIGHUP, SIGTERM)"""
DONE_HELP = f"exit codes:\n  0  done{_CODES}"
EXIT_CODES_HELP = f"""exit codes:
  0  the pictures agree
  1  warnings: something is not modelled, or not decidable; or so much that it is not comparable
  2  differences that no cause explains
  3  the sizes of the pictures do not match{_CODES}"""


class Parser(argparse.ArgumentParser):
    """An argument parser that ends with INPUT_ERROR, as 2 means differences here."""

    opened: Path | None = None  # the scene of the command, where it is open in Blender

    def __init__(self, *args: object, **options: object) -> None:
        """Name the exit codes below the help, and keep their lines."""
        super().__init__(*args, formatter_class=argparse.RawDescriptionHelpFormatter, **options)

    def error(self, message: str) -> NoReturn:
        """Print the message and how to go on, and exit."""
        self.exit(INPUT_ERROR, f"{self.prog}: {message}\n{self.prog} --help lists the options.\n")
