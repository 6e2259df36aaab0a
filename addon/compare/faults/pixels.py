"""Faults that mix a picture's pixels with others: another size, JPEG, something laid over it.

No ray is asked: what is traced goes through the same, and is held against the picture.
"""

from __future__ import annotations

import io
from dataclasses import replace

import numpy as np

from ...arrays import Array, Bools, Colors, Floats
from ...images import curve_undone, encoded
from ...scene import Region
from ...tracer.frame import Frame
from ...tracer.progress import Work
from ..case import Case
from ..evidence import NEAR, Evidence, spread
from .fault import Fault, Guess

SIZES = (1 / 2, 0.9, 0.8, 1 / 3, 1 / 4, 2 / 3, 3 / 4, 2.0)  # of what may have been resampled
NEAREST, LINEAR, BOX = 0.0, 1.0, 2.0
QUALITIES = (95, 90, 85, 80, 75, 70, 60, 50, 40, 30)
JPEG_LEVELS = 8.0  # by how much two writers' pixels may differ: each rounds its own way
LEAST_SURFACES = 2  # that something laid over a picture must cover: else it is a recoloured object
LEAST_COVERED = 0.02  # of what is covered, for a surface to count
OPACITIES = np.arange(2, 101) / 100  # that are tried
MOST_INKS = 2  # colours that are laid over
INK_STEPS = 50  # to which these are told apart
COVERED = 0.9  # the least share of the unexplained pixels that they must make
TOGETHER = 0.75  # of the pixels: single ones, like salt, are nothing that is laid over
MOST_BLENDED = 4096  # pixels that are looked at


def _other_size(case: Case, frame: Frame, guess: Guess) -> Case | None:
    """Return the case with the whole picture traced at another size."""
    camera = case.scene.camera
    width, height = (max(1, round(guess.values[0] * n)) for n in (camera.width, camera.height))
    r = camera.region
    if (r.width, r.height) != (camera.width, camera.height):
        return None  # a border's pixels would not fall on those of another size
    camera = replace(camera, width=width, height=height, region=Region(0, 0, width, height))
    return case.with_scenes(lambda scene: scene.seen_by(camera))


def _resampled(colors: Colors, guess: Guess, evidence: Evidence) -> Colors:
    """Return a picture (h', w', 4) at the size of the evidence's, by nearest pixel or linearly."""
    out: Array = colors
    for axis, size in enumerate(evidence.open.shape):
        have = colors.shape[axis]
        place = (np.arange(size) + 0.5) * have / size - 0.5
        if guess.values[1] == NEAREST:
            out = out.take(np.clip(np.floor(place + 0.5), 0, have - 1).astype(int), axis=axis)
            continue
        if have > size and guess.values[1] == BOX:
            edges = np.arange(size) * have // size
            count = np.diff(np.append(edges, have))
            shape = [1] * out.ndim
            shape[axis] = -1
            out = np.add.reduceat(out, edges, axis=axis) / count.reshape(shape)
            continue
        low = np.clip(np.floor(place), 0, have - 1).astype(int)
        high = np.minimum(low + 1, have - 1)
        shape = [1] * out.ndim
        shape[axis] = -1
        share = np.clip(place - low, 0, 1).reshape(shape)
        out = (1 - share) * out.take(low, axis=axis) + share * out.take(high, axis=axis)
    return out.astype(np.float32)


def _sizes(evidence: Evidence) -> Work[list[Guess]]:
    """Return the sizes and ways that are tried."""
    ways = {NEAREST: "the nearest pixel", LINEAR: "linearly", BOX: "the mean of pixels"}
    return [
        Guess((size, way), words=words)
        for size in SIZES
        for way, words in ways.items()
        if way != BOX or size > 1
    ]
    yield


def _jpeg(colors: Colors, guess: Guess, evidence: Evidence) -> Colors:
    """Return what a JPEG file makes of a picture (h, w, 4)."""
    from PIL import Image

    levels = np.rint(255 * encoded(colors)[::-1, :, :3]).astype(np.uint8)
    file = io.BytesIO()
    quality, sampling = (int(v) for v in guess.values)
    Image.fromarray(levels).save(file, "JPEG", quality=quality, subsampling=sampling)
    read = np.asarray(Image.open(file), np.float64)[::-1] / 255
    return np.concatenate(
        (curve_undone(read), np.ones_like(read[..., :1])), axis=-1, dtype=np.float32
    )


def _find_jpeg(evidence: Evidence) -> Work[list[Guess]]:
    """Return the quality whose errors are the nearest to the picture's, if it has 8 bits."""
    try:
        import PIL.Image  # noqa: F401
    except ImportError:  # an extra, which Blender lacks: nobody stores a reference as a JPEG
        return []
    if evidence.picture.levels not in (0, 255):
        return []
    shown = encoded(evidence.picture.color)[..., :3]

    def off(quality: int, sampling: int) -> tuple[float, Guess]:
        guess = Guess((float(quality), float(sampling)))
        made = encoded(_jpeg(evidence.frame.color, guess, evidence))[..., :3]
        return float(np.abs(made - shown).mean()), guess

    found: list[tuple[float, Guess]] = []
    for sampling in (2, 0):  # 4:2:0, 4:4:4
        for quality in QUALITIES:
            found.append(off(quality, sampling))
            yield 0.0
    near, sampling = (int(v) for v in min(found, key=lambda pair: pair[0])[1].values)
    for quality in range(near - 4, near + 5):
        found.append(off(quality, sampling))
        yield 0.0
    plain = float(np.abs(encoded(evidence.frame.color)[..., :3] - shown).mean())
    error, best = min(found, key=lambda pair: pair[0])
    return [best] if error < plain / 2 else []


