"""What a picture's own renderer may round: rasterisers excuse more than rays of float32."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from reference_tracer.causes.explain import AGREE, CLIP_PLANE, DEPTH_TIE, UNEXPLAINED
from reference_tracer.files import exr, images
from reference_tracer.pictures.picture import Picture
from reference_tracer.pictures.renderers import RASTER, RAYS, renderer_of
from reference_tracer.pictures.sampling import Sampling
from reference_tracer.pictures.source import Source
from reference_tracer.rendering import render
from reference_tracer.scene import Mesh
from reference_tracer.tracer.camera import Rays
from reference_tracer.tracer.hits import Hits
from reference_tracer.tracer.progress import result_of
from reference_tracer.tracer.vector import cross, dot

from ..cases import find_causes
from ..oracle import rational

F = np.float32
FOREIGN = Source(file="theirs.exr")


def causes_of(scene, color, renderer):
    picture = Picture(color, FOREIGN, sampling=Sampling(renderer=renderer))
    return result_of(find_causes(scene, render(scene), picture)).cause


@pytest.fixture
def two_walls(make):
    """Ten centimetres apart, a kilometre away: a depth buffer does not tell them apart."""
    camera = make.camera(32, 24, clip_start=0.001, clip_end=1e4)
    walls = [make.quad(-300, 300, -300, 300, z) for z in (-1000, -1000.1)]
    return make.scene(camera, *walls)


@pytest.fixture
def wall_far_away(make):
    """Forty kilometres away, in a clip range from a micrometre on."""
    camera = make.camera(32, 24, clip_start=1e-6, clip_end=1e6)
    return make.scene(camera, make.quad(-1e4, 1e4, -1e4, 1e4, -4e4), make.quad(-1, 1, -1, 1, -9))


def test_the_farther_of_two_walls_is_excused_of_a_rasteriser_alone(two_walls):
    shown = render(replace(two_walls, instances=two_walls.instances[1:])).color
    walls = render(two_walls).instance_index >= 0
    assert (causes_of(two_walls, shown, RASTER)[walls] == DEPTH_TIE).mean() > 0.9
    assert (causes_of(two_walls, shown, RAYS)[walls] == UNEXPLAINED).mean() > 0.9


def test_a_missing_wall_is_excused_of_a_rasteriser_alone(wall_far_away):
    scene = wall_far_away
    shown = render(replace(scene, instances=scene.instances[1:])).color
    gone = render(scene).instance_index == 0
    assert (causes_of(scene, shown, RASTER)[gone] == CLIP_PLANE).mean() > 0.9
    assert (causes_of(scene, shown, RAYS)[gone] == UNEXPLAINED).mean() > 0.9


def test_rays_of_float32_may_show_either_of_what_they_do_not_tell_apart(make):
    gap = 1e-5  # metres, at 50 m: the last place of a float32 is 4e-6
    walls = [make.quad(-300, 300, -300, 300, z) for z in (-50, -50 - gap)]
    scene = make.scene(make.camera(16, 12), *walls)
    shown = render(replace(scene, instances=scene.instances[1:])).color
    assert not (causes_of(scene, shown, RAYS) == UNEXPLAINED).any()


def test_blenders_header_says_which_engine_made_a_picture(make, tmp_path):
    import OpenImageIO

    noted = {"Scene": "Scene", "Camera": "Camera", "RenderTime": "00:01.00"}
    for more, engine in (({}, "other"), ({"cycles.ViewLayer.samples": "1"}, "cycles")):
        spec = OpenImageIO.ImageSpec(4, 3, 4, "float")
        for name, value in {**noted, **more}.items():
            spec.attribute(name, value)
        file = OpenImageIO.ImageOutput.create(str(tmp_path / "picture.exr"))
        assert file.open(str(tmp_path / "picture.exr"), spec)
        assert file.write_image(np.zeros((3, 4, 4), F)) and file.close()
        assert images.open_picture(tmp_path / "picture.exr").read().engine == engine
    exr.save(tmp_path / "own.exr", {"color": np.zeros((3, 4, 4), F)})
    assert images.open_picture(tmp_path / "own.exr").read().engine == ""


def needles(make, count, above=-3.0):
    """A pole of so many long sides, seen at 480 x 270, from a height on."""
    camera = make.camera(480, 270, half=0.5, eye=(2.5, -3.0, 1.2), target=(0, 0, 0))
    angle = 2 * np.pi * np.arange(count) / count
    ring = np.stack((0.05 * np.cos(angle), 0.05 * np.sin(angle)), axis=1)
    low, high = (np.column_stack((ring, np.full(count, z))) for z in (max(above, -1.0), 1.0))
    k, n = np.arange(count), np.roll(np.arange(count), -1)
    sides = [*zip(k, n, n + count, strict=True), *zip(k, n + count, k + count, strict=True)]
    return make.scene(camera, Mesh(np.concatenate((low, high)), np.array(sides)))


@pytest.mark.parametrize("count", [16, 128])
def test_a_sound_picture_of_thin_triangles_agrees_and_half_of_them_differs(make, count):
    """Their long edges are known as well as any: no band lies about them."""
    scene = needles(make, count)
    sound = causes_of(scene, render(scene).color, RAYS)
    assert (sound == AGREE).all()
    shown = render(needles(make, count, above=0.0)).color
    changed = (shown != render(scene).color).any(axis=-1)
    assert changed.sum() > 300
    assert (causes_of(scene, shown, RAYS)[changed] == UNEXPLAINED).mean() > 0.95


def triangles_before(rng, count, least_sine, least_cosine):
    """Return corners (3, 3, count) that rays (3, count) from the origin hit, all in float32.

    Their first corner has about this sine, their plane is seen at about this cosine.
    """

    def unit(v):
        return v / np.sqrt(dot(v, v))

    depth = 10 ** rng.uniform(0, 2, count)
    d = unit(rng.normal(size=(3, count)))
    cosine = least_cosine * rng.uniform(1, 3, count)
    sine = least_sine * rng.uniform(1, 3, count)
    across = unit(cross(d, rng.normal(size=(3, count))))
    along = np.sqrt(1 - cosine**2) * d + cosine * cross(d, across)
    turn = rng.uniform(0, 2 * np.pi, count)
    e = np.cos(turn) * across + np.sin(turn) * along
    f = np.cos(turn) * along - np.sin(turn) * across
    size = depth * 10 ** rng.uniform(-1, 0, count)
    p1 = depth * d - size * (rng.uniform(0.1, 0.6, count) * e + 0.2 * sine * f)
    p3 = p1 + size * rng.uniform(0.7, 1.2, count) * (np.sqrt(1 - sine**2) * e + sine * f)
    corners = np.stack((p1, p1 + 1.5 * size * e, p3))
    return d.astype(F), corners.astype(F)


def quotients(d, corners):
    """Return Moeller and Trumbore's u, v and t, in the type of what is given."""
    p1, p2, p3 = corners
    e1, e2 = p2 - p1, p3 - p1
    h = cross(d, e2)
    det = dot(e1, h)
    q = cross(-p1, e1)
    return dot(-p1, h) / det, dot(d, q) / det, dot(e2, q) / det


