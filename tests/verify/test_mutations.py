"""A damaged certificate is refused, and the pixel named; what stays true passes."""

from __future__ import annotations

import numpy as np
import pytest

from .certificates import certified, refusal, scene_in, scene_of

ANSWERS = "seen", "t", "ties"


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
    seen = a["seen"].reshape(-1, 2)
    others = [name for name in names(scene) if name != tuple(seen[pixel])]
    seen[pixel] = others[rng.integers(len(others))]
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
    a["t"].flat[pixel] = a["t"].flat[other]
    a["seen"].reshape(-1, 2)[pixel] = a["seen"].reshape(-1, 2)[other]
    return pixel


def a_tie_less(a, scene, rng):
    row = rng.integers(len(a["ties"]))
    pixel = int(a["ties"][row, 0])
    a["ties"] = np.delete(a["ties"], row, axis=0)
    return pixel


def no_ties(a, scene, rng):
    pixel = int(rng.choice(a["ties"][:, 0]))
    a["ties"] = a["ties"][a["ties"][:, 0] != pixel]
    return pixel


def a_tie_more(a, scene, rng):
    pixel = int(rng.integers(a["t"].size))
    name = names(scene)[rng.integers(len(names(scene)))]
    a["ties"] = np.append(a["ties"], [(pixel, *name)], axis=0)
    return pixel


def changed(a, key, index, value):
    a[key] = a[key].copy()
    a[key][index] = value


def a_vertex(a, scene, rng):
    index = int(rng.integers(len(a["vertices"]))), int(rng.integers(3))
    changed(a, "vertices", index, a["vertices"][index] * (1 + rng.choice([1e-5, -0.1])))


def a_triangle(a, scene, rng):
    of = a["triangles"]
    changed(a, "triangles", rng.integers(len(of)), of[rng.integers(len(of))])


def a_matrix(a, scene, rng):
    k = int(rng.integers(len(a["world_from_object"])))
    at = a["world_from_object"][k].max() * 1.01
    changed(a, "world_from_object", (k, rng.integers(3), 3), at)


def an_instance(a, scene, rng):
    changed(a, "instances", (k := rng.integers(len(a["instances"])), 0), a["instances"][k, 0] + 1)


def the_camera(a, scene, rng):
    kind = rng.integers(5)
    start, end = a["clip"]
    left, right = a["window"][0]
    if kind == 0:
        changed(a, "clip", 0, start + 0.3 * (end - start))
    elif kind == 1:
        changed(a, "clip", 1, start * 1.5 if start > 0 else 0.5)
    elif kind == 2:
        changed(a, "window", (0, 1), right + 1e-3 * (right - left))
    elif kind == 3:
        index = int(rng.integers(3)), 3
        changed(a, "world_from_camera", index, a["world_from_camera"][index] + 1e-3 * end)
    else:
        changed(a, "pixels", (0, 2), a["pixels"][0, 2] + 1)


OF_ANSWERS = (
    another_owner,
    last_bit_of_t,
    another_t,
    of_a_neighbour,
    a_tie_less,
    no_ties,
    a_tie_more,
)
OF_SCENES = a_vertex, a_triangle, a_matrix, an_instance, the_camera


def is_true(a, path) -> bool:
    """Return whether a changed scene, traced anew, has the very answers."""
    again = certified(scene_in(a), path.with_name("again.npz"))
    return same_answers(a, again)


def same_answers(a, b) -> bool:
    return ties_of(a) == ties_of(b) and all(np.array_equal(a[n], b[n]) for n in ANSWERS[:2])


def ties_of(a) -> list[tuple[int, int, int]]:
    return sorted(set(map(tuple, a["ties"].tolist())))


def damaged(make, seeds, path, scenes=12) -> tuple[int, int]:
    """Damage a certificate a seed, and have it checked; count the refused, and those still true."""
    refused = true = 0
    known = [(s := scene_of(make, k), certified(s, path)) for k in range(scenes)]
    for seed in seeds:
        rng = np.random.default_rng(seed)
        kinds = OF_ANSWERS + OF_SCENES
        kind = kinds[seed % len(kinds)]
        scene, before = known[rng.integers(scenes)]
        if (kind in (a_tie_less, no_ties) and not len(before["ties"])) or (
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
