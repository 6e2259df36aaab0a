"""The checker agrees with brute force on random small pictures, and refuses each other answer."""

from __future__ import annotations

from collections import Counter
from fractions import Fraction
from typing import Any
from unittest import mock

import numpy as np
import pytest
import reference_tracer_verify.verify as checker

from .brute import NOWHERE, Seen, met_by, picture, ray, surfaces

KINDS = "perspective", "orthographic", "equirectangular"
MOST = float(np.finfo(float).max)
CLIPS = (
    *[(0.0, 9.0), (-9.0, 9.0), (0.0, MOST), (-MOST, MOST)] * 3,
    *[(0.5, 9.0), (1.0, 3.0), (3.0, 5.0), (-5.0, 0.0), (-3.0, -1.0)],
    *[(2.0, np.nextafter(2, 3)), (0.0, 5e-324)],
)


def film(rng: np.random.Generator, kind: str) -> dict[str, Any]:
    """A window, which may be reversed or empty, and a region of 1 x 1 to 9 x 5 pixels."""
    begin, beyond = rng.integers(0, 3, (2, 2))
    end = begin + rng.integers(1, [10, 6])
    pixels = np.stack((begin, end, end + beyond), axis=1)
    count = pixels[:, 2]
    step = rng.choice([0.0, 0.25, 0.5, 0.5, 0.5, 1.0, 1.0], 2)
    step /= 1 if kind == "orthographic" else 2
    low = -(count // 2) * step + rng.choice([0, 0.25, 0.5]) * step
    if kind == "equirectangular" and rng.random() < 0.5:
        low, step = rng.choice([-7.0, -1.0, 0.0, 1.5], 2), rng.choice([0.5, 3.0, 9.0], 2) / count
    window = np.stack((low, low + step * count), axis=1)
    return dict(window=window[:, :: rng.choice([1, 1, -1])], pixels=pixels)


def scene(rng: np.random.Generator) -> dict[str, Any]:
    """A certificate's arrays without answers: a lattice, an ulp beside one, or any floats."""
    lattice = rng.random() < 0.8

    def numbers(*shape, reach=3):
        if not lattice:
            return rng.uniform(-reach, reach, shape)
        out = rng.integers(-reach, reach + 1, shape) * 1.0
        return np.where(rng.random(shape) < rng.choice([0, 0, 0, 0.1]), np.nextafter(out, 9), out)

    kind = str(rng.choice(KINDS))
    camera = np.eye(4)
    camera[:3, :3] = camera[rng.permutation(3), :3] * rng.choice([-1, 1], 3)
    if rng.random() < 0.3:
        camera[:3, 3] = numbers(3)
    vertices = numbers(rng.integers(3, 12), 3) - [0, 0, rng.choice([0, 3, 3, 5])]
    if rng.random() < 0.5:
        vertices[:, rng.choice([0, 1, 2, 2])] = rng.choice([-2, -2, -2, 0, 2])
    vertices = vertices @ camera[:3, :3].T
    if rng.random() < 0.2:
        camera[:3, :3] = numbers(3, 3, reach=2)
    count = rng.choice([0, 2, 4, 6, 9, 9])
    triangles = rng.random((count, len(vertices))).argsort()[:, :3]
    triangles[rng.random((count, 3)) < 0.05] = 0
    triangles[:1] = triangles[-1:, rng.permutation(3)]
    instances = np.sort(
        rng.integers(0, len(triangles) + 1, (rng.choice([0, 1, 1, 1, 2, 2, 3, 3]), 2))
    )
    instances[:1] = 0, len(triangles)
    matrices = np.tile(np.eye(4), (len(instances), 1, 1))
    for matrix in matrices[rng.random(len(matrices)) < 0.3]:
        matrix[:3, 3] = numbers(3, reach=2)
    if len(matrices) and rng.random() < 0.2:
        matrices[0] = *numbers(3, 4, reach=2), (0, np.nan, 7, 1)
    planes = numbers(rng.choice([0, 0, 0, 1, 2]), 2, 3)
    if rng.random() < 0.3:
        planes[:1] = planes[-1:] * [[1], [-2]]
    arrays = dict(certificate="reference_tracer.certificate/2", camera=kind) | film(rng, kind)
    arrays |= dict(world_from_camera=camera, clip=np.array(CLIPS[rng.integers(len(CLIPS))]))
    arrays |= dict(vertices=vertices, triangles=triangles, instances=instances)
    arrays |= dict(world_from_object=matrices, planes=planes)
    return scaled(arrays, rng) if rng.random() < 0.4 else arrays


def scaled(arrays: dict[str, Any], rng: np.random.Generator) -> dict[str, Any]:
    """The scene with other units of length and of t, and with larger or smaller vertices."""
    length, ahead = rng.choice([-1060, -1000, -537, -340, -30, 0, 0, 30, 340, 500, 1021], 2)
    by = rng.choice([-500, -30, 0, 0, 0, 30, 500])
    beside = length if arrays["camera"] == "orthographic" else ahead
    powers = (
        ("world_from_object", np.s_[:, :3, :3], by),
        ("world_from_object", np.s_[:, :3, 3], length),
        ("world_from_camera", np.s_[:3, 3], length),
        ("world_from_camera", np.s_[:3, 2], ahead),
        ("world_from_camera", np.s_[:3, :2], beside),
        ("vertices", np.s_[:], length - by),
        ("planes", np.s_[:, 0], length),
        ("planes", np.s_[:, 1], rng.choice([-1060, 0, 0, 500])),
    )
    with np.errstate(all="ignore"):
        for name, part, power in powers:
            arrays[name][part] = np.ldexp(arrays[name][part], power)
        longer = np.ldexp(arrays["clip"], length - ahead)
    if -np.inf < longer[0] < longer[1] < np.inf:
        arrays["clip"] = longer
    return arrays


def refusal(arrays: dict[str, Any], answers: list[Seen], rows: Any, rng, path) -> str:
    """What the checker says of some rows, in a file of any layout, in parts of any size."""
    shape = np.diff(arrays["pixels"])[::-1, 0]
    ties = [(k, *name) for k, seen in enumerate(answers) for name in seen.ties]
    every = arrays | dict(
        seen=np.array([seen.name for seen in answers]).reshape(*shape, 2),
        t=np.array([seen.t for seen in answers]).reshape(shape),
        ties=rng.permutation(np.array(ties, np.int64).reshape(-1, 3)),
    )
    for name in np.array(list(checker.ARRAYS))[rng.random(len(checker.ARRAYS)) < 0.2].tolist():
        every[name] = np.asfortranarray(every[name]).astype(every[name].dtype.newbyteorder())
    np.savez(path, **every)
    parts = dict(PIXELS=int(rng.choice([3, 12, 1 << 18])), PAIRS=int(rng.choice([5, 1 << 13])))
    with mock.patch.multiple(checker, **parts):
        try:
            checker.check(checker.Certificate(str(path)), rows)
        except checker.RefusedError as error:
            return str(error)
    return ""


def others(arrays: dict[str, Any], true: Seen, column: int, row: int, rng) -> list[Seen]:
    """Wrong answers of a pixel: nothing, what is behind, another tie, another rounding of t."""
    every = surfaces(arrays)
    o, d = (list(map(Fraction, v)) for v in ray(arrays, column, row))
    met = met_by(o, d, every, list(map(Fraction, arrays["clip"].tolist())))
    name, t, ties = true
    stranger = [name for name, *_ in every][: rng.integers(1, len(every) + 2)][-1:]
    out = [Seen(NOWHERE, np.inf, tied) for tied in (set(), {NOWHERE}, ties)]
    out += [Seen(m.name, float(m.t), tied) for m in met for tied in (set(), ties, {m.name})]
    out += [Seen(each, t, ties) for each in (*stranger, (name[0], name[1] + 1), (-2, -1))]
    out += [Seen(name, u, ties) for u in (-t, np.nan, np.inf, -np.inf, 0.0)]
    out += [Seen(name, float(np.nextafter(t, to)), ties) for to in (-np.inf, np.inf)]
    out += [Seen(name, t, ties ^ {m}) for m in (*ties, *stranger, *[m.name for m in met], NOWHERE)]
    out += [Seen(name, t, set())]
    wrong = [other for other in out if other != true]
    return [wrong[k] for k in rng.permutation(len(wrong))[:4]]


def held(seeds, path, counted: Counter) -> Counter:
    """Have pictures and changed ones checked; count what they were."""
    for seed in seeds:
        rng = np.random.default_rng(seed)
        arrays = scene(rng)
        width, height = np.diff(arrays["pixels"])[:, 0].tolist()
        answers = picture(arrays)
        if answers is None:
            nothing = [Seen(NOWHERE, np.inf, set())] * (width * height)
            said = refusal(arrays, nothing, range(height), rng, path)
            assert said == "a ray or a plane is not finite", (seed, said)
            counted["not finite"] += 1
            continue
        said = refusal(arrays, answers, range(height), rng, path)
        assert not said, (seed, said)
        counted["pixels"] += len(answers)
        counted["seen"] += sum(seen.name != NOWHERE for seen in answers)
        counted["ties"] += sum(bool(seen.ties) for seen in answers)
        hit = [k for k, seen in enumerate(answers) if seen.ties or seen.name != NOWHERE]
        some = rng.permutation(hit)[:3].astype(int).tolist()
        for pixel in {*some, int(rng.integers(len(answers)))}:
            row, column = divmod(pixel, width)
            rows = sorted({row, *rng.integers(0, height, 2).tolist()})
            for other in others(arrays, answers[pixel], column, row, rng):
                changed = [*answers[:pixel], other, *answers[pixel + 1 :]]
                said = refusal(arrays, changed, rows, rng, path)
                start = f"pixel ({column}, {row}): the file says "
                assert said.startswith(start), (seed, pixel, other, said)
                counted["changed"] += 1
    return counted


def test_the_checker_is_brute_force(tmp_path):
    counted = held((131, *range(138, 148), 154), tmp_path / "c.npz", Counter())
    assert counted["pixels"] > 150 and counted["ties"] > 40 and counted["changed"] > 90


@pytest.mark.torture
def test_the_checker_is_brute_force_often(tmp_path):
    counted = held(range(155, 355), tmp_path / "c.npz", Counter())
    assert counted["pixels"] > 2000 and counted["ties"] > 100 and counted["changed"] > 1000
