"""What each convention writes, against its published formula and the tracer's own rays."""

from __future__ import annotations

from itertools import combinations
from pathlib import Path

import numpy as np
import pytest
from reference_tracer.camera_files.convention import INTEGER, View
from reference_tracer.camera_files.files import WRITTEN, chosen, read, texts
from reference_tracer.projections import EQUIRECTANGULAR
from reference_tracer.scene import Camera, SceneError, ViewWindow
from reference_tracer.tracer.camera import camera_rays, film_of

from .cameras import KINDS, camera
from .formulas import FORMULAS

SHARP = 1e-9  # pixels: the rounding of float64, with room for a distance of a few metres


def on_disk(files, folder):
    """Write files, and return what a user would name."""
    folder.mkdir(exist_ok=True)
    for name, text in files.items():
        (folder / (name or "camera")).write_text(text, encoding="utf-8")
    return folder / "camera" if "" in files else folder


def rays_of(own, rng, count=200):
    """Film positions from the upper left, and points on the tracer's rays through them."""
    x, y = rng.uniform(0, own.width, count), rng.uniform(0, own.height, count)
    rays = camera_rays(own, x, y)
    points = rays.at(np.exp(rng.uniform(np.log(own.clip_start), np.log(20), count)))
    return np.stack((x, own.height - y)), points


def apart(found, expected):
    return np.abs(found - expected).max()


@pytest.mark.parametrize("name", WRITTEN)
def test_its_formula_agrees_with_the_tracers_rays(name, tmp_path):
    """Over all pairs of what a camera may have; what it cannot say is refused by name."""
    rng, convention = np.random.default_rng(3), WRITTEN[name]
    said = refused = 0
    for first, second in combinations(KINDS, 2):
        own = camera(rng, **(KINDS[first] | KINDS[second]))
        lacking = convention.lacks(own)
        view = View(own, "0007.png", 7)
        if lacking:
            with pytest.raises(SceneError) as error:
                texts([view], convention)
            assert all(words in str(error.value) for words in lacking)
            assert {first, second} & {kind for kind in KINDS for w in lacking if w.startswith(kind)}
            refused += 1
            continue
        files = texts([view], convention)
        film, points = rays_of(own, rng)
        assert apart(FORMULAS[name](files, points), film) < SHARP
        path = on_disk(files, tmp_path / f"{said}")
        (again,) = read(path, size=(own.width, own.height))
        x, y, _ = film_of(again.camera, points)
        assert apart(np.stack((x, own.height - y)), film) < SHARP
        assert (again.camera.width, again.camera.height) == (640, 360)
        if again.is_clipped:
            ends = again.camera.clip_start, again.camera.clip_end
            assert ends == pytest.approx((0.1, 50), rel=1e-9)
        said += 1
    assert (said and refused) or name == "opengl"


@pytest.mark.parametrize("name", WRITTEN)
def test_a_panorama_is_refused(name):
    own = Camera(np.eye(4), ViewWindow(-1, 1, -0.5, 0.5), 8, 4, EQUIRECTANGULAR)
    with pytest.raises(SceneError, match="a panoramic projection"):
        texts([View(own, "0001.png", 1)], WRITTEN[name])


@pytest.mark.parametrize("name", [n for n, c in WRITTEN.items() if c.either_center])
def test_centers_at_integers_are_half_a_pixel_less_and_said(name, tmp_path):
    rng = np.random.default_rng(4)
    own = camera(rng)
    views = [View(own, "0001.png", 1)]
    half, whole = (texts(views, WRITTEN[name], centers) for centers in ("half", INTEGER))
    assert half != whole
    film, points = rays_of(own, rng)
    (again,) = read(on_disk(whole, tmp_path / "integer"), size=(own.width, own.height))
    x, y, _ = film_of(again.camera, points)
    assert apart(np.stack((x, own.height - y)), film) < SHARP


@pytest.mark.parametrize("name", [n for n, c in WRITTEN.items() if not c.either_center])
def test_centers_at_integers_are_refused_where_a_file_cannot_say_so(name):
    own = camera(np.random.default_rng(4))
    with pytest.raises(SceneError, match="--centers integer"):
        texts([View(own, "0001.png", 1)], WRITTEN[name], INTEGER)


@pytest.mark.parametrize("name", WRITTEN)
def test_several_frames_are_found_by_name_and_by_number(name, tmp_path):
    rng = np.random.default_rng(5)
    cameras = [camera(rng) for _ in range(3)]
    views = [View(own, f"{n:04d}.png", n) for n, own in zip((3, 8, 13), cameras, strict=True)]
    path = on_disk(texts(views, WRITTEN[name]), tmp_path / "many")
    found = read(path, size=(640, 360))
    assert len(found) == 3
    for which in ("8", found[1].name, Path(found[1].name).stem):
        again = chosen(found, which).camera
        film, points = rays_of(cameras[1], rng)
        x, y, _ = film_of(again, points)
        assert apart(np.stack((x, again.height - y)), film) < SHARP
    with pytest.raises(SceneError, match="3 cameras: --set camera-view"):
        chosen(found, None)
    with pytest.raises(SceneError, match="no camera '9'; there are"):
        chosen(found, "9")
