"""The options that choose what is looked at in a file, and through which camera."""

from __future__ import annotations

import sys
from argparse import Namespace, _ActionsContainer
from dataclasses import fields
from pathlib import Path

from ..camera_files.convention import View
from ..camera_files.files import CONVENTIONS, is_seen_to_be, read
from ..camera_files.files import chosen as chosen_view
from ..files.file_kinds import check_is_file
from ..framing import ANGLE, SIZE, Choice
from ..opened import mesh_formats
from ..scene import SceneError
from ..wording import show
from .arguments import is_blend, refuse
from .parser import COUNT, FINITE, POSITIVE, Parser, number

_OF_BLEND = "scene_name", "view_layer", "frame"
_OF_FILE = "camera_convention", "camera_view"
_OF_MESH = "width", "height", "frame_all", "eye", "target", "angle", "ortho_scale", "up"
CAMERA_OPTIONS = *_OF_MESH, *_OF_BLEND, "camera", *_OF_FILE
# Of files that `--camera` takes for a camera's, whatever cameras a .blend has.
_ENDINGS = ".json", ".txt", ".xml", ".glb", ".gltf"

_DEGREES = number(float, lambda value: 0 < value < 180, "between 0 and 180 degrees")
LAST_FRAME = 1048574  # of Blender's; the first one is as far below 0
_FRAME = number(
    int,
    lambda value: abs(value) <= LAST_FRAME,
    f"from {-LAST_FRAME} to {LAST_FRAME}, as Blender's frames are",
)


def add_camera(parser: Parser, with_size: bool = True, of_meshes: bool = True) -> None:
    """Add the options for the camera and the size of its picture."""
    framed = ", or one that frames the mesh" if of_meshes else ""
    group = parser.add_argument_group(
        f"the camera and its picture (default: a scene's own{framed})"
    )
    if with_size:
        for name, other, size in zip(("width", "height"), ("height", "width"), SIZE, strict=True):
            group.add_argument(
                f"--{name}",
                type=COUNT,
                metavar="PIXELS",
                help=f"{name} of the picture (default a scene's own, or what --{other} implies"
                + (f"; {size} for a mesh)" if of_meshes else ")"),
            )
    if of_meshes:
        group.add_argument(
            "--up",
            choices=["y", "z"],
            help="which axis of a mesh is up (default y of glTF and of Blender's own .obj, z of "
            "others); it is turned to Z",
        )
    _add_which(group.add_mutually_exclusive_group(), parser)
    group.add_argument(
        "--camera-convention",
        choices=CONVENTIONS,
        help="how the file of --camera is read (default as its content says)",
    )
    group.add_argument(
        "--camera-view",
        metavar="NAME",
        help="which camera of the file of --camera: the name or the number of its image",
    )
    group.add_argument(
        "--target",
        type=FINITE,
        nargs=3,
        metavar=("X", "Y", "Z"),
        help="with --eye: the point it looks at (default the origin); Z is up",
    )
    lens = group.add_mutually_exclusive_group()
    lens.add_argument(
        "--angle",
        type=_DEGREES,
        metavar="DEGREES",
        help=f"vertical angle of view of a new camera (default {ANGLE:g})",
    )
    lens.add_argument(
        "--ortho-scale",
        type=POSITIVE,
        metavar="METRES",
        help="with --eye: make the camera orthographic, with a picture of this height",
    )
    add_parts_of_blend(parser)


def _add_which(group: _ActionsContainer, parser: Parser) -> None:
    """Add the three ways to choose a camera."""

    def name_or_path(text: str) -> str:
        return str(parser.path(text)) if text.startswith("//") else text  # as Blender writes it

    group.add_argument(
        "--camera",
        type=name_or_path,
        metavar="NAME",
        help="use this camera of a .blend or a .glb; or a file's, as another program wrote it: "
        "K, R and t in JSON, transforms.json, a folder of COLMAP's, and so on; of a comparison's "
        "--frames each has the one of its number",
    )
    group.add_argument(
        "--frame-all",
        action="store_true",
        help="use a new camera, from the front, the right and above, that frames all that is shown",
    )
    group.add_argument(
        "--eye",
        type=FINITE,
        nargs=3,
        metavar=("X", "Y", "Z"),
        help="use a new camera at this position",
    )


