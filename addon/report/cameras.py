"""Writes a scene's cameras as a file of another convention, which is read again and certified."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

import numpy as np

from ..arrays import Floats
from ..camera_files.convention import HALF, Convention, View
from ..camera_files.files import read, texts
from ..pictures.certificate import CameraCertificate, certify, known_points
from ..scene import Camera
from ..tracer.camera import film_of
from ..wording import count_of
from . import folders


class SceneCamera(NamedTuple):
    """A camera of a scene, and points with the places where its own program has them."""

    view: View
    points: Floats  # (3, n) world space
    film: Floats  # (2, n) pixels of the picture
    judge: str  # who says so

    @classmethod
    def of(cls, camera: Camera, name: str) -> SceneCamera:
        """Return a camera that the tracer alone knows."""
        points = known_points(camera)
        film = np.stack(film_of(camera, points)[:2])
        return cls(View(camera, name), points, film, "the tracer's camera")


def write_cameras(
    path: Path, cameras: Sequence[SceneCamera], convention: Convention, centers: str = HALF
) -> str:
    """Write a file, or a folder where a convention has several files; return what is certified.

    What is certified is what its reader makes of the file. Where the format is ours, the
    certificate stands in it.

    Raises
    ------
    SceneError
        If the convention cannot say what a camera has, or the file would have another camera.
    OSError
        If it cannot be written.
    """
    views = [own.view for own in cameras]
    names = list(texts(views, convention, centers))
    if names == [""]:
        with folders.made_for_file(path), folders.replacing_file(path) as new:
            return _write_certified(new, cameras, convention, centers)
    with folders.replacing(path, names) as new:
        return _write_certified(new, cameras, convention, centers)


def _write_certified(
    path: Path, cameras: Sequence[SceneCamera], convention: Convention, centers: str
) -> str:
    views = [own.view for own in cameras]
    _write(path, views, convention, centers)
    size = views[0].camera.width, views[0].camera.height
    written = [view.camera for view in read(path, convention.name, size)]
    found = [
        certify(camera, own.points, own.film) for camera, own in zip(written, cameras, strict=True)
    ]
    for certificate in found:
        certificate.check()
    said = [
        replace(view, extras={"certificate": certificate.to_dict() | {"judge": own.judge}})
        for view, certificate, own in zip(views, found, cameras, strict=True)
    ]
    _write(path, said, convention, centers)
    return _line(found, cameras[0].judge)


def _write(path: Path, views: Sequence[View], convention: Convention, centers: str) -> None:
    for name, text in texts(views, convention, centers).items():
        file = path / name if name else path
        file.write_text(text, encoding="utf-8", newline="\n")


def _line(found: Sequence[CameraCertificate], judge: str) -> str:
    worst = max(found, key=lambda certificate: certificate.largest)
    return (
        f"{count_of(len(found), 'camera')}: {worst.points:,} known points lie at most "
        f"{worst.largest:.2g} px from where {judge} has them (allowed: {worst.allowed:.2g} px)"
    )
