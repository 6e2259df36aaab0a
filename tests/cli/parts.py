"""What the tests of the command line share."""

from __future__ import annotations

import OpenEXR
from reference_tracer.cli.main import main

SMALL = ["--set", "width=24", "height=16"]


def channels(path):
    with OpenEXR.File(str(path), separate_channels=True) as file:
        return {name: c.pixels[::-1] for name, c in file.channels().items()}


def trace(path, out, *options):
    return main(["trace", str(path), "--out", str(out), *SMALL, *options])
