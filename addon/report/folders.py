"""Writes files that are complete or absent: an interruption leaves no half or mixed result.

Results are written in a temporary folder, and moved to their names at the end.
"""

from __future__ import annotations

import errno
import json
import math
import os
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path

_PREFIX = ".reftrace-"  # of the folder beside the results in which they are written


def make(directory: Path) -> list[Path]:
    """Make the folder for results before the work begins, and test that it can be written.

    Returns the folders that were not there, the innermost first.

    Raises
    ------
    OSError
        If it cannot be made or written, naming it and why.
    """
    new = [p for p in (directory, *directory.parents) if not p.exists()]
    try:
        directory.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=directory, prefix=_PREFIX):
            pass
    except OSError as error:
        _remove(new)
        known = {
            FileExistsError: "it is a file",
            NotADirectoryError: "a part of this path is a file",
        }
        why = known.get(type(error), error.strerror)
        raise OSError(f"cannot write to the folder '{directory}': {why}") from error
    return new


@contextmanager
def made(directory: Path) -> Iterator[None]:
    """Make a folder for some work; if the work fails, remove the folders that this has made."""
    new = make(directory)
    try:
        yield
    except BaseException:  # Ctrl-C, too
        _remove(new)
        raise


def _remove(directories: Sequence[Path]) -> None:
    with suppress(OSError):  # there is something in it by now
        for directory in directories:
            directory.rmdir()


@contextmanager
def replacing(directory: Path, names: Sequence[str]) -> Iterator[Path]:
    """Give a temporary folder for results of these names, which then replace those in `directory`.

    The file of the last name is removed first and moved last: if it exists, all others are from the
    same run.

    Raises
    ------
    OSError
        If the folder cannot be written.
    """
    make(directory)
    folder = tempfile.TemporaryDirectory(dir=directory, prefix=_PREFIX)
    with _named(f"the folder '{directory}'"), folder as new:
        yield Path(new)
        with _free():
            for name in reversed(names):
                (directory / name).unlink(missing_ok=True)
            for name in names:
                if Path(new, name).exists():
                    os.replace(Path(new, name), directory / name)


@contextmanager
def _named(what: str) -> Iterator[None]:
    """Say what cannot be written where the system says only that its disk is full."""
    try:
        yield
    except OSError as error:
        if error.errno not in (errno.ENOSPC, errno.EDQUOT, errno.EFBIG):
            raise
        why = f"{error.strerror}: free some, or write elsewhere"
        raise OSError(f"cannot write to {what}: {why}") from error


@contextmanager
def _free() -> Iterator[None]:
    """Say which file cannot be replaced where the system says only that it may not.

    The folder can be written, as was tested. On Windows a file that a program has open is locked.
    """
    try:
        yield
    except PermissionError as error:
        file = error.filename2 or error.filename
        do = "another program may have it open: close it there, or write elsewhere"
        raise OSError(f"cannot replace '{file}': {do} ({error.strerror})") from error


def place_of(path: Path) -> str:
    """Return what paths share that are one file wherever the case of a name does not count."""
    return str(path.resolve()).casefold()


@contextmanager
def replacing_file(path: Path) -> Iterator[Path]:
    """Give a temporary path; its file replaces the file `path` at the end."""
    folder = tempfile.TemporaryDirectory(dir=path.parent, prefix=_PREFIX)
    with _named(f"'{path}'"), folder as new:
        yield Path(new) / path.name
        with _free():
            os.replace(Path(new) / path.name, path)


@contextmanager
def made_for_file(path: Path) -> Iterator[None]:
    """Make the folder of a file as :func:`made` does, and test that the file is not a folder.

    Raises
    ------
    OSError
        If the file cannot be written.
    """
    if path.is_dir():
        raise OSError(f"cannot write '{path}': it is a folder")
    with made(path.parent):
        yield


def write_text(path: Path, text: str) -> None:
    """Write a complete file, and make its folder.

    A name in a scene may be invalid Unicode: it is written with backslashes, as in JSON.

    Raises
    ------
    OSError
        If it cannot be written.
    """
    with made_for_file(path), replacing_file(path) as new:
        new.write_text(text, encoding="utf-8", errors="backslashreplace")


def write_all(directory: Path, contents: Mapping[str, str | Mapping[str, object]]) -> None:
    """Write texts and strict JSON by their files' names, all or none: see :func:`replacing`.

    Raises
    ------
    OSError
        If the folder cannot be written.
    """
    with replacing(directory, [*contents]) as new:
        for name, content in contents.items():
            if isinstance(content, str):
                (new / name).write_text(content, encoding="utf-8", errors="backslashreplace")
            else:
                write_json(new / name, content)


def write_json(path: Path, content: Mapping[str, object]) -> None:
    """Write strict JSON, which every reader accepts.

    Raises
    ------
    ValueError
        If a number is not finite: see :func:`finite`.
    """
    text = json.dumps(content, indent=2, allow_nan=False)
    path.write_text(text + "\n", encoding="utf-8")


def finite(value: float | None) -> float | None:
    """Return a number for JSON, which has no infinity and no NaN: None in their place."""
    return value if value is not None and math.isfinite(value) else None
