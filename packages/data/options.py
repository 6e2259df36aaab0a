"""`--holds`: data in place of colours: depths, normals, positions, ids."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from pathlib import Path
from typing import Any

from reference_tracer.cli.arguments import refuse
from reference_tracer.cli.named import Named, Setting, add_named, one_of
from reference_tracer.cli.parser import POSITIVE, Parser
from reference_tracer.scene import SceneError

from .given import KINDS, GivenData
from .vectors import RANGES, SPACES

_ROWS = (
    Setting(
        "kind",
        "KIND",
        one_of(*KINDS),
        "depth, along the view axis; distance, along the ray; normals, of faces; "
        "positions; ids, of objects: in .exr, .npy, .npz or .png",
        alone=True,
    ),
    Setting("layer", "NAME", str, "the array of a .npz, or the layer of an .exr"),
    Setting("scale", "METRES", POSITIVE, "what 1 is, such as 0.001 (default 1; integers need it)"),
    Setting("space", "|".join(SPACES), one_of(*SPACES), "of normals and positions"),
    Setting("range", "|".join(RANGES), one_of(*RANGES), "of normals: -1 to 1, or 0 to 1"),
    Setting("names", "FILE", Path, 'of ids: whose is whose, as {"Cube": 1}, or a colors.json'),
    Setting("first-row", "bottom|top", one_of("bottom", "top"), "of a .npy or .npz"),
)
_OF = {
    "scale": ("depth", "distance", "positions"),
    "space": ("normals", "positions"),
    "range": ("normals",),
    "names": ("ids",),
}


class _Held(Named):
    """Reads a kind, and then NAME=VALUE."""

    def __call__(
        self, parser: ArgumentParser, given: Namespace, words: Any, option: str | None = None
    ) -> None:
        """Take the first word for the kind."""
        kind, *details = words
        super().__call__(parser, given, [f"kind={kind}", *details], option)


def add(parser: Parser) -> None:
    """Add the option, and what it means."""
    group = parser.add_argument_group("data in place of colours, in the file of --against")
    add_named(group, "--holds", _ROWS, _Held, "KIND NAME=VALUE")
    parser.set_defaults(held=data_from)


def data_from(given: Namespace) -> GivenData | None:
    """Return the file of data that is given, if any; raises SceneError for what has no effect."""
    kind = given.kind
    if kind is None:
        return None
    if given.against is None:
        raise SceneError("--holds is for a file of --against: name it")
    refuse(given, ("dither", "colors", "colors_out"), f"is for colours, and {kind} has none")
    for option, kinds in _OF.items():
        if kind not in kinds:
            refuse(given, (option,), f"is for {', '.join(kinds)}")
    if given.against.suffix.lower() in (".exr", ".png"):
        refuse(given, ("first_row",), "is for .npy, .npz: a picture's file has the topmost first")
    if given.self_check:
        raise SceneError(f"--self-check is for a picture of colours, not for {kind}")
    return GivenData(
        kind,
        given.against,
        given.layer or "",
        given.scale,
        given.space or "",
        given.range or "",
        given.first_row == "top",
        given.names,
    )
