"""What a pixel takes in memory at its peak, in a process of its own.

    .venv/bin/python tools/memory_a_pixel.py WHAT SIDE [METHOD [SAMPLES]]

WHAT is trace, png or exr (traced, then made into what is written), or compare (with its own
picture). Two quads in one place fill a picture of SIDE x SIDE pixels. numpy tells tracemalloc what
it takes. `tracer/memory.py` has the results, rounded up.
"""

from __future__ import annotations

import sys
import tempfile
import tracemalloc
from pathlib import Path

import numpy as np
from reference_tracer import exr, images
from reference_tracer.causes.case import Case
from reference_tracer.comparison.comparing import trace_and_compare
from reference_tracer.manifest import Manifest
from reference_tracer.pictures.picture import Picture, Source
from reference_tracer.rendering import render
from reference_tracer.scene import Camera, Instance, Mesh, Scene, ViewWindow
from reference_tracer.tracer.progress import result_of
from reference_tracer.tracer.settings import Settings


def used(what: str, side: int, settings: Settings) -> None:
    corners = [(-9, -9, -5), (9, -9, -5), (9, 9, -5), (-9, 9, -5)]
    camera = Camera(np.eye(4), ViewWindow(-0.5, 0.5, -0.5, 0.5), side, side)
    quad = Mesh(np.array(corners, float), [[0, 1, 2], [0, 2, 3]])
    scene = Scene(camera, (quad,), (Instance(0, 0, np.eye(4)),) * 2, objects=("Quad",))
    if what == "compare":
        shown = Picture(render(scene, settings).color, Source(file="picture"))
        manifest = Manifest("quad", "quad", "", 0, "FILE", "Camera", ())
        result_of(trace_and_compare(Case(scene, manifest, settings, shown, curves=())))
        return
    frame = render(scene, settings)
    with tempfile.TemporaryDirectory() as folder:
        if what == "png":
            images.save_png(Path(folder) / "p.png", images.to_display(frame.color))
        elif what == "exr":
            exr.save(Path(folder) / "p.exr", frame.passes())


def main() -> None:
    what, side, *rest = sys.argv[1:]
    settings = Settings(rest[0] if rest else "certified", samples=int([*rest, 1, 1][1]))
    used(what, 16, settings)  # imports what it needs
    tracemalloc.start()
    used(what, int(side), settings)
    peak = tracemalloc.get_traced_memory()[1]
    print(f"{what} {settings.method} {settings.samples}: {peak / int(side) ** 2:.0f} bytes a pixel")


if __name__ == "__main__":
    main()
