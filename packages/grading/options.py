"""The options of `reftrace judge`, checked."""

from __future__ import annotations

from argparse import Namespace
from pathlib import Path

from reference_tracer.cli.arguments import refuse
from reference_tracer.cli.camera_options import CAMERA_OPTIONS
from reference_tracer.scene import SceneError
from reference_tracer_processes.sandbox import check_shown

from .exchange import CSV
from .external import Code, Run

MEMORY = 2.0  # GiB, by default
PIXELS = 20_000  # of a scene, by default: a function that loops over the rays takes some seconds


def checked(given: Namespace) -> tuple[list[Code], list[Path]]:
    """Return the students and the scenes that are named, each once.

    Raises
    ------
    SceneError
        If no student's file is named, one is not there, or an option has no effect.
    """
    files = dict.fromkeys(given.files)
    scenes = [file for file in files if file.suffix != ".py"]
    own = [file for file in files if file.suffix == ".py"]
    for path in own:
        if not path.is_file():
            raise SceneError(f"there is no file '{path}'")
    if not given.out:
        refuse(given, ("format",), "is for a folder: add --out DIR")
    if not given.programs:
        refuse(given, ("exchange",), "is for --run")
    students = [*own, *_runs(given)]
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
    return students, scenes


def camera_options(given: Namespace) -> tuple[str, ...]:
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
            runs.append(Run(command, given.exchange or CSV))
            check_shown(runs[-1].words)
        except ValueError as error:
            raise SceneError(f"--run {command!r}: {error}") from error
    return runs
