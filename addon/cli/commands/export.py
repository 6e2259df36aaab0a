"""`reftrace export`: writes a .blend as a scene that needs no Blender."""

from __future__ import annotations

from argparse import Namespace
from pathlib import Path

from ...files.scenes import save_scene
from ...framing import Choice
from ...report import folders
from ...scene import SceneError
from ...wording import count_of, show
from ..arguments import is_blend
from ..camera_options import add_camera, choice_from
from ..opening import open_file
from ..parser import AGREE, Parser


def add(parser: Parser) -> None:
    """Add the command's options."""

    def run(given: Namespace) -> int:
        if not is_blend(given.scene):
            raise SceneError(f"'{given.scene}' is not a .blend: only those are exported")
        return export(given.scene, given.out, choice_from(given, given.scene))

    parser.runs(run, "reftrace export scene.blend --out scene.npz")
    parser.add_scene("scene.blend")
    parser.add_argument(
        "--out",
        required=True,
        type=parser.path_ending(".npz"),
        metavar="SCENE.npz",
        help="the file to write",
    )
    add_camera(parser)


def export(scene: Path, out: Path, choice: Choice) -> int:
    """Export, and write the scene."""
    with folders.made_for_file(out):
        opened = open_file(scene, choice)
        show(*opened.manifest.lines())
        with folders.replacing_file(out) as new:
            save_scene(new, opened.scene, opened.manifest)
    show(f"{count_of(opened.scene.triangle_count, 'triangle')}: {out}")
    return AGREE