def _as_jpeg(case: Case, frame: Frame, guess: Guess) -> Case:
    """Allow for what two writers of a JPEG may differ by."""
    picture = replace(case.picture, levels=255, dither=JPEG_LEVELS, opaque=True)
    return replace(case, picture=picture)


def _in_box(shape: tuple[int, ...], guess: Guess) -> Bools:
    assert guess.box
    left, bottom, right, top = guess.box
    out = np.zeros(shape, bool)
    out[bottom:top, left:right] = True
    return out


def _laid_over(colors: Colors, guess: Guess, evidence: Evidence) -> Colors:
    """Return a picture with colours laid over it, wherever it is unexplained in the guess' box."""
    opacity, inks = guess.values[0], np.reshape(guess.values[1:], (-1, 3))
    where = _in_box(evidence.open.shape, guess) & evidence.open
    under, shown = colors[where].astype(np.float64), evidence.picture.color[where, :3]
    made = (1 - opacity) * under[:, None, :3] + opacity * inks
    best = np.abs(made - shown[:, None]).max(axis=-1).argmin(axis=1)
    out = colors.copy()
    out[where, :3] = made[np.arange(len(best)), best]
    out[where, 3] = evidence.picture.color[where, 3]
    return out


def _find_overlay(evidence: Evidence) -> Work[list[Guess]]:
    """Return an opacity and few colours that make the unexplained pixels, over several surfaces."""
    yield 0.0
    if not _hangs_together(evidence.open):
        return []
    rows, columns = np.nonzero(evidence.open)
    (left, right), (bottom, top) = ((int(np.min(v)), int(np.max(v)) + 1) for v in (columns, rows))
    some = spread(np.ones(len(rows), bool), MOST_BLENDED)
    at = rows[some], columns[some]
    traced = evidence.frame.color[at].astype(np.float64)[:, :3]
    shown = evidence.picture.color[at].astype(np.float64)[:, :3]
    if not np.isfinite(shown).all():
        return []
    best = max((_inks(traced, shown, o) for o in OPACITIES), key=lambda found: found[0])
    covered, opacity, inks = best
    if covered < COVERED or _of_scene(evidence, opacity, inks):
        return []
    values = (opacity, *inks.ravel().tolist())
    return [Guess(values, values[:4], values[:4], box=(left, bottom, right, top))]


def _hangs_together(where: Bools) -> bool:
    """Return whether most of some pixels (h, w) have two beside them, as what is drawn has."""
    beside = -where.astype(np.int32)
    padded = np.pad(where, 1).astype(np.int32)
    for y in range(3):
        for x in range(3):
            beside += padded[y : y + where.shape[0], x : x + where.shape[1]]
    return bool((beside[where] >= 2).mean() > TOGETHER)


def _inks(traced: Floats, shown: Floats, opacity: float) -> tuple[float, float, Floats]:
    """Return the share of n pixels that few colours explain if laid over with an opacity.

    And the opacity, fitted, and the colours (k, 3). Each of them must lie over several surfaces.
    """
    ink = (shown - (1 - opacity) * traced) / opacity
    key, count = np.unique(np.rint(INK_STEPS * ink), axis=0, return_counts=True)
    inks: list[Floats] = []
    slopes: list[Floats] = []
    covered = 0
    for k in np.argsort(-count, kind="stable")[:MOST_INKS]:
        own = np.abs(ink - key[k] / INK_STEPS).max(axis=1) <= 1 / INK_STEPS
        under = np.unique(traced[own], axis=0, return_counts=True)[1]
        several = (under >= LEAST_COVERED * len(traced)).sum() >= LEAST_SURFACES
        if several and key[k].min() >= -1 and key[k].max() <= INK_STEPS + 1:
            inks.append(np.median(ink[own], axis=0))
            slopes.append(np.stack([v[own] - v[own].mean(axis=0) for v in (traced, shown)]))
            covered += int(own.sum())
    if inks:
        a, b = np.concatenate(slopes, axis=1)
        opacity = 1 - float((a * b).sum() / max(float((a * a).sum()), 1e-12))
        kept = [(shown - (1 - opacity) * traced) / opacity] if opacity > 0 else []
        inks = (
            [np.median(kept[0][np.abs(ink - i).max(axis=1) <= 1 / INK_STEPS], axis=0) for i in inks]
            if kept
            else []
        )
    return min(covered / len(traced), 1.0) if inks else 0.0, opacity, np.array(inks)


def _of_scene(evidence: Evidence, opacity: float, inks: Floats) -> bool:
    """Return whether what is laid over hides all, and has a colour that an object may have."""
    table = evidence.case.scene.color_table[:, None, :3]
    return opacity > 1 - NEAR and bool((np.abs(table - inks).max(axis=-1) <= NEAR).any())


PIXEL_FAULTS = (
    Fault(
        "resampled",
        "the picture is rendered at {size:.4g} of its size, and resampled by {words}",
        "render it at the size at which it is compared",
        _other_size,
        _sizes,
        ("size",),
        effort=4,
        sampled=False,
        after=_resampled,
    ),
    Fault(
        "jpeg",
        "the picture was stored as a JPEG of about quality {quality:.0f}",
        "store it as PNG or EXR",
        _as_jpeg,
        _find_jpeg,
        ("quality",),
        put_right=_as_jpeg,
        effort=4,
        sampled=False,
        after=_jpeg,
    ),
    Fault(
        "overlay",
        "something is laid over the picture: opacity {opacity:.2f}, "
        "colour ({red:.3f}, {green:.3f}, {blue:.3f}), linear",
        "switch off stamps, overlays, watermarks and cursors",
        lambda case, frame, guess: case,
        _find_overlay,
        ("opacity", "red", "green", "blue"),
        put_right=lambda case, frame, guess: case,
        effort=4,
        sampled=False,
        after=_laid_over,
    ),
)
