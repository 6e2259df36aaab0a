"""The page's layers in a browser: what they show, and the value under the pointer."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from reference_tracer.files.images import to_display
from reference_tracer.scene import Instance
from reference_tracer.tracer.camera import camera_rays, film_positions

from .browser import choose, color_at, place_of, settled, shown, unmarked

pytestmark = pytest.mark.browser
MAPS = ["objects", "facing", "normal", "depth", "triangles"]


def mirrored(scene):
    """The first instance, mirrored: its normals still point outwards."""
    first = scene.instances[0]
    flip = np.diag([-1.0, 1.0, 1.0, 1.0])
    turned = Instance(first.mesh, first.object, first.world_from_object @ flip, first.colors)
    return replace(scene, instances=(turned, *scene.instances[1:]))


@pytest.fixture
def pointed(compared, room, show):
    """Return a function that opens the page of a scene, and one that reads the line below it."""

    def opened(scene):
        comparison = compared(scene)
        tab = show(comparison)
        unmarked(tab)

        def told(name, x, y):
            tab.evaluate("id => change({ left: id, split: 1, view: { ...state.view } })", name)
            tab.mouse.move(*place_of(tab, x, y))
            text = tab.locator("#readout").inner_text()
            assert text.startswith(f"({x}, {y})")
            return text.partition(": ")[2]

        return comparison, tab, told

    return opened


@pytest.mark.parametrize("projection", ["perspective", "orthographic", "equirectangular"])
@pytest.mark.parametrize("mirror", [False, True])
def test_facing_normal_and_depth_are_the_frames(pointed, room, projection, mirror):
    scene = room(projection=projection)
    comparison, tab, _ = pointed(mirrored(scene) if mirror else scene)
    frame = comparison.frame
    hit = np.flatnonzero(frame.instance_index.ravel() >= 0).tolist()
    d = camera_rays(frame.scene.camera, *film_positions(frame.scene.camera.region)).directions
    normal = frame.normal.reshape(-1, 3)
    cosine = (normal * (d / np.linalg.norm(d, axis=0)).T).sum(axis=1)
    found = tab.evaluate(
        """all => all.map(p => [normalOf(pixels.surface[p]), cosineAt(p), roughDepth(p),
          facingAt(p)])""",
        hit,
    )
    assert len({tuple(n) for n, *_ in found}) > 5
    for pixel, (n, cos, depth, side) in zip(hit, found, strict=True):
        assert n == pytest.approx(normal[pixel], abs=1e-12)
        assert cos == pytest.approx(cosine[pixel], abs=1e-12)
        assert depth == pytest.approx(frame.t.ravel()[pixel], rel=1e-9)
        assert side == ("front" if cosine[pixel] < 0 else "back")


def test_backs_are_told_and_drawn(pointed, room):
    """A ball that is turned inside out shows its back wherever it is seen."""
    scene = room()
    ball = replace(scene.meshes[0], triangles=scene.meshes[0].triangles[:, ::-1])
    comparison, tab, told = pointed(replace(scene, meshes=(ball, *scene.meshes[1:])))
    frame = comparison.frame
    for instance, side in ((0, "back"), (1, "front")):
        y, x = np.argwhere(frame.instance_index == instance)[5].tolist()
        assert told("facing", x, y).startswith(f"{side} (cosine ")
        r, g, _ = color_at(tab, x, y)
        assert (g < r) == (side == "back")


def test_each_layer_tells_its_value_below_the_pointer(pointed, room):
    scene = room(projection="perspective", planes=False)
    comparison, tab, told = pointed(scene)
    frame = comparison.frame
    y, x = np.argwhere(frame.triangle_index > 3)[20].tolist()
    ny, nx = np.argwhere(frame.instance_index < 0)[-4].tolist()
    name = scene.objects[frame.object_index[y, x]]
    assert told("objects", x, y) == name and told("objects", nx, ny) == "nothing"
    assert told("triangles", x, y) == f"{name}, triangle {frame.triangle_index[y, x]}"
    assert told("depth", x, y) == f"{float(frame.t[y, x])!r} m"
    values = [float(v.replace("−", "-")) for v in told("normal", x, y).split()[1::2]]
    assert values == pytest.approx(frame.normal[y, x], rel=1e-5, abs=1e-9)
    for layer in MAPS[1:]:
        assert told(layer, nx, ny) == "none"
    assert told("causes", x, y) == "agrees"
    screen = " ".join(str(v) for v in to_display(frame.color[y : y + 1, x : x + 1])[0, 0])
    assert told("traced", x, y).startswith(f"{screen} of 255; linear ")
    tab.locator("#title").hover()
    assert tab.locator("#readout").inner_text().startswith("(24, 18)")  # what is looked at


def test_the_slider_tells_the_picture_on_its_side(pointed, room):
    _, tab, _ = pointed(room())
    tab.evaluate("() => change({ left: 'objects', right: 'depth', split: 0.5 })")
    for x, label in ((5, "Objects"), (40, "Depth")):
        tab.mouse.move(*place_of(tab, x, 8))
        assert f"({x}, 8)  {label}: " in tab.locator("#readout").inner_text()


def test_objects_and_triangles_have_colours_of_their_own(pointed, room):
    comparison, tab, _ = pointed(room())
    frame = comparison.frame
    for layer, number in (("objects", frame.object_index), ("normal", None)):
        drawn = tab.evaluate("id => [...layerOf(id).values]", layer)
        drawn = np.reshape(drawn, (*frame.shape, 4))[::-1]
        if number is None:
            expected = np.rint(127.5 * (frame.normal + 1))
            hit = frame.instance_index >= 0
            assert abs(drawn[hit][:, :3] - expected[hit]).max() <= 1
            continue
        of = {n: {tuple(c) for c in drawn[number == n].tolist()} for n in np.unique(number)}
        assert all(len(colors) == 1 for colors in of.values())
        assert len(set.union(*of.values())) == len(of) > 3
    triangles = tab.evaluate("() => [...layerOf('triangles').values]")
    colors = {tuple(c) for c in np.reshape(triangles, (-1, 4)).tolist()}
    names = {*zip(frame.instance_index.flat, frame.triangle_index.flat, strict=True)}
    assert len(colors) > 0.95 * len(names)


def test_all_layers_are_seen_at_once(pointed, room):
    comparison, tab, _ = pointed(room())
    choose(tab, "all")
    settled(tab)
    ids = tab.evaluate("() => panes().map((pane) => pane.ids[0])")
    assert ids[-5:] == MAPS
    y, x = np.argwhere(comparison.frame.instance_index == 0)[9].tolist()
    assert color_at(tab, x, y, pane=0) == shown(comparison.frame.color[y, x])
    keys = tab.evaluate("() => layers.get('depth').key.map(([text]) => text)")
    near, far = (float(text.removesuffix(" m")) for text in keys)
    assert (near, far) == pytest.approx(comparison.frame.depths(), rel=1e-3)
