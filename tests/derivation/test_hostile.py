"""Scenes as hostile as they come: every pixel's derivation has the proven answer, and is whole."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from reference_tracer.certainty import Certainty
from reference_tracer.derivation import reproducer
from reference_tracer.derivation.candidates import gather_pixel
from reference_tracer.derivation.derivation import derive, derive_pixel
from reference_tracer.derivation.textbook import FLOATS, Arithmetic
from reference_tracer.rendering import trace
from reference_tracer.report.pixel import WRITERS
from reference_tracer.scene import Instance, Mesh, Scene
from reference_tracer.tracer.hits import NOWHERE
from reference_tracer.tracer.settings import UNPROVEN_SETTINGS, Precision, Settings

from ..tracer.hostile_scenes import hostile_scene

SCENES = 12
PROVEN = Certainty.BOUND, Certainty.EXACT


@pytest.mark.slow
@pytest.mark.parametrize(
    "seed", [0, *(pytest.param(n, marks=pytest.mark.torture) for n in range(1, 8))]
)
def test_hostile_scenes(make, tmp_path: Path, seed):
    rng = np.random.default_rng(seed)
    kinds, disagreed, kept = set(), 0, 0
    for number in range(SCENES):
        scene = hostile_scene(make, rng)
        hits, region = trace(scene, Settings("certified")), scene.camera.region
        plain = {(s.method, s.precision): trace(scene, s) for s in UNPROVEN_SETTINGS}
        for index in rng.choice(len(hits.t), min(6, len(hits.t)), replace=False).tolist():
            y, x = divmod(index, region.width)
            found = derive(scene, x, y, limit=int(rng.integers(1, 9)))
            certified = found.certified
            every = {c.name for c in gather_pixel(scene, x, y, limit=10**6).candidates}
            for answer in found.answers:  # whatever is left out, these are the pictures' own
                frame = plain[answer.method, answer.precision]
                seen = int(frame.instance[index]), int(frame.triangle[index])
                if answer.precision is Precision.FLOAT32 and seen not in {NOWHERE, *every}:
                    continue  # rounded so far that its box holds another pixel
                assert (answer.seen, answer.t) == (seen, frame.t[index])
                kept += found.pixel.left_out > 0
            assert certified.seen == (hits.instance[index], hits.triangle[index])
            assert certified.t == hits.t[index]
            # A picture may ask integers of a triangle whose box the derivation rules out.
            certainty = Certainty(int(hits.certainty[index]))
            assert certified.certainty == certainty or {certified.certainty, certainty} == {*PROVEN}
            assert certified.ties == hits.ties.get(index, frozenset())
            kinds.add(certified.certainty)
            if certified.certainty in PROVEN:
                # What is proven without a rule is what the textbook says, exactly.
                nearest = found.nearest[Arithmetic.EXACT]
                seen = None if nearest is None else found.tests[nearest].candidate
                assert seen is found.seen
                disagreed += any(found.nearest[kind] != nearest for kind in FLOATS)
        texts = [write(found) for write in WRITERS.values()]
        json.loads(texts[2])
        path = tmp_path / f"{number}.json"
        path.write_text(reproducer.text(found.pixel), encoding="utf-8")
        again = derive_pixel(reproducer.read(path))
        assert [write(again) for write in WRITERS.values()] == texts
    assert {Certainty.BOUND, Certainty.AMBIGUOUS} <= kinds and disagreed and kept


def test_a_box_beyond_all_numbers_hides_no_triangle(make):
    """The corners of a mesh's box may overflow in the world where its triangles' are small."""
    mesh = Mesh(np.array([(1, -1, 2), (-1, 1, -2), (-1, 1, 2)], float), [[0, 1, 2]])
    matrix = np.array([(1e308, 1e308, 1, 0), (1, 0, 0, 0), (0, 0, 0, -5), (0, 0, 0, 1)], float)
    camera = make.camera(width=24, height=18)
    scene = Scene(camera, (mesh,), (Instance(0, 0, matrix),), objects=("far",))
    hits = trace(scene, Settings())
    seen = int(np.flatnonzero(hits.instance == 0)[0])
    assert derive(scene, seen % 24, seen // 24).certified.seen == (0, 0)
