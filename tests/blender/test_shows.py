"""What a 3D view can show, but for what Blender must draw: that is played in the window."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np
import pytest
import trimesh
from reference_tracer.blender.live.shows import SHOWS, Picture
from reference_tracer.causes.maps import WRONG
from reference_tracer.certainty import Certainty
from reference_tracer.rendering import render
from reference_tracer.tracer.coloring import Color
from reference_tracer.tracer.hits import NOTHING
from reference_tracer.tracer.settings import Settings

LITERAL = Settings("textbook_literal", "float32", samples=2)


@pytest.fixture(scope="module")
def scene(make):
    """A closed mesh that fills most of the picture."""
    solid = trimesh.creation.icosphere(3)
    return make.scene(
        make.camera(96, 64, half=0.3),
        make.mesh(solid, trimesh.transformations.translation_matrix((0.1, 0.05, -4))),
    )


def shown(name, scene, settings):
    """Return the picture that a show makes, each of whose steps must leave it whole."""
    picture = Picture.empty(scene.camera)
    done = 0
    for _ in SHOWS[name](scene, settings, picture):
        assert picture.rows_done.sum() >= done
        done = picture.rows_done.sum()
    assert picture.rows_done.all() and picture.color.shape == (64, 96, 4)
    return picture


def counted(line):
    """Return the numbers of a line, but for those in a word."""
    return [int(n.replace(",", "")) for n in re.findall(r"(?<!\w)[\d,]+\b", line)]


def test_the_picture_is_that_of_a_render(scene):
    assert np.array_equal(shown("PICTURE", scene, LITERAL).color, render(scene, LITERAL).color)


@pytest.mark.parametrize("color", Color)
def test_a_colour_is_that_of_a_render(scene, color):
    found = shown(color.name, scene, Settings())
    assert np.array_equal(found.color, render(scene, Settings(color=color)).color)


def test_few_wrong_pixels_are_counted_as_they_are_not_with_their_rings(scene):
    found = shown("WRONG", scene, Settings("moller_trumbore", "float32"))
    again = render(scene, Settings("moller_trumbore", "float32"))
    wrong, total = counted(found.line)
    assert total == 96 * 64
    assert wrong == again.wrong_against(render(scene)).sum() < 100


@pytest.mark.parametrize("method", ["auto", "textbook_literal"])
def test_where_nothing_is_hit_the_background_stays_the_views_own(scene, method):
    for own in ((0, 0, 0, 0), (0.2, 0.3, 0.4, 1)):
        there = replace(scene, background=np.float32(own))
        settings = Settings(method, "float32") if method != "auto" else Settings()
        found = shown("WRONG", there, settings).color
        nothing = render(there, settings).instance_index == NOTHING
        red = (found == (*WRONG, 1)).all(axis=-1)
        assert (found[nothing & ~red] == np.float32(own)).all() and (nothing & ~red).any()
        assert (found[~nothing] != np.float32(own)).any(axis=-1).all()


@pytest.mark.parametrize("method", ["auto", "certified"])
def test_nothing_is_wrong_of_what_is_proven(scene, method):
    found = shown("WRONG", scene, Settings(method))
    assert not (found.color == (*WRONG, 1)).all(axis=-1).any()
    assert "none is wrong" in found.line


def test_certainty_is_counted(scene):
    frame = render(scene)
    line = shown("CERTAINTY", scene, Settings()).line
    counts = [int((frame.certainty == c).sum()) for c in Certainty]
    assert counted(line) == [n for n in counts if n] and sum(counts) == 96 * 64
    line = shown("CERTAINTY", scene, LITERAL).line
    assert line == f"{96 * 64:,} not proven"
