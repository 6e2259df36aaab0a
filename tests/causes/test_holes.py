"""Holes that an attacker found in the checks: each is a difference that must not be excused."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from reference_tracer.causes.case import Alternative
from reference_tracer.causes.explain import UNEXPLAINED, explain
from reference_tracer.pictures.metrics import boundary
from reference_tracer.pictures.picture import Picture
from reference_tracer.pictures.sampling import Sampling
from reference_tracer.rendering import render
from reference_tracer.scene import Instance, Mesh, without
from reference_tracer.tracer.progress import result_of

from ..cases import case_of, owners_of
from ..sampled import sampled

FILTER = Sampling(filter_radius=1.5)


@pytest.fixture
def named(room):
    return replace(room, objects=("Ball", "Box", "Wall"))


def known(scene, frame, color=None, **options):
    """Return a picture that is known to show what was traced, but for its colours."""
    color = frame.color.copy() if color is None else color
    return Picture(color, owners=owners_of(scene.objects, frame), **options)


def unexplained(scene, frame, picture, **options):
    found = result_of(explain(case_of(scene, picture, **options), frame))
    return found.causes.cause == UNEXPLAINED


def inside(frame, number):
    return (frame.instance_index == number) & ~boundary(frame)


def test_another_object_of_the_same_colour_is_no_anti_aliasing(named):
    """Its colour is a mix, of itself: whose it is was not asked."""
    frame = render(named)
    picture = known(named, frame, sampling=FILTER)
    wrong = inside(frame, 0)
    picture.owners.pixels[wrong] = 2
    assert wrong.sum() > 50
    assert (unexplained(named, frame, picture) == wrong).all()


def test_a_dark_surface_in_another_shade_is_no_anti_aliasing(named):
    """Where all that the filter reaches is one colour, nothing is mixed, however near it is."""
    dark = named.instances[1].colors * np.float32((0.01, 0.01, 0.01, 1))
    own = (named.instances[0], replace(named.instances[1], colors=dark), named.instances[2])
    scene = replace(named, instances=own)
    frame = render(scene)
    wrong = inside(frame, 1)
    color = frame.color.copy()
    color[wrong, :3] = 0.0
    found = unexplained(scene, frame, known(scene, frame, color, sampling=FILTER))
    edge = np.pad(boundary(frame), 1)
    near = np.any([np.roll(edge, s, (0, 1)) for s in np.ndindex(3, 3)], axis=0)[2:, 2:]
    assert (wrong & ~near).sum() > 50 and (found[wrong & ~near]).all()


@pytest.mark.slow
@sampled(4)
def test_a_negative_colour_is_no_mix_of_positive_ones(named, every):
    """A logarithm that is cut off at 0 would take it for black."""
    frame = render(named)
    wrong = boundary(frame)
    wrong[np.arange(len(wrong)) % every > 0] = False
    color = frame.color.copy()
    color[wrong, :3] = np.minimum(color[wrong, :3], 0) - 0.5
    found = unexplained(named, frame, known(named, frame, color, sampling=FILTER))
    assert found[wrong].all()


def test_a_picture_moved_by_a_pixel_is_no_anti_aliasing(named):
    """No filter gives its centre's neighbour all of the weight, and everywhere the same one."""
    frame = render(named)
    color = np.roll(frame.color, 1, axis=1)
    wrong = (color != frame.color).any(axis=-1)
    found = unexplained(named, frame, Picture(color, sampling=FILTER))
    assert found.sum() > 0.5 * wrong.sum()


def test_what_hides_behind_an_edge_is_no_anti_aliasing(make):
    """A crack lets a little of it through, not all of a picture's edge."""
    near = make.quad(-0.5, 0.4, -0.4, 0.3, -2)
    far = make.quad(-0.45, 0.35, -0.35, 0.25, -3)
    scene = make.scene(make.camera(40, 30), near, far, background=(0, 0, 0, 1))
    frame = render(scene)
    wrong = (frame.instance_index == 0) & boundary(frame)
    color = frame.color.copy()
    color[wrong] = scene.instances[1].colors[0]
    found = unexplained(scene, frame, Picture(color, sampling=FILTER))
    assert found.sum() > 0.9 * wrong.sum()


