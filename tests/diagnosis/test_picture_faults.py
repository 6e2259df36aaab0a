"""Faults of a picture's colours, sizes and filters: each gets its name, and none that is like it.

Only what is done to pictures and colours is looked for, which is quick; `test_diagnosis.py` and the
test bed look for all.
"""

from __future__ import annotations

import io
from dataclasses import replace

import numpy as np
import pytest
import trimesh
from PIL import Image, ImageEnhance
from reference_tracer.causes.cause import UNEXPLAINED
from reference_tracer.comparison.comparing import trace_and_compare
from reference_tracer.diagnosis.diagnosis import diagnose
from reference_tracer.diagnosis.faults import FAULTS
from reference_tracer.diagnosis.faults.colors import COLOR_FAULTS
from reference_tracer.diagnosis.faults.fault import Numbers
from reference_tracer.diagnosis.faults.picture import PICTURE_FAULTS
from reference_tracer.diagnosis.faults.sizes import Way, resized
from reference_tracer.files.images import curve, curve_undone
from reference_tracer.pictures.curves import CURVES
from reference_tracer.pictures.picture import Picture
from reference_tracer.pictures.storage import Storage
from reference_tracer.rendering import render
from reference_tracer.scene import GREY, Instance, Mesh, Region
from reference_tracer.tracer.progress import result_of

from ..cases import case_of

LOOKED_FOR = [f for f in FAULTS if f in (*COLOR_FAULTS, *PICTURE_FAULTS)]
SEED = 27
COLORS = (
    (0.62, 0.21, 0.11),
    (0.09, 0.45, 0.71),
    (0.33, 0.52, 0.07),
    (0.81, 0.77, 0.39),
    (0.15, 0.05, 0.36),
    (0.02, 0.015, 0.03),
)


@pytest.fixture
def quads(make):
    """Return squares of six colours, aslant, over a floor that fills the picture."""
    camera = make.camera(72, 48, half=0.5)
    places = ((-1, 1, -0.7, 0.7), (-0.8, -0.3, -0.4, 0.3), (-0.2, 0.25, -0.5, 0.05))
    places += ((0.35, 0.8, -0.35, 0.2), (-0.25, 0.3, 0.12, 0.5), (0.4, 0.75, 0.3, 0.5))
    meshes = [make.quad(*(4 * v for v in p), -4 + 0.05 * n) for n, p in enumerate(places)]
    turned = np.eye(4)
    turned[:2, :2] = [[np.cos(0.11), -np.sin(0.11)], [np.sin(0.11), np.cos(0.11)]]
    scene = make.scene(camera, *meshes)
    instances = [
        Instance(n, n, turned if n else np.eye(4), [[*color, 1.0]])
        for n, color in enumerate(COLORS)
    ]
    return replace(scene, instances=tuple(instances), objects=tuple("ABCDEF"))


def told(scene, color, curves=(), faults=LOOKED_FOR, **known):
    """Return what is told of a picture (h, w, 4), by its name; none of it is excused."""
    picture = Picture(np.asarray(color, np.float32), **known)
    found = result_of(trace_and_compare(case_of(scene, picture, curves=curves)))
    assert found.counts.unexplained > 10 and found.verdict == "differences"
    assert not found.causes.transform
    diagnosis = result_of(diagnose(found.case, found.frame, found.causes, faults, np.inf))
    for one in diagnosis.told:
        assert not set("{}") & set("".join(one.lines()))  # all numbers and names are filled in
    return {one.fault.name: one for one in diagnosis.told}


def of_rgb(change):
    """Return what changes a picture's straight RGB; all is opaque here."""

    def changed(color):
        color = color.astype(np.float64)
        return np.concatenate((change(color[..., :3]), color[..., 3:]), axis=-1)

    return changed


def coded(change):
    """Return what changes values of sRGB's curve."""
    return of_rgb(lambda c: curve_undone(np.clip(change(curve(c)), 0, 1)))


def eight(values):
    return np.rint(255 * np.clip(values, 0, 1)) / 255


def saturated(share, weights=(0.2126, 0.7152, 0.0722)):
    def change(c):
        grey = (c @ np.array(weights))[..., None]
        return np.maximum(grey + share * (c - grey), 0)

    return change


def noisy(levels):
    rng = np.random.default_rng(SEED)
    return coded(lambda c: eight(c + rng.uniform(-levels, levels, c.shape) / 255))


