"""The small pictures traced from the exercise's scenes, of lessons and of faults."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw, ImageFont
from reference_tracer.causes.case import Case
from reference_tracer.diagnosis.faults import EXAMPLES
from reference_tracer.files.images import to_display
from reference_tracer.manifest import Manifest
from reference_tracer.pictures.picture import Picture as Shown
from reference_tracer.pictures.source import Source
from reference_tracer.rendering import render
from reference_tracer.tracer.coloring import Color
from reference_tracer.tracer.hits import NOTHING
from reference_tracer.tracer.progress import result_of
from reference_tracer.tracer.settings import Settings
from reference_tracer_grading.judged_scene import prepare
from reference_tracer_grading.page import marked
from reference_tracer_grading.picture import look
from reference_tracer_grading.student import Student
from reference_tracer_grading.subjects.triangle import TRIANGLE

from .figures import scene, traced

WIDTH = 320  # pixels of one picture; several stand side by side
GAP = 8
FAULTY, ACROSS, CAPTION = 4, 6, 20  # a fault's picture: how much smaller; in a row; pixels below
STUDENTS = Path(__file__).resolve().parents[2] / "docs" / "students"

Picture = NDArray[np.uint8]  # (h, w, 4), row 0 at the bottom


def small(picture: Picture) -> Picture:
    """Every second pixel, so that a pixel stays one."""
    step = max(1, round(picture.shape[1] / WIDTH))
    return picture[step // 2 :: step, step // 2 :: step]


def beside(*pictures: Picture) -> Picture:
    """Pictures of one height in a row, with transparent gaps."""
    gap = np.zeros((pictures[0].shape[0], GAP, 4), np.uint8)
    parts = [part for p in pictures for part in (gap, p)][1:]
    return np.concatenate(parts, axis=1)


def shown(name: str, method: str = "certified", precision: str = "float64") -> Picture:
    return small(to_display(traced(name, method, precision).color))


def orthographic() -> Picture:
    return shown("orthographic")


def shapes() -> Picture:
    """The normals, how far each surface faces its ray, and the depth."""
    pictures = (
        to_display(render(scene("orthographic"), Settings(color=color)).color)
        for color in (Color.NORMAL, Color.FACING, Color.DEPTH)
    )
    return beside(*map(small, pictures))


def perspective() -> Picture:
    """The same place through the one camera, then through the other."""
    return beside(shown("orthographic"), shown("perspective"))


def plane() -> Picture:
    """The picture, and its depth: the logarithm of t, near is dark."""
    frame = traced("plane")
    t = frame.t
    seen = np.isfinite(t)
    depth = np.ones((*t.shape, 4), np.uint8) * 255
    log = np.log(np.where(seen, t, 1))
    grey = (log - log[seen].min()) / (log[seen].max() - log[seen].min())
    depth[seen, :3] = np.rint(40 + 190 * grey[seen])[:, None]
    return beside(shown("plane"), small(depth))


def triangle() -> Picture:
    """As it is, and by the textbook's formulas taken literally."""
    return beside(shown("triangle"), shown("triangle", "textbook_literal"))


def weights() -> Picture:
    """The barycentrics as red, green and blue: as they are, and as the textbook prints them."""
    frame = traced("triangle")
    seen = frame.triangle_index != NOTHING

    def colored(order: list[int]) -> Picture:
        out = np.full((*seen.shape, 4), 255, np.uint8)
        out[seen, :3] = np.rint(255 * np.clip(frame.barycentrics[seen][:, order], 0, 1))
        return small(out)

    return beside(colored([0, 1, 2]), colored([0, 2, 1]))


def judged() -> Picture:
    """Draw a student's picture of a scene, the certified picture, and the wrong pixels."""
    subject = result_of(prepare("triangle", scene("triangle"), pixels=60_000))
    with Student(STUDENTS / "as_printed.py", TRIANGLE.form) as student:
        found = result_of(look(subject, student.ask))
    pictures = to_display(found.color), to_display(subject.color), marked(found)
    return beside(*pictures)


def faults() -> Picture:
    """Draw each fault that can be seen in the scene, with its name below."""
    right = scene("perspective")
    width, height = right.camera.width // FAULTY, right.camera.height // FAULTY
    right = right.seen_by(replace(right.camera, width=width, height=height, region=None))
    frame = render(right, Settings())
    manifest = Manifest("", "", "", 0, "FILE", right.camera.name)
    case = Case(right, manifest, Settings(), Shown(frame.color, Source(file="")))
    rows, made = [], [("as it should be", frame.color)]
    for fault, example in EXAMPLES:
        guess = example.pick(case, frame)
        make = example.make or fault.assume
        wrong = guess and make(case, guess)
        if wrong is None:
            continue
        same = wrong.scene is right
        color = wrong.picture.color if same else render(wrong.scene, Settings()).color
        if (color != frame.color).any():
            made.append((fault.name, color))
    for start in range(0, len(made), ACROSS):
        row = [_named(*one) for one in made[start : start + ACROSS]]
        row += [np.zeros_like(row[0])] * (ACROSS - len(row))
        rows.append(beside(*row))
    return np.concatenate(rows[::-1])


def _named(name: str, color: NDArray[np.float32]) -> Picture:
    """A picture with its name below."""
    label = Image.new("RGBA", (color.shape[1], CAPTION), (255, 255, 255, 255))
    ImageDraw.Draw(label).text((2, 3), name, font=ImageFont.load_default(11), fill=(0, 0, 0))
    return np.concatenate((np.asarray(label)[::-1], to_display(color)))


PICTURES: Mapping[str, Callable[[], Picture]] = {
    f.__name__: f
    for f in (orthographic, shapes, perspective, plane, triangle, weights, judged, faults)
}


def write(folder: Path) -> None:
    """Write them all as PNG: docs/images/lessons."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, make in PICTURES.items():
        Image.fromarray(np.ascontiguousarray(make()[::-1])).save(
            folder / f"{name}.png", optimize=True
        )
