"""Small hostile scenes against the exact judge of the tests: what is wrong of their pictures."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from reference_tracer.certainty import Certainty
from reference_tracer.certified.plain import plain
from reference_tracer.rendering import trace
from reference_tracer.scene import Scene
from reference_tracer.tracer.hits import Hits
from reference_tracer.tracer.progress import result_of
from reference_tracer.tracer.settings import Settings

from ..conftest import Make
from ..moved import may, touched
from ..oracle import scene_sights
from ..tracer.pictures import mess

SEEDS = 2
MEMORY = 1 << 24


def wrong_answers() -> set[str]:
    """Return what is wrong of some scenes' pictures, by the sweep and by `plain`."""
    wrong: set[str] = set()
    for seed in range(SEEDS):
        for kind in range(4):
            scene = mess(Make, np.random.default_rng(seed), bool(kind % 2), kind < 2)
            wrong |= _wrong_of(scene)
    for seed in range(SEEDS):
        for orthographic in (False, True):
            wrong |= _wrong_of(sheets(np.random.default_rng(seed), orthographic))
    return wrong


def sheets(rng: np.random.Generator, orthographic: bool) -> Scene:
    """Return rectangles in one place but for the last digits of their corners: order decides."""
    camera = Make.camera(6, 5, half=1.0 if orthographic else 0.5, orthographic=orthographic)
    meshes = []
    for _ in range(4):
        quad = Make.quad(-9.25, 9.5, -9.75, 9.125, -2)
        jitter = rng.integers(0, 3, quad.vertices.shape) * np.spacing(1.0)
        meshes.append(replace(quad, vertices=quad.vertices + jitter))
    return Make.scene(camera, *meshes)


def _wrong_of(scene: Scene) -> set[str]:
    by_plain = result_of(plain(scene, scene.camera.region, MEMORY))
    return _wrong(scene, trace(scene, Settings("certified"))) | _wrong(scene, by_plain)


def _wrong(scene: Scene, hits: Hits) -> set[str]:
    wrong = set()
    names = list(zip(hits.instance.tolist(), hits.triangle.tolist(), strict=True))
    for k, sight in enumerate(scene_sights(scene)):
        is_ambiguous = len(touched(sight)) > 1
        ties = hits.ties.get(k, frozenset())
        is_right = {
            "owner": names[k] == sight.seen,
            "t": hits.t[k] == sight.rounded_t,
            "certainty": (hits.certainty[k] == Certainty.AMBIGUOUS) == is_ambiguous,
            "ties": not is_ambiguous or may(sight) <= ties <= touched(sight),
        }
        wrong |= {what for what, right in is_right.items() if not right}
    return wrong
