"""`reftrace verify`: checks a certificate, by `verify.py`, which can be run alone, too."""

from __future__ import annotations

from argparse import Namespace
from pathlib import Path
from zipfile import ZipFile

from reference_tracer.cli.parser import AGREE, COUNT, DIFFERENCES, INPUT_ERROR, Parser
from reference_tracer.cli.running import meanwhile
from reference_tracer.scene import SceneError
from reference_tracer.wording import show

_CODES = f"""exit codes:
  {AGREE}  every pixel that was checked sees what the file says
  {DIFFERENCES}  one does not; the file has what the checker does not know; or it is damaged
  {INPUT_ERROR}  there is no such file, or it is no certificate
  130  interrupted by Ctrl-C"""


def add(parser: Parser) -> None:
    """Add the command's options."""
    parser.runs(
        verify,
        "reftrace trace scene.blend --certificate scene.npz\n  reftrace verify scene.npz",
        _CODES,
    )
    parser.add_argument("file", type=Path, metavar="FILE", help="of `reftrace trace --certificate`")
    parser.add_argument(
        "--sample",
        type=COUNT,
        metavar="ROWS",
        help="check only so many rows, drawn at random; the answer says that it is a sample",
    )


def verify(given: Namespace) -> int:
    """Check, and say what was checked or what is wrong.

    Raises
    ------
    SceneError
        If there is no such file, or it is no certificate.
    """
    from .verify import RefusedError, verified

    if not given.file.is_file():
        raise SceneError(f"there is no file '{given.file}'")
    if not _is_one(given.file):
        raise SceneError(
            f"'{given.file}' is no certificate: `reftrace trace --certificate FILE` writes one"
        )
    try:
        with meanwhile("checking"):
            show(f"{given.file}: {verified(given.file, given.sample)}")
    except RefusedError as error:
        show(f"{given.file}: refused: {error}")
        return DIFFERENCES
    return AGREE


def _is_one(path: Path) -> bool:
    """Return whether a file is a certificate, or an archive too damaged to tell."""
    with path.open("rb") as file:
        is_archive = file.read(2) == b"PK"
    try:
        with ZipFile(path) as archive:
            return "certificate.npy" in archive.namelist()
    except Exception:  # a damaged one has many ways to say no
        return is_archive