def test_a_hole_in_an_object_that_a_flag_hides_is_no_hidden_object(named):
    """The picture shows the object, all around the hole: so it was not hidden for it."""
    frame = render(named)
    less = without(named, ["Wall"])
    gone = render(less)
    wall = np.argwhere(inside(frame, 2))
    y, x = wall[len(wall) // 2]
    hole = np.zeros(frame.t.shape, bool)
    hole[y - 2 : y + 3, x - 2 : x + 3] = True
    hole &= inside(frame, 2)
    color = np.where(hole[..., None], gone.color, frame.color)
    other = Alternative("Wall", "hidden in the viewport", less)
    assert hole.sum() >= 10
    found = unexplained(named, frame, Picture(color), alternatives=(other,))
    assert (found == hole).all()


def test_what_lies_behind_a_fine_mesh_does_not_shine_through_its_edges(make):
    """Its triangles share their edges, which a rasteriser covers without a gap."""
    count = 130
    x, y = np.meshgrid(np.linspace(-0.5, 0.5, count + 1), np.linspace(-0.5, 0.5, count + 1))
    # A little out of line: not every pixel's centre lies alike in its triangle.
    x, y = x + 1e-4 * np.sin(7 * y), y + 1e-4 * np.sin(5 * x)
    points = np.stack((x, y, np.full_like(x, -2)), axis=-1).reshape(-1, 3)
    k = (np.arange(count)[:, None] * (count + 1) + np.arange(count)).ravel()
    corners = ((0, 1, count + 2), (0, count + 2, count + 1))
    fine = Mesh(points, np.concatenate([k[:, None] + np.array(c) for c in corners]), name="Fine")
    wall = make.quad(-2, 2, -2, 2, -3)
    scene = make.scene(make.camera(40, 30, half=0.6), fine, wall)
    frame = render(scene)
    wrong = inside(frame, 0)
    color = frame.color.copy()
    color[wrong] = scene.instances[1].colors[0]
    found = unexplained(scene, frame, Picture(color))
    assert wrong.sum() > 50
    assert found.sum() > 0.95 * wrong.sum()


def test_a_background_of_a_surfaces_colour_is_not_the_pictures_own(make):
    """A picture turned over shows the floor where the sky was: that is no background."""
    floor, ball = make.quad(-9, 9, -9, -0.0, -3), make.quad(-0.4, 0.3, -0.5, 0.35, -2)
    scene = make.scene(make.camera(40, 30), floor, ball)
    frame = render(scene)
    color = np.ascontiguousarray(frame.color[::-1])
    wrong = (color != frame.color).any(axis=-1)
    found = unexplained(scene, frame, Picture(color), curves=())
    assert found.sum() > 0.9 * wrong.sum()


def test_two_objects_with_one_anothers_colours_are_no_swapped_channels(make):
    """The others are as they were, and would not be."""
    quads = [make.quad(0.3 * n - 0.6, 0.3 * n - 0.35, -0.3, 0.3, -2) for n in range(4)]
    scene = make.scene(make.camera(40, 30), *quads)
    colors = ((0.8, 0.1, 0.1, 1), (0.1, 0.1, 0.8, 1), (0.3, 0.5, 0.1, 1), (0.6, 0.5, 0.2, 1))
    of = [Instance(n, n, np.eye(4), [c]) for n, c in enumerate(colors)]
    scene = replace(scene, instances=tuple(of))
    frame = render(scene)
    color = frame.color.copy()
    wrong = np.isin(frame.instance_index, (0, 1))
    color[wrong, :3] = color[wrong, 2::-1]
    case = case_of(scene, Picture(color), curves=())
    causes = result_of(explain(case, frame)).causes
    assert causes.transform == ""
    assert (causes.cause == UNEXPLAINED)[wrong].all()
