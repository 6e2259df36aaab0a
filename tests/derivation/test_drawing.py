"""The drawings of a derivation: the points in them are the numbers, and all words are legible."""

from __future__ import annotations

import itertools
from xml.etree import ElementTree

import numpy as np
import pytest
from reference_tracer.derivation.derivation import derive
from reference_tracer.derivation.textbook import Arithmetic
from reference_tracer.projections import PROJECTIONS

pytestmark = pytest.mark.browser

TRIANGLE = [(-1, -1, -4), (1.4, -0.8, -5), (-0.3, 1.6, -6)]
OUTSIDE = [(-1, -1.2, -4), (2, -1, -4), (2, 1.8, -5)]  # beside the ray; its box is not


def value(quantities, key):
    found = next(q for q in quantities if q.key == key)
    values = np.array(found.values[Arithmetic.FLOAT64], float)
    return values if len(values) > 1 else float(values[0])


def read(tab):
    """The drawings of a page by their names: points by theirs, and shapes, y up."""
    out = {}
    for text in tab.locator(".drawings svg").evaluate_all("all => all.map(e => e.outerHTML)"):
        svg = ElementTree.fromstring(text)
        points = {
            c.get("data-name"): np.array((float(c.get("cx")), -float(c.get("cy"))))
            for c in svg.iter("circle")
        }
        shapes = {
            s.get("data-name"): np.array(
                [[float(v) for v in p.split(",")] for p in s.get("points").split()]
            )
            * (1, -1)
            for s in (*svg.iter("polygon"), *svg.iter("polyline"))
        }
        words = {t.text for t in svg.iter("text")}
        out[svg.get("data-name")] = points, shapes, words, float(svg.get("data-scale")), svg
    return out


@pytest.fixture
def drawn(page_of):
    return lambda derivation: read(page_of(derivation))


def area(a, b, c):
    (x, y), (u, v) = b - a, c - a
    return (x * v - y * u) / 2


@pytest.mark.parametrize("kind", ["perspective", "orthographic", "equirectangular"])
@pytest.mark.parametrize("triangle", [TRIANGLE, OUTSIDE, TRIANGLE[::-1]])
def test_the_areas_are_the_weights(one_triangle, triangle, kind, drawn):
    """Each with its sign: a negative one lies on the other side of its edge, and is dashed."""
    derivation = derive(one_triangle(triangle, projection=PROJECTIONS[kind]), 1, 1)
    [test] = derivation.tests
    points, _shapes, words, scale, svg = drawn(derivation)["plane"]
    p, x = [points[f"p{k}"] for k in "₁₂₃"], points["x"]
    whole = area(*p)
    for k in range(3):
        s = value(test.quantities, f"s{k + 1}")
        share = area(x, p[(k + 1) % 3], p[(k + 2) % 3]) / whole
        assert share == pytest.approx(s, abs=1e-5)
        assert any(w.startswith(f"s{'₁₂₃'[k]} = ") for w in words)
    corners = [value(test.quantities, f"p{k}") for k in (1, 2, 3)]
    for a, b in itertools.combinations(range(3), 2):  # lengths are those of the world
        assert np.linalg.norm(p[a] - p[b]) / scale == pytest.approx(
            np.linalg.norm(corners[a] - corners[b]), rel=1e-5
        )
    inside = all(share >= 0 for share in (area(x, p[k - 2], p[k - 1]) / whole for k in range(3)))
    assert inside == test.judgements[Arithmetic.FLOAT64].accepted == (triangle is not OUTSIDE)
    dashed = sum("negative" in s.get("class") for s in svg.iter("polygon"))
    assert dashed == sum(value(test.quantities, f"s{k}") < 0 for k in (1, 2, 3))
    assert len([*svg.iter("polygon")]) == 4


def test_the_film_has_the_pixel_and_the_corners_where_they_are(ball_scene, drawn):
    camera = ball_scene.camera
    derivation = derive(ball_scene, 9, 8)
    points, shapes, words, _, _ = drawn(derivation)["film"]
    low, high = shapes["film"].min(axis=0), shapes["film"].max(axis=0)
    at = (points["pixel"] - low) / (high - low)
    assert at == pytest.approx([9.5 / camera.width, 8.5 / camera.height], abs=1e-5)
    window = camera.window
    edges = np.array([(window.left, window.bottom), (window.right, window.top)])
    to_camera = np.linalg.inv(camera.world_from_camera)
    for k, corner in zip("₁₂₃", derivation.seen.points, strict=True):
        x, y, z = (to_camera @ [*corner, 1])[:3]
        film = np.array((x, y)) if camera.projection.shares_direction else np.array((x, y)) / -z
        share = (film - edges[0]) / (edges[1] - edges[0])
        if ((share > 0) & (share < 1)).all():
            assert (points[f"p{k}"] - low) / (high - low) == pytest.approx(share, abs=1e-4)
    assert any(w.startswith("u = ") for w in words)