def add_parts_of_blend(parser: Parser) -> None:
    """Add the options for what is taken of a .blend, but for its camera."""
    group = parser.add_argument_group("what to take of a .blend (default: as it was saved)")
    group.add_argument("--scene", metavar="NAME", dest="scene_name", help="the scene")
    group.add_argument("--view-layer", metavar="NAME", help="the view layer")
    group.add_argument(
        "--frame",
        type=_FRAME,
        metavar="N",
        help="the frame; simulations are stepped to it from the first one",
    )


# What Blender imports and `reftrace` does not read.
_OF_OTHERS = frozenset(".3ds .abc .bvh .collada .dae .dxf .fbx .svg .vrml .wrl .x3d".split())


def check_kind(path: Path) -> None:
    """Raise a SceneError if there is no such file, or it is of a kind that is not read.

    A .blend is not looked at: it may be open in the Blender that runs this.
    """
    suffix = path.suffix.lower()
    if suffix == ".blend":
        return
    check_is_file(path)
    if suffix == ".npz" or suffix in mesh_formats():
        return
    do = ""
    if not suffix:
        do = ": its name has no such end; rename it"
    elif suffix in _OF_OTHERS:
        do = ": import it into Blender, and save a .blend"
    elif suffix.startswith(".blend"):
        do = ": a backup of Blender's is a .blend once it is renamed"
    raise SceneError(f"'{path}' is none of .blend, .npz, {', '.join(mesh_formats())}{do}")


def choice_from(given: Namespace, path: Path, of_frames: bool = False) -> Choice:
    """Return what the options choose of a file; of frames, each may have a camera of its own.

    Raises
    ------
    SceneError
        If the file is of no kind that is read, or an option has no effect for it, or beside the
        others.
    """
    check_kind(path)
    is_mesh = path.suffix.lower() in mesh_formats()
    _refuse_without_camera(given, is_mesh)
    if is_mesh:
        refuse(given, _OF_BLEND, f"is for a .blend: '{path}' has no such thing")
    else:
        refuse(given, ("up",), "is for meshes: in a scene Z is up")
        if not is_blend(path):
            why = f"is for a .blend or a mesh: '{path}' has its own camera and its own picture"
            refuse(given, CAMERA_OPTIONS, why)
    known = [field.name for field in fields(Choice) if field.name in given]
    chosen = {name: getattr(given, name) for name in known}
    if views := _views(given, path if is_mesh else None, of_frames):
        for note in dict.fromkeys(note for view in views for note in view.notes):
            show(f"{given.camera}: {note}", file=sys.stderr)
        chosen["camera"] = None
        if len(views) > 1:
            chosen["views"] = views
        else:
            chosen["seen_by"] = views[0]
    return Choice(**chosen)


def _views(given: Namespace, mesh: Path | None, of_frames: bool) -> list[View]:
    """Return the camera of a file that is named, or those of its frames.

    There is none if no file is named, but a camera of a .blend.
    """
    if given.camera is None:
        refuse(given, _OF_FILE, "is for a file of --camera")
        return []
    file, which = Path(given.camera), given.camera_view
    size = given.width, getattr(given, "height", None)
    is_file = file.suffix.lower() in _ENDINGS or (file.is_dir() and is_seen_to_be(file))
    if not (is_file or given.camera_convention or which):
        if mesh is None:
            return []
        file, which = mesh, given.camera
        if mesh.suffix.lower() not in (".glb", ".gltf"):
            raise SceneError(f"--camera {which} is no file, and '{mesh}' has no cameras")
        if given.up == "z":
            raise SceneError("--up z is for the meshes alone: a camera of glTF has Y up")
    views = read(file, given.camera_convention, size)
    if which is not None or not of_frames:
        views = [chosen_view(views, which)]
    for view in views:
        own = view.camera.width, view.camera.height
        if any(asked not in (None, has) for asked, has in zip(size, own, strict=True)):
            raise SceneError(
                f"--width and --height are for files that say no size: '{file}' has "
                f"{own[0]} x {own[1]}, and so has the picture: leave them out"
            )
    return views


def _refuse_without_camera(given: Namespace, is_mesh: bool) -> None:
    """Refuse options about a new camera where none is made."""
    if given.eye is None:
        refuse(given, ("target", "ortho_scale"), "is for a camera that --eye places")
        if not is_mesh and not given.frame_all:
            refuse(given, ("angle",), "is for a camera that --eye or --frame-all places")
