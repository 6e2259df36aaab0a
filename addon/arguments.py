"""The options that the command lines share: `reftrace`, and `blender --command`."""

from __future__ import annotations

import argparse
from typing import NoReturn

from .scene import SceneError
from .tracer.settings import Method, Precision, Settings

AGREE, WARNINGS, DIFFERENCES, SIZES_DIFFER, INPUT_ERROR = range(5)

EXIT_CODES = """exit codes:
  0  the pictures agree
  1  warnings: something is not modelled, or not decidable
  2  differences that no cause explains
  3  the sizes of the pictures do not match
  4  the input is wrong, or cannot be read"""


class Parser(argparse.ArgumentParser):
    """An argument parser that ends with INPUT_ERROR, as 2 means differences here."""

    def __init__(self, *args: object, **options: object) -> None:
        """Name the exit codes below the help, and keep their lines."""
        options.setdefault("formatter_class", argparse.RawDescriptionHelpFormatter)
        super().__init__(*args, **options)

    def error(self, message: str) -> NoReturn:
        """Print the message and how to go on, and exit."""
        self.exit(INPUT_ERROR, f"{self.prog}: {message}\n{self.prog} --help lists the options.\n")


def add_settings(parser: argparse.ArgumentParser) -> None:
    """Add what the user can trade; without an option, what the scene stores holds."""
    group = parser.add_argument_group("how to trace (by default what the scene says)")
    group.add_argument(
        "--method", choices=[m.value for m in Method], help="how a ray meets a triangle"
    )
    group.add_argument(
        "--precision",
        choices=[p.value for p in Precision],
        help="floating-point type of rays and vertices",
    )
    group.add_argument(
        "--samples", type=int, metavar="N", help="colour is the mean of N x N rays a pixel"
    )


def add_judge(parser: argparse.ArgumentParser) -> None:
    """Add which of Blender's pictures to compare with, and how it is shaded."""
    group = parser.add_argument_group("Blender's picture (by default as the scene says)")
    group.add_argument(
        "--judge",
        choices=["auto", "workbench", "cycles"],
        help="which of Blender's pictures to compare with",
    )
    group.add_argument(
        "--as-is",
        action="store_true",
        help="leave Blender's shading as the scene has it, not like for like",
    )


def settings_from(options: argparse.Namespace, stored: Settings) -> Settings:
    """Return the stored settings with what the options say in their place.

    Raises
    ------
    SceneError
        If a value is out of range.
    """
    chosen = {
        name: value
        for name in ("method", "precision", "samples")
        if (value := getattr(options, name)) is not None
    }
    try:
        return Settings(**vars(stored) | chosen)
    except ValueError as error:
        raise SceneError(str(error)) from error