def test_from_the_side_x_is_t_times_d_away_from_o(ball_scene, drawn):
    derivation = derive(ball_scene, 9, 8)
    t = value(derivation.seen_test.quantities, "t")
    plates = drawn(derivation)
    points, shapes, words, scale, _ = plates["side"]
    d, ray = (np.diff(shapes[name], axis=0)[0] for name in ("d", "ray"))
    assert ray == pytest.approx(t * d, rel=1e-4, abs=1e-3)
    assert ray == pytest.approx(points["x"] - points["o"], abs=1e-3)
    camera = derivation.pixel.camera
    axes = np.linalg.inv(camera.world_from_camera)[:3, :3]
    _x, y, z = axes @ value(derivation.ray, "d")
    assert d / scale == pytest.approx([-z, y], abs=1e-5)
    assert np.ptp(shapes["film"][:, 1]) / scale == pytest.approx(
        camera.window.top - camera.window.bottom, rel=1e-4
    )
    depth = 0 if camera.projection.shares_direction else 1
    assert (shapes["film"][:, 0] - points["o"][0]) / scale == pytest.approx([depth] * 2, abs=1e-4)
    assert any(w.startswith("t = ") and w.endswith(" m") for w in words)
    assert ("eye" in plates) == (t > 5)


def test_a_far_surface_has_the_beginning_of_the_ray_by_itself(one_triangle, drawn):
    far = [(-40, -40, -90), (50, -30, -90), (0, 60, -90)]
    plates = drawn(derive(one_triangle(far), 1, 1))
    points, shapes, words, scale, _ = plates["eye"]
    assert np.diff(shapes["d"], axis=0)[0] / scale == pytest.approx([1, 0], abs=1e-6)
    assert {"o", "d", "film"} <= {w for text in words for w in text.split(", ")}
    assert "x" in plates["side"][0] and "x" not in points


def test_nothing_but_the_film_and_the_ray_where_nothing_is_met(one_triangle, drawn):
    away = [(9, 9, -4), (10, 9, -4), (9, 10, -4)]
    plates = drawn(derive(one_triangle(away), 1, 1))
    assert set(plates) == {"film", "pixel", "side"}
    assert not {"x", "p₁"} & set(plates["side"][0])


def test_a_plane_has_its_point_and_x(one_triangle, drawn):
    scene = one_triangle(planes=[((0.5, 0.25, -3), (0.2, 0.1, 1))])
    points, _, _, scale, _ = drawn(derive(scene, 1, 1))["plane"]
    [test] = derive(scene, 1, 1).tests
    way = value(test.quantities, "x") - test.candidate.points[0]
    assert np.linalg.norm(points["x"] - points["p"]) / scale == pytest.approx(
        np.linalg.norm(way), rel=1e-5
    )


@pytest.mark.parametrize(
    "triangle",
    [
        [(0, 0, -4), (1, 1, -4), (2, 2, -4)],  # no plane
        [(-1, 0, -4), (1, 0, -4), (0, 0, -9)],  # the ray is in its plane
        [(-1e200, -1e200, -4), (1e200, -1e200, -4), (0, 1e200, -4)],
        [(-1e-200, -1e-200, -4), (1e-200, -1e-200, -4), (0, 1e-200, -4)],
        [(-2, -2, -1), (2, -2, -1), (0, 5, 30)],  # with a corner behind the eye
    ],
)
def test_what_cannot_be_drawn_is_left_out(one_triangle, triangle, page_of):
    tab = page_of(derive(one_triangle(triangle), 1, 1))
    text = tab.locator(".drawings").inner_html()
    assert "NaN" not in text and "Infinity" not in text
    assert set(read(tab)) >= {"film", "side"}


@pytest.mark.parametrize("scheme", ["light", pytest.param("dark", marks=pytest.mark.torture)])
@pytest.mark.parametrize("width", [390, 1280])
def test_no_words_overlap(page_of, ball_scene, scheme, width):
    viewport = {"width": width, "height": 900}
    tab = page_of(derive(ball_scene, 9, 8), viewport=viewport, color_scheme=scheme)
    for svg in tab.locator(".drawings svg").all():
        out = svg.bounding_box()
        boxes = [t.bounding_box() for t in svg.locator("text").all()]
        for box in boxes:
            assert out["x"] <= box["x"] and box["x"] + box["width"] <= out["x"] + out["width"]
            assert out["y"] <= box["y"] and box["y"] + box["height"] <= out["y"] + out["height"]
        for a, b in itertools.combinations(boxes, 2):
            across = a["x"] + a["width"] <= b["x"] or b["x"] + b["width"] <= a["x"]
            assert across or abs(a["y"] - b["y"]) >= a["height"] - 6
    size, paper, ink = tab.evaluate(
        """() => {
          const text = document.querySelector(".drawings text");
          const shown = parseFloat(getComputedStyle(text).fontSize) *
            text.ownerSVGElement.getScreenCTM().a;
          return [shown, getComputedStyle(document.body).backgroundColor,
            getComputedStyle(text).fill];
        }"""
    )
    assert size >= 11 and paper != ink
    assert tab.evaluate("() => document.documentElement.scrollWidth") <= width