def mean(n, at=0):
    """Return what makes each pixel the mean of n x n, the first of which is `at` before it."""

    def change(color):
        height, width = color.shape[:2]
        wide = np.pad(color.astype(np.float64), ((at, n), (at, n), (0, 0)), "edge")
        parts = [wide[y : y + height, x : x + width] for y in range(n) for x in range(n)]
        return np.mean(parts, axis=0)

    return change


def gaussian(color):
    """Filter it by (1, 2, 1) / 4 either way: the mean of 2 x 2 of what is that already."""
    return mean(2, 1)(mean(2)(color))


def halved(color):
    """Take every other pixel, twice as large."""
    return color[::2, ::2].repeat(2, 0).repeat(2, 1)


def recolored(c):
    """Return a colour of its own for each object's."""
    apart = np.abs(c[..., None, :] - np.array(COLORS)).max(axis=-1)
    return np.random.default_rng(SEED).uniform(0.1, 0.9, (len(COLORS), 3))[apart.argmin(axis=-1)]


def elsewhere(c):
    """Return the colours of the next object in place of each one's own."""
    apart = np.abs(c[..., None, :] - np.array(COLORS)).max(axis=-1)
    return np.array(COLORS)[(apart.argmin(axis=-1) + 1) % len(COLORS)]


def in_bits(*bits):
    most = 2.0 ** np.array(bits) - 1
    return coded(lambda c: np.rint(most * c) / most)


def smoothly_halved(color):
    """Take every other pixel, and enlarge them as an editor does."""
    small = curve(color[::2, ::2])
    parts = [
        Image.fromarray(small[..., k]).resize((72, 48), Image.Resampling.BICUBIC) for k in range(4)
    ]
    return curve_undone(np.clip(np.stack([np.asarray(p) for p in parts], axis=-1), 0, 1))


def in_hues(change):
    """Return what changes hues alone, as a JPEG has them (Rec. 601)."""

    def changed(c):
        other = change(np.concatenate((c, c[..., :1]), axis=-1))[..., :3]
        return other + ((c - other) @ (0.299, 0.587, 0.114))[..., None]

    return coded(changed)


def four(color):
    """Smooth it as four samples a pixel do: every second pixel is mixed with its neighbours."""
    rng = np.random.default_rng(SEED)
    some = rng.random(color.shape[:2]) < 0.5
    return np.where(some[..., None], mean(2)(color), color)


# Each fault, and what it makes of the right picture.
MADE = {
    "row_off": [
        (lambda c: np.roll(c, 1, 0)),
        (lambda c: np.roll(c, -1, 0)),
        (lambda c: np.roll(c, 1, 1)),
        (lambda c: np.roll(c, -1, 1)),
    ],
    "processed": [
        of_rgb(saturated(1.25)),
        of_rgb(saturated(0.0)),
        coded(saturated(0.7, (0.299, 0.587, 0.114))),
        of_rgb(lambda c: c * (1.1, 1.0, 0.85)),
        coded(lambda c: c * (0.9, 1.0, 1.05)),
        noisy(1.4),
        noisy(6.0),
    ],
    "rounding_level": [coded(eight), in_bits(5, 6, 5), of_rgb(eight)],
    "srgb_twice": [of_rgb(lambda c: eight(curve(c)))],
    "srgb_left_out": [of_rgb(lambda c: curve_undone(eight(c)))],
    "power_for_srgb": [
        of_rgb(lambda c: curve_undone(eight(curve_undone(eight(curve(c))) ** (1 / 2.2)))),
        of_rgb(lambda c: curve_undone(eight(c ** (1 / 2.2)))),
    ],
    "swapped_colors": [of_rgb(elsewhere)],
    "color_source": [of_rgb(recolored), of_rgb(lambda c: 0 * c + 0.8)],
    "filter_radius": [gaussian, four],
    "resampled": [
        smoothly_halved,
        in_hues(lambda c: halved(mean(2)(c))),
        halved,
        lambda c: halved(mean(2)(c)),
        lambda c: halved(np.roll(c, -1, (0, 1))),
        lambda c: c[::4, ::4].repeat(4, 0).repeat(4, 1),  # from the lowest row
    ],
}
# The first of each is quick enough for every run.
CASES = [
    pytest.param(name, change, id=f"{name}{n}", marks=[pytest.mark.torture] if n else [])
    for name, changes in MADE.items()
    for n, change in enumerate(changes)
]


