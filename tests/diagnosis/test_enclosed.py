"""The numbers that are told make the same picture; one alone lies between its ends."""

from __future__ import annotations

import numpy as np
import pytest
from reference_tracer.diagnosis.faults.changes import MOVED, SCALED
from reference_tracer.diagnosis.faults.fault import Numbers
from reference_tracer.diagnosis.faults.pose import Posed

from .diagnosing import fitted, pictured

OBJECTS = "Box", "Ball", "Ring", "Drum"


KINDS = {
    "object_moved": lambda rng: rng.uniform(-0.25, 0.25, 3) * (rng.random(3) < 0.7),
    "camera_moved": lambda rng: rng.uniform(-0.3, 0.3, 3),
    "camera_turned": lambda rng: rng.uniform(-2, 2, 3),
    "pixel_offset": lambda rng: rng.uniform(-4, 4, 2),
    "focal_length": lambda rng: rng.uniform(-10, 10, 1),
    "focal_lengths": lambda rng: rng.uniform(-8, 8, 2),
    "object_scaled": lambda rng: rng.uniform(0.8, 1.3, 1),
}


SAME = 0.005  # of the pixels: as many may be others, where a fit stops beside the best place


def found_again(few, seed, size):
    """Return whether a random fault's numbers are told, or some as good; None if hardly seen."""
    rng = np.random.default_rng(seed)
    name = list(KINDS)[seed % len(KINDS)]
    scene = few(*size, parallel=rng.random() < 0.25, seed=seed)
    values = tuple(float(v) for v in KINDS[name](rng))
    change = {"object_moved": MOVED[0], "object_scaled": SCALED[0]}.get(name)
    named = str(rng.choice(OBJECTS)) if change else ""
    guess = Posed(values, object=named, change=change) if change else Numbers(values)
    color = pictured(scene, name, guess)
    found = fitted(scene, color, name)
    if found is None:
        return None
    assert all(a <= v <= b for a, v, b in zip(found.low, found.values, found.high, strict=True))
    if len(values) == 1:
        return found.low[0] <= values[0] <= found.high[0]
    return (pictured(scene, name, found) != color).any(axis=-1).mean() <= SAME


@pytest.mark.slow
@pytest.mark.parametrize(
    "seed", [*(pytest.param(n, marks=pytest.mark.torture) for n in range(3)), 3, 4, 5, 6]
)
def test_the_numbers_that_are_told_are_as_good_as_the_right_ones(few, seed):
    assert found_again(few, seed, (48, 30)) is not False


@pytest.mark.torture
@pytest.mark.parametrize("part", range(10))
def test_numbers_as_good_are_found_nearly_always(few, part):
    """A fit may stop beside the best place: at most one in eleven."""
    results = [found_again(few, 100 + 11 * part + n, (112, 64)) for n in range(11)]
    assert results.count(False) <= 1


@pytest.mark.torture
def test_an_object_that_sinks_is_told_as_it_is(few):
    """Its distance is hardly seen: of all moves that fit, that with zeros is the right one."""
    scene = few(96, 54)
    color = pictured(scene, "object_moved", Posed((0, 0, -0.06), object="Box"))
    found = fitted(scene, color, "object_moved")
    assert found.values[:2] == (0, 0) and found.values[2] == pytest.approx(-0.06, abs=0.01)


@pytest.mark.slow
def test_what_an_orthographic_camera_cannot_see_is_left_open(few):
    scene = few(parallel=True)
    move = (0.2, 0.1, 0)
    found = fitted(
        scene, pictured(scene, "object_moved", Posed(move, object="Box")), "object_moved"
    )
    away = scene.camera.forward
    open_ = np.subtract(found.high, found.low)
    assert np.all(open_ > np.abs(away)) and open_.max() < 2  # metres: farther on it hides others
    beside = np.subtract(found.values, move)
    assert np.linalg.norm(beside - (beside @ away) * away) < 0.05