@pytest.mark.parametrize("sine", [0.3, 1e-3])
@pytest.mark.parametrize("cosine", [0.3, 1e-2])
def test_what_rays_of_float32_may_round_is_bounded_and_reached(sine, cosine, make, rng):
    """Fractions judge: where float32 has edges and depths, beside where they are.

    Of a thousand random rays the worst comes to a fiftieth of the bound of edges at least, and of
    depths: a bound that forgot thin triangles, or a grazing angle, would be passed by far.
    """
    d, corners = triangles_before(rng, 1000, sine, cosine)
    u, v, t = quotients(d, corners)
    assert t.dtype == F
    exact = [
        np.array(x, float)
        for x in quotients(rational(d.astype(float)), rational(corners.astype(float)))
    ]
    inside = (exact[0] > 0) & (exact[1] > 0) & (exact[0] + exact[1] < 1) & (exact[2] > 0)
    assert inside.sum() > 300
    c, way = corners.astype(float), d.astype(float)
    e1, e2 = c[1] - c[0], c[2] - c[0]
    det = np.abs(dot(e1, cross(way, e2)))
    off = np.abs([u - exact[0], v - exact[1], u.astype(float) + v - exact[0] - exact[1]])
    across = [np.sqrt(dot(n, n)) for n in (cross(way, e) for e in (e2, e1, e2 - e1))]
    beside = (off * det / across).max(axis=0)
    number = np.arange(1000, dtype=np.int32)
    points = c.transpose(2, 0, 1).reshape(-1, 3)
    mesh = Mesh(points, np.arange(3000).reshape(-1, 3))
    scene = make.scene(make.camera(4, 4), mesh)
    measures = np.array([exact[2], 1 - exact[0] - exact[1], exact[0], exact[1]])
    hits = Hits(0 * number, number, np.zeros(1000, np.uint8), measures)
    places = (exact[2] * way).T
    rays = Rays(np.zeros((3, 1)), way)
    edges = beside[inside] / RAYS.sideways(scene, hits, places)[inside]
    depths = (np.abs(t - exact[2]) / RAYS.along(scene, hits, places, rays))[inside]
    assert 0.02 < edges.max() < 1
    assert 0.02 < depths.max() < 1


@pytest.mark.parametrize(
    ("header", "engine", "renderer"),
    [
        ("", "BLENDER_EEVEE", RAYS),  # anybody's picture
        ("cycles", "BLENDER_WORKBENCH", RAYS),  # the file's engine was changed since
        ("other", "BLENDER_WORKBENCH", RASTER),
        ("other", "BLENDER_EEVEE", RASTER),
        ("other", "BLENDER_EEVEE_NEXT", RASTER),
        ("other", "LUXCORE", RAYS),
        ("other", "CYCLES", RAYS),  # which notes its samples: an engine that is not known
        ("other", "", RAYS),
    ],
)
def test_a_picture_is_rasterised_only_if_that_is_known(header, engine, renderer):
    found, known = renderer_of(header, engine)
    assert found is renderer
    assert ("its engine is" in known) == (renderer is RASTER)