@pytest.mark.slow
@pytest.mark.parametrize(("name", "change"), CASES)
def test_it_gets_its_name_and_no_other(quads, name, change):
    found = told(quads, change(render(quads).color))
    assert set(found) == {name}
    whole = 0.97 if name == "processed" else 1.0
    assert found[name].settled >= whole * found[name].unexplained
    assert found[name].broken <= (1 - whole) * found[name].agreed


@pytest.mark.slow
@pytest.mark.parametrize("linearly", [True, False])
def test_a_picture_of_half_the_size_is_resampled(quads, linearly):
    small = resolved(quads, 0.5)
    every = np.ogrid[:48, :72]
    large = (
        resized(small, (48, 72), Way.LINEAR, every)
        if linearly
        else small.repeat(2, axis=0).repeat(2, axis=1)
    )
    assert set(told(quads, large)) == {"resampled"}


@pytest.mark.slow
@pytest.mark.parametrize("n", [2, pytest.param(4, marks=pytest.mark.torture)])
def test_a_mean_of_samples_is_no_filter(quads, n):
    color = resolved(quads, n).reshape(48, n, 72, n, 4).mean(axis=(1, 3))
    found = told(quads, color)
    assert set(found) == {"supersampled"}
    assert f"{n} x {n} samples" in found["supersampled"].sentence


def through_a_jpeg(color, quality=80):
    """Return a picture whose straight colours went through a JPEG; its alpha is kept apart."""
    alpha = color[..., 3:]
    stored = np.rint(255 * curve(color[::-1, :, :3] / alpha[::-1])).astype(np.uint8)
    Image.fromarray(stored).save(file := io.BytesIO(), "JPEG", quality=quality)
    read = curve_undone(np.asarray(Image.open(file), np.float64)[::-1] / 255)
    return np.concatenate((read * alpha, alpha), axis=-1)


@pytest.mark.slow
def test_a_jpeg_is_a_processed_picture(quads):
    camera = replace(quads.camera, width=216, height=144, region=Region(0, 0, 216, 144))
    scene = quads.seen_by(camera)
    shown = through_a_jpeg(render(scene).color, 92)
    quick = [f for f in LOOKED_FOR if f.name in ("processed", "exposure", "rounding_level")]
    assert set(told(scene, shown, faults=quick, storage=Storage(255))) == {"processed"}


def resolved(scene, ratio):
    """Return the picture at another size."""
    camera = scene.camera
    width, height = (int(ratio * n) for n in (camera.width, camera.height))
    region = replace(camera.region, x1=width, y1=height)
    return render(scene.seen_by(replace(camera, width=width, height=height, region=region))).color


def test_a_picture_of_three_rows_is_looked_at_in_each_size(quads):
    camera = replace(quads.camera, height=3, region=Region(0, 0, 72, 3))
    scene = quads.seen_by(camera)
    assert "resampled" not in told(scene, 0.7 * render(scene).color[:, ::-1])


def in_part(change):
    """Return what changes the left half alone."""
    return lambda c: np.concatenate((change(c)[:, :36], c[:, 36:]), axis=1)


def shaded(c):
    """Light it by a warm light from the right: each pixel in a shade of its own."""
    return c * np.linspace(0.5, 1.1, c.shape[1])[:, None] * (1.1, 1.0, 0.85)


# Pictures that look as if they had a fault, and have it in a part, or not at all.
ALIKE = {
    "a part with another white balance": in_part(of_rgb(lambda c: c * (1.1, 1.0, 0.85))),
    "a part with another saturation": in_part(of_rgb(saturated(1.25))),
    "a light": of_rgb(shaded),
    "noise of forty levels": noisy(40.0),
    "a part in other colours": in_part(of_rgb(recolored)),
    "noise in a part": in_part(noisy(2.0)),
    "a mean in a part": in_part(mean(2)),
    "a part shrunk": in_part(halved),
    "hues of a part": in_part(in_hues(lambda c: halved(mean(2)(c)))),
}
QUICK = "a light", "a part in other colours"
ALIKE_CASES = [
    pytest.param(change, id=name, marks=[] if name in QUICK else [pytest.mark.torture])
    for name, change in ALIKE.items()
]


@pytest.mark.slow
@pytest.mark.parametrize("change", ALIKE_CASES)
def test_what_looks_like_it_does_not_get_its_name(quads, change):
    assert not set(told(quads, change(render(quads).color)))


