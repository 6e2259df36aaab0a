"""The options of `reftrace trace`."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from ..framing import Choice
from ..methods import Method
from ..scene import SceneError
from .arguments import (
    GivenSettings,
    Place,
    check_frames,
    place_from,
    refuse,
    settings_from,
)
from .camera_options import choice_from

_NUMBER = "####"  # in a file's name: that of its frame, as Blender writes it


@dataclass(frozen=True)
class TraceOptions:
    """The options of `reftrace trace`."""

    scene: Path
    out: tuple[Path, ...]  # pictures
    certificate: Path | None
    settings: GivenSettings
    choice: Choice
    frames: str | None  # as they are typed
    rows: Sequence[int] | None  # the first and the last
    masks: Path | None  # a folder for a mask of each object
    top_down: bool  # the first row of an array is the topmost
    place: Place

    @classmethod
    def parsed(cls, given: Namespace) -> TraceOptions:
        """Return what was parsed; raises SceneError if options contradict one another."""
        if not (given.out or given.certificate):
            raise SceneError("name a file to write: --out PICTURE, --certificate FILE, or both")
        out = tuple(given.out or ())
        if not out:
            refuse(given, ("masks", "top_down"), "is for a picture: --out PICTURE")
        elif all(path.suffix.lower() != ".npz" for path in out):
            refuse(given, ("top_down",), "is for a .npz: pictures begin with their topmost row")
        if given.frames is not None:
            check_frames(given, ())
            for path in filter(None, (*out, given.certificate, given.masks)):
                if _NUMBER not in path.name:
                    raise SceneError(f"--frames: '{path}' needs a number, as in {_NUMBER}.png")
        if given.certificate or given.masks:
            given.method = given.method or Method.CERTIFIED.value
        return cls(
            scene=given.scene,
            out=out,
            certificate=given.certificate,
            settings=settings_from(given),
            choice=choice_from(given, given.scene, given.frames is not None),
            frames=given.frames,
            rows=given.rows,
            masks=given.masks,
            top_down=given.top_down,
            place=place_from(given),
        )

    @property
    def files(self) -> list[Path]:
        """The files that are written."""
        return [*self.out, *filter(None, [self.certificate])]

    def of_frame(self, frame: int) -> TraceOptions:
        """Return the options of one frame: its number stands in its files' names."""

        def numbered(path: Path) -> Path:
            return path.with_name(path.name.replace(_NUMBER, f"{frame:04d}"))

        return replace(
            self,
            out=tuple(map(numbered, self.out)),
            certificate=self.certificate and numbered(self.certificate),
            masks=self.masks and numbered(self.masks),
        )
