"""The options for data in place of a picture: depths, normals, positions, ids."""

from __future__ import annotations

from argparse import Namespace, _ActionsContainer

from ..pictures.data.given import KINDS, GivenData
from ..pictures.data.vectors import RANGES, SPACES
from ..scene import SceneError
from .arguments import refuse
from .parser import POSITIVE, Parser

_FILES = {
    "depth": "depths along the view axis, in metres",
    "distance": "distances along the rays, in metres",
    "normals": "normals of the flat faces",
    "positions": "positions, in metres",
    "ids": "a number, or a colour, for each object",
}
_DETAILS = "layer", "depth_scale", "space", "range", "top_down"
_OF = {"depth_scale": ("depth", "distance", "positions"), "space": ("normals", "positions")}
_OF["range"] = ("normals",)


def add_data(parser: Parser, instead: _ActionsContainer) -> None:
    """Add the options: each kind of file `instead` of others, and what is known of it."""
    for kind, words in _FILES.items():
        instead.add_argument(
            f"--{kind}",
            type=parser.path,
            metavar="FILE",
            help=f"{words}, in place of colours: .exr, .npy, .npz or .png",
        )
    group = parser.add_argument_group("what such a file holds (default: as is told from it)")
    group.add_argument(
        "--layer", metavar="NAME", help="the array of a .npz, or the layer of an .exr"
    )
    group.add_argument(
        "--depth-scale",
        type=POSITIVE,
        metavar="METRES",
        help="how many metres 1 is, such as 0.001 (default 1; a .png of integers needs it)",
    )
    group.add_argument("--space", choices=SPACES, help="of normals and positions")
    group.add_argument(
        "--range", choices=RANGES, help="of normals: signed, -1 to 1, or unit, 0 to 1 as colours"
    )
    group.add_argument(
        "--top-down",
        action="store_true",
        help="the first row of a .npy or .npz is the topmost (default the lowest)",
    )


def data_from(given: Namespace) -> GivenData | None:
    """Return the file of data that is given, if any; raises SceneError for what has no effect."""
    kind = next((kind for kind in KINDS if getattr(given, kind) is not None), None)
    if kind is None:
        refuse(given, _DETAILS, f"is for data: --{', --'.join(_FILES)}")
        return None
    refuse(given, ("dither", "colors", "colors_out"), f"is for colours, and --{kind} has none")
    for option, kinds in _OF.items():
        if kind not in kinds:
            refuse(given, (option,), f"is for --{' and --'.join(kinds)}")
    if given.self_check:
        raise SceneError(f"--self-check is for a picture of colours, not for --{kind}")
    return GivenData(
        kind,
        getattr(given, kind),
        given.layer or "",
        given.depth_scale,
        given.space or "",
        given.range or "",
        given.top_down,
    )
