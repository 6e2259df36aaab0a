"""A damaged certificate is refused, and the pixel named; what stays true passes."""

from __future__ import annotations

import json

import numpy as np
import pytest
from reference_tracer.scene_files import load_scene

from .certificates import certified, refusal, scene_of

ANSWERS = "instance", "triangle", "t", "tie_pixel", "tie_instance", "tie_triangle"


def names(scene) -> list[tuple[int, int]]:
    """Return the names of all surfaces, and that of none."""
    count = len(scene.instances)
    of = [
        (i, k)
        for i in range(count)
        for k in range(len(scene.meshes[scene.instances[i].mesh].triangles))
    ]
    return [(-1, -1), *of, *((count + k, -1) for k in range(len(scene.planes)))]


def another_owner(a, scene, rng):
    pixel = int(rng.integers(a["t"].size))
    said = a["instance"].flat[pixel], a["triangle"].flat[pixel]
    others = [name for name in names(scene) if name != said]
    a["instance"].flat[pixel], a["triangle"].flat[pixel] = others[rng.integers(len(others))]
    return pixel


def last_bit_of_t(a, scene, rng):
    pixel = int(rng.choice(np.flatnonzero(np.isfinite(a["t"]))))
    a["t"].flat[pixel] = np.nextafter(a["t"].flat[pixel], rng.choice([-np.inf, np.inf]))
    return pixel


def another_t(a, scene, rng):
    pixel = int(rng.integers(a["t"].size))
    a["t"].flat[pixel] = rng.choice([0.0, -1.0, np.nan, np.inf, 1e300, 2 * a["t"].flat[pixel]])
    return pixel


def of_a_neighbour(a, scene, rng):
    pixel, other = rng.choice(a["t"].size, 2, replace=False).tolist()
    for name in ("instance", "triangle", "t"):
        a[name].flat[pixel] = a[name].flat[other]
    return pixel


def a_tie_less(a, scene, rng):
    row = rng.integers(len(a["tie_pixel"]))
    pixel = int(a["tie_pixel"][row])
    a |= {name: np.delete(a[name], row) for name in ANSWERS[3:]}
    return pixel


def no_ties(a, scene, rng):
    pixel = int(rng.choice(a["tie_pixel"]))
    a |= {name: a[name][a["tie_pixel"] != pixel] for name in ANSWERS[:2:-1]}
    return pixel


def a_tie_more(a, scene, rng):
    pixel = int(rng.integers(a["t"].size))
    name = names(scene)[rng.integers(len(names(scene)))]
    for key, value in zip(ANSWERS[3:], (pixel, *name), strict=True):
        a[key] = np.append(a[key], value)
    return pixel


def changed(a, key, index, value):
    a[key] = a[key].copy()
    a[key][index] = value


def a_vertex(a, scene, rng):
    at = rng.choice([key for key in a if key.endswith("vertices") and a[key].size])
    index = int(rng.integers(len(a[at]))), int(rng.integers(3))
    changed(a, at, index, a[at][index] * a[at].dtype.type(1 + rng.choice([1e-5, -0.1])))


def a_triangle(a, scene, rng):
    at = rng.choice([key for key in a if key.endswith("triangles") and a[key].size])
    changed(a, at, rng.integers(len(a[at])), a[at][rng.integers(len(a[at]))])


def a_matrix(a, scene, rng):
    at = rng.choice([key for key in a if key.endswith("from_object")])
    changed(a, at, (rng.integers(3), 3), a[at].max() * 1.01)


def the_camera(a, scene, rng):
    head = json.loads(str(a["scene"]))
    camera = head["camera"]
    kind = rng.integers(5)
    if kind == 0:
        camera["clip_start"] += 0.3 * (camera["clip_end"] - camera["clip_start"])
    elif kind == 1:
        camera["clip_end"] = camera["clip_start"] * 1.5 if camera["clip_start"] > 0 else 0.5
    elif kind == 2:
        camera["window"]["right"] += 1e-3 * (camera["window"]["right"] - camera["window"]["left"])
    elif kind == 3:
        camera["world_from_camera"][int(rng.integers(3))][3] += 1e-3 * camera["clip_end"]
    else:
        camera["width"] += 1
    a["scene"] = np.array(json.dumps(head))


OF_ANSWERS = (
    another_owner,
    last_bit_of_t,
    another_t,
    of_a_neighbour,
    a_tie_less,
    no_ties,
    a_tie_more,
)
OF_SCENES = a_vertex, a_triangle, a_matrix, the_camera


def is_true(a, path) -> bool:
    """Return whether a changed scene, traced anew, has the very answers."""
    again = certified(load_scene(path), path.with_name("again.npz"))
    return same_answers(a, again)


def same_answers(a, b) -> bool:
    return ties_of(a) == ties_of(b) and all(np.array_equal(a[n], b[n]) for n in ANSWERS[:3])


def ties_of(a) -> list[tuple[int, int, int]]:
    return sorted(set(zip(*(a[name].tolist() for name in ANSWERS[3:]), strict=True)))


def damaged(make, seeds, path, scenes=12) -> tuple[int, int]:
    """Damage a certificate a seed, and have it checked; count the refused, and those still true."""
    refused = true = 0
    known = [(s := scene_of(make, k), certified(s, path)) for k in range(scenes)]
    for seed in seeds:
        rng = np.random.default_rng(seed)
        kinds = OF_ANSWERS + OF_SCENES
        kind = kinds[seed % len(kinds)]
        scene, before = known[rng.integers(scenes)]
        if (kind in (a_tie_less, no_ties) and not len(before["tie_pixel"])) or (
            kind is last_bit_of_t and not np.isfinite(before["t"]).any()
        ):
            kind = another_owner
        after = dict(before)
        for name in ANSWERS:
            after[name] = before[name].copy()
        pixel = kind(after, scene, rng)
        np.savez(path, **after)
        said = refusal(path)
        if said:
            refused += 1
            if kind in OF_ANSWERS:
                y, x = divmod(pixel, before["t"].shape[1])
                assert said.startswith(f"pixel ({x}, {y}): the file says "), (seed, kind, said)
            continue
        assert same_answers(after, before)
        assert kind in OF_ANSWERS or is_true(after, path), (seed, kind)
        true += 1
    return refused, true


def test_a_damaged_certificate_is_refused(make, tmp_path):
    refused, true = damaged(make, range(66), tmp_path / "c.npz")
    assert refused > 44 and true < 22


@pytest.mark.torture
def test_a_thousand_damaged_certificates_are_refused(make, tmp_path):
    refused, true = damaged(make, range(66, 2066), tmp_path / "c.npz", 100)
    assert refused > 1400 and true < 600
