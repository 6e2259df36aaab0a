"""Writes and reads cameras in any convention: `CONVENTIONS` has them by name."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from importlib.metadata import entry_points
from pathlib import Path

import numpy as np

from ..files.file_kinds import check_is_file
from ..scene import SceneError
from ..wording import count_of, listed
from .colmap import COLMAP
from .convention import HALF, Convention, Files, Source, View
from .gltf import GLTF
from .nerf import NERF
from .opencv import OPENCV
from .opengl import OPENGL

_WHOLE = re.compile(r"-?\d{1,18}")  # what more digits say is a name

_OPENCV = ": OpenCV's is JSON with K, R and t; `cv2.Rodrigues(rvec)[0]` is R, and tvec is t"


def _all() -> Iterator[Convention]:
    """Yield the conventions of the add-on, then those of packages beside it."""
    yield from (OPENCV, OPENGL, COLMAP, NERF, GLTF)
    for found in entry_points(group="reference_tracer.cameras"):
        yield from found.load()


# The first that a file is of reads it.
CONVENTIONS = {own.name: own for own in _all()}

WRITTEN = {name: own for name, own in CONVENTIONS.items() if own.write}


def texts(views: Sequence[View], convention: Convention, centers: str = HALF) -> Files:
    """Return what the files of these views hold, by name.

    Raises
    ------
    SceneError
        If the convention cannot say what one of the cameras has, or where a pixel's centre is.
    """
    if centers != HALF and not convention.either_center:
        raise SceneError(
            f"--centers {centers}: {convention.title} has pixel centres at + 0.5, or none"
        )
    if convention.write is None:
        raise SceneError(f"files of {convention.title} are read, not written: {', '.join(WRITTEN)}")
    for view in views:
        if lacking := convention.lacks(view.camera):
            able = [own.name for own in WRITTEN.values() if not own.lacks(view.camera)]
            do = f"{', '.join(able)} can" if able else "none of the conventions can"
            raise SceneError(
                f"Camera '{view.camera.name}' has {' and '.join(lacking)}, which "
                f"{convention.title} cannot say: {do}."
            )
    return convention.write(views, centers)


def read(
    path: Path, convention: str | None = None, size: tuple[int | None, int | None] = (None, None)
) -> list[View]:
    """Return the views of a file or a folder, of a convention or of the one that it is seen to be.

    Parameters
    ----------
    path : Path
    convention : str, optional
        A name in `CONVENTIONS`.
    size : (int or None, int or None)
        Width and height of the picture, for files that say none.

    Raises
    ------
    SceneError
        If there is no such file, it is of no convention, or its camera is none that is modelled.
    OSError
        If it cannot be read.
    """
    source = Source(path, size)
    if not path.is_dir():
        check_is_file(path)
    try:
        with np.errstate(all="ignore"):  # a camera refuses what is not finite
            views = _seen_to_be(source, convention).read(source)
        if not views:
            raise SceneError("it has no camera")
    except (ValueError, ArithmeticError, RecursionError) as error:  # no camera has such numbers
        raise SceneError(f"'{path}' cannot be read as a camera: {error}") from error
    return views


def _seen_to_be(source: Source, named: str | None) -> Convention:
    """Return the convention of a source; the one that is named, if it is of that."""
    for name, own in CONVENTIONS.items():
        if named in (None, name) and own.is_of(source):
            return own
    why = f"it is of none of {', '.join(CONVENTIONS)}"
    if named:
        why = f"its content is not that of {CONVENTIONS[named].title}"
    raise SceneError(why + (_OPENCV if named in (None, OPENCV.name) else ""))


def is_seen_to_be(path: Path) -> bool:
    """Return whether a file or a folder looks like one of the conventions."""
    return any(own.is_of(Source(path)) for own in CONVENTIONS.values())


def chosen(views: Sequence[View], which: str | None) -> View:
    """Return the view that a name or a number names; without one, the only one.

    A number is a frame's of Blender, else that at the end of an image's name, else the place among
    the views, from 0.

    Raises
    ------
    SceneError
        If there is no such view, or there are several and none is named.
    """
    if which is None:
        if len(views) == 1:
            return views[0]
        many = f"it has {len(views)} cameras"
        raise SceneError(f"{many}: --set camera-view=NAME chooses one of {_names(views)}")
    named = [view for view in views if which in (view.name, Path(view.name).stem)]
    if not named and _WHOLE.fullmatch(which):
        number = int(which)
        named = [view for view in views if number_of(view) == number]
        if not named and all(number_of(view) is None for view in views):
            named = list(views[number : number + 1]) if number >= 0 else []
    if len(named) != 1:
        count = count_of(len(named), "camera") if named else "no camera"
        raise SceneError(f"it has {count} '{which}'; there are {_names(views)}")
    return named[0]


def of_frames(views: Sequence[View], frames: Sequence[int]) -> dict[int, View]:
    """Return the view of each frame: by its number, or in order where no view has one.

    Raises
    ------
    SceneError
        If a frame has no view, or more than one.
    """
    numbers = [number_of(view) for view in views]
    if not any(number is not None for number in numbers):
        if len(views) != len(frames):
            has, wanted = count_of(len(views), "camera"), count_of(len(frames), "frame")
            raise SceneError(
                f"the file of --camera has {has} without numbers for {wanted}: {_names(views)}"
            )
        return dict(zip(frames, views, strict=True))
    of: dict[int | None, list[View]] = {}
    for number, view in zip(numbers, views, strict=True):
        of.setdefault(number, []).append(view)
    found = {}
    for frame in frames:
        own = of.get(frame, [])
        if len(own) != 1:
            has = count_of(len(own), "camera") if own else "no camera"
            raise SceneError(
                f"the file of --camera has {has} for frame {frame}; there are {_names(views)}"
            )
        found[frame] = own[0]
    return found


def number_of(view: View) -> int | None:
    """Return the frame of a view, or the number at the end of its image's name."""
    if view.frame is not None:
        return view.frame
    stem = Path(view.name).stem
    found = _WHOLE.fullmatch(stem) or re.search(r"(?<!\d)\d{1,18}$", stem)
    return int(found[0]) if found else None


def _names(views: Sequence[View]) -> str:
    return listed([view.name or str(number) for number, view in enumerate(views)], 5)
