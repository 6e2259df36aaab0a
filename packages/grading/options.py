"""The options of `reftrace judge`, checked."""

from __future__ import annotations

import os
from argparse import Namespace
from dataclasses import dataclass
from pathlib import Path

from reference_tracer.cli.arguments import refuse
from reference_tracer.cli.camera_options import CAMERA_OPTIONS, choice_from
from reference_tracer.framing import Choice
from reference_tracer.scene import SceneError
from reference_tracer_processes.options import limits_of
from reference_tracer_processes.running import Limits
from reference_tracer_processes.sandbox import check_shown

from .exchange import CSV
from .external import Code, Run

MEMORY = 2.0  # GiB, by default
PIXELS = 20_000  # of a scene, by default: a function that loops over the rays takes some seconds


@dataclass(frozen=True)
class JudgeOptions:
    """The options of `reftrace judge`."""

    students: tuple[Code, ...]
    subject: str  # one of `subjects.NAMES`
    scenes: tuple[tuple[Path, Choice], ...]  # none for the exercise's own
    camera_options: tuple[str, ...]  # those that were given, as they are typed
    out: Path | None
    pixels: int
    limits: Limits
    jobs: int  # how many students are run at a time
    again: bool  # also those who were judged before
    formats: tuple[str, ...]  # what is written besides the pages and the JSON

    @classmethod
    def parsed(cls, given: Namespace) -> JudgeOptions:
        """Return what was parsed.

        Raises
        ------
        SceneError
            If no student's file is named, one is not there, or an option has no effect.
        """
        files = dict.fromkeys(given.files)  # each once
        scenes = tuple(file for file in files if file.suffix != ".py")
        own = [file for file in files if file.suffix == ".py"]
        for path in own:
            if not path.is_file():
                raise SceneError(f"there is no file '{path}'")
        if not given.out:
            refuse(given, ("format",), "is for a folder: add --out DIR")
        if not given.programs:
            refuse(given, ("exchange",), "is for --run")
        students = (*own, *_runs(given))
        if not students:
            raise SceneError(
                "name a student's file (.py), --run for a program in another language, or "
                "--template FILE to make a file"
            )
        if given.subject != "triangle":
            refuse(given, ("pixels",), "is for --subject triangle")
            if scenes:
                raise SceneError(f"'{scenes[0]}': scenes are for --subject triangle")
        if not scenes:
            refuse(given, CAMERA_OPTIONS, "is for scenes of your own: name one")
        return cls(
            students=students,
            subject=given.subject,
            scenes=tuple((path, choice_from(given, path)) for path in scenes),
            camera_options=_camera_options(given),
            out=given.out,
            pixels=given.pixels or PIXELS,
            limits=limits_of(given, MEMORY),
            jobs=given.jobs or os.cpu_count() or 1,
            again=given.again,
            formats=tuple(dict.fromkeys(given.format or ())),
        )


def _camera_options(given: Namespace) -> tuple[str, ...]:
    """Return the camera's options that were given, as they are typed."""
    named = ("--camera", given.camera) if given.camera else ()
    return (*named, "--set", *given.set) if given.set else named


def _runs(given: Namespace) -> list[Run]:
    """Return the programs that are to be run.

    Raises
    ------
    SceneError
        If a command is none.
    """
    runs = []
    for command in dict.fromkeys(given.programs or ()):
        try:
            runs.append(Run.parsed(command, given.exchange or CSV))
            check_shown(runs[-1].words)
        except ValueError as error:
            raise SceneError(f"--run {command!r}: {error}") from error
    return runs
