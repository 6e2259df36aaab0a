"""`reftrace compare --against` a picture on a background of its own."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import trimesh
from reference_tracer.causes.case import Case
from reference_tracer.causes.explain import UNEXPLAINED
from reference_tracer.comparison.comparing import compare, trace_and_compare
from reference_tracer.files import images
from reference_tracer.manifest import Manifest
from reference_tracer.pictures.picture import Picture
from reference_tracer.pictures.storage import Storage
from reference_tracer.rendering import render
from reference_tracer.report.lines import describe
from reference_tracer.tracer.progress import result_of
from reference_tracer.tracer.settings import Settings

WORLD = (0.05, 0.06, 0.07, 1)
PLAIN = Manifest("a.npz", "Scene", "", 0, "FILE", "Camera")


@pytest.fixture
def scene(make):
    solids = (
        trimesh.creation.icosphere(2, radius=0.7).apply_translation((-0.6, 0.3, 0.4)),
        trimesh.creation.box((0.8, 0.6, 1.1)).apply_translation((0.7, -0.4, -0.3)),
    )
    camera = make.camera(120, 90, half=0.6, eye=(3, -4, 2), target=(0, 0, 0))
    return make.scene(camera, *(make.mesh(s) for s in solids), background=WORLD)


def on(scene, background):
    """Return the scene's picture on another background."""
    return render(replace(scene, background=background)).color


def stored(color, opaque=False):
    """Return a picture as an 8-bit PNG has it."""
    color = images.decoded(images.to_display(color) / 255).astype(np.float32)
    return Picture(color, storage=Storage(255, opaque=opaque))


def case_of(scene, picture, curves=(), settings=None):
    return Case(scene, PLAIN, settings or Settings(), picture, curves=curves)


def compared(scene, picture, curves=(), settings=None):
    return result_of(trace_and_compare(case_of(scene, picture, curves, settings)))


@pytest.mark.parametrize(
    ("background", "name", "opaque", "verdict"),
    [
        ((0, 0, 0, 0), "transparent", False, "agree"),
        ((0, 0, 0, 1), "black", True, "warnings"),
        ((1, 1, 1, 1), "white", True, "warnings"),
        ((0.2, 0.5, 0.1, 1), "(0.486, 0.737, 0.349) of sRGB", True, "warnings"),
    ],
)
def test_its_background_is_named(scene, background, name, opaque, verdict):
    found = compared(scene, stored(on(scene, background), opaque))
    assert found.counts.unexplained == 0 and found.counts.agree == 120 * 90
    said = found.to_dict()["background"]
    assert said["text"].startswith(f"the picture's background is {name} where the scene's is (")
    assert said["text"].endswith("compared with the picture's")
    np.testing.assert_allclose(said["picture"], background, atol=0.01)
    np.testing.assert_allclose(said["scene"], WORLD, atol=1e-6)
    assert said["text"] in describe(found) and found.verdict == verdict
    assert said["pixels"] == (found.frame.instance_index < 0).sum()
    # A wall of that colour would look the same: the verdict's own line says so.
    of_a_color = verdict == "warnings"
    last = describe(found)[-1]
    assert last.startswith(f"verdict: {verdict}") and (name in last) == of_a_color
    assert (said["not_judged"] is not None) == of_a_color
    assert (f"{said['pixels']:,} px" in last) == of_a_color


@pytest.mark.parametrize("size", [(1, 1), (20, 15)])
@pytest.mark.parametrize("background", [(0, 0, 0, 0), (0, 0, 0, 1), WORLD])
def test_damage_in_it_is_found(scene, background, size):
    color = on(scene, background).copy()
    patch = np.zeros(color.shape[:2], bool)
    patch[3 : 3 + size[1], 4 : 4 + size[0]] = True
    assert (render(scene).instance_index[patch] < 0).all()
    color[patch] = (1, 0, 0, 1)
    found = compared(scene, stored(color))
    assert np.array_equal(found.causes.cause == UNEXPLAINED, patch)
    assert found.verdict == "differences"


def test_a_missing_object_is_found_on_it(scene):
    color = on(replace(scene, instances=scene.instances[:1]), (0, 0, 0, 0))
    found = compared(scene, stored(color))
    assert found.background is not None and found.counts.unexplained > 250


def test_the_scenes_own_is_not_named(scene):
    assert compared(scene, stored(render(scene).color)).background is None


def test_several_colours_are_no_background(scene):
    color = render(scene).color.copy()
    nothing = render(scene).instance_index < 0
    color[nothing, 0] = np.linspace(0.2, 1, nothing.sum())
    found = compared(scene, stored(color))
    assert found.background is None and found.counts.unexplained > 0.9 * nothing.sum()


def test_blenders_own_picture_must_have_the_scenes(scene):
    found = compared(scene, Picture(on(scene, (0, 0, 0, 0))), None)
    assert found.background is None and found.verdict == "differences"


def test_a_transform_of_the_scenes_own_is_named_as_that(scene):
    color = render(scene).color.copy()
    color[..., :3] = images.curve(color[..., :3])
    found = compared(scene, Picture(color))
    assert found.background is None and found.counts.unexplained == 0
    assert found.causes.transform == "sRGB's curve applied once more"


@pytest.mark.parametrize("background", [(0, 0, 0, 0), (0.3, 0.1, 0.2, 1)])
def test_a_transform_and_another_background(scene, background):
    color = render(scene).color.copy()
    color[..., :3] = images.curve(color[..., :3])
    color[render(scene).instance_index < 0] = background
    found = compared(scene, Picture(color))
    assert found.background is not None and found.counts.unexplained == 0
    assert found.causes.transform == "sRGB's curve applied once more"


def test_several_samples_are_mixed_with_it(scene):
    settings = Settings(samples=4)
    color = render(replace(scene, background=(0, 0, 0, 0)), settings).color
    found = compared(scene, Picture(color), settings=settings)
    assert found.background is not None and found.counts.agree == 120 * 90


def test_what_was_traced_already_has_it_too(scene):
    picture = Picture(on(scene, (0, 0, 0, 0)))
    found = result_of(compare(case_of(scene, picture), render(scene)))
    assert found.background == compared(scene, picture).background is not None