EXCUSED = {curve.name: curve.of for curve in CURVES} | {"an exposure": lambda c: 1.3 * c}


@pytest.mark.parametrize("name", EXCUSED)
def test_a_transform_of_all_objects_but_one_is_no_excuse_for_that_one(quads, name):
    """Of all of them, it is one."""
    right = render(quads)
    wrong = of_rgb(EXCUSED[name])(right.color)
    for some in (right.object_index >= 0, right.object_index != 1):
        color = np.where(some[..., None], wrong, right.color).astype(np.float32)
        case = case_of(quads, Picture(color), curves=())
        found = result_of(trace_and_compare(case)).causes.cause == UNEXPLAINED
        of_one = found[right.object_index == 1].mean()
        rest = found[right.object_index != 1].mean()
        assert max(of_one, rest) > 0.9 if not some.all() else max(of_one, rest) == 0


@pytest.mark.parametrize("fault", FAULTS, ids=lambda fault: fault.name)
def test_a_sentence_and_its_advice_have_their_numbers(fault):
    guess = Numbers(tuple(1.5 + n for n in range(len(fault.numbers))), object="Ball", words="words")
    for text in (fault.sentence_of(guess), fault.advice_of(guess)):
        assert text and "{" not in text and "}" not in text


@pytest.mark.filterwarnings("error")
def test_a_scene_that_is_grey_has_other_colours_in_the_picture(quads):
    """As a mesh has, of which nobody knows the colours."""
    grey = np.array([GREY], np.float32)
    scene = replace(quads, instances=tuple(replace(i, colors=grey) for i in quads.instances))
    assert "color_source" in told(scene, render(quads).color)


def test_what_shows_no_surface_has_no_other_source_of_colours(quads):
    """As of a camera that looks the other way: all that is there is the background."""
    scene = replace(quads, background=np.array((0.25, 0.35, 0.5, 1.0), np.float32))
    color = np.broadcast_to(scene.background, render(scene).color.shape).copy()
    assert "color_source" not in told(scene, color)


@pytest.mark.slow
def test_one_objects_colour_is_no_processing(quads):
    instances = list(quads.instances)
    warm = np.array(COLORS[0]) * (1.1, 1.0, 0.85)
    instances[0] = replace(instances[0], colors=np.array([[*warm, 1.0]], np.float32))
    found = told(quads, render(replace(quads, instances=tuple(instances))).color)
    assert set(found) == {"recolored"} and found["recolored"].guess.object == "A"


@pytest.mark.slow
def test_swapped_channels_are_no_processing(quads):
    color = render(quads).color[..., [2, 1, 0, 3]]
    assert set(told(quads, color, curves=None)) == {"channels"}


@pytest.mark.slow
def test_a_viewer_that_grades_eight_bits_processes_them(quads):
    """As Pillow does; the size is what a surface is off by, at most."""
    color = render(quads).color
    stored = Image.fromarray(np.rint(255 * curve(color[..., :3])).astype(np.uint8))
    graded = np.asarray(ImageEnhance.Color(stored).enhance(1.25)) / 255
    shown = np.concatenate((curve_undone(graded), color[..., 3:]), -1)
    found = told(quads, shown, storage=Storage(255))
    assert set(found) == {"processed"}
    off = 100 * np.abs(graded - curve(color[..., :3])).max()
    assert found["processed"].guess.values[0] == pytest.approx(off, abs=0.5)


@pytest.mark.slow
@pytest.mark.parametrize(("shown", "words"), [((0, 0, 0), "first"), ((1, 2, 0), "next")])
def test_another_material_slot_is_a_source_of_colours(quads, shown, words):
    """Of an object with three; the others have one, and are shown in it."""
    own = np.array([[*color, 1.0] for color in COLORS[:3]], np.float32)
    mesh = trimesh.creation.icosphere(1, radius=1.2)
    ball = Mesh(mesh.vertices - (0, 0, 3), mesh.faces, slots=np.arange(len(mesh.faces)) % 3)
    number = len(quads.meshes)

    def with_colors(colors):
        instances = (*quads.instances[3:], Instance(number, 0, np.eye(4), colors))
        return replace(quads, meshes=(*quads.meshes, ball), instances=instances)

    found = told(with_colors(own), render(with_colors(own[list(shown)])).color)
    assert set(found) == {"color_source"} and words in found["color_source"].sentence
